//! What the eyes look for: a goal in words, and whether it is reached.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, heading, yaw_of};
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{EntityRef, Scene};
use simworld_core::seam::{Goal, PlanStep};

use crate::language::name_of_color;
use crate::thought::prompts::one_line;

/// The error of a heading that counts as looking at something, radians.
const FACED: f64 = 0.2;

/// A step that is steered by eye.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Aim {
    /// To come within so many metres, at a speed, m/s.
    Reach(Goal, f64, Option<f64>),
    /// To stay within so many metres until something else ends it.
    Follow(Goal, Option<f64>),
    /// To have it straight ahead.
    Face(Goal),
}

impl Aim {
    /// The aim of a step; `None` if it needs no eyes.
    pub(super) fn of(step: &PlanStep) -> Option<Self> {
        match step {
            PlanStep::Navigate { to, within, speed } => Some(Self::Reach(*to, *within, *speed)),
            PlanStep::Follow { whom, speed, .. } => Some(Self::Follow(Goal::Entity(*whom), *speed)),
            PlanStep::Face { to } => Some(Self::Face(*to)),
            _ => None,
        }
    }

    /// Whether it can ever be reached.
    pub(super) const fn ends(self) -> bool {
        !matches!(self, Self::Follow(..))
    }

    pub(super) fn speed(&self) -> Option<f64> {
        match self {
            Self::Reach(_, _, speed) | Self::Follow(_, speed) => *speed,
            Self::Face(_) => None,
        }
    }

    fn goal(&self) -> Goal {
        match self {
            Self::Reach(goal, ..) | Self::Follow(goal, _) | Self::Face(goal) => *goal,
        }
    }

    /// What to look for; where a thing is stays for the eyes to find, and only a bare point has a bearing. `None` if it is gone.
    pub(super) fn describe(&self, scene: &dyn Scene, me: &EntityRef<'_>) -> Option<String> {
        let what = match self.goal() {
            Goal::Entity(id) => {
                let entity = scene.entity(id)?;
                let color =
                    entity.info.color.map(|color| format!("{} ", name_of_color(color))).unwrap_or_default();
                let name = entity
                    .info
                    .name
                    .as_ref()
                    .map(|name| format!(" {:?}", one_line(name)))
                    .unwrap_or_default();
                format!("the {color}{}{name}", entity.kind)
            }
            Goal::Point(point) => {
                let way = point.xy() - me.planar();
                let degrees = if way.norm() < 1e-6 { 0.0 } else { bearing(me, point.xy()).to_degrees() };
                format!("the point {:.0} m away, {degrees:.0}° to the left", way.norm())
            }
            _ => return None,
        };
        Some(match self {
            Self::Reach(_, within, _) => format!("come within {:.1} m of {what}", within.max(0.1)),
            Self::Follow(..) => format!("follow {what} and never be done"),
            Self::Face(_) => format!("have {what} in the middle of the picture"),
        })
    }

    /// Whether the world shows it reached; nobody is ever done following.
    pub(super) fn is_reached(&self, scene: &dyn Scene, me: &EntityRef<'_>) -> bool {
        let (here, entity) = match self.goal() {
            Goal::Entity(id) => (me.planar(), scene.entity(id)),
            _ => (me.planar(), None),
        };
        match (self, self.goal(), entity) {
            (Self::Reach(_, within, _), Goal::Point(point), _) => (point.xy() - here).norm() <= *within,
            (Self::Reach(_, within, _), _, Some(entity)) => {
                let to_access = (entity.access().xy() - here).norm();
                entity.info.shape.planar_distance(entity.pose, &here).min(to_access) <= *within
            }
            (Self::Face(_), Goal::Point(point), _) => bearing(me, point.xy()).abs() <= FACED,
            (Self::Face(_), _, Some(entity)) => bearing(me, entity.planar()).abs() <= FACED,
            _ => false,
        }
    }
}

/// Where a place is, radians to the left of where a body looks.
fn bearing(me: &EntityRef<'_>, place: Point2) -> f64 {
    let way = place - me.planar();
    if way.norm() < 1e-9 { 0.0 } else { wrap_angle(heading(&way) - yaw_of(me.pose)) }
}
