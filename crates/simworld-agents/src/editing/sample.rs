//! Where a thing may be put so that it stands in a relation: places drawn from the region that the relation means.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use simworld_core::geometry::{Point2, Point3, Vector2, direction, heading};
use simworld_core::id::{IntersectionId, RoadId};
use simworld_core::net::polyline;
use simworld_core::ops::sin_cos;
use simworld_core::scene::{EntityKind, Relation, Scene, Shape};
use simworld_core::seed::StreamRng;

use super::edit::Stand;
use super::land::Streets;
use super::rest::foot_of;
use super::solid::Solid;
use super::stand::{AIM, ALONG, EDGE, FAR_SIDE, JUNCTION, NEAR, OPPOSITE};

/// From farther beyond a kerb than this a vehicle is not pulled over to it, nor farther along a street, m.
const PULLS_OVER: f64 = 25.0;

/// A place to try: where the middle of the bottom comes to stand, its height, and which way the thing looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spot {
    pub(super) at: Point2,
    pub(super) base: f64,
    pub(super) yaw: f64,
    /// How far it is from the place that people would think of first, from 0 (that place) to 1.
    pub(super) odd: f64,
}

/// What is to be put somewhere.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    pub(super) kind: EntityKind,
    /// Half its length and width, m.
    pub(super) half: Vector2,
    /// Which of how many it is: rows are filled evenly.
    pub(super) rank: (u32, u32),
}

/// One of the four sides of a thing's footprint.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Front,
    Left,
    Back,
    Right,
}

impl Side {
    const ALL: [Self; 4] = [Self::Front, Self::Left, Self::Back, Self::Right];

    /// Outward direction in the thing's frame, radians from its forward axis.
    const fn outward(self) -> f64 {
        match self {
            Self::Front => 0.0,
            Self::Left => FRAC_PI_2,
            Self::Back => PI,
            Self::Right => -FRAC_PI_2,
        }
    }

    const fn of(relation: Relation) -> Option<Self> {
        match relation {
            Relation::InFrontOf => Some(Self::Front),
            Relation::Behind => Some(Self::Back),
            Relation::LeftOf => Some(Self::Left),
            Relation::RightOf => Some(Self::Right),
            _ => None,
        }
    }
}

/// Draws places for one thing.
pub(super) struct Sampler<'a> {
    pub(super) scene: &'a dyn Scene,
    pub(super) streets: Option<&'a Streets>,
    pub(super) item: Item,
    /// From where the scene is looked at, m: where things go that are to stand just anywhere.
    pub(super) from: Point2,
}

