//! Devices and their dictionaries.

use std::collections::{BTreeMap, BTreeSet};

use super::assigned::Assigned;
use super::consumers;
use super::declared::Declared;
use super::decls;
use super::defaults;
use super::libraries::Libraries;
use super::refs::Broken;
use super::scope::{Scope, unknown};
use super::surroundings::{EdsDefaults, Surroundings};
use super::types::with_gap;
use super::{aliases, canopennode, condition_names, device_info, objects, pdos};
use crate::ast::{DeviceDecl, FrontEnd, Name, ObjectDecl, PdosDecl, Spec};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::limits::{DEVICES, ENTRIES_OF_DEVICE, ENTRIES_OF_FILE, Room};
use crate::model::{
    AnyError, DeviceInfo, Dictionary, Facts, Index, Object, Statement, SubIndex, Text, Value, Vendor,
};

pub(super) fn resolve<'a>(
    root: &'a Spec,
    libraries: &Libraries<'a>,
    scope: &Scope,
    vendor: &Vendor,
    diagnostics: &mut Diagnostics,
) -> (Vec<Dictionary>, Broken) {
    check_device_keys(root, diagnostics);
    let assigned = Assigned::of(root);
    let languages = root.shown_languages();
    let mut pdos = BTreeMap::new();
    for (key, decl) in &root.pdos {
        pdos.entry(key.value.as_str()).or_insert(decl);
    }
    let mut broken = Broken::over(assigned.for_nobody());
    let mut room = Room::new(ENTRIES_OF_FILE);
    let mut copies = Room::new(ENTRIES_OF_FILE);
    if let Some(device) = root.devices.get(DEVICES) {
        diagnostics.push(
            Diagnostic::new(
                codes::TOO_MUCH,
                device.key.span,
                format!("{} devices; a file describes at most {DEVICES}", root.devices.len()),
            )
            .help("describe a family of products in several files that use one library"),
        );
    }
    let dictionaries = root
        .devices
        .iter()
        .take(DEVICES)
        .map(|device| {
            let mut built = Builder {
                around: Surroundings {
                    scope,
                    file: root.file,
                    index: None,
                    device: Some(&device.key.value),
                    eds: EdsDefaults::of(device.eds_defaults.as_ref().map(|word| word.value.as_str())),
                },
                objects: BTreeMap::new(),
                broken: Broken::over(assigned.for_nobody()),
            };
            let written = assigned.to(&device.key.value);
            let mut declared = decls::of_device(
                &written,
                libraries,
                device,
                assigned.for_nobody(),
                &mut copies,
                scope,
                diagnostics,
            );
            if let Err(refusal) = take_room(&declared, device, &mut room) {
                diagnostics.push(*refusal);
                declared.clear();
            }
            built.left_out(&written, &declared);
            built.plain_objects(&declared, diagnostics);
            aliases::resolve(&declared, built.around, &mut built.objects, &mut built.broken, diagnostics);
            let info = device_info::info(device, diagnostics);
            // An EDS says what defaults there are; what it does not say, the device does not have.
            if root.front_end == FrontEnd::Specification {
                built.identity(device, &info, vendor);
            }
            let none = PdosDecl::default();
            let decl = pdos.get(device.key.value.as_str()).copied().unwrap_or(&none);
            let written = |index: Index| declared.get(&index).map(|one| one.decl.index.span);
            let pdos = pdos::resolve(
                decl,
                &info,
                &languages,
                written,
                &mut built.objects,
                &mut built.broken,
                diagnostics,
            );
            canopennode::add(device, &mut built.objects, &built.broken, diagnostics);
            condition_names::write_conditions(
                &device.key.value,
                &mut built.objects,
                &built.broken,
                diagnostics,
            );
            broken.append(built.broken);
            Dictionary {
                key: device.key.value.clone(),
                name: device.name.as_ref().map_or(String::new(), |name| name.value.clone()),
                file: device_info::file(device, vendor),
                info,
                about: with_gap(&device.about, &device.gap),
                any_error: device_info::any_error(device),
                facts: device_info::facts(device),
                objects: built.objects,
                pdos,
                further: None,
                span: device.key.span,
            }
        })
        .collect();
    (dictionaries, broken)
}

