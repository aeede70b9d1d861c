//! Ways round the nearest corner that keep off its kerb.
//!
//! A smooth curve from stop line to stop line cuts the corner where the junction reaches far into its legs, or where a leg
//! bends within the junction. There the way first follows its leg further in, and turns later and more tightly.

use std::borrow::Cow;

use super::beside::Kerb;
use super::curve::Curves;
use super::legs::Leg;
use crate::geometry::{Point2, Vector2, direction, heading};
use crate::net::polyline::{self, Measured};
use crate::net::{Intersection, RoadNetwork};

/// A smooth curve that comes nearer to the kerb than this is no way, m: half a car and a little.
const LEAST_CLEARANCE: f64 = 0.95;
/// The middle of a way that is found instead keeps this far off the kerb, m: half a car and a margin. Lanes that lie nearer
/// keep their distance.
const CLEARANCE: f64 = 1.2;
/// By so much two ways count as equally far from a kerb, m.
const MARGIN: f64 = 0.05;
/// Each try follows either leg this much further into the junction, m.
const STEP: f64 = 1.5;
/// Nobody turns on less than this from where the turn begins to where it ends, m: a car's radius of some 5 m at a right angle.
const LEAST_CHORD: f64 = 7.0;

/// A way over a junction from the lane of one leg to that of another: where it begins and ends.
pub(super) struct Way<'a> {
    pub(super) from: &'a Leg,
    pub(super) start: Point2,
    pub(super) to: &'a Leg,
    pub(super) end: Point2,
}

/// The kerb on the left of a leg, seen leaving, round the corner to the next one: what who arrives and turns right goes round.
fn kerb(intersection: &Intersection, leg: usize) -> &[Point2] {
    let Some(start) = intersection.kerbs.get(leg) else { return &[] };
    let end = intersection.kerbs.get(leg + 1).map_or(intersection.outline.len(), |end| *end as usize);
    intersection.outline.get(*start as usize..end).unwrap_or(&[])
}

/// What ways are looked for with, kept from one to the next.
#[derive(Default)]
pub(super) struct Search {
    pub(super) curves: Curves,
    kerb: Kerb,
    /// The best way so far, and the one that is tried.
    best: Vec<Point2>,
    path: Vec<Point2>,
    /// Its part behind the turn.
    exit: Vec<Point2>,
    /// Of the leg that is followed the middle, and the line of the lane.
    middle: Vec<Point2>,
    line: Vec<Point2>,
}

/// The smooth curve that leaves and arrives along two directions, or the widest turn that keeps off the kerb of a leg where that
/// one does not; where none does, the one that keeps farthest.
pub(super) fn keep_off(
    network: &RoadNetwork,
    (intersection, leg): (&Intersection, usize),
    way: &Way<'_>,
    (leaving, arriving): (Vector2, Vector2),
    search: &mut Search,
) -> Vec<Point2> {
    search.kerb.set(kerb(intersection, leg));
    search.best.clear();
    search.best.extend(search.curves.dense_curve(way.start, leaving, way.end, arriving));
    let wanted = search.kerb.clearance(&[way.start, way.end], CLEARANCE) - MARGIN;
    let enough = wanted.min(LEAST_CLEARANCE);
    let mut clear = search.kerb.clearance(&search.best, enough);
    if clear >= enough {
        return search.best.clone();
    }
    let legs = [way.from, way.to].map(|leg| outwards(network, leg));
    let [from, to] = legs.each_ref().map(|line| Measured::new(line));
    let (mut into, mut out) = (way.from.stop, way.to.stop);
    while clear < wanted && into.max(out) > STEP {
        (into, out) = ((into - STEP).max(STEP), (out - STEP).max(STEP));
        if search.turn_later(way, (&from, into), (&to, out)).is_none() {
            break;
        }
        if let Some(more) = search.kerb.clearance_above(&search.path, clear, wanted) {
            clear = more;
            std::mem::swap(&mut search.best, &mut search.path);
        }
    }
    search.best.clone()
}

