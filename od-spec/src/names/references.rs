//! What the scalars of a text refer to.

use super::collector::{At, Collector};
use super::conditions;
use super::known::{Known, Scope};
use super::resolved::Resolved;
use super::settings::{is_settings, is_unlock};
use super::walk::{Role, Step, Visitor, keys_of, walk};
use super::{By, DefinitionId, DeviceKeys, Kind, Reference};
use crate::decode::lexical;
use crate::eds::file_name;
use crate::expr::Expr;
use crate::keys::{COMMAND, KeyKind, NameOf, PART, SIGNAL, SPEC, Shape};
use crate::model::{DataType, EntryId, SubIndex, System};
use crate::order::Arrange as _;
use crate::source::{FileId, SourceMap, Spanned};
use crate::yaml::Node;

/// Reads all references, by place.
pub(super) fn collect<'t>(
    sources: &SourceMap,
    root: FileId,
    trees: &[(FileId, &'t Node)],
    known: &Known<'t>,
    system: Option<&System>,
    devices: &DeviceKeys,
) -> Vec<Reference> {
    let resolved = Resolved::of(system);
    let mut all = Collector::new(sources, known, &resolved, devices);
    for (file, tree) in trees {
        let keys = keys_of(tree);
        // A file that wrongly calls itself a part was reported.
        walk(tree, if keys.name == PART.name && !file.is_one_with(root) { &SPEC } else { keys }, &mut all);
    }
    let mut found = all.into_found();
    found.arrange_by_key(|one| (one.span, one.range.start));
    found
}

impl<'t> Visitor<'t> for Collector<'_, 't> {
    fn scalar(&mut self, text: Spanned<&'t str>, role: Role, path: &[Step<'t>]) {
        let at = At { text, path };
        match role {
            Role::Key(KeyKind::Device) => self.device(at),
            Role::Key(KeyKind::DeviceKey) => self.device_of_plant(at),
            Role::Key(KeyKind::Name) if is_settings(path) => self.setting_key(at),
            Role::FeatureKey | Role::Value(Shape::Feature) => self.feature(at),
            Role::DefaultKey if matches!(path, [.., Step::Item { .. }, Step::Data { .. }]) => self.value(at),
            Role::DefaultKey => self.device(at),
            Role::Value(shape) => self.of_shape(at, shape),
            Role::Key(_) => {}
        }
    }
}

