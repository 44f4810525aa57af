//! Specifications as they were at a revision of git.

use std::path::{Path, PathBuf};
use std::process::Command;

use od_spec::diag::{Diagnostic, codes};
use od_spec::file_name;
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::xdd::Disabled;
use od_spec::{Loader, read_text};

use crate::exit::ERRORS;
use crate::report::Report;

/// Compiles a file of a revision, with the libraries as they were there.
pub(crate) fn compile(revision: &str, path: &Path, report: &Report) -> Result<System, u8> {
    if revision.is_empty() || revision.starts_with('-') || revision.contains(':') {
        return Err(report.refuse(
            Diagnostic::without_place(codes::BAD_NOTATION, format!("`{revision}` names no revision"))
                .help("write a tag, a branch or a commit, such as `v1.08` or `HEAD~1`"),
        ));
    }
    let mut git = Git { revision, disabled: report.disabled() };
    let name = git.name(path);
    let bytes = git.show(path).map_err(|reason| {
        report.refuse(
            Diagnostic::without_place(codes::UNREADABLE, format!("cannot read {name}: {reason}"))
                .help("`--git REV SPEC` works inside a git repository that has the file at that revision"),
        )
    })?;
    let mut sources = SourceMap::new();
    let text = read_text(&name, bytes).map_err(|diagnostic| report.refuse(*diagnostic))?;
    let root = sources.add(name, text);
    let compiled = od_spec::compile(&mut sources, root, &mut git);
    report.show(&compiled.diagnostics, &sources);
    compiled.system.ok_or(ERRORS)
}

/// Reads files of a revision.
struct Git<'a> {
    revision: &'a str,
    disabled: Disabled,
}

impl Git<'_> {
    /// How messages name a file of the revision, which is as git does.
    fn name(&self, path: &Path) -> String {
        format!("{}:{}", self.revision, file_name::shown(path))
    }

    /// The bytes of a file.
    fn show(&self, path: &Path) -> Result<Vec<u8>, String> {
        let file = path.file_name().ok_or("it names no file")?;
        // Git takes the path from the directory that it runs in.
        let mut object = std::ffi::OsString::from(format!("{}:./", self.revision));
        object.push(file);
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
        let directory = parent.unwrap_or(Path::new("."));
        let output = Command::new("git").arg("-C").arg(directory).arg("show").arg(object).output();
        let output = output.map_err(|error| format!("git cannot be run: {error}"))?;
        if output.status.success() {
            return Ok(output.stdout);
        }
        let said = String::from_utf8_lossy(&output.stderr);
        let said = said.lines().next().unwrap_or("git failed").trim_start_matches("fatal: ");
        Err(format!("git says: {said}"))
    }
}

impl Loader for Git<'_> {
    fn load(&mut self, path: &str, from: &str) -> Result<Vec<u8>, String> {
        let from = from.strip_prefix(self.revision).and_then(|rest| rest.strip_prefix(':')).unwrap_or(from);
        let path: PathBuf = Path::new(from).parent().unwrap_or(Path::new("")).join(path);
        self.show(&path)
    }

    fn disabled(&self) -> Disabled {
        self.disabled
    }
}
