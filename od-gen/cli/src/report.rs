//! Messages to standard error, results to standard output.

use std::fmt::Write as _;
use std::io::{IsTerminal as _, Write as _};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use od_formats::findings::json;
use od_gen::source::{FileLoader, compile_file};
use od_gen::{CHECK, condense, condensed};
use od_spec::diag::render;
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::eds::codes::UNKNOWN_MODULE;
use od_spec::eds::is_eds;
use od_spec::file_name;
use od_spec::model::{Dictionary, System};
use od_spec::source::SourceMap;
use od_spec::visible::{printable, visible, visible_json};
use od_spec::xdd::{Disabled, is_xdd};
use od_spec::{Commissioning, Compiled, NodeOfFile};

use crate::exit::{ERRORS, SUCCESS, USAGE};
use crate::listing::{Most, for_people};
use crate::messages::{Color, Format};
use crate::progress::Audience;

/// Writes diagnostics the way the user asked for.
pub(crate) struct Report {
    format: Format,
    colour: bool,
    disabled: Disabled,
    shows: Shows,
}

/// What is shown of a specification without errors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shows {
    /// Each warning.
    Warnings,
    /// How many there are, in one line: its reader cannot fix them.
    Count,
}

/// What a command works on.
pub(crate) struct Used {
    pub(crate) system: System,
    /// Of a DCF: the node that it configures.
    pub(crate) node: Option<NodeOfFile>,
    /// Of a parameter file: the device that it is for.
    pub(crate) device: Option<String>,
}

impl Used {
    /// The node-ID that counts: the given one, or else that of a DCF.
    pub(crate) fn node_id(&self, given: Option<u8>) -> Option<u8> {
        given.or_else(|| self.node.as_ref()?.stated_id())
    }

    /// Of a DCF at `path`: what documents of it are about, with the values of the node in place of the defaults.
    pub(crate) fn documented(&self, path: &Path, report: &Report) -> Option<System> {
        let node = self.node.as_ref()?.at(None);
        if !node.values.is_empty() {
            let count = node.values.len();
            let (values, are) = if count == 1 { ("value", "is") } else { ("values", "are") };
            let file = shown(path);
            report.note(&format!("the {count} {values} of the node in {file} {are} shown as defaults"));
        }
        let mut system = self.system.clone();
        for device in &mut system.devices {
            *device = node.configured(device);
        }
        Some(system)
    }
}

impl Report {
    pub(crate) fn new(format: Format, color: Color, disabled: Disabled) -> Self {
        let colour = match color {
            Color::Always => true,
            Color::Never => false,
            Color::Auto => std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none(),
        };
        Self { format, colour, disabled, shows: Shows::Warnings }
    }

    /// The same for a command of operators, who use a specification that others write: its warnings are counted, and not repeated at
    /// every call.
    pub(crate) const fn for_operators(&self) -> Self {
        Self { shows: Shows::Count, ..*self }
    }

    /// Reads the files of a command.
    pub(crate) fn loader(&self) -> FileLoader {
        FileLoader { disabled: self.disabled, ..FileLoader::default() }
    }

    /// What becomes of objects of an XDD that are switched off.
    pub(crate) const fn disabled(&self) -> Disabled {
        self.disabled
    }

    /// Who reads the messages.
    pub(crate) const fn audience(&self) -> Audience {
        match self.format {
            Format::Human | Format::Short => Audience::People,
            Format::Json => Audience::Programs,
        }
    }

    /// Whether messages are coloured.
    pub(crate) const fn colour(&self) -> bool {
        self.colour
    }

    /// Writes messages that are text already.
    pub(crate) fn write(&self, text: &str) {
        // A console of Windows shows colours only after it was asked to.
        let mut out = anstream::AutoStream::always(std::io::stderr());
        let _ = out.write_all(printable(text, self.colour).as_bytes());
    }

    /// Writes what is wrong and, for people, how much it is; notes are for `odgen check --notes`.
    pub(crate) fn show(&self, diagnostics: &Diagnostics, sources: &SourceMap) {
        let shows = match sources.files().next() {
            Some((_, file)) => format!("`odgen check {} --all`", visible(file.name())),
            None => "`odgen check --all`".to_owned(),
        };
        self.show_with(diagnostics, sources, &shows);
    }

