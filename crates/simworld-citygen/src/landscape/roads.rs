//! Roads beyond the city: along the coast of an island, across the countryside.
//!
//! Lanes of 2.75 m are those of narrow rural roads (German RAL 2012, EKL 4 without a centre line: 6 m in all; British C roads
//! 5 to 6 m); grades stay under 8 % between places and 12 % in villages (AASHTO Green Book, rural collectors and local roads in
//! rolling country).

use simworld_core::geometry::{Point2, Point3, Vector2};
use simworld_core::id::RoadId;
use simworld_core::net::{CrossSection, NetworkConfig, RoadNetwork, Street, StreetPlan, polyline};
use simworld_core::spec::{SceneSpec, Width};

use super::grid::Grid;
use super::relief::bearing;
use super::trails::{Router, on_land, rounded};
use crate::terrain::{HeightField, TerrainConfig, elevations};

/// Steepest grades, rise over run.
const COUNTRY_GRADE: f64 = 0.08;
const VILLAGE_GRADE: f64 = 0.12;
/// Roads are looked for over steeper land: they are cut into it.
const CUT: f64 = 0.2;
/// The first row of a village lies so far from the shore, and the next so far behind it, m.
const QUAY: f64 = 26.0;
const ROW: f64 = 52.0;
/// Most rows, and from cross lane to cross lane along them, m.
const ROWS: usize = 4;
const ALONG: f64 = 110.0;
/// Bearings at which the shore is known.
const BEARINGS: usize = 360;
/// Roads lie so high above the water, m.
const DRY: f64 = 1.3;
/// Points along a road, m.
const FINE: f64 = 8.0;

/// The section of a road of the width that is wished for.
pub(super) fn section(spec: &SceneSpec) -> CrossSection {
    let (lane, walk) = match spec.streets.width {
        Width::Narrow => (2.6, 1.2),
        Width::Usual => (2.75, 1.5),
        Width::Wide => (3.5, 2.0),
    };
    CrossSection::plain(1, 1, lane, walk)
}

/// Country roads do not have signals; in villages 30 km/h, beyond them 70.
pub(super) fn rules() -> NetworkConfig {
    NetworkConfig {
        signals_from_roads: 0,
        local_speed: 30.0 / 3.6,
        arterial_speed: 70.0 / 3.6,
        ..NetworkConfig::default()
    }
}

/// A village by the sea: rows along the shore with lanes between them, room for so many metres of fronts; none where the coast
/// has no room. Also its middle.
pub(super) fn by_the_sea(grid: &Grid, fronts: f64, section: &CrossSection) -> Option<(StreetPlan, Point2)> {
    let shore = shore_of(grid);
    let mean = shore.iter().sum::<f64>() / shore.len() as f64;
    let most = 1.5 * (mean - QUAY);
    let rows = (1..=ROWS).find(|rows| fronts / (2.0 * *rows as f64) <= most).unwrap_or(ROWS);
    let length = (fronts / (2.0 * rows as f64)).clamp(90.0, most);
    let deepest = QUAY + (rows - 1) as f64 * ROW;
    // In turns, from the middle of the village to its ends.
    let reach = length / (mean - QUAY) / std::f64::consts::TAU * 0.5;
    let place = |turns: f64, off: f64| {
        let at = turns.rem_euclid(1.0) * BEARINGS as f64;
        let (one, share) = (at as usize % BEARINGS, at.fract());
        let radius = shore[one] * (1.0 - share) + shore[(one + 1) % BEARINGS] * share;
        Point2::from(bearing(turns) * (radius - off))
    };
    let roughness = |middle: usize| {
        let turns = middle as f64 / BEARINGS as f64;
        let samples = (0..=12).flat_map(|step| {
            let turns = turns + reach * (f64::from(step) / 6.0 - 1.0);
            [0.6, 1.0, 1.4].map(|deep| place(turns, QUAY + deep * (deepest - QUAY) + 10.0))
        });
        samples.map(|at| grid.slope(at) + 0.02 * (grid.height(at) - 5.0).abs()).sum::<f64>()
    };
    let best = (0..BEARINGS).step_by(4).min_by(|a, b| roughness(*a).total_cmp(&roughness(*b)))?;
    let middle = best as f64 / BEARINGS as f64;
    let lanes = ((length / ALONG).ceil() as usize).max(1);
    let mut plan = StreetPlan { sections: vec![section.clone()], ..StreetPlan::default() };
    let turns = |share: f64| middle + reach * (2.0 * share - 1.0);
    for row in 0..rows {
        let off = QUAY + row as f64 * ROW;
        for lane in 0..=lanes {
            plan.nodes.push(place(turns(lane as f64 / lanes as f64), off));
            if lane > 0 {
                let node = plan.nodes.len() - 1;
                let between = (length / lanes as f64 / FINE).ceil() as usize;
                let share = |step: usize| (lane as f64 - 1.0 + step as f64 / between as f64) / lanes as f64;
                let via = (1..between).map(|step| place(turns(share(step)), off)).collect();
                plan.streets.push(Street { via, ..Street::simple(node - 1, node) });
            }
            if row > 0 {
                let node = plan.nodes.len() - 1;
                let via = in_between(plan.nodes[node - lanes - 1], plan.nodes[node]);
                plan.streets.push(Street { via, ..Street::simple(node - lanes - 1, node) });
            }
        }
    }
    name(&mut plan, &["Harbour Road", "Church Lane", "Hill Lane", "Mill Lane"]);
    raise(&mut plan, grid, VILLAGE_GRADE);
    Some((plan, place(middle, QUAY)))
}

