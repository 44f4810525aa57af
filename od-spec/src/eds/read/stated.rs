//! Sections that a specification adds to its EDS, read as those of an EDS file are.

use std::collections::BTreeMap;

use super::further::{self, KeysBySection};
use crate::ascii::{has_lost, in_ascii, transliterate};
use crate::ast::{FileDecl, FileSectionDecl, Name};
use crate::check::codes::{NAME_NOT_FOR_EDS, NAME_WITHOUT_FORM};
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::eds::Document;
use crate::eds::names::{Topic, canonical, topic};
use crate::eds::view::{FileFacts, ObjectPart, Part, View};
use crate::encoding::Encoding;
use crate::model::{Dictionary, EntryId, Further, Index, Object, SubIndex};
use crate::source::{FileId, Span};
use crate::wording::FileFormat;

/// Longest line of an EDS (CiA 306 4.2).
const LONGEST_LINE: usize = 255;
/// The longest key or name of a section, so that there is room for a value.
const LONGEST_KEY: usize = LONGEST_LINE / 2;

/// Reads it, for a device whose objects are resolved.
pub(crate) fn stated(decl: Option<&FileDecl>, device: &Dictionary, diagnostics: &mut Diagnostics) -> Further {
    let Some(decl) = decl else { return Further::default() };
    // An object that was refused is not missing.
    let is_complete = !diagnostics.has_errors();
    let comments = decl.comments.as_ref().map(|lines| comments(lines, diagnostics));
    let file = device.span.file;
    let document = document(file, &decl.sections, diagnostics);
    let facts = FileFacts { name: "", encoding: Encoding::Utf8, format: FileFormat::Eds };
    let view = View::new(&document, file, false, facts);
    for (topic, part) in view.topics() {
        refuse_what_follows(topic, part, device, diagnostics);
        if is_complete && !is_there(topic, device) {
            let message = format!("there is nothing that `[{}]` is about", shorten(part.name().value));
            diagnostics.push(
                Diagnostic::new(codes::UNKNOWN_ENTRY, part.place(), message)
                    .help("correct the name of the section, or describe the object on this device"),
            );
        }
    }
    let objects: Vec<Index> = device.objects.keys().copied().collect();
    let has_subs = |index: Index, _: &ObjectPart<'_>, _: &Part<'_>| is_structured(device, index);
    Further { comments, ..further::without_comments(&view, &objects, has_subs, KeysBySection::new()) }
}

/// Why an EDS cannot hold a key with a value, so that it would be read otherwise; `None` where it can.
pub fn cannot_hold(key: &str, value: &str) -> Option<String> {
    let of_key = || name_problem(key, |c| c == '=').or_else(|| begins_otherwise(key));
    of_key().map(|problem| format!("the key {problem}")).or_else(|| {
        let length = transliterate(value).len();
        let longest = LONGEST_LINE - 1 - in_ascii(key).len();
        if value.chars().any(char::is_control) {
            Some("the value holds a control character".to_owned())
        } else if value.trim() != value || value.is_empty() {
            Some("the value is empty, or has spaces at its ends".to_owned())
        } else if length > longest {
            Some(format!("the value has {length} characters, a line holds {longest}"))
        } else {
            None
        }
    })
}

/// Why an EDS cannot hold a section of a name; `None` where it can.
pub fn cannot_hold_section(name: &str) -> Option<String> {
    name_problem(name, |c| matches!(c, '[' | ']')).map(|problem| format!("the name {problem}"))
}

/// Why a text cannot be where a line has a name.
fn name_problem(name: &str, is_unfit: impl Fn(char) -> bool) -> Option<String> {
    let written = in_ascii(name);
    let unfit = |c: char| c.is_control() || is_unfit(c);
    if let Some(unfit) = name.chars().chain(written.chars()).find(|c| unfit(*c)) {
        let unfit = if unfit.is_control() { "a control character".to_owned() } else { format!("`{unfit}`") };
        Some(format!("holds {unfit}"))
    } else if name.is_empty() || name.trim() != name {
        Some("is empty, or has spaces at its ends".to_owned())
    } else if has_lost(name) {
        Some("has characters without a form in ASCII".to_owned())
    } else if written.len() >= LONGEST_KEY {
        Some(format!("has {} characters, at most {} fit", written.len(), LONGEST_KEY - 1))
    } else {
        None
    }
}

/// A line that begins so has no key.
fn begins_otherwise(key: &str) -> Option<String> {
    let first = key.chars().next().filter(|c| matches!(c, ';' | '#' | '['))?;
    Some(format!("begins with `{first}`"))
}

fn comments(lines: &[Name], diagnostics: &mut Diagnostics) -> Vec<String> {
    for (number, line) in (1..).zip(lines) {
        check(&format!("Line{number}"), line, line.span, diagnostics);
    }
    lines.iter().map(|line| line.value.clone()).collect()
}

