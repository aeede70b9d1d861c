//! Means by edge or lane: travel times, densities, speeds (SUMO's `meandata`).

use std::io::{self, Write};

use simworld_core::id::LaneId;
use simworld_core::net::RoadNetwork;

use super::recorder::{Observation, Output, Place};
use super::write::{Field, Records, Safe, Syntax, Two};
use crate::{Leg, TripEnd};

/// Slower than this one waits, m/s.
const WAITING: f64 = 0.1;

/// What means are taken over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PerWhat {
    /// All lanes of a direction of a road together.
    Edge,
    /// Each lane.
    Lane,
}

/// What happened on an edge or lane in an interval.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Means {
    /// Time that vehicles spent there, all together, s.
    pub sampled_seconds: f64,
    /// Distance that they drove there, m.
    pub distance: f64,
    /// Time that they stood, s.
    pub waiting_time: f64,
    /// Time lost against the speed limit, s.
    pub time_loss: f64,
    /// Vehicle length times time, m s.
    pub covered: f64,
    /// Vehicles that came from elsewhere in the network.
    pub entered: u32,
    /// Vehicles that went on.
    pub left: u32,
    /// Vehicles whose trip began there.
    pub departed: u32,
    /// Vehicles whose trip ended there.
    pub arrived: u32,
}

impl Means {
    /// Mean speed in space, m/s; `None` if nobody was there.
    pub fn speed(&self) -> Option<f64> {
        (self.sampled_seconds > 0.0).then(|| self.distance / self.sampled_seconds)
    }

    fn is_empty(&self) -> bool {
        self.sampled_seconds == 0.0 && self.entered + self.left + self.departed + self.arrived == 0
    }
}

/// Takes means over edges or lanes once an interval, and writes them: SUMO's `meandata`. Ways across intersections are left
/// out, as there.
pub struct MeanOutput {
    per: PerWhat,
    sums: Vec<Means>,
    last: Vec<Means>,
    period: f64,
    begin: Option<f64>,
    out: Option<Records<Box<dyn Write>>>,
}

impl MeanOutput {
    /// Means over so many seconds.
    pub fn new(per: PerWhat, period: f64) -> Self {
        Self { per, sums: Vec::new(), last: Vec::new(), period, begin: None, out: None }
    }

    /// Writes them.
    ///
    /// # Errors
    /// The writer's.
    pub fn writing_to(mut self, writer: impl Write + 'static, syntax: Syntax) -> io::Result<Self> {
        self.out = Some(Records::new(Box::new(writer) as Box<dyn Write>, syntax, "meandata")?);
        Ok(self)
    }

    /// The means of an edge in the last whole interval, if they are taken by edge.
    pub fn edge(&self, leg: Leg) -> Option<&Means> {
        self.last.get(leg.index()).filter(|_| self.per == PerWhat::Edge)
    }

    /// The means of a lane in the last whole interval, if they are taken by lane.
    pub fn lane(&self, lane: LaneId) -> Option<&Means> {
        self.last.get(lane.index()).filter(|_| self.per == PerWhat::Lane)
    }

    fn slot(&self, network: &RoadNetwork, place: Place) -> Option<usize> {
        match (place, self.per) {
            (Place::Lane(lane), PerWhat::Lane) => Some(lane.index()),
            (Place::Lane(lane), PerWhat::Edge) => Some(Leg::of(network, lane).index()),
            (Place::Connection(_), _) => None,
        }
    }

