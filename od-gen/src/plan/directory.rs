//! Which indices have objects, arranged so that the device finds each with one look.
//!
//! `firmware_glue::table::Directory` states how it is searched. Both have to agree on every number here: a change of
//! one of them makes a new layout.

use od_spec::order::Arrange as _;

/// Indices of a block.
const SIZE: u16 = 32;

/// Blocks of a bucket, on average. With more, they need free places; with fewer, the seeds take more room.
const BUCKET: usize = 2;

/// 2^32 divided by the golden ratio.
const SPREAD: u32 = 0x9E37_79B1;

/// Places that are always enough: with the seed 0 alone, all 2048 blocks have places of their own.
const PLACES: usize = 4096;

/// The indices of a dictionary.
#[derive(Debug, Default)]
pub struct Directory {
    /// Blocks where they are looked for; `None` is a free place.
    pub blocks: Vec<Option<Block>>,
    /// For each bucket of blocks, what gives them places that no other block has.
    pub seeds: Vec<u8>,
    /// Positions in `blocks`, by ascending index.
    pub order: Vec<usize>,
}

/// The indices from 32 × `number` on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Block {
    /// Its number.
    pub number: u16,
    /// Objects below the first.
    pub objects: usize,
    /// A bit for each index, the lowest for the first: whether there is an object.
    pub present: u32,
}

fn hash(number: u16) -> u32 {
    u32::from(number).wrapping_mul(SPREAD)
}

/// Another hash, which depends on a seed.
fn seeded(hash: u32, seed: u8) -> u32 {
    (hash ^ u32::from(seed) << 24).wrapping_mul(SPREAD)
}

/// The upper half of a hash, scaled to positions in a list.
fn scaled(hash: u32, length: usize) -> usize {
    (usize::try_from(hash >> 16).unwrap_or_default() * length) >> 16
}

impl Directory {
    /// That of objects, by ascending index.
    pub fn of(indices: &[u16]) -> Self {
        let mut blocks: Vec<Block> = Vec::new();
        for (objects, index) in indices.iter().enumerate() {
            let (number, bit) = (index / SIZE, 1 << (index % SIZE));
            match blocks.last_mut() {
                Some(block) if block.number == number => block.present |= bit,
                Some(_) | None => blocks.push(Block { number, objects, present: bit }),
            }
        }
        // Nearly always the first attempts do it: as few places as there are blocks, and a few more for thousands of them.
        let mut places = blocks.len();
        loop {
            if let Some(seeds) = seeds(&blocks, places) {
                return Self::arranged(&blocks, seeds, places);
            }
            places = (places + 1 + places / 64).min(PLACES);
        }
    }

    fn arranged(blocks: &[Block], seeds: Vec<u8>, places: usize) -> Self {
        let mut list = vec![None; places];
        let place = |block: &Block| {
            let hash = hash(block.number);
            let seed = seeds.get(scaled(hash, seeds.len())).copied().unwrap_or_default();
            scaled(seeded(hash, seed), places)
        };
        let order: Vec<usize> = blocks.iter().map(place).collect();
        for (block, place) in blocks.iter().zip(&order) {
            if let Some(free) = list.get_mut(*place) {
                *free = Some(*block);
            }
        }
        Self { blocks: list, seeds, order }
    }
}

/// A seed for each bucket that sends its blocks to places that no other has. The largest buckets choose first, while there
/// is room.
fn seeds(blocks: &[Block], places: usize) -> Option<Vec<u8>> {
    let count = blocks.len().div_ceil(BUCKET);
    let mut buckets: Vec<(usize, Vec<u32>)> = (0..count).map(|bucket| (bucket, Vec::new())).collect();
    for hash in blocks.iter().map(|block| hash(block.number)) {
        if let Some((_, bucket)) = buckets.get_mut(scaled(hash, count)) {
            bucket.push(hash);
        }
    }
    buckets.arrange_by_key(|(_, hashes)| std::cmp::Reverse(hashes.len()));
    let (mut taken, mut seeds) = (vec![false; places], vec![0; count]);
    for (bucket, hashes) in buckets {
        let chosen = (0..=u8::MAX).find(|seed| take(&mut taken, &hashes, *seed))?;
        if let Some(seed) = seeds.get_mut(bucket) {
            *seed = chosen;
        }
    }
    Some(seeds)
}

/// Takes the places that a seed leads to, all of them or none.
fn take(taken: &mut [bool], hashes: &[u32], seed: u8) -> bool {
    let length = taken.len();
    let mut places = hashes.iter().map(|hash| scaled(seeded(*hash, seed), length));
    let got = places
        .by_ref()
        .take_while(|place| taken.get_mut(*place).is_some_and(|free| !std::mem::replace(free, true)))
        .count();
    if got < hashes.len() {
        for hash in hashes.iter().take(got) {
            if let Some(place) = taken.get_mut(scaled(seeded(*hash, seed), length)) {
                *place = false;
            }
        }
    }
    got == hashes.len()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn all_blocks_lie_apart_in_as_many_places_as_are_always_enough() {
        let mut taken = vec![false; PLACES];
        let hashes: Vec<u32> = (0..2048).map(hash).collect();
        assert!(take(&mut taken, &hashes, 0));
    }

    #[test]
    fn all_indices_that_there_can_be_are_arranged() {
        let all: Vec<u16> = (0..=u16::MAX).collect();
        let directory = Directory::of(&all);
        assert_eq!(directory.order.len(), 2048);
        assert!(directory.blocks.len() < 2200, "{} places", directory.blocks.len());
        assert_eq!(Directory::of(&[]).blocks, []);
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn every_block_has_a_place_of_its_own_and_few_are_free(
            indices in prop::collection::btree_set(any::<u16>(), 0..600),
        ) {
            let indices: Vec<u16> = indices.into_iter().collect();
            let directory = Directory::of(&indices);
            let blocks: Vec<Block> = directory.order.iter().filter_map(|place| directory.blocks[*place]).collect();
            let found: Vec<u16> = blocks
                .iter()
                .flat_map(|block| (0..SIZE).filter(|bit| block.present >> bit & 1 > 0).map(|bit| block.number * SIZE + bit))
                .collect();
            prop_assert_eq!(&found, &indices);
            for block in blocks {
                prop_assert_eq!(block.objects, indices.partition_point(|index| *index < block.number * SIZE));
            }
            let (places, used) = (directory.blocks.len(), directory.order.len());
            prop_assert!(places <= used + used / 4 + 8, "{} places for {} blocks", places, used);
        }
    }
}
