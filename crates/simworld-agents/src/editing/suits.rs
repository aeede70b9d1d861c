//! How well the ground suits what is to stand on it. Some of it is out of the question, and the rest is better or worse: vehicles are
//! for parking strips and kerbs, trees and shrubs for soil, and furniture for wherever nobody drives.

use simworld_core::geometry::Point2;
use simworld_core::id::{EntityId, RoadId};
use simworld_core::scene::{EntityKind, Relation, Scene};

use super::edit::Stand;
use super::land::{Land, LandFit, Streets};
use super::parking::parks;
use super::solid::Solid;
use super::surfaces::{Surfaces, covered};

/// The edge of a footprint is looked at so often, m: the carriageway of a street is no narrower.
const STEP: f64 = 3.0;
/// Of one side no more points are looked at.
const MOST: f64 = 64.0;
/// Ground that suits less is for something else.
const LEAST: f64 = 0.4;
/// At the kerb of a street vehicles stand so well: on a strip for them better, and on other paved ground worse.
pub(super) const KERB: f64 = 0.85;

/// At a kerb that has a cycle lane before it nobody should stand, but a vehicle does so rather than on a lawn.
const ON_CYCLE_LANE: LandFit = LandFit { land: Land::CycleLane, suits: 0.35, astray: true };

/// The ground on which a thing is to stand.
pub(super) struct Site<'a> {
    pub(super) scene: &'a dyn Scene,
    pub(super) streets: Option<&'a Streets>,
    /// Things that are as good as gone.
    pub(super) gone: &'a [EntityId],
    /// Pieces of ground on which the thing was asked to stand.
    pub(super) asked: &'a [EntityId],
}

/// The pieces of ground, or the things, on which one is to stand who is to stand so.
pub(super) fn named_ground(stands: &[Stand]) -> Vec<EntityId> {
    let named = stands.iter().filter(|stand| {
        matches!(
            stand,
            Stand::To { relation: Relation::Inside | Relation::OnTopOf, .. }
                | Stand::InMiddleOf { .. }
                | Stand::AtEdgeOf { .. }
        )
    });
    named.filter_map(Stand::anchor).collect()
}

impl Site<'_> {
    /// How well a thing of that kind stands there, or why it may not.
    pub(super) fn suits(&self, kind: EntityKind, solid: &Solid) -> Result<LandFit, &'static str> {
        let roads = self.streets.map(|streets| streets.roads_near(solid.planar())).unwrap_or_default();
        let streets = self.streets.filter(|_| !roads.is_empty());
        let surfaces = Surfaces::under(self.scene, solid, self.asked, self.gone, streets.is_some());
        let land_at = |point| self.land_at(point, streets.map(|streets| (streets, &roads[..])), &surfaces);
        let lands: Vec<Land> = outline(solid).into_iter().map(land_at).collect();
        let has = |is: fn(Land) -> bool| lands.iter().any(|land| is(*land));
        let is_walk = |land: Land| land == Land::Sidewalk;
        if kind != EntityKind::Cone {
            if has(|land| land == Land::Junction) {
                return Err("streets meet there, or walkers cross");
            }
            if kind == EntityKind::Building && (has(is_walk) || has(Land::is_street)) {
                return Err("a street is there");
            }
            if !parks(kind) && has(Land::is_street) {
                return Err("a carriageway is for traffic");
            }
            let leaves_way = streets.is_none_or(|streets| streets.leaves_way(&roads, solid));
            if !leaves_way || !surfaces.leave_way(solid) {
                return Err("too little of the sidewalk would be left to walk on");
            }
        }
        let is_between_kerbs =
            |land: &Land| matches!(land, Land::Parking | Land::Carriageway | Land::CycleLane);
        let parked = streets.filter(|_| parks(kind) && lands.iter().all(is_between_kerbs));
        if let Some(land) = parked.and_then(|streets| streets.parked(&roads, solid)) {
            let blocks_cycles = land == Land::Kerbside && lands.contains(&Land::CycleLane);
            return Ok(if blocks_cycles { ON_CYCLE_LANE } else { fit(kind, land) });
        }
        let fits = lands.into_iter().map(|land| fit(kind, land));
        let worst = fits.reduce(|worst, next| if next.suits < worst.suits { next } else { worst });
        Ok(worst.unwrap_or(LandFit::ASKED))
    }

    /// What a point is for: by the streets, or the pieces of ground, or what covers the land.
    fn land_at(&self, point: Point2, streets: Option<(&Streets, &[RoadId])>, surfaces: &Surfaces) -> Land {
        let of_streets = streets.map(|(streets, roads)| streets.at_of(point, roads));
        let street = of_streets.filter(|land| *land != Land::Lot);
        let other = || surfaces.at(point).or_else(|| covered(self.scene, point)).or(of_streets);
        street.or_else(other).unwrap_or(Land::Unknown)
    }
}

