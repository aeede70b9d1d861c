//! The cross-section of a street: its lanes, sidewalks and all between, from left to right.
//!
//! Left and right are seen along the centreline, whichever way traffic goes. Widths in metres.

use serde::{Deserialize, Serialize};

/// What a strip of a street is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LaneKind {
    /// All motor vehicles.
    Driving,
    /// Buses only.
    Bus,
    /// Bicycles and scooters.
    Cycle,
    /// Parked vehicles along the kerb.
    Parking,
    /// Paved, not driven on.
    Shoulder,
    /// Keeps two directions apart.
    Median,
    /// Grass or trees between kerb and sidewalk.
    Verge,
    /// People on foot.
    Sidewalk,
}

impl LaneKind {
    /// Whether motor vehicles drive there.
    pub const fn is_driven(self) -> bool {
        matches!(self, Self::Driving | Self::Bus)
    }

    /// Whether it lies between the kerbs.
    pub const fn is_carriageway(self) -> bool {
        !matches!(self, Self::Verge | Self::Sidewalk)
    }
}

/// The way traffic moves on a strip, seen along the centreline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LaneDirection {
    /// From the beginning of the centreline to its end.
    Forward,
    /// From its end to its beginning.
    Backward,
    /// Either way, or none.
    Both,
}

/// One strip of a cross-section.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LaneSpec {
    /// What it is for.
    pub kind: LaneKind,
    /// The way traffic moves on it.
    pub direction: LaneDirection,
    /// Width, m.
    pub width: f64,
}

/// A cross-section: strips from left to right, and where the centreline lies among them.
///
/// ```
/// use simworld_core::net::CrossSection;
/// let street = CrossSection::two_way(1, 1);
/// assert_eq!(street.width(), 3.0 + 3.5 + 3.5 + 3.0);
/// assert_eq!(street.left_of_reference(), street.right_of_reference());
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CrossSection {
    /// The strips, from left to right.
    pub lanes: Vec<LaneSpec>,
    /// Distance from the left edge of the first strip to the centreline, m.
    pub reference: f64,
}

/// Width of a driving lane where nothing says otherwise, m.
pub const LANE_WIDTH: f64 = 3.5;
/// Width of a sidewalk where nothing says otherwise, m.
pub const SIDEWALK_WIDTH: f64 = 3.0;

impl Default for CrossSection {
    /// One lane each way between sidewalks.
    fn default() -> Self {
        Self::two_way(1, 1)
    }
}

impl CrossSection {
    /// Driving lanes of the usual width between two sidewalks, traffic on the right, the centreline between the two
    /// directions.
    pub fn two_way(forward: u8, backward: u8) -> Self {
        Self::plain(forward, backward, LANE_WIDTH, SIDEWALK_WIDTH)
    }

    /// Driving lanes between two sidewalks, traffic on the right, the centreline between the two directions; a
    /// sidewalk without width is left out.
    pub fn plain(forward: u8, backward: u8, lane_width: f64, sidewalk_width: f64) -> Self {
        let driving = |direction| move |_| LaneSpec { kind: LaneKind::Driving, direction, width: lane_width };
        let sidewalk = (sidewalk_width > 0.0).then_some(LaneSpec {
            kind: LaneKind::Sidewalk,
            direction: LaneDirection::Both,
            width: sidewalk_width,
        });
        let lanes = sidewalk
            .into_iter()
            .chain((0..backward).map(driving(LaneDirection::Backward)))
            .chain((0..forward).map(driving(LaneDirection::Forward)))
            .chain(sidewalk)
            .collect();
        let reference = sidewalk.map_or(0.0, |strip| strip.width) + f64::from(backward) * lane_width;
        Self { lanes, reference }
    }

    /// With a parking lane of that width at either kerb; as it was if the width is nothing.
    ///
    /// ```
    /// use simworld_core::net::CrossSection;
    /// let street = CrossSection::two_way(1, 1).with_parking(2.0);
    /// assert_eq!(street.lanes.len(), 6);
    /// assert_eq!(street.kerbs(), (5.5, 5.5));
    /// ```
    #[must_use]
    pub fn with_parking(self, width: f64) -> Self {
        self.with_at_kerbs(LaneKind::Parking, width)
    }

    /// With a cycle lane of that width at either kerb, each in the direction of the traffic on the right; as it was if
    /// the width is nothing. Parking comes after it, so that it lies at the kerb.
    ///
    /// ```
    /// use simworld_core::net::CrossSection;
    /// let street = CrossSection::two_way(1, 1).with_cycle_lanes(1.5).with_median(2.0);
    /// assert_eq!(street.kerbs(), (6.0, 6.0));
    /// assert_eq!(street.driven(), (1, 1));
    /// ```
    #[must_use]
    pub fn with_cycle_lanes(self, width: f64) -> Self {
        self.with_at_kerbs(LaneKind::Cycle, width)
    }

