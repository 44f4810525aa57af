//! Nodes get the values of parameter files. All are asked and judged before the first is written to.

use std::collections::BTreeSet;

use od_bus::client::{Bus, Client, involved, judged, kept, plan};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::{EntryId, Index, Role, Write};
use od_spec::source::{SourceMap, Span};
use od_spec::{Assigned, Commissioning, assign_layers, rule_codes};

use super::args::NodeRestoreArgs;
use super::beside::{Beside, shown_errors, told_differences};
use super::confirm::{Change, preview};
use super::doubt::{Presence, Untaken, Unwritten, sent};
use super::had::{Had, had, values, words};
use super::hand::{InHand, pdo_of};
use super::hint::command;
use super::outcome::{Outcome, State, worse};
use super::{Target, is_meant, on_the_bus};
use crate::exit::{ERRORS, INTERRUPTED, SUCCESS};
use crate::interrupt::Interrupt;
use crate::report::{Report, print, shown};

/// What a node is to get.
struct Planned<'b, 'a> {
    beside: &'b Beside<'a>,
    writes: Vec<Write>,
    changes: Vec<Change>,
}

/// Gives nodes what their files set; what became of each. Nothing is sent before each of them is known to be the one that is meant, its
/// writes are judged by what it has, all of them are shown, and the user has agreed.
pub(super) fn restored<'a, B: Bus>(
    client: &mut Client<B>,
    args: &NodeRestoreArgs,
    all: &[Beside<'a>],
    report: &Report,
) -> Result<Vec<Outcome<'a>>, u8> {
    let mut plans: Vec<Result<Planned<'_, 'a>, u8>> = Vec::new();
    for beside in all {
        let is_meant = is_meant(client, &args.file.node, beside.target, report);
        plans.push(is_meant.and_then(|()| planned(client, beside, report)));
    }
    // One that starts again while others are asked has other values than those that were judged.
    for plan in &mut plans {
        if let Ok(Planned { beside, .. }) = plan
            && let Err(code) = beside.target.has_started(client, report)
        {
            *plan = Err(code);
        }
    }
    let of_plan = |plan: &Planned<'_, '_>| {
        let target = plan.beside.target;
        preview(target, &plan.changes, &command("store", &args.file.spec, target, &args.file.node))
    };
    let about: String = plans.iter().flatten().map(of_plan).collect();
    if plans.iter().any(Result::is_err) {
        let printed = print(&about);
        return Ok(left_alone(all, &plans, printed, report));
    }
    let plans: Vec<Planned<'_, '_>> = plans.into_iter().flatten().collect();
    let (interrupt, mut outcomes) = (Interrupt::noted_with_hangup(), Vec::new());
    if let Some(question) = question(&plans) {
        args.confirm.ask(&about, &question, &interrupt, report)?;
    }
    for plan in &plans {
        let target = plan.beside.target;
        if interrupt.is_wanted() {
            outcomes.push(Outcome::untouched(target, INTERRUPTED, State::NotDone));
            continue;
        }
        if let Err(code) = target.has_started(client, report) {
            outcomes.push(Outcome::untouched(target, code, State::Started));
            continue;
        }
        let before = client.writes();
        let code = carried_out(client, plan, &interrupt, report).unwrap_or_else(|code| code);
        outcomes.push(Outcome::after(target, code, client.writes() - before));
    }
    Ok(outcomes)
}

/// What became of nodes of which one cannot get its values: nothing.
fn left_alone<'a>(
    all: &[Beside<'a>],
    plans: &[Result<Planned<'_, 'a>, u8>],
    printed: u8,
    report: &Report,
) -> Vec<Outcome<'a>> {
    let outcome = |(beside, plan): (&Beside<'a>, &Result<Planned<'_, 'a>, u8>)| {
        let (code, state) = match plan {
            Ok(_) => (ERRORS, State::NotDone),
            Err(code) => (*code, State::Unfit),
        };
        Outcome::untouched(beside.target, worse(code, printed), state)
    };
    let outcomes: Vec<Outcome<'a>> = all.iter().zip(plans).map(outcome).collect();
    let unfit: Vec<String> = outcomes
        .iter()
        .filter(|outcome| outcome.state == State::Unfit)
        .map(|outcome| format!("--skip {}", outcome.target.id))
        .collect();
    if unfit.len() < outcomes.len() {
        let skip = unfit.join(" ");
        report.note(&format!(
            "nothing was sent to any node, because not every node can be restored; `{skip}` restores the others"
        ));
    }
    outcomes
}

