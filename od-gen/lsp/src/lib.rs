//! A language server for specifications, EDS, DCF, XDD and XDC files, plants and parameter files.
//!
//! [`serve_stdio`] speaks the Language Server Protocol on standard input and output. A client's messages come by a thread
//! that only reads (`transport`); everything else happens in one loop (`server`): edits change the open buffers at
//! once, a specification is compiled when an answer needs it or when no message waits, so that of edits that come faster
//! than answers only the last is compiled. There is no incremental engine: a specification is compiled as a whole, in a few
//! milliseconds, by the same `od_spec::compile` that `odgen check` calls.
//!
//! A request is answered by a pure function of a `Snapshot` and the request's parameters, in a file of
//! its own.

mod analysis;
mod buffer;
mod capabilities;
mod code_actions;
mod completion;
mod copies;
mod cursor;
mod definition;
mod departures;
mod diagnostics;
mod eds;
#[cfg(test)]
mod every_position;
mod folding;
mod formatting;
mod hover;
mod inlay;
mod lens;
mod library;
pub mod line_diff;
mod outgoing;
mod overlay;
mod place;
mod position;
mod rename;
mod requests;
mod satellites;
mod server;
mod shift;
mod snapshot;
mod symbols;
mod transport;
mod trees;
mod unread;
mod uri;
mod workspace;
mod workspace_symbols;

use std::io;

pub use server::{Exit, serve};
use transport::Stdio;

/// Serves a client on standard input and output until it says goodbye or its end of the line is closed.
///
/// # Errors
/// The input is not the Language Server Protocol, or the output cannot be written.
pub fn serve_stdio() -> io::Result<Exit> {
    copies::make_them();
    let Stdio { messages, answers, broken, writer } = transport::stdio();
    let exit = serve(&messages, answers);
    transport::finished(writer)?;
    broken.take().map_or(Ok(exit), Err)
}
