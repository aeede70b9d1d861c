//! The whole delivery run gives the same bits: twice, on any number of threads, across a snapshot, and from its log.

use simworld_agents::delivery::PolicyKind;
use simworld_agents::model::{ChatModel, ChatReply, ChatRequest, Part, Scripted};
use simworld_core::clock::Tick;
use simworld_core::hash::{StateDigest, StateHash};
use simworld_core::scene::Scene;
use simworld_core::seed::Seed;
use simworld_examples::delivery::{
    Brain, OutputFolder, ThinkError, Thinkers, Watch, assemble_with, make_city, play, read_log, replay,
};
use simworld_tests::{assembled, small};

/// Whole runs under `SIMWORLD_SOAK=1`, shorter ones otherwise.
fn steps() -> u64 {
    if std::env::var_os("SIMWORLD_SOAK").is_some() { 5000 } else { 2000 }
}

fn trail(steps: u64) -> Vec<(Tick, StateDigest)> {
    let (_, mut assembly) = assembled(&small(steps));
    while !assembly.episode.is_over() {
        assembly.episode.step().expect("a sound run steps");
    }
    assembly.episode.trail().to_vec()
}

#[test]
fn same_seed_same_bits_on_one_two_and_eight_threads() {
    let expected = trail(steps());
    assert_eq!(expected.len() as u64, steps() / 5);
    for threads in [1, 2, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let found = pool.install(|| trail(steps()));
        assert_eq!(found, expected, "another trail on {threads} threads");
    }
}

#[test]
fn another_seed_is_another_run() {
    let mut config = small(100);
    let (_, mut first) = assembled(&config);
    config.seed += 1;
    let (_, mut second) = assembled(&config);
    first.episode.step().unwrap();
    second.episode.step().unwrap();
    assert_ne!(first.episode.digest(), second.episode.digest());
}

#[test]
fn save_load_continue_is_a_straight_run() {
    let expected = trail(steps());
    let halt = steps() / 2;
    let (_, mut first) = assembled(&small(steps()));
    for _ in 0..halt {
        first.episode.step().unwrap();
    }
    let bytes = postcard::to_stdvec(&first.episode.save().unwrap()).unwrap();
    drop(first);
    let (_, mut second) = assembled(&small(steps()));
    second.episode.restore(postcard::from_bytes(&bytes).unwrap()).unwrap();
    assert_eq!(second.episode.simulation().world().clock().tick(), Tick(halt));
    while !second.episode.is_over() {
        second.episode.step().unwrap();
    }
    let rest: Vec<_> = expected.into_iter().filter(|(tick, _)| tick.0 > halt).collect();
    assert_eq!(second.episode.trail(), rest);
}

#[test]
fn a_log_replays_and_confirms_every_hash() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run");
    let config = small(steps());
    let report = play(&config, &OutputFolder::create(&path).unwrap(), &Watch::silent()).unwrap();
    let confirmed = replay(&path, &Watch::silent()).unwrap();
    for ((seed, end, hashes, broken_off), played) in confirmed.seeds.iter().zip(&report.seeds) {
        assert_eq!((*seed, end.0, *hashes as u64), (played.seed, steps(), steps() / 5));
        assert_eq!(*broken_off, None);
    }

    // A log in which one bid was raised leads elsewhere, and the replay says so.
    let log = path.join("seed-3/events.jsonl");
    let text = std::fs::read_to_string(&log).unwrap();
    let forged = text.replacen("\"bid_order\"", "\"do_nothing\"", 1);
    assert_ne!(text, forged, "somebody bid");
    std::fs::write(&log, forged).unwrap();
    let error = replay(&path, &Watch::silent()).unwrap_err();
    assert!(error.to_string().contains("leaves the recording at tick"), "{error}");
}

