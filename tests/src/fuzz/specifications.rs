//! What is demanded of every specification and library, however broken.

use std::io::{Error, ErrorKind};

use od_documents::{self as docs, Format, Templates};
use od_formats::{eds, json};
use od_gen::rust;
use od_spec::diag::{Diagnostics, Severity};
use od_spec::model::{Dictionary, System};
use od_spec::source::{FileId, SourceMap};
use od_spec::{Commissioning, Compiled, Loader, NoFiles, Strictness, compile, compile_as, read_text};

use super::bounds::{Bound, Bounds, Meter, Size, caught};
use super::findings;
use super::notation::{Notation, YAML};
use super::{Complaint, Subject};
use crate::foreign::{Stated, differences};

/// Specifications, and libraries, which are compiled by themselves and used by a device.
#[derive(Debug)]
pub struct Specifications {
    meter: Meter,
    templates: Vec<Templates>,
}

/// Uses a library, with everything that it has.
const USER: &str = "od-spec: 1\ntitle: User\nuses: [cia301, library.od.yaml]\ndevices:\n  user: {name: User, bit-rates: [125]}\n\
    objects:\n  0x2000: {name: level, type: unsigned8, access: rw, pdo: both}\n  0x6040: {from: library}\n";

/// A model that is larger is not printed: all outputs of one together would take seconds.
const MOST_ENTRIES: usize = 4000;
/// The node of the DCF.
const NODE: u8 = 5;

/// Reading a text and judging it. Most of what one needs is for its libraries; the standard ones are read for each.
const COMPILE: Bounds = Bounds {
    step: "compile",
    peak: Bound::new(4_000_000, 400).and_for_each_described(2400),
    total: Bound::new(120_000_000, 4000).and_for_each_described(10_000),
};

/// The library of the device that uses one.
struct Library<'b>(&'b [u8]);

impl Loader for Library<'_> {
    fn load(&mut self, path: &str, _: &str) -> Result<Vec<u8>, String> {
        let missing = || Error::from(ErrorKind::NotFound).to_string();
        if path == "library.od.yaml" { Ok(self.0.to_vec()) } else { Err(missing()) }
    }
}

impl Specifications {
    /// With what says how much a step used.
    ///
    /// # Errors
    /// The shipped templates cannot be used.
    pub fn new(meter: Meter) -> Result<Self, docs::TemplateError> {
        let templates =
            [Format::Markdown, Format::Html, Format::Print].map(|format| Templates::new(Some(format), &[]));
        Ok(Self { meter, templates: templates.into_iter().collect::<Result<_, _>>()? })
    }
}

impl Subject for Specifications {
    fn notation(&self) -> &Notation {
        &YAML
    }

    fn complaints(&self, name: &str, bytes: &[u8]) -> Vec<Complaint> {
        let read = || Size {
            bytes: bytes.len(),
            described: compiled(name, bytes).map_or(0, |(.., compiled)| compiled.described),
        };
        let mut complaints: Vec<Complaint> = COMPILE.of_step(self.meter, read).into_iter().collect();
        if complaints.is_empty() {
            let steps: [(&str, &dyn Fn() -> Vec<String>); 2] =
                [("specification", &|| self.specification(name, bytes)), ("library", &|| library(bytes))];
            for (step, run) in steps {
                let wrong = caught(run).unwrap_or_else(|what| vec![what]);
                complaints.extend(wrong.into_iter().map(|what| Complaint { step: step.to_owned(), what }));
            }
        }
        complaints
    }
}

fn compiled(name: &str, bytes: &[u8]) -> Option<(SourceMap, FileId, Compiled)> {
    let mut sources = SourceMap::new();
    let text = read_text(name, bytes.to_vec()).ok()?;
    let root = sources.add(name, text);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    Some((sources, root, compiled))
}

