//! The same operations on the same objects, on each contender's dictionary, of each enabled model.
//!
//! One iteration does an operation for 1024 keys, so that neither the loop nor the clock counts;
//! `run.py` divides. Keys are drawn from the scalars of type u16, the same ones for all contenders; from
//! records and arrays where an operation is about them.
//! What is measured is throughput: the processor may begin an operation before the last has ended.

use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};

#[cfg(feature = "canopen-rs")]
mod canopen_rs;
#[cfg(feature = "ours")]
mod ours;
#[cfg(feature = "zencan")]
mod zencan;

#[path = "../shared/model.rs"]
mod keys;

use keys::{KEYS, Model, keys as keys_of};

/// The same in all models.
mod model {
    /// Default of the first setpoint.
    pub const SETPOINT: u16 = 51;
    pub const PDO_SIZE: usize = 6;
    /// The sub-index of a record that is a u16, and the elements of an array.
    pub const GAIN: u8 = 1;
    pub const ELEMENTS: u8 = 8;
    /// An index without an object.
    pub const FREE: u16 = 0x9FFF;
}

/// A contender. Operations that it does not have give `None`.
trait Dictionary {
    const NAME: &str;

    /// Reads a u16 by index and sub-index as an SDO server would: access right checked, bytes in the end.
    fn read(&self, index: u16, sub: u8) -> Option<[u8; 2]>;

    /// Writes a u16 as an SDO server would: access right and length checked.
    fn write(&mut self, index: u16, sub: u8, bytes: [u8; 2]) -> bool;

    /// Finds what is known about an entry; an implementation puts it into a `black_box`.
    fn find(&self, index: u16, sub: u8) -> bool;

    /// Reads the first setpoint by its name.
    fn setpoint(&self) -> Option<u16>;

    /// Gathers the mapped entries of TPDO 1, a u16 and an i32, by its present mapping; gives their length.
    fn pack(&mut self, frame: &mut [u8; 8]) -> Option<usize>;

    /// Gathers them by the mapping after a factory reset, which the generator knew.
    fn pack_default(&self) -> Option<[u8; model::PDO_SIZE]> {
        None
    }

    /// Scatters a frame into the mapped entries of RPDO 1.
    fn unpack(&mut self, frame: &[u8]) -> Option<()>;
}

/// Fails unless a contender does what is going to be measured.
fn assert_works(dictionary: &mut impl Dictionary, model: &Model, keys: &[u16]) {
    let (first, [mapped, ..]) = (model.setpoints[0], model.mapped);
    assert_eq!(dictionary.read(first, 0), Some(model::SETPOINT.to_le_bytes()));
    assert!(dictionary.setpoint().is_none_or(|value| value == model::SETPOINT));
    for (number, &index) in keys.iter().enumerate() {
        let bytes = u16::try_from(number).expect("there are few keys").to_le_bytes();
        assert!(
            dictionary.find(index, 0) && dictionary.write(index, 0, bytes),
            "{index:X}h cannot be written"
        );
        assert_eq!(dictionary.read(index, 0), Some(bytes));
    }
    assert!(!dictionary.find(model::FREE, 0) && !dictionary.find(first, 1));
    assert!(!dictionary.write(model.position, 0, [0; 2]), "a read-only entry was written");
    let (record, array) = (model.records[0], model.arrays[0]);
    assert!(dictionary.write(record, model::GAIN, [7, 0]));
    assert_eq!(dictionary.read(record, model::GAIN), Some([7, 0]));
    assert_eq!(dictionary.read(array, model::ELEMENTS), Some([0, 0]));
    assert!(!dictionary.write(array, model::ELEMENTS, [0; 2]), "a read-only element was written");
    if dictionary.unpack(&[0x34, 0x12, 1, 2, 3, 4]).is_some() {
        assert_eq!(dictionary.read(mapped, 0), Some([0x34, 0x12]));
    }
    assert!(dictionary.write(first, 0, [0x78, 0x56]) && dictionary.write(mapped, 0, [0xCD, 0xAB]));
    assert!(dictionary.setpoint().is_none_or(|value| value == 0x5678));
    let mut frame = [0xFF; 8];
    if let Some(length) = dictionary.pack(&mut frame) {
        assert_eq!(frame[..length], [0xCD, 0xAB, 0, 0, 0, 0]);
    }
    assert!(dictionary.pack_default().is_none_or(|frame| frame == [0xCD, 0xAB, 0, 0, 0, 0]));
}