/// Bids half of what is offered for the first order that it reads of, and else lets the moment pass.
fn scripted(request: &ChatRequest) -> ChatReply {
    let schema = request.schema.as_ref().expect("couriers ask by schemas");
    if schema.name == "thought" {
        return ChatReply::of(r#"{"thought": "I bid for what is there."}"#);
    }
    let words: Vec<&str> = request.messages[1]
        .content
        .iter()
        .filter_map(|part| if let Part::Text(text) = part { Some(text.as_str()) } else { None })
        .collect();
    let offer = words.concat().lines().find(|line| line.contains("at most")).map(str::to_owned);
    let number = |line: &str, after: &str| -> Option<i64> {
        line.split_once(after)?.1.split_whitespace().next()?.parse().ok()
    };
    let bid = offer.and_then(|line| Some((number(&line, "order ")?, number(&line, "at most ")? / 2)));
    let free = schema.json.to_string().contains("bid_order");
    let deed = match bid.filter(|_| free) {
        Some((order, cents)) => format!(r#"{{"act": "bid_order", "order": "{order}", "cents": {cents}}}"#),
        None => r#"{"act": "do_nothing"}"#.to_owned(),
    };
    ChatReply::of(format!(r#"{{"because": "it pays", "deed": {deed}}}"#))
}

#[test]
fn couriers_with_models_play_again_from_their_tape_without_the_model() {
    let folder = tempfile::tempdir().unwrap();
    let mut config = small(300);
    config.policies = vec![Brain::Model, Brain::Policy(PolicyKind::Lowballer)];
    config.model.tape = Some(folder.path().join("tape"));
    let (city, _) = make_city(&config).unwrap();
    let run = |thinkers: Thinkers| {
        let mut assembly = assemble_with(&config, &city, Seed(3), Some(thinkers)).unwrap();
        while !assembly.episode.is_over() {
            assembly.episode.step().unwrap();
        }
        let report = assembly.episode.task().report().unwrap();
        let bids: u32 = report.couriers.iter().step_by(2).map(|row| row.bids).sum();
        (assembly.episode.trail().to_vec(), bids, assembly.thinkers.unwrap().usage(300))
    };
    let model = || Ok(Box::new(Scripted::rule(|request| Ok(scripted(request)))) as Box<dyn ChatModel>);
    let (trail, bids, usage) = run(Thinkers::with_backend(&config.model, Seed(3), model).unwrap());
    assert!(bids > 0 && usage.couriers == 4 && usage.answered == usage.requests, "{bids} bids, {usage:?}");
    assert!(usage.requests * 50 <= usage.paper_requests, "{usage}");
    let (again, _, replayed) = run(Thinkers::new(&config.model, Seed(3)).unwrap());
    assert_eq!((again, replayed.answered, replayed.requests), (trail, 0, usage.requests));
    // Without a recording and without a server there is nobody.
    assert!(matches!(Thinkers::new(&config.model, Seed(4)), Err(ThinkError::Nobody)));
}

#[test]
fn bodies_that_are_points_far_out_go_on_from_a_snapshot_and_never_jump() {
    let mut config = small(800);
    config.physical_within = 60.0;
    let (_, mut straight) = assembled(&config);
    assert!(straight.physical < config.agents, "some begin as points");
    let place = |assembly: &simworld_examples::delivery::Assembly, index: usize| {
        assembly.episode.simulation().world().entity(assembly.couriers[index]).unwrap().planar()
    };
    let mut saved = None;
    let mut crossed = 0;
    while !straight.episode.is_over() {
        let before: Vec<_> = (0..8).map(|index| place(&straight, index)).collect();
        straight.episode.step().unwrap();
        for (index, from) in before.into_iter().enumerate() {
            let to = place(&straight, index);
            // The limit of scooters, 25 km/h, and a little for who is pushed out of a wall.
            assert!((to - from).norm() < 0.75, "courier {index} jumped {:.2} m", (to - from).norm());
            crossed += usize::from((from.coords.norm() <= 60.0) != (to.coords.norm() <= 60.0));
        }
        if straight.episode.simulation().world().clock().tick() == Tick(400) {
            saved = Some(postcard::to_stdvec(&straight.episode.save().unwrap()).unwrap());
        }
    }
    assert!(crossed > 0, "nobody came or went");
    let (_, mut resumed) = assembled(&config);
    resumed.episode.restore(postcard::from_bytes(&saved.unwrap()).unwrap()).unwrap();
    while !resumed.episode.is_over() {
        resumed.episode.step().unwrap();
    }
    assert!(straight.episode.trail().ends_with(resumed.episode.trail()));
    assert_eq!(straight.episode.digest(), resumed.episode.digest());
}

#[test]
fn a_log_cut_short_replays_up_to_its_end() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run");
    let config = simworld_examples::delivery::RunConfig { seeds: 1, ..small(200) };
    play(&config, &OutputFolder::create(&path).unwrap(), &Watch::silent()).unwrap();
    let log = path.join("seed-3/events.jsonl");
    let bytes = std::fs::read(&log).unwrap();
    for share in [0.5, 0.9, 0.999] {
        std::fs::write(&log, &bytes[..(bytes.len() as f64 * share) as usize]).unwrap();
        let read = read_log(&log).unwrap();
        assert!(read.broken_off.is_some(), "a cut is noticed");
        let confirmed = replay(&path, &Watch::silent()).unwrap();
        let (_, end, hashes, _) = &confirmed.seeds[0];
        assert_eq!(*hashes as u64, end.0 / 5);
    }
}
