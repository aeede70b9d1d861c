//! Kerbs: stones between carriageway and sidewalk, parts of the sidewalks, as Cityscapes has it. They are let down where a crossing
//! begins.
//!
//! Carriageway and sidewalk differ by two centimetres in height, on which bodies walk and drive; the stones stand out so much
//! over the sidewalk that one sees them.

use simworld_core::geometry::{Point2, Pose, Vector2, Vector3, heading};
use simworld_core::id::{IntersectionId, SidewalkId};
use simworld_core::net::{Side, polyline};

use super::Fit;
use crate::look::{Detail, Look};
use crate::mesh::{Drawn, MeshId};
use crate::resident;

/// Width of a kerbstone, how far it stands out over the sidewalk, and how far it reaches below its top, m.
const WIDTH: f64 = 0.15;
const OUT: f64 = 0.03;
const DEPTH: f64 = 0.08;
/// Concrete, linear-light sRGB.
const STONE: [f32; 3] = [0.42, 0.41, 0.39];
/// Beyond the stripes of a crossing its kerb is let down so far to either side, m.
const LET_DOWN: f64 = 0.3;

/// The kerb beside a piece of a sidewalk.
pub(super) fn along(fit: &Fit<'_>, walk: SidewalkId, look: &Look, out: &mut Vec<resident::Part>) {
    let walk = &fit.network.sidewalks[walk.index()];
    let road = &fit.network.roads[walk.road.index()];
    let (from, to) = fit.stations();
    let way = (fit.piece.end - fit.piece.start).normalize();
    let left = Vector2::new(-way.y, way.x);
    // How far the sidewalk lies from the centreline tells how far the kerb lies from the sidewalk.
    let middle = nalgebra::center(&fit.piece.start, &fit.piece.end);
    let Some(closest) = polyline::closest(&road.centerline, &middle) else { return };
    let aside = match walk.side {
        Side::Left => road.left_kerb - closest.lateral,
        Side::Right => -road.right_kerb - closest.lateral,
    };
    let point = |station: f64| fit.piece.start + way * (station - fit.piece.station) + left * aside;
    // The stones lie on the side of the sidewalk.
    let outwards = if walk.side == Side::Left { 1.0 } else { -1.0 };
    stones(fit, [point(from), point(to)], outwards, look, out);
}

/// The kerb round a corner, as far as it belongs to this piece of the walkway.
pub(super) fn round(
    fit: &Fit<'_>,
    place: IntersectionId,
    rank: u32,
    look: &Look,
    out: &mut Vec<resident::Part>,
) {
    let place = &fit.network.intersections[place.index()];
    let Some(walkway) = place.corners.get(rank as usize) else { return };
    for ends in place.kerb(rank as usize).windows(2) {
        let middle = nalgebra::center(&ends[0], &ends[1]);
        let length = (fit.piece.end - fit.piece.start).norm();
        let own = polyline::closest(walkway, &middle).is_some_and(|closest| {
            (fit.piece.station..fit.piece.station + length).contains(&closest.station)
                || (closest.station >= fit.piece.station + length
                    && fit.piece.end == walkway[walkway.len() - 1])
        });
        if own {
            // Junctions have their outline counter-clockwise: what is paved for vehicles is on the left.
            stones(fit, [ends[0], ends[1]], -1.0, look, out);
        }
    }
}

/// Stones from one point to another, on the left (1) or the right (-1) of that line; none where one crosses.
fn stones(fit: &Fit<'_>, ends: [Point2; 2], side: f64, look: &Look, out: &mut Vec<resident::Part>) {
    let way = ends[1] - ends[0];
    let length = way.norm();
    if length < 0.02 {
        return;
    }
    for (from, to) in gaps_out(fit, ends) {
        if to - from < 0.02 {
            continue;
        }
        let at = |share: f64| fit.local(ends[0] + way * share);
        let ((ax, ay), (bx, by)) = (at(from / length), at(to / length));
        let step = Vector2::new(bx - ax, by - ay);
        let normal = Vector2::new(-step.y, step.x) / step.norm();
        let middle = Vector2::new(ax + bx, ay + by) * 0.5 + normal * (side * WIDTH * 0.5);
        let turn = nalgebra::UnitQuaternion::from_axis_angle(&Vector3::z_axis(), heading(&step));
        let place = Vector3::new(middle.x, middle.y, fit.size.z + OUT - DEPTH);
        let size = [step.norm() as f32, WIDTH as f32, DEPTH as f32];
        let look = Look {
            mesh: MeshId::Cuboid,
            scale: size,
            unit: 1.0,
            color: STONE,
            state: 0.0,
            param: 0.0,
            ..*look
        };
        let pose = fit.pose * Pose::from_parts(place.into(), turn);
        let details = Detail::Near.bit() | Detail::Middle.bit();
        out.push(resident::Part { mesh: Drawn::Own(look.mesh), pose, look, details });
    }
}

/// The parts of a line, m from its start, that no crossing meets.
fn gaps_out(fit: &Fit<'_>, ends: [Point2; 2]) -> Vec<(f64, f64)> {
    let way = ends[1] - ends[0];
    let length = way.norm();
    let along = way / length;
    let mut parts: Vec<(f64, f64)> = vec![(0.0, length)];
    for (foot, half) in crossings(fit) {
        let offset = foot - ends[0];
        if along.perp(&offset).abs() > 1.5 {
            continue;
        }
        let middle = along.dot(&offset);
        let (low, high) = (middle - half, middle + half);
        parts = parts
            .into_iter()
            .flat_map(|(from, to)| [(from, to.min(low)), (from.max(high), to)])
            .filter(|(from, to)| to > from)
            .collect();
    }
    parts
}

/// Where crossings meet the kerbs near a piece, and half of how wide each is.
fn crossings(fit: &Fit<'_>) -> Vec<(Point2, f64)> {
    let network = fit.network;
    let places = match fit.piece.line {
        super::Line::Sidewalk(walk) => {
            let road = &network.roads[network.sidewalks[walk.index()].road.index()];
            vec![road.from, road.to]
        }
        super::Line::Corner(place, _) => vec![place],
        super::Line::Road(_) => Vec::new(),
    };
    let ids = places.iter().flat_map(|place| &network.intersections[place.index()].crossings);
    let crossings = ids.map(|id| &network.crossings[id.index()]);
    crossings
        .flat_map(|crossing| [crossing.start, crossing.end].map(|end| (end, crossing.width * 0.5 + LET_DOWN)))
        .collect()
}
