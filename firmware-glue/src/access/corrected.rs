//! Values that come from a memory: what an entry cannot have is corrected.

use core::ops::Range;

use crate::access::check::check_value;
use crate::access::communication;
use crate::access::communication::Before;
use crate::table::mapping::{MAPPING, RECEIVE, TRANSMIT};
use crate::table::stored::{is_reset, reset, value_of};
use crate::table::{Found, Row, Table};

/// Puts the values after a factory reset in the place of those in a part of the image that their entries cannot have; the first such entry. A value
/// of the factory may stay, whatever it is.
pub(crate) fn correct(table: &Table<'_>, image: &mut [u8], part: &Range<usize>, node_id: u8) -> Option<Row> {
    let mut first = None;
    for (row, _) in (0..).zip(table.parts().entries) {
        let found = table.found(row);
        let Some(place) = found.place_in_image().filter(|place| part.contains(&place.start)) else {
            continue;
        };
        if can_have(table, image, found) || is_reset(table, image, &place, node_id) {
            continue;
        }
        first = first.or(Some(row));
        reset(table, image, &place, node_id);
        // Half a mapping would give values to entries that they are not for.
        for object in pdo_of(table.id(row).index).into_iter().flatten() {
            let rows = table.search_object(object).unwrap_or_default();
            for place in rows.filter_map(|row| table.found(row).place_in_image()) {
                reset(table, image, &place, node_id);
            }
        }
    }
    first
}

/// Whether the value of now passes the checks of a write.
fn can_have(table: &Table<'_>, image: &[u8], found: Found<'_>) -> bool {
    let Ok(value) = value_of(table, image, found) else { return false };
    check_value(table, found.shared, &value).is_ok()
        && (found.row >= table.parts().first_application_row
            || communication::check(table, image, found.row, &value, Before::Nothing).is_ok())
}

/// The two objects of a PDO, by one of them.
fn pdo_of(index: u16) -> Option<[u16; 2]> {
    const END: u16 = TRANSMIT + 2 * MAPPING;
    if !(RECEIVE..END).contains(&index) {
        return None;
    }
    let is_mapping = (index - RECEIVE) / MAPPING % 2 == 1;
    let communication = if is_mapping { index - MAPPING } else { index };
    Some([communication, communication + MAPPING])
}
