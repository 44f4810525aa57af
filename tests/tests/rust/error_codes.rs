//! Errors in generated code: the register, priority and reaction that the specification states, or that CiA 301 says.

use std::collections::BTreeMap;

use firmware_glue::emcy::Emergency;
use firmware_glue::error_register::ErrorRegister;
use od_documents::{self as docs, Format, Templates};
use od_generated::{fullmo, pmc, pmm};
use od_spec::model::{Devices, ErrorCode, ErrorKind, System};
use od_tests::compile_clean;

#[allow(
    clippy::all,
    clippy::pedantic,
    reason = "what users' lints say about generated code is tested with od-generated"
)]
mod oven {
    od_macros::object_dictionary!("shared/errors.od.yaml", device = "oven");
}

#[allow(
    clippy::all,
    clippy::pedantic,
    reason = "what users' lints say about generated code is tested with od-generated"
)]
mod hood {
    od_macros::object_dictionary!("shared/errors.od.yaml", device = "hood");
}

/// The model of a code that says nothing but itself.
fn bare(system: &System, code: u16) -> ErrorCode {
    let mut error = system.errors[0].clone();
    (error.code, error.kinds) = (code, Vec::new());
    error
}

#[test]
fn the_generator_and_the_firmware_know_the_same_classes() {
    let system = compile_clean("od-spec/devices/fullmo-drive.od.yaml").unwrap();
    for code in 0..=u16::MAX {
        assert_eq!(bare(&system, code).register(), ErrorRegister::of_code(code).bits(), "{code:04X}");
    }
    // CiA 301 by hand: a code of each class, and the bits of table 48.
    for (code, bits) in [
        (0x0000, 0),
        (0x1000, 1),
        (0x2310, 1 | 2),
        (0x3210, 1 | 4),
        (0x4210, 1 | 8),
        (0x5530, 1),
        (0x6320, 1),
        (0x7305, 1),
        (0x8130, 1 | 16),
        (0x8210, 1 | 16),
        (0x8611, 1),
        (0xF001, 1),
        (0xFF01, 1 | 128),
    ] {
        assert_eq!(ErrorRegister::of_code(code).bits(), bits, "{code:04X}");
    }
    for kind in ErrorKind::WORDS.iter().map(|word| ErrorKind::from_word(word).unwrap()) {
        let own = match kind {
            ErrorKind::Generic => ErrorRegister::GENERIC,
            ErrorKind::Current => ErrorRegister::CURRENT,
            ErrorKind::Voltage => ErrorRegister::VOLTAGE,
            ErrorKind::Temperature => ErrorRegister::TEMPERATURE,
            ErrorKind::Communication => ErrorRegister::COMMUNICATION,
            ErrorKind::Profile => ErrorRegister::PROFILE,
            ErrorKind::Manufacturer => ErrorRegister::MANUFACTURER,
        };
        assert_eq!(own.bits(), 1 << kind.bit(), "{}", kind.word());
    }
}

/// What generated code says of an error: name, bits of 1001h, priority, reaction.
type Said = (String, u8, Option<String>, Option<String>);

fn modelled(system: &System, device: &str) -> BTreeMap<u16, Said> {
    let errors = system.errors.iter().filter(|error| error.devices.includes(device) && error.code != 0);
    let said = errors.map(|error| {
        let treats = error.treated_by.includes(device);
        let priority = error.priority.clone().filter(|_| treats);
        let reaction = error.reaction.get(system.language()).map(ToOwned::to_owned).filter(|_| treats);
        (error.code, (error.name.clone(), error.register(), priority, reaction))
    });
    said.collect()
}

macro_rules! generated {
    ($module:ident, $treatment:expr) => {{
        let all = $module::errors::ErrorCode::ALL;
        for code in 0..=u16::MAX {
            let known = all.into_iter().find(|error| error.code() == code);
            assert_eq!($module::errors::ErrorCode::of(code), known);
        }
        assert!(all.is_sorted());
        let said = all.into_iter().map(|error| {
            let treatment: fn($module::errors::ErrorCode) -> (Option<&'static str>, Option<&'static str>) =
                $treatment;
            let (priority, reaction) = treatment(error);
            let (priority, reaction) = (priority.map(ToOwned::to_owned), reaction.map(ToOwned::to_owned));
            (error.code(), (error.name().to_owned(), error.register().bits(), priority, reaction))
        });
        said.collect::<BTreeMap<u16, Said>>()
    }};
}

