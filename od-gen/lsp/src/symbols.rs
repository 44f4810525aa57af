//! What a document defines, as a tree: devices, units, types, objects with their entries, PDOs; the sections of an EDS.

use lsp_types::{DocumentSymbol, Range, SymbolKind};
use od_spec::eds::{Document, SectionRef};
use od_spec::model::{Entry, Index, Object, ObjectKind};
use od_spec::scalar;
use od_spec::source::{Span, Spanned};
use od_spec::yaml::{Node, NodeKind};

use super::analysis::Kind;
use super::snapshot::{Snapshot, Tree};

/// The symbols of a document. Of a text that is not YAML at the moment, those of the last one that was, where they are now.
pub(super) fn symbols(snapshot: &Snapshot) -> Vec<DocumentSymbol> {
    match snapshot.now.kind {
        Kind::Eds => of_eds(snapshot),
        Kind::Specification | Kind::Plant | Kind::Parameters => {
            snapshot.last_tree().map(|tree| Walk { snapshot, tree }.sections()).unwrap_or_default()
        }
        Kind::Xdd => of_xdd(snapshot),
        Kind::Foreign | Kind::TooLarge => Vec::new(),
    }
}

/// A key and its value.
type Pair = (Spanned<String>, Node);

/// A way through a tree.
struct Walk<'a> {
    snapshot: &'a Snapshot,
    tree: Tree<'a>,
}

