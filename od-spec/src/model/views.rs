//! What follows from the model and every output needs: which devices something is about, where an entry lies in PDOs, and
//! which entries show it.

use super::{Alias, Dictionary, Entry, EntryId, Mapped, Pdo, PdoTarget};

/// The devices that something is about.
///
/// ```
/// use od_spec::model::Devices;
///
/// assert!(Devices::listed(Vec::<String>::new()).includes("pmc"));
/// assert!(!Devices::listed(["pmm"]).includes("pmc"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Devices {
    /// Every device of the specification.
    #[default]
    All,
    /// Those with these keys.
    Only(Vec<String>),
}

impl Devices {
    /// The devices of a list that means all devices when it is empty, as `devices:` and `--device` do.
    pub fn listed<K: Into<String>>(keys: impl IntoIterator<Item = K>) -> Self {
        let keys: Vec<String> = keys.into_iter().map(Into::into).collect();
        if keys.is_empty() { Self::All } else { Self::Only(keys) }
    }

    /// One device.
    pub fn one(key: impl Into<String>) -> Self {
        Self::Only(vec![key.into()])
    }

    /// Whether the device with this key is meant.
    pub fn includes(&self, key: &str) -> bool {
        match self {
            Self::All => true,
            Self::Only(keys) => keys.iter().any(|one| one == key),
        }
    }

    /// The keys of a list that names devices; none where it means all.
    pub fn keys(&self) -> &[String] {
        match self {
            Self::All => &[],
            Self::Only(keys) => keys,
        }
    }
}

/// A field of a PDO: what is mapped, and where.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PdoField<'a> {
    /// What is mapped.
    pub mapped: &'a Mapped,
    /// First bit, counted from the least significant bit of byte 0 (CiA 301 v4.2, 7.5.2.36).
    pub first_bit: u32,
}

impl PdoField<'_> {
    /// The byte in which the field begins.
    pub const fn byte(self) -> u32 {
        self.first_bit / 8
    }

    /// The bit of that byte in which it begins.
    pub const fn bit(self) -> u32 {
        self.first_bit % 8
    }
}

impl Pdo {
    /// The fields of the factory mapping, in order, with their places.
    pub fn fields(&self) -> impl Iterator<Item = PdoField<'_>> {
        self.map.iter().scan(0, |next_bit, mapped| {
            let first_bit = *next_bit;
            *next_bit += u32::from(mapped.bits);
            Some(PdoField { mapped, first_bit })
        })
    }
}

/// A PDO that carries an entry, and where.
#[derive(Debug, Clone, Copy)]
pub struct Carrier<'a> {
    /// The PDO.
    pub pdo: &'a Pdo,
    /// The field that is the entry.
    pub field: PdoField<'a>,
}

/// An entry that shows another one.
#[derive(Debug, Clone, Copy)]
pub struct View<'a> {
    /// The entry that shows.
    pub id: EntryId,
    /// That entry.
    pub entry: &'a Entry,
    /// How it converts.
    pub alias: &'a Alias,
}

impl Dictionary {
    /// The aliases of an entry, ascending. Looks at every entry of the device: where all views are wanted, take
    /// [`views`](Self::views).
    pub fn views_of(&self, id: EntryId) -> impl Iterator<Item = View<'_>> {
        self.views().filter(move |view| view.alias.target == id)
    }

    /// All aliases, ascending.
    pub fn views(&self) -> impl Iterator<Item = View<'_>> {
        self.entries()
            .filter_map(|(id, _, entry)| entry.alias.as_ref().map(|alias| View { id, entry, alias }))
    }

    /// The places of an entry in the factory mappings of PDOs, RPDOs first, by number; an entry may be in several.
    pub fn pdos_with(&self, id: EntryId) -> impl Iterator<Item = Carrier<'_>> {
        let carries = move |field: &PdoField<'_>| field.mapped.target == PdoTarget::Entry(id);
        self.pdos
            .iter()
            .flat_map(move |pdo| pdo.fields().filter(carries).map(move |field| Carrier { pdo, field }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Index, SubIndex};
    use crate::source::SourceMap;

    #[test]
    fn an_empty_list_means_all_devices() {
        assert!(Devices::listed(Vec::<String>::new()).includes("pmc"));
        let one = Devices::listed(["pmm"]);
        assert!(one.includes("pmm") && !one.includes("pmc"));
        assert_eq!((one.keys(), Devices::All.keys()), (&["pmm".to_owned()][..], &[][..]));
        assert!(!Devices::Only(Vec::new()).includes("pmc"), "a list that was worked out means what it holds");
    }

    fn entry(index: u16) -> EntryId {
        EntryId { index: Index(index), sub: SubIndex(0) }
    }

    #[test]
    fn an_entry_knows_its_carriers_and_its_views() {
        let text = "
od-spec: 1
title: Lamp
uses: [cia301]
devices:
  lamp: {name: Lamp, bit-rates: [125], granularity: 1, features: [heartbeat producer]}
objects:
  0x2000: {name: switch, type: unsigned8, access: ro, pdo: transmit}
  0x2001: {name: light, type: integer32, access: ro, pdo: transmit}
  0x2003: {name: door, type: boolean, access: ro, pdo: transmit}
  0x2002: {name: light 16, alias: 0x2001, type: integer16, outside: saturate, access: ro, pdo: transmit}
pdos:
  lamp:
    transmit:
      1: {map: [0x2000, 0x2001]}
      2: {map: [0x2001, 0x2003, 0x2002]}
";
        let mut sources = SourceMap::new();
        let root = sources.add("lamp.od.yaml", text);
        let compiled = crate::compile(&mut sources, root, &mut crate::NoFiles);
        let shown = crate::diag::render::render(
            &compiled.diagnostics,
            &sources,
            crate::diag::render::Format::Human,
            false,
        );
        let system = compiled.system.unwrap_or_else(|| panic!("{shown}"));
        let lamp = &system.devices[0];
        let carriers: Vec<(u16, u32)> = lamp
            .pdos_with(entry(0x2001))
            .map(|carrier| (carrier.pdo.number, carrier.field.first_bit))
            .collect();
        assert_eq!(carriers, [(1, 8), (2, 0)]);
        let bit_by_bit: Vec<[u32; 3]> =
            lamp.pdos[1].fields().map(|field| [field.first_bit, field.byte(), field.bit()]).collect();
        assert_eq!(bit_by_bit, [[0, 0, 0], [32, 4, 0], [33, 4, 1]]);
        let views: Vec<EntryId> = lamp.views_of(entry(0x2001)).map(|view| view.id).collect();
        assert_eq!(views, [entry(0x2002)]);
        assert_eq!(lamp.views_of(entry(0x2000)).count(), 0);
    }
}
