//! The dictionary's type and its accessors.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::super::language::{elements, mutable, setter};
use super::docs::{doc, escape};
use super::glue;
use super::literal::decimal;
use super::value::{At, Get, Store, Values, view_name};
use crate::plan::{Groups, Place, Plan, PlannedEntry, PlannedObject, Shape, ValueKind};

impl Plan<'_> {
    /// The type of the dictionary with the methods of its objects.
    pub(super) fn dictionary(&self) -> TokenStream {
        let name = format_ident!("{}", self.name);
        let (size, align) = (self.layout.factory.len(), self.layout.align);
        let (size_literal, align) = (Literal::usize_unsuffixed(size), Literal::usize_unsuffixed(align));
        let largest = self.attributes.iter().map(|attributes| attributes.size).max().unwrap_or_default();
        let largest = Literal::usize_unsuffixed(largest);
        let about = self.words(&self.device.about);
        let facts = format!(
            "Object dictionary of the {}: {size} bytes of values, {} objects, {} entries.",
            escape(&self.device.name),
            self.objects.len(),
            self.entries.len()
        );
        let about = doc(&format!("{facts}\n\n{about}"));
        let groups = self.groups();
        let objects = (0..).zip(&self.objects).map(|(at, object)| self.methods(at, object, &groups));
        let runs = self.runs.iter().map(|run| self.run_methods(run, &groups));
        quote! {
            #about
            #[allow(unreachable_pub)]
            #[derive(Debug, Clone)]
            #[repr(C, align(#align))]
            pub struct #name([u8; #size_literal]);

            #[allow(dead_code, unreachable_pub, clippy::unused_self)]
            impl #name {
                /// Bytes of all values.
                pub const SIZE: usize = #size_literal;

                /// Bytes of the largest value that SDO reads or writes as a whole, DOMAINs left out: what a server's buffer
                /// has to hold.
                pub const LARGEST_VALUE: usize = #largest;

                /// The values after a factory reset, for a node-ID from 1 to 127.
                pub const fn new(node_id: u8) -> Self {
                    Self(glue::image::with_node_id(FACTORY, &NODE_ID_PLACES, node_id))
                }

                #(#objects)*

                #(#runs)*
            }
        }
    }

    /// The methods of one object.
    fn methods(&self, at: usize, object: &PlannedObject<'_>, groups: &Groups) -> TokenStream {
        match &object.shape {
            Shape::Var => {
                let Some(entry) = self.entry(object.first_row) else { return quote!() };
                let (get, set) = (
                    self.getter(entry, &object.name, &At::top()),
                    self.setter(entry, &object.name, &At::top()),
                );
                quote!(#get #set)
            }
            Shape::Indexed { count } => self.indexed(object, count.as_deref()),
            Shape::Group { type_name } => {
                let made = self.made(at, object, groups);
                // A group of its own says itself what its members are.
                let about = match &made {
                    Some(_) => doc(&self.object_with_members_doc(object, &At::top().link_root())),
                    None => doc(&self.object_doc(object.object)),
                };
                let about_mut = doc(&format!("[`{0}`](Self::{0}), to be changed.", object.name));
                let (get, get_mut) =
                    (format_ident!("{}", object.name), format_ident!("{}", mutable(&object.name)));
                let group = format_ident!("{type_name}");
                let made = made.unwrap_or_else(|| quote!(records::#group(self)));
                quote! {
                    #about
                    #[inline]
                    pub const fn #get(&self) -> records::#group<&Self> {
                        #made
                    }

                    #about_mut
                    #[inline]
                    pub const fn #get_mut(&mut self) -> records::#group<&mut Self> {
                        #made
                    }
                }
            }
        }
    }

    /// How a group is made that several objects have: with the places of this one's values.
    fn made(&self, at: usize, object: &PlannedObject<'_>, groups: &Groups) -> Option<TokenStream> {
        let first = self.objects.get(groups.first(at)?)?;
        let Shape::Group { type_name } = &first.shape else { return None };
        let group = format_ident!("{type_name}");
        let places = self.accessible(object).filter_map(|entry| match entry.place {
            Place::Image(place) => Some(Literal::usize_unsuffixed(place)),
            Place::Constant(_) | Place::Alias | Place::Application => None,
        });
        Some(quote!(records::#group(self, [#(#places),*])))
    }

    /// Reading an entry. A constant is one in code, too.
    fn getter(&self, entry: &PlannedEntry<'_>, name: &str, at: &At) -> TokenStream {
        let values = Values { plan: self };
        let Some(Get { value, value_type }) = values.get(entry, at) else { return quote!() };
        let (about, name) = (doc(&self.entry_doc(entry, &at.link_root())), format_ident!("{name}"));
        quote! {
            #about
            #[inline]
            pub fn #name(&self) -> #value_type {
                #value
            }
        }
    }

    /// Writing an entry from inside the device: no access, lock or limit is applied.
    fn setter(&self, entry: &PlannedEntry<'_>, name: &str, at: &At) -> TokenStream {
        let Place::Image(offset) = entry.place else { return self.alias_setter(entry, name, at) };
        let offset = Literal::usize_unsuffixed(offset);
        self.setter_at(entry, name, at, &quote!(#offset))
    }

    /// Writing the value at an offset of the image.
    fn setter_at(&self, entry: &PlannedEntry<'_>, name: &str, at: &At, offset: &TokenStream) -> TokenStream {
        let values = Values { plan: self };
        let raw = values.encode(&entry.kind, &at.root, &quote!(value));
        let Store { code: store, error } = values.store(&entry.kind, entry.size, at, offset, &raw);
        let parameter = values.parameter_type(&entry.kind, &at.root);
        let limited = entry.entry.is_limited();
        let unchecked =
            if limited { " The device's own values are not checked against the limits." } else { "" };
        let about = doc(&format!("Sets [`{name}`](Self::{name}).{unchecked}"));
        let set = format_ident!("{}", setter(name));
        match error {
            None => quote! {
                #about
                #[inline]
                pub fn #set(&mut self, value: #parameter) {
                    #store;
                }
            },
            Some(error) => quote! {
                #about
                #[inline]
                pub fn #set(&mut self, value: #parameter) -> Result<(), #error> {
                    #store
                }
            },
        }
    }

    /// Writing the target of an alias in the alias' unit.
    fn alias_setter(&self, entry: &PlannedEntry<'_>, name: &str, at: &At) -> TokenStream {
        let values = Values { plan: self };
        let root = &at.root;
        let planned = (entry.place == Place::Alias && entry.entry.access.is_writable())
            .then(|| values.alias_of(entry))
            .flatten()
            .and_then(|alias| self.entry(alias.target));
        let Some(target) = planned else { return quote!() };
        let Place::Image(offset) = target.place else { return quote!() };
        let offset = Literal::usize_unsuffixed(offset);
        let plain = ValueKind { named: None, unit: None, special: None, ..target.kind.clone() };
        let raw = values.encode(&entry.kind, root, &quote!(value));
        let parameter = values.value_type(&entry.kind, root);
        let view = view_name(entry);
        let number = values.widened(&entry.kind, &raw);
        let target_type = values.raw_type(&plain, root);
        let narrow = quote!(#target_type::try_from(target).map_err(|_| #root glue::OutOfRange)?);
        let Store { code: store, error } =
            values.store(&plain, target.size, at, &quote!(#offset), &quote!(number));
        let store = if error.is_some() { quote!(#store) } else { quote!(#store; Ok(())) };
        let about = doc(&format!(
            "Sets the entry that [`{name}`](Self::{name}) shows.\n\n# Errors\nThe entry has no such value."
        ));
        let set = format_ident!("{}", setter(name));
        quote! {
            #about
            #[inline]
            pub fn #set(&mut self, value: #parameter) -> Result<(), #root glue::OutOfRange> {
                let target = #root #view.target(#number).map_err(|_| #root glue::OutOfRange)?;
                let number = #narrow;
                #store
            }
        }
    }

    /// Elements by their sub-index.
    fn indexed(&self, object: &PlannedObject<'_>, count: Option<&str>) -> TokenStream {
        let values = Values { plan: self };
        let at = At::top();
        let sub0 = count.and_then(|name| {
            let entry = self.entries_of(object).next()?;
            let (get, set) = (self.getter(entry, name, &at), self.setter(entry, name, &at));
            Some(quote!(#get #set))
        });
        let elements: Vec<_> = self.entries_of(object).skip(1).collect();
        let Some(first) = elements.first() else { return quote!(#sub0) };
        let highest = Literal::usize_unsuffixed(elements.len());
        let name = &object.name;
        let about = doc(&self.object_with_elements_doc(object.object, &elements));
        let (get, set) = (format_ident!("{name}"), format_ident!("{}", setter(name)));
        let value_type = values.value_type(&first.kind, &at.root);
        let Place::Image(start) = first.place else {
            return self.constant_elements(object, &elements, sub0.as_ref());
        };
        let (start, size) = (Literal::usize_unsuffixed(start), Literal::usize_unsuffixed(first.size));
        let offset = quote!(offset);
        let raw = values.load(&first.kind, first.size, &at, &offset);
        let value = values.decode(&first.kind, &at.root, &raw);
        let encoded = values.encode(&first.kind, &at.root, &quote!(value));
        let Store { code: store, error } = values.store(&first.kind, first.size, &at, &offset, &encoded);
        let parameter = values.parameter_type(&first.kind, &at.root);
        let store = if error.is_some() { quote!(#store.ok()) } else { quote!(#store; Some(())) };
        let about_set =
            doc(&format!("Sets an element of [`{name}`](Self::{name}); `None` if it does not exist."));
        let all = all_elements(object, elements.len(), &value_type);
        quote! {
            #sub0

            #about
            #[inline]
            pub fn #get(&self, sub: u8) -> Option<#value_type> {
                let offset = glue::image::element(sub, #highest, #start, #size)?;
                Some(#value)
            }

            #all

            #about_set
            #[inline]
            pub fn #set(&mut self, sub: u8, value: #parameter) -> Option<()> {
                let offset = glue::image::element(sub, #highest, #start, #size)?;
                #store
            }
        }
    }

    /// Elements that never change, such as those of a fixed PDO mapping.
    fn constant_elements(
        &self,
        object: &PlannedObject<'_>,
        elements: &[&PlannedEntry<'_>],
        sub0: Option<&TokenStream>,
    ) -> TokenStream {
        let values = Values { plan: self };
        let at = At::top();
        let Some(first) = elements.first() else { return quote!(#sub0) };
        let about = doc(&self.object_with_elements_doc(object.object, elements));
        let (get, value_type) = (format_ident!("{}", object.name), values.value_type(&first.kind, &at.root));
        let arms = elements.iter().filter_map(|element| {
            let sub = Literal::u8_unsuffixed(element.id.sub.0);
            let Get { value, .. } = values.get(element, &at)?;
            Some(quote!(#sub => Some(#value),))
        });
        let all = all_elements(object, elements.len(), &value_type);
        quote! {
            #sub0

            #about
            #[inline]
            pub fn #get(&self, sub: u8) -> Option<#value_type> {
                match sub {
                    #(#arms)*
                    _ => None,
                }
            }

            #all
        }
    }

    /// `mod records`: groups of accessors.
    pub(super) fn records_module(&self) -> TokenStream {
        let shared = self.groups();
        let (groups, can_change): (Vec<_>, Vec<bool>) = (0..)
            .zip(&self.objects)
            .filter_map(|(at, object)| match (&object.shape, shared.first(at), shared.alike(at)) {
                (Shape::Group { type_name }, None, _) => Some(self.group(object, type_name)),
                (Shape::Group { type_name }, Some(_), Some(alike)) => {
                    Some((self.shared_group(object, type_name, alike), true))
                }
                (Shape::Group { type_name }, Some(first), None) => {
                    Some((self.same_group(object, type_name, first)?, false))
                }
                (Shape::Var | Shape::Indexed { .. }, ..) => None,
            })
            .unzip();
        if groups.is_empty() {
            return quote!();
        }
        let traits = if can_change.contains(&true) { quote!({Borrow, BorrowMut}) } else { quote!(Borrow) };
        quote! {
            /// Records, and arrays whose elements have names: groups of accessors.
            #[allow(dead_code, unreachable_pub, clippy::unused_self)]
            pub mod records {
                use core::borrow::#traits;

                #(#groups)*
            }
        }
    }

    /// A group, and whether anything in it can be changed.
    fn group(&self, object: &PlannedObject<'_>, type_name: &str) -> (TokenStream, bool) {
        let at = At::group();
        let (group, name) = (format_ident!("{type_name}"), format_ident!("{}", self.name));
        let about = doc(&self.object_doc(object.object));
        let entries: Vec<_> = self.accessible(object).collect();
        let getters: Vec<_> = entries.iter().map(|entry| self.getter(entry, &entry.member, &at)).collect();
        let setters: TokenStream =
            entries.iter().map(|entry| self.setter(entry, &entry.member, &at)).collect();
        let can_change = !setters.is_empty();
        let setters = if can_change {
            quote!(impl<D: BorrowMut<super::#name>> #group<D> { #setters })
        } else {
            quote!()
        };
        let group = quote! {
            #about
            #[derive(Debug)]
            pub struct #group<D>(pub(super) D);

            impl<D: Borrow<super::#name>> #group<D> {
                #(#getters)*
            }

            #setters
        };
        (group, can_change)
    }

    /// A group that several objects have. It knows the places of its values.
    fn shared_group(&self, object: &PlannedObject<'_>, type_name: &str, alike: &[usize]) -> TokenStream {
        let (at, values) = (At::group(), Values { plan: self });
        let (group, name) = (format_ident!("{type_name}"), format_ident!("{}", self.name));
        let others = alike.len() - 1;
        let others =
            if others == 1 { "another object".to_owned() } else { format!("{others} other objects") };
        let about = doc(&format!("{}\n\nThe group of {others}, too.", self.object_doc(object.object)));
        let objects: Vec<_> = alike.iter().filter_map(|at| self.objects.get(*at)).collect();
        let entries: Vec<_> = self.accessible(object).collect();
        let accessors = entries.iter().enumerate().map(|(member, entry)| {
            let same = objects.iter().filter_map(|object| self.accessible(object).nth(member));
            let about = doc(&self.shared_doc(entry, same));
            let (get, position) = (format_ident!("{}", entry.member), Literal::usize_unsuffixed(member));
            let offset = quote!(self.1[#position]);
            let value_type = values.value_type(&entry.kind, &at.root);
            let raw = values.load(&entry.kind, entry.size, &at, &offset);
            let value = values.decode(&entry.kind, &at.root, &raw);
            let getter = quote! {
                #about
                #[inline]
                pub fn #get(&self) -> #value_type {
                    #value
                }
            };
            let setter = self.setter_at(entry, &entry.member, &at, &offset);
            (getter, setter)
        });
        let (getters, setters): (Vec<_>, Vec<_>) = accessors.unzip();
        let places = Literal::usize_unsuffixed(entries.len());
        quote! {
            #about
            #[derive(Debug)]
            pub struct #group<D>(pub(super) D, pub(super) [usize; #places]);

            impl<D: Borrow<super::#name>> #group<D> {
                #(#getters)*
            }

            impl<D: BorrowMut<super::#name>> #group<D> {
                #(#setters)*
            }
        }
    }

    /// Another object's name for the group that it shares.
    fn same_group(&self, object: &PlannedObject<'_>, type_name: &str, first: usize) -> Option<TokenStream> {
        let Shape::Group { type_name: first } = &self.objects.get(first)?.shape else { return None };
        let (about, group, first) =
            (doc(&self.object_doc(object.object)), format_ident!("{type_name}"), format_ident!("{first}"));
        Some(quote!(#about pub type #group<D> = #first<D>;))
    }

    /// The constants that say how aliases show their targets.
    pub(super) fn views(&self) -> TokenStream {
        let views = self.aliases.iter().filter_map(|alias| {
            let entry = self.entry(alias.row)?;
            let about = doc(&format!("How `{}` shows `{}`.", entry.id, self.entry(alias.target)?.id));
            let name = view_name(entry);
            let (data_type, outside) = (glue::data_type(alias.data_type), glue::outside(alias.outside));
            let view = if (alias.numerator, alias.denominator) == (1, 1) {
                quote!(glue::View::plain(#data_type, #outside))
            } else {
                let rounding = glue::rounding(alias.rounding);
                let (n, d) = (decimal(alias.numerator.into()), decimal(alias.denominator.into()));
                quote!(glue::View::scaled(#data_type, #outside, #n, #d, #rounding))
            };
            Some(quote!(#about const #name: glue::View = #view;))
        });
        quote!(#(#views)*)
    }
}

/// All elements, one after the other.
fn all_elements(object: &PlannedObject<'_>, count: usize, value_type: &TokenStream) -> TokenStream {
    let about = doc(&format!("All elements of [`{0}`](Self::{0}), from sub-index 1 on.", object.name));
    let (get, all) = (format_ident!("{}", object.name), format_ident!("{}", elements(&object.name)));
    let highest = Literal::usize_unsuffixed(count);
    quote! {
        #about
        #[inline]
        pub fn #all(&self) -> impl Iterator<Item = #value_type> + '_ {
            (1..=#highest).filter_map(|sub| self.#get(sub))
        }
    }
}
