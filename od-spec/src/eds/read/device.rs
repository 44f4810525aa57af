//! `[FileInfo]`, `[DeviceInfo]` and `[DummyUsage]`: what the device is called and can do. Their form is for the rules about the
//! text to judge; what cannot be read counts as not said.

use super::{made, owned};
use crate::ast::{DeviceDecl, FileDecl, Name, ObjectDecl, VendorDecl};
use crate::decode::is_device_key;
use crate::eds::dates::{date, time};
use crate::eds::names::Topic;
use crate::eds::number::lenient_integer;
use crate::eds::view::{Part, View};
use crate::model::{BIT_RATES, DataType, DateTime, Index};
use crate::source::{Span, Spanned};

/// The longest key of a device.
const LONGEST_KEY: usize = 32;

/// The device. Its key is made from the name of the file.
pub(super) fn device(view: &View<'_>, file_name: &str, objects: &[ObjectDecl]) -> DeviceDecl {
    let info = Section::of(view, Topic::DeviceInfo);
    let start = view.start();
    let key = made(key(file_name), start);
    let product_name = info.text("ProductName");
    let name = product_name.clone().unwrap_or_else(|| made(key.value.clone(), start));
    let dummies = Section::of(view, Topic::DummyUsage);
    let is_dummy =
        |data_type: &DataType| dummies.flag(&format!("Dummy{:04X}", data_type.code())).unwrap_or(false);
    let dummy_types = DataType::ALL.into_iter().filter(|data_type| data_type.is_dummy()).filter(is_dummy);
    DeviceDecl {
        name: Some(name),
        about: None,
        gap: None,
        product: info.number("ProductNumber", 0xFFFF_FFFF),
        product_revision: info.number("RevisionNumber", 0xFFFF_FFFF),
        order_code: info.text("OrderCode"),
        bit_rates: BIT_RATES.into_iter().filter_map(|rate| info.bit_rate(rate)).collect(),
        device_type: device_type(objects),
        granularity: Some(info.number("Granularity", 64).unwrap_or(Spanned::new(0, start))),
        boot_up_master: info.yes_no("SimpleBootUpMaster"),
        boot_up_slave: info.yes_no("SimpleBootUpSlave").or(Some(Spanned::new(false, start))),
        group_messaging: info.yes_no("GroupMessaging"),
        lss: info.yes_no("LSS_Supported"),
        dummies: dummy_types.map(|data_type| made(data_type.name(), dummies.place)).collect(),
        dynamic_channels: Vec::new(),
        features: Vec::new(),
        any_error: None,
        canopennode: Vec::new(),
        eds: Some(file(view)),
        eds_defaults: Some(made("all", start)),
        product_name,
        key,
    }
}

/// The maker.
pub(super) fn vendor(view: &View<'_>) -> VendorDecl {
    let info = Section::of(view, Topic::DeviceInfo);
    VendorDecl { name: info.text("VendorName"), number: info.number("VendorNumber", 0xFFFF_FFFF) }
}

fn file(view: &View<'_>) -> FileDecl {
    let info = Section::of(view, Topic::FileInfo);
    let at = |date_key: &str, time_key: &str| {
        let day = info.text(date_key)?;
        let date = date(&day.value)?;
        let time = info.text(time_key).and_then(|text| time(&text.value)).unwrap_or((0, 0));
        Some(Spanned::new(DateTime { date, hour: time.0, minute: time.1 }, day.span))
    };
    FileDecl {
        description: info.text("Description"),
        created: at("CreationDate", "CreationTime"),
        created_by: info.text("CreatedBy"),
        modified: at("ModificationDate", "ModificationTime"),
        modified_by: info.text("ModifiedBy"),
        version: info.number("FileVersion", 0xFF),
        revision: info.number("FileRevision", 0xFF),
        // These are read with everything else that the model has no place for.
        comments: None,
        sections: Vec::new(),
    }
}

/// The default of 1000h, as far as it is a plain number.
fn device_type(objects: &[ObjectDecl]) -> Option<Spanned<i128>> {
    let object = objects.iter().find(|object| object.index.value == Index(0x1000))?;
    let default = object.entry.default.as_ref()?;
    let number = crate::scalar::integer(default.value.text()?).ok()?;
    (0..=0xFFFF_FFFF).contains(&number).then_some(Spanned::new(number, default.span))
}

/// A key made from the name of a file: `Drive_V1.08.eds` gives `drive-v1-08`.
fn key(file_name: &str) -> String {
    let base = crate::eds::file_name(file_name);
    let stem = base.rsplit_once('.').map_or(base, |(stem, _)| stem);
    let plain = stem.to_lowercase().replace(|c: char| !c.is_ascii_alphanumeric(), "-");
    let words: Vec<&str> = plain.split('-').filter(|word| !word.is_empty()).collect();
    let key = words.join("-");
    let short = key.get(..LONGEST_KEY).unwrap_or(&key).trim_end_matches('-');
    if is_device_key(short) { short.to_owned() } else { "device".to_owned() }
}

/// A section that may be missing.
struct Section<'v, 'd> {
    part: Option<&'v Part<'d>>,
    place: Span,
}

impl<'v, 'd> Section<'v, 'd> {
    fn of(view: &'v View<'d>, topic: Topic) -> Self {
        let part = view.section(topic);
        Self { part, place: part.map_or_else(|| view.start(), Part::place) }
    }

    fn text(&self, key: &str) -> Option<Name> {
        self.part?.value(key).map(owned)
    }

    /// A number from 0 to `highest`.
    fn number(&self, key: &str, highest: i128) -> Option<Spanned<i128>> {
        let text = self.part?.value(key)?;
        let number = lenient_integer(text.value).filter(|number| (0..=highest).contains(number))?;
        Some(Spanned::new(number, text.span))
    }

    fn yes_no(&self, key: &str) -> Option<Spanned<bool>> {
        let number = self.number(key, i128::MAX)?;
        Some(number.map(|number| number != 0))
    }

    fn flag(&self, key: &str) -> Option<bool> {
        self.yes_no(key).map(|flag| flag.value)
    }

    fn bit_rate(&self, rate: u16) -> Option<Spanned<i128>> {
        let flag = self.yes_no(&format!("BaudRate_{rate}")).filter(|flag| flag.value)?;
        Some(flag.map(|_| i128::from(rate)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_is_made_from_any_file_name() {
        for (name, expected) in [
            ("drive.eds", "drive"),
            ("dir/Drive_V1.08.EDS", "drive-v1-08"),
            ("605.3150.51-V.eds", "605-3150-51-v"),
            ("C:\\eds\\Größe.eds", "gr-e"),
            (".eds", "device"),
            ("-", "device"),
        ] {
            assert_eq!(key(name), expected, "{name}");
            assert!(is_device_key(expected));
        }
    }
}
