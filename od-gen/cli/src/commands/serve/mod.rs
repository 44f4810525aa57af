//! `odgen serve`: virtual nodes on a bus that others reach by SLCAN or a CAN interface.

mod args;
mod course;
mod event;
mod hosts;
#[cfg(target_os = "linux")]
mod interface;
mod play;
mod script;
#[cfg(target_os = "linux")]
mod terminal;
mod watch;

use std::io::BufRead as _;
use std::net::TcpListener;
use std::path::Path;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::time::{Duration, Instant};

use firmware_glue::frame::Frame;
use od_bus::runtime::{self, Bus, Checks, LiveDictionary, VirtualNode};
use od_bus::slcan::CanFrame;
use od_bus::trace::{Decoder, Node, What};
use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::file_name;

use crate::bus_nodes::BusNodes;
use crate::exit::ERRORS;
use crate::interrupt::Interrupt;
use crate::link::{Link, Side};
use crate::report::{Report, print};
pub(crate) use args::ServeArgs;
use event::{Event, Sender};
use hosts::Hosts;
use play::Play;
use script::Script;
use watch::Watch;

/// Longer than this the loop does not sleep: what a client has written to 1017h begins no later.
const NAP: Duration = Duration::from_millis(20);
/// Shorter than this it does not sleep either: a transfer of which the client's part is awaited has no time of its own.
const SHORTEST: Duration = Duration::from_millis(1);
/// The most events that wait; a faster sender has to wait.
const WAITING: usize = 1024;
/// So often the nodes are asked what they have to say before anything else is heard: nodes that answer each other never
/// come to an end.
const ROUNDS: usize = 16;

pub(crate) fn run(args: &ServeArgs, directory: &Path, report: &Report) -> u8 {
    serve(args, directory, report).unwrap_or_else(|code| code)
}

/// Serves until it is ended.
fn serve(args: &ServeArgs, directory: &Path, report: &Report) -> Result<u8, u8> {
    let link = Link::of(&args.slcan, args.socketcan.as_deref(), Side::Nodes)
        .map_err(|diagnostic| report.refuse(diagnostic))?;
    if args.watch {
        can_watch(args, report)?;
    }
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
    let interrupt = Interrupt::noted();
    let (events, incoming) = sync_channel(WAITING);
    let mut hosts = Hosts::default();
    let place = Place::open(&link, &mut hosts, &events, report)?;
    let names: Vec<String> =
        nodes.iter().map(|(id, _, device)| format!("{} (node {id})", device.key)).collect();
    let title = format!("serving {} at {}", names.join(", "), place.text);
    let code = print(&format!("{title}\n"));
    if code != crate::exit::SUCCESS {
        return Ok(code);
    }
    let known = || nodes.iter().map(|(id, system, device)| Node::new(id, system, device)).collect::<Vec<_>>();
    if script.is_said() {
        listen(events.clone());
    }
    let bus = Bus::new(on_the_bus);
    let watch = if args.watch {
        let opened = Watch::open(&title, known, &bus, events.clone());
        Some(opened.map_err(|error| {
            let message = format!("cannot draw on the terminal: {error}");
            report.refuse(
                Diagnostic::without_place(codes::NO_TERMINAL, message).help("serve without `--watch`"),
            )
        })?)
    } else {
        None
    };
    let running = Loop {
        bus,
        hosts,
        place,
        decoder: args.log.then(|| Decoder::new(known())),
        report,
        start: Instant::now(),
        script,
        play: Play::default(),
        is_sending: true,
        interrupt,
        watch,
    };
    Ok(running.run(&incoming, &events))
}

/// Whether the terminal can show what happens.
fn can_watch(args: &ServeArgs, report: &Report) -> Result<(), u8> {
    use std::io::IsTerminal as _;
    let refuse = |message: &str, help: &str| {
        Err(report.refuse(Diagnostic::without_place(codes::NO_TERMINAL, message).help(help.to_owned())))
    };
    if !std::io::stdout().is_terminal() || !std::io::stdin().is_terminal() {
        return refuse(
            "`--watch` needs a terminal, and standard input or output is not one",
            "serve with `--log` in its place, which prints every frame on standard error",
        );
    }
    if args.script.as_deref() == Some(Path::new("-")) {
        return refuse("`--watch` takes the keys, and `--script -` would, too", "give the script as a file");
    }
    Ok(())
}

/// Where the bus is.
struct Place {
    /// In words that a host can use.
    text: String,
    #[cfg(target_os = "linux")]
    outlet: Option<interface::Outlet>,
    /// For as long as the bus lives.
    #[cfg(target_os = "linux")]
    _terminal: Option<terminal::Terminal>,
}

