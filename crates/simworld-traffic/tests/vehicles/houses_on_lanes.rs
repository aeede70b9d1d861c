//! Houses and traffic lights on lanes: drivers stop before one that is put there, and drive as ever where one stands beside the lanes or
//! stood over them before there was traffic.

use std::sync::Arc;

use simworld_core::geometry::{Point2, Point3, Pose, Twist, pose_facing};
use simworld_core::hash::{StateDigest, StateHash};
use simworld_core::id::EntityId;
use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan, polyline};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_traffic::{TrafficConfig, TrafficDynamics};

/// Who is nearer than this could not stop any more when something is put there, m.
const CLEAR: f64 = 40.0;

/// Streets with traffic.
struct Streets {
    world: World,
    traffic: TrafficDynamics,
}

fn network() -> Arc<RoadNetwork> {
    let network = RoadNetwork::derive(&StreetPlan::grid(3, 3, 120.0), &NetworkConfig::default());
    Arc::new(network.expect("a grid is sound"))
}

/// Places in the middle of lanes of two roads.
fn places() -> [Pose; 2] {
    let network = network();
    let long = || network.lanes.iter().filter(|lane| lane.is_driven() && lane.length > 80.0);
    let first = long().next().expect("streets are long");
    let other = long().find(|lane| lane.road != first.road).expect("there are several");
    [first, other].map(|lane| at(polyline::at(&lane.path, 55.0).0))
}

fn at(point: Point2) -> Pose {
    pose_facing(Point3::new(point.x, point.y, 0.0), 0.0)
}

fn house(pose: Pose) -> EntityDesc {
    EntityDesc::new(EntityKind::Building, pose, Shape::cuboid(8.0, 8.0, 6.0))
}

fn light(pose: Pose) -> EntityDesc {
    EntityDesc::new(EntityKind::TrafficSignal, pose, Shape::Cylinder { radius: 0.08, height: 3.5 })
}

impl Streets {
    /// Traffic in a world that has these things from the beginning.
    fn with(things: &[EntityDesc]) -> Self {
        let mut world = World::new();
        world.set_roads(network());
        for thing in things {
            world.spawn(thing.clone()).unwrap();
        }
        // What is asked is who stops for it, not who gets round it.
        let config =
            TrafficConfig { vehicles: 40, pedestrians: 0, pass_obstacles: false, ..TrafficConfig::default() };
        let traffic = TrafficDynamics::new(&mut world, &config, Seed(1)).expect("sound settings");
        Self { world, traffic }
    }

    fn step(&mut self) {
        self.world.begin_step();
        self.traffic.step(&mut self.world, 0.1).expect("traffic flows");
        self.world.finish_step();
    }

    fn run(&mut self, steps: usize) {
        (0..steps).for_each(|_| self.step());
    }

    fn digest(&self) -> StateDigest {
        self.traffic.traffic().digest()
    }

    /// Until nobody is near a place.
    fn wait_for_room(&mut self, place: Pose) {
        let here = Point2::new(place.translation.x, place.translation.y);
        for _ in 0..6000 {
            let is_far = |id: &EntityId| {
                self.world.entity(*id).is_none_or(|vehicle| (vehicle.planar() - here).norm() > CLEAR)
            };
            if self.traffic.vehicles().iter().all(is_far) {
                return;
            }
            self.step();
        }
        panic!("somebody is near {here} all the time");
    }

    /// In how many of so many steps somebody touches a thing, and in how many somebody stands before it.
    fn watch(&mut self, thing: EntityId, steps: usize) -> (usize, usize) {
        let (mut touches, mut stands) = (0, 0);
        for _ in 0..steps {
            self.step();
            let thing = self.world.entity(thing).expect("it is there");
            let solid = thing.info.shape.obb(thing.pose);
            let vehicles = self.traffic.vehicles().iter().filter_map(|id| self.world.entity(*id));
            let (mut touched, mut stood) = (false, false);
            for vehicle in vehicles {
                touched |= vehicle.info.shape.obb(vehicle.pose).footprints_overlap(&solid);
                let gap = thing.info.shape.planar_distance(thing.pose, &vehicle.planar());
                stood |= gap < 8.0 && vehicle.twist.ground_speed() < 0.05;
            }
            touches += usize::from(touched);
            stands += usize::from(stood);
        }
        (touches, stands)
    }
}

