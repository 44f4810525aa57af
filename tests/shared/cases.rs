// Accesses with their expected outcome, and how a dictionary is tried with them. `no_std`: the same code runs in tests on the
// host and on an emulated Cortex-M. The cases are bytes, made by `od_tests::access_cases` from the JSON dump:
//
//     kind u8 | index u16 | sub u8 | length u8 | data | abort code u32 (0: none) | length u8 | expected bytes
//
// numbers least significant byte first. Every case begins with a dictionary as it is after a factory reset of node 5.

/// Read, and compare with the expected bytes.
pub(crate) const READ: u8 = 0;
/// Write while the device is locked, then read and compare.
pub(crate) const WRITE: u8 = 1;
/// Write while the device is unlocked, then read and compare.
pub(crate) const WRITE_UNLOCKED: u8 = 2;
/// As an expected length: nothing to compare.
pub(crate) const ANYTHING: u8 = 0xFF;
/// The node that all cases are about.
pub(crate) const NODE: u8 = 5;

/// An application that is unlocked.
struct Unlocked;

impl<D: firmware_glue::Entries> firmware_glue::Application<D> for Unlocked {
    fn is_unlocked(&self) -> bool {
        true
    }
}

/// The number of a failed case, what was done, and the abort code that came (0: none).
pub(crate) type Failure = (usize, (u8, u16, u8), u32);

/// Tries a dictionary with all cases; returns their number.
pub(crate) fn run<'t, D: firmware_glue::Dictionary<'t>>(
    dictionary: &mut D,
    mut cases: &[u8],
) -> Result<usize, Failure> {
    let mut count = 0;
    while !cases.is_empty() {
        let [kind, low, high, sub] = take(&mut cases);
        let index = u16::from_le_bytes([low, high]);
        let [length] = take(&mut cases);
        let data = split(&mut cases, length);
        let code = u32::from_le_bytes(take(&mut cases));
        let [length] = take(&mut cases);
        let expected = if length == ANYTHING { None } else { Some(split(&mut cases, length)) };
        dictionary.reset(NODE);
        let outcome = match kind {
            READ => Ok(()),
            WRITE => dictionary.write(index, sub, data, &mut ()).map(drop),
            WRITE_UNLOCKED => dictionary.write(index, sub, data, &mut Unlocked).map(drop),
            // A kind that was not made.
            _ => Err(firmware_glue::AbortCode::INTERNAL),
        };
        let outcome = outcome.and_then(|()| {
            let value = dictionary.read(index, sub);
            // What can only be written was written; that is all there is to see.
            if kind != READ && expected.is_none() {
                Ok(true)
            } else {
                value.map(|value| expected.is_none_or(|bytes| *bytes == *value))
            }
        });
        let as_expected = match outcome {
            Ok(equal) => code == 0 && equal,
            // A refused write changes nothing.
            Err(abort) => abort.0 == code && is_reset(dictionary),
        };
        if !as_expected {
            return Err((count, (kind, index, sub), outcome.err().map_or(0, |abort| abort.0)));
        }
        count += 1;
    }
    Ok(count)
}

fn is_reset<'t, D: firmware_glue::Dictionary<'t>>(dictionary: &D) -> bool {
    let node_bytes =
        |at: usize| {
            dictionary.table().parts().node_id_places.iter().any(|place| {
                (place.offset as usize..place.offset as usize + place.size as usize).contains(&at)
            })
        };
    dictionary
        .image()
        .iter()
        .zip(dictionary.table().parts().factory)
        .enumerate()
        .all(|(at, (byte, factory))| byte == factory || node_bytes(at))
}

fn take<const N: usize>(cases: &mut &[u8]) -> [u8; N] {
    let Some((head, rest)) = cases.split_first_chunk::<N>() else {
        *cases = &[];
        return [0; N];
    };
    *cases = rest;
    *head
}

fn split<'a>(cases: &mut &'a [u8], length: u8) -> &'a [u8] {
    let (head, rest) = cases.split_at(cases.len().min(length.into()));
    *cases = rest;
    head
}
