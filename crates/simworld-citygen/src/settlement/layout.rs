//! Whatever needs ground of its own: landmarks, squares and parks, each where it is wished for or near the middle, and water beside
//! the place. What stands there is taken away.

use simworld_core::asset::{Asset, Catalogue};
use simworld_core::geometry::{Obb, Point2, Vector2, direction, heading};
use simworld_core::net::{RoadNetwork, polyline};
use simworld_core::scene::EntityKind;
use simworld_core::spec::{FeatureWish, SiteWish};

use super::aim::Aim;
use super::areas::{Area, shore};
use super::extent::Extent;
use super::landmarks::{Landmark, ground_box, lies_within, name_of};
use super::{SettlementError, SettlementRemark};
use crate::City;
use crate::doors::{FARTHEST_DOOR, nearest_of};

/// Along and across a square and a park, m.
const SQUARE: (f64, f64) = (32.0, 26.0);
const PARK: (f64, f64) = (46.0, 36.0);
/// Between such ground and the sidewalks around it, m.
const ROOM: f64 = 1.0;
/// Places are tried so far from each other, m.
const STEP: f64 = 8.0;
/// A landmark for which no block is large enough is tried in these sizes.
const SCALES: [f64; 4] = [1.0, 0.8, 0.65, 0.5];
/// A house that has to go is as bad as so many metres off, m.
const HOUSE: f64 = 6.0;
/// Streets farther than this lead nowhere near, m; where no block is large enough that is meant of the front of a landmark.
const REACH: f64 = 60.0;
const FRONT: f64 = 40.0;

/// Where there may be ground for landmarks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Grounds {
    /// Between the streets.
    Within,
    /// For those that no block holds beyond the outermost streets too.
    Beyond,
}

/// What was laid out.
#[derive(Debug, Default)]
pub(super) struct Laid {
    pub(super) areas: Vec<Area>,
    pub(super) landmarks: Vec<Landmark>,
    pub(super) remarks: Vec<SettlementRemark>,
}

/// What is to be laid out.
struct Item<'a> {
    name: String,
    /// What a site that is beside it calls it.
    key: &'a str,
    what: What<'a>,
    site: Option<&'a SiteWish>,
}

#[derive(Clone, Copy)]
enum What<'a> {
    Square,
    Park,
    Landmark(&'a Asset),
}

/// Lays all of it out.
pub(super) fn laid_out(
    city: &mut City,
    wish: &FeatureWish,
    (extent, grounds): (Extent, Grounds),
    library: &Catalogue,
) -> Result<Laid, SettlementError> {
    let mut pending = items(wish, library)?;
    let shores: Vec<Area> = shores(wish, &city.network).collect();
    let water = shores.iter().map(|area| ground_box(area.middle, area.facing, area.size)).collect();
    let (taken, laid) = (Vec::new(), Laid::default());
    let mut layout = Layout { city: &mut *city, wish, extent, grounds, taken, water, laid };
    while !pending.is_empty() {
        // What is beside another comes after it.
        let waits = |item: &Item<'_>| {
            let by = item.site.and_then(|site| site.by.as_deref());
            by.is_some_and(|by| by != item.key && pending.iter().any(|other| other.key == by))
        };
        let next = pending.iter().position(|item| !waits(item)).unwrap_or(0);
        let item = pending.remove(next);
        layout.lay(&item)?;
    }
    let Layout { mut laid, .. } = layout;
    laid.areas.extend(shores);
    Ok(laid)
}

/// The waters, which lie beside the streets.
fn shores(wish: &FeatureWish, network: &RoadNetwork) -> impl Iterator<Item = Area> {
    wish.waters.iter().enumerate().filter_map(move |(rank, water)| shore(network, *water, rank))
}

/// Landmarks, squares and parks, each with its site if it has one.
fn items<'a>(wish: &'a FeatureWish, library: &'a Catalogue) -> Result<Vec<Item<'a>>, SettlementError> {
    let mut items = Vec::new();
    for (key, count) in &wish.landmarks {
        let asset = library.find(key).and_then(|id| library.get(id));
        let asset = asset.filter(|asset| asset.kind == EntityKind::Building);
        let asset = asset.ok_or_else(|| SettlementError::Landmark { name: key.clone() })?;
        let mut sites = wish.sites.iter().filter(|site| site.what == *key);
        for rank in 0..*count {
            let (name, what, site) = (name_of(key, rank), What::Landmark(asset), sites.next());
            items.push(Item { name, key: key.as_str(), what, site });
        }
    }
    let squares = wish.squares.iter().map(|name| (name, "square", What::Square));
    let parks = wish.parks.iter().map(|name| (name, "park", What::Park));
    for (name, key, what) in squares.chain(parks) {
        let site = wish.sites.iter().find(|site| site.what == *name);
        items.push(Item { name: name.clone(), key, what, site });
    }
    Ok(items)
}

