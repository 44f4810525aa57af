//! What an erratum leaves out follows from what it says.

use od_spec::model::Devices;
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};

const SPECIFICATION: &str = "\
od-spec: 1
title: Lamps
languages: [en]
devices:
  spot: {name: Spot, bit-rates: [125]}
  flood: {name: Flood, bit-rates: [125]}
objects:
  0x2000: {name: level, type: unsigned8, access: ro}
  0x2001: {name: hue, devices: flood, type: unsigned8, access: ro}
  0x2002: {name: beam, devices: spot, array: {count: 2, name: \"beam {n}\", type: unsigned8, access: ro}}
errata:
";

#[test]
fn the_devices_follow_from_the_places() {
    let one = |keys: &str, devices: Devices| {
        let erratum = format!("  - {{{keys}kind: text, place: page 1, prints: a, reads: b, because: c}}\n");
        let mut sources = SourceMap::new();
        let root = sources.add("lamps.od.yaml", format!("{SPECIFICATION}{erratum}"));
        let system = compile(&mut sources, root, &mut NoFiles).system.unwrap();
        assert_eq!(system.errata[0].devices, devices, "{keys}");
    };
    let only = |device: &str| Devices::one(device);
    one("", Devices::All);
    one("at: 0x2000, ", Devices::All);
    one("at: hue, ", only("flood"));
    one("at: 0x2002.2, ", only("spot"));
    one("at: [0x2002.1, 0x2001], ", Devices::All);
    // What is said goes before what would follow.
    one("at: 0x2000, devices: spot, ", only("spot"));
    one("devices: flood, ", only("flood"));
}
