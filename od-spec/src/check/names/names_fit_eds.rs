//! Names can be written into an EDS that every tool reads alike.

use crate::ascii::{has_no_form, in_ascii, transliterate};
use crate::check::findings::Findings;
use crate::check::names::texts_fit_eds::unfit;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{About, Code, Diagnostic, Example, Severity, shorten};
use crate::model::{Dictionary, EntryId, Fact, SystemSource};
use crate::source::Span;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "OD0318",
    severity: Severity::Error,
    foreign: Severity::Note,
    title: "a text that an EDS cannot hold",
    explanation: "An EDS line has at most 255 characters, which leaves 241 for a name. `;`, `#` and `=` in names and texts are read as comments or keys by \
        several PLC tools, so they are refused. Characters outside ASCII are transliterated; a name that has none left is refused, too. What \
        readers see would otherwise depend on the reader. Choose another name or text.",
    clause: Some("CiA 306, 4.2 and 4.6.3.2"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: speed = 0, type: unsigned8, access: ro}",
        "objects:\n  0x2000: {name: speed is 0, type: unsigned8, access: ro}",
    )),
};

/// Longest `ParameterName` (CiA 306 4.6.3.2).
const LONGEST: usize = 241;

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    check_header(subject.system.source, subject.device, findings);
    check_vendor(subject, findings);
    for object in subject.device.objects.values() {
        check_name(&object.name, subject.object_place(object), (object.index, Fact::Name).into(), findings);
        for entry in object.entries.iter().filter(|_| object.is_structured()) {
            let id = EntryId { index: object.index, sub: entry.sub };
            check_name(&entry.name, subject.place(entry, Fact::Name), (id, Fact::Name).into(), findings);
        }
    }
}

/// The vendor's name is in every EDS.
fn check_vendor(subject: &Subject<'_>, findings: &mut Findings) {
    let vendor = &subject.system.vendor;
    let Some(place) = vendor.name_span else { return };
    if transliterate(&vendor.name).len() > 244 || vendor.name.chars().any(|c| unfit(c).is_some()) {
        findings.push(
            Diagnostic::new(CODE, place, "the vendor's name does not fit an EDS")
                .help("at most 244 characters, without `;`, `#` and `=`"),
        );
    }
}

/// A text of the EDS's header, and how long it may be.
struct HeaderText<'a> {
    key: HeaderKey,
    text: &'a str,
    longest: usize,
}

/// What a text of the header is called.
struct HeaderKey {
    specification: &'static str,
    eds: &'static str,
}

impl HeaderKey {
    const fn word(&self, source: SystemSource) -> &'static str {
        match source {
            SystemSource::Specification => self.specification,
            SystemSource::Eds => self.eds,
        }
    }
}

/// Texts of `[FileInfo]` and `[DeviceInfo]` with the length that CiA 306 4.4 and 4.5 give them.
fn check_header(source: SystemSource, device: &Dictionary, findings: &mut Findings) {
    let header = |specification, eds, text, longest| {
        let key = HeaderKey { specification, eds };
        HeaderText { key, text, longest }
    };
    let texts = [
        header("description", "Description", &device.file.description, 243),
        header("created-by", "CreatedBy", &device.file.created_by, 245),
        header("modified-by", "ModifiedBy", &device.file.modified_by, 244),
        header("product-name", "ProductName", &device.info.product_name, 243),
        header("order-code", "OrderCode", &device.info.order_code, 245),
    ];
    for (at, HeaderText { key, text, longest }) in texts.iter().enumerate() {
        // One is taken from the other.
        if texts[..at].iter().any(|before| before.text == *text) {
            continue;
        }
        let length = transliterate(text).len();
        let problem = if length > *longest {
            format!("has {length} characters, an EDS holds {longest}")
        } else if let Some(unfit) = text.chars().find_map(unfit) {
            format!("holds {unfit}, which EDS readers misread")
        } else {
            continue;
        };
        let message = format!("`{}` of device `{}` {problem}", key.word(source), device.key);
        findings.push(Diagnostic::new(CODE, device.span, message).help("choose another text"));
    }
}

fn check_name(name: &str, place: Span, about: About, findings: &mut Findings) {
    let written = in_ascii(name);
    let problem = if written.len() > LONGEST {
        let length = name.chars().count();
        format!("the name `{}` has {length} characters, an EDS holds {LONGEST}", shorten(name))
    } else if has_no_form(name) {
        "no character of the name has a form in ASCII".to_owned()
    } else if let Some(unfit) = name.chars().find_map(unfit) {
        format!("the name `{}` holds {unfit}, which EDS readers misread", shorten(name))
    } else {
        return;
    };
    findings.push(Diagnostic::new(CODE, place, problem).about(about).help("choose another name"));
}
