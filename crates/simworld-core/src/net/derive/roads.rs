//! Roads with what runs along them from junction to junction: their lanes and sidewalks.

use super::ends::Ends;
use super::legs::Legs;
use super::workers::{self, PART, Workers};
use super::{NetworkConfig, ends, lanes, road, walkways};
use crate::geometry::Point2;
use crate::id::{RoadId, SidewalkId};
use crate::net::polyline::Measured;
use crate::net::{Lane, Road, RoadNetwork, Side, Sidewalk, StreetPlan};

/// How much of a street its junctions take at one of its ends, m.
#[derive(Clone, Copy, Default)]
struct Cut {
    /// Up to where its lanes end.
    stop: f64,
    /// Up to where its sidewalks end.
    walk: f64,
}

/// Some roads that follow one another. Their lanes and sidewalks have numbers from zero on.
#[derive(Default)]
struct Stretch {
    roads: Vec<Road>,
    lanes: Vec<Lane>,
    ends: Vec<Ends>,
    sidewalks: Vec<Sidewalk>,
    /// The middle of the street at hand: the memory of the work at one, kept for the next.
    middle: Vec<Point2>,
}

/// Adds the road of every street with its lanes and sidewalks; gives the ends of all lanes.
pub(super) fn add(
    network: &mut RoadNetwork,
    plan: &StreetPlan,
    legs: &Legs,
    config: &NetworkConfig,
    workers: &dyn Workers,
) -> Vec<Ends> {
    let streets = plan.streets.len();
    let mut cuts = vec![[Cut::default(); 2]; streets];
    for leg in legs.all() {
        cuts[leg.street][usize::from(!leg.at_start)] = Cut { stop: leg.stop, walk: leg.walk };
    }
    let laid: Vec<usize> = plan.sections.iter().map(lanes::count).collect();
    let made = workers::collect(workers, streets.div_ceil(PART), |part| {
        let own = part * PART..streets.min((part + 1) * PART);
        // The first part stays where it is and takes in the others: it has room for all.
        let housed = if part == 0 { &plan.streets[..] } else { &plan.streets[own.clone()] };
        let lanes = housed.iter().map(|street| laid[street.section as usize]).sum();
        let mut stretch = Stretch::with_capacity(housed.len(), lanes);
        for street in own {
            stretch.add(plan, street, cuts[street], config);
        }
        stretch
    });
    let lanes = made.iter().map(|stretch| stretch.lanes.len()).sum();
    let sidewalks = made.iter().map(|stretch| stretch.sidewalks.len()).sum();
    let mut ends = Vec::new();
    for stretch in made {
        stretch.append_to(network, &mut ends, [streets, lanes, sidewalks]);
    }
    ends
}

impl Stretch {
    /// With room for so many roads and lanes.
    fn with_capacity(roads: usize, lanes: usize) -> Self {
        Self {
            roads: Vec::with_capacity(roads),
            lanes: Vec::with_capacity(lanes),
            ends: Vec::with_capacity(lanes),
            sidewalks: Vec::with_capacity(2 * roads),
            middle: Vec::new(),
        }
    }

    /// Adds the road of a street.
    fn add(&mut self, plan: &StreetPlan, street: usize, [start, end]: [Cut; 2], config: &NetworkConfig) {
        let Self { roads, lanes, ends, sidewalks, middle } = self;
        let mut road = road(plan, &plan.streets[street]);
        let id = RoadId::from_index(street);
        let centerline = std::mem::take(&mut road.centerline);
        let line = Measured::new(&centerline);
        let stations = (start.stop, line.length() - end.stop);
        line.slice_into(stations.0, stations.1, middle);
        let first = lanes.len();
        lanes::lay(lanes, (id, &mut road), (plan, config), middle, stations);
        ends.extend(lanes[first..].iter().map(ends::of));
        line.slice_into(start.walk, line.length() - end.walk, middle);
        for sidewalk in walkways::sidewalks(plan, id, middle).into_iter().flatten() {
            let number = SidewalkId::from_index(sidewalks.len());
            road.sidewalks[usize::from(sidewalk.side == Side::Right)] = Some(number);
            sidewalks.push(sidewalk);
        }
        road.centerline = centerline;
        roads.push(road);
    }

    /// Adds all to a network that is to have so many roads, lanes and sidewalks, with the numbers that they have there.
    fn append_to(mut self, network: &mut RoadNetwork, ends: &mut Vec<Ends>, counts: [usize; 3]) {
        let [streets, of_lanes, of_sidewalks] = counts;
        let (lanes, sidewalks) = (network.lanes.len() as u32, network.sidewalks.len() as u32);
        for road in &mut self.roads {
            let own = road.forward.iter_mut().chain(&mut road.backward).chain(&mut road.cycle);
            own.for_each(|lane| lane.0 += lanes);
            road.sidewalks.iter_mut().flatten().for_each(|sidewalk| sidewalk.0 += sidewalks);
        }
        workers::take_over(&mut network.roads, self.roads, streets);
        workers::take_over(&mut network.lanes, self.lanes, of_lanes);
        workers::take_over(&mut network.sidewalks, self.sidewalks, of_sidewalks);
        workers::take_over(ends, self.ends, of_lanes);
    }
}
