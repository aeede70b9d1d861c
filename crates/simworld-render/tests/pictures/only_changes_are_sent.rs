//! A renderer that followed a world draws what one draws that sees it for the first time, whatever happened in between.

use crate::common::{draw, put, renderer, square, square_camera};
use simworld_core::alteration::Alteration;
use simworld_core::geometry::{Point3, Twist, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Shape, Visibility, World};
use simworld_core::seed::{Seed, StreamRng};
use simworld_render::{RenderConfig, Renderer};

/// One thing that happens to a world.
fn change(world: &mut World, rng: &mut StreamRng, boxes: &mut Vec<EntityId>) {
    let place = |rng: &mut StreamRng| {
        pose_facing(Point3::new(rng.uniform(3.0, 60.0), rng.uniform(-12.0, 12.0), 0.0), rng.uniform(0.0, 6.0))
    };
    let pick = rng.uniform(0.0, boxes.len() as f64) as usize;
    match rng.uniform(0.0, 6.0) as u32 {
        0 => {
            let kind = if rng.uniform(0.0, 1.0) < 0.5 { EntityKind::Prop } else { EntityKind::Car };
            let desc = EntityDesc::new(kind, place(rng), Shape::cuboid(2.0, 1.0, rng.uniform(0.5, 2.0)));
            boxes.push(world.spawn(desc).expect("a box in the world"));
        }
        1 if boxes.len() > 2 => {
            world.remove(boxes.swap_remove(pick)).expect("it lives");
        }
        2 => {
            let color = Alteration::Color(Some([rng.uniform(0.0, 1.0) as f32, 0.2, 0.3]));
            world.alter(boxes[pick], color).expect("it lives");
        }
        3 => {
            let shown = if rng.uniform(0.0, 1.0) < 0.5 { Visibility::Shown } else { Visibility::Hidden };
            world.alter(boxes[pick], Alteration::Visibility(shown)).expect("it lives");
        }
        _ => world.set_motion(boxes[pick], place(rng), Twist::ZERO).expect("it lives"),
    }
}

#[test]
fn a_followed_world_looks_as_one_seen_for_the_first_time() {
    let Some(mut following) = renderer(&RenderConfig::default()) else { return };
    let Some(mut fresh) = renderer(&RenderConfig::default()) else { return };
    let camera = square_camera(0.0, 96, 64);
    let mut rng = Seed(11).stream("tests/changes").rng();
    let mut world = square(0.0);
    let mut boxes: Vec<EntityId> = (0..5)
        .map(|k| {
            put(
                &mut world,
                EntityKind::Prop,
                [8.0 + f64::from(k), 3.0, 0.0],
                0.0,
                Shape::cuboid(0.5, 0.5, 1.0),
            )
        })
        .collect();
    let mut pictures = Vec::new();
    for round in 0..25 {
        for _ in 0..2 + round % 4 {
            change(&mut world, &mut rng, &mut boxes);
        }
        // Pictures are drawn within steps, after one, and after several.
        for _ in 0..round % 3 {
            world.finish_step();
        }
        let expected = draw(&mut fresh, &world.clone(), &camera);
        let followed = draw(&mut following, &world, &camera);
        assert!(followed == expected, "round {round}");
        pictures.push(followed);
    }
    pictures.dedup();
    assert!(pictures.len() > 12, "only {} pictures differ", pictures.len());
}

/// One renderer draws two worlds in turn.
#[test]
fn worlds_do_not_mix() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let camera = square_camera(0.0, 64, 48);
    let (first, mut second) = (square(0.0), World::new());
    put(&mut second, EntityKind::Bus, [12.0, 0.0, 0.0], 1.0, Shape::cuboid(10.0, 2.5, 3.0));
    let turn = |renderer: &mut Renderer| [draw(renderer, &first, &camera), draw(renderer, &second, &camera)];
    let expected = turn(&mut renderer);
    assert!(turn(&mut renderer) == expected);
    assert_ne!(expected[0].ids, expected[1].ids);
}

/// Shadow maps are kept from picture to picture, and what walls hide is found anew for each: an eye that goes along a street where a
/// car drives, and comes back, sees what one sees that was never anywhere else.
#[test]
fn pictures_do_not_depend_on_those_before() {
    let Some(mut following) = renderer(&RenderConfig::default()) else { return };
    let mut world = square(0.0);
    let car = put(&mut world, EntityKind::Car, [20.0, -2.0, 0.0], 0.0, Shape::cuboid(4.5, 1.8, 1.5));
    let mut pictures = Vec::new();
    for step in [0, 1, 2, 3, 3, 2, 12, 30, 1, 0] {
        let along = f64::from(step);
        // At the third step only the eye has moved, at the fifth nothing.
        if step != 2 {
            let pose = pose_facing(Point3::new(20.0 + along, -2.0, 0.0), 0.0);
            world.set_motion(car, pose, Twist::ZERO).expect("it lives");
        }
        world.finish_step();
        let camera = square_camera(0.4 * along, 96, 64);
        let Some(mut fresh) = renderer(&RenderConfig::default()) else { return };
        let expected = draw(&mut fresh, &world.clone(), &camera);
        let followed = draw(&mut following, &world, &camera);
        assert!(followed == expected, "step {step} after {} pictures", pictures.len());
        pictures.push(followed);
    }
    pictures.dedup();
    assert!(pictures.len() > 7, "only {} pictures differ", pictures.len());
}
