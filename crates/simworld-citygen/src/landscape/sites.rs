//! Places away from roads, such as huts, shores and lighthouses, and the trails that lead there.

use simworld_core::asset::Catalogue;
use simworld_core::geometry::{Point2, Point3, Vector2, direction, heading};
use simworld_core::net::{RoadNetwork, polyline};

use super::LandscapeError;
use super::grid::Grid;
use super::lots::{Built, Lot, Wish};
use super::roads;
use super::trails::{Router, TRAIL_WIDTH, Trails, on_land};
use crate::terrain::HeightField;

/// Grade by which trails are looked for: less than theirs, since cut bends are a little steeper.
const SOUGHT: f64 = 0.115;
/// So many places are tried for each wish, so far from each other, m.
const TRIES: usize = 24;
const APART: f64 = 25.0;
/// Land on which huts stand falls by no more, rise over run.
const LEVEL: f64 = 0.3;
/// Places keep so far from the edge of the land, from what was made, and from each other, m.
const EDGE: f64 = 45.0;
const CLEAR: f64 = 14.0;
/// So far beyond its sidewalk the bed of a road is level, m: half a metre and a cell's diagonal.
const BED: f64 = 4.1;
/// A shore is so near to the water, m.
const SHORE: f64 = 14.0;

/// Finds places and ways there on land that is being shaped.
pub(super) struct Surveyor<'a> {
    pub(super) grid: &'a Grid,
    pub(super) network: &'a RoadNetwork,
    pub(super) lots: Vec<Lot>,
    pub(super) trails: Trails,
    router: Router,
}

impl<'a> Surveyor<'a> {
    pub(super) fn new(grid: &'a Grid, network: &'a RoadNetwork, lots: Vec<Lot>) -> Self {
        let mut surveyor = Self {
            grid,
            network,
            lots,
            trails: Trails::default(),
            router: Router::new(grid, SOUGHT, |_| true),
        };
        surveyor.look();
        surveyor
    }

    /// Looks anew where ways may go.
    fn look(&mut self) {
        let reach = roads::reach(self.network) + 1.0;
        let is_road = |place: Point2| {
            let near = |road: &simworld_core::net::Road| polyline::closest(&road.centerline, &place);
            self.network.roads.iter().filter_map(near).any(|near| near.distance < reach)
        };
        self.router = Router::new(self.grid, SOUGHT, |place| self.is_lot(place) || is_road(place));
    }

    /// Whether something stands at a place, or so near that no trail has room.
    fn is_lot(&self, place: Point2) -> bool {
        self.lots.iter().any(|lot| {
            let near = (lot.middle.xy() - place).norm() < lot.wish.size.norm() + 6.0;
            let own = || super::lots::obb(place, 0.0, Vector2::repeat(0.2), 0.0);
            near && lot.obb(TRAIL_WIDTH + 0.5).footprints_overlap(&own())
        })
    }

    /// Whether water is within reach of a shore.
    pub(super) fn is_shore(&self, place: Point2) -> bool {
        (0..16).any(|turn| {
            let way = direction(f64::from(turn) * std::f64::consts::FRAC_PI_8);
            self.grid.height(place + way * SHORE) < -0.1
        })
    }

    /// Places for something to which ways lead from the roads and trails that there are, the best first: where `rank` gives a
    /// number, the less the better.
    pub(super) fn places(&self, rank: impl Fn(Point2) -> Option<f64>) -> Vec<Point2> {
        let is_way = |node: &usize| {
            let place = self.router.place(*node);
            self.trails.passes(place) || self.pavement(place).is_some()
        };
        let ways: Vec<usize> = (0..self.router.count()).filter(is_way).collect();
        let reached = if ways.is_empty() { vec![true; self.router.count()] } else { self.router.reach(ways) };
        self.best(&reached, rank)
    }

    /// The best places among some nodes.
    fn best(&self, among: &[bool], rank: impl Fn(Point2) -> Option<f64>) -> Vec<Point2> {
        let is_free = |place: Point2| {
            self.grid.holds(place, EDGE)
                && self.grid.height(place) > 0.9
                && self.grid.slope(place) < LEVEL
                && !self.grid.is_made_near(place, CLEAR)
                && !self.trails.passes(place)
                && self.lots.iter().all(|lot| (lot.middle.xy() - place).norm() > CLEAR + 10.0)
        };
        let nodes = (0..self.router.count()).filter(|node| among[*node]);
        let mut ranked: Vec<(f64, usize)> = nodes
            .filter_map(|node| {
                let place = self.router.place(node);
                Some((rank(place).filter(|_| is_free(place))?, node))
            })
            .collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut places: Vec<Point2> = Vec::new();
        for (_, node) in ranked {
            let place = self.router.place(node);
            if places.iter().all(|other| (other - place).norm() >= APART) {
                places.push(place);
            }
            if places.len() == TRIES {
                break;
            }
        }
        places
    }

