//! What the world writes, and how it is read: one small file for each habit, made for this test.

use od_spec::model::{EntryId, Index, ObjectKind, SubIndex, Value};

use super::{compiled, device};

/// An EDS of one VAR with these keys.
fn var(keys: &str) -> String {
    format!("[2000]\nParameterName=level\nObjectType=0x7\n{keys}")
}

/// Type, access, default and limits of the VAR, and the codes of what is said about it.
fn read(keys: &str) -> String {
    let (compiled, _) = compiled("level.eds", &var(keys));
    let system = compiled.system.unwrap();
    let entry = system.devices[0].entry(EntryId { index: Index(0x2000), sub: SubIndex(0) }).unwrap();
    let (low, high) = entry.limits();
    let value = |value: &Option<Value>| match value {
        None => "-".to_owned(),
        Some(Value::Integer(raw)) => raw.to_string(),
        Some(Value::NodeId(offset)) => format!("node+{offset}"),
        Some(Value::Real(real)) => real.number().to_string(),
        Some(Value::Text(text)) => format!("'{text}'"),
        Some(Value::Bytes(bytes)) => format!("{bytes:02X?}"),
    };
    let about = compiled
        .diagnostics
        .iter()
        .filter(|found| found.code.id.starts_with("EDS4") || found.code.id.starts_with("EDS5"));
    let codes: Vec<&str> = about.map(|found| found.code.id).collect();
    format!(
        "{} {} {} {}..{} {}",
        entry.data_type.name(),
        entry.access.word(),
        value(&entry.default),
        value(&low),
        value(&high),
        codes.join(" ")
    )
}

