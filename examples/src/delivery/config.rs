//! What to run: one plain structure, read from TOML.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use simworld_agents::delivery::{DeliveryConfig, Persona};
use simworld_citygen::CityConfig;
use simworld_core::environment::Environment;
use simworld_physics::PhysicsConfig;
use simworld_traffic::TrafficConfig;
use thiserror::Error;

use super::locate::line_of;
use super::players::Brain;
use super::thinkers::ModelSettings;

/// From this distance on all bodies are under physics, m.
pub const EVERYWHERE: f64 = 1e6;

/// Everything that determines a run. The same configuration gives the same bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RunConfig {
    /// The first seed; the others are the numbers after it. The city is that of the first seed for all.
    pub seed: u64,
    /// How many seeds to run, in [1, 1000].
    pub seeds: u32,
    /// Number of couriers, in [1, 10 000].
    pub agents: u32,
    /// Number of steps, in [1, 10⁸].
    pub steps: u64,
    /// Number of vehicles of the traffic, in [0, 1 000 000].
    pub vehicles: u32,
    /// Number of pedestrians of the traffic, in [0, 1 000 000].
    pub pedestrians: u32,
    /// Frames to render of the first seed, in [0, 1000]; 0 renders nothing.
    pub frames: u32,
    /// Steps between two digests of the trail, in [1, 10 000].
    pub digest_interval: u64,
    /// Steps between two checkpoints, from which a run that was cut off goes on, in [0, 10⁸]; 0 writes none.
    pub checkpoint_interval: u64,
    /// Who plays: policies, and `model`, are dealt to the couriers in turn.
    pub policies: Vec<Brain>,
    /// The model of those that think with one.
    pub model: ModelSettings,
    /// What they are like: the personas are dealt in turn; without any each courier's is drawn.
    pub personas: Vec<Persona>,
    /// Couriers within this distance of the middle of the city have bodies under physics, m, in [0, 10⁶]; those beyond move
    /// as points at the speed that they are told. Bodies change when couriers come or go.
    pub physical_within: f64,
    /// Sun and weather.
    pub environment: Environment,
    /// A `roads.json` of the Python release to use instead of grown roads.
    pub roads: Option<PathBuf>,
    /// A saved city to use instead of a grown one; it comes before roads and settings of a city.
    pub city_file: Option<PathBuf>,
    /// The city.
    pub city: CityConfig,
    /// The traffic; its numbers of vehicles and pedestrians are those above.
    pub traffic: TrafficConfig,
    /// The physics.
    pub physics: PhysicsConfig,
    /// The task.
    pub delivery: DeliveryConfig,
}

impl Default for RunConfig {
    /// The paper's main setting, with 40 vehicles and 80 pedestrians.
    fn default() -> Self {
        Self {
            seed: 1,
            seeds: 3,
            agents: 20,
            steps: 5000,
            vehicles: 40,
            pedestrians: 80,
            frames: 3,
            digest_interval: 10,
            checkpoint_interval: 500,
            policies: Brain::policies(),
            model: ModelSettings::default(),
            personas: Vec::new(),
            physical_within: EVERYWHERE,
            environment: Environment::default(),
            roads: None,
            city_file: None,
            city: CityConfig::default(),
            traffic: TrafficConfig::default(),
            physics: PhysicsConfig::default(),
            delivery: DeliveryConfig::default(),
        }
    }
}

/// Why a configuration cannot be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ConfigError {
    /// The file cannot be read.
    #[error("{path}: {source}; settings are read from there, of a run from its folder")]
    File {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The text is not TOML, or holds an unknown key or a value of the wrong type.
    #[error("{path}: {source}")]
    Syntax {
        /// Which file.
        path: PathBuf,
        /// What is wrong, where, and what is allowed.
        source: Box<toml::de::Error>,
    },
    /// A value out of range.
    #[error("{place}{message}")]
    Range {
        /// File and line, with a colon and a blank; empty for values of the command line.
        place: String,
        /// The key, its value and what is allowed.
        message: String,
    },
}

/// A value out of range, not yet placed in a file.
struct OutOfRange {
    key: String,
    message: String,
}

impl RunConfig {
    /// Reads and checks a file.
    ///
    /// # Errors
    /// The file, the key at fault, its line, and what is allowed.
    pub fn read(path: &Path) -> Result<Self, ConfigError> {
        let text = std::fs::read_to_string(path)
            .map_err(|source| ConfigError::File { path: path.to_owned(), source })?;
        Self::parse(&text, path)
    }

