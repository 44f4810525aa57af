//! The objects of a device by what they are for: the functions that the manual describes, in its order, then the areas
//! of the object dictionary.

use std::collections::BTreeMap;

use od_spec::model::{Dictionary, Index, Object, Role, TableContent};

use crate::language::Word;
use crate::source::Source;
use crate::view::cell::object_anchor;
use crate::view::{GroupView, ObjectName};

/// A chapter with more objects than this is divided into its sections, so that a group stays about as long as a screen.
const LONGEST: usize = 20;

/// What objects are grouped by. The order is that of the groups: the device's own objects come first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Purpose {
    /// What the manual has a chapter or section for; the position of the section.
    Function(usize),
    /// An area of the object dictionary that the manual does not describe.
    Area(Area),
}

/// The areas of the object dictionary (CiA 301 v4.02, 9.5.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Area {
    Manufacturer,
    DeviceProfile,
    Further,
    Communication,
}

impl Area {
    const fn of(role: Role) -> Self {
        match role {
            Role::DeviceType
            | Role::ErrorRegister
            | Role::ErrorHistory
            | Role::StoreParameters
            | Role::RestoreDefaults
            | Role::Identity
            | Role::SdoServer
            | Role::SdoClient
            | Role::PdoCommunication
            | Role::PdoMapping
            | Role::Communication => Self::Communication,
            Role::Manufacturer => Self::Manufacturer,
            Role::DeviceProfile => Self::DeviceProfile,
            Role::InterfaceProfile | Role::Reserved => Self::Further,
        }
    }

    const fn word(self) -> Word {
        match self {
            Area::Manufacturer => Word::ManufacturerObjects,
            Area::DeviceProfile => Word::ProfileObjects,
            Area::Further => Word::FurtherObjects,
            Area::Communication => Word::CommunicationObjects,
        }
    }
}

/// Where the manual has an object: the positions of the chapter and of the section directly below it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Home {
    chapter: usize,
    section: usize,
}

impl Source<'_> {
    /// The objects of a device in groups; each object is in one of them.
    pub(crate) fn groups(&self, device: &Dictionary) -> Vec<GroupView> {
        let homes = self.homes_in_manual();
        let home_of = |object: &Object| match Area::of(object.role()) {
            // Whatever a manual says of them, they are looked for together.
            Area::Communication => None,
            Area::Manufacturer | Area::DeviceProfile | Area::Further => homes.get(&object.index),
        };
        let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
        for home in device.objects.values().filter_map(home_of) {
            *counts.entry(home.chapter).or_default() += 1;
        }
        let mut groups: BTreeMap<Purpose, Vec<ObjectName>> = BTreeMap::new();
        for object in device.objects.values() {
            let purpose = match home_of(object) {
                Some(home) if counts[&home.chapter] > LONGEST => Purpose::Function(home.section),
                Some(home) => Purpose::Function(home.chapter),
                None => Purpose::Area(Area::of(object.role())),
            };
            groups.entry(purpose).or_default().push(ObjectName {
                index: object.index.to_string(),
                anchor: object_anchor(object.index),
                name: object.name.clone(),
            });
        }
        let view = |(purpose, objects): (Purpose, Vec<ObjectName>)| GroupView {
            title: match purpose {
                Purpose::Function(section) => self.heading(section),
                Purpose::Area(area) => self.word(area.word()).to_owned(),
            },
            objects: objects.into_iter().collect(),
        };
        groups.into_iter().map(view).collect()
    }

    /// Where the manual has its objects: where it shows them in detail, or else where it first lists them.
    fn homes_in_manual(&self) -> BTreeMap<Index, Home> {
        let mut detailed: BTreeMap<Index, Home> = BTreeMap::new();
        let mut listed: BTreeMap<Index, Home> = BTreeMap::new();
        for chapter in self.outline.chapters() {
            let Some(first) = chapter.sections.first() else { continue };
            let mut home = Home { chapter: first.position, section: first.position };
            for plan in &chapter.sections {
                if plan.level == 2 {
                    home.section = plan.position;
                }
                for table in &self.document().sections[plan.position].tables {
                    let (homes, list) = match &table.content {
                        TableContent::Objects(list) => (&mut detailed, list),
                        TableContent::Overview(list) => (&mut listed, list),
                        TableContent::Bits(_)
                        | TableContent::Values(_)
                        | TableContent::Errors(_)
                        | TableContent::Reactions(_)
                        | TableContent::States(_)
                        | TableContent::Transitions(_)
                        | TableContent::Commands(_)
                        | TableContent::Ladder(_)
                        | TableContent::Timing(_)
                        | TableContent::Hysteresis(_)
                        | TableContent::Flow(_)
                        | TableContent::Axis(_)
                        | TableContent::Pdos(_)
                        | TableContent::Rows { .. }
                        | TableContent::Glossary
                        | TableContent::History => continue,
                    };
                    for index in list {
                        homes.entry(*index).or_insert(home);
                    }
                }
            }
        }
        listed.extend(detailed);
        listed
    }
}
