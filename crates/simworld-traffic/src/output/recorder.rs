//! The recorder: looks at the traffic once a step, for all outputs together.

use std::any::Any;
use std::io;
use std::marker::PhantomData;

use simworld_core::geometry::{Point2, direction, planar, yaw_of};
use simworld_core::id::{ConnectionId, LaneId};
use simworld_core::net::RoadNetwork;

use crate::vehicle::VehicleKind;
use crate::{Body, NetworkNames, Traffic, Trip};

/// Where a vehicle's front is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// On a lane.
    Lane(LaneId),
    /// On the way across an intersection.
    Connection(ConnectionId),
}

impl Place {
    fn of(track: u32, lanes: usize) -> Self {
        match (track as usize).checked_sub(lanes) {
            None => Self::Lane(LaneId(track)),
            Some(way) => Self::Connection(ConnectionId::from_index(way)),
        }
    }

    /// Length of the lane or connection, m.
    pub fn length(self, network: &RoadNetwork) -> f64 {
        match self {
            Self::Lane(lane) => network.lanes[lane.index()].length,
            Self::Connection(way) => network.connections[way.index()].length,
        }
    }

    /// The name of the lane, or of the internal lane.
    pub fn name(self, names: &NetworkNames) -> &str {
        match self {
            Self::Lane(lane) => names.lane(lane),
            Self::Connection(way) => names.connection(way),
        }
    }
}

/// A vehicle as outputs see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Its number.
    pub id: u32,
    /// Its kind.
    pub kind: VehicleKind,
    /// Where its front is.
    pub place: Place,
    /// Its front, m along its place.
    pub station: f64,
    /// Speed, m/s.
    pub speed: f64,
    /// Length, m.
    pub length: f64,
    /// Its front in the plane, m.
    pub front: Point2,
    /// Its heading, radians from east.
    pub yaw: f64,
    /// Where it was a step before; where it is now if it has just come.
    pub before: Place,
    /// Its front there, m.
    pub before_station: f64,
    /// How far it went in the step, m.
    pub moved: f64,
    /// Whether it entered in the step.
    pub is_new: bool,
}

impl Seen {
    /// Where its front was and is, in metres along a lane that it is on or has just left for a way onwards: beyond the
    /// end of the lane once it has. `None` if it is elsewhere.
    pub fn along(&self, lane: LaneId, network: &RoadNetwork) -> Option<(f64, f64)> {
        if self.place == Place::Lane(lane) {
            return Some((self.station - self.moved, self.station));
        }
        (self.before == Place::Lane(lane) && matches!(self.place, Place::Connection(_))
            || self.leaps(lane, network))
        .then_some((self.before_station, self.before_station + self.moved))
    }

    /// Whether it crossed a whole intersection in one step.
    fn leaps(&self, lane: LaneId, network: &RoadNetwork) -> bool {
        let Place::Lane(now) = self.place else { return false };
        self.before == Place::Lane(lane) && network.lanes[now.index()].from == network.lanes[lane.index()].to
    }
}

/// One step of the traffic, as outputs see it.
#[derive(Clone, Copy, Debug)]
pub struct Observation<'a> {
    /// The roads.
    pub network: &'a RoadNetwork,
    /// The names of their parts.
    pub names: &'a NetworkNames,
    /// Everybody, in the order of tracks.
    pub vehicles: &'a [Seen],
    /// Numbers of those who entered in this step.
    pub entered: &'a [u32],
    /// Trips that ended in it.
    pub ended: &'a [Trip],
    /// Vehicles that wait outside.
    pub outside: usize,
    /// Time at the end of the step, s.
    pub seconds: f64,
    /// Length of the step, s.
    pub dt: f64,
    roster: &'a [Known],
}

impl Observation<'_> {
    /// What a vehicle is called.
    pub fn name(&self, id: u32) -> &str {
        self.roster.get(id as usize).map_or("", |known| known.name.as_str())
    }

    /// Where a vehicle was last seen, and its speed there; for one whose trip ended, before it left.
    pub fn last_seen(&self, id: u32) -> Option<(Place, f64, f64)> {
        self.roster.get(id as usize).and_then(|known| known.last)
    }

    /// Length of a vehicle, m.
    pub fn length_of(&self, id: u32) -> f64 {
        self.roster.get(id as usize).map_or(0.0, |known| known.length)
    }
}

/// Sees every step.
pub trait Output: Any {
    /// Takes up one step.
    ///
    /// # Errors
    /// The writer's.
    fn observe(&mut self, step: &Observation<'_>) -> io::Result<()>;

    /// Writes what is left, at the end.
    ///
    /// # Errors
    /// The writer's.
    fn finish(&mut self) -> io::Result<()>;
}

/// An output of a recorder.
#[derive(Debug)]
pub struct OutputId<T> {
    index: usize,
    of: PhantomData<fn() -> T>,
}

impl<T> Clone for OutputId<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for OutputId<T> {}

/// What is remembered of the bearer of a number.
#[derive(Clone, Debug, Default)]
struct Known {
    name: String,
    last: Option<(Place, f64, f64)>,
    length: f64,
}

/// Looks at the traffic after every step and lets its outputs see it. What it remembers grows with the vehicles on the
/// roads, not with time.
pub struct Recorder {
    names: NetworkNames,
    outputs: Vec<Box<dyn Output>>,
    roster: Vec<Known>,
    vehicles: Vec<Seen>,
    seconds: f64,
    count: u64,
}

impl Recorder {
    /// A recorder that calls parts of the network by their numbers.
    pub fn of(traffic: &Traffic) -> Self {
        Self::new(traffic, NetworkNames::of(traffic.network()))
    }

