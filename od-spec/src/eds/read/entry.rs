//! The keys of an entry (CiA 306 4.6.3.2): a VAR's section, or that of a sub-index.

use super::comments::Meanings;
use super::node::NodeDecl;
use super::{Form, StandardTypes, made, owned, value, words};
use crate::ast::{DefaultDecl, EdsDecl, EntryDecl};
use crate::diag::{About, Diagnostic, Diagnostics, Edit, shorten};
use crate::eds::view::{Part, View};
use crate::eds::{codes, edits, number};
use crate::limits::{ENTRIES_OF_DEVICE, Room};
use crate::model::{Access, AccessRight, DataType, EntryId, Fact, Index, PdoMapping};
use crate::notation::words::yes_no;
use crate::source::{Span, Spanned};
use crate::wording::{FileFormat, Key};

/// What is read together with an entry.
pub(super) struct Context<'a> {
    /// Of a DCF: the node, which gets the parameter value.
    pub node: Option<&'a mut NodeDecl>,
    /// What comments say.
    pub meanings: &'a mut Meanings,
    pub diagnostics: &'a mut Diagnostics,
    /// How much more there may be; nothing, once something was left out.
    pub room: Option<Room>,
    /// How the file is written.
    pub format: FileFormat,
    /// The whole file.
    pub view: &'a View<'a>,
    /// What CiA 301 says.
    pub standard: StandardTypes,
}

impl Context<'_> {
    /// Takes the room of so many entries with so much text each; what does not fit is left out with all that follows, which is
    /// said once.
    pub(super) fn fits(&mut self, index: Index, entries: usize, text: usize, place: Span) -> bool {
        let Some(room) = &mut self.room else { return false };
        let Err(full) = room.take(entries, entries.saturating_mul(text)) else { return true };
        self.room = None;
        let message = format!(
            "{} up to {index}; it and what follows is left out, as no device has so much",
            full.words(ENTRIES_OF_DEVICE)
        );
        self.diagnostics.push(
            Diagnostic::new(crate::diag::codes::TOO_MUCH, place, message)
                .help("is this the right file? correct `CompactSubObj`, or describe less"),
        );
        false
    }

    /// What is said from now on is about this.
    pub(super) fn about(&mut self, about: impl Into<About>) {
        self.diagnostics.now_about(Some(about.into()));
    }

    pub(super) fn push(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }
}

/// Reads the section of an entry. The type is always known afterwards, the access always stated.
pub(super) fn entry(part: &Part<'_>, id: EntryId, form: Form, context: &mut Context<'_>) -> EntryDecl {
    let place = part.place();
    let data_type = data_type(part, id, form, context);
    let access = access(part, id, data_type.value, context);
    let read = |key: &str, context: &mut Context<'_>| {
        context.about((id, Fact::Default));
        value::value(part.value(key)?, data_type.value, context.diagnostics)
    };
    let limit = |key: &str, fact: Fact, context: &mut Context<'_>| {
        context.about((id, fact));
        value::limit(part.value(key)?, data_type.value, context.diagnostics)
    };
    let min = limit("LowLimit", Fact::LowLimit, context);
    let max = limit("HighLimit", Fact::HighLimit, context);
    let default = read("DefaultValue", context);
    if let Some(value) = part.value("ParameterValue") {
        let read = context.node.is_some().then(|| read("ParameterValue", context)).flatten();
        if let (Some(node), Some(read)) = (context.node.as_deref_mut(), read) {
            node.values.push((id, read));
        } else if context.node.is_none() {
            let message = format!("the parameter value of {id} is left out: this is no DCF");
            let help = "make it the default, or call the file a DCF";
            context.push(Diagnostic::new(codes::NO_PLACE, value.span, message).help(help));
        }
    }
    let name = name(part, id, context);
    let entry = EntryDecl {
        name: Some(name.clone()),
        type_name: Some(data_type.map(|data_type| data_type.name().to_owned())),
        access: Some(access.map(|access| AccessRight { access, locked: false })),
        pdo: mapping(part, id, access.value, context),
        default: default.map(DefaultDecl::one),
        min,
        max,
        eds: flags(part, id, context),
        ..EntryDecl::empty(place)
    };
    context.about(id);
    context.meanings.add_to(entry, part, &name.value)
}

