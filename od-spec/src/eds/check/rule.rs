//! What a rule over a text is.

use crate::diag::{Code, Diagnostics};
use crate::eds::view::View;

/// A rule over the text of an EDS or DCF: it sees sections, keys and lines, and knows nothing of a model.
pub(crate) struct FormatRule {
    /// Its code, with severity, explanation and example.
    pub code: &'static Code,
    /// How it looks.
    pub check: fn(&View<'_>, &mut Diagnostics),
}
