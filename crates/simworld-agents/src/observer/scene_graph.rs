//! The scene as an agent may know it: things around with kind, label, bearing and distance, and who holds what.

use std::fmt::Write as _;
use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Aabb, heading, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{EntityKind, EntityRef, Role, Scene};
use simworld_core::seam::{ObserveError, Observer};

/// One thing in sight.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sighting {
    /// Which.
    pub id: EntityId,
    /// What it is.
    pub kind: EntityKind,
    /// What people call it.
    pub label: String,
    /// Distance in the plane to its footprint, m.
    pub distance: f64,
    /// Direction of its middle, radians to the left of where one looks.
    pub bearing: f64,
    /// Speed over ground, m/s.
    pub speed: f64,
    /// What it hangs on, and how.
    pub bond: Option<(EntityId, Role)>,
}

/// What is around, nearest first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SceneGraph {
    /// The things in sight; of two at the same distance the lower id comes first.
    pub sightings: Vec<Sighting>,
}

impl SceneGraph {
    /// The graph as lines for a prompt, nearest first, at most `budget` characters; what is left out is counted.
    pub fn to_text(&self, budget: usize) -> String {
        let mut text = String::new();
        for (index, sighting) in self.sightings.iter().enumerate() {
            let line = sighting.to_string();
            let more = format!("... and {} more\n", self.sightings.len() - index);
            if text.chars().count() + line.chars().count() + 1 + more.len() > budget {
                // Even the count is left out if there is no room for it.
                if text.chars().count() + more.len() <= budget {
                    text.push_str(&more);
                }
                break;
            }
            text.push_str(&line);
            text.push('\n');
        }
        text
    }
}

impl std::fmt::Display for Sighting {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let degrees = self.bearing.to_degrees();
        let side = if degrees >= 0.0 { "left" } else { "right" };
        let mut notes = String::new();
        if self.speed > 0.1 {
            write!(notes, ", moving at {:.1} m/s", self.speed)?;
        }
        if let Some((carrier, role)) = self.bond {
            write!(notes, ", {} by {carrier}", format!("{role:?}").to_lowercase())?;
        }
        let (id, kind, label) = (self.id, self.kind, &self.label);
        let name = if label == kind.as_str() { String::new() } else { format!(" \"{label}\"") };
        write!(f, "{id} {kind}{name}: {:.1} m, {:.0}° to the {side}{notes}", self.distance, degrees.abs())
    }
}

/// Sees what is within a radius and a field of view; flat surfaces are left out.
#[derive(Clone, Copy, Debug)]
pub struct SceneGraphObserver {
    radius: f64,
    field_of_view: f64,
    most: usize,
}

impl SceneGraphObserver {
    /// Sees all round, within `radius` m, the 64 nearest things.
    pub fn new(radius: f64) -> Self {
        Self { radius, field_of_view: std::f64::consts::TAU, most: 64 }
    }

    /// With a field of view, radians across.
    #[must_use]
    pub fn with_field_of_view(mut self, radians: f64) -> Self {
        self.field_of_view = radians;
        self
    }

    /// With at most that many things, the nearest.
    #[must_use]
    pub fn with_most(mut self, most: usize) -> Self {
        self.most = most;
        self
    }
}

impl Observer for SceneGraphObserver {
    type Observation = SceneGraph;

    fn observe(
        &mut self,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut SceneGraph,
    ) -> Result<(), ObserveError> {
        let me = scene.entity(who).ok_or(ObserveError::Missing { id: who })?;
        out.sightings.clear();
        let here = me.planar();
        let _ = scene.visit(&Aabb::column_around(here, self.radius), &mut |entity| {
            let distance = entity.info.shape.planar_distance(entity.pose, &here);
            if entity.id != who && is_thing(entity.kind) && distance <= self.radius {
                let bearing = bearing(&me, &entity);
                if bearing.abs() <= self.field_of_view * 0.5 {
                    out.sightings.push(sighting(&entity, distance, bearing));
                }
            }
            ControlFlow::Continue(())
        });
        out.sightings.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(a.id.cmp(&b.id)));
        out.sightings.truncate(self.most);
        Ok(())
    }
}

/// Surfaces are where things stand, not things.
const fn is_thing(kind: EntityKind) -> bool {
    !matches!(kind, EntityKind::Ground | EntityKind::Road | EntityKind::Sidewalk | EntityKind::Crosswalk)
}

fn bearing(me: &EntityRef<'_>, other: &EntityRef<'_>) -> f64 {
    let offset = other.bounds.center().xy() - me.planar();
    if offset.norm() < 1e-9 { 0.0 } else { wrap_angle(heading(&offset) - yaw_of(me.pose)) }
}

fn sighting(entity: &EntityRef<'_>, distance: f64, bearing: f64) -> Sighting {
    Sighting {
        id: entity.id,
        kind: entity.kind,
        label: entity.label().to_owned(),
        distance,
        bearing,
        speed: entity.twist.ground_speed(),
        bond: entity.attachment.map(|bond| (bond.parent, bond.role)),
    }
}
