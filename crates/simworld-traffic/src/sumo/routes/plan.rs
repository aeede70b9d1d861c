//! From names of edges to a schedule.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::seed::{Seed, StreamRng};

use super::{Distribution, SumoDemand, SumoStop, SumoTimes, SumoWay};
use crate::sumo::{SumoError, SumoNet, SumoWarning};
use crate::vehicle::{VehicleKind, VehicleType};
use crate::{Departing, Flow, Itinerary, Leg, PersonFlow, Route, Router, Schedule, VehicleChoice};

impl SumoDemand {
    /// Who departs when on a network, and what of the demand cannot be driven there. Draws, of distributions and random
    /// flows, are those of the seed. Types of the file are rows of the table that [`vehicle_types`](Self::vehicle_types)
    /// gives: the traffic must be made with it.
    ///
    /// # Errors
    /// An edge, route or type that is named and not there.
    pub fn schedule(&self, net: &SumoNet, seed: Seed) -> Result<(Schedule, Vec<SumoWarning>), SumoError> {
        let mut plan = Plan {
            demand: self,
            net,
            router: Router::new(&net.network),
            routes: self.routes.iter().map(|(id, edges)| (id.as_str(), edges.as_slice())).collect(),
            types: self.vehicle_types(),
            vehicles: self.vehicles.iter().map(|vehicle| vehicle.id.as_str()).collect(),
            rng: seed.stream("traffic/sumo").rng(),
        };
        let mut schedule = Schedule::new(seed);
        let mut warnings = Vec::new();
        for vehicle in &self.vehicles {
            let (choice, route) = (
                plan.vehicle(&vehicle.id, vehicle.vehicle_type.as_deref())?,
                plan.route(&vehicle.id, &vehicle.way)?,
            );
            match route {
                Ok(route) => {
                    let (name, depart) = (vehicle.id.as_str(), vehicle.depart);
                    let stops = self.stops_of(&vehicle.way, &vehicle.stops);
                    let stops = self.stops(net, (name, depart), &stops, &route, &mut warnings)?;
                    let line = vehicle.line.clone();
                    schedule.add(Departing { stops, line, ..Departing::new(name, depart, route, choice) });
                }
                Err(reason) => warnings.push(SumoWarning::new("vehicle", &vehicle.id, reason)),
            }
        }
        for flow in &self.flows {
            let (choice, route) =
                (plan.vehicle(&flow.id, flow.vehicle_type.as_deref())?, plan.route(&flow.id, &flow.way)?);
            let route = match route {
                Ok(route) => route,
                Err(reason) => {
                    warnings.push(SumoWarning::new("flow", &flow.id, reason));
                    continue;
                }
            };
            let per_hour = allowed_rate("flow", &flow.id, &flow.times, &mut warnings);
            let stops = self.stops_of(&flow.way, &flow.stops);
            let stops = self.stops(net, (&flow.id, flow.times.begin), &stops, &route, &mut warnings)?;
            let SumoTimes { begin: from, end: until, arrivals, number, .. } = flow.times;
            let flow_here = Flow { arrivals, stops, from, until, ..Flow::new(route, per_hour) };
            match schedule.add_flow_of(&flow.id, flow_here, choice, number) {
                Ok(()) => schedule.name_line(&flow.line),
                Err(error) => warnings.push(SumoWarning::new("flow", &flow.id, error.to_string())),
            }
        }
        for person in &self.persons {
            let stages = plan.stages(&person.id, &person.stages, &mut warnings)?;
            schedule.add_person(Itinerary { name: person.id.clone(), depart: person.depart, stages });
        }
        for flow in &self.person_flows {
            let stages = plan.stages(&flow.id, &flow.stages, &mut warnings)?;
            let per_hour = allowed_rate("personFlow", &flow.id, &flow.times, &mut warnings);
            let SumoTimes { begin: from, end: until, arrivals, number, .. } = flow.times;
            let people = PersonFlow { stages, per_hour, arrivals, from, until, number };
            if let Err(error) = schedule.add_person_flow(&flow.id, people) {
                warnings.push(SumoWarning::new("personFlow", &flow.id, error.to_string()));
            }
        }
        warnings.sort();
        Ok((schedule, warnings))
    }

    /// The stops of a way and one's own.
    fn stops_of(&self, way: &SumoWay, own: &[SumoStop]) -> Vec<SumoStop> {
        let of_route = self.route_stops.iter().filter(|(id, _)| *way == SumoWay::Route(id.clone()));
        of_route.map(|(_, stop)| stop).chain(own).cloned().collect()
    }
}

