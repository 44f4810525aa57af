//! Parameter values for one device: what a DCF carries beyond the defaults. Settings are read here and laid over the model;
//! whether the result is right is for the rules to say, the same ones as for a specification.

mod assignment;
mod entries;
mod file;
mod layers;
mod on_device;
mod overlay;
mod read;

pub use crate::ast::SettingDecl;
pub use file::{ParameterFile, is_parameter_file, parameter_file, settings_of_map};
pub use layers::{Assigned, Layer, Origin, assign_layers};
pub(crate) use layers::{Laid, lay_over};
pub use on_device::{OnDevice, on_device};

use crate::ast::Name;
use crate::check;
use crate::commissioning::{Commissioning, Denoted, ParameterValues};
use crate::diag::{Diagnostics, Suggestions};
use crate::eds::read::{FileUse, NodeDecl};
use crate::model::{Author, Dictionary, EntryId, Index, Statement, SubIndex, System, Value};
use crate::node_of_file::NodeOfFile;
use crate::resolve::NotFound;
use crate::source::{Span, Spanned};
use crate::standard;

use layers::assign_layers_with;

/// A setting `ENTRY=VALUE` and its place.
pub type Assignment = Spanned<String>;

/// A setting that was read.
struct Setting {
    /// The entry that it names.
    id: EntryId,
    /// The entry that holds the value: for an alias its target.
    holder: EntryId,
    /// The value of the entry that it names.
    value: Value,
    /// Where it is written.
    span: Span,
    /// Where the value is written.
    value_span: Span,
}

/// Reads settings for the node of a device and checks them: entry, type, limits, locks, PDO parameters, constraints.
/// What is wrong goes to `diagnostics`; use the values only if no error is among them.
///
/// ```
/// use od_spec::diag::Diagnostics;
/// use od_spec::source::{SourceMap, Spanned};
/// use od_spec::{NoFiles, assign, compile};
///
/// let mut sources = SourceMap::new();
/// let root = sources.add("lamp.od.yaml", "
/// od-spec: 1
/// title: Lamp
/// uses: [cia301]
/// devices:
///   lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}
/// objects:
///   0x2000: {name: brightness, type: unsigned8, access: rw, default: 80, max: 100}
/// ");
/// let system = compile(&mut sources, root, &mut NoFiles).system.expect("no errors");
/// let mut set = |text: &str| {
///     let file = sources.add("--set", text);
///     let setting = Spanned::new(text.to_owned(), sources.whole(file));
///     let mut diagnostics = Diagnostics::new();
///     let values = assign(&system, &system.devices[0], 5, &[setting], &mut diagnostics);
///     (values.len(), diagnostics.iter().map(|message| message.code.id).collect::<Vec<_>>())
/// };
/// assert_eq!(set("brightness=90"), (1, vec![]));
/// assert_eq!(set("2000=101").1, ["OD0406"]); // outside the limits
/// ```
pub fn assign(
    system: &System,
    device: &Dictionary,
    node: u8,
    settings: &[Assignment],
    diagnostics: &mut Diagnostics,
) -> ParameterValues {
    assign_with(standard::rules(&check::RULES), system, device, node, settings, diagnostics)
}

/// Reads settings and checks them under some of the rules.
pub(crate) fn assign_with(
    rules: check::Rules<'_>,
    system: &System,
    device: &Dictionary,
    node: u8,
    assignments: &[Assignment],
    diagnostics: &mut Diagnostics,
) -> ParameterValues {
    let layer = Layer::of(settings(assignments, diagnostics));
    assign_layers_with(rules, system, device, node, &[layer], diagnostics).values
}

/// The settings of texts `ENTRY=VALUE`, as a layer has them; what is not one is reported to `diagnostics`.
pub fn settings(assignments: &[Assignment], diagnostics: &mut Diagnostics) -> Vec<SettingDecl> {
    let mut settings = Vec::new();
    for assignment in assignments {
        match assignment::setting(assignment) {
            Ok(setting) => settings.push(setting),
            Err(diagnostic) => diagnostics.push(diagnostic),
        }
    }
    settings
}

/// The serial number of the identity.
const SERIAL_NUMBER: EntryId = EntryId { index: Index(0x1018), sub: SubIndex(4) };

/// The entries of a device by the names that settings give them, to be asked often.
pub struct SettingNames<'a> {
    device: &'a Dictionary,
    entries: entries::Entries<'a>,
}

impl<'a> SettingNames<'a> {
    /// Those of a device.
    pub const fn of(device: &'a Dictionary) -> Self {
        Self { device, entries: entries::Entries::of(device) }
    }

