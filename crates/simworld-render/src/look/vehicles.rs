//! Vehicles: their class by what they are called and how large they are, their wheels, and who rides them.
//!
//! Wheels turn by the way along the heading, and front wheels stand as the turn demands.

use nalgebra::UnitQuaternion;
use simworld_core::geometry::{Pose, Vector3};
use simworld_core::ops;
use simworld_core::scene::{EntityKind, EntityRef, Role, Scene};
use simworld_core::value::Value;

use super::people::Figure;
use super::{Detail, Look, Part, pick, riders, way};
use crate::mesh::MeshId;
use crate::mesh::cycles::CYCLE_WHEELS;

type Color = [f32; 3];

/// Car paint, in the shares in which cars are bought.
const PAINT: [Color; 12] = [
    [0.78, 0.78, 0.78],
    [0.78, 0.78, 0.78],
    [0.025, 0.025, 0.03],
    [0.025, 0.025, 0.03],
    [0.22, 0.23, 0.25],
    [0.42, 0.43, 0.45],
    [0.02, 0.07, 0.26],
    [0.36, 0.015, 0.015],
    [0.04, 0.16, 0.13],
    [0.45, 0.3, 0.12],
    [0.1, 0.24, 0.42],
    [0.62, 0.58, 0.5],
];
/// Faster ones have somebody on them, m/s.
const RIDDEN_SPEED: f64 = 0.3;
/// A cycle whose solid is higher than this holds its rider, m.
const RIDDEN_HEIGHT: f32 = 1.4;

/// A class of vehicle: its meshes and its axles.
struct Class {
    mesh: MeshId,
    far: MeshId,
    /// x share of each axle; the first one steers.
    axles: &'static [f32],
    /// Radius of the wheels, m.
    radius: f64,
    extra: Option<MeshId>,
}

const fn class(mesh: MeshId, far: MeshId, axles: &'static [f32], radius: f64) -> Class {
    Class { mesh, far, axles, radius, extra: None }
}

const CAR_AXLES: &[f32] = &[0.31, -0.31];

fn class_of(entity: &EntityRef<'_>, name: &str, size: [f32; 3], bits: u64) -> Class {
    let is = |words: &[&str]| words.iter().any(|word| name.contains(word));
    let car = |mesh, radius| class(mesh, MeshId::FarCar, CAR_AXLES, radius);
    let truck = |mesh| class(mesh, MeshId::FarTruck, &[0.36, -0.3], 0.5);
    match entity.kind {
        EntityKind::Bus if is(&["double_decker"]) || size[2] > 4.0 => {
            class(MeshId::DoubleDecker, MeshId::FarBus, &[0.3, -0.28], 0.48)
        }
        EntityKind::Bus => class(MeshId::Bus, MeshId::FarBus, &[0.3, -0.28], 0.48),
        EntityKind::Truck if is(&["pickup"]) || size[2] < 2.0 => car(MeshId::Pickup, 0.38),
        EntityKind::Truck if is(&["fire_engine"]) => {
            Class { extra: Some(MeshId::LightBar), ..truck(MeshId::FireEngine) }
        }
        EntityKind::Truck if is(&["ambulance"]) => Class {
            extra: Some(MeshId::LightBar),
            ..class(MeshId::Van, MeshId::FarTruck, &[0.32, -0.32], 0.35)
        },
        EntityKind::Truck if is(&["tanker", "cement"]) => truck(MeshId::Tanker),
        EntityKind::Truck if is(&["dump", "flatbed", "tow"]) => truck(MeshId::Tipper),
        EntityKind::Truck if size[2] < 2.85 => class(MeshId::Van, MeshId::FarTruck, &[0.32, -0.32], 0.35),
        EntityKind::Truck => truck(MeshId::Truck),
        _ if is(&["suv", "jeep"]) || size[2] > 1.6 => car(MeshId::Suv, 0.37),
        _ if is(&["sports"]) || size[2] < 1.32 => car(MeshId::Sports, 0.34),
        _ if is(&["taxi"]) => Class { extra: Some(MeshId::TaxiSign), ..car(MeshId::Sedan, 0.33) },
        _ if is(&["police"]) => Class { extra: Some(MeshId::LightBar), ..car(MeshId::Sedan, 0.33) },
        _ if size[0] < 4.2 => car(MeshId::Hatchback, 0.31),
        _ => match bits % 5 {
            0 => car(MeshId::Hatchback, 0.31),
            1 => car(MeshId::Estate, 0.33),
            _ => car(MeshId::Sedan, 0.33),
        },
    }
}

