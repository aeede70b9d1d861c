//! Types of vehicles.

use super::SumoDemand;
use crate::VehicleChoice;
use crate::sumo::SumoError;
use crate::sumo::xml::Element;
use crate::vehicle::{CarFollowing, Idm, VehicleKind, VehicleType, standard_types};

/// Rows of a table of types.
const MOST_ROWS: usize = 255;

/// A type of vehicle as the file has it; what it does not say is the default of its class.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SumoType {
    /// Its id.
    pub id: String,
    /// Its class: `passenger`, `bus`, `bicycle` and so on.
    pub class: String,
    /// Length, m.
    pub length: Option<f64>,
    /// Width, m.
    pub width: Option<f64>,
    /// Height, m.
    pub height: Option<f64>,
    /// Gap to the leader at rest, m.
    pub min_gap: Option<f64>,
    /// Highest speed, m/s.
    pub max_speed: Option<f64>,
    /// Acceleration, m/s².
    pub accel: Option<f64>,
    /// Comfortable deceleration, m/s².
    pub decel: Option<f64>,
    /// Hardest deceleration, m/s².
    pub emergency_decel: Option<f64>,
    /// Desired time headway, s.
    pub tau: Option<f64>,
    /// Mean of the speeds chosen, as a share of the limit.
    pub speed_factor: Option<f64>,
    /// Deviation of that share.
    pub speed_deviation: Option<f64>,
    /// The car-following model: `Krauss`, `IDM`, `ACC` and others.
    pub car_following: Option<String>,
    /// Imperfection of a driver by Krauss, 0 to 1.
    pub sigma: Option<f64>,
}

impl SumoType {
    pub(super) fn of(element: &Element<'_>) -> Result<Self, SumoError> {
        let positive = |name: &'static str| match element.number(name)? {
            Some(value) if value < 0.0 => Err(element.error(name, "is negative")),
            value => Ok(value),
        };
        let (speed_factor, mut speed_deviation) = speed_factor(element)?;
        if let Some(deviation) = positive("speedDev")? {
            speed_deviation = Some(deviation);
        }
        Ok(Self {
            id: element.text("id")?,
            class: element.get("vClass").map_or_else(|| "passenger".to_owned(), std::borrow::Cow::into_owned),
            length: positive("length")?,
            width: positive("width")?,
            height: positive("height")?,
            min_gap: positive("minGap")?,
            max_speed: positive("maxSpeed")?,
            accel: positive("accel")?,
            decel: positive("decel")?,
            emergency_decel: positive("emergencyDecel")?,
            tau: positive("tau")?,
            speed_factor,
            speed_deviation,
            car_following: element.get("carFollowModel").map(std::borrow::Cow::into_owned),
            sigma: positive("sigma")?,
        })
    }

    /// The type as a row of the table.
    fn row(&self, standard: &[VehicleType]) -> VehicleType {
        let kind = self.kind();
        let base = standard.iter().find(|row| row.kind == kind).cloned().unwrap_or_default();
        let within =
            |given: Option<f64>, usual: f64, low: f64, high: f64| given.unwrap_or(usual).clamp(low, high);
        let speed_factor = within(self.speed_factor, base.speed_factor, 0.2, 2.0);
        let deceleration = within(self.decel, base.driver.deceleration, 0.5, 6.0);
        VehicleType {
            kind,
            share: 0.0,
            length: within(self.length, base.length, 0.5, 30.0),
            width: within(self.width, base.width, 0.3, 3.0),
            height: within(self.height, base.height, 0.5, 5.0),
            speed_factor,
            speed_deviation: within(
                self.speed_deviation,
                base.speed_deviation,
                0.0,
                0.3f64.min(0.4 * speed_factor),
            ),
            driver: Idm {
                desired_speed: within(self.max_speed, base.driver.desired_speed, 1.0, 70.0),
                headway: within(self.tau, base.driver.headway, 0.3, 5.0),
                gap: within(self.min_gap, base.driver.gap, 0.5, 10.0),
                acceleration: within(self.accel, base.driver.acceleration, 0.2, 6.0),
                deceleration,
                emergency_deceleration: within(
                    self.emergency_decel,
                    base.driver.emergency_deceleration.max(deceleration),
                    deceleration,
                    12.0,
                ),
            },
            model: self.model().unwrap_or(base.model),
            perception: base.perception,
            siren: false,
        }
    }

    /// The model by which it follows; `None` if the file does not say, or names one that there is not here.
    pub fn model(&self) -> Option<CarFollowing> {
        match self.car_following.as_deref()? {
            // SUMO's default of sigma.
            "Krauss" | "KraussOrig1" | "KraussPS" => {
                Some(CarFollowing::Krauss { sigma: self.sigma.unwrap_or(0.5).clamp(0.0, 1.0) })
            }
            "IDM" => Some(CarFollowing::Idm),
            // The authors' value; SUMO's controller of this name has no such parameter.
            "ACC" => Some(CarFollowing::Acc { coolness: 0.99 }),
            _ => None,
        }
    }

    /// The kind of vehicle that its class is.
    pub fn kind(&self) -> VehicleKind {
        kind_of(&self.class)
    }
}

/// A number, or `normc(mean, deviation, ...)`.
fn speed_factor(element: &Element<'_>) -> Result<(Option<f64>, Option<f64>), SumoError> {
    let name = "speedFactor";
    let Some(text) = element.get(name) else { return Ok((None, None)) };
    let Some(list) = text.trim().strip_prefix("normc(").or_else(|| text.trim().strip_prefix("norm(")) else {
        return Ok((element.number(name)?, None));
    };
    let mut numbers = list.trim_end_matches(')').split(',').map(|number| number.trim().parse::<f64>().ok());
    match (numbers.next().flatten(), numbers.next().flatten()) {
        (Some(mean), Some(deviation)) if mean.is_finite() && deviation >= 0.0 => {
            Ok((Some(mean), Some(deviation)))
        }
        _ => Err(element.error(name, "is no distribution: give normc(mean, deviation)")),
    }
}

/// The kind of vehicle that a class is.
fn kind_of(class: &str) -> VehicleKind {
    match class {
        "bus" | "coach" => VehicleKind::Bus,
        "truck" | "trailer" => VehicleKind::Truck,
        "delivery" => VehicleKind::Van,
        "motorcycle" | "moped" => VehicleKind::Motorcycle,
        "bicycle" => VehicleKind::Bicycle,
        "scooter" => VehicleKind::Scooter,
        "emergency" | "authority" | "army" => VehicleKind::Emergency,
        _ => VehicleKind::Car,
    }
}

impl SumoDemand {
    /// The table of types for [`TrafficConfig::types`](crate::TrafficConfig::types): the standard ones, then one a type of
    /// the file, as far as rows are left. What the file does not say is that of the standard type of its kind; what is out
    /// of range here is brought into it.
    pub fn vehicle_types(&self) -> Vec<VehicleType> {
        let standard = standard_types();
        let rows = self.types.iter().map(|one| one.row(&standard)).take(MOST_ROWS - standard.len());
        standard.iter().cloned().chain(rows).collect()
    }

    /// Which vehicle a type of that id is.
    pub(super) fn choice(&self, id: &str) -> Option<VehicleChoice> {
        let index = self.types.iter().position(|one| one.id == id)?;
        let row = VehicleKind::ALL.len() + index;
        Some(if row < MOST_ROWS { VehicleChoice::Type(row) } else { self.types[index].kind().into() })
    }

    /// The type of an id.
    pub fn vehicle_type(&self, id: &str) -> Option<&SumoType> {
        self.types.iter().find(|one| one.id == id)
    }
}
