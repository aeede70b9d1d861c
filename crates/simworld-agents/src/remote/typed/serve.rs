//! How the world's thread answers the calls of the typed protocol.

use simworld_core::clock::Tick;
use simworld_core::command::Command;

use super::message::{
    Answer, CameraInfo, Description, Done, Message, MessageError, Refusal, Request, read_call,
};
use crate::remote::engine::{Later, Outcome, Served};
use crate::remote::watch::{Observation, Query, Watcher, look};
use crate::remote::{CameraPlace, Mount};

/// Answers a call.
pub(in crate::remote) fn answer(served: &mut Served<'_>, payload: &[u8]) -> Outcome {
    let call = match read_call(payload) {
        Ok(call) => call,
        Err(MessageError::Call { id }) => return Outcome::Reply(reply(id, Err(Refusal::Malformed))),
        // Number 0 is what a client that sends such bytes gets.
        Err(MessageError::Unreadable) => return Outcome::Reply(reply(0, Err(Refusal::Malformed))),
    };
    match call.request {
        Request::Tick(steps) => match check_steps(served, steps) {
            Ok(()) => Outcome::After(steps, Later::Typed(call.id)),
            Err(refusal) => Outcome::Reply(reply(call.id, Err(refusal))),
        },
        Request::Watch { query, every } => match check_query(&query) {
            Ok(()) => Outcome::Watch(reply(call.id, Ok(Answer::Ok)), Some(Watcher::new(query, every))),
            Err(refusal) => Outcome::Reply(reply(call.id, Err(refusal))),
        },
        Request::Unwatch => Outcome::Watch(reply(call.id, Ok(Answer::Ok)), None),
        request => Outcome::Reply(reply(call.id, at_once(served, request))),
    }
}

/// The message that the steps of a call have passed.
pub(in crate::remote) fn ticked(call: u64, tick: Tick) -> Vec<u8> {
    reply(call, Ok(Answer::Ticked(tick)))
}

/// The message of an observation.
pub(in crate::remote) fn observation(observation: Observation) -> Vec<u8> {
    encode(&Message::Observation(observation))
}

fn at_once(served: &mut Served<'_>, request: Request) -> Result<Answer, Refusal> {
    match request {
        Request::Describe => Ok(Answer::Description(describe(served))),
        Request::Submit(commands) => {
            Ok(Answer::Submitted(commands.into_iter().map(|command| submit(served, command)).collect()))
        }
        Request::SetPace(pace) => {
            pace.validate().map_err(|error| Refusal::Impossible(error.to_string()))?;
            served.pace = pace;
            Ok(Answer::Ok)
        }
        Request::Query(query) => {
            check_query(&query)?;
            Ok(Answer::Found(look(served.stage.scene(), &query, served.limits.entities)))
        }
        Request::Entity(id) => {
            Ok(Answer::Entity(served.stage.scene().entity(id).map(|entity| Box::new(entity.to_desc()))))
        }
        Request::Cameras => {
            let cameras = served.cameras.iter().map(|(number, place)| CameraInfo { number, place: *place });
            Ok(Answer::Cameras(cameras.collect()))
        }
        Request::AddCamera(place) => {
            check_camera(served, &place)?;
            served.cameras.forget_gone(served.stage.scene());
            let full = || Refusal::Impossible(format!("there are {} cameras already", served.limits.cameras));
            served.cameras.add(place).map(Answer::Camera).ok_or_else(full)
        }
        Request::SetCamera(number, place) => {
            check_camera(served, &place)?;
            let missing = || Refusal::Impossible(format!("there is no camera {number}"));
            *served.cameras.get_mut(number).ok_or_else(missing)? = place;
            Ok(Answer::Ok)
        }
        Request::Picture(camera, kind) => match served.picture(camera, kind) {
            Ok(picture) => Ok(Answer::Picture(picture)),
            Err(refused) => Err(Refusal::Impossible(refused.to_string())),
        },
        Request::Digest => Ok(Answer::Digest(served.stage.digest())),
        // These were answered before.
        Request::Tick(_) | Request::Watch { .. } | Request::Unwatch => Err(Refusal::Malformed),
    }
}

fn submit(served: &mut Served<'_>, command: Command) -> Done {
    match served.apply(command) {
        Ok(applied) => applied.spawned.map_or(Done::Applied, Done::Spawned),
        Err(refused) => Done::Refused(refused.to_string()),
    }
}

fn describe(served: &Served<'_>) -> Description {
    let scene = served.stage.scene();
    let clock = scene.clock();
    let assets = scene.assets().map(|assets| assets.iter().map(|(_, asset)| asset.name.clone()).collect());
    Description {
        name: served.name.to_owned(),
        tick: clock.tick(),
        dt: clock.dt(),
        pace: served.pace,
        assets: assets.unwrap_or_default(),
    }
}

fn check_steps(served: &Served<'_>, steps: u32) -> Result<(), Refusal> {
    let most = served.limits.steps;
    if (1..=most).contains(&steps) {
        return Ok(());
    }
    Err(Refusal::Range { field: "steps".to_owned(), allowed: format!("1 to {most}") })
}

fn check_query(query: &Query) -> Result<(), Refusal> {
    let (min, max) = (query.region.min, query.region.max);
    if (0..3).all(|axis| min[axis] <= max[axis]) {
        return Ok(());
    }
    let allowed = "a box whose least corner is not beyond its greatest, without NaN";
    Err(Refusal::Range { field: "region".to_owned(), allowed: allowed.to_owned() })
}

fn check_camera(served: &Served<'_>, place: &CameraPlace) -> Result<(), Refusal> {
    place.validate(served.limits).map_err(|error| Refusal::Impossible(error.to_string()))?;
    let pose = match place.mount {
        Mount::Free(pose) => pose,
        Mount::Worn(who, pose) => {
            if served.stage.scene().entity(who).is_none() {
                return Err(Refusal::Impossible(format!("there is no entity {who} to wear it")));
            }
            pose
        }
    };
    let is_pose = pose.translation.vector.iter().all(|x| x.is_finite())
        && (pose.rotation.coords.norm() - 1.0).abs() < 1e-3;
    if is_pose {
        return Ok(());
    }
    let allowed = "finite numbers and a unit quaternion";
    Err(Refusal::Range { field: "camera pose".to_owned(), allowed: allowed.to_owned() })
}

fn reply(call: u64, answer: Result<Answer, Refusal>) -> Vec<u8> {
    encode(&Message::Answer(call, answer))
}

fn encode(message: &Message) -> Vec<u8> {
    // Messages are plain data, which postcard always takes; an empty frame would be refused by the client.
    postcard::to_stdvec(message).unwrap_or_default()
}