    /// [`show`](Self::show), with what shows the findings that are left out.
    pub(crate) fn show_with(&self, diagnostics: &Diagnostics, sources: &SourceMap, shows: &str) {
        let diagnostics = &diagnostics.clone().without_notes();
        let mut text = match self.format {
            Format::Human => {
                let source = sources.files().next().map(|(_, file)| file);
                let most = match source {
                    Some(file) if is_eds(file.name(), file.text()) || is_xdd(file.name(), file.text()) => {
                        Most::OfEds
                    }
                    Some(_) | None => Most::OfSpecification,
                };
                for_people(diagnostics, sources, most, shows, self.colour)
            }
            Format::Short => render::render(diagnostics, sources, render::Format::Short, self.colour),
            Format::Json => json(diagnostics, sources),
        };
        let summary = render::summary(diagnostics);
        if self.format == Format::Human && !summary.is_empty() {
            // An error before a warning, wherever it is.
            let first = diagnostics.iter().min_by_key(|one| one.severity()).map_or("", |first| first.code.id);
            let _ = writeln!(text, "{summary}; `odgen explain {first}` says more");
        }
        self.write(&text);
    }

    /// Shows what there is to say of a specification or plant that a command uses, and that `check` shows whole.
    pub(crate) fn show_used(&self, path: &Path, check: &str, diagnostics: &Diagnostics, sources: &SourceMap) {
        match (self.shows, self.audience()) {
            (Shows::Count, Audience::People) if !diagnostics.has_errors() => {
                let counted = condensed(&file_name::shown(path), check, &diagnostics.clone().without_notes());
                if let Some(line) = counted {
                    self.note(&line);
                }
            }
            (Shows::Count | Shows::Warnings, _) => self.show(diagnostics, sources),
        }
    }

    /// Reports to people what the command does unasked; not to programs that read JSON.
    pub(crate) fn note(&self, text: &str) {
        if self.format != Format::Json {
            self.write(&format!("note: {text}\n"));
        }
    }

    /// Compiles a file and shows what there is to say, about an EDS or DCF how much; `None` when it cannot be used.
    pub(crate) fn compile(&self, path: &Path) -> Option<System> {
        self.compile_with_sources(path).map(|(Used { system, .. }, _)| system)
    }

    /// [`compile`](Self::compile), with the node of a DCF and the texts that were read.
    pub(crate) fn compile_with_sources(&self, path: &Path) -> Option<(Used, SourceMap)> {
        let (used, diagnostics, sources) = self.compile_unshown(path);
        self.show_used(path, CHECK, &diagnostics, &sources);
        Some((used?, sources))
    }

    /// [`compile_with_sources`](Self::compile_with_sources), for a caller that adds messages and shows all of them
    /// together.
    pub(crate) fn compile_unshown(&self, path: &Path) -> (Option<Used>, Diagnostics, SourceMap) {
        let mut sources = SourceMap::new();
        let mut compiled = compile_file(path, &mut sources, &mut self.loader());
        if let Some(line) = condense(path, &mut compiled) {
            self.note(&line);
        }
        let Compiled { system, node, diagnostics, .. } = compiled;
        (system.map(|system| Used { system, node, device: None }), diagnostics, sources)
    }

    /// The node of a DCF with this node-ID, or else its own; with a warning about what does not follow the node-ID.
    pub(crate) fn moved(&self, node: &NodeOfFile, id: Option<u8>, sources: &SourceMap) -> Commissioning {
        let moved = node.at(id);
        self.left_behind(node, &moved, sources);
        moved
    }

    /// Warns about what does not follow the node-ID of a node that was made of that of a DCF.
    pub(crate) fn left_behind(&self, of_file: &NodeOfFile, node: &Commissioning, sources: &SourceMap) {
        if let Some(warning) = of_file.left_behind(node) {
            let mut diagnostics = Diagnostics::new();
            diagnostics.push(warning);
            self.show(&diagnostics, sources);
        }
    }

    /// Reports what an XDD of a device, or an XDC of a node, does without.
    pub(crate) fn not_in_xdd(&self, device: &Dictionary, node: Option<&Commissioning>) {
        let further = device.further.as_ref();
        let (keys, modules) = further.map_or((0, 0), |further| (further.count(), further.modules.len()));
        let of_node = node.map_or(0, |node| {
            let texts = [&node.reference, &node.net_reference].into_iter().filter(|text| !text.is_empty());
            node.references.len() + texts.count()
        });
        let keys = keys + of_node;
        if keys == 0 {
            return;
        }
        let modules =
            if modules == 0 { String::new() } else { format!(", with all of its {modules} modules,") };
        self.note(&format!(
            "`{}`: {keys} keys of the file{modules} are in no XDD or XDC, which have no place for them",
            device.key
        ));
    }

