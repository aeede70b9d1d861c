//! The roads as a SUMO network (`net.xml`), as SUMO's own netconvert writes them: ready to simulate, nothing left to
//! compute.
//!
//! A road is two edges, `r7` along its centreline and `-r7` against it; lanes are counted from the right, the sidewalk
//! first. An intersection is a junction `j3` with an internal lane a connection, crossings `:j3_c0` and walking areas
//! `:j3_w0` at its corners, right-of-way requests, and a `tlLogic` where it has signals. Geographic cities carry no
//! projection: coordinates are metres of the city's own plane.
//!
//! Source of the format: SUMO user documentation, *Networks/SUMO Road Networks*.

mod edges;
mod junctions;
mod signals;

use std::io::{self, Write};

use edges::Edges;
use simworld_core::net::RoadNetwork;

use super::xml::Two;
use crate::City;

impl City {
    /// Writes the roads as a SUMO network.
    ///
    /// ```
    /// use simworld_citygen::{City, CityConfig};
    /// use simworld_core::seed::Seed;
    /// let city = City::generate(&CityConfig::with_roads(8), Seed(3))?;
    /// let mut xml = Vec::new();
    /// city.write_sumo(&mut xml)?;
    /// assert!(String::from_utf8(xml)?.contains("<edge id=\"r0\" from="));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// The writer's.
    pub fn write_sumo(&self, writer: &mut impl Write) -> io::Result<()> {
        write(&self.network, writer)
    }
}

/// Writes roads as a SUMO network.
///
/// # Errors
/// The writer's.
pub fn write(network: &RoadNetwork, out: &mut impl Write) -> io::Result<()> {
    let edges = Edges::of(network);
    let junctions = junctions::of(network, &edges);
    writeln!(out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
    writeln!(
        out,
        r#"<net version="1.20" junctionCornerDetail="5" limitTurnSpeed="5.50" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="http://sumo.dlr.de/xsd/net_file.xsd">"#
    )?;
    if let Some((low, high)) = network.bounds() {
        let bounds = format!("{},{},{},{}", Two(low.x), Two(low.y), Two(high.x), Two(high.y));
        writeln!(
            out,
            r#"<location netOffset="0.00,0.00" convBoundary="{bounds}" origBoundary="{bounds}" projParameter="!"/>"#
        )?;
    }
    for junction in &junctions {
        junction.write_internal_edges(network, out)?;
    }
    edges.write(network, out)?;
    signals::write(network, &junctions, out)?;
    for junction in &junctions {
        junction.write(network, &edges, out)?;
    }
    for junction in &junctions {
        junction.write_connections(network, &edges, out)?;
    }
    writeln!(out, "</net>")
}
