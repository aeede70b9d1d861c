//! Where sun and moon stand, from date, hour and place.
//!
//! The sun after J. Meeus, Astronomical Algorithms, 2nd edition (1998), chapters 22, 25 and 28, as the Solar Calculator of
//! NOAA's Global Monitoring Laboratory uses it; the moon after the formulas of low precision of the Astronomical Almanac
//! (page D22), good to 0.3°. Directions are those without refraction and parallax, but for the parallax of the moon.

use serde::{Deserialize, Serialize};

use super::{Environment, EnvironmentError, Moon, Sun};
use crate::asset::Season;
use crate::ops;

/// The first days of spring, summer, autumn and winter by the meteorologists' calendar, on the northern half of the globe and in years of
/// 365 days: those of March, June, September and December.
const FIRST_DAYS: [u32; 4] = [60, 152, 244, 335];
/// Between the tropics the sun is in the zenith twice a year, and no leaves fall for cold, radians.
const TROPIC: f64 = 23.44 * std::f64::consts::PI / 180.0;

/// A moment at a place.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Moment {
    /// Year of the Gregorian calendar, 1901 to 2099.
    pub year: i32,
    /// Day of the year, from 1 to 366; 1 January is 1.
    pub day_of_year: u32,
    /// Hours since midnight by the clock of the place, in [0, 24].
    pub hour: f64,
    /// How far that clock is ahead of UTC, hours in [-12, 14].
    pub utc_offset: f64,
    /// Radians, north positive, within ±π/2.
    pub latitude: f64,
    /// Radians, east positive, within ±π. 0 with an offset of 0 makes the hour one of mean solar time.
    pub longitude: f64,
}

impl Default for Moment {
    /// Noon of the summer solstice of 2026, at 40° north and by mean solar time.
    fn default() -> Self {
        Self {
            year: 2026,
            day_of_year: 172,
            hour: 12.0,
            utc_offset: 0.0,
            latitude: 40.0_f64.to_radians(),
            longitude: 0.0,
        }
    }
}

/// The day of the year of a date, from 1; `None` where the calendar has no such day.
///
/// ```
/// use simworld_core::environment::day_of_year;
/// assert_eq!(day_of_year(2024, 12, 31), Some(366));
/// assert_eq!(day_of_year(2023, 2, 29), None);
/// ```
pub fn day_of_year(year: i32, month: u32, day: u32) -> Option<u32> {
    const LENGTHS: [u32; 12] = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    let leap = u32::from(is_leap(year));
    let index = usize::try_from(month.checked_sub(1)?).ok()?;
    let length = LENGTHS.get(index)? + if index == 1 { leap } else { 0 };
    let before: u32 = LENGTHS[..index].iter().sum::<u32>() + if index > 1 { leap } else { 0 };
    (1..=length).contains(&day).then_some(before + day)
}

fn is_leap(year: i32) -> bool {
    year % 4 == 0 && (year % 100 != 0 || year % 400 == 0)
}

impl Moment {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range, with what is allowed; NaN is always out of range.
    pub fn validate(&self) -> Result<(), EnvironmentError> {
        let days = if is_leap(self.year) { 366.0 } else { 365.0 };
        let (quarter, half) = (std::f64::consts::FRAC_PI_2, std::f64::consts::PI);
        let checks = [
            ("moment.year", f64::from(self.year), 1901.0, 2099.0, "1901 to 2099"),
            ("moment.day_of_year", f64::from(self.day_of_year), 1.0, days, "1 to the days of the year"),
            ("moment.hour", self.hour, 0.0, 24.0, "0 to 24 h"),
            ("moment.utc_offset", self.utc_offset, -12.0, 14.0, "-12 to 14 h"),
            ("moment.latitude", self.latitude, -quarter, quarter, "-π/2 to π/2 rad"),
            ("moment.longitude", self.longitude, -half, half, "-π to π rad"),
        ];
        super::within(&checks)
    }

