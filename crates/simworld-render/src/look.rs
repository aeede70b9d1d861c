//! How a kind of entity looks: its mesh, its size, its colours, with deterministic variation by id.

use simworld_core::net::Aspect;
use simworld_core::scene::{EntityKind, EntityRef, Place, Role, Shape};
use simworld_core::seed::{Seed, Stream};

use crate::mesh::{CROWN_RADIUS, LAMP_REACH, MeshId};

/// Homes up to this height have a pitched roof, m.
const HOUSE_HEIGHT: f64 = 10.5;
/// Slower people stand, m/s.
const WALKING_SPEED: f64 = 0.2;

/// Everything about the look of one entity but its pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Look {
    pub mesh: MeshId,
    /// The box that anchors share, m.
    pub scale: [f32; 3],
    /// The unit of offsets, m.
    pub unit: f32,
    /// Linear-light sRGB.
    pub color: [f32; 3],
    pub second: [f32; 3],
    /// A number of its own, in [0, 1).
    pub seed: f32,
    /// Signals: 1 red, 2 yellow, 3 green, 0 dark. Buildings: 1 with a shop front, 2 with a
    /// pitched roof.
    pub state: f32,
    /// Buildings: storeys.
    pub param: f32,
    /// How far it reaches beyond the ball around its solid, m.
    pub reach: f64,
}

/// Shirts, dresses and coats.
const CLOTHES: [[f32; 3]; 10] = [
    [0.55, 0.06, 0.05],
    [0.04, 0.12, 0.4],
    [0.75, 0.72, 0.66],
    [0.05, 0.25, 0.12],
    [0.7, 0.42, 0.05],
    [0.06, 0.06, 0.07],
    [0.3, 0.05, 0.22],
    [0.12, 0.38, 0.5],
    [0.4, 0.4, 0.42],
    [0.72, 0.25, 0.16],
];
/// Trousers and skirts.
const TROUSERS: [[f32; 3]; 6] = [
    [0.03, 0.05, 0.12],
    [0.02, 0.02, 0.025],
    [0.2, 0.15, 0.09],
    [0.09, 0.13, 0.22],
    [0.12, 0.12, 0.13],
    [0.32, 0.27, 0.2],
];
/// Car paint, in the shares in which cars are bought.
const PAINT: [[f32; 3]; 10] = [
    [0.78, 0.78, 0.78],
    [0.78, 0.78, 0.78],
    [0.025, 0.025, 0.03],
    [0.025, 0.025, 0.03],
    [0.22, 0.23, 0.25],
    [0.42, 0.43, 0.45],
    [0.02, 0.07, 0.26],
    [0.36, 0.015, 0.015],
    [0.04, 0.16, 0.13],
    [0.45, 0.3, 0.12],
];
const LEAVES: [[f32; 3]; 5] =
    [[0.085, 0.17, 0.045], [0.12, 0.2, 0.05], [0.065, 0.14, 0.05], [0.16, 0.22, 0.055], [0.1, 0.16, 0.065]];
const ROOFS: [[f32; 3]; 4] = [[0.3, 0.09, 0.05], [0.22, 0.07, 0.05], [0.09, 0.09, 0.1], [0.2, 0.13, 0.09]];
const WALLS: [[f32; 3]; 6] = [
    [0.6, 0.52, 0.42],
    [0.5, 0.24, 0.16],
    [0.66, 0.62, 0.55],
    [0.42, 0.42, 0.42],
    [0.55, 0.4, 0.28],
    [0.36, 0.4, 0.44],
];
/// Flat roofs.
const GRAVEL: [f32; 3] = [0.28, 0.27, 0.26];

/// Draws the variation of entities: the same id looks the same in every picture.
pub(crate) struct Looks {
    variation: Stream,
}

impl Looks {
    pub(crate) fn new() -> Self {
        Self { variation: Seed(0).stream("render/variation") }
    }

    /// The look of an entity that is drawn as its asset's model.
    pub(crate) fn of_model(&self, entity: &EntityRef<'_>) -> Look {
        let color = entity.info.color.unwrap_or([1.0; 3]);
        Look { unit: 1.0, color, ..self.plain(entity) }
    }

