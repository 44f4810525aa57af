//! Reads every kind of map of the language.

use std::collections::BTreeMap;

use super::read::Reader;
use super::{lexical, shape};
use crate::ast::{
    ArrayDecl, Axes, BitDecl, BitErrorDecl, CommandDecl, ConstraintDecl, ContentDecl, DeviceDecl, EdsDecl,
    EntryDecl, ErratumDecl, ErrorDecl, FeatureDecl, FileDecl, IssueDecl, MachineDecl, Name, ObjectDecl,
    PdoDecl, RecordDecl, SectionDecl, SourceDecl, Spec, SpecialDecl, TableDecl, TransitionDecl, TypeDecl,
    UnitDecl, ValueDecl, VendorDecl,
};
use crate::diag::{Code, Diagnostic, Diagnostics, codes};
use crate::expr::Expr;
use crate::keys::{self, Keys};
use crate::model::{
    Access, AccessRight, BitUsage, Category, Direction, Edge, ErratumKind, Index, Outside, PdoMapping,
    Rounding, Storage, SubIndex,
};
use crate::scalar;
use crate::source::{Span, Spanned};
use crate::yaml::{Node, NodeKind};

pub(super) fn read(root: &Node, diagnostics: &mut Diagnostics) -> Spec {
    let languages = Reader { node: root, language: "en" }.texts("languages");
    let language = languages.first().map_or("en", |name| name.value.as_str()).to_owned();
    let top = Reader { node: root, language: &language };
    Spec {
        file: root.span.file,
        span: root.span,
        unsure: has_unknown_key(root, &keys::SPEC)
            || root
                .get("devices")
                .is_some_and(|node| !matches!(node.kind, NodeKind::Map(_) | NodeKind::Null)),
        profile: top.text("profile"),
        title: top.text("title"),
        source: top.child("source").map(|r| SourceDecl {
            title: r.text("title"),
            edition: r.text("edition"),
            about: r.words("about"),
        }),
        revision: top.child("revision").map(issue),
        history: top.items("history").map(issue).collect(),
        vendor: top.child("vendor").map(|r| VendorDecl { name: r.text("name"), number: r.integer("number") }),
        uses: top.texts("uses"),
        glossary: top
            .entries("glossary")
            .filter_map(|(name, r)| Some((owned(name), r.own_words()?)))
            .collect(),
        devices: top.entries("devices").map(|(key, r)| device(key, r)).collect(),
        units: top.entries("units").map(|(name, r)| unit(name, r)).collect(),
        types: top.entries("types").map(|(name, r)| named_type(name, r, diagnostics)).collect(),
        axes: top.keyed("axes").and_then(|(key, r)| axes(key, r, diagnostics)),
        features: top.entries("features").map(|(name, r)| feature(name, r)).collect(),
        objects: objects(top.entries("objects"), diagnostics),
        pdos: top.entries("pdos").map(|(key, r)| (owned(key), pdos(r, diagnostics))).collect(),
        errors: top.entries("errors").filter_map(|(codes, r)| error(codes, r)).collect(),
        machines: top.entries("state-machines").map(|(name, r)| machine(name, r, diagnostics)).collect(),
        constraints: top.entries("constraints").map(|(name, r)| constraint(name, r)).collect(),
        errata: top.items("errata").map(erratum).collect(),
        sections: top.items("document").map(section).collect(),
        languages,
    }
}

/// Whether a key was refused, or the node is no map at all.
fn has_unknown_key(node: &Node, keys: &Keys) -> bool {
    let known = |name: &str| keys.keys.iter().any(|key| key.name == name);
    !matches!(node.kind, NodeKind::Map(_)) || node.entries().iter().any(|(name, _)| !known(&name.value))
}

fn owned(name: Spanned<&str>) -> Name {
    name.map(ToOwned::to_owned)
}

