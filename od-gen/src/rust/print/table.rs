//! The constant table and the traits by which `firmware-glue` finds it.

use std::fmt::Write as _;

use od_spec::expr::{ArithmeticOp, CompareOp};
use od_spec::model::DataType;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::attributes::attributes;
use super::docs::{doc, escape};
use super::glue;
use super::literal::{decimal, hex};
use super::value::{At, Values, view_name};
use crate::plan::{Block, Compare, Condition, Directory, Place, Plan, PlannedEntry, Sum};

/// Bytes in a line of a byte string.
const LINE: usize = 16;

/// Arms of a match over rows.
const ARMS: usize = 500;

impl Plan<'_> {
    /// The enumeration of all entries.
    pub(super) fn entry_enum(&self) -> TokenStream {
        let variants = self.entries.iter().map(|entry| {
            let (about, name) = (
                doc(&format!("`{}` {}.", entry.id, escape(&self.full_name(entry)))),
                format_ident!("{}", entry.variant),
            );
            quote!(#about #name,)
        });
        quote! {
            /// Every entry of the dictionary, by ascending index and sub-index.
            #[allow(dead_code, unreachable_pub)]
            #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
            #[repr(u16)]
            pub enum Entry {
                #(#variants)*
            }

            #[allow(dead_code, unreachable_pub)]
            impl Entry {
                /// The name in the specification. It is looked up in one long text: for people, not for loops.
                pub fn name(self) -> &'static str {
                    NAMES.lines().nth(self as usize).unwrap_or_default()
                }
            }

            /// Index, sub-index and name.
            impl core::fmt::Debug for Entry {
                fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                    let id = TABLE.id(*self as u16);
                    write!(f, "{id} {}", self.name())
                }
            }

            firmware::defmt_text!(Entry);
        }
    }

    fn full_name(&self, entry: &PlannedEntry<'_>) -> String {
        self.device.entry_name(entry.id).unwrap_or_default()
    }

    /// The `Dictionary` and `Constrained` traits.
    pub(super) fn traits(&self) -> TokenStream {
        let name = format_ident!("{}", self.name);
        let values = Values { plan: self };
        let conditions = self.conditions.iter().enumerate().map(|(number, condition)| {
            let number = Literal::usize_unsuffixed(number);
            let holds = condition_code(&values, condition, &At::top());
            quote!(#number => #holds,)
        });
        let body = if self.conditions.is_empty() {
            quote!(let _ = number; true)
        } else {
            quote!(match number { #(#conditions)* _ => true, })
        };
        let constraints = self.constraints();
        let (entry_of_row, lss) = (self.entry_of_row(), self.device.info.lss);
        quote! {
            impl firmware::Entries for #name {
                type Entry = Entry;
            }

            impl firmware::Dictionary<'static> for #name {
                #[inline]
                fn table(&self) -> &'static glue::Table<'static> {
                    &TABLE
                }

                #[allow(clippy::too_many_lines)]
                #[inline]
                fn entry(&self, row: u16) -> Option<Entry> {
                    #entry_of_row
                }

                #[inline]
                fn row(&self, entry: Entry) -> u16 {
                    entry as u16
                }

                #[inline]
                fn image(&self) -> &[u8] {
                    &self.0
                }

                #[inline]
                fn image_mut(&mut self) -> &mut [u8] {
                    &mut self.0
                }

                #[allow(unused_parens, unused_comparisons)]
                fn condition(&self, number: u16) -> bool {
                    #body
                }

                #[inline]
                fn is_lss_slave(&self) -> bool {
                    #lss
                }
            }

            #constraints
        }
    }

    /// The match that makes an entry of a row: the compiler sees that they are the same number. It needs a time for it that
    /// grows with the square of the arms, so that there are several where there are many.
    fn entry_of_row(&self) -> TokenStream {
        let arm = |row: usize, entry: &PlannedEntry<'_>| {
            let (row, variant) = (Literal::usize_unsuffixed(row), format_ident!("{}", entry.variant));
            quote!(#row => Entry::#variant,)
        };
        let arms: Vec<_> = self.entries.iter().enumerate().map(|(row, entry)| arm(row, entry)).collect();
        if arms.len() <= ARMS {
            return quote!(Some(match row { #(#arms)* _ => return None, }));
        }
        let parts = arms.chunks(ARMS).enumerate().map(|(part, arms)| {
            let function = format_ident!("part_{part}");
            quote! {
                #[inline]
                fn #function(row: u16) -> Option<Entry> {
                    Some(match row { #(#arms)* _ => return None, })
                }
            }
        });
        let calls = arms.chunks(ARMS).enumerate().map(|(part, arms)| {
            let function = format_ident!("part_{part}");
            let [first, last] = [part * ARMS, part * ARMS + arms.len() - 1].map(Literal::usize_unsuffixed);
            quote!(#first..=#last => #function(row),)
        });
        quote!(#(#parts)* match row { #(#calls)* _ => None, })
    }

    fn constraints(&self) -> TokenStream {
        if self.constraints.is_empty() {
            return quote!();
        }
        let name = format_ident!("{}", self.name);
        let values = Values { plan: self };
        let list = self.constraints.iter().map(|constraint| {
            let (text, function) = (constraint.name, format_ident!("{}", constraint.function));
            quote!(glue::Constraint { name: #text, holds: constraints::#function })
        });
        let functions = self.constraints.iter().map(|constraint| {
            let about = self.words(constraint.about);
            let mut text = format!("`{}`", constraint.require.text);
            if let Some(when) = &constraint.when {
                let _ = write!(text, ", while `{}`", when.text);
            }
            text.push('.');
            if constraint.partial {
                text.push_str(" Only what can be known from this device.");
            }
            let about = doc(&format!("{}: {about}\n\n{text}", escape(constraint.name)));
            let function = format_ident!("{}", constraint.function);
            let at = At::reference();
            let require = condition_code(&values, &constraint.require, &at);
            let holds = match &constraint.when {
                Some(when) => {
                    let not_met = not_met_code(&values, when, &at);
                    quote!(#not_met || #require)
                }
                None => require,
            };
            quote! {
                #about
                pub fn #function(dictionary: &super::#name) -> bool {
                    #holds
                }
            }
        });
        quote! {
            impl firmware::Constrained for #name {
                const CONSTRAINTS: &'static [glue::Constraint<Self>] = &[#(#list),*];
            }

            /// Conditions between entries.
            #[allow(dead_code, unreachable_pub, unused_parens, unused_variables, unused_comparisons)]
            pub mod constraints {
                #(#functions)*
            }
        }
    }

    /// Where objects are found by their index.
    fn directory(&self) -> TokenStream {
        let indices: Vec<u16> = self.objects.iter().map(|object| object.object.index.0).collect();
        let Directory { blocks, seeds, order } = Directory::of(&indices);
        let [block_count, bucket_count, order_count] =
            [blocks.len(), seeds.len(), order.len()].map(Literal::usize_unsuffixed);
        let blocks = blocks.into_iter().map(|block| match block {
            Some(Block { number, objects, present }) => {
                let (number, present) = (hex(number.into(), 3), hex(present.into(), 8));
                let objects = Literal::usize_unsuffixed(objects);
                quote!(glue::table::Block::new(#number, #objects, #present))
            }
            None => quote!(glue::table::Block::FREE),
        });
        let seeds = seeds.into_iter().map(Literal::u8_unsuffixed);
        let order = order.into_iter().map(Literal::usize_unsuffixed);
        quote! {
            /// Which of 32 indices have an object, where the directory looks for them.
            static BLOCKS: [glue::table::Block; #block_count] = [#(#blocks),*];

            /// What leads to the place of each block.
            static SEEDS: [u8; #bucket_count] = [#(#seeds),*];

            /// The blocks by ascending index.
            static ORDER: [u16; #order_count] = [#(#order),*];
        }
    }

    /// The tables by which an index and a sub-index become a row and a place.
    pub(super) fn lookup_tables(&self) -> TokenStream {
        let objects = self
            .objects
            .iter()
            .map(|object| usize::from(object.first_row))
            .chain([self.entries.len()])
            .map(Literal::usize_unsuffixed);
        let directory = self.directory();
        let entries = self.entries.iter().map(|entry| {
            let place = match entry.place {
                Place::Image(at) | Place::Constant(at) => at & 0xFFFF,
                Place::Alias => self
                    .row(entry.id)
                    .and_then(|row| self.aliases.iter().position(|alias| alias.row == row))
                    .unwrap_or_default(),
                Place::Application => 0,
            };
            let (attributes, place) =
                (Literal::u16_unsuffixed(entry.attributes), Literal::usize_unsuffixed(place));
            quote!(#attributes, #place)
        });
        let (count, object_count) = (
            Literal::usize_unsuffixed(self.entries.len()),
            Literal::usize_unsuffixed(self.objects.len() + 1),
        );
        quote! {
            /// Rows of the first entries of the objects, by ascending index, and the number of entries.
            static OBJECTS: [u16; #object_count] = [#(#objects),*];

            #directory

            /// Entries by row: attributes and place in turn.
            static ENTRIES: [glue::table::EntryRow; #count] = glue::table::entries(&[#(#entries),*]);
        }
    }

    /// The other tables.
    pub(super) fn tables(&self) -> TokenStream {
        let attributes = self.attributes.iter().map(attributes);
        let sparse = self.objects.iter().filter_map(|object| {
            let subs: Vec<u8> = object.object.entries.iter().map(|entry| entry.sub.0).collect();
            let gapless = subs.iter().enumerate().all(|(at, sub)| at == usize::from(*sub));
            let first = Literal::u16_unsuffixed(object.first_row);
            let subs = subs.into_iter().map(Literal::u8_unsuffixed);
            (!gapless).then(|| quote!(glue::table::SparseObject { first: #first, subs: &[#(#subs),*] }))
        });
        let aliases = self.aliases.iter().filter_map(|alias| {
            let (target, view) = (Literal::u16_unsuffixed(alias.target), view_name(self.entry(alias.row)?));
            Some(quote!(glue::table::Alias { target: #target, view: #view }))
        });
        let limits = self.limits.iter().map(|(low, high)| {
            let (low, high) = (decimal((*low).into()), decimal((*high).into()));
            quote!(glue::table::Limits { low: #low, high: #high })
        });
        let values = self.values.iter().map(|list| {
            let list = list.iter().map(|value| decimal((*value).into()));
            quote!(&[#(#list),*])
        });
        let regions = self.layout.regions.iter().map(|region| {
            let storage = glue::storage(region.storage);
            let (start, end) =
                (Literal::usize_unsuffixed(region.start), Literal::usize_unsuffixed(region.end));
            let layout = hex(region.layout.into(), 8);
            quote!(glue::table::Region { storage: #storage, start: #start, end: #end, layout: #layout })
        });
        let nodes = self.layout.node_ids.iter().map(|(offset, size)| {
            let (offset, size) = (Literal::usize_unsuffixed(*offset), Literal::usize_unsuffixed(*size));
            quote!(glue::image::NodeIdPlace { offset: #offset, size: #size })
        });
        let names: String = self
            .entries
            .iter()
            .map(|entry| self.full_name(entry).replace(['\n', '\r'], " ") + "\n")
            .collect();
        let (constants, factory) = (byte_string(&self.layout.constants), byte_string(&self.layout.factory));
        let [attribute_count, nodes_count, size] =
            [self.attributes.len(), self.layout.node_ids.len(), self.layout.factory.len()]
                .map(Literal::usize_unsuffixed);
        let granularity = Literal::u8_unsuffixed(self.device.info.granularity);
        let dummies = self.device.info.dummies.iter().map(|data_type| glue::data_type(*data_type));
        let dummies = quote!(glue::table::Dummies::NONE #(.with(#dummies))*);
        let pdos = self.pdos.iter().filter_map(|planned| {
            let served = planned.served.as_ref()?;
            let [cob_id, mapping] = [served.cob_id, served.mapping].map(Literal::u16_unsuffixed);
            let rows = served.rows.iter().copied().map(Literal::u16_unsuffixed);
            let index = hex(planned.pdo.communication_index().into(), 4);
            Some(quote!(glue::table::Pdo { index: #index, cob_id: #cob_id, mapping: #mapping, rows: &[#(#rows),*] }))
        });
        let application = self
            .objects
            .iter()
            .find(|object| object.object.index.0 >= 0x2000)
            .map_or(self.entries.len(), |object| usize::from(object.first_row));
        let application = Literal::usize_unsuffixed(application);
        quote! {
            /// What every entry is.
            static TABLE: glue::Table<'static> = glue::Table::generated(glue::table::Parts {
                directory: glue::table::Directory {
                    blocks: &BLOCKS,
                    seeds: &SEEDS,
                    order: &ORDER,
                },
                pdos: &[#(#pdos),*],
                first_application_row: #application,
                objects: &OBJECTS,
                entries: &ENTRIES,
                attributes: &ATTRIBUTES,
                sparse: &[#(#sparse),*],
                aliases: &[#(#aliases),*],
                limits: &[#(#limits),*],
                values: VALUES,
                constants: #constants,
                factory: &FACTORY,
                node_id_places: &NODE_ID_PLACES,
                regions: &[#(#regions),*],
                granularity: #granularity,
                dummies: #dummies,
            });

            /// The values that each enum accepts.
            static VALUES: &[&[i64]] = &[#(#values),*];

            /// What entries have in common.
            static ATTRIBUTES: [glue::table::Attributes; #attribute_count] = [#(#attributes),*];

            /// Values that get the node-ID added to them.
            static NODE_ID_PLACES: [glue::image::NodeIdPlace; #nodes_count] = [#(#nodes),*];

            /// The image after a factory reset of node 0.
            static FACTORY: [u8; #size] = *#factory;

            /// Names of the entries, one a line.
            static NAMES: &str = #names;
        }
    }
}

/// A byte string with 16 bytes a line.
fn byte_string(bytes: &[u8]) -> TokenStream {
    use std::str::FromStr as _;
    let mut text = String::from("b\"");
    for line in bytes.chunks(LINE) {
        text.push_str("\\\n        ");
        for byte in line {
            let _ = write!(text, "\\x{byte:02X}");
        }
    }
    text.push('"');
    let literal = Literal::from_str(&text).unwrap_or_else(|_| Literal::byte_string(bytes));
    quote!(#literal)
}

/// A condition as code. A divisor of 0 leaves it undecided; a condition that is undecided counts as met.
fn condition_code(values: &Values<'_, '_>, condition: &Condition, at: &At) -> TokenStream {
    let all = |comparisons: &[Compare]| {
        let links = comparisons.iter().map(|compare| {
            let link = comparison(values, compare, compare.op, condition.narrow, at);
            with_divisors(values, compare, link, condition.narrow, at)
        });
        quote!(#(#links)&&*)
    };
    match condition.alternatives.as_slice() {
        [comparisons] => all(comparisons),
        alternatives => {
            let alternatives = alternatives.iter().map(|comparisons| all(comparisons));
            quote!(#((#alternatives))||*)
        }
    }
}

/// That a condition does not hold, or is undecided.
fn not_met_code(values: &Values<'_, '_>, condition: &Condition, at: &At) -> TokenStream {
    let one_fails = |comparisons: &[Compare]| {
        let links = comparisons.iter().map(|compare| {
            let link = comparison(values, compare, compare.op.opposite(), condition.narrow, at);
            with_divisors(values, compare, link, condition.narrow, at)
        });
        quote!(#(#links)||*)
    };
    match condition.alternatives.as_slice() {
        [comparisons] => one_fails(comparisons),
        alternatives => {
            let alternatives = alternatives.iter().map(|comparisons| one_fails(comparisons));
            quote!(#((#alternatives))&&*)
        }
    }
}

fn comparison(
    values: &Values<'_, '_>,
    compare: &Compare,
    op: CompareOp,
    narrow: bool,
    at: &At,
) -> TokenStream {
    let (left, right) = (sum(values, &compare.left, narrow, at), sum(values, &compare.right, narrow, at));
    match op {
        CompareOp::Less => quote!(#left < #right),
        CompareOp::LessOrEqual => quote!(#left <= #right),
        CompareOp::Equal => quote!(#left == #right),
        CompareOp::NotEqual => quote!(#left != #right),
        CompareOp::GreaterOrEqual => quote!(#left >= #right),
        CompareOp::Greater => quote!(#left > #right),
    }
}

fn with_divisors(
    values: &Values<'_, '_>,
    compare: &Compare,
    link: TokenStream,
    narrow: bool,
    at: &At,
) -> TokenStream {
    if compare.divisors.is_empty() {
        return link;
    }
    let divisors = compare.divisors.iter().map(|divisor| sum(values, divisor, narrow, at));
    quote!((#(#divisors == 0)||* || #link))
}

fn sum(values: &Values<'_, '_>, of: &Sum, narrow: bool, at: &At) -> TokenStream {
    let number = |id| {
        let entry = values.plan.row(id).and_then(|row| values.plan.entry(row));
        let number = entry.and_then(|entry| Some((values.number(entry, at)?, entry.entry.data_type)));
        match number {
            Some((number, DataType::Unsigned64)) => quote!(i128::from(#number)),
            Some((number, _)) if narrow => number,
            Some((number, _)) => quote!(i128::from(#number)),
            None => quote!(0),
        }
    };
    match of {
        Sum::Number(value) => {
            let literal = decimal(*value);
            quote!(#literal)
        }
        Sum::Entry(id) => number(*id),
        Sum::Bit(id, bit) => {
            let number = number(*id);
            let wide = narrow
                && values.plan.device.entry(*id).is_some_and(|entry| entry.data_type == DataType::Unsigned64);
            let shifted = if *bit == 0 {
                quote!(#number & 1)
            } else {
                let bit = Literal::u8_unsuffixed(*bit);
                quote!(#number >> #bit & 1)
            };
            // The other side has 64 bits with a sign.
            if wide { quote!(i64::from(#shifted != 0)) } else { quote!((#shifted)) }
        }
        Sum::Binary(left, op, right) => {
            let (left, right) = (sum(values, left, narrow, at), sum(values, right, narrow, at));
            match op {
                ArithmeticOp::Add => quote!((#left + #right)),
                ArithmeticOp::Subtract => quote!((#left - #right)),
                ArithmeticOp::Multiply => quote!(#left * #right),
                // Quotients have become products before.
                ArithmeticOp::Divide => quote!((#left / #right)),
            }
        }
    }
}