/// The middle of a footprint, its corners and points along its edge.
fn outline(solid: &Solid) -> Vec<Point2> {
    let corners = solid.corners();
    let mut points = vec![solid.planar()];
    for (index, corner) in corners.into_iter().enumerate() {
        let way = corners[(index + 1) % corners.len()] - corner;
        let count = (way.norm() / STEP).ceil().clamp(1.0, MOST);
        points.extend((0..count as u32).map(|step| corner + way * (f64::from(step) / count)));
    }
    points
}

/// How well such things stand on such ground.
fn fit(kind: EntityKind, land: Land) -> LandFit {
    let suits = match kind {
        EntityKind::Cone => 1.0,
        EntityKind::Tree | EntityKind::Shrub => for_plants(land),
        kind if parks(kind) => for_vehicles(land),
        kind => for_others(kind, land),
    };
    LandFit { land, suits, astray: suits < LEAST }
}

const fn for_vehicles(land: Land) -> f64 {
    match land {
        Land::Asked | Land::Parking | Land::ParkingLot => 1.0,
        Land::Kerbside => KERB,
        Land::Paving | Land::Road => 0.7,
        Land::Unknown | Land::Bare => 0.5,
        Land::Lot | Land::Green | Land::Verge => 0.3,
        Land::Carriageway | Land::CycleLane | Land::Junction => 0.15,
        Land::Path | Land::Sidewalk | Land::Water => 0.0,
    }
}

const fn for_plants(land: Land) -> f64 {
    match land {
        Land::Asked | Land::Green | Land::Verge | Land::Lot | Land::Unknown => 1.0,
        Land::Bare => 0.7,
        Land::Sidewalk => 0.3,
        Land::Paving | Land::Path | Land::ParkingLot => 0.15,
        _ => 0.0,
    }
}

