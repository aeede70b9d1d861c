//! Which ways are for walkers alone, split where they meet.

use simworld_core::geometry::Point2;

use crate::osm::place::Place;
use crate::osm::raw::MISSING;
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

/// All ways for walkers that lie on the ground.
pub(super) fn of(place: &Place) -> Vec<Drawn> {
    let ways = place.raw.ways().iter();
    let wanted: Vec<_> = ways.filter_map(|way| Some((way, width_of(&place.raw.way_tags(way))?))).collect();
    if wanted.is_empty() {
        return Vec::new();
    }
    let uses = street::uses(place, wanted.iter().map(|(way, _)| *way));
    let others = others(place);
    let mut drawn = Vec::new();
    for (way, width) in wanted {
        let is_there = |node: &u32| place.point(*node).is_some();
        for run in place.raw.nodes_of(way).chunk_by(|a, b| is_there(a) == is_there(b)) {
            let mut start = 0;
            for index in 1..run.len() {
                if index + 1 < run.len() && uses.get(run[index] as usize).is_none_or(|uses| *uses < 2) {
                    continue;
                }
                let mut path: Vec<Point2> =
                    run[start..=index].iter().filter_map(|node| place.point(*node)).collect();
                path.dedup();
                if path.len() >= 2 {
                    let ends = [run[start], run[index]];
                    let meets = ends.map(|node| others.get(node as usize) == Some(&true));
                    drawn.push(Drawn { path, ends, meets, width });
                }
                start = index;
            }
        }
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
        || tags.is(Key::Area, "yes")
        || tags.has(Key::Indoor)
        || street::level(tags) != 0;
    (!is_left_out).then(|| tags.metres(Key::Width).unwrap_or(*usual).clamp(WIDTHS.0, WIDTHS.1))
}
