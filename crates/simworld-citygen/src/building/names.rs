//! Names of places, drawn from word lists.

use std::collections::BTreeSet;

use simworld_core::scene::Place;
use simworld_core::seed::StreamRng;

const EPITHETS: &[&str] = &[
    "Harbour",
    "Linden",
    "Old Mill",
    "Northgate",
    "Riverside",
    "Maple",
    "Station",
    "Market",
    "Garden",
    "Castle",
    "Bridge",
    "Cedar",
    "Union",
    "Canal",
    "Meadow",
    "Foundry",
    "Orchard",
    "Lantern",
    "Copper",
    "Willow",
    "Granite",
    "Beacon",
    "Clover",
    "Juniper",
    "Sunset",
    "Chapel",
    "Quarry",
    "Heron",
    "Ivy",
    "Amber",
];

/// What a place is called after its epithet; `None` for places that bear no name.
const fn noun(place: Place) -> Option<&'static [&'static str]> {
    match place {
        Place::Restaurant => Some(&["Kitchen", "Bistro", "Grill", "Noodle House", "Table", "Diner"]),
        Place::Store => Some(&["Market", "Store", "Grocery", "Corner Shop"]),
        Place::Hospital => Some(&["Hospital", "Clinic"]),
        Place::Museum => Some(&["Museum", "Gallery"]),
        Place::School => Some(&["School", "Academy"]),
        Place::Office => Some(&["House", "Tower", "Exchange"]),
        Place::Factory => Some(&["Works", "Warehouse"]),
        Place::ChargingStation => Some(&["Charging Station"]),
        Place::RestArea => Some(&["Pavilion", "Rest Area"]),
        _ => None,
    }
}

/// A name that is not yet in use; a number is added when the words run out.
pub(super) fn draw(place: Place, used: &mut BTreeSet<String>, rng: &mut StreamRng) -> Option<String> {
    let nouns = noun(place)?;
    for attempt in 0..64_u32 {
        let epithet = EPITHETS[rng.below(EPITHETS.len())];
        let noun = nouns[rng.below(nouns.len())];
        let name = match attempt {
            0..8 => format!("{epithet} {noun}"),
            _ => format!("{epithet} {noun} {}", 2 + rng.below(10_000)),
        };
        if used.insert(name.clone()) {
            return Some(name);
        }
    }
    None
}
