//! Weather and time of day by name. The names are those of the CARLA simulator; the values are this crate's, in physical
//! units.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{Environment, Moment, Weather};

/// A weather that has a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum NamedWeather {
    /// Hardly a cloud, dry.
    Clear,
    /// Four fifths of the sky covered, dry.
    Cloudy,
    /// After rain: wet ground, clear sky.
    Wet,
    /// After rain, under clouds.
    WetCloudy,
    /// 2 mm/h.
    SoftRain,
    /// 8 mm/h.
    MidRain,
    /// 30 mm/h.
    HardRain,
    /// Visibility of 120 m.
    Fog,
    /// 3 mm/h of water as snow on 8 cm of it, at -3 °C.
    Snow,
    /// Dust in a storm of 15 m/s, visibility of 250 m.
    DustStorm,
}

/// A time of day that has a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum NamedTime {
    /// 12:00 of a spring day.
    Noon,
    /// Half an hour before the sun sets.
    Sunset,
    /// 22:30, with a moon.
    Night,
}

/// A name that is none.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "there is no weather {name:?}: give one of Clear, Cloudy, Wet, WetCloudy, SoftRain, MidRain, HardRain, Fog, Snow or \
     DustStorm, alone or followed by Noon, Sunset or Night, such as HardRainNight"
)]
pub struct UnknownPreset {
    /// The refused name.
    pub name: String,
}

/// Weather, and a time of day unless that is left to others.
///
/// ```
/// use simworld_core::environment::Preset;
/// let preset: Preset = "HardRainNight".parse()?;
/// let environment = preset.environment();
/// assert!(environment.weather.rain > 20.0 && environment.sun.elevation < -0.2);
/// assert_eq!(preset.to_string(), "HardRainNight");
/// assert!("rain".parse::<Preset>()?.time.is_none());
/// # Ok::<(), simworld_core::environment::UnknownPreset>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Preset {
    /// What the air does.
    pub weather: NamedWeather,
    /// Where the sun stands; `None` leaves it.
    pub time: Option<NamedTime>,
}

impl NamedWeather {
    /// Every named weather.
    pub const ALL: [Self; 10] = [
        Self::Clear,
        Self::Cloudy,
        Self::Wet,
        Self::WetCloudy,
        Self::SoftRain,
        Self::MidRain,
        Self::HardRain,
        Self::Fog,
        Self::Snow,
        Self::DustStorm,
    ];

    /// What it is in numbers.
    pub fn weather(self) -> Weather {
        let clear = Weather { cloud_cover: 0.15, visibility: 30_000.0, ..Weather::default() };
        let after_rain = Weather { wetness: 0.8, puddles: 0.45, ..clear };
        let rain = |rain, cloud_cover, visibility, puddles| Weather {
            rain,
            cloud_cover,
            visibility,
            puddles,
            wetness: 1.0,
            wind: crate::geometry::Vector2::new(0.05 * rain + 1.0, 0.6),
            temperature: 11.0,
            ..clear
        };
        match self {
            Self::Clear => clear,
            Self::Cloudy => Weather { cloud_cover: 0.8, visibility: 20_000.0, ..clear },
            Self::Wet => after_rain,
            Self::WetCloudy => Weather { cloud_cover: 0.85, visibility: 15_000.0, ..after_rain },
            Self::SoftRain => rain(2.0, 0.85, 6_000.0, 0.35),
            Self::MidRain => rain(8.0, 0.95, 3_000.0, 0.6),
            Self::HardRain => rain(30.0, 1.0, 1_200.0, 0.9),
            Self::Fog => {
                Weather { visibility: 120.0, cloud_cover: 0.9, wetness: 0.25, temperature: 6.0, ..clear }
            }
            Self::Snow => Weather {
                snow: 3.0,
                snow_depth: 0.08,
                cloud_cover: 0.95,
                visibility: 1_500.0,
                temperature: -3.0,
                ..clear
            },
            Self::DustStorm => Weather {
                visibility: 250.0,
                cloud_cover: 0.6,
                wind: crate::geometry::Vector2::new(15.0, 0.0),
                temperature: 32.0,
                ..clear
            },
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Clear => "Clear",
            Self::Cloudy => "Cloudy",
            Self::Wet => "Wet",
            Self::WetCloudy => "WetCloudy",
            Self::SoftRain => "SoftRain",
            Self::MidRain => "MidRain",
            Self::HardRain => "HardRain",
            Self::Fog => "Fog",
            Self::Snow => "Snow",
            Self::DustStorm => "DustStorm",
        }
    }
}

