//! From what is written to what is meant: names looked up, defaults filled in, arrays expanded, values typed.

mod aliases;
mod assigned;
mod axes;
pub(crate) mod bit_values;
mod canopennode;
mod channels;
mod condition_names;
mod constraints;
pub(crate) mod consumers;
mod declared;
mod decls;
mod defaults;
mod device_info;
mod devices;
mod document;
mod entries;
mod errors;
mod features;
mod figures;
mod flows;
mod issues;
mod keys_have_effect;
mod libraries;
mod likes;
mod lookup;
mod machines;
mod numbers;
mod objects;
mod pdo_objects;
mod pdo_parameters;
mod pdo_times;
mod pdos;
mod places;
mod printed_order;
mod refs;
mod scope;
mod surroundings;
mod switches;
mod table_content;
mod timings;
mod types;
mod unprinted;
pub(crate) mod values;
mod varied;

use std::sync::Arc;

use crate::ast::{FrontEnd, Spec};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{Dictionary, Document, System, SystemSource, Vendor};
use crate::source::Span;

use figures::Figures;
use libraries::Libraries;
pub(crate) use likes::expand;
pub(crate) use lookup::{Lookup, NotFound};
use numbers::to_u32;
use refs::NamesOf;
pub(crate) use refs::{Names as NamesOfDevice, Namesake, ambiguous};
use scope::Scope;

/// What a specification gives.
pub(crate) struct Resolved {
    /// The model.
    pub system: System,
    /// Of a library that is compiled by itself: its objects, which no device has asked for yet.
    pub library: Option<Dictionary>,
}

/// Builds the model from a specification and the libraries it uses. Mistakes go to `diagnostics`; with an error
/// among them the model is incomplete and must not be used.
pub(crate) fn resolve<'a>(
    root: &'a Spec,
    libraries: &'a [Arc<Spec>],
    diagnostics: &mut Diagnostics,
) -> Resolved {
    keys_have_effect::check(root, diagnostics);
    let scope = Scope::new(root, libraries, diagnostics);
    let languages = match root.languages.as_slice() {
        [] => vec!["en".to_owned()],
        list => list.iter().map(|language| language.value.clone()).collect(),
    };
    let vendor = Vendor {
        name: root
            .vendor
            .as_ref()
            .and_then(|vendor| vendor.name.as_ref())
            .map_or("unknown".to_owned(), |name| name.value.clone()),
        number: root.vendor.as_ref().and_then(|vendor| vendor.number.as_ref()).map_or(0, |n| to_u32(n.value)),
        name_span: root.vendor.as_ref().and_then(|vendor| vendor.name.as_ref()).map(|name| name.span),
        number_span: root.vendor.as_ref().and_then(|vendor| vendor.number.as_ref()).map(|number| number.span),
    };
    if root.profile.is_none() && root.devices.is_empty() && !root.unsure {
        diagnostics.push(
            Diagnostic::new(codes::NO_DEVICE, start(root.span), "the specification describes no device")
                .help("add `devices:` with at least one device, such as `drive: {name: My drive}`"),
        );
    }
    let libraries = Libraries::of(libraries);
    let library = devices::of_library(root, &libraries, &scope, diagnostics);
    let (devices, broken) = devices::resolve(root, &libraries, &scope, &vendor, diagnostics);
    let mut system = System {
        source: match root.front_end {
            FrontEnd::Specification => SystemSource::Specification,
            FrontEnd::Eds => SystemSource::Eds,
        },
        title: root.title.as_ref().map_or(String::new(), |title| title.value.clone()),
        languages,
        document: Document::default(),
        vendor,
        units: scope.units,
        types: scope.types,
        errors: errors::resolve(root, &libraries, diagnostics),
        machines: std::collections::BTreeMap::new(),
        constraints: Vec::new(),
        constraints_by_device: std::collections::BTreeMap::new(),
        errata: Vec::new(),
        devices,
    };
    let names = NamesOf::new(&system.devices);
    let machines = machines::resolve(root, &libraries, &names, &broken, diagnostics);
    let option_codes = errors::option_codes(root, &libraries, &names, &broken, diagnostics);
    let figures = Figures::of(root, &system, &names, &broken);
    let document = document::resolve(root, &figures, diagnostics);
    system.document = document;
    let errata = document::errata(root, &system, &names, &broken, diagnostics);
    let constraints = constraints::resolve(root, &system.devices, &broken, diagnostics);
    system.constrain(constraints);
    (system.machines, system.errata) = (machines, errata);
    for error in &mut system.errors {
        error.option_code = option_codes.get(&error.code).copied();
    }
    document::check(root, &system, &broken, diagnostics);
    issues::check(root, diagnostics);
    Resolved { system, library }
}

/// The first line of a file-wide span: enough to show where the file starts.
fn start(span: Span) -> Span {
    span.part(0, 1)
}
