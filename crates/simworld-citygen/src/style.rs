//! Styles of cities: road settings, each held to a band of street statistics measured in real places.
//!
//! Bands after Boeing (JAPA 2021, 72,663 US census tracts) and extracts of `OpenStreetMap`: Campo Grande and Frederiksted
//! (grids), Helsinki (mixed), Monaco (organic), villages of Upper Franconia (suburb).

use std::ops::RangeInclusive;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::{RoadConfig, StreetStatistics};

/// A style of streets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Style {
    /// One rectangular grid, as planned cities have.
    Grid,
    /// Patches of grid with bent streets between them, as cities before 1940 have.
    #[default]
    Mixed,
    /// Streets that follow the land and meet three by three.
    Organic,
    /// Long blocks and many dead ends.
    Suburb,
}

/// A style that nobody knows.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("there is no style {0:?}: give grid, mixed, organic or suburb")]
pub struct StyleError(String);

impl FromStr for Style {
    type Err = StyleError;

    fn from_str(name: &str) -> Result<Self, StyleError> {
        Self::ALL.into_iter().find(|style| style.as_str() == name).ok_or_else(|| StyleError(name.to_owned()))
    }
}

impl std::fmt::Display for Style {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(self.as_str())
    }
}

/// The range of each statistic in which a style lies.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// Streets a junction.
    pub mean_degree: RangeInclusive<f64>,
    /// Share of dead ends.
    pub dead_ends: RangeInclusive<f64>,
    /// Share of junctions of four streets or more.
    pub four_way: RangeInclusive<f64>,
    /// Length over straight distance.
    pub circuity: RangeInclusive<f64>,
    /// Orientation order.
    pub orientation_order: RangeInclusive<f64>,
    /// Median length of a segment, m.
    pub median_length: RangeInclusive<f64>,
    /// Intersections on a square kilometre.
    pub intersection_density: RangeInclusive<f64>,
}

impl Band {
    /// Every statistic with its name, its value, its range, and whether it lies in it. The last row is the mean length
    /// over the median, which is above one everywhere: lengths are skewed to the right.
    pub fn check(&self, of: &StreetStatistics) -> [(&'static str, f64, RangeInclusive<f64>, bool); 8] {
        let skew = of.mean_length / of.median_length.max(1e-9);
        [
            ("streets a junction", of.mean_degree, self.mean_degree.clone()),
            ("dead ends", of.dead_ends, self.dead_ends.clone()),
            ("four-way", of.four_way, self.four_way.clone()),
            ("circuity", of.circuity, self.circuity.clone()),
            ("orientation order", of.orientation_order, self.orientation_order.clone()),
            ("median length, m", of.median_length, self.median_length.clone()),
            ("intersections / km²", of.intersection_density, self.intersection_density.clone()),
            ("mean / median length", skew, 1.2..=3.0),
        ]
        .map(|(name, value, range)| (name, value, range.clone(), range.contains(&value)))
    }
}

impl Style {
    /// Every style.
    pub const ALL: [Self; 4] = [Self::Grid, Self::Mixed, Self::Organic, Self::Suburb];

    /// Its name in files and on command lines.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Grid => "grid",
            Self::Mixed => "mixed",
            Self::Organic => "organic",
            Self::Suburb => "suburb",
        }
    }

    /// The road settings of the style, for a city of `count` segments. Cities of some size have two highways.
    pub fn roads(self, count: u32) -> RoadConfig {
        let base = RoadConfig { count, highways: if count >= 400 { 2 } else { 0 }, ..RoadConfig::default() };
        match self {
            Self::Mixed => mixed_roads(&base),
            Self::Grid => grid_roads(&base),
            Self::Organic => organic_roads(&base),
            Self::Suburb => suburb_roads(&base),
        }
    }

    /// The band in which cities of the style lie, from some hundred segments on.
    pub fn band(self) -> Band {
        let [degree, dead, four, circuity, order, median, density] = match self {
            Self::Grid => [
                (2.9, 3.6),
                (0.03, 0.15),
                (0.35, 0.9),
                (1.0, 1.05),
                (0.6, 0.99),
                (70.0, 130.0),
                (45.0, 120.0),
            ],
            Self::Mixed => {
                [(2.6, 3.0), (0.1, 0.22), (0.2, 0.4), (1.03, 1.09), (0.3, 0.75), (65.0, 110.0), (40.0, 90.0)]
            }
            Self::Organic => [
                (2.5, 2.9),
                (0.15, 0.3),
                (0.04, 0.14),
                (1.05, 1.16),
                (0.01, 0.15),
                (60.0, 105.0),
                (40.0, 110.0),
            ],
            Self::Suburb => [
                (2.3, 2.5),
                (0.22, 0.35),
                (0.05, 0.15),
                (1.08, 1.1),
                (0.02, 0.35),
                (90.0, 160.0),
                (15.0, 30.0),
            ],
        }
        .map(|(low, high)| low..=high);
        Band {
            mean_degree: degree,
            dead_ends: dead,
            four_way: four,
            circuity,
            orientation_order: order,
            median_length: median,
            intersection_density: density,
        }
    }
}

fn mixed_roads(base: &RoadConfig) -> RoadConfig {
    RoadConfig {
        aspect: 3.0,
        length_variation: 0.6,
        snap: 36.0,
        branching: 0.72,
        crossroads: 0.95,
        bends: 0.45,
        bow: 0.065,
        widest_block: 270.0,
        arterial_cycle_width: 1.8,
        ..base.clone()
    }
}

fn grid_roads(base: &RoadConfig) -> RoadConfig {
    RoadConfig {
        heading_variation: 0.015,
        order: 1.0,
        turning: 0.0,
        bends: 0.1,
        bow: 0.05,
        length: 116.0,
        aspect: 3.0,
        length_variation: 0.12,
        snap: 34.0,
        continuation: 0.98,
        branching: 0.9,
        crossroads: 1.0,
        dead_ends: 0.1,
        widest_block: 200.0,
        // Boulevards: trees in the middle, bicycles and parked cars at the sides.
        arterial_cycle_width: 1.8,
        arterial_median_width: 2.4,
        arterial_parking_width: 2.2,
        ..base.clone()
    }
}

fn organic_roads(base: &RoadConfig) -> RoadConfig {
    RoadConfig {
        length: 85.0,
        aspect: 2.8,
        length_variation: 0.6,
        heading_variation: 0.3,
        order: 0.35,
        turning: 2.2,
        patch: 350.0,
        snap: 34.0,
        least_angle: 0.8,
        continuation: 0.9,
        branching: 0.55,
        crossroads: 0.33,
        dead_ends: 0.22,
        bends: 0.9,
        bow: 0.14,
        widest_block: 360.0,
        ..base.clone()
    }
}

fn suburb_roads(base: &RoadConfig) -> RoadConfig {
    RoadConfig {
        length: 125.0,
        length_variation: 0.25,
        heading_variation: 0.25,
        order: 0.4,
        turning: 0.6,
        patch: 600.0,
        snap: 36.0,
        least_angle: 0.9,
        continuation: 0.72,
        branching: 0.3,
        crossroads: 0.45,
        dead_ends: 0.34,
        bends: 0.95,
        bow: 0.11,
        widest_block: 700.0,
        aspect: 1.0,
        ..base.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn styles_are_known_by_their_names() {
        for style in Style::ALL {
            assert_eq!(style.to_string().parse(), Ok(style));
            assert_eq!(serde_json::to_string(&style).unwrap(), format!("\"{style}\""));
        }
        assert!("gird".parse::<Style>().unwrap_err().to_string().contains("grid, mixed"));
    }
}
