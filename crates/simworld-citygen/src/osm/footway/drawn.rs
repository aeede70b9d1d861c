//! Which ways are for walkers alone, split where they meet.

use std::collections::BTreeSet;

use simworld_core::geometry::Point2;

use super::area::{self, Area};
use super::passed;
use super::square::Square;
use crate::osm::error::Warning;
use crate::osm::place::Place;
use crate::osm::raw::{MISSING, Way};
use crate::osm::street;
use crate::osm::tags::{Key, Tags};

/// Values of `highway` on which only people walk, and their width where tags say nothing, m. Two walkers pass on 2 m (Manual
/// for Streets 2007, 6.3.22), a fire engine on 3.7 m (6.7.2), and trails are as wide as those of the open country.
const KINDS: [(&str, f64); 4] = [("footway", 2.0), ("path", 1.5), ("pedestrian", 3.7), ("steps", 2.0)];
/// Narrowest and widest way, m.
const WIDTHS: (f64, f64) = (0.8, 12.0);

/// So often a way counts at its end where no other meets it.
const ITS_OWN: u8 = 2;

/// A piece of a way between two places where it may meet others.
pub(super) struct Drawn {
    /// The number of its way.
    pub(super) way: i64,
    /// At least two points, m.
    pub(super) path: Vec<Point2>,
    /// The nodes at its ends.
    pub(super) ends: [u32; 2],
    /// Where the map joins its ends to something else than ways for walkers: the level of the street, of its sidewalk or of
    /// its crossing.
    pub(super) meets: [Option<i8>; 2],
    /// Whether its ends lie where a way that is built over begins, ends or goes on.
    pub(super) gates: [bool; 2],
    pub(super) walk: Walk,
    /// The number of the square that it crosses.
    pub(super) square: Option<usize>,
}

/// What a way for walkers alone is like.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Walk {
    /// Width, m.
    pub(super) width: f64,
    /// Above or below the ground.
    pub(super) level: i8,
    /// Whether something is built over it.
    pub(super) is_covered: bool,
    /// Whether it is a flight of steps.
    pub(super) is_steps: bool,
}

/// A way that is a line.
pub(super) type Line<'a> = (&'a Way, Walk);

/// All ways for walkers, those on which they cross squares, and these squares.
pub(super) fn of(place: &Place, warnings: &mut Vec<Warning>) -> (Vec<Drawn>, Vec<Square>) {
    let wanted = place.raw.ways().iter().filter_map(|way| {
        let tags = place.raw.way_tags(way);
        Some((way, walk_of(&tags)?, tags.is(Key::Area, "yes")))
    });
    let (areas, lines): (Vec<_>, Vec<_>) = wanted.partition(|(.., is_area)| *is_area);
    let areas: Vec<Line<'_>> = areas.into_iter().map(|(way, walk, _)| (way, walk)).collect();
    let areas = area::areas(place, &areas, warnings);
    let (areas, off_ground): (Vec<_>, Vec<_>) = areas.into_iter().partition(|area| area.walk.level == 0);
    let lines: Vec<Line<'_>> = lines.into_iter().map(|(way, walk, _)| (way, walk)).collect();
    let passed = passed::of(place, &lines, &areas, warnings);
    let covered = lines.iter().filter(|(_, walk)| walk.is_covered);
    let mut met = Met {
        lines: street::uses(place, lines.iter().map(|(way, _)| *way)),
        others: others(place),
        gates: covered.flat_map(|(way, _)| place.raw.nodes_of(way)).copied().collect(),
    };
    // Nobody crosses a square above the ground: what comes to it ends there.
    for area in &off_ground {
        met.pass(&area.edge, area.walk.level);
    }
    met.part(&passed);
    let (mut drawn, squares) = across(place, &areas, &mut met);
    met.part(&passed);
    for (way, walk) in lines {
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
                    drawn.push(met.drawn(way.id, path, [run[start], run[index]], walk));
                }
                start = index;
            }
        }
    }
    (drawn, squares)
}

/// What meets each node.
struct Met {
    /// How often ways for walkers alone pass it; their ends and edges of squares count twice, so that two and more is where
    /// they are split.
    lines: Vec<u8>,
    /// The level of a way of traffic that is none for walkers alone.
    others: Vec<Option<i8>>,
    /// Nodes of ways that are built over.
    gates: BTreeSet<u32>,
}

impl Met {
    /// Nothing is split where ways pass each other without meeting.
    fn part(&mut self, passed: &BTreeSet<u32>) {
        for node in passed {
            self.lines[*node as usize] = 0;
        }
    }

    /// What is no way for walkers after all passes some nodes.
    fn pass(&mut self, nodes: &[u32], level: i8) {
        for node in nodes.iter().filter(|node| **node != MISSING) {
            put_other(&mut self.others, *node, level);
        }
    }

