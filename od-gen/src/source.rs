//! Reading specifications from files.

use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, Read as _};
use std::path::{Component, Path, PathBuf};

use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::file_name;
use od_spec::source::{FileId, SourceMap};
use od_spec::xdd::Disabled;
use od_spec::{Compiled, Loader, add_source, compile, compile_with_modules, may_be_specification, part_of};

/// A little more than the compiler accepts, so that larger files are refused without being read whole.
const READ_LIMIT: u64 = (64 << 20) + 1;

/// Reads library files relative to the file that names them, and remembers which.
#[derive(Debug, Default)]
pub struct FileLoader {
    /// Files that were read, in order.
    pub read: Vec<PathBuf>,
    /// What becomes of objects of an XDD that are switched off.
    pub disabled: Disabled,
}

impl Loader for FileLoader {
    fn load(&mut self, path: &str, from: &str) -> Result<Vec<u8>, String> {
        let path = Path::new(from).parent().unwrap_or(Path::new("")).join(path);
        let bytes = read_file(&path)?;
        self.read.push(path);
        Ok(bytes)
    }

    fn disabled(&self) -> Disabled {
        self.disabled
    }
}

/// Compiles the specification, EDS or DCF in a file. The file's own reading errors are diagnostics, too.
pub fn compile_file(path: &Path, sources: &mut SourceMap, loader: &mut FileLoader) -> Compiled {
    match opened(path, sources, loader) {
        Ok(root) => compile(sources, root, loader),
        Err(diagnostic) => refused(*diagnostic),
    }
}

/// [`compile_file`], with these modules plugged into the bus coupler that an EDS describes.
pub fn compile_file_with_modules(
    path: &Path,
    sources: &mut SourceMap,
    loader: &mut FileLoader,
    modules: &[u32],
) -> Compiled {
    match opened(path, sources, loader) {
        Ok(root) => compile_with_modules(sources, root, loader, modules),
        Err(diagnostic) => refused(*diagnostic),
    }
}

/// Adds a file that is compiled.
///
/// # Errors
/// It cannot be read, or is not a text.
pub fn opened(
    path: &Path,
    sources: &mut SourceMap,
    loader: &mut FileLoader,
) -> Result<FileId, Box<Diagnostic>> {
    let help = "check the path; what is read are specifications (`*.od.yaml`), EDS and DCF files";
    let root = open(path, help, sources)?;
    loader.read.push(path.to_owned());
    Ok(root)
}

/// [`compile_file`], of bytes that were read already: the name replaces the path.
pub fn compile_bytes(
    name: &str,
    bytes: Vec<u8>,
    sources: &mut SourceMap,
    loader: &mut FileLoader,
) -> Compiled {
    match add_source(sources, name, bytes) {
        Ok(root) => compile(sources, root, loader),
        Err(diagnostic) => refused(*diagnostic),
    }
}

fn refused(diagnostic: Diagnostic) -> Compiled {
    let mut diagnostics = Diagnostics::new();
    diagnostics.push(diagnostic);
    Compiled::refused(diagnostics)
}

/// The file that a part of a specification belongs to, where it is there; of any other file, the file itself.
pub fn whole(path: &Path) -> PathBuf {
    let is_specification = |name: &OsStr| name.as_encoded_bytes().ends_with(b".yaml");
    let text = path.file_name().filter(|name| is_specification(name)).and_then(|_| read_file(path).ok());
    let named = text.as_deref().and_then(part_of);
    let whole = named.map(|name| plain(&path.parent().unwrap_or(Path::new("")).join(name)));
    let is_one = |whole: &PathBuf| read_file(whole).is_ok_and(|text| may_be_specification(&text));
    whole.filter(is_one).unwrap_or_else(|| path.to_owned())
}

/// A path without the steps down that a step up takes back.
pub fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match (part, plain.components().next_back()) {
            (Component::ParentDir, Some(Component::Normal(_))) => drop(plain.pop()),
            (Component::CurDir, _) => {}
            (part, _) => plain.push(part),
        }
    }
    plain
}

/// The files of a directory that are called like specifications, `*.od.yaml`, ordered by name; hidden files are left out, and
/// parts of a specification.
/// For the current directory, `.`, the paths are bare file names, as a user would type them.
///
/// # Errors
///
/// The directory cannot be read.
pub fn specifications_in(directory: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = files_of_specifications_in(directory)?;
    found.retain(|path| whole(path) == *path);
    Ok(found)
}

/// [`specifications_in`], with the parts.
///
/// # Errors
///
/// The directory cannot be read.
pub fn files_of_specifications_in(directory: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(directory)? {
        let entry = entry?;
        let name = entry.file_name();
        let bytes = name.as_encoded_bytes();
        if bytes.ends_with(b".od.yaml") && !bytes.starts_with(b".") && entry.path().is_file() {
            let path = if directory == Path::new(".") { PathBuf::from(name) } else { entry.path() };
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

/// Adds a file to what messages have their places in.
///
/// # Errors
/// It cannot be read, which has the `help`, or is not a text.
pub fn open(path: &Path, help: &str, sources: &mut SourceMap) -> Result<FileId, Box<Diagnostic>> {
    let name = file_name::shown(path);
    let bytes = read_bytes(path).map_err(|reason| {
        Box::new(
            Diagnostic::without_place(codes::UNREADABLE, format!("cannot read {name}: {reason}")).help(help),
        )
    })?;
    add_source(sources, &name, bytes)
}

/// The bytes of a file that another file names: a regular file. A device may have no end, and a pipe waits for a writer
/// as soon as it is opened.
///
/// # Errors
/// Why it cannot be read, in a few words.
pub fn read_file(path: &Path) -> Result<Vec<u8>, String> {
    match fs::metadata(path) {
        Ok(metadata) if !metadata.is_file() && !metadata.is_dir() => {
            Err("it is not a regular file".to_owned())
        }
        Ok(_) | Err(_) => read_bytes(path),
    }
}

/// Why a file cannot be read, in words that are the same on every system where there is a word for it.
pub fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        io::ErrorKind::IsADirectory => "it is a directory".to_owned(),
        _ => error.to_string(),
    }
}

/// The bytes of a file that the user names, which may be a pipe.
///
/// # Errors
/// Why it cannot be read, in a few words.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, String> {
    let file = File::open(path).map_err(|error| reason(&error))?;
    if file.metadata().is_ok_and(|metadata| metadata.is_dir()) {
        return Err("it is a directory".to_owned());
    }
    let mut bytes = Vec::new();
    file.take(READ_LIMIT).read_to_end(&mut bytes).map_err(|error| reason(&error))?;
    Ok(bytes)
}

/// All of an input such as standard input, but not more than a file may have.
///
/// # Errors
/// It cannot be read.
pub fn read_input(input: impl io::Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    input.take(READ_LIMIT).read_to_end(&mut bytes)?;
    Ok(bytes)
}
