//! Which objects there are, and where each is in a table.
//!
//! Indices are looked at in blocks of 32. A block with objects has a bit for each index; the bits below one's own show
//! how many objects are before it. Blocks are found by perfect hashing: a bucket's seed sends every block number of the
//! bucket to a place of its own, so that a search is one look, however many objects there are and however their indices
//! lie apart.

#![expect(clippy::inline_always, reason = "as in the module above")]

/// Indices of a block.
const SIZE: u16 = 32;
const SIZE_BITS: u32 = SIZE.trailing_zeros();

/// Blocks that there can be.
pub(crate) const NUMBERS: u16 = 1 << (u16::BITS - SIZE_BITS);

/// The first block without communication objects.
pub(crate) const APPLICATION: u16 = 0x2000 / SIZE;

/// Places that are always enough: with the seed 0 alone, all blocks have places of their own.
const PLACES: usize = 4096;

/// 2^32 divided by the golden ratio: neighbours are sent far apart.
const SPREAD: u32 = 0x9E37_79B1;

/// The indices of a table. The generator arranges it; [`arrange`](Self::arrange) does at run time.
#[derive(Debug, Clone, Copy)]
pub struct Directory<'t> {
    /// Blocks where they are looked for, and free places.
    pub blocks: &'t [Block],
    /// For each bucket of blocks, what gives them places that no other block has.
    pub seeds: &'t [u8],
    /// Positions in `blocks`, by ascending index.
    pub order: &'t [u16],
}

/// The indices from 32 × `number` on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Block {
    /// Index of the first, divided by 32.
    pub number: u16,
    /// Objects below the first.
    pub objects: u16,
    /// A bit for each index, the lowest for the first: whether there is an object.
    pub present: u32,
}

impl Block {
    /// A free place.
    pub const FREE: Self = Self::new(u16::MAX, 0, 0);

    /// A block with its number, the objects below it and its bits.
    pub const fn new(number: u16, objects: u16, present: u32) -> Self {
        Self { number, objects, present }
    }
}

/// The hash of a block.
#[inline(always)]
fn hash(number: u16) -> u32 {
    u32::from(number).wrapping_mul(SPREAD)
}

/// Another hash, which depends on a seed.
#[inline(always)]
fn seeded(hash: u32, seed: u8) -> u32 {
    (hash ^ u32::from(seed) << 24).wrapping_mul(SPREAD)
}

/// The upper half of a hash, scaled to positions in a list.
#[inline(always)]
fn scaled(hash: u32, length: usize) -> usize {
    let [_, _, low, high] = hash.to_le_bytes();
    usize::from(u16::from_le_bytes([low, high])).wrapping_mul(length) >> u16::BITS
}

impl<'t> Directory<'t> {
    /// That of a table without objects.
    pub const EMPTY: Self = Self { blocks: &[], seeds: &[], order: &[] };

    /// Arranges the objects of a table, by ascending index. `blocks` and `order` need one item for each block of 32 indices that
    /// has an object, `seeds` had better have half as many; what they hold before does not matter.
    ///
    /// `None` when the indices do not ascend or there is too little room. A tenth more `blocks` is enough for most tables, 4096
    /// for each.
    ///
    /// ```
    /// use firmware_glue::table::{Block, Directory};
    ///
    /// let (mut blocks, mut seeds, mut order) = ([Block::FREE; 3], [0; 2], [0; 3]);
    /// let directory = Directory::arrange(&[0x1000, 0x1018, 0x2000], &mut blocks, &mut seeds, &mut order);
    /// assert_eq!(directory.map(|found| found.order.len()), Some(2), "1000h and 1018h are in one block");
    /// ```
    pub fn arrange(
        indices: &[u16],
        blocks: &'t mut [Block],
        seeds: &'t mut [u8],
        order: &'t mut [u16],
    ) -> Option<Self> {
        if !indices.is_sorted_by(|one, next| one < next) || blocks.len() > PLACES {
            return None;
        }
        let count = all_blocks(indices).count();
        let (order, _) = order.split_at_mut_checked(count)?;
        for (block, place) in all_blocks(indices).zip(blocks.get_mut(..count)?) {
            *place = block;
        }
        place(blocks, seeds, order)?;
        blocks.fill(Block::FREE);
        for (block, place) in all_blocks(indices).zip(&*order) {
            *blocks.get_mut(usize::from(*place))? = block;
        }
        Some(Self { blocks, seeds, order })
    }

