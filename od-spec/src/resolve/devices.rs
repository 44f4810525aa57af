//! Devices and their dictionaries.

use std::collections::BTreeMap;

use super::decls::{self, Declared};
use super::entries::{self, EdsDefaults, Surroundings};
use super::refs::Broken;
use super::scope::{Scope, unknown};
use super::types::words;
use super::{objects, pdos, refs, to_u8, to_u16, to_u32};
use crate::ast::{DeviceDecl, Name, Spec};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{
    AccessRight, Alias, DataType, Date, DateTime, DeviceInfo, Dictionary, Entry, EntryId, Fact, Facts,
    FileInfo, Index, Object, ObjectKind, Outside, PdoMapping, Ratio, Role, Rounding, Statement, Storage,
    SubIndex, Value, Vendor, convert,
};
use crate::source::{Span, Spanned};

pub(super) fn resolve(
    root: &Spec,
    libraries: &[Spec],
    scope: &Scope,
    vendor: &Vendor,
    diagnostics: &mut Diagnostics,
) -> (Vec<Dictionary>, Broken) {
    check_device_keys(root, diagnostics);
    let mut broken = Broken::default();
    let dictionaries = root
        .devices
        .iter()
        .map(|device| {
            let mut built = Builder {
                around: Surroundings {
                    scope,
                    file: root.file,
                    eds: EdsDefaults::of(device.eds_defaults.as_ref().map(|word| word.value.as_str())),
                },
                objects: BTreeMap::new(),
                broken: Broken::default(),
            };
            let declared = decls::of_device(root, libraries, device, scope, diagnostics);
            built.left_out(root, device, &declared);
            built.plain_objects(&declared, diagnostics);
            built.aliases(&declared, diagnostics);
            let info = info(device, diagnostics);
            built.identity(device, &info, vendor);
            let list =
                root.pdos.iter().find(|(key, _)| key.value == device.key.value).map_or(&[][..], |(_, l)| l);
            let pdos = pdos::resolve(list, &info, &mut built.objects, &mut built.broken, diagnostics);
            broken.append(built.broken);
            Dictionary {
                key: device.key.value.clone(),
                name: device.name.as_ref().map_or(String::new(), |name| name.value.clone()),
                file: file(device, vendor),
                info,
                about: words(&device.about),
                facts: facts(device),
                objects: built.objects,
                pdos,
                span: device.key.span,
            }
        })
        .collect();
    (dictionaries, broken)
}

/// Checks the objects of a library that is compiled by itself: no device will ever ask for them.
pub(super) fn check_library(root: &Spec, libraries: &[Spec], scope: &Scope, diagnostics: &mut Diagnostics) {
    let around = Surroundings { scope, file: root.file, eds: EdsDefaults::Safe };
    for declared in decls::of_library(root, libraries, scope, diagnostics).into_values() {
        if declared.decl.alias.is_none() {
            objects::resolve(&declared, around, diagnostics);
        }
    }
}

/// Every device key that is used must be declared.
fn check_device_keys(root: &Spec, diagnostics: &mut Diagnostics) {
    let known: Vec<&str> = root.devices.iter().map(|device| device.key.value.as_str()).collect();
    let lists = [
        root.objects.iter().filter_map(|decl| decl.on.as_ref()).collect::<Vec<_>>(),
        root.errors.iter().filter_map(|decl| decl.on.as_ref()).collect(),
        root.machines.iter().filter_map(|decl| decl.on.as_ref()).collect(),
        root.constraints.iter().filter_map(|decl| decl.on.as_ref()).collect(),
        root.errata.iter().filter_map(|decl| decl.on.as_ref()).collect(),
    ];
    let used = lists.into_iter().flatten().flatten().chain(root.pdos.iter().map(|(key, _)| key));
    for key in used.filter(|key| !known.contains(&key.value.as_str())) {
        diagnostics.push(unknown(
            codes::UNKNOWN_DEVICE,
            key,
            "device",
            known.iter().copied(),
            "define it under `devices:`",
        ));
    }
}

struct Builder<'a> {
    around: Surroundings<'a>,
    objects: BTreeMap<Index, Object>,
    broken: Broken,
}

