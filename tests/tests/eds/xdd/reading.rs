//! Files as other programs write them: all from parameters, without namespaces, with types that are lost, and with faults.

use od_spec::model::{Access, DataType, EntryId, Index, ObjectKind, PdoMapping, SubIndex, TypeKind, Value};

use crate::xdd::{compiled, said};

/// A file with these types, parameters and objects; as an editor of the world lays it out.
fn file(types: &str, parameters: &str, objects: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n\
         <ISO15745ProfileContainer xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" xmlns=\"http://www.canopen.org/xml/1.1\">\n\
         <ISO15745Profile><ProfileBody xmlns:q1=\"http://www.canopen.org/xml/1.1\" xsi:type=\"q1:ProfileBody_Device_CANopen\" \
         fileName=\"tank.xdd\" fileCreator=\"a person\" fileCreationDate=\"2016-11-16\" fileCreationTime=\"16:38:00.0000000+01:00\" \
         fileVersion=\"3\" supportedLanguages=\"en de\" xmlns=\"\">\n\
         <q1:DeviceIdentity><q1:vendorName>Tanks &amp; Sons</q1:vendorName><q1:vendorID>0x123</q1:vendorID>\
         <q1:productName>Tank</q1:productName><q1:productID>7</q1:productID></q1:DeviceIdentity>\n\
         <q1:ApplicationProcess><q1:dataTypeList>{types}</q1:dataTypeList>\n<q1:parameterList>\n{parameters}</q1:parameterList>\
         </q1:ApplicationProcess></ProfileBody></ISO15745Profile>\n\
         <ISO15745Profile><ProfileBody xmlns=\"\" fileName=\"tank.xdd\"><ApplicationLayers>\
         <q2:CANopenObjectList xmlns:q2=\"http://www.canopen.org/xml/1.1\">\n{objects}</q2:CANopenObjectList></ApplicationLayers>\
         <TransportLayers><PhysicalLayer><baudRate><supportedBaudRate value=\"125 Kbps\"/>\
         <supportedBaudRate value=\"1000 Kbps\"/></baudRate></PhysicalLayer></TransportLayers>\
         <NetworkManagement><CANopenGeneralFeatures granularity=\"8\" nrOfRxPDO=\"0\" nrOfTxPDO=\"0\" bootUpSlave=\"true\" \
         layerSettingServiceSlave=\"true\"/></NetworkManagement></ProfileBody></ISO15745Profile></ISO15745ProfileContainer>\n"
    )
}

fn id(index: u16, sub: u8) -> EntryId {
    EntryId { index: Index(index), sub: SubIndex(sub) }
}

