//! Indices in the texts of a specification are links to what they name.

use od_documents::Format;
use od_tests::documents;

/// A page in a language.
pub(super) fn page(spec: &str, format: Format, language: &str, path: &str) -> &'static str {
    &documents::pages(spec, format, language).unwrap()[path]
}

/// The chapters in German: one page of HTML, or the chapter's of Markdown.
fn chapter(format: Format, path: &str) -> &'static str {
    page("tests/docs/links.od.yaml", format, "de", path)
}

/// Whether a part is in a text, which is shown where it is not.
pub(super) fn assert_has(text: &str, part: &str) {
    assert!(text.contains(part), "`{part}` is not in\n{text}");
}

#[test]
fn an_index_in_a_text_is_a_link() {
    let text = chapter(Format::Html, "index.html");
    assert_has(
        text,
        "Schreiben Sie <a href=\"#2000\">2000h</a>, dann <a href=\"#2001.1\">2001h.1</a>; nicht <a href=\"#2001\">2001h</a>.7 und \
         <a href=\"#2000\">2000h</a>.0.",
    );
    assert_has(text, "Helligkeit, siehe <a href=\"#2001.1\">2001h.1</a>.");
    let text = chapter(Format::Markdown, "1-wozu-2000h-dient.md");
    assert_has(text, "Schreiben Sie [2000h](#2000), dann [2001h.1](#2001); nicht [2001h](#2001).7");
    assert_has(text, "Helligkeit, siehe [2001h.1](#2001).");
}

#[test]
fn what_names_no_object_is_no_link() {
    // No object, longer than an index, an error code as well as an object, a number.
    for (format, path) in [(Format::Html, "index.html"), (Format::Markdown, "1-wozu-2000h-dient.md")] {
        assert_has(chapter(format, path), "Ohne Link: 2002h, 12000h, 2003h und 000Fh.");
    }
}

#[test]
fn a_number_with_a_sub_index_is_no_error_code() {
    let text = chapter(Format::Html, "index.html");
    assert_has(text, "Subindex: <a href=\"lamp.html#2004.1\">2004h.1</a>, aber 2004h und 2004h.9.");
}

#[test]
fn a_text_leads_to_the_device_that_it_is_about() {
    // Both devices of the system have 1010h.
    let path = "od-spec/devices/pitch-control-system.od.yaml";
    let text = page(path, Format::Markdown, "en", "5-the-pitch-motion-controller-pmc.md");
    assert_has(text, "It outlives a power-off only if saved with [1010h.3](pmc.md#1010).");
    assert_has(text, "Save the parameters: write 65766173h to [1010h.3](pmc.md#1010).");
    assert!(!text.contains("](pmm.md#1010)"));
}

#[test]
fn a_heading_is_no_link() {
    assert_has(chapter(Format::Html, "index.html"), "1 Wozu 2000h dient</h2>");
}

#[test]
fn a_chapter_reports_once_that_it_is_not_translated() {
    assert_has(
        chapter(Format::Html, "index.html"),
        "<p><span lang=\"en\">Write </span><a href=\"#2000\" lang=\"en\">2000h</a><span lang=\"en\"> after </span>\
         <a href=\"#2001.0\" lang=\"en\">2001h.0</a><span lang=\"en\"> only.</span></p>",
    );
    assert_has(
        chapter(Format::Markdown, "1-wozu-2000h-dient.md"),
        "> Write [2000h](#2000) after [2001h.0](#2001) only.",
    );
    for (format, name) in [(Format::Html, "index.html"), (Format::Markdown, "1-wozu-2000h-dient.md")] {
        let text = chapter(format, name);
        let reports = text.matches("Was in diesem Teil nicht übersetzt ist, gibt es nur auf Englisch.");
        assert_eq!(reports.count(), 1, "{name}");
    }
}

#[test]
fn an_object_of_another_device_is_a_link_to_its_page() {
    let text = page("tests/docs/two.od.yaml", Format::Html, "de", "two.html");
    assert_has(
        text,
        "(<a href=\"one.html#1017\">ONE 1017h</a>) ≤ Producer heartbeat time (<a href=\"#1017\">TWO 1017h</a>)",
    );
}

#[test]
fn an_error_leads_to_the_bit_that_shows_it_and_back() {
    let text = page("od-spec/devices/pitch-control-system.od.yaml", Format::Html, "de", "pmc.html");
    let row = |id: &str| {
        let start = text.find(&format!(" id=\"{id}\"")).unwrap();
        &text[start..start + text[start..].find("</tr>").unwrap()]
    };
    let error = row("error-3210");
    assert_has(error, "<a href=\"#6510.8.b2\">6510h.8 Bit 2</a>");
    // The mask 6510h.7 has the same layout and shows nothing.
    assert!(!error.contains("6510h.7"), "{error}");
    let bit = row("6510.7.b2");
    // Both have their own address at the one row.
    assert_has(bit, "<i id=\"6510.8.b2\"></i>2</td>");
    assert_has(bit, "<a href=\"#error-3210\">3210h</a>");
}
