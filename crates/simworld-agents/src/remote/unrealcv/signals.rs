//! Commands to traffic lights, and to the managers that the release calls intersections.
//!
//! A light stands for the leg of a junction at whose end it stands: it shows one group to vehicles and one to walkers.

use simworld_core::command::Command;
use simworld_core::geometry::Point2;
use simworld_core::id::{EntityId, IntersectionId, RoadId};
use simworld_core::net::{RoadNetwork, SignalGroup};
use simworld_core::scene::Scene;
use simworld_core::traffic::{SignalTiming, TrafficOrder};
use simworld_core::value::Value;

use super::answer::{Answered, Failed, Said};
use super::command::{Order, Verb};
use super::desk::Desk;
use crate::remote::engine::Served;

/// How far a light stands from the crossing that it is for, m.
const POST: f64 = 15.0;

/// What a light shows.
struct Heads {
    vehicles: Option<SignalGroup>,
    walkers: Option<SignalGroup>,
}

pub(super) fn answer(desk: &mut Desk, served: &mut Served<'_>, order: &Order<'_>) -> Answered {
    match order.verb {
        Verb::AddSignal => {
            let post = desk.find(served.stage, order.word(1))?;
            let heads = heads_of(served.stage.scene(), post)?;
            let group = heads.vehicles.or(heads.walkers).ok_or_else(|| no_light(order.word(1)))?;
            if desk.names.give_signal(order.word(0), group) {
                return Ok(Said::Done);
            }
            Err(Failed::NoObject(order.word(0).to_owned()))
        }
        Verb::StartSignals => {
            let groups = desk.names.signals_of(order.word(0));
            let groups = groups.ok_or_else(|| Failed::NoObject(order.word(0).to_owned()))?;
            for group in groups {
                tell(served, TrafficOrder::FreeSignal { group })?;
            }
            Ok(Said::Done)
        }
        _ => {
            let post = desk.find(served.stage, order.word(0))?;
            let heads = heads_of(served.stage.scene(), post)?;
            let (group, wanted) = match order.verb {
                Verb::SwitchGreen => (heads.vehicles, "vehicles"),
                Verb::SwitchWalk => (heads.walkers, "walkers"),
                _ => (heads.vehicles.or(heads.walkers), "anybody"),
            };
            let name = order.word(0);
            let group = group.ok_or_else(|| Failed::State(format!("{name} shows nothing to {wanted}")))?;
            let [green, yellow, walk] = order.numbers(0);
            let timing = SignalTiming { green, yellow, walk };
            tell(
                served,
                match order.verb {
                    Verb::SetDuration => TrafficOrder::TimeSignal { group, timing },
                    _ => TrafficOrder::HoldSignal { group, seconds: None },
                },
            )
        }
    }
}

fn tell(served: &mut Served<'_>, order: TrafficOrder) -> Answered {
    served.apply(Command::Traffic(order))?;
    Ok(Said::Done)
}

fn no_light(name: &str) -> Failed {
    Failed::State(format!("{name} stands at no junction with signals"))
}

/// What a light shows: of the leg of the group that its attribute `signal_group` states, or of the crossing that is nearest.
fn heads_of(scene: &dyn Scene, post: EntityId) -> Result<Heads, Failed> {
    let entity = scene.entity(post).ok_or_else(|| Failed::NoObject(post.to_string()))?;
    let roads = scene.roads().ok_or_else(|| Failed::State("this world has no roads".to_owned()))?;
    let stated = entity.info.attributes.get("signal_group").and_then(Value::as_i64);
    let stated = stated.and_then(|group| u32::try_from(group).ok()).map(SignalGroup);
    let leg = stated.map_or_else(|| nearest_leg(roads, entity.planar()), |group| leg_of(roads, group));
    let (intersection, road) = leg.ok_or_else(|| no_light(entity.label()))?;
    let intersection = &roads.intersections[intersection.index()];
    let comes = intersection.connections.iter().map(|way| &roads.connections[way.index()]);
    let mut comes = comes.filter(|way| roads.lanes[way.from.index()].road == road);
    let mut crosses = intersection.crossings.iter().map(|crossing| &roads.crossings[crossing.index()]);
    Ok(Heads {
        vehicles: comes.find_map(|way| way.signal),
        walkers: crosses.find(|crossing| crossing.road == road).and_then(|crossing| crossing.signal),
    })
}

/// The leg of a junction that a group is for.
fn leg_of(roads: &RoadNetwork, group: SignalGroup) -> Option<(IntersectionId, RoadId)> {
    let way = roads.connections.iter().find(|way| way.signal == Some(group));
    let crossing = || roads.crossings.iter().find(|crossing| crossing.signal == Some(group));
    match way {
        Some(way) => Some((way.intersection, roads.lanes[way.from.index()].road)),
        None => crossing().map(|crossing| (crossing.intersection, crossing.road)),
    }
}

/// The leg whose crossing is nearest to a place, if that is near.
fn nearest_leg(roads: &RoadNetwork, at: Point2) -> Option<(IntersectionId, RoadId)> {
    let signalled = roads.crossings.iter().filter(|crossing| crossing.signal.is_some());
    let near = signalled.map(|crossing| {
        let distance = (crossing.start - at).norm().min((crossing.end - at).norm());
        (distance, (crossing.intersection, crossing.road))
    });
    let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.filter(|(distance, _)| *distance <= POST).map(|(_, leg)| leg)
}
