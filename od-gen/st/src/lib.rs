//! Structured Text of IEC 61131-3: what a program of a PLC needs of a device.
//!
//! Three files for each device. `KEY-constants.st` is one list of constants: index and sub-index of every entry, limits, special
//! values, masks, states, error codes, COB-IDs. `KEY.st` has structures, functions and function blocks that need neither these
//! constants nor a library: raw values to quantities and back, bits, states, and each PDO as a structure, between its bytes and its
//! quantities. `KEY-enums.st` has the enums in the form that CODESYS V3 and TwinCAT 3 take; nothing else needs it, because other
//! tools have another form, or none.
//!
//! The code keeps to what does the same everywhere: no shifts, unions, pointers or bit access, conversions between types of one
//! width or to a wider one, no reliance on how a controller rounds. What a function cannot do it reports, and leaves the variable of
//! its caller as it was; no number is cut off or wrapped.

mod bits;
mod constants;
mod device;
mod elementary;
mod enums;
mod frames;
mod machines;
mod names;
mod pdos;
mod phrases;
mod quantities;
#[cfg(test)]
mod tests;
mod text;

use std::collections::BTreeMap;
use std::fmt;

use od_gen::Artifact;
use od_spec::eds::GENERATED;
use od_spec::model::{Dictionary, EntryId, System};
use od_spec::wording::Language;

use self::device::Device;
use self::pdos::Called;
use self::phrases::Phrase;
use self::text::Text;

/// The files of a device, and what the language cannot hold.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Written {
    /// The files.
    pub artifacts: Vec<Artifact>,
    /// What was left out, each with the reason.
    pub left_out: Vec<LeftOut>,
}

/// Something that the files do not have.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct LeftOut {
    /// `the bytes of TPDO1 of pmc`.
    pub what: String,
    /// Why.
    pub why: Why,
}

/// Why something is left out.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Why {
    /// The PDO has more bits than a frame of classical CAN.
    TooLong {
        /// Its bits.
        bits: u32,
    },
    /// The PDO carries nothing but placeholders.
    OnlyPlaceholders,
    /// The PDO carries a REAL.
    RealInBytes,
    /// The numbers of the scale are too large for LREAL to have them exactly.
    InexactScale {
        /// The unit.
        unit: String,
    },
    /// The entry is a REAL whose unit has a scale.
    RealWithScale {
        /// The unit.
        unit: String,
    },
    /// No value within the limits is one that LREAL has exactly.
    BeyondLreal,
}

/// `the bytes of TPDO1 of pmc: it carries a REAL …`.
impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let what = &self.what;
        match &self.why {
            Why::TooLong { bits } => write!(f, "{what}: it has {bits} bits, more than the 64 of a frame"),
            Why::OnlyPlaceholders => write!(f, "{what}: it carries nothing but placeholders"),
            Why::RealInBytes => {
                write!(f, "{what}: it carries a REAL, and tools differ in what converts its bits")
            }
            Why::InexactScale { unit } => {
                write!(f, "{what}: LREAL does not have the numbers in the scale of `{unit}` exactly")
            }
            Why::RealWithScale { unit } => {
                write!(f, "{what}: it is a REAL, which is not converted by the scale of `{unit}`")
            }
            Why::BeyondLreal => write!(f, "{what} to raw values: LREAL has none of its values exactly"),
        }
    }
}

/// The files of a device: with its COB-IDs and values for a node, where one is given, and with comments in a language of the
/// specification, else its first.
///
/// ```
/// use od_st::write;
/// use od_spec::source::SourceMap;
/// use od_spec::{NoFiles, compile};
///
/// let mut sources = SourceMap::new();
/// let root = sources.add("lamp.od.yaml", "
/// od-spec: 1
/// title: Lamp
/// uses: [cia301]
/// devices:
///   lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}
/// units: {percent: {symbol: '%', scale: 1/2}}
/// objects:
///   0x2000: {name: brightness, type: unsigned8, unit: percent, access: rw, max: 100 %, pdo: receive}
/// pdos: {lamp: {receive: {1: {map: [brightness]}}}}
/// ");
/// let system = compile(&mut sources, root, &mut NoFiles).system.expect("no errors");
/// let written = write(&system, &system.devices[0], Some(5), None);
/// let text = |path: &str| {
///     let file = written.artifacts.iter().find(|artifact| artifact.path == path).expect("a file");
///     String::from_utf8(file.bytes.clone()).expect("UTF-8")
/// };
/// assert!(text("lamp-constants.st").contains("LAMP_BRIGHTNESS_INDEX : UINT := 16#2000;"));
/// assert!(text("lamp-constants.st").contains("LAMP_RPDO1_CAN_ID : UDINT := 16#205;"));
/// assert!(text("lamp.st").contains("FUNCTION lamp_brightness_to_raw : BOOL"));
/// ```
pub fn write(system: &System, device: &Dictionary, node: Option<u8>, language: Option<&str>) -> Written {
    let texts = language.unwrap_or_else(|| system.language());
    written(Device::new(system, device, node, texts, Language::of(texts)))
}

