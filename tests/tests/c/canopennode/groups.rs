//! A file from CANopenEditor gives the groups, counters and attributes that its own code has.

use od_import::import;
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};

use crate::canopennode::project::of_text;

/// An EDS with the groups of a firmware, one of which has a name that no other exporter knows.
const KILN: &str = "[DeviceInfo]\nProductName=Kiln\n\n\
    [1000]\nParameterName=device type\nObjectType=0x7\n;StorageLocation=PERSIST_COMM\nDataType=0x0007\nAccessType=ro\n\
    DefaultValue=0\nPDOMapping=0\n\n\
    [1001]\nParameterName=error register\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\nDefaultValue=0\nPDOMapping=0\n\n\
    [1017]\nParameterName=heartbeat\nObjectType=0x7\n;StorageLocation=PERSIST_COMM\nDataType=0x0006\nAccessType=rw\n\
    DefaultValue=1000\nPDOMapping=0\n\n\
    [2000]\nParameterName=curve\nObjectType=0x8\n;StorageLocation=PERSIST_OVEN\nSubNumber=2\n\n\
    [2000sub0]\nParameterName=count\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\nDefaultValue=1\nPDOMapping=0\n\n\
    [2000sub1]\nParameterName=point\nObjectType=0x7\nDataType=0x0006\nAccessType=rw\nDefaultValue=5\nPDOMapping=1\n\
    ;CO_accessSRDO=trx\n\n\
    [2001]\nParameterName=door\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\nPDOMapping=0\n\
    ;CO_countLabel=DOOR\n\n\
    [2002]\nParameterName=mean\nObjectType=0x7\n;StorageLocation=PERSIST_OVEN\nDataType=0x0006\nAccessType=ro\nPDOMapping=0\n";

#[test]
fn groups_counters_and_attributes_are_those_of_the_file() {
    let project = of_text("kiln.eds", KILN);
    let (header, code) = (project.file("OD.h"), project.file("OD.c"));
    let group = |name: &str| {
        let end = header.find(&format!("}} OD_{name}_t;")).unwrap_or_else(|| panic!("{header}"));
        let start = header[..end].rfind("typedef struct {").unwrap();
        header[start..end].to_owned()
    };
    let comm = group("PERSIST_COMM");
    assert!(comm.contains("x1000_deviceType;") && comm.contains("x1017_heartbeat;"), "{comm}");
    let oven = group("PERSIST_OVEN");
    assert!(oven.contains("x2000_curve_sub0;") && oven.contains("x2000_curve[OD_CNT_ARR_2000];"), "{oven}");
    // What has no value to begin with has no place in a group.
    assert!(group("RAM").contains("x2002_mean;"), "{header}");
    assert!(!header.contains("PERSIST_MANUF"), "{header}");
    assert!(code.contains("OD_ATTR_PERSIST_OVEN OD_PERSIST_OVEN_t OD_PERSIST_OVEN = {"), "{code}");
    assert!(
        header.contains(".addr = &OD_PERSIST_OVEN, .len = sizeof(OD_PERSIST_OVEN), .subIndexOD = 4U"),
        "{header}"
    );
    assert!(header.contains("#define OD_CNT_DOOR 1\n"), "{header}");
    assert!(code.contains(".attribute = ODA_SDO_RW | ODA_TRPDO | ODA_TRSRDO | ODA_MB,"), "{code}");
    project.run("list_entries.c", &[]);
}

#[test]
fn an_import_gives_the_code_that_the_file_gives() {
    let mut sources = SourceMap::new();
    let root = sources.add("kiln.eds", KILN);
    let read = compile(&mut sources, root, &mut NoFiles);
    let specification = import(&read, &sources, root).unwrap().unwrap().text;
    let (of_file, of_import) = (of_text("kiln.eds", KILN), of_text("kiln.od.yaml", &specification));
    let groups = |header: &str| -> Vec<String> {
        header
            .lines()
            .filter(|line| line.contains("OD_PERSIST_") || line.contains("OD_CNT_"))
            .map(str::to_owned)
            .collect()
    };
    assert_eq!(groups(&of_import.file("OD.h")), groups(&of_file.file("OD.h")));
    let attributes = |code: &str| -> Vec<String> {
        code.lines().filter(|line| line.contains(".attribute")).map(|line| line.trim().to_owned()).collect()
    };
    assert_eq!(attributes(&of_import.file("OD.c")), attributes(&of_file.file("OD.c")));
}

#[test]
fn an_object_that_requests_tpdos_has_an_extension() {
    let requests = KILN.replace(";CO_countLabel=DOOR", ";TPDODetectCos=1");
    let extended = |text: &str| {
        of_text("kiln.eds", text).file("OD_rules.c").contains("OD_requestable[] = {\n    0x2001U,\n};")
    };
    assert!(extended(&requests));
    assert!(!extended(KILN));
    of_text("kiln.eds", &requests).run("list_entries.c", &[]);
}
