//! What the things of a row stand on: beside a thing on a roof they stand on the roof, each with its whole footprint, or nowhere.

use simworld_core::geometry::Point3;
use simworld_core::id::EntityId;
use simworld_core::scene::{Relation, Scene};

use super::edit::{Line, Stand};
use super::place::Placer;
use super::placing::Outcome;
use super::rest::{carries, foot_of, support_of};
use super::sample::Spot;
use super::solid::Solid;
use super::stand::Subject;

/// The floors of a row.
pub(super) struct Floors {
    /// Things on which that stands along which the row leads.
    raised: Vec<EntityId>,
    /// Whether the row may stand on the ground: what it leads along does, or it leads along a street.
    has_ground: bool,
    /// The height of that ground where the scene has no land, m; that of the spot, if nothing says it.
    ground: Option<f64>,
}

impl Floors {
    pub(super) fn of(scene: &dyn Scene, line: &Line) -> Self {
        let anchors: Vec<EntityId> = line.anchors().collect();
        let mut floors = Self { raised: Vec::new(), has_ground: anchors.is_empty(), ground: None };
        for anchor in anchors {
            if let Some(floor) = support_of(scene, anchor) {
                floors.raised.push(floor);
            } else {
                // What somebody holds is above the ground on which its bearer stands.
                let foot = scene.entity(foot_of(scene, anchor));
                floors.has_ground = true;
                floors.ground = floors.ground.or_else(|| foot.map(|foot| foot.position().z));
            }
        }
        floors
    }

    /// The thing at a spot as it would stand there, and what becomes of it.
    pub(super) fn judge(
        &self,
        placer: &Placer<'_>,
        subject: Subject<'_>,
        stands: &[Stand],
        spot: &Spot,
    ) -> (Solid, Outcome) {
        let shape = subject.info.shape;
        let at = |height: f64| Solid::standing(shape, Point3::new(spot.at.x, spot.at.y, height), spot.yaw);
        for floor in self.raised.iter().filter_map(|floor| placer.scene.entity(*floor)) {
            let solid = at(Solid::of(&floor).top());
            if carries(&floor, &solid) {
                let mut on_it = stands.to_vec();
                on_it.push(Stand::To { relation: Relation::OnTopOf, anchor: floor.id });
                return (solid, placer.judge(subject, &on_it, spot, &solid));
            }
            if solid.is_over(&Solid::of(&floor)) {
                return (solid, Outcome::Unsupported);
            }
        }
        if !self.has_ground {
            return (at(spot.base), Outcome::Unsupported);
        }
        let spot = Spot { base: self.ground.unwrap_or(spot.base), ..*spot };
        let solid = placer.set_down(subject, stands, &spot);
        (solid, placer.judge(subject, stands, &spot, &solid))
    }
}
