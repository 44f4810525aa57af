//! A DCF with a setting in every data type, for the foreign readers.

use od_formats::eds::write_dcf;
use od_gen::Artifact;
use od_gen::files::write_all;
use od_spec::diag::Diagnostics;
use od_spec::diag::render::{Format, render};
use od_spec::model::System;
use od_spec::source::{SourceMap, Spanned};
use od_spec::{Commissioning, Layer, assign, assign_layers, parameter_file};
use od_tests::{Failure, root};

/// Where the DCF with [`SETTINGS`] is put.
pub(crate) const CONFIGURED: &str = "target/everything/configured";

/// Settings of `everything.od.yaml` for node 5 in every data type that can be set, and what a DCF must say: the entry
/// and its raw number or text.
const SETTINGS: [(&str, &str); 29] = [
    ("2000=no", "2000.0 0"),
    ("2001=-127", "2001.0 -127"),
    ("2002=32767", "2002.0 32767"),
    ("2003=8388607", "2003.0 8388607"),
    ("2004=2147483646", "2004.0 2147483646"),
    ("2005=-549755813888", "2005.0 -549755813888"),
    ("2006=140737488355327", "2006.0 140737488355327"),
    ("2007=-36028797018963968", "2007.0 -36028797018963968"),
    ("2008=9223372036854775807", "2008.0 9223372036854775807"),
    ("2009=1", "2009.0 1"),
    ("200A=0x1234", "200A.0 4660"),
    ("200B=1", "200B.0 1"),
    ("200C=$NODEID + 0x700", "200C.0 1797"),
    ("200D=1099511627775", "200D.0 1099511627775"),
    ("200E=281474976710655", "200E.0 281474976710655"),
    ("200F=72057594037927935", "200F.0 72057594037927935"),
    ("2010=18446744073709551614", "2010.0 18446744073709551614"),
    ("2011=0.1", "2011.0 0.1"),
    ("2012=-2.5e300", "2012.0 -2.5e300"),
    ("2013=Good bye", "2013.0 Good bye"),
    ("2014=ff 00 A5", "2014.0 FF00A5"),
    ("2015=another text", "2015.0 another text"),
    ("a mode=forward", "2019.0 1"),
    ("201A=0x0007", "201A.0 7"),
    ("201B=21.5 °C", "201B.0 215"),
    ("201C.12=3", "201C.12 3"),
    ("1404.1=0x6F4", "1404.1 1780"),
    ("1605.0=1", "1605.0 1"),
    ("1605.1=0x20090008", "1605.1 537460744"),
];

/// The settings as a parameter file.
fn parameter_file_text() -> String {
    let setting = |(setting, _): (&str, &str)| {
        let (entry, value) = setting.split_once('=').unwrap_or((setting, ""));
        format!("  \"{entry}\": \"{value}\"\n")
    };
    format!("od-parameters: 1\nparameters:\n{}", SETTINGS.map(setting).concat())
}

/// A DCF with every setting, and the list of what it must say.
pub(crate) fn write_configured(system: &System, mut sources: SourceMap) -> Result<(), Failure> {
    let device = system.devices.first().ok_or("everything.od.yaml has no device")?;
    let settings = SETTINGS.map(|(setting, _)| {
        let file = sources.add("SETTINGS", setting);
        Spanned::new(setting.to_owned(), sources.whole(file))
    });
    let parameters = sources.add("SETTINGS as a parameter file", parameter_file_text());
    let mut diagnostics = Diagnostics::new();
    let mut commissioning = Commissioning::of_node(device, 5);
    commissioning.values = assign(system, device, commissioning.node, &settings, &mut diagnostics);
    let layers: Vec<Layer> =
        parameter_file(&sources, parameters, &mut diagnostics).into_iter().map(|file| file.layer).collect();
    let of_file = assign_layers(system, device, commissioning.node, &layers, &mut diagnostics);
    if !diagnostics.is_empty() {
        return Err(render(&diagnostics, &sources, Format::Human, false).into());
    }
    if commissioning.values != of_file.values {
        return Err("a parameter file gives other values than the same settings".into());
    }
    commissioning.values = of_file.values;
    let file = format!("{}.dcf", device.key);
    let bytes = write_dcf(system, device, &commissioning, &file);
    let values = SETTINGS.map(|(_, value)| format!("{value}\n")).concat();
    let set = [
        Artifact { path: file, bytes, purpose: String::new() },
        Artifact { path: "values.txt".to_owned(), bytes: values.into_bytes(), purpose: String::new() },
    ];
    write_all(&root().join(CONFIGURED), &set)?;
    Ok(())
}