#[test]
fn what_parameters_say_is_read_where_objects_say_nothing() {
    let parameters = "\
        <q1:parameter uniqueID=\"A\" access=\"readWriteOutput\" multiplier=\"0.1\"><label lang=\"en\">level</label>\
        <description lang=\"en\">How full it is.\nbit 3: no bit of a number</description><description lang=\"de\">Wie voll er ist.</description>\
        <INT/><q1:defaultValue value=\"-5\"/><q1:allowedValues><q1:range><minValue value=\"-100\"/><maxValue value=\"100\"/></q1:range>\
        </q1:allowedValues><q1:unit><label lang=\"en\">bar</label></q1:unit></q1:parameter>\n\
        <q1:parameter uniqueID=\"B\"><q1:dataTypeIDRef uniqueIDRef=\"T\"/></q1:parameter>\n\
        <q1:parameter uniqueID=\"C\" access=\"readWrite\"><BITSTRING/><q1:defaultValue value=\"56 34 12\"/></q1:parameter>\n\
        <q1:parameter uniqueID=\"D\" access=\"readWrite\" offset=\"-40\"><SINT/><q1:unit><label lang=\"en\">°C</label></q1:unit></q1:parameter>\n";
    let types = "<enum name=\"mode\" uniqueID=\"T\"><USINT/><enumValue value=\"0\"><label lang=\"en\">off</label></enumValue>\
        <enumValue value=\"1\"><label lang=\"en\">on</label></enumValue></enum>";
    let objects = "\
        <CANopenObject index=\"2000\" name=\"level\" objectType=\"7\" PDOmapping=\"RPDO\" uniqueIDRef=\"A\"/>\n\
        <CANopenObject index=\"2001\" name=\"state\" objectType=\"9\" subNumber=\"4\">\
        <CANopenSubObject subIndex=\"00\" name=\"count\" objectType=\"7\" dataType=\"05\" accessType=\"ro\" defaultValue=\"3\" PDOmapping=\"no\"/>\
        <CANopenSubObject subIndex=\"01\" name=\"mode\" objectType=\"7\" PDOmapping=\"TPDO\" uniqueIDRef=\"B\"/>\
        <CANopenSubObject subIndex=\"02\" name=\"key\" objectType=\"7\" PDOmapping=\"no\" uniqueIDRef=\"C\"/>\
        <CANopenSubObject subIndex=\"03\" name=\"heat\" objectType=\"7\" PDOmapping=\"no\" uniqueIDRef=\"D\"/></CANopenObject>\n";
    let text = file(types, parameters, objects);
    let (compiled, _) = compiled("tank.xdd", text.clone());
    let system = compiled.system.unwrap();
    let device = &system.devices[0];
    assert_eq!((system.vendor.name.as_str(), system.vendor.number), ("Tanks & Sons", 0x123));
    assert_eq!((device.info.product_name.as_str(), device.info.product, device.info.lss), ("Tank", 7, true));
    assert_eq!(device.info.bit_rates, [125, 1000]);
    assert_eq!((device.file.version, device.file.created.hour, device.file.created.minute), (3, 16, 38));
    assert_eq!(system.languages, ["en", "de"]);
    let level = device.entry(id(0x2000, 0)).unwrap();
    assert_eq!(
        (level.data_type, level.access, level.pdo),
        (DataType::Integer16, Access::Rww, PdoMapping::Receive)
    );
    assert_eq!(
        (level.default.clone(), level.low, level.high),
        (Some(Value::Integer(-5)), Some(-100), Some(100))
    );
    assert_eq!(level.unit.as_ref().unwrap().show(7), "0.7 bar");
    assert_eq!(
        (level.about.get("en"), level.about.get("de")),
        (Some("How full it is."), Some("Wie voll er ist."))
    );
    let mode = device.entry(id(0x2001, 1)).unwrap();
    assert_eq!(
        (mode.data_type, mode.access, mode.pdo),
        (DataType::Unsigned8, Access::Ro, PdoMapping::Transmit)
    );
    let Some(TypeKind::Enum(values)) = mode.named_type.as_ref().map(|named| &named.kind) else {
        panic!("{mode:?}")
    };
    assert_eq!(values.named("on").map(|value| value.value), Some(1));
    let key = device.entry(id(0x2001, 2)).unwrap();
    assert_eq!(
        (key.data_type, key.default.clone()),
        (DataType::OctetString, Some(Value::Bytes(vec![0x56, 0x34, 0x12])))
    );
    assert_eq!(device.entry(id(0x2001, 3)).unwrap().unit, None);
    assert!(
        said("tank.xdd", text)
            .contains("note[XDD207]: the unit of 2001h.3 is left out: its raw values count from `-40`")
    );
}