impl Place {
    fn open(link: &Link, hosts: &mut Hosts, events: &SyncSender<Event>, report: &Report) -> Result<Self, u8> {
        match link {
            Link::Tcp(address) => {
                let cannot = |error: std::io::Error| {
                    let message = format!("cannot listen at {address}: {error}");
                    report.refuse(Diagnostic::without_place(codes::NO_CONNECTION, message).help(
                        "name an address of this machine and a port that is free; port 0 takes a free one",
                    ))
                };
                let listener = TcpListener::bind(address).map_err(cannot)?;
                let place = listener.local_addr().map_err(cannot)?;
                if !place.ip().is_loopback() {
                    report.note(&format!(
                        "other machines reach {place}, too: they can write to the nodes; 127.0.0.1 is for this machine alone"
                    ));
                }
                hosts::accept(listener, events.clone());
                Ok(Self::at(format!("tcp:{place}")))
            }
            Link::Pty { name } => Self::at_terminal(name.as_deref(), hosts, events, report),
            Link::SocketCan(interface) => Self::at_interface(interface, events, report),
            // The other side has one.
            Link::Serial { .. } => Err(ERRORS),
        }
    }

    const fn at(text: String) -> Self {
        Self {
            text,
            #[cfg(target_os = "linux")]
            outlet: None,
            #[cfg(target_os = "linux")]
            _terminal: None,
        }
    }

    #[cfg(target_os = "linux")]
    fn at_terminal(
        name: Option<&Path>,
        hosts: &mut Hosts,
        events: &SyncSender<Event>,
        report: &Report,
    ) -> Result<Self, u8> {
        let made = terminal::Terminal::make(name).and_then(|terminal| {
            let number = hosts.add_terminal(terminal.writing()?);
            terminal.listen(number, events.clone())?;
            Ok(terminal)
        });
        let terminal = made.map_err(|error| {
            let message = match name {
                Some(name) => {
                    format!("cannot make a terminal by the name {}: {error}", crate::report::shown(name))
                }
                None => format!("cannot make a terminal: {error}"),
            };
            report.refuse(
                Diagnostic::without_place(codes::NO_CONNECTION, message)
                    .help("name a path that is free, in a directory where you may write, or none"),
            )
        })?;
        let text = format!("serial:{}", file_name::shown(terminal.place()));
        Ok(Self { _terminal: Some(terminal), ..Self::at(text) })
    }

    #[cfg(not(target_os = "linux"))]
    fn at_terminal(
        _: Option<&Path>,
        _: &mut Hosts,
        _: &SyncSender<Event>,
        report: &Report,
    ) -> Result<Self, u8> {
        Err(report.refuse(crate::link::not_here("pseudo-terminals")))
    }

    #[cfg(target_os = "linux")]
    fn at_interface(name: &str, events: &SyncSender<Event>, report: &Report) -> Result<Self, u8> {
        let outlet = interface::Outlet::open(name, events)
            .map_err(|error| report.refuse(crate::link::no_interface(name, &error)))?;
        Ok(Self { outlet: Some(outlet), ..Self::at(format!("the CAN interface {name}")) })
    }

    #[cfg(not(target_os = "linux"))]
    fn at_interface(_: &str, _: &SyncSender<Event>, report: &Report) -> Result<Self, u8> {
        Err(report.refuse(crate::link::not_here("CAN interfaces (SocketCAN)")))
    }

    /// Sends a frame to those who are not hosts.
    #[cfg_attr(not(target_os = "linux"), expect(clippy::unused_self, reason = "there are none"))]
    fn put(&self, frame: &Frame, sender: Sender) {
        #[cfg(target_os = "linux")]
        if let Some(outlet) = self.outlet.as_ref().filter(|_| sender != Sender::Interface) {
            outlet.put(frame);
        }
        #[cfg(not(target_os = "linux"))]
        let _ = (frame, sender);
    }
}

/// The devices of the nodes as they are served.
fn devices(nodes: &BusNodes, report: &Report) -> Result<Vec<(u8, runtime::Device)>, u8> {
    let mut devices = Vec::new();
    for (id, system, device, sources) in nodes.with_sources() {
        let mut diagnostics = Diagnostics::new();
        let made = runtime::device(system, device, &mut diagnostics);
        report.show(&diagnostics, sources);
        devices.push((id, made.ok_or(ERRORS)?));
    }
    Ok(devices)
}

/// Reports the lines of standard input, in a thread of its own.
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

/// The bus and who is on it.
struct Loop<'a, 't> {
    bus: Bus<'t>,
    hosts: Hosts,
    place: Place,
    decoder: Option<Decoder<'a>>,
    report: &'a Report,
    start: Instant,
    script: Script<'a>,
    play: Play,
    /// Whether the CAN interface takes frames; that it does not is said once.
    #[cfg_attr(not(target_os = "linux"), expect(dead_code, reason = "there is none"))]
    is_sending: bool,
    interrupt: Interrupt,
    watch: Option<Watch<'a>>,
}

