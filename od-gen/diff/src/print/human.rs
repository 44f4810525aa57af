//! For people on a terminal, and one line for each change.

use std::fmt::Write as _;

use od_spec::visible::visible;

use super::super::{Change, Class, Difference, Kind};
use super::line::{SHORT, Style, line};
use super::{advice, scope, summary, unknown};

const FOR_PEOPLE: Style = Style { arrow: "→", longest: Some(SHORT) };
const FOR_SCRIPTS: Style = Style { arrow: "->", longest: Some(SHORT) };

/// For people: the changes of each device with what they break and why, then the version numbers.
pub fn human(difference: &Difference, colour: bool) -> String {
    let paint = Paint { colour };
    let mut text = String::new();
    if !difference.system.is_empty() {
        let _ = writeln!(text, "{}", paint.bold("all devices"));
        paint.changes(&mut text, &difference.system);
    }
    for device in &difference.devices {
        let sentences = advice::sentences(&device.proposals);
        if device.changes.is_empty() && sentences.is_empty() {
            continue;
        }
        let _ = writeln!(text, "{}", paint.bold(&visible(&format!("{}  {}", device.key, device.name))));
        paint.changes(&mut text, &device.changes);
        for one in &device.unknown {
            let _ = writeln!(text, "  note: {}", unknown(*one));
        }
        if !sentences.is_empty() {
            let _ = writeln!(text, "  proposed: {}", visible(&sentences.join("; ")));
        }
    }
    let _ = writeln!(text, "{}", summary(difference));
    if let Some(scope) = scope(difference.scope) {
        let _ = writeln!(text, "note: {scope}");
    }
    text
}

/// One line for each change: the device, what differs, and the classes in brackets.
pub fn short(difference: &Difference) -> String {
    let mut text = String::new();
    let all = difference.system.iter().map(|change| ("*", change));
    let devices = difference.devices.iter();
    let of_devices =
        devices.flat_map(|device| device.changes.iter().map(|change| (device.key.as_str(), change)));
    for (device, change) in all.chain(of_devices) {
        let classes: Vec<&str> = change.classes().into_iter().map(Class::word).collect();
        let _ = writeln!(text, "{device}: {} [{}]", line(change, FOR_SCRIPTS), classes.join(", "));
    }
    text
}

/// Colours, or none.
struct Paint {
    colour: bool,
}

impl Paint {
    fn changes(&self, text: &mut String, changes: &[Change]) {
        for change in changes {
            let head = self.painted(sign(change.kind()), &line(change, FOR_PEOPLE));
            if change.class() == Class::Documents {
                let _ = writeln!(text, "  {head}  ({})", Class::Documents.phrase());
                continue;
            }
            let _ = writeln!(text, "  {head}");
            for consequence in &change.consequences {
                let phrase = self.painted(weight(consequence.class), consequence.class.phrase());
                let _ = writeln!(text, "      {phrase}: {}", visible(&consequence.because));
            }
        }
    }

    fn bold(&self, text: &str) -> String {
        self.painted("1", text)
    }

    /// Text in a colour (ECMA-48).
    fn painted(&self, code: &str, text: &str) -> String {
        if self.colour && !code.is_empty() { format!("\x1b[{code}m{text}\x1b[0m") } else { text.to_owned() }
    }
}

/// Green, red and yellow.
const fn sign(kind: Kind) -> &'static str {
    match kind {
        Kind::Added => "32",
        Kind::Removed => "31",
        Kind::Changed => "33",
    }
}

/// What breaks something is red.
const fn weight(class: Class) -> &'static str {
    match class {
        Class::Plc | Class::Stored | Class::Firmware => "1;31",
        Class::Behaviour => "33",
        Class::Addition => "32",
        Class::Documents => "",
    }
}
