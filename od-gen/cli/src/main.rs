//! `odgen`: checks specifications of CANopen object dictionaries and makes files from them.

// The page `odgen.html` has the commands that need no bus, no terminal and no editor.
#![cfg_attr(target_family = "wasm", expect(dead_code, reason = "only the other commands use it"))]

mod bus_nodes;
mod commands;
mod exit;
#[cfg(not(target_family = "wasm"))]
mod interrupt;
mod language;
mod limits;
#[cfg(not(target_family = "wasm"))]
mod link;
mod listing;
mod logo;
mod messages;
mod modules;
mod output;
mod parallel;
mod pdf;
mod plant_file;
mod progress;
mod report;
mod settings;
mod specs;
mod templates;

use std::io::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

#[cfg(not(target_family = "wasm"))]
use clap::CommandFactory as _;
use clap::{Parser, Subcommand};

use commands::{
    build, check, concise, dbc, dcf, decode, diff, docs, dump, errata, explain, export, fix, fmt, import,
    library, new, params, reference, schema, st,
};
#[cfg(not(target_family = "wasm"))]
use commands::{completions, lsp, node, plant, serve};
use messages::{Color, Format};
use od_spec::xdd::Disabled;
use report::Report;

/// The work of the command is many small pieces of memory, given back in bulk.
#[cfg(not(target_family = "wasm"))]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Checks CANopen object dictionaries – specifications, EDS, DCF, XDD and XDC files – and generates EDS, DCF, XDD, JSON, Rust, C, Structured Text and documents from them.
#[derive(Debug, Parser)]
#[command(
    name = "odgen",
    bin_name = "odgen",
    version,
    after_help = "Exit codes: 0, success; 1, errors in the input, or an output could not be written; 2, wrong command line; \
                  3, differences that `odgen diff --exit-code` or `odgen node compare` looks for.\n\
                  `odgen explain OD0507` explains a message; `odgen reference` describes the language."
)]
struct Cli {
    #[command(subcommand)]
    command: Command,

    /// How messages are written
    #[arg(long, value_enum)]
    format: Option<Format>,

    /// Directory whose `*.od.yaml` files are taken if no SPEC is given
    #[arg(long = "specs", global = true, default_value = ".", hide_default_value = true, value_name = "DIR")]
    directory: PathBuf,

    /// Include objects that CANopenEditor switched off in an XDD or XPD
    #[arg(long, global = true)]
    disabled: bool,

    /// Colours in messages
    #[arg(long, global = true, value_enum, default_value_t, value_name = "WHEN")]
    color: Color,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Generate files from a specification: an EDS for each device, JSON, and on request DCF, XDD, Rust, C and documents; on an error, none
    Build(build::BuildArgs),
    /// Check specifications, EDS, DCF, XDD and XDC files without writing anything
    Check(check::CheckArgs),
    /// Show the records of a concise DCF, the binary file that a CANopen master downloads to a node (object 1F22h)
    Concise(concise::ConciseArgs),
    /// Generate the DBC of the nodes of a bus, for trace and test tools: PDOs and services as messages, with units and names of values and bits
    Dbc(dbc::DbcArgs),
    /// Generate the DCF of one node, with your own parameter values
    Dcf(dcf::DcfArgs),
    /// Explain the frames of a recorded trace: services, entries and values in units, states, errors
    Decode(decode::DecodeArgs),
    /// Show what differs between two dictionaries, and what each change breaks
    Diff(diff::DiffArgs),
    /// Print the resolved model as JSON
    Dump(dump::DumpArgs),
    /// Generate the reference documentation: the manual's tables and a reference of all objects, as Markdown, HTML or PDF
    Docs(docs::DocsArgs),
    /// List where the printed manual differs from the specification
    Errata(errata::ErrataArgs),
    /// Make a specification from an EDS, DCF, XDD or XDC, or from a table of objects
    Import(import::ImportArgs),
    /// Write the tables of a device as a workbook or as CSV, which `import` reads again
    Export(export::ExportArgs),
    /// Repair the form of EDS and DCF files where nothing has to be guessed
    Fix(fix::FixArgs),
    /// Format specifications: indentation and spaces; comments, order and facts stay
    Fmt(fmt::FmtArgs),
    /// Run the language server (Language Server Protocol on standard input and output)
    #[cfg(not(target_family = "wasm"))]
    Lsp(lsp::LspArgs),
    /// Write a commented specification and, with `--firmware`, a firmware project for it
    New(new::NewArgs),
    /// Read, write, back up and watch nodes on a bus, through an SLCAN adapter (TCP or serial) or a CAN interface
    #[cfg(not(target_family = "wasm"))]
    Node(node::NodeArgs),
    /// Make a parameter file from a DCF: the values that differ from the defaults, by name and in units
    Params(params::ParamsArgs),
    /// Build, check or show a plant file: the nodes of many machines, with values inherited from type, site and machine
    #[cfg(not(target_family = "wasm"))]
    Plant(plant::PlantArgs),
    /// Run virtual nodes that any client can reach through SLCAN (TCP or a pseudo-terminal) or a CAN interface
    #[cfg(not(target_family = "wasm"))]
    Serve(serve::ServeArgs),
    /// Generate Structured Text (IEC 61131-3) for PLC programs: constants, enums, bits, unit conversions, PDOs
    St(st::StArgs),
    /// Explain a message code and how to fix its cause
    Explain(explain::ExplainArgs),
    /// Print a library of standard objects, or the names of all
    Library(library::LibraryArgs),
    /// Print the language reference (Markdown)
    Reference,
    /// Print the JSON Schema of the language, or of the parameter files of a device, for editors
    Schema(schema::SchemaArgs),
    /// Print a completion script for a shell
    #[cfg(not(target_family = "wasm"))]
    Completions(completions::CompletionsArgs),
}

