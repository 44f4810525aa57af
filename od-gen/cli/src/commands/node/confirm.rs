//! What a command is about to do to a node, and whether it may.

use std::fmt::Write as _;
use std::io::{self, BufRead as _, IsTerminal as _, Write as _};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use clap::Args;
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::{EntryId, Storage, SystemSource};

use super::Target;
use crate::exit::{ERRORS, INTERRUPTED, SUCCESS, USAGE};
use crate::interrupt::Interrupt;
use crate::report::{Report, print};

/// How a command is allowed to change a node.
#[derive(Debug, Args)]
pub(crate) struct ConfirmArgs {
    /// Do it without a question, as in a script
    #[arg(long)]
    pub yes: bool,

    /// Show what would be done, and do nothing
    #[arg(long, conflicts_with = "yes")]
    pub dry_run: bool,
}

impl ConfirmArgs {
    /// Shows what is about to be done and asks for it; the exit code where it is not to be done.
    pub(super) fn ask(
        &self,
        about: &str,
        question: &str,
        interrupt: &Interrupt,
        report: &Report,
    ) -> Result<(), u8> {
        let code = print(about);
        if code != SUCCESS {
            report.note("nothing was sent, because what would be changed cannot be shown");
            return Err(code);
        }
        if self.yes {
            return Ok(());
        }
        if self.dry_run {
            report.note("`--dry-run`: nothing was sent");
            return Err(SUCCESS);
        }
        if !io::stdin().is_terminal() || !io::stderr().is_terminal() {
            let message = format!("nothing was sent, as there is no terminal at which to ask: {question}?");
            report.refuse(
                Diagnostic::without_place(codes::NO_TERMINAL, message)
                    .help("add `--yes` to do it without a question, `--dry-run` to see what would be done"),
            );
            return Err(USAGE);
        }
        let answer = write!(io::stderr(), "{question}? [y/N] ").ok().and_then(|()| answer(interrupt));
        if interrupt.is_wanted() {
            // The question has no end of its line.
            let _ = writeln!(io::stderr());
            report.note("interrupted: nothing was sent");
            return Err(INTERRUPTED);
        }
        if answer.is_some_and(|answer| matches!(answer.trim(), "y" | "Y" | "yes")) {
            return Ok(());
        }
        report.note("nothing was sent");
        Err(ERRORS)
    }
}

/// Between two looks whether the user has interrupted the question.
const LOOK: Duration = Duration::from_millis(20);

/// What the user types; `None` at an interrupt. A signal does not end reading, so another thread reads.
fn answer(interrupt: &Interrupt) -> Option<String> {
    let (typed, answers) = mpsc::channel();
    thread::spawn(move || {
        let mut line = String::new();
        let read = io::stdin().lock().read_line(&mut line);
        let _ = typed.send(read.ok().map(|_| line));
    });
    loop {
        match answers.recv_timeout(LOOK) {
            Ok(answer) => return answer,
            Err(RecvTimeoutError::Timeout) if !interrupt.is_wanted() => {}
            Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => return None,
        }
    }
}

/// A value that is about to be written.
pub(super) struct Change {
    pub(super) id: EntryId,
    /// What the node has now, in words, where it reports it.
    pub(super) old: Option<String>,
    pub(super) new: String,
}

/// So many entries are named in a line about what outlasts a reset.
const NAMED: usize = 4;

/// What is about to be written to a node: each value as it is and as it will be, with the warnings of its entry; and what will not
/// outlast a reset, with the command `store` that prevents it.
pub(super) fn preview(target: Target<'_>, changes: &[Change], store: &str) -> String {
    let mut text = String::new();
    for change in changes {
        let name = target.words().entry(change.id);
        let old = change.old.as_deref().unwrap_or("unknown");
        let _ = writeln!(text, "{}{name}: {old} → {}", target.mark(), change.new);
        let of_object = target.device.objects.get(&change.id.index).map(|object| &object.warning);
        let of_entry = target.device.entry(change.id).map(|entry| &entry.warning);
        let mut warnings: Vec<&str> =
            of_object.into_iter().chain(of_entry).filter_map(|text| text.get("en")).collect();
        warnings.dedup();
        for warning in warnings {
            let _ = writeln!(text, "    warning: {}", warning.trim());
        }
    }
    // An EDS does not say what a device stores.
    if target.system.source == SystemSource::Specification {
        let kept_by = |storage: fn(Storage) -> bool| {
            let is_so = |id: EntryId| target.device.entry(id).is_some_and(|entry| storage(entry.stored));
            let mut ids: Vec<EntryId> = Vec::new();
            for id in changes.iter().map(|change| change.id).filter(|id| is_so(*id)) {
                if !ids.contains(&id) {
                    ids.push(id);
                }
            }
            ids
        };
        let lost = kept_by(|stored| stored == Storage::No);
        let on_command = kept_by(|stored| !matches!(stored, Storage::No | Storage::Remanent));
        if !lost.is_empty() {
            let _ = writeln!(text, "{}lost with a reset: {}", target.mark(), named(target, &lost));
        }
        if !on_command.is_empty() {
            let _ = writeln!(
                text,
                "{}lost with a reset unless stored (`{store}`): {}",
                target.mark(),
                named(target, &on_command)
            );
        }
    }
    text
}

/// The first entries by name, and how many more there are.
fn named(target: Target<'_>, ids: &[EntryId]) -> String {
    let names: Vec<String> = ids.iter().take(NAMED).map(|id| target.words().entry(*id)).collect();
    let more = ids.len().saturating_sub(NAMED);
    let more = if more > 0 { format!(", and {more} more") } else { String::new() };
    format!("{}{more}", names.join(", "))
}
