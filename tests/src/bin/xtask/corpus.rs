//! Takes a directory of foreign EDS, DCF, XDD and XDC files through everything that the project does with one.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use od_tests::Failure;
use od_tests::foreign::{Checked, EDS, Step, XDD, check, find};

/// Most problems of one file and step that are reported.
const MOST_TOLD: usize = 5;

/// Checks each Nth of the EDS, DCF, XDD and XDC files below a directory; a line for each problem, and what became of all of them.
pub(crate) fn corpus(directory: &str, every: usize) -> Result<(), Failure> {
    let directory = Path::new(directory);
    let mut paths = Vec::new();
    find(directory, &[EDS, XDD].concat(), &mut paths)?;
    paths.sort();
    if paths.is_empty() {
        return Err(format!("{} has no EDS, DCF, XDD or XDC", directory.display()).into());
    }
    let paths: Vec<PathBuf> = paths.into_iter().step_by(every).collect();
    // What panics is reported with its file; the usual report would be between the lines.
    std::panic::set_hook(Box::new(|_| {}));
    let next = AtomicUsize::new(0);
    let done: Mutex<BTreeMap<PathBuf, Checked>> = Mutex::new(BTreeMap::new());
    let work = || -> Result<(), Failure> {
        while let Some(path) = paths.get(next.fetch_add(1, Ordering::Relaxed)) {
            let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
            let checked = check(&name(path), &bytes);
            done.lock().map_err(|error| error.to_string())?.insert(path.clone(), checked);
        }
        Ok(())
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let outcome = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        threads
            .into_iter()
            .try_for_each(|thread| thread.join().unwrap_or_else(|_| Err("a thread failed".into())))
    });
    drop(std::panic::take_hook());
    outcome?;
    let done = done.into_inner().map_err(|error| error.to_string())?;
    let done: Vec<(String, Checked)> =
        done.into_iter().map(|(path, checked)| (name(&path), checked)).collect();
    print!("{}", problems(&done));
    print!("{}", table(&done));
    let failed = done.iter().filter(|(_, checked)| !checked.problems.is_empty()).count();
    match failed {
        0 => Ok(()),
        failed => Err(format!("{failed} of {} files have problems", done.len()).into()),
    }
}

fn name(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

/// A line for each problem.
fn problems(done: &[(String, Checked)]) -> String {
    let mut text = String::new();
    for (name, checked) in done {
        for step in Step::ALL {
            let found: Vec<_> = checked.problems.iter().filter(|problem| problem.step == step).collect();
            for problem in found.iter().take(MOST_TOLD) {
                let _ = writeln!(text, "{name}: {step}: {}", problem.what);
            }
            if let Some(more) = found.len().checked_sub(MOST_TOLD).filter(|more| *more > 0) {
                let _ = writeln!(text, "{name}: {step}: {more} more");
            }
        }
    }
    text
}

/// What became of all files.
fn table(done: &[(String, Checked)]) -> String {
    let all = || done.iter().map(|(_, checked)| checked);
    let passed = |step: Step| all().filter(|checked| checked.passed(step)).count();
    let sum = |count: fn(&Checked) -> usize| all().map(count).sum::<usize>();
    let fixed = all().filter(|checked| checked.changes > 0).count();
    let mut text = String::from("\n");
    let mut row = |name: &str, what: String| {
        let _ = writeln!(text, "{name:<18}{what}");
    };
    row("files", done.len().to_string());
    row("bytes identical", passed(Step::Bytes).to_string());
    row("read", passed(Step::Reading).to_string());
    row(
        "findings",
        format!(
            "{} errors, {} warnings, {} notes",
            sum(|one| one.findings.errors),
            sum(|one| one.findings.warnings),
            sum(|one| one.findings.notes)
        ),
    );
    row("fixed", format!("{fixed} files, {} edits", sum(|one| one.changes)));
    row("fixed well", passed(Step::Fixing).to_string());
    row("same facts", passed(Step::Import).to_string());
    row("imported again", passed(Step::Again).to_string());
    row("compared well", passed(Step::Comparing).to_string());
    let mut reasons: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    for (reason, count) in all().flat_map(|checked| &checked.excepted) {
        let (files, differences) = reasons.entry(reason).or_default();
        *files += 1;
        *differences += count;
    }
    for (reason, (files, differences)) in reasons {
        row("excepted", format!("{differences} in {files} files: {reason}"));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use od_tests::foreign::{Findings, Problem};

    #[test]
    fn each_problem_has_a_line_and_each_count_a_row() {
        let problem = |step, what: &str| Problem { step, what: what.to_owned() };
        let mut bad = Checked { changes: 3, ..Checked::default() };
        bad.findings = Findings { errors: 2, warnings: 1, notes: 0 };
        bad.excepted = vec![("a reason", 4)];
        bad.problems = (0..7).map(|number| problem(Step::Import, &number.to_string())).collect();
        bad.problems.push(problem(Step::Bytes, "another byte at 7, as UTF-8"));
        let done = [("a.eds".to_owned(), Checked::default()), ("b.eds".to_owned(), bad)];
        let lines = problems(&done);
        assert!(
            lines.starts_with("b.eds: bytes: another byte at 7, as UTF-8\nb.eds: import: 0\n"),
            "{lines}"
        );
        assert!(lines.ends_with("b.eds: import: 4\nb.eds: import: 2 more\n"), "{lines}");
        let expected = "
files             2
bytes identical   1
read              2
findings          2 errors, 1 warnings, 0 notes
fixed             1 files, 3 edits
fixed well        2
same facts        1
imported again    2
compared well     2
excepted          4 in 1 files: a reason
";
        assert_eq!(table(&done), expected);
    }

    #[test]
    fn a_directory_without_files_fails() {
        assert!(corpus("tests/no such directory", 1).is_err());
    }
}
