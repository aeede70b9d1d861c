//! Whether what is below a thing bears it: its centre of mass lies over what it touches, or between, so that it does not tip.

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2, heading};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, Scene};

use super::check::SUPPORT_GAP;
use super::place::is_surface;
use super::rest::{THIN, has_flat_top, holders, middle_of};
use super::solid::Solid;

/// What is nearer than this to an edge, m, or to a straight angle, radians, counts as on it.
const HAIR: f64 = 1e-9;

/// Whether a thing stays where it is, as it stands: its centre of mass, which is taken to be its middle, lies within the outline around all
/// that it touches below.
pub(super) fn is_borne(scene: &dyn Scene, thing: &EntityRef<'_>) -> bool {
    let below = holders(scene, thing).into_iter().filter(|below| below.is_flat);
    let below: Vec<Solid> = below.map(|below| below.solid).collect();
    bears(&below, &Solid::of(thing), middle_of(thing))
}

/// On what a thing would come to rest that falls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rest {
    /// How high that is, m.
    pub(super) top: f64,
    /// What is highest there; of two as high the lower id.
    pub(super) on: EntityId,
    /// Whether it would stay there, on that and on what is as high.
    pub(super) stays: bool,
}

/// The highest of what is below a solid whose centre of mass is there; `None` where there is nothing but the ground.
pub(super) fn rest_below(
    scene: &dyn Scene,
    solid: &Solid,
    middle: Point2,
    besides: &[EntityId],
) -> Option<Rest> {
    let bounds = solid.bounds();
    let mut below: Vec<(f64, EntityId, Option<Solid>)> = Vec::new();
    let _ = scene.visit(&Aabb::column(bounds.min.xy(), bounds.max.xy()), &mut |other| {
        let (top, own) = (other.bounds.max.z, Solid::of(&other));
        let is_below = !is_surface(other.kind)
            && !besides.contains(&other.id)
            && top <= bounds.min.z + SUPPORT_GAP
            && top - other.bounds.min.z > THIN
            && own.is_over(solid);
        if is_below {
            below.push((top, other.id, has_flat_top(other.kind).then_some(own)));
        }
        ControlFlow::Continue(())
    });
    let (top, on, _) =
        *below.iter().min_by(|one, other| other.0.total_cmp(&one.0).then(one.1.cmp(&other.1)))?;
    below.retain(|other| other.0 >= top - SUPPORT_GAP);
    let solids: Vec<Solid> = below.into_iter().filter_map(|(_, _, solid)| solid).collect();
    Some(Rest { top, on, stays: bears(&solids, solid, middle) })
}

/// The top of the highest piece of ground below a solid, m.
pub(super) fn surface_below(scene: &dyn Scene, solid: &Solid) -> Option<f64> {
    let bounds = solid.bounds();
    let mut highest: Option<f64> = None;
    let _ = scene.visit(&Aabb::column(bounds.min.xy(), bounds.max.xy()), &mut |piece| {
        let top = piece.bounds.max.z;
        let is_below = is_surface(piece.kind) && top <= bounds.min.z + SUPPORT_GAP;
        if is_below && Solid::of(&piece).is_over(solid) {
            highest = Some(highest.map_or(top, |best| best.max(top)));
        }
        ControlFlow::Continue(())
    });
    highest
}

/// Whether things with flat tops bear another whose centre of mass is there.
fn bears(below: &[Solid], above: &Solid, middle: Point2) -> bool {
    if below.iter().any(|holder| holder.distance_to(middle) == 0.0) {
        return true;
    }
    let corners: Vec<Point2> = below.iter().flat_map(|holder| contact(holder, above)).collect();
    is_among(middle, &corners)
}

/// Where two footprints share ground: the corners of that.
fn contact(below: &Solid, above: &Solid) -> Vec<Point2> {
    let window = above.corners();
    let mut shared = below.corners().to_vec();
    for (index, from) in window.iter().enumerate() {
        shared = left_of(&shared, *from, window[(index + 1) % window.len()]);
    }
    shared
}

/// What of a convex outline lies to the left of the line from one point to another.
fn left_of(outline: &[Point2], from: Point2, to: Point2) -> Vec<Point2> {
    let along = to - from;
    let left = |point: Point2| along.perp(&(point - from));
    let mut kept = Vec::with_capacity(outline.len() + 1);
    for (index, point) in outline.iter().enumerate() {
        let next = outline[(index + 1) % outline.len()];
        let (here, there) = (left(*point), left(next));
        if here >= 0.0 {
            kept.push(*point);
        }
        if (here >= 0.0) != (there >= 0.0) {
            kept.push(point + (next - point) * (here / (here - there)));
        }
    }
    kept
}

