//! Whatever a server of models does, it ends in an asset or in a typed error, in time, and nothing is half there.
#![cfg(all(feature = "assets", feature = "http"))]
// what fails in a helper fails the test
#![allow(clippy::unwrap_used)]

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use crate::assets_common::{container, cuboid, dented_ball, model, plain_model, table, together};
use crate::fault_server::*;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::json;
use simworld_agents::assets::{GlbError, GlbLimits, ImportConfig, ImportError, export_glb};
use simworld_agents::generation::*;
use simworld_agents::model::RetryConfig;
use simworld_core::command::Command;
use simworld_core::geometry::Pose;
use simworld_core::hash::StateHash;
use simworld_core::scene::{Scene, World};
use simworld_core::simulation::Simulation;

const UID: &str = "0d9be0c2-7f5e-4a35-9a51-1f2f6c1b7a11";
const PNG: &[u8] = b"\x89PNG\r\n\x1a\n, as far as the client looks";

fn config(server: &FaultServer, version: HunyuanVersion, way: Way) -> HunyuanConfig {
    HunyuanConfig {
        base_url: server.root(),
        version,
        way,
        texture: if version == HunyuanVersion::V2_1 { Texture::Painted } else { Texture::None },
        deadline: 0.8,
        answer_timeout: 0.3,
        first_poll: 0.005,
        longest_poll: 0.02,
        retry: RetryConfig { attempts: 2, first_wait: 0.01, longest_wait: 0.02, total: 10.0 },
        ..HunyuanConfig::default()
    }
}

fn generator(server: &FaultServer) -> HunyuanGenerator {
    HunyuanGenerator::new(config(server, HunyuanVersion::V2_0, Way::Job)).unwrap()
}

fn prompt() -> AssetPrompt {
    AssetPrompt { image: Some(PNG.to_vec()), ..AssetPrompt::new("a wooden table").seeded(7) }
}

fn completed(glb: &[u8]) -> Answer {
    status(200, "", &json!({"status": "completed", "model_base64": STANDARD.encode(glb)}).to_string())
}

fn json_answer(value: &serde_json::Value) -> Answer {
    status(200, "Content-Type: application/json\r\n", &value.to_string())
}

fn bytes(glb: &[u8]) -> Answer {
    let head = format!("HTTP/1.1 200 OK\r\nContent-Length: {}\r\nConnection: close\r\n\r\n", glb.len());
    raw([head.into_bytes(), glb.to_vec()].concat())
}

/// A server that follows the protocol: jobs are done at the third question; `answer` says what comes then, and from
/// `/generate` at once.
fn following(answer: impl Fn(Way) -> Answer + Send + Sync + 'static) -> FaultServer {
    let asked = AtomicUsize::new(0);
    FaultServer::by_rule(move |heard| {
        let line = heard.head.lines().next().unwrap_or_default();
        if line.starts_with("POST /send ") {
            json_answer(&json!({"uid": UID}))
        } else if line.starts_with("POST /generate ") {
            answer(Way::Wait)
        } else if line.starts_with(&format!("GET /status/{UID} ")) {
            match asked.fetch_add(1, Ordering::SeqCst) {
                0 => json_answer(&json!({"status": "processing"})),
                1 => json_answer(&json!({"status": "texturing"})),
                _ => answer(Way::Job),
            }
        } else {
            status(404, "", "{\"detail\": \"Not Found\"}")
        }
    })
}

/// The error, and that it came in time.
#[allow(clippy::disallowed_methods)]
fn error_of(generator: &mut HunyuanGenerator, prompt: &AssetPrompt) -> HunyuanError {
    let start = Instant::now();
    let error = generator.generate(prompt).expect_err("no asset can come of it");
    assert!(start.elapsed() < Duration::from_secs(4), "{error} after {:?}", start.elapsed());
    match error {
        GenerateError::Generator(error) => *error.downcast::<HunyuanError>().unwrap(),
        other => panic!("{other}"),
    }
}

