//! Streets by growth: a priority queue of street ends that balances depth against breadth.
//!
//! Each end popped from the queue proposes one segment. The proposal is attached to what it nearly meets, cut where
//! it meets a street, and checked against every rule of a junction; what passes becomes a street and proposes its own
//! continuation and branches (after Parish and Müller 2001, in the queue form of the paper's predecessor). The network
//! is connected because every segment begins at a junction that exists. Loose ends are then attached to what they
//! look at, and of the others as many are taken away as the style has too many.

mod bend;
mod cells;
mod course;
mod fabric;
mod field;
mod finish;
mod fitted;
mod order;
mod proposal;
mod queue;
mod within;

use std::f64::consts::{FRAC_PI_2, PI};

use rayon::prelude::*;
use simworld_core::geometry::{Point2, direction, heading};
use simworld_core::net::{CrossSection, RoadClass, Street, StreetPlan};
use simworld_core::seed::{Seed, StreamRng};

use crate::RoadConfig;
use bend::Curves;
use fabric::{Fabric, MOST_STREETS};
use field::{Field, Site};
use fitted::Start;
use proposal::{Fitter, Measures, Proposal};
use queue::{End, Queue};
pub(crate) use within::{Gate, Soil, Within, grow_within};

/// Attempts to revive growth for each segment asked for, when no end is left in the queue.
const REVIVALS: u32 = 40;
/// Rounds of growing and pruning.
const ROUNDS: u32 = 8;
/// Segments of a highway are so much longer than others.
const HIGHWAY_STRIDE: f64 = 1.5;
/// The town fills so much of the radius of its land.
const TOWN: f64 = 0.5;
/// Streets that leave a highway wait as if they were so many segments farther.
const HIGHWAY_DELAY: f64 = 2.0;
/// Streets that divide blocks wait as if they were so many segments farther, until it shows how large the blocks are.
const DIVISION_DELAY: f64 = 3.0;

/// Grows streets from the origin; the configuration is taken as valid.
///
/// It always ends: when the queue runs dry it is revived from existing junctions, a bounded number of times.
pub fn grow(config: &RoadConfig, seed: Seed) -> StreetPlan {
    // A street needs about half the square of its length; growth leaves gaps, and wants room to choose.
    let needed = f64::from(config.count) * config.length * config.length;
    let radius = (needed / PI).sqrt() * 1.5 + 6.0 * config.length;
    let (mut field, mut fitter) = (Field::new(config, radius, seed), Fitter::default());
    let mut growth = Growth::new(config, (&mut field, &mut fitter), seed);
    growth.plant();
    for _ in 0..ROUNDS {
        growth.run();
        growth.attach_loose_ends();
        growth.prune();
        if growth.standing >= config.count as usize || growth.revivals == 0 {
            break;
        }
    }
    // A city too small for so few dead ends keeps what it needs to have its count. What the rounds took back may have cost
    // every attempt, so these are its own.
    growth.revivals = attempts(config);
    growth.run();
    growth.plan(seed)
}

/// How often growth may be revived.
fn attempts(config: &RoadConfig) -> u32 {
    config.count.saturating_mul(REVIVALS)
}

struct Growth<'a> {
    config: &'a RoadConfig,
    measures: Measures,
    field: &'a mut Field,
    fabric: Fabric,
    fitter: &'a mut Fitter,
    queue: Queue,
    revivals: u32,
    /// Segments that are streets still, and how many there are to be.
    standing: usize,
    wanted: usize,
    rng: StreamRng,
}

impl<'a> Growth<'a> {
    fn new(config: &'a RoadConfig, (field, fitter): (&'a mut Field, &'a mut Fitter), seed: Seed) -> Self {
        let (count, reach) = (config.count as usize, field.radius());
        Self {
            config,
            measures: Measures::new(config),
            field,
            fabric: Fabric::around(Point2::origin(), reach, config.length, count),
            fitter,
            queue: Queue::new(1.0),
            revivals: attempts(config),
            standing: 0,
            wanted: count,
            rng: seed.stream("citygen/roads").rng(),
        }
    }

