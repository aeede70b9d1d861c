//! Buildings: walls flush with the solid, the roof that the plan says, and what hangs on both by what it is used for.

use nalgebra::UnitQuaternion;
use simworld_core::geometry::{Pose, Vector3};
use simworld_core::scene::{EntityRef, Place, Scene, Shape};
use simworld_core::value::Value;

use super::{Detail, Look, Part, pick};
use crate::mesh::MeshId;

type Color = [f32; 3];

/// Homes up to this height have a pitched roof where nobody says what roof they have, m.
const HOUSE_HEIGHT: f64 = 10.5;
/// How high a pitched roof is, m: walls end so far below the top.
const ROOF_RISE: f64 = 2.2;
/// How deep a flat roof lies behind its parapet, m.
const PARAPET: f64 = 0.7;

const ROOFS: [Color; 5] =
    [[0.3, 0.09, 0.05], [0.22, 0.07, 0.05], [0.09, 0.09, 0.1], [0.2, 0.13, 0.09], [0.14, 0.15, 0.16]];
const WALLS: [Color; 8] = [
    [0.6, 0.52, 0.42],
    [0.5, 0.24, 0.16],
    [0.66, 0.62, 0.55],
    [0.42, 0.42, 0.42],
    [0.55, 0.4, 0.28],
    [0.36, 0.4, 0.44],
    [0.62, 0.46, 0.36],
    [0.44, 0.17, 0.11],
];
const AWNINGS: [Color; 5] =
    [[0.45, 0.03, 0.03], [0.03, 0.2, 0.1], [0.03, 0.1, 0.32], [0.5, 0.25, 0.02], [0.2, 0.04, 0.16]];
/// Flat roofs.
const GRAVEL: Color = [0.28, 0.27, 0.26];

/// What the facade is painted as; the numbers are those of facades.wgsl.
#[derive(Clone, Copy, PartialEq)]
enum Front {
    Plain = 0,
    Shop = 1,
    Pitched = 2,
    Curtain = 3,
    Sheet = 4,
}

struct Plan<'a> {
    kind: &'a str,
    place: Option<Place>,
    size: Vector3,
    storeys: f64,
    roof: MeshId,
    front: Front,
    bits: u64,
}

impl<'a> Plan<'a> {
    fn of(entity: &EntityRef<'a>, scene: &'a dyn Scene, bits: u64) -> Self {
        let text = |key: &str| match entity.info.attributes.get(key) {
            Some(Value::Text(text)) => Some(text.as_str()),
            _ => None,
        };
        let kind = text("type").or_else(|| super::asset_name(entity, scene)).unwrap_or_default();
        let size = entity.info.shape.size();
        let place = entity.info.place;
        let count = entity.info.attributes.get("storeys").and_then(Value::as_i64);
        let lengthwise = size.x > size.y;
        let roof = match text("roof") {
            Some("gable") if lengthwise => MeshId::HouseAlong,
            Some("gable") => MeshId::House,
            Some("hip") if lengthwise => MeshId::HipAlong,
            Some("hip") => MeshId::Hip,
            Some("shed") => MeshId::Shed,
            None if size.z <= HOUSE_HEIGHT && size.z > 3.5 && matches!(place, Some(Place::Home) | None) => {
                if bits & 4 == 0 {
                    MeshId::House
                } else {
                    MeshId::Hip
                }
            }
            _ => MeshId::Block,
        };
        // A roof needs a wall under it.
        let roof = if size.z < ROOF_RISE + 2.0 { MeshId::Block } else { roof };
        let flat = roof == MeshId::Block;
        let wall = size.z - if flat { 0.9 } else { ROOF_RISE };
        let storeys = count.filter(|count| (1..200).contains(count));
        let storeys = storeys.map_or_else(|| (wall / 3.1).round().max(1.0), |count| count as f64);
        let front = match place {
            _ if !flat => Front::Pitched,
            Some(Place::Store | Place::Restaurant) => Front::Shop,
            Some(Place::Factory) => Front::Sheet,
            Some(Place::Office) if storeys > 6.0 || kind.contains("tower") && bits & 8 == 0 => Front::Curtain,
            _ => Front::Plain,
        };
        Self { kind, place, size, storeys, roof, front, bits }
    }

