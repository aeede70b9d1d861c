//! Where models come from: the assets of a scene, and links that are drawn as surfaces of their own.

use std::collections::BTreeMap;
use std::sync::{Arc, Weak};

use simworld_core::asset::{Asset, Model};
use simworld_core::geometry::Vector3;
use simworld_core::id::AssetId;
use simworld_core::scene::Scene;

/// Nothing is thinner than this, m: a surface may be flat, and its points are told in shares of its box.
const THINNEST: f64 = 1e-3;

/// Whose model something is drawn as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Source {
    /// An asset's.
    Asset(AssetId),
    /// A link's, by the number that [`LinkModels`] gave it.
    Link(u32),
}

impl Source {
    /// Its place in a table of all of them: assets and links in turn, so that neither moves when there are more of the other.
    pub(crate) fn head(self) -> usize {
        match self {
            Self::Asset(id) => 2 * id.index(),
            Self::Link(number) => 2 * number as usize + 1,
        }
    }
}

/// A model as it is to be drawn.
#[derive(Clone)]
pub(crate) struct Modelled<'a> {
    /// What it is called, for messages.
    pub name: &'a str,
    /// The box that its points are told in shares of, m.
    pub size: Vector3,
    pub model: Arc<Model>,
}

/// The models of links that were drawn so far and still belong to somebody. They have numbers in the order in which they were met,
/// so that what is drawn does not depend on where in memory they are.
#[derive(Default)]
pub(crate) struct LinkModels {
    known: Vec<Known>,
    /// By where it is in memory: whoever is known weakly keeps that place. Only looked up in, never gone through.
    numbers: BTreeMap<usize, u32>,
}

struct Known {
    model: Weak<Model>,
    size: Vector3,
}

impl LinkModels {
    /// Gives a model a number, if it has none yet: one of somebody who is gone, or the next.
    pub(crate) fn learn(&mut self, model: &Arc<Model>) {
        if self.number(model).is_some() {
            return;
        }
        let [low, high] = model.bounds().unwrap_or_default();
        let size = Vector3::from_fn(|axis, _| f64::from(high[axis] - low[axis]).max(THINNEST));
        let known = Known { model: Arc::downgrade(model), size };
        let gone = self.known.iter().position(|known| known.model.strong_count() == 0);
        let number = gone.unwrap_or(self.known.len());
        match self.known.get_mut(number) {
            Some(place) => {
                self.numbers.remove(&place.model.as_ptr().addr());
                *place = known;
            }
            None => self.known.push(known),
        }
        self.numbers.insert(Arc::as_ptr(model).addr(), number as u32);
    }

    /// The number of a model that was [learnt](Self::learn).
    pub(crate) fn number(&self, model: &Arc<Model>) -> Option<u32> {
        self.numbers.get(&Arc::as_ptr(model).addr()).copied()
    }
}

/// What models are looked up in.
#[derive(Clone, Copy)]
pub(crate) struct Sources<'a> {
    pub scene: &'a dyn Scene,
    pub links: &'a LinkModels,
}

impl<'a> Sources<'a> {
    /// The model of a source, if there still is one.
    pub(crate) fn find(&self, source: Source) -> Option<Modelled<'a>> {
        match source {
            Source::Asset(id) => {
                let (asset, model) = model_of(self.scene, id)?;
                let (size, model) = (asset.collider.size(), Arc::clone(model));
                Some(Modelled { name: &asset.name, size, model })
            }
            Source::Link(number) => {
                let Known { model, size } = self.links.known.get(number as usize)?;
                Some(Modelled { name: "a link", size: *size, model: model.upgrade()? })
            }
        }
    }
}

/// The asset of an id, if it has a model.
pub(crate) fn model_of(scene: &dyn Scene, id: AssetId) -> Option<(&Asset, &Arc<Model>)> {
    let asset = scene.assets()?.get(id)?;
    Some((asset, asset.model.as_ref()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_the_living() {
        let models: Vec<Arc<Model>> = (0..3).map(|_| Arc::default()).collect();
        let mut links = LinkModels::default();
        for model in models.iter().chain(&models) {
            links.learn(model);
        }
        let numbers = |links: &LinkModels, models: &[Arc<Model>]| -> Vec<Option<u32>> {
            models.iter().map(|model| links.number(model)).collect()
        };
        assert_eq!(numbers(&links, &models), [Some(0), Some(1), Some(2)]);
        let [first, second, third] = models.try_into().unwrap();
        drop(second);
        let scene = simworld_core::scene::World::new();
        let there = |links: &LinkModels, number| {
            Sources { scene: &scene, links }.find(Source::Link(number)).map(|found| found.model)
        };
        assert!(there(&links, 1).is_none(), "nobody has it any more");
        let fourth = Arc::default();
        links.learn(&fourth);
        assert_eq!(numbers(&links, &[first, third, Arc::clone(&fourth)]), [Some(0), Some(2), Some(1)]);
        assert!(Arc::ptr_eq(&there(&links, 1).unwrap(), &fourth));
    }
}
