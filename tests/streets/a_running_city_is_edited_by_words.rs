//! A city at work that is edited by sentences: its traffic takes other ways, its walkers go round what stands in theirs, a body falls on
//! it, a camera sees it, all at once; and when it is taken back, everything is as it was.

use std::collections::BTreeMap;
use std::sync::Arc;

use simworld_agents::editing::{Edited, SceneEditor};
use simworld_agents::executor::RuleExecutor;
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::command::Command;
use simworld_core::geometry::{Point2, Point3, pose_facing};
use simworld_core::hash::{StateDigest, StateHasher};
use simworld_core::id::EntityId;
use simworld_core::net::{
    LaneDirection, NetworkConfig, RoadNetwork, StreetPlan, WaypointConfig, WaypointGraph,
};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{Executor, Goal, Plan, Progress};
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;
use simworld_core::traffic::{RoadLeg, TrafficOrder};
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics};
use simworld_render::{Frame, RenderConfig, RenderError, Renderer};
use simworld_traffic::{TrafficConfig, TrafficDynamics};

/// Between two streets, m.
const BLOCK: f64 = 120.0;
/// The streets by name, and whether they lead east at that height or north at that place.
const STREETS: [(&str, bool, f64); 6] = [
    ("Oak Street", true, 0.0),
    ("Elm Street", true, BLOCK),
    ("Mill Lane", true, 2.0 * BLOCK),
    ("Harbour Road", false, 0.0),
    ("Station Road", false, BLOCK),
    ("River Walk", false, 2.0 * BLOCK),
];
/// Along Harbour Road, Elm Street, Station Road and Mill Lane; by the corner of Harbour Road and Mill Lane it is as far.
const TRIP: [(f64, f64); 5] =
    [(0.0, 0.0), (0.0, BLOCK), (BLOCK, BLOCK), (BLOCK, 2.0 * BLOCK), (2.0 * BLOCK, 2.0 * BLOCK)];
const TRIPS: usize = 3;
/// Half a body, less what a gap is measured to, m: nearer than this to a footprint is within it.
const BODY: f64 = 0.24;
/// Where the crate lies when nobody asks for it.
const AWAY: Point3 = Point3::new(20.0, 100.0, 0.0);
/// So long it takes who is on a street of 120 m to leave it, and then it is watched, steps of 0.1 s.
const CLEARING: usize = 900;
const WATCHED: usize = 600;

/// Somebody on the way to somewhere.
struct Walker {
    id: EntityId,
    executor: RuleExecutor,
    to: Point2,
    is_there: bool,
    /// The least gap to each thing that came to stand in the way, m.
    gaps: BTreeMap<EntityId, f64>,
}

struct Running {
    simulation: Simulation,
    editor: SceneEditor,
    network: Arc<RoadNetwork>,
    /// On the lawn of the first block, and on the sidewalk before it.
    walkers: Vec<Walker>,
    crate_: EntityId,
    /// Vehicles that turn at random; the others are on a trip.
    wanderers: Vec<EntityId>,
    /// Those on a trip, and where each was seen last.
    trips: BTreeMap<EntityId, Point2>,
    /// How often somebody was seen on Elm Street, between its junctions.
    on_elm: usize,
    obstacles: Vec<EntityId>,
}

fn network() -> Arc<RoadNetwork> {
    let mut plan = StreetPlan::grid(3, 3, BLOCK);
    for (name, goes_east, at) in STREETS {
        let name = plan.add_name(name);
        for street in &mut plan.streets {
            let [a, b] = [street.from, street.to].map(|node| plan.nodes[node]);
            let is_on_it = if goes_east { a.y == at && b.y == at } else { a.x == at && b.x == at };
            if is_on_it {
                street.name = Some(name);
            }
        }
    }
    Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is sound"))
}

