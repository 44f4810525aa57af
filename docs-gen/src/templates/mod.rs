//! Templates and the pages that they print.
//!
//! A set of templates is a list of files. The name of a file says what it is for: `chapter.EXT` is printed once per chapter,
//! `device.EXT` once per device, `appendix.EXT` once per appendix, and any other file once, under its own name. Files whose
//! name begins with `_` are only included by others.

mod bounds;
mod markdown;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use minijinja::syntax::SyntaxConfig;
use minijinja::value::{Serde, Value};
use minijinja::{Environment, ErrorKind, UndefinedBehavior, context};

use crate::options::Siblings;
use crate::portal::Portal;
use crate::view::Context;

/// A format that this crate has templates for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Format {
    /// Markdown: a page per chapter, device and appendix, and an index.
    Markdown,
    /// HTML: a page for the system and one per device, each complete in itself.
    Html,
    /// HTML to be printed: one page for everything, with title, contents and page numbers.
    Print,
}

impl Format {
    /// Name and text of the templates.
    pub const fn files(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Format::Markdown => MARKDOWN,
            Format::Html => HTML,
            Format::Print => PRINT,
        }
    }
}

macro_rules! files {
    ($($path:literal),+ $(,)?) => {
        &[$((file_name($path), include_str!(concat!("../../templates/", $path)))),+]
    };
}

const MARKDOWN: &[(&str, &str)] =
    files!("md/_macros.md", "md/README.md", "md/chapter.md", "md/device.md", "md/appendix.md");
const HTML: &[(&str, &str)] = files!(
    "html/_layout.html",
    "html/_portal.html",
    "html/_links.html",
    "html/_macros.html",
    "html/_pictures.html",
    "html/_style.css",
    "html/_script.js",
    "html/_search.js",
    "html/_words.js",
    "html/_search.html",
    "html/_values.js",
    "html/_workbench.css",
    "html/_workbench.html",
    "html/_workbench.js",
    "html/_user.css",
    "html/_footer.html",
    "html/index.html",
    "html/device.html",
);
const PRINT: &[(&str, &str)] = files!(
    "html/_links.html",
    "html/_macros.html",
    "html/_pictures.html",
    "html/_user.css",
    "print/_manual.css",
    "print/_picture.css",
    "print/manual.html",
);

/// `md/chapter.md` → `chapter.md`.
const fn file_name(path: &'static str) -> &'static str {
    let bytes = path.as_bytes();
    let mut at = bytes.len();
    while at > 0 && bytes[at - 1] != b'/' {
        at -= 1;
    }
    path.split_at(at).1
}

/// A printed page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Page {
    /// Name of the file.
    pub path: String,
    /// Contents.
    pub text: String,
}

/// Why a set of templates cannot be printed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TemplateError {
    /// A template is wrong.
    InTemplate {
        /// Name of the template's file.
        template: String,
        /// The template.
        source: String,
        /// The place in it.
        range: Range<usize>,
        /// What is wrong there.
        message: String,
    },
    /// The names of all templates begin with `_`.
    NothingIsPrinted,
    /// Two pages would have one name, such as that of a device and that of another template.
    SamePage(String),
}

impl fmt::Display for TemplateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::InTemplate { template, message, .. } => write!(f, "{template}: {message}"),
            Self::NothingIsPrinted => f.write_str("no template is printed: the names of all begin with `_`"),
            Self::SamePage(path) => {
                write!(f, "two pages would be {path}: a device has the name of another page as its key")
            }
        }
    }
}

impl std::error::Error for TemplateError {}

/// A set of templates, ready to print.
#[derive(Debug)]
pub struct Templates {
    /// The format that they print; none for templates of a user alone.
    pub format: Option<Format>,
    environment: Environment<'static>,
    files: BTreeMap<String, String>,
}

