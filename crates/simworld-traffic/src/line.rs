//! Lines: vehicles that stop on their way, at their stops and by their timetable.

use serde::{Deserialize, Serialize};
use simworld_core::net::RoadNetwork;

use crate::vehicle::VehicleKind;
use crate::{Arrivals, Flow, Leg, Route, TrafficError};

/// A stop on the way: of a bus for its passengers, or of a van that stands in the road to deliver.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stop {
    /// The leg on which it is; vehicles stop on its outermost lane, if they get there in time.
    pub leg: Leg,
    /// Where the front stands, m from the beginning of the leg's lanes.
    pub station: f64,
    /// How long one stands at least, s, in [0, 86 400].
    pub dwell: f64,
    /// One does not leave before so long after the departure of the trip, s: its time in the timetable; 0 for none.
    pub not_before: f64,
}

impl Stop {
    /// A stop without a timetable.
    pub const fn new(leg: Leg, station: f64, dwell: f64) -> Self {
        Self { leg, station, dwell, not_before: 0.0 }
    }
}

/// A bus line.
///
/// ```
/// use simworld_core::id::RoadId;
/// use simworld_core::net::LaneDirection;
/// use simworld_traffic::{Leg, Line, Route, Stop};
/// let (into, out) = (Leg::new(RoadId(0), LaneDirection::Backward), Leg::new(RoadId(2), LaneDirection::Forward));
/// let line = Line::new(Route(vec![into, out]), vec![Stop::new(out, 40.0, 20.0)], 600.0);
/// assert_eq!(line.flow().per_hour, 6.0);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// Its way, from depot to depot.
    pub route: Route,
    /// Its stops, in the order in which it comes by.
    pub stops: Vec<Stop>,
    /// Time between two departures, s.
    pub headway: f64,
    /// The first departure, s after the start.
    pub first: f64,
    /// No bus departs any more, s after the start.
    pub last: f64,
}

impl Line {
    /// A line that begins at once and runs for ever.
    pub const fn new(route: Route, stops: Vec<Stop>, headway: f64) -> Self {
        Self { route, stops, headway, first: 0.0, last: f64::MAX }
    }

    /// Its buses as a flow, for [`Traffic::add_flow`](crate::Traffic::add_flow).
    pub fn flow(&self) -> Flow {
        Flow {
            arrivals: Arrivals::Uniform,
            kind: Some(VehicleKind::Bus),
            stops: self.stops.clone(),
            from: self.first,
            until: self.last,
            ..Flow::new(self.route.clone(), 3600.0 / self.headway)
        }
    }
}

/// Checks that stops lie on a route, in its order, and on the lanes of their legs.
pub(crate) fn validate(stops: &[Stop], route: &Route, network: &RoadNetwork) -> Result<(), TrafficError> {
    let mut rest = &route.0[..];
    let mut before = 0.0;
    for (index, stop) in stops.iter().enumerate() {
        let refused = |reason| Err(TrafficError::Stop { stop: index, reason });
        let Some(ahead) = rest.iter().position(|leg| *leg == stop.leg) else {
            return refused("its leg is not on the rest of the route");
        };
        if ahead > 0 {
            before = 0.0;
        }
        rest = &rest[ahead..];
        let lanes = stop.leg.lanes(network).iter().map(|lane| network.lanes[lane.index()].length);
        let shortest = lanes.fold(f64::INFINITY, f64::min);
        if !(stop.station > before && stop.station <= shortest) {
            return refused("its station is not on the lanes of its leg, beyond the stop before");
        }
        before = stop.station;
        if !((0.0..=86_400.0).contains(&stop.dwell) && (0.0..=1e9).contains(&stop.not_before)) {
            return refused("one stands 0 to 86 400 s, and leaves 0 s after the departure or later");
        }
    }
    Ok(())
}
