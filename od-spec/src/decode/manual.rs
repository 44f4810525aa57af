//! What a specification says about the printed manual.

use super::read::{Field, Reader, reader};
use crate::ast::{ContentDecl, ErratumDecl, IssueDecl, PartDecl, SectionDecl, SourceDecl};
use crate::diag::Diagnostics;
use crate::keys::{self, erratum_keys, revision_keys, source_keys};
use crate::model::{Direction, ProseKind};
use crate::scalar;
use crate::source::Spanned;

source_keys! { reader pub(super) fn source() -> SourceDecl }
revision_keys! { reader pub(super) fn issue() -> IssueDecl }
erratum_keys! { reader pub(super) fn erratum() -> ErratumDecl }

pub(super) fn section(r: Reader<'_>) -> SectionDecl {
    SectionDecl {
        number: r.text("section"),
        title: r.words("title"),
        content: r.items("content").map(part).collect(),
    }
}

fn part(r: Reader<'_>) -> PartDecl {
    let contents = r.node.entries().iter().filter_map(|(key, node)| {
        let value = r.at(node);
        let key_name = key.value.as_str();
        let name = || value.scalar(|text| Some(text.to_owned()));
        let lines = || r.items(key_name).filter_map(Reader::translated).collect();
        let content = match key_name {
            "text" => ContentDecl::Prose(ProseKind::Text, lines()),
            "note" => ContentDecl::Prose(ProseKind::Note, lines()),
            "warning" => ContentDecl::Prose(ProseKind::Warning, lines()),
            "steps" => ContentDecl::Prose(ProseKind::Steps, lines()),
            "list" => ContentDecl::Prose(ProseKind::List, lines()),
            "formula" => ContentDecl::Prose(ProseKind::Formula, lines()),
            "overview" => ContentDecl::Overview(r.indices(key_name)),
            "objects" => ContentDecl::Objects(r.indices(key_name)),
            "bits" => ContentDecl::Bits(name()?),
            "values" => ContentDecl::Values(name()?),
            "errors" => ContentDecl::Errors(r.texts(key_name)),
            "reactions" => ContentDecl::Reactions(r.texts(key_name)),
            "states" => ContentDecl::States(name()?),
            "transitions" => ContentDecl::Transitions(name()?),
            "commands" => ContentDecl::Commands(name()?),
            "ladder" => ContentDecl::Ladder(name()?),
            "pdos" => ContentDecl::Pdos {
                device: value.text("device"),
                direction: value.value("direction", Direction::from_word),
            },
            "rows" => ContentDecl::Rows {
                columns: value.items("columns").filter_map(Reader::translated).collect(),
                rows: value
                    .items("rows")
                    .map(|row| {
                        let cells =
                            row.node.items().iter().map(|node| row.at(node).translated().unwrap_or_default());
                        Spanned::new(cells.collect(), row.node.span)
                    })
                    .collect(),
            },
            "glossary" if value.scalar(scalar::yes_no)?.value => ContentDecl::Glossary,
            "history" if value.scalar(scalar::yes_no)?.value => ContentDecl::History,
            _ => return None,
        };
        Some(Spanned::new(content, key.span))
    });
    PartDecl {
        unsure: r.has_unknown_key(&keys::CONTENT),
        span: r.node.entries().first().map_or(r.node.span, |(key, _)| key.span),
        number: r.integer("number"),
        title: r.words("title"),
        contents: contents.collect(),
    }
}
