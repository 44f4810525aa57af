//! What the printed manual leaves open, gathered for its maker.

use od_spec::model::{self, Basis, Devices, Dictionary, EntryId, NamedType, ProseKind, Text, TypeKind};

use crate::language::Word;
use crate::source::Source;
use crate::tables::Columns;
use crate::view::cell::{entry_anchor, object_anchor};
use crate::view::{Cell, Row, Table};

/// Questions with their places.
#[derive(Default)]
struct Questions(Vec<(Cell, Cell)>);

impl Questions {
    /// What one place leaves open; of the same place, once.
    fn add(&mut self, place: impl FnOnce() -> Cell, question: Option<Cell>) {
        let Some(question) = question else { return };
        let place = place();
        if !self.0.iter().any(|(known, asked)| known.text == place.text && asked.text == question.text) {
            self.0.push((place, question));
        }
    }
}

impl Source<'_> {
    /// The questions of the chapters and of what is described outside them, and the facts that are assumed.
    pub(crate) fn questions(&self) -> Vec<Table> {
        let mut list = Questions::default();
        for chapter in self.outline.chapters() {
            for plan in &chapter.sections {
                let section = &self.document().sections[plan.position];
                let anchor = self.outline.section_anchor(plan.position);
                for content in &section.content {
                    let model::Content::Prose(prose) = content else { continue };
                    if prose.kind != ProseKind::Gap {
                        continue;
                    }
                    for text in &prose.items {
                        let place =
                            || Cell::default().link(self.heading(plan.position), &*anchor, &*chapter.page);
                        list.add(place, Some(self.text(text)));
                    }
                }
            }
        }
        for device in &self.devices {
            self.questions_of(device, &mut list);
        }
        for (name, machine) in &self.system.machines {
            let texts = machine.states.iter().map(|state| (&state.name, &state.about));
            let commands = machine.commands.iter().map(|command| (&command.name, &command.about));
            for (of, text) in texts.chain(commands) {
                list.add(|| Cell::plain(format!("{name}, {of}")), self.gap_of(&machine.devices, text));
            }
        }
        for error in &self.system.errors {
            list.add(|| self.error_link(error.code), self.gap_of(&error.devices, &error.about));
        }
        for constraint in self.shown_constraints() {
            let question = self.gap_of(&constraint.devices, &constraint.about);
            list.add(|| Cell::plain(&constraint.name), question);
        }
        let rows = list.0.into_iter().map(|(place, question)| Row::of(vec![place, question]));
        let grid = Columns::new()
            .left(self, "place", Word::Place)
            .left(self, "question", Word::OpenQuestion)
            .full(rows.collect());
        let questions = Table::unnumbered("questions-open", "questions", Cell::default(), vec![grid]);
        vec![questions, self.assumptions()]
    }

    /// What the descriptions of a device and of its objects, types and PDOs leave open.
    fn questions_of(&self, device: &Dictionary, list: &mut Questions) {
        let on = Devices::one(&device.key);
        list.add(|| Cell::plain(&device.name), self.gap_of(&on, &device.about));
        for object in device.objects.values() {
            let place = || {
                let name = format!("{} {}", object.index, object.name);
                self.link_on(&on, object.index, name, object_anchor(object.index))
            };
            list.add(place, self.gap_of(&on, &object.about));
            for entry in &object.entries {
                let id = EntryId { index: object.index, sub: entry.sub };
                let place = || {
                    let name = device.entry_name(id).unwrap_or_default();
                    self.link_on(&on, id.index, format!("{id} {name}"), entry_anchor(id))
                };
                // The only entry of a VAR has the description of the object.
                if object.is_structured() {
                    list.add(place, self.gap_of(&on, &entry.about));
                }
                if let Some(named) = &entry.named_type {
                    self.questions_of_type(&on, named, list);
                }
            }
        }
        for pdo in &device.pdos {
            let name = format!("{} {}", pdo.direction.pdo(), pdo.number);
            list.add(|| Cell::plain(name), self.gap_of(&on, &pdo.about));
        }
    }

    fn questions_of_type(&self, on: &Devices, named: &NamedType, list: &mut Questions) {
        let mut add = |what: &str, text: &Text| {
            let place = || Cell::plain([&*named.name, what].join(" ").trim_end());
            list.add(place, self.gap_of(on, text));
        };
        add("", &named.about);
        match &named.kind {
            TypeKind::Enum(values) => values.iter().for_each(|value| add(&value.name, &value.about)),
            TypeKind::Bits(fields) => {
                for field in fields {
                    add(&field.name, &field.about);
                    field.values.iter().for_each(|value| add(&value.name, &value.about));
                    field.modes.iter().for_each(|mode| add(&mode.name, &mode.about));
                }
            }
        }
    }

    fn gap_of(&self, on: &Devices, text: &Text) -> Option<Cell> {
        Some(self.text_on(on, text.gap()?))
    }

    /// The facts that neither the manual nor a standard states, with what is assumed.
    fn assumptions(&self) -> Table {
        let errata = self.system.errata.iter().enumerate().filter(|(_, erratum)| self.is_about(erratum));
        let rows = errata.filter_map(|(at, erratum)| {
            let unprinted = erratum.unprinted.as_ref().filter(|one| one.basis == Basis::Assumption)?;
            let facts: Vec<&str> = unprinted.facts.iter().map(|fact| self.wording.fact(*fact)).collect();
            let places: Vec<String> = erratum.at.iter().map(ToString::to_string).collect();
            let view = self.erratum(at);
            Some(Row::of(vec![
                self.linked(&erratum.devices, &places.join(", "), ""),
                Cell::plain(facts.join(", ")),
                view.reads,
                view.because,
            ]))
        });
        let grid = Columns::new()
            .left(self, "entries", Word::ElementsOf)
            .left(self, "kind", Word::Kind)
            .left(self, "reads", Word::Assumed)
            .left(self, "because", Word::Because)
            .grid(rows.collect(), &["kind", "reads"]);
        let title = Cell::plain(self.word(Word::AssumedFacts));
        Table::unnumbered("questions-assumed", "questions", title, vec![grid])
    }
}
