//! Somebody else drives a vehicle or walks a walker: on its way, where the traffic keeps it safe, or as a free body that the
//! others mind; and gives it back.

use std::sync::Arc;

use crate::lent_threads::Threads;
use simworld_core::geometry::{
    Point2, Point3, Twist, Vector2, Vector3, direction, planar, pose_facing, yaw_of,
};
use simworld_core::hash::{StateDigest, StateHash};
use simworld_core::id::LaneId;
use simworld_core::net::{Aspect, CrossSection, NetworkConfig, RoadNetwork, StreetPlan, Workers, polyline};
use simworld_core::scene::World;
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_traffic::{
    AtDestination, Control, ControlError, Drive, LaneWish, Leg, Stroll, Traffic, TrafficConfig,
    TrafficDynamics,
};

use crate::contacts::touching;

fn grid(size: usize, lanes: u8) -> Arc<RoadNetwork> {
    let mut plan = StreetPlan::grid(size, size, 200.0);
    plan.sections[0] = CrossSection::two_way(lanes, lanes);
    Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network"))
}

/// Everybody waits behind who is stopped, also where they could get round.
fn traffic(lanes: u8, vehicles: u32, pedestrians: u32) -> Traffic {
    let config = TrafficConfig { vehicles, pedestrians, pass_obstacles: false, ..TrafficConfig::default() };
    Traffic::new(grid(3, lanes), &config, Seed(21)).expect("the settings are in range")
}

fn track(traffic: &Traffic, id: u32) -> (u32, f64, f64) {
    let (_, track, s, v) = traffic.stations().find(|at| at.0 == id).expect("it is on a track");
    (track, s, v)
}

#[test]
fn who_brakes_makes_a_queue_and_given_back_drives_on() {
    let mut traffic = traffic(1, 120, 0);
    // One with some behind it on a long stretch of its lane.
    let places: Vec<(u32, u32, f64, f64)> = traffic.stations().collect();
    let lanes = traffic.network().lanes.len() as u32;
    let behind =
        |at: &(u32, u32, f64, f64)| places.iter().filter(|other| other.1 == at.1 && other.2 < at.2).count();
    let first = places.iter().filter(|at| at.1 < lanes && at.2 < 120.0).max_by_key(|at| behind(at)).unwrap();
    let (id, lane) = (first.0, first.1);
    traffic.drive(id, Drive { acceleration: -3.0, ..Drive::default() }).unwrap();
    for _ in 0..900 {
        traffic.step(0.1);
        assert_eq!(touching(&traffic), []);
    }
    let (own, s, v) = track(&traffic, id);
    assert_eq!((own, v), (lane, 0.0), "it stands where it was told to");
    let queue = traffic.stations().filter(|at| at.1 == lane && at.2 < s && at.3 < 0.1).count();
    assert!(queue >= 3, "{queue} stand behind it");
    traffic.give_back(id).unwrap();
    assert_eq!(traffic.control(id), Some(Control::Own));
    let start = planar(&traffic.vehicle(id).unwrap().pose);
    for _ in 0..600 {
        traffic.step(0.1);
        assert_eq!(touching(&traffic), []);
    }
    let gone = (planar(&traffic.vehicle(id).unwrap().pose) - start).norm();
    assert!(gone > 50.0, "it drove {gone} m");
    let left = traffic.stations().filter(|at| at.1 == lane && at.3 < 0.1).count();
    assert!(left < queue, "the queue goes on: {left} of {queue} stand");
}

