//! Tables of parts that no generator has made.

use core::ops::Range;

use crate::table::directory::{APPLICATION, Directory, NUMBERS};
use crate::table::fault::{Fault, TableError};
use crate::table::mapping::{MAPPING, Mapped, RECEIVE, TRANSMIT, width};
use crate::table::stored::at_row;
use crate::table::{Alias, Attributes, EntryRow, Flags, Found, NONE, Parts, Pdo, Place, Row, Storage, Table};
use crate::value::data_type::DataType;

impl<'t> Table<'t> {
    /// A table of parts that a program has made at run time, of an EDS for instance. Everything that another part relies on is
    /// looked at: that lists are sorted, references point at something, values lie within the image and apart from each other,
    /// sizes are those of the types, default mappings say what their parameters do. A table that comes back can be used in every
    /// way, and so can [`generated`](Self::generated) ones, of which the generator makes sure.
    ///
    /// What it cannot know: whether the values of `factory` are within their limits, and what the numbers of conditions mean.
    ///
    /// # Errors
    /// [`TableError`]: the first rule that is broken, and where.
    pub fn checked(parts: Parts<'t>) -> Result<Self, TableError> {
        // Each relies on what those before it have found.
        check_objects(&parts)?;
        check_directory(&parts)?;
        check_lists(&parts)?;
        each(parts.attributes, |shared| check_attributes(&parts, shared))?;
        each(parts.entries, |entry| check_entry(&parts, *entry))?;
        let table = Self::generated(parts);
        each(parts.aliases, |alias| check_alias(&table, alias))?;
        check_sparse(&table)?;
        check_regions(&parts)?;
        check_storage(&table)?;
        check_overlap(&table)?;
        check_node_ids(&table)?;
        check_pdos(&table)?;
        Ok(table)
    }
}

/// A fault, unless something holds.
fn unless(holds: bool, fault: Fault, at: usize) -> Result<(), TableError> {
    if holds { Ok(()) } else { Err(TableError { fault, at }) }
}

/// Checks every item of a list.
fn each<T>(list: &[T], check: impl Fn(&T) -> Result<(), Fault>) -> Result<(), TableError> {
    list.iter().enumerate().try_for_each(|(at, item)| check(item).map_err(|fault| TableError { fault, at }))
}

/// The first position at which a list does not ascend.
fn descent<T: PartialOrd>(list: &[T]) -> Option<usize> {
    list.windows(2).position(|pair| pair.first() >= pair.last()).map(|at| at + 1)
}

fn check_objects(parts: &Parts<'_>) -> Result<(), TableError> {
    unless(parts.entries.len() < usize::from(NONE), Fault::EntryCount, usize::from(NONE))?;
    let ends = parts.objects.last().is_some_and(|end| usize::from(*end) == parts.entries.len());
    unless(parts.objects.first() == Some(&0), Fault::ObjectOrder, 0)?;
    unless(ends, Fault::ObjectOrder, parts.objects.len() - 1)?;
    let is_object = |pair: &[Row]| match pair {
        [first, end] => first < end && end - first <= 256,
        _ => false,
    };
    let wrong = parts.objects.windows(2).position(|pair| !is_object(pair));
    wrong.map_or(Ok(()), |at| unless(false, Fault::ObjectOrder, at))
}

fn check_directory(parts: &Parts<'_>) -> Result<(), TableError> {
    let Directory { blocks, order, .. } = parts.directory;
    let (mut objects, mut before, mut communication) = (0, None, 0);
    for (at, place) in order.iter().enumerate() {
        let block =
            blocks.get(usize::from(*place)).filter(|block| block.present > 0 && block.number < NUMBERS);
        let block =
            block.filter(|block| before < Some(block.number) && usize::from(block.objects) == objects);
        let block = block.ok_or(TableError { fault: Fault::BlockOrder, at })?;
        let found = parts.directory.place(block.number);
        unless(found == Some(usize::from(*place)), Fault::BlockPlace, at)?;
        before = Some(block.number);
        objects += usize::try_from(block.present.count_ones()).unwrap_or_default();
        if block.number < APPLICATION {
            communication = objects;
        }
    }
    let used = blocks.iter().filter(|block| block.present > 0).count();
    let is_all = used == order.len() && objects == parts.objects.len() - 1;
    unless(is_all, Fault::BlockCount, order.len())?;
    let row = parts.objects.get(communication);
    unless(row == Some(&parts.first_application_row), Fault::FirstApplicationRow, 0)
}

