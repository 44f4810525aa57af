//! XDD and XDC texts (CiA 311): what an EDS or DCF says, in XML.
//!
//! Such a file has the facts of an EDS under other names, and some more about what values mean. It is translated into the sections
//! and keys of an EDS (`translate`), every one of them with its place in the XML, and `eds::read` makes the declaration from
//! these. So there is one reader of objects, whatever the notation; what the notation alone can get wrong is said here, in its own words.

#[cfg(feature = "xdd")]
mod access;
#[cfg(feature = "xdd")]
mod device;
#[cfg(feature = "xdd")]
mod editor;
#[cfg(feature = "xdd")]
mod languages;
#[cfg(feature = "xdd")]
mod left_out;
#[cfg(feature = "xdd")]
mod meaning;
#[cfg(feature = "xdd")]
mod objects;
#[cfg(feature = "xdd")]
mod parameters;
#[cfg(feature = "xdd")]
mod tree;
#[cfg(feature = "xdd")]
mod types;

#[cfg(feature = "xdd")]
pub(crate) use languages::Texts;
#[cfg(feature = "xdd")]
pub(crate) use left_out::say_values;

#[cfg(feature = "xdd")]
use crate::diag::Diagnostics;
#[cfg(feature = "xdd")]
use crate::eds::Document;
#[cfg(feature = "xdd")]
use crate::eds::read::StandardTypes;
#[cfg(feature = "xdd")]
use crate::limits::Room;
#[cfg(feature = "xdd")]
use crate::source::FileId;

/// Whether a text is an XDD or XDC: by the name of its file or, where that says nothing, by its first character.
pub fn is_xdd(name: &str, text: &str) -> bool {
    has_xdd_name(name) || (!crate::eds::has_eds_name(name) && text.trim_start().starts_with('<'))
}

/// Whether a file is named like an XDD or XDC.
pub fn has_xdd_name(name: &str) -> bool {
    crate::eds::ends_with(name, ".xdd") || is_xdc(name)
}

/// Whether a file is named like an XDC.
pub(crate) fn is_xdc(name: &str) -> bool {
    crate::eds::ends_with(name, ".xdc")
}

/// What becomes of objects that CANopenEditor has switched off: its own EDS and code are without them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Disabled {
    /// They are not objects of the device.
    #[default]
    LeftOut,
    /// They are objects like all others.
    Taken,
}

/// An XDD or XDC in the notation of an EDS.
#[cfg(feature = "xdd")]
pub(crate) struct Translated {
    /// Its sections and keys, with their places in the XML.
    pub document: Document<'static>,
    /// Descriptions beyond the one language that a comment has.
    pub texts: Texts,
}

/// Translates an XDD or XDC; `None`, with a message, for a text that is not one.
#[cfg(feature = "xdd")]
pub(crate) fn translate(
    file: FileId,
    text: &str,
    standard: StandardTypes,
    disabled: Disabled,
    diagnostics: &mut Diagnostics,
) -> Option<Translated> {
    let xml = tree::parse(file, text, diagnostics)?;
    let xml = tree::Tree { xml: &xml, file };
    let Some(list) = xml.first("CANopenObjectList") else {
        tree::say_that_it_is_none(xml, diagnostics);
        return None;
    };
    let mut document = Document::translated(file);
    let parameters = parameters::Parameters::of(xml);
    device::write(&mut document, xml, &parameters, diagnostics);
    let mut texts = Texts::of(xml);
    let context = objects::Context {
        document: &mut document,
        tree: xml,
        parameters: &parameters,
        texts: &mut texts,
        standard,
        diagnostics,
        room: Room::new(0),
    };
    objects::write(list, disabled, context);
    left_out::say_lists(xml, list, diagnostics);
    left_out::say(xml, diagnostics);
    Some(Translated { document, texts })
}
