//! The conformance checks pass an environment that keeps the contract, and catch each way of breaking it that is tried here.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::rc::Rc;

use simworld_core::id::EntityId;
use simworld_core::seam::{
    Env, EnvError, Info, Options, ParallelEnv, ParallelStart, ParallelStep, Space, SpaceError, SpaceValue,
    Transition,
};
use simworld_core::seed::{Seed, StreamRng};
use simworld_core::testing::{EnvCheck, check_env, check_parallel_env};

/// In which way it is broken.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    None,
    StepsBeforeReset,
    GoesOnAfterItsEnd,
    TakesAnyAction,
    RefusalMoves,
    TakesAnyOption,
    SpaceChanges,
    SpaceIsNone,
    LeavesItsSpace,
    RewardIsNan,
    IgnoresTheSeed,
    RemembersTheLastEpisode,
    RemembersWhenBrokenOff,
    UnseededRepeats,
    CountsEnvironments,
    DependsOnThreads,
    RevivesTheDead,
    ForgetsSomebody,
    HearsTheDead,
}

/// Somebody on a line, pushed to and fro by chance and by what it does; it ends beyond ±5, or after 30 steps.
struct Line {
    fault: Fault,
    threads: usize,
    made: usize,
    rng: StreamRng,
    seed: Seed,
    x: f64,
    steps: u32,
    left_over: f64,
    is_over: bool,
}

impl Line {
    fn new(fault: Fault, threads: usize, made: usize) -> Self {
        let rng = Seed(0).stream("line").rng();
        Self { fault, threads, made, rng, seed: Seed(0), x: 0.0, steps: 0, left_over: 0.0, is_over: true }
    }

    fn has(&self, fault: Fault) -> bool {
        self.fault == fault
    }

    fn seen(&self) -> SpaceValue {
        let beyond = if self.has(Fault::LeavesItsSpace) && self.steps == 5 { 1e3 } else { 0.0 };
        SpaceValue::Box(vec![(self.x / 20.0).clamp(-1.0, 1.0) + beyond])
    }

    fn begin(&mut self, seed: Option<Seed>) -> SpaceValue {
        if self.has(Fault::RemembersTheLastEpisode)
            || (self.has(Fault::RemembersWhenBrokenOff) && !self.is_over)
        {
            self.left_over = 0.01 * f64::from(self.steps);
        }
        let next = self.seed.stream("next").seed();
        self.seed = seed.unwrap_or(if self.has(Fault::UnseededRepeats) { Seed(1) } else { next });
        let used = if self.has(Fault::IgnoresTheSeed) { Seed(4) } else { self.seed };
        self.rng = used.stream("line").rng();
        (self.steps, self.is_over) = (0, false);
        self.x = self.rng.uniform(-1.0, 1.0) + self.left_over;
        self.seen()
    }

    fn act(&mut self, push: i64) -> Transition<SpaceValue> {
        let chance = self.rng.uniform(-0.5, 0.5);
        // broken only in a late step: who looks at the first alone finds nothing
        let far = self.steps > 4;
        self.x += push as f64 + chance;
        self.x += if self.has(Fault::DependsOnThreads) && far { 1e-9 * self.threads as f64 } else { 0.0 };
        self.x += if self.has(Fault::CountsEnvironments) { 1e-9 * self.made as f64 } else { 0.0 };
        self.steps += 1;
        let (terminated, truncated) = (self.x.abs() > 5.0, self.steps >= 30);
        self.is_over = terminated || truncated;
        let reward = if self.has(Fault::RewardIsNan) && self.steps == 9 { f64::NAN } else { -self.x.abs() };
        Transition { observation: self.seen(), reward, terminated, truncated, info: Info::new() }
    }

    fn options(&self, options: &Options) -> Result<(), EnvError> {
        if self.has(Fault::TakesAnyOption) { Ok(()) } else { EnvError::refuse_unknown(options, &[]) }
    }

