//! C for CANopenNode v4: `OD.h` and `OD.c` as the stack expects them.
//!
//! Names, counters, attributes and layouts are the stack's; what it has no place for, limits, values, locks, write conditions and other views, is in
//! the extension in addition to them. The stack's own files are not needed to make these.

mod attributes;
mod cell;
mod counters;
mod custom;
mod demands;
mod docs;
mod groups;
mod header;
mod initial;
mod names;
mod node_id;
mod objects;
mod rules;
mod source;
mod tables;

use od_gen::Artifact;
use od_gen::plan::Plan;
use od_spec::diag::Diagnostics;

use self::docs::Docs;
use self::rules::Rules;
use super::text::{Text, head, header as guarded};

/// What keeps the rules: the same for every device.
const EXTENSION_H: &str = include_str!("runtime/OD_extension.h");
const EXTENSION_C: &str = include_str!("runtime/OD_extension.c");

/// The files of a device, in its folder; none of use where something is reported as an error.
pub(super) fn files(
    plan: &Plan<'_>,
    folder: &str,
    about: &dyn Fn(&str) -> String,
    diagnostics: &mut Diagnostics,
) -> Vec<Artifact> {
    let objects = objects::of_device(plan.device);
    demands::check(plan.device, &objects, diagnostics);
    let docs = Docs { plan };
    let mut text = Text::default();
    header::print(&mut text, docs, &objects);
    let header = guarded(&about("Variables and objects"), "OD_H", &text);
    let mut code = Text::default();
    head(&mut code, &about("Values and objects"));
    code.gap();
    source::print(&mut code, &objects);
    let rules = Rules::of(plan, &objects);
    demands::left_to_stack(plan.device, &rules.left_to_stack, diagnostics);
    let mut tables = Text::default();
    head(&mut tables, &about("Rules"));
    tables.gap();
    tables::print(&mut tables, plan, &rules, &node_id::left_to_the_device(plan.device), diagnostics);
    let mut settings = Text::default();
    custom::print(&mut settings, plan.device);
    let settings =
        guarded(&about("Settings of CANopenNode for the dictionary"), "CO_DRIVER_CUSTOM_H", &settings);
    let file = |name: &str, bytes: Vec<u8>, purpose: &str| Artifact {
        path: format!("{folder}/{name}"),
        bytes,
        purpose: purpose.to_owned(),
    };
    vec![
        file("OD.h", header.into_bytes(), "the dictionary for CANopenNode"),
        file("OD.c", code.into_bytes(), "the dictionary for CANopenNode: its values"),
        file("CO_driver_custom.h", settings.into_bytes(), "the configuration of CANopenNode that it needs"),
        file("OD_rules.c", tables.into_bytes(), "limits, locks and conditions for CANopenNode"),
        file("OD_extension.h", EXTENSION_H.into(), "what keeps them, for the application"),
        file("OD_extension.c", EXTENSION_C.into(), "what keeps them"),
    ]
}
