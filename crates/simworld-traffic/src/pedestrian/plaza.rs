//! Plazas as walkers see them: open ground that they cross as they like, side by side, and whose edges they do not cross.

use std::collections::BTreeMap;

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::id::{PlazaId, WaypointId};
use simworld_core::net::{Plaza, RoadNetwork, WaypointGraph, WaypointKind};

use super::walkway::MARGIN;
use crate::crowd::Wall;

/// Sides farther away than this are not noticed, m: more than one walks in a step.
const REACH: f64 = 1.5;
/// People spread no farther than this to either side of a straight way, m, nor at a wider angle to it.
const WIDEST: f64 = 12.0;
const SLANT: f64 = 0.35;
/// What is nearer to a place than this does not hide it, m.
const GATE: f64 = 1.0;
/// What does not fit is tried so much narrower, so often.
const NARROWER: f64 = 0.7;
const TRIES: u32 = 10;

/// The plazas of a network.
#[derive(Clone, Debug, Default)]
pub(crate) struct Plazas {
    plazas: Vec<Plaza>,
    /// By waypoint on a straight way across: the way's direction, and the room to its right and to its left, m.
    ways: BTreeMap<WaypointId, Straight>,
}

/// A straight way across a plaza.
#[derive(Clone, Copy, Debug)]
struct Straight {
    along: Vector2,
    /// To its right, and to its left, m.
    room: [f64; 2],
}

impl Plazas {
    pub(crate) fn new(network: &RoadNetwork, ways: &WaypointGraph) -> Self {
        let mut plazas = Self { plazas: network.plazas.clone(), ways: BTreeMap::new() };
        if plazas.plazas.is_empty() {
            return plazas;
        }
        for index in 0..ways.waypoints().len() {
            let id = WaypointId::from_index(index);
            if on(ways, id).is_some() && !plazas.ways.contains_key(&id) {
                plazas.measure(ways, id);
            }
        }
        plazas
    }

    /// The plaza on which the way between two waypoints lies.
    #[inline]
    pub(super) fn between(&self, ways: &WaypointGraph, from: WaypointId, to: WaypointId) -> Option<PlazaId> {
        if self.plazas.is_empty() {
            return None;
        }
        on(ways, from).or_else(|| on(ways, to))
    }

    /// The room to the right and to the left of a waypoint for those who come to it in some direction, m; none where there is
    /// no more than that of the way itself.
    pub(super) fn room(&self, to: WaypointId, along: Vector2) -> Option<[f64; 2]> {
        let Straight { along: own, room: [right, left] } = self.ways.get(&to)?;
        Some(if own.dot(&along) >= 0.0 { [*right, *left] } else { [*left, *right] })
    }

    /// Where somebody heads who wants to come to a place: there, or if something stands between, to the place farthest on
    /// the straight way from one place to another that can be seen, beside which nothing does.
    pub(super) fn aim(
        &self,
        plaza: PlazaId,
        at: Point2,
        target: Point2,
        (from, to): (Point2, Point2),
    ) -> Point2 {
        const SHARES: [f64; 5] = [1.0, 0.75, 0.5, 0.25, 0.0];
        let Some(plaza) = self.plazas.get(plaza.index()) else { return target };
        let is_seen = |place: &Point2| {
            // A gate may lie a little beyond the edge.
            let way = place - at;
            let near = at + way * (1.0 - GATE / way.norm()).max(0.0);
            !plaza.sides().any(|[a, b]| cross(a, b, at, near))
        };
        let along = SHARES.into_iter().map(|share| from + (to - from) * share);
        std::iter::once(target).chain(along).find(is_seen).unwrap_or(target)
    }

    /// Whether a place is on a plaza.
    pub(super) fn contains(&self, plaza: PlazaId, at: Point2) -> bool {
        self.plazas.get(plaza.index()).is_some_and(|plaza| plaza.contains(at))
    }

