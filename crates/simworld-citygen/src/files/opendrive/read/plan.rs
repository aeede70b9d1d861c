//! From roads that hang together to a plan of streets.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Matrix2, Vector2};
use simworld_core::geometry::Point2;
use simworld_core::net::{Control, DrivingSide, SHORTEST_STREET, Street, StreetPlan, polyline};

use super::document::Road;
use super::error::OpenDriveWarning;
use super::lanes::Leads;
use super::pieces::{Gathered, Piece};
use super::ways::{self, Tip};
use super::web::{Place, Web};
use super::{heights, over};
use crate::simplify::simplified;

/// The shortest street that stays, m; a little more than a plan asks for, against rounding.
const SHORTEST: f64 = SHORTEST_STREET + 0.5;
/// How far a street may be from the line that was given, m.
const TOLERANCE: f64 = 0.2;
/// The weight of the middle of all ends beside that of their lines.
const MIDDLE: f64 = 0.001;
/// How far beyond its ends a junction may lie, m.
const BEYOND: f64 = 5.0;
/// Streets at one node.
const MOST_STREETS: usize = 24;
/// Heights below this are none, m.
const FLAT: f64 = 0.01;

/// Draws places together until no road between two of them is too short for a street; too short dead ends go.
pub(super) fn collapse(web: &mut Web, warnings: &mut Vec<OpenDriveWarning>) {
    loop {
        let points = points(web);
        let mut short: Vec<(f64, usize)> = web
            .living()
            .map(|(index, road, ends)| (polyline::length(&course(road, ends, &points)), index))
            .filter(|(length, _)| *length < SHORTEST)
            .collect();
        if short.is_empty() {
            return;
        }
        short.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (_, index) in short {
            let Some((_, [a, b])) = web.roads[index] else { continue };
            let degrees = [a, b].map(|place| web.places[place].members.len());
            let Some(road) = web.remove(index) else { continue };
            if a == b || degrees.contains(&1) {
                warnings.push(OpenDriveWarning::of(&road.id, "is too short for a street; left out"));
            } else {
                let what = "is too short for a street; its ends became one junction";
                warnings.push(OpenDriveWarning::of(&road.id, what));
                web.merge(b, a);
                // Those beside it have moved: they are measured anew.
                break;
            }
        }
    }
}

/// Where each place lies: as near as can be to the lines of all roads that end there.
fn points(web: &Web) -> Vec<Point2> {
    web.places.iter().map(|place| point(web, place)).collect()
}

fn point(web: &Web, place: &Place) -> Point2 {
    let ends: Vec<(Point2, Vector2<f64>)> = place
        .members
        .iter()
        .filter_map(|(road, end)| {
            let (Road { line, .. }, _) = web.roads[*road].as_ref()?;
            let last = line.len() - 1;
            let (at, next) = if *end == 0 { (line[0], line[1]) } else { (line[last], line[last - 1]) };
            Some((at, (next - at).try_normalize(1e-9)?))
        })
        .collect();
    let count = ends.len().max(1) as f64;
    let middle = Point2::from(ends.iter().fold(Vector2::zeros(), |sum, (at, _)| sum + at.coords) / count);
    if ends.len() < 2 {
        return middle;
    }
    // Least squares of the distances from the lines, about the middle.
    let mut matrix = Matrix2::identity() * (MIDDLE * count);
    let mut sum = Vector2::zeros();
    for (at, along) in &ends {
        let across = Matrix2::identity() - along * along.transpose();
        matrix += across;
        sum += across * (at - middle);
    }
    let offset = matrix.try_inverse().map_or_else(Vector2::zeros, |inverse| inverse * sum);
    let reach = ends.iter().map(|(at, _)| (at - middle).norm()).fold(0.0, f64::max);
    if offset.norm() <= reach + BEYOND { middle + offset } else { middle }
}

/// The points of a road from place to place.
fn course(road: &Road, ends: [usize; 2], points: &[Point2]) -> Vec<Point2> {
    let [start, end] = ends.map(|place| points[place]);
    let mut line = Vec::with_capacity(road.line.len() + 2);
    line.push(start);
    line.extend(
        road.line.iter().filter(|point| (*point - start).norm() > 0.01 && (*point - end).norm() > 0.01),
    );
    line.push(end);
    simplified(&line, TOLERANCE)
}

/// The plan of all roads.
pub(super) fn plan(
    web: &Web,
    keeps_left: bool,
    leads: &Leads,
    warnings: &mut Vec<OpenDriveWarning>,
) -> StreetPlan {
    let mut gathered = Gathered {
        points: points(web),
        heights: web.places.iter().map(|place| height(web, place)).collect(),
        pieces: Vec::new(),
        joined: BTreeSet::new(),
        degrees: vec![0; web.places.len()],
    };
    for (_, road, ends) in web.living() {
        if let Err(what) = gathered.add(road, ends) {
            warnings.push(OpenDriveWarning::of(&road.id, what));
        }
    }
    over::part_levels(&mut gathered, warnings);
    let mut plan = emit(&gathered, web);
    plan.driving_side = if keeps_left { DrivingSide::Left } else { DrivingSide::Right };
    ways::set(&mut plan, &tips(&gathered.pieces), leads, warnings);
    plan
}