#[test]
fn drivers_stop_before_a_house_and_before_a_light_that_are_put_on_a_lane() {
    let [place, _] = places();
    for (recipe, name) in [(house(place), "house"), (light(place), "light")] {
        let mut streets = Streets::with(&[]);
        streets.run(300);
        streets.wait_for_room(place);
        let thing = streets.world.spawn(recipe.clone()).unwrap();
        let (touches, stands) = streets.watch(thing, 1500);
        assert_eq!(touches, 0, "somebody drove into the {name}");
        assert!(stands > 100, "somebody stands before the {name}: {stands} steps");
        streets.world.remove(thing).unwrap();
        // What lies flat is driven over.
        let flat = streets.world.spawn(EntityDesc { kind: EntityKind::Ground, ..recipe }).unwrap();
        let (touches, _) = streets.watch(flat, 900);
        assert!(touches > 0, "the lane is driven on again without the {name}");
    }
}

#[test]
fn a_house_is_in_the_way_from_when_it_is_moved_on_to_a_lane() {
    let [place, _] = places();
    let mut streets = Streets::with(&[]);
    let thing = streets.world.spawn(house(at(Point2::new(60.0, 60.0)))).unwrap();
    streets.run(300);
    streets.wait_for_room(place);
    streets.world.set_motion(thing, place, Twist::ZERO).unwrap();
    let (touches, stands) = streets.watch(thing, 900);
    assert!(touches == 0 && stands > 0, "{touches} steps in which it was touched, {stands} before it");
}

#[test]
fn what_stands_beside_the_lanes_is_in_nobodys_way() {
    let run = |things: &[EntityDesc]| {
        let mut streets = Streets::with(&[]);
        streets.run(50);
        for thing in things {
            streets.world.spawn(thing.clone()).unwrap();
        }
        streets.run(600);
        streets.digest()
    };
    // The kerb of the first street is 3.5 m north of its middle.
    let beside = [house(at(Point2::new(60.0, 9.0))), light(at(Point2::new(55.0, 4.0)))];
    assert_eq!(run(&beside), run(&[]));
}

#[test]
fn what_stood_over_a_lane_before_there_was_traffic_changes_nothing() {
    let [place, other] = places();
    let mut bare = Streets::with(&[]);
    let mut built = Streets::with(&[house(place), light(other)]);
    let first = built.world.iter().find(|thing| thing.kind == EntityKind::Building).expect("a house").id;
    let (touches, _) = built.watch(first, 900);
    assert!(touches > 0, "the street leads through the house");
    bare.run(900);
    assert_eq!(built.digest(), bare.digest());

    // Who goes on from what was saved knows it too, although it did not see the beginning.
    let saved = built.traffic.save().unwrap();
    let mut resumed = Streets::with(&[]);
    resumed.world = built.world.clone();
    resumed.traffic.restore(&resumed.world, &saved).unwrap();
    for streets in [&mut built, &mut resumed, &mut bare] {
        streets.run(300);
    }
    assert_eq!((built.digest(), resumed.digest()), (bare.digest(), bare.digest()));

    // A house that is put elsewhere is put there like any other; where it was built it belongs.
    built.wait_for_room(other);
    built.world.set_motion(first, other, Twist::ZERO).unwrap();
    assert_eq!(built.watch(first, 900).0, 0, "somebody drove into it where it is now");
    built.world.set_motion(first, place, Twist::ZERO).unwrap();
    assert!(built.watch(first, 1500).0 > 0, "the street leads through it again");
}