#[test]
fn faults_have_their_place_and_the_rest_is_read() {
    let whole = "PDOmapping=\"no\" dataType=\"0005\" accessType=\"rw\"";
    let objects = format!(
        "<CANopenObject name=\"a\" objectType=\"7\" {whole}/>\n\
         <CANopenObject index=\"20G0\" name=\"b\" objectType=\"7\" {whole}/>\n\
         <CANopenObject index=\"2000\" objectType=\"7\" {whole}/>\n\
         <CANopenObject index=\"2000\" name=\"again\" objectType=\"7\" {whole}/>\n\
         <CANopenObject index=\"2001\" name=\"c\" objectType=\"VAR\" dataType=\"0005\" accessType=\"rwr\" PDOmapping=\"yes\"/>\n\
         <CANopenObject index=\"2002\" name=\"d\" objectType=\"7\" dataType=\"0099\" accessType=\"readonly\"/>\n\
         <CANopenObject index=\"2003\" name=\"e\" objectType=\"7\" uniqueIDRef=\"NONE\"/>\n\
         <CANopenObject index=\"2004\" name=\"f\" objectType=\"7\" dataType=\"0005\" accessType=\"ro\" PDOmapping=\"RPDO\"/>\n\
         <CANopenObject index=\"2005\" name=\"g\" objectType=\"7\" dataType=\"0005\" accessType=\"rw\" defaultValue=\"many\" PDOmapping=\"no\"/>\n\
         <CANopenObject index=\"2006\" name=\"h\" objectType=\"7\" subNumber=\"2\">\
         <CANopenSubObject subIndex=\"00\" name=\"count\" objectType=\"7\" dataType=\"0005\" accessType=\"ro\" defaultValue=\"1\" PDOmapping=\"no\"/>\
         <CANopenSubObject subIndex=\"01\" name=\"one\" objectType=\"9\" {whole}/>\
         <CANopenSubObject subIndex=\"1\" name=\"same\" objectType=\"7\" {whole}/></CANopenObject>\n"
    );
    let text =
        file("", "", &objects).replace("</ApplicationLayers>", "<moduleManagement/></ApplicationLayers>");
    let said: Vec<String> = said("faulty.xdd", text.clone())
        .lines()
        .filter(|line| ["XDD", "EDS5"].iter().any(|code| line.contains(&format!("[{code}"))))
        .map(str::to_owned)
        .collect();
    insta::assert_snapshot!("faults", said.join("\n"));
    let (compiled, _) = compiled("faulty.xdd", text);
    let system = compiled.system.unwrap();
    let found: Vec<u16> = system.devices[0].objects.keys().map(|index| index.0).collect();
    assert_eq!(found, [0x2000, 0x2001, 0x2002, 0x2003, 0x2004, 0x2005, 0x2006]);
}

#[test]
fn a_name_that_is_a_key_of_an_eds_stays_a_name() {
    let object = |index: u16| {
        format!(
            "<CANopenObject index=\"{index:X}\" name=\"ObjFlags\" objectType=\"7\" dataType=\"0005\" accessType=\"const\"/>\n"
        )
    };
    let said = said("tank.xdd", file("", "", &(object(0x2000) + &object(0x2001))));
    assert!(said.contains("2000h and 2001h of `tank` are both named `ObjFlags`"), "{said}");
    assert!(!said.contains("`objFlags`"), "{said}");
}

#[test]
fn namespaces_do_not_matter() {
    let text = file(
        "",
        "",
        "<CANopenObject index=\"1000\" name=\"Device type\" objectType=\"7\" dataType=\"0007\" accessType=\"ro\" defaultValue=\"0x191\" PDOmapping=\"no\"/>\n",
    );
    let bare = text
        .replace("q1:", "")
        .replace("q2:", "")
        .replace(" xmlns=\"http://www.canopen.org/xml/1.1\"", "")
        .replace(" xmlns=\"\"", "")
        .replace("xsi:type", "type");
    let older = text.replace("xml/1.1", "xml/1.0");
    for text in [text, bare, older] {
        // A name of another kind, and a mark at the beginning.
        for name in ["tank.xdd", "tank.XDD", "tank.xml", "<stdin>"] {
            let (compiled, _) = compiled(name, format!("\u{FEFF}{text}"));
            assert_eq!(compiled.system.unwrap().devices[0].info.device_type, 0x191, "{name}");
        }
    }
    let (compiled, _) = compiled("none.xdd", "<project><objects/></project>");
    assert!(compiled.system.is_none());
    assert_eq!(
        said("none.xdd", "<project><objects/></project>"),
        "none.xdd:1:2: error[XDD103]: found `project`, which has no `CANopenObjectList` (is this the right file? an XDD or XDC describes the objects of a CANopen device)\n"
    );
    assert_eq!(
        said("open.xdd", "<?xml version=\"1.0\"?>\n<a>\n  <ä b=1/>\n</a>"),
        "open.xdd:3:8: error[XDD101]: this is not XML: expected a quote not '1' (correct it; nothing of the file was read)\n"
    );
}

