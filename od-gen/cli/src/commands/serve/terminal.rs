//! A pseudo-terminal: a serial port without wires, which hosts open by its path.

use std::fs::File;
use std::io::{self, Read as _};
use std::os::fd::{AsFd as _, OwnedFd};
use std::path::{Path, PathBuf};
use std::sync::mpsc::SyncSender;
use std::time::Duration;

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::pty::{OpenptFlags, grantpt, ioctl_tiocgptpeer, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, QueueSelector, tcflush, tcgetattr, tcsetattr};

use super::event::Event;
use super::hosts::Lines;

/// Where terminals are; a link to one is all that an earlier `odgen serve` leaves.
const TERMINALS: &str = "/dev/pts/";
/// How often it is checked whether a host has come.
const NAP: Duration = Duration::from_millis(20);

/// A terminal, which is there for as long as this lives.
pub(super) struct Terminal {
    master: File,
    path: PathBuf,
    /// A link to it, under a name of one's own.
    name: Option<PathBuf>,
}

impl Terminal {
    /// Makes one, and a link to it where a name is given.
    pub(super) fn make(name: Option<&Path>) -> io::Result<Self> {
        let flags = OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC;
        let master = openpt(flags)?;
        grantpt(&master)?;
        unlockpt(&master)?;
        let path = PathBuf::from(ptsname(&master, Vec::new())?.to_string_lossy().into_owned());
        // Hosts that do not set it up find bytes as they are. Opened once and closed, it shows whether a host is there.
        let slave = ioctl_tiocgptpeer(&master, flags)?;
        let mut settings = tcgetattr(&slave)?;
        settings.make_raw();
        tcsetattr(&slave, OptionalActions::Now, &settings)?;
        drop(slave);
        if let Some(name) = name {
            if std::fs::read_link(name).is_ok_and(|to| to.starts_with(TERMINALS)) {
                std::fs::remove_file(name)?;
            }
            std::os::unix::fs::symlink(&path, name)?;
        }
        Ok(Self { master: File::from(master), path, name: name.map(Path::to_owned) })
    }

    /// What hosts open.
    pub(super) fn place(&self) -> &Path {
        self.name.as_deref().unwrap_or(&self.path)
    }

    /// The end to which is written.
    pub(super) fn writing(&self) -> io::Result<File> {
        self.master.try_clone()
    }

    /// Reports the lines of hosts, and that one has gone, in a thread of its own.
    pub(super) fn listen(&self, number: u64, events: SyncSender<Event>) -> io::Result<()> {
        let master = self.master.try_clone()?;
        std::thread::spawn(move || listen(master, number, &events));
        Ok(())
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        if let Some(name) = &self.name
            && std::fs::read_link(name).is_ok_and(|to| to == self.path)
        {
            let _ = std::fs::remove_file(name);
        }
    }
}

/// Whether a host is at the terminal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Host {
    Absent,
    Present,
}

fn listen(mut master: File, number: u64, events: &SyncSender<Event>) {
    let mut lines = Lines::default();
    let mut host = Host::Absent;
    let mut buffer = [0; 512];
    loop {
        let count = match waiting(&master) {
            // A terminal without a host fails to be read.
            Ok(true) => master.read(&mut buffer).unwrap_or(0),
            Ok(false) => 0,
            Err(_) => return,
        };
        if count > 0 {
            host = Host::Present;
            for line in lines.take(buffer.get(..count).unwrap_or_default()) {
                if events.send(Event::Line(number, line)).is_err() {
                    return;
                }
            }
            continue;
        }
        if host == Host::Present && is_left(&master) {
            host = Host::Absent;
            lines.forget();
            if events.send(Event::Gone(number)).is_err() {
                return;
            }
            // What the one before has not read is not for the next one.
            let flags = OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC;
            if let Ok(slave) = ioctl_tiocgptpeer(&master, flags) {
                let _ = flush(&slave);
            }
        }
        std::thread::sleep(NAP);
    }
}

fn flush(slave: &OwnedFd) -> io::Result<()> {
    Ok(tcflush(slave, QueueSelector::IFlush)?)
}

/// Whether there is something to be read; waits a while for it.
fn waiting(master: &File) -> io::Result<bool> {
    Ok(events_of(master, NAP)?.contains(PollFlags::IN))
}

/// Whether no host has it open.
fn is_left(master: &File) -> bool {
    events_of(master, Duration::ZERO)
        .is_ok_and(|events| events.contains(PollFlags::HUP) && !events.contains(PollFlags::IN))
}

fn events_of(master: &File, within: Duration) -> io::Result<PollFlags> {
    let mut fds = [PollFd::from_borrowed_fd(master.as_fd(), PollFlags::IN)];
    let within = Timespec { tv_sec: 0, tv_nsec: within.subsec_nanos().into() };
    match poll(&mut fds, Some(&within)) {
        Ok(_) | Err(rustix::io::Errno::INTR) => {}
        Err(error) => return Err(error.into()),
    }
    let [fd] = fds;
    Ok(fd.revents())
}
