//! Experiments of the paper: what is finished is kept, and what is gone on with ends as if it had not been interrupted.

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, Row};
use simworld_core::seed::Seed;
use simworld_examples::delivery::{OutputFolder, RunConfig, Watch, play, read_log, resume};
use simworld_examples::experiment::{Arm, ExperimentError, Preset, Results, Trial, conduct, keep_rows};

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

/// The run that is killed, with a checkpoint every so many steps.
fn killed() -> RunConfig {
    RunConfig { seeds: 1, checkpoint_interval: 30, ..simworld_tests::small(400) }
}

/// Not a test by itself: the run that the next one kills.
#[test]
fn a_run_that_is_killed() {
    let Some(path) = std::env::var_os(KILLED) else { return };
    play(&killed(), &OutputFolder::create(path.as_ref()).unwrap(), &Watch::silent()).unwrap();
}

/// What a run that went on says of it, if it did.
fn resumed(run: &Path) -> String {
    fs::read_to_string(run.join("seed-3/resumed.txt")).unwrap_or_default()
}

#[test]
fn whoever_is_killed_leaves_a_whole_log_and_goes_on_to_the_same_end() {
    let folder = tempfile::tempdir().unwrap();
    let whole = folder.path().join("whole");
    let expected = play(&killed(), &OutputFolder::create(&whole).unwrap(), &Watch::silent()).unwrap();
    let whole_log = whole.join("seed-3/events.jsonl");
    let mut rng = Seed(8).stream("test/kill").rng();
    let moments = if std::env::var_os("SIMWORLD_SOAK").is_some() { 40 } else { 3 };
    let (mut cut, mut went_on) = (0, 0);
    for moment in 0..moments {
        let path = folder.path().join(format!("run-{moment}"));
        let log = path.join("seed-3/events.jsonl");
        let mut child = std::process::Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "experiments_resume::a_run_that_is_killed"])
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
        assert!(
            read_log(&whole_log).unwrap().recording.trail.starts_with(&left.recording.trail),
            "the log is whole up to its end"
        );
        let again = resume(&OutputFolder::open(&path).unwrap(), &Watch::silent()).unwrap();
        assert_eq!(again, expected);
        went_on += usize::from(resumed(&path).starts_with("went on from step "));
        for file in ["events.jsonl", "track.jsonl", "hashes.csv", "map.svg", "report.json"] {
            let of = |run: &Path| fs::read(run.join("seed-3").join(file)).unwrap();
            assert!(of(&path) == of(&whole), "{file} is that of a run that was not cut off");
        }
    }
    assert!(cut > 0, "nobody was killed in time");
    assert!(went_on > 0, "nobody went on from a checkpoint");
}

#[test]
fn a_checkpoint_that_is_damaged_is_left_out_for_the_one_before() {
    let folder = tempfile::tempdir().unwrap();
    let whole = folder.path().join("whole");
    let expected = play(&killed(), &OutputFolder::create(&whole).unwrap(), &Watch::silent()).unwrap();
    let stopped = folder.path().join("stopped");
    let out = OutputFolder::create(&stopped).unwrap();
    // Somebody interrupts it as soon as the second progress is shown.
    let stop = Arc::new(AtomicBool::new(false));
    let asked = Arc::clone(&stop);
    let watch = Watch::new(stop, move |_, _| {
        let asked = Arc::clone(&asked);
        Box::new(move |step, _| asked.store(step >= 100, Ordering::Relaxed))
    });
    assert_eq!(play(&killed(), &out, &watch).unwrap().seeds[0].steps, 100);
    let checkpoint = |step: u64| stopped.join(format!("seed-3/checkpoint-{step:09}.bin"));
    assert!(checkpoint(100).is_file() && checkpoint(90).is_file() && !checkpoint(60).exists());
    let mut bytes = fs::read(checkpoint(100)).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 4;
    fs::write(checkpoint(100), &bytes).unwrap();
    let again = resume(&OutputFolder::open(&stopped).unwrap(), &Watch::silent()).unwrap();
    assert_eq!(again, expected);
    let notes = resumed(&stopped);
    assert_eq!(
        notes,
        "checkpoint-000000100.bin was left out: it is damaged\nwent on from step 90, by checkpoint-000000090.bin\n"
    );
    assert!(!checkpoint(90).exists(), "a finished run needs none");
}

