//! Where everybody was and what they did, at even intervals: JSON lines beside the event log, whole up to the last
//! finished line whenever the run stops. Couriers all, traffic in a sample. Positions in whole decimetres, world frame.

use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Seek, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use simworld_agents::delivery::{CourierView, Errand};
use simworld_core::clock::Tick;
use simworld_core::geometry::Point2;
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;

use super::log::cut_off;
use super::{Assembly, LogError};

/// The version of the format; a reader refuses others.
const VERSION: u32 = 2;
/// A sample a second, unless there would be more samples than this, all couriers together.
const MOST_SAMPLES: u64 = 1_000_000;
/// Vehicles that are tracked, and pedestrians: evenly from all that there are at the start.
const MOST_PASSERS: usize = 60;
/// Decimetres a metre.
const DECIMETRES: f64 = 10.0;

/// What a courier is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Doing {
    /// Nothing: it waits for work.
    Idle,
    /// On its way to a restaurant.
    Fetching,
    /// On its way to a home.
    Carrying,
    /// On its way to a meet-point, or waiting there.
    Meeting,
    /// On its way to a store, or to a charging station.
    Shopping,
    /// Exhausted, until it has rested.
    Resting,
}

impl Doing {
    /// Everything a courier may be about.
    pub const ALL: [Self; 6] =
        [Self::Idle, Self::Fetching, Self::Carrying, Self::Meeting, Self::Shopping, Self::Resting];

    fn of(view: &CourierView<'_>) -> Self {
        match view.errand() {
            _ if view.is_exhausted() => Self::Resting,
            Errand::Idle => Self::Idle,
            Errand::PickUp(_) => Self::Fetching,
            Errand::Deliver(_) => Self::Carrying,
            Errand::Meet(_) => Self::Meeting,
            Errand::Shop(_) | Errand::Swap => Self::Shopping,
        }
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Idle => "waiting for work",
            Self::Fetching => "on the way to a restaurant",
            Self::Carrying => "on the way to a home",
            Self::Meeting => "at or on the way to a meet-point",
            Self::Shopping => "on the way to a store",
            Self::Resting => "resting, exhausted",
        }
    }
}

/// What carries a courier.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Mount {
    /// Its feet.
    Foot,
    /// A scooter.
    Scooter,
}

/// A courier at one time; four values in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "(i64, i64, Doing, Mount)", into = "(i64, i64, Doing, Mount)")]
pub struct Spot {
    /// East, dm.
    pub x: i64,
    /// North, dm.
    pub y: i64,
    /// What it was about.
    pub doing: Doing,
    /// What carried it.
    pub mount: Mount,
}

impl Spot {
    /// Where it was, m.
    pub fn point(&self) -> Point2 {
        metres((self.x, self.y))
    }
}

impl From<(i64, i64, Doing, Mount)> for Spot {
    fn from((x, y, doing, mount): (i64, i64, Doing, Mount)) -> Self {
        Self { x, y, doing, mount }
    }
}

impl From<Spot> for (i64, i64, Doing, Mount) {
    fn from(spot: Spot) -> Self {
        (spot.x, spot.y, spot.doing, spot.mount)
    }
}

/// Where something of a track was, m.
pub fn metres(place: (i64, i64)) -> Point2 {
    Point2::new(place.0 as f64 / DECIMETRES, place.1 as f64 / DECIMETRES)
}

/// A courier of a track.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tracked {
    /// Its entity.
    pub id: EntityId,
    /// What it is called.
    pub name: String,
}

/// Somebody of the traffic that is tracked too.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Passer {
    /// Its entity.
    pub id: EntityId,
    /// On what it moves.
    pub on: Moves,
}

/// On what somebody of the traffic moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Moves {
    /// A vehicle, of two wheels or more.
    Wheels,
    /// A pedestrian.
    Feet,
}

/// East and north, dm; `None` of who has left the streets.
pub type Passage = Option<(i64, i64)>;

/// The couriers of a run, and where they were; and some of the traffic.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Length of a step, s.
    pub dt: f64,
    /// Steps between two samples.
    pub interval: u64,
    /// Who is tracked.
    pub couriers: Vec<Tracked>,
    /// The samples: the step, and a spot a courier.
    pub samples: Vec<(Tick, Vec<Spot>)>,
    /// Who of the traffic is tracked, vehicles first.
    pub passers: Vec<Passer>,
    /// Where those were in each sample.
    pub passages: Vec<Vec<Passage>>,
    /// How many vehicles and pedestrians there were at the start, tracked or not.
    pub traffic: (usize, usize),
}

/// One line of the file.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Line {
    /// The first line.
    Header {
        version: u32,
        dt: f64,
        interval: u64,
        couriers: Vec<Tracked>,
        passers: Vec<Passer>,
        traffic: (usize, usize),
    },
    /// All couriers after a step, and the traffic that is tracked.
    Sample(Tick, Vec<Spot>, Vec<Passage>),
}

/// Writes a track line by line.
#[derive(Debug)]
pub struct TrackWriter {
    path: PathBuf,
    file: BufWriter<File>,
    interval: u64,
    passers: Vec<Passer>,
}