    fn own_spaces(&self) -> (Space, Space) {
        let wide = if self.has(Fault::SpaceChanges) && self.steps > 6 { 2.0 } else { 1.0 };
        let (low, n) = if self.has(Fault::SpaceIsNone) { (3.0, 0) } else { (-1.0, 3) };
        (Space::bounded(low, wide, vec![1]), Space::Discrete { n, start: -1 })
    }

    fn push_of(&mut self, action: &SpaceValue) -> Result<i64, SpaceError> {
        match self.own_spaces().1.check(action) {
            Err(_) if self.has(Fault::TakesAnyAction) => Ok(0),
            Err(error) => {
                if self.has(Fault::RefusalMoves) {
                    self.x += 1e-12 * f64::from(self.threads as u32);
                }
                Err(error)
            }
            Ok(()) => Ok(action.as_discrete().unwrap_or(0)),
        }
    }
}

impl Env for Line {
    type Observation = SpaceValue;
    type Action = SpaceValue;

    fn reset(&mut self, seed: Option<Seed>, options: &Options) -> Result<(SpaceValue, Info), EnvError> {
        self.options(options)?;
        Ok((self.begin(seed), Info::new()))
    }

    fn step(&mut self, action: &SpaceValue) -> Result<Transition<SpaceValue>, EnvError> {
        let early = self.has(Fault::StepsBeforeReset) && self.steps == 0;
        let late = self.has(Fault::GoesOnAfterItsEnd) && self.steps > 0;
        if self.is_over && !early && !late {
            return Err(EnvError::NotReset);
        }
        let push = self.push_of(action).map_err(|source| EnvError::NotInSpace { what: "action", source })?;
        Ok(self.act(push))
    }

    fn spaces(&self) -> (Space, Space) {
        self.own_spaces()
    }
}

/// Three on lines of their own.
struct Lines {
    lines: Vec<Line>,
    gone: Vec<bool>,
}

impl Lines {
    fn new(fault: Fault, threads: usize, made: usize) -> Self {
        Self { lines: (0..3).map(|_| Line::new(fault, threads, made)).collect(), gone: vec![true; 3] }
    }

    fn has(&self, fault: Fault) -> bool {
        self.lines[0].has(fault)
    }

    fn ids() -> impl Iterator<Item = EntityId> {
        (0..3).map(|index| EntityId::new(index, 0))
    }

    /// What each is told to do, when all are known and present and all actions of their space.
    fn pushes(
        &mut self,
        actions: &BTreeMap<EntityId, SpaceValue>,
    ) -> Result<BTreeMap<EntityId, i64>, EnvError> {
        let hears = self.has(Fault::HearsTheDead);
        let push = |(id, action): (&EntityId, &SpaceValue)| {
            let is_there = self.gone.get(id.index()).is_some_and(|gone| !gone || hears);
            let gone = || SpaceError { path: id.to_string(), reason: "is gone".to_owned() };
            let push = if is_there { self.lines[id.index()].push_of(action) } else { Err(gone()) };
            Ok((*id, push.map_err(|source| EnvError::Action { who: *id, source })?))
        };
        actions.iter().map(push).collect()
    }
}

impl ParallelEnv for Lines {
    type Observation = SpaceValue;
    type Action = SpaceValue;

    fn reset(
        &mut self,
        seed: Option<Seed>,
        options: &Options,
    ) -> Result<ParallelStart<SpaceValue>, EnvError> {
        self.lines[0].options(options)?;
        self.gone = vec![false; 3];
        let begin = |(index, line): (usize, &mut Line)| {
            let own = seed.map(|seed| seed.stream("lines").indexed(index as u64).seed());
            (line.begin(own), Info::new())
        };
        Ok(Self::ids().zip(self.lines.iter_mut().enumerate().map(begin)).collect())
    }

