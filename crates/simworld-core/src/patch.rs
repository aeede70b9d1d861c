//! Patches of arrays: a change of a large thing that is as small as what it changes.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Some entries of an array, and its length: the array gets that length and those entries, and keeps the others.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ArrayPatch<T> {
    /// Length of the array with the patch.
    pub len: u32,
    /// Entries by index, ascending; all of those beyond the length of the array before are among them.
    pub set: Vec<(u32, T)>,
}

/// A patch that does not fit its array.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("the patch of {what} does not fit an array of {present} entries: make it from what it is for")]
pub struct Misfit {
    /// What the array holds.
    pub what: &'static str,
    /// Its length.
    pub present: usize,
}

impl<T> ArrayPatch<T> {
    /// The patch that changes nothing of an array.
    pub fn unchanged(array: &[T]) -> Self {
        Self { len: array.len() as u32, set: Vec::new() }
    }

    /// Whether it changes nothing of an array.
    pub fn is_unchanged(&self, array: &[T]) -> bool {
        self.len as usize == array.len() && self.set.is_empty()
    }

    /// Whether it can be put on an array.
    ///
    /// # Errors
    /// It cannot; `what` says what the array holds.
    pub fn check(&self, array: &[T], what: &'static str) -> Result<(), Misfit> {
        let (len, present) = (self.len as usize, array.len());
        let ascending = self.set.is_sorted_by(|a, b| a.0 < b.0);
        let within = self.set.last().is_none_or(|(index, _)| (*index as usize) < len);
        let beyond = self.set.iter().filter(|(index, _)| *index as usize >= present).count();
        let fits = ascending && within && beyond == len.saturating_sub(present);
        if fits { Ok(()) } else { Err(Misfit { what, present }) }
    }

    /// Puts the patch on an array; gives the patch that takes it off again.
    ///
    /// ```
    /// use simworld_core::patch::ArrayPatch;
    /// let mut array = vec!['a', 'b', 'c'];
    /// let back = ArrayPatch { len: 2, set: vec![(0, 'z')] }.put_on(&mut array, "letters")?;
    /// assert_eq!(array, ['z', 'b']);
    /// back.put_on(&mut array, "letters")?;
    /// assert_eq!(array, ['a', 'b', 'c']);
    /// # Ok::<(), simworld_core::patch::Misfit>(())
    /// ```
    ///
    /// # Errors
    /// It does not fit; then the array is as it was.
    pub fn put_on(self, array: &mut Vec<T>, what: &'static str) -> Result<Self, Misfit> {
        self.check(array, what)?;
        let (len, present) = (self.len as usize, array.len());
        let mut back = Vec::with_capacity(self.set.len() + present.saturating_sub(len));
        let mut cut = array.split_off(len.min(present));
        for (index, value) in self.set {
            match array.get_mut(index as usize) {
                Some(entry) => back.push((index, std::mem::replace(entry, value))),
                None => array.push(value),
            }
        }
        back.extend((len as u32..).zip(cut.drain(..)));
        Ok(Self { len: present as u32, set: back })
    }
}

impl<T> ArrayPatch<T> {
    /// The patch that takes back two changes at once: this one takes back the first of them, `last` the second.
    ///
    /// ```
    /// use simworld_core::patch::ArrayPatch;
    /// let mut array = vec!['a', 'b', 'c'];
    /// let first = ArrayPatch { len: 2, set: vec![(0, 'y')] }.put_on(&mut array, "letters")?;
    /// let last = ArrayPatch { len: 3, set: vec![(1, 'z'), (2, 'x')] }.put_on(&mut array, "letters")?;
    /// assert_eq!(array, ['y', 'z', 'x']);
    /// first.after(last).put_on(&mut array, "letters")?;
    /// assert_eq!(array, ['a', 'b', 'c']);
    /// # Ok::<(), simworld_core::patch::Misfit>(())
    /// ```
    #[must_use]
    pub fn after(self, last: Self) -> Self {
        let mut set: BTreeMap<u32, T> = last.set.into_iter().filter(|(index, _)| *index < self.len).collect();
        set.extend(self.set);
        Self { len: self.len, set: set.into_iter().collect() }
    }
}

