//! Names keep their characters in an EDS.

use crate::ascii::{has_lost, has_no_form, in_ascii};
use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{About, Code, Diagnostic, Example, Repeated, Severity, shorten};
use crate::model::{EntryId, Fact, SystemSource};
use crate::source::Span;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

/// The code of the rule.
pub(crate) const CODE: &Code = &Code {
    id: "OD0846",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "an EDS loses characters of a name",
    explanation: "An EDS is ASCII. Letters of European languages and of Russian are transcribed; other characters become `?`, and an object or \
        entry of which nothing else would remain is called by its number. Two names can then look alike in a PLC tool. Choose names of letters \
        that ASCII has or that are transcribed; the name for people can go into `about`.",
    clause: Some("CiA 306, 4.2"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: speed 速度, type: unsigned8, access: ro}",
        "objects:\n  0x2000: {name: speed, about: 速度, type: unsigned8, access: ro}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let mut found = Repeated::new();
    let vendor = &subject.system.vendor;
    for (text, place) in [
        (&vendor.name, vendor.name_span.unwrap_or(subject.device.span)),
        (&subject.device.info.product_name, subject.device.span),
    ] {
        if has_lost(text) {
            found.add(place, [], || said(text, &in_ascii(text), place));
        }
    }
    let mut add = |name: &str, in_eds: &str, place: Span, about: About| {
        // In a specification, a name without any form is refused.
        let is_refused = subject.system.source == SystemSource::Specification && has_no_form(name);
        if has_lost(name) && !is_refused {
            found.add(place, [], || said(name, in_eds, place).about(about));
        }
    };
    for object in subject.device.objects.values() {
        let about = (object.index, Fact::Name).into();
        add(&object.name, &object.eds_name(), subject.object_place(object), about);
        for entry in object.entries.iter().filter(|_| object.is_structured()) {
            let id = EntryId { index: object.index, sub: entry.sub };
            let place = subject.place(entry, Fact::Name);
            add(&entry.name, &object.eds_name_of(entry), place, (id, Fact::Name).into());
        }
    }
    if let Some(finding) = found.into_diagnostic("names") {
        findings.push(finding);
    }
}

fn said(name: &str, written: &str, place: Span) -> Diagnostic {
    let message = format!("an EDS calls `{}` `{}`", shorten(name), shorten(written));
    Diagnostic::new(CODE, place, message).help("choose a name with a form in ASCII")
}
