//! Where ways across an intersection meet: the stretch of each on which a vehicle could touch one on the other.

use simworld_core::id::ConnectionId;
use simworld_core::lists::Lists;
use simworld_core::net::{Connection, Ends, RoadNetwork, WayTrace, Zone};

use super::beside::Pairs;
use crate::TrafficConfig;
use crate::vehicle::types::is_long;

/// Room beside a body for what it sweeps over in a turn: the chord of seven metres on a radius of eight, and toes, m.
const SWEPT: f64 = 0.9;

/// Another way that meets one's own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Conflict {
    pub(crate) way: u32,
    /// Whether one gives way to it while both may go, and the least gap before who comes on it that one takes then, s.
    pub(crate) yields: bool,
    pub(crate) critical: f32,
    /// Whether both end in the same lane.
    pub(crate) merges: bool,
    /// Whom of which size it concerns.
    pub(crate) pairs: Pairs,
    pub(crate) own: Zone,
    pub(crate) other: Zone,
}

/// The ways that meet each way, in the order of their numbers: those of the network, and those beside on which vehicles touch.
pub(crate) fn conflicts(
    network: &RoadNetwork,
    config: &TrafficConfig,
    beside: Vec<Vec<Conflict>>,
) -> Lists<Conflict> {
    let short = config.types.iter().filter(|row| !is_long(row.length));
    let near = short.map(|row| row.width).fold(0.0, f64::max) + SWEPT;
    let traces: Vec<WayTrace> = network.connections.iter().map(WayTrace::new).collect();
    let of = |((index, own), beside): ((usize, &Connection), Vec<Conflict>)| -> Vec<Conflict> {
        let conflict = |id: &ConnectionId| {
            let other = &network.connections[id.index()];
            let ends = Ends::of(own, other);
            let yields = own.yields_to.binary_search(id).is_ok();
            let (mine, theirs) = (&traces[index], &traces[id.index()]);
            Conflict {
                way: id.0,
                yields,
                critical: if yields { config.gaps.critical(network, own, other) as f32 } else { 0.0 },
                merges: ends == Ends::Together,
                pairs: Pairs::ALL,
                own: mine.zone(theirs, near, ends),
                other: theirs.zone(mine, near, ends),
            }
        };
        let mut all: Vec<Conflict> = own.conflicts.iter().map(conflict).chain(beside).collect();
        all.sort_by_key(|conflict| conflict.way);
        all
    };
    network.connections.iter().enumerate().zip(beside).map(of).collect()
}

#[cfg(test)]
mod tests {
    use simworld_core::net::{NetworkConfig, StreetPlan, Turn, polyline};

    use super::super::beside::Beside;
    use super::*;

    fn crossroads() -> (RoadNetwork, Lists<Conflict>) {
        let plan = StreetPlan::crossroads(120.0);
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("it is a plan");
        let config = TrafficConfig::default();
        let beside = Beside::new(&network, &config);
        let conflicts = conflicts(&network, &config, beside.short);
        (network, conflicts)
    }

    #[test]
    fn outside_of_the_zones_two_ways_are_apart() {
        let (network, conflicts) = crossroads();
        let mut met = 0;
        for (index, way) in network.connections.iter().enumerate() {
            for conflict in &conflicts[index] {
                let other = &network.connections[conflict.way as usize];
                let mut station = 0.0;
                while station < way.length {
                    let point = polyline::at(&way.path, station).0;
                    let apart = polyline::closest(&other.path, &point).expect("a path").distance;
                    let outside = station < conflict.own.enter() || station > f64::from(conflict.own.leave);
                    assert!(apart > 2.4 || !outside, "{apart} m apart {station} m along {index}");
                    station += 0.25;
                    met += usize::from(outside);
                }
            }
        }
        assert!(met > 1000, "zones are not whole ways: {met}");
    }

    #[test]
    fn both_sides_tell_the_same_of_a_meeting() {
        let (network, conflicts) = crossroads();
        for index in 0..network.connections.len() {
            for conflict in &conflicts[index] {
                let back = conflicts[conflict.way as usize].iter().find(|back| back.way as usize == index);
                let back = back.expect("who touches is touched");
                assert_eq!(
                    (back.own, back.other, back.merges),
                    (conflict.other, conflict.own, conflict.merges)
                );
                assert!(!(back.yields && conflict.yields));
            }
        }
    }

    #[test]
    fn who_goes_straight_across_is_out_of_the_way_half_way() {
        let (network, conflicts) = crossroads();
        let straight = |index: &u32| network.connections[*index as usize].turn == Turn::Straight;
        let pair = (0..network.connections.len() as u32).filter(straight).find_map(|index| {
            let crossing =
                conflicts[index as usize].iter().find(|conflict| straight(&conflict.way) && !conflict.merges);
            Some((index, *crossing?))
        });
        let (index, conflict) = pair.expect("straight ways cross");
        let length = network.connections[index as usize].length;
        let stretch = f64::from(conflict.own.leave) - conflict.own.enter();
        assert!(stretch > 4.0 && stretch < 0.6 * length, "{stretch} m of {length} m");
    }
}
