//! Access to a dictionary by index and sub-index: what an SDO server needs.

use core::fmt::Debug;

use crate::abort::AbortCode;
use crate::application::Application;
use crate::communication;
use crate::table::{Attributes, DataType, Flags, Found, NONE, Place, Region, Row, Storage, Table};
use crate::value::{Value, number, prefix, trimmed};

/// A dictionary: values in a byte image, everything else in a constant table. The generator implements the required part;
/// the rest follows.
pub trait Dictionary: Sized {
    /// Every entry, by name.
    type Entry: Copy + Eq + Debug + 'static;

    /// What every entry is.
    const TABLE: &'static Table;

    /// The entry of a row; `None` beyond the table.
    fn entry(row: Row) -> Option<Self::Entry>;

    /// The row of an entry.
    fn row(entry: Self::Entry) -> Row;

    /// The values.
    fn image(&self) -> &[u8];

    /// The values, to be changed. No check stands between the caller and the bytes.
    fn image_mut(&mut self) -> &mut [u8];

    /// Whether the write condition of this number holds now.
    fn condition(&self, number: u16) -> bool;

    /// The entry at an index and sub-index.
    ///
    /// # Errors
    /// [`AbortCode::NO_OBJECT`], [`AbortCode::NO_SUB_INDEX`].
    #[inline]
    fn find(index: u16, sub: u8) -> Result<Self::Entry, AbortCode> {
        let row = Self::TABLE.find(index, sub)?;
        Self::entry(row).ok_or(AbortCode::INTERNAL)
    }

    /// What is known about an entry.
    #[inline]
    fn info(entry: Self::Entry) -> Info {
        Info { table: Self::TABLE, row: Self::row(entry), shared: Self::TABLE.attributes(Self::row(entry)) }
    }

