//! What happens to virtual nodes: commands of a file, or of standard input.

use std::collections::VecDeque;
use std::path::Path;
use std::time::Duration;

use firmware_glue::EntryId;
use firmware_glue::emcy::{Emergency, ErrorRegister};
use od_gen::source::open;
use od_spec::diag::{Diagnostic, Diagnostics, codes, nearest};
use od_spec::model::{self, ErrorCode, Value};
use od_spec::scalar::integer;
use od_spec::source::{SourceMap, Span, Spanned};
use od_spec::{SettingNames, settings};

use crate::bus_nodes::BusNodes;
use crate::exit::ERRORS;
use crate::report::Report;

use super::course::{self, Course, Shape};

/// What a command does to a node.
const VERBS: [&str; 7] = ["fault", "clear", "set", "ramp", "triangle", "sine", "stop"];
/// What commands look like.
const COMMANDS: &str = "write `5 fault 0x8611`, `5 clear 0x8611`, `5 set 6064.0=12.34°`, `5 ramp 6064.0=0.00°..90.00° in 10` or `5 stop 6064.0` with the node-ID first, or `wait 1.5`";
/// What courses look like.
const COURSES: &str = "write `5 ramp 6064.0=0.00°..90.00° in 10` for ten seconds; `triangle` and `sine` go there and back in that time, again and again";

/// One command.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Step {
    /// Nothing for a while.
    Wait(Duration),
    /// Something happens to a node.
    Act {
        /// Its position on the bus.
        at: usize,
        /// What.
        act: Act,
    },
}

/// What happens to a node.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Act {
    /// An error occurs.
    Fault(Emergency),
    /// An error, by its code, is gone.
    Clear(u16),
    /// An entry has another value.
    Set {
        /// The entry.
        entry: EntryId,
        /// Its value on the bus.
        value: Vec<u8>,
        /// What a person calls the entry.
        name: String,
    },
    /// The value of an entry changes with time from now on.
    Go(Course),
    /// The value of an entry stays as it is.
    Stop(EntryId),
}

/// The commands that are still to be carried out.
pub(super) struct Script<'a> {
    nodes: &'a BusNodes,
    steps: VecDeque<Step>,
    input: Input,
}

/// Where commands come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Input {
    /// They are all known.
    Read,
    /// Standard input, of which so many lines have come.
    Said(usize),
}

impl<'a> Script<'a> {
    /// The script of a command line. All that is wrong in a file is said at once, and nothing is served; what is wrong on
    /// standard input is said when it comes, and left out.
    pub(super) fn open(path: Option<&Path>, nodes: &'a BusNodes, report: &Report) -> Result<Self, u8> {
        let mut script = Self { nodes, steps: VecDeque::new(), input: Input::Read };
        let path = match path {
            None => return Ok(script),
            Some(path) if path == Path::new("-") => return Ok(Self { input: Input::Said(0), ..script }),
            Some(path) => path,
        };
        let mut sources = SourceMap::new();
        let help = "check the path; `-` is standard input";
        let file = open(path, help, &mut sources).map_err(|diagnostic| report.refuse(*diagnostic))?;
        let whole = sources.whole(file);
        let mut diagnostics = Diagnostics::new();
        let mut start = 0;
        for line in sources.text(whole).split_inclusive('\n') {
            let text = line.trim_end_matches(['\n', '\r']);
            let place = whole.part(start, start + text.len());
            script.steps.extend(script.step(text, place, &mut diagnostics));
            start += line.len();
        }
        report.show(&diagnostics, &sources);
        if diagnostics.has_errors() { Err(ERRORS) } else { Ok(script) }
    }

    /// Whether commands come by standard input.
    pub(super) const fn is_said(&self) -> bool {
        matches!(self.input, Input::Said(_))
    }

    /// Takes a line of standard input.
    pub(super) fn say(&mut self, line: &str, report: &Report) {
        let Input::Said(before) = &mut self.input else { return };
        let mut sources = SourceMap::new();
        // The lines before this one are not kept: they are empty, so that it has its number.
        let file = sources.add("<stdin>", "\n".repeat(*before) + line);
        let place = sources.whole(file).part(*before, *before + line.len());
        *before += 1;
        let mut diagnostics = Diagnostics::new();
        let step = self.step(line, place, &mut diagnostics);
        self.steps.extend(step.filter(|_| !diagnostics.has_errors()));
        report.show(&diagnostics, &sources);
    }

    /// The next command.
    pub(super) fn next(&mut self) -> Option<Step> {
        self.steps.pop_front()
    }

    /// Reads a line; `None` also where there is nothing on it.
    fn step(&self, line: &str, place: Span, diagnostics: &mut Diagnostics) -> Option<Step> {
        let (first, rest) = word(Part { text: line, place });
        if first.text.is_empty() || first.text.starts_with('#') {
            return None;
        }
        let read = if first.text == "wait" {
            seconds(trimmed(rest)).map(Step::Wait).map(Some)
        } else {
            self.act(first, rest, diagnostics)
        };
        read.unwrap_or_else(|diagnostic| {
            diagnostics.push(*diagnostic);
            None
        })
    }

