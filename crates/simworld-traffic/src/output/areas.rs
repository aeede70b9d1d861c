//! Lane areas: who is on a stretch of a lane, and how long the queue there is (SUMO's E2 detectors).

use std::collections::BTreeMap;
use std::io::{self, Write};

use simworld_core::id::LaneId;

use super::recorder::{Observation, Output, Place};
use super::write::{Field, Records, Safe, Syntax, Two};

/// Slower than this one is part of a jam, m/s: SUMO's threshold of 5 km/h.
const JAM_SPEED: f64 = 5.0 / 3.6;
/// Gaps shorter than this do not end a jam, m: SUMO's threshold.
const JAM_GAP: f64 = 10.0;
/// Slower than this one halts, m/s.
const HALTING: f64 = 0.1;

/// A stretch of a lane that is watched.
#[derive(Clone, Debug, PartialEq)]
pub struct LaneArea {
    /// What it is called.
    pub name: String,
    /// Its lane.
    pub lane: LaneId,
    /// Where it begins and ends, m along the lane.
    pub stations: (f64, f64),
}

impl LaneArea {
    /// A stretch between two stations of a lane, m.
    pub fn new(name: impl Into<String>, lane: LaneId, from: f64, to: f64) -> Self {
        Self { name: name.into(), lane, stations: (from, to) }
    }
}

/// What was seen on a stretch in an interval.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AreaReading {
    /// When the interval began, s.
    pub begin: f64,
    /// When it ended, s.
    pub end: f64,
    /// Time that vehicles spent there, all together, s.
    pub sampled_seconds: f64,
    /// Vehicles that came.
    pub entered: u32,
    /// Vehicles that went.
    pub left: u32,
    /// Vehicles that were there at all.
    pub seen: u32,
    /// Their mean speed, m/s; -1 if nobody was there.
    pub mean_speed: f64,
    /// Time lost against the speed limit, s, all together.
    pub time_loss: f64,
    /// Share of the stretch that was covered, on average, 0 to 1.
    pub mean_occupancy: f64,
    /// The greatest share.
    pub max_occupancy: f64,
    /// The longest queue of each step, on average, vehicles and m.
    pub mean_jam: (f64, f64),
    /// The longest queue of all, vehicles and m.
    pub max_jam: (u32, f64),
    /// Vehicles that stood, on average.
    pub mean_halting: f64,
    /// Vehicles there, on average.
    pub mean_vehicles: f64,
    /// The most at once.
    pub max_vehicles: u32,
}

/// One vehicle on a stretch.
#[derive(Clone, Copy, Debug)]
struct Part {
    id: u32,
    front: f64,
    rear: f64,
    speed: f64,
}

#[derive(Clone, Debug, Default)]
struct Sums {
    steps: f64,
    reading: AreaReading,
    distance: f64,
    present: Vec<u32>,
}

/// Reads stretches once an interval, and writes what was seen: SUMO's output of lane area detectors.
pub struct AreaOutput {
    areas: Vec<LaneArea>,
    by_lane: BTreeMap<LaneId, Vec<usize>>,
    parts: Vec<Vec<Part>>,
    sums: Vec<Sums>,
    readings: Vec<AreaReading>,
    period: f64,
    begin: Option<f64>,
    out: Option<Records<Box<dyn Write>>>,
}

