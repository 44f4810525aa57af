//! Devices.

use super::errors::ANY_ERROR;
use super::shape::{Key, KeyKind, Keys, NameOf, Shape, U8, U32};
use super::table::keys;
use crate::model::PdoMapping;

macro_rules! device_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "name" required: Shape::Text => name: Option<Name>, "full name";
            "about": Shape::Words => about: Words, "what the device does";
            "gap": Shape::Words => gap: Words, "what the printed manual leaves open about it";
            "product-name": Shape::HeaderText => product_name: Option<Name>, "product name in the EDS; the device's name unless given";
            "product": U32 => product: Option<Spanned<i128>>, "product code (1018h.2)";
            "product-revision": U32 => product_revision: Option<Spanned<i128>>, "product revision (1018h.3): upper half major, lower half minor", "0x0001_0002";
            "order-code": Shape::HeaderText => order_code: Option<Name>, "order code; the product name unless given";
            "bit-rates": Shape::List(&Shape::Integer(10, 1000)) => bit_rates: Vec<Spanned<i128>>, "supported bit rates in kbit/s: 10, 20, 50, 125, 250, 500, 800, 1000", "[125, 250, 500, 1000]";
            "device-type": U32 => device_type: Option<Spanned<i128>>, "device type (1000h): low word profile number, high word additional information", "0x0002_0192";
            "granularity": Shape::Integer(0, 64) => granularity: Option<Spanned<i128>>, "smallest step of PDO mapping in bits; 8 unless given, 0 if no mapping can be changed";
            "boot-up-master": Shape::YesNo => boot_up_master: Option<Spanned<bool>>, "simple boot-up master; no unless given";
            "boot-up-slave": Shape::YesNo => boot_up_slave: Option<Spanned<bool>>, "simple boot-up slave; yes unless given";
            "group-messaging": Shape::YesNo => group_messaging: Option<Spanned<bool>>, "multiplexed PDOs; no unless given";
            "lss": Shape::YesNo => lss: Option<Spanned<bool>>, "LSS slave; no unless given";
            "dummies": Shape::List(&Shape::NameOf(NameOf::DataType)) => dummies: Vec<Name>, "data types that an RPDO may map as placeholders", "[unsigned8, unsigned16]";
            "dynamic-channels": Shape::MapOf(KeyKind::Indices, &Shape::Map(&CHANNEL)) => dynamic_channels: Vec<ChannelDecl>, "indices at which a PLC may create network variables", "{0xA080..0xA0BF: {type: unsigned8, access: ro, offset: 0}}";
            "features": Shape::List(&Shape::Feature) => features: Vec<Spanned<FeatureChoice>>, "features of the used libraries that the device has; one with channels has their number after a colon", "[heartbeat producer, digital inputs: 16]";
            "any-error": Shape::Map(&ANY_ERROR) => any_error: Option<AnyErrorDecl>, "what is the same for every error of the device", "{reset: bit 7 of 6040h from 0 to 1}";
            "canopennode": Shape::MapOf(KeyKind::Indices, &Shape::Map(&NOTES)) => canopennode: Vec<NotesDecl>, "what the stack CANopenNode and CANopenEditor need to know of objects, by index", "{0x1400..0x1403: {group: PERSIST_COMM, count: RPDO}}";
            "eds": Shape::Map(&FILE) => eds: Option<FileDecl>, "what the EDS states about itself, and what does not follow from the specification";
            "eds-defaults": Shape::Choice(&["safe", "own", "all"]) => eds_defaults: Option<Name>, "which defaults the EDS has: `safe` withholds those of writable entries that are locked or stored (except as communication parameters); `own` withholds also those that only a library states; `all` writes every default; `safe` unless given";
        } }
    };
}
pub(crate) use device_keys;

device_keys! { keys
    /// A device.
    DEVICE = "a device"
}

macro_rules! channel_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "type" required: Shape::NameOf(NameOf::DataType) => type_name: Option<Name>, "data type of the variables", "unsigned8";
            "access" required: Shape::Choice(&["ro", "wo", "rw", "rwr", "rww"]) => access: Option<Spanned<Access>>, "access over the bus";
            "offset" required: U32 => offset: Option<Spanned<i128>>, "where the variables begin in the process picture", "0x0040";
            "difference": U32 => difference: Option<Spanned<i128>>, "difference of the addresses of two variables, where these are boolean";
        } }
    };
}
pub(crate) use channel_keys;

channel_keys! { keys
    /// A segment of `dynamic-channels:`.
    CHANNEL = "a dynamic channel"
}

macro_rules! notes_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "group": Shape::Text => group: Option<Name>, "storage group of the values, such as `PERSIST_MFR` for the variable `OD_PERSIST_MFR`; that of their storage unless given", "PERSIST_MFR";
            "count": Shape::Text => count: Option<Name>, "counter that the object adds to, such as `VALVE` for `OD_CNT_VALVE`", "VALVE";
            "srdo": Shape::MapOf(KeyKind::Number, &Shape::Choice(PdoMapping::WORDS)) => srdo: BTreeMap<u8, Spanned<PdoMapping>>, "SRDOs that its entries may be mapped into, by sub-index; 0 is an object without sub-indices", "{1: transmit}";
            "requests-tpdos": Shape::YesNo => requests_tpdos: Option<Spanned<bool>>, "whether a write of the application may request the TPDOs that map it; no unless given";
        } }
    };
}
pub(crate) use notes_keys;

notes_keys! { keys
    /// `canopennode:` of a device.
    NOTES = "an object for CANopenNode"
}

macro_rules! file_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "description": Shape::HeaderText => description: Option<Name>, "description of the file; the device's name unless given";
            "created" required: Shape::DateTime => created: Option<Spanned<DateTime>>, "when the file was first made", "2009-05-27 09:00";
            "created-by": Shape::HeaderText => created_by: Option<Name>, "who made it; the vendor unless given";
            "modified": Shape::DateTime => modified: Option<Spanned<DateTime>>, "when it was last changed; `created` unless given";
            "modified-by": Shape::HeaderText => modified_by: Option<Name>, "who changed it; `created-by` unless given";
            "file-version": U8 => version: Option<Spanned<i128>>, "version of the file; 1 unless given";
            "file-revision": U8 => revision: Option<Spanned<i128>>, "revision of the file; 0 unless given";
            "comments": Shape::List(&Shape::Text) => comments: Option<Vec<Name>>, "lines of `[Comments]`; the descriptions of the device and its file unless given", "[For line 3 only.]";
            "sections": Shape::MapOf(KeyKind::Name, &Shape::MapOf(KeyKind::Name, &Shape::Text)) => sections: Vec<FileSectionDecl>, "keys that do not follow from the specification, by the names of their sections", "{DeviceInfo: {NG_Slave: 1}, 2001sub1: {SRDOMapping: 1}, Tools: {Items: 1}}";
        } }
    };
}
pub(crate) use file_keys;

file_keys! { keys
    /// `eds:` of a device.
    FILE = "an EDS header"
}
