//! A parameter file with the device that its key `spec` leads to.

use super::file::{ParameterFile, parameter_file};
use super::layers::assign_layers;
use crate::ast::Name;
use crate::compile::{Compiled, compile};
use crate::describing::describing;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::files::Loader;
use crate::model::{Dictionary, System, SystemSource};
use crate::node_of_file::NodeOfFile;
use crate::source::{FileId, SourceMap};

/// What a parameter file gives with the file that it names.
#[derive(Debug, Default)]
#[non_exhaustive]
pub struct OnDevice {
    /// The file that its key `spec` names; `None` without that key, or if the file cannot be read.
    pub spec: Option<FileId>,
    /// What that file describes, if it has no error.
    pub system: Option<System>,
    /// Key of the device that takes the values.
    pub device: Option<String>,
    /// What is wrong with the parameter file, and with its specification. An EDS, DCF, XDD or XDC is checked by itself.
    pub diagnostics: Diagnostics,
}

/// Reads a parameter file and checks its values on the device that it names. Without the key `spec`, only the file by itself
/// is checked.
pub fn on_device(sources: &mut SourceMap, root: FileId, loader: &mut dyn Loader) -> OnDevice {
    let mut found = OnDevice::default();
    if let Some(file) = parameter_file(sources, root, &mut found.diagnostics)
        && let Some(spec) = &file.spec
    {
        match describing(sources, root, spec, loader) {
            Ok(described) => found.read(&file, spec, described, sources, loader),
            Err(diagnostic) => found.diagnostics.push(*diagnostic),
        }
    }
    found.diagnostics.sort();
    found
}

impl OnDevice {
    fn read(
        &mut self,
        file: &ParameterFile,
        spec: &Name,
        described: FileId,
        sources: &mut SourceMap,
        loader: &mut dyn Loader,
    ) {
        self.spec = Some(described);
        let Compiled { system, node, diagnostics, .. } = compile(sources, described, loader);
        if system.as_ref().is_none_or(|system| system.source == SystemSource::Specification) {
            self.diagnostics.append(diagnostics);
        }
        if let Some(system) = &system
            && let Some(device) = device(file, spec, system, &mut self.diagnostics)
        {
            // Without a node-ID, the values are those of any node.
            let stated = file.node.map(|node| node.value);
            let id = stated.or_else(|| node.as_ref()?.stated_id()).unwrap_or(1);
            let mut commissioning = NodeOfFile::or_defaults(node.as_ref(), device, id);
            file.settle(device, &mut commissioning, &mut self.diagnostics);
            let configured = commissioning.configured(device);
            let layers = std::slice::from_ref(&file.layer);
            assign_layers(system, &configured, id, layers, &mut self.diagnostics);
            self.device = Some(device.key.clone());
        }
        self.system = system;
    }
}

/// The device that a file is for: the only one, or the one that it names.
fn device<'s>(
    file: &ParameterFile,
    spec: &Name,
    system: &'s System,
    diagnostics: &mut Diagnostics,
) -> Option<&'s Dictionary> {
    match (&file.device, system.devices.as_slice()) {
        (None, [only]) => Some(only),
        (None, []) => None,
        (None, several) => {
            let keys: Vec<String> = several.iter().map(|device| format!("`{}`", device.key)).collect();
            let message = format!("`{}` describes several devices", shorten(&spec.value));
            diagnostics.push(
                Diagnostic::new(codes::UNKNOWN_DEVICE, spec.span, message)
                    .help(format!("add `device:` with one of {}", keys.join(", "))),
            );
            None
        }
        (Some(named), devices) => {
            let device = system.device(&named.value);
            if let (None, Some(first)) = (device, devices.first()) {
                file.check_device(system, first, diagnostics);
            }
            device
        }
    }
}