    /// Main streets in opposite directions from the origin: highways, if there are any, and else arterials.
    fn plant(&mut self) {
        let origin = self.fabric.add_node(Point2::origin(), MOST_STREETS as u8);
        let site = self.field.site(Point2::origin());
        let ends = self.config.highways.clamp(2, MOST_STREETS as u32);
        let class = if self.config.highways > 0 { RoadClass::Highway } else { RoadClass::Arterial };
        for end in 0..ends {
            // Opposite ones first.
            let turns = [0.0, 2.0, 1.0, 3.0][end as usize];
            self.push(0.0, (Start::Node(origin), &site), site.grain + turns * FRAC_PI_2, class);
        }
    }

    fn run(&mut self) {
        while self.standing < self.wanted {
            let Some(end) = self.queue.pop() else {
                if self.revivals == 0 {
                    return;
                }
                self.revivals -= 1;
                self.revive();
                continue;
            };
            self.try_to_build(&end);
        }
    }

    /// Builds a proposal if it fits, and proposes the ways on from a new junction.
    fn try_to_build(&mut self, end: &End) {
        let proposal = self.proposal(end);
        let Some(fitted) = self.fitter.fit(&self.fabric, &proposal, &self.measures) else { return };
        let limit = if self.rng.chance(self.config.crossroads) { 4 } else { 3 };
        let before = self.fabric.segments().len();
        let node = self.fabric.build(&fitted, limit);
        self.standing += self.fabric.segments().len() - before;
        self.divide_beside(end.steps, self.fabric.segments().len() as u32 - 1);
        if fitted.is_open() {
            self.branch(end, node);
        }
    }

    /// Proposes to divide the blocks on both sides of a street from its middle, if it is long enough.
    fn divide_beside(&mut self, steps: f64, segment: u32) {
        if self.fabric.length(segment) < 4.2 * self.measures.least_length {
            return;
        }
        let start = Start::Middle(segment);
        let site = self.field.site(self.fabric.start(start));
        let along = heading(&self.fabric.segment(segment).along);
        for side in [FRAC_PI_2, -FRAC_PI_2] {
            let towards = self.guided(&site, along + side);
            self.push_division(steps, (start, &site), towards);
        }
    }

    /// Proposes the ways on from a new junction: straight, left and right.
    fn branch(&mut self, end: &End, node: u32) {
        let End { steps, heading: came, class, .. } = *end;
        let site = self.field.site(self.fabric.at(node));
        let start = Start::Node(node);
        let main = class != RoadClass::Local;
        let goes_on = main || self.rng.chance(self.config.continuation);
        let towards = self.guided(&site, came);
        if goes_on {
            // Depth runs ahead: a continuation costs less than a branch, and that of a main road least.
            let step = [1.0, 0.6, 0.4][class as usize];
            self.push(steps + step / (1.0 + self.config.depth_bias), (start, &site), towards, class);
        } else {
            self.push_division(steps, (start, &site), towards);
        }
        let first = if self.rng.chance(0.5) { FRAC_PI_2 } else { -FRAC_PI_2 };
        let delay = if class == RoadClass::Highway { HIGHWAY_DELAY } else { 0.0 };
        for side in [first, -first] {
            if self.rng.chance(self.config.branching) {
                let class = self.class_of_branch(class);
                let cost = delay + self.rng.uniform(0.7, 1.2);
                let towards = self.guided(&site, came + side);
                self.push(steps + cost, (start, &site), towards, class);
            } else {
                let towards = self.guided(&site, came + side);
                self.push_division(steps, (start, &site), towards);
            }
        }
    }

    fn class_of_branch(&mut self, from: RoadClass) -> RoadClass {
        if self.fabric.walls() > 0 {
            return RoadClass::Local;
        }
        let main = match from {
            RoadClass::Highway => 0.5,
            RoadClass::Arterial => 0.2,
            RoadClass::Local => 0.02,
        };
        if self.rng.chance(main) { RoadClass::Arterial } else { RoadClass::Local }
    }

    /// A heading near a wish, drawn towards the grain of the place.
    fn guided(&mut self, site: &Site, wish: f64) -> f64 {
        let varied = self.config.heading_variation * bell(&mut self.rng);
        wish + site.turn_to_grain(wish) * self.config.order + varied.clamp(-0.7, 0.7)
    }