/// A vehicle as it is drawn at that detail.
pub(super) fn dress(
    entity: &EntityRef<'_>,
    scene: &dyn Scene,
    look: &Look,
    bits: u64,
    detail: Detail,
    parts: &mut Vec<Part>,
) {
    let color = super::own_color(entity, scene);
    if matches!(entity.kind, EntityKind::Bicycle | EntityKind::Motorcycle | EntityKind::Scooter) {
        return cycle(entity, scene, look, color, bits, detail, parts);
    }
    let name = super::asset_name(entity, scene).unwrap_or_default();
    let class = class_of(entity, name, look.scale, bits);
    let paint = color.unwrap_or(match entity.kind {
        EntityKind::Bus => {
            pick(&[[0.62, 0.05, 0.04], [0.03, 0.14, 0.4], [0.7, 0.5, 0.05], [0.06, 0.3, 0.14]], bits)
        }
        _ => pick(&PAINT, bits >> 4),
    });
    let second = if name.contains("tanker") { [0.6, 0.61, 0.62] } else { pick(&LOADS, bits >> 9) };
    let second = if name.contains("garbage") || name.contains("dump") { paint } else { second };
    let body = Look { unit: 1.0, color: paint, second, ..*look };
    if detail == Detail::Far {
        parts.push(Part { look: Look { mesh: class.far, ..body }, place: Pose::identity() });
        return;
    }
    parts.push(Part { look: Look { mesh: class.mesh, ..body }, place: Pose::identity() });
    if let Some(extra) = class.extra {
        let color = if extra == MeshId::LightBar { [0.02, 0.08, 0.8] } else { paint };
        parts.push(Part { look: Look { mesh: extra, color, ..body }, place: Pose::identity() });
        if extra == MeshId::LightBar && detail == Detail::Near {
            let color = if name.contains("police") { [0.02, 0.05, 0.3] } else { [0.75, 0.6, 0.05] };
            parts.push(Part { look: Look { mesh: MeshId::Stripe, color, ..body }, place: Pose::identity() });
        }
    }
    let wheel = if detail == Detail::Near { MeshId::Wheel } else { MeshId::CoarseWheel };
    axles(entity, &class, wheel, &body, parts);
}

/// Boxes of lorries.
const LOADS: [Color; 4] = [[0.72, 0.72, 0.7], [0.62, 0.62, 0.6], [0.2, 0.3, 0.42], [0.5, 0.3, 0.1]];

fn axles(entity: &EntityRef<'_>, class: &Class, wheel: MeshId, body: &Look, parts: &mut Vec<Part>) {
    let [length, width, _] = body.scale.map(f64::from);
    let turn = way(entity) / class.radius;
    let base = length * f64::from(class.axles[0] - class.axles[class.axles.len() - 1]);
    let steer = steering(entity, base);
    let look = Look { mesh: wheel, unit: class.radius as f32, ..*body };
    for (axle, x) in class.axles.iter().enumerate() {
        let steer = if axle == 0 { steer } else { 0.0 };
        for side in [1.0, -1.0] {
            let at = Vector3::new(
                length * f64::from(*x),
                side * (width * 0.5 - 0.31 * class.radius),
                class.radius,
            );
            parts.push(Part { look, place: rolled(at, steer, turn) });
        }
    }
}

