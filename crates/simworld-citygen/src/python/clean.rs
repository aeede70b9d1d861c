//! From loose pieces of road to a sound plan: ends that nearly meet are joined, roads that cross are split, what is too
//! short is merged away, and only the largest connected part is kept.

use std::collections::BTreeMap;

use petgraph::unionfind::UnionFind;
use simworld_core::geometry::Point2;
use simworld_core::net::{RoadClass, Street, StreetPlan, polyline};

use super::{FormatError, RoadsFile, Warning};

/// Ends nearer than this are one node, m: two junctions this close would have no street between them.
pub(super) const MERGE: f64 = 20.0;
/// A coordinate beyond this is no place in a city, m.
const FARTHEST: f64 = 1e6;
/// Width of a cell of the search grid, m.
const CELL: f64 = 250.0;

/// More roads are not read.
const MOST_ROADS: u64 = 1_000_000;
/// More road than this is not read, m: the search grid takes memory by length.
const MOST_LENGTH: u64 = 1_000_000_000;
/// Pairs of roads that are compared at most, a road and in all; towns need about 150 a road.
const MOST_PAIRS: (u64, u64) = (400, 10_000_000);

/// A straight piece between two nodes.
#[derive(Clone, Copy)]
struct Piece {
    from: usize,
    to: usize,
    highway: bool,
    /// The road of the file it comes from.
    road: usize,
}

/// Makes a plan of the roads of a file.
///
/// # Errors
/// A coordinate out of range, more road than can be checked, or no usable road.
pub fn plan_from_roads(file: &RoadsFile) -> Result<(StreetPlan, Vec<Warning>), FormatError> {
    at_most("number of roads", file.roads.len() as u64, MOST_ROADS)?;
    let mut warnings = Vec::new();
    let mut nodes = Nodes::default();
    let mut pieces = Vec::new();
    for (road, record) in file.roads.iter().enumerate() {
        let coordinates = [
            ("start.x", record.start.x),
            ("start.y", record.start.y),
            ("end.x", record.end.x),
            ("end.y", record.end.y),
        ];
        for (field, value) in coordinates {
            if value.is_nan() || value.abs() > FARTHEST {
                return Err(FormatError::Coordinate { path: format!("roads[{road}].{field}"), value });
            }
        }
        let (from, to) = (nodes.at(record.start.into()), nodes.at(record.end.into()));
        if from == to {
            warnings.push(Warning { road: Some(road), message: format!("left out: shorter than {MERGE} m") });
        } else {
            pieces.push(Piece { from, to, highway: record.is_highway, road });
        }
    }
    // Doubles go first, or a million copies of one road would be compared with one another.
    let pieces = drop_doubles(pieces, &mut warnings);
    let length: f64 = pieces.iter().map(|p| (nodes.points[p.to] - nodes.points[p.from]).norm()).sum();
    at_most("length in metres", length as u64, MOST_LENGTH)?;
    let pieces = split_at_meetings(&mut nodes, pieces, &mut warnings)?;
    let pieces = drop_doubles(pieces, &mut warnings);
    let pieces = keep_largest_part(nodes.points.len(), pieces, &mut warnings);
    if pieces.is_empty() {
        return Err(FormatError::Empty { least: MERGE });
    }
    Ok((plan(&nodes.points, &pieces), warnings))
}

fn at_most(what: &'static str, amount: u64, limit: u64) -> Result<(), FormatError> {
    if amount <= limit { Ok(()) } else { Err(FormatError::TooMuch { what, amount, limit }) }
}

/// Points, merged with those nearer than [`MERGE`].
#[derive(Default)]
struct Nodes {
    points: Vec<Point2>,
    cells: BTreeMap<(i64, i64), Vec<usize>>,
}

impl Nodes {
    fn at(&mut self, point: Point2) -> usize {
        let cell = |x: f64| (x / MERGE).floor() as i64;
        let (column, row) = (cell(point.x), cell(point.y));
        let around = (column - 1..=column + 1).flat_map(|c| (row - 1..=row + 1).map(move |r| (c, r)));
        let near = around.filter_map(|cell| self.cells.get(&cell)).flatten().copied();
        let distance = |node: &usize| (self.points[*node] - point).norm();
        let nearest = near.min_by(|a, b| distance(a).total_cmp(&distance(b)).then(a.cmp(b)));
        if let Some(node) = nearest.filter(|node| distance(node) < MERGE) {
            return node;
        }
        self.points.push(point);
        self.cells.entry((column, row)).or_default().push(self.points.len() - 1);
        self.points.len() - 1
    }
}

/// The pieces whose boxes share a grid cell with a piece, ascending.
struct PieceGrid {
    cells: BTreeMap<(i64, i64), Vec<usize>>,
}

fn piece_cells(a: Point2, b: Point2) -> impl Iterator<Item = (i64, i64)> {
    // Long roads are walked in steps, so that a diagonal does not fill its whole box.
    let steps = ((b - a).norm() / CELL).ceil().max(1.0) as u64;
    let index = |x: f64| (x / CELL).floor() as i64;
    (0..steps).flat_map(move |step| {
        let (p, q) =
            (a + (b - a) * (step as f64 / steps as f64), a + (b - a) * ((step + 1) as f64 / steps as f64));
        let columns = index(p.x.min(q.x) - MERGE)..=index(p.x.max(q.x) + MERGE);
        let rows = (index(p.y.min(q.y) - MERGE), index(p.y.max(q.y) + MERGE));
        columns.flat_map(move |column| (rows.0..=rows.1).map(move |row| (column, row)))
    })
}

