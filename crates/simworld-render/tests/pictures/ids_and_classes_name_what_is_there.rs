//! Ids and classes say what is on a pixel.

use crate::common::{draw, looking_east, put, renderer};
use simworld_core::alteration::Alteration;
use simworld_core::scene::{EntityKind, Scene, Shape, Visibility, World};
use simworld_render::{AntiAliasing, Frame, RenderConfig, classes};

#[test]
fn every_kind_is_drawn_under_its_id_and_class() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    for kind in EntityKind::ALL {
        let mut world = World::new();
        // A first entity out of sight, so that the slot is not the instance number.
        put(&mut world, EntityKind::Prop, [-50.0, 0.0, 0.0], 0.0, Shape::cuboid(1.0, 1.0, 1.0));
        let id = put(&mut world, *kind, [6.0, 0.0, 0.0], 2.8, Shape::cuboid(2.0, 1.6, 1.9));
        let frame = draw(&mut renderer, &world, &looking_east(1.3, 96, 64));
        let covered = frame.ids.iter().filter(|slot| **slot != 0).count();
        assert!(covered > 8, "{kind} covers {covered} pixels");
        for (slot, class) in frame.ids.iter().zip(&frame.classes) {
            match slot {
                0 => assert_eq!(*class, classes::SKY.id),
                _ => {
                    assert_eq!(
                        (*slot as usize, *class),
                        (id.index() + 1, classes::class_of(*kind)),
                        "{kind}"
                    );
                }
            }
        }
        assert_eq!(frame.drawn, [id], "{kind}");
    }
}

#[test]
fn the_nearer_of_two_is_seen() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = World::new();
    let shape = Shape::cuboid(1.0, 1.0, 1.0);
    let far = put(&mut world, EntityKind::Prop, [20.0, 0.0, 0.0], 0.0, Shape::cuboid(1.0, 9.0, 9.0));
    let near = put(&mut world, EntityKind::Prop, [8.0, 0.0, 0.0], 0.0, shape);
    let frame = draw(&mut renderer, &world, &looking_east(0.5, 81, 61));
    assert_eq!(frame.entity_at(40, 30), Some(near));
    assert_eq!(frame.entity_at(40, 22), Some(far));
    assert_eq!(frame.drawn, [far, near]);
}

#[test]
fn what_is_hidden_is_not_drawn() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = World::new();
    let far = put(&mut world, EntityKind::Prop, [20.0, 0.0, 0.0], 0.0, Shape::cuboid(1.0, 9.0, 9.0));
    let near = put(&mut world, EntityKind::Prop, [8.0, 0.0, 0.0], 0.0, Shape::cuboid(1.0, 1.0, 1.0));
    for (visibility, seen) in [(Visibility::Hidden, far), (Visibility::Shown, near)] {
        world.alter(near, Alteration::Visibility(visibility)).expect("it lives");
        let frame = draw(&mut renderer, &world, &looking_east(0.5, 81, 61));
        assert_eq!(frame.entity_at(40, 30), Some(seen), "{visibility:?}");
    }
}

/// A slot that is used again has the id of its new owner.
#[test]
fn a_newcomer_in_an_old_slot_is_itself() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = World::new();
    let shape = Shape::cuboid(1.0, 4.0, 4.0);
    let first = put(&mut world, EntityKind::Prop, [8.0, 0.0, 0.0], 0.0, shape);
    world.remove(first).expect("it lives");
    let second = put(&mut world, EntityKind::Car, [8.0, 0.0, 0.0], 0.0, shape);
    assert_eq!(first.index(), second.index());
    let frame = draw(&mut renderer, &world, &looking_east(1.0, 33, 33));
    assert_eq!(frame.entity_at(16, 16), Some(second));
    assert!(world.entity(second).is_some());
}

/// Smoothing changes colours at edges, and never depth or ids.
#[test]
fn smoothing_leaves_the_measures_alone() {
    let smooth = RenderConfig { anti_aliasing: AntiAliasing::Msaa4, ..RenderConfig::default() };
    let (Some(mut plain), Some(mut smooth)) = (renderer(&RenderConfig::default()), renderer(&smooth)) else {
        return;
    };
    let world = crate::common::square(0.0);
    let camera = crate::common::square_camera(0.0, 200, 150);
    let (sharp, soft) = (draw(&mut plain, &world, &camera), draw(&mut smooth, &world, &camera));
    assert_eq!(sharp.depth, soft.depth);
    assert_eq!((sharp.ids, sharp.classes), (soft.ids, soft.classes));
    let (mean, differing) = crate::common::difference(&sharp.rgb, &soft.rgb, 8);
    assert!(differing > 0.005 && mean < 4.0, "mean {mean}, share {differing}");
}

#[test]
fn a_frame_of_another_size_is_reused() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let world = crate::common::square(0.0);
    let mut frame = Frame::new();
    for (width, height) in [(64, 48), (200, 31), (1, 1), (64, 48)] {
        renderer.render(&world, &looking_east(2.0, width, height), &mut frame).expect("it is drawn");
        let pixels = (width * height) as usize;
        assert_eq!((frame.width, frame.height), (width, height));
        assert_eq!((frame.rgb.len(), frame.depth.len()), (3 * pixels, pixels));
        assert_eq!((frame.ids.len(), frame.classes.len()), (pixels, pixels));
        assert!(frame.entity_at(width, 0).is_none() && frame.rgb_at(0, height).is_none());
    }
}