    fn drawn(&self, way: i64, path: Vec<Point2>, ends: [u32; 2], walk: Walk) -> Drawn {
        // A bridge, a subway or a passage that ends by itself opens on what lies before it.
        let opens = |node: u32| {
            (walk.level != 0 || walk.is_covered) && self.lines.get(node as usize) == Some(&ITS_OWN)
        };
        let meets = ends.map(|node| {
            let other = self.others.get(node as usize).copied().flatten();
            other.or_else(|| opens(node).then_some(0))
        });
        let gates = ends.map(|node| self.gates.contains(&node));
        Drawn { way, path, ends, meets, gates, walk, square: None }
    }
}

/// The lines across squares, between the places where other ways meet their edges, and the squares.
fn across(place: &Place, areas: &[Area], met: &mut Met) -> (Vec<Drawn>, Vec<Square>) {
    let mut edges = vec![0_u8; met.lines.len()];
    let mut squares = Vec::new();
    for area in areas {
        match Square::of(place, area) {
            Some(square) => squares.push((square, area.id, area.walk)),
            None => met.pass(&area.edge, area.walk.level),
        }
    }
    for node in squares.iter().flat_map(|(square, ..)| &square.nodes).filter(|node| **node != MISSING) {
        let count = &mut edges[*node as usize];
        *count = count.saturating_add(1);
    }
    let mut drawn = Vec::new();
    for (number, (square, way, walk)) in squares.iter().enumerate() {
        let is_entrance = |node: u32| {
            let node = node as usize;
            met.lines[node] > 0 || met.others[node].is_some() || edges[node] > 1
        };
        let lines = square.lines(is_entrance);
        if lines.is_empty() {
            // Who comes to it goes on beside it.
            met.pass(&square.nodes, walk.level);
        }
        for line in lines {
            let (path, ends) = (line.map(|end| square.corner(end)), line.map(|end| square.nodes[end]));
            if path[0] != path[1] {
                drawn.push(Drawn { square: Some(number), ..met.drawn(*way, path.to_vec(), ends, *walk) });
            }
        }
    }
    for (lines, _) in met.lines.iter_mut().zip(edges).filter(|(_, edges)| *edges > 0) {
        *lines = lines.saturating_add(2);
    }
    (drawn, squares.into_iter().map(|(square, ..)| square).collect())
}

/// For each node the level of a way of traffic that is none for walkers alone, if one passes it.
fn others(place: &Place) -> Vec<Option<i8>> {
    let mut met = vec![None; place.raw.node_count()];
    for way in place.raw.ways() {
        let tags = place.raw.way_tags(way);
        if tags.get(Key::Highway).is_some() && walk_of(&tags).is_none() {
            for node in place.raw.nodes_of(way).iter().filter(|node| **node != MISSING) {
                put_other(&mut met, *node, street::level(&tags));
            }
        }
    }
    met
}

/// Of several ways at a node the one nearest to the ground says its level.
fn put_other(others: &mut [Option<i8>], node: u32, level: i8) {
    let known = &mut others[node as usize];
    if known.is_none_or(|known| known.abs() > level.abs()) {
        *known = Some(level);
    }
}

impl Walk {
    /// What a square is like that is said to be nothing else; none if nobody may enter.
    pub(super) fn of_square(tags: &Tags<'_>) -> Option<Self> {
        walk_as("pedestrian", tags)
    }
}

/// What a way for walkers alone is like; none of other ways.
pub(super) fn walk_of(tags: &Tags<'_>) -> Option<Walk> {
    walk_as(tags.get(Key::Highway)?, tags)
}

fn walk_as(highway: &str, tags: &Tags<'_>) -> Option<Walk> {
    /// What the streets have by themselves: <https://wiki.openstreetmap.org/wiki/Key:footway>.
    const OF_STREETS: [&str; 3] = ["sidewalk", "crossing", "traffic_island"];
    const CLOSED: [&str; 2] = ["no", "private"];
    let (_, usual) = KINDS.iter().find(|(value, _)| *value == highway)?;
    let access = tags.get(Key::Foot).or_else(|| tags.get(Key::Access));
    let is_left_out = tags.is_any(Key::Footway, &OF_STREETS)
        || access.is_some_and(|access| CLOSED.contains(&access))
        || tags.has(Key::Indoor);
    let width = tags.metres(Key::Width).unwrap_or(*usual).clamp(WIDTHS.0, WIDTHS.1);
    let is_covered = tags.has(Key::Covered) || tags.is(Key::Tunnel, "building_passage");
    let (level, is_steps) = (street::level(tags), highway == "steps");
    (!is_left_out).then_some(Walk { width, level, is_covered, is_steps })
}
