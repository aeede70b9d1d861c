//! Links: rigid things of an entity that move for themselves, each drawn as its solid or as a surface of its own.

use simworld_core::id::EntityId;
use simworld_core::links::Links;
use simworld_core::scene::{EntityRef, Scene};

use super::{Detail, Look, Looks, as_model, primitive};
use crate::mesh::{Drawn, MeshId, ModelId};
use crate::resident;
use crate::sources::{LinkModels, Source};

/// Shells and joints of robots, in turn, where nobody said a colour.
const SHELLS: [[f32; 3]; 2] = [[0.72, 0.73, 0.75], [0.2, 0.21, 0.23]];

impl Looks {
    /// Learns the models of links of entities that are about to be dressed.
    pub(crate) fn learn(&mut self, scene: &dyn Scene, who: impl Iterator<Item = EntityId>) {
        let models = who.filter_map(|id| scene.links(id)).flat_map(|links| links.iter());
        models.filter_map(|(form, _)| form.model.as_ref()).for_each(|model| self.links.learn(model));
    }

    /// The models of links that are known.
    pub(crate) const fn links(&self) -> &LinkModels {
        &self.links
    }

    /// What has links is drawn as these: each its solid, or the surface in place of that, where it is.
    pub(super) fn articulated(
        &self,
        entity: &EntityRef<'_>,
        links: &Links<'_>,
        out: &mut Vec<resident::Part>,
    ) {
        let plain = self.plain(entity);
        for (index, (form, entity_from_link)) in links.iter().enumerate() {
            let (mesh, size) = (primitive(&form.shape), form.shape.size());
            let scale = [size.x as f32, size.y as f32, size.z as f32];
            let unit = if mesh == MeshId::Cuboid { 1.0 } else { scale[0] * 0.5 };
            let color = form.color.or(entity.info.color).unwrap_or(SHELLS[index % 2]);
            let look = Look { mesh, scale, unit, color, ..plain };
            let pose = entity.pose * entity_from_link;
            let source = form.model.as_ref().and_then(|model| self.links.number(model)).map(Source::Link);
            let (mesh, look) = match source {
                Some(source) => (Drawn::Model(ModelId { source, pose: None }), as_model(source, look)),
                None => (Drawn::Own(mesh), look),
            };
            out.push(resident::Part { mesh, pose, look, details: Detail::EVERY });
        }
    }
}
