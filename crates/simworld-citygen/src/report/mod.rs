//! The statistics by which a city is judged.

mod judged;
mod streets;

use std::fmt;

use serde::{Deserialize, Serialize};

pub use judged::Judged;
pub use streets::StreetStatistics;

use crate::City;
use crate::occupancy::Occupancy;

/// Statistics of a city.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CityReport {
    /// Its streets.
    pub streets: StreetStatistics,
    /// Number of buildings.
    pub buildings: usize,
    /// Number of street elements.
    pub elements: usize,
    /// Share of the frontage taken by buildings.
    pub frontage_used: f64,
    /// Share of the streets' hull that buildings cover.
    pub coverage: f64,
    /// Floor area over the area of the streets' hull.
    pub floor_area_ratio: f64,
    /// Share of the commonest kind among the buildings.
    pub commonest_kind: f64,
    /// Pairs of buildings that overlap; 0 for a sound city.
    pub overlaps: usize,
}

impl CityReport {
    pub(crate) fn of(city: &City) -> Self {
        let streets = StreetStatistics::of(&city.plan);
        let area = streets.area.max(1.0);
        let sum =
            |area: &dyn Fn(&crate::building::Building) -> f64| city.buildings.iter().map(area).sum::<f64>();
        Self {
            streets,
            buildings: city.buildings.len(),
            elements: city.elements.len(),
            frontage_used: city.frontage_used(),
            coverage: sum(&|building| building.footprint_area()) / area,
            floor_area_ratio: sum(&|building| building.floor_area()) / area,
            commonest_kind: commonest_kind(city),
            overlaps: overlaps(city),
        }
    }
}

fn commonest_kind(city: &City) -> f64 {
    let mut names: Vec<&str> = city.buildings.iter().map(|building| building.archetype.name).collect();
    names.sort_unstable();
    let most = names.chunk_by(|a, b| a == b).map(<[&str]>::len).max().unwrap_or(0);
    most as f64 / names.len().max(1) as f64
}

/// Counted anew from the footprints, not from what the generator believes.
fn overlaps(city: &City) -> usize {
    let mut standing = Occupancy::default();
    let mut count = 0;
    for building in &city.buildings {
        let ground = building.ground();
        count += usize::from(ground.iter().any(|piece| !standing.is_free(piece)));
        for piece in &ground {
            standing.add(piece);
        }
    }
    count
}

impl fmt::Display for StreetStatistics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "streets            {:>8}   connected parts {}", self.streets, self.components)?;
        writeln!(f, "streets a junction {:>8.2}   of {} junctions", self.mean_degree, self.junctions)?;
        writeln!(
            f,
            "junctions          {:>7.1} % dead ends, {:.1} % three-way, {:.1} % four-way",
            100.0 * self.dead_ends,
            100.0 * self.three_way,
            100.0 * self.four_way
        )?;
        let (median, mean) = (self.median_length, self.mean_length);
        writeln!(f, "segment length     {median:>8.1} m median, {mean:.1} m mean")?;
        writeln!(f, "circuity           {:>8.3}", self.circuity)?;
        writeln!(f, "orientation order  {:>8.3}", self.orientation_order)?;
        write!(f, "intersections      {:>8.1} / km²", self.intersection_density)
    }
}

impl fmt::Display for CityReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.streets)?;
        writeln!(
            f,
            "buildings          {:>8}   overlapping pairs {}, commonest kind {:.0} %",
            self.buildings,
            self.overlaps,
            100.0 * self.commonest_kind
        )?;
        writeln!(
            f,
            "covered            {:>8.3}   floor area ratio {:.2}",
            self.coverage, self.floor_area_ratio
        )?;
        writeln!(f, "frontage used      {:>8.2}", self.frontage_used)?;
        write!(f, "street elements    {:>8}", self.elements)
    }
}
