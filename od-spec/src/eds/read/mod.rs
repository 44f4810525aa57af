//! From the sections of an EDS or DCF to a declaration, as a specification would have made it: every text with its place, and
//! nothing invented without a word.
//!
//! A fault never stops the reader. What it cannot read it leaves out, and where something has to stand it takes what does
//! the least harm; in both cases it says so. What it gives is accepted by everything that follows.

mod comments;
mod compact;
mod device;
mod entry;
mod modules;
mod node;
mod objects;
mod value;

use super::view::View;
use crate::ast::Spec;
use crate::diag::Diagnostics;
use crate::source::{Span, Spanned};

pub(crate) use node::NodeDecl;

/// What an EDS or DCF says.
pub(crate) struct Read {
    /// The device, as a specification would describe it.
    pub spec: Spec,
    /// Of a DCF: the node.
    pub node: Option<NodeDecl>,
}

/// Reads a file under its name.
pub(crate) fn read(view: &View<'_>, name: &str, diagnostics: &mut Diagnostics) -> Read {
    let mut node = view.is_dcf.then(|| node::read(view));
    let mut meanings = comments::Meanings::default();
    let objects = objects::read(view, node.as_mut(), &mut meanings, diagnostics);
    let (units, types) = meanings.into_declarations();
    let device = device::device(view, name, &objects);
    let title = device.name.clone();
    let spec = Spec {
        file: view.file,
        span: view.start(),
        unsure: false,
        profile: None,
        title,
        languages: Vec::new(),
        source: None,
        revision: None,
        history: Vec::new(),
        vendor: Some(device::vendor(view)),
        uses: Vec::new(),
        allow: Vec::new(),
        glossary: Vec::new(),
        devices: vec![device],
        units,
        types,
        axes: None,
        features: Vec::new(),
        objects,
        pdos: Vec::new(),
        errors: Vec::new(),
        machines: Vec::new(),
        constraints: Vec::new(),
        errata: Vec::new(),
        sections: Vec::new(),
        front_end: crate::ast::FrontEnd::Eds,
    };
    Read { spec, node }
}

/// A text with the place that it follows from.
fn made(text: impl Into<String>, place: Span) -> Spanned<String> {
    Spanned::new(text.into(), place)
}

/// A text of the file.
fn owned(text: Spanned<&str>) -> Spanned<String> {
    text.map(ToOwned::to_owned)
}
