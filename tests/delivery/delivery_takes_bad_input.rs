//! Wrong files, wrong numbers, wrong folders: a typed error with its place, never a panic.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use proptest::prelude::*;
use simworld_examples::delivery::{
    OutputError, OutputFolder, RunConfig, Watch, make_city, play, read_log, replay,
};
use simworld_tests::small;

#[test]
fn a_folder_that_holds_something_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("thesis.txt"), "years of work").unwrap();
    let error = OutputFolder::create(folder.path()).unwrap_err();
    assert!(matches!(error, OutputError::NotEmpty { .. }), "{error}");
    assert!(error.to_string().contains("--out"), "{error}");
    let under_a_file = OutputFolder::create(&folder.path().join("thesis.txt/run")).unwrap_err();
    assert!(matches!(under_a_file, OutputError::NotWritable { .. }), "{under_a_file}");
}

#[test]
fn a_city_that_is_not_there_leaves_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    let stem = folder.path().join("run");
    let numbered = || OutputFolder::create_numbered(stem.to_str().unwrap()).unwrap();
    let config = RunConfig { city_file: Some(folder.path().join("gone.simcity")), ..small(10) };
    let output = numbered();
    let error = play(&config, &output, &Watch::silent()).unwrap_err();
    assert!(error.to_string().contains("gone.simcity"), "{error}");
    assert!(std::fs::read_dir(output.path()).unwrap().next().is_none(), "the folder is empty");
    assert_eq!(numbered().path(), output.path(), "the next run takes it");
    output.write("config.toml", "").unwrap();
    assert_ne!(numbered().path(), output.path());
}

#[test]
fn an_interrupted_run_leaves_a_whole_log() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run");
    let stop = Arc::new(AtomicBool::new(false));
    let asked = Arc::clone(&stop);
    // As Ctrl-C in the middle: the flag is raised while the run is under way.
    let watch = Watch::new(stop, move |_, _| {
        let asked = Arc::clone(&asked);
        Box::new(move |step, _| asked.store(step >= 100, Ordering::Relaxed))
    });
    let report = play(&small(5000), &OutputFolder::create(&path).unwrap(), &watch).unwrap();
    assert!(report.seeds.iter().all(|seed| seed.steps < 5000), "the run was stopped");
    let log = read_log(&path.join("seed-3/events.jsonl")).unwrap();
    assert_eq!(log.broken_off, None, "the log has its end");
    let confirmed = replay(&path, &Watch::silent()).unwrap();
    assert!(confirmed.seeds.iter().any(|(_, end, hashes, _)| end.0 >= 100 && *hashes > 10));
}

#[test]
fn roads_that_are_no_roads_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("roads.json");
    let config = RunConfig { roads: Some(path.clone()), ..small(10) };
    let missing = make_city(&config).unwrap_err();
    assert!(missing.to_string().contains("roads.json"), "{missing}");
    std::fs::write(&path, br#"{"roads":[{"start":{"x":0,"y":0},"end":{"x":"#).unwrap();
    let truncated = make_city(&config).unwrap_err();
    assert!(truncated.to_string().contains("roads.json: at roads[0].end"), "{truncated}");
    std::fs::write(
        &path,
        br#"{"roads":[
        {"start":{"x":-150,"y":0},"end":{"x":150,"y":0},"is_highway":false},
        {"start":{"x":0,"y":-150},"end":{"x":0,"y":150},"is_highway":false}]}"#,
    )
    .unwrap();
    let (city, warnings) = make_city(&config).unwrap();
    assert_eq!(city.network.roads.len(), 4);
    assert_eq!(warnings.len(), 2, "both roads were split: {warnings:?}");
}

#[test]
fn a_folder_without_a_run_cannot_be_replayed() {
    let folder = tempfile::tempdir().unwrap();
    let error = replay(folder.path(), &Watch::silent()).unwrap_err();
    assert!(error.to_string().contains("config.toml"), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn arbitrary_bytes_are_no_log(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("events.jsonl");
        std::fs::write(&path, bytes).unwrap();
        prop_assert!(read_log(&path).is_err());
    }

    #[test]
    fn arbitrary_text_is_read_or_refused(text in "[a-z_.= \\[\\]0-9\"\n-]{0,200}") {
        let _ = RunConfig::parse(&text, Path::new("run.toml"));
    }

    #[test]
    fn arbitrary_numbers_are_read_or_refused(
        seeds in any::<u32>(), agents in any::<u32>(), steps in any::<u64>(), length in any::<f64>(), green in any::<f64>(),
    ) {
        let mut config = RunConfig { seeds, agents, steps, ..RunConfig::default() };
        config.city.roads.length = length;
        config.city.network.green = green;
        if let Err(error) = config.validate() {
            prop_assert!(error.to_string().contains("give"), "{}", error);
        }
    }
}
