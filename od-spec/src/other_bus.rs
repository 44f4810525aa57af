//! Files of other fieldbuses, which are named like those of CANopen.

use crate::diag::{Diagnostic, codes};
use crate::{eds, xdd};

/// Sections that an EDS of ODVA has and one of CANopen has not, and the other way round.
const ODVA: [&str; 2] = ["File", "Device"];
const CANOPEN: [&str; 2] = ["FileInfo", "DeviceInfo"];

/// A message about a text that is named as an EDS, DCF, XDD or XDC and is something else.
pub(crate) fn refusal(name: &str, text: &str) -> Option<Box<Diagnostic>> {
    let (what, help) = if eds::has_eds_name(name) { other_eds(text)? } else { other_xml(name, text)? };
    let message = format!("`{name}` is {what}");
    Some(Box::new(Diagnostic::without_place(codes::OTHER_BUS, message).help(help)))
}

fn other_eds(text: &str) -> Option<(&'static str, &'static str)> {
    let sections: Vec<&str> = text
        .lines()
        .filter_map(|line| line.trim().strip_prefix('[')?.split(']').next())
        .map(str::trim)
        .collect();
    let has = |names: [&str; 2]| {
        names.map(|name| sections.iter().any(|section| section.eq_ignore_ascii_case(name)))
    };
    if has(ODVA) == [true, true] && has(CANOPEN) == [false, false] {
        let what = "an EDS of EtherNet/IP or DeviceNet ([File], [Device]), not of CANopen";
        return Some((what, "ask the maker for the EDS of the CANopen interface"));
    }
    if sections.iter().any(|section| section.replace([' ', '_'], "").eq_ignore_ascii_case("CANopenFD")) {
        let what = "an EDS of CANopen FD ([CANopenFD])";
        return Some((what, "only classical CANopen is read, whose PDOs hold 8 bytes"));
    }
    let is_none = sections.is_empty() && !text.contains('=');
    is_none.then_some(("no EDS or DCF: it has no section", "is this the right file?"))
}

fn other_xml(name: &str, text: &str) -> Option<(&'static str, &'static str)> {
    let is_powerlink = xdd::has_xdd_name(name) && text.contains("ProfileBody_CommunicationNetwork_Powerlink");
    is_powerlink.then_some((
        "an XDD of POWERLINK, not of CANopen",
        "ask the maker for the EDS or XDD of the CANopen interface",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_others_are_named() {
        let odva = "$ adapter\n[File]\n  DescText = \"Adapter\";\n[Device]\n  VendCode = 9999;\n";
        let fd = "[FileInfo]\nFileName=a.eds\n[CANopenFD]\nDataBitRate=5000000\n";
        let powerlink = "<ProfileBody xsi:type=\"ProfileBody_CommunicationNetwork_Powerlink\"/>";
        for (name, text, word) in [
            ("a.eds", odva, "EtherNet/IP"),
            ("a.EDS", fd, "CANopen FD"),
            ("a.eds", "??", "no section"),
            ("a.dcf", "", "no section"),
            ("a.xdd", powerlink, "POWERLINK"),
        ] {
            let refused = refusal(name, text).unwrap_or_else(|| panic!("{name}: {text}"));
            assert!(refused.message.contains(word), "{}", refused.message);
        }
    }

    #[test]
    fn files_of_canopen_are_none_of_them() {
        let ours = "[FileInfo]\nFileName=a.eds\n[DeviceInfo]\nVendorName=A\n";
        for (name, text) in
            [("a.eds", ours), ("a.eds", "[File]\na=1\n"), ("a.xdd", "<a/>"), ("a.eds", "Lines=0\n")]
        {
            assert!(refusal(name, text).is_none(), "{name}: {text}");
        }
    }
}
