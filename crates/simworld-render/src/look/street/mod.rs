//! What the network of roads says of the surfaces of streets: which of them is a piece of which road or sidewalk.
//!
//! A scene holds carriageways and sidewalks as flat boxes along straight pieces of its network. A box is known by where it lies:
//! along a piece, and nearer to its line than it is wide. Boxes that belong to no piece look as they would without a network.

mod kerbs;
mod lanes;
mod marks;

use std::sync::{Arc, Weak};

use simworld_core::geometry::{Point2, Pose, Vector2, Vector3};
use simworld_core::grid::PointGrid;
use simworld_core::id::{IntersectionId, RoadId, SidewalkId};
use simworld_core::net::RoadNetwork;
use simworld_core::scene::{EntityKind, EntityRef, Scene};

pub(crate) use marks::mark_layer;

use super::Look;
use crate::resident;

/// Pieces are filed by points on them so far apart, m.
const SPACING: f64 = 8.0;
/// The middle of a box lies no farther from the line of its piece than this, m: bridges are wider on one side.
const ASIDE: f64 = 8.0;
/// Boxes and pieces go the same way if the cosine between them is at least this.
const SAME_WAY: f64 = 0.9999;

/// What a piece is a part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Line {
    Road(RoadId),
    Sidewalk(SidewalkId),
    /// The walkway round a corner, by its rank.
    Corner(IntersectionId, u32),
}

/// A straight piece of a line.
#[derive(Clone, Copy, Debug)]
struct Piece {
    line: Line,
    start: Point2,
    end: Point2,
    /// Where along its line it begins, m.
    station: f64,
}

/// A box that lies on a piece, and how the two fit together.
struct Fit<'a> {
    network: &'a RoadNetwork,
    piece: Piece,
    /// World from box.
    pose: Pose,
    size: Vector3,
    /// The station of the middle of the box, and how far to the left of the line that is, m.
    middle: (f64, f64),
    /// Length along the box for a length on the map: more than one on slopes.
    slope: f64,
}

/// The network of a scene, filed by where its pieces are.
#[derive(Default)]
pub(super) struct Streets {
    known: Weak<RoadNetwork>,
    pieces: Vec<Piece>,
    /// Points on the pieces, and the piece of each.
    points: PointGrid,
    owners: Vec<u32>,
}

impl Streets {
    /// Follows the roads of a scene; true if they are others than before.
    pub(super) fn follow(&mut self, scene: &dyn Scene) -> bool {
        let roads = scene.roads();
        // Weak, so that who changes the roads need not copy them for us.
        let now = roads.map_or_else(Weak::new, Arc::downgrade);
        if self.known.ptr_eq(&now) {
            return false;
        }
        *self = roads.map_or_else(Self::default, |network| Self::of(network));
        self.known = now;
        true
    }

    fn of(network: &RoadNetwork) -> Self {
        let mut streets = Self::default();
        for (index, road) in network.roads.iter().enumerate() {
            streets.add(Line::Road(RoadId::from_index(index)), &road.centerline);
        }
        for (index, walk) in network.sidewalks.iter().enumerate() {
            streets.add(Line::Sidewalk(SidewalkId::from_index(index)), &walk.path);
        }
        for (index, place) in network.intersections.iter().enumerate() {
            for (rank, corner) in (0..).zip(&place.corners) {
                streets.add(Line::Corner(IntersectionId::from_index(index), rank), corner);
            }
        }
        let mut points = Vec::new();
        for (number, piece) in (0..).zip(&streets.pieces) {
            let way = piece.end - piece.start;
            let steps = (way.norm() / SPACING).ceil().max(1.0) as u32;
            points.extend((0..steps).map(|k| piece.start + way * ((f64::from(k) + 0.5) / f64::from(steps))));
            streets.owners.resize(points.len(), number);
        }
        streets.points = PointGrid::new(points, 4.0 * SPACING);
        streets
    }

