//! Objects of one device have names of their own, also in ASCII, and none looks like another one's `object.entry`.

use std::collections::BTreeMap;

use crate::ascii::transliterate;
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{DataType, Dictionary, Entry};
use crate::yaml::shorten;

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    let mut names = BTreeMap::new();
    for object in device.objects.values() {
        if let Some(before) = names.insert(transliterate(&object.name), object) {
            // What comes from a library is right: the message is about the other one.
            let own = if object.span.file == device.span.file { object } else { before };
            let other = if own.index == object.index { before } else { object };
            let name = shorten(&object.name);
            diagnostics.push(
                Diagnostic::new(
                    codes::DUPLICATE_NAME,
                    own.span,
                    format!("{} and {} of `{}` are both named `{name}`", before.index, object.index, device.key),
                )
                .label(own.index.to_string())
                .with(other.span, other.index.to_string())
                .help("give one of the two another name; PDO mappings and generated code refer to objects by name"),
            );
        }
    }
    for object in device.objects.values().filter(|object| DataType::from_name(&object.name).is_some()) {
        diagnostics.push(
            Diagnostic::new(
                codes::DUPLICATE_NAME,
                object.span,
                format!("`{}` is the name of a data type", object.name),
            )
            .help("choose another name; in a PDO mapping this one means a placeholder"),
        );
    }
    for object in device.objects.values().filter(|object| object.is_structured()) {
        let mut entries: BTreeMap<String, &Entry> = BTreeMap::new();
        for entry in &object.entries {
            if let Some(before) = entries.insert(transliterate(&entry.name), entry)
                && (entry.name != before.name || before.sub.0 == 0)
            {
                diagnostics.push(
                    Diagnostic::new(
                        codes::DUPLICATE_NAME,
                        entry.span,
                        format!(
                            "{}.{} and {}.{} have one name in an EDS",
                            object.index, before.sub, object.index, entry.sub
                        ),
                    )
                    .help("give one of them another name"),
                );
            }
        }
        for entry in &object.entries {
            let full = format!("{}.{}", object.name, entry.name);
            if let Some(other) = names.get(&transliterate(&full)) {
                diagnostics.push(
                    Diagnostic::new(
                        codes::DUPLICATE_NAME,
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
