//! The text of the format, section by section in the order that tools expect.

use std::borrow::Cow;
use std::fmt::Write as _;

use od_spec::ascii::transliterate;
use od_spec::eds::GENERATED;
use od_spec::encoding::{Encoding, encode};

use super::Node;
use super::message::Message;
use super::names::{node_name, whole_node_name};
use super::signals::{Coding, Signal};

/// A node of which the file knows nothing.
const NOBODY: &str = "Vector__XXX";
/// Attribute of a name that is longer than the format's.
const LONG_SIGNAL: &str = "SystemSignalLongSymbol";
const LONG_NODE: &str = "SystemNodeLongSymbol";
const CYCLE: &str = "GenMsgCycleTime";
const START: &str = "GenSigStartValue";

/// Lines end as on Windows, where most tools of the format run.
const END: &str = "\r\n";

pub(super) struct Text {
    text: String,
}

impl Text {
    pub(super) const fn new() -> Self {
        Self { text: String::new() }
    }

    /// In Windows-1252. Characters that it does not have are transcribed.
    pub(super) fn into_bytes(self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.text.len());
        for c in self.text.chars() {
            let mut one = [0; 4];
            let one = c.encode_utf8(&mut one);
            bytes.extend(
                encode(one, Encoding::Windows1252).unwrap_or_else(|_| transliterate(one).into_bytes()),
            );
        }
        bytes
    }

    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push_str(END);
    }

    pub(super) fn head(&mut self) {
        self.line(&format!("VERSION {}", quoted(GENERATED)));
        for line in ["", "NS_ :", "", "BS_:", ""] {
            self.line(line);
        }
    }

    pub(super) fn nodes(&mut self, names: impl Iterator<Item = String>) {
        let names: Vec<String> = names.collect();
        self.line(&format!("BU_: {}", names.join(" ")));
        self.line("");
    }

    pub(super) fn message(&mut self, message: &Message) {
        let sender = message.sender.as_deref().unwrap_or(NOBODY);
        self.line(&format!("BO_ {} {}: {} {sender}", message.id.in_file(), message.name, message.length));
        let receivers = if message.receivers.is_empty() {
            Cow::Borrowed(NOBODY)
        } else {
            Cow::Owned(message.receivers.join(","))
        };
        for signal in &message.signals {
            let Signal { name, bits: (first, count), factor, offset, limits: (low, high), unit, .. } = signal;
            let sign = if signal.coding == Coding::Unsigned { '+' } else { '-' };
            self.line(&format!(
                " SG_ {} : {first}|{count}@1{sign} ({factor},{offset}) [{low}|{high}] {} {receivers}",
                name.short,
                on_one_line(unit)
            ));
        }
        self.line("");
    }

    pub(super) fn node_comment(&mut self, name: &str, comment: &str) {
        self.line(&format!("CM_ BU_ {name} {};", quoted(comment)));
    }

    pub(super) fn comments(&mut self, message: &Message) {
        let id = message.id.in_file();
        self.line(&format!("CM_ BO_ {id} {};", quoted(&message.comment)));
        for Signal { name, comment, .. } in message.signals.iter().filter(|signal| !signal.comment.is_empty())
        {
            self.line(&format!("CM_ SG_ {id} {} {};", name.short, quoted(comment)));
        }
    }

    pub(super) fn attribute_definitions(&mut self) {
        for line in [
            "BA_DEF_  \"BusType\" STRING ;",
            "BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 65535;",
            "BA_DEF_ SG_ \"GenSigStartValue\" FLOAT -3.4E+038 3.4E+038;",
            "BA_DEF_ SG_ \"SystemSignalLongSymbol\" STRING ;",
            "BA_DEF_ BU_ \"SystemNodeLongSymbol\" STRING ;",
            "BA_DEF_DEF_ \"BusType\" \"CAN\";",
            "BA_DEF_DEF_ \"GenMsgCycleTime\" 0;",
            "BA_DEF_DEF_ \"GenSigStartValue\" 0;",
            "BA_DEF_DEF_ \"SystemSignalLongSymbol\" \"\";",
            "BA_DEF_DEF_ \"SystemNodeLongSymbol\" \"\";",
        ] {
            self.line(line);
        }
        self.line("BA_ \"BusType\" \"CAN\";");
    }

    pub(super) fn node_attributes(&mut self, node: &Node<'_>) {
        let (short, whole) = (node_name(node), whole_node_name(node));
        if short != whole {
            self.line(&format!("BA_ \"{LONG_NODE}\" BU_ {short} {};", quoted(&whole)));
        }
    }

    pub(super) fn attributes(&mut self, message: &Message) {
        let id = message.id.in_file();
        if let Some(cycle) = message.cycle {
            self.line(&format!("BA_ \"{CYCLE}\" BO_ {id} {cycle};"));
        }
        for Signal { name, start, .. } in &message.signals {
            if let Some(start) = start.as_deref().filter(|start| *start != "0") {
                self.line(&format!("BA_ \"{START}\" SG_ {id} {} {start};", name.short));
            }
            if name.short != name.long {
                self.line(&format!("BA_ \"{LONG_SIGNAL}\" SG_ {id} {} {};", name.short, quoted(&name.long)));
            }
        }
    }

    pub(super) fn values(&mut self, message: &Message) {
        for Signal { name, values, .. } in message.signals.iter().filter(|signal| !signal.values.is_empty()) {
            let mut line = format!("VAL_ {} {}", message.id.in_file(), name.short);
            for (raw, text) in values {
                let _ = write!(line, " {raw} {}", on_one_line(text));
            }
            line.push_str(" ;");
            self.line(&line);
        }
    }

    pub(super) fn value_types(&mut self, message: &Message) {
        for Signal { name, coding, .. } in &message.signals {
            let code = match coding {
                Coding::Unsigned | Coding::Signed => continue,
                Coding::Real32 => 1,
                Coding::Real64 => 2,
            };
            self.line(&format!("SIG_VALTYPE_ {} {} : {code};", message.id.in_file(), name.short));
        }
    }
}

/// A text between quotation marks, in which no other one is; control characters except ends of lines are spaces.
fn quoted(text: &str) -> String {
    let inner: String = text
        .chars()
        .map(|c| match c {
            '"' => '\'',
            // A backslash before the last quotation mark would hide it from some tools.
            '\\' => '/',
            '\n' => '\n',
            c if c.is_control() => ' ',
            c => c,
        })
        .collect();
    format!("\"{}\"", inner.replace('\n', END))
}

/// The same on one line: tools take several only as a comment.
fn on_one_line(text: &str) -> String {
    quoted(&text.replace(['\n', '\r', '\u{2028}', '\u{2029}'], " "))
}
