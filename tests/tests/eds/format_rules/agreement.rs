//! Reader and fixer agree: a text and what `odgen fix` makes of it are one device and one node. What the fixer would change,
//! the reader takes as changed.

use std::collections::BTreeSet;

use od_spec::diag::Language;
use od_spec::source::SourceMap;
use od_spec::{Fixed, NoFiles, add_source, all_codes, compile, fix};

/// Rules after whose changes a file says something else, and why.
const OTHERWISE: [(&str, &str); 1] = [(
    "EDS101",
    "names and texts keep their characters in the model; the file is written in ASCII, which many readers need",
)];

/// Every rule that changes something. One that begins to needs a text below, or an example that is changed.
const FIXABLE: [&str; 39] = [
    "EDS101", "EDS102", "EDS104", "EDS105", "EDS106", "EDS107", "EDS110", "EDS111", "EDS112", "EDS113",
    "EDS114", "EDS120", "EDS121", "EDS122", "EDS202", "EDS207", "EDS210", "EDS212", "EDS214", "EDS218",
    "EDS301", "EDS302", "EDS303", "EDS305", "EDS307", "EDS308", "EDS402", "EDS403", "EDS404", "EDS406",
    "EDS407", "EDS412", "EDS421", "EDS423", "EDS424", "EDS503", "EDS504", "EDS506", "EDS507",
];
const FIXABLE_VALUES: [&str; 4] = ["EDS508", "EDS510", "EDS702", "EDS705"];

/// A VAR with these keys.
macro_rules! var {
    ($keys:literal) => {
        concat!("[2000]\nParameterName=level\nObjectType=0x7\n", $keys)
    };
}

/// Faults that change what is read, were they read otherwise than they are fixed.
const TEXTS: &[&str] = &[
    // Comments that would come to be above another section, and words that become a comment.
    "[2000] ; unit 0.1 bar\nParameterName=a\nDataType=5\nAccessType=ro",
    "; Far away.\n[2000] ;  0: off\nParameterName=a\nDataType=5\nAccessType=ro",
    "[2000]\nParameterName=a\nDataType=5\nAccessType=ro\n; unit mV\n[2000]\n[2001]\nParameterName=b\nDataType=5\nAccessType=ro",
    "[2000]\nParameterName=a\nDataType=5\nAccessType=ro\n; unit mV\nAccessType=ro\n[2001]\nParameterName=b\nDataType=5\nAccessType=ro",
    "# unit mV\n[2000]\nParameterName=a\nDataType=5\nAccessType=ro",
    // Lists.
    "[2000]\nParameterName=a\nDataType=5\nAccessType=ro\n[2001]\nParameterName=b\nDataType=5\nAccessType=ro\n\
     [2000ObjectLinks]\nObjectLinks=3\n1=0x2001\n1=0x2001\n1=0x2000",
    "[SupportedModules]\nNrOfEntries=2\n[M1ModuleInfo]\nProductName=a\n[M2ModuleInfo]\nProductName=b\n\
     [M1SubExtends]\nNrOfEntries=1\n1=0x6000\n[M2SubExtends]\nNrOfEntries=1\n1=0x6000\n\
     [M1SubExt6000]\nParameterName=input \nDataType=5\nAccessType=ro\nCount=1\nObjExtend=254\n\
     [M2SubExt6000]\nParameterName=output \nDataType=6\nAccessType=ro\nCount=1\nObjExtend=254\n\
     [ConnectedModules]\nNrOfEntries=5\n2=1\n2=2\n2=2\n4=1\n4=1",
    "[2000]\nParameterName=a\nObjectType=0x8\nDataType=5\nAccessType=ro\nCompactSubObj=3u\n[2000Name]\nNrOf Entries=1\n2=b",
    // Numbers and words.
    "[DeviceInfo]\nGranularity=+8\nProductNumber=\"7\"\nSimpleBootUpSlave=true\n; ...",
    "[DeviceInfo]\nNrOfTXPDO=0\nCompactPDO=0x3\n; ...\n[1801]\nParameterName=a\nObjectType=9\nSubNumber=2\n\
     [1801sub0]\nParameterName=n\nDataType=5\nAccessType=const\nDefaultValue=1\n\
     [1801sub1]\nParameterName=b\nDataType=7\nAccessType=rw\nDefaultValue=$NODEID+0x280",
    "[DeviceComissioning]\nNodeID=\"9\"\nBaudrate=500000",
    "[DeviceComissioning]\nNodeID=9\nBaudrate=500K",
    "[DeviceCommissioning]\nNodeID=9\nBaudrate=1 Mbit/s",
    "[1017]\nParameterName=a\nAccessType=rw\nDefaultValue=1000",
    "[1017]\nParameterName=a\nDataType=\nAccessType=rw\nDefaultValue=1000",
    "[1003]\nParameterName=a\nObjectType=ARRAY\nAccessType=ro\nCompactSubObj=4",
    "[1018]\nParameterName=a\nObjectType=RECORD\n[1018sub0]\nParameterName=n\nObjectType=VAR\nAccessType=ro\nDefaultValue=1\n\
     [1018sub1]\nParameterName=b\nObjectType=Var\nAccessType=ro\nDefaultValue=0x12",
    "[2000]\nParameterName=a\nObjectType=record\nSubNumber=2\n[2000sub0]\nParameterName=n\nObjectType=0x9\nDataType=5\n\
     AccessType=ro\n[2000sub1]\nParameterName=b\nObjectType=DOMAIN\nAccessType=read/write",
    var!("DataType=UNSIGNED16\nAccessType=R/W\nPDOMapping=yes\nDefaultValue=7"),
    var!("DataType=\"unsigned 16\" ; why\nAccessType=RO ; why\nDefaultValue=7"),
    var!("DataType=Real32\nAccessType=readWrite\nDefaultValue=+1.5"),
    var!("DataType=0x0002\nAccessType=rw\nDefaultValue=0xFF\nLowLimit=-0x10\nHighLimit=0x7Fu"),
    var!("DataType=0x0007\nAccessType=rw\nDefaultValue=0x180 + $NodeID\nParameterValue=\"5\" ; why"),
    var!("DataType=0x0007\nAccessType=rw\nDefaultValue=\"0x1Fu\" ; why\nParameterValue=\"5u\""),
    var!("DataType=0x0001\nAccessType=rw\nDefaultValue=True"),
    var!("DataType=0x0005\nAccessType=RWW\nPDOMapping=1"),
    var!("DataType=0x0005\nAccessType=rw\nDefaultValue=3.0"),
    var!("DataType=0x000A\nAccessType=rw\nDefaultValue=0x01 A1"),
];

