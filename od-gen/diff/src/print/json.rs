//! For programs; the format is described in `docs/book/formats/json.md`.

use od_spec::model::Fact;
use serde_json::{Value as Json, json};

use super::super::words::fact;
use super::super::{Advice, Change, Class, Difference, Parts, Place, Proposal, Scope, Unknown};
use super::changelog;

/// Version of the format; raised when a consumer would have to change.
const FORMAT: u32 = 1;

/// The difference as JSON, ends with a line break.
pub fn json(difference: &Difference) -> String {
    let devices: Vec<Json> = difference
        .devices
        .iter()
        .map(|device| {
            json!({
                "key": device.key,
                "name": device.name,
                "changes": device.changes.iter().map(change).collect::<Vec<_>>(),
                "unknown": device.unknown.iter().map(|one| unknown(*one)).collect::<Vec<_>>(),
                "proposals": {
                    "file": proposal(device.proposals.file, ["version", "revision"]),
                    "revision-number": proposal(device.proposals.revision, ["major", "minor"]),
                },
                "changelog": changelog::entry(difference, device),
            })
        })
        .collect();
    let whole = json!({
        "od-diff": FORMAT,
        "scope": scope(difference.scope),
        "class": difference.class().map(Class::word),
        "system": difference.system.iter().map(change).collect::<Vec<_>>(),
        "devices": devices,
    });
    format!("{whole:#}\n")
}

fn change(change: &Change) -> Json {
    let consequences: Vec<Json> = change
        .consequences
        .iter()
        .map(|one| json!({"class": one.class.word(), "because": one.because}))
        .collect();
    json!({
        "kind": change.kind().word(),
        "place": place(&change.place),
        "name": change.name,
        "part": change.part,
        "fact": if change.fact == Fact::Presence { "presence" } else { fact(change.fact) },
        "before": change.before,
        "after": change.after,
        "consequences": consequences,
    })
}

fn place(place: &Place) -> Json {
    match place {
        Place::System => json!({"of": "system"}),
        Place::Device => json!({"of": "device"}),
        Place::Object(index) => json!({"of": "object", "index": index.notation()}),
        Place::Entries { index, first, last } => {
            json!({"of": "entries", "index": index.notation(), "first": first.0, "last": last.0})
        }
        Place::Unit(name) => json!({"of": "unit", "name": name}),
        Place::Type(name) => json!({"of": "type", "name": name}),
        Place::Error(code) => json!({"of": "error", "code": format!("0x{code:04X}")}),
        Place::Machine(name) => json!({"of": "state-machine", "name": name}),
        Place::Constraint(name) => json!({"of": "constraint", "name": name}),
    }
}

fn proposal(proposal: Proposal, [first, second]: [&str; 2]) -> Json {
    let parts = |parts: Parts| json!({first: parts.0, second: parts.1});
    let (advice, to) = match proposal.advice {
        Advice::Keep => ("keep", None),
        Advice::Raised => ("raised", None),
        Advice::Raise(to) | Advice::RaiseFirst(to) => ("raise", Some(to)),
        Advice::UsedUp => ("used-up", None),
    };
    json!({"old": parts(proposal.old), "new": parts(proposal.new), "advice": advice, "proposed": to.map(parts)})
}

const fn scope(scope: Scope) -> &'static str {
    match scope {
        Scope::Everything => "everything",
        Scope::WhatAnEdsStates => "eds",
        Scope::WhatADcfStates => "dcf",
    }
}

const fn unknown(unknown: Unknown) -> &'static str {
    match unknown {
        Unknown::Firmware => "firmware",
        Unknown::Stored => "stored",
    }
}
