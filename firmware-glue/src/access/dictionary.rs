//! Access to a dictionary by index and sub-index: what an SDO server needs.

use crate::abort::AbortCode;
use crate::access::application::Application;
use crate::access::application::Entries;
use crate::access::check::check_value;
use crate::access::communication;
use crate::access::communication::Before;
use crate::access::communication::Effect;
use crate::access::corrected::correct;
use crate::table::entry::Info;
use crate::table::stored::{put, reset, value_of};
use crate::table::{Alias, Attributes, Flags, Found, NONE, Place, Region, Row, Storage, Table};
use crate::value::Value;
use crate::value::image;
use crate::value::number::number;

/// A dictionary: values in a byte image, everything else in a table that lives for `'t`, of generated code for `'static`. The
/// generator implements the required part (and [`TableDictionary`](crate::TableDictionary) does, for tables made at run time);
/// the rest follows.
///
/// ```
/// use firmware_glue::table::{Attributes, Block, Directory, EntryRow, Flags, Limits, NONE, Parts, Place};
/// use firmware_glue::{AbortCode, DataType, Dictionary, EntryId, Storage, Table, TableDictionary};
///
/// // 2000h "set pressure": UNSIGNED16, rw, 0 to 160, default 25. The generator makes this of a specification.
/// const SET_PRESSURE: Attributes = Attributes {
///     data_type: DataType::Unsigned16,
///     flags: Flags::READ.with(Flags::WRITE),
///     place: Place::Image,
///     storage: Storage::No,
///     page: 0,
///     size: 2,
///     limits: 0,
///     values: NONE,
///     condition: NONE,
/// };
/// let (mut blocks, mut seeds, mut order) = ([Block::FREE; 1], [0; 1], [0; 1]);
/// let directory = Directory::arrange(&[0x2000], &mut blocks, &mut seeds, &mut order);
/// let table = Table::checked(Parts {
///     directory: directory.ok_or("there is a block for each object")?,
///     objects: &[0, 1],
///     entries: &[EntryRow { attributes: 0, place: 0 }],
///     attributes: &[SET_PRESSURE],
///     limits: &[Limits { low: 0, high: 160 }],
///     factory: &[25, 0],
///     ..Parts::EMPTY
/// })?;
/// let mut dictionary = TableDictionary::new(&table, [0; 2], 1)?;
///
/// assert_eq!(*dictionary.read(0x2000, 0)?, [25, 0]);
/// assert_eq!(dictionary.write(0x2000, 0, &[120, 0], &mut ()), Ok(EntryId { index: 0x2000, sub: 0 }));
/// assert_eq!(dictionary.write(0x2000, 0, &[161, 0], &mut ()), Err(AbortCode::TOO_HIGH));
/// assert_eq!(dictionary.write(0x2000, 0, &[120], &mut ()), Err(AbortCode::TOO_SHORT));
/// assert_eq!(*dictionary.read(0x2000, 0)?, [120, 0]);
/// assert_eq!(dictionary.read(0x2001, 0).unwrap_err(), AbortCode::NO_OBJECT);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub trait Dictionary<'t>: Entries {
    /// What every entry is.
    fn table(&self) -> &'t Table<'t>;

    /// The entry of a row; `None` beyond the table.
    fn entry(&self, row: Row) -> Option<Self::Entry>;

    /// The row of an entry.
    fn row(&self, entry: Self::Entry) -> Row;

    /// The values.
    fn image(&self) -> &[u8];

    /// The values, to be changed. No check is between the caller and the bytes.
    fn image_mut(&mut self) -> &mut [u8];

    /// Whether the write condition of this number holds now.
    fn condition(&self, number: u16) -> bool;

    /// Whether the device is an LSS slave. Of a generated dictionary, its specification decides; the [`Node`](crate::Node) of a device
    /// without LSS does not answer an LSS master.
    #[inline]
    fn is_lss_slave(&self) -> bool {
        true
    }

    /// The entry at an index and sub-index.
    ///
    /// # Errors
    /// [`AbortCode::NO_OBJECT`], [`AbortCode::NO_SUB_INDEX`].
    #[inline]
    fn find(&self, index: u16, sub: u8) -> Result<Self::Entry, AbortCode> {
        let row = self.table().find(index, sub)?;
        self.entry(row).ok_or(AbortCode::INTERNAL)
    }

    /// What is known about an entry.
    #[inline]
    fn info(&self, entry: Self::Entry) -> Info<'t> {
        Info::new(self.table(), self.row(entry))
    }

    /// What is known about the entry at an index and sub-index: what a server asks first, in one search.
    ///
    /// # Errors
    /// As [`find`](Self::find).
    #[inline]
    fn info_at(&self, index: u16, sub: u8) -> Result<Info<'t>, AbortCode> {
        let table = self.table();
        table.lookup(index, sub).map(|found| Info::of(table, found))
    }

    /// The value of an entry, as an SDO client reads it.
    ///
    /// # Errors
    /// That it does not exist; [`AbortCode::WRITE_ONLY`]; [`AbortCode::NO_DATA`] for an entry of the error history that is
    /// not filled; [`AbortCode::UNSUPPORTED_ACCESS`] for a DOMAIN, which the application has
    /// ([`upload_domain`](Self::upload_domain)); what an alias says about a value that it cannot show.
    #[inline]
    fn read<'v>(&'v self, index: u16, sub: u8) -> Result<Value<'v>, AbortCode>
    where
        't: 'v,
    {
        let table = self.table();
        let found = table.lookup(index, sub)?;
        if !found.shared.flags.has(Flags::READ) {
            return Err(AbortCode::WRITE_ONLY);
        }
        if index == 0x1003 && sub > 0 {
            communication::history_has(table, self.image(), sub)?;
        }
        value_of(table, self.image(), found)
    }

    /// [`read`](Self::read), after the application had the chance to bring the value up to date.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    fn upload<'v, A: Application<Self>>(
        &'v mut self,
        index: u16,
        sub: u8,
        application: &mut A,
    ) -> Result<Value<'v>, AbortCode>
    where
        't: 'v,
    {
        let found = readable(self, index, sub, application)?;
        value_of(self.table(), self.image(), found)
    }

    /// Writes an entry as an SDO client does. The checks come in the order of CiA 301's servers: the entry exists, its
    /// access and lock, the length, the value (type, limits, values of an enum; of an alias, also those of its target), rules
    /// of the communication objects, the write condition, the application's veto. A refused write changes nothing.
    ///
    /// Returns the entry that has a new value: of an alias, its target. A signature written to 1010h or 1011h is a command
    /// and no value: the application carries it out in [`Application::command`].
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
        let found = self.table().lookup(index, sub)?;
        if !found.shared.flags.has(Flags::WRITE) {
            return Err(AbortCode::READ_ONLY);
        }
        write_row(self, found, data, application)
    }

    /// Reads a DOMAIN from an offset in bytes on, from the application; returns the number of bytes, 0 at its end.
    ///
    /// # Errors
    /// That it does not exist, [`AbortCode::WRITE_ONLY`], [`AbortCode::UNSUPPORTED_ACCESS`] for what is not an entry,
    /// what the application says.
    fn upload_domain<A: Application<Self>>(
        &mut self,
        index: u16,
        sub: u8,
        offset: u32,
        buffer: &mut [u8],
        application: &mut A,
    ) -> Result<usize, AbortCode> {
        let domain = find_domain(self.table(), index, sub, Flags::READ, AbortCode::WRITE_ONLY)?;
        let entry = self.entry(domain.row).ok_or(AbortCode::INTERNAL)?;
        application.read_domain(self, entry, offset, buffer)
    }

    /// Gives a part of a DOMAIN to the application, from an offset in bytes on; `last` says that it is complete.
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
        let domain = find_domain(self.table(), index, sub, Flags::WRITE, AbortCode::READ_ONLY)?;
        let entry = self.entry(domain.row).ok_or(AbortCode::INTERNAL)?;
        check_lock::<Self, A>(domain.shared, application)?;
        check_condition(self, domain.shared)?;
        application.write_domain(self, entry, offset, data, last)
    }

    /// Puts every value back to the one after a factory reset, for a node-ID from 1 to 127.
    fn reset(&mut self, node_id: u8) {
        reset(self.table(), self.image_mut(), &(0..usize::MAX), node_id);
    }

    /// Puts the values of one storage group back, as "restore defaults" (1011h) does, for a node-ID from 1 to 127.
    fn reset_stored(&mut self, storage: Storage, node_id: u8) {
        let table = self.table();
        if let Some(region) = table.region(storage) {
            reset(table, self.image_mut(), &region.range(), node_id);
        }
    }

    /// The bytes that a "store parameters" command saves: 1010h.2 the communication parameters, .3 the application
    /// parameters, .4 the manufacturer's, .1 all of them. None where nothing is stored.
    fn stored(&self, storage: Storage) -> &[u8] {
        self.table().region(storage).and_then(|region| self.image().get(region.range())).unwrap_or_default()
    }

    /// Takes back bytes that [`stored`](Self::stored) gave, with the number that [`layout`](Self::layout) had then. The values
    /// themselves are not checked: keep a checksum with them, and let [`correct_stored`](Self::correct_stored) look at
    /// what another firmware may have saved. Entries that follow the node-ID come back as they were saved: where the
    /// region has such ([`follows_node_id`](Self::follows_node_id)), keep the node-ID with them, too.
    ///
    /// # Errors
    /// [`OtherLayout`] if they are not of this layout; nothing changes then.
    fn restore(&mut self, storage: Storage, layout: u32, bytes: &[u8]) -> Result<(), OtherLayout> {
        let region =
            self.table().region(storage).filter(|region| region.layout == layout).ok_or(OtherLayout)?;
        match self.image_mut().get_mut(region.range()) {
            Some(place) if place.len() == bytes.len() => {
                place.copy_from_slice(bytes);
                Ok(())
            }
            _ => Err(OtherLayout),
        }
    }

    /// Looks at the values of a storage group that came from a memory: what its entry cannot have any more, as it has other limits in
    /// this firmware, gets the value after a factory reset for a node-ID from 1 to 127; parameters of a PDO, all of that PDO. The first such entry.
    fn correct_stored(&mut self, storage: Storage, node_id: u8) -> Option<Self::Entry> {
        let table = self.table();
        let part = table.region(storage)?.range();
        let row = correct(table, self.image_mut(), &part, node_id)?;
        self.entry(row)
    }

    /// Whether values of a storage group have the node-ID added to them after a factory reset: then they are of no use to another node.
    fn follows_node_id(&self, storage: Storage) -> bool {
        let part = self.table().region(storage).map_or(0..0, Region::range);
        let places = self.table().parts().node_id_places;
        places.iter().any(|place| usize::try_from(place.offset).is_ok_and(|at| part.contains(&at)))
    }

    /// A number that changes whenever another set of entries, types or places is stored in a group; 0 where nothing is stored.
    fn layout(&self, storage: Storage) -> u32 {
        self.table().region(storage).map_or(0, |region| region.layout)
    }
}

