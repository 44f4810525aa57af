//! Values: words of the language, and names of what is defined.

use lsp_types::CompletionItemKind;
use od_spec::LIBRARIES;
use od_spec::keys::{KeyKind, NameOf, Shape, VERSION};
use od_spec::model::{Access, BitUsage, DataType, NamedType, System, TypeKind, Unit};
use od_spec::names::{Definition, Kind, Spelling, Step};
use od_spec::wording::Language;
use od_spec::yaml::Node;

use super::entries;
use super::items::{Insert, Offer, Written, access_types};
use super::{MARK, Wanted, keys, long_form};
use crate::cursor::entry_around;
use crate::library;

/// The rank of what the specification defines itself.
const OWN: u8 = 4;

/// Keys of a map that are data: devices, objects of libraries, languages.
pub(super) fn of_keys(map: &Node, kind: KeyKind, written: &Written, wanted: &Wanted<'_>) -> Vec<Offer> {
    let is_there = |key: &str| map.entries().iter().any(|(name, _)| name.value == key);
    let colon = if written.follows == ':' { "" } else { ": " };
    let keyed = |offer: Offer| {
        let text = match &offer.insert {
            Insert::Scalar(text) => od_import::yaml::spelled(text),
            Insert::Raw(text) | Insert::Snippet(text) => text.clone(),
        };
        Offer { insert: Insert::Raw(format!("{text}{colon}")), ..offer }
    };
    let offers = match kind {
        KeyKind::Device => defined(wanted, Kind::Device),
        KeyKind::Language => {
            Language::ALL.iter().map(|one| Offer::word(one.code(), CompletionItemKind::TEXT)).collect()
        }
        KeyKind::Indices if is_section(wanted, "objects") => {
            return objects_of_libraries(wanted, written)
                .into_iter()
                .filter(|offer| !is_there(&offer.label))
                .collect();
        }
        // The devices of a default, and the channels of a feature.
        KeyKind::Name => match wanted.place.path.last() {
            Some(Step::Key { key, .. }) if matches!(key.shape, Shape::Default) => {
                defined(wanted, Kind::Device)
            }
            _ => Vec::new(),
        },
        _ => Vec::new(),
    };
    offers.into_iter().filter(|offer| !is_there(&offer.label)).map(keyed).collect()
}

fn is_section(wanted: &Wanted<'_>, section: &str) -> bool {
    matches!(wanted.place.path.as_slice(), [Step::Key { key, .. }] if key.name == section)
}

