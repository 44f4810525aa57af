//! Records of another node-ID, or of a firmware with other limits.

use super::*;
use crate::access::test_table::TestValue;
use crate::table::entry::EntryId;

fn values() -> Vec<TestValue> {
    vec![
        stored(0x1014, 0, 4, 0x80, Storage::Communication).and_node_id(),
        stored(0x1017, 0, 2, 1000, Storage::Communication),
        stored(0x1400, 0, 1, 2, Storage::Communication),
        stored(0x1400, 1, 4, 0x200, Storage::Communication).and_node_id(),
        stored(0x1400, 2, 1, 255, Storage::Communication),
        stored(0x1600, 0, 1, 1, Storage::Communication),
        stored(0x1600, 1, 4, 0x2000_0020, Storage::Communication),
        stored(0x1600, 2, 4, 0, Storage::Communication),
        stored(0x2000, 0, 4, 25, Storage::Application),
        stored(0x2001, 0, 4, 26, Storage::Application),
    ]
}

fn device() -> TestDictionary {
    dictionary_of_layout(&values(), 0x77)
}

fn at(node: u8) -> NodeId {
    NodeId::new(node).expect("a node-ID")
}

fn read(device: &TestDictionary, index: u16, sub: u8) -> u32 {
    Parameters::of(device).number(index, sub).expect("a value")
}

/// A store in which node 5 has saved everything.
fn saved(change: impl Fn(&mut TestDictionary)) -> ParameterStore<Small, CHUNK> {
    let mut store = ParameterStore::new(Small::new(512), 0, 256).expect("two slots");
    let mut device = device();
    store.load(&mut device, at(5), &ALL);
    change(&mut device);
    assert_eq!(store.save(&device, &ALL), Ok(Copies::Both));
    store
}

#[test]
fn a_node_does_not_take_identifiers_of_another() {
    let mut store = saved(|device| {
        set(device, 0x1017, 0, 77);
        set(device, 0x2000, 0, 99);
    });
    let mut device = device();
    let loaded = store.load(&mut device, at(6), &ALL);
    assert_eq!(
        (loaded.outcome(Storage::Communication), loaded.outcome(Storage::Application)),
        (Outcome::OtherNode, Outcome::Restored)
    );
    assert_eq!(
        (read(&device, 0x1400, 1), read(&device, 0x1014, 0), read(&device, 0x1017, 0)),
        (0x206, 0x86, 1000)
    );
    assert_eq!(read(&device, 0x2000, 0), 99, "it does not follow the node-ID");
    // What node 6 saves next to it does not take it away from node 5.
    store.save(&device, &[Storage::Application]).expect("stored");
    let loaded = store.load(&mut device, at(5), &ALL);
    assert_eq!(loaded.outcome(Storage::Communication), Outcome::Restored);
    assert_eq!((read(&device, 0x1400, 1), read(&device, 0x1017, 0)), (0x205, 77));
    // The communication is that of the node that it was loaded for.
    store.load(&mut device, at(6), &[Storage::Communication]);
    store.command(&device, Command::Save(1)).expect("stored");
    let outcome = |store: &mut ParameterStore<_, CHUNK>, node| {
        store.load(&mut self::device(), at(node), &ALL).outcome(Storage::Communication)
    };
    assert_eq!((outcome(&mut store, 5), outcome(&mut store, 6)), (Outcome::OtherNode, Outcome::Restored));
}

#[test]
fn whose_values_they_are_has_to_be_known() {
    let mut store = ParameterStore::<_, CHUNK>::new(Small::new(512), 0, 256).expect("two slots");
    assert_eq!(store.save(&device(), &[Storage::Application]), Ok(Copies::Both));
    let before = store.flash.bytes.clone();
    assert_eq!(store.save(&device(), &ALL), Err(StoreError::NotLoaded));
    assert_eq!(store.flash.bytes, before);
    assert_eq!(AbortCode::from(StoreError::<PowerFailure>::NotLoaded), AbortCode::INTERNAL);
}

#[test]
fn values_that_begin_to_follow_the_node_id_are_of_another_layout() {
    let plain = |value: TestValue| match value.id() {
        (index @ (0x1014 | 0x1400), sub @ (0 | 1)) if index == 0x1014 || sub == 1 => {
            stored(index, sub, 4, 0x300, Storage::Communication)
        }
        _ => value,
    };
    let fixed = || dictionary_of_layout(&values().into_iter().map(plain).collect::<Vec<_>>(), 0x77);
    let mut store = ParameterStore::<_, CHUNK>::new(Small::new(512), 0, 256).expect("two slots");
    store.save(&fixed(), &ALL).expect("stored");
    let outcome = |store: &mut ParameterStore<_, CHUNK>, mut device: TestDictionary| {
        store.load(&mut device, at(5), &ALL).outcome(Storage::Communication)
    };
    assert_eq!(outcome(&mut store, fixed()), Outcome::Restored);
    assert_eq!(outcome(&mut store, device()), Outcome::OtherLayout);
    store.save(&device(), &ALL).expect("stored");
    assert_eq!(outcome(&mut store, device()), Outcome::Restored);
    assert_eq!(outcome(&mut store, fixed()), Outcome::OtherLayout);
}

