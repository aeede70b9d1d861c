//! Things stand to each other as their footprints do, turned as they are, and not as the boxes around them.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

use proptest::prelude::*;
use simworld_core::geometry::{Point2, Point3, direction, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Relation, Scene, Shape, World};

/// So many points stand for a side of an outline.
const STEPS: u32 = 40;

/// Where it stands, which way it looks, and how long, wide and high it is.
#[derive(Clone, Copy, Debug)]
struct Told {
    x: f64,
    y: f64,
    z: f64,
    yaw: f64,
    size: [f64; 3],
}

impl Told {
    fn spawn(self, world: &mut World, kind: EntityKind) -> EntityId {
        let [length, width, height] = self.size;
        let pose = pose_facing(Point3::new(self.x, self.y, self.z), self.yaw);
        world.spawn(EntityDesc::new(kind, pose, Shape::cuboid(length, width, height))).unwrap()
    }

    /// The same, with the whole scene turned about the origin and moved to the east.
    fn turned(self, angle: f64, east: f64) -> Self {
        let at = direction(angle) * self.x + direction(angle + FRAC_PI_2) * self.y;
        Self { x: at.x + east, y: at.y, yaw: self.yaw + angle, ..self }
    }

    /// Points all along the outline, and how far one is from the next at the most, m.
    fn outline(self) -> (Vec<Point2>, f64) {
        let (long, wide) = (self.size[0] * 0.5, self.size[1] * 0.5);
        let place = |forward: f64, left: f64| {
            let off = direction(self.yaw) * forward + direction(self.yaw + FRAC_PI_2) * left;
            Point2::new(self.x, self.y) + off
        };
        let shares = (0..=STEPS).map(|step| f64::from(step) / f64::from(STEPS) * 2.0 - 1.0);
        let sides = shares.flat_map(|share| {
            let (forward, left) = (long * share, wide * share);
            [place(forward, wide), place(forward, -wide), place(long, left), place(-long, left)]
        });
        (sides.collect(), 2.0 * long.max(wide) / f64::from(STEPS))
    }
}

/// A house of 8 m, and something of 2 m beside it, in it or on its roof.
fn any_pair() -> impl Strategy<Value = (Told, Told)> {
    let house = (-5.0..5.0_f64, -5.0..5.0_f64, 0.0..TAU, 2.0..50.0_f64, 2.0..20.0_f64);
    let thing = (-60.0..60.0_f64, -60.0..60.0_f64, 0.0..TAU, 0.2..9.0_f64, 0.2..3.0_f64);
    // Some are near enough to be in the house.
    let height = (prop::sample::select(vec![0.0, 8.0]), prop::sample::select(vec![1.0, 0.1]));
    (house, thing, height).prop_map(|(house, thing, (z, near))| {
        let (x, y, yaw, length, width) = house;
        let house = Told { x, y, z: 0.0, yaw, size: [length, width, 8.0] };
        let (x, y, yaw, length, width) = thing;
        (house, Told { x: x * near, y: y * near, z, yaw, size: [length, width, 2.0] })
    })
}

/// Which relations the thing stands in to the other, which is of that kind.
fn held(thing: Told, other: Told, kind: EntityKind) -> Vec<Relation> {
    let mut world = World::new();
    let (thing, other) = (thing.spawn(&mut world, EntityKind::Prop), other.spawn(&mut world, kind));
    let (thing, other) = (world.entity(thing).unwrap(), world.entity(other).unwrap());
    Relation::ALL.iter().copied().filter(|relation| relation.holds(&thing, &other)).collect()
}

