extern crate std;

mod foreign;

use std::collections::BTreeSet;
use std::sync::OnceLock;
use std::vec;
use std::vec::Vec;

use embedded_storage::nor_flash::{ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash};

use super::*;
use crate::abort::AbortCode;
use crate::access::parameters::{Parameters, set};
use crate::access::test_table::{TestDictionary, dictionary_of_layout, stored, value};
use crate::storage::{ALL, Command};

/// A flash that writes `WRITE` and erases `ERASE` bytes at least, and in which power can fail at every byte.
#[derive(Debug, Clone)]
struct Flash<const WRITE: usize, const ERASE: usize> {
    bytes: Vec<u8>,
    /// Bytes that can still be written or erased.
    power: Option<usize>,
    state: Power,
    /// What becomes of the byte at which power fails, and of the rest of the word or page.
    garbage: u32,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Power {
    On,
    Off,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct PowerFailure;

impl NorFlashError for PowerFailure {
    fn kind(&self) -> NorFlashErrorKind {
        NorFlashErrorKind::Other
    }
}

impl<const WRITE: usize, const ERASE: usize> Flash<WRITE, ERASE> {
    fn new(size: usize) -> Self {
        Self { bytes: vec![0xFF; size], power: None, state: Power::On, garbage: 0 }
    }

    fn is_on(&self) -> Result<(), PowerFailure> {
        if self.state == Power::On { Ok(()) } else { Err(PowerFailure) }
    }

    fn noise(&mut self) -> u8 {
        self.garbage = self.garbage.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        self.garbage.to_le_bytes()[3]
    }

    /// Changes a byte, if there is power for it.
    fn change(&mut self, at: usize, new: u8) -> Result<(), PowerFailure> {
        match &mut self.power {
            Some(0) => {
                self.state = Power::Off;
                return Err(PowerFailure);
            }
            Some(left) => *left -= 1,
            None => {}
        }
        self.bytes[at] = new;
        Ok(())
    }

    /// Power has failed within a range: the rest of it is undefined. Of three failures, one leaves it as it was, one changes it anyhow and one
    /// finishes it by chance.
    fn fail(&mut self, rest: core::ops::Range<usize>, wanted: &[u8]) -> PowerFailure {
        let way = self.garbage % 3;
        let start = rest.start;
        for at in rest {
            self.bytes[at] = match way {
                0 => self.bytes[at],
                1 => self.noise(),
                _ => wanted.get(at - start).copied().unwrap_or(0xFF),
            };
        }
        PowerFailure
    }
}

impl<const WRITE: usize, const ERASE: usize> ErrorType for Flash<WRITE, ERASE> {
    type Error = PowerFailure;
}

impl<const WRITE: usize, const ERASE: usize> ReadNorFlash for Flash<WRITE, ERASE> {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), PowerFailure> {
        self.is_on()?;
        let at = usize::try_from(offset).expect("an offset");
        bytes.copy_from_slice(&self.bytes[at..at + bytes.len()]);
        Ok(())
    }

    fn capacity(&self) -> usize {
        self.bytes.len()
    }
}

impl<const WRITE: usize, const ERASE: usize> NorFlash for Flash<WRITE, ERASE> {
    const WRITE_SIZE: usize = WRITE;
    const ERASE_SIZE: usize = ERASE;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), PowerFailure> {
        self.is_on()?;
        let (from, to) = (usize::try_from(from).expect("an offset"), usize::try_from(to).expect("an offset"));
        assert!(from.is_multiple_of(ERASE) && to.is_multiple_of(ERASE), "whole pages are erased");
        for at in from..to {
            if self.change(at, 0xFF).is_err() {
                return Err(self.fail(at..at - at % ERASE + ERASE, &[]));
            }
        }
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), PowerFailure> {
        self.is_on()?;
        let from = usize::try_from(offset).expect("an offset");
        assert!(from.is_multiple_of(WRITE) && bytes.len().is_multiple_of(WRITE), "whole words are written");
        assert!(
            self.bytes[from..from + bytes.len()].iter().all(|byte| *byte == 0xFF),
            "no word is written twice"
        );
        for (place, byte) in bytes.iter().enumerate() {
            if self.change(from + place, *byte).is_err() {
                let end = place - place % WRITE + WRITE;
                return Err(self.fail(from + place..from + end, &bytes[place..end]));
            }
        }
        Ok(())
    }
}

