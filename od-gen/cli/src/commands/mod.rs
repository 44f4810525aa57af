//! The commands, each with its arguments.

pub(crate) mod build;
pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod concise;
pub(crate) mod dbc;
pub(crate) mod dcf;
pub(crate) mod decode;
pub(crate) mod diff;
pub(crate) mod docs;
pub(crate) mod dump;
pub(crate) mod errata;
pub(crate) mod explain;
pub(crate) mod fix;
pub(crate) mod fmt;
pub(crate) mod import;
pub(crate) mod library;
pub(crate) mod lsp;
pub(crate) mod new;
pub(crate) mod node;
pub(crate) mod params;
pub(crate) mod plant;
pub(crate) mod reference;
pub(crate) mod schema;
pub(crate) mod serve;
pub(crate) mod st;