impl Walk<'_> {
    fn sections(&self) -> Vec<DocumentSymbol> {
        let sections = self.tree.root.entries().iter();
        let sections = sections.filter(|(_, node)| matches!(node.kind, NodeKind::Map(_) | NodeKind::List(_)));
        sections.map(|pair| self.section(pair)).collect()
    }

    fn section(&self, pair @ (name, node): &Pair) -> DocumentSymbol {
        let members = node.entries().iter();
        let leaves = |kind: SymbolKind, details: &[&str]| {
            node.entries().iter().map(|pair| self.leaf(pair, kind, details)).collect()
        };
        let children = match name.value.as_str() {
            "devices" => leaves(SymbolKind::MODULE, &["name", "from"]),
            "units" => leaves(SymbolKind::CONSTANT, &["symbol"]),
            // Those of a plant are machines.
            "types" if self.snapshot.now.kind == Kind::Specification => {
                members.map(|pair| self.named_type(pair)).collect()
            }
            "objects" => members.flat_map(|pair| self.objects(pair)).collect(),
            "pdos" => members.map(|pair| self.pdos(pair)).collect(),
            "errors" => leaves(SymbolKind::EVENT, &["name"]),
            "state-machines" => leaves(SymbolKind::CLASS, &[]),
            "constraints" => leaves(SymbolKind::BOOLEAN, &[]),
            "features" => leaves(SymbolKind::INTERFACE, &[]),
            "document" => node.items().iter().filter_map(|item| self.chapter(item)).collect(),
            _ => leaves(SymbolKind::PROPERTY, &["title", "name"]),
        };
        self.symbol(pair, name.value.clone(), SymbolKind::NAMESPACE, None, children)
    }

    /// A definition without anything in it, with the first of some texts that it has.
    fn leaf(&self, pair @ (name, node): &Pair, kind: SymbolKind, details: &[&str]) -> DocumentSymbol {
        let detail = details.iter().find_map(|key| text(node, key)).or_else(|| scalar_text(node));
        self.symbol(pair, name.value.clone(), kind, detail, Vec::new())
    }

    /// The object at an index, or the objects that several devices have there.
    fn objects(&self, (name, node): &Pair) -> Vec<DocumentSymbol> {
        match &node.kind {
            NodeKind::List(objects) => {
                let place = |object: &Node| {
                    (object.span, object.entries().first().map_or(object.span, |one| one.0.span))
                };
                objects.iter().map(|object| self.object(&name.value, object, place(object))).collect()
            }
            _ => vec![self.object(&name.value, node, (around(name.span, node.span), name.span))],
        }
    }

    fn object(&self, index: &str, node: &Node, place: (Span, Span)) -> DocumentSymbol {
        let title = text(node, "name").or_else(|| self.name_of_object(index));
        let (record, array) = (node.get("record"), node.get("array"));
        let kind = match (record, array) {
            (Some(_), _) => SymbolKind::STRUCT,
            (None, Some(_)) => SymbolKind::ARRAY,
            (None, None) => SymbolKind::VARIABLE,
        };
        let members = record.or_else(|| array?.get("elements")).map(Node::entries).unwrap_or_default();
        let entry = |pair: &Pair| {
            let title = text(&pair.1, "name");
            self.symbol(pair, labelled(&pair.0.value, title), SymbolKind::FIELD, facts(&pair.1), Vec::new())
        };
        let children = members.iter().map(entry).collect();
        let facts = facts(node).or_else(|| facts(array?));
        self.made(place, labelled(index, title), kind, facts, children)
    }

    /// What a library calls the object, where the specification says nothing.
    fn name_of_object(&self, index: &str) -> Option<String> {
        let index = Index(u16::try_from(scalar::integer(index).ok()?).ok()?);
        let mut devices = self.snapshot.system()?.devices.iter();
        devices.find_map(|device| Some(device.objects.get(&index)?.name.clone()))
    }

    fn named_type(&self, pair @ (name, node): &Pair) -> DocumentSymbol {
        let (kind, key, member_kind) = match node.get("bits") {
            Some(_) => (SymbolKind::STRUCT, "bits", SymbolKind::FIELD),
            None => (SymbolKind::ENUM, "values", SymbolKind::ENUM_MEMBER),
        };
        let member = |pair: &Pair| {
            let title = scalar_text(&pair.1).or_else(|| text(&pair.1, "name"));
            self.symbol(pair, labelled(&pair.0.value, title), member_kind, None, Vec::new())
        };
        let members = node.get(key).map(Node::entries).unwrap_or_default();
        let children = members.iter().map(member).collect();
        self.symbol(pair, name.value.clone(), kind, text(node, "base"), children)
    }

    fn pdos(&self, pair @ (name, node): &Pair) -> DocumentSymbol {
        let of = |key: &str, word: &'static str| {
            let pdos = node.get(key).map(Node::entries).unwrap_or_default().iter();
            pdos.map(move |pair| {
                let map = pair.1.get("map").map(Node::items).unwrap_or_default();
                let map: Vec<&str> = map.iter().filter_map(|one| Some(one.text()?.value)).collect();
                let detail = (!map.is_empty()).then(|| map.join(", "));
                self.symbol(pair, format!("{word}{}", pair.0.value), SymbolKind::EVENT, detail, Vec::new())
            })
        };
        let children = of("receive", "RPDO").chain(of("transmit", "TPDO")).collect();
        self.symbol(pair, name.value.clone(), SymbolKind::MODULE, None, children)
    }

    /// A section of the manual.
    fn chapter(&self, item: &Node) -> Option<DocumentSymbol> {
        let (key, title) = item.entries().iter().find(|(key, _)| key.value == "title")?;
        let title = scalar_text(title).or_else(|| scalar_text(&title.entries().first()?.1))?;
        let label = match text(item, "section") {
            Some(number) => format!("{number} {title}"),
            None => title,
        };
        Some(self.made((item.span, key.span), label, SymbolKind::STRING, None, Vec::new()))
    }

    /// A key with its value.
    fn symbol(
        &self,
        (name, node): &Pair,
        label: String,
        kind: SymbolKind,
        detail: Option<String>,
        children: Vec<DocumentSymbol>,
    ) -> DocumentSymbol {
        self.made((around(name.span, node.span), name.span), label, kind, detail, children)
    }

    fn made(
        &self,
        (whole, selection): (Span, Span),
        label: String,
        kind: SymbolKind,
        detail: Option<String>,
        children: Vec<DocumentSymbol>,
    ) -> DocumentSymbol {
        let (range, selection_range) = (self.tree.range(whole), self.tree.range(selection));
        symbol((range, selection_range), label, kind, detail, children)
    }
}

/// A symbol; the protocol does not allow an empty name.
fn symbol(
    (range, selection_range): (Range, Range),
    label: String,
    kind: SymbolKind,
    detail: Option<String>,
    children: Vec<DocumentSymbol>,
) -> DocumentSymbol {
    let name = if label.trim().is_empty() { "?".to_owned() } else { label };
    let children = (!children.is_empty()).then_some(children);
    #[expect(deprecated, reason = "a field of the protocol that has to be given")]
    DocumentSymbol { name, detail, kind, tags: None, deprecated: None, range, selection_range, children }
}