    /// The value of an entry, as an SDO client reads it.
    ///
    /// # Errors
    /// That it does not exist; [`AbortCode::WRITE_ONLY`]; [`AbortCode::NO_DATA`] for an entry of the error history that is
    /// not filled; [`AbortCode::UNSUPPORTED_ACCESS`] for a DOMAIN, which the application has
    /// ([`upload_domain`](Self::upload_domain)); what an alias says about a value that it cannot show.
    #[inline]
    fn read(&self, index: u16, sub: u8) -> Result<Value<'_>, AbortCode> {
        let found = Self::TABLE.lookup(index, sub)?;
        if !found.shared.flags.has(Flags::READ) {
            return Err(AbortCode::WRITE_ONLY);
        }
        if index == 0x1003 && sub > 0 {
            communication::history_has(Self::TABLE, self.image(), sub)?;
        }
        value_of(Self::TABLE, self.image(), found)
    }

    /// [`read`](Self::read), after the application had the chance to bring the value up to date.
    fn upload<A: Application<Self>>(
        &mut self,
        index: u16,
        sub: u8,
        application: &mut A,
    ) -> Result<Value<'_>, AbortCode> {
        let row = Self::TABLE.find(index, sub)?;
        if let (Some(entry), true) = (Self::entry(row), Self::TABLE.attributes(row).flags.has(Flags::READ)) {
            application.refresh(self, Self::entry(holder(Self::TABLE, row)).unwrap_or(entry));
        }
        self.read(index, sub)
    }

    /// Writes an entry as an SDO client does. The checks come in the order of CiA 301's servers: the entry exists, its
    /// access and lock, the length, the value (type, limits, values of an enum; of an alias, also those of its target), rules
    /// of the communication objects, the write condition, the application's veto. A refused write changes nothing.
    ///
    /// Returns the entry that has a new value: of an alias, its target. A signature written to 1010h or 1011h is a command
    /// and no value: the application carries it out in [`Application::accept`], and nothing is stored.
    ///
    /// # Errors
    /// The abort code for the client.
    fn write<A: Application<Self>>(
        &mut self,
        index: u16,
        sub: u8,
        data: &[u8],
        application: &mut A,
    ) -> Result<Self::Entry, AbortCode> {
        let found = Self::TABLE.lookup(index, sub)?;
        if !found.shared.flags.has(Flags::WRITE) {
            return Err(AbortCode::READ_ONLY);
        }
        write_row(self, found, data, application)
    }

    /// Reads a DOMAIN from an offset on, from the application; returns the number of bytes, 0 at its end.
    ///
    /// # Errors
    /// That it does not exist, [`AbortCode::WRITE_ONLY`], [`AbortCode::UNSUPPORTED_ACCESS`] for an entry that is none, what
    /// the application says.
    fn upload_domain<A: Application<Self>>(
        &mut self,
        index: u16,
        sub: u8,
        offset: u32,
        buffer: &mut [u8],
        application: &mut A,
    ) -> Result<usize, AbortCode> {
        let entry = domain::<Self>(index, sub, Flags::READ, AbortCode::WRITE_ONLY)?;
        application.read_domain(self, entry, offset, buffer)
    }

    /// Gives a part of a DOMAIN to the application; `last` tells that it is complete.
    ///
    /// # Errors
    /// That it does not exist, its access, lock and write condition, what the application says.
    fn download_domain<A: Application<Self>>(
        &mut self,
        index: u16,
        sub: u8,
        offset: u32,
        data: &[u8],
        last: bool,
        application: &mut A,
    ) -> Result<(), AbortCode> {
        let entry = domain::<Self>(index, sub, Flags::WRITE, AbortCode::READ_ONLY)?;
        let shared = Self::TABLE.attributes(Self::row(entry));
        check_lock::<Self, A>(shared, application)?;
        check_condition(self, shared)?;
        application.write_domain(self, entry, offset, data, last)
    }

    /// Puts every value back to the one after a factory reset, for a node-ID.
    fn reset(&mut self, node_id: u8) {
        let whole = Region { storage: Storage::No, start: 0, end: u32::MAX, layout: 0 };
        reset_region(self, &whole, node_id);
    }

    /// Puts the values of one storage group back, as "restore defaults" (1011h) does.
    fn reset_stored(&mut self, storage: Storage, node_id: u8) {
        if let Some(region) = Self::TABLE.region(storage) {
            reset_region(self, region, node_id);
        }
    }

    /// The bytes that a "store parameters" command saves: 1010h.2 the communication parameters, .3 the application
    /// parameters, .4 the manufacturer's, .1 all of them.
    fn stored(&self, storage: Storage) -> &[u8] {
        Self::TABLE.region(storage).and_then(|region| self.image().get(bounds(region))).unwrap_or_default()
    }

    /// Takes back bytes that [`stored`](Self::stored) gave, with the number that [`layout`](Self::layout) had then; `false`,
    /// and no change, if they are not of this layout. The values themselves are not checked: keep a checksum beside them.
    /// Entries that follow the node-ID come back as they were saved.
    #[must_use]
    fn restore(&mut self, storage: Storage, layout: u32, bytes: &[u8]) -> bool {
        let Some(region) = Self::TABLE.region(storage) else { return false };
        match self.image_mut().get_mut(bounds(region)) {
            Some(place) if place.len() == bytes.len() && region.layout == layout => {
                place.copy_from_slice(bytes);
                true
            }
            _ => false,
        }
    }

    /// A number that changes whenever another set of entries, types or places is stored in a group.
    fn layout(storage: Storage) -> u32 {
        Self::TABLE.region(storage).map_or(0, |region| region.layout)
    }
}

fn bounds(region: &Region) -> core::ops::Range<usize> {
    let place = |offset: u32| usize::try_from(offset).unwrap_or(usize::MAX);
    place(region.start)..place(region.end)
}

fn reset_region<D: Dictionary>(dictionary: &mut D, region: &Region, node_id: u8) {
    let part = bounds(region);
    let image = dictionary.image_mut();
    for (at, (byte, factory)) in image.iter_mut().zip(D::TABLE.factory).enumerate() {
        if part.contains(&at) {
            *byte = *factory;
        }
    }
    for place in D::TABLE.node_id_places {
        let at = usize::try_from(place.offset).unwrap_or(usize::MAX);
        if part.contains(&at) {
            crate::image::add(image, at, place.size.into(), node_id);
        }
    }
}