    /// Shows one message that has no place in a source text.
    pub(crate) fn refuse(&self, diagnostic: Diagnostic) -> u8 {
        let mut diagnostics = Diagnostics::new();
        diagnostics.push(diagnostic);
        let of_the_command_line = [
            codes::BAD_NODE_ID,
            codes::UNKNOWN_DEVICE,
            codes::UNKNOWN_WORD,
            codes::BAD_NOTATION,
            UNKNOWN_MODULE,
        ];
        let is_usage = diagnostics.iter().all(|diagnostic| of_the_command_line.contains(&diagnostic.code));
        let code = if is_usage { USAGE } else { ERRORS };
        self.show(&diagnostics, &SourceMap::new());
        code
    }

    /// Shows that none of the specifications has a device.
    pub(crate) fn unknown_device<'a>(&self, systems: impl Iterator<Item = &'a System>, key: &str) -> u8 {
        let keys = systems.flat_map(|system| &system.devices).map(|device| format!("`{}`", device.key));
        self.refuse(
            Diagnostic::without_place(codes::UNKNOWN_DEVICE, format!("there is no device `{key}`"))
                .help(format!("the devices are {}", keys.collect::<Vec<_>>().join(", "))),
        )
    }

    /// The device with this key, or the only one.
    pub(crate) fn device_or_only<'a>(
        &self,
        system: &'a System,
        key: Option<&str>,
    ) -> Result<&'a Dictionary, u8> {
        match (key, system.devices.as_slice()) {
            (Some(key), _) => self.device(system, key),
            (None, [only]) => Ok(only),
            (None, devices) => {
                let keys: Vec<String> = devices.iter().map(|device| format!("`{}`", device.key)).collect();
                let message = format!("no device is named, and the specification has {}", devices.len());
                let help = match keys.as_slice() {
                    [] => "name a specification that describes devices, not a library".to_owned(),
                    keys => format!("add `--device KEY`: {}", keys.join(", ")),
                };
                Err(self.refuse(Diagnostic::without_place(codes::UNKNOWN_DEVICE, message).help(help)))
            }
        }
    }

    /// The device with this key.
    pub(crate) fn device<'a>(&self, system: &'a System, key: &str) -> Result<&'a Dictionary, u8> {
        system.device(key).ok_or_else(|| {
            let keys: Vec<String> = system.devices.iter().map(|device| format!("`{}`", device.key)).collect();
            self.refuse(
                Diagnostic::without_place(codes::UNKNOWN_DEVICE, format!("there is no device `{key}`"))
                    .help(format!("the specification has {}", keys.join(", "))),
            )
        })
    }
}

/// A node-ID from the command line.
pub(crate) fn node_id(text: &str) -> Result<u8, Diagnostic> {
    let number = od_spec::scalar::integer(text.trim()).ok().and_then(|number| u8::try_from(number).ok());
    number.filter(|node| (1..=127).contains(node)).ok_or_else(|| {
        Diagnostic::without_place(codes::BAD_NODE_ID, format!("found `{text}`, expected a node-ID"))
            .help("node-IDs are 1 to 127")
    })
}

/// Writes a result. What it quotes from outside cannot command a terminal.
pub(crate) fn print(text: &str) -> u8 {
    write_out(printable(text, false).as_bytes())
}

/// Writes a result that is coloured for a terminal.
pub(crate) fn print_styled(text: &str) -> u8 {
    write_out(printable(text, true).as_bytes())
}

/// Writes a result in JSON.
pub(crate) fn print_json(bytes: &[u8]) -> u8 {
    match std::str::from_utf8(bytes) {
        Ok(text) => write_out(visible_json(text).as_bytes()),
        Err(_) => write_out(bytes),
    }
}

/// A text of a file as it is: what comes out is to be a file again.
pub(crate) fn print_file(text: &str) -> u8 {
    write_out(text.as_bytes())
}

/// A path on one line.
pub(crate) fn shown(path: &Path) -> String {
    visible(&file_name::shown(path)).into_owned()
}

fn write_out(bytes: &[u8]) -> u8 {
    let mut out = std::io::stdout().lock();
    // What is still in the buffer when the process ends is lost without a word.
    out.write_all(bytes).and_then(|()| out.flush()).map_or_else(|error| not_printed(&error), |()| SUCCESS)
}

/// The exit code when a result cannot be written; a reader that went away early is not an error.
pub(crate) fn not_printed(error: &std::io::Error) -> u8 {
    // Once: a command that continues prints more.
    static IS_REPORTED: AtomicBool = AtomicBool::new(false);
    if error.kind() == std::io::ErrorKind::BrokenPipe {
        return SUCCESS;
    }
    if !IS_REPORTED.swap(true, Ordering::Relaxed) {
        anstream::eprintln!("error: cannot write to standard output: {error}");
    }
    ERRORS
}
