//! `odgen docs` and its templates.

use std::fs;

use insta::assert_snapshot;

use crate::{LAMP, Scratch, code, files, odgen, stderr, stdout};

#[test]
fn docs_prints_both_formats_of_a_small_specification() {
    let scratch = Scratch::new("docs");
    scratch.file("lamp.od.yaml", LAMP);
    let arguments = ["docs", "lamp.od.yaml", "--format", "md", "--format", "html", "--out", "out"];
    let output = odgen(&scratch.0, &arguments);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    let names = ["lamp/README.md", "lamp/index.html", "lamp/lamp.html", "lamp/lamp.md", "lamp/units.md"];
    assert_eq!(files(&scratch.0.join("out")), names);
    assert_snapshot!(fs::read_to_string(scratch.0.join("out/lamp/lamp.md")).unwrap());
    // In another language, with a sentence about what has no words in it.
    let output = odgen(&scratch.0, &["docs", "lamp.od.yaml", "--lang", "de", "--out", "de"]);
    assert_eq!(code(&output), 0);
    let german = fs::read_to_string(scratch.0.join("de/lamp/lamp.md")).unwrap();
    assert!(
        german.contains("| Index | Name") && german.contains("Zugriff") && german.contains("Vorgabe"),
        "{german}"
    );
    assert!(german.contains("nicht übersetzt ist, gibt es nur auf Englisch."), "{german}");
}

#[test]
fn several_documents_have_one_start_page() {
    let scratch = Scratch::new("portal");
    scratch.file("lamp.od.yaml", LAMP);
    scratch.file("fan.od.yaml", LAMP.replace("Lamp", "Fan"));
    let html = ["docs", "lamp.od.yaml", "fan.od.yaml", "--format", "html", "--out"];
    let read = |path: &str| fs::read_to_string(scratch.0.join(path)).unwrap().replace("&#x2f;", "/");
    let output = odgen(&scratch.0, &[&html[..], &["one"]].concat());
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    let names = ["fan/index.html", "fan/lamp.html", "index.html", "lamp/index.html", "lamp/lamp.html"];
    assert_eq!(files(&scratch.0.join("one")), names);
    let start = read("one/index.html");
    for link in
        ["href=\"lamp/index.html\"", "href=\"fan/lamp.html\"", "[\"fan/lamp.html\",\"Fan\",[[\"1000\""]
    {
        assert!(start.contains(link), "{link} is missing in {start}");
    }
    assert!(read("one/fan/lamp.html").contains("<a href=\"../index.html\">All documents</a>"));
    // Each language has a folder of its own, and pages lead to one another.
    let output = odgen(&scratch.0, &[&html[..], &["two", "--lang", "en", "--lang", "de"]].concat());
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    assert!(read("two/index.html").contains("href=\"lamp/de/lamp.html\""));
    let english = read("two/lamp/en/lamp.html");
    assert!(
        english.contains("href=\"../de/lamp.html\" hreflang=\"de\" lang=\"de\">Deutsch</a>"),
        "{english}"
    );
    assert!(english.contains("<a href=\"../../index.html\">All documents</a>"), "{english}");
    // A single document needs none.
    let output =
        odgen(&scratch.0, &["docs", "lamp.od.yaml", "--format", "html", "--lang", "de", "--out", "three"]);
    assert_eq!(code(&output), 0);
    assert_eq!(files(&scratch.0.join("three")), ["lamp/index.html", "lamp/lamp.html"]);
}