/// Some drive as fast and change lanes as often as they can; returns the state, now and then.
fn reckless(
    workers: Option<Box<dyn Workers + Send + Sync>>,
    seed: u64,
    steps: u32,
) -> (Traffic, Vec<StateDigest>, u64) {
    let config = TrafficConfig { vehicles: 150, pedestrians: 40, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(grid(4, 2), &config, Seed(seed)).expect("the settings are in range");
    if let Some(workers) = workers {
        traffic.set_workers(workers);
    }
    let lanes = traffic.network().lanes.len() as u32;
    let (mut before, mut digests, mut on_red) = (vec![u32::MAX; 150], Vec::new(), 0);
    for step in 0..steps {
        if step % 70 == 0 {
            let lane = [LaneWish::Left, LaneWish::Right, LaneWish::Keep][(step / 70 % 3) as usize];
            for id in (0..150).step_by(7) {
                traffic
                    .drive(id, Drive { acceleration: 9.0, lane, next: None })
                    .expect("they are on their lanes");
            }
        }
        let aspects = traffic.signals().to_vec();
        traffic.step(0.1);
        assert_eq!(touching(&traffic), [], "vehicles touch at step {step} of seed {seed}");
        for (id, track, ..) in traffic.stations() {
            let old = std::mem::replace(&mut before[id as usize], track);
            if track >= lanes && old < lanes {
                let way = &traffic.network().connections[(track - lanes) as usize];
                let red = way.signal.is_some_and(|group| aspects[group.index()] == Aspect::Red);
                on_red += u64::from(red);
            }
        }
        if step % 100 == 0 {
            digests.push(traffic.digest());
        }
    }
    (traffic, digests, on_red)
}

#[test]
fn the_reckless_touch_nobody_and_pass_no_line_without_leave() {
    let seeds = if std::env::var_os("SIMWORLD_SOAK").is_some() { 40 } else { 3 };
    for seed in 1..=seeds {
        let (traffic, _, on_red) = reckless(None, seed, 3000);
        let counters = traffic.counters();
        assert!(on_red <= counters.dilemmas, "{on_red} entered on red: {counters:?}");
        assert!(counters.forced_stops == 0, "{counters:?}");
        assert!(counters.lane_changes > 100 && counters.crossings > 500, "{counters:?}");
    }
}

#[test]
fn who_is_driven_may_drive_faster_than_others_would() {
    let run = |acceleration: Option<f64>| {
        let mut traffic = traffic(1, 1, 0);
        let mut fastest = 0.0_f64;
        for _ in 0..300 {
            if let Some(acceleration) = acceleration {
                traffic.drive(0, Drive { acceleration, ..Drive::default() }).unwrap();
            }
            traffic.step(0.1);
            fastest = fastest.max(track(&traffic, 0).2);
        }
        fastest
    };
    let (own, hasty) = (run(None), run(Some(5.0)));
    assert!(hasty > own * 1.2, "{hasty} m/s against {own} m/s");
    assert_eq!(run(Some(0.0)), 0.0, "who stands and does not accelerate stays");
}

#[test]
fn bits_do_not_depend_on_workers_and_saved_control_goes_on() {
    let alone = reckless(None, 9, 500).1;
    for threads in [2, 8] {
        assert_eq!(reckless(Some(Box::new(Threads(threads))), 9, 500).1, alone, "{threads} threads");
    }
    let make = || {
        let mut world = World::new();
        world.set_roads(grid(3, 2));
        let config = TrafficConfig { vehicles: 60, pedestrians: 30, ..TrafficConfig::default() };
        let dynamics = TrafficDynamics::new(&mut world, &config, Seed(3)).unwrap();
        (world, dynamics)
    };
    let (mut world, mut dynamics) = make();
    for _ in 0..200 {
        dynamics.step(&mut world, 0.1).unwrap();
    }
    let traffic = dynamics.traffic_mut();
    let drive = Drive { acceleration: 0.5, lane: LaneWish::Left, next: None };
    traffic.drive(5, drive).unwrap();
    traffic.free(8).unwrap();
    traffic.guide_walker(2, Stroll { speed: 0.5, keep_right: 0.0, dares: false }).unwrap();
    traffic.free_walker(4).unwrap();
    let saved = dynamics.save().unwrap();
    let mut copy = world.clone();
    let mut resumed = make().1;
    resumed.restore(&copy, &saved).unwrap();
    assert_eq!(resumed.traffic().control(5), Some(Control::Guided(drive)));
    assert_eq!(resumed.traffic().control(8), Some(Control::Free));
    assert_eq!(resumed.traffic().walker_control(4), Some(Control::Free));
    for _ in 0..300 {
        dynamics.step(&mut world, 0.1).unwrap();
        resumed.step(&mut copy, 0.1).unwrap();
    }
    assert_eq!(dynamics.traffic().digest(), resumed.traffic().digest());
    assert_eq!(dynamics.traffic().vehicles().count(), 60);
}

/// A vehicle alone on a lane of which it has so much before it, m, and how far it is along it.
fn with_room(traffic: &Traffic, room: f64) -> (u32, LaneId, f64) {
    let at = traffic.stations().find(|(_, track, s, _)| {
        let lane = traffic.network().lanes.get(*track as usize);
        let is_first = traffic.stations().all(|other| other.1 != *track || other.2 <= *s);
        lane.is_some_and(|lane| lane.length - s > room) && is_first && *s > 20.0
    });
    let (id, track, s, _) = at.expect("some lane has room");
    (id, LaneId(track), s)
}

#[test]
fn a_free_body_is_followed_and_joins_its_lane_again() {
    let mut traffic = traffic(1, 60, 0);
    let (id, lane, start) = with_room(&traffic, 130.0);
    let path = traffic.network().lanes[lane.index()].path.clone();
    let body = traffic.free(id).unwrap();
    assert!(traffic.free(id).is_err() && traffic.drive(id, Drive::default()).is_err());
    assert!(traffic.stations().all(|at| at.0 != id), "it is on no track");
    let middle = start - body.shape.size().x * 0.5;
    // It crawls on: those behind come up and keep behind.
    let mut followed = false;
    for step in 0..600 {
        let station = middle + f64::from(step) * 0.15;
        let (at, yaw) = polyline::at(&path, station);
        let twist = Twist { linear: (direction(yaw) * 1.5).push(0.0), angular: Vector3::zeros() };
        traffic.place(id, pose_facing(Point3::new(at.x, at.y, 0.0), yaw), twist).unwrap();
        traffic.step(0.1);
        assert_eq!(touching(&traffic), [], "at step {step}");
        followed |= traffic.stations().any(|(_, track, s, v)| {
            track == lane.0 && s < station && s > station - 12.0 && v > 0.5 && v < 2.5
        });
    }
    assert!(followed, "somebody came up behind it");
    assert_eq!(traffic.vehicles().count(), 60, "it is still one of them");
    traffic.give_back(id).unwrap();
    let (own, ..) = track(&traffic, id);
    assert_eq!(own, lane.0);
    let after = planar(&traffic.vehicle(id).unwrap().pose);
    let (at, _) = polyline::at(&path, middle + 599.0 * 0.15);
    assert!((after - at).norm() < 0.3, "it joins where it is, not {} m away", (after - at).norm());
    for _ in 0..600 {
        traffic.step(0.1);
        assert_eq!(touching(&traffic), []);
    }
    assert!((planar(&traffic.vehicle(id).unwrap().pose) - after).norm() > 30.0, "it drives on");
}

#[test]
fn a_body_that_stands_across_a_lane_stops_everybody_behind_it() {
    let mut traffic = traffic(1, 100, 0);
    let (id, lane, _) = with_room(&traffic, 60.0);
    let path = traffic.network().lanes[lane.index()].path.clone();
    traffic.free(id).unwrap();
    let station = traffic.network().lanes[lane.index()].length - 45.0;
    let (at, yaw) = polyline::at(&path, station);
    traffic.place(id, pose_facing(Point3::new(at.x, at.y, 0.0), yaw + 0.35), Twist::ZERO).unwrap();
    let before: Vec<u32> =
        traffic.stations().filter(|at| at.1 == lane.0 && at.2 > station).map(|at| at.0).collect();
    for step in 0..1200 {
        traffic.step(0.1);
        assert_eq!(touching(&traffic), [], "at step {step}");
        let beyond =
            traffic.stations().find(|at| at.1 == lane.0 && at.2 > station && !before.contains(&at.0));
        assert!(beyond.is_none(), "{beyond:?} passed it at step {step}");
    }
    let queue = traffic.stations().filter(|at| at.1 == lane.0 && at.3 < 0.1).count();
    assert!(queue > 2, "{queue} wait");
}

#[test]
fn nobody_joins_where_there_is_no_place_and_everybody_is_counted() {
    let mut traffic = traffic(1, 60, 0);
    let (id, lane, start) = with_room(&traffic, 100.0);
    let road = traffic.network().lanes[lane.index()].path.clone();
    let body = traffic.free(id).unwrap();
    let refused = |traffic: &mut Traffic, at: Point2, yaw: f64| {
        traffic.place(id, pose_facing(Point3::new(at.x, at.y, 0.0), yaw), Twist::ZERO).unwrap();
        let error = traffic.give_back(id).expect_err("there is no place");
        assert!(matches!(error, ControlError::NoPlace { .. }), "{error}");
        assert_eq!(traffic.control(id), Some(Control::Free));
        error.to_string()
    };
    let (at, yaw) = polyline::at(&road, start + 20.0);
    assert!(refused(&mut traffic, at + Vector2::new(900.0, 70.0), 0.3).contains("no lane"));
    assert!(refused(&mut traffic, at, yaw + 2.0).contains("no lane"), "it faces another way");
    let (_, other, s, _) = traffic.stations().find(|at| at.1 < 10 && at.2 > 30.0).unwrap();
    let (there, along) = polyline::at(&traffic.network().lanes[other as usize].path, s - 2.0);
    assert!(refused(&mut traffic, there, along).contains("in its place"));
    let fast = Twist { linear: (direction(yaw) * 60.0).push(0.0), angular: Vector3::zeros() };
    traffic.place(id, pose_facing(Point3::new(at.x, at.y, 0.0), yaw), fast).unwrap();
    assert!(traffic.give_back(id).unwrap_err().to_string().contains("too fast"));
    // Nothing is changed by numbers that are none.
    let now = traffic.vehicle(id).unwrap();
    for bad in [f64::NAN, f64::INFINITY] {
        let pose = pose_facing(Point3::new(bad, 0.0, 0.0), 0.0);
        assert!(matches!(traffic.place(id, pose, Twist::ZERO), Err(ControlError::NotFinite { .. })));
        let twist = Twist { linear: Vector3::new(0.0, bad, 0.0), angular: Vector3::zeros() };
        assert!(matches!(traffic.place(id, now.pose, twist), Err(ControlError::NotFinite { .. })));
        let drive = Drive { acceleration: bad, ..Drive::default() };
        assert!(matches!(traffic.drive(3, drive), Err(ControlError::NotFinite { .. })));
    }
    assert_eq!((traffic.vehicle(id), traffic.control(3)), (Some(now), Some(Control::Own)));
    assert!(matches!(traffic.drive(999, Drive::default()), Err(ControlError::Nobody { .. })));
    assert!(traffic.give_back(3).is_err() && traffic.place(3, body.pose, body.twist).is_err());
    // Who is taken out while free is counted as removed, once.
    assert!(traffic.remove(id) && !traffic.remove(id));
    assert_eq!(traffic.vehicles().count(), 59);
    assert_eq!((traffic.counters().removed, traffic.ended().len()), (1, 1));
    assert!(traffic.control(id).is_none());
}

#[test]
fn a_driver_from_outside_turns_where_it_wants() {
    for turn in 0..3 {
        let mut traffic = traffic(2, 1, 0);
        let (lane, s, _) = track(&traffic, 0);
        let network = Arc::clone(traffic.network());
        let here = Leg::of(&network, LaneId(lane));
        let mut legs: Vec<Leg> = here
            .lanes(&network)
            .iter()
            .flat_map(|lane| &network.lanes[lane.index()].outgoing)
            .map(|way| Leg::of(&network, network.connections[way.index()].to))
            .collect();
        legs.sort_unstable();
        legs.dedup();
        assert!(legs.len() > 1 && s < 170.0);
        let Some(next) = legs.get(turn).copied() else { continue };
        assert!(matches!(
            traffic.drive(0, Drive { next: Some(here), ..Drive::default() }),
            Err(ControlError::Turn { .. })
        ));
        traffic.drive(0, Drive { acceleration: 1.0, lane: LaneWish::AsDriven, next: Some(next) }).unwrap();
        let mut taken = None;
        println!("{turn} of {legs:?} from {here:?}");
        for step in 0..900 {
            traffic.step(0.1);
            let (at, ..) = track(&traffic, 0);
            if step % 50 == 0 {
                println!("{:?}", track(&traffic, 0));
            }
            if (at as usize) < network.lanes.len() && Leg::of(&network, LaneId(at)) != here {
                taken = Some(Leg::of(&network, LaneId(at)));
                break;
            }
        }
        assert_eq!(taken, Some(next));
    }
}

#[test]
fn walkers_are_guided_freed_and_given_back() {
    let mut traffic = traffic(1, 40, 60);
    traffic.guide_walker(0, Stroll { speed: 0.0, keep_right: 0.3, dares: false }).unwrap();
    let start = traffic.pedestrians()[0].position;
    for _ in 0..300 {
        traffic.step(0.1);
    }
    let moved = (traffic.pedestrians()[0].position - start).norm();
    assert!(moved < 0.8, "who is to stand walks {moved} m");
    traffic.give_back_walker(0).unwrap();
    for _ in 0..300 {
        traffic.step(0.1);
    }
    assert!((traffic.pedestrians()[0].position - start).norm() > 5.0, "it walks again");
    // One steps on to the road: the drivers stop for it.
    let is_free = |lane: &u32| traffic.stations().all(|at| at.1 != *lane || at.2 < 60.0);
    let lane = LaneId((0..24).find(is_free).expect("some lane is free"));
    let path = traffic.network().lanes[lane.index()].path.clone();
    let (at, yaw) = polyline::at(&path, traffic.network().lanes[lane.index()].length - 40.0);
    let sidewalk = traffic.pedestrians()[1].position;
    let looks = direction(traffic.pedestrians()[1].heading());
    traffic.free_walker(1).unwrap();
    assert!(traffic.guide_walker(1, Stroll { speed: 1.0, keep_right: 0.0, dares: false }).is_err());
    traffic.place_walker(1, at, direction(yaw + 1.5), Vector2::zeros()).unwrap();
    assert!(matches!(traffic.give_back_walker(1), Err(ControlError::NoPlace { .. })));
    for step in 0..1500 {
        traffic.step(0.1);
        for body in traffic.vehicles() {
            let distance = body.shape.planar_distance(&body.pose, &at);
            assert!(distance > 0.15, "step {step}: {body:?} drove into the walker");
        }
    }
    assert_eq!(traffic.pedestrians()[1].position, at, "it stays where it is put");
    for bad in [f64::NAN, f64::NEG_INFINITY] {
        let nowhere = traffic.place_walker(1, Point2::new(0.0, bad), Vector2::x(), Vector2::zeros());
        assert!(matches!(nowhere, Err(ControlError::NotFinite { .. })));
        assert!(traffic.guide_walker(2, Stroll { speed: bad, keep_right: 0.0, dares: false }).is_err());
    }
    traffic.place_walker(1, sidewalk, looks, Vector2::zeros()).unwrap();
    traffic.give_back_walker(1).unwrap();
    assert_eq!(traffic.walker_control(1), Some(Control::Own));
    traffic.send_walker(1, Point2::new(200.0, 206.0), AtDestination::Leave).unwrap();
    let mut arrived = false;
    for _ in 0..6000 {
        traffic.step(0.1);
        arrived |= traffic.walks().iter().any(|walk| walk.id == 1);
    }
    assert!(arrived, "it goes where it is sent");
    let counters = traffic.counters();
    let present = traffic.pedestrians().iter().filter(|walker| walker.is_present()).count() as u64;
    assert_eq!(present + counters.walkers_left, 60);
    assert!(yaw_of(&traffic.vehicle(0).unwrap().pose).is_finite());
}
