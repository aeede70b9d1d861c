//! What the grammar makes of sentences of whoever wants to know: a development aid, ignored in the usual run.
//!
//! `SENTENCES=folder cargo test --test sentences_are_reported -- --ignored --nocapture` reads `<city>.txt` for each city
//! (a sentence a line) and prints each with its plan in the notation of the tables, or the answer.

mod sentences_common;

use sentences_common::city::City;
use sentences_common::{PLACES, Said, notation, understand};
use simworld_agents::language::GrammarPlanner;

#[test]
#[ignore = "prints what is made of files that are named by hand"]
fn what_is_made_of_sentences_is_printed() {
    let Ok(folder) = std::env::var("SENTENCES") else { return };
    let (mut understood, mut all) = (0, 0);
    for name in PLACES {
        let Ok(text) = std::fs::read_to_string(format!("{folder}/{name}.txt")) else { continue };
        let city = City::read(name);
        println!("== {name}");
        for words in text.lines().filter(|line| !line.trim().is_empty()) {
            let said = Said {
                family: "report".to_owned(),
                words: words.to_owned(),
                meaning: String::new(),
                outcome: None,
            };
            let got = understand(&GrammarPlanner::default(), &city, &said);
            all += 1;
            understood += usize::from(got.is_ok());
            match got {
                Ok(plan) => println!("  {words}\n      = {}", notation::show(&plan, &city)),
                Err(error) => {
                    let kind = notation::kind_of(&error);
                    println!("  {words}\n      ! {kind}: {error}");
                }
            }
        }
    }
    println!("{understood} of {all} have a plan");
}