#[test]
fn values_are_read_by_type_in_every_notation() {
    for (keys, expected) in [
        ("DataType=0x0006\nAccessType=rw\nDefaultValue=0x10", "unsigned16 rw 16 -..- "),
        ("DataType=6\nAccessType=RW\nDefaultValue=", "unsigned16 rw - -..- EDS407"),
        (
            "DataType=0x3\nAccessType=ro\nDefaultValue=0xFFFF\nLowLimit=0x8000\nHighLimit=0x7FFF",
            "integer16 ro -1 -32768..32767 EDS503 EDS503",
        ),
        ("DataType=0x4\nAccessType=rw\nDefaultValue=-0x10", "integer32 rw -16 -..- EDS507"),
        ("DataType=0x7\nAccessType=rw\nDefaultValue=010", "unsigned32 rw 8 -..- EDS502"),
        ("DataType=0x7\nAccessType=rw\nDefaultValue=08", "unsigned32 rw - -..- EDS501"),
        ("DataType=0x7\nAccessType=rw\nDefaultValue=10h", "unsigned32 rw - -..- EDS501"),
        ("DataType=0x7\nAccessType=rw\nDefaultValue=$NODEID+0x180", "unsigned32 rw node+384 -..- "),
        ("DataType=0x7\nAccessType=rw\nDefaultValue=0x180 + $NodeID", "unsigned32 rw node+384 -..- EDS504"),
        ("DataType=0x7\nAccessType=rw\nDefaultValue=$MY_NODE+0x180", "unsigned32 rw - -..- EDS505"),
        ("DataType=0x7\nAccessType=rw\nDefaultValue=1\nHighLimit=$NODEID+5", "unsigned32 rw 1 -..- EDS512"),
        ("DataType=0x7\nAccessType=rw\nDefaultValue=0x12UL ; why", "unsigned32 rw 18 -..- EDS507 EDS508"),
        ("DataType=0x5\nAccessType=rw\nDefaultValue=3.0", "unsigned8 rw 3 -..- EDS507"),
        ("DataType=0x1\nAccessType=rw\nDefaultValue=true\nHighLimit=0xFF", "boolean rw 1 -..- EDS506 EDS513"),
        (
            "DataType=0x8\nAccessType=rw\nDefaultValue=0x3FC00000\nLowLimit=-1.5",
            "real32 rw 1.5 -1.5..- EDS509",
        ),
        (
            "DataType=0x11\nAccessType=rw\nLowLimit=0xBFF0000000000000\nHighLimit=+2.50f",
            "real64 rw - -1..2.5 EDS509",
        ),
        ("DataType=0x8\nAccessType=rw\nHighLimit=nan", "real32 rw - -..- EDS501"),
        ("DataType=0x11\nAccessType=rw\nDefaultValue=1.5e3", "real64 rw 1500 -..- "),
        ("DataType=0x8\nAccessType=rw\nDefaultValue=nan", "real32 rw - -..- EDS501"),
        ("DataType=0x9\nAccessType=const\nDefaultValue=a;b # c", "visible-string const 'a;b # c' -..- "),
        ("DataType=0x9\nAccessType=const\nDefaultValue=caf\u{e9}", "visible-string const - -..- EDS511"),
        ("DataType=0xA\nAccessType=rw\nDefaultValue=0x01 a1", "octet-string rw [01, A1] -..- EDS510"),
        ("DataType=0xA\nAccessType=rw\nDefaultValue=123", "octet-string rw - -..- EDS501"),
        ("DataType=0xF\nDefaultValue=0", "domain rw - -..- EDS512"),
        ("AccessType=rw", "domain rw - -..- EDS403"),
        ("DataType=0x40\nAccessType=rw", "domain rw - -..- EDS404"),
        ("DataType=0x5", "unsigned8 ro - -..- EDS405"),
        ("DataType=0x5\nAccessType=", "unsigned8 ro - -..- EDS405"),
        ("DataType=0x5\nAccessType=UNKNOWN", "unsigned8 ro - -..- EDS406"),
        ("DataType=0x5\nAccessType=W", "unsigned8 wo - -..- EDS406"),
        ("DataType=0x0005 # UNSIGNED8\nAccessType=rw # why", "unsigned8 rw - -..- EDS508 EDS508"),
        ("DataType=0x5\nAccessType=ro\nPDOMapping=yes\nObjFlags=NV", "unsigned8 ro - -..- EDS412 EDS412"),
        ("DataType=0x5\nAccessType=ro\nDATATYPE=0x6\ndatatype=0x7", "unsigned32 ro - -..- "),
    ] {
        assert_eq!(read(keys), expected, "{keys}");
    }
}

/// `index kind: sub, sub` of every object, and the codes of what is said about objects.
fn shape(text: &str) -> (Vec<String>, Vec<&'static str>) {
    let (compiled, _) = compiled("shape.eds", text);
    let device = &compiled.system.unwrap().devices[0];
    let shown = device.objects.values().map(|object| {
        let subs: Vec<String> =
            object.entries.iter().map(|entry| format!("{} {}", entry.sub, entry.name)).collect();
        format!("{} {}: {}", object.index, object.kind.name(), subs.join(", "))
    });
    let codes = compiled
        .diagnostics
        .iter()
        .map(|found| found.code.id)
        .filter(|id| id.starts_with("EDS40") || id.starts_with("EDS41"));
    (shown.collect(), codes.collect())
}

