//! Settings of `odgen dcf`: parameter files, lists of settings, and the command line.

use std::path::PathBuf;

use od_gen::source::open;
use od_spec::diag::{Diagnostic, Diagnostics};
use od_spec::model::{Dictionary, System};
use od_spec::source::SourceMap;
use od_spec::{Commissioning, Layer, ParameterFile, parameter_file};

use crate::report::{Report, shown};

/// Parameter files, each a layer over those before it.
pub(crate) struct ParameterFiles {
    files: Vec<(PathBuf, ParameterFile)>,
}

/// Reads parameter files. What cannot be opened ends it; what is wrong inside goes to `diagnostics`.
pub(crate) fn parameter_files(
    paths: &[PathBuf],
    sources: &mut SourceMap,
    diagnostics: &mut Diagnostics,
) -> Result<ParameterFiles, Box<Diagnostic>> {
    let mut files = Vec::new();
    for path in paths {
        let id = open(path, "check the path; a parameter file begins with `od-parameters: 1`", sources)?;
        files.extend(parameter_file(sources, id, diagnostics).map(|file| (path.clone(), file)));
    }
    Ok(ParameterFiles { files })
}

impl ParameterFiles {
    /// The device that the command line names, or else the files; or the only one.
    pub(crate) fn device<'a>(
        &self,
        system: &'a System,
        key: Option<&str>,
        report: &Report,
    ) -> Result<&'a Dictionary, u8> {
        let named = || self.files.iter().find_map(|(_, file)| file.device.as_ref());
        let named = named().map(|name| name.value.as_str()).filter(|key| system.device(key).is_some());
        report.device_or_only(system, key.or(named))
    }

    /// Says which files are for another device.
    pub(crate) fn check_device(&self, system: &System, device: &Dictionary, diagnostics: &mut Diagnostics) {
        for (_, file) in &self.files {
            file.check_device(system, device, diagnostics);
        }
    }

    /// The node-ID: that of the command line, or else of the last file that states one. Another one is reported.
    pub(crate) fn node(&self, on_the_command_line: Option<u8>, report: &Report) -> Option<u8> {
        let stated = || self.files.iter().filter_map(|(path, file)| Some((path, file.node?.value)));
        let last = stated().next_back().map(|(_, node)| node);
        let node = on_the_command_line.or(last)?;
        for (path, other) in stated().filter(|(_, stated)| *stated != node) {
            report.note(&format!("{} says node {other}, and the DCF is for node {node}", shown(path)));
        }
        Some(node)
    }

    /// The node-ID that the last file states.
    pub(crate) fn stated_node(&self) -> Option<u8> {
        self.files.iter().rev().find_map(|(_, file)| Some(file.node?.value))
    }

    /// The serial number that the last file states.
    pub(crate) fn stated_serial(&self) -> Option<u32> {
        self.files.iter().rev().find_map(|(_, file)| file.serial_number())
    }

    /// Takes what the files say about the node in addition to its node-ID and its values, the last one over the others.
    pub(crate) fn settle(
        &self,
        device: &Dictionary,
        node: &mut Commissioning,
        diagnostics: &mut Diagnostics,
    ) {
        for (_, file) in &self.files {
            file.settle(device, node, diagnostics);
        }
    }

    /// The settings, file by file.
    pub(crate) fn into_layers(self) -> Vec<Layer> {
        self.files.into_iter().map(|(_, file)| file.layer).collect()
    }
}
