//! `odgen`: checks specifications of CANopen object dictionaries and makes files from them.

mod bus_nodes;
mod commands;
mod exit;
mod interrupt;
mod language;
mod limits;
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

use clap::{CommandFactory as _, Parser, Subcommand};

use commands::{
    build, check, completions, concise, dbc, dcf, decode, diff, docs, dump, errata, explain, fix, fmt,
    import, library, lsp, new, node, params, plant, reference, schema, serve, st,
};
use messages::{Color, Format};
use od_spec::xdd::Disabled;
use report::Report;

/// The work of the command is many small pieces of memory, given back in bulk.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Checks CANopen object dictionaries – specifications, EDS, DCF, XDD and XDC files – and makes EDS, DCF, XDD, JSON, Rust and documents from them.
#[derive(Debug, Parser)]
#[command(
    name = "odgen",
    bin_name = "odgen",
    version,
    after_help = "Exit codes: 0 fine, 1 errors in the input or output not written, 2 wrong command line, \
                  3 what `odgen diff --exit-code` looks for, or `odgen node compare` finds.\n\
                  `odgen explain OD0507` says more about a message; `odgen reference` describes the language."
)]
struct Cli {
    #[command(subcommand)]
    command: Command,

    /// How messages are written
    #[arg(long, value_enum)]
    format: Option<Format>,

    /// Directory whose `*.od.yaml` are taken when no SPEC is named
    #[arg(long = "specs", global = true, default_value = ".", hide_default_value = true, value_name = "DIR")]
    directory: PathBuf,

    /// Take the objects that CANopenEditor switched off in an XDD or XPD, too
    #[arg(long, global = true)]
    disabled: bool,

    /// Colours in messages
    #[arg(long, global = true, value_enum, default_value_t, value_name = "WHEN")]
    color: Color,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Make the files of a specification: EDS of each device and the JSON dump; an error writes none of them
    Build(build::BuildArgs),
    /// Check specifications, EDS, DCF, XDD and XDC files without writing anything
    Check(check::CheckArgs),
    /// Look into a concise DCF, the binary that a CANopen master downloads to a node (object 1F22h)
    Concise(concise::ConciseArgs),
    /// Make the DBC of the nodes of a bus, for trace and test tools: PDOs and services as messages, with units, names of values and bits
    Dbc(dbc::DbcArgs),
    /// Make the DCF of one node, with parameter values of your own
    Dcf(dcf::DcfArgs),
    /// Print what the frames of a recorded trace mean: services, entries and values in units, states, errors
    Decode(decode::DecodeArgs),
    /// Show what differs between two dictionaries, and what each change breaks
    Diff(diff::DiffArgs),
    /// Print the resolved model as JSON
    Dump(dump::DumpArgs),
    /// Make the reference documentation: the manual's tables and a reference of all objects, as Markdown or HTML
    Docs(docs::DocsArgs),
    /// List where the printed manual differs from the specification
    Errata(errata::ErrataArgs),
    /// Make a specification from an EDS, DCF, XDD or XDC
    Import(import::ImportArgs),
    /// Fix what is wrong with the form of EDS and DCF files, as far as nothing has to be guessed
    Fix(fix::FixArgs),
    /// Lay out specifications: indentation and spaces; comments, order and facts stay
    Fmt(fmt::FmtArgs),
    /// Serve an editor: the Language Server Protocol on standard input and output
    Lsp(lsp::LspArgs),
    /// Write a commented specification to start from
    New(new::NewArgs),
    /// Talk to nodes on a bus, by an adapter with SLCAN (TCP or serial) or a CAN interface
    Node(node::NodeArgs),
    /// Make a parameter file from a DCF: the values that differ from the defaults, by name and in units
    Params(params::ParamsArgs),
    /// Work on a plant file: the nodes of many machines, with values inherited from type, site and machine
    Plant(plant::PlantArgs),
    /// Run virtual nodes that any client can reach by SLCAN (TCP or a pseudo-terminal) or a CAN interface
    Serve(serve::ServeArgs),
    /// Make Structured Text (IEC 61131-3) for PLC programs: constants, enums, bits, conversions to units and back, PDOs
    St(st::StArgs),
    /// Explain what a message code means and what to do about it
    Explain(explain::ExplainArgs),
    /// Print a library of standard objects, or the names of all
    Library(library::LibraryArgs),
    /// Print the language reference (Markdown)
    Reference,
    /// Print the JSON Schema of the language, or of the parameter files of a device, for editors
    Schema(schema::SchemaArgs),
    /// Print a completion script for a shell
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
            Command::Import(args) => args.messages.format,
            Command::Fix(args) => args.messages.format,
            Command::Fmt(args) => args.messages.format,
            Command::New(args) => args.messages.format,
            Command::Node(args) => args.command.message_format(),
            Command::Params(args) => args.messages.format,
            Command::Plant(args) => args.command.message_format(),
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
        Command::Fix(args) => fix::run(&args, &report),
        Command::Fmt(args) => fmt::run(&args, directory, &report),
        Command::Lsp(_) => lsp::run(&report),
        Command::New(args) => new::run(&args, &report),
        Command::Node(args) => node::run(&args, directory, &report),
        Command::Params(args) => params::run(&args, &report),
        Command::Plant(args) => plant::run(&args, &report),
        Command::Serve(args) => serve::run(&args, directory, &report),
        Command::St(args) => st::run(&args, directory, &report),
        Command::Explain(args) => explain::run(&args),
        Command::Library(args) => library::run(&args, &report),
        Command::Reference => reference::run(),
        Command::Schema(args) => schema::run(&args, &report),
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
