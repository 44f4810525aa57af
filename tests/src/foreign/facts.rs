//! Which facts of two models of one device differ.

use std::fmt::{self, Debug};

use od_spec::ascii::transliterate;
use od_spec::model::{Dictionary, Entry, EntryId, Index, Object, PdoMapping, SubIndex, Value};

/// A fact that an EDS states.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stated {
    /// That the object or entry is there.
    Existence,
    /// `ObjectType`.
    Kind,
    /// `DataType`.
    Type,
    /// `AccessType`.
    Access,
    /// `PDOMapping`.
    Mapping,
    /// `DefaultValue`.
    Default,
    /// `LowLimit`.
    LowLimit,
    /// `HighLimit`.
    HighLimit,
    /// `ObjFlags`.
    Flags,
    /// `ParameterName`.
    Name,
    /// `[xxxxObjectLinks]`.
    Links,
    /// A fact of `[FileInfo]`, `[DeviceInfo]`, `[DummyUsage]` or `[DynamicChannels]`.
    Device(&'static str),
}

impl fmt::Display for Stated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Stated::Existence => "existence",
            Stated::Kind => "object type",
            Stated::Type => "data type",
            Stated::Access => "access",
            Stated::Mapping => "mapping",
            Stated::Default => "default",
            Stated::LowLimit => "low limit",
            Stated::HighLimit => "high limit",
            Stated::Flags => "flags",
            Stated::Name => "name",
            Stated::Links => "links",
            Stated::Device(fact) => fact,
        })
    }
}

/// A fact that two models state differently.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Difference {
    /// Where; `None` for the device.
    pub place: Option<EntryId>,
    /// Which fact.
    pub fact: Stated,
    /// What the first model says.
    pub before: String,
    /// What the second model says.
    pub after: String,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { place, fact, before, after } = self;
        match place {
            Some(id) => write!(f, "{id}: {fact}: {before}, then {after}"),
            None => write!(f, "{fact}: {before}, then {after}"),
        }
    }
}

/// Every fact that a file made of the second model states otherwise than one made of the first.
pub fn differences(before: &Dictionary, after: &Dictionary) -> Vec<Difference> {
    let mut found = device(before, after);
    let indices =
        before.objects.keys().chain(after.objects.keys().filter(|at| !before.objects.contains_key(at)));
    for &index in indices {
        match (before.objects.get(&index), after.objects.get(&index)) {
            (Some(one), Some(other)) => object(one, other, &mut found),
            (one, other) => found.push(existence(index, SubIndex(0), one.is_some(), other.is_some())),
        }
    }
    found
}

