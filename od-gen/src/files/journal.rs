//! What is going on in a directory, written down before it begins: so that the next process can finish or undo it when this one
//! is killed.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

use super::disk::Disk;

/// The file, in the directory of the set.
const JOURNAL: &str = ".odgen-journal";
const HEAD: &str = "odgen journal 2";

/// How far a set has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Phase {
    /// New files are written under other names. To undo: remove them.
    Prepare,
    /// All new files are on the disk. To finish: give them their names.
    Replace,
    /// Something failed. To undo: bring the old files back.
    Undo,
}

impl Phase {
    const ALL: [Self; 3] = [Self::Prepare, Self::Replace, Self::Undo];

    const fn word(self) -> &'static str {
        match self {
            Self::Prepare => "prepare",
            Self::Replace => "replace",
            Self::Undo => "undo",
        }
    }
}

/// A file that is replaced.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Step {
    /// Relative to the directory of the set.
    pub(super) path: String,
    /// What was there before; nothing, if there was no file.
    pub(super) old: Option<u64>,
    /// What is to be there.
    pub(super) new: u64,
}

/// A set of files on its way.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Journal {
    pub(super) phase: Phase,
    pub(super) steps: Vec<Step>,
}

/// Whether a directory has one, or the beginning of one.
pub(super) fn is_there(directory: &Path) -> bool {
    [JOURNAL.to_owned(), unfinished()].iter().any(|name| directory.join(name).symlink_metadata().is_ok())
}

/// A journal under this name was never in force.
fn unfinished() -> String {
    format!("{JOURNAL}.new")
}

/// A number that contents are recognised by. Eight bytes at once are multiplied in; a shift lets high bits count, too.
pub(super) fn fingerprint(bytes: &[u8]) -> u64 {
    fingerprint_of(&[bytes])
}

/// The fingerprint of contents in pieces, which does not depend on where they are divided.
pub(super) fn fingerprint_of(pieces: &[&[u8]]) -> u64 {
    let step = |hash: u64, word: u64| {
        let mixed = (hash ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        mixed ^ (mixed >> 32)
    };
    let length: usize = pieces.iter().map(|piece| piece.len()).sum();
    let mut hash = length as u64;
    // What is left of the pieces before, less than a word.
    let (mut begun, mut count) = ([0; 8], 0);
    for piece in pieces {
        let (head, piece) = piece.split_at(if count == 0 { 0 } else { (8 - count).min(piece.len()) });
        begun[count..count + head.len()].copy_from_slice(head);
        count += head.len();
        if count == 8 {
            hash = step(hash, u64::from_le_bytes(begun));
            count = 0;
        }
        let (words, rest) = piece.as_chunks::<8>();
        hash = words.iter().fold(hash, |hash, word| step(hash, u64::from_le_bytes(*word)));
        begun[count..count + rest.len()].copy_from_slice(rest);
        count += rest.len();
    }
    begun[..count].iter().fold(hash, |hash, byte| step(hash, u64::from(*byte)))
}

/// Writes a journal so that either it or the one before is on the disk.
pub(super) fn write(phase: Phase, steps: &[Step], directory: &Path, disk: &impl Disk) -> io::Result<()> {
    let mut text = format!("{HEAD}\n{}\n", phase.word());
    for step in steps {
        let old = step.old.map_or("-".to_owned(), |old| format!("{old:016x}"));
        let path = step.path.replace('\\', "\\\\").replace('\n', "\\n");
        let _ = writeln!(text, "{old} {:016x} {path}", step.new);
    }
    // Without this line the text is cut off.
    text.push_str("end\n");
    let new = directory.join(unfinished());
    disk.write(&new, &[text.as_bytes()], None)?;
    disk.rename(&new, &directory.join(JOURNAL))?;
    disk.settle(directory)
}

impl Journal {
    /// The journal that a killed process left.
    pub(super) fn read(directory: &Path) -> io::Result<Option<Self>> {
        match fs::read_to_string(directory.join(JOURNAL)) {
            Ok(text) => Self::parse(&text).map(Some).ok_or_else(|| {
                io::Error::new(
                    io::ErrorKind::InvalidData,
                    format!("`{JOURNAL}` is none of this version of odgen; remove it, and build again"),
                )
            }),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(error),
        }
    }

    fn parse(text: &str) -> Option<Self> {
        let mut lines = text.strip_suffix("end\n")?.lines();
        if lines.next()? != HEAD {
            return None;
        }
        let word = lines.next()?;
        let phase = Phase::ALL.into_iter().find(|phase| phase.word() == word)?;
        let steps = lines.map(|line| {
            let mut parts = line.splitn(3, ' ');
            let (old, new, path) = (parts.next()?, parts.next()?, parts.next()?);
            let number = |text: &str| u64::from_str_radix(text, 16).ok();
            let old = if old == "-" { None } else { Some(number(old)?) };
            let path = unescaped(path);
            // A journal speaks of its own directory only.
            let inside = |component| matches!(component, Component::Normal(_));
            Path::new(&path).components().all(inside).then_some(Step { path, old, new: number(new)? })
        });
        Some(Self { phase, steps: steps.collect::<Option<_>>()? })
    }

    /// Removes it: the set is complete, or as it was.
    pub(super) fn close(directory: &Path, disk: &impl Disk) -> io::Result<()> {
        disk.remove(&directory.join(unfinished()))?;
        disk.remove(&directory.join(JOURNAL))
    }
}

fn unescaped(text: &str) -> String {
    let mut out = String::new();
    let mut chars = text.chars();
    while let Some(c) = chars.next() {
        match c {
            '\\' => out.push(if chars.next() == Some('n') { '\n' } else { '\\' }),
            c => out.push(c),
        }
    }
    out
}

/// Where a file of the set lies: what a link leads to, so that the link stays.
pub(super) fn target(directory: &Path, path: &Path) -> io::Result<PathBuf> {
    let target = directory.join(path);
    if target.symlink_metadata().is_ok_and(|metadata| metadata.is_symlink()) {
        return fs::canonicalize(&target);
    }
    Ok(target)
}

/// The other names that files have while they are exchanged. Those of a set belong to its journal, which may lie in another
/// directory; what stands for itself has names of its own, so that one can be cleared without harm to the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Names {
    OfSet,
    Alone,
}