/// The world without its traffic: a meadow, a house, two people and a crate.
fn city(network: &Arc<RoadNetwork>) -> (World, [EntityId; 2], EntityId) {
    let mut world = World::new();
    world.set_roads(Arc::clone(network));
    let mut put = |kind, at: Point3, shape, name: &str| {
        let desc = EntityDesc::new(kind, pose_facing(at, 0.0), shape);
        world.spawn(desc.named(name)).expect("a sound entity")
    };
    // A hand below the streets, so that the two are not at one depth in pictures.
    put(EntityKind::Ground, Point3::new(BLOCK, BLOCK, -1.1), Shape::cuboid(400.0, 400.0, 1.0), "meadow");
    put(EntityKind::Building, Point3::new(60.0, 92.0, 0.0), Shape::cuboid(20.0, 14.0, 9.0), "Old Mill");
    let person = Shape::Capsule { radius: 0.25, height: 1.75 };
    let anna = put(EntityKind::Person, Point3::new(20.0, 60.0, 0.0), person, "Anna");
    let ben = put(EntityKind::Person, Point3::new(20.0, 5.0, 0.0), person, "Ben");
    let crate_ = put(EntityKind::Prop, AWAY, Shape::cuboid(0.6, 0.6, 0.6), "crate");
    (world, [anna, ben], crate_)
}

impl Running {
    fn new() -> Self {
        let network = network();
        let (mut world, people, crate_) = city(&network);
        let config = TrafficConfig { vehicles: 30, pedestrians: 0, ..TrafficConfig::default() };
        let traffic = TrafficDynamics::new(&mut world, &config, Seed(5)).expect("sound settings");
        let wanderers = traffic.vehicles().to_vec();
        let mut physics = PhysicsDynamics::new(PhysicsConfig::default()).expect("sound settings");
        for who in people {
            physics.add_humanoid(&world, who, HumanoidConfig::default()).expect("a person has a body");
        }
        physics.add_rigid(&world, crate_).expect("a crate has a body");
        let ways = WaypointGraph::walkable(&network, &WaypointConfig::default()).expect("sound settings");
        let executors = [RuleExecutor::straight(), RuleExecutor::new(Arc::new(ways))];
        let walkers = people.into_iter().zip(executors).zip([(100.0, 60.0), (100.0, 5.0)]);
        let walkers = walkers.map(|((id, executor), (x, y))| Walker {
            id,
            executor,
            to: Point2::new(x, y),
            is_there: true,
            gaps: BTreeMap::new(),
        });
        let walkers = walkers.collect();
        let mut simulation = Simulation::new(world);
        simulation.add_dynamics("traffic", Box::new(traffic));
        simulation.add_dynamics("physics", Box::new(physics));
        simulation.set_trail_interval(0);
        let editor = SceneEditor::new(Seed(9)).looking_from(Point2::new(34.0, 40.0));
        let (trips, obstacles) = (BTreeMap::new(), Vec::new());
        Self { simulation, editor, network, walkers, crate_, wanderers, trips, on_elm: 0, obstacles }
    }

    fn world(&self) -> &World {
        self.simulation.world()
    }

    fn leg(&self, from: (f64, f64), to: (f64, f64)) -> RoadLeg {
        let is_at = |at: &Point2, (x, y): (f64, f64)| (at - Point2::new(x, y)).norm() < 1.0;
        let roads = self.network.roads.iter().enumerate();
        let mut legs = roads.flat_map(|(index, road)| {
            let id = simworld_core::id::RoadId::from_index(index);
            let (a, b) = (road.centerline[0], road.centerline[road.centerline.len() - 1]);
            [((id, LaneDirection::Forward), a, b), ((id, LaneDirection::Backward), b, a)]
        });
        let found = legs.find(|(_, a, b)| is_at(a, from) && is_at(b, to));
        found.expect("there is such a street").0
    }

    /// Sends cars on the trip, and the walkers on their ways.
    fn set_out(&mut self) {
        let route: Vec<RoadLeg> = TRIP.windows(2).map(|ends| self.leg(ends[0], ends[1])).collect();
        for _ in 0..TRIPS {
            let (kind, route) = ("car".to_owned(), route.clone());
            let order = TrafficOrder::SendVehicle { kind, route, from: None, to: None };
            self.simulation.submit(Command::Traffic(order));
        }
        for walker in &mut self.walkers {
            let plan = Plan::navigate(Goal::Point(Point3::new(walker.to.x, walker.to.y, 0.0)), 0.5);
            walker.executor.start(plan, self.simulation.world(), walker.id).expect("a plan can be begun");
            walker.is_there = false;
        }
    }

