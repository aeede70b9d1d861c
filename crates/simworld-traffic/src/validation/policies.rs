//! Policies that look at their junction against fixed time, where one road is busier than the other.

use super::streets::{CAR, across, mean, traffic};
use super::{Effort, Figure, Figures, ValidationError};
use crate::Flow;
use crate::signal::{Actuated, FixedTime, MaxPressure, SelfOrganizing, SignalPolicy};
use simworld_core::net::StreetPlan;

/// Mean delay of all trips, s, with 650 veh/h on each arm of one road and 120 on each of the other.
fn delay(policy: Box<dyn SignalPolicy + Send>, seed: u64) -> Result<f64, ValidationError> {
    let mut traffic = traffic(&StreetPlan::crossroads(320.0), seed)?;
    traffic.set_policy(policy);
    for (from, to, per_hour) in [(0, 2, 650.0), (2, 0, 650.0), (1, 3, 120.0), (3, 1, 120.0)] {
        traffic.add_flow(Flow { kind: Some(CAR), ..Flow::new(across(from, to), per_hour) })?;
    }
    let mut delays = Vec::new();
    while traffic.seconds() < 3600.0 {
        traffic.step(0.1);
        let counted = traffic.ended().iter().filter(|trip| trip.scheduled > 300.0);
        delays.extend(counted.map(|trip| trip.delay() + trip.entered - trip.scheduled));
    }
    Ok(mean(delays))
}

pub(super) fn measure(effort: Effort) -> Figures {
    type Make = fn() -> Box<dyn SignalPolicy + Send>;
    let policies: [(&str, Make); 3] = [
        ("max-pressure", || Box::new(MaxPressure::default())),
        ("actuated", || Box::new(Actuated::default())),
        ("self-organising", || Box::new(SelfOrganizing::default())),
    ];
    let seeds = effort.pick(2, 10);
    let over_seeds = |make: Make| -> Result<f64, ValidationError> {
        let delays: Result<Vec<f64>, _> = (1..=seeds).map(|seed| delay(make(), seed)).collect();
        Ok(mean(delays?))
    };
    let fixed = over_seeds(|| Box::new(FixedTime))?;
    let mut figures = vec![Figure::within("delay with fixed time", fixed, (0.0, f64::INFINITY), "s")];
    for (name, make) in policies {
        let name = format!("delay with {name} over that with fixed time");
        figures.push(Figure::within(name, over_seeds(make)? / fixed, (0.0, 0.9), ""));
    }
    Ok(figures)
}
