//! Elements along the sidewalks.

use std::f64::consts::FRAC_PI_2;

use rayon::prelude::*;
use simworld_core::geometry::Point2;
use simworld_core::id::{RoadId, SidewalkId};
use simworld_core::lists::Lists;
use simworld_core::net::{RoadClass, Side, Sidewalk};
use simworld_core::scene::{EntityKind, Place, Shape};
use simworld_core::seed::{Stream, StreamRng};

use super::kinds::{FURNITURE, Row, abundance, shape_of};
use super::walk::{Walk, turned};
use super::{Element, FREE_WIDTH, Setting};
use crate::ElementConfig;
use crate::block::Border;
use crate::key::stream_at;
use crate::occupancy::Occupancy;
use crate::threads;
use crate::zoning::{RememberedZoning, Zone};

/// Distance kept from the ends of a sidewalk, where people turn and cross, m.
const CORNER_CLEARANCE: f64 = 5.0;
/// Gap between the kerb and what stands at it, m.
const KERB_GAP: f64 = 0.1;
/// Gap between the sidewalk and what stands behind it, m.
const BACK_GAP: f64 = 0.15;
/// Distance kept from the middle of a door, m.
const DOOR_CLEARANCE: f64 = 1.0;
/// Gap between things at the kerb, m.
const NEIGHBOUR_GAP: f64 = 0.3;
/// Mean distance of bus stops along one side of an arterial, m.
const BUS_STOPS: f64 = 350.0;

/// So many elements are mostly wished for along a sidewalk, and set there, in its street and behind it.
const WISHES: usize = 14;
/// So many of them mostly need room.
const WITH_ROOM: usize = 1;
/// Sidewalks that one thread furnishes at once.
const CHUNK: usize = 64;
/// Sidewalks that are furnished at once: what they wish for stays in the caches until it is decided on.
const BATCH: usize = 64 * CHUNK;

/// What would like to stand along some sidewalks.
#[derive(Default)]
struct Wishes {
    elements: Vec<Element>,
    /// What each of them needs, and the ground of each that needs some, in the same order.
    needs: Vec<Need>,
    grounds: Vec<[Point2; 4]>,
}

impl Wishes {
    fn push(&mut self, element: Element, needs: Need) {
        if needs != Need::Nothing {
            self.grounds.push(element.obb().footprint());
        }
        self.elements.push(element);
        self.needs.push(needs);
    }
}

/// What a wish needs to come true.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Need {
    /// Nothing: at the kerb, it was seen to that nothing stands there.
    Nothing,
    /// That nothing stands there.
    Room,
    /// The table before it, and room.
    Table,
}

/// Sets elements along every sidewalk.
pub(super) fn line(
    setting: &Setting<'_>,
    config: &ElementConfig,
    streams: Stream,
    taken: &mut Occupancy,
    elements: &mut Vec<Element>,
) {
    let doors = Doors::of(setting);
    let all = setting.network.sidewalks.iter().enumerate();
    let sidewalks: Vec<(usize, &Sidewalk)> =
        all.filter(|(_, sidewalk)| setting.has_side(sidewalk.road, sidewalk.side)).collect();
    // Wishes are functions of their sidewalks, so they are made on all threads; who gets room is decided in order.
    let chunk = threads::at_once(sidewalks.len(), CHUNK);
    let wish = |batch: &[(usize, &Sidewalk)]| -> Vec<Wishes> {
        let zoning = || RememberedZoning::new(setting.zoning);
        let made = batch.par_chunks(chunk).map_init(zoning, |zoning, sidewalks| {
            let mut setter = Setter::default();
            setter.wishes.elements.reserve(WISHES * sidewalks.len());
            setter.wishes.needs.reserve(WISHES * sidewalks.len());
            setter.wishes.grounds.reserve(WITH_ROOM * sidewalks.len());
            for (index, sidewalk) in sidewalks {
                setter.begin(sidewalk, doors.at(*index), setting);
                let zone = setter.zone(zoning);
                setter.furnish(sidewalk, (setting, zone), config, stream_of(sidewalk, streams));
            }
            setter.wishes
        });
        made.collect()
    };
    threads::in_order(sidewalks.chunks(BATCH), wish, |made| {
        for wishes in made.into_iter().flatten() {
            threads::take_over(elements, granted(wishes, taken), WISHES * sidewalks.len());
        }
    });
}

