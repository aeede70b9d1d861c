//! The line to a server: requests that end in time, are asked again, and can be given up from another thread.

use std::io::Read;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use simworld_core::seed::StreamRng;
use ureq::http::{Response, Uri};
use ureq::{Agent, Body};

use super::config::HunyuanConfig;
use super::error::HunyuanError;
use super::wire;
use crate::http::{self, ApiKey, Connecting};
use crate::model::{Attempts, Clock};

/// The most bytes that are read of what a server says about a failure.
const ERROR_BODY: u64 = 64 * 1024;

/// The longest that a wait goes on after it was given up, s.
const NAP: Duration = Duration::from_millis(50);

/// Gives up what a generator is doing, from any thread.
#[derive(Clone, Debug)]
pub struct Canceller {
    given_up: Arc<AtomicBool>,
    agent: Arc<Mutex<Agent>>,
}

impl Canceller {
    /// Gives up what is being made, or what is asked for next if nothing is: it ends with
    /// [`HunyuanError::Cancelled`] at once.
    pub fn cancel(&self) {
        self.given_up.store(true, Ordering::SeqCst);
        let agent = self.agent.lock().unwrap_or_else(PoisonError::into_inner).clone();
        // Whoever waits for this server's bytes is woken.
        agent.shutdown();
    }
}

pub(super) struct Line {
    url: String,
    uri: Uri,
    key: Option<Arc<ApiKey>>,
    clock: Arc<dyn Clock>,
    canceller: Canceller,
}

/// What to ask.
pub(super) enum Question<'a> {
    Get(String),
    Post(&'static str, &'a [u8]),
}

/// How much and how long.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    /// The most bytes of the answer.
    pub(super) bytes: u64,
    /// When it must be there, by the line's clock.
    pub(super) until: Duration,
    /// The most time for it.
    pub(super) within: Duration,
}

/// What ends the wait for an answer.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Ends {
    WithDeadline,
    Earlier,
}

impl Line {
    pub(super) fn new(config: &HunyuanConfig, clock: Arc<dyn Clock>) -> Result<Self, HunyuanError> {
        let uri = config.checked()?;
        let key = http::key(config.key_variable.as_deref())?;
        if key.is_some() {
            http::check_key_is_safe(&uri, config.plain_key)?;
        }
        let agent = agent(config, &uri, key.clone())?;
        let canceller =
            Canceller { given_up: Arc::new(AtomicBool::new(false)), agent: Arc::new(Mutex::new(agent)) };
        let url = config.base_url.trim_end_matches('/').to_owned();
        Ok(Self { url, uri, key, clock, canceller })
    }

    pub(super) fn canceller(&self) -> Canceller {
        self.canceller.clone()
    }

    pub(super) fn now(&self) -> Duration {
        self.clock.now()
    }

    /// Puts the line in order after it was given up.
    pub(super) fn renew(&self, config: &HunyuanConfig) -> Result<(), HunyuanError> {
        let agent = agent(config, &self.uri, self.key.clone())?;
        *self.canceller.agent.lock().unwrap_or_else(PoisonError::into_inner) = agent;
        self.canceller.given_up.store(false, Ordering::SeqCst);
        Ok(())
    }

    /// Waits, unless it is given up.
    pub(super) fn sleep(&self, wait: Duration) -> Result<(), HunyuanError> {
        let end = self.clock.now().saturating_add(wait);
        loop {
            self.check()?;
            let left = end.saturating_sub(self.clock.now());
            if left.is_zero() {
                return Ok(());
            }
            self.clock.sleep(left.min(NAP));
        }
    }

    /// Asks, and asks again after what fails in passing.
    pub(super) fn ask(
        &self,
        question: &Question<'_>,
        bounds: Bounds,
        config: &HunyuanConfig,
        random: &mut StreamRng,
    ) -> Result<Vec<u8>, HunyuanError> {
        let mut attempts = Attempts::begin(config.retry, self.clock.now());
        loop {
            let error = match self.once(question, bounds) {
                Err(error) if error.is_passing() => error,
                answer => return answer,
            };
            let now = self.clock.now();
            let wait = attempts.wait(error.retry_after(), now, random);
            let Some(wait) = wait.filter(|wait| now + *wait < bounds.until) else { return Err(error) };
            self.sleep(wait)?;
        }
    }

