//! What a device says about itself: facts for `[DeviceInfo]` and `[FileInfo]` of its EDS.

use super::numbers::{to_u8, to_u16, to_u32};
use super::scope::unknown;
use super::types::words;
use crate::ast::{AnyErrorDecl, ChannelDecl, DeviceDecl, Name, Words};
use crate::diag::{Diagnostics, codes};
use crate::model::{
    AnyError, DataType, Date, DateTime, DeviceInfo, DynamicChannel, Fact, Facts, FileInfo, Statement, Vendor,
};
use crate::order::Arrange as _;
use crate::source::{Span, Spanned};

/// An EDS must have dates; a specification without them gets a fixed one, so that output never depends on the day.
const EPOCH: DateTime = DateTime { date: Date { year: 2000, month: 1, day: 1 }, hour: 0, minute: 0 };

/// Where the facts about a device are written.
pub(super) fn facts(device: &DeviceDecl) -> Facts {
    let rates = device.bit_rates.iter().map(|rate| rate.span).reduce(Span::to);
    let granularity = device.granularity.map(|granularity| granularity.span);
    let number = |number: &Option<Spanned<i128>>| number.as_ref().map(|number| number.span);
    let stated = [
        (Fact::BitRates, rates),
        (Fact::Granularity, granularity),
        (Fact::Product, number(&device.product)),
        (Fact::ProductRevision, number(&device.product_revision)),
        (Fact::DeviceType, number(&device.device_type)),
        (Fact::DynamicChannels, device.dynamic_channels.iter().map(|one| one.range.span).reduce(Span::to)),
    ];
    let written =
        |(fact, span): (Fact, Option<Span>)| Some((fact, Statement::written(span?, device.key.span.file)));
    stated.into_iter().filter_map(written).collect()
}

/// What holds for every error of the device.
pub(super) fn any_error(device: &DeviceDecl) -> AnyError {
    let said = |field: fn(&AnyErrorDecl) -> &Words| device.any_error.as_ref().map(|any| words(field(any)));
    AnyError {
        shown: said(|any| &any.shown).unwrap_or_default(),
        reaction: said(|any| &any.reaction).unwrap_or_default(),
        reset: said(|any| &any.reset).unwrap_or_default(),
    }
}

/// Facts for `[DeviceInfo]`.
pub(super) fn info(device: &DeviceDecl, diagnostics: &mut Diagnostics) -> DeviceInfo {
    let text = |name: &Option<Name>| name.as_ref().map(|name| name.value.clone());
    let number = |value: &Option<Spanned<i128>>| value.as_ref().map_or(0, |value| to_u32(value.value));
    let flag = |value: &Option<Spanned<bool>>, unless: bool| value.as_ref().map_or(unless, |v| v.value);
    let product_name = text(&device.product_name).or_else(|| text(&device.name)).unwrap_or_default();
    // A number outside the key's range was refused where it was read.
    let readable = device.bit_rates.iter().filter(|rate| (10..=1000).contains(&rate.value));
    let mut bit_rates: Vec<u16> = readable.map(|rate| to_u16(rate.value)).collect();
    bit_rates.sort_unstable();
    bit_rates.dedup();
    let mut dummies = Vec::new();
    for name in &device.dummies {
        match DataType::from_name(&name.value).filter(|data_type| data_type.is_dummy()) {
            Some(data_type) => dummies.push(data_type),
            None => {
                let known = DataType::ALL.into_iter().filter(|t| t.is_dummy()).map(DataType::name);
                let otherwise = "placeholders are boolean, integer8/16/32 and unsigned8/16/32";
                unknown(codes::UNKNOWN_TYPE, name, "placeholder type", known, otherwise, diagnostics);
            }
        }
    }
    dummies.arrange_by_key(|data_type| data_type.code());
    dummies.dedup();
    DeviceInfo {
        order_code: text(&device.order_code).unwrap_or_else(|| product_name.clone()),
        product_name,
        product: number(&device.product),
        product_revision: number(&device.product_revision),
        bit_rates,
        device_type: number(&device.device_type),
        granularity: device.granularity.as_ref().map_or(8, |value| to_u8(value.value)),
        boot_up_master: flag(&device.boot_up_master, false),
        boot_up_slave: flag(&device.boot_up_slave, true),
        group_messaging: flag(&device.group_messaging, false),
        lss: flag(&device.lss, false),
        dummies,
        dynamic_channels: channels(&device.dynamic_channels, diagnostics),
    }
}

/// The segments at which a PLC may create network variables. What is missing or no number was refused where it was read.
fn channels(list: &[ChannelDecl], diagnostics: &mut Diagnostics) -> Vec<DynamicChannel> {
    let mut channels = Vec::new();
    for decl in list {
        let Some(name) = &decl.type_name else { continue };
        let Some(data_type) = DataType::from_name(&name.value) else {
            let known = DataType::ALL.into_iter().map(DataType::name);
            let otherwise = "write a data type of CiA 301, such as `unsigned8`";
            unknown(codes::UNKNOWN_TYPE, name, "data type", known, otherwise, diagnostics);
            continue;
        };
        let (Some(access), Some(offset)) = (&decl.access, &decl.offset) else { continue };
        channels.push(DynamicChannel {
            first: decl.range.value.first,
            last: decl.range.value.last,
            data_type,
            access: access.value,
            offset: to_u32(offset.value),
            difference: decl.difference.map(|difference| to_u32(difference.value)),
        });
    }
    channels
}

/// Facts for `[FileInfo]`.
pub(super) fn file(device: &DeviceDecl, vendor: &Vendor) -> FileInfo {
    let eds = device.eds.as_ref();
    let text = |name: Option<&Name>| name.map(|name| name.value.clone());
    let created = eds.and_then(|eds| eds.created).map_or(EPOCH, |created| created.value);
    let created_by = text(eds.and_then(|eds| eds.created_by.as_ref())).unwrap_or_else(|| vendor.name.clone());
    FileInfo {
        description: text(eds.and_then(|eds| eds.description.as_ref()))
            .or_else(|| text(device.name.as_ref()))
            .unwrap_or_default(),
        created,
        modified: eds.and_then(|eds| eds.modified).map_or(created, |modified| modified.value),
        modified_by: text(eds.and_then(|eds| eds.modified_by.as_ref())).unwrap_or_else(|| created_by.clone()),
        created_by,
        version: eds.and_then(|eds| eds.version).map_or(1, |version| to_u8(version.value)),
        revision: eds.and_then(|eds| eds.revision).map_or(0, |revision| to_u8(revision.value)),
    }
}

/// What a library says about the device that will use it: nothing.
pub(super) const fn none() -> DeviceInfo {
    DeviceInfo {
        product_name: String::new(),
        product: 0,
        product_revision: 0,
        order_code: String::new(),
        bit_rates: Vec::new(),
        device_type: 0,
        granularity: 0,
        boot_up_master: false,
        boot_up_slave: false,
        group_messaging: false,
        lss: false,
        dummies: Vec::new(),
        dynamic_channels: Vec::new(),
    }
}

/// What a library says about the EDS of the device that will use it: nothing.
pub(super) const fn no_file() -> FileInfo {
    FileInfo {
        description: String::new(),
        created: EPOCH,
        created_by: String::new(),
        modified: EPOCH,
        modified_by: String::new(),
        version: 1,
        revision: 0,
    }
}
