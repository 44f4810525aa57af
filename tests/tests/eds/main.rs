//! EDS, DCF, XDD and XDC files: read, checked, fixed, imported.

mod foreign;
mod format_rules;
mod front_end;
mod told_once;
mod xdd;