    fn add(&mut self, step: &Observation<'_>) {
        let (network, dt) = (step.network, step.dt);
        for seen in step.vehicles {
            let slot = self.slot(network, seen.place);
            let before = self.slot(network, seen.before);
            if slot != before {
                if let Some(slot) = slot {
                    self.sums[slot].entered += 1;
                }
                if let Some(before) = before {
                    self.sums[before].left += 1;
                }
            }
            let (Some(slot), Place::Lane(lane)) = (slot, seen.place) else { continue };
            let sums = &mut self.sums[slot];
            sums.departed += u32::from(seen.is_new);
            sums.sampled_seconds += dt;
            sums.distance += seen.speed * dt;
            sums.waiting_time += if seen.speed < WAITING { dt } else { 0.0 };
            let limit = network.lanes[lane.index()].speed_limit;
            sums.time_loss += dt * (1.0 - seen.speed / limit).max(0.0);
            sums.covered += seen.length * dt;
        }
        for trip in step.ended.iter().filter(|trip| trip.end == TripEnd::Arrived) {
            let place = step.last_seen(trip.id).map(|seen| seen.0);
            if let Some(slot) = place.and_then(|place| self.slot(network, place)) {
                self.sums[slot].arrived += 1;
            }
        }
    }

    fn read(&mut self, step: &Observation<'_>, begin: f64) -> io::Result<()> {
        std::mem::swap(&mut self.sums, &mut self.last);
        self.sums.clear();
        self.sums.resize(self.last.len(), Means::default());
        let Some(out) = &mut self.out else { return Ok(()) };
        let (from, to) = (Two(begin), Two(step.seconds));
        let group: [Field<'_>; 2] = [("begin", &from), ("end", &to)];
        out.begin("interval", &group)?;
        let time = (step.seconds - begin).max(1e-9);
        for (index, means) in self.last.iter().enumerate().filter(|(_, means)| !means.is_empty()) {
            write(out, step, (self.per, index), (means, time), &group)?;
        }
        out.end()
    }
}

fn write(
    out: &mut Records<Box<dyn Write>>,
    step: &Observation<'_>,
    (per, index): (PerWhat, usize),
    (means, time): (&Means, f64),
    group: &[Field<'_>],
) -> io::Result<()> {
    let network = step.network;
    let (element, name, lanes) = match per {
        PerWhat::Edge => {
            let leg = Leg::from_index(index);
            ("edge", step.names.edge(leg), leg.lanes(network).to_vec())
        }
        PerWhat::Lane => {
            ("lane", step.names.lane(LaneId::from_index(index)), vec![LaneId::from_index(index)])
        }
    };
    let count = lanes.len().max(1) as f64;
    let length = lanes.iter().map(|lane| network.lanes[lane.index()].length).sum::<f64>() / count;
    let limit = lanes.iter().map(|lane| network.lanes[lane.index()].speed_limit).fold(0.0, f64::max);
    let speed = means.speed().unwrap_or(limit);
    // Vehicles a kilometre, on all lanes and on each.
    let density = means.sampled_seconds / time / (length / 1000.0).max(1e-9);
    let occupancy = means.covered / (time * length * count).max(1e-9) * 100.0;
    let fields: [Field<'_>; 14] = [
        ("id", &Safe(name)),
        ("sampledSeconds", &Two(means.sampled_seconds)),
        ("traveltime", &Two(length / speed.max(0.01))),
        ("density", &Two(density)),
        ("laneDensity", &Two(density / count)),
        ("occupancy", &Two(occupancy)),
        ("waitingTime", &Two(means.waiting_time)),
        ("timeLoss", &Two(means.time_loss)),
        ("speed", &Two(speed)),
        ("speedRelative", &Two(speed / limit.max(0.01))),
        ("departed", &means.departed),
        ("arrived", &means.arrived),
        ("entered", &means.entered),
        ("left", &means.left),
    ];
    out.record(element, group, &fields)
}

impl Output for MeanOutput {
    fn observe(&mut self, step: &Observation<'_>) -> io::Result<()> {
        let begin = *self.begin.get_or_insert(step.seconds - step.dt);
        let count = match self.per {
            PerWhat::Edge => step.network.roads.len() * 2,
            PerWhat::Lane => step.network.lanes.len(),
        };
        self.sums.resize(count, Means::default());
        self.add(step);
        if step.seconds + 1e-9 >= begin + self.period {
            self.read(step, begin)?;
            self.begin = Some(step.seconds);
        }
        Ok(())
    }

    fn finish(&mut self) -> io::Result<()> {
        self.out.as_mut().map_or(Ok(()), Records::finish)
    }
}