impl<T: Clone> ArrayPatch<T> {
    /// An entry of an array that changes once more after the change that this patch takes back: then the patch takes back
    /// both. `None` if there is no such entry.
    ///
    /// ```
    /// use simworld_core::patch::ArrayPatch;
    /// let mut array = vec!['a', 'b', 'c'];
    /// let mut back = ArrayPatch { len: 3, set: vec![(0, 'z')] }.put_on(&mut array, "letters")?;
    /// *back.amend(&mut array, 2).expect("there are three") = 'y';
    /// assert_eq!(array, ['z', 'b', 'y']);
    /// back.put_on(&mut array, "letters")?;
    /// assert_eq!(array, ['a', 'b', 'c']);
    /// # Ok::<(), simworld_core::patch::Misfit>(())
    /// ```
    pub fn amend<'a>(&mut self, array: &'a mut [T], index: usize) -> Option<&'a mut T> {
        let entry = array.get_mut(index)?;
        let number = index as u32;
        if let Err(rank) = self.set.binary_search_by_key(&number, |(known, _)| *known)
            && number < self.len
        {
            self.set.insert(rank, (number, entry.clone()));
        }
        Some(entry)
    }

    /// The patch that would bring an array to how it is now, after this one was put on it: what does again what this
    /// one takes back.
    #[must_use]
    pub fn mirrored(&self, array: &[T]) -> Self {
        let overwritten =
            self.set.iter().map(|(index, _)| *index).filter(|index| (*index as usize) < array.len());
        let added = self.len..array.len() as u32;
        let set = overwritten.filter(|index| *index < self.len).chain(added);
        Self {
            len: array.len() as u32,
            set: set.map(|index| (index, array[index as usize].clone())).collect(),
        }
    }
}

/// An array under change: what was there before is written down, so that the change can be taken back.
///
/// ```
/// use simworld_core::patch::Book;
/// let mut array = vec!['a', 'b', 'c'];
/// let mut book = Book::open(&mut array);
/// book.vacate(0);
/// // The last entry takes the place that is left.
/// assert_eq!(book.close_gap(), Some((2, 0)));
/// let back = book.close();
/// assert_eq!(array, ['c', 'b']);
/// back.put_on(&mut array, "letters")?;
/// assert_eq!(array, ['a', 'b', 'c']);
/// # Ok::<(), simworld_core::patch::Misfit>(())
/// ```
#[derive(Debug)]
pub struct Book<'a, T> {
    array: &'a mut Vec<T>,
    /// Length before the change.
    len: usize,
    /// Entries before the change, of those that are other ones now or gone.
    old: BTreeMap<u32, T>,
    /// Places that are free, to be filled again before the change ends.
    vacant: BTreeSet<u32>,
}

impl<'a, T: Clone> Book<'a, T> {
    /// Opens an array.
    pub fn open(array: &'a mut Vec<T>) -> Self {
        Self { len: array.len(), array, old: BTreeMap::new(), vacant: BTreeSet::new() }
    }

    /// The number of entries, free places among them.
    pub fn len(&self) -> usize {
        self.array.len()
    }

    /// Whether it has no entries.
    pub fn is_empty(&self) -> bool {
        self.array.is_empty()
    }

    /// An entry; there must be one.
    pub fn get(&self, index: usize) -> &T {
        &self.array[index]
    }

    fn keep(&mut self, index: usize) {
        if index < self.len {
            let array = &*self.array;
            self.old.entry(index as u32).or_insert_with(|| array[index].clone());
        }
    }

    /// An entry, to be changed; there must be one.
    pub fn edit(&mut self, index: usize) -> &mut T {
        self.keep(index);
        &mut self.array[index]
    }

    /// Adds an entry; gives its index.
    pub fn push(&mut self, value: T) -> usize {
        self.array.push(value);
        self.array.len() - 1
    }

    /// Takes an entry out; the last one takes its place.
    pub fn swap_remove(&mut self, index: usize) {
        self.keep(index);
        self.keep(self.array.len() - 1);
        self.array.swap_remove(index);
    }

    /// Leaves the place of an entry to the next one that comes.
    pub fn vacate(&mut self, index: usize) {
        self.vacant.insert(index as u32);
    }

    /// Puts an entry into the first free place, or at the end.
    pub fn fill(&mut self, value: T) -> usize {
        match self.vacant.pop_first() {
            Some(index) => {
                *self.edit(index as usize) = value;
                index as usize
            }
            None => self.push(value),
        }
    }

    /// The next move that leaves fewer free places: the last entry into the first of them. `None` when none is left.
    pub fn close_gap(&mut self) -> Option<(usize, usize)> {
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
    pub fn close(self) -> ArrayPatch<T> {
        ArrayPatch { len: self.len as u32, set: self.old.into_iter().collect() }
    }
}
