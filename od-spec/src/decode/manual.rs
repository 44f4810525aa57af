//! What a specification says about the printed manual.

use super::read::{Field, FromNode, Reader, reader};
use crate::ast::{
    AxisDecl, BlockDecl, ContentDecl, ErratumDecl, FigureDecl, InflowDecl, IssueDecl, Levels, MarkDecl,
    PartDecl, SectionDecl, SignalDecl, SourceDecl, SpanDecl, SwitchDecl, TimingDecl, TimingStepDecl,
};
use crate::diag::Diagnostics;
use crate::keys::{
    self, axis_keys, block_keys, erratum_keys, mark_keys, revision_keys, signal_keys, source_keys, span_keys,
    switch_keys, timing_keys, timing_step_keys,
};
use crate::model::{Direction, ProseKind};
use crate::scalar;
use crate::source::Spanned;
use crate::yaml::NodeKind;

source_keys! { reader pub(super) fn source() -> SourceDecl }
revision_keys! { reader pub(super) fn issue() -> IssueDecl }
erratum_keys! { reader pub(super) fn erratum() -> ErratumDecl }
timing_keys! { reader fn timing() -> TimingDecl }
switch_keys! { reader fn switch() -> SwitchDecl }
signal_keys! { reader fn signal() -> SignalDecl }
timing_step_keys! { reader fn timing_step() -> TimingStepDecl }
block_keys! { reader fn block(unsure: bool) -> BlockDecl }
axis_keys! { reader fn axis() -> AxisDecl }
mark_keys! { reader fn mark() -> MarkDecl }
span_keys! { reader fn span() -> SpanDecl }

impl FromNode for SignalDecl {
    fn from_node(reader: Reader<'_>, diagnostics: &mut Diagnostics) -> Option<Self> {
        Some(signal(reader, diagnostics))
    }
}

impl FromNode for SwitchDecl {
    fn from_node(reader: Reader<'_>, diagnostics: &mut Diagnostics) -> Option<Self> {
        Some(switch(reader, diagnostics))
    }
}

impl FromNode for BlockDecl {
    fn from_node(reader: Reader<'_>, diagnostics: &mut Diagnostics) -> Option<Self> {
        let unsure = reader.has_unknown_key(&keys::BLOCK);
        Some(block(unsure, reader, diagnostics))
    }
}

impl FromNode for InflowDecl {
    fn from_node(reader: Reader<'_>, _: &mut Diagnostics) -> Option<Self> {
        Some(Self { block: reader.short("block"), carries: reader.words("carries") })
    }
}

impl FromNode for MarkDecl {
    fn from_node(reader: Reader<'_>, diagnostics: &mut Diagnostics) -> Option<Self> {
        Some(mark(reader, diagnostics))
    }
}

impl FromNode for SpanDecl {
    fn from_node(reader: Reader<'_>, diagnostics: &mut Diagnostics) -> Option<Self> {
        Some(span(reader, diagnostics))
    }
}

impl FromNode for Levels {
    fn from_node(reader: Reader<'_>, _: &mut Diagnostics) -> Option<Self> {
        let level = |node| reader.at(node).scalar(|text| Some(text.to_owned()));
        let levels: Option<Vec<_>> = reader.node.items().iter().map(level).collect();
        levels.filter(|_| matches!(reader.node.kind, NodeKind::List(_))).map(Levels)
    }
}

impl FromNode for TimingStepDecl {
    fn from_node(reader: Reader<'_>, diagnostics: &mut Diagnostics) -> Option<Self> {
        Some(timing_step(reader, diagnostics))
    }
}

pub(super) fn section(r: Reader<'_>, diagnostics: &mut Diagnostics) -> SectionDecl {
    SectionDecl {
        number: r.text("section"),
        title: r.words("title"),
        content: r.items("content").map(|item| part(item, diagnostics)).collect(),
        search: Field::read(r, "search", diagnostics),
    }
}

fn part(r: Reader<'_>, diagnostics: &mut Diagnostics) -> PartDecl {
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
            "gap" => ContentDecl::Prose(ProseKind::Gap, lines()),
            "overview" => ContentDecl::Overview(r.indices(key_name)),
            "objects" => ContentDecl::Objects(r.indices(key_name)),
            "bits" => ContentDecl::Bits { named_type: value.short("type"), masks: value.integer("masks") },
            "values" => ContentDecl::Values(name()?),
            "errors" => ContentDecl::Errors(r.texts(key_name)),
            "reactions" => ContentDecl::Reactions(r.texts(key_name)),
            "states" => ContentDecl::States(name()?),
            "transitions" => ContentDecl::Transitions(name()?),
            "commands" => ContentDecl::Commands(name()?),
            "ladder" => ContentDecl::Ladder {
                constraint: value.short("constraint"),
                labels: value.child("labels").map(|labels| {
                    let texts = labels.node.items().iter();
                    let texts = texts.map(|node| labels.at(node).translated().unwrap_or_default());
                    Spanned::new(texts.collect(), labels.node.span)
                }),
            },
            "timing" => ContentDecl::Timing(timing(value, diagnostics)),
            "hysteresis" => ContentDecl::Hysteresis(Field::read(r, key_name, diagnostics)),
            "flow" => ContentDecl::Flow(Field::read(r, key_name, diagnostics)),
            "axis" => ContentDecl::Axis(axis(value, diagnostics)),
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
        number: r.integer("number"),
        title: r.words("title"),
        warns_for: r.indices("for"),
        columns: r.texts("columns"),
        order: r.child("order").map(|order| Spanned::new(r.integers("order"), order.node.span)),
        figure: r.keyed("figure").map(|(key, figure)| Spanned::new(figure_of(figure), key)),
        contents: contents.collect(),
    }
}

/// A number, or a number with a caption.
fn figure_of(r: Reader<'_>) -> FigureDecl {
    let number = r.scalar(|text| scalar::integer(text).ok()).or_else(|| r.integer("number"));
    FigureDecl { number, title: r.words("title") }
}
