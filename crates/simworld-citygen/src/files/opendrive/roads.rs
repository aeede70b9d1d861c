//! Roads between intersections.

use std::io::{self, Write};

use simworld_core::geometry::{Point2, direction as direction_of};
use simworld_core::id::{LaneId, RoadId};
use simworld_core::net::{
    Connection, CrossSection, Lane, LaneDirection, Road, RoadClass, RoadNetwork, polyline,
};
use simworld_core::ops::wrap_angle;

use super::lanes::strip_of;
use super::{Roads, elevation, geometry};
use crate::files::xml::escaped;

/// Where lanes begin and end along the centreline, m.
pub(super) fn stops(section: &CrossSection, network: &RoadNetwork, road: &Road) -> (f64, f64) {
    let length = polyline::length(&road.centerline);
    let forward = road.forward.first().map(|lane| (*lane, LaneDirection::Forward));
    let lane = forward.or(road.backward.first().map(|lane| (*lane, LaneDirection::Backward)));
    let Some((lane, direction)) = lane else { return (0.0, length) };
    let path = &network.lanes[lane.index()].path;
    let path = if direction == LaneDirection::Forward { path.clone() } else { polyline::reversed(path) };
    // A lane ends square to the centreline: its end moved back by its offset lies on the line, even beside a bend.
    let offset = strip_of(section, network, road, lane).map_or(0.0, |(_, offset)| offset);
    let station = |station: f64, otherwise: f64| {
        let (point, along) = polyline::at(&path, station);
        let left = direction_of(along + std::f64::consts::FRAC_PI_2) * offset;
        // Beside a bend a lane may begin with a piece that runs backwards: then its left is its right.
        let feet = [point - left, point + left];
        let nears = feet.iter().filter_map(|foot| polyline::closest(&road.centerline, foot));
        let nearest = nears.min_by(|a, b| a.distance.total_cmp(&b.distance));
        nearest.map_or(otherwise, |near| near.station)
    };
    (station(0.0, 0.0), station(polyline::length(&path), length))
}

