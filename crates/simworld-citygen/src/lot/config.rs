//! How blocks are divided into lots.

use serde::{Deserialize, Serialize};

use crate::CityError;
use crate::zoning::Zone;

/// The pattern in which a block is divided.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LotStyle {
    /// By zone: offset where people live and trade, recursive where they work or learn.
    #[default]
    ByZone,
    /// Rows of lots of one depth along the streets round a common courtyard.
    Offset,
    /// Lots from the street to the middle of the block, back to back, without a courtyard.
    Skeleton,
    /// The block halved across its longer side again and again, as long as both halves have a street.
    Recursive,
}

/// The lots of one zone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LotSize {
    /// Least width along the street, m, in [5, 200].
    pub least_width: f64,
    /// Greatest width, m, at least twice the least, so that every length can be divided; at most 500.
    pub most_width: f64,
    /// Depth away from the street, m, in [8, 300].
    pub depth: f64,
    /// Least area, m², in [20, 100 000]; smaller pieces stay green.
    pub least_area: f64,
    /// Greatest area, m², in [50, 1 000 000], above the least; of larger pieces the rear stays green.
    pub most_area: f64,
}

impl LotSize {
    const fn new(width: (f64, f64), depth: f64, area: (f64, f64)) -> Self {
        Self { least_width: width.0, most_width: width.1, depth, least_area: area.0, most_area: area.1 }
    }
}

impl Default for LotSize {
    /// That of dwellings.
    fn default() -> Self {
        Self::new((10.0, 26.0), 27.0, (90.0, 1100.0))
    }
}

/// How blocks are divided into lots.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LotConfig {
    /// The pattern.
    pub style: LotStyle,
    /// Lots for dwellings.
    pub residential: LotSize,
    /// Lots for shops and offices.
    pub commercial: LotSize,
    /// Lots for factories.
    pub industrial: LotSize,
    /// Lots for schools, hospitals and museums.
    pub civic: LotSize,
}

impl Default for LotConfig {
    fn default() -> Self {
        Self {
            style: LotStyle::ByZone,
            residential: LotSize::default(),
            commercial: LotSize::new((12.0, 34.0), 30.0, (110.0, 1800.0)),
            industrial: LotSize::new((26.0, 60.0), 42.0, (400.0, 4200.0)),
            civic: LotSize::new((24.0, 54.0), 38.0, (350.0, 3600.0)),
        }
    }
}

impl LotConfig {
    /// The lots of a zone; a park has none, and is given those of dwellings.
    pub const fn size(&self, zone: Zone) -> &LotSize {
        match zone {
            Zone::Residential | Zone::Park => &self.residential,
            Zone::Commercial => &self.commercial,
            Zone::Industrial => &self.industrial,
            Zone::Civic => &self.civic,
        }
    }

    /// The pattern of a zone.
    pub const fn style(&self, zone: Zone) -> LotStyle {
        match (self.style, zone) {
            (LotStyle::ByZone, Zone::Industrial | Zone::Civic) => LotStyle::Recursive,
            (LotStyle::ByZone, _) => LotStyle::Offset,
            (style, _) => style,
        }
    }

    pub(crate) fn validate(&self) -> Result<(), CityError> {
        macro_rules! check_size {
            ($zone:ident) => {{
                let size = &self.$zone;
                crate::range::check(&[
                    (
                        concat!("lots.", stringify!($zone), ".least_width"),
                        size.least_width,
                        5.0,
                        200.0,
                        "5 to 200 m",
                    ),
                    (
                        concat!("lots.", stringify!($zone), ".most_width"),
                        size.most_width,
                        2.0 * size.least_width,
                        500.0,
                        "twice the least width to 500 m",
                    ),
                    (concat!("lots.", stringify!($zone), ".depth"), size.depth, 8.0, 300.0, "8 to 300 m"),
                    (
                        concat!("lots.", stringify!($zone), ".least_area"),
                        size.least_area,
                        20.0,
                        1e5,
                        "20 to 100 000 m²",
                    ),
                    (
                        concat!("lots.", stringify!($zone), ".most_area"),
                        size.most_area,
                        size.least_area.max(50.0),
                        1e6,
                        "50 to 1 000 000 m², at least the least area",
                    ),
                ])
            }};
        }
        check_size!(residential)?;
        check_size!(commercial)?;
        check_size!(industrial)?;
        check_size!(civic)
    }
}
