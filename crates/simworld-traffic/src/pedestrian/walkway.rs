//! The way from one waypoint to the next, for one walker.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::id::PlazaId;
use simworld_core::net::{WaypointGraph, WaypointKind};

use super::Pedestrian;
use super::place::KEEP_RIGHT;
use super::plaza::Plazas;
use crate::crowd::Wall;

/// A waypoint counts as reached within this distance, or beside it, m.
const REACHED: f64 = 0.5;
/// Room that one keeps to the edge of a walkway where there is so much, m.
pub(super) const MARGIN: f64 = 0.3;
/// So near to where a way across a plaza begins or ends one keeps within its width, m: there may be a narrow gate.
const GATE: f64 = 2.5;

/// The way from one waypoint to the next, for one walker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Walkway {
    from: Point2,
    pub(super) along: Vector2,
    /// Half the width, m.
    pub(super) half: f64,
    /// The next waypoint, a little to the right of it.
    pub(super) target: Point2,
    /// The open ground on which it lies.
    plaza: Option<Open>,
}

/// What of a way lies on open ground.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Open {
    plaza: PlazaId,
    /// Where the way itself leads.
    to: Point2,
    /// Where it begins and ends that is a gate.
    gates: [Option<Point2>; 2],
}

impl Walkway {
    #[inline]
    pub(super) fn of(walker: &Pedestrian, ways: &WaypointGraph, plazas: &Plazas) -> Self {
        let (from, to) = (ways.waypoint(walker.from).position, ways.waypoint(walker.to).position);
        let half = ways.edge(walker.from, walker.to).map_or(0.0, |edge| f64::from(edge.width) * 0.5);
        let along = (to - from).try_normalize(1e-9).unwrap_or_else(Vector2::x);
        let right = f64::from(walker.keep_right).min((half - MARGIN).max(0.0));
        let way = Self { from, along, half, target: to + right_of(along) * right, plaza: None };
        match plazas.between(ways, walker.from, walker.to) {
            Some(plaza) => way.across(walker, ways, plazas, plaza),
            None => way,
        }
    }

    /// The same way across open ground: who keeps far to the right does so there too, but by as much as there is room.
    fn across(self, walker: &Pedestrian, ways: &WaypointGraph, plazas: &Plazas, plaza: PlazaId) -> Self {
        let gates = [walker.from, walker.to].map(|end| {
            let end = ways.waypoint(end);
            (!matches!(end.kind, WaypointKind::Plaza(_))).then_some(end.position)
        });
        let to = ways.waypoint(walker.to).position;
        let open = Self { plaza: Some(Open { plaza, to, gates }), ..self };
        let Some([right, left]) = plazas.room(walker.to, self.along) else { return open };
        let (least, most) = KEEP_RIGHT;
        let aside = match f64::from(walker.keep_right) {
            kept if (least..=most).contains(&kept) && right > most => {
                least + (right - least) * (kept - least) / (most - least)
            }
            // Who has no more room than on the way itself, or is told how far to the right to keep.
            kept => kept.clamp(-left.max(0.0), right.max((self.half - MARGIN).max(0.0))),
        };
        let target = to + right_of(self.along) * aside;
        Self { half: self.half + right + left, target, ..open }
    }

    /// Where one heads who is there.
    pub(super) fn aim(&self, at: Point2, plazas: &Plazas) -> Point2 {
        let Some(Open { plaza, to, .. }) = self.plaza else { return self.target };
        plazas.aim(plaza, at, self.target, (self.from, to))
    }

    /// Whether its end is reached, or where one would wait beside others who stand there.
    pub(super) fn is_walked(&self, at: Point2) -> bool {
        let offset = self.target - at;
        let aside = self.along.perp(&offset).abs();
        let beside = self.along.dot(&offset) < REACHED && aside < self.half.max(REACHED);
        beside || offset.norm_squared() < REACHED * REACHED
    }

    /// A way that one can still go before its [end is reached](Self::is_walked), m; not positive where it may be.
    pub(super) fn left(&self, at: Point2) -> f32 {
        let offset = self.target - at;
        let (before, aside) = (self.along.dot(&offset), self.along.perp(&offset).abs());
        let beside =
            Vector2::new((before - REACHED).max(0.0), (aside - self.half.max(REACHED)).max(0.0)).norm();
        // A little less, for what rounding takes.
        (beside.min(offset.norm() - REACHED) - 0.01) as f32
    }

    /// Its edges, which one does not cross outwards.
    pub(super) fn edges(&self, at: Point2, plazas: &Plazas, walls: &mut Vec<Wall>) {
        if let Some(Open { plaza, gates, .. }) = self.plaza
            && gates.into_iter().flatten().all(|gate| (gate - at).norm_squared() > GATE * GATE)
        {
            plazas.sides(plaza, at, walls);
            return;
        }
        let left = Vector2::new(-self.along.y, self.along.x);
        let aside = left.dot(&(at - self.from));
        walls.push(Wall { toward: left, distance: self.half - aside });
        walls.push(Wall { toward: -left, distance: self.half + aside });
    }
}

fn right_of(along: Vector2) -> Vector2 {
    Vector2::new(along.y, -along.x)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Wherever one is, the end is not reached before one has gone as far as is said to be left.
        #[test]
        fn nobody_is_there_before_they_have_gone_so_far(
            at in prop::array::uniform2(-30.0..30.0), half in 0.0..4.0, turn in 0.0..std::f64::consts::TAU, way in 0.0..1.0,
        ) {
            let walkway = Walkway { from: Point2::new(-25.0, 0.0), along: Vector2::x(), half, target: Point2::new(0.0, -0.3), plaza: None };
            let at = Point2::from(at);
            let left = f64::from(walkway.left(at));
            let on = at + simworld_core::geometry::direction(turn) * left.max(0.0) * way;
            prop_assert!(left <= 0.0 || !walkway.is_walked(on), "{left} m left at {at}, walked at {on}");
            // And it is told closely enough to be of use.
            prop_assert!(walkway.is_walked(at) || left > 0.0 || walkway.left(at) > -0.02);
        }
    }
}
