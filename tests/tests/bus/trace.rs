//! Traces in words: PDOs that the generated Rust packs are reported with the values that were put in.

#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a test fails by panicking, and counts")]

use firmware_glue::frame::{CanId, Frame};
use firmware_glue::table::Place;
use firmware_glue::{Dictionary, pdo};
use od_bus::trace::{Decoder, Node};
use od_generated::{fullmo::Fullmo, pmc::Pmc, pmm::Pmm};
use od_tests::fuzz::Random;
use od_tests::{compile_clean, root};
use serde_json::Value as Json;

const PITCH: &str = "od-spec/devices/pitch-control-system.od.yaml";
const FULLMO: &str = "od-spec/devices/fullmo-drive.od.yaml";
const NODE: u8 = 5;

fn number(json: &Json) -> i128 {
    let wide = json.as_i64().map(i128::from).or_else(|| json.as_u64().map(i128::from));
    wide.or_else(|| json.as_str()?.parse().ok()).unwrap()
}

/// A decimal number as a fraction.
fn fraction(text: &str) -> (i128, i128) {
    let (whole, decimals) = text.split_once('.').unwrap_or((text, ""));
    let digits: i128 = format!("{whole}{decimals}").parse().unwrap();
    (digits, 10_i128.pow(u32::try_from(decimals.len()).unwrap()))
}

/// Whether a value is reported as the dump says that it is to be understood.
fn is_told(dump: &Json, entry: &Json, raw: i128, described: &str) -> bool {
    let named = entry.get("named-type").map(|name| {
        let types = dump["types"].as_array().unwrap();
        types.iter().find(|one| one["name"] == *name).unwrap()
    });
    if let Some(special) =
        entry["special"].as_array().into_iter().flatten().find(|one| number(&one["value"]) == raw)
    {
        return described.contains(special["name"].as_str().unwrap());
    }
    if let Some(values) = named.and_then(|named| named["values"].as_array()) {
        let known = values.iter().find(|value| number(&value["value"]) == raw);
        return known.map_or(described.starts_with(&raw.to_string()), |value| {
            described.starts_with(value["name"].as_str().unwrap())
        });
    }
    if named.is_some_and(|named| named["bits"].is_array()) {
        let pattern = described.split([' ', ',']).next().unwrap();
        return i128::from_str_radix(pattern.strip_prefix("0x").unwrap(), 16).unwrap() == raw;
    }
    let amount = described.split(' ').next().unwrap();
    let unit = entry.get("unit").filter(|unit| !unit.is_null());
    let Some(unit) = unit else { return amount.parse() == Ok(raw) };
    let unit = dump["units"].as_array().unwrap().iter().find(|one| one["name"] == *unit).unwrap();
    let (n, d) = (number(&unit["scale"][0]), number(&unit["scale"][1]));
    let (on, od) = unit.get("offset").map_or((0, 1), |offset| (number(&offset[0]), number(&offset[1])));
    let (told_n, told_d) = fraction(amount);
    // raw × n/d + on/od = reported
    (raw * n * od + on * d) * told_d == told_n * d * od
        && described.contains(unit["symbol"].as_str().unwrap())
}

/// Maps every entry that a TPDO can carry, packs it with values by chance, and reads what is reported about it.
fn try_device<D: Dictionary<'static>>(path: &str, stem: &str, key: &str, mut dictionary: D) {
    let system = compile_clean(path).unwrap();
    let device = system.device(key).unwrap();
    let dump = std::fs::read(root().join(format!("generated/{stem}.json"))).unwrap();
    let dump: Json = serde_json::from_slice(&dump).unwrap();
    let of_dump = dump["devices"].as_array().unwrap().iter().find(|one| one["key"] == key).unwrap();
    let mut decoder = Decoder::new(vec![Node::new(NODE, &system, device)]);
    let mut random = Random::new(7);
    let (mut entries, mut values) = (0, 0);
    for object in of_dump["objects"].as_array().unwrap() {
        let (index, _) = id(object["index"].as_str().unwrap()).unwrap();
        for entry in object["entries"].as_array().unwrap() {
            let sub = u8::try_from(entry["sub"].as_u64().unwrap()).unwrap();
            let info = dictionary.info_at(index, sub).unwrap();
            if !info.is_transmittable() {
                continue;
            }
            map_alone(&mut dictionary, &mut decoder, index, sub, info.size());
            entries += 1;
            for _ in 0..50 {
                put(&mut dictionary, index, sub, &mut random);
                let described = decoder.frame(&pack(&mut dictionary));
                let held = dictionary.read(index, sub).unwrap().to_vec();
                let raw = raw(entry["type"].as_str().unwrap(), &held);
                let place = if sub == 0 { format!("{index:04X}h ") } else { format!("{index:04X}h.{sub} ") };
                let value = described.split_once(&place).and_then(|(_, text)| text.split_once(" = "));
                let (_, value) = value.unwrap_or_else(|| panic!("{place} is not reported: {described}"));
                assert!(is_told(&dump, entry, raw, value), "{key} {place}{raw}: {described}");
                values += 1;
            }
        }
    }
    println!("{key}: {values} values of {entries} entries in PDOs are reported as they were packed");
    assert!(entries > 5, "{entries} entries only");
}

