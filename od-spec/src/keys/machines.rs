//! State machines.

use super::shape::{DEVICES, Key, KeyKind, Keys, NameOf, Shape, U8, U32};
use super::table::keys;
use crate::model::ByDevice;

macro_rules! machine_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "from": Shape::NameOf(NameOf::Library) => from: Option<Name>, "library that defines a machine of this name; states, transitions and commands with the same name or number override those of the library", "cia402";
            "devices": DEVICES => devices: Option<Vec<Name>>, "devices that have it; all unless given";
            "status" inherited: Shape::Entry => status: Option<Name>, "entry that shows the state", "0x6041";
            "command" inherited: Shape::Entry => command: Option<Name>, "entry that takes the commands", "controlword";
            "states" inherited: Shape::MapOf(KeyKind::Name, &Shape::Map(&STATE)) => states: Vec<StateDecl>, "states by name";
            "transitions": Shape::MapOf(KeyKind::Number, &Shape::Map(&TRANSITION)) => transitions: Vec<TransitionDecl>, "transitions by number";
            "commands": Shape::MapOf(KeyKind::Name, &Shape::Map(&COMMAND)) => commands: Vec<CommandDecl>, "commands by name";
        } }
    };
}
pub(crate) use machine_keys;

machine_keys! { keys
    /// A state machine.
    MACHINE = "a state machine"
}

macro_rules! state_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "pattern" inherited: Shape::Pattern => pattern: Option<Spanned<BitPattern>>, "bits of the status entry, most significant first; `x` either", "\"xxxx xxxx x01x 0001\"";
            "about": Shape::Words => about: Words, "meaning";
            "gap": Shape::Words => gap: Words, "what the printed manual leaves open about it";
        } }
    };
}
pub(crate) use state_keys;

state_keys! { keys
    /// A state.
    STATE = "a state"
}

macro_rules! transition_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "from" inherited: Shape::OneOrMore(&Shape::NameOf(NameOf::State)) => from: Vec<Name>, "states it leaves; `start` after power-on, `any` for every state", "[Switched-on, Operation enabled]";
            "to" inherited: Shape::NameOf(NameOf::State) => to: Option<Name>, "state it enters";
            "event" inherited: Shape::Words => event: Words, "what causes it";
            "action": Shape::Words => action: Words, "what the device does";
            "by-device": Shape::Choice(ByDevice::WORDS) => by_device: Option<Spanned<ByDevice>>, "how the device makes it without a command: `automatic` when what it does in the state is complete, `event` when something happens, `never`; unless given, `event` where no command causes it, `never` elsewhere", "automatic";
        } }
    };
}
pub(crate) use transition_keys;

transition_keys! { keys
    /// A transition.
    TRANSITION = "a transition"
}

macro_rules! command_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "pattern" inherited: Shape::Pattern => pattern: Option<Spanned<BitPattern>>, "bits of the command entry, most significant first; `x` either, `r` rising, `f` falling edge", "\"xxxx xxxx 0xxx x110\"";
            "send": U32 => send: Option<Spanned<i128>>, "a value that gives the command", "0x0006";
            "transitions": Shape::List(&U8) => transitions: Vec<Spanned<i128>>, "transitions it causes", "[2, 6, 8]";
            "about": Shape::Words => about: Words, "meaning";
            "gap": Shape::Words => gap: Words, "what the printed manual leaves open about it";
        } }
    };
}
pub(crate) use command_keys;

command_keys! { keys
    /// A command.
    COMMAND = "a command"
}
