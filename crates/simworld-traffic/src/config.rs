//! How much traffic there is, and how it behaves.

use serde::{Deserialize, Serialize};
use simworld_core::net::{NetworkError, NetworkFault};
use simworld_core::scene::WorldError;
use thiserror::Error;

use crate::crowd::AnticipationVelocity;
use crate::pedestrian::People;
use crate::vehicle::{Gaps, Mobil, VehicleKind, VehicleType, gaps, standard_types};
use crate::{ControlError, DrivingConditions, Leg, NoWay};

/// How much traffic there is, and how it behaves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TrafficConfig {
    /// Vehicles to place, in [0, 10 000 000]; as many as the lanes hold are placed.
    pub vehicles: u32,
    /// Pedestrians to place, in [0, 10 000 000].
    pub pedestrians: u32,
    /// The types of vehicles, 1 to 255 of them, with their shares, sizes and drivers.
    pub types: Vec<VehicleType>,
    /// Lane changes.
    pub mobil: Mobil,
    /// Giving way.
    pub gaps: Gaps,
    /// Road and weather at the start.
    pub conditions: DrivingConditions,
    /// What drivers do whose way is closed and who find no other.
    pub no_way: NoWay,
    /// Whether drivers pass what stands on their lane over the oncoming one, on streets of one lane each way; without it they wait until
    /// it is gone.
    pub pass_obstacles: bool,
    /// Share of the drivers on a trip who know how long the streets take now, in [0, 1]: once in two minutes they look ahead, and where they would
    /// lose much time they take another way that saves a fifth of the time that is left, and a minute at least. Buses, and who is
    /// to halt on the way, keep to their routes. By default everybody keeps to the route that was given; cities of trips from place to
    /// place flow better with 1.
    pub informed: f64,
    /// Junctions between which all lanes are shorter than this are one to drivers, m, in [0, 30]; with 0 each is by itself. The
    /// default is what a bus needs to stand. Networks that netconvert has made are joined as they should be: give 0 for them. See
    /// [`RoadNetwork::join_near`](simworld_core::net::RoadNetwork::join_near).
    pub join_nearer: f64,
    /// Lateral acceleration at which drivers take turns, m/s², in [0.5, 6].
    pub lateral_acceleration: f64,
    /// Weights of going straight, right and left at an intersection, each in [0, 1000], one of them positive.
    pub turns: [f64; 3],
    /// How people walk among people.
    pub walking: AnticipationVelocity,
    /// Mean free walking speed, m/s, in [0.3, 3] (Weidmann 1993: 1.34).
    pub walking_speed: f64,
    /// Its standard deviation, m/s, in [0, 1] (Weidmann 1993: 0.26).
    pub walking_deviation: f64,
    /// Who walks, and what they do at the kerbs.
    pub people: People,
    /// Weight of crossing a road against going on along the sidewalk, in [0, 10].
    pub crossing_weight: f64,
}

impl Default for TrafficConfig {
    fn default() -> Self {
        Self {
            vehicles: 40,
            pedestrians: 80,
            types: standard_types(),
            mobil: Mobil::default(),
            gaps: Gaps::default(),
            conditions: DrivingConditions::default(),
            no_way: NoWay::default(),
            pass_obstacles: true,
            informed: 0.0,
            join_nearer: 13.0,
            lateral_acceleration: 2.5,
            turns: [0.6, 0.2, 0.2],
            walking: AnticipationVelocity::default(),
            walking_speed: 1.34,
            walking_deviation: 0.26,
            people: People::default(),
            crossing_weight: 0.6,
        }
    }
}

