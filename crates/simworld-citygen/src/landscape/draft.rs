//! A place beyond the city as it comes about: land, roads, lots, trails, green, water, in this order.

use std::sync::Arc;

use simworld_core::asset::Catalogue;
use simworld_core::geometry::{Point2, Point3, Vector2, direction, pose_facing};
use simworld_core::ground::Cover;
use simworld_core::net::{RoadNetwork, StreetPlan};
use simworld_core::seed::{Seed, Stream};
use simworld_core::spec::{SceneKind, SceneSpec, Water};

use super::green::Green;
use super::grid::Grid;
use super::lots::{Builder, Built, Lot, Wish};
use super::plants::Plant;
use super::relief::{Basin, Relief, bearing};
use super::sites::Surveyor;
use super::trails::{TRAIL_WIDTH, Trails};
use super::{Landscape, LandscapeError, Sheet, Thing, roads, wishes};
use crate::terrain::HeightField;
use crate::threads::AllThreads;

/// From the middle of the smallest place to the edge of its land, m, and how much farther for each house.
const HALF: f64 = 360.0;
const HALF_FOR_A_HOUSE: f64 = 2.4;
/// The farthest, m: a model may be no larger.
const MOST_HALF: f64 = 900.0;
/// So often a place without room is made larger.
const TRIES: u32 = 4;
/// How far the sea goes on beyond the land, m.
const SEA: f64 = 3000.0;
/// The ring path of an island: so many turning points, so high, m.
const RING: u32 = 10;
const RING_HEIGHT: f64 = 7.0;

/// Makes the place.
pub(super) fn build(spec: &SceneSpec, seed: Seed) -> Result<Landscape, LandscapeError> {
    spec.validate()?;
    wishes::refuse(spec)?;
    let library = Catalogue::library();
    let stream = seed.stream("citygen/landscape");
    let lots = match spec.kind {
        SceneKind::Wilderness => Vec::new(),
        _ => wishes::along_roads(spec, &library),
    };
    let mut scale = 1.0;
    let (mut most, mut before) = (0, None);
    for _ in 0..TRIES {
        let half = ((HALF + HALF_FOR_A_HOUSE * lots.len() as f64) * scale).min(MOST_HALF);
        match Draft::begin(spec, half, &lots, scale, stream)? {
            Ok(draft) => return draft.finish(spec, &library, stream),
            Err(full) => {
                most = most.max(full.placed);
                // What can grow no more is not tried again.
                if before.replace(full) == Some(full) {
                    break;
                }
            }
        }
        scale *= 1.3;
    }
    Err(LandscapeError::TooMany { wanted: lots.len(), most })
}

/// A place without room: half of its side and the length of its lanes, m, and how many lots found room along them.
#[derive(Clone, Copy, PartialEq)]
struct Full {
    half: f64,
    lanes: f64,
    placed: usize,
}

/// A place with its land, its roads and what stands along them.
struct Draft {
    grid: Grid,
    waters: Vec<Basin>,
    network: RoadNetwork,
    /// Where most houses stand, or the middle of the land.
    middle: Point2,
    lots: Vec<Lot>,
}

impl Draft {
    /// The land with its roads and lots, or what has no room for these.
    fn begin(
        spec: &SceneSpec,
        half: f64,
        wished: &[Wish],
        scale: f64,
        stream: Stream,
    ) -> Result<Result<Self, Full>, LandscapeError> {
        let mut waters = spec.features.waters.clone();
        if waters.is_empty() && spec.kind != SceneKind::Island {
            // A pond, or the lake that a wilderness has.
            waters.push(Water::Lake);
        }
        let relief = Relief::new(spec.kind, half, &waters, stream);
        let mut grid = relief.shape();
        let section = roads::section(spec);
        let fronts: f64 = wished.iter().map(|wish| wish.size.y + 5.0).sum();
        let planned = match spec.kind {
            _ if wished.is_empty() && spec.kind != SceneKind::Countryside => None,
            SceneKind::Island => roads::by_the_sea(&grid, fronts * 1.5 * scale, &section),
            _ => Some(roads::across_country(&grid, &section).ok_or_else(|| no_place("its roads"))?),
        };
        let (plan, middle) = planned.unwrap_or((StreetPlan::default(), Point2::origin()));
        let network = RoadNetwork::derive_with(&plan, &roads::rules(), &AllThreads)?;
        if let Some(wanted) = spec.streets.count.filter(|count| *count as usize > network.roads.len()) {
            return Err(LandscapeError::Streets { wanted, have: network.roads.len() });
        }
        let (beds, reach) = roads::beds(&network);
        grid.lay(&beds, reach, Cover::Built);
        let mut builder = Builder::new(&grid, &network, middle);
        // Where one finds no room the rest need not be tried.
        let placed = wished.iter().take_while(|wish| builder.place(wish)).count();
        if placed < wished.len() {
            let lanes = network.lanes.iter().map(|lane| lane.length).sum();
            return Ok(Err(Full { half, lanes, placed }));
        }
        let lots = builder.lots;
        for lot in &lots {
            pad(&mut grid, lot);
        }
        Ok(Ok(Self { grid, waters: relief_waters(&relief), network, middle, lots }))
    }