    /// The season by the calendar of meteorologists (whole months from March on), half a year later on the southern half of the globe; none
    /// between the tropics.
    ///
    /// ```
    /// use simworld_core::asset::Season;
    /// use simworld_core::environment::{Moment, day_of_year};
    /// let october = Moment { day_of_year: day_of_year(2026, 10, 20).unwrap(), ..Moment::default() };
    /// assert_eq!(october.season(), Some(Season::Autumn));
    /// assert_eq!(Moment { latitude: -0.6, ..october }.season(), Some(Season::Spring));
    /// assert_eq!(Moment { latitude: 0.1, ..october }.season(), None);
    /// ```
    pub fn season(&self) -> Option<Season> {
        // A leap day is one more of winter, and all behind it come a day later.
        let day = self.day_of_year - u32::from(is_leap(self.year) && self.day_of_year >= FIRST_DAYS[0]);
        let rank = FIRST_DAYS.iter().rposition(|first| *first <= day);
        let northern = rank.map_or(Season::Winter, |rank| Season::ALL[rank]);
        if self.latitude.abs() <= TROPIC {
            None
        } else if self.latitude < 0.0 {
            Some(northern.opposite())
        } else {
            Some(northern)
        }
    }

    /// Days from noon of 1 January 2000, UTC.
    fn days(&self) -> f64 {
        let years = self.year - 2000;
        // One leap day for each fourth year that is over, from 2000 on; none is left out from 1901 to 2099.
        let leap_days = (years - 1).div_euclid(4) + 1;
        f64::from(years * 365 + leap_days) + f64::from(self.day_of_year) - 1.5
            + (self.hour - self.utc_offset) / 24.0
    }

    /// Azimuth from north, clockwise, and elevation of what has a right ascension and a declination, degrees in and radians
    /// out.
    fn above(&self, ascension: f64, declination: f64) -> (f64, f64) {
        let days = self.days();
        let centuries = days / 36_525.0;
        // Meeus 12.4, mean sidereal time at Greenwich.
        let sidereal = 280.460_618_37 + 360.985_647_366_29 * days + 0.000_387_933 * centuries * centuries;
        let (sin_hour, cos_hour) = ops::sin_cos(turned(sidereal - ascension) + self.longitude);
        let (sin_declination, cos_declination) = ops::sin_cos(declination.to_radians());
        let (sin_latitude, cos_latitude) = ops::sin_cos(self.latitude);
        let height = sin_latitude * sin_declination + cos_latitude * cos_declination * cos_hour;
        let north = cos_latitude * sin_declination - sin_latitude * cos_declination * cos_hour;
        let azimuth = ops::atan2(-cos_declination * sin_hour, north).rem_euclid(std::f64::consts::TAU);
        (azimuth, ops::asin(height.clamp(-1.0, 1.0)))
    }

    /// The sun of this moment, with the illuminance of a clear sky after the model of the IES: 133 100 lux
    /// exp(-0.21 / sin of the elevation), from 0.97 to 1.03 of it with the distance of the sun.
    pub fn sun(&self) -> Sun {
        let place = SunPlace::at(self.days());
        let (azimuth, elevation) = self.above(place.ascension, place.declination);
        let height = ops::sin(elevation);
        let clear = if height > 0.0 { 133_100.0 * ops::exp(-0.21 / height) } else { 0.0 };
        Sun { azimuth, elevation, illuminance: clear / (place.distance * place.distance) }
    }

