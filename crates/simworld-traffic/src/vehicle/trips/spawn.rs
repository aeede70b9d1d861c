//! Where vehicles are at the start.

use simworld_core::seed::{Stream, StreamRng};

use crate::TrafficConfig;
use crate::vehicle::VehicleKind;
use crate::vehicle::driving::sirens::Sirens;
use crate::vehicle::manager::{NONE, Vehicle, VehicleManager};
use crate::vehicle::queues::path::Path;
use crate::vehicle::tracks::{Track, Tracks};
use crate::vehicle::types::{TypeIndex, VehicleType, draw_type};

/// Room before and behind each vehicle at the start, m.
const ROOM: f64 = 4.0;

/// The places of the start: on lanes for everybody, and on those for some, each in the order in which they are taken.
struct Places {
    common: Vec<(Track, f64)>,
    bus: Vec<(Track, f64)>,
    cycle: Vec<(Track, f64)>,
}

impl Places {
    /// Places in proportion to the length of lanes, in random order.
    fn new(tracks: &Tracks, config: &TrafficConfig, rng: &mut StreamRng) -> Self {
        let longest = |rider: bool| {
            let comes = |row: &&VehicleType| row.share > 0.0 && (!rider || row.kind.is_rider());
            config.types.iter().filter(comes).map(|row| row.length).fold(0.0, f64::max)
        };
        // The table may have no shares at all: then all its types come.
        let any = config.types.iter().map(|row| row.length).fold(0.0, f64::max);
        let slot = |rider| if longest(rider) > 0.0 { longest(rider) } else { any } + ROOM;
        let lay = |kind: VehicleKind, others: &[VehicleKind], slot: f64, rng: &mut StreamRng| {
            let mut places: Vec<(Track, f64)> = Vec::new();
            let is_meant = |lane: &Track| {
                tracks.may_use(*lane, kind) && !others.iter().any(|other| tracks.may_use(*lane, *other))
            };
            // Not where they could only leave the map, unless it is all like that.
            let leads_on = |lane: &Track| tracks.leads_on[*lane as usize];
            let any = (0..tracks.lanes as Track).filter(is_meant).any(|lane| leads_on(&lane));
            for lane in (0..tracks.lanes as Track).filter(is_meant).filter(|lane| !any || leads_on(lane)) {
                let count = ((tracks.length[lane as usize] - 1.0) / slot).floor().max(0.0) as usize;
                places.extend((1..=count).map(|place| (lane, place as f64 * slot)));
            }
            rng.shuffle(&mut places);
            places
        };
        let common = lay(VehicleKind::Car, &[], slot(false), rng);
        let bus = lay(VehicleKind::Bus, &[VehicleKind::Car], slot(false), rng);
        let cycle = lay(VehicleKind::Bicycle, &[VehicleKind::Car], slot(true), rng);
        Self { common, bus, cycle }
    }

    /// A place for a vehicle of a kind: on a lane of its own if there is one.
    fn take(&mut self, kind: VehicleKind) -> Option<(Track, f64)> {
        let own = match kind {
            VehicleKind::Bus => self.bus.pop(),
            _ if kind.is_rider() => self.cycle.pop(),
            _ => None,
        };
        own.or_else(|| self.common.pop())
    }
}

impl VehicleManager {
    /// Places vehicles on lanes, in proportion to their length, and returns how many found room.
    pub(crate) fn spawn(&mut self, tracks: &Tracks, config: &TrafficConfig, streams: Stream) -> u32 {
        let mut rng = streams.named("places").rng();
        let mut places = Places::new(tracks, config, &mut rng);
        let mut taken: Vec<(Track, f64, TypeIndex, f32)> = Vec::new();
        for _ in 0..config.vehicles {
            let row = draw_type(&config.types, |_| true, &mut rng);
            let kind = config.vehicle_type(row);
            let Some((track, s)) = places.take(kind.kind) else { break };
            let factor = Sirens::factor(kind, kind.draw_factor(&mut rng), kind.siren);
            taken.push((track, s, row, factor));
        }
        // Front to back on each lane, so that pushing to the back keeps the order.
        taken.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
        let mut weights = Vec::new();
        for (index, (track, s, row, factor)) in taken.iter().enumerate() {
            let mut path = Path::new(*track, NONE, 0.0, 0.0);
            let mut vehicle = Vehicle::new(config.vehicle_type(*row), *row, *factor, index as u32, *s);
            let mind = (tracks, config);
            vehicle.next = self.choose(mind, streams, &mut weights, &vehicle, &mut path, *track);
            self.whereabouts.push(*track);
            self.sirens.switch(index as u32, config.vehicle_type(*row).siren);
            self.storage.add(*track, &vehicle, config);
            self.push(tracks, *track, vehicle, path);
        }
        taken.len() as u32
    }
}
