//! Objects and their entries: kinds, counts, elements, indices, links.

use super::rule::Rule;
use crate::rules::rules;

rules! { Rule:
    counts_agree,
    structures_have_entries,
    network_variables_have_their_indices,
    arrays_have_one_type,
    indices_in_object_areas,
    links_lead_somewhere,
    counts_are_constant,
    elements_are_alike,
}