    /// A step in which this is said, or what was said last is taken back.
    fn step(&mut self, words: &[&str], take_back: bool) -> Vec<Edited> {
        let mut actions = Vec::new();
        for walker in self.walkers.iter_mut().filter(|walker| !walker.is_there) {
            let progress = walker.executor.advance(self.simulation.world(), walker.id, &mut actions);
            let progress = progress.expect("it works");
            assert!(!matches!(progress, Progress::Failed { .. }), "{progress:?}");
            walker.is_there = !progress.goes_on();
            for action in actions.drain(..) {
                self.simulation.submit(Command::Actuate { who: walker.id, action });
            }
        }
        self.simulation.begin_step();
        let mut said = Vec::new();
        for words in words {
            let done = self.editor.say(words, &mut self.simulation);
            said.push(done.unwrap_or_else(|error| panic!("{words}: {error}")));
        }
        if take_back {
            let undone = self.editor.undo(&mut self.simulation).expect("it can be taken back");
            assert!(undone.is_some(), "something was said");
        }
        self.simulation.finish_step().expect("nothing fails");
        self.look();
        said
    }

    fn run(&mut self, steps: usize) {
        for _ in 0..steps {
            self.step(&[], false);
        }
    }

    fn look(&mut self) {
        let world = self.simulation.world();
        for vehicle in world.iter().filter(|entity| entity.kind.is_vehicle()) {
            let at = vehicle.planar();
            let is_between = (20.0..100.0).contains(&at.x) || (140.0..220.0).contains(&at.x);
            self.on_elm += usize::from(is_between && (at.y - BLOCK).abs() < 4.0);
            if !self.wanderers.contains(&vehicle.id) {
                self.trips.insert(vehicle.id, at);
            }
        }
        for walker in &mut self.walkers {
            let here = world.entity(walker.id).expect("it lives").planar();
            for thing in self.obstacles.iter().filter_map(|id| world.entity(*id)) {
                let gap = thing.info.shape.planar_distance(thing.pose, &here);
                let least = walker.gaps.entry(thing.id).or_insert(f64::INFINITY);
                *least = least.min(gap);
            }
        }
    }

    /// How often somebody was on Elm Street in so many steps.
    fn seen_on_elm(&mut self, steps: usize) -> usize {
        self.on_elm = 0;
        self.run(steps);
        self.on_elm
    }

    /// Trips that have not ended.
    fn under_way(&self) -> usize {
        self.trips.keys().filter(|id| self.world().entity(**id).is_some()).count()
    }

    /// All that stands where it was put, to the bit, and the streets that are closed.
    fn scene_part(&self) -> (StateDigest, Vec<RoadLeg>) {
        let world = self.world();
        let stands = |id: EntityId, kind: EntityKind| !kind.is_mobile() && id != self.crate_;
        let part = world.iter().filter(|thing| stands(thing.id, thing.kind));
        let part: Vec<(EntityId, EntityDesc)> = part.map(|thing| (thing.id, thing.to_desc())).collect();
        let bytes = postcard::to_stdvec(&part).expect("it can be written");
        let digest = StateHasher::new().bytes(&bytes).finish();
        (digest, world.closed_roads().iter().copied().collect())
    }

    fn height_of_crate(&self) -> f64 {
        self.world().entity(self.crate_).expect("it is there").position().z
    }

    fn put_crate(&mut self, at: Point3) {
        self.simulation.submit(Command::Move { id: self.crate_, pose: pose_facing(at, 0.0) });
    }

    /// Whether a thing stands on the straight way of a walker.
    fn is_in_the_way_of(&self, walker: &Walker, thing: EntityId) -> bool {
        let here = self.world().entity(walker.id).expect("it lives").planar();
        let thing = self.world().entity(thing).expect("it is there");
        let on_the_way = |share: i32| here + (walker.to - here) * (f64::from(share) / 1000.0);
        (0..=1000).any(|share| thing.info.shape.planar_distance(thing.pose, &on_the_way(share)) < BODY)
    }
}

