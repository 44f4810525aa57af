//! State machines.

use super::numbered::by_integer;
use super::read::{Field, Reader, owned, reader};
use crate::ast::{CommandDecl, MachineDecl, Name, StateDecl, TransitionDecl};
use crate::diag::Diagnostics;
use crate::keys::{self, command_keys, machine_keys, state_keys, transition_keys};
use crate::source::Spanned;

machine_keys! { reader fn written(name: Name, unsure: bool) -> MachineDecl }
state_keys! { reader fn state(name: Name) -> StateDecl }
transition_keys! { reader fn transition(number: Spanned<i128>) -> TransitionDecl }
command_keys! { reader fn command(name: Name) -> CommandDecl }

pub(super) fn machine(name: Spanned<&str>, reader: Reader<'_>, diagnostics: &mut Diagnostics) -> MachineDecl {
    written(owned(name), reader.has_unknown_key(&keys::MACHINE), reader, diagnostics)
}

impl Field for Vec<StateDecl> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        reader.entries(key).map(|(name, r)| state(owned(name), r, diagnostics)).collect()
    }
}

impl Field for Vec<TransitionDecl> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        let numbered = by_integer(reader.entries(key), "transition", diagnostics).into_iter();
        numbered.map(|(number, r)| transition(number, r, diagnostics)).collect()
    }
}

impl Field for Vec<CommandDecl> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        reader.entries(key).map(|(name, r)| command(owned(name), r, diagnostics)).collect()
    }
}
