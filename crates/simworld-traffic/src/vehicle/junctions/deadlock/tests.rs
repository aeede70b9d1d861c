//! Locks: what is seen of them, and that they come undone.

use super::*;
use crate::vehicle::tracks::conflicts::Conflict;

fn rings(edges: &[(Track, Track)]) -> Vec<Track> {
    let waiting = edges.iter().map(|edge| (edge.0, edge.1, 0)).collect();
    let mut waits = Waits { edges: waiting, ..Waits::default() };
    (0..edges.len()).filter_map(|start| waits.ring_from(start)).collect()
}

#[test]
fn locks_are_looked_for_in_every_second() {
    // A clock that counts microseconds makes the second of a tenth.
    for dt in [0.1, 100_000.0 * 1e-6, 0.04, 0.25, 1.0 / 3.0, 1.0 / 60.0] {
        let steps = (4000.5 / dt) as u64;
        let due: Vec<u64> = (0..steps).filter(|step| is_due(*step, dt, EVERY)).collect();
        assert_eq!(due.len(), 4000, "with steps of {dt} s");
        let apart = due.windows(2).map(|pair| (pair[1] - pair[0]) as f64 * dt);
        assert!(apart.clone().all(|apart| (apart - EVERY).abs() < 1.01 * dt), "with steps of {dt} s");
    }
}

#[test]
fn who_turns_at_random_is_not_sent_to_where_he_would_stand_for_good() {
    use simworld_core::geometry::Point2;
    use simworld_core::net::{CrossSection, NetworkConfig, RoadNetwork, Street, StreetPlan};

    let mut plan = StreetPlan::grid(2, 2, 100.0);
    let out = plan.add_section(CrossSection::two_way(1, 0));
    let (street, end) = (plan.streets.len() as u32, plan.nodes.len());
    plan.nodes.push(Point2::new(-100.0, 0.0));
    plan.streets.push(Street { section: out, ..Street::simple(0, end) });
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("it is a plan");
    let config = TrafficConfig::default();
    let tracks = Tracks::new(std::sync::Arc::new(network), &config);
    let mut vehicles = VehicleManager::new(&tracks);
    let leads_out = |way: &usize| tracks.network.lanes[tracks.lane_after(*way) as usize].road.0 == street;
    let way_out = (0..tracks.ways.len()).find(leads_out).expect("a way leads out");
    let lane = tracks.ways[way_out].from;
    let car = Vehicle::new(config.vehicle_type(0), 0, 1.0, 0, 20.0);
    vehicles.push(&tracks, lane, car, Path::new(lane, NONE, 0.0, 0.0));
    let outgoing = &tracks.network.lanes[lane as usize].outgoing;
    assert!(outgoing.len() > 1);
    for way in outgoing {
        let leads_home = vehicles.leads_home(&tracks, lane, way.0);
        assert_eq!(leads_home, way.index() != way_out, "way {}", way.0);
    }
}

#[test]
fn who_changes_out_of_a_lane_holds_up_who_changes_into_the_one_beyond() {
    use simworld_core::geometry::Point2;
    use simworld_core::net::{CrossSection, NetworkConfig, RoadNetwork, Street, StreetPlan};

    let nodes = vec![Point2::new(0.0, 0.0), Point2::new(100.0, 0.0)];
    let mut plan = StreetPlan { nodes, ..StreetPlan::default() };
    let section = plan.add_section(CrossSection::two_way(3, 0));
    plan.streets.push(Street { section, ..Street::simple(0, 1) });
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("it is a plan");
    let config = TrafficConfig::default();
    let tracks = Tracks::new(std::sync::Arc::new(network), &config);
    let mut vehicles = VehicleManager::new(&tracks);
    let middle = (0..3).find(|lane| !tracks.beside[*lane as usize].contains(&NONE)).expect("three lanes");
    let [left, right] = tracks.beside[middle as usize];
    // Both come from the middle: to the left at 40 m, to the right at 46 m.
    let put = |vehicles: &mut VehicleManager, id: u32, lane: Track, s: f64, shift: f32| {
        let car = Vehicle { shift, stood: 60.0, ..Vehicle::new(config.vehicle_type(0), 0, 1.0, id, s) };
        vehicles.push(&tracks, lane, car, Path::new(lane, NONE, 0.0, 0.0));
    };
    put(&mut vehicles, 0, left, 40.0, -2.0);
    let first = vehicles.queue(&tracks, left)[0];
    assert_eq!(vehicles.has_half_changed(&tracks, left, &first), None, "nobody is before it");
    put(&mut vehicles, 1, right, 46.0, 2.0);
    assert_eq!(vehicles.has_half_changed(&tracks, left, &first), Some(right));
}

