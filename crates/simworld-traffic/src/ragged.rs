//! Lists of different lengths, one after another in one piece of memory.

use std::ops::Index;

/// Lists by number; the items of all lie together.
#[derive(Clone, Debug)]
pub(crate) struct Ragged<T> {
    /// Where each list begins; the last entry is where the last list ends.
    starts: Vec<u32>,
    items: Vec<T>,
}

impl<T> Default for Ragged<T> {
    /// No lists.
    fn default() -> Self {
        Self { starts: vec![0], items: Vec::new() }
    }
}

impl<T> Ragged<T> {
    /// How many lists there are.
    pub(crate) fn len(&self) -> usize {
        self.starts.len() - 1
    }
}

impl<T> Index<usize> for Ragged<T> {
    type Output = [T];

    #[inline]
    fn index(&self, list: usize) -> &[T] {
        &self.items[self.starts[list] as usize..self.starts[list + 1] as usize]
    }
}

impl<T> FromIterator<Vec<T>> for Ragged<T> {
    fn from_iter<I: IntoIterator<Item = Vec<T>>>(lists: I) -> Self {
        let (mut starts, mut items) = (vec![0], Vec::new());
        for list in lists {
            items.extend(list);
            starts.push(items.len() as u32);
        }
        starts.shrink_to_fit();
        items.shrink_to_fit();
        Self { starts, items }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_come_back_as_they_were() {
        let lists = [vec![1, 2], vec![], vec![3]];
        let ragged: Ragged<u32> = lists.iter().cloned().collect();
        assert!(lists.iter().enumerate().all(|(index, list)| ragged[index] == list[..]));
    }
}
