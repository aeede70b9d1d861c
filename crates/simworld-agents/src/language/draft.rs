//! Orders to a plan: each is worked out from where the earlier ones leave the agent.

use std::f64::consts::FRAC_PI_2;

use simworld_core::action::{Action, ActionKind, ActionSet, StepDirection};
use simworld_core::geometry::{Point2, Point3, heading};
use simworld_core::id::EntityId;
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{EntityKind, EntityRef, Role};
use simworld_core::seam::{Condition, Goal, Plan, PlanError, PlanStep, Which};

use super::clause::{Clause, Pace, Reference, Spot, Target, Test};
use super::lexicon::is_animate;
use super::relate::spot_on_side;
use super::resolve::{Purpose, View, is_item};
use super::sequence;

/// How near one comes to a thing, or to its door, m: well within reach of an arm.
const AT_THING: f64 = 1.0;
/// How near one comes to somebody, m: the near end of "social distance" (Hall 1966), within reach of two arms.
const AT_PERSON: f64 = 1.2;
/// How near one comes to a point, m.
pub(super) const AT_POINT: f64 = 0.5;
/// The gap one keeps from somebody whom one follows, m.
pub(super) const FOLLOWING: f64 = 2.0;
/// Room for a body between itself and what it stands before, m.
const ROOM: f64 = 0.6;
/// What "run" means, m/s: a slow jog, the most that walkers of the engine can do.
const RUNNING: f64 = 2.5;
/// What "slowly" means, m/s: half of a usual walk.
pub(super) const STROLLING: f64 = 0.7;
/// The speed of walking on, m/s.
const WALKING: f64 = 1.4;

/// How the agent's body will be at this point of the plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Posture {
    Standing,
    Seated,
    Aboard,
    Riding,
}

/// What a hand holds by then.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Load {
    Thing(EntityId),
    /// Something that is bought on the way, and has no id yet.
    Bought,
}

/// A plan in the making.
pub(super) struct Draft<'a> {
    pub(super) view: View<'a>,
    level: f64,
    pub(super) kind: EntityKind,
    /// Half the length of the body, m.
    pub(super) half_length: f64,
    supports: ActionSet,
    plan: Plan,
    pub(super) posture: Posture,
    pub(super) held: Option<Load>,
    pub(super) carried: Option<EntityId>,
    /// What one will stand beside, and where one went last.
    pub(super) beside: Option<EntityId>,
    pub(super) there: Option<(Goal, f64)>,
    /// Whether that is a house that was only spoken of so far.
    pub(super) spoken_of_place: bool,
    /// What was let go of last, and to whom it was given: "carry it there and leave it" says one thing twice.
    pub(super) delivered: Option<(Load, Option<EntityId>)>,
    /// What one is in or on.
    pub(super) mount: Option<EntityId>,
}

impl<'a> Draft<'a> {
    pub(super) fn new(view: View<'a>, me: &EntityRef<'_>) -> Self {
        let scene = view.scene;
        let posture = match me.attachment.map(|bond| bond.role) {
            Some(Role::Seated) => Posture::Seated,
            Some(Role::Aboard) => Posture::Aboard,
            _ if scene.attached(me.id, Role::Ridden).is_some() => Posture::Riding,
            _ => Posture::Standing,
        };
        let supports = ActionSet::of_body(me.kind);
        Self {
            level: me.position().z,
            kind: me.kind,
            half_length: me.info.shape.size().x * 0.5,
            delivered: None,
            supports,
            plan: Plan::default(),
            posture,
            held: scene.attached(me.id, Role::Held).map(Load::Thing),
            carried: scene.attached(me.id, Role::Carried),
            beside: None,
            there: None,
            spoken_of_place: false,
            mount: None,
            view,
        }
    }

    pub(super) fn finish(self) -> Plan {
        self.plan
    }

