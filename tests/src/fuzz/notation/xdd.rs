//! Files in XML (CiA 311).

use super::{Layout, Notation};

/// Files in XML (CiA 311), with every attribute on a line of its own.
pub const XDD: Notation = Notation {
    layout: Layout::Elements,
    sign: '=',
    most_changes: 6,
    lines: &[
        "<CANopenObject",
        "<CANopenSubObject",
        "</CANopenObject>",
        "</CANopenObjectList>",
        "<CANopenObjectList>",
        "<parameter uniqueID=\"P\" access=\"read\"><UINT/></parameter>",
        "<parameter uniqueID=\"P\"><dataTypeIDRef uniqueIDRef=\"P\"/></parameter>",
        "<enum uniqueID=\"E\" size=\"8\"><enumValue value=\"1\"><label lang=\"en\">a</label></enumValue></enum>",
        "<struct uniqueID=\"S\"><varDeclaration uniqueID=\"S\" name=\"a\"><BOOL/></varDeclaration></struct>",
        "<array uniqueID=\"A\"><subrange lowerLimit=\"-1\" upperLimit=\"99999999999\"/><dataTypeIDRef uniqueIDRef=\"A\"/></array>",
        "<label lang=\"de\">Größe</label>",
        "<label lang=\"\"></label>",
        "<dummyUsage><dummy entry=\"Dummy0001=0\"/></dummyUsage>",
        "<dynamicChannels><dynamicChannel dataType=\"0007\" accessType=\"readOnly\" startIndex=\"A000\" endIndex=\"A001\" maxNumber=\"4294967295\"/></dynamicChannels>",
        "<deviceCommissioning nodeID=\"0\" nodeName=\"\" actualBaudRate=\"250 Kbps\" networkNumber=\"1\" networkName=\"\" CANopenManager=\"false\"/>",
        "<!-- -- -->",
        "<![CDATA[ ]]>",
        "<?xml version=\"1.0\"?>",
        "<!DOCTYPE a>",
        "&amp;",
        "&#0;",
        "/>",
        ">",
        "index=\"1000\"",
        "subIndex=\"00\"",
        "uniqueIDRef=\"UID_OBJ_1000\"",
        "defaultValue=\"$NODEID+0x180\"",
    ],
    values: &[
        "\"\"",
        "\"0\"",
        "\"00\"",
        "\"1\"",
        "\"FF\"",
        "\"100\"",
        "\"1000\"",
        "\"1003\"",
        "\"1018\"",
        "\"1400\"",
        "\"1A00\"",
        "\"6040\"",
        "\"FFFF\"",
        "\"10000\"",
        "\"0001\"",
        "\"0005\"",
        "\"0007\"",
        "\"0008\"",
        "\"0009\"",
        "\"000F\"",
        "\"0025\"",
        "\"-1\"",
        "\"4294967296\"",
        "\"-9223372036854775809\"",
        "\"340282366920938463463374607431768211456\"",
        "\"1e400\"",
        "\"NaN\"",
        "\"0x\"",
        "\"0x1FFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFF\"",
        "\"$NODEID\"",
        "\"$NODEID+0x180\"",
        "\"$NODEID+$NODEID\"",
        "\"ro\"",
        "\"const\"",
        "\"rw\"",
        "\"read\"",
        "\"noAccess\"",
        "\"TPDO\"",
        "\"optional\"",
        "\"no\"",
        "\"7\"",
        "\"9\"",
        "\"true\"",
        "\"2026-02-30\"",
        "\"24:60:60\"",
        "\"&lt;&#10;&amp;\"",
        "\"a b\"",
        "\"ä\"",
        "'a'",
        "x",
        "",
    ],
    headers: &[
        "CANopenObject",
        "CANopenSubObject",
        "parameter",
        "enum",
        "struct",
        "array",
        "label",
        "deviceFamily",
    ],
};

/// What is next to others of its kind.
const ITEMS: [&str; 2] = ["<CANopenObject", "<parameter"];

/// What these lie in.
const AROUND: [&str; 13] = [
    "ISO15745ProfileContainer",
    "ISO15745Profile",
    "ProfileHeader",
    "ProfileBody",
    "DeviceIdentity",
    "DeviceFunction",
    "ApplicationProcess",
    "dataTypeList",
    "parameterList",
    "ApplicationLayers",
    "CANopenObjectList",
    "TransportLayers",
    "NetworkManagement",
];

/// Whether a line begins an object or a parameter.
pub(super) fn is_item(line: &str) -> bool {
    let line = line.trim_start();
    let is_whole = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric());
    ITEMS.iter().any(|item| line.strip_prefix(item).is_some_and(is_whole))
}

/// Whether a line begins or ends what others lie in.
pub(super) fn is_around(line: &str) -> bool {
    let Some(tag) = line.trim_start().strip_prefix('<') else { return line.starts_with("<?xml") };
    let tag = tag.strip_prefix('/').unwrap_or(tag);
    let name = tag.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default();
    AROUND.contains(&name)
}