    /// The moon of this moment. Its light falls with the phase angle after Krisciunas and Schaefer (1991), from 0.31 lux of
    /// the full moon above the air; the air takes what it takes of sunlight.
    pub fn moon(&self) -> Moon {
        let days = self.days();
        let place = MoonPlace::at(days);
        let (ascension, declination) =
            equatorial(place.longitude, place.latitude, obliquity(days / 36_525.0));
        let (azimuth, elevation) = self.above(ascension, declination);
        // The moon is near: from the surface of the earth it stands lower by its parallax.
        let elevation = elevation - place.parallax.to_radians() * ops::cos(elevation);
        let apart = ops::cos((place.longitude - SunPlace::at(days).longitude).to_radians())
            * ops::cos(place.latitude.to_radians());
        // The phase angle is the supplement of the angle between sun and moon, to a sixth of a degree.
        let phase = 180.0 - ops::acos(apart.clamp(-1.0, 1.0)).to_degrees();
        let height = ops::sin(elevation);
        let fourth = phase * phase * phase * phase;
        let above_air = 10.764 * ops::pow(10.0, -0.4 * (3.84 + 0.026 * phase + 4e-9 * fourth));
        let illuminance = if height > 0.0 { above_air * ops::exp(-0.21 / height) } else { 0.0 };
        Moon { azimuth, elevation, illuminance }
    }
}

impl Environment {
    /// Sets sun and moon to where they stand at a moment, and the [season](Moment::season); the weather stays.
    ///
    /// # Errors
    /// A moment out of range.
    ///
    /// ```
    /// use simworld_core::asset::Season;
    /// use simworld_core::environment::{Environment, Moment};
    /// let mut environment = Environment::default();
    /// environment.set_moment(&Moment { hour: 19.5, ..Moment::default() })?;
    /// assert!(environment.sun.elevation < 0.0, "the sun has set");
    /// assert_eq!(environment.season, Some(Season::Summer));
    /// # Ok::<(), simworld_core::environment::EnvironmentError>(())
    /// ```
    pub fn set_moment(&mut self, moment: &Moment) -> Result<(), EnvironmentError> {
        moment.validate()?;
        (self.sun, self.moon, self.season) = (moment.sun(), moment.moon(), moment.season());
        Ok(())
    }
}

/// Degrees as radians of one turn; subtracting whole turns first keeps the precision.
fn turned(degrees: f64) -> f64 {
    degrees.rem_euclid(360.0).to_radians()
}

fn sine(degrees: f64) -> f64 {
    ops::sin(turned(degrees))
}

/// Mean obliquity of the ecliptic with the main term of nutation, degrees (Meeus 22.2 and 25.8).
fn obliquity(centuries: f64) -> f64 {
    23.439_291_11 - 0.013_004_167 * centuries + 0.002_56 * ops::cos(turned(125.04 - 1934.136 * centuries))
}

/// Right ascension and declination of a point of the ecliptic, degrees.
fn equatorial(longitude: f64, latitude: f64, obliquity: f64) -> (f64, f64) {
    let (sin_l, cos_l) = ops::sin_cos(turned(longitude));
    let (sin_b, cos_b) = ops::sin_cos(latitude.to_radians());
    let (sin_e, cos_e) = ops::sin_cos(obliquity.to_radians());
    let ascension = ops::atan2(sin_l * cos_e * cos_b - sin_b * sin_e, cos_l * cos_b);
    let declination = ops::asin((sin_b * cos_e + cos_b * sin_e * sin_l).clamp(-1.0, 1.0));
    (ascension.to_degrees().rem_euclid(360.0), declination.to_degrees())
}

/// The sun among the stars, degrees; its distance in astronomical units.
struct SunPlace {
    longitude: f64,
    ascension: f64,
    declination: f64,
    distance: f64,
}

impl SunPlace {
    fn at(days: f64) -> Self {
        let t = days / 36_525.0;
        let mean_longitude = 280.466_46 + t * (36_000.769_83 + t * 0.000_303_2);
        let anomaly = 357.529_11 + t * (35_999.050_29 - t * 0.000_153_7);
        let eccentricity = 0.016_708_634 - t * (0.000_042_037 + t * 0.000_000_126_7);
        let center = sine(anomaly) * (1.914_602 - t * (0.004_817 + t * 0.000_014))
            + sine(2.0 * anomaly) * (0.019_993 - t * 0.000_101)
            + sine(3.0 * anomaly) * 0.000_289;
        // Aberration, and nutation by the node of the moon.
        let longitude = mean_longitude + center - 0.005_69 - 0.004_78 * sine(125.04 - 1934.136 * t);
        let (ascension, declination) = equatorial(longitude, 0.0, obliquity(t));
        let distance = 1.000_001_018 * (1.0 - eccentricity * eccentricity)
            / (1.0 + eccentricity * ops::cos(turned(anomaly + center)));
        Self { longitude: longitude.rem_euclid(360.0), ascension, declination, distance }
    }
}

