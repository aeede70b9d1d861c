//! A real llama.cpp plans, with a model of random weights: every answer is a plan that a body can carry out, or a typed error.
//!
//! What lies between a planner and a server is tried, nothing of planning: the schema as a grammar, the repair, the accounts.
//! `ci/model-server` installs what this needs.
#![cfg(all(feature = "http", feature = "thought"))]

use std::sync::Arc;

use crate::model_server::ModelServer;
use crate::model_server::watch::{Watch, as_asked, make_easy};
use crate::sentences_common::city::City;
use crate::thought_common::plans::check_plan;
use simworld_agents::model::ChatRequest;
use simworld_agents::thought::{ModelPlanner, ModelReasoner, Prompt, Prompts, ViewConfig};
use simworld_core::action::ActionSet;
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::seam::{PlanError, Planner};

/// How the server is asked.
struct Asking {
    change: fn(&mut ChatRequest),
    prompts: Arc<Prompts>,
    most_tokens: u32,
}

/// So many rounds, many more under `SIMWORLD_SOAK`.
fn rounds(usual: i64) -> i64 {
    if std::env::var_os("SIMWORLD_SOAK").is_some() { 10 * usual } else { usual }
}

/// Prompts without the long lists of what there is: this model makes nothing of them, and they cost most of the time.
fn short_prompts() -> Prompts {
    let mut prompts = Prompts::standard();
    for (prompt, text) in
        [(Prompt::Planner, "You plan for a {{ body }}."), (Prompt::Plan, "{{ oneself }}\n{{ request }}")]
    {
        prompts.replace(prompt, text.to_owned()).unwrap();
    }
    prompts
}

/// Whether a body gets a plan for its sentence; if it gets none, the error says what is wrong with the answer.
fn is_planned(
    server: &ModelServer,
    city: &City,
    body: (EntityId, ActionSet),
    how: &Asking,
    seed: i64,
) -> bool {
    let (who, able) = body;
    let watch = Watch::default();
    let reasoner = ModelReasoner::new(watch.model(server, how.change))
        .with_prompts(Arc::clone(&how.prompts))
        .with_max_tokens(how.most_tokens)
        .with_temperature(0.4 + 0.1 * (seed * 7 % 12) as f64, Some(seed));
    let view = ViewConfig { most: 12, scenery: 1, places: 4, ..ViewConfig::default() };
    let planner = ModelPlanner::with_reasoner(Box::new(reasoner), Arc::clone(&how.prompts)).with_view(view);
    let got = planner.unwrap().plan(&Intent::Words("do something".to_owned()), &city.world, who);

    let (questions, repairs) = watch.settled();
    assert!(questions == 1 && repairs <= 1, "{questions} questions, {repairs} repairs");
    assert!(repairs >= watch.faulty(), "what does not conform is asked for again");
    match got {
        Ok(plan) => {
            check_plan(&plan, &city.world, who, able);
            true
        }
        Err(PlanError::Answer { fault, answer }) => {
            let last = watch.all().pop().and_then(|exchange| exchange.answer.ok()).unwrap();
            assert!(repairs == 1 && !fault.is_empty(), "one repair was tried: {fault}");
            assert!(last.text.starts_with(&answer), "{answer}");
            false
        }
        Err(PlanError::NotUnderstood { hint, .. }) => {
            assert!(!hint.is_empty());
            false
        }
        Err(other) => panic!("seed {seed}: {other}"),
    }
}

#[test]
fn every_answer_by_the_planners_own_schema_is_a_sound_plan_or_a_typed_error() {
    let Some(server) = ModelServer::start() else { return };
    let mut city = City::read("harbour");
    let how = Asking { change: as_asked, prompts: Arc::new(Prompts::standard()), most_tokens: 300 };
    let (mut plans, mut errors) = (0, 0);
    for body in city.bodies() {
        for seed in 0..rounds(2) {
            let count = if is_planned(&server, &city, body, &how, seed) { &mut plans } else { &mut errors };
            *count += 1;
        }
    }
    println!("{plans} plans, {errors} typed errors");
    assert!(plans + errors == 3 * rounds(2), "{plans} plans, {errors} errors");
}

#[test]
fn a_server_that_keeps_to_what_is_possible_gives_plans_that_bodies_can_carry_out() {
    let Some(server) = ModelServer::start() else { return };
    let mut city = City::read("harbour");
    let how = Asking { change: make_easy, prompts: Arc::new(short_prompts()), most_tokens: 400 };
    let (mut plans, mut errors) = ([0_i64; 3], [0_i64; 3]);
    for (index, body) in city.bodies().into_iter().enumerate() {
        for seed in 0..rounds(12) {
            let is_planned = is_planned(&server, &city, body, &how, seed);
            let count = if is_planned { &mut plans[index] } else { &mut errors[index] };
            *count += 1;
        }
    }
    println!("{plans:?} plans, {errors:?} typed errors");
    let (planned, refused) = (plans.iter().sum::<i64>(), errors.iter().sum::<i64>());
    assert_eq!(planned + refused, 3 * rounds(12));
    assert!(planned * 6 >= planned + refused, "{plans:?} plans, {errors:?} typed errors");
}
