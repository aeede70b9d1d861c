//! What the weather does to couriers: it slows them and tires them.

use serde::{Deserialize, Serialize};
use simworld_core::environment::Weather;
use simworld_core::exertion::Terrain;
use simworld_core::seam::TaskError;

use super::config::within;
use super::state::Errand;
use super::turn::Turn;

/// Rain from which it is no worse, mm/h: heavy rain (WMO: from 10 mm/h).
const HEAVY_RAIN: f64 = 10.0;
/// Snowfall as water from which it is no worse, mm/h: heavy snow.
const HEAVY_SNOW: f64 = 5.0;
/// Warmer than this tires, °C.
const WARM: f64 = 25.0;

/// How weather slows and tires. In clear and temperate weather nothing changes. Snow that lies is the ground that one walks on, and
/// tires by [`Terrain::factor`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WeatherConfig {
    /// The share of speed that heavy rain takes, lighter rain less in proportion, in [0, 0.9]. Chosen: 0.1, within the 2 to
    /// 17 % of road traffic (FHWA, Road Weather Management).
    pub rain_slows: f64,
    /// The share that heavy snowfall takes, in [0, 0.9]. Chosen: 0.3, within the 5 to 64 % of the same source.
    pub snow_slows: f64,
    /// How much more a metre tires in heavy rain, as a share, in [0, 10]. Chosen: 0.1.
    pub rain_tires: f64,
    /// How much more for each kelvin above 25 °C, in [0, 1]. Chosen: 0.02.
    pub heat_tires: f64,
}

impl Default for WeatherConfig {
    fn default() -> Self {
        Self { rain_slows: 0.1, snow_slows: 0.3, rain_tires: 0.1, heat_tires: 0.02 }
    }
}

impl WeatherConfig {
    pub(super) fn validate(&self) -> Result<(), TaskError> {
        within("weather.rain_slows", self.rain_slows, 0.0, 0.9)?;
        within("weather.snow_slows", self.snow_slows, 0.0, 0.9)?;
        within("weather.rain_tires", self.rain_tires, 0.0, 10.0)?;
        within("weather.heat_tires", self.heat_tires, 0.0, 1.0)
    }

    /// The factor on speeds in that weather: 1 where nothing falls.
    pub fn pace(&self, weather: &Weather) -> f64 {
        let (rain, snow) = shares(weather);
        (1.0 - self.rain_slows * rain) * (1.0 - self.snow_slows * snow)
    }

    /// The factor on what a metre costs of energy beside that of the snow that lies ([`Terrain::of_pavement`]): 1 in clear and
    /// temperate weather.
    pub fn effort(&self, weather: &Weather) -> f64 {
        let (rain, _) = shares(weather);
        let heat = (weather.temperature - WARM).max(0.0);
        1.0 + self.rain_tires * rain + self.heat_tires * heat
    }
}

/// Rain and snow, each from none to heavy as 0 to 1.
fn shares(weather: &Weather) -> (f64, f64) {
    let share = |fall: f64, heavy: f64| (fall / heavy).clamp(0.0, 1.0);
    (share(weather.rain, HEAVY_RAIN), share(weather.snow, HEAVY_SNOW))
}

impl Turn<'_> {
    /// Takes up the weather; whoever is under way goes on at the pace that it allows.
    pub(super) fn weather(&mut self) {
        let weather = &self.scene.environment().weather;
        let pace = self.config.weather.pace(weather);
        self.state.effort = self.config.weather.effort(weather);
        self.state.terrain = Terrain::of_pavement(&weather.cover());
        if pace == self.state.pace {
            return;
        }
        self.state.pace = pace;
        for index in 0..self.state.couriers.len() {
            if self.state.couriers[index].errand != Errand::Idle {
                self.send(index);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clear_weather_changes_nothing_and_a_blizzard_is_worst() {
        let config = WeatherConfig::default();
        let clear = Weather::default();
        assert_eq!((config.pace(&clear), config.effort(&clear)), (1.0, 1.0));
        let rain = Weather { rain: 5.0, ..clear };
        assert!((config.pace(&rain) - 0.95).abs() < 1e-12 && (config.effort(&rain) - 1.05).abs() < 1e-12);
        let blizzard = Weather { snow: 50.0, ..clear };
        assert!((config.pace(&blizzard) - 0.7).abs() < 1e-12 && config.effort(&blizzard) == 1.0);
        let hot = Weather { temperature: 35.0, ..clear };
        assert!((config.effort(&hot) - 1.2).abs() < 1e-12 && config.pace(&hot) == 1.0);
    }
}
