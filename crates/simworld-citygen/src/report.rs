//! The statistics by which a city is judged.

use std::fmt;

use petgraph::unionfind::UnionFind;
use simworld_core::net::polyline;

use crate::City;
use crate::city::street_length;
use crate::occupancy::Occupancy;

/// Statistics of a city. Junctions are nodes where other than two streets meet; segments run between those.
#[derive(Clone, Debug, PartialEq)]
pub struct CityReport {
    /// Streets of the plan.
    pub streets: usize,
    /// Connected parts; 1 for a sound city.
    pub components: usize,
    /// Streets a junction, dead ends included.
    pub mean_degree: f64,
    /// Share of dead ends among junctions.
    pub dead_ends: f64,
    /// Share of junctions of three streets.
    pub three_way: f64,
    /// Share of junctions of four streets or more.
    pub four_way: f64,
    /// Median length of a street, m.
    pub median_length: f64,
    /// Mean length of a street, m.
    pub mean_length: f64,
    /// Length along the streets over the straight distance between their ends.
    pub circuity: f64,
    /// Number of buildings.
    pub buildings: usize,
    /// Number of street elements.
    pub elements: usize,
    /// Share of the frontage taken by buildings.
    pub frontage_used: f64,
    /// Share of the commonest kind among the buildings.
    pub commonest_kind: f64,
    /// Pairs of buildings that overlap; 0 for a sound city.
    pub overlaps: usize,
}

impl CityReport {
    pub(crate) fn of(city: &City) -> Self {
        let plan = &city.plan;
        let mut degree = vec![0_usize; plan.nodes.len()];
        let mut parts = UnionFind::<usize>::new(plan.nodes.len());
        for street in &plan.streets {
            degree[street.from] += 1;
            degree[street.to] += 1;
            parts.union(street.from, street.to);
        }
        let junctions: Vec<usize> = degree.into_iter().filter(|degree| *degree != 2).collect();
        let share = |wanted: &dyn Fn(usize) -> bool| {
            junctions.iter().filter(|degree| wanted(**degree)).count() as f64 / junctions.len().max(1) as f64
        };
        let mut lengths: Vec<f64> =
            plan.streets.iter().map(|street| polyline::length(&plan.centerline(street))).collect();
        lengths.sort_by(f64::total_cmp);
        let straight: f64 =
            plan.streets.iter().map(|street| (plan.nodes[street.to] - plan.nodes[street.from]).norm()).sum();
        let mut labels = parts.into_labeling();
        labels.sort_unstable();
        labels.dedup();
        Self {
            streets: plan.streets.len(),
            components: labels.len(),
            mean_degree: junctions.iter().sum::<usize>() as f64 / junctions.len().max(1) as f64,
            dead_ends: share(&|degree| degree == 1),
            three_way: share(&|degree| degree == 3),
            four_way: share(&|degree| degree >= 4),
            median_length: lengths.get(lengths.len() / 2).copied().unwrap_or(0.0),
            mean_length: street_length(plan) / lengths.len().max(1) as f64,
            circuity: street_length(plan) / straight.max(1e-9),
            buildings: city.buildings.len(),
            elements: city.elements.len(),
            frontage_used: city.frontage_used(),
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
        let obb = building.obb();
        count += usize::from(!standing.is_free_box(&obb));
        standing.add_box(&obb);
    }
    count
}

impl fmt::Display for CityReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "streets            {:>8}   connected parts {}", self.streets, self.components)?;
        writeln!(f, "streets a junction {:>8.2}", self.mean_degree)?;
        writeln!(
            f,
            "junctions          {:>7.1} % dead ends, {:.1} % three-way, {:.1} % four-way",
            100.0 * self.dead_ends,
            100.0 * self.three_way,
            100.0 * self.four_way
        )?;
        writeln!(
            f,
            "street length      {:>8.1} m median, {:.1} m mean",
            self.median_length, self.mean_length
        )?;
        writeln!(f, "circuity           {:>8.3}", self.circuity)?;
        writeln!(
            f,
            "buildings          {:>8}   overlapping pairs {}, commonest kind {:.0} %",
            self.buildings,
            self.overlaps,
            100.0 * self.commonest_kind
        )?;
        writeln!(f, "frontage used      {:>8.2}", self.frontage_used)?;
        write!(f, "street elements    {:>8}", self.elements)
    }
}
