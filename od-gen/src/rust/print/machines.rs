//! State machines and error codes.

use od_spec::model::{BitPattern, Command, ErrorCode};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::docs::{doc, escape};
use super::literal::hex;
use super::machine_names::{is_signed, stem, transition_variant, word_kind};
use super::value::Values;
use crate::facts;
use crate::plan::{Plan, PlannedEntry, PlannedError, PlannedMachine};

impl Plan<'_> {
    /// `mod machines`.
    pub(super) fn machines_module(&self) -> TokenStream {
        if self.machines.is_empty() {
            return quote!();
        }
        let machines = self.machines.iter().map(|machine| self.machine(machine));
        quote! {
            /// States that a status word shows, and commands that a control word gives.
            #[allow(dead_code, unreachable_pub)]
            pub mod machines {
                #(#machines)*
            }
        }
    }

    fn machine(&self, planned: &PlannedMachine<'_>) -> TokenStream {
        let (Some(status), Some(command)) = (self.entry(planned.status), self.entry(planned.command)) else {
            return quote!();
        };
        let (states, commands) = (self.states(planned, status), self.commands(planned, command));
        let transitions = self.transitions(planned, status, command);
        quote!(#states #commands #transitions)
    }

    fn states(&self, planned: &PlannedMachine<'_>, status: &PlannedEntry<'_>) -> TokenStream {
        let machine = planned.machine;
        let name = format_ident!("{}State", stem(&planned.name));
        let about = doc(&format!("State of the {}, as `{}` shows it.", escape(&machine.name), status.id));
        let (mut variants, mut arms, mut names) = (Vec::new(), Vec::new(), Vec::new());
        let mut parts = Vec::new();
        for (variant, state) in planned.states.iter().zip(&machine.states) {
            let variant = format_ident!("{variant}");
            let about = self.words(&state.about);
            let about =
                doc(&format!("{}{}{about}", escape(&state.name), if about.is_empty() { "." } else { ": " }));
            let (mask, value) = pattern(&state.pattern);
            let text = &state.name;
            variants.push(quote!(#about #variant,));
            parts.push(quote!(Self::#variant => (#mask, #value),));
            arms.push(quote!(if word & #mask == #value { return Some(Self::#variant); }));
            names.push(quote!(Self::#variant => #text,));
        }
        let (word_type, word) = self.word(status);
        let converted = converted(&word);
        let raw = self.bits_type(status);
        quote! {
            #about
            #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
            pub enum #name {
                #(#variants)*
            }

            impl #name {
                /// The state that the word shows; `None` for a pattern that no state has.
                pub const fn of(word: #word_type) -> Option<Self> {
                    #converted
                    #(#arms)*
                    None
                }

                /// The bits of the word that show the state, and their values.
                pub const fn bits(self) -> (#raw, #raw) {
                    match self {
                        #(#parts)*
                    }
                }

                /// The name in the specification.
                pub const fn name(self) -> &'static str {
                    match self {
                        #(#names)*
                    }
                }
            }

            super::firmware::defmt_text!(#name);
        }
    }

    fn commands(&self, planned: &PlannedMachine<'_>, command: &PlannedEntry<'_>) -> TokenStream {
        let machine = planned.machine;
        if machine.commands.is_empty() {
            return quote!();
        }
        let name = format_ident!("{}Command", stem(&planned.name));
        let transition = format_ident!("{}Transition", stem(&planned.name));
        let about = doc(&format!("Command to the {}, as `{}` takes it.", escape(&machine.name), command.id));
        let (mut variants, mut parts, mut names) = (Vec::new(), Vec::new(), Vec::new());
        let (mut all, mut edges, mut causes) = (Vec::new(), Vec::new(), Vec::new());
        for (variant, one) in planned.commands.iter().zip(&machine.commands) {
            let variant = format_ident!("{variant}");
            let about = doc(&self.command_doc(one));
            let (mask, value) = pattern(&one.pattern);
            let (rising, falling) = one.pattern.edges();
            let digits = one.pattern.0.len().div_ceil(4);
            let (rising, falling) = (hex(rising, digits), hex(falling, digits));
            let text = &one.name;
            let caused = one.transitions.iter().map(|number| transition_variant(*number));
            all.push(quote!(Self::#variant));
            if one.pattern.edges() != (0, 0) {
                edges.push(quote!(Self::#variant => (#rising, #falling),));
            }
            causes.push(quote!(Self::#variant => &[#(#transition::#caused),*],));
            variants.push(quote!(#about #variant,));
            parts.push(quote!(Self::#variant => (#mask, #value),));
            names.push(quote!(Self::#variant => #text,));
        }
        let edges = if edges.is_empty() {
            quote!((0, 0))
        } else {
            let rest = (edges.len() < parts.len()).then(|| quote!(_ => (0, 0),));
            quote!(match self { #(#edges)* #rest })
        };
        let methods = self.command_methods(command, &parts, &edges);
        let count = Literal::usize_unsuffixed(all.len());
        let caused = (!machine.transitions.is_empty()).then(|| {
            quote! {
                /// The transitions that it causes, each in the states that it leaves.
                pub const fn transitions(self) -> &'static [#transition] {
                    match self {
                        #(#causes)*
                    }
                }
            }
        });
        quote! {
            #about
            #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
            pub enum #name {
                #(#variants)*
            }

            impl #name {
                /// All commands.
                pub const ALL: [Self; #count] = [#(#all),*];

                #methods

                #caused

                /// The name in the specification.
                pub const fn name(self) -> &'static str {
                    match self {
                        #(#names)*
                    }
                }
            }

            super::firmware::defmt_text!(#name);
        }
    }

    /// What a command does to the word.
    fn command_methods(
        &self,
        command: &PlannedEntry<'_>,
        parts: &[TokenStream],
        edges: &TokenStream,
    ) -> TokenStream {
        let (word_type, word) = self.word(command);
        let kind = word_kind(command);
        let made = quote!(word & !mask | value);
        let made = if is_signed(&kind) { quote!((#made).cast_signed()) } else { made };
        let made = Values::wrap(&kind, &quote!(super::), &made);
        let raw = self.bits_type(command);
        let converted = converted(&word);
        let before = match (kind.named.is_some(), is_signed(&kind)) {
            (true, _) => Some(quote!(let before = before.0;)),
            (false, true) => Some(quote!(let before = before.cast_unsigned();)),
            (false, false) => None,
        };
        quote! {
            /// The bits of the word that make the command, and their values; an edge counts as the level after it.
            pub const fn bits(self) -> (#raw, #raw) {
                match self {
                    #(#parts)*
                }
            }

            /// The word with the command in it; other bits stay.
            pub const fn apply(self, word: #word_type) -> #word_type {
                let (mask, value) = self.bits();
                #converted
                #made
            }

            /// Whether the word has the bits of the command.
            pub const fn is_in(self, word: #word_type) -> bool {
                let (mask, value) = self.bits();
                #word & mask == value
            }

            /// The bits of the word that have to rise for the command, and those that have to fall.
            pub const fn edges(self) -> (#raw, #raw) {
                #edges
            }

            /// Whether the word gives the command after the word before, from which edges are seen.
            pub const fn is_given(self, before: #word_type, word: #word_type) -> bool {
                let (rising, falling) = self.edges();
                #before
                self.is_in(word) && before & rising == 0 && before & falling == falling
            }
        }
    }

    /// The type of masks of a word.
    fn bits_type(&self, entry: &PlannedEntry<'_>) -> TokenStream {
        let kind = word_kind(entry);
        if !is_signed(&kind) {
            return Values { plan: self }.raw_type(&kind, &quote!(super::));
        }
        let bits = kind.data_type.bits().filter(|bits| matches!(bits, 8 | 16 | 32)).unwrap_or(64);
        let unsigned = format_ident!("u{bits}");
        quote!(#unsigned)
    }

    /// The type of a word, and its raw number.
    fn word(&self, entry: &PlannedEntry<'_>) -> (TokenStream, TokenStream) {
        let values = Values { plan: self };
        let kind = word_kind(entry);
        let raw = match (kind.named.is_some(), is_signed(&kind)) {
            (true, _) => quote!(word.0),
            (false, true) => quote!(word.cast_unsigned()),
            (false, false) => quote!(word),
        };
        (values.value_type(&kind, &quote!(super::)), raw)
    }

    fn command_doc(&self, command: &Command) -> String {
        let about = self.words(&command.about);
        let mut text =
            format!("{}{}{about}", escape(&command.name), if about.is_empty() { "." } else { ": " });
        if !command.transitions.is_empty() {
            let numbers: Vec<String> = command.transitions.iter().map(ToString::to_string).collect();
            text.push_str(" Transitions ");
            text.push_str(&numbers.join(", "));
            text.push('.');
        }
        text
    }

    /// `mod errors`.
    pub(super) fn errors_module(&self) -> TokenStream {
        if self.errors.is_empty() {
            return quote!();
        }
        let constants = self.errors.iter().map(|PlannedError { name, error, .. }| {
            let (about, name) = (doc(&self.error_doc(error)), format_ident!("{name}"));
            let code = hex(error.code.into(), 4);
            quote!(#about pub const #name: u16 = #code;)
        });
        let mut about =
            vec!["Error codes, as emergency messages, `1003h` and `603Fh` carry them.".to_owned()];
        let of_any = &self.device.any_error;
        for (word, text) in
            [("Shown by", &of_any.shown), ("Reaction", &of_any.reaction), ("Reset by", &of_any.reset)]
        {
            let text = self.words(text);
            if !text.is_empty() {
                about.push(format!("- {word}: {text}"));
            }
        }
        if about.len() > 1 {
            about.insert(1, "What holds for every error:".to_owned());
            about.insert(1, String::new());
            about.insert(3, String::new());
        }
        let about = about.iter().map(|line| doc(line));
        let error_type = self.error_type();
        quote! {
            #(#about)*
            #[allow(dead_code, unreachable_pub)]
            pub mod errors {
                #(#constants)*

                #error_type
            }
        }
    }

    pub(super) fn error_doc(&self, error: &ErrorCode) -> String {
        facts::error(self, error, escape)
    }
}

/// Mask and value of a pattern.
fn pattern(pattern: &BitPattern) -> (Literal, Literal) {
    let (mask, value) = pattern.mask_and_value();
    let digits = pattern.0.len().div_ceil(4);
    (hex(mask, digits), hex(value, digits))
}

/// What makes a number of the word, if it is not yet one.
fn converted(word: &TokenStream) -> Option<TokenStream> {
    (word.to_string() != "word").then(|| quote!(let word = #word;))
}