#[test]
fn objects_are_what_their_sections_describe() {
    const U8: &str = "DataType=0x5\nAccessType=ro\n";
    let (shown, codes) = shape(&format!(
        "[2001]\nParameterName=no type, with subs\n{U8}[2001sub0]\nParameterName=n\n{U8}[2001sub1]\nParameterName=a\n{U8}\
         [2002sub1]\nParameterName=orphan\n{U8}\
         [2003]\nParameterName=no sub 0\nObjectType=8\n[2003SUB02]\nParameterName=b\nObjectType=0x9\n{U8}\
         [2004]\nParameterName=empty\nObjectType=9\n[2004sub0]\nParameterName=n\n{U8}\
         [2005]\nParameterName=structure\nObjectType=9\n[2005sub0]\nParameterName=n\n{U8}[2005sub1]\n{U8}[2005subFF]\nParameterName=s\n{U8}[2005sub100]\nParameterName=t\n{U8}\
         [0x2006]\nParameterName=rubbish\nObjectType=<class>\n{U8}\
         [20]\nParameterName=a type\nObjectType=6\n[2007]\nParameterName=a type\nObjectType=5\n{U8}"
    ));
    assert_eq!(
        shown,
        [
            "2001h RECORD: 0 n, 1 a",
            "2002h RECORD: 0 number of elements, 1 orphan",
            "2003h ARRAY: 0 number of elements, 2 b",
            "2004h RECORD: 0 n",
            "2005h RECORD: 0 n, 1 2005h.1",
            "2006h VAR: 0 rubbish",
        ]
    );
    let expected = [
        "EDS402", "EDS409", "EDS410", "EDS410", "EDS402", "EDS408", "EDS411", "EDS411", "EDS402", "EDS401",
        "EDS401",
    ];
    let (mut codes, mut expected) = (codes, expected.to_vec());
    codes.sort_unstable();
    expected.sort_unstable();
    assert_eq!(codes, expected);
}

#[test]
fn compact_arrays_and_pdos_are_expanded() {
    let text = "[DeviceInfo]\nNrOfRXPDO=3\nNrOfTXPDO=5\nCompactPDO=0x3\n\
        [3000]\nParameterName=level \nObjectType=8\nDataType=0x6\nAccessType=rww\nPDOMapping=1\nCompactSubObj=0x3\nDefaultValue=7\n\
        [3000Name]\nNrOfEntries=2\n2=upper level\n9=none\n\
        [3000sub3]\nParameterName=own\nDataType=0x5\nAccessType=ro\n\
        [1401]\nParameterName=second\nObjectType=9\n[1401sub0]\nParameterName=n\nDataType=5\nAccessType=ro\nDefaultValue=1\n\
        [1401sub1]\nParameterName=id\nDataType=7\nAccessType=rw\n";
    let (shown, codes) = shape(text);
    assert_eq!(codes, ["EDS414"]);
    let of = |index: &str| shown.iter().find(|line| line.starts_with(index)).unwrap().clone();
    assert_eq!(of("3000h"), "3000h ARRAY: 0 NrOfObjects, 1 level1, 2 upper level, 3 own");
    let device = device("shape.eds", text);
    let indices: Vec<u16> =
        device.objects.keys().map(|index| index.0).filter(|index| *index < 0x3000).collect();
    let described = [0x1400, 0x1401, 0x1402, 0x1600, 0x1602];
    let sent = [0x1800, 0x1801, 0x1802, 0x1803, 0x1804, 0x1A00, 0x1A01, 0x1A02, 0x1A03, 0x1A04];
    assert_eq!(indices, [&described[..], &sent[..]].concat());
    let default = |index, sub| {
        device.entry(EntryId { index: Index(index), sub: SubIndex(sub) }).unwrap().default.clone()
    };
    assert_eq!(default(0x1803, 1), Some(Value::NodeId(0x480)));
    assert_eq!(default(0x1804, 1), Some(Value::Integer(0x8000_0000)));
    assert_eq!(default(0x1402, 0), Some(Value::Integer(2)));
    assert_eq!(default(0x3000, 2), Some(Value::Integer(7)));
    assert_eq!(device.objects[&Index(0x1A00)].entries.len(), 65);
    assert_eq!(device.objects[&Index(0x3000)].kind, ObjectKind::Array);
}