#[test]
fn a_value_that_its_entry_cannot_have_any_more_is_the_factorys() {
    let mut store = saved(|device| {
        set(device, 0x2000, 0, 20);
        set(device, 0x2001, 0, 9);
        set(device, 0x1017, 0, 5);
    });
    let limited =
        values().into_iter().map(|value| if value.id() == (0x2000, 0) { value.at_most(10) } else { value });
    // The factory's may stay, whatever it is.
    let mut device = dictionary_of_layout(&limited.collect::<Vec<_>>(), 0x77);
    let loaded = store.load(&mut device, at(5), &ALL);
    let entry = EntryId { index: 0x2000, sub: 0 };
    assert_eq!(
        (loaded.outcome(Storage::Communication), loaded.outcome(Storage::Application)),
        (Outcome::Restored, Outcome::RestoredBut(entry))
    );
    assert_eq!((read(&device, 0x2000, 0), read(&device, 0x2001, 0), read(&device, 0x1017, 0)), (25, 9, 5));
    store.save(&device, &ALL).expect("stored");
    assert_eq!(store.load(&mut device, at(5), &ALL).outcome(Storage::Application), Outcome::Restored);
}

#[test]
fn a_pdo_that_does_not_hold_is_the_factorys_as_a_whole() {
    // Too many bits, an entry that is not there, an identifier that is kept for SDO, a type that is reserved.
    for (index, sub, wrong) in
        [(0x1600, 0, 2), (0x1600, 1, 0x2009_0020), (0x1400, 1, 0x605), (0x1400, 2, 245)]
    {
        let mut store = saved(|device| {
            set(device, 0x1400, 1, 0x345);
            set(device, 0x1400, 2, 1);
            set(device, 0x1600, 1, 0x2001_0020);
            set(device, 0x1017, 0, 5);
            set(device, index, sub, wrong);
        });
        let mut device = device();
        let loaded = store.load(&mut device, at(5), &ALL);
        let outcome = Outcome::RestoredBut(EntryId { index, sub });
        assert_eq!(loaded.outcome(Storage::Communication), outcome);
        let mut expected = self::device();
        set(&mut expected, 0x1017, 0, 5);
        assert_eq!(device.image(), expected.image(), "{index:X}h.{sub}");
    }
}

/// Whatever a client wrote, it finds after the next start.
#[test]
fn what_could_be_written_is_not_put_right() {
    let mut values = vec![
        value(0x1001, 0, 1, 0),
        stored(0x1005, 0, 4, 0x80, Storage::Communication),
        stored(0x1012, 0, 4, 0x100, Storage::Communication),
        stored(0x1016, 0, 1, 2, Storage::Communication),
        stored(0x1016, 1, 4, 0, Storage::Communication),
        stored(0x1016, 2, 4, 0, Storage::Communication),
        stored(0x1019, 0, 1, 0, Storage::Communication),
        stored(0x1029, 0, 1, 1, Storage::Communication),
        stored(0x1029, 1, 1, 0, Storage::Communication),
        stored(0x1200, 0, 1, 2, Storage::Communication),
        stored(0x1200, 1, 4, 0x600, Storage::Communication).and_node_id(),
        stored(0x1200, 2, 4, 0x580, Storage::Communication).and_node_id(),
    ];
    values.extend(self::values());
    values.sort_by_key(TestValue::id);
    let mut device = dictionary_of_layout(&values, 0x77);
    let mut random = 7u64;
    let mut next = move |below: u64| {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 33) % below
    };
    let mut written = 0;
    for _ in 0..200_000 {
        let (index, sub) = values[usize::try_from(next(values.len() as u64)).expect("small")].id();
        let like =
            [0, 1, 2, 0x80, 0x185, 0x205, 0x8000_0000, 0x4000_0000, 0x2000_0020, 0x2001_0020, 0x0003_0010];
        let number =
            like[usize::try_from(next(11)).expect("small")] | like[usize::try_from(next(11)).expect("small")];
        let size = device.info_at(index, sub).expect("an entry").size();
        let bytes = u32::to_le_bytes(number);
        let is_count = sub == 0 && matches!(index, 0x1016 | 0x1029 | 0x1400);
        if !is_count && index != 0x1200 {
            written += u32::from(device.write(index, sub, &bytes[..usize::from(size)], &mut ()).is_ok());
        }
        let image = device.image().to_vec();
        assert_eq!(device.correct_stored(Storage::Communication, 5), None, "{index:X}h.{sub} = {number:X}h");
        assert_eq!(device.image(), image);
    }
    assert!(written > 1000, "{written}");
}