#[test]
fn words_are_read_as_what_they_say_and_cia_301_gives_types() {
    let parameters = "<parameter uniqueID=\"N\" access=\"readWrite\"><defaultValue value=\"0\"/></parameter>\n\
        <parameter uniqueID=\"E\" access=\"Read-Only\"/><parameter uniqueID=\"U\" access=\"write\"><UINT/></parameter>\n\
        <parameter uniqueID=\"W\" access=\"read\"><UNSIGNED32/></parameter>\n";
    let objects = "\
        <CANopenObject index=\"1003\" name=\"errors\" objectType=\"ARRAY\" subNumber=\"2\">\
        <CANopenSubObject subIndex=\"0000\" name=\"count\" objectType=\"7\" PDOmapping=\"no\" uniqueIDRef=\"N\"/>\
        <CANopenSubObject subIndex=\"0001\" name=\"error\" objectType=\"7\" PDOmapping=\"no\" uniqueIDRef=\"E\"/></CANopenObject>\n\
        <CANopenObject index=\"1017\" name=\"heartbeat\" objectType=\"7\" accessType=\"readWrite\" defaultValue=\"500\" PDOmapping=\"no\"/>\n\
        <CANopenObject index=\"2000\" name=\"a\" objectType=\"VAR\" dataType=\"UNSIGNED16\" accessType=\"RW\" defaultValue=\"7\" PDOmapping=\"yes\"/>\n\
        <CANopenObject index=\"2001\" name=\"b\" objectType=\"7\" dataType=\"INT\" accessType=\"r/w\" defaultValue=\"-7\" PDOmapping=\"no\"/>\n\
        <CANopenObject index=\"2002\" name=\"c\" objectType=\"7\" PDOmapping=\"no\" uniqueIDRef=\"U\"/>\n\
        <CANopenObject index=\"2003\" name=\"d\" objectType=\"7\" PDOmapping=\"no\" uniqueIDRef=\"W\"/>\n\
        <CANopenObject index=\"2004\" name=\"e\" objectType=\"9\" subNumber=\"2\">\
        <CANopenSubObject subIndex=\"00\" name=\"count\" objectType=\"7\" accessType=\"ro\" defaultValue=\"1\" PDOmapping=\"no\"/>\
        <CANopenSubObject subIndex=\"01\" name=\"one\" objectType=\"7\" accessType=\"ro\" defaultValue=\"1\" PDOmapping=\"no\"/></CANopenObject>\n";
    let text = file("", parameters, objects);
    let (read, _) = compiled("tank.xdd", text.clone());
    let system = read.system.unwrap();
    let device = &system.devices[0];
    let number = |number| Some(Value::Integer(number));
    for (entry, data_type, access, default) in [
        (id(0x1003, 0), DataType::Unsigned8, Access::Rw, number(0)),
        (id(0x1003, 1), DataType::Unsigned32, Access::Ro, None),
        (id(0x1017, 0), DataType::Unsigned16, Access::Rw, number(500)),
        (id(0x2000, 0), DataType::Unsigned16, Access::Rw, number(7)),
        (id(0x2001, 0), DataType::Integer16, Access::Rw, number(-7)),
        (id(0x2002, 0), DataType::Unsigned16, Access::Wo, None),
        (id(0x2003, 0), DataType::Unsigned32, Access::Ro, None),
        (id(0x2004, 0), DataType::Unsigned8, Access::Ro, number(1)),
        (id(0x2004, 1), DataType::Domain, Access::Ro, None),
    ] {
        let found = device.entry(entry).unwrap();
        assert_eq!(
            (found.data_type, found.access, found.default.clone()),
            (data_type, access, default),
            "{entry}"
        );
    }
    assert_eq!(device.objects[&Index(0x1003)].kind, ObjectKind::Array);
    assert_eq!(device.entry(id(0x2000, 0)).unwrap().pdo, PdoMapping::Both);
    let found = said("tank.xdd", text);
    let about: Vec<&str> = found
        .lines()
        .filter(|line| line.contains("[XDD"))
        .filter_map(|line| line.split_once("]: ")?.1.split_once(" (").map(|(message, _)| message))
        .collect();
    assert_eq!(
        about,
        [
            "1003h.1: found `access=\"Read-Only\"`; it is taken as `ro`",
            "1003h: found `objectType=\"ARRAY\"`; it is taken as ARRAY",
            "1003h has no data type; it is taken as UNSIGNED8",
            "1003h.1 has no data type; it is taken as UNSIGNED32",
            "1017h has no data type; it is taken as UNSIGNED16",
            "1017h: found `accessType=\"readWrite\"`; it is taken as `rw`",
            "2000h: found `objectType=\"VAR\"`; it is taken as VAR",
            "2000h: found `dataType=\"UNSIGNED16\"`; it is taken as UNSIGNED16",
            "2000h: found `accessType=\"RW\"`; it is taken as `rw`",
            "2000h: found `PDOmapping=\"yes\"`; it is taken as `optional`",
            "2001h: found `dataType=\"INT\"`; it is taken as INTEGER16",
            "2001h: found `accessType=\"r/w\"`; it is taken as `rw`",
            "2004h has no data type; it is taken as UNSIGNED8",
            "2004h.1 has no data type; it is taken as DOMAIN",
        ]
    );
}

