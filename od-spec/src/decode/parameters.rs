//! Parameter files, and maps of settings wherever they are.

use super::entry::default;
use super::read::{Reader, owned};
use crate::ast::Name;
use crate::ast::SettingDecl;
use crate::source::Spanned;
use crate::yaml::Node;

/// A parameter file as it is written.
#[derive(Debug, Clone, Default)]
pub(crate) struct ParameterFileDecl {
    pub spec: Option<Name>,
    pub device: Option<Name>,
    pub title: Option<Name>,
    pub about: Option<Name>,
    pub node: Option<Spanned<u8>>,
    pub bit_rate: Option<Name>,
    pub node_name: Option<Name>,
    pub net_number: Option<Spanned<u32>>,
    pub net_name: Option<Name>,
    pub serial_number: Option<Spanned<u32>>,
    pub settings: Vec<SettingDecl>,
    pub unlock: Vec<Name>,
}

/// Reads a file whose shape was checked.
pub(crate) fn parameter_file(root: &Node) -> ParameterFileDecl {
    let reader = reader(root);
    ParameterFileDecl {
        spec: reader.text("spec"),
        device: reader.text("device"),
        title: reader.text("title"),
        about: words(reader, "about"),
        node: reader.integer("node").and_then(within),
        bit_rate: reader.text("bit-rate"),
        node_name: reader.text("node-name"),
        net_number: reader.integer("net-number").and_then(within),
        net_name: reader.text("net-name"),
        serial_number: reader.integer("serial-number").and_then(within),
        settings: root.get("parameters").map(settings).unwrap_or_default(),
        unlock: reader.texts("unlock"),
    }
}

/// A text, of one in several languages the English one.
pub(super) fn words(reader: Reader<'_>, key: &str) -> Option<Name> {
    let words = reader.words(key)?;
    words.value.get("en").map(|text| Spanned::new(text.to_owned(), words.span))
}

/// The settings of a map.
pub(crate) fn settings(map: &Node) -> Vec<SettingDecl> {
    let values = reader(map).pairs().filter_map(|(key, value)| Some((owned(key), default(value)?)));
    values.flat_map(|(key, value)| SettingDecl::of_key(&key, &value)).collect()
}

pub(super) const fn reader(node: &Node) -> Reader<'_> {
    Reader { node, language: "en", shown: &[] }
}

/// A number that the shape has limited already.
pub(super) fn within<T: TryFrom<i128>>(number: Spanned<i128>) -> Option<Spanned<T>> {
    T::try_from(number.value).ok().map(|value| Spanned::new(value, number.span))
}
