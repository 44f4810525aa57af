//! Who talks to the bus: hosts with SLCAN, each with an adapter of its own, and a CAN interface.
//!
//! A thread for each reads, and another one writes, so that a slow client does not hold up the bus.

use std::io::{ErrorKind, Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, SyncSender, channel};
use std::time::Duration;

use firmware_glue::frame::Frame;
use od_bus::slcan::{Adapter, CanFrame, LONGEST, REFUSED};

use super::event::Event;

/// So many bytes wait for a host that does not take them. One by TCP is left then; a terminal loses frames, as adapters do.
const MOST_WAITING: usize = 1 << 20;
/// So many clients are there at once: each takes a buffer and two threads.
const MOST_CLIENTS: usize = 64;
/// After an error that says nothing of the next client, such as too many open files.
const PAUSE: Duration = Duration::from_millis(100);

/// A host and the adapter that it believes to talk to.
struct Host {
    number: u64,
    adapter: Adapter,
    outgoing: Outgoing,
    way: Way,
}

/// How a host came.
enum Way {
    /// By a connection, which ends.
    Connection(TcpStream),
    /// By a terminal, which others may open again.
    Terminal,
}

/// Hosts on a bus.
#[derive(Default)]
pub(super) struct Hosts {
    list: Vec<Host>,
    /// The number of the next one.
    next: u64,
}

impl Hosts {
    /// A client has come. Where there are too many, it is left at once.
    pub(super) fn welcome(&mut self, stream: TcpStream, events: &SyncSender<Event>) {
        if self.list.len() >= MOST_CLIENTS {
            return;
        }
        let ready = stream.set_nodelay(true).and_then(|()| Ok((stream.try_clone()?, stream.try_clone()?)));
        let Ok((reading, writing)) = ready else { return };
        let (number, events) = (self.number(), events.clone());
        std::thread::spawn(move || read(number, reading, &events));
        self.push(number, Outgoing::to(writing), Way::Connection(stream));
    }

    /// A terminal is there, at which hosts come and go.
    #[cfg_attr(not(target_os = "linux"), expect(dead_code, reason = "there are none"))]
    pub(super) fn add_terminal(&mut self, writing: impl Write + Send + 'static) -> u64 {
        let number = self.number();
        self.push(number, Outgoing::to(writing), Way::Terminal);
        number
    }

    const fn number(&mut self) -> u64 {
        let number = self.next;
        self.next += 1;
        number
    }

    fn push(&mut self, number: u64, outgoing: Outgoing, way: Way) {
        self.list.push(Host { number, adapter: Adapter::new(), outgoing, way });
    }

    /// How many hosts have their channel open.
    pub(super) fn listening(&self) -> usize {
        self.list.iter().filter(|host| host.adapter.is_open()).count()
    }

    /// Answers a line of a host; what it puts on the bus. `None` is a line that was too long for one.
    pub(super) fn line(&mut self, number: u64, line: Option<&str>) -> Option<CanFrame> {
        let host = self.list.iter_mut().find(|host| host.number == number)?;
        let reply = line.map(|line| host.adapter.take(line));
        host.outgoing.put(reply.map_or(REFUSED, |reply| reply.answer));
        self.leave_who_takes_nothing();
        reply.and_then(|reply| reply.send)
    }

    /// Shows a frame to all hosts but its sender.
    pub(super) fn show(&mut self, frame: &Frame, sender: Option<u64>, milliseconds: u64) {
        for host in self.list.iter_mut().filter(|host| Some(host.number) != sender) {
            if let Some(line) = host.adapter.show(frame, milliseconds) {
                host.outgoing.put(line.as_bytes());
            }
        }
        self.leave_who_takes_nothing();
    }

    fn leave_who_takes_nothing(&mut self) {
        self.list.retain(|host| match &host.way {
            Way::Connection(stream) if host.outgoing.is_full() => {
                let _ = stream.shutdown(Shutdown::Both);
                false
            }
            Way::Connection(_) | Way::Terminal => true,
        });
    }

