//! Streets, their pieces and where they meet, as answers write them: by names, for a model knows no numbers of roads.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::FRAC_PI_2;

use simworld_core::geometry::{Point2, heading};
use simworld_core::id::{IntersectionId, RoadId};
use simworld_core::net::RoadNetwork;

use super::super::prompts::one_line;

/// The names of a network's streets and junctions.
pub(super) struct Ways<'a> {
    network: &'a RoadNetwork,
    /// Streets by name, with their pieces from junction to junction, ascending.
    named: BTreeMap<&'a str, Vec<RoadId>>,
}

impl<'a> Ways<'a> {
    pub(super) fn of(network: &'a RoadNetwork) -> Self {
        let mut named: BTreeMap<&str, Vec<RoadId>> = BTreeMap::new();
        for road in (0..network.roads.len()).map(RoadId::from_index) {
            if let Some(name) = network.road_name(road) {
                named.entry(name).or_default().push(road);
            }
        }
        Self { network, named }
    }

    /// Whole streets by name.
    pub(super) fn streets(&self) -> impl Iterator<Item = (&'a str, &[RoadId])> {
        self.named.iter().map(|(name, roads)| (*name, roads.as_slice()))
    }

    /// How far the nearest point of a street's pieces is from a place, by the corners of their centrelines, m.
    pub(super) fn away(&self, roads: &[RoadId], from: Point2) -> f64 {
        let lines = roads.iter().filter_map(|road| self.network.roads.get(road.index()));
        let points = lines.flat_map(|road| &road.centerline);
        points.map(|at| (at - from).norm()).fold(f64::INFINITY, f64::min)
    }

    /// What a piece is called: "Oak Street from Harbour Road to Station Road", from west to east or from south to north.
    pub(super) fn piece(&self, road: RoadId) -> String {
        let Some(name) = self.network.road_name(road) else { return format!("street {road}") };
        let own = self.span(name, road);
        let pieces = self.named.get(name).map_or(&[][..], Vec::as_slice);
        let alike = |other: &&RoadId| **other < road && self.span(name, **other) == own;
        let before = pieces.iter().filter(alike).count();
        numbered(own, before)
    }

    fn span(&self, name: &str, road: RoadId) -> String {
        let Some(road) = self.network.roads.get(road.index()) else { return one_line(name) };
        let across = |end: IntersectionId| {
            let meet = self.network.intersections.get(end.index()).map_or(&[][..], |place| &place.roads[..]);
            let mut names = meet.iter().filter_map(|road| self.network.road_name(*road));
            names.find(|other| *other != name).unwrap_or("its end")
        };
        let mut ends = [across(road.from), across(road.to)];
        if let [first, .., last] = road.centerline[..] {
            let way = last - first;
            let is_back = if way.x.abs() >= way.y.abs() { way.x < 0.0 } else { way.y < 0.0 };
            if is_back {
                ends.reverse();
            }
        }
        one_line(&format!("{name} from {} to {}", ends[0], ends[1]))
    }

    /// What a junction is called: "Elm Street and Oak Street".
    pub(super) fn junction(&self, place: IntersectionId) -> String {
        let names = self.meeting(place);
        let Some(first) = names.first().filter(|_| names.len() > 1) else {
            return format!("junction {place}");
        };
        let own = one_line(&names.iter().copied().collect::<Vec<_>>().join(" and "));
        let pieces = self.named.get(first).map_or(&[][..], Vec::as_slice);
        let roads = pieces.iter().filter_map(|road| self.network.roads.get(road.index()));
        let ends: BTreeSet<IntersectionId> = roads.flat_map(|road| [road.from, road.to]).collect();
        let alike = ends.range(..place).filter(|other| self.meeting(**other) == names);
        numbered(own, alike.count())
    }

    /// The names of the streets that meet somewhere.
    pub(super) fn meeting(&self, place: IntersectionId) -> BTreeSet<&'a str> {
        let roads = self.network.intersections.get(place.index()).map_or(&[][..], |place| &place.roads[..]);
        roads.iter().filter_map(|road| self.network.road_name(*road)).collect()
    }

    /// Where a piece of one of these streets ends, ascending.
    pub(super) fn junctions_of(&self, roads: &[RoadId]) -> BTreeSet<IntersectionId> {
        let roads = roads.iter().filter_map(|road| self.network.roads.get(road.index()));
        roads.flat_map(|road| [road.from, road.to]).collect()
    }

    /// Where a street begins and where it ends; none of those that do not run from one place to another.
    pub(super) fn ends(&self, roads: &[RoadId]) -> Option<[Point2; 2]> {
        let roads = roads.iter().filter_map(|road| self.network.roads.get(road.index()));
        let mut places: Vec<IntersectionId> = roads.flat_map(|road| [road.from, road.to]).collect();
        places.sort_unstable();
        let once = places.chunk_by(|one, other| one == other).filter(|same| same.len() == 1);
        let ends: Vec<Point2> = once
            .filter_map(|place| self.network.intersections.get(place[0].index()))
            .map(|place| place.center)
            .collect();
        <[Point2; 2]>::try_from(ends).ok()
    }

    /// In which direction the left side of a street lies as its first piece runs, radians from east.
    pub(super) fn left(&self, roads: &[RoadId]) -> Option<f64> {
        let road = self.network.roads.get(roads.first()?.index())?;
        let way = road.centerline.last()? - road.centerline.first()?;
        Some(heading(&way) + FRAC_PI_2)
    }
}

/// The name of one of several that are called the same.
fn numbered(name: String, before: usize) -> String {
    if before == 0 { name } else { format!("{name} ({})", before + 1) }
}

#[cfg(test)]
mod tests {
    use simworld_core::net::{NetworkConfig, StreetPlan};

    use super::*;

    fn network() -> RoadNetwork {
        let mut plan = StreetPlan::grid(3, 3, 100.0);
        let names = ["Oak Street", "Elm Street", "Mill Lane"].map(|name| plan.add_name(name));
        let nodes = plan.nodes.clone();
        for street in &mut plan.streets {
            let (from, to) = (nodes[street.from], nodes[street.to]);
            // Streets that go east bear a name each, and those that go north share the last.
            let row = (from.y / 100.0).round() as usize;
            street.name = Some(if from.y == to.y { names[row.min(1)] } else { names[2] });
        }
        RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap()
    }

    #[test]
    fn no_two_pieces_and_no_two_junctions_are_called_the_same() {
        let network = network();
        let ways = Ways::of(&network);
        let pieces: BTreeSet<String> =
            (0..network.roads.len()).map(|index| ways.piece(RoadId::from_index(index))).collect();
        assert_eq!(pieces.len(), network.roads.len());
        let junctions: BTreeSet<String> = (0..network.intersections.len())
            .map(|index| ways.junction(IntersectionId::from_index(index)))
            .collect();
        assert_eq!(junctions.len(), network.intersections.len());
        assert!(pieces.iter().any(|name| name.starts_with("Oak Street from Mill Lane")), "{pieces:?}");
        assert!(junctions.contains("Mill Lane and Oak Street"), "{junctions:?}");
    }
}
