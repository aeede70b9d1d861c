//! What a building is used for, how high it is, what it is called.

use simworld_core::scene::Place as Use;

use crate::building::{ARCHETYPES, Archetype, RoofKind, STOREY};
use crate::osm::tags::{Key, Tags};
use crate::zoning::Zone;

/// Most storeys.
const MOST_STOREYS: u32 = 200;
/// A dwelling of a smaller area is a house, m².
const HOUSE: f64 = 160.0;

/// What tags say of a building.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::osm) struct Usage {
    pub(in crate::osm) place: Use,
    /// Whether tags say so; a building of unknown use is taken for a dwelling.
    pub(in crate::osm) is_known: bool,
    pub(in crate::osm) name: Option<String>,
    pub(in crate::osm) storeys: u32,
    pub(in crate::osm) roof: RoofKind,
}

/// Whether tags are those of a building that stands on the ground.
pub(in crate::osm) fn is_building(tags: &Tags<'_>) -> bool {
    let is_open =
        tags.is_any(Key::Building, &["roof", "carport", "no", "ruins", "collapsed", "tent", "canopy"]);
    let is_below = tags.is_any(Key::Location, &["underground", "subsurface"])
        || tags.get(Key::Layer).is_some_and(|layer| layer.starts_with('-'));
    tags.has(Key::Building) && !is_open && !is_below
}

/// The use that tags name; of a building or of a point inside one.
pub(in crate::osm) fn use_of(tags: &Tags<'_>) -> Option<Use> {
    let amenity = tags.get(Key::Amenity).and_then(|value| {
        Some(match value {
            "restaurant" | "cafe" | "fast_food" | "bar" | "pub" | "food_court" | "ice_cream"
            | "biergarten" => Use::Restaurant,
            "hospital" | "clinic" | "doctors" | "dentist" | "nursing_home" => Use::Hospital,
            "school" | "university" | "college" | "kindergarten" | "library" | "language_school" => {
                Use::School
            }
            "bank" | "townhall" | "courthouse" | "police" | "fire_station" | "post_office"
            | "public_building" | "embassy" | "community_centre" => Use::Office,
            "pharmacy" | "marketplace" | "fuel" => Use::Store,
            "theatre" | "cinema" | "arts_centre" | "place_of_worship" => Use::Museum,
            "charging_station" => Use::ChargingStation,
            "shelter" => Use::RestArea,
            _ => return None,
        })
    });
    let tourism = tags.get(Key::Tourism).and_then(|value| {
        Some(match value {
            "museum" | "gallery" | "attraction" | "aquarium" => Use::Museum,
            "hotel" | "hostel" | "guest_house" | "apartment" | "motel" => Use::Home,
            _ => return None,
        })
    });
    amenity
        .or(tourism)
        .or_else(|| tags.has(Key::Healthcare).then_some(Use::Hospital))
        .or_else(|| tags.has(Key::Shop).then_some(Use::Store))
        .or_else(|| tags.has(Key::Office).then_some(Use::Office))
}

/// The use that the value of `building` means: <https://wiki.openstreetmap.org/wiki/Key:building>.
fn use_of_building(value: &str) -> Option<Use> {
    Some(match value {
        "apartments" | "house" | "residential" | "detached" | "terrace" | "semidetached_house"
        | "dormitory" | "hotel" | "bungalow" | "cabin" | "farm" | "garage" | "garages" | "hut" | "shed" => {
            Use::Home
        }
        "retail" | "supermarket" | "kiosk" | "shop" => Use::Store,
        "commercial" | "office" | "government" | "public" | "civic" | "train_station" | "transportation"
        | "fire_station" => Use::Office,
        "industrial" | "warehouse" | "factory" | "manufacture" | "hangar" | "service" => Use::Factory,
        "hospital" | "clinic" => Use::Hospital,
        "school" | "university" | "college" | "kindergarten" => Use::School,
        "museum" | "church" | "cathedral" | "chapel" | "mosque" | "synagogue" | "temple" | "castle"
        | "theatre" => Use::Museum,
        _ => return None,
    })
}

impl Usage {
    pub(in crate::osm) fn of(tags: &Tags<'_>, area: f64) -> Self {
        let named = use_of(tags);
        let found = named.or_else(|| use_of_building(tags.get(Key::Building)?));
        let place = found.unwrap_or(Use::Home);
        Self {
            place,
            is_known: found.is_some(),
            name: tags.get(Key::Name).filter(|name| !name.is_empty()).map(str::to_owned),
            storeys: storeys(tags, place, area),
            roof: roof(tags),
        }
    }
}

/// Storeys as tagged, or from the height, or as usual for the use and the size.
fn storeys(tags: &Tags<'_>, place: Use, area: f64) -> u32 {
    let tagged = tags.count(Key::BuildingLevels).filter(|levels| *levels > 0);
    let from_height = || tags.metres(Key::Height).map(|height| (height / STOREY).round().max(1.0) as u32);
    let is_low = tags.is_any(
        Key::Building,
        &["house", "detached", "bungalow", "garage", "garages", "hut", "shed", "kiosk", "cabin", "service"],
    );
    let usual = || match place {
        _ if is_low && area < HOUSE => 1 + u32::from(area > 70.0),
        Use::Home if area < HOUSE => 2,
        Use::Home | Use::Office | Use::Hospital => 4,
        Use::School => 3,
        Use::Factory => 1,
        _ => 2,
    };
    tagged.or_else(from_height).unwrap_or_else(usual).min(MOST_STOREYS)
}

fn roof(tags: &Tags<'_>) -> RoofKind {
    match tags.get(Key::RoofShape) {
        Some("gabled" | "half-hipped" | "gambrel" | "saltbox") => RoofKind::Gable,
        Some("hipped" | "pyramidal" | "mansard") => RoofKind::Hip,
        Some("skillion") => RoofKind::Shed,
        _ => RoofKind::Flat,
    }
}

/// The zone in which such a building stands.
pub(in crate::osm) const fn zone_of(place: Use) -> Zone {
    match place {
        Use::Restaurant | Use::Store | Use::Office => Zone::Commercial,
        Use::Hospital | Use::Museum | Use::School => Zone::Civic,
        Use::Factory | Use::ChargingStation => Zone::Industrial,
        Use::RestArea => Zone::Park,
        _ => Zone::Residential,
    }
}

/// The kind of building of that use that is nearest in size and height; the first of equals.
pub(in crate::osm) fn archetype_of(place: Use, width: f64, depth: f64, storeys: u32) -> &'static Archetype {
    let off = |x: f64, (low, high): (f64, f64)| ((low - x) / low).max((x - high) / high).max(0.0);
    let away = |kind: &Archetype| {
        let (low, high) = kind.storeys;
        let height = off(f64::from(storeys), (f64::from(low), f64::from(high)));
        height + 0.5 * (off(width, kind.width) + off(depth, kind.depth))
    };
    let of_use = ARCHETYPES.iter().filter(|kind| kind.place == place);
    of_use.min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(&ARCHETYPES[0])
}
