//! A place as it was read, and the plane on which it lies.

use std::fs::File;
use std::io::{BufRead, BufReader, Cursor, Read};
use std::path::Path;

use flate2::bufread::MultiGzDecoder;
use simworld_core::geometry::Point2;

use super::error::{OsmError, Warning};
use super::raw::{MISSING, Raw};
use super::read::{pbf, xml};
use super::street;
use crate::GeoOrigin;

/// Nodes farther from the middle than this are left out, m: a plane cannot serve them.
const FARTHEST: f64 = 100_000.0;

/// An extract of OpenStreetMap, read and placed on a plane.
///
/// ```
/// use simworld_citygen::osm::{Place, StreetOptions};
/// let extract = br#"<osm version="0.6">
///     <node id="1" lat="43.7400" lon="7.4200"/>
///     <node id="2" lat="43.7410" lon="7.4200"/>
///     <node id="3" lat="43.7410" lon="7.4215"/>
///     <way id="10"><nd ref="1"/><nd ref="2"/><nd ref="3"/><tag k="highway" v="residential"/></way>
/// </osm>"#;
/// let place = Place::from_xml(&extract[..])?;
/// let (plan, warnings) = place.plan(&StreetOptions::default());
/// assert_eq!((plan.streets.len(), warnings.len()), (1, 0));
/// # Ok::<(), simworld_citygen::osm::OsmError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Place {
    pub(super) raw: Raw,
    /// The point of the Earth at the origin of the plane: the middle of the streets.
    pub origin: GeoOrigin,
    /// Degrees to metres, east and north.
    scale: [f64; 2],
    /// What was odd in the file itself.
    pub(super) warnings: Vec<Warning>,
}

impl Place {
    /// Reads a file: `.osm`, `.osm.gz` or `.osm.pbf`, told apart by their first bytes.
    ///
    /// # Errors
    /// A file that cannot be read, or that is neither.
    pub fn read(path: &Path) -> Result<Self, OsmError> {
        let mut reader = BufReader::with_capacity(1 << 16, File::open(path)?);
        let start = reader.fill_buf()?;
        match start {
            [0x1f, 0x8b, ..] => {
                Self::from_xml(BufReader::with_capacity(1 << 16, MultiGzDecoder::new(reader)))
            }
            // A PBF begins with the length of a short header.
            [0, 0, ..] => Self::from_pbf(reader),
            _ => Self::from_xml(reader),
        }
    }

    /// Reads the bytes of a file, as [`read`](Self::read) does.
    ///
    /// # Errors
    /// Bytes that are no extract.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, OsmError> {
        match bytes {
            [0x1f, 0x8b, ..] => Self::from_xml(BufReader::with_capacity(1 << 16, MultiGzDecoder::new(bytes))),
            [0, 0, ..] => Self::from_pbf(Cursor::new(bytes)),
            _ => Self::from_xml(bytes),
        }
    }

    /// Reads OSM XML.
    ///
    /// # Errors
    /// Text that is no OSM XML, or more than is read.
    pub fn from_xml(reader: impl BufRead) -> Result<Self, OsmError> {
        Ok(Self::of(xml::read(reader)?))
    }

    /// Reads OSM PBF.
    ///
    /// # Errors
    /// Bytes that are no OSM PBF, or more than is read.
    pub fn from_pbf(reader: impl Read) -> Result<Self, OsmError> {
        Ok(Self::of(pbf::read(reader)?))
    }

    fn of(raw: Raw) -> Self {
        let [longitude, latitude] = middle(&raw);
        let origin = GeoOrigin { latitude: latitude.clamp(-85.0, 85.0), longitude };
        let (east, north) = origin.metres_per_degree();
        let mut warnings = Vec::new();
        if raw.unreadable > 0 {
            let what = format!(
                "{} numbers or references cannot be read; what they belong to is left out",
                raw.unreadable
            );
            warnings.push(Warning { what, element: None, at: None });
        }
        Self { raw, origin, scale: [east, north], warnings }
    }

    /// The number of nodes and ways that it holds.
    pub fn size(&self) -> (usize, usize) {
        (self.raw.node_count(), self.raw.ways().len())
    }

    /// A node on the plane; `None` if the extract does not hold it or it lies too far out.
    pub(super) fn point(&self, node: u32) -> Option<Point2> {
        if node == MISSING {
            return None;
        }
        let [longitude, latitude] = self.raw.position(node);
        let point = Point2::new(
            (longitude - self.origin.longitude) * self.scale[0],
            (latitude - self.origin.latitude) * self.scale[1],
        );
        (point.x.abs() <= FARTHEST && point.y.abs() <= FARTHEST).then_some(point)
    }

    /// Longitude and latitude of a point of the plane, degrees.
    pub(super) fn geographic(&self, point: Point2) -> [f64; 2] {
        [self.origin.longitude + point.x / self.scale[0], self.origin.latitude + point.y / self.scale[1]]
    }
}

/// The middle of the box round the streets, longitude and latitude, degrees; of all nodes where there are none. What
/// lies far from most of it does not count.
fn middle(raw: &Raw) -> [f64; 2] {
    /// Degrees from the median within which a node counts.
    const NEAR: f64 = 1.0;
    let streets = raw.ways().iter().filter(|way| street::is_street(&raw.way_tags(way)));
    let mut nodes: Vec<u32> =
        streets.flat_map(|way| raw.nodes_of(way)).copied().filter(|node| *node != MISSING).collect();
    if nodes.is_empty() {
        nodes = (0..raw.node_count() as u32).collect();
    }
    [0, 1].map(|axis| {
        let mut angles: Vec<f64> = nodes.iter().map(|node| raw.position(*node)[axis]).collect();
        let half = angles.len() / 2;
        let median = *angles.select_nth_unstable_by(half, f64::total_cmp).1;
        let near = angles.iter().filter(|angle| (**angle - median).abs() <= NEAR);
        let (low, high) =
            near.fold((f64::MAX, f64::MIN), |(low, high), angle| (low.min(*angle), high.max(*angle)));
        // A tenth of a microdegree is a centimetre: the origin is a number that one can write down.
        ((low + high) * 0.5 * 1e7).round() / 1e7
    })
}