    fn act(
        &self,
        first: Part<'_>,
        rest: Part<'_>,
        diagnostics: &mut Diagnostics,
    ) -> Result<Option<Step>, Box<Diagnostic>> {
        let id = integer(first.text).ok().and_then(|number| u8::try_from(number).ok());
        let Some(id) = id else {
            let message = format!("found `{}`, expected a node-ID or `wait`", first.text);
            return Err(refusal(codes::BAD_NOTATION, first, message, COMMANDS));
        };
        let mut nodes = self.nodes.iter().enumerate();
        let Some((at, (_, system, device))) = nodes.find(|(_, (node, ..))| *node == id) else {
            let ids: Vec<String> = self.nodes.iter().map(|(id, ..)| id.to_string()).collect();
            let help = format!("the node-IDs are {}", ids.join(", "));
            return Err(refusal(codes::BAD_NODE_ID, first, format!("no node {id} is served"), help));
        };
        let (verb, rest) = word(rest);
        let rest = trimmed(rest);
        let act = match verb.text {
            "fault" => Some(Act::Fault(emergency(system, device, error_code(rest)?))),
            "clear" => Some(Act::Clear(error_code(rest)?)),
            "set" => set(device, id, rest, diagnostics),
            "stop" => Some(Act::Stop(entry(device, rest)?)),
            other => {
                if let Some((_, shape)) = Shape::ALL.into_iter().find(|(word, _)| *word == other) {
                    let course = course(device, id, shape, rest, diagnostics)?;
                    return Ok(course.map(|course| Step::Act { at, act: Act::Go(course) }));
                }
                let help = match nearest(other, VERBS) {
                    Some(verb) => format!("did you mean `{verb}`?"),
                    None => COMMANDS.to_owned(),
                };
                let message = format!("found {}, expected {}", quoted(other), list(&VERBS));
                return Err(refusal(codes::UNKNOWN_WORD, verb, message, help));
            }
        };
        Ok(act.map(|act| Step::Act { at, act }))
    }
}

/// An error of a device, with the bits of the error register that are stated for it, or else those of its class.
fn emergency(system: &model::System, device: &model::Dictionary, code: u16) -> Emergency {
    let emergency = Emergency::new(code);
    let stated = |error: &&ErrorCode| error.code == code && error.devices.includes(&device.key);
    match system.errors.iter().find(stated) {
        Some(error) => emergency.with_register(ErrorRegister::from_bits(error.register())),
        None => emergency,
    }
}

