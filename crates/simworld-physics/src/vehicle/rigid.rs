//! A vehicle in full detail: a rigid body on struts, whose wheels roll on what rays find under them.
//!
//! The forces of a substep are found from the state at its start and go into the engine as one impulse and one
//! torque. Weight transfer, dive and roll are not computed anywhere: they are what the body does.

use parry3d_f64::mass_properties::MassProperties;
use parry3d_f64::query::Ray;
use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::prelude::{Collider, ColliderBuilder, RigidBody, SharedShape};
use simworld_core::asset::Material;
use simworld_core::geometry::{Pose, Vector3};
use simworld_core::id::EntityId;
use simworld_core::ops;

use super::balance::Lean;
use super::wheel::{Ground, PatchMotion, Torques, Wheel};
use super::{AxleParameters, Vehicle, VehicleParameters, axle_of};
use crate::body::Surroundings;
use crate::convert::{from_vector, to_point, to_vector};
use crate::shape::{BodyTag, material_of};
use crate::surface::Conditions;

/// Density of air at sea level and 15 °C, kg/m³.
const AIR: f64 = 1.225;
/// A strut closer to the plane of the road than this (the cosine of its angle to the normal) stands on nothing.
const FLAT: f64 = 0.2;
/// Height of the upper end of a strut over the wheel at its bump stop, m.
const STRUT: f64 = 0.15;

/// How the body moves in the world frame.
struct Motion {
    pose: Pose,
    center: Vector3,
    linear: Vector3,
    angular: Vector3,
}

impl Motion {
    fn of(rigid: &RigidBody, pose: Pose) -> Self {
        let center = from_vector(rigid.center_of_mass());
        Self { pose, center, linear: from_vector(rigid.linvel()), angular: from_vector(rigid.angvel()) }
    }

    fn at(&self, point: &Vector3) -> Vector3 {
        self.linear + self.angular.cross(&(point - self.center))
    }
}

/// A force and a torque about the centre of mass, world frame, N and N m.
#[derive(Default)]
struct Wrench {
    force: Vector3,
    torque: Vector3,
}

impl Wrench {
    fn push(&mut self, force: Vector3, arm: Vector3) {
        self.force += force;
        self.torque += arm.cross(&force);
    }
}

/// Height of the upper end of a strut over the ground at rest, m.
fn strut_height(axle: &AxleParameters) -> f64 {
    axle.wheel_radius + axle.travel + STRUT
}

impl Vehicle {
    /// Mass and inertia by the radii of gyration.
    pub(super) fn mass_properties(&self) -> MassProperties {
        let chassis = &self.parameters.chassis;
        let [roll, pitch, yaw] = chassis.gyration.map(|radius| chassis.mass * radius * radius);
        MassProperties::new(to_vector(&self.center_of_mass()), chassis.mass, Vector::new(roll, pitch, yaw))
    }

    /// The solid: a box over the clearance, of a two-wheeler the rider as a capsule that may lean.
    pub(super) fn hull(&self, id: EntityId) -> Collider {
        let chassis = &self.parameters.chassis;
        let (solid, middle) = if self.parameters.balance.is_some() {
            let (foot, radius) = (chassis.height * 0.15, chassis.width * 0.5);
            let half = ((chassis.height - foot) * 0.5 - radius).max(0.0);
            (SharedShape::capsule_z(half, radius), (chassis.height + foot) * 0.5)
        } else {
            let half = (chassis.height - chassis.clearance) * 0.5;
            (SharedShape::cuboid(chassis.length * 0.5, chassis.width * 0.5, half), chassis.clearance + half)
        };
        ColliderBuilder::new(solid)
            .position(RapierPose::from_translation(Vector::new(0.0, 0.0, middle)))
            .density(0.0)
            .friction(Material::Metal.friction())
            .restitution(Material::Metal.restitution())
            .user_data(BodyTag::Entity(id).to_user_data())
            .build()
    }

