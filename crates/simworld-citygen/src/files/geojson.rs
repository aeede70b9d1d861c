//! The city as GeoJSON (RFC 7946), a feature a line.
//!
//! GeoJSON speaks of longitudes and latitudes alone. A city that lies somewhere on Earth is written so: give its
//! [`GeoOrigin`], or let [`City::write_geojson`] take the one of the city's provenance. A city that lies nowhere is
//! written in its own metres, x east and y north, which RFC 7946 (section 4) allows between those who agree on it; the
//! member `frame` of the collection says which of the two it is.
//!
//! Every feature has `layer`: `street`, `lane`, `intersection`, `sidewalk`, `crossing`, `footpath`, `building`,
//! `element`, and in its `id` that layer and its index in the city. A `footpath` has the `level` on which it lies, 0 on the
//! ground, and is `covered` where it leads through a building.

use std::io::{self, Write};

use serde_json::{Map, Value, json};
use simworld_core::geometry::Point2;
use simworld_core::net::RoadNetwork;

use crate::{City, GeoOrigin};

impl City {
    /// Writes the city as GeoJSON: in longitude and latitude if its provenance says where it lies, in metres
    /// otherwise.
    ///
    /// ```
    /// use simworld_citygen::{City, CityConfig, GeoOrigin};
    /// use simworld_core::seed::Seed;
    /// let mut city = City::generate(&CityConfig::with_roads(8), Seed(3))?;
    /// city.provenance.origin = Some(GeoOrigin { latitude: 60.17, longitude: 24.94 });
    /// let mut text = Vec::new();
    /// city.write_geojson(&mut text)?;
    /// assert!(text.starts_with(b"{\"type\":\"FeatureCollection\""));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// The writer's.
    pub fn write_geojson(&self, writer: &mut impl Write) -> io::Result<()> {
        let frame = if self.provenance.origin.is_some() {
            "longitude and latitude, WGS 84"
        } else {
            "metres, x east, y north"
        };
        write!(writer, r#"{{"type":"FeatureCollection","frame":{},"features":["#, json!(frame))?;
        let mut out = Features { writer, origin: self.provenance.origin, is_first: true };
        out.roads(&self.network)?;
        out.things(self)?;
        writeln!(out.writer, "\n]}}")
    }
}

struct Features<'a, W> {
    writer: &'a mut W,
    origin: Option<GeoOrigin>,
    is_first: bool,
}

