//! What is cut out of models is not there: not in colour, depth, ids and normals, for beams of scanners and for the sun; alike by triangles and by rays.

use std::sync::{Arc, Mutex};

use crate::common::models::{add, ball, card};
use crate::common::{put, renderer};
use simworld_core::asset::{Asset, Finish, ModelImage, ModelPart, Transparency, Wrap, light_of};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Scene, Shape, World};
use simworld_core::seam::Observer;
use simworld_render::{
    AntiAliasing, Backend, BeamTable, Channels, Lidar, LidarConfig, LidarMethod, PointCloud, RenderConfig,
    Renderer, ViewOptions, Views,
};

const SIDE: u32 = 120;
const WHOLE: [[f32; 2]; 2] = [[0.0, 0.0], [1.0, 1.0]];

fn backends() -> Option<[Renderer; 2]> {
    let with = |backend| renderer(&RenderConfig { backend, ..RenderConfig::default() });
    Some([with(Backend::Raster)?, with(Backend::Raycast)?])
}

/// Green, and not there within half of its side around its middle; what is not there is red.
fn ring(side: u32) -> ModelImage {
    picture(side, |x, y| (x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5) > 0.0625)
}

/// Green where something is there, and red where it is not.
fn picture(side: u32, is_there: impl Fn(f64, f64) -> bool) -> ModelImage {
    let mut image = ModelImage { width: side, height: side, ..ModelImage::default() };
    for k in 0..side * side {
        let [x, y] = [k % side, k / side].map(|at| (f64::from(at) + 0.5) / f64::from(side));
        let (color, alpha) = if is_there(x, y) { ([10, 160, 10], 255) } else { ([160, 10, 10], 0) };
        image.pixels.extend(color);
        image.alpha.push(alpha);
    }
    image
}

fn cutout(part: &mut ModelPart) {
    part.transparency = Transparency::Cutout { cutoff: 0.5 };
}

fn opaque(_: &mut ModelPart) {}

fn camera() -> Camera {
    let intrinsics = Intrinsics::from_fov(SIDE, SIDE, 0.5).expect("a size in range");
    Camera::looking_along(&pose_facing(Point3::origin(), 0.0), intrinsics)
}

/// A card before a wall and a ball; who they are.
fn scene(asset: &Asset) -> (World, [EntityId; 3]) {
    let mut world = World::new();
    let card = add(&mut world, asset, [5.0, 0.0, -1.0]);
    let wall = put(&mut world, EntityKind::Prop, [9.0, 0.0, -4.0], 0.0, Shape::cuboid(1.0, 12.0, 8.0));
    let ball = add(&mut world, &ball([0.2; 3], Finish::default()), [7.0, 0.6, -0.9]);
    (world, [card, wall, ball])
}

fn all(renderer: &mut Renderer, world: &World, camera: &Camera) -> Views {
    let options = ViewOptions { channels: Channels::all(), ..ViewOptions::default() };
    let mut views = Views::new();
    renderer.render_views(world, &[(*camera).into()], &options, &mut views).expect("it is drawn");
    views
}

fn slots(views: &Views) -> Vec<u32> {
    views.ids.iter().map(|id| id & 0xff_ffff).collect()
}

