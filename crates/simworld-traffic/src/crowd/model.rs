//! The anticipation velocity model: a direction that avoids where the others will be, and a speed that the gap ahead allows.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Vector2;
use simworld_core::ops;

use super::nearby::{Me, Nearby};
use super::{REACH, Wall};

/// Repulsion below this share of the wish is left out.
const FAINT: f64 = 5e-3;
/// Who walks more slowly than this stands, m/s.
const STANDING: f64 = 0.1;

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

/// How people find their way among one another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Steering {
    /// The validated model: see [`AnticipationVelocity`].
    #[default]
    AnticipationVelocity,
    /// The simple one: everybody turns to their goal, and walks at the speed they want as long as there is room. Bodies
    /// never overlap, but nobody makes way for anybody, and streams that meet stand.
    OrientationToGoal,
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

/// The model with what follows from it, for decisions that hold for a time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rules {
    pub(super) model: AnticipationVelocity,
    /// Who is farther away is not seen, m.
    pub(super) reach: f64,
    /// Whether one heeds nobody but those one would touch.
    heedless: bool,
    /// Least distance between the middles of two bodies, m.
    pub(super) contact: f64,
    /// Repulsion over a wider gap is faint, m.
    pub(super) wide: f64,
    /// Repulsion from walls over a wider gap is faint, m.
    wall_wide: f64,
    /// How long a decision holds, s.
    hold: f64,
}

/// Somebody or something that one could run into.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bound {
    /// The unit vector towards it.
    pub(super) toward: Vector2,
    /// How far one may come nearer until the next decision, m.
    pub(super) room: f64,
}

impl Rules {
    /// The rules of a model, for decisions that hold for no time yet.
    pub(super) fn new(model: &AnticipationVelocity, steering: Steering) -> Self {
        let heedless = steering == Steering::OrientationToGoal;
        let wide = |range: f64, strength: f64| range * ops::ln((strength / FAINT).max(1.0));
        Self {
            model: *model,
            reach: if heedless { 0.0 } else { REACH },
            heedless,
            contact: 2.0 * model.radius,
            wide: wide(model.range, 2.0 * model.strength),
            wall_wide: wide(model.wall_range, model.wall_strength),
            hold: 0.0,
        }
    }

    /// The same for decisions that hold for a time, s.
    pub(super) fn holding(self, hold: f64) -> Self {
        Self { hold, ..self }
    }

    /// Who is nearer than this could be run into by who wants to walk at a speed, m.
    pub(super) fn close(&self, speed: f64) -> f64 {
        // A little more, for what rounding takes away.
        self.contact + 2.0 * speed * self.hold + 1e-3
    }

    /// The velocity in which one walks until the next decision, and the direction in which one looks.
    pub(super) fn decide(&self, me: &Me, near: &mut Nearby, walls: &[Wall]) -> (Vector2, Vector2) {
        if self.heedless {
            let direction = self.direction(me, Vector2::zeros(), walls);
            return (direction * me.wish.speed, direction);
        }
        let mut change = left_of(me.wish.direction) * near.aside(self, me);
        if me.person.speed < STANDING {
            change += near.giving_way(self);
        }
        let direction = self.direction(me, change, walls);
        let gap = (f64::from(near.ahead(self, direction)) - self.contact).max(0.0);
        (direction * me.wish.speed.min(gap / self.model.time_gap), direction)
    }

    /// The direction to walk in, of length one.
    fn direction(&self, me: &Me, change: Vector2, walls: &[Wall]) -> Vector2 {
        let mut wanted = me.wish.direction + change;
        for wall in walls {
            let gap = (wall.distance - self.model.radius).max(0.0);
            if gap < self.wall_wide {
                wanted -= wall.toward * (self.model.wall_strength * ops::exp(-gap / self.model.wall_range));
            }
        }
        let before = me.person.direction;
        let wanted = wanted.try_normalize(1e-9).unwrap_or(before);
        let share = (self.hold / self.model.reaction).min(1.0);
        let direction = before + (wanted - before) * share;
        // Half a turn has no side: to the right.
        direction.try_normalize(1e-6).unwrap_or(-left_of(before))
    }
}

/// The velocity nearest to the wanted one with which nothing that bounds one is run into within `hold` s.
pub(super) fn safe(mut velocity: Vector2, bounds: &[Bound], hold: f64) -> Vector2 {
    // Along walls and bodies rather than to a stand.
    for bound in bounds {
        velocity -= bound.toward * (velocity.dot(&bound.toward) - bound.room / hold).max(0.0);
    }
    // What is left of the way into one of several is a matter of how fast.
    let share = |bound: &Bound| {
        let (into, most) = (velocity.dot(&bound.toward), bound.room / hold);
        if into > most { most / into } else { 1.0 }
    };
    velocity * bounds.iter().map(share).fold(1.0, f64::min)
}

fn left_of(direction: Vector2) -> Vector2 {
    Vector2::new(-direction.y, direction.x)
}
