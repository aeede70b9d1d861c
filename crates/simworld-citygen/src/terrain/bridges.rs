//! Heights of bridges: streets that pass over others without a node rise until there is room below.
//!
//! Where a street of a higher level crosses a lower one it must lie a headroom and the thickness of its deck above it. From
//! there it falls as steeply as its class allows, along its own course and beyond its nodes along the streets that it
//! leads on to, until it meets the heights that were there before: the lowest heights that clear what is below and are
//! nowhere too steep (the upper envelope of cones, as in [`elevations`](super::elevations)). Streets are straight between
//! the places where that bends; there are no vertical curves.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use simworld_core::geometry::Point2;
use simworld_core::net::{StreetPlan, polyline};
use thiserror::Error;

use super::TerrainConfig;

/// Height free between a carriageway and what passes over it, m: 16 feet and a margin for new pavement (AASHTO, A Policy on
/// Geometric Design of Highways and Streets, 2011, section 7.2.2; 4.5 to 5.3 m in European countries).
pub const HEADROOM: f64 = 5.0;
/// Thickness of the deck of a bridge, m.
pub const DECK: f64 = 0.8;

/// Rounds of raising: a bridge over a ramp of another rises with it.
const ROUNDS: usize = 16;
/// What may be missing, m: less than the road wears off.
const TOLERATED: f64 = 0.01;
/// Bridges rise by no more than this in all, m.
const HIGHEST: f64 = 40.0;
/// Crossings this near to a node that both streets have are the node's, m.
const AT_NODE: f64 = 1.0;
/// Cells in which crossings are looked for, m.
const CELL: f64 = 100.0;

/// A bridge that is lower than it should be.
#[derive(Clone, Debug, PartialEq, Error)]
#[error(
    "street {upper} passes {headroom:.2} m above street {lower} at ({x:.0}, {y:.0}), which is less than {HEADROOM} m: give \
     it longer ramps, or steeper ones in `terrain`"
)]
pub struct BridgeWarning {
    /// The street that passes over.
    pub upper: usize,
    /// The street below.
    pub lower: usize,
    /// Where, east, m.
    pub x: f64,
    /// Where, north, m.
    pub y: f64,
    /// The height free between the two, m; less than nothing where they meet.
    pub headroom: f64,
}

/// Where one street passes over another.
struct Passage {
    upper: usize,
    lower: usize,
    /// Stations on the two, m.
    stations: (f64, f64),
    /// How far the lower one reaches along the upper one to either side, m.
    half: f64,
    at: Point2,
}

/// Raises the streets of a valid plan that pass over others, with the nodes and streets that they lead to, and says
/// where that was not enough. Only streets above the ground rise; those in tunnels stay where they are. A plan without
/// bridges stays as it is.
///
/// ```
/// use simworld_citygen::terrain::{TerrainConfig, raise_bridges};
/// use simworld_core::geometry::Point2;
/// use simworld_core::net::{Street, StreetPlan};
/// let mut plan = StreetPlan::default();
/// plan.nodes = [(-200.0, 0.0), (200.0, 0.0), (0.0, -90.0), (0.0, 90.0)].map(|(x, y)| Point2::new(x, y)).to_vec();
/// plan.streets = vec![Street { level: 1, ..Street::simple(0, 1) }, Street::simple(2, 3)];
/// assert!(raise_bridges(&mut plan, &TerrainConfig::default()).is_empty());
/// let highest = plan.streets[0].profile.iter().map(|(_, height)| *height).fold(0.0, f64::max);
/// assert!((highest - 5.8).abs() < 1e-9 && plan.elevation(0) == 0.0);
/// ```
pub fn raise_bridges(plan: &mut StreetPlan, config: &TerrainConfig) -> Vec<BridgeWarning> {
    if plan.streets.iter().all(|street| street.level <= 0) {
        return Vec::new();
    }
    let lines: Vec<Vec<Point2>> = plan.streets.iter().map(|street| plan.centerline(street)).collect();
    let lengths: Vec<f64> = lines.iter().map(|line| polyline::length(line)).collect();
    let passages = passages(plan, &lines);
    if passages.is_empty() {
        return Vec::new();
    }
    if plan.elevations.is_empty() {
        plan.elevations = vec![0.0; plan.nodes.len()];
    }
    let before = plan.elevations.clone();
    for _ in 0..ROUNDS {
        let wanted: Vec<f64> = passages
            .iter()
            .map(|it| height(plan, &lengths, it.lower, it.stations.1) + HEADROOM + DECK)
            .collect();
        let is_clear =
            |(it, wanted): (&Passage, &f64)| height(plan, &lengths, it.upper, it.stations.0) >= wanted - 1e-9;
        if passages.iter().zip(&wanted).all(is_clear) {
            break;
        }
        raise_nodes(plan, config, &lengths, &before, &passages, &wanted);
        raise_streets(plan, config, &lengths, &passages, &wanted);
    }
    let headroom = |it: &Passage| {
        height(plan, &lengths, it.upper, it.stations.0)
            - DECK
            - height(plan, &lengths, it.lower, it.stations.1)
    };
    let low =
        passages.iter().map(|it| (it, headroom(it))).filter(|(_, headroom)| *headroom < HEADROOM - TOLERATED);
    low.map(|(it, headroom)| BridgeWarning {
        upper: it.upper,
        lower: it.lower,
        x: it.at.x,
        y: it.at.y,
        headroom,
    })
    .collect()
}