impl Cli {
    /// How messages are written, wherever it was said.
    fn message_format(&self) -> Format {
        let behind = match &self.command {
            Command::Build(args) => args.messages.format,
            Command::Check(args) => args.format.map(check::CheckFormat::of_messages),
            Command::Dbc(args) => args.messages.format,
            Command::Dcf(args) => args.messages.format,
            Command::Decode(args) => args.messages.format,
            Command::Dump(args) => args.messages.format,
            Command::Errata(args) => args.messages.format,
            Command::Export(args) => args.messages.format,
            Command::Import(args) => args.messages.format,
            Command::Fix(args) => args.messages.format,
            Command::Fmt(args) => args.messages.format,
            Command::New(args) => args.messages.format,
            #[cfg(not(target_family = "wasm"))]
            Command::Node(args) => args.command.message_format(),
            Command::Params(args) => args.messages.format,
            #[cfg(not(target_family = "wasm"))]
            Command::Plant(args) => args.command.message_format(),
            #[cfg(not(target_family = "wasm"))]
            Command::Serve(args) => args.messages.format,
            Command::St(args) => args.messages.format,
            _ => None,
        };
        behind.or(self.format).unwrap_or_default()
    }
}

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(message) => return ExitCode::from(answer(&message)),
    };
    let disabled = if cli.disabled { Disabled::Taken } else { Disabled::LeftOut };
    let report = Report::new(cli.message_format(), cli.color, disabled);
    let (format, directory) = (cli.format, cli.directory.as_path());
    let code = match cli.command {
        Command::Build(args) => build::run(&args, directory, &report),
        Command::Check(args) => check::run(&args, format, directory, &report),
        Command::Concise(args) => concise::run(&args, directory, &report),
        Command::Dbc(args) => dbc::run(&args, directory, &report),
        Command::Dcf(args) => dcf::run(&args, directory, &report),
        Command::Decode(args) => decode::run(&args, directory, &report),
        Command::Diff(args) => diff::run(&args, cli.color, &report),
        Command::Docs(args) => docs::run(&args, directory, &report),
        Command::Dump(args) => dump::run(&args, directory, &report),
        Command::Errata(args) => errata::run(&args, directory, &report),
        Command::Import(args) => import::run(&args, &report),
        Command::Export(args) => export::run(&args, directory, &report),
        Command::Fix(args) => fix::run(&args, &report),
        Command::Fmt(args) => fmt::run(&args, directory, &report),
        #[cfg(not(target_family = "wasm"))]
        Command::Lsp(_) => lsp::run(&report),
        Command::New(args) => new::run(&args, &report),
        #[cfg(not(target_family = "wasm"))]
        Command::Node(args) => node::run(&args, directory, &report),
        Command::Params(args) => params::run(&args, &report),
        #[cfg(not(target_family = "wasm"))]
        Command::Plant(args) => plant::run(&args, &report),
        #[cfg(not(target_family = "wasm"))]
        Command::Serve(args) => serve::run(&args, directory, &report),
        Command::St(args) => st::run(&args, directory, &report),
        Command::Explain(args) => explain::run(&args),
        Command::Library(args) => library::run(&args, &report),
        Command::Reference => reference::run(),
        Command::Schema(args) => schema::run(&args, &report),
        #[cfg(not(target_family = "wasm"))]
        Command::Completions(args) => completions::run(&args, &mut Cli::command()),
    };
    ExitCode::from(code)
}

/// Help, the version, or what is wrong with the command line.
fn answer(message: &clap::Error) -> u8 {
    match message.print().and_then(|()| std::io::stdout().flush()) {
        Err(error) if !message.use_stderr() => report::not_printed(&error),
        _ => u8::try_from(message.exit_code()).unwrap_or(exit::USAGE),
    }
}
