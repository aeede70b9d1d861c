//! One client's thread: it is greeted, its requests are read and passed on, and it is watched over.

use std::io::{ErrorKind, Read};
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::bucket::Bucket;
use super::clock::{now, span};
use super::frame::{Decoder, Framing};
use super::hub::{ClientId, GLANCE, Hub};
use super::link::{Link, Parting};
use super::{Limits, ServerConfig, typed, unrealcv};

/// Bytes of a request before its client is known: a hello, or a token.
const SHORT: usize = 4096;
/// Bytes read at once.
const CHUNK: usize = 64 << 10;

/// What the greeting makes of a frame.
pub(super) enum Greeting {
    /// It may ask from now on.
    Welcome,
    /// It may try again.
    Again,
    /// It may go.
    Refused,
}

/// Reads from one client until it ends: the body of the reader's thread.
pub(super) fn serve_client(hub: &Hub, link: &Arc<Link>, config: &ServerConfig) {
    let mut reader = Reader::new(hub, link, config);
    let parting = reader.run();
    if let Some(id) = reader.id {
        hub.leave(id);
    }
    link.finish(parting);
    hub.count(link.parting().unwrap_or(parting));
}

struct Reader<'a> {
    hub: &'a Hub,
    link: &'a Arc<Link>,
    config: &'a ServerConfig,
    limits: &'a Limits,
    decoder: Decoder,
    bucket: Bucket,
    /// Its number, once it is known.
    id: Option<ClientId>,
    tries: u32,
    /// When it came, or its last request did.
    since: Instant,
    /// When the request began that has not ended.
    began: Option<Instant>,
}

impl<'a> Reader<'a> {
    fn new(hub: &'a Hub, link: &'a Arc<Link>, config: &'a ServerConfig) -> Self {
        let (limits, since) = (&config.limits, now());
        Self {
            hub,
            link,
            config,
            limits,
            decoder: Decoder::new(link.framing(), SHORT.min(limits.frame_bytes)),
            bucket: Bucket::new(limits.requests_per_second, since),
            id: None,
            tries: 0,
            since,
            began: None,
        }
    }

    fn run(&mut self) -> Parting {
        let shortest = self.limits.hello_seconds.min(self.limits.frame_seconds).min(self.limits.idle_seconds);
        let glance = span(shortest * 0.5).clamp(Duration::from_millis(1), GLANCE);
        if self.link.socket().set_read_timeout(Some(glance)).is_err() {
            return Parting::Left;
        }
        if self.link.framing() == Framing::UnrealCv {
            self.link.send(&unrealcv::greeting(&self.config.name));
            if self.config.token.is_none() {
                self.join();
            }
        }
        let mut chunk = vec![0; CHUNK];
        loop {
            if self.hub.is_stopping() {
                return Parting::Stopped;
            }
            if !self.link.is_open() {
                return Parting::Slow;
            }
            match self.link.socket().read(&mut chunk) {
                Ok(0) => return Parting::Left,
                Ok(count) => {
                    self.decoder.feed(&chunk[..count]);
                    if let Err(parting) = self.pass_on() {
                        return parting;
                    }
                }
                Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {}
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(_) => return Parting::Left,
            }
            if let Err(parting) = self.look_at_the_clock() {
                return parting;
            }
        }
    }

    fn join(&mut self) {
        self.decoder.set_limit(self.limits.frame_bytes);
        self.id = Some(self.hub.join(Arc::clone(self.link)));
    }

    /// Passes every whole request on.
    fn pass_on(&mut self) -> Result<(), Parting> {
        loop {
            let frame = match self.decoder.next_frame() {
                Ok(Some(frame)) => frame,
                Ok(None) => break,
                Err(error) => {
                    let farewell = match self.link.framing() {
                        Framing::UnrealCv => unrealcv::farewell(&error),
                        Framing::Typed => typed::farewell(&error),
                    };
                    self.link.send(&farewell);
                    return Err(Parting::Malformed);
                }
            };
            self.hold_back()?;
            if let Some(id) = self.id {
                if !self.hub.push(id, frame) {
                    return Err(Parting::Stopped);
                }
            } else {
                self.greet(&frame)?;
            }
            (self.since, self.began) = (now(), None);
        }
        if self.decoder.is_inside() {
            self.began.get_or_insert_with(now);
        }
        Ok(())
    }

    fn greet(&mut self, frame: &[u8]) -> Result<(), Parting> {
        let greeting = match self.link.framing() {
            Framing::UnrealCv => unrealcv::greet(frame, self.config.token.as_ref(), self.link),
            Framing::Typed => typed::greet(frame, self.config, self.link),
        };
        self.tries += 1;
        match greeting {
            Greeting::Welcome => self.join(),
            Greeting::Again if self.tries < 3 => {}
            Greeting::Again | Greeting::Refused => return Err(Parting::Refused),
        }
        Ok(())
    }

    /// Waits until the client may ask again.
    fn hold_back(&mut self) -> Result<(), Parting> {
        while let Err(wait) = self.bucket.take(now()) {
            if self.hub.is_stopping() {
                return Err(Parting::Stopped);
            }
            std::thread::sleep(wait.min(GLANCE));
        }
        Ok(())
    }

    fn look_at_the_clock(&self) -> Result<(), Parting> {
        let now = now();
        let passed = |since: Instant, seconds| now.saturating_duration_since(since) > span(seconds);
        if self.id.is_none() && passed(self.since, self.limits.hello_seconds) {
            Err(Parting::Stranger)
        } else if self.began.is_some_and(|began| passed(began, self.limits.frame_seconds)) {
            Err(Parting::Dripping)
        } else if passed(self.since, self.limits.idle_seconds) {
            Err(Parting::Idle)
        } else {
            Ok(())
        }
    }
}
