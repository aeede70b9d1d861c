//! Lamps that light what is around them: street lamps, headlights, signals, and what has `light_lumen`.
//!
//! The nearest of them go to the shaders with a grid of cells on the ground, each of which names the few that matter
//! there, so that a pixel pays for at most [`LAMPS_A_CELL`]. The twin of this layout is in shaders/lamps.wgsl. They throw no
//! shadows.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use nalgebra::Vector3 as V;
use simworld_core::environment::color_of_kelvin;
use simworld_core::geometry::{Aabb, Point3, Vector3};
use simworld_core::net::Aspect;
use simworld_core::ops;
use simworld_core::scene::{EntityKind, EntityRef, Scene};
use simworld_core::value::Value;

use crate::light::Light;
use crate::mesh::LAMP_REACH;
use crate::view::vec4;

/// Cells across, and their size in m.
const ACROSS: usize = 32;
const CELL: f64 = 8.0;
/// Lamps that light one place at most, and all that are kept.
const LAMPS_A_CELL: usize = 8;
const MOST: usize = 256;
/// Views from within a cube of this side share a grid, m.
const SHARED: f64 = 32.0;
/// Grids of a batch; views that would need more have no lamps.
const MOST_GRIDS: usize = 1024;
/// What the light of a lamp has fallen to at its range, lux.
const LEAST_LUX: f64 = 0.12;
/// A street lamp without attributes: lumens and kelvins of LED lamps of residential streets.
const STREET_LUMEN: f64 = 4200.0;
const STREET_KELVIN: f64 = 3500.0;
/// A lantern on a post of a park, lumens all round.
const LANTERN_LUMEN: f64 = 2500.0;
/// A floodlight on a mast: lumens, half the angle of its beam, and how far down it looks, radians.
const FLOOD_LUMEN: f64 = 60_000.0;
const FLOOD_HALF: f64 = 0.6;
const FLOOD_DOWN: f64 = 0.5;
/// Low beams of a vehicle together, candela along the axis (UN Regulation 112: 6,000 to 13,000 below the cut-off), and their
/// colour.
const HEADLIGHT_CANDELA: f64 = 7000.0;
const HEADLIGHT_KELVIN: f64 = 4300.0;
/// A signal head of 200 mm (EN 12368).
const SIGNAL_CANDELA: f64 = 200.0;
/// Slower vehicles have their lamps off unless their attribute `lights` is true, m/s.
const DRIVING: f64 = 0.3;

/// A lamp, relative to the least corner of the grid.
#[derive(Clone, Debug, PartialEq)]
struct Lamp {
    place: Vector3,
    /// Candela along the axis, linear sRGB.
    color: V<f64>,
    aim: Vector3,
    /// Cosines from the axis: nothing beyond the first, everything within the second.
    cone: [f64; 2],
    range: f64,
}

/// Where the grid of a view is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LampPlace {
    /// Its least corner.
    pub corner: Point3,
    /// Its first entry among those of the batch.
    pub entry: usize,
}

/// The grids of a batch; views from about one place share one.
#[derive(Default)]
pub(crate) struct LampGrids {
    places: BTreeMap<[i64; 3], Option<LampPlace>>,
    /// As the shaders read them, one behind the other.
    pub entries: Vec<[f32; 4]>,
}

impl LampGrids {
    /// The lamps around an eye, if there are any that shine. `first` is where the entries will lie.
    pub(crate) fn around(
        &mut self,
        scene: &dyn Scene,
        eye: Point3,
        light: &Light,
        first: usize,
    ) -> Option<LampPlace> {
        if light.night <= 0.0 && light.headlights <= 0.0 {
            return None;
        }
        let key = [eye.x, eye.y, eye.z].map(|coordinate| (coordinate / SHARED).floor() as i64);
        if let Some(known) = self.places.get(&key) {
            return *known;
        }
        let half = 0.5 * ACROSS as f64 * CELL;
        let middle = Point3::from(Vector3::from(key.map(|index| (index as f64 + 0.5) * SHARED)));
        let corner = middle - Vector3::new(half, half, 0.0);
        let lamps = gather(scene, middle, corner, half, light);
        let room = self.entries.len() < MOST_GRIDS * (2 * ACROSS * ACROSS + 3 * MOST);
        let place =
            (!lamps.is_empty() && room).then(|| LampPlace { corner, entry: first + self.entries.len() });
        if place.is_some() {
            self.append(&lamps, light.exposure);
        }
        self.places.insert(key, place);
        place
    }