/// `write 3 values of pmc (node 5)`; nothing where there is nothing to write.
fn question(plans: &[Planned<'_, '_>]) -> Option<String> {
    let writing: Vec<&Planned<'_, '_>> = plans.iter().filter(|plan| !plan.writes.is_empty()).collect();
    let count = values(writing.iter().map(|plan| plan.changes.len()).sum());
    match writing.as_slice() {
        [] => None,
        [only] => Some(format!("write {count} of {}", only.beside.target.name())),
        several => Some(format!("write {count} of {} nodes", several.len())),
    }
}

/// Reads what a node has, and judges what its file sets by that.
fn planned<'b, 'a, B: Bus>(
    client: &mut Client<B>,
    beside: &'b Beside<'a>,
    report: &Report,
) -> Result<Planned<'b, 'a>, u8> {
    let Beside { target, sources, layers, meant, .. } = beside;
    let target = *target;
    let written_ids: BTreeSet<EntryId> = meant.keys().copied().collect();
    let asked_for = judged(target.system, target.device, &written_ids);
    let ids: BTreeSet<EntryId> =
        kept(target.device).chain(written_ids).chain(asked_for.iter().copied()).collect();
    let before = had(client, target, ids, None, report)?;
    // What the file does not set stays as the node has it, and rules look at that.
    before.tell_taken_for_default(target, &asked_for, report);
    let mut now = Commissioning::of_node(target.device, target.id);
    now.values.clone_from(&before.values);
    let mut diagnostics = Diagnostics::new();
    let of_node = now.configured(target.device);
    let assigned = assign_layers(target.system, &of_node, target.id, layers, &mut diagnostics);
    if on_the_bus(&diagnostics, &[]).has_errors() {
        report.note(&format!(
            "{}nothing was written; with what the node has in addition to the values of the file:",
            target.mark()
        ));
        shown_errors(&diagnostics, sources, report)?;
    }
    let writes =
        plan(target.system, target.device, target.id, &before.values, meant).map_err(|no_value| {
            let diagnostic = Diagnostic::without_place(rule_codes::VALUE_DOES_NOT_FIT, no_value.to_string());
            report.refuse(diagnostic.help("correct the value"))
        })?;
    shown_errors(&about_writes(&diagnostics, sources, &assigned, &writes), sources, report)?;
    for write in writes.iter().filter(|write| assigned.unlocked.contains(&write.id)) {
        report.note(&format!(
            "{}LOCKED {}: the device takes it only while it is unlocked for service",
            target.mark(),
            target.words().entry(write.id)
        ));
    }
    let changes = changes(target, &before, &writes);
    Ok(Planned { beside, writes, changes })
}

/// Writes to a node what is planned, and reads back all that its file sets.
fn carried_out<B: Bus>(
    client: &mut Client<B>,
    plan: &Planned<'_, '_>,
    interrupt: &Interrupt,
    report: &Report,
) -> Result<u8, u8> {
    let Beside { target, file, meant, .. } = plan.beside;
    let target = *target;
    let code = written(client, target, &plan.writes, interrupt, report)?;
    let after = had(client, target, meant.keys().copied(), None, report)?;
    let (count, unread) = told_differences(target, meant, &after, report);
    let code = code.max(unread);
    if count > 0 {
        let has = if count == 1 { "has" } else { "have" };
        let message = format!("{}: {} of the file {has} not come back", target.name(), values(count));
        return Ok(code.max(
            report.refuse(
                Diagnostic::without_place(codes::ACCESS_FAILED, message)
                    .help("see above what the node has in their place"),
            ),
        ));
    }
    let held = values(meant.len());
    let line = format!("  {}  {held} read back as in {}\n", target.name(), shown(file));
    Ok(if code == SUCCESS { print(&line) } else { code })
}

