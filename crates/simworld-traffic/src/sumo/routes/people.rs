//! From names of edges and stops to stops on legs, and to the itineraries of people.

use simworld_core::geometry::Point2;
use simworld_core::id::LaneId;
use simworld_core::net::polyline;

use super::{SumoDemand, SumoPerson, SumoPlace, SumoStage, SumoStop};
use crate::sumo::{SumoError, SumoNet, SumoWarning};
use crate::{Itinerary, Kerb, Leg, PersonStage, Route, Stop};

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

    /// The itinerary of a person.
    pub(super) fn itinerary(&self, net: &SumoNet, person: &SumoPerson) -> Result<Itinerary, SumoError> {
        let id = person.id.as_str();
        let mut here: Option<Kerb> = None;
        let mut stages = Vec::new();
        for stage in &person.stages {
            let begin = |from: &Option<String>| match (from, here) {
                (Some(edge), None) => self.kerb(net, id, &SumoPlace::Edge(edge.clone()), Some(0.0)),
                (_, Some(here)) => Ok(here),
                (None, None) => Err(lost(id, "edge", "from")),
            };
            let next = match stage {
                SumoStage::Walk { from, to, end } => {
                    let (from, to) = (begin(from)?, self.kerb(net, id, to, *end)?);
                    let (a, b) = (point(net, from), point(net, to));
                    stages.push(PersonStage::Walk { from: a, to: b });
                    to
                }
                SumoStage::Ride { from, to, lines } => {
                    let (from, to) = (begin(from)?, self.kerb(net, id, to, None)?);
                    stages.push(PersonStage::Ride { from, to, lines: lines.clone() });
                    to
                }
                SumoStage::Stop(stop) => {
                    let until = stop.until.unwrap_or(0.0);
                    stages.push(PersonStage::Wait { seconds: stop.duration, until });
                    self.kerb(net, id, &stop.place, stop.end)?
                }
            };
            here = Some(next);
        }
        Ok(Itinerary { name: person.id.clone(), depart: person.depart, stages })
    }

    /// A place by name, and how far along its leg it is, m.
    fn kerb(
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

/// The leg of a lane; people's lanes are those of their edge.
fn leg_of(net: &SumoNet, owner: &str, lane: &str) -> Result<Leg, SumoError> {
    let own = net.names.lane_id(lane).map(|lane| Leg::of(&net.network, lane));
    let edge = || lane.rsplit_once('_').and_then(|(edge, _)| net.names.leg(edge));
    own.or_else(edge).ok_or_else(|| lost(owner, "lane", lane))
}

/// Where a kerb is: on the outermost lane of its leg; people find the nearest walkway.
fn point(net: &SumoNet, (leg, station): Kerb) -> Point2 {
    let lane = leg.lanes(&net.network).last().copied().unwrap_or(LaneId(0));
    polyline::at(&net.network.lanes[lane.index()].path, station).0
}

fn lost(owner: &str, what: &'static str, target: &str) -> SumoError {
    SumoError::Dangling { element: "vehicle", id: owner.to_owned(), what, target: target.to_owned() }
}
