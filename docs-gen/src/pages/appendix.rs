//! Tables over the whole system: what a manual has no place for, or scatters.

use std::collections::{BTreeMap, BTreeSet};

use od_spec::model::{Devices, Dictionary, Entry, EntryId, ErratumPlace, Role, Storage, SubIndex, Unit};

use crate::language::Word;
use crate::options::Gaps;
use crate::source::Source;
use crate::tables::Columns;
use crate::tables::overview::among;
use crate::view::cell::{entry_anchor, object_anchor};
use crate::view::{Appendix, Cell, DeviceView, ErratumView, Row, Table};

/// An appendix before its words are chosen.
struct Part {
    /// Name of its page.
    page: &'static str,
    /// Heading.
    title: Word,
    /// What it shows.
    intro: Vec<Word>,
    tables: Vec<Table>,
}

/// Gives every appendix its letter, which those of a device share with those of the system.
pub(crate) fn letter(appendices: &mut [Appendix], devices: &mut [DeviceView], word: &str) {
    let letters: BTreeMap<&str, String> = appendices
        .iter()
        .zip('A'..='Z')
        .map(|(appendix, letter)| (appendix.page, letter.to_string()))
        .collect();
    let of_devices = devices.iter_mut().flat_map(|device| &mut device.appendices);
    for appendix in appendices.iter_mut().chain(of_devices) {
        let Some(letter) = letters.get(appendix.page) else { continue };
        appendix.title = format!("{word} {letter}: {}", appendix.title);
        appendix.letter.clone_from(letter);
    }
}

