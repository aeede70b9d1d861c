//! One of many environments, and what it is asked to do.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use simworld_core::seam::{Autoreset, Env, EnvError, Options, Transition};
use simworld_core::seed::Seed;

use super::{Boundary, VectorTransition};

/// What an environment is asked to do.
pub(super) enum Job<A> {
    /// To begin an episode.
    Reset { seed: Option<Seed>, options: Options },
    /// To take a step.
    Step { action: A, autoreset: Autoreset, options: Options },
}

/// What came of it, and whether its episode is over.
pub(super) type Done<O> = (Result<VectorTransition<O>, EnvError>, bool);

/// An environment in its place.
pub(super) struct Slot<E> {
    /// None after it panicked: nobody knows what state it was left in.
    env: Option<E>,
    phase: Phase,
}

/// Where an environment is in its episodes.
#[derive(Clone, Copy, PartialEq)]
enum Phase {
    /// Not yet begun, or failed: only a reset helps.
    Blank,
    UnderWay,
    Over,
}

impl<E: Env> Slot<E> {
    /// A place with a new environment; who panics while it is made is told of like who refuses.
    pub(super) fn make(make: impl FnOnce() -> Result<E, EnvError>) -> Result<Self, EnvError> {
        let env = catch_unwind(AssertUnwindSafe(make)).map_err(|panic| panicked(&*panic))??;
        Ok(Self { env: Some(env), phase: Phase::Blank })
    }

    pub(super) fn work(&mut self, job: Job<E::Action>) -> Done<E::Observation> {
        let phase = self.phase;
        let done = self.with(|env| match job {
            Job::Reset { seed, options } => begin(env, seed, &options),
            Job::Step { options, autoreset: Autoreset::NextStep, .. } if phase == Phase::Over => {
                begin(env, None, &options)
            }
            Job::Step { .. } if phase != Phase::UnderWay => Err(EnvError::NotReset),
            Job::Step { action, autoreset, options } => step(env, &action, autoreset, &options),
        });
        let done = done.and_then(|done| done);
        self.phase = match &done {
            Err(_) => Phase::Blank,
            Ok(VectorTransition { transition, boundary: Boundary::None }) if transition.is_last() => {
                Phase::Over
            }
            Ok(_) => Phase::UnderWay,
        };
        (done, self.phase != Phase::UnderWay)
    }

    /// Does something with the environment; whatever panics in it ends there.
    pub(super) fn with<R>(&mut self, act: impl FnOnce(&mut E) -> R) -> Result<R, EnvError> {
        let gone =
            || EnvError::Simulation("it panicked before, and is gone: make the vector anew".to_owned());
        let env = self.env.as_mut().ok_or_else(gone)?;
        catch_unwind(AssertUnwindSafe(|| act(env))).map_err(|panic| {
            self.env = None;
            panicked(&*panic)
        })
    }
}

fn panicked(panic: &(dyn Any + Send)) -> EnvError {
    EnvError::Simulation(format!("it panicked: {}", crate::panics::words(panic)))
}

type Stepped<O> = Result<VectorTransition<O>, EnvError>;

fn begin<E: Env>(env: &mut E, seed: Option<Seed>, options: &Options) -> Stepped<E::Observation> {
    let (observation, info) = env.reset(seed, options)?;
    let transition = Transition { observation, reward: 0.0, terminated: false, truncated: false, info };
    Ok(VectorTransition { transition, boundary: Boundary::Begun })
}

fn step<E: Env>(
    env: &mut E,
    action: &E::Action,
    autoreset: Autoreset,
    options: &Options,
) -> Stepped<E::Observation> {
    let last = env.step(action)?;
    if !last.is_last() || autoreset != Autoreset::SameStep {
        return Ok(VectorTransition { transition: last, boundary: Boundary::None });
    }
    let Transition { observation, reward, terminated, truncated, info } = last;
    let first = begin(env, None, options)?.transition;
    let transition = Transition { reward, terminated, truncated, ..first };
    Ok(VectorTransition { transition, boundary: Boundary::Passed { observation, info } })
}