/// `6064.0=12.34°`, as a setting of a DCF; what a client may write does not matter.
fn set(
    device: &model::Dictionary,
    node: u8,
    setting: Part<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Act> {
    let text = Spanned::new(setting.text.to_owned(), setting.place);
    let declared = settings(&[text], diagnostics).into_iter().next()?;
    let (id, value) = SettingNames::of(device).read_one(node, &declared, diagnostics)?;
    let entry = device.entry(id)?;
    let name = format!("{id} ({})", device.entry_name(id).unwrap_or_default());
    let Some(value) = value.bytes_for(entry.data_type, node) else {
        diagnostics.push(*refusal(
            codes::BAD_ASSIGNMENT,
            setting,
            format!("{name} has no value that can be written here"),
            "set an entry that holds a number or a text",
        ));
        return None;
    };
    Some(Act::Set { entry: EntryId { index: id.index.0, sub: id.sub.0 }, value, name })
}

/// `6064.0=0.00°..90.00° in 10`.
fn course(
    device: &model::Dictionary,
    node: u8,
    shape: Shape,
    part: Part<'_>,
    diagnostics: &mut Diagnostics,
) -> Result<Option<Course>, Box<Diagnostic>> {
    let (before, time) = last_word(part);
    let (values, between) = last_word(before);
    if between.text != "in" {
        let message = format!("found {}, expected two values, `in` and a time", quoted(part.text));
        return Err(refusal(codes::BAD_NOTATION, part, message, COURSES));
    }
    let seconds =
        seconds_of(time).filter(|time| !time.is_zero() && *time <= course::LONGEST).ok_or_else(|| {
            let message = format!("found {}, expected a number of seconds", quoted(time.text));
            let help = format!("it is more than 0, and at most {}", course::LONGEST.as_secs());
            refusal(codes::BAD_NOTATION, time, message, help)
        })?;
    let ends = values.text.split_once('=').and_then(|(entry, both)| {
        let (from, to) = both.split_once("..")?;
        Some((entry, from.trim_end(), to.trim_start()))
    });
    let Some((name, from, to)) = ends.filter(|(_, from, to)| !from.trim().is_empty() && !to.is_empty())
    else {
        let message = format!("found {}, expected an entry and two values", quoted(values.text));
        return Err(refusal(codes::BAD_NOTATION, values, message, COURSES));
    };
    // Each value is where it is written: the first one after its entry, the second one at the end.
    let first = Spanned::new(format!("{name}={from}"), values.place.part(0, name.len() + 1 + from.len()));
    let second = format!("{name}={to}");
    let start = values.text.len().saturating_sub(second.len());
    let second = Spanned::new(second, values.place.part(start, values.text.len()));
    let names = SettingNames::of(device);
    let mut read = |text: Spanned<String>| {
        let declared = settings(&[text], diagnostics).into_iter().next()?;
        names.read_one(node, &declared, diagnostics)
    };
    let Some((id, from)) = read(first) else { return Ok(None) };
    let Some((_, to)) = read(second) else { return Ok(None) };
    let Some(entry) = device.entry(id) else { return Ok(None) };
    let name = format!("{id} ({})", device.entry_name(id).unwrap_or_default());
    let place = EntryId { index: id.index.0, sub: id.sub.0 };
    let of_type = |value: &Value| value.bytes_for(entry.data_type, node).is_some();
    let course = Course::new(place, name.clone(), entry.data_type, shape, (&from, &to), seconds)
        .filter(|_| of_type(&from) && of_type(&to));
    course.map(Some).ok_or_else(|| {
        let message = format!("{name} has no values between these two");
        refusal(
            codes::BAD_ASSIGNMENT,
            values,
            message,
            "name an entry that holds a number, and two numbers of its type",
        )
    })
}

/// An entry by index or name.
fn entry(device: &model::Dictionary, part: Part<'_>) -> Result<EntryId, Box<Diagnostic>> {
    let id = SettingNames::of(device).entry(part.text).ok_or_else(|| {
        let message = format!("found {}, expected an entry of `{}`", quoted(part.text), device.key);
        refusal(codes::UNKNOWN_ENTRY, part, message, "name it as `5 set` does: `6064.0`, or by its name")
    })?;
    Ok(EntryId { index: id.index.0, sub: id.sub.0 })
}

/// The code of an error, which is not "no error".
fn error_code(word: Part<'_>) -> Result<u16, Box<Diagnostic>> {
    let code = integer(word.text).ok().and_then(|number| u16::try_from(number).ok());
    code.filter(|code| *code != ErrorCode::NONE).ok_or_else(|| {
        let message = format!("found {}, expected the code of an error", quoted(word.text));
        refusal(codes::BAD_NOTATION, word, message, "write a code from 0x0001 to 0xFFFF, such as `0x8611`")
    })
}

/// `1.5`.
fn seconds(word: Part<'_>) -> Result<Duration, Box<Diagnostic>> {
    seconds_of(word).ok_or_else(|| {
        let message = format!("found {}, expected a number of seconds", quoted(word.text));
        refusal(codes::BAD_NOTATION, word, message, "write `wait 1.5` to wait for one and a half seconds")
    })
}

fn seconds_of(word: Part<'_>) -> Option<Duration> {
    let is_plain = word.text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    let time = word.text.parse().ok().filter(|_| is_plain)?;
    Duration::try_from_secs_f64(time).ok()
}

/// `` `a`, `b` or `c` ``.
fn list(words: &[&str]) -> String {
    let quoted: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
    match quoted.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} or {last}", others.join(", ")),
        None => String::new(),
    }
}

/// What was found, also where that is nothing.
fn quoted(text: &str) -> String {
    if text.is_empty() { "nothing".to_owned() } else { format!("`{text}`") }
}

fn refusal(
    code: &'static od_spec::diag::Code,
    part: Part<'_>,
    message: String,
    help: impl Into<String>,
) -> Box<Diagnostic> {
    Box::new(Diagnostic::new(code, part.place, message).help(help.into()))
}

/// A part of a line.
#[derive(Debug, Clone, Copy)]
struct Part<'a> {
    text: &'a str,
    place: Span,
}

/// A part without the spaces around it.
fn trimmed(part: Part<'_>) -> Part<'_> {
    let text = part.text.trim_start();
    let start = part.text.len() - text.len();
    let text = text.trim_end();
    Part { text, place: part.place.part(start, start + text.len()) }
}

/// The first word, and what follows it.
fn word(part: Part<'_>) -> (Part<'_>, Part<'_>) {
    let part = trimmed(part);
    let end = part.text.find(char::is_whitespace).unwrap_or(part.text.len());
    let (first, rest) = part.text.split_at(end);
    let place = part.place;
    (
        Part { text: first, place: place.part(0, end) },
        Part { text: rest, place: place.part(end, part.text.len()) },
    )
}

/// What is before the last word, and that.
fn last_word(part: Part<'_>) -> (Part<'_>, Part<'_>) {
    let part = trimmed(part);
    let start = part.text.rfind(char::is_whitespace).map_or(0, |at| {
        at + part.text.get(at..).and_then(|rest| rest.chars().next()).map_or(1, char::len_utf8)
    });
    let (before, last) = part.text.split_at(start);
    let place = part.place;
    (
        trimmed(Part { text: before, place: place.part(0, start) }),
        Part { text: last, place: place.part(start, part.text.len()) },
    )
}
