//! Servers that speak the protocol of Hunyuan3D-2 (features `http` and `assets`): `api_server.py` of Hunyuan3D-2 and of 2.1.
//!
//! `POST /send` gives the name of a job, `GET /status/{uid}` says how far it is and brings the model as base64; `POST /generate` waits and
//! brings it as it is. What comes is measured and mended as any file of a stranger's ([`import_glb`]).
//! What the released servers do, and this client reckons with: a job that failed stays "processing" for ever, an unknown one
//! too; words are switched off, and end with status 404 and `error_code` 1; 2.1 takes pictures alone, calls a job without texture
//! "texturing" for ever, and can say `error`.

mod config;
mod error;
mod line;
mod wire;

use std::sync::Arc;
use std::time::Duration;

pub use config::{HunyuanConfig, HunyuanVersion, Texture, Way};
pub use error::HunyuanError;
pub use line::Canceller;
use serde::{Deserialize, Serialize};
use simworld_core::asset::ContentId;
use simworld_core::seed::{Seed, StreamRng};

use self::line::{Bounds, Line, Question};
use self::wire::State;
use super::{AssetGenerator, AssetPrompt, GenerateError, Made};
use crate::assets::{Imported, Thing, import_glb};
use crate::model::{Clock, WallClock};

/// The most bytes of an answer that holds no model.
const SHORT: u64 = 64 * 1024;

/// Makes assets by a server. It waits until the asset is there; [`canceller`](Self::canceller) ends the wait from another thread.
///
/// A job that was cut off (a connection broke, the time was up, it was given up) is gone on with when the same prompt comes
/// again, and not begun anew.
///
/// ```no_run
/// use simworld_agents::generation::{AssetGenerator, AssetPrompt, HunyuanConfig, HunyuanGenerator};
/// let config = HunyuanConfig { base_url: "http://127.0.0.1:8081".into(), ..HunyuanConfig::default() };
/// let mut generator = HunyuanGenerator::new(config)?;
/// let made = generator.generate(&AssetPrompt::new("a wooden bench").seeded(7))?;
/// println!("{} of {:?} kg", made.asset.name, made.asset.mass);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct HunyuanGenerator {
    config: HunyuanConfig,
    line: Line,
    name: String,
    pending: Option<Ticket>,
}

/// A job on a server: what is needed to fetch what comes of it, later or by another process.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ticket {
    /// Its name on the server.
    pub uid: String,
    /// What was asked for.
    pub prompt: AssetPrompt,
}

impl HunyuanGenerator {
    /// A client for the server of the configuration; nothing is sent yet.
    ///
    /// # Errors
    /// [`HunyuanError::Config`] for a configuration that cannot work.
    pub fn new(config: HunyuanConfig) -> Result<Self, HunyuanError> {
        Self::with_clock(config, Arc::new(WallClock::new()))
    }

