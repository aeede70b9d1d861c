//! A city as one file, without loss: magic, version, then sections of postcard with checksums.
//!
//! Saved is what a city is made of: configuration, plan, buildings, elements. The road network is not: it follows from
//! the plan bit for bit, and deriving it anew costs less than reading it would. All numbers of the frame are
//! little-endian.
//!
//! | bytes | what |
//! |---|---|
//! | 8 | magic, [`MAGIC`] |
//! | 4 | version, [`VERSION`] |
//! | then, per section: 4 | what it holds |
//! | 8 | length of its content, bytes |
//! | 8 | XXH3 of its content |
//! | length | content |

mod check;
mod frame;

use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use std::{fs, io, thread};

use frame::{Frames, Tag};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use simworld_core::net::{NetworkError, RoadNetwork, StreetPlan};
use thiserror::Error;

use super::atomic;
use crate::building::Building;
use crate::element::Element;
use crate::{City, CityConfig, CityError, Provenance};

/// The first bytes of a saved city: no text, no other format, and damaged by tools that mend line ends.
pub const MAGIC: [u8; 8] = *b"\x89SIMCTY\n";
/// Version of the format; it changes when the meaning of any byte does.
pub const VERSION: u32 = 1;
/// The usual ending of the name of a saved city.
pub const EXTENSION: &str = "simcity";
/// Files larger than this are refused, bytes.
pub const MOST_BYTES: u64 = 4 << 30;

