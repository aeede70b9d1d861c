//! Trajectories: where everybody is, step by step (floating car data).

use std::io::{self, Write};

use super::recorder::{Observation, Output};
use super::write::{Field, Records, Safe, Syntax, Two};

/// Writes where everybody is: SUMO's `fcd-export`. Positions are those of fronts, m; angles degrees clockwise from north.
pub struct Fcd<W> {
    records: Records<W>,
    period: f64,
    /// At whole multiples of the period.
    next: Option<f64>,
}

impl<W: Write> Fcd<W> {
    /// An output that writes once in so many seconds, or every step if that is shorter.
    ///
    /// # Errors
    /// The writer's.
    pub fn new(writer: W, syntax: Syntax, period: f64) -> io::Result<Self> {
        Ok(Self { records: Records::new(writer, syntax, "fcd-export")?, period, next: None })
    }

    /// What is written to.
    pub fn writer(&self) -> &W {
        &self.records.out
    }
}

impl<W: Write + 'static> Output for Fcd<W> {
    fn observe(&mut self, step: &Observation<'_>) -> io::Result<()> {
        let period = self.period.max(step.dt).max(1e-3);
        let next = *self.next.get_or_insert(((step.seconds - 1e-9) / period).ceil() * period);
        if step.seconds + 1e-9 < next {
            return Ok(());
        }
        self.next = Some(next + period);
        let time = Two(step.seconds);
        let group: [Field<'_>; 1] = [("time", &time)];
        self.records.begin("timestep", &group)?;
        for seen in step.vehicles {
            let angle = (90.0 - seen.yaw.to_degrees()).rem_euclid(360.0);
            self.records.record(
                "vehicle",
                &group,
                &[
                    ("id", &Safe(step.name(seen.id))),
                    ("x", &Two(seen.front.x)),
                    ("y", &Two(seen.front.y)),
                    ("angle", &Two(angle)),
                    ("type", &seen.kind.as_str()),
                    ("speed", &Two(seen.speed)),
                    ("pos", &Two(seen.station)),
                    ("lane", &Safe(seen.place.name(step.names))),
                    ("slope", &Two(0.0)),
                ],
            )?;
        }
        self.records.end()
    }

    fn finish(&mut self) -> io::Result<()> {
        self.records.finish()
    }
}
