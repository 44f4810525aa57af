//! What an output looks like apart from its texts: a text from outside must not change it.

use std::collections::BTreeMap;

use od_documents as docs;
use od_formats::{Selection, artifacts};
use od_gen::Artifact;
use od_gen::rust::{self, Provenance};
use od_spec::diag::Diagnostics;
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::visible::is_hidden;
use pulldown_cmark::{Event, Options, Parser, Tag};

/// How often each kind of part occurs in the files of a kind.
pub(crate) type Skeleton = BTreeMap<String, usize>;

/// The skeleton of every file, and what is wrong with their texts.
pub(crate) fn skeleton(system: &System, sources: &SourceMap, complaints: &mut Vec<String>) -> Skeleton {
    let mut parts = Skeleton::new();
    let mut count = |part: String| *parts.entry(part).or_default() += 1;
    let selection = Selection { node: Some(5), ..Selection::default() };
    for file in artifacts(system, "texts", &selection) {
        match file.path.rsplit('.').next() {
            Some("json") => drop(serde_json::from_slice::<serde_json::Value>(&file.bytes).unwrap()),
            _ => eds(&file, &mut count, complaints),
        }
    }
    let templates: Vec<_> = [docs::Format::Markdown, docs::Format::Html, docs::Format::Print]
        .map(|format| docs::Templates::new(Some(format), &[]).unwrap())
        .into_iter()
        .collect();
    let options = docs::options(system, &[], None);
    for file in docs::artifacts(system, "", "texts", &options, &templates).unwrap() {
        let text = String::from_utf8(file.bytes.clone()).unwrap();
        let kind = file.path.rsplit('.').next().unwrap_or_default();
        match kind {
            "md" => markdown(&text, &mut count, complaints),
            "html" => {
                html(&text, &mut count);
                // The tools of a device's page have every accessor to be copied.
                let device =
                    system.devices.iter().find(|one| file.path.ends_with(&format!("/{}.html", one.key)));
                for names in device.iter().flat_map(|device| options.code_names[&device.key].values()) {
                    if !text.contains(&names.rust) {
                        complaints.push(format!("{}: no accessor {}", file.path, names.rust));
                    }
                }
            }
            _ => (),
        }
        // JSON escapes what it has to; that file is not shown.
        let is_page = kind != "json";
        if is_page && text.contains(|c: char| is_hidden(c) && !matches!(c, '\n' | '\t' | '\r')) {
            complaints.push(format!("{} holds a hidden character", file.path));
        }
    }
    let mut diagnostics = Diagnostics::new();
    let modules = rust::modules(
        system,
        system.devices.iter(),
        &Provenance::of(sources),
        rust::plain_file,
        &mut diagnostics,
    );
    for file in modules {
        let text = String::from_utf8(file.bytes).unwrap();
        match syn::parse_file(&text) {
            Ok(parsed) => {
                for item in &parsed.items {
                    count(format!("rust {:?}", std::mem::discriminant(item)));
                }
            }
            Err(error) => complaints.push(format!("{} is no Rust: {error}", file.path)),
        }
        if text.lines().take(2).any(|line| !line.starts_with("// "))
            || text.contains(|c: char| is_hidden(c) && c != '\n')
        {
            complaints.push(format!("{} has a bad comment or a hidden character", file.path));
        }
    }
    if diagnostics.has_errors() {
        count("refused as Rust".to_owned());
    }
    parts
}

