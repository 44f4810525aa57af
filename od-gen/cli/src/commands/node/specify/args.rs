//! Arguments of a specification that is made from a node.

use std::ops::RangeInclusive;
use std::path::PathBuf;

use clap::Args;

#[derive(Debug, Args)]
pub(crate) struct SpecifyArgs {
    /// Write a first specification of one node into this file: from the EDS that the node has stored (1021h), or else from the
    /// objects that answer. Nothing is written to the node
    #[arg(long, value_name = "FILE")]
    pub write_spec: Option<PathBuf>,

    /// The node of the specification, 1 to 127 [default: the only one that answers]
    #[arg(long, value_name = "ID", requires = "write_spec")]
    pub node: Option<String>,

    /// Ask for these objects besides 1000h..1FFFh, and not for a stored EDS; can be given several times [default: 2000h..9FFFh]
    #[arg(long, value_name = "FIRST..LAST", requires = "write_spec", value_parser = range)]
    pub range: Vec<RangeInclusive<u16>>,

    /// Replace the file
    #[arg(long, requires = "write_spec")]
    pub force: bool,
}

/// `2000h..5FFFh`, `0x2000..0x5FFF`, `2000`.
fn range(text: &str) -> Result<RangeInclusive<u16>, String> {
    let (first, last) = text.split_once("..").unwrap_or((text, text));
    index(first)
        .zip(index(last))
        .filter(|(first, last)| first <= last)
        .map(|(first, last)| first..=last)
        .ok_or_else(|| "expected indices from 1000h to FFFFh, such as `2000h..5FFFh`".to_owned())
}

/// An index, which is hexadecimal in any notation.
fn index(text: &str) -> Option<u16> {
    let text = text.trim();
    let digits = text.strip_prefix("0x").or_else(|| text.strip_suffix(['h', 'H'])).unwrap_or(text);
    let is_plain = digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    u16::from_str_radix(digits, 16).ok().filter(|index| is_plain && *index >= 0x1000)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_hexadecimal_in_every_notation() {
        for text in ["2000h..5FFFh", "0x2000..0x5fff", "2000 .. 5fff"] {
            assert_eq!(range(text), Ok(0x2000..=0x5FFF), "{text}");
        }
        assert_eq!(range("6040"), Ok(0x6040..=0x6040));
        for text in ["", "5000..2000", "0..100", "2000..", "12000..13000", "+200..300", "2000-5FFF"] {
            assert!(range(text).is_err(), "{text}");
        }
    }
}