    fn once(&self, question: &Question<'_>, bounds: Bounds) -> Result<Vec<u8>, HunyuanError> {
        self.check()?;
        let left = bounds.until.saturating_sub(self.clock.now());
        if left.is_zero() {
            return Err(HunyuanError::Deadline { limit: Duration::ZERO, uid: None });
        }
        let within = Some(left.min(bounds.within));
        let ends = if left <= bounds.within { Ends::WithDeadline } else { Ends::Earlier };
        let agent = self.canceller.agent.lock().unwrap_or_else(PoisonError::into_inner).clone();
        let key = self.key.as_deref().map(ApiKey::stand_in);
        let response = match question {
            Question::Get(path) => {
                let mut request = agent.get(format!("{}{path}", self.url));
                if let Some(key) = key {
                    request = request.header("authorization", key);
                }
                request.config().timeout_global(within).build().call()
            }
            Question::Post(path, body) => {
                let mut request =
                    agent.post(format!("{}{path}", self.url)).header("content-type", "application/json");
                if let Some(key) = key {
                    request = request.header("authorization", key);
                }
                request.config().timeout_global(within).build().send(*body)
            }
        };
        let answer = match response {
            Ok(response) => self.whole(response, bounds.bytes, ends),
            Err(error) => Err(self.fault(error, ends)),
        };
        // What breaks because it was given up is no fault of the server.
        self.check()?;
        answer
    }

    fn whole(&self, response: Response<Body>, most: u64, ends: Ends) -> Result<Vec<u8>, HunyuanError> {
        let (head, body) = response.into_parts();
        let status = head.status.as_u16();
        let limit = if head.status.is_success() { most } else { ERROR_BODY };
        let mut bytes = Vec::new();
        let read = body.into_with_config().limit(limit).reader().read_to_end(&mut bytes);
        if head.status.is_success() {
            return match read {
                Ok(_) => Ok(bytes),
                Err(error) => Err(self.fault(error.into(), ends)),
            };
        }
        // What came before the connection broke is still worth reading, and the status says enough without it.
        let clean = |text: &str| self.clean(text);
        let said = wire::said(&bytes, &clean);
        Err(match status {
            // A job's own failure comes with status 500 and is no reason to ask again.
            500 if matches!(wire::state(&bytes, 0, &clean), Ok(wire::State::Failed(_))) => {
                HunyuanError::Failed { uid: String::new(), said }
            }
            408 | 429 | 500..=599 => {
                HunyuanError::Busy { status, retry_after: http::retry_after(&head.headers), said }
            }
            _ => HunyuanError::Refused { status, said },
        })
    }

    fn fault(&self, error: ureq::Error, ends: Ends) -> HunyuanError {
        match error {
            // The caller knows how long and which job.
            ureq::Error::Timeout(_) if ends == Ends::WithDeadline => {
                HunyuanError::Deadline { limit: Duration::ZERO, uid: None }
            }
            ureq::Error::BodyExceedsLimit(limit) => HunyuanError::TooLarge { limit },
            ureq::Error::Protocol(_) | ureq::Error::LargeResponseHeader(..) => HunyuanError::BadAnswer {
                reason: format!("it is no HTTP: {}", self.clean(&error.to_string())),
                begin: String::new(),
            },
            other => {
                HunyuanError::Transport { url: self.url.clone(), reason: self.clean(&other.to_string()) }
            }
        }
    }

    fn check(&self) -> Result<(), HunyuanError> {
        let given_up = self.canceller.given_up.load(Ordering::SeqCst);
        if given_up { Err(HunyuanError::Cancelled) } else { Ok(()) }
    }

    /// The text without the key.
    pub(super) fn clean(&self, text: &str) -> String {
        self.key.as_ref().map_or_else(|| text.to_owned(), |key| key.scrubbed(text))
    }
}

fn agent(config: &HunyuanConfig, uri: &Uri, key: Option<Arc<ApiKey>>) -> Result<Agent, HunyuanError> {
    let connecting = Connecting {
        connect_timeout: config.connect_timeout,
        timeout: config.deadline,
        root_certificates: config.root_certificates.as_deref(),
    };
    Ok(http::agent(connecting, uri, key)?)
}
