//! The printed manual.

use super::shape::{DEVICES, INDICES, Key, Keys, NameOf, PHRASES, Shape};
use super::table::keys;
use crate::model::{Basis, Direction, ErratumKind, Unprinted};

macro_rules! erratum_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "at": Shape::OneOrMore(&Shape::Entry) => at: Vec<Name>, "objects or entries that it is about", "[0x3004, 0x30FA.3]";
            "devices": DEVICES => devices: Option<Vec<Name>>, "devices that it is about; unless given, those that have something of `at`, or all without `at`";
            "kind" required: Shape::Choice(ErratumKind::WORDS) => kind: Option<Spanned<ErratumKind>>, "the kind of fact";
            "place" required: Shape::Words => place: Words, "where the manual prints it", "\"4.1.1.5, detail table\"";
            "prints" required: Shape::Words => prints: Words, "what the manual prints", "3003h";
            "reads" required: Shape::Words => reads: Words, "what the specification says", "3004h";
            "because" required: Shape::Words => because: Words, "the reason";
            "facts": Shape::OneOrMore(&Shape::Choice(Unprinted::FACTS)) => facts: Vec<Spanned<Fact>>, "of a `gap`: facts of `at`, or of the devices without `at`, that the manual does not print; documents mark them", "[default, pdo]";
            "of": Shape::OneOrMore(&Shape::Integer(-0x8000_0000_0000_0000, 0xFFFF_FFFF_FFFF_FFFF)) => of: Vec<Spanned<i128>>, "values or bits of the type of `at` that it is about; all unless given", "[17, 18]";
            "basis": Shape::Choice(Basis::WORDS) => basis: Option<Spanned<Basis>>, "where the facts come from instead";
        } }
    };
}
pub(crate) use erratum_keys;

erratum_keys! { keys
    /// An erratum.
    ERRATUM = "an erratum" needs [Together(["facts", "basis"])]
}

keys! {
    /// A section of the manual.
    SECTION = "a section" {
        "section": Shape::Text, "number, as printed; parts such as the imprint have none", "\"4.1.1\"";
        "title" required: Shape::Words, "heading";
        "content": Shape::List(&Shape::Map(&CONTENT)), "its texts and tables, in order";
        "search": PHRASES, "words and phrases by which readers look for it, by language, where its title and texts have others", "{en: jog the axis, de: Achse von Hand fahren}";
    }
}

keys! {
    /// A text or table of the manual.
    CONTENT = "a text or table" needs [One([
        "text", "note", "warning", "steps", "list", "formula", "gap", "overview", "objects", "bits", "values", "errors",
        "reactions", "states", "transitions", "commands", "ladder", "timing", "hysteresis", "flow", "axis", "pdos",
        "rows", "glossary", "history"
    ])] {
        "text": Shape::Words, "paragraphs; each line of the value is one", "The PMC controls the axis.";
        "note": Shape::Words, "paragraphs that are highlighted", "The value is lost at power-off.";
        "warning": Shape::Words, "paragraphs about a danger", "The drive moves at once.";
        "for": INDICES, "objects whose own warnings a `warning` says in full: the tables of its section do not repeat them, and the overview of the warnings lists it with them", "[0x30F1]";
        "steps": Shape::List(&Shape::Words), "actions, one after the other", "[Switch on., Set the mode.]";
        "list": Shape::List(&Shape::Words), "a list without an order", "[position, velocity]";
        "formula": Shape::Words, "a formula; each line of the value is one", "\"power = force · velocity\"";
        "gap": Shape::Words, "paragraphs about what the printed manual leaves open", "What 0 means is not stated.";
        "number": Shape::Integer(1, 9999), "number of a table, as printed";
        "title": Shape::Words, "caption of a table";
        "figure": Shape::ShortOr(&Shape::Integer(1, 9999), &FIGURE), "number of the picture that the documents draw, as printed", "13";
        "order": Shape::List(&Shape::Integer(-0x8000_0000_0000_0000, 0xFFFF_FFFF_FFFF_FFFF)), "the rows of `values` or `bits` in the order as printed: each value or first bit once; ascending unless given", "[0, 1, 2, -1]";
        "columns": Shape::List(&Shape::Text), "columns that the printed table has, by the keys that templates see; `tables.json` names the others as added", "[bit, meaning]";
        "overview": INDICES, "one row per object", "[0x3000, 0x3001]";
        "objects": INDICES, "the objects' entries in detail";
        "bits": Shape::ShortOr(&Shape::NameOf(NameOf::NamedType), &TABLE_BITS), "bits of a named type", "{type: PMM digital inputs, masks: 16}";
        "values": Shape::NameOf(NameOf::NamedType), "values of a named type";
        "errors": Shape::OneOrMore(&Shape::NameOf(NameOf::Errors)), "error codes, or `all`", "[0x2210, 0x3281..0x3288]";
        "reactions": Shape::OneOrMore(&Shape::NameOf(NameOf::Errors)), "error codes with the device's reactions, or `all`";
        "states": Shape::NameOf(NameOf::Machine), "states of a state machine";
        "transitions": Shape::NameOf(NameOf::Machine), "transitions of a state machine";
        "commands": Shape::NameOf(NameOf::Machine), "commands of a state machine";
        "ladder": Shape::ShortOr(&Shape::NameOf(NameOf::Constraint), &TABLE_LADDER), "entries of an ordering constraint, with their defaults";
        "timing": Shape::Map(&TIMING), "a sequence of events, drawn as levels of signals";
        "hysteresis": Shape::OneOrMore(&Shape::Map(&SWITCH)), "what goes on beyond a threshold and off at another value, drawn with the values of the defaults";
        "flow": Shape::OneOrMore(&Shape::Map(&BLOCK)), "blocks and what goes from one to another, drawn as a block diagram";
        "axis": Shape::Map(&AXIS), "marks on an axis and the spans between them, drawn as a dimensioned line";
        "pdos": Shape::Map(&TABLE_PDOS), "default PDOs of a device", "{device: pmc, direction: receive}";
        "rows": Shape::Map(&TABLE_ROWS), "rows of text", "{columns: [Index, Use], rows: [[0000h, not used]]}";
        "glossary": Shape::YesNo, "abbreviations";
        "history": Shape::YesNo, "issues of the manual";
    }
}

