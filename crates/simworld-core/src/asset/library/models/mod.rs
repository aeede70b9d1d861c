//! Models of assets whose kind says little of what they look like: a stall, a slide, a lighthouse. Each is put together from convex
//! solids in the box of its asset, so that what is seen is what is met.
//!
//! Body frame in metres; what faces somebody faces +x. Shapes are those of plain examples of their kind, in the sizes of the tables.

mod carts;
mod luggage;
mod monuments;
mod park;
mod play;
mod shelters;
mod site;
mod towers;

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::{Arc, LazyLock};

use super::super::sculpt::{Coating, Sculpt};
use super::super::{Asset, Finish, Material, Model, Paint};

/// Makes a thing that fills its box; where it does not, it is stretched to it.
type Maker = fn(&mut Sculpt, &Kit);

/// The makers by the names of their assets.
const TABLES: &[&[(&str, Maker)]] = &[
    carts::MAKERS,
    luggage::MAKERS,
    monuments::MAKERS,
    park::MAKERS,
    play::MAKERS,
    shelters::MAKERS,
    site::MAKERS,
    towers::MAKERS,
];

/// To the right and to the left, or to the back and to the front.
const SIDES: [f64; 2] = [-1.0, 1.0];
/// Axes of what stands upright turned to lie along x and along y.
const ALONG_X: [f64; 3] = [0.0, FRAC_PI_2, 0.0];
const ALONG_Y: [f64; 3] = [FRAC_PI_2, 0.0, 0.0];
/// What lies in the plane of y and z turned into that of x and z.
const SIDEWAYS: [f64; 3] = [0.0, 0.0, FRAC_PI_2];

/// By the name of its asset; made once, and shared by every catalogue.
static MODELS: LazyLock<BTreeMap<&'static str, Arc<Model>>> = LazyLock::new(|| {
    let made = super::rows().filter_map(|row| {
        let (_, make) = TABLES.iter().copied().flatten().find(|(name, _)| *name == row.name)?;
        Some((row.name, Arc::new(model_of(&row.asset(), *make))))
    });
    made.collect()
});

/// An asset with its model, if it has one here.
pub(super) fn modelled(mut asset: Asset) -> Asset {
    asset.model = MODELS.get(asset.name.as_str()).cloned();
    asset
}

fn model_of(asset: &Asset, make: Maker) -> Model {
    let kit = Kit {
        size: asset.collider.size().into(),
        material: asset.material.unwrap_or_default(),
        color: asset.color.unwrap_or([0.5; 3]),
    };
    let mut sculpt = Sculpt::new(kit.main());
    make(&mut sculpt, &kit);
    sculpt.cast(kit.size.map(Some)).model
}

/// What an asset says of how its model is made.
struct Kit {
    /// Length, width and height, m.
    size: [f64; 3],
    material: Material,
    color: [f32; 3],
}

impl Kit {
    /// The main surface, in the colour of the entity.
    fn main(&self) -> Coating {
        self.shade(1.0)
    }

    /// The same, darker by a factor.
    fn shade(&self, factor: f32) -> Coating {
        let light = Finish::of(self.material, self.color);
        Coating { color: [factor; 3], paint: Paint::Entity, light, density: self.material.density() }
    }
}

fn steel() -> Coating {
    Coating::of(Material::Metal, [0.55, 0.56, 0.58])
}

fn iron() -> Coating {
    Coating::of(Material::Metal, [0.05, 0.052, 0.056])
}

fn wood() -> Coating {
    Coating::of(Material::Wood, [0.3, 0.17, 0.08])
}

fn rubber() -> Coating {
    Coating::of(Material::Rubber, [0.02, 0.02, 0.021])
}

fn leaf() -> Coating {
    Coating::of(Material::Foliage, [0.07, 0.18, 0.05])
}

fn glass() -> Coating {
    Coating::of(Material::Glass, [0.12, 0.17, 0.19])
}

fn plastic(color: [f32; 3]) -> Coating {
    Coating::of(Material::Plastic, color)
}

/// Openings, seams and shadows.
fn dark() -> Coating {
    plastic([0.014, 0.014, 0.016])
}

fn white() -> Coating {
    plastic([0.8, 0.8, 0.79])
}

fn red() -> Coating {
    plastic([0.5, 0.04, 0.03])
}

/// Cosine and sine of so many directions around, the first to the front.
fn around(count: u32) -> impl Iterator<Item = [f64; 2]> {
    (0..count).map(move |k| {
        let (sin, cos) = crate::ops::sin_cos(TAU * f64::from(k) / f64::from(count));
        [cos, sin]
    })
}

/// So many places evenly from end to end of a span around 0.
fn spread(count: u32, span: f64) -> impl Iterator<Item = f64> {
    let gap = span / f64::from(count.saturating_sub(1).max(1));
    (0..count).map(move |k| gap * f64::from(k) - span * 0.5)
}

