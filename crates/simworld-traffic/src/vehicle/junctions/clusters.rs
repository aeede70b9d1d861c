//! Junctions so near one another that a vehicle between two of them stands in both: one at a time goes in there.
//!
//! A vehicle on a lane that is too short for it keeps others out of the junction behind while it waits for the one before it.
//! Several of them may wait for one another in a ring, each with its rear in the way of the next, and nobody can go back. Such
//! lanes join junctions to a cluster, and whoever is to enter one of them needs the permit of the cluster, of which there is one.
//! Whoever has it waits for nobody who waits for him: all others who are in the cluster have room behind it. While he waits for room himself
//! those come in who do not meet him; he goes on to another lane of the cluster when they are out again.

use petgraph::unionfind::UnionFind;
use serde::{Deserialize, Serialize};
use simworld_core::net::{Lane, RoadNetwork};

use super::leavers::FAR;
use super::rings::rings_of;
use super::trailing::{SPARE, is_too_short};
use crate::TrafficConfig;
use crate::vehicle::manager::{NONE, Vehicle, VehicleManager};
use crate::vehicle::tracks::{Track, Tracks, Way};
use crate::vehicle::types::is_long;

/// Who has a permit and does not use it for so long loses it, s; one who had waited too long keeps it until it is its turn at the
/// signal.
const EXPIRES: f64 = 5.0;
const EXPIRES_LATE: f64 = 90.0;
/// Who has stood for so long asks for the permit before it could go, s: else those whose green comes when it is free have it
/// for good.
pub(super) const TOO_LONG: f64 = 60.0;

/// The cluster that each lane is in which is too short for some type of vehicle, or [`NONE`].
#[derive(Clone, Debug)]
pub(crate) struct Clusters {
    by_lane: Vec<u32>,
    /// Of rings of such lanes, numbered after all others: how many may be in there at once.
    rings: Vec<usize>,
    first_ring: u32,
    /// On a lane shorter than this even those who fit there need the permit: a car would have to wait for them, m.
    short: f64,
}

impl Clusters {
    pub(in crate::vehicle) fn new(network: &RoadNetwork, config: &TrafficConfig) -> Self {
        let lengths = || config.types.iter().map(|row| row.length);
        let longest = lengths().fold(0.0, f64::max);
        let car = lengths().filter(|length| !is_long(*length)).fold(0.0, f64::max);
        let (mut by_lane, short) = (joined(network, longest + SPARE, false), car + SPARE);
        let first_ring = network.intersections.len() as u32;
        let mut rings = Vec::new();
        for ring in rings_of(&joined(network, short, true), network) {
            ring.lanes.iter().for_each(|lane| by_lane[*lane] = first_ring + rings.len() as u32);
            rings.push(ring.places - 1);
        }
        Self { by_lane, rings, first_ring, short }
    }

    /// Whether a lane is in a cluster that is no ring.
    #[inline]
    pub(in crate::vehicle) fn has(&self, lane: Track) -> bool {
        self.by_lane[lane as usize] < self.first_ring
    }

    /// How many permits a cluster has whose ways go round, of which nobody gives way to those outside.
    pub(in crate::vehicle) fn places(&self, cluster: u32) -> Option<usize> {
        let ring = cluster.checked_sub(self.first_ring)?;
        self.rings.get(ring as usize).copied()
    }

    /// The cluster whose permit a vehicle needs for a way; who is in a ring needs none to go on in it.
    pub(super) fn entered_by(&self, tracks: &Tracks, way: u32, vehicle: &Vehicle) -> Option<u32> {
        let Way { from, to, .. } = tracks.ways[way as usize];
        let cluster = self.of(tracks, to, vehicle)?;
        (cluster < self.first_ring || self.by_lane[from as usize] != cluster).then_some(cluster)
    }

    /// The cluster whose permit a vehicle needs for a lane; `None` if it needs none.
    #[inline]
    pub(in crate::vehicle) fn of(&self, tracks: &Tracks, lane: Track, vehicle: &Vehicle) -> Option<u32> {
        let cluster = self.by_lane[lane as usize];
        let length = tracks.length[lane as usize];
        (cluster != NONE && (length < self.short || is_too_short(length, vehicle))).then_some(cluster)
    }
}

