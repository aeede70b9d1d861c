//! Local metres and geographic coordinates: a plane that touches the WGS 84 ellipsoid at the origin of a city.
//!
//! East and north are measured along the circles of curvature of the ellipsoid at the origin (Snyder, *Map
//! Projections: A Working Manual*, USGS 1987, equations 4-19 and 4-20). Ten kilometres away the plane is less than
//! 20 m off, at latitudes below 60°; the two directions are exact inverses of each other.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::ops;

/// Semi-major axis of WGS 84, m.
const SEMI_MAJOR: f64 = 6_378_137.0;
/// First eccentricity of WGS 84, squared.
const ECCENTRICITY_SQUARED: f64 = 0.006_694_379_990_141_316;

/// The point of the Earth at the origin of a city's plane, WGS 84, degrees.
///
/// ```
/// use simworld_citygen::GeoOrigin;
/// use simworld_core::geometry::Point2;
/// let monaco = GeoOrigin { latitude: 43.7384, longitude: 7.4246 };
/// let [longitude, latitude] = monaco.to_geographic(Point2::new(0.0, 1111.0));
/// assert!((latitude - 43.7484).abs() < 1e-4 && longitude == 7.4246);
/// assert!((monaco.to_local([longitude, latitude]) - Point2::new(0.0, 1111.0)).norm() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GeoOrigin {
    /// Degrees north of the equator, in [-85, 85]: towards the poles a plane of east and north has no meaning.
    pub latitude: f64,
    /// Degrees east of Greenwich, in [-180, 180].
    pub longitude: f64,
}

impl GeoOrigin {
    /// Whether both angles are in range; NaN is not.
    pub fn is_valid(&self) -> bool {
        (-85.0..=85.0).contains(&self.latitude) && (-180.0..=180.0).contains(&self.longitude)
    }

    /// Metres a degree of longitude and a degree of latitude at the origin.
    pub(crate) fn metres_per_degree(&self) -> (f64, f64) {
        let (sin, cos) = ops::sin_cos(self.latitude.to_radians());
        let flattening = 1.0 - ECCENTRICITY_SQUARED * sin * sin;
        let prime_vertical = SEMI_MAJOR / flattening.sqrt();
        let meridian = prime_vertical * (1.0 - ECCENTRICITY_SQUARED) / flattening;
        let degree = std::f64::consts::PI / 180.0;
        (prime_vertical * cos * degree, meridian * degree)
    }

    /// Longitude and latitude of a point of the plane, degrees, in the order of GeoJSON.
    pub fn to_geographic(&self, point: Point2) -> [f64; 2] {
        let (east, north) = self.metres_per_degree();
        [self.longitude + point.x / east, self.latitude + point.y / north]
    }

    /// The point of the plane at a longitude and latitude, degrees.
    pub fn to_local(&self, [longitude, latitude]: [f64; 2]) -> Point2 {
        let (east, north) = self.metres_per_degree();
        Point2::new((longitude - self.longitude) * east, (latitude - self.latitude) * north)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_degree_has_its_length() {
        // Snyder, table of lengths of a degree on WGS 84: at 45°, 78 847 m of longitude, 111 132 m of latitude.
        let (east, north) = GeoOrigin { latitude: 45.0, longitude: 0.0 }.metres_per_degree();
        assert!((east - 78_847.0).abs() < 1.0 && (north - 111_132.0).abs() < 1.0, "{east} {north}");
        let (east, north) = GeoOrigin { latitude: 0.0, longitude: 0.0 }.metres_per_degree();
        assert!((east - 111_320.0).abs() < 1.0 && (north - 110_574.0).abs() < 1.0, "{east} {north}");
    }

    #[test]
    fn a_place_beyond_the_poles_is_none() {
        assert!(GeoOrigin { latitude: -33.9, longitude: 151.2 }.is_valid());
        assert!(!GeoOrigin { latitude: 91.0, longitude: 0.0 }.is_valid());
        assert!(!GeoOrigin { latitude: 0.0, longitude: f64::NAN }.is_valid());
    }
}
