//! LSS (CiA 305): what the master asks, and what slaves answer. The command is the same in both.

use firmware_glue::lss::BitRate;

use super::node::{count, hexadecimal};

/// What four bytes of an LSS frame can be.
const NUMBERS: [&str; 4] = ["vendor-ID", "product code", "revision number", "serial number"];

/// What the master says (7E5h).
pub(super) fn request(bytes: &[u8]) -> String {
    let Ok([command, data @ ..]) = <[u8; 8]>::try_from(bytes) else { return wrong_length(bytes) };
    let [first, second, ..] = data;
    match command {
        4 => match first {
            0 => "switch all to waiting".to_owned(),
            1 => "switch all to configuration".to_owned(),
            other => format!("switch all to the unknown mode {other}"),
        },
        17 if first == 255 => "set no node-ID (255)".to_owned(),
        17 => format!("set node-ID {first}"),
        19 => format!("set {}", bit_timing(first, second)),
        21 => {
            format!("activate bit timing, with {} ms before and after", u16::from_le_bytes([first, second]))
        }
        23 => "store node-ID and bit timing".to_owned(),
        64..=67 => format!("switch one: {}", number(command - 64, data)),
        70 => format!("identify: {}", number(0, data)),
        71 => format!("identify: {}", number(1, data)),
        72 => format!("identify: lowest {}", number(2, data)),
        73 => format!("identify: highest {}", number(2, data)),
        74 => format!("identify: lowest {}", number(3, data)),
        75 => format!("identify: highest {}", number(3, data)),
        76 => "identify slaves that are not configured".to_owned(),
        81 => fastscan(data),
        90..=93 => format!("ask for the {}", NUMBERS[usize::from(command - 90)]),
        94 => "ask for the node-ID".to_owned(),
        other => format!("unknown command {other}: {}", hexadecimal(&data)),
    }
}

/// What a slave says (7E4h).
pub(super) fn answer(bytes: &[u8]) -> String {
    let Ok([command, data @ ..]) = <[u8; 8]>::try_from(bytes) else { return wrong_length(bytes) };
    let [first, second, ..] = data;
    let result = |done: &str, refused: &[(u8, &str)]| match first {
        0 => done.to_owned(),
        255 => format!("refused for a reason of the maker, {second}"),
        code => match refused.iter().find(|(of, _)| *of == code) {
            Some((_, why)) => (*why).to_owned(),
            None => format!("refused: unknown error {code}"),
        },
    };
    match command {
        17 => result("node-ID taken", &[(1, "node-ID refused: out of range")]),
        19 => result("bit timing taken", &[(1, "bit timing refused: not supported")]),
        23 => result(
            "stored",
            &[(1, "not stored: storing is not supported"), (2, "not stored: the memory cannot be reached")],
        ),
        68 => "switched to configuration".to_owned(),
        79 => "identified".to_owned(),
        80 => "identified, not configured".to_owned(),
        90..=93 => number(command - 90, data),
        94 if first == 255 => "no node-ID (255)".to_owned(),
        94 => format!("node-ID {first}"),
        other => format!("unknown answer {other}: {}", hexadecimal(&data)),
    }
}

fn wrong_length(bytes: &[u8]) -> String {
    format!("{} where LSS has 8", count(bytes.len()))
}

/// `product code 0x00000007`; `of` counts from the vendor-ID.
fn number(of: u8, [a, b, c, d, ..]: [u8; 7]) -> String {
    let name = NUMBERS.get(usize::from(of)).copied().unwrap_or("number");
    format!("{name} 0x{:08X}", u32::from_le_bytes([a, b, c, d]))
}

/// `bit timing 500 kbit/s`. Tables other than the first one are the maker's.
fn bit_timing(table: u8, entry: u8) -> String {
    match BitRate::of_index(entry).filter(|_| table == 0).map(BitRate::kbits) {
        Some(Some(kbits)) => format!("bit timing {kbits} kbit/s"),
        Some(None) => "bit timing by itself".to_owned(),
        None => format!("bit timing: table {table}, entry {entry}"),
    }
}

/// A step of Fastscan: slaves answer whose number has these bits, from the highest one down to the one that is checked.
fn fastscan(data: [u8; 7]) -> String {
    let [_, _, _, _, bit, of, next] = data;
    let next = NUMBERS.get(usize::from(next)).copied().unwrap_or("an unknown number");
    match bit {
        128 => "Fastscan: begin anew".to_owned(),
        _ => format!("Fastscan: {}, down to bit {bit}; next {next}", number(of, data)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A frame that begins with these bytes.
    fn frame(bytes: &[u8]) -> Vec<u8> {
        let mut frame = bytes.to_vec();
        frame.resize(8, 0);
        frame
    }

    #[test]
    fn requests_and_answers_are_distinguished() {
        for (bytes, asked, answered) in [
            (&[17, 0][..], "set node-ID 0", "node-ID taken"),
            (&[17, 1], "set node-ID 1", "node-ID refused: out of range"),
            (&[17, 255, 7], "set no node-ID (255)", "refused for a reason of the maker, 7"),
            (&[19, 0, 2], "set bit timing 500 kbit/s", "bit timing taken"),
            (&[19, 0, 9], "set bit timing by itself", "bit timing taken"),
            (&[19, 1, 0], "set bit timing: table 1, entry 0", "bit timing refused: not supported"),
            (&[19, 0, 5], "set bit timing: table 0, entry 5", "bit timing taken"),
            (&[23], "store node-ID and bit timing", "stored"),
            (&[23, 1], "store node-ID and bit timing", "not stored: storing is not supported"),
            (&[23, 2], "store node-ID and bit timing", "not stored: the memory cannot be reached"),
            (&[23, 3], "store node-ID and bit timing", "refused: unknown error 3"),
            (&[91, 7], "ask for the product code", "product code 0x00000007"),
            (&[94, 5], "ask for the node-ID", "node-ID 5"),
            (&[94, 255], "ask for the node-ID", "no node-ID (255)"),
            (&[67, 1, 2], "switch one: serial number 0x00000201", "unknown answer 67: 01 02 00 00 00 00 00"),
            (&[68], "unknown command 68: 00 00 00 00 00 00 00", "switched to configuration"),
        ] {
            assert_eq!(
                (request(&frame(bytes)), answer(&frame(bytes))),
                (asked.to_owned(), answered.to_owned())
            );
        }
        assert_eq!([request(&[17, 5]), answer(&[])], ["2 bytes where LSS has 8", "0 bytes where LSS has 8"]);
        assert_eq!(request(&frame(&[21, 0xE8, 3])), "activate bit timing, with 1000 ms before and after");
    }

    #[test]
    fn a_step_of_fastscan_reports_bit_part_and_next() {
        let step = |bit, of, next| request(&[81, 0x34, 0x12, 0, 0, bit, of, next]);
        assert_eq!(step(128, 0, 0), "Fastscan: begin anew");
        assert_eq!(step(5, 0, 1), "Fastscan: vendor-ID 0x00001234, down to bit 5; next product code");
        assert_eq!(step(0, 3, 0), "Fastscan: serial number 0x00001234, down to bit 0; next vendor-ID");
        assert_eq!(step(0, 4, 9), "Fastscan: number 0x00001234, down to bit 0; next an unknown number");
    }
}
