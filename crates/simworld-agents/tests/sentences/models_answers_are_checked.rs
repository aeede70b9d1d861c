//! Whatever a model answers: a plan that this body can carry out on things that are there, or a typed error.
#![cfg(feature = "thought")]

use crate::sentences_common::city::City;
use crate::thought_common::answers::at_random;
use crate::thought_common::plans::check_plan;
use crate::thought_common::{answering, model, text};
use proptest::prelude::*;
use simworld_agents::model::{ChatReply, Finish, ModelError, Scripted};
use simworld_agents::thought::ModelPlanner;
use simworld_core::action::ActionSet;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
use simworld_core::seam::{PlanError, Planner};
use simworld_core::seed::Seed;

fn asks(words: &str) -> Intent {
    Intent::Words(words.to_owned())
}

#[test]
fn answers_made_from_the_schema_are_plans_and_spoilt_ones_are_refused() {
    let mut city = City::read("harbour");
    let (mut plans, mut refusals) = ([0; 3], [0; 3]);
    for (index, (who, able)) in city.bodies().into_iter().enumerate() {
        for round in 0..120 {
            let spoils = if round % 2 == 0 { 0.0 } else { 0.02 };
            let mut rng = Seed(round).stream("answers").rng();
            let (model, asked) = model(move |_, request| {
                let schema = &request.schema.as_ref().expect("a plan is asked for by a schema").json;
                let mut answer = at_random(schema, schema, &mut rng, spoils);
                if spoils == 0.0 {
                    answer["cannot"] = "".into();
                }
                Ok(answer.to_string())
            });
            let got = ModelPlanner::new(model).plan(&asks("do something"), &city.world, who);
            match got {
                Ok(plan) => {
                    check_plan(&plan, &city.world, who, able);
                    plans[index] += 1;
                }
                Err(PlanError::Answer { fault, .. }) => {
                    assert!(!fault.is_empty());
                    assert_eq!(asked.all().len(), 2, "one repair was tried");
                    refusals[index] += 1;
                }
                Err(PlanError::NotUnderstood { hint, .. }) => assert!(!hint.is_empty()),
                Err(other) => panic!("{other}"),
            }
        }
    }
    println!("plans {plans:?}, refusals {refusals:?} of 120 each");
    assert!(plans.iter().all(|count| *count >= 10) && refusals.iter().all(|count| *count >= 10));
}

