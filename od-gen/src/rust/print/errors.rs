//! The errors of a device as a type, with what its specification says of each.

use od_spec::model::{ErrorCode, ErrorKind};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::docs::{doc, escape};
use super::literal::hex;
use crate::plan::{Plan, PlannedError};

impl Plan<'_> {
    /// The enum of errors, and of their priorities. "No error" is not an error.
    pub(super) fn error_type(&self) -> TokenStream {
        let errors: Vec<&PlannedError<'_>> =
            self.errors.iter().filter(|planned| planned.error.code != ErrorCode::NONE).collect();
        if errors.is_empty() {
            return quote!();
        }
        let count = Literal::usize_unsuffixed(errors.len());
        let (mut variants, mut all, mut codes, mut known, mut names) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for planned in &errors {
            let (variant, code) = (format_ident!("{}", planned.variant), hex(planned.error.code.into(), 4));
            let about = doc(&self.error_doc(planned.error));
            let name = &planned.error.name;
            variants.push(quote!(#about #variant,));
            all.push(quote!(Self::#variant));
            codes.push(quote!(Self::#variant => #code,));
            known.push(quote!(#code => Some(Self::#variant),));
            names.push(quote!(Self::#variant => #name,));
        }
        let register = register(&errors);
        let priority = self.priority(&errors);
        let priorities = self.priorities_type();
        let reaction = self.reaction(&errors);
        let option_code = self.option_code(&errors);
        quote! {
            /// An error that the device reports.
            #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
            pub enum ErrorCode {
                #(#variants)*
            }

            impl ErrorCode {
                /// All errors, by code.
                pub const ALL: [Self; #count] = [#(#all),*];

                /// The code.
                pub const fn code(self) -> u16 {
                    match self {
                        #(#codes)*
                    }
                }

                /// The error of a code, if the device has it.
                pub const fn of(code: u16) -> Option<Self> {
                    match code {
                        #(#known)*
                        _ => None,
                    }
                }

                /// The name in the specification.
                pub const fn name(self) -> &'static str {
                    match self {
                        #(#names)*
                    }
                }

                #register

                #priority

                #reaction

                #option_code
            }

            impl super::firmware::error_register::DeviceError for ErrorCode {
                fn code(self) -> u16 {
                    self.code()
                }

                fn register(self) -> super::firmware::error_register::ErrorRegister {
                    self.register()
                }
            }

            super::firmware::defmt_text!(ErrorCode);

            #priorities
        }
    }

    fn priority(&self, errors: &[&PlannedError<'_>]) -> Option<TokenStream> {
        let arms = errors.iter().filter(|planned| self.treats(planned.error)).filter_map(|planned| {
            let text = planned.error.priority.as_ref()?;
            let (variant, _) = self.priorities.iter().find(|(_, known)| known == text)?;
            Some((&planned.variant, format_ident!("{variant}")))
        });
        let arms = arms.map(|(error, priority)| (error, quote!(Priority::#priority)));
        let about = "The priority, where the specification states one.";
        method("priority", about, &quote!(Priority), arms, errors.len())
    }

    fn priorities_type(&self) -> Option<TokenStream> {
        let variants = self.priorities.iter().map(|(variant, text)| {
            let (about, variant) = (doc(&format!("Priority {}.", escape(text))), format_ident!("{variant}"));
            quote!(#about #variant,)
        });
        let names = self.priorities.iter().map(|(variant, text)| {
            let variant = format_ident!("{variant}");
            quote!(Self::#variant => #text,)
        });
        (!self.priorities.is_empty()).then(|| {
            quote! {
                /// How urgent an error is, in the classes of the specification. It does not say which is more urgent.
                #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
                pub enum Priority {
                    #(#variants)*
                }

                impl Priority {
                    /// The name in the specification.
                    pub const fn name(self) -> &'static str {
                        match self {
                            #(#names)*
                        }
                    }
                }

                super::firmware::defmt_text!(Priority);
            }
        })
    }

    fn reaction(&self, errors: &[&PlannedError<'_>]) -> Option<TokenStream> {
        let arms = errors.iter().filter(|planned| self.treats(planned.error)).filter_map(|planned| {
            let text = planned.error.reaction.get(self.system.language())?;
            Some((&planned.variant, quote!(#text)))
        });
        let about = "What the device does, in the words of the specification, where it states that.";
        method("reaction", about, &quote!(&'static str), arms, errors.len())
    }

    fn option_code(&self, errors: &[&PlannedError<'_>]) -> Option<TokenStream> {
        let arms = errors.iter().filter(|planned| self.treats(planned.error)).filter_map(|planned| {
            let id = planned.error.option_code?;
            let entry = self.entries.iter().find(|entry| entry.id == id)?;
            let entry = format_ident!("{}", entry.variant);
            Some((&planned.variant, quote!(super::Entry::#entry)))
        });
        let about = "The entry whose value chooses the reaction, where there is one.";
        method("option_code", about, &quote!(super::Entry), arms, errors.len())
    }
}

/// A method that gives something for some errors; none where no error has it. What several give is written once.
fn method<'p>(
    name: &str,
    about: &str,
    of: &TokenStream,
    arms: impl Iterator<Item = (&'p String, TokenStream)>,
    count: usize,
) -> Option<TokenStream> {
    let mut given: Vec<(TokenStream, Vec<TokenStream>)> = Vec::new();
    for (error, value) in arms {
        let error = format_ident!("{error}");
        let error = quote!(Self::#error);
        match given.iter_mut().find(|(known, _)| known.to_string() == value.to_string()) {
            Some((_, errors)) => errors.push(error),
            None => given.push((value, vec![error])),
        }
    }
    let said: usize = given.iter().map(|(_, errors)| errors.len()).sum();
    let (name, about) = (format_ident!("{name}"), doc(about));
    let arms = given.iter().map(|(value, errors)| quote!(#(#errors)|* => Some(#value),));
    let rest = (said < count).then(|| quote!(_ => None,));
    (said > 0).then(|| {
        quote! {
            #about
            pub const fn #name(self) -> Option<#of> {
                match self {
                    #(#arms)*
                    #rest
                }
            }
        }
    })
}

/// The bits of 1001h: what is stated, or else what the class of the code says.
fn register(errors: &[&PlannedError<'_>]) -> TokenStream {
    let path = quote!(super::firmware::error_register::ErrorRegister);
    let stated = errors.iter().filter(|planned| !planned.error.kinds.is_empty());
    let arms: Vec<TokenStream> = stated
        .map(|planned| {
            let variant = format_ident!("{}", planned.variant);
            let kinds = planned.error.kinds.iter().filter(|kind| **kind != ErrorKind::Generic).map(|kind| {
                let kind = format_ident!("{}", kind.word().to_uppercase());
                quote!(.with(#path::#kind))
            });
            quote!(Self::#variant => #path::GENERIC #(#kinds)*,)
        })
        .collect();
    let of_class = quote!(#path::of_code(self.code()));
    let body = if arms.is_empty() {
        of_class
    } else {
        let rest = (arms.len() < errors.len()).then(|| quote!(_ => #of_class,));
        quote!(match self { #(#arms)* #rest })
    };
    quote! {
        /// The bits of 1001h that it sets: those that the specification states, or else that of its class.
        pub const fn register(self) -> #path {
            #body
        }
    }
}
