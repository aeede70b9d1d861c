//! Structured calls: the same plans without words.

use std::collections::BTreeMap;

use simworld_core::action::Action;
use simworld_core::geometry::Point3;
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;
use simworld_core::seam::{Goal, Plan, PlanError, PlanStep};
use simworld_core::value::Value;

use super::{PLACE_DISTANCE, USE_DISTANCE};

const CALLS: &str = "navigate(to) or navigate(x, y), pick_up(item), drop_off(), sit_down(seat), stand_up(), \
                     ride_scooter(scooter), get_off_scooter(), stop(), wait(seconds)";

struct Call<'a> {
    name: &'a str,
    args: &'a BTreeMap<String, Value>,
    scene: &'a dyn Scene,
}

pub(super) fn plan_call(
    name: &str,
    args: &BTreeMap<String, Value>,
    scene: &dyn Scene,
    _who: EntityId,
) -> Result<Plan, PlanError> {
    let call = Call { name, args, scene };
    let act = |action| Ok(Plan { steps: vec![PlanStep::Act(action)] });
    match name {
        "navigate" => call.navigate(),
        "pick_up" => call.use_entity("item", |item| Action::PickUp { item }),
        "sit_down" => call.use_entity("seat", |seat| Action::SitDown { seat }),
        "ride_scooter" => call.use_entity("scooter", |scooter| Action::RideScooter { scooter }),
        "drop_off" => act(Action::DropOff),
        "stand_up" => act(Action::StandUp),
        "get_off_scooter" => act(Action::GetOffScooter),
        "stop" => act(Action::Stop),
        "wait" => {
            Ok(Plan { steps: vec![PlanStep::Wait { seconds: call.number("seconds", 0.0, 86_400.0)? }] })
        }
        _ => Err(call.wrong(format!("is unknown: call {CALLS}"))),
    }
}

impl Call<'_> {
    fn wrong(&self, reason: String) -> PlanError {
        PlanError::Call { call: self.name.chars().take(80).collect(), reason }
    }

    fn number(&self, key: &str, low: f64, high: f64) -> Result<f64, PlanError> {
        let number = self.args.get(key).and_then(Value::as_f64);
        number
            .filter(|number| (low..=high).contains(number))
            .ok_or_else(|| self.wrong(format!("{key} must be a number from {low} to {high}")))
    }

    fn entity(&self, key: &str) -> Result<EntityId, PlanError> {
        let id = self.args.get(key).and_then(Value::as_entity);
        let id = id.ok_or_else(|| self.wrong(format!("{key} must be an entity")))?;
        match self.scene.entity(id) {
            Some(_) => Ok(id),
            None => Err(self.wrong(format!("{key} = {id}: there is no such entity"))),
        }
    }

    fn navigate(&self) -> Result<Plan, PlanError> {
        let to = if self.args.contains_key("to") {
            Goal::Entity(self.entity("to")?)
        } else {
            let (x, y) = (self.number("x", -1e7, 1e7)?, self.number("y", -1e7, 1e7)?);
            Goal::Point(Point3::new(x, y, 0.0))
        };
        let speed =
            if self.args.contains_key("speed") { Some(self.number("speed", 0.1, 10.0)?) } else { None };
        Ok(Plan { steps: vec![PlanStep::Navigate { to, within: PLACE_DISTANCE, speed }] })
    }

    fn use_entity(&self, key: &str, action: impl Fn(EntityId) -> Action) -> Result<Plan, PlanError> {
        let id = self.entity(key)?;
        Ok(Plan::navigate(Goal::Entity(id), USE_DISTANCE).then(action(id)))
    }
}
