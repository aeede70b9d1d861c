//! Reads files of demand.

use std::collections::BTreeSet;
use std::io::BufRead;

use super::{
    Distribution, SumoBusStop, SumoDemand, SumoFlow, SumoPerson, SumoPersonFlow, SumoStage, SumoStop,
    SumoTimes, SumoType, SumoVehicle, SumoWay,
};
use crate::sumo::xml::{self, Element, Visit};
use crate::sumo::{SumoError, SumoWarning};

/// Vehicles that are read at most.
const MOST: u64 = 1 << 28;

pub(super) fn read(reader: impl BufRead) -> Result<SumoDemand, SumoError> {
    let mut state = State::default();
    xml::read(reader, &["routes", "additional", "trips", "flows"], &mut state)?;
    state.demand.warnings = state.warnings.into_iter().collect();
    Ok(state.demand)
}

/// What is being read.
#[derive(Default)]
struct State {
    demand: SumoDemand,
    warnings: BTreeSet<SumoWarning>,
    open: Open,
    /// The route with a name that is being read.
    route: Option<String>,
    /// Routes without a name of their own.
    unnamed: usize,
}

/// The element whose children come next.
#[derive(Default)]
enum Open {
    #[default]
    None,
    Vehicle,
    Flow,
    Types,
    Routes,
    Person,
    PersonFlow,
    /// One that was left out.
    Ignored,
}

/// A vehicle or flow that waits for its route.
fn no_way() -> SumoWay {
    SumoWay::Edges(Vec::new())
}

impl Visit for State {
    fn begin(&mut self, element: &Element<'_>, depth: usize) -> Result<(), SumoError> {
        match element.name() {
            "vType" => self.vehicle_type(element)?,
            "vTypeDistribution" => {
                let choices = choices(element, "vTypes")?;
                self.demand.type_distributions.push(Distribution { id: element.text("id")?, choices });
                self.open = Open::Types;
            }
            "route" => self.route(element)?,
            "routeDistribution" => {
                let choices = choices(element, "routes")?;
                self.demand.route_distributions.push(Distribution { id: element.text("id")?, choices });
                self.open = Open::Routes;
            }
            "vehicle" | "trip" => self.vehicle(element)?,
            "flow" => {
                let way = way(element)?.unwrap_or_else(no_way);
                self.demand.flows.push(SumoFlow::of(element, way)?);
                self.open = Open::Flow;
            }
            "stop" => self.stop(element)?,
            "busStop" => self.demand.bus_stops.push(SumoBusStop::of(element)?),
            "person" => self.person(element)?,
            "personFlow" => self.person_flow(element)?,
            "walk" | "ride" | "personTrip" if matches!(self.open, Open::Person | Open::PersonFlow) => {
                let stage = self.person_stage(element)?;
                self.stage(stage);
            }
            "container" | "containerFlow" => {
                self.open = Open::Ignored;
                self.warn("container", element, "has no counterpart: it was left out");
            }
            "transport" | "tranship" => {
                self.warn("container", element, "has a stage without counterpart: it was left out");
            }
            _ if depth == 1 => self.warn("element", element, "has no counterpart: it was left out"),
            _ => {}
        }
        Ok(())
    }

    fn end(&mut self, name: &str, _: usize) -> Result<(), SumoError> {
        let lacks_way = |way: &SumoWay| *way == no_way();
        let missing = |element: &str, id: &str| SumoError::Attribute {
            element: element.to_owned(),
            id: id.to_owned(),
            attribute: "route",
            reason: "is missing: give a route, its edges, or from and to".into(),
        };
        match name {
            "vehicle" | "trip" => {
                if let (Open::Vehicle, Some(last)) = (&self.open, self.demand.vehicles.last())
                    && lacks_way(&last.way)
                {
                    return Err(missing(name, &last.id));
                }
            }
            "flow" => {
                if let Some(last) = self.demand.flows.last().filter(|last| lacks_way(&last.way)) {
                    return Err(missing(name, &last.id));
                }
            }
            "route" => {
                self.route = None;
                return Ok(());
            }
            "vTypeDistribution" | "routeDistribution" | "person" | "personFlow" | "container"
            | "containerFlow" => {}
            _ => return Ok(()),
        }
        self.open = Open::None;
        Ok(())
    }
}