/// What a feature is made of.
enum Geometry<'a> {
    Point(Point2),
    Line(&'a [Point2]),
    /// Without its last point, which is its first.
    Polygon(&'a [Point2]),
    /// A polygon with holes, all counter-clockwise.
    Area(&'a [Point2], &'a [Vec<Point2>]),
}

impl<W: Write> Features<'_, W> {
    fn roads(&mut self, network: &RoadNetwork) -> io::Result<()> {
        for (index, road) in network.roads.iter().enumerate() {
            let properties = json!({
                "class": road.class,
                "name": road.name.and_then(|name| network.names.get(name as usize)),
                "width_m": millimetres(road.width),
                "lanes_forward": road.forward.len(),
                "lanes_backward": road.backward.len(),
                "from": road.from,
                "to": road.to,
            });
            self.feature("street", index, &Geometry::Line(&road.centerline), properties)?;
        }
        for (index, lane) in network.lanes.iter().enumerate() {
            let properties = json!({
                "road": lane.road,
                "kind": lane.kind,
                "width_m": millimetres(lane.width),
                "speed_limit_m_s": millimetres(lane.speed_limit),
            });
            self.feature("lane", index, &Geometry::Line(&lane.path), properties)?;
        }
        for (index, place) in network.intersections.iter().enumerate() {
            let properties = json!({ "control": place.control, "streets": place.roads.len() });
            let geometry = if place.outline.len() >= 3 {
                Geometry::Polygon(&place.outline)
            } else {
                Geometry::Point(place.center)
            };
            self.feature("intersection", index, &geometry, properties)?;
        }
        for (index, sidewalk) in network.sidewalks.iter().enumerate() {
            let properties = json!({ "road": sidewalk.road, "side": sidewalk.side, "width_m": millimetres(sidewalk.width) });
            self.feature("sidewalk", index, &Geometry::Line(&sidewalk.path), properties)?;
        }
        for (index, crossing) in network.crossings.iter().enumerate() {
            let properties = json!({
                "road": crossing.road,
                "intersection": crossing.intersection,
                "width_m": millimetres(crossing.width),
                "signals": crossing.signal.is_some(),
            });
            let line = [crossing.start, crossing.end];
            self.feature("crossing", index, &Geometry::Line(&line), properties)?;
        }
        for (index, way) in network.footpaths.iter().enumerate() {
            let properties = json!({ "width_m": millimetres(way.width), "level": way.level, "covered": way.covered, "plaza": way.plaza });
            self.feature("footpath", index, &Geometry::Line(&way.path), properties)?;
        }
        for (index, plaza) in network.plazas.iter().enumerate() {
            let turned = |hole: &Vec<Point2>| hole.iter().rev().copied().collect();
            let holes: Vec<Vec<Point2>> = plaza.holes.iter().map(turned).collect();
            let properties = json!({ "area_m2": millimetres(plaza.area()) });
            self.feature("plaza", index, &Geometry::Area(&plaza.edge, &holes), properties)?;
        }
        Ok(())
    }

    fn things(&mut self, city: &City) -> io::Result<()> {
        for (index, building) in city.buildings.iter().enumerate() {
            let properties = json!({
                "type": building.archetype.name,
                "use": building.place,
                "name": building.name,
                "zone": building.zone.as_str(),
                "storeys": building.storeys,
                "roof": building.roof,
                "height_m": millimetres(building.height()),
            });
            let (outline, courts) = (building.outline(), building.courtyards());
            self.feature("building", index, &Geometry::Area(&outline, &courts), properties)?;
        }
        for (index, element) in city.elements.iter().enumerate() {
            let properties = json!({ "kind": element.kind, "height_m": millimetres(element.shape.size().z) });
            self.feature("element", index, &Geometry::Point(element.position), properties)?;
        }
        Ok(())
    }

    fn feature(
        &mut self,
        layer: &str,
        index: usize,
        geometry: &Geometry<'_>,
        properties: Value,
    ) -> io::Result<()> {
        let mut members = Map::new();
        members.insert("layer".to_owned(), layer.into());
        if let Value::Object(properties) = properties {
            // What is not known is left out.
            members.extend(properties.into_iter().filter(|(_, value)| !value.is_null()));
        }
        let feature = json!({
            "type": "Feature",
            "id": format!("{layer}/{index}"),
            "geometry": self.geometry(geometry),
            "properties": members,
        });
        let comma = if std::mem::take(&mut self.is_first) { "\n" } else { ",\n" };
        self.writer.write_all(comma.as_bytes())?;
        serde_json::to_writer(&mut *self.writer, &feature).map_err(io::Error::from)
    }

    fn geometry(&self, geometry: &Geometry<'_>) -> Value {
        match geometry {
            Geometry::Point(point) => json!({ "type": "Point", "coordinates": self.position(*point) }),
            Geometry::Line(line) => json!({ "type": "LineString", "coordinates": self.positions(line) }),
            Geometry::Polygon(ring) => json!({ "type": "Polygon", "coordinates": [self.ring(ring)] }),
            Geometry::Area(outline, holes) => {
                let mut rings = vec![self.ring(outline)];
                for hole in *holes {
                    let mut ring = self.ring(hole);
                    ring.reverse();
                    rings.push(ring);
                }
                json!({ "type": "Polygon", "coordinates": rings })
            }
        }
    }

    fn ring(&self, points: &[Point2]) -> Vec<[f64; 2]> {
        let mut ring = self.positions(points);
        ring.extend(ring.first().copied());
        ring
    }

    fn positions(&self, points: &[Point2]) -> Vec<[f64; 2]> {
        points.iter().map(|point| self.position(*point)).collect()
    }

    /// A millimetre in either frame.
    fn position(&self, point: Point2) -> [f64; 2] {
        match self.origin {
            Some(origin) => origin.to_geographic(point).map(|angle| (angle * 1e8).round() / 1e8),
            None => [millimetres(point.x), millimetres(point.y)],
        }
    }
}

fn millimetres(x: f64) -> f64 {
    (x * 1000.0).round() / 1000.0
}
