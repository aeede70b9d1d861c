//! What is farther away is drawn with fewer triangles: little of a picture changes by that, and both backends change it alike.

use crate::common::{put, renderer};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::Point3;
use simworld_core::scene::{EntityKind, Scene, Shape, World};
use simworld_render::{Backend, Frame, LevelOfDetail, RenderConfig, ViewOptions, ViewRequest, Views};

fn kinds() -> [(EntityKind, Shape); 6] {
    [
        (EntityKind::Person, Shape::Capsule { radius: 0.25, height: 1.8 }),
        (EntityKind::Car, Shape::cuboid(4.4, 1.8, 1.5)),
        (EntityKind::Tree, Shape::Cylinder { radius: 0.15, height: 7.0 }),
        (EntityKind::StreetLamp, Shape::Cylinder { radius: 0.09, height: 6.0 }),
        (EntityKind::Building, Shape::cuboid(12.0, 18.0, 15.0)),
        (EntityKind::Dog, Shape::cuboid(0.8, 0.3, 0.6)),
    ]
}

/// A camera that looks from so far away at what stands in the origin, aside of its front.
fn from_afar(distance: f64) -> Camera {
    let intrinsics = Intrinsics::from_fov(240, 180, 1.0).expect("a size in range");
    let eye = Point3::new(distance * 0.8, distance * 0.6, 1.7);
    Camera::looking_at(eye, Point3::new(0.0, 0.0, 1.5), intrinsics)
}

/// Of the picture: of somebody of ten pixels one is much.
#[test]
fn little_of_a_picture_changes_where_a_level_does() {
    let [by_pixels, finest] = [LevelOfDetail::ByPixels, LevelOfDetail::Finest]
        .map(|level_of_detail| RenderConfig { level_of_detail, ..RenderConfig::default() });
    let (Some(mut coarse), Some(mut fine)) = (renderer(&by_pixels), renderer(&finest)) else { return };
    let (mut a, mut b) = (Frame::new(), Frame::new());
    let mut some = false;
    for (kind, shape) in kinds() {
        let mut world = World::new();
        put(&mut world, kind, [0.0; 3], 0.0, shape);
        let (mut distance, mut worst) = (5.0_f64, 0.0_f64);
        while distance < 160.0 {
            coarse.render(&world, &from_afar(distance), &mut a).expect("it is drawn");
            fine.render(&world, &from_afar(distance), &mut b).expect("it is drawn");
            let differ = a.ids.iter().zip(&b.ids).filter(|(a, b)| a != b).count();
            worst = worst.max(differ as f64 / b.ids.len() as f64);
            distance *= 1.3;
        }
        println!("{kind}: at most {:.3} % of the picture is another", worst * 100.0);
        some |= worst > 0.0;
        assert!(worst < 0.02, "{kind}: {worst} of the picture is another");
    }
    assert!(some, "there is one level alone");
}

/// A shadow is thrown by fewer triangles than are seen: on the ground beside somebody near, little is lit that was dark, or dark that was lit.
#[test]
fn little_of_a_shadow_changes_where_a_level_does() {
    let [by_texels, finest] = [LevelOfDetail::ByPixels, LevelOfDetail::Finest].map(|level_of_detail| {
        RenderConfig { level_of_detail, backend: Backend::Raster, ..RenderConfig::default() }
    });
    let (Some(mut coarse), Some(mut fine)) = (renderer(&by_texels), renderer(&finest)) else { return };
    let (mut a, mut b) = (Frame::new(), Frame::new());
    let mut some = false;
    for (kind, shape) in kinds().into_iter().filter(|(kind, _)| *kind != EntityKind::Building) {
        let mut world = World::new();
        put(&mut world, EntityKind::Ground, [0.0, 0.0, -0.1], 0.0, Shape::cuboid(200.0, 200.0, 0.1));
        put(&mut world, kind, [0.0; 3], 0.0, shape);
        let mut environment = *world.environment();
        (environment.sun.azimuth, environment.sun.elevation) = (2.6, 0.7);
        environment.weather.cloud_cover = 0.0;
        world.set_environment(environment).expect("a sun in range");
        for (renderer, frame) in [(&mut coarse, &mut a), (&mut fine, &mut b)] {
            renderer.render(&world, &from_afar(9.0), frame).expect("it is drawn");
        }
        // The ground is the same surface in both.
        let ground = |pixel: &usize| a.ids[*pixel] == b.ids[*pixel] && a.depth[*pixel] == b.depth[*pixel];
        let bright = |frame: &Frame, pixel: usize| i32::from(frame.rgb[pixel * 3 + 1]);
        let differs = |pixel: &usize| (bright(&a, *pixel) - bright(&b, *pixel)).abs() > 12;
        let share = (0..a.ids.len()).filter(ground).filter(differs).count() as f64 / a.ids.len() as f64;
        println!("{kind}: {:.3} % of the picture is lit otherwise", share * 100.0);
        some |= share > 0.0;
        assert!(share < 0.01, "{kind}: {share} of the picture is lit otherwise");
    }
    assert!(some, "there is one level alone");
}

/// Rays choose levels view by view as triangles do: somebody near and somebody far away in one batch, from near and far.
#[test]
fn rays_and_triangles_choose_the_same() {
    let with = |backend| renderer(&RenderConfig { backend, ..RenderConfig::default() });
    let (Some(mut raster), Some(mut raycast)) = (with(Backend::Raster), with(Backend::Raycast)) else {
        return;
    };
    let mut world = World::new();
    put(&mut world, EntityKind::Ground, [0.0, 0.0, -0.1], 0.0, Shape::cuboid(900.0, 900.0, 0.1));
    for (number, (kind, shape)) in (0..42).zip(kinds().into_iter().cycle()) {
        let along = f64::from(number);
        let aside = if number % 2 == 0 { 5.0 } else { -5.0 };
        put(&mut world, kind, [-4.0 * along, aside * (1.0 + 0.08 * along), 0.0], 0.4 * along, shape);
    }
    let requests: Vec<ViewRequest> =
        [6.0, 14.0, 40.0, 110.0].map(|distance| from_afar(distance).into()).to_vec();
    let (mut drawn, mut cast) = (Views::new(), Views::new());
    raster.render_views(&world, &requests, &ViewOptions::default(), &mut drawn).expect("it is drawn");
    raycast.render_views(&world, &requests, &ViewOptions::default(), &mut cast).expect("it is cast");
    for view in 0..requests.len() {
        let pixels = drawn.pixels(view);
        let (a, b) = (&drawn.ids[pixels.clone()], &cast.ids[pixels.clone()]);
        let ids = a.iter().zip(b).filter(|(a, b)| a != b).count() as f64 / pixels.len() as f64;
        let far = |index: &usize| {
            let (x, y) = (drawn.depth[*index], cast.depth[*index]);
            drawn.ids[*index] == cast.ids[*index] && drawn.ids[*index] != 0 && (x - y).abs() > 1e-3 * x
        };
        let depths = pixels.clone().filter(far).count() as f64 / pixels.len() as f64;
        println!("view {view}: ids differ on {:.3} %, depth on {:.3} %", ids * 100.0, depths * 100.0);
        assert!(ids <= 5e-4 && depths <= 1e-3, "view {view}: ids differ on {ids}, depth on {depths}");
    }
}
