//! How a kind of entity looks: its rigid parts, their meshes, sizes and colours, with deterministic variation by id.

mod afar;
mod buildings;
mod creatures;
mod detail;
#[cfg(test)]
mod library_tests;
mod links;
mod people;
mod posture;
mod riders;
mod street;
mod things;
mod trees;
mod vehicles;

use simworld_core::asset::Finish;
use simworld_core::geometry::Pose;
use simworld_core::id::AssetId;
use simworld_core::net::Aspect;
use simworld_core::scene::{EntityKind, EntityRef, Scene, Shape};
use simworld_core::seed::{Seed, Stream};

use crate::mesh::{Drawn, MeshId, ModelId, Pattern};
use crate::resident;
use crate::sources::{LinkModels, Source, model_of};
pub(crate) use detail::{Detail, comes_in_levels};
use street::Streets;
pub(crate) use street::mark_layer;

/// What dresses a kind of entity: the entity, its scene, its plain look, the bits of its variation, the level of detail, and
/// where the parts go.
type Dresser = fn(&EntityRef<'_>, &dyn Scene, &Look, u64, Detail, &mut Vec<Part>);

/// How far one of that kind may reach beyond the ball around its solid, m: crowns, arms of lamps, riders, awnings.
pub(crate) const fn overhang(kind: EntityKind) -> f64 {
    match kind {
        EntityKind::Tree => 8.0,
        EntityKind::Building => 2.5,
        EntityKind::StreetLamp => 1.7,
        EntityKind::Ground | EntityKind::Road | EntityKind::Sidewalk | EntityKind::Crosswalk => 0.0,
        _ => 0.8,
    }
}

/// A rigid part of an entity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Part {
    pub look: Look,
    /// Body from part.
    pub place: Pose,
}

/// Everything about the look of one part but its pose.
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
    /// pitched roof. Roads: 1 if the network says what is painted on them; marks on roads: see `street`.
    pub state: f32,
    /// Buildings: storeys. Marks on roads: see `street`. Things: see [`made_of`].
    pub param: f32,
}

/// Draws the variation of entities: the same id looks the same in every picture.
pub(crate) struct Looks {
    variation: Stream,
    streets: Streets,
    links: LinkModels,
}

impl Default for Looks {
    fn default() -> Self {
        Self {
            variation: Seed(0).stream("render/variation"),
            streets: Streets::default(),
            links: LinkModels::default(),
        }
    }
}

impl Looks {
    /// Follows what a scene says of its streets; true if that is something else than before.
    pub(crate) fn follow(&mut self, scene: &dyn Scene) -> bool {
        self.streets.follow(scene)
    }

    /// Dresses an entity: its rigid parts at some levels of detail, by their [bits](Detail::bit); those of whom [comes in none](comes_in_levels) are
    /// all there whatever was asked for. What is the same at several levels stands there once.
    pub(crate) fn dress(
        &self,
        entity: &EntityRef<'_>,
        scene: &dyn Scene,
        levels: u8,
        out: &mut Vec<resident::Part>,
    ) {
        let whole = |mesh, look| resident::Part { mesh, pose: *entity.pose, look, details: Detail::EVERY };
        if let Some(links) = scene.links(entity.id) {
            return self.articulated(entity, &links, out);
        }
        let modelled = entity.info.asset.and_then(|id| Some((id, model_of(scene, id)?)));
        if let Some((id, (asset, model))) = modelled {
            let posed = ModelId::of(entity, id, (asset, model), scene);
            return out.push(whole(Drawn::Model(posed), self.of_model(entity, id)));
        }
        let bits = self.bits(entity);
        let dresser: Dresser = match entity.kind {
            EntityKind::Person => people::dress,
            EntityKind::Building => buildings::dress,
            EntityKind::Dog => creatures::dress,
            EntityKind::Tree => trees::dress,
            kind if kind.is_vehicle() => vehicles::dress,
            _ => {
                let mut look = self.of(entity, scene.signals());
                if entity.kind == EntityKind::Shrub {
                    look.color = trees::shrub_color(entity, scene, bits);
                }
                if let Some(mesh) = asset_name(entity, scene).and_then(things::named) {
                    let second = pick(&people::CLOTHES, bits >> 12);
                    look = Look { mesh, second, ..metric(&look) };
                }
                made_of(&mut look, entity, scene);
                let surface = out.len();
                out.push(whole(Drawn::Own(look.mesh), look));
                self.streets.dress(entity, scene, &mut look, out);
                out[surface].look = look;
                return;
            }
        };
        let plain = self.plain(entity);
        let mut parts = Vec::new();
        for detail in Detail::ALL.into_iter().filter(|detail| levels & detail.bit() != 0) {
            parts.clear();
            dresser(entity, scene, &plain, bits, detail, &mut parts);
            let known = out.len();
            for Part { look, place } in &parts {
                let pose = entity.pose * place;
                let twin = out[..known].iter_mut().find(|other| other.look == *look && other.pose == pose);
                match twin {
                    Some(twin) => twin.details |= detail.bit(),
                    None => out.push(resident::Part {
                        mesh: Drawn::Own(look.mesh),
                        pose,
                        look: *look,
                        details: detail.bit(),
                    }),
                }
            }
        }
    }

