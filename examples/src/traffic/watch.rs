//! A run that is watched: the recorder, the trips that ended, a street and a junction.

use simworld_core::id::IntersectionId;
use simworld_core::net::{Control, RoadNetwork};
use simworld_traffic::look::{Film, Recorder, Street, Trajectories};
use simworld_traffic::{Traffic, Trip, TripEnd};

/// A street is followed over so many metres at most.
const REACH: f64 = 1500.0;
/// The diagram and the film show this much of the end of the run, s.
const DIAGRAM: f64 = 600.0;
const FILM: f64 = 60.0;
/// The film shows so much to either side of its junction, m.
const AROUND: f64 = 45.0;

/// What is kept of a run.
pub struct Watched {
    /// Lanes, junctions and totals.
    pub recorder: Recorder,
    /// Trips that came to their end.
    pub trips: Vec<Trip>,
    /// A street over the last ten minutes; none without lanes.
    pub street: Option<Trajectories>,
    /// The busiest junction over the last minute; none before, or without junctions.
    pub film: Option<Film>,
    until: f64,
}

impl Watched {
    /// Nothing yet, of a run of so many seconds.
    pub fn new(traffic: &Traffic, seconds: f64) -> Self {
        let street = Street::busiest(traffic.network(), REACH).map(Trajectories::new);
        Self { recorder: Recorder::new(traffic), trips: Vec::new(), street, film: None, until: seconds }
    }

    /// Looks at the traffic after a step of `dt` s.
    pub fn look(&mut self, traffic: &Traffic, dt: f64) {
        self.recorder.look(traffic, dt);
        self.trips.extend(traffic.ended().iter().filter(|trip| trip.end == TripEnd::Arrived));
        let left = self.until - traffic.seconds();
        if left < DIAGRAM
            && let Some(street) = &mut self.street
        {
            street.look(traffic);
        }
        if left < FILM {
            if self.film.is_none() {
                let busiest = self.busiest(traffic.network());
                self.film = busiest.map(|junction| Film::new(traffic.network(), junction, AROUND));
            }
            if let Some(film) = &mut self.film {
                film.look(traffic);
            }
        }
    }

    /// The junction with signals that most vehicles crossed, or any where no junction has signals.
    fn busiest(&self, network: &RoadNetwork) -> Option<IntersectionId> {
        let junctions = self.recorder.junctions().iter();
        let rank = |id: IntersectionId| network.intersections[id.index()].control == Control::Signals;
        junctions.max_by_key(|delay| (rank(delay.junction), delay.vehicles)).map(|delay| delay.junction)
    }
}
