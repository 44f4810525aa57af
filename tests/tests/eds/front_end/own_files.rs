//! Our own EDS files, read back: every fact that an EDS has a key for, and what our comments add.

use std::collections::BTreeMap;

use od_spec::model::{Dictionary, Entry, EntryId, PdoMapping};
use od_tests::{compile_clean, is_said_by_manuals, root};

use super::{compiled, device};

/// The shipped devices: specification, device, and EDS.
const SHIPPED: [(&str, &str, &str); 3] = [
    ("od-spec/devices/pitch-control-system.od.yaml", "pmm", "generated/eds/pmm.eds"),
    ("od-spec/devices/pitch-control-system.od.yaml", "pmc", "generated/eds/pmc.eds"),
    ("od-spec/devices/fullmo-drive.od.yaml", "fullmo", "generated/eds/fullmo.eds"),
];

fn text(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap()
}

/// What an EDS says about an entry, with the meanings that our comments add.
fn facts(device: &Dictionary, id: EntryId, entry: &Entry) -> String {
    let Entry { data_type, eds, stored, locked, .. } = entry;
    let name = od_spec::ascii::transliterate(&entry.name);
    let name = if device.objects[&id.index].is_structured() { name } else { String::new() };
    let mappable = entry.pdo != PdoMapping::None;
    let unit = entry.unit.as_ref().map(|unit| od_spec::ascii::transliterate(&unit.show(10)));
    let special: BTreeMap<i128, String> =
        entry.special.iter().map(|special| (special.value, special.name.clone())).collect();
    format!(
        "{name} {data_type:?} {:?} default {:?} limits {:?} mappable {mappable} unit {unit:?} {special:?} {stored:?} \
         locked {locked} flags {} shown {}",
        eds.access,
        entry.default,
        entry.hull(),
        eds.flags(),
        entry.default.is_none() || eds.default
    )
}

#[test]
fn what_our_files_say_comes_back() {
    for (specification, key, eds) in SHIPPED {
        let system = compile_clean(specification).unwrap();
        let ours = system.device(key).unwrap();
        let read = device(eds, &text(eds));
        let ids = |device: &Dictionary| device.entries().map(|(id, ..)| id).collect::<Vec<_>>();
        assert_eq!(ids(ours), ids(&read), "{key}");
        for (id, object, entry) in ours.entries() {
            let other = read.entry(id).unwrap();
            assert_eq!(object.kind, read.objects[&id.index].kind);
            assert_eq!(facts(ours, id, entry), facts(&read, id, other), "{key} {id}");
        }
        let mut info = read.info.clone();
        info.device_type = ours.info.device_type;
        assert_eq!(info, ours.info);
        assert_eq!((&read.file.description, read.file.created), (&ours.file.description, ours.file.created));
        let shown = |device: &Dictionary| {
            let pdos = device
                .pdos
                .iter()
                .map(|pdo| (pdo.direction, pdo.number, pdo.cob_id.clone(), pdo.map.clone()));
            pdos.collect::<Vec<_>>()
        };
        assert_eq!(shown(ours), shown(&read));
    }
}

/// Reading our own file finds nothing, except for notes about what the manuals say.
#[test]
fn our_files_are_without_fault() {
    for (.., eds) in SHIPPED {
        let (compiled, sources) = compiled(eds, &text(eds));
        let found: Vec<String> = compiled
            .diagnostics
            .iter()
            .filter(|found| !is_said_by_manuals(found))
            .map(|found| {
                format!("{} {}: {}", sources.place(found.labels[0].span), found.code.id, found.message)
            })
            .collect();
        assert!(found.is_empty(), "{found:#?}");
    }
}

/// A DCF of ours gives back the node and its values.
#[test]
fn a_node_comes_back() {
    let (compiled, _) = compiled("generated/eds/pmc.dcf", &text("generated/eds/pmc.dcf"));
    let node = compiled.node.unwrap().at(None);
    assert_eq!((node.node, node.bit_rate), (1, 250));
    let system = compile_clean(SHIPPED[1].0).unwrap();
    let mut written = od_spec::Commissioning::of_node(system.device("pmc").unwrap(), 5);
    written.node_name = "axis 2".to_owned();
    written.net_number = 7;
    let mut sources = od_spec::source::SourceMap::new();
    let file = sources.add("--set", "607D.2=9000");
    let setting = od_spec::source::Spanned::new("607D.2=9000".to_owned(), sources.whole(file));
    let mut diagnostics = od_spec::diag::Diagnostics::new();
    let pmc = system.device("pmc").unwrap();
    written.values = od_spec::assign(&system, pmc, 5, &[setting], &mut diagnostics);
    assert!(!diagnostics.has_errors());
    let dcf = String::from_utf8(od_formats::eds::write_dcf(&system, pmc, &written, "axis.dcf")).unwrap();
    let read = super::compiled("axis.dcf", &dcf).0.node.unwrap().at(None);
    assert_eq!(read, written);
}
