//! Origin-destination matrices: how many go from zone to zone, and when.

use simworld_core::seed::{Seed, StreamRng};

use super::{Departing, Schedule, VehicleChoice};
use crate::vehicle::VehicleKind;
use crate::{Leg, Route, TrafficError};

/// A part of the city where trips begin and end.
#[derive(Clone, Debug, PartialEq)]
pub struct Zone {
    /// Its name.
    pub name: String,
    /// Legs on which its trips begin and end, with their weights.
    pub legs: Vec<(Leg, f64)>,
}

/// When people depart: shares of the trips by time, even within each span.
///
/// ```
/// use simworld_traffic::TimeProfile;
/// // An hour in which the middle half hour is twice as busy.
/// let peak = TimeProfile::new(vec![(0.0, 1.0), (900.0, 2.0), (2700.0, 1.0)], 3600.0)?;
/// assert_eq!(peak.share(900.0, 2700.0), 2.0 / 3.0);
/// # Ok::<(), simworld_traffic::TrafficError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TimeProfile {
    /// Where each span begins, s, and how busy it is.
    spans: Vec<(f64, f64)>,
    end: f64,
}

impl TimeProfile {
    /// Spans that begin at these times, s, each as busy as its weight, up to an end.
    ///
    /// # Errors
    /// Times that do not ascend up to the end, or weights of which none is positive.
    pub fn new(spans: Vec<(f64, f64)>, end: f64) -> Result<Self, TrafficError> {
        let refused = |field, value, allowed| Err(TrafficError::Config { field, value, allowed });
        let times = || spans.iter().map(|span| span.0).chain([end]);
        if let Some((_, late)) =
            times().zip(times().skip(1)).find(|(early, late)| !(early < late && *early >= 0.0))
        {
            return refused("profile", late, "times from 0 on that ascend");
        }
        if let Some((_, weight)) = spans.iter().find(|(_, weight)| !(0.0..=1e9).contains(weight)) {
            return refused("profile (a weight)", *weight, "weights of 0 or more");
        }
        let profile = Self { spans, end };
        let total = profile.weight(0.0, end);
        if !(total > 0.0 && total.is_finite()) {
            return refused("profile (its sum)", total, "at least one positive weight");
        }
        Ok(profile)
    }

    /// The same all the time between two times, s.
    ///
    /// # Errors
    /// Times that do not ascend.
    pub fn even(from: f64, until: f64) -> Result<Self, TrafficError> {
        Self::new(vec![(from, 1.0)], until)
    }

    /// Weight times seconds between two times.
    fn weight(&self, from: f64, until: f64) -> f64 {
        self.pieces().map(|(start, end, weight)| weight * (end.min(until) - start.max(from)).max(0.0)).sum()
    }

    /// The share of all trips that depart between two times.
    pub fn share(&self, from: f64, until: f64) -> f64 {
        self.weight(from, until) / self.weight(0.0, self.end)
    }

    fn pieces(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let ends = self.spans.iter().skip(1).map(|span| span.0).chain([self.end]);
        self.spans.iter().zip(ends).map(|((start, weight), end)| (*start, end, *weight))
    }
}

/// How many go from each zone to each other, and in what.
///
/// ```
/// use std::sync::Arc;
/// use simworld_core::id::RoadId;
/// use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
/// use simworld_core::seed::Seed;
/// use simworld_traffic::{Leg, OdMatrix, Router, Schedule, TimeProfile, Zone};
/// let network = RoadNetwork::derive(&StreetPlan::crossroads(200.0), &NetworkConfig::default())?;
/// let zone = |name: &str, road| Zone {
///     name: name.into(),
///     legs: [LaneDirection::Forward, LaneDirection::Backward].map(|way| (Leg::new(RoadId(road), way), 1.0)).into(),
/// };
/// let mut matrix = OdMatrix::new(vec![zone("west", 2), zone("east", 0)]);
/// matrix.set(0, 1, 120.0)?;
/// let (router, mut schedule) = (Router::new(&network), Schedule::new(Seed(1)));
/// let lost = matrix.depart(&TimeProfile::even(0.0, 3600.0)?, Seed(1), &mut schedule, |from, to| router.quickest(from, to));
/// assert!(schedule.len() + lost > 80 && lost < 120);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct OdMatrix {
    zones: Vec<Zone>,
    /// A row an origin.
    trips: Vec<f64>,
    /// What they drive.
    pub vehicle: VehicleChoice,
}

