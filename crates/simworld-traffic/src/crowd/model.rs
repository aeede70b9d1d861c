//! The anticipation velocity model: a direction that avoids where the others will be, and a speed that the gap ahead allows.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Vector2;
use simworld_core::ops;

use super::{Person, Wall, Wish};

/// Repulsion below this share of the wish is left out.
const FAINT: f64 = 5e-3;
/// Who walks more slowly than this stands, m/s.
const STANDING: f64 = 0.1;
/// Distance over which the wish to step back falls to 1/e, m.
const TOUCH: f64 = 0.05;

/// The anticipation velocity model of Xu, Chraibi and Seyfried (Transportation Research Part C 133, 2021), a collision-free
/// speed model (Tordeux, Chraibi and Seyfried 2016) whose people look a second ahead.
///
/// One walks at `min(free speed, gap ahead / time_gap)`. The direction follows, within `reaction` seconds, the wish turned
/// aside by everybody in view, by `strength · exp(-gap / range)`, where the gap is the one after `anticipation` seconds;
/// those who come towards one count double.
///
/// Two things are ours. Towards those who walk one's own way one anticipates the speed one wants, not the one they leave, so
/// that the slow are overtaken. And who is brought to a stand steps back from those who touch, by `giving_way`, which
/// dissolves arches before a door. `radius` is half the length of 0.3 m of the second paper, `anticipation` and `reaction`
/// are those of the first; `time_gap`, `strength` and `range` are set so that speed over density is that of Weidmann (1993)
/// and a door passes 1.4 to 1.7 people a second and metre.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct AnticipationVelocity {
    /// Radius of a body seen from above, m, in [0.1, 0.3]; bodies never overlap.
    pub radius: f64,
    /// Time in which one would close the gap ahead, s, in [0.3, 3]: greater is more cautious.
    pub time_gap: f64,
    /// How far one looks ahead in time, s, in [0, 3].
    pub anticipation: f64,
    /// Time in which one turns to a new direction, s, in [0.05, 2].
    pub reaction: f64,
    /// Strength of the repulsion between people, of the wish to go on, in [0, 50].
    pub strength: f64,
    /// Distance over which it falls to 1/e, m, in [0.01, 1].
    pub range: f64,
    /// Strength with which who stands steps back from who touches, of the wish to go on, in [0, 50].
    pub giving_way: f64,
    /// Strength of the repulsion from walls, of the wish to go on, in [0, 50].
    pub wall_strength: f64,
    /// Distance over which it falls to 1/e, m, in [0.01, 1].
    pub wall_range: f64,
}

impl Default for AnticipationVelocity {
    fn default() -> Self {
        Self {
            radius: 0.15,
            time_gap: 0.9,
            anticipation: 1.0,
            reaction: 0.3,
            strength: 1.0,
            range: 0.3,
            giving_way: 3.0,
            wall_strength: 3.0,
            wall_range: 0.05,
        }
    }
}

impl AnticipationVelocity {
    /// The fields, their values and the ranges they are in, for errors.
    pub(crate) fn ranges(&self) -> [(&'static str, f64, f64, f64, &'static str); 9] {
        [
            ("walking.radius", self.radius, 0.1, 0.3, "0.1 to 0.3 m"),
            ("walking.time_gap", self.time_gap, 0.3, 3.0, "0.3 to 3 s"),
            ("walking.anticipation", self.anticipation, 0.0, 3.0, "0 to 3 s"),
            ("walking.reaction", self.reaction, 0.05, 2.0, "0.05 to 2 s"),
            ("walking.strength", self.strength, 0.0, 50.0, "0 to 50"),
            ("walking.range", self.range, 0.01, 1.0, "0.01 to 1 m"),
            ("walking.giving_way", self.giving_way, 0.0, 50.0, "0 to 50"),
            ("walking.wall_strength", self.wall_strength, 0.0, 50.0, "0 to 50"),
            ("walking.wall_range", self.wall_range, 0.01, 1.0, "0.01 to 1 m"),
        ]
    }
}

/// The model with what follows from it, for steps of one length.
#[derive(Clone, Copy)]
pub(super) struct Rules {
    model: AnticipationVelocity,
    /// Least distance between the middles of two bodies, m.
    contact: f64,
    /// Repulsion over a wider gap is faint, m.
    wide: f64,
    dt: f64,
}

/// Somebody within reach.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Near {
    /// The unit vector towards them.
    toward: Vector2,
    /// Between the middles, m.
    distance: f64,
}

/// Those within reach who matter.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Nearby {
    in_view: Vec<Near>,
    /// Those who could be run into in one step, wherever they are.
    close: Vec<Near>,
}

impl Nearby {
    pub(super) fn clear(&mut self) {
        self.in_view.clear();
        self.close.clear();
    }
}

