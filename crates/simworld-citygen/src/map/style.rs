//! Colours and widths of the map: muted inks on warm paper. Widths in millimetres on paper.

use simworld_core::net::{LaneKind, RoadClass};
use simworld_core::scene::Place;

use crate::lot::GreenKind;
use crate::zoning::Zone;

/// The sheet.
pub(super) const PAPER: &str = "#faf7f0";
/// Land beyond the city.
pub(super) const LAND: &str = "#e7ead7";
/// Ground between the streets.
pub(super) const BLOCK: &str = "#f3efe4";
/// Raised walkways.
pub(super) const SIDEWALK: &str = "#e2ddd0";
/// The edges of bridges.
pub(super) const BRIDGE_EDGE: &str = "#6e675b";
/// Ways for walkers below what is drawn over them.
pub(super) const PASSAGE: &str = "#8d8271";
/// Crowns of trees.
pub(super) const TREE: &str = "#8fb07a";
/// Lettering and frames.
pub(super) const INK: &str = "#33352f";
/// Lesser lettering.
pub(super) const FAINT: &str = "#7c7a70";
/// Cast by buildings.
pub(super) const SHADOW: &str = "#4a4436";
/// Edges of buildings.
pub(super) const EDGE: &str = "#8d8271";
/// The letters everything is set in; the first is the one that PNG maps have.
pub(super) const FONT: &str = "Roboto, 'Helvetica Neue', Helvetica, Arial, sans-serif";

/// The colour of a building by its use.
pub const fn place_color(place: Place) -> &'static str {
    match place {
        Place::Home => "#d9c7ad",
        Place::Restaurant => "#d9835f",
        Place::Store => "#e2b75e",
        Place::Hospital => "#d77f8d",
        Place::Museum => "#a68cbd",
        Place::School => "#86a9c9",
        Place::Office => "#aab6bf",
        Place::Factory => "#9b9186",
        Place::ChargingStation => "#62aaa6",
        Place::RestArea => "#93b878",
        _ => "#cdc6b8",
    }
}

/// The tint of a lot by its zone.
pub(super) const fn zone_color(zone: Zone) -> &'static str {
    match zone {
        Zone::Residential => BLOCK,
        Zone::Commercial => "#f4e6dc",
        Zone::Industrial => "#e6e2e4",
        Zone::Civic => "#f0e9cf",
        Zone::Park => "#cfdfb2",
    }
}

/// The layer and the tint of a green.
pub(super) const fn green_color(kind: GreenKind) -> (&'static str, &'static str) {
    match kind {
        GreenKind::Park => ("parks", "#cbddae"),
        GreenKind::Courtyard => ("courtyards", "#e3e8cf"),
        GreenKind::Leftover => ("leftovers", BLOCK),
    }
}

/// The id of the layer and the colour of what lies beside the lanes of a street; a median is planted where it is wide
/// enough for it. None of what is drawn otherwise.
pub(super) const fn strip_color(kind: LaneKind, planted: bool) -> Option<(&'static str, &'static str)> {
    match (kind, planted) {
        (LaneKind::Parking, _) => Some(("parking", "#e4e2dc")),
        (LaneKind::Cycle, _) => Some(("cycle-lanes", "#d99f8c")),
        (LaneKind::Shoulder, _) => Some(("shoulders", "#e9e5da")),
        (LaneKind::Median, true) => Some(("planted-medians", "#b9d19a")),
        (LaneKind::Median, false) => Some(("medians", "#cfc8b8")),
        (LaneKind::Verge, _) => Some(("verges", "#c8dbab")),
        (LaneKind::Driving | LaneKind::Bus | LaneKind::Sidewalk, _) => None,
    }
}

/// How a class of road is drawn.
pub(super) struct RoadStyle {
    pub(super) class: RoadClass,
    pub(super) id: &'static str,
    pub(super) label: &'static str,
    pub(super) fill: &'static str,
    pub(super) casing: &'static str,
    /// Narrower roads are drawn this wide.
    pub(super) least: f64,
    /// Size of the letters of its names.
    pub(super) lettering: f64,
}

/// From the lowest class to the highest, in the order in which they are drawn.
pub(super) const ROADS: [RoadStyle; 3] = [
    RoadStyle {
        class: RoadClass::Local,
        id: "local",
        label: "Street",
        fill: "#ffffff",
        casing: "#cbc3b2",
        least: 0.42,
        lettering: 2.1,
    },
    RoadStyle {
        class: RoadClass::Arterial,
        id: "arterial",
        label: "Arterial",
        fill: "#fbe6b4",
        casing: "#cfa95f",
        least: 0.9,
        lettering: 2.6,
    },
    RoadStyle {
        class: RoadClass::Highway,
        id: "highway",
        label: "Highway",
        fill: "#f3b884",
        casing: "#bd7a46",
        least: 1.3,
        lettering: 2.9,
    },
];

/// Casing on each side of a road.
pub(super) const CASING: f64 = 0.11;

pub(super) fn road_style(class: RoadClass) -> &'static RoadStyle {
    ROADS.iter().find(|style| style.class == class).unwrap_or(&ROADS[0])
}
