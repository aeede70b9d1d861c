//! SUMO's demand (`rou.xml`, `trips.xml`, `flows.xml`): types, routes, vehicles, trips and flows.
//!
//! Edges are named; [`SumoDemand::schedule`] finds them in a network. Trips take the quickest way. A flow comes at even
//! times (`period`, `vehsPerHour`, `number`), at random (`period="exp(rate)"`), or, with `probability`, at random with
//! that mean a second, which is what a chance a second comes to. Vehicles make their stops; people walk, wait, and ride in
//! vehicles that halt where they get in and out; trips of people (`personTrip`) go by whatever is quickest when they begin: on foot,
//! with the mode `public` by lines, and with the modes `car` and `bicycle` or `vTypes` in a vehicle of their own, which departs for them,
//! from the very beginning. Containers, and other modes, are warned of.
//!
//! Source of the format: SUMO user documentation, *Definition of Vehicles, Vehicle Types, and Routes*.

mod flow;
mod people;
mod person;
mod plan;
mod read;
mod types;

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use super::{SumoError, SumoWarning};
pub use flow::{SumoFlow, SumoTimes};
pub use person::{SumoBusStop, SumoPerson, SumoPersonFlow, SumoPlace, SumoStage, SumoStop};
pub use types::SumoType;

/// The way of a vehicle, in names of edges.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SumoWay {
    /// Every edge.
    Edges(Vec<String>),
    /// The route or distribution of that name.
    Route(String),
    /// From one edge to another, past others.
    Trip {
        /// The first edge.
        from: String,
        /// Edges between.
        via: Vec<String>,
        /// The last edge.
        to: String,
    },
}

/// A vehicle that departs once.
#[derive(Clone, Debug, PartialEq)]
pub struct SumoVehicle {
    /// Its id.
    pub id: String,
    /// Its type, if it names one.
    pub vehicle_type: Option<String>,
    /// When it departs, s.
    pub depart: f64,
    /// Its way.
    pub way: SumoWay,
    /// Its stops on the way, beside those of its route.
    pub stops: Vec<SumoStop>,
    /// The line that it is of; empty if none.
    pub line: String,
}

/// Several things of which one is drawn: ids with their weights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Distribution {
    /// Its id.
    pub id: String,
    /// The ids drawn from, with their weights.
    pub choices: Vec<(String, f64)>,
}

/// What a file of demand holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SumoDemand {
    /// Types of vehicles.
    pub types: Vec<SumoType>,
    /// Distributions of types.
    pub type_distributions: Vec<Distribution>,
    /// Routes with names, as edges.
    pub routes: Vec<(String, Vec<String>)>,
    /// Stops of routes with names.
    pub route_stops: Vec<(String, SumoStop)>,
    /// Bus stops.
    pub bus_stops: Vec<SumoBusStop>,
    /// People.
    pub persons: Vec<SumoPerson>,
    /// People who keep coming.
    pub person_flows: Vec<SumoPersonFlow>,
    /// Distributions of routes.
    pub route_distributions: Vec<Distribution>,
    /// Vehicles and trips, in the order of the file.
    pub vehicles: Vec<SumoVehicle>,
    /// Flows.
    pub flows: Vec<SumoFlow>,
    /// What has no counterpart here, one each kind and id.
    pub warnings: Vec<SumoWarning>,
}

impl SumoDemand {
    /// Reads demand.
    ///
    /// ```
    /// use simworld_traffic::sumo::SumoDemand;
    /// let demand = SumoDemand::read(
    ///     r#"<routes>
    ///         <vType id="lorry" vClass="truck" length="7.1" accel="1.3"/>
    ///         <trip id="t" depart="0:01:30" from="a" to="b" type="lorry"/>
    ///         <flow id="f" begin="0" end="3600" vehsPerHour="600"><route edges="a b c"/></flow>
    ///     </routes>"#.as_bytes(),
    /// )?;
    /// assert_eq!((demand.vehicles[0].depart, demand.flows[0].times.per_hour), (90.0, 600.0));
    /// # Ok::<(), simworld_traffic::sumo::SumoError>(())
    /// ```
    ///
    /// # Errors
    /// A text that is no demand, that ends too early, or that says something senseless.
    pub fn read(reader: impl BufRead) -> Result<Self, SumoError> {
        read::read(reader)
    }

    /// Reads the demand in a file.
    ///
    /// # Errors
    /// Those of [`read`](Self::read).
    pub fn open(path: impl AsRef<Path>) -> Result<Self, SumoError> {
        Self::read(BufReader::new(File::open(path)?))
    }
}
