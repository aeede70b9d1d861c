//! What lies beside the lanes: coloured cycle lanes, raised medians and verges, marked parking bays.

use simworld_core::id::RoadId;
use simworld_core::net::LaneKind;

use super::city::{GRASS, LINE, Material, Node, PAINT, PAVING, SIDEWALK, WHITE, material};
use super::mesh::{Base, Builder, Mesh};
use crate::City;
use crate::strips::{bays, is_planted};

const CYCLE: Material = material("cycle lane", [0.36, 0.08, 0.05], 0.9);
const SETTS: Material = material("parking", [0.14, 0.14, 0.145], 0.95);
/// Strips level with the road lie a hair below its paint, m.
const FLAT: f64 = PAINT - 0.005;
/// Raised strips begin below the road, m.
const FOOT: f64 = -0.2;

pub(super) fn node(builder: &mut Builder<'_>, city: &City) -> Node {
    let mut meshes: [Mesh; 5] = Default::default();
    let [cycle, parking, bay_ends, paved, planted] = &mut meshes;
    for (index, road) in city.network.roads.iter().enumerate() {
        builder.stand_on_road(RoadId::from_index(index));
        for strip in &road.strips {
            let (path, half) = (road.strip_path(strip), strip.width * 0.5);
            let mut flat = |mesh: &mut Mesh| builder.ribbon(mesh, &path, (half, half), FLAT);
            match strip.kind {
                LaneKind::Cycle => flat(cycle),
                LaneKind::Parking => {
                    flat(parking);
                    for [from, to] in bays(road, strip) {
                        builder.stripe(bay_ends, from, to, LINE, PAINT);
                    }
                }
                LaneKind::Median | LaneKind::Verge => {
                    let mesh = if is_planted(strip) { &mut *planted } else { &mut *paved };
                    if road.level > 0 {
                        builder.kerb(mesh, &path, strip.width, (FOOT, SIDEWALK));
                    } else {
                        builder.prism(mesh, &road.strip_outline(strip), FOOT, SIDEWALK);
                    }
                }
                _ => {}
            }
        }
    }
    builder.stand_on(Base::Ground);
    let materials = [CYCLE, SETTS, WHITE, PAVING, GRASS];
    Node { name: "strips", parts: materials.into_iter().zip(meshes).collect() }
}