/// Furniture, people and houses; a thing of no other kind may be a boat.
fn for_others(kind: EntityKind, land: Land) -> f64 {
    match land {
        Land::Water if kind != EntityKind::Prop => 0.0,
        Land::Path | Land::ParkingLot if !kind.is_mobile() => 0.5,
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};
    use std::sync::Arc;

    use simworld_core::geometry::{Point3, pose_facing};
    use simworld_core::ground::{Cover, Ground, GroundData};
    use simworld_core::net::{CrossSection, NetworkConfig, RoadNetwork, StreetPlan};
    use simworld_core::scene::{EntityDesc, Shape, World};

    use super::*;

    /// A crossroads with arms of 100 m, between which a park and a square lie, or a scene without streets.
    fn scene(section: Option<CrossSection>) -> (World, Option<Streets>) {
        let mut world = World::new();
        for (x, area) in [(30.0, "park"), (70.0, "square")] {
            let pose = pose_facing(Point3::new(x, 30.0, -0.03), 0.0);
            let ground = EntityDesc::new(EntityKind::Ground, pose, Shape::cuboid(30.0, 30.0, 0.02));
            world.spawn(ground.with("area", area)).unwrap();
        }
        let streets = section.map(|section| {
            let mut plan = StreetPlan::crossroads(100.0);
            plan.sections[0] = section;
            Streets::of(&Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap()))
        });
        (world, streets)
    }

    type Size = [f64; 2];
    const CAR: Size = [4.4, 1.8];
    const BENCH: Size = [0.6, 1.8];
    const TREE: Size = [0.6, 0.6];

    fn suits(
        (world, streets): &(World, Option<Streets>),
        (kind, size): (EntityKind, Size),
        (x, y, yaw): (f64, f64, f64),
    ) -> Result<LandFit, &'static str> {
        let site = Site { scene: world, streets: streets.as_ref(), gone: &[], asked: &[] };
        let shape = Shape::cuboid(size[0], size[1], 1.0);
        site.suits(kind, &Solid::standing(shape, Point3::new(x, y, 0.0), yaw))
    }

    fn land(found: Result<LandFit, &'static str>) -> (Land, bool) {
        let fit = found.expect("it may stand there");
        (fit.land, fit.astray)
    }

    #[test]
    fn vehicles_are_for_strips_then_kerbs_then_pavings_then_any_open_ground_and_for_lawns_last() {
        let (strips, plain) = (
            scene(Some(CrossSection::two_way(1, 1).with_parking(2.0))),
            scene(Some(CrossSection::two_way(1, 1))),
        );
        let bare = scene(None);
        let car = |scene, at| suits(scene, (EntityKind::Car, CAR), at);
        let ranked = [
            (car(&strips, (60.0, -4.45, 0.0)), (Land::Parking, false)),
            (car(&plain, (60.0, -2.45, 0.0)), (Land::Kerbside, false)),
            (car(&plain, (70.0, 30.0, 0.4)), (Land::Paving, false)),
            (car(&bare, (70.0, -30.0, 0.4)), (Land::Unknown, false)),
            (car(&plain, (30.0, 30.0, 0.4)), (Land::Green, true)),
            (car(&plain, (60.0, -1.0, 0.0)), (Land::Carriageway, true)),
        ];
        for (found, wanted) in ranked {
            assert_eq!(land(found), wanted);
        }
        let scores: Vec<f64> = ranked.iter().map(|(found, _)| found.unwrap().suits).collect();
        assert!(scores.windows(2).all(|pair| pair[0] > pair[1]), "{scores:?}");
        assert_eq!(land(car(&plain, (60.0, -30.0, 0.4))), (Land::Lot, true));
        assert!(car(&plain, (0.0, 2.0, 0.0)).is_err(), "where streets meet");
        assert!(car(&plain, (60.0, 5.0, 0.0)).is_err(), "on a sidewalk of 3 m");
        let broad = scene(Some(CrossSection::plain(1, 1, 3.5, 6.0)));
        assert_eq!(land(car(&broad, (60.0, 4.6, 0.0))), (Land::Sidewalk, true));
    }

    #[test]
    fn plants_are_for_soil_and_stand_on_paving_for_want_of_it() {
        let scene = scene(Some(CrossSection::two_way(1, 1)));
        let tree = |x, y| suits(&scene, (EntityKind::Tree, TREE), (x, y, 0.0));
        let [park, lot, walk, square] =
            [(30.0, 30.0), (50.0, 10.0), (60.0, 4.0), (70.0, 30.0)].map(|(x, y)| tree(x, y));
        assert_eq!([land(park), land(lot)], [(Land::Green, false), (Land::Lot, false)]);
        assert_eq!([land(walk), land(square)], [(Land::Sidewalk, true), (Land::Paving, true)]);
        assert!(tree(60.0, 1.0).is_err(), "a tree in the middle of the street");
    }

    #[test]
    fn on_a_square_that_was_named_a_tree_is_where_it_belongs() {
        let (world, _) = scene(None);
        let square = world.iter().nth(1).expect("the square came second").id;
        let stands = [Stand::InMiddleOf { anchor: square }];
        let asked = named_ground(&stands);
        let site = Site { scene: &world, streets: None, gone: &[], asked: &asked };
        let tree = Solid::standing(Shape::cuboid(0.6, 0.6, 8.0), Point3::new(70.0, 30.0, 0.0), 0.0);
        assert_eq!(site.suits(EntityKind::Tree, &tree), Ok(LandFit::ASKED));
        assert_eq!(named_ground(&[Stand::To { relation: Relation::NextTo, anchor: square }]), []);
    }

    #[test]
    fn furniture_stands_anywhere_but_where_one_drives() {
        let scene = scene(Some(CrossSection::two_way(1, 1).with_parking(2.0)));
        for kind in [
            EntityKind::Bench,
            EntityKind::TrashBin,
            EntityKind::StreetLamp,
            EntityKind::Mailbox,
            EntityKind::Table,
            EntityKind::Prop,
        ] {
            let suits = |x, y| suits(&scene, (kind, BENCH), (x, y, FRAC_PI_2));
            for (x, y) in [(30.0, 30.0), (70.0, 30.0), (60.0, 5.9), (50.0, 12.0)] {
                assert_eq!(suits(x, y).map(|fit| fit.suits), Ok(1.0), "{kind} at ({x}, {y})");
            }
            for (x, y) in [(60.0, 1.5), (60.0, 4.5), (0.0, 0.0)] {
                assert!(suits(x, y).is_err(), "{kind} at ({x}, {y})");
            }
            assert!(suits(60.0, 7.0).is_err(), "{kind} in the way of walkers");
        }
    }

    #[test]
    fn what_reaches_across_a_street_with_both_ends_beside_it_is_found_out() {
        let scene = scene(Some(CrossSection::two_way(1, 1)));
        // 40 m long, its middle 12 m off the street: neither the middle nor a corner is on it.
        let stage = (EntityKind::Prop, [40.0, 4.0]);
        assert_eq!(suits(&scene, stage, (60.0, -12.0, FRAC_PI_2)), Err("a carriageway is for traffic"));
    }

    #[test]
    fn roads_and_crossings_of_a_scene_without_streets_are_no_place_for_furniture() {
        let mut world = World::new();
        let mut put = |kind, x: f64| {
            let pose = pose_facing(Point3::new(x, 0.0, 0.0), 0.0);
            world.spawn(EntityDesc::new(kind, pose, Shape::cuboid(8.0, 8.0, 0.02))).unwrap();
        };
        put(EntityKind::Road, 0.0);
        put(EntityKind::Crosswalk, 20.0);
        let scene = (world, None);
        let bench = |x| suits(&scene, (EntityKind::Bench, BENCH), (x, 0.0, 0.0));
        assert!(bench(0.0).is_err() && bench(20.0).is_err() && bench(10.0).is_ok());
        assert_eq!(land(suits(&scene, (EntityKind::Car, CAR), (0.0, 0.0, PI))), (Land::Road, false));
    }

    #[test]
    fn land_is_for_what_covers_it() {
        let ground = Ground::new(GroundData {
            origin: Point2::new(0.0, 0.0),
            spacing: 100.0,
            columns: 3,
            rows: 2,
            heights: vec![0.0; 6],
            covers: [Cover::Meadow, Cover::Path, Cover::Sand].repeat(2),
            water: None,
        });
        let mut world = World::new();
        world.set_ground(Arc::new(ground.unwrap()));
        let scene = (world, None);
        let tree = |x| land(suits(&scene, (EntityKind::Tree, TREE), (x, 20.0, 0.0)));
        let car = |x| land(suits(&scene, (EntityKind::Car, CAR), (x, 20.0, 0.0)));
        assert_eq!(
            [10.0, 100.0, 190.0].map(tree),
            [(Land::Green, false), (Land::Path, true), (Land::Bare, false)]
        );
        assert_eq!(
            [10.0, 100.0, 190.0].map(car),
            [(Land::Green, true), (Land::Path, true), (Land::Bare, false)]
        );
    }
}
