//! The messages as pages of the book.

use std::fmt::Write as _;

use od_spec::all_codes;
use od_spec::diag::Code;

use crate::explain::explained;
use crate::page::{NOTICE, Page};

/// How the codes of an area begin, and what the area is called.
static AREAS: [(&str, &str); 19] = [
    ("OD01", "Files and YAML"),
    ("OD02", "Keys and notations"),
    ("OD03", "Names and references"),
    ("OD04", "Values and types"),
    ("OD05", "PDOs and COB-IDs"),
    ("OD06", "Devices, state machines and constraints"),
    ("OD07", "Nodes, parameter files and plants"),
    ("OD08", "Warnings and notes about specifications"),
    ("OD09", "Generated code"),
    ("EDS1", "The text of an EDS or DCF"),
    ("EDS2", "Information about file and device in an EDS"),
    ("EDS3", "Lists of objects in an EDS"),
    ("EDS4", "Objects in an EDS"),
    ("EDS5", "Values in an EDS"),
    ("EDS6", "Modules in an EDS"),
    ("EDS7", "The node of a DCF"),
    ("EDS8", "What readers of EDS files refuse"),
    ("XDD1", "The XML of an XDD or XDC"),
    ("XDD2", "Objects in an XDD or XDC"),
];

/// The pages of the messages: a table of all of them, and one page for each, with the text of `odgen explain`.
pub fn message_pages() -> Vec<Page> {
    let codes = all_codes();
    let index = Page { file: "index.md".to_owned(), text: index(&codes) };
    [index].into_iter().chain(codes.into_iter().map(page)).collect()
}

fn page(code: &Code) -> Page {
    Page { file: format!("{code}.md"), text: format!("# {}\n{NOTICE}\n", explained(code)) }
}

fn index(codes: &[&Code]) -> String {
    let mut out = String::from(
        "# Messages\n\nEvery message of the compiler has a stable code. `odgen explain CODE` prints the page of a code.\n",
    );
    for (begin, title) in AREAS {
        let _ = write!(out, "\n## {title}\n\n| Code | Severity | Message |\n| --- | --- | --- |\n");
        for code in codes.iter().filter(|code| code.id.starts_with(begin)) {
            let _ = writeln!(out, "| [{code}]({code}.md) | {} | {} |", code.severity.word(), code.title);
        }
    }
    let _ = write!(out, "\n{NOTICE}\n");
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_is_in_one_area_and_every_area_has_codes() {
        let codes = all_codes();
        for code in &codes {
            assert_eq!(AREAS.iter().filter(|(begin, _)| code.id.starts_with(begin)).count(), 1, "{code}");
        }
        for (begin, _) in AREAS {
            assert!(codes.iter().any(|code| code.id.starts_with(begin)), "{begin}");
        }
    }
}
