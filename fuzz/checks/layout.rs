//! Files of the Python release: any text is refused or gives a city without overlaps.

use simworld_citygen::python::{self, BuildingsFile, ElementsFile, RoadsFile};
use simworld_citygen::{City, CityConfig};
use simworld_core::seed::Seed;

pub(crate) fn check(data: &[u8]) {
    let _ = python::read_world(data);
    let Ok(roads) = python::read::<RoadsFile>(data) else { return };
    // One document may hold all three lists: unknown members are no fault.
    let buildings = python::read::<BuildingsFile>(data).unwrap_or_default();
    let elements = python::read::<ElementsFile>(data).unwrap_or_default();
    let made = City::from_layout(&roads, &buildings, &elements, &CityConfig::default(), Seed(1));
    if let Ok((city, _)) = made {
        assert_eq!(city.report().overlaps, 0);
    }
}
