//! PDOs of a generated dictionary with any values, for tools that read frames by a description: `pdo-frames fullmo|pmc|pmm`.
//!
//! Each entry that can be mapped is in some mapping. A line of standard output is a frame: the direction, the mapping,
//! the data, and the bytes that the dictionary has for each entry – those that were packed, or those that it kept of
//! what it received – as `transmit 60410010,60640020 27120000E803 2712,0000E803`, all in hexadecimal.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command talks to its user")]

use std::process::ExitCode;

use firmware_glue::Dictionary;
use firmware_glue::pdo::{pack, unpack};
use firmware_glue::table::{Place, Row};
use od_generated::{fullmo::Fullmo, pmc::Pmc, pmm::Pmm};

const NODE: u8 = 5;
/// Frames for each mapping.
const FRAMES: usize = 24;
/// The mapping of the first PDO holds no more, nor does a frame of 64 bits.
const MOST_ENTRIES: usize = 8;

fn main() -> ExitCode {
    let device = std::env::args().nth(1);
    let is_done = match device.as_deref() {
        Some("fullmo") => frames(|| Fullmo::new(NODE)),
        Some("pmc") => frames(|| Pmc::new(NODE)),
        Some("pmm") => frames(|| Pmm::new(NODE)),
        _ => None,
    };
    if is_done.is_none() {
        eprintln!("usage: pdo-frames fullmo|pmc|pmm");
        return ExitCode::from(2);
    }
    ExitCode::SUCCESS
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Direction {
    Transmit,
    Receive,
}

/// An entry as a mapping has it.
#[derive(Clone, Copy)]
struct Mapped {
    row: Row,
    parameter: u32,
    bytes: usize,
}

fn frames<D: Dictionary<'static>>(new: impl Fn() -> D) -> Option<()> {
    let mut random = 0x9E37_79B9_7F4A_7C15_u64;
    for direction in [Direction::Transmit, Direction::Receive] {
        for mapping in mappings(&new(), direction) {
            let mut dictionary = new();
            map(&mut dictionary, direction, &mapping)?;
            for _ in 0..FRAMES {
                match direction {
                    Direction::Transmit => sent(&mut dictionary, &mapping, &mut random)?,
                    Direction::Receive => taken(&mut dictionary, &mapping, &mut random)?,
                }
            }
        }
    }
    Some(())
}

/// Every entry that can be mapped and has a value in the image, in groups that fit into a frame.
fn mappings<D: Dictionary<'static>>(dictionary: &D, direction: Direction) -> Vec<Vec<Mapped>> {
    let table = dictionary.table();
    let mut groups: Vec<Vec<Mapped>> = Vec::new();
    for number in 0..table.parts().entries.len() {
        let Some(entry) = u16::try_from(number).ok().and_then(|number| dictionary.entry(number)) else {
            continue;
        };
        let row = dictionary.row(entry);
        let info = dictionary.info(entry);
        let is_mapped = match direction {
            Direction::Transmit => info.is_transmittable() && table.attributes(row).place == Place::Image,
            Direction::Receive => info.is_receivable() && info.is_readable() && !info.is_locked(),
        };
        let bytes = usize::from(info.size());
        if !is_mapped || bytes > 8 {
            continue;
        }
        let id = info.id();
        let bits =
            if info.data_type() == firmware_glue::DataType::Boolean { 1 } else { 8 * u32::from(info.size()) };
        let parameter = u32::from(id.index) << 16 | u32::from(id.sub) << 8 | bits;
        let fits = groups.last().is_some_and(|group| {
            let used: u32 = group.iter().map(|mapped| mapped.parameter & 0xFF).sum();
            used + bits <= 64 && group.len() < MOST_ENTRIES
        });
        if !fits {
            groups.push(Vec::new());
        }
        if let Some(group) = groups.last_mut() {
            group.push(Mapped { row, parameter, bytes });
        }
    }
    groups
}