    /// Proposes a segment from a random junction into one of its gaps.
    fn revive(&mut self) {
        let node = self.rng.below(self.fabric.node_count()) as u32;
        if self.fabric.degree(node) == 0 {
            return;
        }
        let present = self.fabric.ways(node)[0];
        let quarter = self.rng.below(4) as f64 * FRAC_PI_2;
        let site = self.field.site(self.fabric.at(node));
        let towards = self.guided(&site, heading(&present) + quarter);
        self.push(0.0, (Start::Node(node), &site), towards, RoadClass::Local);
    }

    fn push(&mut self, steps: f64, from: (Start, &Site), heading: f64, class: RoadClass) {
        self.enqueue(steps, from, (heading, class), false);
    }

    /// Proposes a local street that is built only where it divides a large block.
    fn push_division(&mut self, steps: f64, from: (Start, &Site), heading: f64) {
        self.enqueue(steps + DIVISION_DELAY, from, (heading, RoadClass::Local), true);
    }

    fn enqueue(
        &mut self,
        steps: f64,
        (from, site): (Start, &Site),
        (heading, class): (f64, RoadClass),
        divides: bool,
    ) {
        let density = site.density;
        let spread = (self.config.length_variation * bell(&mut self.rng)).clamp(-0.75, 1.3);
        // What is far out, or where few live, waits, so that blocks close before the city spreads.
        let remoteness = site.remoteness / self.config.length * (1.25 - 0.5 * density);
        // Highways run ahead as far as the town will reach, not beyond.
        let in_town = site.remoteness < TOWN * self.field.radius();
        let waits = if class == RoadClass::Highway && in_town { 0.3 } else { 1.0 };
        let cost = steps + self.config.compactness * remoteness * waits;
        let with_grain = site.runs_along(heading);
        self.queue.push(cost, End { steps, heading, spread, density, from, class, with_grain, divides });
    }

    /// What an end would like to build.
    fn proposal(&self, end: &End) -> Proposal {
        let End { heading, from, class, .. } = *end;
        let stride = if class == RoadClass::Highway { HIGHWAY_STRIDE } else { 1.0 };
        // Blocks are longer along the grain than across it.
        let side = self.config.aspect.sqrt();
        let side = if end.with_grain { side } else { 1.0 / side };
        // Logarithms spread evenly: few long streets beside many short ones, longer where fewer live.
        let spread = simworld_core::ops::exp(end.spread);
        let wanted = self.config.length * stride * side * spread * breadth(end.density);
        // Nothing longer would be allowed; nor anything shorter, and without main roads there would be no city.
        let least = if class == RoadClass::Local { 0.0 } else { 1.01 * self.measures.least_length };
        let length = wanted.clamp(least, 0.99 * self.measures.most_length);
        let emptiness = if end.divides { 0.5 * self.config.widest_block * breadth(end.density) } else { 0.0 };
        Proposal { from, along: direction(heading), length, class, emptiness }
    }

    /// The segments that are streets still, in the order of their numbers in the plan.
    fn in_order(&self) -> Vec<u32> {
        let mut standing = Vec::with_capacity(self.standing);
        standing
            .extend((0..self.fabric.segments().len() as u32).filter(|index| self.fabric.is_standing(*index)));
        let middle = |index| self.fabric.start(Start::Middle(index));
        order::by_land(standing, self.field.radius(), self.config.length, middle)
    }

    /// The grown streets as a plan, some of them bent between their ends.
    fn plan(mut self, seed: Seed) -> StreetPlan {
        let (bends, curves, config) = (seed.stream("citygen/bends"), Curves::new(), self.config);
        let (mut plan, sections) = plan_of_sections(config);
        // What is not asked any more is given back at once: what follows takes its memory, and the system has less to clear.
        self.fabric.forget_what_is_near();
        let grown = self.numbered(&mut plan.nodes);
        drop(self);
        let street = |grown: &Grown| {
            let Grown { index, ends, class } = *grown;
            let mut rng = bends.indexed(u64::from(index)).rng();
            let bent = class != RoadClass::Highway && rng.chance(config.bends);
            let section = sections[class as usize];
            let reach = plan.sections[section as usize].left_of_reference();
            let [from, to] = ends.map(|end| end as usize);
            let straight = (class, plan.nodes[from], plan.nodes[to]);
            let via = if bent { course(config, &curves, straight, reach, &mut rng) } else { Vec::new() };
            Street { via, class, section, ..Street::simple(from, to) }
        };
        // A street is a function of its segment, and many are much to write: all threads write them.
        let mut streets = Vec::new();
        grown.par_iter().with_min_len(PART).map(street).collect_into_vec(&mut streets);
        plan.streets = streets;
        plan
    }

