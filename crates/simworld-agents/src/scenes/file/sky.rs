//! Date, hour and weather of a scene.

use serde::{Deserialize, Serialize};
use simworld_core::environment::{Environment, Moment, Preset, day_of_year};

use super::check::text;
use super::error::Fault;

/// A date of the Gregorian calendar, written as TOML has dates: `2026-10-04`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "toml::value::Date", into = "toml::value::Date")]
pub struct Date {
    /// 1901 to 2099.
    pub year: u16,
    /// From 1.
    pub month: u8,
    /// From 1.
    pub day: u8,
}

impl From<toml::value::Date> for Date {
    fn from(date: toml::value::Date) -> Self {
        Self { year: date.year, month: date.month, day: date.day }
    }
}

impl From<Date> for toml::value::Date {
    fn from(date: Date) -> Self {
        Self { year: date.year, month: date.month, day: date.day }
    }
}

/// The sky of a scene. What is not said is as in the default environment: a clear mid-morning.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sky {
    /// The day; 21 June 2026 where only the hour is said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub date: Option<Date>,
    /// Hours since midnight by mean solar time, in [0, 24]; noon where only the date is said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hour: Option<f64>,
    /// North positive, degrees in [-90, 90]; 40 without it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub latitude_degrees: Option<f64>,
    /// A weather by name ([`Preset`]), such as `SoftRain`; one with a time of day, such as `HardRainNight`, stands without date, hour
    /// and latitude.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weather: Option<String>,
    /// Sun, moon and weather in numbers, in place of all else.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exact: Option<Environment>,
}

impl Sky {
    /// What it says in numbers.
    ///
    /// # Errors
    /// The first key that is out of range, or that does not go with another.
    pub fn environment(&self) -> Result<Environment, Fault> {
        let is_timed = self.date.is_some() || self.hour.is_some() || self.latitude_degrees.is_some();
        if let Some(exact) = self.exact {
            if is_timed || self.weather.is_some() {
                return Err(Fault::Keys(
                    "environment.exact says everything: leave out date, hour, latitude_degrees and weather, or leave out exact",
                ));
            }
            exact.validate()?;
            return Ok(exact);
        }
        let mut environment = Environment::default();
        if let Some(name) = &self.weather {
            if let Some(fault) = text("environment.weather", name, 100) {
                return Err(fault);
            }
            let preset: Preset = name.parse()?;
            if preset.time.is_some() && is_timed {
                return Err(Fault::Keys(
                    "environment.weather names a time of day: name the weather alone, or leave out date, hour and latitude_degrees",
                ));
            }
            environment = preset.environment();
        }
        if is_timed {
            let moment = self.moment()?;
            (environment.sun, environment.moon) = (moment.sun(), moment.moon());
        }
        environment.validate()?;
        Ok(environment)
    }

    /// The moment that date, hour and latitude are.
    fn moment(&self) -> Result<Moment, Fault> {
        let usual = Moment::default();
        let hour = self.hour.unwrap_or(usual.hour);
        let latitude = self.latitude_degrees.unwrap_or(40.0);
        for (key, value, (low, high), allowed) in [
            ("environment.hour", hour, (0.0, 24.0), "0 to 24 h"),
            ("environment.latitude_degrees", latitude, (-90.0, 90.0), "-90 to 90 degrees"),
        ] {
            if !(low..=high).contains(&value) {
                return Err(Fault::Number { key, value, allowed });
            }
        }
        let mut moment = Moment { hour, latitude: latitude.to_radians(), ..usual };
        if let Some(date) = self.date {
            let refused = |why| {
                let value = format!("{:04}-{:02}-{:02}", date.year, date.month, date.day);
                Fault::Text { key: "environment.date", value, why }
            };
            moment.year = i32::from(date.year);
            moment.day_of_year = day_of_year(moment.year, u32::from(date.month), u32::from(date.day))
                .ok_or_else(|| refused("is no day of the calendar: give a year, a month and a day of it"))?;
            if !(1901..=2099).contains(&moment.year) {
                return Err(refused("is out of range: give a year from 1901 to 2099"));
            }
        }
        Ok(moment)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sky(text: &str) -> Sky {
        toml::from_str(text).expect("it is a table of the sky")
    }

    #[test]
    fn nothing_said_is_the_default_environment() {
        assert_eq!(sky("").environment(), Ok(Environment::default()));
    }

    #[test]
    fn hour_and_date_say_where_the_sun_stands() {
        let noon = sky("hour = 12").environment().expect("it is sound");
        let night = sky("hour = 0.5\ndate = 2026-12-21").environment().expect("it is sound");
        assert!(
            noon.sun.elevation > 1.2,
            "the solstice at 40° north: 73.4°, {}",
            noon.sun.elevation.to_degrees()
        );
        assert!(night.sun.elevation < -0.5);
        let winter = sky("date = 2026-12-21").environment().expect("noon").sun.elevation;
        assert!((winter.to_degrees() - 26.6).abs() < 1.0, "90° - 40° - 23.4°: {}", winter.to_degrees());
        let south = sky("date = 2026-12-21\nlatitude_degrees = -40").environment().expect("noon");
        assert!(south.sun.elevation > 1.2);
    }

    #[test]
    fn weather_goes_by_name_and_keeps_the_hour_that_is_said() {
        let wet = sky("weather = \"SoftRain\"\nhour = 18.0").environment().expect("it is sound");
        assert_eq!(wet.weather.rain, 2.0);
        assert_eq!(wet.sun, sky("hour = 18.0").environment().expect("it is sound").sun);
        assert!(sky("weather = \"HardRainNight\"").environment().expect("it is sound").sun.elevation < 0.0);
    }

    #[test]
    fn what_is_wrong_with_the_sky_is_told_by_its_key() {
        for (text, told) in [
            ("hour = 25", "environment.hour = 25.0 is out of range: give 0 to 24 h"),
            ("hour = nan", "environment.hour = NaN"),
            ("latitude_degrees = 91", "-90 to 90 degrees"),
            ("date = 1850-01-01", "give a year from 1901 to 2099"),
            ("weather = \"Hail\"", "HardRainNight"),
            ("weather = \"HardRainNight\"\nhour = 3", "name the weather alone"),
            ("hour = 3\n[exact.weather]\nrain = 1.0", "leave out exact"),
            ("[exact.weather]\nrain = -1.0", "weather.rain"),
        ] {
            let fault = sky(text).environment().expect_err(text).to_string();
            assert!(fault.contains(told), "{text}: {fault}");
        }
    }
}