/// Reads numeric keys and reports two spellings of one number.
fn numbered<'a, K: Ord + Copy>(
    entries: impl Iterator<Item = (Spanned<&'a str>, Reader<'a>)>,
    read: impl Fn(&str) -> Option<K>,
    diagnostics: &mut Diagnostics,
    code: &'static Code,
    show: impl Fn(K) -> String,
) -> Vec<(Spanned<K>, Reader<'a>)> {
    let mut first: BTreeMap<K, Spanned<&str>> = BTreeMap::new();
    let mut list = Vec::new();
    for (name, reader) in entries {
        let Some(number) = read(name.value) else { continue };
        if let Some(before) = first.get(&number) {
            diagnostics.push(twice(code, &show(number), name, *before));
            continue;
        }
        first.insert(number, name);
        list.push((Spanned::new(number, name.span), reader));
    }
    list
}

/// Two keys stand for one number.
fn twice(code: &'static Code, number: &str, name: Spanned<&str>, before: Spanned<&str>) -> Diagnostic {
    Diagnostic::new(code, name.span, format!("{number} is defined twice"))
        .label(if before.value == name.value {
            "again here".to_owned()
        } else {
            format!("again here (`{}` is {number})", name.value)
        })
        .with(before.span, "first here")
        .help("remove one of the two, or give it its own number")
}

/// Reads the objects; a run of indices makes one object for each of them.
fn objects<'a>(
    entries: impl Iterator<Item = (Spanned<&'a str>, Reader<'a>)>,
    diagnostics: &mut Diagnostics,
) -> Vec<ObjectDecl> {
    let mut before: BTreeMap<Index, Spanned<&str>> = BTreeMap::new();
    let mut list = Vec::new();
    for (key, r) in entries {
        let Some((first, last)) = lexical::indices(key.value) else { continue };
        if let Some((index, other)) = before.range(first..=last).next() {
            diagnostics.push(twice(codes::DUPLICATE_INDEX, &index.to_string(), key, *other));
            continue;
        }
        before.extend((first.0..=last.0).map(|index| (Index(index), key)));
        let one = object(Spanned::new(first, key.span), r, diagnostics);
        if first == last {
            list.push(one);
            continue;
        }
        if let Some(name) = one.entry.name.as_ref().filter(|name| !name.value.contains("{n}")) {
            diagnostics.push(
                Diagnostic::new(
                    codes::BAD_NOTATION,
                    name.span,
                    "the objects of a run would all have this name",
                )
                .help("write `{n}` into the name; it stands for 1, 2, and so on"),
            );
        }
        for (number, index) in (1..).zip(first.0..=last.0) {
            let numbered = |text: &Option<Name>| {
                let text = text.as_ref()?;
                let whole = text.value.replace("{n}", &i32::to_string(&number));
                // A name without `{n}` was reported; its copies do not have to be reported, too.
                let whole = if whole == text.value { format!("{whole} {number}") } else { whole };
                Some(Spanned::new(whole, text.span))
            };
            let mut copy = ObjectDecl { index: Spanned::new(Index(index), key.span), ..one.clone() };
            copy.entry.name = numbered(&one.entry.name);
            copy.entry.identifier = numbered(&one.entry.identifier);
            list.push(copy);
        }
    }
    list
}

fn issue(r: Reader<'_>) -> IssueDecl {
    IssueDecl { number: r.text("number"), date: r.value("date", lexical::date), about: r.words("about") }
}

fn device(key: Spanned<&str>, r: Reader<'_>) -> DeviceDecl {
    DeviceDecl {
        key: owned(key),
        name: r.text("name"),
        about: r.words("about"),
        product_name: r.text("product-name"),
        product: r.integer("product"),
        product_revision: r.integer("product-revision"),
        order_code: r.text("order-code"),
        bit_rates: r.integers("bit-rates"),
        device_type: r.integer("device-type"),
        granularity: r.integer("granularity"),
        boot_up_master: r.yes_no("boot-up-master"),
        boot_up_slave: r.yes_no("boot-up-slave"),
        group_messaging: r.yes_no("group-messaging"),
        lss: r.yes_no("lss"),
        dummies: r.texts("dummies"),
        features: r.texts("features"),
        eds: r.child("eds").map(|r| FileDecl {
            description: r.text("description"),
            created: r.value("created", lexical::date_time),
            created_by: r.text("created-by"),
            modified: r.value("modified", lexical::date_time),
            modified_by: r.text("modified-by"),
            version: r.integer("file-version"),
            revision: r.integer("file-revision"),
        }),
        eds_defaults: r.text("eds-defaults"),
    }
}