impl Names {
    const NEW: &'static str = ".new";
    const OLD: &'static str = ".old";

    const fn prefix(self) -> &'static str {
        match self {
            Self::OfSet => ".odgen-",
            Self::Alone => ".odgen-alone-",
        }
    }

    /// Where the new contents of the file with this number wait.
    pub(super) fn waiting(self, target: &Path, number: usize) -> PathBuf {
        target.with_file_name(format!("{}{number}{}", self.prefix(), Self::NEW))
    }

    /// A second name for the old contents.
    pub(super) fn kept(self, target: &Path, number: usize) -> PathBuf {
        target.with_file_name(format!("{}{number}{}", self.prefix(), Self::OLD))
    }

    /// Whether this is the name of a file of this kind.
    pub(super) fn has(self, name: &str) -> bool {
        let number = name
            .strip_prefix(self.prefix())
            .and_then(|rest| rest.strip_suffix(Self::NEW).or_else(|| rest.strip_suffix(Self::OLD)));
        number.is_some_and(|number| !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_one_kind_are_not_those_of_the_other() {
        let target = Path::new("a/b");
        for (names, other) in [(Names::OfSet, Names::Alone), (Names::Alone, Names::OfSet)] {
            for path in [names.waiting(target, 10), names.kept(target, 0)] {
                let name = path.file_name().unwrap().to_str().unwrap();
                assert!(names.has(name) && !other.has(name), "{name}");
            }
        }
        for name in [JOURNAL, ".odgen-files", ".odgen-alone-.new", ".odgen-alone-1.rs", "odgen-alone-1.new"] {
            assert!(!Names::OfSet.has(name) && !Names::Alone.has(name), "{name}");
        }
    }

    #[test]
    fn contents_that_differ_have_numbers_that_differ() {
        let text: Vec<u8> = (0..40).collect();
        let numbers = (0..=text.len()).map(|length| fingerprint(&text[..length]));
        let changed = (0..text.len() * 8).map(|bit| {
            let mut text = text.clone();
            text[bit / 8] ^= 1 << (bit % 8);
            fingerprint(&text)
        });
        let zeros = (2..40).map(|length| fingerprint(&vec![0; length]));
        let numbers: Vec<u64> = numbers.chain(changed).chain(zeros).collect();
        let different: std::collections::BTreeSet<&u64> = numbers.iter().collect();
        assert_eq!(different.len(), numbers.len());
    }

    #[test]
    fn a_journal_is_read_as_it_was_written_or_not_at_all() {
        let directory = std::env::temp_dir().join(format!("odgen-journal-{}", std::process::id()));
        fs::create_dir_all(&directory).unwrap();
        let steps = vec![
            Step { path: "eds/a b\\n\n.eds".to_owned(), old: None, new: 7 },
            Step { path: "b".to_owned(), old: Some(u64::MAX), new: 0 },
        ];
        for phase in Phase::ALL {
            write(phase, &steps, &directory, &super::super::disk::Real).unwrap();
            assert_eq!(Journal::read(&directory).unwrap(), Some(Journal { phase, steps: steps.clone() }));
        }
        let text = fs::read_to_string(directory.join(JOURNAL)).unwrap();
        for cut in 0..text.len() {
            assert_eq!(Journal::parse(&text[..cut]), None, "{cut}");
        }
        assert_eq!(Journal::parse("odgen journal 2\nundo\n- 0000000000000000 ../a\nend\n"), None);
        Journal::close(&directory, &super::super::disk::Real).unwrap();
        assert_eq!(Journal::read(&directory).unwrap(), None);
        fs::remove_dir_all(&directory).unwrap();
    }
}