/// A camera above the lawn, if there is an adapter.
struct Eye {
    renderer: Option<Renderer>,
    camera: Camera,
}

impl Eye {
    fn new() -> Self {
        let renderer = match Renderer::new(&RenderConfig { shadow_resolution: 0, ..RenderConfig::default() })
        {
            Ok(renderer) => Some(renderer),
            Err(RenderError::NoAdapter { .. }) if std::env::var_os("SIMWORLD_REQUIRE_ADAPTER").is_none() => {
                println!("pictures were skipped: no adapter");
                None
            }
            Err(error) => panic!("{error}"),
        };
        let intrinsics = Intrinsics::from_fov(160, 120, 1.0).expect("a size in range");
        let camera =
            Camera::looking_at(Point3::new(34.0, 40.0, 12.0), Point3::new(34.0, 60.0, 1.0), intrinsics);
        Self { renderer, camera }
    }

    fn picture(&mut self, world: &World) -> Option<Frame> {
        let mut frame = Frame::new();
        self.renderer.as_mut()?.render(world, &self.camera, &mut frame).expect("drawn");
        Some(frame)
    }

    /// Where the middle of a thing is on the picture.
    fn pixel_of(&self, world: &World, thing: EntityId) -> (u32, u32) {
        let thing = world.entity(thing).expect("it is there");
        let (pixel, _) = self.camera.project(&thing.bounds.center()).expect("it is before the camera");
        (pixel.x as u32, pixel.y as u32)
    }
}

/// The pixels on which a thing is.
fn pixels_of(frame: &Frame, thing: EntityId) -> Vec<(u32, u32)> {
    let all = (0..frame.height).flat_map(|y| (0..frame.width).map(move |x| (x, y)));
    all.filter(|(x, y)| frame.entity_at(*x, *y) == Some(thing)).collect()
}

/// The share of some pixels whose colour is another on a second picture.
fn changed(one: &Frame, other: &Frame, pixels: &[(u32, u32)]) -> f64 {
    let differs = |(x, y): &&(u32, u32)| {
        let (Some(a), Some(b)) = (one.rgb_at(*x, *y), other.rgb_at(*x, *y)) else { return false };
        a.iter().zip(b).any(|(a, b)| a.abs_diff(b) > 6)
    };
    pixels.iter().filter(differs).count() as f64 / pixels.len().max(1) as f64
}

/// Traffic keeps off the street, both walkers went round what was put before them, the trips ended where they led.
fn assert_followed(city: &mut Running) {
    city.run(CLEARING);
    for (walker, thing) in city.walkers.iter().zip(&city.obstacles) {
        let here = city.world().entity(walker.id).expect("it lives").planar();
        assert!(walker.is_there && (here - walker.to).norm() < 0.7, "{} is at {here}", walker.id);
        let gap = walker.gaps[thing];
        assert!((BODY..1.5).contains(&gap), "{} passed {thing} at {gap} m", walker.id);
    }
    assert_eq!(city.seen_on_elm(WATCHED), 0, "nobody drives on a closed street");
    for _ in 0..20 {
        if city.trips.len() == TRIPS && city.under_way() == 0 {
            break;
        }
        city.run(100);
    }
    assert_eq!(
        (city.trips.len(), city.under_way()),
        (TRIPS, 0),
        "all trips began and ended: {:?}",
        city.trips
    );
    for end in city.trips.values() {
        assert!(end.x > 1.5 * BLOCK && (end.y - 2.0 * BLOCK).abs() < 4.0, "a trip ended at {end}");
    }
}

/// What was said, and the pictures of it.
struct Shown {
    stall: EntityId,
    bench: EntityId,
    /// Before anything was said.
    before: Option<Frame>,
    /// On which pixels the stall was seen then.
    pixels: Vec<(u32, u32)>,
}