/// Reports what an EDS cannot hold, and what it loses.
fn check(key: &str, value: &Name, place: Span, diagnostics: &mut Diagnostics) -> bool {
    // An empty text was refused where it was read.
    if key.is_empty() || value.value.trim().is_empty() {
        return false;
    }
    if let Some(problem) = cannot_hold(key, &value.value) {
        diagnostics.push(
            Diagnostic::new(NAME_NOT_FOR_EDS, place, format!("`{}`: {problem}", shorten(key)))
                .help("write what fits a line of an EDS"),
        );
        return false;
    }
    if has_lost(&value.value) {
        let written = transliterate(&value.value);
        let message = format!("an EDS writes `{}` as `{}`", shorten(&value.value), shorten(&written));
        diagnostics.push(
            Diagnostic::new(NAME_WITHOUT_FORM, value.span, message).help("write it with characters of ASCII"),
        );
    }
    true
}

/// The sections as those of an EDS, each key at its place.
fn document(file: FileId, sections: &[FileSectionDecl], diagnostics: &mut Diagnostics) -> Document<'static> {
    let mut document = Document::translated(file);
    let mut names = BTreeMap::new();
    for FileSectionDecl { name, keys } in sections {
        let standard = canonical(topic(&name.value)).unwrap_or_else(|| name.value.clone());
        if name.value.is_empty() || is_twice(&mut names, &standard, name.span, diagnostics) {
            continue;
        }
        if let Some(problem) = cannot_hold_section(&name.value) {
            let message = format!("`[{}]`: {problem}", shorten(&name.value));
            diagnostics.push(Diagnostic::new(NAME_NOT_FOR_EDS, name.span, message).help("name it otherwise"));
            continue;
        }
        document.push_header(&name.value, name.span, &[]);
        let mut known = BTreeMap::new();
        for (key, value) in keys {
            if !is_twice(&mut known, &key.value, key.span, diagnostics)
                && check(&key.value, value, key.span, diagnostics)
            {
                document.push_key(&key.value, &value.value, key.span);
            }
        }
    }
    document
}

/// Whether a name was there before, in whatever case, which is reported.
fn is_twice(
    names: &mut BTreeMap<String, Span>,
    name: &str,
    place: Span,
    diagnostics: &mut Diagnostics,
) -> bool {
    let Some(first) = names.insert(name.to_ascii_lowercase(), place) else { return false };
    let message = format!("`{}` is written twice; case makes no difference", shorten(name));
    diagnostics.push(
        Diagnostic::new(codes::DUPLICATE_KEY, place, message)
            .with(first, "first here")
            .help("remove one of the two, or join their values"),
    );
    true
}

fn is_structured(device: &Dictionary, index: Index) -> bool {
    device.objects.get(&index).is_some_and(Object::is_structured)
}

/// Whether the EDS of a device has what a section is about.
fn is_there(topic: Topic, device: &Dictionary) -> bool {
    match topic {
        Topic::Object(index) | Topic::Elements(index, _) => device.objects.contains_key(&index),
        Topic::ObjectLinks(index) => {
            device.objects.get(&index).is_some_and(|object| !object.links.is_empty())
        }
        Topic::Sub(index, sub) => u8::try_from(sub).is_ok_and(|sub| {
            is_structured(device, index) && device.entry(EntryId { index, sub: SubIndex(sub) }).is_some()
        }),
        Topic::FileInfo
        | Topic::DeviceInfo
        | Topic::DummyUsage
        | Topic::Comments
        | Topic::Objects(_)
        | Topic::Commissioning
        | Topic::DynamicChannels
        | Topic::Tools
        | Topic::Tool(_)
        | Topic::SupportedModules
        | Topic::ConnectedModules
        | Topic::Module(..)
        | Topic::Unknown => true,
    }
}

/// Reports the keys of a section that are made from the specification.
fn refuse_what_follows(topic: Topic, part: &Part<'_>, device: &Dictionary, diagnostics: &mut Diagnostics) {
    let (has_subs, help) = match topic {
        Topic::FileInfo => (false, "say it by the other keys of `eds:`"),
        Topic::DeviceInfo => (false, "say it by the keys of the device"),
        Topic::DummyUsage => (false, "say it by `dummies:` of the device"),
        Topic::Comments => (false, "say it by `comments:`"),
        Topic::Objects(_) => (false, "remove it: the lists are those of the objects"),
        Topic::Commissioning => (false, "say it to `odgen dcf`, which makes the DCF of a node"),
        Topic::Object(index) => (is_structured(device, index), "say it by the keys of the object"),
        Topic::Sub(..) | Topic::Elements(..) => (false, "say it by the keys of the entry"),
        Topic::ObjectLinks(_) => (false, "say it by `links:` of the object"),
        Topic::DynamicChannels => (false, "say it by `dynamic-channels:` of the device"),
        Topic::ConnectedModules => (false, "remove it: the modules are counted"),
        Topic::Tools | Topic::Tool(_) | Topic::SupportedModules | Topic::Module(..) | Topic::Unknown => {
            return;
        }
    };
    let is_made = matches!(topic, Topic::Elements(..) | Topic::DynamicChannels);
    let is_module =
        |key: &str| topic == Topic::ConnectedModules && key.bytes().all(|byte| byte.is_ascii_digit());
    for entry in part.entries() {
        let key = entry.key.value;
        if !is_module(key) && (is_made || further::kept(topic, key, has_subs).is_none()) {
            let message = format!(
                "`{}` of `[{}]` follows from the specification",
                shorten(key),
                shorten(part.name().value)
            );
            diagnostics.push(Diagnostic::new(codes::FOLLOWS, entry.key.span, message).help(help));
        }
    }
}
