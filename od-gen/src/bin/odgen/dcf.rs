//! `odgen dcf`.

use std::path::{Path, PathBuf};

use od_gen::Artifact;
use od_gen::eds::{Commissioning, write_dcf};
use od_gen::files::write_all;
use od_spec::assign;
use od_spec::diag::{Code, Diagnostic, Diagnostics};
use od_spec::model::Dictionary;
use od_spec::source::{SourceMap, Spanned};

use super::ERRORS;
use super::args::DcfArgs;
use super::report::{Report, node_id, print};

pub(crate) fn run(args: &DcfArgs, report: &Report) -> u8 {
    match dcf(args, report) {
        Ok(text) => print(&text),
        Err(code) => code,
    }
}

fn dcf(args: &DcfArgs, report: &Report) -> Result<String, u8> {
    let node = node_id(&args.node).map_err(|diagnostic| report.refuse(diagnostic))?;
    let mut sources = SourceMap::new();
    let compiled =
        od_gen::source::compile_file(&args.spec, &mut sources, &mut od_gen::source::FileLoader::default());
    report.show(&compiled.diagnostics, &sources);
    let system = compiled.system.ok_or(ERRORS)?;
    let device = report.device(&system, &args.device)?;
    let mut commissioning = Commissioning::of_node(device, node);
    if let Some(text) = &args.bit_rate {
        commissioning.bit_rate = bit_rate(device, text).map_err(|diagnostic| report.refuse(diagnostic))?;
    }
    if let Some(name) = &args.node_name {
        commissioning.node_name.clone_from(name);
    }
    commissioning.net_number = args.net_number;
    commissioning.net_name.clone_from(&args.net_name);
    let settings: Vec<Spanned<String>> = args
        .settings
        .iter()
        .map(|setting| {
            let id = sources.add("--set", setting.as_str());
            Spanned::new(setting.clone(), sources.whole(id))
        })
        .collect();
    let mut diagnostics = Diagnostics::new();
    commissioning.values = assign(&system, device, &settings, &mut diagnostics);
    diagnostics.sort();
    report.show(&diagnostics, &sources);
    if diagnostics.has_errors() {
        return Err(ERRORS);
    }
    let path = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("{}-{node}.dcf", device.key)));
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let bytes = write_dcf(&system, device, &commissioning, &name);
    let directory = path.parent().unwrap_or(Path::new(""));
    let artifact = Artifact { path: name, bytes, purpose: "" };
    write_all(directory, std::slice::from_ref(&artifact)).map_err(|error| {
        report.refuse(
            Diagnostic::without_place(Code::WriteFailed, error.to_string())
                .help("nothing was changed; check the directory, its permissions and the free space"),
        )
    })?;
    let size = artifact.bytes.len().div_ceil(1024);
    let count = commissioning.values.len();
    Ok(format!("  {}  {size} kB  {} node {node}, {count} values set\n", path.display(), device.key))
}

fn bit_rate(device: &Dictionary, text: &str) -> Result<u16, Diagnostic> {
    let rates = device.info.bit_rates.iter().map(u16::to_string).collect::<Vec<_>>().join(", ");
    let rate = text.trim().parse::<u16>().ok().filter(|rate| device.info.bit_rates.contains(rate));
    rate.ok_or_else(|| {
        Diagnostic::without_place(
            Code::BitRateUnsupported,
            format!("`{}` does not support a bit rate of `{text}` kbit/s", device.key),
        )
        .help(format!("it supports {rates} kbit/s"))
    })
}