fn unit(name: Spanned<&str>, r: Reader<'_>) -> UnitDecl {
    let scale = r.value("scale", |text| scalar::ratio(text).filter(|ratio| ratio.numerator() > 0));
    let base = r.value("base", |text| shape::base(text).map(|(ratio, symbol)| (ratio, symbol.to_owned())));
    // A unit whose scale cannot be read is no unit of scale 1.
    let unreadable = |key: &str, readable: bool| r.node.get(key).is_some() && !readable;
    let broken = unreadable("scale", scale.is_some()) || unreadable("base", base.is_some());
    UnitDecl {
        name: owned(name),
        symbol: r.text("symbol").filter(|_| !broken),
        scale,
        base,
        formula: r.value("formula", |text| Expr::parse_term(text).ok()),
        about: r.words("about"),
    }
}

fn usage(word: &str) -> Option<BitUsage> {
    match word {
        "reserved" => Some(BitUsage::Reserved),
        "unused" => Some(BitUsage::Unused),
        _ => None,
    }
}

fn named_type(name: Spanned<&str>, r: Reader<'_>, diagnostics: &mut Diagnostics) -> TypeDecl {
    let has = |key: &str| r.node.get(key).is_some();
    let broken_bits = r.entries("bits").any(|(key, _)| lexical::bits(key.value).is_none());
    TypeDecl {
        unsure: broken_bits || has_unknown_key(r.node, &keys::TYPE),
        name: owned(name),
        base: r.text("base"),
        about: r.words("about"),
        values: has("values").then(|| values(r, diagnostics)),
        bits: has("bits")
            .then(|| r.entries("bits").filter_map(|(key, r)| bit(key, r, diagnostics)).collect()),
        rest: r.value("rest", usage),
    }
}

fn values(r: Reader<'_>, diagnostics: &mut Diagnostics) -> Vec<ValueDecl> {
    let integer = |text: &str| scalar::integer(text).ok();
    numbered(r.entries("values"), integer, diagnostics, codes::DUPLICATE_VALUE, |value| {
        format!("value {value}")
    })
    .into_iter()
    .map(|(value, r)| ValueDecl {
        value,
        name: short(r, "name"),
        supported: r.yes_no("supported"),
        about: r.words("about"),
    })
    .collect()
}

/// The scalar itself, or the text under a key.
fn short(r: Reader<'_>, key: &str) -> Option<Name> {
    r.scalar(|text| Some(text.to_owned())).or_else(|| r.text(key))
}

fn bit(key: Spanned<&str>, r: Reader<'_>, diagnostics: &mut Diagnostics) -> Option<BitDecl> {
    let bits = Spanned::new(lexical::bits(key.value)?, key.span);
    let name = short(r, "name");
    // A name that was refused is not missing as well.
    let refused = name.is_none() && (r.child("name").is_some() || !matches!(r.node.kind, NodeKind::Map(_)));
    let name = name.or_else(|| refused.then(|| Spanned::new(format!("bit {}", key.value), key.span)));
    let flag = |key: &str| r.yes_no(key).is_some_and(|flag| flag.value);
    let usage = match r.scalar(usage) {
        Some(usage) => usage.value,
        None if flag("reserved") => BitUsage::Reserved,
        None if flag("unused") => BitUsage::Unused,
        None => BitUsage::Used,
    };
    Some(BitDecl {
        bits,
        usage,
        name: if r.node.text().is_some() && usage != BitUsage::Used { None } else { name },
        about: r.words("about"),
        errors: r.integers("error"),
        clamp: r.text("clamp"),
        active: r.integer("active"),
        edge: r.value("edge", edge).map(|edge| edge.value),
        priority: r.text("priority"),
        values: values(r, diagnostics),
        modes: r
            .entries("modes")
            .map(|(mode, r)| (owned(mode), short(r, "name"), r.words("about")))
            .collect(),
    })
}

