//! From the text of a plant file to a plant.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::{MachineType, Master, Plant, PlantDevice, Site, classes, levels, machines};
use crate::ast::plant::{DeviceDecl, PlantDecl};
use crate::compile::{Compiled, compile};
use crate::decode;
use crate::describing::describing;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::files::Loader;
use crate::keys;
use crate::model::SystemSource;
use crate::node_of_file::NodeOfFile;
use crate::source::{FileId, SourceMap};
use crate::yaml::{self, Document};

/// What a plant file gives.
#[derive(Debug)]
#[non_exhaustive]
pub struct PlantFile {
    /// The plant; there is one exactly when no error is among the diagnostics, those about the devices' files included.
    pub plant: Option<Plant>,
    /// The devices that could be read, whatever is wrong with the plant.
    pub devices: Vec<PlantDevice>,
    /// What is wrong with the plant file, before its values are looked at.
    pub diagnostics: Diagnostics,
    /// The files of the devices, with what is to be said about each.
    pub files: Vec<DeviceFile>,
}

/// A file that devices are from.
#[derive(Debug)]
#[non_exhaustive]
pub struct DeviceFile {
    /// Its name in messages.
    pub name: String,
    /// What it is; `None` where nothing could be made of it.
    pub source: Option<SystemSource>,
    /// What is wrong with it.
    pub diagnostics: Diagnostics,
}

/// Reads a plant file with the specifications, EDS and DCF files of its devices, each once. What values are wrong, only
/// [`Plant::settle`] and [`Plant::check`] say.
pub fn plant(sources: &mut SourceMap, root: FileId, loader: &mut dyn Loader) -> PlantFile {
    let mut diagnostics = Diagnostics::new();
    let mut files = Vec::new();
    let plant = read(sources, root, loader, &mut diagnostics, &mut files);
    diagnostics.sort();
    // An EDS is read whatever is wrong with it.
    let is_usable = |file: &DeviceFile| match file.source {
        Some(SystemSource::Specification) => !file.diagnostics.has_errors(),
        Some(SystemSource::Eds) => true,
        None => false,
    };
    let is_right = !diagnostics.has_errors() && files.iter().all(is_usable);
    let devices = plant.as_ref().map(|plant| plant.devices.clone()).unwrap_or_default();
    PlantFile { plant: plant.filter(|_| is_right), devices, diagnostics, files }
}

fn read(
    sources: &mut SourceMap,
    root: FileId,
    loader: &mut dyn Loader,
    diagnostics: &mut Diagnostics,
    files: &mut Vec<DeviceFile>,
) -> Option<Plant> {
    let tree = yaml::parse_as(Document::Plant, root, sources.file(root), diagnostics)?;
    decode::check(&tree, &keys::PLANT, diagnostics);
    let decl = decode::plant(&tree);
    drop(tree);
    let mut plant = Plant {
        title: decl.title.as_ref().map(|title| title.value.clone()).unwrap_or_default(),
        about: decl.about.as_ref().map(|about| about.value.clone()),
        devices: devices(sources, root, &decl, loader, diagnostics, files),
        types: types(&decl),
        sites: sites(&decl),
        ..Plant::default()
    };
    levels::check(&decl, diagnostics);
    machines::expand(&decl, &mut plant, diagnostics);
    classes::find(&mut plant, diagnostics);
    Some(plant)
}

fn types(decl: &PlantDecl) -> Vec<MachineType> {
    let types = decl.types.iter().map(|one| MachineType {
        name: one.name.value.clone(),
        about: one.about.as_ref().map(|about| about.value.clone()),
        master: one.master.clone().map(|master| Master {
            node: master.node,
            sends: master.sends,
            receives: master.receives,
        }),
        span: one.name.span,
    });
    types.collect()
}

fn sites(decl: &PlantDecl) -> Vec<Site> {
    let text = |name: &Option<crate::ast::Name>| name.as_ref().map(|name| name.value.clone());
    let sites = decl.sites.iter().map(|site| Site {
        span: site.name.span,
        name: site.name.value.clone(),
        title: text(&site.title),
        comment: text(&site.comment),
    });
    sites.collect()
}

/// The devices. A file that several are from is compiled once.
fn devices(
    sources: &mut SourceMap,
    root: FileId,
    decl: &PlantDecl,
    loader: &mut dyn Loader,
    diagnostics: &mut Diagnostics,
    files: &mut Vec<DeviceFile>,
) -> Vec<PlantDevice> {
    let mut compiled: BTreeMap<&str, Option<(usize, Described)>> = BTreeMap::new();
    let mut devices = Vec::new();
    for device in &decl.devices {
        let from = device.from.value.as_str();
        if !compiled.contains_key(from) {
            let described = file(sources, root, device, loader, diagnostics, files);
            compiled.insert(from, described.map(|described| (files.len() - 1, described)));
        }
        let Some(Some((file, described))) = compiled.get(from) else { continue };
        devices.extend(in_file(device, *file, described, diagnostics));
    }
    devices
}

/// What a file describes.
struct Described {
    system: Arc<crate::model::System>,
    node: Option<Arc<NodeOfFile>>,
}

fn file(
    sources: &mut SourceMap,
    root: FileId,
    device: &DeviceDecl,
    loader: &mut dyn Loader,
    diagnostics: &mut Diagnostics,
    files: &mut Vec<DeviceFile>,
) -> Option<Described> {
    let id = match describing(sources, root, &device.from, loader) {
        Ok(id) => id,
        Err(diagnostic) => {
            diagnostics.push(*diagnostic);
            return None;
        }
    };
    let name = sources.file(id).name().to_owned();
    let Compiled { system, node, diagnostics: of_file, .. } = compile(sources, id, loader);
    let source = system.as_ref().map(|system| system.source);
    files.push(DeviceFile { name, source, diagnostics: of_file });
    Some(Described { system: Arc::new(system?), node: node.map(Arc::new) })
}

fn in_file(
    device: &DeviceDecl,
    file: usize,
    described: &Described,
    diagnostics: &mut Diagnostics,
) -> Option<PlantDevice> {
    let Described { system, node } = described;
    let key = device.device.as_ref().unwrap_or(&device.key);
    // An EDS has one device, whose key is made from the file's name.
    let only = system.devices.first().filter(|_| device.device.is_none() && system.devices.len() == 1);
    let Some(dictionary) = system.device(&key.value).or(only) else {
        let keys = system.devices.iter().map(|one| one.key.as_str());
        let message = format!("`{}` has no device `{}`", shorten(&device.from.value), shorten(&key.value));
        let word = diagnostics.suggestions.nearest(&key.value, keys.clone());
        let listed = || {
            let keys: Vec<String> = keys.map(|key| format!("`{key}`")).collect();
            format!("its devices are {}; name one with `device:`", keys.join(", "))
        };
        let diagnostic = Diagnostic::new(codes::UNKNOWN_DEVICE, key.span, message);
        // What the plant calls a device is its own.
        diagnostics.push(match device.device {
            Some(_) => diagnostic.did_you_mean_or(word, listed),
            None => diagnostic.help(word.map_or_else(listed, |word| format!("write `device: {word}`"))),
        });
        return None;
    };
    let dictionary = match node {
        Some(node) => Arc::new(node.at(None).configured(dictionary)),
        None => Arc::new(dictionary.clone()),
    };
    Some(PlantDevice {
        key: device.key.value.clone(),
        system: Arc::clone(system),
        file,
        dictionary,
        base: node.clone(),
    })
}
