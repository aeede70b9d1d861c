//! What vehicles of each class are known to do, and what ours do.

use super::ProvingError;
use super::manoeuvre::{
    acceleration_time, braking_distance, lane_change, lateral_limit, steady_turn, top_speed,
};
use crate::{RoadCondition, VehicleClass};

/// A figure of a vehicle beside its band.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// What was measured, with its unit.
    pub name: String,
    /// Its value; NaN if the manoeuvre came to nothing.
    pub value: f64,
    /// The least that belongs to the class.
    pub low: f64,
    /// The most.
    pub high: f64,
    /// Where the band is from.
    pub source: &'static str,
}

impl Figure {
    /// Whether the value lies in its band.
    pub fn holds(&self) -> bool {
        (self.low..=self.high).contains(&self.value)
    }
}

/// The bands of a class: speeds in km/h as they are quoted.
struct Bands {
    acceleration: (f64, [f64; 2]),
    braking_from: f64,
    braking: [[f64; 2]; 3],
    top: [f64; 2],
    lateral: (f64, [f64; 2]),
    turn_at: f64,
    understeer: [f64; 2],
    lane_change: f64,
    tilt: f64,
}

const KMH: f64 = 1.0 / 3.6;
const SHEETS: &str = "data sheets of the class";
const ROAD_TESTS: &str = "road tests; Noon 1994 for snow";
const RULE_13: &str = "UN regulation 13; Noon 1994";

fn bands(class: VehicleClass) -> Bands {
    use VehicleClass::{Bus, Scooter, Sedan, SmallCar, Suv, Truck, Van};
    // v² / (2 μ g) for packed snow, μ from 0.20 to 0.35: 112 to 197 m from 100 km/h, 40 to 71 m from 60 km/h.
    let car = Bands {
        acceleration: (100.0, [9.0, 12.0]),
        braking_from: 100.0,
        braking: [[34.0, 42.0], [44.0, 56.0], [112.0, 197.0]],
        top: [190.0, 210.0],
        lateral: (80.0, [0.7, 0.92]),
        turn_at: 70.0,
        understeer: [0.0, 6.0],
        lane_change: 60.0,
        tilt: 8.0,
    };
    let heavy = Bands {
        braking_from: 60.0,
        braking: [[20.0, 36.7], [21.8, 36.7], [40.0, 71.0]],
        lateral: (50.0, [0.4, 0.7]),
        turn_at: 45.0,
        understeer: [0.0, 9.0],
        tilt: 10.0,
        ..car
    };
    match class {
        SmallCar => Bands { acceleration: (100.0, [11.0, 15.0]), top: [160.0, 175.0], ..car },
        Sedan => car,
        Suv => Bands { acceleration: (100.0, [8.0, 11.5]), top: [185.0, 205.0], ..car },
        Van => Bands {
            acceleration: (100.0, [12.0, 20.0]),
            braking: [[36.0, 48.0], [46.0, 62.0], [112.0, 197.0]],
            top: [145.0, 165.0],
            lateral: (80.0, [0.55, 0.85]),
            ..car
        },
        Truck => Bands { acceleration: (80.0, [20.0, 45.0]), top: [84.0, 91.0], ..heavy },
        Bus => Bands { acceleration: (50.0, [9.0, 18.0]), top: [78.0, 85.0], ..heavy },
        Scooter => Bands {
            acceleration: (20.0, [3.0, 7.0]),
            braking_from: 20.0,
            // 3.5 m/s² is the least by the German and French rules; a rider cannot do much more than 5.
            braking: [[3.0, 5.5], [3.0, 6.5], [4.4, 8.0]],
            top: [24.0, 25.5],
            lateral: (20.0, [0.25, 0.5]),
            turn_at: 20.0,
            understeer: [-3.0, 3.0],
            lane_change: 20.0,
            tilt: 30.0,
        },
    }
}

/// Measures a class by every manoeuvre.
///
/// # Errors
/// The physics could not go on.
pub fn measure(class: VehicleClass) -> Result<Vec<Figure>, ProvingError> {
    let (vehicle, bands) = (class.parameters(), bands(class));
    let mut figures = Vec::new();
    let mut note = |name: String, value: f64, [low, high]: [f64; 2], source| {
        figures.push(Figure { name, value, low, high, source });
    };
    let (speed, band) = bands.acceleration;
    let time = acceleration_time(&vehicle, speed * KMH)?.unwrap_or(f64::NAN);
    note(format!("0-{speed:.0} km/h, s"), time, band, SHEETS);
    let roads = [RoadCondition::Dry, RoadCondition::Wet, RoadCondition::Snow];
    let source = if vehicle.chassis.mass > 5e3 { RULE_13 } else { ROAD_TESTS };
    for (road, band) in roads.into_iter().zip(bands.braking) {
        let from = bands.braking_from;
        let way = braking_distance(&vehicle, road, from * KMH)?.unwrap_or(f64::NAN);
        note(format!("{from:.0}-0 km/h {}, m", format!("{road:?}").to_lowercase()), way, band, source);
    }
    note("top speed, km/h".to_owned(), top_speed(&vehicle)? / KMH, bands.top, SHEETS);
    let (speed, band) = bands.lateral;
    let limit = lateral_limit(&vehicle, speed * KMH)?;
    note("lateral limit, g".to_owned(), limit, band, "skid pads; CommonRoad multi-body 0.82");
    let lateral = 0.3f64.min(limit * 0.7);
    let turn = steady_turn(&vehicle, bands.turn_at * KMH, lateral)?;
    let name = format!("understeer at {lateral:.2} g, °/g");
    note(name, turn.understeer.to_degrees(), bands.understeer, "Gillespie 1992, chapter 6");
    let change = lane_change(&vehicle, bands.lane_change * KMH)?;
    let name = format!("tilt in a double lane change at {:.0} km/h, °", bands.lane_change);
    note(name, change.tilt.to_degrees(), [0.1, bands.tilt], "ISO 3888-1; stays on its wheels");
    note("deviation in it, m".to_owned(), change.deviation, [0.0, 1.2], "ISO 3888-1: lane widths");
    Ok(figures)
}
