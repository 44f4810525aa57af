//! `odgen node program`: loads a program into a node (CiA 302-3).

mod download;
mod failure;

use std::fmt::Write as _;
use std::path::Path;

use od_bus::client::{Bus, Client};
use od_bus::program::{CONTROL, DATA, FLASH, IDENTIFICATION, State};
use od_gen::source::reason;
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::{EntryId, Index, SubIndex};

use self::download::Download;
use super::args::NodeProgramArgs;
use super::{Described, Target, reach};
use crate::exit::INTERRUPTED;
use crate::interrupt::Interrupt;
use crate::report::{Report, print, shown};

/// Stops a program of a node, deletes it, loads another one, and starts that.
pub(super) fn program(args: &NodeProgramArgs, report: &Report) -> Result<u8, u8> {
    let described = Described::read(&args.spec, &args.node, report)?;
    let target = described.target(&args.node, None, report)?;
    let places = Places::of(target, args.program).map_err(|diagnostic| report.refuse(diagnostic))?;
    let data = data(&args.file).map_err(|diagnostic| report.refuse(diagnostic))?;
    let mut client = reach(&args.node, target, report)?;
    let before = number(&mut client, target, places.identification, report)?;
    let running = number(&mut client, target, Some(places.control), report)?.and_then(state);
    let about = preview(args, target, places, data.len(), (before, running));
    let question = format!("load program {} of {}", args.program, target.name());
    let interrupt = Interrupt::noted_with_hangup();
    args.confirm.ask(&about, &question, &interrupt, report)?;
    let mut download = Download::new(&mut client, target, places, args, &interrupt, report);
    if let Err(failure) = download.carry_out(&data) {
        let is_interrupted = failure.is_interrupt();
        let code = report.refuse(download.reported(&failure));
        return Err(if is_interrupted { INTERRUPTED } else { code });
    }
    let code = print(&format!("{}: program {} is loaded\n", target.name(), args.program));
    let reported = number(&mut client, target, Some(places.control), report).and_then(|running| {
        Ok((running.and_then(state), number(&mut client, target, places.identification, report)?))
    });
    let (running, after) = reported.map_err(|failed| code.max(failed))?;
    let id = places.control;
    let mut text = format!("    {id}: {}\n", state_in_words(running));
    if let Some(id) = places.identification {
        let word = |number: Option<u32>| number.map_or("unknown".to_owned(), |one| format!("0x{one:08X}"));
        let _ = writeln!(text, "    {id}: {} → {}", word(before), word(after));
    }
    report.note(&format!(
        "the node may be pre-operational: `odgen node nmt start --node {}` makes it operational",
        target.id
    ));
    Ok(code.max(print(&text)))
}

/// The entries of a program.
#[derive(Debug, Clone, Copy)]
struct Places {
    data: EntryId,
    control: EntryId,
    /// Where the device has it.
    identification: Option<EntryId>,
    /// Where the device has it.
    flash: Option<EntryId>,
}

impl Places {
    fn of(target: Target<'_>, program: u8) -> Result<Self, Diagnostic> {
        let place = |index| EntryId { index: Index(index), sub: SubIndex(program) };
        let known = |index| Some(place(index)).filter(|id| target.device.entry(*id).is_some());
        let needed = |index| {
            known(index).ok_or_else(|| {
                let (key, id) = (&target.device.key, place(index));
                let message = format!("`{key}` has no program {program}: there is no {id}");
                let help = "a device takes programs where its specification has 1F50h and 1F51h; `--program N` chooses one";
                Diagnostic::without_place(codes::UNKNOWN_ENTRY, message).help(help)
            })
        };
        let (data, control) = (needed(DATA)?, needed(CONTROL)?);
        Ok(Self { data, control, identification: known(IDENTIFICATION), flash: known(FLASH) })
    }
}

/// The bytes of a program.
fn data(file: &Path) -> Result<Vec<u8>, Diagnostic> {
    let refused = |why: &str, help: &str| {
        let message = format!("cannot load {}: {why}", shown(file));
        Diagnostic::without_place(codes::UNREADABLE, message).help(help)
    };
    let data = std::fs::read(file).map_err(|error| refused(&reason(&error), "check the path"))?;
    let help = "name the file that the maker of the device provides for program download";
    match u32::try_from(data.len()) {
        Ok(0) => Err(refused("the file is empty", help)),
        Ok(_) => Ok(data),
        Err(_) => Err(refused("the file has 4 GiB or more", help)),
    }
}

/// A number that a node has, where it reports one.
fn number<B: Bus>(
    client: &mut Client<B>,
    target: Target<'_>,
    id: Option<EntryId>,
    report: &Report,
) -> Result<Option<u32>, u8> {
    let Some(id) = id else { return Ok(None) };
    match target.read(client, id) {
        Ok(bytes) => Ok(little_endian(&bytes)),
        Err(error) if error.is_of_entry() => Ok(None),
        Err(error) => Err(report.refuse(target.failed("read", id, &error))),
    }
}

fn little_endian(bytes: &[u8]) -> Option<u32> {
    let is_number = (1..=4).contains(&bytes.len());
    is_number.then(|| bytes.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte)))
}

/// What a number in 1F51h says.
fn state(number: u32) -> Option<State> {
    u8::try_from(number).ok().map(State::of)
}

/// `stopped`; `unknown` where the node does not report it.
fn state_in_words(state: Option<State>) -> String {
    state.map_or_else(|| "unknown".to_owned(), |state| state.to_string())
}

/// What is about to be done.
fn preview(
    args: &NodeProgramArgs,
    target: Target<'_>,
    places: Places,
    length: usize,
    (identification, state): (Option<u32>, Option<State>),
) -> String {
    let (name, program, file) = (target.name(), args.program, shown(&args.file));
    let mut text = format!("{name}: program {program} is replaced with {file} ({length} bytes)\n");
    let _ = writeln!(text, "    now: {}, {}", state_in_words(state), identity(places, identification));
    let _ = writeln!(
        text,
        "    the node becomes pre-operational; its program is stopped, deleted, loaded and started"
    );
    let _ = writeln!(text, "    if loading fails, the node has no program until one is loaded");
    if places.flash.is_none() {
        let _ =
            writeln!(text, "    the device has no 1F57h: whether it has written the program is not known");
    }
    text
}

/// `1F56h.1 = 0x0000002A`.
fn identity(places: Places, identification: Option<u32>) -> String {
    match (places.identification, identification) {
        (None, _) => "the device has no 1F56h, which identifies programs".to_owned(),
        (Some(id), None) => format!("{id} cannot be read"),
        (Some(id), Some(number)) => format!("{id} = 0x{number:08X}"),
    }
}