/// Stored bytes of another set of entries, types or places than the dictionary has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct OtherLayout;

impl core::fmt::Display for OtherLayout {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("stored values of another layout")
    }
}

impl core::error::Error for OtherLayout {}

/// An entry that a client may read, after the application had the chance to bring its value up to date.
#[inline]
pub(crate) fn readable<'t, D: Dictionary<'t>, A: Application<D>>(
    dictionary: &mut D,
    index: u16,
    sub: u8,
    application: &mut A,
) -> Result<Found<'t>, AbortCode> {
    let table = dictionary.table();
    let found = table.search(index, sub)?;
    if !found.shared.flags.has(Flags::READ) {
        return Err(AbortCode::WRITE_ONLY);
    }
    refresh(dictionary, found, application);
    if index == 0x1003 && sub > 0 {
        communication::history_has(table, dictionary.image(), sub)?;
    }
    Ok(found)
}

/// The value of an entry, whatever its access: one function for services that are not in a hurry.
#[inline(never)]
pub(crate) fn value<'t: 'v, 'v, D: Dictionary<'t>>(
    dictionary: &'v D,
    found: Found<'t>,
) -> Result<Value<'v>, AbortCode> {
    value_of(dictionary.table(), dictionary.image(), found)
}

/// Gives the application the chance to bring a value up to date.
#[inline]
pub(crate) fn refresh<'t, D: Dictionary<'t>, A: Application<D>>(
    dictionary: &mut D,
    found: Found<'t>,
    application: &mut A,
) {
    let holder = match found.shared.place {
        Place::Alias => dictionary.table().holder(found.row),
        Place::Image | Place::Constant | Place::Application => found.row,
    };
    if let Some(entry) = dictionary.entry(holder) {
        application.refresh(dictionary, entry);
    }
}

