//! Demand from data: as many depart as the matrix says, when the profile says; people live their days in order.

use std::sync::Arc;

use simworld_core::id::RoadId;
use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{
    Activity, ActivityChains, DayTimes, Leg, OdMatrix, Person, Router, Schedule, TimeProfile, Traffic,
    TrafficConfig, Zone, commuters,
};

fn city() -> Arc<RoadNetwork> {
    Arc::new(RoadNetwork::derive(&StreetPlan::grid(4, 4, 150.0), &NetworkConfig::default()).unwrap())
}

fn empty(network: &Arc<RoadNetwork>) -> Traffic {
    let config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    Traffic::new(Arc::clone(network), &config, Seed(5)).unwrap()
}

fn leg(road: u32) -> Leg {
    Leg::new(RoadId(road), LaneDirection::Forward)
}

#[test]
fn as_many_depart_as_the_matrix_says_and_when_the_profile_says() {
    let network = city();
    let router = Router::new(&network);
    let zones = (0..3).map(|zone| Zone {
        name: format!("z{zone}"),
        legs: vec![(leg(zone * 5), 1.0), (leg(zone * 5 + 1), 2.0)],
    });
    let mut matrix = OdMatrix::new(zones.collect());
    for (from, to, trips) in [(0, 1, 900.0), (0, 2, 400.0), (2, 0, 1600.0)] {
        matrix.set(from, to, trips).unwrap();
    }
    let profile = TimeProfile::new(vec![(600.0, 1.0), (1800.0, 3.0), (2400.0, 0.0)], 3000.0).unwrap();
    let mut early = 0;
    let mut total = 0;
    for seed in 0..20 {
        let mut schedule = Schedule::new(Seed(seed));
        let lost = matrix.depart(&profile, Seed(seed), &mut schedule, |from, to| router.quickest(from, to));
        assert_eq!(lost, 0, "every leg of the grid leads to every other");
        total += schedule.len();
        let mut traffic = empty(&network);
        while traffic.seconds() < 1800.0 {
            schedule.feed(&mut traffic).unwrap();
            traffic.step(100.0);
            if traffic.seconds() <= 600.0 {
                assert_eq!(
                    traffic.outside() + traffic.vehicles().count(),
                    0,
                    "nobody before the profile begins"
                );
            }
        }
        schedule.feed(&mut traffic).unwrap();
        early += traffic.counters().entered as usize + traffic.outside();
    }
    // Sums of Poisson counts: within four standard deviations, over 20 seeds.
    let expected = 20.0 * matrix.total();
    assert!((total as f64 - expected).abs() < 4.0 * expected.sqrt(), "{total} for {expected}");
    let share = profile.share(0.0, 1800.0);
    assert_eq!(share, 0.4);
    assert!((early as f64 - share * expected).abs() < 4.0 * (share * expected).sqrt(), "{early} early");
}

#[test]
fn the_same_seed_departs_the_same_and_a_zone_is_used_by_its_weights() {
    let network = city();
    let router = Router::new(&network);
    let zones = vec![
        Zone { name: "a".into(), legs: vec![(leg(0), 1.0), (leg(1), 3.0)] },
        Zone { name: "b".into(), legs: vec![(leg(12), 1.0)] },
    ];
    let mut matrix = OdMatrix::new(zones);
    matrix.set(0, 1, 4000.0).unwrap();
    let profile = TimeProfile::even(0.0, 3600.0).unwrap();
    let begun = |seed: u64| {
        let mut from: Vec<Leg> = Vec::new();
        let mut schedule = Schedule::new(Seed(seed));
        matrix.depart(&profile, Seed(seed), &mut schedule, |a, b| {
            from.push(a);
            router.quickest(a, b)
        });
        from
    };
    let first = begun(1);
    assert_eq!(first, begun(1));
    assert_ne!(first, begun(2));
    let share = first.iter().filter(|from| **from == leg(1)).count() as f64 / first.len() as f64;
    assert!((share - 0.75).abs() < 4.0 * (0.75 * 0.25 / first.len() as f64).sqrt(), "{share}");
}

