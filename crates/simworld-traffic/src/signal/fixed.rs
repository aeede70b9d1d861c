//! Fixed time: the plan by the clock, plans timed after Webster, and green waves.

use simworld_core::id::IntersectionId;
use simworld_core::net::{RoadNetwork, SignalPlan, polyline};

use super::stage::stages;
use super::{JunctionView, SignalPolicy};
use crate::signal::controller::phase_at;

/// The plan's own phases by the clock, one after the other.
#[derive(Clone, Copy, Debug, Default)]
pub struct FixedTime;

impl SignalPolicy for FixedTime {
    fn next_stage(&mut self, junction: &JunctionView<'_>) -> usize {
        match phase_at(junction.plan, junction.seconds) {
            Some((phase, _)) if phase != junction.stages[junction.current].phase => junction.successor(),
            _ => junction.current,
        }
    }

    fn watches(&self) -> bool {
        false
    }
}

/// Webster's timing of a fixed plan (Webster 1958, Road Research Technical Paper 39).
///
/// The cycle is `(1.5 L + 5) / (1 - Y)` with the lost time `L` of a cycle and the sum `Y` over the stages of the largest
/// flow ratio of each; the green is shared in proportion to the ratios.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Webster {
    /// Flow of a lane that discharges a queue, veh/s.
    pub saturation_flow: f64,
    /// Time that a stage loses at its start and during its yellow, s.
    pub lost_time: f64,
    /// Shortest and longest cycle, s.
    pub cycle: (f64, f64),
}

impl Default for Webster {
    /// The standard saturation flow of the Highway Capacity Manual, 1900 veh/h, and its start-up loss of 2 s.
    fn default() -> Self {
        Self { saturation_flow: 1900.0 / 3600.0, lost_time: 2.0, cycle: (30.0, 120.0) }
    }
}

impl Webster {
    /// A plan timed for the flow of its busiest lane at each group, veh/s, in the order of the plan's groups.
    ///
    /// ```
    /// use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
    /// use simworld_traffic::signal::Webster;
    /// let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default())?;
    /// let plan = &network.signals[0];
    /// // Twice as many come from east and west as from north and south.
    /// let flows: Vec<f64> = (0..plan.groups.len()).map(|leg| if leg % 2 == 0 { 0.16 } else { 0.08 }).collect();
    /// let timed = Webster::default().retime(plan, &flows);
    /// let greens: Vec<f64> = timed.phases.iter().filter(|p| p.yellow.is_empty() && !p.green.is_empty())
    ///     .map(|p| p.duration).collect();
    /// assert!(greens[0] > greens[1]);
    /// # Ok::<(), simworld_core::net::NetworkError>(())
    /// ```
    pub fn retime(&self, plan: &SignalPlan, flows: &[f64]) -> SignalPlan {
        let stages = stages(plan);
        let vehicles = plan.groups.len() / 2;
        let ratio = |stage: &super::Stage| {
            let of_group = |group| {
                // Groups of pedestrians come after those of vehicles and ask for no green of their own.
                let index = plan.groups.iter().position(|own| own == group).filter(|index| *index < vehicles);
                index.and_then(|index| flows.get(index)).map_or(0.0, |flow| flow / self.saturation_flow)
            };
            stage.green.iter().map(of_group).fold(0.0, f64::max)
        };
        let ratios: Vec<f64> = stages.iter().map(|stage| ratio(stage).max(0.01)).collect();
        let interval =
            |stage: &super::Stage| stage.ending.iter().map(|phase| plan.phases[*phase].duration).sum::<f64>();
        // A driver uses the clearance as green and most of the yellow; what is lost is start-up and all-red.
        let lost: f64 = stages
            .iter()
            .map(|stage| {
                let red = stage.ending.iter().map(|phase| &plan.phases[*phase]);
                let all_red: f64 = red
                    .filter(|phase| phase.green.is_empty() && phase.yellow.is_empty())
                    .map(|p| p.duration)
                    .sum();
                self.lost_time + all_red
            })
            .sum();
        let load = ratios.iter().sum::<f64>().min(0.95);
        let cycle = ((1.5 * lost + 5.0) / (1.0 - load)).clamp(self.cycle.0, self.cycle.1);
        let mut timed = plan.clone();
        let sum: f64 = ratios.iter().sum();
        for (stage, ratio) in stages.iter().zip(&ratios) {
            let effective = (cycle - lost) * ratio / sum + self.lost_time;
            let all_red = interval(stage)
                - stage
                    .ending
                    .iter()
                    .map(|phase| &plan.phases[*phase])
                    .filter(|p| p.green.is_empty() && p.yellow.is_empty())
                    .map(|p| p.duration)
                    .sum::<f64>();
            timed.phases[stage.phase].duration = (effective - all_red).max(stage.least_green);
        }
        timed
    }
}

/// Sets the offsets of the plans along a way so that who drives it at `speed` m/s meets the beginning of every green.
///
/// The way is a chain of neighbouring intersections; those without a plan, and plans whose cycle differs from that of
/// the first, keep their offsets. Returns how many plans are now in the wave.
pub fn green_wave(
    network: &RoadNetwork,
    way: &[IntersectionId],
    speed: f64,
    plans: &mut [SignalPlan],
) -> usize {
    let mut distance = 0.0;
    let mut cycle = None;
    let mut tuned = 0;
    for pair in way.windows(2) {
        let Some(road) = network.roads.iter().position(|road| {
            (road.from == pair[0] && road.to == pair[1]) || (road.from == pair[1] && road.to == pair[0])
        }) else {
            break;
        };
        distance += polyline::length(&network.roads[road].centerline);
        let Some(plan) = plans.iter_mut().find(|plan| plan.intersection == pair[1]) else { continue };
        let whole = plan.cycle();
        if cycle.is_some_and(|cycle: f64| (cycle - whole).abs() > 1e-6) {
            continue;
        }
        let intersection = &network.intersections[pair[1].index()];
        let lanes = &network.roads[road];
        let into = if lanes.to == pair[1] { &lanes.forward } else { &lanes.backward };
        let group = intersection
            .connections
            .iter()
            .map(|id| &network.connections[id.index()])
            .find(|connection| into.contains(&connection.from))
            .and_then(|connection| connection.signal);
        let Some(group) = group else { continue };
        let mut begins = 0.0;
        for phase in &plan.phases {
            if phase.green.contains(&group) {
                break;
            }
            begins += phase.duration;
        }
        // The clock shows `seconds + offset`; at `distance / speed` it is to show the beginning of the green.
        plan.offset = (begins - distance / speed).rem_euclid(whole);
        cycle = Some(whole);
        tuned += 1;
    }
    tuned
}
