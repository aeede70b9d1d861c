//! Many cameras in one submission see what each would see alone, in the form that was asked for, now or later.

use crate::common::{draw, put, renderer, square, square_camera};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, Twist, pose_facing};
use simworld_core::scene::{EntityKind, Shape, World};
use simworld_render::{
    AntiAliasing, Channels, Frame, PixelFormat, RenderConfig, RenderError, Renderer, ViewOptions,
    ViewRequest, Views,
};

/// Cameras of mixed sizes around the square.
fn requests() -> Vec<ViewRequest> {
    let around = [(0.0, 0.0, 96, 64), (8.0, -6.0, 64, 64), (20.0, 3.0, 33, 17), (-5.0, 2.0, 1, 1)];
    let camera = |(x, y, width, height)| {
        let intrinsics = Intrinsics::from_fov(width, height, 1.2).expect("a size in range");
        Camera::looking_at(Point3::new(x, y, 2.0), Point3::new(14.0, 0.4, 1.5), intrinsics)
    };
    around.map(|place| ViewRequest::from(camera(place))).to_vec()
}

#[test]
fn a_batch_is_its_views_drawn_alone() {
    for anti_aliasing in [AntiAliasing::Off, AntiAliasing::Msaa4] {
        let config = RenderConfig { anti_aliasing, ..RenderConfig::default() };
        let (Some(mut alone), Some(mut renderer)) = (renderer(&config), renderer(&config)) else { return };
        let mut world = square(0.0);
        let wearer = put(
            &mut world,
            EntityKind::Person,
            [9.0, -5.0, 0.0],
            0.0,
            Shape::Capsule { radius: 0.3, height: 1.8 },
        );
        let mut requests = requests();
        requests[1].hidden = Some(wearer);
        let mut views = Views::new();
        renderer.render_views(&world, &requests, &ViewOptions::default(), &mut views).expect("it is drawn");
        assert_eq!(views.len(), 4);
        let (mut frame, mut expected) = (Frame::new(), Frame::new());
        for (view, request) in requests.iter().enumerate() {
            assert!(views.copy_frame(view, &mut frame));
            alone.render_hiding(&world, &request.camera, request.hidden, &mut expected).expect("it is drawn");
            assert!(frame == expected, "view {view} of {anti_aliasing:?} is another picture");
        }
        let shown =
            |view: usize| views.ids[views.pixels(view)].iter().any(|id| views.entity(*id) == Some(wearer));
        assert!(shown(0) && !shown(1), "the wearer is hidden from its own eyes alone");
    }
}

/// The compact format and single channels hold the same numbers.
#[test]
fn every_format_says_the_same() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let (world, requests) = (square(0.0), requests());
    let mut all = Views::new();
    renderer.render_views(&world, &requests, &ViewOptions::default(), &mut all).expect("it is drawn");
    let mut views = Views::new();
    renderer.render_views(&world, &requests, &ViewOptions::compact(), &mut views).expect("it is drawn");
    assert!(
        views.rgb == all.rgb && views.ids.is_empty() && views.depth.is_empty() && views.classes.is_empty()
    );
    assert!(views.wide_classes.iter().zip(&all.classes).all(|(wide, class)| *wide == u16::from(*class)));
    assert_eq!(views.depth_mm.len(), all.depth.len());
    for (mm, depth) in views.depth_mm.iter().zip(&all.depth) {
        let expected =
            if depth.is_finite() { (f64::from(*depth) * 1000.0).round().min(65535.0) } else { 0.0 };
        assert!((f64::from(*mm) - expected).abs() <= 1.0, "{mm} mm for {depth} m");
    }
    for channel in Channels::all().iter() {
        let options = ViewOptions { channels: channel, format: PixelFormat::Full };
        renderer.render_views(&world, &requests, &options, &mut views).expect("it is drawn");
        let same = |wanted, is_same, is_empty| if channel == wanted { is_same } else { is_empty };
        assert!(same(Channels::RGB, views.rgb == all.rgb, views.rgb.is_empty()), "{channel:?}");
        assert!(same(Channels::DEPTH, views.depth == all.depth, views.depth.is_empty()), "{channel:?}");
        assert!(same(Channels::IDS, views.ids == all.ids, views.ids.is_empty()), "{channel:?}");
        assert!(
            same(Channels::CLASSES, views.classes == all.classes, views.classes.is_empty()),
            "{channel:?}"
        );
    }
}

