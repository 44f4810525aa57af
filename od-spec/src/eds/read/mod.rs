//! From the sections of an EDS or DCF to a declaration, as a specification would have made it: every text with its place, and
//! nothing invented without a word.
//!
//! A fault never stops the reader. What it cannot read it leaves out, and where something has to be it takes what does
//! the least harm; in both cases it says so. What it gives is accepted by everything that follows.

mod channels;
mod comments;
mod compact;
mod device;
mod editor;
mod entry;
mod form;
mod further;
mod implicit_pdos;
mod links;
mod modules;
mod node;
mod node_texts;
mod objects;
mod shape;
mod stated;
mod value;
mod words;

use super::view::View;
use crate::ast::{DeviceDecl, ObjectDecl, Spec};
use crate::diag::{Code, Diagnostic, Diagnostics};
use crate::limits::{ENTRIES_OF_DEVICE, Room};
use crate::model::{Further, Index};
use crate::order::Arrange as _;
use crate::source::{Span, Spanned};
use crate::wording::FileFormat;
use std::sync::Arc;

use further::KeysBySection;

pub(crate) use form::{Form, StandardTypes};
pub(crate) use node::{FileUse, NodeDecl};
pub(crate) use stated::stated;
pub use stated::{cannot_hold, cannot_hold_section};

/// What an EDS or DCF says.
pub(crate) struct Read {
    /// The device, as a specification would describe it.
    pub spec: Spec,
    /// What it says in addition to that.
    pub further: Option<Arc<Further>>,
    /// Of a DCF: the node.
    pub node: Option<NodeDecl>,
}

/// Reads a file under its name.
pub(crate) fn read(
    view: &View<'_>,
    name: &str,
    standard: StandardTypes,
    diagnostics: &mut Diagnostics,
) -> Read {
    let mut node = view.is_dcf.then(|| node::read(view));
    let mut meanings = comments::Meanings::default();
    let (objects, of_modules) = objects(view, node.as_mut(), &mut meanings, standard, diagnostics);
    let indices: Vec<Index> = objects.iter().map(|object| object.index.value).collect();
    // An XDD has no place for such keys.
    let is_eds = view.facts.format == FileFormat::Eds;
    let further = is_eds.then(|| Arc::new(further::read(view, &indices, of_modules)));
    let (units, types) = meanings.into_declarations();
    let device = DeviceDecl {
        dynamic_channels: channels::read(view, diagnostics),
        ..device::device(view, name, &objects)
    };
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
        mentions: Vec::new(),
        untranslated: Vec::new(),
        front_end: crate::ast::FrontEnd::Eds,
    };
    Read { spec, further, node }
}

/// All objects of a file, by index, and what is at those of modules beyond their facts.
fn objects(
    view: &View<'_>,
    node: Option<&mut NodeDecl>,
    meanings: &mut comments::Meanings,
    standard: StandardTypes,
    diagnostics: &mut Diagnostics,
) -> (Vec<ObjectDecl>, KeysBySection) {
    let room = Some(Room::new(ENTRIES_OF_DEVICE));
    let format = view.facts.format;
    let mut context = entry::Context { node, meanings, diagnostics, room, format, view, standard };
    let described = view.objects.iter().filter(|(_, part)| part.object.is_some() || !part.subs.is_empty());
    // A declaration is large: the list has room for as many as there are, and no more.
    let mut objects: Vec<ObjectDecl> = Vec::with_capacity(view.objects.len());
    objects.extend(described.filter_map(|(index, part)| objects::object(*index, part, &mut context)));
    context.diagnostics.now_about(None);
    implicit_pdos::add(view, &mut objects);
    let of_modules = modules::add(view, &mut objects, &mut context);
    context.diagnostics.now_about(None);
    objects.arrange_by_key(|object| object.index.value);
    (objects, of_modules)
}

/// Something that is right, and that a dictionary has no place for.
fn without_place(code: &'static Code, place: Span, message: String) -> Diagnostic {
    Diagnostic::new(code, place, message)
        .help("keep the file for tools that need it; what is made from it does not have it")
}

/// A text with the place that it follows from.
fn made(text: impl Into<String>, place: Span) -> Spanned<String> {
    Spanned::new(text.into(), place)
}

/// A text of the file.
fn owned(text: Spanned<&str>) -> Spanned<String> {
    text.map(ToOwned::to_owned)
}