/// Two parallel streets with cross streets between them on which a bus does not fit, and drivers without anybody.
fn near_junctions() -> (Tracks, TrafficConfig, VehicleManager) {
    use simworld_core::geometry::Point2;
    use simworld_core::net::{Street, StreetPlan};

    let mut plan = StreetPlan::default();
    for y in [0.0, 16.0] {
        plan.nodes.extend((0..3).map(|column| Point2::new(130.0 * f64::from(column), y)));
    }
    plan.streets.extend([0, 1, 3, 4].map(|node| Street::simple(node, node + 1)));
    plan.streets.extend((0..3).map(|node| Street::simple(node, node + 3)));
    plan.nodes.push(Point2::new(130.0, -100.0));
    plan.streets.push(Street::simple(1, 6));
    without_drivers(&plan)
}

#[test]
fn who_waits_for_the_rear_of_a_bus_behind_a_short_lane_waits_for_the_lane_of_its_front() {
    use super::super::trailing::Trail;

    let (tracks, config, mut vehicles) = near_junctions();
    let row = config.types.iter().position(|row| row.length > 11.0).expect("there are buses");
    let length = config.types[row].length;
    let is_short = |lane: Track| tracks.length[lane as usize] < 6.0;
    // Where the rear of a bus on a way is that has just come to the end of the lane behind it.
    let rear = |way: u32| {
        let after = tracks.lane_after(way as usize);
        tracks.length[tracks.lanes + way as usize] + tracks.length[after as usize] - length
    };
    let meets = |(way, other): &(usize, &Conflict)| {
        is_short(tracks.lane_after(other.way as usize))
            && (1.0..other.other.passed()).contains(&rear(other.way))
            && tracks.ways[*way].from != tracks.ways[other.way as usize].from
    };
    let mut pairs =
        (0..tracks.ways.len()).flat_map(|way| tracks.conflicts[way].iter().map(move |other| (way, other)));
    let (own, conflict) = pairs.find(meets).expect("ways into short lanes are met by others");
    let short = tracks.lane_after(conflict.way as usize);
    let exits = tracks.exits(short).iter().map(|exit| tracks.lane_after(exit.0 as usize));
    let beyond = exits.max_by_key(|lane| tracks.length[*lane as usize] as u32).expect("it leads on");
    let bus = |s: f64| {
        let bus = Vehicle::new(config.vehicle_type(row as u8), row as u8, 1.0, 0, s);
        Vehicle { stood: 60.0, ..bus }
    };
    vehicles.whereabouts.push(beyond);
    vehicles.push(&tracks, beyond, bus(3.0), Path::new(beyond, NONE, 0.0, 0.0));
    let lane = tracks.ways[own].from;
    let line = tracks.length[lane as usize] - 0.5;
    let car = Vehicle::new(config.vehicle_type(0), 0, 1.0, 1, line);
    let car = Vehicle { stood: 60.0, next: own as u32, ..car };
    vehicles.whereabouts.push(lane);
    vehicles.push(&tracks, lane, car, Path::new(lane, NONE, 0.0, 0.0));
    assert_eq!(vehicles.waits_behind(&tracks, &config, lane, &car), None, "nobody is in its way");
    let mut trails_at = |s: f64| {
        let bus = Vehicle { holding: conflict.way, ..bus(s) };
        vehicles.trails = vec![Trail::new(&bus, &Path::new(short, NONE, 0.0, 0.0), short)];
        vehicles.waits_behind(&tracks, &config, lane, &car)
    };
    let end = tracks.length[short as usize];
    assert_eq!(trails_at(end), Some(beyond));
    let passed = conflict.other.passed() - tracks.length[tracks.lanes + conflict.way as usize];
    assert_eq!(trails_at(length + passed + 0.1), None, "its rear is out of the way");
    // But it has the whole way to itself as long as it holds it.
    vehicles.junctions.grant(&tracks, &Vehicle { next: conflict.way, ..bus(end) }, &config);
    let mut trails_at = |s: f64| {
        let bus = Vehicle { holding: conflict.way, ..bus(s) };
        vehicles.trails = vec![Trail::new(&bus, &Path::new(short, NONE, 0.0, 0.0), short)];
        vehicles.waits_behind(&tracks, &config, lane, &car)
    };
    assert_eq!(trails_at(length + passed + 0.1), Some(beyond));
}