    fn append(&mut self, lamps: &[Lamp], exposure: f64) {
        let start = self.entries.len();
        self.entries.resize(start + 2 * ACROSS * ACROSS, [-1.0; 4]);
        for row in 0..ACROSS {
            for column in 0..ACROSS {
                let at = [(column as f64 + 0.5) * CELL, (row as f64 + 0.5) * CELL];
                let cell = start + 2 * (row * ACROSS + column);
                for (slot, index) in strongest(lamps, at).into_iter().enumerate() {
                    self.entries[cell + slot / 4][slot % 4] = index as f32;
                }
            }
        }
        for lamp in lamps {
            let fall = 1.0 / (lamp.range * lamp.range * lamp.range * lamp.range);
            let color = lamp.color * exposure;
            self.entries.push(vec4(&lamp.place, fall));
            self.entries.push(vec4(&color, lamp.cone[0]));
            self.entries.push(vec4(&lamp.aim, lamp.cone[1]));
        }
    }
}

/// The lamps that give most light at a place, strongest first.
fn strongest(lamps: &[Lamp], at: [f64; 2]) -> Vec<usize> {
    let mut found: Vec<(f64, usize)> = lamps
        .iter()
        .enumerate()
        .filter_map(|(index, lamp)| {
            let across = Vector3::new(at[0] - lamp.place.x, at[1] - lamp.place.y, 0.0);
            let distance = across.norm();
            // Half a diagonal of a cell may be nearer.
            let nearest = (distance - CELL * std::f64::consts::FRAC_1_SQRT_2).max(0.0);
            let behind = across.dot(&lamp.aim) < -CELL * lamp.aim.xy().norm() && lamp.cone[0] > 0.3;
            (nearest < lamp.range && !behind)
                .then(|| (lamp.color.sum() / (distance * distance + 16.0), index))
        })
        .collect();
    found.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    found.into_iter().take(LAMPS_A_CELL).map(|(_, index)| index).collect()
}

fn gather(scene: &dyn Scene, middle: Point3, corner: Point3, half: f64, light: &Light) -> Vec<Lamp> {
    let signals = scene.signals();
    let region = Aabb::around(middle, Vector3::new(half, half, 80.0));
    let mut found: Vec<(f64, u64, Lamp)> = Vec::new();
    let _ = scene.visit(&region, &mut |entity| {
        if entity.is_visible() {
            let key = ((entity.position() - middle).norm_squared(), entity.id.into());
            if entity.kind == EntityKind::StreetLamp {
                found.extend(post_lamps(&entity, scene, corner, light).map(|lamp| (key.0, key.1, lamp)));
            } else if let Some(lamp) = lamp_of(&entity, signals, corner, light) {
                found.push((key.0, key.1, lamp));
            }
        }
        ControlFlow::Continue(())
    });
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    found.truncate(MOST);
    found.into_iter().map(|(_, _, lamp)| lamp).collect()
}

fn number(entity: &EntityRef<'_>, name: &str) -> Option<f64> {
    entity.info.attributes.get(name).and_then(Value::as_f64).filter(|value| value.is_finite())
}

fn kelvin(kelvin: f64) -> V<f64> {
    V::from(color_of_kelvin(kelvin))
}

/// Candela on the axis of a cone that holds so many lumens; half its angle in radians.
fn candela(lumen: f64, half_angle: f64) -> f64 {
    lumen / (std::f64::consts::TAU * (1.0 - ops::cos(half_angle)))
}

/// Makes a lamp of an entity: where it is and what it aims at in the body frame, candela on its axis, its cone, and how far it
/// reaches at most.
fn made(
    entity: &EntityRef<'_>,
    corner: Point3,
    [at, aim]: [Vector3; 2],
    color: V<f64>,
    cone: [f64; 2],
    farthest: f64,
) -> Lamp {
    let turn = |v: Vector3| entity.pose.rotation * v;
    let range = (color.max() / LEAST_LUX).sqrt().clamp(1.0, farthest);
    Lamp { place: entity.position() + turn(at) - corner, color, aim: turn(aim), cone, range }
}

