//! From words to the world: what the tables say of the world after a plan holds once a body has carried it out.

use std::collections::BTreeMap;

use crate::sentences_common::city::City;
use crate::sentences_common::outcome::{carry_out, shows};
use crate::sentences_common::{CITIES, PLACES, outcomes_in, understand};
use proptest::prelude::*;
use simworld_agents::language::GrammarPlanner;
use simworld_core::geometry::{Point3, Twist, pose_facing};
use simworld_core::intent::Intent;
use simworld_core::scene::{Attachment, Role, Scene};
use simworld_core::seam::{Planner, Progress};

/// How many sentences of each place say what the world shows: all that do are carried out, and none may get lost unnoticed. Raise a number
/// when some are added.
const OUTCOMES: [(&str, usize); 9] = [
    ("campus", 11),
    ("depot", 3),
    ("fairground", 2),
    ("harbour", 36),
    ("market", 4),
    ("oldtown", 11),
    ("park", 3),
    ("station", 3),
    ("waterside", 2),
];

#[test]
fn the_world_shows_what_was_asked_for() {
    let (mut faults, mut tried) = (Vec::new(), BTreeMap::new());
    for name in PLACES {
        let city = City::read(name);
        for said in outcomes_in(name) {
            let Some(expected) = &said.outcome else { continue };
            *tried.entry(name).or_insert(0_usize) += 1;
            let plan = match understand(&GrammarPlanner::default(), &city, &said) {
                Ok(plan) => plan,
                Err(error) => {
                    faults.push(format!("{name}: {:?}: {error}", said.words));
                    continue;
                }
            };
            let (simulation, ended) = carry_out(City::read(name).world, city.me, plan);
            if let Err(found) = shows(&city, expected, &simulation, &ended) {
                faults
                    .push(format!("{name}: {:?} should leave {expected:?}, and left {found:?}", said.words));
            }
        }
    }
    for (place, least) in OUTCOMES {
        let count = tried.remove(place).unwrap_or_default();
        assert!(count >= least, "in {place} only {count} sentences say what the world shows, of {least}");
    }
    assert!(tried.is_empty(), "nobody counts the sentences of {tried:?}: add them to OUTCOMES");
    assert!(faults.is_empty(), "{}:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn a_taken_chair_is_said_to_be_taken_and_by_whom() {
    let mut city = City::read("oldtown");
    let (chair, carol) = (city.ids["chair_a"], city.ids["carol"]);
    let call = Intent::call("sit_down").arg("seat", chair);
    let plan = GrammarPlanner::default().plan(&call, &city.world, city.me).unwrap();
    // Carol sits down on it while the agent is still on its way.
    let parent_from_body = simworld_core::geometry::Pose::identity();
    city.world
        .attach(carol, Some(Attachment { parent: chair, role: Role::Seated, parent_from_body }))
        .unwrap();
    let (_, ended) = carry_out(city.world, city.me, plan);
    let Progress::Failed { reason } = ended else { panic!("{ended:?}") };
    assert!(reason.contains(&format!("taken by {carol}")), "{reason}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(if std::env::var_os("SIMWORLD_SOAK").is_some() { 2000 } else { 24 }))]

    /// The paper's example, from anywhere in any of the three cities.
    #[test]
    fn a_body_sits_on_the_nearest_chair_from_anywhere(
        name in prop::sample::select(CITIES.to_vec()),
        x in -80.0..80.0_f64,
        y in -80.0..80.0_f64,
        yaw in -3.1..3.1_f64,
    ) {
        let mut city = City::read(name);
        let pose = pose_facing(Point3::new(x, y, 0.0), yaw);
        city.world.set_motion(city.me, pose, Twist::ZERO).unwrap();
        let words = Intent::Words("go to the nearest chair and sit down".into());
        let plan = GrammarPlanner::default().plan(&words, &city.world, city.me).unwrap();
        let here = simworld_core::geometry::Point2::new(x, y);
        let is_chair = |thing: &simworld_core::scene::EntityRef<'_>| thing.kind == simworld_core::scene::EntityKind::Chair;
        let nearest = city.world.nearest(here, 1e4, &is_chair).unwrap().id;
        let (simulation, ended) = carry_out(city.world, city.me, plan);
        prop_assert_eq!(ended, Progress::Done);
        let bond = simulation.world().entity(city.me).unwrap().attachment.copied();
        prop_assert_eq!(bond.map(|bond| (bond.parent, bond.role)), Some((nearest, Role::Seated)));
    }
}