proptest! {
    #[test]
    fn the_whole_may_be_turned_and_nothing_stands_otherwise(
        (house, thing) in any_pair(), angle in 0.0..TAU, east in -500.0..500.0_f64,
    ) {
        // Nothing of a relation is told by the east and the north: not for a house, and not for a park.
        for kind in [EntityKind::Building, EntityKind::Ground] {
            let turned = held(thing.turned(angle, east), house.turned(angle, east), kind);
            prop_assert_eq!(held(thing, house, kind), turned);
        }
    }

    #[test]
    fn what_is_near_and_what_is_next_to_is_told_by_the_outlines((house, thing) in any_pair()) {
        let ((walls, step), (edges, step_there)) = (house.outline(), thing.outline());
        let gap = walls.iter().flat_map(|a| edges.iter().map(move |b| (a - b).norm())).fold(f64::INFINITY, f64::min);
        // The nearest point of each outline is at most half a step from one of those.
        let least = gap - (step + step_there) * 0.5;
        let widest = house.size[0].max(house.size[1]).max(thing.size[0]).max(thing.size[1]);
        let held = held(thing, house, EntityKind::Building);
        for (relation, most) in [(Relation::Near, 30.0), (Relation::NextTo, (widest * 0.25).clamp(2.0, 10.0))] {
            prop_assert!(gap > most || held.contains(&relation), "{:?} at {} m", relation, gap);
            // What stands within the outline is at no distance, however far its edges are.
            let is_within = held.contains(&Relation::OnTopOf) || held.contains(&Relation::Inside);
            prop_assert!(least <= most || is_within || !held.contains(&relation), "{:?} at {} m", relation, least);
        }
        prop_assert_eq!(held.contains(&Relation::FarFrom), !held.contains(&Relation::Near));
    }
}

/// A house of 60 m by 10 m, which looks to the south-east.
const HOUSE: Told = Told { x: 0.0, y: 0.0, z: 0.0, yaw: -FRAC_PI_4, size: [60.0, 10.0, 8.0] };

/// A crate of 1 m so far from the middle of its long wall to the north-east.
fn crate_off(gap: f64) -> Told {
    let at = direction(FRAC_PI_4) * (5.0 + gap + 0.5);
    Told { x: at.x, y: at.y, z: 0.0, yaw: FRAC_PI_4, size: [1.0; 3] }
}

#[test]
fn beside_a_long_house_that_is_turned_by_45_degrees_only_what_is_at_its_wall_is_next_to_it() {
    let is_next = |thing: Told| held(thing, HOUSE, EntityKind::Building).contains(&Relation::NextTo);
    assert!(is_next(crate_off(0.5)) && is_next(crate_off(9.9)));
    assert!(
        !is_next(crate_off(10.1)) && !is_next(crate_off(14.0)),
        "that is in the box around the house, and not beside it"
    );
    let near = held(crate_off(14.0), HOUSE, EntityKind::Building);
    assert_eq!(near, [Relation::Near, Relation::LeftOf]);
    assert_eq!(held(crate_off(31.0), HOUSE, EntityKind::Building), [Relation::FarFrom]);
}

#[test]
fn in_a_house_that_is_turned_is_what_its_walls_are_around() {
    let inside = |x: f64, y: f64, kind| {
        let thing = Told { x, y, ..crate_off(0.0) };
        held(thing, HOUSE, kind).contains(&Relation::Inside)
    };
    for kind in [EntityKind::Building, EntityKind::Ground] {
        assert!(inside(0.0, 0.0, kind) && inside(19.0, -19.0, kind), "from end to end");
        assert!(!inside(4.0, 4.0, kind) && !inside(15.0, 0.0, kind), "in the box around it alone");
    }
    // What is as large as the house fills it, however the two are turned.
    for step in 0..16 {
        let house = HOUSE.turned(f64::from(step) * 0.4, 7.0);
        assert!(held(house, house, EntityKind::Building).contains(&Relation::Inside), "{house:?}");
    }
}

#[test]
fn on_a_roof_that_is_turned_is_what_stands_over_it() {
    let on_top = |gap: f64| {
        let thing = Told { z: 8.0, ..crate_off(gap) };
        held(thing, HOUSE, EntityKind::Building).contains(&Relation::OnTopOf)
    };
    assert!(on_top(-5.0) && on_top(-0.5));
    assert!(!on_top(0.5), "it hangs in the air beside the roof, over the box around it");
}
