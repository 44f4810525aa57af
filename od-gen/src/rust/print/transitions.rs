//! Transitions of state machines, and what `firmware-glue` needs to run them.

use od_spec::model::{ByDevice, StateMachine, Transition};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::docs::{doc, escape};
use super::machine_names::{is_signed, stem, transition_variant, word_kind};
use super::value::{At, Store, Values};
use crate::plan::{Place, Plan, PlannedEntry, PlannedMachine, ValueKind};

/// The variant of a state.
fn state(planned: &PlannedMachine<'_>, name: &str) -> TokenStream {
    let state = format_ident!("{}State", stem(&planned.name));
    let at = planned.machine.states.iter().position(|state| state.name == name);
    let variant = at.and_then(|at| planned.states.get(at)).map(|variant| format_ident!("{variant}"));
    quote!(#state::#variant)
}

/// How the device makes a transition, as `firmware-glue` has it.
fn by_device(how: ByDevice) -> TokenStream {
    let how = match how {
        ByDevice::Never => quote!(Never),
        ByDevice::Event => quote!(Event),
        ByDevice::Automatic => quote!(Automatic),
    };
    quote!(super::firmware::state_machine::ByDevice::#how)
}

/// The first state, where the specification says which one it is.
fn start(machine: &StateMachine) -> Option<&str> {
    let mut starts = machine.transitions.iter().filter(|transition| transition.from.is_empty());
    match (starts.next(), starts.next()) {
        (Some(start), None) => Some(&start.to),
        (None, _) | (Some(_), Some(_)) => None,
    }
}

impl Plan<'_> {
    /// The transitions of a machine, and the machine itself where the dictionary holds both of its words.
    pub(super) fn transitions(
        &self,
        planned: &PlannedMachine<'_>,
        status: &PlannedEntry<'_>,
        command: &PlannedEntry<'_>,
    ) -> TokenStream {
        let machine = planned.machine;
        if machine.transitions.is_empty() {
            return quote!();
        }
        let states = format_ident!("{}State", stem(&planned.name));
        let name = format_ident!("{}Transition", stem(&planned.name));
        let about = doc(&format!("Transition of the {}, by its number.", escape(&machine.name)));
        let count = Literal::usize_unsuffixed(machine.transitions.len());
        let (mut variants, mut all, mut numbers, mut names) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let (mut leaves, mut enters, mut causes) = (Vec::new(), Vec::new(), Vec::new());
        for one in &machine.transitions {
            let variant = transition_variant(one.number);
            let about = doc(&self.transition_doc(one, machine));
            let number = Literal::u8_unsuffixed(one.number);
            let text = format!("transition {}", one.number);
            let from = one.from.iter().map(|name| state(planned, name));
            let to = state(planned, &one.to);
            let how = by_device(one.by_device);
            variants.push(quote!(#about #variant,));
            all.push(quote!(Self::#variant));
            numbers.push(quote!(Self::#variant => #number,));
            names.push(quote!(Self::#variant => #text,));
            leaves.push(quote!(Self::#variant => &[#(#from),*],));
            enters.push(quote!(Self::#variant => #to,));
            causes.push(quote!(Self::#variant => #how,));
        }
        let engine = self.engine(planned, status, command);
        quote! {
            #about
            #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
            pub enum #name {
                #(#variants)*
            }

            impl #name {
                /// All transitions, ascending.
                pub const ALL: [Self; #count] = [#(#all),*];

                /// The number in the specification.
                pub const fn number(self) -> u8 {
                    match self {
                        #(#numbers)*
                    }
                }

                /// The states that it leaves; none at the start.
                pub const fn leaves(self) -> &'static [#states] {
                    match self {
                        #(#leaves)*
                    }
                }

                /// The state that it enters.
                pub const fn enters(self) -> #states {
                    match self {
                        #(#enters)*
                    }
                }

                /// How the device makes it without a command.
                pub const fn by_device(self) -> super::firmware::state_machine::ByDevice {
                    match self {
                        #(#causes)*
                    }
                }

                /// Its number in words.
                pub const fn name(self) -> &'static str {
                    match self {
                        #(#names)*
                    }
                }
            }

            super::firmware::defmt_text!(#name);

            #engine
        }
    }

    /// What `firmware-glue` needs to run the machine. Words that the dictionary does not hold are the application's affair, and so is the machine then.
    fn engine(
        &self,
        planned: &PlannedMachine<'_>,
        status: &PlannedEntry<'_>,
        command: &PlannedEntry<'_>,
    ) -> TokenStream {
        let (Place::Image(status_at), Place::Image(command_at)) = (status.place, command.place) else {
            return quote!();
        };
        let machine = planned.machine;
        let stem = stem(&planned.name);
        let dictionary = format_ident!("{}", self.name);
        let [states, transitions, commands, name] =
            ["State", "Transition", "Command", "Machine"].map(|word| format_ident!("{stem}{word}"));
        let (values, at) = (Values { plan: self }, At::reference());
        let status_kind = word_kind(status);
        let command_kind = word_kind(command);
        let status_at = Literal::usize_unsuffixed(status_at);
        let command_at = Literal::usize_unsuffixed(command_at);
        let word_type = values.value_type(&command_kind, &at.root);
        let given = values.load(&command_kind, command.size, &at, &quote!(#command_at));
        let given = values.decode(&command_kind, &at.root, &given);
        let asks = if machine.commands.is_empty() {
            quote! {
                fn asks(_: #transitions, _: #word_type, _: #word_type) -> bool {
                    false
                }
            }
        } else {
            quote! {
                fn asks(transition: #transitions, before: #word_type, word: #word_type) -> bool {
                    #commands::ALL
                        .into_iter()
                        .any(|command| command.is_given(before, word) && command.transitions().contains(&transition))
                }
            }
        };
        let shown = self.shown(&status_kind, status.size, &at, &quote!(#status_at));
        let start = start(machine).map(|name| {
            let first = state(planned, name);
            quote! {
                impl super::firmware::state_machine::Start for #states {
                    const START: Self = #first;
                }
            }
        });
        let about = doc(&format!(
            "The {0}: it takes the commands of `{1}`, and shows its state in `{2}`.",
            escape(&machine.name),
            command.id,
            status.id
        ));
        quote! {
            impl super::firmware::state_machine::MachineState for #states {
                type Dictionary = super::#dictionary;
                type Transition = #transitions;
                type Word = #word_type;

                const TRANSITIONS: &'static [#transitions] = &#transitions::ALL;

                fn leaves(transition: #transitions) -> &'static [Self] {
                    transition.leaves()
                }

                fn enters(transition: #transitions) -> Self {
                    transition.enters()
                }

                fn by_device(transition: #transitions) -> super::firmware::state_machine::ByDevice {
                    transition.by_device()
                }

                #asks

                fn command(dictionary: &super::#dictionary) -> #word_type {
                    #given
                }

                fn show(self, dictionary: &mut super::#dictionary) {
                    let (mask, value) = self.bits();
                    #shown
                }
            }

            #start

            #about
            pub type #name = super::firmware::StateMachine<#states>;
        }
    }

    /// Puts `value` into the bits of `mask` of the status word. Patterns have the widths that every number fits, so that storing cannot fail.
    fn shown(&self, kind: &ValueKind, size: usize, at: &At, offset: &TokenStream) -> TokenStream {
        let values = Values { plan: self };
        let plain = ValueKind { named: None, ..kind.clone() };
        let word = values.load(kind, size, at, offset);
        let signed = is_signed(kind);
        let word = if signed { quote!((#word).cast_unsigned()) } else { word };
        let made =
            if signed { quote!((word & !mask | value).cast_signed()) } else { quote!(word & !mask | value) };
        let stored = if kind.named.is_some() { kind } else { &plain };
        let Store { code, .. } = values.store(stored, size, at, offset, &made);
        quote! {
            let word = #word;
            #code;
        }
    }

    fn transition_doc(&self, transition: &Transition, machine: &StateMachine) -> String {
        let from = match transition.from.len() {
            0 => "the start".to_owned(),
            count if count == machine.states.len() => "any state".to_owned(),
            _ => transition.from.iter().map(|name| escape(name)).collect::<Vec<_>>().join(", "),
        };
        let mut text = format!("{}, {from} → {}.", transition.number, escape(&transition.to));
        for (label, words) in [("", &transition.event), ("Action: ", &transition.action)] {
            let words = self.words(words);
            if !words.is_empty() {
                text.push(' ');
                text.push_str(label);
                text.push_str(&words);
            }
        }
        text
    }
}
