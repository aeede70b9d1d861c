//! Growth within walls: the streets of one superblock, from the gates in its main streets inwards.
//!
//! What grows depends on the walls, the configuration and two seeds alone: that of the fields, which all superblocks share,
//! and its own.

use std::f64::consts::FRAC_PI_2;

use simworld_core::geometry::{Point2, bounds, heading};
use simworld_core::net::{RoadClass, Street};
use simworld_core::seed::Seed;

use super::bend::Curves;
use super::fabric::Fabric;
use super::field::Field;
use super::fitted::Start;
use super::proposal::{Fitter, Measures};
use super::queue::Queue;
use super::{Growth, ROUNDS, course, plan_of_sections};
use crate::RoadConfig;

/// Attempts to revive growth for each node of the wall where hardly anything grew; elsewhere what is left over stays open.
const REVIVALS: u32 = 8;
/// Cost by which ends at gates are spread, so that no gate is always first.
const SPREAD: f64 = 1.0;

/// A corner or a gate of a wall.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gate {
    /// Where it is, m.
    pub(crate) at: Point2,
    /// Whether a street may lead in from it.
    pub(crate) is_open: bool,
}

/// The streets within a wall.
#[derive(Clone, Debug, Default)]
pub(crate) struct Within {
    /// The nodes of the wall, then the junctions within, m.
    pub(crate) nodes: Vec<Point2>,
    /// The streets within: none of the wall. Their cross-section is that of local streets.
    pub(crate) streets: Vec<Street>,
}

/// What is the same for the streets within all walls.
#[derive(Clone, Debug)]
pub(crate) struct Soil {
    field: Field,
    curves: Curves,
    /// What streets are fitted with: its memory is kept from one wall to the next.
    fitter: Fitter,
    /// How far a local street reaches to its left, m.
    reach: f64,
}

impl Soil {
    /// That of a configuration and of a seed, by which the land is what it is.
    pub(crate) fn new(config: &RoadConfig, fields: Seed) -> Self {
        let reach = plan_of_sections(config).0.sections[0].left_of_reference();
        Self {
            field: Field::endless(config, fields),
            curves: Curves::new(),
            fitter: Fitter::default(),
            reach,
        }
    }
}

/// Grows streets within a wall, counter-clockwise; `own` seeds all choices.
pub(crate) fn grow_within(wall: &[Gate], config: &RoadConfig, soil: &mut Soil, own: Seed) -> Within {
    let Soil { field, curves, fitter, reach } = soil;
    let mut growth = Growth::within(wall, config, (field, fitter), own);
    growth.open_gates(wall);
    growth.run();
    if growth.standing < wall.len() / 4 {
        growth.revivals = REVIVALS * wall.len() as u32;
    }
    for _ in 0..ROUNDS {
        growth.run();
        let before = growth.standing;
        growth.attach_loose_ends();
        growth.prune();
        if growth.revivals == 0 || growth.standing >= before {
            break;
        }
    }
    growth.inside(curves, *reach, own)
}

impl<'a> Growth<'a> {
    fn within(
        wall: &[Gate],
        config: &'a RoadConfig,
        (field, fitter): (&'a mut Field, &'a mut Fitter),
        own: Seed,
    ) -> Self {
        let (low, high) = bounds(wall.iter().map(|gate| &gate.at)).unwrap_or_default();
        let reach = (high - low).norm() * 0.5 + 2.0 * config.length;
        let mut fabric = Fabric::around(nalgebra::center(&low, &high), reach, config.length, 6 * wall.len());
        // Two streets are the wall's own; the third leads in.
        let corners = wall.iter().map(|gate| (gate.at, if gate.is_open { 3 } else { 2 }));
        fabric.wall_in(corners, RoadClass::Arterial);
        Self {
            config,
            measures: Measures::new(config),
            field,
            fabric,
            fitter,
            // What is near is all there is: costs are told apart finely.
            queue: Queue::new(32.0),
            revivals: 0,
            standing: 0,
            wanted: usize::MAX,
            rng: own.stream("citygen/roads").rng(),
        }
    }

    /// Proposes a street inwards from every gate.
    fn open_gates(&mut self, wall: &[Gate]) {
        let count = wall.len();
        for index in (0..count).filter(|index| wall[*index].is_open) {
            let chord = wall[(index + 1) % count].at - wall[(index + count - 1) % count].at;
            let inwards = heading(&chord) + FRAC_PI_2;
            let site = self.field.site(wall[index].at);
            let start = Start::Node(index as u32);
            let cost = self.rng.uniform(0.0, SPREAD);
            let led = self.guided(&site, inwards);
            self.push(cost, (start, &site), led, RoadClass::Local);
            // Where the grain leads it into the wall, it goes straight in.
            self.push(cost + SPREAD, (start, &site), inwards, RoadClass::Local);
        }
    }

    /// The streets that stand within the wall, some of them bent.
    fn inside(&self, curves: &Curves, reach: f64, own: Seed) -> Within {
        let bends = own.stream("citygen/bends");
        let walls = self.fabric.walls();
        // With room for the streets of the wall, which stand beside them while dead ends are given room to turn.
        let mut within = Within {
            nodes: Vec::with_capacity(walls + self.standing),
            streets: Vec::with_capacity(walls + self.standing),
        };
        within.nodes.extend((0..walls as u32).map(|node| self.fabric.at(node)));
        let mut numbers = vec![u32::MAX; self.fabric.node_count()];
        for (node, number) in (0..).zip(numbers.iter_mut().take(walls)) {
            *number = node;
        }
        for index in
            (walls..self.fabric.segments().len()).filter(|index| self.fabric.is_standing(*index as u32))
        {
            let segment = self.fabric.segment(index as u32);
            let [from, to] = [(segment.from, segment.a), (segment.to, segment.b)].map(|(node, at)| {
                let number = &mut numbers[node as usize];
                if *number == u32::MAX {
                    *number = within.nodes.len() as u32;
                    within.nodes.push(at);
                }
                *number as usize
            });
            let mut rng = bends.indexed(index as u64).rng();
            let via = if rng.chance(self.config.bends) {
                course(self.config, curves, (segment.class, segment.a, segment.b), reach, &mut rng)
            } else {
                Vec::new()
            };
            within.streets.push(Street { via, ..Street::simple(from, to) });
        }
        within
    }
}
