//! What is said about version numbers.

use super::super::{Advice, Parts, Proposal, Proposals};

/// One sentence for each number about which there is something to say.
pub(super) fn sentences(proposals: &Proposals) -> Vec<String> {
    [file(proposals.file), revision(proposals.revision)].into_iter().flatten().collect()
}

/// FileVersion and FileRevision, two keys of an EDS.
fn file(proposal: Proposal) -> Option<String> {
    let from = proposal.old;
    let raise = |to: Parts| {
        if to.0 == from.0 {
            format!("FileRevision {} → {}", from.1, to.1)
        } else {
            format!("FileVersion {} → {}, FileRevision {}", from.0, to.0, to.1)
        }
    };
    Some(match proposal.advice {
        Advice::Keep => return None,
        Advice::Raised => format!("{}; the new file has it", raise(proposal.new)),
        Advice::Raise(to) => raise(to),
        Advice::RaiseFirst(to) => format!("{}, as FileRevision {} is the largest", raise(to), from.1),
        Advice::UsedUp => format!("FileVersion stays, as {} is the largest", from.0),
    })
}

/// RevisionNumber (1018h.3), one number of two halves.
fn revision(proposal: Proposal) -> Option<String> {
    let shown = |(major, minor): Parts| format!("{major}.{minor} (0x{major:04X}{minor:04X})");
    let from = proposal.old;
    let raise = |to: Parts| format!("RevisionNumber {}.{} → {}", from.0, from.1, shown(to));
    Some(match proposal.advice {
        Advice::Keep => return None,
        Advice::Raised => format!("{}; the new file has it", raise(proposal.new)),
        Advice::Raise(to) => raise(to),
        Advice::RaiseFirst(to) => format!("{}, as the minor part {} is the largest", raise(to), from.1),
        Advice::UsedUp => {
            format!("RevisionNumber stays, as its major part {} is the largest", from.0)
        }
    })
}
