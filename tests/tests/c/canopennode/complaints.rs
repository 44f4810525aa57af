//! What users of other exporters for this stack complain about does not happen here: a test for each kind.

use od_tests::{compile_with_sources, root};

use crate::canopennode::project::{CUSTOM, Project, of_text, of_workspace, reported};

/// The lines of a file that begin so.
fn lines<'t>(text: &'t str, begin: &str) -> Vec<&'t str> {
    text.lines().map(str::trim).filter(|line| line.starts_with(begin)).collect()
}

fn of_eds(key: &str) -> Project {
    let text = std::fs::read_to_string(root().join(format!("generated/eds/{key}.eds"))).unwrap();
    of_text(&format!("{key}-again.eds"), &text)
}

#[test]
fn an_eds_gives_the_counters_of_the_specification() {
    for project in of_workspace("od-spec/devices/pitch-control-system.od.yaml") {
        let of_eds = of_eds(project.key());
        let counters = |project: &Project| lines(&project.file("OD.h"), "#define OD_CNT_").join("\n");
        assert_eq!(counters(&of_eds), counters(&project));
        for (name, count) in
            [("NMT", 1), ("EM", 1), ("EM_PROD", 1), ("HB_PROD", 1), ("SDO_SRV", 1), ("RPDO", 4), ("TPDO", 4)]
        {
            assert!(counters(&project).contains(&format!("#define OD_CNT_{name} {count}")), "{name}");
        }
    }
}

#[test]
fn an_eds_gives_the_attributes_of_the_specification() {
    for project in of_workspace("od-spec/devices/fullmo-drive.od.yaml") {
        let attributes = |project: &Project| lines(&project.file("OD.c"), ".attribute").join("\n");
        let of_specification = attributes(&project);
        assert_eq!(attributes(&of_eds(project.key())), of_specification);
        for expected in
            ["ODA_SDO_RW | ODA_RPDO | ODA_MB", "ODA_SDO_R | ODA_TPDO | ODA_MB", "ODA_SDO_RW | ODA_MB"]
        {
            assert!(of_specification.contains(&format!(".attribute = {expected},")), "{expected}");
        }
    }
}

#[test]
fn types_of_objects_are_those_that_the_stack_knows() {
    for project in of_workspace("tests/readers/everything.od.yaml") {
        let code = project.file("OD.c");
        let kinds = ["ODT_VAR", "ODT_ARR", "ODT_REC"];
        let known: usize = kinds.iter().map(|kind| code.matches(&format!("{kind},")).count()).sum();
        assert_eq!(
            (code.matches("ODT_").count(), known),
            (known, project.device["objects"].as_array().unwrap().len())
        );
    }
}

#[test]
fn counters_follow_the_index_and_nothing_else() {
    // NMT start-up is about NMT, too, and counts nothing.
    let text = specification("  0x1F80: {name: NMT startup, type: unsigned32, access: rw, default: 0}");
    let header = of_text("startup.od.yaml", &text).file("OD.h");
    assert_eq!(lines(&header, "#define OD_CNT_NMT"), ["#define OD_CNT_NMT 1"]);
    assert!(header.contains("#define OD_ENTRY_H1F80 "));
}

#[test]
fn a_formula_is_a_number_however_it_is_written() {
    for formula in ["$NODEID+0x181", "$NodeID+0x181", "$nodeid+0x181", "0x181+$NODEID"] {
        let text = eds(&format!(
            "[2000]\nParameterName=own identifier\nObjectType=7\nDataType=7\nAccessType=rw\nDefaultValue={formula}\n"
        ));
        let project = of_text("formula.eds", &text);
        assert!(project.file("OD.c").contains(".x2000_ownIdentifier = 385UL,"), "{formula}");
        assert!(!project.file("OD.c").to_lowercase().contains("nodeid"), "{formula}");
        assert!(
            project.file("OD_rules.c").contains("{0x2000U, 0U, OD_NUMBER_UNSIGNED, 4U, (385ULL)}"),
            "{formula}"
        );
        assert!(project.reported.contains("does not add the node-ID to 2000h"), "{}", project.reported);
    }
}