/// The row that holds the value: of an alias, its target's.
pub(crate) fn holder(table: &Table, row: Row) -> Row {
    match table.attributes(row).place {
        Place::Alias => table.alias(row).map_or(row, |alias| alias.target),
        _ => row,
    }
}

/// The value of an entry, whatever its access.
#[inline]
pub(crate) fn value_of<'a>(
    table: &'static Table,
    image: &'a [u8],
    found: Found,
) -> Result<Value<'a>, AbortCode> {
    let shared = found.shared;
    let bytes = match shared.place {
        Place::Image => image,
        Place::Constant => table.constants,
        Place::Alias => return alias_value(table, image, found.row),
        Place::Application => return Err(AbortCode::UNSUPPORTED_ACCESS),
    };
    let at = found.offset();
    if shared.data_type.is_string() && shared.place == Place::Image {
        return string_value(bytes, at, shared);
    }
    let bytes = bytes.get(at..at + usize::from(shared.size)).ok_or(AbortCode::INTERNAL)?;
    Ok(Value::of(bytes))
}

#[inline(never)]
fn string_value<'a>(bytes: &'a [u8], at: usize, shared: &Attributes) -> Result<Value<'a>, AbortCode> {
    let size = usize::from(shared.size) + prefix(shared.data_type);
    let bytes = bytes.get(at..at + size).ok_or(AbortCode::INTERNAL)?;
    Ok(Value::of(trimmed(shared.data_type, bytes)))
}

#[inline(never)]
fn alias_value(table: &'static Table, image: &[u8], row: Row) -> Result<Value<'static>, AbortCode> {
    let alias = table.alias(row).ok_or(AbortCode::INTERNAL)?;
    let target = table.found(alias.target);
    let number = number(target.shared.data_type, &value_of(table, image, target)?);
    Ok(Value::computed(alias.view.show(number)?, table.attributes(row).size))
}

fn domain<D: Dictionary>(index: u16, sub: u8, flag: u8, refusal: AbortCode) -> Result<D::Entry, AbortCode> {
    let entry = D::find(index, sub)?;
    let shared = D::TABLE.attributes(D::row(entry));
    if !shared.flags.has(flag) {
        Err(refusal)
    } else if shared.place != Place::Application {
        Err(AbortCode::UNSUPPORTED_ACCESS)
    } else {
        Ok(entry)
    }
}

/// The service lock; an alias of a locked entry is locked, too.
fn check_lock<D: Dictionary, A: Application<D>>(
    shared: &Attributes,
    application: &A,
) -> Result<(), AbortCode> {
    let locked = shared.flags.has(Flags::LOCKED) && !application.is_unlocked();
    if locked { Err(AbortCode::DEVICE_STATE) } else { Ok(()) }
}

/// The write condition.
fn check_condition<D: Dictionary>(dictionary: &D, shared: &Attributes) -> Result<(), AbortCode> {
    let open = shared.condition == NONE || dictionary.condition(shared.condition);
    if open { Ok(()) } else { Err(AbortCode::DEVICE_STATE) }
}

/// Checks and writes the value of an entry whose access is settled.
pub(crate) fn write_row<D: Dictionary, A: Application<D>>(
    dictionary: &mut D,
    found: Found,
    data: &[u8],
    application: &mut A,
) -> Result<D::Entry, AbortCode> {
    check_lock::<D, A>(found.shared, application)?;
    check_value(D::TABLE, found.shared, data)?;
    let mut buffer = [0; 8];
    let (holder, data) = match found.shared.place {
        Place::Image => (found, data),
        Place::Constant => return Err(AbortCode::READ_ONLY),
        Place::Application => return Err(AbortCode::UNSUPPORTED_ACCESS),
        Place::Alias => aliased(D::TABLE, found, data, &mut buffer)?,
    };
    let store = holder.row >= D::TABLE.first_application_row
        || communication::check_row(D::TABLE, dictionary.image(), holder.row, data)?;
    check_condition(dictionary, found.shared)?;
    if holder.row != found.row {
        check_condition(dictionary, holder.shared)?;
    }
    let entry = D::entry(holder.row).ok_or(AbortCode::INTERNAL)?;
    application.accept(dictionary, entry, data)?;
    if store {
        put(dictionary.image_mut(), holder, data)?;
        application.changed(dictionary, entry);
    }
    Ok(entry)
}

/// What the target of an alias gets.
#[inline(never)]
fn aliased<'a>(
    table: &'static Table,
    found: Found,
    data: &[u8],
    buffer: &'a mut [u8; 8],
) -> Result<(Found, &'a [u8]), AbortCode> {
    let alias = table.alias(found.row).ok_or(AbortCode::INTERNAL)?;
    let holder = table.found(alias.target);
    let target = holder.shared;
    *buffer = alias.view.target(number(found.shared.data_type, data))?.to_le_bytes();
    let (value, rest) = buffer.split_at(usize::from(target.size).min(8));
    let negative = target.data_type.is_signed() && value.last().is_some_and(|last| last & 0x80 != 0);
    let sign = if negative { 0xFF } else { 0 };
    if rest.iter().any(|byte| *byte != sign) {
        return Err(AbortCode::INVALID_VALUE);
    }
    check_value(table, target, value)?;
    Ok((holder, value))
}

