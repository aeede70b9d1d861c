//! Bodies that are not the traffic's own: found on lanes and crossings, so that drivers stop for them.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use simworld_core::geometry::{Point2, Vector2, direction};
use simworld_core::id::RoadId;
use simworld_core::lists::Lists;
use simworld_core::net::{RoadNetwork, polyline};

use crate::vehicle::{Obstacle, Tracks};

/// Width of a cell of the search grid, m.
const CELL: f64 = 8.0;
/// Cells to a row of a tile.
const TILE: i64 = 32;
/// Half the width that the broadest vehicle sweeps, with a margin, m.
const SWEPT: f64 = 1.45;
/// Half the width over which every vehicle drives in the middle of a track, m. Nothing of a street stands so near: readers of maps keep
/// 0.8 m free on either side.
const CORE: f64 = 0.75;
/// Who reaches no farther than this to all sides walks, or rides something small: drivers stop before the strip for them, m.
const PERSON: f64 = 1.5;
/// Who is slower than this stands, m/s.
const STANDING: f64 = 0.1;
/// A body is covered by at most so many discs to either side of its middle.
const MOST_DISCS: f64 = 20.0;
/// What reaches farther than this both along and across, a house and no vehicle, is looked at by discs along its outline, m.
const BROAD: f64 = 1.5;
/// How far those reach, m: what they touch is filed in the cell of their middle.
const EDGE: f64 = 1.0;
/// Who is higher than this above a street is in nobody's way, m: on public roads vehicles are 4 m high at most in Europe (Directive
/// 96/53/EC) and 14 feet in most states of the USA.
const OVERHEAD: f64 = 4.5;
/// Nor is who stands so far below it, m, as in a subway.
const BELOW: f64 = 2.2;
/// What rises above the surface of a street by less than this is driven over, m.
const SURFACE: f64 = 0.05;
/// The upper side of a part of a bridge is so far above its street, m: of piers and decks, walks and railings.
const PART_OF_BRIDGE: RangeInclusive<f64> = -2.0..=1.5;

/// A body that is not the traffic's own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foreign {
    /// Where it stands, m.
    pub position: Point2,
    /// How far it reaches before and behind, m.
    pub radius: f64,
    /// How far it reaches to its sides, m.
    pub half_width: f64,
    /// Where its front is, of length one.
    pub direction: Vector2,
    /// m/s.
    pub velocity: Vector2,
    /// How high its lower side is above the ground level of the world, m. Who is on a footbridge high above a street, or far below
    /// it, is in the way of nobody there.
    pub height: f64,
}

impl Foreign {
    /// A round body that stands on the ground: how far it reaches to all sides, m.
    pub fn standing(position: Point2, radius: f64) -> Self {
        let (direction, velocity) = (Vector2::x(), Vector2::zeros());
        Self { position, radius, half_width: radius, direction, velocity, height: 0.0 }
    }

    /// Whether it is so high above a street at a place, or so far below it, that it is in nobody's way.
    pub(super) fn is_clear_of(&self, network: &RoadNetwork, road: RoadId, at: Point2) -> bool {
        // Almost all stand on the ground, and it need not be asked how high the street lies.
        if (-BELOW..=OVERHEAD).contains(&self.height) {
            return false;
        }
        let above = self.height - street_height(network, road, at);
        above > OVERHEAD || (self.height < -BELOW && above < -BELOW)
    }
}

/// Finds the tracks and crossings at a place.
#[derive(Clone, Debug, Default)]
pub(super) struct Finder {
    tracks: Cells,
    crossings: Cells,
}

/// What is in the cells of the search grid. Ten thousand bodies look into it in every step: a few tiles are found at once, and
/// a cell in its tile without search.
#[derive(Clone, Debug, Default)]
struct Cells {
    tiles: BTreeMap<(i64, i64), Tile>,
}

/// What is in each cell of a square, row by row.
type Tile = Lists<u32>;

