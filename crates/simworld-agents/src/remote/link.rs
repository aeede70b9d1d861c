//! What goes out to one client: a bounded buffer, and the thread that empties it.

use std::io::Write;
use std::net::{Shutdown, TcpStream};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

use serde::{Deserialize, Serialize};

use super::Limits;
use super::clock::{now, span};
use super::frame::Framing;

/// The most that is written at once, bytes: a client has `write_seconds` for each such piece.
const PIECE: usize = 64 << 10;
/// A buffer that grew beyond this is given back when it is empty, bytes.
const KEPT: usize = 1 << 20;

/// Why a client is no longer there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Parting {
    /// It left.
    Left,
    /// There were too many.
    Crowded,
    /// It did not say who it is, or not in time.
    Stranger,
    /// It showed a wrong token, or speaks another version.
    Refused,
    /// What it sent makes no sense.
    Malformed,
    /// It began a request and did not end it in time.
    Dripping,
    /// It asked nothing for too long.
    Idle,
    /// It did not take its replies in time.
    Slow,
    /// The server ended.
    Stopped,
}

/// The way to one client.
pub(super) struct Link {
    socket: TcpStream,
    framing: Framing,
    out: Mutex<Out>,
    wake: Condvar,
    most: usize,
    seconds: f64,
}

struct Out {
    /// Frames that wait.
    pending: Vec<u8>,
    /// Bytes that the writer is at.
    writing: usize,
    is_open: bool,
    parting: Option<Parting>,
}

impl Link {
    pub(super) fn new(socket: TcpStream, framing: Framing, limits: &Limits) -> Self {
        let out = Out { pending: Vec::new(), writing: 0, is_open: true, parting: None };
        Self {
            socket,
            framing,
            out: Mutex::new(out),
            wake: Condvar::new(),
            most: limits.queued_bytes,
            seconds: limits.write_seconds,
        }
    }

    pub(super) fn socket(&self) -> &TcpStream {
        &self.socket
    }

    pub(super) fn framing(&self) -> Framing {
        self.framing
    }

    /// Puts a message behind what waits; whoever has let too much wait is dropped.
    pub(super) fn send(&self, payload: &[u8]) {
        let mut out = self.lock();
        if !out.is_open {
            return;
        }
        if out.pending.len() + out.writing + payload.len() > self.most {
            drop(out);
            self.drop_now(Parting::Slow);
            return;
        }
        self.framing.frame_into(payload, &mut out.pending);
        drop(out);
        self.wake.notify_one();
    }

    /// Bytes that wait to be taken.
    pub(super) fn waiting(&self) -> usize {
        let out = self.lock();
        out.pending.len() + out.writing
    }

    /// Whether nothing more is to be done for the client until it has taken more of its replies.
    pub(super) fn is_full(&self) -> bool {
        self.waiting() > self.most / 2
    }

    pub(super) fn is_open(&self) -> bool {
        self.lock().is_open
    }

    /// Lets the client have what waits, and then no more.
    pub(super) fn finish(&self, parting: Parting) {
        let mut out = self.lock();
        out.is_open = false;
        out.parting.get_or_insert(parting);
        drop(out);
        self.wake.notify_one();
    }

    /// Ends it at once.
    pub(super) fn drop_now(&self, parting: Parting) {
        let mut out = self.lock();
        out.is_open = false;
        // Nobody waits for the rest any more, or whoever is gone would count as one who has not taken its replies.
        out.pending = Vec::new();
        out.writing = 0;
        out.parting.get_or_insert(parting);
        drop(out);
        // The peer may be gone already.
        let _ = self.socket.shutdown(Shutdown::Both);
        self.wake.notify_one();
    }

    /// Why it ended; the first reason counts.
    pub(super) fn parting(&self) -> Option<Parting> {
        self.lock().parting
    }

    /// Writes what waits until it ends: the body of the writer's thread.
    pub(super) fn write_out(&self) {
        let mut batch = Vec::new();
        while self.next_batch(&mut batch) {
            if !self.write(&batch) {
                self.drop_now(Parting::Slow);
                return;
            }
            batch.clear();
            if batch.capacity() > KEPT {
                batch = Vec::new();
            }
        }
        // What was written is still delivered.
        let _ = self.socket.shutdown(Shutdown::Write);
    }

    /// Waits for something to write; false when there will be nothing more.
    fn next_batch(&self, batch: &mut Vec<u8>) -> bool {
        let mut out = self.lock();
        out.writing = 0;
        while out.pending.is_empty() && out.is_open {
            out = self.wake.wait(out).unwrap_or_else(PoisonError::into_inner);
        }
        std::mem::swap(batch, &mut out.pending);
        out.writing = batch.len();
        !batch.is_empty()
    }

    /// Writes a batch piece by piece; false if one was not taken in time, or the peer is gone.
    fn write(&self, batch: &[u8]) -> bool {
        for piece in batch.chunks(PIECE) {
            let (until, mut rest) = (now() + span(self.seconds), piece);
            while !rest.is_empty() {
                match (&self.socket).write(rest) {
                    Ok(0) => return false,
                    Ok(count) => rest = &rest[count..],
                    Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
                    Err(_) => return false,
                }
                if !rest.is_empty() && now() > until {
                    return false;
                }
            }
        }
        true
    }

    fn lock(&self) -> MutexGuard<'_, Out> {
        self.out.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
