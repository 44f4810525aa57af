//! Objects and sub-objects, as the sections of an EDS.

use std::collections::BTreeSet;

use roxmltree::Node;

use super::Disabled;
use super::access;
use super::editor;
use super::languages::{Texts, key_of};
use super::meaning;
use super::parameters::{Parameter, Parameters};
use super::tree::{Tree, child, children};
use super::types;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::eds::Document;
use crate::eds::number::lenient_integer;
use crate::eds::read::{Form, StandardTypes};
use crate::limits::Room;
use crate::model::{DataType, EntryId, Index, ObjectKind, SubIndex};
use crate::notation::words;
use crate::source::{Span, Spanned};

/// What is read together.
pub(super) struct Context<'a, 'x> {
    pub document: &'a mut Document<'static>,
    pub tree: Tree<'x>,
    pub parameters: &'a Parameters<'x>,
    pub texts: &'a mut Texts,
    /// What CiA 301 says.
    pub standard: StandardTypes,
    pub diagnostics: &'a mut Diagnostics,
    /// What is left for the texts of parameters, which any number of objects may share.
    pub room: Room,
}

/// Writes the sections of all objects.
pub(super) fn write<'x>(list: Node<'x, 'x>, disabled: Disabled, mut context: Context<'_, 'x>) {
    let mut seen = BTreeSet::new();
    let mut left_out: Vec<Spanned<Index>> = Vec::new();
    for node in children(list, "CANopenObject") {
        let Some((number, place)) = context.number(node, "index", 0xFFFF) else { continue };
        if !seen.insert(number) {
            context.twice(node, place, &Index(number).to_string());
            continue;
        }
        if disabled == Disabled::LeftOut && editor::is_disabled(context.tree, node, context.parameters) {
            left_out.push(Spanned::new(Index(number), place));
            continue;
        }
        context.object(node, Index(number), place);
    }
    if let Some(warning) = editor::left_out(&left_out) {
        context.diagnostics.push(warning);
    }
}

/// The range of a parameter; that of its whole type limits nothing.
fn range<'x>(
    parameter: Parameter<'_, 'x>,
    data_type: DataType,
) -> (Option<Spanned<&'x str>>, Option<Spanned<&'x str>>) {
    let (low, high) = (parameter.limit("minValue"), parameter.limit("maxValue"));
    let number = |text: &Option<Spanned<&str>>| text.and_then(|text| lenient_integer(text.value));
    match (number(&low), number(&high), data_type.range()) {
        (Some(from), Some(to), Some(ends)) if (from, to) == ends => (None, None),
        _ => (low, high),
    }
}

impl<'a, 'x> Context<'a, 'x> {
    /// An index or sub-index in hexadecimal digits; nothing, with a message, where there is none.
    fn number(&mut self, node: Node<'x, 'x>, name: &str, highest: u16) -> Option<(u16, Span)> {
        let what = node.tag_name().name();
        let Some(text) = self.tree.attribute(node, name) else {
            let message = format!("a `{what}` has no `{name}`; it is left out");
            let help = "add it in hexadecimal digits, such as `6040` or `0A`";
            let place = self.tree.place(node);
            self.diagnostics.push(Diagnostic::new(codes::XDD_NO_PLACE, place, message).help(help));
            return None;
        };
        let digits =
            text.value.strip_prefix("0x").or_else(|| text.value.strip_prefix("0X")).unwrap_or(text.value);
        let is_number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
        let number = u16::from_str_radix(digits, 16).ok().filter(|number| is_number && *number <= highest);
        if number.is_none() {
            let message = format!(
                "found `{name}=\"{}\"`, expected hexadecimal digits; the `{what}` is left out",
                shorten(text.value)
            );
            let help = "write an index with four digits and a sub-index with two";
            self.diagnostics.push(Diagnostic::new(codes::XDD_NO_PLACE, text.span, message).help(help));
        }
        number.map(|number| (number, text.span))
    }