impl Cells {
    /// Of pairs of a cell and what is in it; what is in a cell keeps its order.
    fn new(mut pairs: Vec<((i64, i64), u32)>) -> Self {
        let tile = |cell: (i64, i64)| (cell.0.div_euclid(TILE), cell.1.div_euclid(TILE));
        let place = |cell: (i64, i64)| (cell.1.rem_euclid(TILE) * TILE + cell.0.rem_euclid(TILE)) as usize;
        pairs.sort_by_key(|pair| tile(pair.0));
        let make = |within: &[((i64, i64), u32)]| {
            Tile::of((TILE * TILE) as usize, within.iter().map(|(cell, item)| (place(*cell), *item)))
        };
        let tiles = pairs.chunk_by(|a, b| tile(a.0) == tile(b.0));
        Self { tiles: tiles.map(|within| (tile(within[0].0), make(within))).collect() }
    }

    /// What is in the cell of a place.
    fn at(&self, at: Point2) -> &[u32] {
        self.within((cell(at.x), cell(at.y)))
    }

    fn within(&self, (column, row): (i64, i64)) -> &[u32] {
        let Some(tile) = self.tiles.get(&(column.div_euclid(TILE), row.div_euclid(TILE))) else { return &[] };
        &tile[(row.rem_euclid(TILE) * TILE + column.rem_euclid(TILE)) as usize]
    }
}

fn cell(x: f64) -> i64 {
    (x / CELL).floor() as i64
}

