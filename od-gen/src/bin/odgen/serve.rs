//! `odgen serve`: virtual nodes on a bus that clients reach by SLCAN over TCP.

mod script;

use std::io::{BufRead as _, Read as _, Write as _};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::path::Path;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::time::{Duration, Instant};

use firmware_glue::emcy::Raised;
use firmware_glue::frame::Frame;
use od_gen::runtime::{self, Bus, Checks, LiveDictionary, VirtualNode};
use od_gen::slcan::{Adapter, CanFrame, LONGEST, REFUSED};
use od_gen::trace::{Decoder, Node, What};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::source::SourceMap;

use super::ERRORS;
use super::args::ServeArgs;
use super::bus_nodes::BusNodes;
use super::report::{Report, print};
use script::{Act, Script, Step};

/// Longer than this the loop does not sleep: what a client has written to 1017h begins no later.
const NAP: Duration = Duration::from_millis(20);
/// Shorter than this it does not sleep either: a transfer of which the client's part is awaited has no time of its own.
const SHORTEST: Duration = Duration::from_millis(1);
/// A client that takes nothing for so long is left.
const PATIENCE: Duration = Duration::from_secs(1);
/// So many events wait at most; who sends faster has to wait.
const WAITING: usize = 1024;

pub(crate) fn run(args: &ServeArgs, directory: &Path, report: &Report) -> u8 {
    serve(args, directory, report).unwrap_or_else(|code| code)
}

/// What comes from outside.
enum Event {
    /// A client has come.
    Came(TcpStream),
    /// A line of the client with this number; `None` where it was too long for one.
    Line(u64, Option<String>),
    /// The client with this number has gone.
    Gone(u64),
    /// A line of a script on standard input.
    Said(String),
}

/// A client and the adapter that it believes to talk to.
struct Client {
    number: u64,
    stream: TcpStream,
    adapter: Adapter,
}

/// Serves until the process is ended.
fn serve(args: &ServeArgs, directory: &Path, report: &Report) -> Result<u8, u8> {
    let address = args.slcan.strip_prefix("tcp:").ok_or_else(|| {
        let message = format!("found `{}`, expected an address", args.slcan);
        report.refuse(
            Diagnostic::without_place(codes::BAD_NOTATION, message)
                .help("write `--slcan tcp:HOST:PORT`, such as `tcp:127.0.0.1:3333`"),
        )
    })?;
    let nodes = BusNodes::read(&args.nodes, directory, report)?;
    let script = Script::open(args.script.as_deref(), &nodes, report)?;
    let devices = devices(&nodes, report)?;
    let lists: Vec<_> = devices.iter().map(|(id, device)| (*id, device, device.lists())).collect();
    let internal = |error: &dyn std::fmt::Display| {
        let message = format!("a dictionary that contradicts itself: {error}");
        report.refuse(Diagnostic::without_place(codes::NOT_IN_FIRMWARE, message))
    };
    let mut tables = Vec::new();
    for (id, device, lists) in &lists {
        tables.push((*id, *device, lists.table().map_err(|error| internal(&error))?));
    }
    let mut on_the_bus = Vec::new();
    for (id, device, table) in &tables {
        let dictionary = LiveDictionary::new(device, table, *id).map_err(|error| internal(&error))?;
        let mut node = VirtualNode::new(*id, dictionary).map_err(|error| internal(&error))?;
        node.check(if args.consistent { Checks::Constraints } else { Checks::None });
        on_the_bus.push(node);
    }
    let cannot = |error: std::io::Error| {
        let message = format!("cannot listen at {address}: {error}");
        report.refuse(
            Diagnostic::without_place(codes::NO_CONNECTION, message)
                .help("name an address of this machine and a port that is free; port 0 takes a free one"),
        )
    };
    let listener = TcpListener::bind(address).map_err(cannot)?;
    let place = listener.local_addr().map_err(cannot)?;
    let names: Vec<String> =
        nodes.iter().map(|(id, _, device)| format!("{} (node {id})", device.key)).collect();
    let code = print(&format!("serving {} at tcp:{place}\n", names.join(", ")));
    if code != super::SUCCESS {
        return Ok(code);
    }
    let decoder = args.log.then(|| {
        Decoder::new(nodes.iter().map(|(id, system, device)| Node::new(id, system, device)).collect())
    });
    let (events, incoming) = sync_channel(WAITING);
    accept(listener, events.clone());
    if script.is_said() {
        listen(events.clone());
    }
    let bus = Bus::new(on_the_bus);
    Loop { bus, clients: Vec::new(), decoder, report, start: Instant::now(), next: 0, script, pause: None }
        .run(&incoming, &events);
    Ok(super::SUCCESS)
}

