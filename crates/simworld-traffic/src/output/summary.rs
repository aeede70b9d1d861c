//! The summary: how many run, wait and have arrived, step by step.

use std::io::{self, Write};

use super::recorder::{Observation, Output, Place};
use super::write::{Records, Syntax, Two};
use crate::TripEnd;

/// Slower than this one halts, m/s.
const HALTING: f64 = 0.1;

/// The state of the traffic after a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SummaryStep {
    /// Time, s.
    pub time: f64,
    /// Vehicles that entered since the start of the recording, and those that were there.
    pub inserted: u64,
    /// Vehicles on the roads.
    pub running: usize,
    /// Vehicles that wait outside.
    pub waiting: usize,
    /// Vehicles that came to the end of their route.
    pub arrived: u64,
    /// Vehicles whose trip ended, for whatever reason.
    pub ended: u64,
    /// Vehicles that stand.
    pub halting: usize,
    /// How long those who entered had waited outside, on average, s.
    pub mean_waiting_time: f64,
    /// How long those who arrived were under way, on average, s.
    pub mean_travel_time: f64,
    /// Mean speed, m/s; -1 if nobody runs.
    pub mean_speed: f64,
    /// Mean share of the speed limit; -1 if nobody runs.
    pub mean_relative_speed: f64,
}

/// Writes the state of the traffic: SUMO's `summary`.
pub struct Summary<W> {
    records: Records<W>,
    last: SummaryStep,
    waited: (f64, u64),
    travelled: (f64, u64),
    is_begun: bool,
}

impl<W: Write> Summary<W> {
    /// An output of the state after every step.
    ///
    /// # Errors
    /// The writer's.
    pub fn new(writer: W, syntax: Syntax) -> io::Result<Self> {
        let records = Records::new(writer, syntax, "summary")?;
        let last = SummaryStep::default();
        Ok(Self { records, last, waited: (0.0, 0), travelled: (0.0, 0), is_begun: false })
    }

    /// The last step.
    pub fn last(&self) -> SummaryStep {
        self.last
    }

    /// What is written to.
    pub fn writer(&self) -> &W {
        &self.records.out
    }

    fn count(&mut self, step: &Observation<'_>) {
        let last = &mut self.last;
        if !self.is_begun {
            self.is_begun = true;
            let present = step.vehicles.len() + step.ended.len() - step.entered.len();
            last.inserted = present as u64;
        }
        last.inserted += step.entered.len() as u64;
        last.ended += step.ended.len() as u64;
        for trip in step.ended {
            self.waited = (self.waited.0 + trip.entered - trip.scheduled, self.waited.1 + 1);
            if trip.end == TripEnd::Arrived {
                last.arrived += 1;
                self.travelled = (self.travelled.0 + trip.left - trip.entered, self.travelled.1 + 1);
            }
        }
        let mean = |(sum, count): (f64, u64)| if count == 0 { -1.0 } else { sum / count as f64 };
        let running = step.vehicles.len();
        let limit = |place: Place| match place {
            Place::Lane(lane) => step.network.lanes[lane.index()].speed_limit,
            Place::Connection(way) => {
                step.network.lanes[step.network.connections[way.index()].to.index()].speed_limit
            }
        };
        let speeds: f64 = step.vehicles.iter().map(|seen| seen.speed).sum();
        let shares: f64 = step.vehicles.iter().map(|seen| seen.speed / limit(seen.place)).sum();
        last.time = step.seconds;
        last.running = running;
        last.waiting = step.outside;
        last.halting = step.vehicles.iter().filter(|seen| seen.speed < HALTING).count();
        last.mean_waiting_time = mean(self.waited);
        last.mean_travel_time = mean(self.travelled);
        last.mean_speed = mean((speeds, running as u64));
        last.mean_relative_speed = mean((shares, running as u64));
    }
}

impl<W: Write + 'static> Output for Summary<W> {
    fn observe(&mut self, step: &Observation<'_>) -> io::Result<()> {
        self.count(step);
        let last = self.last;
        self.records.record(
            "step",
            &[],
            &[
                ("time", &Two(last.time)),
                ("loaded", &(last.inserted + last.waiting as u64)),
                ("inserted", &last.inserted),
                ("running", &last.running),
                ("waiting", &last.waiting),
                ("ended", &last.ended),
                ("arrived", &last.arrived),
                ("collisions", &0),
                ("teleports", &0),
                ("halting", &last.halting),
                ("stopped", &0),
                ("meanWaitingTime", &Two(last.mean_waiting_time)),
                ("meanTravelTime", &Two(last.mean_travel_time)),
                ("meanSpeed", &Two(last.mean_speed)),
                ("meanSpeedRelative", &Two(last.mean_relative_speed)),
            ],
        )
    }

    fn finish(&mut self) -> io::Result<()> {
        self.records.finish()
    }
}
