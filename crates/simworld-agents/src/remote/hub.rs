//! Where the threads of clients and the thread of the world meet: requests that wait, client by client.

use std::collections::{BTreeMap, VecDeque};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::Limits;
use super::link::{Link, Parting};

/// So often does whoever waits look whether the server ends.
pub(super) const GLANCE: Duration = Duration::from_millis(50);

/// Names a client for as long as the server runs.
pub(super) type ClientId = u64;

/// The meeting place.
pub(super) struct Hub {
    state: Mutex<State>,
    /// Something came in.
    work: Condvar,
    /// Something was taken.
    room: Condvar,
    stopping: AtomicBool,
    /// Clients whose threads run.
    pub(super) present: AtomicUsize,
    queued_requests: usize,
    queued_bytes: usize,
}

#[derive(Default)]
struct State {
    seats: BTreeMap<ClientId, Seat>,
    next: ClientId,
    /// Counts whatever the world's thread may have to do.
    arrivals: u64,
    partings: BTreeMap<Parting, u64>,
}

/// One client's place.
struct Seat {
    link: Arc<Link>,
    inbox: VecDeque<Vec<u8>>,
    bytes: usize,
    is_gone: bool,
}

impl Hub {
    pub(super) fn new(limits: &Limits) -> Self {
        Self {
            state: Mutex::default(),
            work: Condvar::new(),
            room: Condvar::new(),
            stopping: AtomicBool::new(false),
            present: AtomicUsize::new(0),
            queued_requests: limits.queued_requests,
            queued_bytes: limits.frame_bytes,
        }
    }

    /// Ends the server: all who wait are woken.
    pub(super) fn stop(&self) {
        self.stopping.store(true, Ordering::SeqCst);
        self.lock().arrivals += 1;
        self.work.notify_all();
        self.room.notify_all();
    }

    pub(super) fn is_stopping(&self) -> bool {
        self.stopping.load(Ordering::SeqCst)
    }

    // ---- the clients' side ----

    /// A client that may ask takes its place.
    pub(super) fn join(&self, link: Arc<Link>) -> ClientId {
        let mut state = self.lock();
        let id = state.next;
        state.next += 1;
        state.seats.insert(id, Seat { link, inbox: VecDeque::new(), bytes: 0, is_gone: false });
        state.arrivals += 1;
        drop(state);
        self.work.notify_one();
        id
    }

    /// Puts a request behind the client's others, when there is room; false if there will be none.
    pub(super) fn push(&self, id: ClientId, request: Vec<u8>) -> bool {
        let mut state = self.lock();
        loop {
            let Some(seat) = state.seats.get_mut(&id) else { return false };
            if self.is_stopping() || !seat.link.is_open() {
                return false;
            }
            let fits =
                seat.bytes + request.len() <= self.queued_bytes && seat.inbox.len() < self.queued_requests;
            if seat.inbox.is_empty() || fits {
                seat.bytes += request.len();
                seat.inbox.push_back(request);
                state.arrivals += 1;
                drop(state);
                self.work.notify_one();
                return true;
            }
            state = self.room.wait_timeout(state, GLANCE).unwrap_or_else(PoisonError::into_inner).0;
        }
    }

    /// A client is gone; what it asked before is still done.
    pub(super) fn leave(&self, id: ClientId) {
        let mut state = self.lock();
        if let Some(seat) = state.seats.get_mut(&id) {
            seat.is_gone = true;
        }
        state.arrivals += 1;
        drop(state);
        self.work.notify_one();
    }

    /// Counts how a client ended.
    pub(super) fn count(&self, parting: Parting) {
        *self.lock().partings.entry(parting).or_default() += 1;
    }

    pub(super) fn partings(&self) -> BTreeMap<Parting, u64> {
        self.lock().partings.clone()
    }

    // ---- the world's side ----

    /// Shows every client there is, and lets the visitor say how many of its requests it takes; these are handed over.
    /// Clients who are gone and have nothing left are forgotten. Gives the count of arrivals up to now.
    pub(super) fn collect(
        &self,
        wanted: &mut dyn FnMut(ClientId, &Arc<Link>) -> usize,
        take: &mut dyn FnMut(ClientId, Vec<u8>),
    ) -> u64 {
        let mut state = self.lock();
        let mut has_room = false;
        state.seats.retain(|id, seat| {
            let count = wanted(*id, &seat.link).min(seat.inbox.len());
            for request in seat.inbox.drain(..count) {
                seat.bytes -= request.len();
                take(*id, request);
            }
            has_room |= count > 0;
            !(seat.is_gone && seat.inbox.is_empty())
        });
        let arrivals = state.arrivals;
        drop(state);
        if has_room {
            self.room.notify_all();
        }
        arrivals
    }

    /// Waits until more came in than `seen`, for so long at most.
    pub(super) fn wait(&self, seen: u64, longest: Duration) {
        let state = self.lock();
        if state.arrivals == seen && !self.is_stopping() {
            drop(self.work.wait_timeout(state, longest).unwrap_or_else(PoisonError::into_inner));
        }
    }

    /// Ends every client's connection.
    pub(super) fn dismiss(&self) {
        for seat in self.lock().seats.values() {
            seat.link.finish(Parting::Stopped);
        }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
