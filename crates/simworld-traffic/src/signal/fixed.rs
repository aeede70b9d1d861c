//! Fixed time: the plan by the clock, plans timed after Webster, and green waves.

use simworld_core::id::IntersectionId;
use simworld_core::net::{RoadNetwork, SignalGroup, SignalPlan, polyline};

use super::stage::stages;
use super::{JunctionView, SignalPolicy, Stage};
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

    fn keeps(&self, junction: &JunctionView<'_>) -> f64 {
        let plan = junction.plan;
        phase_at(plan, junction.seconds).map_or(0.0, |(phase, elapsed)| plan.phases[phase].duration - elapsed)
    }
}

/// Webster's timing of a fixed plan (Webster 1958, Road Research Technical Paper 39).
///
/// The cycle is `(1.5 L + 5) / (1 - Y)` with the lost time `L` of a cycle and the sum `Y` over the stages of the critical
/// flow ratio of each, that of its busiest lane; the effective green is shared in proportion to these ratios.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Webster {
    /// Flow of a lane that discharges a queue, veh/s.
    pub saturation_flow: f64,
    /// Time that a stage loses while its queue starts and in the part of the yellow that nobody uses, s; the all-red comes on
    /// top of it.
    pub lost_time: f64,
    /// Shortest and longest cycle, s.
    pub cycle: (f64, f64),
}

impl Default for Webster {
    /// The standard saturation flow of the Highway Capacity Manual, 1900 veh/h. The lost time is what the drivers of
    /// [`standard_types`](crate::vehicle::standard_types) lose after a yellow of 3 s, as `--example validate` measures it: their
    /// headways settle by the tenth in line, not by the fourth as in the manual, which reckons with 3 s.
    fn default() -> Self {
        Self { saturation_flow: 1900.0 / 3600.0, lost_time: 5.5, cycle: (30.0, 120.0) }
    }
}

impl Webster {
    /// A plan timed for the flow of the busiest lane at each group, veh/s, in the order of the plan's groups; zero, or nothing at
    /// the end, for groups of people, who walk beside the vehicles and ask for no green of their own. A flow that is negative or
    /// not a number counts as none.
    ///
    /// ```
    /// use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
    /// use simworld_traffic::signal::Webster;
    /// let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default())?;
    /// let plan = &network.signals[0];
    /// // Twice as many come by the first and the third leg as by the others; the groups after these four are of people.
    /// let timed = Webster::default().retime(plan, &[0.16, 0.08, 0.16, 0.08]);
    /// let greens: Vec<f64> = timed.phases.iter().filter(|p| p.yellow.is_empty() && !p.green.is_empty())
    ///     .map(|p| p.duration).collect();
    /// assert!(greens[0] > greens[1]);
    /// # Ok::<(), simworld_core::net::NetworkError>(())
    /// ```
    pub fn retime(&self, plan: &SignalPlan, flows: &[f64]) -> SignalPlan {
        let stages = stages(plan);
        let ratios: Vec<f64> = stages.iter().map(|stage| self.ratio(plan, stage, flows)).collect();
        let lost: f64 = stages.iter().map(|stage| self.lost_time + all_red(plan, stage)).sum();
        let sum: f64 = ratios.iter().sum();
        let cycle = ((1.5 * lost + 5.0) / (1.0 - sum.min(0.95))).clamp(self.cycle.0, self.cycle.1);
        let mut timed = plan.clone();
        for (stage, ratio) in stages.iter().zip(&ratios) {
            // Of its green, clearance and yellow a stage loses the lost time.
            let shown = (cycle - lost) * ratio / sum + self.lost_time;
            let ending: f64 = stage.ending.iter().map(|phase| plan.phases[*phase].duration).sum();
            let green = shown - (ending - all_red(plan, stage));
            timed.phases[stage.phase].duration = green.max(stage.least_green);
        }
        timed
    }

    /// The critical flow ratio of a stage; a stage that nobody asks for has a little.
    fn ratio(&self, plan: &SignalPlan, stage: &Stage, flows: &[f64]) -> f64 {
        let flow = |group: &SignalGroup| {
            let index = plan.groups.iter().position(|own| own == group);
            index.and_then(|index| flows.get(index)).copied().unwrap_or(0.0)
        };
        stage.green.iter().map(|group| flow(group) / self.saturation_flow).fold(0.01, f64::max)
    }
}

/// How long everybody has red at the end of a stage, s.
fn all_red(plan: &SignalPlan, stage: &Stage) -> f64 {
    let ending = stage.ending.iter().map(|phase| &plan.phases[*phase]);
    ending.filter(|phase| phase.green.is_empty() && phase.yellow.is_empty()).map(|phase| phase.duration).sum()
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

#[cfg(test)]
mod tests {
    use simworld_core::net::Phase;

    use super::*;

    /// Three stages of vehicles alone, as plans of other simulators have them, with 3 s of yellow and 2 s of all-red after each.
    fn plan() -> SignalPlan {
        let groups: Vec<SignalGroup> = (7..10).map(SignalGroup).collect();
        let phase = |duration, green: &[SignalGroup], yellow: &[SignalGroup]| Phase {
            duration,
            green: green.into(),
            yellow: yellow.into(),
        };
        let stage = |group: &SignalGroup| {
            let own = [*group];
            [phase(20.0, &own, &[]), phase(3.0, &[], &own), phase(2.0, &[], &[])]
        };
        let phases = groups.iter().flat_map(stage).collect();
        SignalPlan { intersection: IntersectionId(0), groups, offset: 0.0, phases }
    }

    #[test]
    fn every_group_counts_for_its_stage() {
        let webster = Webster { saturation_flow: 0.5, lost_time: 4.0, cycle: (10.0, 500.0) };
        let timed = webster.retime(&plan(), &[0.05, 0.1, 0.15]);
        // L = 3 (4 + 2) s and Y = 0.1 + 0.2 + 0.3.
        assert!((timed.cycle() - (1.5 * 18.0 + 5.0) / 0.4).abs() < 1e-9, "{}", timed.cycle());
        let effective: Vec<f64> = (0..3).map(|stage| timed.phases[3 * stage].duration + 3.0 - 4.0).collect();
        assert!((effective[1] / effective[0] - 2.0).abs() < 1e-9, "{effective:?}");
        assert!((effective[2] / effective[0] - 3.0).abs() < 1e-9, "{effective:?}");
    }

    #[test]
    fn no_flow_makes_a_plan_that_cannot_be() {
        for flows in [&[][..], &[f64::NAN, -3.0, f64::INFINITY], &[9.0, 9.0, 9.0]] {
            let timed = Webster::default().retime(&plan(), flows);
            let sound = timed.phases.iter().all(|phase| phase.duration.is_finite() && phase.duration > 0.0);
            assert!(sound && timed.cycle() < 200.0, "{flows:?} {timed:?}");
        }
    }
}
