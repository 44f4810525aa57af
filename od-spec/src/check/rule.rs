//! What a rule is.

use super::findings::Findings;
use super::standard::Standard;
use super::subject::Subject;
use crate::diag::Code;
use crate::model::System;
use crate::wording::FileFormat;

/// A rule: what it is about, when it can say something, and how it looks.
pub(crate) struct Rule {
    /// Its code, with severity, explanation and example.
    pub code: &'static Code,
    /// What has to be right before.
    pub needs: Needs,
    /// How it looks.
    pub check: Check,
}

impl Rule {
    /// Whether it asks what can be set, whatever the value.
    pub(crate) const fn is_about_setting(&self) -> bool {
        matches!(self.check, Check::Settings(_))
    }
}

/// What a rule presupposes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Needs {
    /// Nothing: it looks at what is there.
    Nothing,
    /// That nothing was left out as wrong: it looks at what is missing, or at what was derived, and would blame what is only
    /// a consequence.
    Everything,
}

/// What a rule looks at.
#[derive(Clone, Copy)]
pub(crate) enum Check {
    /// What the devices share.
    System(fn(&System, &mut Findings)),
    /// The objects of a device or of a library, one by one.
    Objects(fn(&Subject<'_>, &mut Findings)),
    /// One device, as a type or as a configured node.
    Device(fn(&Subject<'_>, &mut Findings)),
    /// One configured node: what is set, and whether it can be set.
    Settings(fn(&Subject<'_>, &mut Findings)),
}

/// Some rules, with the standard that they hold objects against.
#[derive(Clone, Copy)]
pub(crate) struct Rules<'a> {
    /// The rules.
    pub list: &'a [&'a Rule],
    /// What CiA 301 says.
    pub standard: Standard,
    /// How the file that they are applied to is written, where it is not a specification.
    pub format: FileFormat,
}