impl State {
    fn warn(&mut self, what: &'static str, element: &Element<'_>, reason: &'static str) {
        let id = element.get("id").map_or_else(|| element.name().to_owned(), std::borrow::Cow::into_owned);
        self.warnings.insert(SumoWarning::new(what, id, reason));
    }

    fn vehicle_type(&mut self, element: &Element<'_>) -> Result<(), SumoError> {
        let one = SumoType::of(element)?;
        if one.car_following.is_some() && one.model().is_none() {
            self.warn(
                "vType",
                element,
                "has a car-following model without counterpart: it follows as its class does",
            );
        }
        if let (Open::Types, Some(distribution)) = (&self.open, self.demand.type_distributions.last_mut()) {
            let weight = element.number("probability")?.unwrap_or(1.0);
            distribution.choices.push((one.id.clone(), weight.max(0.0)));
        }
        self.demand.types.push(one);
        Ok(())
    }

    fn route(&mut self, element: &Element<'_>) -> Result<(), SumoError> {
        let edges = element.words("edges");
        match self.open {
            Open::Vehicle => {
                if let Some(last) = self.demand.vehicles.last_mut() {
                    last.way = SumoWay::Edges(edges);
                }
            }
            Open::Flow => {
                if let Some(last) = self.demand.flows.last_mut() {
                    last.way = SumoWay::Edges(edges);
                }
            }
            Open::Routes => {
                let weight = element.number("probability")?.unwrap_or(1.0).max(0.0);
                let id = match element.get("refId") {
                    Some(id) => id.into_owned(),
                    None => self.add_route(element, edges),
                };
                if let Some(distribution) = self.demand.route_distributions.last_mut() {
                    distribution.choices.push((id, weight));
                }
            }
            Open::Ignored | Open::Person | Open::PersonFlow => {}
            Open::None | Open::Types => {
                element.text("id")?;
                self.add_route(element, edges);
            }
        }
        Ok(())
    }

    fn add_route(&mut self, element: &Element<'_>, edges: Vec<String>) -> String {
        self.unnamed += 1;
        let unnamed = self.unnamed;
        let id = element.get("id").map_or_else(|| format!("!{unnamed}"), std::borrow::Cow::into_owned);
        self.demand.routes.push((id.clone(), edges));
        self.route = Some(id.clone());
        id
    }

    /// A stop of whatever is being read.
    fn stop(&mut self, element: &Element<'_>) -> Result<(), SumoError> {
        if matches!(self.open, Open::Ignored) {
            return Ok(());
        }
        if element.get("triggered").is_some_and(|value| value != "false") {
            self.warn("stop", element, "waits for nobody: it lasts as long as its duration says");
        }
        let stop = SumoStop::of(element)?;
        let demand = &mut self.demand;
        let own = match self.open {
            Open::Vehicle => demand.vehicles.last_mut().map(|vehicle| &mut vehicle.stops),
            Open::Flow => demand.flows.last_mut().map(|flow| &mut flow.stops),
            _ => None,
        };
        if let Some(stops) = own {
            stops.push(stop);
        } else if matches!(self.open, Open::Person | Open::PersonFlow) {
            self.stage(SumoStage::Stop(stop));
        } else if let Some(route) = &self.route {
            demand.route_stops.push((route.clone(), stop));
        } else {
            self.warn("stop", element, "is nobody's: it was left out");
        }
        Ok(())
    }

    /// One stage of people.
    fn person_stage(&mut self, element: &Element<'_>) -> Result<SumoStage, SumoError> {
        match element.name() {
            "walk" => SumoStage::walk(element),
            "ride" => SumoStage::ride(element),
            _ => {
                let (trip, by_others) = SumoStage::trip(element)?;
                if by_others {
                    let reason =
                        "has modes without counterpart: one goes on foot, and by those that have one";
                    self.warn("personTrip", element, reason);
                }
                Ok(trip)
            }
        }
    }

    /// What the person, or those of the flow, that are being read do next.
    fn stage(&mut self, stage: SumoStage) {
        let stages = match self.open {
            Open::Person => self.demand.persons.last_mut().map(|person| &mut person.stages),
            Open::PersonFlow => self.demand.person_flows.last_mut().map(|flow| &mut flow.stages),
            _ => None,
        };
        if let Some(stages) = stages {
            stages.push(stage);
        }
    }