    /// The segments that are streets still, in their order; numbers their nodes.
    fn numbered(&self, nodes: &mut Vec<Point2>) -> Vec<Grown> {
        // Some were taken away again: room for these costs nothing, and to move all to where there is more takes long.
        nodes.reserve(self.fabric.node_count());
        let mut numbers = vec![u32::MAX; self.fabric.node_count()];
        let number = |index: u32| {
            let segment = self.fabric.segment(index);
            let ends = [(segment.from, segment.a), (segment.to, segment.b)].map(|(node, at)| {
                let number = &mut numbers[node as usize];
                if *number == u32::MAX {
                    *number = nodes.len() as u32;
                    nodes.push(at);
                }
                *number
            });
            Grown { index, ends, class: segment.class }
        };
        self.in_order().into_iter().map(number).collect()
    }
}

/// A bent course of a street of a class from one place to another that reaches so far to its left.
fn course(
    config: &RoadConfig,
    curves: &Curves,
    (class, from, to): (RoadClass, Point2, Point2),
    reach: f64,
    rng: &mut StreamRng,
) -> Vec<Point2> {
    // So that its inner sidewalk is a bend still, not a knot, and vehicles come round it.
    let radius = bend::least_radius(class).max(2.0 * reach);
    bend::course(curves, from, to, config.bow, BOW_LIMIT * config.length, radius, rng)
}

/// A grown segment that is to be a street, and the numbers of its nodes in the plan.
#[derive(Clone, Copy, Debug)]
struct Grown {
    index: u32,
    ends: [u32; 2],
    class: RoadClass,
}

/// Streets that one thread writes at once, at the least.
const PART: usize = 1024;

/// A plan without streets, and its cross-sections of local streets, arterials and highways.
pub(crate) fn plan_of_sections(config: &RoadConfig) -> (StreetPlan, [u32; 3]) {
    let local = section(config, 1).with_parking(config.parking_width);
    let mut plan = StreetPlan { sections: vec![local], ..StreetPlan::default() };
    let arterial = section(config, config.arterial_lanes)
        .with_median(config.arterial_median_width)
        .with_cycle_lanes(config.arterial_cycle_width)
        .with_parking(config.arterial_parking_width);
    let arterial = plan.add_section(arterial);
    let highway = plan.add_section(section(config, 2).with_median(HIGHWAY_MEDIAN));
    (plan, [0, arterial, highway])
}

fn section(config: &RoadConfig, lanes: u8) -> CrossSection {
    CrossSection::plain(lanes, lanes, config.lane_width, config.sidewalk_width)
}

/// Width of the median of a highway, m: a barrier with room beside it.
const HIGHWAY_MEDIAN: f64 = 1.5;

/// A draw with mean 0 and standard deviation 1, nearly normal: the sum of four even ones, from one number of the stream.
fn bell(rng: &mut StreamRng) -> f64 {
    let bits = rng.bits();
    let parts = [bits, bits >> 16, bits >> 32, bits >> 48].map(|part| i32::from(part as u16 as i16));
    // Each is even over [-2¹⁵, 2¹⁵), of variance 2³² / 12, and half a unit below the middle.
    f64::from(parts.into_iter().sum::<i32>() + 2) * (3.0_f64.sqrt() / 65_536.0)
}

/// Streets are longer and blocks wider where fewer live; 1 in the middle of the range.
fn breadth(density: f64) -> f64 {
    1.6 - 1.15 * density
}

/// No bow is higher than this share of the mean length: two that face each other still leave a street's width.
const BOW_LIMIT: f64 = 0.11;
