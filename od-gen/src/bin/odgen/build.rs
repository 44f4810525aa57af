//! `odgen build`.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

use od_gen::files::{Outcome, write_all};
use od_gen::rust::{self, Provenance};
use od_gen::{Artifact, Selection, artifacts};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::{Devices, Dictionary, Origin, PdoMapping, System};
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile, rule_codes};

use super::ERRORS;
use super::args::{BuildArgs, DocsFormat};
use super::docs;
use super::report::{Report, node_id, print};

/// The specifications that come with odgen: name and text.
pub(crate) const SHIPPED: [(&str, &str); 2] = [
    ("fullmo-drive.od.yaml", include_str!("../../../../od-spec/devices/fullmo-drive.od.yaml")),
    (
        "pitch-control-system.od.yaml",
        include_str!("../../../../od-spec/devices/pitch-control-system.od.yaml"),
    ),
];

pub(crate) fn run(args: &BuildArgs, report: &Report) -> u8 {
    let node = match args.node.as_deref().map(node_id).transpose() {
        Ok(node) => node,
        Err(diagnostic) => return report.refuse(diagnostic),
    };
    // The files that come with odgen include a DCF of node 1, and Rust.
    let shipped = args.specs.is_empty();
    let node = if shipped { node.or(Some(1)) } else { node };
    let Some(mut systems) = compile_all(args, args.rust || shipped, report) else { return ERRORS };
    let mut set: Vec<Artifact> = Vec::new();
    let mut text = String::new();
    for key in &args.device {
        if !systems.iter().any(|built| built.system.device(key).is_some()) {
            return report.unknown_device(systems.iter().map(|built| &built.system), key);
        }
    }
    let formats = if shipped && args.docs.is_empty() { &[DocsFormat::Md][..] } else { &args.docs };
    let templates = match docs::templates(formats, None) {
        Ok(templates) if !formats.is_empty() => templates,
        Ok(_) => Vec::new(),
        Err(problem) => return problem.show(report),
    };
    for Built { stem, system, rust } in &mut systems {
        let devices: Vec<&Dictionary> = system.devices.iter().filter(|device| wanted(args, device)).collect();
        if devices.is_empty() {
            continue;
        }
        text.extend(devices.into_iter().map(describe));
        set.extend(artifacts(system, stem, &Selection { devices: &args.device, node }));
        set.append(rust);
        if !templates.is_empty() {
            let options = od_gen::docs::options(system, &args.device, None);
            match od_gen::docs::artifacts(system, "docs/", stem, &options, &templates) {
                Ok(artifacts) => set.extend(artifacts),
                Err(error) => return docs::Problem::Template(error, None).show(report),
            }
        }
    }
    if let Some(path) = clash(&set) {
        return report.refuse(
            Diagnostic::without_place(
                rule_codes::DUPLICATE_NAME,
                format!("two devices would both write {path}"),
            )
            .help("give the devices different keys, or build the specifications into different directories"),
        );
    }
    let written = write_all(&args.out, &set);
    // The process ends next: taking the models apart piece by piece would only cost the user time.
    std::mem::forget(systems);
    match written {
        Ok(outcomes) => {
            text.push_str(&list(&args.out, &set, &outcomes));
            print(&text)
        }
        Err(error) => report.refuse(
            Diagnostic::without_place(codes::WRITE_FAILED, error.to_string())
                .help("nothing was changed; check the directory, its permissions and the free space"),
        ),
    }
}

/// A specification that was compiled.
struct Built {
    stem: String,
    system: System,
    /// Its Rust modules, if they are wanted.
    rust: Vec<Artifact>,
}

/// Compiles everything, so that all messages are shown; `None` if any has errors.
fn compile_all(args: &BuildArgs, rust: bool, report: &Report) -> Option<Vec<Built>> {
    let compiled: Vec<(String, Option<(System, SourceMap)>)> = if args.specs.is_empty() {
        SHIPPED.iter().map(|(name, text)| (stem(Path::new(name)), shipped(name, text, report))).collect()
    } else {
        args.specs.iter().map(|path| (stem(path), report.compile_with_sources(path))).collect()
    };
    let built = compiled.into_iter().map(|(stem, compiled)| {
        let (system, sources) = compiled?;
        let rust = if rust { modules(args, &system, &sources, report)? } else { Vec::new() };
        Some(Built { stem, system, rust })
    });
    built.collect::<Vec<_>>().into_iter().collect()
}

/// The Rust modules of the wanted devices; `None` if any cannot be made.
fn modules(args: &BuildArgs, system: &System, sources: &SourceMap, report: &Report) -> Option<Vec<Artifact>> {
    let mut diagnostics = Diagnostics::new();
    let devices = system.devices.iter().filter(|device| wanted(args, device));
    let modules = rust::artifacts(system, devices, &Provenance::of(sources), &mut diagnostics);
    report.show(&diagnostics, sources);
    (!diagnostics.has_errors()).then_some(modules)
}

fn wanted(args: &BuildArgs, device: &Dictionary) -> bool {
    Devices::listed(&args.device).includes(&device.key)
}

pub(crate) fn shipped(name: &str, text: &str, report: &Report) -> Option<(System, SourceMap)> {
    let mut sources = SourceMap::new();
    let root = sources.add(name, text);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    report.show(&compiled.diagnostics, &sources);
    Some((compiled.system?, sources))
}

/// `pitch.od.yaml` → `pitch`.
pub(crate) fn stem(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let name = name.strip_suffix(".yaml").or_else(|| name.strip_suffix(".yml")).unwrap_or(&name);
    name.strip_suffix(".od").unwrap_or(name).to_owned()
}

/// The first path that two artifacts share.
pub(crate) fn clash(set: &[Artifact]) -> Option<&str> {
    let mut seen = BTreeSet::new();
    // Some file systems do not tell capitals from small letters.
    set.iter()
        .find(|artifact| !seen.insert(artifact.path.to_lowercase()))
        .map(|artifact| artifact.path.as_str())
}

fn describe(device: &Dictionary) -> String {
    let described: Vec<_> =
        device.objects.values().filter(|object| object.origin == Origin::Manual).collect();
    let entries: usize = described.iter().map(|object| object.entries.len()).sum();
    let mappable =
        described.iter().flat_map(|object| &object.entries).filter(|entry| entry.pdo != PdoMapping::None);
    let stored = described.iter().filter(|object| object.is_stored()).count();
    format!(
        "  {:<6} {} objects · {} entries · {} mappable · {} stored · {} more from libraries and PDOs\n",
        device.key,
        described.len(),
        entries,
        mappable.count(),
        stored,
        device.objects.len() - described.len()
    )
}

pub(crate) fn list(out: &Path, set: &[Artifact], outcomes: &[Outcome]) -> String {
    let mut text = String::new();
    let paths: Vec<String> =
        set.iter().map(|artifact| out.join(&artifact.path).display().to_string()).collect();
    let width = paths.iter().map(|path| path.chars().count()).max().unwrap_or(0);
    for (artifact, path) in set.iter().zip(&paths) {
        let size = artifact.bytes.len().div_ceil(1024);
        let _ = writeln!(text, "  {path:<width$}  {size:>4} kB  {}", artifact.purpose);
    }
    let changed = outcomes.iter().filter(|outcome| **outcome == Outcome::Changed).count();
    let _ = writeln!(text, "  {changed} files changed, {} unchanged", outcomes.len() - changed);
    text
}
