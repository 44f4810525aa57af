//! Parameter files: what is settled for one node, as a person writes and keeps it.

use super::layers::Layer;
use crate::ast::Name;
use crate::ast::SettingDecl;
use crate::commissioning::{self, Commissioning, TextOfNode};
use crate::decode;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::keys::{KeyKind, PARAMETER_FILE, PARAMETERS_VERSION, Shape, is_marked};
use crate::model::{Dictionary, System};
use crate::source::{FileId, SourceMap, Spanned};
use crate::yaml::{self, Document, Node};

/// A parameter file.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct ParameterFile {
    /// The file that describes the device, relative to this one.
    pub spec: Option<Name>,
    /// Key of the device that it is for.
    pub device: Option<Name>,
    /// What the values are for.
    pub title: Option<Name>,
    /// More about it.
    pub about: Option<Name>,
    /// Node-ID.
    pub node: Option<Spanned<u8>>,
    /// Bit rate, as it is written.
    bit_rate: Option<Name>,
    /// Names and number of node and network.
    node_name: Option<Name>,
    net_number: Option<Spanned<u32>>,
    net_name: Option<Name>,
    serial_number: Option<Spanned<u32>>,
    /// The settings, and what they unlock.
    pub layer: Layer,
}

/// Whether a text is a parameter file: its first key says so.
pub fn is_parameter_file(text: &str) -> bool {
    is_marked(text, PARAMETERS_VERSION)
}

/// Reads a parameter file. What is wrong with it by itself goes to `diagnostics`: whether the device has what it names, and
/// takes the values, [`assign_layers`](super::assign_layers) says.
///
/// ```
/// use od_spec::diag::Diagnostics;
/// use od_spec::source::SourceMap;
/// use od_spec::{NoFiles, assign_layers, compile, parameter_file};
///
/// let mut sources = SourceMap::new();
/// let root = sources.add("lamp.od.yaml", "
/// od-spec: 1
/// title: Lamp
/// uses: [cia301]
/// devices:
///   lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}
/// units: {percent: {symbol: \"%\"}}
/// objects:
///   0x2000: {name: brightness, type: unsigned8, access: rw, unit: percent, default: 80, max: 100}
/// ");
/// let system = compile(&mut sources, root, &mut NoFiles).system.expect("no errors");
/// let mut read = |text: &str| {
///     let file = sources.add("hall.yaml", text);
///     let mut diagnostics = Diagnostics::new();
///     parameter_file(&sources, file, &mut diagnostics).expect("a parameter file").layer
/// };
/// let hall = read("{od-parameters: 1, parameters: {brightness: 60 %}}");
/// let lobby = read("{od-parameters: 1, parameters: {0x2000: 70}}");
/// let mut diagnostics = Diagnostics::new();
/// let assigned = assign_layers(&system, &system.devices[0], 5, &[hall, lobby], &mut diagnostics);
/// assert!(diagnostics.is_empty());
/// let (id, value) = assigned.values.first_key_value().expect("a value");
/// assert_eq!((value.integer(), assigned.origins[id].layer), (Some(70), 1));
/// assert_eq!(assigned.overridden[id][0].layer, 0);
/// ```
pub fn parameter_file(
    sources: &SourceMap,
    file: FileId,
    diagnostics: &mut Diagnostics,
) -> Option<ParameterFile> {
    let tree = yaml::parse_as(Document::Parameters, file, sources.file(file), diagnostics)?;
    decode::check(&tree, &PARAMETER_FILE, diagnostics);
    let decl = decode::parameter_file(&tree);
    Some(ParameterFile {
        spec: decl.spec,
        device: decl.device,
        title: decl.title,
        about: decl.about,
        node: decl.node,
        bit_rate: decl.bit_rate,
        node_name: decl.node_name,
        net_number: decl.net_number,
        net_name: decl.net_name,
        serial_number: decl.serial_number,
        layer: Layer { settings: decl.settings, unlocked: decl.unlock },
    })
}