    fn wall(&self) -> f64 {
        self.size.z - if self.roof == MeshId::Block { 0.9 } else { ROOF_RISE }
    }

    fn is(&self, words: &[&str]) -> bool {
        words.iter().any(|word| self.kind.contains(word))
    }
}

/// A building as it is drawn at that detail.
pub(super) fn dress(
    entity: &EntityRef<'_>,
    scene: &dyn Scene,
    look: &Look,
    bits: u64,
    detail: Detail,
    parts: &mut Vec<Part>,
) {
    let color = entity.info.color.unwrap_or_else(|| pick(&WALLS, bits));
    if !matches!(entity.info.shape, Shape::Box { .. }) {
        // Facades are laid out on boxes.
        parts.push(Part { look: Look { color, ..*look }, place: Pose::identity() });
        return;
    }
    let plan = Plan::of(entity, scene, bits);
    let flat = plan.roof == MeshId::Block;
    let body = Look {
        mesh: if flat && detail == Detail::Far { MeshId::FarBlock } else { plan.roof },
        unit: 1.0,
        color,
        second: if flat { GRAVEL } else { pick(&ROOFS, bits >> 8) },
        state: f32::from(plan.front as u8),
        param: plan.storeys as f32,
        ..*look
    };
    parts.push(Part { look: body, place: Pose::identity() });
    if detail == Detail::Far {
        return;
    }
    let mut fit = Fitter { plan: &plan, body: &body, parts };
    fit.roof();
    fit.front();
    if detail == Detail::Near {
        fit.balconies();
    }
}

/// Puts fittings on a building.
struct Fitter<'a> {
    plan: &'a Plan<'a>,
    body: &'a Look,
    parts: &'a mut Vec<Part>,
}

