//! What is said about a device holds by itself: that a manual is silent, or prints something odd, is an erratum and no
//! text of an object.

use serde_json::Value as Json;

use super::{SYSTEMS, text};

/// These parts of a dump are about the manual and not about the device.
const ABOUT_THE_MANUAL: [&str; 4] = ["document", "errata", "gap", "origin"];

/// In the pitch system, `manual` is also a way of moving the axis by hand.
const BY_HAND: [&str; 8] =
    ["and", "command", "control", "function", "functions", "mode", "operation", "status"];

/// Words by which a text speaks of a page instead of a device.
const OF_A_PAGE: [&str; 14] = [
    "handbuch",
    "anleitung",
    "gedruckt",
    "printed",
    "prints",
    "not stated",
    "not described",
    "not said",
    "does not say",
    "no sign convention",
    "nicht gesagt",
    "nicht angegeben",
    "nicht genannt",
    "nicht beschrieben",
];

/// Whether a text speaks of a manual.
fn speaks_of_a_manual(text: &str) -> bool {
    let text = text.to_lowercase();
    let words: Vec<&str> =
        text.split(|letter: char| !letter.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let manual =
        |at: usize| words[at] == "manual" && !words.get(at + 1).is_some_and(|next| BY_HAND.contains(next));
    OF_A_PAGE.iter().any(|words| text.contains(words)) || (0..words.len()).any(manual)
}

/// The texts of a part of a dump, in every language, each with the way to it.
fn texts(part: &Json, way: &str, found: &mut Vec<(String, String)>) {
    match part {
        Json::String(text) => found.push((way.to_owned(), text.clone())),
        Json::Array(items) => {
            for (at, item) in items.iter().enumerate() {
                texts(item, &format!("{way}[{at}]"), found);
            }
        }
        Json::Object(items) => {
            for (key, item) in items.iter().filter(|(key, _)| !ABOUT_THE_MANUAL.contains(&key.as_str())) {
                texts(item, &format!("{way}.{key}"), found);
            }
        }
        Json::Null | Json::Bool(_) | Json::Number(_) => {}
    }
}

#[test]
fn texts_of_objects_do_not_speak_of_the_manual() {
    for name in SYSTEMS {
        let dump: Json = serde_json::from_str(&text(&format!("generated/{name}.json"))).unwrap();
        let mut found = Vec::new();
        texts(&dump, name, &mut found);
        assert!(found.len() > 1000, "{name}: {} texts", found.len());
        let wrong: Vec<_> = found.iter().filter(|(_, text)| speaks_of_a_manual(text)).collect();
        assert!(wrong.is_empty(), "{wrong:#?}");
    }
}

#[test]
fn remarks_about_a_manual_are_distinguished_from_functions_by_hand() {
    for remark in [
        "Row left blank in the manual.",
        "Booster current. The manual states no sign convention.",
        "Nach CiA 402: keine Methode. Das Handbuch nennt den Wert nicht.",
        "Selector switch; its coding is not stated.",
    ] {
        assert!(speaks_of_a_manual(remark), "{remark}");
    }
    for reported in ["Push-button of the manual function.", "Manual command that the PMM passes to its PMC."]
    {
        assert!(!speaks_of_a_manual(reported), "{reported}");
    }
}