impl NamedTime {
    /// Every named time.
    pub const ALL: [Self; 3] = [Self::Noon, Self::Sunset, Self::Night];

    /// The moment: 29 April 2026 at 40° north, by mean solar time.
    pub fn moment(self) -> Moment {
        let hour = match self {
            Self::Noon => 12.0,
            Self::Sunset => 18.2,
            Self::Night => 22.5,
        };
        Moment { day_of_year: 119, hour, ..Moment::default() }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Noon => "Noon",
            Self::Sunset => "Sunset",
            Self::Night => "Night",
        }
    }
}

impl Preset {
    /// Sun, moon and weather; without a time, the sun of the default environment.
    pub fn environment(self) -> Environment {
        let mut environment = Environment { weather: self.weather.weather(), ..Environment::default() };
        if let Some(time) = self.time {
            let moment = time.moment();
            (environment.sun, environment.moon) = (moment.sun(), moment.moon());
        }
        environment
    }
}

impl fmt::Display for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.weather.name())?;
        self.time.map_or(Ok(()), |time| f.write_str(time.name()))
    }
}

impl FromStr for Preset {
    type Err = UnknownPreset;

    /// Reads a name; capitals, spaces, dashes and underscores do not matter. `Rain`, `MidRainy` and `HardRainy` are names
    /// of rain too, as CARLA has some of them.
    fn from_str(name: &str) -> Result<Self, UnknownPreset> {
        let plain: String =
            name.chars().filter(|c| c.is_alphanumeric()).collect::<String>().to_ascii_lowercase();
        let ends = |time: &NamedTime| plain.ends_with(&time.name().to_ascii_lowercase());
        let time = NamedTime::ALL.into_iter().find(ends);
        let weather =
            plain.strip_suffix(&time.map_or(String::new(), |time| time.name().to_ascii_lowercase()));
        let weather = match weather.unwrap_or(&plain) {
            "rain" | "rainy" | "midrainy" => Some(NamedWeather::MidRain),
            "hardrainy" => Some(NamedWeather::HardRain),
            "softrainy" => Some(NamedWeather::SoftRain),
            other => NamedWeather::ALL.into_iter().find(|weather| weather.name().eq_ignore_ascii_case(other)),
        };
        let unknown = || UnknownPreset { name: name.to_owned() };
        Ok(Self { weather: weather.ok_or_else(unknown)?, time })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_is_valid_and_reads_its_own_name() {
        for weather in NamedWeather::ALL {
            for time in [None, Some(NamedTime::Noon), Some(NamedTime::Sunset), Some(NamedTime::Night)] {
                let preset = Preset { weather, time };
                assert_eq!(preset.environment().validate(), Ok(()), "{preset}");
                assert_eq!(preset.to_string().parse(), Ok(preset));
                assert_eq!(preset.to_string().to_lowercase().parse(), Ok(preset));
            }
        }
    }

    /// The names of CARLA 0.9.16 and 0.10.
    #[test]
    fn the_names_of_carla_are_known() {
        let sky = ["Clear", "Cloudy", "Wet", "WetCloudy", "SoftRain", "HardRain"];
        for time in ["Noon", "Sunset", "Night"] {
            for sky in sky {
                assert!(format!("{sky}{time}").parse::<Preset>().is_ok(), "{sky}{time}");
            }
        }
        for name in ["MidRainyNoon", "MidRainSunset", "MidRainyNight", "DustStorm"] {
            assert!(name.parse::<Preset>().is_ok(), "{name}");
        }
        assert!("Hail".parse::<Preset>().unwrap_err().to_string().contains("HardRainNight"));
        assert!("".parse::<Preset>().is_err() && "Noon".parse::<Preset>().is_err());
    }

    #[test]
    fn sunset_is_low_and_night_is_dark() {
        let sun = |time: NamedTime| time.moment().sun();
        let sunset = sun(NamedTime::Sunset).elevation.to_degrees();
        assert!((2.0..9.0).contains(&sunset), "{sunset}");
        assert!(sun(NamedTime::Night).elevation < -0.3);
        assert!(sun(NamedTime::Noon).elevation > 1.0);
        let moon = NamedTime::Night.moment().moon();
        assert!(moon.elevation > 0.1, "{moon:?}");
    }
}
