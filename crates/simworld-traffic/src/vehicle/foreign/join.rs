//! How a free body comes back among the vehicles of a lane.

use simworld_core::geometry::{planar, yaw_of};
use simworld_core::id::LaneId;
use simworld_core::net::polyline::{self, Closest};
use simworld_core::ops::wrap_angle;
use simworld_core::seed::Stream;

use super::controls::FreeVehicle;
use crate::takeover::ControlError;
use crate::vehicle::manager::{NONE, Vehicle, VehicleManager};
use crate::vehicle::tracks::{Track, Tracks};
use crate::vehicle::trips::entry::route_way;
use crate::{Leg, Route, TrafficConfig};

/// Who faces farther away than this from where a lane leads is not on its way, radians.
const ASTRAY: f64 = std::f64::consts::FRAC_PI_4;
/// Room that one keeps behind one's bumpers, m.
const ROOM: f64 = 0.5;
/// A body glides to the middle of its lane over so much of the road for each metre that it is beside it, m, and is put there
/// at once if it is no farther off than this.
const GLIDE: f64 = 4.0;
const BESIDE: f64 = 0.5;

/// A place in a lane: the lane, how far off its middle the body is, and the station of its front.
struct Place {
    lane: Track,
    near: Closest,
    front: f64,
}

/// Nobody is near enough to any lane.
const NO_LANE: &str = "no lane of its kind passes under it and leads where it faces: bring it on to a lane";

impl VehicleManager {
    /// Puts a free body back on the nearest lane that leads on.
    ///
    /// # Errors
    /// It is free no more, or why it finds no place there; then it stays a free body.
    pub(crate) fn join(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        streams: Stream,
        lanes: impl Iterator<Item = Track>,
        id: u32,
    ) -> Result<(), ControlError> {
        let (wanted, mend) = ("a free body", "take it over first");
        let not_free = ControlError::NotSo { what: "vehicle", id, wanted, mend };
        let free = *self.controls.free.get(&id).ok_or(not_free)?;
        let at = planar(&free.pose);
        let refused = |reason| ControlError::NoPlace { what: "vehicle", id, at, reason };
        let mut places: Vec<Place> = lanes.filter_map(|lane| place(tracks, config, &free, lane)).collect();
        places.sort_by(|a, b| a.near.distance.total_cmp(&b.near.distance).then(a.lane.cmp(&b.lane)));
        let mut reason = NO_LANE;
        for place in places {
            match self.find_way(tracks, &free, place.lane) {
                Ok(route) => {
                    let (rank, shift) = self.check_room(tracks, config, &free, &place).map_err(refused)?;
                    self.put_back(tracks, config, streams, &free, &place, route, rank, shift);
                    return Ok(());
                }
                Err(why) => reason = why,
            }
        }
        Err(refused(reason))
    }

