//! The list of mandatory objects names 1000h, 1001h and 1018h.

use super::super::numbered;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::names::List;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS309",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "further objects among the mandatory ones",
    explanation: "1000h, 1001h and 1018h are the mandatory objects of CANopen, and for lely's dcfchk nothing else can be one. The \
        standard does not forbid to list the mandatory objects of a device profile there as well; tools that check the \
        list by name refuse them. They are safe in `[OptionalObjects]`.",
    clause: Some("CiA 306 4.6.3.1"),
    example: Some(Example::eds(
        "[MandatoryObjects]\nSupportedObjects=1\n1=0x1005\n\n[OptionalObjects]\nSupportedObjects=0\n\n[1005]\nParameterName=COB-ID SYNC message\nObjectType=0x7\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x80",
        "[MandatoryObjects]\nSupportedObjects=0\n\n[OptionalObjects]\nSupportedObjects=1\n1=0x1005\n\n[1005]\nParameterName=COB-ID SYNC message\nObjectType=0x7\nDataType=0x0007\nAccessType=rw\nDefaultValue=0x80",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    let lists = numbered::of_objects(view);
    let mandatory = lists.iter().filter(|(list, _)| *list == List::Mandatory);
    for (_, entry) in mandatory.flat_map(|(_, list)| &list.entries) {
        let Some(index) = numbered::index(entry) else { continue };
        if index.0 >= 0x1000 && List::of(index) == List::Optional {
            found.add(entry.value.span, [], || {
                Diagnostic::new(CODE, entry.value.span, format!("{index} is listed as mandatory"))
                    .help("list it in `[OptionalObjects]`")
            });
        }
    }
    found.finish("objects", diagnostics);
}
