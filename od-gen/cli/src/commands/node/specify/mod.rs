//! `odgen node scan --write-spec`: a first specification of a device that no file describes.

mod args;
mod ask;
mod document;
mod known;

use std::ops::RangeInclusive;
use std::path::Path;

use od_bus::client::{AccessError, Bus, Client, Fact, Remark, recognize};
use od_gen::Artifact;
use od_gen::files::Existing;
use od_gen::source::compile_bytes;
use od_import::import;
use od_import::yaml::{Options, specification};
use od_spec::Compiled;
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::{DataType, EntryId, Index, SubIndex};
use od_spec::source::SourceMap;

use super::helped;
use crate::exit::ERRORS;
use crate::output::{file_name, forced, keep};
use crate::report::{Report, print, shown};
pub(crate) use args::SpecifyArgs;
use ask::{STANDARD, objects};
use document::{Described, Findings, hexadecimal};

/// What makers and device profiles have.
const OTHERS: RangeInclusive<u16> = 0x2000..=0x9FFF;

/// 1021h: the EDS of the device.
const STORED_EDS: EntryId = EntryId { index: Index(0x1021), sub: SubIndex(0) };
/// 1022h: the form that it is stored in.
const STORAGE_FORMAT: EntryId = EntryId { index: Index(0x1022), sub: SubIndex(0) };

/// A specification, and how many objects it has.
struct Specified {
    text: String,
    objects: usize,
    /// What it is made from.
    from: &'static str,
}

/// Whose specification is wanted.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    pub(super) node: u8,
    /// In kbit/s, where the command line says it.
    pub(super) bit_rate: Option<u16>,
    pub(super) file: &'a Path,
    pub(super) args: &'a SpecifyArgs,
}

/// Writes a specification of a node into a file.
pub(super) fn specify<B: Bus>(client: &mut Client<B>, wanted: Wanted<'_>, report: &Report) -> Result<u8, u8> {
    let Wanted { node, file, args, .. } = wanted;
    let name = file_name(file, "the specification", &[]).map_err(|diagnostic| report.refuse(diagnostic))?;
    if file.exists() && !args.force {
        // Before the minutes that asking can take.
        let message = format!("cannot write {}: it is there already", shown(file));
        return Err(report.refuse(
            Diagnostic::without_place(codes::WRITE_FAILED, message)
                .help("choose another name, or replace it with `--force`"),
        ));
    }
    let specified = match stored(client, node, args, report)? {
        Some(bytes) => of_eds(client, node, &name, bytes, report)?,
        None => of_objects(client, wanted, &name, report)?,
    };
    let Specified { text, objects, from } = specified;
    let artifact = Artifact { path: name, bytes: text.into_bytes(), purpose: String::new() };
    let directory = file.parent().unwrap_or(Path::new(""));
    keep(directory, std::slice::from_ref(&artifact), forced(args.force, Existing::None))
        .map_err(|diagnostic| report.refuse(diagnostic))?;
    let file = shown(file);
    Ok(print(&format!("{file}: {objects} objects of node {node}, from {from}\nnext: odgen check {file}\n")))
}

fn failed(node: u8, what: &str, error: &AccessError, report: &Report) -> u8 {
    let message = format!("node {node}: cannot read {what}: {error}");
    report.refuse(helped(Diagnostic::without_place(codes::ACCESS_FAILED, message), error))
}

/// The EDS that a node has stored, where it has one that can be read.
fn stored<B: Bus>(
    client: &mut Client<B>,
    node: u8,
    args: &SpecifyArgs,
    report: &Report,
) -> Result<Option<Vec<u8>>, u8> {
    if !args.range.is_empty() {
        return Ok(None);
    }
    let mut read = |id, data_type| match client.read_as(node, id, data_type) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(error) if error.is_of_entry() => Ok(None),
        Err(error) => Err(failed(node, &format!("the stored EDS ({id})"), &error, report)),
    };
    // In a device of CiA 301 v4.02 it has one byte, in later ones two.
    let format =
        read(STORAGE_FORMAT, DataType::Unsigned8)?.filter(|format| format.iter().any(|byte| *byte != 0));
    if let Some(format) = format {
        let digits = hexadecimal(format.iter().rev());
        report.note(&format!(
            "node {node} stores its EDS in a form of its own ({STORAGE_FORMAT} = 0x{digits}): its objects are asked for instead"
        ));
        return Ok(None);
    }
    Ok(read(STORED_EDS, DataType::Domain)?.filter(|bytes| !bytes.is_empty()))
}

