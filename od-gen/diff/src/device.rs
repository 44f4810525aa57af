//! What is said about a device as a whole.

use od_spec::model::{DataType, Date, DateTime, Direction, DynamicChannel, Fact, FileInfo};
use od_spec::wording::Language;

use super::change::{Change, Class, Consequence, Place};
use super::objects::Devices;
use super::rules::{self, Consequences};
use super::texts::texts;
use super::words::yes_no;

/// How a fact of `[FileInfo]` reads.
type Show = fn(&FileInfo) -> String;

impl Devices<'_> {
    /// Facts of `[DeviceInfo]` and `[FileInfo]`, names and texts.
    pub(super) fn device(self) -> Vec<Change> {
        let mut changes = self.identity();
        changes.extend(self.abilities());
        changes.extend(self.lists());
        changes.extend(self.file());
        let name = Change::text(Place::Device, Fact::Name, &self.old.name, &self.new.name);
        let name = name.filter(|_| self.scope.is_everything());
        changes.extend(name.map(|change| change.so(Class::Documents, "the product name is in the EDS")));
        changes.extend(texts(&Place::Device, Fact::About, &self.old.about, &self.new.about, self.language));
        changes
    }

    fn identity(self) -> Vec<Change> {
        let (old, new) = (&self.old.info, &self.new.info);
        let hexadecimal = |number: u32| format!("0x{number:08X}");
        let row = |fact, part, before: &str, after: &str, consequences: Consequences| {
            Some(Change::text(Place::Device, fact, before, after)?.part(part).with(consequences))
        };
        let name = || vec![Consequence::new(Class::Documents, "masters compare numbers")];
        let texts = |text: &str| self.scope.name(text);
        [
            row(Fact::Product, "name", &texts(&old.product_name), &texts(&new.product_name), name()),
            row(Fact::Product, "order code", &texts(&old.order_code), &texts(&new.order_code), name()),
            row(
                Fact::Product,
                "code",
                &hexadecimal(old.product),
                &hexadecimal(new.product),
                rules::identity(),
            ),
            row(
                Fact::ProductRevision,
                "1018h.3",
                &hexadecimal(old.product_revision),
                &hexadecimal(new.product_revision),
                rules::revision(),
            ),
            row(
                Fact::DeviceType,
                "1000h",
                &hexadecimal(old.device_type),
                &hexadecimal(new.device_type),
                rules::device_type(),
            ),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// What a device can do or not.
    fn abilities(self) -> Vec<Change> {
        let (old, new) = (&self.old.info, &self.new.info);
        let rows = [
            (Fact::BootUp, Some("master"), old.boot_up_master, new.boot_up_master),
            (Fact::BootUp, Some("slave"), old.boot_up_slave, new.boot_up_slave),
            (Fact::GroupMessaging, None, old.group_messaging, new.group_messaging),
            (Fact::Lss, None, old.lss, new.lss),
        ];
        let abilities = rows.into_iter().filter_map(|(fact, part, before, after)| {
            let change = Change::text(Place::Device, fact, yes_no(before), yes_no(after))?;
            Some(Change { part: part.map(ToOwned::to_owned), ..change }.with(rules::ability(before)))
        });
        let granularity = Change::text(
            Place::Device,
            Fact::Granularity,
            &old.granularity.to_string(),
            &new.granularity.to_string(),
        )
        .map(|change| change.with(rules::granularity(old.granularity, new.granularity)));
        let pdos = [Direction::Receive, Direction::Transmit].into_iter().filter_map(|direction| {
            let (before, after) = (self.old.pdos_of(direction).count(), self.new.pdos_of(direction).count());
            let change =
                Change::text(Place::Device, Fact::PdoCount, &before.to_string(), &after.to_string())?;
            Some(change.part(format!("{}s", direction.pdo())).with(rules::ability(after < before)))
        });
        abilities.chain(granularity).chain(pdos).collect()
    }

    fn lists(self) -> Vec<Change> {
        let (old, new) = (&self.old.info, &self.new.info);
        let rates = |rates: &[u16]| rates.iter().map(u16::to_string).collect::<Vec<_>>();
        let dummies = |list: &[DataType]| {
            let mut list = list.to_vec();
            list.sort_unstable();
            list.dedup();
            list.into_iter().map(|one| one.name().to_owned()).collect::<Vec<_>>()
        };
        let channels = |list: &[DynamicChannel]| list.iter().map(channel).collect::<Vec<_>>();
        let lists = [
            (Fact::BitRates, " kbit/s", rates(&old.bit_rates), rates(&new.bit_rates)),
            (Fact::Dummies, "", dummies(&old.dummies), dummies(&new.dummies)),
            (Fact::DynamicChannels, "", channels(&old.dynamic_channels), channels(&new.dynamic_channels)),
        ];
        let changes = lists.into_iter().filter_map(|(fact, of, before, after)| {
            let is_lost = before.iter().any(|one| !after.contains(one));
            let join = |list: Vec<String>| {
                if list.is_empty() { "none".to_owned() } else { list.join(", ") + of }
            };
            let change = Change::text(Place::Device, fact, &join(before), &join(after))?;
            Some(change.with(rules::ability(is_lost)))
        });
        changes.collect()
    }

    /// What the EDS says about itself.
    fn file(self) -> Vec<Change> {
        let (old, new) = (&self.old.file, &self.new.file);
        let rows: [(&str, Show); 7] = [
            ("description", |file| file.description.clone()),
            ("created", |file| moment(file.created)),
            ("created-by", |file| file.created_by.clone()),
            ("modified", |file| moment(file.modified)),
            ("modified-by", |file| file.modified_by.clone()),
            ("FileVersion", |file| file.version.to_string()),
            ("FileRevision", |file| file.revision.to_string()),
        ];
        let changes = rows.into_iter().filter_map(|(part, show)| {
            let (before, after) = (self.scope.name(&show(old)), self.scope.name(&show(new)));
            let change = Change::text(Place::Device, Fact::Eds, &before, &after)?;
            Some(change.part(part).so(Class::Documents, "the file about itself"))
        });
        changes.collect()
    }
}

/// `A080h to A0BFh unsigned8 ro at 64`.
fn channel(channel: &DynamicChannel) -> String {
    let DynamicChannel { first, last, data_type, access, offset, difference, .. } = channel;
    let difference = difference.map_or(String::new(), |difference| format!(" by {difference}"));
    format!("{first} to {last} {} {} at {offset}{difference}", data_type.name(), access.word())
}

fn moment(at: DateTime) -> String {
    let DateTime { date: Date { .. }, hour, minute } = at;
    format!("{} {hour:02}:{minute:02}", Language::ENGLISH.date(at.date))
}