impl Builder<'_> {
    /// Remembers the objects that may be meant for the device, but whose library or device is unknown.
    fn left_out(&mut self, root: &Spec, device: &DeviceDecl, declared: &BTreeMap<Index, Declared<'_>>) {
        let known = |key: &Name| root.devices.iter().any(|device| device.key.value == key.value);
        for decl in root.objects.iter().filter(|decl| !declared.contains_key(&decl.index.value)) {
            let meant = |on: &Vec<Name>| on.iter().any(|key| key.value == device.key.value || !known(key));
            if decl.on.as_ref().is_none_or(meant) {
                self.broken.add(decl.index.value, decl.entry.name.as_ref());
            }
        }
    }

    fn plain_objects(&mut self, declared: &BTreeMap<Index, Declared<'_>>, diagnostics: &mut Diagnostics) {
        for (index, one) in declared.iter().filter(|(_, one)| one.decl.alias.is_none()) {
            if Role::of(*index).is_pdo_parameter() {
                diagnostics.push(
                    Diagnostic::new(
                        codes::PDO_BY_HAND,
                        one.decl.index.span,
                        format!("{index} is a PDO parameter object"),
                    )
                    .help("describe the PDO under `pdos:`; its objects are made from that"),
                );
                continue;
            }
            let (errors, _) = diagnostics.count();
            if let Some(object) = objects::resolve(one, self.around, diagnostics) {
                self.objects.insert(*index, object);
            }
            // An object may stand there without the entries that are wrong.
            if diagnostics.count().0 > errors || !self.objects.contains_key(index) {
                self.broken.add(*index, one.decl.entry.name.as_ref());
            }
        }
    }

    fn aliases(&mut self, declared: &BTreeMap<Index, Declared<'_>>, diagnostics: &mut Diagnostics) {
        let names = refs::Names::new(self.objects.values());
        for (index, one) in declared {
            let Some(reference) = &one.decl.alias else { continue };
            if let Some(target) = alias_named(reference, declared) {
                diagnostics.push(
                    Diagnostic::new(
                        codes::ALIAS_OF_ALIAS,
                        reference.span,
                        format!("{} is an alias itself", target.value),
                    )
                    .with(target.span, "an alias")
                    .help("refer to the entry that holds the value"),
                );
                self.broken.add(*index, one.decl.entry.name.as_ref());
                continue;
            }
            let found = names.find(reference, |id| self.entry(id).is_some(), &self.broken, diagnostics);
            match found.and_then(|id| self.alias(one, reference, id, diagnostics)) {
                Some(object) => {
                    self.objects.insert(*index, object);
                }
                None => self.broken.add(*index, one.decl.entry.name.as_ref()),
            }
        }
    }

    fn entry(&self, id: EntryId) -> Option<&Entry> {
        self.objects.get(&id.index)?.entry(id.sub)
    }

    fn alias(
        &self,
        one: &Declared<'_>,
        reference: &Name,
        id: EntryId,
        diagnostics: &mut Diagnostics,
    ) -> Option<Object> {
        let decl = &one.decl;
        if decl.from.is_some() {
            // Reported where the library's object was laid under.
            return None;
        }
        let target_object = self.objects.get(&id.index)?;
        let target = target_object.entry(id.sub)?;
        let own = [
            decl.array.as_ref().map(|array| array.span),
            decl.record.as_ref().map(|record| record.span),
            decl.entry.stored.map(|stored| stored.span),
            decl.entry.default.as_ref().map(|default| default.span),
        ];
        if let Some(place) = own.into_iter().flatten().next() {
            diagnostics.push(
                Diagnostic::new(
                    codes::CONFLICTING_KEYS,
                    place,
                    "an alias has no storage or value of its own",
                )
                .with(reference.span, "its target")
                .help("remove `array`, `record`, `stored` and `default`; they are the target's"),
            );
            return None;
        }
        let mut whole = decl.entry.clone();
        let access = whole.access.get_or_insert(Spanned::new(
            AccessRight { access: target.access, locked: target.locked },
            reference.span,
        ));
        if access.value.access.is_writable() && !target.access.is_writable() {
            diagnostics.push(
                Diagnostic::new(
                    codes::BAD_ALIAS,
                    access.span,
                    format!("{id} is `{}`: its alias cannot be written", target.access.word()),
                )
                .with(target.span, "the target")
                .help("remove `access:`; an alias follows its target"),
            );
            return None;
        }
        // A lock on the target also locks its views.
        access.value.locked |= target.locked && access.value.access.is_writable();
        let mapping = match (access.value.access.is_writable(), target.pdo) {
            (false, PdoMapping::Both) => PdoMapping::Transmit,
            (false, PdoMapping::Receive) => PdoMapping::None,
            (_, mapping) => mapping,
        };
        whole.pdo.get_or_insert(Spanned::new(mapping, reference.span));
        if let Some(unit) = &target.unit {
            whole.unit.get_or_insert_with(|| Spanned::new(unit.name.clone(), reference.span));
        }
        let target_name = if target_object.is_structured() {
            format!("{} {}", target_object.name, target.name)
        } else {
            target_object.name.clone()
        };
        let (data_type, _) = entries::entry_type(&whole, self.around.scope, diagnostics)?;
        let default_name = format!("{target_name} {}bit", data_type.bits().unwrap_or_default());
        let name = whole.name.as_ref().map_or(default_name, |name| name.value.clone());
        let mut entry = entries::resolve(&whole, SubIndex(0), name.clone(), self.around, diagnostics)?;
        let factor = check_alias(&entry, decl.entry.type_name.as_ref(), target, id, reference, diagnostics)?;
        if entry.writable_when.is_none() && entry.access.is_writable() {
            entry.writable_when.clone_from(&target.writable_when);
        }
        let alias = Alias {
            target: id,
            factor,
            rounding: decl.rounding.map_or(Rounding::Down, |rounding| rounding.value),
            outside: decl.outside.map_or(Outside::Saturate, |outside| outside.value),
        };
        // A default that the alias cannot show as it is would be another value.
        let show = |raw: i128| convert(raw, alias.factor, alias.rounding, Outside::Abort, entry.data_type);
        let shown = match &target.default {
            Some(Value::Integer(raw)) => show(*raw).map(Value::Integer),
            Some(Value::NodeId(_) | Value::Real(_) | Value::Text(_) | Value::Bytes(_)) | None => None,
        };
        entry.set_default(shown, Statement::derived(decl.index.span));
        if factor == Ratio::ONE {
            follow_values(&mut entry, target);
        }
        entry.eds = entries::alias_policy(&entry, target, &decl.entry, self.around.eds);
        entry.stored = Storage::No;
        entry.alias = Some(alias);
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
            about: words(&decl.entry.about),
            entries: vec![entry],
            span: decl.index.span,
        })
    }

    /// Fills in what the device itself decides: 1000h, 1008h, 1018h.
    fn identity(&mut self, device: &DeviceDecl, info: &DeviceInfo, vendor: &Vendor) {
        let numbers = [
            (0x1000, 0, info.device_type),
            (0x1018, 1, vendor.number),
            (0x1018, 2, info.product),
            (0x1018, 3, info.product_revision),
        ];
        let numbers = numbers.map(|(index, sub, number)| (index, sub, Value::Integer(i128::from(number))));
        let name = [(0x1008, 0, Value::Text(info.product_name.clone()))];
        for (index, sub, value) in numbers.into_iter().chain(name) {
            let entry = self
                .objects
                .get_mut(&Index(index))
                .and_then(|object| object.entries.iter_mut().find(|entry| entry.sub == SubIndex(sub)));
            if let Some(entry) = entry.filter(|entry| entry.default.is_none()) {
                entry.set_default(Some(value), Statement::derived(device.key.span));
            }
        }
    }
}