/// A wheel that stands on its rim and rolls along x.
fn wheel(s: &mut Sculpt, [x, y]: [f64; 2], radius: f64, width: f64) {
    s.placed([x, y, radius], ALONG_Y, |s| {
        s.part("tyre", rubber());
        s.pillar([0.0, 0.0, -width * 0.5], radius, width, 14);
        s.part("hub", steel());
        s.pillar([0.0, 0.0, -width * 0.55], radius * 0.45, width * 1.1, 8);
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::Catalogue;

    fn models() -> impl Iterator<Item = (Asset, Arc<Model>)> {
        let library = Catalogue::library();
        let names: Vec<&str> = TABLES.iter().copied().flatten().map(|(name, _)| *name).collect();
        names.into_iter().map(move |name| {
            let asset = library.get(library.find(name).unwrap_or_else(|| panic!("{name} is no asset")));
            let asset = asset.unwrap().clone();
            let model = asset.model.clone().unwrap_or_else(|| panic!("{name} has no model"));
            (asset, model)
        })
    }

    #[test]
    fn every_maker_makes_one_asset() {
        let mut names: Vec<String> = models().map(|(asset, _)| asset.name).collect();
        assert!(names.len() >= 55, "{}", names.len());
        names.sort_unstable();
        let count = names.len();
        names.dedup();
        assert_eq!(names.len(), count, "two makers make the same");
        let modelled = Catalogue::library().iter().filter(|(_, asset)| asset.model.is_some()).count();
        assert_eq!(modelled, count);
    }

    #[test]
    fn catalogues_share_their_models() {
        let [one, other] = [Catalogue::library(), Catalogue::library()]
            .map(|library| library.get(library.find("slide").unwrap()).unwrap().model.clone().unwrap());
        assert!(Arc::ptr_eq(&one, &other));
    }

    /// What is seen fills the box, and so does what is met.
    #[test]
    fn models_fill_the_boxes_of_their_assets() {
        for (asset, model) in models() {
            assert_eq!(model.validate(asset.collider.size()), Ok(()), "{}", asset.name);
            let [low, high] = model.bounds().unwrap();
            let points = || model.hulls.iter().flat_map(|hull| &hull.points);
            for axis in 0..3 {
                let least = points().map(|point| point[axis]).fold(f32::MAX, f32::min);
                let most = points().map(|point| point[axis]).fold(f32::MIN, f32::max);
                let apart = (least - low[axis]).abs().max((most - high[axis]).abs());
                assert!(apart < 1e-3, "{}: hulls end {apart} m elsewhere along axis {axis}", asset.name);
            }
        }
    }

    /// Each side of a triangle is that of another the other way round: nothing is open, and nothing looks inwards on one side alone.
    #[test]
    fn surfaces_are_closed() {
        type Side = [[u32; 3]; 2];
        for (asset, model) in models() {
            let mut sides: BTreeMap<Side, i32> = BTreeMap::new();
            let at = |vertex: u32| model.vertices[vertex as usize].position.map(f32::to_bits);
            for [a, b, c] in &model.triangles {
                for (from, to) in [(a, b), (b, c), (c, a)] {
                    let (from, to) = (at(*from), at(*to));
                    *sides.entry([from.min(to), from.max(to)]).or_insert(0) += if from < to { 1 } else { -1 };
                }
            }
            let open = sides.values().filter(|count| **count != 0).count();
            assert_eq!(open, 0, "{} has {open} open edges of {}", asset.name, sides.len());
        }
    }

    #[test]
    fn triangles_look_where_their_normals_do() {
        for (asset, model) in models() {
            for triangle in &model.triangles {
                let [a, b, c] = triangle.map(|vertex| model.vertices[vertex as usize]);
                let of = |p: [f32; 3]| crate::geometry::Vector3::from(p.map(f64::from));
                let face = (of(b.position) - of(a.position)).cross(&(of(c.position) - of(a.position)));
                let facing = face.dot(&of(a.normal)) / face.norm().max(1e-12);
                assert!(facing > -0.2, "{}: a face looks inwards, {facing}", asset.name);
            }
        }
    }

    /// Something of each takes the colour of its entity, or it could not be painted.
    #[test]
    fn models_can_be_painted_and_are_not_dear() {
        for (asset, model) in models() {
            let painted = model.parts.iter().any(|part| part.paint == Paint::Entity);
            assert!(painted, "{} keeps its colours", asset.name);
            assert!(model.triangles.len() < 4000, "{}: {} triangles", asset.name, model.triangles.len());
            assert!(model.hulls.len() <= 120, "{}: {} hulls", asset.name, model.hulls.len());
        }
    }
}
