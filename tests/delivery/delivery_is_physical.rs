//! Couriers are bodies: walls stop them, they begin to cross on walk alone, and the books balance at every tick.

use std::f64::consts::FRAC_PI_2;
use std::sync::{Arc, Mutex};

use simworld_agents::model::{ChatModel, ChatReply, Part, Scripted};
use simworld_core::action::Action;
use simworld_core::clock::Tick;
use simworld_core::command::Command;
use simworld_core::geometry::Obb;
use simworld_core::id::CrossingId;
use simworld_core::net::{Aspect, RoadNetwork, polyline};
use simworld_core::scene::{EntityKind, Scene};
use simworld_core::seed::Seed;
use simworld_examples::delivery::{Brain, Eyes, RunConfig, ThinkError, Thinkers, assemble_with, make_city};
use simworld_tests::{assembled, small};

/// Half the width of a body, m: who brushes the edge of a strip at the corner of the sidewalk is not on it.
const HALF_BODY: f64 = 0.25;

/// The crossing on whose strip, kerbs apart, somebody stands.
fn crossing_under(network: &RoadNetwork, at: &nalgebra::Point2<f64>) -> Option<CrossingId> {
    (0..network.crossings.len()).map(CrossingId::from_index).find(|id| {
        let crossing = &network.crossings[id.index()];
        let strip = [crossing.start, crossing.end];
        polyline::closest(&strip, at).is_some_and(|near| {
            let inside = near.station > 0.8 && near.station < polyline::length(&strip) - 0.8;
            inside && near.distance < crossing.width * 0.5 - HALF_BODY
        })
    })
}

#[test]
fn couriers_stay_out_of_walls_and_wait_at_red() {
    /// So many steps beside the strip, at most.
    const ASIDE: u32 = 30;
    let (city, mut assembly) = assembled(&small(2500));
    let network = &city.network;
    let houses: Vec<Obb> = city.buildings.iter().map(simworld_citygen::building::Building::obb).collect();
    let mut on: Vec<Option<CrossingId>> = vec![None; assembly.couriers.len()];
    // Who steps beside the strip on the way across and on it again is still on its way across.
    let mut left: Vec<(Option<CrossingId>, u32)> = vec![(None, 0); assembly.couriers.len()];
    let mut recent: Vec<Vec<Aspect>> = Vec::new();
    let (mut walked, mut begun) = (0.0, 0);
    while !assembly.episode.is_over() {
        // The kerb is a step or two before the strip: what showed in the last two seconds counts.
        recent.push(assembly.episode.simulation().world().signals().to_vec());
        if recent.len() > 20 {
            recent.remove(0);
        }
        assembly.episode.step().unwrap();
        assembly.episode.task().audit().expect("the books balance at every tick");
        let world = assembly.episode.simulation().world();
        for (index, courier) in assembly.couriers.iter().enumerate() {
            let body = world.entity(*courier).expect("couriers live");
            assert_eq!(body.kind, EntityKind::Person);
            walked += body.twist.ground_speed() * 0.1;
            for house in &houses {
                let local = house.pose.inverse_transform_point(&body.position());
                let inside = local.x.abs() < house.half_extents.x - 0.05
                    && local.y.abs() < house.half_extents.y - 0.05;
                assert!(!inside, "courier {index} is in a wall");
            }
            let now = crossing_under(network, &body.planar());
            left[index].1 += 1;
            if on[index].is_some() {
                left[index] = (on[index], 0);
            }
            let goes_on = now == left[index].0 && left[index].1 < ASIDE;
            if let Some(crossing) = now.filter(|_| now != on[index] && !goes_on) {
                if let Some(group) = network.crossings[crossing.index()].signal {
                    let walk = recent.iter().any(|aspects| aspects[group.index()] == Aspect::Green);
                    assert!(walk, "courier {index} began to cross at red");
                }
                begun += 1;
            }
            on[index] = now;
        }
    }
    assert!(walked > 500.0, "couriers walked {walked:.0} m in all");
    assert!(begun > 3, "couriers crossed {begun} times");
    let delivered = assembly.episode.task().report().expect("the task has begun").delivered;
    assert!(delivered > 0, "nothing was delivered");
}