#[test]
fn nothing_of_unknown_size_is_a_variable() {
    let text = eds("[2000]\nParameterName=program\nObjectType=2\nDataType=15\nAccessType=rw\n\
                    [2001]\nParameterName=text\nObjectType=7\nDataType=9\nAccessType=const\nDefaultValue=\n\
                    [2002]\nParameterName=note\nObjectType=7\nDataType=9\nAccessType=rw\nDefaultValue=\n");
    let project = of_text("empty.eds", &text);
    let listed = project.run("list_entries.c", &[]);
    assert!(listed.contains("entry 2000 0 03 0 -\n"), "{listed}");
    assert!(listed.contains("entry 2002 0 83 32 00 00"), "{listed}");
    assert!(!project.file("OD.h").contains("not specified"));
    let text = specification("  0x2000: {name: note, type: visible-string, access: const, default: \"\"}");
    let listed = of_text("note.od.yaml", &text).run("list_entries.c", &[]);
    assert!(listed.contains("entry 2000 0 81 1 00\n"), "{listed}");
}

#[test]
fn a_mapping_says_the_length_of_what_is_mapped() {
    for project in of_workspace("tests/readers/everything.od.yaml") {
        let listed = project.run("list_entries.c", &[]);
        let length = |index: &str, sub: u8| {
            let begin = format!("entry {index} {sub} ");
            let line = listed.lines().find(|line| line.starts_with(&begin)).unwrap();
            line.split(' ').nth(4).unwrap().parse::<usize>().unwrap()
        };
        let mut mapped = 0;
        for line in listed.lines().filter(|line| line.starts_with("entry 16") || line.starts_with("entry 1A"))
        {
            let words: Vec<&str> = line.split(' ').collect();
            let [bits, sub, low, high] = words[5..] else { continue };
            if words[2] != "0" && (low, high) != ("00", "00") {
                let (bits, sub) =
                    (usize::from_str_radix(bits, 16).unwrap(), u8::from_str_radix(sub, 16).unwrap());
                assert_eq!(bits, 8 * length(&format!("{high}{low}"), sub), "{line}");
                mapped += 1;
            }
        }
        assert!(mapped > 5, "{mapped}");
    }
}

#[test]
fn every_object_is_there_and_in_order() {
    for project in of_workspace("od-spec/devices/pitch-control-system.od.yaml") {
        let listed = project.run("list_entries.c", &[]);
        let found: Vec<String> =
            lines(&listed, "object").iter().map(|line| format!("0x{}", &line[7..11])).collect();
        let objects = project.device["objects"].as_array().unwrap();
        assert_eq!(
            found,
            objects.iter().map(|object| object["index"].as_str().unwrap().to_owned()).collect::<Vec<_>>()
        );
        assert!(found.is_sorted());
    }
}

#[test]
fn what_the_stack_does_not_compile_without_is_refused() {
    let has = |text: &str, expected: &str| {
        let (reported, is_made) = reported("refused.eds", text);
        assert!(reported.contains(expected) && !is_made, "{expected} in {reported}");
    };
    let whole = eds("");
    for (index, name) in
        [("1000", "device type"), ("1001", "error register"), ("1017", "producer heartbeat time")]
    {
        has(
            &without(&whole, index),
            &format!("has no {index}h ({name}), and CANopenNode does not compile without it"),
        );
    }
    has(
        &eds(&var("1017", "7", "rw", "0")),
        "1017h (v1017) is UNSIGNED32, and CANopenNode starts only with UNSIGNED16",
    );
    has(&eds(&pdo(0x1201, 2)), "has 1201h (an SDO server) and no 1200h");
    has(&eds(&pdo(0x1400, 1)), "RPDO 1 has 1400h and no 1600h");
    has(&eds(&pdo(0x1A00, 1)), "TPDO 1 has 1A00h and no 1800h");
    has(
        &eds(&[pdo(0x1801, 2), pdo(0x1A01, 2)].concat()),
        "the first TPDO of `refused` is number 2, and CANopenNode begins with number 1",
    );
}

