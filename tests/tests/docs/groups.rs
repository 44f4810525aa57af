//! The contents of a device's page: its objects by what they are for.

use od_tests::documents;

use super::{EVERYTHING, FULLMO, PITCH};

/// Titles and indices of the groups of a device, by the device's key.
fn groups(spec: &str, key: &str) -> Vec<(String, Vec<String>)> {
    let context = documents::context(spec, "en").unwrap();
    let text = |value: &serde_json::Value| value.as_str().unwrap().to_owned();
    let device = context["devices"].as_array().unwrap().iter().find(|device| device["key"] == key).unwrap();
    let objects = device["objects"].as_array().unwrap();
    let groups: Vec<(String, Vec<String>)> = device["groups"]
        .as_array()
        .unwrap()
        .iter()
        .map(|group| {
            let objects = group["objects"].as_array().unwrap();
            (text(&group["title"]), objects.iter().map(|object| text(&object["index"])).collect())
        })
        .collect();
    let mut grouped: Vec<&String> = groups.iter().flat_map(|(_, objects)| objects).collect();
    grouped.sort();
    let all: Vec<String> = objects.iter().map(|object| text(&object["index"])).collect();
    assert_eq!(grouped, all.iter().collect::<Vec<_>>(), "{key}: each object is in one group");
    groups
}

fn titles(groups: &[(String, Vec<String>)]) -> Vec<&str> {
    groups.iter().map(|(title, _)| title.as_str()).collect()
}

#[test]
fn short_chapters_are_groups_in_the_order_of_the_manual() {
    let groups = groups(FULLMO, "fullmo");
    assert_eq!(
        titles(&groups),
        [
            "1 Controlling the power drive system",
            "2 Profile Position Mode",
            "3 Profile Velocity Mode",
            "4 Homing Mode",
            "5 Profile Torque Mode",
            "6 Position control function",
            "7 Input Functions",
            "8 Objects of the maker",
            "Communication objects",
        ]
    );
    let chapter = groups.iter().find(|(title, _)| title == "4 Homing Mode").unwrap();
    assert!(chapter.1.contains(&"6098h".to_owned()), "{chapter:?}");
}

#[test]
fn a_long_chapter_is_divided_into_its_functions() {
    let groups = groups(PITCH, "pmc");
    let found = titles(&groups);
    assert!(found.contains(&"5.8 Drive Control"), "{found:?}");
    assert!(!found.contains(&"5 The Pitch Motion Controller (PMC)"), "{found:?}");
    // The error register is in a chapter, too, and is looked for among the communication objects.
    let (title, last) = groups.last().unwrap();
    assert_eq!((title.as_str(), last.first().map(String::as_str)), ("Communication objects", Some("1000h")));
    assert!(
        last.contains(&"1001h".to_owned()) && last.iter().all(|index| index.starts_with('1')),
        "{last:?}"
    );
}

#[test]
fn without_a_manual_the_areas_are_groups() {
    let groups = groups(EVERYTHING, "everything");
    assert_eq!(
        titles(&groups),
        [
            "Manufacturer-specific objects",
            "Device profile objects",
            "Further objects",
            "Communication objects"
        ]
    );
}
