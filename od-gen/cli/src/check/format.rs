//! The findings of one file in a format.

use od_spec::diag::render::{Format, render};

use super::checked::{Checked, Kind};
use crate::args::{CheckArgs, CheckFormat};
use crate::listing::{Most, for_people};

/// The findings in a format; nothing in one that is about the whole run.
pub(super) fn of_file(checked: &Checked, format: CheckFormat, args: &CheckArgs, colour: bool) -> String {
    let all = |format| render(&checked.shown, &checked.sources, format, colour);
    match format {
        CheckFormat::Human => {
            let most = match checked.kind {
                _ if args.all => Most::All,
                Kind::Eds => Most::OfEds,
                Kind::Specification | Kind::Unknown => Most::OfSpecification,
            };
            for_people(&checked.shown, &checked.sources, most, "`--all`", colour)
        }
        CheckFormat::Short => all(Format::Short),
        CheckFormat::Json => all(Format::Json),
        CheckFormat::Github => all(Format::Github),
        CheckFormat::Sarif => String::new(),
    }
}