impl TrackWriter {
    /// Begins the track of a run of that many steps, with its couriers where they begin.
    ///
    /// # Errors
    /// The file cannot be made.
    pub fn create(path: &Path, assembly: &Assembly, steps: u64) -> Result<Self, LogError> {
        let file = File::create(path).map_err(|source| LogError::File { path: path.to_owned(), source })?;
        let world = assembly.episode.simulation().world();
        let (dt, interval) = (world.clock().dt(), interval(assembly, steps));
        let name = |id: &EntityId| {
            let name = world.entity(*id).map_or_else(String::new, |body| body.label().to_owned());
            Tracked { id: *id, name }
        };
        let couriers = assembly.couriers.iter().map(name).collect();
        let passers = passers(assembly);
        let traffic = (assembly.traffic.vehicles.len(), assembly.traffic.pedestrians.len());
        let header =
            Line::Header { version: VERSION, dt, interval, couriers, passers: passers.clone(), traffic };
        let mut writer = Self { path: path.to_owned(), file: BufWriter::new(file), interval, passers };
        writer.line(&header)?;
        writer.take_if_due(assembly)?;
        Ok(writer)
    }

    /// Goes on with the track of a run of that many steps, behind its first `length` bytes; what comes after them is cut off.
    ///
    /// # Errors
    /// The file cannot be changed.
    pub fn go_on(path: &Path, length: u64, assembly: &Assembly, steps: u64) -> Result<Self, LogError> {
        let file =
            cut_off(path, length).map_err(|source| LogError::File { path: path.to_owned(), source })?;
        let (interval, passers) = (interval(assembly, steps), passers(assembly));
        Ok(Self { path: path.to_owned(), file: BufWriter::new(file), interval, passers })
    }

    /// How long the file is with all that was written, bytes.
    ///
    /// # Errors
    /// As [`take_if_due`](Self::take_if_due).
    pub fn length(&mut self) -> Result<u64, LogError> {
        let length = self.file.flush().and_then(|()| self.file.stream_position());
        length.map_err(|source| LogError::File { path: self.path.clone(), source })
    }

    /// Adds a sample if one is due after this step.
    ///
    /// # Errors
    /// The disk is full, or the file went away.
    pub fn take_if_due(&mut self, assembly: &Assembly) -> Result<(), LogError> {
        let world = assembly.episode.simulation().world();
        let tick = world.clock().tick();
        if !tick.0.is_multiple_of(self.interval) {
            return Ok(());
        }
        let decimetres = |metres: f64| (metres * DECIMETRES).round() as i64;
        let spot = |id: &EntityId| {
            let view = assembly.episode.task().view(*id);
            let place = world.entity(*id).map(|body| body.planar()).or(view.map(|view| view.position()));
            let place = place.unwrap_or_else(Point2::origin);
            let mount = match view {
                Some(view) if view.is_riding() => Mount::Scooter,
                _ => Mount::Foot,
            };
            let doing = view.map_or(Doing::Idle, |view| Doing::of(&view));
            Spot { x: decimetres(place.x), y: decimetres(place.y), doing, mount }
        };
        let passage = |passer: &Passer| {
            let place = world.entity(passer.id)?.planar();
            Some((decimetres(place.x), decimetres(place.y)))
        };
        let spots = assembly.couriers.iter().map(spot).collect();
        self.line(&Line::Sample(tick, spots, self.passers.iter().map(passage).collect()))
    }

    /// Ends the track.
    ///
    /// # Errors
    /// As [`take_if_due`](Self::take_if_due).
    pub fn finish(mut self) -> Result<(), LogError> {
        self.file.flush().map_err(|source| LogError::File { path: self.path.clone(), source })
    }

    fn line(&mut self, line: &Line) -> Result<(), LogError> {
        let written = serde_json::to_writer(&mut self.file, line).map_err(std::io::Error::from);
        written
            .and_then(|()| self.file.write_all(b"\n"))
            .map_err(|source| LogError::File { path: self.path.clone(), source })
    }
}

/// Who of the traffic is tracked: so many of each, evenly from all.
fn passers(assembly: &Assembly) -> Vec<Passer> {
    let some = |all: &[EntityId], on: Moves| -> Vec<Passer> {
        let count = all.len().min(MOST_PASSERS);
        (0..count).map(|index| Passer { id: all[index * all.len() / count], on }).collect()
    };
    let traffic = &assembly.traffic;
    [some(&traffic.vehicles, Moves::Wheels), some(&traffic.pedestrians, Moves::Feet)].concat()
}

/// Steps between two samples of a run of that many steps.
fn interval(assembly: &Assembly, steps: u64) -> u64 {
    let a_second = (1.0 / assembly.episode.simulation().world().clock().dt()).round().max(1.0) as u64;
    a_second.max((steps * assembly.couriers.len() as u64).div_ceil(MOST_SAMPLES))
}

