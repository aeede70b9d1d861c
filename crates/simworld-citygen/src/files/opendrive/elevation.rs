//! Elevation profiles: straight between the nodes of the plan and the heights on the way of a bridge.

use std::io::{self, Write};

use simworld_core::id::{LaneId, RoadId};
use simworld_core::net::{Connection, RoadNetwork, polyline};

/// Heights along a road between two stations of its centreline: share of the way between them and height, m.
pub(super) fn along(network: &RoadNetwork, road: usize, (begin, end): (f64, f64)) -> Vec<(f64, f64)> {
    let id = RoadId::from_index(road);
    let span = (end - begin).max(1e-9);
    let bends = network.roads[road].profile.iter().map(|(station, _)| *station);
    let stations = [begin].into_iter().chain(bends.filter(|station| *station > begin && *station < end));
    let stations = stations.chain([end]);
    stations.map(|station| ((station - begin) / span, network.height(id, station))).collect()
}

/// Heights where a connection begins and where it ends, m.
pub(super) fn between(network: &RoadNetwork, connection: &Connection) -> [f64; 2] {
    let height = |lane: LaneId, is_end: bool| {
        let lane = &network.lanes[lane.index()];
        let point = if is_end { lane.path.last() } else { lane.path.first() };
        let line = &network.roads[lane.road.index()].centerline;
        let near = point.and_then(|point| polyline::closest(line, point));
        network.height(lane.road, near.map_or(0.0, |near| near.station))
    };
    [height(connection.from, true), height(connection.to, false)]
}

/// Writes heights at shares of a length as straight pieces.
pub(super) fn write(heights: &[(f64, f64)], length: f64, out: &mut impl Write) -> io::Result<()> {
    write!(out, "<elevationProfile>")?;
    for pair in heights.windows(2) {
        let ((from, a), (to, b)) = (pair[0], pair[1]);
        let slope = (b - a) / ((to - from) * length).max(1e-9);
        // Nothing is nothing, never less.
        let plain = |x: f64| if x.abs() < 5e-10 { 0.0 } else { x };
        let (s, a, b) = (from * length, plain(a), plain(slope));
        write!(out, r#"<elevation s="{s:.6}" a="{a:.6}" b="{b:.9}" c="0" d="0"/>"#)?;
    }
    writeln!(out, "</elevationProfile>")
}
