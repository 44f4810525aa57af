//! Arrays that describe one set of channels or programs have an element for each.

use crate::check::device::channels_are_in_the_device_type::KINDS;
use crate::check::device::device_type_is_kept::{IO_MODULES, axes};
use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Index, Object};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0888",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "arrays of one thing that differ in length",
    explanation: "Element 2 of a polarity, a filter or an error value belongs to element 2 of the inputs or outputs, \
        and element 2 of 1F51h to program 2 of 1F50h. Where a describing array is longer than what it describes, its \
        last elements act on nothing; where error mode and error value of outputs differ, some outputs have only half \
        of their reaction to an error. Give the arrays one length.",
    clause: Some("CiA 401, objects 6000h to 6450h; CiA 302, objects 1F50h to 1F57h"),
    example: Some(Example::new(
        "uses: [cia301, cia302]\nobjects:\n  0x1F50: {from: cia302, array: {count: 2}}\n  0x1F51: {from: cia302, array: {count: 1}}",
        "uses: [cia301, cia302]\nobjects:\n  0x1F50: {from: cia302, array: {count: 2}}\n  0x1F51: {from: cia302, array: {count: 2}}",
    )),
};

/// Objects with channels or programs, and those that describe them.
const DESCRIBED: [(&[u16], &[u16]); 9] = [
    (&[0x1F50], &[0x1F51, 0x1F56, 0x1F57]),
    (&[0x6000], &[0x6002, 0x6003, 0x6006, 0x6007, 0x6008]),
    (&[0x6100], &[0x6102, 0x6103, 0x6106, 0x6107, 0x6108]),
    (&[0x6120], &[0x6122, 0x6123, 0x6126, 0x6127, 0x6128]),
    (&[0x6200], &[0x6202, 0x6206, 0x6207, 0x6208]),
    (&[0x6300], &[0x6302, 0x6306, 0x6307, 0x6308]),
    (&[0x6320], &[0x6322, 0x6326, 0x6327, 0x6328]),
    (
        &[0x6400, 0x6401, 0x6402, 0x6403, 0x6404],
        &[0x6421, 0x6424, 0x6425, 0x6426, 0x6427, 0x6428, 0x6430, 0x6431, 0x6432],
    ),
    (&[0x6410, 0x6411, 0x6412, 0x6413, 0x6414], &[0x6443, 0x6444, 0x6446, 0x6447, 0x6450]),
];
/// Objects that mean something only together, element by element.
const PAIRS: [(u16, u16); 5] =
    [(0x1F50, 0x1F51), (0x6206, 0x6207), (0x6306, 0x6307), (0x6326, 0x6327), (0x6443, 0x6444)];

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    // In a drive, some of these are objects of its motor.
    let is_io_module = axes(subject, IO_MODULES).contains(&Index(0x6000));
    let has_modules = subject.device.further.as_ref().is_some_and(|further| !further.modules.is_empty());
    let has = |index: Index| subject.device.objects.contains_key(&index);
    let array = |index: &u16| {
        let index = Index(*index);
        let is_described = index.is_communication_profile() || is_io_module;
        let object = subject.device.objects.get(&index)?;
        (is_described && object.is_structured() && !subject.device.is_of_modules(index)).then_some(object)
    };
    let mut differ = |object: &Object, other: Index, length: usize| {
        let own = match length_of(object) {
            1 => "1 element".to_owned(),
            count => format!("{count} elements"),
        };
        let message = format!("{} ({}) has {own}, {other} has {length}", object.index, object.name);
        findings.push(subject.object_finding(CODE, object, message).help("give both one length"));
    };
    for (described, describing) in DESCRIBED {
        let longest = described.iter().filter_map(array).max_by_key(|object| length_of(object));
        let (other, length) = match longest {
            Some(longest) => (longest.index, length_of(longest)),
            // Channels may be there in another length; without any, these elements describe nothing.
            None => match KINDS.iter().find(|(_, objects)| objects.contains(&described[0])) {
                Some((_, objects)) if !has_modules && !objects.iter().any(|index| has(Index(*index))) => {
                    (Index(described[0]), 0)
                }
                Some(_) | None => continue,
            },
        };
        for object in describing.iter().filter_map(array).filter(|object| length_of(object) > length) {
            differ(object, other, length);
        }
    }
    for (one, other) in PAIRS {
        if let (Some(one), Some(other)) = (array(&one), array(&other))
            && length_of(one) != length_of(other)
        {
            differ(other, one.index, length_of(one));
        }
    }
}

fn length_of(object: &Object) -> usize {
    object.counted().count()
}
