//! Aliases: entries that show another entry in a narrower type or another unit, with no storage of their own. What the
//! declaration leaves open follows from the target.

use std::collections::BTreeMap;

use super::declared::Declared;
use super::entries;
use super::keys_have_effect::refuse as refuse_key;
use super::refs::{Broken, Names};
use super::surroundings::Surroundings;
use super::types::with_gap;
use crate::ast::{EntryDecl, Name};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{
    AccessRight, Alias, DataType, Entry, EntryId, Fact, Index, Object, ObjectKind, Outside, PdoMapping,
    Ratio, Rounding, Statement, Storage, SubIndex, Value, convert,
};
use crate::source::Spanned;

/// Adds the aliases of a device to its objects.
pub(super) fn resolve(
    declared: &BTreeMap<Index, Declared<'_>>,
    around: Surroundings<'_>,
    objects: &mut BTreeMap<Index, Object>,
    broken: &mut Broken,
    diagnostics: &mut Diagnostics,
) {
    let known = Known::of(declared, objects);
    let mut made = Vec::new();
    for (index, one) in declared {
        let Some(reference) = &one.decl.alias else { continue };
        let object = target(reference, &known, broken, diagnostics)
            .and_then(|target| alias(one, &target, around, diagnostics));
        match object {
            Some(object) => made.push((*index, object)),
            None => broken.add(*index, one.decl.entry.names()),
        }
    }
    objects.extend(made);
}

/// What a reference can name.
struct Known<'a> {
    objects: &'a BTreeMap<Index, Object>,
    names: Names<'a>,
    /// The aliases, which it may not name.
    aliases: BTreeMap<Index, Spanned<Index>>,
    aliases_by_name: BTreeMap<&'a str, Spanned<Index>>,
}

impl<'a> Known<'a> {
    fn of(declared: &'a BTreeMap<Index, Declared<'_>>, objects: &'a BTreeMap<Index, Object>) -> Self {
        let mut known = Self {
            objects,
            names: Names::new(objects.values()),
            aliases: BTreeMap::new(),
            aliases_by_name: BTreeMap::new(),
        };
        for (index, one) in declared.iter().filter(|(_, one)| one.decl.alias.is_some()) {
            known.aliases.insert(*index, one.decl.index);
            for name in one.decl.entry.names() {
                known.aliases_by_name.entry(name.value.as_str()).or_insert(one.decl.index);
            }
        }
        known
    }

    /// The alias that a reference names, by index or by name.
    fn alias(&self, reference: &Name) -> Option<Spanned<Index>> {
        match crate::decode::lexical::entry_by_index(&reference.value) {
            Some(entry) => self.aliases.get(&entry.index).copied(),
            None => self.aliases_by_name.get(reference.value.as_str()).copied(),
        }
    }
}

/// The entry that an alias shows.
struct Target<'a> {
    /// How the specification names it.
    reference: &'a Name,
    id: EntryId,
    object: &'a Object,
    entry: &'a Entry,
}

impl Target<'_> {
    /// Its name: the object's, with the entry's in an array or record.
    fn name(&self) -> String {
        if self.object.is_structured() {
            format!("{} {}", self.object.name, self.entry.name)
        } else {
            self.object.name.clone()
        }
    }
}

/// Finds what a reference names, which may be no alias itself.
fn target<'a>(
    reference: &'a Name,
    known: &Known<'a>,
    broken: &Broken,
    diagnostics: &mut Diagnostics,
) -> Option<Target<'a>> {
    if let Some(alias) = known.alias(reference) {
        diagnostics.push(
            Diagnostic::new(
                codes::ALIAS_OF_ALIAS,
                reference.span,
                format!("{} is an alias itself", alias.value),
            )
            .with(alias.span, "an alias")
            .help("refer to the entry that holds the value"),
        );
        return None;
    }
    let find =
        |id: EntryId| known.objects.get(&id.index).and_then(|object| Some((object, object.entry(id.sub)?)));
    let id = known.names.find(reference, |id| find(id).is_some(), broken, diagnostics)?;
    let (object, entry) = find(id)?;
    Some(Target { reference, id, object, entry })
}