    /// The sides of a plaza near somebody who is on it; of who is not, the nearest side, over which they may come in.
    pub(super) fn sides(&self, plaza: PlazaId, at: Point2, walls: &mut Vec<Wall>) {
        let Some(plaza) = self.plazas.get(plaza.index()) else { return };
        let near = plaza.sides().filter_map(|side| wall(side, at));
        if plaza.contains(at) {
            walls.extend(near.filter(|wall| wall.distance >= 0.0));
        } else {
            let beyond = near.filter(|wall| wall.distance < 0.0);
            walls.extend(beyond.max_by(|a, b| a.distance.total_cmp(&b.distance)));
        }
    }

    /// Measures the room beside the straight way on which a waypoint lies.
    fn measure(&mut self, ways: &WaypointGraph, middle: WaypointId) {
        let Some(plaza) = on(ways, middle).and_then(|plaza| self.plazas.get(plaza.index())) else { return };
        let mut arms = ways.edges(middle).iter().map(|edge| arm(ways, middle, edge.to));
        let (Some(mut line), Some(after)) = (arms.next(), arms.next()) else { return };
        line.reverse();
        line.push(middle);
        line.extend(after);
        let places: Vec<Point2> = line.iter().map(|id| ways.waypoint(*id).position).collect();
        let along = (places[places.len() - 1] - places[0]).try_normalize(1e-9);
        let Some(along) = along else { return };
        let left = Vector2::new(-along.y, along.x);
        let room = [-left, left].map(|aside| room_beside(plaza, &places, aside));
        for id in &line[1..line.len() - 1] {
            self.ways.insert(*id, Straight { along, room });
        }
    }
}

/// A side of a plaza as a wall, if it is near: the plaza lies to its left.
fn wall([from, to]: [Point2; 2], at: Point2) -> Option<Wall> {
    let (side, offset) = (to - from, at - from);
    let length = side.norm();
    let (station, inside) = (offset.dot(&side) / length, side.perp(&offset) / length);
    if inside.abs() > REACH || station > length {
        return None;
    }
    if station >= 0.0 {
        return Some(Wall { toward: Vector2::new(side.y, -side.x) / length, distance: inside });
    }
    // A corner that juts in: what lies beyond it lies in front of both of its sides.
    let distance = offset.norm();
    (inside > 0.0 && distance <= REACH).then(|| Wall { toward: -offset / distance, distance })
}

/// The plaza in the middle of which a waypoint lies.
fn on(ways: &WaypointGraph, id: WaypointId) -> Option<PlazaId> {
    match ways.waypoint(id).kind {
        WaypointKind::Plaza(plaza) => Some(plaza),
        _ => None,
    }
}

/// The waypoints of a straight way from one of its waypoints on, as far as its end.
fn arm(ways: &WaypointGraph, mut from: WaypointId, mut to: WaypointId) -> Vec<WaypointId> {
    let mut found = vec![to];
    while on(ways, to).is_some() {
        let next = ways.edges(to).iter().map(|edge| edge.to).find(|next| *next != from);
        let Some(next) = next.filter(|next| !found.contains(next)) else { break };
        found.push(next);
        (from, to) = (to, next);
    }
    found
}

/// How far people may walk beside a straight way, m, so that nothing stands between them and it, nor where they leave it and
/// come back to it.
fn room_beside(plaza: &Plaza, places: &[Point2], aside: Vector2) -> f64 {
    let (first, last) = (places[0], places[places.len() - 1]);
    let (second, before) = (places[1], places[places.len() - 2]);
    let least = (second - first).norm().min((last - before).norm());
    let mut room = (SLANT * least).min(WIDEST);
    for _ in 0..TRIES {
        let out = aside * (room + MARGIN);
        if is_open(plaza, &[first, second + out, before + out, last]) {
            return room;
        }
        room *= NARROWER;
    }
    0.0
}

/// Whether a convex outline lies on a plaza, but for what is near its first and its last corner: these may be a little beyond.
fn is_open(plaza: &Plaza, outline: &[Point2; 4]) -> bool {
    let [first, second, third, last] = *outline;
    let within = |gate: Point2, next: Point2| {
        let way = next - gate;
        gate + way * (GATE / way.norm()).min(1.0)
    };
    let (first, last) = (within(first, second), within(last, third));
    let legs = [[first, second], [second, third], [third, last]];
    let turn = (second - first).perp(&(last - first));
    let is_within = |corner: &Point2| {
        let all = legs.into_iter().chain([[last, first]]);
        all.map(|[a, b]| (b - a).perp(&(corner - a)) * turn).all(|side| side > 0.0)
    };
    plaza.contains(second)
        && plaza.contains(third)
        && !plaza.rings().flatten().any(is_within)
        && !plaza.sides().any(|[a, b]| legs.into_iter().any(|[c, d]| cross(a, b, c, d)))
}

