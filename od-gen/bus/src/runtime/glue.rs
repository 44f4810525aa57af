//! The model's enums as those of `firmware-glue`.

use firmware_glue::table::{Flags, Place};
use firmware_glue::{DataType, Outside, Rounding, Storage};
use od_gen::plan::{self, PlaceKind};
use od_spec::model;

pub(super) const fn data_type(data_type: model::DataType) -> DataType {
    match data_type {
        model::DataType::Boolean => DataType::Boolean,
        model::DataType::Integer8 => DataType::Integer8,
        model::DataType::Integer16 => DataType::Integer16,
        model::DataType::Integer24 => DataType::Integer24,
        model::DataType::Integer32 => DataType::Integer32,
        model::DataType::Integer40 => DataType::Integer40,
        model::DataType::Integer48 => DataType::Integer48,
        model::DataType::Integer56 => DataType::Integer56,
        model::DataType::Integer64 => DataType::Integer64,
        model::DataType::Unsigned8 => DataType::Unsigned8,
        model::DataType::Unsigned16 => DataType::Unsigned16,
        model::DataType::Unsigned24 => DataType::Unsigned24,
        model::DataType::Unsigned32 => DataType::Unsigned32,
        model::DataType::Unsigned40 => DataType::Unsigned40,
        model::DataType::Unsigned48 => DataType::Unsigned48,
        model::DataType::Unsigned56 => DataType::Unsigned56,
        model::DataType::Unsigned64 => DataType::Unsigned64,
        model::DataType::Real32 => DataType::Real32,
        model::DataType::Real64 => DataType::Real64,
        model::DataType::VisibleString => DataType::VisibleString,
        model::DataType::OctetString => DataType::OctetString,
        model::DataType::UnicodeString => DataType::UnicodeString,
        model::DataType::TimeOfDay => DataType::TimeOfDay,
        model::DataType::TimeDifference => DataType::TimeDifference,
        model::DataType::Domain => DataType::Domain,
    }
}

pub(super) const fn outside(outside: model::Outside) -> Outside {
    match outside {
        model::Outside::Saturate => Outside::Saturate,
        model::Outside::Wrap => Outside::Wrap,
        model::Outside::Abort => Outside::Abort,
    }
}

pub(super) const fn rounding(rounding: model::Rounding) -> Rounding {
    match rounding {
        model::Rounding::Down => Rounding::Down,
        model::Rounding::Up => Rounding::Up,
        model::Rounding::Nearest => Rounding::Nearest,
        model::Rounding::Zero => Rounding::Zero,
    }
}

pub(super) const fn storage(storage: model::Storage) -> Storage {
    match storage {
        model::Storage::No => Storage::No,
        model::Storage::Communication => Storage::Communication,
        model::Storage::Application => Storage::Application,
        model::Storage::Manufacturer => Storage::Manufacturer,
        model::Storage::Remanent => Storage::Remanent,
    }
}

pub(super) const fn place(place: PlaceKind) -> Place {
    match place {
        PlaceKind::Image => Place::Image,
        PlaceKind::Constant => Place::Constant,
        PlaceKind::Alias => Place::Alias,
        PlaceKind::Application => Place::Application,
    }
}

pub(super) fn flags(flags: plan::Flags) -> Flags {
    let plan::Flags { read, write, locked, receive, transmit, sparse, only_values } = flags;
    let set = [
        (read, Flags::READ),
        (write, Flags::WRITE),
        (locked, Flags::LOCKED),
        (receive, Flags::RECEIVE),
        (transmit, Flags::TRANSMIT),
        (sparse, Flags::SPARSE),
        (only_values, Flags::ONLY_VALUES),
    ];
    set.into_iter().filter(|(is_set, _)| *is_set).fold(Flags::NONE, |flags, (_, one)| flags.with(one))
}