    /// The first trail of land without roads: from where one comes to it to a shore; that shore.
    pub(super) fn begin(&mut self, start: Point2, shores: &[Point2]) -> Option<Point2> {
        for shore in shores {
            let reached = self.router.reach([self.router.node(*shore)]);
            // A shore below cliffs all round is nobody's way.
            if reached.iter().filter(|reached| **reached).count() * 4 < reached.len() {
                continue;
            }
            let far = |at: Point2| ((at - shore).norm() > 80.0).then(|| (at - start).norm());
            for from in self.best(&reached, far) {
                if self.join(from, *shore) {
                    return Some(*shore);
                }
            }
        }
        None
    }

    /// Leads a trail from a place to the nearest road or trail; the line from there to the place. With neither it stays alone.
    pub(super) fn lead(&mut self, to: Point2) -> Option<Vec<Point3>> {
        let goal = |node: usize| {
            let place = self.router.place(node);
            self.trails.passes(place) || self.pavement(place).is_some()
        };
        let mut nodes = self.router.way(self.router.node(to), goal)?;
        nodes.reverse();
        let first = self.router.place(nodes[0]);
        let mut line = self.pavement(first).filter(|_| !self.trails.passes(first)).unwrap_or_default();
        line.extend(on_land(self.grid, nodes.iter().map(|node| self.router.place(*node))));
        self.trails.add(line.clone());
        Some(line)
    }

    /// Leads a trail from a place that trails pass to the nearest road.
    pub(super) fn lead_to_road(&mut self, from: Point2) -> bool {
        let goal = |node: usize| self.pavement(self.router.place(node)).is_some();
        let Some(mut nodes) = self.router.way(self.router.node(from), goal) else { return false };
        nodes.reverse();
        let mut line = self.pavement(self.router.place(nodes[0])).unwrap_or_default();
        line.extend(on_land(self.grid, nodes.iter().map(|node| self.router.place(*node))));
        self.trails.add(line);
        true
    }

    /// Leads a trail from one place to another.
    pub(super) fn join(&mut self, from: Point2, to: Point2) -> bool {
        let end = self.router.node(to);
        let Some(nodes) = self.router.way(self.router.node(from), |node| node == end) else { return false };
        let line = on_land(self.grid, nodes.into_iter().map(|node| self.router.place(node)));
        self.trails.add(line);
        true
    }

    /// How one comes from a sidewalk to a place beside its road, if that is near enough and not too steep: level to the edge of
    /// the road's bed, then evenly; without the place itself.
    fn pavement(&self, place: Point2) -> Option<Vec<Point3>> {
        let nearest = self.network.sidewalks.iter().filter_map(|walk| {
            let near = polyline::closest(&walk.path, &place)?;
            Some((near.distance, walk.width, polyline::at(&walk.path, near.station).0))
        });
        let (distance, width, at) = nearest.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let bed = width * 0.5 + BED;
        let passes = |step: u32| self.is_lot(at + (place - at) * (f64::from(step) / 10.0));
        if !(bed + 2.0..=22.0).contains(&distance) || (1..=10).any(passes) {
            return None;
        }
        let level = self.grid.height(at);
        let rise = (self.grid.height(place) - level).abs();
        let edge = at + (place - at) * (bed / distance);
        (rise <= SOUGHT * (distance - bed))
            .then(|| vec![Point3::new(at.x, at.y, level), Point3::new(edge.x, edge.y, level)])
    }

    /// Puts something at the first of some places to which a way leads, behind the end of that way.
    pub(super) fn settle(&mut self, wish: &Wish, places: &[Point2]) -> Result<Point2, LandscapeError> {
        for place in places {
            let Some(line) = self.lead(*place) else { continue };
            let [.., before, end] = line[..] else { continue };
            let way = (end - before).xy().normalize();
            let out = end.xy() + way * (wish.size.x * 0.5 + 1.0);
            self.lots.push(Lot {
                wish: wish.clone(),
                middle: Point3::new(out.x, out.y, end.z),
                facing: heading(&-way),
            });
            self.look();
            return Ok(*place);
        }
        let what = match (&wish.name, &wish.what) {
            (Some(name), _) => name.clone(),
            (None, Built::House(asset, _)) => asset.clone(),
            (None, Built::Open(used_as)) => (*used_as).to_owned(),
        };
        Err(LandscapeError::NoPlace { what })
    }

    /// A landmark of the library by its name.
    pub(super) fn landmark(library: &Catalogue, asset: &str, rank: u32) -> Result<Wish, LandscapeError> {
        let wish = Wish::house(library, asset, None);
        let wish = wish.ok_or_else(|| LandscapeError::Landmark { name: asset.to_owned() })?;
        let mut word = asset.replace('_', " ");
        if let Some(first) = word.get_mut(..1) {
            first.make_ascii_uppercase();
        }
        Ok(wish.named(if rank == 0 { word } else { format!("{word} {}", rank + 1) }))
    }
}
