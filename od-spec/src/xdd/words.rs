//! Messages of the reader of objects and of the rules, which name the keys of an EDS, in the words of an XDD.

/// A text in which the keys of an EDS, between backticks, are the attributes and elements of an XDD; nothing where it names none.
pub(crate) fn in_words_of_xdd(text: &str) -> Option<String> {
    let mut parts: Vec<String> = text.split('`').map(str::to_owned).collect();
    let mut is_changed = false;
    for quoted in parts.iter_mut().skip(1).step_by(2) {
        if let Some(word) = word(quoted) {
            *quoted = word;
            is_changed = true;
        }
    }
    is_changed.then(|| parts.join("`"))
}

/// A key, or a key with a value.
fn word(quoted: &str) -> Option<String> {
    let (key, value) = match quoted.split_once('=') {
        Some((key, value)) => (key, Some(value)),
        None => (quoted, None),
    };
    let flag = |value: &str| if value == "0" { "false" } else { "true" }.to_owned();
    let (name, value) = match key {
        "AccessType" => ("accessType", value.map(str::to_owned)),
        "DataType" => ("dataType", value.map(digits)),
        "DefaultValue" => ("defaultValue", value.map(str::to_owned)),
        "Denotation" => ("denotation", value.map(str::to_owned)),
        "Granularity" => ("granularity", value.map(str::to_owned)),
        "GroupMessaging" => ("groupMessaging", value.map(flag)),
        "HighLimit" => ("highLimit", value.map(str::to_owned)),
        "LSS_Supported" => ("layerSettingServiceSlave", value.map(flag)),
        "LowLimit" => ("lowLimit", value.map(str::to_owned)),
        "NrOfRXPDO" => ("nrOfRxPDO", value.map(str::to_owned)),
        "NrOfTXPDO" => ("nrOfTxPDO", value.map(str::to_owned)),
        "ObjFlags" => ("objFlags", value.map(|value| format!("{:0>4}", digits(value)))),
        "ObjectType" => ("objectType", value.map(digits)),
        "PDOMapping" => {
            ("PDOmapping", value.map(|value| if value == "0" { "no" } else { "optional" }.to_owned()))
        }
        "ParameterName" => ("name", value.map(str::to_owned)),
        "ParameterValue" => ("actualValue", value.map(str::to_owned)),
        "ProductNumber" => ("productID", value.map(str::to_owned)),
        "VendorNumber" => ("vendorID", value.map(str::to_owned)),
        _ => {
            let rate = key.strip_prefix("BaudRate_")?;
            ("supportedBaudRate value", Some(format!("{rate} Kbps")))
        }
    };
    Some(match value {
        Some(value) => format!("{name}=\"{value}\""),
        None => name.to_owned(),
    })
}

/// Hexadecimal digits without their sign.
fn digits(value: &str) -> String {
    value.strip_prefix("0x").unwrap_or(value).to_owned()
}

#[cfg(test)]
mod tests {
    use super::in_words_of_xdd;

    #[test]
    fn keys_become_attributes_and_other_words_stay() {
        for (text, expected) in [
            (
                "write `PDOMapping=0`, or correct `AccessType`",
                "write `PDOmapping=\"no\"`, or correct `accessType`",
            ),
            ("such as `BaudRate_125=1`; a PLC", "such as `supportedBaudRate value=\"125 Kbps\"`; a PLC"),
            ("write `LSS_Supported=0`", "write `layerSettingServiceSlave=\"false\"`"),
            ("write `ObjFlags=1`, or `DataType=0x0007`", "write `objFlags=\"0001\"`, or `dataType=\"0007\"`"),
        ] {
            assert_eq!(in_words_of_xdd(text).as_deref(), Some(expected));
        }
        for text in ["found `readonly`, expected `ro`", "AccessType without backticks", "one ` alone"] {
            assert_eq!(in_words_of_xdd(text), None);
        }
    }
}
