//! Control delay at a fixed signal, and the cycle that makes it least.
//!
//! Control delay is all that the signal costs: braking, the queue, and pulling away until the speed is regained (Highway
//! Capacity Manual). It is therefore measured at a line behind the junction where a driver who started at the stop line has
//! nine tenths of his speed again: the time at which a vehicle passes there, less the time at which it would with the signal
//! always green; arrivals are the same in both runs.

use simworld_core::net::Turn;
use simworld_core::ops;

use super::discharge::Discharge;
use super::streets::{CAR, Line, Signalised, StopLine, across, inner_lane, mean};
use super::{Effort, Figure, Figures, ValidationError};
use crate::signal::Webster;
use crate::vehicle::Idm;
use crate::{Arrivals, Flow, Traffic};

const DT: f64 = 0.1;
/// Time before delays count, s.
const WARM_UP: f64 = 600.0;
/// A signal that nobody sees red.
const ALWAYS: f64 = 1e7;

/// A fixed signal with what its queue can do.
struct Capacity {
    cycle: f64,
    /// Effective share of green.
    share: f64,
    /// veh/s.
    saturation: f64,
}

impl Capacity {
    /// Counts a queue that never ends, at greens that differ by up to half a headway either way: whole cars pass, and the
    /// mean of their numbers is the share of green without rounding.
    fn of(red: f64, green: f64, saturation: f64) -> Result<Self, ValidationError> {
        const PARTS: u32 = 10;
        let Signalised { cycle, .. } = Signalised::new(red, green, 1)?;
        let counts: Result<Vec<f64>, ValidationError> = (0..PARTS)
            .map(|part| {
                let off = (f64::from(part) + 0.5) / f64::from(PARTS) - 0.5;
                passing_a_green(red, green + off / saturation)
            })
            .collect();
        Ok(Self { cycle, share: mean(counts?) / saturation / cycle, saturation })
    }

    /// Flow that loads it so far, veh/s.
    fn flow(&self, load: f64) -> f64 {
        load * self.share * self.saturation
    }

    /// Webster's uniform delay, s.
    fn uniform(&self, load: f64) -> f64 {
        let red = 1.0 - self.share;
        0.5 * self.cycle * red * red / (1.0 - load.min(1.0) * self.share)
    }

    /// What random arrivals add (Webster 1958, with his correction), s.
    fn random(&self, load: f64) -> f64 {
        let flow = self.flow(load);
        let correction =
            ops::pow(self.cycle / (flow * flow), 1.0 / 3.0) * ops::pow(load, 2.0 + 5.0 * self.share);
        load * load / (2.0 * flow * (1.0 - load)) - 0.65 * correction
    }
}

/// How many of a queue that never ends pass a green.
fn passing_a_green(red: f64, green: f64) -> Result<f64, ValidationError> {
    const CYCLES: f64 = 4.0;
    let Signalised { mut traffic, cycle, .. } = Signalised::new(red, green, 1)?;
    for _ in 0..(CYCLES + 3.0) as usize * ((green / 1.8) as usize + 4) {
        traffic.insert(across(0, 2), CAR)?;
    }
    let mut line = StopLine::new(inner_lane(&traffic, 0));
    let (from, until) = (cycle, (1.0 + CYCLES) * cycle);
    while traffic.seconds() < until {
        traffic.step(DT);
        line.look(&traffic);
    }
    Ok(line.passed.iter().filter(|pass| (from..until).contains(&pass.1)).count() as f64 / CYCLES)
}

/// How far from the stop line a driver who stood there has nine tenths of his speed, m: the way on a free road, by the
/// model, is v0² artanh((v / v0)²) / (2 a).
fn way_to_speed(idm: &Idm) -> f64 {
    let square: f64 = 0.9 * 0.9;
    let artanh = 0.5 * ops::ln((1.0 + square) / (1.0 - square));
    idm.desired_speed * idm.desired_speed * artanh / (2.0 * idm.acceleration)
}

