//! How a robot takes part in a physics world.

use rapier3d_f64::prelude::{PhysicsWorld, RigidBodyHandle};
use simworld_core::geometry::Twist;
use simworld_core::id::EntityId;
use simworld_core::scene::{World, WorldError};
use simworld_core::seam::BodyState;

use super::articulation::{Links, Plan, Start, part_from_body, root_twist};
use super::{Robot, Weight};
use crate::body::{BodyContext, PhysicsBody, Surroundings};

impl PhysicsBody for Robot {
    fn attach(&mut self, id: EntityId, physics: &mut PhysicsWorld) -> RigidBodyHandle {
        self.id = Some(id);
        let world_from_root = self.state.pose * self.root_from_entity.inverse();
        let plan = self.plan(id);
        let root = plan.root(&world_from_root, physics);
        self.assemble(physics, root);
        root
    }

    fn parts(&self) -> &[RigidBodyHandle] {
        self.motion.links.as_ref().map_or(&[], Links::bodies)
    }

    fn longest_substep(&self) -> f64 {
        self.config.substep
    }

    fn sense(&mut self, around: &Surroundings<'_>, dt: f64) {
        let Some(links) = &self.motion.links else { return };
        let gravity = around.config().gravity;
        let Some(sensed) = links.sense(around.physics, &self.tree, gravity) else { return };
        self.motion.sensed = sensed;
        let sensed = &self.motion.sensed;
        self.motion.torques = (0..self.motors.len())
            .map(|joint| {
                let load = match self.config.weight {
                    Weight::Felt => 0.0,
                    Weight::Carried => sensed.loads[joint],
                };
                let (command, is) =
                    (&self.motion.commands[joint], [sensed.positions[joint], sensed.speeds[joint]]);
                self.motors[joint].torque(command, load, is, sensed.inertias[joint], dt)
            })
            .collect();
    }

    fn drive(&mut self, context: &mut BodyContext<'_>, dt: f64) {
        let (physics, root) = (&mut *context.physics, context.rigid);
        let Some(id) = self.id else { return };
        if self.motion.links.is_none() {
            return self.assemble(physics, root);
        }
        let plan = self.plan(id);
        if let Some(links) = &self.motion.links {
            links.mind_stops(physics, &plan, (&self.motion.sensed, &self.motion.torques), dt);
            links.act(physics, root, &self.tree, &self.motion.torques);
        }
    }

    fn observe(&mut self, physics: &PhysicsWorld, rigid: RigidBodyHandle) {
        let Some(links) = &self.motion.links else { return };
        if let Some((positions, speeds)) = links.joints(physics, &self.tree) {
            (self.motion.sensed.positions, self.motion.sensed.speeds) = (positions, speeds);
        }
        self.motion.poses = links.poses(physics, rigid, &self.tree);
    }

    fn settle(&mut self, state: &BodyState) {
        let world_from_root = state.pose * part_from_body(&self.tree, 0).inverse();
        let of_root = root_twist(&self.tree, &state.pose, &state.twist);
        let pose = world_from_root * self.root_from_entity;
        let arm = pose.translation.vector - world_from_root.translation.vector;
        let linear = of_root.linear + of_root.angular.cross(&arm);
        self.state = BodyState { pose, twist: Twist { linear, angular: of_root.angular } };
    }

    fn gather(&mut self, physics: &mut PhysicsWorld, rigid: RigidBodyHandle) {
        let Some(links) = self.motion.links.take() else { return };
        links.remove(physics);
        if let Some(root) = physics.bodies.get_mut(rigid) {
            root.reset_forces(true);
            root.reset_torques(true);
        }
        self.motion.sensed.speeds.fill(0.0);
        self.motion.torques.fill(0.0);
    }

    fn place(&mut self, state: &BodyState) {
        self.state = *state;
    }

    fn report(&mut self, id: EntityId, world: &mut World) -> Result<(), WorldError> {
        let entity_from_world = self.state.pose.inverse();
        if self.motion.links.is_some() {
            self.looks.follow(&entity_from_world, &self.motion.poses);
        } else {
            // Carried, or just put somewhere: as its joints are.
            let entity_from_root = self.root_from_entity.inverse();
            self.looks.follow(&entity_from_root, &self.tree.poses(&self.motion.sensed.positions));
        }
        self.looks.tell(id, world)
    }
}

impl Robot {
    fn plan(&self, id: EntityId) -> Plan<'_> {
        Plan { id, description: &self.config.description, tree: &self.tree, meeting: &self.meeting }
    }

    /// Hangs the other parts on the first one's rigid body, with the robot where its state says.
    fn assemble(&mut self, physics: &mut PhysicsWorld, root: RigidBodyHandle) {
        let Some(id) = self.id else { return };
        let entity_from_root = self.root_from_entity.inverse();
        let world_from_root = self.state.pose * entity_from_root;
        let arm = self.state.pose.rotation * entity_from_root.translation.vector;
        let Twist { linear, angular } = self.state.twist;
        let twist = Twist { linear: linear + angular.cross(&arm), angular };
        let plan = self.plan(id);
        let start = Start { world_from_root, twist, positions: &self.motion.sensed.positions };
        let links = plan.build(physics, root, &start);
        self.motion.poses = links.poses(physics, root, &self.tree);
        self.motion.links = Some(links);
    }
}