/// Says everything in one step, while all are under way. The camera sees at once what is new, where it stands.
fn say_all(city: &mut Running, eye: &mut Eye) -> Shown {
    let before = eye.picture(city.world());
    let said = city.step(
        &[
            "close Elm Street",
            "put a market stall eight metres in front of Anna",
            "put a bench at (60.0, 4.9)",
        ],
        false,
    );
    let (stall, bench) = (said[1].made[0], said[2].made[0]);
    city.obstacles = vec![stall, bench];
    for (walker, thing) in city.walkers.iter().zip(&city.obstacles) {
        assert!(!walker.is_there && city.is_in_the_way_of(walker, *thing), "{thing} is not on the way");
    }
    assert_eq!(city.under_way(), city.trips.len(), "no trip has ended yet");
    let mut pixels = Vec::new();
    if let (Some(before), Some(after)) = (&before, &eye.picture(city.world())) {
        let (x, y) = eye.pixel_of(city.world(), stall);
        assert_eq!(after.entity_at(x, y), Some(stall), "it is seen where it stands");
        assert!(!before.drawn.contains(&stall));
        pixels = pixels_of(after, stall);
        assert!(pixels.len() > 100, "{} pixels of it", pixels.len());
        assert!(changed(before, after, &pixels) > 0.5, "and looks otherwise than the meadow");
    }
    Shown { stall, bench, before, pixels }
}

/// Takes the stall away by words, and that back: for bodies and pictures it is gone, and there again, and so is what lay on it.
fn remove_and_put_back(city: &mut Running, eye: &mut Eye, stall: EntityId, top: f64) {
    let edited = city.scene_part();
    let is_drawn = |frame: Frame| frame.drawn.contains(&stall);
    let told = city.step(&["remove the market stall"], false)[0].answer.clone();
    assert!(told.is_some_and(|told| told.contains("crate") && told.contains("set down on the ground")));
    assert!(city.height_of_crate().abs() < 0.1, "it lies at {} m", city.height_of_crate());
    assert!(!eye.picture(city.world()).is_some_and(is_drawn));

    city.step(&[], true);
    assert_eq!(city.scene_part(), edited);
    city.run(10);
    assert!((city.height_of_crate() - top).abs() < 0.05, "it lies at {} m", city.height_of_crate());
    assert!(eye.picture(city.world()).is_none_or(is_drawn));
}

#[test]
fn a_city_at_work_follows_what_is_said_and_what_is_taken_back() {
    let (mut city, mut eye) = (Running::new(), Eye::new());
    let start = city.scene_part();
    assert!(city.seen_on_elm(WATCHED) > 50, "it is a street that is used");
    city.set_out();
    city.run(30);
    let Shown { stall, bench, before, pixels } = say_all(&mut city, &mut eye);

    // A body that falls on what is new comes to rest on it.
    let (at, top) = {
        let stall = city.world().entity(stall).expect("it is there");
        (stall.planar(), stall.bounds.max.z)
    };
    city.put_crate(Point3::new(at.x, at.y, top + 0.5));
    city.run(50);
    assert!((city.height_of_crate() - top).abs() < 0.05, "it lies at {} m", city.height_of_crate());
    assert_followed(&mut city);
    assert_ne!(city.scene_part(), start);
    remove_and_put_back(&mut city, &mut eye, stall, top);

    // When all of it is taken back everything is as it was.
    for _ in 0..3 {
        city.step(&[], true);
    }
    assert_eq!(city.scene_part(), start);
    assert!(city.world().closed_roads().is_empty() && city.world().entity(bench).is_none());
    city.run(20);
    assert!(city.height_of_crate().abs() < 0.05, "nothing is below it: {} m", city.height_of_crate());
    city.put_crate(AWAY);
    city.run(10);
    if let (Some(before), Some(now)) = (&before, &eye.picture(city.world())) {
        assert!(!now.drawn.contains(&stall));
        assert!(changed(before, now, &pixels) < 0.1, "the meadow looks as before");
    }
    assert!(city.seen_on_elm(CLEARING) > 50, "they come back to the street");
}