/// The moon on the ecliptic, degrees.
struct MoonPlace {
    longitude: f64,
    latitude: f64,
    parallax: f64,
}

impl MoonPlace {
    fn at(days: f64) -> Self {
        let t = days / 36_525.0;
        let sum = |terms: &[(f64, f64, f64)]| -> f64 {
            terms.iter().map(|(size, start, rate)| size * sine(start + rate * t)).sum()
        };
        let longitude = 218.32
            + 481_267.881 * t
            + sum(&[
                (6.29, 135.0, 477_198.87),
                (-1.27, 259.3, -413_335.36),
                (0.66, 235.7, 890_534.22),
                (0.21, 269.9, 954_397.74),
                (-0.19, 357.5, 35_999.05),
                (-0.11, 186.5, 966_404.03),
            ]);
        let latitude = sum(&[
            (5.13, 93.3, 483_202.02),
            (0.28, 228.2, 960_400.89),
            (-0.28, 318.3, 6_003.15),
            (-0.17, 217.6, -407_332.21),
        ]);
        // Cosines are sines a quarter of a turn on.
        let parallax = 0.9508
            + sum(&[
                (0.0518, 225.0, 477_198.87),
                (0.0095, 349.3, -413_335.36),
                (0.0078, 325.7, 890_534.22),
                (0.0028, 359.9, 954_397.74),
            ]);
        Self { longitude: longitude.rem_euclid(360.0), latitude, parallax }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at_greenwich(year: i32, month: u32, day: u32, hour: f64) -> Moment {
        let day_of_year = day_of_year(year, month, day).unwrap();
        Moment { year, day_of_year, hour, latitude: 51.4779_f64.to_radians(), ..Moment::default() }
    }

    /// I. Reda and A. Andreas, Solar Position Algorithm for Solar Radiation Applications, NREL/TP-560-34302, table A5.1: Golden,
    /// Colorado, 17 October 2003, 12:30:30 mountain time; topocentric elevation 39.872° before refraction.
    #[test]
    fn the_sun_stands_where_the_report_of_nrel_has_it() {
        let moment = Moment {
            year: 2003,
            day_of_year: day_of_year(2003, 10, 17).unwrap(),
            hour: 12.0 + 30.5 / 60.0,
            utc_offset: -7.0,
            latitude: 39.742_476_f64.to_radians(),
            longitude: (-105.1786_f64).to_radians(),
        };
        let sun = moment.sun();
        assert!((sun.elevation.to_degrees() - 39.872).abs() < 0.02, "{}", sun.elevation.to_degrees());
        assert!((sun.azimuth.to_degrees() - 194.340).abs() < 0.03, "{}", sun.azimuth.to_degrees());
    }

    /// Meeus, example 25.a: 13 October 1992, 0 h: ascension 198.380 83°, declination -7.785 07°.
    #[test]
    fn the_sun_among_the_stars_agrees_with_the_worked_example() {
        let place = SunPlace::at(at_greenwich(1992, 10, 13, 0.0).days());
        assert!((place.ascension - 198.380_83).abs() < 0.002, "{}", place.ascension);
        assert!((place.declination + 7.785_07).abs() < 0.001, "{}", place.declination);
        assert!((place.distance - 0.997_66).abs() < 1e-4, "{}", place.distance);
    }

    /// Equinox and solstices of 2024 by the U.S. Naval Observatory: 20 March 3:06, 20 June 20:51, 21 December 9:21 UT. The sun
    /// then stands at 0°, 90° and 270° of the ecliptic.
    #[test]
    fn equinox_and_solstices_fall_where_the_calendar_has_them() {
        for (month, day, hour, expected) in [(3, 20, 3.1, 360.0), (6, 20, 20.85, 90.0), (12, 21, 9.35, 270.0)]
        {
            let longitude = SunPlace::at(at_greenwich(2024, month, day, hour).days()).longitude;
            let off = (longitude - expected + 180.0).rem_euclid(360.0) - 180.0;
            assert!(off.abs() < 0.005, "{month}-{day}: {off}");
        }
    }

    /// Meeus, example 47.a: 12 April 1992, 0 h: longitude 133.163°, latitude -3.229°, parallax 0.9912°.
    #[test]
    fn the_moon_agrees_with_the_worked_example() {
        let place = MoonPlace::at(at_greenwich(1992, 4, 12, 0.0).days());
        assert!((place.longitude - 133.163).abs() < 0.3, "{}", place.longitude);
        assert!((place.latitude + 3.229).abs() < 0.2, "{}", place.latitude);
        assert!((place.parallax - 0.9912).abs() < 0.003, "{}", place.parallax);
    }

    /// Full moon of 25 January 2024, 17:54 UT, and new moon of 11 January, 11:57 UT (U.S. Naval Observatory).
    #[test]
    fn the_full_moon_lights_the_night_and_the_new_moon_does_not() {
        let full = at_greenwich(2024, 1, 25, 23.9).moon();
        assert!(full.elevation > 0.9 && full.illuminance > 0.18, "{full:?}");
        let new = at_greenwich(2024, 1, 11, 12.0).moon();
        assert!(new.illuminance < 0.002, "{new:?}");
    }

    #[test]
    fn noon_of_a_solstice_stands_as_high_as_geometry_has_it() {
        let sun = Moment::default().sun();
        assert!(
            (sun.elevation.to_degrees() - (90.0 - 40.0 + 23.44)).abs() < 0.1,
            "{}",
            sun.elevation.to_degrees()
        );
        let south = Moment { latitude: (-40.0_f64).to_radians(), ..Moment::default() }.sun();
        assert!((south.elevation.to_degrees() - (90.0 - 40.0 - 23.44)).abs() < 0.1);
        assert!(
            south.azimuth.to_degrees() < 5.0 || south.azimuth.to_degrees() > 355.0,
            "it stands in the north"
        );
    }

    #[test]
    fn seasons_begin_with_their_months() {
        use Season::{Autumn, Spring, Summer, Winter};
        for (year, month, day, season) in [
            (2026, 1, 1, Winter),
            (2026, 2, 28, Winter),
            (2024, 2, 29, Winter),
            (2026, 3, 1, Spring),
            (2024, 3, 1, Spring),
            (2024, 5, 31, Spring),
            (2026, 6, 1, Summer),
            (2024, 9, 1, Autumn),
            (2026, 11, 30, Autumn),
            (2024, 12, 1, Winter),
            (2024, 12, 31, Winter),
        ] {
            let moment = at_greenwich(year, month, day, 12.0);
            assert_eq!(moment.season(), Some(season), "{year}-{month}-{day}");
            let south = Moment { latitude: -moment.latitude, ..moment };
            assert_eq!(south.season(), Some(season.opposite()), "{year}-{month}-{day}");
        }
        assert_eq!(Moment { latitude: 0.2, ..Moment::default() }.season(), None);
    }

    #[test]
    fn a_moment_that_cannot_be_is_refused() {
        let spoilt = [
            Moment { year: 1800, ..Moment::default() },
            Moment { day_of_year: 366, ..Moment::default() },
            Moment { day_of_year: 0, ..Moment::default() },
            Moment { hour: f64::NAN, ..Moment::default() },
            Moment { latitude: 2.0, ..Moment::default() },
            Moment { longitude: f64::INFINITY, ..Moment::default() },
        ];
        for moment in spoilt {
            assert!(Environment::default().set_moment(&moment).is_err(), "{moment:?}");
        }
    }
}