/// The sets that lanes shorter than that make of the junctions, by lane: those of roundabouts, or all others.
fn joined(network: &RoadNetwork, short: f64, roundabouts: bool) -> Vec<u32> {
    // Who is in a roundabout goes first all the way: it comes out again without a permit.
    let joins =
        |lane: &Lane| lane.length < short && network.roads[lane.road.index()].roundabout == roundabouts;
    let mut sets: UnionFind<u32> = UnionFind::new(network.intersections.len());
    for lane in network.lanes.iter().filter(|lane| joins(lane)) {
        sets.union(lane.from.0, lane.to.0);
    }
    let cluster = |lane: &Lane| if joins(lane) { sets.find(lane.from.0) } else { NONE };
    network.lanes.iter().map(cluster).collect()
}

/// One who wants to enter a cluster and could.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wish {
    cluster: u32,
    stood: f64,
    id: u32,
    /// The way by which it would enter.
    way: u32,
}

impl Wish {
    pub(in crate::vehicle) fn new(cluster: u32, vehicle: &Vehicle) -> Self {
        Self { cluster, stood: vehicle.stood, id: vehicle.id, way: vehicle.next }
    }

    /// Whether one may get the permit before it could go: of a ring others would go with it meanwhile.
    pub(super) fn comes_early(&self, tracks: &Tracks) -> bool {
        tracks.clusters.places(self.cluster).is_none()
    }
}

/// The permit of a cluster, and who has it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Permit {
    id: u32,
    cluster: u32,
    is_used: bool,
    /// How long it has not been used, s.
    unused: f64,
}

impl Permit {
    pub(in crate::vehicle) fn new(id: u32, cluster: u32) -> Self {
        Self { id, cluster, is_used: false, unused: 0.0 }
    }

    /// Whose it is.
    pub(in crate::vehicle) fn id(&self) -> u32 {
        self.id
    }

    pub(super) fn is_for(&self, id: u32, cluster: u32) -> bool {
        self.id == id && self.cluster == cluster
    }
}

/// The permits of a cluster for whose end a vehicle waits that wants to enter a lane of it: all that there are, or those given after its own.
/// Whoever has one of these was let in since he does not meet the way that the vehicle had then, and may meet another.
pub(super) fn awaited(permits: &[Permit], cluster: u32, id: u32) -> impl Iterator<Item = &Permit> + Clone {
    let own = permits.iter().position(|permit| permit.is_for(id, cluster));
    permits[own.map_or(0, |own| own + 1)..].iter().filter(move |permit| permit.cluster == cluster)
}

impl VehicleManager {
    /// Takes permits back from those who are out of their clusters or do not go, and gives what is free to those who have waited
    /// longest.
    pub(in crate::vehicle) fn give_permits(&mut self, tracks: &Tracks, config: &TrafficConfig, dt: f64) {
        let mut permits = std::mem::take(&mut self.permits);
        permits.retain_mut(|permit| {
            let Some((track, vehicle, _)) = self.find(tracks, permit.id) else { return false };
            let has_leave = vehicle.holding == vehicle.next && (vehicle.next as usize) < tracks.ways.len();
            let here = match tracks.connection(track) {
                Some(way) => tracks.lane_after(way),
                None => track,
            };
            let is_inside = |lane: Track| tracks.clusters.of(tracks, lane, vehicle) == Some(permit.cluster);
            if is_inside(here) || (has_leave && is_inside(tracks.lane_after(vehicle.next as usize))) {
                (permit.is_used, permit.unused) = (true, 0.0);
                return true;
            }
            permit.unused += dt;
            let expires = if vehicle.stood > TOO_LONG { EXPIRES_LATE } else { EXPIRES };
            !permit.is_used && permit.unused < expires
        });
        for part in &mut self.parts {
            self.wishes.append(&mut part.work.wishes);
        }
        self.wishes.sort_unstable_by(|a, b| {
            a.cluster.cmp(&b.cluster).then(b.stood.total_cmp(&a.stood)).then(a.id.cmp(&b.id))
        });
        let wishes = std::mem::take(&mut self.wishes);
        for asking in wishes.chunk_by(|a, b| a.cluster == b.cluster) {
            let held = || permits.iter().filter(|permit| permit.cluster == asking[0].cluster);
            if let Some(places) = tracks.clusters.places(asking[0].cluster) {
                self.let_into_ring(tracks, &mut permits, asking, places);
                continue;
            }
            if held().any(|permit| self.lacks(tracks, config, permit).is_none()) {
                continue;
            }
            let mut let_in = asking.iter().filter(|wish| {
                held().all(|permit| !self.is_met(tracks, permit, wish))
                    && self.kept_out_by(tracks, wish).is_none()
            });
            // Who keeps the holder of a permit from going on comes before all who have waited longer.
            let mut kept_by = let_in.clone();
            let in_the_way =
                kept_by.find(|wish| held().any(|permit| self.is_kept_by(tracks, config, permit, wish)));
            if let Some(Wish { cluster, id, .. }) = in_the_way.or_else(|| let_in.next()).copied() {
                permits.push(Permit::new(id, cluster));
            }
        }
        self.permits = permits;
        self.wishes = wishes;
        self.wishes.clear();
    }

