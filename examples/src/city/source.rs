//! Where a city comes from: grown, read from a map or a file of roads, or loaded as it was saved.

use std::fs;
use std::path::{Path, PathBuf};

use simworld_citygen::files::opendrive::{OpenDrive, OpenDriveError};
use simworld_citygen::files::save::SaveError;
use simworld_citygen::osm::{OsmError, Place, PlaceOptions};
use simworld_citygen::python::{FormatError, read_roads};
use simworld_citygen::{City, CityConfig, CityError, Style};
use simworld_core::seed::Seed;
use thiserror::Error;

use super::Size;

/// Where a city comes from.
#[derive(Clone, Debug)]
pub enum Source {
    /// Grown from its seed, in a style, so far from one side to the other.
    Grown(Style, Size),
    /// A real place, from an extract of OpenStreetMap.
    Osm(PathBuf),
    /// Built along the roads of an OpenDRIVE file.
    OpenDrive(PathBuf),
    /// Built on the roads of a `roads.json` of the Python release.
    Roads(PathBuf),
    /// Loaded as it was saved.
    Saved(PathBuf),
}

impl Source {
    /// A saved city or, without one, a small one of mixed streets, 700 m across.
    pub fn saved_or_small(saved: Option<&PathBuf>) -> Self {
        let small = Size { metres: 700.0 };
        saved.map_or(Self::Grown(Style::Mixed, small), |path| Self::Saved(path.clone()))
    }
}

/// A city, and what had to be mended in its file.
pub struct Made {
    /// The city.
    pub city: City,
    /// One line each.
    pub warnings: Vec<String>,
}

/// Why there is no city.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SourceError {
    /// A file that cannot be opened.
    #[error("{path}: {source}")]
    Open {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// An extract that cannot be used.
    #[error("{path}: {source}")]
    Osm {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: OsmError,
    },
    /// An OpenDRIVE file that cannot be used.
    #[error("{path}: {source}")]
    OpenDrive {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: OpenDriveError,
    },
    /// A file of roads that cannot be used.
    #[error("{path}: {source}")]
    Roads {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: FormatError,
    },
    /// A saved city that cannot be loaded.
    #[error("{path} is no city that can be loaded: {source}; the example `city` writes one")]
    Saved {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: SaveError,
    },
    /// A city that cannot be.
    #[error(transparent)]
    City(#[from] CityError),
}

/// Makes or loads the city.
///
/// # Errors
/// A file that cannot be used, or a setting out of range.
pub fn make(source: &Source, seed: Seed) -> Result<Made, SourceError> {
    match source {
        Source::Grown(style, size) => {
            let roads = style.roads(size.segments(*style, seed));
            let mut city = City::generate(&CityConfig { roads, ..CityConfig::default() }, seed)?;
            city.provenance.style = Some(*style);
            Ok(Made { city, warnings: Vec::new() })
        }
        Source::Osm(path) => {
            let place =
                Place::read(path).map_err(|source| SourceError::Osm { path: path.clone(), source })?;
            let made = City::from_place(&place, &PlaceOptions::default(), &CityConfig::default(), seed);
            let (mut city, warnings) = made?;
            city.provenance.title = title_of(path);
            Ok(Made { city, warnings: warnings.iter().map(ToString::to_string).collect() })
        }
        Source::OpenDrive(path) => {
            let roads = OpenDrive::read(path)
                .map_err(|source| SourceError::OpenDrive { path: path.clone(), source })?;
            let mut city = City::from_opendrive(&roads, &CityConfig::default(), seed)?;
            city.provenance.title = title_of(path);
            Ok(Made { city, warnings: roads.warnings.iter().map(ToString::to_string).collect() })
        }
        Source::Roads(path) => {
            let (plan, warnings) = read_roads(&read(path)?)
                .map_err(|source| SourceError::Roads { path: path.clone(), source })?;
            let city = City::from_plan(plan, &CityConfig::default(), seed)?;
            Ok(Made { city, warnings: warnings.iter().map(ToString::to_string).collect() })
        }
        Source::Saved(path) => {
            let city =
                City::load(path).map_err(|source| SourceError::Saved { path: path.clone(), source })?;
            Ok(Made { city, warnings: Vec::new() })
        }
    }
}

/// The name of the file in words: `campo-grande.osm.gz` is Campo Grande.
fn title_of(path: &Path) -> Option<String> {
    let name = path.file_name()?.to_str()?.split('.').next()?;
    let capital = |word: &str| {
        let mut letters = word.chars();
        letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
    };
    let words: Vec<String> = name.split(['-', '_', ' ']).map(capital).collect();
    Some(words.join(" ")).filter(|title| !title.is_empty())
}

fn read(path: &Path) -> Result<Vec<u8>, SourceError> {
    fs::read(path).map_err(|source| SourceError::Open { path: path.to_owned(), source })
}
