//! What a spec wishes for beyond the city, as things that find lots, and what such places do not have.

use simworld_core::asset::Catalogue;
use simworld_core::geometry::Vector2;
use simworld_core::scene::Place;
use simworld_core::spec::{Amount, Height, SceneKind, SceneSpec, Water};

use super::LandscapeError;
use super::lots::{Built, Wish};

/// Houses of a countryside for which no number is said: a hamlet and some farms.
const HAMLET: u32 = 14;
/// Along and across a square and a park, m; as in towns.
const SQUARE: (f64, f64) = (26.0, 32.0);
const PARK: (f64, f64) = (36.0, 46.0);
/// What people live in, by turns; every fifth and sixth are a farm.
const HOMES: [&str; 6] = ["cottage", "house", "bungalow", "cottage", "farmhouse", "barn"];

/// What finds lots along roads, the first first.
pub(super) fn along_roads(spec: &SceneSpec, library: &Catalogue) -> Vec<Wish> {
    let places: u32 = spec.features.places.values().sum();
    let open = !spec.features.squares.is_empty() || !spec.features.parks.is_empty();
    let count = spec.buildings.count.unwrap_or(match spec.kind {
        SceneKind::Countryside => HAMLET.max(places),
        _ if open => HAMLET.max(places),
        _ => places,
    });
    let mut wishes = Vec::new();
    for (names, used_as, (depth, width)) in
        [(&spec.features.squares, "square", SQUARE), (&spec.features.parks, "park", PARK)]
    {
        let size = Vector2::new(depth, width);
        wishes.extend(names.iter().map(|name| Wish {
            what: Built::Open(used_as),
            name: Some(name.clone()),
            size,
        }));
    }
    for (place, number) in &spec.features.places {
        for rank in 0..*number {
            let name = name_of(*place, rank, spec.title.as_deref());
            wishes.extend(Wish::house(library, asset_of(*place), Some(*place)).map(|wish| wish.named(name)));
        }
    }
    let homes = HOMES.iter().filter(|name| spec.buildings.height != Height::Low || **name != "house");
    let homes = homes.cycle().take(count.saturating_sub(places) as usize);
    wishes.extend(homes.filter_map(|name| Wish::house(library, name, None)));
    wishes
}

/// Which building of the library a use has in the country.
const fn asset_of(place: Place) -> &'static str {
    match place {
        Place::Restaurant => "pub",
        Place::Store => "shop",
        Place::Hospital => "clinic",
        Place::Museum => "gallery",
        Place::School => "school",
        Place::Office => "post_office",
        Place::Factory => "workshop",
        Place::ChargingStation => "charging_station",
        Place::RestArea => "rest_pavilion",
        _ => "cottage",
    }
}

fn name_of(place: Place, rank: u32, title: Option<&str>) -> String {
    let mut word = place.as_str().replace('_', " ");
    if let Some(first) = word.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    match rank {
        0 => format!("{} {word}", title.unwrap_or("Village")),
        _ => format!("{word} {}", rank + 1),
    }
}

/// What such a place does not have.
pub(super) fn refuse(spec: &SceneSpec) -> Result<(), LandscapeError> {
    let kind = spec.kind.as_str();
    let no = |what: &str, instead| Err(LandscapeError::Unsuited { kind, what: what.to_owned(), instead });
    if spec.kind == SceneKind::City {
        return Err(LandscapeError::City);
    }
    if spec.buildings.height == Height::High {
        return no("tall buildings", "ask for a city, or for low houses");
    }
    if spec.streets.parked == Amount::Many {
        return no("rows of parked cars", "ask for a town, or leave them out");
    }
    if !spec.features.districts.is_empty() {
        return no("districts", "ask for a city");
    }
    if !spec.features.sites.is_empty() {
        return no("sites that are said beforehand", "leave them out, or ask for a city");
    }
    let wild = spec.kind == SceneKind::Wilderness;
    if wild && !spec.features.squares.is_empty() {
        return no("squares", "ask for a countryside with a village");
    }
    if wild && !spec.features.parks.is_empty() {
        return no("parks", "all of it is green; ask for a countryside with a village");
    }
    if wild && spec.features.places.values().any(|count| *count > 0) {
        return no("places of business", "ask for huts, or for a countryside");
    }
    if wild && spec.streets.count.is_some() {
        return no("streets", "ask for a countryside");
    }
    if wild && spec.buildings.count.is_some_and(|count| count > 8) {
        return no("more than 8 huts", "ask for a countryside with so many houses");
    }
    let waters = &spec.features.waters;
    if spec.kind == SceneKind::Island && waters.contains(&Water::River) {
        return no("rivers", "ask for a lake, or for a countryside with a river");
    }
    if spec.kind != SceneKind::Island && waters.contains(&Water::Harbour) {
        return no("harbours", "ask for an island or a harbour town");
    }
    let twice = |water| waters.iter().filter(|own| **own == water).count() > 1;
    if twice(Water::Lake) || twice(Water::River) {
        return no("second water of a kind", "ask for one lake and one river");
    }
    Ok(())
}
