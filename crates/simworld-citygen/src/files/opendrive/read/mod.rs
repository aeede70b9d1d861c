//! Reading OpenDRIVE: roads with their lanes become streets, junctions with all roads within them become nodes.

mod curve;
mod document;
mod error;
mod heights;
mod lanes;
mod over;
mod parts;
mod pieces;
mod plan;
mod section;
mod ways;
mod web;

use std::fs::File;
use std::io::Read;
use std::path::Path;

use simworld_core::net::StreetPlan;
use simworld_core::seed::Seed;

use crate::{City, CityConfig, CityError, GeoOrigin, RoadSource};
pub use error::{OpenDriveError, OpenDriveWarning};

/// Most bytes that are read: the tree of a document is some ten times as large.
const MOST_BYTES: u64 = 256 << 20;

/// The roads of an OpenDRIVE file, versions 1.4 to 1.8, as a plan of streets.
///
/// Reference lines of lines, arcs, spirals and both kinds of cubics are followed within 0.2 m, elevation profiles within
/// 0.05 m. Roads that follow each other alike become one street; one whose lanes change along it becomes several, but what
/// is shorter than 30 m goes with its neighbour. The cross-section of a street is that of the middle of the longest section
/// of its lanes. Junctions become one node each, where the lines of their roads meet.
///
/// Lanes lead where the file links them, over connecting roads, direct junctions and roads too short for a street; the
/// paths themselves are those of the derivation. A lane that begins or ends along a road is entered from the one beside it
/// or leads where that one does. Where the file links nothing, and for bicycles, the derivation has its rules; nobody turns
/// back at a junction. Signals stand at junctions with controllers.
///
/// Of roads that cross without a junction the one that is 2 m higher or more passes over the other on a bridge, a street of
/// its own; of two at the same height the later one does, is raised, and is told. Objects (bridges and tunnels among them),
/// road marks, superelevation and the shape across are not read.
///
/// ```
/// use simworld_citygen::files::opendrive::OpenDrive;
/// let file = r#"<OpenDRIVE><road id="1" junction="-1" length="80" name="Elm Street">
///     <planView><geometry s="0" x="0" y="0" hdg="0" length="80"><line/></geometry></planView>
///     <lanes><laneSection s="0">
///         <left><lane id="1" type="driving"><width sOffset="0" a="3.25" b="0" c="0" d="0"/></lane></left>
///         <right><lane id="-1" type="driving"><width sOffset="0" a="3.25" b="0" c="0" d="0"/></lane></right>
///     </laneSection></lanes></road></OpenDRIVE>"#;
/// let roads = OpenDrive::from_xml(file)?;
/// assert_eq!((roads.plan.streets.len(), roads.warnings.len()), (1, 0));
/// assert_eq!(roads.plan.sections[0].driven(), (1, 1));
/// # Ok::<(), simworld_citygen::files::opendrive::OpenDriveError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct OpenDrive {
    /// The streets, m from the origin of the file.
    pub plan: StreetPlan,
    /// The point of the Earth at the origin, if the file has a transverse Mercator projection about it.
    pub origin: Option<GeoOrigin>,
    /// What was odd.
    pub warnings: Vec<OpenDriveWarning>,
}

impl OpenDrive {
    /// Reads a file.
    ///
    /// # Errors
    /// A file that cannot be read, or that is no OpenDRIVE.
    pub fn read(path: &Path) -> Result<Self, OpenDriveError> {
        let mut text = String::new();
        File::open(path)?.take(MOST_BYTES + 1).read_to_string(&mut text)?;
        Self::from_xml(&text)
    }

    /// Reads a document.
    ///
    /// # Errors
    /// Text that is no OpenDRIVE, or more than is read.
    pub fn from_xml(text: &str) -> Result<Self, OpenDriveError> {
        if text.len() as u64 > MOST_BYTES {
            return Err(OpenDriveError::TooMuch { limit: MOST_BYTES });
        }
        let mut warnings = Vec::new();
        let roads = document::read(text, &mut warnings)?;
        let (keeps_left, origin) = (roads.keeps_left, roads.origin);
        let (mut web, leads) = web::web_of(roads);
        web.join_alike();
        plan::collapse(&mut web, &mut warnings);
        let plan = plan::plan(&web, keeps_left, &leads, &mut warnings);
        Ok(Self { plan, origin, warnings })
    }
}

/// The streets of the file; warnings are dropped.
impl RoadSource for OpenDrive {
    fn streets(&self, _: Seed) -> Result<StreetPlan, CityError> {
        if self.plan.streets.is_empty() { Err(CityError::NoStreets) } else { Ok(self.plan.clone()) }
    }
}

impl City {
    /// Builds a city along the roads of an OpenDRIVE file. The same file, configuration and seed give the same city.
    ///
    /// # Errors
    /// A setting out of range, or a file without a road that can be built.
    pub fn from_opendrive(roads: &OpenDrive, config: &CityConfig, seed: Seed) -> Result<Self, CityError> {
        let mut city = Self::from_source(roads, config, seed)?;
        city.provenance.origin = roads.origin;
        Ok(city)
    }
}
