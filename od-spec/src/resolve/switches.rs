//! Switches with a hysteresis: whether their entries have values that can be compared, and these an order.

use std::cmp::Ordering;

use super::figures::Figures;
use super::types::words;
use crate::ast::{Name, SwitchDecl};
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::limits::SWITCHES;
use crate::model::{
    Dictionary, EntryId, Fact, Ratio, Switch, SwitchBack, SwitchPoints, SwitchSide, Text, Unit,
};
use crate::source::{Span, Spanned};

/// A switch with the places of what it names.
struct Placed<'a> {
    switch: Switch,
    threshold: &'a Name,
    back: &'a Name,
}

impl Figures<'_, '_> {
    /// The switches, if all of them fit.
    pub(super) fn switches(
        &self,
        decls: &[Spanned<SwitchDecl>],
        diagnostics: &mut Diagnostics,
    ) -> Option<Vec<Switch>> {
        if let Some(beyond) = decls.get(SWITCHES) {
            let message = format!("{} switches; a picture has at most {SWITCHES}", decls.len());
            diagnostics.push(
                Diagnostic::new(codes::TOO_MUCH, beyond.span.part(0, 1), message)
                    .help("describe several pictures, one after the other"),
            );
            return None;
        }
        let placed: Vec<Option<Placed<'_>>> =
            decls.iter().map(|decl| self.placed(decl, diagnostics)).collect();
        let placed: Vec<Placed<'_>> = placed.into_iter().collect::<Option<_>>()?;
        let mut fits = true;
        for device in &self.system.devices {
            let has = |one: &&Placed<'_>| device.entry(one.switch.threshold).is_some();
            let here: Vec<&Placed<'_>> = placed.iter().filter(has).collect();
            fits &= on_device(&here, device, diagnostics);
        }
        fits.then(|| placed.into_iter().map(|one| one.switch).collect())
    }

    fn placed<'s>(&self, decl: &'s Spanned<SwitchDecl>, diagnostics: &mut Diagnostics) -> Option<Placed<'s>> {
        let SwitchDecl { what, below, above, back_by, back_at } = &decl.value;
        // That one of two is missing, or both are there, was reported by their keys.
        let (side, threshold) = match (below, above) {
            (Some(name), None) => (SwitchSide::Below, name),
            (None, Some(name)) => (SwitchSide::Above, name),
            (Some(_), Some(_)) | (None, None) => return None,
        };
        let (back, is_difference) = match (back_by, back_at) {
            (Some(name), None) => (name, true),
            (None, Some(name)) => (name, false),
            (Some(_), Some(_)) | (None, None) => return None,
        };
        let (threshold_id, _) = self.entry(threshold, diagnostics)?;
        let (back_id, _) = self.entry(back, diagnostics)?;
        let switch = Switch {
            what: words(what),
            side,
            threshold: threshold_id,
            back: if is_difference { SwitchBack::By(back_id) } else { SwitchBack::At(back_id) },
        };
        Some(Placed { switch, threshold, back })
    }
}

/// Whether the switches of a device have values in one unit, and these an order.
fn on_device(here: &[&Placed<'_>], device: &Dictionary, diagnostics: &mut Diagnostics) -> bool {
    let mut known: Vec<(&Placed<'_>, SwitchPoints)> = Vec::new();
    let mut first: Option<(&Name, EntryId, &Unit)> = None;
    for &one in here {
        let (Some(unit), Some(of_back)) = (
            unit_of(one.threshold, one.switch.threshold, device, diagnostics),
            unit_of(one.back, one.switch.back.entry(), device, diagnostics),
        ) else {
            return false;
        };
        let (before, before_id, before_unit) =
            *first.get_or_insert((one.threshold, one.switch.threshold, unit));
        if before_unit.base_symbol() != unit.base_symbol() {
            differ(
                (one.threshold.span, one.switch.threshold, unit),
                (before.span, before_id, before_unit),
                "draw them in pictures of their own",
                diagnostics,
            );
            return false;
        }
        let (symbol, of_back_symbol) = (unit.base_symbol(), of_back.base_symbol());
        let fits = symbol == of_back_symbol
            || match one.switch.back {
                // Two temperatures in degrees Celsius differ by kelvins.
                SwitchBack::By(_) => (symbol, of_back_symbol) == ("°C", "K"),
                SwitchBack::At(_) => false,
            };
        if !fits {
            differ(
                (one.back.span, one.switch.back.entry(), of_back),
                (one.threshold.span, one.switch.threshold, unit),
                "name entries of one base unit, or correct a unit",
                diagnostics,
            );
            return false;
        }
        let Some(points) = one.switch.points(device) else { return false };
        if !is_ordered(one, points, unit, diagnostics) {
            return false;
        }
        known.push((one, points));
    }
    are_apart(&known, device, diagnostics)
}

/// The unit of an entry whose default is a whole number in it.
fn unit_of<'d>(
    name: &Name,
    id: EntryId,
    device: &'d Dictionary,
    diagnostics: &mut Diagnostics,
) -> Option<&'d Unit> {
    let entry = device.entry(id);
    let number = entry.and_then(|entry| entry.default.as_ref()?.integer());
    let unit = entry.and_then(|entry| entry.unit.as_deref());
    if unit.is_none() || number.is_none() {
        let what = if number.is_none() { "default that is a whole number" } else { "unit" };
        let message = format!("{id} has no {what} on `{}`", device.key);
        diagnostics.push(
            Diagnostic::new(codes::NO_HYSTERESIS, name.span, message)
                .about(id)
                .help("name an entry with a unit and a default, from which the values are taken"),
        );
        return None;
    }
    unit
}

