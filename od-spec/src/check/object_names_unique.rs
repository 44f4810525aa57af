//! Objects of one device have names of their own, and none looks like another one's `object.entry`.

use std::collections::BTreeMap;

use crate::diag::{Code, Diagnostic, Diagnostics};
use crate::model::Dictionary;
use crate::yaml::shorten;

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    let mut names = BTreeMap::new();
    for object in device.objects.values() {
        if let Some(before) = names.insert(object.name.as_str(), object) {
            // What comes from a library is right: the message is about the other one.
            let own = if object.span.file == device.span.file { object } else { before };
            let other = if own.index == object.index { before } else { object };
            let name = shorten(&object.name);
            diagnostics.push(
                Diagnostic::new(
                    Code::DuplicateName,
                    own.span,
                    format!("{} and {} of `{}` are both named `{name}`", before.index, object.index, device.key),
                )
                .label(own.index.to_string())
                .with(other.span, other.index.to_string())
                .help("give one of the two another name; PDO mappings and generated code refer to objects by name"),
            );
        }
    }
    for object in device.objects.values().filter(|object| object.is_structured()) {
        for entry in &object.entries {
            let full = format!("{}.{}", object.name, entry.name);
            if let Some(other) = names.get(full.as_str()) {
                diagnostics.push(
                    Diagnostic::new(
                        Code::DuplicateName,
                        other.span,
                        format!(
                            "`{}` is the name of {} and means {}.{}",
                            shorten(&full),
                            other.index,
                            object.index,
                            entry.sub
                        ),
                    )
                    .label(other.index.to_string())
                    .with(entry.span, format!("{}.{}", object.index, entry.sub))
                    .help("give one of them a name without this dot"),
                );
            }
        }
    }
}