/// Reads a track; a last line that is cut short is left out.
///
/// # Errors
/// The file cannot be read, has no header, or holds a line in its middle that is no sample of its couriers.
pub fn read_track(path: &Path) -> Result<Track, LogError> {
    let fail = |source| LogError::File { path: path.to_owned(), source };
    let mut lines = BufReader::new(File::open(path).map_err(fail)?).split(b'\n').enumerate();
    let header = lines.next().map(|(_, line)| line.map_err(fail)).transpose()?.unwrap_or_default();
    let Ok(Line::Header { version: VERSION, dt, interval, couriers, passers, traffic }) =
        serde_json::from_slice(&header)
    else {
        return Err(LogError::Header { path: path.to_owned() });
    };
    if interval == 0 || !dt.is_finite() || dt <= 0.0 {
        return Err(LogError::Header { path: path.to_owned() });
    }
    let (samples, passages) = (Vec::new(), Vec::new());
    let mut track = Track { dt, interval, couriers, samples, passers, passages, traffic };
    let mut fault = None;
    for (index, line) in lines {
        if let Some(fault) = fault.take() {
            return Err(fault);
        }
        let sample = serde_json::from_slice(&line.map_err(fail)?).and_then(|line| match line {
            Line::Sample(tick, spots, passages)
                if spots.len() == track.couriers.len() && passages.len() == track.passers.len() =>
            {
                Ok((tick, spots, passages))
            }
            _ => Err(serde::de::Error::custom("no sample of those whom the first line names")),
        });
        match sample {
            Ok((tick, spots, passages)) => {
                if let Some((before, _)) = track.samples.last().filter(|last| last.0 >= tick) {
                    let (path, before) = (path.to_owned(), *before);
                    return Err(LogError::Order { path, line: index + 1, tick, before });
                }
                track.samples.push((tick, spots));
                track.passages.push(passages);
            }
            Err(source) => fault = Some(LogError::Line { path: path.to_owned(), line: index + 1, source }),
        }
    }
    Ok(track)
}

impl Track {
    /// The time of a step, s.
    pub fn seconds(&self, tick: Tick) -> f64 {
        tick.0 as f64 * self.dt
    }

    /// Which courier an entity is.
    pub fn courier(&self, id: EntityId) -> Option<usize> {
        self.couriers.iter().position(|courier| courier.id == id)
    }

    /// The way of a courier between two steps, m.
    pub fn way(&self, courier: usize, from: Tick, to: Tick) -> Vec<Point2> {
        let within = |sample: &&(Tick, Vec<Spot>)| (from..=to).contains(&sample.0);
        self.samples.iter().filter(within).map(|(_, spots)| spots[courier].point()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(lines: &str) -> Result<Track, LogError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("track.jsonl");
        std::fs::write(&path, lines).unwrap();
        read_track(&path)
    }

    const HEADER: &str = r#"{"header":{"version":2,"dt":0.1,"interval":10,"couriers":[{"id":7,"name":"Ada"}],"passers":[{"id":9,"on":"wheels"}],"traffic":[80,0]}}"#;
    const SAMPLES: &str = r#"
{"sample":[0,[[10,-25,"idle","foot"]],[[400,15]]]}
{"sample":[10,[[30,-25,"fetching","scooter"]],[null]]}
"#;

    #[test]
    fn a_track_reads_as_it_was_written_and_a_cut_line_is_left_out() {
        let track = written(&format!("{HEADER}{SAMPLES}")).unwrap();
        assert_eq!(track.way(0, Tick(0), Tick(10)), [Point2::new(1.0, -2.5), Point2::new(3.0, -2.5)]);
        assert_eq!(track.way(0, Tick(1), Tick(9)), []);
        assert_eq!(
            (track.samples[1].1[0].doing, track.samples[1].1[0].mount),
            (Doing::Fetching, Mount::Scooter)
        );
        assert_eq!(track.passers, [Passer { id: EntityId::from(9), on: Moves::Wheels }]);
        assert_eq!(track.passages, [[Some((400, 15))], [None]]);
        assert_eq!((track.courier(EntityId::from(7)), track.courier(EntityId::from(8))), (Some(0), None));
        let whole = format!("{HEADER}{SAMPLES}");
        let cut = written(&whole[..whole.len() - 9]).unwrap();
        assert_eq!(cut.samples, track.samples[..1]);
    }

    #[test]
    fn what_is_no_track_is_refused_with_its_line() {
        assert!(matches!(written("").unwrap_err(), LogError::Header { .. }));
        let stranger = format!("{HEADER}\n{{\"sample\":[0,[],[null]]}}\n{{\"sample\":[10,[],[null]]}}\n");
        assert!(matches!(written(&stranger).unwrap_err(), LogError::Line { line: 2, .. }));
        // The couriers of the first line, and not its traffic.
        let strange = r#"{"sample":[0,[[10,-25,"idle","foot"]],[]]}"#;
        assert!(matches!(
            written(&format!("{HEADER}\n{strange}\n{strange}\n")).unwrap_err(),
            LogError::Line { line: 2, .. }
        ));
        let back = format!("{HEADER}{SAMPLES}{}", SAMPLES.trim_start());
        assert!(matches!(written(&back).unwrap_err(), LogError::Order { line: 4, .. }));
    }
}
