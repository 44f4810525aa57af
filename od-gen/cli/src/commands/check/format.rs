//! The findings of one file in a format.

use od_formats::findings::{github, json};
use od_spec::diag::render::{Format, render};

use super::args::{CheckArgs, CheckFormat};
use super::checked::{Checked, Kind};
use crate::listing::{Most, for_people};

/// The findings in a format; nothing in one that is about the whole run.
pub(super) fn of_file(checked: &Checked, format: CheckFormat, args: &CheckArgs, colour: bool) -> String {
    let (shown, sources) = (&checked.shown, &checked.sources);
    match format {
        CheckFormat::Human => {
            let most = match checked.kind {
                _ if args.all => Most::All,
                Kind::Eds => Most::OfEds,
                Kind::Specification | Kind::Parameters | Kind::Unknown => Most::OfSpecification,
            };
            let shows = if args.all { "`--format json`" } else { "`--all`" };
            for_people(shown, sources, most, shows, colour)
        }
        CheckFormat::Short => render(shown, sources, Format::Short, colour),
        CheckFormat::Json => json(shown, sources),
        CheckFormat::Github => github(shown, sources),
        CheckFormat::Sarif => String::new(),
    }
}
