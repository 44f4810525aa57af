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
mod domains;
mod groups;
mod header;
mod initial;
mod names;
mod node_id;
mod objects;
mod rules;
mod source;
mod srdos;
mod tables;

use od_gen::Artifact;
use od_gen::plan::Plan;
use od_spec::diag::Diagnostics;
use od_spec::model::Dictionary;

use self::docs::Docs;
use self::rules::Rules;
use self::srdos::Srdos;
use super::prefix::Prefix;
use super::text::{Text, head, header as guarded};

/// What keeps the rules: the same for every device.
const EXTENSION_H: &str = include_str!("runtime/OD_extension.h");
const EXTENSION_C: &str = include_str!("runtime/OD_extension.c");

/// The files of a device, in its folder, with the names that it has before the plan's; none of use where something is reported as an error.
pub(super) fn files(
    plan: &Plan<'_>,
    named: &Dictionary,
    folder: &str,
    prefix: &Prefix,
    about: &dyn Fn(&str) -> String,
    diagnostics: &mut Diagnostics,
) -> Vec<Artifact> {
    let srdos = Srdos::of(plan.device);
    let objects = objects::of_device(plan.device, named, &srdos);
    demands::check(plan.device, &objects, &srdos, diagnostics);
    let docs = Docs { plan };
    let rules = Rules::of(plan, &objects);
    demands::left_to_stack(plan.device, &rules.left_to_stack, diagnostics);
    let mut text = Text::default();
    header::print(&mut text, docs, prefix, &objects, &rules);
    let header = guarded(&about("Variables and objects"), &format!("{prefix}_H"), &text);
    let mut code = Text::default();
    head(&mut code, &about("Values and objects"));
    code.gap();
    source::print(&mut code, plan.device, prefix, &objects);
    let mut tables = Text::with_prefix(prefix);
    head(&mut tables, &about("Rules"));
    tables.gap();
    tables::print(&mut tables, plan, &rules, &node_id::left_to_the_device(plan.device), diagnostics);
    let mut settings = Text::default();
    custom::print(&mut settings, plan.device, prefix, &rules);
    let guard = if prefix.is_usual() {
        "CO_DRIVER_CUSTOM_H".to_owned()
    } else {
        format!("{prefix}_CO_DRIVER_CUSTOM_H")
    };
    let settings = guarded(&about("Settings of CANopenNode for the dictionary"), &guard, &settings);
    let file = |name: &str, bytes: Vec<u8>, purpose: &str| Artifact {
        path: format!("{folder}/{name}"),
        bytes,
        purpose: purpose.to_owned(),
    };
    let name = |rest: &str| format!("{prefix}{rest}");
    let mut start = Text::default();
    head(&mut start, &about("What reads and writes the DOMAINs"));
    start.gap();
    let has_domains = domains::print(&mut start, prefix, &objects);
    let mut files = vec![
        file(&name(".h"), header.into_bytes(), "the dictionary for CANopenNode"),
        file(&name(".c"), code.into_bytes(), "the dictionary for CANopenNode: its values"),
        file("CO_driver_custom.h", settings.into_bytes(), "the configuration of CANopenNode that it needs"),
        file(&name("_rules.c"), tables.into_bytes(), "limits, locks and conditions for CANopenNode"),
        file(
            &name("_extension.h"),
            prefix.in_text(EXTENSION_H).into_bytes(),
            "what keeps them, for the application",
        ),
        file(&name("_extension.c"), prefix.in_text(EXTENSION_C).into_bytes(), "what keeps them"),
    ];
    if has_domains {
        let purpose = "a start for what reads and writes DOMAINs: to be copied";
        files.push(file(&name("_domains.c.txt"), start.into_bytes(), purpose));
    }
    files
}