/// The libraries that the specification uses, of those that come with the compiler.
fn libraries(wanted: &Wanted<'_>) -> impl Iterator<Item = &'static od_spec::Library> {
    let names = wanted.names.definitions().filter(|(_, one)| one.kind == Kind::Library);
    let names: Vec<String> = names.map(|(_, one)| one.name.clone()).collect();
    names.into_iter().filter_map(|name| library::built_in(&name))
}

/// Objects that libraries describe, taken as they are.
fn objects_of_libraries(wanted: &Wanted<'_>, written: &Written) -> Vec<Offer> {
    let libraries = libraries(wanted);
    libraries
        .flat_map(|library| {
            library.objects.iter().map(move |(index, described)| {
                let label = index.notation();
                let object = &described.object;
                let entry = object.entries.iter().find(|entry| !object.is_structured() || entry.sub.0 > 0);
                let data_type = entry.map(|entry| entry.data_type.to_string()).unwrap_or_default();
                let insert = if written.follows == ':' {
                    label.clone()
                } else {
                    format!("{label}: {{from: {}}}", library.name)
                };
                let about = object.about.get("en").map(ToOwned::to_owned);
                let detail =
                    format!("{} ({}), {} {data_type}", object.name, library.name, object.kind.name());
                let offer = Offer::word(&label, CompletionItemKind::STRUCT).detail(detail).about(about);
                Offer { insert: Insert::Raw(insert), ..offer }
            })
        })
        .collect()
}

/// Values of a shape.
pub(super) fn of_value(shape: Shape, written: &Written, wanted: &Wanted<'_>) -> Vec<Offer> {
    let words = |words: &[&str]| -> Vec<Offer> {
        let offer =
            |(order, word): (usize, &&str)| Offer { order, ..Offer::word(word, CompletionItemKind::KEYWORD) };
        words.iter().enumerate().map(offer).collect()
    };
    match shape {
        Shape::Choice(choice) => words(choice),
        Shape::YesNo => words(&["yes", "no"]),
        Shape::Version => words(&[&VERSION.to_string()]),
        Shape::Access => {
            let mut offers = access_types();
            let locked = Access::WORDS.iter().filter(|word| !matches!(**word, "ro" | "const"));
            offers.extend(
                locked
                    .map(|word| Offer::word(&format!("{word} locked"), CompletionItemKind::KEYWORD).rank(6)),
            );
            offers
        }
        Shape::Type => {
            // Own types, data types, then what libraries define for themselves.
            let mut offers = data_types();
            offers.extend(defined(wanted, Kind::Type).into_iter().map(|offer| match offer.rank {
                OWN => offer,
                _ => offer.rank(6),
            }));
            offers
        }
        Shape::NameOf(of) => of_name(of, wanted),
        Shape::Feature => of_name(NameOf::Feature, wanted),
        Shape::Entry | Shape::Entries => entries::entries(wanted, written),
        Shape::Index => entries::objects(wanted),
        Shape::ErrorCode => error_codes(wanted),
        Shape::Condition => entries::condition(wanted, written),
        Shape::Value | Shape::Default => {
            let mut offers = values(wanted);
            offers.extend(with_units(written, &units(wanted)));
            offers
        }
        Shape::ShortOr(short, _) => {
            let mut offers = of_value(*short, written, wanted);
            // The long form, in the place of the short one.
            if written.before.is_empty()
                && let Some(keys) = long_form(shape)
            {
                let word = Node { span: wanted.tree.span, kind: od_spec::yaml::NodeKind::Null };
                let long = keys::of_map(&word, keys, written, wanted).into_iter().map(|offer| {
                    let insert = match &offer.insert {
                        Insert::Raw(text) | Insert::Scalar(text) | Insert::Snippet(text) => {
                            format!("{{{text}")
                        }
                    };
                    Offer { insert: Insert::Raw(insert), rank: 8, ..offer }
                });
                offers.extend(long);
            }
            offers
        }
        Shape::List(item) => of_value(*item, written, wanted)
            .into_iter()
            .map(|offer| {
                let text = match &offer.insert {
                    Insert::Scalar(text) => od_import::yaml::spelled(text),
                    Insert::Raw(text) | Insert::Snippet(text) => text.clone(),
                };
                Offer { insert: Insert::Raw(format!("[{text}]")), ..offer }
            })
            .collect(),
        _ => Vec::new(),
    }
}

fn data_types() -> Vec<Offer> {
    let offer = |data_type: DataType| {
        let detail = data_type.bits().map(|bits| format!("{data_type}, {bits} bit"));
        Offer::word(data_type.name(), CompletionItemKind::KEYWORD)
            .detail(detail.unwrap_or_else(|| data_type.to_string()))
    };
    DataType::ALL.into_iter().map(offer).collect()
}

fn of_name(of: NameOf, wanted: &Wanted<'_>) -> Vec<Offer> {
    let words = |words: &[&str]| {
        let words = words.iter().map(|word| Offer::word(word, CompletionItemKind::KEYWORD).rank(6));
        words.collect::<Vec<_>>()
    };
    let of_model = |kind: Kind| {
        let offers = defined(wanted, kind);
        let devices = wanted.snapshot.system().map(|system| system.devices.as_slice()).unwrap_or_default();
        if offers.is_empty() {
            let keys = devices.iter().map(|device| Offer::name(&device.key, CompletionItemKind::MODULE));
            keys.collect()
        } else {
            offers
        }
    };
    let mut offers = match of {
        NameOf::Unit => defined(wanted, Kind::Unit),
        NameOf::NamedType => defined(wanted, Kind::Type),
        NameOf::DataType => data_types(),
        NameOf::Library => defined(wanted, Kind::Library),
        NameOf::LibraryFile => {
            LIBRARIES.iter().map(|(name, _)| Offer::word(name, CompletionItemKind::MODULE)).collect()
        }
        NameOf::File => defined(wanted, Kind::File),
        NameOf::Device => of_model(Kind::Device),
        NameOf::Feature => defined(wanted, Kind::Feature),
        NameOf::Machine => defined(wanted, Kind::Machine),
        NameOf::Constraint => defined(wanted, Kind::Constraint),
        NameOf::Errors => {
            let mut offers = error_codes(wanted);
            offers.extend(words(&["all"]));
            offers
        }
        NameOf::State => {
            let mut offers = members(wanted, Kind::State, machine(wanted));
            offers.extend(words(&["start", "any"]));
            offers
        }
        NameOf::Bit => {
            let owner = wanted.place.beside("type").and_then(Node::text).map(|name| name.value);
            members(wanted, Kind::Bit, owner)
        }
        NameOf::Block => in_picture(wanted, "flow", "block"),
        NameOf::Mark => in_picture(wanted, "axis", "mark"),
    };
    // What is in the list already.
    if let Some(Step::Item { list, .. }) = wanted.place.path.last() {
        let there: Vec<&str> = list.items().iter().filter_map(|item| Some(item.text()?.value)).collect();
        offers.retain(|offer| !there.contains(&offer.label.as_str()));
    }
    offers
}

/// The names of everything of a kind.
fn defined(wanted: &Wanted<'_>, kind: Kind) -> Vec<Offer> {
    let all = wanted.names.definitions().filter(|(_, one)| one.kind == kind && !one.name.contains(MARK));
    let mut offers: Vec<Offer> = Vec::new();
    for (_, one) in all {
        if one.spelling != Spelling::Elsewhere && !offers.iter().any(|offer| offer.label == one.name) {
            offers.push(offer(wanted, one));
        }
    }
    offers
}

/// The names of a kind in something of a name, such as the states of a machine.
fn members(wanted: &Wanted<'_>, kind: Kind, owner: Option<&str>) -> Vec<Offer> {
    let Some(owner) = owner else { return Vec::new() };
    let is_in = |one: &Definition| {
        one.kind == kind && one.owner.is_some_and(|id| wanted.names.definition(id).name == owner)
    };
    let mut offers: Vec<Offer> = Vec::new();
    for (_, one) in wanted.names.definitions().filter(|(_, one)| is_in(one)) {
        if !offers.iter().any(|offer| offer.label == one.name) {
            offers.push(offer(wanted, one));
        }
    }
    offers
}

fn offer(wanted: &Wanted<'_>, one: &Definition) -> Offer {
    let system = wanted.snapshot.system();
    let (kind, detail) = match one.kind {
        Kind::Unit => (CompletionItemKind::UNIT, system.and_then(|system| unit(system, &one.name))),
        Kind::Type => (CompletionItemKind::ENUM, system.and_then(|system| named_type(system, &one.name))),
        Kind::Device => {
            let device = system.and_then(|system| system.device(&one.name));
            (CompletionItemKind::MODULE, device.map(|device| device.name.clone()))
        }
        Kind::Feature => {
            let brings = libraries(wanted)
                .flat_map(|library| &library.features)
                .find(|feature| feature.name == one.name);
            let objects = brings.map(|feature| {
                let indices: Vec<String> = feature.objects.iter().map(ToString::to_string).collect();
                indices.join(", ")
            });
            (CompletionItemKind::INTERFACE, objects)
        }
        Kind::Value | Kind::Bit => (CompletionItemKind::ENUM_MEMBER, Some(wanted.text(one.key).to_owned())),
        Kind::Library | Kind::File => (CompletionItemKind::FILE, None),
        _ => (CompletionItemKind::REFERENCE, None),
    };
    // What the specification defines itself goes before what libraries do.
    let root = wanted.snapshot.now.root;
    let is_own = root.is_some_and(|root| one.span.file.is_one_with(root));
    let offer = Offer::name(&one.name, kind).detail(detail.unwrap_or_default());
    let offer = offer.rank(if is_own { OWN } else { 5 });
    match system.and_then(|system| system.units.get(&one.name)).filter(|_| one.kind == Kind::Unit) {
        Some(unit) => offer.also(unit.symbol.clone()),
        None => offer,
    }
}

/// The unit of the entry around, as far as it is written there or in the model.
fn units<'a>(wanted: &'a Wanted<'_>) -> Vec<&'a Unit> {
    let Some(system) = wanted.snapshot.system() else { return Vec::new() };
    let written = wanted.place.path.iter().rev().find_map(|step| match step {
        Step::Key { map, keys, .. } => keys.get("unit").and_then(|_| map.get("unit")).and_then(Node::text),
        Step::Data { .. } | Step::Item { .. } => None,
    });
    if let Some(unit) = written.and_then(|name| system.units.get(name.value)) {
        return vec![unit];
    }
    let entry = entry_around(&wanted.place.path)
        .and_then(|id| system.devices.iter().find_map(|device| device.entry(id)));
    entry.and_then(|entry| entry.unit.as_deref()).into_iter().collect()
}

/// A number that is written, with the symbols in which it may be.
pub(super) fn with_units(written: &Written, units: &[&Unit]) -> Vec<Offer> {
    let before = written.before.as_str();
    let end =
        before.find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-' | '+'))).unwrap_or(before.len());
    let number = &before[..end];
    if !number.ends_with(|c: char| c.is_ascii_digit()) {
        return Vec::new();
    }
    let symbols = units.iter().flat_map(|unit| {
        let base = unit.base.as_ref().map(|base| (base.symbol.as_str(), 7));
        [(unit.symbol.as_str(), 6)].into_iter().chain(base)
    });
    symbols
        .filter(|(symbol, _)| !symbol.is_empty())
        .map(|(symbol, rank)| Offer::name(&format!("{number} {symbol}"), CompletionItemKind::UNIT).rank(rank))
        .collect()
}

fn unit(system: &System, name: &str) -> Option<String> {
    let words = crate::hover::Words::of(Some(system)).wording;
    Some(words.counted_step(system.units.get(name)?))
}

fn named_type(system: &System, name: &str) -> Option<String> {
    Some(system.types.get(name)?.base.to_string())
}

fn error_codes(wanted: &Wanted<'_>) -> Vec<Offer> {
    let errors = wanted.snapshot.system().map(|system| system.errors.as_slice()).unwrap_or_default();
    let offer = |error: &od_spec::model::ErrorCode| {
        Offer::word(&format!("0x{:04X}", error.code), CompletionItemKind::CONSTANT)
            .detail(error.name.as_str())
    };
    errors.iter().map(offer).collect()
}

/// The name of the state machine around.
fn machine<'a>(wanted: &Wanted<'a>) -> Option<&'a str> {
    wanted.place.path.iter().find_map(|step| match step {
        Step::Data { name, .. } => Some(name.value.as_str()),
        Step::Key { .. } | Step::Item { .. } => None,
    })
}

