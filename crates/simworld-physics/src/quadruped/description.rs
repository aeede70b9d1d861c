//! A quadruped as any other robot is described.

use nalgebra::{Matrix3, UnitQuaternion};
use simworld_core::asset::Material;
use simworld_core::geometry::{Pose, Vector3};

use super::articulation::{HIP_BALL, SHANK, THIGH, rod};
use super::{LEGS, QuadrupedModel};
use crate::convert::from_vector;
use crate::robot::{Base, Form, JointDescription, JointKind, LinkDescription, RobotDescription};

/// The joints of a leg, from the trunk.
const JOINTS: [&str; 3] = ["abduction", "thigh", "knee"];

impl QuadrupedModel {
    /// Its trunk and legs as a robot of links and joints: those of the front left leg are called `front left abduction`,
    /// `front left thigh` and `front left knee`, and their links alike.
    pub fn description(&self) -> RobotDescription {
        let turned = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), std::f64::consts::FRAC_PI_2);
        let (radius, length) =
            (self.trunk_radius, 2.0 * (self.trunk_half_length - self.trunk_radius).max(0.0));
        let trunk = LinkDescription::new("trunk")
            .with_mass(self.trunk_mass, Vector3::zeros(), self.trunk_inertia)
            .with_solid(
                Form::Capsule { radius, length },
                Pose::from_parts(Vector3::zeros().into(), turned),
                Material::Plastic,
            );
        let mut description = RobotDescription {
            name: "quadruped".to_owned(),
            base: Base::Free,
            links: vec![trunk],
            joints: Vec::new(),
            apart: Vec::new(),
        };
        for leg in 0..LEGS.len() {
            self.describe_leg(leg, &mut description);
        }
        description
    }

    fn describe_leg(&self, leg: usize, description: &mut RobotDescription) {
        let geometry = self.leg(leg);
        let offset = Vector3::y() * geometry.offset;
        let anchors = [geometry.hip, offset, -Vector3::z() * geometry.thigh];
        let mut parent = "trunk".to_owned();
        for joint in 0..3 {
            let name = format!("{} {}", LEGS[leg], JOINTS[joint]);
            let axis = if joint == 0 { Vector3::x() } else { Vector3::y() };
            let hinge = JointDescription::new(&name, JointKind::Revolute, [&parent, &name]);
            let hinge = hinge.at(anchors[joint]).about(axis).within(self.limits_of(leg, joint));
            let hinge = hinge.with_motor(self.torques[joint], self.armature);
            description.joints.push(JointDescription { damping: self.damping, ..hinge });
            let mass = self.leg_masses[joint];
            let link = LinkDescription::new(&name);
            description.links.push(match joint {
                0 => {
                    let ball = 0.4 * mass * HIP_BALL * HIP_BALL;
                    link.with_mass(mass, offset * 0.5, [ball; 3])
                }
                1 => Self::bone(link, mass, [geometry.thigh, THIGH, self.leg_centers[0]]),
                _ => Self::bone(link, mass, [geometry.shank, SHANK, self.leg_centers[1]]).with_solid(
                    Form::Sphere { radius: self.foot_radius },
                    Pose::translation(0.0, 0.0, -geometry.shank),
                    Material::Rubber,
                ),
            });
            parent = name;
        }
    }

    /// A limb of a length that hangs from its frame, with its radius and the depth of its centre as shares of that.
    fn bone(link: LinkDescription, mass: f64, [length, share, center]: [f64; 3]) -> LinkDescription {
        let radius = share * length;
        let mut link = link.with_mass(mass, -Vector3::z() * (center * length), [0.0; 3]);
        link.inertia = Matrix3::from_diagonal(&from_vector(rod(mass, length, radius)));
        link.with_solid(
            Form::Capsule { radius, length: (length - 2.0 * radius).max(0.0) },
            Pose::translation(0.0, 0.0, -length * 0.5),
            Material::Plastic,
        )
    }
}
