//! `CO_driver_custom.h`: what the stack is compiled with for this dictionary, each setting with its reason. The stack includes the file where
//! `CO_DRIVER_CUSTOM` is defined. A project that sets one of these itself keeps its setting, unless the stack would not start with it, or a rule of
//! the dictionary would not be kept. Several dictionaries of one program share the settings of the stack: the file of each then checks them for all that it
//! needs.

use od_spec::model::{Dictionary, Direction, EntryId, Index};

use super::super::prefix::Prefix;
use super::super::text::Text;
use super::rules::Rules;

/// Flags that each service takes from the settings for all services.
const CALLBACK: &str = "CO_CONFIG_GLOBAL_FLAG_CALLBACK_PRE";
const FAST_CALLBACK: &str = "CO_CONFIG_GLOBAL_RT_FLAG_CALLBACK_PRE";
const TIMER: &str = "CO_CONFIG_GLOBAL_FLAG_TIMERNEXT";
const DYNAMIC: &str = "CO_CONFIG_GLOBAL_FLAG_OD_DYNAMIC";

/// A setting of the stack.
struct Setting {
    /// `EM`, of `CO_CONFIG_EM`.
    name: &'static str,
    /// Why it is so.
    because: String,
    flags: Vec<&'static str>,
    /// Flags without which a project's own setting breaks something, and what that is.
    needed: Vec<(&'static str, &'static str)>,
    /// Flags with which a project's own setting breaks something, and what that is.
    refused: Vec<(&'static str, &'static str)>,
}

impl Setting {
    fn new(name: &'static str, because: impl Into<String>, flags: &[&'static str]) -> Self {
        Self { name, because: because.into(), flags: flags.to_vec(), needed: Vec::new(), refused: Vec::new() }
    }

    fn needed(mut self, flag: &'static str, otherwise: &'static str) -> Self {
        self.needed.push((flag, otherwise));
        self
    }

    fn refused(mut self, flag: &'static str, otherwise: &'static str) -> Self {
        self.refused.push((flag, otherwise));
        self
    }

    /// Needs every flag of its own: another dictionary may have made the setting.
    fn shared(mut self) -> Self {
        let common = [CALLBACK, FAST_CALLBACK, TIMER, DYNAMIC];
        for flag in self.flags.clone() {
            let is_named = common.contains(&flag) || self.needed.iter().any(|(needed, _)| *needed == flag);
            if !is_named {
                self =
                    self.needed(flag, "set by another dictionary or the project without what this one needs");
            }
        }
        self
    }

    fn print(&self, text: &mut Text) {
        let Self { name, because, flags, needed, refused } = self;
        text.gap();
        text.comment(because);
        text.line(&format!("#ifndef CO_CONFIG_{name}"));
        text.flags(&format!("CO_CONFIG_{name}"), flags);
        text.line("#endif");
        let mut check = |sign: &str, (flag, otherwise): &(&str, &str)| {
            text.line(&format!("#if ((CO_CONFIG_{name}) & {flag}) {sign} 0"));
            text.line(&format!("#error \"{flag}: {otherwise}\""));
            text.line("#endif");
        };
        for one in needed {
            check("==", one);
        }
        for one in refused {
            check("!=", one);
        }
    }
}

/// Which objects a device has.
#[derive(Clone, Copy)]
struct Has<'a> {
    device: &'a Dictionary,
    program: Program,
}

/// What a program has of dictionaries.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Program {
    /// This one.
    One,
    /// Several, of which some have what others lack: the stack then finds objects when it starts, and not when it is compiled.
    Several,
}

impl Has<'_> {
    fn object(self, index: u16) -> bool {
        self.device.objects.contains_key(&Index(index))
    }

    /// Whether an SDO client can write an object of one value.
    fn writable(self, index: u16) -> bool {
        let object = self.device.objects.get(&Index(index));
        object.and_then(|object| object.entries.first()).is_some_and(|entry| entry.access.is_writable())
    }

    /// What the stack does with a service whose object is missing.
    const fn failure(self, one: &'static str, several: &'static str) -> &'static str {
        match self.program {
            Program::One => one,
            Program::Several => several,
        }
    }

    fn pdos(self, direction: Direction) -> bool {
        let first = direction.first_communication_index();
        self.device.objects.range(Index(first)..Index(first + 0x200)).next().is_some()
    }
}