fn check_lists(parts: &Parts<'_>) -> Result<(), TableError> {
    each(parts.limits, |limits| if limits.low <= limits.high { Ok(()) } else { Err(Fault::LimitOrder) })?;
    each(parts.values, |list| descent(list).map_or(Ok(()), |_| Err(Fault::ValueOrder)))?;
    unless(parts.granularity <= 64, Fault::Granularity, 0)
}

fn check_attributes(parts: &Parts<'_>, shared: &Attributes) -> Result<(), Fault> {
    let is_sized = match shared.data_type {
        DataType::UnicodeString => shared.size.is_multiple_of(2),
        DataType::VisibleString | DataType::OctetString => true,
        DataType::Domain => shared.size == 0,
        sized => sized.size() == Some(shared.size),
    };
    let is_placed = match shared.place {
        Place::Image | Place::Constant => shared.data_type != DataType::Domain,
        Place::Alias => shared.data_type.is_integer(),
        Place::Application => shared.data_type == DataType::Domain,
    };
    let (limited, listed) = (shared.limits != NONE, shared.values != NONE);
    let is_limited = (!limited || usize::from(shared.limits) < parts.limits.len())
        && (!listed || usize::from(shared.values) < parts.values.len())
        && (listed || !shared.flags.has(Flags::ONLY_VALUES))
        && (!limited || shared.data_type.has_order())
        && (!listed || shared.data_type.is_integer());
    if !is_sized {
        Err(Fault::AttributeSize)
    } else if !is_placed {
        Err(Fault::AttributePlace)
    } else if shared.place == Place::Constant && shared.flags.has(Flags::WRITE) {
        Err(Fault::AttributeAccess)
    } else if !is_limited {
        Err(Fault::AttributeLimits)
    } else {
        Ok(())
    }
}

fn check_entry(parts: &Parts<'_>, entry: EntryRow) -> Result<(), Fault> {
    let shared = parts.attributes.get(usize::from(entry.attributes)).ok_or(Fault::EntryAttributes)?;
    let found = Found::new(0, entry.place, shared);
    let lies = match shared.place {
        Place::Image => found.place_in_image().is_some_and(|bytes| bytes.end <= parts.factory.len()),
        Place::Constant => found.offset() + usize::from(shared.size) <= parts.constants.len(),
        Place::Alias => {
            let alias = parts.aliases.get(usize::from(entry.place)).ok_or(Fault::EntryPlace)?;
            return if alias.view.data_type == shared.data_type { Ok(()) } else { Err(Fault::EntryType) };
        }
        Place::Application => true,
    };
    if lies { Ok(()) } else { Err(Fault::EntryPlace) }
}

fn check_alias(table: &Table<'_>, alias: &Alias) -> Result<(), Fault> {
    let target = table.attributes(alias.target);
    let bits =
        target.data_type.integer_bits().filter(|_| matches!(target.place, Place::Image | Place::Constant));
    let bits = bits.filter(|_| usize::from(alias.target) < table.parts().entries.len());
    let bits = bits.ok_or(Fault::AliasTarget)?;
    let (view, range) = (alias.view, bits - u32::from(target.data_type.is_signed()));
    let largest = 1i128 << range;
    let fits = largest * i128::from(view.numerator) <= 1i128 << 63 && (range < 64);
    let is_scale = view.numerator > 0 && view.denominator > 0;
    let is_narrow = view.data_type.integer_bits().is_some_and(|bits| bits < 64);
    if fits && is_scale && is_narrow { Ok(()) } else { Err(Fault::AliasView) }
}

/// Every object has all its entries marked as sparse, or none.
fn check_sparse(table: &Table<'_>) -> Result<(), TableError> {
    let parts = table.parts();
    let mut sparse = parts.sparse.iter().enumerate().peekable();
    for pair in parts.objects.windows(2) {
        let [first, end] = *pair else { continue };
        let listed = sparse.next_if(|(_, object)| object.first == first);
        if let Some((at, object)) = listed {
            unless(object.subs.len() == usize::from(end - first), Fault::SparseOrder, at)?;
            unless(descent(object.subs).is_none(), Fault::SparseSubs, at)?;
        }
        for row in first..end {
            let marked = table.attributes(row).flags.has(Flags::SPARSE);
            unless(marked == listed.is_some(), Fault::SparseFlag, row.into())?;
        }
    }
    sparse.next().map_or(Ok(()), |(at, _)| unless(false, Fault::SparseOrder, at))
}