/// What is needed to find ways.
pub(super) struct Plan<'a> {
    pub(super) demand: &'a SumoDemand,
    pub(super) net: &'a SumoNet,
    pub(super) router: Router,
    routes: BTreeMap<&'a str, &'a [String]>,
    /// The types of the traffic.
    pub(super) types: Vec<VehicleType>,
    /// The ids of vehicles.
    pub(super) vehicles: BTreeSet<&'a str>,
    rng: StreamRng,
}

/// A route, or why there is none.
type Found = Result<Route, String>;

impl Plan<'_> {
    fn draw(&mut self, distribution: &Distribution) -> Option<String> {
        let weights: Vec<f64> = distribution.choices.iter().map(|(_, weight)| *weight).collect();
        let index = self.rng.weighted(&weights)?;
        distribution.choices.get(index).map(|(id, _)| id.clone())
    }

    pub(super) fn vehicle(&mut self, owner: &str, wanted: Option<&str>) -> Result<VehicleChoice, SumoError> {
        let Some(id) = wanted else { return Ok(VehicleKind::Car.into()) };
        let demand = self.demand;
        let drawn = demand.type_distributions.iter().find(|one| one.id == id);
        let id = drawn.and_then(|one| self.draw(one)).unwrap_or_else(|| id.to_owned());
        match (demand.choice(&id), id.as_str()) {
            (Some(choice), _) => Ok(choice),
            // Types that SUMO knows without being told.
            (None, "DEFAULT_VEHTYPE" | "DEFAULT_TAXITYPE") => Ok(VehicleKind::Car.into()),
            (None, "DEFAULT_BIKETYPE") => Ok(VehicleKind::Bicycle.into()),
            (None, _) => Err(dangling(owner, "type", &id)),
        }
    }

    /// Outside: something that is not there; inside: a way that cannot be driven.
    fn route(&mut self, owner: &str, way: &SumoWay) -> Result<Found, SumoError> {
        match way {
            SumoWay::Edges(edges) => self.along(owner, edges),
            SumoWay::Route(id) => {
                let demand = self.demand;
                let drawn = demand.route_distributions.iter().find(|one| one.id == *id);
                let id = drawn.and_then(|one| self.draw(one)).unwrap_or_else(|| id.clone());
                match self.routes.get(id.as_str()).copied() {
                    Some(edges) => self.along(owner, edges),
                    None => Err(dangling(owner, "route", &id)),
                }
            }
            SumoWay::Trip { from, via, to } => self.quickest(owner, from, via, to),
        }
    }

    fn leg(&self, owner: &str, edge: &str) -> Result<Leg, SumoError> {
        self.net.names.leg(edge).ok_or_else(|| dangling(owner, "edge", edge))
    }

    fn along(&self, owner: &str, edges: &[String]) -> Result<Found, SumoError> {
        let legs: Result<Vec<Leg>, SumoError> = edges.iter().map(|edge| self.leg(owner, edge)).collect();
        let route = Route(legs?);
        Ok(match route.validate(&self.net.network) {
            Ok(()) => Ok(route),
            Err(error) => Err(format!("was left out: {error}")),
        })
    }

    fn quickest(&self, owner: &str, from: &str, via: &[String], to: &str) -> Result<Found, SumoError> {
        let mut route = Route(vec![self.leg(owner, from)?]);
        for edge in via.iter().map(String::as_str).chain([to]) {
            let next = self.leg(owner, edge)?;
            let last = route.0[route.0.len() - 1];
            let Some(way) = self.router.quickest(last, next) else {
                return Ok(Err(format!("was left out: no way leads on to edge `{edge}`")));
            };
            route.0.extend(way.0.into_iter().skip(1));
        }
        Ok(route
            .validate(&self.net.network)
            .map(|()| route)
            .map_err(|error| format!("was left out: {error}")))
    }
}

/// The rate of a flow, an hour, or the next that one may have, of which is warned.
fn allowed_rate(what: &'static str, id: &str, times: &SumoTimes, warnings: &mut Vec<SumoWarning>) -> f64 {
    let per_hour = times.allowed_rate();
    if per_hour != times.per_hour {
        let reason = format!("of {} an hour was made one of {per_hour}", times.per_hour);
        warnings.push(SumoWarning::new(what, id, reason));
    }
    per_hour
}

fn dangling(owner: &str, what: &'static str, target: &str) -> SumoError {
    SumoError::Dangling { element: "vehicle", id: owner.to_owned(), what, target: target.to_owned() }
}