/// The lamps of a post, by what its asset is called: one on an arm, two, a lantern, a floodlight.
fn post_lamps(
    entity: &EntityRef<'_>,
    scene: &dyn Scene,
    corner: Point3,
    light: &Light,
) -> impl Iterator<Item = Lamp> + use<> {
    /// Most of it falls within 60° of straight down, and nothing beyond 85°.
    const DOWNWARD: [f64; 2] = [0.09, 0.75];
    let name = crate::look::asset_name(entity, scene).unwrap_or_default();
    let height = entity.info.shape.size().z;
    let said = number(entity, "light_lumen").map(|lumen| lumen.clamp(0.0, 1e7));
    let color = kelvin(number(entity, "light_kelvin").unwrap_or(STREET_KELVIN));
    let lit = |usual: f64, share: f64, half: f64| {
        color * (candela(said.unwrap_or(usual), half) * share * light.night)
    };
    let (reach, head, down) = (0.85 * f64::from(LAMP_REACH), height - 0.1, -Vector3::z());
    let arm = |x: f64, color| made(entity, corner, [Vector3::new(x, 0.0, head), down], color, DOWNWARD, 45.0);
    let wide = 60.0_f64.to_radians();
    let lamps = if name.contains("double_street_lamp") {
        // Each as bright as one alone; what is said of the whole is shared.
        let color = lit(2.0 * STREET_LUMEN, 0.5, wide);
        vec![arm(reach, color), arm(-reach, color)]
    } else if name.contains("lantern") {
        let glass = Vector3::new(0.0, 0.0, (height - 0.35).max(0.0));
        let color = lit(LANTERN_LUMEN, 1.0, std::f64::consts::PI);
        vec![made(entity, corner, [glass, down], color, [-3.0, -2.0], 25.0)]
    } else if name.contains("floodlight") {
        let (sin, cos) = ops::sin_cos(FLOOD_DOWN);
        let edge = ops::cos(FLOOD_HALF);
        let places = [Vector3::new(0.5, 0.0, head), Vector3::new(cos, 0.0, -sin)];
        let color = lit(FLOOD_LUMEN, 1.0, FLOOD_HALF);
        vec![made(entity, corner, places, color, [edge, edge + 0.3 * (1.0 - edge)], 90.0)]
    } else {
        vec![arm(reach, lit(STREET_LUMEN, 1.0, wide))]
    };
    lamps.into_iter().filter(|lamp| lamp.color.sum() > 0.0)
}

fn lamp_of(entity: &EntityRef<'_>, signals: &[Aspect], corner: Point3, light: &Light) -> Option<Lamp> {
    let size = entity.info.shape.size();
    let made = |at: Vector3, aim: Vector3, color: V<f64>, cone: [f64; 2], farthest: f64| {
        made(entity, corner, [at, aim], color, cone, farthest)
    };
    let lumen = number(entity, "light_lumen").map(|lumen| lumen.clamp(0.0, 1e7));
    if let Some(lumen) = lumen {
        let color = kelvin(number(entity, "light_kelvin").unwrap_or(4000.0));
        let top = Vector3::new(0.0, 0.0, size.z);
        let half = 0.5
            * number(entity, "light_cone")
                .unwrap_or(std::f64::consts::TAU)
                .clamp(0.02, std::f64::consts::TAU);
        let (up, along) = ops::sin_cos(number(entity, "light_pitch").unwrap_or(0.0));
        let edge = ops::cos(half);
        let cone = if half > 3.1 { [-3.0, -2.0] } else { [edge, edge + 0.3 * (1.0 - edge)] };
        let strength = candela(lumen, half);
        return (lumen > 0.0).then(|| made(top, Vector3::new(along, 0.0, up), color * strength, cone, 60.0));
    }
    if entity.kind == EntityKind::TrafficSignal {
        let color = match crate::look::aspect_of(entity, signals)? {
            Aspect::Red => V::new(1.0, 0.05, 0.03),
            Aspect::Yellow => V::new(1.0, 0.5, 0.03),
            Aspect::Green => V::new(0.05, 1.0, 0.4),
        };
        let head = Vector3::new(0.35, 0.0, size.z - 0.5);
        let lit = color * (SIGNAL_CANDELA * light.night);
        return (light.night > 0.0).then(|| made(head, Vector3::x(), lit, [0.1, 0.95], 14.0));
    }
    let drives = || {
        entity.twist.ground_speed() > DRIVING
            || entity.info.attributes.get("lights").is_some_and(|value| *value == Value::Bool(true))
    };
    if entity.kind.is_vehicle() && entity.kind != EntityKind::Bicycle && light.headlights > 0.0 && drives() {
        let front = Vector3::new(0.5 * size.x, 0.0, 0.65_f64.min(0.6 * size.z));
        // A little down, as low beams are.
        let aim = Vector3::new(1.0, 0.0, -0.045).normalize();
        let lit = kelvin(HEADLIGHT_KELVIN) * (HEADLIGHT_CANDELA * light.headlights);
        return Some(made(front, aim, lit, [0.88, 0.9985], 55.0));
    }
    None
}

#[cfg(test)]
mod tests {
    use simworld_core::environment::Environment;
    use simworld_core::geometry::pose_facing;
    use simworld_core::scene::{EntityDesc, Shape, World};

    use super::*;

    fn night() -> Light {
        let mut environment = Environment::default();
        environment.sun.elevation = -0.5;
        Light::of(&environment, 0.0)
    }

