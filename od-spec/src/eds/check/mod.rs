//! The rules over a text, one file each, named after the fact that they establish, as in `crate::check`. They see sections,
//! keys and lines; what an object's keys mean is the reader's business, what the objects mean together that of the rules
//! over the model.

mod edits;
mod enumeration;
pub(in crate::eds) mod keys;
mod numbered;
mod object_form;
mod rule;

mod commissioning;
mod information;
mod lines;
mod lists;
mod modules;
mod objects;

use crate::diag::Diagnostics;
use crate::eds::view::View;

pub(crate) use lines::nothing_stands_before_the_text::CODE as BYTE_ORDER_MARK;
pub use lists::entries_are_indices::CODE as NO_INDEX;
pub use objects::links_have_an_object::CODE as LINKS_OF_NOTHING;
pub(crate) use rule::FormatRule;

/// All rules, by code.
pub(crate) static RULES: &[FormatRule] = &[
    lines::text_is_ascii::RULE,
    lines::nothing_stands_before_the_text::RULE,
    lines::lines_are_short::RULE,
    lines::line_breaks_are_alike::RULE,
    lines::headers_are_closed::RULE,
    lines::headers_begin_their_line::RULE,
    lines::headers_stand_alone::RULE,
    lines::lines_can_be_read::RULE,
    lines::keys_belong_to_a_section::RULE,
    lines::sections_are_unique::RULE,
    lines::keys_are_unique::RULE,
    lines::keys_touch_their_sign::RULE,
    lines::keys_are_one_word::RULE,
    lines::comments_have_their_sign::RULE,
    lines::texts_are_not_quoted::RULE,
    lines::sections_are_known::RULE,
    lines::information_keys_are_known::RULE,
    lines::object_keys_are_known::RULE,
    lines::keys_are_in_use::RULE,
    lines::section_names_have_their_capitals::RULE,
    lines::section_names_are_plain::RULE,
    lines::keys_have_their_capitals::RULE,
    lines::values_have_no_control_characters::RULE,
    lines::objects_come_before_their_sub_indices::RULE,
    information::information_exists::RULE,
    information::sections_are_complete::RULE,
    information::file_is_described::RULE,
    information::device_is_identified::RULE,
    information::device_says_what_it_can::RULE,
    information::information_is_numbers::RULE,
    information::numbers_are_plain::RULE,
    information::versions_are_numbers::RULE,
    information::format_version_is_current::RULE,
    information::dates_and_times_are_such::RULE,
    information::dates_are_in_order::RULE,
    information::file_has_its_name::RULE,
    information::a_bit_rate_is_supported::RULE,
    information::pdo_counts_agree::RULE,
    information::implied_pdos_are_whole::RULE,
    information::dynamic_channels_agree::RULE,
    information::dummies_are_allowed_or_not::RULE,
    information::every_dummy_is_mentioned::RULE,
    information::dummies_are_static_types::RULE,
    information::dynamic_objects_are_not_described::RULE,
    lists::lists_exist::RULE,
    lists::counts_agree::RULE,
    lists::lists_are_numbered::RULE,
    lists::entries_are_indices::RULE,
    lists::objects_are_listed_once::RULE,
    lists::listed_objects_are_described::RULE,
    lists::objects_are_listed::RULE,
    lists::objects_are_in_their_list::RULE,
    lists::mandatory_objects_are_those_of_the_standard::RULE,
    lists::data_types_are_not_listed::RULE,
    lists::lists_ascend::RULE,
    objects::structured_objects_have_no_value::RULE,
    objects::single_values_have_no_sub_indices::RULE,
    objects::sub_indices_are_counted_in_one_way::RULE,
    objects::sub_indices_are_counted::RULE,
    objects::sub_number_agrees::RULE,
    objects::flags_are_defined::RULE,
    objects::flags_are_needed::RULE,
    objects::links_have_an_object::RULE,
    objects::mapping_has_a_direction::RULE,
    modules::modules_are_described::RULE,
    modules::modules_bring_something::RULE,
    modules::objects_of_modules_are_one_thing::RULE,
    modules::shared_objects_agree::RULE,
    modules::extensions_can_be_counted::RULE,
    modules::connected_modules_are_supported::RULE,
    commissioning::a_node_is_commissioned::RULE,
    commissioning::commissioning_has_its_name::RULE,
    commissioning::node_id_is_one::RULE,
    commissioning::node_is_identified::RULE,
    commissioning::bit_rate_is_standard::RULE,
    commissioning::bit_rate_is_supported::RULE,
    commissioning::serial_numbers_agree::RULE,
    commissioning::files_belong_to_domains::RULE,
    commissioning::settings_belong_to_a_dcf::RULE,
];

/// Applies all rules to a text.
pub(crate) fn document(view: &View<'_>, diagnostics: &mut Diagnostics) {
    document_with(RULES.iter(), view, diagnostics);
}

/// Applies some rules to a text.
pub(crate) fn document_with<'r>(
    rules: impl Iterator<Item = &'r FormatRule>,
    view: &View<'_>,
    diagnostics: &mut Diagnostics,
) {
    for rule in rules {
        (rule.check)(view, diagnostics);
    }
}
