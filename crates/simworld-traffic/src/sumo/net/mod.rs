//! SUMO's road networks (`net.xml`), as netconvert and netgenerate write them.
//!
//! An edge is a direction of a road: two edges that lie side by side between the same junctions become one road with
//! lanes both ways, any other edge a one-way road of its own. Lanes keep their shapes, widths, speeds and users;
//! connections run along the internal lanes of the file, a turn in two pieces as one way. What touches and who gives
//! way is what the file's right-of-way requests say. Signals become fixed plans with the file's offsets, one an
//! intersection, and those that follow their vehicles a policy beside ([`SumoPrograms`]); links that always show the same aspect are one
//! group, those of vehicles before those of people. Where phases name those that follow (`next`), a plan is the cycle of the first that
//! are named; among several the policy lets vehicles choose, and phases that never come are left out with a warning.
//! Lanes for people alone become sidewalks, crossings crossings.
//!
//! Source of the format: SUMO user documentation, *Networks/SUMO Road Networks*.

mod build;
mod order;
mod pair;
mod programs;
mod raw;
mod signals;
mod walk;
mod ways;

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use simworld_core::net::RoadNetwork;

use super::{SumoError, SumoWarning};
use crate::NetworkNames;
pub use programs::SumoPrograms;

/// A network that was read, with the names that the file gives its parts.
#[derive(Clone, Debug, Default)]
pub struct SumoNet {
    /// The roads.
    pub network: RoadNetwork,
    /// The ids of edges, lanes, internal lanes and junctions.
    pub names: NetworkNames,
    /// How its signals go on: by the clock unless the traffic has these as its policy.
    pub programs: SumoPrograms,
    /// What has no counterpart here, or not quite, sorted.
    pub warnings: Vec<SumoWarning>,
    /// What was added to projected coordinates to give those of the file, m.
    pub offset: (f64, f64),
    /// The projection, in the words of PROJ; `!` for none.
    pub projection: String,
}

impl SumoNet {
    /// Reads a network.
    ///
    /// ```
    /// use simworld_traffic::sumo::SumoNet;
    /// let xml = r#"<net version="1.20">
    ///     <edge id="in" from="a" to="b" priority="1"><lane id="in_0" index="0" speed="13.9" length="90"
    ///         shape="0,-1.6 90,-1.6"/></edge>
    ///     <edge id="out" from="b" to="c" priority="1"><lane id="out_0" index="0" speed="13.9" length="90"
    ///         shape="110,-1.6 200,-1.6"/></edge>
    ///     <junction id="a" type="dead_end" x="0" y="0"/>
    ///     <junction id="b" type="priority" x="100" y="0"/>
    ///     <junction id="c" type="dead_end" x="200" y="0"/>
    ///     <connection from="in" to="out" fromLane="0" toLane="0" dir="s"/>
    /// </net>"#;
    /// let read = SumoNet::read(xml.as_bytes())?;
    /// assert_eq!((read.network.roads.len(), read.network.connections.len()), (2, 1));
    /// assert!(read.names.leg("in").is_some() && read.warnings.is_empty());
    /// # Ok::<(), simworld_traffic::sumo::SumoError>(())
    /// ```
    ///
    /// # Errors
    /// A text that is no network, that ends too early, or that does not hold together: see [`SumoError`]. What has
    /// merely no counterpart is a [warning](Self::warnings).
    pub fn read(reader: impl BufRead) -> Result<Self, SumoError> {
        build::build(raw::Raw::read(reader)?)
    }

    /// Reads the network in a file.
    ///
    /// # Errors
    /// Those of [`read`](Self::read).
    pub fn open(path: impl AsRef<Path>) -> Result<Self, SumoError> {
        Self::read(BufReader::new(File::open(path)?))
    }
}
