//! Roads that cross without a junction: the higher one is a bridge there, a street of its own above the ground.

use std::collections::BTreeMap;

use simworld_core::geometry::Point2;
use simworld_core::net::{SHORTEST_STREET, polyline};

use super::error::OpenDriveWarning;
use super::pieces::{Gathered, Piece};

/// Width of a cell of the search grid, m.
const CELL: f64 = 60.0;
/// Cells that one straight piece may lie in, and pairs that are compared in all for each of them and besides.
const MOST_CELLS: f64 = 20_000.0;
const MOST_PAIRS: (usize, usize) = (400, 10_000_000);
/// Difference in height from which one road passes over the other, m.
const APART: f64 = 2.0;
/// A crossing this near to the end of a street that is no higher is where it touches the other one, m.
const NEAR_END: f64 = 8.0;
/// What a bridge is longer than what lies below is wide, to either side, m.
const BEYOND: f64 = 6.0;
/// The shortest part of a street, m.
const SHORTEST: f64 = SHORTEST_STREET + 0.5;
/// Levels above the ground at most.
const MOST_LEVELS: i8 = 9;

/// Where two streets cross: each by its number and the station on it, m.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    sides: [(usize, f64); 2],
    /// The sine of the angle between them.
    sine: f64,
}

/// A bridge: a part of a street between two stations, m.
struct Bridge {
    from: f64,
    to: f64,
    /// What lies below: streets and the stations on them.
    over: Vec<(usize, f64)>,
    level: i8,
}

/// Makes bridges of what passes over others.
pub(super) fn part_levels(gathered: &mut Gathered<'_>, warnings: &mut Vec<OpenDriveWarning>) {
    let mut bridges: BTreeMap<usize, Vec<Bridge>> = BTreeMap::new();
    for crossing in crossings(&gathered.pieces, warnings) {
        if let Some((upper, bridge)) = bridge(gathered, &crossing, warnings) {
            bridges.entry(upper).or_default().push(bridge);
        }
    }
    for (upper, bridges) in &mut bridges {
        let length = polyline::length(&gathered.pieces[*upper].line);
        fit(bridges, length);
    }
    settle(&mut bridges);
    let pieces = std::mem::take(&mut gathered.pieces);
    for (index, piece) in pieces.into_iter().enumerate() {
        let bridges = bridges.get(&index).map(Vec::as_slice).unwrap_or_default();
        let length = polyline::length(&piece.line);
        let stations = bridges.iter().flat_map(|bridge| [bridge.from, bridge.to]);
        let stations: Vec<f64> = stations.filter(|at| *at > 0.0 && *at < length).collect();
        let begins = bridges.first().is_some_and(|bridge| bridge.from <= 0.0);
        let mut parts = gathered.cut(piece, &stations);
        // Every other part is a bridge.
        for (part, bridge) in parts.iter_mut().skip(usize::from(!begins)).step_by(2).zip(bridges) {
            part.level = bridge.level;
        }
        gathered.pieces.extend(parts);
    }
}

/// The street that passes over the other one at a crossing, and the bridge there.
fn bridge(
    gathered: &Gathered<'_>,
    crossing: &Crossing,
    warnings: &mut Vec<OpenDriveWarning>,
) -> Option<(usize, Bridge)> {
    let pieces = crossing.sides.map(|(piece, _)| &gathered.pieces[piece]);
    let [a, b] = [0, 1].map(|side| gathered.height(pieces[side], crossing.sides[side].1));
    let other = &pieces[1].road.id;
    if (a - b).abs() < APART {
        let is_at_end = |side: usize| {
            let station = crossing.sides[side].1;
            station.min(polyline::length(&pieces[side].line) - station) < NEAR_END
        };
        // Lines that lead into one junction may cross before it.
        if pieces[0].ends.iter().any(|end| pieces[1].ends.contains(end)) {
            return None;
        }
        let what = if is_at_end(0) || is_at_end(1) {
            format!("touches road {other} without a junction; nothing was joined")
        } else {
            format!("crosses road {other} without a junction at its height; the latter passes over it")
        };
        warnings.push(OpenDriveWarning::of(&pieces[0].road.id, what));
        if is_at_end(0) || is_at_end(1) {
            return None;
        }
    }
    let upper = usize::from(a - b < APART);
    let ((above, station), below) = (crossing.sides[upper], crossing.sides[1 - upper]);
    let section = &pieces[1 - upper].road.section;
    let reach = section.left_of_reference().max(section.right_of_reference());
    let half = reach / crossing.sine.max(0.2) + BEYOND;
    let over = vec![below];
    Some((above, Bridge { from: station - half, to: station + half, over, level: 1 }))
}

