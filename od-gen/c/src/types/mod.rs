//! `OD_types.h`: what the numbers of a dictionary mean. Macros and types only, so that any C takes it.

mod machines;
mod values;

use od_gen::facts;
use od_gen::plan::{Condition, PlannedConstraint, PlannedError};
use od_spec::model::ErrorCode;

use super::literal::Integer;
use super::page::Page;

/// The name of the file, in addition to the dictionary's.
pub(super) const FILE: &str = "OD_types.h";

/// What is between the lines that keep the file from being read twice.
pub(super) fn print(page: &mut Page<'_, '_>) {
    page.text.line("#include <stdint.h>");
    values::named_types(page);
    values::units(page);
    values::specials(page);
    machines::machines(page);
    errors(page);
    constraints(page);
}

/// A heading of a part of the file.
fn heading(page: &mut Page<'_, '_>, text: &str) {
    page.text.gap();
    page.text.comment(text);
    page.text.gap();
}

fn errors(page: &mut Page<'_, '_>) {
    let plan = page.plan;
    if plan.errors.is_empty() {
        return;
    }
    heading(page, "Error codes, as emergency messages, 1003h and 603Fh carry them.");
    let code_type = Integer { signed: false, bits: 16 };
    for PlannedError { name, error, .. } in &plan.errors {
        let about = facts::error(plan, error, str::to_owned);
        let about =
            if error.code == ErrorCode::NONE { about } else { format!("{:04X}h: {about}", error.code) };
        let value = code_type.pattern(error.code.into(), 16);
        page.text.doc(&about);
        page.define(&["ERROR", name], &value, &format!("error {:04X}h", error.code));
    }
}

/// Conditions that firmware keeps between its entries, for readers of the code.
fn constraints(page: &mut Page<'_, '_>) {
    let plan = page.plan;
    if plan.constraints.is_empty() {
        return;
    }
    page.text.gap();
    let mut lines = vec!["Conditions between entries:".to_owned()];
    for PlannedConstraint { name, about, when, require, .. } in &plan.constraints {
        let when = when.as_ref().map(|Condition { text, .. }| format!(" while {text}")).unwrap_or_default();
        let about = match page.words(about) {
            "" => String::new(),
            about => format!(" ({about})"),
        };
        lines.push(format!("- {name}: {}{when}{about}", require.text));
    }
    page.text.comment(&lines.join("\n"));
}
