//! Specifications: what the compiler accepts, what it says about the rest, and what the shipped ones hold.

mod agreement;
mod diagnostics;
mod errata;
mod features;
mod fullmo;
mod layout;
mod libraries;
mod nothing_is_lost;
mod parameter_schema;
mod pitch;
mod schema;
mod settings_agree;
mod wrong_specifications;

#[path = "../../shared/typed_yaml.rs"]
mod typed_yaml;
