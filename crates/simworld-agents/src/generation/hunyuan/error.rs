//! Why a server made no asset.

use std::time::Duration;

use thiserror::Error;

use crate::assets::ImportError;
use crate::model::ModelError;

/// Why a server made no asset; nothing was added anywhere. No variant ever holds a key.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum HunyuanError {
    /// A configuration that cannot work.
    #[error("the configuration of the generator: {0}")]
    Config(String),
    /// The server makes models from pictures alone.
    #[error("servers of Hunyuan3D-2.1 make models from pictures alone: give the prompt a picture")]
    NeedsImage,
    /// The picture is none.
    #[error("the picture of the prompt {0}")]
    BadImage(&'static str),
    /// The shape is none.
    #[error("the shape of the prompt {0}")]
    BadMesh(&'static str),
    /// The protocol has no field for it.
    #[error("servers of Hunyuan3D-2.1 take no {0}: give the prompt one picture, or use a server of 2.0")]
    NotInProtocol(&'static str),
    /// The server was not reached, or the connection broke.
    #[error("no connection to the generator at {url}: {reason}; is it running, and is the address right?")]
    Transport {
        /// Its address.
        url: String,
        /// What the system says.
        reason: String,
    },
    /// The server is busy or failed in passing (status 408, 429 or 5xx).
    #[error("the generator answers with status {status}: {said}; try again later")]
    Busy {
        /// The status.
        status: u16,
        /// How long it wants to be left alone, if it says.
        retry_after: Option<Duration>,
        /// The beginning of what it says.
        said: String,
    },
    /// The server does not take the request, or could not make it.
    #[error(
        "the generator refuses with status {status}: {said}; servers have words switched off unless they are told otherwise: \
         look into its log, or give a picture"
    )]
    Refused {
        /// The status.
        status: u16,
        /// The beginning of what it says.
        said: String,
    },
    /// The job failed on the server.
    #[error("the generator could not make it (job {uid}): {said}; look into its log")]
    Failed {
        /// Which job.
        uid: String,
        /// What it says.
        said: String,
    },
    /// The server knows nothing of the job.
    #[error("the generator knows no job {uid}: it may have been started anew; ask again")]
    Lost {
        /// Which job.
        uid: String,
    },
    /// It was not there in time.
    #[error(
        "the generator was not ready within {} s{}; a job that failed stays unfinished for ever: look into the server's log, or allow \
         more time", .limit.as_secs_f64(), .uid.as_ref().map_or_else(String::new, |uid| format!(" (job {uid})"))
    )]
    Deadline {
        /// How long it was waited for.
        limit: Duration,
        /// Which job, if there is one that can be gone on with.
        uid: Option<String>,
    },
    /// An answer that is not one.
    #[error("the generator's answer cannot be read: {reason}; it begins with {begin:?}")]
    BadAnswer {
        /// What is wrong with it.
        reason: String,
        /// Its beginning.
        begin: String,
    },
    /// A model larger than allowed.
    #[error(
        "the generator's answer is larger than the {limit} bytes allowed: ask for fewer triangles, or raise the limit"
    )]
    TooLarge {
        /// The limit in bytes.
        limit: u64,
    },
    /// It was given up.
    #[error("it was cancelled")]
    Cancelled,
    /// What the server made is no asset.
    #[error("what the generator made: {0}")]
    Import(#[from] ImportError),
}

impl HunyuanError {
    /// Whether the same request may well be answered if it is sent again.
    pub fn is_passing(&self) -> bool {
        matches!(self, Self::Transport { .. } | Self::Busy { .. })
    }

    /// Whether the job may still be finished by the server.
    pub fn leaves_job(&self) -> bool {
        self.is_passing() || matches!(self, Self::Deadline { .. } | Self::Cancelled)
    }

    pub(super) fn retry_after(&self) -> Option<Duration> {
        match self {
            Self::Busy { retry_after, .. } => *retry_after,
            _ => None,
        }
    }
}

/// What is checked before anything is sent.
impl From<ModelError> for HunyuanError {
    fn from(error: ModelError) -> Self {
        match error {
            ModelError::Config(reason) => Self::Config(reason),
            other => Self::Config(other.to_string()),
        }
    }
}
