//! Which keys a section may have, and how the standard spells them.

use crate::eds::names::{ModuleTopic, Topic, topic};

const FILE_INFO: &[&str] = &[
    "FileName",
    "FileVersion",
    "FileRevision",
    "EDSVersion",
    "Description",
    "CreationTime",
    "CreationDate",
    "CreatedBy",
    "ModificationTime",
    "ModificationDate",
    "ModifiedBy",
    "LastEDS",
];
/// Keys of `[DeviceInfo]` that identify the device and its vendor.
pub(super) const IDENTITY: &[&str] =
    &["VendorName", "VendorNumber", "ProductName", "ProductNumber", "RevisionNumber", "OrderCode"];
/// Keys of `[DeviceInfo]` that state what the device can do, and that every file has.
pub(super) const ABILITIES: &[&str] = &[
    "BaudRate_10",
    "BaudRate_20",
    "BaudRate_50",
    "BaudRate_125",
    "BaudRate_250",
    "BaudRate_500",
    "BaudRate_800",
    "BaudRate_1000",
    "SimpleBootUpMaster",
    "SimpleBootUpSlave",
    "Granularity",
    "DynamicChannelsSupported",
    "GroupMessaging",
    "NrOfRXPDO",
    "NrOfTXPDO",
    "LSS_Supported",
];
/// Keys of `[DeviceInfo]` that a device without what they state leaves out.
const FURTHER_ABILITIES: &[&str] =
    &["CompactPDO", "CANopenSafetySupported", "NG_Slave", "NG_Master", "NrOfNG_MonitoredNodes"];
/// Keys of `[DeviceInfo]` that are reserved for EDS of version 3 (CiA 306 4.5).
pub(in crate::eds) const RESERVED: &[&str] = &[
    "ProductVersion",
    "ProductRevision",
    "LMT_ManufacturerName",
    "LMT_ProductName",
    "ExtendedBootUpMaster",
    "ExtendedBootUpSlave",
];
const COMMISSIONING: &[&str] = &[
    "NodeID",
    "NodeName",
    "NodeRefd",
    "Baudrate",
    "NetNumber",
    "NetworkName",
    "NetRefd",
    "CANopenManager",
    "LSS_SerialNumber",
];
const OBJECT: &[&str] = &[
    "ParameterName",
    "ObjectType",
    "DataType",
    "AccessType",
    "DefaultValue",
    "PDOMapping",
    "SubNumber",
    "LowLimit",
    "HighLimit",
    "ParameterValue",
    "ObjFlags",
    "CompactSubObj",
    "Denotation",
    "UploadFile",
    "DownloadFile",
    "ParamRefd",
    "SRDOMapping",
    "InvertedSRAD",
];
/// Keys that the model has no place for.
pub(in crate::eds) const UNREAD: [&str; 6] = [
    "SRDOMapping",
    "InvertedSRAD",
    "CANopenSafetySupported",
    "NG_Slave",
    "NG_Master",
    "NrOfNG_MonitoredNodes",
];
const EXTENSION: &[&str] = &["Count", "ObjExtend"];
const MODULE_INFO: &[&str] = &["ProductName", "ProductVersion", "ProductRevision", "OrderCode"];

/// Keys that hold a text for people.
pub(super) const TEXTS: [&str; 12] = [
    "ParameterName",
    "Denotation",
    "FileName",
    "Description",
    "CreatedBy",
    "ModifiedBy",
    "LastEDS",
    "VendorName",
    "ProductName",
    "OrderCode",
    "NodeName",
    "NetworkName",
];
/// Keys that count what a section lists.
const COUNTS: &[&str] = &["NrOfEntries", "SupportedObjects", "ObjectLinks", "Lines"];

/// Whether a key is one of the standard's, and holds a number, a date, a word or a value instead of a text.
pub(super) fn is_no_text(key: &str) -> bool {
    let is_among = |names: &[&str]| names.iter().any(|name| name.eq_ignore_ascii_case(key));
    let known = [
        FILE_INFO,
        IDENTITY,
        ABILITIES,
        FURTHER_ABILITIES,
        RESERVED,
        COMMISSIONING,
        OBJECT,
        EXTENSION,
        MODULE_INFO,
        COUNTS,
    ];
    let is_dummy = key.get(..5).is_some_and(|front| front.eq_ignore_ascii_case("Dummy"));
    is_dummy || (known.into_iter().any(is_among) && !is_among(&TEXTS))
}

/// The keys with a name that the section of a name may have, as the standard spells them.
pub fn keys_of_section(name: &str) -> impl Iterator<Item = &'static str> {
    of(topic(name)).into_iter().flat_map(|keys| keys.named.iter().copied().flatten().copied())
}