/// The data type of an entry that was read.
pub(super) fn type_of(entry: &EntryDecl) -> Option<DataType> {
    entry.type_name.as_ref().and_then(|name| DataType::from_name(&name.value))
}

/// The name of an object or an entry; its index where it has none.
pub(super) fn name(part: &Part<'_>, id: EntryId, context: &mut Context<'_>) -> Spanned<String> {
    context.about((id, Fact::Name));
    if let Some(name) = part.value("ParameterName") {
        return owned(name);
    }
    let place = part.key("ParameterName").map_or(part.place(), |entry| entry.key.span);
    let message = format!("{id} has no {}", context.format.key(Key::Name));
    context.push(
        Diagnostic::new(codes::MISSING_NAME, place, message).help("add the name that the manual gives it"),
    );
    made(id.to_string(), place)
}

fn data_type(part: &Part<'_>, id: EntryId, form: Form, context: &mut Context<'_>) -> Spanned<DataType> {
    context.about((id, Fact::Type));
    let Some(text) = part.value("DataType") else {
        let known = form.standard_type(id, context.standard);
        if form != Form::Domain {
            let diagnostic = without_type(part, id, known, context);
            context.push(diagnostic);
        }
        return Spanned::new(known.unwrap_or(DataType::Domain), part.place());
    };
    if let Some(known) = words::data_type(text, context.diagnostics) {
        return Spanned::new(known, text.span);
    }
    let taken = form.standard_type(id, context.standard).unwrap_or(DataType::Domain);
    let message = format!("{id}: there is no data type `{}`; it is taken as {taken}", shorten(text.value));
    let help = "write the index of a data type of CiA 301, such as `0x0007` for UNSIGNED32";
    context.push(
        Diagnostic::new(codes::UNKNOWN_DATA_TYPE, text.span, message).help(number::help(text.value, help)),
    );
    Spanned::new(taken, text.span)
}

/// An entry that says no data type; `known` is the one that CiA 301 gives it.
fn without_type(part: &Part<'_>, id: EntryId, known: Option<DataType>, context: &Context<'_>) -> Diagnostic {
    let taken = known.unwrap_or(DataType::Domain);
    let message = format!("{id} has no {}; it is taken as {taken}", context.format.key(Key::DataType));
    let mut diagnostic = Diagnostic::new(codes::MISSING_DATA_TYPE, part.place(), message);
    let Some(known) = known else {
        let example = context.format.set(Key::DataType, "0x0007");
        return diagnostic.help(format!("add the index of its data type, such as {example}"));
    };
    let code = format!("0x{:04X}", known.code());
    diagnostic.edits.extend(edits::set(context.view, part, "DataType", &code));
    diagnostic.help(format!("add {}: CiA 301 gives it this type", context.format.set(Key::DataType, &code)))
}

fn access(part: &Part<'_>, id: EntryId, data_type: DataType, context: &mut Context<'_>) -> Spanned<Access> {
    context.about((id, Fact::Access));
    let Some(text) = part.value("AccessType") else {
        // The standard's replacement value for a DOMAIN (CiA 306 4.6.3.2); for anything else it has none.
        if data_type == DataType::Domain && part.key("AccessType").is_none() {
            return Spanned::new(Access::Rw, part.place());
        }
        let place = part.key("AccessType").map_or(part.place(), |entry| entry.key.span);
        let message = format!("{id} has no {}; it is taken as read-only", context.format.key(Key::Access));
        let ro = context.format.set(Key::Access, "ro");
        let help = format!("add {ro}, `wo`, `rw`, `rwr`, `rww` or `const`, as the manual has it");
        context.push(Diagnostic::new(codes::MISSING_ACCESS, place, message).help(help));
        return Spanned::new(Access::Ro, place);
    };
    if let Some(access) = words::access(text, context.diagnostics) {
        return Spanned::new(access, text.span);
    }
    let message = format!("{id}: there is no access type `{}`; it is taken as ro", shorten(text.value));
    let help = "write `ro`, `wo`, `rw`, `rwr`, `rww` or `const`, as the manual has it";
    context.push(Diagnostic::new(codes::UNKNOWN_ACCESS, text.span, message).help(help));
    Spanned::new(Access::Ro, text.span)
}

