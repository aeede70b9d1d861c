//! Probe.
mod sentences_common;
use sentences_common::{city::City, notation};
use simworld_agents::language::GrammarPlanner;
use simworld_core::intent::Intent;
use simworld_core::seam::Planner;
#[test]
fn probe() {
    for line in std::fs::read_to_string("/tmp/t/unseen.txt").unwrap().lines() {
        let (name, words) = line.split_once('|').unwrap();
        let city = City::read(name);
        match GrammarPlanner::default().plan(&Intent::Words(words.into()), &city.world, city.me) {
            Ok(plan) => println!("{words}\n      = {}", notation::show(&plan, &city)),
            Err(error) => println!("{words}\n      ! {error:.150}"),
        }
    }
}