#[test]
fn connected_modules_bring_and_extend_objects() {
    let module = |number: u8| {
        format!(
            "[M{number}ModuleInfo]\nProductName=DI4\n[M{number}FixedObjects]\nNrOfEntries=1\n1=0x6005\n\
             [M{number}Fixed6005]\nParameterName=interrupt\nDataType=1\nAccessType=rw\n\
             [M{number}SubExtends]\nNrOfEntries=2\n1=0x6000\n2=0x1027\n\
             [M{number}SubExt6000]\nParameterName=input \nDataType=5\nAccessType=ro\nPDOMapping=1\nCount=0;4\nObjExtend=2\n\
             [M{number}SubExt1027]\nParameterName=module \nDataType=6\nAccessType=ro\nCount=1\nDefaultValue={number}\n"
        )
    };
    let text = format!(
        "[SupportedModules]\nNrOfEntries=2\n{}{}[ConnectedModules]\nNrOfEntries=6\n1=1\n2=2\n3=1\n4=1\n5=2\n6=2\n",
        module(1),
        module(2)
    );
    let (shown, codes) = shape(&text);
    assert_eq!(codes, ["EDS415"]);
    assert_eq!(
        shown,
        [
            "1027h ARRAY: 0 NrOfObjects, 1 module1, 2 module2, 3 module3, 4 module4, 5 module5, 6 module6",
            "6000h ARRAY: 0 NrOfObjects, 1 input1, 2 input2",
            "6001h ARRAY: 0 NrOfObjects, 1 input1",
            "6005h VAR: 0 interrupt",
        ]
    );
    let types: Vec<Option<Value>> = device("m.eds", &text).objects[&Index(0x1027)].entries[1..]
        .iter()
        .map(|e| e.default.clone())
        .collect();
    assert_eq!(types, [1, 2, 1, 1, 2, 2].map(|raw| Some(Value::Integer(raw))));
}

#[test]
fn meanings_in_comments_are_read_only_where_they_fit() {
    let object = |comments: &str, keys: &str| {
        let text = format!("{comments}[2000]\nParameterName=mode\nDataType=0x5\nAccessType=rw\n{keys}");
        let mut system = compiled("c.eds", &text).0.system.unwrap();
        let entry = system.devices[0].objects.remove(&Index(0x2000)).unwrap().entries.remove(0);
        let named = entry.named_type.as_ref().map(|named| named.name.clone());
        let special: Vec<&str> = entry.special.iter().map(|special| special.name.as_str()).collect();
        let about = entry.about.get("en").unwrap_or_default();
        format!("{:?} {:?} {special:?} {about}", named, entry.unit.as_ref().map(|unit| unit.show(10)))
    };
    assert_eq!(object("; 0: off\n; 1: on\n", "DefaultValue=1\n"), "Some(\"mode\") None [] ");
    assert_eq!(object("; 0: off\n; 1: on\n", "DefaultValue=2\n"), "None None [\"off\", \"on\"] ");
    assert_eq!(object("; 0: off\n; 300: on\n", ""), "None None [] ");
    assert_eq!(object("; bit 0: ready\n; bits 4..7: mode\n", ""), "Some(\"mode\") None [] ");
    assert_eq!(object("; bit 0: ready\n; bits 4..9: mode\n", ""), "None None [] ");
    assert_eq!(object("; unit 0.1 degC\n", ""), "None Some(\"1.0 \u{b0}C\") [] ");
    assert_eq!(object("; How it\n;   works.\n; -----\n;AccessType=ro\n", ""), "None None [] How it works.");
    assert_eq!(object("; Far away.\n\n", ""), "None None [] ");
}

/// A comment of ours says that an entry is locked, and an EDS shows that as `ro`. Another access that is written then
/// is that of the EDS.
#[test]
fn a_comment_about_a_lock_does_not_change_the_access_that_the_file_states() {
    let shown = |access: &str| {
        let keys = format!("DataType=5\nAccessType={access}\nDefaultValue=1\nPDOMapping=0\n");
        let text = format!("; writable only when unlocked for service; factory default 1\n{}", var(&keys));
        let entry = device("level.eds", &text).objects[&Index(0x2000)].entries[0].clone();
        (entry.eds.access.word(), entry.locked)
    };
    for access in ["ro", "rw", "rww", "rwr", "wo"] {
        assert_eq!(shown(access), (access, true), "{access}");
    }
}
