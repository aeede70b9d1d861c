//! "Go to the nearest chair and sit down" ends with the body on that chair, from anywhere in a generated city, and who stands
//! up again gets away from it.

use std::fmt::Write as _;

use rayon::prelude::*;
use simworld_agents::language::GrammarPlanner;
use simworld_citygen::Style;
use simworld_core::action::Action;
use simworld_core::geometry::{Point2, Point3};
use simworld_core::intent::Intent;
use simworld_core::scene::{EntityDesc, EntityKind, InteractionError, Role, Scene, Shape, World};
use simworld_core::seam::{Goal, Plan, PlanStep, Planner};
use simworld_core::seed::Seed;
use simworld_tests::traffic::is_whole;

use super::town::{Embodied, Start, Town};

/// Farther than this nobody is asked to walk, min.
const MINUTES: u32 = 30;

/// What went wrong when somebody who stands there is told to sit down and to come back.
fn sits_down_and_comes_back(town: &Town, who: Embodied, place: Point2, seed: Seed) -> Result<(), String> {
    let mut told = town.put(who, place, seed);
    let is_chair = |kind: EntityKind| kind == EntityKind::Chair;
    let nearest = told.world().nearest(place, 1e4, &|thing| is_chair(thing.kind)).map(|chair| chair.id);
    told.hears("go to the nearest chair and sit down", MINUTES)?;
    let world = told.world();
    let me = world.entity(told.me).ok_or("it is gone")?;
    let bond = me.attachment.ok_or("it does not sit")?;
    if bond.role != Role::Seated || Some(bond.parent) != nearest {
        return Err(format!(
            "it is {:?} on {}, and the nearest chair is {nearest:?}",
            bond.role, bond.parent
        ));
    }
    let chair = world.entity(bond.parent).ok_or("the chair is gone")?;
    let off = (me.position() - chair.position()).xy().norm();
    if off > 0.1 || me.position().z < 0.2 {
        return Err(format!("it sits {off:.2} m beside the chair at {}", me.position()));
    }
    let back =
        PlanStep::Navigate { to: Goal::Point(Point3::new(place.x, place.y, 0.0)), within: 1.0, speed: None };
    let steps = vec![PlanStep::Act(Action::StandUp), back];
    told.does(Plan { steps }, MINUTES).map_err(|reason| format!("on the way back: {reason}"))?;
    let left = (told.here() - place).norm();
    if left > 1.1 { Err(format!("it came back to {left:.1} m from there")) } else { Ok(()) }
}

#[test]
fn everybody_who_can_sit_finds_the_nearest_chair_from_anywhere() {
    let (towns, each) = if is_whole() { (12, 7) } else { (1, 1) };
    let mut failures = String::new();
    let (mut tried, mut failed) = (0, 0);
    for index in 0..towns {
        let style = Style::ALL[index as usize % Style::ALL.len()];
        let town = (0..100).map(|more| Town::new(style, 24, 100 * index + more)).find(Town::has_chairs);
        let town = town.expect("some seed has a restaurant with a terrace");
        let mut rng = Seed(index).stream("tests/starts").rng();
        let mut trials = Vec::new();
        for round in 0..each {
            for (rank, start) in Start::ALL.into_iter().enumerate() {
                let who = Embodied::ALL[(round + rank) % Embodied::ALL.len()];
                trials.push((who, start, town.place(start, &mut rng), Seed(rng.bits())));
            }
        }
        let outcomes: Vec<_> = trials
            .par_iter()
            .map(|(who, start, place, seed)| {
                (who, start, place, sits_down_and_comes_back(&town, *who, *place, *seed))
            })
            .collect();
        tried += outcomes.len();
        for (who, start, place, outcome) in outcomes {
            if let Err(reason) = outcome {
                failed += 1;
                let _ =
                    writeln!(failures, "{style:?} town {index}: {who:?} from {start:?} {place}: {reason}");
            }
        }
    }
    assert!(failed == 0, "{failed} of {tried} failed:\n{failures}");
}

#[test]
fn who_cannot_sit_says_so() {
    let mut world = World::new();
    let mut put = |kind, x: f64, shape| {
        let pose = simworld_core::geometry::pose_facing(Point3::new(x, 0.0, 0.0), 0.0);
        world.spawn(EntityDesc::new(kind, pose, shape)).expect("a sound entity")
    };
    let chair = put(EntityKind::Chair, 0.0, Shape::cuboid(0.5, 0.5, 0.9));
    let unable = [EntityKind::Dog, EntityKind::Car, EntityKind::Truck, EntityKind::Bus, EntityKind::Scooter];
    let unable = unable.map(|kind| (kind, put(kind, 1.0, Shape::cuboid(0.8, 0.3, 0.6))));
    for (kind, who) in unable {
        let said = Intent::Words("go to the nearest chair and sit down".to_owned());
        let refused = GrammarPlanner::default().plan(&said, &world, who);
        let refused = refused.expect_err("such a body never sits").to_string();
        assert!(refused.contains("sit down"), "{kind}: {refused}");
        let refused = world.actuate(who, Action::SitDown { seat: chair });
        let is_typed = matches!(&refused, Err(InteractionError::Unable { kind: of, .. }) if *of == kind);
        assert!(is_typed, "{kind}: {refused:?}");
        assert_eq!(world.attached(chair, Role::Seated), None);
    }
}
