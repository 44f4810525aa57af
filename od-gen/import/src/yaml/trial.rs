//! The two compilations of a specification: one sees what the language refuses, the other proves the text that is given.

use std::collections::BTreeSet;

use od_spec::diag::{Diagnostic, Diagnostics, Severity};
use od_spec::model::Dictionary;
use od_spec::source::{FileId, SourceMap};
use od_spec::{NoFiles, compile};

use super::context::Style;
use super::emit::Written;
use super::mend::Draft;
use super::node::Spot;
use super::options::Options;
use super::remarks::{Remarks, Repair};
use super::{compare, follow, shortest, text};

/// The text of a draft, and the model that its plain form gives.
///
/// The first compilation sees which rules are broken, and what the language refuses. The second one proves the short text; or,
/// where something was refused, the plain text of what is left. A plain text that was compiled needs no other proof when its
/// list of allowed rules becomes shorter.
pub(super) fn proven(
    draft: &mut Draft,
    options: &Options,
    remarks: &mut Remarks,
) -> Result<(String, Dictionary), Diagnostics> {
    let [first, second] = Trial::both();
    let mut plain = first.of_plain(draft, options, remarks);
    let mut short = None;
    if let Some(found) = &plain.found {
        plain.note_broken_rules(remarks);
        follow(&mut draft.device, found);
        let tried = second.of(draft, options, remarks, &shortest(draft, remarks));
        let is_same = tried.found.is_some_and(|it| compare::differing(found, &it).is_empty());
        short = is_same.then_some(tried.written.text);
    } else {
        remarks.repairs.extend(plain.mend(draft));
        plain = second.of_plain(draft, options, remarks);
        plain.note_broken_rules(remarks);
    }
    let found = plain.found.ok_or(plain.diagnostics)?;
    let in_full = || text::write(&draft.system, &draft.device, options, remarks, &Style::default()).text;
    Ok((short.unwrap_or_else(in_full), found))
}

/// Leave to compile one text. A specification has two of them.
struct Trial(());

impl Trial {
    const fn both() -> [Self; 2] {
        [Self(()), Self(())]
    }

    /// What a device in a style gives.
    fn of(self, draft: &Draft, options: &Options, remarks: &Remarks, style: &Style) -> Tried {
        let Self(()) = self;
        let written = text::write(&draft.system, &draft.device, options, remarks, style);
        let mut sources = SourceMap::new();
        let root = sources.add("specification.od.yaml", written.text.as_str());
        let compiled = compile(&mut sources, root, &mut NoFiles);
        let found = compiled.system.and_then(|mut system| system.devices.pop());
        Tried { written, root, found, diagnostics: compiled.diagnostics }
    }

    /// The plain text. Every rule may be broken, so that all that are broken are found.
    fn of_plain(self, draft: &Draft, options: &Options, remarks: &Remarks) -> Tried {
        self.of(draft, options, &remarks.with_all_rules_allowed(), &Style::default())
    }
}

/// A text that was compiled.
struct Tried {
    written: Written,
    root: FileId,
    /// The model of its device.
    found: Option<Dictionary>,
    diagnostics: Diagnostics,
}

impl Tried {
    /// What a message is about: the text, and what it says.
    fn spot(&self, finding: &Diagnostic) -> Option<(&str, Spot)> {
        let place = finding.labels.first().filter(|label| label.span.file == self.root)?.span;
        let (range, spot) = self.written.spot(usize::try_from(place.start).ok()?)?;
        Some((self.written.text.get(range.clone())?, *spot))
    }

    /// Notes the rules that the device breaks.
    fn note_broken_rules(&self, remarks: &mut Remarks) {
        for finding in &self.diagnostics {
            remarks.allow(finding, self.spot(finding).map(|(_, spot)| spot));
        }
    }

    /// Changes the model where the language refuses it.
    fn mend(&self, draft: &mut Draft) -> Vec<Repair> {
        let errors = self.diagnostics.iter().filter(|one| one.severity() == Severity::Error);
        // Of several messages about one place, the first may take the others with it.
        let mut mended: BTreeSet<Spot> = BTreeSet::new();
        let repair = |error: &Diagnostic| {
            let (text, spot) = self.spot(error).filter(|(_, spot)| mended.insert(*spot))?;
            draft.mend(text, spot, error)
        };
        errors.filter_map(repair).collect()
    }
}
