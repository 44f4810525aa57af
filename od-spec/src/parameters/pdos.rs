//! PDO parameters: what `pdos:` would not accept is not set either.

use std::collections::BTreeSet;

use super::Setting;
use super::conditions::Configured;
use crate::diag::{Code, Diagnostic, Diagnostics, codes};
use crate::model::{DataType, Direction, EntryId, Index, Origin, Pdo, SubIndex};
use crate::resolve::RESTRICTED_COB_IDS;
use crate::source::Span;

/// Bit of a COB-ID entry: the PDO does not exist.
const NOT_VALID: i128 = 1 << 31;
/// Bit of a COB-ID entry: no remote frames.
const NO_RTR: i128 = 1 << 30;
/// Services of the device whose COB-IDs a PDO must leave alone.
const SERVICES: [(u16, &str); 3] = [(0x1005, "SYNC"), (0x1012, "TIME"), (0x1014, "EMCY")];

/// Checks settings of communication and mapping parameters.
pub(super) fn check(configured: &Configured<'_>, settings: &[Setting], diagnostics: &mut Diagnostics) {
    let mut mappings: BTreeSet<u16> = BTreeSet::new();
    let (errors, _) = diagnostics.count();
    let is_pdo = |index: Index| {
        configured.device.objects.get(&index).is_some_and(|object| object.origin == Origin::Pdo)
    };
    for setting in settings.iter().filter(|setting| is_pdo(setting.id.index)) {
        let index = setting.id.index.0;
        let of = |pdo: &&Pdo| index == pdo.communication_index() || index == pdo.mapping_index();
        let (Some(pdo), Some(raw)) = (configured.device.pdos.iter().find(of), setting.raw) else { continue };
        let problem = match setting.id.sub.0 {
            _ if index == pdo.mapping_index() => {
                mappings.insert(index);
                check_mapping_entry(configured, pdo, setting.id, raw)
            }
            1 => check_cob_id(configured, pdo, raw),
            2 => check_transmission(pdo, raw),
            6 if raw > 240 => Some(Problem::new(
                codes::VALUE_OUTSIDE_LIMITS,
                format!("the SYNC counter never reaches {raw}"),
                "write 0 to 240",
            )),
            _ => None,
        };
        if let Some(problem) = problem {
            diagnostics.push(problem.at(setting));
        }
    }
    if diagnostics.count().0 > errors {
        return;
    }
    for pdo in configured.device.pdos.iter().filter(|pdo| mappings.contains(&pdo.mapping_index())) {
        let of_pdo = |setting: &&Setting| setting.id.index.0 == pdo.mapping_index();
        let last = settings.iter().rfind(of_pdo);
        if let (Some(problem), Some(setting)) = (check_mapping(configured, pdo), last) {
            diagnostics.push(problem.at(setting));
        }
    }
}

/// What is wrong with a setting.
struct Problem {
    code: &'static Code,
    message: String,
    help: &'static str,
}

impl Problem {
    fn new(code: &'static Code, message: String, help: &'static str) -> Self {
        Self { code, message, help }
    }

    fn at(self, setting: &Setting) -> Diagnostic {
        let span: Span = setting.span;
        Diagnostic::new(self.code, span, format!("{}: {}", setting.id, self.message)).help(self.help)
    }
}

fn title(pdo: &Pdo) -> String {
    format!("{} {}", pdo.direction.pdo(), pdo.number)
}

fn check_cob_id(configured: &Configured<'_>, pdo: &Pdo, raw: i128) -> Option<Problem> {
    let id = raw & !(NOT_VALID | NO_RTR);
    let is_off = raw & NOT_VALID != 0;
    if is_off && id == 0 {
        return None;
    }
    let bad = |problem: &str| {
        Some(Problem::new(
            codes::BAD_COB_ID,
            format!("{id:03X}h {problem}"),
            "write a free identifier; bit 31 (0x80000000) switches the PDO off, bit 30 forbids remote frames",
        ))
    };
    if id > 0x7FF {
        return bad("is no 11-bit identifier");
    }
    if RESTRICTED_COB_IDS.iter().any(|(low, high)| (*low..=*high).contains(&id)) {
        return bad("is kept for another service");
    }
    let other = clash(configured, pdo, id).filter(|_| !is_off)?;
    Some(Problem::new(
        codes::COB_ID_CLASH,
        format!("{} would have the COB-ID of {other}", title(pdo)),
        "write a free identifier, or switch the other one off",
    ))
}

