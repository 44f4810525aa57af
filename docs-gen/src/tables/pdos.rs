//! Factory PDOs in the form of a manual: a row for the number of mapped entries, then a row for each of them.

use od_spec::model::{DataType, Dictionary, Direction, EntryId, Index, Pdo, PdoTarget, Ratio, SubIndex};

use super::Columns;
use crate::language::Word;
use crate::source::Source;
use crate::view::cell::{entry_anchor, object_anchor};
use crate::view::{Cell, Grid, PdoField, PdoView, Row, Table};

/// `rpdo-1`
pub(crate) fn anchor(pdo: &Pdo) -> String {
    format!("{}-{}", pdo.direction.pdo().to_lowercase(), pdo.number)
}

impl Source<'_> {
    /// A row for each PDO of a direction, followed by one for each of its fields.
    pub(crate) fn pdo_rows(&self, device: &Dictionary, direction: Direction) -> Grid {
        let mut rows = Vec::new();
        for pdo in device.pdos_of(direction) {
            rows.push(Row {
                anchor: String::new(),
                ..Row::of(vec![
                    Cell::plain(format!("{} {}", direction.pdo(), pdo.number)),
                    self.cob_id(pdo),
                    Cell::plain(self.word(if pdo.valid { Word::Yes } else { Word::No })),
                    Cell::plain(Index(pdo.mapping_index()).to_string()),
                    Cell::plain("0"),
                    Cell::plain(pdo.map.len().to_string()),
                    Cell::default(),
                ])
            });
            for (at, mapped) in pdo.map.iter().enumerate() {
                let mut cells = vec![Cell::default(); 4];
                cells.push(Cell::plain((at + 1).to_string()));
                cells.push(Cell::plain(self.wording.mapping_parameter(mapped.parameter())));
                cells.push(match mapped.target {
                    PdoTarget::Entry(id) => Cell::default().link(
                        device.entry_name(id).unwrap_or_default(),
                        entry_anchor(id),
                        self.home(id.index),
                    ),
                    PdoTarget::Dummy(data_type) => Cell::plain(data_type.name()),
                });
                rows.push(Row::of(cells));
            }
        }
        Columns::new()
            .left(self, "pdo", Word::Pdo)
            .left(self, "cob_id", Word::CobId)
            .left(self, "enabled", Word::Enabled)
            .left(self, "index", Word::Index)
            .right(self, "sub", Word::Sub)
            .left(self, "default", Word::Default)
            .left(self, "object", Word::Object)
            .full(rows)
    }

    /// A PDO with what is needed to draw it.
    pub(crate) fn pdo(&self, device: &Dictionary, pdo: &Pdo) -> PdoView {
        let fields = pdo.fields().map(|field| {
            let (start, width) = (field.first_bit, u32::from(field.mapped.bits));
            match field.mapped.target {
                PdoTarget::Entry(id) => PdoField {
                    start,
                    width,
                    entry: id.to_string(),
                    anchor: entry_anchor(id),
                    name: device.entry_name(id).unwrap_or_default(),
                    target: self.entry_target(device, id),
                },
                PdoTarget::Dummy(data_type) => PdoField {
                    start,
                    width,
                    entry: String::new(),
                    anchor: String::new(),
                    name: dummy(data_type),
                    target: None,
                },
            }
        });
        PdoView {
            name: format!("{} {}", pdo.direction.pdo(), pdo.number),
            anchor: anchor(pdo),
            direction: pdo.direction.word(),
            cob_id: pdo.cob_id.as_ref().map(|cob_id| self.wording.can_id(cob_id)).unwrap_or_default(),
            valid: pdo.valid,
            facts: self.pdo_facts(device, pdo),
            fields: fields.collect(),
            bits: pdo.bits(),
            about: self.text(&pdo.about),
        }
    }

    /// The COB-ID entry; nothing where it is not stated.
    fn cob_id(&self, pdo: &Pdo) -> Cell {
        let cob_id = pdo.cob_id.as_ref();
        cob_id.map_or_else(Cell::default, |cob_id| Cell::plain(self.wording.cob_id_entry(cob_id)))
    }

    fn pdo_facts(&self, device: &Dictionary, pdo: &Pdo) -> Table {
        let index = |index: u16| {
            let index = Index(index);
            Cell::default().link(index.to_string(), object_anchor(index), self.home(index))
        };
        let stated = |sub: u8| {
            self.stated_default(
                device,
                EntryId { index: Index(pdo.communication_index()), sub: SubIndex(sub) },
            )
        };
        let enabled = Cell::plain(self.word(if pdo.valid { Word::Yes } else { Word::No }));
        let mut rows = vec![
            (Word::CobId, self.cob_id(pdo).stated(stated(1))),
            (Word::Enabled, enabled.stated(stated(1))),
        ];
        if let Some(transmission) = pdo.transmission {
            rows.push((Word::Transmission, Cell::plain(transmission.to_string()).stated(stated(2))));
        }
        if let Some(time) = pdo.inhibit_time {
            let tenths = Ratio::new(i128::from(time), 10).and_then(|ms| ms.to_decimal(1)).unwrap_or_default();
            rows.push((Word::InhibitTime, Cell::plain(format!("{} ms", self.wording.decimal(&tenths)))));
        }
        if let Some(timer) = pdo.event_timer {
            rows.push((Word::EventTimer, Cell::plain(format!("{timer} ms"))));
        }
        if let Some(start) = pdo.sync_start {
            rows.push((Word::SyncStart, Cell::plain(start.to_string())));
        }
        let objects = index(pdo.communication_index()).text(", ").and(index(pdo.mapping_index()));
        rows.push((Word::Objects, objects));
        let rows =
            rows.into_iter().map(|(word, cell)| Row::of(vec![Cell::plain(self.word(word)), cell])).collect();
        let grid =
            Columns::new().left(self, "name", Word::Parameter).left(self, "value", Word::Value).full(rows);
        Table::unnumbered(String::new(), "facts", Cell::default(), vec![grid])
    }
}

/// A placeholder.
fn dummy(data_type: DataType) -> String {
    format!("({})", data_type.name())
}
