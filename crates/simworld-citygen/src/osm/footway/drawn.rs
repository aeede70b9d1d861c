//! Which ways are for walkers alone, split where they meet.

use simworld_core::geometry::Point2;

use super::square::Square;
use crate::osm::place::Place;
use crate::osm::raw::{MISSING, Way};
use crate::osm::street;
use crate::osm::tags::{Key, Tags};

/// Values of `highway` on which only people walk, and their width where tags say nothing, m. Two walkers pass on 2 m (Manual
/// for Streets 2007, 6.3.22), a fire engine on 3.7 m (6.7.2), and trails are as wide as those of the open country.
const KINDS: [(&str, f64); 4] = [("footway", 2.0), ("path", 1.5), ("pedestrian", 3.7), ("steps", 2.0)];
/// Narrowest and widest way, m.
const WIDTHS: (f64, f64) = (0.8, 12.0);

/// A piece of a way between two places where it may meet others.
pub(super) struct Drawn {
    /// At least two points, m.
    pub(super) path: Vec<Point2>,
    /// The nodes at its ends.
    pub(super) ends: [u32; 2],
    /// Whether the map joins its ends to something else than ways for walkers: a street, its sidewalk or its crossing.
    pub(super) meets: [bool; 2],
    /// Width, m.
    pub(super) width: f64,
}

impl Drawn {
    fn new(path: Vec<Point2>, ends: [u32; 2], width: f64, others: &[bool]) -> Self {
        let meets = ends.map(|node| others.get(node as usize) == Some(&true));
        Self { path, ends, meets, width }
    }
}

/// All ways for walkers that lie on the ground, and those on which they cross squares.
pub(super) fn of(place: &Place) -> Vec<Drawn> {
    let wanted = place.raw.ways().iter().filter_map(|way| {
        let tags = place.raw.way_tags(way);
        Some((way, width_of(&tags)?, tags.is(Key::Area, "yes")))
    });
    let (areas, lines): (Vec<_>, Vec<_>) = wanted.partition(|(.., is_area)| *is_area);
    let mut met =
        Met { lines: street::uses(place, lines.iter().map(|(way, ..)| *way)), others: others(place) };
    let mut drawn = across(place, &areas, &mut met);
    for (way, width, _) in lines {
        let is_there = |node: &u32| place.point(*node).is_some();
        for run in place.raw.nodes_of(way).chunk_by(|a, b| is_there(a) == is_there(b)) {
            let mut start = 0;
            for index in 1..run.len() {
                if index + 1 < run.len() && met.lines.get(run[index] as usize).is_none_or(|uses| *uses < 2) {
                    continue;
                }
                let mut path: Vec<Point2> =
                    run[start..=index].iter().filter_map(|node| place.point(*node)).collect();
                path.dedup();
                if path.len() >= 2 {
                    drawn.push(Drawn::new(path, [run[start], run[index]], width, &met.others));
                }
                start = index;
            }
        }
    }
    drawn
}

/// What meets each node.
struct Met {
    /// How often ways for walkers alone pass it; their ends and edges of squares count twice, so that two and more is where
    /// they are split.
    lines: Vec<u8>,
    /// Whether a way of traffic does that is none for walkers alone.
    others: Vec<bool>,
}

impl Met {
    /// What is no way for walkers after all passes some nodes.
    fn pass(&mut self, nodes: &[u32]) {
        for node in nodes.iter().filter(|node| **node != MISSING) {
            self.others[*node as usize] = true;
        }
    }
}

/// The lines across squares, between the places where other ways meet their edges.
fn across(place: &Place, areas: &[(&Way, f64, bool)], met: &mut Met) -> Vec<Drawn> {
    let mut edges = vec![0_u8; met.lines.len()];
    let mut squares = Vec::new();
    for (way, width, _) in areas {
        match Square::of(place, way) {
            Some(square) => squares.push((square, *width)),
            None => met.pass(place.raw.nodes_of(way)),
        }
    }
    for node in squares.iter().flat_map(|(square, _)| square.nodes) {
        let count = &mut edges[*node as usize];
        *count = count.saturating_add(1);
    }
    let mut drawn = Vec::new();
    for (square, width) in &squares {
        let is_entrance = |node: u32| {
            let node = node as usize;
            met.lines[node] > 0 || met.others[node] || edges[node] > 1
        };
        let lines = square.lines(is_entrance);
        if lines.is_empty() {
            // Who comes to it goes on beside it.
            met.pass(square.nodes);
        }
        for line in lines {
            let (path, ends) = (line.map(|end| square.corner(end)), line.map(|end| square.nodes[end]));
            if path[0] != path[1] {
                drawn.push(Drawn::new(path.to_vec(), ends, *width, &met.others));
            }
        }
    }
    for (lines, _) in met.lines.iter_mut().zip(edges).filter(|(_, edges)| *edges > 0) {
        *lines = lines.saturating_add(2);
    }
    drawn
}

/// The nodes of all ways of traffic that are none for walkers alone.
fn others(place: &Place) -> Vec<bool> {
    let mut met = vec![false; place.raw.node_count()];
    for way in place.raw.ways() {
        let tags = place.raw.way_tags(way);
        if tags.get(Key::Highway).is_some() && width_of(&tags).is_none() {
            for node in place.raw.nodes_of(way).iter().filter(|node| **node != MISSING) {
                met[*node as usize] = true;
            }
        }
    }
    met
}

/// Width of a way for walkers alone that lies on the ground, m; none of other ways.
fn width_of(tags: &Tags<'_>) -> Option<f64> {
    /// What the streets have by themselves: <https://wiki.openstreetmap.org/wiki/Key:footway>.
    const OF_STREETS: [&str; 3] = ["sidewalk", "crossing", "traffic_island"];
    const CLOSED: [&str; 2] = ["no", "private"];
    let highway = tags.get(Key::Highway)?;
    let (_, usual) = KINDS.iter().find(|(value, _)| *value == highway)?;
    let access = tags.get(Key::Foot).or_else(|| tags.get(Key::Access));
    let is_left_out = tags.is_any(Key::Footway, &OF_STREETS)
        || access.is_some_and(|access| CLOSED.contains(&access))
        || tags.has(Key::Indoor)
        || street::level(tags) != 0;
    (!is_left_out).then(|| tags.metres(Key::Width).unwrap_or(*usual).clamp(WIDTHS.0, WIDTHS.1))
}
