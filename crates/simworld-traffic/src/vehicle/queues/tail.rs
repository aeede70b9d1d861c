//! The ends of lanes: what drivers behind a junction see of those beyond it.

use crate::vehicle::manager::{NONE, Vehicle};
use crate::vehicle::tracks::Tracks;

/// The last vehicle of a lane, as the drivers behind the junction see it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tail {
    /// Its rear, m; infinite if the lane is empty.
    pub(crate) rear: f64,
    pub(crate) v: f64,
    /// Its length, m.
    pub(crate) length: f32,
    /// The connection it came by, if its rear has not cleared it, and its place in the order of leave there.
    pub(crate) way: u32,
    pub(crate) granted: u32,
    /// How far who has left the lane by a way on which he may have to stand reaches back into it, m.
    pub(crate) over: f32,
    /// Whether those on the lane close up, since its first is in a lock that only all of it together undo.
    pub(crate) closes_up: bool,
}

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
        let Self { over, closes_up, .. } = *self;
        let is_last = leaver.rear < self.rear;
        if is_last {
            *self = Self { closes_up, ..*leaver };
        }
        self.over = over.max(leaver.over);
        is_last
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
        Self { rear: f64::INFINITY, v: 0.0, length: 0.0, way, granted, over: 0.0, closes_up: false }
    }
}