/// The PDO or service of the device that has an identifier already.
fn clash(configured: &Configured<'_>, pdo: &Pdo, id: i128) -> Option<String> {
    let at = |index, sub| configured.value(EntryId { index: Index(index), sub: SubIndex(sub) });
    let has = |raw: i128| raw & 0x1FFF_FFFF == id;
    let valid = |other: &&Pdo| {
        let raw = at(other.communication_index(), 1);
        raw.is_some_and(|raw| raw & NOT_VALID == 0 && has(raw))
    };
    let mut others = configured.device.pdos.iter();
    let other = others.find(|other| other.communication_index() != pdo.communication_index() && valid(other));
    other.map(title).or_else(|| {
        let service = SERVICES.iter().find(|(index, _)| at(*index, 0).is_some_and(has));
        service.map(|(_, name)| (*name).to_owned())
    })
}

fn check_transmission(pdo: &Pdo, raw: i128) -> Option<Problem> {
    let reserved = match pdo.direction {
        Direction::Receive => 241..=253,
        Direction::Transmit => 241..=251,
    };
    if !reserved.contains(&raw) {
        return None;
    }
    Some(Problem::new(
        codes::BAD_TRANSMISSION,
        format!("transmission type {raw} is reserved for {}", title(pdo)),
        "0 to 240: synchronous; 254 and 255: event-driven; 252 and 253: on remote frames, TPDOs only",
    ))
}

/// One entry of a mapping parameter, or the number of them.
fn check_mapping_entry(configured: &Configured<'_>, pdo: &Pdo, id: EntryId, raw: i128) -> Option<Problem> {
    if id.sub.0 == 0 {
        let highest = configured.device.objects.get(&id.index)?.entries.last()?.sub.0;
        if raw <= i128::from(highest) {
            return None;
        }
        return Some(Problem::new(
            codes::BAD_PDO_KEY,
            format!("{raw} entries are more than {} can map: {highest}", title(pdo)),
            "map fewer entries",
        ));
    }
    if raw == 0 {
        return None;
    }
    let target = EntryId {
        index: Index(u16::try_from(raw >> 16).ok()?),
        sub: SubIndex(u8::try_from(raw >> 8 & 0xFF).ok()?),
    };
    let length = raw & 0xFF;
    let bits = match mappable(configured, pdo, target) {
        Ok(bits) => i128::from(bits),
        Err((code, message)) => {
            return Some(Problem::new(
                code,
                message,
                "bits 31..16: index, 15..8: sub-index, 7..0: length in bits",
            ));
        }
    };
    if bits != length {
        return Some(Problem::new(
            codes::NOT_MAPPABLE,
            format!("{target} has {bits} bits, not {length}"),
            "write the entry's length in bits 7..0",
        ));
    }
    let granularity = i128::from(configured.device.info.granularity.max(1));
    if bits % granularity != 0 {
        return Some(Problem::new(
            codes::BAD_PDO_KEY,
            format!("{target} has {bits} bits, the device's granularity is {granularity}"),
            "map another entry",
        ));
    }
    None
}

/// The length of an entry or placeholder that the PDO can map.
fn mappable(configured: &Configured<'_>, pdo: &Pdo, target: EntryId) -> Result<u16, (&'static Code, String)> {
    let dummy = DataType::ALL.into_iter().find(|data_type| data_type.code() == target.index.0);
    if let Some(dummy) = dummy.filter(|_| target.sub.0 == 0) {
        let taken = pdo.direction == Direction::Receive && configured.device.info.dummies.contains(&dummy);
        return dummy
            .bits()
            .filter(|_| taken)
            .ok_or_else(|| (codes::BAD_DUMMY, format!("{} takes no {dummy} placeholder", title(pdo))));
    }
    let entry = configured
        .device
        .entry(target)
        .ok_or_else(|| (codes::UNKNOWN_ENTRY, format!("there is no entry {target}")))?;
    entry.data_type.bits().filter(|_| entry.pdo.allows(pdo.direction)).ok_or_else(|| {
        let message = format!("{target} ({}) cannot be mapped into {}s", entry.name, pdo.direction.pdo());
        (codes::NOT_MAPPABLE, message)
    })
}

/// The mapping as a whole, with the defaults of what is not set.
fn check_mapping(configured: &Configured<'_>, pdo: &Pdo) -> Option<Problem> {
    let at = |sub| configured.value(EntryId { index: Index(pdo.mapping_index()), sub: SubIndex(sub) });
    let count = u8::try_from(at(0)?).ok()?;
    let mapped: Vec<i128> = (1..=count).filter_map(at).collect();
    if let Some(empty) = mapped.iter().position(|raw| *raw == 0) {
        return Some(Problem::new(
            codes::BAD_PDO_KEY,
            format!("{} maps {count} entries, but entry {} is empty", title(pdo), empty + 1),
            "set the mapped entry, or a smaller number of them",
        ));
    }
    let bits: i128 = mapped.iter().map(|raw| raw & 0xFF).sum();
    if bits <= 64 {
        return None;
    }
    Some(Problem::new(
        codes::PDO_TOO_LONG,
        format!("{} would carry {bits} bits; a PDO holds 64", title(pdo)),
        "map fewer or shorter entries",
    ))
}
