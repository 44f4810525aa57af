//! Dictionaries in plain C: two compilers, platforms of 32 and 64 bits, C++ for the headers, and an emulated Cortex-M.

use std::path::PathBuf;

use od_bus::runtime::{self, LiveDictionary};
use od_generated::{fullmo::Fullmo, pmc::Pmc, pmm::Pmm};
use od_spec::diag::Diagnostics;
use od_tests::c_dictionary::{
    Compiler, DICTIONARY, Exchange, Host, Reference, SDO_SERVER, SdoTrial, Trial, compare, compile_header,
    emulate, write,
};
use od_tests::{Failure, root};

use crate::parts::Amount;
use crate::runner::Runner;
use crate::tools::thumb_linker;

/// Requests at random, in addition to those that go through all entries; the sample is the first of all.
const fn random(amount: Amount) -> usize {
    match amount {
        Amount::Sample => 5_000,
        Amount::All => 20_000,
    }
}

const PITCH: &str = "od-spec/devices/pitch-control-system.od.yaml";
const FULLMO: &str = "od-spec/devices/fullmo-drive.od.yaml";
/// Specifications of the tests, of one device each.
const TESTED: [&str; 4] = [
    "tests/readers/everything.od.yaml",
    "tests/readers/limits.od.yaml",
    "tests/readers/scales.od.yaml",
    "tests/c/conditions.od.yaml",
];

/// The valve of the book with values of more kinds.
const SERVED: &str = "tests/c/valve.od.yaml";

/// What Rust links with is tried by the Rust tests.
fn compilers() -> [Compiler; 4] {
    let thumb = ["--target=thumbv7em-none-eabi", "-ffreestanding"];
    [
        Compiler::new("clang", &[]),
        Compiler::new("clang", &["-m32", "-ffreestanding"]),
        Compiler::new("cc", &["-m32", "-ffreestanding"]),
        Compiler::new("clang", &thumb),
    ]
}

/// Compiles and asks them all.
pub(crate) fn try_all(runner: &mut Runner, amount: Amount) -> Result<(), Failure> {
    let random = random(amount);
    let directory = root().join("target/plain-c");
    let _ = std::fs::remove_dir_all(&directory);
    let mut trial = PlainC { directory, runner };
    // The Rust tests ask them on the host.
    if amount == Amount::All {
        trial.device(PITCH, "pmc", |seed| {
            Trial::new(Reference::generated(Pmc::new(5)), seed).exchange(random)
        })?;
        trial.device(PITCH, "pmm", |seed| {
            Trial::new(Reference::generated(Pmm::new(5)), seed).exchange(random)
        })?;
        trial.device(FULLMO, "fullmo", |seed| {
            Trial::new(Reference::generated(Fullmo::new(5)), seed).exchange(random)
        })?;
    }
    for path in TESTED {
        let system = write(path, &trial.directory)?.system;
        let [device] = system.devices.as_slice() else {
            return Err(format!("{path} has several devices").into());
        };
        let live = runtime::device(&system, device, &mut Diagnostics::new()).ok_or("no table can be made")?;
        let lists = live.lists();
        let table = lists.table().map_err(|error| error.to_string())?;
        let dictionary = LiveDictionary::new(&live, &table, 5)?;
        trial.device(path, &device.key, |seed| {
            Trial::new(Reference::plain(dictionary), seed).exchange(random)
        })?;
    }
    trial.sdo_server()
}

struct PlainC<'r> {
    directory: PathBuf,
    runner: &'r mut Runner,
}

impl PlainC<'_> {
    /// The SDO server of the book, on a dictionary with values of all lengths.
    fn sdo_server(&mut self) -> Result<(), Failure> {
        const NODE: u8 = 5;
        let directory = self.directory.join("sdo");
        let written = write(SERVED, &directory)?;
        let [device] = written.system.devices.as_slice() else {
            return Err(format!("{SERVED} has several devices").into());
        };
        let live = runtime::device(&written.system, device, &mut Diagnostics::new())
            .ok_or("no table can be made")?;
        let lists = live.lists();
        let table = lists.table().map_err(|error| error.to_string())?;
        let exchange = SdoTrial::new(LiveDictionary::new(&live, &table, NODE)?, NODE)?.exchange();
        let [clang, _, _, thumb] = compilers();
        let host = Host::build_with(&clang, &directory, &device.key, &SDO_SERVER)?;
        compare(&exchange, &host.ask(&exchange)?)?;
        let linker = thumb_linker().ok_or("no linker for a Cortex-M")?;
        let said = emulate(&thumb, &linker, &directory, &device.key, &SDO_SERVER, &exchange)?;
        self.runner
            .print(&format!("SDO server: {} frames on the host, and on a Cortex-M {said}", exchange.len()));
        Ok(())
    }

    fn device(
        &mut self,
        path: &str,
        key: &str,
        exchange: impl FnOnce(u64) -> Vec<Exchange>,
    ) -> Result<(), Failure> {
        let directory = self.directory.join(key);
        write(path, &directory)?;
        let compilers = compilers();
        for compiler in &compilers {
            compiler.objects(&directory, key)?;
        }
        compile_header(&directory, key)?;
        let [clang, _, _, thumb] = compilers;
        let exchange = exchange(2);
        compare(&exchange, &Host::build(&clang, &directory, key)?.ask(&exchange)?)?;
        let linker = thumb_linker().ok_or("no linker for a Cortex-M")?;
        let said = emulate(&thumb, &linker, &directory, key, &DICTIONARY, &exchange)?;
        self.runner
            .print(&format!("{key}: {} requests on the host, and on a Cortex-M {said}", exchange.len()));
        Ok(())
    }
}
