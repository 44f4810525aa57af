//! Sequences of events: a row for each step, and the levels of the signals after it.

use od_spec::model::{
    BitField, Dictionary, EntryId, Level, NamedBits, Signal, SignalCarrier, Timing, TypeKind,
};

use super::Columns;
use crate::diagrams::timing::{DrawnLevel, DrawnSignal, picture};
use crate::language::Word;
use crate::source::Source;
use crate::view::cell::entry_anchor;
use crate::view::{Align, Cell, Grid, Row, Target};

impl Source<'_> {
    /// The sequence as a table with its picture; nothing where the devices shown have none of its signals.
    pub(crate) fn timing(&self, timing: &Timing) -> Option<Grid> {
        if !timing.signals.iter().any(|signal| self.shows_signal(&signal.carrier)) {
            return None;
        }
        let signals: Vec<DrawnSignal> = timing.signals.iter().map(|signal| self.drawn(signal)).collect();
        let steps: Vec<Cell> = timing.steps.iter().map(|step| self.text(&step.event)).collect();
        let levels =
            |behind: usize| signals.iter().map(move |signal| Cell::plain(signal.levels[behind].text()));
        let before = [Cell::default(), Cell::plain(self.word(Word::Before)), Cell::default()];
        let mut rows = vec![Row::of(before.into_iter().chain(levels(0)).collect())];
        for (before, (step, event)) in timing.steps.iter().zip(&steps).enumerate() {
            let number = before + 1;
            let cause = step.cause.map_or_else(String::new, |cause| cause.to_string());
            let cells = [Cell::plain(number.to_string()), event.clone(), Cell::plain(cause)];
            rows.push(Row::of(cells.into_iter().chain(levels(number)).collect()));
        }
        let mut columns = Columns::new()
            .right(self, "step", Word::StepNumber)
            .left(self, "event", Word::Event)
            .center(self, "cause", Word::CausedBy);
        for (signal, drawn) in timing.signals.iter().zip(&signals) {
            // A heading takes no link: the index is in the picture, and in the texts of the steps as a link.
            let is_named = matches!(signal.carrier, SignalCarrier::Entry(_)) && !drawn.name.is_empty();
            let title = if is_named { drawn.name.clone() } else { drawn.title() };
            columns = columns.with("level", title, Align::Center);
        }
        let grid = columns.grid(rows, &["step", "event", "level"]);
        let events: Vec<String> = steps.into_iter().map(|event| event.text).collect();
        Some(Grid { timing: Some(picture(timing, signals, events)), ..grid })
    }

    fn shows_signal(&self, carrier: &SignalCarrier) -> bool {
        match carrier {
            SignalCarrier::Bits(bits) => self.shows_type(&bits.named_type),
            SignalCarrier::Entry(id) => self.devices.iter().any(|device| device.entry(*id).is_some()),
        }
    }

    /// A device that has the entry: one that is shown, or else any.
    fn having_entry(&self, id: EntryId) -> Option<&Dictionary> {
        let has = |device: &&Dictionary| device.entry(id).is_some();
        self.devices.iter().copied().find(has).or_else(|| self.system.devices.iter().find(has))
    }

    /// What the picture shows of a signal.
    fn drawn(&self, signal: &Signal) -> DrawnSignal {
        let (name, place) = match &signal.carrier {
            SignalCarrier::Bits(bits) => (bits.name.clone(), self.place_of_bits(bits)),
            SignalCarrier::Entry(id) => {
                let name = self.having_entry(*id).and_then(|device| device.entry_name(*id));
                (name.unwrap_or_default(), id.to_string())
            }
        };
        DrawnSignal {
            name,
            place,
            target: self.carrier_target(&signal.carrier),
            levels: signal.levels.iter().map(|level| self.level(signal, level)).collect(),
        }
    }

    /// Where the entry or the bit of a signal is described.
    fn carrier_target(&self, carrier: &SignalCarrier) -> Option<Target> {
        match carrier {
            SignalCarrier::Entry(id) => self.entry_target(self.having_entry(*id)?, *id),
            SignalCarrier::Bits(bits) => self.bits_target(bits),
        }
    }

    /// Where bits are described; of a type that several entries have, none is meant more than another.
    pub(super) fn bits_target(&self, NamedBits { named_type, first, .. }: &NamedBits) -> Option<Target> {
        let of_type = |device: &Dictionary| -> Vec<EntryId> {
            let having = device.entries().filter(|(.., entry)| {
                entry.named_type.as_ref().is_some_and(|named| named.name == *named_type)
            });
            having.map(|(id, ..)| id).collect()
        };
        let device = self.devices.iter().copied().find(|device| !of_type(device).is_empty())?;
        let &[id] = of_type(device).as_slice() else { return None };
        // Rows of bits are on the page of their device.
        Some(Target { anchor: format!("{}.b{first}", entry_anchor(id)), page: device.key.clone() })
    }

    /// Where bits are: `controlword, Bit 4`.
    pub(super) fn place_of_bits(&self, NamedBits { named_type, first, last, .. }: &NamedBits) -> String {
        if first == last {
            format!("{named_type}, {} {first}", self.word(Word::Bit))
        } else {
            format!("{named_type}, {} {first}..{last}", self.word(Word::Bits))
        }
    }

    fn level(&self, signal: &Signal, level: &Level) -> DrawnLevel {
        match (level, &signal.carrier) {
            (Level::Any, _) => DrawnLevel::Value("x".to_owned()),
            (Level::Letter(letter), _) => DrawnLevel::Value(letter.to_string()),
            (Level::Value(value), SignalCarrier::Entry(id)) => {
                let entry = self.having_entry(*id).and_then(|device| device.entry(*id));
                let shown = entry.map(|entry| self.wording.value(Some(id.index), entry, value));
                DrawnLevel::Value(shown.unwrap_or_default())
            }
            (Level::Value(value), SignalCarrier::Bits(NamedBits { named_type, first, last, .. })) => {
                match value.integer() {
                    Some(0) if first == last => DrawnLevel::Low,
                    Some(1) if first == last => DrawnLevel::High,
                    raw => DrawnLevel::Value(self.bits_value(named_type, *first, raw.unwrap_or_default())),
                }
            }
        }
    }

    /// A value of a run of bits: `2`, or `2 = homing` where it has a name.
    fn bits_value(&self, named_type: &str, first: u8, raw: i128) -> String {
        let fields = match self.system.types.get(named_type).map(|named| &named.kind) {
            Some(TypeKind::Bits(fields)) => fields.as_slice(),
            Some(TypeKind::Enum(_)) | None => &[],
        };
        let field: Option<&BitField> = fields.iter().find(|field| field.first == first);
        let named = field.and_then(|field| field.values.iter().find(|value| value.value == raw));
        named.map_or_else(|| raw.to_string(), |named| format!("{raw} = {}", named.name))
    }
}
