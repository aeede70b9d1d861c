//! The vehicles of one part: front to back on each track, all in one piece of memory, what a step needs of them apart from
//! the rest.
//!
//! Each track that has vehicles has a slab, room for one, two, three, four, six, eight, twelve and so on of them; one that has
//! none has no slab, and one that has far too much is given a smaller one. Memory therefore grows with the vehicles, not with
//! the roads, and nothing is asked of the heap once the slabs are made. Before there is more of it than before, the slabs that
//! nobody has are squeezed out.

use std::hint::black_box;

use serde::{Deserialize, Serialize};

use super::path::Path;
use crate::vehicle::manager::Vehicle;

/// How many sizes of slabs there are, that of none included; the largest has room for more than any lane.
const SIZES: usize = 40;

/// The room of a slab of each size.
const fn room(size: u8) -> usize {
    match size {
        0 | 1 => size as usize,
        even if even.is_multiple_of(2) => 1 << (even / 2),
        odd => 3 << ((odd - 3) / 2),
    }
}

/// Where the vehicles of a track are.
#[derive(Clone, Copy, Debug, Default)]
struct Span {
    start: u32,
    /// How many they are, with the size of the slab in the lowest byte.
    len_and_size: u32,
}

impl Span {
    fn len(self) -> usize {
        (self.len_and_size >> 8) as usize
    }

    fn size(self) -> u8 {
        self.len_and_size as u8
    }

    #[inline]
    fn range(self) -> std::ops::Range<usize> {
        self.start as usize..self.start as usize + self.len()
    }
}

/// Where one is who goes from track to track of those with vehicles: they are those that had some when one came to the first of their
/// word of bits, so that nothing is looked up again for each of them.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cursor {
    /// Words that one has come to, and what is left of the last of them.
    words: usize,
    bits: u64,
}

/// The vehicles of a part by the numbers of its tracks.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(from = "Vec<Vec<(Vehicle, Path)>>", into = "Vec<Vec<(Vehicle, Path)>>")]
pub(crate) struct Slabs {
    spans: Vec<Span>,
    /// Tracks with vehicles, a bit each.
    occupied: Vec<u64>,
    vehicles: Vec<Vehicle>,
    paths: Vec<Path>,
    /// Slabs that no track has, by size.
    free: [Vec<u32>; SIZES],
    /// Memory to sort tracks in.
    order: Vec<u32>,
}

impl Slabs {
    pub(crate) fn new(tracks: usize) -> Self {
        Self {
            spans: vec![Span::default(); tracks],
            occupied: vec![0; tracks.div_ceil(64)],
            vehicles: Vec::new(),
            paths: Vec::new(),
            free: std::array::from_fn(|_| Vec::new()),
            order: Vec::new(),
        }
    }

    /// How many tracks there are.
    pub(crate) fn tracks(&self) -> usize {
        self.spans.len()
    }

    /// The vehicles of a track, front to back.
    #[inline]
    pub(crate) fn queue(&self, track: usize) -> &[Vehicle] {
        &self.vehicles[self.spans[track].range()]
    }

    #[inline]
    pub(crate) fn queue_mut(&mut self, track: usize) -> &mut [Vehicle] {
        &mut self.vehicles[self.spans[track].range()]
    }

    /// What the vehicles of a track were, in the same order.
    #[inline]
    pub(crate) fn paths(&self, track: usize) -> &[Path] {
        &self.paths[self.spans[track].range()]
    }

    /// Both, to change them.
    pub(crate) fn both_mut(&mut self, track: usize) -> (&mut [Vehicle], &mut [Path]) {
        let range = self.spans[track].range();
        (&mut self.vehicles[range.clone()], &mut self.paths[range])
    }

    /// One who goes from track to track of those with vehicles, ascending, from a number on.
    pub(crate) fn cursor(&self, track: usize) -> Cursor {
        let bits = self.occupied.get(track / 64).map_or(0, |bits| bits & u64::MAX << (track % 64));
        Cursor { words: track / 64 + 1, bits }
    }

    /// The next track with vehicles.
    #[inline]
    pub(crate) fn next(&self, at: &mut Cursor) -> Option<usize> {
        self.next_seeing(at, |_, _| {})
    }

    /// The same for who looks at the vehicles of each: those of some dozens of tracks are read one right after the other before the
    /// first of them is looked at, so that processors wait for many such places of the memory at once.
    #[inline]
    pub(crate) fn next_at_hand(&self, at: &mut Cursor) -> Option<usize> {
        self.next_seeing(at, |word, bits| self.touch(word, bits))
    }

    #[inline]
    fn next_seeing(&self, at: &mut Cursor, see: impl Fn(usize, u64)) -> Option<usize> {
        while at.bits == 0 {
            at.bits = *self.occupied.get(at.words)?;
            see(at.words, at.bits);
            at.words += 1;
        }
        let track = at.words * 64 - 64 + at.bits.trailing_zeros() as usize;
        at.bits &= at.bits - 1;
        Some(track)
    }

