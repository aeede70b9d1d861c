//! A policy as a table, learnt by Q-learning (Watkins 1989) in many environments at once, and how good policies are.

use simworld_agents::gym::{Boundary, TimeLimit, VectorEnv, VectorError};
use simworld_core::seam::{Options, SpaceValue};
use simworld_core::seed::{Seed, StreamRng};

use super::Wayfinding;
use super::env::HEADINGS;
use super::field::SIDE;

/// How fast the table follows what comes.
const RATE: f64 = 0.3;
/// What a reward of the next step is worth now.
const DISCOUNT: f64 = 0.97;
/// Share of actions tried at random in the end.
const LEAST_CURIOSITY: f64 = 0.05;
/// After this share of the steps curiosity has come down to that.
const CURIOUS: f64 = 0.6;

/// The environments that policies live in.
pub type Many = VectorEnv<TimeLimit<Wayfinding>>;

/// What each heading is worth in each cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Table(Vec<[f64; HEADINGS]>);

impl Table {
    /// The heading that is worth most in a cell; the first of several.
    pub fn best(&self, cell: usize) -> usize {
        let worth = &self.0[cell];
        (1..HEADINGS).fold(0, |best, next| if worth[next] > worth[best] { next } else { best })
    }

    fn value(&self, cell: usize) -> f64 {
        self.0[cell][self.best(cell)]
    }
}

/// Who decides.
#[derive(Clone, Copy, Debug)]
pub enum Policy<'a> {
    /// Chance.
    Random,
    /// A table.
    Learnt(&'a Table),
}

/// A point of a curve: the episodes that ended since the one before.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// Steps of all environments together so far.
    pub steps: usize,
    /// Mean sum of rewards of an episode.
    pub mean: f64,
    /// Share of episodes in which the door was found.
    pub found: f64,
}

/// A table and how it was learnt.
#[derive(Clone, Debug)]
pub struct Lesson {
    /// What was learnt.
    pub table: Table,
    /// How rewards came to be.
    pub curve: Vec<Point>,
}

/// How good a policy is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Judged {
    /// Episodes.
    pub episodes: usize,
    /// Mean sum of rewards.
    pub mean: f64,
    /// Share in which the door was found.
    pub found: f64,
    /// Mean length, steps.
    pub length: f64,
}

/// Learns for so many steps of all environments together, with so many points of a curve; tells of each round how many steps are done.
///
/// # Errors
/// An environment fails.
pub fn learn(
    envs: &mut Many,
    steps: usize,
    points: usize,
    seed: Seed,
    mut tell: impl FnMut(usize),
) -> Result<Lesson, VectorError> {
    let mut rng = seed.stream("wayfinding/learner").rng();
    let mut table = Table(vec![[0.0; HEADINGS]; SIDE * SIDE]);
    let mut cells = first_cells(envs, seed)?;
    let mut tally = Tally::new(envs.len());
    let (mut curve, every) = (Vec::new(), (steps / points.max(1)).max(1));
    let mut done = 0;
    while done < steps {
        let spent = done as f64 / (CURIOUS * steps as f64);
        let curiosity = (1.0 - spent).max(LEAST_CURIOSITY);
        let headings: Vec<usize> = cells
            .iter()
            .map(|cell| if rng.chance(curiosity) { rng.below(HEADINGS) } else { table.best(*cell) })
            .collect();
        let stepped =
            envs.step(headings.iter().map(|heading| SpaceValue::Discrete(*heading as i64)).collect())?;
        for (index, step) in stepped.iter().enumerate() {
            let next = cell_of(&step.transition.observation);
            if step.boundary == Boundary::None {
                // after an end of the time life would have gone on; after the door it would not
                let ahead = if step.transition.terminated { 0.0 } else { table.value(next) };
                let worth = &mut table.0[cells[index]][headings[index]];
                *worth += RATE * (step.transition.reward + DISCOUNT * ahead - *worth);
                tally.see(
                    index,
                    step.transition.reward,
                    step.transition.is_last(),
                    step.transition.terminated,
                );
            }
            cells[index] = next;
        }
        let before = done / every;
        done += envs.len();
        tell(done);
        if done / every > before {
            let judged = tally.take();
            curve.push(Point { steps: done, mean: judged.mean, found: judged.found });
        }
    }
    Ok(Lesson { table, curve })
}

/// Plays at least so many episodes; with a table they begin where those of chance did.
///
/// # Errors
/// An environment fails.
pub fn judge(
    envs: &mut Many,
    policy: Policy<'_>,
    episodes: usize,
    seed: Seed,
) -> Result<Judged, VectorError> {
    let mut rng = seed.stream("wayfinding/chance").rng();
    let mut cells = first_cells(envs, seed.stream("wayfinding/judge").seed())?;
    let mut tally = Tally::new(envs.len());
    while tally.ended.episodes < episodes {
        let actions = cells.iter().map(|cell| SpaceValue::Discrete(choose(policy, *cell, &mut rng) as i64));
        for (index, step) in envs.step(actions.collect())?.iter().enumerate() {
            cells[index] = cell_of(&step.transition.observation);
            if step.boundary == Boundary::None {
                tally.see(
                    index,
                    step.transition.reward,
                    step.transition.is_last(),
                    step.transition.terminated,
                );
            }
        }
    }
    Ok(tally.take())
}

fn choose(policy: Policy<'_>, cell: usize, rng: &mut StreamRng) -> usize {
    match policy {
        Policy::Random => rng.below(HEADINGS),
        Policy::Learnt(table) => table.best(cell),
    }
}

fn first_cells(envs: &mut Many, seed: Seed) -> Result<Vec<usize>, VectorError> {
    Ok(envs.reset(Some(seed), &Options::new())?.iter().map(|(seen, _)| cell_of(seen)).collect())
}

fn cell_of(seen: &SpaceValue) -> usize {
    seen.as_discrete().map_or(0, |cell| cell as usize)
}

/// Sums over episodes that ended, and of those under way.
struct Tally {
    ended: Judged,
    /// Sum of rewards and steps of the episode under way.
    current: Vec<(f64, f64)>,
}

impl Tally {
    fn new(count: usize) -> Self {
        Self { ended: Judged::default(), current: vec![(0.0, 0.0); count] }
    }

    fn see(&mut self, index: usize, reward: f64, is_last: bool, is_found: bool) {
        let (sum, length) = &mut self.current[index];
        *sum += reward;
        *length += 1.0;
        if is_last {
            self.ended.episodes += 1;
            self.ended.mean += *sum;
            self.ended.length += *length;
            self.ended.found += f64::from(u8::from(is_found));
            self.current[index] = (0.0, 0.0);
        }
    }

    /// The means of those that ended since the last time.
    fn take(&mut self) -> Judged {
        let Judged { episodes, mean, found, length } = std::mem::take(&mut self.ended);
        let count = episodes.max(1) as f64;
        Judged { episodes, mean: mean / count, found: found / count, length: length / count }
    }
}