/// Sections and keys; what values of `[Comments]` may not hold.
fn eds(file: &Artifact, count: &mut impl FnMut(String), complaints: &mut Vec<String>) {
    let text = String::from_utf8(file.bytes.clone()).unwrap();
    let mut section = String::new();
    for line in text.split("\r\n") {
        if line.bytes().any(|byte| !matches!(byte, b' '..=b'~')) {
            complaints.push(format!("{}: {line:?}", file.path));
        }
        if line.starts_with('[') {
            // The name of a section of the maker is one of the texts, as its keys are; those of the standard have no
            // space.
            let name = if line.contains(' ') { "[of the maker]" } else { line };
            name.clone_into(&mut section);
            count(format!("eds {section}"));
        } else if let Some((key, value)) = line.split_once('=').filter(|_| !line.starts_with(';')) {
            let key = if section == "[of the maker]" { "key" } else { key };
            count(format!("eds {section} {key}"));
            if section == "[Comments]" && value.contains([';', '#', '=']) {
                complaints.push(format!("{}: {line}", file.path));
            }
        } else if !line.is_empty() && !line.starts_with(';') {
            complaints.push(format!("{}: {line}", file.path));
        }
    }
}

/// What a reader of Markdown finds: headings, tables, and no HTML but our own.
fn markdown(text: &str, count: &mut impl FnMut(String), complaints: &mut Vec<String>) {
    let events = Parser::new_ext(text, Options::ENABLE_TABLES | Options::ENABLE_STRIKETHROUGH);
    for event in events {
        match event {
            Event::Html(html) | Event::InlineHtml(html) => {
                let html = html.trim();
                let anchor = html.strip_prefix("<a id=\"").and_then(|rest| rest.strip_suffix("\">"));
                let is_anchor = anchor
                    .or_else(|| html.strip_prefix("<a id=\"").and_then(|rest| rest.strip_suffix("\"></a>")))
                    .is_some_and(|id| {
                        id.chars().all(|c| c.is_alphanumeric() || matches!(c, '-' | '.' | '_'))
                    });
                let ours = is_anchor
                    || matches!(html, "</a>" | "<br>")
                    || html.starts_with("<!-- @generated by odgen");
                if !ours {
                    complaints.push(format!("Markdown holds {html:?}"));
                }
            }
            Event::Start(Tag::Link { dest_url, .. }) if dest_url.contains(':') => {
                complaints.push(format!("Markdown links to {dest_url}"));
            }
            Event::Start(Tag::Heading { level, .. }) => count(format!("md {level:?}")),
            Event::Start(Tag::TableRow) => count("md row".to_owned()),
            Event::Start(Tag::TableCell) => count("md cell".to_owned()),
            Event::Start(
                one @ (Tag::Item
                | Tag::BlockQuote(_)
                | Tag::CodeBlock(_)
                | Tag::Image { .. }
                | Tag::Strikethrough),
            ) => count(format!("md {:?}", std::mem::discriminant(&one))),
            _ => {}
        }
    }
}

/// Tags, outside of style and script.
fn html(text: &str, count: &mut impl FnMut(String)) {
    let mut rest = text;
    while let Some(at) = rest.find('<') {
        rest = &rest[at + 1..];
        let name: String =
            rest.chars().take_while(|c| c.is_ascii_alphanumeric() || matches!(c, '/' | '!')).collect();
        if matches!(name.as_str(), "style" | "script") {
            // What looks like a tag in there is none.
            let end = rest.find(&format!("</{name}>")).unwrap();
            rest = &rest[end..];
        }
        // In how many lines a diagram shows a text depends on its words.
        if name == "svg"
            && ["flow", "axis"].iter().any(|kind| rest.starts_with(&format!("svg class=\"picture {kind}\"")))
        {
            let (picture, behind) = rest.split_once("</svg>").unwrap();
            let other: Vec<&str> = picture
                .split('<')
                .skip(1)
                .filter(|tag| !tag.trim_start_matches('/').starts_with("text"))
                .collect();
            count(format!("html {name} with {} elements", other.len()));
            rest = behind;
            continue;
        }
        // Breaks belong to the text. An accessor has a button of its own, where code can have the name at all.
        let is_accessor = name == "button" && rest.starts_with("button type=\"button\" data-copy=\".");
        if !matches!(name.as_str(), "" | "br" | "/button") && !is_accessor {
            count(format!("html {name}"));
        }
    }
}