impl Templates {
    /// The templates of a format, if any, with a user's own over them, each a name and a text: a file of the same name
    /// replaces that of the format.
    ///
    /// # Errors
    ///
    /// The first template that is not well formed, with the place in it.
    pub fn new(format: Option<Format>, replacements: &[(String, String)]) -> Result<Self, TemplateError> {
        let mut files: BTreeMap<String, String> = BTreeMap::new();
        for (name, text) in format.map_or(&[][..], Format::files) {
            files.insert((*name).to_owned(), (*text).to_owned());
        }
        files.extend(replacements.iter().cloned());
        let mut templates = Self { format, environment: environment(), files };
        for (name, text) in &templates.files {
            if let Err(error) = templates.environment.add_template_owned(name.clone(), text.clone()) {
                return Err(templates.explain(name, &error));
            }
        }
        Ok(templates)
    }

    /// All pages, in the order of the templates' names.
    ///
    /// # Errors
    ///
    /// The first template that cannot be printed, such as one that names what the context does not have; a set that prints
    /// nothing; two pages of one name.
    pub fn print(&self, context: &Context) -> Result<Vec<Page>, TemplateError> {
        let all = Value::from(Serde(context));
        let list = |key: &str| -> Vec<Value> {
            all.get_attr(key).and_then(|list| list.try_iter()).map_or_else(|_| Vec::new(), Iterator::collect)
        };
        let mut wanted: Vec<(&str, String, Value)> = Vec::new();
        if self.files.keys().all(|name| name.starts_with('_')) {
            return Err(TemplateError::NothingIsPrinted);
        }
        for name in self.files.keys().filter(|name| !name.starts_with('_')) {
            let (stem, extension) = name.rsplit_once('.').unwrap_or((name, ""));
            let (many, key) = match stem {
                "chapter" => (list("chapters"), "page"),
                "appendix" => (list("appendices"), "page"),
                "device" => (list("devices"), "key"),
                _ => {
                    let page = context! { name => stem, path => name, kind => "system" };
                    wanted.push((name, name.clone(), context! { page, ..all.clone() }));
                    continue;
                }
            };
            for item in many {
                let name_of_page = item.get_attr(key).map(|name| name.to_string()).unwrap_or_default();
                let path = format!("{name_of_page}.{extension}");
                let page = context! { name => name_of_page, path => path.clone(), kind => stem };
                let variables = context! { page, ..all.clone() };
                let item = BTreeMap::from([(stem, item)]);
                wanted.push((name, path, context! { ..Value::from(item), ..variables }));
            }
        }
        let pages = self.pages(&wanted, bounds::steps(context.entries))?;
        let mut seen = BTreeSet::new();
        if let Some(twice) = pages.iter().find(|page| !seen.insert(page.path.to_lowercase())) {
            return Err(TemplateError::SamePage(twice.path.clone()));
        }
        Ok(pages)
    }

    /// The start page of several documents; `None` if the set has no template for it, which is `_portal.EXT`.
    ///
    /// # Errors
    ///
    /// As [`Templates::print`].
    pub fn print_portal(&self, portal: &Portal) -> Result<Option<Page>, TemplateError> {
        let Some((template, path)) = self
            .files
            .keys()
            .find_map(|name| Some((name, format!("index.{}", name.strip_prefix("_portal.")?))))
        else {
            return Ok(None);
        };
        let page = context! { name => "index", path => path.clone(), kind => "portal" };
        let nothing = Vec::<Value>::new();
        let siblings = Value::from(Serde(&Siblings::default()));
        let of_page =
            context! { page, appendices => nothing.clone(), devices => nothing, origin => (), siblings };
        let variables = context! { ..of_page, ..Value::from(Serde(portal)) };
        let places: usize = portal
            .documents
            .iter()
            .flat_map(|one| &one.editions)
            .flat_map(|one| &one.pages)
            .map(|one| one.places.len())
            .sum();
        Ok(self.pages(&[(template, path, variables)], bounds::steps(places))?.pop())
    }

