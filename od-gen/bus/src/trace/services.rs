//! The services other than PDO and SDO: NMT, SYNC, TIME, EMCY, error control, LSS.

use od_formats::nmt;
use od_spec::model::{EntryId, ErrorCode, Index, SubIndex};

use super::node::{Node, count, hexadecimal};

/// NMT: a command for one node or all.
pub(super) fn nmt_command(command: u8) -> Option<&'static str> {
    nmt::word(&nmt::COMMANDS, command)
}

/// The state in a heartbeat or in the answer to node guarding.
pub(crate) fn state(byte: u8) -> String {
    let state = byte & 0x7F;
    nmt::word(&nmt::STATES, state).map_or_else(|| format!("unknown state {state}"), str::to_owned)
}

/// TIME (CiA 301 7.2.6): milliseconds after midnight, days since 1984-01-01.
pub(super) fn time(bytes: &[u8]) -> String {
    let parts = bytes.split_first_chunk::<4>();
    let parts = parts.and_then(|(milliseconds, days)| Some((milliseconds, <[u8; 2]>::try_from(days).ok()?)));
    let Some((milliseconds, days)) = parts else {
        return format!("{} where TIME has 6", count(bytes.len()));
    };
    let milliseconds = u32::from_le_bytes(*milliseconds) & 0x0FFF_FFFF;
    let days = u16::from_le_bytes(days);
    let (seconds, rest) = (milliseconds / 1000, milliseconds % 1000);
    let (hours, minutes) = (seconds / 3600, seconds / 60 % 60);
    format!("day {days} since 1984-01-01, {hours:02}:{minutes:02}:{:02}.{rest:03}", seconds % 60)
}

/// EMCY: error code, error register, five bytes of the maker.
pub(super) fn emergency(node: Option<&Node<'_>>, bytes: &[u8]) -> String {
    let Some((&[low, high, register], own)) = bytes.split_first_chunk() else {
        return format!("{} where EMCY has 8", count(bytes.len()));
    };
    let code = u16::from_le_bytes([low, high]);
    let known = node.and_then(|node| Some((node, error(node, code)?)));
    let mut text = match known {
        Some((node, error)) => {
            let about = error.about.get("en").map(first_sentence).filter(|about| !about.is_empty());
            let reset = error.reset_on(node.device).get("en").map(first_sentence);
            let mut text = format!("{code:04X}h {}", error.name);
            if let Some(about) = about {
                text.push_str(" – ");
                text.push_str(about);
            }
            if let Some(reset) = reset.filter(|reset| !reset.is_empty()) {
                text.push_str("; reset: ");
                text.push_str(reset);
            }
            text
        }
        None => format!("{code:04X}h ({})", class(code)),
    };
    let of_register = EntryId { index: Index(0x1001), sub: SubIndex(0) };
    let is_known = node.is_some_and(|node| node.device.entry(of_register).is_some());
    let register = match node.filter(|_| is_known) {
        Some(node) => node.value(of_register, &[register]),
        None => format!("0x{register:02X}"),
    };
    text.push_str("; error register ");
    text.push_str(&register);
    if own.iter().any(|byte| *byte != 0) {
        text.push_str("; of the maker ");
        text.push_str(&hexadecimal(own));
    }
    if bytes.len() != 8 {
        text.push_str("; ");
        text.push_str(&count(bytes.len()));
        text.push_str(" where EMCY has 8");
    }
    text
}

fn error<'a>(node: &Node<'a>, code: u16) -> Option<&'a ErrorCode> {
    node.system.errors.iter().find(|error| error.code == code && error.devices.includes(&node.device.key))
}

/// A line has no room for more; the documents have the rest.
fn first_sentence(text: &str) -> &str {
    let text = text.trim();
    let end = text.match_indices(['.', '\n']).map(|(at, _)| at).find(|at| {
        text.get(at + 1..).is_none_or(|behind| behind.is_empty() || behind.starts_with([' ', '\n']))
    });
    text.get(..end.unwrap_or(text.len())).unwrap_or(text)
}

/// What CiA 301 says of a code that the device does not list.
fn class(code: u16) -> &'static str {
    match code {
        0x0000..=0x00FF => "no error",
        0x1000..=0x10FF => "generic error",
        0x2000..=0x2FFF => "current",
        0x3000..=0x3FFF => "voltage",
        0x4000..=0x4FFF => "temperature",
        0x5000..=0x50FF => "hardware of the device",
        0x6000..=0x6FFF => "software of the device",
        0x7000..=0x70FF => "additional modules",
        0x8110 => "CAN overrun",
        0x8120 => "CAN controller error passive",
        0x8130 => "life guard or heartbeat error",
        0x8140 => "recovered from bus off",
        0x8150 => "CAN-ID collision",
        0x8210 => "PDO too short",
        0x8220 => "PDO too long",
        0x8240 => "unexpected length of SYNC",
        0x8250 => "RPDO timeout",
        0x8100..=0x81FF => "communication",
        0x8200..=0x82FF => "protocol error",
        0x8000..=0x80FF => "monitoring",
        0x9000..=0x90FF => "external error",
        0xF000..=0xF0FF => "additional functions",
        0xFF00..=0xFFFF => "of the device",
        _ => "a code that CiA 301 does not define",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_is_shown_by_day_and_hour() {
        assert_eq!(time(&[0xE0, 0x93, 0x04, 0x00, 2, 1]), "day 258 since 1984-01-01, 00:05:00.000");
        assert_eq!(time(&[0]), "1 byte where TIME has 6");
    }

    #[test]
    fn a_sentence_ends_after_its_point() {
        assert_eq!(first_sentence("24.5 V are too low. Charge."), "24.5 V are too low");
        assert_eq!(first_sentence("no point"), "no point");
    }
}
