//! What the facts of a device are called in its file: keys in an EDS or DCF, attributes in an XDD or XDC. The same reader and the
//! same rules are for all of them; what they say to the owner of the file is in its own words.

/// How a file of a device is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FileFormat {
    /// Sections with keys: an EDS or DCF.
    Eds,
    /// Elements with attributes: an XDD or XDC.
    Xdd,
}

/// A key of an EDS that messages name, and that an XDD has otherwise.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Key {
    Access,
    /// Whether the device has a bit rate, in kbit/s.
    BitRate(u16),
    DataType,
    Default,
    Denotation,
    Granularity,
    GroupMessaging,
    Lss,
    Mapping,
    Name,
    ObjectFlags,
    ObjectType,
    Product,
    Vendor,
}

impl FileFormat {
    /// What a fact is called, in backticks.
    pub(crate) fn key(self, key: Key) -> String {
        format!("`{}`", self.bare(key))
    }

    /// A fact with a value, given as an EDS has it, in backticks.
    pub(crate) fn set(self, key: Key, value: &str) -> String {
        let name = self.bare(key);
        match self {
            FileFormat::Eds => format!("`{name}={value}`"),
            FileFormat::Xdd => format!("`{name}=\"{}\"`", in_xdd(key, value)),
        }
    }

    fn bare(self, key: Key) -> String {
        let (eds, xdd) = match key {
            Key::Access => ("AccessType", "accessType"),
            Key::BitRate(rate) if self == FileFormat::Eds => return format!("BaudRate_{rate}"),
            Key::BitRate(_) => ("", "supportedBaudRate value"),
            Key::DataType => ("DataType", "dataType"),
            Key::Default => ("DefaultValue", "defaultValue"),
            Key::Denotation => ("Denotation", "denotation"),
            Key::Granularity => ("Granularity", "granularity"),
            Key::GroupMessaging => ("GroupMessaging", "groupMessaging"),
            Key::Lss => ("LSS_Supported", "layerSettingServiceSlave"),
            Key::Mapping => ("PDOMapping", "PDOmapping"),
            Key::Name => ("ParameterName", "name"),
            Key::ObjectFlags => ("ObjFlags", "objFlags"),
            Key::ObjectType => ("ObjectType", "objectType"),
            Key::Product => ("ProductNumber", "productID"),
            Key::Vendor => ("VendorNumber", "vendorID"),
        };
        if self == FileFormat::Eds { eds } else { xdd }.to_owned()
    }
}

/// A value of an EDS as an XDD has it.
fn in_xdd(key: Key, value: &str) -> String {
    let is_no = value == "0";
    match key {
        Key::GroupMessaging | Key::Lss => (if is_no { "false" } else { "true" }).to_owned(),
        Key::Mapping => (if is_no { "no" } else { "optional" }).to_owned(),
        Key::DataType | Key::ObjectType => digits(value).to_owned(),
        Key::ObjectFlags => format!("{:0>4}", digits(value)),
        Key::BitRate(rate) => format!("{rate} Kbps"),
        Key::Access
        | Key::Default
        | Key::Denotation
        | Key::Granularity
        | Key::Name
        | Key::Product
        | Key::Vendor => value.to_owned(),
    }
}

/// Hexadecimal digits without their sign.
fn digits(value: &str) -> &str {
    value.strip_prefix("0x").unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::{FileFormat, Key};

    #[test]
    fn a_fact_has_the_words_of_its_file() {
        for (key, value, eds, xdd) in [
            (Key::Mapping, "0", "`PDOMapping=0`", "`PDOmapping=\"no\"`"),
            (Key::BitRate(125), "1", "`BaudRate_125=1`", "`supportedBaudRate value=\"125 Kbps\"`"),
            (Key::Lss, "0", "`LSS_Supported=0`", "`layerSettingServiceSlave=\"false\"`"),
            (Key::ObjectFlags, "1", "`ObjFlags=1`", "`objFlags=\"0001\"`"),
            (Key::DataType, "0x0007", "`DataType=0x0007`", "`dataType=\"0007\"`"),
        ] {
            assert_eq!(
                (FileFormat::Eds.set(key, value), FileFormat::Xdd.set(key, value)),
                (eds.into(), xdd.into())
            );
        }
        assert_eq!(
            (FileFormat::Eds.key(Key::Vendor), FileFormat::Xdd.key(Key::Vendor)),
            ("`VendorNumber`".into(), "`vendorID`".into())
        );
    }
}
