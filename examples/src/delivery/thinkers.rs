//! Couriers that think with a model: behind a server, on a tape, or by a script of a test.

use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use serde::{Deserialize, Serialize};
use simworld_agents::delivery::Persona;
use simworld_agents::model::{
    ChatModel, ChatReply, ChatRequest, ModelError, Models, ModelsConfig, NoModel, OpenAiChat, OpenAiConfig,
    Price, Tape, Tariff, Unpriced, WallClock,
};
use simworld_agents::observer;
use simworld_agents::thought::{
    CourierConfig, CourierConfigError, ModelCourier, ModelReasoner, PromptError, Prompts,
};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, pose_facing, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;
use simworld_core::seam::{ObserveError, Observer};
use simworld_core::seed::Seed;
use simworld_render::{Frame, RenderConfig, RenderError, Renderer};
use thiserror::Error;

/// Requests of the paper for each step of each courier: one to reason, one to act.
const PAPER_REQUESTS: u64 = 2;
/// Height of the eyes of a courier, m, and its pictures, in pixels and radians.
const EYES: f64 = 1.6;
const PICTURE: (u32, u32, f64) = (320, 180, 1.4);

/// The model behind the couriers that think with one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ModelSettings {
    /// The address of an OpenAI-compatible server; without one, answers come from the tape alone.
    pub url: Option<String>,
    /// The model's name, where the server has several.
    pub name: String,
    /// The environment variable that holds the server's key.
    pub key_variable: Option<String>,
    /// A folder with a recording for each seed: what is on it is not asked again, what is not is recorded.
    pub tape: Option<PathBuf>,
    /// A folder of templates that replace prompts of the same name.
    pub prompts: Option<PathBuf>,
    /// Whether couriers see.
    pub eyes: Eyes,
    /// What a token costs; a model of one's own costs nothing.
    pub price: Option<Price>,
    /// How couriers think.
    pub thinking: CourierConfig,
}

impl Default for ModelSettings {
    fn default() -> Self {
        Self {
            url: None,
            name: "default".to_owned(),
            key_variable: None,
            tape: None,
            prompts: None,
            eyes: Eyes::Closed,
            price: None,
            thinking: CourierConfig::patient(),
        }
    }
}

/// Whether couriers see.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Eyes {
    /// They are told how things stand.
    #[default]
    Closed,
    /// They are shown what is before them besides.
    Open,
}

