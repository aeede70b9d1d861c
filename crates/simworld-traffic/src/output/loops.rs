//! Induction loops: who passes a point of a lane (SUMO's E1 detectors).

use std::collections::BTreeMap;
use std::io::{self, Write};

use simworld_core::id::LaneId;

use super::recorder::{Observation, Output, Place, Seen};
use super::write::{Field, Records, Safe, Syntax, Two};
use crate::TripEnd;

/// A loop in the road.
#[derive(Clone, Debug, PartialEq)]
pub struct InductionLoop {
    /// What it is called.
    pub name: String,
    /// Its lane.
    pub lane: LaneId,
    /// Where it lies, m along the lane.
    pub station: f64,
}

impl InductionLoop {
    /// A loop at a station of a lane, m.
    pub fn new(name: impl Into<String>, lane: LaneId, station: f64) -> Self {
        Self { name: name.into(), lane, station }
    }
}

/// What a loop counted in an interval.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LoopReading {
    /// When the interval began, s.
    pub begin: f64,
    /// When it ended, s.
    pub end: f64,
    /// Vehicles whose front passed.
    pub entered: u32,
    /// Vehicles whose rear passed too.
    pub passed: u32,
    /// Those who passed, an hour.
    pub flow: f64,
    /// Share of the time that somebody was above it, 0 to 1.
    pub occupancy: f64,
    /// Mean speed of those who passed, m/s; -1 if nobody did.
    pub mean_speed: f64,
    /// Their harmonic mean speed, m/s, which is that of the traffic in space; -1 if nobody did.
    pub harmonic_speed: f64,
    /// Their mean length, m; -1 if nobody did.
    pub mean_length: f64,
}

/// What is added up during an interval.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    entered: u32,
    passed: u32,
    covered: f64,
    speed: f64,
    /// Sum of 1/v, s/m.
    slowness: f64,
    length: f64,
}

/// Somebody above a loop: its front is so far beyond, m.
#[derive(Clone, Copy, Debug)]
struct Above {
    detector: usize,
    beyond: f64,
}

/// Reads loops once an interval, and writes what they say: SUMO's output of induction loops.
pub struct LoopOutput {
    loops: Vec<InductionLoop>,
    by_lane: BTreeMap<LaneId, Vec<usize>>,
    sums: Vec<Sums>,
    above: BTreeMap<u32, Vec<Above>>,
    readings: Vec<LoopReading>,
    period: f64,
    begin: Option<f64>,
    out: Option<Records<Box<dyn Write>>>,
}

impl LoopOutput {
    /// Loops that are read once in so many seconds.
    pub fn new(loops: Vec<InductionLoop>, period: f64) -> Self {
        let mut by_lane: BTreeMap<LaneId, Vec<usize>> = BTreeMap::new();
        for (index, one) in loops.iter().enumerate() {
            by_lane.entry(one.lane).or_default().push(index);
        }
        Self {
            sums: vec![Sums::default(); loops.len()],
            by_lane,
            loops,
            above: BTreeMap::new(),
            readings: Vec::new(),
            period,
            begin: None,
            out: None,
        }
    }

    /// Writes every reading.
    ///
    /// # Errors
    /// The writer's.
    pub fn writing_to(mut self, writer: impl Write + 'static, syntax: Syntax) -> io::Result<Self> {
        self.out = Some(Records::new(Box::new(writer) as Box<dyn Write>, syntax, "detector")?);
        Ok(self)
    }

    /// The loops.
    pub fn loops(&self) -> &[InductionLoop] {
        &self.loops
    }

    /// What the loops counted in the last whole interval, one each; none before the first is over.
    pub fn readings(&self) -> &[LoopReading] {
        &self.readings
    }

    /// Whether somebody is above a loop now.
    pub fn is_occupied(&self, detector: usize) -> bool {
        self.above.values().flatten().any(|above| above.detector == detector)
    }

    /// Moves on who is above loops already.
    fn go_on(&mut self, seen: &Seen, dt: f64) {
        let Some(list) = self.above.get_mut(&seen.id) else { return };
        let sums = &mut self.sums;
        list.retain_mut(|above| {
            let rear = above.beyond - seen.length;
            above.beyond += seen.moved;
            let is_out = above.beyond >= seen.length;
            let share = if is_out && seen.moved > 0.0 { (-rear / seen.moved).clamp(0.0, 1.0) } else { 1.0 };
            sums[above.detector].covered += share * dt;
            if is_out {
                sums[above.detector].pass(seen);
            }
            !is_out
        });
        if list.is_empty() {
            self.above.remove(&seen.id);
        }
    }

