//! Experiments of the paper: what is finished is kept, and what is gone on with ends as if it had not been interrupted.

use std::fs;

use simworld_core::seed::Seed;
use simworld_examples::delivery::{OutputFolder, RunConfig, Watch, play, read_log, resume};
use simworld_examples::experiment::{Arm, ExperimentError, Preset, Results, Trial, conduct};

/// A small experiment over the levels of a preset.
fn arms(preset: Preset) -> Vec<Arm> {
    let base = RunConfig {
        seeds: 2,
        agents: 6,
        steps: 400,
        vehicles: 4,
        pedestrians: 4,
        frames: 0,
        ..RunConfig::default()
    };
    let mut arms = preset.arms(&base);
    arms.truncate(2);
    for arm in &mut arms {
        (arm.config.agents, arm.config.steps) = (6, 400);
        arm.config.policies.truncate(6);
    }
    arms
}

fn run(arms: &[Arm], folder: &OutputFolder) -> Result<Vec<Trial>, ExperimentError> {
    conduct(arms, folder, &Watch::silent())
}

#[test]
fn what_is_gone_on_with_ends_as_if_it_had_not_been_interrupted() {
    let folder = tempfile::tempdir().unwrap();
    let out = OutputFolder::create(&folder.path().join("whole")).unwrap();
    let arms = arms(Preset::Orders);
    let whole = run(&arms, &out).unwrap();
    assert_eq!(whole.len(), 4);
    // One trial is lost, another was cut off while it was written.
    let file = |arm: &Arm, seed: u64| out.path().join(format!("trials/{}-seed-{seed}.json", arm.name));
    fs::remove_file(file(&arms[0], 2)).unwrap();
    let cut = fs::read(file(&arms[1], 1)).unwrap();
    fs::write(file(&arms[1], 1), &cut[..cut.len() / 2]).unwrap();
    let again = run(&arms, &OutputFolder::open(out.path()).unwrap()).unwrap();
    assert_eq!(again, whole);
    assert_eq!(Results::of(Preset::Orders, &again), Results::of(Preset::Orders, &whole));
}

/// The folder of the run that is killed, for the process that plays it.
const KILLED: &str = "SIMWORLD_KILLED_RUN";

/// Not a test by itself: the run that the next one kills.
#[test]
fn a_run_that_is_killed() {
    let Some(path) = std::env::var_os(KILLED) else { return };
    let config = RunConfig { seeds: 1, ..simworld_tests::small(400) };
    play(&config, &OutputFolder::create(path.as_ref()).unwrap(), &Watch::silent()).unwrap();
}

#[test]
fn whoever_is_killed_leaves_a_whole_log_and_goes_on_to_the_same_end() {
    let folder = tempfile::tempdir().unwrap();
    let config = RunConfig { seeds: 1, ..simworld_tests::small(400) };
    let expected =
        play(&config, &OutputFolder::create(&folder.path().join("whole")).unwrap(), &Watch::silent());
    let expected = expected.unwrap().seeds[0].digest;
    let whole_log = folder.path().join("whole/seed-3/events.jsonl");
    let mut rng = Seed(8).stream("test/kill").rng();
    let moments = if std::env::var_os("SIMWORLD_SOAK").is_some() { 40 } else { 3 };
    let mut cut = 0;
    for moment in 0..moments {
        let path = folder.path().join(format!("run-{moment}"));
        let log = path.join("seed-3/events.jsonl");
        let mut child = std::process::Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "a_run_that_is_killed"])
            .env(KILLED, &path)
            .stdout(std::process::Stdio::null())
            .spawn()
            .unwrap();
        // At any moment from its first lines on: once so much of the log is written, however fast that is.
        let length = |log: &std::path::Path| fs::metadata(log).map_or(0, |file| file.len());
        let moment = 2000 + rng.below(length(&whole_log).saturating_sub(2000) as usize * 4 / 5) as u64;
        while length(&log) < moment && child.try_wait().unwrap().is_none() {
            std::thread::sleep(std::time::Duration::from_micros(100));
        }
        child.kill().unwrap(); // SIGKILL where there are signals
        child.wait().unwrap();
        let left = read_log(&log).unwrap();
        assert!(left.end.0 > 0 || left.recording.trail.is_empty());
        cut += usize::from(left.broken_off.is_some());
        let whole = read_log(&whole_log).unwrap();
        assert!(whole.recording.trail.starts_with(&left.recording.trail), "the log is whole up to its end");
        let resumed = resume(&OutputFolder::open(&path).unwrap(), &Watch::silent()).unwrap();
        assert_eq!(resumed.seeds[0].digest, expected);
    }
    assert!(cut > 0, "nobody was killed in time");
}

#[test]
fn other_settings_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let out = OutputFolder::create(&folder.path().join("out")).unwrap();
    let mut arms = arms(Preset::Persona);
    arms[0].config.steps = 20;
    run(&arms, &out).unwrap();
    arms[0].config.steps = 30;
    let error = run(&arms, &out).unwrap_err();
    assert!(matches!(error, ExperimentError::OtherSettings { .. }) && error.to_string().contains("--out"));
}

#[test]
fn every_bid_is_in_an_auction_and_every_courier_in_a_table() {
    let folder = tempfile::tempdir().unwrap();
    let out = OutputFolder::create(&folder.path().join("out")).unwrap();
    let arms = arms(Preset::Competition);
    let trials = run(&arms, &out).unwrap();
    for trial in &trials {
        let bids: u32 = trial.report.couriers.iter().map(|row| row.bids).sum();
        let won: u32 = trial.report.couriers.iter().map(|row| row.won).sum();
        let kept: usize = trial.auctions.iter().map(|auction| auction.bids.len()).sum();
        let winners = trial.auctions.iter().filter(|auction| auction.winner.is_some()).count();
        // A later bid replaces an earlier one of the same courier.
        assert!(bids > 0 && kept > 0 && kept <= bids as usize, "{kept} of {bids} bids");
        assert_eq!(winners, won as usize);
        assert_eq!(trial.auctions.len(), trial.report.posted as usize);
        for auction in &trial.auctions {
            assert!(auction.winner.is_none_or(|winner| auction.bids.iter().any(|bid| bid.0 == winner)));
            assert!(auction.bids.iter().all(|bid| bid.1 > 0.0 && bid.1 <= auction.ceiling + 1e-9));
        }
    }
    let results = Results::of(Preset::Competition, &trials);
    assert_eq!(results.tables[0].rows.len(), arms[0].config.policies.len());
}