    /// A host has gone. At a terminal the next one finds an adapter that was just switched on.
    pub(super) fn gone(&mut self, number: u64) {
        self.list.retain_mut(|host| match host.way {
            Way::Connection(_) => host.number != number,
            Way::Terminal => {
                if host.number == number {
                    host.adapter = Adapter::new();
                    host.outgoing.forget();
                }
                true
            }
        });
    }
}

/// Reports clients that come, in a thread of its own.
pub(super) fn accept(listener: TcpListener, events: SyncSender<Event>) {
    std::thread::spawn(move || {
        loop {
            match listener.accept() {
                Ok((stream, _)) => {
                    if events.send(Event::Came(stream)).is_err() {
                        return;
                    }
                }
                // One that went away before it was let in, or no room for one more: the next one may come.
                Err(_) => std::thread::sleep(PAUSE),
            }
        }
    });
}

/// Reports the lines of a host until it goes.
pub(super) fn read(number: u64, mut from: impl Read, events: &SyncSender<Event>) {
    let mut lines = Lines::default();
    let mut buffer = [0; 512];
    loop {
        let count = match from.read(&mut buffer) {
            Ok(count) => count,
            Err(error) if error.kind() == ErrorKind::Interrupted => continue,
            Err(_) => 0,
        };
        if count == 0 {
            let _ = events.send(Event::Gone(number));
            return;
        }
        for line in lines.take(buffer.get(..count).unwrap_or_default()) {
            if events.send(Event::Line(number, line)).is_err() {
                return;
            }
        }
    }
}

/// Makes lines of what a host sends.
#[derive(Default)]
pub(super) struct Lines {
    line: String,
    is_too_long: bool,
}

impl Lines {
    /// The lines that bytes complete; `None` is one that is too long.
    pub(super) fn take(&mut self, bytes: &[u8]) -> Vec<Option<String>> {
        let mut whole = Vec::new();
        for byte in bytes {
            match byte {
                b'\r' => {
                    let Self { line, is_too_long } = std::mem::take(self);
                    whole.push((!is_too_long).then_some(line));
                }
                // Hosts on some systems send it after the end of a line.
                b'\n' => {}
                _ if self.line.len() >= LONGEST => self.is_too_long = true,
                byte => self.line.push(char::from(*byte)),
            }
        }
        whole
    }

    /// Half a line is not a line when the host that began it has gone.
    #[cfg_attr(not(target_os = "linux"), expect(dead_code, reason = "there are no terminals"))]
    pub(super) fn forget(&mut self) {
        *self = Self::default();
    }
}

/// What is written to a host, by a thread of its own.
struct Outgoing {
    to: Sender<(Arc<Turn>, Vec<u8>)>,
    turn: Arc<Turn>,
    fullness: Fullness,
}

/// The time of one host at a terminal; a connection has one only.
#[derive(Default)]
struct Turn {
    /// Bytes that wait.
    waiting: AtomicUsize,
    /// What still waits then has no receiver.
    is_over: AtomicBool,
}

/// Whether something could not wait any more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fullness {
    Room,
    Full,
}

impl Outgoing {
    fn to(mut host: impl Write + Send + 'static) -> Self {
        let (to, from) = channel::<(Arc<Turn>, Vec<u8>)>();
        std::thread::spawn(move || {
            for (turn, bytes) in from {
                // One that cannot be written to has gone, and the thread that reads from it reports this.
                if !turn.is_over.load(Ordering::Relaxed) {
                    let _ = host.write_all(&bytes).and_then(|()| host.flush());
                }
                turn.waiting.fetch_sub(bytes.len(), Ordering::Relaxed);
            }
        });
        Self { to, turn: Arc::default(), fullness: Fullness::Room }
    }

