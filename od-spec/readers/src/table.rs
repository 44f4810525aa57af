//! Which findings are about what which readers refuse.

use od_spec::diag::Code;
use od_spec::diag::readers::Reader::{
    self, Caneds, CanopenEditor, CanopenHost, Codesys, Dcfchk, EdsUtils, NodeCanopen, PythonCanopen,
};

/// A reader that stumbles over what a code is about, and why.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Stumbling {
    /// Who.
    pub reader: Reader,
    /// Why, in a line.
    pub reason: &'static str,
}

/// Who stumbles over what a code is about: those that were run, which not every finding of the code brings to that, and those
/// of which it is reported.
pub fn stumbling(code: &Code) -> &'static [Stumbling] {
    let at = TABLE.binary_search_by_key(&code.id, |(id, _)| id);
    at.map_or(&[], |at| TABLE[at].1)
}

const fn by(reader: Reader, reason: &'static str) -> Stumbling {
    Stumbling { reader, reason }
}

/// By code.
const TABLE: &[(&str, &[Stumbling])] = &[
    (
        "EDS101",
        &[
            by(PythonCanopen, "it reads a file as UTF-8"),
            by(Dcfchk, "it reads a file as UTF-8"),
            by(EdsUtils, "it reads a file as UTF-8"),
            by(CanopenHost, "it reads a file as UTF-8"),
        ],
    ),
    (
        "EDS102",
        &[
            by(PythonCanopen, "the mark is before the first section"),
            by(Dcfchk, "the mark is before the first section"),
            by(EdsUtils, "the mark hides the first section name, where that is the first line"),
        ],
    ),
    (
        "EDS105",
        &[
            by(PythonCanopen, "it takes the line for a key without `=`"),
            by(Dcfchk, "it takes the line for a key without `=`"),
        ],
    ),
    (
        "EDS106",
        &[
            by(PythonCanopen, "an indented line belongs to the value above"),
            by(Dcfchk, "an indented line belongs to the value above"),
            by(EdsUtils, "it finds no name in the section"),
        ],
    ),
    (
        "EDS108",
        &[
            by(PythonCanopen, "it wants `=` in every line"),
            by(Dcfchk, "it wants `=` in every line"),
            by(EdsUtils, "it wants one `=` in every line"),
        ],
    ),
    (
        "EDS109",
        &[
            by(PythonCanopen, "it wants a section name first"),
            by(Dcfchk, "it wants a section name first"),
            by(EdsUtils, "it wants a section name in front of the first empty line"),
        ],
    ),
    (
        "EDS110",
        &[
            by(PythonCanopen, "it takes a second one for a fault"),
            by(Dcfchk, "it takes a second one for a fault"),
            by(EdsUtils, "it takes a second one for a fault"),
            by(NodeCanopen, "it takes an object that is written twice, in different case, for a fault"),
        ],
    ),
    (
        "EDS111",
        &[
            by(PythonCanopen, "it takes a second one for a fault"),
            by(Dcfchk, "it takes a second one for a fault"),
        ],
    ),
    (
        "EDS112",
        &[
            by(EdsUtils, "it takes the space for a part of key or value"),
            by(CanopenEditor, "an earlier libedssharp refused a space after `=`"),
        ],
    ),
    (
        "EDS113",
        &[
            by(Dcfchk, "it does not know such a key"),
            by(EdsUtils, "it finds no `SupportedObjects`"),
            by(Caneds, "it refused `Supported Objects`"),
        ],
    ),
    ("EDS114", &[by(EdsUtils, "it knows no comments among the keys of a section")]),
    ("EDS116", &[by(Dcfchk, "it refuses sections that it does not know")]),
    (
        "EDS117",
        &[
            by(Dcfchk, "it refuses keys that it does not know"),
            by(EdsUtils, "it takes every key of a list of objects for an entry"),
        ],
    ),
    ("EDS118", &[by(Dcfchk, "it refuses keys that it does not know")]),
    ("EDS119", &[by(Dcfchk, "it refuses keys that it does not know")]),
    (
        "EDS121",
        &[
            by(PythonCanopen, "the sub-index of a section that it passed over has no object"),
            by(Dcfchk, "it refuses sections that it does not know"),
        ],
    ),
    (
        "EDS122",
        &[
            by(PythonCanopen, "it knows keys in the standard's case only"),
            by(EdsUtils, "it knows `SupportedObjects` in this case only"),
            by(NodeCanopen, "it knows keys in the standard's case only"),
        ],
    ),
    (
        "EDS124",
        &[
            by(PythonCanopen, "it takes sections as they come"),
            by(EdsUtils, "it takes sections as they come"),
        ],
    ),
    (
        "EDS204",
        &[
            by(PythonCanopen, "it reads an empty number as a wrong one"),
            by(Dcfchk, "it reads numbers as Python does"),
        ],
    ),
    ("EDS205", &[by(PythonCanopen, "it reads an empty number as a wrong one")]),
    ("EDS206", &[by(PythonCanopen, "it wants a number"), by(Dcfchk, "it wants a number")]),
    (
        "EDS207",
        &[
            by(PythonCanopen, "it reads numbers as Python does, in which `010` is not a number"),
            by(Dcfchk, "it reads numbers as Python does, in which `010` is not a number"),
        ],
    ),
    ("EDS208", &[by(CanopenEditor, "it failed at a file version such as `1.0`")]),
    ("EDS214", &[by(PythonCanopen, "it reads an empty number as a wrong one")]),
    ("EDS216", &[by(Dcfchk, "it does not know `[DynamicChannels]`")]),
    ("EDS217", &[by(PythonCanopen, "it wants a decimal number"), by(Dcfchk, "it wants 0 or 1")]),
    ("EDS218", &[by(PythonCanopen, "it asks for all seven dummies")]),
    ("EDS219", &[by(Dcfchk, "it wants 0 or 1")]),
    ("EDS301", &[by(Dcfchk, "it wants all three lists of objects")]),
    (
        "EDS302",
        &[
            by(PythonCanopen, "it reads as many entries as are counted"),
            by(Dcfchk, "it compares the count with the entries"),
            by(EdsUtils, "it wants `SupportedObjects`"),
        ],
    ),
    (
        "EDS303",
        &[
            by(PythonCanopen, "it reads as many entries as are counted"),
            by(Dcfchk, "it numbers the entries 1, 2, 3"),
        ],
    ),
    ("EDS304", &[by(Dcfchk, "it wants the index of an object"), by(EdsUtils, "it wants a number")]),
    ("EDS306", &[by(Dcfchk, "it wants the section of every listed object")]),
    ("EDS307", &[by(Dcfchk, "it knows listed objects only: 1000h, 1018h and what PDOs map are among them")]),
    ("EDS308", &[by(Dcfchk, "it compares the index with the list")]),
    ("EDS309", &[by(Dcfchk, "it knows three mandatory objects")]),
    ("EDS310", &[by(Dcfchk, "it knows no data types as objects")]),
    (
        "EDS401",
        &[
            by(EdsUtils, "it knows VAR, ARRAY and RECORD only"),
            by(NodeCanopen, "it does not know the object type"),
        ],
    ),
    (
        "EDS402",
        &[
            by(PythonCanopen, "it wants a number"),
            by(Dcfchk, "it wants an ARRAY or RECORD where there are sub-indices"),
            by(EdsUtils, "it knows VAR, ARRAY and RECORD only"),
            by(NodeCanopen, "it does not know the object type, or takes the keys of another"),
            by(CanopenEditor, "it refused a sub-index of the type ARRAY"),
        ],
    ),
    (
        "EDS403",
        &[
            by(PythonCanopen, "it wants `DataType`"),
            by(Dcfchk, "it wants `DataType`"),
            by(NodeCanopen, "it wants `DataType`"),
        ],
    ),
    (
        "EDS404",
        &[
            by(PythonCanopen, "it wants a number"),
            by(Dcfchk, "it wants a number"),
            by(NodeCanopen, "it wants a number"),
            by(CanopenHost, "it wants a number"),
        ],
    ),
    (
        "EDS405",
        &[
            by(PythonCanopen, "it wants `AccessType`"),
            by(Dcfchk, "it wants `AccessType`"),
            by(CanopenHost, "it does not know an empty access type"),
        ],
    ),
    (
        "EDS406",
        &[
            by(Dcfchk, "it knows the six access types only"),
            by(CanopenHost, "it knows the six access types only"),
            by(CanopenEditor, "it refused an unknown access type"),
        ],
    ),
    ("EDS407", &[by(CanopenEditor, "it refused access types in upper case")]),
    (
        "EDS408",
        &[
            by(PythonCanopen, "it wants `ParameterName`"),
            by(Dcfchk, "it wants `ParameterName`"),
            by(NodeCanopen, "it wants `ParameterName`"),
        ],
    ),
    (
        "EDS409",
        &[
            by(PythonCanopen, "it finds no object for the sub-index"),
            by(Dcfchk, "it finds no object for the sub-index"),
            by(EdsUtils, "it finds no object for the sub-index"),
            by(NodeCanopen, "it finds no object for the sub-index"),
            by(CanopenEditor, "it refused a sub-index without its object"),
        ],
    ),
    (
        "EDS411",
        &[by(Dcfchk, "it knows sub-indices up to FEh"), by(NodeCanopen, "it knows sub-indices up to FFh")],
    ),
    ("EDS412", &[by(PythonCanopen, "it wants a number"), by(Dcfchk, "it wants a number")]),
    ("EDS413", &[by(Dcfchk, "it wants a number")]),
    (
        "EDS414",
        &[
            by(PythonCanopen, "it looks for the compact array"),
            by(Dcfchk, "it looks for the compact array and its elements"),
        ],
    ),
    ("EDS415", &[by(CanopenEditor, "it could not read `[MxSubExtxxxx]`")]),
    (
        "EDS420",
        &[by(Dcfchk, "it wants no access type there"), by(NodeCanopen, "it wants none of these keys there")],
    ),
    (
        "EDS421",
        &[
            by(Dcfchk, "it wants an ARRAY or RECORD where there are sub-indices"),
            by(EdsUtils, "it wants an ARRAY or RECORD where there are sub-indices"),
            by(NodeCanopen, "it wants an ARRAY or RECORD where there are sub-indices"),
        ],
    ),
    ("EDS422", &[by(Dcfchk, "it wants one of the two counts")]),
    ("EDS423", &[by(Dcfchk, "it then takes the object for a single value")]),
    ("EDS424", &[by(Dcfchk, "it counts the sub-indices")]),
    (
        "EDS501",
        &[
            by(PythonCanopen, "it wants numbers in such keys"),
            by(Dcfchk, "it wants a number, a REAL as its bit pattern"),
            by(NodeCanopen, "it wants a plain number in 64 bits"),
            by(CanopenHost, "it wants plain numbers and `$NODEID`"),
        ],
    ),
    (
        "EDS502",
        &[
            by(PythonCanopen, "it reads numbers as Python does, in which `010` is not a number"),
            by(Dcfchk, "it reads numbers as Python does, in which `010` is not a number"),
        ],
    ),
    (
        "EDS503",
        &[
            by(Dcfchk, "it takes the bits for a positive number, which is too large"),
            by(NodeCanopen, "it takes the bits for a positive number, which is too large"),
        ],
    ),
    ("EDS504", &[by(Dcfchk, "it wants `$NODEID` in front")]),
    (
        "EDS505",
        &[
            by(Dcfchk, "it cannot read the formula"),
            by(NodeCanopen, "it knows no formula in 64 bits"),
            by(CanopenHost, "it cannot read the formula"),
        ],
    ),
    ("EDS506", &[by(Dcfchk, "it wants a number"), by(CanopenHost, "it wants a number")]),
    (
        "EDS507",
        &[
            by(Dcfchk, "it wants a number with nothing around it"),
            by(NodeCanopen, "it wants a plain number in 64 bits"),
            by(CanopenHost, "it wants a number with nothing around it"),
            by(CanopenEditor, "it failed at `0.0` for an integer"),
        ],
    ),
    (
        "EDS508",
        &[
            by(PythonCanopen, "it cuts off remarks after ` ;` only"),
            by(Dcfchk, "it cuts off remarks after a space only"),
            by(EdsUtils, "it wants one `=` in every line"),
            by(CanopenHost, "it knows no remarks"),
        ],
    ),
    ("EDS509", &[by(CanopenHost, "it reads REAL in decimal only")]),
    (
        "EDS513",
        &[
            by(Dcfchk, "it wants no limits there, or finds them too large"),
            by(NodeCanopen, "it compares the limits, whatever the type"),
        ],
    ),
    ("EDS702", &[by(Dcfchk, "it refuses sections that it does not know")]),
    ("EDS808", &[by(Codesys, "it maps rwr and ro to TPDOs, rww and wo to RPDOs")]),
    (
        "OD0204",
        &[by(Dcfchk, "the value does not fit its type"), by(NodeCanopen, "the value does not fit its type")],
    ),
    ("OD0310", &[by(Dcfchk, "it looks for what PDOs map"), by(EdsUtils, "it looks for what PDOs map")]),
    ("OD0315", &[by(EdsUtils, "it wants all elements of an ARRAY of one type")]),
    ("OD0318", &[by(EdsUtils, "it wants one `=` in every line")]),
    ("OD0319", &[by(EdsUtils, "it wants one `=` in every line")]),
    ("OD0322", &[by(Dcfchk, "it wants the mapping of every PDO")]),
    (
        "OD0401",
        &[by(Dcfchk, "the value does not fit its type"), by(NodeCanopen, "the value does not fit its type")],
    ),
    (
        "OD0404",
        &[by(Dcfchk, "the value does not fit its type"), by(NodeCanopen, "the value does not fit its type")],
    ),
    ("OD0406", &[by(Dcfchk, "it compares values with limits")]),
    ("OD0407", &[by(Dcfchk, "it compares values with limits"), by(NodeCanopen, "it compares the limits")]),
    ("OD0502", &[by(Dcfchk, "it looks for what PDOs map")]),
    ("OD0506", &[by(EdsUtils, "it looks for what PDOs map, also for dummies")]),
    ("OD0801", &[by(Dcfchk, "it wants 1000h and 1018h")]),
    (
        "OD0807",
        &[
            by(Dcfchk, "it reads REAL as a bit pattern only"),
            by(CanopenHost, "it reads REAL in decimal only"),
        ],
    ),
];

#[cfg(test)]
mod tests {
    use super::*;
    use od_spec::code;

    #[test]
    fn codes_are_known_and_in_order() {
        assert!(TABLE.is_sorted_by(|(one, _), (next, _)| one < next));
        for (id, readers) in TABLE {
            assert!(code(id).is_some(), "{id} is not a code");
            assert!(readers.is_sorted_by(|one, next| one.reader < next.reader), "{id}");
        }
    }
}
