//! State machines: the patterns by which a status word shows states, and those by which a control word gives commands.

use od_gen::plan::{PlannedEntry, PlannedMachine};
use od_spec::model::BitPattern;

use super::super::literal::Integer;
use super::super::page::Page;
use super::heading;

pub(super) fn machines(page: &mut Page<'_, '_>) {
    let plan = page.plan;
    if plan.machines.is_empty() {
        return;
    }
    heading(
        page,
        "State machines: a word shows a state, or gives a command, where (word & MASK) == VALUE. Of a command that edges give, \
         VALUE has the level after the edge, RISING and FALLING have the bits that must change. SEND is a word that gives it.",
    );
    for planned in &plan.machines {
        let (Some(status), Some(command)) = (plan.entry(planned.status), plan.entry(planned.command)) else {
            continue;
        };
        states(page, planned, status);
        commands(page, planned, command);
    }
}

fn states(page: &mut Page<'_, '_>, planned: &PlannedMachine<'_>, status: &PlannedEntry<'_>) {
    let machine = planned.machine;
    let Some(carrier) = Integer::of(status.entry.data_type) else { return };
    for (name, state) in planned.states.iter().zip(&machine.states) {
        let what = format!("state `{}` of `{}`", state.name, machine.name);
        let about = page
            .about(&format!("State of the {}, in {}: {}", machine.name, status.id, state.name), &state.about);
        let of = [planned.name.as_str(), "STATE", name.as_str()];
        pattern(page, of, &state.pattern, carrier, &what, &about);
    }
}

fn commands(page: &mut Page<'_, '_>, planned: &PlannedMachine<'_>, word: &PlannedEntry<'_>) {
    let machine = planned.machine;
    let Some(carrier) = Integer::of(word.entry.data_type) else { return };
    for (name, command) in planned.commands.iter().zip(&machine.commands) {
        let what = format!("command `{}` of `{}`", command.name, machine.name);
        let about = page.about(
            &format!("Command to the {}, in {}: {}", machine.name, word.id, command.name),
            &command.about,
        );
        let of = [planned.name.as_str(), "COMMAND", name.as_str()];
        pattern(page, of, &command.pattern, carrier, &what, &about);
        let (rising, falling) = command.pattern.edges();
        let bits = width(&command.pattern);
        for (bits_that, mask) in [("RISING", rising), ("FALLING", falling)] {
            if mask != 0 {
                let parts = [of[0], of[1], of[2], bits_that];
                page.define(&parts, &carrier.pattern(mask, bits), &what);
            }
        }
        if let Some(send) = command.send {
            let parts = [of[0], of[1], of[2], "SEND"];
            page.define(&parts, &carrier.pattern(send.into(), bits), &what);
        }
    }
}

fn pattern(
    page: &mut Page<'_, '_>,
    of: [&str; 3],
    pattern: &BitPattern,
    carrier: Integer,
    what: &str,
    about: &str,
) {
    let ((mask, value), bits) = (pattern.mask_and_value(), width(pattern));
    let [machine, kind, name] = of;
    page.text.gap();
    page.text.doc(about);
    page.define(&[machine, kind, name, "MASK"], &carrier.pattern(mask, bits), what);
    page.define(&[machine, kind, name, "VALUE"], &carrier.pattern(value, bits), what);
}

/// Bits of the word.
fn width(pattern: &BitPattern) -> u8 {
    u8::try_from(pattern.0.len()).unwrap_or(64)
}
