//! From names of edges and stops to stops on legs, and to the stages of people.

use super::plan::Plan;
use super::{SumoDemand, SumoPlace, SumoStage, SumoStop};
use crate::demand::beside;
use crate::sumo::{SumoError, SumoNet, SumoWarning};
use crate::{Kerb, Leg, PersonDrive, PersonStage, Route, Stop};

impl SumoDemand {
    /// The stops that a vehicle can make on its way, which begins at a time; the others are warned of.
    pub(super) fn stops(
        &self,
        net: &SumoNet,
        owner: (&str, f64),
        stops: &[SumoStop],
        route: &Route,
        warnings: &mut Vec<SumoWarning>,
    ) -> Result<Vec<Stop>, SumoError> {
        let (id, depart) = owner;
        let mut made = Vec::new();
        for stop in stops {
            let (leg, station) = self.kerb(net, id, &stop.place, stop.end)?;
            let shortest = leg.lanes(&net.network).iter().map(|lane| net.network.lanes[lane.index()].length);
            let station = station.min(shortest.fold(f64::INFINITY, f64::min));
            let not_before = stop.until.map_or(0.0, |until| (until - depart).max(0.0));
            made.push(Stop { not_before, ..Stop::new(leg, station, stop.duration) });
            if let Err(error) = crate::line::validate(&made, route, &net.network) {
                made.pop();
                warnings.push(SumoWarning::new("stop", id, format!("was left out: {error}")));
            }
        }
        Ok(made)
    }

    /// A place by name, and how far along its leg it is, m.
    pub(super) fn kerb(
        &self,
        net: &SumoNet,
        owner: &str,
        place: &SumoPlace,
        end: Option<f64>,
    ) -> Result<Kerb, SumoError> {
        let (leg, end) = match place {
            SumoPlace::Edge(edge) => (net.names.leg(edge).ok_or_else(|| lost(owner, "edge", edge))?, end),
            SumoPlace::Lane(lane) => (leg_of(net, owner, lane)?, end),
            SumoPlace::BusStop(id) => {
                let stop = self.bus_stops.iter().find(|stop| stop.id == *id);
                let stop = stop.ok_or_else(|| lost(owner, "busStop", id))?;
                (leg_of(net, owner, &stop.lane)?, stop.end)
            }
        };
        let lanes = leg.lanes(&net.network).iter();
        let length = lanes.map(|lane| net.network.lanes[lane.index()].length).fold(0.0, f64::max);
        let station = end.map_or(length, |end| if end < 0.0 { length + end } else { end });
        Ok((leg, station.clamp(0.0, length)))
    }
}

impl Plan<'_> {
    /// What somebody of a name does.
    pub(super) fn stages(
        &mut self,
        id: &str,
        stages: &[SumoStage],
        warnings: &mut Vec<SumoWarning>,
    ) -> Result<Vec<PersonStage>, SumoError> {
        let (demand, net) = (self.demand, self.net);
        let mut here: Option<Kerb> = None;
        let mut made = Vec::new();
        for stage in stages {
            let begin = |from: &Option<String>| match (from, here) {
                (Some(edge), None) => demand.kerb(net, id, &SumoPlace::Edge(edge.clone()), Some(0.0)),
                (_, Some(here)) => Ok(here),
                (None, None) => Err(lost(id, "edge", "from")),
            };
            let beside = |kerb| beside(&net.network, kerb);
            let next = match stage {
                SumoStage::Walk { from, to, end } => {
                    let (from, to) = (begin(from)?, demand.kerb(net, id, to, *end)?);
                    made.push(PersonStage::Walk { from: beside(from), to: beside(to) });
                    to
                }
                SumoStage::Trip { from, to, end, public, vehicles } => {
                    let (start, goal) = (begin(from)?, demand.kerb(net, id, to, *end)?);
                    let drives = self.drives(id, (start, goal), vehicles, warnings)?;
                    let (from, to, public) = (beside(start), beside(goal), *public);
                    made.push(match public {
                        _ if !drives.is_empty() => PersonStage::Trip { from, to, public, drives },
                        true => PersonStage::Journey { from, to },
                        false => PersonStage::Walk { from, to },
                    });
                    goal
                }
                SumoStage::Ride { from, to, lines } => {
                    let (from, to) = (begin(from)?, demand.kerb(net, id, to, None)?);
                    made.push(PersonStage::Ride { from, to, lines: lines.clone() });
                    to
                }
                SumoStage::Stop(stop) => {
                    let until = stop.until.unwrap_or(0.0);
                    made.push(PersonStage::Wait { seconds: stop.duration, until });
                    demand.kerb(net, id, &stop.place, stop.end)?
                }
            };
            here = Some(next);
        }
        Ok(made)
    }

    /// What somebody could drive from one place to another, in vehicles of these types. Along one edge one walks, as in SUMO.
    fn drives(
        &mut self,
        id: &str,
        ends: (Kerb, Kerb),
        vehicles: &[String],
        warnings: &mut Vec<SumoWarning>,
    ) -> Result<Vec<PersonDrive>, SumoError> {
        let mut warn = |reason| warnings.push(SumoWarning::new("personTrip", id, reason));
        let mut drives: Vec<PersonDrive> = Vec::new();
        for vehicle_type in vehicles.iter().filter(|_| ends.0.0 != ends.1.0) {
            let choice = self.vehicle(id, Some(vehicle_type))?;
            let network = &self.net.network;
            match PersonDrive::quickest(network, &self.router, ends, choice, &self.types) {
                Some(drive) if !drives.contains(&drive) => drives.push(drive),
                Some(_) => {}
                None => warn(format!("cannot be driven in a `{vehicle_type}`: no way leads there for it")),
            }
        }
        for name in ["_0", "_b0"].map(|end| format!("{id}{end}")) {
            if !drives.is_empty() && self.vehicles.contains(name.as_str()) {
                warn(format!("does not take vehicle `{name}` of the file: one of its own departs"));
            }
        }
        Ok(drives)
    }
}

/// The leg of a lane; people's lanes are those of their edge.
fn leg_of(net: &SumoNet, owner: &str, lane: &str) -> Result<Leg, SumoError> {
    let own = net.names.lane_id(lane).map(|lane| Leg::of(&net.network, lane));
    let edge = || lane.rsplit_once('_').and_then(|(edge, _)| net.names.leg(edge));
    own.or_else(edge).ok_or_else(|| lost(owner, "lane", lane))
}

fn lost(owner: &str, what: &'static str, target: &str) -> SumoError {
    SumoError::Dangling { element: "vehicle", id: owner.to_owned(), what, target: target.to_owned() }
}