#[test]
fn a_body_is_offered_what_it_can_do_and_what_is_there() {
    let mut city = City::read("harbour");
    let [(person, _), (dog, _), (car, _)] = city.bodies();
    let acts = |who, world: &World| {
        let (model, asked) = answering(&[r#"{"aim": "", "cannot": "no", "steps": []}"#]);
        let _ = ModelPlanner::new(model).plan(&asks("?"), world, who);
        let schema = asked.last().schema.expect("there is a schema").json;
        let offered = schema["$defs"].as_object().expect("there are definitions").clone();
        move |act: &str| offered.contains_key(act)
    };
    let (of_person, of_dog, of_car) =
        (acts(person, &city.world), acts(dog, &city.world), acts(car, &city.world));
    assert!(of_person("sit_down") && of_person("say") && of_person("go_to"));
    assert!(of_dog("turn") && of_dog("go_to") && !of_dog("sit_down") && !of_dog("say"));
    assert!(of_car("go_to") && of_car("stop") && !of_car("turn") && !of_car("pick_up"));
    let mut desert = World::new();
    let shape = Shape::Capsule { radius: 0.25, height: 1.8 };
    let pose = pose_facing(Point3::origin(), 0.0);
    let me = desert.spawn(EntityDesc::new(EntityKind::Person, pose, shape)).expect("one stands anywhere");
    let of_nobody = acts(me, &desert);
    assert!(of_nobody("turn") && of_nobody("go_to_point") && !of_nobody("sit_down") && !of_nobody("go_to"));
}

#[test]
fn what_is_wrong_is_shown_once_and_then_it_is_an_error() {
    let city = City::read("harbour");
    let good = r#"{"aim": "", "cannot": "", "steps": [{"act": "turn", "degrees": 90}]}"#;
    let (model, asked) = answering(&["I think I shall turn left.", good]);
    let plan = ModelPlanner::new(model).plan(&asks("turn left"), &city.world, city.me);
    assert_eq!(plan.map(|plan| plan.steps.len()), Ok(1));
    let repair = asked.last();
    assert_eq!(repair.messages.len(), 4);
    assert_eq!(text(&repair, 2), "I think I shall turn left.");
    assert!(text(&repair, 3).contains("is no JSON"), "{}", text(&repair, 3));

    let far = r#"{"aim": "", "cannot": "", "steps": [{"act": "turn", "degrees": 720}]}"#;
    let (model, asked) = answering(&[far, far, good]);
    let error = ModelPlanner::new(model).plan(&asks("turn"), &city.world, city.me);
    let Err(PlanError::Answer { fault, answer }) = error else { panic!("{error:?}") };
    assert!(fault.contains("steps[0].degrees must be a whole number from -360 to 360"), "{fault}");
    assert_eq!((answer.as_str(), asked.all().len()), (far, 2));
}

#[test]
fn saying_nothing_is_no_plan() {
    let city = City::read("harbour");
    for answer in [
        r#"{"aim": "", "cannot": "", "steps": []}"#,
        r#"{"aim": "", "cannot": "no legs", "steps": [{"act": "stop"}]}"#,
        r#"{"aim": "", "cannot": "", "steps": [{"act": "drop_off"}]}"#,
    ] {
        let (model, _) = answering(&[answer, answer]);
        let got = ModelPlanner::new(model).plan(&asks("drop it"), &city.world, city.me);
        assert!(matches!(got, Err(PlanError::Answer { .. })), "{answer}: {got:?}");
    }
    let (model, _) = answering(&[r#"{"aim": "", "cannot": "a person cannot fly", "steps": []}"#]);
    let got = ModelPlanner::new(model).plan(&asks("fly"), &city.world, city.me);
    assert!(
        matches!(&got, Err(PlanError::NotUnderstood { hint, .. }) if hint.contains("cannot fly")),
        "{got:?}"
    );
}

#[test]
fn a_model_that_fails_or_is_cut_off_is_an_error() {
    let city = City::read("harbour");
    let (broken, _) = model(|_, _| Err(ModelError::RateLimited { retry_after: None }));
    let got = ModelPlanner::new(broken).plan(&asks("turn"), &city.world, city.me);
    assert!(matches!(&got, Err(PlanError::Backend(reason)) if reason.contains("fewer requests")), "{got:?}");
    let cut = || ChatReply { finish: Finish::Length, ..ChatReply::of(r#"{"aim": "", "cannot": "", "ste"#) };
    let model = Scripted::rule(move |_| Ok(cut()));
    let got = ModelPlanner::new(Box::new(model)).plan(&asks("turn"), &city.world, city.me);
    assert!(matches!(&got, Err(PlanError::Answer { fault, .. }) if fault.contains("be brief")), "{got:?}");
    let (model, _) = answering(&[]);
    let nobody = EntityId::new(9999, 0);
    let got = ModelPlanner::new(model).plan(&asks("turn"), &city.world, nobody);
    assert_eq!(got, Err(PlanError::Missing { id: nobody }));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn any_text_is_an_error_or_a_plan(text in ".{0,200}|[\\[\\]{}\",:0-9a-z#_ -]{0,200}") {
        let city = City::read("campus");
        let (model, _) = answering(&[&text, &text]);
        match ModelPlanner::new(model).plan(&asks("anything"), &city.world, city.me) {
            Ok(plan) => check_plan(&plan, &city.world, city.me, ActionSet::humanoid()),
            Err(error) => prop_assert!(matches!(error, PlanError::Answer { .. }), "{error}"),
        }
    }
}
