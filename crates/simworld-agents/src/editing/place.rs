//! The placement solver: draws places from the region of a relation, throws out what collides, blocks or stands where it
//! may not, and takes the best of what is left. It can say what became of every place that it tried.

use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2, Point3, yaw_of};
use simworld_core::ground::Ground;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Relation, Scene, Shape};
use simworld_core::seed::{Stream, StreamRng};

use super::check::{SUPPORT_GAP, finds_footing};
use super::edit::Stand;
use super::land::{LandFit, Streets};
use super::parking::parks;
use super::placing::{Candidate, Outcome, Placing};
use super::rest::{carries, foot_of};
use super::sample::{Item, Sampler, Spot};
use super::solid::Solid;
use super::stand::Subject;
use super::suits::{KERB, Site, named_ground};

/// Places that are tried for a thing at the most.
const TRIES: u32 = 240;
/// So many that fit are enough to choose from, as far as their ground leaves nothing to wish for.
const ENOUGH: u32 = 16;
/// Between things there is a hand's breadth, m.
const HAND: f64 = 0.1;
/// Before a door there is room for a person, m.
const DOORWAY: f64 = 0.8;
/// Where one stands to enter is so far off the wall at the most, m: on the sidewalk before a house.
const FOREGROUND: f64 = 6.0;

/// Finds places in a scene.
pub(super) struct Placer<'a> {
    pub(super) scene: &'a dyn Scene,
    pub(super) streets: Option<&'a Streets>,
    /// From where the scene is looked at.
    pub(super) from: Point2,
    /// Things that are as good as gone: those that are being moved, what stands on them, and what hangs on either.
    pub(super) lifted: &'a [EntityId],
    /// What goes along on top of the thing that is put somewhere, in that thing's frame.
    pub(super) load: &'a [Solid],
}

