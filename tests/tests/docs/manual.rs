//! The manual to be printed: one page with all chapters and devices.

use std::collections::BTreeSet;

use od_documents::{self as docs, Format, Options, Templates};
use od_tests::memo::Memo;

use super::{EVERYTHING, FULLMO, PITCH, TWO, compile_clean};

/// The manual of a specification, with or without its errata.
fn manual(spec: &str, errata: bool) -> &'static str {
    static PRINTED: Memo<(String, bool), String> = Memo::empty();
    let print = || {
        let system = compile_clean(spec)?;
        let templates = [Templates::new(Some(Format::Print), &[])?];
        let options = Options { errata, ..docs::options(&system, &[], None) };
        let files = docs::artifacts(&system, "", "s", &options, &templates)?;
        let file = files.into_iter().find(|file| file.path == "s/manual.html").unwrap();
        Ok(String::from_utf8(file.bytes)?)
    };
    PRINTED.get((spec.to_owned(), errata), print).unwrap()
}

/// What is in quotation marks after a text, each time.
fn behind<'t>(page: &'t str, text: &'t str) -> impl Iterator<Item = &'t str> {
    page.split(text).skip(1).filter_map(|rest| rest.split('"').next())
}

#[test]
fn every_link_leads_to_one_place() {
    for spec in [PITCH, FULLMO, TWO, "tests/docs/links.od.yaml", EVERYTHING] {
        for errata in [false, true] {
            let page = manual(spec, errata);
            let mut ids = BTreeSet::new();
            for id in behind(page, " id=\"") {
                assert!(ids.insert(id), "{spec}: {id} is there twice");
            }
            let links: Vec<&str> = behind(page, "href=\"").collect();
            assert!(!links.is_empty(), "{spec} has no links");
            for link in links {
                assert!(
                    link.strip_prefix('#').is_some_and(|id| ids.contains(id)),
                    "{spec}: {link} leads nowhere"
                );
            }
        }
    }
}

#[test]
fn errata_are_in_the_manual_on_request_only() {
    let (plain, compared) = (manual(PITCH, false), manual(PITCH, true));
    for part in
        ["class=\"mark\"", "class=\"errata-of\"", "id=\"errata\"", "id=\"erratum-1\"", "id=\"tables\""]
    {
        assert!(!plain.contains(part) && compared.contains(part), "{part}");
    }
}

#[test]
fn each_device_has_what_no_chapter_shows() {
    let page = manual(PITCH, false);
    for id in ["pmm-1018", "pmc-1018", "pmm-1018.1", "pmc-tpdo-1", "6040"] {
        assert!(page.contains(&format!(" id=\"{id}\"")), "{id}");
    }
    // A chapter shows it, so that it is not after the chapters again.
    assert!(!page.contains("id=\"pmc-6040\""));
}

#[test]
fn a_manual_of_a_specification_without_chapters_has_every_object() {
    let page = manual(EVERYTHING, false);
    let system = compile_clean(EVERYTHING).unwrap();
    for device in &system.devices {
        for index in device.objects.keys() {
            let id = format!(" id=\"{}-{:04X}\"", device.key, index.0);
            assert!(page.contains(&id), "{id}");
        }
    }
}