    /// Which of 64 tracks have vehicles, a bit each.
    #[inline]
    pub(crate) fn word(&self, word: usize) -> u64 {
        self.occupied[word]
    }

    /// Reads the first and the last vehicle of some of the tracks of a word of bits that have any.
    pub(crate) fn touch(&self, word: usize, some: u64) {
        let (mut bits, mut all) = (self.occupied.get(word).map_or(0, |bits| bits & some), 0);
        while bits != 0 {
            let queue = self.queue(word * 64 + bits.trailing_zeros() as usize);
            all ^= queue.first().map_or(0, |first| first.id) ^ queue.last().map_or(0, |last| last.id);
            bits &= bits - 1;
        }
        black_box(all);
    }

    /// The tracks with vehicles, ascending.
    #[inline]
    pub(crate) fn occupied(&self) -> impl Iterator<Item = usize> {
        let mut at = Cursor::default();
        std::iter::from_fn(move || self.next(&mut at))
    }

    /// Puts a vehicle at the back of a track.
    pub(crate) fn push(&mut self, track: usize, vehicle: Vehicle, path: Path) {
        self.insert(track, self.spans[track].len(), vehicle, path);
    }

    /// Puts a vehicle behind the first `rank` of a track.
    pub(crate) fn insert(&mut self, track: usize, rank: usize, vehicle: Vehicle, path: Path) {
        let span = self.spans[track];
        if span.len() == room(span.size()) {
            self.give_slab(track, span.size() + 1);
        }
        let span = &mut self.spans[track];
        let (at, end) = (span.start as usize + rank, span.range().end);
        span.len_and_size += 1 << 8;
        self.vehicles.copy_within(at..end, at + 1);
        self.paths.copy_within(at..end, at + 1);
        self.vehicles[at] = vehicle;
        self.paths[at] = path;
        self.occupied[track / 64] |= 1 << (track % 64);
    }

    /// Takes a vehicle out; the ranks behind it move up. `None` if there is none of that rank.
    pub(crate) fn remove(&mut self, track: usize, rank: usize) -> Option<(Vehicle, Path)> {
        let span = &mut self.spans[track];
        if rank >= span.len() {
            return None;
        }
        let (at, end) = (span.start as usize + rank, span.range().end);
        let taken = (self.vehicles[at], self.paths[at]);
        self.vehicles.copy_within(at + 1..end, at);
        self.paths.copy_within(at + 1..end, at);
        span.len_and_size -= 1 << 8;
        let (len, size) = (span.len(), span.size());
        if len == 0 {
            self.give_slab(track, 0);
            self.occupied[track / 64] &= !(1 << (track % 64));
        } else if size > 2 && len <= room(size - 2) && !self.free[usize::from(size) - 1].is_empty() {
            self.give_slab(track, size - 1);
        }
        Some(taken)
    }

    /// Moves the vehicles of a track to a slab of another size, which has room for them, or of the next that is free.
    fn give_slab(&mut self, track: usize, wanted: u8) {
        let sizes = wanted..SIZES.min(usize::from(wanted) + 4) as u8;
        let free =
            sizes.filter(|_| wanted > 0).find_map(|size| Some((size, self.free[usize::from(size)].pop()?)));
        let (size, start) = free.unwrap_or_else(|| (wanted, self.new_slab(wanted)));
        // Not before: a new slab may move all others.
        let old = self.spans[track];
        self.vehicles.copy_within(old.range(), start as usize);
        self.paths.copy_within(old.range(), start as usize);
        if old.size() > 0 {
            self.free[usize::from(old.size())].push(old.start);
        }
        self.spans[track] = Span { start, len_and_size: (old.len() as u32) << 8 | u32::from(size) };
    }

    /// A slab at the end of the memory; one of no size is nowhere.
    fn new_slab(&mut self, size: u8) -> u32 {
        if size == 0 {
            return 0;
        }
        if self.vehicles.len() + room(size) > self.vehicles.capacity() {
            self.make_room(room(size));
        }
        let start = self.vehicles.len();
        self.vehicles.resize(start + room(size), Vehicle::default());
        self.paths.resize(start + room(size), Path::default());
        start as u32
    }

    /// Makes room for so many more at the end: by squeezing out the slabs that no track has, if they are many, or with more memory.
    fn make_room(&mut self, wanted: usize) {
        let idle: usize = self.free.iter().zip(0..).map(|(free, size)| free.len() * room(size)).sum();
        if idle > self.vehicles.len() / 8 {
            self.squeeze();
        }
        let len = self.vehicles.len();
        if len + wanted > self.vehicles.capacity() {
            // By a thirty-second, not by half: what is spare is spare for every vehicle of the city.
            let more = (len / 32).max(wanted).max(16);
            self.vehicles.reserve_exact(more);
            self.paths.reserve_exact(more);
        }
    }

