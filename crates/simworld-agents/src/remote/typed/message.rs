//! The messages of the typed protocol.

use serde::{Deserialize, Serialize};
use simworld_core::clock::Tick;
use simworld_core::command::Command;
use simworld_core::hash::StateDigest;
use simworld_core::id::EntityId;
use simworld_core::scene::EntityDesc;
use thiserror::Error;

use crate::remote::watch::{Found, Observation, Query};
use crate::remote::{CameraPlace, Pace, Picture, PictureKind};

/// A request with the number under which it is answered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Call {
    /// The client's number for it.
    pub id: u64,
    /// What is asked.
    pub request: Request,
}

/// What a client asks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Request {
    /// What is served.
    Describe,
    /// Carry these out before the next step, each by itself.
    Submit(Vec<Command>),
    /// Take so many steps; in real time, wait until so many have passed.
    Tick(u32),
    /// Step so from now on.
    SetPace(Pace),
    /// What is there.
    Query(Query),
    /// Everything about one entity.
    Entity(EntityId),
    /// Send what is there after every so many steps; replaces what was watched before.
    Watch {
        /// What.
        query: Query,
        /// After how many steps each.
        every: u32,
    },
    /// Send no more observations.
    Unwatch,
    /// The cameras.
    Cameras,
    /// Add a camera.
    AddCamera(CameraPlace),
    /// Change a camera.
    SetCamera(u32, CameraPlace),
    /// What a camera sees now.
    Picture(u32, PictureKind),
    /// The last digest of the state.
    Digest,
}

/// What the server sends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Message {
    /// The answer to a call.
    Answer(u64, Result<Answer, Refusal>),
    /// What is watched.
    Observation(Observation),
}

/// What a call led to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Answer {
    /// Done, and there is nothing to say.
    Ok,
    /// What is served.
    Description(Description),
    /// What each command did.
    Submitted(Vec<Done>),
    /// Now the clock shows this tick.
    Ticked(Tick),
    /// What is there.
    Found(Found),
    /// The recipe of an entity; none if nobody has that id.
    Entity(Option<Box<EntityDesc>>),
    /// The cameras.
    Cameras(Vec<CameraInfo>),
    /// The number of a new camera.
    Camera(u32),
    /// What a camera sees.
    Picture(Picture),
    /// The digest after the step before that tick; none before the first.
    Digest(Option<(Tick, StateDigest)>),
}

/// What a command did.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Done {
    /// It took effect.
    Applied,
    /// It brought this entity into the world.
    Spawned(EntityId),
    /// It was impossible, and why.
    Refused(String),
}

/// What is served.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Description {
    /// Its name.
    pub name: String,
    /// The tick that the clock shows.
    pub tick: Tick,
    /// Length of a step, s.
    pub dt: f64,
    /// When it steps.
    pub pace: Pace,
    /// The names of the assets that entities are made from, by their ids.
    pub assets: Vec<String>,
}

/// A camera and where it is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraInfo {
    /// Its number.
    pub number: u32,
    /// Where it is and how it looks.
    pub place: CameraPlace,
}

/// Why a call was not answered as asked.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, Error)]
pub enum Refusal {
    /// The request is not one of this version.
    #[error("the request cannot be read: it is damaged, or of another version")]
    Malformed,
    /// A number in it is out of range.
    #[error("{field} is out of range: give {allowed}")]
    Range {
        /// Which.
        field: String,
        /// What is allowed, in words.
        allowed: String,
    },
    /// It cannot be done.
    #[error("{0}")]
    Impossible(String),
}

/// Bytes that are no message.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum MessageError {
    /// Not even the number of the call can be read.
    #[error("a message cannot be read: it is damaged, or of another version")]
    Unreadable,
    /// The call of that number cannot be read.
    #[error("call {id} cannot be read: it is damaged, or of another version")]
    Call {
        /// Its number.
        id: u64,
    },
}

/// The call in a frame.
///
/// # Errors
/// There is none; bytes left over are an error too.
pub fn read_call(payload: &[u8]) -> Result<Call, MessageError> {
    let (id, rest) = postcard::take_from_bytes::<u64>(payload).map_err(|_| MessageError::Unreadable)?;
    match postcard::take_from_bytes::<Request>(rest) {
        Ok((request, [])) => Ok(Call { id, request }),
        _ => Err(MessageError::Call { id }),
    }
}

/// The message in a frame.
///
/// # Errors
/// There is none; bytes left over are an error too.
pub fn read_message(payload: &[u8]) -> Result<Message, MessageError> {
    match postcard::take_from_bytes::<Message>(payload) {
        Ok((message, [])) => Ok(message),
        _ => Err(MessageError::Unreadable),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use simworld_core::geometry::{Aabb, Point2};

    use super::*;

    #[test]
    fn calls_are_read_back_and_leftovers_are_refused() {
        let region = Aabb::column_around(Point2::new(3.0, 4.0), 10.0);
        let call = Call { id: 700, request: Request::Watch { query: Query::of(region), every: 5 } };
        let mut bytes = postcard::to_stdvec(&call).unwrap();
        assert_eq!(read_call(&bytes), Ok(call));
        bytes.push(0);
        assert_eq!(read_call(&bytes), Err(MessageError::Call { id: 700 }));
    }

    #[test]
    fn requests_of_later_versions_are_told_by_their_number() {
        assert_eq!(read_call(&[9, 200, 1]), Err(MessageError::Call { id: 9 }));
        assert_eq!(read_call(&[0xff; 30]), Err(MessageError::Unreadable));
    }

    proptest! {
        #[test]
        fn any_bytes_are_a_message_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
            if let Ok(call) = read_call(&bytes) {
                // Not all bytes are the shortest form of what they say, but that one says the same.
                let again = postcard::to_stdvec(&call).unwrap();
                prop_assert_eq!(format!("{:?}", read_call(&again).unwrap()), format!("{call:?}"));
            }
            let _ = read_message(&bytes);
        }
    }
}