fn check_value(table: &Table, shared: &Attributes, data: &[u8]) -> Result<(), AbortCode> {
    let size = usize::from(shared.size);
    if shared.place == Place::Application {
        return Err(AbortCode::UNSUPPORTED_ACCESS);
    }
    if data.len() > size {
        return Err(AbortCode::TOO_LONG);
    }
    if shared.data_type.is_string() {
        return check_text(shared.data_type, data);
    }
    if data.len() < size {
        return Err(AbortCode::TOO_SHORT);
    }
    if shared.data_type == DataType::Boolean && data.iter().any(|byte| *byte > 1) {
        return Err(AbortCode::INVALID_VALUE);
    }
    if shared.limits == NONE && shared.values == NONE {
        return Ok(());
    }
    check_number(table, shared, data)
}

fn check_number(table: &Table, shared: &Attributes, data: &[u8]) -> Result<(), AbortCode> {
    let number = number(shared.data_type, data);
    let listed =
        table.values.get(usize::from(shared.values)).is_some_and(|list| list.binary_search(&number).is_ok());
    if listed {
        return Ok(());
    }
    if shared.flags.has(Flags::ONLY_VALUES) {
        return Err(AbortCode::INVALID_VALUE);
    }
    match table.limits.get(usize::from(shared.limits)) {
        Some(limits) if number > limits.high => Err(AbortCode::TOO_HIGH),
        Some(limits) if number < limits.low => Err(AbortCode::TOO_LOW),
        _ => Ok(()),
    }
}

/// A VISIBLE_STRING holds 20h to 7Eh, a UNICODE_STRING whole units; zeros may pad both, but stand between no characters, as
/// what is behind them would be lost.
fn check_text(data_type: DataType, data: &[u8]) -> Result<(), AbortCode> {
    if data_type == DataType::OctetString {
        return Ok(());
    }
    if data_type == DataType::UnicodeString && data.len() % 2 == 1 {
        return Err(AbortCode::LENGTH);
    }
    let Some((text, padding)) = data.split_at_checked(trimmed(data_type, data).len()) else {
        return Err(AbortCode::INTERNAL);
    };
    let printable = |byte: &u8| data_type != DataType::VisibleString || (0x20..=0x7E).contains(byte);
    let fine = text.iter().all(printable) && padding.iter().all(|byte| *byte == 0);
    if fine { Ok(()) } else { Err(AbortCode::INVALID_VALUE) }
}

