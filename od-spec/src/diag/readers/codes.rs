//! What is said where a reader refuses a text and no rule finds a fault at that place.

use crate::diag::{Code, Severity};

macro_rules! codes {
    ($($name:ident $id:literal $title:literal: $explanation:literal)+) => {
        $(
            #[doc = $title]
            pub const $name: &Code = &Code {
                id: $id,
                severity: Severity::Note,
                foreign: Severity::Note,
                title: $title,
                explanation: $explanation,
                clause: None,
                example: None,
            };
        )+

        /// All of them, ascending.
        pub(crate) const ALL: &[&Code] = &[$($name,)+];
    };
}

codes! {
    TEXT "EDS801" "a text that not every reader divides alike":
        "Readers find sections, keys and values in their own ways. eds-utils takes what is between two empty lines as a section: it needs an empty line above each name, none among the keys, and no comments below the name. python-canopen and dcfchk read Python's INI files, in which a line that is indented belongs to the one above. Nothing is wrong by the standard; change this if these readers have to accept the file."
    NUMBER "EDS802" "a number that not every reader can read":
        "python-canopen and dcfchk read numbers as Python does: `010` is not a number, nor is an empty value in `[DeviceInfo]`; of some keys they know decimal only. dcfchk wants a REAL as its bit pattern, canopen-host in decimal. node-canopen knows no formula in 64 bits. The note names the readers that fail; another notation of the same number helps."
    MISSING "EDS803" "something that a reader needs":
        "By the standard it may be left out, or it is written in another case; some readers take nothing else. python-canopen and node-canopen know keys in the standard's case only, and dcfchk wants all three lists of objects, with 1000h and 1018h in one of them."
    UNKNOWN "EDS804" "something that a reader does not know":
        "dcfchk refuses a file with a section or key that is not among its own: those of modules, tools and dynamic channels, `[xxxxDenotation]`, and every maker's. eds-utils knows VAR, ARRAY and RECORD, and no DOMAIN or data type. Other readers ignore what they do not know."
    VALUE "EDS805" "a value or key that a reader does not take there":
        "node-canopen refuses keys of a single value in an ARRAY or RECORD, even empty ones, `PDOMapping` of a DOMAIN, and a default value that its data type does not have. eds-utils wants all elements of an ARRAY of one data type. dcfchk compares values with limits and data types, and wants objects in the list of their index range."
    ORDER "EDS806" "an order that a reader does not follow":
        "The standard does not say in which order sections are. python-canopen and eds-utils take them as they come: an object has to be before its sub-indices, and for eds-utils directly before them."
    REFERENCE "EDS807" "a reference that a reader cannot follow":
        "Where one section names what another describes, readers want to find it: dcfchk and eds-utils what PDOs map (eds-utils also dummies, which have no section), dcfchk the mapping of every PDO, node-canopen the object of every sub-index."
    BOTH_WAYS "EDS808" "a mappable entry that is read and written":
        "With `AccessType=rw` and `PDOMapping=1` the standard lets an entry travel in PDOs of both directions. CODESYS is reported to offer entries for mapping by their access type only: rwr and ro for TPDOs, rww and wo for RPDOs; rw in neither. Where the device uses the entry in one direction, rwr or rww says which."
}