/// Why there is nobody who thinks.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ThinkError {
    /// The model cannot be used.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A prompt cannot be used.
    #[error(transparent)]
    Prompt(#[from] PromptError),
    /// A setting out of range.
    #[error("model.thinking: {0}")]
    Thinking(#[from] CourierConfigError),
    /// Nobody sees without a graphics adapter.
    #[error("couriers cannot see: {0}")]
    Eyes(#[from] RenderError),
    /// The folder of recordings cannot be made.
    #[error("{path}: {source}")]
    Tape {
        /// The folder.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// Neither a server nor a recording.
    #[error("couriers think with a model and there is none: give --model URL, or --tape with a recording")]
    Nobody,
}

/// What the models of a seed were asked and took.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelUsage {
    /// Couriers that think with a model.
    pub couriers: u32,
    /// What they asked; on a tape too.
    pub requests: u64,
    /// What the paper would have asked in that time.
    pub paper_requests: u64,
    /// What a server answered, and where it failed.
    pub answered: u64,
    /// Requests that failed.
    pub failed: u64,
    /// Tokens of prompts and of answers.
    pub prompt_tokens: u64,
    /// Tokens of answers.
    pub completion_tokens: u64,
    /// What that cost, $.
    pub cost: f64,
}

type Backend = Box<dyn Fn() -> Result<Box<dyn ChatModel>, ModelError>>;
type SharedRenderer = Arc<Mutex<(Renderer, Frame)>>;

/// Makes the minds of a seed's couriers and keeps their accounts.
pub struct Thinkers {
    settings: ModelSettings,
    prompts: Arc<Prompts>,
    models: Models,
    backend: Backend,
    renderer: Option<SharedRenderer>,
    asked: Arc<AtomicU64>,
    couriers: u32,
    /// What was asked and taken before the run was cut off, if it was.
    before: Option<ModelUsage>,
}

impl Thinkers {
    /// Those of a seed, with the server or the tape of the settings.
    ///
    /// # Errors
    /// There is neither, a setting is out of range, or nobody can see.
    pub fn new(settings: &ModelSettings, seed: Seed) -> Result<Self, ThinkError> {
        let Some(url) = &settings.url else {
            let recorded = settings.tape.as_ref().is_some_and(|folder| tape_of(folder, seed).is_file());
            return if recorded {
                Self::with_backend(settings, seed, || Ok(Box::new(NoModel)))
            } else {
                Err(ThinkError::Nobody)
            };
        };
        let server = OpenAiConfig {
            base_url: url.clone(),
            model: settings.name.clone(),
            key_variable: settings.key_variable.clone(),
            ..OpenAiConfig::default()
        };
        let chat = OpenAiChat::new(server)?;
        Self::with_backend(settings, seed, move || Ok(Box::new(chat.clone())))
    }

    /// Those of a seed, with a model of one's own.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_backend(
        settings: &ModelSettings,
        seed: Seed,
        backend: impl Fn() -> Result<Box<dyn ChatModel>, ModelError> + 'static,
    ) -> Result<Self, ThinkError> {
        settings.thinking.validate()?;
        let mut tariff = Tariff { model: settings.name.clone(), ..Tariff::free() };
        if let Some(price) = settings.price {
            tariff.unpriced = Unpriced::Refused;
            tariff.prices.insert(settings.name.clone(), price);
        }
        let config = ModelsConfig { tariff, ..ModelsConfig::default() };
        let mut models = Models::new(config, seed, Arc::new(WallClock::new()));
        if let Some(folder) = &settings.tape {
            let fail = |source| ThinkError::Tape { path: folder.clone(), source };
            std::fs::create_dir_all(folder).map_err(fail)?;
            let path = tape_of(folder, seed);
            models = models.with_tape(match settings.url {
                None if path.is_file() => Tape::replay(&path)?,
                _ if path.is_file() => Tape::replay_or_record(&path)?,
                _ => Tape::record(&path)?,
            });
        }
        let prompts = settings.prompts.as_deref().map(Prompts::from_folder).transpose()?.unwrap_or_default();
        let renderer = match settings.eyes {
            Eyes::Closed => None,
            Eyes::Open => {
                Some(Arc::new(Mutex::new((Renderer::new(&RenderConfig::default())?, Frame::new()))))
            }
        };
        Ok(Self {
            settings: settings.clone(),
            prompts: Arc::new(prompts),
            models,
            backend: Box::new(backend),
            renderer,
            asked: Arc::default(),
            couriers: 0,
            before: None,
        })
    }

    /// The mind of the courier at that place, who is like that.
    ///
    /// # Errors
    /// Its model cannot be made.
    pub fn mind(&mut self, index: usize, persona: Persona) -> Result<ModelCourier, ThinkError> {
        let model = self.models.agent(&format!("courier-{index}"), (self.backend)()?)?;
        let model = Counted { inner: model, asked: Arc::clone(&self.asked) };
        let reasoner = ModelReasoner::new(Box::new(model)).with_prompts(Arc::clone(&self.prompts));
        let mut mind = ModelCourier::with_reasoner(Box::new(reasoner))
            .with_prompts(Arc::clone(&self.prompts))
            .with_persona(persona)
            .with_config(self.settings.thinking.clone())?;
        if let Some(renderer) = &self.renderer {
            mind = mind.with_camera(CourierCamera { renderer: Arc::clone(renderer) });
        }
        self.couriers += 1;
        Ok(mind)
    }

    /// What they were asked and took in so many steps.
    pub fn usage(&self, steps: u64) -> ModelUsage {
        let account = self.models.ledger().total();
        let mut usage = ModelUsage {
            couriers: self.couriers,
            requests: self.asked.load(Ordering::Relaxed),
            paper_requests: PAPER_REQUESTS * steps * u64::from(self.couriers),
            answered: account.answered,
            failed: account.failed,
            prompt_tokens: account.usage.prompt,
            completion_tokens: account.usage.completion,
            cost: account.cost as f64 / 1e8,
        };
        if let Some(before) = &self.before {
            usage.requests += before.requests;
            usage.answered += before.answered;
            usage.failed += before.failed;
            usage.prompt_tokens += before.prompt_tokens;
            usage.completion_tokens += before.completion_tokens;
            usage.cost += before.cost;
        }
        usage
    }

    /// Counts on from what a run took until it was cut off.
    pub(super) fn go_on_from(&mut self, before: ModelUsage) {
        self.before = Some(before);
    }
}

fn tape_of(folder: &std::path::Path, seed: Seed) -> PathBuf {
    folder.join(format!("seed-{}.jsonl", seed.0))
}

impl std::fmt::Display for ModelUsage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{} couriers thought with a model: {} requests, 1/{:.0} of the paper's {}; the server answered {} and failed {}, {} \
             tokens of prompts and {} of answers, ${:.4}",
            self.couriers,
            self.requests,
            self.paper_requests as f64 / self.requests.max(1) as f64,
            self.paper_requests,
            self.answered,
            self.failed,
            self.prompt_tokens,
            self.completion_tokens,
            self.cost
        )
    }
}

/// Counts what is asked.
struct Counted {
    inner: Box<dyn ChatModel>,
    asked: Arc<AtomicU64>,
}

impl ChatModel for Counted {
    fn chat(&mut self, request: &ChatRequest) -> Result<ChatReply, ModelError> {
        self.asked.fetch_add(1, Ordering::Relaxed);
        self.inner.chat(request)
    }
}

/// What is before a courier, drawn; all share one renderer.
struct CourierCamera {
    renderer: SharedRenderer,
}

impl Observer for CourierCamera {
    type Observation = observer::Frame;

    fn observe(
        &mut self,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut observer::Frame,
    ) -> Result<(), ObserveError> {
        let body = scene.entity(who).ok_or(ObserveError::Missing { id: who })?;
        let sensor = |error: RenderError| ObserveError::Sensor(error.to_string());
        let (width, height, view) = PICTURE;
        let intrinsics = Intrinsics::from_fov(width, height, view).map_err(|error| sensor(error.into()))?;
        let at = body.planar();
        let eye = Point3::new(at.x, at.y, body.position().z + EYES);
        let camera = Camera::looking_along(&pose_facing(eye, yaw_of(body.pose)), intrinsics);
        let mut renderer = self.renderer.lock().unwrap_or_else(PoisonError::into_inner);
        let (renderer, frame) = &mut *renderer;
        renderer.render_hiding(scene, &camera, Some(who), frame).map_err(sensor)?;
        *out = observer::Frame { width: frame.width, height: frame.height, rgb: frame.rgb.clone() };
        Ok(())
    }
}
