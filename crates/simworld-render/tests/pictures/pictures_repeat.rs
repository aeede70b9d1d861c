//! The same scene and camera give the same bits; far from the origin they give the same picture.

use crate::common::{difference, draw, looking_east, renderer, square, square_camera};
use simworld_core::scene::World;
use simworld_render::RenderConfig;

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