    /// The look of an entity under the aspects that signals show.
    pub(crate) fn of(&self, entity: &EntityRef<'_>, signals: &[Aspect]) -> Look {
        let bits = self.bits(entity);
        let mut look = self.plain(entity);
        if matches!(look.mesh, MeshId::Cylinder | MeshId::Capsule | MeshId::Sphere) {
            look.unit = look.scale[0] * 0.5;
        }
        dress(&mut look, entity, signals, bits);
        if let Some(color) = entity.info.color {
            look.color = color;
        }
        look
    }

    fn bits(&self, entity: &EntityRef<'_>) -> u64 {
        self.variation.indexed(entity.id.into()).seed().0
    }

    /// Its solid in grey.
    fn plain(&self, entity: &EntityRef<'_>) -> Look {
        let size = entity.info.shape.size();
        Look {
            mesh: primitive(&entity.info.shape),
            scale: [size.x as f32, size.y as f32, size.z as f32],
            unit: 1.0,
            color: [0.5; 3],
            second: [0.25; 3],
            seed: (self.bits(entity) >> 40) as f32 / (1_u32 << 24) as f32,
            state: 0.0,
            param: 0.0,
            reach: 0.0,
        }
    }
}

fn primitive(shape: &Shape) -> MeshId {
    match shape {
        Shape::Cylinder { .. } => MeshId::Cylinder,
        Shape::Capsule { .. } => MeshId::Capsule,
        Shape::Sphere { .. } => MeshId::Sphere,
        _ => MeshId::Cuboid,
    }
}

/// One of the entries, by some of the bits.
fn pick<T: Copy, const N: usize>(entries: &[T; N], bits: u64) -> T {
    entries[(bits % N as u64) as usize]
}

fn dress(look: &mut Look, entity: &EntityRef<'_>, signals: &[Aspect], bits: u64) {
    match entity.kind {
        EntityKind::Building => building(look, entity, bits),
        EntityKind::Tree => tree(look, bits),
        EntityKind::Shrub => *look = Look { mesh: MeshId::Shrub, color: pick(&LEAVES, bits), ..fitted(look) },
        EntityKind::Person => person(look, entity, bits),
        EntityKind::StreetLamp => {
            *look = Look {
                mesh: MeshId::Lamp,
                color: [0.05, 0.06, 0.06],
                reach: f64::from(LAMP_REACH),
                ..metric(look)
            };
        }
        EntityKind::TrafficSignal => signal(look, entity, signals),
        EntityKind::Sign => {
            let color = pick(&[[0.02, 0.08, 0.4], [0.5, 0.02, 0.02], [0.02, 0.08, 0.4]], bits);
            *look = Look { mesh: MeshId::Sign, color, reach: 0.4, ..metric(look) };
        }
        kind if kind.is_vehicle() => vehicle(look, kind, bits),
        kind => furniture(look, kind, bits),
    }
}

/// Offsets in metres.
fn metric(look: &Look) -> Look {
    Look { unit: 1.0, ..*look }
}

/// Offsets in heights, with the box as wide as the solid.
fn fitted(look: &Look) -> Look {
    Look { unit: look.scale[0].max(look.scale[1]).max(look.scale[2] * 0.8), ..*look }
}

fn building(look: &mut Look, entity: &EntityRef<'_>, bits: u64) {
    let size = entity.info.shape.size();
    let place = entity.info.place;
    let home = matches!(place, Some(Place::Home));
    let pitched = size.z <= HOUSE_HEIGHT && (home || place.is_none()) && size.z > 3.5;
    let storeys = entity.info.attributes.get("storeys").and_then(simworld_core::value::Value::as_i64);
    look.param = storeys.filter(|count| (1..200).contains(count)).unwrap_or(0) as f32;
    if !matches!(entity.info.shape, Shape::Box { .. }) {
        // Facades are laid out on boxes.
        look.color = pick(&WALLS, bits);
        return;
    }
    look.mesh = if pitched { MeshId::House } else { MeshId::Block };
    look.unit = 1.0;
    look.color = pick(&WALLS, bits);
    look.second = if pitched { pick(&ROOFS, bits >> 8) } else { GRAVEL };
    look.state = match place {
        _ if pitched => 2.0,
        Some(Place::Store | Place::Restaurant) => 1.0,
        _ => 0.0,
    };
}

