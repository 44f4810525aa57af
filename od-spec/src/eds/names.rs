//! What the name of a section says (CiA 306 4.6.3.2): `FileInfo`, `1018sub1`, `3004Name`, `M1SubExt6000`.

use crate::model::Index;

/// What a section describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Topic {
    FileInfo,
    DeviceInfo,
    DummyUsage,
    Comments,
    /// `[MandatoryObjects]` and its like.
    Objects(List),
    /// `[DeviceComissioning]`, or with the second m that the standard forgot.
    Commissioning,
    /// An object: `[1018]`.
    Object(Index),
    /// A sub-index of an object, which may be larger than any: `[1018sub1]`.
    Sub(Index, u32),
    /// A list for the elements of a compact array: `[3004Name]`.
    Elements(Index, ElementList),
    /// `[1018ObjectLinks]`.
    ObjectLinks(Index),
    DynamicChannels,
    Tools,
    /// `[Tool1]`.
    Tool(u32),
    SupportedModules,
    ConnectedModules,
    /// A section about a module: `[M1ModuleInfo]`.
    Module(u32, ModuleTopic),
    /// None of these.
    Unknown,
}

impl Topic {
    /// The sections of every EDS that come before those of objects, in the order of the standard's examples.
    pub(crate) const OF_EVERY_FILE: [Self; 7] = [
        Self::FileInfo,
        Self::DeviceInfo,
        Self::DummyUsage,
        Self::Comments,
        Self::Objects(List::Mandatory),
        Self::Objects(List::Optional),
        Self::Objects(List::Manufacturer),
    ];
}

/// A list of objects.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum List {
    Mandatory,
    Optional,
    Manufacturer,
}

impl List {
    pub(crate) const ALL: [Self; 3] = [Self::Mandatory, Self::Optional, Self::Manufacturer];

    /// The name of its section.
    pub(crate) const fn section(self) -> &'static str {
        match self {
            Self::Mandatory => "MandatoryObjects",
            Self::Optional => "OptionalObjects",
            Self::Manufacturer => "ManufacturerObjects",
        }
    }

    /// The list in which an object belongs (CiA 306 4.6.3.1).
    pub(crate) const fn of(index: Index) -> Self {
        match index.0 {
            0x1000 | 0x1001 | 0x1018 => Self::Mandatory,
            0x2000..=0x5FFF => Self::Manufacturer,
            _ => Self::Optional,
        }
    }
}

/// What a list says about the elements of a compact array.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ElementList {
    /// Their names.
    Name,
    /// Their values; DCF only.
    Value,
    /// Their application names; DCF only.
    Denotation,
}

/// What a section about a module describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ModuleTopic {
    ModuleInfo,
    Comments,
    /// The list of objects that the module brings.
    FixedObjects,
    /// An object that the module brings, or a sub-index of it.
    Fixed(Index, Option<u32>),
    /// The list of objects that the module extends.
    SubExtends,
    /// An object that the module extends.
    SubExtension(Index),
}

/// Reads a name, in whatever case and with however many zeros it is written.
pub(crate) fn topic(name: &str) -> Topic {
    const PLAIN: [(&str, Topic); 13] = [
        ("FileInfo", Topic::FileInfo),
        ("DeviceInfo", Topic::DeviceInfo),
        ("DummyUsage", Topic::DummyUsage),
        ("Comments", Topic::Comments),
        ("MandatoryObjects", Topic::Objects(List::Mandatory)),
        ("OptionalObjects", Topic::Objects(List::Optional)),
        ("ManufacturerObjects", Topic::Objects(List::Manufacturer)),
        ("DeviceComissioning", Topic::Commissioning),
        ("DeviceCommissioning", Topic::Commissioning),
        ("DynamicChannels", Topic::DynamicChannels),
        ("Tools", Topic::Tools),
        ("SupportedModules", Topic::SupportedModules),
        ("ConnectedModules", Topic::ConnectedModules),
    ];
    if let Some(topic) = object(name) {
        return topic;
    }
    let plain = PLAIN.iter().find(|(plain, _)| plain.eq_ignore_ascii_case(name));
    plain.map(|(_, topic)| *topic).or_else(|| tool(name)).or_else(|| module(name)).unwrap_or(Topic::Unknown)
}

/// The spelling of CiA 306; `None` where it has none.
pub(crate) fn canonical(topic: Topic) -> Option<String> {
    Some(match topic {
        Topic::FileInfo => "FileInfo".to_owned(),
        Topic::DeviceInfo => "DeviceInfo".to_owned(),
        Topic::DummyUsage => "DummyUsage".to_owned(),
        Topic::Comments => "Comments".to_owned(),
        Topic::Objects(list) => list.section().to_owned(),
        Topic::Commissioning => "DeviceComissioning".to_owned(),
        Topic::Object(index) => format!("{:X}", index.0),
        Topic::Sub(index, sub) => format!("{:X}sub{sub:X}", index.0),
        Topic::Elements(index, list) => format!("{:X}{}", index.0, list.word()),
        Topic::ObjectLinks(index) => format!("{:X}ObjectLinks", index.0),
        Topic::DynamicChannels => "DynamicChannels".to_owned(),
        Topic::Tools => "Tools".to_owned(),
        Topic::Tool(number) => format!("Tool{number}"),
        Topic::SupportedModules => "SupportedModules".to_owned(),
        Topic::ConnectedModules => "ConnectedModules".to_owned(),
        Topic::Module(number, topic) => format!("M{number}{}", module_word(topic)),
        Topic::Unknown => return None,
    })
}

impl ElementList {
    pub(crate) const ALL: [Self; 3] = [Self::Name, Self::Value, Self::Denotation];