impl Placer<'_> {
    /// The best place for a thing so that all relations hold; `rank` says which of how many of its kind it is.
    pub(super) fn place(
        &self,
        subject: Subject<'_>,
        rank: (u32, u32),
        stands: &[Stand],
        stream: Stream,
    ) -> Placing {
        let size = subject.info.shape.size();
        let item = Item { kind: subject.kind, half: size.xy() * 0.5, rank };
        let sampler = Sampler { scene: self.scene, streets: self.streets, item, from: self.from };
        let exact = stands.iter().any(|stand| matches!(stand, Stand::At { .. }));
        let least = self.hopes_for(subject.kind, stands);
        // Who names a point means that nothing is turned there.
        let kept = subject.id.and_then(|id| self.scene.entity(id)).filter(|_| exact);
        let kept = kept.map(|thing| yaw_of(thing.pose));
        let mut rng = stream.rng();
        let mut placing = Placing::default();
        let (mut fitting, mut best) = (0, f64::NEG_INFINITY);
        for attempt in 0..if exact { 1 } else { TRIES } {
            let Some(spot) = self.draw(&sampler, stands, attempt, &mut rng) else { continue };
            let spot = Spot { yaw: kept.unwrap_or(spot.yaw), ..spot };
            let solid = self.set_down(subject, stands, &spot);
            let outcome = self.judge(subject, stands, &spot, &solid);
            if let Outcome::Fits { score, fit } = outcome {
                fitting += u32::from(!fit.astray && fit.suits >= least);
                if score > best {
                    best = score;
                    placing.taken = Some(placing.candidates.len());
                }
            }
            placing.candidates.push(Candidate { pose: solid.pose, outcome });
            if fitting >= ENOUGH {
                break;
            }
        }
        placing
    }

    /// The thing at a spot: at its height, or on land that rises and falls on the highest of what is under its corners.
    pub(super) fn set_down(&self, subject: Subject<'_>, stands: &[Stand], spot: &Spot) -> Solid {
        let at = Point3::new(spot.at.x, spot.at.y, spot.base);
        let solid = Solid::standing(subject.info.shape, at, spot.yaw);
        // What stands on a thing, or within it, stands on its boards.
        let is_carried = |stand: &Stand| {
            matches!(stand, Stand::To { relation: Relation::OnTopOf | Relation::Inside, anchor }
                if self.scene.entity(*anchor).is_some_and(|anchor| !is_surface(anchor.kind)))
        };
        match self.scene.ground().filter(|_| !stands.iter().any(is_carried)) {
            Some(land) => {
                let (_, high) = under(land, subject.kind, &solid);
                Solid::standing(subject.info.shape, Point3::new(at.x, at.y, high), spot.yaw)
            }
            None => solid,
        }
    }

    /// How well the ground should suit a thing before it is enough: where streets are near, a vehicle may yet find a kerb.
    fn hopes_for(&self, kind: EntityKind, stands: &[Stand]) -> f64 {
        let Some(streets) = self.streets.filter(|_| parks(kind)) else { return 0.0 };
        let anchors = stands.iter().filter_map(Stand::anchor).filter_map(|anchor| self.scene.entity(anchor));
        let mut points: Vec<Point2> = anchors.map(|anchor| anchor.planar()).collect();
        if points.is_empty() {
            points.push(self.from);
        }
        if points.iter().any(|point| !streets.roads_near(*point).is_empty()) { KERB } else { 0.0 }
    }

    fn draw(
        &self,
        sampler: &Sampler<'_>,
        stands: &[Stand],
        attempt: u32,
        rng: &mut StreamRng,
    ) -> Option<Spot> {
        let parks = parks(sampler.item.kind);
        if stands.is_empty() {
            let spot = sampler.anywhere(rng);
            let parked = if parks && attempt % 2 == 1 { sampler.pulled_over(&spot) } else { None };
            return Some(parked.unwrap_or(spot));
        }
        let (round, rank) = (attempt as usize / stands.len(), attempt as usize % stands.len());
        let stand = &stands[rank];
        // Vehicles are looked for a place at the kerb every other time: in turn near what they are to stand to, and near a place where
        // they would stand so. "Along a street" is beside its carriageway.
        let pulls_over = parks && round % 2 == 1 && !matches!(stand, Stand::AlongRoad { .. });
        let near = stand.anchor().and_then(|anchor| self.scene.entity(anchor)).filter(|_| round % 4 == 1);
        let parked = near.filter(|_| pulls_over).and_then(|near| sampler.parked(near.planar(), rng));
        if let Some(parked) = parked {
            return Some(self.grounded(stand, parked));
        }
        let spot = sampler.draw(stand, rng)?;
        let parked = if pulls_over { sampler.pulled_over(&spot) } else { None };
        Some(self.grounded(stand, parked.unwrap_or(spot)))
    }

    /// What stands beside a thing on a table stands on the ground.
    fn grounded(&self, stand: &Stand, mut spot: Spot) -> Spot {
        // On land that rises and falls the land says how high it is.
        let has_land = self.scene.ground().is_some();
        if has_land || matches!(stand, Stand::To { relation: Relation::OnTopOf, .. }) {
            return spot;
        }
        let foot = stand.anchor().map(|anchor| (anchor, foot_of(self.scene, anchor)));
        let below =
            foot.filter(|(anchor, foot)| anchor != foot).and_then(|(_, foot)| self.scene.entity(foot));
        spot.base = below.map_or(spot.base, |below| below.position().z);
        spot
    }

    pub(super) fn judge(
        &self,
        subject: Subject<'_>,
        stands: &[Stand],
        spot: &Spot,
        solid: &Solid,
    ) -> Outcome {
        let on_top = stands.iter().find_map(|stand| match stand {
            Stand::To { relation: Relation::OnTopOf, anchor } => Some(*anchor),
            _ => None,
        });
        if let Some(anchor) = on_top.and_then(|anchor| self.scene.entity(anchor))
            && !carries(&anchor, solid)
        {
            return Outcome::Unsupported;
        }
        let holds = |stand: &Stand| stand.would_hold(self.scene, self.streets, subject, solid);
        if !stands.iter().all(holds) {
            return Outcome::Elsewhere;
        }
        if let Some(outcome) = self.obstacle(solid, on_top.is_some()) {
            return outcome;
        }
        // Who comes out of a new building finds room before its door.
        let door =
            subject.info.access.filter(|_| subject.kind == EntityKind::Building && subject.id.is_none());
        let step = door.map(|door| doorway(solid, door));
        let on_it = self.load.iter().map(|part| Solid { pose: solid.pose * part.pose, shape: part.shape });
        let mut others = step.into_iter().chain(on_it);
        if let Some(with) = others.find_map(|other| in_the_way(self.scene, &other, self.lifted)) {
            return Outcome::Collides { with };
        }
        // Who names a point, or a thing to stand on, means it.
        let exact = on_top.is_some() || stands.iter().any(|stand| matches!(stand, Stand::At { .. }));
        let fit = if exact { Ok(LandFit::ASKED) } else { self.suits(subject.kind, stands, solid) };
        let carried = || land_carries(self.scene, subject.kind, solid, on_top.is_some());
        match fit.and_then(|fit| carried().map(|()| fit)) {
            Ok(fit) => Outcome::fits(spot.odd, fit),
            Err(why) => Outcome::Land { why },
        }
    }

    /// How well the ground suits a thing, or why it may not stand there.
    fn suits(&self, kind: EntityKind, stands: &[Stand], solid: &Solid) -> Result<LandFit, &'static str> {
        let asked = named_ground(stands);
        let site = Site { scene: self.scene, streets: self.streets, gone: self.lifted, asked: &asked };
        site.suits(kind, solid)
    }

    /// What is in the way, or whose door.
    fn obstacle(&self, solid: &Solid, on_top: bool) -> Option<Outcome> {
        let room = if on_top { *solid } else { solid.inflated(HAND) };
        if let Some(with) = in_the_way(self.scene, &room, self.lifted) {
            return Some(Outcome::Collides { with });
        }
        let doors = if on_top { Vec::new() } else { doors_before(self.scene, solid, self.lifted) };
        doors.first().map(|door| Outcome::Blocks { door: *door })
    }
}

