//! Files as other programs write them: all from parameters, without namespaces, with types that are lost, and with faults.

use od_spec::model::{Access, DataType, EntryId, Index, PdoMapping, SubIndex, TypeKind, Value};

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