impl Fitter<'_> {
    fn put(&mut self, mesh: MeshId, size: [f64; 3], at: [f64; 3], color: Color) {
        let scale = size.map(|component| component as f32);
        let look = Look { mesh, scale, color, state: 0.0, param: 0.0, ..*self.body };
        let place = Pose::from_parts(Vector3::from(at).into(), UnitQuaternion::identity());
        self.parts.push(Part { look, place });
    }

    /// The `k`-th share of the bits, in [0, 1).
    fn chance(&self, k: u32) -> f64 {
        ((self.plan.bits >> (k * 7)) % 128) as f64 / 128.0
    }

    fn roof(&mut self) {
        let plan = self.plan;
        let [x, y, top] = [plan.size.x, plan.size.y, plan.size.z];
        if plan.is(&["church", "cathedral"]) {
            let width = (y * 0.34).min(6.0);
            let height = top + 7.5;
            return self.put(
                MeshId::Spire,
                [width, width, height],
                [x * 0.5 - width * 0.5 + 0.6, 0.0, 0.0],
                self.body.color,
            );
        }
        if plan.roof != MeshId::Block {
            let (cx, cy) = (x * (0.16 + 0.1 * self.chance(1)), y * (0.3 - 0.6 * self.chance(2)));
            if plan.place != Some(Place::Factory) && x.max(y) < 40.0 {
                self.put(
                    MeshId::Chimney,
                    [0.7, 0.9, ROOF_RISE + 0.4],
                    [-cx, cy, top - ROOF_RISE + 0.3],
                    [0.28, 0.12, 0.08],
                );
            }
            return;
        }
        let deck = top - PARAPET;
        if plan.is(&["market", "mall", "station", "hall"]) && x > 12.0 {
            return self.put(MeshId::Skylight, [x * 0.4, y * 0.7, 2.6], [0.0, 0.0, deck], self.body.color);
        }
        let count = if x * y > 260.0 { 3 } else { 1 + u32::from(self.chance(0) > 0.5) };
        for k in 0..count {
            let (u, v) = (self.chance(k + 1) - 0.5, self.chance(k + 4) - 0.5);
            let size = 1.1 + 0.8 * self.chance(k + 2);
            self.put(
                MeshId::RoofUnit,
                [size, size * 1.3, 1.1],
                [x * (0.1 + 0.28 * u.abs()), y * 0.7 * v, deck],
                [0.5; 3],
            );
        }
        if plan.storeys > 4.0 && self.chance(5) < 0.4 && plan.front != Front::Curtain {
            self.put(MeshId::Tank, [2.2, 2.2, 4.2], [-x * 0.28, -y * 0.28, deck], [0.5; 3]);
        }
        if plan.storeys > 8.0 || self.chance(6) < 0.2 {
            let height = if plan.storeys > 16.0 { 8.0 } else { 4.0 };
            self.put(MeshId::Antenna, [1.0, 1.0, height], [-x * 0.1, y * 0.2, deck], [0.5; 3]);
        }
    }

    fn front(&mut self) {
        let plan = self.plan;
        let [x, y] = [plan.size.x * 0.5, plan.size.y];
        let storey = plan.wall() / plan.storeys;
        let accent = pick(&AWNINGS, plan.bits >> 12);
        match plan.place {
            _ if plan.is(&["museum", "court", "town_hall", "bank", "theatre"]) => {
                let height = plan.wall().min(10.0);
                self.put(MeshId::Portico, [2.4, y * 0.62, height], [x + 1.2, 0.0, 0.0], self.body.color);
            }
            Some(Place::Store | Place::Restaurant)
                if plan.size.z < 30.0 && !plan.is(&["market", "mall", "petrol"]) =>
            {
                let width = y * 0.44;
                for side in [-0.5, 0.5] {
                    let at = [x + 0.6, side * (width + 0.2) * 1.02, storey * 0.5];
                    self.put(MeshId::Awning, [1.2, width, storey * 0.24], at, accent);
                }
                let sign = [x + 0.5, y * 0.4, storey * 1.02];
                self.put(MeshId::BladeSign, [0.9, 0.12, 0.9], sign, pick(&AWNINGS, plan.bits >> 17));
            }
            Some(Place::Hospital) => {
                self.put(MeshId::Canopy, [3.2, 6.0, 3.0], [x + 1.6, 0.0, 0.0], [0.6; 3]);
                self.put(
                    MeshId::Cross,
                    [0.2, 2.2, 2.2],
                    [x + 0.1, y * 0.3, plan.wall() - 2.8],
                    [0.6, 0.02, 0.02],
                );
            }
            Some(Place::Factory) => {
                let count = (y / 9.0).floor().clamp(1.0, 4.0);
                for k in 0..count as u32 {
                    let at = (f64::from(k) + 0.5) / count - 0.5;
                    let height = (plan.wall() - 0.6).min(3.8);
                    self.put(
                        MeshId::Gate,
                        [0.16, 3.6, height],
                        [x + 0.08, y * at * 0.9 + 0.2, 0.0],
                        [0.3, 0.34, 0.38],
                    );
                }
            }
            Some(Place::Office | Place::School) => {
                self.put(MeshId::Canopy, [2.2, 4.4, 3.0], [x + 1.1, 0.0, 0.0], [0.3, 0.31, 0.32]);
            }
            Some(Place::Home) => {
                self.put(MeshId::Canopy, [1.2, 2.4, 2.75], [x + 0.6, 0.0, 0.0], [0.4, 0.38, 0.35]);
            }
            _ => {}
        }
    }

    fn balconies(&mut self) {
        let plan = self.plan;
        let home = plan.place == Some(Place::Home) && plan.storeys > 2.0;
        if !home || plan.is(&["row_house", "villa", "house"]) && self.chance(3) < 0.6 {
            return;
        }
        let storey = plan.wall() / plan.storeys;
        let width = plan.size.y;
        let bays = (width / 6.5).floor().clamp(1.0, 5.0);
        let color = pick(
            &[[0.1, 0.1, 0.11], [0.66, 0.65, 0.62], [0.3, 0.36, 0.38], self.body.color],
            plan.bits >> 21,
        );
        for floor in 1..plan.storeys as u32 {
            for bay in 0..bays as u32 {
                let y = ((f64::from(bay) + 0.5) / bays - 0.5) * width;
                let at = [plan.size.x * 0.5 + 0.6, y, f64::from(floor) * storey + 0.1];
                self.put(MeshId::Balcony, [1.2, (width / bays * 0.62).min(4.4), 1.05], at, color);
            }
        }
    }
}