    /// Trails, landmarks, green and water.
    fn finish(
        mut self,
        spec: &SceneSpec,
        library: &Catalogue,
        stream: Stream,
    ) -> Result<Landscape, LandscapeError> {
        let along_roads = self.lots.len();
        let grid = self.grid.clone();
        let mut surveyor = Surveyor::new(&grid, &self.network, std::mem::take(&mut self.lots));
        let shores = self.way_marks(spec, library, &mut surveyor)?;
        let Surveyor { lots, trails, .. } = surveyor;
        self.lots = lots;
        self.network.footpaths = trails.footpaths();
        self.lay(&trails, along_roads);
        let green = Green::new(spec.kind, spec.streets.trees, &self.grid, stream);
        let plants = green.grown(&mut self.grid, stream);
        let areas = self.areas(spec, &shores);
        let ground = Arc::new(self.grid.ground()?);
        let mut things: Vec<Thing> = self.lots.iter().filter_map(house).collect();
        things.extend(plants.iter().map(|plant| self.grown(plant)));
        Ok(Landscape {
            kind: spec.kind,
            ground,
            network: Arc::new(self.network),
            things,
            areas,
            environment: spec.environment,
        })
    }

    /// Cuts the trails into the land, then levels what stands at their ends.
    fn lay(&mut self, trails: &Trails, along_roads: usize) {
        self.grid.lay(&trails.lines(), TRAIL_WIDTH * 0.5, Cover::Path);
        for index in along_roads..self.lots.len() {
            let lot = self.lots[index].clone();
            pad(&mut self.grid, &lot);
        }
    }

    /// Huts, landmarks and shores with the trails to them; gives for each water where one stands beside it.
    fn way_marks(
        &self,
        spec: &SceneSpec,
        library: &Catalogue,
        surveyor: &mut Surveyor<'_>,
    ) -> Result<Vec<Point2>, LandscapeError> {
        let start = match spec.kind {
            SceneKind::Wilderness => Point2::new(-0.3 * self.grid.half, -self.grid.half + 60.0),
            _ => self.middle,
        };
        let mut shores = Vec::new();
        for basin in &self.waters {
            let near = |place: Point2| {
                let beside =
                    (place - basin.middle).norm() < self.grid.half * 0.45 || basin.water == Water::River;
                (beside && surveyor.is_shore(place)).then(|| (place - start).norm())
            };
            let places = surveyor.places(near);
            let found = if surveyor.trails.lines().is_empty() && self.network.roads.is_empty() {
                surveyor.begin(start, &places)
            } else {
                places.into_iter().find(|place| surveyor.lead(*place).is_some())
            };
            shores.push(found.ok_or_else(|| no_place(&format!("a way to the {}", basin.water.as_str())))?);
        }
        if spec.kind == SceneKind::Island {
            self.ring(surveyor);
        }
        self.huts(spec, library, surveyor)?;
        for (name, count) in &spec.features.landmarks {
            for rank in 0..*count {
                let wish = Surveyor::landmark(library, name, rank)?;
                let places = self.places_for(name, surveyor);
                surveyor.settle(&wish, &places)?;
            }
        }
        Ok(shores)
    }

    /// Where a landmark is looked for: a lighthouse on a headland, a mill on a hill, others on the way.
    fn places_for(&self, name: &str, surveyor: &Surveyor<'_>) -> Vec<Point2> {
        let grid = &self.grid;
        match name {
            "lighthouse" => surveyor.places(|at| (grid.height(at) < 14.0).then(|| -at.coords.norm())),
            "windmill" | "castle" | "observatory" | "radio_tower" => {
                surveyor.places(|at| Some(-grid.height(at)))
            }
            _ => surveyor.places(|at| Some((at - self.middle).norm())),
        }
    }

    /// Huts of a wilderness, and where one camps.
    fn huts(
        &self,
        spec: &SceneSpec,
        library: &Catalogue,
        surveyor: &mut Surveyor<'_>,
    ) -> Result<(), LandscapeError> {
        if spec.kind != SceneKind::Wilderness {
            return Ok(());
        }
        let lake = self.waters.first().map_or(Point2::origin(), |basin| basin.middle);
        for rank in 0..spec.buildings.count.unwrap_or(1) {
            let name = if rank == 0 { "Hut".to_owned() } else { format!("Hut {}", rank + 1) };
            let wish = Wish::house(library, "log_cabin", None).ok_or_else(|| no_place("a hut"))?.named(name);
            let places = surveyor.places(|at| {
                let away = (at - lake).norm();
                (away > 130.0 && away < self.grid.half)
                    .then(|| (away - 220.0).abs() - 2.0 * self.grid.height(at))
            });
            surveyor.settle(&wish, &places)?;
        }
        let fire = Wish::house(library, "campfire", None).ok_or_else(|| no_place("a camp site"))?;
        let places = surveyor.places(|at| surveyor.is_shore(at).then(|| (at - lake).norm()));
        surveyor.settle(&fire.named("Camp site"), &places)?;
        Ok(())
    }

