//! Orders to the traffic of a world: carried out at the beginning of a step, and reported if they cannot be.

use simworld_core::event::EventKind;
use simworld_core::id::EntityId;
use simworld_core::scene::World;
use simworld_core::traffic::{ClosedWay, LaneChoice, RoadLeg, TrafficOrder};

use super::TrafficDynamics;
use super::handed::Who;
use crate::vehicle::VehicleKind;
use crate::{
    AtDestination, Closed, Closure, ControlError, Drive, Kerbs, LaneWish, Leg, Route, Stroll, TrafficError,
};

/// The event of a closure.
const CLOSED: &str = "closed";

impl TrafficDynamics {
    /// Carries out what was asked of the traffic in this step.
    pub(super) fn obey(&mut self, world: &mut World) {
        for order in world.take_orders() {
            match self.carry_out(world, &order) {
                Ok(None) => {}
                Ok(Some(number)) => {
                    world.emit(EventKind::task(CLOSED, None).with("number", i64::from(number)));
                }
                Err(error) => world.emit(order.refused(error.to_string())),
            }
        }
    }

    /// Carries out an order; gives the number of a closure.
    fn carry_out(&mut self, world: &World, order: &TrafficOrder) -> Result<Option<u32>, TrafficError> {
        match order {
            TrafficOrder::Close { what, seconds } => {
                let (from, what) = (self.traffic.seconds(), closed(*what));
                let until = seconds.map_or(f64::INFINITY, |seconds| from + seconds);
                return self.traffic.close(Closure { what, from, until }).map(Some);
            }
            TrafficOrder::Reopen { number } => {
                if !self.traffic.reopen(*number) {
                    return Err(TrafficError::Closure { reason: "there is no closure of that number" });
                }
            }
            TrafficOrder::Halt { who, seconds } => {
                let id = self.vehicle_of(*who)?;
                self.traffic.halt(id, seconds.unwrap_or(f64::INFINITY))?;
            }
            TrafficOrder::Park { who, leg: at, station, seconds } => {
                let id = self.vehicle_of(*who)?;
                self.traffic.park(id, leg(*at), *station, *seconds)?;
            }
            TrafficOrder::SendVehicle { kind, route, from, to } => {
                let known = VehicleKind::ALL.into_iter().find(|own| own.as_str() == kind);
                let kind = known.ok_or(TrafficError::NoVehicle { kind: kind.clone() })?;
                let (route, kerbs) =
                    (route.iter().copied().map(leg).collect(), Kerbs { from: *from, to: *to });
                let now = self.traffic.seconds();
                self.traffic.insert_between(Route(route), kind.into(), now, kerbs)?;
            }
            TrafficOrder::Siren { who, is_on } => {
                let id = self.vehicle_of(*who)?;
                self.traffic.set_siren(id, *is_on)?;
            }
            TrafficOrder::AddWalker { at, to } => {
                self.traffic.add_walker(*at, *to)?;
            }
            TrafficOrder::SendWalker { who, to, leaves } => {
                let then = if *leaves { AtDestination::Leave } else { AtDestination::Wander };
                let id = self.walker_of(*who)?;
                self.traffic.send_walker(id, *to, then)?;
            }
            TrafficOrder::Drive { who, acceleration, lane, next } => {
                let (lane, next) = (wish(*lane), next.map(leg));
                let id = self.vehicle_of(*who)?;
                self.traffic.drive(id, Drive { acceleration: *acceleration, lane, next })?;
            }
            TrafficOrder::Guide { who, speed, keep_right, dares } => {
                let stroll = Stroll { speed: *speed, keep_right: *keep_right, dares: *dares };
                let id = self.walker_of(*who)?;
                self.traffic.guide_walker(id, stroll)?;
            }
            order => self.operate(world, order)?,
        }
        Ok(None)
    }

    /// Carries out an order to signals, or to somebody's way or driver.
    fn operate(&mut self, world: &World, order: &TrafficOrder) -> Result<(), TrafficError> {
        match order {
            TrafficOrder::HoldSignal { group, seconds } => {
                self.traffic.hold_signal(*group, seconds.unwrap_or(f64::INFINITY))?;
            }
            TrafficOrder::FreeSignal { group } => self.traffic.free_signal(*group)?,
            TrafficOrder::TimeSignal { group, timing } => self.traffic.time_signal(*group, *timing)?,
            TrafficOrder::TurnRound { who } => {
                let id = self.vehicle_of(*who)?;
                self.traffic.turn_round(id)?;
            }
            TrafficOrder::Reroute { who, through } => {
                let through: Vec<Leg> = through.iter().copied().map(leg).collect();
                let id = self.vehicle_of(*who)?;
                self.traffic.reroute(id, &through)?;
            }
            TrafficOrder::HandOver { who } => self.hand_over(*who)?,
            TrafficOrder::GiveBack { who } => self.give_back(world, *who)?,
            _ => return Err(TrafficError::Order { name: order.name() }),
        }
        Ok(())
    }

    fn vehicle_of(&self, entity: EntityId) -> Result<u32, ControlError> {
        match self.who(entity) {
            Some(Who::Vehicle(id)) => Ok(id),
            _ => Err(ControlError::NoEntity { entity }),
        }
    }

    fn walker_of(&self, entity: EntityId) -> Result<u32, ControlError> {
        match self.who(entity) {
            Some(Who::Walker(id)) => Ok(id),
            _ => Err(ControlError::NoEntity { entity }),
        }
    }
}

fn leg((road, direction): RoadLeg) -> Leg {
    Leg::new(road, direction)
}

fn closed(what: ClosedWay) -> Closed {
    match what {
        ClosedWay::Leg(at) => Closed::Leg(leg(at)),
        ClosedWay::Lane(lane) => Closed::Lane(lane),
        ClosedWay::Stretch(lane, from, to) => Closed::Stretch(lane, from, to),
    }
}

fn wish(lane: LaneChoice) -> LaneWish {
    match lane {
        LaneChoice::Keep => LaneWish::Keep,
        LaneChoice::Left => LaneWish::Left,
        LaneChoice::Right => LaneWish::Right,
        LaneChoice::AsDriven => LaneWish::AsDriven,
    }
}
