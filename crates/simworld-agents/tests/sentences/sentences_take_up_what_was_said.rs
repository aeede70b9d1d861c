//! Sentences that take up what was said before: goods that are wished for, places that wait for a thing, orders done over again; and
//! who says so, who goes along, and how two others stand.

use crate::sentences_common::city::City;
use crate::sentences_common::notation;
use simworld_agents::language::GrammarPlanner;
use simworld_core::intent::Intent;
use simworld_core::seam::{PlanError, Planner};

/// Asserts what each sentence means at the market, and reports all that mean something else.
fn mean(table: &[(&str, &str)]) {
    let city = City::read("market");
    let mut wrong = Vec::new();
    for (words, meant) in table {
        let got = GrammarPlanner::default().plan(&Intent::Words((*words).to_owned()), &city.world, city.me);
        let got = got.map(|plan| notation::show(&plan, &city)).map_err(|error| error.to_string());
        if got.as_deref() != Ok(*meant) {
            wrong.push(format!("{words:?}: wanted {meant}, got {got:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn goods_that_are_wished_for_are_bought_once() {
    mean(&[
        ("we need two pretzels for the children, please buy them", "repeat 2 { go bread, buy pretzel }"),
        ("we need two pretzels. Could you go and get them?", "repeat 2 { go bread, buy pretzel }"),
        ("the kids want two pretzels, so go and buy them", "repeat 2 { go bread, buy pretzel }"),
        ("two pretzels would be nice, please fetch them", "repeat 2 { go bread, buy pretzel }"),
        ("buy two pretzels, one is for my sister", "repeat 2 { go bread, buy pretzel }"),
        ("get two pretzels please, one for me and one for my wife", "repeat 2 { go bread, buy pretzel }"),
        ("two pretzels please, for my kids", "repeat 2 { go bread, buy pretzel }"),
        ("Delia wants a kite, buy it and bring it to her", "go toys, buy kite, go delia, give delia"),
        ("buy a kite, it's for Delia", "go toys, buy kite, go delia, give delia"),
        ("my grandmother loves sunflowers, buy her one", "go flower, buy sunflower"),
        ("the Samovar Tearoom has nice soup, buy one there", "go tearoom, buy soup"),
        ("buy a soup there, at the tearoom", "go tearoom, buy soup"),
        ("I need two photos of the well, please take them", "face well, repeat 2 { photo }"),
    ]);
}

#[test]
fn who_goes_along_and_why_it_is_hurried_leads_nowhere_else() {
    mean(&[
        ("walk with me to the well", "go well"),
        ("go to the well with me", "go well"),
        ("the well is where I have to be, take the shortest way there", "go well"),
        ("what's the quickest way to the well? Take it", "go well"),
        ("go to the well by the quickest route possible", "go well"),
        ("go to the well or the statue, whichever is closer", "go well"),
        ("go to whichever is closer, the well or the statue", "go well"),
        ("go to the nearer of the well and the statue", "go well"),
        ("Boris says you should go to the well", "go well"),
        ("run to the well or you'll be late", "go well at 2.5"),
        ("careful, it is wet; walk slowly to the well", "go well at 0.7"),
        ("go to the museum or the school, whichever is farther away", "go museum"),
    ]);
}

#[test]
fn what_is_done_again_is_done_so_often() {
    mean(&[
        ("wave to Chidi, then do it again", "repeat 2 { wave chidi }"),
        ("wave to Chidi once more", "repeat 2 { wave chidi }"),
        ("wave to Chidi and then again", "repeat 2 { wave chidi }"),
        ("go to the well and then to the statue, then do that again", "repeat 2 { go well, go statue }"),
        ("wave to Agnes and do the same to Boris", "wave agnes, wave boris"),
        ("take a photo of the statue and do the same with the well", "face statue, photo, face well, photo"),
    ]);
}

#[test]
fn conditions_are_about_whoever_is_named() {
    mean(&[
        ("if Agnes is near the mailbox, wave to her", "if agnes near mailbox { wave agnes }"),
        ("wait until Emil is at the well, then wave to him", "wait until emil near well, wave emil"),
        ("if Agnes is not near the mailbox, wave to her", "if not agnes near mailbox { wave agnes }"),
        ("follow Agnes until she reaches the well", "until agnes near well { follow agnes }"),
        ("follow the dog, but stop when you see the statue", "until see statue { follow pepper }"),
        (
            "sit on the yellow chair, but if it's taken take the blue one",
            "if taken chair_1 { go chair_2, sit chair_2 } else { go chair_1, sit chair_1 }",
        ),
        ("if the tearoom is open, buy a tea", "if open door_tearoom { go tearoom, buy tea }"),
        ("if the light isn't green wait for it", "if not light green { wait until light green }"),
    ]);
}

#[test]
fn places_wait_for_what_was_spoken_of() {
    mean(&[
        (
            "there's a basket over there that belongs in Mill House, please take it there",
            "go basket, take basket, go mill, drop",
        ),
        ("Emil works at the pharmacy, bring the basket there", "go basket, take basket, go pharmacy, drop"),
        ("the basket has to go to Mill House, carry it there", "go basket, take basket, go mill, drop"),
        ("Chidi forgot his basket, bring it to him", "go basket, take basket, go chidi, give chidi"),
        ("I need the basket at the tearoom", "go basket, take basket, go tearoom, drop"),
        ("return the basket to Swan House", "go basket, take basket, go swan, drop"),
    ]);
}

#[test]
fn small_words_change_no_order() {
    mean(&[
        ("sit on the red banch", "go bench_1, sit bench_1"),
        ("siton the red bench", "go bench_1, sit bench_1"),
        ("sit in the red car", "go car_1, enter car_1"),
        ("get on the bus and get off at the museum", "go bus, enter bus, go museum, exit"),
        ("jump into the blue car and follow the dog", "go car_2, enter car_2, follow pepper"),
        ("go to the bench. Not that one, the other one", "go bench_2"),
        ("Boris wants to talk to you", "go boris, say boris 'hello'"),
        ("let Boris know that the bus is late", "go boris, say boris 'the bus is late'"),
    ]);
}

#[test]
fn what_keeps_away_and_what_is_not_here_is_no_way_to_it() {
    let city = City::read("market");
    for words in [
        "stay away from the dog",
        "keep away from the well",
        "where is Stefan? wave to him",
        "buy a pizza there",
    ] {
        let got = GrammarPlanner::default().plan(&Intent::Words(words.to_owned()), &city.world, city.me);
        assert!(
            matches!(got, Err(PlanError::NotUnderstood { .. } | PlanError::NotFound { .. })),
            "{words}: {got:?}"
        );
    }
}
