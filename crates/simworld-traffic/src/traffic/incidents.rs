//! What is done to traffic under way: closures, breakdowns, parking.

use simworld_core::id::LaneId;

use super::Traffic;
use crate::vehicle::{Halt, Order, Then, VehicleKind};
use crate::{Closed, Closure, Leg, Stop, TrafficError};

impl Traffic {
    /// Closes a road or a lane, or blocks a stretch of one, and returns the number of the closure. Drivers with a route go
    /// around; those without do not turn there; who finds no way does as [`TrafficConfig::no_way`](crate::TrafficConfig::no_way)
    /// says. Who is to enter on a closed road waits outside.
    ///
    /// # Errors
    /// A road or lane that is not there, a stretch that is not on its lane, or an end before the beginning.
    pub fn close(&mut self, closure: Closure) -> Result<u32, TrafficError> {
        let refused = |reason| Err(TrafficError::Closure { reason });
        if !(closure.from >= 0.0 && closure.from.is_finite() && closure.until > closure.from) {
            return refused("it begins at 0 s or later and ends after that");
        }
        let length = |lane: LaneId| self.tracks.network.lanes.get(lane.index()).map(|lane| lane.length);
        match closure.what {
            Closed::Leg(leg) if leg.lanes(&self.tracks.drawn).is_empty() => {
                return refused("the road has no lanes that way");
            }
            Closed::Lane(lane) if length(lane).is_none() => return refused("there is no such lane"),
            Closed::Stretch(lane, from, to) => match length(lane) {
                None => return refused("there is no such lane"),
                Some(end) if !(0.0 <= from && from < to && to <= end) => {
                    return refused("a stretch begins and ends on its lane, m from the lane's beginning");
                }
                Some(_) => {}
            },
            Closed::Leg(_) | Closed::Lane(_) => {}
        }
        Ok(self.state.vehicles.closures.add(closure))
    }

    /// Takes a closure back; false if there is none of that number.
    pub fn reopen(&mut self, number: u32) -> bool {
        self.state.vehicles.closures.remove(number)
    }

    /// Makes a vehicle stop in its lane as soon as it can, for so many seconds, infinite for good: it broke down, or stands
    /// there to load. Others pass it on the lane beside, or over the oncoming one where a street has one lane each way and
    /// [`TrafficConfig::pass_obstacles`](crate::TrafficConfig::pass_obstacles) says so, or wait behind it. In a junction, or with
    /// leave to cross one, it drives on to the lane behind. False if there is no vehicle of that number.
    ///
    /// # Errors
    /// A time that is negative or not a number.
    pub fn halt(&mut self, id: u32, seconds: f64) -> Result<bool, TrafficError> {
        if seconds.is_nan() || seconds < 0.0 {
            let allowed = "0 s or more";
            return Err(TrafficError::Config { field: "seconds", value: seconds, allowed });
        }
        let vehicles = &mut self.state.vehicles;
        Ok(vehicles.order(&self.tracks, &self.driving, id, [Halt::at_once(seconds)], Order::First))
    }

    /// Turns the siren of an emergency vehicle on or off. With it on its driver takes the `speed_factor` of its type, without it
    /// the limit like others. Others ahead of it leave its lane where another leads on, nobody enters a
    /// junction before it on a way that meets its own, and it passes red lights slowly, when its way is clear of others
    /// ([`Counters::reds_by_siren`](crate::Counters::reds_by_siren)). False if there is no vehicle of that number.
    ///
    /// # Errors
    /// The vehicle is not of kind [`Emergency`](crate::vehicle::VehicleKind::Emergency).
    pub fn set_siren(&mut self, id: u32, is_on: bool) -> Result<bool, TrafficError> {
        let vehicles = &mut self.state.vehicles;
        let Some((_, vehicle, _)) = vehicles.find(&self.tracks, id) else { return Ok(false) };
        if self.driving.vehicle_type(vehicle.row).kind != VehicleKind::Emergency {
            return Err(TrafficError::NoSiren { id });
        }
        Ok(vehicles.switch_siren(&self.tracks, &self.driving, id, is_on))
    }

    /// The numbers of the vehicles that have their siren on, ascending.
    pub fn sirens(&self) -> &[u32] {
        self.state.vehicles.sirens.on()
    }

    /// Makes a vehicle park at the kerb: it drives to a station on a leg of its route, m from the beginning of its lanes, stops
    /// there, takes `seconds` for it and is gone, as [`TripEnd::Parked`](crate::TripEnd::Parked). False if there is no
    /// vehicle of that number.
    ///
    /// # Errors
    /// A leg without lanes, a station that is not on them, or a time out of range.
    pub fn park(&mut self, id: u32, leg: Leg, station: f64, seconds: f64) -> Result<bool, TrafficError> {
        let stop = Stop::new(leg, station, seconds);
        crate::line::validate(&[stop], &crate::Route(vec![leg]), &self.tracks.network)?;
        let halt = Halt::at(&stop, 0.0, Then::Park);
        Ok(self.state.vehicles.order(&self.tracks, &self.driving, id, [halt], Order::Last))
    }

    /// The vehicles that stand at a stop of theirs, by number, with the leg and the station of the stop, m.
    pub fn halting(&self) -> impl Iterator<Item = (u32, Leg, f64)> {
        self.state.vehicles.halting()
    }

    /// The closures that are not over yet, with their numbers.
    pub fn closures(&self) -> impl Iterator<Item = &(u32, Closure)> {
        self.state.vehicles.closures.iter()
    }
}