fn check_regions(parts: &Parts<'_>) -> Result<(), TableError> {
    let mut end = 0;
    for (at, region) in parts.regions.iter().enumerate() {
        let range = region.range();
        let twice = parts.regions.iter().take(at).any(|before| before.storage == region.storage);
        let ascends = end <= range.start && range.start <= range.end && range.end <= parts.factory.len();
        unless(ascends && !twice && region.storage != Storage::No, Fault::RegionOrder, at)?;
        end = range.end;
    }
    Ok(())
}

/// Values of the image, with their rows.
fn values_in_image<'a>(table: &'a Table<'_>) -> impl Iterator<Item = (Found<'a>, Range<usize>)> {
    let rows = (0..).zip(table.parts().entries);
    rows.map(|(row, _)| table.found(row)).filter_map(|found| Some((found, found.place_in_image()?)))
}

fn check_storage(table: &Table<'_>) -> Result<(), TableError> {
    for (found, bytes) in values_in_image(table) {
        let storage = found.shared.storage;
        let lies = table.parts().regions.iter().all(|region| {
            let part = region.range();
            if region.storage == storage {
                part.start <= bytes.start && bytes.end <= part.end
            } else {
                bytes.is_empty() || bytes.end <= part.start || part.end <= bytes.start
            }
        });
        let is_kept = storage == Storage::No || table.region(storage).is_some();
        unless(lies && is_kept, Fault::EntryStorage, found.row.into())?;
    }
    Ok(())
}

fn check_overlap(table: &Table<'_>) -> Result<(), TableError> {
    /// Bytes that are looked at together: without memory to allocate, a map of all bytes has to be made in pieces.
    const WINDOW: usize = 8192;
    for start in (0..table.parts().factory.len()).step_by(WINDOW) {
        let mut taken = [false; WINDOW];
        for (found, bytes) in values_in_image(table) {
            let within = |at: usize| at.clamp(start, start + WINDOW) - start;
            let place = taken.get_mut(within(bytes.start)..within(bytes.end)).unwrap_or_default();
            unless(!place.contains(&true), Fault::EntryOverlap, found.row.into())?;
            place.fill(true);
        }
    }
    Ok(())
}

fn check_node_ids(table: &Table<'_>) -> Result<(), TableError> {
    let is_entry = |offset: u32, size: u8| {
        values_in_image(table).any(|(found, bytes)| {
            found.shared.data_type.is_integer()
                && u32::try_from(bytes.start) == Ok(offset)
                && bytes.len() == usize::from(size)
        })
    };
    each(table.parts().node_id_places, |place| {
        if is_entry(place.offset, place.size) { Ok(()) } else { Err(Fault::NodeIdPlace) }
    })
}

fn check_pdos(table: &Table<'_>) -> Result<(), TableError> {
    let mut before = 0;
    for (at, pdo) in table.parts().pdos.iter().enumerate() {
        let is_index = matches!(pdo.index, RECEIVE..0x1600 | TRANSMIT..0x1A00) && pdo.index > before;
        unless(is_index, Fault::PdoIndex, at)?;
        before = pdo.index;
        let mapping =
            table.object(pdo.index + MAPPING).map_err(|_| TableError { fault: Fault::PdoRows, at })?;
        let is_row = table.find(pdo.index, 1) == Ok(pdo.cob_id)
            && mapping.start == pdo.mapping
            && !table.attributes(pdo.mapping).flags.has(Flags::SPARSE);
        unless(is_row, Fault::PdoRows, at)?;
        unless(pdo.rows.is_empty() || is_mapped(table, pdo), Fault::PdoMapping, at)?;
    }
    Ok(())
}

/// Whether the mapped rows are those of the mapping parameters after a factory reset.
fn is_mapped(table: &Table<'_>, pdo: &Pdo<'_>) -> bool {
    let default = |row: Row| at_row(table, table.parts().factory, table.found(row));
    let count = u32::try_from(pdo.rows.len()).ok();
    default(pdo.mapping) == count
        && pdo.rows.iter().zip(1..=64u16).all(|(row, sub)| {
            let parameter = table.find(pdo.index + MAPPING, u8::try_from(sub).unwrap_or_default()).ok();
            parameter.and_then(default).map(Mapped::of).is_some_and(|mapped| {
                table.find(mapped.index, mapped.sub) == Ok(*row)
                    && width(table.attributes(*row)) == mapped.bits
            })
        })
        && pdo.rows.len() <= 64
}