#[test]
fn without_a_sound_checkpoint_a_run_begins_anew() {
    let folder = tempfile::tempdir().unwrap();
    let (config, path) = (killed(), folder.path().join("run"));
    let expected = play(&config, &OutputFolder::create(&path).unwrap(), &Watch::silent()).unwrap();
    let seed = path.join("seed-3");
    fs::remove_file(seed.join("report.json")).unwrap();
    fs::write(seed.join("checkpoint-000000050.bin"), b"nothing of the kind").unwrap();
    let again = resume(&OutputFolder::open(&path).unwrap(), &Watch::silent()).unwrap();
    assert_eq!(again, expected);
    assert_eq!(resumed(&path), "checkpoint-000000050.bin was left out: it is damaged\nbegan anew\n");
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

#[test]
fn rows_read_back_from_parquet_are_those_of_the_trials() {
    let folder = tempfile::tempdir().unwrap();
    let out = OutputFolder::create(&folder.path().join("out")).unwrap();
    let trials = run(&arms(Preset::Competition), &out).unwrap();
    keep_rows(&trials, &out).unwrap();
    // Row by row, where they were written column by column.
    let read = |name: &str| -> Vec<Row> {
        let file = fs::File::open(out.path().join(name)).unwrap();
        SerializedFileReader::new(file).unwrap().get_row_iter(None).unwrap().map(Result::unwrap).collect()
    };
    let field = |row: &Row, name: &str| -> Field {
        row.get_column_iter().find(|column| column.0 == name).unwrap_or_else(|| panic!("no {name}")).1.clone()
    };
    let couriers = read("couriers.parquet");
    assert_eq!(couriers.len(), trials.iter().map(|trial| trial.players.len()).sum::<usize>());
    let expected = trials.iter().flat_map(|trial| {
        let rows = trial.players.iter().zip(&trial.report.couriers).enumerate();
        rows.map(move |(index, (player, row))| (trial, index, player, row))
    });
    for (read, (trial, index, player, row)) in couriers.iter().zip(expected) {
        assert_eq!(field(read, "setting"), Field::Str(trial.arm.clone()));
        assert_eq!(field(read, "seed"), Field::Long(trial.seed as i64));
        assert_eq!(field(read, "courier"), Field::Long(index as i64));
        assert_eq!(field(read, "policy"), Field::Str(player.policy.to_string()));
        assert_eq!(field(read, "neuroticism"), Field::Double(player.persona.neuroticism));
        assert_eq!(field(read, "profit"), Field::Double(row.profit.dollars()));
        assert_eq!(field(read, "distance"), Field::Double(row.distance));
        assert_eq!(field(read, "bids"), Field::Long(i64::from(row.bids)));
        for (name, count) in &row.actions {
            assert_eq!(field(read, &format!("action_{name}")), Field::Long(i64::from(*count)));
        }
    }
    let bids = read("bids.parquet");
    let kept: usize = trials.iter().flat_map(|trial| &trial.auctions).map(|auction| auction.bids.len()).sum();
    assert_eq!(bids.len(), kept);
    let won = bids.iter().filter(|row| field(row, "won") == Field::Bool(true)).count();
    let winners = trials.iter().flat_map(|trial| &trial.auctions).filter(|auction| auction.winner.is_some());
    assert_eq!(won, winners.count());
    let asked: f64 = bids
        .iter()
        .map(|row| match field(row, "price") {
            Field::Double(price) => price,
            other => panic!("{other}"),
        })
        .sum();
    let all = trials.iter().flat_map(|trial| &trial.auctions).flat_map(|auction| &auction.bids);
    assert!((asked - all.map(|bid| bid.1).sum::<f64>()).abs() < 1e-6);
    let metrics = read("metrics.parquet");
    assert_eq!(metrics.len(), trials.iter().map(|trial| trial.metrics.len()).sum::<usize>());
    assert_eq!(field(&metrics[0], "value"), Field::Double(trials[0].metrics[0].1));
}