    /// Lets bytes wait, if there is room.
    fn put(&mut self, bytes: &[u8]) {
        if self.turn.waiting.load(Ordering::Relaxed) + bytes.len() > MOST_WAITING {
            self.fullness = Fullness::Full;
            return;
        }
        self.turn.waiting.fetch_add(bytes.len(), Ordering::Relaxed);
        let _ = self.to.send((Arc::clone(&self.turn), bytes.to_vec()));
    }

    const fn is_full(&self) -> bool {
        matches!(self.fullness, Fullness::Full)
    }

    fn forget(&mut self) {
        self.turn.is_over.store(true, Ordering::Relaxed);
        self.turn = Arc::default();
        self.fullness = Fullness::Room;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_come_in_pieces_and_one_that_is_too_long_is_none() {
        let mut lines = Lines::default();
        assert_eq!(lines.take(b"t60"), []);
        assert_eq!(
            lines.take(b"10\rV\r\n\r"),
            [Some("t6010".to_owned()), Some("V".to_owned()), Some(String::new())]
        );
        assert_eq!(lines.take(&[b'0'; 10_000]), []);
        assert!(lines.line.len() <= LONGEST);
        assert_eq!(lines.take(b"\r\xFF\r"), [None, Some("\u{FF}".to_owned())]);
        assert_eq!(lines.take(b"t60"), []);
        lines.forget();
        assert_eq!(lines.take(b"V\r"), [Some("V".to_owned())]);
    }

    #[test]
    fn a_client_that_takes_nothing_holds_up_no_other_and_is_left() {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let mut deaf = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        let (events, _incoming) = std::sync::mpsc::sync_channel(16);
        let mut hosts = Hosts::default();
        hosts.welcome(listener.accept().unwrap().0, &events);
        assert_eq!(hosts.line(0, Some("O")), None);
        let frame = firmware_glue::frame::CanId::new(0x181).and_then(|id| Frame::data(id, &[0; 8])).unwrap();
        let mut longest = Duration::ZERO;
        // More than any system keeps for a connection.
        for _ in 0..4_000_000 {
            let begin = std::time::Instant::now();
            hosts.show(&frame, None, 0);
            longest = longest.max(begin.elapsed());
            if hosts.list.is_empty() {
                break;
            }
        }
        // Who waited for it would wait for ever; a busy machine makes nothing take as long as this.
        assert!(hosts.list.is_empty() && longest < Duration::from_secs(30), "{longest:?}");
        // What it was sent before it can still have; then comes the end.
        deaf.set_read_timeout(Some(Duration::from_secs(10))).unwrap();
        let mut all = Vec::new();
        assert!(deaf.read_to_end(&mut all).is_ok_and(|count| count > 0) || !all.is_empty());
    }

    #[test]
    fn a_terminal_that_takes_nothing_loses_frames_and_begins_anew() {
        /// Takes nothing until it is allowed to.
        struct Stuck(std::sync::mpsc::Receiver<()>, Sender<Vec<u8>>);
        impl Write for Stuck {
            fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
                let _ = self.0.recv();
                let _ = self.1.send(bytes.to_vec());
                Ok(bytes.len())
            }
            fn flush(&mut self) -> std::io::Result<()> {
                Ok(())
            }
        }
        let (let_it, stuck) = channel();
        let (wrote, written) = channel();
        let mut hosts = Hosts::default();
        let number = hosts.add_terminal(Stuck(stuck, wrote));
        for _ in 0..MOST_WAITING / 4 {
            hosts.line(number, Some("V"));
        }
        assert!(
            hosts.list.iter().all(|host| host.outgoing.turn.waiting.load(Ordering::Relaxed) <= MOST_WAITING)
        );
        hosts.gone(number);
        drop(let_it);
        hosts.line(number, Some("N"));
        // The first answer was on its way; those after it were for a host that has gone.
        let seen: Vec<Vec<u8>> =
            (0..2).map(|_| written.recv_timeout(Duration::from_secs(10)).unwrap()).collect();
        assert_eq!(seen, [b"V1010\r".to_vec(), b"NODGE\r".to_vec()]);
    }
}
