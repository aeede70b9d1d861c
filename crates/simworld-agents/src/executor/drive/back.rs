//! Backwards a little, straight, for room to go another way.

use simworld_core::action::Action;
use simworld_core::geometry::heading;
use simworld_core::scene::Scene;

use super::around::{Seen, would_touch};
use super::junction::OVER;
use super::watch::Own;
use super::{ASTRAY, Driving};
use crate::lanes::nearest_lane;

/// The path begins where one is if it begins no farther away, and so much of the lane is left behind a rear, m.
const AT_BEGIN: f64 = 0.5;

impl Driving {
    /// The path from where one has backed to; before its begin a piece leads to it, and lines that one is behind again are minded again.
    fn begin_here(&mut self, own: &Own<'_>) {
        self.station = (self.station - 6.0).max(0.0);
        self.locate(own.at);
        self.best = self.station;
        let away = self.path.first().map_or(0.0, |begin| (begin - own.at).norm());
        if self.station <= 0.0 && away > AT_BEGIN {
            self.path.insert(0, own.at);
            self.shift(0.0, away);
        }
        let front = self.station + own.half_length;
        self.lines.iter_mut().for_each(|line| line.is_passed &= front > line.station + OVER);
    }

    /// What lies on the path from a station on is so much farther along it, m.
    pub(super) fn shift(&mut self, from: f64, by: f64) {
        let later = |station: &mut f64| *station += if *station >= from { by } else { 0.0 };
        self.lines.iter_mut().for_each(|line| later(&mut line.station));
        self.limits.iter_mut().for_each(|(limit, _)| later(limit));
        for change in &mut self.changes {
            later(&mut change.begin);
            later(&mut change.end);
            later(&mut change.latest);
        }
    }

    /// Backs a little for another way at it, if there is room.
    pub(super) fn back_off(&mut self, own: &Own<'_>, around: &[Seen]) {
        const BACK: f64 = 2.5;
        if !would_touch(own, around, (-1.0, 0.0), 0.2) {
            self.backing = BACK;
        }
    }

    /// Goes back a little, straight, if nobody is behind, and not into a junction.
    pub(super) fn back(
        &mut self,
        scene: &dyn Scene,
        own: &Own<'_>,
        around: &[Seen],
        dt: f64,
        out: &mut Vec<Action>,
    ) {
        const BACKWARDS: f64 = 0.3;
        self.backing -= (-own.speed * dt).max(0.01);
        let lane = scene.roads().and_then(|network| nearest_lane(network, own.at, Some(heading(&own.ahead))));
        // Who is in the junction already is before the begin of every lane.
        let near_begin = f64::EPSILON..own.half_length + AT_BEGIN;
        let at_begin = lane.is_some_and(|on| on.distance < ASTRAY && near_begin.contains(&on.station));
        if self.backing <= 0.0 || at_begin || would_touch(own, around, (-0.8, 0.0), 0.2) {
            self.backing = 0.0;
            self.begin_here(own);
            out.push(Action::Brake { level: 1.0 });
        } else {
            let level = if own.speed < -1.5 { 0.0 } else { -BACKWARDS };
            out.extend([Action::Throttle { level }, Action::Steer { angle: 0.0 }]);
        }
    }
}
