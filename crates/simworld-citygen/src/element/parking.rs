//! Cars in parking lanes: one a space, most spaces taken.

use std::f64::consts::PI;

use rayon::prelude::*;
use simworld_core::geometry::{Point2, heading};
use simworld_core::id::RoadId;
use simworld_core::net::polyline::{self, Measured};
use simworld_core::net::{LaneDirection, LaneKind, LaneSpec, Side};
use simworld_core::ops;
use simworld_core::scene::{EntityKind, Shape};
use simworld_core::seed::Stream;

use super::{Element, Setting};
use crate::ElementConfig;
use crate::block::Border;
use crate::key::stream_at;

/// Length of a parking space along the kerb, m.
const SPACE: f64 = 6.0;
/// Distance kept from the ends of the lanes, where crossings and corners must be seen, m.
const CORNER_CLEARANCE: f64 = 6.0;
/// Gap kept to both edges of the lane, half as much in a bend, m.
const EDGE_GAP: f64 = 0.1;
/// The narrowest lane in which cars park along the kerb, m.
const NARROWEST: f64 = 1.8;

/// So many cars park in a street on the average, or fewer.
const CARS: usize = 6;
/// Streets in which one thread parks at once.
const CHUNK: usize = 256;

/// A place for cars in a cross-section: how far its middle lies to the left of the centreline, m, and what it is.
type Bay = (f64, LaneSpec);

/// Parks cars in every parking lane; those of some streets together.
pub(super) fn park(setting: &Setting<'_>, config: &ElementConfig, streams: Stream) -> Vec<Vec<Element>> {
    // Few plans have more than a handful of cross-sections, and many have none with parking.
    let is_for_cars = |(_, lane): &Bay| lane.kind == LaneKind::Parking && lane.width >= NARROWEST;
    let sections = setting.plan.sections.iter();
    let bays: Vec<Vec<Bay>> =
        sections.map(|section| section.strips().filter(is_for_cars).collect()).collect();
    let streets = setting.streets().min(setting.plan.streets.len());
    let parts = (0..streets.div_ceil(CHUNK)).into_par_iter().map(|part| {
        let own = part * CHUNK..streets.min((part + 1) * CHUNK);
        let mut cars = Vec::with_capacity(CARS * own.len());
        let mut stretch = Vec::new();
        for index in own {
            let street = &setting.plan.streets[index];
            let Some(bays) = bays.get(street.section as usize).filter(|bays| !bays.is_empty()) else {
                continue;
            };
            if street.level == 0 {
                park_in(setting, config, (index, bays), streams, &mut stretch, &mut cars);
            }
        }
        cars
    });
    parts.collect()
}

/// Parks cars in one street.
fn park_in(
    setting: &Setting<'_>,
    config: &ElementConfig,
    (index, bays): (usize, &[Bay]),
    streams: Stream,
    stretch: &mut Vec<Point2>,
    cars: &mut Vec<Element>,
) {
    let line = Measured::new(&setting.network.roads[index].centerline);
    let Some((from, to)) = clear_span(setting, index, &line) else { return };
    let middle = line.slice(from, to);
    let start = middle[0];
    let mut rng = stream_at(start, 100.0, streams).rng();
    for (offset, lane) in bays {
        let path = polyline::offset(&middle, *offset);
        let path = Measured::new(&path);
        let spaces = (path.length() / SPACE).floor() as u32;
        for space in 0..spaces {
            if !rng.chance(config.parked) {
                continue;
            }
            let length = rng.uniform(3.7, 4.9);
            let width = (length * 0.39).min(lane.width - 2.0 * EDGE_GAP);
            let station = (f64::from(space) + 0.5) * SPACE;
            path.slice_into(station - length * 0.5, station + length * 0.5, stretch);
            let car = car(stretch, length, width, is_reversed(*offset, lane), lane.width);
            let side = if *offset > 0.0 { Side::Left } else { Side::Right };
            cars.extend(
                car.map(|car| Element { along: Border::street(RoadId::from_index(index), side), ..car }),
            );
        }
    }
}

/// Whether cars look against the centreline: as traffic beside them goes, on the right.
fn is_reversed(offset: f64, lane: &LaneSpec) -> bool {
    match lane.direction {
        LaneDirection::Forward => false,
        LaneDirection::Backward => true,
        LaneDirection::Both => offset > 0.0,
    }
}

/// A car on a stretch of the middle of its lane; `None` where the lane bends too much for it to keep within.
fn car(stretch: &[Point2], length: f64, width: f64, reversed: bool, lane: f64) -> Option<Element> {
    let (back, front) = (*stretch.first()?, *stretch.last()?);
    let chord = front - back;
    let axis = chord.try_normalize(1e-6)?;
    // The lane bulges away from the car's axis by this much at most.
    let bulge = stretch.iter().map(|point| axis.perp(&(point - back)).abs()).fold(0.0, f64::max);
    if bulge + width * 0.5 > lane * 0.5 - 0.5 * EDGE_GAP {
        return None;
    }
    let along = heading(&chord);
    let facing = if reversed { ops::wrap_angle(along + PI) } else { along };
    // In a bend the chord is shorter than the stretch: so is the car.
    let shape = Shape::cuboid(length.min(chord.norm()), width, 0.31 * length);
    Some(Element {
        kind: EntityKind::Car,
        position: nalgebra::center(&front, &back),
        facing,
        shape,
        along: Border::LAND,
    })
}

/// Where along a road's centreline cars may park, clear of the junctions at its ends; `None` if nowhere.
fn clear_span(setting: &Setting<'_>, road: usize, line: &Measured<'_>) -> Option<(f64, f64)> {
    let network = setting.network;
    let (mut from, mut to) = (0.0_f64, line.length());
    let lanes = network.roads[road].forward.iter().chain(&network.roads[road].backward);
    let lanes = lanes.map(|lane| &network.lanes[lane.index()].path);
    let id = RoadId::from_index(road);
    let walks = [Side::Left, Side::Right].into_iter().filter_map(|side| network.sidewalk(id, side));
    for path in lanes.chain(walks.map(|walk| &walk.path)) {
        let ends = (line.closest_station(path.first()?)?, line.closest_station(path.last()?)?);
        from = from.max(ends.0.min(ends.1));
        to = to.min(ends.0.max(ends.1));
    }
    let (from, to) = (from + CORNER_CLEARANCE, to - CORNER_CLEARANCE);
    (to - from >= SPACE).then_some((from, to))
}
