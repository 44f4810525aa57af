//! Words where the standard has a number, units where it has none, and types that CiA 301 gives: each is read as what it says,
//! and reported.

use od_spec::fix;
use od_spec::model::{Access, DataType, EntryId, Index, PdoMapping, SubIndex, Value};

use super::{compiled, device};

fn id(index: u16, sub: u8) -> EntryId {
    EntryId { index: Index(index), sub: SubIndex(sub) }
}

/// Messages of one code, with what they change.
fn said(name: &str, text: &str, code: &str) -> Vec<String> {
    let (compiled, _) = compiled(name, text);
    let found = compiled.diagnostics.iter().filter(|one| one.code.id == code);
    found
        .map(|one| {
            let edits: Vec<&str> = one.edits.iter().map(|edit| edit.text.trim()).collect();
            format!("{} -> {}", one.message, edits.join(" "))
        })
        .collect()
}

const SCALE: &str = "[2000]\nParameterName=level\nObjectType=VAR\nDataType=UNSIGNED16\nAccessType=ro\nDefaultValue=7\nPDOMapping=1\n\
    [2001]\nParameterName=count\nObjectType=Variable\nDataType=Integer_32\nAccessType=R/W\nDefaultValue=-3\nPDOMapping=0\n\
    [2002]\nParameterName=text\nObjectType=VAR\nDataType=VISIBLE_STRING\nAccessType=CONST\nDefaultValue=abc\n\
    [2003]\nParameterName=ratio\nObjectType=var\nDataType=REAL32\nAccessType=readWrite\nDefaultValue=1.5\n\
    [2004]\nParameterName=both\nObjectType=RECORD\n\
    [2004sub0]\nParameterName=n\nObjectType=VAR\nDataType=U8\nAccessType=ro\nDefaultValue=2\n\
    [2004sub1]\nParameterName=low\nObjectType=VAR\nDataType=uint32_t\nAccessType=rw\nDefaultValue=0x10\n\
    [2004sub2]\nParameterName=block\nObjectType=DOMAIN\nAccessType=read only\n";

#[test]
fn names_are_read_as_what_they_say() {
    let device = device("scale.eds", SCALE);
    let shown = |index, sub| {
        let entry = device.entry(id(index, sub)).unwrap();
        (entry.data_type, entry.access, entry.default.clone())
    };
    let number = |number| Some(Value::Integer(number));
    assert_eq!(shown(0x2000, 0), (DataType::Unsigned16, Access::Ro, number(7)));
    assert_eq!(device.entry(id(0x2000, 0)).unwrap().pdo, PdoMapping::Transmit);
    assert_eq!(shown(0x2001, 0), (DataType::Integer32, Access::Rw, number(-3)));
    assert_eq!(
        shown(0x2002, 0),
        (DataType::VisibleString, Access::Const, Some(Value::Text("abc".to_owned())))
    );
    let (data_type, access, ratio) = shown(0x2003, 0);
    assert_eq!((data_type, access), (DataType::Real32, Access::Rw));
    assert!(matches!(ratio, Some(Value::Real(_))), "{ratio:?}");
    assert_eq!(shown(0x2004, 0), (DataType::Unsigned8, Access::Ro, number(2)));
    assert_eq!(shown(0x2004, 1), (DataType::Unsigned32, Access::Rw, number(16)));
    assert_eq!(shown(0x2004, 2), (DataType::Domain, Access::Ro, None));
}

#[test]
fn names_are_errors_and_fixed() {
    assert_eq!(
        said("scale.eds", SCALE, "EDS404"),
        [
            "found `UNSIGNED16`, expected the number of the data type: `0x0006` -> 0x0006",
            "found `Integer_32`, expected the number of the data type: `0x0004` -> 0x0004",
            "found `VISIBLE_STRING`, expected the number of the data type: `0x0009` -> 0x0009",
            "found `REAL32`, expected the number of the data type: `0x0008` -> 0x0008",
            "found `U8`, expected the number of the data type: `0x0005` -> 0x0005",
            "found `uint32_t`, expected the number of the data type: `0x0007` -> 0x0007",
        ]
    );
    let kinds = said("scale.eds", SCALE, "EDS402");
    assert_eq!(kinds.len(), 8, "{kinds:?}");
    assert_eq!(kinds[0], "found `VAR`, expected the number of the object type: `0x7` -> 0x7");
    assert_eq!(kinds[4], "found `RECORD`, expected the number of the object type: `0x9` -> 0x9");
    assert_eq!(kinds[7], "found `DOMAIN`, expected the number of the object type: `0x2` -> 0x2");
    let accesses = [
        "found `R/W`, expected `rw` -> rw",
        "found `readWrite`, expected `rw` -> rw",
        "found `read only`, expected `ro` -> ro",
    ];
    assert_eq!(said("scale.eds", SCALE, "EDS406"), accesses);
    let fixed = fix("scale.eds", SCALE.as_bytes()).unwrap();
    for line in ["ObjectType=0x9", "ObjectType=0x2", "DataType=0x0006", "DataType=0x0009", "AccessType=rw"] {
        assert!(fixed.text().contains(line), "{line}: {}", fixed.text());
    }
    assert!(!fixed.left.iter().any(|one| matches!(one.code.id, "EDS402" | "EDS404" | "EDS406")));
    // What a VAR with sub-indices is, the sub-indices say; both faults are reported.
    let text =
        "[2000]\nParameterName=a\nObjectType=VAR\n[2000sub1]\nParameterName=b\nDataType=5\nAccessType=ro\n";
    assert_eq!(
        said("a.eds", text, "EDS402"),
        [
            "2000h: found `ObjectType=VAR`, but it has sub-indices; it is taken as RECORD -> ",
            "found `VAR`, expected the number of the object type: `0x7` -> 0x7",
        ]
    );
}

