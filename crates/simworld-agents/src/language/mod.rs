//! The grammar: sentences and calls to plans, without any model.
//!
//! A sentence is cut into clauses ("go to the nearest chair", "sit down"); each clause is a verb and, for most verbs, a thing.
//! Things are grounded in the scene: by kind or use ("the nearest bench", "the café near the museum"), by name with a few
//! typos ("Harbor Museum"), by id ("#12") or by coordinates ("(10, -3)"). What is not understood, or not there, is an
//! error that says so; nothing is dropped in silence.

mod call;
mod clause;
mod ground;
mod lexicon;
mod phrase;

use simworld_core::action::Action;
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::{ARM_REACH, EntityKind, EntityRef, Role, Scene};
use simworld_core::seam::{Goal, Plan, PlanError, PlanStep, Planner};

use clause::{Clause, Verb, clauses};
use ground::Grounding;

/// Sentences longer than this are refused, bytes.
const LONGEST: usize = 4000;
/// How near one goes to use a thing, m: within the arm's reach, with a step to spare.
const USE_DISTANCE: f64 = ARM_REACH - 0.6;
/// How near one goes to a place, m.
const PLACE_DISTANCE: f64 = 1.5;
/// A jog, m/s.
const RUNNING_SPEED: f64 = 2.5;

/// Plans by a fixed grammar; it holds no state.
///
/// ```
/// use simworld_agents::language::GrammarPlanner;
/// use simworld_core::geometry::{Point3, pose_facing};
/// use simworld_core::intent::Intent;
/// use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
/// use simworld_core::seam::{PlanStep, Planner};
///
/// let mut world = World::new();
/// let at = |x| pose_facing(Point3::new(x, 0.0, 0.0), 0.0);
/// let me = world.spawn(EntityDesc::new(EntityKind::Person, at(0.0), Shape::Capsule { radius: 0.25, height: 1.8 }))?;
/// world.spawn(EntityDesc::new(EntityKind::Chair, at(12.0), Shape::cuboid(0.5, 0.5, 0.9)))?;
/// let sentence = Intent::Words("Please go to the nearest chair and sit down.".into());
/// let plan = GrammarPlanner.plan(&sentence, &world, me)?;
/// assert!(matches!(plan.steps[..], [PlanStep::Navigate { .. }, PlanStep::Act(_)]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct GrammarPlanner;

impl Planner for GrammarPlanner {
    fn plan(&mut self, intent: &Intent, scene: &dyn Scene, who: EntityId) -> Result<Plan, PlanError> {
        if scene.entity(who).is_none() {
            return Err(PlanError::Missing { id: who });
        }
        match intent {
            Intent::Words(words) => plan_words(words, scene, who),
            Intent::Call { name, args } => call::plan_call(name, args, scene, who),
        }
    }
}

fn plan_words(words: &str, scene: &dyn Scene, who: EntityId) -> Result<Plan, PlanError> {
    let not_understood = |fragment: &str, hint: &str| PlanError::NotUnderstood {
        words: words.chars().take(200).collect(),
        fragment: fragment.chars().take(80).collect(),
        hint: hint.to_owned(),
    };
    if words.len() > LONGEST {
        return Err(not_understood("", "say it in at most 4000 bytes"));
    }
    let clauses = clauses(words).map_err(|fragment| not_understood(&fragment, clause::UNDERSTOOD))?;
    if clauses.is_empty() {
        return Err(not_understood("", clause::UNDERSTOOD));
    }
    let mut draft = Draft { scene, who, plan: Plan::default(), topic: None };
    for clause in &clauses {
        draft.add(clause).map_err(|fault| match fault {
            Fault::Unclear(hint) => not_understood(&clause.text, &hint),
            Fault::Plan(error) => error,
        })?;
    }
    Ok(draft.plan)
}

/// Why a clause gives no steps.
pub(crate) enum Fault {
    Unclear(String),
    Plan(PlanError),
}

/// A plan under construction, with the thing that "it" and "there" refer to.
struct Draft<'a> {
    scene: &'a dyn Scene,
    who: EntityId,
    plan: Plan,
    topic: Option<EntityId>,
}

