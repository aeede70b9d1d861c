//! Layers over the picture: lanes, waypoints, the ways that bodies have come, and their ids.

use std::collections::BTreeSet;
use std::str::FromStr;

use simworld_core::geometry::{Point2, Point3, Vector3};
use simworld_core::net::{NetworkError, RoadNetwork, WaypointConfig, WaypointGraph};
use simworld_core::scene::{Scene, World};

use super::canvas::{Canvas, Ink, LETTER};
use super::panes::color_of;
use super::sight::Sight;
use super::trails::Trails;

/// What lies farther from the camera is not drawn, m.
const REACH: f64 = 130.0;
/// Lines float so high above the ground, m.
const LIFT: f64 = 0.15;

const DRIVEN: Ink = [0, 210, 255];
const CYCLED: Ink = [60, 220, 110];
const JUNCTION: Ink = [255, 150, 30];
const CROSSING: Ink = [255, 255, 255];
const WAYPOINT: Ink = [255, 70, 220];
const LABEL: Ink = [255, 245, 160];

/// One of the layers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// The middles of lanes, the ways over junctions, and crossings.
    Lanes,
    /// The waypoints of people on foot, and how they hang together.
    Waypoints,
    /// The ways that bodies have come in the last seconds.
    Paths,
    /// What the bodies in sight are called.
    Ids,
}

impl Layer {
    /// All of them, in the order in which they are drawn.
    pub const ALL: [Self; 4] = [Self::Lanes, Self::Waypoints, Self::Paths, Self::Ids];
    const NAMES: [&'static str; 4] = ["lanes", "waypoints", "paths", "ids"];
}

impl FromStr for Layer {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::NAMES.iter().position(|name| *name == text);
        found
            .map(|index| Self::ALL[index])
            .ok_or_else(|| format!("{text:?} is no layer: give {}", Self::NAMES.join(", ")))
    }
}

/// Draws layers; what they need is made when it is first asked for.
#[derive(Default)]
pub(super) struct Painter {
    ways: Option<WaypointGraph>,
}

impl Painter {
    /// Draws the chosen layers over the picture.
    pub(super) fn draw(
        &mut self,
        canvas: &mut Canvas,
        sight: &Sight<'_>,
        world: &World,
        trails: &Trails,
        chosen: &BTreeSet<Layer>,
    ) -> Result<(), NetworkError> {
        let eye: Point3 = sight.camera.world_from_optical.translation.vector.into();
        let roads = world.roads().map(AsRef::as_ref);
        for layer in chosen {
            match (layer, roads) {
                (Layer::Lanes, Some(roads)) => lanes(canvas, sight, world, roads, eye.xy()),
                (Layer::Waypoints, Some(roads)) => {
                    if self.ways.is_none() {
                        self.ways = Some(WaypointGraph::walkable(roads, &WaypointConfig::default())?);
                    }
                    if let Some(ways) = &self.ways {
                        waypoints(canvas, sight, world, ways, eye.xy());
                    }
                }
                (Layer::Paths, _) => paths(canvas, sight, trails),
                (Layer::Ids, _) => ids(canvas, sight, world),
                (Layer::Lanes | Layer::Waypoints, None) => {}
            }
        }
        Ok(())
    }
}

/// A point of the plane, a little above the ground.
fn raised(world: &World, point: Point2) -> Point3 {
    let ground = world.ground().map_or(0.0, |ground| ground.height(point));
    Point3::new(point.x, point.y, ground + LIFT)
}

fn polyline(canvas: &mut Canvas, sight: &Sight<'_>, world: &World, path: &[Point2], ink: Ink) {
    for pair in path.windows(2) {
        sight.line(canvas, &raised(world, pair[0]), &raised(world, pair[1]), ink);
    }
}

fn is_near(path: &[Point2], eye: Point2) -> bool {
    path.iter().any(|point| (point - eye).norm() < REACH)
        || path.windows(2).any(|pair| {
            let along = pair[1] - pair[0];
            let t = ((eye - pair[0]).dot(&along) / along.norm_squared().max(1e-9)).clamp(0.0, 1.0);
            (pair[0] + along * t - eye).norm() < REACH
        })
}

fn lanes(canvas: &mut Canvas, sight: &Sight<'_>, world: &World, roads: &RoadNetwork, eye: Point2) {
    for lane in roads.lanes.iter().filter(|lane| is_near(&lane.path, eye)) {
        let ink = if lane.is_driven() { DRIVEN } else { CYCLED };
        polyline(canvas, sight, world, &lane.path, ink);
        arrow(canvas, sight, world, &lane.path, ink);
    }
    for way in roads.connections.iter().filter(|way| is_near(&way.path, eye)) {
        polyline(canvas, sight, world, &way.path, JUNCTION);
    }
    for crossing in &roads.crossings {
        let path = [crossing.start, crossing.end];
        if is_near(&path, eye) {
            polyline(canvas, sight, world, &path, CROSSING);
        }
    }
}

/// An arrow at the end of a lane, in the direction in which it is driven.
fn arrow(canvas: &mut Canvas, sight: &Sight<'_>, world: &World, path: &[Point2], ink: Ink) {
    let [.., from, tip] = path else { return };
    let along = tip - from;
    if along.norm() < 1.0 {
        return;
    }
    let along = along.normalize();
    let aside = nalgebra::Vector2::new(-along.y, along.x) * 0.5;
    for side in [aside, -aside] {
        polyline(canvas, sight, world, &[tip - along * 1.4 + side, *tip], ink);
    }
}

fn waypoints(canvas: &mut Canvas, sight: &Sight<'_>, world: &World, ways: &WaypointGraph, eye: Point2) {
    for (index, waypoint) in ways.waypoints().iter().enumerate() {
        if (waypoint.position - eye).norm() > REACH * 0.6 {
            continue;
        }
        let here = raised(world, waypoint.position);
        for edge in ways.edges(simworld_core::id::WaypointId::from_index(index)) {
            // Each way stands in both directions, and is drawn once.
            if edge.to.index() > index {
                let there = raised(world, ways.waypoint(edge.to).position);
                sight.line(canvas, &here, &there, WAYPOINT.map(|channel| channel / 2));
            }
        }
        let up = Vector3::new(0.0, 0.0, 0.35);
        sight.line(canvas, &here, &(here + up), WAYPOINT);
    }
}

fn paths(canvas: &mut Canvas, sight: &Sight<'_>, trails: &Trails) {
    for (id, trail) in trails.each() {
        let ink = color_of(id.index() as u32 + 1);
        let raise = Vector3::new(0.0, 0.0, LIFT);
        for (from, to) in trail.iter().zip(trail.iter().skip(1)) {
            sight.line(canvas, &(from + raise), &(to + raise), ink);
        }
    }
}

/// Labels of what moves and is in sight.
fn ids(canvas: &mut Canvas, sight: &Sight<'_>, world: &World) {
    for id in &sight.frame.drawn {
        let Some(entity) = world.entity(*id).filter(|entity| entity.kind.is_mobile()) else { continue };
        let top = Vector3::new(0.0, 0.0, entity.info.shape.size().z + 0.35);
        let Some((pixel, depth)) = sight.place(&(entity.position() + top)) else { continue };
        if depth < 60.0 {
            let text = format!("{} {}", entity.info.name.as_deref().unwrap_or(entity.kind.as_str()), id);
            let left = pixel.x as i64 - (text.len() * LETTER / 2) as i64;
            canvas.text([left, pixel.y as i64 - LETTER as i64], &text, LABEL, 1);
        }
    }
}
