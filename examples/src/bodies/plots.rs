//! How far vehicles brake, and what walking and running cost.

use simworld_core::exertion::Exertion;
use simworld_physics::{RoadCondition, VehicleClass};

use super::chart::{Axis, Chart, Pen};

/// Braking distances of a class on a road.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Which vehicle.
    pub class: VehicleClass,
    /// On which road.
    pub road: RoadCondition,
    /// Speed, km/h, and way to rest, m.
    pub points: Vec<(f64, f64)>,
}

fn color(class: VehicleClass) -> &'static str {
    // The palette of Okabe and Ito, which colour-blind people tell apart.
    match class {
        VehicleClass::SmallCar => "#e69f00",
        VehicleClass::Sedan => "#0072b2",
        VehicleClass::Suv => "#009e73",
        VehicleClass::Van => "#cc79a7",
        VehicleClass::Truck => "#d55e00",
        VehicleClass::Bus => "#000000",
        VehicleClass::Scooter => "#56b4e9",
    }
}

fn dashes(road: RoadCondition) -> &'static str {
    match road {
        RoadCondition::Dry => "none",
        RoadCondition::Wet => "8 4",
        RoadCondition::Snow | RoadCondition::Ice => "2 4",
    }
}

/// Ways to rest by speed as an SVG: a colour for each class, whole lines on dry roads, dashes on wet ones, dots on
/// snow.
pub fn braking_chart(curves: &[Curve]) -> String {
    let across = Axis { title: "speed, km/h", most: 130.0, step: 10.0 };
    let mut chart = Chart::new(across, Axis { title: "braking distance, m", most: 220.0, step: 20.0 });
    for curve in curves {
        chart.line(&curve.points, Pen { color: color(curve.class), dashes: dashes(curve.road) });
    }
    for curve in curves.iter().filter(|curve| curve.road == RoadCondition::Dry) {
        let pen = Pen { color: color(curve.class), dashes: "none" };
        chart.explain(pen, &curve.class.to_string().replace('_', " "));
    }
    let roads = [(RoadCondition::Dry, "dry"), (RoadCondition::Wet, "wet"), (RoadCondition::Snow, "snow")];
    for (road, words) in roads {
        chart.explain(Pen { color: "#666666", dashes: dashes(road) }, words);
    }
    chart.finish()
}

/// Metabolic power by speed of somebody of 70 kg as an SVG: on the level and uphill, with nothing and with 15 kg to carry. Where
/// people change from walking to running the line jumps.
pub fn energy_chart() -> String {
    let across = Axis { title: "speed, m/s", most: 4.0, step: 0.5 };
    let mut chart = Chart::new(across, Axis { title: "metabolic power, W", most: 1800.0, step: 200.0 });
    let loads = [(0.0, "none", "with nothing"), (15.0, "8 4", "with 15 kg")];
    let grades =
        [(0.0, "#0072b2", "level"), (0.05, "#009e73", "5 % uphill"), (0.1, "#d55e00", "10 % uphill")];
    for (load, dashes, _) in loads {
        let who = Exertion { load, ..Exertion::default() };
        for (grade, color, _) in grades {
            let powers: Vec<(f64, f64)> = (0..=80)
                .map(|step| f64::from(step) * 0.05)
                .map(|speed| (speed, who.power(speed, grade)))
                .collect();
            let runs = powers.partition_point(|(speed, _)| *speed < Exertion::change_to_running());
            for gait in [&powers[..runs], &powers[runs..]] {
                chart.line(gait, Pen { color, dashes });
            }
        }
    }
    for (_, color, words) in grades {
        chart.explain(Pen { color, dashes: "none" }, words);
    }
    for (_, dashes, words) in loads {
        chart.explain(Pen { color: "#666666", dashes }, words);
    }
    chart.finish()
}