/// Makes bridges long enough for streets, and one of those that leave no street between.
fn fit(bridges: &mut Vec<Bridge>, length: f64) {
    for bridge in bridges.iter_mut() {
        let lacks = (SHORTEST - (bridge.to - bridge.from)).max(0.0) * 0.5;
        (bridge.from, bridge.to) = (bridge.from - lacks, bridge.to + lacks);
        if bridge.from < SHORTEST {
            bridge.from = 0.0;
            bridge.to = bridge.to.max(SHORTEST);
        }
        if bridge.to > length - SHORTEST {
            bridge.to = length;
            bridge.from = if length - bridge.from < SHORTEST { length - SHORTEST } else { bridge.from };
        }
        if bridge.from < SHORTEST {
            bridge.from = 0.0;
        }
    }
    bridges.sort_by(|a, b| a.from.total_cmp(&b.from));
    let mut fitted: Vec<Bridge> = Vec::with_capacity(bridges.len());
    for bridge in bridges.drain(..) {
        match fitted.last_mut().filter(|last| bridge.from - last.to < SHORTEST) {
            Some(last) => {
                last.to = last.to.max(bridge.to);
                last.over.extend(bridge.over);
            }
            None => fitted.push(bridge),
        }
    }
    *bridges = fitted;
}

/// Raises bridges above those that they pass over.
fn settle(bridges: &mut BTreeMap<usize, Vec<Bridge>>) {
    for _ in 1..MOST_LEVELS {
        let level_of = |(street, station): &(usize, f64)| {
            let own = bridges.get(street).into_iter().flatten();
            let there = own.filter(|bridge| (bridge.from..=bridge.to).contains(station));
            there.map(|bridge| bridge.level).max().unwrap_or(0)
        };
        let wanted: Vec<i8> = bridges
            .values()
            .flatten()
            .map(|bridge| 1 + bridge.over.iter().map(level_of).max().unwrap_or(0))
            .collect();
        let levels = bridges.values_mut().flatten().map(|bridge| &mut bridge.level);
        let mut changed = false;
        for (level, wanted) in levels.zip(wanted) {
            changed |= *level != wanted.min(MOST_LEVELS);
            *level = wanted.min(MOST_LEVELS);
        }
        if !changed {
            return;
        }
    }
}

/// A straight piece of a street.
#[derive(Clone, Copy)]
struct Straight {
    piece: usize,
    rank: usize,
    ends: [Point2; 2],
    /// Where it begins on the street, m.
    station: f64,
}

fn cell(point: Point2) -> (i64, i64) {
    ((point.x / CELL).floor() as i64, (point.y / CELL).floor() as i64)
}