/// Whether what is wished for behind the sidewalks of a road is in the way of what is wished for behind those of others.
pub(super) fn is_contested(
    setting: &Setting<'_>,
    config: &ElementConfig,
    streams: Stream,
    road: RoadId,
) -> bool {
    let doors = Doors::of(setting);
    let zoning = &mut RememberedZoning::new(setting.zoning);
    let mut wishes = [Setter::default(), Setter::default()];
    for (index, sidewalk) in setting.network.sidewalks.iter().enumerate() {
        if setting.has_side(sidewalk.road, sidewalk.side) {
            let setter = &mut wishes[usize::from(sidewalk.road == road)];
            setter.begin(sidewalk, doors.at(index), setting);
            let zone = setter.zone(zoning);
            setter.furnish(sidewalk, (setting, zone), config, stream_of(sidewalk, streams));
        }
    }
    let [others, own] = wishes.map(|setter| setter.wishes.grounds);
    let mut taken = Occupancy::with_capacity(others.len());
    for ground in &others {
        taken.add(ground);
    }
    own.iter().any(|ground| !taken.is_free(ground))
}

/// Those of the elements wished for that need nothing or find room.
fn granted(wishes: Wishes, taken: &mut Occupancy) -> Vec<Element> {
    let Wishes { mut elements, needs, grounds } = wishes;
    let mut has_table = false;
    let (mut needs, mut grounds) = (needs.into_iter(), grounds.iter());
    elements.retain(|element| {
        let needs = needs.next().unwrap_or(Need::Nothing);
        // Each that needs ground takes its own from the list, whether it is looked at or not.
        let ground = if needs == Need::Nothing { None } else { grounds.next() };
        let is_out = needs == Need::Table && !has_table;
        let comes_true = !is_out && ground.is_none_or(|ground| taken.take(ground));
        if needs == Need::Room {
            has_table = comes_true && element.kind == EntityKind::Table;
        }
        comes_true
    });
    elements
}

/// The stream of a sidewalk is a function of where it begins, so that a change elsewhere moves nothing here.
fn stream_of(sidewalk: &Sidewalk, streams: Stream) -> Stream {
    let start = sidewalk.path.first().copied().unwrap_or_else(Point2::origin);
    let side = u64::from(sidewalk.side == Side::Right);
    stream_at(start, 100.0, streams).indexed(side)
}

/// A whole number with that mean.
pub(super) fn count(mean: f64, rng: &mut StreamRng) -> u64 {
    // The cast cuts fractions off.
    (mean + rng.unit()) as u64
}

/// The buildings at every sidewalk.
struct Doors(Lists<u32>);

impl Doors {
    fn of(setting: &Setting<'_>) -> Self {
        let network = setting.network;
        let sidewalk = |index: usize| {
            let building = &setting.buildings[index];
            let road = network.roads.get(building.road.index())?;
            road.sidewalks[usize::from(building.side == Side::Right)].map(SidewalkId::index)
        };
        let filed =
            (0..setting.buildings.len()).filter_map(|building| Some((sidewalk(building)?, building as u32)));
        Self(Lists::of(network.sidewalks.len(), filed))
    }

    fn at(&self, sidewalk: usize) -> &[u32] {
        &self.0[sidewalk]
    }
}

#[derive(Default)]
struct Setter {
    walk: Walk,
    /// Stations that are taken at the kerb, from and to.
    busy: Vec<(f64, f64)>,
    /// Stations of doors, and what is behind them.
    doors: Vec<(f64, Place)>,
    wishes: Wishes,
    along: Border,
}

