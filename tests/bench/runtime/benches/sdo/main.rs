//! Round trips of SDO: a client asks, a server over the contender's dictionary answers, the client understands. Nothing is between the two
//! but frames.
//!
//! One iteration does it for 1024 keys, which are those of the bench `dictionary`.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};

#[cfg(feature = "canopen-rs")]
mod canopen_rs;
#[cfg(feature = "ours")]
mod ours;

#[path = "../shared/model.rs"]
mod keys;

use keys::{KEYS, Model, keys};

/// A client, a server and a dictionary.
trait RoundTrip {
    const NAME: &str;

    /// Reads a u16; `None` if that failed.
    fn read(&mut self, index: u16) -> Option<u16>;

    /// Writes a u16; whether that went well.
    fn write(&mut self, index: u16, value: u16) -> bool;
}

/// Both operations of one contender on one model.
fn measure<R: RoundTrip>(criterion: &mut Criterion, model: &Model, mut pair: R) {
    let keys = keys(model.setpoints);
    // It does what is going to be measured.
    for (number, index) in (0..).zip(&keys) {
        assert!(pair.write(*index, number), "{index:X}h cannot be written");
        assert_eq!(pair.read(*index), Some(number));
    }
    assert!(!pair.write(model.position, 0), "a read-only entry was written");
    let mut bench = |operation: &str, run: &mut dyn FnMut()| {
        let mut group = criterion.benchmark_group(operation);
        group.throughput(Throughput::Elements(KEYS as u64));
        group.bench_function(format!("{}/{}", R::NAME, model.name), |bencher| bencher.iter(&mut *run));
    };
    bench("SDO read", &mut || {
        for index in &keys {
            black_box(pair.read(black_box(*index)));
        }
    });
    bench("SDO write", &mut || {
        for index in &keys {
            black_box(pair.write(black_box(*index), black_box(*index)));
        }
    });
}

macro_rules! contenders {
    ($criterion:ident, $($feature:literal $model:ident),+) => {$(
        #[cfg(feature = $feature)]
        {
            const MODEL: Model = include!(concat!(env!("OUT_DIR"), "/", $feature, "/controller.rs"));
            #[cfg(feature = "ours")]
            measure($criterion, &MODEL, ours::$model::pair());
            #[cfg(feature = "canopen-rs")]
            measure($criterion, &MODEL, canopen_rs::pair(bench_canopen_rs::$model::device_od()));
        }
    )+};
}

/// 100 kB into a DOMAIN in blocks: canopen-rs has no server for them.
#[cfg(feature = "ours")]
fn blocks(criterion: &mut Criterion) {
    let data: Vec<u8> = (0..100_000_u32).map(|at| at.to_le_bytes()[0]).collect();
    ours::with_domain(|domain| {
        assert_eq!(domain.download(&data), data, "what came is not what was sent");
        let mut group = criterion.benchmark_group("SDO block download of 100 kB");
        group.throughput(Throughput::Elements(1));
        group.bench_function("ours/domain", |bencher| {
            bencher.iter(|| black_box(domain.download(black_box(&data))).len());
        });
    });
}

fn round_trips(criterion: &mut Criterion) {
    contenders!(criterion, "pmc" pmc, "size150" size150, "gappy150" gappy150);
    #[cfg(feature = "ours")]
    blocks(criterion);
}

criterion_group! {
    name = benches;
    config = Criterion::default().warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(2)).sample_size(50);
    targets = round_trips
}
criterion_main!(benches);
