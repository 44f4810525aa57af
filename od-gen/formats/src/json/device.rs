//! Devices: objects, entries, PDOs.

use std::collections::{BTreeMap, BTreeSet};

use od_spec::model::{
    self, AnyError, Author, Dictionary, DynamicChannel, EditorNotes, Entry, Further, Index, KeyValue, Mapped,
    Object, Pdo, PdoTarget, Real, Value,
};
use od_spec::wording::{Notation, Wording};
use serde::{Serialize, Serializer};
use serde_json::{Value as Json, json};

use super::{
    Described, SearchWords, Words, date_time, described, entry_id, index, integer, ratio, search_words,
    with_description, words,
};
use crate::hexadecimal;

const WORDING: Wording = Wording::english(Notation::Json);

#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) struct DeviceView<'a> {
    key: &'a str,
    name: &'a str,
    #[serde(flatten)]
    about: Described<'a>,
    product_name: &'a str,
    product: u32,
    product_revision: u32,
    order_code: &'a str,
    bit_rates: &'a [u16],
    device_type: u32,
    granularity: u8,
    boot_up_master: bool,
    boot_up_slave: bool,
    group_messaging: bool,
    lss: bool,
    dummies: Vec<&'static str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    dynamic_channels: Vec<ChannelView>,
    #[serde(skip_serializing_if = "Option::is_none")]
    any_error: Option<AnyErrorView<'a>>,
    file: Json,
    #[serde(skip_serializing_if = "Option::is_none")]
    further: Option<Json>,
    objects: Objects<'a>,
    pdos: Vec<Json>,
}

impl<'a> DeviceView<'a> {
    pub(super) fn new(device: &'a Dictionary) -> Self {
        let (info, file) = (&device.info, &device.file);
        Self {
            key: &device.key,
            name: &device.name,
            about: described(&device.about),
            product_name: &info.product_name,
            product: info.product,
            product_revision: info.product_revision,
            order_code: &info.order_code,
            bit_rates: &info.bit_rates,
            device_type: info.device_type,
            granularity: info.granularity,
            boot_up_master: info.boot_up_master,
            boot_up_slave: info.boot_up_slave,
            group_messaging: info.group_messaging,
            lss: info.lss,
            dummies: info.dummies.iter().map(|data_type| data_type.name()).collect(),
            dynamic_channels: info.dynamic_channels.iter().map(ChannelView::new).collect(),
            any_error: AnyErrorView::new(&device.any_error),
            file: json!({
                "description": file.description,
                "created": date_time(file.created),
                "created-by": file.created_by,
                "modified": date_time(file.modified),
                "modified-by": file.modified_by,
                "version": file.version,
                "revision": file.revision,
            }),
            further: device.further.as_deref().filter(|further| !further.is_empty()).map(further_view),
            objects: Objects(device),
            pdos: device.pdos.iter().map(pdo_view).collect(),
        }
    }
}

/// What the EDS says in addition to the facts of the model.
fn further_view(further: &Further) -> Json {
    let values = |keys: &[KeyValue]| {
        keys.iter().map(|one| (one.key.clone(), one.value.clone().into())).collect::<serde_json::Map<_, _>>()
    };
    let indices = |indices: &BTreeSet<Index>| indices.iter().copied().map(index).collect::<Vec<_>>();
    let keys = further.keys.iter().map(|(name, keys)| (name.as_str(), values(keys)));
    let sections = further.all_sections().map(|section| (section.name.as_str(), values(&section.keys)));
    let modules = further.modules.iter().map(|(number, module)| {
        json!({
            "number": number,
            "product-name": module.product_name,
            "order-code": module.order_code,
            "brings": indices(&module.brings),
            "extends": indices(&module.extends),
        })
    });
    json!({
        "comments": further.comments.as_deref().unwrap_or_default(),
        "keys": keys.collect::<BTreeMap<_, _>>(),
        "sections": sections.collect::<BTreeMap<_, _>>(),
        "modules": modules.collect::<Vec<_>>(),
        "connected": further.connected,
    })
}

#[derive(Serialize)]
struct AnyErrorView<'a> {
    shown: Words<'a>,
    reaction: Words<'a>,
    reset: Words<'a>,
}

impl<'a> AnyErrorView<'a> {
    /// Nothing where the device says nothing.
    fn new(said: &'a AnyError) -> Option<Self> {
        let AnyError { shown, reaction, reset, .. } = said;
        let says_something = [shown, reaction, reset].into_iter().any(|text| !text.is_empty());
        says_something.then(|| Self { shown: words(shown), reaction: words(reaction), reset: words(reset) })
    }
}

