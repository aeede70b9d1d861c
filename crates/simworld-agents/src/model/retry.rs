//! Asks again what failed in passing.

use std::sync::Arc;
use std::time::Duration;

use serde::{Deserialize, Serialize};
use simworld_core::seed::{Stream, StreamRng};

use super::{ChatModel, ChatReply, ChatRequest, Clock, ModelError};

/// How often and how long to ask again.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RetryConfig {
    /// The most attempts, with the first; at least 1.
    pub attempts: u32,
    /// The wait after the first failure, s; it doubles with each. 0 or more.
    pub first_wait: f64,
    /// The longest such wait, s. A server that names a longer one is left alone as long as it wants.
    pub longest_wait: f64,
    /// The most time from the first attempt to the beginning of the last, s.
    pub total: f64,
}

impl Default for RetryConfig {
    fn default() -> Self {
        Self { attempts: 5, first_wait: 0.5, longest_wait: 30.0, total: 180.0 }
    }
}

impl RetryConfig {
    pub(crate) fn check(&self) -> Result<(), ModelError> {
        let times = [self.first_wait, self.longest_wait, self.total];
        if self.attempts == 0 || times.iter().any(|time| !(0.0..=1e9).contains(time)) {
            return Err(ModelError::Config(format!(
                "{self:?} allows no attempt or has a time that is not from 0 to 1e9 s"
            )));
        }
        Ok(())
    }
}

/// Asks again after connections that broke, timeouts, too many requests and failures of the server, and after nothing else.
///
/// Waits are drawn from a stream between half of what they are and the whole, so that many agents do not come back at once; a
/// server's own `Retry-After` is never cut short. A stream of text is asked for again only if nothing of it was handed over.
pub struct Retried<M> {
    inner: M,
    config: RetryConfig,
    clock: Arc<dyn Clock>,
    random: StreamRng,
    repeats: u64,
}

impl<M: ChatModel> Retried<M> {
    /// Asks `inner`; each agent wants a stream of its own.
    ///
    /// # Errors
    /// [`ModelError::Config`] for no attempts and for times below zero.
    pub fn new(
        inner: M,
        config: RetryConfig,
        stream: Stream,
        clock: Arc<dyn Clock>,
    ) -> Result<Self, ModelError> {
        config.check()?;
        Ok(Self { inner, config, clock, random: stream.rng(), repeats: 0 })
    }

    /// How often it asked again, over all requests.
    pub fn repeats(&self) -> u64 {
        self.repeats
    }

    /// The model that is asked.
    pub fn inner(&self) -> &M {
        &self.inner
    }

    fn retried(
        &mut self,
        ask: &mut dyn FnMut(&mut M, &mut Repeat) -> Result<ChatReply, ModelError>,
    ) -> Result<ChatReply, ModelError> {
        let mut attempts = Attempts::begin(self.config, self.clock.now());
        loop {
            let mut repeat = Repeat::May;
            let answer = ask(&mut self.inner, &mut repeat);
            let error = match answer {
                Err(error) if error.is_passing() && repeat == Repeat::May => error,
                answer => return answer,
            };
            let Some(wait) = attempts.wait(error.retry_after(), self.clock.now(), &mut self.random) else {
                return Err(error);
            };
            self.clock.sleep(wait);
            self.repeats += 1;
        }
    }
}

/// The attempts at one request.
pub(crate) struct Attempts {
    config: RetryConfig,
    start: Duration,
    backoff: f64,
    left: u32,
}

impl Attempts {
    /// Before the first, at a time of a clock.
    pub(crate) fn begin(config: RetryConfig, now: Duration) -> Self {
        // whoever takes a configuration refuses one without attempts
        Self { config, start: now, backoff: config.first_wait, left: config.attempts.saturating_sub(1) }
    }

    /// After a failure in passing: how long to wait before the next one, if there is to be one.
    pub(crate) fn wait(
        &mut self,
        retry_after: Option<Duration>,
        now: Duration,
        random: &mut StreamRng,
    ) -> Option<Duration> {
        if self.left == 0 {
            return None;
        }
        let share = random.uniform(0.5, 1.0);
        let wait = match retry_after {
            Some(wait) => wait.saturating_add(Duration::from_secs_f64(self.config.first_wait * share)),
            None => Duration::from_secs_f64(self.backoff.min(self.config.longest_wait) * share),
        };
        let since = now.saturating_sub(self.start);
        if since.saturating_add(wait) > Duration::from_secs_f64(self.config.total) {
            return None;
        }
        self.left -= 1;
        self.backoff *= 2.0;
        Some(wait)
    }
}

/// Whether the same may be asked again.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Repeat {
    May,
    MustNot,
}

impl<M: ChatModel> ChatModel for Retried<M> {
    fn chat(&mut self, request: &ChatRequest) -> Result<ChatReply, ModelError> {
        self.retried(&mut |inner, _| inner.chat(request))
    }

