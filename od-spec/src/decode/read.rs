//! Typed reading of nodes whose shape was checked: what does not fit is left out without a word.

use crate::ast::{BaseDecl, ConditionDecl, Formula, MappingKind, Name, NumberRange, Offset, Words};
use crate::diag::Diagnostics;
use crate::expr::Expr;
use crate::keys::Keys;
use crate::model::{
    Access, AccessRight, Basis, BitPattern, ByDevice, Category, Date, DateTime, ErratumKind, ErrorKind, Fact,
    Index, PdoMapping, Phrases, Ratio, Storage, Text,
};
use crate::name_pattern::NamePattern;
use crate::scalar;
use crate::source::{Span, Spanned};
use crate::yaml::{MERGE, Node, NodeKind};

use super::lexical;

/// A map with fixed keys, and the language that plain texts are in.
#[derive(Clone, Copy)]
pub(super) struct Reader<'a> {
    pub node: &'a Node,
    pub language: &'a str,
    /// The languages that are shown; of a library, those of the specification that uses it. None: all.
    pub shown: &'a [String],
}

impl<'a> Reader<'a> {
    pub(super) const fn at(self, node: &'a Node) -> Self {
        Self { node, ..self }
    }

    pub(super) fn child(self, key: &str) -> Option<Self> {
        self.node.get(key).map(|node| self.at(node))
    }

    /// The place of a key, and its value.
    pub(super) fn keyed(self, key: &str) -> Option<(Span, Self)> {
        let (name, node) = self.node.entries().iter().find(|(name, _)| name.value == key)?;
        Some((name.span, self.at(node)))
    }

    /// The values of a list, or the one value in its place.
    pub(super) fn items(self, key: &str) -> impl Iterator<Item = Self> {
        let nodes = self.node.get(key).map(Node::one_or_more).unwrap_or_default();
        nodes.iter().map(move |node| self.at(node))
    }