type Small = Flash<4, 64>;
const SLOT: u32 = 128;
const CHUNK: usize = 16;

/// Values of two groups and one that is not stored.
fn device() -> TestDictionary {
    static DEVICE: OnceLock<TestDictionary> = OnceLock::new();
    DEVICE.get_or_init(|| device_of_layout(0x1234)).clone()
}

fn device_of_layout(layout: u32) -> TestDictionary {
    dictionary_of_layout(
        &[
            stored(0x1017, 0, 2, 1000, Storage::Communication),
            stored(0x1400, 0, 1, 7, Storage::Communication),
            stored(0x1400, 1, 4, 0x205, Storage::Communication),
            value(0x1600, 0, 1, 0),
            stored(0x2000, 0, 4, 25, Storage::Application),
            stored(0x2001, 0, 4, 26, Storage::Application),
            stored(0x2002, 0, 1, 3, Storage::Manufacturer),
            value(0x2003, 0, 4, 99),
        ],
        layout,
    )
}

fn node() -> NodeId {
    NodeId::new(5).expect("a node-ID")
}

/// Changes every stored value.
fn change(device: &mut TestDictionary, seed: u32) {
    for (at, (index, sub)) in (0..).zip([(0x1017, 0), (0x1400, 1), (0x2000, 0), (0x2001, 0), (0x2002, 0)]) {
        let number = seed.wrapping_mul(0x0101_0101).wrapping_add(at);
        // An identifier that an RPDO can have.
        set(device, index, sub, if index == 0x1400 { 0x8000_0200 | number & 0xFF } else { number });
    }
}

fn store<const WRITE: usize, const ERASE: usize>(
    flash: Flash<WRITE, ERASE>,
) -> ParameterStore<Flash<WRITE, ERASE>, CHUNK> {
    ParameterStore::new(flash, 0, SLOT).expect("two slots")
}

/// The values that a flash gives at the next start, and what was loaded.
fn start<const WRITE: usize, const ERASE: usize>(flash: &Flash<WRITE, ERASE>) -> (Vec<u8>, Loaded) {
    let mut device = device();
    // Whatever is in the RAM before.
    change(&mut device, 0xEE);
    let loaded =
        store(Flash { power: None, state: Power::On, ..flash.clone() }).load(&mut device, node(), &STORED);
    (device.image().to_vec(), loaded)
}

fn factory() -> Vec<u8> {
    device().image().to_vec()
}

#[test]
fn what_is_saved_comes_back_and_nothing_else() {
    let mut device = device();
    let mut store = store(Small::new(256));
    change(&mut device, 1);
    set(&mut device, 0x2003, 0, 98);
    assert_eq!(store.save(&device, &ALL), Ok(Copies::Both));
    let (image, loaded) = start(&store.into_inner());
    set(&mut device, 0x2003, 0, 99);
    assert_eq!(image, device.image(), "2003h is not stored");
    assert_eq!(loaded.copies, Copies::Both);
    for group in ALL {
        assert_eq!(loaded.outcome(group), Outcome::Restored);
    }
    assert_eq!(loaded.outcome(Storage::Remanent), Outcome::Defaults);
}