#[test]
fn a_bus_waits_for_all_who_hold_a_way_that_meets_its_own() {
    let (tracks, config, mut vehicles) = near_junctions();
    let bus = config.types.iter().position(|row| row.length > 11.0).expect("there are buses") as u8;
    let put = |vehicles: &mut VehicleManager, lane: Track, row: u8, next: u32, holding: u32, s: f64| {
        let id = vehicles.numbers() as u32;
        let one = Vehicle::new(config.vehicle_type(row), row, 1.0, id, s);
        vehicles.whereabouts.push(lane);
        let one = Vehicle { stood: 60.0, next, holding, ..one };
        vehicles.push(&tracks, lane, one, Path::new(lane, NONE, 0.0, 0.0));
        one
    };
    // Somebody stands at the beginning of the lane behind a way, with his rear on that and out of what another shares with it.
    let car = config.types[0].length;
    let is_out = |(way, other): &(usize, &Conflict)| {
        let end = tracks.length[tracks.lanes + other.way as usize];
        let rear = end + tracks.length[tracks.lane_after(other.way as usize) as usize].min(car) - 0.4 - car;
        tracks.ways[*way].from != tracks.ways[other.way as usize].from
            && tracks.lane_after(*way) != tracks.lane_after(other.way as usize)
            && rear > other.other.passed()
            && rear < end
            // Nor does it stand in what a third shares with both.
            && !tracks.tight[*way].contains(&other.way)
    };
    let mut pairs =
        (0..tracks.ways.len()).flat_map(|way| tracks.conflicts[way].iter().map(move |other| (way, other)));
    let (own, conflict) = pairs.find(is_out).expect("ways cross");
    let (lane, short) = (tracks.ways[own].from, tracks.lane_after(conflict.way as usize));
    let s = tracks.length[short as usize].min(car) - 0.4;
    put(&mut vehicles, short, 0, NONE, conflict.way, s);
    let line = tracks.length[lane as usize] - 0.5;
    let first = put(&mut vehicles, lane, 0, own as u32, NONE, line);
    assert_eq!(vehicles.waits_behind(&tracks, &config, lane, &first), None, "a car goes behind it");
    let length = config.types[usize::from(bus)].length as f32;
    let first = Vehicle { row: bus, length, ..first };
    assert_eq!(vehicles.waits_behind(&tracks, &config, lane, &first), Some(short));
}

