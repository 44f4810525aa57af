//! What PDOs carry by their default mapping, as structures: for the firmware of the other side, and for a device whose mapping does not change.

use od_gen::plan::{PlannedEntry, PlannedField, PlannedPdo};

use super::super::page::Page;
use super::super::text::Text;
use super::accessors::value_type;
use super::inline;
use super::raw::Raw;

/// Bits of a frame.
const FRAME: u32 = 64;

/// A value of a PDO.
struct Field<'p, 'a> {
    planned: &'p PlannedField,
    entry: &'p PlannedEntry<'a>,
    raw: Raw,
}

impl Field<'_, '_> {
    /// The first byte, where the value begins and ends at bytes.
    fn byte(&self) -> Option<u32> {
        let is_whole = self.planned.first_bit.is_multiple_of(8) && self.planned.bits.is_multiple_of(8);
        is_whole.then_some(self.planned.first_bit / 8)
    }

    /// A mask of its bits at the beginning of a frame.
    fn mask(&self) -> String {
        let bits = u32::from(self.planned.bits);
        let mask = if bits >= FRAME { u64::MAX } else { (1 << bits) - 1 };
        format!("0x{mask:X}ULL")
    }

    /// Statements that read it.
    fn unpack(&self, text: &mut Text) {
        let name = &self.planned.name;
        match self.byte() {
            Some(byte) => {
                if let Some(load) = self.raw.load(&format!("&data[{byte}]")) {
                    text.line(&format!("values->{name} = {load};"));
                }
            }
            None => {
                let (first, mask) = (self.planned.first_bit, self.mask());
                if let Some(load) = self.raw.load("&bytes[0]") {
                    text.line(&format!("od_put_u64(bytes, (od_get_u64(data) >> {first}) & {mask});"));
                    text.line(&format!("values->{name} = {load};"));
                }
            }
        }
    }

    /// Statements that write it into a frame of zeros.
    fn pack(&self, text: &mut Text) {
        let value = format!("values->{}", self.planned.name);
        let place = self.byte().map_or_else(|| "&bytes[0]".to_owned(), |byte| format!("&data[{byte}]"));
        let Some(store) = self.raw.store(&place, &value) else { return };
        if self.byte().is_none() {
            let (first, mask) = (self.planned.first_bit, self.mask());
            text.line("od_put_u64(bytes, 0U);");
            text.line(&store);
            text.line(&format!(
                "od_put_u64(data, od_get_u64(data) | ((od_get_u64(bytes) & {mask}) << {first}));"
            ));
        } else {
            text.line(&store);
        }
    }
}

/// Structures of all PDOs that carry something.
pub(super) fn pdos(page: &mut Page<'_, '_>) {
    let plan = page.plan;
    let is_shown = |pdo: &&PlannedPdo<'_>| !pdo.fields.is_empty() && pdo.bits <= FRAME;
    for (at, planned) in plan.pdos.iter().filter(is_shown).enumerate() {
        if at == 0 {
            page.text.gap();
            page.text.comment(
                "PDOs by their default mapping, for the other side and for where no mapping changes: a structure, and what puts it into a frame and takes it out.",
            );
        }
        pdo(page, planned);
    }
}

fn pdo(page: &mut Page<'_, '_>, planned: &PlannedPdo<'_>) {
    let plan = page.plan;
    let fields: Option<Vec<Field<'_, '_>>> = planned
        .fields
        .iter()
        .map(|field| {
            let entry = plan.entry(field.row)?;
            let raw = Raw::of(plan, &entry.kind);
            // A part of a value is no value.
            let is_whole = raw.bits() == Some(field.bits.into());
            is_whole.then_some(Field { planned: field, entry, raw })
        })
        .collect();
    let Some(fields) = fields else { return };
    let direction = planned.pdo.direction.pdo();
    let name = format!("{}_{}", direction.to_lowercase(), planned.pdo.number);
    let what = format!("{direction} {}", planned.pdo.number);
    let structure = page.names.type_of(&name);
    page.enter(&structure, &what);
    page.text.gap();
    page.text.doc(&format!("What {what} carries."));
    let types: Vec<String> =
        fields.iter().map(|field| value_type(page, &field.entry.kind, field.raw)).collect();
    page.text.block("typedef struct {", &format!("}} {structure};"), |text| {
        for (field, of) in fields.iter().zip(types) {
            text.doc(&format!("{} {}.", field.entry.id, field.entry.entry.name));
            text.line(&format!("{of} {};", field.planned.name));
        }
    });
    page.text.doc(&format!("Bytes of {what}."));
    page.define(&[&name, "LENGTH"], &format!("({}U)", planned.bits.div_ceil(8)), &what);
    let needs_bytes = fields.iter().any(|field| field.byte().is_none());
    let unpack = page.names.function(&[&name, "unpack"]);
    page.enter(&unpack, &what);
    inline(
        &mut page.text,
        "void",
        &unpack,
        &[&format!("{structure} *values"), "const uint8_t data[8]"],
        |text| {
            if needs_bytes {
                text.line("uint8_t bytes[8];");
            }
            for field in &fields {
                field.unpack(text);
            }
        },
    );
    let pack = page.names.function(&[&name, "pack"]);
    page.enter(&pack, &what);
    inline(
        &mut page.text,
        "void",
        &pack,
        &[&format!("const {structure} *values"), "uint8_t data[8]"],
        |text| {
            if needs_bytes {
                text.line("uint8_t bytes[8];");
            }
            text.line("od_put_u64(data, 0U);");
            for field in &fields {
                field.pack(text);
            }
        },
    );
}
