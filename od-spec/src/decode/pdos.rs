//! PDOs.

use super::numbered::numbered;
use super::read::{Field, Reader, reader};
use crate::ast::PdoDecl;
use crate::diag::{Diagnostics, codes};
use crate::keys::pdo_keys;
use crate::model::Direction;
use crate::scalar;
use crate::source::{Span, Spanned};
use crate::yaml::Node;

pdo_keys! { reader fn pdo(direction: Direction, number: Spanned<u16>, span: Span) -> PdoDecl }

pub(super) fn pdos(r: Reader<'_>, diagnostics: &mut Diagnostics) -> Vec<PdoDecl> {
    let number = |text: &str| {
        let number = u16::try_from(scalar::integer(text).ok()?).ok()?;
        (1..=512).contains(&number).then_some(number)
    };
    let mut list = Vec::new();
    for direction in [Direction::Receive, Direction::Transmit] {
        let show = |number: u16| format!("{} {number}", direction.pdo());
        let entries = numbered(r.entries(direction.word()), number, diagnostics, codes::DUPLICATE_PDO, show);
        for (number, r) in entries {
            let span = r.keyed("map").map_or(number.span, |(key, map)| place_of_list(key, map.node));
            list.push(pdo(direction, number, span, r, diagnostics));
        }
    }
    list
}

/// A list that stands in one line, else its key.
fn place_of_list(key: Span, list: &Node) -> Span {
    let one_line =
        list.span.file == key.file && list.items().last().is_none_or(|last| last.span.end < list.span.end);
    if one_line { list.span } else { key }
}