impl OdMatrix {
    /// No trips between zones.
    pub fn new(zones: Vec<Zone>) -> Self {
        Self { trips: vec![0.0; zones.len() * zones.len()], zones, vehicle: VehicleKind::default().into() }
    }

    /// The zones.
    pub fn zones(&self) -> &[Zone] {
        &self.zones
    }

    /// Trips from one zone to another; 0 for zones that are not there.
    pub fn get(&self, from: usize, to: usize) -> f64 {
        let is_there = from < self.zones.len() && to < self.zones.len();
        if is_there { self.trips[from * self.zones.len() + to] } else { 0.0 }
    }

    /// Says how many go from one zone to another.
    ///
    /// # Errors
    /// Zones that are not there, or a number below nothing or above 1e7.
    pub fn set(&mut self, from: usize, to: usize, trips: f64) -> Result<(), TrafficError> {
        let last = self.zones.len() as f64 - 1.0;
        let checks = [
            ("from", from as f64, last, "the index of a zone"),
            ("to", to as f64, last, "the index of a zone"),
            ("trips", trips, 1e7, "0 to 10 000 000"),
        ];
        for (field, value, high, allowed) in checks {
            if !(0.0..=high).contains(&value) {
                return Err(TrafficError::Config { field, value, allowed });
            }
        }
        let count = self.zones.len();
        self.trips[from * count + to] = trips;
        Ok(())
    }

    /// All trips.
    pub fn total(&self) -> f64 {
        self.trips.iter().sum()
    }

    /// Draws departures, at random and independent of one another (a Poisson process with the rates of the profile), and
    /// adds them to a schedule as `from>to.0` and so on, each on the route that `find` gives. Returns how many have none.
    pub fn depart(
        &self,
        profile: &TimeProfile,
        seed: Seed,
        schedule: &mut Schedule,
        mut find: impl FnMut(Leg, Leg) -> Option<Route>,
    ) -> usize {
        let stream = seed.stream("traffic/matrix");
        let mut lost = 0;
        for (from, origin) in self.zones.iter().enumerate() {
            for (to, goal) in self.zones.iter().enumerate() {
                let mut rng = stream.indexed(from as u64).indexed(to as u64).rng();
                let mut number = 0;
                for depart in times(profile, self.get(from, to), &mut rng) {
                    let ends = (draw(origin, &mut rng), draw(goal, &mut rng));
                    let route = ends.0.zip(ends.1).and_then(|(from, to)| find(from, to));
                    let Some(route) = route else {
                        lost += 1;
                        continue;
                    };
                    let name = format!("{}>{}.{number}", origin.name, goal.name);
                    schedule.add(Departing::new(name, depart, route, self.vehicle));
                    number += 1;
                }
            }
        }
        lost
    }
}

/// When so many trips depart, ascending.
fn times(profile: &TimeProfile, trips: f64, rng: &mut StreamRng) -> Vec<f64> {
    let mut times = Vec::new();
    for (start, end, _) in profile.pieces() {
        let rate = trips * profile.share(start, end) / (end - start);
        if rate <= 0.0 {
            continue;
        }
        let mut at = start + rng.exponential(rate);
        while at < end {
            times.push(at);
            at += rng.exponential(rate);
        }
    }
    times
}

fn draw(zone: &Zone, rng: &mut StreamRng) -> Option<Leg> {
    let weights: Vec<f64> = zone.legs.iter().map(|(_, weight)| *weight).collect();
    zone.legs.get(rng.weighted(&weights)?).map(|(leg, _)| *leg)
}