/// The line behind the junction at which delays are taken, for those who go straight on from the first arm.
fn line_behind(traffic: &Traffic) -> Result<Line, ValidationError> {
    let network = traffic.network();
    let own = &network.lanes[inner_lane(traffic, 0).index()];
    let ways = own.outgoing.iter().map(|way| &network.connections[way.index()]);
    let straight = ways.into_iter().find(|way| way.turn == Turn::Straight);
    let way = straight.ok_or_else(|| ValidationError::Nothing {
        measure: "fixed signal",
        reason: "nobody can go straight on".to_owned(),
    })?;
    Ok(Line::new(way.to, way_to_speed(&Idm::default()) - way.length))
}

/// Mean time from when a vehicle was due to when it has passed the junction, s.
fn mean_passage(
    mut traffic: Traffic,
    flow: f64,
    arrivals: Arrivals,
    seconds: f64,
) -> Result<f64, ValidationError> {
    let flow = Flow { arrivals, kind: Some(CAR), ..Flow::new(across(0, 2), flow * 3600.0) };
    traffic.add_flow(flow)?;
    let mut line = line_behind(&traffic)?;
    let (mut sum, mut count) = (0.0, 0.0);
    while traffic.seconds() < seconds {
        traffic.step(DT);
        line.look(&traffic);
        for trip in traffic.ended() {
            let Some(rank) = line.passed.iter().position(|pass| pass.0 == trip.id) else { continue };
            let (_, passed) = line.passed.remove(rank);
            if trip.scheduled > WARM_UP {
                sum += passed - trip.scheduled;
                count += 1.0;
            }
        }
    }
    Ok(sum / count)
}

/// Control delay of a flow, s.
fn control_delay(
    (red, green): (f64, f64),
    flow: f64,
    arrivals: Arrivals,
    seconds: f64,
    seed: u64,
) -> Result<f64, ValidationError> {
    let with = mean_passage(Signalised::new(red, green, seed)?.traffic, flow, arrivals, seconds)?;
    let mut free = Signalised::new(red, green, seed)?.traffic;
    let mut plans = free.plans().to_vec();
    let lane = inner_lane(&free, 0);
    let ours = super::streets::signal_of(&free, lane).unwrap_or_default();
    let mut begins = 0.0;
    for phase in &mut plans[0].phases {
        if phase.green.iter().any(|group| group.index() == ours) {
            phase.duration = ALWAYS;
            break;
        }
        begins += phase.duration;
    }
    plans[0].offset = begins;
    free.set_plans(plans)?;
    Ok(with - mean_passage(free, flow, arrivals, seconds)?)
}

pub(super) fn fixed_signal(effort: Effort) -> Figures {
    let saturation = Discharge::at_step(DT)?.flow / 3600.0;
    let mut figures = Vec::new();
    let settings: &[(f64, f64)] = effort.pick(&[(43.0, 37.0)], &[(43.0, 37.0), (58.0, 32.0), (33.0, 57.0)]);
    for (red, green) in settings {
        let signal = Capacity::of(*red, *green, saturation)?;
        figures.push(lost_time(&signal, (*red, *green)));
        for load in [0.4, 0.6, 0.8, 0.9] {
            let found = control_delay((*red, *green), signal.flow(load), Arrivals::Uniform, 4800.0, 1)?;
            let name = format!("delay, red {red} s of {:.0} s, load {load}, even arrivals", signal.cycle);
            let source =
                "d1 = 0.5 C (1 - λ)² / (1 - min(1, x) λ), Webster 1958 and the Highway Capacity Manual";
            figures.push(Figure::near(name, found, signal.uniform(load), 0.05, "s").cited(source));
        }
    }
    let (red, green) = settings[0];
    let signal = Capacity::of(red, green, saturation)?;
    for load in [0.5, 0.7, 0.85] {
        let seeds = effort.pick(4, 20);
        let delays: Result<Vec<f64>, ValidationError> = (1..=seeds)
            .map(|seed| control_delay((red, green), signal.flow(load), Arrivals::Poisson, 4200.0, seed))
            .collect();
        let name = format!(
            "delay, red {red} s of {:.0} s, load {load}, random arrivals, {seeds} seeds",
            signal.cycle
        );
        let expected = signal.uniform(load) + signal.random(load);
        let source = "d1 + x² / (2 q (1 - x)) - 0.65 (C / q²)^(1/3) x^(2 + 5 λ), Webster 1958";
        // Twenty seeds are needed for ten per cent; few are taken at every change.
        let share = effort.pick(0.25, 0.1);
        figures.push(Figure::near(name, mean(delays?), expected, share, "s").cited(source));
    }
    Ok(figures)
}