#[test]
fn a_group_that_is_saved_leaves_the_others_as_they_are_stored() {
    let mut device = device();
    let mut store = store(Small::new(256));
    change(&mut device, 1);
    let first = device.clone();
    store.save(&device, &[Storage::Communication]).expect("stored");
    change(&mut device, 2);
    store.save(&device, &[Storage::Application]).expect("stored");
    let (image, loaded) = start(&store.into_inner());
    let mut expected = self::device();
    let region = |storage| device.table().region(storage).expect("a region").range();
    for (group, from) in [(Storage::Communication, &first), (Storage::Application, &device)] {
        expected.image_mut()[region(group)].copy_from_slice(from.stored(group));
        assert_eq!(loaded.outcome(group), Outcome::Restored);
    }
    assert_eq!(image, expected.image());
    assert_eq!(loaded.outcome(Storage::Manufacturer), Outcome::Defaults);
}

#[test]
fn defaults_come_back_after_the_reset_and_not_before() {
    let mut device = device();
    let mut store = store(Small::new(256));
    change(&mut device, 1);
    store.command(&device, Command::Save(1)).expect("stored");
    let before = device.image().to_vec();
    assert_eq!(store.command(&device, Command::Restore(3)), Ok(Copies::Both));
    assert_eq!(device.image(), before);
    let loaded = store.load(&mut device, node(), &STORED);
    assert_eq!(
        (loaded.outcome(Storage::Application), loaded.outcome(Storage::Communication)),
        (Outcome::Defaults, Outcome::Restored)
    );
    assert_eq!(Parameters::of(&device).number(0x2000, 0), Some(25));
    assert_eq!(Parameters::of(&device).number(0x1017, 0), Some(0x0101));
    store.command(&device, Command::Restore(1)).expect("forgotten");
    assert_eq!(start(&store.into_inner()).0, factory());
}

#[test]
fn a_reset_of_the_communication_loads_its_group_only() {
    let mut device = device();
    let mut store = store(Small::new(256));
    change(&mut device, 1);
    store.save(&device, &ALL).expect("stored");
    change(&mut device, 2);
    let loaded = store.load(&mut device, node(), &[Storage::Communication]);
    assert_eq!(Parameters::of(&device).number(0x1017, 0), Some(0x0101));
    assert_eq!(Parameters::of(&device).number(0x2000, 0), Some(0x0202_0204));
    assert_eq!(loaded.outcome(Storage::Application), Outcome::Defaults, "it was not asked for");
}

#[test]
fn values_of_another_layout_are_not_taken() {
    let mut device = device();
    let mut store = store(Small::new(256));
    change(&mut device, 1);
    store.save(&device, &ALL).expect("stored");
    let mut newer = device_of_layout(0x9999);
    let loaded = store.load(&mut newer, node(), &STORED);
    assert_eq!((newer.image(), loaded.outcome(Storage::Application)), (&factory()[..], Outcome::OtherLayout));
    // What the newer firmware saves is not mixed with what the older one did.
    store.save(&newer, &[Storage::Application]).expect("stored");
    let (image, loaded) = start(&store.into_inner());
    assert_eq!((image, loaded.outcome(Storage::Communication)), (factory(), Outcome::Defaults));
}

/// Saves, restores and repairs with a power failure at every byte, in flashes of several kinds: the next start finds the values of
/// before or those of after.
#[test]
fn power_may_fail_at_every_byte() {
    power_fails_at_every_byte::<1, 16>();
    power_fails_at_every_byte::<4, 64>();
    power_fails_at_every_byte::<8, 128>();
    power_fails_at_every_byte::<16, 32>();
}

type Work<F> = fn(&mut ParameterStore<F, CHUNK>, &TestDictionary) -> Result<Copies, StoreError<PowerFailure>>;

