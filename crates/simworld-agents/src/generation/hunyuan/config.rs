//! Which server, what to ask of it, and how long to wait.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use ureq::http::Uri;

use super::HunyuanError;
use crate::assets::{Facing, ImportConfig, Unit};
use crate::http;
use crate::model::{PlainKey, RetryConfig};

/// A server that speaks the protocol of Hunyuan3D-2, and what to ask of it. It holds no key, only the name of the variable
/// that does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HunyuanConfig {
    /// The address before `/send`: `http://127.0.0.1:8081`.
    pub base_url: String,
    /// Which protocol it speaks.
    pub version: HunyuanVersion,
    /// How the model is fetched.
    pub way: Way,
    /// The environment variable that holds a key, for servers behind a gate; none: no key is sent.
    pub key_variable: Option<String>,
    /// Whether a key may travel without TLS.
    pub plain_key: PlainKey,
    /// A file of certificates (PEM) that are trusted instead of Mozilla's. Only for https.
    pub root_certificates: Option<PathBuf>,
    /// The most time to find the host, and then until the connection stands, s; 0.001 to 86,400.
    pub connect_timeout: f64,
    /// The most time for the answer to one question after the state of a job, s; 0.001 to 86,400.
    pub answer_timeout: f64,
    /// The most time from the first request to the whole model, s; 0.001 to 86,400. Jobs that failed stay "processing" for ever on
    /// the released servers: nothing else ends the wait for them.
    pub deadline: f64,
    /// The wait before the first question after the state of a job, s; it grows by half with each. 0.001 to 3600.
    pub first_poll: f64,
    /// The longest such wait, s; 0.001 to 3600.
    pub longest_poll: f64,
    /// How often to ask again after what fails in passing.
    pub retry: RetryConfig,
    /// Cells along a side of the grid in which the surface is found, 64 to 512.
    pub octree_resolution: u32,
    /// Steps of the diffusion, 1 to 20.
    pub num_inference_steps: u32,
    /// How closely the picture is followed, 0.1 to 20.
    pub guidance_scale: f64,
    /// Whether it is painted.
    pub texture: Texture,
    /// The most triangles of a painted one, 1000 to 100,000.
    pub face_count: u32,
    /// The licence of what the server makes, as an SPDX expression; empty where none is known.
    pub licence: String,
    /// How its files become assets; `limits.bytes` is the most that is read of an answer.
    pub import: ImportConfig,
}

/// Which protocol a server speaks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum HunyuanVersion {
    /// Hunyuan3D-2 (and 2mini, 2mv): words, if the server has them enabled, or a picture.
    #[default]
    #[serde(rename = "2.0")]
    V2_0,
    /// Hunyuan3D-2.1: a picture; jobs can say that they failed.
    #[serde(rename = "2.1")]
    V2_1,
}

/// How a model is fetched.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Way {
    /// `/send`, and `/status` until it is there: goes on after a connection that broke.
    #[default]
    Job,
    /// `/generate`: one request that lasts until the model is made.
    Wait,
}

/// Whether a model is painted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Texture {
    /// Its shape alone.
    #[default]
    None,
    /// Shape and colours; takes longer.
    Painted,
}

impl Default for HunyuanConfig {
    fn default() -> Self {
        Self {
            base_url: "http://127.0.0.1:8081".into(),
            version: HunyuanVersion::V2_0,
            way: Way::Job,
            key_variable: None,
            plain_key: PlainKey::LoopbackOnly,
            root_certificates: None,
            connect_timeout: 10.0,
            answer_timeout: 60.0,
            deadline: 600.0,
            first_poll: 1.0,
            longest_poll: 10.0,
            retry: RetryConfig::default(),
            octree_resolution: 256,
            num_inference_steps: 5,
            guidance_scale: 5.0,
            texture: Texture::None,
            face_count: 40_000,
            licence: String::new(),
            import: ImportConfig { unit: Unit::Any, facing: Facing::ByClass, ..ImportConfig::default() },
        }
    }
}

impl HunyuanConfig {
    /// The address, if everything can work.
    pub(super) fn checked(&self) -> Result<Uri, HunyuanError> {
        let uri = http::checked_url(&self.base_url)?;
        self.retry.check()?;
        self.import.checked().map_err(HunyuanError::Import)?;
        let ranges = [
            ("connect_timeout", self.connect_timeout, 0.001, 86_400.0),
            ("answer_timeout", self.answer_timeout, 0.001, 86_400.0),
            ("deadline", self.deadline, 0.001, 86_400.0),
            ("first_poll", self.first_poll, 0.001, 3600.0),
            ("longest_poll", self.longest_poll, 0.001, 3600.0),
            ("octree_resolution", f64::from(self.octree_resolution), 64.0, 512.0),
            ("num_inference_steps", f64::from(self.num_inference_steps), 1.0, 20.0),
            ("guidance_scale", self.guidance_scale, 0.1, 20.0),
            ("face_count", f64::from(self.face_count), 1000.0, 100_000.0),
        ];
        let off = ranges.into_iter().find(|(_, value, least, most)| !(least..=most).contains(&value));
        if let Some((name, value, least, most)) = off {
            return Err(HunyuanError::Config(format!("{name} is {value}: give {least} to {most}")));
        }
        let never_ends = self.version == HunyuanVersion::V2_1 && self.texture == Texture::None;
        if never_ends && self.way == Way::Job {
            return Err(HunyuanError::Config(
                "a server of 2.1 calls a job without texture unfinished for ever: set texture to painted, or way to wait"
                    .into(),
            ));
        }
        Ok(uri)
    }
}
