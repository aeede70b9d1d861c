//! The roads as ASAM OpenDRIVE 1.7 (`xodr`), for driving simulators; and, with feature `opendrive`, streets from such files.
//!
//! A road between two intersections is a road whose reference line is its centreline from stop line to stop line,
//! straight pieces joined by arcs; its lanes are the strips of its cross-section, parking, verges and sidewalks
//! included, about the line between its two directions. An intersection is a junction with a connecting road, one
//! cubic (`paramPoly3`), for each connection. Traffic lights stand at the stop lines, with a controller for each group
//! that shows the same. Heights are those of the network, straight between the places where they bend.
//!
//! Source: ASAM OpenDRIVE 1.7.0, chapters 7 to 14. A city that lies somewhere on Earth has a `geoReference`, a
//! transverse Mercator projection about its origin, which departs from the city's own plane by less than its own error.

mod elevation;
mod geometry;
mod junctions;
mod lanes;
#[cfg(feature = "opendrive")]
mod read;
mod roads;
mod signals;

use std::io::{self, Write};

use lanes::Layout;
use simworld_core::net::{Road, RoadNetwork, polyline};

use super::xml::escaped;
use crate::City;
#[cfg(feature = "opendrive")]
pub use read::{OpenDrive, OpenDriveError, OpenDriveWarning};

/// A city with what its roads need.
struct Roads<'a> {
    city: &'a City,
    network: &'a RoadNetwork,
    layouts: Vec<Layout>,
    /// Where each road's reference line begins and ends along its centreline, m.
    stops: Vec<(f64, f64)>,
    /// The reference lines of the roads.
    lines: Vec<Vec<geometry::Piece>>,
}

impl City {
    /// Writes the roads as OpenDRIVE 1.7.
    ///
    /// ```
    /// use simworld_citygen::{City, CityConfig};
    /// use simworld_core::seed::Seed;
    /// let city = City::generate(&CityConfig::with_roads(8), Seed(3))?;
    /// let mut xml = Vec::new();
    /// city.write_opendrive(&mut xml)?;
    /// assert!(String::from_utf8(xml)?.contains("<OpenDRIVE>"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// The writer's.
    pub fn write_opendrive(&self, writer: &mut impl Write) -> io::Result<()> {
        let network = &*self.network;
        // Roads are indexed as the streets of the plan.
        let section = |index: usize| self.plan.section(&self.plan.streets[index]);
        let indexed = || network.roads.iter().enumerate();
        let layouts = indexed().map(|(index, road)| Layout::of(section(index), network, road)).collect();
        let stops: Vec<(f64, f64)> =
            indexed().map(|(index, road)| roads::stops(section(index), network, road)).collect();
        let between = |(road, stops): (&Road, &(f64, f64))| {
            geometry::rounded(&polyline::slice(&road.centerline, stops.0, stops.1))
        };
        let lines = network.roads.iter().zip(&stops).map(between).collect();
        let roads = Roads { city: self, network, layouts, stops, lines };
        roads.write(writer)
    }
}

impl Roads<'_> {
    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
        writeln!(out, "<OpenDRIVE>")?;
        self.header(out)?;
        for index in 0..self.network.roads.len() {
            self.road(index, out)?;
        }
        for index in 0..self.network.connections.len() {
            self.connecting_road(index, out)?;
        }
        self.controllers(out)?;
        for index in 0..self.network.intersections.len() {
            self.junction(index, out)?;
        }
        writeln!(out, "</OpenDRIVE>")
    }

    fn header(&self, out: &mut impl Write) -> io::Result<()> {
        let name = self.city.provenance.title.as_deref().unwrap_or("simworld");
        let (low, high) = self.network.bounds().unwrap_or_default();
        writeln!(
            out,
            r#"<header revMajor="1" revMinor="7" name="{}" version="1.00" north="{:.3}" south="{:.3}" east="{:.3}" west="{:.3}" vendor="simworld">"#,
            escaped(name),
            high.y,
            low.y,
            high.x,
            low.x
        )?;
        if let Some(origin) = self.city.provenance.origin {
            writeln!(
                out,
                "<geoReference><![CDATA[+proj=tmerc +lat_0={} +lon_0={} +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs]]></geoReference>",
                origin.latitude, origin.longitude
            )?;
        }
        writeln!(out, "</header>")
    }

    /// The number of a connecting road; the roads come first.
    fn connecting(&self, connection: usize) -> usize {
        self.network.roads.len() + connection
    }

    /// The number of a junction, which no road has.
    fn junction_number(&self, intersection: usize) -> usize {
        self.network.roads.len() + self.network.connections.len() + intersection
    }
}