    fn chat_streamed(
        &mut self,
        request: &ChatRequest,
        piece: &mut dyn FnMut(&str),
    ) -> Result<ChatReply, ModelError> {
        self.retried(&mut |inner, repeat| {
            inner.chat_streamed(request, &mut |text| {
                *repeat = Repeat::MustNot;
                piece(text);
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::seed::Seed;

    use super::super::{ManualClock, Message, Scripted};
    use super::*;

    fn busy(seconds: Option<u64>) -> Result<ChatReply, ModelError> {
        Err(ModelError::RateLimited { retry_after: seconds.map(Duration::from_secs) })
    }

    fn asked(
        answers: Vec<Result<ChatReply, ModelError>>,
        config: RetryConfig,
    ) -> (Result<ChatReply, ModelError>, f64, usize) {
        let clock = Arc::new(ManualClock::new());
        let stream = Seed(1).stream("test/retry");
        let mut model = Retried::new(Scripted::answers(answers), config, stream, clock.clone()).unwrap();
        let answer = model.chat(&ChatRequest::new([Message::user("?")]));
        let asked = model.inner().asked().len();
        assert_eq!(model.repeats() as usize, asked - 1);
        (answer, clock.now().as_secs_f64(), asked)
    }

    #[test]
    fn what_passes_is_asked_again_and_waits_grow() {
        let (answer, waited, asked) =
            asked(vec![busy(None), busy(None), busy(None), Ok(ChatReply::of("yes"))], RetryConfig::default());
        assert_eq!(answer.unwrap().text, "yes");
        assert_eq!(asked, 4);
        assert!((1.75..=3.5).contains(&waited), "half to all of 0.5 + 1 + 2 s, not {waited}");
    }

    #[test]
    fn a_server_is_left_alone_as_long_as_it_wants() {
        let (answer, waited, _) =
            asked(vec![busy(Some(70)), Ok(ChatReply::of("yes"))], RetryConfig::default());
        assert!(answer.is_ok());
        assert!((70.25..=70.5).contains(&waited), "{waited}");
        // longer than all the time there is: not asked again, and not waited for
        let (answer, waited, asked) =
            asked(vec![busy(Some(200)), Ok(ChatReply::of("yes"))], RetryConfig::default());
        assert_eq!((answer, waited, asked), (busy(Some(200)), 0.0, 1));
    }

    #[test]
    fn what_stays_wrong_is_asked_once() {
        for error in [
            ModelError::Key { status: 401, variable: None, body: String::new() },
            ModelError::Refused { status: 400, body: String::new() },
            ModelError::BadReply { reason: String::new(), body: String::new() },
            ModelError::TooLarge { limit: 1 },
        ] {
            let (answer, waited, asked) =
                asked(vec![Err(error.clone()), Ok(ChatReply::of("no"))], RetryConfig::default());
            assert_eq!((answer, waited, asked), (Err(error), 0.0, 1));
        }
    }

    #[test]
    fn attempts_and_time_are_limited() {
        let config = RetryConfig { attempts: 3, ..RetryConfig::default() };
        let (answer, _, count) = asked((0..9).map(|_| busy(None)).collect(), config);
        assert_eq!((answer, count), (busy(None), 3));
        let config = RetryConfig { attempts: 100, total: 10.0, ..RetryConfig::default() };
        let (answer, waited, count) = asked((0..100).map(|_| busy(None)).collect(), config);
        assert_eq!(answer, busy(None));
        assert!(waited <= 10.0 && count < 8, "{count} attempts in {waited} s");
    }

    #[test]
    fn text_that_was_handed_over_is_not_asked_for_again() {
        struct Breaks(u32);
        impl ChatModel for Breaks {
            fn chat(&mut self, _: &ChatRequest) -> Result<ChatReply, ModelError> {
                Ok(ChatReply::of("whole"))
            }
            fn chat_streamed(
                &mut self,
                _: &ChatRequest,
                piece: &mut dyn FnMut(&str),
            ) -> Result<ChatReply, ModelError> {
                self.0 += 1;
                if self.0 == 2 {
                    piece("wh");
                }
                busy(None)
            }
        }
        let clock = Arc::new(ManualClock::new());
        let stream = Seed(1).stream("test/retry");
        let mut model = Retried::new(Breaks(0), RetryConfig::default(), stream, clock).unwrap();
        let mut heard = String::new();
        let answer = model.chat_streamed(&ChatRequest::default(), &mut |text| heard.push_str(text));
        assert_eq!((answer, heard.as_str(), model.inner().0), (busy(None), "wh", 2));
    }

    #[test]
    fn configurations_that_cannot_work_are_refused() {
        for config in [
            RetryConfig { attempts: 0, ..RetryConfig::default() },
            RetryConfig { total: f64::NAN, ..RetryConfig::default() },
            RetryConfig { first_wait: -1.0, ..RetryConfig::default() },
        ] {
            let model = Scripted::texts([""]);
            let made = Retried::new(model, config, Seed(1).stream("s"), Arc::new(ManualClock::new()));
            assert!(made.is_err(), "{config:?}");
        }
    }
}
