//! A city as one file, without loss: magic, version, then sections of postcard with checksums.
//!
//! Saved is what a city is made of: configuration, plan, buildings, elements, ways for walkers, and the road network too,
//! although it follows from the plan: to read it is several times faster than to derive it, and a city stays what it was
//! when a later version derives roads otherwise. Lists are cut into sections of 65 536 items. All numbers of the frame
//! are little-endian. Sections for ways for walkers off the open ground, and for ways over junctions that are known
//! lane by lane, are there only where a city has some.
//!
//! | bytes | what |
//! |---|---|
//! | 8 | magic, [`MAGIC`] |
//! | 4 | version, [`VERSION`] |
//! | then, per section: 4 | what it holds |
//! | 8 | length of its content, bytes |
//! | 8 | XXH3 of its content |
//! | length | content |

mod before;
mod check;
mod frame;
mod plan;
mod source;
mod walks;

use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use std::{io, thread};

use frame::{Sections, Tag};
use serde::{Deserialize, Serialize};
use simworld_core::net::{DrivingSide, Intersection, NetworkError, NetworkFault, RoadNetwork, StreetPlan};
use source::Source;
use thiserror::Error;

use super::atomic;
use crate::building::Building;
use crate::element::Element;
use crate::{City, CityConfig, CityError, Provenance};

/// The first bytes of a saved city: no text, no other format, and damaged by tools that mend line ends.
pub const MAGIC: [u8; 8] = *b"\x89SIMCTY\n";
/// Version of the format; it changes when the meaning of any byte does. The one before is read too.
pub const VERSION: u32 = 4;
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
    /// Roads that do not hold together.
    #[error(transparent)]
    Roads(#[from] NetworkFault),
    /// The file cannot be read or written.
    #[error(transparent)]
    Io(#[from] io::Error),
}

/// Everything small: what [`City`] holds beside its long lists.
#[derive(Serialize, Deserialize)]
struct Head {
    /// JSON, which names its fields: a setting that a later version adds is then read as its default.
    config: String,
    provenance: Provenance,
    frontage: f64,
    driving_side: DrivingSide,
    counts: Counts,
}

/// Lengths of the lists.
#[derive(Serialize, Deserialize)]
struct Counts {
    buildings: u64,
    elements: u64,
    roads: u64,
    lanes: u64,
    connections: u64,
    intersections: u64,
    sidewalks: u64,
    crossings: u64,
    signals: u64,
    names: u64,
    footpaths: u64,
}

impl Counts {
    fn of(city: &City) -> Self {
        let network = &city.network;
        Self {
            buildings: city.buildings.len() as u64,
            elements: city.elements.len() as u64,
            roads: network.roads.len() as u64,
            lanes: network.lanes.len() as u64,
            connections: network.connections.len() as u64,
            intersections: network.intersections.len() as u64,
            sidewalks: network.sidewalks.len() as u64,
            crossings: network.crossings.len() as u64,
            signals: network.signals.len() as u64,
            names: network.names.len() as u64,
            footpaths: network.footpaths.len() as u64,
        }
    }
}

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
            config: config_to_json(&self.config)?,
            provenance: self.provenance.clone(),
            frontage: self.frontage,
            driving_side: self.network.driving_side,
            counts: Counts::of(self),
        };
        let mut frames = frame::Writer::begin(writer)?;
        frames.section(Tag::Head, &head)?;
        plan::write(&mut frames, &self.plan)?;
        frames.list(Tag::Buildings, &self.buildings)?;
        frames.list(Tag::Elements, &self.elements)?;
        let network = &self.network;
        frames.list(Tag::Roads, &network.roads)?;
        frames.list(Tag::Lanes, &network.lanes)?;
        frames.list(Tag::Connections, &network.connections)?;
        frames.list(Tag::Intersections, &network.intersections)?;
        frames.list(Tag::Sidewalks, &network.sidewalks)?;
        frames.list(Tag::Crossings, &network.crossings)?;
        frames.list(Tag::Signals, &network.signals)?;
        frames.list(Tag::Names, &network.names)?;
        walks::write(&mut frames, network)?;
        frames.end()
    }

    /// Reads a city from the bytes of a file.
    ///
    /// Any bytes are safe to give: what is no city is an error, and memory stays within a small multiple of the file.
    ///
    /// # Errors
    /// Bytes that are no saved city of this version, or a city that cannot be.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SaveError> {
        Self::read(Source::Bytes(bytes))
    }

    fn read(source: Source<'_>) -> Result<Self, SaveError> {
        let sections = Sections::of(source)?;
        let head: Head = if sections.are_of_before() {
            sections.one::<before::Head>(Tag::Head)?.into()
        } else {
            sections.one(Tag::Head)?
        };
        let config = config_from_json(&head.config)?;
        let counts = &head.counts;
        // The roads take about as long as all the rest.
        let (network, things) = thread::scope(|scope| {
            let roads = scope.spawn(|| read_network(&sections, counts, head.driving_side));
            let things = read_things(&sections, counts);
            (roads.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)), things)
        });
        let (network, (plan, buildings, elements)) = (network?, things?);
        check::streets(&plan, &network)?;
        check::buildings(&buildings, &network)?;
        check::anchors(&elements, &network)?;
        Ok(Self {
            config,
            provenance: head.provenance,
            plan,
            network: Arc::new(network),
            buildings,
            elements,
            frontage: head.frontage,
        })
    }

    /// Saves the city as a file, whole or not at all.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), SaveError> {
        atomic::write(path, |file| self.write_to(file))
    }

    /// Loads a city from a file, a section at a time: beside the city, some megabytes are enough.
    ///
    /// # Errors
    /// A file that cannot be read, that is no saved city of this version, or a city that cannot be.
    pub fn load(path: &Path) -> Result<Self, SaveError> {
        Self::read(Source::file(path)?)
    }
}