/// What is between the lines that keep the file from being read twice.
pub(super) fn print(text: &mut Text, device: &Dictionary, prefix: &Prefix, rules: &Rules<'_, '_>) {
    let program = if prefix.is_usual() { Program::One } else { Program::Several };
    let has = Has { device, program };
    text.comment(match program {
        Program::One => {
            "Compile the stack with `-DCO_DRIVER_CUSTOM` and this file in the include path. What is not here is as the stack has it by default."
        }
        Program::Several => {
            "Compile the stack with `-DCO_DRIVER_CUSTOM -DCO_MULTIPLE_OD` and a `CO_driver_custom.h` of the project in the include path, which includes \
             this file of each dictionary. The first one makes a setting, and each checks it. What is not here is as the stack has it by default."
        }
    });
    text.gap();
    text.comment("Flags that each service takes: as the stack has them, unless the project sets them.");
    for (flag, value) in
        [(CALLBACK, "0"), (FAST_CALLBACK, "0"), (TIMER, "0"), (DYNAMIC, "CO_CONFIG_FLAG_OD_DYNAMIC")]
    {
        text.line(&format!("#ifndef {flag}"));
        text.define(flag, value);
        text.line("#endif");
    }
    if let Some((id, size)) = flags(rules) {
        text.gap();
        text.comment(&format!("As many flags in an extension as {id} needs, which a TPDO can carry."));
        text.line("#ifndef OD_FLAGS_PDO_SIZE");
        text.define("OD_FLAGS_PDO_SIZE", &format!("{size}U"));
        text.line("#endif");
    }
    let mut settings = vec![heartbeats(has), guarding(has), emergencies(has)];
    settings.extend(clients(has));
    settings.extend([time(has), sync(has), pdos(has)]);
    if program == Program::One && has.object(0x1005) && !has.object(0x1006) {
        text.gap();
        text.comment("The stack names 1006h also for a device that only receives SYNC.");
        text.line("#ifndef OD_ENTRY_H1006");
        text.define("OD_ENTRY_H1006", "NULL");
        text.line("#endif");
    }
    for setting in settings {
        let setting = if program == Program::Several { setting.shared() } else { setting };
        setting.print(text);
    }
}

/// The entry with the highest sub-index that a TPDO can carry, and the bytes of flags that it needs, where the stack has fewer by default.
fn flags(rules: &Rules<'_, '_>) -> Option<(EntryId, u8)> {
    const USUAL: u8 = 4;
    let highest = rules.transmitted.iter().max_by_key(|id| id.sub)?;
    let size = highest.sub.0 / 8 + 1;
    (size > USUAL).then_some((*highest, size))
}

fn heartbeats(has: Has<'_>) -> Setting {
    const CONSUMER: &str = "CO_CONFIG_HB_CONS_ENABLE";
    if has.object(0x1016) {
        Setting::new("HB_CONS", "Watches the heartbeats of 1016h.", &[CONSUMER, CALLBACK, TIMER, DYNAMIC])
    } else {
        let setting = Setting::new("HB_CONS", "Watches no heartbeats: there is no 1016h.", &[]);
        match has.program {
            Program::One => setting.refused(CONSUMER, "there is no 1016h, and the stack does not compile"),
            Program::Several => setting,
        }
    }
}

fn guarding(has: Has<'_>) -> Setting {
    const SLAVE: &str = "CO_CONFIG_NODE_GUARDING_SLAVE_ENABLE";
    if has.object(0x100C) && has.object(0x100D) {
        Setting::new("NODE_GUARDING", "Answers node guarding, as 100Ch and 100Dh say.", &[SLAVE])
            .needed(SLAVE, "writing 100Ch or 100Dh would do nothing")
    } else {
        Setting::new("NODE_GUARDING", "No node guarding: 100Ch or 100Dh is missing.", &[]).refused(
            SLAVE,
            has.failure(
                "100Ch or 100Dh is missing, and the stack does not compile",
                "100Ch or 100Dh is missing, and the stack does not start",
            ),
        )
    }
}

fn emergencies(has: Has<'_>) -> Setting {
    const PRODUCER: &str = "CO_CONFIG_EM_PRODUCER";
    const COB_ID: &str = "CO_CONFIG_EM_PROD_CONFIGURABLE";
    const HISTORY: &str = "CO_CONFIG_EM_HISTORY";
    let (is_producer, has_history) = (has.object(0x1014), has.object(0x1003));
    let is_inhibited = is_producer && has.object(0x1015);
    let because = [
        if is_producer {
            "Emergency messages with the COB-ID of 1014h"
        } else {
            "No emergency messages, as there is no 1014h"
        },
        if is_inhibited { ", not more often than 1015h says" } else { "" },
        if has_history {
            "; the history of errors is in 1003h."
        } else {
            "; no history of errors, as there is no 1003h."
        },
    ];
    let flags = [
        (is_producer, PRODUCER),
        // Also where the COB-ID is fixed: without it the stack sends with 80h and the node-ID, whatever the dictionary says.
        (is_producer, COB_ID),
        (is_inhibited, "CO_CONFIG_EM_PROD_INHIBIT"),
        (has_history, HISTORY),
        (true, CALLBACK),
        (true, TIMER),
    ];
    let flags: Vec<&'static str> =
        flags.into_iter().filter_map(|(is_set, flag)| is_set.then_some(flag)).collect();
    let setting = Setting::new("EM", because.concat(), &flags);
    let setting = if is_producer {
        setting.needed(COB_ID, "the stack would not use the COB-ID of 1014h")
    } else {
        setting.refused(
            PRODUCER,
            has.failure(
                "there is no 1014h, and the stack does not compile",
                "there is no 1014h, and the stack does not start",
            ),
        )
    };
    if has_history {
        setting
    } else {
        setting.refused(HISTORY, "there is no 1003h, and the stack does not start")
    }
}