fn device(before: &Dictionary, after: &Dictionary) -> Vec<Difference> {
    let (one, other) = (&before.info, &after.info);
    let texts = |text: &str| transliterate(text);
    [
        fact(None, Stated::Device("product name"), &texts(&one.product_name), &texts(&other.product_name)),
        fact(None, Stated::Device("product"), &one.product, &other.product),
        fact(None, Stated::Device("product revision"), &one.product_revision, &other.product_revision),
        fact(None, Stated::Device("order code"), &texts(&one.order_code), &texts(&other.order_code)),
        fact(None, Stated::Device("bit rates"), &one.bit_rates, &other.bit_rates),
        fact(None, Stated::Device("device type"), &one.device_type, &other.device_type),
        fact(None, Stated::Device("granularity"), &one.granularity, &other.granularity),
        fact(None, Stated::Device("boot-up master"), &one.boot_up_master, &other.boot_up_master),
        fact(None, Stated::Device("boot-up slave"), &one.boot_up_slave, &other.boot_up_slave),
        fact(None, Stated::Device("group messaging"), &one.group_messaging, &other.group_messaging),
        fact(None, Stated::Device("LSS"), &one.lss, &other.lss),
        fact(None, Stated::Device("placeholders"), &one.dummies, &other.dummies),
        fact(None, Stated::Device("dynamic channels"), &one.dynamic_channels, &other.dynamic_channels),
        fact(
            None,
            Stated::Device("description"),
            &texts(&before.file.description),
            &texts(&after.file.description),
        ),
        fact(None, Stated::Device("created"), &before.file.created, &after.file.created),
        fact(
            None,
            Stated::Device("created by"),
            &texts(&before.file.created_by),
            &texts(&after.file.created_by),
        ),
        fact(None, Stated::Device("modified"), &before.file.modified, &after.file.modified),
        fact(
            None,
            Stated::Device("modified by"),
            &texts(&before.file.modified_by),
            &texts(&after.file.modified_by),
        ),
        fact(None, Stated::Device("file version"), &before.file.version, &after.file.version),
        fact(None, Stated::Device("file revision"), &before.file.revision, &after.file.revision),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn fact<T: PartialEq + Debug>(
    place: Option<EntryId>,
    fact: Stated,
    before: &T,
    after: &T,
) -> Option<Difference> {
    (before != after).then(|| Difference {
        place,
        fact,
        before: format!("{before:?}"),
        after: format!("{after:?}"),
    })
}

fn existence(index: Index, sub: SubIndex, before: bool, after: bool) -> Difference {
    let word = |is_there: bool| if is_there { "there" } else { "missing" }.to_owned();
    let place = Some(EntryId { index, sub });
    Difference { place, fact: Stated::Existence, before: word(before), after: word(after) }
}

fn object(before: &Object, after: &Object, found: &mut Vec<Difference>) {
    let index = before.index;
    let whole = Some(EntryId { index, sub: SubIndex(0) });
    found.extend(fact(whole, Stated::Kind, &before.kind, &after.kind));
    let links = |object: &Object| object.linked().collect::<Vec<_>>();
    found.extend(fact(whole, Stated::Links, &links(before), &links(after)));
    let named =
        |id, one: &str, other: &str| fact(id, Stated::Name, &transliterate(one), &transliterate(other));
    found.extend(named(whole, &before.name, &after.name));
    for one in &before.entries {
        let id = EntryId { index, sub: one.sub };
        match after.entry(one.sub) {
            Some(other) => {
                found.extend(entry(id, one, other));
                if before.is_structured() {
                    found.extend(named(Some(id), &one.name, &other.name));
                }
            }
            None => found.push(existence(index, one.sub, true, false)),
        }
    }
    let more = after.entries.iter().filter(|other| before.entry(other.sub).is_none());
    found.extend(more.map(|other| existence(index, other.sub, false, true)));
}

fn entry(id: EntryId, before: &Entry, after: &Entry) -> impl Iterator<Item = Difference> {
    let is_mapped = |entry: &Entry| entry.pdo != PdoMapping::None;
    let ((low, high), (other_low, other_high)) = (before.hull(), after.hull());
    let place = Some(id);
    [
        fact(place, Stated::Type, &before.data_type, &after.data_type),
        fact(place, Stated::Access, &before.eds.access, &after.eds.access),
        fact(place, Stated::Mapping, &is_mapped(before), &is_mapped(after)),
        fact(place, Stated::Default, &default(before), &default(after)),
        fact(place, Stated::LowLimit, &low, &other_low),
        fact(place, Stated::HighLimit, &high, &other_high),
        fact(place, Stated::Flags, &before.eds.flags(), &after.eds.flags()),
    ]
    .into_iter()
    .flatten()
}

/// A default to the last bit, if the file states it.
fn default(entry: &Entry) -> Option<String> {
    entry.default.as_ref().filter(|_| entry.eds.default).map(|default| match default {
        Value::Real(real) => format!("real {:X}", real.number().to_bits()),
        Value::Text(text) => format!("{:?}", transliterate(text)),
        other @ (Value::Integer(_) | Value::NodeId(_) | Value::Bytes(_)) => format!("{other:?}"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::foreign::tests::device;

    const LAMP: &str = "[FileInfo]
FileVersion=1
Description=light
CreationTime=09:00AM
CreationDate=01-31-2020
[DeviceInfo]
ProductName=Lamp
OrderCode=L1
BaudRate_125=1
[DummyUsage]
Dummy0005=0
[2000]
ParameterName=level
ObjectType=0x7
DataType=0x0005
LowLimit=1
HighLimit=9
AccessType=rw
DefaultValue=4
PDOMapping=0
ObjFlags=0
[2001]
ParameterName=steps
ObjectType=0x8
SubNumber=2
[2001sub0]
ParameterName=count
ObjectType=0x7
DataType=0x0005
AccessType=ro
DefaultValue=1
PDOMapping=0
[2001sub1]
ParameterName=first
ObjectType=0x7
DataType=0x0007
AccessType=ro
PDOMapping=0
";

    /// What is reported when a part of the file is another.
    fn reported(part: &str, other: &str) -> Vec<String> {
        assert!(LAMP.contains(part), "{part}");
        let (before, after) = (device(LAMP), device(&LAMP.replacen(part, other, 1)));
        differences(&before, &after).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn every_planted_difference_is_found() {
        for (part, other, expected) in [
            ("FileVersion=1", "FileVersion=2", "file version: 1, then 2"),
            ("ProductName=Lamp", "ProductName=Lump", "product name: \"Lamp\", then \"Lump\""),
            ("BaudRate_125=1", "BaudRate_250=1", "bit rates: [125], then [250]"),
            ("Dummy0005=0", "Dummy0005=1", "placeholders: [], then [Unsigned8]"),
            ("=level", "=lever", "2000h: name: \"level\", then \"lever\""),
            ("DataType=0x0005", "DataType=0x0006", "2000h: data type: Unsigned8, then Unsigned16"),
            ("LowLimit=1", "LowLimit=2", "2000h: low limit: Some(1), then Some(2)"),
            ("HighLimit=9", "HighLimit=8", "2000h: high limit: Some(9), then Some(8)"),
            ("AccessType=rw", "AccessType=rwr", "2000h: access: Rw, then Rwr"),
            (
                "DefaultValue=4",
                "DefaultValue=5",
                "2000h: default: Some(\"Integer(4)\"), then Some(\"Integer(5)\")",
            ),
            ("DefaultValue=4\n", "", "2000h: default: Some(\"Integer(4)\"), then None"),
            ("PDOMapping=0", "PDOMapping=1", "2000h: mapping: false, then true"),
            ("ObjFlags=0", "ObjFlags=3", "2000h: flags: 0, then 3"),
            ("ObjectType=0x8", "ObjectType=0x9", "2001h: object type: Array, then Record"),
            ("=first", "=second", "2001h.1: name: \"first\", then \"second\""),
        ] {
            assert_eq!(reported(part, other), [expected]);
        }
    }

    #[test]
    fn objects_and_entries_that_are_missing_or_more_are_found() {
        let (whole, without) = (device(LAMP), device(LAMP.split("[2001]").next().unwrap_or_default()));
        let said = |one: &Dictionary, other: &Dictionary| {
            differences(one, other).iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        assert_eq!(said(&whole, &without), ["2001h: existence: there, then missing"]);
        assert_eq!(said(&without, &whole), ["2001h: existence: missing, then there"]);
        let more = LAMP.replace(
            "[2001sub1]",
            "[2001sub2]\nParameterName=second\nDataType=0x0007\nAccessType=ro\n[2001sub1]",
        );
        assert_eq!(said(&whole, &device(&more)), ["2001h.2: existence: missing, then there"]);
        assert_eq!(said(&device(&more), &whole), ["2001h.2: existence: there, then missing"]);
        assert_eq!(said(&whole, &whole), [""; 0]);
    }
}