/// The keys of a section.
#[derive(Clone, Copy)]
pub(in crate::eds) struct Keys {
    /// Those with a name, by what they are about.
    named: &'static [&'static [&'static str]],
    /// Those with a number.
    numbered: Numbered,
}

/// Keys that end with a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Numbered {
    None,
    /// `Line1`, or `1`.
    Decimal(&'static str),
    /// `Dummy0001`.
    Dummy,
}

/// The keys of a section; `None` where any may be.
pub(in crate::eds) fn of(topic: Topic) -> Option<Keys> {
    const LINES: Keys = keys(&[&["Lines"]], Numbered::Decimal("Line"));
    const ENTRIES: Keys = keys(&[&["NrOfEntries"]], Numbered::Decimal(""));
    Some(match topic {
        Topic::FileInfo => keys(&[FILE_INFO], Numbered::None),
        Topic::DeviceInfo => keys(&[IDENTITY, ABILITIES, FURTHER_ABILITIES, RESERVED], Numbered::None),
        Topic::DummyUsage => keys(&[], Numbered::Dummy),
        Topic::Comments | Topic::Module(_, ModuleTopic::Comments) => LINES,
        Topic::Objects(_) => keys(&[&["SupportedObjects"]], Numbered::Decimal("")),
        Topic::Commissioning => keys(&[COMMISSIONING], Numbered::None),
        Topic::Object(_) | Topic::Sub(..) | Topic::Module(_, ModuleTopic::Fixed(..)) => {
            keys(&[OBJECT], Numbered::None)
        }
        Topic::Module(_, ModuleTopic::SubExtension(_)) => keys(&[OBJECT, EXTENSION], Numbered::None),
        Topic::Elements(..)
        | Topic::ConnectedModules
        | Topic::Module(_, ModuleTopic::FixedObjects | ModuleTopic::SubExtends) => ENTRIES,
        Topic::ObjectLinks(_) => keys(&[&["ObjectLinks"]], Numbered::Decimal("")),
        Topic::SupportedModules => keys(&[&["NrOfEntries"]], Numbered::None),
        Topic::Module(_, ModuleTopic::ModuleInfo) => keys(&[MODULE_INFO], Numbered::None),
        Topic::DynamicChannels | Topic::Tools | Topic::Tool(_) | Topic::Unknown => return None,
    })
}

const fn keys(named: &'static [&'static [&'static str]], numbered: Numbered) -> Keys {
    Keys { named, numbered }
}

/// Whether a section describes an object or entry.
pub(in crate::eds) const fn is_of_object(topic: Topic) -> bool {
    matches!(
        topic,
        Topic::Object(_)
            | Topic::Sub(..)
            | Topic::Module(_, ModuleTopic::Fixed(..) | ModuleTopic::SubExtension(_))
    )
}

impl Keys {
    /// The keys with a name.
    pub(in crate::eds) fn names(&self) -> impl Iterator<Item = &'static str> {
        self.named.iter().copied().flatten().copied()
    }

    /// A key in the standard's case; `None` for one that the section does not have.
    pub(in crate::eds) fn spelling(&self, key: &str) -> Option<String> {
        let prefix = match self.numbered {
            Numbered::None => {
                return self.names().find(|name| name.eq_ignore_ascii_case(key)).map(str::to_owned);
            }
            Numbered::Decimal(prefix) => prefix,
            Numbered::Dummy => "Dummy",
        };
        if let Some(name) = self.names().find(|name| name.eq_ignore_ascii_case(key)) {
            return Some(name.to_owned());
        }
        let (front, digits) = key.split_at_checked(prefix.len())?;
        let is_number = match self.numbered {
            Numbered::Dummy => digits.len() == 4 && digits.bytes().all(|byte| byte.is_ascii_hexdigit()),
            Numbered::Decimal(_) | Numbered::None => {
                !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
            }
        };
        let digits = digits.to_ascii_uppercase();
        (is_number && front.eq_ignore_ascii_case(prefix)).then(|| format!("{prefix}{digits}"))
    }

    /// Whether a key is spelled as the standard does, without an allocation for the many that are.
    pub(in crate::eds) fn is_standard(&self, key: &str) -> bool {
        match self.numbered {
            _ if self.names().any(|name| name == key) => true,
            Numbered::Decimal(prefix) => key
                .strip_prefix(prefix)
                .is_some_and(|digits| !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())),
            Numbered::None | Numbered::Dummy => self.spelling(key).is_some_and(|spelling| spelling == key),
        }
    }
}