/// The object that a declaration makes with its target.
fn alias(
    one: &Declared<'_>,
    target: &Target<'_>,
    around: Surroundings<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Object> {
    let decl = &one.decl;
    // An alias `from:` a library was reported where the library's object was laid under.
    if decl.from.is_some() || has_value_of_its_own(one, target, diagnostics) {
        return None;
    }
    let whole = completed(&decl.entry, target, diagnostics)?;
    let typed = entries::entry_type(&whole, around.scope, diagnostics)?;
    let bits = typed.data_type.bits().unwrap_or_default();
    let name =
        whole.name.as_ref().map_or_else(|| format!("{} {bits}bit", target.name()), |name| name.value.clone());
    let mut entry = entries::resolve(&whole, SubIndex(0), name.clone(), around, diagnostics)?;
    let alias = Alias {
        target: target.id,
        factor: factor(&entry, decl.entry.type_name.as_ref(), target, diagnostics)?,
        rounding: decl.rounding.map_or(Rounding::Down, |rounding| rounding.value),
        outside: decl.outside.map_or(Outside::Saturate, |outside| outside.value),
    };
    if let Some(outside) = decl.outside.filter(|_| shows_all(entry.data_type, alias.factor, target)) {
        refuse_key(
            "outside",
            outside.span,
            "no value lies outside the view",
            "remove it; the view shows all that its target can have",
            diagnostics,
        );
    }
    follow(&mut entry, &alias, &decl.entry, target);
    if entry.search.is_empty() {
        entry.search.clone_from(&target.entry.search);
    }
    entry.eds = entries::alias_policy(&entry, target.entry, &decl.entry, around.eds);
    entry.alias = Some(alias);
    entry.facts.state(Fact::Alias, Statement::written(target.reference.span, around.file));
    Some(Object {
        index: decl.index.value,
        name,
        identifier: entry.identifier.clone(),
        kind: ObjectKind::Var,
        origin: one.origin,
        profile: one.profile.clone(),
        departures: one.departures.clone(),
        category: decl.entry.category.map(|category| category.value),
        since: decl.entry.since.as_ref().map(|since| since.value.clone()),
        links: decl.links.clone().unwrap_or_default(),
        editor: decl.editor.clone(),
        warning: entry.warning.clone(),
        about: with_gap(&decl.entry.about, &decl.entry.gap),
        search: entry.search.clone(),
        entries: vec![entry],
        span: decl.index.span,
    })
}

/// Whether a view of a type shows every value of the type of its target.
fn shows_all(shown: DataType, factor: Ratio, target: &Target<'_>) -> bool {
    let shows = |raw: i128| {
        convert(raw, factor, Rounding::Up, Outside::Abort, shown).is_some()
            && convert(raw, factor, Rounding::Down, Outside::Abort, shown).is_some()
    };
    target.entry.data_type.range().is_some_and(|(low, high)| shows(low) && shows(high))
}

/// Reports what an alias cannot have.
fn has_value_of_its_own(one: &Declared<'_>, target: &Target<'_>, diagnostics: &mut Diagnostics) -> bool {
    let decl = &one.decl;
    let keys = [
        decl.array.as_ref().map(|array| array.span),
        decl.record.as_ref().map(|record| record.span),
        decl.entry.stored.map(|stored| stored.span),
        decl.entry.default.as_ref().map(|default| default.span),
    ];
    let Some(place) = keys.into_iter().flatten().next() else { return false };
    diagnostics.push(
        Diagnostic::new(codes::CONFLICTING_KEYS, place, "an alias has no storage or value of its own")
            .with(target.reference.span, "its target")
            .help("remove `array`, `record`, `stored` and `default`; they are the target's"),
    );
    true
}

/// The declaration with access, mapping and unit of the target where it says nothing about them.
fn completed(decl: &EntryDecl, target: &Target<'_>, diagnostics: &mut Diagnostics) -> Option<EntryDecl> {
    let (id, entry, place) = (target.id, target.entry, target.reference.span);
    let mut whole = decl.clone();
    let follows = AccessRight { access: entry.access, locked: entry.locked };
    let right = whole.access.get_or_insert(Spanned::new(follows, place));
    let (access, of_target) = (right.value.access, entry.access);
    let lacking = if access.is_writable() && !of_target.is_writable() {
        Some("written")
    } else if access.is_readable() && !of_target.is_readable() {
        Some("read")
    } else {
        None
    };
    if let Some(lacking) = lacking {
        diagnostics.push(
            Diagnostic::new(
                codes::BAD_ALIAS,
                right.span,
                format!("{id} is `{}`: its alias cannot be {lacking}", of_target.word()),
            )
            .about((id, Fact::Access))
            .with(entry.span, "the target")
            .help("remove `access:`; an alias follows its target"),
        );
        return None;
    }
    // A lock on the target also locks its views.
    right.value.locked |= entry.locked && right.value.access.is_writable();
    let mapping = match (right.value.access.is_writable(), entry.pdo) {
        (false, PdoMapping::Both) => PdoMapping::Transmit,
        (false, PdoMapping::Receive) => PdoMapping::None,
        (_, mapping) => mapping,
    };
    whole.pdo.get_or_insert(Spanned::new(mapping, place));
    if let Some(unit) = &entry.unit {
        whole.unit.get_or_insert_with(|| Spanned::new(unit.name.clone(), place));
    }
    Some(whole)
}

/// Gives the alias what follows from its target: the default as it shows it, the condition of a write and, where the raw
/// values are the same, limits and special values as far as its type can show them.
fn follow(entry: &mut Entry, alias: &Alias, decl: &EntryDecl, target: &Target<'_>) {
    let derived = Statement::derived(target.reference.span);
    for (fact, is_written) in [
        (Fact::Access, decl.access.is_some()),
        (Fact::Mapping, decl.pdo.is_some()),
        (Fact::Unit, decl.unit.is_some()),
    ] {
        if !is_written && entry.facts.get(fact).is_some() {
            entry.facts.state(fact, derived);
        }
    }
    if entry.writable_when.is_none() && entry.access.is_writable() {
        entry.writable_when.clone_from(&target.entry.writable_when);
    }
    // Writing the alias does the same.
    if entry.warning.is_empty() && entry.access.is_writable() {
        entry.warning.clone_from(&target.entry.warning);
    }
    // A default that the alias cannot show as it is would be another value.
    let show = |raw: i128| convert(raw, alias.factor, alias.rounding, Outside::Abort, entry.data_type);
    let shown = match &target.entry.default {
        Some(Value::Integer(raw)) => show(*raw).map(Value::Integer),
        Some(Value::NodeId(_) | Value::Real(_) | Value::Text(_) | Value::Bytes(_)) | None => None,
    };
    entry.set_default(shown, derived);
    if alias.factor == Ratio::ONE {
        follow_values(entry, target.entry);
    }
    entry.stored = Storage::No;
}

fn follow_values(alias: &mut Entry, target: &Entry) {
    let Some((low, high)) = alias.data_type.range() else { return };
    let shows = |raw: &i128| (low..=high).contains(raw);
    alias.low = alias.low.or(target.low.filter(shows));
    alias.high = alias.high.or(target.high.filter(shows));
    if alias.special.is_empty() {
        alias.special = target.special.iter().filter(|special| shows(&special.value)).cloned().collect();
    }
}

/// Checks that an alias can show its target, and gives the raw factor between them.
fn factor(
    alias: &Entry,
    type_name: Option<&Name>,
    target: &Target<'_>,
    diagnostics: &mut Diagnostics,
) -> Option<Ratio> {
    let (id, shown) = (target.id, target.entry);
    let place = type_name.map_or(target.reference.span, |name| name.span);
    let mut refuse = |message: String, help: &str| {
        diagnostics.push(
            Diagnostic::new(codes::BAD_ALIAS, place, message)
                .with(target.reference.span, "its target")
                .help(help.to_owned()),
        );
        None
    };
    let (view_type, target_type) = (alias.data_type, shown.data_type);
    if !view_type.is_integer() || !target_type.is_integer() {
        return refuse(
            format!("{view_type} cannot show {id}, which is {target_type}"),
            "an alias and its target are integers",
        );
    }
    if view_type.is_signed() != target_type.is_signed() {
        return refuse(
            format!(
                "{view_type} cannot show {id}, which is {target_type}: one has a sign, the other has not"
            ),
            "take a type with the same sign as the target",
        );
    }
    let rescaled = alias.unit.is_some() && alias.unit != shown.unit;
    let (width, target_width) = (view_type.bits().unwrap_or(0), target_type.bits().unwrap_or(0));
    if width > target_width || (width == target_width && !rescaled) {
        return refuse(
            format!("{view_type} is not narrower than {id}, which is {target_type}"),
            "an alias shows its target in a narrower type, or in another unit",
        );
    }
    if !rescaled {
        return Some(Ratio::ONE);
    }
    let units = alias.unit.as_deref().zip(shown.unit.as_deref());
    let units = units.filter(|(unit, of_target)| unit.base_symbol() == of_target.base_symbol());
    if let Some((unit, of_target)) = units
        && unit.offset_in(unit.base_symbol()) != of_target.offset_in(of_target.base_symbol())
    {
        return refuse(
            format!(
                "{} counts from {}, {} from {}: a view multiplies, and adds nothing",
                unit_name(alias),
                unit.show(0),
                unit_name(shown),
                of_target.show(0)
            ),
            "give the alias a unit with the `offset` of its target's, or leave out its unit",
        );
    }
    let factor = units.and_then(|(unit, of_target)| of_target.step()?.checked_div(unit.step()?));
    factor.or_else(|| {
        refuse(
            format!(
                "the alias is in {}, its target in {}: they do not convert",
                unit_name(alias),
                unit_name(shown)
            ),
            "give both units the same `base`, or leave out the alias' unit",
        )
    })
}

fn unit_name(entry: &Entry) -> String {
    entry.unit.as_ref().map_or("no unit".to_owned(), |unit| format!("`{}`", unit.name))
}