    /// Prints pages on all cores, each a template with its file and variables, and gives them in their order. Of several that
    /// cannot be printed, the first counts.
    fn pages(&self, wanted: &[(&str, String, Value)], steps: u64) -> Result<Vec<Page>, TemplateError> {
        let mut environment = self.environment.clone();
        environment.set_fuel(Some(steps));
        let cores = std::thread::available_parallelism().map_or(1, usize::from).min(wanted.len().max(1));
        let next = AtomicUsize::new(0);
        let room = bounds::Room::new(bounds::OUTPUT);
        let print = || {
            let mut printed = Vec::new();
            loop {
                let position = next.fetch_add(1, Ordering::Relaxed);
                let Some((template, path, variables)) = wanted.get(position) else { return printed };
                let mut output = room.output();
                let page = environment
                    .get_template(template)
                    .and_then(|template| {
                        template.render_captured_to(variables.clone(), &mut output).map(drop)
                    })
                    .map(|()| Page { path: path.clone(), text: without_commands(output.into_text()) })
                    .map_err(|error| self.explain(template, &error));
                printed.push((position, page));
            }
        };
        let printed: BTreeMap<usize, Result<Page, TemplateError>> = std::thread::scope(|scope| {
            let others: Vec<_> = (1..cores).map(|_| scope.spawn(print)).collect();
            let mut printed: Vec<_> = print();
            for other in others {
                printed.extend(other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
            }
            printed.into_iter().collect()
        });
        printed.into_values().collect()
    }

    fn explain(&self, template: &str, error: &minijinja::Error) -> TemplateError {
        // The innermost error is the cause; those around it say through which includes it was reached.
        let mut inner = error;
        while let Some(next) = std::error::Error::source(inner).and_then(|next| next.downcast_ref()) {
            inner = next;
        }
        let name = inner.name().unwrap_or(template).to_owned();
        let source = self.files.get(&name).cloned().unwrap_or_default();
        let range = inner.range().or_else(|| line_range(&source, inner.line()?)).unwrap_or(0..0);
        // Places may lie inside a character.
        let range = boundary(&source, range.start)..boundary(&source, range.end);
        let message = match inner.detail() {
            _ if inner.kind() == ErrorKind::OutOfFuel => {
                "the page takes more steps than its contents can need".to_owned()
            }
            _ if inner.kind() == ErrorKind::WriteFailure => {
                std::error::Error::source(inner).map_or_else(|| inner.kind().to_string(), ToString::to_string)
            }
            Some(detail) => format!("{}: {detail}", inner.kind()),
            None => inner.kind().to_string(),
        };
        TemplateError::InTemplate { template: name, source, range, message }
    }
}

/// The start of the character at a place, or the end of the text.
fn boundary(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or_default()
}

/// Where a line lies in a text; lines are counted from 1.
fn line_range(text: &str, line: usize) -> Option<Range<usize>> {
    let mut start = 0;
    for (number, content) in text.split_inclusive('\n').enumerate() {
        if number + 1 == line {
            return Some(start..start + content.trim_end().len());
        }
        start += content.len();
    }
    None
}

/// A text in at most so many characters, the last of them `…` where some are missing.
fn cut(text: &str, width: usize) -> String {
    if text.chars().count() <= width {
        return text.to_owned();
    }
    let kept: String = text.chars().take(width.saturating_sub(1)).collect();
    kept.trim_end().to_owned() + "…"
}

/// A page without control characters: of a format that is read at a terminal they would be obeyed, and HTML has none.
fn without_commands(text: String) -> String {
    let is_command = |c: char| c.is_control() && !matches!(c, '\n' | '\t' | '\r');
    // Most pages have none, and only two bytes begin one.
    let may_be =
        |byte: u8| (byte < b' ' && !matches!(byte, b'\n' | b'\t' | b'\r')) || matches!(byte, 0x7F | 0xC2);
    if text.bytes().any(may_be) && text.contains(is_command) { text.replace(is_command, " ") } else { text }
}

fn environment() -> Environment<'static> {
    let mut environment = Environment::new();
    environment.set_undefined_behavior(UndefinedBehavior::Strict);
    environment.set_debug(true);
    let mut syntax = SyntaxConfig::builder();
    syntax.trim_blocks(true).lstrip_blocks(true).keep_trailing_newline(true);
    if let Ok(syntax) = syntax.build() {
        environment.set_syntax(syntax);
    }
    environment.add_filter("cut", cut);
    environment.add_filter("md", |text: &str| od_spec::markdown::escape(text));
    environment.add_filter("md_cell", |cell: &Value, page: &str| markdown::cell(cell, page));
    environment.add_filter("md_paragraph", |cell: &Value, page: &str| markdown::paragraph(cell, page));
    environment.add_filter("md_table", |grid: &Value, page: &str| markdown::table(grid, page));
    environment
}