    /// What its section's name ends with.
    pub(crate) const fn word(self) -> &'static str {
        match self {
            Self::Name => "Name",
            Self::Value => "Value",
            Self::Denotation => "Denotation",
        }
    }
}

fn module_word(topic: ModuleTopic) -> String {
    match topic {
        ModuleTopic::ModuleInfo => "ModuleInfo".to_owned(),
        ModuleTopic::Comments => "Comments".to_owned(),
        ModuleTopic::FixedObjects => "FixedObjects".to_owned(),
        ModuleTopic::Fixed(index, None) => format!("Fixed{:X}", index.0),
        ModuleTopic::Fixed(index, Some(sub)) => format!("Fixed{:X}sub{sub:X}", index.0),
        ModuleTopic::SubExtends => "SubExtends".to_owned(),
        ModuleTopic::SubExtension(index) => format!("SubExt{:X}", index.0),
    }
}

/// `1018`, `1018sub1`, `3004Name`, also with `0x`, further zeros and spaces.
fn object(name: &str) -> Option<Topic> {
    let digits = strip(name, "0x").unwrap_or(name);
    // The first letters of `Denotation` look like digits.
    let (number, word) = digits.split_at_checked(digits.len().saturating_sub(10)).unwrap_or((digits, ""));
    let end = if word.eq_ignore_ascii_case(ElementList::Denotation.word()) {
        number.len()
    } else {
        digits.bytes().position(|byte| !byte.is_ascii_hexdigit()).unwrap_or(digits.len())
    };
    let index = Index(u16::from_str_radix(digits.get(..end)?, 16).ok()?);
    let rest = digits.get(end..)?.trim();
    if rest.is_empty() {
        return Some(Topic::Object(index));
    }
    if let Some(sub) = strip(rest, "sub") {
        let sub = sub.trim();
        return hex(strip(sub, "0x").unwrap_or(sub)).map(|sub| Topic::Sub(index, sub));
    }
    if rest.eq_ignore_ascii_case("ObjectLinks") {
        return Some(Topic::ObjectLinks(index));
    }
    let list = ElementList::ALL.into_iter().find(|list| rest.eq_ignore_ascii_case(list.word()))?;
    Some(Topic::Elements(index, list))
}

fn tool(name: &str) -> Option<Topic> {
    decimal(strip(name, "Tool")?).map(Topic::Tool)
}

fn module(name: &str) -> Option<Topic> {
    let rest = strip(name, "M")?;
    let end = rest.bytes().position(|byte| !byte.is_ascii_digit())?;
    let (number, word) = (decimal(&rest[..end])?, &rest[end..]);
    let plain = [
        ("ModuleInfo", ModuleTopic::ModuleInfo),
        ("Comments", ModuleTopic::Comments),
        ("FixedObjects", ModuleTopic::FixedObjects),
        ("SubExtends", ModuleTopic::SubExtends),
    ];
    let topic = plain.into_iter().find(|(plain, _)| plain.eq_ignore_ascii_case(word)).map(|(_, topic)| topic);
    let topic = topic.or_else(|| match object(strip(word, "Fixed")?)? {
        Topic::Object(index) => Some(ModuleTopic::Fixed(index, None)),
        Topic::Sub(index, sub) => Some(ModuleTopic::Fixed(index, Some(sub))),
        _ => None,
    });
    let topic = topic.or_else(|| match object(strip(word, "SubExt")?)? {
        Topic::Object(index) => Some(ModuleTopic::SubExtension(index)),
        _ => None,
    });
    Some(Topic::Module(number, topic?))
}

/// What follows a prefix in upper or lower case.
fn strip<'t>(text: &'t str, prefix: &str) -> Option<&'t str> {
    let front = text.get(..prefix.len())?;
    front.eq_ignore_ascii_case(prefix).then(|| &text[prefix.len()..])
}

fn hex(digits: &str) -> Option<u32> {
    let is_hex = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    u32::from_str_radix(digits, 16).ok().filter(|_| is_hex)
}

fn decimal(digits: &str) -> Option<u32> {
    let is_decimal = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    digits.parse().ok().filter(|_| is_decimal)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_in_every_spelling_and_written_in_one() {
        for (name, canonical_name) in [
            ("fileinfo", "FileInfo"),
            ("DeviceCommissioning", "DeviceComissioning"),
            ("optionalObjects", "OptionalObjects"),
            ("100a", "100A"),
            ("0x1000", "1000"),
            ("A0", "A0"),
            ("1018SUB1", "1018sub1"),
            ("1018sub01", "1018sub1"),
            ("1a00Suba", "1A00subA"),
            ("D000sub100", "D000sub100"),
            ("3004name", "3004Name"),
            ("3004Denotation", "3004Denotation"),
            ("A0denotation", "A0Denotation"),
            ("1018objectlinks", "1018ObjectLinks"),
            ("tool2", "Tool2"),
            ("m1moduleinfo", "M1ModuleInfo"),
            ("M12FixedObjects", "M12FixedObjects"),
            ("M1Fixed6000sub2", "M1Fixed6000sub2"),
            ("M1SubExt1027", "M1SubExt1027"),
        ] {
            assert_eq!(canonical(topic(name)).as_deref(), Some(canonical_name), "{name}");
        }
        for name in [
            "",
            "12345",
            "10 18",
            "1018su",
            "1018sub",
            "1018subG",
            "Tool",
            "M1",
            "MModuleInfo",
            "PreDefines",
            "Ä",
        ] {
            assert_eq!(topic(name), Topic::Unknown, "{name}");
        }
    }
}