/// The height of a street at a station, m.
fn height(plan: &StreetPlan, lengths: &[f64], street: usize, station: f64) -> f64 {
    let (length, street) = (lengths[street], &plan.streets[street]);
    let next = street.profile.partition_point(|(at, _)| *at <= station);
    let before =
        next.checked_sub(1).map_or((0.0, plan.elevation(street.from)), |index| street.profile[index]);
    let after = street.profile.get(next).copied().unwrap_or((length, plan.elevation(street.to)));
    let share = (station - before.0) / (after.0 - before.0).max(1e-9);
    before.1 + (after.1 - before.1) * share.clamp(0.0, 1.0)
}

/// Raises nodes so that from every passage one gets down to them, and from each of them to the next, no more steeply
/// than allowed.
fn raise_nodes(
    plan: &mut StreetPlan,
    config: &TerrainConfig,
    lengths: &[f64],
    before: &[f64],
    passages: &[Passage],
    wanted: &[f64],
) {
    let mut around: Vec<Vec<(usize, f64)>> = vec![Vec::new(); plan.nodes.len()];
    for (street, length) in plan.streets.iter().zip(lengths) {
        let fall = config.grade(street.class) * length;
        around[street.from].push((street.to, fall));
        around[street.to].push((street.from, fall));
    }
    let mut queue: BinaryHeap<(Height, Reverse<usize>)> = BinaryHeap::new();
    for (it, wanted) in passages.iter().zip(wanted) {
        let street = &plan.streets[it.upper];
        let grade = config.grade(street.class);
        let away = [it.stations.0 - it.half, lengths[it.upper] - it.stations.0 - it.half];
        for (node, away) in [street.from, street.to].into_iter().zip(away) {
            queue.push((Height(wanted - grade * away.max(0.0)), Reverse(node)));
        }
    }
    while let Some((Height(height), Reverse(node))) = queue.pop() {
        let height = height.min(before[node] + HIGHEST);
        if height <= plan.elevations[node] {
            continue;
        }
        plan.elevations[node] = height;
        queue.extend(around[node].iter().map(|(there, fall)| (Height(height - fall), Reverse(*there))));
    }
}

/// A height in a queue, the highest first.
#[derive(PartialEq)]
struct Height(f64);

impl Eq for Height {}

impl Ord for Height {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for Height {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

/// Gives every street that passes over others the heights of its course.
fn raise_streets(
    plan: &mut StreetPlan,
    config: &TerrainConfig,
    lengths: &[f64],
    passages: &[Passage],
    wanted: &[f64],
) {
    let mut tops: Vec<(usize, f64, f64, f64)> = passages
        .iter()
        .zip(wanted)
        .map(|(it, wanted)| {
            let (from, to) = (it.stations.0 - it.half, it.stations.0 + it.half);
            (it.upper, from.max(0.0), to.min(lengths[it.upper]), *wanted)
        })
        .collect();
    tops.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    for tops in tops.chunk_by(|a, b| a.0 == b.0) {
        let index = tops[0].0;
        let street = &plan.streets[index];
        let ends = (plan.elevation(street.from), plan.elevation(street.to));
        let course = Course { ends, length: lengths[index], grade: config.grade(street.class), tops };
        plan.streets[index].profile = course.profile().into();
    }
}

/// The course of a street over its passages: for each its street, where it begins and ends and the height there.
struct Course<'a> {
    ends: (f64, f64),
    length: f64,
    grade: f64,
    tops: &'a [(usize, f64, f64, f64)],
}

impl Course<'_> {
    fn base(&self, station: f64) -> f64 {
        self.ends.0 + (self.ends.1 - self.ends.0) * station / self.length
    }