#[test]
fn what_the_stack_has_to_be_set_up_for_is_reported() {
    let has = |text: &str, expected: &str| {
        let (reported, is_made) = reported("reported.eds", text);
        assert!(reported.contains(expected) && is_made, "{expected} in {reported}");
    };
    let whole = eds("");
    assert_eq!(reported("whole.eds", &whole).0, "");
    has(&without(&whole, "1018"), "CANopenNode's example reads the identity");
    has(&eds(&var("100C", "6", "rw", "100")), "there is 100Ch and no 100Dh");
    let gap = [pdo(0x1400, 2), pdo(0x1404, 2), pdo(0x1600, 1), pdo(0x1604, 1)].concat();
    has(&eds(&gap), "number 5 is at place 2");
    let fixed = [pdo(0x1800, 2).replace("DefaultValue=1\n", "DefaultValue=0x180\n"), pdo(0x1A00, 1)].concat();
    has(&eds(&fixed), "1800h.1 (s1): the same for every node, and CANopenNode adds the node-ID");
    has(
        &eds(&[pdo(0x1800, 1), pdo(0x1A00, 1)].concat()),
        "1800h.2: missing, and CANopenNode does not start without it",
    );
    // Each kind once, however many there are.
    let empty = [pdo(0x1800, 2), pdo(0x1801, 2), pdo(0x1A00, 1), pdo(0x1A01, 1)].concat();
    has(&eds(&empty), "TPDO 1, TPDO 2: valid without a mapping, and CANopenNode starts with an error");
    let elsewhere = [pdo(0x1800, 2), pdo(0x1A00, 1)].concat().replacen(
        "DataType=5\nAccessType=rw\nDefaultValue=0",
        "DataType=5\nAccessType=rw\nDefaultValue=1",
        1,
    );
    let elsewhere = elsewhere.replacen(
        "DataType=7\nAccessType=rw\nDefaultValue=0",
        "DataType=7\nAccessType=rw\nDefaultValue=0x10170010",
        1,
    );
    has(
        &eds(&elsewhere),
        "TPDO 1 (1017h may not be mapped in this direction): CANopenNode refuses the mapping",
    );
    let uncounted =
        elsewhere.replacen("DataType=5\nAccessType=rw\nDefaultValue=1\n", "DataType=5\nAccessType=rw\n", 1);
    has(&eds(&uncounted), "TPDO 1: valid without a mapping, and CANopenNode starts with an error");
    let wide = elsewhere.replace("0x10170010", "0x20000020");
    let narrow = var("2000", "6", "rw", "0\nPDOMapping=1");
    has(
        &eds(&[wide, narrow].concat()),
        "TPDO 1 (2000h has 16 bits, and 32 are mapped): CANopenNode refuses the mapping",
    );
    let text = specification(
        "  0x2000: {name: label, type: unicode-string, capacity: 8, access: rw, default: Pump}",
    );
    let (said, _) = reported("label.od.yaml", &text);
    assert!(said.contains("2000h (label, 8 bytes): always whole for CANopenNode"), "{said}");
    has(&eds(&var("1017", "6", "rw", "100\nHighLimit=1000")), "1017h (v1017): has limits");
}

