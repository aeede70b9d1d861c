//! Gap acceptance: the gaps in streams with priority that drivers take, and the time that a way takes them.

use serde::{Deserialize, Serialize};

use super::{Connection, Control, RoadNetwork, Turn};

/// The critical gaps: the least time between two vehicles with priority, at their line, in which a driver who waits at his
/// goes, s.
///
/// Whatever the gap, nobody goes who could not be out of the way in time. The defaults are the base critical headways of the
/// Highway Capacity Manual, 6th edition: exhibits 20-11 (two-way stop), 19-20 (permitted left turn), and, for roundabouts, that
/// of its capacity formula 1380 e^(-0.00102 v).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CriticalGaps {
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

impl Default for CriticalGaps {
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

impl CriticalGaps {
    /// The gap that a way asks for in the stream on another to which it gives way, s.
    pub fn critical(&self, network: &RoadNetwork, own: &Connection, other: &Connection) -> f64 {
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

/// The time that a way takes from a speed with an acceleration up to another speed, s; none if it is behind one.
pub fn time_over(way: f64, v: f64, acceleration: f64, most: f64) -> f64 {
    if way <= 0.0 {
        return 0.0;
    }
    if v >= most {
        return way / ((v + most) * 0.5); // it slows down on the way
    }
    let until = (most * most - v * v) / (2.0 * acceleration);
    if way <= until {
        ((v * v + 2.0 * acceleration * way).sqrt() - v) / acceleration
    } else {
        (most - v) / acceleration + (way - until) / most
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_those_of_constant_acceleration() {
        // 12 m from rest at 1.5 m/s²: 4 s; with at most 3 m/s 2 s for 3 m and 3 s for the other 9.
        assert!((time_over(12.0, 0.0, 1.5, 10.0) - 4.0).abs() < 1e-12);
        assert!((time_over(12.0, 0.0, 1.5, 3.0) - 5.0).abs() < 1e-12);
        assert!((time_over(12.0, 4.0, 1.5, 4.0) - 3.0).abs() < 1e-12);
        assert!(time_over(-1.0, 4.0, 1.5, 4.0) == 0.0);
    }
}