#[test]
fn both_versions_bring_assets_on_both_ways() {
    let glb = export_glb(&table());
    for (version, way) in [
        (HunyuanVersion::V2_0, Way::Job),
        (HunyuanVersion::V2_0, Way::Wait),
        (HunyuanVersion::V2_1, Way::Job),
        (HunyuanVersion::V2_1, Way::Wait),
    ] {
        let file = glb.clone();
        let server = following(move |way| if way == Way::Job { completed(&file) } else { bytes(&file) });
        let mut generator = HunyuanGenerator::new(config(&server, version, way)).unwrap();
        let made = generator.generate(&prompt()).unwrap().asset;
        assert!(made.name.starts_with("a_wooden_table_"), "{}", made.name);
        assert!(made.source.starts_with(generator.name()), "{}", made.source);
        assert!(made.source.contains("\"a wooden table\", seed 7; glb "), "{}", made.source);
        // As large as tables are, whatever the unit.
        assert!((made.collider.size().y - 1.3).abs() < 1e-6, "{:?}", made.collider);
        assert!(made.model.as_ref().unwrap().hulls.len() >= 5);
        assert_eq!(generator.pending(), None);

        let sent = &server.heard()[0];
        assert_eq!(sent.body["image"], STANDARD.encode(PNG));
        assert_eq!(sent.body["seed"], 7);
        assert_eq!(sent.body["texture"], version == HunyuanVersion::V2_1);
        assert_eq!(sent.body.get("type").is_some(), version == HunyuanVersion::V2_0, "2.1 knows no type");
        assert!(sent.body.get("text").is_none());
        assert_eq!(server.heard().len(), if way == Way::Job { 4 } else { 1 });
    }
}

#[test]
fn words_go_to_servers_that_take_words() {
    let server = following(|_| completed(&export_glb(&table())));
    let words = AssetPrompt::new("a wooden table");
    generator(&server).generate(&words).unwrap();
    let sent = &server.heard()[0].body;
    assert_eq!((&sent["text"], sent.get("image")), (&json!("a wooden table"), None));
    let mut newer = HunyuanGenerator::new(config(&server, HunyuanVersion::V2_1, Way::Wait)).unwrap();
    assert_eq!(error_of(&mut newer, &words), HunyuanError::NeedsImage);
    let gif = AssetPrompt { image: Some(b"GIF89a".to_vec()), ..words };
    assert!(matches!(error_of(&mut newer, &gif), HunyuanError::BadImage(_)));
    assert_eq!(server.heard().len(), 4, "nothing was sent for these");
}

/// Two cells that share a wall.
fn with_wall_within() -> Vec<u8> {
    let cell = cuboid([0.0; 3], [1.0; 3]);
    let mut cells = together(&[cell.clone(), cuboid([1.0, 0.0, 0.0], [2.0, 1.0, 1.0])]);
    // The second has no wall of its own where it touches the first.
    cells.triangles.drain(20..22);
    cells.parts[1].triangles = 10;
    let (document, bytes) = plain_model(&cells);
    container(&document, &bytes)
}

fn plain_file(model: &simworld_core::asset::Model) -> Vec<u8> {
    let (document, bytes) = plain_model(model);
    container(&document, &bytes)
}

type IsIt = fn(&HunyuanError) -> bool;