/// A dictionary makes the settings that the stack needs for it, and a project is stopped that sets something else.
#[test]
fn the_stack_is_compiled_as_a_dictionary_needs_it() {
    let set = |text: &str| of_text("set.eds", text).run("print_settings.c", &[]).replace('\n', ", ");
    let history = "[1003]\nParameterName=errors\nObjectType=8\nSubNumber=2\n[1003sub0]\nParameterName=n\nDataType=5\nAccessType=rw\nDefaultValue=0\n\
                   [1003sub1]\nParameterName=e\nDataType=7\nAccessType=ro\n";
    let whole = eds("");
    assert_eq!(set(&whole), "HB_CONS 01, NODE_GUARDING 00, EM 03, TIME 00, SYNC 00, PDO 00, ");
    assert_eq!(
        set(&without(&whole, "1016")),
        "HB_CONS 00, NODE_GUARDING 00, EM 03, TIME 00, SYNC 00, PDO 00, "
    );
    assert_eq!(
        set(&without(&whole, "1014")),
        "HB_CONS 01, NODE_GUARDING 00, EM 00, TIME 00, SYNC 00, PDO 00, "
    );
    let more = [
        history,
        &var("1015", "6", "rw", "0"),
        &var("100C", "6", "rw", "0"),
        &var("100D", "5", "rw", "0"),
        &var("1012", "7", "rw", "0x100"),
    ]
    .concat();
    assert_eq!(set(&eds(&more)), "HB_CONS 01, NODE_GUARDING 01, EM 0F, TIME 03, SYNC 00, PDO 00, ");
    let received = [var("1005", "7", "rw", "0x80"), pdo(0x1400, 2), pdo(0x1600, 1)].concat();
    assert_eq!(
        set(&eds(&received)),
        "HB_CONS 01, NODE_GUARDING 00, EM 03, TIME 00, SYNC 01, PDO 35, 1006 missing, "
    );
    let both =
        [received, var("1006", "7", "rw", "0"), pdo(0x1280, 3), pdo(0x1800, 2), pdo(0x1A00, 1)].concat();
    assert_eq!(
        set(&eds(&both)),
        "HB_CONS 01, NODE_GUARDING 00, EM 03, TIME 00, SYNC 03, PDO 3F, SDO_CLI 0B, FIFO 01, 1006 there, "
    );

    let project = of_text("set.eds", &eds(&both));
    for custom in [&[CUSTOM][..], &[]] {
        assert_eq!(project.complaints("OD_extension.c", custom), "", "{custom:?}");
        let unchecked = project.complaints("OD_extension.c", &[custom, &["-DCO_CONFIG_PDO=3"]].concat());
        assert!(unchecked.contains("past limits, locks and conditions"), "{custom:?}: {unchecked}");
    }
    let project = of_text("bare.eds", &without(&whole, "1014"));
    let history = project.complaints("OD_extension.c", &[CUSTOM, "-DCO_CONFIG_EM=CO_CONFIG_EM_HISTORY"]);
    assert!(history.contains("there is no 1003h, and the stack does not start"), "{history}");
}

/// PDO 5 is the second one of the stack, to which it adds nothing of its own: the node-ID comes from the generated function, and where the second one
/// holds the base of the second one, from the stack.
#[test]
fn a_gap_between_pdos_does_not_move_identifiers() {
    let of_base = |base: &str| {
        let second = pdo(0x1404, 2).replace("DefaultValue=1\n", &format!("DefaultValue=$NODEID+{base}\n"));
        let text = eds(&[pdo(0x1400, 2), second, pdo(0x1600, 1), pdo(0x1604, 1)].concat());
        of_text("gap.eds", &text).file("OD_rules.c").contains("{0x1404U, 1U, OD_NUMBER_UNSIGNED, 4U,")
    };
    assert_eq!((of_base("0x300"), of_base("0x400"), of_base("0x600")), (false, true, true));
}

#[test]
fn elements_that_differ_are_members_of_a_record() {
    let entry = |sub: u8, rest: &str| {
        format!(
            "[2000sub{sub}]\nParameterName=Part {sub}\nObjectType=7\nDataType=6\nAccessType=rw\nDefaultValue={sub}\n{rest}"
        )
    };
    let array = |rest: &str| {
        let count = "[2000]\nParameterName=list\nObjectType=8\nSubNumber=3\n[2000sub0]\nParameterName=n\nDataType=5\nAccessType=ro\nDefaultValue=2\n";
        eds(&[count, &entry(1, ""), &entry(2, rest)].concat())
    };
    let list = |text: &str| of_text("elements.eds", text).run("list_entries.c", &[]);
    assert!(list(&array("")).contains("object 2000 2 3\n"));
    let differs = list(&array("PDOMapping=1\n"));
    assert!(differs.contains("object 2000 3 3\n"), "{differs}");
    assert!(
        differs.contains("entry 2000 1 43 2 01 00\n") && differs.contains("entry 2000 2 4F 2 02 00\n"),
        "{differs}"
    );
}