fn edge(word: &str) -> Option<Edge> {
    match word {
        "rising" => Some(Edge::Rising),
        "falling" => Some(Edge::Falling),
        "both" => Some(Edge::Both),
        _ => None,
    }
}

fn axes(key: Span, r: Reader<'_>, diagnostics: &mut Diagnostics) -> Option<Axes> {
    let (first, last) = (r.value("first", lexical::index)?, r.value("last", lexical::index)?);
    let count = r.integer("count")?;
    let mut refuse = |span, problem: String, help: &str| {
        diagnostics.push(Diagnostic::new(codes::NUMBER_OUT_OF_RANGE, span, problem).help(help.to_owned()));
        None
    };
    if last.value < first.value {
        let problem = format!("axis 1 ends at {} and begins at {}", last.value, first.value);
        return refuse(last.span, problem, "write the smaller index at `first:`");
    }
    let size = i128::from(last.value.0 - first.value.0) + 1;
    let room = (0x1_0000 - i128::from(first.value.0)) / size;
    // What no number of axes can be is refused with the other numbers.
    let number = u16::try_from(count.value).ok().filter(|number| (2..=16).contains(number))?;
    if i128::from(number) > room {
        let problem = format!("found {number} axes; there is room for {room}");
        return refuse(count.span, problem, "an axis takes as many indices as the one before, up to FFFFh");
    }
    Some(Axes { span: key, first: first.value, last: last.value, count: number })
}

fn feature(name: Spanned<&str>, r: Reader<'_>) -> FeatureDecl {
    FeatureDecl {
        name: owned(name),
        implied: r.yes_no("implied").is_some_and(|implied| implied.value),
        objects: r.indices("objects"),
        needs: r.texts("needs"),
    }
}

fn object(index: Spanned<Index>, r: Reader<'_>, diagnostics: &mut Diagnostics) -> ObjectDecl {
    ObjectDecl {
        index,
        on: r.optional_texts("on"),
        from: r.text("from"),
        alias: r.text("alias"),
        outside: r.value("outside", Outside::from_word),
        rounding: r.value("rounding", Rounding::from_word),
        array: r.keyed("array").map(|(key, child)| ArrayDecl {
            span: key,
            count: child.integer("count"),
            entry: entry(child, &keys::ARRAY, key, diagnostics),
            elements: members(child.entries("elements"), diagnostics),
        }),
        record: r
            .keyed("record")
            .map(|(key, _)| RecordDecl { span: key, members: members(r.entries("record"), diagnostics) }),
        sub0: r.keyed("sub0").map(|(key, child)| entry(child, &keys::SUB0, key, diagnostics)),
        omit: r.integers("omit"),
        entry: entry(r, &keys::OBJECT, index.span, diagnostics),
    }
}

fn members<'a>(
    entries: impl Iterator<Item = (Spanned<&'a str>, Reader<'a>)>,
    diagnostics: &mut Diagnostics,
) -> Vec<(Spanned<SubIndex>, EntryDecl)> {
    let sub = |text: &str| {
        let number = u8::try_from(scalar::integer(text).ok()?).ok()?;
        (1..=254).contains(&number).then_some(SubIndex(number))
    };
    let mut members: Vec<_> =
        numbered(entries, sub, diagnostics, codes::DUPLICATE_SUB_INDEX, |sub| format!("sub-index {sub}"))
            .into_iter()
            .map(|(sub, r)| (sub, entry(r, &keys::ENTRY, sub.span, diagnostics)))
            .collect();
    members.sort_by_key(|(sub, _)| sub.value);
    members
}