/// What was handed in is what the world was then, however much later it is taken.
#[test]
fn batches_are_taken_when_it_suits() {
    let (Some(mut alone), Some(mut renderer)) =
        (renderer(&RenderConfig::default()), renderer(&RenderConfig::default()))
    else {
        return;
    };
    let mut world = square(0.0);
    let car = put(&mut world, EntityKind::Car, [9.0, -2.0, 0.0], 0.0, Shape::cuboid(4.0, 1.8, 1.5));
    let request = ViewRequest::from(square_camera(0.0, 64, 48));
    let options = ViewOptions::default();
    let mut tickets = Vec::new();
    let mut expected = Vec::new();
    for step in 0..4 {
        let pose = pose_facing(Point3::new(9.0 + f64::from(step), -2.0, 0.0), 0.0);
        world.set_motion(car, pose, Twist::ZERO).expect("it lives");
        world.finish_step();
        tickets.push(renderer.submit(&world, &[request], &options).expect("it is handed in"));
        expected.push(draw(&mut alone, &world, &request.camera));
    }
    let (mut views, mut frame) = (Views::new(), Frame::new());
    for step in [2, 0, 1, 0] {
        renderer.take(tickets.remove(step), &mut views).expect("it comes");
        views.copy_frame(0, &mut frame);
        assert!(frame == expected.remove(step), "taken as number {step} of those left");
    }
    let foreign = alone.submit(&world, &[request], &options).expect("it is handed in");
    assert!(matches!(renderer.take(foreign, &mut views), Err(RenderError::Ticket)));
}

/// The bytes of a channel on the device, fetched by the caller's own commands.
fn fetch(
    renderer: &mut Renderer,
    world: &World,
    requests: &[ViewRequest],
) -> (Vec<u32>, Vec<simworld_render::Span>) {
    use simworld_render::wgpu;
    let (device, queue) = (renderer.device().clone(), renderer.queue().clone());
    let views = renderer.draw_on_device(world, requests, &ViewOptions::default()).expect("it is drawn");
    let ids = views.buffer(Channels::IDS).expect("ids were asked for");
    assert!(views.buffer(Channels::IDS | Channels::RGB).is_none());
    let copy = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: ids.size(),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_buffer_to_buffer(ids, 0, &copy, 0, ids.size());
    queue.submit([encoder.finish()]);
    copy.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("it is mapped"));
    views.wait().expect("it is drawn");
    let words = copy.get_mapped_range(..).expect("it is mapped");
    let words = words.chunks_exact(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect();
    (words, views.spans().to_vec())
}

#[test]
fn results_may_stay_on_the_device() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let (world, requests) = (square(0.0), requests());
    let mut views = Views::new();
    renderer.render_views(&world, &requests, &ViewOptions::default(), &mut views).expect("it is drawn");
    let (words, spans) = fetch(&mut renderer, &world, &requests);
    for (view, span) in spans.iter().enumerate() {
        assert_eq!(views.size(view), Some((span.width, span.height)));
        let ids = &views.ids[views.pixels(view)];
        for (y, row) in ids.chunks_exact(span.width as usize).enumerate() {
            let start = span.first + y * span.pitch as usize;
            assert_eq!(&words[start..start + row.len()], row, "row {y} of view {view}");
        }
    }
}

#[test]
fn what_cannot_be_drawn_is_refused_and_the_next_batch_is_drawn() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let world = square(0.0);
    let mut views = Views::new();
    let good = [ViewRequest::from(square_camera(0.0, 64, 48))];
    let all = ViewOptions::default();
    renderer.render_views(&world, &good, &all, &mut views).expect("it is drawn");
    let expected = views.clone();
    let mut refused = |requests: &[ViewRequest], options: &ViewOptions| {
        let error =
            renderer.render_views(&world, requests, options, &mut Views::new()).expect_err("impossible");
        renderer.render_views(&world, &good, &all, &mut views).expect("the next one is drawn");
        assert!(views == expected, "after {error}");
        error
    };
    assert!(matches!(refused(&[], &all), RenderError::NoViews));
    let nothing = ViewOptions { channels: Channels::empty(), ..all };
    assert!(matches!(refused(&good, &nothing), RenderError::NoChannels));
    let huge = vec![ViewRequest::from(square_camera(0.0, 4096, 4096)); 10_000];
    let error = refused(&huge, &all);
    assert!(matches!(error, RenderError::Batch { pixels: 167_772_160_000, .. }), "{error}");
    assert!(error.to_string().contains("in several batches"), "{error}");
}

#[test]
fn a_lost_device_is_told_once_and_then_there_is_a_new_one() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let (world, camera) = (square(0.0), square_camera(0.0, 64, 48));
    let expected = draw(&mut renderer, &world, &camera);
    for _ in 0..2 {
        let ticket =
            renderer.submit(&world, &[camera.into()], &ViewOptions::default()).expect("it is handed in");
        renderer.device().destroy();
        let error = renderer.render(&world, &camera, &mut Frame::new()).expect_err("the device is gone");
        assert!(
            matches!(error, RenderError::Lost { .. }) && error.to_string().contains("draw again"),
            "{error}"
        );
        assert!(matches!(renderer.take(ticket, &mut Views::new()), Err(RenderError::Ticket)));
        assert!(draw(&mut renderer, &world, &camera) == expected, "the new device draws another picture");
    }
    // Also where the loss shows only when a batch is taken.
    let ticket = renderer.submit(&world, &[camera.into()], &ViewOptions::default()).expect("it is handed in");
    renderer.device().destroy();
    let _ = renderer.take(ticket, &mut Views::new());
    let _ = renderer.render(&world, &camera, &mut Frame::new());
    assert!(draw(&mut renderer, &world, &camera) == expected, "the new device draws another picture");
}