    /// With a median of that width where the two directions part, the centreline in its middle; as it was if the width
    /// is nothing or all lanes go one way.
    #[must_use]
    pub fn with_median(mut self, width: f64) -> Self {
        let is_driven = |lane: &LaneSpec| lane.kind.is_driven();
        let parting = self
            .lanes
            .windows(2)
            .position(|pair| pair.iter().all(is_driven) && pair[0].direction != pair[1].direction);
        if let (Some(left), true) = (parting, width > 0.0) {
            let median = LaneSpec { kind: LaneKind::Median, direction: LaneDirection::Both, width };
            self.lanes.insert(left + 1, median);
            self.reference = self.lanes[..=left].iter().map(|lane| lane.width).sum::<f64>() + width * 0.5;
        }
        self
    }

    fn with_at_kerbs(mut self, kind: LaneKind, width: f64) -> Self {
        let is_carriageway = |lane: &LaneSpec| lane.kind.is_carriageway();
        let ends = (self.lanes.iter().position(is_carriageway), self.lanes.iter().rposition(is_carriageway));
        if let (Some(first), Some(last), true) = (ends.0, ends.1, width > 0.0) {
            let strip = |direction| LaneSpec { kind, direction, width };
            self.lanes.insert(last + 1, strip(LaneDirection::Forward));
            self.lanes.insert(first, strip(LaneDirection::Backward));
            self.reference += width;
        }
        self
    }

    /// Width of the whole, m.
    pub fn width(&self) -> f64 {
        self.lanes.iter().map(|lane| lane.width).sum()
    }

    /// How far it reaches to the left of the centreline, m.
    pub fn left_of_reference(&self) -> f64 {
        self.reference
    }

    /// How far it reaches to the right of the centreline, m.
    pub fn right_of_reference(&self) -> f64 {
        self.width() - self.reference
    }

    /// The strips with the offset of their middle from the centreline, positive to the left, m; from left to right.
    pub fn strips(&self) -> impl Iterator<Item = (f64, LaneSpec)> + '_ {
        let mut left = self.reference;
        self.lanes.iter().map(move |lane| {
            let middle = left - lane.width * 0.5;
            left -= lane.width;
            (middle, *lane)
        })
    }

    /// The kerbs: how far the carriageway reaches to the left and to the right of the centreline, m. The first is
    /// less than nothing, negated, where the whole carriageway lies to the right; `(0, 0)` without one.
    pub fn kerbs(&self) -> (f64, f64) {
        let mut kerbs: Option<(f64, f64)> = None;
        for (middle, lane) in self.strips().filter(|(_, lane)| lane.kind.is_carriageway()) {
            let (left, right) = (middle + lane.width * 0.5, lane.width * 0.5 - middle);
            kerbs = Some(kerbs.map_or((left, right), |(l, r)| (l.max(left), r.max(right))));
        }
        kerbs.unwrap_or((0.0, 0.0))
    }

    /// Number of lanes driven along the centreline, and against it.
    pub fn driven(&self) -> (usize, usize) {
        let count = |direction| {
            self.lanes.iter().filter(|lane| lane.kind.is_driven() && lane.direction == direction).count()
        };
        (count(LaneDirection::Forward), count(LaneDirection::Backward))
    }

    /// What is wrong with it, in words; `None` if a street can be built of it.
    pub(super) fn fault(&self) -> Option<String> {
        let (forward, backward) = self.driven();
        if forward > 8 || backward > 8 || forward + backward == 0 {
            return Some(format!("has {forward} + {backward} lanes: give 1 to 8 in at least one direction"));
        }
        if let Some(lane) = self.lanes.iter().find(|lane| !(0.1..=50.0).contains(&lane.width)) {
            return Some(format!("has a {:?} strip of {} m: give 0.1 to 50 m", lane.kind, lane.width));
        }
        if let Some(lane) =
            self.lanes.iter().find(|lane| lane.kind.is_driven() && !(2.0..=6.0).contains(&lane.width))
        {
            return Some(format!("has a {:?} lane {} m wide: give 2 to 6 m", lane.kind, lane.width));
        }
        if self.lanes.len() > 64 {
            return Some(format!("has {} strips: give at most 64", self.lanes.len()));
        }
        let reach = self.width();
        (!(-reach..=2.0 * reach).contains(&self.reference)).then(|| {
            format!("has its centreline {} m from its left edge, far outside its {reach} m", self.reference)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_lie_side_by_side() {
        let section = CrossSection::plain(2, 1, 3.0, 2.0);
        let middles: Vec<f64> = section.strips().map(|(middle, _)| middle).collect();
        assert_eq!(middles, [4.0, 1.5, -1.5, -4.5, -7.0]);
        assert_eq!(section.kerbs(), (3.0, 6.0));
        assert_eq!(section.driven(), (2, 1));
        assert!(section.fault().is_none());
    }

    #[test]
    fn a_one_way_street_lies_beside_its_centreline() {
        let section = CrossSection::two_way(1, 0);
        assert_eq!(section.kerbs(), (0.0, 3.5));
        assert_eq!(section.left_of_reference(), 3.0);
        assert!(
            CrossSection::plain(0, 0, 3.0, 2.0).fault().is_some_and(|fault| fault.contains("0 + 0 lanes"))
        );
        assert!(CrossSection::plain(1, 1, f64::NAN, 2.0).fault().is_some());
    }
}