/// The name of a specification's file without its endings.
fn eds_name(name: &str) -> String {
    format!("{}.eds", name.split('.').next().unwrap_or(name))
}

fn compiled(name: &str, bytes: Vec<u8>, sources: &mut SourceMap, report: &Report) -> Compiled {
    compile_bytes(&eds_name(name), bytes, sources, &mut report.loader())
}

/// The specification of a stored EDS.
fn of_eds<B: Bus>(
    client: &mut Client<B>,
    node: u8,
    name: &str,
    bytes: Vec<u8>,
    report: &Report,
) -> Result<Specified, u8> {
    let mut sources = SourceMap::new();
    let compiled = compiled(name, bytes, &mut sources, report);
    let root = sources.files().next().map(|(id, _)| id);
    let imported = root.and_then(|root| import(&compiled, &sources, root)).transpose();
    let imported = imported.map_err(|diagnostics| report.show(&diagnostics, &sources));
    let system = compiled.system.as_ref();
    let device = system.and_then(|system| system.devices.first());
    let (Ok(Some(imported)), Some(device)) = (imported, device) else {
        report.show(&compiled.diagnostics, &sources);
        let message = format!("node {node}: the EDS that it has stored cannot be used");
        return Err(report.refuse(
            Diagnostic::without_place(codes::UNREADABLE, message)
                .help("`--range 2000h..9FFFh` asks for its objects instead"),
        ));
    };
    let remarks =
        recognize(client, node, device, None).map_err(|error| failed(node, "what it is", &error, report))?;
    for remark in remarks {
        if let Remark::Contradicts(found) = remark {
            report.note(&format!(
                "the EDS that node {node} has stored is of another {}: {} is 0x{:08X} in the node, 0x{:08X} in the EDS",
                match found.fact {
                    Fact::Device | Fact::Serial => "device",
                    Fact::Revision => "revision",
                },
                found.id,
                found.reported,
                found.stated
            ));
        }
    }
    Ok(Specified { text: imported.text, objects: device.objects.len(), from: "the EDS that it has stored" })
}

/// The specification of what a node answers.
fn of_objects<B: Bus>(
    client: &mut Client<B>,
    Wanted { node, bit_rate, args, .. }: Wanted<'_>,
    name: &str,
    report: &Report,
) -> Result<Specified, u8> {
    let ranges = if args.range.is_empty() { vec![OTHERS] } else { args.range.clone() };
    let found = objects(client, node, &ranges, report)?;
    if found.is_empty() {
        let message = format!("node {node} has no object in the indices that were asked for");
        return Err(report.refuse(
            Diagnostic::without_place(codes::ACCESS_FAILED, message).help("ask for others, with `--range`"),
        ));
    }
    let Described { document, comments } = Findings::new(node, bit_rate, &found).described(&eds_name(name));
    let mut sources = SourceMap::new();
    let compiled = compiled(name, document.to_bytes(), &mut sources, report);
    let asked: Vec<String> = std::iter::once(&STANDARD)
        .chain(&ranges)
        .map(|range| format!("{}..{}", Index(*range.start()), Index(*range.end())))
        .collect();
    let options = Options { head: head(node, &asked.join(", ")), comments, ..Options::default() };
    let system = compiled.system.as_ref();
    let Some((system, device)) = system.and_then(|system| Some((system, system.devices.first()?))) else {
        report.show(&compiled.diagnostics, &sources);
        return Err(ERRORS);
    };
    match specification(system, device, &options) {
        Ok(written) => Ok(Specified {
            text: written.text,
            objects: device.objects.len(),
            from: "the objects that answer",
        }),
        Err(diagnostics) => {
            report.show(&diagnostics, &sources);
            Err(ERRORS)
        }
    }
}

/// What a reader of the specification has to know.
fn head(node: u8, asked: &str) -> Vec<String> {
    [
        &format!("A first specification of node {node}, made from what it answered when these objects were read:"),
        &format!("{asked}. Nothing was written to it."),
        "Objects of standards have the names, types and access types of the standard, where the length of the value",
        "agrees. Of all others the node shows only how long a value is: names, signs, units, limits, and what can be",
        "written or mapped are to be added. What is not in an RPDO is `ro` until then, and a value of the length of an",
        "integer is one without a sign. Defaults are the values that were read; the serial number, error lists and what",
        "PDOs carry have none. Further bit rates, LSS and the name of the maker are not to be had from a node.",
    ]
    .map(ToOwned::to_owned)
    .to_vec()
}