    fn twice(&mut self, node: Node<'x, 'x>, place: Span, id: &str) {
        let message = format!("{id} is described twice; this `{}` is left out", node.tag_name().name());
        self.diagnostics
            .push(Diagnostic::new(codes::XDD_NO_PLACE, place, message).help("remove one of the two"));
    }

    fn object(&mut self, node: Node<'x, 'x>, index: Index, place: Span) {
        let id = EntryId { index, sub: SubIndex(0) };
        let subs = self.subs(node, index);
        self.count(node, index, subs.len());
        let parameter = self.parameter(node);
        let kind = self.kind(node, &id.to_string(), !subs.is_empty());
        let lines = self.lines(id, false, parameter);
        self.document.push_header(&format!("{:X}", index.0), place, &lines);
        self.name(node, &id.to_string(), parameter);
        self.object_type(node, kind);
        match kind {
            Some(ObjectKind::Var) => self.facts(node, id, Form::Value, parameter),
            Some(ObjectKind::Domain) => self.facts(node, id, Form::Domain, parameter),
            Some(ObjectKind::Array | ObjectKind::Record) | None => {}
        }
        self.text("Denotation", self.tree.attribute(node, "denotation"));
        editor::write(self.document, self.tree, node, parameter);
        for (sub, place, node) in subs {
            self.sub_object(node, EntryId { index, sub: SubIndex(sub) }, place);
        }
    }

    fn sub_object(&mut self, node: Node<'x, 'x>, id: EntryId, place: Span) {
        let shown = format!("{}.{}", id.index, id.sub);
        let parameter = self.parameter(node);
        let lines = self.lines(id, true, parameter);
        self.document.push_header(&format!("{:X}sub{:X}", id.index.0, id.sub.0), place, &lines);
        self.name(node, &shown, parameter);
        // Whatever else a sub-object says to be, it is a value.
        let kind = match self.kind(node, &shown, false) {
            Some(ObjectKind::Domain) => ObjectKind::Domain,
            Some(ObjectKind::Var | ObjectKind::Array | ObjectKind::Record) | None => ObjectKind::Var,
        };
        self.object_type(node, Some(kind));
        let form = if kind == ObjectKind::Domain { Form::Domain } else { Form::of_sub(id) };
        self.facts(node, id, form, parameter);
        self.text("Denotation", self.tree.attribute(node, "denotation"));
        editor::write(self.document, self.tree, node, parameter);
    }

    /// The sub-objects, each sub-index once.
    fn subs(&mut self, node: Node<'x, 'x>, index: Index) -> Vec<(u8, Span, Node<'x, 'x>)> {
        let mut subs: Vec<(u8, Span, Node<'x, 'x>)> = Vec::new();
        let mut seen = BTreeSet::new();
        for node in children(node, "CANopenSubObject") {
            let Some((number, place)) = self.number(node, "subIndex", 0xFF) else { continue };
            let Ok(sub) = u8::try_from(number) else { continue };
            if seen.insert(sub) {
                subs.push((sub, place, node));
            } else {
                self.twice(node, place, &EntryId { index, sub: SubIndex(sub) }.to_string());
            }
        }
        subs
    }

    /// Reports a number of sub-objects that is not the number of those that are there.
    fn count(&mut self, node: Node<'x, 'x>, index: Index, found: usize) {
        let Some(stated) = self.tree.attribute(node, "subNumber") else { return };
        if stated.value.trim().parse() != Ok(found) {
            let message = format!(
                "found `subNumber=\"{}\"`, but the number of sub-objects of {index} is {found}",
                shorten(stated.value)
            );
            let help = "correct the number, or add the sub-objects that are missing";
            self.diagnostics.push(Diagnostic::new(codes::XDD_COUNT, stated.span, message).help(help));
        }
    }

    /// The parameter that an object or sub-object refers to.
    fn parameter(&mut self, node: Node<'x, 'x>) -> Option<Parameter<'a, 'x>> {
        match self.parameters.referred(node) {
            Ok(parameter) => parameter,
            Err(uid) => {
                let message = format!("there is no parameter `{}`", shorten(uid.value));
                let help = "correct `uniqueIDRef`, or add the parameter to `parameterList`";
                self.diagnostics.push(Diagnostic::new(codes::XDD_REFERENCE, uid.span, message).help(help));
                None
            }
        }
    }