/// A device with a mutant as its library.
fn library(bytes: &[u8]) -> Vec<String> {
    let mut sources = SourceMap::new();
    let root = sources.add("user.od.yaml", USER);
    let compiled = compile(&mut sources, root, &mut Library(bytes));
    refusal(&sources, root, &compiled)
}

/// What is wrong with the findings about a text; a model is there exactly if no error is.
fn refusal(sources: &SourceMap, root: FileId, compiled: &Compiled) -> Vec<String> {
    let name = sources.file(root).name();
    let mut wrong = said_wrongly(name, &compiled.diagnostics, sources);
    let errors = compiled.diagnostics.iter().filter(|one| one.severity() == Severity::Error);
    let (count, placed) =
        errors.fold((0, 0), |(count, placed), one| (count + 1, placed + usize::from(!one.labels.is_empty())));
    match &compiled.system {
        Some(_) if count > 0 => wrong.push("a model in spite of an error".to_owned()),
        None if placed == 0 => wrong.push("refused without a place".to_owned()),
        Some(_) | None => (),
    }
    wrong
}

fn said_wrongly(name: &str, diagnostics: &Diagnostics, sources: &SourceMap) -> Vec<String> {
    let wrong = findings::wrong(name, diagnostics, sources).into_iter();
    wrong.map(|(format, what)| format!("{format}: {what}")).collect()
}

impl Specifications {
    fn specification(&self, name: &str, bytes: &[u8]) -> Vec<String> {
        let Some((sources, root, compiled)) = compiled(name, bytes) else { return Vec::new() };
        let mut wrong = refusal(&sources, root, &compiled);
        let Some(system) = &compiled.system else { return wrong };
        let entries: usize = system.devices.iter().map(|device| device.entries().count()).sum();
        if entries > MOST_ENTRIES {
            return wrong;
        }
        // What a device is allowed to break, its EDS breaks as well.
        let is_lenient = sources.file(root).text().contains("allow:");
        for device in &system.devices {
            wrong.extend(rust(name, &sources, system, device));
            let written = [
                ("an.eds", eds::write_eds(system, device)),
                ("a.dcf", eds::write_dcf(system, device, &Commissioning::of_node(device, NODE), "a.dcf")),
            ];
            for (file, bytes) in written {
                wrong.extend(read_back(file, bytes, device, is_lenient));
            }
        }
        let dump = serde_json::from_slice::<serde_json::Value>(&json::dump(system, &[]));
        wrong.extend(dump.err().map(|error| format!("not JSON: {error}")));
        wrong.extend(self.documents(system));
        wrong
    }

    fn documents(&self, system: &System) -> Vec<String> {
        let mut wrong = Vec::new();
        for language in ["en", "de"] {
            let options = docs::options(system, &[], Some(language));
            match docs::artifacts(system, "", "mutant", &options, &self.templates) {
                Ok(pages) => {
                    for page in pages {
                        let text = String::from_utf8_lossy(&page.bytes);
                        let raw = text.chars().find(|c| c.is_control() && !matches!(c, '\n' | '\t'));
                        wrong.extend(raw.map(|raw| format!("a document has the character {raw:?} as it is")));
                    }
                }
                Err(error) => wrong.push(format!("documents: {error}")),
            }
        }
        wrong
    }
}

/// The Rust of a device is Rust, or there is a reason.
fn rust(name: &str, sources: &SourceMap, system: &System, device: &Dictionary) -> Vec<String> {
    let mut diagnostics = Diagnostics::new();
    let file = rust::plain_file(system, device, &rust::Provenance::of(sources), &mut diagnostics);
    let mut wrong = said_wrongly(name, &diagnostics, sources);
    match file {
        Some(file) => wrong.extend(syn::parse_file(&file).err().map(|error| format!("not Rust: {error}"))),
        None if !diagnostics.has_errors() => wrong.push("no Rust, and no reason".to_owned()),
        None => (),
    }
    wrong
}

