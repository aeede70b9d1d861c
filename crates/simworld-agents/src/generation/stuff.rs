//! What made things are made of: names, weights and colours.
//!
//! Densities are those of the Engineering Toolbox, times the share of the volume one sees that is not hollow: a steel post is
//! a pipe, an upholstered seat mostly foam and air, a crown of leaves mostly air.

/// A material by what it weighs and looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stuff {
    Wood,
    Metal,
    Iron,
    Stone,
    Marble,
    Concrete,
    Brick,
    Plastic,
    Glass,
    Fabric,
    Straw,
    Leaves,
    /// Thick green stems.
    Stem,
    Snow,
    Clay,
    Soil,
    Sand,
    Water,
    Rubber,
}

impl Stuff {
    /// Mass over the volume one sees, kg/m³.
    pub(super) const fn density(self) -> f64 {
        match self {
            Self::Wood => 600.0,
            Self::Metal => 1200.0, // steel pipe and sheet: 7850 over a share of 0.15
            Self::Iron => 2400.0,  // castings: 7200 over a third
            Self::Stone => 2500.0,
            Self::Marble => 2700.0,
            Self::Concrete => 2300.0,
            Self::Brick => 1900.0,
            Self::Plastic => 280.0, // mouldings: 950 over 0.3
            Self::Glass => 1250.0,  // panes that are half as thick as they are drawn
            Self::Fabric => 120.0,  // upholstery and canvas
            Self::Straw => 110.0,   // pressed
            Self::Leaves => 8.0,
            Self::Stem => 900.0,
            Self::Snow => 400.0, // pressed
            Self::Clay => 2000.0,
            Self::Soil => 1300.0,
            Self::Sand => 1600.0,
            Self::Water => 1000.0,
            Self::Rubber => 1100.0,
        }
    }

    /// Its usual colour, linear-light sRGB.
    pub(super) const fn color(self) -> [f32; 3] {
        match self {
            Self::Wood => [0.3, 0.17, 0.08],
            Self::Metal => [0.28, 0.29, 0.3],
            Self::Iron => [0.05, 0.052, 0.056],
            Self::Stone => [0.38, 0.36, 0.32],
            Self::Marble => [0.75, 0.73, 0.7],
            Self::Concrete => [0.36, 0.36, 0.35],
            Self::Brick => [0.35, 0.1, 0.06],
            Self::Plastic => [0.5, 0.5, 0.5],
            Self::Glass => [0.25, 0.4, 0.45],
            Self::Fabric => [0.6, 0.56, 0.48],
            Self::Straw => [0.6, 0.45, 0.13],
            Self::Leaves => [0.07, 0.18, 0.05],
            Self::Stem => [0.08, 0.24, 0.09],
            Self::Snow => [0.88, 0.9, 0.93],
            Self::Clay => [0.45, 0.16, 0.07],
            Self::Soil => [0.07, 0.045, 0.03],
            Self::Sand => [0.65, 0.5, 0.28],
            Self::Water => [0.06, 0.2, 0.28],
            Self::Rubber => [0.02, 0.02, 0.021],
        }
    }
}

/// Words, their material, and the colour that they say.
pub(super) type StuffWords = (&'static [&'static str], Stuff, Option<[f32; 3]>);

/// Words for materials, with a colour where the word says more than the material.
#[rustfmt::skip]
pub(super) const STUFFS: &[StuffWords] = &[
    (&["wood", "wooden", "timber", "oak", "pine", "teak", "plank", "planks"], Stuff::Wood, None),
    (&["bamboo"], Stuff::Wood, Some([0.5, 0.4, 0.15])),
    (&["ebony", "walnut"], Stuff::Wood, Some([0.07, 0.035, 0.02])),
    (&["metal", "metallic", "steel", "aluminium", "aluminum", "tin", "chrome"], Stuff::Metal, None),
    (&["bronze", "brass"], Stuff::Metal, Some([0.4, 0.22, 0.06])),
    (&["copper"], Stuff::Metal, Some([0.5, 0.17, 0.08])),
    (&["gold", "golden"], Stuff::Metal, Some([0.75, 0.48, 0.08])),
    (&["rusty", "rusted"], Stuff::Metal, Some([0.25, 0.07, 0.02])),
    (&["iron"], Stuff::Iron, None),
    (&["stone", "granite", "rocky", "cobblestone", "limestone"], Stuff::Stone, None),
    (&["sandstone"], Stuff::Stone, Some([0.6, 0.42, 0.22])),
    (&["slate"], Stuff::Stone, Some([0.11, 0.12, 0.14])),
    (&["marble"], Stuff::Marble, None),
    (&["concrete", "cement"], Stuff::Concrete, None),
    (&["brick", "bricks"], Stuff::Brick, None),
    (&["plastic"], Stuff::Plastic, None),
    (&["glass"], Stuff::Glass, None),
    (&["fabric", "cloth", "canvas", "cotton", "velvet", "upholstered"], Stuff::Fabric, None),
    (&["leather"], Stuff::Fabric, Some([0.16, 0.06, 0.025])),
    (&["straw", "wicker", "rattan"], Stuff::Straw, None),
    (&["clay", "terracotta", "ceramic", "earthenware"], Stuff::Clay, None),
    (&["porcelain"], Stuff::Clay, Some([0.85, 0.85, 0.85])),
    (&["rubber"], Stuff::Rubber, None),
    (&["ice", "icy"], Stuff::Water, Some([0.6, 0.75, 0.85])),
];