/// The devices of the nodes as they are served.
fn devices(nodes: &BusNodes, report: &Report) -> Result<Vec<(u8, runtime::Device)>, u8> {
    let mut devices = Vec::new();
    for (id, system, device) in nodes.iter() {
        let mut diagnostics = Diagnostics::new();
        let made = runtime::device(system, device, &mut diagnostics);
        report.show(&diagnostics, &SourceMap::new());
        devices.push((id, made.ok_or(ERRORS)?));
    }
    Ok(devices)
}

/// Tells of clients that come, in a thread of its own.
fn accept(listener: TcpListener, events: SyncSender<Event>) {
    std::thread::spawn(move || {
        for stream in listener.incoming().map_while(Result::ok) {
            if events.send(Event::Came(stream)).is_err() {
                return;
            }
        }
    });
}

/// Tells the lines of standard input, in a thread of its own.
fn listen(events: SyncSender<Event>) {
    std::thread::spawn(move || {
        let mut input = std::io::stdin().lock();
        let mut line = Vec::new();
        while input.read_until(b'\n', &mut line).is_ok_and(|count| count > 0) {
            let text = String::from_utf8_lossy(&line).trim_end_matches(['\n', '\r']).to_owned();
            if events.send(Event::Said(text)).is_err() {
                return;
            }
            line.clear();
        }
    });
}

/// Tells the lines of a client, in a thread of its own.
fn read(number: u64, mut stream: TcpStream, events: SyncSender<Event>) {
    std::thread::spawn(move || {
        let (mut line, mut is_too_long) = (String::new(), false);
        let mut buffer = [0; 512];
        loop {
            let count = stream.read(&mut buffer).unwrap_or(0);
            if count == 0 {
                let _ = events.send(Event::Gone(number));
                return;
            }
            for byte in buffer.iter().take(count) {
                match byte {
                    b'\r' => {
                        let whole = (!is_too_long).then(|| std::mem::take(&mut line));
                        (line, is_too_long) = (String::new(), false);
                        if events.send(Event::Line(number, whole)).is_err() {
                            return;
                        }
                    }
                    // Hosts on some systems send it behind the end of a line.
                    b'\n' => {}
                    _ if line.len() >= LONGEST => is_too_long = true,
                    byte => line.push(char::from(*byte)),
                }
            }
        }
    });
}

/// The bus and who is on it.
struct Loop<'a, 't> {
    bus: Bus<'t>,
    clients: Vec<Client>,
    decoder: Option<Decoder<'a>>,
    report: &'a Report,
    start: Instant,
    /// The number of the next client.
    next: u64,
    script: Script<'a>,
    /// Until when the script waits.
    pause: Option<u64>,
}

impl Loop<'_, '_> {
    fn now(&self) -> u64 {
        u64::try_from(self.start.elapsed().as_micros()).unwrap_or(u64::MAX)
    }

    fn run(mut self, incoming: &Receiver<Event>, events: &SyncSender<Event>) {
        loop {
            self.act();
            loop {
                let frames = self.bus.poll(self.now());
                if frames.is_empty() {
                    break;
                }
                self.show(&frames, None);
            }
            let next = self.bus.next_deadline().into_iter().chain(self.pause).min();
            let deadline = next.map_or(NAP, |next| {
                Duration::from_micros(next.saturating_sub(self.now())).clamp(SHORTEST, NAP)
            });
            match incoming.recv_timeout(deadline) {
                Ok(Event::Came(stream)) => self.welcome(stream, events),
                Ok(Event::Line(number, line)) => self.line(number, line.as_deref()),
                Ok(Event::Said(line)) => self.script.say(&line, self.report),
                Ok(Event::Gone(number)) => self.clients.retain(|client| client.number != number),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return,
            }
        }
    }