fn entry(r: Reader<'_>, keys: &Keys, span: Span, diagnostics: &mut Diagnostics) -> EntryDecl {
    let access = r.value("access", lexical::access);
    let unread = |key: &str| r.node.get(key).is_some_and(|node| node.text().is_none());
    let no_access = access.is_none() && r.node.get("access").is_some();
    EntryDecl {
        span,
        unsure: has_unknown_key(r.node, keys) || unread("name") || unread("type") || no_access,
        name: r.text("name"),
        type_name: r.text("type"),
        unit: r.text("unit"),
        access: access.map(|right| right.map(|(access, locked)| AccessRight { access, locked })),
        pdo: r.value("pdo", PdoMapping::from_word),
        default: r.text("default"),
        min: r.text("min"),
        max: r.text("max"),
        special: special(r, diagnostics),
        stored: r.value("stored", Storage::from_word),
        category: r.value("category", Category::from_word),
        since: r.text("since"),
        capacity: r.integer("capacity"),
        identifier: r.text("identifier"),
        writable_when: r.value("writable-when", |text| Expr::parse(text).ok()),
        bit_errors: r.child("bit-errors").map(|child| {
            let codes = r.entries("bit-errors").filter_map(|(key, r)| {
                let bits = Spanned::new(lexical::bits(key.value)?, key.span);
                let integer = |text: &str| scalar::integer(text).ok();
                let codes = match r.node.items() {
                    [] => r.scalar(integer).into_iter().collect(),
                    items => items.iter().filter_map(|node| r.at(node).scalar(integer)).collect(),
                };
                Some(BitErrorDecl { bits, codes })
            });
            Spanned::new(codes.collect(), child.node.span)
        }),
        eds: r.child("eds").map(|child| {
            let flags = child.texts("flags");
            let flag = |word: &str| flags.iter().any(|flag| flag.value == word);
            let eds = EdsDecl {
                default: child.text("default").map(|word| word.value == "written"),
                access: child.value("access", Access::from_word).map(|access| access.value),
                no_write: flag("no-write"),
                no_scan: flag("no-scan"),
            };
            Spanned::new(eds, child.node.span)
        }),
        about: r.words("about"),
    }
}

fn special(r: Reader<'_>, diagnostics: &mut Diagnostics) -> Option<Spanned<Vec<SpecialDecl>>> {
    let child = r.child("special")?;
    let integer = |text: &str| scalar::integer(text).ok();
    let list = numbered(r.entries("special"), integer, diagnostics, codes::DUPLICATE_VALUE, |value| {
        format!("value {value}")
    })
    .into_iter()
    .map(|(value, r)| SpecialDecl { value, name: short(r, "name"), about: r.words("about") });
    Some(Spanned::new(list.collect(), child.node.span))
}

fn pdos(r: Reader<'_>, diagnostics: &mut Diagnostics) -> Vec<PdoDecl> {
    let number = |text: &str| {
        let number = u16::try_from(scalar::integer(text).ok()?).ok()?;
        (1..=512).contains(&number).then_some(number)
    };
    let mut list = Vec::new();
    for direction in [Direction::Receive, Direction::Transmit] {
        let show = |number: u16| format!("{} {number}", direction.pdo());
        let entries = numbered(r.entries(direction.word()), number, diagnostics, codes::DUPLICATE_PDO, show);
        list.extend(entries.into_iter().map(|(number, r)| PdoDecl {
            direction,
            number,
            span: r.keyed("map").map_or(number.span, |(key, map)| place_of_list(key, map.node)),
            cob_id: r.text("cob-id"),
            valid: r.yes_no("valid"),
            no_rtr: r.yes_no("no-rtr"),
            transmission: r.integer("transmission"),
            inhibit_time: r.integer("inhibit-time"),
            event_timer: r.integer("event-timer"),
            sync_start: r.integer("sync-start"),
            fixed: r.text("mapping").is_some_and(|word| word.value == "fixed"),
            capacity: r.integer("capacity"),
            map: r.texts("map"),
            about: r.words("about"),
        }));
    }
    list
}

/// A list that stands in one line, else its key.
fn place_of_list(key: Span, list: &Node) -> Span {
    let one_line =
        list.span.file == key.file && list.items().last().is_none_or(|last| last.span.end < list.span.end);
    if one_line { list.span } else { key }
}