    /// The look of an entity that is drawn as its asset's model.
    fn of_model(&self, entity: &EntityRef<'_>, asset: AssetId) -> Look {
        let color = entity.info.color.unwrap_or([1.0; 3]);
        as_model(Source::Asset(asset), Look { color, ..self.plain(entity) })
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
        }
    }
}

/// How the body of a thing takes light, by what it is made of, as materials.wgsl reads it: its roughness, and 2 more where it is bare metal; 0,
/// which is dull, where nobody knows what it is made of. A prop of nobody's colour is grey, as light as its material. Patterns have another
/// parameter, and paint themselves.
fn made_of(look: &mut Look, entity: &EntityRef<'_>, scene: &dyn Scene) {
    let material = entity.material(scene).filter(|_| look.mesh.pattern() == Pattern::Plain);
    let Some(material) = material else { return };
    if entity.kind == EntityKind::Prop && entity.info.color.is_none() {
        look.color = [material.reflectance() as f32; 3];
    }
    let finish = Finish::of(material, look.color);
    look.param = finish.roughness + 2.0 * finish.metallic;
}

/// The look of what is drawn as a model: by where that comes from shaders find how its parts take light. What stands where other meshes have
/// their offsets is none, so their unit is zero.
fn as_model(source: Source, look: Look) -> Look {
    Look { unit: 0.0, second: [source.head() as f32, 0.0, 0.0], ..look }
}

fn primitive(shape: &Shape) -> MeshId {
    match shape {
        Shape::Cylinder { .. } => MeshId::Cylinder,
        Shape::Capsule { .. } => MeshId::Capsule,
        Shape::Sphere { .. } => MeshId::Sphere,
        _ => MeshId::Cuboid,
    }
}

/// What the asset of an entity is called, if it has one.
pub(crate) fn asset_name<'a>(entity: &EntityRef<'_>, scene: &'a dyn Scene) -> Option<&'a str> {
    Some(&scene.assets()?.get(entity.info.asset?)?.name)
}

/// The colour that an entity was given; none where it only has that of an asset whose likes come in many colours.
fn own_color(entity: &EntityRef<'_>, scene: &dyn Scene) -> Option<[f32; 3]> {
    const VARIED: [&str; 14] = [
        "person",
        "man",
        "woman",
        "child",
        "girl",
        "boy",
        "teenager",
        "elderly_person",
        "tourist",
        "student",
        "car",
        "small_car",
        "suv",
        "bicycle",
    ];
    let color = entity.info.color?;
    let Some(asset) = scene.assets().and_then(|assets| assets.get(entity.info.asset?)) else {
        return Some(color);
    };
    let plain = asset.color == Some(color) && VARIED.contains(&asset.name.as_str());
    (!plain).then_some(color)
}