struct Layout<'a> {
    city: &'a mut City,
    wish: &'a FeatureWish,
    extent: Extent,
    grounds: Grounds,
    taken: Vec<Obb>,
    /// Where water will be.
    water: Vec<Obb>,
    laid: Laid,
}

impl Layout<'_> {
    fn lay(&mut self, item: &Item<'_>) -> Result<(), SettlementError> {
        let aim = self.aim(item);
        let no_room = || SettlementError::NoGround { name: item.name.clone() };
        let middle = match item.what {
            What::Landmark(asset) => self.raise(item, asset, &aim).ok_or_else(no_room)?,
            What::Square => self.open(item, "square", SQUARE, &aim).ok_or_else(no_room)?,
            What::Park => self.open(item, "park", PARK, &aim).ok_or_else(no_room)?,
        };
        self.laid.remarks.extend(remarks(&item.name, item.site, &aim, middle));
        Ok(())
    }

    fn aim(&self, item: &Item<'_>) -> Aim {
        if let Some(site) = item.site {
            return Aim::of(site, self.extent, &self.wish.waters, &self.city.buildings, &self.laid);
        }
        let middle = match (item.what, self.city.network.bounds()) {
            (What::Square | What::Park, Some((low, high))) => Point2::from((low.coords + high.coords) * 0.5),
            _ => self.extent.heart,
        };
        Aim::near(self.extent, middle)
    }

    /// Opens ground, and says where.
    fn open(
        &mut self,
        item: &Item<'_>,
        used_as: &'static str,
        (along, across): (f64, f64),
        aim: &Aim,
    ) -> Option<Point2> {
        let size = Vector2::new(along, across);
        let (middle, facing) = self.find(size, false, aim, Grounds::Within)?;
        // A park keeps its trees, and a square nothing.
        self.clear(ground_box(middle, facing, size), used_as == "park");
        self.laid.areas.push(Area { name: item.name.clone(), used_as, middle, size, facing });
        Some(middle)
    }

    /// Puts a landmark somewhere, as large as there is room for, and says where: between the streets rather than beyond them.
    fn raise(&mut self, item: &Item<'_>, asset: &Asset, aim: &Aim) -> Option<Point2> {
        let beyond = (self.grounds == Grounds::Beyond).then_some(Grounds::Beyond);
        let tries = std::iter::once(Grounds::Within).chain(beyond);
        let found =
            tries.flat_map(|grounds| SCALES.map(|scale| (grounds, scale))).find_map(|(grounds, scale)| {
                let size = asset.footprint() * scale;
                let (middle, facing) = self.find(size, true, aim, grounds)?;
                Some((grounds, scale, size, middle, facing))
            });
        let (grounds, scale, size, middle, facing) = found?;
        if grounds == Grounds::Beyond && reaches_out(&self.city.network, &ground_box(middle, facing, size)) {
            self.laid.remarks.push(SettlementRemark::Outside { name: item.name.clone() });
        }
        if scale < 1.0 {
            let percent = (scale * 100.0).round() as u32;
            self.laid.remarks.push(SettlementRemark::Smaller { name: item.name.clone(), percent });
        }
        self.clear(ground_box(middle, facing, size), false);
        let network = &self.city.network;
        let front = middle + direction(facing) * (size.x * 0.5);
        let door = nearest_of(network, 0..network.sidewalks.len() as u32, front, FARTHEST_DOOR);
        self.laid.landmarks.push(Landmark {
            asset: asset.name.clone(),
            name: item.name.clone(),
            middle,
            facing,
            scale,
            access: door.map(|door| door.at),
        });
        Some(middle)
    }

    /// Takes away what stands somewhere, and keeps the ground from others.
    fn clear(&mut self, taken: Obb, keeps_trees: bool) {
        let is_on_it = |other: &Obb| other.footprints_overlap(&taken);
        self.city.buildings.retain(|building| !building.solids().any(|solid| is_on_it(&solid)));
        self.city
            .elements
            .retain(|element| keeps_trees && element.kind == EntityKind::Tree || !is_on_it(&element.obb()));
        self.taken.push(taken);
    }

    /// The ground that is best by where it lies and by how little has to go: its middle, and where it looks. With a front it looks to
    /// the street, and else along it or across.
    fn find(&self, size: Vector2, has_front: bool, aim: &Aim, grounds: Grounds) -> Option<(Point2, f64)> {
        let network = &self.city.network;
        let (low, high) = network.bounds()?;
        let (margin, reach) = match grounds {
            Grounds::Within => (0.0, REACH),
            Grounds::Beyond => (size.max(), size.x * 0.5 + FRONT),
        };
        let (low, high) = (low - Vector2::repeat(margin), high + Vector2::repeat(margin));
        let steps = ((high - low) / STEP).map(f64::ceil);
        let mut best: Option<(f64, Point2, f64)> = None;
        for row in 0..=steps.y as u32 {
            for column in 0..=steps.x as u32 {
                let at = low + Vector2::new(f64::from(column), f64::from(row)) * STEP;
                let cost = aim.cost(at);
                if best.is_some_and(|(least, ..)| cost >= least) {
                    continue;
                }
                let Some((along, foot)) = street_beside(network, at, reach) else { continue };
                let across = along + std::f64::consts::FRAC_PI_2;
                let turned =
                    if (foot - at).dot(&direction(across)) < 0.0 { std::f64::consts::PI } else { 0.0 };
                let facings = match (has_front, grounds) {
                    // The nearest street may end there, and lead to it with its end.
                    (true, Grounds::Beyond) => vec![heading(&(foot - at))],
                    (true, Grounds::Within) => vec![across + turned],
                    (false, _) => vec![along, across],
                };
                for facing in facings {
                    let taken = ground_box(at, facing, size);
                    let houses = self.city.buildings.iter();
                    let gone = houses.filter(|one| one.obb().footprints_overlap(&taken)).count();
                    let cost = cost + HOUSE * gone as f64;
                    let is_better = best.is_none_or(|(least, ..)| cost < least);
                    let is_dry = grounds == Grounds::Within || !self.is_wet(&taken);
                    if is_better && is_dry && self.is_open(&taken) {
                        best = Some((cost, at, facing));
                    }
                }
            }
        }
        best.map(|(_, at, facing)| (at, facing))
    }

    /// Whether water will lie there, which is beside the streets.
    fn is_wet(&self, taken: &Obb) -> bool {
        self.water.iter().any(|water| water.footprints_overlap(taken))
    }

    /// Whether no street and nothing else that was laid out lies there.
    fn is_open(&self, taken: &Obb) -> bool {
        if self.taken.iter().any(|other| other.footprints_overlap(taken)) {
            return false;
        }
        let network = &self.city.network;
        let meets = network.intersections.iter().any(|junction| {
            // Corners are round, and dead ends end in circles that are wider than their street.
            let reach = junction.outline.iter().map(|at| (at - junction.center).norm()).fold(0.0, f64::max);
            let circle = junction.turning.as_ref();
            let circle = circle.map(|circle| (circle.center, circle.radius + ROOM));
            [Some((junction.center, reach + ROOM)), circle].into_iter().flatten().any(|(middle, radius)| {
                ground_box(middle, 0.0, Vector2::repeat(2.0 * radius)).footprints_overlap(taken)
            })
        });
        !meets
            && network.roads.iter().all(|road| {
                let widest =
                    road.sidewalks.into_iter().flatten().map(|walk| network.sidewalks[walk.index()].width);
                let reach = road.left_kerb.max(road.right_kerb) + widest.fold(0.0, f64::max) + ROOM;
                road.centerline.windows(2).all(|piece| {
                    let way = piece[1] - piece[0];
                    let middle = piece[0] + way * 0.5;
                    let strip = Vector2::new(way.norm() + 2.0 * reach, 2.0 * reach);
                    !ground_box(middle, heading(&way), strip).footprints_overlap(taken)
                })
            })
    }
}

