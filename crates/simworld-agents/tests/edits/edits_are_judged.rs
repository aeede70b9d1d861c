//! What people ask of the scene in five cities: carried out, judged from outside, and scored by family.
//!
//! The sentences in `tests/edits` were written by strangers to the grammar that reads them, but for the first. The judge compares the world before and
//! after: the relation that was asked for holds, nothing else changed, nothing floats or runs into another thing.

use std::collections::BTreeMap;
use std::panic::resume_unwind;
use std::thread;

use crate::city::City;
use crate::edits_common::{
    Asked, CITIES, Verdict, asked_elsewhere, is_whole, sampled_in, sampled_of_taught_in, verdict,
};

/// What each family scores at least, in percent. Raise it when the grammar learns; never lower it but for new sentences.
const FLOORS: [(&str, f64); 15] = [
    ("spacing", 97.0),
    ("streets", 97.0),
    ("areas", 97.0),
    ("offsets", 97.0),
    ("conditions", 97.0),
    ("environment", 97.0),
    ("counts", 97.0),
    ("single_relation", 97.0),
    ("nested_anchor", 97.0),
    ("multi_object", 97.0),
    ("other_verbs", 97.0),
    ("ambiguous", 97.0),
    ("unsatisfiable", 97.0),
    ("paraphrase", 97.0),
    ("typo", 97.0),
];

#[derive(Default)]
struct Score {
    right: usize,
    all: usize,
    wrong_edits: usize,
}

impl Score {
    fn count(&mut self, verdict: &Verdict) {
        self.all += 1;
        self.right += usize::from(*verdict == Verdict::Right);
        self.wrong_edits += usize::from(matches!(verdict, Verdict::WrongEdit(_)));
    }
}

/// One thing that was asked in a city, and how it was answered.
type Judged = (&'static str, Asked, Verdict);

/// All that is asked and how it is answered, city by city; each city is judged on a thread of its own, and the order is always the same.
fn judged(asked_in: fn(&str) -> Vec<Asked>) -> Vec<Judged> {
    let judge = |name: &'static str| -> Vec<Judged> {
        let city = City::read(name);
        let asked = asked_in(name).into_iter();
        asked
            .map(|asked| (verdict(&city, &asked), asked))
            .map(|(verdict, asked)| (name, asked, verdict))
            .collect()
    };
    thread::scope(|scope| {
        let cities = CITIES.map(|name| scope.spawn(move || judge(name)));
        let judged = cities.into_iter().map(thread::ScopedJoinHandle::join);
        judged.flat_map(|judged| judged.unwrap_or_else(|panic| resume_unwind(panic))).collect()
    })
}

/// Sentences of one's own, in the notation of `tests/edits/README.md`: `SIMWORLD_EDITS=FOLDER cargo test -p simworld-agents --test edits elsewhere --
/// --ignored --nocapture` prints what is wrong and the score.
#[test]
#[ignore = "scores what lies in the folder of SIMWORLD_EDITS"]
fn what_is_asked_elsewhere_is_scored() {
    let judged = judged(asked_elsewhere);
    let mut families: BTreeMap<&str, Score> = BTreeMap::new();
    for (city, asked, verdict) in &judged {
        families.entry(&asked.family).or_default().count(verdict);
        if *verdict != Verdict::Right {
            println!("{}", line(city, asked, verdict));
        }
    }
    for (family, score) in &families {
        println!("{family:16} {:3} of {:3}, {} wrong edits", score.right, score.all, score.wrong_edits);
    }
    let right = families.values().map(|score| score.right).sum::<usize>();
    println!("{:16} {right:3} of {:3}", "all", judged.len());
    assert!(!judged.is_empty(), "SIMWORLD_EDITS names no folder with CITY.*.edits.toml");
    let unasked = ["ambiguous", "unsatisfiable"]
        .map(|family| families.get(family).map_or(0, |score| score.wrong_edits));
    assert_eq!(unasked, [0, 0], "edits where an answer was due");
}

#[test]
fn every_family_holds_its_floor() {
    let mut families: BTreeMap<String, Score> = BTreeMap::new();
    let mut sets: BTreeMap<(&str, String), Score> = BTreeMap::new();
    let mut faults = Vec::new();
    for (city, asked, verdict) in &judged(sampled_in) {
        families.entry(asked.family.clone()).or_default().count(verdict);
        sets.entry((asked.set, asked.family.clone())).or_default().count(verdict);
        if *verdict != Verdict::Right {
            faults.push(line(city, asked, verdict));
        }
    }
    for ((set, family), score) in &sets {
        println!(
            "{set:12} {family:16} {:3} of {:3}, {} wrong edits",
            score.right, score.all, score.wrong_edits
        );
    }
    let mut below = Vec::new();
    // A sample may have one more than its share of what is not understood.
    let spare = usize::from(!is_whole());
    for (family, floor) in FLOORS {
        let score = &families[family];
        let percent = |right: usize| right as f64 / score.all as f64 * 100.0;
        println!("{family:16} {:3} of {:3}  {:5.1} %", score.right, score.all, percent(score.right));
        if percent(score.right + spare) < floor {
            let percent = percent(score.right);
            below.push(format!("{family} scores {percent:.1} %, below its floor of {floor} %"));
        }
        if ["ambiguous", "unsatisfiable"].contains(&family) && score.wrong_edits > 0 {
            below.push(format!("{family}: {} edits where an answer was due", score.wrong_edits));
        }
    }
    let (right, all) = families.values().fold((0, 0), |sum, score| (sum.0 + score.right, sum.1 + score.all));
    println!("{:16} {right:3} of {all:3}\n{}", "all", faults.join("\n"));
    assert_eq!(families.len(), FLOORS.len(), "every family has a floor");
    assert!(below.is_empty(), "{}\n{}", below.join("\n"), faults.join("\n"));
}

/// Sentences of our own, by which classes of speech were taught that no set of strangers has: all of them stay right. Those of the
/// beginning are sampled, unless `SIMWORLD_SOAK` asks for the whole.
#[test]
fn what_was_taught_is_understood() {
    let judged = judged(sampled_of_taught_in);
    let (all, least) = (judged.len(), if is_whole() { 3_300 } else { 1_700 });
    let wrong = judged.iter().filter(|(.., verdict)| *verdict != Verdict::Right);
    let faults: Vec<String> = wrong.map(|(city, asked, verdict)| line(city, asked, verdict)).collect();
    assert!(all >= least, "only {all} sentences");
    assert!(faults.is_empty(), "{} of {all}\n{}", faults.len(), faults.join("\n"));
}

fn line(city: &str, asked: &Asked, wrong: &Verdict) -> String {
    let Asked { set, family, words, meaning } = asked;
    format!("{city}.{set}/{family}: {words:?}\n    wanted {meaning}\n    got    {wrong:?}")
}