/// An SRDO that is sent (1301h.1 is 1) and one that is received, each with the inverted value of its entry.
#[test]
fn what_an_srdo_maps_is_marked_for_its_direction() {
    let sub = |index: u16, sub: u8, data_type: u8, default: &str| {
        format!(
            "[{index:X}sub{sub}]\nParameterName=s{sub}\nObjectType=7\nDataType={data_type}\nAccessType=rw\nDefaultValue={default}\n"
        )
    };
    let record = |index: u16, subs: &[(u8, &str)]| {
        let subs: String = (0..)
            .zip(subs)
            .map(|(number, (data_type, default))| sub(index, number, *data_type, default))
            .collect();
        format!("[{index:X}]\nParameterName=p{index:X}\nObjectType=9\nSubNumber=3\n{subs}")
    };
    let values: String =
        ["2000", "2001", "2002", "2003"].iter().map(|index| var(index, "5", "rw", "0")).collect();
    let srdos = |direction: &str| {
        [
            record(0x1301, &[(5, "2"), (5, direction), (6, "25")]),
            record(0x1302, &[(5, "2"), (5, "2"), (6, "25")]),
            record(0x1381, &[(5, "2"), (7, "0x20000008"), (7, "0x20010008")]),
            record(0x1382, &[(5, "1"), (7, "0x20020008"), (7, "0x20030008")]),
            values.clone(),
        ]
        .concat()
    };
    let attributes = |direction: &str| {
        let code = of_text("srdo.eds", &eds(&srdos(direction))).file("OD.c");
        ["2000", "2001", "2002", "2003"].map(|index| {
            let object = &code[code.find(&format!(".o_{index}_")).unwrap()..];
            lines(object, ".attribute")[0]
                .trim_start_matches(".attribute = ")
                .trim_end_matches(',')
                .to_owned()
        })
    };
    let (sent, received, none) = ("ODA_SDO_RW | ODA_TSRDO", "ODA_SDO_RW | ODA_RSRDO", "ODA_SDO_RW");
    assert_eq!(attributes("1"), [sent, sent, received, none]);
    assert_eq!(attributes("0"), [none, none, received, none]);
    let empty = eds(&record(0x1301, &[(5, "2"), (5, "1"), (6, "25")]));
    let (said, is_made) = reported("srdo.eds", &empty);
    assert!(said.contains("has SRDOs (1301h) that map nothing") && is_made, "{said}");
}

/// The index is in the name, so that equal names need nothing more.
#[test]
fn objects_of_one_name_are_called_as_the_exporter_calls_them() {
    let twice = ["1400", "1401"].map(|index| {
        let number = u16::from_str_radix(index, 16).unwrap();
        let object = pdo(number, 2)
            .replace(&format!("ParameterName=p{index}"), "ParameterName=RPDO communication parameter");
        [object, pdo(number + 0x200, 1)].concat()
    });
    let header = of_text("twice.eds", &eds(&twice.concat())).file("OD.h");
    for name in ["x1400_RPDOCommunicationParameter;", "x1401_RPDOCommunicationParameter;"] {
        assert!(header.contains(name), "{name} in {header}");
    }
    assert!(header.contains("#define OD_SUB_H1401_s2 (2U)\n"), "{header}");
}

#[test]
fn a_command_without_values_is_reported() {
    let features = "features: [emergency, heartbeat producer, store parameters]";
    let text = |stored: &str| {
        specification(&format!("  0x2000: {{name: offset, type: unsigned8, access: rw, default: 0{stored}}}"))
            .replace("features: [emergency, heartbeat producer]", features)
    };
    let (none, _) = reported("none.od.yaml", &text(""));
    assert!(none.contains("1010h.1 (Save all parameters)") && none.contains("1010h.3 "), "{none}");
    let (some, _) = reported("some.od.yaml", &text(", stored: application"));
    assert!(!some.contains("1010h.1") && !some.contains("1010h.3 ") && some.contains("1010h.4 "), "{some}");
}

#[test]
fn names_that_clash_or_are_words_of_c_are_distinguished() {
    let entry = |sub: u8, name: &str| {
        format!("      {sub}: {{name: {name}, type: unsigned8, access: rw, default: {sub}}}\n")
    };
    let names = ["int", "speed limit", "speed", "class", "double"];
    let members: String = names.iter().zip(1u8..).map(|(name, sub)| entry(sub, name)).collect();
    let text = specification(&format!("  0x2000:\n    name: words\n    record:\n{members}"));
    let header = of_text("words.od.yaml", &text).file("OD.h");
    for member in ["int_", "speedLimit", "speed", "class_", "double_"] {
        assert!(header.contains(&format!("        uint8_t {member};\n")), "{member} in {header}");
    }
    let twice = eds("[2000]\nParameterName=twins\nObjectType=9\nSubNumber=3\n\
                     [2000sub0]\nParameterName=n\nDataType=5\nAccessType=ro\nDefaultValue=2\n\
                     [2000sub1]\nParameterName=a b\nDataType=5\nAccessType=rw\n[2000sub2]\nParameterName=a (b)\nDataType=5\nAccessType=rw\n");
    let header = of_text("twins.eds", &twice).file("OD.h");
    assert!(header.contains("uint8_t aB_1;") && header.contains("uint8_t aB_2;"), "{header}");
}