keys! {
    /// `figure:` of a table.
    FIGURE = "a figure" {
        "number" required: Shape::Integer(1, 9999), "number, as printed";
        "title": Shape::Words, "caption, where it differs from that of the table";
    }
}

keys! {
    /// `bits:` of a table.
    TABLE_BITS = "a bit table" {
        "type" required: Shape::NameOf(NameOf::NamedType), "name of the bit field type";
        "masks": Shape::Integer(1, 64), "width in bits of masks, which the table then also shows; bits beyond it have none";
    }
}

keys! {
    /// `ladder:` of a table.
    TABLE_LADDER = "a ladder" {
        "constraint" required: Shape::NameOf(NameOf::Constraint), "name of the constraint";
        "labels": Shape::List(&Shape::Words), "names of its entries there, in the order of the constraint", "[lowest voltage, highest voltage]";
    }
}

keys! {
    /// `pdos:` of a table.
    TABLE_PDOS = "a PDO table" {
        "device" required: Shape::NameOf(NameOf::Device), "key of the device";
        "direction" required: Shape::Choice(Direction::WORDS), "direction, seen from the device";
    }
}

keys! {
    /// `rows:` of a table.
    TABLE_ROWS = "a table of text" {
        "columns" required: Shape::List(&Shape::Words), "column headings";
        "rows" required: Shape::List(&Shape::List(&Shape::Words)), "cells";
    }
}

macro_rules! timing_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "signals" required: Shape::OneOrMore(&Shape::Map(&SIGNAL)) => signals: Vec<Spanned<SignalDecl>>, "what changes, from the top of the picture";
            "steps" required: Shape::OneOrMore(&Shape::Map(&TIMING_STEP)) => steps: Vec<Spanned<TimingStepDecl>>, "what happens, one after the other";
        } }
    };
}
pub(crate) use timing_keys;

timing_keys! { keys
    /// `timing:` of a table.
    TIMING = "a sequence of events"
}

macro_rules! signal_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "type": Shape::NameOf(NameOf::NamedType) => named_type: Option<Name>, "bit field type that has the bit", "controlword";
            "bit": Shape::NameOf(NameOf::Bit) => bit: Option<Name>, "bit or run of bits of the type: its name, also one for a single mode of operation, or its number", "new set-point";
            "entry": Shape::Entry => entry: Option<Name>, "entry whose value it is, instead of `type` and `bit`", "0x607A";
            "levels" required: Shape::List(&Shape::Value) => levels: Option<Spanned<Levels>>, "the level before the first step, then that after each step", "[0, 0, 1, 1, 0]";
        } }
    };
}
pub(crate) use signal_keys;

