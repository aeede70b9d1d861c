//! From the device's memory to the host's, by as many threads as that is worth: one of them alone copies less than the bus brings.

use bytemuck::Pod;

use super::Layout;
use crate::threads;

/// Bytes that are worth a thread; it begins within the time in which another copies some of them.
const SHARE: usize = 768 << 10;

/// Runs of bytes that are to be copied, and where to.
pub(super) struct Copies<'a> {
    pub layout: &'a Layout,
    pub runs: Vec<(&'a mut [u8], &'a [u8])>,
}

impl<'a> Copies<'a> {
    /// Takes the padding out of rows of `each` entries a pixel; without bytes there are no entries.
    pub(super) fn gather<T: Pod>(&mut self, out: &'a mut Vec<T>, bytes: &'a [u8], each: usize) {
        let width = each * size_of::<T>();
        let pixels = self.layout.spans.iter().map(|span| span.width as usize * span.height as usize);
        let length = if bytes.is_empty() { 0 } else { pixels.sum::<usize>() * each };
        out.resize(length, T::zeroed());
        if bytes.is_empty() {
            return;
        }
        let mut rest: &mut [u8] = bytemuck::cast_slice_mut(out);
        if self.layout.is_tight() {
            self.runs.push((rest, &bytes[..self.layout.pixels * width]));
            return;
        }
        for row in self.layout.rows() {
            let (run, behind) = rest.split_at_mut(row.len() * width);
            self.runs.push((run, &bytes[row.start * width..row.end * width]));
            rest = behind;
        }
    }

    /// Makes the copies.
    pub(super) fn make(self) {
        let all: usize = self.runs.iter().map(|(_, from)| from.len()).sum();
        let threads = threads::worth(all, SHARE);
        threads::each(shares(self.runs, all.div_ceil(threads)), |share| {
            for (out, from) in share {
                out.copy_from_slice(from);
            }
        });
    }
}

/// The runs as shares of so many bytes; a run may be cut.
fn shares<'a>(runs: Vec<(&'a mut [u8], &'a [u8])>, most: usize) -> Vec<Vec<(&'a mut [u8], &'a [u8])>> {
    let mut shares = vec![Vec::new()];
    let mut room = most;
    for (mut out, mut from) in runs {
        while !from.is_empty() {
            if room == 0 {
                shares.push(Vec::new());
                room = most;
            }
            let count = from.len().min(room);
            let (run, behind) = out.split_at_mut(count);
            if let Some(last) = shares.last_mut() {
                last.push((run, &from[..count]));
            }
            (out, from, room) = (behind, &from[count..], room - count);
        }
    }
    shares
}

#[cfg(test)]
mod tests {
    use simworld_core::camera::Intrinsics;

    use super::*;

    /// Whatever is copied by how many threads, every byte comes where it belongs.
    #[test]
    fn large_and_ragged_copies_are_whole() {
        for (width, height) in [(640, 480), (641, 479), (1, 1)] {
            let size = Intrinsics { width, height, fx: 1.0, fy: 1.0, cx: 0.0, cy: 0.0 };
            let layout = Layout::of(&[size; 5]);
            let words: Vec<u32> = (0..layout.pixels as u32).collect();
            let expected: Vec<u32> = layout.rows().flatten().map(|pixel| pixel as u32).collect();
            let mut out = vec![7; 3];
            let mut copies = Copies { layout: &layout, runs: Vec::new() };
            copies.gather(&mut out, bytemuck::cast_slice(&words), 1);
            copies.make();
            assert!(out == expected, "{width} x {height}");
        }
    }

    #[test]
    fn shares_are_equal_and_cover_all() {
        let (mut to, from) = ([[0_u8; 10], [0; 10]], [[1_u8; 10], [2; 10]]);
        let runs = to.iter_mut().zip(&from).map(|(to, from)| (&mut to[..], &from[..])).collect();
        let lengths: Vec<Vec<usize>> =
            shares(runs, 7).iter().map(|share| share.iter().map(|(_, from)| from.len()).collect()).collect();
        assert_eq!(lengths, [vec![7], vec![3, 4], vec![6]]);
    }
}
