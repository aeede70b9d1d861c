//! Streets that are written by hand: polylines to a plan. They meet at points that they have in common, and nowhere else.

use std::collections::BTreeMap;

use simworld_core::geometry::Point2;
use simworld_core::net::{
    CrossSection, LANE_WIDTH, NetworkError, RoadClass, SIDEWALK_WIDTH, Street, StreetPlan, polyline,
};

use super::check::{FARTHEST, number, text};
use super::error::{Fault, Problems, Where};
use super::items::shortened;
use super::numbers::Pair;
use super::rows::StreetRow;
use super::scene::SceneFile;

/// Streets of a file at the most, and points of all of them together.
pub const MOST_STREETS: u64 = 200;
/// Points of all streets of a file together, at the most.
pub const MOST_POINTS: u64 = 2000;
/// Points of a street are so far from each other, and streets that do not meet, m.
const APART: f64 = 1.0;

/// A point to the centimetre: nearer ones are one.
type Key = (i64, i64);

fn key(point: Point2) -> Key {
    ((point.x * 100.0).round() as i64, (point.y * 100.0).round() as i64)
}

/// A straight piece of a street.
struct Piece {
    row: usize,
    ends: [Point2; 2],
}

/// The plan of the streets of a file; none if it has none, or if something is wrong with them, which is told.
pub(super) fn plan(scene: &SceneFile, problems: &mut Problems) -> Option<StreetPlan> {
    let count = scene.streets.len() as u64;
    let points: u64 = scene.streets.iter().map(|row| row.points.len() as u64).sum();
    let before = problems.count();
    for (what, count, most) in
        [("rows of [[street]]", count, MOST_STREETS), ("points of streets", points, MOST_POINTS)]
    {
        if count > most {
            problems.push(scene.place_of(None, ""), Fault::TooMany { what, count, most });
            return None;
        }
    }
    for (index, row) in scene.streets.iter().enumerate() {
        for fault in of_row(row) {
            problems.push(at(scene, index), fault);
        }
    }
    if count == 0 || problems.count() > before {
        return None;
    }
    touching(scene, problems);
    let (plan, rows) = joined(scene);
    if problems.count() == before {
        match plan.validate() {
            Ok(()) => return Some(plan),
            Err(NetworkError::Street { street, reason }) => {
                problems.push(at(scene, rows[street]), Fault::Street(reason));
            }
            Err(other) => problems.push(scene.place_of(None, "[[street]]"), Fault::Street(other.to_string())),
        }
    }
    None
}

/// Where a row of a street is.
pub(super) fn at(scene: &SceneFile, index: usize) -> Where {
    scene.place_of(scene.streets[index].line.0, label(scene, index))
}

fn label(scene: &SceneFile, index: usize) -> String {
    let name = scene.streets[index].name.as_deref().map(|name| format!(" ({:?})", shortened(name)));
    format!("[[street]] {}{}", index + 1, name.unwrap_or_default())
}

fn of_row(row: &StreetRow) -> Vec<Fault> {
    let mut faults: Vec<Fault> = Vec::new();
    faults.extend(row.name.as_deref().and_then(|name| text("name", name, 100)));
    if row.points.len() < 2 {
        faults.push(Fault::Keys("a street has at least two points: write points = [[x, y], [x, y]]"));
    }
    for point in &row.points {
        let allowed = "metres within ±100 000";
        faults.extend(number("points, east", point.x, (-FARTHEST, FARTHEST), allowed));
        faults.extend(number("points, north", point.y, (-FARTHEST, FARTHEST), allowed));
    }
    let is_near = |pair: &[Pair]| (pair[1].point() - pair[0].point()).norm() < APART;
    if row.points.windows(2).any(is_near) {
        faults.push(Fault::Keys("two points of the street are less than a metre apart: leave one out"));
    }
    if let Some(lanes) = row.lanes {
        faults.extend(number("lanes", f64::from(lanes), (1.0, 4.0), "1 to 4, each way"));
    }
    if let Some(sidewalk) = row.sidewalk.filter(|width| *width != 0.0) {
        faults.extend(number("sidewalk", sidewalk, (1.0, 20.0), "1 to 20 m, or 0 for none"));
    }
    faults
}

/// Tells of streets that touch, or run along each other, where they have no point in common.
fn touching(scene: &SceneFile, problems: &mut Problems) {
    let rows = scene.streets.iter().enumerate();
    let pieces: Vec<Piece> = rows
        .flat_map(|(row, street)| {
            street.points.windows(2).map(move |pair| Piece { row, ends: [pair[0].point(), pair[1].point()] })
        })
        .collect();
    for (index, later) in pieces.iter().enumerate() {
        for earlier in &pieces[..index] {
            if let Some(point) = contact(earlier, later) {
                let other = label(scene, earlier.row);
                let fault = Fault::Touches { other, x: point.x, y: point.y };
                problems.push(at(scene, later.row), fault);
            }
        }
    }
}