/// Maps one entry into TPDO1, on the device and in what the decoder sees.
fn map_alone<D: Dictionary<'static>>(
    dictionary: &mut D,
    decoder: &mut Decoder<'_>,
    index: u16,
    sub: u8,
    size: u16,
) {
    let cob_id = u32::from_le_bytes(dictionary.read(0x1800, 1).unwrap().bytes().try_into().unwrap());
    let off = 1 << 31;
    let parameter = u32::from(index) << 16 | u32::from(sub) << 8 | u32::from(8 * size);
    let writes = [
        (0x1800, 1, cob_id | off, 4),
        (0x1A00, 0, 0, 1),
        (0x1A00, 1, parameter, 4),
        (0x1A00, 0, 1, 1),
        (0x1800, 1, cob_id & !off, 4),
    ];
    for (index, sub, value, size) in writes {
        let value: u32 = value;
        let bytes = value.to_le_bytes();
        dictionary.write(index, sub, &bytes[..size], &mut ()).unwrap();
        let command = 0x23 | u8::try_from(4 - size).unwrap() << 2;
        let [low, high] = u16::to_le_bytes(index);
        let frame = |id: u16, command: u8, data: [u8; 4]| {
            let [a, b, c, d] = data;
            Frame::full(CanId::new(id).unwrap(), [command, low, high, sub, a, b, c, d])
        };
        decoder.frame(&frame(0x600 + u16::from(NODE), command, bytes));
        decoder.frame(&frame(0x580 + u16::from(NODE), 0x60, [0; 4]));
    }
}

/// TPDO1, as the device sends it.
fn pack<D: Dictionary<'static>>(dictionary: &mut D) -> Frame {
    let packed = pdo::pack(dictionary, 1, &mut ()).unwrap();
    Frame::data(CanId::new(0x180 + u16::from(NODE)).unwrap(), &packed).unwrap()
}

/// Gives an entry bytes by chance, whatever its access; what lies not in the image keeps its value.
fn put<D: Dictionary<'static>>(dictionary: &mut D, index: u16, sub: u8, random: &mut Random) {
    let table = dictionary.table();
    let row = table.find(index, sub).unwrap();
    let shared = table.attributes(row);
    if shared.place != Place::Image {
        return;
    }
    let start = usize::from(shared.page) << 16 | usize::from(table.parts().entries[usize::from(row)].place);
    for byte in &mut dictionary.image_mut()[start..start + usize::from(shared.size)] {
        *byte = u8::try_from(if random.chance(50) { random.below(4) } else { random.below(256) }).unwrap();
    }
}

fn id(text: &str) -> Option<(u16, u8)> {
    let (index, sub) = text.split_once('.').unwrap_or((text, "0"));
    Some((u16::from_str_radix(index.strip_prefix("0x")?, 16).ok()?, sub.parse().ok()?))
}

fn raw(data_type: &str, bytes: &[u8]) -> i128 {
    let negative = data_type.starts_with("integer") && bytes.last().unwrap() & 0x80 != 0;
    let mut wide = [if negative { 0xFF } else { 0 }; 16];
    wide[..bytes.len()].copy_from_slice(bytes);
    i128::from_le_bytes(wide)
}

#[test]
fn pdos_of_the_generated_rust_are_reported_with_their_values() {
    try_device(PITCH, "pitch-control-system", "pmc", Pmc::new(NODE));
    try_device(PITCH, "pitch-control-system", "pmm", Pmm::new(NODE));
    try_device(FULLMO, "fullmo-drive", "fullmo", Fullmo::new(NODE));
}