/// A wheel at a place, steered to the left and rolled forward by so much.
fn rolled(at: Vector3, steer: f64, turn: f64) -> Pose {
    let steer = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), steer);
    let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), turn);
    Pose::from_parts(at.into(), steer * turn)
}

/// How the front wheels stand for the turn that the vehicle makes, radians to the left.
fn steering(entity: &EntityRef<'_>, wheelbase: f64) -> f64 {
    let speed = entity.twist.ground_speed();
    if speed < 0.2 {
        return 0.0;
    }
    let forward = entity.twist.linear.dot(&(entity.pose.rotation * Vector3::x()));
    ops::atan2(wheelbase * entity.twist.angular.z * forward.signum(), speed).clamp(-0.6, 0.6)
}

/// Two wheels, with a rider if it is ridden and nobody says by whom.
fn cycle(
    entity: &EntityRef<'_>,
    scene: &dyn Scene,
    look: &Look,
    color: Option<Color>,
    bits: u64,
    detail: Detail,
    parts: &mut Vec<Part>,
) {
    let (mesh, wheel, radius) = match entity.kind {
        EntityKind::Bicycle => (MeshId::Bicycle, MeshId::CycleWheel, CYCLE_WHEELS[0]),
        EntityKind::Motorcycle => (MeshId::Motorcycle, MeshId::MotorWheel, CYCLE_WHEELS[1]),
        _ => (MeshId::Scooter, MeshId::MotorWheel, CYCLE_WHEELS[2]),
    };
    let tall = look.scale[2] > RIDDEN_HEIGHT;
    let [length, width, height] = look.scale;
    let scale = [length, width, if tall { 1.12 } else { height }];
    let color = color.unwrap_or(pick(&super::people::CLOTHES, bits));
    let body = Look { mesh, scale, unit: 1.0, color, second: color, ..*look };
    let ridden = is_ridden(entity, scene, tall, detail);
    let figure = Figure::new(1.6 + 0.25 * f64::from(look.seed), look.seed, bits >> 5).helmeted();
    if detail == Detail::Far {
        parts.push(Part { look: Look { mesh: MeshId::FarCycle, ..body }, place: Pose::identity() });
        if ridden {
            let (rider, up) = match entity.kind {
                EntityKind::Scooter => (MeshId::Standing, 0.16),
                _ => (MeshId::Sitting, f64::from(scale[2]) * 0.82),
            };
            let place = Pose::from_parts(Vector3::new(-0.15, 0.0, up).into(), UnitQuaternion::identity());
            figure.emit_far(rider, place, parts);
        }
        return;
    }
    parts.push(Part { look: body, place: Pose::identity() });
    let turn = way(entity) / radius;
    let wheel = Look { mesh: wheel, unit: radius as f32, ..body };
    for (x, steer) in [(1.0, steering(entity, 1.0)), (-1.0, 0.0)] {
        let at = Vector3::new(x * (f64::from(length) * 0.5 - radius), 0.0, radius);
        parts.push(Part { look: wheel, place: rolled(at, steer, turn) });
    }
    if ridden {
        let shape =
            simworld_core::scene::Shape::cuboid(f64::from(length), f64::from(width), f64::from(scale[2]));
        let posture = riders::on(entity.kind, &shape, figure.height(), turn * 0.4);
        figure.emit(&posture, &Pose::identity(), detail, parts);
    }
}

fn is_ridden(entity: &EntityRef<'_>, scene: &dyn Scene, tall: bool, detail: Detail) -> bool {
    let parked = entity.info.attributes.get("parked") == Some(&Value::Bool(true));
    let moves = entity.twist.ground_speed() > RIDDEN_SPEED;
    if entity.attachment.is_some() || parked || !(moves || tall) {
        return false;
    }
    detail == Detail::Far || scene.attached(entity.id, Role::Aboard).is_none()
}