fn differ(
    (place, id, unit): (Span, EntryId, &Unit),
    (other_place, other, other_unit): (Span, EntryId, &Unit),
    help: &str,
    diagnostics: &mut Diagnostics,
) {
    let (symbol, other_symbol) = (unit.base_symbol(), other_unit.base_symbol());
    let message = format!("{id} is in `{symbol}`, {other} in `{other_symbol}`");
    diagnostics.push(
        Diagnostic::new(codes::UNITS_DIFFER, place, message)
            .about((id, Fact::Unit))
            .with(other_place, format!("this one is in `{other_symbol}`"))
            .help(help),
    );
}

/// A value in the basic symbol of a unit.
fn shown(value: Ratio, unit: &Unit) -> String {
    let number = value.decimal_places().and_then(|places| value.to_decimal(places.max(1)));
    format!("{} {}", number.unwrap_or_else(|| value.to_string()), unit.base_symbol())
}

/// Whether it goes off on the other side of where it goes on.
fn is_ordered(one: &Placed<'_>, points: SwitchPoints, unit: &Unit, diagnostics: &mut Diagnostics) -> bool {
    let (wanted, side, other_side) = match one.switch.side {
        SwitchSide::Below => (Ordering::Greater, "below", "above"),
        SwitchSide::Above => (Ordering::Less, "above", "below"),
    };
    let fits = points.off.compare(points.on) == Some(wanted);
    if !fits {
        let (on, off) = (shown(points.on, unit), shown(points.off, unit));
        diagnostics.push(
            Diagnostic::new(
                codes::NO_HYSTERESIS,
                one.back.span,
                format!("this goes on {side} {on}, and off again at {off}"),
            )
            .with(one.threshold.span, "on beyond this value")
            .help(format!("take a value that lies {other_side} the threshold, or a difference above 0")),
        );
    }
    fits
}

/// What goes on below a value and what goes on above one are never on together.
fn are_apart(
    known: &[(&Placed<'_>, SwitchPoints)],
    device: &Dictionary,
    diagnostics: &mut Diagnostics,
) -> bool {
    let on_side = |side: SwitchSide| known.iter().filter(move |(one, _)| one.switch.side == side);
    for (low, below) in on_side(SwitchSide::Below) {
        for (high, above) in on_side(SwitchSide::Above) {
            let is_above = |one: Ratio, other: Ratio| one.compare(other) == Some(Ordering::Greater);
            if is_above(below.off, above.on) || is_above(below.on, above.off) {
                let name = |text: &Text| shorten(text.iter().next().map_or("", |(_, text)| text));
                let message = format!(
                    "`{}` and `{}` can be on together on `{}`",
                    name(&low.switch.what),
                    name(&high.switch.what),
                    device.key
                );
                diagnostics.push(
                    Diagnostic::new(codes::NO_HYSTERESIS, high.threshold.span, message)
                        .with(low.threshold.span, "the other threshold")
                        .help("correct the thresholds, or draw them in pictures of their own"),
                );
                return false;
            }
        }
    }
    true
}