/// What a server answers, and the error that it is.
type Case = (&'static str, fn() -> Answer, IsIt);

/// What a server may bring in place of a model, and the error that it is.
fn bad_models() -> Vec<(&'static str, Vec<u8>, IsIt)> {
    let good = export_glb(&table());
    let line = model(&[[0.0; 3], [1.0; 3], [2.0; 3]], &[[0, 1, 2]]);
    let mut bad_numbers = plain_model(&table());
    bad_numbers.1[4..8].copy_from_slice(&f32::NAN.to_le_bytes());
    vec![
        ("no GLB", b"<html>busy</html>".to_vec(), |error| {
            matches!(error, HunyuanError::Import(ImportError::Glb(GlbError::Container(_))))
        }),
        ("truncated", good[..good.len() / 2].to_vec(), |error| {
            matches!(error, HunyuanError::Import(ImportError::Glb(GlbError::Container(_))))
        }),
        ("NaN", container(&bad_numbers.0, &bad_numbers.1), |error| {
            matches!(error, HunyuanError::Import(ImportError::Glb(GlbError::Number { .. })))
        }),
        ("too many triangles", export_glb(&dented_ball(9_000, 1.0)), |error| {
            matches!(
                error,
                HunyuanError::Import(ImportError::Glb(GlbError::TooMany { what: "triangles", .. }))
            )
        }),
        ("non-manifold", with_wall_within(), |error| {
            matches!(error, HunyuanError::Import(ImportError::Unsound { field: "tangled", .. }))
        }),
        ("without area", plain_file(&line), |error| {
            matches!(error, HunyuanError::Import(ImportError::NoArea { .. }))
        }),
        ("of no size that a table has", plain_file(&cuboid([0.0; 3], [1.0, 1.0, 90.0])), |error| {
            matches!(error, HunyuanError::Import(ImportError::Size { .. }))
        }),
    ]
}

#[test]
fn bad_models_are_typed_errors() {
    let import = ImportConfig {
        limits: GlbLimits { triangles: 5_000, ..GlbLimits::default() },
        ..HunyuanConfig::default().import
    };
    for (what, file, is_it) in bad_models() {
        for way in [Way::Job, Way::Wait] {
            let file = file.clone();
            let server = following(move |way| if way == Way::Job { completed(&file) } else { bytes(&file) });
            let config = HunyuanConfig { import, ..config(&server, HunyuanVersion::V2_0, way) };
            let mut generator = HunyuanGenerator::new(config).unwrap();
            let error = error_of(&mut generator, &prompt());
            assert!(is_it(&error), "{what} by {way:?}: {error}");
            assert_eq!(generator.pending(), None, "{what}: there is nothing to go on with");
        }
    }
    // In centimetres it is a table all the same: servers scale as they like.
    let large = plain_file(&cuboid([0.0; 3], [80.0, 130.0, 75.0]));
    let server = following(move |_| completed(&large));
    let size = generator(&server).generate(&prompt()).unwrap().asset.collider.size();
    assert!((size.y - 1.3).abs() < 1e-6 && (size.x - 0.8).abs() < 1e-6, "{size}");
}

#[test]
fn bad_answers_are_typed_errors() {
    let small = ImportConfig {
        limits: GlbLimits { bytes: 2_000, ..GlbLimits::default() },
        ..HunyuanConfig::default().import
    };
    let cases: [Case; 14] = [
        (
            "error",
            || json_answer(&json!({"status": "error", "message": "out of memory"})),
            |error| matches!(error, HunyuanError::Failed { uid, said } if uid == UID && said == "out of memory"),
        ),
        (
            "error as 500",
            || status(500, "", "{\"status\": \"error\", \"message\": \"unreadable\"}"),
            |error| matches!(error, HunyuanError::Failed { uid, said } if uid == UID && said == "unreadable"),
        ),
        (
            "unknown job",
            || status(404, "", "{}"),
            |error| matches!(error, HunyuanError::Lost { uid } if uid == UID),
        ),
        (
            "never finished",
            || json_answer(&json!({"status": "processing"})),
            |error| matches!(error, HunyuanError::Deadline { uid: Some(uid), limit } if uid == UID && limit.as_secs_f64() == 0.8),
        ),
        ("silence", silence, |error| {
            matches!(error, HunyuanError::Transport { .. } | HunyuanError::Deadline { .. })
        }),
        (
            "drip",
            || drips(&" ".repeat(1000)),
            |error| matches!(error, HunyuanError::Transport { .. } | HunyuanError::Deadline { .. }),
        ),
        ("endless", endless, |error| matches!(error, HunyuanError::TooLarge { limit: 2_000 })),
        (
            "too large",
            || completed(&[7; 2_500]),
            |error| matches!(error, HunyuanError::TooLarge { limit: 2_000 }),
        ),
        ("no JSON", || status(200, "", "<html>"), |error| matches!(error, HunyuanError::BadAnswer { .. })),
        (
            "no state",
            || json_answer(&json!({"state": 1})),
            |error| matches!(error, HunyuanError::BadAnswer { .. }),
        ),
        (
            "no model",
            || json_answer(&json!({"status": "completed"})),
            |error| matches!(error, HunyuanError::BadAnswer { reason, .. } if reason.contains("model_base64")),
        ),
        (
            "damaged",
            || json_answer(&json!({"status": "completed", "model_base64": "Z2xURg=*"})),
            |error| matches!(error, HunyuanError::BadAnswer { reason, .. } if reason.contains("damaged")),
        ),
        (
            "cut short",
            || cut_short("{\"status\": \"comp"),
            |error| matches!(error, HunyuanError::Transport { .. }),
        ),
        (
            "broken server",
            || status(503, "", "{\"text\": \"HIGH TRAFFIC\"}"),
            |error| matches!(error, HunyuanError::Busy { status: 503, said, .. } if said == "HIGH TRAFFIC"),
        ),
    ];
    for (what, answer, is_it) in cases {
        let server = following(move |_| answer());
        for version in [HunyuanVersion::V2_0, HunyuanVersion::V2_1] {
            let config = HunyuanConfig { import: small, ..config(&server, version, Way::Job) };
            let error = error_of(&mut HunyuanGenerator::new(config).unwrap(), &prompt());
            assert!(is_it(&error), "{what} of {version:?}: {error:?}");
        }
    }
}

#[test]
fn bad_beginnings_are_typed_errors() {
    let refusal = || status(404, "", "{\"text\": \"PLEASE REGENERATE\", \"error_code\": 1}");
    let cases: [Case; 6] = [
        (
            "switched off",
            refusal,
            |error| matches!(error, HunyuanError::Refused { status: 404, said } if said == "PLEASE REGENERATE"),
        ),
        (
            "no picture",
            || status(422, "", "{\"detail\": [{\"loc\": [\"body\", \"image\"]}]}"),
            |error| matches!(error, HunyuanError::Refused { status: 422, said } if said.contains("image")),
        ),
        (
            "elsewhere",
            || status(302, "Location: http://example.org/\r\n", ""),
            |error| matches!(error, HunyuanError::Refused { status: 302, .. }),
        ),
        (
            "a path",
            || json_answer(&json!({"uid": "../../etc/passwd"})),
            |error| matches!(error, HunyuanError::BadAnswer { .. } | HunyuanError::Import(_)),
        ),
        (
            "a number",
            || json_answer(&json!({"uid": 7})),
            |error| matches!(error, HunyuanError::BadAnswer { .. } | HunyuanError::Import(_)),
        ),
        ("silence", silence, |error| {
            matches!(error, HunyuanError::Deadline { uid: None, .. } | HunyuanError::Transport { .. })
        }),
    ];
    for (what, answer, is_it) in cases {
        for way in [Way::Job, Way::Wait] {
            let server = FaultServer::by_rule(move |_| answer());
            let config = config(&server, HunyuanVersion::V2_0, way);
            let error = error_of(&mut HunyuanGenerator::new(config).unwrap(), &prompt());
            assert!(is_it(&error), "{what} by {way:?}: {error:?}");
        }
    }
    let reset = ResetServer::new();
    let closed = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    for base_url in [reset.url.trim_end_matches("/v1").to_owned(), format!("http://{closed}")] {
        let retry = RetryConfig { attempts: 1, ..RetryConfig::default() };
        let config = HunyuanConfig { base_url, retry, ..HunyuanConfig::default() };
        let error = error_of(&mut HunyuanGenerator::new(config).unwrap(), &prompt());
        assert!(matches!(error, HunyuanError::Transport { .. }), "{error:?}");
    }
}

#[test]
fn what_fails_in_passing_is_asked_again() {
    let glb = export_glb(&table());
    let server = FaultServer::answering([
        status(429, "Retry-After: 0\r\n", ""),
        json_answer(&json!({"uid": UID})),
        status(502, "", ""),
        json_answer(&json!({"status": "processing"})),
        cut_short("{"),
        completed(&glb),
    ]);
    generator(&server).generate(&prompt()).unwrap();
    assert_eq!(server.heard().len(), 6);
}

#[test]
fn a_job_that_was_cut_off_is_gone_on_with() {
    let glb = export_glb(&table());
    let server = FaultServer::answering([
        json_answer(&json!({"uid": UID})),
        raw(""),
        raw(""),
        completed(&glb),
        json_answer(&json!({"uid": "another"})),
        completed(&glb),
    ]);
    let mut first = generator(&server);
    let error = error_of(&mut first, &prompt());
    assert!(matches!(error, HunyuanError::Transport { .. }), "{error:?}");
    // The ticket may have been kept in a file, and another process goes on.
    let kept = serde_json::to_string(first.pending().unwrap()).unwrap();
    let mut second = generator(&server);
    second.resume(serde_json::from_str(&kept).unwrap());
    second.generate(&prompt()).unwrap();
    assert_eq!(second.pending(), None);
    // Done with it: the same prompt is asked anew.
    second.generate(&prompt()).unwrap();
    let heard = server.heard();
    let asked: Vec<&str> = heard.iter().map(|heard| heard.head.lines().next().unwrap()).collect();
    let job = format!("GET /status/{UID} HTTP/1.1");
    assert_eq!(asked[1..4], [&job, &job, &job]);
    assert!(asked[4].starts_with("POST /send") && asked[5].starts_with("GET /status/another"), "{asked:?}");
}

#[test]
#[allow(clippy::disallowed_methods)]
fn it_can_be_given_up_at_any_time() {
    let slow = Arc::new(Mutex::new(true));
    let is_slow = slow.clone();
    let glb = export_glb(&table());
    let server =
        FaultServer::by_rule(move |_| if *is_slow.lock().unwrap() { silence() } else { bytes(&glb) });
    for way in [Way::Wait, Way::Job] {
        *slow.lock().unwrap() = true;
        let config = HunyuanConfig {
            deadline: 60.0,
            answer_timeout: 60.0,
            ..config(&server, HunyuanVersion::V2_0, way)
        };
        let mut generator = HunyuanGenerator::new(config).unwrap();
        let canceller = generator.canceller();
        let start = Instant::now();
        let watch = std::thread::spawn(move || {
            std::thread::sleep(Duration::from_millis(150));
            canceller.cancel();
        });
        assert_eq!(error_of(&mut generator, &prompt()), HunyuanError::Cancelled);
        assert!(start.elapsed() < Duration::from_secs(2), "{:?}", start.elapsed());
        watch.join().unwrap();
        // The next one is another matter.
        *slow.lock().unwrap() = false;
        if way == Way::Wait {
            generator.generate(&prompt()).unwrap();
        }
        generator.canceller().cancel();
        assert_eq!(error_of(&mut generator, &prompt()), HunyuanError::Cancelled, "before it began");
    }
}

#[test]
fn runs_with_made_assets_replay_without_the_server() {
    let server = following(|_| completed(&export_glb(&table())));
    let asset = generator(&server).generate(&prompt()).unwrap().asset;
    drop(server);
    let mut run = Simulation::new(World::new());
    run.set_trail_interval(1);
    run.submit(Command::AddAsset(Box::new(asset.clone())));
    run.step().unwrap();
    let id = run.world().assets().unwrap().find(&asset.name).unwrap();
    run.submit(Command::Spawn(Box::new(asset.at(id, Pose::identity()))));
    run.step().unwrap();
    // Through a file.
    let file = postcard::to_stdvec(run.recording()).unwrap();
    let recording: simworld_core::record::Recording = postcard::from_bytes(&file).unwrap();
    let mut again = Simulation::new(World::new());
    for _ in 0..2 {
        let tick = again.world().clock().tick();
        for command in recording.commands_at(tick) {
            again.submit(command.clone());
        }
        again.step().unwrap();
        let tick = again.world().clock().tick();
        assert!(recording.trail.iter().any(|(at, _)| *at == tick), "there is a digest to compare with");
        recording.confirm(tick, again.world().digest()).unwrap();
    }
    assert_eq!(again.world().digest(), run.world().digest());
    assert_eq!(again.world().assets().unwrap().get(id), Some(&asset));
}

#[test]
fn configurations_that_cannot_work_are_refused() {
    let good = HunyuanConfig::default;
    let wrong = [
        HunyuanConfig { base_url: "ftp://host".into(), ..good() },
        HunyuanConfig { base_url: "http://user:hunter22@host".into(), ..good() },
        HunyuanConfig { deadline: 0.0, ..good() },
        HunyuanConfig { first_poll: f64::NAN, ..good() },
        HunyuanConfig { octree_resolution: 1024, ..good() },
        HunyuanConfig { retry: RetryConfig { attempts: 0, ..RetryConfig::default() }, ..good() },
        HunyuanConfig { version: HunyuanVersion::V2_1, ..good() },
        HunyuanConfig { key_variable: Some("SIMWORLD_NO_SUCH_VARIABLE".into()), ..good() },
    ];
    for config in wrong {
        let error = HunyuanGenerator::new(config.clone()).err().unwrap_or_else(|| panic!("{config:?}"));
        assert!(matches!(error, HunyuanError::Config(_)), "{error:?}");
        assert!(!error.to_string().contains("hunter22"));
    }
    let too_long = AssetPrompt::new("word ".repeat(200));
    let error = HunyuanGenerator::new(good()).unwrap().generate(&too_long).unwrap_err();
    assert!(matches!(error, GenerateError::TooLong { .. }), "{error}");
}
