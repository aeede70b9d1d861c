//! Stops of vehicles, and people, alone or as flows: their walks, rides, trips and stops.

use super::SumoTimes;
use super::read::time;
use crate::sumo::SumoError;
use crate::sumo::xml::Element;

/// A place on an edge, by name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SumoPlace {
    /// A lane.
    Lane(String),
    /// An edge.
    Edge(String),
    /// A bus stop.
    BusStop(String),
}

/// A bus stop.
#[derive(Clone, Debug, PartialEq)]
pub struct SumoBusStop {
    /// Its id.
    pub id: String,
    /// Its lane.
    pub lane: String,
    /// Where it ends, m along the lane; negative from the lane's end. The end of the lane if it does not say.
    pub end: Option<f64>,
}

/// A stop of a vehicle or a person.
#[derive(Clone, Debug, PartialEq)]
pub struct SumoStop {
    /// Where.
    pub place: SumoPlace,
    /// Where on the lane, m; negative from its end.
    pub end: Option<f64>,
    /// How long, s.
    pub duration: f64,
    /// Until when at least, s.
    pub until: Option<f64>,
}

/// What a person does.
#[derive(Clone, Debug, PartialEq)]
pub enum SumoStage {
    /// On foot from one edge to another.
    Walk {
        /// From where; where they are, if it does not say.
        from: Option<String>,
        /// Where to.
        to: SumoPlace,
        /// Where on it, m.
        end: Option<f64>,
    },
    /// In a vehicle.
    Ride {
        /// From where; where they are, if it does not say.
        from: Option<String>,
        /// Where to.
        to: SumoPlace,
        /// The lines or vehicles.
        lines: Vec<String>,
    },
    /// However they like: on foot, by lines if `public` says so, and in vehicles of their own.
    Trip {
        /// From where; where they are, if it does not say.
        from: Option<String>,
        /// Where to.
        to: SumoPlace,
        /// Where on it, m.
        end: Option<f64>,
        /// Whether they take whatever line is quicker than walking.
        public: bool,
        /// The types of vehicles that they may have of their own: those of `vTypes`, then those that SUMO has for the modes `car` and
        /// `bicycle`.
        vehicles: Vec<String>,
    },
    /// Waiting.
    Stop(SumoStop),
}

/// People who keep coming.
#[derive(Clone, Debug, PartialEq)]
pub struct SumoPersonFlow {
    /// Its id; its people are `id.0`, `id.1` and so on.
    pub id: String,
    /// When they set out.
    pub times: SumoTimes,
    /// What each of them does.
    pub stages: Vec<SumoStage>,
}

/// A person.
#[derive(Clone, Debug, PartialEq)]
pub struct SumoPerson {
    /// Their id.
    pub id: String,
    /// When they set out, s.
    pub depart: f64,
    /// What they do.
    pub stages: Vec<SumoStage>,
}

/// The place that an element names, of a lane, an edge or a bus stop.
fn place(element: &Element<'_>, edge: &str) -> Option<SumoPlace> {
    let text = |name: &str| element.get(name).map(std::borrow::Cow::into_owned);
    text("busStop")
        .map(SumoPlace::BusStop)
        .or_else(|| text("lane").map(SumoPlace::Lane))
        .or_else(|| text(edge).map(SumoPlace::Edge))
}

impl SumoBusStop {
    pub(super) fn of(element: &Element<'_>) -> Result<Self, SumoError> {
        Ok(Self { id: element.text("id")?, lane: element.text("lane")?, end: element.number("endPos")? })
    }
}

impl SumoStop {
    pub(super) fn of(element: &Element<'_>) -> Result<Self, SumoError> {
        let place = place(element, "edge")
            .ok_or_else(|| element.error("lane", "is missing: give a lane, an edge or a busStop"))?;
        let duration = time(element, "duration")?.unwrap_or(0.0);
        Ok(Self { place, end: element.number("endPos")?, duration, until: time(element, "until")? })
    }
}

impl SumoStage {
    /// A walk: between edges, along edges, or to a bus stop.
    pub(super) fn walk(element: &Element<'_>) -> Result<Self, SumoError> {
        let edges = element.words("edges");
        let last = edges.last().cloned().map(SumoPlace::Edge);
        let from = element.get("from").map(std::borrow::Cow::into_owned).or(edges.into_iter().next());
        let to = place(element, "to").or(last);
        let to = to.ok_or_else(|| element.error("to", "is missing: give edges, to or a busStop"))?;
        Ok(Self::Walk { from, to, end: element.number("arrivalPos")? })
    }

    /// A trip; whether some of its modes were passed over.
    pub(super) fn trip(element: &Element<'_>) -> Result<(Self, bool), SumoError> {
        let to = place(element, "to");
        let to = to.ok_or_else(|| element.error("to", "is missing: give an edge or a busStop"))?;
        let (mut public, mut others, mut vehicles) = (false, false, element.words("vTypes"));
        for mode in element.words("modes") {
            match mode.as_str() {
                "public" => public = true,
                "car" => vehicles.push("DEFAULT_VEHTYPE".to_owned()),
                "bicycle" => vehicles.push("DEFAULT_BIKETYPE".to_owned()),
                // One always may.
                "walk" => {}
                _ => others = true,
            }
        }
        let from = element.get("from").map(std::borrow::Cow::into_owned);
        let end = element.number("arrivalPos")?;
        Ok((Self::Trip { from, to, end, public, vehicles }, others))
    }

    pub(super) fn ride(element: &Element<'_>) -> Result<Self, SumoError> {
        let to = place(element, "to");
        let to = to.ok_or_else(|| element.error("to", "is missing: give an edge or a busStop"))?;
        let mut lines = element.words("lines");
        // SUMO's word for whatever comes.
        lines.retain(|line| line != "ANY");
        Ok(Self::Ride { from: element.get("from").map(std::borrow::Cow::into_owned), to, lines })
    }
}
