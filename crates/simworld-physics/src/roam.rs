//! Bodies far from what is of interest that move by themselves: out of the engine, once a step, side by side on several threads.
//!
//! They keep off what stands fixed and go past everything that moves. Rays and overlaps meet them by a tree of their own, which
//! is made when somebody asks.

use std::any::Any;
use std::sync::OnceLock;

use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::Ray as RapierRay;
use parry3d_f64::query::details::ShapeCastOptions;
use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::prelude::{Collider, QueryFilter, SharedShape};
use rayon::prelude::*;
use simworld_core::geometry::Vector3;
use simworld_core::id::EntityId;
use simworld_core::seam::{BodyState, Embodiment};

use crate::body::{Detail, Surroundings};
use crate::convert::{from_vector, to_pose};
use crate::dynamics::{Owned, PhysicsDynamics};
use crate::humanoid::{Humanoid, SKIN};
use crate::shape::body_from;

/// Less than this the engine makes up for by itself, m.
const LEAST_LIFT: f64 = 0.03;

/// Who roams, where and in what form; made for the first question after a step.
#[derive(Default)]
pub(crate) struct Roamers {
    tree: OnceLock<(Bvh, Vec<Roamer>)>,
}

/// One of them.
pub(crate) struct Roamer {
    pub(crate) id: EntityId,
    pub(crate) solid: SharedShape,
    pub(crate) pose: RapierPose,
}

impl PhysicsDynamics {
    /// Sends bodies off that can move by themselves where reduced detail will do, and takes them back where it does not.
    pub(crate) fn choose_roamers(&mut self) {
        for turn in 0..self.roster.minds.len() {
            let index = self.roster.minds[turn];
            let owned = &self.bodies[index];
            let roams = owned.detail == Detail::Reduced
                && owned.bonds.carried.is_none()
                && owned.body.can_roam()
                && !self.grasps.list.iter().any(|grasp| grasp.who == owned.id || grasp.thing == owned.id);
            match (owned.is_roaming, roams) {
                (false, true) => {
                    self.set_solid(owned.rigid, false);
                    self.bodies[index].is_roaming = true;
                }
                (true, false) => self.take_back(index),
                _ => {}
            }
        }
    }

    /// Puts a body that roamed into the engine where it has come to.
    pub(crate) fn take_back(&mut self, index: usize) {
        let lift = self.lift_on_treads(&self.bodies[index]);
        let owned = &mut self.bodies[index];
        if lift > 0.0 {
            let BodyState { mut pose, twist } = owned.body.state();
            pose.translation.vector.z += lift;
            owned.body.settle(&BodyState { pose, twist });
        }
        owned.is_roaming = false;
        let (rigid, pose) = (owned.rigid, to_pose(&owned.body.state().pose));
        let body = &mut self.physics.bodies[rigid];
        body.set_position(pose, true);
        body.set_next_kinematic_position(pose);
        self.set_solid(rigid, true);
    }

    /// How much higher somebody on foot stands in the engine, m: with all of its form on the highest tread below it, and not with its middle
    /// on one. Otherwise the engine would push it out of the tread.
    fn lift_on_treads(&self, owned: &Owned) -> f64 {
        let form = || {
            let handle = *self.physics.bodies.get(owned.rigid)?.colliders().first()?;
            self.physics.colliders.get(handle)
        };
        let is_person = (&*owned.body as &dyn Any).is::<Humanoid>();
        let Some(form) = form().filter(|_| is_person) else { return 0.0 };
        let reach = self.config.step_height + SKIN;
        let raised = RapierPose::from_translation(Vector::Z * reach);
        let at = raised * to_pose(&owned.body.state().pose) * body_from(form);
        let options = ShapeCastOptions { max_time_of_impact: reach, ..ShapeCastOptions::default() };
        // The ground itself is stood on by its heights.
        let filter = QueryFilter::only_fixed().exclude_collider(self.ground);
        let queries = self.physics.query_pipeline_with_filter(filter);
        let met = queries.cast_shape(&at, -Vector::Z, form.shape(), options);
        let lift = met.map_or(0.0, |(_, hit)| reach - hit.time_of_impact);
        if (LEAST_LIFT..=self.config.step_height).contains(&lift) { lift } else { 0.0 }
    }

