//! Lanes: the strips of a cross-section, numbered outwards from the line between the two directions.

use std::io::{self, Write};

use simworld_core::id::LaneId;
use simworld_core::net::{
    CrossSection, Lane, LaneDirection, LaneKind, LaneSpec, Road, RoadNetwork, polyline,
};

/// Which side traffic keeps to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rule {
    Right,
    Left,
}

impl Rule {
    pub(super) const fn as_str(self) -> &'static str {
        match self {
            Self::Right => "RHT",
            Self::Left => "LHT",
        }
    }

    /// The side on which lanes go along the centreline, and the number of the first of them.
    pub(super) const fn along(self) -> (&'static str, i32) {
        match self {
            Self::Right => ("right", -1),
            Self::Left => ("left", 1),
        }
    }

    /// Where lanes go along the centreline.
    const fn forward_is_right(self) -> bool {
        matches!(self, Self::Right)
    }
}

/// The lanes of a road.
pub(super) struct Layout {
    strips: Vec<LaneSpec>,
    /// How many strips lie to the left of lane zero.
    left: usize,
    /// Lane zero to the left of the reference line, m.
    pub(super) offset: f64,
    pub(super) rule: Rule,
    /// The numbers of the network's lanes, forward and backward, as the road lists them.
    forward: Vec<i32>,
    backward: Vec<i32>,
    /// Those of the lanes for bicycles.
    cycle: Vec<i32>,
}

impl Layout {
    pub(super) fn of(section: &CrossSection, network: &RoadNetwork, road: &Road) -> Self {
        let strips = section.lanes.clone();
        let (rule, left) = divide(&strips);
        let offset = section.reference - strips[..left].iter().map(|strip| strip.width).sum::<f64>();
        let mut layout =
            Self { strips, left, offset, rule, forward: Vec::new(), backward: Vec::new(), cycle: Vec::new() };
        let numbers = |lanes: &[LaneId]| -> Vec<i32> {
            let number_of = |lane: &LaneId| {
                strip_of(section, network, road, *lane).map(|(index, _)| layout.number(index))
            };
            lanes.iter().map(|lane| number_of(lane).unwrap_or(-1)).collect()
        };
        let (forward, backward, cycle) =
            (numbers(&road.forward), numbers(&road.backward), numbers(&road.cycle));
        (layout.forward, layout.backward, layout.cycle) = (forward, backward, cycle);
        layout
    }

    /// The number of the strip at an index from the left.
    fn number(&self, index: usize) -> i32 {
        if index < self.left { (self.left - index) as i32 } else { -((index - self.left + 1) as i32) }
    }

    /// The number of a lane of the road.
    pub(super) fn of_lane(&self, road: &Road, lane: LaneId) -> i32 {
        let rank = |lanes: &[LaneId]| lanes.iter().position(|other| *other == lane);
        let numbers =
            [(&road.forward, &self.forward), (&road.backward, &self.backward), (&road.cycle, &self.cycle)];
        numbers.into_iter().find_map(|(lanes, numbers)| Some(numbers[rank(lanes)?])).unwrap_or(-1)
    }

    /// How far the middle of a lane lies to the left of the reference line, m.
    pub(super) fn lateral(&self, road: &Road, lane: LaneId) -> f64 {
        let number = self.of_lane(road, lane);
        let widths = |strips: &[LaneSpec]| strips.iter().map(|strip| strip.width).sum::<f64>();
        let rank = number.unsigned_abs() as usize;
        let (sign, index) = match number {
            1.. => (1.0, self.left.saturating_sub(rank)),
            _ => (-1.0, self.left + rank.saturating_sub(1)),
        };
        let between = if number > 0 { index + 1..self.left } else { self.left..index };
        let half = self.strips.get(index).map_or(0.0, |strip| strip.width * 0.5);
        self.offset + sign * (self.strips.get(between).map_or(0.0, widths) + half)
    }

    /// How far the lanes reach to the right of the reference line, m.
    pub(super) fn right_edge(&self) -> f64 {
        self.strips[self.left..].iter().map(|strip| strip.width).sum::<f64>() - self.offset
    }

    /// How far the lanes reach to the left of the reference line, m.
    pub(super) fn left_edge(&self) -> f64 {
        self.strips[..self.left].iter().map(|strip| strip.width).sum::<f64>() + self.offset
    }