/// How far the outer shore is from the middle by bearing, m, without its small bays.
fn shore_of(grid: &Grid) -> Vec<f64> {
    let raw: Vec<f64> = (0..BEARINGS)
        .map(|index| {
            let way = bearing(index as f64 / BEARINGS as f64);
            let steps = (grid.half / 2.0) as usize;
            let dry =
                (0..steps).rev().find(|step| grid.height(Point2::from(way * (*step as f64 * 2.0))) >= 0.0);
            dry.unwrap_or(0) as f64 * 2.0
        })
        .collect();
    let around = |index: usize| (0..21).map(move |off| (index + BEARINGS + off - 10) % BEARINGS);
    // Inside bays rather than across them: nearer the least than the mean.
    let smoothed = |index: usize| {
        let mean = around(index).map(|at| raw[at]).sum::<f64>() / 21.0;
        let least = around(index).map(|at| raw[at]).fold(f64::INFINITY, f64::min);
        0.5 * (mean + least)
    };
    (0..BEARINGS).map(smoothed).collect()
}

/// Points on a straight way, so that its road follows the land.
fn in_between(from: Point2, to: Point2) -> Vec<Point2> {
    let count = ((to - from).norm() / FINE).ceil().max(1.0);
    (1..count as u32).map(|step| from + (to - from) * (f64::from(step) / count)).collect()
}

/// Three roads that meet in the middle of a hamlet and leave to the west, the north and the south; also that middle.
pub(super) fn across_country(grid: &Grid, section: &CrossSection) -> Option<(StreetPlan, Point2)> {
    let half = grid.half;
    let mut plan = StreetPlan { sections: vec![section.clone()], ..StreetPlan::default() };
    let hub = Point2::new(-half * 0.22, half * 0.04);
    let dry = |point: &Point2| grid.height(*point) > DRY;
    for (rank, way) in [(-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)].into_iter().enumerate() {
        let way = Vector2::new(way.0, way.1);
        let hub_of = |router: &Router| router.place(router.node(hub));
        // Each keeps to its own sector, so that they part at once.
        let router = Router::new(grid, CUT, |place| {
            let off = place - hub;
            off.norm() > 15.0 && off.dot(&way) < 0.8 * off.norm()
        });
        let is_end = |node: usize| router.place(node).coords.dot(&way) > half - 30.0;
        let nodes = router.way(router.node(hub), is_end)?;
        let line = on_land(grid, nodes.into_iter().map(|node| router.place(node)));
        let line = rounded(&rounded(&rounded(&line)));
        let line: Vec<Point2> = line.iter().map(Point3::xy).collect();
        if !line.iter().all(dry) {
            return None;
        }
        if rank == 0 {
            plan.nodes.push(hub_of(&router));
        }
        plan.nodes.push(line[line.len() - 1]);
        let length = polyline::length(&line);
        let count = (length / FINE).ceil();
        let via =
            (1..count as u32).map(|step| polyline::at(&line, length * f64::from(step) / count).0).collect();
        plan.streets.push(Street { via, ..Street::simple(0, plan.nodes.len() - 1) });
    }
    name(&mut plan, &["West Road", "North Road", "South Road"]);
    raise(&mut plan, grid, COUNTRY_GRADE);
    let hub = plan.nodes[0];
    Some((plan, hub))
}

