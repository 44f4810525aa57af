//! Which findings are about what which readers refuse.

use super::reader::Reader::{self, Caneds, CanopenEditor, CanopenHost, Codesys, Dcfchk, EdsUtils, NodeCanopen, PythonCanopen};
use crate::diag::Code;

/// A reader that stumbles over what a code is about, and why.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Stumbling {
    /// Who.
    pub reader: Reader,
    /// Why, in a line.
    pub reason: &'static str,
}

/// Who stumbles over what a code is about: those that were run, which not every finding of the code brings to that, and those
/// of which it is reported.
pub fn stumbling(code: &Code) -> &'static [Stumbling] {
    let at = TABLE.binary_search_by_key(&code.id, |(id, _)| id);
    at.map_or(&[], |at| TABLE[at].1)
}

const fn by(reader: Reader, reason: &'static str) -> Stumbling {
    Stumbling { reader, reason }
}

/// By code.
const TABLE: &[(&str, &[Stumbling])] = &[
];
