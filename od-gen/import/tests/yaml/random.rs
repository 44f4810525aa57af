//! Whatever a model holds, its text compiles.

use std::sync::LazyLock;

use od_spec::model::{
    Access, DataType, Entry, EntryId, Fact, Index, ObjectKind, PdoMapping, Storage, SubIndex, System, Value,
};
use od_spec::source::Spanned;
use proptest::prelude::*;

use super::{model, written};

static EVERYTHING: LazyLock<System> =
    LazyLock::new(|| model(include_str!("../../../../tests/readers/everything.od.yaml")));

const NAMES: [&str; 14] = [
    "",
    " ",
    "yes",
    "x;y",
    "step {n}",
    "0x2000",
    "a.b",
    "Höhe",
    "日",
    "unsigned8",
    "line\nbreak",
    "a: b #c",
    "-",
    "a boolean",
];

/// One change: which entry, what of it, and a number.
type Change = (usize, u8, i64);

fn change(system: &mut System, (which, what, number): Change) {
    let named = system.types.values().nth(usize::try_from(number.unsigned_abs() % 7).unwrap()).cloned();
    let unit = system.units.values().nth(usize::try_from(number.unsigned_abs() % 5).unwrap()).cloned();
    let device = &mut system.devices[0];
    let ids: Vec<EntryId> = device.entries().map(|(id, ..)| id).collect();
    let id = ids[which % ids.len()];
    let pick = |count: usize| usize::try_from(number.unsigned_abs()).unwrap() % count;
    let special = device.entries().find_map(|(.., entry)| entry.special.first()).cloned();
    match what {
        0 => drop(device.objects.remove(&id.index)),
        1 => device.info.granularity = [0, 1, 8, 64][pick(4)],
        2 => device.info.bit_rates.retain(|rate| usize::from(*rate) % 3 == pick(3)),
        3 => device.file.description = NAMES[pick(NAMES.len())].repeat(pick(300)),
        4 => NAMES[pick(NAMES.len())].clone_into(&mut system.vendor.name),
        _ => {}
    }
    let Some(object) = system.devices[0].objects.get_mut(&id.index) else { return };
    match what {
        5 => object.name = NAMES[pick(NAMES.len())].repeat(1 + pick(40)),
        6 if object.is_structured() => {
            object.kind = [ObjectKind::Array, ObjectKind::Record][pick(2)];
        }
        7 if object.entries.len() > 2 && id.sub != SubIndex(0) => {
            object.entries.retain(|entry| entry.sub != id.sub);
        }
        8 => object.identifier = Some(NAMES[pick(NAMES.len())].to_owned()),
        23 => {
            let links = [0, 0x0005, 0x1000, id.index.0, 0xFFFF].into_iter().take(pick(6));
            object.links = links.map(|index| Spanned::new(Index(index), object.span)).collect();
        }
        _ => {}
    }
    let Some(entry) = object.entries.iter_mut().find(|entry| entry.sub == id.sub) else { return };
    change_entry(entry, what, number);
    match what {
        20 => entry.named_type = named,
        21 => entry.unit = unit,
        22 => entry.special.extend(special),
        _ => {}
    }
}

fn change_entry(entry: &mut Entry, what: u8, number: i64) {
    let pick = |count: usize| usize::try_from(number.unsigned_abs()).unwrap() % count;
    match what {
        9 => NAMES[pick(NAMES.len())].clone_into(&mut entry.name),
        10 => entry.default = Some(Value::Integer(number.into())),
        11 => entry.low = Some(number.into()),
        12 => entry.high = Some(number.into()),
        13 => {
            entry.pdo =
                [PdoMapping::None, PdoMapping::Receive, PdoMapping::Transmit, PdoMapping::Both][pick(4)];
        }
        14 => {
            entry.access =
                [Access::Const, Access::Ro, Access::Wo, Access::Rw, Access::Rwr, Access::Rww][pick(6)];
            entry.locked = pick(2) == 1;
        }
        15 => entry.stored = [Storage::No, Storage::Communication, Storage::Remanent][pick(3)],
        16 => entry.data_type = DataType::ALL[pick(25)],
        17 => {
            let text = || NAMES[pick(NAMES.len())].to_owned();
            let reals = [f64::INFINITY, f64::NAN, 1e300, -0.0, 0.1, 1e-9];
            entry.default = match pick(5) {
                0 => Some(Value::Text(text())),
                1 => Some(Value::Bytes(text().into_bytes())),
                2 => Some(Value::Real(reals[pick(reals.len())].into())),
                3 => Some(Value::NodeId(number.unsigned_abs() >> pick(64))),
                _ => None,
            };
        }
        18 => {
            entry.eds.access =
                [Access::Const, Access::Ro, Access::Wo, Access::Rw, Access::Rwr, Access::Rww][pick(6)];
            entry.eds.default = pick(2) == 1;
            entry.eds.no_scan = pick(3) == 1;
        }
        19 => entry.default = None,
        _ => {}
    }
}

/// Few, unless `PROPTEST_CASES` or a long run asks for more.
fn cases() -> u32 {
    let few = if std::env::var_os("OD_TESTS_LONG").is_some() { 12 } else { 4 };
    std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(few)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(), max_shrink_iters: 100, ..ProptestConfig::default() })]

    #[test]
    fn it_compiles(changes in prop::collection::vec((any::<usize>(), 0u8..24, any::<i64>().prop_map(|n| n >> (n & 63))), 1..40)) {
        let mut system = EVERYTHING.clone();
        for change in changes {
            super::random::change(&mut system, change);
        }
        if system.devices[0].objects.is_empty() {
            return Ok(());
        }
        let specification = written(&system);
        let again = model(&specification.text);
        for (index, object) in &again.devices[0].objects {
            let reported = specification.repairs.iter().any(|repair| repair.fact == Some(Fact::Links));
            let linked: Vec<Index> = object.linked().collect();
            prop_assert!(reported || system.devices[0].objects[index].linked().eq(linked), "links of {index}: {}", specification.text);
        }
        let lost = system.devices[0].objects.keys().filter(|index| !again.devices[0].objects.contains_key(index));
        for index in lost {
            let reported = specification.repairs.iter().any(|repair| repair.fact.is_none() && repair.original.starts_with(&index.to_string()));
            prop_assert!(reported, "{index} is gone without a word: {}", specification.text);
        }
    }
}