fn tree(look: &mut Look, bits: u64) {
    let [x, y, z] = look.scale;
    // A thin solid is the trunk alone; a wide one holds the crown.
    let crown = if x.max(y) > 0.3 * z { x.max(y) * 0.5 } else { CROWN_RADIUS * z };
    look.mesh = if bits.is_multiple_of(4) { MeshId::Slender } else { MeshId::Broadleaf };
    look.unit = (crown / CROWN_RADIUS).min(z * 1.4).max(z);
    look.color = pick(&LEAVES, bits >> 8);
    look.reach = f64::from(crown) * 1.2;
}

fn person(look: &mut Look, entity: &EntityRef<'_>, bits: u64) {
    let seated = entity.attachment.is_some_and(|bond| matches!(bond.role, Role::Seated | Role::Aboard));
    let walking = entity.twist.ground_speed() > WALKING_SPEED;
    look.mesh = match (seated, walking) {
        (true, _) => MeshId::Sitting,
        (false, true) => MeshId::Walking,
        (false, false) => MeshId::Standing,
    };
    look.unit = look.scale[2];
    look.color = pick(&CLOTHES, bits);
    look.second = pick(&TROUSERS, bits >> 16);
    look.reach = 0.6;
}

fn signal(look: &mut Look, entity: &EntityRef<'_>, signals: &[Aspect]) {
    let group = entity.info.attributes.get("signal_group").and_then(simworld_core::value::Value::as_i64);
    let aspect = group.and_then(|group| usize::try_from(group).ok()).and_then(|group| signals.get(group));
    look.state = match aspect {
        Some(Aspect::Red) => 1.0,
        Some(Aspect::Yellow) => 2.0,
        Some(Aspect::Green) => 3.0,
        None => 0.0,
    };
    *look = Look { mesh: MeshId::Signal, reach: 0.5, ..metric(look) };
}

fn vehicle(look: &mut Look, kind: EntityKind, bits: u64) {
    let paint = pick(&PAINT, bits >> 4);
    let (mesh, color, second) = match kind {
        EntityKind::Bus => {
            (MeshId::Bus, pick(&[[0.62, 0.05, 0.04], [0.03, 0.14, 0.4], [0.7, 0.5, 0.05]], bits), paint)
        }
        EntityKind::Truck => (MeshId::Truck, paint, [0.72, 0.72, 0.7]),
        EntityKind::Motorcycle => (MeshId::Motorcycle, paint, paint),
        EntityKind::Bicycle => (MeshId::Bicycle, pick(&CLOTHES, bits), paint),
        EntityKind::Scooter => (MeshId::Scooter, pick(&[[0.12, 0.55, 0.12], [0.8, 0.25, 0.02]], bits), paint),
        _ => (if bits & 1 == 0 { MeshId::Sedan } else { MeshId::Hatchback }, paint, paint),
    };
    *look = Look { mesh, color, second, reach: 0.1, ..metric(look) };
}