    /// The lowest height that is on or above the way from end to end and all tops with their ramps.
    fn height(&self, station: f64) -> f64 {
        let ramp = |(_, from, to, top): &(usize, f64, f64, f64)| {
            top - self.grade * (from - station).max(station - to).max(0.0)
        };
        self.tops.iter().map(ramp).fold(self.base(station), f64::max)
    }

    /// Its bends: the ends of tops, where ramps meet the way from end to end, and where they meet each other.
    fn profile(&self) -> Vec<(f64, f64)> {
        let slope = (self.ends.1 - self.ends.0) / self.length;
        let mut stations = Vec::new();
        for (rank, (_, from, to, top)) in self.tops.iter().enumerate() {
            stations.extend([*from, *to]);
            stations.push(from - (top - self.base(*from)) / (self.grade + slope).max(1e-9));
            stations.push(to + (top - self.base(*to)) / (self.grade - slope).max(1e-9));
            for (_, next, _, other) in &self.tops[rank + 1..] {
                stations.push((to + next) * 0.5 + (top - other) / (2.0 * self.grade));
            }
        }
        stations.retain(|station| *station > 1e-6 && *station < self.length - 1e-6);
        stations.sort_by(f64::total_cmp);
        stations.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
        stations.into_iter().map(|station| (station, self.height(station))).collect()
    }
}

/// Where streets above the ground pass over lower ones.
fn passages(plan: &StreetPlan, lines: &[Vec<Point2>]) -> Vec<Passage> {
    let cells = cells(lines);
    let mut found = Vec::new();
    for (upper, street) in plan.streets.iter().enumerate().filter(|(_, street)| street.level > 0) {
        let mut near: Vec<usize> = passed(&lines[upper])
            .flat_map(|cell| {
                let from = cells.partition_point(|entry| entry.0 < cell);
                cells[from..].iter().take_while(move |entry| entry.0 == cell).map(|entry| entry.1)
            })
            .filter(|lower| plan.streets[*lower].level < street.level)
            .collect();
        near.sort_unstable();
        near.dedup();
        for lower in near {
            meet(plan, lines, (upper, lower), &mut found);
        }
    }
    found
}

/// The places where two streets cross, except at a node that both have.
fn meet(plan: &StreetPlan, lines: &[Vec<Point2>], (upper, lower): (usize, usize), found: &mut Vec<Passage>) {
    let ends = |street: usize| [plan.streets[street].from, plan.streets[street].to];
    let shared = ends(upper).into_iter().filter(|node| ends(lower).contains(node));
    let shared: Vec<Point2> = shared.map(|node| plan.nodes[node]).collect();
    let section = plan.section(&plan.streets[lower]);
    let reach = section.left_of_reference().max(section.right_of_reference());
    let mut above = 0.0;
    for a in lines[upper].windows(2) {
        let step = a[1] - a[0];
        let mut below = 0.0;
        for b in lines[lower].windows(2) {
            let other = b[1] - b[0];
            if let Some((t, u)) = polyline::crossing(a[0], a[1], b[0], b[1]) {
                let at = a[0] + step * t;
                if shared.iter().all(|node| (node - at).norm() > AT_NODE) {
                    let sine = (step.perp(&other) / (step.norm() * other.norm())).abs().max(0.2);
                    let stations = (above + step.norm() * t, below + other.norm() * u);
                    found.push(Passage { upper, lower, stations, half: reach / sine, at });
                }
            }
            below += other.norm();
        }
        above += step.norm();
    }
}

fn cell(point: Point2) -> (i64, i64) {
    ((point.x / CELL).floor() as i64, (point.y / CELL).floor() as i64)
}

/// The cells of the rectangles around the pieces of a line; long pieces in parts.
fn passed(line: &[Point2]) -> impl Iterator<Item = (i64, i64)> + '_ {
    line.windows(2).flat_map(|pair| {
        let step = pair[1] - pair[0];
        let count = (step.norm() / CELL).ceil().max(1.0);
        (0..count as u64).flat_map(move |part| {
            let [a, b] = [part, part + 1].map(|end| pair[0] + step * (end as f64 / count));
            let (low, high) = (cell(a.inf(&b)), cell(a.sup(&b)));
            (low.0..=high.0).flat_map(move |column| (low.1..=high.1).map(move |row| (column, row)))
        })
    })
}

/// All streets by the cells that they pass, in the order of cells.
fn cells(lines: &[Vec<Point2>]) -> Vec<((i64, i64), usize)> {
    let mut cells: Vec<((i64, i64), usize)> = lines
        .iter()
        .enumerate()
        .flat_map(|(index, line)| passed(line).map(move |cell| (cell, index)))
        .collect();
    cells.sort_unstable();
    cells.dedup();
    cells
}