/// Files are often called `OD`, and a device of an EDS as its file.
#[test]
fn a_device_may_be_called_as_names_of_the_stack_begin() {
    let text = specification(
        "  0x2000: {name: state, type: entry, access: rw}\n  0x2001: {name: way, type: rule, access: rw}\n\
         types:\n  entry: {base: unsigned8, values: {0: x, 1: h2000}}\n  rule: {base: unsigned8, values: {0: listed, 1: locked}}",
    );
    let project = of_text("od.od.yaml", &text.replace("{thing: {", "{od: {"));
    assert_eq!(lines(&project.file("OD_types.h"), "#define OD_").len(), 0);
    project.run("list_entries.c", &[]);
}

#[test]
fn a_device_answers_sdos_without_1200h() {
    let of = |text: &str| lines(&of_text("sdo.eds", text).file("OD.h"), "(config).CNT_SDO_SRV").concat();
    assert_eq!(of(&eds("")), "(config).CNT_SDO_SRV = 1; \\");
    let described = "[1200]\nParameterName=server\nObjectType=9\nSubNumber=3\n\
        [1200sub0]\nParameterName=n\nDataType=5\nAccessType=ro\nDefaultValue=2\n\
        [1200sub1]\nParameterName=a\nDataType=7\nAccessType=ro\nDefaultValue=$NODEID+0x600\n\
        [1200sub2]\nParameterName=b\nDataType=7\nAccessType=ro\nDefaultValue=$NODEID+0x580\n";
    assert_eq!(of(&eds(described)), "(config).CNT_SDO_SRV = OD_CNT_SDO_SRV; \\");
}

#[test]
fn a_condition_that_is_too_wide_is_reported_where_it_is() {
    let text = specification(
        "  0x2000: {name: wide, type: unsigned64, access: rw}\n  0x2001: {name: kept, type: unsigned8, access: rw, writable-when: 0x2000 < 50}",
    );
    let (reported, is_made) = reported("wide.od.yaml", &text);
    assert!(reported.contains("`0x2000 < 50` needs numbers of more than 64 bits") && !is_made, "{reported}");
    let (line, column) =
        text.lines().zip(1..).find_map(|(line, number)| Some((number, 1 + line.find("0x2000 <")?))).unwrap();
    assert!(reported.contains(&format!("wide.od.yaml:{line}:{column}")), "{reported}");
}

#[test]
fn a_heading_is_before_something() {
    let heading = "/* Elements of each ARRAY, without sub-index 0. */";
    let bare = without(&eds(""), "1016");
    for (name, text, arrays) in [("array.eds", eds(""), 1), ("no-array.eds", bare, 0)] {
        let header = of_text(name, &text).file("OD.h");
        assert_eq!(lines(&header, "#define OD_CNT_ARR_").len(), arrays, "{name}");
        assert_eq!(lines(&header, heading).len(), arrays, "{name}");
    }
}