impl Setter {
    /// Furnishes one sidewalk.
    fn furnish(
        &mut self,
        sidewalk: &Sidewalk,
        (setting, zone): (&Setting<'_>, Zone),
        config: &ElementConfig,
        stream: Stream,
    ) {
        let rng = &mut stream.rng();
        let (trees, furniture) = abundance(zone);
        let is_local = setting.network.roads[sidewalk.road.index()].class == RoadClass::Local;
        let usable = self.usable();
        if !is_local && rng.chance(usable / BUS_STOPS) {
            self.set(EntityKind::BusStop, Row::Back, CORNER_CLEARANCE + 4.0 + rng.unit() * 6.0, rng);
        }
        // What is behind the doors changes nothing but the terraces.
        if self.doors.iter().any(|(_, place)| *place == Place::Restaurant) {
            self.terraces(&mut stream.named("terraces").rng());
        }
        self.line_up(EntityKind::StreetLamp, config.lamps, rng);
        self.line_up(EntityKind::Tree, config.trees * trees, rng);
        let weights = FURNITURE.map(|(_, _, weights)| weights[zone as usize]);
        let total = StreamRng::total(&weights);
        for _ in 0..count(usable * config.furniture * furniture, rng) {
            let (kind, row, _) = FURNITURE[rng.weighted_of(&weights, total).unwrap_or(0)];
            self.set(kind, row, CORNER_CLEARANCE + rng.unit() * usable, rng);
        }
    }

    fn begin(&mut self, sidewalk: &Sidewalk, buildings: &[u32], setting: &Setting<'_>) {
        self.walk.set(sidewalk);
        self.along = Border::street(sidewalk.road, sidewalk.side);
        self.busy.clear();
        self.doors.clear();
        for index in buildings {
            let building = &setting.buildings[*index as usize];
            self.doors.push((self.walk.station_of(building.access), building.place));
        }
    }

    fn usable(&self) -> f64 {
        (self.walk.length - 2.0 * CORNER_CLEARANCE).max(0.0)
    }

    /// The use of the land behind the sidewalk.
    fn zone(&self, zoning: &mut RememberedZoning<'_>) -> Zone {
        let behind = self.walk.place(self.walk.length * 0.5, 15.0);
        behind.map_or(Zone::default(), |point| zoning.zone(point))
    }

    /// Sets elements of one kind along the kerb at even distances.
    fn line_up(&mut self, kind: EntityKind, density: f64, rng: &mut StreamRng) {
        let usable = self.usable();
        let number = count(usable * density, rng);
        for rank in 0..number {
            let share = (rank as f64 + 0.5) / number as f64;
            self.set(kind, Row::Kerb, CORNER_CLEARANCE + share * usable, rng);
        }
    }

    /// Sets an element at a station if there is room for it.
    fn set(&mut self, kind: EntityKind, row: Row, station: f64, rng: &mut StreamRng) {
        let shape = shape_of(kind, rng);
        let size = shape.size();
        let reach = size.y * 0.5;
        if station - reach < CORNER_CLEARANCE || station + reach > self.walk.length - CORNER_CLEARANCE {
            return;
        }
        let half = self.walk.half;
        match row {
            Row::Kerb => {
                let offset = size.x * 0.5 + KERB_GAP - half;
                let is_clear = offset + size.x * 0.5 <= -FREE_WIDTH * 0.5;
                let span = (station - reach - NEIGHBOUR_GAP, station + reach + NEIGHBOUR_GAP);
                let meets = |other: &(f64, f64)| span.0 < other.1 && other.0 < span.1;
                if is_clear && !self.busy.iter().any(meets) {
                    self.busy.push(span);
                    if let Some((position, facing)) = self.walk.at(station, offset) {
                        let element = Element { kind, position, facing, shape, along: self.along };
                        self.wishes.push(element, Need::Nothing);
                    }
                }
            }
            Row::Back => {
                let offset = half + BACK_GAP + size.x * 0.5;
                self.set_back(Need::Room, (kind, shape), station, offset, 0.0);
            }
        }
    }

    /// Wishes for an element behind the sidewalk if it blocks no door; says whether it did not.
    fn set_back(
        &mut self,
        needs: Need,
        (kind, shape): (EntityKind, Shape),
        station: f64,
        offset: f64,
        turn: f64,
    ) -> bool {
        let reach = shape.size().x.max(shape.size().y) * 0.5;
        let blocks = |door: &(f64, Place)| (door.0 - station).abs() < DOOR_CLEARANCE + reach;
        if self.doors.iter().any(blocks) || self.walk.bends(station - reach, station + reach) {
            return false;
        }
        let Some((position, facing)) = self.walk.at(station, offset) else { return false };
        let facing = turned(facing, turn);
        let element = Element { kind, position, facing, shape, along: self.along };
        self.wishes.push(element, needs);
        true
    }

    /// A table and two chairs beside the door of every other restaurant.
    fn terraces(&mut self, rng: &mut StreamRng) {
        for index in 0..self.doors.len() {
            let (door, place) = self.doors[index];
            if place != Place::Restaurant || rng.chance(0.5) {
                continue;
            }
            let station = door + if rng.chance(0.5) { 2.8 } else { -2.8 };
            let table = shape_of(EntityKind::Table, rng);
            let offset = self.walk.half + BACK_GAP + table.size().x * 0.5;
            if station < CORNER_CLEARANCE
                || station > self.walk.length - CORNER_CLEARANCE
                || !self.set_back(Need::Room, (EntityKind::Table, table), station, offset, 0.0)
            {
                continue;
            }
            for side in [1.0, -1.0] {
                // Chairs look at the table, along the street.
                let chair = shape_of(EntityKind::Chair, rng);
                let at = station + side * 0.75;
                self.set_back(Need::Table, (EntityKind::Chair, chair), at, offset, side * FRAC_PI_2);
            }
        }
    }
}