impl<'t> Collector<'_, 't> {
    fn of_shape(&mut self, at: At<'_, 't>, shape: Shape) {
        match shape {
            Shape::NameOf(of) => self.name_of(at, of),
            Shape::Type => self.type_name(at),
            Shape::Entry | Shape::Entries => self.entry(at),
            Shape::Index => {
                let before = self.len();
                let index = lexical::index(at.text.value);
                let targets = index.map(|index| self.objects(at, index)).unwrap_or_default();
                self.whole(at, Kind::Object, By::Number, targets);
                if let Some(index) = index {
                    self.are(before, EntryId { index, sub: SubIndex(0) });
                }
            }
            Shape::ErrorCode => self.errors(at),
            Shape::Condition if self.is_new(at) => conditions::condition(self, at),
            Shape::Formula if self.is_new(at) => {
                let term = Expr::parse_term(at.text.value).ok();
                for (entry, range) in
                    term.iter().flat_map(|term| term.entries().into_iter().zip(term.places.iter().cloned()))
                {
                    self.numbered(at, (entry.id.index, entry.id.sub), range, &[]);
                }
            }
            Shape::Value | Shape::Default => self.value(at),
            Shape::Setting => self.setting_value(at),
            Shape::Text if is_unlock(at.path) => self.setting_key(at),
            Shape::Integer(..)
                if at
                    .maps()
                    .next()
                    .is_some_and(|(_, keys, key)| keys.name == COMMAND.name && key == "transitions") =>
            {
                self.of_machine(at, Kind::Transition, By::Number);
            }
            _ => {}
        }
    }

    fn name_of(&mut self, at: At<'_, 't>, of: NameOf) {
        let text = at.text.value;
        let everywhere = |kind| self.known.named(kind, Scope::Everywhere, text, at.file());
        match of {
            NameOf::Unit => self.whole(at, Kind::Unit, By::Name, everywhere(Kind::Unit)),
            NameOf::NamedType => self.whole(at, Kind::Type, By::Name, everywhere(Kind::Type)),
            NameOf::DataType => self.whole(at, Kind::Type, By::Word, None),
            NameOf::Library => self.whole(at, Kind::Library, By::Name, everywhere(Kind::Library)),
            NameOf::LibraryFile | NameOf::File => {
                let file = self.known.named(Kind::File, Scope::Everywhere, file_name(text), at.file());
                let kind = if of == NameOf::File { Kind::File } else { Kind::Library };
                self.whole(at, kind, By::Word, file);
            }
            NameOf::Device => self.device(at),
            NameOf::Feature => self.feature(at),
            NameOf::Bit => {
                let by = if crate::scalar::integer(text).is_ok() { By::Number } else { By::Name };
                let owner = at
                    .beside("type")
                    .and_then(Node::text)
                    .and_then(|name| self.type_of(name.value, at.file()));
                let bit =
                    owner.and_then(|owner| self.known.named(Kind::Bit, Scope::In(owner), text, at.file()));
                self.whole(at, Kind::Bit, by, bit);
            }
            NameOf::State if matches!(text, "start" | "any") => self.whole(at, Kind::State, By::Word, None),
            NameOf::State => self.of_machine(at, Kind::State, By::Name),
            NameOf::Machine => self.whole(at, Kind::Machine, By::Name, everywhere(Kind::Machine)),
            NameOf::Constraint => self.whole(at, Kind::Constraint, By::Name, everywhere(Kind::Constraint)),
            NameOf::Errors if text == "all" => self.whole(at, Kind::Error, By::Word, None),
            NameOf::Errors => self.errors(at),
            NameOf::Block | NameOf::Mark => {
                let (kind, key) = match of {
                    NameOf::Mark => (Kind::Mark, "axis"),
                    _ => (Kind::Block, "flow"),
                };
                let picture = at.around(key).map(|content| Scope::At(content.span));
                let found = picture.and_then(|scope| self.known.named(kind, scope, text, at.file()));
                self.whole(at, kind, By::Name, found);
            }
        }
    }

    fn device(&mut self, at: At<'_, 't>) {
        let device = self.known.named(Kind::Device, Scope::Everywhere, at.text.value, at.file());
        self.whole(at, Kind::Device, By::Name, device);
    }

    fn feature(&mut self, at: At<'_, 't>) {
        let feature = self.known.named(Kind::Feature, Scope::Everywhere, at.text.value, at.file());
        self.whole(at, Kind::Feature, By::Name, feature);
    }

    fn errors(&mut self, at: At<'_, 't>) {
        let codes = lexical::error_codes(at.text.value);
        let found = codes.map(|codes| self.known.errors(codes.first, codes.last, at.file()));
        self.whole(at, Kind::Error, By::Number, found.unwrap_or_default());
    }

    fn type_name(&mut self, at: At<'_, 't>) {
        match DataType::from_name(at.text.value) {
            Some(_) => self.whole(at, Kind::Type, By::Word, None),
            None => {
                let found = self.type_of(at.text.value, at.file());
                self.whole(at, Kind::Type, By::Name, found);
            }
        }
    }

    /// Something of the state machine around: the maker's, or that of the library that it lies over.
    fn of_machine(&mut self, at: At<'_, 't>, kind: Kind, by: By) {
        let machine = at.path.iter().find_map(|step| match step {
            Step::Data { kind: KeyKind::Name, name, .. } => Some(name.value.as_str()),
            Step::Data { .. } | Step::Key { .. } | Step::Item { .. } => None,
        });
        let machine = machine.unwrap_or_default();
        let machines = self.known.all_named(Kind::Machine, Scope::Everywhere, machine);
        let is_in_file = |id: &&DefinitionId| self.known.definition(**id).span.file.is_one_with(at.file());
        let in_order = machines.iter().filter(is_in_file).chain(machines.iter().filter(|id| !is_in_file(id)));
        let mut found =
            in_order.filter_map(|id| self.known.named(kind, Scope::In(*id), at.text.value, at.file()));
        let found = found.next();
        self.whole(at, kind, by, found);
    }

    /// The name of a value or bit, where the type is a named one; a number names nothing.
    fn value(&mut self, at: At<'_, 't>) {
        if let Some(owner) = self.type_around(at) {
            self.value_of(at, owner);
        }
    }

    /// The name of a value or bit of a type.
    pub(super) fn value_of(&mut self, at: At<'_, 't>, owner: DefinitionId) {
        let of = |kind| self.known.named(kind, Scope::In(owner), at.text.value, at.file());
        // `{mode: homing}`: a value of a run of bits.
        let run = match at.path {
            [.., Step::Item { .. }, Step::Data { name, .. }] if name.span != at.text.span => {
                self.known.named(Kind::Bit, Scope::In(owner), &name.value, at.file())
            }
            _ => None,
        };
        if let Some(run) = run {
            let value = self.known.named(Kind::Value, Scope::In(run), at.text.value, at.file());
            if value.is_some() {
                self.whole(at, Kind::Value, By::Name, value);
            }
        } else if let Some(value) = of(Kind::Value) {
            self.whole(at, Kind::Value, By::Name, Some(value));
        } else if let Some(bit) = of(Kind::Bit) {
            self.whole(at, Kind::Bit, By::Name, Some(bit));
        }
    }

    /// The named type, or the run of bits, that a value is of.
    fn type_around(&self, at: At<'_, 't>) -> Option<DefinitionId> {
        let named = |node: &Node| self.type_of(node.text()?.value, at.file());
        for (map, keys, _) in at.maps() {
            if keys.name == SIGNAL.name {
                let owner = map.get("type").and_then(named)?;
                let bit = map.get("bit").and_then(Node::text)?;
                return self.known.named(Kind::Bit, Scope::In(owner), bit.value, at.file());
            }
            if let Some(node) = map.get("type").filter(|_| keys.get("type").is_some()) {
                return named(node);
            }
        }
        let name = self.resolved.type_of_value(at.text.span)?;
        self.type_of(name, at.file())
    }

    /// An entry by index or by name, or a run of entries, or a data type that fills a PDO.
    fn entry(&mut self, at: At<'_, 't>) {
        let text = at.text.value;
        if !self.is_new(at) {
            return;
        }
        let devices = at.devices();
        if let Some(run) = lexical::run_by_index(text) {
            self.numbered_run(at, (run.index, run.subs.first, run.subs.last), 0..text.len(), &devices);
        } else if let Some(one) = lexical::entry_by_index(text) {
            let id = one.id();
            self.numbered_run(at, (id.index, id.sub, id.sub), 0..text.len(), &devices);
        } else if DataType::from_name(text).is_some()
            && at.maps().next().is_some_and(|(_, _, key)| key == "map")
        {
            self.add(at, 0..text.len(), Kind::Type, By::Word, Vec::new());
        } else {
            self.named_entry(at, 0..text.len(), text, &devices);
        }
    }
}
