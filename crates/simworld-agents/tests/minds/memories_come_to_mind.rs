//! What a memory keeps, and what comes to mind first.
#![cfg(feature = "thought")]

use proptest::prelude::*;
use simworld_agents::thought::{Memory, MemoryConfig, Record, RecordKind, RingMemory};

fn saw(at: f64, text: &str, importance: u8) -> Record {
    Record::new(at, RecordKind::Saw, text.to_owned(), importance)
}

fn memory_of(config: MemoryConfig, records: &[Record]) -> RingMemory {
    let mut memory = RingMemory::new(config).expect("the settings are sound");
    for record in records {
        memory.remember(record.clone());
    }
    memory
}

fn texts(records: &[Record]) -> Vec<&str> {
    records.iter().map(|record| record.text.as_str()).collect()
}

#[test]
fn each_of_the_three_decides_where_the_others_do_not() {
    let only = |recency, relevance, importance| MemoryConfig {
        recency,
        relevance,
        importance,
        ..Default::default()
    };
    let records = [
        saw(0.0, "a quarrel at the harbour", 9),
        saw(100.0, "the kiosk sells coffee", 2),
        saw(200.0, "a dog in the park", 1),
    ];
    let best = |config, question: &str| {
        let mut memory = memory_of(config, &records);
        memory.recall(question, 300.0, 1)[0].text.clone()
    };
    assert_eq!(best(only(1.0, 0.0, 0.0), "coffee"), "a dog in the park");
    assert_eq!(best(only(0.0, 1.0, 0.0), "where is coffee to be had?"), "the kiosk sells coffee");
    assert_eq!(best(only(0.0, 0.0, 1.0), "coffee"), "a quarrel at the harbour");
    assert_eq!(best(MemoryConfig::default(), "coffee at the kiosk"), "the kiosk sells coffee");
}

#[test]
fn what_came_to_mind_stays_near() {
    let recency = MemoryConfig { relevance: 0.0, importance: 0.0, half_life: 60.0, ..Default::default() };
    let records = [saw(0.0, "old", 1), saw(1000.0, "new", 1)];
    let mut memory = memory_of(recency, &records);
    assert_eq!(texts(&memory.recall("", 1000.0, 1)), ["new"]);
    assert_eq!(texts(&memory.recall("", 1500.0, 2)), ["new", "old"]);
    memory.remember(saw(1600.0, "newest", 1));
    assert_eq!(texts(&memory.recall("", 1600.0, 3)), ["newest", "new", "old"]);
    // The old one was recalled at 1600, as late as the newest came: of two alike the newer is first.
    let mut other = memory_of(recency, &records);
    other.recall("", 5000.0, 1);
    other.remember(saw(4000.0, "between", 1));
    assert_eq!(texts(&other.recall("", 6000.0, 1)), ["new"], "recalled at 5000, it is nearer than 4000");
}

#[test]
fn settings_out_of_range_are_refused() {
    for (config, field) in [
        (MemoryConfig { capacity: 0, ..Default::default() }, "capacity"),
        (MemoryConfig { half_life: f64::NAN, ..Default::default() }, "half_life"),
        (MemoryConfig { relevance: -1.0, ..Default::default() }, "relevance"),
    ] {
        assert_eq!(RingMemory::new(config).map(|_| ()).map_err(|error| error.field), Err(field));
    }
}

proptest! {
    #[test]
    fn the_newest_are_kept_and_the_best_come_first(
        notes in prop::collection::vec(("[a-e ]{0,12}", 0_u8..12, 0.0_f64..1e4), 0..60),
        question in "[a-e ]{0,12}",
        capacity in 1_usize..40,
        most in 0_usize..50,
    ) {
        let records: Vec<Record> = notes.iter().map(|(text, weight, at)| saw(*at, text, *weight)).collect();
        let mut memory = memory_of(MemoryConfig { capacity, ..Default::default() }, &records);
        let kept = records.len().min(capacity);
        prop_assert!(memory.records().eq(records[records.len() - kept..].iter()));

        let saved = memory.save();
        let first = memory.recall(&question, 2e4, most);
        prop_assert_eq!(first.len(), most.min(kept));
        prop_assert!(first.iter().all(|record| record.recalled == 2e4 && (1..=10).contains(&record.importance)));
        // From saved bytes the same comes to mind, and a shorter list is the beginning of a longer.
        let mut again = memory_of(MemoryConfig { capacity, ..Default::default() }, &[]);
        prop_assert!(again.restore(&saved));
        let fewer = again.recall(&question, 2e4, most / 2);
        prop_assert_eq!(&fewer[..], &first[..fewer.len()]);
        prop_assert!(!again.restore(&[255, 255, 255]));
    }
}
