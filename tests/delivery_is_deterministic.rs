//! The whole delivery run gives the same bits: twice, on any number of threads, across a snapshot, and from its log.

use simworld_core::clock::Tick;
use simworld_core::hash::{StateDigest, StateHash};
use simworld_core::scene::Scene;
use simworld_examples::delivery::{OutputFolder, Watch, play, read_log, replay};
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