#[test]
fn the_rear_of_a_car_beside_a_narrow_place_is_in_the_way_of_long_vehicles_alone() {
    let (tracks, config, mut vehicles) = near_junctions();
    let bus = config.types.iter().position(|row| row.length > 11.0).expect("there are buses") as u8;
    let stand =
        |row: u8, s: f64| Vehicle { stood: 60.0, ..Vehicle::new(config.vehicle_type(row), row, 1.0, 0, s) };
    // Two ways that a bus and a car do not use at a time, though cars do not meet on them; behind the other there is room for a car
    // whose rear is still on it.
    let is_beside = |(own, other): &(usize, usize)| {
        tracks.conflicts[*own].iter().all(|conflict| conflict.way as usize != *other)
            && tracks.ways[*own].from != tracks.ways[*other].from
            && tracks.length[tracks.lane_after(*other) as usize] > 2.0
    };
    let mut pairs = (0..tracks.ways.len())
        .flat_map(|own| tracks.tight[own].iter().map(move |other| (own, *other as usize)));
    let (own, other) = pairs.find(is_beside).expect("narrow places");
    let put = |vehicles: &mut VehicleManager, lane: Track, one: Vehicle| {
        let one = Vehicle { id: vehicles.numbers() as u32, ..one };
        vehicles.whereabouts.push(lane);
        vehicles.push(&tracks, lane, one, Path::new(lane, NONE, 0.0, 0.0));
        one
    };
    let behind = tracks.lane_after(other);
    put(&mut vehicles, behind, Vehicle { holding: other as u32, ..stand(0, 1.5) });
    let lane = tracks.ways[own].from;
    let line = tracks.length[lane as usize] - 0.5;
    let car = put(&mut vehicles, lane, Vehicle { next: own as u32, ..stand(0, line) });
    assert_eq!(vehicles.waits_behind(&tracks, &config, lane, &car), None, "a car goes beside it");
    let longer = Vehicle { row: bus, length: config.types[usize::from(bus)].length as f32, ..car };
    assert_eq!(vehicles.waits_behind(&tracks, &config, lane, &longer), Some(behind), "a bus does not");
    // Nor does the car while somebody long holds the other way.
    vehicles.junctions.grant(&tracks, &Vehicle { next: other as u32, ..stand(bus, 0.0) }, &config);
    assert_eq!(vehicles.waits_behind(&tracks, &config, lane, &car), Some(behind));
}

#[test]
fn who_needs_the_permit_of_one_on_a_way_waits_for_that_for_which_he_stands() {
    use super::super::clusters::Permit;

    let (tracks, config, mut vehicles) = near_junctions();
    let car = |id, s| Vehicle { stood: 60.0, ..Vehicle::new(config.vehicle_type(0), 0, 1.0, id, s) };
    let cluster = |way: usize| tracks.clusters.of(&tracks, tracks.lane_after(way), &car(0, 0.0));
    let others = |way: &usize| {
        let is_other = |other: &usize| {
            tracks.ways[*other].from != tracks.ways[*way].from
                && tracks.ways[*other].to != tracks.ways[*way].to
        };
        let mut same = (0..tracks.ways.len()).filter(|other| cluster(*other) == cluster(*way));
        cluster(*way).is_some().then(|| same.find(is_other)).flatten()
    };
    let (own, other) =
        (0..tracks.ways.len()).find_map(|way| Some((way, others(&way)?))).expect("clusters have many ways");
    let (lane, on_way) = (tracks.ways[own].from, (tracks.lanes + other) as Track);
    let first = Vehicle { next: own as u32, ..car(1, tracks.length[lane as usize] - 0.5) };
    let holder = Vehicle { next: other as u32, holding: other as u32, ..car(0, 2.0) };
    for (track, vehicle) in [(on_way, holder), (lane, first)] {
        vehicles.whereabouts.push(track);
        vehicles.push(&tracks, track, vehicle, Path::new(track, NONE, 0.0, 0.0));
    }
    assert_eq!(vehicles.holder_of_permit(&tracks, &first), None, "nobody has it");
    vehicles.permits.push(Permit::new(0, cluster(own).expect("it is one")));
    assert_eq!(vehicles.holder_of_permit(&tracks, &first), Some(tracks.lane_after(other)));
    vehicles.both_mut(&tracks, on_way).0[0].v = 1.0;
    assert_eq!(vehicles.holder_of_permit(&tracks, &first), None, "he goes");
}

