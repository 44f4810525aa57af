//! Reference documentation as files, with what generated code calls entries, and the index of tables for programs.
//!
//! `docs-gen` prints pages and knows no generator; here they meet the names in generated Rust, C and Structured Text.

use std::collections::BTreeMap;

pub use docs_gen::portal::language_name;
pub use docs_gen::{
    Changed, CodeNames, Format, Gaps, InLanguage, Options, Origin, Siblings, Since, TemplateError, Templates,
};

use docs_gen::portal::{self, Document, Portal};
use docs_gen::{Context, Documentation};
use od_gen::{Artifact, Provenance, rust};
use od_spec::model::{Devices, Dictionary, EntryId, System};
use od_spec::source::SourceMap;
use serde::Serialize;

/// What documents of these devices show; no key means all devices.
pub fn options(system: &System, devices: &[String], language: Option<&str>) -> Options {
    let devices = Devices::listed(devices);
    let chosen = system.devices.iter().filter(|device| devices.includes(&device.key));
    let language = language.map(str::to_owned);
    let mut options =
        Options { devices: devices.clone(), language, gaps: Gaps::LeftOut, ..Options::default() };
    for device in chosen {
        options.code_names.insert(device.key.clone(), code_names(system, device));
    }
    options
}

/// A specification to be printed.
#[derive(Debug, Clone)]
pub struct Edition<'a> {
    /// The specification.
    pub system: &'a System,
    /// The folder of its pages.
    pub folder: String,
    /// What they show.
    pub options: Options,
}

impl Edition<'_> {
    /// The folder of the document: that of all its languages, if it has others.
    fn document(&self) -> &str {
        match self.folder.rsplit_once('/') {
            Some((document, _)) if !self.options.siblings.languages.is_empty() => document,
            _ => &self.folder,
        }
    }
}

/// What was read for a specification; its own file is the first.
pub fn origin(sources: &SourceMap) -> Origin {
    let texts = sources.files().flat_map(|(_, file)| file.text().bytes());
    Origin { file: Provenance::of(sources).name().to_owned(), checksum: format!("{:08X}", crc32(texts)) }
}

/// The CRC-32 of ZIP and PNG.
fn crc32(bytes: impl Iterator<Item = u8>) -> u32 {
    let crc = bytes.fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| crc >> 1 ^ if crc & 1 == 0 { 0 } else { 0xEDB8_8320 })
    });
    !crc
}

/// What generated code calls the entries of a device.
fn code_names(system: &System, device: &Dictionary) -> BTreeMap<EntryId, CodeNames> {
    let mut names: BTreeMap<EntryId, CodeNames> = BTreeMap::new();
    for (id, rust) in rust::accessors(system, device) {
        names.entry(id).or_default().rust = rust;
    }
    for (id, c) in od_c::index_names(system, device) {
        names.entry(id).or_default().c = c;
    }
    for (id, structured_text) in od_st::index_names(system, device) {
        names.entry(id).or_default().structured_text = structured_text;
    }
    names
}

/// The documents of a specification by the name of `stem`, below `root`, and `tables.json` where it describes a manual. Only the
/// printed manual, and a user's own templates, leave out or gather what is open: pages for the screen say it in its place.
///
/// # Errors
/// A template has a mistake, or asks for something that the context does not have.
pub fn artifacts(
    system: &System,
    root: &str,
    stem: &str,
    options: &Options,
    templates: &[Templates],
) -> Result<Vec<Artifact>, TemplateError> {
    let (artifacts, _) = print(system, &format!("{root}{stem}"), options, templates)?;
    Ok(artifacts)
}

/// The documents of several specifications, or of one in several languages, with a start page for all of them where the
/// templates have one.
///
/// # Errors
/// As [`artifacts`].
pub fn with_start_page(
    editions: &[Edition<'_>],
    templates: &[Templates],
) -> Result<Vec<Artifact>, TemplateError> {
    let (mut list, mut documents, mut first) = (Vec::new(), Vec::new(), None);
    for of_document in editions.chunk_by(|one, next| one.document() == next.document()) {
        let mut document = Document { editions: Vec::new() };
        for Edition { system, folder, options } in of_document {
            let (artifacts, context) = print(system, folder, options, templates)?;
            list.extend(artifacts);
            document.editions.extend(context.as_ref().map(|context| portal::Edition::of(folder, context)));
            first = first.or(context);
        }
        documents.push(document);
    }
    let Some(first) = first else { return Ok(list) };
    let portal = Portal::new(&first, documents);
    for templates in templates {
        list.extend(templates.print_portal(&portal)?.map(|page| Artifact {
            path: page.path,
            bytes: page.text.into_bytes(),
            purpose: "start page of all documents".to_owned(),
        }));
    }
    Ok(list)
}

/// The documents of a specification, and what its last templates see.
fn print(
    system: &System,
    folder: &str,
    options: &Options,
    templates: &[Templates],
) -> Result<(Vec<Artifact>, Option<Context>), TemplateError> {
    let documentation = Documentation::new(system, options);
    let (mut list, mut last) = (Vec::new(), None);
    for templates in templates {
        let gaps = match (templates.format, options.gaps) {
            (Some(Format::Print), gaps) | (None, gaps @ Gaps::Gathered) => gaps,
            (Some(Format::Markdown | Format::Html) | None, _) => Gaps::InPlace,
        };
        let context = documentation.context(gaps);
        for page in templates.print(&context)? {
            let path = format!("{folder}/{}", page.path);
            list.push(Artifact { path, bytes: page.text.into_bytes(), purpose: String::new() });
        }
        last = Some(context);
    }
    let index = documentation.table_index();
    if !index.tables.is_empty() {
        let path = format!("{folder}/tables.json");
        let purpose = "what takes the place of each printed table".to_owned();
        list.push(Artifact { path, bytes: json(&index), purpose });
    }
    Ok((list, last))
}

/// What templates see, as JSON.
pub fn dump_context(system: &System, options: &Options) -> Vec<u8> {
    json(&docs_gen::context(system, options))
}

fn json(value: &impl Serialize) -> Vec<u8> {
    // Maps with text keys and plain values only, into memory: this cannot fail.
    let mut text = serde_json::to_vec_pretty(value).unwrap_or_default();
    text.push(b'\n');
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_is_that_of_other_programs() {
        assert_eq!((crc32("123456789".bytes()), crc32("".bytes())), (0xCBF4_3926, 0));
    }

    #[test]
    fn the_origin_is_the_specification_with_its_parts() {
        let mut sources = SourceMap::new();
        sources.add("folder/lamp.od.yaml", "1234");
        sources.add("folder/part.yaml", "56789");
        assert_eq!(
            origin(&sources),
            Origin { file: "lamp.od.yaml".to_owned(), checksum: "CBF43926".to_owned() }
        );
    }
}