/// How far along its heading an entity has come, m: grows as it goes on, and is the same in every run.
///
/// Reckoned from the middle of a cell of the ground, so that a turn of the heading changes it little.
fn way(entity: &EntityRef<'_>) -> f64 {
    const CELL: f64 = 16.0;
    let ahead = entity.pose.rotation * simworld_core::geometry::Vector3::x();
    let at = entity.position();
    let within = |x: f64| x - (x / CELL).round() * CELL;
    within(at.x) * ahead.x + within(at.y) * ahead.y
}

/// One of the entries, by some of the bits.
fn pick<T: Copy, const N: usize>(entries: &[T; N], bits: u64) -> T {
    entries[(bits % N as u64) as usize]
}

fn dress(look: &mut Look, entity: &EntityRef<'_>, signals: &[Aspect], bits: u64) {
    match entity.kind {
        EntityKind::Shrub => *look = Look { mesh: MeshId::Shrub, ..fitted(look) },
        EntityKind::StreetLamp => {
            *look = Look { mesh: MeshId::Lamp, color: [0.05, 0.06, 0.06], ..metric(look) };
        }
        EntityKind::TrafficSignal => signal(look, entity, signals),
        EntityKind::Sign => {
            let color = pick(&[[0.02, 0.08, 0.4], [0.5, 0.02, 0.02], [0.02, 0.08, 0.4]], bits);
            *look = Look { mesh: MeshId::Sign, color, ..metric(look) };
        }
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

/// What the group of a signal shows now.
pub(crate) fn aspect_of<'a>(entity: &EntityRef<'_>, signals: &'a [Aspect]) -> Option<&'a Aspect> {
    let group = entity.info.attributes.get("signal_group").and_then(simworld_core::value::Value::as_i64);
    group.and_then(|group| usize::try_from(group).ok()).and_then(|group| signals.get(group))
}

fn signal(look: &mut Look, entity: &EntityRef<'_>, signals: &[Aspect]) {
    look.state = match aspect_of(entity, signals) {
        Some(Aspect::Red) => 1.0,
        Some(Aspect::Yellow) => 2.0,
        Some(Aspect::Green) => 3.0,
        None => 0.0,
    };
    *look = Look { mesh: MeshId::Signal, ..metric(look) };
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
        EntityKind::Chair => {
            (Look { mesh: MeshId::Chair, ..metric(look) }, pick(&people::CLOTHES, bits), [0.2; 3])
        }
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
        EntityKind::Robot => {
            (Look { mesh: MeshId::Robot, ..metric(look) }, [0.72, 0.73, 0.75], [0.85, 0.3, 0.02])
        }
        EntityKind::Door => {
            (Look { mesh: MeshId::Door, ..metric(look) }, [0.2, 0.09, 0.04], [0.15, 0.07, 0.03])
        }
        // A prop is its solid.
        _ => (*look, pick(&[[0.45, 0.42, 0.38], [0.3, 0.36, 0.42], [0.5, 0.36, 0.25]], bits), [0.2; 3]),
    };
    *look = Look { color, second, ..made };
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::{Point3, pose_facing};
    use simworld_core::links::LinkForm;
    use simworld_core::scene::{EntityDesc, Scene, World};

    use super::*;

    fn look_of(desc: EntityDesc, signals: &[Aspect]) -> Look {
        let mut world = World::new();
        let id = world.spawn(desc).unwrap();
        Looks::default().of(&world.entity(id).unwrap(), signals)
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

    fn parts_of(kind: EntityKind, shape: Shape) -> Vec<resident::Part> {
        let mut world = World::new();
        let id = world.spawn(at_origin(kind, shape)).unwrap();
        let mut parts = Vec::new();
        Looks::default().dress(&world.entity(id).unwrap(), &world, Detail::EVERY, &mut parts);
        parts
    }

    /// Only what is a box is drawn as one.
    #[test]
    fn every_kind_but_a_prop_has_a_mesh_of_its_own() {
        let solids = [MeshId::Cuboid, MeshId::Cylinder, MeshId::Capsule, MeshId::Sphere];
        for kind in EntityKind::ALL.iter().filter(|kind| **kind != EntityKind::Prop) {
            let parts = parts_of(*kind, Shape::cuboid(2.0, 1.0, 1.5));
            let plain = parts.iter().any(|part| solids.contains(&part.look.mesh));
            assert!(!parts.is_empty() && !plain, "{kind}");
        }
    }

    /// From level to level there are no more triangles, and few are left for some pixels.
    #[test]
    fn farther_away_there_are_fewer_triangles() {
        let library = crate::mesh::MeshLibrary::build();
        let (tall, car) = (Shape::Capsule { radius: 0.25, height: 1.8 }, Shape::cuboid(4.5, 1.8, 1.5));
        let mut wrong = Vec::new();
        for (kind, shape) in [
            (EntityKind::Person, tall),
            (EntityKind::Car, car),
            (EntityKind::Truck, Shape::cuboid(8.0, 2.5, 3.2)),
            (EntityKind::Bus, Shape::cuboid(12.0, 2.5, 3.1)),
            (EntityKind::Bicycle, Shape::cuboid(1.75, 0.6, 1.1)),
            (EntityKind::Dog, Shape::cuboid(0.8, 0.3, 0.6)),
            (EntityKind::Tree, Shape::Cylinder { radius: 0.2, height: 8.0 }),
            (EntityKind::Building, Shape::cuboid(14.0, 18.0, 17.0)),
        ] {
            let parts = parts_of(kind, shape);
            let [far, middle, near] = Detail::ALL.map(|detail| {
                let drawn = parts.iter().filter(|part| part.details & detail.bit() != 0);
                drawn.map(|part| library.ranges[part.look.mesh as usize].len() / 3).sum::<usize>()
            });
            if far == 0 || far > 320 || far >= near || far > middle || middle > near {
                wrong.push(format!("{kind}: {far}, {middle}, {near}"));
            }
        }
        assert!(wrong.is_empty(), "triangles far, between and near: {wrong:?}");
    }

    /// What has links is drawn as these, each where it is, in its own form and colour.
    #[test]
    fn instances_are_where_links_are() {
        let mut world = World::new();
        let pose = pose_facing(Point3::new(4.0, -2.0, 1.0), 0.6);
        let id = world.spawn(EntityDesc::new(EntityKind::Robot, pose, Shape::cuboid(1.0, 1.0, 1.0))).unwrap();
        let forms: std::sync::Arc<[LinkForm]> = std::sync::Arc::from([
            LinkForm::solid(Shape::Cylinder { radius: 0.1, height: 0.4 }, Some([0.1, 0.2, 0.3])),
            LinkForm::solid(Shape::Sphere { radius: 0.2 }, None),
            LinkForm::solid(Shape::cuboid(0.5, 0.1, 0.2), None),
        ]);
        let links = [0.3, 0.9, 1.4].map(|x| pose_facing(Point3::new(x, 0.1, 0.5 * x), 2.0 * x));
        world.set_links(id, &forms, &links).unwrap();
        let mut parts = Vec::new();
        Looks::default().dress(&world.entity(id).unwrap(), &world, Detail::EVERY, &mut parts);
        let meshes: Vec<MeshId> = parts.iter().map(|part| part.look.mesh).collect();
        assert_eq!(meshes, [MeshId::Cylinder, MeshId::Sphere, MeshId::Cuboid]);
        for (part, link) in parts.iter().zip(&links) {
            assert!((part.pose.to_homogeneous() - (pose * link).to_homogeneous()).norm() < 1e-12);
            assert_eq!(part.details, Detail::EVERY);
        }
        assert_eq!(parts[0].look.color, [0.1, 0.2, 0.3]);
        assert_eq!(parts[2].look.scale, [0.5, 0.1, 0.2]);
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
        let bin = at_origin(EntityKind::TrashBin, Shape::cuboid(0.4, 0.4, 1.0)).colored([0.1, 0.2, 0.3]);
        assert_eq!(look_of(bin, &[]).color, [0.1, 0.2, 0.3]);
    }
}