    /// A recorder that calls parts of the network by names of your own.
    pub fn new(traffic: &Traffic, names: NetworkNames) -> Self {
        let mut recorder = Self {
            names,
            outputs: Vec::new(),
            roster: Vec::new(),
            vehicles: Vec::new(),
            seconds: traffic.seconds(),
            count: 0,
        };
        // Those who are there already are no newcomers of the first step.
        recorder.look(traffic);
        recorder.remember();
        recorder
    }

    /// Adds an output; ask for it again with [`get`](Self::get).
    pub fn add<T: Output>(&mut self, output: T) -> OutputId<T> {
        self.outputs.push(Box::new(output));
        OutputId { index: self.outputs.len() - 1, of: PhantomData }
    }

    /// An output of this recorder.
    pub fn get<T: Output>(&self, id: OutputId<T>) -> &T {
        let output: &dyn Any = &*self.outputs[id.index];
        output.downcast_ref().expect("an id is made by the recorder that holds the output of that type")
    }

    /// Names the bearer of a number, from now until its trip ends. Who has no name is called `v0`, `v1` and so on.
    pub fn name(&mut self, id: u32, name: impl Into<String>) {
        self.known(id).name = name.into();
    }

    /// Looks at the step that was just made.
    ///
    /// # Errors
    /// The writers'.
    pub fn observe(&mut self, traffic: &Traffic) -> io::Result<()> {
        self.look(traffic);
        let dt = traffic.seconds() - self.seconds;
        self.seconds = traffic.seconds();
        let step = Observation {
            network: traffic.network(),
            names: &self.names,
            vehicles: &self.vehicles,
            entered: traffic.entered(),
            ended: traffic.ended(),
            outside: traffic.outside(),
            seconds: self.seconds,
            dt,
            roster: &self.roster,
        };
        for output in &mut self.outputs {
            output.observe(&step)?;
        }
        for trip in traffic.ended() {
            *self.known(trip.id) = Known::default();
        }
        self.remember();
        Ok(())
    }

    /// Writes what is left.
    ///
    /// # Errors
    /// The writers'.
    pub fn finish(&mut self) -> io::Result<()> {
        self.outputs.iter_mut().try_for_each(|output| output.finish())
    }

    fn known(&mut self, id: u32) -> &mut Known {
        let index = id as usize;
        if self.roster.len() <= index {
            self.roster.resize(index + 1, Known::default());
        }
        &mut self.roster[index]
    }

    fn remember(&mut self) {
        for seen in &self.vehicles {
            self.roster[seen.id as usize].last = Some((seen.place, seen.station, seen.speed));
        }
    }

    fn look(&mut self, traffic: &Traffic) {
        let network = traffic.network();
        let mut vehicles = std::mem::take(&mut self.vehicles);
        vehicles.clear();
        for (body, (id, track, station, speed)) in traffic.vehicles().zip(traffic.stations()) {
            let place = Place::of(track, network.lanes.len());
            let length = length_of(&body);
            let count = &mut self.count;
            let index = id as usize;
            if self.roster.len() <= index {
                self.roster.resize(index + 1, Known::default());
            }
            let known = &mut self.roster[index];
            if known.name.is_empty() {
                known.name = format!("v{count}");
                *count += 1;
            }
            known.length = length;
            let (before, before_station) =
                known.last.map_or((place, station), |(place, station, _)| (place, station));
            let moved = moved(network, (before, before_station), (place, station));
            let yaw = yaw_of(&body.pose);
            vehicles.push(Seen {
                id,
                kind: body.kind,
                place,
                station,
                speed,
                length,
                front: planar(&body.pose) + direction(yaw) * (length * 0.5),
                yaw,
                before,
                before_station,
                moved,
                is_new: known.last.is_none(),
            });
        }
        self.vehicles = vehicles;
    }
}

/// Length of a body, m.
fn length_of(body: &Body) -> f64 {
    body.shape.size().x
}

/// How far a front went from one place to another, m; on a change of lanes as far as it came along.
fn moved(network: &RoadNetwork, (from, start): (Place, f64), (to, end): (Place, f64)) -> f64 {
    let follows = match (from, to) {
        (Place::Lane(lane), Place::Connection(way)) => network.connections[way.index()].from == lane,
        (Place::Connection(way), Place::Lane(lane)) => network.connections[way.index()].to == lane,
        (Place::Lane(a), Place::Lane(b)) => network.lanes[a.index()].road != network.lanes[b.index()].road,
        (Place::Connection(_), Place::Connection(_)) => from != to,
    };
    if follows { (from.length(network) - start).max(0.0) + end } else { (end - start).max(0.0) }
}
