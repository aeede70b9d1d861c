//! Arrays under change: what was there before is written down, so that the change can be taken back.

use std::collections::{BTreeMap, BTreeSet};

use super::ArrayPatch;

/// An array under change.
#[derive(Debug)]
pub(super) struct Book<'a, T> {
    array: &'a mut Vec<T>,
    /// Length before the change.
    len: usize,
    /// Entries before the change, of those that are other ones now or gone.
    old: BTreeMap<u32, T>,
    /// Places that are free, to be filled again before the change ends.
    vacant: BTreeSet<u32>,
}

impl<'a, T: Clone> Book<'a, T> {
    pub(super) fn open(array: &'a mut Vec<T>) -> Self {
        Self { len: array.len(), array, old: BTreeMap::new(), vacant: BTreeSet::new() }
    }

    pub(super) fn len(&self) -> usize {
        self.array.len()
    }

    pub(super) fn get(&self, index: usize) -> &T {
        &self.array[index]
    }

    fn keep(&mut self, index: usize) {
        if index < self.len {
            let array = &*self.array;
            self.old.entry(index as u32).or_insert_with(|| array[index].clone());
        }
    }

    pub(super) fn edit(&mut self, index: usize) -> &mut T {
        self.keep(index);
        &mut self.array[index]
    }

    pub(super) fn push(&mut self, value: T) -> usize {
        self.array.push(value);
        self.array.len() - 1
    }

    /// Takes an entry out; the last one takes its place.
    pub(super) fn swap_remove(&mut self, index: usize) {
        self.keep(index);
        self.keep(self.array.len() - 1);
        self.array.swap_remove(index);
    }

    /// Leaves the place of an entry to the next one that comes.
    pub(super) fn vacate(&mut self, index: usize) {
        self.vacant.insert(index as u32);
    }

    /// Puts an entry into the first free place, or at the end.
    pub(super) fn fill(&mut self, value: T) -> usize {
        match self.vacant.pop_first() {
            Some(index) => {
                *self.edit(index as usize) = value;
                index as usize
            }
            None => self.push(value),
        }
    }

    /// The next move that leaves fewer free places: the last entry into the first of them. `None` when none is left.
    pub(super) fn close_gap(&mut self) -> Option<(usize, usize)> {
        loop {
            let last = self.array.len().checked_sub(1)?;
            let first = *self.vacant.first()? as usize;
            if self.vacant.remove(&(last as u32)) {
                self.keep(last);
                self.array.pop();
                continue;
            }
            self.vacant.remove(&(first as u32));
            self.swap_remove(first);
            return Some((last, first));
        }
    }

    /// The patch that takes the change back.
    pub(super) fn close(self) -> ArrayPatch<T> {
        ArrayPatch { len: self.len as u32, set: self.old.into_iter().collect() }
    }
}
