//! Who steps the environments: the caller, or threads that have each a share of them.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::{Builder, JoinHandle};

use simworld_core::seam::{Env, EnvError};

use super::slot::{Done, Job, Slot};
use super::{VectorError, VectorTransition};

/// Makes an environment, by its index.
pub(super) type Make<E> = Arc<dyn Fn(usize) -> Result<E, EnvError> + Send + Sync>;

/// Whatever a thread is asked to do with its share.
type Errand<E> = Box<dyn FnOnce(&mut Vec<Slot<E>>) + Send>;

/// What came of jobs; nothing where there was none.
type AllDone<E> = Vec<Option<Done<<E as Env>::Observation>>>;

/// The jobs of some environments; nothing where one has none.
type Jobs<E> = Vec<Option<Job<<E as Env>::Action>>>;

/// Those who step.
pub(super) enum Crew<E: Env> {
    /// The caller.
    Caller(Vec<Slot<E>>),
    /// Threads, and the number of environments; environment `i` is the `i / n`-th of thread `i % n`.
    Threads(Vec<Hand<E>>, usize),
}

/// A thread and the way to it.
pub(super) struct Hand<E: Env> {
    /// None once it is told to end.
    errands: Option<Sender<Errand<E>>>,
    thread: Option<JoinHandle<()>>,
}

impl<E> Crew<E>
where
    E: Env + 'static,
    E::Observation: Send + 'static,
    E::Action: Send + 'static,
{
    pub(super) fn new(count: usize, threads: usize, make: &Make<E>) -> Result<Self, VectorError> {
        let failed = |index| move |source| VectorError::Env { index, source };
        if threads == 1 || count <= 1 {
            let slot = |index| make(index).map(Slot::new).map_err(failed(index));
            return Ok(Self::Caller((0..count).map(slot).collect::<Result<_, _>>()?));
        }
        let hands = (0..threads.min(count)).map(|_| Hand::new()).collect::<Result<Vec<_>, _>>()?;
        let threads = hands.len();
        let crew = Self::Threads(hands, count);
        let made = crew.everywhere(|first| {
            let make = Arc::clone(make);
            move |slots: &mut Vec<Slot<E>>| {
                (first..count).step_by(threads).try_for_each(|index| {
                    slots.push(Slot::new(make(index).map_err(failed(index))?));
                    Ok(())
                })
            }
        });
        // The error of the lowest index, whichever thread was first to fail.
        let faults = made.into_iter().filter_map(|made| made.and_then(|made| made).err());
        let index = |fault: &VectorError| {
            if let VectorError::Env { index, .. } = fault { *index } else { usize::MAX }
        };
        faults.min_by_key(index).map_or(Ok(crew), Err)
    }

    /// Looks at one, where it is; the index is that of one.
    pub(super) fn visit<R: Send + 'static>(
        &mut self,
        index: usize,
        look: impl FnOnce(&mut E) -> R + Send + 'static,
    ) -> Result<R, VectorError> {
        let seen = match self {
            Self::Caller(slots) => slots[index].with(look),
            Self::Threads(hands, _) => {
                let place = index / hands.len();
                let answer = hands[index % hands.len()].ask(move |slots| slots[place].with(look));
                answer.recv().unwrap_or_else(|_| Err(lost()))
            }
        };
        seen.map_err(|source| VectorError::Env { index, source })
    }

    /// Gives each its job, if it has one, and waits for all; `over` is whose episode is over afterwards.
    pub(super) fn work(
        &mut self,
        jobs: Jobs<E>,
        over: &mut [bool],
    ) -> Result<Vec<Option<VectorTransition<E::Observation>>>, VectorError> {
        let done = match self {
            Self::Caller(slots) => work_through(slots, jobs),
            Self::Threads(hands, count) => {
                let threads = hands.len();
                let count = *count;
                self.work_on_threads(jobs, threads, count)
            }
        };
        let mut all = Vec::with_capacity(done.len());
        let mut fault = None;
        for (index, done) in done.into_iter().enumerate() {
            let Some((result, is_over)) = done else {
                all.push(None);
                continue;
            };
            over[index] = is_over;
            match result {
                Ok(transition) => all.push(Some(transition)),
                Err(source) => fault = fault.or(Some(VectorError::Env { index, source })),
            }
        }
        fault.map_or(Ok(all), Err)
    }

    fn work_on_threads(&self, jobs: Jobs<E>, threads: usize, count: usize) -> AllDone<E> {
        let mut shares: Vec<Jobs<E>> = (0..threads).map(|_| Vec::new()).collect();
        for (index, job) in jobs.into_iter().enumerate() {
            shares[index % threads].push(job);
        }
        let mut shares = shares.into_iter();
        let done = self.everywhere(|_| {
            let share = shares.next().unwrap_or_default();
            move |slots: &mut Vec<Slot<E>>| work_through(slots, share)
        });
        let mut done: Vec<_> = done.into_iter().map(|share| share.ok().map(Vec::into_iter)).collect();
        let pick = |index: usize| match &mut done[index % threads] {
            Some(share) => share.next().unwrap_or_default(),
            None => Some((Err(lost()), true)),
        };
        (0..count).map(pick).collect()
    }

    /// Sends every thread on an errand, which is made with the index of its first environment, and waits for all.
    fn everywhere<R, F>(&self, mut errand: impl FnMut(usize) -> F) -> Vec<Result<R, VectorError>>
    where
        R: Send + 'static,
        F: FnOnce(&mut Vec<Slot<E>>) -> R + Send + 'static,
    {
        let Self::Threads(hands, _) = self else { return Vec::new() };
        let sent: Vec<Receiver<R>> =
            hands.iter().enumerate().map(|(first, hand)| hand.ask(errand(first))).collect();
        let answer = |(index, answer): (usize, Receiver<R>)| {
            answer.recv().map_err(|_| VectorError::Env { index, source: lost() })
        };
        sent.into_iter().enumerate().map(answer).collect()
    }
}

impl<E: Env + 'static> Hand<E> {
    fn new() -> std::io::Result<Self> {
        let (errands, received) = channel::<Errand<E>>();
        let thread = Builder::new().name("simworld-gym".to_owned()).spawn(move || {
            let mut slots = Vec::new();
            while let Ok(errand) = received.recv() {
                errand(&mut slots);
            }
        })?;
        Ok(Self { errands: Some(errands), thread: Some(thread) })
    }

    /// Sends the thread on an errand; no answer comes if it panics there.
    fn ask<R: Send + 'static>(
        &self,
        errand: impl FnOnce(&mut Vec<Slot<E>>) -> R + Send + 'static,
    ) -> Receiver<R> {
        let (answer, answered) = channel();
        if let Some(errands) = &self.errands {
            // A thread that is gone drops the errand, and with it `answer`: then the receiver says so.
            let _ = errands.send(Box::new(move |slots| drop(answer.send(errand(slots)))));
        }
        answered
    }
}

impl<E: Env> Drop for Hand<E> {
    fn drop(&mut self) {
        self.errands = None;
        if let Some(thread) = self.thread.take() {
            // What it panicked with was told by the step that failed.
            let _ = thread.join();
        }
    }
}

fn work_through<E: Env>(slots: &mut [Slot<E>], jobs: Jobs<E>) -> AllDone<E> {
    slots.iter_mut().zip(jobs).map(|(slot, job)| job.map(|job| slot.work(job))).collect()
}

fn lost() -> EnvError {
    EnvError::Simulation("its thread is gone: make the vector anew".to_owned())
}