fn furniture(look: &mut Look, kind: EntityKind, bits: u64) {
    let round = |look: &Look, mesh| Look { mesh, unit: look.scale[0] * 0.5, ..*look };
    let (made, color, second) = match kind {
        EntityKind::Ground => (Look { mesh: MeshId::Ground, ..metric(look) }, [0.15, 0.19, 0.085], [0.2; 3]),
        EntityKind::Road => (Look { mesh: MeshId::Road, ..metric(look) }, [0.072, 0.074, 0.08], [0.2; 3]),
        EntityKind::Sidewalk => {
            (Look { mesh: MeshId::Sidewalk, ..metric(look) }, [0.36, 0.35, 0.33], [0.2; 3])
        }
        EntityKind::Crosswalk => {
            (Look { mesh: MeshId::Crosswalk, ..metric(look) }, [0.072, 0.074, 0.08], [0.2; 3])
        }
        EntityKind::Bench => (Look { mesh: MeshId::Bench, ..metric(look) }, [0.3, 0.15, 0.06], [0.2; 3]),
        EntityKind::Chair => (Look { mesh: MeshId::Chair, ..metric(look) }, pick(&CLOTHES, bits), [0.2; 3]),
        EntityKind::Table => (Look { mesh: MeshId::Table, ..metric(look) }, [0.5, 0.45, 0.38], [0.2; 3]),
        EntityKind::TrashBin => (round(look, MeshId::TrashBin), [0.05, 0.14, 0.07], [0.03, 0.03, 0.035]),
        EntityKind::Mailbox => {
            (Look { mesh: MeshId::Mailbox, ..metric(look) }, [0.62, 0.4, 0.03], [0.03, 0.03, 0.035])
        }
        EntityKind::Hydrant => (round(look, MeshId::Hydrant), [0.55, 0.03, 0.02], [0.6, 0.35, 0.03]),
        EntityKind::Cone => (round(look, MeshId::Cone), [0.8, 0.16, 0.01], [0.2; 3]),
        EntityKind::BusStop => (Look { mesh: MeshId::BusStop, ..metric(look) }, [0.1, 0.16, 0.2], [0.2; 3]),
        EntityKind::Parcel => {
            (Look { mesh: MeshId::Parcel, ..metric(look) }, [0.42, 0.26, 0.12], [0.62, 0.48, 0.28])
        }
        EntityKind::Dog => {
            let coat = pick(&[[0.25, 0.14, 0.06], [0.05, 0.04, 0.035], [0.5, 0.38, 0.22]], bits);
            (Look { mesh: MeshId::Dog, reach: 0.1, ..metric(look) }, coat, coat.map(|channel| channel * 0.5))
        }
        EntityKind::Robot => {
            (Look { mesh: MeshId::Robot, ..metric(look) }, [0.72, 0.73, 0.75], [0.85, 0.3, 0.02])
        }
        // A prop is its solid.
        _ => (*look, pick(&[[0.45, 0.42, 0.38], [0.3, 0.36, 0.42], [0.5, 0.36, 0.25]], bits), [0.2; 3]),
    };
    *look = Look { color, second, ..made };
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::{Point3, pose_facing};
    use simworld_core::scene::{EntityDesc, Scene, World};

    use super::*;

    fn look_of(desc: EntityDesc, signals: &[Aspect]) -> Look {
        let mut world = World::new();
        let id = world.spawn(desc).unwrap();
        Looks::new().of(&world.entity(id).unwrap(), signals)
    }

    fn at_origin(kind: EntityKind, shape: Shape) -> EntityDesc {
        EntityDesc::new(kind, pose_facing(Point3::origin(), 0.0), shape)
    }

    #[test]
    fn every_kind_has_a_look_of_finite_size() {
        for kind in EntityKind::ALL {
            for shape in [Shape::cuboid(2.0, 1.0, 1.5), Shape::Capsule { radius: 0.3, height: 1.8 }] {
                let look = look_of(at_origin(*kind, shape), &[]);
                assert!(look.unit.is_finite() && look.unit > 0.0, "{kind}");
                assert!((0.0..1.0).contains(&look.seed), "{kind}");
            }
        }
    }

    #[test]
    fn a_signal_shows_its_group_only_if_it_has_one() {
        let post = || at_origin(EntityKind::TrafficSignal, Shape::Cylinder { radius: 0.1, height: 3.5 });
        let aspects = [Aspect::Red, Aspect::Green];
        assert_eq!(look_of(post(), &aspects).state, 0.0);
        assert_eq!(look_of(post().with("signal_group", 1), &aspects).state, 3.0);
        assert_eq!(look_of(post().with("signal_group", 9), &aspects).state, 0.0);
        assert_eq!(look_of(post().with("signal_group", -1), &aspects).state, 0.0);
    }

    #[test]
    fn a_given_colour_is_kept() {
        let car = at_origin(EntityKind::Car, Shape::cuboid(4.0, 1.8, 1.5)).colored([0.1, 0.2, 0.3]);
        assert_eq!(look_of(car, &[]).color, [0.1, 0.2, 0.3]);
    }
}