/// The constant with the index of each entry, such as `PMC_STATUSWORD_INDEX`.
pub fn index_names(system: &System, device: &Dictionary) -> BTreeMap<EntryId, String> {
    let texts = system.language();
    let mut device = Device::new(system, device, None, texts, Language::of(texts));
    let groups = Parts::named(&mut device).of_entries;
    let ids = device.dictionary.entries().map(|(id, _, _)| id);
    // The index is the first constant of each entry.
    ids.zip(groups).filter_map(|(id, group)| Some((id, group.names().next()?.to_owned()))).collect()
}

/// Everything in the files of a device, with its names.
struct Parts<'a> {
    bits: Vec<bits::Bits<'a>>,
    machines: Vec<machines::Machine<'a>>,
    pdos: Vec<pdos::PlannedPdo<'a>>,
    quantities: Vec<quantities::Quantity<'a>>,
    of_pdos: Vec<constants::Group>,
    of_errors: Option<constants::Group>,
    of_entries: Vec<constants::Group>,
    of_enums: Vec<constants::Group>,
    enums: Vec<enums::Enum>,
    left_out: Vec<LeftOut>,
}

impl<'a> Parts<'a> {
    /// Gives all names, in this order: of two that would be the same, the later one gets a number.
    fn named(device: &mut Device<'a>) -> Self {
        let mut left_out = Vec::new();
        let bits = bits::bits(device);
        let machines = machines::machines(device);
        let pdos = pdos::pdos(device, &mut left_out);
        let quantities = quantities::quantities(device, &mut left_out);
        let of_pdos = pdos::constants(device);
        let of_errors = constants::of_errors(device);
        let of_entries = constants::of_entries(device);
        let of_enums = constants::of_enums(device);
        let enums = enums::enums(device, &machines);
        Self { bits, machines, pdos, quantities, of_pdos, of_errors, of_entries, of_enums, enums, left_out }
    }
}

fn written(mut device: Device<'_>) -> Written {
    let Parts { bits, machines, pdos, quantities, of_pdos, of_errors, of_entries, of_enums, enums, left_out } =
        Parts::named(&mut device);
    let device = &device;

    let mut lists = head(device, Phrase::ConstantsFile);
    lists.line("");
    lists.block("VAR_GLOBAL CONSTANT", "END_VAR", |text| {
        let groups = of_entries.iter().chain(&of_enums).chain(&of_pdos).chain(&of_errors);
        for (at, group) in groups.enumerate() {
            if at > 0 {
                text.line("");
            }
            group.print(text);
        }
        for bits in &bits {
            text.line("");
            bits.print_constants(device, text);
        }
        for machine in &machines {
            text.line("");
            machine.print_constants(device, text);
        }
    });

    let mut code = head(device, Phrase::CodeFile);
    for bits in &bits {
        bits.print_type(device, &mut code);
    }
    for pdo in &pdos {
        pdo.print_type(device, &mut code);
    }
    for quantity in &quantities {
        quantity.print(device, &mut code);
    }
    for bits in &bits {
        bits.print(device, &mut code);
    }
    for machine in &machines {
        machine.print(device, &mut code);
    }
    let by_entry = quantities::by_entry(&quantities);
    let called = Called { quantities: &by_entry, bits: &bits, machines: &machines };
    for pdo in &pdos {
        pdo.print_bytes(device, &mut code);
        pdo.print_block(device, &mut code, &called);
    }

    let mut types = head(device, Phrase::EnumsFile);
    for one in &enums {
        one.print(&mut types);
    }

    let key = &device.dictionary.key;
    let file = |path: String, text: Text, purpose: &str| Artifact {
        path,
        bytes: text.into_bytes(),
        purpose: purpose.to_owned(),
    };
    let mut artifacts = vec![
        file(
            format!("{key}.st"),
            code,
            "structures, functions and function blocks, for any IEC 61131-3 tool",
        ),
        file(format!("{key}-constants.st"), lists, "a list of global constants"),
    ];
    if !enums.is_empty() {
        let purpose = "enums, for CODESYS V3 and TwinCAT 3";
        artifacts.push(file(format!("{key}-enums.st"), types, purpose));
    }
    Written { artifacts, left_out }
}

/// The beginning of a file: that it is generated, what it is for, and for which node.
fn head(device: &Device<'_>, what: Phrase) -> Text {
    let mut text = Text::default();
    text.comment(&[GENERATED.to_owned()]);
    let name = format!("{} ({})", device.dictionary.name, device.dictionary.key);
    let mut about = vec![device.phrase(what, &[&name])];
    about.extend(device.node.map(|node| device.phrase(Phrase::OfNode, &[&node.to_string()])));
    about.push(device.phrase(Phrase::Encoding, &[]));
    text.comment(&about);
    text
}
