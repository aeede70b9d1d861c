//! People go where they are sent, stay with those they walk with, cross at red only in a gap, and mind the bodies of others.

use std::sync::Arc;

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::hash::StateHash;
use simworld_core::net::{Aspect, Footpath, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::scene::World;
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_traffic::{
    AtDestination, Foreign, Interest, Pedestrian, People, Traffic, TrafficConfig, TrafficDynamics,
    TrafficError, TripEnd,
};

fn grid() -> Arc<RoadNetwork> {
    let plan = StreetPlan::grid(3, 3, 110.0);
    Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network"))
}

fn on_foot(pedestrians: u32, people: People) -> TrafficConfig {
    TrafficConfig { vehicles: 0, pedestrians, people, ..TrafficConfig::default() }
}

#[test]
fn who_is_sent_arrives_and_nobody_is_lost() {
    let mut traffic = Traffic::new(grid(), &on_foot(40, People::default()), Seed(4)).unwrap();
    let corner = |x: f64, y: f64| Point2::new(x * 220.0, y * 220.0);
    let ways = [(0.1, 0.1, 0.9, 0.9), (0.9, 0.1, 0.1, 0.9), (0.5, 0.4, 0.5, 0.1), (0.1, 0.6, 0.8, 0.4)];
    let mut sent = Vec::new();
    for (a, b, c, d) in ways {
        sent.push(traffic.add_walker(corner(a, b), Some(corner(c, d))).unwrap());
    }
    traffic.send_walker(7, corner(0.5, 0.5), AtDestination::Wander).unwrap();
    assert!(traffic.remove_walker(3) && !traffic.remove_walker(3));
    let (mut arrived, mut ended) = (Vec::new(), 0);
    for _ in 0..9000 {
        traffic.step(0.1);
        for walk in traffic.walks() {
            ended += 1;
            if walk.end == TripEnd::Arrived {
                let goal = traffic.walkways().waypoint(walk.to.unwrap()).position;
                let off = (traffic.pedestrians()[walk.id as usize].position - goal).norm();
                assert!(off < 3.0, "walker {} arrived {off} m from where it was sent", walk.id);
                arrived.push(walk.id);
            }
        }
    }
    arrived.sort_unstable();
    assert_eq!(arrived, [&[7], sent.as_slice()].concat(), "who was sent arrives");
    assert_eq!(ended, 5);
    let counters = traffic.counters();
    let present = traffic.pedestrians().iter().filter(|walker| walker.is_present()).count() as u64;
    let all = u64::from(traffic.placed().pedestrians) + counters.walkers_entered;
    assert_eq!(present + counters.walkers_left + counters.walkers_removed, all, "{counters:?}");
    assert_eq!((counters.walkers_arrived, counters.walkers_left, counters.walkers_removed), (5, 4, 1));
    // A free number goes to who comes next.
    let next = traffic.add_walker(corner(0.3, 0.1), None).unwrap();
    assert!(next == 3 || sent.contains(&next), "number {next}");
    let nowhere = traffic.add_walker(Point2::new(f64::NAN, 0.0), None);
    assert!(matches!(nowhere, Err(TrafficError::Walk { .. })), "{nowhere:?}");
    assert!(traffic.send_walker(9999, corner(0.5, 0.5), AtDestination::Leave).is_err());
}

/// The grid with a way for walkers through the middle of its first block, in two pieces that meet on a square.
fn grid_with_a_footpath() -> Arc<RoadNetwork> {
    let mut network = RoadNetwork::clone(&grid());
    let at = |y: f64| Point2::new(55.3, y);
    let piece = |from: f64, to: f64, joins| Footpath {
        path: vec![at(from), at(to)],
        width: 3.0,
        joins,
        ..Footpath::default()
    };
    network.footpaths = vec![piece(7.1, 51.7, [true, false]), piece(51.7, 102.9, [false, true])];
    network.check().unwrap();
    Arc::new(network)
}

#[test]
fn people_walk_on_ways_for_walkers_alone() {
    let mut traffic =
        Traffic::new(grid_with_a_footpath(), &on_foot(150, People::default()), Seed(4)).unwrap();
    let sent = traffic.add_walker(Point2::new(55.0, 4.0), Some(Point2::new(55.0, 106.0))).unwrap();
    let (mut walked, mut arrived) = (0, None);
    for _ in 0..3000 {
        traffic.step(0.1);
        let inside = |at: Point2| (15.0..95.0).contains(&at.x) && (15.0..95.0).contains(&at.y);
        for walker in traffic.pedestrians().iter().filter(|walker| walker.is_present()) {
            if inside(walker.position) {
                walked += 1;
                let aside = (walker.position.x - 55.3).abs();
                assert!(aside < 1.6, "{aside} m beside the middle of a way 3 m wide");
            }
        }
        let end = traffic.walks().iter().find(|walk| walk.id == sent);
        arrived = arrived.or(end.map(|walk| (walk.end, walk.ended)));
    }
    // Straight through it takes some 75 s, round the block more than 150.
    assert!(matches!(arrived, Some((TripEnd::Arrived, seconds)) if seconds < 120.0), "{arrived:?}");
    assert!(walked > 3000, "on the way for {:.0} s in all", f64::from(walked) * 0.1);
}

#[test]
fn entities_come_and_go_with_their_walkers_and_snapshots_go_on() {
    let make = || {
        let mut world = World::new();
        world.set_roads(grid());
        let dynamics = TrafficDynamics::new(&mut world, &on_foot(10, People::default()), Seed(4)).unwrap();
        (world, dynamics)
    };
    let (mut world, mut dynamics) = make();
    let to = Some(Point2::new(60.0, 5.0));
    for step in 0..1500 {
        if step % 100 == 0 {
            let _ = dynamics.traffic_mut().add_walker(Point2::new(30.0, 5.0), to);
        }
        dynamics.step(&mut world, 0.1).unwrap();
        let present = dynamics.traffic().pedestrians().iter().filter(|walker| walker.is_present()).count();
        assert_eq!(world.len(), present, "at step {step}");
    }
    assert!(dynamics.traffic().counters().walkers_left > 5, "{:?}", dynamics.traffic().counters());
    let saved = dynamics.save().unwrap();
    let mut copy = world.clone();
    let mut resumed = make().1;
    resumed.restore(&copy, &saved).unwrap();
    for _ in 0..300 {
        dynamics.step(&mut world, 0.1).unwrap();
        resumed.step(&mut copy, 0.1).unwrap();
    }
    assert_eq!(dynamics.traffic().digest(), resumed.traffic().digest());
}

#[test]
fn those_of_a_party_stay_together() {
    let people = People { in_groups: 1.0, ..People::default() };
    let mut traffic = Traffic::new(grid(), &on_foot(60, people), Seed(8)).unwrap();
    let mut apart = Vec::new();
    for step in 0..3000 {
        traffic.step(0.1);
        if step % 50 == 0 && step > 100 {
            let walkers = traffic.pedestrians();
            for (index, walker) in walkers.iter().enumerate() {
                let first = &walkers[walker.party() as usize];
                if walker.party() as usize != index {
                    apart.push((walker.position - first.position).norm());
                }
            }
        }
    }
    apart.sort_by(f64::total_cmp);
    let (median, most) = (apart[apart.len() / 2], apart[apart.len() * 9 / 10]);
    println!("in a party {median:.2} m apart in the middle, {most:.2} m for nine of ten");
    assert!(median < 2.0 && most < 8.0, "{median} m and {most} m");
}

/// Walkers who begin to cross at red in ten minutes, and those who do at green.
fn crossings(jaywalking: f64) -> (u64, u64) {
    let network = grid();
    let people = People { jaywalking, ..People::default() };
    let config = TrafficConfig {
        vehicles: 25,
        pedestrians: 150,
        people,
        crossing_weight: 3.0,
        ..TrafficConfig::default()
    };
    let mut traffic =
        Traffic::new(Arc::clone(&network), &config, Seed(2)).expect("the settings are in range");
    let mut was_on = vec![None; 150];
    let (mut at_red, mut at_green) = (0, 0);
    for step in 0..6000 {
        let aspects = traffic.signals().to_vec();
        traffic.step(0.1);
        for (index, walker) in traffic.pedestrians().iter().enumerate() {
            if let Some(crossing) = walker.crossing().filter(|crossing| was_on[index] != Some(*crossing)) {
                let signal = network.crossings[crossing.index()].signal.expect("every crossing has a signal");
                let green = aspects[signal.index()] == Aspect::Green;
                at_green += u64::from(green);
                at_red += u64::from(!green);
            }
            was_on[index] = walker.crossing();
            let hit = walker.crossing().and_then(|_| {
                traffic.vehicles().find(|body| {
                    body.twist.ground_speed() > 0.5
                        && body.shape.planar_distance(&body.pose, &walker.position) < 0.15
                })
            });
            assert!(hit.is_none(), "walker {index} is hit by {hit:?} at step {step}");
        }
    }
    assert_eq!(traffic.counters().jaywalks, at_red);
    (at_red, at_green)
}

#[test]
fn some_cross_at_red_in_a_gap_and_none_who_would_not() {
    let (red, green) = crossings(0.0);
    assert_eq!(red, 0);
    let (more_red, fewer_green) = crossings(0.5);
    println!("{more_red} of {} crossings at red", more_red + fewer_green);
    assert!(more_red > 50 && fewer_green < green, "{more_red} at red, {fewer_green} after {green} at green");
}

/// A car of 4.5 by 1.8 m.
fn car(position: Point2, velocity: Vector2) -> Foreign {
    let direction = velocity.try_normalize(1e-9).unwrap_or_else(Vector2::x);
    Foreign { position, radius: 2.25, half_width: 0.9, direction, velocity, height: 0.0 }
}

/// A car goes to and fro over a crossing at a speed, whatever the signals say. Returns how many began to cross before it
/// when it could not stop, how many moved into its side as it passed, and how many crossed.
fn before_a_car(speed: f64) -> (u32, u32, u32) {
    let network = grid();
    let config = TrafficConfig { crossing_weight: 5.0, ..on_foot(400, People::default()) };
    let mut traffic =
        Traffic::new(Arc::clone(&network), &config, Seed(6)).expect("the settings are in range");
    let crossing = &network.crossings[0];
    let across = (crossing.end - crossing.start).normalize();
    let along = Vector2::new(-across.y, across.x);
    let middle = crossing.start + (crossing.end - crossing.start) * 0.5;
    let (mut stepped, mut walked_in, mut crossed) = (0, 0, 0);
    let mut before: Vec<(Point2, bool)> =
        traffic.pedestrians().iter().map(|walker| (walker.position, false)).collect();
    let round = (120.0 / speed) as u32;
    for step in 0..6000 {
        let s = f64::from(step % (10 * round)) * speed * 0.1 - 60.0;
        traffic.step_among(&[car(middle + along * s, along * speed)], 0.1);
        let center = middle + along * (s + speed * 0.1);
        let cannot_stop = s < 0.0 && -s < speed * speed / 6.0;
        for (walker, (place, was_on)) in traffic.pedestrians().iter().zip(&mut before) {
            let is_on = walker.crossing().is_some_and(|at| at.index() == 0);
            crossed += u32::from(is_on && !*was_on);
            stepped += u32::from(is_on && !*was_on && cannot_stop);
            // Beside it all the time, so that only its own way brings a walker nearer.
            let is_beside = |at: &Point2| (at - center).dot(&along).abs() < 2.25 - speed * 0.1 - 0.3;
            let side = |at: &Point2| (at - center).dot(&across).abs() - 0.9;
            let beside = is_beside(place) && is_beside(&walker.position);
            walked_in += u32::from(beside && side(place) > 0.15 - 1e-6 && side(&walker.position) < 0.14);
            (*place, *was_on) = (walker.position, is_on);
        }
    }
    println!("at {speed} m/s {stepped} of {crossed} stepped before it, {walked_in} into it");
    (stepped, walked_in, crossed)
}

#[test]
fn nobody_steps_before_a_car_that_does_not_stop_or_walks_into_it() {
    for speed in [10.0, 2.0] {
        let (stepped, walked_in, crossed) = before_a_car(speed);
        assert_eq!((stepped, walked_in), (0, 0), "of {crossed} at {speed} m/s");
        assert!(crossed > 20, "{crossed} crossed at {speed} m/s");
    }
}

#[test]
fn walkers_go_round_what_stands_on_their_way() {
    let network = grid();
    let mut traffic = Traffic::new(Arc::clone(&network), &on_foot(60, People::default()), Seed(6))
        .expect("the settings are in range");
    // A post on every sidewalk, a little beside its middle.
    let posts: Vec<Foreign> = network
        .sidewalks
        .iter()
        .map(|walk| {
            let middle = walk.path[0] + (walk.path[1] - walk.path[0]) * 0.5;
            Foreign::standing(middle, 0.15)
        })
        .collect();
    traffic.set_obstacles(&posts);
    let start: Vec<Point2> = traffic.pedestrians().iter().map(|walker| walker.position).collect();
    let clear =
        |at: &Point2| posts.iter().map(|post| (at - post.position).norm()).fold(f64::INFINITY, f64::min);
    let begun_clear: Vec<bool> = start.iter().map(|at| clear(at) > 0.3).collect();
    for step in 0..3000 {
        traffic.step(0.1);
        for (walker, _) in traffic.pedestrians().iter().zip(&begun_clear).filter(|(_, clear)| **clear) {
            let gap = clear(&walker.position);
            assert!(gap > 0.3 - 1e-6, "a walker is {gap} m from the middle of a post at step {step}");
        }
    }
    let moved = traffic.pedestrians().iter().zip(&start).filter(|(w, old)| (w.position - *old).norm() > 20.0);
    assert!(moved.count() > 50, "walkers are stuck at posts");
}

/// Runs a city of 500 walkers for three minutes, looks that all is as it should be, and returns how far they walked, m.
fn walked(interest: Option<Vec<Interest>>) -> f64 {
    let network = grid();
    let config = TrafficConfig { crossing_weight: 3.0, ..on_foot(500, People::default()) };
    let mut traffic =
        Traffic::new(Arc::clone(&network), &config, Seed(12)).expect("the settings are in range");
    traffic.set_interest(interest).expect("interest is in range");
    let apart = 2.0 * config.walking.radius;
    let mut before: Vec<Point2> = traffic.pedestrians().iter().map(|walker| walker.position).collect();
    let (mut sum, mut was_on) = (0.0, vec![None; 500]);
    for step in 0..1800 {
        let aspects = traffic.signals().to_vec();
        traffic.step(0.1);
        let mut places = Vec::new();
        for (index, walker) in traffic.pedestrians().iter().enumerate() {
            sum += (walker.position - before[index]).norm();
            before[index] = walker.position;
            places.push(walker.position);
            if let Some(crossing) = walker.crossing().filter(|crossing| was_on[index] != Some(*crossing)) {
                let signal = network.crossings[crossing.index()].signal.expect("every crossing has a signal");
                assert_eq!(aspects[signal.index()], Aspect::Green, "walker {index} at step {step}");
            }
            was_on[index] = walker.crossing();
        }
        places.sort_by(|a, b| a.x.total_cmp(&b.x));
        for (index, place) in places.iter().enumerate() {
            let near = places[index + 1..].iter().take_while(|other| other.x - place.x < apart);
            let gap = near.map(|other| (other - place).norm()).fold(f64::INFINITY, f64::min);
            assert!(gap > apart - 1e-6, "two walkers are {gap} m apart at step {step}");
        }
    }
    sum
}

#[test]
fn those_far_away_keep_apart_and_wait_as_well() {
    let near = walked(None);
    let half = walked(Some(vec![Interest { center: Point2::new(0.0, 110.0), radius: 110.0 }]));
    let far = walked(Some(Vec::new()));
    println!("500 walkers went {near:.0} m near, {half:.0} m half of them near, {far:.0} m far");
    // They get on as well: our tolerance is a twelfth.
    for other in [half, far] {
        assert!((other / near - 1.0).abs() < 1.0 / 12.0, "{near} m against {other} m");
    }
}

/// Those who begin on one walkway have numbers one after the other, parties whole.
#[test]
fn numbers_follow_the_walkways() {
    let config = on_foot(300, People { in_groups: 0.6, ..People::default() });
    let traffic = Traffic::new(grid(), &config, Seed(6)).unwrap();
    let starts: Vec<_> = traffic.pedestrians().iter().map(|walker| walker.way().0).collect();
    assert!(starts.is_sorted(), "{starts:?}");
    let parties: Vec<u32> = traffic.pedestrians().iter().map(Pedestrian::party).collect();
    assert!(parties.iter().zip(0..).filter(|(party, number)| *party != number).count() > 60, "{parties:?}");
    for (party, number) in parties.iter().zip(0..) {
        let first = *party as usize;
        assert!(first <= number && parties[first..=number].iter().all(|other| other == party), "{parties:?}");
    }
}
