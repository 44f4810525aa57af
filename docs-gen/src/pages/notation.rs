//! What the signs in the columns of tables mean.

use od_spec::model::{PdoMapping, SystemSource};

use crate::language::Word;
use crate::source::Source;
use crate::tables::Columns;
use crate::view::{Cell, Row, Stated, Table};

impl Source<'_> {
    /// A row for each sign.
    pub(crate) fn notation(&self) -> Table {
        let access = [
            ("ro", Word::NotationRead),
            ("wo", Word::NotationWrite),
            ("rw", Word::NotationReadWrite),
            ("rwr", Word::NotationReadWriteTransmit),
            ("rww", Word::NotationReadWriteReceive),
            ("r(w)", Word::NotationReadUnlocked),
            ("(w)", Word::NotationUnlocked),
            ("const", Word::NotationConst),
        ]
        .map(|(sign, meaning)| (Word::Access, Cell::plain(sign), meaning));
        let mapping = [
            (PdoMapping::None, Word::NotationMapNone),
            (PdoMapping::Receive, Word::NotationMapReceive),
            (PdoMapping::Transmit, Word::NotationMapTransmit),
            (PdoMapping::Both, Word::NotationMapBoth),
        ]
        .map(|(mapping, meaning)| (Word::Map, Cell::plain(self.wording.mapping(mapping)), meaning));
        let italics = |stated| Cell::plain(self.word(Word::NotationItalics)).stated(stated);
        // An EDS has no key for what is not stored, and is itself what everything comes from.
        let further = match self.system.source {
            SystemSource::Specification => vec![
                (Word::Mem, Cell::plain("Y"), Word::NotationStored),
                (Word::Mem, Cell::plain("N"), Word::NotationNotStored),
                (Word::AnyColumn, italics(Stated::Standard), Word::NotationItalicsMeaning),
                (Word::AnyColumn, italics(Stated::Assumed), Word::NotationAssumedMeaning),
            ],
            SystemSource::Eds => vec![(Word::Mem, Cell::plain("Y"), Word::NotationStoredInEds)],
        };
        let raw = (Word::AnyColumn, Cell::plain(self.wording.decimal("12.5 V (125)")), Word::NotationRaw);
        let rows = access.into_iter().chain(mapping).chain(further).chain([raw]);
        let rows = rows.map(|(column, sign, meaning)| {
            Row::of(vec![Cell::plain(self.word(column)), sign, Cell::plain(self.word(meaning))])
        });
        let grid = Columns::new()
            .left(self, "column", Word::Column)
            .left(self, "symbol", Word::Symbol)
            .left(self, "meaning", Word::Meaning)
            .full(rows.collect());
        Table::unnumbered("notation", "notation", Cell::plain(self.word(Word::Notation)), vec![grid])
    }
}