    /// Reads and checks a text; `path` is what errors call it.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(text: &str, path: &Path) -> Result<Self, ConfigError> {
        let config: Self = toml::from_str(text)
            .map_err(|source| ConfigError::Syntax { path: path.to_owned(), source: Box::new(source) })?;
        config.check().map_err(|fault| {
            let line = line_of(text, &fault.key).map(|line| format!(", line {line}")).unwrap_or_default();
            ConfigError::Range { place: format!("{}{line}: ", path.display()), message: fault.message }
        })?;
        Ok(config)
    }

    /// Checks every value against its range.
    ///
    /// # Errors
    /// The key at fault and what is allowed.
    pub fn validate(&self) -> Result<(), ConfigError> {
        self.check().map_err(|fault| ConfigError::Range { place: String::new(), message: fault.message })
    }

    /// The configuration as TOML, as a run writes it beside its log.
    ///
    /// # Errors
    /// A path that is no text.
    pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
        toml::to_string_pretty(self)
    }

    /// Steps between two checkpoints, if there are any. A run with a tape has none: what was answered is on it, counted from the
    /// beginning of the run.
    pub(super) fn checkpoints(&self) -> Option<u64> {
        let on_tape = self.policies.contains(&Brain::Model) && self.model.tape.is_some();
        (self.checkpoint_interval > 0 && !on_tape).then_some(self.checkpoint_interval)
    }

    fn check(&self) -> Result<(), OutOfRange> {
        let whole: [(&'static str, u64, u64, u64); 8] = [
            ("seeds", self.seeds.into(), 1, 1000),
            ("agents", self.agents.into(), 1, 10_000),
            ("steps", self.steps, 1, 100_000_000),
            ("vehicles", self.vehicles.into(), 0, 1_000_000),
            ("pedestrians", self.pedestrians.into(), 0, 1_000_000),
            ("frames", self.frames.into(), 0, 1000),
            ("digest_interval", self.digest_interval, 1, 10_000),
            ("checkpoint_interval", self.checkpoint_interval, 0, 100_000_000),
        ];
        for (key, value, low, high) in whole {
            if !(low..=high).contains(&value) {
                let message = format!("{key} = {value} is out of range: give {low} to {high}");
                return Err(OutOfRange { key: key.to_owned(), message });
            }
        }
        if self.policies.is_empty() {
            let message = "policies is empty: name at least one policy".to_owned();
            return Err(OutOfRange { key: "policies".to_owned(), message });
        }
        if let Some(fault) = self.personas.iter().find_map(|persona| persona.validate().err()) {
            return Err(OutOfRange { key: "personas".to_owned(), message: format!("personas: {fault}") });
        }
        if !(0.0..=EVERYWHERE).contains(&self.physical_within) {
            let message =
                format!("physical_within = {} is out of range: give 0 to 1000000 m", self.physical_within);
            return Err(OutOfRange { key: "physical_within".to_owned(), message });
        }
        self.check_parts()
    }

    /// Checks the settings of the crates; their errors name a key below the part's.
    fn check_parts(&self) -> Result<(), OutOfRange> {
        part("environment", self.environment.validate())?;
        part("model.thinking", self.model.thinking.validate())?;
        part("city", self.city.validate())?;
        part("traffic", self.traffic.validate())?;
        part("physics", self.physics.validate())?;
        part("delivery", self.delivery.validate())
    }
}

/// Places the error of a part: its text begins with the key, as `roads.length = 3 is out of range`.
fn part<E: std::fmt::Display>(name: &str, result: Result<(), E>) -> Result<(), OutOfRange> {
    result.map_err(|error| {
        let text = error.to_string();
        // Some errors lead with the name of their structure instead of a path.
        let field = text.split(" = ").next().unwrap_or_default();
        let field = field.strip_prefix("PhysicsConfig.").unwrap_or(field);
        let key = format!("{name}.{field}");
        let message = format!(
            "{key}{}",
            text.strip_prefix(text.split(" = ").next().unwrap_or_default()).unwrap_or(&text)
        );
        OutOfRange { key, message }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error_of(text: &str) -> String {
        RunConfig::parse(text, Path::new("run.toml")).unwrap_err().to_string()
    }

    #[test]
    fn an_unknown_key_is_named_with_its_line_and_what_is_allowed() {
        let error = error_of("agents = 3\nsteeps = 10\n");
        assert!(error.contains("run.toml") && error.contains("line 2"), "{error}");
        assert!(error.contains("steeps") && error.contains("steps"), "{error}");
    }

    #[test]
    fn a_wrong_type_is_named_with_its_line() {
        let error = error_of("\nagents = \"many\"\n");
        assert!(error.contains("line 2") && error.contains("string"), "{error}");
    }

    #[test]
    fn a_value_out_of_range_is_named_with_its_line_and_what_is_allowed() {
        let error = error_of("[city.roads]\ncount = 12\nlength = nan\n");
        assert!(error.starts_with("run.toml, line 3: city.roads.length = NaN"), "{error}");
        assert!(error.contains("60 to 1000 m"), "{error}");
        let error = error_of("steps = 0\n");
        assert!(error.starts_with("run.toml, line 1: steps = 0"), "{error}");
        assert!(error_of("[physics]\nsubsteps = 0\n").contains("line 2: physics.substeps = 0"));
    }

    #[test]
    fn a_written_configuration_reads_the_same() {
        let config = RunConfig::default();
        let text = config.to_toml().unwrap();
        assert_eq!(RunConfig::parse(&text, Path::new("config.toml")).unwrap(), config);
    }
}
