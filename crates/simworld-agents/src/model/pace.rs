//! Keeps to what a server allows in a minute.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use super::reckon::reckoned_prompt;
use super::{ChatModel, ChatReply, ChatRequest, Clock, ModelError};

const MINUTE: Duration = Duration::from_mins(1);

/// What all agents that share a key may send together: in no minute more than so many requests and so many tokens.
pub struct Pace {
    requests: Option<u32>,
    tokens: Option<u64>,
    clock: Arc<dyn Clock>,
    sent: Mutex<Sent>,
}

#[derive(Default)]
struct Sent {
    /// In the order of their times, with those that are still to come.
    window: VecDeque<Slot>,
    next: u64,
}

struct Slot {
    id: u64,
    at: Duration,
    tokens: u64,
}

impl Pace {
    /// So many requests and tokens a minute, `None` for as many as one likes; zero counts as one.
    pub fn new(requests: Option<u32>, tokens: Option<u64>, clock: Arc<dyn Clock>) -> Self {
        let (requests, tokens) = (requests.map(|most| most.max(1)), tokens.map(|most| most.max(1)));
        Self { requests, tokens, clock, sent: Mutex::default() }
    }

    /// Waits until the request may go; the slot's number.
    fn begin(&self, tokens: u64) -> u64 {
        let now = self.clock.now();
        let mut sent = self.sent.lock().unwrap_or_else(PoisonError::into_inner);
        while sent.window.front().is_some_and(|slot| slot.at + MINUTE <= now) {
            sent.window.pop_front();
        }
        let at = self.earliest(&sent.window, tokens).max(now);
        let id = sent.next;
        sent.next += 1;
        sent.window.push_back(Slot { id, at, tokens });
        drop(sent);
        let wait = at.saturating_sub(now);
        if !wait.is_zero() {
            self.clock.sleep(wait);
        }
        id
    }

    /// Puts the tokens that a request really took in place of those that were reckoned.
    fn settle(&self, id: u64, tokens: u64) {
        let mut sent = self.sent.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(slot) = sent.window.iter_mut().find(|slot| slot.id == id) {
            slot.tokens = tokens;
        }
    }

    /// The earliest time that keeps every minute within its limits. A request larger than a minute's tokens goes alone.
    fn earliest(&self, window: &VecDeque<Slot>, tokens: u64) -> Duration {
        let mut earliest = window.back().map_or(Duration::ZERO, |slot| slot.at);
        if let Some(most) = self.requests
            && let Some(index) = window.len().checked_sub(most as usize)
        {
            earliest = earliest.max(window[index].at + MINUTE);
        }
        if let Some(most) = self.tokens {
            let mut sum = tokens.min(most);
            for slot in window.iter().rev() {
                sum = sum.saturating_add(slot.tokens);
                if sum > most {
                    earliest = earliest.max(slot.at + MINUTE);
                    break;
                }
            }
        }
        earliest
    }
}

/// Waits before each request until the [`Pace`] allows it.
pub struct Paced<M> {
    inner: M,
    pace: Arc<Pace>,
}

impl<M: ChatModel> Paced<M> {
    /// Asks `inner` at a pace shared with others.
    pub fn new(inner: M, pace: Arc<Pace>) -> Self {
        Self { inner, pace }
    }

    fn paced(
        &mut self,
        request: &ChatRequest,
        ask: impl FnOnce(&mut M) -> Result<ChatReply, ModelError>,
    ) -> Result<ChatReply, ModelError> {
        let reckoned = reckoned_prompt(request).saturating_add(request.max_tokens.unwrap_or(0).into());
        let slot = self.pace.begin(reckoned);
        let reply = ask(&mut self.inner)?;
        self.pace.settle(slot, reply.usage.total());
        Ok(reply)
    }
}

impl<M: ChatModel> ChatModel for Paced<M> {
    fn chat(&mut self, request: &ChatRequest) -> Result<ChatReply, ModelError> {
        self.paced(request, |inner| inner.chat(request))
    }

    fn chat_streamed(
        &mut self,
        request: &ChatRequest,
        piece: &mut dyn FnMut(&str),
    ) -> Result<ChatReply, ModelError> {
        self.paced(request, |inner| inner.chat_streamed(request, piece))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{ManualClock, Message, Scripted, Usage};
    use super::*;

    /// When each of `count` requests of one agent was sent, s, if each takes one second and so many tokens.
    fn times(requests: Option<u32>, tokens: Option<u64>, took: u64, count: usize) -> Vec<f64> {
        let clock = Arc::new(ManualClock::new());
        let times = Arc::new(Mutex::new(Vec::new()));
        let (seen, seen_clock) = (times.clone(), clock.clone());
        let server = Scripted::rule(move |_| {
            seen.lock().unwrap().push(seen_clock.now().as_secs_f64());
            seen_clock.sleep(Duration::from_secs(1));
            Ok(ChatReply { usage: Usage { prompt: took, completion: 0 }, ..ChatReply::default() })
        });
        let mut model = Paced::new(server, Arc::new(Pace::new(requests, tokens, clock)));
        let mut request = ChatRequest::new([Message::user("?")]);
        request.max_tokens = Some(100);
        for _ in 0..count {
            model.chat(&request).unwrap();
        }
        let times = times.lock().unwrap();
        times.clone()
    }

    #[test]
    fn no_minute_has_more_requests_than_allowed() {
        assert_eq!(times(Some(3), None, 0, 7), [0.0, 1.0, 2.0, 60.0, 61.0, 62.0, 120.0]);
        assert_eq!(times(None, None, 0, 3), [0.0, 1.0, 2.0]);
    }

    #[test]
    fn no_minute_has_more_tokens_than_allowed() {
        // 101 are reckoned for each before it is sent, and 40 count once it has come back
        assert_eq!(times(None, Some(200), 40, 5), [0.0, 1.0, 2.0, 60.0, 61.0]);
        // larger than a whole minute: each alone
        assert_eq!(times(None, Some(50), 500, 3), [0.0, 60.0, 120.0]);
    }
}