/// The objects of a library that is compiled by itself, as if a device had all of them: for the rules about objects.
pub(super) fn of_library<'a>(
    root: &'a Spec,
    libraries: &Libraries<'a>,
    scope: &Scope,
    diagnostics: &mut Diagnostics,
) -> Option<Dictionary> {
    let profile = root.profile.as_ref()?;
    let around = Surroundings { scope, file: root.file, index: None, device: None, eds: EdsDefaults::Safe };
    let declared = decls::of_library(root, libraries, scope, diagnostics);
    let plain = declared.into_values().filter(|declared| declared.decl.alias.is_none());
    let objects = plain.filter_map(|declared| objects::resolve(&declared, around, diagnostics));
    let mut objects: BTreeMap<Index, Object> = objects.map(|object| (object.index, object)).collect();
    condition_names::write_conditions(&profile.value, &mut objects, &Broken::default(), diagnostics);
    Some(Dictionary {
        key: profile.value.clone(),
        name: profile.value.clone(),
        info: device_info::none(),
        file: device_info::no_file(),
        about: Text::default(),
        any_error: AnyError::default(),
        objects,
        pdos: Vec::new(),
        further: None,
        facts: Facts::none(),
        span: profile.span,
    })
}

/// Every device key that is used must be declared.
fn check_device_keys(root: &Spec, diagnostics: &mut Diagnostics) {
    let known: BTreeSet<&str> = root.devices.iter().map(|device| device.key.value.as_str()).collect();
    let lists = [
        root.objects.iter().filter_map(|decl| decl.devices.as_ref()).collect::<Vec<_>>(),
        root.errors.iter().filter_map(|decl| decl.devices.as_ref()).collect(),
        root.errors.iter().filter_map(|decl| decl.treated_by.as_ref()).collect(),
        root.machines.iter().filter_map(|decl| decl.devices.as_ref()).collect(),
        root.constraints.iter().filter_map(|decl| decl.devices.as_ref()).collect(),
        root.errata.iter().filter_map(|decl| decl.devices.as_ref()).collect(),
    ];
    let used = lists.into_iter().flatten().flatten().chain(root.pdos.iter().map(|(key, _)| key));
    for key in used.filter(|key| !known.contains(key.value.as_str())) {
        let (names, otherwise) = (known.iter().copied(), "define it under `devices:`");
        unknown(codes::UNKNOWN_DEVICE, key, "device", names, otherwise, diagnostics);
    }
    let not_known = |key: &Name, diagnostics: &mut Diagnostics| {
        let names = known.iter().copied();
        let otherwise = if consumers::is_key(&key.value) {
            "`node` and `time` are for the consumers of 1016h; write one value, or one for each device"
        } else {
            "define it under `devices:`, or write one value for all; the bits of a bit field are a list"
        };
        unknown(codes::UNKNOWN_DEVICE, key, "device", names, otherwise, diagnostics);
    };
    defaults::check_devices(root, not_known, diagnostics);
}

/// Takes the room of a device, if there is enough.
fn take_room(
    declared: &BTreeMap<Index, Declared<'_>>,
    device: &DeviceDecl,
    room: &mut Room,
) -> Result<(), Box<Diagnostic>> {
    let entries = declared.values().map(|one| one.decl.entries()).sum();
    let text = declared.values().map(|one| one.decl.weight).sum();
    let Name { value: key, span } = &device.key;
    let message = if entries > ENTRIES_OF_DEVICE {
        format!("`{key}` has {entries} entries; a device has at most {ENTRIES_OF_DEVICE}")
    } else {
        match room.take(entries, text) {
            Ok(()) => return Ok(()),
            Err(full) => format!("{} with `{key}`; a file describes less", full.words(ENTRIES_OF_FILE)),
        }
    };
    Err(Box::new(Diagnostic::new(codes::TOO_MUCH, *span, message).help(
        "correct runs and counts, name the devices of an object in its `devices:`, or describe the devices in several files",
    )))
}

struct Builder<'a> {
    around: Surroundings<'a>,
    objects: BTreeMap<Index, Object>,
    broken: Broken,
}

impl Builder<'_> {
    /// Remembers the objects that are meant for the device, but whose library is unknown.
    fn left_out(&mut self, written: &[&ObjectDecl], declared: &BTreeMap<Index, Declared<'_>>) {
        for decl in written.iter().filter(|decl| !declared.contains_key(&decl.index.value)) {
            self.broken.add(decl.index.value, decl.entry.names());
        }
    }

    fn plain_objects(&mut self, declared: &BTreeMap<Index, Declared<'_>>, diagnostics: &mut Diagnostics) {
        for (index, one) in declared.iter().filter(|(_, one)| one.decl.alias.is_none()) {
            let before = diagnostics.errors_found();
            diagnostics.now_about(Some((*index).into()));
            if let Some(object) = objects::resolve(one, self.around, diagnostics) {
                self.objects.insert(*index, object);
            }
            // An object may be there without the entries that are wrong.
            if diagnostics.errors_found() > before || !self.objects.contains_key(index) {
                self.broken.add(*index, one.decl.entry.names());
            }
        }
        diagnostics.now_about(None);
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