    /// A path around an island, as far as its slopes let it.
    fn ring(&self, surveyor: &mut Surveyor<'_>) {
        let anchors: Vec<Point2> = (0..RING)
            .filter_map(|turn| {
                let way = bearing(f64::from(turn) / f64::from(RING));
                let out = (0..(self.grid.half / 4.0) as u32)
                    .rev()
                    .map(|step| Point2::from(way * (f64::from(step) * 4.0)));
                let high = out.into_iter().find(|at| self.grid.height(*at) >= RING_HEIGHT)?;
                let near = surveyor.places(|at| ((at - high).norm() < 60.0).then(|| (at - high).norm()));
                near.first().copied()
            })
            .collect();
        for (index, from) in anchors.iter().enumerate() {
            surveyor.join(*from, anchors[(index + 1) % anchors.len()]);
        }
        if let Some(first) = anchors.first().filter(|_| !self.network.roads.is_empty()) {
            let nearest =
                anchors.iter().min_by(|a, b| (*a - self.middle).norm().total_cmp(&(*b - self.middle).norm()));
            surveyor.lead_to_road(*nearest.unwrap_or(first));
        }
    }

    /// Squares, parks and waters.
    fn areas(&self, spec: &SceneSpec, shores: &[Point2]) -> Vec<Sheet> {
        let mut areas: Vec<Sheet> = self.lots.iter().filter_map(open).collect();
        for (basin, shore) in self.waters.iter().zip(shores) {
            let name = if basin.water == Water::River { "River" } else { "Lake" };
            areas.extend(self.sheet(basin, name, *shore));
        }
        if spec.kind == SceneKind::Island {
            let size = Vector2::repeat(2.0 * (self.grid.half + SEA));
            let (name, used_as) = ("Sea", "sea");
            let middle = Point3::origin();
            let way = self.middle.coords.try_normalize(1e-6).unwrap_or(Vector2::x());
            let dry = (0..(self.grid.half / 2.0) as u32)
                .rev()
                .map(|step| Point2::from(way * (f64::from(step) * 2.0)));
            let access = dry.into_iter().find(|at| self.grid.height(*at) > 0.6);
            let access = access.map(|at| Point3::new(at.x, at.y, self.grid.height(at)));
            areas.push(Sheet { name: name.to_owned(), used_as, middle, size, facing: 0.0, access });
        }
        areas
    }

    /// The water of a basin: the box around its wet points.
    fn sheet(&self, basin: &Basin, name: &str, shore: Point2) -> Option<Sheet> {
        let (part, _) = self.grid.parts();
        let inside = self.waters.iter().find(|own| *own == basin).map(|own| own.middle)?;
        let own = part[self.grid.nearest(inside)];
        let points = (0..part.len()).filter(|index| part[*index] == own).map(|index| self.grid.place(index));
        let (low, high) = simworld_core::geometry::bounds(points.collect::<Vec<_>>().iter())?;
        let (margin, middle) = (Vector2::repeat(2.0 * super::grid::SPACING), nalgebra::center(&low, &high));
        Some(Sheet {
            name: name.to_owned(),
            used_as: basin.water.as_str(),
            middle: Point3::new(middle.x, middle.y, 0.0),
            size: high - low + margin,
            facing: 0.0,
            access: Some(Point3::new(shore.x, shore.y, self.grid.height(shore))),
        })
    }

    fn grown(&self, plant: &Plant) -> Thing {
        let at = Point3::new(plant.at.x, plant.at.y, self.grid.height(plant.at));
        Thing {
            asset: plant.asset.to_owned(),
            pose: pose_facing(at, plant.facing),
            scale: plant.scale,
            name: None,
            place: None,
            access: None,
        }
    }
}

fn no_place(what: &str) -> LandscapeError {
    LandscapeError::NoPlace { what: what.to_owned() }
}

/// The waters, each by a place that is wet.
fn relief_waters(relief: &Relief) -> Vec<Basin> {
    relief.waters().iter().map(|basin| Basin { middle: relief.in_water(basin), ..*basin }).collect()
}

/// Levels the land under a lot.
fn pad(grid: &mut Grid, lot: &Lot) {
    let half = lot.wish.size * 0.5 + Vector2::repeat(0.5);
    grid.pad(lot.middle, half, direction(lot.facing), Cover::Built);
}

fn house(lot: &Lot) -> Option<Thing> {
    let Built::House(asset, place) = &lot.wish.what else { return None };
    Some(Thing {
        asset: asset.clone(),
        pose: pose_facing(lot.middle, lot.facing),
        scale: 1.0,
        name: lot.wish.name.clone(),
        place: *place,
        access: Some(lot.access()),
    })
}

fn open(lot: &Lot) -> Option<Sheet> {
    let Built::Open(used_as) = lot.wish.what else { return None };
    let mut middle = lot.middle;
    middle.z += 0.03;
    Some(Sheet {
        name: lot.wish.name.clone().unwrap_or_else(|| used_as.to_owned()),
        used_as,
        middle,
        size: lot.wish.size,
        facing: lot.facing,
        access: Some(lot.access()),
    })
}
