//! Gap acceptance: the gaps in streams with priority that drivers take.

use serde::{Deserialize, Serialize};
use simworld_core::net::{Connection, Control, RoadNetwork, Turn};

use crate::TrafficError;

/// The critical gaps: the least time between two vehicles with priority, at their line, in which a driver who waits at his
/// goes, s, each in [1, 20].
///
/// Whatever the gap, nobody goes who could not be out of the way in time. The defaults are the base critical headways of the
/// Highway Capacity Manual, 6th edition: exhibits 20-11 (two-way stop), 19-20 (permitted left turn), and, for roundabouts, that
/// of its capacity formula 1380 e^(-0.00102 v).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Gaps {
    /// Across oncoming traffic from a road of the same or a higher class: left where traffic keeps right.
    pub across_from_major: f64,
    /// The same at a green light.
    pub across_at_signal: f64,
    /// With the traffic on to a road of higher class: right where traffic keeps right.
    pub with_from_minor: f64,
    /// Straight over a road of higher class.
    pub straight_from_minor: f64,
    /// On to a road of higher class, across the traffic on its near side.
    pub across_from_minor: f64,
    /// Into a roundabout.
    pub roundabout: f64,
}

impl Default for Gaps {
    fn default() -> Self {
        Self {
            across_from_major: 4.1,
            across_at_signal: 4.5,
            with_from_minor: 6.2,
            straight_from_minor: 6.5,
            across_from_minor: 7.1,
            roundabout: 5.0,
        }
    }
}

impl Gaps {
    pub(crate) fn validate(&self) -> Result<(), TrafficError> {
        let fields = [
            ("gaps.across_from_major", self.across_from_major),
            ("gaps.across_at_signal", self.across_at_signal),
            ("gaps.with_from_minor", self.with_from_minor),
            ("gaps.straight_from_minor", self.straight_from_minor),
            ("gaps.across_from_minor", self.across_from_minor),
            ("gaps.roundabout", self.roundabout),
        ];
        let wrong = fields.into_iter().find(|(_, value)| !(1.0..=20.0).contains(value));
        wrong.map_or(Ok(()), |(field, value)| {
            Err(TrafficError::Config { field, value, allowed: "a critical gap of 1 to 20 s" })
        })
    }

    /// The gap that a way asks for in the stream on another to which it gives way, s.
    pub(super) fn critical(&self, network: &RoadNetwork, own: &Connection, other: &Connection) -> f64 {
        let road = |way: &Connection| &network.roads[network.lanes[way.from.index()].road.index()];
        let is_across = own.turn == network.driving_side.turn_across() || own.turn == Turn::UTurn;
        if road(other).roundabout {
            self.roundabout
        } else if network.intersections[own.intersection.index()].control == Control::Signals {
            self.across_at_signal
        } else if is_across && road(other).class <= road(own).class {
            self.across_from_major
        } else if is_across {
            self.across_from_minor
        } else if own.turn == Turn::Straight {
            self.straight_from_minor
        } else {
            self.with_from_minor
        }
    }
}