impl Sampler<'_> {
    /// A place in the region of a relation, or none if there is no such region.
    pub(super) fn draw(&self, stand: &Stand, rng: &mut StreamRng) -> Option<Spot> {
        let solid = |id| self.scene.entity(id).map(|entity| Solid::of(&entity));
        match stand {
            Stand::To { relation, anchor } => self.related(*relation, &solid(*anchor)?, rng),
            Stand::Between { one, other } => Some(self.between(&solid(*one)?, &solid(*other)?, rng)),
            Stand::AcrossFrom { anchor } => Some(self.across(&solid(*anchor)?, rng)),
            Stand::Along { anchor } => {
                let anchor = solid(*anchor)?;
                let long = anchor.half().x >= anchor.half().y;
                let sides = if long { [Side::Left, Side::Right] } else { [Side::Front, Side::Back] };
                let side = *rng.choose(&sides)?;
                let gap = rng.uniform(0.2, ALONG * 0.5);
                Some(self.beside(&anchor, side, self.in_row(rng), gap, 0.0))
            }
            Stand::AlongRoad { roads } | Stand::OnSide { roads, .. } => self.roadside(roads, rng),
            Stand::AtCornerOf { anchor } => Some(self.corner(&solid(*anchor)?, rng)),
            Stand::Towards { heading, anchor } => {
                let anchor = solid(*anchor)?;
                let turned = heading + rng.uniform(-0.5, 0.5);
                let reach = anchor.half().norm() + self.item.half.norm();
                let gap = rng.uniform(1.0, 15.0);
                let at = anchor.planar() + direction(turned) * (reach + gap);
                Some(Spot { at, base: anchor.base(), yaw: self.yaw(turned, &anchor), odd: gap / 15.0 })
            }
            Stand::Offset { anchor, heading, distance } => {
                let turned = heading + rng.uniform(-0.9, 0.9) * AIM * rng.unit();
                Some(self.off(&solid(*anchor)?, turned, *distance, rng))
            }
            Stand::Apart { anchor, least, most } => {
                let gap = least + (most - least) * rng.unit();
                Some(self.off(&solid(*anchor)?, rng.uniform(-PI, PI), gap, rng))
            }
            Stand::OnBlockOf { anchor } => {
                let anchor = solid(*anchor)?;
                let far = rng.unit();
                Some(self.off(&anchor, rng.uniform(-PI, PI), 0.5 + far * far * 60.0, rng))
            }
            Stand::InMiddleOf { anchor } => {
                let anchor = solid(*anchor)?;
                let reach = (anchor.half().min() * 0.2).max(2.0) * rng.unit();
                let at = anchor.planar() + direction(rng.uniform(-PI, PI)) * reach;
                Some(Spot { at, base: anchor.base(), yaw: anchor.yaw(), odd: 0.1 * reach })
            }
            Stand::AtEdgeOf { anchor } => {
                let anchor = solid(*anchor)?;
                let side = *rng.choose(&Side::ALL)?;
                let share = rng.uniform(-0.95, 0.95);
                let inward = self.item.half.x.max(self.item.half.y) + rng.uniform(0.0, EDGE * 0.5);
                Some(self.beside(&anchor, side, share, -2.0 * inward, 0.3))
            }
            Stand::AtJunction { junction } => self.at_junction(*junction, rng),
            Stand::At { point } => Some(Spot { at: *point, base: self.level(*point), yaw: 0.0, odd: 0.0 }),
            Stand::Around { point } => Some(self.around(*point, 20.0, rng)),
        }
    }

    /// With a gap between it and a thing, in a direction from the thing's middle.
    fn off(&self, anchor: &Solid, heading: f64, gap: f64, rng: &mut StreamRng) -> Spot {
        let yaw = self.yaw(heading, anchor) + if rng.chance(0.25) { FRAC_PI_2 } else { 0.0 };
        let shape = Shape::cuboid(self.item.half.x * 2.0, self.item.half.y * 2.0, 1.0);
        let at = |reach: f64| anchor.planar() + direction(heading) * reach;
        let (mut near, mut far) = (0.0, gap + anchor.half().norm() + self.item.half.norm() + 1.0);
        // The gap grows with the reach, so that halving finds where it is the one asked for.
        for _ in 0..48 {
            let middle = (near + far) * 0.5;
            let point = at(middle);
            let solid = Solid::standing(shape, Point3::new(point.x, point.y, anchor.base()), yaw);
            *(if anchor.gap(&solid) < gap { &mut near } else { &mut far }) = middle;
        }
        Spot { at: at(far), base: anchor.base(), yaw, odd: (gap / 60.0).min(1.0) }
    }

    /// Beside the corners of a junction, beyond the kerb.
    fn at_junction(&self, junction: IntersectionId, rng: &mut StreamRng) -> Option<Spot> {
        let streets = self.streets?;
        let place = streets.network().intersections.get(junction.index())?;
        let leaves = |road: &RoadId| {
            let (road, count) = (streets.road(*road), streets.road(*road).centerline.len());
            let line = &road.centerline;
            heading(&if road.from == junction {
                line[1] - line[0]
            } else {
                line[count - 2] - line[count - 1]
            })
        };
        let ways: Vec<f64> = place.roads.iter().map(leaves).collect();
        let next = |rank: usize| (ways[(rank + 1) % ways.len()] - ways[rank]).rem_euclid(TAU);
        // A corner is where one street turns into the other, and not the far side of a fork.
        let corners: Vec<usize> = (0..ways.len()).filter(|rank| next(*rank) < PI * 0.9).collect();
        let rank = *rng.choose(&corners)?;
        let way = ways[rank] + next(rank) * rng.uniform(0.3, 0.7);
        let reach = rng.uniform(5.0, JUNCTION);
        let at = place.center + direction(way) * reach;
        Some(Spot { at, base: place.height, yaw: way + PI, odd: reach / JUNCTION })
    }

    /// A place near the viewpoint.
    pub(super) fn anywhere(&self, rng: &mut StreamRng) -> Spot {
        self.around(self.from, 40.0, rng)
    }

    fn around(&self, point: Point2, reach: f64, rng: &mut StreamRng) -> Spot {
        let (way, share) = (rng.uniform(-PI, PI), rng.unit());
        let at = point + direction(way) * (2.0 + (reach - 2.0) * share);
        Spot { at, base: self.level(at), yaw: way, odd: share }
    }

    fn related(&self, relation: Relation, anchor: &Solid, rng: &mut StreamRng) -> Option<Spot> {
        match relation {
            Relation::NextTo => {
                let widest = |half: Vector2| half.max() * 2.0;
                let reach = (widest(anchor.half()).max(widest(self.item.half)) * 0.25).clamp(2.0, 10.0);
                self.any_side(anchor, 0.15, reach * 0.9, rng)
            }
            Relation::Near => self.any_side(anchor, 0.5, NEAR * 0.5, rng),
            Relation::FarFrom => self.any_side(anchor, NEAR + 5.0, NEAR * 3.0, rng),
            Relation::OnTopOf => {
                let room = anchor.half() - self.item.half.min() * Vector2::new(1.0, 1.0);
                let room = Vector2::new(room.x.max(0.0), room.y.max(0.0));
                let local = Point2::new(rng.uniform(-room.x, room.x), rng.uniform(-room.y, room.y));
                let odd = local.coords.norm() / room.norm().max(1e-9);
                let yaw = anchor.yaw() + if rng.chance(0.5) { FRAC_PI_2 } else { 0.0 };
                Some(Spot { at: anchor.world(local), base: anchor.top(), yaw, odd: odd.min(1.0) })
            }
            Relation::Inside => {
                let room = anchor.half();
                let local = Point2::new(rng.uniform(-room.x, room.x), rng.uniform(-room.y, room.y));
                Some(Spot { at: anchor.world(local), base: anchor.base(), yaw: anchor.yaw(), odd: 0.5 })
            }
            _ => {
                let side = Side::of(relation)?;
                // Nearer places are likelier, and reach beyond a sidewalk and a street.
                let far = rng.unit();
                let gap = 0.4 + far * far * (NEAR - 3.0);
                Some(self.beside(anchor, side, rng.uniform(-0.95, 0.95), gap, far))
            }
        }
    }

    fn any_side(&self, anchor: &Solid, least: f64, most: f64, rng: &mut StreamRng) -> Option<Spot> {
        let half = anchor.half();
        // Long sides have more places.
        let side = Side::ALL[rng.weighted(&[half.y, half.x, half.y, half.x])?];
        let share = rng.unit();
        Some(self.beside(anchor, side, rng.uniform(-1.0, 1.0), least + (most - least) * share, share))
    }

    /// So far off a side, at a share of that side's half from its middle.
    fn beside(&self, anchor: &Solid, side: Side, share: f64, gap: f64, odd: f64) -> Spot {
        let outward = side.outward();
        let yaw = self.yaw(anchor.yaw() + outward, anchor);
        let extent = self.extent(yaw - anchor.yaw() - outward);
        let (deep, wide) = match side {
            Side::Front | Side::Back => (anchor.half().x, anchor.half().y),
            Side::Left | Side::Right => (anchor.half().y, anchor.half().x),
        };
        let step = direction(outward);
        let local = step * (deep + gap + extent.x) + Vector2::new(-step.y, step.x) * (wide * share);
        let odd = (odd + share.abs() * 0.3).min(1.0);
        Spot { at: anchor.world(Point2::from(local)), base: anchor.base(), yaw, odd }
    }

    /// Half the room that the thing takes along and across a direction from which it is turned by an angle, m.
    fn extent(&self, turned: f64) -> Vector2 {
        let (sin, cos) = sin_cos(turned);
        let (half, sin, cos) = (self.item.half, sin.abs(), cos.abs());
        Vector2::new(cos * half.x + sin * half.y, sin * half.x + cos * half.y)
    }

    /// Which way a thing looks that stands on the side of an anchor to which `outward` leads.
    pub(super) fn yaw(&self, outward: f64, anchor: &Solid) -> f64 {
        let large = anchor.half().norm() > 3.0;
        match self.item.kind {
            // Vehicles stand along walls, and so do doors' guards; people and dogs look at what they stand at.
            kind if kind.is_vehicle() => outward + FRAC_PI_2,
            EntityKind::Person | EntityKind::Dog | EntityKind::Robot => outward + PI,
            // One sits with the back to a house, and turned to a table.
            kind if kind.is_seat() && !large => outward + PI,
            _ => outward,
        }
    }

    /// The share of a row where this one of several stands; a single one anywhere.
    fn in_row(&self, rng: &mut StreamRng) -> f64 {
        match self.item.rank {
            (_, 0 | 1) => rng.uniform(-0.95, 0.95),
            (rank, of) => {
                (2.0 * (f64::from(rank) + 0.5) / f64::from(of) - 1.0) * 0.98 + rng.uniform(-0.02, 0.02)
            }
        }
    }

    fn between(&self, one: &Solid, other: &Solid, rng: &mut StreamRng) -> Spot {
        let along = other.planar() - one.planar();
        let length = along.norm().max(1e-6);
        let way = along / length;
        let share = match self.item.rank {
            (_, 0 | 1) => 0.5 + rng.uniform(-0.4, 0.4),
            (rank, of) => (f64::from(rank) + 1.0) / (f64::from(of) + 1.0) + rng.uniform(-0.03, 0.03),
        };
        let room = (length / 3.0).max(2.0) * 0.9;
        let unit = rng.unit();
        let aside = unit * unit * room * if rng.chance(0.5) { 1.0 } else { -1.0 };
        let at = one.planar() + along * share + Vector2::new(-way.y, way.x) * aside;
        let odd = ((share - 0.5).abs() + aside.abs() / room).min(1.0);
        Spot { at, base: one.base(), yaw: heading(&way) + FRAC_PI_2, odd }
    }

    fn corner(&self, anchor: &Solid, rng: &mut StreamRng) -> Spot {
        let half = anchor.half();
        let (sx, sy) =
            *rng.choose(&[(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]).unwrap_or(&(1.0, 1.0));
        let (gap, turn) = (rng.uniform(0.2, 1.8), rng.uniform(-0.6, 0.6));
        let out = heading(&Vector2::new(sx, sy)) + turn;
        let reach = self.item.half.norm() + gap;
        let local = Point2::new(half.x * sx, half.y * sy) + direction(out) * reach;
        Spot {
            at: anchor.world(local),
            base: anchor.base(),
            yaw: self.yaw(anchor.yaw() + out, anchor),
            odd: gap / 2.0,
        }
    }

    /// On the other side of the nearest street, or in front where there is none.
    fn across(&self, anchor: &Solid, rng: &mut StreamRng) -> Spot {
        let near = self.streets.and_then(|streets| {
            let roads = streets.roads_near(anchor.planar()).into_iter();
            let ranked = roads.filter_map(|id| {
                let near = polyline::closest(&streets.road(id).centerline, &anchor.planar())?;
                Some((near.distance, id, near))
            });
            let best = ranked.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
            Some((streets.road(best.1), best.2))
        });
        let Some((road, near)) = near else {
            let gap = OPPOSITE + rng.unit() * (FAR_SIDE * 0.5);
            return self.beside(anchor, Side::Front, rng.uniform(-0.9, 0.9), gap, gap / FAR_SIDE);
        };
        let length = polyline::length(&road.centerline);
        let station = (near.station + rng.uniform(-12.0, 12.0)).clamp(0.0, length);
        let (foot, along) = polyline::at(&road.centerline, station);
        let side = if near.lateral > 0.0 { -1.0 } else { 1.0 };
        let kerb = if side > 0.0 { road.left_kerb } else { road.right_kerb };
        let off = rng.uniform(-2.0, 12.0);
        let at = foot + direction(along + FRAC_PI_2) * (side * (kerb + off));
        // It looks across the street.
        let yaw = if self.item.kind.is_vehicle() { along } else { along - FRAC_PI_2 * side };
        Spot { at, base: self.level(at), yaw, odd: (off.abs() / 12.0).min(1.0) }
    }

    /// On the edge of a street: vehicles where one parks, all else beyond the kerb.
    fn roadside(&self, roads: &[RoadId], rng: &mut StreamRng) -> Option<Spot> {
        let streets = self.streets?;
        let lengths: Vec<f64> =
            roads.iter().map(|road| polyline::length(&streets.road(*road).centerline)).collect();
        let whole: f64 = lengths.iter().sum();
        let share = match self.item.rank {
            (_, 0 | 1) => rng.unit(),
            (rank, of) => (f64::from(rank) + 0.5 + rng.uniform(-0.15, 0.15)) / f64::from(of),
        };
        let mut station = share * whole;
        let mut index = 0;
        while index + 1 < lengths.len() && station > lengths[index] {
            station -= lengths[index];
            index += 1;
        }
        let road = streets.road(*roads.get(index)?);
        let left = if self.item.rank.1 > 1 { rng.chance(0.3) } else { rng.chance(0.5) };
        let kerb = if left { road.left_kerb } else { road.right_kerb };
        let off = rng.uniform(0.3, 4.5);
        Some(self.on_edge(road, station, left, kerb + off, off / 6.0))
    }

    pub(super) fn on_edge(
        &self,
        road: &simworld_core::net::Road,
        station: f64,
        left: bool,
        offset: f64,
        odd: f64,
    ) -> Spot {
        let (foot, along) = polyline::at(&road.centerline, station);
        let side = if left { 1.0 } else { -1.0 };
        let at = foot + direction(along + FRAC_PI_2) * (side * offset);
        let yaw = if self.item.kind.is_vehicle() {
            // Traffic keeps right: on the left side one looks against the line.
            if left { along + PI } else { along }
        } else {
            along - FRAC_PI_2 * side
        };
        Spot { at, base: self.level(at), yaw, odd }
    }

    /// Where vehicles may be parked near a point: on a strip for it, or at the kerb.
    pub(super) fn parked(&self, near: Point2, rng: &mut StreamRng) -> Option<Spot> {
        let roads = self.streets?.roads_near(near);
        let id = *rng.choose(&roads)?;
        let middle = polyline::closest(&self.streets?.road(id).centerline, &near)?.station;
        let ahead = rng.uniform(-PULLS_OVER, PULLS_OVER);
        self.at_kerb(id, middle + ahead, rng.chance(0.5), ahead.abs() / PULLS_OVER)
    }

    /// The nearest place at a kerb to a spot, or on a strip for parking there.
    pub(super) fn pulled_over(&self, spot: &Spot) -> Option<Spot> {
        let streets = self.streets?;
        let beside = streets.roads_near(spot.at).into_iter().filter_map(|id| {
            let road = streets.road(id);
            let near = polyline::closest(&road.centerline, &spot.at)?;
            // From the middle of the carriageway, which need not be where the line is.
            let off = near.lateral - (road.left_kerb - road.right_kerb) * 0.5;
            Some((off.abs() - road.width * 0.5, id, near.station, off >= 0.0))
        });
        let nearest = beside.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let (_, id, station, left) = nearest.filter(|(beyond, ..)| *beyond <= PULLS_OVER)?;
        self.at_kerb(id, station, left, spot.odd)
    }

    fn at_kerb(&self, id: RoadId, station: f64, left: bool, odd: f64) -> Option<Spot> {
        let streets = self.streets?;
        let length = polyline::length(&streets.road(id).centerline);
        if !(0.0..=length).contains(&station) {
            return None;
        }
        let (at, yaw) = streets.parking_at(id, station, left, self.item.half.y)?;
        Some(Spot { at, base: self.level(at), yaw, odd })
    }

    /// Height of the ground, m: that of the street nearby, or of what stands nearest.
    fn level(&self, at: Point2) -> f64 {
        if let Some(land) = self.scene.ground() {
            return land.height(at);
        }
        let on_road = self.streets.and_then(|streets| {
            let near = |id: RoadId| {
                let near = polyline::closest(&streets.road(id).centerline, &at)?;
                Some((near.distance, streets.network().height(id, near.station)))
            };
            streets.roads_near(at).into_iter().filter_map(near).min_by(|a, b| a.0.total_cmp(&b.0))
        });
        if let Some((_, height)) = on_road {
            return height;
        }
        let grounded = |entity: &simworld_core::scene::EntityRef<'_>| entity.attachment.is_none();
        let near = self.scene.nearest(at, 100.0, &grounded).map(|entity| foot_of(self.scene, entity.id));
        near.and_then(|foot| self.scene.entity(foot)).map_or(0.0, |foot| foot.position().z)
    }
}