    /// Whose front comes to a loop in this step.
    fn arrive(&mut self, seen: &Seen, step: &Observation<'_>) {
        for place in [seen.before, seen.place] {
            let Place::Lane(lane) = place else { continue };
            if place == seen.place && seen.before == seen.place && seen.moved == 0.0 {
                return;
            }
            let Some(own) = self.by_lane.get(&lane) else { continue };
            let Some((from, to)) = seen.along(lane, step.network) else { continue };
            for detector in own {
                let station = self.loops[*detector].station;
                if !(from < station && station <= to) {
                    continue;
                }
                let sums = &mut self.sums[*detector];
                sums.entered += 1;
                let beyond = to - station;
                let above = beyond.min(seen.length);
                sums.covered += above / (to - from) * step.dt;
                if beyond >= seen.length {
                    sums.pass(seen);
                } else {
                    self.above.entry(seen.id).or_default().push(Above { detector: *detector, beyond });
                }
            }
            if seen.before == seen.place {
                return;
            }
        }
    }

    /// Those who left the network drove over what lay before them, and are above nothing.
    fn leave(&mut self, step: &Observation<'_>) {
        for trip in step.ended {
            for above in self.above.remove(&trip.id).into_iter().flatten() {
                self.sums[above.detector].passed += u32::from(trip.end == TripEnd::Arrived);
                if trip.end == TripEnd::Arrived {
                    self.sums[above.detector]
                        .take(step.last_seen(trip.id).map_or(0.0, |seen| seen.2), step.length_of(trip.id));
                }
            }
            let Some((Place::Lane(lane), station, speed)) = step.last_seen(trip.id) else { continue };
            if trip.end != TripEnd::Arrived {
                continue;
            }
            for detector in self.by_lane.get(&lane).into_iter().flatten() {
                if self.loops[*detector].station > station {
                    let sums = &mut self.sums[*detector];
                    sums.entered += 1;
                    sums.passed += 1;
                    sums.take(speed, step.length_of(trip.id));
                }
            }
        }
    }

    fn read(&mut self, begin: f64, end: f64) -> io::Result<()> {
        self.readings.clear();
        for (sums, one) in self.sums.iter_mut().zip(&self.loops) {
            let reading = sums.reading(begin, end);
            *sums = Sums::default();
            self.readings.push(reading);
            if let Some(out) = &mut self.out {
                write(out, one, &reading)?;
            }
        }
        Ok(())
    }
}

fn write(out: &mut Records<Box<dyn Write>>, one: &InductionLoop, reading: &LoopReading) -> io::Result<()> {
    let fields: [Field<'_>; 10] = [
        ("begin", &Two(reading.begin)),
        ("end", &Two(reading.end)),
        ("id", &Safe(&one.name)),
        ("nVehContrib", &reading.passed),
        ("flow", &Two(reading.flow)),
        ("occupancy", &Two(reading.occupancy * 100.0)),
        ("speed", &Two(reading.mean_speed)),
        ("harmonicMeanSpeed", &Two(reading.harmonic_speed)),
        ("length", &Two(reading.mean_length)),
        ("nVehEntered", &reading.entered),
    ];
    out.record("interval", &[], &fields)
}

impl Sums {
    fn pass(&mut self, seen: &Seen) {
        self.passed += 1;
        self.take(seen.speed, seen.length);
    }

    fn take(&mut self, speed: f64, length: f64) {
        self.speed += speed;
        self.slowness += 1.0 / speed.max(0.1);
        self.length += length;
    }

    fn reading(&self, begin: f64, end: f64) -> LoopReading {
        let time = (end - begin).max(1e-9);
        let count = f64::from(self.passed);
        let mean = |sum: f64| if self.passed == 0 { -1.0 } else { sum / count };
        LoopReading {
            begin,
            end,
            entered: self.entered,
            passed: self.passed,
            flow: count * 3600.0 / time,
            occupancy: (self.covered / time).min(1.0),
            mean_speed: mean(self.speed),
            harmonic_speed: if self.passed == 0 { -1.0 } else { count / self.slowness },
            mean_length: mean(self.length),
        }
    }
}

impl Output for LoopOutput {
    fn observe(&mut self, step: &Observation<'_>) -> io::Result<()> {
        let begin = *self.begin.get_or_insert(step.seconds - step.dt);
        for seen in step.vehicles {
            self.go_on(seen, step.dt);
            self.arrive(seen, step);
        }
        self.leave(step);
        if step.seconds + 1e-9 >= begin + self.period {
            self.read(begin, step.seconds)?;
            self.begin = Some(step.seconds);
        }
        Ok(())
    }

    fn finish(&mut self) -> io::Result<()> {
        self.out.as_mut().map_or(Ok(()), Records::finish)
    }
}
