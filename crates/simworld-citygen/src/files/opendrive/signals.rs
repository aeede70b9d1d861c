//! Traffic lights at the stop lines, and a controller for each group of lights that show the same.

use std::collections::BTreeMap;
use std::io::{self, Write};

use simworld_core::id::LaneId;
use simworld_core::net::{RoadNetwork, SignalGroup, SignalPlan};

use super::Roads;

/// The type of a three-light signal in the catalogue of OpenDRIVE itself (ASAM OpenDRIVE 1.7, table of signals).
const THREE_LIGHTS: &str = "1000001";
/// Height of the lower edge of a signal above the road, its own height and width, m.
const SIZE: (f64, f64, f64) = (2.4, 0.9, 0.3);
/// Distance of a signal from the edge of the lanes, m.
const BESIDE: f64 = 0.3;

/// The groups that say when the lanes of a road end may go, and for which lanes each speaks.
fn groups(network: &RoadNetwork, lanes: &[LaneId]) -> BTreeMap<SignalGroup, Vec<LaneId>> {
    let mut groups: BTreeMap<SignalGroup, Vec<LaneId>> = BTreeMap::new();
    for lane in lanes {
        for connection in &network.lanes[lane.index()].outgoing {
            if let Some(group) = network.connections[connection.index()].signal {
                let spoken_to = groups.entry(group).or_default();
                if spoken_to.last() != Some(lane) {
                    spoken_to.push(*lane);
                }
            }
        }
    }
    groups
}

impl Roads<'_> {
    pub(super) fn signals_of(&self, index: usize, length: f64, out: &mut impl Write) -> io::Result<()> {
        let (road, layout) = (&self.network.roads[index], &self.layouts[index]);
        let ends = [
            (&road.forward, '+', length, -(layout.right_edge() + BESIDE)),
            (&road.backward, '-', 0.0, layout.left_edge() + BESIDE),
        ];
        writeln!(out, "<signals>")?;
        for (lanes, orientation, s, t) in ends {
            for (group, lanes) in groups(self.network, lanes) {
                let numbers = lanes.iter().map(|lane| layout.of_lane(road, *lane));
                let (low, high) =
                    numbers.fold((i32::MAX, i32::MIN), |(low, high), n| (low.min(n), high.max(n)));
                writeln!(
                    out,
                    r#"<signal s="{s:.6}" t="{t:.3}" id="{}" name="" dynamic="yes" orientation="{orientation}" zOffset="{}" country="OpenDRIVE" type="{THREE_LIGHTS}" subtype="-1" value="-1" height="{}" width="{}"><validity fromLane="{low}" toLane="{high}"/></signal>"#,
                    number(index, orientation, group),
                    SIZE.0,
                    SIZE.1,
                    SIZE.2
                )?;
            }
        }
        writeln!(out, "</signals>")
    }

    /// The groups of a plan that vehicles see, in its order.
    pub(super) fn shown(&self, plan: &SignalPlan) -> Vec<SignalGroup> {
        let place = &self.network.intersections[plan.intersection.index()];
        let signals = place.connections.iter().filter_map(|id| self.network.connections[id.index()].signal);
        let seen: std::collections::BTreeSet<SignalGroup> = signals.collect();
        plan.groups.iter().copied().filter(|group| seen.contains(group)).collect()
    }

    pub(super) fn controllers(&self, out: &mut impl Write) -> io::Result<()> {
        let mut lights: BTreeMap<SignalGroup, Vec<String>> = BTreeMap::new();
        for (index, road) in self.network.roads.iter().enumerate() {
            for (lanes, orientation) in [(&road.forward, '+'), (&road.backward, '-')] {
                for group in groups(self.network, lanes).into_keys() {
                    lights.entry(group).or_default().push(number(index, orientation, group));
                }
            }
        }
        for (group, lights) in lights {
            writeln!(out, r#"<controller id="{}" name="" sequence="0">"#, group.0)?;
            for light in lights {
                writeln!(out, r#"<control signalId="{light}" type="0"/>"#)?;
            }
            writeln!(out, "</controller>")?;
        }
        Ok(())
    }
}

/// The number of a light: no two have the same group at the same end of the same road.
fn number(road: usize, orientation: char, group: SignalGroup) -> String {
    let end = if orientation == '+' { 1 } else { 2 };
    format!("{road}{end}{:06}", group.0)
}