#[test]
fn the_types_say_what_the_specifications_say() {
    let pitch = compile_clean("od-spec/devices/pitch-control-system.od.yaml").unwrap();
    assert_eq!(
        generated!(pmc, |error| (error.priority().map(pmc::errors::Priority::name), error.reaction())),
        modelled(&pitch, "pmc")
    );
    // The manual states priorities and reactions for the motion controller only.
    assert_eq!(generated!(pmm, |_| (None, None)), modelled(&pitch, "pmm"));
    let drive = compile_clean("od-spec/devices/fullmo-drive.od.yaml").unwrap();
    assert_eq!(generated!(fullmo, |_| (None, None)), modelled(&drive, "fullmo"));
    let ovens = compile_clean("tests/shared/errors.od.yaml").unwrap();
    assert_eq!(
        generated!(oven, |error| (error.priority().map(oven::errors::Priority::name), error.reaction())),
        modelled(&ovens, "oven")
    );
    let of_hood = modelled(&ovens, "hood");
    assert_eq!(of_hood[&0x4210].2, None, "only the oven treats it so");
    assert_eq!(of_hood[&0x5000].2.as_deref(), Some("2 a"));
    assert_eq!(
        hood::errors::ErrorCode::ALL.map(|error| error.priority().map(hood::errors::Priority::name)),
        [None, Some("2 a")]
    );
    assert_eq!(ovens.errors[1].treated_by, Devices::one("oven"));
}

/// Table 48 of the pitch manual.
#[test]
fn reactions_are_those_of_the_manual() {
    use pmc::errors::ErrorCode;
    let chosen = ErrorCode::ALL
        .into_iter()
        .filter(|error| error.option_code() == Some(pmc::Entry::FaultReactionOptionCode));
    assert_eq!(chosen.map(ErrorCode::code).collect::<Vec<_>>(), [0x7305, 0x7320, 0x7321, 0x8611]);
    let fixed = ErrorCode::ALL.into_iter().filter(|error| error.reaction().is_some()).map(ErrorCode::code);
    assert_eq!(
        fixed.collect::<Vec<_>>(),
        [0x2310, 0x2320, 0x3210, 0x3220, 0x4210, 0x4310, 0x6010, 0x6080, 0x6320, 0x6380, 0x8400]
    );
    assert!(ErrorCode::ALL.iter().all(|error| error.option_code().is_none() || error.reaction().is_none()));
}

#[test]
fn stated_bits_go_before_those_of_the_class_and_reach_emergencies() {
    use oven::errors::ErrorCode;
    let bits = ErrorCode::ALL.map(|error| (error.code(), error.register().bits()));
    assert_eq!(
        bits,
        [(0x2310, 0b11), (0x2311, 0b11), (0x4210, 0b1000_1001), (0x5000, 1), (0xFF00, 0b1010_0001)]
    );
    let emergency = Emergency::of(ErrorCode::TooHot);
    assert_eq!(
        (emergency.code(), emergency.register()),
        (0x4210, DeviceErrorRegister::of(ErrorCode::TooHot))
    );
    assert_ne!(emergency.register(), Emergency::new(0x4210).register());
    assert_eq!(ErrorCode::Current2.option_code(), Some(oven::Entry::WhatToDo));
    assert_eq!(ErrorCode::Self_.name(), "self");
}

/// The register by the trait, as generic code asks for it.
struct DeviceErrorRegister;

impl DeviceErrorRegister {
    fn of<E: firmware_glue::error_register::DeviceError>(error: E) -> ErrorRegister {
        error.register()
    }
}

/// The list of errors has a column for the bits of 1001h where they are stated, and none elsewhere.
#[test]
fn documents_show_stated_bits() {
    let page = |path: &str, language: &str| {
        let system = compile_clean(path).unwrap();
        let options = docs::options(&system, &[], Some(language));
        let templates = [Templates::new(Some(Format::Markdown), &[]).unwrap()];
        let files = docs::artifacts(&system, "", "s", &options, &templates).unwrap();
        let file = files.iter().find(|file| file.path.ends_with("errors.md")).unwrap();
        String::from_utf8(file.bytes.clone()).unwrap()
    };
    let row = |page: &str, name: &str| -> Vec<String> {
        let line = page.lines().find(|line| line.contains(name)).unwrap();
        line.split('|').map(|cell| cell.trim().to_owned()).collect()
    };
    for (language, said) in [("en", "temperature, manufacturer"), ("de", "Temperatur, Hersteller")] {
        let errors = page("tests/shared/errors.od.yaml", language);
        let at = row(&errors, "In 1001h").iter().position(|cell| cell == "In 1001h").unwrap();
        assert_eq!(row(&errors, "too hot")[at], said);
        assert_eq!(row(&errors, "current 1")[at], "");
    }
    assert!(!page("od-spec/devices/fullmo-drive.od.yaml", "de").contains("In 1001h"));
}
