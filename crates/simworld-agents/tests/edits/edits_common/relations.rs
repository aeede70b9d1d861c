//! The judge of the relations: by footprints, heights and streets alone, as the definitions read. Nothing here asks the editor, so
//! that a test of a relation which is wrong there is found out here.

use simworld_core::geometry::{Point2, Vector2, direction, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::ops::{atan2, wrap_angle};
use simworld_core::scene::{EntityKind, Scene, World};

use super::{Judge, place_of};

/// A gap up to which things are near, and beyond which they are far, m.
const NEAR: f64 = 30.0;
/// A gap up to which things are next to each other, m, or this share of the length of the longer one.
const BESIDE: f64 = 2.0;
const SHARE: f64 = 0.25;
/// As far as "north of" and "across from" reach, and as near as what is across stands where there is no street, m.
const FAR_SIDE: f64 = 60.0;
const OPPOSITE: f64 = 5.0;
/// As far as "along" a long side, and as "at" a corner, m.
const ALONG: f64 = 4.0;
const CORNER: f64 = 3.0;
/// What stands on something is at most so far from its top, m.
const SUPPORT: f64 = 0.05;
/// "Here" is so far from the viewer, m: 25 m, and half of what stands there.
const HERE: f64 = 27.0;
/// Lengths that differ by less are the same, m.
const HAIR: f64 = 1e-6;

/// How much of the ground a thing takes, and from where to where it reaches in height.
pub(super) struct Footprint {
    middle: Point2,
    /// The way it looks.
    ahead: Vector2,
    /// Half its length and width, m.
    half: Vector2,
    low: f64,
    high: f64,
    /// Whether it is ground, on which things stand rather than in it.
    is_flat: bool,
}

impl Footprint {
    pub(super) fn of(world: &World, thing: EntityId) -> Option<Self> {
        let entity = world.entity(thing)?;
        let (size, position) = (entity.info.shape.size(), entity.position());
        let is_flat = matches!(
            entity.kind,
            EntityKind::Ground | EntityKind::Road | EntityKind::Sidewalk | EntityKind::Crosswalk
        );
        Some(Self {
            middle: Point2::new(position.x, position.y),
            ahead: direction(yaw_of(entity.pose)),
            half: Vector2::new(size.x, size.y) * 0.5,
            low: position.z,
            high: position.z + size.z,
            is_flat,
        })
    }

    fn corners(&self) -> [Point2; 4] {
        let (long, wide) = (self.ahead * self.half.x, to_the_left(self.ahead) * self.half.y);
        [long + wide, wide - long, -long - wide, long - wide].map(|off| self.middle + off)
    }

    fn edges(&self) -> [(Point2, Point2); 4] {
        let [a, b, c, d] = self.corners();
        [(a, b), (b, c), (c, d), (d, a)]
    }

    /// How far ahead of the middle a point is, and how far to the left of it, m.
    fn seen_from(&self, point: Point2) -> (f64, f64) {
        let way = point - self.middle;
        (way.dot(&self.ahead), way.dot(&to_the_left(self.ahead)))
    }

    /// From the middle to the edge in a direction, m.
    pub(super) fn reach(&self, way: Vector2) -> f64 {
        let (ahead, left) = (way.dot(&self.ahead), way.dot(&to_the_left(self.ahead)));
        (self.half.x / ahead.abs()).min(self.half.y / left.abs())
    }

    /// How far from the nearest side a point within is, m; below zero outside.
    pub(super) fn depth(&self, point: Point2) -> f64 {
        let (ahead, left) = self.seen_from(point);
        (self.half.x - ahead.abs()).min(self.half.y - left.abs())
    }

    fn covers(&self, point: Point2) -> bool {
        let (ahead, left) = self.seen_from(point);
        ahead.abs() <= self.half.x + HAIR && left.abs() <= self.half.y + HAIR
    }

    /// From the footprint to a point, m; zero within.
    fn distance_to(&self, point: Point2) -> f64 {
        if self.covers(point) {
            return 0.0;
        }
        self.edges().into_iter().map(|edge| off_piece(point, edge)).fold(f64::INFINITY, f64::min)
    }

    /// Between two footprints, m; zero where they meet. Of two convex outlines that are apart, a corner of one is nearest.
    pub(super) fn gap(&self, other: &Self) -> f64 {
        let meets = |edge: &(Point2, Point2)| other.edges().into_iter().any(|piece| crosses(*edge, piece));
        if self.edges().iter().any(meets) {
            return 0.0;
        }
        let nearest = |one: &Self, other: &Self| {
            one.corners().map(|corner| other.distance_to(corner)).into_iter().fold(f64::INFINITY, f64::min)
        };
        nearest(self, other).min(nearest(other, self))
    }

    fn is_on_top_of(&self, anchor: &Self) -> bool {
        anchor.covers(self.middle) && (self.low - anchor.high).abs() <= SUPPORT
    }

    /// "A gap of at most 2 m, or a quarter of the larger one's width"; what stands on a thing is not next to it.
    fn is_next_to(&self, anchor: &Self) -> bool {
        let widest = 2.0 * self.half.max().max(anchor.half.max());
        let on_it = !anchor.is_flat && self.is_on_top_of(anchor);
        !on_it && self.gap(anchor) <= (widest * SHARE).max(BESIDE) + HAIR
    }

    /// "Within its bounds; of flat ground: with its whole footprint on it."
    fn is_inside(&self, anchor: &Self) -> bool {
        let within = anchor.is_flat || (self.low >= anchor.low - HAIR && self.high <= anchor.high + HAIR);
        within && self.corners().into_iter().all(|corner| anchor.covers(corner))
    }

    /// "Near, in the quarter around its axis": 45° to either side. Where the side is broader than the thing is deep the quarter opens
    /// from the ends of that side, for all of a long façade looks that way.
    fn is_on_side(&self, anchor: &Self, side: Side) -> bool {
        let (ahead, left) = anchor.seen_from(self.middle);
        let (deep, wide) = (anchor.half.x, anchor.half.y);
        let (out, aside, spare) = match side {
            Side::Front => (ahead, left, wide - deep),
            Side::Back => (-ahead, left, wide - deep),
            Side::Left => (left, ahead, deep - wide),
            Side::Right => (-left, ahead, deep - wide),
        };
        out > 0.0 && aside.abs() <= out + spare.max(0.0) + HAIR && self.gap(anchor) <= NEAR + HAIR
    }

    /// "Within 45° of a direction from a thing, at most 60 m from it."
    fn lies(&self, anchor: &Self, degrees: f64) -> bool {
        let way = self.middle - anchor.middle;
        let off = wrap_angle(atan2(way.y, way.x) - degrees.to_radians()).to_degrees();
        off.abs() <= 45.0 + HAIR && self.gap(anchor) <= FAR_SIDE + HAIR
    }

    /// "Between the middles of two things, and not farther beside the line than a third of its length or 2 m."
    fn is_between(&self, one: &Self, other: &Self) -> bool {
        let line = other.middle - one.middle;
        let length = line.norm();
        let (way, off) = (line / length, self.middle - one.middle);
        let (along, aside) = (off.dot(&way), off.dot(&to_the_left(way)).abs());
        along > 0.0 && along < length && aside <= (length / 3.0).max(2.0) + HAIR
    }

    /// "Beside one of its long sides, at most 4 m off"; a square has four of them.
    fn is_along(&self, anchor: &Self) -> bool {
        let (ahead, left) = anchor.seen_from(self.middle);
        let (deep, wide) = (anchor.half.x, anchor.half.y);
        let beside_length = ahead.abs() <= deep + HAIR && left.abs() > wide;
        let beside_width = left.abs() <= wide + HAIR && ahead.abs() > deep;
        let beside = deep >= wide - HAIR && beside_length || wide >= deep - HAIR && beside_width;
        beside && self.gap(anchor) <= ALONG + HAIR
    }

    /// "At most 3 m from a corner of its footprint."
    fn is_at_corner_of(&self, anchor: &Self) -> bool {
        anchor.corners().into_iter().any(|corner| self.distance_to(corner) <= CORNER + HAIR)
    }

    /// "On the other side of the street, at most 60 m from the thing; where no street is within 60 m, 5 to 60 m off in the quarter
    /// before it."
    fn is_across_from(&self, anchor: &Self, streets: &[Vec<Point2>]) -> bool {
        let gap = self.gap(anchor);
        let pieces = || streets.iter().flat_map(|line| line.windows(2)).map(|ends| (ends[0], ends[1]));
        if gap > FAR_SIDE + HAIR {
            return false;
        }
        if pieces().any(|piece| crosses(piece, (anchor.middle, self.middle))) {
            return true;
        }
        let has_street = pieces().any(|piece| off_piece(anchor.middle, piece) <= FAR_SIDE);
        let (ahead, left) = anchor.seen_from(self.middle);
        let spare = (anchor.half.y - anchor.half.x).max(0.0);
        let before = ahead > 0.0 && left.abs() <= ahead + spare + HAIR;
        !has_street && before && gap >= OPPOSITE - HAIR
    }
}

/// A side of a thing as it looks.
#[derive(Clone, Copy)]
enum Side {
    Front,
    Back,
    Left,
    Right,
}

impl Judge<'_> {
    /// Whether a thing stands in all of the relations, which are joined by ` & `.
    pub(super) fn stands(&self, thing: EntityId, place: &str) -> Result<(), String> {
        let all = place.split('&').map(str::trim).filter(|place| !place.is_empty());
        for one in all {
            if !alternatives(one).iter().any(|place| self.stands_so(thing, place)) {
                return Err(format!("{thing} does not stand {one}"));
            }
        }
        Ok(())
    }

    fn stands_so(&self, thing: EntityId, place: &str) -> bool {
        let (relation, told) = place.split_once(' ').unwrap_or((place, ""));
        let keys: Vec<&str> = told.split_whitespace().collect();
        match relation {
            "anywhere" => true,
            "here" => (place_of(self.after, thing) - place_of(self.after, self.city.me)).norm() <= HERE,
            "at" => {
                let numbers: Vec<f64> =
                    told.split(['(', ')', ',', ' ']).filter_map(|text| text.parse().ok()).collect();
                (place_of(self.after, thing) - Point2::new(numbers[0], numbers[1])).norm() < 0.01
            }
            "next_to" | "near" | "far_from" | "in_front_of" | "behind" | "left_of" | "right_of"
            | "on_top_of" | "inside" | "along" | "at_corner_of" | "across_from" | "between" | "north_of"
            | "south_of" | "east_of" | "west_of" => self.stands_to(thing, relation, &keys),
            other => self.stands_on_ground(thing, other, &keys),
        }
    }

    /// Whether a thing stands in a relation to others; never to itself, nor to what is gone.
    fn stands_to(&self, thing: EntityId, relation: &str, keys: &[&str]) -> bool {
        let others: Vec<EntityId> = keys.iter().map(|key| self.id(key)).collect();
        let known = |id: &EntityId| Footprint::of(self.after, *id).filter(|_| *id != thing);
        let Some(others) = others.iter().map(known).collect::<Option<Vec<Footprint>>>() else { return false };
        let Some(own) = Footprint::of(self.after, thing) else { return false };
        let anchor = &others[0];
        match relation {
            "next_to" => own.is_next_to(anchor),
            "near" => own.gap(anchor) <= NEAR + HAIR,
            "far_from" => own.gap(anchor) > NEAR - HAIR,
            "in_front_of" => own.is_on_side(anchor, Side::Front),
            "behind" => own.is_on_side(anchor, Side::Back),
            "left_of" => own.is_on_side(anchor, Side::Left),
            "right_of" => own.is_on_side(anchor, Side::Right),
            "on_top_of" => own.is_on_top_of(anchor),
            "inside" => own.is_inside(anchor),
            "along" => own.is_along(anchor),
            "at_corner_of" => own.is_at_corner_of(anchor),
            "across_from" => own.is_across_from(anchor, &self.streets()),
            "between" => own.is_between(anchor, &others[1]),
            "east_of" => own.lies(anchor, 0.0),
            "north_of" => own.lies(anchor, 90.0),
            "west_of" => own.lies(anchor, 180.0),
            "south_of" => own.lies(anchor, -90.0),
            other => panic!("no relation {other}"),
        }
    }

    /// The middles of all streets.
    fn streets(&self) -> Vec<Vec<Point2>> {
        let roads = self.after.roads().into_iter().flat_map(|network| &network.roads);
        roads.map(|road| road.centerline.clone()).collect()
    }
}