/// The settings of a map in any YAML file, as `parameters:` of a parameter file has them. What is misshapen goes to
/// `diagnostics`.
///
/// ```
/// use od_spec::diag::Diagnostics;
/// use od_spec::source::SourceMap;
/// use od_spec::{Layer, NoFiles, assign_layers, compile, settings_of_map, yaml};
///
/// let mut sources = SourceMap::new();
/// let root = sources.add("lamp.od.yaml", "
/// od-spec: 1
/// title: Lamp
/// uses: [cia301]
/// devices:
///   lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}
/// objects:
///   0x2000: {name: dimmer, record: {1: {name: low, type: unsigned8, access: rw}, 2: {name: high, type: unsigned8, access: rw}}}
/// ");
/// let system = compile(&mut sources, root, &mut NoFiles).system.expect("no errors");
/// let house = sources.add("house.yaml", "
/// every lamp: {dimmer: {low: 10, high: 90}}
/// lamp in the hall: {2000.2: 80}
/// ");
/// let mut diagnostics = Diagnostics::new();
/// let tree = yaml::parse(house, sources.file(house), &mut diagnostics).expect("YAML");
/// let yaml::NodeKind::Map(parts) = &tree.kind else { panic!("a map") };
/// let layers: Vec<Layer> =
///     parts.iter().map(|(_, map)| Layer::of(settings_of_map(map, &mut diagnostics))).collect();
/// let assigned = assign_layers(&system, &system.devices[0], 5, &layers, &mut diagnostics);
/// assert!(diagnostics.is_empty());
/// let values = assigned.values.iter().map(|(id, value)| (id.to_string(), value.integer(), assigned.origins[id].layer));
/// assert_eq!(values.collect::<Vec<_>>(), [("2000h.1".to_owned(), Some(10), 0), ("2000h.2".to_owned(), Some(80), 1)]);
/// ```
pub fn settings_of_map(map: &Node, diagnostics: &mut Diagnostics) -> Vec<SettingDecl> {
    decode::check_shape(map, Shape::MapOf(KeyKind::Name, &Shape::Setting), diagnostics);
    decode::settings(map)
}

impl ParameterFile {
    /// The serial number of the one device that the file is for.
    pub fn serial_number(&self) -> Option<u32> {
        self.serial_number.map(|number| number.value)
    }

    /// Says when the file is for another device.
    pub fn check_device(&self, system: &System, device: &Dictionary, diagnostics: &mut Diagnostics) {
        let Some(named) = self.device.as_ref().filter(|named| named.value != device.key) else { return };
        let keys = system.devices.iter().map(|device| device.key.as_str());
        let diagnostic = if system.device(&named.value).is_some() {
            let message = format!("the file is for `{}`, and not for `{}`", named.value, device.key);
            Diagnostic::new(codes::UNKNOWN_DEVICE, named.span, message)
                .help("name the parameter file of this device, or correct `--device`")
        } else {
            let message = format!("there is no device `{}`", shorten(&named.value));
            let word = diagnostics.suggestions.nearest(&named.value, keys.clone());
            Diagnostic::new(codes::UNKNOWN_DEVICE, named.span, message).did_you_mean_or(word, || {
                let keys: Vec<String> = keys.map(|key| format!("`{key}`")).collect();
                format!("the devices are {}", keys.join(", "))
            })
        };
        diagnostics.push(diagnostic);
    }

    /// Takes what the file says about the node but its node-ID and its values.
    pub fn settle(&self, device: &Dictionary, node: &mut Commissioning, diagnostics: &mut Diagnostics) {
        if let Some(text) = &self.bit_rate {
            match commissioning::bit_rate(device, &text.value) {
                Ok(rate) => node.bit_rate = rate,
                Err(diagnostic) => diagnostics.push(diagnostic.at(text.span)),
            }
        }
        let mut take = |name: &Option<Name>, of: TextOfNode, key: &str, into: &mut String| {
            let Some(name) = name else { return };
            match of.read(&format!("{key}:"), &name.value) {
                Ok(text) => *into = text,
                Err(diagnostic) => diagnostics.push(diagnostic.at(name.span)),
            }
        };
        take(&self.node_name, TextOfNode::Node, "node-name", &mut node.node_name);
        take(&self.net_name, TextOfNode::Network, "net-name", &mut node.net_name);
        if let Some(number) = self.net_number {
            node.net_number = number.value;
        }
        node.remarks.extend([&self.title, &self.about].into_iter().flatten().map(|text| text.value.clone()));
        if let Some(number) = self.serial_number {
            node.serial_number = Some(number.value);
        }
    }
}
