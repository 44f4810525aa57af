//! Tries mutants until something fails or the time is over.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::{Complaint, Random, Seed, Subject, mutant, shrink};

/// What is tried, and for how long.
#[derive(Debug, Clone, Copy)]
pub struct Hunt<'a> {
    /// The texts to begin with.
    pub seeds: &'a [Seed],
    /// The number of the first mutant; the next have the numbers after it.
    pub first: u64,
    /// No mutant is begun after this time.
    pub time: Duration,
    /// Most mutants that are tried.
    pub mutants: u64,
    /// Ends after so many failures of different kinds.
    pub failures: usize,
    /// A mutant may take so long.
    pub patience: Duration,
}

/// A mutant that fails.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Caught {
    /// The number that makes it.
    pub number: u64,
    /// The name that it was read under.
    pub name: String,
    /// What is wrong.
    pub complaint: Complaint,
    /// The smallest text that was found for that.
    pub bytes: Vec<u8>,
}

/// What came out.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Outcome {
    /// How many mutants were tried.
    pub tried: u64,
    /// What failed, by number.
    pub caught: Vec<Caught>,
}

/// What the threads have in common.
struct Common<'a> {
    subject: &'a dyn Subject,
    hunt: Hunt<'a>,
    end: Instant,
    next: AtomicU64,
    is_over: AtomicBool,
    kinds: Mutex<BTreeSet<String>>,
    caught: Mutex<Vec<Caught>>,
}

