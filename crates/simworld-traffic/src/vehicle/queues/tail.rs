//! The ends of lanes: what drivers behind a junction see of those beyond it.

use crate::vehicle::manager::{NONE, Vehicle};
use crate::vehicle::tracks::Tracks;

/// The last vehicle of a lane, as the drivers behind the junction see it: a half of a line of the cache, and not over two of them.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(crate) struct Tail {
    /// Its rear, m; infinite if the lane is empty.
    pub(crate) rear: f64,
    pub(crate) v: f64,
    /// Its length, m.
    pub(crate) length: f32,
    /// The connection it came by, if its rear has not cleared it, and its place in the order of leave there.
    pub(crate) way: u32,
    pub(crate) granted: u32,
    /// How far who has left the lane by a way on which he may have to stand reaches back into it, m; with a minus if those on the lane
    /// close up.
    pub(crate) over: f32,
}

const _: () = assert!(size_of::<Tail>() == 32);

impl Tail {
    pub(in crate::vehicle) fn of(last: &Vehicle) -> Self {
        let way = if last.holding == last.next { NONE } else { last.holding };
        let (rear, v) = (last.s - last.length(), last.v);
        Self { rear, v, length: last.length, way, granted: last.granted, ..Self::default() }
    }

    /// Of one on a way, as the end of the lane that it has left but for its rear; `None` if it has left it whole.
    pub(in crate::vehicle) fn of_leaver(tracks: &Tracks, way: usize, last: &Vehicle) -> Option<Self> {
        let rear = last.s - last.length();
        (rear < 0.0).then(|| {
            // By other ways one goes on only where there is room behind them.
            let over = if tracks.is_alone(way) { -rear as f32 } else { 0.0 };
            let end = tracks.length[tracks.ways[way].from as usize];
            Self { rear: end + rear, v: last.v, length: last.length, over, ..Self::default() }
        })
    }

    /// Takes note of one who has left the lane but for its rear; whether that is the end of the lane now.
    pub(in crate::vehicle) fn see_leaver(&mut self, leaver: &Self) -> bool {
        let (over, closes_up) = (self.over.abs().max(leaver.over.abs()), self.closes_up());
        let is_last = leaver.rear < self.rear;
        if is_last {
            *self = *leaver;
        }
        self.over = over;
        *self = self.closing_up(closes_up);
        is_last
    }

    /// How far who has left the lane by a way on which he may have to stand reaches back into it, m.
    #[inline]
    pub(in crate::vehicle) fn over(&self) -> f64 {
        f64::from(self.over.abs())
    }

    /// Whether those on the lane close up, since its first is in a lock that only all of it together undo.
    #[inline]
    pub(in crate::vehicle) fn closes_up(&self) -> bool {
        self.over.is_sign_negative()
    }

    /// The same of a lane on which they do or do not.
    pub(in crate::vehicle) fn closing_up(self, closes_up: bool) -> Self {
        Self { over: if closes_up { -self.over.abs() } else { self.over.abs() }, ..self }
    }

    /// Whether the lane is empty.
    #[inline]
    pub(in crate::vehicle) fn is_none(&self) -> bool {
        self.rear == f64::INFINITY
    }
}

impl Default for Tail {
    fn default() -> Self {
        let (way, granted) = (NONE, 0);
        Self { rear: f64::INFINITY, v: 0.0, length: 0.0, way, granted, over: 0.0 }
    }
}
