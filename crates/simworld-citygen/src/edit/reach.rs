//! How far an edit reaches in a running world: on hills the ground follows the streets, and what stands on it with it.

use simworld_core::geometry::{Point2, bounds};
use simworld_core::net::RoadNetwork;

use super::CityEditor;
use super::cells::{Bounds, inflated};
use super::in_world::Things;
use crate::City;
use crate::terrain::REACH;

/// What of a city, before an edit or after it, decides how far the edit reaches.
pub(super) struct View {
    /// Round the roads that changed.
    area: Option<Bounds>,
    /// Round all roads.
    whole: Option<Bounds>,
    is_level: bool,
}

impl View {
    pub(super) fn of(city: &City, things: &Things) -> Self {
        let network = &*city.network;
        let roads = things.roads.roads.iter().filter_map(|road| network.roads.get(*road));
        let area = bounds(roads.flat_map(|road| &road.centerline));
        let land = city.terrain();
        Self {
            area,
            whole: network.bounds(),
            is_level: crate::terrain::Ground::new(network, &land).is_level(),
        }
    }
}

/// What has to be described anew, besides what an edit changed.
pub(super) struct Reach {
    /// Where the ground may lie at another height.
    area: Option<Bounds>,
    /// Whether plates of ground are meant, and from where to where northwards; all of them if that is not said.
    pub(super) plates: bool,
    pub(super) rows: Option<(f64, f64)>,
}

impl Reach {
    pub(super) fn between(then: &View, now: &View) -> Self {
        let corners: Vec<Point2> = then.area.iter().chain(&now.area).flat_map(|(a, b)| [*a, *b]).collect();
        let area = bounds(&corners).map(|area| inflated(area, REACH));
        if then.is_level != now.is_level {
            // Surfaces are laid otherwise on hills: all of them.
            let all = Point2::new(f64::INFINITY, f64::INFINITY);
            return Self {
                area: Some((Point2::new(f64::NEG_INFINITY, f64::NEG_INFINITY), all)),
                plates: true,
                rows: None,
            };
        }
        let grew = then.whole != now.whole;
        if now.is_level {
            return Self { area: None, plates: grew, rows: None };
        }
        let rows = area.filter(|_| !grew).map(|(low, high)| (low.y, high.y));
        Self { area, plates: grew || rows.is_some(), rows }
    }

    /// Adds what stands on the ground that may lie at another height.
    pub(super) fn widen(&self, editor: &CityEditor, things: &mut Things) {
        let Some(area) = self.area else { return };
        let city = editor.city();
        let network: &RoadNetwork = &city.network;
        let touches = |points: &[Point2]| bounds(points).is_some_and(|around| overlap(around, area));
        let (roads, added) = (&network.roads, &mut things.roads);
        // Each by its own place: what an edit leaves alone is there before it and after it.
        added.roads.extend((0..roads.len()).filter(|road| touches(&roads[*road].centerline)));
        let walks = &network.sidewalks;
        added.sidewalks.extend((0..walks.len()).filter(|walk| touches(&walks[*walk].path)));
        let crossings = &network.crossings;
        added.crossings.extend(
            (0..crossings.len())
                .filter(|number| touches(&[crossings[*number].start, crossings[*number].end])),
        );
        let ways = &network.footpaths;
        added.footpaths.extend((0..ways.len()).filter(|way| touches(&ways[*way].path)));
        let places = &network.intersections;
        let near = |number: &usize| {
            let place = &places[*number];
            touches(&[place.center]) || place.corners.iter().any(|corner| touches(corner))
        };
        added.intersections.extend((0..places.len()).filter(near));
        let buildings = &city.buildings;
        things.buildings.extend((0..buildings.len()).filter(|number| touches(&[buildings[*number].access])));
        let elements = &city.elements;
        things.elements.extend((0..elements.len()).filter(|number| touches(&[elements[*number].position])));
    }
}

fn overlap(a: Bounds, b: Bounds) -> bool {
    a.0.x <= b.1.x && b.0.x <= a.1.x && a.0.y <= b.1.y && b.0.y <= a.1.y
}