/// The names of the blocks or marks of the picture around.
fn in_picture(wanted: &Wanted<'_>, picture: &str, key: &str) -> Vec<Offer> {
    let around = wanted.place.path.iter().rev().find_map(|step| match step {
        Step::Key { map, key, .. } if key.name == picture => map.get(picture),
        Step::Key { .. } | Step::Data { .. } | Step::Item { .. } => None,
    });
    let parts = around.map(|node| if picture == "axis" { node.get("marks").unwrap_or(node) } else { node });
    let parts = parts.map(Node::items).unwrap_or_default().iter().filter_map(|part| part.get(key));
    let names = parts.filter_map(|words| words.text().or_else(|| words.entries().first()?.1.text()));
    names
        .filter(|name| !name.value.contains(MARK))
        .map(|name| Offer::name(name.value, CompletionItemKind::REFERENCE))
        .collect()
}

/// The names of the values or bits of the type of the entry around.
fn values(wanted: &Wanted<'_>) -> Vec<Offer> {
    let place = wanted.place;
    let written = place.path.iter().rev().find_map(|step| match step {
        Step::Key { map, keys, .. } => keys.get("type").and_then(|_| map.get("type")).and_then(Node::text),
        Step::Data { .. } | Step::Item { .. } => None,
    });
    let Some(system) = wanted.snapshot.system() else {
        let owner = written.map(|name| name.value);
        let mut offers = members(wanted, Kind::Value, owner);
        offers.extend(members(wanted, Kind::Bit, owner));
        return offers;
    };
    if let Some(name) = written {
        return match (system.types.get(name.value), DataType::from_name(name.value)) {
            (Some(named), _) => of_type(named),
            (None, Some(DataType::Boolean)) => {
                ["0", "1"].iter().map(|bit| Offer::word(bit, CompletionItemKind::VALUE)).collect()
            }
            (None, _) => {
                let mut offers = members(wanted, Kind::Value, Some(name.value));
                offers.extend(members(wanted, Kind::Bit, Some(name.value)));
                offers
            }
        };
    }
    let entry = entry_around(&place.path).and_then(|id| {
        system.devices.iter().find_map(|device| device.entry(id)).and_then(|entry| entry.named_type.as_ref())
    });
    entry.map(|named| of_type(named)).unwrap_or_default()
}

pub(super) fn of_type(named: &NamedType) -> Vec<Offer> {
    match &named.kind {
        TypeKind::Enum(values) => values
            .iter()
            .map(|value| {
                let detail = value.value.to_string();
                Offer::name(&value.name, CompletionItemKind::ENUM_MEMBER).detail(detail)
            })
            .collect(),
        TypeKind::Bits(fields) => {
            let named = fields.iter().filter(|field| field.usage == BitUsage::Used && !field.name.is_empty());
            named
                .map(|field| {
                    let bits = if field.first == field.last {
                        format!("bit {}", field.first)
                    } else {
                        format!("bits {}..{}", field.first, field.last)
                    };
                    Offer::name(&field.name, CompletionItemKind::ENUM_MEMBER).detail(bits)
                })
                .collect()
        }
    }
}