/// The middle of a leg's street from the node outwards.
fn outwards<'a>(network: &'a RoadNetwork, leg: &Leg) -> Cow<'a, [Point2]> {
    let centerline = &network.roads[leg.street].centerline;
    if leg.at_start { centerline.into() } else { polyline::reversed(centerline).into() }
}

impl Search {
    /// Sets the path to the way that follows its legs to so far from the node, m, and turns there; `None` if that is too tight.
    fn turn_later(
        &mut self,
        way: &Way<'_>,
        (from, into): (&Measured<'_>, f64),
        (to, out): (&Measured<'_>, f64),
    ) -> Option<()> {
        let Self { curves, path, exit, middle, line, .. } = self;
        along(from, (way.from, way.start), into, (middle, line), path);
        path.reverse();
        along(to, (way.to, way.end), out, (middle, line), exit);
        let (ahead, back) = (heading_out(path.iter())?, heading_out(exit.iter().rev())?);
        let (start, end) = (*path.last()?, *exit.first()?);
        if (end - start).norm() < LEAST_CHORD {
            return None;
        }
        path.extend(curves.dense_curve(start, direction(ahead), end, -direction(back)).skip(1));
        path.extend_from_slice(&exit[1..]);
        Some(())
    }
}

/// The heading with which a path ends, radians; `None` if nothing of it has a length.
fn heading_out<'a>(path: impl DoubleEndedIterator<Item = &'a Point2>) -> Option<f64> {
    let mut back = path.rev();
    let mut end = back.next()?;
    for before in back {
        let step = end - before;
        if step.norm() > 0.0 {
            return Some(heading(&step));
        }
        end = before;
    }
    None
}

/// Writes the line of a lane within the junction over `path`, from `from` m off the node outwards to the lane's end, a point about
/// every metre; `middle` and `line` lend their memory.
fn along(
    outwards: &Measured<'_>,
    (leg, lane_end): (&Leg, Point2),
    from: f64,
    (middle, line): (&mut Vec<Point2>, &mut Vec<Point2>),
    path: &mut Vec<Point2>,
) {
    outwards.slice_into(from, leg.stop, middle);
    let lateral = leg.direction().perp(&(lane_end - leg.node));
    let lateral = polyline::closest(middle, &lane_end).map_or(lateral, |closest| closest.lateral);
    polyline::offset_into(middle, lateral, line);
    if let Some(last) = line.last_mut() {
        *last = lane_end;
    }
    let line = Measured::new(line);
    let pieces = line.length().ceil().max(1.0);
    path.clear();
    path.extend((0..=pieces as usize).map(|index| line.point_at(line.length() * index as f64 / pieces)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::net::{NetworkConfig, StreetPlan, Turn};

    #[test]
    fn who_turns_right_keeps_off_the_corner() {
        let plan = StreetPlan::crossroads(100.0);
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("it is a plan");
        let mut turns = 0;
        for way in network.connections.iter().filter(|way| way.turn == Turn::Right) {
            let place = &network.intersections[way.intersection.index()];
            let clear = (0..place.roads.len())
                .flat_map(|leg| way.path.iter().map(move |point| (leg, point)))
                .map(|(leg, point)| {
                    let kerb = kerb(place, leg);
                    polyline::closest(kerb, point).map_or(f64::INFINITY, |near| near.distance)
                })
                .fold(f64::INFINITY, f64::min);
            assert!(clear >= LEAST_CLEARANCE, "{clear} m off the kerb: {way:?}");
            // It is one smooth way all the same, from lane to lane.
            let turned = way.path.windows(3).map(|three| {
                let (before, after) = (three[1] - three[0], three[2] - three[1]);
                crate::ops::atan2(before.perp(&after), before.dot(&after)).abs()
            });
            assert!(turned.fold(0.0, f64::max) < 0.35, "{way:?}");
            turns += 1;
        }
        assert_eq!(turns, 4);
    }
}