impl Source<'_> {
    /// All appendices that have something to show.
    pub(crate) fn appendices(&self) -> Vec<Appendix> {
        let mut list = self.device_appendices();
        if self.gaps == Gaps::Gathered {
            list.extend(self.shown([Part {
                page: "questions",
                title: Word::OpenQuestions,
                intro: vec![Word::OpenQuestionsIntro],
                tables: self.questions(),
            }]));
        }
        list.extend(self.shown([
            Part {
                page: "errata",
                title: Word::Errata,
                intro: vec![Word::ErrataIntro],
                tables: vec![self.errata()],
            },
            Part {
                page: "tables",
                title: Word::AllTables,
                intro: vec![Word::TablesIntro],
                tables: vec![self.tables(), self.figures()],
            },
        ]));
        list
    }

    /// Those that a device's page shows for its device.
    pub(crate) fn device_appendices(&self) -> Vec<Appendix> {
        self.shown([
            Part {
                page: "errors",
                title: Word::ErrorCodes,
                intro: vec![Word::ErrorsIntro],
                tables: self.error_tables(),
            },
            Part {
                page: "aliases",
                title: Word::Aliases,
                intro: vec![Word::AliasesIntro],
                tables: vec![self.aliases()],
            },
            Part {
                page: "units",
                title: Word::Units,
                intro: vec![Word::UnitsIntro],
                tables: vec![self.units()],
            },
            Part {
                page: "storage",
                title: Word::Storage,
                intro: self.storage_intro(),
                tables: self.storage(),
            },
            Part {
                page: "constraints",
                title: Word::Constraints,
                intro: vec![Word::ConstraintsIntro],
                tables: self.constraints(),
            },
            Part { page: "machines", title: Word::Machines, intro: Vec::new(), tables: self.machines() },
            Part {
                page: "changes",
                title: Word::Changes,
                intro: vec![Word::ChangesIntro],
                tables: vec![self.changes()],
            },
        ])
    }

    /// What holds for every error, and what for each.
    fn error_tables(&self) -> Vec<Table> {
        let title = Cell::plain(self.word(Word::EveryError));
        let any = Table::unnumbered("errors-any", "any-error", title, vec![self.any_error()]);
        let list = self.error_reference();
        let unsaid = self.unsaid_of_errors(&list);
        let about = if unsaid.is_empty() {
            Cell::default()
        } else {
            Cell::plain(self.sentence(Word::ErrorsUnsaid, &unsaid))
        };
        let all = Table::unnumbered("errors-all", "errors", Cell::default(), vec![list]);
        vec![any, Table { about, ..all }]
    }

    /// The appendices in words, without tables that have no rows and appendices that have no tables.
    fn shown<const N: usize>(&self, parts: [Part; N]) -> Vec<Appendix> {
        parts
            .into_iter()
            .map(|part| {
                let mut appendix = Appendix {
                    page: part.page,
                    letter: String::new(),
                    title: self.word(part.title).to_owned(),
                    intro: self.linked(&Devices::All, &self.sentences(&part.intro), ""),
                    tables: part
                        .tables
                        .into_iter()
                        .filter(|table| table.grids.iter().any(|grid| !grid.rows.is_empty()))
                        .collect(),
                    untranslated: String::new(),
                };
                appendix.untranslated = self.untranslated(appendix.foreign());
                appendix
            })
            .filter(|appendix| !appendix.tables.is_empty())
            .collect()
    }

    /// The device of a row, where there are several.
    fn device_cell(&self, device: &Dictionary) -> Cell {
        if self.devices.len() > 1 { Cell::plain(device.key.to_uppercase()) } else { Cell::default() }
    }

    fn aliases(&self) -> Table {
        let views = self.devices.iter().flat_map(|device| device.views().map(move |view| (*device, view)));
        let rows = views.filter_map(|(device, view)| {
            let target = device.entry(view.alias.target)?;
            Some(Row::of(vec![
                self.entry_link_on(device, view.id),
                Cell::plain(device.entry_name(view.id).unwrap_or_default()),
                Cell::plain(view.entry.data_type.name()),
                self.entry_link_on(device, view.alias.target),
                Cell::plain(device.entry_name(view.alias.target).unwrap_or_default()),
                Cell::plain(target.data_type.name()),
                Cell::plain(self.wording.decimal(&view.alias.factor.to_string())),
                Cell::plain(self.wording.conversion(view.alias)),
                self.device_cell(device),
            ]))
        });
        let grid = Columns::new()
            .left(self, "alias", Word::Alias)
            .left(self, "name", Word::Name)
            .left(self, "type", Word::Type)
            .left(self, "target", Word::Target)
            .left(self, "target_name", Word::Name)
            .left(self, "target_type", Word::Type)
            .right(self, "factor", Word::Factor)
            .left(self, "conversion", Word::Meaning)
            .left(self, "device", Word::Device)
            .grid(rows.collect(), &["alias", "name", "type", "target"]);
        Table::unnumbered("aliases-all", "aliases", Cell::default(), vec![grid])
    }

    /// Units that an entry of the devices shown has.
    fn units(&self) -> Table {
        let rows = self.system.units.values().filter_map(|unit| {
            let entries = self.entries_in(unit);
            let base = unit.base.as_ref().map(|base| {
                let factor = self.wording.decimal(&base.factor.to_string());
                let one = self.wording.quantity("1", &unit.symbol);
                format!("{one} = {}", self.wording.quantity(&factor, &base.symbol))
            });
            (!entries.is_empty()).then(|| Row {
                anchor: format!("unit-{}", self.unit_anchor(&unit.name)),
                ..Row::of(vec![
                    Cell::plain(&unit.name),
                    Cell::plain(&unit.symbol),
                    Cell::plain(self.wording.counted_step(unit)),
                    base.map_or_else(Cell::default, Cell::plain),
                    unit.formula
                        .as_ref()
                        .map_or_else(Cell::default, |formula| self.condition(formula, &Devices::All)),
                    self.text(&unit.about),
                    entries,
                ])
            })
        });
        let grid = Columns::new()
            .left(self, "name", Word::Name)
            .left(self, "symbol", Word::Symbol)
            .left(self, "step", Word::Step)
            .left(self, "base", Word::BaseUnit)
            .left(self, "formula", Word::Formula)
            .left(self, "description", Word::Description)
            .left(self, "entries", Word::UsedBy)
            .grid(rows.collect(), &["name", "symbol", "step", "entries"]);
        Table::unnumbered("units-all", "units", Cell::default(), vec![grid])
    }

    /// The entries in a unit; an object whose entries all are represents them.
    fn entries_in(&self, unit: &Unit) -> Cell {
        let has = |entry: &Entry| entry.unit.as_ref().is_some_and(|its_unit| its_unit.name == unit.name);
        let (mut cell, mut shown) = (Cell::default(), BTreeSet::new());
        let objects = self
            .devices
            .iter()
            .flat_map(|device| self.objects_in(&unit.name).filter_map(|index| device.objects.get(&index)));
        for object in objects {
            let whole = among(object, has) == [true];
            let entries =
                object.entries.iter().filter(|entry| has(entry)).take(if whole { 1 } else { usize::MAX });
            for entry in entries {
                let id = EntryId { index: object.index, sub: if whole { SubIndex(0) } else { entry.sub } };
                if !shown.insert(id) {
                    continue;
                }
                cell = if cell.is_empty() { cell } else { cell.text(", ") };
                cell = cell.and(self.entry_link(id));
            }
        }
        cell
    }

    /// What storage is, and the commands of CiA 301 that save and restore, where a device has them.
    fn storage_intro(&self) -> Vec<Word> {
        let has = |role| {
            let mut objects = self.devices.iter().flat_map(|device| device.objects.keys());
            objects.any(|index| Role::of(*index) == role)
        };
        let mut intro = vec![Word::StorageIntro];
        intro.extend(has(Role::StoreParameters).then_some(Word::StorageSave));
        intro.extend(has(Role::RestoreDefaults).then_some(Word::StorageRestore));
        intro
    }

    fn sentences(&self, words: &[Word]) -> String {
        words.iter().map(|word| self.word(*word)).collect::<Vec<_>>().join(" ")
    }

    /// One table per device and storage group.
    fn storage(&self) -> Vec<Table> {
        let groups = [Storage::Communication, Storage::Application, Storage::Manufacturer, Storage::Remanent];
        let mut tables = Vec::new();
        for device in &self.devices {
            for group in groups {
                let rows = device.entries().filter(|(.., entry)| entry.stored == group).map(
                    |(id, object, entry)| {
                        Row::of(vec![
                            self.entry_link_on(device, id),
                            Cell::plain(device.entry_name(id).unwrap_or_default()),
                            Cell::plain(entry.data_type.name()),
                            Cell::plain(self.wording.access(entry)),
                            Cell::plain(self.default(object, entry)),
                        ])
                    },
                );
                let grid = Columns::new()
                    .left(self, "entry", Word::Index)
                    .left(self, "name", Word::Name)
                    .left(self, "type", Word::Type)
                    .left(self, "access", Word::Access)
                    .left(self, "default", Word::Default)
                    .full(rows.collect());
                let title = format!(
                    "{}: {}",
                    device.key.to_uppercase(),
                    self.wording.storage_group_of(group, device)
                );
                let anchor = format!("storage-{}-{}", device.key, group.word());
                tables.push(Table::unnumbered(
                    anchor,
                    "storage",
                    self.linked(&Devices::one(&device.key), &title, ""),
                    vec![grid],
                ));
            }
        }
        tables
    }

    /// States, transitions and commands of every machine.
    fn machines(&self) -> Vec<Table> {
        let mut tables = Vec::new();
        for (name, machine) in &self.system.machines {
            if self.machine(name).is_none() {
                continue;
            }
            let anchor = |kind: &str| format!("machine-{}-{kind}", self.machine_anchor(name));
            for (kind, word, about, grid) in [
                ("states", Word::States, Cell::default(), self.states(machine)),
                ("transitions", Word::Transitions, Cell::default(), self.transitions(machine)),
                ("commands", Word::Commands, self.about_commands(machine), self.commands(machine)),
            ] {
                let title = Cell::plain(format!("{name}: {}", self.word(word)));
                tables.push(Table { about, ..Table::unnumbered(anchor(kind), kind, title, vec![grid]) });
            }
        }
        tables
    }

    /// One erratum.
    pub(crate) fn erratum(&self, at: usize) -> ErratumView {
        let erratum = &self.system.errata[at];
        ErratumView {
            number: at + 1,
            kind: self.wording.erratum_kind(erratum.kind).to_owned(),
            place: self.text(&erratum.place),
            prints: self.quoted(&erratum.prints),
            reads: self.text(&erratum.reads),
            because: self.text(&erratum.because),
        }
    }

    fn errata(&self) -> Table {
        let errata = self.system.errata.iter().enumerate().filter(|(_, erratum)| self.is_about(erratum));
        let rows = errata.map(|(at, erratum)| {
            let view = self.erratum(at);
            let mut entries = Cell::default();
            for (position, place) in erratum.at.iter().enumerate() {
                entries = if position == 0 { entries } else { entries.text(", ") };
                let (index, anchor) = match place {
                    ErratumPlace::Object(index) => (*index, object_anchor(*index)),
                    ErratumPlace::Entry(id) => (id.index, entry_anchor(*id)),
                };
                entries = entries.and(self.link_on(&erratum.devices, index, place.to_string(), anchor));
            }
            Row {
                anchor: format!("erratum-{}", at + 1),
                ..Row::of(vec![
                    Cell::plain((at + 1).to_string()),
                    entries,
                    Cell::plain(view.kind),
                    view.place,
                    view.prints,
                    view.reads,
                    view.because,
                ])
            }
        });
        let grid = Columns::new()
            .right(self, "number", Word::Number)
            .left(self, "entries", Word::ElementsOf)
            .left(self, "kind", Word::Kind)
            .left(self, "place", Word::Place)
            .left(self, "prints", Word::Prints)
            .left(self, "reads", Word::Reads)
            .left(self, "because", Word::Because)
            .full(rows.collect());
        Table::unnumbered("errata-all", "errata", Cell::default(), vec![grid])
    }

    /// Every table of the manual with the table here that takes its place.
    fn tables(&self) -> Table {
        let rows = self.printed().into_iter().map(|printed| {
            let number = printed.number.map_or_else(Cell::default, |number| Cell::plain(number.to_string()));
            let mut errata = Cell::default();
            for (at, number) in printed.errata.iter().enumerate() {
                errata = if at == 0 { errata } else { errata.text(", ") };
                errata = errata.link(number.to_string(), format!("erratum-{number}"), "errata");
            }
            let figure = printed.figure.as_ref().filter(|figure| figure.anchor == printed.anchor);
            let place = match printed.number {
                Some(number) => format!("{} {number}", self.word(Word::Table)),
                None if let Some(figure) = figure => format!("{} {}", self.word(Word::Figure), figure.number),
                None if printed.section.is_empty() && printed.title.is_empty() => printed.anchor.clone(),
                None if printed.section.is_empty() => printed.title.text.clone(),
                None => printed.section.clone(),
            };
            Row::of(vec![
                number,
                printed.title,
                Cell::plain(printed.section),
                Cell::plain(self.language.table_kind(printed.kind)),
                Cell::default().link(place, printed.anchor, printed.page),
                errata,
            ])
        });
        let grid = Columns::new()
            .right(self, "number", Word::Number)
            .left(self, "title", Word::Printed)
            .left(self, "section", Word::Section)
            .left(self, "kind", Word::Kind)
            .left(self, "generated", Word::Generated)
            .left(self, "errata", Word::DiffersCount)
            .full(rows.collect());
        Table::unnumbered("tables-all", "tables", Cell::default(), vec![grid])
    }

    /// Every figure of the manual, in order.
    fn figures(&self) -> Table {
        let printed = self.printed().into_iter();
        let rows = printed.filter_map(|printed| {
            let figure = printed.figure?;
            let place = format!("{} {}", self.word(Word::Figure), figure.number);
            Some(Row::of(vec![
                Cell::plain(figure.number.to_string()),
                figure.title,
                Cell::plain(printed.section),
                Cell::plain(self.language.table_kind(printed.kind)),
                Cell::default().link(place, figure.anchor, printed.page),
            ]))
        });
        let grid = Columns::new()
            .right(self, "number", Word::Number)
            .left(self, "title", Word::Figure)
            .left(self, "section", Word::Section)
            .left(self, "kind", Word::Kind)
            .left(self, "place", Word::Place)
            .full(rows.collect());
        let title = Cell::plain(self.word(Word::ListOfFigures));
        Table::unnumbered("figures-all", "figures", title, vec![grid])
    }
}
