//! Bridges as entities: decks that one drives and walks over, parapets, abutments and piers. One passes below between them.

use simworld_core::geometry::{Obb, Point2, Vector2};
use simworld_core::net::polyline;
use simworld_core::scene::{EntityDesc, EntityKind, Shape};

use super::{GROUND_TOP, LAYER, Parts, ROAD_TOP, SIDEWALK_TOP};
use crate::decks::{Bridge, Span, bridges};
use crate::strips::strip;
use crate::terrain::DECK;

/// Height of a parapet above the sidewalk, m: 42 inches (AASHTO LRFD Bridge Design Specifications 2012, 13.8 and 13.9),
/// and its thickness.
const PARAPET: (f64, f64) = (1.07, 0.3);
/// Thickness of a pier along the bridge, and its share of the width of the deck.
const PIER: (f64, f64) = (1.2, 0.6);

/// Pieces reach so far beyond their ends, m, that nothing falls between two.
const JOINT: f64 = 0.05;

impl Parts<'_> {
    pub(super) fn bridges(&self, descs: &mut Vec<EntityDesc>) {
        for bridge in bridges(self.network, self.heights).iter().filter(|bridge| self.has_road(bridge.road)) {
            self.bridge(bridge, descs);
        }
    }

    fn bridge(&self, bridge: &Bridge, descs: &mut Vec<EntityDesc>) {
        let road = &self.network.roads[bridge.road.index()];
        let (left, right) = bridge.sides;
        for span in &bridge.spans {
            let mut add = |kind, sides, top, thickness| {
                descs.push(beam(kind, span, sides, (top, thickness)));
            };
            add(EntityKind::Road, (left, -right), ROAD_TOP, LAYER);
            // Surfaces are flat: it is the deck below that bears.
            if span.is_raised() {
                add(EntityKind::Prop, (left, -right), GROUND_TOP, DECK);
            }
            for walk in bridge.walks(road) {
                add(EntityKind::Sidewalk, walk, SIDEWALK_TOP, LAYER);
            }
            if span.is_carried() && span.is_on_ground() {
                // Down to the lower end of the ground, as thick as it is high.
                let high = (0..2).map(|end| span.heights[end] - span.ground[end]).fold(0.0, f64::max);
                if high > DECK + 0.05 {
                    let (inner, depth) = (0.1, high - DECK + 0.2);
                    add(EntityKind::Prop, (left - inner, inner - right), ROAD_TOP - DECK, depth);
                }
            }
            let station =
                |end: Point2| polyline::closest(&road.centerline, &end).map_or(0.0, |it| it.station);
            let is_between = span
                .ends
                .iter()
                .all(|end| (bridge.between.0 - 1e-6..=bridge.between.1 + 1e-6).contains(&station(*end)));
            if span.is_carried() && is_between {
                let (height, width) = PARAPET;
                add(EntityKind::Prop, (left, left - width), SIDEWALK_TOP + height, height);
                add(EntityKind::Prop, (width - right, -right), SIDEWALK_TOP + height, height);
            }
        }
        for pier in &bridge.piers {
            let half = (left + right) * 0.5 * PIER.1;
            let middle = pier.at + pier.across * ((left - right) * 0.5);
            let along = Vector2::new(pier.across.y, -pier.across.x) * (PIER.0 * 0.5);
            let box_ = strip(middle - along, middle + along, half, half, 0.0);
            descs.push(upright(&box_, pier.heights));
        }
    }
}

/// A box with the ground plan of a strip, from a height to another.
pub(super) fn upright(plan: &Obb, (foot, top): (f64, f64)) -> EntityDesc {
    let mut pose = plan.pose;
    pose.translation.z = foot;
    let size = plan.half_extents * 2.0;
    EntityDesc::new(EntityKind::Prop, pose, Shape::cuboid(size.x, size.y, (top - foot).max(0.1)))
}

/// A box along a span between two distances to the left of the centreline, its top so far above the carriageway.
pub(super) fn beam(
    kind: EntityKind,
    span: &Span,
    (left, right): (f64, f64),
    (top, thickness): (f64, f64),
) -> EntityDesc {
    let [a, b] = span.ends;
    let mut flat = strip(a, b, left, -right, 0.0);
    let (run, rise) = ((b - a).norm(), span.heights[1] - span.heights[0]);
    let slope = (run * run + rise * rise).sqrt();
    let climb = nalgebra::UnitQuaternion::from_axis_angle(
        &nalgebra::Vector3::y_axis(),
        -simworld_core::ops::atan2(rise, run),
    );
    // Boxes stand on their poses: below the middle of the top by the thickness, square to the slope.
    let middle = (span.heights[0] + span.heights[1]) * 0.5 + top;
    flat.pose.rotation *= climb;
    let up = flat.pose.rotation * nalgebra::Vector3::z();
    flat.pose.translation.z = middle;
    flat.pose.translation.vector -= up * thickness;
    EntityDesc::new(kind, flat.pose, Shape::cuboid(slope + 2.0 * JOINT, (left - right).max(0.01), thickness))
}