#[test]
fn through_a_hole_everything_behind_is_seen() {
    let Some(renderers) = backends() else { return };
    let (world, [card, wall, ball]) = scene(&self::card(ring(64), WHOLE, cutout));
    let mut without = world.clone();
    without.remove(card).expect("it is there");
    let whole = scene(&self::card(ring(64), WHOLE, opaque)).0;
    let number = |id: EntityId| id.index() as u32 + 1;
    let mut shown = Vec::new();
    for mut renderer in renderers {
        let [got, bare, full] = [&world, &without, &whole].map(|world| all(&mut renderer, world, &camera()));
        let (ids, behind) = (slots(&got), slots(&bare));
        let mut holes = 0;
        for (index, id) in ids.iter().enumerate() {
            let what = format!("at {} {}", index as u32 % SIDE, index as u32 / SIDE);
            if *id == number(card) {
                assert_eq!(
                    (got.depth[index], got.normals[index]),
                    (full.depth[index], full.normals[index]),
                    "{what}"
                );
                continue;
            }
            assert_eq!(*id, behind[index], "{what}");
            assert_eq!(
                (got.depth[index], got.normals[index]),
                (bare.depth[index], bare.normals[index]),
                "{what}"
            );
            holes += u32::from(full.ids[index] & 0xff_ffff == number(card));
        }
        // The hole is a disc of a quarter of the side of the card, and the card has so many pixels.
        let card_pixels = slots(&full).iter().filter(|id| **id == number(card)).count() as f64;
        let wanted = card_pixels * std::f64::consts::PI * 0.0625;
        assert!(
            (f64::from(holes) - wanted).abs() < 0.04 * wanted,
            "{holes} pixels of the hole, not {wanted}"
        );
        for who in [wall, ball] {
            assert!(ids.contains(&number(who)), "nothing of {who:?} is seen");
        }
        // Nothing of the red that is not there.
        let red = got.rgb.as_chunks::<3>().0.iter().filter(|[r, g, b]| *r > 2 * g.max(b)).count();
        assert_eq!(red, 0, "what is not there is seen");
        shown.push(got);
    }
    agree(&shown[0], &shown[1]);
}

/// Ids differ on a pixel in two thousand at most, and depth where they do not by a thousandth.
fn agree(a: &Views, b: &Views) {
    let differing = slots(a).iter().zip(slots(b)).filter(|(x, y)| **x != *y).count();
    println!("ids differ on {:.3} %", 100.0 * differing as f64 / a.ids.len() as f64);
    assert!(differing as f64 <= 5e-4 * a.ids.len() as f64, "{differing} ids differ");
    let depths = (0..a.ids.len()).filter(|at| a.ids[*at] == b.ids[*at]);
    let off = depths.filter(|at| (a.depth[*at] - b.depth[*at]).abs() > 1e-3 * a.depth[*at]).count();
    assert!(off as f64 <= 5e-4 * a.ids.len() as f64, "{off} depths differ");
}

/// Dots of many sizes, near and far, upright and at a slant, and the same pixels from a new renderer.
#[test]
fn both_backends_cut_alike() {
    let Some([mut raster, mut raycast]) = backends() else { return };
    let dots = picture(128, |x, y| {
        let [right, down] = [x, y].map(|at| (at * 8.0).fract() - 0.5);
        right * right + down * down < 0.16
    });
    for (distance, yaw) in [(3.0, 0.0), (5.0, 0.7), (9.0, 1.1), (25.0, 0.3)] {
        let mut world = World::new();
        let asset = card(dots.clone(), WHOLE, cutout);
        let id = world.add_asset(asset.clone()).expect("it is an asset");
        world.spawn(asset.at(id, pose_facing(Point3::new(distance, 0.0, -1.0), yaw))).expect("a solid");
        put(&mut world, EntityKind::Prop, [40.0, 0.0, -20.0], 0.0, Shape::cuboid(1.0, 60.0, 40.0));
        let views = [&mut raster, &mut raycast].map(|renderer| all(renderer, &world, &camera()));
        agree(&views[0], &views[1]);
        let Some([mut again, mut anew]) = backends() else { return };
        for (renderer, known) in [(&mut again, &views[0]), (&mut anew, &views[1])] {
            let other = all(renderer, &world, &camera());
            assert!(other.rgb == known.rgb && other.ids == known.ids && other.depth == known.depth);
        }
    }
}

/// Linear light of the pixel in which a point is seen.
fn light_at(views: &Views, camera: &Camera, point: Point3) -> f32 {
    let optical = camera.world_from_optical.inverse_transform_point(&point);
    let (pixel, _) = camera.intrinsics.project(&optical).expect("it is before the camera");
    let index = pixel.y as usize * camera.intrinsics.width as usize + pixel.x as usize;
    light_of(views.rgb[index * 3 + 1])
}

