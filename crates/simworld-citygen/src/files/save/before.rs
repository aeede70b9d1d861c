//! Files of version 3, whose streets and junctions know no hammerheads, and which hold no ways for walkers. What is read
//! becomes what this version has.

use std::collections::BTreeMap;

use serde::Deserialize;
use simworld_core::geometry::Point2;
use simworld_core::id::{ConnectionId, CrossingId, RoadId};
use simworld_core::net::{
    self, Control, CrossSection, DrivingSide, RoadClass, TurnLanes, TurnSet, TurningCircle,
};

use crate::Provenance;

/// Everything small.
#[derive(Deserialize)]
pub(super) struct Head {
    config: String,
    provenance: Provenance,
    frontage: f64,
    driving_side: DrivingSide,
    counts: Counts,
}

#[derive(Deserialize)]
struct Counts {
    buildings: u64,
    elements: u64,
    roads: u64,
    lanes: u64,
    connections: u64,
    intersections: u64,
    sidewalks: u64,
    crossings: u64,
    signals: u64,
    names: u64,
}

/// Streets and all that a plan has.
#[derive(Deserialize)]
pub(super) struct Plan {
    nodes: Vec<Point2>,
    streets: Vec<Street>,
    sections: Vec<CrossSection>,
    names: Vec<String>,
    controls: BTreeMap<usize, Control>,
    driving_side: DrivingSide,
    elevations: Vec<f64>,
}

#[derive(Deserialize)]
struct Street {
    from: usize,
    to: usize,
    via: Vec<Point2>,
    class: RoadClass,
    section: u32,
    name: Option<u32>,
    speed_limit: Option<f64>,
    turns: (Vec<TurnSet>, Vec<TurnSet>),
    roundabout: bool,
    level: i8,
    turning: [f64; 2],
    profile: Vec<(f64, f64)>,
}

/// Where roads meet.
#[derive(Deserialize)]
pub(super) struct Intersection {
    center: Point2,
    height: f64,
    outline: Vec<Point2>,
    kerbs: Vec<u32>,
    turning: Option<TurningCircle>,
    roads: Vec<RoadId>,
    control: Control,
    signals: Option<u32>,
    connections: Vec<ConnectionId>,
    crossings: Vec<CrossingId>,
    corners: Vec<Vec<Point2>>,
}

impl From<Head> for super::Head {
    fn from(old: Head) -> Self {
        let counts = super::Counts {
            buildings: old.counts.buildings,
            elements: old.counts.elements,
            roads: old.counts.roads,
            lanes: old.counts.lanes,
            connections: old.counts.connections,
            intersections: old.counts.intersections,
            sidewalks: old.counts.sidewalks,
            crossings: old.counts.crossings,
            signals: old.counts.signals,
            names: old.counts.names,
            footpaths: 0,
        };
        Self {
            config: old.config,
            provenance: old.provenance,
            frontage: old.frontage,
            driving_side: old.driving_side,
            counts,
        }
    }
}

impl From<Plan> for net::StreetPlan {
    fn from(old: Plan) -> Self {
        Self {
            nodes: old.nodes,
            streets: old.streets.into_iter().map(Into::into).collect(),
            sections: old.sections,
            names: old.names,
            controls: old.controls,
            driving_side: old.driving_side,
            elevations: old.elevations,
        }
    }
}

impl From<Street> for net::Street {
    fn from(old: Street) -> Self {
        let (forward, backward) = old.turns;
        Self {
            via: old.via,
            class: old.class,
            section: old.section,
            name: old.name,
            speed_limit: old.speed_limit,
            turns: TurnLanes { forward, backward, ..TurnLanes::default() }.into(),
            roundabout: old.roundabout,
            level: old.level,
            turning: old.turning,
            profile: old.profile.into(),
            ..Self::simple(old.from, old.to)
        }
    }
}

impl From<Intersection> for net::Intersection {
    fn from(old: Intersection) -> Self {
        Self {
            center: old.center,
            height: old.height,
            outline: old.outline,
            kerbs: old.kerbs.into(),
            turning: old.turning,
            roads: old.roads.into(),
            control: old.control,
            signals: old.signals,
            connections: old.connections,
            crossings: old.crossings.into(),
            corners: old.corners,
            hammerhead: None,
        }
    }
}