#[derive(Serialize)]
struct ChannelView {
    first: String,
    last: String,
    #[serde(rename = "type")]
    data_type: &'static str,
    access: &'static str,
    offset: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    difference: Option<u32>,
}

impl ChannelView {
    fn new(channel: &DynamicChannel) -> Self {
        Self {
            first: index(channel.first),
            last: index(channel.last),
            data_type: channel.data_type.name(),
            access: channel.access.word(),
            offset: channel.offset,
            difference: channel.difference,
        }
    }
}

/// The objects of a device, viewed one by one as they are printed.
struct Objects<'a>(&'a Dictionary);

impl Serialize for Objects<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.objects.values().map(object_view))
    }
}

#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct ObjectView<'a> {
    index: String,
    name: &'a str,
    #[serde(rename = "eds-name", skip_serializing_if = "Option::is_none")]
    eds_name: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    identifier: Option<&'a str>,
    kind: String,
    origin: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    profile: Option<&'a str>,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    differs: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    category: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    since: Option<&'a str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    links: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    canopennode: Option<EditorView<'a>>,
    warning: Words<'a>,
    #[serde(flatten)]
    about: Described<'a>,
    #[serde(skip_serializing_if = "SearchWords::is_empty")]
    search: SearchWords<'a>,
    entries: Entries<'a>,
}

/// What the stack CANopenNode adds to an object.
#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct EditorView<'a> {
    group: Option<&'a str>,
    count: Option<&'a str>,
    srdo: BTreeMap<u8, &'static str>,
    requests_tpdos: bool,
}

impl<'a> EditorView<'a> {
    fn new(notes: &'a EditorNotes) -> Self {
        Self {
            group: notes.storage_group.as_deref(),
            count: notes.count_label.as_deref(),
            srdo: notes.srdos.iter().map(|(sub, mapping)| (sub.0, WORDING.mapping(*mapping))).collect(),
            requests_tpdos: notes.requests_tpdos,
        }
    }
}

fn object_view(object: &Object) -> ObjectView<'_> {
    ObjectView {
        index: index(object.index),
        name: &object.name,
        eds_name: other_name(&object.name, &object.eds_name()),
        identifier: object.identifier.as_deref(),
        kind: object.kind.name().to_lowercase(),
        origin: object.origin.word(),
        profile: object.profile.as_deref(),
        differs: object.departures.iter().map(|departure| WORDING.departure(*departure)).collect(),
        category: object.category.map(model::Category::word),
        since: object.since.as_deref(),
        links: object.linked().map(index).collect(),
        canopennode: object.editor.as_deref().filter(|notes| !notes.is_empty()).map(EditorView::new),
        warning: words(&object.warning),
        about: described(&object.about),
        search: search_words(&object.search),
        entries: Entries(object),
    }
}

/// The name as an EDS holds it, where that differs.
fn other_name(name: &str, in_eds: &str) -> Option<String> {
    (name != in_eds).then(|| in_eds.to_owned())
}

struct Entries<'a>(&'a Object);

impl Serialize for Entries<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.entries.iter().map(|entry| entry_view(self.0, entry)))
    }
}

#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct EntryView<'a> {
    sub: u8,
    name: &'a str,
    #[serde(rename = "eds-name", skip_serializing_if = "Option::is_none")]
    eds_name: Option<String>,
    #[serde(rename = "type")]
    data_type: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    named_type: Option<&'a str>,
    access: &'static str,
    locked: bool,
    pdo: &'static str,
    default: Option<ValueView>,
    low: Option<Json>,
    high: Option<Json>,
    #[serde(skip_serializing_if = "Option::is_none")]
    min: Option<Json>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max: Option<Json>,
    #[serde(skip_serializing_if = "Option::is_none")]
    unit: Option<&'a str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    special: Vec<Json>,
    stored: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    alias: Option<Json>,
    #[serde(skip_serializing_if = "Option::is_none")]
    category: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    since: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    writable_when: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    capacity: Option<u16>,
    #[serde(skip_serializing_if = "Option::is_none")]
    identifier: Option<&'a str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    bit_errors: Vec<Json>,
    eds: EdsView,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    standard: Vec<&'static str>,
    warning: Words<'a>,
    #[serde(flatten)]
    about: Described<'a>,
    #[serde(skip_serializing_if = "SearchWords::is_empty")]
    search: SearchWords<'a>,
}

/// What an EDS says of an entry.
#[derive(Serialize)]
struct EdsView {
    access: &'static str,
    default: &'static str,
    flags: u32,
}

fn real(limit: Option<&Real>) -> Option<Json> {
    limit.map(|limit| json!(limit.number()))
}

