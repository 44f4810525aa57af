//! Settings of `odgen dcf`: parameter files, lists of settings, and the command line.

use std::path::{Path, PathBuf};

use od_gen::source::open;
use od_spec::diag::{Diagnostic, Diagnostics};
use od_spec::model::{Dictionary, System};
use od_spec::source::{SourceMap, Spanned};
use od_spec::{Commissioning, Layer, ParameterFile, parameter_file};

use super::args::DcfArgs;
use super::report::{Report, shown};

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

    /// The node-ID: that of the command line, or else of the last file that states one. Who says otherwise is told.
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

    /// Takes what the files say about the node beside its node-ID and its values, the last one over the others.
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

/// The layer of the command line: settings of lists first, each with its place, and what may be set although it is locked.
pub(crate) fn layer(
    args: &DcfArgs,
    sources: &mut SourceMap,
    diagnostics: &mut Diagnostics,
) -> Result<Layer, Box<Diagnostic>> {
    let mut settings = Vec::new();
    for path in &args.set_file {
        settings.extend(of_file(path, sources)?);
    }
    let mut of_option = |option: &str, text: &String| {
        let id = sources.add(option, text.as_str());
        Spanned::new(text.clone(), sources.whole(id))
    };
    settings.extend(args.settings.iter().map(|setting| of_option("--set", setting)));
    let mut layer = Layer::of(od_spec::settings(&settings, diagnostics));
    layer.unlocked = args.unlock.iter().map(|name| of_option("--unlock", name)).collect();
    Ok(layer)
}

/// One setting on each line. Behind a value there is no comment: it would be a part of a text.
fn of_file(path: &Path, sources: &mut SourceMap) -> Result<Vec<Spanned<String>>, Box<Diagnostic>> {
    let help = "check the path; a file of settings has one `ENTRY=VALUE` on each line";
    let id = open(path, help, sources)?;
    let (whole, text) = (sources.whole(id), sources.file(id).text());
    let mut settings = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let end = start + line.trim_end_matches(['\n', '\r']).len();
        let begin = start + (line.len() - line.trim_start().len());
        let setting = text.get(begin..end).unwrap_or_default();
        if !setting.is_empty() && !setting.starts_with('#') {
            settings.push(Spanned::new(setting.to_owned(), whole.part(begin, end)));
        }
        start += line.len();
    }
    Ok(settings)
}