#[test]
fn what_is_doubtful_is_left() {
    for (word, expected) in
        [("INT", DataType::Domain), ("UINT", DataType::Domain), ("0x0040", DataType::Domain)]
    {
        let text = format!("[2000]\nParameterName=a\nDataType={word}\nAccessType=ro\n");
        let device = device("a.eds", &text);
        assert_eq!(device.entry(id(0x2000, 0)).unwrap().data_type, expected, "{word}");
        assert_eq!(
            said("a.eds", &text, "EDS404"),
            [format!("2000h: there is no data type `{word}`; it is taken as DOMAIN -> ")]
        );
    }
}

#[test]
fn what_cia_301_gives_a_type_has_it() {
    let text = "[1017]\nParameterName=heartbeat\nAccessType=rw\nDefaultValue=1000\n\
        [1003]\nParameterName=errors\nObjectType=8\n[1003sub0]\nParameterName=n\nAccessType=rw\nDefaultValue=1\n\
        [1003sub1]\nParameterName=error\nAccessType=ro\n\
        [1A00]\nParameterName=mapping\nObjectType=9\n[1A00sub0]\nParameterName=n\nDataType=5\nAccessType=rw\nDefaultValue=1\n\
        [1A00sub1]\nParameterName=first\nDataType=\nAccessType=rw\nDefaultValue=0x20000010\n\
        [1016]\nParameterName=consumers\nObjectType=8\nAccessType=rw\nCompactSubObj=2\n\
        [1005]\nParameterName=sync\nDataType=maybe\nAccessType=rw\nDefaultValue=0x80\n\
        [1021]\nParameterName=own\nAccessType=ro\n\
        [1014]\nParameterName=another shape\nObjectType=9\n[1014sub1]\nParameterName=a\nAccessType=ro\n\
        [2000]\nParameterName=own\nAccessType=ro\nDefaultValue=5\n";
    let device = device("a.eds", text);
    for (index, sub, data_type, default) in [
        (0x1017, 0, DataType::Unsigned16, Some(1000)),
        (0x1003, 0, DataType::Unsigned8, Some(1)),
        (0x1003, 1, DataType::Unsigned32, None),
        (0x1A00, 1, DataType::Unsigned32, Some(0x2000_0010)),
        (0x1016, 2, DataType::Unsigned32, None),
        (0x1005, 0, DataType::Unsigned32, Some(0x80)),
        (0x1021, 0, DataType::Domain, None),
        (0x1014, 1, DataType::Domain, None),
        (0x2000, 0, DataType::Domain, None),
    ] {
        let entry = device.entry(id(index, sub)).unwrap();
        assert_eq!(
            (entry.data_type, entry.default.clone()),
            (data_type, default.map(Value::Integer)),
            "{index:X}h.{sub}"
        );
    }
    assert_eq!(
        said("a.eds", text, "EDS403"),
        [
            "1017h has no `DataType`; it is taken as UNSIGNED16 -> DataType=0x0006",
            "1003h has no `DataType`; it is taken as UNSIGNED8 -> DataType=0x0005",
            "1003h.1 has no `DataType`; it is taken as UNSIGNED32 -> DataType=0x0007",
            "1A00h.1 has no `DataType`; it is taken as UNSIGNED32 -> 0x0007",
            "1016h has no `DataType`; it is taken as UNSIGNED32 -> DataType=0x0007",
            "1021h has no `DataType`; it is taken as DOMAIN -> DataType=0x000F",
            "1014h.1 has no `DataType`; it is taken as DOMAIN -> ",
            "2000h has no `DataType`; it is taken as DOMAIN -> ",
        ]
    );
    assert_eq!(
        said("a.eds", text, "EDS404"),
        ["1005h: there is no data type `maybe`; it is taken as UNSIGNED32 -> "]
    );
}

#[test]
fn a_bit_rate_is_read_in_its_unit() {
    let rate = |text: &str| {
        let text = format!(
            "[DeviceInfo]\nBaudRate_125=1\nBaudRate_500=1\n[DeviceComissioning]\nNodeID=5\nBaudrate={text}\n"
        );
        let node = compiled("a.dcf", &text).0.node.unwrap();
        (node.bit_rate, said("a.dcf", &text, "EDS705").len())
    };
    for text in ["500000", "500K", "500 kbit/s", "500kBaud", "0x7A120"] {
        assert_eq!(rate(text), (500, 1), "{text}");
    }
    assert_eq!((rate("500"), rate("0x1F4")), ((500, 0), (500, 0)));
    // One that CiA 301 does not have stays; none is what `odgen` takes for the device.
    assert_eq!((rate("100"), rate("0"), rate("auto")), ((100, 1), (500, 1), (500, 1)));
}
