//! A changelog entry in Markdown.

use std::fmt::Write as _;

use od_spec::visible::visible;

use super::super::{Advice, Change, Class, DeviceDifference, Difference, Proposal};
use super::line::{Style, line};

const STYLE: Style = Style { arrow: "→", longest: Some(120) };

/// What a release of a device says about its changes: by class, the heaviest first. Each change is under its heaviest
/// consequence; documents are summed up.
pub(super) fn entry(difference: &Difference, device: &DeviceDifference) -> String {
    let mut text = format!("### {}{}\n", escape(&device.name), version(device));
    let all: Vec<&Change> = difference.system.iter().chain(&device.changes).collect();
    for class in Class::ALL.iter().rev() {
        let of_class: Vec<_> = all.iter().filter(|change| change.class() == *class).collect();
        if of_class.is_empty() {
            continue;
        }
        let _ = writeln!(text, "\n**{}**\n", heading(*class));
        if *class == Class::Documents {
            let _ = writeln!(
                text,
                "- {}",
                super::counted(of_class.len(), "description", "descriptions and remarks")
            );
            continue;
        }
        for change in of_class {
            let line = line(change, STYLE);
            let (sign, rest) = line.split_at(2);
            let verb = match sign {
                "+ " => "new: ",
                "- " => "removed: ",
                _ => "",
            };
            let _ = writeln!(text, "- {verb}{}", escape(rest));
        }
    }
    text
}

const fn heading(class: Class) -> &'static str {
    match class {
        Class::Plc => "Breaks PLC projects",
        Class::Stored => "Stored parameters are lost",
        Class::Firmware => "Firmware has to be adapted",
        Class::Behaviour => "Behaviour",
        Class::Addition => "Added",
        Class::Documents => "Documents",
    }
}

/// The numbers that the release has, or should have.
fn version(device: &DeviceDifference) -> String {
    let number = |proposal: Proposal| match proposal.advice {
        Advice::Raise(to) | Advice::RaiseFirst(to) => to,
        Advice::Keep | Advice::Raised | Advice::UsedUp => proposal.new,
    };
    let (file, revision) = (number(device.proposals.file), number(device.proposals.revision));
    format!(": EDS {}.{}, revision {}.{}", file.0, file.1, revision.0, revision.1)
}

/// Text in which nothing is Markdown.
pub(super) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    let one_line: String = text.chars().map(|c| if c.is_whitespace() { ' ' } else { c }).collect();
    for character in visible(&one_line).chars() {
        if matches!(character, '|' | '*' | '_' | '<' | '[' | ']' | '\\' | '#') {
            escaped.push('\\');
        }
        escaped.push(character);
    }
    escaped
}
