//! User equilibrium by gradient projection over paths (Jayakrishnan, Tsai, Prashker and Rajadhyaksha 1994, Transportation
//! Research Record 1443): of each pair, what takes longer than the quickest path gives some of its volume to that, as much as
//! makes both take equally long to first order. It comes far nearer to equilibrium than Frank-Wolfe in the same time, and has
//! the paths.

use super::paths::Graph;
use super::{AssignmentError, Link, Pair};

/// How often all pairs are balanced between two searches for new paths.
const BALANCES: u32 = 10;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquilibriumConfig {
    /// Relative gap at which it is done: what all could save, as a share of the time that all take.
    pub gap: f64,
    /// The most rounds over all pairs.
    pub rounds: u32,
}

impl Default for EquilibriumConfig {
    fn default() -> Self {
        Self { gap: 1e-6, rounds: 200 }
    }
}

/// A path that somebody takes.
#[derive(Clone, Debug, PartialEq)]
pub struct PathFlow {
    /// Its links, in their order.
    pub links: Vec<u32>,
    /// How many take it, vehicles an hour.
    pub volume: f64,
}

/// Who goes where.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Equilibrium {
    /// Of each link, vehicles an hour.
    pub volumes: Vec<f64>,
    /// Of each link, how long it takes, s.
    pub times: Vec<f64>,
    /// Of each pair the paths that are used; none where no way leads.
    pub paths: Vec<Vec<PathFlow>>,
    /// The relative gap that is left.
    pub gap: f64,
    /// Rounds over all pairs.
    pub rounds: u32,
}

impl Equilibrium {
    /// The share of each pair that passes each of some links: a row a link, as `estimate` wants it.
    pub fn proportions(&self, links: &[u32]) -> Vec<f64> {
        let mut table = vec![0.0; links.len() * self.paths.len()];
        for (pair, paths) in self.paths.iter().enumerate() {
            let total: f64 = paths.iter().map(|path| path.volume).sum();
            for path in paths.iter().filter(|_| total > 0.0) {
                for (row, _) in links.iter().enumerate().filter(|(_, link)| path.links.contains(link)) {
                    table[row * self.paths.len() + pair] += path.volume / total;
                }
            }
        }
        table
    }
}

/// Finds the user equilibrium of some demand on a graph.
///
/// ```
/// use simworld_traffic::assignment::{EquilibriumConfig, Link, Pair, equilibrium};
/// // Two roads between the same places: 10 min and wide, or 6 min and narrow.
/// let linear = |free_time, delay| Link { from: 0, to: 1, free_time, delay, capacity: 1000.0, power: 1.0 };
/// let links = [linear(600.0, 60.0), linear(360.0, 600.0)];
/// let found = equilibrium(&links, &[Pair { from: 0, to: 1, volume: 1000.0 }], EquilibriumConfig::default())?;
/// assert!((found.times[0] - found.times[1]).abs() < 1e-3);
/// # Ok::<(), simworld_traffic::assignment::AssignmentError>(())
/// ```
///
/// # Errors
/// A link or pair with a number that cannot be.
pub fn equilibrium(
    links: &[Link],
    pairs: &[Pair],
    config: EquilibriumConfig,
) -> Result<Equilibrium, AssignmentError> {
    check(links, pairs)?;
    let nodes = links.iter().map(|link| link.from.max(link.to) as usize + 1);
    let nodes = nodes.chain(pairs.iter().map(|pair| pair.from.max(pair.to) as usize + 1)).max().unwrap_or(0);
    let mut state = State {
        links,
        pairs,
        graph: Graph::new(links, nodes),
        found: Equilibrium {
            volumes: vec![0.0; links.len()],
            times: links.iter().map(|link| link.time(0.0)).collect(),
            paths: vec![Vec::new(); pairs.len()],
            gap: f64::INFINITY,
            rounds: 0,
        },
        mark: vec![0; links.len()],
    };
    // Pairs with the same beginning share a search.
    let mut order: Vec<usize> = (0..pairs.len()).collect();
    order.sort_by_key(|pair| pairs[*pair].from);
    while state.found.rounds < config.rounds && state.found.gap > config.gap {
        state.round(&order);
    }
    for paths in &mut state.found.paths {
        paths.retain(|path| path.volume > 0.0);
    }
    Ok(state.found)
}

fn check(links: &[Link], pairs: &[Pair]) -> Result<(), AssignmentError> {
    for (index, link) in links.iter().enumerate() {
        let is_time = |time: f64| (0.0..=1e9).contains(&time);
        let reason = match () {
            () if !(is_time(link.free_time) && is_time(link.delay)) => "give times of 0 to 1e9 s",
            () if !(link.capacity > 0.0 && link.capacity.is_finite()) => "give a capacity of more than 0",
            () if !(1.0..=16.0).contains(&link.power) => "give a power of 1 to 16",
            () => continue,
        };
        return Err(AssignmentError::Link { link: index, reason });
    }
    let wrong = pairs.iter().position(|pair| !(0.0..=1e9).contains(&pair.volume));
    wrong.map_or(Ok(()), |pair| {
        Err(AssignmentError::Pair { pair, reason: "give a volume of 0 to 1e9 vehicles an hour" })
    })
}

struct State<'a> {
    links: &'a [Link],
    pairs: &'a [Pair],
    graph: Graph,
    found: Equilibrium,
    /// Which of two paths have each link, while they are compared.
    mark: Vec<u8>,
}

