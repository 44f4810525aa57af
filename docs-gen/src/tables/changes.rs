//! What changed since an earlier specification.

use od_spec::model::{Devices, Dictionary, Object};
use od_spec::wording::Language;

use super::Columns;
use crate::language::Word;
use crate::options::Changed;
use crate::source::Source;
use crate::view::{Align, Cell, Row, Table};

impl Source<'_> {
    /// The changes of the devices shown, and of what all devices share.
    pub(crate) fn changes(&self) -> Table {
        // A change is in English, whatever the language of the document is.
        let language = if self.language.words == Language::ENGLISH { "" } else { "en" };
        let english = |text: &str| self.linked(&Devices::All, text, language);
        let changes = self.since.map_or(&[][..], |since| &since.changes);
        let is_shown = |change: &&Changed| self.devices.iter().any(|device| change.is_of(device));
        let rows = changes.iter().filter(is_shown).map(|change| {
            let device = change.device.as_ref().filter(|_| self.devices.len() > 1);
            let device = device.map_or_else(Cell::default, |key| Cell::plain(key.to_uppercase()));
            let texts = [&change.place, &change.values, &change.consequences].map(|text| english(text));
            let cells = [device, Cell::plain(change.sign)].into_iter().chain(texts);
            Row { cells: cells.collect(), ..Row::default() }
        });
        let columns = Columns::new()
            .left(self, "device", Word::Device)
            .with("sign", "", Align::Center)
            .left(self, "place", Word::Place)
            .left(self, "change", Word::Change)
            .left(self, "consequence", Word::Consequence);
        let grid = columns.grid(rows.collect(), &["sign", "place", "change", "consequence"]);
        let title =
            self.since.map_or_else(String::new, |since| self.sentence(Word::ChangedSince, &since.name));
        Table::unnumbered("changes-all", "changes", Cell::plain(title), vec![grid])
    }

    /// A line about an object that changed, which leads to how.
    pub(crate) fn changed(&self, device: &Dictionary, object: &Object) -> Option<Cell> {
        let since = self.since?;
        let is_it = |change: &Changed| change.index == Some(object.index) && change.is_of(device);
        let text = self.sentence(Word::ChangedSince, &since.name);
        since.changes.iter().any(is_it).then(|| Cell::default().link(text, "changes", ""))
    }
}

impl Changed {
    /// Whether it is about a device, alone or among others.
    fn is_of(&self, device: &Dictionary) -> bool {
        self.device.as_ref().is_none_or(|key| *key == device.key)
    }
}