/// Into which PDOs an entry may be mapped: an EDS says only whether, and the access type into which.
fn mapping(
    part: &Part<'_>,
    id: EntryId,
    access: Access,
    context: &mut Context<'_>,
) -> Option<Spanned<PdoMapping>> {
    context.about((id, Fact::Mapping));
    let text = part.value("PDOMapping")?;
    let number = number::integer(text.value);
    let word = yes_no(text.value).filter(|_| number.is_none());
    let value = number.as_ref().map(|number| number.value).or(word.map(i128::from));
    if !matches!(value, Some(0 | 1)) || word.is_some() {
        let message = format!(
            "{id}: found {}, expected 0 or 1",
            context.format.set(Key::Mapping, &shorten(text.value))
        );
        let mut diagnostic = Diagnostic::new(codes::BAD_FLAG, text.span, message)
            .help(number::help(text.value, "write 0 or 1"));
        let meant = word.map(|word| i128::from(word).to_string());
        diagnostic.edits.extend(meant.map(|meant| Edit { span: text.span, text: meant }));
        context.push(diagnostic);
    }
    if let Some(number) = &number {
        words::report(text, number, context.diagnostics);
    }
    let mapping = match access {
        _ if value != Some(1) => PdoMapping::None,
        Access::Const | Access::Ro | Access::Rwr => PdoMapping::Transmit,
        Access::Wo | Access::Rww => PdoMapping::Receive,
        Access::Rw => PdoMapping::Both,
    };
    Some(Spanned::new(mapping, text.span))
}

/// `ObjFlags`; nothing for the usual 0.
pub(super) fn flags(part: &Part<'_>, id: EntryId, context: &mut Context<'_>) -> Option<Spanned<EdsDecl>> {
    context.about((id, Fact::Eds));
    let text = part.value("ObjFlags")?;
    let read = number::integer(text.value);
    let Some(number) = &read else {
        let message = format!(
            "{id}: found {}, expected a number",
            context.format.set(Key::ObjectFlags, &shorten(text.value))
        );
        context.push(
            Diagnostic::new(codes::BAD_FLAG, text.span, message)
                .help(number::help(text.value, "write 0, 1, 2 or 3")),
        );
        return None;
    };
    words::report(text, number, context.diagnostics);
    let (no_write, no_scan) = (number.value & 1 != 0, number.value & 2 != 0);
    let decl = EdsDecl { default: None, access: None, no_write, no_scan };
    (no_write || no_scan).then_some(Spanned::new(decl, text.span))
}

/// An entry that no section describes.
pub(super) fn made_up(name: &str, data_type: DataType, access: Access, place: Span) -> EntryDecl {
    EntryDecl {
        name: Some(made(name, place)),
        type_name: Some(made(data_type.name(), place)),
        access: Some(Spanned::new(AccessRight { access, locked: false }, place)),
        ..EntryDecl::empty(place)
    }
}

/// A sub-index 0 that no section describes.
pub(super) fn count_of(name: &str, count: u8, access: Access, place: Span) -> EntryDecl {
    EntryDecl {
        default: Some(DefaultDecl::one(made(count.to_string(), place))),
        ..made_up(name, DataType::Unsigned8, access, place)
    }
}