/// Whether something lies beyond the outermost streets, at least in part.
fn reaches_out(network: &RoadNetwork, taken: &Obb) -> bool {
    network.bounds().is_some_and(|(low, high)| !lies_within(taken, low, high))
}

/// The direction of the nearest street and its nearest point, if one is near enough to lead there.
fn street_beside(network: &RoadNetwork, at: Point2, reach: f64) -> Option<(f64, Point2)> {
    let near = network.roads.iter().filter_map(|road| {
        let near = polyline::closest(&road.centerline, &at)?;
        let (foot, along) = polyline::at(&road.centerline, near.station);
        Some((near.distance, along, foot))
    });
    let (distance, along, foot) = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (distance <= reach).then_some((along, foot))
}

/// What is otherwise than a site says.
pub(super) fn remarks(name: &str, site: Option<&SiteWish>, aim: &Aim, at: Point2) -> Vec<SettlementRemark> {
    let Some(site) = site else { return Vec::new() };
    let name = || name.to_owned();
    let elsewhere =
        (!aim.is_in_part(at)).then(|| SettlementRemark::Elsewhere { name: name(), part: site.at.as_str() });
    let apart = aim.too_far(at).zip(site.by.clone());
    let apart = apart.map(|(distance, by)| SettlementRemark::Apart { name: name(), by, distance });
    elsewhere.into_iter().chain(apart).collect()
}
