//! A solid that stands somewhere, or may: gaps and overlaps in the plane, exact for upright boxes.

use simworld_core::geometry::{Aabb, Obb, Point2, Point3, Pose, Vector2, pose_facing, yaw_of};
use simworld_core::scene::{EntityRef, Shape};

/// A shape at a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Solid {
    pub(super) pose: Pose,
    pub(super) shape: Shape,
}

impl Solid {
    /// A shape that stands upright on a point, turned so, radians from east.
    pub(super) fn standing(shape: Shape, at: Point3, yaw: f64) -> Self {
        Self { pose: pose_facing(at, yaw), shape }
    }

    pub(super) fn of(entity: &EntityRef<'_>) -> Self {
        Self { pose: *entity.pose, shape: entity.info.shape }
    }

    /// Where it stands, m.
    pub(super) fn planar(&self) -> Point2 {
        Point2::new(self.pose.translation.x, self.pose.translation.y)
    }

    pub(super) fn yaw(&self) -> f64 {
        yaw_of(&self.pose)
    }

    /// Height of its bottom, m.
    pub(super) fn base(&self) -> f64 {
        self.pose.translation.z
    }

    pub(super) fn top(&self) -> f64 {
        self.base() + self.shape.size().z
    }

    pub(super) fn bounds(&self) -> Aabb {
        self.shape.aabb(&self.pose)
    }

    fn obb(&self) -> Obb {
        self.shape.obb(&self.pose)
    }

    /// Half its length and width, m.
    pub(super) fn half(&self) -> Vector2 {
        self.shape.size().xy() * 0.5
    }

    /// A point of the plane in its own frame, m.
    pub(super) fn local(&self, point: Point2) -> Point2 {
        let local = self.pose.inverse_transform_point(&Point3::new(point.x, point.y, self.base()));
        Point2::new(local.x, local.y)
    }

    /// A point of its own frame in the plane, m.
    pub(super) fn world(&self, local: Point2) -> Point2 {
        let world = self.pose * Point3::new(local.x, local.y, 0.0);
        Point2::new(world.x, world.y)
    }

    /// The corners of its footprint, counter-clockwise.
    pub(super) fn corners(&self) -> [Point2; 4] {
        self.obb().footprint()
    }

    /// From its footprint to a point, m; zero inside.
    pub(super) fn distance_to(&self, point: Point2) -> f64 {
        self.shape.planar_distance(&self.pose, &point)
    }

    /// From the edge of its footprint to a point inside or outside, m.
    pub(super) fn edge_distance(&self, point: Point2) -> f64 {
        let (local, half) = (self.local(point), self.half());
        let inside = Vector2::new(half.x - local.x.abs(), half.y - local.y.abs());
        if inside.min() >= 0.0 { inside.min() } else { self.distance_to(point) }
    }

    /// Between two footprints, m; zero where they touch.
    pub(super) fn gap(&self, other: &Self) -> f64 {
        self.obb().rectangle().gap(&other.obb().rectangle())
    }

    /// Whether the two share space, in the plane and in height; a hair of contact is none.
    pub(super) fn overlaps(&self, other: &Self) -> bool {
        const HAIR: f64 = 1e-3;
        self.base() + HAIR < other.top()
            && other.base() + HAIR < self.top()
            && self.obb().footprints_overlap(&other.obb())
    }

    /// Whether it is above or below another, at whatever height: in the plane the two share more than an edge.
    pub(super) fn is_over(&self, other: &Self) -> bool {
        self.obb().footprints_overlap(&other.obb())
    }

    /// Where it goes on a thing that is put from one pose to another.
    pub(super) fn carried(&self, from: &Pose, to: &Pose) -> Self {
        Self { pose: *to * from.inverse() * self.pose, shape: self.shape }
    }

    /// The same so much higher, m.
    pub(super) fn raised(&self, by: f64) -> Self {
        let mut pose = self.pose;
        pose.translation.z += by;
        Self { pose, shape: self.shape }
    }

    /// The same with so much room on every side, m.
    pub(super) fn inflated(&self, room: f64) -> Self {
        let size = self.shape.size();
        let shape = Shape::cuboid(size.x + 2.0 * room, size.y + 2.0 * room, size.z);
        Self { pose: self.pose, shape }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn house(x: f64, y: f64, yaw: f64) -> Solid {
        Solid::standing(Shape::cuboid(10.0, 6.0, 8.0), Point3::new(x, y, 0.0), yaw)
    }

    #[test]
    fn gaps_are_between_walls_and_not_between_boxes_around_them() {
        assert!((house(0.0, 0.0, 0.0).gap(&house(0.0, 9.0, 0.0)) - 3.0).abs() < 1e-12);
        assert_eq!(house(0.0, 0.0, 0.0).gap(&house(4.0, 4.0, 0.3)), 0.0);
        // A house turned by 45° shows a corner: its half-diagonal along the line is (5 + 3) / √2.
        let turned = house(0.0, 12.0, std::f64::consts::FRAC_PI_4);
        let corner = 12.0 - 8.0 / 2f64.sqrt();
        assert!((house(0.0, 0.0, 0.0).gap(&turned) - (corner - 3.0)).abs() < 1e-9);
    }

    #[test]
    fn what_is_carried_keeps_its_place_on_what_carries_it() {
        use std::f64::consts::FRAC_PI_2;
        let from = pose_facing(Point3::new(5.0, 5.0, 0.0), 0.0);
        let to = pose_facing(Point3::new(20.0, 5.0, 1.0), FRAC_PI_2);
        let cup = Solid::standing(Shape::cuboid(0.1, 0.1, 0.1), Point3::new(6.0, 5.0, 0.8), 0.0);
        let there = cup.carried(&from, &to);
        // A metre ahead of the middle, which now is north of it.
        assert!((there.pose.translation.vector - Point3::new(20.0, 6.0, 1.8).coords).norm() < 1e-9);
        assert!((there.yaw() - FRAC_PI_2).abs() < 1e-9);
        assert!((cup.raised(-0.3).base() - 0.5).abs() < 1e-12);
    }

    #[test]
    fn what_stands_on_another_shares_no_space_with_it() {
        let table = house(0.0, 0.0, 0.0);
        let cup = Solid::standing(Shape::cuboid(0.1, 0.1, 0.1), Point3::new(0.0, 0.0, 8.0), 0.0);
        assert!(!cup.overlaps(&table));
        let sunk = Solid { pose: pose_facing(Point3::new(0.0, 0.0, 7.98), 0.0), ..cup };
        assert!(sunk.overlaps(&table));
    }
}