    /// The route on from a lane; none for who turns at random.
    fn find_way(
        &self,
        tracks: &Tracks,
        free: &FreeVehicle,
        lane: Track,
    ) -> Result<Option<Route>, &'static str> {
        let here = Leg::of(&tracks.network, LaneId(lane));
        match self.routes.get(free.path.route as usize).and_then(|route| route.0.last()) {
            Some(goal) => self
                .closures
                .quickest(tracks, here, *goal)
                .map(Some)
                .ok_or("from its lane no open way leads to the end of its route: bring it to another"),
            None if tracks.network.lanes[lane as usize].outgoing.is_empty() => {
                Err("its lane leads nowhere: bring it to another")
            }
            None => Ok(None),
        }
    }

    /// The rank in the queue of a place, and how far beside the middle one begins; or why there is no room.
    fn check_room(
        &self,
        tracks: &Tracks,
        config: &TrafficConfig,
        free: &FreeVehicle,
        place: &Place,
    ) -> Result<(usize, f32), &'static str> {
        let (vehicle, driver) = (&free.vehicle, &config.vehicle_type(free.vehicle.row).driver);
        let (v, s, rear) = (free.speed(), place.front, place.front - vehicle.length());
        if self.passings.touches(place.lane) {
            return Err("somebody passes there what stands on a lane: wait until they are by");
        }
        let queue = self.queue(tracks, place.lane);
        let rank = queue.partition_point(|other| other.s >= s);
        let stopping = |speed: f64, braking: f64| speed * speed / (2.0 * braking);
        if let Some(leader) = rank.checked_sub(1).map(|ahead| &queue[ahead]) {
            let gap = leader.s - leader.length() - s;
            if gap < ROOM {
                return Err("somebody is in its place: wait until they have gone on");
            }
            let needed = stopping(v, driver.emergency_deceleration)
                - stopping(leader.v, driver.emergency_deceleration);
            if gap < needed {
                return Err("it is too fast for the vehicle ahead of it: slow down first");
            }
        }
        if let Some(follower) = queue.get(rank) {
            let gap = rear - follower.s;
            if gap < ROOM {
                return Err("somebody is in its place: wait until they have gone on");
            }
            let braking = config.vehicle_type(follower.row).driver.emergency_deceleration;
            if gap < stopping(follower.v, braking) - stopping(v, braking) {
                return Err("the vehicle behind it could not stop: wait until it has, or go faster");
            }
        } else if rear < self.junctions.inbound(place.lane) {
            return Err("those who cross the junction behind it need its place: go farther, or wait");
        }
        let to_line = tracks.length[place.lane as usize] - s;
        if to_line < stopping(v, driver.emergency_deceleration) {
            return Err("it is too fast to stop at the end of its lane: slow down first");
        }
        let aside = place.near.lateral;
        match aside.abs() {
            off if to_line > GLIDE * off + 1.0 => Ok((rank, aside as f32)),
            off if off <= BESIDE => Ok((rank, 0.0)),
            _ => Err("it is too far beside its lane so near to the end of it: bring it to the middle"),
        }
    }

    #[expect(clippy::too_many_arguments, reason = "who, where, in which state, and what drivers go by")]
    fn put_back(
        &mut self,
        tracks: &Tracks,
        config: &TrafficConfig,
        streams: Stream,
        free: &FreeVehicle,
        place: &Place,
        route: Option<Route>,
        rank: usize,
        shift: f32,
    ) {
        let lane = place.lane;
        let row = config.vehicle_type(free.vehicle.row);
        let mut path = free.path;
        (path.before, path.route, path.leg) = (lane, NONE, 0);
        // Its trip goes on where it is now.
        let speed = row.free_speed(config, free.vehicle.factor, tracks.speed[lane as usize]);
        path.add(-place.front, -place.front / speed);
        if let Some(route) = route {
            path.route = self.add_route(route);
        }
        let mut vehicle = Vehicle { s: place.front, v: free.speed(), shift, ..free.vehicle };
        vehicle.next = match self.routes.get(path.route as usize) {
            Some(route) => route_way(tracks, &self.closures, route, &path, lane, row.kind),
            None => self.choose((tracks, config), streams, &mut Vec::new(), &vehicle, &mut path, lane),
        };
        self.storage.add(lane, &vehicle, config);
        let at = tracks.layout.place(lane);
        let part = &mut self.parts[at.part as usize];
        part.slabs.insert(at.local as usize, rank, vehicle, path);
        if shift != 0.0 {
            part.shifting.push((at.local, vehicle.id));
        }
        self.whereabouts.set(vehicle.id as usize, lane);
        self.controls.free.remove(&vehicle.id);
    }
}

impl FreeVehicle {
    /// How fast it goes ahead, m/s.
    fn speed(&self) -> f64 {
        let ahead = self.pose.rotation * simworld_core::geometry::Vector3::x();
        self.twist.linear.dot(&ahead).max(0.0)
    }
}

/// Where a body would be in a lane, if it is one for it, and under it, and leads where it faces.
fn place(tracks: &Tracks, config: &TrafficConfig, free: &FreeVehicle, lane: Track) -> Option<Place> {
    let row = config.vehicle_type(free.vehicle.row);
    let (path, end) = (tracks.path(lane), tracks.length[lane as usize]);
    let near = polyline::closest(path, &planar(&free.pose))?;
    let lane_yaw = polyline::at(path, near.station).1;
    let front = near.station + free.vehicle.length() * 0.5;
    let is_whole = front - free.vehicle.length() > ROOM && front < end - ROOM;
    let is_on = near.distance <= tracks.network.lanes[lane as usize].width * 0.5;
    let faces = wrap_angle(yaw_of(&free.pose) - lane_yaw).abs() < ASTRAY;
    (tracks.may_use(lane, row.kind) && is_whole && is_on && faces).then_some(Place { lane, near, front })
}