    /// Does what the script says, up to where it waits.
    fn act(&mut self) {
        let now = self.now();
        if self.pause.is_some_and(|until| now < until) {
            return;
        }
        self.pause = None;
        while let Some(step) = self.script.next() {
            let (at, act) = match step {
                Step::Wait(time) => {
                    let time = u64::try_from(time.as_micros()).unwrap_or(u64::MAX);
                    self.pause = Some(now.saturating_add(time));
                    return;
                }
                Step::Act { at, act } => (at, act),
            };
            let Some(node) = self.bus.nodes_mut().get_mut(at) else { continue };
            let refused = match act {
                Act::Fault(emergency) => match node.raise(emergency, now) {
                    Raised::New => None,
                    Raised::Present => Some(format!("error {:04X}h is present already", emergency.code())),
                    Raised::NotKept => {
                        Some(format!("error {:04X}h is one too many: it cannot be cleared", emergency.code()))
                    }
                },
                Act::Clear(code) => {
                    (!node.clear(code, now)).then(|| format!("error {code:04X}h is not present"))
                }
                Act::Set { entry, value, name } => node
                    .set(entry, &value, now)
                    .err()
                    .map(|refusal| format!("{name} cannot be set to this: {refusal}")),
            };
            if let Some(refused) = refused {
                let number = node.id().map_or_else(|| "without node-ID".to_owned(), |id| id.to_string());
                self.report.note(&format!("node {number}: {refused}"));
            }
        }
    }

    fn welcome(&mut self, stream: TcpStream, events: &SyncSender<Event>) {
        let ready = stream.set_write_timeout(Some(PATIENCE)).and_then(|()| stream.set_nodelay(true));
        let (Ok(()), Ok(other)) = (ready, stream.try_clone()) else { return };
        let number = self.next;
        self.next += 1;
        read(number, other, events.clone());
        self.clients.push(Client { number, stream, adapter: Adapter::new() });
    }

    fn line(&mut self, number: u64, line: Option<&str>) {
        let Some(client) = self.clients.iter_mut().find(|client| client.number == number) else { return };
        let reply = line.map(|line| client.adapter.take(line));
        let written = client.stream.write_all(reply.map_or(REFUSED, |reply| reply.answer));
        if written.is_err() {
            self.leave(number);
        }
        match reply.and_then(|reply| reply.send) {
            Some(CanFrame::Standard(frame)) => {
                let frames = self.bus.take(frame, self.now());
                self.show(&frames, Some(number));
            }
            // No node hears it.
            Some(frame @ CanFrame::Extended { .. }) => self.log(&What::Frame(frame)),
            None => {}
        }
    }

    /// Shows clients what was on the bus; the first frame is that of a client, who does not hear it.
    fn show(&mut self, frames: &[Frame], sender: Option<u64>) {
        let milliseconds = self.now() / 1000;
        for (at, frame) in frames.iter().enumerate() {
            self.log(&What::Frame(CanFrame::Standard(*frame)));
            let mut gone = Vec::new();
            for client in &mut self.clients {
                let is_own = at == 0 && Some(client.number) == sender;
                let line = client.adapter.show(frame, milliseconds).filter(|_| !is_own);
                if line.is_some_and(|line| client.stream.write_all(line.as_bytes()).is_err()) {
                    gone.push(client.number);
                }
            }
            for number in gone {
                self.leave(number);
            }
        }
    }

    fn leave(&mut self, number: u64) {
        if let Some(client) = self.clients.iter().find(|client| client.number == number) {
            let _ = client.stream.shutdown(Shutdown::Both);
        }
        self.clients.retain(|client| client.number != number);
    }

    fn log(&mut self, what: &What) {
        if let Some(decoder) = &mut self.decoder {
            let told = decoder.tell(what);
            let seconds = self.start.elapsed().as_secs_f64();
            self.report.write(&format!("({seconds:.6})  {told}\n"));
        }
    }
}