    /// The lane on which somebody outside has stood too long, and longer than one who wants to enter a cluster, for room that this one may take:
    /// whoever is inside goes before him, so that nobody else comes in.
    pub(super) fn kept_out_by(&self, tracks: &Tracks, wish: &Wish) -> Option<Track> {
        self.patient_beyond(tracks, wish, tracks.lane_after(wish.way as usize), FAR)
    }

    /// The same behind a lane of the cluster, and behind those that follow it there.
    fn patient_beyond(&self, tracks: &Tracks, wish: &Wish, lane: Track, far: usize) -> Option<Track> {
        let is_inside = |lane: Track| tracks.clusters.by_lane[lane as usize] == wish.cluster;
        tracks.exits(lane).iter().find_map(|(way, _)| {
            let after = tracks.lane_after(*way as usize);
            if is_inside(after) {
                return far.checked_sub(1).and_then(|far| self.patient_beyond(tracks, wish, after, far));
            }
            let waits = |from: Track, other: &Vehicle| {
                !is_inside(from) && other.id != wish.id && other.stood > wish.stood
            };
            self.who_is_kept_waiting(tracks, after, waits)
        })
    }

    /// Gives the free places of a ring to those who have waited longest. Who needs more of them than there are keeps them for himself: else he
    /// would never have them all.
    fn let_into_ring(&self, tracks: &Tracks, permits: &mut Vec<Permit>, asking: &[Wish], places: usize) {
        for Wish { cluster, id, .. } in asking {
            let held = permits.iter().filter(|permit| permit.cluster == *cluster);
            if !self.has_place(tracks, held, *id, places) {
                break;
            }
            permits.push(Permit::new(*id, *cluster));
        }
    }

    /// Whether there is room for one more in a ring of so many places, of which others have permits.
    pub(super) fn has_place<'a>(
        &self,
        tracks: &Tracks,
        permits: impl Iterator<Item = &'a Permit>,
        id: u32,
        places: usize,
    ) -> bool {
        let taken: usize = permits.map(|permit| self.needs(tracks, permit.id, places)).sum();
        taken + self.needs(tracks, id, places) <= places
    }

    /// How many of the places of a ring one takes: who is longer than a car stands in two of its junctions.
    fn needs(&self, tracks: &Tracks, id: u32, places: usize) -> usize {
        let is_long = self.find(tracks, id).is_some_and(|(_, vehicle, _)| vehicle.is_long());
        (1 + usize::from(is_long)).min(places)
    }

    /// The lane for room on which the holder of a permit has long waited: it may wait for somebody before its cluster, who comes in if he
    /// leaves it its way.
    fn lacks(&self, tracks: &Tracks, config: &TrafficConfig, permit: &Permit) -> Option<Track> {
        let (_, holder, _) = self.find(tracks, permit.id)?;
        self.waits_for(tracks, config, holder)
    }

    /// Whether another would meet the holder of a permit, who waits for room, on his way.
    fn is_met(&self, tracks: &Tracks, permit: &Permit, wish: &Wish) -> bool {
        let holder = self.find(tracks, permit.id);
        holder.is_none_or(|(_, holder, _)| {
            tracks.conflicts[holder.next as usize].iter().any(|other| other.way == wish.way)
        })
    }

    /// Whether the holder of a permit waits for room where another stands.
    fn is_kept_by(&self, tracks: &Tracks, config: &TrafficConfig, permit: &Permit, wish: &Wish) -> bool {
        let lane = self.lacks(tracks, config, permit);
        lane.is_some_and(|lane| self.find(tracks, wish.id).is_some_and(|(track, ..)| track == lane))
    }

    /// Whether saved permits are of this network.
    pub(in crate::vehicle) fn permits_fit(&self) -> bool {
        self.permits.iter().all(|permit| (permit.id as usize) < self.numbers() && permit.unused.is_finite())
    }
}