#[test]
fn pages_show_what_changed_since_an_earlier_specification() {
    let scratch = Scratch::new("since");
    scratch.file("old.od.yaml", LAMP);
    scratch.file("lamp.od.yaml", LAMP.replace("default: 80 %", "default: 70 %"));
    let since = ["docs", "lamp.od.yaml", "--since", "old.od.yaml", "--format", "html", "--out", "out"];
    let output = odgen(&scratch.0, &since);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    let page = fs::read_to_string(scratch.0.join("out/lamp/lamp.html")).unwrap();
    assert_eq!(
        page.matches("<p class=\"changed\"><a href=\"#changes\">Changed since old.od.yaml</a></p>").count(),
        1
    );
    for shown in ["default: 80 % → 70 %", ">2000h</a>", "Objects that changed have a bar"] {
        assert!(page.contains(shown), "{shown} is missing in {page}");
    }
    // Without a difference, there is nothing to list.
    let same = ["docs", "lamp.od.yaml", "--since", "lamp.od.yaml", "--format", "html", "--out", "same"];
    assert_eq!(code(&odgen(&scratch.0, &same)), 0);
    assert!(!fs::read_to_string(scratch.0.join("same/lamp/lamp.html")).unwrap().contains("id=\"changes\""));
    // Which of several specifications is compared would be a guess.
    let output = odgen(&scratch.0, &["docs", "lamp.od.yaml", "old.od.yaml", "--since", "old.od.yaml"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("`--since` compares one specification"), "{}", stderr(&output));
}

#[test]
fn a_manual_to_be_printed_shows_errata_on_request() {
    let scratch = Scratch::new("print");
    scratch.file("lamp.od.yaml", LAMP);
    let print = ["docs", "lamp.od.yaml", "--format", "print", "--out", "out"];
    let output = odgen(&scratch.0, &print);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    assert_eq!(files(&scratch.0.join("out")), ["lamp/manual.html"]);
    assert_eq!(code(&odgen(&scratch.0, &[&print[..], &["--errata"]].concat())), 0);
    // The command does not wait for marks that never come.
    let output =
        odgen(&scratch.0, &["docs", "lamp.od.yaml", "--format", "html", "--errata", "--out", "none"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("add `--format print`"), "{}", stderr(&output));
    assert!(!scratch.0.join("none").exists());
}

#[test]
fn a_mistake_in_a_template_has_a_place_and_nothing_is_written() {
    let scratch = Scratch::new("templates");
    scratch.file("lamp.od.yaml", LAMP);
    fs::create_dir(scratch.0.join("own")).unwrap();
    let mut said = String::new();
    for template in [
        "{{ device.nmae }}\n",
        "first line\n{% for one in devices %}\n",
        "{% include \"_absent.txt\" %}\n",
        "{{ device.name|shout }}\n",
    ] {
        scratch.file("own/device.txt", template);
        let output = odgen(&scratch.0, &["docs", "lamp.od.yaml", "--templates", "own", "--out", "out"]);
        assert_eq!((code(&output), stdout(&output)), (1, String::new()), "{template}");
        said.push_str(&stderr(&output));
    }
    assert_snapshot!(said);
    assert!(!scratch.0.join("out").exists());
}

/// A template that would never end, or would take all memory, ends with a message, and nothing is written.
#[test]
fn templates_without_end_are_stopped() {
    let scratch = Scratch::new("endless");
    scratch.file("lamp.od.yaml", LAMP);
    fs::create_dir(scratch.0.join("own")).unwrap();
    let thousand = "{% for a in range(1000) %}{% for b in range(1000) %}{% for c in range(1000) %}";
    let ends = "{% endfor %}{% endfor %}{% endfor %}";
    let mut said = String::new();
    for template in [
        format!("{thousand}{ends}"),
        "{% macro f(n) %}{{ f(n + 1) }}{{ f(n + 1) }}{% endmacro %}{{ f(0) }}".to_owned(),
        format!("{thousand}{{{{ 'x' * 1000000 }}}}{ends}"),
        format!("{thousand}{}{ends}", "x".repeat(10_000)),
        // Few steps, and 8 GiB of memory.
        "{% set all = namespace(text='x') %}{% for _ in range(33) %}{% set all.text = all.text ~ all.text %}{% endfor %}"
            .to_owned(),
    ] {
        scratch.file("own/device.txt", &template);
        let output = odgen(
            &scratch.0,
            &["--format", "short", "docs", "lamp.od.yaml", "--templates", "own", "--out", "out"],
        );
        assert_eq!((code(&output), stdout(&output)), (1, String::new()));
        said.push_str(&stderr(&output));
    }
    assert_snapshot!(said);
    assert!(!scratch.0.join("out").exists());
}

/// A set of which nothing would be printed says how to name a template.
#[test]
fn a_set_of_parts_only_is_refused() {
    let scratch = Scratch::new("parts-only");
    scratch.file("lamp.od.yaml", LAMP);
    fs::create_dir(scratch.0.join("own")).unwrap();
    scratch.file("own/_part.txt", "part");
    let output = odgen(&scratch.0, &["--format", "short", "docs", "lamp.od.yaml", "--templates", "own"]);
    assert_eq!((code(&output), stdout(&output)), (1, String::new()));
    assert_snapshot!(stderr(&output));
}

/// File systems take names of 255 bytes.
#[test]
fn long_titles_of_chapters_are_names_of_files() {
    let scratch = Scratch::new("long-titles");
    let (words, word) = ("very long title ".repeat(30), "ö".repeat(400));
    let chapters = [&words[..], &format!("{words}other"), &word, &word]
        .map(|title| format!("  - {{title: {title}, content: [{{text: Here it is.}}]}}\n"));
    scratch.file("lamp.od.yaml", format!("{LAMP}document:\n{}", chapters.concat()));
    let output = odgen(&scratch.0, &["docs", "lamp.od.yaml", "--format", "md", "--out", "out"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let names = files(&scratch.0.join("out"));
    let cut = "very-long-title-very-long-title-very-long-title-very-long-title-very-long-title";
    for name in [cut, "chapter-2", &"oe".repeat(40), "chapter-4"] {
        assert!(names.contains(&format!("lamp/{name}.md")), "{name}: {names:?}");
    }
}

#[test]
fn templates_are_exported_joined_and_replaced() {
    let scratch = Scratch::new("export");
    scratch.file("lamp.od.yaml", LAMP);
    let output = odgen(&scratch.0, &["docs", "--export-templates", "own", "--format", "md"]);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    assert_eq!(
        files(&scratch.0.join("own")),
        ["README.md", "_macros.md", "appendix.md", "chapter.md", "device.md"]
    );
    // What was exported prints the same as what is built in.
    assert_eq!(code(&odgen(&scratch.0, &["docs", "lamp.od.yaml", "--templates", "own", "--out", "one"])), 0);
    assert_eq!(code(&odgen(&scratch.0, &["docs", "lamp.od.yaml", "--out", "two"])), 0);
    for name in files(&scratch.0.join("two")) {
        let text = |out: &str| fs::read_to_string(scratch.0.join(out).join(&name)).unwrap();
        assert_eq!(text("one"), text("two"), "{name}");
    }
    let output = odgen(&scratch.0, &["docs", "lamp.od.yaml", "--templates", "nowhere"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("cannot read nowhere"), "{}", stderr(&output));
    let output = odgen(&scratch.0, &["docs", "lamp.od.yaml", "--device", "lmap"]);
    assert_eq!(code(&output), 2);
    let output = odgen(&scratch.0, &["docs", "lamp.od.yaml", "--dump-context"]);
    assert!(
        stdout(&output).starts_with("{\n  \"format\": 3,\n  \"language\": \"en\""),
        "{}",
        stdout(&output)
    );
}

/// A device may not be named like another page of the documents.
#[test]
fn two_pages_of_one_name_are_refused() {
    let scratch = Scratch::new("page-clash");
    scratch.file("lamp.od.yaml", LAMP.replace("  lamp: {", "  units: {").replace("  lamp:\n", "  units:\n"));
    let output = odgen(&scratch.0, &["--format", "short", "docs", "lamp.od.yaml", "--out", "out"]);
    assert_eq!(code(&output), 1);
    assert_snapshot!(stderr(&output));
    assert!(!scratch.0.join("out").exists());
}