impl State<'_> {
    /// One round over all pairs. The gap is that before it.
    fn round(&mut self, order: &[usize]) {
        let mut last = None;
        let (mut spent, mut needed) = (0.0, 0.0);
        for pair in order.iter().copied() {
            let Pair { from, to, volume } = self.pairs[pair];
            if volume == 0.0 || from == to {
                continue;
            }
            // Times change from pair to pair, but within an origin so little that a search serves all of them.
            if last != Some(from) {
                self.graph.search(from, &self.found.times);
                last = Some(from);
            }
            if self.graph.time(to).is_infinite() {
                continue;
            }
            let quickest = self.graph.path(to, self.links);
            if self.found.paths[pair].is_empty() {
                self.shift(&quickest, volume);
                self.found.paths[pair].push(PathFlow { links: quickest, volume });
                continue;
            }
            if !self.found.paths[pair].iter().any(|path| path.links == quickest) {
                self.found.paths[pair].push(PathFlow { links: quickest, volume: 0.0 });
            }
            let (own, best) = self.balance(pair);
            spent += own;
            needed += best;
        }
        // Among the paths that are known, balance is cheaper than to search again.
        for _ in 0..BALANCES {
            for pair in order.iter().copied() {
                if self.found.paths[pair].len() > 1 {
                    self.balance(pair);
                }
            }
        }
        self.found.rounds += 1;
        if self.found.rounds > 1 {
            self.found.gap = if spent > 0.0 { ((spent - needed) / spent).max(0.0) } else { 0.0 };
        }
    }

    /// Moves volume of a pair to its quickest path. Returns the time that its people spent, and what they would on that, before.
    fn balance(&mut self, pair: usize) -> (f64, f64) {
        let mut paths = std::mem::take(&mut self.found.paths[pair]);
        let time = |state: &Self, path: &PathFlow| -> f64 {
            path.links.iter().map(|link| state.found.times[*link as usize]).sum()
        };
        let times: Vec<f64> = paths.iter().map(|path| time(self, path)).collect();
        let best = (0..paths.len()).min_by(|a, b| times[*a].total_cmp(&times[*b])).unwrap_or(0);
        let spent: f64 = paths.iter().zip(&times).map(|(path, time)| path.volume * time).sum();
        let volume: f64 = paths.iter().map(|path| path.volume).sum();
        let needed = volume * times[best];
        let quickest = paths[best].links.clone();
        let mut gained = 0.0;
        for rank in (0..paths.len()).filter(|rank| *rank != best) {
            let longer = time(self, &paths[rank])
                - quickest.iter().map(|link| self.found.times[*link as usize]).sum::<f64>();
            if longer <= 0.0 || paths[rank].volume == 0.0 {
                continue;
            }
            let moved = self.fair_share(&paths[rank], &quickest, longer);
            paths[rank].volume -= moved;
            gained += moved;
            let links = paths[rank].links.clone();
            self.shift(&links, -moved);
            self.shift(&quickest, moved);
        }
        paths[best].volume += gained;
        let mut rank = 0;
        paths.retain(|path| {
            rank += 1;
            path.volume > 0.0 || rank - 1 == best
        });
        self.found.paths[pair] = paths;
        (spent, needed)
    }

    /// How much of a path's volume the quickest one takes over until both take equally long.
    fn fair_share(&mut self, path: &PathFlow, quickest: &[u32], longer: f64) -> f64 {
        let (own, other) = self.difference(&path.links, quickest);
        let volume = |link: &u32| self.found.volumes[*link as usize];
        let link = |link: &u32| &self.links[*link as usize];
        let slope: f64 = own.iter().chain(&other).map(|one| link(one).slope(volume(one))).sum();
        let longer_after = |moved: f64| -> f64 {
            let left: f64 = own.iter().map(|one| link(one).time((volume(one) - moved).max(0.0))).sum();
            left - other.iter().map(|one| link(one).time(volume(one) + moved)).sum::<f64>()
        };
        let step = if slope > 0.0 { (longer / slope).min(path.volume) } else { path.volume };
        if longer_after(step) >= 0.0 {
            return step;
        }
        // Times rise more sharply than their slopes say: the share is between nothing and the step.
        let (mut low, mut high) = (0.0, step);
        for _ in 0..40 {
            let middle = (low + high) * 0.5;
            if longer_after(middle) >= 0.0 { low = middle } else { high = middle }
        }
        low
    }

    /// The links that only the first of two paths has, and those that only the second has.
    fn difference(&mut self, a: &[u32], b: &[u32]) -> (Vec<u32>, Vec<u32>) {
        for link in a {
            self.mark[*link as usize] |= 1;
        }
        for link in b {
            self.mark[*link as usize] |= 2;
        }
        let only = |path: &[u32], mark: u8| {
            path.iter().copied().filter(|link| self.mark[*link as usize] == mark).collect()
        };
        let found = (only(a, 1), only(b, 2));
        for link in a.iter().chain(b) {
            self.mark[*link as usize] = 0;
        }
        found
    }

    fn shift(&mut self, path: &[u32], volume: f64) {
        for link in path {
            let index = *link as usize;
            let now = &mut self.found.volumes[index];
            // Rounding must not leave less than nothing.
            *now = (*now + volume).max(0.0);
            self.found.times[index] = self.links[index].time(*now);
        }
    }
}