    pub(super) fn add_all(&mut self, clauses: &[Clause]) -> Result<(), PlanError> {
        for (at, clause) in clauses.iter().enumerate() {
            match sequence::in_view_of(clause, &clauses[at + 1..]) {
                Some(instead) => instead.iter().try_for_each(|clause| self.add(clause))?,
                None => self.add(clause)?,
            }
        }
        Ok(())
    }

    /// Adds the steps of one order, once for each thing that it is about.
    fn add(&mut self, clause: &Clause) -> Result<(), PlanError> {
        let mut each = clause.clone();
        let Some(reference) = each.plural() else { return self.add_one(clause) };
        for id in self.view.find_all(reference, Purpose::Any)? {
            let mut one = clause.clone();
            if let Some(reference) = one.plural() {
                *reference = Reference::to(Target::Id(id), reference.text.clone());
            }
            self.add_one(&one)?;
        }
        Ok(())
    }

    fn add_one(&mut self, clause: &Clause) -> Result<(), PlanError> {
        match clause {
            Clause::Go { to, side, pace, within } => self.go(to, *side, *pace, *within),
            Clause::Walk { course, distance, pace } => self.walk(*course, *distance, *pace),
            Clause::Past { what, pace } => self.pass(what, *pace),
            Clause::Around { what, pace } => self.around(what, *pace),
            Clause::Halfway { from, to, pace } => self.halfway(from.as_ref(), to, *pace),
            Clause::TurnAt { turn, nth, lights } => self.turn_at(*turn, *nth, *lights),
            Clause::Block => self.round_the_block(),
            Clause::Park { at } => self.park(at.as_ref()),
            Clause::Stay { body, seconds } => {
                self.add_one(body)?;
                self.push(PlanStep::Wait { seconds: *seconds });
                Ok(())
            }
            Clause::Cross => self.cross(),
            Clause::Forward => self.act(Action::MoveForward { speed: WALKING }),
            Clause::Follow { whom, pace } => self.follow(whom, *pace),
            Clause::Take { what, to, grip } => self.take_to(what, to.as_ref(), *grip),
            Clause::Drop { what, at, manner } => self.drop(what.as_ref(), at.as_ref(), *manner),
            Clause::Give { what, to } => self.give(what.as_ref(), to),
            Clause::Throw { what, to } => self.throw(what.as_ref(), to),
            Clause::Buy { goods, times, at, whom } => self.buy(goods, *times, at.as_ref(), whom.as_ref()),
            Clause::Mention { what } => self.speak_of(what),
            Clause::Sit { on } => self.sit(on.as_ref()),
            Clause::Board { what, to } => self.board(what).and_then(|()| self.go_on_to(to.as_ref())),
            Clause::Drive { to, pace } => self.drive(to, *pace),
            Clause::Alight { from } => self.alight(*from),
            Clause::If { test, then, otherwise } => self.either(test, then, otherwise),
            Clause::Until { test, body } => {
                // What is done is said first: "look at Fay until she is near you".
                let steps = self.block(body)?;
                let condition = self.condition(test)?;
                if let (Condition::Near { what: Which::Entity(id), .. }, []) = (&condition, &steps[..]) {
                    self.beside = Some(*id); // who came to me need not be gone to
                }
                self.push(PlanStep::Until { condition, steps });
                Ok(())
            }
            Clause::Repeat { times: 1, body } => self.add_all(body),
            Clause::Repeat { times, body } => {
                let steps = self.block(body)?;
                self.push(PlanStep::Repeat { times: *times, steps });
                Ok(())
            }
            other => self.bear(other),
        }
    }

