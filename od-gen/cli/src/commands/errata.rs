//! `odgen errata`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::{Devices, Erratum, ErratumKind, ErratumPlace, Index, System, Text};

use crate::exit::ERRORS;
use crate::messages::Messages;
use crate::report::{Report, print};
use crate::specs;

#[derive(Debug, Args)]
pub(crate) struct ErrataArgs {
    /// The specification, EDS, DCF, XDD or XDC [default: the only `*.od.yaml` of the current directory]
    pub spec: Option<PathBuf>,

    /// Only this kind of fact, such as `access` or `gap`
    #[arg(long, value_name = "KIND")]
    pub kind: Option<String>,

    /// Only this object, such as 6041 (hexadecimal)
    #[arg(long, value_name = "INDEX")]
    pub at: Option<String>,

    /// As Markdown
    #[arg(long)]
    pub markdown: bool,

    #[command(flatten)]
    pub messages: Messages,
}

pub(crate) fn run(args: &ErrataArgs, directory: &Path, report: &Report) -> u8 {
    let kind = match args.kind.as_deref().map(|word| (word, ErratumKind::from_word(word))) {
        Some((word, None)) => {
            return report.refuse(
                Diagnostic::without_place(codes::UNKNOWN_WORD, format!("there is no kind `{word}`"))
                    .help(format!("kinds are {}", ErratumKind::WORDS.join(", "))),
            );
        }
        Some((_, kind)) => kind,
        None => None,
    };
    let at = match args.at.as_deref().map(|text| (text, index(text))) {
        Some((text, None)) => {
            return report.refuse(
                Diagnostic::without_place(codes::BAD_NOTATION, format!("found `{text}`, expected an index"))
                    .help("write it in hexadecimal: `6041`, `0x6041` or `6041h`"),
            );
        }
        Some((_, index)) => index,
        None => None,
    };
    let spec = match specs::one(args.spec.as_deref(), directory, report) {
        Ok(spec) => spec,
        Err(code) => return code,
    };
    let Some(system) = report.compile(&spec) else { return ERRORS };
    let wanted = |erratum: &&Erratum| {
        kind.is_none_or(|kind| kind == erratum.kind)
            && at.is_none_or(|index| erratum.at.iter().any(|place| place.index() == index))
    };
    let errata: Vec<&Erratum> = system.errata.iter().filter(wanted).collect();
    print(&if args.markdown { markdown(&system, &errata) } else { plain(&system, &errata) })
}

fn index(text: &str) -> Option<Index> {
    let digits = text.strip_prefix("0x").unwrap_or(text);
    let digits = digits.strip_suffix('h').unwrap_or(digits);
    u16::from_str_radix(digits, 16).ok().map(Index)
}

/// The entries, and the devices where it is not about all of them.
fn places(erratum: &Erratum) -> String {
    let places = erratum.at.iter().map(ErratumPlace::to_string).collect::<Vec<_>>().join(", ");
    match &erratum.devices {
        Devices::All => places,
        Devices::Only(keys) => format!("{places} on {}", keys.join(", ")).trim_start().to_owned(),
    }
}

fn plain(system: &System, errata: &[&Erratum]) -> String {
    // Each on one line, whatever the text holds.
    let words = |text: &Text| text.get(system.language()).unwrap_or_default().replace('\n', " ");
    let mut text = String::new();
    for erratum in errata {
        let at = places(erratum);
        let at = if at.is_empty() { String::new() } else { format!("{at} ") };
        let _ = writeln!(text, "{at}[{}] {}", erratum.kind.word(), words(&erratum.place));
        let _ = writeln!(text, "    prints   {}", words(&erratum.prints));
        let _ = writeln!(text, "    read as  {}", words(&erratum.reads));
        let _ = writeln!(text, "    because  {}", words(&erratum.because));
    }
    let _ = writeln!(text, "{} of {} errata", errata.len(), system.errata.len());
    text
}

fn markdown(system: &System, errata: &[&Erratum]) -> String {
    let language = system.language();
    let cell = od_spec::markdown::escape;
    let mut text =
        format!("# Errata: {}\n\n| at | kind | place | prints | read as | because |\n", cell(&system.title));
    text.push_str("|---|---|---|---|---|---|\n");
    for erratum in errata {
        let words = [&erratum.place, &erratum.prints, &erratum.reads, &erratum.because];
        let words = words.map(|words| cell(words.get(language).unwrap_or_default()));
        let _ = writeln!(text, "| {} | {} | {} |", places(erratum), erratum.kind.word(), words.join(" | "));
    }
    text
}
