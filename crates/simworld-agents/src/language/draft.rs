//! Orders to a plan: each is worked out from where the earlier ones leave the agent.

use simworld_core::action::Action;
use simworld_core::geometry::{Point2, Point3};
use simworld_core::id::EntityId;
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{EntityKind, EntityRef, Relation, Role};
use simworld_core::seam::{Goal, Plan, PlanError, PlanStep};

use super::clause::{Clause, Manner, Pace, Reference, Target, Vehicle};
use super::resolve::{Purpose, View};

/// How near one comes to a thing, or to its door, m: well within reach of an arm.
const AT_THING: f64 = 1.0;
/// How near one comes to a point, m.
const AT_POINT: f64 = 0.5;
/// Room for a body between itself and what it stands before, m.
const ROOM: f64 = 0.6;
/// What "run" means, m/s: a slow jog, the most that walkers of the engine can do.
const RUNNING: f64 = 2.5;

/// How the agent's body will be at this point of the plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Posture {
    Standing,
    Seated,
    Aboard,
    Riding,
}

/// A plan in the making.
pub(super) struct Draft<'a> {
    view: View<'a>,
    level: f64,
    plan: Plan,
    posture: Posture,
    held: Option<EntityId>,
    carried: Option<EntityId>,
    /// What one will stand beside, and where one went last.
    beside: Option<EntityId>,
    there: Option<(Goal, f64)>,
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
        Self {
            view,
            level: me.position().z,
            plan: Plan::default(),
            posture,
            held: scene.attached(me.id, Role::Held),
            carried: scene.attached(me.id, Role::Carried),
            beside: None,
            there: None,
        }
    }

    pub(super) fn finish(self) -> Plan {
        self.plan
    }

    /// Adds the steps of one order.
    pub(super) fn add(&mut self, clause: &Clause) -> Result<(), PlanError> {
        match clause {
            Clause::Go { to, side, pace, within } => self.go(to, *side, *pace, *within)?,
            Clause::Take { what, to } => {
                self.take(what)?;
                if let Some(to) = to {
                    self.go(to, None, Pace::Usual, None)?;
                    self.let_go(Manner::PutDown)?;
                }
            }
            Clause::Drop { what, at, manner } => self.drop(what.as_ref(), at.as_ref(), *manner)?,
            Clause::Sit { on } => self.sit(on.as_ref())?,
            Clause::StandUp => {
                self.posture = Posture::Standing;
                self.act(Action::StandUp);
            }
            Clause::Stop => self.act(Action::Stop),
            Clause::Wait { seconds } => self.plan.steps.push(PlanStep::Wait { seconds: *seconds }),
            Clause::Board { what, to } => {
                self.board(what)?;
                if let Some(to) = to {
                    self.go(to, None, Pace::Usual, None)?;
                }
            }
            Clause::Alight { from } => self.alight(*from),
            Clause::Step { direction, distance } => {
                self.get_up();
                self.act(Action::Step { direction: *direction, distance: *distance });
            }
            Clause::Turn { angle } => {
                self.get_up();
                self.act(Action::Rotate { angle: wrap_angle(*angle) });
            }
            Clause::Wave { to } => {
                let to = self.find(to, Purpose::Any)?.id;
                self.act(Action::WaveHand { to });
            }
            Clause::Photo => self.act(Action::TakePhoto),
        }
        Ok(())
    }

    fn act(&mut self, action: Action) {
        self.plan.steps.push(PlanStep::Act(action));
    }

    fn find(&mut self, reference: &Reference, purpose: Purpose) -> Result<EntityRef<'a>, PlanError> {
        let found = self.view.find(reference, purpose)?;
        self.view.it = Some(found.id);
        Ok(found)
    }

    // ---- going somewhere ----

    fn go(
        &mut self,
        to: &Reference,
        side: Option<Relation>,
        pace: Pace,
        within: Option<f64>,
    ) -> Result<(), PlanError> {
        let (goal, usual) = match (&to.target, side) {
            (Target::There, _) => self.there.ok_or_else(|| PlanError::NotFound {
                wanted: "place that \"there\" could stand for".to_owned(),
                near: "name it first, in the same sentence".to_owned(),
            })?,
            (Target::Here, _) => (Goal::Point(self.on_level(self.view.from)), AT_POINT),
            (Target::Point { x, y, z }, _) => {
                (Goal::Point(Point3::new(*x, *y, z.unwrap_or(self.level))), AT_POINT)
            }
            (_, side) => {
                let entity = self.find(to, Purpose::Any)?;
                let beside = side.and_then(|side| spot_on_side(&entity, side));
                if let Some(spot) = beside {
                    (Goal::Point(spot), AT_POINT)
                } else {
                    self.beside = Some(entity.id);
                    (Goal::Entity(entity.id), AT_THING)
                }
            }
        };
        let speed = match pace {
            Pace::Usual => None,
            Pace::Run => Some(RUNNING),
            Pace::At(speed) => Some(speed),
        };
        self.navigate(goal, within.unwrap_or(usual), speed);
        Ok(())
    }

    /// Goes to where an entity is within reach, unless one is there by then.
    fn go_beside(&mut self, entity: &EntityRef<'_>) {
        if self.beside != Some(entity.id) {
            self.navigate(Goal::Entity(entity.id), AT_THING, None);
            self.beside = Some(entity.id);
        }
    }

    fn navigate(&mut self, to: Goal, within: f64, speed: Option<f64>) {
        self.get_up();
        self.there = Some((to, within));
        self.view.from = match to {
            Goal::Point(point) => point.xy(),
            Goal::Entity(id) => {
                self.view.scene.entity(id).map_or(self.view.from, |entity| entity.access().xy())
            }
            _ => self.view.from,
        };
        self.plan.steps.push(PlanStep::Navigate { to, within, speed });
    }

    /// Nobody walks while sitting or aboard.
    fn get_up(&mut self) {
        match self.posture {
            Posture::Seated => self.act(Action::StandUp),
            Posture::Aboard => self.act(Action::ExitCar),
            Posture::Standing | Posture::Riding => return,
        }
        self.posture = Posture::Standing;
    }

    fn on_level(&self, point: Point2) -> Point3 {
        Point3::new(point.x, point.y, self.level)
    }

    // ---- using things ----

    fn take(&mut self, what: &Reference) -> Result<(), PlanError> {
        let item = self.find(what, Purpose::Item)?;
        if self.held == Some(item.id) || self.carried == Some(item.id) {
            return Ok(());
        }
        let id = item.id;
        let action = match item.kind {
            EntityKind::Parcel => Action::PickUp { item: id },
            EntityKind::Chair | EntityKind::Cone | EntityKind::Prop => Action::CarryHeavy { item: id },
            other => {
                let near = format!("a {other} cannot be taken; parcels, chairs, cones and props can");
                return Err(PlanError::NotFound { wanted: format!("{:?} to take", what.text), near });
            }
        };
        self.go_beside(&item);
        match action {
            Action::PickUp { .. } => self.held = Some(id),
            _ => self.carried = Some(id),
        }
        self.act(action);
        self.beside = None; // it comes along
        Ok(())
    }

    fn drop(
        &mut self,
        what: Option<&Reference>,
        at: Option<&Reference>,
        manner: Manner,
    ) -> Result<(), PlanError> {
        // What one has in hand is what "it" is about here, whatever was spoken of since.
        let in_hand = self.held.or(self.carried).is_some();
        if let Some(what) = what.filter(|what| !(in_hand && what.target == Target::It)) {
            let item = self.find(what, Purpose::Item)?;
            let in_hand = [self.held, self.carried].contains(&Some(item.id));
            if !in_hand && manner == Manner::Deliver {
                self.take(what)?;
            } else if !in_hand {
                return Err(self.nothing_in_hand(&what.text));
            }
        }
        if let Some(at) = at {
            let it = self.view.it;
            self.go(at, None, Pace::Usual, None)?;
            self.view.it = it.or(self.view.it);
        }
        self.let_go(if manner == Manner::Deliver { Manner::PutDown } else { manner })
    }

    fn let_go(&mut self, manner: Manner) -> Result<(), PlanError> {
        let heavy = manner == Manner::PutDown && self.carried.is_some();
        let item = if heavy { self.carried.take() } else { self.held.take() };
        let item = item.ok_or_else(|| self.nothing_in_hand("thing"))?;
        self.view.it = Some(item);
        self.act(if heavy { Action::PutDownHeavy } else { Action::DropOff });
        Ok(())
    }

    fn nothing_in_hand(&self, wanted: &str) -> PlanError {
        let near = match self.held.or(self.carried).and_then(|id| self.view.scene.entity(id)) {
            Some(item) => format!("you hold {} {}", item.label(), item.id),
            None => "your hands are empty".to_owned(),
        };
        PlanError::NotFound { wanted: format!("{wanted} in hand"), near }
    }

    fn sit(&mut self, on: Option<&Reference>) -> Result<(), PlanError> {
        let seat = match on {
            Some(reference) => self.find(reference, Purpose::Seat)?,
            None => self.any_seat()?,
        };
        if !seat.kind.is_seat() {
            let near = format!("{} {} is no seat: {}", seat.label(), seat.id, self.view.surroundings());
            return Err(PlanError::NotFound { wanted: "seat of that description".to_owned(), near });
        }
        self.view.it = Some(seat.id);
        self.go_beside(&seat);
        self.posture = Posture::Seated;
        self.act(Action::SitDown { seat: seat.id });
        Ok(())
    }

    /// The seat that was spoken of, or else the nearest free one.
    fn any_seat(&self) -> Result<EntityRef<'a>, PlanError> {
        let spoken_of = self.view.it.and_then(|id| self.view.scene.entity(id));
        if let Some(seat) = spoken_of.filter(|entity| entity.kind.is_seat()) {
            return Ok(seat);
        }
        self.view.find(&Reference::to_any_seat(), Purpose::Seat)
    }

    fn board(&mut self, what: &Reference) -> Result<(), PlanError> {
        let vehicle = self.find(what, Purpose::Any)?;
        let action = match vehicle.kind {
            EntityKind::Scooter => Action::RideScooter { scooter: vehicle.id },
            EntityKind::Car | EntityKind::Truck | EntityKind::Bus => Action::EnterCar { car: vehicle.id },
            EntityKind::Building => {
                self.go_beside(&vehicle);
                return Ok(());
            }
            other => {
                let near = format!("a {other} cannot be; scooters, cars, trucks and buses can");
                return Err(PlanError::NotFound {
                    wanted: format!("{:?} to get on or into", what.text),
                    near,
                });
            }
        };
        self.go_beside(&vehicle);
        self.posture = if vehicle.kind == EntityKind::Scooter { Posture::Riding } else { Posture::Aboard };
        self.act(action);
        Ok(())
    }

    fn alight(&mut self, from: Vehicle) {
        let scooter = match from {
            Vehicle::Scooter => true,
            Vehicle::Car => false,
            Vehicle::Any => self.posture != Posture::Aboard,
        };
        self.posture = Posture::Standing;
        self.act(if scooter { Action::GetOffScooter } else { Action::ExitCar });
    }
}

/// A spot on that side of a thing, at arm's length; `None` for relations that name no side.
fn spot_on_side(entity: &EntityRef<'_>, side: Relation) -> Option<Point3> {
    let half = entity.info.shape.size() * 0.5;
    let local = match side {
        Relation::InFrontOf => Point3::new(half.x + ROOM, 0.0, 0.0),
        Relation::Behind => Point3::new(-half.x - ROOM, 0.0, 0.0),
        Relation::LeftOf => Point3::new(0.0, half.y + ROOM, 0.0),
        Relation::RightOf => Point3::new(0.0, -half.y - ROOM, 0.0),
        _ => return None,
    };
    Some(entity.pose * local)
}
