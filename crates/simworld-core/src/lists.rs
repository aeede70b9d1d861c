//! Many lists of values, one behind the other in memory.

use std::ops::{Index, IndexMut, RangeInclusive};

/// Lists of values by number, one behind the other: what is in the cells of a grid, or leaves the nodes of a graph. However many
/// they are, they take two pieces of memory, and what is read in their order lies in its order.
///
/// ```
/// use simworld_core::lists::Lists;
/// let streets = [(0, 'a'), (2, 'b'), (0, 'c')];
/// let lists = Lists::of(3, streets.into_iter());
/// assert_eq!(&lists[0], ['a', 'c']);
/// assert!(lists[1].is_empty());
/// assert_eq!(lists.run(0..=2), ['a', 'c', 'b']);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lists<T> {
    /// Where each begins, and where the last one ends.
    starts: Vec<u32>,
    values: Vec<T>,
}

impl<T> Default for Lists<T> {
    /// No lists.
    fn default() -> Self {
        Self { starts: vec![0], values: Vec::new() }
    }
}

impl<T: Copy> Lists<T> {
    /// Sorts values into so many lists, by counting; those of one list keep their order. What is filed, a list and a value each,
    /// is gone through twice.
    ///
    /// # Panics
    /// If a value is filed in a list of which there is none, or if there are more values than a `u32` counts.
    pub fn of(count: usize, filed: impl Iterator<Item = (usize, T)> + Clone) -> Self {
        let mut starts = vec![0_u32; count + 1];
        let mut fill = None;
        for (list, value) in filed.clone() {
            starts[list + 1] += 1;
            fill = fill.or(Some(value));
        }
        for list in 0..count {
            let before = starts[list];
            let end = starts[list + 1].checked_add(before);
            starts[list + 1] = end.expect("there are no more values than a u32 counts");
        }
        let Some(fill) = fill else { return Self { starts, values: Vec::new() } };
        let (mut next, mut values) = (starts.clone(), vec![fill; starts[count] as usize]);
        for (list, value) in filed {
            values[next[list] as usize] = value;
            next[list] += 1;
        }
        Self { starts, values }
    }
}

impl<T> Lists<T> {
    /// How many lists there are.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The values of consecutive lists.
    ///
    /// # Panics
    /// If there are not so many.
    pub fn run(&self, lists: RangeInclusive<usize>) -> &[T] {
        &self.values[self.starts[*lists.start()] as usize..self.starts[lists.end() + 1] as usize]
    }

    /// Where each list begins among the values of all, and where the last one ends, and nothing else.
    pub fn into_starts(self) -> Vec<u32> {
        self.starts
    }

    /// The values of all lists, in order.
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// The values of all lists, in order, and nothing else.
    pub fn into_values(self) -> Vec<T> {
        self.values
    }
}

/// Lists that are there, in their order.
impl<T> FromIterator<Vec<T>> for Lists<T> {
    fn from_iter<I: IntoIterator<Item = Vec<T>>>(lists: I) -> Self {
        let (mut starts, mut values) = (vec![0], Vec::new());
        for list in lists {
            values.extend(list);
            starts.push(values.len() as u32);
        }
        starts.shrink_to_fit();
        values.shrink_to_fit();
        Self { starts, values }
    }
}

impl<T> Index<usize> for Lists<T> {
    type Output = [T];

    #[inline]
    fn index(&self, list: usize) -> &[T] {
        &self.values[self.starts[list] as usize..self.starts[list + 1] as usize]
    }
}

impl<T> IndexMut<usize> for Lists<T> {
    #[inline]
    fn index_mut(&mut self, list: usize) -> &mut [T] {
        &mut self.values[self.starts[list] as usize..self.starts[list + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::Seed;

    #[test]
    fn every_value_is_in_its_list_in_the_order_in_which_it_was_filed() {
        let mut rng = Seed(4).stream("lists").rng();
        let filed: Vec<(usize, u32)> = (0..500).map(|value| (rng.below(60), value)).collect();
        let lists = Lists::of(64, filed.iter().copied());
        assert_eq!(lists.len(), 64);
        for list in 0..64 {
            let own: Vec<u32> = filed.iter().filter(|filed| filed.0 == list).map(|filed| filed.1).collect();
            assert_eq!(lists[list], own);
        }
        assert_eq!(lists.run(3..=7), (3..=7).flat_map(|list| lists[list].to_vec()).collect::<Vec<_>>());
        assert_eq!(lists.run(0..=63), lists.values());
    }

    #[test]
    fn lists_come_back_as_they_were() {
        let lists = [vec![1, 2], vec![], vec![3]];
        let taken: Lists<u32> = lists.iter().cloned().collect();
        assert_eq!(taken.len(), 3);
        assert!(lists.iter().enumerate().all(|(index, list)| taken[index] == list[..]));
    }

    #[test]
    fn there_may_be_no_lists_and_no_values() {
        assert!(Lists::<u8>::default().is_empty());
        let empty = Lists::<u8>::of(2, std::iter::empty());
        assert_eq!((empty.len(), empty[1].len()), (2, 0));
    }
}
