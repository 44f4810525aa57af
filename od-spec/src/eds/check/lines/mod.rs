//! Lines, names of sections and keys.

pub(super) mod comments_have_their_sign;
pub(super) mod headers_are_closed;
pub(super) mod headers_begin_their_line;
pub(super) mod headers_stand_alone;
pub(super) mod information_keys_are_known;
pub(super) mod keys_are_in_use;
pub(super) mod keys_are_one_word;
pub(super) mod keys_are_unique;
pub(super) mod keys_belong_to_a_section;
pub(super) mod keys_have_their_capitals;
pub(super) mod keys_touch_their_sign;
pub(super) mod line_breaks_are_alike;
pub(super) mod lines_are_short;
pub(super) mod lines_can_be_read;
pub(super) mod nothing_stands_before_the_text;
pub(super) mod object_keys_are_known;
pub(super) mod objects_come_before_their_sub_indices;
pub(super) mod section_names_are_plain;
pub(super) mod section_names_have_their_capitals;
pub(super) mod sections_are_known;
pub(super) mod sections_are_unique;
pub(super) mod text_is_ascii;
pub(super) mod texts_are_not_quoted;
mod unknown_keys;
pub(super) mod values_have_no_control_characters;