/// The tracks of a plan whose near junctions are not joined, and nobody on them.
fn without_drivers(plan: &simworld_core::net::StreetPlan) -> (Tracks, TrafficConfig, VehicleManager) {
    use simworld_core::net::{NetworkConfig, RoadNetwork};

    let network = RoadNetwork::derive(plan, &NetworkConfig::default()).expect("it is a plan");
    let config = TrafficConfig { join_nearer: 0.0, ..TrafficConfig::default() };
    let tracks = Tracks::new(std::sync::Arc::new(network), &config);
    let vehicles = VehicleManager::new(&tracks);
    (tracks, config, vehicles)
}

/// Three junctions in a row with less than a car between them, and drivers without anybody.
fn near_junctions_in_a_row() -> (Tracks, TrafficConfig, VehicleManager) {
    use simworld_core::geometry::Point2;
    use simworld_core::net::{Street, StreetPlan};

    let mut plan = StreetPlan::default();
    plan.nodes.extend([-100.0, 0.0, 16.0, 32.0, 132.0].map(|x| Point2::new(x, 0.0)));
    plan.streets.extend((0..4).map(|node| Street::simple(node, node + 1)));
    plan.nodes.extend([0.0, 16.0, 32.0].map(|x| Point2::new(x, 100.0)));
    plan.streets.extend((1..4).map(|node| Street::simple(node, node + 4)));
    without_drivers(&plan)
}

#[test]
fn who_has_a_permit_lets_out_first_who_was_let_in_after_him() {
    use simworld_core::net::{Alone, Aspect};
    use simworld_core::seed::Seed;

    use super::super::clusters::Permit;
    use crate::vehicle::scene::Sight;

    let (tracks, config, mut vehicles) = near_junctions_in_a_row();
    let car = |id, s| Vehicle { stood: 60.0, ..Vehicle::new(config.vehicle_type(0), 0, 1.0, id, s) };
    let is_inside = |lane: Track| tracks.clusters.of(&tracks, lane, &car(0, 0.0)).is_some();
    let leads_on = |way: &usize| is_inside(tracks.ways[*way].from) && is_inside(tracks.lane_after(*way));
    let own = (0..tracks.ways.len()).find(leads_on).expect("short lanes lead into one another");
    let (lane, after) = (tracks.ways[own].from, tracks.lane_after(own));
    let road = |lane: Track| tracks.network.lanes[lane as usize].road;
    let is_opposite = |other: &Track| road(*other) == road(lane) && *other != lane;
    let opposite = (0..tracks.lanes as Track).find(is_opposite).expect("it is a two-way street");
    let put = |vehicles: &mut VehicleManager, lane: Track, id: u32, next: u32| {
        let one = Vehicle { next, ..car(id, tracks.length[lane as usize] - 0.5) };
        vehicles.whereabouts.push(lane);
        vehicles.storage.add(lane, &one, &config);
        vehicles.push(&tracks, lane, one, Path::new(lane, NONE, 0.0, 0.0));
        one
    };
    let first = put(&mut vehicles, lane, 0, own as u32);
    put(&mut vehicles, opposite, 1, NONE);
    let cluster = tracks.clusters.of(&tracks, after, &first).expect("it is one");
    let mut counters = Counters::default();
    let mut step = 0_u32;
    let mut go = |vehicles: &mut VehicleManager, permits: &[u32]| {
        vehicles.permits = permits.iter().map(|id| Permit::new(*id, cluster)).collect();
        let (aspects, shown) = ([Aspect::Green; 64], [9.0; 64]);
        let sight =
            Sight { aspects: &aspects, shown: &shown, walkers: &[0; 64], waiting: &[0; 64], obstacles: &[] };
        for _ in 0..5 {
            let at = Moment { now: f64::from(step) * 0.1, dt: 0.1, step: u64::from(step) };
            vehicles.step(&tracks, &config, Seed(1).stream("cars"), sight, at, &mut counters, &Alone);
            step += 1;
        }
        vehicles.queue(&tracks, lane).first().is_none_or(has_leave)
    };
    assert!(!go(&mut vehicles, &[0, 1]), "the other is still there");
    let first = vehicles.queue(&tracks, lane)[0];
    assert_eq!(vehicles.waits_behind(&tracks, &config, lane, &first), Some(opposite), "a lock is seen");
    assert!(go(&mut vehicles, &[1, 0]), "the other came first");
}

