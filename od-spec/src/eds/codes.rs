//! What reading an EDS or DCF can say about its objects and values. The code of a rule over the text alone is with the
//! rule.

pub use super::check::{LINKS_OF_NOTHING, NO_INDEX, SETTINGS_IN_EDS, UNKNOWN_MODULE};
use crate::diag::{Code, Severity};

macro_rules! codes {
    ($($name:ident $severity:ident $foreign:ident $id:literal $clause:literal $title:literal: $explanation:literal)+) => {
        /// Every code; which of them other crates see is listed below.
        #[allow(unreachable_pub, reason = "the list below says which are public")]
        mod every {
            use super::*;

            $(
                #[doc = $title]
                pub const $name: &Code = &Code {
                    id: $id,
                    severity: Severity::$severity,
                    foreign: Severity::$foreign,
                    title: $title,
                    explanation: $explanation,
                    clause: Some($clause),
                    example: None,
                };
            )+
        }

        pub(crate) use every::*;

        /// All of them, ascending.
        pub(crate) const ALL: &[&Code] = &[$($name,)+];
    };
}

codes! {
    OBJECT_LEFT_OUT Warning Note "EDS401" "CiA 306 4.6.3.2" "an object that is not an entry of the dictionary":
        "Data types described as objects (DEFTYPE, DEFSTRUCT, indices below 1000h) and reserved object types are not among the objects that can be read and written. They are left out of the dictionary."
    BAD_OBJECT_TYPE Error Error "EDS402" "CiA 306 4.6.3.2" "an object type that does not fit":
        "`ObjectType` is a number: 0x2 (DOMAIN), 0x7 (VAR), 0x8 (ARRAY) or 0x9 (RECORD). A sub-index is a VAR or a DOMAIN, and only ARRAY and RECORD have sub-indices. A name such as `RECORD` is read as its number, which `odgen fix` writes. Where the sections describe something else than the key says, the sections count."
    MISSING_DATA_TYPE Error Error "EDS403" "CiA 306 4.6.3.2" "an entry without a data type":
        "Every VAR, every sub-index and every compact array needs `DataType`. Without it the number of bytes is unknown, and several readers stop here. An entry whose type CiA 301 defines has that type, which `odgen fix` writes: 1017h is UNSIGNED16, sub-index 0 of every ARRAY and RECORD UNSIGNED8. Any other entry is taken as a DOMAIN, a block of unknown length."
    UNKNOWN_DATA_TYPE Error Error "EDS404" "CiA 301 7.4.1" "an unknown data type":
        "`DataType` is the index of one of the data types of CiA 301, such as 0x0007 for UNSIGNED32. A name that leaves no doubt (`UNSIGNED32`, `U32`) is read as its index, which `odgen fix` writes; `INT` and `UINT` have 16 bits in a PLC and 32 in C. Otherwise the entry has the type that CiA 301 defines for it, or is taken as a DOMAIN, a block of unknown length."
    MISSING_ACCESS Error Error "EDS405" "CiA 306 4.6.3.2" "an entry without an access type":
        "Every entry needs `AccessType`; only for a DOMAIN the standard says what is meant without it: rw. Nothing states whether the entry may be written, so it is taken as read-only until an access type is written."
    UNKNOWN_ACCESS Error Error "EDS406" "CiA 306 4.6.3.2" "an unknown access type":
        "The access types are `ro`, `wo`, `rw`, `rwr`, `rww` and `const`. Other words that leave no doubt (`R/W`, `readOnly`, `W`) are read as what they say, and `odgen fix` writes the access type; everything else is taken as read-only."
    ACCESS_SPELLING Warning Note "EDS407" "CiA 306 4.6.3.2" "an access type in other letters":
        "The access types are written `ro`, `wo`, `rw`, `rwr`, `rww` and `const`, in lower case. Some readers compare letter by letter, and do not know `RW`."
    MISSING_NAME Error Warning "EDS408" "CiA 306 4.6.3.2" "an object or entry without a name":
        "`ParameterName` is needed everywhere: PLC tools show it, and many make variables of it. The index takes its place."
    NO_PARENT Error Error "EDS409" "CiA 306 4.6.3.2" "a sub-index without its object":
        "There is a section for a sub-index, and none for the object. Readers that take objects first stop here or lose the sub-index. The object is made up from its sub-indices."
    NO_SUB_0 Error Warning "EDS410" "CiA 301 7.4.7.2" "a structured object without sub-index 0":
        "Sub-index 0 of an ARRAY or RECORD says which sub-index is the highest. It is made up: UNSIGNED8, read-only, with the highest sub-index that is described."
    BAD_SUB_INDEX Error Error "EDS411" "CiA 306 4.6.3.2" "a sub-index that no entry can have":
        "Sub-indices are written in hexadecimal, from 1 to FE; FFh is reserved for the structure of the object. The section is left out."
    BAD_FLAG Error Error "EDS412" "CiA 306 4.6.3.2" "a key that is neither 0 nor 1":
        "`PDOMapping` is 0 or 1, `ObjFlags` a number whose bits 0 and 1 have a meaning. `yes` and `no` are read as 1 and 0, which `odgen fix` writes. What cannot be read counts as 0: not mappable, no flags."
    BAD_COUNT Error Error "EDS413" "CiA 306 4.6.3.4.2" "a compact array of an impossible size":
        "`CompactSubObj` is the number of elements, 1 to 254. A larger number is taken as 254; anything but a number leaves the array without elements."
    COMPACT_ELEMENT Error Error "EDS414" "CiA 306 4.6.3.4.2" "an element that a compact array does not have":
        "The keys of `[xxxxName]`, `[xxxxValue]` and `[xxxxDenotation]` are sub-indices in decimal, from 1 to the number in `CompactSubObj`; and only an object with `CompactSubObj` has such lists. The line is left out."
    MODULES Note Note "EDS415" "CiA 306 6" "a device that is built from modules":
        "What the device has depends on the modules that are plugged in. The dictionary shows the bus coupler and, in a DCF with `[ConnectedModules]`, the objects of the modules that are named there."
    BAD_NUMBER Error Error "EDS501" "CiA 306 4.3" "a number that cannot be read":
        "Numbers are decimal (`10`), hexadecimal (`0xA`) or, with a leading zero, octal (`012`). What cannot be read is left out: the entry then has no such value."
    OCTAL Warning Warning "EDS502" "CiA 306 4.3" "a number that is octal":
        "CiA 306 reads a number with a leading zero as octal: `010` is 8. Some tools do, others read it as decimal, others refuse it. It is read as the standard says; write it without the zero, or with `0x`."
    BIT_PATTERN Warning Note "EDS503" "CiA 306 4.3" "a signed value as a bit pattern":
        "The entry's type is signed, and the value is written as the bits that represent it: `0xFF` for -1 in an INTEGER8. The standard does not say that this is right; some readers refuse it as too large, others take it as 255. It is read as the negative number. Write signed values in decimal."
    FORMULA_SPELLING Warning Warning "EDS504" "CiA 306 4.3" "a formula in another spelling":
        "A formula begins with `$NODEID`, in upper case, and one added number may follow without spaces: `$NODEID+0x180`. In another spelling some readers lose the node-ID silently, and every node gets one COB-ID."
    BAD_FORMULA Error Error "EDS505" "CiA 306 4.3" "a formula that cannot be read":
        "A formula is `$NODEID` and at most one added number, in an entry whose type is an integer. The value is left out."
    BOOLEAN_WORD Warning Warning "EDS506" "CiA 306 4.3" "a word instead of 0 or 1":
        "A BOOLEAN is 0 or 1. Few readers understand `true` and `false`."
    NUMBER_NOTATION Warning Warning "EDS507" "CiA 306 4.3" "a number with something around it":
        "Numbers are written alone: no sign before hexadecimal digits, no `+`, no suffix such as `UL`, no `.0`, no quotation marks. It is read without them; other readers refuse it or stop at the first strange character."
    REMARK_IN_VALUE Error Warning "EDS508" "CiA 306 4.2" "a remark after a value":
        "A comment is a line of its own that begins with `;`. After a value it belongs to the value: most readers then find no number, or an unknown access type. It is read without the remark; put that on a line above the section."
    REAL_AS_BITS Warning Warning "EDS509" "CiA 306 4.3" "a REAL as a bit pattern":
        "CiA 306 does not say how a REAL is written: lely reads the bits of IEEE 754 as an integer, most others a decimal number. A hexadecimal number is read as bits."
    BYTES_NOTATION Warning Warning "EDS510" "CiA 306 4.3" "bytes in another notation":
        "An OCTET_STRING is written as pairs of hexadecimal digits without anything between or in front of them: `01A1053C`."
    TEXT_NOT_ASCII Error Warning "EDS511" "CiA 301 7.1.6.3" "a VISIBLE_STRING with other characters":
        "A VISIBLE_STRING holds the printable characters of ASCII. The value is left out, because it is unknown which bytes the device has."
    NO_PLACE Note Note "EDS512" "CiA 306 4.6.3.2" "a value that has no place in the dictionary":
        "Values and limits of DOMAIN, time and text entries and limits that depend on the node-ID are not kept: the dictionary has no place for them. Parameter values, application names (`Denotation`), reference designations (`ParamRefd`) and the files of DOMAINs belong to a node, and have a place in a DCF only. What has none is left out of what is made from the file."
    LIMIT_ON_TYPE Warning Warning "EDS513" "CiA 306 4.6.3.2" "a limit where none can be":
        "Only numbers have limits. Those of texts, byte blocks and BOOLEANs are left out."
}

// The codes that backends, commands and tests name.
pub use every::{MODULES, NO_PLACE, OBJECT_LEFT_OUT, OCTAL};
