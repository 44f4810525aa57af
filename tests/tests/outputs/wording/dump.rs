//! What the JSON dump says.

use std::collections::BTreeMap;

use od_spec::ascii::transliterate;
use od_spec::model::{Access, Entry, Ratio, Value};
use serde_json::Value as Json;

use super::Output;
use super::facts::{Facts, Limits, Reach, Reported, Step};
use super::read;

/// Reads the dump of one device.
pub(crate) fn read(dump: &Json, output: &mut Output<'_>) {
    let units: BTreeMap<&str, Step> = dump["units"].as_array().unwrap().iter().map(unit).collect();
    let device =
        dump["devices"].as_array().unwrap().iter().find(|device| device["key"] == output.device.key.as_str());
    for object in device.unwrap()["objects"].as_array().unwrap() {
        let index =
            u16::from_str_radix(object["index"].as_str().unwrap().trim_start_matches("0x"), 16).unwrap();
        for shown in object["entries"].as_array().unwrap() {
            let sub = u8::try_from(shown["sub"].as_u64().unwrap()).unwrap();
            output.report(index, sub, |entry| facts(entry, shown, &units));
        }
    }
}

fn unit(unit: &Json) -> (&str, Step) {
    let scale = [0, 1].map(|at| i128::from(unit["scale"][at].as_i64().unwrap()));
    let symbol = transliterate(unit["symbol"].as_str().unwrap());
    (unit["name"].as_str().unwrap(), Step { scale: Ratio::new(scale[0], scale[1]).unwrap(), symbol })
}

fn integer(json: &Json) -> Option<i128> {
    json.as_i64().map(i128::from).or_else(|| json.as_u64().map(i128::from))
}

/// A default; where it has both, its text has to say the raw value.
fn default(entry: &Entry, json: &Json) -> Option<Value> {
    if let Some(formula) = json.get("formula") {
        let value = read::value(entry, formula.as_str().unwrap());
        assert_eq!(value, Value::NodeId(json["raw"].as_u64().unwrap()));
        return Some(value);
    }
    let value = read::value(entry, json.get("text")?.as_str().unwrap());
    if let Value::Integer(raw) = value {
        assert_eq!(Some(raw), integer(&json["raw"]), "{json}");
    }
    Some(value)
}

fn facts(entry: &Entry, shown: &Json, units: &BTreeMap<&str, Step>) -> Facts {
    let word = |key: &str| shown[key].as_str().unwrap();
    let limit = |key: &str, widened: &str| integer(&shown[key]).or_else(|| integer(&shown[widened]));
    let special = shown.get("special").and_then(Json::as_array).into_iter().flatten();
    let special = special.map(|special| {
        (integer(&special["value"]).unwrap(), transliterate(special["name"].as_str().unwrap()))
    });
    Facts {
        default: Reported::Said(default(entry, &shown["default"])),
        limits: Limits::Exact { low: limit("min", "low"), high: limit("max", "high") },
        step: shown.get("unit").and_then(Json::as_str).map(|name| units[name].clone()),
        special: special.collect(),
        reach: Reach::of(Access::from_word(word("access")).unwrap(), shown["locked"].as_bool().unwrap()),
        storage: read::storage(word("stored")).unwrap(),
        mapping: read::mapping(word("pdo")).unwrap(),
    }
}
