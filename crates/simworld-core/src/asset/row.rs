//! Assets as rows of a table.

use super::{Affordance, AffordanceSet, Asset, Material, Seasons};
use crate::geometry::Vector3;
use crate::scene::{EntityKind, Place, Shape};

/// Who made the assets of the tables, and how.
const SOURCE: &str = "simworld, procedural";
/// The licence of the tables: that of the project.
const LICENCE: &str = "MIT OR Apache-2.0";

/// A row of a table of assets.
#[derive(Clone, Copy)]
pub(super) struct Row {
    pub(super) name: &'static str,
    kind: EntityKind,
    shape: Shape,
    mass: Option<f64>,
    material: Material,
    color: [f32; 3],
    tags: &'static [&'static str],
    place: Option<Place>,
    can: Option<AffordanceSet>,
    seasons: Option<Seasons>,
    source: &'static str,
}

/// A thing that can be moved, kg.
pub(super) const fn row(
    name: &'static str,
    kind: EntityKind,
    shape: Shape,
    mass: f64,
    material: Material,
    color: [f32; 3],
    tags: &'static [&'static str],
) -> Row {
    Row { mass: Some(mass), can: None, ..fixed(name, kind, shape, material, color, tags) }
}

/// A thing that is fixed to the ground.
pub(super) const fn fixed(
    name: &'static str,
    kind: EntityKind,
    shape: Shape,
    material: Material,
    color: [f32; 3],
    tags: &'static [&'static str],
) -> Row {
    let (mass, place, seasons, source) = (None, None, None, SOURCE);
    // Nobody carries away what is fixed.
    let can = if matches!(kind, EntityKind::Prop) { Some(AffordanceSet::NONE) } else { None };
    Row { name, kind, shape, mass, material, color, tags, place, can, seasons, source }
}

impl Row {
    /// With what one can do with it, in place of what its kind says.
    pub(super) const fn can(mut self, affordances: &[Affordance]) -> Self {
        self.can = Some(AffordanceSet::of(affordances));
        self
    }

    /// With what it is used for.
    pub(super) const fn used_as(mut self, place: Place) -> Self {
        self.place = Some(place);
        self
    }

    /// With its colours in spring, summer, autumn and winter.
    pub(super) const fn through(mut self, [spring, summer, autumn, winter]: [[f32; 3]; 4]) -> Self {
        self.seasons = Some(Seasons { spring, summer, autumn, winter });
        self
    }

    /// With another source.
    pub(super) const fn from(mut self, source: &'static str) -> Self {
        self.source = source;
        self
    }

    /// The asset of the row.
    pub(super) fn asset(&self) -> Asset {
        Asset {
            place: self.place,
            mass: self.mass,
            material: Some(self.material),
            color: Some(self.color),
            seasons: self.seasons,
            affordances: self.can,
            source: self.source.to_owned(),
            licence: LICENCE.to_owned(),
            ..Asset::new(self.name, self.kind, self.shape).tagged(self.tags.iter().copied())
        }
    }
}

/// A box: length, width and height, m.
pub(super) const fn boxed(length: f64, width: f64, height: f64) -> Shape {
    Shape::Box { size: Vector3::new(length, width, height) }
}

/// An upright cylinder: radius and height, m.
pub(super) const fn round(radius: f64, height: f64) -> Shape {
    Shape::Cylinder { radius, height }
}
