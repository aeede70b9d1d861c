//! What has two sides is seen, lit and throws shadows on both, as two surfaces would that are laid on one another; alike by triangles and by rays.

use crate::common::models::{add, leaf};
use crate::common::{put, renderer};
use simworld_core::asset::{Asset, Model, ModelImage, Transparency};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Scene, Shape, World};
use simworld_render::{Backend, Channels, RenderConfig, Renderer, ViewOptions, Views};

const EAST: f64 = std::f64::consts::FRAC_PI_2;
const WEST: f64 = -EAST;

fn backends() -> Option<[Renderer; 2]> {
    let with = |backend| renderer(&RenderConfig { backend, ..RenderConfig::default() });
    Some([with(Backend::Raster)?, with(Backend::Raycast)?])
}

/// Green, and not there in its lower right quarter where that is cut out.
fn image() -> ModelImage {
    let alpha = (0..64_u32).map(|k| if k % 8 >= 4 && k / 8 >= 4 { 0 } else { 255 }).collect();
    ModelImage { width: 8, height: 8, pixels: [20, 160, 40].repeat(64), alpha, ..ModelImage::default() }
}

fn one_sided(_: &mut Model) {}

fn two_sided(model: &mut Model) {
    model.parts[0].two_sided = true;
}

/// The same by hand: every triangle once more, the other way round.
fn doubled(model: &mut Model) {
    let count = model.vertices.len() as u32;
    let backs = model.vertices.clone();
    model.vertices.extend(backs.into_iter().map(|mut vertex| {
        vertex.normal = vertex.normal.map(|part| -part);
        vertex
    }));
    let backs: Vec<_> = model.triangles.iter().map(|[a, b, c]| [a + count, c + count, b + count]).collect();
    model.triangles.extend(backs);
    model.parts[0].triangles *= 2;
}

fn leaf_of(sides: fn(&mut Model), transparency: Transparency) -> Asset {
    leaf(image(), |model| {
        sides(model);
        model.parts[0].transparency = transparency;
    })
}

/// A leaf over the ground under a sun at that azimuth, north being 0 and east a quarter of a turn.
fn scene(asset: &Asset, azimuth: f64) -> (World, EntityId) {
    let mut world = World::new();
    put(&mut world, EntityKind::Prop, [5.0, 0.0, -3.0], 0.0, Shape::cuboid(30.0, 30.0, 1.0));
    let mut environment = *world.environment();
    (environment.sun.azimuth, environment.sun.elevation) = (azimuth, 0.8);
    environment.weather.cloud_cover = 0.0;
    world.set_environment(environment).expect("a sun in range");
    let id = add(&mut world, asset, [5.0, 0.0, -1.0]);
    (world, id)
}

fn all(renderer: &mut Renderer, world: &World, camera: &Camera) -> Views {
    let options = ViewOptions { channels: Channels::all(), ..ViewOptions::default() };
    let mut views = Views::new();
    renderer.render_views(world, &[(*camera).into()], &options, &mut views).expect("it is drawn");
    views
}

/// From the back of the leaf, which faces west, and from its front.
fn cameras() -> [Camera; 2] {
    let intrinsics = Intrinsics::from_fov(120, 120, 0.6).expect("a size in range");
    [(0.0, 0.0), (10.0, std::f64::consts::PI)]
        .map(|(x, yaw)| Camera::looking_along(&pose_facing(Point3::new(x, 0.0, 0.0), yaw), intrinsics))
}

/// Mean green of the pixels of an entity, and how many there are.
fn seen_of(views: &Views, id: EntityId) -> (f64, usize) {
    let number = id.index() as u32 + 1;
    let pixels = views.rgb.as_chunks::<3>().0.iter().zip(&views.ids);
    let greens: Vec<f64> = pixels
        .filter(|(_, id)| **id & 0xff_ffff == number)
        .map(|([_, green, _], _)| f64::from(*green))
        .collect();
    (greens.iter().sum::<f64>() / greens.len().max(1) as f64, greens.len())
}

#[test]
fn two_sides_are_seen_as_two_surfaces_would_be() {
    let Some(renderers) = backends() else { return };
    for mut renderer in renderers {
        for transparency in [Transparency::Opaque, Transparency::Cutout { cutoff: 0.5 }] {
            let [both, by_hand] = [two_sided, doubled].map(|sides| leaf_of(sides, transparency));
            for camera in cameras() {
                let (world, id) = scene(&both, EAST);
                let [got, wanted] =
                    [&world, &scene(&by_hand, EAST).0].map(|world| all(&mut renderer, world, &camera));
                assert!(seen_of(&got, id).1 > 3000, "{} pixels of it", seen_of(&got, id).1);
                assert!(got.ids == wanted.ids && got.depth == wanted.depth, "{transparency:?}");
                assert!(got.normals == wanted.normals && got.rgb == wanted.rgb, "{transparency:?}");
            }
        }
    }
}

/// Whoever has one side has no back; and of two sides that is brighter which the sun shines on.
#[test]
fn each_side_has_its_own_light() {
    let Some(renderers) = backends() else { return };
    let [back, front] = cameras();
    for mut renderer in renderers {
        let (world, id) = scene(&leaf_of(one_sided, Transparency::Opaque), EAST);
        assert!(seen_of(&all(&mut renderer, &world, &back), id).1 > 3000);
        assert_eq!(seen_of(&all(&mut renderer, &world, &front), id).1, 0);
        for (azimuth, lit, dark) in [(EAST, front, back), (WEST, back, front)] {
            let (world, id) = scene(&leaf_of(two_sided, Transparency::Opaque), azimuth);
            let [lit, dark] = [lit, dark].map(|camera| seen_of(&all(&mut renderer, &world, &camera), id));
            assert_eq!(lit.1, dark.1, "both sides have the same pixels");
            assert!(lit.0 > 1.3 * dark.0, "{azimuth}: {lit:?} {dark:?}");
        }
    }
}

/// How bright the ground is in the middle of the shadow of the leaf.
fn ground_in_shadow(renderer: &mut Renderer, asset: Option<&Asset>, azimuth: f64) -> f64 {
    let (mut world, id) = scene(asset.unwrap_or(&leaf_of(one_sided, Transparency::Opaque)), azimuth);
    if asset.is_none() {
        world.remove(id).expect("it is there");
    }
    let towards = world.environment().sun.direction();
    let middle = Point3::new(5.0, 0.0, 0.0);
    let shadow = middle - towards * ((middle.z + 2.0) / towards.z);
    let intrinsics = Intrinsics::from_fov(40, 40, 0.2).expect("a size in range");
    let camera =
        Camera::looking_at(shadow + simworld_core::geometry::Vector3::new(0.1, 5.0, 4.0), shadow, intrinsics);
    let views = all(renderer, &world, &camera);
    f64::from(views.rgb[(20 * 40 + 20) * 3 + 1])
}

#[test]
fn both_sides_throw_shadows() {
    let Some(renderers) = backends() else { return };
    let both = leaf_of(two_sided, Transparency::Opaque);
    for mut renderer in renderers {
        for azimuth in [EAST, WEST] {
            let [open, shaded] =
                [None, Some(&both)].map(|asset| ground_in_shadow(&mut renderer, asset, azimuth));
            assert!(shaded < 0.75 * open, "{azimuth}: {shaded} of {open}");
        }
    }
}