    /// Moves everybody who roams on by a step of `dt` s; each alone, so the order and the thread do not matter.
    pub(crate) fn roam(&mut self, dt: f64) {
        self.roamers = Roamers::default();
        let (physics, nobody, config, conditions) =
            (&self.physics, &self.nobody, &self.config, &self.conditions);
        let (ground, surface, movers) = (self.ground, self.surface.as_deref(), &self.movers);
        let roam = |owned: &mut Owned| {
            let (rigid, detail) = (owned.rigid, owned.detail);
            let (shoves, holds) = (&[], &[]);
            let around = Surroundings {
                physics,
                nobody,
                rigid,
                config,
                conditions,
                detail,
                ground,
                surface,
                movers,
                shoves,
                holds,
            };
            owned.body.roam(&around, dt);
        };
        let count = self.minds().filter(|owned| owned.is_roaming).count();
        if count >= config.parallel_threshold {
            self.bodies.par_iter_mut().with_min_len(64).filter(|owned| owned.is_roaming).for_each(roam);
        } else {
            for place in &self.roster.minds {
                let owned = &mut self.bodies[*place];
                if owned.is_roaming {
                    roam(owned);
                }
            }
        }
    }

    /// Who roams, by where they are.
    fn roamers(&self) -> &(Bvh, Vec<Roamer>) {
        self.roamers.tree.get_or_init(|| {
            let place = |owned: &Owned| {
                let handle = *self.physics.bodies[owned.rigid].colliders().first()?;
                let collider = self.physics.colliders.get(handle)?;
                let pose = to_pose(&owned.body.state().pose) * body_from(collider);
                Some(Roamer { id: owned.id, solid: collider.shared_shape().clone(), pose })
            };
            let roaming = self.bodies.iter().filter(|owned| owned.is_roaming);
            let all: Vec<Roamer> = roaming.filter_map(place).collect();
            let boxes: Vec<_> = all.iter().map(|roamer| roamer.solid.compute_aabb(&roamer.pose)).collect();
            (Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes), all)
        })
    }

    /// Who roams in or near a box.
    pub(crate) fn roamers_in<'a>(
        &'a self,
        bounds: &'a parry3d_f64::bounding_volume::Aabb,
    ) -> impl Iterator<Item = &'a Roamer> {
        let (tree, all) = self.roamers();
        tree.intersect_aabb(bounds).filter_map(|leaf| all.get(leaf as usize))
    }

    /// The first who roams on a ray: who, how far away, and the face that was met.
    pub(crate) fn cast_at_roamers(
        &self,
        ray: &RapierRay,
        max_distance: f64,
        filter: &dyn Fn(EntityId) -> bool,
    ) -> Option<(EntityId, f64, Vector3)> {
        let (tree, all) = self.roamers();
        let mut best: Option<(EntityId, f64, Vector3)> = None;
        // What is equally far is told apart by its id, whatever the tree looks at first.
        let mut on_ray: Vec<&Roamer> = tree
            .leaves(|node| node.cast_ray(ray, max_distance) < f64::MAX)
            .filter_map(|leaf| all.get(leaf as usize))
            .collect();
        on_ray.sort_unstable_by_key(|roamer| roamer.id);
        for Roamer { id, solid, pose } in on_ray {
            let reach = best.map_or(max_distance, |(_, distance, _)| distance);
            if let Some(hit) = solid.cast_ray_and_get_normal(pose, ray, reach, true)
                && best.is_none_or(|(_, distance, _)| hit.time_of_impact < distance)
                && filter(*id)
            {
                best = Some((*id, hit.time_of_impact, from_vector(hit.normal)));
            }
        }
        best
    }

    /// The momentum of somebody who roams, kg m/s.
    pub(crate) fn momentum_of_roamer(&self, owned: &Owned) -> Vector3 {
        let Some(rigid) = self.physics.bodies.get(owned.rigid) else { return Vector3::zeros() };
        // Out of the engine a body has only the mass that its colliders do not have.
        let colliders = rigid.colliders().iter().filter_map(|handle| self.physics.colliders.get(*handle));
        let mass = colliders.map(Collider::mass).sum::<f64>().max(rigid.mass());
        owned.body.state().twist.linear * mass
    }
}