    /// What an object is; nothing for one that is not an entry of the dictionary, which the reader of objects says.
    fn kind(&mut self, node: Node<'x, 'x>, id: &str, has_subs: bool) -> Option<ObjectKind> {
        let usual = if has_subs { ObjectKind::Record } else { ObjectKind::Var };
        let text = self.tree.attribute(node, "objectType");
        let number = text.and_then(|text| text.value.parse::<u8>().ok());
        let word = text.and_then(|text| words::object_code(text.value)).filter(|_| number.is_none());
        let stated = match number.or(word) {
            Some(2) => Some(ObjectKind::Domain),
            Some(7) => Some(ObjectKind::Var),
            Some(8) => Some(ObjectKind::Array),
            Some(9) => Some(ObjectKind::Record),
            Some(0 | 5 | 6) if !has_subs => return None,
            Some(_) | None => None,
        };
        let fits = |kind: &ObjectKind| !has_subs || matches!(kind, ObjectKind::Array | ObjectKind::Record);
        let fitting = stated.filter(fits);
        let taken = fitting.unwrap_or(usual);
        if fitting.is_none() || word.is_some() {
            let found = match text {
                Some(text) => format!("found `objectType=\"{}\"`", shorten(text.value)),
                None => "there is no `objectType`".to_owned(),
            };
            let message = format!("{id}: {found}; it is taken as {}", taken.name());
            let help = "write 7 for VAR, 8 for ARRAY, 9 for RECORD, 2 for DOMAIN";
            let place = text.map_or_else(|| self.tree.place(node), |text| text.span);
            self.diagnostics.push(Diagnostic::new(codes::XDD_ATTRIBUTE, place, message).help(help));
        }
        Some(taken)
    }

    /// What comments say in an EDS.
    fn lines(&mut self, id: EntryId, is_sub: bool, parameter: Option<Parameter<'a, 'x>>) -> Vec<String> {
        let Some(parameter) = parameter else { return Vec::new() };
        let described = self.texts.lines(self.tree, key_of(id, is_sub), parameter);
        let mut lines: Vec<String> = described.into_iter().map(str::to_owned).collect();
        lines.extend(meaning::lines(self.tree, parameter, id, self.diagnostics));
        if let Err(full) = self.room.take(0, lines.iter().map(String::len).sum()) {
            let message = full.words(0);
            let help = "the texts of further parameters are left out; is this the right file?";
            let place = self.tree.place(self.tree.xml.root_element());
            if self.diagnostics.is_new(codes::TOO_MUCH, place) {
                self.diagnostics.push(Diagnostic::new(codes::TOO_MUCH, place, message).help(help));
            }
            return Vec::new();
        }
        lines
    }

    /// The name; where there is none, that of the parameter, or the index.
    fn name(&mut self, node: Node<'x, 'x>, id: &str, parameter: Option<Parameter<'a, 'x>>) {
        if let Some(name) = self.tree.attribute(node, "name") {
            return self.text("ParameterName", Some(name));
        }
        let label = parameter.and_then(|parameter| self.tree.text(child(parameter.node, "label")?));
        if label.is_none() {
            let message = format!("{id} has no `name`");
            let help = "add the name that the manual gives it";
            let place = self.tree.place(node);
            self.diagnostics.push(Diagnostic::new(codes::XDD_ATTRIBUTE, place, message).help(help));
        }
        let place = self.tree.place(node);
        let name = label.unwrap_or_else(|| Spanned::new(id, place));
        self.document.push_key("ParameterName", name.value, name.span);
    }

    fn object_type(&mut self, node: Node<'x, 'x>, kind: Option<ObjectKind>) {
        let place = self.tree.attribute(node, "objectType");
        let place = place.map_or_else(|| self.tree.place(node), |text| text.span);
        let code = kind.map_or_else(|| "0".to_owned(), |kind| format!("0x{:X}", kind.code()));
        self.document.push_key("ObjectType", &code, place);
    }

