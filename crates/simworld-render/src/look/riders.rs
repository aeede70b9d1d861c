//! How people sit and stand on what has two wheels; frame of the vehicle.

use simworld_core::geometry::Vector3;
use simworld_core::ops;
use simworld_core::scene::{EntityKind, Shape};

use super::posture::Posture;
use crate::mesh::cycles::{BICYCLE_CRANK, BICYCLE_SADDLE, SCOOTER_DECK};

/// How long a crank is, and how far the pedals are from the middle, m.
const CRANK: [f64; 2] = [0.17, 0.11];

/// Of a person that tall on a vehicle of that kind; `turn` is the angle of the crank.
pub(super) fn on(kind: EntityKind, shape: &Shape, height: f64, turn: f64) -> Posture {
    let size = shape.size();
    let [ankle, rise] = [0.05 * height, 0.05 * height];
    match kind {
        EntityKind::Bicycle => {
            let [x, z] = BICYCLE_CRANK;
            let pedal = |turn: f64, side: f64| {
                let (sin, cos) = ops::sin_cos(turn);
                Vector3::new(x + CRANK[0] * cos - 0.04, side * CRANK[1], z - CRANK[0] * sin + ankle)
            };
            let feet = [pedal(turn, 1.0), pedal(turn + std::f64::consts::PI, -1.0)];
            let [x, z] = BICYCLE_SADDLE;
            let hips = Vector3::new(x + 0.04, 0.0, z + rise);
            Posture::mounted(height, hips, feet, grips(0.36, 0.25, 1.03), 0.5)
        }
        EntityKind::Motorcycle => {
            let feet = [1.0, -1.0].map(|side| Vector3::new(-0.12, 0.2 * side, 0.3 + ankle));
            let hips = Vector3::new(-0.32, 0.0, 0.76 + rise);
            Posture::mounted(height, hips, feet, grips(0.4, 0.33, 1.06), 0.35)
        }
        _ => {
            let deck = Vector3::z() * SCOOTER_DECK;
            let feet =
                [Vector3::new(-0.02, 0.05, ankle), Vector3::new(-0.24, -0.05, ankle)].map(|foot| foot + deck);
            let hips = Vector3::new(-0.13, 0.0, 0.525 * height) + deck;
            Posture::mounted(height, hips, feet, grips(size.x * 0.5 - 0.32, 0.2, size.z - 0.04), 0.08)
        }
    }
}

fn grips(x: f64, y: f64, z: f64) -> [Vector3; 2] {
    [1.0, -1.0].map(|side| Vector3::new(x, y * side, z))
}