/// Maps by the procedure of CiA 301 7.5.2.36.
fn map<D: Dictionary<'static>>(dictionary: &mut D, direction: Direction, mapping: &[Mapped]) -> Option<()> {
    let (communication, cob_id) = match direction {
        Direction::Transmit => (0x1800, 0x180 + u32::from(NODE)),
        Direction::Receive => (0x1400, 0x200 + u32::from(NODE)),
    };
    let mut write = |index: u16, sub: usize, bytes: &[u8]| {
        let written = dictionary.write(index, u8::try_from(sub).ok()?, bytes, &mut ());
        if let Err(code) = written {
            eprintln!("{index:04X}h.{sub}: {code}");
        }
        written.ok()
    };
    write(communication, 1, &(1 << 31 | cob_id).to_le_bytes())?;
    write(communication + 0x200, 0, &[0])?;
    for (sub, mapped) in (1..).zip(mapping) {
        write(communication + 0x200, sub, &mapped.parameter.to_le_bytes())?;
    }
    write(communication + 0x200, 0, &[u8::try_from(mapping.len()).ok()?])?;
    write(communication, 1, &cob_id.to_le_bytes())?;
    Some(())
}

/// Packs any values, as the device may have them.
fn sent<D: Dictionary<'static>>(dictionary: &mut D, mapping: &[Mapped], random: &mut u64) -> Option<()> {
    for mapped in mapping {
        let value = next(random).to_le_bytes();
        // A BOOLEAN has no other values.
        let value = if mapped.parameter & 0xFF == 1 { [value[0] & 1; 8] } else { value };
        let table = dictionary.table();
        let low = usize::from(table.parts().entries.get(usize::from(mapped.row))?.place);
        let place = usize::from(table.attributes(mapped.row).page) << 16 | low;
        dictionary
            .image_mut()
            .get_mut(place..place + mapped.bytes)?
            .copy_from_slice(value.get(..mapped.bytes)?);
    }
    let frame = pack(dictionary, 1, &mut ()).ok()?;
    show(dictionary, "transmit", mapping, &frame)
}

/// Takes any values; an entry keeps what it had where its limits refuse one, and the frame is one with what all of them have.
fn taken<D: Dictionary<'static>>(dictionary: &mut D, mapping: &[Mapped], random: &mut u64) -> Option<()> {
    // Small numbers are within more limits than any.
    let shift = next(random) % 60;
    let _ = unpack(dictionary, 1, &(next(random) >> shift).to_le_bytes(), &mut ()).ok()?;
    let (mut frame, mut first) = (0_u64, 0);
    for mapped in mapping {
        let bits = mapped.parameter & 0xFF;
        let entry = dictionary.entry(mapped.row)?;
        let id = dictionary.info(entry).id();
        let value = dictionary.read(id.index, id.sub).ok()?;
        let mut wide = [0; 8];
        wide.get_mut(..mapped.bytes)?.copy_from_slice(value.bytes());
        frame |= u64::from_le_bytes(wide) << first;
        first += bits;
    }
    let frame = frame.to_le_bytes();
    let frame = frame.get(..usize::try_from(first.div_ceil(8)).ok()?)?;
    show(dictionary, "receive", mapping, frame)
}

fn show<D: Dictionary<'static>>(
    dictionary: &D,
    direction: &str,
    mapping: &[Mapped],
    frame: &[u8],
) -> Option<()> {
    let hexadecimal =
        |bytes: &[u8]| bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().concat();
    let mut values = Vec::new();
    for mapped in mapping {
        let id = dictionary.info(dictionary.entry(mapped.row)?).id();
        values.push(hexadecimal(dictionary.read(id.index, id.sub).ok()?.bytes()));
    }
    let parameters: Vec<String> = mapping.iter().map(|mapped| format!("{:08X}", mapped.parameter)).collect();
    println!("{direction} {} {} {}", parameters.join(","), hexadecimal(frame), values.join(","));
    Some(())
}

/// The next of a sequence that is the same in every run (xorshift64*).
fn next(state: &mut u64) -> u64 {
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    state.wrapping_mul(0x2545_F491_4F6C_DD1D)
}
