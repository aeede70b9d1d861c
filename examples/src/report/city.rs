//! The city under everything that is drawn on the page: once in the page, and used by each map.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use simworld_citygen::City;
use simworld_core::geometry::{Point2, bounds};
use simworld_core::id::EntityId;
use simworld_core::net::{Road, polyline};
use simworld_core::scene::{Place, World, WorldError};

use super::frame::Frame;

/// Land around the streets, m.
const MARGIN: f64 = 40.0;
/// Sidewalk and kerb on each side of a street, m.
const KERB: f64 = 3.0;
/// With more buildings than this their outlines are left out: nobody sees them, and the page would be large.
const MOST_BUILDINGS: usize = 8000;

/// The map of a city, and where its buildings are.
pub(super) struct CityMap {
    /// What it shows.
    pub(super) frame: Frame,
    /// Streets and buildings, as elements of SVG.
    pub(super) drawing: String,
    sites: BTreeMap<EntityId, Site>,
}

/// A building that somebody orders from or to.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Site {
    /// Where one stands before its entrance, m.
    pub(super) access: Point2,
    /// What people call it, or what it is and where.
    pub(super) name: String,
}

impl CityMap {
    /// Draws a city.
    ///
    /// # Errors
    /// The world refused its entities, whose numbers tell which building is which.
    pub(super) fn of(city: &City) -> Result<Self, WorldError> {
        let mut world = World::new();
        let entities = city.populate(&mut world)?;
        let (low, high) = city.network.bounds().unwrap_or((Point2::origin(), Point2::origin()));
        let frame = Frame::around(low, high, MARGIN);
        let site = |index: usize| {
            let building = &city.buildings[index];
            let name = building.name.clone().unwrap_or_else(|| {
                let what = building.place.as_str().replace('_', " ");
                street(city, building.access).map_or(what.clone(), |street| format!("{what} on {street}"))
            });
            Site { access: building.access, name }
        };
        let wanted = |place| matches!(place, Place::Restaurant | Place::Home | Place::Store);
        let sites = entities.buildings.iter().enumerate();
        let sites = sites.filter(|(index, _)| wanted(city.buildings[*index].place));
        let sites = sites.map(|(index, id)| (*id, site(index))).collect();
        Ok(Self { frame, drawing: draw(city, &frame), sites })
    }

    /// A building by its entity.
    pub(super) fn site(&self, id: EntityId) -> Option<&Site> {
        self.sites.get(&id)
    }
}

/// The name of the street that passes nearest to a point.
fn street(city: &City, point: Point2) -> Option<&str> {
    let near = |road: &&Road| {
        let (low, high) = bounds(road.centerline.iter()).unwrap_or((point, point));
        let reach = 60.0;
        point.x > low.x - reach
            && point.x < high.x + reach
            && point.y > low.y - reach
            && point.y < high.y + reach
    };
    let distance =
        |road: &Road| polyline::closest(&road.centerline, &point).map_or(f64::INFINITY, |at| at.distance);
    let roads = city.network.roads.iter().filter(near).filter(|road| road.name.is_some());
    let nearest = roads.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    city.network.names.get(nearest.name? as usize).map(String::as_str)
}

fn draw(city: &City, frame: &Frame) -> String {
    let mut streets: BTreeMap<i64, String> = BTreeMap::new();
    for road in &city.network.roads {
        let line = frame.line(&polyline::offset(&road.centerline, (road.left_kerb - road.right_kerb) * 0.5));
        streets.entry((road.width * 10.0).round() as i64).or_default().push_str(&line);
    }
    let mut text = String::new();
    // Writing to a string cannot fail.
    for (class, wider) in [("kerb", (2.0 * KERB * 10.0) as i64), ("street", 0)] {
        for (width, line) in &streets {
            let _ = write!(text, "<path class={class} stroke-width={} d=\"{line}\"/>", width + wider);
        }
    }
    let junctions: String =
        city.network.intersections.iter().map(|place| frame.area(&place.outline)).collect();
    let _ = write!(text, "<path class=junction d=\"{junctions}\"/>");
    if city.buildings.len() <= MOST_BUILDINGS {
        for (class, wanted) in [("house", false), ("restaurant", true)] {
            let buildings =
                city.buildings.iter().filter(|building| (building.place == Place::Restaurant) == wanted);
            let outlines: String = buildings.map(|building| frame.area(&building.outline())).collect();
            let _ = write!(text, "<path class={class} d=\"{outlines}\"/>");
        }
    }
    text
}