impl AreaOutput {
    /// Stretches that are read once in so many seconds.
    pub fn new(areas: Vec<LaneArea>, period: f64) -> Self {
        let mut by_lane: BTreeMap<LaneId, Vec<usize>> = BTreeMap::new();
        for (index, area) in areas.iter().enumerate() {
            by_lane.entry(area.lane).or_default().push(index);
        }
        Self {
            parts: vec![Vec::new(); areas.len()],
            sums: vec![Sums::default(); areas.len()],
            by_lane,
            areas,
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

    /// The stretches.
    pub fn areas(&self) -> &[LaneArea] {
        &self.areas
    }

    /// What was seen in the last whole interval, one each; none before the first is over.
    pub fn readings(&self) -> &[AreaReading] {
        &self.readings
    }

    /// Vehicles on a stretch after the last step.
    pub fn vehicles(&self, area: usize) -> usize {
        self.parts.get(area).map_or(0, Vec::len)
    }

    fn look(&mut self, step: &Observation<'_>) {
        self.parts.iter_mut().for_each(Vec::clear);
        for seen in step.vehicles {
            let (lane, front) = match seen.place {
                Place::Lane(lane) => (lane, seen.station),
                // The rear may still be on the lane before.
                Place::Connection(way) => {
                    let lane = step.network.connections[way.index()].from;
                    (lane, step.network.lanes[lane.index()].length + seen.station)
                }
            };
            for area in self.by_lane.get(&lane).into_iter().flatten() {
                let (from, to) = self.areas[*area].stations;
                let rear = front - seen.length;
                if front > from && rear < to {
                    self.parts[*area].push(Part { id: seen.id, front, rear, speed: seen.speed });
                }
            }
        }
    }

    fn read(&mut self, begin: f64, end: f64) -> io::Result<()> {
        self.readings.clear();
        for (sums, area) in self.sums.iter_mut().zip(&self.areas) {
            let reading = sums.read(begin, end);
            self.readings.push(reading);
            if let Some(out) = &mut self.out {
                write(out, area, &reading)?;
            }
        }
        Ok(())
    }
}

impl Sums {
    fn add(&mut self, parts: &mut [Part], area: &LaneArea, limit: f64, dt: f64) {
        let (from, to) = area.stations;
        self.steps += 1.0;
        let reading = &mut self.reading;
        let mut covered = 0.0;
        for part in parts.iter() {
            reading.sampled_seconds += dt;
            self.distance += part.speed * dt;
            reading.time_loss += dt * (1.0 - part.speed / limit).max(0.0);
            reading.mean_halting += f64::from(u8::from(part.speed < HALTING));
            covered += part.front.min(to) - part.rear.max(from);
        }
        let occupancy = (covered / (to - from).max(1e-9)).min(1.0);
        reading.mean_occupancy += occupancy;
        reading.max_occupancy = reading.max_occupancy.max(occupancy);
        reading.mean_vehicles += parts.len() as f64;
        reading.max_vehicles = reading.max_vehicles.max(parts.len() as u32);
        let (vehicles, length) = longest_jam(parts);
        reading.mean_jam = (reading.mean_jam.0 + f64::from(vehicles), reading.mean_jam.1 + length);
        reading.max_jam = (reading.max_jam.0.max(vehicles), reading.max_jam.1.max(length));
        parts.sort_unstable_by_key(|part| part.id);
        let is_here = |id: &u32| parts.binary_search_by_key(id, |part| part.id).is_ok();
        reading.left += self.present.iter().filter(|id| !is_here(id)).count() as u32;
        let is_new = |part: &&Part| self.present.binary_search(&part.id).is_err();
        let entered = parts.iter().filter(is_new).count() as u32;
        reading.entered += entered;
        // In the first step of an interval those who stayed from the last one are seen too.
        reading.seen += if self.steps == 1.0 { parts.len() as u32 } else { entered };
        self.present.clear();
        self.present.extend(parts.iter().map(|part| part.id));
    }

    fn read(&mut self, begin: f64, end: f64) -> AreaReading {
        let mut reading = std::mem::take(&mut self.reading);
        let steps = self.steps.max(1.0);
        (reading.begin, reading.end) = (begin, end);
        let seconds = reading.sampled_seconds;
        reading.mean_speed = if seconds > 0.0 { self.distance / seconds } else { -1.0 };
        reading.mean_occupancy /= steps;
        reading.mean_jam = (reading.mean_jam.0 / steps, reading.mean_jam.1 / steps);
        reading.mean_halting /= steps;
        reading.mean_vehicles /= steps;
        (self.steps, self.distance) = (0.0, 0.0);
        reading
    }
}

/// The longest queue: vehicles one after the other that hardly move, with no gap to speak of. Vehicles and m.
fn longest_jam(parts: &mut [Part]) -> (u32, f64) {
    parts.sort_unstable_by(|a, b| b.front.total_cmp(&a.front));
    let mut longest = (0, 0.0);
    let mut jam: Option<(u32, f64, f64)> = None;
    for part in parts.iter().filter(|part| part.speed < JAM_SPEED) {
        jam = match jam {
            Some((count, head, rear)) if rear - part.front < JAM_GAP => Some((count + 1, head, part.rear)),
            _ => Some((1, part.front, part.rear)),
        };
        if let Some((count, head, rear)) = jam
            && count > longest.0
        {
            longest = (count, head - rear);
        }
    }
    longest
}

fn write(out: &mut Records<Box<dyn Write>>, area: &LaneArea, reading: &AreaReading) -> io::Result<()> {
    let fields: [Field<'_>; 17] = [
        ("begin", &Two(reading.begin)),
        ("end", &Two(reading.end)),
        ("id", &Safe(&area.name)),
        ("sampledSeconds", &Two(reading.sampled_seconds)),
        ("nVehEntered", &reading.entered),
        ("nVehLeft", &reading.left),
        ("nVehSeen", &reading.seen),
        ("meanSpeed", &Two(reading.mean_speed)),
        ("meanTimeLoss", &Two(reading.time_loss / f64::from(reading.seen.max(1)))),
        ("meanOccupancy", &Two(reading.mean_occupancy * 100.0)),
        ("maxOccupancy", &Two(reading.max_occupancy * 100.0)),
        ("meanMaxJamLengthInVehicles", &Two(reading.mean_jam.0)),
        ("meanMaxJamLengthInMeters", &Two(reading.mean_jam.1)),
        ("maxJamLengthInVehicles", &reading.max_jam.0),
        ("maxJamLengthInMeters", &Two(reading.max_jam.1)),
        ("meanVehicleNumber", &Two(reading.mean_vehicles)),
        ("maxVehicleNumber", &reading.max_vehicles),
    ];
    out.record("interval", &[], &fields)
}

impl Output for AreaOutput {
    fn observe(&mut self, step: &Observation<'_>) -> io::Result<()> {
        let begin = *self.begin.get_or_insert(step.seconds - step.dt);
        self.look(step);
        for (index, area) in self.areas.iter().enumerate() {
            let limit = step.network.lanes.get(area.lane.index()).map_or(1.0, |lane| lane.speed_limit);
            self.sums[index].add(&mut self.parts[index], area, limit, step.dt);
        }
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
