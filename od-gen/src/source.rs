//! Reading specifications from files.

use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::source::{FileId, SourceMap};
use od_spec::{Compiled, Loader, compile, read_text};

/// A little more than the compiler accepts, so that larger files are refused without being read whole.
const READ_LIMIT: u64 = (64 << 20) + 1;

/// Reads library files relative to the file that names them, and remembers which.
#[derive(Debug, Default)]
pub struct FileLoader {
    /// Files that were read, in order.
    pub read: Vec<PathBuf>,
}

impl Loader for FileLoader {
    fn load(&mut self, path: &str, from: &str) -> Result<Vec<u8>, String> {
        let path = Path::new(from).parent().unwrap_or(Path::new("")).join(path);
        let bytes = read_bytes(&path)?;
        self.read.push(path);
        Ok(bytes)
    }
}

/// Compiles the specification in a file. The file's own reading errors are diagnostics, too.
pub fn compile_file(path: &Path, sources: &mut SourceMap, loader: &mut FileLoader) -> Compiled {
    match open(path, sources) {
        Ok(root) => {
            loader.read.push(path.to_owned());
            compile(sources, root, loader)
        }
        Err(diagnostic) => {
            let mut diagnostics = Diagnostics::new();
            diagnostics.push(*diagnostic);
            Compiled { system: None, diagnostics }
        }
    }
}

fn open(path: &Path, sources: &mut SourceMap) -> Result<FileId, Box<Diagnostic>> {
    let name = path.display().to_string();
    let bytes = read_bytes(path).map_err(|reason| {
        Box::new(
            Diagnostic::without_place(codes::UNREADABLE, format!("cannot read {name}: {reason}"))
                .help("check the path; a specification is a YAML file, usually named `*.od.yaml`"),
        )
    })?;
    Ok(sources.add(name.clone(), read_text(&name, bytes)?))
}

fn read_bytes(path: &Path) -> Result<Vec<u8>, String> {
    let describe = |error: std::io::Error| match error.kind() {
        std::io::ErrorKind::NotFound => "no such file".to_owned(),
        std::io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        std::io::ErrorKind::IsADirectory => "it is a directory".to_owned(),
        _ => error.to_string(),
    };
    let file = File::open(path).map_err(describe)?;
    if file.metadata().is_ok_and(|metadata| metadata.is_dir()) {
        return Err("it is a directory".to_owned());
    }
    let mut bytes = Vec::new();
    file.take(READ_LIMIT).read_to_end(&mut bytes).map_err(describe)?;
    Ok(bytes)
}
