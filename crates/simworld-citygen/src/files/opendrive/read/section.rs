//! Cross-sections: the lanes of a road at one place along it, from left to right.
//!
//! Source: ASAM OpenDRIVE 1.7.0, chapter 9.

use roxmltree::Node;
use simworld_core::net::{CrossSection, LaneDirection, LaneKind, LaneSpec};

use super::document::{number, polynomial};

/// Widths of a lane that is driven on, m; what is narrower is the tip of one that opens.
const DRIVEN: (f64, f64) = (2.0, 6.0);
const LEAST_DRIVEN: f64 = 1.2;
/// Widths of any strip, m.
const STRIP: (f64, f64) = (0.15, 50.0);
/// Strips and driven lanes each way at most.
const MOST_STRIPS: usize = 60;
const MOST_LANES: usize = 8;

/// The cross-section of a section of lanes that begins at `start`, at `station` m along its road, and the number of the lane
/// of each of its strips; `None` if nothing is driven there. `keeps_left` is the side of the traffic.
pub(super) fn at(
    lanes: Node<'_, '_>,
    (start, section): (f64, Node<'_, '_>),
    station: f64,
    keeps_left: bool,
) -> Option<(CrossSection, Vec<i32>)> {
    let offsets = lanes.children().filter(|child| child.has_tag_name("laneOffset"));
    let offset = polynomial(offsets, "s", station).unwrap_or(0.0);
    let side = |name: &str| {
        let lanes = section.children().filter(|child| child.has_tag_name(name));
        let mut lanes: Vec<(f64, LaneSpec)> = lanes
            .flat_map(|side| side.children().filter(|child| child.has_tag_name("lane")))
            .filter_map(|lane| {
                Some((number(lane, "id")?, strip(lane, station - start, (name == "left") == keeps_left)?))
            })
            .collect();
        // Outermost first on the left, innermost first on the right.
        lanes.sort_by(|a, b| b.0.total_cmp(&a.0));
        lanes.truncate(MOST_STRIPS / 2);
        lanes
    };
    let (left, right) = (side("left"), side("right"));
    let reference = left.iter().map(|(_, strip)| strip.width).sum::<f64>() + offset;
    let (numbers, lanes): (Vec<f64>, Vec<LaneSpec>) = [left, right].concat().into_iter().unzip();
    let mut section = CrossSection { lanes, reference };
    tidy(&mut section);
    let (forward, backward) = section.driven();
    let reach = section.width();
    let is_near = (-reach..=2.0 * reach).contains(&section.reference);
    let numbers = numbers.into_iter().map(|number| number as i32).collect();
    (is_near && forward + backward > 0).then_some((section, numbers))
}

/// One lane; `None` if it has no width there.
fn strip(lane: Node<'_, '_>, within: f64, is_forward: bool) -> Option<LaneSpec> {
    let widths = lane.children().filter(|child| child.has_tag_name("width"));
    let width = polynomial(widths, "sOffset", within)?;
    let kind = kind_of(lane.attribute("type").unwrap_or("none"));
    let least = if kind.is_driven() { LEAST_DRIVEN } else { STRIP.0 };
    if !(least..=STRIP.1).contains(&width) {
        return None;
    }
    let direction = match kind {
        LaneKind::Sidewalk | LaneKind::Verge | LaneKind::Median => LaneDirection::Both,
        _ if is_forward => LaneDirection::Forward,
        _ => LaneDirection::Backward,
    };
    let width = if kind.is_driven() { width.clamp(DRIVEN.0, DRIVEN.1) } else { width };
    Some(LaneSpec { kind, direction, width })
}

/// Grass between lanes is a median, what lies beside one-way traffic goes its way, and lanes beyond the most are for
/// nobody.
fn tidy(section: &mut CrossSection) {
    let driven = |lane: &LaneSpec| lane.kind.is_driven();
    let ends = (section.lanes.iter().position(driven), section.lanes.iter().rposition(driven));
    if let (Some(first), Some(last)) = ends {
        for lane in section.lanes[first..last].iter_mut().filter(|lane| lane.kind == LaneKind::Verge) {
            lane.kind = LaneKind::Median;
        }
    }
    for direction in [LaneDirection::Forward, LaneDirection::Backward] {
        let own = |lane: &&mut LaneSpec| lane.kind.is_driven() && lane.direction == direction;
        section.lanes.iter_mut().filter(own).skip(MOST_LANES).for_each(|lane| lane.kind = LaneKind::Shoulder);
    }
    let only = match section.driven() {
        (_, 0) => LaneDirection::Forward,
        (0, _) => LaneDirection::Backward,
        _ => return,
    };
    for lane in section.lanes.iter_mut().filter(|lane| lane.direction != LaneDirection::Both) {
        lane.direction = only;
    }
}

pub(super) fn kind_of(name: &str) -> LaneKind {
    match name {
        "driving" | "entry" | "exit" | "onRamp" | "offRamp" | "connectingRamp" | "slipLane"
        | "bidirectional" | "mwyEntry" | "mwyExit" => LaneKind::Driving,
        "bus" | "taxi" | "HOV" => LaneKind::Bus,
        "biking" => LaneKind::Cycle,
        "parking" => LaneKind::Parking,
        "median" => LaneKind::Median,
        "sidewalk" | "walking" => LaneKind::Sidewalk,
        "none" | "curb" => LaneKind::Verge,
        _ => LaneKind::Shoulder,
    }
}

/// The same road seen from its other end.
pub(super) fn mirrored(section: &CrossSection) -> CrossSection {
    let turned = |lane: &LaneSpec| LaneSpec {
        direction: match lane.direction {
            LaneDirection::Forward => LaneDirection::Backward,
            LaneDirection::Backward => LaneDirection::Forward,
            LaneDirection::Both => LaneDirection::Both,
        },
        ..*lane
    };
    CrossSection {
        lanes: section.lanes.iter().rev().map(turned).collect(),
        reference: section.width() - section.reference,
    }
}

/// Whether two parts of a road have the same lanes, of whatever width.
pub(super) fn has_same_lanes(a: &CrossSection, b: &CrossSection) -> bool {
    let same = |(a, b): (&LaneSpec, &LaneSpec)| a.kind == b.kind && a.direction == b.direction;
    a.lanes.len() == b.lanes.len() && a.lanes.iter().zip(&b.lanes).all(same)
}

/// Whether two roads are alike across.
pub(super) fn is_alike(a: &CrossSection, b: &CrossSection) -> bool {
    let alike = |(a, b): (&LaneSpec, &LaneSpec)| {
        a.kind == b.kind && a.direction == b.direction && (a.width - b.width).abs() < 0.1
    };
    a.lanes.len() == b.lanes.len()
        && (a.reference - b.reference).abs() < 0.2
        && a.lanes.iter().zip(&b.lanes).all(alike)
}
