//! An object with sub-indices leaves type, access and value to them.

use super::super::object_form::{Form, form};
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS420",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a value of an object that has sub-indices",
    explanation: "An ARRAY or RECORD has no value of its own: data type, access, default value, limits and PDO mapping \
        belong to its sub-indices. At the object most readers ignore them, some use them for the sub-indices that say \
        nothing, and lely's dcfchk refuses `AccessType`. Only an object with `CompactSubObj` says them for its \
        elements.",
    clause: Some("CiA 306 4.6.3.2"),
    example: Some(Example::eds(
        "[2000]\nParameterName=levels\nObjectType=0x8\nSubNumber=2\nAccessType=ro\n\n[2000sub0]\nParameterName=highest\nDataType=0x0005\nAccessType=const\nDefaultValue=1\n\n[2000sub1]\nParameterName=level\nDataType=0x0005\nAccessType=ro",
        "[2000]\nParameterName=levels\nObjectType=0x8\nSubNumber=2\n\n[2000sub0]\nParameterName=highest\nDataType=0x0005\nAccessType=const\nDefaultValue=1\n\n[2000sub1]\nParameterName=level\nDataType=0x0005\nAccessType=ro",
    )),
};

const KEYS: [&str; 6] = ["DataType", "AccessType", "DefaultValue", "LowLimit", "HighLimit", "PDOMapping"];

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (index, object) in &view.objects {
        let Some(part) = object.object.as_ref().filter(|_| form(object) == Some(Form::Structured)) else {
            continue;
        };
        // `PDOMapping=0` says what is so anyway.
        let said = |key: &&str| part.value(key).filter(|value| *key != "PDOMapping" || value.value != "0");
        let Some((key, value)) = KEYS.iter().find_map(|key| Some((key, said(key)?))) else { continue };
        found.add(value.span, [], || {
            Diagnostic::new(
                CODE,
                value.span,
                format!("{index} has sub-indices and says `{key}` all the same"),
            )
            .help("say it at the sub-indices only")
        });
    }
    found.finish("objects", diagnostics);
}