    /// Finds what is under the wheels.
    pub(super) fn look_down(&mut self, around: &Surroundings<'_>) {
        let queries = around.queries();
        let down = -(self.state.pose.rotation * Vector3::z());
        let (parameters, pose) = (&self.parameters, &self.state.pose);
        for wheel in &mut self.wheels {
            let axle = axle_of(parameters, wheel);
            let height = strut_height(axle);
            let top = pose * nalgebra::Point3::new(wheel.x, wheel.y, height);
            let ray = Ray::new(to_point(&top), to_vector(&down));
            let reach = height + wheel.droop(axle);
            wheel.ground = queries.cast_ray_and_get_normal(&ray, reach, true).and_then(|(handle, hit)| {
                let collider = around.physics.colliders.get(handle)?;
                let normal = from_vector(hit.normal);
                let parent = collider.parent().and_then(|parent| around.physics.bodies.get(parent));
                let velocity = parent.map_or_else(Vector3::zeros, |rigid| {
                    from_vector(rigid.velocity_at_point(ray.point_at(hit.time_of_impact)))
                });
                let grip = around.conditions().road.grip(material_of(collider.user_data));
                // Seen from inside, a solid has no normal there: the wheel stands on nothing.
                (normal.dot(&-down) > FLAT).then_some(Ground {
                    distance: hit.time_of_impact,
                    normal,
                    grip,
                    velocity,
                })
            });
        }
    }

    /// Applies the forces of road, air and rider for a substep.
    pub(super) fn push(&mut self, rigid: &mut RigidBody, conditions: &Conditions, dt: f64) {
        let motion = Motion::of(rigid, self.state.pose);
        let mut wrench = Wrench::default();
        let mut steering = self.controls.steering;
        if let Some(lean_left) = self.balance(&motion, &mut steering) {
            wrench.torque -= motion.pose.rotation * Vector3::x() * lean_left;
        }
        self.follow_controls(steering, dt);
        self.load_wheels(&motion);
        self.roll_wheels(&motion, dt, &mut wrench);
        let through_air = motion.linear - conditions.wind;
        let drag = 0.5 * AIR * self.parameters.chassis.drag_area * through_air.norm();
        wrench.force -= through_air * drag;
        rigid.apply_impulse(to_vector(&(wrench.force * dt)), false);
        rigid.apply_torque_impulse(to_vector(&(wrench.torque * dt)), false);
    }

    /// The rider's torque to the left, N m, and steering; none without a rider, or once fallen.
    fn balance(&self, motion: &Motion, steering: &mut f64) -> Option<f64> {
        let rider = self.parameters.balance.as_ref()?;
        let (up, ahead) = (motion.pose.rotation * Vector3::z(), motion.pose.rotation * Vector3::x());
        let left = Vector3::z().cross(&ahead);
        let lean = Lean {
            angle: ops::atan2(up.dot(&left), up.z),
            rate: -motion.angular.dot(&ahead),
            speed: motion.linear.dot(&ahead),
        };
        let answer = rider.keep(*steering, self.parameters.chassis.wheelbase, lean)?;
        *steering = answer.steering;
        Some(answer.torque)
    }

    /// Springs, dampers and anti-roll bars: how much each wheel carries.
    fn load_wheels(&mut self, motion: &Motion) {
        let up = motion.pose.rotation * Vector3::z();
        let parameters = &self.parameters;
        for wheel in &mut self.wheels {
            let axle = axle_of(parameters, wheel);
            let Some(ground) = wheel.ground else {
                wheel.compression = -wheel.droop(axle);
                wheel.load = 0.0;
                continue;
            };
            wheel.compression = strut_height(axle) - ground.distance;
            let contact = contact_of(&motion.pose, wheel, axle, &ground);
            let approach = -(motion.at(&contact) - ground.velocity).dot(&ground.normal);
            wheel.load = wheel.spring_force(axle, approach / up.dot(&ground.normal));
        }
        for pair in self.wheels.chunks_exact_mut(2).filter(|pair| pair[0].x == pair[1].x) {
            let bar =
                axle_of(parameters, &pair[0]).anti_roll_rate * (pair[0].compression - pair[1].compression);
            pair[0].load += bar;
            pair[1].load -= bar;
        }
        for wheel in &mut self.wheels {
            // What the strut carries is the part of the road's force along it.
            wheel.load = wheel.ground.map_or(0.0, |ground| wheel.load.max(0.0) / up.dot(&ground.normal));
        }
    }

