//! A street: a chain of lanes driven straight on, along which places are measured.

use simworld_core::id::{ConnectionId, LaneId};
use simworld_core::net::{Control, RoadNetwork, SignalGroup, Turn};

use crate::Leg;

/// A chain of legs that lead straight on to one another.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Street {
    /// Its legs, in the order in which they are driven.
    pub legs: Vec<Leg>,
    /// Where each leg begins, m along the street, and the end of the last.
    pub stations: Vec<f64>,
    /// Where its stop lines with signals are, m, and the groups that one obeys there straight on.
    pub signals: Vec<(f64, SignalGroup)>,
    /// Its name, if it has one.
    pub name: Option<String>,
    /// Of every lane and then every connection of the network: where it begins on the street, m.
    offsets: Vec<Option<f64>>,
}

impl Street {
    /// The longest street of the network that passes the most signals on at most `reach` m; `None` of a network without lanes.
    pub fn busiest(network: &RoadNetwork, reach: f64) -> Option<Self> {
        let starts = network.lanes.iter().enumerate().filter(|(_, lane)| lane.is_driven());
        let mut legs: Vec<Leg> =
            starts.map(|(index, _)| Leg::of(network, LaneId::from_index(index))).collect();
        legs.sort_unstable();
        legs.dedup();
        let streets = legs.into_iter().map(|leg| Self::along(network, leg, reach));
        streets.max_by(|a, b| a.signals.len().cmp(&b.signals.len()).then(a.length().total_cmp(&b.length())))
    }

    /// The street that begins with a leg and goes straight on for at most `reach` m.
    pub fn along(network: &RoadNetwork, first: Leg, reach: f64) -> Self {
        let mut street = Self {
            stations: vec![0.0],
            offsets: vec![None; network.lanes.len() + network.connections.len()],
            name: network.road_name(first.road()).map(str::to_owned),
            ..Self::default()
        };
        let mut next = Some(first);
        while let Some(leg) = next.take().filter(|leg| !street.legs.contains(leg) && street.length() < reach)
        {
            next = street.add(network, leg);
        }
        street
    }

    /// Adds a leg with the ways straight on from it, and returns the leg behind them.
    fn add(&mut self, network: &RoadNetwork, leg: Leg) -> Option<Leg> {
        let begin = self.length();
        let lanes = leg.lanes(network);
        let length = lanes.iter().map(|lane| network.lanes[lane.index()].length).fold(0.0, f64::max);
        for lane in lanes {
            self.offsets[lane.index()] = Some(begin);
        }
        self.legs.push(leg);
        let ways = lanes.iter().flat_map(|lane| &network.lanes[lane.index()].outgoing);
        let straight: Vec<ConnectionId> =
            ways.copied().filter(|way| network.connections[way.index()].turn == Turn::Straight).collect();
        let across = straight.first().map(|way| &network.connections[way.index()]);
        for way in &straight {
            self.offsets[network.lanes.len() + way.index()] = Some(begin + length);
        }
        if let Some(group) = across.and_then(|way| way.signal) {
            self.signals.push((begin + length, group));
        }
        self.stations.push(begin + length + across.map_or(0.0, |way| way.length));
        across.map(|way| Leg::of(network, way.to))
    }

    /// Its length, m.
    pub fn length(&self) -> f64 {
        self.stations.last().copied().unwrap_or(0.0)
    }

    /// Where a place on a lane or a connection is on the street, m; `None` beside it. Connections are numbered after lanes.
    pub fn station(&self, track: u32, s: f64) -> Option<f64> {
        self.offsets.get(track as usize).copied().flatten().map(|begin| begin + s)
    }

    /// Where its junctions are, m, each with its control.
    pub fn junctions(&self, network: &RoadNetwork) -> Vec<(f64, Control)> {
        let ends = self.legs.iter().zip(self.stations.iter().skip(1));
        let control = |leg: &Leg| {
            let lane = leg.lanes(network).first()?;
            Some(network.intersections[network.lanes[lane.index()].to.index()].control)
        };
        ends.filter_map(|(leg, station)| Some((*station, control(leg)?))).collect()
    }
}