    fn step(
        &mut self,
        actions: &BTreeMap<EntityId, SpaceValue>,
    ) -> Result<ParallelStep<SpaceValue>, EnvError> {
        let steps = self.lines.iter().map(|line| line.steps).max();
        let early = self.has(Fault::StepsBeforeReset) && steps == Some(0);
        let late = self.has(Fault::GoesOnAfterItsEnd) && steps > Some(0);
        if self.gone.iter().all(|gone| *gone) && !early && !late {
            return Err(EnvError::NotReset);
        }
        let pushes = self.pushes(actions)?;
        let mut all = ParallelStep::new();
        for id in Self::ids() {
            let forgotten = self.has(Fault::ForgetsSomebody) && id.index() == 1 && steps > Some(4);
            if (self.gone[id.index()] && !self.has(Fault::RevivesTheDead)) || forgotten {
                continue;
            }
            let transition = self.lines[id.index()].act(pushes.get(&id).copied().unwrap_or(0));
            self.gone[id.index()] = transition.is_last();
            all.insert(id, transition);
        }
        Ok(all)
    }

    fn spaces(&self, agent: EntityId) -> (Space, Space) {
        self.lines[agent.index()].own_spaces()
    }
}

/// What the check says, if it finds something.
fn verdict(check: impl FnOnce()) -> Option<String> {
    let panic = catch_unwind(AssertUnwindSafe(check)).err()?;
    let text = panic.downcast_ref::<String>().cloned();
    Some(text.or_else(|| panic.downcast_ref::<&str>().map(ToString::to_string)).unwrap_or_default())
}

const FAULTS: [(Fault, &str); 16] = [
    (Fault::StepsBeforeReset, "a step before reset"),
    (Fault::GoesOnAfterItsEnd, "goes on"),
    (Fault::TakesAnyAction, "of another kind is refused"),
    (Fault::RefusalMoves, "threads gives the same trajectory"),
    (Fault::TakesAnyOption, "an unknown option"),
    (Fault::SpaceChanges, "changed"),
    (Fault::SpaceIsNone, "the space of observations"),
    (Fault::LeavesItsSpace, "step"),
    (Fault::RewardIsNan, "the reward of"),
    (Fault::IgnoresTheSeed, "another"),
    (Fault::RemembersTheLastEpisode, "the same trajectory"),
    (Fault::RemembersWhenBrokenOff, "broken off"),
    (Fault::UnseededRepeats, "an episode without a seed"),
    (Fault::CountsEnvironments, "a fresh environment"),
    (Fault::DependsOnThreads, "with 2 threads"),
    (Fault::None, ""),
];

#[test]
fn of_one_agent() {
    for (fault, words) in FAULTS {
        let made = Rc::new(Cell::new(0));
        let make = |threads| {
            made.set(made.get() + 1);
            Line::new(fault, threads, made.get())
        };
        let found = verdict(|| check_env(make, &EnvCheck::new(40)));
        if fault == Fault::None {
            assert_eq!(found, None, "a sound environment is passed");
        } else {
            let found = found.unwrap_or_else(|| panic!("{fault:?} is not caught"));
            assert!(found.contains(words), "{fault:?} is caught as: {found}");
        }
    }
}

#[test]
fn of_several_agents() {
    let own = [
        (Fault::RevivesTheDead, "those who have a transition"),
        (Fault::ForgetsSomebody, "those who have a transition"),
        (Fault::HearsTheDead, "who is gone, is refused"),
    ];
    // an unseeded environment of many has no seed of its own to repeat
    let shared = FAULTS.into_iter().filter(|(fault, _)| *fault != Fault::UnseededRepeats);
    for (fault, words) in shared.chain(own) {
        let made = Rc::new(Cell::new(0));
        let make = |threads| {
            made.set(made.get() + 1);
            Lines::new(fault, threads, made.get())
        };
        let found = verdict(|| check_parallel_env(make, &EnvCheck::new(40)));
        if fault == Fault::None {
            assert_eq!(found, None, "a sound environment is passed");
        } else {
            let found = found.unwrap_or_else(|| panic!("{fault:?} is not caught"));
            assert!(found.contains(words), "{fault:?} is caught as: {found}");
        }
    }
}