fn clients(has: Has<'_>) -> Vec<Setting> {
    if !has.object(0x1280) {
        return Vec::new();
    }
    let client = [
        "CO_CONFIG_SDO_CLI_ENABLE",
        "CO_CONFIG_SDO_CLI_SEGMENTED",
        "CO_CONFIG_SDO_CLI_LOCAL",
        CALLBACK,
        TIMER,
        DYNAMIC,
    ];
    vec![
        Setting::new("SDO_CLI", "The SDO clients of 1280h and what follows.", &client),
        Setting::new("FIFO", "Where SDO clients keep what they transfer.", &["CO_CONFIG_FIFO_ENABLE"]),
    ]
}

fn time(has: Has<'_>) -> Setting {
    const CONSUMER: &str = "CO_CONFIG_TIME_ENABLE";
    if !has.object(0x1012) {
        return Setting::new("TIME", "No time of day: there is no 1012h.", &[]);
    }
    if has.writable(0x1012) {
        let flags = [CONSUMER, "CO_CONFIG_TIME_PRODUCER", CALLBACK, DYNAMIC];
        Setting::new("TIME", "The time of day is received, and sent where 1012h says so.", &flags)
    } else {
        Setting::new("TIME", "The time of day is received, as 1012h says.", &[CONSUMER, CALLBACK, DYNAMIC])
    }
}

fn sync(has: Has<'_>) -> Setting {
    const ENABLE: &str = "CO_CONFIG_SYNC_ENABLE";
    const PRODUCER: &str = "CO_CONFIG_SYNC_PRODUCER";
    match (has.object(0x1005), has.object(0x1006)) {
        (false, _) => Setting::new("SYNC", "No SYNC: there is no 1005h.", &[]),
        (true, false) => Setting::new(
            "SYNC",
            "SYNC is received, and never sent, as there is no 1006h.",
            &[ENABLE, FAST_CALLBACK, TIMER, DYNAMIC],
        )
        .refused(PRODUCER, "there is no 1006h, and the stack does not start"),
        (true, true) => Setting::new(
            "SYNC",
            "SYNC is received, and sent where 1005h says so.",
            &[ENABLE, PRODUCER, FAST_CALLBACK, TIMER, DYNAMIC],
        ),
    }
}

fn pdos(has: Has<'_>) -> Setting {
    const CHECKED: &str = "CO_CONFIG_PDO_OD_IO_ACCESS";
    let (receives, transmits) = (has.pdos(Direction::Receive), has.pdos(Direction::Transmit));
    if !receives && !transmits {
        return Setting::new("PDO", "No PDOs.", &[]);
    }
    let is_in_bits = has.device.pdos.iter().flat_map(|pdo| &pdo.map).any(|mapped| mapped.bits % 8 != 0);
    let flags = [
        (receives, "CO_CONFIG_RPDO_ENABLE"),
        (transmits, "CO_CONFIG_TPDO_ENABLE"),
        (receives, "CO_CONFIG_RPDO_TIMERS_ENABLE"),
        (transmits, "CO_CONFIG_TPDO_TIMERS_ENABLE"),
        (has.object(0x1005), "CO_CONFIG_PDO_SYNC_ENABLE"),
        (true, CHECKED),
        (is_in_bits, "CO_CONFIG_PDO_BITWISE_MAPPING"),
        (true, FAST_CALLBACK),
        (true, TIMER),
        (true, DYNAMIC),
    ];
    let flags: Vec<&'static str> =
        flags.into_iter().filter_map(|(is_set, flag)| is_set.then_some(flag)).collect();
    let because = if is_in_bits {
        "PDOs are read and written through the dictionary, which keeps its rules; a mapping has entries of less than a byte."
    } else {
        "PDOs are read and written through the dictionary, which keeps its rules."
    };
    Setting::new("PDO", because, &flags)
        .needed(CHECKED, "RPDOs would write to memory, past limits, locks and conditions")
}