fn config_to_json(config: &CityConfig) -> Result<String, SaveError> {
    serde_json::to_string(config).map_err(|error| not_a_config(&error))
}

fn config_from_json(text: &str) -> Result<CityConfig, SaveError> {
    let config: CityConfig = serde_json::from_str(text).map_err(|error| not_a_config(&error))?;
    config.validate()?;
    Ok(config)
}

fn not_a_config(error: &serde_json::Error) -> SaveError {
    SaveError::Content { section: Tag::Head.name(), reason: error.to_string() }
}

fn read_things(
    sections: &Sections<'_>,
    counts: &Counts,
) -> Result<(StreetPlan, Vec<Building>, Vec<Element>), SaveError> {
    let plan: StreetPlan = if sections.are_of_before() {
        sections.one::<before::Plan>(Tag::Plan)?.into()
    } else {
        plan::read(sections)?
    };
    plan.validate()?;
    let buildings = sections.list(Tag::Buildings, counts.buildings)?;
    let elements = sections.list(Tag::Elements, counts.elements)?;
    check::elements(&elements)?;
    Ok((plan, buildings, elements))
}

fn read_network(
    sections: &Sections<'_>,
    counts: &Counts,
    driving_side: DrivingSide,
) -> Result<RoadNetwork, SaveError> {
    let (footpaths, plazas) = walks::read(sections, counts.footpaths)?;
    let network = RoadNetwork {
        driving_side,
        roads: sections.list(Tag::Roads, counts.roads)?,
        lanes: sections.list(Tag::Lanes, counts.lanes)?,
        connections: sections.list(Tag::Connections, counts.connections)?,
        intersections: read_intersections(sections, counts.intersections)?,
        sidewalks: sections.list(Tag::Sidewalks, counts.sidewalks)?,
        crossings: sections.list(Tag::Crossings, counts.crossings)?,
        signals: sections.list(Tag::Signals, counts.signals)?,
        names: sections.list(Tag::Names, counts.names)?,
        footpaths,
        plazas,
    };
    network.check()?;
    Ok(network)
}

fn read_intersections(sections: &Sections<'_>, count: u64) -> Result<Vec<Intersection>, SaveError> {
    if sections.are_of_before() {
        let old: Vec<before::Intersection> = sections.list(Tag::Intersections, count)?;
        return Ok(old.into_iter().map(Into::into).collect());
    }
    sections.list(Tag::Intersections, count)
}