/// An EDS of ours keeps the standard, and has the objects of the device.
fn read_back(file: &str, bytes: Vec<u8>, device: &Dictionary, is_lenient: bool) -> Vec<String> {
    let mut sources = SourceMap::new();
    let text = match read_text(file, bytes) {
        Ok(text) if text.is_ascii() => text,
        Ok(_) | Err(_) => return vec![format!("{file}: not ASCII")],
    };
    let root = sources.add(file, text);
    let Compiled { system, diagnostics, .. } =
        compile_as(Strictness::Standard, &mut sources, root, &mut NoFiles);
    let errors = diagnostics.iter().filter(|one| one.severity() == Severity::Error);
    let errors = errors.filter(|one| !is_lenient || one.code.id.starts_with("EDS"));
    let mut wrong: Vec<String> = errors
        .take(1)
        .map(|one| {
            let place = one.labels.first().map(|label| sources.place(label.span)).unwrap_or_default();
            format!("{file}: {} `{place}`: {}", one.code.id, one.message)
        })
        .collect();
    let Some(read) = system.as_ref().and_then(|system| system.devices.first()) else { return wrong };
    let differs = differences(device, read)
        .into_iter()
        .find(|one| matches!(one.fact, Stated::Existence | Stated::Kind | Stated::Type));
    wrong.extend(differs.map(|one| format!("{file}: {one}")));
    wrong
}

#[cfg(test)]
mod tests {
    use super::super::Used;
    use super::*;

    fn device(text: &str) -> (System, Vec<u8>) {
        let text = format!(
            "od-spec: 1\ntitle: Lamp\nuses: [cia301]\ndevices:\n  lamp: {{name: Lamp, bit-rates: [125]}}\n{text}"
        );
        let (.., compiled) = compiled("lamp.od.yaml", text.as_bytes()).unwrap();
        (compiled.system.unwrap(), text.into_bytes())
    }

    fn subject(peak: fn(&mut dyn FnMut()) -> Used) -> Specifications {
        Specifications::new(peak).unwrap()
    }

    #[test]
    fn what_is_right_is_no_complaint() {
        let (_, text) = device("objects:\n  0x2000: {name: level, type: unsigned8, access: rw}\n");
        let subject = subject(|step| {
            step();
            Used::default()
        });
        assert_eq!(subject.complaints("lamp.od.yaml", &text), []);
        // Also where nothing can be read.
        assert_eq!(subject.complaints("lamp.od.yaml", b"\xFF"), []);
        assert_eq!(subject.complaints("lamp.od.yaml", b"od-spec: 1\n"), []);
    }

    #[test]
    fn too_much_memory_is_a_complaint() {
        let (_, text) = device("objects: {}\n");
        let subject = subject(|_| Used { peak: 1 << 40, total: 0 });
        assert_eq!(subject.complaints("lamp.od.yaml", &text)[0].step, "compile memory");
    }

    #[test]
    fn a_refusal_without_a_place_is_a_complaint() {
        let mut sources = SourceMap::new();
        let root = sources.add("a.od.yaml", "");
        let refused = Compiled::refused(Diagnostics::new());
        assert_eq!(refusal(&sources, root, &refused), ["refused without a place"]);
    }

    #[test]
    fn the_eds_of_another_device_is_a_complaint() {
        let (one, _) = device("objects:\n  0x2000: {name: level, type: unsigned8, access: rw}\n");
        let (other, _) = device("objects:\n  0x2000: {name: level, type: unsigned16, access: rw}\n");
        let read = |system: &System| {
            let bytes = eds::write_eds(system, &system.devices[0]);
            read_back("lamp.eds", bytes, &one.devices[0], false)
        };
        assert_eq!(read(&one), [""; 0]);
        assert_eq!(read(&other).len(), 1);
        let broken = read_back("lamp.eds", b"[2000]\nDataType=99\n".to_vec(), &one.devices[0], false);
        assert!(broken[0].starts_with("lamp.eds: EDS"), "{broken:?}");
    }
}