/// Why there is no traffic.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TrafficError {
    /// A setting out of range.
    #[error("{field} = {value} is out of range: give {allowed}")]
    Config {
        /// The setting, as a path.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// A type of vehicle with a setting out of range.
    #[error("types[{index}].{field} = {value} is out of range: give {allowed}")]
    VehicleType {
        /// The row of the table.
        index: usize,
        /// The setting.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// No type of that kind is in the table.
    #[error("the table of types has no {}: add a row of that kind to TrafficConfig::types", kind.as_str())]
    NoSuchType {
        /// The kind that was asked for.
        kind: VehicleKind,
    },
    /// No vehicle is of that kind.
    #[error(
        "there is no kind of vehicles called {kind:?}: give car, van, truck, bus, motorcycle, bicycle, scooter or emergency vehicle"
    )]
    NoVehicle {
        /// What was asked for.
        kind: String,
    },
    /// Somebody cannot be taken over, moved or given back.
    #[error(transparent)]
    Control(#[from] ControlError),
    /// An order that this version does not know.
    #[error("this traffic knows no order {name}: it was made by a later version")]
    Order {
        /// Its name.
        name: &'static str,
    },
    /// The network does not hold together.
    #[error(transparent)]
    Damaged(#[from] NetworkFault),
    /// The walkways cannot be made.
    #[error(transparent)]
    Network(#[from] NetworkError),
    /// The world refused an entity.
    #[error(transparent)]
    World(#[from] WorldError),
    /// A signal plan that is not for the intersection or the groups it was given for.
    #[error(
        "signal plan {plan} does not fit: keep its intersection and groups, and give every phase a positive duration"
    )]
    Plan {
        /// Its index.
        plan: usize,
    },
    /// A signal group that cannot do what is asked.
    #[error("signal group {group}: {reason}")]
    Signal {
        /// Its number.
        group: u32,
        /// Why not.
        reason: &'static str,
    },
    /// A route that cannot be driven.
    #[error("leg {leg} of the route: {reason}")]
    Route {
        /// Its index.
        leg: usize,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// A walk that cannot be walked.
    #[error("this walk is not possible: {reason}")]
    Walk {
        /// What is wrong with it.
        reason: &'static str,
    },
    /// A stop that a flow cannot make.
    #[error("stop {stop}: {reason}")]
    Stop {
        /// Its index.
        stop: usize,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// A parking place from which nobody can depart, or at which nobody can park.
    #[error("a parking place {station} m along leg {leg:?}: {reason}")]
    Kerb {
        /// The leg.
        leg: Leg,
        /// The station, m.
        station: f64,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// A siren on a vehicle that has none.
    #[error("vehicle {id} has no siren: only those of kind emergency have one")]
    NoSiren {
        /// The vehicle.
        id: u32,
    },
    /// A closure of what is not there, or at no time.
    #[error("nothing can be closed so: {reason}")]
    Closure {
        /// What is wrong with it.
        reason: &'static str,
    },
    /// The world has no roads.
    #[error(
        "the world has no roads: call World::set_roads, or populate it from a city, before adding traffic"
    )]
    NoRoads,
}

impl TrafficConfig {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range; NaN always is.
    pub fn validate(&self) -> Result<(), TrafficError> {
        let [straight, right, left] = self.turns;
        let checks = [
            ("vehicles", f64::from(self.vehicles), 0.0, 1e7, "0 to 10 000 000"),
            ("pedestrians", f64::from(self.pedestrians), 0.0, 1e7, "0 to 10 000 000"),
            ("types (how many)", self.types.len() as f64, 1.0, 255.0, "1 to 255 types of vehicles"),
            ("mobil.politeness", self.mobil.politeness, 0.0, 2.0, "0 to 2"),
            ("mobil.threshold", self.mobil.threshold, 0.0, 5.0, "0 to 5 m/s²"),
            ("mobil.safe_braking", self.mobil.safe_braking, 0.5, 8.0, "0.5 to 8 m/s²"),
            ("informed", self.informed, 0.0, 1.0, "0 to 1"),
            ("join_nearer", self.join_nearer, 0.0, 30.0, "0 to 30 m"),
            ("lateral_acceleration", self.lateral_acceleration, 0.5, 6.0, "0.5 to 6 m/s²"),
            ("turns[0]", straight, 0.0, 1000.0, "0 to 1000"),
            ("turns[1]", right, 0.0, 1000.0, "0 to 1000"),
            ("turns[2]", left, 0.0, 1000.0, "0 to 1000"),
            ("turns (their sum)", straight + right + left, 1e-6, 3000.0, "at least one positive weight"),
            ("walking_speed", self.walking_speed, 0.3, 3.0, "0.3 to 3 m/s"),
            ("walking_deviation", self.walking_deviation, 0.0, 1.0, "0 to 1 m/s"),
            ("crossing_weight", self.crossing_weight, 0.0, 10.0, "0 to 10"),
        ];
        for (field, value, low, high, allowed) in
            checks.into_iter().chain(self.walking.ranges()).chain(self.people.ranges())
        {
            if !(low..=high).contains(&value) {
                return Err(TrafficError::Config { field, value, allowed });
            }
        }
        self.conditions.validate()?;
        gaps::validate(&self.gaps)?;
        self.types.iter().enumerate().try_for_each(|(index, row)| row.validate(index))
    }

    /// The first type of a kind, to change it; `None` if the table has none.
    ///
    /// ```
    /// use simworld_traffic::TrafficConfig;
    /// use simworld_traffic::vehicle::VehicleKind;
    /// let mut config = TrafficConfig::default();
    /// if let Some(bicycle) = config.type_mut(VehicleKind::Bicycle) { bicycle.share = 0.1; }
    /// assert!(config.validate().is_ok());
    /// ```
    pub fn type_mut(&mut self, kind: VehicleKind) -> Option<&mut VehicleType> {
        self.types.iter_mut().find(|row| row.kind == kind)
    }

    /// Whether there is a type of a kind.
    pub(crate) fn has_type(&self, kind: VehicleKind) -> Result<(), TrafficError> {
        let found = self.types.iter().any(|row| row.kind == kind);
        if found { Ok(()) } else { Err(TrafficError::NoSuchType { kind }) }
    }

    /// The type of a row; vehicles name only rows that there are.
    #[inline]
    pub(crate) fn vehicle_type(&self, row: u8) -> &VehicleType {
        &self.types[usize::from(row)]
    }
}
