//! What is demanded of every EDS and DCF, however broken.

use od_import::import;
use od_spec::eds::Document;
use od_spec::source::{FileId, SourceMap};
use od_spec::{Compiled, NoFiles, Strictness, add_source, compile_as, fix};

use super::bounds::{Bound, Bounds, Meter, Size, caught};
use super::findings;
use super::notation::{EDS, Notation};
use super::{Complaint, Subject};
use crate::foreign;

/// Files in the notation of CiA 306.
#[derive(Debug, Clone, Copy)]
pub struct EdsFiles {
    meter: Meter,
}

/// A file that asks for everything that is read once.
const FIRST: &[u8] = b"[FileInfo]\nFileName=x\nDescripton=a\n[DeviceInfo]\nProductName=a\nNrOfRXPDO=1\nCompactPDO=1\n\
    [DumyUsage]\n[DummyUsage]\nDummy0001=0\n[1000]\nParameterName=a\nDataType=7\nAccessType=ro\nDefaultValue=402\n[1003]\n[1018]\n[1018sub1]\n\
    [1A00sub1]\nDefaultValue=0x20000008\n[2000]\nDataType=5\nAccesType=ro\n[6040]\nDataType=6\nAccessType=rw\n[DeviceComissioning]\nNodeID=1\n";

impl EdsFiles {
    /// With what says how much a step used.
    pub fn new(meter: Meter) -> Self {
        // The libraries are read once for all files, and are no matter of the first.
        for (_, step) in STEPS {
            step("first.dcf", FIRST);
        }
        Self { meter }
    }
}

impl Subject for EdsFiles {
    fn notation(&self) -> &Notation {
        &EDS
    }

    fn complaints(&self, name: &str, bytes: &[u8]) -> Vec<Complaint> {
        let mut complaints = Vec::new();
        let size = size_in_full(name, bytes);
        let is_small = size <= LARGEST;
        for (bounds, step) in STEPS.into_iter().filter(|(bounds, _)| is_small || bounds.step != TURN) {
            complaints.extend(bounds.of_step(self.meter, || {
                step(name, bytes);
                Size::bytes(size)
            }));
        }
        if complaints.is_empty() && is_small {
            let wrong = caught(|| formats(name, bytes));
            complaints
                .extend(wrong.unwrap_or_else(|what| vec![Complaint { step: "format".to_owned(), what }]));
            // Which key counts where a mutant says things twice is for the reader to say; the comparison with a changed copy
            // finds its lines without it, and cannot know.
            let problems = foreign::check(name, bytes).problems.into_iter();
            let problems = problems.filter(|problem| problem.step != foreign::Step::Comparing);
            complaints.extend(
                problems.map(|problem| Complaint { step: problem.step.to_string(), what: problem.what }),
            );
        }
        complaints
    }
}

fn formats(name: &str, bytes: &[u8]) -> Vec<Complaint> {
    let read =
        [Strictness::Foreign, Strictness::Standard].map(|strictness| compiled(name, bytes, strictness));
    let wrong = read
        .into_iter()
        .flatten()
        .flat_map(|(sources, _, compiled)| findings::wrong(name, &compiled.diagnostics, &sources));
    wrong.map(|(format, what)| Complaint { step: format!("format {format}"), what }).collect()
}

/// A file that is larger in full is only read and fixed: five imports of one take a minute on a busy machine.
const LARGEST: usize = 1_000_000;
/// The step that makes a specification.
const TURN: &str = "turn";
/// What a line of a file takes, and a section that says everything about its entry.
const LINE: usize = 16;
const SECTION: usize = 128;

/// The size of a file, as if its lines and sections were as long as those of real files; entries that no lines describe
/// (`CompactSubObj`, `CompactPDO`) count as if they were described.
fn size_in_full(name: &str, bytes: &[u8]) -> usize {
    let is_break = |byte: &&u8| matches!(byte, b'\n' | b'\r');
    let lines = bytes.iter().filter(is_break).count();
    let sections = bytes.split(|byte| *byte == b'[').skip(1).count();
    let is_compact = |word: &[u8]| word.eq_ignore_ascii_case(b"compact");
    // Also where every second byte is 0.
    let plain: Vec<u8> = bytes.iter().copied().filter(|byte| !matches!(byte, 0 | b' ' | b'\t')).collect();
    let entries = || {
        let (.., compiled) = compiled(name, bytes, Strictness::Foreign)?;
        Some(compiled.system?.devices.first()?.entries().count())
    };
    let has_more = plain.windows(7).any(is_compact);
    let entries = if has_more { caught(entries).ok().flatten().unwrap_or_default() } else { 0 };
    bytes.len().max(LINE * lines).max(SECTION * sections.max(entries))
}

type Step = fn(&str, &[u8]);

/// What is measured. The numbers are what mutants of all seeds, and of two hundred files from the field, have needed at most,
/// and about a third more: one line may be a few bytes, a finding about it is a hundred or two; a section of some lines makes
/// an entry with the places of all its facts.
const STEPS: [(Bounds, Step); 5] = [
    // At most 11 for each byte: a line is an item of 40 bytes.
    (Bounds { step: "scan", peak: Bound::new(20_000, 16), total: Bound::new(20_000, 24) }, scan),
    // At most 48 in a file that says everything, 70 in one of empty sections, with a finding for each thing that is missing.
    // In all: what CiA 301 says about objects is read again for each file.
    (
        Bounds { step: "model", peak: Bound::new(100_000, 80), total: Bound::new(2_000_000, 300) },
        |name, bytes| {
            drop(compiled(name, bytes, Strictness::Foreign));
        },
    ),
    (
        Bounds { step: "check", peak: Bound::new(100_000, 80), total: Bound::new(2_000_000, 300) },
        |name, bytes| {
            drop(compiled(name, bytes, Strictness::Standard));
        },
    ),
    // At most 61: two texts, and what was found in each. In all: as many rounds as changes wait for others.
    (
        Bounds { step: "fix", peak: Bound::new(150_000, 96), total: Bound::new(20_000_000, 1500) },
        |name, bytes| {
            drop(fix(name, bytes));
        },
    ),
    // At most 45: the model three times – of the file, as it is mended, as the specification gives it – and what is compiled.
    (Bounds { step: TURN, peak: Bound::new(2_500_000, 80), total: Bound::new(10_000_000, 2500) }, turn),
];

fn scan(name: &str, bytes: &[u8]) {
    let mut sources = SourceMap::new();
    if let Ok(root) = add_source(&mut sources, name, bytes.to_vec()) {
        let _ = Document::scan(root, sources.file(root).text()).to_string();
    }
}

fn compiled(name: &str, bytes: &[u8], strictness: Strictness) -> Option<(SourceMap, FileId, Compiled)> {
    let mut sources = SourceMap::new();
    let root = add_source(&mut sources, name, bytes.to_vec()).ok()?;
    let compiled = compile_as(strictness, &mut sources, root, &mut NoFiles);
    Some((sources, root, compiled))
}

fn turn(name: &str, bytes: &[u8]) {
    if let Some((sources, root, compiled)) = compiled(name, bytes, Strictness::Foreign) {
        let _ = import(&compiled, &sources, root);
    }
}