#[test]
fn a_shadow_has_the_hole_too() {
    let Some(renderers) = backends() else { return };
    let intrinsics = Intrinsics::from_fov(160, 160, 0.9).expect("a size in range");
    let camera = Camera::looking_at(Point3::new(-5.0, 0.0, 5.0), Point3::new(0.0, 0.0, 0.0), intrinsics);
    let scene = |card: Option<&Asset>| {
        let mut world = World::new();
        put(&mut world, EntityKind::Prop, [0.0, 0.0, -1.0], 0.0, Shape::cuboid(30.0, 30.0, 1.0));
        let mut environment = *world.environment();
        // From due east, which is ahead, so that the shadow falls this way.
        (environment.sun.azimuth, environment.sun.elevation) = (std::f64::consts::FRAC_PI_2, 0.8);
        environment.weather.cloud_cover = 0.0;
        world.set_environment(environment).expect("a sun in range");
        if let Some(card) = card {
            add(&mut world, card, [0.5, 0.0, 0.5]);
        }
        world
    };
    let towards = scene(None).environment().sun.direction();
    // Where the shadow falls of a point of the card, in shares of its side from the upper left corner.
    let shadow = |right: f64, down: f64| {
        let point = Point3::new(0.5, 1.0 - 2.0 * right, 2.5 - 2.0 * down);
        point - towards * (point.z / towards.z)
    };
    let cards = [Some(card(ring(64), WHOLE, cutout)), Some(card(ring(64), WHOLE, opaque)), None];
    for mut renderer in renderers {
        let [cut, full, none] =
            cards.each_ref().map(|card| all(&mut renderer, &scene(card.as_ref()), &camera));
        for (right, down, is_lit) in [
            (0.5, 0.5, true),
            (0.4, 0.5, true),
            (0.5, 0.36, true),
            (0.1, 0.5, false),
            (0.9, 0.5, false),
            (0.5, 0.12, false),
            (0.2, 0.2, false),
        ] {
            let [cut, full, none] =
                [&cut, &full, &none].map(|views| light_at(views, &camera, shadow(right, down)));
            assert!(full < 0.5 * none, "the whole card throws a shadow: {full} {none}");
            let wanted = if is_lit { none } else { full };
            assert!((cut - wanted).abs() < 0.06 * none, "at {right} {down}: {cut}, not {wanted}");
        }
    }
}

/// How much of a card is seen, of what is seen of it as a whole.
fn share(renderer: &mut Renderer, image: &ModelImage, distance: f64, wrap: Wrap) -> f64 {
    let places = [[0.0; 2], [4.0; 2]];
    let mut count = |transparency| {
        let asset = card(image.clone(), places, |part| {
            part.transparency = transparency;
            part.texture.as_mut().expect("it has one").wrap = [wrap; 2];
        });
        let mut world = World::new();
        let id = add(&mut world, &asset, [distance, 0.0, -1.0]);
        let views = all(renderer, &world, &camera());
        slots(&views).iter().filter(|slot| **slot == id.index() as u32 + 1).count() as f64
    };
    count(Transparency::Cutout { cutoff: 0.5 }) / count(Transparency::Opaque)
}

/// Thin leaves stay as many when they grow small: a mean of alpha alone would lose them.
#[test]
fn leaves_do_not_vanish_far_away() {
    let Some(renderers) = backends() else { return };
    // A quarter is there, in strips of a sixteenth across.
    let leaves = picture(64, |x, y| (x * 8.0).fract() < 0.5 && (y * 8.0).fract() < 0.5);
    for mut renderer in renderers {
        for distance in [4.0, 12.0, 25.0, 50.0] {
            let got = share(&mut renderer, &leaves, distance, Wrap::Repeat);
            println!("{distance} m: {got:.3}");
            assert!((0.18..0.34).contains(&got), "{got} of a quarter is seen from {distance} m");
        }
    }
}

#[test]
fn vertices_and_factors_have_alpha_too() {
    let Some(renderers) = backends() else { return };
    let seen = |renderer: &mut Renderer, alpha: f32, cutoff: f32, image: Option<ModelImage>| {
        let mut asset = card(image.clone().unwrap_or_else(|| ring(4)), WHOLE, |part| {
            part.transparency = Transparency::Cutout { cutoff };
            part.texture = part.texture.filter(|_| image.is_some());
        });
        let model = Arc::make_mut(asset.model.as_mut().expect("it has a model"));
        model.vertices.iter_mut().for_each(|vertex| vertex.alpha = alpha);
        let (world, [card, ..]) = scene(&asset);
        slots(&all(renderer, &world, &camera())).contains(&(card.index() as u32 + 1))
    };
    let solid = || Some(picture(8, |_, _| true));
    for mut renderer in renderers {
        for image in [None, solid()] {
            for (alpha, cutoff, is_there) in [
                (1.0, 1.0, true),
                (0.5, 0.5, true),
                (0.7, 0.7, true),
                (0.4, 0.5, false),
                (0.0, 0.0, true),
                (1.0, 1.5, false),
                (0.9, 0.95, false),
            ] {
                let got = seen(&mut renderer, alpha, cutoff, image.clone());
                assert_eq!(got, is_there, "alpha {alpha}, cutoff {cutoff}, {}", image.is_some());
            }
        }
    }
}