    fn add(&mut self, line: Line, path: &[Point2]) {
        let mut station = 0.0;
        for ends in path.windows(2) {
            let (start, end) = (ends[0], ends[1]);
            let length = (end - start).norm();
            if length > 0.01 {
                self.pieces.push(Piece { line, start, end, station });
            }
            station += length;
        }
    }

    /// Adds what the network says of a surface to its own look, which comes first; nothing of any other entity.
    pub(super) fn dress(
        &self,
        entity: &EntityRef<'_>,
        scene: &dyn Scene,
        look: &mut Look,
        out: &mut Vec<resident::Part>,
    ) {
        let Some(fit) = self.fit(entity, scene) else { return };
        match fit.piece.line {
            Line::Road(road) => {
                look.state = marks::PAINTED;
                marks::paint(&fit, road, look, out);
            }
            Line::Sidewalk(walk) => kerbs::along(&fit, walk, look, out),
            Line::Corner(place, rank) => kerbs::round(&fit, place, rank, look, out),
        }
    }

    /// The piece on which a surface lies.
    fn fit<'a>(&self, entity: &EntityRef<'_>, scene: &'a dyn Scene) -> Option<Fit<'a>> {
        let is_road = match entity.kind {
            EntityKind::Road => true,
            EntityKind::Sidewalk => false,
            _ => return None,
        };
        let network = scene.roads()?;
        let size = entity.info.shape.size();
        let ahead = (entity.pose.rotation * Vector3::x()).xy();
        let flat = ahead.norm();
        let (ahead, center) = (ahead.try_normalize(1e-6)?, entity.planar());
        let mut near = Vec::new();
        self.points.within(center, SPACING + ASIDE, &mut near);
        let pieces = near.iter().map(|point| &self.pieces[self.owners[*point as usize] as usize]);
        let mut best: Option<(f64, Fit<'a>)> = None;
        for piece in pieces.filter(|piece| matches!(piece.line, Line::Road(_)) == is_road) {
            let way = piece.end - piece.start;
            let (along, offset) = (way / way.norm(), center - piece.start);
            let (station, lateral) = (along.dot(&offset), along.perp(&offset));
            let between = -0.1..=way.norm() + 0.1;
            // Where one is as near as another, it is the one in whose middle the box lies.
            let off = lateral.abs() + 0.01 * (station - way.norm() * 0.5).abs();
            if along.dot(&ahead) < SAME_WAY
                || !between.contains(&station)
                || lateral.abs() > (size.y * 0.5).min(ASIDE)
                || best.as_ref().is_some_and(|(least, _)| *least <= off)
            {
                continue;
            }
            let middle = (piece.station + station, lateral);
            let fit =
                Fit { network, piece: *piece, pose: *entity.pose, size, middle, slope: 1.0 / flat.max(0.1) };
            best = Some((off, fit));
        }
        best.map(|(_, fit)| fit)
    }
}

impl Fit<'_> {
    /// The stations that the box covers of its piece, m.
    fn stations(&self) -> (f64, f64) {
        let half = self.size.x * 0.5 / self.slope;
        let length = (self.piece.end - self.piece.start).norm();
        let from = self.piece.station.max(self.middle.0 - half);
        (from, (self.piece.station + length).min(self.middle.0 + half))
    }

    /// Along the box from its middle, m, at a station.
    fn along(&self, station: f64) -> f64 {
        (station - self.middle.0) * self.slope
    }

    /// To the left of the middle of the box, m, at a distance to the left of the line.
    fn aside(&self, offset: f64) -> f64 {
        offset - self.middle.1
    }

    /// A point in the frame of the box: along, to the left.
    fn local(&self, point: Point2) -> (f64, f64) {
        let way = self.piece.end - self.piece.start;
        let (along, offset): (Vector2, Vector2) = (way / way.norm(), point - self.piece.start);
        (self.along(self.piece.station + along.dot(&offset)), self.aside(along.perp(&offset)))
    }
}