    fn person_flow(&mut self, element: &Element<'_>) -> Result<(), SumoError> {
        let (id, times) = (element.text("id")?, SumoTimes::of(element)?);
        self.demand.person_flows.push(SumoPersonFlow { id, times, stages: Vec::new() });
        self.open = Open::PersonFlow;
        Ok(())
    }

    fn person(&mut self, element: &Element<'_>) -> Result<(), SumoError> {
        if self.demand.persons.len() as u64 >= MOST {
            return Err(SumoError::TooMuch { what: "persons", limit: MOST });
        }
        self.open = Open::Ignored;
        let Some(depart) = time(element, "depart")? else {
            self.warn("person", element, "departs with a vehicle: it was left out");
            return Ok(());
        };
        self.demand.persons.push(SumoPerson { id: element.text("id")?, depart, stages: Vec::new() });
        self.open = Open::Person;
        Ok(())
    }

    fn vehicle(&mut self, element: &Element<'_>) -> Result<(), SumoError> {
        if self.demand.vehicles.len() as u64 >= MOST {
            return Err(SumoError::TooMuch { what: "vehicles", limit: MOST });
        }
        self.open = Open::Ignored;
        let Some(depart) = time(element, "depart")? else {
            self.warn("vehicle", element, "departs when somebody gets in: it was left out");
            return Ok(());
        };
        for (name, usual) in
            [("departLane", &["best", "first", "0"][..]), ("departPos", &["base", "0", "0.00"])]
        {
            if element.get(name).is_some_and(|value| !usual.contains(&value.as_ref())) {
                self.warnings.insert(SumoWarning::new(
                    "vehicle",
                    name,
                    "is not kept: vehicles enter at the beginning of the lane with most room",
                ));
            }
        }
        let way = way(element)?.unwrap_or_else(no_way);
        let vehicle_type = element.get("type").map(std::borrow::Cow::into_owned);
        let line = element.get("line").unwrap_or_default().into_owned();
        let id = element.text("id")?;
        self.demand.vehicles.push(SumoVehicle { id, vehicle_type, depart, way, stops: Vec::new(), line });
        self.open = Open::Vehicle;
        Ok(())
    }
}

/// The way that attributes give; `None` if it comes as a child.
fn way(element: &Element<'_>) -> Result<Option<SumoWay>, SumoError> {
    if let Some(route) = element.get("route") {
        return Ok(Some(SumoWay::Route(route.into_owned())));
    }
    if element.get("from").is_none() && element.get("to").is_none() {
        return Ok(None);
    }
    let (from, to) = (element.text("from")?, element.text("to")?);
    Ok(Some(SumoWay::Trip { from, via: element.words("via"), to }))
}

/// Names and weights of a distribution that gives them as attributes.
fn choices(element: &Element<'_>, names: &'static str) -> Result<Vec<(String, f64)>, SumoError> {
    let weights = element.words("probabilities");
    let names = element.words(names);
    names
        .into_iter()
        .enumerate()
        .map(|(index, name)| {
            let weight = weights.get(index).map_or(Some(1.0), |weight| weight.parse().ok());
            let weight = weight.filter(|weight: &f64| weight.is_finite() && *weight >= 0.0);
            weight.map(|weight| (name, weight)).ok_or_else(|| element.error("probabilities", "has no weight"))
        })
        .collect()
}

/// A time: seconds, `h:m:s` or `d:h:m:s`. `None` where it is missing or an event.
pub(super) fn time(element: &Element<'_>, name: &'static str) -> Result<Option<f64>, SumoError> {
    let Some(text) = element.get(name) else { return Ok(None) };
    let text = text.trim();
    if matches!(text, "triggered" | "containerTriggered" | "split") {
        return Ok(None);
    }
    if matches!(text, "begin" | "now") {
        return Ok(Some(0.0));
    }
    let parts: Option<Vec<f64>> = text.split(':').map(|part| part.parse().ok()).collect();
    let seconds = parts.and_then(|parts| {
        // From the right: seconds, minutes, hours, days.
        let units = [1.0, 60.0, 3600.0, 86_400.0];
        let fits = parts.len() <= units.len();
        fits.then(|| parts.iter().rev().zip(units).map(|(part, unit)| part * unit).sum::<f64>())
    });
    let seconds = seconds.filter(|seconds| (0.0..=1e9).contains(seconds));
    seconds.map(Some).ok_or_else(|| element.error(name, "is no time: give seconds or h:m:s"))
}
