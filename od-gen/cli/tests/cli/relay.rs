//! A relay between `odgen node` and `odgen serve`, which loses and changes frames.

use std::io::{BufRead as _, BufReader, Write as _};
use std::net::{TcpListener, TcpStream};
use std::sync::{Arc, Mutex};
use std::thread;

/// What becomes of a line of SLCAN, without its end; `None`: it is lost.
pub(crate) type Change = Box<dyn FnMut(&str) -> Option<String> + Send>;

/// Changes what goes to the nodes, and what comes from them.
pub(crate) struct Relay {
    /// `tcp:127.0.0.1:PORT`.
    pub(crate) address: String,
}

impl Relay {
    /// Between a client and an adapter (`tcp:127.0.0.1:PORT`).
    pub(crate) fn new(adapter: &str, to_nodes: Change, from_nodes: Change) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = format!("tcp:{}", listener.local_addr().unwrap());
        let adapter = adapter.trim_start_matches("tcp:").to_owned();
        let (up, down) = (Arc::new(Mutex::new(to_nodes)), Arc::new(Mutex::new(from_nodes)));
        thread::spawn(move || {
            for master in listener.incoming() {
                let (Ok(master), Ok(nodes)) = (master, TcpStream::connect(&adapter)) else { return };
                // Lines that wait for each other take 40 ms each.
                master.set_nodelay(true).and_then(|()| nodes.set_nodelay(true)).unwrap();
                let (back, there) = (master.try_clone().unwrap(), nodes.try_clone().unwrap());
                let (up, down) = (Arc::clone(&up), Arc::clone(&down));
                thread::spawn(move || carry(master, there, &up));
                thread::spawn(move || carry(nodes, back, &down));
            }
        });
        Self { address }
    }
}

/// Carries lines until one side ends.
fn carry(from: TcpStream, mut to: TcpStream, change: &Mutex<Change>) {
    let mut lines = BufReader::new(from).split(b'\r');
    while let Some(Ok(line)) = lines.next() {
        let changed = (change.lock().unwrap())(&String::from_utf8(line).unwrap());
        if changed.is_some_and(|line| to.write_all(format!("{line}\r").as_bytes()).is_err()) {
            break;
        }
    }
    let _ = to.shutdown(std::net::Shutdown::Both);
}