#[test]
fn a_bit_rate_of_a_node_that_is_none_is_reported() {
    let commissioned = |rate: &str| {
        let element = format!(
            "<deviceCommissioning NodeID=\"2\" nodeName=\"tank\" actualBaudRate=\"{rate}\" networkNumber=\"0\" networkName=\"\" CANopenManager=\"false\"/>"
        );
        file("", "", "").replace("</NetworkManagement>", &format!("{element}</NetworkManagement>"))
    };
    let read = |rate: &str| {
        let (compiled, _) = compiled("tank.xdc", commissioned(rate));
        let found = said("tank.xdc", commissioned(rate));
        (compiled.node.unwrap().at(None).bit_rate, found.contains("actualBaudRate"))
    };
    assert_eq!((read("125 Kbps"), read("500000")), ((125, false), (500, false)));
    // The highest that the device has, which is what `odgen` takes where nothing is said.
    assert_eq!((read("0"), read("auto-baudRate")), ((1000, true), (1000, true)));
    // One that CiA 301 does not have is kept.
    assert_eq!(read("100 Kbps"), (100, true));
}

#[test]
fn settings_of_a_node_that_are_no_numbers_of_a_bus_are_reported() {
    let said_of = |node: &str, network: &str| {
        let element = format!(
            "<deviceCommissioning NodeID=\"{node}\" nodeName=\"tank\" actualBaudRate=\"125 Kbps\" networkNumber=\"{network}\" networkName=\"\" CANopenManager=\"false\"/>"
        );
        let text =
            file("", "", "").replace("</NetworkManagement>", &format!("{element}</NetworkManagement>"));
        let found = said("tank.xdc", text);
        let lines = found.lines().filter(|line| line.contains("NodeID=") || line.contains("networkNumber="));
        lines.filter(|line| line.contains("expected")).map(ToOwned::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(said_of("127", "0"), [""; 0]);
    assert_eq!(said_of("0xFF", "4294967295"), [""; 0], "255 is a node that LSS is to give a node-ID");
    for node in ["0", "128", "200", "-1", "one"] {
        let found = said_of(node, "0");
        assert!(
            matches!(&found[..], [one] if one.contains(&format!("found `NodeID=\"{node}\"`, expected a node-ID"))),
            "{found:?}"
        );
    }
    let found = said_of("5", "4294967296");
    assert!(matches!(&found[..], [one] if one.contains("expected a number")), "{found:?}");
}