fn entry_view<'o>(object: &'o Object, entry: &'o Entry) -> EntryView<'o> {
    let place = object.index;
    let (low, high) = entry.hull();
    EntryView {
        sub: entry.sub.0,
        name: &entry.name,
        eds_name: other_name(&entry.name, &object.eds_name_of(entry)),
        data_type: entry.data_type.name(),
        named_type: entry.named_type.as_ref().map(|named| named.name.as_str()),
        access: entry.access.word(),
        locked: entry.locked,
        pdo: WORDING.mapping(entry.pdo),
        default: entry.default.as_ref().map(|default| value(place, entry, default)),
        low: low.map(integer).or_else(|| real(entry.real_limits.low.as_ref())),
        high: high.map(integer).or_else(|| real(entry.real_limits.high.as_ref())),
        min: entry.low.filter(|min| low != Some(*min)).map(integer),
        max: entry.high.filter(|max| high != Some(*max)).map(integer),
        unit: entry.unit.as_ref().map(|unit| unit.name.as_str()),
        special: entry
            .special
            .iter()
            .map(|special| json!({"value": integer(special.value), "name": special.name, "about": words(&special.about)}))
            .collect(),
        stored: WORDING.storage(entry.stored),
        alias: entry.alias.as_ref().map(|alias| {
            json!({
                "of": entry_id(alias.target),
                "factor": ratio(alias.factor),
                "rounding": alias.rounding.word(),
                "outside": alias.outside.word(),
            })
        }),
        category: entry.category.map(model::Category::word),
        since: entry.since.as_deref(),
        writable_when: entry.writable_when.as_ref().map(|condition| condition.text.as_str()),
        capacity: entry.capacity,
        identifier: entry.identifier.as_deref(),
        bit_errors: entry
            .bit_errors
            .iter()
            .map(|errors| {
                let codes: Vec<String> = errors.error_codes().map(|code| hexadecimal::prefixed(code, 4)).collect();
                json!({"bit": errors.bit, "errors": codes})
            })
            .collect(),
        eds: EdsView {
            access: entry.eds.access.word(),
            default: if entry.eds.default { "written" } else { "withheld" },
            flags: entry.eds.flags(),
        },
        standard: entry.facts.said_by(Author::Library).map(|fact| WORDING.fact(fact)).collect(),
        warning: words(&entry.warning),
        about: described(&entry.about),
        search: search_words(&entry.search),
    }
}

/// A value: `raw` for numbers, `formula` for node-ID formulas, `text` for people.
#[derive(Serialize)]
pub(super) struct ValueView {
    #[serde(skip_serializing_if = "Option::is_none")]
    formula: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    raw: Option<Json>,
    #[serde(skip_serializing_if = "Option::is_none")]
    text: Option<String>,
}

pub(super) fn value(place: Index, entry: &Entry, value: &Value) -> ValueView {
    let words = Some(WORDING.value(Some(place), entry, value));
    let (formula, raw, text) = match value {
        Value::Integer(raw) => (None, Some(integer(*raw)), words),
        Value::NodeId(offset) => (words, Some(json!(offset)), None),
        Value::Real(real) => (None, Some(json!(real.number())), words),
        Value::Text(_) | Value::Bytes(_) => (None, None, words),
    };
    ValueView { formula, raw, text }
}

fn pdo_view(pdo: &Pdo) -> Json {
    let map: Vec<Json> = pdo
        .map
        .iter()
        .map(|Mapped { target, bits }| match target {
            PdoTarget::Entry(id) => json!({"entry": entry_id(*id), "bits": bits}),
            PdoTarget::Dummy(data_type) => json!({"dummy": data_type.name(), "bits": bits}),
        })
        .collect();
    let cob_id = pdo.cob_id.as_ref().map(|cob_id| match cob_id {
        Value::NodeId(offset) => json!({"formula": WORDING.node_id_formula(*offset), "raw": offset}),
        fixed @ (Value::Integer(_) | Value::Real(_) | Value::Text(_) | Value::Bytes(_)) => {
            json!({"raw": fixed.integer().map(integer)})
        }
    });
    let json = json!({
        "direction": pdo.direction.word(),
        "number": pdo.number,
        "cob-id": cob_id,
        "valid": pdo.valid,
        "transmission": pdo.transmission,
        "inhibit-time": pdo.inhibit_time,
        "event-timer": pdo.event_timer,
        "sync-start": pdo.sync_start,
        "mapping": if pdo.variable_mapping { "variable" } else { "fixed" },
        "capacity": pdo.capacity,
        "map": map,
    });
    with_description(json, &pdo.about)
}