impl Loop<'_, '_> {
    fn now(&self) -> u64 {
        u64::try_from(self.start.elapsed().as_micros()).unwrap_or(u64::MAX)
    }

    fn run(mut self, incoming: &Receiver<Event>, events: &SyncSender<Event>) -> u8 {
        while !self.interrupt.is_wanted() {
            self.play();
            let is_quiet = self.speak();
            if let Some(watch) = &mut self.watch {
                watch.draw(&self.bus, self.hosts.listening(), self.start.elapsed());
            }
            let next = self.bus.next_deadline().into_iter().chain(self.play.next_deadline(self.now())).min();
            let deadline = next.map_or(NAP, |next| {
                Duration::from_micros(next.saturating_sub(self.now())).clamp(SHORTEST, NAP)
            });
            let deadline = if is_quiet { deadline } else { SHORTEST };
            match incoming.recv_timeout(deadline) {
                Ok(Event::Came(stream)) => self.hosts.welcome(stream, events),
                Ok(Event::Line(number, line)) => {
                    if let Some(frame) = self.hosts.line(number, line.as_deref()) {
                        self.take(&What::Frame(frame), Sender::Host(number));
                    }
                }
                Ok(Event::Said(line)) => self.script.say(&line, self.report),
                Ok(Event::Gone(number)) => self.hosts.gone(number),
                #[cfg(target_os = "linux")]
                Ok(Event::Seen(what)) => self.take(&what, Sender::Interface),
                #[cfg(target_os = "linux")]
                Ok(Event::NotSent(error)) => {
                    if self.is_sending {
                        self.is_sending = false;
                        self.note(&format!("a frame was not sent, and others may not be: {error}"));
                    }
                }
                #[cfg(target_os = "linux")]
                Ok(Event::Broken(error)) => {
                    let message = format!("{} does not work any more: {error}", self.place.text);
                    drop(self.watch.take());
                    return self.report.refuse(
                        Diagnostic::without_place(codes::NO_CONNECTION, message)
                            .help("`ip link` shows its state"),
                    );
                }
                Ok(Event::Key(key)) => {
                    if self.watch.as_mut().is_some_and(|watch| watch.key(key) == watch::Wish::End) {
                        break;
                    }
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        crate::exit::SUCCESS
    }

    /// Lets the nodes say what they have to say. Whether that was all.
    fn speak(&mut self) -> bool {
        for _ in 0..ROUNDS {
            let frames = self.bus.poll(self.now());
            if frames.is_empty() {
                return true;
            }
            self.show(&frames, Sender::Node);
        }
        false
    }

    /// Takes what another program has put on the bus.
    fn take(&mut self, what: &What, sender: Sender) {
        match what {
            What::Frame(CanFrame::Standard(frame)) => {
                let frames = self.bus.take(*frame, self.now());
                self.show(&frames, sender);
            }
            // No node hears it.
            What::Frame(CanFrame::Extended { .. }) | What::Fd(_) | What::Error => self.log(what),
        }
    }

    /// Does what is due, and says what a node does not do.
    fn play(&mut self) {
        let now = self.now();
        for (at, why) in self.play.go_on(now, self.bus.nodes_mut(), || self.script.next()) {
            let id = self.bus.nodes_mut().get(at).and_then(VirtualNode::id);
            let number = id.map_or_else(|| "without node-ID".to_owned(), |id| id.to_string());
            self.note(&format!("node {number}: {why}"));
        }
    }

    fn note(&mut self, text: &str) {
        if let Some(watch) = &mut self.watch {
            return watch.note(text);
        }
        self.report.note(text);
    }

    /// Shows what was on the bus; the first frame is that of the sender, which does not hear it.
    fn show(&mut self, frames: &[Frame], sender: Sender) {
        let milliseconds = self.now() / 1000;
        for (at, frame) in frames.iter().enumerate() {
            self.log(&What::Frame(CanFrame::Standard(*frame)));
            let sender = if at == 0 { sender } else { Sender::Node };
            let host = match sender {
                Sender::Host(number) => Some(number),
                Sender::Node => None,
                #[cfg(target_os = "linux")]
                Sender::Interface => None,
            };
            self.hosts.show(frame, host, milliseconds);
            self.place.put(frame, sender);
        }
    }

    fn log(&mut self, what: &What) {
        if let Some(watch) = &mut self.watch {
            watch.frame(what);
        }
        if let Some(decoder) = &mut self.decoder {
            let described = decoder.describe(what);
            let seconds = self.start.elapsed().as_secs_f64();
            self.report.write(&format!("({seconds:.6})  {described}\n"));
        }
    }
}