    /// How one stands, waits, steps and turns.
    fn bear(&mut self, clause: &Clause) -> Result<(), PlanError> {
        match clause {
            Clause::StandUp => {
                self.posture = Posture::Standing;
                self.act(Action::StandUp)
            }
            Clause::Crouch => self.act(Action::Crouch),
            Clause::Stop if matches!(self.last_step(), Some(PlanStep::Act(Action::Stop))) => Ok(()),
            Clause::Stop => self.act(Action::Stop),
            Clause::Wait { seconds } => {
                self.push(PlanStep::Wait { seconds: *seconds });
                Ok(())
            }
            Clause::Step { direction: StepDirection::Left, .. } if self.drives() => {
                self.turn_driving(FRAC_PI_2)
            }
            Clause::Step { direction: StepDirection::Right, .. } if self.drives() => {
                self.turn_driving(-FRAC_PI_2)
            }
            Clause::Step { direction, distance } => {
                self.get_up()?;
                self.act(Action::Step { direction: *direction, distance: *distance })
            }
            Clause::Turn { angle } if self.drives() => self.turn_driving(*angle),
            Clause::Turn { angle } => {
                self.get_up()?;
                self.view.heading += angle;
                if angle.abs() > std::f64::consts::TAU - 1e-6 {
                    self.act(Action::Rotate { angle: std::f64::consts::PI })?; // all the way round is two halves
                    return self.act(Action::Rotate { angle: std::f64::consts::PI });
                }
                self.act(Action::Rotate { angle: wrap_angle(*angle) })
            }
            other => self.express(other),
        }
    }

    /// What one shows or says, and does with doors, cameras and eyes.
    fn express(&mut self, clause: &Clause) -> Result<(), PlanError> {
        match clause {
            Clause::Face { what } => self.face(what),
            Clause::TurnFrom { what } => {
                self.face(what)?;
                self.view.heading += std::f64::consts::PI;
                self.act(Action::Rotate { angle: std::f64::consts::PI })
            }
            Clause::FaceCompass(compass) => self.face_compass(*compass),
            Clause::LookUp { angle } if *angle > 0.0 => self.act(Action::LookUp { angle: *angle }),
            Clause::LookUp { angle } => self.act(Action::LookDown { angle: -angle }),
            Clause::Point { at } => {
                self.can(ActionKind::PointDirection)?;
                let at = self.goal(at)?;
                // "Show me the tower, just point at it".
                if !matches!(self.last_step(), Some(PlanStep::Point { at: last }) if *last == at) {
                    self.push(PlanStep::Point { at });
                }
                Ok(())
            }
            Clause::Wave { to } => {
                self.can(ActionKind::WaveHand)?;
                let found = self.find(to, Purpose::Any)?;
                let house = found.kind == EntityKind::Building && matches!(to.target, Target::Named(_));
                if house
                    && found
                        .info
                        .name
                        .as_deref()
                        .is_some_and(|name| name.contains(' ') && !to.text.contains(' '))
                {
                    return Err(self.view.not_found(to, Purpose::Any)); // "the pilot" is not the Pilot School
                }
                self.act(Action::WaveHand { to: found.id })
            }
            Clause::Say { to, words } => {
                self.can(ActionKind::Converse)?;
                let with = self.go_to_somebody(to, "talk to")?;
                self.act(Action::Converse { with, words: words.clone() })
            }
            Clause::Argue { with } => {
                self.can(ActionKind::Argue)?;
                let with = self.go_to_somebody(with, "argue with")?;
                self.act(Action::Argue { with })
            }
            Clause::Door { what, open } => self.door(what.as_ref(), *open),
            Clause::Photo { of, times } => self.photo(of.as_ref(), *times),
            Clause::Speed { speed } => self.act(Action::ChangeSpeed { speed: *speed }),
            _ => Ok(()),
        }
    }