impl Rules {
    pub(super) fn new(model: &AnticipationVelocity, dt: f64) -> Self {
        let wide = model.range * ops::ln((2.0 * model.strength / FAINT).max(1.0));
        Self { model: *model, contact: 2.0 * model.radius, wide, dt }
    }

    /// Takes note of somebody at an offset, and returns by how much they change one's wish.
    pub(super) fn notice(
        &self,
        me: &Person,
        wish: &Wish,
        other: &Person,
        offset: Vector2,
        near: &mut Nearby,
    ) -> Vector2 {
        let behind = wish.direction.dot(&offset) < 0.0 && me.direction.dot(&offset) < 0.0;
        let close = self.contact + 2.0 * wish.speed * self.dt;
        let square = offset.norm_squared();
        if behind && square > close * close {
            return Vector2::zeros();
        }
        let distance = square.sqrt();
        // Two in the same place, by error, part along their wishes.
        let toward = if distance > 0.0 { offset / distance } else { -wish.direction };
        if distance <= close {
            near.close.push(Near { toward, distance });
        }
        if behind {
            return Vector2::zeros();
        }
        near.in_view.push(Near { toward, distance });
        let aside = self.aside(me, wish, other, offset, toward);
        if me.speed >= STANDING {
            return aside;
        }
        let touching = -(distance - self.contact).max(0.0) / TOUCH;
        aside - toward * (self.model.giving_way * ops::exp(touching))
    }

    /// How somebody in view turns one aside.
    fn aside(&self, me: &Person, wish: &Wish, other: &Person, offset: Vector2, toward: Vector2) -> Vector2 {
        let along = wish.direction.dot(&other.direction);
        let own = if along > 0.0 { wish.direction * wish.speed } else { me.direction * me.speed };
        let theirs = other.direction * other.speed;
        let closing = (own - theirs).dot(&toward) * self.model.anticipation;
        let gap = (offset.dot(&toward) - self.contact - closing).max(0.0);
        if gap > self.wide {
            return Vector2::zeros();
        }
        let share = if gap > 0.0 { ops::exp(-gap / self.model.range) } else { 1.0 };
        let strength = self.model.strength * (1.0 + 0.5 * (1.0 - along)) * share;
        // Away from where they will be; to the right of those who come straight on.
        let then = offset + theirs * self.model.anticipation;
        let right = wish.direction.perp(&then) >= 0.0;
        left_of(wish.direction) * if right { -strength } else { strength }
    }

    /// The direction to walk in, of length one.
    pub(super) fn direction(&self, me: &Person, wish: &Wish, change: Vector2, walls: &[Wall]) -> Vector2 {
        let mut wanted = wish.direction + change;
        for wall in walls {
            let gap = (wall.distance - self.model.radius).max(0.0);
            wanted -= wall.toward * (self.model.wall_strength * ops::exp(-gap / self.model.wall_range));
        }
        let wanted = wanted.try_normalize(1e-9).unwrap_or(me.direction);
        let share = (self.dt / self.model.reaction).min(1.0);
        let direction = me.direction + (wanted - me.direction) * share;
        // Half a turn has no side: to the right.
        direction.try_normalize(1e-6).unwrap_or(-left_of(me.direction))
    }

    /// How fast the gap ahead in a direction lets one walk, m/s.
    pub(super) fn speed(&self, direction: Vector2, free: f64, near: &Nearby) -> f64 {
        let in_the_way = |other: &&Near| {
            direction.dot(&other.toward) > 0.0
                && direction.perp(&other.toward).abs() * other.distance <= self.contact
        };
        let gap =
            near.in_view.iter().filter(in_the_way).map(|other| other.distance).fold(f64::INFINITY, f64::min)
                - self.contact;
        free.min(gap.max(0.0) / self.model.time_gap)
    }

    /// The velocity nearest to the wanted one with which nobody and nothing is run into in this step: each of two may use up
    /// half of the gap between them.
    pub(super) fn safe(&self, mut velocity: Vector2, near: &Nearby, walls: &[Wall]) -> Vector2 {
        let people = || {
            near.close
                .iter()
                .map(|other| (other.toward, (other.distance - self.contact).max(0.0) / (2.0 * self.dt)))
        };
        let walls =
            || walls.iter().map(|wall| (wall.toward, (wall.distance - self.model.radius).max(0.0) / self.dt));
        // Along walls and bodies rather than to a stand.
        for (toward, most) in walls().chain(people()) {
            velocity -= toward * (velocity.dot(&toward) - most).max(0.0);
        }
        // What is left of the way into one of several is a matter of how fast.
        let share = |(toward, most): (Vector2, f64)| {
            let into = velocity.dot(&toward);
            if into > most { most / into } else { 1.0 }
        };
        let share = walls().chain(people()).map(share).fold(1.0, f64::min);
        velocity * share
    }
}

fn left_of(direction: Vector2) -> Vector2 {
    Vector2::new(-direction.y, direction.x)
}