/// Whether two pieces cross, their ends left out.
fn cross(a: Point2, b: Point2, c: Point2, d: Point2) -> bool {
    let side = |a: Point2, b: Point2, p: Point2| (b - a).perp(&(p - a));
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(corners: &[(f64, f64)]) -> Vec<Point2> {
        corners.iter().map(|(x, y)| Point2::new(*x, *y)).collect()
    }

    /// A plaza of 60 m by 60 m, with a thing of 1 m by 1 m so far east of the middle of the way from south to north.
    fn with_thing(east: f64) -> Plaza {
        let thing = [(29.5, 29.5), (29.5, 30.5), (30.5, 30.5), (30.5, 29.5)].map(|(x, y)| (x + east, y));
        Plaza { edge: ring(&[(0.0, 0.0), (60.0, 0.0), (60.0, 60.0), (0.0, 60.0)]), holes: vec![ring(&thing)] }
    }

    #[test]
    fn nothing_stands_between_a_way_and_those_beside_it() {
        let places = ring(&[(30.0, 0.0), (30.0, 20.0), (30.0, 40.0), (30.0, 60.0)]);
        for (east, least, most) in [(2.0, 0.3, 1.2), (6.0, 3.0, 5.2), (20.0, 6.9, 7.1), (-6.0, 6.9, 7.1)] {
            let room = room_beside(&with_thing(east), &places, Vector2::x());
            assert!((least..most).contains(&room), "{room} m beside a thing {east} m to the east");
        }
        // Nor beyond the edge.
        let along_the_edge = ring(&[(59.0, 0.0), (59.0, 20.0), (59.0, 40.0), (59.0, 60.0)]);
        let room = room_beside(&with_thing(0.0), &along_the_edge, Vector2::x());
        assert!(room < 0.71, "{room} m beyond the edge");
    }

    #[test]
    fn who_is_behind_something_goes_to_where_the_way_is_seen() {
        let plazas = Plazas { plazas: vec![with_thing(4.0)], ways: BTreeMap::new() };
        let way = (Point2::new(30.0, 0.0), Point2::new(30.0, 60.0));
        let aim =
            |at: (f64, f64)| plazas.aim(PlazaId(0), Point2::new(at.0, at.1), Point2::new(36.0, 50.0), way);
        assert_eq!(aim((30.0, 10.0)), Point2::new(36.0, 50.0));
        // The thing hides the place from the south and, from so near, the end of the way.
        assert_eq!(aim((34.2, 29.0)), Point2::new(30.0, 30.0));
    }

    #[test]
    fn sides_are_walls_for_who_is_on_it_and_let_in_who_is_not() {
        let plazas = Plazas { plazas: vec![with_thing(4.0)], ways: BTreeMap::new() };
        let near = |x: f64, y: f64| {
            let mut walls = Vec::new();
            plazas.sides(PlazaId(0), Point2::new(x, y), &mut walls);
            walls
        };
        assert!(near(20.0, 20.0).is_empty());
        assert_eq!(near(0.5, 20.0), [Wall { toward: -Vector2::x(), distance: 0.5 }]);
        // The far side of a thin thing is no wall of who stands before it.
        assert_eq!(near(33.2, 30.0), [Wall { toward: Vector2::x(), distance: 33.5 - 33.2 }]);
        assert_eq!(near(-0.25, 20.0), [Wall { toward: -Vector2::x(), distance: -0.25 }]);
        // A corner that juts in.
        let [corner, ..] = near(33.2, 29.2)[..] else { panic!("{:?}", near(33.2, 29.2)) };
        assert!((corner.distance - 0.3 * 2.0_f64.sqrt()).abs() < 1e-9 && corner.toward.x > 0.0);
    }
}
