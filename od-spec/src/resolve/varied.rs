//! Indices at which devices have different objects. What is said by index for several devices would mean another object on each.

use std::collections::BTreeMap;

use crate::ast::{ObjectDecl, Spec};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::Index;
use crate::order::Arrange as _;
use crate::source::Span;

/// The objects of the indices that have several.
pub(super) struct Varied<'a> {
    by_index: BTreeMap<Index, Vec<&'a ObjectDecl>>,
}

impl<'a> Varied<'a> {
    pub(super) fn of(root: &'a Spec) -> Self {
        let mut sorted: Vec<&ObjectDecl> = root.objects.iter().collect();
        sorted.arrange_by_key(|decl| decl.index.value);
        let several =
            sorted.chunk_by(|one, next| one.index.value == next.index.value).filter(|decls| decls.len() > 1);
        Self { by_index: several.map(|decls| (decls[0].index.value, decls.to_vec())).collect() }
    }

    /// Reports an index that is named at `place` for several devices which have different objects there.
    pub(super) fn is_refused<'d>(
        &self,
        index: Index,
        place: Span,
        devices: impl Iterator<Item = &'d str>,
        help: &str,
        diagnostics: &mut Diagnostics,
    ) -> bool {
        let Some(decls) = self.by_index.get(&index) else { return false };
        let object = |device: &str| {
            let is_for = |decl: &&&ObjectDecl| decl.devices.iter().flatten().any(|key| key.value == device);
            decls.iter().find(is_for).copied()
        };
        let mut owned = devices.filter_map(|device| Some((device, object(device)?)));
        let Some((first, one)) = owned.next() else { return false };
        let Some((second, other)) = owned.find(|(_, other)| !std::ptr::eq(*other, one)) else { return false };
        if diagnostics.is_new(codes::DIFFERENT_OBJECTS, place) {
            let message = format!("{index} is another object on `{second}` than on `{first}`");
            diagnostics.push(
                Diagnostic::new(codes::DIFFERENT_OBJECTS, place, message)
                    .about(index)
                    .with(one.index.span, format!("on `{first}`"))
                    .with(other.index.span, format!("on `{second}`"))
                    .help(help),
            );
        }
        true
    }
}