/// Where two pieces are nearer to each other than they may be, but for an end that they have in common.
fn contact(one: &Piece, other: &Piece) -> Option<Point2> {
    let ([a, b], [c, d]) = (one.ends, other.ends);
    let (low, high) = (a.inf(&b), a.sup(&b));
    let (from, to) = (c.inf(&d), c.sup(&d));
    let is_far = |low: f64, high: f64, from: f64, to: f64| from > high + APART || to < low - APART;
    if is_far(low.x, high.x, from.x, to.x) || is_far(low.y, high.y, from.y, to.y) {
        return None;
    }
    let shared = |point: &Point2, of: &[Point2; 2]| of.iter().any(|end| key(*end) == key(*point));
    let has_joint = shared(&a, &other.ends) || shared(&b, &other.ends);
    if !has_joint && let Some((share, _)) = polyline::crossing(a, b, c, d) {
        return Some(a + (b - a) * share);
    }
    // An end that lies on the other without being an end of it.
    let stray = |ends: [Point2; 2], of: &[Point2; 2]| {
        ends.into_iter().find(|end| {
            let near = polyline::closest(of, end);
            !shared(end, of) && near.is_some_and(|near| near.distance < APART)
        })
    };
    stray(other.ends, &one.ends).or_else(|| stray(one.ends, &other.ends))
}

/// The streets as a plan, cut where they have points in common, and the row of each of its streets.
fn joined(scene: &SceneFile) -> (StreetPlan, Vec<usize>) {
    let mut visits: BTreeMap<Key, u32> = BTreeMap::new();
    for row in &scene.streets {
        for (index, point) in row.points.iter().enumerate() {
            // An end is a node whoever else comes there.
            let is_end = index == 0 || index + 1 == row.points.len();
            *visits.entry(key(point.point())).or_default() += if is_end { 2 } else { 1 };
        }
    }
    let (mut plan, mut rows) = (StreetPlan::default(), Vec::new());
    let mut nodes: BTreeMap<Key, usize> = BTreeMap::new();
    for (index, row) in scene.streets.iter().enumerate() {
        let lanes = row.lanes.unwrap_or(1) as u8;
        let section = CrossSection::plain(lanes, lanes, LANE_WIDTH, row.sidewalk.unwrap_or(SIDEWALK_WIDTH));
        let section = plan.add_section(section);
        let name = row.name.as_deref().map(|name| plan.add_name(name));
        let class = if lanes > 1 { RoadClass::Arterial } else { RoadClass::Local };
        let mut from: Option<usize> = None;
        let mut via: Vec<Point2> = Vec::new();
        for point in row.points.iter().map(|pair| pair.point()) {
            if visits[&key(point)] < 2 {
                via.push(point);
                continue;
            }
            let node = *nodes.entry(key(point)).or_insert_with(|| {
                plan.nodes.push(point);
                plan.nodes.len() - 1
            });
            if let Some(from) = from {
                let via = std::mem::take(&mut via);
                plan.streets.push(Street { via, section, name, class, ..Street::simple(from, node) });
                rows.push(index);
            }
            from = Some(node);
        }
    }
    (plan, rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(streets: &[&[(f64, f64)]]) -> SceneFile {
        let row = |points: &&[(f64, f64)]| StreetRow::new(points.iter().map(|(x, y)| Pair::new(*x, *y)));
        SceneFile { streets: streets.iter().map(row).collect(), ..SceneFile::default() }
    }

    fn told(streets: &[&[(f64, f64)]]) -> String {
        let mut problems = Problems::default();
        assert_eq!(plan(&scene(streets), &mut problems), None, "{streets:?}");
        problems.to_string()
    }

    #[test]
    fn streets_are_cut_where_they_have_a_point_in_common() {
        let mut problems = Problems::default();
        let through: &[(f64, f64)] = &[(-80.0, 0.0), (0.0, 0.0), (40.0, 5.0), (80.0, 0.0)];
        let branch: &[(f64, f64)] = &[(0.0, 0.0), (0.0, 60.0)];
        let plan = plan(&scene(&[through, branch]), &mut problems).expect("it is sound");
        assert!(problems.is_empty(), "{problems}");
        assert_eq!((plan.nodes.len(), plan.streets.len()), (4, 3));
        let bends: Vec<usize> = plan.streets.iter().map(|street| street.via.len()).collect();
        assert_eq!(bends, [0, 1, 0]);
    }

    #[test]
    fn streets_that_touch_without_a_point_there_are_told_of_with_the_place() {
        let across: &[(f64, f64)] = &[(-80.0, 0.0), (80.0, 0.0)];
        let others: [(&[(f64, f64)], &str); 3] = [
            (&[(10.0, -50.0), (10.0, 50.0)], "(10.00, 0.00)"),
            (&[(10.0, 0.5), (10.0, 50.0)], "(10.00, 0.50)"),
            (&[(-80.0, 0.0), (40.0, 0.2)], "(40.00, 0.20)"),
        ];
        for (other, place) in others {
            let told = told(&[across, other]);
            assert!(told.contains("[[street]] 2: it meets [[street]] 1 at"), "{told}");
            assert!(told.contains(place), "{told}");
        }
    }

    #[test]
    fn what_cannot_be_built_is_told_of_with_its_row() {
        assert!(told(&[&[(0.0, 0.0)]]).contains("at least two points"));
        assert!(told(&[&[(0.0, 0.0), (0.2, 0.0), (90.0, 0.0)]]).contains("less than a metre apart"));
        assert!(told(&[&[(0.0, 0.0), (9.0, 0.0)]]).contains("[[street]] 1: the street is 9.0 m long"));
        assert!(told(&[&[(f64::NAN, 0.0), (9.0, 1e300)]]).contains("points, east = NaN"));
        let ring: &[(f64, f64)] = &[(0.0, 0.0), (90.0, 0.0), (90.0, 90.0), (0.0, 0.0)];
        assert!(told(&[ring]).contains("put a node on the loop"));
    }
}