/// Tries mutants in as many threads as the machine has. `stuck` gets a mutant that takes too long: nothing can end it but the end of
/// the program.
pub fn hunt(subject: &dyn Subject, hunt: Hunt<'_>, stuck: impl Fn(u64, &Seed) + Sync) -> Outcome {
    let common = Common {
        subject,
        hunt,
        end: Instant::now() + hunt.time,
        next: AtomicU64::new(0),
        is_over: AtomicBool::new(false),
        kinds: Mutex::default(),
        caught: Mutex::default(),
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    // What each thread is at, since when.
    let at: Vec<Mutex<Option<(Instant, u64)>>> = (0..threads).map(|_| Mutex::default()).collect();
    std::thread::scope(|scope| {
        let workers: Vec<_> = at.iter().map(|at| scope.spawn(|| common.work(at))).collect();
        while workers.iter().any(|worker| !worker.is_finished()) {
            std::thread::sleep(Duration::from_millis(20));
            for at in &at {
                let begun = *at.lock().unwrap_or_else(PoisonError::into_inner);
                let late = begun.filter(|(since, _)| since.elapsed() > hunt.patience);
                if let Some((number, seed)) =
                    late.and_then(|(_, number)| Some((number, common.mutant(number)?)))
                {
                    stuck(number, &seed);
                }
            }
        }
    });
    let mut caught = common.caught.into_inner().unwrap_or_else(PoisonError::into_inner);
    caught.sort_by_key(|one| one.number);
    Outcome { tried: common.next.into_inner().min(hunt.mutants), caught }
}

impl Common<'_> {
    fn mutant(&self, number: u64) -> Option<Seed> {
        mutant(self.hunt.seeds, self.subject.notation(), &mut Random::new(number))
    }

    fn work(&self, at: &Mutex<Option<(Instant, u64)>>) {
        let set = |now| *at.lock().unwrap_or_else(PoisonError::into_inner) = now;
        while Instant::now() < self.end && !self.is_over.load(Ordering::Relaxed) {
            let count = self.next.fetch_add(1, Ordering::Relaxed);
            let number = self.hunt.first.wrapping_add(count);
            let Some(seed) = self.mutant(number).filter(|_| count < self.hunt.mutants) else { break };
            set(Some((Instant::now(), number)));
            let complaints = self.subject.complaints(&seed.name, &seed.bytes);
            set(None);
            for complaint in complaints {
                self.keep(number, &seed, &complaint);
            }
        }
    }

    /// Keeps the first of each kind, made small.
    fn keep(&self, number: u64, seed: &Seed, complaint: &Complaint) {
        let kind = complaint.kind();
        let mut kinds = self.kinds.lock().unwrap_or_else(PoisonError::into_inner);
        if kinds.len() >= self.hunt.failures || !kinds.insert(kind.clone()) {
            return;
        }
        self.is_over.store(kinds.len() >= self.hunt.failures, Ordering::Relaxed);
        drop(kinds);
        let find = |bytes: &[u8]| {
            let complaints = self.subject.complaints(&seed.name, bytes);
            complaints.into_iter().find(|complaint| complaint.kind() == kind)
        };
        let bytes = shrink(&seed.bytes, |bytes| find(bytes).is_some());
        let complaint = find(&bytes).unwrap_or_else(|| complaint.clone());
        let one = Caught { number, name: seed.name.clone(), complaint, bytes };
        self.caught.lock().unwrap_or_else(PoisonError::into_inner).push(one);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fuzz::{EDS, Notation};

    /// Does not like two lines together, and never ends with a third.
    struct Touchy;

    impl Subject for Touchy {
        fn notation(&self) -> &Notation {
            &EDS
        }

        fn complaints(&self, _: &str, bytes: &[u8]) -> Vec<Complaint> {
            let text = String::from_utf8_lossy(bytes);
            let has = |line: &str| text.lines().any(|one| one == line);
            if has("[stuck]") {
                std::thread::sleep(Duration::from_millis(300));
            }
            let bad = has("CompactSubObj=254") && has("[2000]");
            bad.then(|| Complaint { step: "read".to_owned(), what: "no".to_owned() }).into_iter().collect()
        }
    }

    fn seed(text: &str) -> Vec<Seed> {
        vec![Seed { name: "a.eds".to_owned(), bytes: text.as_bytes().to_vec() }]
    }

    fn plan(seeds: &[Seed]) -> Hunt<'_> {
        Hunt {
            seeds,
            first: 5,
            time: Duration::from_secs(60),
            mutants: 20_000,
            failures: 1,
            patience: Duration::from_secs(60),
        }
    }

    #[test]
    fn a_planted_fault_is_found_made_small_and_found_again() {
        let text = "[FileInfo]\r\nA=1\r\nB=2\r\n[1000]\r\nC=3\r\n[2000]\r\nD=4\r\nE=5\r\n";
        let seeds = seed(text);
        let outcome = hunt(&Touchy, plan(&seeds), |_, _| ());
        let [caught] = outcome.caught.as_slice() else { panic!("{outcome:?}") };
        let mut lines: Vec<&str> = std::str::from_utf8(&caught.bytes).unwrap().lines().collect();
        lines.sort_unstable();
        assert_eq!(lines, ["CompactSubObj=254", "[2000]"]);
        let again = Hunt { first: caught.number, mutants: 1, ..plan(&seeds) };
        assert_eq!(hunt(&Touchy, again, |_, _| ()).caught, outcome.caught);
    }

    #[test]
    fn the_number_of_mutants_and_the_time_are_limits() {
        let seeds = seed("[1000]\n");
        assert_eq!(hunt(&Touchy, Hunt { mutants: 7, ..plan(&seeds) }, |_, _| ()).tried, 7);
        assert_eq!(hunt(&Touchy, Hunt { time: Duration::ZERO, ..plan(&seeds) }, |_, _| ()).tried, 0);
    }

    #[test]
    fn a_mutant_that_takes_too_long_is_reported() {
        let seeds = seed("[stuck]\n");
        let reported = Mutex::new(BTreeSet::new());
        let hunted = Hunt { mutants: 20, patience: Duration::from_millis(50), ..plan(&seeds) };
        hunt(&Touchy, hunted, |number, _| {
            reported.lock().unwrap().insert(number);
        });
        assert!(!reported.lock().unwrap().is_empty());
    }
}