    /// The object that a text without a sub-index means.
    pub fn object(&self, text: &str) -> Option<Index> {
        self.entries.lookup().object(text)
    }

    /// The entry that a text means.
    pub fn entry(&self, text: &str) -> Option<EntryId> {
        self.entries.lookup().find(text, &mut Suggestions::default()).ok()
    }

    /// What to write instead of a text that is the name of several entries or objects; empty for any other.
    pub fn instead(&self, text: &str) -> Vec<String> {
        let namesakes = match self.entries.lookup().find(text, &mut Suggestions::default()) {
            Err(NotFound::Several(namesakes)) => namesakes,
            Ok(_) | Err(NotFound::Unknown { .. } | NotFound::Ambiguous { .. }) => Vec::new(),
        };
        namesakes.into_iter().map(|one| one.way).collect()
    }

    /// What a setting is read as, without a look at whether it can be set: its entry and the value of that. What is wrong
    /// with it goes to `diagnostics`.
    pub fn read_one(
        &self,
        node: u8,
        setting: &SettingDecl,
        diagnostics: &mut Diagnostics,
    ) -> Option<(EntryId, Value)> {
        match read::setting(self.device, &self.entries, node, setting, &mut diagnostics.suggestions) {
            Ok(Setting { id, value, .. }) => Some((id, value)),
            Err(unread) => {
                diagnostics.append(unread.diagnostics);
                None
            }
        }
    }

    /// What settings are read as, without a look at whether they can be set: an entry and its value each. What cannot be read
    /// is left out.
    pub fn read(&self, node: u8, settings: &[SettingDecl]) -> Vec<(EntryId, Value)> {
        let mut suggestions = Suggestions::default();
        let read = settings
            .iter()
            .filter_map(|decl| read::setting(self.device, &self.entries, node, decl, &mut suggestions).ok());
        read.map(|setting| (setting.id, setting.value)).collect()
    }
}

/// The node that a DCF configures, under some of the rules. Values that cannot be read are left out.
pub(crate) fn of_node(
    rules: check::Rules<'_>,
    system: &System,
    device: &Dictionary,
    decl: NodeDecl,
    diagnostics: &mut Diagnostics,
) -> NodeOfFile {
    // Without a node-ID the file is for any node; formulas need one to be looked at.
    let node = decl.node.unwrap_or(1);
    let usual = Commissioning::of_node(device, node);
    let mut configured = device.clone();
    let mut values = ParameterValues::new();
    for (id, text) in decl.values {
        let Some(entry) = overlay::entry_mut(&mut configured, id) else { continue };
        match read::parameter(entry, &text, &mut diagnostics.suggestions) {
            // What the file repeats is not set by it.
            Ok(value) if entry.default.as_ref() == Some(&value) => drop(values.insert(id, value)),
            Ok(value) => {
                let statement = Statement { span: text.span, author: Author::Setting };
                entry.set_default(Some(value.clone()), statement);
                values.insert(id, value);
            }
            Err(diagnostic) => diagnostics.push(*diagnostic),
        }
    }
    let objects = &configured.objects;
    for pdo in &mut configured.pdos {
        pdo.follow(objects);
    }
    check::foreign_node(rules, system, &configured, node, diagnostics);
    // What the identity says is not a statement of its own.
    let of_identity = configured.entry(SERIAL_NUMBER).and_then(|entry| entry.default.as_ref()?.integer());
    let serial_number = decl.serial_number.filter(|number| of_identity != Some(i128::from(*number)));
    let mut read = Commissioning {
        node_name: decl.node_name.unwrap_or_default(),
        bit_rate: decl.bit_rate.unwrap_or(usual.bit_rate),
        net_number: decl.net_number.unwrap_or(0),
        net_name: decl.net_name.unwrap_or_default(),
        serial_number,
        manager: decl.manager,
        reference: decl.reference.unwrap_or_default(),
        net_reference: decl.net_reference.unwrap_or_default(),
        values,
        ..usual
    };
    let texts = |list: Vec<(Denoted, Name)>| {
        let of_device = list.into_iter().filter(|(of, _)| of.is_in(device));
        of_device.map(|(of, text)| (of, text.value)).collect()
    };
    read.denotations = texts(decl.denotations);
    read.references = texts(decl.references);
    for (id, file, path) in decl.files.into_iter().filter(|(id, ..)| device.entry(*id).is_some()) {
        let files = read.files.entry(id).or_default();
        match file {
            FileUse::Upload => files.upload = Some(path.value),
            FileUse::Download => files.download = Some(path.value),
        }
    }
    NodeOfFile::of_dcf(decl.node, device, &configured, read)
}
