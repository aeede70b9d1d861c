//! Trips from kerb to kerb.

use super::{State, Traffic};
use crate::demand::{Kerbs, VehicleChoice};
use crate::vehicle::BEFORE_JUNCTION;
use crate::{Leg, Route, TrafficError};

impl Traffic {
    /// Sends a vehicle as [`insert_scheduled`](Self::insert_scheduled) does, from a parking place on its first leg, to one on its
    /// last, or both. It departs when nobody behind has to brake harder than comfortably for it, and pulls out of the parking
    /// strip if the road has one; at its end it pulls in, takes its time, and is gone, as
    /// [`TripEnd::Parked`](crate::TripEnd::Parked).
    ///
    /// # Errors
    /// A route that cannot be driven, a kind or type that the configuration has not, a time that is not finite, or a
    /// parking place that is not on the outermost lane of its leg, beyond the vehicle's own length and 20 m before the junction.
    pub fn insert_between(
        &mut self,
        route: Route,
        vehicle: VehicleChoice,
        scheduled: f64,
        kerbs: Kerbs,
    ) -> Result<u64, TrafficError> {
        let route = route.outside(&self.tracks);
        route.validate(&self.tracks.network)?;
        vehicle.validate(&self.driving)?;
        if !scheduled.is_finite() {
            let (field, allowed) = ("scheduled", "a finite time, s");
            return Err(TrafficError::Config { field, value: scheduled, allowed });
        }
        // A route that can be driven has a first leg and a last.
        let (first, last) = (route.0[0], route.0[route.0.len() - 1]);
        self.check_kerb(first, kerbs.from, vehicle)?;
        self.check_kerb(last, kerbs.to, vehicle)?;
        if let (Kerbs { from: Some(from), to: Some(station) }, 1) = (kerbs, route.0.len())
            && station < from + 1.0
        {
            let reason = "it is not beyond the one on the same leg from which the trip departs";
            return Err(TrafficError::Kerb { leg: last, station, reason });
        }
        let State { vehicles, demand, .. } = &mut self.state;
        let route = vehicles.add_route(route);
        Ok(demand.add_trip(first, route, vehicle, (&self.driving, self.streams), (scheduled, kerbs)))
    }

    fn check_kerb(&self, leg: Leg, station: Option<f64>, vehicle: VehicleChoice) -> Result<(), TrafficError> {
        let Some(station) = station else { return Ok(()) };
        let network = &self.tracks.network;
        let length = leg.lanes(network).last().map_or(0.0, |lane| network.lanes[lane.index()].length);
        let longest = self.driving.types.iter().enumerate().filter(|(row, own)| match vehicle {
            VehicleChoice::Kind(kind) => own.kind == kind,
            VehicleChoice::Type(wanted) => *row == wanted,
        });
        let longest = longest.map(|(_, own)| own.length).fold(0.0, f64::max);
        let reason = if !(station > longest && station.is_finite()) {
            "the vehicle does not find room behind it: give a station beyond the vehicle's length"
        } else if station > length - BEFORE_JUNCTION {
            "it is less than 20 m before the junction, or beyond its lane"
        } else {
            return Ok(());
        };
        Err(TrafficError::Kerb { leg, station, reason })
    }
}
