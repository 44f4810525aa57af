//! Lines, names of sections and keys.

mod unknown_keys;

use super::rule::FormatRule;
use crate::rules::rules;

rules! { FormatRule:
    text_is_ascii,
    nothing_stands_before_the_text,
    lines_are_short,
    line_breaks_are_alike,
    headers_are_closed,
    headers_begin_their_line,
    headers_stand_alone,
    lines_can_be_read,
    keys_belong_to_a_section,
    sections_are_unique,
    keys_are_unique,
    keys_touch_their_sign,
    keys_are_one_word,
    comments_have_their_sign,
    texts_are_not_quoted,
    sections_are_known,
    information_keys_are_known,
    object_keys_are_known,
    keys_are_in_use,
    section_names_have_their_capitals,
    section_names_are_plain,
    keys_have_their_capitals,
    values_have_no_control_characters,
    objects_come_before_their_sub_indices,
}