/// Of what is blended, what is there by a half or more counts as what is cut out does, and nothing of the rest; its colour is another matter.
#[test]
fn what_is_blended_is_there_from_a_half_on() {
    let Some(renderers) = backends() else { return };
    // From nothing on the left to all on the right.
    let mut image = picture(64, |_, _| true);
    image.alpha = (0..64 * 64).map(|k| (k % 64 * 4) as u8).collect();
    let world = |transparency| scene(&card(image.clone(), WHOLE, |part| part.transparency = transparency)).0;
    let blended = world(Transparency::Blend);
    let cut = world(Transparency::Cutout { cutoff: 0.5 });
    for mut renderer in renderers {
        let [blended, cut] = [&blended, &cut].map(|world| all(&mut renderer, world, &camera()));
        assert!(blended.ids == cut.ids && blended.depth == cut.depth && blended.normals == cut.normals);
        assert!(blended.rgb != cut.rgb);
    }
}

#[test]
fn smoothed_pictures_have_the_holes_as_well() {
    let smooth = RenderConfig {
        anti_aliasing: AntiAliasing::Msaa4,
        backend: Backend::Raster,
        ..RenderConfig::default()
    };
    let plain = RenderConfig { backend: Backend::Raster, ..RenderConfig::default() };
    let (Some(mut smooth), Some(mut plain)) = (renderer(&smooth), renderer(&plain)) else { return };
    let (world, _) = scene(&card(ring(64), WHOLE, cutout));
    let [smooth, plain] = [&mut smooth, &mut plain].map(|renderer| all(renderer, &world, &camera()));
    assert!(smooth.ids == plain.ids && smooth.depth == plain.depth && smooth.normals == plain.normals);
    let (mean, _) = crate::common::difference(&smooth.rgb, &plain.rgb, 24);
    assert!(mean < 1.0, "colours differ by {mean}");
}

/// Beams go through holes, whether each is a ray or read from a view.
#[test]
fn beams_go_through_holes() {
    let Some(renderer) = renderer(&RenderConfig::default()) else { return };
    let renderer = Arc::new(Mutex::new(renderer));
    let (mut world, [card, ..]) = scene(&self::card(ring(64), WHOLE, cutout));
    // Its eye is on the height of the middle of the card.
    let wearer = put(&mut world, EntityKind::Car, [0.0, 0.0, -0.8], 0.0, Shape::cuboid(0.6, 0.6, 0.5));
    for method in [LidarMethod::Rays, LidarMethod::Views] {
        let config = LidarConfig { method, ..LidarConfig::default() };
        let beams = BeamTable::rows_16(1800).expect("sound");
        let mut lidar = Lidar::new(Arc::clone(&renderer), beams, config).expect("in range");
        let mut cloud = PointCloud::new();
        lidar.observe(&world, wearer, &mut cloud).expect("scanned");
        let (mut met, mut through) = (0, 0);
        for point in &cloud.points {
            // Where the beam passes the plane of the card, m from its middle.
            let [ahead, left, up] = point.position;
            let off = [left, up].map(|part| part / ahead * 4.99);
            let [aside, above] = off.map(f32::abs);
            let (out, is_card) = (off[0].hypot(off[1]), point.id == card.index() as u32 + 1);
            if ahead < 0.0 || aside.max(above) > 0.98 || (out - 0.5).abs() < 0.03 {
                continue;
            }
            assert_eq!(is_card, out > 0.5, "{method:?}: {out} m from the middle: {point:?}");
            *(if is_card { &mut met } else { &mut through }) += 1;
        }
        println!("{method:?}: {met} beams meet the card, {through} go through");
        assert!(met > 200 && through > 50, "{method:?}: {met} {through}");
    }
}
