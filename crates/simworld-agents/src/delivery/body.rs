//! What the world does to couriers: they move, tire, rest, and mount what they bought.

use std::ops::{ControlFlow, RangeInclusive};

use simworld_core::action::Action;
use simworld_core::command::Command;
use simworld_core::exertion::Exertion;
use simworld_core::geometry::{Aabb, Point3, Pose, pose_facing, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::scene::{ARM_REACH, Attachment, EntityDesc, EntityKind, Role, Shape};
use simworld_core::value::Value;

use super::config::EnergyConfig;
use super::order::{OrderId, Stage};
use super::state::{Courier, Errand, Ride, State};
use super::turn::{Turn, fact};

/// How far to the left of its owner a scooter stands, m.
pub(super) const BESIDE: f64 = 0.9;
/// Slower than this is rest, m/s.
const STANDING: f64 = 0.1;

/// Masses that a body may have, kg; who is said to weigh anything else weighs [`EnergyConfig::body`]. Those of people under physics.
const BODIES: RangeInclusive<f64> = 1.0..=1000.0;

impl EnergyConfig {
    /// Metabolic energy that a unit of energy stands for, J: by default 333 W at 1.4 m/s (Pandolf 1977, 75 kg), so 238 J a metre and
    /// 2,379 J a unit. Infinite where walking costs nothing.
    pub fn joules(&self) -> f64 {
        let walker = Exertion { body: self.body, ..Exertion::default() };
        walker.power(self.walking_speed, 0.0) / (self.walking * self.walking_speed)
    }

    /// What a metre on foot costs on level ground at a speed in m/s.
    pub fn per_metre(&self, walker: &Exertion, speed: f64) -> f64 {
        let speed = speed.max(STANDING);
        walker.power(speed, 0.0) / speed / self.joules()
    }
}

impl Turn<'_> {
    /// Takes in how far a courier moved: it costs energy, and brings along what it carries.
    pub(super) fn exert(&mut self, index: usize) {
        self.weigh(index);
        let courier = &mut self.state.couriers[index];
        let Some(body) = self.scene.entity(courier.id) else { return };
        let (from, to) =
            (Point3::new(courier.position.x, courier.position.y, courier.height), body.position());
        let moved = (to.xy() - courier.position).norm();
        (courier.position, courier.height) = (to.xy(), to.z);
        let speed = moved / self.state.dt;
        let energy = &self.config.energy;
        let before = courier.energy;
        if speed < STANDING {
            courier.energy = (before + energy.rest * self.state.dt).min(energy.capacity);
        } else {
            let afoot = || courier.exertion.energy(&from, &to, self.state.dt) / energy.joules();
            let cost = match courier.ride {
                Ride::Riding(_) => moved * energy.riding,
                Ride::Dragging(_) => afoot() * self.config.battery.dragging_effort,
                Ride::None | Ride::Ordered | Ride::Beside(_) => afoot(),
            };
            courier.energy = (before - cost * self.state.effort).max(0.0);
            courier.tally.energy += before - courier.energy;
            courier.tally.distance += moved;
        }
        let State { couriers, orders, .. } = &mut *self.state;
        for id in &couriers[index].held {
            if let Stage::Carried(carried) = &mut orders[id.index()].stage {
                carried.distance += moved;
            }
        }
        self.drain(index, moved, speed);
        self.tire(index);
    }

    /// Who walks, with which parcels in hand and on the back, on what. A parcel that somebody took away weighs nothing any more.
    fn weigh(&mut self, index: usize) {
        let State { couriers, orders, terrain, .. } = &mut *self.state;
        let courier = &mut couriers[index];
        let mass = |id| self.scene.entity(id)?.mass(self.scene);
        let borne = |id: EntityId| {
            let bond = self.scene.entity(id)?.attachment?;
            (bond.parent == courier.id).then(|| mass(id)).flatten()
        };
        let parcels = courier.held.iter().filter_map(|id| match &orders[id.index()].stage {
            Stage::Carried(carried) => borne(carried.parcel?),
            _ => None,
        });
        let load = parcels.filter(|mass| mass.is_finite() && *mass > 0.0).sum();
        let body = mass(courier.id).filter(|mass| BODIES.contains(mass)).unwrap_or(self.config.energy.body);
        courier.exertion = Exertion { body, load, terrain: *terrain };
    }

    fn tire(&mut self, index: usize) {
        let energy = &self.config.energy;
        let courier = &mut self.state.couriers[index];
        let low = courier.energy < energy.low;
        if low != courier.low {
            courier.low = low;
            courier.notices += 1;
        }
        if courier.exhausted {
            self.wake(index);
        } else if courier.energy <= 0.0 {
            courier.exhausted = true;
            courier.tally.exhaustions += 1;
            self.halt(index);
            self.tell("courier_exhausted", Some(index), &[]);
        }
    }

    /// An exhausted courier gets up again once it has rested or drunk enough.
    pub(super) fn wake(&mut self, index: usize) {
        let courier = &mut self.state.couriers[index];
        if courier.exhausted && courier.energy >= self.config.energy.ready {
            courier.exhausted = false;
            let energy = courier.energy;
            self.tell("courier_recovered", Some(index), &[("energy", energy.into())]);
        }
    }

    /// Puts a parcel into a courier's hand, or on its back if the hand is full.
    pub(super) fn spawn_parcel(&mut self, index: usize, order: OrderId) {
        let who = self.state.couriers[index].id;
        let Some(body) = self.scene.entity(who) else { return };
        let bond = self.grip(index, who);
        let pose = body.pose * bond.parent_from_body;
        let mut parcel = EntityDesc::new(EntityKind::Parcel, pose, Shape::cuboid(0.3, 0.3, 0.2))
            .weighing(self.config.orders.parcel)
            .named(format!("order {order}"))
            .with("order", fact(order));
        parcel.attachment = Some(bond);
        self.command(Command::Spawn(Box::new(parcel)));
    }

    /// Where the next parcel of a courier goes.
    pub(super) fn grip(&self, index: usize, who: EntityId) -> Attachment {
        let others = self.state.carried_by(index).saturating_sub(1);
        let (role, x, y, z) = match others {
            0 => (Role::Held, 0.35, -0.25, 0.9),
            behind => (Role::Part, -0.3, 0.0, 0.9 + 0.22 * (behind - 1) as f64),
        };
        Attachment { parent: who, role, parent_from_body: Pose::translation(x, y, z) }
    }

    /// Learns which entity is the parcel of an order, a step after it was spawned.
    pub(super) fn find_parcels(&mut self, index: usize) {
        let State { couriers, orders, .. } = &mut *self.state;
        let who = couriers[index].id;
        for id in &couriers[index].held {
            let Stage::Carried(carried) = &mut orders[id.index()].stage else { continue };
            if carried.parcel.is_none() {
                let wanted = fact(*id);
                self.scene.visit_attached(who, &mut |child| {
                    if child.info.attributes.get("order") == Some(&wanted) {
                        carried.parcel = Some(child.id);
                    }
                });
            }
        }
    }

    /// Puts a scooter beside a courier; it is mounted in the steps that follow.
    pub(super) fn spawn_scooter(&mut self, index: usize) {
        let Some(body) = self.scene.entity(self.state.couriers[index].id) else { return };
        let scooter = EntityDesc::new(EntityKind::Scooter, beside(body.pose), Shape::cuboid(1.1, 0.45, 1.1))
            .weighing(15.0)
            .with("owner", body.id);
        self.command(Command::Spawn(Box::new(scooter)));
        let courier = &mut self.state.couriers[index];
        courier.ride = Ride::Ordered;
        courier.charge = self.config.battery.when_bought();
    }

    /// Brings a courier and its scooter together.
    pub(super) fn mount(&mut self, index: usize) {
        let Courier { id: who, mut ride, .. } = self.state.couriers[index];
        if ride == Ride::None {
            return;
        }
        let Some(body) = self.scene.entity(who) else { return };
        if ride == Ride::Ordered {
            let owner = Value::Entity(who);
            let _ = self.scene.visit(&Aabb::column_around(body.planar(), 20.0), &mut |entity| {
                if entity.kind == EntityKind::Scooter && entity.info.attributes.get("owner") == Some(&owner) {
                    ride = Ride::Beside(entity.id);
                    return ControlFlow::Break(());
                }
                ControlFlow::Continue(())
            });
        }
        let (Ride::Beside(id) | Ride::Riding(id) | Ride::Dragging(id)) = ride else { return };
        let Some(scooter) = self.scene.entity(id) else {
            self.state.couriers[index].ride = Ride::None;
            self.tell("scooter_lost", Some(index), &[]);
            return;
        };
        if matches!(ride, Ride::Dragging(_)) {
            return;
        }
        let mounted = scooter.attachment.is_some_and(|bond| bond.parent == who && bond.role == Role::Ridden);
        let was = self.state.couriers[index].ride;
        self.state.couriers[index].ride = if mounted { Ride::Riding(id) } else { Ride::Beside(id) };
        if mounted {
            if was != Ride::Riding(id) {
                self.tell("scooter_mounted", Some(index), &[("scooter", id.into())]);
                self.send(index); // goes on, faster
            }
            return;
        }
        if (scooter.planar() - body.planar()).norm() > ARM_REACH * 0.9 {
            self.command(Command::Move { id, pose: beside(body.pose) });
        }
        self.command(Command::Actuate { who, action: Action::RideScooter { scooter: id } });
    }

    /// Whether a courier stands where its errand leads, and which order it is about.
    pub(super) fn waits_at_meeting(&self, index: usize, order: OrderId, meet: &Point3) -> bool {
        self.state.couriers[index].errand == Errand::Meet(order)
            && self.is_at(index, meet, self.config.reach.meeting)
    }
}

/// A pose to the left of a body, upright.
fn beside(body: &Pose) -> Pose {
    pose_facing(body * Point3::new(0.0, BESIDE, 0.0), yaw_of(body))
}
