//! The printed manual: issues, sections, tables.

use std::collections::BTreeMap;

use od_spec::model::{
    self, Axis, AxisReach, Block, Content, Dictionary, EntryId, Level, NamedBits, Signal, SignalCarrier,
    Switch, SwitchBack, SwitchSide, System, Table, TableContent, Timing,
};
use serde::Serialize;
use serde_json::{Value as Json, json};

use super::{SearchWords, Words, date, device, entry_id, index, integer, search_words, words};
use crate::hexadecimal;

#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) struct DocumentView<'a> {
    source: Option<&'a str>,
    #[serde(skip_serializing_if = "Words::is_empty")]
    subtitle: Words<'a>,
    #[serde(skip_serializing_if = "Words::is_empty")]
    address: Words<'a>,
    revision: Option<IssueView<'a>>,
    history: Vec<IssueView<'a>>,
    glossary: BTreeMap<&'a str, Words<'a>>,
    sections: Vec<SectionView<'a>>,
}

#[derive(Serialize)]
struct IssueView<'a> {
    number: &'a str,
    date: String,
    about: Words<'a>,
}

#[derive(Serialize)]
struct SectionView<'a> {
    section: &'a str,
    title: Words<'a>,
    tables: Vec<TableView<'a>>,
    content: Vec<ContentView<'a>>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    search: SearchWords<'a>,
}

/// What is in a section, in order: the position of a table, or a text.
#[derive(Serialize)]
#[serde(untagged)]
enum ContentView<'a> {
    Table(usize),
    Prose {
        kind: &'static str,
        items: Vec<Words<'a>>,
        #[serde(rename = "for", skip_serializing_if = "Vec::is_empty")]
        warns_for: Vec<String>,
    },
}

#[derive(Serialize)]
struct TableView<'a> {
    number: Option<u16>,
    title: Words<'a>,
    figure: Option<FigureView<'a>>,
    content: Json,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    columns: &'a [String],
    #[serde(skip_serializing_if = "Vec::is_empty")]
    order: Vec<Json>,
}

#[derive(Serialize)]
struct FigureView<'a> {
    number: u16,
    title: Words<'a>,
}

pub(super) fn document(system: &System) -> DocumentView<'_> {
    let document = &system.document;
    DocumentView {
        source: document.source.as_deref(),
        subtitle: words(&document.subtitle),
        address: words(&document.address),
        revision: document.revision.as_ref().map(issue),
        history: document.history.iter().map(issue).collect(),
        glossary: document.glossary.iter().map(|(name, text)| (name.as_str(), words(text))).collect(),
        sections: document
            .sections
            .iter()
            .map(|section| SectionView {
                section: &section.number,
                title: words(&section.title),
                tables: section.tables.iter().map(|one| table(system, one)).collect(),
                content: section.content.iter().map(content).collect(),
                search: search_words(&section.search),
            })
            .collect(),
    }
}

fn issue(issue: &model::Issue) -> IssueView<'_> {
    IssueView { number: &issue.number, date: date(issue.date), about: words(&issue.about) }
}

fn content(content: &Content) -> ContentView<'_> {
    match content {
        Content::Table(table) => ContentView::Table(*table),
        Content::Prose(prose) => {
            let warns_for = prose.warns_for.iter().map(|one| index(*one)).collect();
            ContentView::Prose {
                kind: prose.kind.word(),
                items: prose.items.iter().map(words).collect(),
                warns_for,
            }
        }
    }
}