/// What some writes change: of an entry that is written twice, as that of a PDO which is switched off and on, the last.
fn changes(target: Target<'_>, before: &Had, writes: &[Write]) -> Vec<Change> {
    let mut last: Vec<Change> = Vec::new();
    for write in writes {
        let old = before.values.get(&write.id).map(|old| words(target, write.id, old));
        let new = target.words().value(write.id, &write.bytes);
        last.retain(|change| change.id != write.id);
        last.push(Change { id: write.id, old, new });
    }
    last.retain(|change| change.old.as_ref() != Some(&change.new));
    last
}

/// What a check says, but of values that the node has already and that are not written.
fn about_writes(
    found: &Diagnostics,
    sources: &SourceMap,
    assigned: &Assigned,
    writes: &[Write],
) -> Diagnostics {
    let line = |span: Span| (span.file, sources.file(span.file).line_col(span.start).line);
    let written: BTreeSet<EntryId> = writes.iter().map(|write| write.id).collect();
    let unwritten = assigned.origins.iter().filter(|(id, _)| !written.contains(id));
    let unwritten: BTreeSet<_> = unwritten.map(|(_, origin)| line(origin.span)).collect();
    let mut reported = Diagnostics::new();
    for one in found {
        if !one.labels.first().is_some_and(|label| unwritten.contains(&line(label.span))) {
            reported.push(one.clone());
        }
    }
    reported
}

/// What must not be written any more, as a node has refused something that belongs with it.
struct HeldBack<'a> {
    target: Target<'a>,
    /// What was refused, or held back itself.
    first: BTreeSet<EntryId>,
    /// What conditions join with that.
    joined: BTreeSet<EntryId>,
}

impl HeldBack<'_> {
    fn add(&mut self, id: EntryId) {
        self.first.insert(id);
        self.joined.extend(involved(self.target.system, self.target.device, &BTreeSet::from([id])));
    }

    /// A value together with one that did not come may break a condition, or switch on a PDO that carries something
    /// else; and what is not whole must not be stored.
    fn has(&self, id: EntryId) -> bool {
        let keeps = Role::of(id.index) == Role::StoreParameters || id.index == CONFIGURATION_DATE;
        let is_of_same_pdo =
            |one: &EntryId| pdo_of(one.index).is_some() && pdo_of(one.index) == pdo_of(id.index);
        self.joined.contains(&id)
            || self.first.iter().any(is_of_same_pdo)
            || (keeps && !self.first.is_empty())
    }
}

/// Verify configuration (1020h): what a configuration tool leaves when everything is written.
const CONFIGURATION_DATE: Index = Index(0x1020);

/// Carries out writes. One that is refused is reported, and of the next ones those are tried that have nothing to do
/// with it; the exit code where the node is gone.
fn written<B: Bus>(
    client: &mut Client<B>,
    target: Target<'_>,
    writes: &[Write],
    interrupt: &Interrupt,
    report: &Report,
) -> Result<u8, u8> {
    let (mut code, mut in_hand) = (SUCCESS, InHand::new(interrupt));
    let mut held_back = HeldBack { target, first: BTreeSet::new(), joined: BTreeSet::new() };
    for (at, write) in writes.iter().enumerate() {
        if held_back.has(write.id) {
            let name = target.words().entry(write.id);
            let mark = target.mark();
            report.note(&format!("{mark}not sent, as it belongs with what was refused: {name}"));
            held_back.add(write.id);
            continue;
        }
        if !in_hand.takes(write.id) {
            continue;
        }
        match sent(client, target, write.id, &write.bytes, Untaken::WrittenAgain, report) {
            Ok(()) => {
                in_hand.wrote(write.id, &write.bytes);
                let line = super::access::line(target, write.id, &write.bytes);
                code = code.max(print(&format!("{}{line}  written\n", target.mark())));
            }
            Err(Unwritten { why, node }) => {
                code = code.max(report.refuse(*why));
                held_back.add(write.id);
                if node == Presence::Gone {
                    let unsent: Vec<EntryId> = writes.iter().skip(at + 1).map(|write| write.id).collect();
                    in_hand.tell_unsent(client, target, &unsent, report);
                    return Err(code);
                }
            }
        }
    }
    in_hand.tell_left_off(client, target, &held_back.first, report);
    in_hand.end(client, target, report).map(|()| code)
}
