//! `[Comments]` (CiA 306 4.6.5): what a person should know about the whole file.

use od_spec::eds::Document;
use od_spec::model::{Date, Dictionary, System};

use super::withheld::Withheld;
use super::writer::SectionWriter;

/// The lines of `[Comments]`: those that the file or the specification of the device has, or else ours.
pub(super) fn write(document: &mut Document<'_>, system: &System, device: &Dictionary) {
    let of_file = device.further.as_ref().and_then(|further| further.comments.clone());
    let lines = of_file.unwrap_or_else(|| lines(system, device));
    let mut section = SectionWriter::new("Comments", &[]);
    section.key("Lines", lines.len());
    for (number, line) in (1..).zip(lines) {
        section.text(&format!("Line{number}"), &line);
    }
    section.finish(device, document);
}

/// Our lines, without what readers take for the end of a value.
fn lines(system: &System, device: &Dictionary) -> Vec<String> {
    let mut lines = vec![format!("{}: {}", system.title, device.name)];
    if let Some(source) = &system.document.source {
        lines.push(format!("Manual: {source}"));
    }
    if let Some(revision) = &system.document.revision {
        let Date { year, month, day } = revision.date;
        lines.push(format!("Holds issue {} of {year:04}-{month:02}-{day:02}", revision.number));
    }
    if system.vendor.number == 0 || device.info.product == 0 {
        lines.push(
            "Vendor number or product code is 0, not known: fill them in before a PLC checks identities."
                .to_owned(),
        );
    }
    let withheld = |why| device.entries().filter(move |(.., entry)| Withheld::of(entry) == Some(why)).count();
    let (of_the_maker, of_the_standard) = (withheld(Withheld::Kept), withheld(Withheld::Standard));
    let no_promise = withheld(Withheld::NoPromise);
    if of_the_maker > 0 {
        lines.push(format!(
            "{of_the_maker} defaults of stored or locked parameters are left out, so that no PLC writes them back at boot."
        ));
    }
    if of_the_standard > 0 {
        lines.push(format!(
            "{of_the_standard} defaults are left out because only the standard states them; the device may have others."
        ));
    }
    if no_promise > 0 {
        lines.push(format!(
            "{no_promise} values that the device starts with are left out because its maker does not promise them."
        ));
    }
    if of_the_maker + of_the_standard + no_promise > 0 {
        lines.push("The comments above each section list them, with units and meanings.".to_owned());
    }
    lines.iter().map(|line| line.replace('=', ":").replace(';', ",").replace('#', "No. ")).collect()
}