    /// Where a block is, if it is there.
    #[inline(always)]
    pub(crate) fn place(&self, number: u16) -> Option<usize> {
        let hash = hash(number);
        let seed = *self.seeds.get(scaled(hash, self.seeds.len()))?;
        Some(scaled(seeded(hash, seed), self.blocks.len()))
    }

    /// How many objects are before the one of an index, if there is one.
    #[inline(always)]
    pub(crate) fn position(&self, index: u16) -> Option<usize> {
        let number = index >> SIZE_BITS;
        let block = self.blocks.get(self.place(number)?)?;
        // The bit of the index is the uppermost now, those of the indices above it are gone.
        let present = block.present << (u32::from(!index) % u32::BITS);
        if block.number != number || present.leading_zeros() > 0 {
            return None;
        }
        let before = usize::try_from((present << 1).count_ones()).unwrap_or_default();
        Some(usize::from(block.objects) + before)
    }

    /// The index of the object that has so many before it.
    pub(crate) fn index(&self, position: usize) -> Option<u16> {
        let block = |place: &u16| self.blocks.get(usize::from(*place));
        let starts = |place: &u16| block(place).is_some_and(|block| usize::from(block.objects) <= position);
        let after = self.order.partition_point(starts);
        let block = after.checked_sub(1).and_then(|at| self.order.get(at)).and_then(block)?;
        let mut present = block.present;
        for _ in usize::from(block.objects)..position {
            present &= present.checked_sub(1)?;
        }
        let bit = u16::try_from(present.trailing_zeros()).ok().filter(|bit| *bit < SIZE)?;
        block.number.checked_mul(SIZE)?.checked_add(bit)
    }
}

/// The blocks of ascending indices.
fn all_blocks(indices: &[u16]) -> impl Iterator<Item = Block> {
    let mut objects = 0u16;
    indices.chunk_by(|one, next| one >> SIZE_BITS == next >> SIZE_BITS).map(move |block| {
        let present = block.iter().fold(0, |present, index| present | 1 << (u32::from(*index) % u32::BITS));
        let first = block.first().map_or(0, |first| first >> SIZE_BITS);
        let before = objects;
        objects = objects.saturating_add(u16::try_from(block.len()).unwrap_or(u16::MAX));
        Block { number: first, objects: before, present }
    })
}

/// Finds a place for each of the blocks that are in front of the places, and the seeds that lead there. The largest
/// buckets choose first, while there is room.
fn place(places: &[Block], seeds: &mut [u8], order: &mut [u16]) -> Option<()> {
    let (blocks, buckets) = (places.get(..order.len())?, seeds.len());
    let members = |bucket: usize| {
        blocks.iter().map(|block| hash(block.number)).filter(move |hash| scaled(*hash, buckets) == bucket)
    };
    let largest = (0..buckets).map(|bucket| members(bucket).count()).max().unwrap_or_default();
    let mut taken = [false; PLACES];
    seeds.fill(0);
    for size in (1..=largest).rev() {
        for (bucket, seed) in seeds.iter_mut().enumerate() {
            if members(bucket).count() == size {
                let mut fits = |seed: &u8| {
                    let place = |hash| scaled(seeded(hash, *seed), places.len());
                    take(&mut taken, size, || members(bucket).map(place))
                };
                *seed = (0..=u8::MAX).find(&mut fits)?;
            }
        }
    }
    let found = Directory { blocks: places, seeds, order: &[] };
    for (block, place) in blocks.iter().zip(order) {
        *place = u16::try_from(found.place(block.number)?).ok()?;
    }
    Some(())
}

/// Takes so many places, all of them or none.
fn take<I: Iterator<Item = usize>>(taken: &mut [bool], count: usize, places: impl Fn() -> I) -> bool {
    let mut got = 0;
    for place in places() {
        match taken.get_mut(place) {
            Some(place) if !*place => *place = true,
            Some(_) | None => break,
        }
        got += 1;
    }
    if got < count {
        for place in places().take(got) {
            if let Some(place) = taken.get_mut(place) {
                *place = false;
            }
        }
    }
    got == count
}

#[cfg(test)]
mod tests {
    #[test]
    fn all_blocks_lie_apart_in_as_many_places_as_are_said_to_be_enough() {
        let mut taken = [false; super::PLACES];
        for number in 0..super::NUMBERS {
            let place = super::scaled(super::seeded(super::hash(number), 0), super::PLACES);
            assert!(!core::mem::replace(&mut taken[place], true), "{number}");
        }
    }
}