    fn either(&mut self, test: &Test, then: &[Clause], otherwise: &[Clause]) -> Result<(), PlanError> {
        let condition = self.condition(test)?;
        let (held, carried, posture, beside, there) =
            (self.held, self.carried, self.posture, self.beside, self.there);
        let (from, heading) = (self.view.from, self.view.heading);
        match &condition {
            Condition::Holds(Some(item)) => {
                self.held.get_or_insert(Load::Thing(*item));
            }
            // Whatever it is.
            Condition::Holds(None) => {
                self.held.get_or_insert(Load::Bought);
            }
            _ => {}
        }
        let (spoken_of, delivered) = (self.view.it, self.delivered);
        let then = self.block(then)?;
        let it = std::mem::replace(&mut self.view.it, spoken_of);
        // What else is done starts from where the first would have.
        (self.held, self.carried, self.posture, self.beside, self.there) =
            (held, carried, posture, beside, there);
        (self.view.from, self.view.heading) = (from, heading);
        self.view.told.take();
        let delivered = std::mem::replace(&mut self.delivered, delivered);
        let otherwise = self.block(otherwise)?;
        self.delivered = self.delivered.or(delivered);
        self.beside = None;
        self.view.it = it;
        self.push(PlanStep::If { condition, then, otherwise });
        Ok(())
    }

    /// The steps of orders that are done as one.
    fn block(&mut self, clauses: &[Clause]) -> Result<Vec<PlanStep>, PlanError> {
        let outer = std::mem::take(&mut self.plan.steps);
        let result = self.add_all(clauses);
        let inner = std::mem::replace(&mut self.plan.steps, outer);
        result.map(|()| inner)
    }

    pub(super) fn last_step(&self) -> Option<&PlanStep> {
        self.plan.steps.last()
    }

    pub(super) fn steps_so_far(&self) -> usize {
        self.plan.steps.len()
    }

    /// Takes the steps from there on out again.
    pub(super) fn take_back(&mut self, from: usize) -> Vec<PlanStep> {
        self.plan.steps.split_off(from)
    }

    pub(super) fn push(&mut self, step: PlanStep) {
        self.plan.steps.push(step);
    }

    pub(super) fn act(&mut self, action: Action) -> Result<(), PlanError> {
        self.can(action.kind())?;
        self.push(PlanStep::Act(action));
        Ok(())
    }

    /// Whether a body of the agent's kind ever does that.
    pub(super) fn can(&self, action: ActionKind) -> Result<(), PlanError> {
        if self.supports.contains(action) {
            return Ok(());
        }
        let names: Vec<String> = self.supports.iter().map(|kind| kind.to_string()).collect();
        Err(PlanError::Unable { kind: self.kind, action, hint: format!("it can {}", names.join(", ")) })
    }

