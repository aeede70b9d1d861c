//! What things are made of: how they slide, bounce, weigh and reflect light.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Declares the materials with their figures, from one table.
macro_rules! materials {
    ($($(#[$doc:meta])* $variant:ident = $text:literal, $figures:expr;)+) => {
        /// What something is made of.
        ///
        /// An entity names its own with the attribute `material` ([`Material::from_name`] lists the names); without one it
        /// is made of what its asset is made of.
        ///
        /// | figure | source |
        /// |---|---|
        /// | friction | tables of the Engineering Toolbox and the Bosch Automotive Handbook, rounded |
        /// | restitution | crates, masonry and car bodies crush rather than bounce; rubber, glass and hard plastic as dropped balls |
        /// | density | Engineering Toolbox: solids, and what lies loose (gravel, sand, soil) as it lies |
        /// | reflectance | albedo of surfaces by Oke, Boundary Layer Climates, 1987, table 1.1; of glass by Fresnel at 4 % a face |
        /// | roughness | as renderers set it; not measured |
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
        #[serde(rename_all = "snake_case")]
        #[repr(u8)]
        #[non_exhaustive]
        pub enum Material {
            $($(#[$doc])* $variant,)+
        }

        impl Material {
            /// Every material, in the order of declaration.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)+];

            /// The name in files.
            pub const fn as_str(self) -> &'static str {
                match self {
                    $(Self::$variant => $text,)+
                }
            }

            const fn figures(self) -> &'static [f64; 5] {
                match self {
                    $(Self::$variant => &$figures,)+
                }
            }
        }
    };
}

// Friction, restitution, density in kg/m³, reflectance, roughness.
materials! {
    /// Clean asphalt, and whatever has no better name.
    #[default]
    Asphalt = "asphalt", [0.7, 0.0, 2360.0, 0.1, 0.9];
    /// Concrete and other masonry.
    Concrete = "concrete", [0.65, 0.0, 2400.0, 0.3, 0.9];
    /// Cobblestones, worn smooth.
    Cobblestone = "cobblestone", [0.6, 0.0, 2700.0, 0.25, 0.8];
    /// Loose gravel.
    Gravel = "gravel", [0.5, 0.0, 1680.0, 0.3, 0.95];
    /// Grass.
    Grass = "grass", [0.5, 0.0, 1300.0, 0.2, 0.9];
    /// Bare metal: rails, manhole covers, car bodies.
    Metal = "metal", [0.3, 0.1, 7850.0, 0.55, 0.35];
    /// Wood: decking, crates.
    Wood = "wood", [0.4, 0.0, 500.0, 0.35, 0.6];
    /// Rubber: soles, mats.
    Rubber = "rubber", [0.9, 0.7, 1200.0, 0.05, 0.9];
    /// Ice, in any weather.
    Ice = "ice", [0.05, 0.1, 917.0, 0.35, 0.1];
    /// Glass.
    Glass = "glass", [0.4, 0.3, 2500.0, 0.08, 0.05];
    /// Hard plastic: bins, cones, barriers.
    Plastic = "plastic", [0.3, 0.3, 950.0, 0.4, 0.4];
    /// Rock and cut stone.
    Stone = "stone", [0.6, 0.0, 2700.0, 0.25, 0.8];
    /// Brick.
    Brick = "brick", [0.6, 0.0, 1900.0, 0.3, 0.9];
    /// Cloth and upholstery.
    Fabric = "fabric", [0.5, 0.0, 400.0, 0.35, 0.95];
    /// Leaves and twigs.
    Foliage = "foliage", [0.4, 0.0, 700.0, 0.18, 0.7];
    /// Packed soil.
    Soil = "soil", [0.55, 0.0, 1500.0, 0.15, 0.95];
    /// Dry sand.
    Sand = "sand", [0.5, 0.0, 1600.0, 0.35, 0.95];
    /// Paper and cardboard.
    Paper = "paper", [0.3, 0.0, 800.0, 0.7, 0.9];
    /// Water: what lies in it hardly rubs.
    Water = "water", [0.02, 0.0, 1000.0, 0.06, 0.03];
    /// Skin, fur and flesh: people and animals.
    Flesh = "flesh", [0.5, 0.0, 985.0, 0.35, 0.5];
}

impl Material {
    /// The material of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|material| material.as_str() == name)
    }

    /// Coefficient of sliding friction between two pieces, dry; that of unlike ones is the geometric mean of both.
    pub const fn friction(self) -> f64 {
        self.figures()[0]
    }

    /// Coefficient of restitution between two pieces, in [0, 1]; that of unlike ones is the mean of both.
    pub const fn restitution(self) -> f64 {
        self.figures()[1]
    }

    /// Mass of a full piece, kg/m³; what is hollow weighs less.
    pub const fn density(self) -> f64 {
        self.figures()[2]
    }

    /// Share of the light that comes back from an unpainted surface, in [0, 1].
    pub const fn reflectance(self) -> f64 {
        self.figures()[3]
    }

    /// How far it is from a mirror, from 0 to 1: the perceptual roughness of microfacet models.
    pub const fn roughness(self) -> f64 {
        self.figures()[4]
    }
}

impl fmt::Display for Material {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_material_has_sound_figures_and_its_name() {
        for material in Material::ALL.iter().copied() {
            assert_eq!(serde_json::to_string(&material).unwrap(), format!("\"{material}\""));
            assert_eq!(Material::from_name(material.as_str()), Some(material));
            assert!((0.01..=1.0).contains(&material.friction()), "{material}");
            assert!((100.0..=8000.0).contains(&material.density()), "{material}");
            for share in [material.restitution(), material.reflectance(), material.roughness()] {
                assert!((0.0..=1.0).contains(&share), "{material}");
            }
        }
        assert_eq!(Material::from_name("unobtainium"), None);
    }

    #[test]
    fn materials_stand_in_their_known_order() {
        use Material::{Brick, Concrete, Glass, Ice, Metal, Rubber, Water, Wood};
        assert!(Rubber.friction() > Concrete.friction() && Concrete.friction() > Metal.friction());
        assert!(Metal.friction() > Ice.friction());
        assert!(Metal.density() > Glass.density() && Glass.density() > Brick.density());
        assert!(Water.density() > Ice.density() && Ice.density() > Wood.density(), "ice and wood float");
        assert!(Metal.reflectance() > Rubber.reflectance() && Concrete.roughness() > Glass.roughness());
    }
}
