//! Accessors of runs: objects by the number in their names.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::super::language::{mutable, setter};
use super::docs::doc;
use super::value::{At, Store, Values};
use crate::plan::{Groups, Place, Plan, PlannedObject, PlannedRun, Shape};

impl Plan<'_> {
    /// The methods of a run.
    pub(super) fn run_methods(&self, run: &PlannedRun, groups: &Groups) -> TokenStream {
        let Some(first) = run.objects.first() else { return quote!() };
        let Some(object) = self.objects.get(*first) else { return quote!() };
        match &object.shape {
            Shape::Group { .. } => self.groups_by_number(run, object, groups.first(*first)),
            Shape::Var => self.values_by_number(run, object, None),
            Shape::Indexed { .. } => self.values_by_number(run, object, Some(self.values_of(object).count())),
        }
    }

    /// Where the values of the object with the number `n` lie, each as an `Option`.
    fn numbered(&self, run: &PlannedRun, object: &PlannedObject<'_>) -> Vec<TokenStream> {
        let (first, last) = (Literal::u16_unsuffixed(run.first), Literal::u16_unsuffixed(run.last()));
        let offsets = self.values_of(object).filter_map(|entry| match entry.place {
            Place::Image(at) => Some(Literal::usize_unsuffixed(at)),
            Place::Constant(_) | Place::Alias | Place::Application => None,
        });
        let steps = run.steps.iter().map(|step| Literal::usize_unsuffixed(*step));
        offsets
            .zip(steps)
            .map(|(start, step)| quote!(glue::image::numbered(n, #first, #last, #start, #step)))
            .collect()
    }

    /// A value of an object, or of `elements` in it, whose sub-index comes after the number.
    fn values_by_number(
        &self,
        run: &PlannedRun,
        object: &PlannedObject<'_>,
        elements: Option<usize>,
    ) -> TokenStream {
        let (at, values) = (At::top(), Values { plan: self });
        let Some(entry) = self.values_of(object).next() else { return quote!() };
        let Some(start) = self.numbered(run, object).into_iter().next() else { return quote!() };
        let (sub, offset) = match elements {
            None => (quote!(), quote!(let offset = #start?;)),
            Some(count) => {
                let (highest, size) =
                    (Literal::usize_unsuffixed(count), Literal::usize_unsuffixed(entry.size));
                let element = quote!(glue::image::element(sub, #highest, start, #size));
                (quote!(sub: u8,), quote!(let start = #start?; let offset = #element?;))
            }
        };
        let place = quote!(offset);
        let raw = values.load(&entry.kind, entry.size, &at, &place);
        let value = values.decode(&entry.kind, &at.root, &raw);
        let encoded = values.encode(&entry.kind, &at.root, &quote!(value));
        let Store { code: store, error } = values.store(&entry.kind, entry.size, &at, &place, &encoded);
        let store = if error.is_some() { quote!(#store.ok()) } else { quote!(#store; Some(())) };
        let (value_type, parameter) =
            (values.value_type(&entry.kind, &at.root), values.parameter_type(&entry.kind, &at.root));
        let name = &run.name;
        let what = match elements {
            None => String::new(),
            Some(count) => format!(" `sub` is the sub-index, 1 to {count}."),
        };
        let about = doc(&(self.run_doc(run) + &what));
        let about_set =
            doc(&format!("Sets what [`{name}`](Self::{name}) reads; `None` if it does not exist."));
        let (get, set) = (format_ident!("{name}"), format_ident!("{}", setter(name)));
        quote! {
            #about
            #[inline]
            pub fn #get(&self, n: u16, #sub) -> Option<#value_type> {
                #offset
                Some(#value)
            }

            #about_set
            #[inline]
            pub fn #set(&mut self, n: u16, #sub value: #parameter) -> Option<()> {
                #offset
                #store
            }
        }
    }

    /// A group of accessors, which all objects of the run share: that of the object at `shared`.
    fn groups_by_number(
        &self,
        run: &PlannedRun,
        object: &PlannedObject<'_>,
        shared: Option<usize>,
    ) -> TokenStream {
        let shared = shared.and_then(|position| self.objects.get(position));
        let Some(Shape::Group { type_name }) = shared.map(|object| &object.shape) else { return quote!() };
        let places = self.numbered(run, object);
        let (name, group) = (&run.name, format_ident!("{type_name}"));
        let about = doc(&self.run_doc(run));
        let about_mut = doc(&format!("[`{name}`](Self::{name}), to be changed."));
        let (get, get_mut) = (format_ident!("{name}"), format_ident!("{}", mutable(name)));
        quote! {
            #about
            #[inline]
            pub fn #get(&self, n: u16) -> Option<records::#group<&Self>> {
                Some(records::#group(self, [#(#places?),*]))
            }

            #about_mut
            #[inline]
            pub fn #get_mut(&mut self, n: u16) -> Option<records::#group<&mut Self>> {
                Some(records::#group(self, [#(#places?),*]))
            }
        }
    }

    /// Which objects a run has, and how its accessor finds them.
    fn run_doc(&self, run: &PlannedRun) -> String {
        let object = |position: Option<&usize>| {
            let object = position.and_then(|position| self.objects.get(*position));
            object.map(|object| format!("`{0}` [`{1}`](Self::{1})", object.object.index, object.name))
        };
        let ends = [object(run.objects.first()), object(run.objects.last())];
        let ends: Vec<String> = ends.into_iter().flatten().collect();
        format!(
            "{}, by the number in their names. `n` is {} to {}; `None` for any other.",
            ends.join(" to "),
            run.first,
            run.last()
        )
    }
}
