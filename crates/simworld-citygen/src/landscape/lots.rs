//! Houses, squares and parks along the roads of a place beyond the city: one after another where each first finds room.

use simworld_core::asset::Catalogue;
use simworld_core::geometry::{Obb, Point2, Point3, Vector2, Vector3, direction, heading, pose_facing};
use simworld_core::net::{RoadNetwork, polyline};
use simworld_core::scene::Place;

use super::grid::Grid;
use crate::terrain::HeightField;

/// Between a sidewalk and what stands behind it, m, and between two houses.
const SETBACK: f64 = 3.0;
const BETWEEN: f64 = 3.0;
/// Places are tried so far from each other along a road, m.
const TRIED: f64 = 4.0;
/// Land that falls by more under a house is not built on, m.
const UNEVEN: f64 = 4.5;
/// Houses stand so high above the water, m.
const DRY: f64 = 1.2;

/// What is to stand somewhere.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wish {
    /// The asset of the library, or the use of open ground: `square`, `park`.
    pub(super) what: Built,
    /// What it is called.
    pub(super) name: Option<String>,
    /// Away from the road and along it, m.
    pub(super) size: Vector2,
}

/// What a lot is for.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Built {
    /// A building of the library by its name.
    House(String, Option<Place>),
    /// Open ground with a use.
    Open(&'static str),
}

/// Where something stands: level ground with its front to a way.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Lot {
    pub(super) wish: Wish,
    /// The middle, on the ground, m.
    pub(super) middle: Point3,
    /// The direction of its front, radians.
    pub(super) facing: f64,
}

impl Wish {
    /// A house of the library; none if the library has no such thing.
    pub(super) fn house(library: &Catalogue, asset: &str, place: Option<Place>) -> Option<Self> {
        let size = library.get(library.find(asset)?)?.footprint();
        Some(Self { what: Built::House(asset.to_owned(), place), name: None, size })
    }

    pub(super) fn named(self, name: impl Into<String>) -> Self {
        Self { name: Some(name.into()), ..self }
    }
}

impl Lot {
    /// The ground it takes.
    pub(super) fn obb(&self, margin: f64) -> Obb {
        obb(self.middle.xy(), self.facing, self.wish.size, margin)
    }

    /// Where one stands before it, on the ground, m.
    pub(super) fn access(&self) -> Point3 {
        let out = direction(self.facing) * (self.wish.size.x * 0.5 + 1.0);
        self.middle + Vector3::new(out.x, out.y, 0.0)
    }
}

pub(super) fn obb(middle: Point2, facing: f64, size: Vector2, margin: f64) -> Obb {
    let pose = pose_facing(Point3::new(middle.x, middle.y, 0.0), facing);
    Obb { pose, half_extents: Vector3::new(size.x * 0.5 + margin, size.y * 0.5 + margin, 1.0) }
}

/// Finds lots along roads, those nearest to a middle first.
pub(super) struct Builder<'a> {
    grid: &'a Grid,
    network: &'a RoadNetwork,
    /// Places beside roads with the direction to the road and how far the road's edge is: nearest to the middle first.
    fronts: Vec<(Point2, f64, f64)>,
    /// Of sizes that were looked for: which front is the first that was not refused. Nothing is taken away, so what was refused once
    /// need not be tried again.
    refused: Vec<(Vector2, usize)>,
    pub(super) lots: Vec<Lot>,
}

impl<'a> Builder<'a> {
    pub(super) fn new(grid: &'a Grid, network: &'a RoadNetwork, middle: Point2) -> Self {
        let mut fronts = Vec::new();
        for road in &network.roads {
            let length = polyline::length(&road.centerline);
            for step in 1..(length / TRIED) as u32 {
                let (at, along) = polyline::at(&road.centerline, f64::from(step) * TRIED);
                for (side, kerb, walk) in
                    [(1.0, road.left_kerb, road.sidewalks[0]), (-1.0, road.right_kerb, road.sidewalks[1])]
                {
                    let edge = kerb + walk.map_or(0.0, |walk| network.sidewalks[walk.index()].width);
                    let out = direction(along + side * std::f64::consts::FRAC_PI_2);
                    fronts.push((at, heading(&-out), edge));
                }
            }
        }
        let away = |front: &(Point2, f64, f64)| (front.0 - middle).norm();
        fronts.sort_by(|a, b| away(a).total_cmp(&away(b)));
        Self { grid, network, fronts, refused: Vec::new(), lots: Vec::new() }
    }

    /// Gives a wish the first lot that is free, dry and even enough; false if there is none.
    pub(super) fn place(&mut self, wish: &Wish) -> bool {
        let known = self.refused.iter().position(|(size, _)| *size == wish.size);
        let known = known.unwrap_or_else(|| {
            self.refused.push((wish.size, 0));
            self.refused.len() - 1
        });
        let first = self.refused[known].1;
        let found = self.fronts.iter().enumerate().skip(first).find_map(|(index, (at, facing, edge))| {
            let out = -direction(*facing) * (edge + SETBACK + wish.size.x * 0.5);
            Some((index, self.lot(wish, at + out, *facing)?))
        });
        self.refused[known].1 = found.as_ref().map_or(self.fronts.len(), |(index, _)| *index);
        let is_found = found.is_some();
        self.lots.extend(found.map(|(_, lot)| lot));
        is_found
    }

    /// The lot at a place, if it may be built on.
    fn lot(&self, wish: &Wish, middle: Point2, facing: f64) -> Option<Lot> {
        let own = obb(middle, facing, wish.size, BETWEEN * 0.5);
        let corners = own.footprint();
        if !corners.iter().all(|corner| self.grid.holds(*corner, 15.0)) {
            return None;
        }
        let heights = corners.map(|corner| self.grid.height(corner));
        let low = heights.into_iter().fold(f64::INFINITY, f64::min);
        let high = heights.into_iter().fold(f64::NEG_INFINITY, f64::max);
        if low < DRY || high - low > UNEVEN || !self.is_beside_roads(&own) {
            return None;
        }
        if self.lots.iter().any(|lot| lot.obb(BETWEEN * 0.5).footprints_overlap(&own)) {
            return None;
        }
        // Level with the road before it, as far as the land lets it.
        let front = middle + direction(facing) * (wish.size.x * 0.5 + SETBACK);
        let base = self.grid.height(front).clamp(low - 0.5, high + 0.5).max(DRY);
        Some(Lot { wish: wish.clone(), middle: Point3::new(middle.x, middle.y, base), facing })
    }

    /// Whether no road lies there.
    fn is_beside_roads(&self, own: &Obb) -> bool {
        self.network.roads.iter().all(|road| {
            let widest =
                road.sidewalks.into_iter().flatten().map(|walk| self.network.sidewalks[walk.index()].width);
            let reach = road.left_kerb.max(road.right_kerb) + widest.fold(0.0, f64::max) + 0.6;
            road.centerline.windows(2).all(|piece| {
                let (way, middle) = (piece[1] - piece[0], nalgebra::center(&piece[0], &piece[1]));
                let strip = obb(middle, heading(&way), Vector2::new(way.norm() + 1.0, 2.0 * reach), 0.0);
                !strip.footprints_overlap(own)
            })
        })
    }
}