    /// The entries of a map with data in its keys.
    pub(super) fn entries(self, key: &str) -> impl Iterator<Item = (Spanned<&'a str>, Self)> + use<'a> {
        self.child(key).into_iter().flat_map(Self::pairs)
    }

    /// The entries of the map itself.
    pub(super) fn pairs(self) -> impl Iterator<Item = (Spanned<&'a str>, Self)> {
        let entries = self.node.entries().iter().filter(|(name, _)| name.value != MERGE);
        entries.map(move |(name, node)| (Spanned::new(name.value.as_str(), name.span), self.at(node)))
    }

    /// Reads the scalar itself.
    pub(super) fn scalar<T>(self, read: impl Fn(&str) -> Option<T>) -> Option<Spanned<T>> {
        let text = self.node.text()?;
        read(text.value).map(|value| Spanned::new(value, text.span))
    }

    pub(super) fn value<T>(self, key: &str, read: impl Fn(&str) -> Option<T>) -> Option<Spanned<T>> {
        self.child(key)?.scalar(read)
    }

    pub(super) fn text(self, key: &str) -> Option<Name> {
        self.value(key, |text| Some(text.to_owned()))
    }

    pub(super) fn integer(self, key: &str) -> Option<Spanned<i128>> {
        self.value(key, |text| scalar::integer(text).ok())
    }

    pub(super) fn yes_no(self, key: &str) -> Option<Spanned<bool>> {
        self.value(key, scalar::yes_no)
    }

    pub(super) fn texts(self, key: &str) -> Vec<Name> {
        self.items(key).filter_map(|item| item.scalar(|text| Some(text.to_owned()))).collect()
    }

    /// Texts, or `None` when the key is not there.
    pub(super) fn optional_texts(self, key: &str) -> Option<Vec<Name>> {
        self.node.get(key).map(|_| self.texts(key))
    }

    pub(super) fn integers(self, key: &str) -> Vec<Spanned<i128>> {
        self.items(key).filter_map(|item| item.scalar(|text| scalar::integer(text).ok())).collect()
    }

    /// Indices, or `None` when the key is not there.
    pub(super) fn optional_indices(self, key: &str) -> Option<Vec<Spanned<Index>>> {
        self.node.get(key).map(|_| self.indices(key))
    }

    pub(super) fn indices(self, key: &str) -> Vec<Spanned<Index>> {
        self.items(key).filter_map(|item| item.scalar(lexical::index)).collect()
    }

    /// The scalar itself, or the text under a key: the short form of a map.
    pub(super) fn short(self, key: &str) -> Option<Name> {
        self.scalar(|text| Some(text.to_owned())).or_else(|| self.text(key))
    }

    /// Whether a key was refused, or the node is not a map at all.
    pub(super) fn has_unknown_key(self, keys: &Keys) -> bool {
        let known = |name: &str| keys.get(name).is_some();
        let mut names = self.node.entries().iter().map(|(name, _)| name.value.as_str());
        !matches!(self.node.kind, NodeKind::Map(_)) || names.any(|name| !known(name))
    }

    /// A text, or a map from language to text.
    pub(super) fn words(self, key: &str) -> Words {
        let child = self.child(key)?;
        child.translated().map(|text| Spanned::new(text, child.node.span))
    }

    /// The text itself, in one language or by language.
    pub(super) fn translated(self) -> Option<Text> {
        let text = |node: &'a Node| node.text().map(|text| text.value.trim());
        let text = match &self.node.kind {
            NodeKind::Map(entries) => Text::among(
                entries.iter().filter_map(|(name, node)| Some((name.value.as_str(), text(node)?))),
                self.shown,
            ),
            _ => Text::new([(self.language, text(self.node)?)]),
        };
        (!text.is_empty()).then_some(text)
    }
}

/// How the value of a key becomes what the specification says by it.
pub(super) trait FromNode: Sized {
    /// `None` for what does not fit.
    fn from_node(reader: Reader<'_>, diagnostics: &mut Diagnostics) -> Option<Self>;
}

macro_rules! scalars {
    ($($type:ty = $read:expr,)+) => {
        $(impl FromNode for $type {
            fn from_node(reader: Reader<'_>, _: &mut Diagnostics) -> Option<Self> {
                reader.scalar($read).map(|read| read.value)
            }
        })+
    };
}

scalars! {
    String = |text| Some(text.to_owned()),
    i128 = |text| scalar::integer(text).ok(),
    bool = scalar::yes_no,
    Date = lexical::date,
    DateTime = lexical::date_time,
    Access = Access::from_word,
    AccessRight = lexical::access,
    PdoMapping = PdoMapping::from_word,
    Storage = Storage::from_word,
    Category = Category::from_word,
    ErratumKind = ErratumKind::from_word,
    Fact = Fact::from_word,
    Basis = Basis::from_word,
    ErrorKind = ErrorKind::from_word,
    ByDevice = ByDevice::from_word,
    MappingKind = MappingKind::from_word,
    Ratio = lexical::positive_ratio,
    Offset = |text| scalar::ratio(text).map(Offset),
    BaseDecl = lexical::base,
    ConditionDecl = ConditionDecl::read,
    NumberRange = lexical::numbers,
    Formula = |text| Expr::parse_term(text).ok().map(Formula),
    BitPattern = lexical::pattern,
    NamePattern = |text| NamePattern::parse(text).ok(),
}

impl FromNode for Text {
    fn from_node(reader: Reader<'_>, _: &mut Diagnostics) -> Option<Self> {
        reader.translated()
    }
}

impl FromNode for Phrases {
    fn from_node(reader: Reader<'_>, _: &mut Diagnostics) -> Option<Self> {
        let phrases = |node: &Node| {
            let phrases = node.one_or_more().iter().filter_map(Node::text);
            phrases.map(|phrase| phrase.value.trim().to_owned()).collect()
        };
        Some(Self::new(
            reader.pairs().map(|(language, list)| (language.value.to_owned(), phrases(list.node))),
        ))
    }
}

/// A field of a declaration, which one key fills.
pub(super) trait Field: Sized {
    /// Reads what is under the key, if the key is there.
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self;
}

impl<T: FromNode> Field for Option<Spanned<T>> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        let child = reader.child(key)?;
        T::from_node(child, diagnostics).map(|value| Spanned::new(value, child.node.span))
    }
}

/// One value, or a list of them.
impl<T: FromNode> Field for Vec<Spanned<T>> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        let values = reader.items(key).filter_map(|item| {
            T::from_node(item, diagnostics).map(|value| Spanned::new(value, item.node.span))
        });
        values.collect()
    }
}

impl<T: FromNode> Field for Option<Vec<Spanned<T>>> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        reader.child(key).map(|_| Field::read(reader, key, diagnostics))
    }
}

/// A function that reads the keys of a table of [`crate::keys`] into its declaration; what is known without the keys
/// comes first.
macro_rules! reader {
    ($visibility:vis fn $function:ident($($head:ident: $head_type:ty),*) -> $name:ident {
        $($key:literal $($need:ident)?: $shape:expr => $field:ident: $type:ty, $about:literal
            $(, $example:literal)?;)+
    }) => {
        $visibility fn $function(
            $($head: $head_type,)*
            reader: Reader<'_>,
            diagnostics: &mut Diagnostics,
        ) -> $name {
            $name { $($head,)* $($field: Field::read(reader, $key, diagnostics),)+ }
        }
    };
}
pub(super) use reader;

/// The name as a text of its own.
pub(super) fn owned(name: Spanned<&str>) -> Name {
    name.map(ToOwned::to_owned)
}