/// A device that the stack takes without a word, and more objects.
fn eds(objects: &str) -> String {
    let head = "[DeviceInfo]\nProductName=thing\n";
    let own: Vec<String> = objects
        .lines()
        .filter_map(|line| line.strip_prefix('[')?.strip_suffix(']'))
        .map(str::to_owned)
        .collect();
    let all = [
        var("1000", "7", "ro", "0"),
        var("1001", "5", "ro", "0"),
        var("1014", "7", "rw", "$NODEID+0x80"),
        "[1016]\nParameterName=consumers\nObjectType=8\nSubNumber=2\n[1016sub0]\nParameterName=n\nDataType=5\nAccessType=ro\nDefaultValue=1\n\
         [1016sub1]\nParameterName=consumer\nDataType=7\nAccessType=rw\nDefaultValue=0\n"
            .to_owned(),
        var("1017", "6", "rw", "0"),
        "[1018]\nParameterName=Identity\nObjectType=9\nSubNumber=2\n[1018sub0]\nParameterName=n\nDataType=5\nAccessType=ro\nDefaultValue=1\n\
         [1018sub1]\nParameterName=Vendor-ID\nDataType=7\nAccessType=ro\nDefaultValue=0\n"
            .to_owned(),
    ];
    let others =
        all.into_iter().filter(|section| !own.iter().any(|name| section.starts_with(&format!("[{name}]"))));
    [head.to_owned(), others.collect::<String>(), objects.to_owned()].concat()
}

/// The file without an object.
fn without(text: &str, index: &str) -> String {
    let mut is_in = false;
    let mut kept = String::new();
    for line in text.lines() {
        if let Some(name) = line.strip_prefix('[') {
            is_in = name.starts_with(index);
        }
        if !is_in {
            kept.push_str(line);
            kept.push('\n');
        }
    }
    kept
}

fn var(index: &str, data_type: &str, access: &str, default: &str) -> String {
    format!(
        "[{index}]\nParameterName=v{index}\nObjectType=7\nDataType={data_type}\nAccessType={access}\nDefaultValue={default}\n"
    )
}

/// A parameter object of a PDO with so many entries after sub-index 0.
fn pdo(index: u16, count: u8) -> String {
    let is_mapping = index & 0x0200 != 0;
    let sub = |sub: u8| {
        let (data_type, default) = match (is_mapping, sub) {
            (true, 0) => ("5", "0".to_owned()),
            (false, 0) => ("5", count.to_string()),
            (true, _) => ("7", "0".to_owned()),
            (false, 1) => ("7", "1".to_owned()),
            (false, _) => ("5", "255".to_owned()),
        };
        let access = if sub == 0 && !is_mapping { "ro" } else { "rw" };
        format!(
            "[{index:04X}sub{sub}]\nParameterName=s{sub}\nObjectType=7\nDataType={data_type}\nAccessType={access}\nDefaultValue={default}\n"
        )
    };
    let subs: String = (0..=count).map(sub).collect();
    format!("[{index:04X}]\nParameterName=p{index:04X}\nObjectType=9\nSubNumber={}\n{subs}", count + 1)
}

/// A specification with the objects of every device, and more.
pub(crate) fn specification(objects: &str) -> String {
    format!(
        "od-spec: 1\ntitle: Thing\nuses: [cia301]\ndevices: {{thing: {{name: Thing, bit-rates: [125], features: [emergency, heartbeat producer]}}}}\nobjects:\n{objects}\n"
    )
}

#[test]
fn the_files_are_the_same_in_every_run() {
    let (system, sources) = compile_with_sources("tests/readers/everything.od.yaml").unwrap();
    let make = || {
        let mut diagnostics = od_spec::diag::Diagnostics::new();
        let provenance = od_gen::Provenance::of(&sources);
        od_c::artifacts(
            &system,
            system.devices.iter(),
            &provenance,
            &od_c::Kind::CanopenNode.into(),
            &mut diagnostics,
        )
    };
    let first = make();
    assert!(first.len() > 5);
    for file in &first {
        let text = std::str::from_utf8(&file.bytes).unwrap();
        assert!(
            text.is_ascii() && text.ends_with('\n') && !text.contains(" \n") && !text.contains('\t'),
            "{}",
            file.path
        );
        assert!(text.contains("@generated"), "{}", file.path);
    }
    for _ in 0..3 {
        assert!(make() == first);
    }
}

#[test]
fn every_entry_has_a_comment() {
    for project in of_workspace("od-spec/devices/pitch-control-system.od.yaml") {
        let header = project.file("OD.h");
        for object in project.device["objects"].as_array().unwrap() {
            let index = object["index"].as_str().unwrap().trim_start_matches("0x");
            if index == "1003" || object["entries"][0].get("alias").is_some() {
                continue;
            }
            assert!(header.contains(&format!("{index}h ")), "{index}");
        }
    }
}