impl PieceGrid {
    fn new(points: &[Point2], pieces: &[Piece]) -> Self {
        let mut cells: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
        for (index, piece) in pieces.iter().enumerate() {
            for cell in piece_cells(points[piece.from], points[piece.to]) {
                let entries = cells.entry(cell).or_default();
                if entries.last() != Some(&index) {
                    entries.push(index);
                }
            }
        }
        Self { cells }
    }

    fn near(&self, a: Point2, b: Point2) -> Vec<usize> {
        let mut found: Vec<usize> =
            piece_cells(a, b).filter_map(|cell| self.cells.get(&cell)).flatten().copied().collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

/// Splits pieces where they cross and where the end of one touches the middle of another.
fn split_at_meetings(
    nodes: &mut Nodes,
    pieces: Vec<Piece>,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Piece>, FormatError> {
    let mut cuts: Vec<Vec<(f64, usize)>> = vec![Vec::new(); pieces.len()];
    let grid = PieceGrid::new(&nodes.points, &pieces);
    let mut compared = 0;
    for (index, piece) in pieces.iter().enumerate() {
        let (a, b) = (nodes.points[piece.from], nodes.points[piece.to]);
        let near = grid.near(a, b);
        compared += near.len() as u64;
        at_most("pairs to compare", compared, pieces.len() as u64 * MOST_PAIRS.0 + MOST_PAIRS.1)?;
        for other in near {
            let rival = pieces[other];
            let (c, d) = (nodes.points[rival.from], nodes.points[rival.to]);
            for (node, point) in [(rival.from, c), (rival.to, d)] {
                let ends = node == piece.from || node == piece.to;
                if let Some(near) =
                    polyline::closest(&[a, b], &point).filter(|near| !ends && near.distance < MERGE)
                {
                    cuts[index].push((near.station, node));
                }
            }
            if other > index
                && let Some((share, rival_share)) = polyline::crossing(a, b, c, d)
            {
                let node = nodes.at(a + (b - a) * share);
                cuts[index].push((share * (b - a).norm(), node));
                cuts[other].push((rival_share * (d - c).norm(), node));
            }
        }
    }
    let mut split = Vec::new();
    for (piece, mut cuts) in pieces.into_iter().zip(cuts) {
        cuts.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        cuts.retain(|(_, node)| *node != piece.from && *node != piece.to);
        if !cuts.is_empty() {
            let message = format!("split at {} meetings with other roads", cuts.len());
            warnings.push(Warning { road: Some(piece.road), message });
        }
        let mut from = piece.from;
        for to in cuts.into_iter().map(|(_, node)| node).chain([piece.to]) {
            if to != from {
                split.push(Piece { from, to, ..piece });
            }
            from = to;
        }
    }
    Ok(split)
}

/// One street between any two nodes.
fn drop_doubles(mut pieces: Vec<Piece>, warnings: &mut Vec<Warning>) -> Vec<Piece> {
    let ends = |piece: &Piece| (piece.from.min(piece.to), piece.from.max(piece.to));
    pieces.sort_by_key(|piece| (ends(piece), !piece.highway, piece.road));
    let mut kept: Vec<Piece> = Vec::with_capacity(pieces.len());
    for piece in pieces {
        match kept.last() {
            Some(last) if ends(last) == ends(&piece) => {
                if last.road != piece.road {
                    let message = format!("left out in part: it runs along roads[{}]", last.road);
                    warnings.push(Warning { road: Some(piece.road), message });
                }
            }
            _ => kept.push(piece),
        }
    }
    kept
}

fn keep_largest_part(nodes: usize, pieces: Vec<Piece>, warnings: &mut Vec<Warning>) -> Vec<Piece> {
    let mut parts = UnionFind::<usize>::new(nodes);
    for piece in &pieces {
        parts.union(piece.from, piece.to);
    }
    let labels = parts.into_labeling();
    let mut sizes: BTreeMap<usize, usize> = BTreeMap::new();
    for piece in &pieces {
        *sizes.entry(labels[piece.from]).or_default() += 1;
    }
    // Of equal parts the one with the lowest label.
    let Some(largest) = sizes.iter().max_by(|a, b| a.1.cmp(b.1).then(b.0.cmp(a.0))).map(|(label, _)| *label)
    else {
        return pieces;
    };
    let before = pieces.len();
    let kept: Vec<Piece> = pieces.into_iter().filter(|piece| labels[piece.from] == largest).collect();
    if kept.len() < before {
        let message = format!(
            "{} roads are not connected with the other {} and were left out",
            before - kept.len(),
            kept.len()
        );
        warnings.push(Warning { road: None, message });
    }
    kept
}

/// The nodes in use, numbered anew, and a street for each piece.
fn plan(points: &[Point2], pieces: &[Piece]) -> StreetPlan {
    let mut plan = StreetPlan::default();
    let mut numbers: BTreeMap<usize, usize> = BTreeMap::new();
    for piece in pieces {
        let ends = [piece.from, piece.to].map(|node| {
            *numbers.entry(node).or_insert_with(|| {
                plan.nodes.push(points[node]);
                plan.nodes.len() - 1
            })
        });
        let class = if piece.highway { RoadClass::Arterial } else { RoadClass::Local };
        plan.streets.push(Street { class, ..Street::simple(ends[0], ends[1]) });
    }
    plan
}
