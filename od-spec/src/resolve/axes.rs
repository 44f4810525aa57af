//! Axes: whether their spans begin and end at marks, and their entries are those of a device.

use super::figures::{Figures, Named};
use super::types::words;
use crate::ast::{AxisDecl, SpanDecl};
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::limits::{MARKS, SPANS};
use crate::model::{Axis, AxisMark, AxisReach, AxisSpan};
use crate::source::Spanned;

impl Figures<'_, '_> {
    /// The axis, if all of it fits.
    pub(super) fn axis(&self, decl: &AxisDecl, diagnostics: &mut Diagnostics) -> Option<Axis> {
        let AxisDecl { marks, spans } = decl;
        let beyond = marks.get(MARKS).map(|mark| mark.span);
        if let Some(beyond) = beyond.or_else(|| spans.get(SPANS).map(|span| span.span)) {
            let message = format!("an axis with more than {MARKS} marks or {SPANS} spans");
            diagnostics.push(
                Diagnostic::new(codes::TOO_MUCH, beyond.part(0, 1), message)
                    .help("describe several axes, one after the other"),
            );
            return None;
        }
        if marks.is_empty() {
            return None;
        }
        let names = Named::of("mark", marks.iter().map(|mark| mark.value.name.as_ref()), diagnostics)?;
        let placed: Vec<Option<AxisMark>> = marks
            .iter()
            .map(|mark| {
                let entries = self.entries(&mark.value.entries, diagnostics)?;
                Some(AxisMark { name: words(&mark.value.name), entries })
            })
            .collect();
        let spanned: Vec<Option<AxisSpan>> =
            spans.iter().map(|span| self.axis_span(span, &names, diagnostics)).collect();
        let axis = Axis {
            marks: placed.into_iter().collect::<Option<_>>()?,
            spans: spanned.into_iter().collect::<Option<_>>()?,
        };
        let entries = marks.iter().flat_map(|mark| &mark.value.entries);
        let entries = entries.chain(spans.iter().flat_map(|span| &span.value.entries));
        self.have_a_device(axis.entries().zip(entries), diagnostics).then_some(axis)
    }

    fn axis_span(
        &self,
        decl: &Spanned<SpanDecl>,
        names: &Named<'_>,
        diagnostics: &mut Diagnostics,
    ) -> Option<AxisSpan> {
        let SpanDecl { name, entries, from, to, does } = &decl.value;
        let entries = self.entries(entries, diagnostics);
        let reach = match (from, to) {
            (Some(from), Some(to)) => {
                let ends = (names.find(from, diagnostics), names.find(to, diagnostics));
                let (begin, end) = (ends.0?, ends.1?);
                if begin == end {
                    let message = format!("a span cannot end where it begins, at `{}`", shorten(&to.value));
                    diagnostics.push(
                        Diagnostic::new(codes::LOOSE_PART, to.span, message)
                            .with(from.span, "it begins there")
                            .help("name another mark, or leave one of the ends out"),
                    );
                    return None;
                }
                AxisReach::Between(begin, end)
            }
            (Some(from), None) => AxisReach::Above(names.find(from, diagnostics)?),
            (None, Some(to)) => AxisReach::Below(names.find(to, diagnostics)?),
            // Reported by the keys of a span.
            (None, None) => return None,
        };
        let name = words(name);
        Some(AxisSpan {
            name: (!name.is_empty()).then_some(name)?,
            entries: entries?,
            reach,
            does: words(does),
        })
    }
}
