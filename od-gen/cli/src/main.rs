//! `odgen`: checks specifications of CANopen object dictionaries and makes files from them.

mod args;
mod build;
mod bus_nodes;
mod check;
mod concise;
mod dbc;
mod dcf;
mod decode;
mod diff;
mod docs;
mod errata;
mod fix;
mod fmt;
mod git;
mod import;
mod interrupt;
mod language;
mod link;
mod listing;
mod lsp;
mod new;
mod node;
mod output;
mod parallel;
mod params;
mod plant;
mod progress;
mod report;
mod serve;
mod settings;
mod specs;
mod st;
mod templates;

use std::io::Write as _;
use std::path::Path;
use std::process::ExitCode;

use args::{CheckFormat, Cli, Command};
use clap::{CommandFactory as _, Parser as _};
use od_spec::diag::{Code, Diagnostic, codes};
use od_spec::visible::visible;

/// The work of the command is many small pieces of memory, given back in bulk.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// The input is without errors, and what was to be written is.
const SUCCESS: u8 = 0;
/// Errors in the input, or output that could not be written.
const ERRORS: u8 = 1;
/// The command line cannot be understood.
const USAGE: u8 = 2;
/// `odgen diff --exit-code` found what it looked for, or `odgen node compare` a difference.
const DIFFERS: u8 = 3;

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(message) => return ExitCode::from(answer(&message)),
    };
    let report = report::Report::new(cli.message_format().into(), cli.color);
    let (format, directory) = (cli.format, cli.directory.as_path());
    let code = match cli.command {
        Command::Build(args) => build::run(&args, directory, &report),
        Command::Check(args) => {
            let format = args.format.or(format.map(CheckFormat::from)).unwrap_or(CheckFormat::Human);
            check::run(&args, format, directory, &report)
        }
        Command::Concise(args) => concise::run(&args, directory, &report),
        Command::Dbc(args) => dbc::run(&args, directory, &report),
        Command::Dcf(args) => dcf::run(&args, directory, &report),
        Command::Decode(args) => decode::run(&args, directory, &report),
        Command::Diff(args) => diff::run(&args, cli.color, &report),
        Command::Docs(args) => docs::run(&args, directory, &report),
        Command::Dump(args) => dump(&args, directory, &report),
        Command::Errata(args) => errata::run(&args, directory, &report),
        Command::Import(args) => import::run(&args, &report),
        Command::Fix(args) => fix::run(&args, &report),
        Command::Fmt(args) => fmt::run(&args, directory, &report),
        Command::Lsp(_) => lsp::run(&report),
        Command::New(args) => new::run(&args, &report),
        Command::Node(args) => node::run(&args, directory, &report),
        Command::Params(args) => params::run(&args, &report),
        Command::Plant(args) => plant::run(&args, &report),
        Command::Serve(args) => serve::run(&args, directory, &report),
        Command::St(args) => st::run(&args, directory, &report),
        Command::Explain { code } => explain(&code),
        Command::Library { name } => library(name.as_deref(), &report),
        Command::Reference => report::print(&od_spec::reference()),
        Command::Schema(args) => schema(&args, &report),
        Command::Completions { shell } => {
            let mut text = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "odgen", &mut text);
            report::print(&String::from_utf8_lossy(&text))
        }
    };
    ExitCode::from(code)
}

/// Help, the version, or what is wrong with the command line.
fn answer(message: &clap::Error) -> u8 {
    match message.print().and_then(|()| std::io::stdout().flush()) {
        Err(error) if !message.use_stderr() => report::not_printed(&error),
        _ => u8::try_from(message.exit_code()).unwrap_or(USAGE),
    }
}

fn dump(args: &args::DumpArgs, directory: &Path, report: &report::Report) -> u8 {
    let spec = match specs::one(args.spec.as_deref(), directory, report) {
        Ok(spec) => spec,
        Err(code) => return code,
    };
    let Some((used, _)) = report.compile_with_sources(&spec) else { return ERRORS };
    let node = used.stated_node();
    let system = used.system;
    if let Err(code) = args.device.iter().try_for_each(|key| report.device(&system, key).map(drop)) {
        return code;
    }
    let dump = match node {
        Some(node) => od_formats::json::dump_node(&system, &args.device, &node),
        None => od_formats::json::dump(&system, &args.device),
    };
    report::print_json(&dump)
}

fn schema(args: &args::SchemaArgs, report: &report::Report) -> u8 {
    if let Some(files) = &args.plant {
        return plant::schema(files, report);
    }
    let Some(spec) = &args.params else { return report::print(&od_spec::json_schema()) };
    let Some(system) = report.compile(spec) else { return ERRORS };
    match report.device_or_only(&system, args.device.as_deref()) {
        Ok(device) => report::print_json(od_spec::parameter_schema(&system, device).as_bytes()),
        Err(code) => code,
    }
}

fn library(name: Option<&str>, report: &report::Report) -> u8 {
    let names = od_spec::LIBRARIES.iter().map(|(name, _)| *name);
    let Some(name) = name else {
        return report::print(&(names.collect::<Vec<_>>().join("\n") + "\n"));
    };
    match od_spec::LIBRARIES.iter().find(|(known, _)| *known == name) {
        Some((_, text)) => report::print(text),
        None => report.refuse(
            Diagnostic::without_place(codes::UNKNOWN_WORD, format!("found `{name}`, expected a library"))
                .help(format!("the libraries are {}", names.collect::<Vec<_>>().join(", "))),
        ),
    }
}

fn explain(id: &str) -> u8 {
    if id.eq_ignore_ascii_case("all") {
        let line = |code: &Code| format!("{code}  {:7}  {}\n", code.severity.word(), code.title);
        return report::print(&od_spec::all_codes().into_iter().map(line).collect::<String>());
    }
    match od_spec::code(id) {
        Some(code) => report::print(&format!(
            "{code} ({}): {}\n\n{}",
            code.severity.word(),
            code.title,
            od_spec::explanation(code)
        )),
        None => {
            let id = visible(id);
            anstream::eprintln!(
                "error: there is no code `{id}`; codes look like `OD0301`, `odgen explain all` lists them"
            );
            USAGE
        }
    }
}
