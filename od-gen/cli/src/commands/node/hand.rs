//! Writes that the user interrupts: the step in hand is finished, and what is not sent any more is reported.

use std::collections::BTreeSet;

use od_bus::client::{Bus, Client};
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::{EntryId, Index, Role, SubIndex};

use super::Target;
use crate::exit::INTERRUPTED;
use crate::interrupt::Interrupt;
use crate::report::Report;

/// What goes on after an interrupt.
pub(super) struct InHand<'i> {
    interrupt: &'i Interrupt,
    /// PDOs of which a parameter was sent.
    begun: BTreeSet<Index>,
    /// COB-IDs with which a PDO was switched off.
    off: BTreeSet<EntryId>,
    unsent: Vec<EntryId>,
}

impl<'i> InHand<'i> {
    pub(super) const fn new(interrupt: &'i Interrupt) -> Self {
        Self { interrupt, begun: BTreeSet::new(), off: BTreeSet::new(), unsent: Vec::new() }
    }

    /// Whether an entry is still to be written. After an interrupt only what completes a PDO is: it was switched off first.
    pub(super) fn takes(&mut self, id: EntryId) -> bool {
        let pdo = pdo_of(id.index);
        let goes_on = !self.interrupt.is_wanted() || pdo.is_some_and(|pdo| self.begun.contains(&pdo));
        if goes_on {
            self.begun.extend(pdo);
        } else {
            self.unsent.push(id);
        }
        goes_on
    }

    /// Notes that a node has taken a value.
    pub(super) fn wrote(&mut self, id: EntryId, bytes: &[u8]) {
        if pdo_of(id.index) != Some(id.index) || id.sub != SubIndex(1) {
            return;
        }
        if bytes.last().is_some_and(|byte| byte & 0x80 != 0) {
            self.off.insert(id);
        } else {
            self.off.remove(&id);
        }
    }

    /// Names the PDOs that are off, unless their node has started again, because the rest of their parameters was not sent.
    pub(super) fn tell_left_off<B: Bus>(
        &self,
        client: &mut Client<B>,
        target: Target<'_>,
        missing: &BTreeSet<EntryId>,
        report: &Report,
    ) {
        if client.restarted(target.id).is_ok_and(|restart| restart.is_some()) {
            return;
        }
        for id in self.off.intersection(missing) {
            report.note(&format!(
                "{}switched off and not switched on again: {}",
                target.mark(),
                target.words().entry(*id)
            ));
        }
    }

    /// Names what is not sent any more, and the PDOs that are off for that reason.
    pub(super) fn tell_unsent<B: Bus>(
        &self,
        client: &mut Client<B>,
        target: Target<'_>,
        unsent: &[EntryId],
        report: &Report,
    ) {
        for id in unsent {
            report.note(&format!("{}not sent any more: {}", target.mark(), target.words().entry(*id)));
        }
        self.tell_left_off(client, target, &unsent.iter().copied().collect(), report);
    }

    /// Says what was not sent; the exit code where that is anything.
    pub(super) fn end<B: Bus>(
        &self,
        client: &mut Client<B>,
        target: Target<'_>,
        report: &Report,
    ) -> Result<(), u8> {
        if self.unsent.is_empty() {
            return Ok(());
        }
        self.tell_unsent(client, target, &self.unsent, report);
        let message = format!("{}: interrupted before all was sent", target.name());
        report.refuse(
            Diagnostic::without_place(codes::ACCESS_FAILED, message)
                .help("give the command again; what is written already is not written twice by `restore`"),
        );
        Err(INTERRUPTED)
    }
}

/// The PDO that an object is a parameter of, by the index of its communication parameters; mappings are 200h after
/// them.
pub(super) fn pdo_of(index: Index) -> Option<Index> {
    Role::of(index).is_pdo_parameter().then_some(Index(index.0 & !0x200))
}