/// The device and the node of a text, without the places at which they are written.
fn model(name: &str, bytes: &[u8]) -> String {
    let mut sources = SourceMap::new();
    let root = add_source(&mut sources, name, bytes.to_vec()).unwrap();
    let compiled = compile(&mut sources, root, &mut NoFiles);
    let shown = format!("{:#?}", (compiled.system, compiled.node));
    let is_place = |line: &&str| {
        let line = line.trim_start();
        ["file: FileId", "start: ", "end: "].iter().any(|front| line.starts_with(front)) || line.len() <= 1
    };
    // A place is five lines, of which the number of the file is one.
    shown
        .lines()
        .filter(|line| !is_place(line))
        .filter(|line| line.trim() != "0,")
        .collect::<Vec<_>>()
        .join("\n")
}

fn changed(fixed: &Fixed) -> BTreeSet<&'static str> {
    fixed.changes.iter().map(|change| change.code.id).collect()
}

/// What a text and what the fixer makes of it say otherwise; nothing where a rule was at work that is named above.
pub(super) fn difference(name: &str, bytes: &[u8], fixed: &Fixed) -> Option<String> {
    let codes = changed(fixed);
    if codes.is_empty() || OTHERWISE.iter().any(|(code, _)| codes.contains(code)) {
        return None;
    }
    let (before, after) = (model(name, bytes), model(name, &fixed.to_bytes()));
    let pairs = before.lines().zip(after.lines());
    let line = pairs.clone().position(|(one, other)| one != other);
    let differs = line.map(|line| {
        let around = |text: &str| {
            text.lines().skip(line.saturating_sub(2)).take(4).map(str::trim).collect::<Vec<_>>().join(" ")
        };
        format!("{codes:?}: read as `{}`, fixed as `{}`", around(&before), around(&after))
    });
    let longer = || (before.lines().count() != after.lines().count()).then(|| "one says more".to_owned());
    differs.or_else(longer)
}

#[test]
fn what_is_fixed_is_read_as_fixed() {
    let whole = |language: Language, text: &str| (language.file_name(), language.whole(text));
    let examples = all_codes().into_iter().filter_map(|code| code.example);
    let examples = examples.filter(|one| matches!(one.language, Language::Eds | Language::Dcf));
    let texts = examples.map(|one| whole(one.language, one.before));
    let texts = texts.chain(TEXTS.iter().map(|text| whole(Language::Dcf, text)));
    let (mut wrong, mut codes) = (Vec::new(), BTreeSet::new());
    for (name, text) in texts {
        let fixed = fix(name, text.as_bytes()).unwrap();
        let differs = difference(name, text.as_bytes(), &fixed);
        wrong.extend(
            differs.map(|what| format!("{what}, in {:?}", text.chars().take(90).collect::<String>())),
        );
        codes.extend(changed(&fixed));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let known: BTreeSet<&str> = FIXABLE.into_iter().chain(FIXABLE_VALUES).collect();
    assert_eq!(codes, known);
}