/// What a stage loses at its start and in its yellow, s, beside what the timing after Webster reckons with.
fn lost_time(signal: &Capacity, (red, green): (f64, f64)) -> Figure {
    let lost = signal.cycle - red - signal.share * signal.cycle;
    let expected = Webster::default().lost_time;
    let name = format!("time lost of {green} s of green and {:.0} s of yellow", signal.cycle - red - green);
    let source = "Webster::default, by which plans are timed";
    Figure::within(name, lost, (expected - 0.5, expected + 0.5), "s").cited(source)
}

/// Mean delay of all trips across a crossroads, s, with two flows that cross and a cycle of so long.
fn delay_at_cycle(flows: [f64; 2], cycle: f64, seed: u64) -> Result<f64, ValidationError> {
    let Signalised { mut traffic, .. } = Signalised::new(40.0, 40.0, seed)?;
    let timing = Webster { cycle: (cycle, cycle), ..Webster::default() };
    retime(&mut traffic, timing, flows)?;
    for (route, flow) in [(across(0, 2), flows[0]), (across(1, 3), flows[1])] {
        traffic.add_flow(Flow { kind: Some(CAR), ..Flow::new(route, flow * 3600.0) })?;
    }
    let mut delays = Vec::new();
    while traffic.seconds() < 5400.0 {
        traffic.step(DT);
        let late = traffic.ended().iter().filter(|trip| trip.scheduled > WARM_UP);
        delays.extend(late.map(|trip| trip.delay() + trip.entered - trip.scheduled));
    }
    Ok(mean(delays))
}

/// Times the plan of the crossroads and returns its cycle, s.
fn retime(traffic: &mut Traffic, timing: Webster, flows: [f64; 2]) -> Result<f64, ValidationError> {
    let plan = traffic.plans()[0].clone();
    let arm = |arm| super::streets::signal_of(traffic, inner_lane(traffic, arm));
    let (first, second) = (arm(0), arm(1));
    let flow = |group: usize| match Some(group) {
        own if own == first => flows[0],
        own if own == second => flows[1],
        _ => 0.0,
    };
    let flows: Vec<f64> = plan.groups.iter().map(|group| flow(group.index())).collect();
    let timed = timing.retime(&plan, &flows);
    let cycle = timed.cycle();
    traffic.set_plans(vec![timed])?;
    Ok(cycle)
}

pub(super) fn cycle_sweep(effort: Effort) -> Figures {
    let mut figures = Vec::new();
    let demands: &[[f64; 2]] = effort.pick(&[[0.19, 0.12]], &[[0.16, 0.08], [0.19, 0.12], [0.22, 0.13]]);
    let seeds = effort.pick(1, 4);
    for flows in demands {
        let mut traffic = Signalised::new(40.0, 40.0, 1)?.traffic;
        let best_cycle =
            retime(&mut traffic, Webster { cycle: (20.0, 300.0), ..Webster::default() }, *flows)?;
        let delay = |cycle: f64| -> Result<f64, ValidationError> {
            let runs: Result<Vec<f64>, _> =
                (1..=seeds).map(|seed| delay_at_cycle(*flows, cycle, seed)).collect();
            Ok(mean(runs?))
        };
        let own = delay(best_cycle)?;
        let mut best = own;
        for share in [0.6, 0.75, 0.9, 1.15, 1.35, 1.7, 2.2] {
            best = best.min(delay(best_cycle * share)?);
        }
        let hour = flows.map(|flow| flow * 3600.0);
        let name =
            format!("delay at {best_cycle:.0} s over the best, {:.0} and {:.0} veh/h", hour[0], hour[1]);
        let source = "C0 = (1.5 L + 5) / (1 - Y), Webster 1958";
        figures.push(Figure::within(name, own / best, (1.0, 1.1), "").cited(source));
    }
    Ok(figures)
}