/// The alias that a reference names, by index or by name.
fn alias_named(reference: &Name, declared: &BTreeMap<Index, Declared<'_>>) -> Option<Spanned<Index>> {
    let by_index = crate::decode::lexical::entry_by_index(&reference.value).map(|entry| entry.index);
    let mut aliases = declared.values().map(|one| &one.decl).filter(|decl| decl.alias.is_some());
    let is_named = |name: &Option<Name>| name.as_ref().is_some_and(|name| name.value == reference.value);
    let named =
        aliases.find(|decl| by_index.map_or(is_named(&decl.entry.name), |index| decl.index.value == index));
    named.map(|decl| decl.index)
}

/// Where the raw values are the same, limits and special values of the target are those of the alias, as far as its
/// type can show them.
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
fn check_alias(
    alias: &Entry,
    type_name: Option<&Name>,
    target: &Entry,
    id: EntryId,
    reference: &Name,
    diagnostics: &mut Diagnostics,
) -> Option<Ratio> {
    let place = type_name.map_or(reference.span, |name| name.span);
    let mut refuse = |message: String, help: &str| {
        diagnostics.push(
            Diagnostic::new(codes::BAD_ALIAS, place, message)
                .with(reference.span, "its target")
                .help(help.to_owned()),
        );
        None
    };
    let (own, other) = (alias.data_type, target.data_type);
    if !own.is_integer() || !other.is_integer() {
        return refuse(
            format!("{own} cannot show {id}, which is {other}"),
            "an alias and its target are integers",
        );
    }
    if own.is_signed() != other.is_signed() {
        return refuse(
            format!("{own} cannot show {id}, which is {other}: one has a sign, the other has not"),
            "take a type with the same sign as the target",
        );
    }
    let rescaled = alias.unit.is_some() && alias.unit != target.unit;
    let (width, target_width) = (own.bits().unwrap_or(0), other.bits().unwrap_or(0));
    if width > target_width || (width == target_width && !rescaled) {
        return refuse(
            format!("{own} is not narrower than {id}, which is {other}"),
            "an alias shows its target in a narrower type, or in another unit",
        );
    }
    if !rescaled {
        return Some(Ratio::ONE);
    }
    let factor = match (entries::step(alias.unit.as_ref()), entries::step(target.unit.as_ref())) {
        (Some((symbol, step)), Some((target_symbol, target_step))) if symbol == target_symbol => {
            target_step.checked_div(step)
        }
        _ => None,
    };
    factor.or_else(|| {
        refuse(
            format!(
                "the alias is in {}, its target in {}: they do not convert",
                unit_name(alias),
                unit_name(target)
            ),
            "give both units the same `base`, or leave out the alias' unit",
        )
    })
}