/// Colours of a PNG of that size, or a panic that says what it is instead.
fn pixels(file: &[u8], size: (u32, u32)) -> Vec<u8> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().expect("it is a PNG");
    let mut rgb = vec![0; reader.output_buffer_size().expect("it has a size")];
    let info = reader.next_frame(&mut rgb).expect("it is whole");
    assert_eq!((info.width, info.height, info.color_type), (size.0, size.1, png::ColorType::Rgb));
    rgb
}

/// Mean difference of two pictures, of 255.
fn difference(a: &[u8], b: &[u8]) -> f64 {
    a.iter().zip(b).map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>() / a.len() as f64
}

#[test]
fn what_a_model_is_shown_is_what_is_before_its_courier() {
    let mut config =
        RunConfig { agents: 1, vehicles: 0, pedestrians: 0, policies: vec![Brain::Model], ..small(80) };
    config.model.eyes = Eyes::Open;
    (config.model.thinking.pause, config.model.thinking.interval) = (1.0, 1.0);
    let shown: Arc<Mutex<Vec<Vec<u8>>>> = Arc::default();
    let kept = Arc::clone(&shown);
    let model = move || {
        let kept = Arc::clone(&kept);
        let rule = Scripted::rule(move |request| {
            let parts = request.messages.iter().flat_map(|message| &message.content);
            let images: Vec<_> = parts
                .filter_map(|part| if let Part::Image(image) = part { Some(image) } else { None })
                .collect();
            assert_eq!(images.len(), 1, "each request shows one picture");
            assert_eq!(images[0].media_type, "image/png");
            let acts = request.schema.as_ref().is_some_and(|schema| schema.name == "call");
            if acts {
                kept.lock().expect("nobody panics with it").push(images[0].bytes.to_vec());
            }
            Ok(ChatReply::of(if acts {
                r#"{"because": "I look around", "deed": {"act": "do_nothing"}}"#
            } else {
                r#"{"thought": "I look around."}"#
            }))
        });
        Ok(Box::new(rule) as Box<dyn ChatModel>)
    };
    let thinkers = match Thinkers::with_backend(&config.model, Seed(3), model) {
        Err(ThinkError::Eyes(reason)) if std::env::var_os("SIMWORLD_REQUIRE_ADAPTER").is_none() => {
            eprintln!("skipped: {reason}");
            return;
        }
        thinkers => thinkers.expect("couriers can see"),
    };
    let (city, _) = make_city(&config).expect("the configuration is sound");
    let mut assembly = assemble_with(&config, &city, Seed(3), Some(thinkers)).expect("the parts fit");
    let who = assembly.couriers[0];
    while !assembly.episode.is_over() {
        if assembly.episode.simulation().world().clock().tick() == Tick(40) {
            assembly.episode.submit(Command::Actuate { who, action: Action::Rotate { angle: FRAC_PI_2 } });
        }
        assembly.episode.step().expect("the step");
    }
    let shown = shown.lock().expect("nobody panicked with it");
    let pictures: Vec<Vec<u8>> = shown.iter().map(|file| pixels(file, (320, 180))).collect();
    assert!(pictures.len() >= 7, "{} thoughts in 8 s", pictures.len());
    let (first, last) = (&pictures[1], &pictures[pictures.len() - 1]);
    let colours: std::collections::BTreeSet<&[u8]> = first.chunks(3).collect();
    assert!(colours.len() > 20, "a city has more than {} colours", colours.len());
    // Who stands still sees the same, and who turned something else.
    assert!(difference(first, &pictures[2]) < 0.5, "nothing moves");
    assert!(difference(first, last) > 8.0, "{:.1} of 255 after a quarter turn", difference(first, last));
}