fn power_fails_at_every_byte<const WRITE: usize, const ERASE: usize>() {
    let works: [Work<Flash<WRITE, ERASE>>; 5] = [
        |store, device| store.save(device, &ALL),
        |store, device| store.save(device, &[Storage::Application]),
        |store, device| store.forget(device, &[Storage::Communication]),
        |store, device| store.forget(device, &ALL),
        |store, _| store.repair(),
    ];
    for before in prepared::<WRITE, ERASE>() {
        let old = start(&before).0;
        let mut device = device();
        change(&mut device, 9);
        for work in works {
            let mut whole = store(before.clone());
            work(&mut whole, &device).expect("enough power");
            let new = start(&whole.flash).0;
            let mut found = BTreeSet::new();
            let copies = start(&whole.into_inner()).1.copies;
            for power in 0.. {
                let mut done = false;
                for garbage in 0..3 {
                    let mut cut = store(Flash { power: Some(power), garbage, ..before.clone() });
                    done = work(&mut cut, &device) == Ok(Copies::Both) || done;
                    let after = cut.into_inner();
                    let image = start(&after).0;
                    assert!(image == old || image == new, "power fails at byte {power}, {garbage}");
                    found.insert(image);
                    if garbage == 1 {
                        // The next attempt succeeds.
                        let mut again = store(Flash { power: None, state: Power::On, ..after });
                        work(&mut again, &device).expect("enough power");
                        assert_eq!(start(&again.into_inner()).1.copies, copies);
                    }
                }
                if done {
                    break;
                }
                assert!(power < 2000, "it ends");
            }
            assert!(found.contains(&new), "at the end, it is done");
        }
    }
}

/// Flashes as they are before: saved once, saved twice, one slot lost.
fn prepared<const WRITE: usize, const ERASE: usize>() -> Vec<Flash<WRITE, ERASE>> {
    let mut device = device();
    let mut store = store(Flash::<WRITE, ERASE>::new(256));
    change(&mut device, 1);
    store.save(&device, &ALL).expect("stored");
    let once = store.flash.clone();
    change(&mut device, 2);
    store.save(&device, &[Storage::Application, Storage::Manufacturer]).expect("stored");
    let twice = store.flash.clone();
    let lost = [0, 128].map(|slot| {
        let mut flash = twice.clone();
        flash.bytes[slot + 5] ^= 1;
        flash
    });
    [once, twice].into_iter().chain(lost).collect()
}

#[test]
fn power_may_fail_at_the_first_save() {
    for power in 0..600 {
        for garbage in 0..6 {
            let mut device = device();
            change(&mut device, 1);
            let mut cut = store(Flash { power: Some(power), garbage, ..Small::new(256) });
            let done = cut.save(&device, &ALL);
            let image = start(&cut.into_inner()).0;
            let is_new = image == device.image();
            assert!(is_new || image == factory(), "power fails at byte {power}");
            assert!(is_new || done.is_err());
        }
    }
}

/// A long life with failures at random: every start finds the values of the last success, or of the attempt that failed.
#[test]
fn a_long_life_with_power_failures() {
    let mut flash = Small::new(256);
    let mut allowed = vec![factory()];
    let mut random = 1u32;
    for _ in 0..3000 {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let mut device = device();
        let mut life = store(Flash { power: None, state: Power::On, ..flash.clone() });
        life.load(&mut device, node(), &STORED);
        assert!(allowed.iter().any(|image| image == device.image()));
        let before = device.image().to_vec();
        change(&mut device, random >> 8);
        let power = (random.is_multiple_of(3)).then_some(usize::try_from(random >> 16).expect("short") % 500);
        life.flash.power = power;
        life.flash.garbage = random;
        let result = life.save(&device, &ALL);
        allowed = if result.is_ok() {
            vec![device.image().to_vec()]
        } else {
            vec![before, device.image().to_vec()]
        };
        flash = life.into_inner();
    }
}

#[test]
fn a_flipped_bit_costs_nothing() {
    for flash in prepared::<4, 64>().into_iter().take(2) {
        let expected = start(&flash).0;
        for at in 0..flash.bytes.len() * 8 {
            let mut rotten = flash.clone();
            rotten.bytes[at / 8] ^= 1 << (at % 8);
            let (image, loaded) = start(&rotten);
            assert_eq!(image, expected, "bit {at}");
            let mut store = store(rotten);
            assert_eq!(store.repair(), Ok(Copies::Both));
            let (image, repaired) = start(&store.into_inner());
            assert_eq!((image, repaired.copies), (expected.clone(), Copies::Both), "{:?}", loaded.copies);
        }
    }
}