signal_keys! { keys
    /// A signal of a sequence of events.
    SIGNAL = "a signal" needs [Together(["type", "bit"]), One(["type", "entry"])]
}

macro_rules! timing_step_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "event" required: Shape::Words => event: Words, "what happens", "The device sets bit 12 of 6041h.";
            "cause": Shape::Integer(1, 64) => cause: Option<Spanned<i128>>, "number of the earlier step that causes this one; an arrow leads from there", "2";
        } }
    };
}
pub(crate) use timing_step_keys;

timing_step_keys! { keys
    /// A step of a sequence of events.
    TIMING_STEP = "a step of a sequence"
}

macro_rules! switch_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "switches" required: Shape::Words => what: Words, "what goes on", "heater and fan";
            "below": Shape::Entry => below: Option<Name>, "entry with the value below which it goes on", "0x3201.1";
            "above": Shape::Entry => above: Option<Name>, "entry with the value above which it goes on", "0x3201.2";
            "back-by": Shape::Entry => back_by: Option<Name>, "entry with the difference from the threshold at which it goes off again", "0x3201.3";
            "back-at": Shape::Entry => back_at: Option<Name>, "entry with the value at which it goes off again", "0x30FC.2";
        } }
    };
}
pub(crate) use switch_keys;

switch_keys! { keys
    /// A switch with a hysteresis.
    SWITCH = "a switch with a hysteresis" needs [One(["below", "above"]), One(["back-by", "back-at"])]
}

macro_rules! block_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "block" required: Shape::Words => name: Words, "what it is; the name by which later blocks refer to it", "ramp generator";
            "entries": Shape::OneOrMore(&Shape::Entry) => entries: Vec<Name>, "entries or objects whose values it has or that set it up", "[0x6083, 0x6084]";
            "type": Shape::NameOf(NameOf::NamedType) => named_type: Option<Name>, "bit field type that has the bit", "controlword";
            "bit": Shape::NameOf(NameOf::Bit) => bit: Option<Name>, "bit or run of bits of the type that it is, or that acts on it", "halt";
            "does": Shape::Words => does: Words, "what it does", "limits the velocity";
            "from": Shape::OneOrMore(&Shape::ShortOr(&Shape::NameOf(NameOf::Block), &INFLOW)) => from: Vec<Spanned<InflowDecl>>, "earlier blocks from which it takes something: an arrow leads from each", "[target position, limits]";
        } }
    };
}
pub(crate) use block_keys;

block_keys! { keys
    /// A block of a diagram.
    BLOCK = "a block" needs [Together(["type", "bit"])]
}

keys! {
    /// What a block takes from another.
    INFLOW = "what a block takes from another" {
        "block" required: Shape::NameOf(NameOf::Block), "name of the earlier block", "ramp generator";
        "carries": Shape::Words, "what comes from there; written at the arrow", "set-point";
    }
}

macro_rules! axis_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "marks" required: Shape::OneOrMore(&Shape::Map(&MARK)) => marks: Vec<Spanned<MarkDecl>>, "places on it, from the lowest value to the highest";
            "spans": Shape::OneOrMore(&Shape::Map(&SPAN)) => spans: Vec<Spanned<SpanDecl>>, "parts of it, from the top of the picture";
        } }
    };
}
pub(crate) use axis_keys;

axis_keys! { keys
    /// `axis:` of a table.
    AXIS = "an axis"
}

macro_rules! mark_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "mark" required: Shape::Words => name: Words, "what is there; the name by which spans refer to it", "target position";
            "entries": Shape::OneOrMore(&Shape::Entry) => entries: Vec<Name>, "entries whose value it is", "0x607A";
        } }
    };
}
pub(crate) use mark_keys;

mark_keys! { keys
    /// A mark on an axis.
    MARK = "a mark on an axis"
}

macro_rules! span_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "span" required: Shape::Words => name: Words, "what it is", "position window";
            "entries": Shape::OneOrMore(&Shape::Entry) => entries: Vec<Name>, "entries that determine its length, or that act there", "0x6067";
            "from": Shape::NameOf(NameOf::Mark) => from: Option<Name>, "mark where it begins; unless given, it has no beginning", "target position";
            "to": Shape::NameOf(NameOf::Mark) => to: Option<Name>, "mark where it ends; unless given, it has no end", "upper edge";
            "does": Shape::Words => does: Words, "what is true there", "the target counts as reached";
        } }
    };
}
pub(crate) use span_keys;

span_keys! { keys
    /// A span of an axis.
    SPAN = "a span of an axis" needs [Any(["from", "to"])]
}
