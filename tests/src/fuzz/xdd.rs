//! What is demanded of every XDD and XDC, however broken.

use od_formats::eds::write_eds;
use od_formats::xdd::write_xdd;
use od_spec::source::{FileId, SourceMap};
use od_spec::{Compiled, NoFiles, Strictness, add_source, compile_as};

use super::bounds::caught;
use super::findings;
use super::notation::{Notation, XDD};
use super::{Complaint, Seed, Subject};
use crate::{Failure, compile_with_sources, foreign};

/// Files in XML (CiA 311).
#[derive(Debug, Clone, Copy)]
pub struct XddFiles;

/// Specifications of which XDD files are made.
const SPECIFICATIONS: [&str; 3] = [
    "od-spec/devices/fullmo-drive.od.yaml",
    "tests/shared/physical.od.yaml",
    "tests/readers/everything.od.yaml",
];

impl XddFiles {
    /// The XDD files of some devices of this repository.
    ///
    /// # Errors
    /// A specification that cannot be read.
    pub fn shipped() -> Result<Vec<Seed>, Failure> {
        let mut seeds = Vec::new();
        for path in SPECIFICATIONS {
            let (system, _) = compile_with_sources(path)?;
            seeds.extend(system.devices.iter().map(|device| Seed {
                name: format!("{}.xdd", device.key),
                bytes: write_xdd(&system, device),
            }));
        }
        Ok(seeds)
    }

    /// The same file with a line break before every attribute and at the end of every tag that has some, so that a line is a value.
    pub fn in_lines(seed: &Seed) -> Seed {
        let text = String::from_utf8_lossy(&seed.bytes);
        let mut out = String::new();
        let (mut is_in_tag, mut quote, mut has_value) = (false, None, false);
        for (at, c) in text.char_indices() {
            match (quote, c) {
                (Some(open), c) if open == c => quote = None,
                (Some(_), _) => {}
                (None, '"' | '\'') if is_in_tag => (quote, has_value) = (Some(c), true),
                // Declarations and comments stay as they are.
                (None, '<') => {
                    is_in_tag = !text.get(at + 1..).is_some_and(|rest| rest.starts_with(['?', '!']));
                    has_value = false;
                }
                (None, ' ') if is_in_tag => {
                    out.push('\n');
                    continue;
                }
                (None, '>') => {
                    let is_closed_here = out.ends_with('/');
                    if is_in_tag && has_value {
                        out.insert(out.len() - usize::from(is_closed_here), '\n');
                    }
                    is_in_tag = false;
                }
                (None, _) => {}
            }
            out.push(c);
        }
        Seed { name: seed.name.clone(), bytes: out.into_bytes() }
    }
}

impl Subject for XddFiles {
    fn notation(&self) -> &Notation {
        &XDD
    }

    fn complaints(&self, name: &str, bytes: &[u8]) -> Vec<Complaint> {
        let complaint = |step: &str, what: String| Complaint { step: step.to_owned(), what };
        let read =
            caught(|| [Strictness::Foreign, Strictness::Standard].map(|one| compiled(name, bytes, one)));
        let [foreign, standard] = match read {
            Ok(read) => read,
            Err(what) => return vec![complaint("read", what)],
        };
        let mut complaints = Vec::new();
        for (sources, _, compiled) in [&foreign, &standard].into_iter().flatten() {
            let wrong = findings::wrong(name, &compiled.diagnostics, sources);
            complaints
                .extend(wrong.into_iter().map(|(format, what)| complaint(&format!("format {format}"), what)));
            if compiled.system.is_none() && !compiled.diagnostics.has_errors() {
                complaints.push(complaint("read", "neither a model nor an error".to_owned()));
            }
        }
        let Some((.., Compiled { system: Some(system), .. })) = &foreign else { return complaints };
        for device in &system.devices {
            match caught(|| (write_eds(system, device), write_xdd(system, device))) {
                Ok((_, xdd)) => complaints.extend(unread(&xdd).map(|what| complaint("write", what))),
                Err(what) => complaints.push(complaint("write", what)),
            }
        }
        let problems = foreign::check(name, bytes).problems.into_iter();
        complaints.extend(problems.map(|problem| complaint(&problem.step.to_string(), problem.what)));
        complaints
    }
}

/// What keeps an XDD of ours from being read.
fn unread(xdd: &[u8]) -> Option<String> {
    let Some((_, _, compiled)) = compiled("written.xdd", xdd, Strictness::Foreign) else {
        return Some("what is written is no text".to_owned());
    };
    let errors = compiled.diagnostics.iter().find(|one| one.code.id.starts_with("XDD1"));
    let error = errors.map(|error| format!("what is written is no XDD: {}", error.message));
    error.or_else(|| compiled.system.is_none().then(|| "what is written has no model".to_owned()))
}

fn compiled(name: &str, bytes: &[u8], strictness: Strictness) -> Option<(SourceMap, FileId, Compiled)> {
    let mut sources = SourceMap::new();
    let root = add_source(&mut sources, name, bytes.to_vec()).ok()?;
    let compiled = compile_as(strictness, &mut sources, root, &mut NoFiles);
    Some((sources, root, compiled))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_in_lines_says_the_same() {
        for seed in XddFiles::shipped().unwrap() {
            let lines = XddFiles::in_lines(&seed);
            let text = String::from_utf8(lines.bytes.clone()).unwrap();
            assert!(text.lines().filter(|line| line.starts_with("index=\"")).count() > 3, "{}", seed.name);
            let eds = |seed: &Seed| {
                let (.., compiled) = compiled(&seed.name, &seed.bytes, Strictness::Foreign).unwrap();
                let system = compiled.system.unwrap();
                write_eds(&system, &system.devices[0])
            };
            assert!(eds(&lines) == eds(&seed), "{}", seed.name);
            assert_eq!(XddFiles.complaints(&seed.name, &seed.bytes), []);
        }
    }
}