fn error(codes: Spanned<&str>, r: Reader<'_>) -> Option<ErrorDecl> {
    Some(ErrorDecl {
        codes: Spanned::new(lexical::error_codes(codes.value)?, codes.span),
        unsure: has_unknown_key(r.node, &keys::ERROR)
            || (r.child("name").is_some() && r.text("name").is_none()),
        name: r.text("name"),
        from: r.text("from"),
        on: r.optional_texts("on"),
        priority: r.text("priority"),
        reaction: r.words("reaction"),
        about: r.words("about"),
    })
}

fn machine(name: Spanned<&str>, r: Reader<'_>, diagnostics: &mut Diagnostics) -> MachineDecl {
    let integer = |text: &str| scalar::integer(text).ok();
    let transitions =
        numbered(r.entries("transitions"), integer, diagnostics, codes::DUPLICATE_VALUE, |number| {
            format!("transition {number}")
        });
    MachineDecl {
        name: owned(name),
        unsure: has_unknown_key(r.node, &keys::MACHINE),
        from: r.text("from"),
        on: r.optional_texts("on"),
        status: r.text("status"),
        command: r.text("command"),
        states: r
            .entries("states")
            .map(|(name, r)| (owned(name), r.value("pattern", lexical::pattern), r.words("about")))
            .collect(),
        transitions: transitions
            .into_iter()
            .map(|(number, r)| TransitionDecl {
                number,
                from: r.texts("from"),
                to: r.text("to"),
                event: r.words("event"),
                action: r.words("action"),
            })
            .collect(),
        commands: r
            .entries("commands")
            .map(|(name, r)| CommandDecl {
                name: owned(name),
                pattern: r.value("pattern", lexical::pattern),
                send: r.integer("send"),
                transitions: r.integers("transitions"),
                about: r.words("about"),
            })
            .collect(),
    }
}

fn constraint(name: Spanned<&str>, r: Reader<'_>) -> ConstraintDecl {
    ConstraintDecl {
        name: owned(name),
        on: r.optional_texts("on"),
        require: r.value("require", |text| Expr::parse(text).ok()),
        when: r.value("when", |text| Expr::parse(text).ok()),
        about: r.words("about"),
    }
}

fn erratum(r: Reader<'_>) -> ErratumDecl {
    ErratumDecl {
        at: r.texts("at"),
        on: r.optional_texts("on"),
        kind: r.value("kind", ErratumKind::from_word),
        place: r.words("place"),
        prints: r.words("prints"),
        reads: r.words("reads"),
        because: r.words("because"),
    }
}

fn section(r: Reader<'_>) -> SectionDecl {
    SectionDecl {
        number: r.text("section"),
        title: r.words("title"),
        tables: r.items("tables").map(table).collect(),
    }
}

fn table(r: Reader<'_>) -> TableDecl {
    let contents = r.node.entries().iter().filter_map(|(key, node)| {
        let own = r.at(node);
        let key_name = key.value.as_str();
        let name = || own.scalar(|text| Some(text.to_owned()));
        let content = match key_name {
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
            "pdos" => ContentDecl::Pdos(own.text("device"), own.value("direction", Direction::from_word)),
            "rows" => ContentDecl::Rows(
                own.items("columns").filter_map(Reader::own_words).collect(),
                own.items("rows")
                    .map(|row| {
                        let cells =
                            row.node.items().iter().map(|node| row.at(node).own_words().unwrap_or_default());
                        Spanned::new(cells.collect(), row.node.span)
                    })
                    .collect(),
            ),
            "glossary" if own.scalar(scalar::yes_no)?.value => ContentDecl::Glossary,
            "history" if own.scalar(scalar::yes_no)?.value => ContentDecl::History,
            _ => return None,
        };
        Some(Spanned::new(content, key.span))
    });
    TableDecl {
        unsure: has_unknown_key(r.node, &keys::TABLE),
        span: r.node.entries().first().map_or(r.node.span, |(key, _)| key.span),
        number: r.integer("number"),
        title: r.words("title"),
        contents: contents.collect(),
    }
}