/// `next_to bench_1|bench_2` is next to either.
fn alternatives(place: &str) -> Vec<String> {
    let Some((before, choices)) = place.split_once(' ').filter(|(_, keys)| keys.contains('|')) else {
        return vec![place.to_owned()];
    };
    choices.split('|').map(|key| format!("{before} {}", key.trim())).collect()
}

fn to_the_left(way: Vector2) -> Vector2 {
    Vector2::new(-way.y, way.x)
}

/// From a piece of a line to a point, m.
fn off_piece(point: Point2, (from, to): (Point2, Point2)) -> f64 {
    let step = to - from;
    let share = ((point - from).dot(&step) / step.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (point - (from + step * share)).norm()
}

/// Whether two pieces of lines cross: the ends of each lie on different sides of the other. An end of the first may lie on the second.
fn crosses((a, b): (Point2, Point2), (c, d): (Point2, Point2)) -> bool {
    let side = |from: Point2, to: Point2, point: Point2| to_the_left(to - from).dot(&(point - from));
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) <= 0.0
}

#[test]
fn the_judge_measures_between_walls_and_not_between_boxes_around_them() {
    let house = |x: f64, y: f64, degrees: f64| Footprint {
        middle: Point2::new(x, y),
        ahead: direction(degrees.to_radians()),
        half: Vector2::new(5.0, 3.0),
        low: 0.0,
        high: 8.0,
        is_flat: false,
    };
    let here = house(0.0, 0.0, 0.0);
    assert!((here.gap(&house(0.0, 9.0, 0.0)) - 3.0).abs() < 1e-9);
    assert_eq!(here.gap(&house(4.0, 4.0, 17.0)), 0.0, "they run into each other");
    assert_eq!(here.gap(&house(0.0, 0.0, 90.0)), 0.0, "they stand crosswise");
    assert_eq!(
        here.gap(&Footprint { half: Vector2::new(1.0, 1.0), ..house(0.0, 0.0, 5.0) }),
        0.0,
        "one within"
    );
    // A house turned by 45° shows a corner: its half-diagonal along the line is (5 + 3) / √2.
    let corner = 12.0 - 8.0 / 2f64.sqrt();
    assert!((here.gap(&house(0.0, 12.0, 45.0)) - (corner - 3.0)).abs() < 1e-9);
    // Beside a house of 40 m that is turned by 45°: what stands 14 m from its wall is in the box around it, and not next to it.
    let long = Footprint { half: Vector2::new(20.0, 3.0), ..house(0.0, 0.0, -45.0) };
    let off = |gap: f64| {
        let at = direction(45_f64.to_radians()) * (3.0 + gap + 0.5);
        Footprint { half: Vector2::new(0.5, 0.5), ..house(at.x, at.y, 45.0) }
    };
    assert!((long.gap(&off(14.0)) - 14.0).abs() < 1e-9 && !off(14.0).is_next_to(&long));
    assert!(off(9.0).is_next_to(&long) && off(14.0).is_on_side(&long, Side::Left));
    assert!((long.reach(direction(45_f64.to_radians())) - 3.0).abs() < 1e-9);
    assert!((long.depth(off(-1.0).middle) - 0.5).abs() < 1e-9, "half a metre within its wall");
    assert!(house(20.0, 14.0, 0.0).is_on_side(&here, Side::Front), "within 45° of its axis");
    assert!(!house(14.0, 20.0, 0.0).is_on_side(&here, Side::Front), "beyond them");
    assert!(house(14.0, 20.0, 0.0).is_on_side(&here, Side::Left));
    assert!(house(9.0, 10.0, 0.0).is_on_side(&here, Side::Left) && !house(9.0, 10.0, 0.0).is_along(&here));
    assert!(house(4.0, 8.0, 0.0).is_along(&here) && !house(12.0, 0.0, 0.0).is_along(&here));
    assert!(house(0.0, 8.0, 0.0).is_next_to(&here) && !house(0.0, 9.0, 0.0).is_next_to(&here));
    let street = [vec![Point2::new(-50.0, 20.0), Point2::new(50.0, 20.0)]];
    assert!(house(3.0, 30.0, 0.0).is_across_from(&here, &street));
    assert!(!house(20.0, 0.0, 0.0).is_across_from(&here, &street), "on its own side of the street");
    assert!(house(20.0, 0.0, 0.0).is_across_from(&here, &[]), "before it, where there is no street");
}