    pub(super) fn find(
        &mut self,
        reference: &Reference,
        purpose: Purpose,
    ) -> Result<EntityRef<'a>, PlanError> {
        let found = self.view.find(reference, purpose)?;
        self.mention(&found);
        Ok(found)
    }

    /// Remembers what was spoken of.
    pub(super) fn mention(&mut self, entity: &EntityRef<'_>) {
        if is_animate(entity.kind) {
            self.view.them = Some(entity.id);
        }
        // Nobody calls a person "it".
        if entity.kind != EntityKind::Person {
            self.view.it = Some(entity.id);
        }
        if is_item(entity.kind) {
            self.view.item = Some(entity.id);
        }
    }

    // ---- going somewhere ----

    pub(super) fn go_on_to(&mut self, to: Option<&Reference>) -> Result<(), PlanError> {
        to.map_or(Ok(()), |to| self.go(to, None, Pace::Usual, None))
    }

    pub(super) fn go(
        &mut self,
        to: &Reference,
        side: Option<Spot>,
        pace: Pace,
        within: Option<f64>,
    ) -> Result<(), PlanError> {
        let (goal, usual) = match (&to.target, side) {
            (Target::There, _) => self.there.ok_or_else(|| PlanError::NotFound {
                wanted: "place that \"there\" could stand for".to_owned(),
                near: "name it first, in the same sentence".to_owned(),
            })?,
            (Target::Here, _) => (Goal::Point(self.on_level(self.view.origin)), AT_POINT),
            (Target::Point { x, y, z }, _) => {
                (Goal::Point(Point3::new(*x, *y, z.unwrap_or(self.level))), AT_POINT)
            }
            (_, side) => {
                let entity = self.find(to, Purpose::Any)?;
                let beside = side.and_then(|side| spot_on_side(&entity, side, self.room()));
                let stays = side.is_some() && beside.is_none() && within.is_none() && pace == Pace::Usual;
                if stays && self.beside == Some(entity.id) {
                    return Ok(()); // "go to the truck and stand next to it"
                }
                if let Some(spot) = beside {
                    (Goal::Point(spot), AT_POINT)
                } else {
                    let reach = reach_of(&entity);
                    self.beside = Some(entity.id).filter(|_| within.is_none_or(|within| within <= reach));
                    (Goal::Entity(entity.id), reach)
                }
            }
        };
        let (within, speed) = (within.unwrap_or(usual), speed_of(pace));
        // "Find the smallest house and walk over to it": one is there by then.
        let is_named = matches!(goal, Goal::Entity(_)) && to.target != Target::There;
        if is_named && self.last_step() == Some(&PlanStep::Navigate { to: goal, within, speed }) {
            return Ok(());
        }
        self.navigate(goal, within, speed)
    }

    /// Goes to where an entity is within reach, unless one is there by then.
    pub(super) fn go_beside(&mut self, entity: &EntityRef<'_>) -> Result<(), PlanError> {
        if self.beside != Some(entity.id) {
            self.navigate(Goal::Entity(entity.id), reach_of(entity), None)?;
            self.beside = Some(entity.id);
        }
        Ok(())
    }

    pub(super) fn navigate(&mut self, to: Goal, within: f64, speed: Option<f64>) -> Result<(), PlanError> {
        if self.posture != Posture::Aboard {
            self.get_up()?;
        }
        self.there = Some((to, within));
        self.spoken_of_place = false;
        let before = self.view.from;
        self.view.from = self.place_of(to);
        self.view.told.take();
        let way = self.view.from - before;
        if way.norm() > within {
            self.view.heading = heading(&way);
        }
        self.push(PlanStep::Navigate { to, within, speed });
        Ok(())
    }

    pub(super) fn place_of(&self, goal: Goal) -> Point2 {
        match goal {
            Goal::Point(point) => point.xy(),
            Goal::Entity(id) => {
                self.view.scene.entity(id).map_or(self.view.from, |entity| entity.access().xy())
            }
            _ => self.view.from,
        }
    }

    pub(super) fn goal(&mut self, reference: &Reference) -> Result<Goal, PlanError> {
        Ok(match (&reference.target, self.there) {
            (Target::Point { x, y, z }, _) => Goal::Point(Point3::new(*x, *y, z.unwrap_or(self.level))),
            (Target::There, Some((goal, _))) => goal,
            (Target::Here, _) => Goal::Point(self.on_level(self.view.origin)),
            _ => Goal::Entity(self.find(reference, Purpose::Any)?.id),
        })
    }

    /// How far from a thing the middle of the body comes to stand, m.
    fn room(&self) -> f64 {
        if self.drives() { ROOM + self.half_length } else { ROOM }
    }

    /// Nobody walks while sitting or aboard.
    pub(super) fn get_up(&mut self) -> Result<(), PlanError> {
        let action = match self.posture {
            Posture::Seated => Action::StandUp,
            Posture::Aboard => Action::ExitCar,
            Posture::Standing | Posture::Riding => return Ok(()),
        };
        self.posture = Posture::Standing;
        self.act(action)
    }

    pub(super) fn on_level(&self, point: Point2) -> Point3 {
        Point3::new(point.x, point.y, self.level)
    }
}

pub(super) fn reach_of(entity: &EntityRef<'_>) -> f64 {
    if entity.kind == EntityKind::Person { AT_PERSON } else { AT_THING }
}

pub(super) const fn speed_of(pace: Pace) -> Option<f64> {
    match pace {
        Pace::Usual => None,
        Pace::Run => Some(RUNNING),
        Pace::Slow => Some(STROLLING),
        Pace::At(speed) => Some(speed),
    }
}
