//! Drives of people in vehicles of their own, and the choice between them, lines and one's feet.
//!
//! What is quickest is found as SUMO's intermodal router does: by free travel times, and with a vehicle of one's own from the very
//! beginning or not at all (SUMO user documentation, *Intermodal Routing*).

use simworld_core::geometry::Point2;
use simworld_core::net::RoadNetwork;

use super::itinerary::{Kerb, Stage};
use super::timetable::{Timetable, beside, driven, walk, walk_here};
use super::{Kerbs, VehicleChoice};
use crate::vehicle::{BEFORE_JUNCTION, VehicleType};
use crate::{Leg, Route, Router, Traffic, TrafficError};

/// A drive in a vehicle of one's own, which departs for it and is gone at its end.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// The way.
    pub route: Route,
    /// Where the vehicle pulls out, and where it parks.
    pub kerbs: Kerbs,
    /// The vehicle.
    pub vehicle: VehicleChoice,
    /// How long it takes on free roads, s.
    pub seconds: f64,
}

impl Drive {
    /// The quickest drive from one place to another in a vehicle of the table `types`, parked as near to them as it can be; where a leg is
    /// too short to park on, it enters at its beginning or leaves at its end. `None` if no way leads there, or the vehicle may not use
    /// where it begins or ends.
    pub fn quickest(
        network: &RoadNetwork,
        router: &Router,
        (from, to): (Kerb, Kerb),
        vehicle: VehicleChoice,
        types: &[VehicleType],
    ) -> Option<Self> {
        let rows = types.iter().enumerate().filter(|(index, row)| match vehicle {
            VehicleChoice::Kind(kind) => row.kind == kind,
            VehicleChoice::Type(wanted) => *index == wanted,
        });
        let rows: Vec<&VehicleType> = rows.map(|(_, row)| row).collect();
        let row = rows.first()?;
        let is_open = |(leg, _): Kerb| {
            leg.lanes(network).iter().any(|lane| row.kind.may_use(network.lanes[lane.index()].kind))
        };
        if !(is_open(from) && is_open(to)) {
            return None;
        }
        let route = router.quickest(from.0, to.0)?;
        let longest = rows.iter().map(|row| row.length).fold(0.0, f64::max);
        let parked = |(leg, station)| parking(network, leg, station, longest);
        let kerbs = Kerbs { from: parked(from), to: parked(to) };
        let is_behind = kerbs.to.is_some_and(|to| to < kerbs.from.unwrap_or(0.0) + 1.0);
        if route.0.len() == 1 && (is_behind || to.1 < from.1) {
            return None;
        }
        let fastest = row.driver.desired_speed;
        let seconds =
            seconds(network, router, (&route, kerbs), |limit| fastest.min(row.speed_factor * limit))?;
        Some(Self { route, kerbs, vehicle, seconds })
    }

    /// Where one gets in and where out.
    fn ends(&self, network: &RoadNetwork) -> Option<(Point2, Point2)> {
        let (first, last) = (*self.route.0.first()?, *self.route.0.last()?);
        let end = || last.lanes(network).last().map_or(0.0, |lane| network.lanes[lane.index()].length);
        let from = beside(network, (first, self.kerbs.from.unwrap_or(0.0)));
        Some((from, beside(network, (last, self.kerbs.to.unwrap_or_else(end)))))
    }

    /// Has the vehicle depart; gives its number among those who were sent.
    ///
    /// # Errors
    /// Those of [`Traffic::insert_between`] even without parking places, which may have gone where junctions were joined.
    pub(super) fn send(&self, traffic: &mut Traffic, since: f64) -> Result<u64, TrafficError> {
        let mut insert = |kerbs| traffic.insert_between(self.route.clone(), self.vehicle, since, kerbs);
        insert(self.kerbs).or_else(|_| insert(Kerbs::default()))
    }
}

/// The station nearest to one at which a vehicle can park, m; `None` if the leg is too short.
fn parking(network: &RoadNetwork, leg: Leg, station: f64, longest: f64) -> Option<f64> {
    let length = network.lanes[leg.lanes(network).last()?.index()].length;
    let (least, most) = (longest + 1.0, length - BEFORE_JUNCTION);
    (least <= most).then(|| station.clamp(least, most))
}

/// Free travel time of a route between stations, s, at the speed that the vehicle has where there is a limit.
fn seconds(
    network: &RoadNetwork,
    router: &Router,
    (route, kerbs): (&Route, Kerbs),
    speed: impl Fn(f64) -> f64,
) -> Option<f64> {
    let last = route.0.len() - 1;
    let mut sum = 0.0;
    for (index, leg) in route.0.iter().enumerate() {
        let limit = network.lanes[leg.lanes(network).last()?.index()].speed_limit;
        let from = kerbs.from.filter(|_| index == 0).unwrap_or(0.0);
        let to = kerbs.to.filter(|_| index == last).unwrap_or(f64::INFINITY);
        // The router's time is that of the way between them and of the next leg.
        let before = index.checked_sub(1).map(|before| Route(vec![route.0[before], *leg]));
        let between = match before {
            Some(pair) => (router.time(&pair)? - driven(network, *leg, 0.0, f64::INFINITY)?).max(0.0),
            None => 0.0,
        };
        sum += (between + driven(network, *leg, from, to)?) * limit / speed(limit);
    }
    Some(sum)
}

/// The stages of a trip by whatever is quickest: on foot, by lines if `public` says so, or by one of some drives.
pub(super) fn chosen(
    traffic: &Traffic,
    timetable: &Timetable,
    (from, to): (Point2, Point2),
    (public, drives): (bool, &[Drive]),
    at: f64,
) -> Vec<Stage> {
    let network = traffic.network();
    let afoot = if public {
        timetable.journey(from, to, at)
    } else {
        let mut stages = Vec::new();
        walk_here(&mut stages, from, to);
        (at + walk(from, to), stages)
    };
    let mut ways = vec![(afoot.0, afoot.1, None)];
    for drive in drives {
        let Some((depart, arrive)) = drive.ends(network) else { continue };
        let time = at + walk(from, depart) + drive.seconds + walk(arrive, to);
        ways.push((time, Vec::new(), Some((drive, depart, arrive))));
    }
    ways.sort_by(|a, b| a.0.total_cmp(&b.0));
    let can_walk = |stage: &Stage| match stage {
        Stage::Walk { from, to } => traffic.can_walk(*from, *to),
        _ => true,
    };
    let is_last = |index: usize| index + 1 == ways.len();
    let chosen = (0..ways.len()).find(|index| is_last(*index) || ways[*index].1.iter().all(can_walk));
    let Some((_, stages, drive)) = chosen.map(|index| &ways[index]) else { return Vec::new() };
    let Some((drive, depart, arrive)) = drive else { return stages.clone() };
    // Where nobody can walk one is at once.
    let mut stages = Vec::new();
    walk_here(&mut stages, from, *depart);
    stages.push(Stage::Drive((*drive).clone()));
    walk_here(&mut stages, *arrive, to);
    stages.retain(can_walk);
    stages
}