#[test]
fn nobody_is_let_in_who_would_take_the_room_of_one_who_has_stood_too_long_for_it() {
    let (tracks, config, mut vehicles) = near_junctions_in_a_row();
    let car = |id, s| Vehicle::new(config.vehicle_type(0), 0, 1.0, id, s);
    let is_inside = |lane: Track| tracks.clusters.of(&tracks, lane, &car(0, 0.0)).is_some();
    let enters = |way: &usize| !is_inside(tracks.ways[*way].from) && is_inside(tracks.lane_after(*way));
    // Of the lanes behind the last junction of the row: one behind those in between, to which a side street leads as well.
    let leaves = |way: &usize| is_inside(tracks.ways[*way].from) && !is_inside(tracks.lane_after(*way));
    let node = |lane: Track| tracks.network.lanes[lane as usize].to;
    let meets = |way: &usize, other: &usize| {
        let (own, lane) = (tracks.lane_after(*other), tracks.ways[*other].from);
        own == tracks.lane_after(*way) && !is_inside(lane) && lane != tracks.ways[*way].from
    };
    let (own, other) = (0..tracks.ways.len())
        .filter(leaves)
        .find_map(|way| {
            let other = (0..tracks.ways.len()).find(|other| meets(&way, other))?;
            let before = |own: &usize| enters(own) && tracks.lane_after(*own) == tracks.ways[way].from;
            let own = (0..tracks.ways.len()).find(before)?;
            (node(tracks.ways[own].from) != node(tracks.ways[other].from)).then_some((own, other))
        })
        .expect("a side street leads to where those go who come through");
    let mut put = |way: usize, stood: f64| {
        let (id, lane) = (vehicles.numbers() as u32, tracks.ways[way].from);
        let s = tracks.length[lane as usize] - 0.5;
        let one = Vehicle { next: way as u32, stood, ..car(id, s) };
        vehicles.whereabouts.push(lane);
        vehicles.push(&tracks, lane, one, Path::new(lane, NONE, 0.0, 0.0));
        (lane, one)
    };
    let ((_, asks), (side, _)) = (put(own, PATIENT * 0.25), put(other, PATIENT * 1.5));
    let cluster = tracks.clusters.of(&tracks, tracks.lane_after(own), &asks).expect("it is one");
    let let_in = |vehicles: &mut VehicleManager| {
        vehicles.permits.clear();
        vehicles.wishes.push(Wish::new(cluster, &asks));
        vehicles.give_permits(&tracks, &config, 0.1);
        !vehicles.permits.is_empty()
    };
    assert!(!let_in(&mut vehicles), "the room is kept");
    assert_eq!(vehicles.holder_of_permit(&tracks, &asks), Some(side), "a lock is seen");
    vehicles.both_mut(&tracks, side).0[0].stood = PATIENT * 0.5;
    assert!(let_in(&mut vehicles), "nobody has stood too long");
    assert_eq!(vehicles.holder_of_permit(&tracks, &asks), None);
}