/// The cells around the pieces of a path.
fn cells(path: &[Point2], margin: f64) -> Vec<(i64, i64)> {
    let mut found = Vec::new();
    for piece in path.windows(2) {
        // Short pieces, so that a long diagonal does not fill its whole box.
        let steps = ((piece[1] - piece[0]).norm() / CELL).ceil().max(1.0) as u64;
        for step in 0..steps {
            let share = |n: u64| piece[0] + (piece[1] - piece[0]) * (n as f64 / steps as f64);
            let (a, b) = (share(step), share(step + 1));
            let rows = (cell(a.y.min(b.y) - margin), cell(a.y.max(b.y) + margin));
            for column in cell(a.x.min(b.x) - margin)..=cell(a.x.max(b.x) + margin) {
                found.extend((rows.0..=rows.1).map(|row| (column, row)));
            }
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

impl Finder {
    pub(super) fn new(tracks: &Tracks) -> Self {
        let (mut paths, mut strips) = (Vec::new(), Vec::new());
        for track in 0..tracks.count() as u32 {
            paths.extend(cells(tracks.path(track), SWEPT + 1.0).into_iter().map(|cell| (cell, track)));
        }
        for (index, crossing) in tracks.network.crossings.iter().enumerate() {
            let found = cells(&[crossing.start, crossing.end], crossing.width);
            strips.extend(found.into_iter().map(|cell| (cell, index as u32)));
        }
        Self { tracks: Cells::new(paths), crossings: Cells::new(strips) }
    }

    /// Calls with each crossing that may lie along a straight way.
    pub(super) fn crossings_along(&self, from: Point2, to: Point2, each: &mut impl FnMut(u32)) {
        for cell in cells(&[from, to], CELL * 0.5) {
            self.crossings.within(cell).iter().for_each(|index| each(*index));
        }
    }

    /// Counts foreign bodies on each crossing, and lists those on tracks by track and station, sorted.
    pub(super) fn find(
        &self,
        tracks: &Tracks,
        foreign: &[Foreign],
        on_crossing: &mut [u32],
        obstacles: &mut Vec<Obstacle>,
    ) {
        on_crossing.fill(0);
        obstacles.clear();
        for body in foreign {
            let is_person = body.radius.max(body.half_width) < PERSON;
            if is_person && self.count_on_crossings(tracks, body, on_crossing) {
                continue; // drivers stop before the strip, not before the person
            }
            let first = obstacles.len();
            for (at, reach) in body.discs().chain(body.corners().into_iter().filter(|_| !is_person)) {
                for track in self.tracks_at(at) {
                    let near = polyline::closest(tracks.path(track), &at);
                    let Some(near) = near.filter(|near| near.distance < SWEPT + reach) else { continue };
                    if body.is_clear_of(&tracks.network, road_of(tracks, track), at) {
                        continue;
                    }
                    let (back, front) = (near.station - reach, near.station + reach);
                    let aside = near.distance - reach;
                    let across = (near.lateral - reach, near.lateral + reach);
                    if let Some(own) = obstacles[first..].iter_mut().find(|other| other.track == track) {
                        (own.near, own.far) = (own.near.min(back), own.far.max(front));
                        own.aside = own.aside.min(aside);
                        own.reach = (own.reach.0.min(across.0), own.reach.1.max(across.1));
                    } else {
                        let found = body.on(tracks, track, (back, front), aside);
                        obstacles.push(Obstacle { reach: across, ..found });
                    }
                }
            }
        }
        obstacles.sort_by(|a, b| a.track.cmp(&b.track).then(a.near.total_cmp(&b.near)));
    }

    /// On which streets a thing whose upper side is so high at a place, m, reaches into what the broadest vehicle sweeps. What lies below
    /// the surface of a street, as the deck that bears it does, is in nobody's way there. What reaches as high as the deck or the railings
    /// of a bridge that it touches is a part of that, even where it stands on a street on the ground.
    pub(super) fn obstructs(
        &self,
        tracks: &Tracks,
        body: &Foreign,
        top: &dyn Fn(Point2) -> f64,
    ) -> Obstructs {
        let network = &tracks.network;
        let (mut on_ground, mut off_ground, mut bears) = (false, false, false);
        for (at, reach) in body.discs().chain(body.corners()) {
            for track in self.tracks_at(at) {
                let near = polyline::closest(tracks.path(track), &at);
                if near.is_none_or(|near| near.distance >= SWEPT + reach) {
                    continue;
                }
                let road = road_of(tracks, track);
                let above = top(at) - street_height(network, road, at);
                bears |= network.roads[road.index()].level > 0 && PART_OF_BRIDGE.contains(&above);
                if above >= SURFACE && !body.is_clear_of(network, road, at) {
                    *(if is_on_ground(tracks, track) { &mut on_ground } else { &mut off_ground }) = true;
                }
            }
        }
        match (on_ground, off_ground) {
            (false, false) => Obstructs::Nothing,
            (true, _) if !bears => Obstructs::Ground,
            _ => Obstructs::OffGround,
        }
    }

    /// Whether a body reaches into the middle of a track, over which everybody drives, and no farther than its lane is wide. What a street
    /// is built with stands beyond its lanes, or below a bridge and above a tunnel, which do not count; what the broadest vehicle sweeps
    /// reaches over the kerb of narrow lanes.
    pub(super) fn is_on_a_track(&self, tracks: &Tracks, body: &Foreign) -> bool {
        let half = |track| {
            let [from, _] = ends_of(tracks, track);
            let half = (tracks.network.lanes[from as usize].width * 0.5).min(CORE);
            is_on_ground(tracks, track).then_some(half)
        };
        self.reaches_into(tracks, body, half)
    }

    /// Whether a body comes nearer to the path of a track than the half width that is meant of it, where one is.
    fn reaches_into(&self, tracks: &Tracks, body: &Foreign, half: impl Fn(u32) -> Option<f64>) -> bool {
        body.discs().chain(body.corners()).any(|(at, reach)| {
            self.tracks_at(at).any(|track| {
                let near = polyline::closest(tracks.path(track), &at);
                near.zip(half(track)).is_some_and(|(near, half)| near.distance < half + reach)
                    && !body.is_clear_of(&tracks.network, road_of(tracks, track), at)
            })
        })
    }

    /// Counts a person on the crossings where they are; false if that is none.
    fn count_on_crossings(&self, tracks: &Tracks, body: &Foreign, on_crossing: &mut [u32]) -> bool {
        let reach = body.radius.max(body.half_width);
        let mut crosses = false;
        for index in self.crossings.at(body.position) {
            let crossing = &tracks.network.crossings[*index as usize];
            let strip = [crossing.start, crossing.end];
            let near = polyline::closest(&strip, &body.position);
            let is_on = near.is_some_and(|near| near.distance <= crossing.width * 0.5 + reach);
            if is_on && !body.is_clear_of(&tracks.network, crossing.road, body.position) {
                on_crossing[*index as usize] += 1;
                crosses = true;
            }
        }
        crosses
    }

    /// The tracks that may pass under a place.
    pub(super) fn tracks_at(&self, at: Point2) -> impl Iterator<Item = u32> {
        self.tracks.at(at).iter().copied()
    }
}

/// Where a thing is in the way of vehicles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Obstructs {
    /// Nowhere.
    Nothing,
    /// On bridges and in tunnels alone, or as a part of a bridge.
    OffGround,
    /// On a street on the ground.
    Ground,
}

/// The lanes from which and to which a way across a junction leads, or a lane twice.
fn ends_of(tracks: &Tracks, track: u32) -> [u32; 2] {
    tracks.connection(track).map_or([track; 2], |way| [tracks.ways[way].from, tracks.ways[way].to])
}

/// The road of a lane, or that from which a way across a junction comes.
fn road_of(tracks: &Tracks, track: u32) -> RoadId {
    tracks.network.lanes[ends_of(tracks, track)[0] as usize].road
}

/// Whether a track lies on the ground from end to end.
fn is_on_ground(tracks: &Tracks, track: u32) -> bool {
    let network = &tracks.network;
    ends_of(tracks, track)
        .into_iter()
        .all(|lane| network.roads[network.lanes[lane as usize].road.index()].level == 0)
}

/// The height of a street beside a place, m.
fn street_height(network: &RoadNetwork, road: RoadId, at: Point2) -> f64 {
    let near = polyline::closest(&network.roads[road.index()].centerline, &at);
    network.height(road, near.map_or(0.0, |near| near.station))
}

impl Foreign {
    /// Whether it is somewhere, and of a size that bodies have.
    pub(super) fn is_sound(&self) -> bool {
        /// Nothing that moves among traffic is longer, m: trains are.
        const LONGEST: f64 = 500.0;
        /// Nor farther away, m, or faster, m/s.
        const FARTHEST: f64 = 1e7;
        const FASTEST: f64 = 300.0;
        let [at, ahead, moving] = [self.position.coords, self.direction, self.velocity];
        [ahead.x, ahead.y].iter().all(|number| number.is_finite())
            && [at.x, at.y, self.height].iter().all(|number| number.abs() <= FARTHEST)
            && [moving.x, moving.y].iter().all(|number| number.abs() <= FASTEST)
            && (0.0..=LONGEST).contains(&self.radius)
            && (0.0..=LONGEST).contains(&self.half_width)
    }

    /// Discs that cover it, or all of its outline: their middles, and how far they reach, m.
    fn discs(&self) -> impl Iterator<Item = (Point2, f64)> {
        let is_broad = self.radius.min(self.half_width) > BROAD;
        let row = (!is_broad).then(|| self.row()).into_iter().flatten();
        row.chain(is_broad.then(|| self.outline()).into_iter().flatten())
    }

    /// Discs along the outline, within it, so near to each other that there is no room for a wheel between them.
    fn outline(&self) -> impl Iterator<Item = (Point2, f64)> {
        let ahead = self.direction.try_normalize(1e-9).unwrap_or_else(Vector2::x);
        let (long, wide) =
            (ahead * (self.radius - EDGE), Vector2::new(-ahead.y, ahead.x) * (self.half_width - EDGE));
        let corners = [long + wide, wide - long, -long - wide, long - wide].map(|off| self.position + off);
        (0..corners.len()).flat_map(move |side| {
            let (from, way) = (corners[side], corners[(side + 1) % corners.len()] - corners[side]);
            let count = (way.norm() / EDGE).ceil().max(1.0);
            (0..count as u32).map(move |step| (from + way * (f64::from(step) / count), EDGE))
        })
    }

    /// A row of discs that cover it.
    fn row(&self) -> impl Iterator<Item = (Point2, f64)> {
        let ahead = self.direction.try_normalize(1e-9).unwrap_or_else(Vector2::x);
        let long = self.radius >= self.half_width;
        let (along, reach) =
            if long { (ahead, self.half_width) } else { (Vector2::new(-ahead.y, ahead.x), self.radius) };
        let span = self.radius.max(self.half_width) - reach;
        // The outermost end with the body; between them there is no room for a wheel.
        let count = (span / reach.max(0.3)).ceil().min(MOST_DISCS);
        let middle = self.position;
        (0..=2 * count as u32).map(move |index| {
            let share = if count > 0.0 { f64::from(index) / count - 1.0 } else { 0.0 };
            (middle + along * (span * share), reach)
        })
    }

    /// Its corners, which its discs do not reach when it stands at an angle, as discs of no size.
    fn corners(&self) -> [(Point2, f64); 4] {
        let ahead = self.direction.try_normalize(1e-9).unwrap_or_else(Vector2::x);
        let (long, wide) = (ahead * self.radius, Vector2::new(-ahead.y, ahead.x) * self.half_width);
        [long + wide, long - wide, -long + wide, -long - wide].map(|offset| (self.position + offset, 0.0))
    }

    /// It as an obstacle on a track, that reaches to neither side yet.
    fn on(&self, tracks: &Tracks, track: u32, (near, far): (f64, f64), aside: f64) -> Obstacle {
        let yaw = polyline::at(tracks.path(track), (near + far) * 0.5).1;
        let v = self.velocity.dot(&direction(yaw)).max(0.0);
        let stands = self.velocity.norm() < STANDING;
        Obstacle { track, near, far, aside, reach: (0.0, 0.0), v, stands }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_6;
    use std::sync::Arc;

    use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
    use simworld_core::seed::Seed;

    use super::*;
    use crate::TrafficConfig;

    #[test]
    fn a_cell_holds_what_was_put_there_also_beyond_the_origin() {
        let mut rng = Seed(5).stream("test/cells").rng();
        let mut index = || rng.below(120) as i64 - 60;
        let pairs: Vec<((i64, i64), u32)> = (0..4000).map(|item| ((index(), index()), item)).collect();
        let cells = Cells::new(pairs.clone());
        for column in -70..70 {
            for row in -70..70 {
                let there: Vec<u32> =
                    pairs.iter().filter(|pair| pair.0 == (column, row)).map(|pair| pair.1).collect();
                let at = Point2::new((column as f64 + 0.5) * CELL, (row as f64 + 0.5) * CELL);
                assert_eq!(cells.at(at), there, "column {column}, row {row}");
            }
        }
    }

    /// A house of any size, turned any way, is on a track exactly where a point of the middle of that lies in it, or so near.
    #[test]
    fn a_house_is_on_the_tracks_that_pass_through_it() {
        let network = RoadNetwork::derive(&StreetPlan::grid(2, 2, 120.0), &NetworkConfig::default());
        let tracks = Tracks::new(Arc::new(network.expect("a grid is sound")), &TrafficConfig::default());
        let finder = Finder::new(&tracks);
        let along = |track: u32| {
            let path = tracks.path(track);
            let steps = (polyline::length(path) / 0.1) as u32;
            (0..=steps).map(move |step| polyline::at(path, f64::from(step) * 0.1).0)
        };
        let middles: Vec<Point2> = (0..tracks.count() as u32).flat_map(along).collect();
        let mut rng = Seed(8).stream("test/houses").rng();
        let (mut on, mut off) = (0, 0);
        for _ in 0..400 {
            let house = Foreign {
                position: Point2::new(rng.uniform(-20.0, 140.0), rng.uniform(-20.0, 140.0)),
                radius: rng.uniform(1.6, 16.0),
                half_width: rng.uniform(1.6, 16.0),
                direction: direction(FRAC_PI_6 * rng.below(12) as f64),
                velocity: Vector2::zeros(),
                height: 0.0,
            };
            // How far a point is within the house, m; below zero outside.
            let within = |point: Point2| {
                let way = point - house.position;
                let (x, y) = (way.dot(&house.direction), way.perp(&house.direction));
                (house.radius - x.abs()).min(house.half_width - y.abs())
            };
            let deepest = middles.iter().map(|point| within(*point)).fold(f64::NEG_INFINITY, f64::max);
            let is_on = finder.is_on_a_track(&tracks, &house);
            // Nearer to an edge than that it depends on where the discs lie.
            if deepest > 0.3 {
                assert!(is_on, "a lane leads {deepest} m deep through {house:?}");
                on += 1;
            } else if deepest < -1.1 {
                assert!(!is_on, "{house:?} stands {} m beside every lane", -deepest);
                off += 1;
            }
        }
        assert!(on > 50 && off > 50, "{on} on lanes, {off} beside them");
    }
}