impl Roads<'_> {
    pub(super) fn road(&self, index: usize, out: &mut impl Write) -> io::Result<()> {
        let (road, layout) = (&self.network.roads[index], &self.layouts[index]);
        let line = &self.lines[index];
        let name = road.name.and_then(|name| self.network.names.get(name as usize));
        writeln!(
            out,
            r#"<road name="{}" length="{:.6}" id="{index}" junction="-1" rule="{}">"#,
            escaped(name.map_or("", String::as_str)),
            geometry::length(line),
            layout.rule.as_str()
        )?;
        writeln!(out, "<link>")?;
        for (element, place) in [("predecessor", road.from), ("successor", road.to)] {
            if !self.network.intersections[place.index()].connections.is_empty() {
                let junction = self.junction_number(place.index());
                writeln!(out, r#"<{element} elementType="junction" elementId="{junction}"/>"#)?;
            }
        }
        writeln!(out, "</link>")?;
        let kind = if road.class == RoadClass::Highway { "motorway" } else { "town" };
        let lanes = road.forward.iter().chain(&road.backward);
        let limit = lanes.map(|lane| self.network.lanes[lane.index()].speed_limit).fold(0.0, f64::max);
        writeln!(out, r#"<type s="0" type="{kind}"><speed max="{limit:.3}" unit="m/s"/></type>"#)?;
        geometry::write(line, out)?;
        let length = geometry::length(line);
        elevation::write(&elevation::along(self.network, index, self.stops[index]), length, out)?;
        layout.write(out)?;
        self.signals_of(index, length, out)?;
        writeln!(out, "</road>")
    }

    /// Where a lane of the file begins or ends, and its heading there, radians. The file's lanes end square to the end of
    /// their reference line; those of the network beside a bend close to a junction may end a little beside.
    fn end_of_lane(&self, id: LaneId, is_end: bool) -> (Point2, f64) {
        let lane = &self.network.lanes[id.index()];
        let (index, road) = (lane.road.index(), &self.network.roads[lane.road.index()]);
        let goes_along = road.from == lane.from;
        let Some(ends) = geometry::ends(&self.lines[index]) else {
            return polyline::at(&lane.path, if is_end { lane.length } else { 0.0 });
        };
        let (point, heading) = ends[usize::from(goes_along == is_end)];
        let left = direction_of(heading + std::f64::consts::FRAC_PI_2);
        let turned = if goes_along { 0.0 } else { std::f64::consts::PI };
        (point + left * self.layouts[index].lateral(road, id), wrap_angle(heading + turned))
    }

    /// The path of one connection: a road of one lane about it.
    pub(super) fn connecting_road(&self, index: usize, out: &mut impl Write) -> io::Result<()> {
        let network = self.network;
        let connection = &network.connections[index];
        let (from, to) = (&network.lanes[connection.from.index()], &network.lanes[connection.to.index()]);
        // It leaves as the one lane ends and arrives as the other begins.
        let (start, end) = (self.end_of_lane(connection.from, true), self.end_of_lane(connection.to, false));
        let path = geometry::moved(&connection.path, [start.0, end.0]);
        let line = geometry::cubics(&path, (start.1, end.1));
        let length = geometry::length(&line);
        let rule = self.layouts[from.road.index()].rule;
        writeln!(
            out,
            r#"<road name="" length="{length:.6}" id="{}" junction="{}" rule="{}">"#,
            self.connecting(index),
            self.junction_number(connection.intersection.index()),
            rule.as_str()
        )?;
        let contact = |along: bool| if along { ("end", "start") } else { ("start", "end") };
        let goes_along = |lane: LaneId| {
            let Lane { road, from, .. } = network.lanes[lane.index()];
            network.roads[road.index()].from == from
        };
        let (leaves, enters) = (contact(goes_along(connection.from)).0, contact(goes_along(connection.to)).1);
        writeln!(
            out,
            r#"<link><predecessor elementType="road" elementId="{}" contactPoint="{leaves}"/><successor elementType="road" elementId="{}" contactPoint="{enters}"/></link>"#,
            from.road.0, to.road.0
        )?;
        geometry::write(&line, out)?;
        let heights = elevation::between(network, connection);
        elevation::write(&[(0.0, heights[0]), (1.0, heights[1])], length, out)?;
        let kind = if from.is_driven() { "driving" } else { "biking" };
        self.connecting_lane(connection, kind, length, out)?;
        writeln!(out, "</road>")
    }

    /// One lane beside its inner edge, about the path, on the side that goes along; its width goes from one lane's to the
    /// other's.
    fn connecting_lane(
        &self,
        connection: &Connection,
        kind: &str,
        length: f64,
        out: &mut impl Write,
    ) -> io::Result<()> {
        let network = self.network;
        let [from, to] = [connection.from, connection.to].map(|id| &network.lanes[id.index()]);
        let slope = (to.width - from.width) / length.max(1e-6);
        let number =
            |lane, road: RoadId| self.layouts[road.index()].of_lane(&network.roads[road.index()], lane);
        let (side, own) = self.layouts[from.road.index()].rule.along();
        let lane = format!(
            r#"<{side}><lane id="{own}" type="{kind}" level="false"><link><predecessor id="{}"/><successor id="{}"/></link><width sOffset="0" a="{:.6}" b="{slope:.9}" c="0" d="0"/></lane></{side}>"#,
            number(connection.from, from.road),
            number(connection.to, to.road),
            from.width
        );
        let (left, right) = if own > 0 { (lane.as_str(), "") } else { ("", lane.as_str()) };
        let inner = -0.5 * f64::from(own);
        writeln!(
            out,
            r#"<lanes><laneOffset s="0" a="{:.6}" b="{:.9}" c="0" d="0"/><laneSection s="0">{left}<center><lane id="0" type="none" level="false"/></center>{right}</laneSection></lanes>"#,
            from.width * inner,
            slope * inner
        )
    }
}
