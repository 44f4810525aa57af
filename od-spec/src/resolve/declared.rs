//! Declarations that are ready to be resolved for one device: as they are written, or made of others.

use std::ops::Deref;

use crate::ast::ObjectDecl;
use crate::model::{Departure, Origin};

/// A declaration that is ready to be resolved for one device.
pub(super) struct Declared<'a> {
    pub decl: Decl<'a>,
    pub origin: Origin,
    pub profile: Option<String>,
    pub departures: Vec<Departure>,
}

/// The declaration of an object. It is large: one that is written has no room of its own here.
pub(super) enum Decl<'a> {
    /// As it is written.
    Written(&'a ObjectDecl),
    /// Laid over a library's, or moved to another axis.
    Made(Box<ObjectDecl>),
}

impl Deref for Decl<'_> {
    type Target = ObjectDecl;

    fn deref(&self) -> &ObjectDecl {
        match self {
            Decl::Written(decl) => decl,
            Decl::Made(decl) => decl,
        }
    }
}
