//! A model that says what the grammar understood gives the plan that the grammar gave, over everything that people say.
#![cfg(feature = "thought")]

use crate::sentences_common::city::City;
use crate::sentences_common::{CITIES, notation, said_in, understand};
use crate::thought_common::answers::answer;
use crate::thought_common::{answering, text};
use serde_json::Value as Json;
use simworld_agents::language::GrammarPlanner;
use simworld_agents::thought::{Answered, Fallback, ModelPlanner, ViewConfig};
use simworld_core::intent::Intent;
use simworld_core::seam::{Plan, PlanError, Planner};

fn everything() -> ViewConfig {
    ViewConfig { radius: 2000.0, most: 500, scenery: 500, ..ViewConfig::default() }
}

/// Whether two plans are the same, save that an answer says numbers in tenths and whole degrees.
fn alike(one: &Plan, other: &Plan) -> bool {
    fn same(one: &Json, other: &Json) -> bool {
        match (one, other) {
            (Json::Number(one), Json::Number(other)) => {
                let numbers = one.as_f64().zip(other.as_f64());
                numbers.is_some_and(|(one, other)| (one - other).abs() <= 0.0501)
            }
            (Json::Array(one), Json::Array(other)) => {
                one.len() == other.len() && one.iter().zip(other).all(|(one, other)| same(one, other))
            }
            (Json::Object(one), Json::Object(other)) => {
                one.len() == other.len()
                    && one
                        .iter()
                        .zip(other)
                        .all(|((key, one), (name, other))| key == name && same(one, other))
            }
            (one, other) => one == other,
        }
    }
    let value = |plan| serde_json::to_value(plan).expect("a plan is data");
    same(&value(one), &value(other))
}

#[test]
fn what_people_say_gives_the_same_plan_either_way() {
    let (mut same, mut unsayable, mut wrong) = (0, Vec::new(), Vec::new());
    for name in CITIES {
        let city = City::read(name);
        // What is said to the dog is about "me", for whom the model plans here.
        for said in said_in(name).into_iter().filter(|said| said.family != "dog") {
            let Ok(plan) = understand(&GrammarPlanner::default(), &city, &said) else { continue };
            let Some(answer) = answer(&plan, &city.world) else {
                unsayable.push(said.words);
                continue;
            };
            let (model, _) = answering(&[&answer.to_string()]);
            let planner = ModelPlanner::new(model).with_depth(4).with_view(everything());
            let mut planner = planner.expect("the view is within bounds");
            match planner.plan(&Intent::Words(said.words.clone()), &city.world, city.me) {
                Ok(modelled) if alike(&modelled, &plan) => same += 1,
                Ok(modelled) => wrong.push(format!(
                    "{name}: {}\n  {}\n  {}",
                    said.words,
                    notation::show(&plan, &city),
                    notation::show(&modelled, &city)
                )),
                Err(error) => wrong.push(format!("{name}: {}\n  {error}", said.words)),
            }
        }
    }
    println!("{same} sentences give the same plan; no answer can say {unsayable:?}");
    assert!(wrong.is_empty(), "{} differ:\n{}", wrong.len(), wrong.join("\n"));
    assert!(same > 250, "{same}");
    assert!(unsayable.len() * 20 < same, "{} of {same}: {unsayable:?}", unsayable.len());
}

#[test]
fn a_model_steps_in_where_the_grammar_does_not_understand_and_only_there() {
    let city = City::read("harbour");
    let bench = city.ids.iter().find(|(key, _)| key.starts_with("bench")).map(|(_, id)| *id);
    let seat = bench.expect("the harbour has a bench");
    let answer =
        format!(r#"{{"aim": "rest", "cannot": "", "steps": [{{"act": "sit_down", "seat": "{seat}"}}]}}"#);
    let (model, asked) = answering(&[&answer, r#"{"aim": "", "cannot": "who knows how", "steps": []}"#]);
    let model = ModelPlanner::new(model).with_view(everything()).expect("the view is within bounds");
    let mut planner = Fallback::new(Box::new(GrammarPlanner::default()), Box::new(model));
    let mut plan =
        |words: &str| (planner.plan(&Intent::Words(words.into()), &city.world, city.me), planner.answered());

    let (understood, by) = plan("sit down on the nearest bench");
    assert_eq!(by, Some(Answered::First));
    let (modelled, by) = plan("blimey, my poor feet");
    assert_eq!(by, Some(Answered::Second));
    assert_eq!(
        modelled.map(|plan| plan.steps.len()),
        understood.map(|plan| plan.steps.len()),
        "both go there and sit down"
    );
    let (refused, by) = plan("flibber the wibble of gostak");
    assert_eq!(by, Some(Answered::Second));
    assert!(
        matches!(&refused, Err(PlanError::NotUnderstood { hint, .. }) if hint == "who knows how"),
        "{refused:?}"
    );
    let missing = said_in("harbour").into_iter().find(|said| said.meaning.starts_with("! not found"));
    let (missing, by) = plan(&missing.expect("somebody asks for what is not there").words);
    assert!(matches!(missing, Err(PlanError::NotFound { .. })), "{missing:?}");
    assert_eq!((by, asked.all().len()), (Some(Answered::First), 2), "what is refused stays refused");
    assert_eq!(text(&asked.all()[0], 1).matches("blimey, my poor feet").count(), 1);
}
