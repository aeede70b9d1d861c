//! A camera sensor keeps the contract of observers, sits at the eyes, and does not see its wearer.

use std::sync::{Arc, Mutex};

use crate::common::{renderer, square_with_walker};
use simworld_core::camera::Intrinsics;
use simworld_core::environment::Environment;
use simworld_core::geometry::Pose;
use simworld_core::id::EntityId;
use simworld_core::scene::World;
use simworld_core::seam::{ObserveError, Observer};
use simworld_core::seed::Seed;
use simworld_core::testing::check_observer;
use simworld_render::{CameraSensor, Frame, RenderConfig, Renderer};

fn shared() -> Option<Arc<Mutex<Renderer>>> {
    renderer(&RenderConfig::default()).map(|renderer| Arc::new(Mutex::new(renderer)))
}

fn small() -> Intrinsics {
    Intrinsics::from_fov(96, 64, 1.4).expect("a size in range")
}

#[test]
fn a_camera_is_an_observer() {
    let Some(renderer) = shared() else { return };
    let (world, walker) = square_with_walker();
    let make = || -> Box<dyn Observer<Observation = Frame>> {
        Box::new(CameraSensor::sharing(Arc::clone(&renderer), small()))
    };
    check_observer(make, &world, walker, Frame::new);
}

/// Depth is exact in any weather unless drops are asked for; then they stand before what is there, and change nothing else.
#[test]
fn rain_is_in_depth_where_that_is_asked_for() {
    let Some(renderer) = shared() else { return };
    let (mut world, walker) = square_with_walker();
    let intrinsics = Intrinsics::from_fov(320, 240, 1.0).expect("a size in range");
    let seen = |world: &World, seed: Option<Seed>| {
        let mut eyes = CameraSensor::sharing(Arc::clone(&renderer), intrinsics);
        if let Some(seed) = seed {
            eyes = eyes.with_precipitation_in_depth(seed);
        }
        let mut frame = Frame::new();
        eyes.observe(world, walker, &mut frame).expect("it sees");
        frame
    };
    let dry = seen(&world, None);
    assert!(seen(&world, Some(Seed(2))) == dry, "nothing falls");
    let mut environment = Environment::default();
    (environment.weather.rain, environment.weather.temperature) = (40.0, 12.0);
    world.set_environment(environment).expect("in range");
    let exact = seen(&world, None);
    assert!(exact.depth == dry.depth && exact.ids == dry.ids, "depth is exact in rain");
    let wet = seen(&world, Some(Seed(2)));
    assert!(wet == seen(&world, Some(Seed(2))) && wet.depth != seen(&world, Some(Seed(3))).depth);
    assert!(wet.ids == exact.ids && wet.classes == exact.classes && wet.rgb == exact.rgb);
    let nearer = wet.depth.iter().zip(&exact.depth).filter(|(wet, exact)| wet < exact).count();
    assert!(wet.depth.iter().zip(&exact.depth).all(|(wet, exact)| wet <= exact));
    assert!((20..wet.depth.len() / 4).contains(&nearer), "{nearer} pixels show drops");
}

#[test]
fn people_see_from_eye_height_and_not_themselves() {
    let Some(renderer) = shared() else { return };
    let (world, walker) = square_with_walker();
    let mut eyes = CameraSensor::sharing(Arc::clone(&renderer), small());
    let camera = eyes.camera(&world, walker).expect("the walker is there");
    assert!((camera.world_from_optical.translation.z - 1.6).abs() < 1e-9);
    let mut frame = Frame::new();
    eyes.observe(&world, walker, &mut frame).expect("it sees");
    assert!(!frame.drawn.contains(&walker) && frame.drawn.len() > 5);

    // From outside it is seen.
    let behind = Pose::translation(-3.0, 0.0, 1.6);
    let mut chase = CameraSensor::sharing(renderer, small()).mounted_at(behind);
    chase.observe(&world, walker, &mut frame).expect("it sees");
    assert!(!frame.drawn.contains(&walker), "a sensor never shows its wearer");
}

#[test]
fn nobody_sees_nothing() {
    let Some(renderer) = shared() else { return };
    let (world, _) = square_with_walker();
    let nobody = EntityId::new(9999, 0);
    let outcome = CameraSensor::sharing(renderer, small()).observe(&world, nobody, &mut Frame::new());
    assert_eq!(outcome, Err(ObserveError::Missing { id: nobody }));
}