    fn lamps(count: u32, gap: f64) -> World {
        let mut world = World::new();
        for index in 0..count {
            let pose = pose_facing(Point3::new(f64::from(index) * gap, 2.0, 0.0), 0.0);
            let shape = Shape::Cylinder { radius: 0.09, height: 6.0 };
            world.spawn(EntityDesc::new(EntityKind::StreetLamp, pose, shape)).unwrap();
        }
        world
    }

    fn grid(world: &World, light: &Light) -> LampGrids {
        let mut grids = LampGrids::default();
        let eye = Point3::new(1.0, 1.0, 2.0);
        let place = grids.around(world, eye, light, 144);
        assert_eq!(place, grids.around(world, eye, light, 144), "one place, one grid");
        assert_eq!(place.is_some(), !grids.entries.is_empty());
        grids
    }

    #[test]
    fn no_place_has_more_lamps_than_a_pixel_pays_for() {
        let grid = grid(&lamps(400, 0.5), &night());
        assert_eq!(grid.entries.len(), 2 * ACROSS * ACROSS + 3 * MOST, "as many as are kept");
        let lamps = (grid.entries.len() - 2 * ACROSS * ACROSS) / 3;
        let cells = &grid.entries[..2 * ACROSS * ACROSS];
        assert!(cells.iter().flatten().all(|index| *index >= -1.0 && (*index as i64) < lamps as i64));
        assert!(cells.iter().flatten().any(|index| *index >= 0.0));
    }

    #[test]
    fn by_day_nothing_is_gathered() {
        let light = Light::of(&Environment::default(), 0.0);
        assert!(grid(&lamps(5, 20.0), &light).entries.is_empty());
        assert!(grid(&World::new(), &night()).entries.is_empty());
    }

    /// 4200 lm in a cone of 60° from 5.9 m: the lux that a tape and a table give.
    #[test]
    fn a_street_lamp_gives_the_light_it_is_said_to() {
        let lux = candela(4200.0, 60.0_f64.to_radians()) / (5.9 * 5.9);
        assert!((lux - 38.4).abs() < 0.5, "{lux}");
    }

    /// The light on the ground from a post of the library at the origin that looks east, lux, at a place.
    fn lux_of(name: &str, at: [f64; 2]) -> f64 {
        let mut world = World::new();
        let library = simworld_core::asset::Catalogue::library();
        let asset = library.iter().find(|(_, asset)| asset.name == name).unwrap().1.clone();
        let id = world.add_asset(asset.clone()).unwrap();
        let post = world.spawn(asset.at(id, pose_facing(Point3::origin(), 0.0))).unwrap();
        let light = night();
        let lamps = post_lamps(&world.entity(post).unwrap(), &world, Point3::origin(), &light);
        let lux = |lamp: Lamp| {
            let way = Vector3::new(at[0], at[1], 0.0) - lamp.place;
            let cosine = way.normalize().dot(&lamp.aim.normalize());
            let share = ((cosine - lamp.cone[0]) / (lamp.cone[1] - lamp.cone[0])).clamp(0.0, 1.0);
            lamp.color.max() * share * -way.z / (way.norm_squared() * way.norm())
        };
        lamps.map(lux).sum()
    }

    #[test]
    fn posts_cast_the_light_of_what_they_are() {
        let (ahead, behind) = ([6.0, 0.0], [-6.0, 0.0]);
        let double = [ahead, behind].map(|at| lux_of("double_street_lamp", at));
        assert!((double[0] - double[1]).abs() < 1e-9 && double[0] > 1.0, "an arm to each side: {double:?}");
        let lantern = [[3.0, 0.0], [-3.0, 0.0], [0.0, 3.0]].map(|at| lux_of("park_lantern", at));
        assert!(
            lantern.iter().all(|lux| (lux - lantern[0]).abs() < 1e-9 && *lux > 1.0),
            "all round: {lantern:?}"
        );
        let flood = [[20.0, 0.0], [-20.0, 0.0]].map(|at| lux_of("floodlight", at));
        assert!(flood[0] > 20.0 && flood[1] == 0.0, "ahead alone, and far: {flood:?}");
    }

    #[test]
    fn nonsense_in_attributes_is_no_light() {
        for lumen in [f64::NAN, f64::INFINITY, -5.0, 0.0] {
            let mut world = World::new();
            let pose = pose_facing(Point3::new(5.0, 0.0, 0.0), 0.0);
            let desc = EntityDesc::new(EntityKind::Prop, pose, Shape::cuboid(1.0, 1.0, 1.0));
            world.spawn(desc.with("light_lumen", lumen)).unwrap();
            assert!(grid(&world, &night()).entries.is_empty(), "{lumen}");
        }
    }
}