/// An entry that a client may write, in some state of the device.
pub(crate) fn writable<'t>(table: &Table<'t>, index: u16, sub: u8) -> Result<Found<'t>, AbortCode> {
    let found = table.search(index, sub)?;
    if found.shared.flags.has(Flags::WRITE) { Ok(found) } else { Err(AbortCode::READ_ONLY) }
}

/// A DOMAIN with an access; `refusal` says that it has not.
fn find_domain<'t>(
    table: &Table<'t>,
    index: u16,
    sub: u8,
    access: Flags,
    refusal: AbortCode,
) -> Result<Found<'t>, AbortCode> {
    let found = table.search(index, sub)?;
    if !found.shared.flags.has(access) {
        Err(refusal)
    } else if found.shared.place != Place::Application {
        Err(AbortCode::UNSUPPORTED_ACCESS)
    } else {
        Ok(found)
    }
}

/// The service lock; an alias of a locked entry is locked, too.
pub(crate) fn check_lock<D: Entries, A: Application<D>>(
    shared: &Attributes,
    application: &A,
) -> Result<(), AbortCode> {
    let locked = shared.flags.has(Flags::LOCKED) && !application.is_unlocked();
    if locked { Err(AbortCode::DEVICE_STATE) } else { Ok(()) }
}

/// The write condition.
fn check_condition<'t, D: Dictionary<'t>>(dictionary: &D, shared: &Attributes) -> Result<(), AbortCode> {
    let open = shared.condition == NONE || dictionary.condition(shared.condition);
    if open { Ok(()) } else { Err(AbortCode::DEVICE_STATE) }
}

