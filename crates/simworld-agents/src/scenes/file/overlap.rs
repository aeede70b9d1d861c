//! How deep two things share space.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::scene::{EntityRef, Shape};

/// How deep two upright things share space, m: the least way, aside, up or down, by which one of them is free of the other; zero or
/// less where they are apart. Round ones are round in the plane, all others boxes.
pub(super) fn depth(one: &EntityRef<'_>, other: &EntityRef<'_>) -> f64 {
    let (a, b) = (one.bounds, other.bounds);
    let upright = (a.max.z - b.min.z).min(b.max.z - a.min.z);
    if upright <= 0.0 {
        return upright;
    }
    let aside = match (radius(one), radius(other)) {
        (Some(r), Some(s)) => r + s - (one.planar() - other.planar()).norm(),
        (Some(r), None) => disc_in_box(one.planar(), r, other),
        (None, Some(s)) => disc_in_box(other.planar(), s, one),
        (None, None) => boxes(&one.obb().footprint(), &other.obb().footprint()),
    };
    aside.min(upright)
}

fn radius(thing: &EntityRef<'_>) -> Option<f64> {
    match thing.info.shape {
        Shape::Cylinder { radius, .. } | Shape::Capsule { radius, .. } | Shape::Sphere { radius } => {
            Some(radius)
        }
        _ => None,
    }
}

/// How deep a disc reaches into the footprint of a box, m.
fn disc_in_box(middle: Point2, radius: f64, of: &EntityRef<'_>) -> f64 {
    let beyond = of.info.shape.planar_distance(of.pose, &middle);
    if beyond > 0.0 {
        return radius - beyond;
    }
    let corners = of.obb().footprint();
    let to_side = |index: usize| {
        let (from, to) = (corners[index], corners[(index + 1) % 4]);
        let along = (to - from).try_normalize(1e-9).unwrap_or_else(Vector2::x);
        along.perp(&(middle - from)).abs()
    };
    radius + (0..4).map(to_side).fold(f64::INFINITY, f64::min)
}

/// How deep two rectangles share space, m, by the axis on which they do least.
fn boxes(a: &[Point2; 4], b: &[Point2; 4]) -> f64 {
    let axes = [a[0] - a[1], a[1] - a[2], b[0] - b[1], b[1] - b[2]];
    let span = |corners: &[Point2; 4], axis: &Vector2| {
        corners
            .iter()
            .map(|corner| corner.coords.dot(axis))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)))
    };
    let shared = |axis: Vector2| {
        let ((a_low, a_high), (b_low, b_high)) = (span(a, &axis), span(b, &axis));
        (a_high - b_low).min(b_high - a_low)
    };
    let axes = axes.iter().filter_map(|axis| axis.try_normalize(1e-9));
    axes.map(shared).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::{Point3, Vector3, pose_facing};
    use simworld_core::ops;
    use simworld_core::scene::{EntityDesc, EntityKind, Scene, World};

    use super::*;

    const BOX: Shape = Shape::Box { size: Vector3::new(2.0, 1.0, 1.0) };
    const ROUND: Shape = Shape::Cylinder { radius: 0.5, height: 2.0 };

    fn depth_of(one: (Shape, [f64; 4]), other: (Shape, [f64; 4])) -> f64 {
        let mut world = World::new();
        let mut put = |(shape, [x, y, z, yaw]): (Shape, [f64; 4])| {
            let pose = pose_facing(Point3::new(x, y, z), yaw);
            world.spawn(EntityDesc::new(EntityKind::Prop, pose, shape)).expect("it is sound")
        };
        let (one, other) = (put(one), put(other));
        let there = |id| world.entity(id).expect("it was put there");
        let (forth, back) = (depth(&there(one), &there(other)), depth(&there(other), &there(one)));
        assert!((forth - back).abs() < 1e-12, "it is the same seen from either: {forth}, {back}");
        forth
    }

    #[test]
    fn boxes_share_what_the_least_move_frees() {
        let at = |x, y, z, yaw| (BOX, [x, y, z, yaw]);
        let origin = at(0.0, 0.0, 0.0, 0.0);
        assert!((depth_of(origin, at(1.7, 0.0, 0.0, 0.0)) - 0.3).abs() < 1e-12, "aside");
        assert!((depth_of(origin, at(0.5, 0.1, 0.8, 0.0)) - 0.2).abs() < 1e-12, "up");
        assert!(depth_of(origin, at(2.0, 0.0, 0.0, 0.0)) <= 1e-12, "they touch");
        assert!(depth_of(origin, at(0.0, 0.0, 1.0, 0.0)) <= 1e-12, "one stands on the other");
        assert!(depth_of(origin, at(5.0, 5.0, 0.0, 0.7)) < 0.0, "they are apart");
        // The other's corner is 1.118 m from its middle at 26.6°: turned by that it points at us.
        let corner = depth_of(origin, at(2.0, 0.0, 0.0, ops::atan2(0.5, 1.0) + std::f64::consts::PI));
        assert!((corner - (1.0 + 1.25_f64.sqrt() - 2.0)).abs() < 1e-9, "{corner}");
    }

    #[test]
    fn round_things_are_round() {
        let at = |x, y| (ROUND, [x, y, 0.0, 0.0]);
        assert!((depth_of(at(0.0, 0.0), at(0.6, 0.0)) - 0.4).abs() < 1e-12);
        assert!(depth_of(at(0.0, 0.0), at(0.8, 0.8)) < 0.0, "their boxes meet, and they do not");
        let house = (BOX, [0.0, 0.0, 0.0, 0.0]);
        assert!((depth_of(house, at(1.3, 0.0)) - 0.2).abs() < 1e-12, "from beside");
        assert!(depth_of(house, at(1.4, 0.9)) < 0.0, "past the corner");
        assert!(
            (depth_of(house, at(0.0, 0.1)) - 0.9).abs() < 1e-12,
            "from within: 0.4 to the side and its radius"
        );
    }
}
