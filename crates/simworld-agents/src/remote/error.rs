//! What can go wrong on the side of the server.

use std::net::SocketAddr;

use simworld_core::command::CommandError;
use thiserror::Error;

/// Why a server cannot begin, or had to end.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RemoteError {
    /// A setting out of range.
    #[error("{field} = {value} is out of range: give {allowed}")]
    Setting {
        /// The field, as a path.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// Nothing to listen on.
    #[error("the server has no address: give one for `unrealcv` or for `typed`")]
    NoAddress,
    /// An address that others reach, without a token.
    #[error("{address} can be reached from other machines: give a token, or listen on 127.0.0.1")]
    Open {
        /// Which.
        address: SocketAddr,
    },
    /// The address cannot be listened on.
    #[error("cannot listen on {address}: {source}")]
    Bind {
        /// Which.
        address: SocketAddr,
        /// Why.
        source: std::io::Error,
    },
    /// A thread could not be started.
    #[error("cannot start the thread that accepts clients: {0}")]
    Thread(std::io::Error),
    /// The world could not go on.
    #[error("the world stopped: {0}")]
    Stage(#[from] StageError),
}

/// Why a stage did not do what it was asked.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StageError {
    /// The command is impossible; nothing has changed.
    #[error(transparent)]
    Command(#[from] CommandError),
    /// The step could not be finished.
    #[error("{0}")]
    Step(String),
    /// It draws no pictures.
    #[error("this world draws no pictures: serve it with a renderer")]
    Blind,
    /// The picture could not be drawn.
    #[error("the picture could not be drawn: {0}")]
    Picture(String),
}
