//! Who steps the environments: the caller and threads, each of whom has a share of them.

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

/// Those who step: the caller and, with more than one thread, hands of which each has its share. Environment `i` is the `i / n`-th of
/// share `i % n` of `n`, and the first share is the caller's, who works like the others instead of waiting for them.
pub(super) struct Crew<E: Env> {
    own: Vec<Slot<E>>,
    hands: Vec<Hand<E>>,
    count: usize,
}

/// A thread and the way to it.
struct Hand<E: Env> {
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
        let hands = (1..threads.min(count)).map(|_| Hand::new()).collect::<Result<Vec<_>, _>>()?;
        let mut crew = Self { own: Vec::new(), hands, count };
        let shares = crew.shares();
        let made = crew.everywhere(|first| {
            let make = Arc::clone(make);
            move |slots: &mut Vec<Slot<E>>| {
                (first..count).step_by(shares).try_for_each(|index| {
                    let slot = Slot::make(|| make(index));
                    slots.push(slot.map_err(|source| VectorError::Env { index, source })?);
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
        let (share, place) = (index % self.shares(), index / self.shares());
        let seen = match share.checked_sub(1) {
            None => self.own[place].with(look),
            Some(hand) => {
                let answer = self.hands[hand].ask(move |slots| slots[place].with(look));
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
        let mut all = Vec::with_capacity(self.count);
        let mut fault = None;
        for (index, done) in self.share_out(jobs).into_iter().enumerate() {
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

    /// Does the jobs, each where its environment is; what came of them in the order of the environments.
    fn share_out(&mut self, jobs: Jobs<E>) -> AllDone<E> {
        let among = self.shares();
        let mut shares: Vec<Jobs<E>> = (0..among).map(|_| Vec::new()).collect();
        for (index, job) in jobs.into_iter().enumerate() {
            shares[index % among].push(job);
        }
        let mut shares = shares.into_iter();
        let done = self.everywhere(|_| {
            let share = shares.next().unwrap_or_default();
            move |slots: &mut Vec<Slot<E>>| work_through(slots, share)
        });
        let mut done: Vec<_> = done.into_iter().map(|share| share.ok().map(Vec::into_iter)).collect();
        let pick = |index: usize| match &mut done[index % among] {
            Some(share) => share.next().unwrap_or_default(),
            None => Some((Err(lost()), true)),
        };
        (0..self.count).map(pick).collect()
    }

    /// Sends every hand on an errand, which is made with the index of its first environment, does the first one itself, and waits
    /// for all.
    fn everywhere<R, F>(&mut self, mut errand: impl FnMut(usize) -> F) -> Vec<Result<R, VectorError>>
    where
        R: Send + 'static,
        F: FnOnce(&mut Vec<Slot<E>>) -> R + Send + 'static,
    {
        let mine = errand(0);
        let sent: Vec<Receiver<R>> =
            self.hands.iter().enumerate().map(|(hand, one)| one.ask(errand(hand + 1))).collect();
        let mut all = vec![Ok(mine(&mut self.own))];
        all.extend(sent.into_iter().enumerate().map(|(hand, answer)| {
            answer.recv().map_err(|_| VectorError::Env { index: hand + 1, source: lost() })
        }));
        all
    }

    fn shares(&self) -> usize {
        self.hands.len() + 1
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