#[test]
fn a_ring_of_short_lanes_keeps_a_place_free() {
    use simworld_core::geometry::{Point2, direction};
    use simworld_core::net::{CrossSection, NetworkConfig, RoadNetwork, Street, StreetPlan};

    let around = |radius: f64| {
        let mut plan = StreetPlan::default();
        let section = plan.add_section(CrossSection::plain(1, 0, 4.5, 0.0));
        let at = |index: usize, far: f64| {
            Point2::origin() + direction(index as f64 * std::f64::consts::TAU / 3.0) * far
        };
        plan.nodes.extend((0..3).map(|index| at(index, radius)));
        plan.nodes.extend((0..3).map(|index| at(index, 150.0)));
        for index in 0..3 {
            let ring = Street::simple(index, (index + 1) % 3);
            plan.streets.push(Street { section, roundabout: true, ..ring });
            plan.streets.push(Street::simple(index, index + 3));
        }
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("it is a plan");
        let config = TrafficConfig { join_nearer: 0.0, ..TrafficConfig::default() };
        let tracks = Tracks::new(std::sync::Arc::new(network), &config);
        let vehicles = VehicleManager::new(&tracks);
        (tracks, config, vehicles)
    };
    let (tracks, config, mut vehicles) = around(12.0);
    let car = |id, s| Vehicle::new(config.vehicle_type(0), 0, 1.0, id, s);
    let enters = |way: &usize| {
        tracks.is_in_ring(tracks.lane_after(*way)) && !tracks.is_in_ring(tracks.ways[*way].from)
    };
    let mut from: Vec<Track> = Vec::new();
    for way in (0..tracks.ways.len()).filter(enters) {
        let lane = tracks.ways[way].from;
        let one = Vehicle { next: way as u32, ..car(from.len() as u32, tracks.length[lane as usize] - 0.5) };
        vehicles.whereabouts.push(lane);
        vehicles.push(&tracks, lane, one, Path::new(lane, NONE, 0.0, 0.0));
        let cluster = tracks.clusters.entered_by(&tracks, way as u32, &one).expect("the ring is one");
        assert_eq!(tracks.clusters.places(cluster), Some(2));
        vehicles.wishes.push(Wish::new(cluster, &one));
        from.push(lane);
    }
    assert_eq!(from.len(), 3, "each arm leads in");
    vehicles.give_permits(&tracks, &config, 0.1);
    let let_in = |vehicles: &VehicleManager| -> Vec<u32> {
        vehicles.permits.iter().map(super::super::clusters::Permit::id).collect()
    };
    assert_eq!(let_in(&vehicles), [0, 1]);
    // Who is longer than a car takes two places, and nobody takes the first of them before him.
    let bus = config.types.iter().map(|row| row.length as f32).fold(0.0, f32::max);
    for (long, expected) in [(0, vec![0]), (1, vec![0]), (2, vec![0, 1])] {
        let mut vehicles = vehicles.clone();
        vehicles.permits.clear();
        vehicles.wishes = from
            .iter()
            .zip(0..)
            .map(|(lane, id)| {
                let first = &mut vehicles.both_mut(&tracks, *lane).0[0];
                first.length = if id == long { bus } else { car(id, 0.0).length };
                Wish::new(tracks.clusters.entered_by(&tracks, first.next, first).expect("it leads in"), first)
            })
            .collect();
        vehicles.give_permits(&tracks, &config, 0.1);
        assert_eq!(let_in(&vehicles), expected, "the bus is {long}");
    }
    let inside =
        |way: &usize| [tracks.ways[*way].from, tracks.lane_after(*way)].map(|lane| tracks.is_in_ring(lane));
    let round = (0..tracks.ways.len()).find(|way| inside(way) == [true; 2]).expect("it leads round");
    assert_eq!(
        tracks.clusters.entered_by(&tracks, round as u32, &car(0, 0.0)),
        None,
        "who is in there goes on"
    );
    let (tracks, config, _) = around(40.0);
    let car = Vehicle::new(config.vehicle_type(0), 0, 1.0, 0, 0.0);
    let needed = |way: u32| tracks.clusters.entered_by(&tracks, way, &car);
    assert!((0..tracks.ways.len() as u32).all(|way| needed(way).is_none()), "there is room on each lane");
}

#[test]
fn every_ring_is_found_once() {
    // Two rings, 0-1-2 and 5-6, a tail 3-4 into the first, and 8 that waits for a lane which moves.
    let edges = [(0, 1), (1, 2), (2, 0), (3, 4), (4, 1), (5, 6), (6, 5), (8, 9)];
    assert_eq!(rings(&edges), [0, 5]);
    assert_eq!(rings(&[(1, 2), (2, 3), (3, 2)]), [2]);
    assert_eq!(rings(&[(1, 2), (2, 3)]), []);
    assert_eq!(rings(&[(7, 7)]), [7]);
}
