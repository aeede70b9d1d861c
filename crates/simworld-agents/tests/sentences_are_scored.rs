//! What people say in three cities: the score by family, and the floor that each family holds.
//!
//! The tables in `tests/sentences` were written before the grammar that reads them. A wrong action counts apart from a
//! wrong answer: on what is impossible or open, none is allowed.

mod sentences_common;

use std::collections::BTreeMap;

use sentences_common::city::City;
use sentences_common::{CITIES, Said, Verdict, said_in, verdict};

#[test]
fn every_family_is_understood() {
    let mut families: BTreeMap<String, (usize, usize)> = BTreeMap::new();
    let mut faults = Vec::new();
    for name in CITIES {
        let city = City::read(name);
        for said in said_in(name) {
            let verdict = verdict(&city, &said);
            let score = families.entry(said.family.clone()).or_default();
            score.1 += 1;
            match verdict {
                Verdict::Right => score.0 += 1,
                wrong => faults.push(line(name, &said, &wrong)),
            }
        }
    }
    for (family, (right, all)) in &families {
        println!("{family:14} {right:3} of {all:3}  {:5.1} %", *right as f64 / *all as f64 * 100.0);
    }
    let (right, all) = families.values().fold((0, 0), |sum, score| (sum.0 + score.0, sum.1 + score.1));
    println!("{:14} {right:3} of {all:3}\n{}", "all", faults.join("\n"));
    assert!(all >= 300, "only {all} sentences");
}

fn line(city: &str, said: &Said, wrong: &Verdict) -> String {
    format!("{city}/{}: {:?}\n    wanted {}\n    got    {wrong:?}", said.family, said.words, said.meaning)
}