/// Where the facts about a device stand.
fn facts(device: &DeviceDecl) -> Facts {
    let rates = device.bit_rates.iter().map(|rate| rate.span).reduce(Span::to);
    let granularity = device.granularity.map(|granularity| granularity.span);
    let stated = [(Fact::BitRates, rates), (Fact::Granularity, granularity)];
    let written =
        |(fact, span): (Fact, Option<Span>)| Some((fact, Statement::written(span?, device.key.span.file)));
    stated.into_iter().filter_map(written).collect()
}

fn unit_name(entry: &Entry) -> String {
    entry.unit.as_ref().map_or("no unit".to_owned(), |unit| format!("`{}`", unit.name))
}

fn info(device: &DeviceDecl, diagnostics: &mut Diagnostics) -> DeviceInfo {
    let text = |name: &Option<Name>| name.as_ref().map(|name| name.value.clone());
    let number = |value: &Option<Spanned<i128>>| value.as_ref().map_or(0, |value| to_u32(value.value));
    let flag = |value: &Option<Spanned<bool>>, unless: bool| value.as_ref().map_or(unless, |v| v.value);
    let product_name = text(&device.product_name).or_else(|| text(&device.name)).unwrap_or_default();
    // A number outside the key's range was refused where it was read.
    let readable = device.bit_rates.iter().filter(|rate| (10..=1000).contains(&rate.value));
    let mut bit_rates: Vec<u16> = readable.map(|rate| to_u16(rate.value)).collect();
    bit_rates.sort_unstable();
    bit_rates.dedup();
    let mut dummies = Vec::new();
    for name in &device.dummies {
        match DataType::from_name(&name.value).filter(|data_type| data_type.is_dummy()) {
            Some(data_type) => dummies.push(data_type),
            None => {
                let known = DataType::ALL.into_iter().filter(|t| t.is_dummy()).map(DataType::name);
                let otherwise = "placeholders are boolean, integer8/16/32 and unsigned8/16/32";
                diagnostics.push(unknown(codes::UNKNOWN_TYPE, name, "placeholder type", known, otherwise));
            }
        }
    }
    dummies.sort_by_key(|data_type| data_type.code());
    dummies.dedup();
    DeviceInfo {
        order_code: text(&device.order_code).unwrap_or_else(|| product_name.clone()),
        product_name,
        product: number(&device.product),
        product_revision: number(&device.product_revision),
        bit_rates,
        device_type: number(&device.device_type),
        granularity: device.granularity.as_ref().map_or(8, |value| to_u8(value.value)),
        boot_up_master: flag(&device.boot_up_master, false),
        boot_up_slave: flag(&device.boot_up_slave, true),
        group_messaging: flag(&device.group_messaging, false),
        lss: flag(&device.lss, false),
        dummies,
    }
}

fn file(device: &DeviceDecl, vendor: &Vendor) -> FileInfo {
    let eds = device.eds.as_ref();
    let text = |name: Option<&Name>| name.map(|name| name.value.clone());
    // An EDS must have dates; a specification without them gets a fixed one, so that output never depends on the day.
    let epoch = DateTime { date: Date { year: 2000, month: 1, day: 1 }, hour: 0, minute: 0 };
    let created = eds.and_then(|eds| eds.created).map_or(epoch, |created| created.value);
    let created_by = text(eds.and_then(|eds| eds.created_by.as_ref())).unwrap_or_else(|| vendor.name.clone());
    FileInfo {
        description: text(eds.and_then(|eds| eds.description.as_ref()))
            .or_else(|| text(device.name.as_ref()))
            .unwrap_or_default(),
        created,
        modified: eds.and_then(|eds| eds.modified).map_or(created, |modified| modified.value),
        modified_by: text(eds.and_then(|eds| eds.modified_by.as_ref())).unwrap_or_else(|| created_by.clone()),
        created_by,
        version: eds.and_then(|eds| eds.version).map_or(1, |version| to_u8(version.value)),
        revision: eds.and_then(|eds| eds.revision).map_or(0, |revision| to_u8(revision.value)),
    }
}