    fn text(&mut self, key: &str, value: Option<Spanned<&str>>) {
        if let Some(value) = value {
            self.document.push_key(key, value.value, value.span);
        }
    }

    /// The facts of an entry.
    fn facts(&mut self, node: Node<'x, 'x>, id: EntryId, form: Form, parameter: Option<Parameter<'a, 'x>>) {
        let data_type = self.data_type(node, id, form, parameter);
        let code = format!("0x{:04X}", data_type.value.code());
        self.document.push_key("DataType", &code, data_type.span);
        let is_domain = data_type.value == DataType::Domain;
        let taken = access::of(self.tree, node, id, is_domain, parameter, self.diagnostics);
        let of = |name: &str| self.tree.attribute(node, name);
        let (low, high) = match (of("lowLimit"), of("highLimit"), parameter) {
            // A range has two ends, one of which may be the type's.
            (None, None, Some(parameter)) => range(parameter, data_type.value),
            (low, high, _) => (low, high),
        };
        let default = of("defaultValue").or_else(|| parameter?.value("defaultValue"));
        let actual = of("actualValue").or_else(|| parameter?.value("actualValue"));
        let flags = of("objFlags");
        self.text("LowLimit", low);
        self.text("HighLimit", high);
        self.text("AccessType", Some(taken.access.map(crate::model::Access::word)));
        for (key, value) in [("DefaultValue", default), ("ParameterValue", actual)] {
            match value.filter(|_| data_type.value == DataType::OctetString) {
                // Bytes are apart here, and an EDS has them together.
                Some(bytes) => {
                    let together: String = bytes.value.split_whitespace().collect();
                    self.document.push_key(key, &together, bytes.span);
                }
                None => self.text(key, value),
            }
        }
        if !is_domain {
            let mapping = taken.is_mappable.map(|mappable| mappable.map(|yes| if yes { "1" } else { "0" }));
            self.text("PDOMapping", mapping);
        }
        if let Some(flags) = flags {
            let digits = flags.value.trim_start_matches("0x");
            self.document.push_key("ObjFlags", &format!("0x{digits}"), flags.span);
        }
    }

    /// The data type: the object's own, or else its parameter's, or else that of CiA 301. What none of them says is a block of
    /// unknown length.
    fn data_type(
        &mut self,
        node: Node<'x, 'x>,
        id: EntryId,
        form: Form,
        parameter: Option<Parameter<'a, 'x>>,
    ) -> Spanned<DataType> {
        let text = self.tree.attribute(node, "dataType");
        let place = text.map_or_else(|| self.tree.place(node), |text| text.span);
        if let Some(known) = text.and_then(|text| types::of_index(text.value)) {
            return Spanned::new(known, place);
        }
        if let Some((text, named)) = text.and_then(|text| Some((text, types::of_word(text.value)?))) {
            let message =
                format!("{id}: found `dataType=\"{}\"`; it is taken as {named}", shorten(text.value));
            let help = format!("write `{:04X}`", named.code());
            self.diagnostics.push(Diagnostic::new(codes::XDD_ATTRIBUTE, place, message).help(help));
            return Spanned::new(named, place);
        }
        if let Some(known) = parameter.and_then(Parameter::data_type) {
            return Spanned::new(known, place);
        }
        let standard = form.standard_type(id, self.standard);
        let taken = standard.unwrap_or(DataType::Domain);
        if form != Form::Domain || text.is_some() {
            let message = match text {
                Some(text) => {
                    format!("{id}: there is no data type `{}`; it is taken as {taken}", shorten(text.value))
                }
                None => format!("{id} has no data type; it is taken as {taken}"),
            };
            let help = match standard {
                Some(known) => {
                    format!("write `dataType=\"{:04X}\"`: CiA 301 gives it this type", known.code())
                }
                None => "add `dataType`, the index of a data type of CiA 301 such as `0007` for UNSIGNED32"
                    .to_owned(),
            };
            self.diagnostics.push(Diagnostic::new(codes::XDD_NO_TYPE, place, message).help(help));
        }
        Spanned::new(taken, place)
    }
}
