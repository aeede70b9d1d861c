//! What is kept of a run: the use of every lane, delays at junctions, stops, by the definitions of Edie (1963).

use simworld_core::id::IntersectionId;
use simworld_core::net::Control;

use super::LevelOfService;
use crate::Traffic;

/// A vehicle slower than this stands, m/s.
const STANDING: f64 = 0.1;
/// Faster than this it has set off again, m/s.
const MOVING: f64 = 1.0;
/// Over this time flow and density are averaged for the fundamental diagram, s.
const INTERVAL: f64 = 60.0;

/// Vehicle time and distance on a stretch of road over some time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LaneUse {
    /// Vehicle-seconds.
    pub time: f64,
    /// Vehicle-metres.
    pub distance: f64,
}

impl LaneUse {
    /// Vehicles a metre, over `seconds` on `length` m.
    pub fn density(&self, length: f64, seconds: f64) -> f64 {
        self.time / (length * seconds).max(1e-9)
    }

    /// Vehicles a second.
    pub fn flow(&self, length: f64, seconds: f64) -> f64 {
        self.distance / (length * seconds).max(1e-9)
    }

    /// Mean speed, m/s; NaN if nobody was there.
    pub fn speed(&self) -> f64 {
        self.distance / self.time
    }
}

/// Control delay at a junction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JunctionDelay {
    /// Which junction.
    pub junction: IntersectionId,
    /// Vehicles that crossed it.
    pub vehicles: u32,
    /// Their delay, summed, s: from the beginning of the lane before it to the end of the way across, over free speed.
    pub delay: f64,
    /// Whether it has signals.
    pub has_signals: bool,
}

impl JunctionDelay {
    /// Mean control delay, s; 0 if nobody crossed.
    pub fn mean(&self) -> f64 {
        self.delay / f64::from(self.vehicles).max(1.0)
    }

    /// Its level of service.
    pub fn service(&self) -> LevelOfService {
        LevelOfService::of(self.mean(), self.has_signals)
    }
}

/// Figures of the whole run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Totals {
    /// Time that was watched, s.
    pub seconds: f64,
    /// Vehicle-seconds.
    pub time: f64,
    /// Vehicle-metres.
    pub distance: f64,
    /// Vehicle-seconds lost against free speed.
    pub delay: f64,
    /// Times that a vehicle came to a stand.
    pub stops: u64,
}

impl Totals {
    /// Mean speed of all vehicles, m/s.
    pub fn mean_speed(&self) -> f64 {
        self.distance / self.time.max(1e-9)
    }

    /// Time lost on a kilometre, s.
    pub fn delay_per_km(&self) -> f64 {
        self.delay / (self.distance / 1000.0).max(1e-9)
    }

    /// Stops on a kilometre.
    pub fn stops_per_km(&self) -> f64 {
        self.stops as f64 / (self.distance / 1000.0).max(1e-9)
    }
}

/// What is remembered of a vehicle between two steps.
#[derive(Clone, Copy, Debug)]
struct Seen {
    track: u32,
    stands: bool,
    /// Time and free time since the beginning of its lane, s.
    time: f64,
    free: f64,
}

/// Watches a traffic step by step.
#[derive(Clone, Debug)]
pub struct Recorder {
    lanes: Vec<LaneUse>,
    current: Vec<LaneUse>,
    lengths: Vec<f64>,
    free_speeds: Vec<f64>,
    /// Density a lane and metre, and flow a lane and second: of lanes, and of the network.
    points: Vec<(f64, f64)>,
    network: Vec<(f64, f64)>,
    junctions: Vec<JunctionDelay>,
    seen: Vec<Option<Seen>>,
    totals: Totals,
    interval: f64,
}

impl Recorder {
    /// A recorder that has seen nothing yet.
    pub fn new(traffic: &Traffic) -> Self {
        let network = traffic.network();
        let junction = |(index, junction): (usize, &simworld_core::net::Intersection)| JunctionDelay {
            junction: IntersectionId::from_index(index),
            has_signals: junction.control == Control::Signals,
            ..JunctionDelay::default()
        };
        let lanes = vec![LaneUse::default(); network.lanes.len()];
        Self {
            current: lanes.clone(),
            lanes,
            lengths: network.lanes.iter().map(|lane| lane.length).collect(),
            free_speeds: (0..network.lanes.len() as u32).map(|lane| traffic.free_speed(lane)).collect(),
            points: Vec::new(),
            network: Vec::new(),
            junctions: network.intersections.iter().enumerate().map(junction).collect(),
            seen: Vec::new(),
            totals: Totals::default(),
            interval: 0.0,
        }
    }