/// Whether a point lies within the convex outline around others: seen from there, no half of the plane is without any.
fn is_among(point: Point2, others: &[Point2]) -> bool {
    let ways = others.iter().map(|other| other - point);
    let mut headings: Vec<f64> = Vec::with_capacity(others.len());
    for way in ways {
        if way.norm() <= HAIR {
            return true;
        }
        headings.push(heading(&way));
    }
    headings.sort_by(f64::total_cmp);
    let (Some(first), Some(last)) = (headings.first(), headings.last()) else { return false };
    let round = first + TAU - last;
    headings.windows(2).map(|pair| pair[1] - pair[0]).fold(round, f64::max) <= PI + HAIR
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::{Point3, pose_facing};
    use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};

    use super::*;

    fn slab(length: f64, width: f64, x: f64, y: f64, yaw: f64) -> Solid {
        Solid::standing(Shape::cuboid(length, width, 0.1), Point3::new(x, y, 0.0), yaw)
    }

    fn stands(below: &[Solid], above: &Solid) -> bool {
        bears(below, above, above.planar())
    }

    #[test]
    fn what_has_its_middle_over_or_between_what_it_stands_on_is_borne() {
        let board = slab(3.0, 0.3, 0.0, 0.0, 0.0);
        let trestle = |x: f64| slab(0.2, 1.0, x, 0.0, 0.0);
        assert!(stands(&[trestle(0.05)], &board), "on one below its middle");
        assert!(!stands(&[trestle(0.2)], &board), "on one beside its middle it tips");
        assert!(stands(&[trestle(-1.0), trestle(0.7)], &board), "between two");
        assert!(!stands(&[trestle(0.3), trestle(1.2)], &board), "beyond both");
        assert!(!stands(&[], &board));
        // Two that stand on one side of its long axis hold it where their line passes its middle, and no farther.
        let wide = slab(2.0, 2.0, 0.0, 0.0, 0.4);
        let (one, other) = (slab(0.4, 0.4, -0.6, 0.1, 0.0), slab(0.4, 0.4, 0.6, 0.1, 0.0));
        assert!(stands(&[one, other], &wide));
        let (one, other) = (slab(0.4, 0.4, -0.6, 0.3, 0.0), slab(0.4, 0.4, 0.6, 0.3, 0.0));
        assert!(!stands(&[one, other], &wide));
    }

    #[test]
    fn what_is_shared_by_two_footprints_has_their_common_area() {
        let area = |outline: &[Point2]| {
            let pairs = (0..outline.len()).map(|at| (outline[at], outline[(at + 1) % outline.len()]));
            pairs.map(|(a, b)| a.coords.perp(&b.coords)).sum::<f64>() * 0.5
        };
        let shared = |a: &Solid, b: &Solid| area(&contact(a, b));
        let table = slab(1.0, 1.0, 0.0, 0.0, 0.0);
        assert!((shared(&table, &slab(3.0, 0.4, 1.0, 0.0, 0.0)) - 0.4).abs() < 1e-12);
        assert!((shared(&table, &slab(0.2, 0.2, 0.1, 0.1, 0.7)) - 0.04).abs() < 1e-12, "all of it");
        // A square of a metre and the same turned by 45°: an octagon.
        let octagon = 2.0 * 2f64.sqrt() - 2.0;
        let turned = slab(1.0, 1.0, 0.0, 0.0, std::f64::consts::FRAC_PI_4);
        assert!((shared(&table, &turned) - octagon).abs() < 1e-12);
        assert_eq!(shared(&table, &slab(1.0, 1.0, 3.0, 0.0, 0.0)), 0.0);
    }

    fn put(world: &mut World, kind: EntityKind, size: [f64; 3], at: [f64; 3]) -> EntityId {
        let pose = pose_facing(Point3::new(at[0], at[1], at[2]), 0.0);
        let shape = Shape::cuboid(size[0], size[1], size[2]);
        world.spawn(EntityDesc::new(kind, pose, shape)).expect("a box")
    }

    #[test]
    fn what_falls_comes_to_rest_on_the_highest_below_it() {
        let mut world = World::new();
        let table = put(&mut world, EntityKind::Table, [1.0, 1.0, 0.8], [0.0, 0.0, 0.0]);
        let tray = put(&mut world, EntityKind::Prop, [0.4, 0.4, 0.2], [0.0, 0.0, 0.8]);
        let cup = Solid::standing(Shape::cuboid(0.1, 0.1, 0.1), Point3::new(0.0, 0.0, 3.0), 0.0);
        let below = |solid: &Solid, besides: &[EntityId]| {
            rest_below(&world, solid, solid.planar(), besides).map(|rest| (rest.on, rest.stays))
        };
        assert_eq!(below(&cup, &[]), Some((tray, true)));
        assert_eq!(below(&cup, &[tray]), Some((table, true)));
        assert_eq!(below(&cup, &[tray, table]), None);
        let beside = Solid::standing(cup.shape, Point3::new(0.6, 0.0, 3.0), 0.0);
        assert_eq!(below(&beside, &[]), None, "beside the table there is the ground");
        let at_the_edge = Solid::standing(cup.shape, Point3::new(0.53, 0.0, 3.0), 0.0);
        assert_eq!(below(&at_the_edge, &[]), Some((table, false)), "it would slip off");
    }

    #[test]
    fn a_board_falls_on_two_that_are_as_high_and_stays() {
        let mut world = World::new();
        let one = put(&mut world, EntityKind::Table, [0.4, 1.0, 0.8], [-0.7, 0.0, 0.0]);
        put(&mut world, EntityKind::Table, [0.4, 1.0, 0.78], [0.7, 0.0, 0.0]);
        let board = Solid::standing(Shape::cuboid(2.0, 0.3, 0.05), Point3::new(0.0, 0.0, 2.0), 0.0);
        let rest = rest_below(&world, &board, board.planar(), &[]);
        assert_eq!(rest, Some(Rest { top: 0.8, on: one, stays: true }));
    }
}