impl<'a> Gathered<'a> {
    /// Adds the street of a road, or says why there is none.
    fn add(&mut self, road: &'a Road, ends: [usize; 2]) -> Result<(), &'static str> {
        let line = course(road, ends, &self.points);
        let length = polyline::length(&line);
        // Nodes are put on loops and on the second street between the same places.
        let parts = if ends[0] == ends[1] { 3 } else { 1 + u32::from(self.joined.contains(&pair(ends))) };
        if length < f64::from(parts) * SHORTEST {
            return Err("joins junctions that are joined already; left out");
        }
        if ends.iter().any(|end| self.degrees[*end] >= MOST_STREETS) {
            return Err("ends at a junction of more streets than there can be; left out");
        }
        for end in ends {
            self.degrees[end] += 1;
        }
        self.joined.insert(pair(ends));
        let heights =
            heights::on_the_way(&road.heights, (&road.line, &line), ends.map(|end| self.heights[end]));
        let gap = |end: usize| {
            let own = if end == 0 { road.line.first() } else { road.line.last() };
            own.map_or(0.0, |own| (own - self.points[ends[end]]).norm())
        };
        let own = (gap(0), length - gap(1));
        let piece = Piece { ends, line, heights, own, level: 0, road, tips: [true; 2] };
        let stations: Vec<f64> = (1..parts).map(|part| length * f64::from(part) / f64::from(parts)).collect();
        let cut = self.cut(piece, &stations);
        self.pieces.extend(cut);
        Ok(())
    }
}

/// The ends of the roads that became streets.
fn tips<'a>(pieces: &[Piece<'a>]) -> Vec<Tip<'a>> {
    let numbered = pieces.iter().enumerate();
    let ends = numbered.flat_map(|(street, piece)| {
        let ends = (0..2).filter(|end| piece.tips[*end]);
        let tip = move |end: usize| Tip {
            street,
            at_start: end == 0,
            road: &piece.road.id,
            lanes: &piece.road.lanes[end],
        };
        ends.map(tip)
    });
    ends.collect()
}

fn pair(ends: [usize; 2]) -> [usize; 2] {
    [ends[0].min(ends[1]), ends[0].max(ends[1])]
}

fn height(web: &Web, place: &Place) -> f64 {
    let of = |(road, end): &(usize, usize)| {
        let heights = &web.roads[*road].as_ref()?.0.heights;
        let (_, height) = if *end == 0 { heights.first() } else { heights.last() }?;
        Some(*height)
    };
    let heights: Vec<f64> = place.members.iter().filter_map(of).collect();
    heights.iter().sum::<f64>() / heights.len().max(1) as f64
}

fn emit(gathered: &Gathered<'_>, web: &Web) -> StreetPlan {
    let Gathered { points, heights, pieces, degrees, .. } = gathered;
    let mut plan = StreetPlan { sections: Vec::new(), ..StreetPlan::default() };
    let mut numbers: Vec<Option<usize>> = vec![None; points.len()];
    let mut sections: BTreeMap<String, u32> = BTreeMap::new();
    let mut names: BTreeMap<&str, u32> = BTreeMap::new();
    for Piece { ends, line, road, heights: on_the_way, level, .. } in pieces {
        let line = heights::bent(line, on_the_way);
        let [from, to] = ends.map(|place| {
            *numbers[place].get_or_insert_with(|| {
                plan.nodes.push(points[place]);
                plan.elevations.push(heights[place]);
                plan.nodes.len() - 1
            })
        });
        let section = *sections.entry(format!("{:?}", road.section)).or_insert_with(|| {
            plan.sections.push(road.section.clone());
            plan.sections.len() as u32 - 1
        });
        let name = Some(road.name.as_str()).filter(|name| !name.is_empty());
        let name = name.map(|name| *names.entry(name).or_insert_with(|| plan.add_name(name)));
        plan.streets.push(Street {
            via: line[1..line.len() - 1].to_vec(),
            class: road.class,
            section,
            name,
            speed_limit: road.speed,
            level: *level,
            profile: on_the_way.clone().into(),
            ..Street::simple(from, to)
        });
    }
    for (place, found) in web.places.iter().enumerate().filter(|(place, _)| degrees[*place] >= 3) {
        if let Some(node) = numbers[place] {
            plan.controls.insert(node, if found.has_signals { Control::Signals } else { Control::Priority });
        }
    }
    let is_flat = |street: &Street| street.profile.is_empty();
    if plan.elevations.iter().all(|height| height.abs() < FLAT) && plan.streets.iter().all(is_flat) {
        plan.elevations.clear();
    }
    if plan.sections.is_empty() {
        plan.sections = StreetPlan::default().sections;
    }
    plan
}