impl Draft<'_> {
    fn add(&mut self, clause: &Clause) -> Result<(), Fault> {
        match clause.verb {
            Verb::Go | Verb::Run => self.go(clause)?,
            Verb::PickUp => {
                self.use_thing(clause, |kind| kind == EntityKind::Parcel, |item| Action::PickUp { item })?;
            }
            Verb::Sit => self.use_thing(clause, EntityKind::is_seat, |seat| Action::SitDown { seat })?,
            Verb::Ride => self.use_thing(
                clause,
                |kind| kind == EntityKind::Scooter,
                |scooter| Action::RideScooter { scooter },
            )?,
            Verb::DropOff => self.drop_off(clause)?,
            Verb::StandUp => self.act(Action::StandUp),
            Verb::GetOff => self.act(Action::GetOffScooter),
            Verb::Stop => self.act(Action::Stop),
            Verb::Wait => self.plan.steps.push(PlanStep::Wait { seconds: clause.seconds()? }),
        }
        Ok(())
    }

    fn act(&mut self, action: Action) {
        self.plan.steps.push(PlanStep::Act(action));
    }

    fn go(&mut self, clause: &Clause) -> Result<(), Fault> {
        let speed = (clause.verb == Verb::Run).then_some(RUNNING_SPEED);
        let to = match self.ground(clause, &|_| true)? {
            Grounding::Point(point) => Goal::Point(point),
            Grounding::Entity(id) => {
                self.topic = Some(id);
                Goal::Entity(id)
            }
        };
        self.plan.steps.push(PlanStep::Navigate { to, within: PLACE_DISTANCE, speed });
        Ok(())
    }

    /// Goes within reach of a thing, unless one is on the way there already, and uses it.
    fn use_thing(
        &mut self,
        clause: &Clause,
        fits: fn(EntityKind) -> bool,
        action: impl Fn(EntityId) -> Action,
    ) -> Result<(), Fault> {
        let known = self.topic.filter(|id| self.scene.entity(*id).is_some_and(|entity| fits(entity.kind)));
        let id = match known.filter(|_| clause.thing.is_empty() || clause.means_topic()) {
            Some(id) => id,
            None => match self.ground(clause, &|entity| fits(entity.kind))? {
                Grounding::Entity(id) => id,
                Grounding::Point(_) => return Err(Fault::Unclear("name a thing, not a place".to_owned())),
            },
        };
        self.topic = Some(id);
        self.approach(Goal::Entity(id));
        self.act(action(id));
        Ok(())
    }

    /// Puts down what the hands hold, at a place if the clause names one.
    fn drop_off(&mut self, clause: &Clause) -> Result<(), Fault> {
        if let Some(place) = clause.destination() {
            let to = match self.ground(&place, &|_| true)? {
                Grounding::Point(point) => Goal::Point(point),
                Grounding::Entity(id) => Goal::Entity(id),
            };
            self.approach(to);
        }
        let heavy = self.scene.attached(self.who, Role::Carried).is_some();
        self.act(if heavy { Action::PutDownHeavy } else { Action::DropOff });
        Ok(())
    }

    /// Navigates within reach; a navigation to the same goal just before is made to end there.
    fn approach(&mut self, to: Goal) {
        match self.plan.steps.last_mut() {
            Some(PlanStep::Navigate { to: before, within, .. }) if *before == to => *within = USE_DISTANCE,
            _ => self.plan.steps.push(PlanStep::Navigate { to, within: USE_DISTANCE, speed: None }),
        }
    }

    fn ground(&self, clause: &Clause, fits: &dyn Fn(&EntityRef<'_>) -> bool) -> Result<Grounding, Fault> {
        if clause.means_topic()
            && let Some(id) = self.topic
        {
            return Ok(Grounding::Entity(id));
        }
        let phrase = phrase::parse(&clause.thing)?;
        ground::ground(&phrase, self.scene, self.who, fits).map_err(Fault::Plan)
    }
}