/// The room before a door, of a thing that stands there with its door so in its own frame.
pub(super) fn doorway(solid: &Solid, door: Point3) -> Solid {
    let size = 2.0 * DOORWAY;
    Solid::standing(Shape::cuboid(size, size, size), solid.pose * door, solid.yaw())
}

/// The buildings before whose doors a solid would stand.
pub(super) fn doors_before(scene: &dyn Scene, solid: &Solid, besides: &[EntityId]) -> Vec<EntityId> {
    let bounds = solid.inflated(HAND).bounds().inflated(DOORWAY + FOREGROUND);
    let region = Aabb { min: Point3::new(bounds.min.x, bounds.min.y, solid.base()), ..bounds };
    let mut blocked = Vec::new();
    let _ = scene.visit(&region, &mut |other| {
        let counts = other.kind == EntityKind::Building && !besides.contains(&other.id);
        let access = other.access_point().filter(|_| counts);
        if access.is_some_and(|door| solid.distance_to(door.xy()) < DOORWAY) {
            blocked.push(other.id);
        }
        ControlFlow::Continue(())
    });
    blocked
}

/// The first thing that shares space with a solid, flat ground apart.
pub(super) fn in_the_way(scene: &dyn Scene, solid: &Solid, besides: &[EntityId]) -> Option<EntityId> {
    let mut found = None;
    let _ = scene.visit(&solid.bounds(), &mut |other| {
        let counts = !is_surface(other.kind) && !besides.contains(&other.id);
        if counts && solid.overlaps(&Solid::of(&other)) {
            found = Some(other.id);
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    });
    found
}

/// Whether it is flat ground, on which all else stands.
pub(crate) const fn is_surface(kind: EntityKind) -> bool {
    matches!(kind, EntityKind::Ground | EntityKind::Road | EntityKind::Sidewalk | EntityKind::Crosswalk)
}

/// Nothing is set down where it is steeper, rise over run: dry wood on grass slides from 0.35 on.
const STANDS_ON: f64 = 0.35;

/// The least and the greatest height of the land that a thing stands on, m.
pub(super) fn under(land: &Ground, kind: EntityKind, solid: &Solid) -> (f64, f64) {
    let middle = land.height(solid.planar());
    if finds_footing(kind) {
        return (middle, middle);
    }
    let heights = solid.corners().map(|corner| land.height(corner));
    heights.into_iter().fold((middle, middle), |(low, high), at| (low.min(at), high.max(at)))
}

/// The least and the greatest height of the land under a thing that stands upright at a point of the plane, turned so, radians from
/// east; m. What stands on legs, on roots or on foundations is looked at under its middle alone.
#[cfg(feature = "scene-files")]
pub(crate) fn land_under(land: &Ground, kind: EntityKind, shape: Shape, at: Point2, yaw: f64) -> (f64, f64) {
    under(land, kind, &Solid::standing(shape, Point3::new(at.x, at.y, 0.0), yaw))
}

/// Whether the land carries a thing: dry, not too steep, and under all of it.
pub(super) fn land_carries(
    scene: &dyn Scene,
    kind: EntityKind,
    solid: &Solid,
    on_top: bool,
) -> Result<(), &'static str> {
    let Some(land) = scene.ground().filter(|_| !on_top) else { return Ok(()) };
    let corners = solid.corners();
    let (low, high) = under(land, kind, solid);
    let is_steep = |at: &Point2| land.slope(*at) > STANDS_ON;
    match () {
        () if !corners.iter().all(|corner| land.holds(*corner)) => Err("the land ends there"),
        () if corners.iter().any(|corner| land.is_wet(*corner)) => Err("water is there"),
        () if corners.iter().chain([&solid.planar()]).any(is_steep) => Err("the land is too steep there"),
        () if high - low > SUPPORT_GAP => Err("the land is too steep there"),
        () if solid.base() - low > SUPPORT_GAP => Err("it would hang in the air there"),
        () if high - solid.base() > SUPPORT_GAP => Err("it would be sunk into the land there"),
        () => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use simworld_core::geometry::{Pose, pose_facing};
    use simworld_core::ground::{Cover, GroundData};
    use simworld_core::scene::{EntityDesc, World};
    use simworld_core::seed::Seed;

    use super::super::check::faults;
    use super::*;

    /// Land that rises to the north by so much a metre; south of the origin it is under water.
    fn bank(rise: f64) -> World {
        let heights = (0..11 * 11).map(|index| (f64::from(index / 11) * 10.0 - 50.0) * rise);
        let ground = Ground::new(GroundData {
            origin: Point2::new(-50.0, -50.0),
            spacing: 10.0,
            columns: 11,
            rows: 11,
            heights: heights.map(|height| height as f32).collect(),
            covers: vec![Cover::Grass; 11 * 11],
            water: Some(0.0),
        });
        let mut world = World::new();
        world.set_ground(Arc::new(ground.expect("a plane is sound")));
        world
    }

    fn bench() -> EntityDesc {
        EntityDesc::new(EntityKind::Bench, Pose::identity(), Shape::cuboid(0.6, 1.8, 0.85))
    }

    fn placed(world: &World, desc: &EntityDesc, stand: Stand) -> Placing {
        let placer = Placer { scene: world, streets: None, from: Point2::origin(), lifted: &[], load: &[] };
        let subject = Subject { id: None, kind: desc.kind, info: &desc.info };
        placer.place(subject, (0, 1), &[stand], Seed(1).stream("tests/place"))
    }

    /// What became of a thing at a point of the land.
    fn at(rise: f64, desc: &EntityDesc, x: f64, y: f64) -> Outcome {
        let placing = placed(&bank(rise), desc, Stand::At { point: Point2::new(x, y) });
        placing.candidates[0].outcome.clone()
    }

    #[test]
    fn a_bench_stands_on_the_higher_of_its_ends_where_the_lower_is_a_hand_off_it_is_too_steep() {
        // Its ends are 1.8 m apart: 3.6 cm of rise are borne, 9 cm and 54 cm are not, however gentle the slope looks.
        let mut world = bank(0.02);
        let placing = placed(&world, &bench(), Stand::At { point: Point2::new(3.0, 20.0) });
        let pose = placing.pose().expect("it is level enough");
        assert!((pose.translation.z - 0.02 * 20.9).abs() < 1e-4, "{pose}");
        let thing = world.spawn(EntityDesc { pose, ..bench() }).expect("a bench");
        assert_eq!(faults(&world, thing), []);
        for rise in [0.05, 0.3, 0.4] {
            let outcome = at(rise, &bench(), 3.0, 20.0);
            assert_eq!(outcome, Outcome::Land { why: "the land is too steep there" }, "{rise}");
        }
    }

    #[test]
    fn a_tree_grows_where_no_bench_stands_but_not_on_a_cliff() {
        let tree = EntityDesc::new(EntityKind::Tree, Pose::identity(), Shape::cuboid(0.6, 0.6, 8.0));
        assert!(matches!(at(0.3, &tree, 3.0, 20.0), Outcome::Fits { .. }));
        assert_eq!(at(0.4, &tree, 3.0, 20.0), Outcome::Land { why: "the land is too steep there" });
    }

    #[test]
    fn nothing_stands_in_the_water_nor_beyond_the_land() {
        for y in [-20.0, 0.5] {
            assert_eq!(at(0.02, &bench(), 3.0, y), Outcome::Land { why: "water is there" }, "{y}");
        }
        assert_eq!(at(0.02, &bench(), 3.0, 49.5), Outcome::Land { why: "the land ends there" });
    }

    #[test]
    fn what_is_put_beside_a_thing_on_a_slope_stands_on_the_land_and_not_as_high_as_that() {
        let mut world = bank(0.02);
        let foot = Point3::new(0.0, 20.0, 0.4);
        let hut =
            EntityDesc::new(EntityKind::Building, pose_facing(foot, 0.0), Shape::cuboid(12.0, 12.0, 4.0));
        let hut = world.spawn(hut).expect("a hut");
        for relation in [Relation::Behind, Relation::LeftOf, Relation::RightOf, Relation::Near] {
            let placing = placed(&world, &bench(), Stand::To { relation, anchor: hut });
            let pose = placing.pose().expect("there is room around the hut");
            let thing = world.spawn(EntityDesc { pose, ..bench() }).expect("a bench");
            assert_eq!(faults(&world, thing), [], "{relation:?}");
            world.remove(thing).expect("it is there");
        }
    }
}