#[test]
fn bits_that_flip_in_both_slots_give_the_factory_values() {
    let flash = prepared::<4, 64>().remove(1);
    let expected = start(&flash).0;
    for first in 0..128 * 8 {
        let second = 1024 + (first * 7 + 3) % 1024;
        let mut rotten = flash.clone();
        for at in [first, second] {
            rotten.bytes[at / 8] ^= 1 << (at % 8);
        }
        let image = start(&rotten).0;
        assert!(image == expected || image == factory(), "bits {first} and {second}");
    }
}

#[test]
fn random_flash_gives_the_factory_values() {
    let mut flash = Small::new(256);
    for seed in 0..2000 {
        flash.garbage = seed;
        for at in 0..flash.bytes.len() {
            flash.bytes[at] = flash.noise();
        }
        // A record that begins well, too.
        if seed % 2 == 0 {
            flash.bytes[..4].copy_from_slice(&record::FORMAT);
            flash.bytes[8..12].copy_from_slice(&[1, 0, 0, 0]);
        }
        assert_eq!(start(&flash).0, factory());
    }
}

#[test]
fn numbers_of_records_count_on_beyond_their_end() {
    let mut device = device();
    let mut store = store(Small::new(256));
    for (slot, number) in [(store.slots[0], u32::MAX), (store.slots[1], 0)] {
        change(&mut device, number);
        let mut writer = Writer::<CHUNK>::new(slot);
        writer.begin(&mut store.flash, number).expect("erased");
        let region = *device.table().region(Storage::Application).expect("a region");
        writer.section(&mut store.flash, section_of(&region, None)).expect("written");
        writer.bytes(&mut store.flash, device.stored(Storage::Application)).expect("written");
        writer.finish(&mut store.flash).expect("written");
    }
    let mut found = self::device();
    let loaded = store.load(&mut found, node(), &STORED);
    assert_eq!(
        (loaded.copies, found.stored(Storage::Application)),
        (Copies::One, device.stored(Storage::Application))
    );
}

#[test]
fn what_does_not_fit_is_refused_before_anything_is_erased() {
    let mut small = ParameterStore::<_, 16>::new(Flash::<4, 16>::new(64), 0, 32).expect("two slots");
    let before = small.flash.bytes.clone();
    assert_eq!(small.save(&device(), &ALL), Err(StoreError::TooLarge));
    assert_eq!(small.flash.bytes, before);
    assert_eq!(AbortCode::from(StoreError::Flash(PowerFailure)), AbortCode::HARDWARE);
}

#[test]
fn slots_fit_the_flash() {
    let new = |start, size| ParameterStore::<_, 16>::new(Small::new(256), start, size).map(drop);
    assert_eq!(new(0, 128), Ok(()));
    assert_eq!(new(64, 64), Ok(()));
    assert_eq!(new(32, 64), Err(BadArea::EraseSize));
    assert_eq!(new(0, 100), Err(BadArea::EraseSize));
    assert_eq!(new(0, 0), Err(BadArea::EraseSize));
    assert_eq!(new(64, 128), Err(BadArea::Capacity));
    assert_eq!(new(0, u32::MAX - 63), Err(BadArea::Capacity));
    assert_eq!(ParameterStore::<_, 0>::new(Small::new(256), 0, 64).map(drop), Err(BadArea::ChunkSize));
    assert_eq!(ParameterStore::<_, 6>::new(Small::new(256), 0, 64).map(drop), Err(BadArea::ChunkSize));
    assert_eq!(ParameterStore::<_, 48>::new(Small::new(256), 0, 64).map(drop), Err(BadArea::ChunkSize));
}
