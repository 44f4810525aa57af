//! All objects of a node, asked for one after the other.

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use od_bus::client::{Bus, Client, Found, Prober};
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::Index;

use super::failed;
use super::known::mapped;
use crate::progress::Progress;
use crate::report::Report;

/// Where standards put their objects.
pub(super) const STANDARD: RangeInclusive<u16> = 0x1000..=0x1FFF;

/// After so many indices it is said how long all of them take.
const SAMPLE: usize = 256;
/// A shorter wait needs no word, in microseconds.
const LONG: u64 = 10_000_000;

/// The entries that a node has at some indices, at those of the communication profile, and wherever its PDOs carry something.
pub(super) fn objects<B: Bus>(
    client: &mut Client<B>,
    node: u8,
    ranges: &[RangeInclusive<u16>],
    report: &Report,
) -> Result<Vec<Found>, u8> {
    let prober = Prober::new(client, node);
    let prober = prober.map_err(|error| failed(node, "an object that it cannot have", &error, report))?;
    let Some(prober) = prober else {
        let message = format!("node {node} answers also for objects that no device can have");
        return Err(report.refuse(
            Diagnostic::without_place(codes::ACCESS_FAILED, message)
                .help("what it has cannot be found out by asking: get its EDS from the maker"),
        ));
    };
    let is_other = |index: &u16| !STANDARD.contains(index);
    let mut others: BTreeSet<u16> = ranges.iter().cloned().flatten().filter(is_other).collect();
    let total = STANDARD.len() + others.len();
    let progress = Progress::new("asked for", "indices", total, report.audience());
    let mut asked = Asked { node, begin: prober.now(), prober, total, done: 0, progress, report };
    let mut found = asked.all(STANDARD)?;
    let carried = mapped(&found).into_keys().filter(|id| id.index.0 > *STANDARD.end());
    others.extend(carried.map(|id| id.index.0));
    found.extend(asked.all(others)?);
    asked.progress.clear();
    Ok(found)
}

/// A node that is asked for its objects.
struct Asked<'a, 'c, B: Bus> {
    node: u8,
    begin: u64,
    prober: Prober<'c, B>,
    /// So many indices are meant.
    total: usize,
    /// So many were asked for.
    done: usize,
    progress: Progress,
    report: &'a Report,
}

impl<B: Bus> Asked<'_, '_, B> {
    /// What there is at some indices.
    fn all(&mut self, indices: impl IntoIterator<Item = u16>) -> Result<Vec<Found>, u8> {
        let mut found = Vec::new();
        for index in indices.into_iter().map(Index) {
            if self.done == SAMPLE {
                self.tell_how_long();
            }
            self.progress.show(self.done);
            self.done += 1;
            found.extend(self.prober.object(index).map_err(|error| {
                self.progress.clear();
                failed(self.node, &index.to_string(), &error, self.report)
            })?);
        }
        Ok(found)
    }

    /// Says how long all of it takes, where that is long.
    fn tell_how_long(&mut self) {
        let Self { total, begin, .. } = *self;
        let whole = (self.prober.now() - begin) * total as u64 / SAMPLE as u64;
        if whole > LONG {
            self.progress.clear();
            let seconds = whole / 1_000_000;
            self.report.note(&format!(
                "asking for {total} indices takes about {seconds} s; `--range FIRST..LAST` asks for fewer"
            ));
        }
    }
}
