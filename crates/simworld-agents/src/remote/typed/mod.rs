//! The typed protocol: frames of postcard under a 32-bit little-endian length, and the Rust client for it.
//!
//! A connection begins with a hello in a layout that never changes: the client sends [`SIGNATURE`], its [`VERSION`] as 16
//! bits, little-endian, and its token if it has one; the server answers with the signature, its own version, a byte that says
//! whether it lets the client in (0), refuses the token (1), speaks another version (2) or is full (3), and then a
//! [`Welcome`] in postcard or the reason as text. After that the client sends [`Call`]s and the server [`Message`]s: an answer
//! for every call, in the order of calls, and observations between them.
//!
//! Lengths are in metres, angles in radians, frames are those of [`simworld_core::geometry`].

mod client;
mod hello;
mod message;
mod serve;

pub use client::{Client, ClientConfig, ClientError};
pub use hello::{HelloError, SIGNATURE, VERSION, Welcome, read_hello, read_welcome};
pub(super) use hello::{farewell, greet};
pub use message::{
    Answer, Call, CameraInfo, Description, Done, Message, MessageError, Refusal, Request, read_call,
    read_message,
};
pub(super) use serve::{answer, observation, ticked};

pub use super::server::Parting;
pub use super::watch::{Found, Observation, Query, Seen};