#[inline]
fn put(image: &mut [u8], holder: Found, data: &[u8]) -> Result<(), AbortCode> {
    let at = holder.offset();
    if holder.shared.data_type.is_string() {
        let size = usize::from(holder.shared.size) + prefix(holder.shared.data_type);
        let place = image.get_mut(at..at + size).ok_or(AbortCode::INTERNAL)?;
        store_string(place, holder.shared.data_type, data);
        return Ok(());
    }
    let place = image.get_mut(at..at + data.len()).ok_or(AbortCode::INTERNAL)?;
    copy(place, data);
    Ok(())
}

/// Copies bytes of the same number: a call of `memcpy` takes longer than the copy of a small number.
#[inline]
fn copy(place: &mut [u8], data: &[u8]) {
    let done =
        copy_exactly::<4>(place, data) || copy_exactly::<2>(place, data) || copy_exactly::<1>(place, data);
    if !done {
        place.iter_mut().zip(data).for_each(|(byte, new)| *byte = *new);
    }
}

#[inline]
fn copy_exactly<const N: usize>(place: &mut [u8], data: &[u8]) -> bool {
    match (<&mut [u8; N]>::try_from(place), <&[u8; N]>::try_from(data)) {
        (Ok(place), Ok(data)) => {
            *place = *data;
            true
        }
        _ => false,
    }
}

/// Puts a string that fits into its place, padded with zeros.
#[inline(never)]
pub(crate) fn store_string(place: &mut [u8], data_type: DataType, data: &[u8]) {
    let length = u16::try_from(data.len()).unwrap_or_default().to_le_bytes();
    let (head, rest) = place.split_at_mut(prefix(data_type).min(place.len()));
    head.iter_mut().zip(length).for_each(|(byte, new)| *byte = new);
    let (text, padding) = rest.split_at_mut(data.len().min(rest.len()));
    text.iter_mut().zip(data).for_each(|(byte, new)| *byte = *new);
    padding.fill(0);
}

/// What is known about an entry, read from the table in flash.
#[derive(Debug, Clone, Copy)]
pub struct Info {
    table: &'static Table,
    row: Row,
    shared: &'static Attributes,
}

impl Info {
    /// Index and sub-index.
    pub fn id(&self) -> (u16, u8) {
        self.table.id(self.row)
    }

    /// Data type.
    pub const fn data_type(&self) -> DataType {
        self.shared.data_type
    }

    /// Bytes of a value; of a string, the most that it can have; 0 of a DOMAIN.
    pub const fn size(&self) -> u16 {
        self.shared.size
    }

    /// Whether an SDO client can read it.
    pub const fn is_readable(&self) -> bool {
        self.shared.flags.has(Flags::READ)
    }

    /// Whether an SDO client can write it (in some state of the device).
    pub const fn is_writable(&self) -> bool {
        self.shared.flags.has(Flags::WRITE)
    }

    /// Whether it can be written only while the device is unlocked for service.
    pub const fn is_locked(&self) -> bool {
        self.shared.flags.has(Flags::LOCKED)
    }

    /// Whether RPDOs can carry it.
    pub const fn is_receivable(&self) -> bool {
        self.shared.flags.has(Flags::RECEIVE)
    }

    /// Whether TPDOs can carry it.
    pub const fn is_transmittable(&self) -> bool {
        self.shared.flags.has(Flags::TRANSMIT)
    }

    /// What keeps its value over power-off.
    pub const fn storage(&self) -> Storage {
        self.shared.storage
    }

    /// Whether it is a view of another entry.
    pub const fn is_alias(&self) -> bool {
        matches!(self.shared.place, Place::Alias)
    }

    /// Smallest and largest value that can be written, where there are limits. Of UNSIGNED64, the numbers minus 2^63.
    pub fn limits(&self) -> Option<(i64, i64)> {
        self.table.limits.get(usize::from(self.shared.limits)).map(|limits| (limits.low, limits.high))
    }
}
