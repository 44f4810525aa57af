//! What to do about a finding, in the words of the reader who can do it: the author of a specification knows
//! `default:`, the owner of an EDS `DefaultValue`, and a user who sets a value of a node can change neither. Where one
//! sentence is right for all of them, a rule says that one.

use super::subject::Subject;
use crate::model::SystemSource;

/// One help for each reader.
#[derive(Clone, Copy)]
pub(super) struct Help<'t> {
    /// For the author of a specification.
    pub specification: &'t str,
    /// For the owner of an EDS, or of a DCF whose defaults are meant.
    pub eds: &'t str,
    /// For a user who sets a value of a node: next to a specification or an EDS, or in a DCF.
    pub setting: &'t str,
}

impl Subject<'_> {
    /// The help for the reader of a finding about this subject.
    pub(super) fn help(&self, help: Help<'_>) -> String {
        let text = match (self.node, self.system.source) {
            (Some(_), _) => help.setting,
            (None, SystemSource::Specification) => help.specification,
            (None, SystemSource::Eds) => help.eds,
        };
        text.to_owned()
    }
}