    /// Looks at the traffic after a step of `dt` s.
    pub fn look(&mut self, traffic: &Traffic, dt: f64) {
        for id in traffic.entered() {
            if let Some(seen) = self.seen.get_mut(*id as usize) {
                *seen = None;
            }
        }
        for (id, track, _, v) in traffic.stations() {
            let free = traffic.free_speed(track);
            self.totals.time += dt;
            self.totals.distance += v * dt;
            self.totals.delay += dt - v * dt / free;
            if let Some(lane) = self.current.get_mut(track as usize) {
                lane.time += dt;
                lane.distance += v * dt;
            }
            self.follow(traffic, id as usize, track, v, (dt, v * dt / free));
        }
        self.totals.seconds += dt;
        self.interval += dt;
        if self.interval + 1e-6 >= INTERVAL {
            self.close_interval();
        }
    }

    /// Follows a vehicle from lane to way to lane.
    fn follow(&mut self, traffic: &Traffic, id: usize, track: u32, v: f64, (time, free): (f64, f64)) {
        if self.seen.len() <= id {
            self.seen.resize(id + 1, None);
        }
        let lanes = self.lanes.len();
        let seen = self.seen[id].get_or_insert(Seen { track, stands: v < STANDING, time: 0.0, free: 0.0 });
        if seen.track != track {
            let (was_across, is_lane) = (seen.track as usize >= lanes, (track as usize) < lanes);
            if was_across && is_lane {
                let way = &traffic.network().connections[seen.track as usize - lanes];
                let junction = &mut self.junctions[way.intersection.index()];
                junction.vehicles += 1;
                junction.delay += (seen.time - seen.free).max(0.0);
                (seen.time, seen.free) = (0.0, 0.0);
            }
            seen.track = track;
        }
        seen.time += time;
        seen.free += free;
        if v < STANDING && !seen.stands {
            seen.stands = true;
            self.totals.stops += 1;
        } else if v > MOVING {
            seen.stands = false;
        }
    }

    fn close_interval(&mut self) {
        /// Shorter lanes hold too few to be averaged, m.
        const LEAST: f64 = 50.0;
        let (mut whole, mut lengths) = (LaneUse::default(), 0.0);
        for ((lane, sum), length) in self.current.iter_mut().zip(&mut self.lanes).zip(&self.lengths) {
            if lane.time > 0.0 && *length >= LEAST {
                self.points.push((lane.density(*length, self.interval), lane.flow(*length, self.interval)));
            }
            whole.time += lane.time;
            whole.distance += lane.distance;
            lengths += length;
            sum.time += lane.time;
            sum.distance += lane.distance;
            *lane = LaneUse::default();
        }
        self.network.push((whole.density(lengths, self.interval), whole.flow(lengths, self.interval)));
        self.interval = 0.0;
    }

    /// The use of a lane since the start.
    pub fn lane(&self, lane: usize) -> LaneUse {
        let sum =
            |a: LaneUse, b: LaneUse| LaneUse { time: a.time + b.time, distance: a.distance + b.distance };
        sum(self.lanes[lane], self.current[lane])
    }

    /// The speed on an empty lane, m/s.
    pub fn free_speed(&self, lane: usize) -> f64 {
        self.free_speeds[lane]
    }

    /// Density, vehicles a metre, and flow, vehicles a second, of every lane of 50 m and more in every minute in which
    /// somebody was there.
    pub fn lane_minutes(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// The same of the whole network, on average over its lanes, minute by minute.
    pub fn network_minutes(&self) -> &[(f64, f64)] {
        &self.network
    }

    /// Delay at every junction, by number.
    pub fn junctions(&self) -> &[JunctionDelay] {
        &self.junctions
    }

    /// Figures of the whole run.
    pub fn totals(&self) -> Totals {
        self.totals
    }
}