#[test]
fn people_live_their_days_in_order() {
    let network = city();
    let router = Router::new(&network);
    let mut traffic = empty(&network);
    let stay = Activity::new;
    let chain = vec![
        stay(leg(0), 0.0, 60.0),
        stay(leg(9), 120.0, 0.0),
        stay(leg(9), 30.0, 0.0),
        stay(leg(3), 0.0, 900.0),
        stay(leg(0), 0.0, 0.0),
    ];
    let people = vec![Person { name: "ann".into(), vehicle: VehicleKind::Car.into(), chain }];
    let mut chains = ActivityChains::new(people);
    let (mut scheduled, mut left, mut stays) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..15_000 {
        chains.feed(&mut traffic, |from, to| router.quickest(from, to)).unwrap();
        traffic.step(0.1);
        chains.follow(&traffic, None);
        scheduled.extend(traffic.ended().iter().map(|trip| trip.scheduled));
        left.extend(traffic.ended().iter().map(|trip| trip.left));
        if stays.last() != Some(&chains.stay_of(0)) {
            stays.push(chains.stay_of(0));
        }
    }
    assert_eq!(chains.stranded(), 0);
    // The second and the third are at one place: between them nobody drives.
    let stays: Vec<Option<usize>> = stays.into_iter().filter(|stay| *stay != Some(1)).collect();
    assert_eq!(stays, [Some(0), None, Some(2), None, Some(3), None, Some(4)]);
    // Off at one minute; two stays at one place after another; no sooner than at 900 s.
    assert_eq!(scheduled.len(), 3);
    assert_eq!(scheduled[0], 60.0);
    assert!((scheduled[1] - (left[0] + 150.0)).abs() < 1e-6, "{scheduled:?} {left:?}");
    assert_eq!(scheduled[2], 900.0_f64.max(left[1]));
}

#[test]
fn commuters_go_to_work_in_the_morning_and_home_in_the_evening() {
    let (homes, works, shops) = ([leg(0), leg(1), leg(2)], [leg(20), leg(21)], [leg(10)]);
    let times = DayTimes::default();
    let people = commuters(2000, (&homes, &works, &shops), &times, Seed(8));
    assert_eq!(people, commuters(2000, (&homes, &works, &shops), &times, Seed(8)));
    assert_eq!(people.len(), 2000);
    let mean = people.iter().map(|person| person.chain[0].until).sum::<f64>() / 2000.0;
    assert!((mean - times.to_work.0).abs() < 4.0 * times.to_work.1 / 2000.0_f64.sqrt(), "{mean}");
    let shoppers = people.iter().filter(|person| person.chain.len() == 4).count() as f64 / 2000.0;
    assert!((shoppers - times.shoppers).abs() < 0.05, "{shoppers}");
    for person in &people {
        let (first, last) = (person.chain[0].place, person.chain[person.chain.len() - 1].place);
        assert!(first == last && homes.contains(&first) && works.contains(&person.chain[1].place));
    }
    assert!(commuters(3, (&[], &works, &shops), &times, Seed(8)).is_empty(), "nobody lives nowhere");
}

#[test]
fn what_cannot_be_is_refused() {
    assert!(TimeProfile::new(vec![(0.0, 1.0), (0.0, 1.0)], 10.0).is_err());
    assert!(TimeProfile::new(vec![(0.0, -1.0)], 10.0).is_err());
    assert!(TimeProfile::new(vec![(0.0, 0.0)], 10.0).is_err());
    assert!(TimeProfile::even(5.0, f64::NAN).is_err());
    let mut matrix = OdMatrix::new(Vec::new());
    assert!(matrix.set(0, 0, 1.0).is_err());
    assert_eq!((matrix.get(3, 4), matrix.total()), (0.0, 0.0));
}

/// Who enters comes as fast as those before go, so that a lane takes at its beginning what it can carry: 1100 an hour before, when
/// everybody squeezed in behind the last at a walk.
#[test]
fn a_lane_takes_at_its_beginning_what_it_carries() {
    let plan = StreetPlan::crossroads(400.0);
    let network = Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap());
    let mut traffic = empty(&network);
    let route = Router::new(&network);
    let inwards = Leg::new(RoadId(0), LaneDirection::Backward);
    let route = route.quickest(inwards, leg(2)).expect("it leads straight on");
    for _ in 0..600 {
        traffic.insert(route.clone(), VehicleKind::Car).unwrap();
    }
    let mut fastest = 0.0_f64;
    while traffic.seconds() < 60.0 {
        traffic.step(0.1);
        fastest = traffic.stations().map(|(_, _, _, v)| v).fold(fastest, f64::max);
    }
    let flow = traffic.counters().entered as f64 * 60.0;
    assert!(flow > 1500.0 && flow < 2300.0, "{flow} an hour");
    assert!(fastest > 8.0, "{fastest} m/s at most");
}
