//! The resolved model as JSON, for programs and for comparisons. The format is described in `docs/book/formats/json.md`.

mod device;
mod document;
mod node;
mod rules;
mod types;

use std::collections::BTreeMap;

use od_spec::Commissioning;
use od_spec::eds::MARK;
use od_spec::model::{self, Date, DateTime, Devices, Dictionary, EntryId, Phrases, System, Text};
use serde::{Serialize, Serializer};
use serde_json::{Value as Json, json};

use device::DeviceView;
use document::DocumentView;
use node::NodeView;
use rules::{ConstraintView, ErratumView, ErrorView, MachineView};
use types::{TypeView, UnitView};

/// Version of the format; raised when a consumer would have to change.
const FORMAT: u32 = 1;

/// The dump of a system, or of the devices with these keys (none means all); ends with a line break.
pub fn dump(system: &System, devices: &[String]) -> Vec<u8> {
    print(system, devices, None)
}

/// The dump of a system that was read from a DCF, with the node that this configures and the node-ID, if there is one.
pub fn dump_node(system: &System, devices: &[String], node: &Commissioning, id: Option<u8>) -> Vec<u8> {
    let view = system.devices.first().map(|device| NodeView::new(device, node, id));
    print(system, devices, view)
}

fn print(system: &System, devices: &[String], node: Option<NodeView<'_>>) -> Vec<u8> {
    let devices = Devices::listed(devices);
    let wanted = |device: &&Dictionary| devices.includes(&device.key);
    let dump = SystemView {
        od_json: FORMAT,
        made: MARK,
        title: &system.title,
        languages: &system.languages,
        vendor: json!({"name": system.vendor.name, "number": system.vendor.number}),
        document: document::document(system),
        units: system.units.values().map(|unit| types::unit_view(unit)).collect(),
        types: system.types.values().map(|named| types::type_view(named)).collect(),
        devices: system.devices.iter().filter(wanted).map(DeviceView::new).collect(),
        node,
        errors: system.errors.iter().map(rules::error).collect(),
        state_machines: system.machines.values().map(rules::machine).collect(),
        constraints: system.constraints.iter().map(rules::constraint).collect(),
        errata: system.errata.iter().map(|erratum| rules::erratum(erratum, &system.document)).collect(),
    };
    let entries: usize = system.devices.iter().map(|device| device.entries().count()).sum();
    let mut text = Vec::with_capacity(2048 * entries);
    // Maps with text keys and plain values only, into memory: this cannot fail.
    let _ = serde_json::to_writer_pretty(&mut text, &dump);
    text.push(b'\n');
    text
}

#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct SystemView<'a> {
    od_json: u32,
    made: &'static str,
    title: &'a str,
    languages: &'a [String],
    vendor: Json,
    document: DocumentView<'a>,
    units: Vec<UnitView<'a>>,
    types: Vec<TypeView<'a>>,
    devices: Vec<DeviceView<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    node: Option<NodeView<'a>>,
    errors: Vec<ErrorView<'a>>,
    state_machines: Vec<MachineView<'a>>,
    constraints: Vec<ConstraintView<'a>>,
    errata: Vec<ErratumView<'a>>,
}

/// A text as a map from language code to text.
struct Words<'a>(&'a Text);

impl Words<'_> {
    fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl Serialize for Words<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter())
    }
}

const fn words(text: &Text) -> Words<'_> {
    Words(text)
}

/// A description, and where the printed manual leaves something open, what that is.
#[derive(Serialize)]
struct Described<'a> {
    about: Words<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gap: Option<Words<'a>>,
}

fn described(text: &Text) -> Described<'_> {
    Described { about: words(text), gap: text.gap().map(words) }
}

/// A map with the description of what it is about.
fn with_description(mut map: Json, text: &Text) -> Json {
    if let (Some(map), Ok(Json::Object(described))) =
        (map.as_object_mut(), serde_json::to_value(described(text)))
    {
        map.extend(described);
    }
    map
}

/// Phrases by language.
type SearchWords<'a> = BTreeMap<&'a str, &'a [String]>;

fn search_words(phrases: &Phrases) -> SearchWords<'_> {
    phrases.iter().collect()
}

fn index(index: model::Index) -> String {
    index.notation()
}

/// `0x6040`, or `0x30FA.3` for a sub-index other than 0.
fn entry_id(id: EntryId) -> String {
    id.notation()
}

fn date(date: Date) -> String {
    format!("{:04}-{:02}-{:02}", date.year, date.month, date.day)
}

fn date_time(at: DateTime) -> String {
    format!("{} {:02}:{:02}", date(at.date), at.hour, at.minute)
}

fn ratio(ratio: model::Ratio) -> [Json; 2] {
    [integer(ratio.numerator()), integer(ratio.denominator())]
}

/// Any integer of CANopen fits 64 bits, signed or unsigned.
fn integer(value: i128) -> Json {
    match (i64::try_from(value), u64::try_from(value)) {
        (Ok(value), _) => json!(value),
        (_, Ok(value)) => json!(value),
        (Err(_), Err(_)) => json!(value.to_string()),
    }
}