fn table<'a>(system: &System, table: &'a Table) -> TableView<'a> {
    let indices = |list: &[model::Index]| list.iter().map(|one| index(*one)).collect::<Vec<_>>();
    let codes = |list: &[u16]| -> Json {
        if list.is_empty() {
            json!("all")
        } else {
            list.iter().map(|code| hexadecimal::prefixed(*code, 4)).collect()
        }
    };
    let content = match &table.content {
        TableContent::Overview(list) => json!({"overview": indices(list)}),
        TableContent::Objects(list) => json!({"objects": indices(list)}),
        TableContent::Bits(table) => match table.masks {
            Some(masks) => json!({"bits": {"type": table.named_type, "masks": masks}}),
            None => json!({"bits": table.named_type}),
        },
        TableContent::Values(name) => json!({"values": name}),
        TableContent::Errors(list) => json!({"errors": codes(list)}),
        TableContent::Reactions(list) => json!({"reactions": codes(list)}),
        TableContent::States(name) => json!({"states": name}),
        TableContent::Transitions(name) => json!({"transitions": name}),
        TableContent::Commands(name) => json!({"commands": name}),
        TableContent::Ladder(table) if table.labels.is_empty() => json!({"ladder": table.constraint}),
        TableContent::Ladder(table) => {
            let labels: Vec<_> = table.labels.iter().map(words).collect();
            json!({"ladder": {"constraint": table.constraint, "labels": labels}})
        }
        TableContent::Hysteresis(switches) => {
            json!({"hysteresis": switches.iter().map(switch).collect::<Vec<_>>()})
        }
        TableContent::Flow(flow) => json!({"flow": flow.blocks.iter().map(block).collect::<Vec<_>>()}),
        TableContent::Axis(one) => json!({"axis": axis(one)}),
        TableContent::Timing(one) => json!({"timing": timing(system, one)}),
        TableContent::Pdos(pdos) => {
            json!({"pdos": {"device": pdos.device, "direction": pdos.direction.word()}})
        }
        TableContent::Rows { columns, rows } => {
            let columns: Vec<_> = columns.iter().map(words).collect();
            let rows: Vec<Vec<_>> = rows.iter().map(|row| row.iter().map(words).collect()).collect();
            json!({"rows": {"columns": columns, "rows": rows}})
        }
        TableContent::Glossary => json!({"glossary": true}),
        TableContent::History => json!({"history": true}),
    };
    let figure = table.figure.as_ref();
    let figure = figure.map(|figure| FigureView { number: figure.number, title: words(&figure.title) });
    let order = table.order.iter().map(|number| integer(*number)).collect();
    let columns = table.columns.as_slice();
    TableView { number: table.number, title: words(&table.title), figure, content, columns, order }
}

fn block(block: &Block) -> Json {
    let from = block.from.iter().map(|one| json!({"block": one.block, "carries": words(&one.carries)}));
    json!({
        "block": words(&block.name),
        "entries": entry_ids(&block.entries),
        "bits": block.bits.as_ref().map(bits),
        "does": words(&block.does),
        "from": from.collect::<Vec<_>>(),
    })
}

fn axis(axis: &Axis) -> Json {
    let marks =
        axis.marks.iter().map(|mark| json!({"mark": words(&mark.name), "entries": entry_ids(&mark.entries)}));
    let spans = axis.spans.iter().map(|span| {
        let (from, to) = match span.reach {
            AxisReach::Between(from, to) => (Some(from), Some(to)),
            AxisReach::Above(from) => (Some(from), None),
            AxisReach::Below(to) => (None, Some(to)),
        };
        let (name, does) = (words(&span.name), words(&span.does));
        json!({"span": name, "entries": entry_ids(&span.entries), "from": from, "to": to, "does": does})
    });
    json!({"marks": marks.collect::<Vec<_>>(), "spans": spans.collect::<Vec<_>>()})
}

fn entry_ids(entries: &[EntryId]) -> Vec<String> {
    entries.iter().map(|id| entry_id(*id)).collect()
}

fn bits(NamedBits { named_type, first, last, name }: &NamedBits) -> Json {
    json!({"type": named_type, "first": first, "last": last, "name": name})
}

fn timing(system: &System, timing: &Timing) -> Json {
    let signals: Vec<Json> = timing.signals.iter().map(|one| signal(system, one)).collect();
    let steps: Vec<Json> =
        timing.steps.iter().map(|step| json!({"event": words(&step.event), "cause": step.cause})).collect();
    json!({"signals": signals, "steps": steps})
}

fn signal(system: &System, signal: &Signal) -> Json {
    let level = |level: &Level| match (level, &signal.carrier) {
        (Level::Any, _) => Json::Null,
        (Level::Letter(letter), _) => json!({"letter": letter}),
        (Level::Value(value), SignalCarrier::Bits(_)) => json!({"raw": value.integer().map(integer)}),
        (Level::Value(value), SignalCarrier::Entry(id)) => {
            let entry = system.devices.iter().find_map(|device: &Dictionary| device.entry(*id));
            json!(entry.map(|entry| device::value(id.index, entry, value)))
        }
    };
    let levels: Vec<Json> = signal.levels.iter().map(level).collect();
    match &signal.carrier {
        SignalCarrier::Bits(NamedBits { named_type, first, last, name }) => {
            json!({"type": named_type, "first": first, "last": last, "name": name, "levels": levels})
        }
        SignalCarrier::Entry(id) => json!({"entry": entry_id(*id), "levels": levels}),
    }
}

fn switch(switch: &Switch) -> Json {
    let side = match switch.side {
        SwitchSide::Below => "below",
        SwitchSide::Above => "above",
    };
    let back = match switch.back {
        SwitchBack::By(_) => "back-by",
        SwitchBack::At(_) => "back-at",
    };
    json!({
        "switches": words(&switch.what),
        side: entry_id(switch.threshold),
        back: entry_id(switch.back.entry()),
    })
}
