//! Who stumbles over a file: what the readers of other people make of an EDS or DCF.
//!
//! For each reader that is run by the tests of this repository there is a model of what it refuses, made from its source. A
//! finding names the readers that refuse the file at its place, as far as [`stumbling`] knows that its code is about what they
//! refuse; where nothing else is to be said, a note of its own says so. So a file is refused by a reader just if a finding
//! names it, and the tests compare that with what the readers do.

mod canopen_host;
mod dcfchk;
mod eds_utils;
mod javascript;
mod lines;
mod mark;
mod node_canopen;
mod python;
mod python_canopen;
mod refusal;
mod reported;
mod table;

pub use mark::mark;
pub use table::{Stumbling, stumbling};

use lines::lines;
use od_spec::diag::Diagnostic;
use od_spec::diag::readers::Reader;
use od_spec::eds::is_eds;
use od_spec::encoding::Encoding;
use od_spec::source::{FileId, SourceFile, SourceMap};
use od_spec::{Compiled, departures};
use python::{Capitals, Ini, Remarks};
use refusal::{Cause, Place, Refusal, Refusals};
use reported::both_ways;

/// Adds to what the compiler says what matters only when a file is checked: which programs refuse an EDS for what is
/// found, and where devices depart from their libraries.
pub fn remark(sources: &SourceMap, root: FileId, compiled: &mut Compiled) {
    let file = sources.file(root);
    if is_eds(file.name(), file.text()) {
        mark(sources, root, &mut compiled.diagnostics);
    }
    if let Some(system) = &compiled.system {
        compiled.diagnostics.append(departures(system));
        compiled.diagnostics.sort();
    }
}

/// What is known of a file by the models of readers.
struct Predicted {
    /// What the readers that were run refuse.
    refusals: Vec<Refusal>,
    /// What others are reported to stumble over, and no rule says.
    reported: Option<Diagnostic>,
}

/// What readers refuse in a file.
fn predicted(file: FileId, source: &SourceFile) -> Predicted {
    let text = source.text();
    let lines = lines(text);
    // Case matters for one of the readers that are written in Python, and `#` begins a remark for another.
    let ini = Ini::read(&lines, Remarks::Semicolon, Capitals::AreAlike);
    let reported = both_ways(&ini, file);
    let mut all = Vec::new();
    if let Some(place) = not_in_utf8(source) {
        for reader in [Reader::PythonCanopen, Reader::Dcfchk, Reader::EdsUtils, Reader::CanopenHost] {
            let mut refusals = Refusals::new(reader, file);
            refusals.add(place, Cause::Text, "a text that is not in UTF-8");
            all.extend(refusals.list);
        }
        // They see no more of it.
        all.extend(node_canopen::refusals(&lines, file).list);
        return Predicted { refusals: all, reported };
    }
    if source.encoding() == Encoding::Utf8WithMark {
        let mark = Place { start: 0, end: text.lines().next().unwrap_or_default().len() };
        let wants_name_first = text.starts_with('[');
        for reader in [Reader::PythonCanopen, Reader::Dcfchk, Reader::EdsUtils] {
            let mut refusals = Refusals::new(reader, file);
            if reader != Reader::EdsUtils || wants_name_first {
                refusals.add(mark, Cause::Text, "a byte order mark");
            }
            all.extend(refusals.list);
        }
    }
    all.extend(if ini.has_hashes() {
        dcfchk::refusals(&Ini::read(&lines, Remarks::Both, Capitals::AreAlike), file).list
    } else {
        dcfchk::refusals(&ini, file).list
    });
    let with_capitals = if ini.has_variants() {
        Ini::read(&lines, Remarks::Semicolon, Capitals::Matter)
    } else {
        ini.with_capitals()
    };
    all.extend(python_canopen::refusals(&with_capitals, file).list);
    all.extend(eds_utils::refusals(text, &lines, file).list);
    all.extend(node_canopen::refusals(&lines, file).list);
    all.extend(canopen_host::refusals(text, file).list);
    Predicted { refusals: all, reported }
}

/// The first character of a text that is stored in neither ASCII nor UTF-8.
fn not_in_utf8(source: &SourceFile) -> Option<Place> {
    match source.encoding() {
        Encoding::Ascii | Encoding::Utf8 | Encoding::Utf8WithMark => None,
        Encoding::Utf16Le
        | Encoding::Utf16Be
        | Encoding::Utf16LeUnmarked
        | Encoding::Utf16BeUnmarked
        | Encoding::Windows1252
        | Encoding::Windows1251
        | Encoding::Cp850
        | Encoding::Cp437 => {
            let start = source.text().find(|c: char| !c.is_ascii()).unwrap_or(0);
            let length = source.text()[start..].chars().next().map_or(0, char::len_utf8);
            Some(Place { start, end: start + length })
        }
    }
}