    pub(super) fn write(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "<lanes>")?;
        writeln!(out, r#"<laneOffset s="0" a="{:.6}" b="0" c="0" d="0"/>"#, self.offset)?;
        writeln!(out, r#"<laneSection s="0">"#)?;
        if self.left > 0 {
            writeln!(out, "<left>")?;
            for index in 0..self.left {
                self.write_lane(index, out)?;
            }
            writeln!(out, "</left>")?;
        }
        let is_driven = |strip: Option<&LaneSpec>| strip.is_some_and(|strip| strip.kind.is_driven());
        let two_way = self.left > 0
            && is_driven(self.strips.get(self.left - 1))
            && is_driven(self.strips.get(self.left));
        let mark = if two_way { "solid" } else { "none" };
        writeln!(
            out,
            r#"<center><lane id="0" type="none" level="false">{}</lane></center>"#,
            road_mark(mark)
        )?;
        if self.left < self.strips.len() {
            writeln!(out, "<right>")?;
            for index in self.left..self.strips.len() {
                self.write_lane(index, out)?;
            }
            writeln!(out, "</right>")?;
        }
        writeln!(out, "</laneSection>\n</lanes>")
    }

    fn write_lane(&self, index: usize, out: &mut impl Write) -> io::Result<()> {
        let strip = self.strips[index];
        // A lane's mark is that of its outer edge.
        let outer = if index < self.left { index.checked_sub(1) } else { Some(index + 1) };
        let neighbour = outer.and_then(|outer| self.strips.get(outer));
        let mark = match neighbour {
            Some(other) if strip.kind.is_driven() && other.kind.is_driven() => "broken",
            Some(other) if strip.kind.is_carriageway() != other.kind.is_carriageway() => "curb",
            Some(other) if strip.kind.is_driven() || other.kind.is_driven() => "solid",
            _ => "none",
        };
        writeln!(
            out,
            r#"<lane id="{}" type="{}" level="false"><width sOffset="0" a="{:.6}" b="0" c="0" d="0"/>{}</lane>"#,
            self.number(index),
            type_of(strip),
            strip.width,
            road_mark(mark)
        )
    }
}

/// The strip of a lane and the offset of its middle from the centreline, positive to the left, m: the strip of its kind
/// and direction nearest to the middle of its path.
pub(super) fn strip_of(
    section: &CrossSection,
    network: &RoadNetwork,
    road: &Road,
    lane: LaneId,
) -> Option<(usize, f64)> {
    let Lane { path, kind, from, .. } = &network.lanes[lane.index()];
    let against = if *from == road.from { LaneDirection::Backward } else { LaneDirection::Forward };
    let (middle, _) = polyline::at(path, polyline::length(path) * 0.5);
    let lateral = polyline::closest(&road.centerline, &middle).map_or(0.0, |near| near.lateral);
    let strips = section.strips().enumerate();
    let own = strips.filter(|(_, (_, strip))| strip.kind == *kind && strip.direction != against);
    let away = |middle: f64| (middle - lateral).abs();
    let nearest = own.min_by(|a, b| away(a.1.0).total_cmp(&away(b.1.0)));
    nearest.map(|(index, (offset, _))| (index, offset))
}

fn road_mark(kind: &str) -> String {
    let change = if kind == "broken" { "both" } else { "none" };
    format!(
        r#"<roadMark sOffset="0" type="{kind}" weight="standard" color="standard" width="0.12" laneChange="{change}"/>"#
    )
}

/// The rule and the number of strips to the left of lane zero for which the fewest lanes go the wrong way; of equals,
/// right-hand traffic and the leftmost line that all others would not better.
fn divide(strips: &[LaneSpec]) -> (Rule, usize) {
    let wrong = |rule: Rule, left: usize| {
        let is_wrong = |(index, strip): &(usize, &LaneSpec)| {
            let is_right = *index >= left;
            strip.kind.is_driven()
                && match strip.direction {
                    LaneDirection::Forward => is_right != rule.forward_is_right(),
                    LaneDirection::Backward => is_right == rule.forward_is_right(),
                    LaneDirection::Both => false,
                }
        };
        strips.iter().enumerate().filter(is_wrong).count()
    };
    let choices = [Rule::Right, Rule::Left]
        .into_iter()
        .flat_map(|rule| (0..=strips.len()).map(move |left| (rule, left)));
    // Lane zero belongs at the edge of a driven lane, where the paint is.
    let beside_driven = |left: usize| {
        let is_driven = |index: Option<usize>| {
            index.and_then(|index| strips.get(index)).is_some_and(|strip| strip.kind.is_driven())
        };
        is_driven(left.checked_sub(1)) || is_driven(Some(left))
    };
    choices
        .min_by_key(|(rule, left)| (wrong(*rule, *left), *rule == Rule::Left, !beside_driven(*left), *left))
        .unwrap_or((Rule::Right, 0))
}

const fn type_of(strip: LaneSpec) -> &'static str {
    match (strip.kind, strip.direction) {
        (LaneKind::Driving, LaneDirection::Both) => "bidirectional",
        (LaneKind::Driving, _) => "driving",
        (LaneKind::Bus, _) => "bus",
        (LaneKind::Cycle, _) => "biking",
        (LaneKind::Parking, _) => "parking",
        (LaneKind::Shoulder, _) => "shoulder",
        (LaneKind::Median, _) => "median",
        (LaneKind::Verge, _) => "none",
        (LaneKind::Sidewalk, _) => "sidewalk",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lane(kind: LaneKind, direction: LaneDirection) -> LaneSpec {
        LaneSpec { kind, direction, width: 3.0 }
    }

    #[test]
    fn lane_zero_lies_between_the_directions() {
        use LaneDirection::{Backward, Both, Forward};
        use LaneKind::{Driving, Parking, Sidewalk};
        let walk = lane(Sidewalk, Both);
        let two_way = [walk, lane(Driving, Backward), lane(Driving, Forward), lane(Driving, Forward), walk];
        assert_eq!(divide(&two_way), (Rule::Right, 2));
        let british = [walk, lane(Driving, Forward), lane(Driving, Backward), walk];
        assert_eq!(divide(&british), (Rule::Left, 2));
        let one_way = [walk, lane(Parking, Both), lane(Driving, Forward), lane(Driving, Forward), walk];
        assert_eq!(divide(&one_way), (Rule::Right, 2));
        let against = [walk, lane(Driving, Backward), walk];
        assert_eq!(divide(&against), (Rule::Right, 2));
    }
}