/// All crossings away from common nodes, in the order of streets.
fn crossings(pieces: &[Piece<'_>], warnings: &mut Vec<OpenDriveWarning>) -> Vec<Crossing> {
    let mut straights = Vec::new();
    for (piece, found) in pieces.iter().enumerate() {
        let mut station = 0.0;
        for (rank, pair) in found.line.windows(2).enumerate() {
            straights.push(Straight { piece, rank, ends: [pair[0], pair[1]], station });
            station += (pair[1] - pair[0]).norm();
        }
    }
    let mut cells: Vec<((i64, i64), usize)> = Vec::with_capacity(straights.len() * 2);
    let mut is_complete = true;
    for (index, straight) in straights.iter().enumerate() {
        is_complete &= file(straight, index, &mut cells);
    }
    cells.sort_unstable();
    cells.dedup();
    let mut found = Vec::new();
    let mut left = MOST_PAIRS.0 * straights.len() + MOST_PAIRS.1;
    for cell in cells.chunk_by(|a, b| a.0 == b.0) {
        let pairs = cell.len() * (cell.len() - 1) / 2;
        is_complete &= pairs <= left;
        if pairs <= left {
            left -= pairs;
            for (rank, (_, a)) in cell.iter().enumerate() {
                let rest = cell[rank + 1..].iter();
                found.extend(rest.filter_map(|(_, b)| meet(pieces, &straights[*a], &straights[*b])));
            }
        }
    }
    if !is_complete {
        let what = "the roads lie too densely; crossings without a junction were not all found".to_owned();
        warnings.push(OpenDriveWarning { road: None, what });
    }
    let key = |it: &Crossing| it.sides.map(|(piece, _)| piece);
    let order = |a: &Crossing, b: &Crossing| {
        let stations = a.sides[0].1.total_cmp(&b.sides[0].1).then(a.sides[1].1.total_cmp(&b.sides[1].1));
        key(a).cmp(&key(b)).then(stations)
    };
    found.sort_by(order);
    // One at a bend is found from both sides of it, and one at the edge of a cell from both cells.
    let is_same = |a: &Crossing, b: &Crossing| {
        key(a) == key(b) && (0..2).all(|side| (a.sides[side].1 - b.sides[side].1).abs() < 0.1)
    };
    found.dedup_by(|a, b| is_same(a, b));
    found
}

/// Files a straight piece under the cells of the rectangles around its parts; false if it is too long for that.
fn file(straight: &Straight, index: usize, cells: &mut Vec<((i64, i64), usize)>) -> bool {
    let [start, end] = straight.ends;
    let count = ((end - start).norm() / CELL).ceil().max(1.0);
    if count > MOST_CELLS {
        return false;
    }
    for part in 0..count as u32 {
        let place = |part: u32| start + (end - start) * (f64::from(part) / count);
        let (a, b) = (place(part), place(part + 1));
        let (low, high) = (cell(a.inf(&b)), cell(a.sup(&b)));
        for column in low.0..=high.0 {
            cells.extend((low.1..=high.1).map(|row| ((column, row), index)));
        }
    }
    true
}

/// Where two straight pieces cross, if they do away from a node that both streets have.
fn meet(pieces: &[Piece<'_>], a: &Straight, b: &Straight) -> Option<Crossing> {
    let is_own = a.piece == b.piece;
    if is_own && a.rank.abs_diff(b.rank) < 2 {
        return None;
    }
    let (t, u) = polyline::crossing(a.ends[0], a.ends[1], b.ends[0], b.ends[1])?;
    let [first, second] = [a, b].map(|it| it.ends[1] - it.ends[0]);
    let stations = [a.station + t * first.norm(), b.station + u * second.norm()];
    let at = a.ends[0] + first * t;
    let ends = |piece: &Piece<'_>| [piece.line[0], piece.line[piece.line.len() - 1]];
    let is_at_common = (0..2).any(|end| {
        let node = pieces[a.piece].ends[end];
        let is_common = pieces[b.piece].ends.contains(&node);
        is_common && (ends(&pieces[a.piece])[end] - at).norm() < 1.0
    });
    // What is drawn on to a node may lie across others that end there.
    let is_drawn = |it: &Straight, station: f64| {
        let own = pieces[it.piece].own;
        !(own.0..=own.1).contains(&station)
    };
    if is_drawn(a, stations[0]) || is_drawn(b, stations[1]) {
        return None;
    }
    // A loop this small is a kink.
    if is_at_common || (is_own && (stations[0] - stations[1]).abs() < 4.0 * SHORTEST) {
        return None;
    }
    let sine = (first.perp(&second) / (first.norm() * second.norm())).abs();
    Some(Crossing { sides: [(a.piece, stations[0]), (b.piece, stations[1])], sine })
}
