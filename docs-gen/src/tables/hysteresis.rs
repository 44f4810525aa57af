//! Switches with a hysteresis: a row for each, with the values that the defaults give.

use od_spec::model::{Dictionary, EntryId, Ratio, Switch, SwitchBack, SwitchPoints, SwitchSide, Unit};

use super::Columns;
use super::variants::device_keys;
use crate::diagrams::hysteresis::{DrawnSwitch, picture};
use crate::language::Word;
use crate::source::Source;
use crate::view::{Cell, Grid, Row};

impl Source<'_> {
    /// The switches as a table with their picture; nothing where the devices shown have none of them.
    pub(crate) fn hysteresis(&self, switches: &[Switch]) -> Option<Grid> {
        let is_shown = |one: &Switch| self.devices.iter().any(|device| device.entry(one.threshold).is_some());
        if !switches.iter().any(is_shown) {
            return None;
        }
        let rows = switches.iter().map(|one| {
            let devices = self.switching(one);
            let named =
                |id| devices.first().map_or_else(Cell::default, |device| self.named_entry(device, id));
            let back = devices.first().and_then(|device| self.back(one.back, device));
            Row::of(vec![
                self.text(&one.what),
                Cell::plain(at_points(&devices, one, |points, unit| {
                    let sign = match one.side {
                        SwitchSide::Below => "<",
                        SwitchSide::Above => ">",
                    };
                    format!("{sign} {}", self.quantity(unit, points.on))
                })),
                Cell::plain(at_points(&devices, one, |points, unit| self.quantity(unit, points.off))),
                named(one.threshold),
                named(one.back.entry()).text(back.map_or_else(String::new, |back| format!(": {back}"))),
            ])
        });
        let grid = Columns::new()
            .left(self, "switches", Word::Switches)
            .right(self, "on", Word::GoesOn)
            .right(self, "off", Word::GoesOffAt)
            .left(self, "on_from", Word::OnFrom)
            .left(self, "off_from", Word::OffFrom)
            .full(rows.collect());
        let drawn: Option<Vec<DrawnSwitch>> = switches.iter().map(|one| self.drawn_switch(one)).collect();
        Some(Grid { hysteresis: drawn.and_then(|drawn| picture(&drawn)), ..grid })
    }

    /// The devices that have a switch: those that are shown, or else any.
    fn switching(&self, switch: &Switch) -> Vec<&Dictionary> {
        let has = |device: &&Dictionary| device.entry(switch.threshold).is_some();
        let shown: Vec<&Dictionary> = self.devices.iter().copied().filter(has).collect();
        if shown.is_empty() { self.system.devices.iter().find(has).into_iter().collect() } else { shown }
    }

    /// The default of the entry that says where a switch goes off.
    fn back(&self, back: SwitchBack, device: &Dictionary) -> Option<String> {
        let entry = device.entry(back.entry())?;
        Some(self.wording.physical(entry.unit.as_deref()?, entry.default.as_ref()?.integer()?))
    }

    /// A value in the symbol of a unit, which it need not be a whole number of steps of.
    fn quantity(&self, unit: &Unit, value: Ratio) -> String {
        let Some(steps) = unit.steps(value, unit.base_symbol()) else { return String::new() };
        match steps.to_whole() {
            Some(raw) => self.wording.physical(unit, raw),
            None => {
                let number = unit.decimal(steps).unwrap_or_else(|| steps.to_string());
                self.wording.quantity(&self.wording.decimal(&number), &unit.symbol)
            }
        }
    }

    /// What the picture shows of a switch; nothing where devices have other values.
    fn drawn_switch(&self, switch: &Switch) -> Option<DrawnSwitch> {
        let devices = self.switching(switch);
        let (device, others) = devices.split_first()?;
        let points = switch.points(device)?;
        if others.iter().any(|other| switch.points(other) != Some(points)) {
            return None;
        }
        let unit = unit_of(device, switch.threshold)?;
        Some(DrawnSwitch {
            what: self.text(&switch.what).text,
            side: switch.side,
            points,
            on_value: self.quantity(unit, points.on),
            off_value: self.quantity(unit, points.off),
            on_target: self.entry_target(device, switch.threshold),
            off_target: self.entry_target(device, switch.back.entry()),
            on: self.word(Word::SwitchedOn),
            off: self.word(Word::SwitchedOff),
        })
    }
}

fn unit_of(device: &Dictionary, id: EntryId) -> Option<&Unit> {
    device.entry(id)?.unit.as_deref()
}

/// What is said about the values of a switch; of each device where they differ.
fn at_points(
    devices: &[&Dictionary],
    switch: &Switch,
    text: impl Fn(SwitchPoints, &Unit) -> String,
) -> String {
    let of = |device: &Dictionary| {
        let unit = unit_of(device, switch.threshold)?;
        Some(text(switch.points(device)?, unit))
    };
    let all: Vec<String> = devices.iter().map(|device| of(device).unwrap_or_default()).collect();
    match all.as_slice() {
        [first, rest @ ..] if rest.iter().all(|text| text == first) => first.clone(),
        _ => {
            let pairs = all.iter().zip(devices);
            let pairs = pairs.map(|(text, device)| format!("{text} ({})", device_keys(&[*device])));
            pairs.collect::<Vec<_>>().join(", ")
        }
    }
}