/// Why a city cannot be saved or loaded.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SaveError {
    /// Another kind of file.
    #[error(
        "no saved city: it does not begin with the magic of one; give a file that was written by `City::save`"
    )]
    Foreign,
    /// Another version of the format.
    #[error(
        "the file has version {found} of the format, this program reads {VERSION}: load it with the program that saved \
         it, or make the city again from its seed"
    )]
    Version {
        /// The version of the file.
        found: u32,
    },
    /// The file ends too early.
    #[error("the file ends within {section}, {missing} bytes short: copy it again")]
    Truncated {
        /// The part at fault.
        section: &'static str,
        /// Bytes that are missing, at least.
        missing: u64,
    },
    /// A section that is not what was written.
    #[error("{section} is damaged, its checksum differs: copy the file again")]
    Checksum {
        /// The section at fault.
        section: &'static str,
    },
    /// A section whose content has another structure.
    #[error("{section} cannot be read ({reason}): the file was not written by this version of the program")]
    Content {
        /// The section at fault.
        section: &'static str,
        /// What the decoder says.
        reason: String,
    },
    /// A section that is missing, unknown or out of order.
    #[error("{found} where {expected} should be: the file was not written by this version of the program")]
    Section {
        /// What is there.
        found: &'static str,
        /// What should be.
        expected: &'static str,
    },
    /// The file is too large.
    #[error("{bytes} bytes are more than the {MOST_BYTES} that a saved city may have")]
    TooLarge {
        /// Its size.
        bytes: u64,
    },
    /// A thing that cannot stand where it does.
    #[error("{what} {index} {fault}: the file was not written by this program")]
    Unsound {
        /// What it is.
        what: &'static str,
        /// Its index.
        index: usize,
        /// What is wrong with it.
        fault: &'static str,
    },
    /// A configuration out of range.
    #[error(transparent)]
    City(#[from] CityError),
    /// Streets that cannot be built.
    #[error(transparent)]
    Network(#[from] NetworkError),
    /// The file cannot be read or written.
    #[error(transparent)]
    Io(#[from] io::Error),
}

/// Everything small: what [`City`] holds beside its long lists.
#[derive(Serialize, Deserialize)]
struct Head {
    config: CityConfig,
    provenance: Provenance,
    frontage: f64,
    frontage_used: f64,
    buildings: u64,
    elements: u64,
}

/// Items a section of buildings or elements: enough that framing costs nothing, few enough that buffers stay small.
const CHUNK: usize = 1 << 16;

impl City {
    /// Writes the city. The same city gives the same bytes.
    ///
    /// ```
    /// use simworld_citygen::{City, CityConfig};
    /// use simworld_core::seed::Seed;
    /// let city = City::generate(&CityConfig::with_roads(12), Seed(7))?;
    /// let mut bytes = Vec::new();
    /// city.write_to(&mut bytes)?;
    /// assert_eq!(City::from_bytes(&bytes)?, city);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// The writer's.
    pub fn write_to(&self, writer: &mut impl Write) -> Result<(), SaveError> {
        let head = Head {
            config: self.config.clone(),
            provenance: self.provenance.clone(),
            frontage: self.frontage,
            frontage_used: self.frontage_used,
            buildings: self.buildings.len() as u64,
            elements: self.elements.len() as u64,
        };
        let mut frames = frame::Writer::begin(writer)?;
        frames.section(Tag::Head, &head)?;
        frames.section(Tag::Plan, &self.plan)?;
        for buildings in self.buildings.chunks(CHUNK) {
            frames.section(Tag::Buildings, buildings)?;
        }
        for elements in self.elements.chunks(CHUNK) {
            frames.section(Tag::Elements, elements)?;
        }
        frames.end()
    }

    /// Reads a city from the bytes of a file.
    ///
    /// Any bytes are safe to give: what is no city is an error, and memory stays within a small multiple of the file.
    ///
    /// # Errors
    /// Bytes that are no saved city of this version, or a city that cannot be.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SaveError> {
        let mut frames = Frames::of(bytes)?;
        let head: Head = frames.decode(Tag::Head)?;
        let plan: StreetPlan = frames.decode(Tag::Plan)?;
        head.config.validate()?;
        check::plan(&plan)?;
        // The roads take about as long as all the rest.
        let (network, lists) = thread::scope(|scope| {
            let roads = scope.spawn(|| RoadNetwork::derive(&plan, &head.config.network));
            let lists = lists(&mut frames, &head);
            let network = roads.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            (network, lists)
        });
        let (network, (buildings, elements)) = (network?, lists?);
        check::buildings(&buildings, &network)?;
        check::elements(&elements)?;
        Ok(Self {
            config: head.config,
            provenance: head.provenance,
            plan,
            network: Arc::new(network),
            buildings,
            elements,
            frontage: head.frontage,
            frontage_used: head.frontage_used,
        })
    }

    /// Saves the city as a file, whole or not at all.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), SaveError> {
        atomic::write(path, |file| self.write_to(file))
    }

    /// Loads a city from a file.
    ///
    /// # Errors
    /// A file that cannot be read, that is no saved city of this version, or a city that cannot be.
    pub fn load(path: &Path) -> Result<Self, SaveError> {
        let bytes = fs::metadata(path)?.len();
        if bytes > MOST_BYTES {
            return Err(SaveError::TooLarge { bytes });
        }
        Self::from_bytes(&fs::read(path)?)
    }
}

fn lists(frames: &mut Frames<'_>, head: &Head) -> Result<(Vec<Building>, Vec<Element>), SaveError> {
    let buildings = gather(frames, Tag::Buildings, head.buildings)?;
    let elements = gather(frames, Tag::Elements, head.elements)?;
    frames.finish()?;
    Ok((buildings, elements))
}

/// Reads as many items as were announced, section by section.
fn gather<T: DeserializeOwned>(frames: &mut Frames<'_>, tag: Tag, count: u64) -> Result<Vec<T>, SaveError> {
    let mut items: Vec<T> = Vec::new();
    while (items.len() as u64) < count {
        let mut some: Vec<T> = frames.decode(tag)?;
        if some.is_empty() || items.len() as u64 + some.len() as u64 > count {
            let reason = format!("{count} items were announced");
            return Err(SaveError::Content { section: tag.name(), reason });
        }
        if items.is_empty() {
            // No more than what is left of the file can hold, whatever was announced.
            items.reserve_exact(count.min(frames.left()) as usize);
        }
        items.append(&mut some);
    }
    Ok(items)
}
