//! The same scene and camera give the same bits, in every process too; far from the origin they give the same picture.

use std::process::Command;

use crate::common::{difference, draw, looking_east, renderer, square, square_camera};
use simworld_core::environment::{Environment, Sun};
use simworld_core::hash::StateHasher;
use simworld_core::scene::World;
use simworld_render::{Backend, Frame, RenderConfig};

/// Set in the processes that this test starts.
const AGAIN: &str = "SIMWORLD_TEST_DRAWN_AGAIN";

#[test]
fn two_renders_are_bit_identical() {
    let config = RenderConfig::default();
    let (Some(mut first), Some(mut second)) = (renderer(&config), renderer(&config)) else { return };
    let (world, camera) = (square(0.0), square_camera(0.0, 160, 120));
    let expected = draw(&mut first, &world, &camera);
    // What was drawn in between leaves no trace.
    draw(&mut second, &World::new(), &looking_east(3.0, 50, 60));
    draw(&mut second, &world, &square_camera(-8.0, 160, 120));
    assert_eq!(draw(&mut second, &world, &camera), expected);
    assert_eq!(draw(&mut first, &world, &camera), expected);
}

#[test]
fn a_city_a_hundred_kilometres_away_looks_like_one_at_the_origin() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let here = draw(&mut renderer, &square(0.0), &square_camera(0.0, 160, 120));
    for shift in [10_000.0, 100_000.0] {
        let there = draw(&mut renderer, &square(shift), &square_camera(shift, 160, 120));
        let (mean, differing) = difference(&here.rgb, &there.rgb, 8);
        // Shadow texels are fixed to the world, so the edges of shadows move by parts of a texel.
        assert!(mean < 0.5 && differing < 0.01, "at {shift} m: mean {mean}, share {differing}");
        let moved = here.ids.iter().zip(&there.ids).filter(|(a, b)| a != b).count();
        assert!(moved < 20, "at {shift} m {moved} ids differ");
        let apart = here
            .depth
            .iter()
            .zip(&there.depth)
            .zip(here.ids.iter().zip(&there.ids))
            .filter(|(_, (a, b))| a == b && **a != 0)
            .map(|((a, b), _)| (a - b).abs() / a)
            .fold(0.0, f32::max);
        assert!(apart < 1e-3, "at {shift} m depth differs by {apart}");
    }
}

/// Digests of pictures by triangles and by rays, with rain, lamps and shadows.
fn digests() -> Option<String> {
    let mut world = square(0.0);
    let mut environment = Environment::default();
    environment.weather.rain = 4.0;
    environment.sun = Sun::at_hour(18.2);
    world.set_environment(environment).expect("in range");
    let mut all = Vec::new();
    for backend in [Backend::Raster, Backend::Raycast] {
        let mut renderer = renderer(&RenderConfig { backend, ..RenderConfig::default() })?;
        let Frame { rgb, depth, ids, classes, .. } =
            draw(&mut renderer, &world, &square_camera(0.0, 160, 120));
        let mut hasher = StateHasher::new();
        rgb.iter().chain(&classes).for_each(|byte| {
            hasher.u64(u64::from(*byte));
        });
        depth.iter().map(|depth| depth.to_bits()).chain(ids).for_each(|word| {
            hasher.u64(u64::from(word));
        });
        all.push(format!("{backend:?} {:?}", hasher.finish()));
    }
    Some(all.join(", "))
}

/// The test starts itself again, once with all threads of the software driver and once with one.
#[test]
fn other_processes_draw_the_same_bits() {
    let Some(digests) = digests() else { return };
    if std::env::var_os(AGAIN).is_some() {
        println!("digests: {digests};");
        return;
    }
    for threads in [None, Some("1")] {
        let mut again = Command::new(std::env::current_exe().expect("the test has a file"));
        again.args(["--exact", "pictures_repeat::other_processes_draw_the_same_bits", "--nocapture"]);
        again.env(AGAIN, "1");
        if let Some(threads) = threads {
            again.env("LP_NUM_THREADS", threads);
        }
        let output = again.output().expect("it starts");
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{text}{}", String::from_utf8_lossy(&output.stderr));
        assert!(text.contains(&format!("digests: {digests};")), "{threads:?}: {digests}, and there {text}");
    }
}