/// Checks and writes the value of an entry whose access is settled.
pub(crate) fn write_row<'t, D: Dictionary<'t>, A: Application<D>>(
    dictionary: &mut D,
    found: Found<'t>,
    data: &[u8],
    application: &mut A,
) -> Result<D::Entry, AbortCode> {
    let table = dictionary.table();
    check_lock::<D, A>(found.shared, application)?;
    check_value(table, found.shared, data)?;
    let mut buffer = [0; 8];
    let Held { holder, data } = held(table, found, data, &mut buffer)?;
    let effect = if holder.row >= table.parts().first_application_row {
        Effect::Store
    } else {
        communication::check(table, dictionary.image(), holder.row, data, Before::Present)?
    };
    check_condition(dictionary, found.shared)?;
    if holder.row != found.row {
        check_condition(dictionary, holder.shared)?;
    }
    let entry = dictionary.entry(holder.row).ok_or(AbortCode::INTERNAL)?;
    match effect {
        Effect::Store => {
            application.accept(dictionary, entry, data)?;
            put(dictionary.image_mut(), holder, data)?;
            application.changed(dictionary, entry);
        }
        Effect::Command(command) => application.command(dictionary, command)?,
    }
    Ok(entry)
}

/// Writes an entry that [takes](Table::is_free) every value of its length, which this is.
#[inline]
pub(crate) fn put_free<'t, const N: usize, D: Dictionary<'t>, A: Application<D>>(
    dictionary: &mut D,
    row: Row,
    place: usize,
    value: [u8; N],
    application: &mut A,
) -> Result<(), AbortCode> {
    let entry = dictionary.entry(row).ok_or(AbortCode::INTERNAL)?;
    application.accept(dictionary, entry, &value)?;
    image::put(dictionary.image_mut(), place, value);
    application.changed(dictionary, entry);
    Ok(())
}

/// The entry that holds a value, and what it gets.
struct Held<'t, 'd> {
    holder: Found<'t>,
    data: &'d [u8],
}

/// Where a value goes.
#[inline]
fn held<'t, 'd>(
    table: &Table<'t>,
    found: Found<'t>,
    data: &'d [u8],
    buffer: &'d mut [u8; 8],
) -> Result<Held<'t, 'd>, AbortCode> {
    match found.shared.place {
        Place::Image => Ok(Held { holder: found, data }),
        Place::Constant => Err(AbortCode::READ_ONLY),
        Place::Application => Err(AbortCode::UNSUPPORTED_ACCESS),
        // Looked up here: see `value_of`.
        Place::Alias => {
            aliased(table, *table.alias(found.row).ok_or(AbortCode::INTERNAL)?, found.shared, data, buffer)
        }
    }
}

/// Puts a value as the device itself does, regardless of who else may write the entry.
pub(crate) fn hold<'t>(
    table: &Table<'t>,
    image: &mut [u8],
    found: Found<'t>,
    data: &[u8],
) -> Result<(), AbortCode> {
    check_value(table, found.shared, data)?;
    let mut buffer = [0; 8];
    let Held { holder, data } = held(table, found, data, &mut buffer)?;
    put(image, holder, data)
}

/// What the target of an alias gets.
#[inline(never)]
fn aliased<'t, 'd>(
    table: &Table<'t>,
    alias: Alias,
    shared: &Attributes,
    data: &[u8],
    buffer: &'d mut [u8; 8],
) -> Result<Held<'t, 'd>, AbortCode> {
    let holder = table.found(alias.target);
    let target = holder.shared;
    *buffer = alias.view.target(number(shared.data_type, data))?.to_le_bytes();
    let (value, rest) = buffer.split_at(usize::from(target.size).min(8));
    let negative = target.data_type.is_signed() && value.last().is_some_and(|last| last & 0x80 != 0);
    let sign = if negative { 0xFF } else { 0 };
    if rest.iter().any(|byte| *byte != sign) {
        return Err(AbortCode::INVALID_VALUE);
    }
    check_value(table, target, value)?;
    Ok(Held { holder, data: value })
}