    /// Engine, brakes, steering and tyres.
    fn roll_wheels(&mut self, motion: &Motion, dt: f64, wrench: &mut Wrench) {
        let axle_torques = self.axle_torques(dt);
        let compliance = self.compliance();
        let (parameters, angle) = (&self.parameters, self.controls.wheel_angle);
        for wheel in &mut self.wheels {
            let axle = axle_of(parameters, wheel);
            let is_front = wheel.x > parameters.center_of_mass_x();
            let place = usize::from(!is_front);
            let steer = if is_front { ackermann(parameters, wheel, angle) } else { 0.0 };
            let (sin, cos) = ops::sin_cos(steer + compliance[place]);
            let Some(ground) = wheel.ground else {
                wheel.roll(
                    axle,
                    parameters.brakes.control,
                    PatchMotion { along: 0.0, across: 0.0 },
                    axle_torques[place],
                    dt,
                );
                continue;
            };
            let heading = motion.pose.rotation * Vector3::new(cos, sin, 0.0);
            let Some(left) = ground.normal.cross(&heading).try_normalize(1e-6) else { continue };
            let ahead = left.cross(&ground.normal);
            let contact = contact_of(&motion.pose, wheel, axle, &ground);
            let over_ground = motion.at(&contact) - ground.velocity;
            let patch = PatchMotion { along: over_ground.dot(&ahead), across: over_ground.dot(&left) };
            let force = wheel.roll(axle, parameters.brakes.control, patch, axle_torques[place], dt);
            let force = ahead * force.x + left * force.y + ground.normal * wheel.load;
            wrench.push(force, contact - motion.center);
        }
    }

    /// Torques at one wheel of the front and of the rear axle.
    fn axle_torques(&mut self, dt: f64) -> [Torques; 2] {
        let throttle = self.engine_throttle();
        let parameters = &self.parameters;
        let shares =
            [parameters.powertrain.drive.front_share(), 1.0 - parameters.powertrain.drive.front_share()];
        let axles = [&parameters.front, &parameters.rear];
        let mean_spin = |front: bool| {
            let of_axle =
                self.wheels.iter().filter(|wheel| (wheel.x > parameters.center_of_mass_x()) == front);
            let (sum, count) =
                of_axle.fold((0.0, 0.0), |(sum, count), wheel| (sum + wheel.spin, count + 1.0));
            sum / count
        };
        let spin = shares[0] * mean_spin(true) + shares[1] * mean_spin(false);
        let radius = shares[0] * axles[0].wheel_radius + shares[1] * axles[1].wheel_radius;
        let output = parameters.powertrain.step(&mut self.gearbox, throttle, spin, radius, dt);
        let brakes = &parameters.brakes;
        let brake = self.controls.braking * brakes.deceleration * parameters.chassis.mass;
        let brake_shares = [brakes.front_share, 1.0 - brakes.front_share];
        std::array::from_fn(|place| {
            let wheels = axles[place].wheels() as f64;
            Torques {
                drive: output.torque * shares[place] / wheels,
                brake: brake * brake_shares[place] * axles[place].wheel_radius / wheels,
                inertia: output.inertia * shares[place] / wheels,
            }
        })
    }

    /// Angles by which the axles give under the lateral forces of the last substep, radians, positive to the left.
    fn compliance(&self) -> [f64; 2] {
        let middle = self.parameters.center_of_mass_x();
        let (front, rear) = self.wheels.iter().fold((0.0, 0.0), |(front, rear), wheel| {
            if wheel.x > middle { (front + wheel.force[1], rear) } else { (front, rear + wheel.force[1]) }
        });
        [-self.parameters.front.compliance_steer * front, self.parameters.rear.compliance_steer * rear]
    }
}

/// Where a wheel touches the ground, world frame.
fn contact_of(pose: &Pose, wheel: &Wheel, axle: &AxleParameters, ground: &Ground) -> Vector3 {
    let point = nalgebra::Point3::new(wheel.x, wheel.y, strut_height(axle) - ground.distance);
    (pose * point).coords
}

/// The angle of one front wheel so that both roll around the same point (Ackermann).
fn ackermann(parameters: &VehicleParameters, wheel: &Wheel, angle: f64) -> f64 {
    let (length, tangent) = (parameters.chassis.wheelbase, ops::tan(angle));
    ops::atan2(length * tangent, length - wheel.y * tangent)
}
