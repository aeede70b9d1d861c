//! OpenDRIVE: any text is refused or gives a plan that can be built.

use simworld_citygen::files::opendrive::OpenDrive;
use simworld_citygen::{City, CityConfig};
use simworld_core::seed::Seed;

pub(crate) fn check(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let Ok(read) = OpenDrive::from_xml(text) else { return };
    assert_eq!(read.plan.validate(), Ok(()));
    // Cities of a few streets say as much as large ones, in less time.
    if read.plan.streets.len() <= 40
        && let Ok(city) = City::from_opendrive(&read, &CityConfig::default(), Seed(1))
    {
        assert_eq!(city.network.check(), Ok(()));
        assert_eq!(city.report().overlaps, 0);
    }
}
