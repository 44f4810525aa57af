//! What is done with the bytes of a file: by odgen, and by the crates of others.

use std::hint::black_box;
use std::time::{Duration, Instant};

use od_spec::eds::Document;
use od_spec::source::{FileId, SourceMap};
use od_spec::{Compiled, NoFiles, Strictness, add_source, compile_as};

/// A step that can be timed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Step {
    /// The bytes decoded, and as a document of lines and sections.
    Parse,
    /// The bytes as a model, with every rule applied.
    Model,
    /// The same, held to the standard as `odgen check` does it.
    Check,
    /// The model as an EDS again.
    Convert,
    /// The model as a specification.
    Import,
    /// The text with everything fixed that needs no guess.
    Fix,
    RustIni,
    CanopenHost,
    CanopenRust,
}

impl Step {
    pub const ALL: [Step; 9] = [
        Step::Parse,
        Step::Model,
        Step::Check,
        Step::Convert,
        Step::Import,
        Step::Fix,
        Step::RustIni,
        Step::CanopenHost,
        Step::CanopenRust,
    ];

    pub const fn name(self) -> &'static str {
        match self {
            Step::Parse => "parse",
            Step::Model => "model",
            Step::Check => "check",
            Step::Convert => "convert",
            Step::Import => "import",
            Step::Fix => "fix",
            Step::RustIni => "rust-ini",
            Step::CanopenHost => "canopen-host",
            Step::CanopenRust => "canopen_rust",
        }
    }

    /// The time from the bytes to the result, and how much came out: an empty result would be no result. What was made is
    /// dropped after the clock was read.
    pub fn run(self, bytes: &[u8]) -> Result<(Duration, usize), String> {
        // Who has read a file owns its bytes.
        let own = bytes.to_vec();
        match self {
            Step::Parse => timed(|| {
                let (sources, root) = source(own)?;
                let lines = Document::scan(root, sources.file(root).text()).lines().len();
                Ok((sources, lines))
            }),
            Step::Model => {
                timed(|| compiled(own, Strictness::Foreign).map(|(_, _, compiled)| count(compiled)))
            }
            Step::Check => {
                timed(|| compiled(own, Strictness::Standard).map(|(_, _, compiled)| count(compiled)))
            }
            Step::Convert => timed(|| {
                let (_, _, compiled) = compiled(own, Strictness::Foreign)?;
                let system = compiled.system.as_ref().ok_or("no model")?;
                let device = system.devices.first().ok_or("no device")?;
                let text = od_formats::eds::write_eds(system, device);
                let size = text.len();
                Ok(((text, compiled), size))
            }),
            Step::Import => timed(|| {
                let (sources, root, compiled) = compiled(own, Strictness::Foreign)?;
                let imported = od_import::import(&compiled, &sources, root).ok_or("no model")?;
                let text = imported.map_err(|_| "no specification")?.text;
                let size = text.len();
                Ok(((text, compiled), size))
            }),
            Step::Fix => timed(|| {
                let fixed = od_spec::fix("controller.eds", bytes).unwrap();
                let size = fixed.text().len();
                Ok((fixed, size))
            }),
            Step::RustIni => timed(|| {
                let ini = ini::Ini::load_from_str(text(bytes)?).map_err(|error| error.to_string())?;
                let size = ini.len();
                Ok((ini, size))
            }),
            Step::CanopenHost => timed(|| {
                let eds = canopen_host::eds::Eds::parse(text(bytes)?).map_err(|error| error.to_string())?;
                let size = eds.objects.len();
                Ok((eds, size))
            }),
            Step::CanopenRust => timed(|| {
                let dictionary = canopen_rust::object_directory::ObjectDirectory::new(5, text(bytes)?);
                let mut dictionary = dictionary.map_err(|error| format!("{error:?}"))?;
                let size = usize::from(dictionary.get_mut_object(0x1000).is_some());
                Ok((dictionary, size))
            }),
        }
    }
}

fn timed<T>(work: impl FnOnce() -> Result<(T, usize), String>) -> Result<(Duration, usize), String> {
    let start = Instant::now();
    let (made, size) = work()?;
    let made = black_box(made);
    let time = start.elapsed();
    drop(made);
    if size == 0 { Err("nothing was read".to_owned()) } else { Ok((time, size)) }
}

fn text(bytes: &[u8]) -> Result<&str, String> {
    std::str::from_utf8(bytes).map_err(|error| error.to_string())
}

fn source(bytes: Vec<u8>) -> Result<(SourceMap, FileId), String> {
    let mut sources = SourceMap::new();
    let root = add_source(&mut sources, "controller.eds", bytes);
    root.map(|root| (sources, root)).map_err(|error| error.message.clone())
}

fn compiled(bytes: Vec<u8>, strictness: Strictness) -> Result<(SourceMap, FileId, Compiled), String> {
    let (mut sources, root) = source(bytes)?;
    let compiled = compile_as(strictness, &mut sources, root, &mut NoFiles);
    Ok((sources, root, compiled))
}

fn count(compiled: Compiled) -> (Compiled, usize) {
    let devices = compiled.system.iter().flat_map(|system| &system.devices);
    let objects = devices.map(|device| device.objects.len()).sum();
    (compiled, objects)
}