    /// Moves the slabs of the tracks together, in the order in which they lie.
    fn squeeze(&mut self) {
        let mut order = std::mem::take(&mut self.order);
        order.extend(self.occupied().map(|track| track as u32));
        order.sort_unstable_by_key(|track| self.spans[*track as usize].start);
        let mut end = 0;
        for track in order.drain(..) {
            let span = &mut self.spans[track as usize];
            let (range, room) = (span.range(), room(span.size()));
            span.start = end as u32;
            // None is moved up, so that nothing is written over before it has moved itself.
            self.vehicles.copy_within(range.clone(), end);
            self.paths.copy_within(range, end);
            end += room;
        }
        self.vehicles.truncate(end);
        self.paths.truncate(end);
        self.free.iter_mut().for_each(Vec::clear);
        self.order = order;
    }

    /// Bytes that it takes.
    pub(crate) fn bytes(&self) -> usize {
        self.spans.capacity() * size_of::<Span>()
            + self.occupied.capacity() * 8
            + self.vehicles.capacity() * size_of::<Vehicle>()
            + self.paths.capacity() * size_of::<Path>()
            + self.order.capacity() * 4
            + self.free.iter().map(|free| free.capacity() * 4).sum::<usize>()
    }
}

impl Default for Slabs {
    fn default() -> Self {
        Self::new(0)
    }
}

impl From<Vec<Vec<(Vehicle, Path)>>> for Slabs {
    fn from(tracks: Vec<Vec<(Vehicle, Path)>>) -> Self {
        let mut slabs = Self::new(tracks.len());
        for (track, queue) in tracks.into_iter().enumerate() {
            for (vehicle, path) in queue {
                slabs.push(track, vehicle, path);
            }
        }
        slabs
    }
}

impl From<Slabs> for Vec<Vec<(Vehicle, Path)>> {
    fn from(slabs: Slabs) -> Self {
        let pairs = |track| slabs.queue(track).iter().copied().zip(slabs.paths(track).iter().copied());
        (0..slabs.tracks()).map(|track| pairs(track).collect()).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::collections::VecDeque;

    use proptest::prelude::*;

    use super::*;

    fn vehicle(id: u32) -> (Vehicle, Path) {
        (Vehicle { id, ..Vehicle::default() }, Path::new(id, 0, 0.0, 0.0))
    }

    #[test]
    fn sizes_grow_by_a_half_and_a_third() {
        assert!((0..11).map(room).eq([0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32]));
    }

    #[test]
    fn little_is_spare() {
        let mut slabs = Slabs::new(500);
        let mut longest = 0;
        for round in 0..20 {
            for track in 0..500 {
                let (vehicle, path) = vehicle(round);
                slabs.push(track, vehicle, path);
                longest = longest.max(slabs.vehicles.len());
                let has = slabs.vehicles.capacity();
                assert!(has - longest <= longest / 32 + 32, "room for {has}, of which {longest} were used");
                assert_eq!(slabs.paths.capacity(), has);
            }
            let (has, held): (_, usize) =
                (slabs.vehicles.capacity(), slabs.spans.iter().map(|span| room(span.size())).sum());
            assert!(has <= held * 5 / 4 + 32, "room for {has}, of which tracks have {held}");
        }
    }

    proptest! {
        /// Slabs hold what simple queues would hold, whatever is put in and taken out.
        #[test]
        fn slabs_are_queues(edits in proptest::collection::vec((0..70_usize, 0..9_usize, any::<bool>()), 0..400)) {
            let mut slabs = Slabs::new(70);
            let mut queues: Vec<VecDeque<u32>> = vec![VecDeque::new(); 70];
            for (index, (track, rank, puts)) in edits.into_iter().enumerate() {
                if puts {
                    let rank = rank.min(queues[track].len());
                    queues[track].insert(rank, index as u32);
                    let (vehicle, path) = vehicle(index as u32);
                    slabs.insert(track, rank, vehicle, path);
                } else {
                    prop_assert_eq!(slabs.remove(track, rank).map(|taken| taken.0.id), queues[track].remove(rank));
                }
            }
            for (track, queue) in queues.iter().enumerate() {
                let ids: Vec<u32> = slabs.queue(track).iter().map(|vehicle| vehicle.id).collect();
                let paths: Vec<u32> = slabs.paths(track).iter().map(|path| path.before).collect();
                prop_assert_eq!(&VecDeque::from(ids), queue);
                prop_assert_eq!(&VecDeque::from(paths), queue);
            }
            let occupied: Vec<usize> = (0..70).filter(|track| !queues[*track].is_empty()).collect();
            prop_assert_eq!(slabs.occupied().collect::<Vec<_>>(), occupied);
        }
    }
}