/// All operations of one contender on one model.
fn measure<D: Dictionary>(criterion: &mut Criterion, model: &Model, dictionary: &mut D) {
    let keys = keys_of(model.setpoints);
    assert_works(dictionary, model, &keys);
    let mut bench = |operation: &str, run: &mut dyn FnMut()| {
        group(criterion, operation)
            .bench_function(format!("{}/{}", D::NAME, model.name), |bencher| bencher.iter(&mut *run));
    };
    bench("read u16", &mut || {
        for &index in &keys {
            black_box(dictionary.read(black_box(index), black_box(0)));
        }
    });
    bench("write u16", &mut || {
        for &index in &keys {
            black_box(dictionary.write(black_box(index), black_box(0), black_box(index).to_le_bytes()));
        }
    });
    let (records, arrays) = (keys_of(model.records), keys_of(model.arrays));
    bench("read record", &mut || {
        for &index in &records {
            black_box(dictionary.read(black_box(index), black_box(model::GAIN)));
        }
    });
    bench("write record", &mut || {
        for &index in &records {
            let value = black_box(index).to_le_bytes();
            black_box(dictionary.write(black_box(index), black_box(model::GAIN), value));
        }
    });
    bench("read array element", &mut || {
        for (number, &index) in (0..model::ELEMENTS).cycle().zip(&arrays) {
            black_box(dictionary.read(black_box(index), black_box(number + 1)));
        }
    });
    bench("find", &mut || {
        for &index in &keys {
            black_box(dictionary.find(black_box(index), black_box(0)));
        }
    });
    bench("find, missing sub-index", &mut || {
        for &index in &keys {
            black_box(dictionary.find(black_box(index), black_box(1)));
        }
    });
    if dictionary.setpoint().is_some() {
        bench("typed read", &mut || {
            for _ in &keys {
                black_box(black_box(&*dictionary).setpoint());
            }
        });
    }
    if dictionary.pack(&mut [0; 8]).is_some() {
        bench("PDO pack", &mut || {
            for _ in &keys {
                let mut frame = [0; 8];
                black_box(black_box(&mut *dictionary).pack(&mut frame));
                black_box(frame);
            }
        });
    }
    if dictionary.pack_default().is_some() {
        bench("PDO pack, default mapping", &mut || {
            for _ in &keys {
                black_box(black_box(&*dictionary).pack_default());
            }
        });
    }
    if dictionary.unpack(&[0; model::PDO_SIZE]).is_some() {
        bench("PDO unpack", &mut || {
            for _ in &keys {
                black_box(black_box(&mut *dictionary).unpack(black_box(&[0; model::PDO_SIZE])));
            }
        });
    }
}

fn group<'a>(criterion: &'a mut Criterion, operation: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = criterion.benchmark_group(operation);
    group.throughput(Throughput::Elements(KEYS as u64));
    group
}

/// What the loop itself costs.
fn floor(criterion: &mut Criterion) {
    let setpoints: Vec<u16> = (0x2000..0x2100).collect();
    let keys = keys_of(&setpoints);
    group(criterion, "empty loop").bench_function("floor/0", |bencher| {
        bencher.iter(|| {
            for &index in &keys {
                black_box((black_box(index), black_box(0_u8)));
            }
        });
    });
}

/// Measures all contenders that are enabled on a model. `OBJECT` is zencan's name of the first setpoint; without it, ours
/// alone.
macro_rules! contenders {
    ($criterion:ident, $feature:literal $model:ident $($object:ident $(, $canopen_rs:literal)?)?) => {
        #[cfg(feature = $feature)]
        {
            const MODEL: Model = include!(concat!(env!("OUT_DIR"), "/", $feature, "/controller.rs"));
            #[cfg(feature = "ours")]
            measure($criterion, &MODEL, &mut ours::$model::dictionary());
            $(
                #[cfg(feature = "zencan")]
                measure($criterion, &MODEL, &mut zencan::dictionary!($model, $object));
                $(
                    #[cfg(feature = $canopen_rs)]
                    measure($criterion, &MODEL, &mut *canopen_rs::dictionary!($model, &MODEL));
                )?
            )?
        }
    };
}

fn dictionaries(criterion: &mut Criterion) {
    floor(criterion);
    contenders!(criterion, "pmc" pmc OBJECT2030, "canopen-rs");
    contenders!(criterion, "pmm" pmm OBJECT2030, "canopen-rs");
    contenders!(criterion, "size150" size150 OBJECT2000, "canopen-rs");
    contenders!(criterion, "gappy150" gappy150 OBJECT2000, "canopen-rs");
    contenders!(criterion, "size2000" size2000 OBJECT2000, "canopen-rs-2000");
    contenders!(criterion, "gappy2000" gappy2000 OBJECT2000);
    contenders!(criterion, "size10000" size10000 OBJECT2000);
    contenders!(criterion, "gappy10000" gappy10000);
}

criterion_group! {
    name = benches;
    config = Criterion::default().warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(2)).sample_size(50);
    targets = dictionaries
}
criterion_main!(benches);