fn name(plan: &mut StreetPlan, names: &[&str]) {
    for (index, street) in plan.streets.iter_mut().enumerate() {
        if let Some(name) = names.get(index) {
            plan.names.push((*name).to_owned());
            street.name = Some((plan.names.len() - 1) as u32);
        }
    }
}

/// Gives a plan the heights of the land, cut and filled until nothing is steeper than `grade`.
fn raise(plan: &mut StreetPlan, grid: &Grid, grade: f64) {
    let config = TerrainConfig { local_grade: grade, arterial_grade: grade, ..TerrainConfig::default() };
    plan.elevations = elevations(plan, grid, &config).into_iter().map(|height| height.max(DRY)).collect();
    for index in 0..plan.streets.len() {
        let street = &plan.streets[index];
        let line = plan.centerline(street);
        let ends = (plan.elevation(street.from), plan.elevation(street.to));
        plan.streets[index].profile = profile(grid, &line, ends, grade).into();
    }
}

/// Heights at the inner points of a line: those of the land as far as the grade lets them, by the mean of the highest such
/// heights nowhere above it and the lowest nowhere below it (see `terrain::grade`).
fn profile(grid: &Grid, line: &[Point2], ends: (f64, f64), grade: f64) -> Vec<(f64, f64)> {
    let mut stations = vec![0.0];
    for pair in line.windows(2) {
        stations.push(stations[stations.len() - 1] + (pair[1] - pair[0]).norm());
    }
    let last = line.len() - 1;
    let land: Vec<f64> = line.iter().map(|point| grid.height(*point).max(DRY)).collect();
    let rise = |a: usize, b: usize| grade * (stations[a] - stations[b]).abs();
    let all = || 0..=last;
    let height = |at: usize| {
        let below = all().map(|other| land[other] + rise(at, other)).fold(f64::INFINITY, f64::min);
        let above = all().map(|other| land[other] - rise(at, other)).fold(f64::NEG_INFINITY, f64::max);
        let low = (ends.0 - rise(at, 0)).max(ends.1 - rise(at, last));
        let high = (ends.0 + rise(at, 0)).min(ends.1 + rise(at, last));
        ((below + above) * 0.5).clamp(low.min(high), high)
    };
    (1..last).map(|at| (stations[at], height(at))).collect()
}

/// Roads as lines in space, and how far the widest reaches to its sides with its sidewalks, m.
pub(super) fn beds(network: &RoadNetwork) -> (Vec<Vec<Point3>>, f64) {
    let lines = network.roads.iter().enumerate().map(|(index, road)| {
        let mut station = 0.0;
        let mut before = road.centerline[0];
        let point = |place: &Point2| {
            station += (place - before).norm();
            before = *place;
            Point3::new(place.x, place.y, network.height(RoadId::from_index(index), station))
        };
        road.centerline.iter().map(point).collect()
    });
    (lines.collect(), reach(network))
}

/// How far the widest road reaches to its sides with its sidewalks, m.
pub(super) fn reach(network: &RoadNetwork) -> f64 {
    let walk = network.sidewalks.iter().map(|walk| walk.width).fold(0.0, f64::max);
    let kerb = network.roads.iter().map(|road| road.left_kerb.max(road.right_kerb)).fold(0.0, f64::max);
    kerb + walk + 0.5
}
