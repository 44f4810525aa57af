//! The specification language for CANopen object dictionaries: its compiler, its checks and the resolved model.
//!
//! One YAML file describes every object of one or several devices. [`compile()`] reads it with the libraries that it
//! uses, checks it, and returns a [`model::System`] in which nothing is left open. All mistakes of a file are reported in
//! one run, each with its place and a stable code ([`diag`]).
//!
//! ```
//! use od_spec::{compile, NoFiles, source::SourceMap};
//!
//! let mut sources = SourceMap::new();
//! let root = sources.add("lamp.od.yaml", "
//! od-spec: 1
//! title: Lamp
//! uses: [cia301]
//! devices:
//!   lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}
//! objects:
//!   0x2000: {name: brightness, type: unsigned8, access: rw, default: 80, max: 100}
//! ");
//! let compiled = compile(&mut sources, root, &mut NoFiles);
//! let lamp = &compiled.system.expect("no errors").devices[0];
//! assert_eq!(lamp.objects.len(), 5); // 1000h, 1001h, 1017h, 1018h, 2000h
//! ```
//!
//! EDS, DCF, XDD and XDC files give the same model: [`compile()`] takes them where it takes a specification. The crate
//! opens no files: a [`Loader`] returns the bytes of the files that a specification names.
//!
//! | module | contents |
//! |---|---|
//! | [`model`] | what backends see: devices, objects, entries, types, PDOs, state machines, documents |
//! | [`diag`], [`source`] | messages, their codes and places, and how they are printed |
//! | [`eds`], [`xdd`] | the text of these files: rules, findings, repairs |
//! | [`plant`] | the nodes of many machines, and their settings |
//! | [`wording`], [`running_text`] | how values and facts read, in each language |
//! | [`keys`], [`yaml`], [`names`] | keys, tree and names of a specification, for editors and references |
//!
//! # Features
//!
//! - `xdd`: XDD and XDC files as input

#![cfg_attr(docsrs, feature(doc_cfg))]

mod ast;
mod catalogue;
mod check;
mod commissioning;
mod compile;
mod decode;
mod describing;
pub mod diag;
pub mod eds;
mod files;
mod fix;
pub mod keys;
mod layout;
mod library;
mod limits;
pub mod model;
pub mod names;
mod node_of_file;
mod notation;
pub mod order;
mod other_bus;
mod parameters;
mod parts;
pub mod plant;
mod resolve;
mod rules;
pub mod running_text;
pub mod source;
mod standard;
mod text;
mod traffic;
pub mod wording;
pub mod xdd;
pub mod yaml;

pub use ast::Untranslated;
pub use catalogue::{all_codes, code};
pub use check::allowed::{can_be_allowed, is_rule};
pub use check::codes as rule_codes;
pub use check::departures::departures;
pub use check::values::start_values_are_allowed::start_of_code;
pub use commissioning::{Commissioning, Denoted, DomainFiles, ParameterValues, TextOfNode, bit_rate};
pub use compile::{Compiled, Strictness, compile, compile_as, compile_with_modules, is_specification};
pub use decode::is_device_key;
pub use diag::nearest;
pub use files::{Loader, NoFiles, add_source, may_be_specification, read_text};
pub use fix::{Change, Fixed, fix};
pub use layout::layout;
pub use library::shipped::{LIBRARIES, features as features_of_text};
pub use library::{Feature, Library, LibraryObject, library, library_in};
pub use node_of_file::NodeOfFile;
pub use notation::{expr, name_pattern, scalar, words};
pub use parameters::{
    Assigned, Assignment, Layer, OnDevice, Origin, ParameterFile, SettingDecl, SettingNames, assign,
    assign_layers, is_parameter_file, on_device, parameter_file, settings, settings_of_map,
};
pub use parts::part_of;
pub use text::{ascii, encoding, file_name, markdown, visible};

/// The README's examples compile and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