    /// The same, waiting by another clock.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_clock(config: HunyuanConfig, clock: Arc<dyn Clock>) -> Result<Self, HunyuanError> {
        let line = Line::new(&config, clock)?;
        let version = if config.version == HunyuanVersion::V2_0 { "2.0" } else { "2.1" };
        Ok(Self { config, line, name: format!("hunyuan3d-{version}"), pending: None })
    }

    /// Gives up what this generator is doing, from any thread.
    pub fn canceller(&self) -> Canceller {
        self.line.canceller()
    }

    /// The job that was begun and not fetched, if there is one.
    pub fn pending(&self) -> Option<&Ticket> {
        self.pending.as_ref()
    }

    /// Goes on with a job that was begun before, perhaps by another process.
    pub fn resume(&mut self, ticket: Ticket) {
        self.pending = Some(ticket);
    }

    /// Makes an asset, and says how it came about.
    ///
    /// # Errors
    /// The prompt has no words or too many, the server makes nothing of it in time, or what it makes is no asset.
    pub fn make(&mut self, prompt: &AssetPrompt) -> Result<Imported, GenerateError> {
        let words = prompt.checked_words()?.to_owned();
        let made = self.fetch(prompt, &words).and_then(|bytes| self.import(&bytes, prompt, &words));
        if let Err(HunyuanError::Cancelled) = made {
            self.line.renew(&self.config).map_err(|error| GenerateError::Generator(Box::new(error)))?;
        }
        if !made.as_ref().is_err_and(HunyuanError::leaves_job) {
            self.pending = None;
        }
        made.map_err(|error| GenerateError::Generator(Box::new(error)))
    }

    fn fetch(&mut self, prompt: &AssetPrompt, words: &str) -> Result<Vec<u8>, HunyuanError> {
        let limit = Duration::from_secs_f64(self.config.deadline);
        let until = self.line.now().saturating_add(limit);
        let fetched = match self.config.way {
            Way::Wait => self.generate_at_once(prompt, words, until),
            Way::Job => self.job(prompt, words, until).and_then(|uid| self.wait_for(&uid, prompt, until)),
        };
        let of_job = |uid: String| {
            if uid.is_empty() { self.pending.as_ref().map(|job| job.uid.clone()) } else { Some(uid) }
        };
        fetched.map_err(|error| match error {
            HunyuanError::Deadline { uid, .. } => {
                HunyuanError::Deadline { limit, uid: of_job(uid.unwrap_or_default()) }
            }
            HunyuanError::Failed { uid, said } => {
                HunyuanError::Failed { uid: of_job(uid).unwrap_or_default(), said }
            }
            other => other,
        })
    }

    fn generate_at_once(
        &self,
        prompt: &AssetPrompt,
        words: &str,
        until: Duration,
    ) -> Result<Vec<u8>, HunyuanError> {
        let body = wire::body(prompt, words, &self.config)?;
        let bounds = Bounds { bytes: self.config.import.limits.bytes, until, within: Duration::MAX };
        self.line.ask(&Question::Post("/generate", &body), bounds, &self.config, &mut random(prompt))
    }

    /// The job of a prompt: the one that was cut off, or a new one.
    fn job(&mut self, prompt: &AssetPrompt, words: &str, until: Duration) -> Result<String, HunyuanError> {
        if let Some(ticket) = self.pending.as_ref().filter(|ticket| ticket.prompt == *prompt) {
            return Ok(ticket.uid.clone());
        }
        self.pending = None;
        let body = wire::body(prompt, words, &self.config)?;
        let bounds = Bounds { bytes: SHORT, until, within: self.answer_time() };
        let answer =
            self.line.ask(&Question::Post("/send", &body), bounds, &self.config, &mut random(prompt))?;
        let uid = wire::uid(&answer, &|text| self.line.clean(text))?;
        self.pending = Some(Ticket { uid: uid.clone(), prompt: prompt.clone() });
        Ok(uid)
    }

    fn wait_for(&self, uid: &str, prompt: &AssetPrompt, until: Duration) -> Result<Vec<u8>, HunyuanError> {
        let most = self.config.import.limits.bytes;
        // 2.1 brings the model twice, with and without its colours.
        let bytes = most.div_ceil(3).saturating_mul(8).saturating_add(SHORT);
        let bounds = Bounds { bytes, until, within: self.answer_time() };
        let question = Question::Get(format!("/status/{uid}"));
        let mut random = random(prompt);
        let mut wait = self.config.first_poll;
        loop {
            let left = until.saturating_sub(self.line.now());
            if left.is_zero() {
                return Err(HunyuanError::Deadline { limit: Duration::ZERO, uid: Some(uid.to_owned()) });
            }
            self.line.sleep(Duration::from_secs_f64(wait.min(self.config.longest_poll)).min(left))?;
            wait *= 1.5;
            let answer = match self.line.ask(&question, bounds, &self.config, &mut random) {
                Err(HunyuanError::Refused { status: 404, .. }) => {
                    return Err(HunyuanError::Lost { uid: uid.to_owned() });
                }
                Err(HunyuanError::TooLarge { .. }) => return Err(HunyuanError::TooLarge { limit: most }),
                answer => answer?,
            };
            match wire::state(&answer, most, &|text| self.line.clean(text))? {
                State::Working => {}
                State::Done(model) => return Ok(model),
                State::Failed(said) => return Err(HunyuanError::Failed { uid: uid.to_owned(), said }),
            }
        }
    }

    fn answer_time(&self) -> Duration {
        Duration::from_secs_f64(self.config.answer_timeout)
    }

    fn import(&self, bytes: &[u8], prompt: &AssetPrompt, words: &str) -> Result<Imported, HunyuanError> {
        let thing = Thing {
            name: name(words, bytes),
            words: words.to_owned(),
            size: prompt.size,
            source: format!("{}, prompt {words:?}, seed {}", self.name, prompt.seed),
            licence: self.config.licence.clone(),
        };
        Ok(import_glb(bytes, &thing, &self.config.import)?)
    }
}

impl AssetGenerator for HunyuanGenerator {
    fn name(&self) -> &str {
        &self.name
    }

    fn generate(&mut self, prompt: &AssetPrompt) -> Result<Made, GenerateError> {
        self.make(prompt).map(|imported| Made { asset: imported.asset, unused: Vec::new() })
    }
}

/// A name of its own for each model: the words, and what the model is.
fn name(words: &str, bytes: &[u8]) -> String {
    const LONGEST: usize = 48;
    let mut name = String::new();
    for word in
        words.to_lowercase().split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty())
    {
        if name.len() + word.len() < LONGEST {
            name.push_str(word);
            name.push('_');
        }
    }
    format!("{name}{:08x}", (ContentId::of_bytes(bytes).0 >> 96) as u32)
}

fn random(prompt: &AssetPrompt) -> StreamRng {
    Seed(prompt.seed).stream("agents/hunyuan/waits").rng()
}
