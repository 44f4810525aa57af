//! The serial number of the node is that of its identity.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::Topic;
use crate::eds::number::lenient_integer;
use crate::eds::view::View;
use crate::model::Index;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS707",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "two serial numbers of one node",
    explanation: "`LSS_SerialNumber` is the serial number by which the node is found before it has a node-ID; object 1018h \
        sub-index 4 is the one that the device reports. Where they differ, the node is not found.",
    clause: Some("CiA 306 5.3"),
    example: Some(Example::dcf(
        "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=2\n\n[1018sub0]\nParameterName=highest\nDataType=0x0005\nAccessType=const\nDefaultValue=4\n\n[1018sub4]\nParameterName=Serial number\nDataType=0x0007\nAccessType=ro\nParameterValue=0x11\n\n[DeviceComissioning]\nNodeID=1\nBaudrate=125\nLSS_SerialNumber=0x10",
        "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=2\n\n[1018sub0]\nParameterName=highest\nDataType=0x0005\nAccessType=const\nDefaultValue=4\n\n[1018sub4]\nParameterName=Serial number\nDataType=0x0007\nAccessType=ro\nParameterValue=0x10\n\n[DeviceComissioning]\nNodeID=1\nBaudrate=125\nLSS_SerialNumber=0x10",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(node) = view.section(Topic::Commissioning).and_then(|part| part.value("LSS_SerialNumber"))
    else {
        return;
    };
    let identity = view.objects.get(&Index(0x1018)).and_then(|identity| identity.subs.get(&4));
    let Some(reported) =
        identity.and_then(|part| part.value("ParameterValue").or_else(|| part.value("DefaultValue")))
    else {
        return;
    };
    let (Some(one), Some(other)) = (lenient_integer(node.value), lenient_integer(reported.value)) else {
        return;
    };
    // 0 means that it is not known.
    if one != other && one != 0 && other != 0 {
        let message = format!("the serial number of the node is {one:#X}, that of its identity {other:#X}");
        diagnostics.push(
            Diagnostic::new(CODE, node.span, message)
                .label("of the node")
                .with(reported.span, "of the identity")
                .help("correct one of the two"),
        );
    }
}