/// From the first byte of two places to the last.
fn around(one: Span, other: Span) -> Span {
    Span { start: one.start.min(other.start), end: one.end.max(other.end), ..one }
}

/// A key with what it is called.
fn labelled(key: &str, title: Option<String>) -> String {
    title.map_or_else(|| key.to_owned(), |title| format!("{key} {title}"))
}

/// The text under a key, if it is one.
fn text(node: &Node, key: &str) -> Option<String> {
    scalar_text(node.get(key)?)
}

fn scalar_text(node: &Node) -> Option<String> {
    node.text().map(|text| text.value.to_owned())
}

/// Type, unit and access, as they are written.
fn facts(node: &Node) -> Option<String> {
    let facts: Vec<String> = ["type", "unit", "access"].iter().filter_map(|key| text(node, key)).collect();
    (!facts.is_empty()).then(|| facts.join(", "))
}

/// The objects of an XDD by the last model without errors, with their entries.
fn of_xdd(snapshot: &Snapshot) -> Vec<DocumentSymbol> {
    let Some((good, system)) = snapshot.good.as_ref().zip(snapshot.system()) else { return Vec::new() };
    let made = |span: Span, label: String, kind, detail, children| {
        let range = snapshot.range(snapshot.span_now(good, span)?);
        Some(symbol((range, range), label, kind, detail, children))
    };
    let objects = system.devices.iter().flat_map(|device| device.objects.values());
    let object = |object: &Object| {
        let entries = object.entries.iter().filter(|_| object.is_structured());
        let entry = |entry: &Entry| {
            let label = format!("{} {}", entry.sub, entry.name);
            made(entry.span, label, SymbolKind::FIELD, Some(entry.data_type.to_string()), Vec::new())
        };
        let children: Vec<DocumentSymbol> = entries.filter_map(entry).collect();
        let kind = match object.kind {
            ObjectKind::Record => SymbolKind::STRUCT,
            ObjectKind::Array => SymbolKind::ARRAY,
            ObjectKind::Var | ObjectKind::Domain => SymbolKind::VARIABLE,
        };
        let detail = Some(object.kind.name().to_owned());
        let mut all =
            made(object.span, format!("{} {}", object.index, object.name), kind, detail, Vec::new())?;
        // An outline wants what is inside of something to lie within it.
        if let Some(last) = children.last() {
            all.range.end = all.range.end.max(last.range.end);
            all.children = Some(children);
        }
        Some(all)
    };
    objects.filter_map(object).collect()
}

/// The sections of an EDS; those of sub-indices below their object.
fn of_eds(snapshot: &Snapshot) -> Vec<DocumentSymbol> {
    let document = Document::scan(snapshot.file, snapshot.text());
    let mut symbols: Vec<DocumentSymbol> = Vec::new();
    let mut object = String::new();
    for section in document.sections() {
        let Some(made) = eds_section(snapshot, &document, &section) else { continue };
        let name = section.name().to_ascii_lowercase();
        match symbols.last_mut() {
            Some(last) if !object.is_empty() && name.starts_with(&format!("{object}sub")) => {
                last.range.end = made.range.end;
                last.children.get_or_insert_default().push(made);
            }
            _ => {
                symbols.push(made);
                object = name;
            }
        }
    }
    symbols
}

fn eds_section(
    snapshot: &Snapshot,
    document: &Document<'_>,
    section: &SectionRef<'_, '_>,
) -> Option<DocumentSymbol> {
    let header = document.place(section.header())?;
    let end = section.keys().filter_map(|line| document.place(line)).last().unwrap_or(header);
    let mut keys = section.keys();
    let title = keys.find(|line| line.key().is_some_and(|key| key.eq_ignore_ascii_case("ParameterName")));
    let detail = title.and_then(|line| line.value()).map(ToOwned::to_owned);
    let is_number = section.name().bytes().next().is_some_and(|first| first.is_ascii_digit());
    let kind = if is_number { SymbolKind::VARIABLE } else { SymbolKind::NAMESPACE };
    let range = snapshot.range(around(header, end));
    Some(symbol((range, snapshot.range(header)), section.name().to_owned(), kind, detail, Vec::new()))
}
