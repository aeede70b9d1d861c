//! A city as an extract of OpenStreetMap would have it, for what reads such extracts to be measured on.

use std::fmt::{self, Write};

use simworld_citygen::building::Building;
use simworld_citygen::{City, GeoOrigin};
use simworld_core::geometry::Point2;
use simworld_core::net::{RoadClass, StreetPlan};

/// Where the origin of the city lies on the earth.
const ORIGIN: GeoOrigin = GeoOrigin { latitude: 50.0, longitude: 8.0 };
/// What else editors leave in every element.
const EDITED: &str =
    "version=\"3\" timestamp=\"2024-03-22T14:09:45Z\" changeset=\"11480240\" uid=\"1\" user=\"somebody\"";

/// OSM XML of a city's streets and buildings, as Overpass writes it: each node and way with who edited it when, bends as
/// nodes of their own, streets with class, name and pavement, houses with storeys.
pub fn as_extract(city: &City) -> String {
    let mut extract = Extract { text: String::new(), nodes: 0, ways: 0 };
    // A string takes all that is written to it.
    extract.city(city).unwrap_or_default();
    extract.text
}

struct Extract {
    text: String,
    nodes: usize,
    ways: usize,
}

impl Extract {
    fn city(&mut self, city: &City) -> fmt::Result {
        writeln!(self.text, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<osm version=\"0.6\">")?;
        // Files have all nodes before the ways.
        let plan = &city.plan;
        for node in &plan.nodes {
            self.node(*node)?;
        }
        let mut streets = Vec::with_capacity(plan.streets.len());
        for street in &plan.streets {
            let mut line = vec![street.from + 1];
            for bend in &street.via {
                line.push(self.node(*bend)?);
            }
            line.push(street.to + 1);
            streets.push(line);
        }
        let mut houses = Vec::with_capacity(city.buildings.len());
        for building in &city.buildings {
            let mut ring = building
                .outline()
                .into_iter()
                .map(|corner| self.node(corner))
                .collect::<Result<Vec<_>, _>>()?;
            ring.extend(ring.first().copied());
            houses.push(ring);
        }
        for (index, line) in streets.iter().enumerate() {
            self.street(plan, index, line)?;
        }
        for (building, ring) in city.buildings.iter().zip(&houses) {
            self.house(building, ring)?;
        }
        writeln!(self.text, "</osm>")
    }

    /// Writes a node and returns its number.
    fn node(&mut self, at: Point2) -> Result<usize, fmt::Error> {
        self.nodes += 1;
        let (id, [longitude, latitude]) = (self.nodes, ORIGIN.to_geographic(at));
        writeln!(self.text, "  <node id=\"{id}\" lat=\"{latitude:.7}\" lon=\"{longitude:.7}\" {EDITED}/>")?;
        Ok(id)
    }

    fn way(&mut self, nodes: &[usize], tags: &[(&str, &str)]) -> fmt::Result {
        self.ways += 1;
        writeln!(self.text, "  <way id=\"{}\" {EDITED}>", self.ways)?;
        for node in nodes {
            writeln!(self.text, "    <nd ref=\"{node}\"/>")?;
        }
        for (key, value) in tags {
            writeln!(self.text, "    <tag k=\"{key}\" v=\"{value}\"/>")?;
        }
        writeln!(self.text, "  </way>")
    }

    fn street(&mut self, plan: &StreetPlan, index: usize, line: &[usize]) -> fmt::Result {
        let street = &plan.streets[index];
        let class = match street.class {
            RoadClass::Local => "residential",
            RoadClass::Arterial => "secondary",
            RoadClass::Highway => "primary",
        };
        let name = street.name.map_or("Elm Street", |name| &plan.names[name as usize]);
        let lanes = if street.class == RoadClass::Local { "2" } else { "4" };
        let tags = [
            ("highway", class),
            ("name", name),
            ("lanes", lanes),
            ("sidewalk", "both"),
            ("surface", "asphalt"),
        ];
        self.way(line, &tags)
    }

    fn house(&mut self, building: &Building, ring: &[usize]) -> fmt::Result {
        let storeys = building.storeys.to_string();
        self.way(ring, &[("building", "yes"), ("building:levels", &storeys)])
    }
}

#[cfg(test)]
mod tests {
    use simworld_citygen::osm::{Fill, Place, PlaceOptions};
    use simworld_citygen::{CityConfig, Style};
    use simworld_core::seed::Seed;

    use super::*;

    #[test]
    fn a_city_is_read_again_from_its_extract() {
        let config = CityConfig { roads: Style::Mixed.roads(60), ..CityConfig::default() };
        let city = City::generate(&config, Seed(5)).expect("a city");
        let place = Place::from_xml(as_extract(&city).as_bytes()).expect("an extract");
        let options =
            PlaceOptions { buildings: Fill::Never, elements: Fill::Never, ..PlaceOptions::default() };
        let (read, _) = City::from_place(&place, &options, &CityConfig::default(), Seed(5)).expect("a city");
        let kept = |read: usize, written: usize| read as f64 >= 0.8 * written as f64 && read <= written;
        let (roads, written) = (read.network.roads.len(), city.network.roads.len());
        assert!(kept(roads, written), "{roads} of {written} roads");
        let (houses, written) = (read.buildings.len(), city.buildings.len());
        assert!(kept(houses, written), "{houses} of {written} houses");
    }
}
