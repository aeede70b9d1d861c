//! Trips: when each vehicle came and went, and what it lost on the way.

use std::io::{self, Write};

use super::recorder::{Observation, Output, Place};
use super::write::{Records, Safe, Syntax, Two};
use crate::TripEnd;

/// Slower than this one waits, m/s: SUMO's threshold.
const WAITING: f64 = 0.1;

/// What is remembered of a trip under way.
#[derive(Clone, Copy, Debug)]
struct Open {
    place: Place,
    station: f64,
    speed: f64,
    waited: f64,
    waits: u32,
    is_waiting: bool,
}

/// Writes each trip as it ends: SUMO's `tripinfos`.
pub struct TripInfo<W> {
    records: Records<W>,
    open: Vec<Option<Open>>,
}

impl<W: Write> TripInfo<W> {
    /// An output of trips.
    ///
    /// # Errors
    /// The writer's.
    pub fn new(writer: W, syntax: Syntax) -> io::Result<Self> {
        Ok(Self { records: Records::new(writer, syntax, "tripinfos")?, open: Vec::new() })
    }

    /// What is written to.
    pub fn writer(&self) -> &W {
        &self.records.out
    }

    fn follow(&mut self, step: &Observation<'_>) {
        for seen in step.vehicles {
            let index = seen.id as usize;
            if self.open.len() <= index {
                self.open.resize(index + 1, None);
            }
            let open = self.open[index].get_or_insert(Open {
                place: seen.place,
                station: seen.station,
                speed: seen.speed,
                waited: 0.0,
                waits: 0,
                is_waiting: false,
            });
            let waits = seen.speed < WAITING;
            open.waited += if waits { step.dt } else { 0.0 };
            open.waits += u32::from(waits && !open.is_waiting);
            open.is_waiting = waits;
        }
    }
}

impl<W: Write + 'static> Output for TripInfo<W> {
    fn observe(&mut self, step: &Observation<'_>) -> io::Result<()> {
        self.follow(step);
        for trip in step.ended {
            let Some(open) = self.open.get_mut(trip.id as usize).and_then(Option::take) else { continue };
            let (place, station, speed) =
                step.last_seen(trip.id).unwrap_or((open.place, open.station, open.speed));
            let gone = trip.end == TripEnd::Arrived;
            // Who arrived did so at the end of the last lane.
            let station = if gone { place.length(step.network) } else { station };
            self.records.record(
                "tripinfo",
                &[],
                &[
                    ("id", &Safe(step.name(trip.id))),
                    ("depart", &Two(trip.entered)),
                    ("departLane", &Safe(open.place.name(step.names))),
                    ("departPos", &Two(open.station)),
                    ("departSpeed", &Two(open.speed)),
                    ("departDelay", &Two(trip.entered - trip.scheduled)),
                    ("arrival", &Two(trip.left)),
                    ("arrivalLane", &Safe(place.name(step.names))),
                    ("arrivalPos", &Two(station)),
                    ("arrivalSpeed", &Two(speed)),
                    ("duration", &Two(trip.left - trip.entered)),
                    ("routeLength", &Two(trip.distance)),
                    ("waitingTime", &Two(open.waited)),
                    ("waitingCount", &open.waits),
                    ("stopTime", &Two(0.0)),
                    ("timeLoss", &Two(trip.delay())),
                    ("vType", &trip.kind.as_str()),
                    ("vaporized", &if gone { "" } else { "1" }),
                ],
            )?;
        }
        Ok(())
    }

    fn finish(&mut self) -> io::Result<()> {
        self.records.finish()
    }
}
