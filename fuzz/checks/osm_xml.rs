//! OSM XML: any text is refused or gives a city that holds together.

use simworld_citygen::osm::{Place, PlaceOptions};
use simworld_citygen::{City, CityConfig};
use simworld_core::seed::Seed;

pub(crate) fn check(data: &[u8]) {
    let Ok(place) = Place::from_xml(data) else { return };
    let made = City::from_place(&place, &PlaceOptions::default(), &CityConfig::default(), Seed(1));
    if let Ok((city, _)) = made {
        assert_eq!(city.plan.validate(), Ok(()));
        assert_eq!(city.network.check(), Ok(()));
        assert_eq!(city.report().overlaps, 0);
    }
}
