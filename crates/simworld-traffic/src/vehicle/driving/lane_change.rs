//! Lane changes: MOBIL for those who would be faster beside, and whatever it takes for those whose way leads on from there.
//!
//! A vehicle enters the queue of its new lane at once and moves over in some seconds; meanwhile it stands in both: those behind
//! it in the old lane [see it there](crate::vehicle::queues::ghosts), and it minds who is before it in either.

use simworld_core::net::DrivingSide;

use super::mobil::Stay;
use crate::Leg;
use crate::takeover::LaneWish;
use crate::vehicle::VehicleKind;
use crate::vehicle::junctions::patience::PATIENCE;
use crate::vehicle::manager::{EXIT, NONE, Vehicle, VehicleManager};
use crate::vehicle::part::Part;
use crate::vehicle::queues::ghosts::{BLOCK_SEEN, Ghost, first_block, sort};
use crate::vehicle::queues::path::Path;
use crate::vehicle::queues::slabs::Cursor;
use crate::vehicle::scene::Scene;
use crate::vehicle::tracks::closures::Closures;
use crate::vehicle::tracks::{Track, Tracks};

/// Sideways speed of a change, m/s, and its bound as a share of the speed ahead.
const SIDEWAYS: f64 = 1.2;
pub(super) const STEEPNESS: f64 = 0.25;
/// With less than this to its new lane's middle a body is out of its old lane, m: less where lanes are narrow, so that this
/// wide a body passes.
const OUT: f64 = 0.5;
const PASSES: f64 = 2.0;
/// Nobody changes with a rear nearer to the junction behind, m.
const CLEAR: f64 = 12.0;
/// A change of lanes takes so much of the road even at a walk, m: four metres aside at the greatest steepness.
pub(in crate::vehicle) const CHANGE_ROOM: f64 = 4.0 / STEEPNESS + 1.0;
/// One begins no change for speed that would not be done this long before the stop line, s.
const BEFORE_LINE: f64 = 5.0;
/// Why a vehicle changes lanes.
struct Wish {
    /// To which side somebody told it to go.
    asked: Option<LaneWish>,
    /// Its lane does not lead on.
    lost: bool,
    /// It is to halt.
    to_kerb: bool,
    /// It changes for any of these, or for what blocks its lane or comes with a siren; else only if it gains.
    must: bool,
}

impl Wish {
    /// Whether a lane beside is on the wrong side.
    fn is_against(&self, tracks: &Tracks, lane: Track, target: Track) -> bool {
        let is_left = tracks.beside[lane as usize][0] == target;
        match self.asked {
            Some(wish) => is_left != (wish == LaneWish::Left),
            None => self.to_kerb && is_left != (tracks.network.driving_side == DrivingSide::Left),
        }
    }
}

impl Part {
    /// Moves those over who are changing, and lists where they still are.
    pub(in crate::vehicle) fn shift(&mut self, scene: &Scene<'_>) {
        let mut shifting = std::mem::take(&mut self.shifting);
        self.lay_ghosts();
        let layout = self.layout(scene.tracks);
        self.show_blocks(scene);
        shifting.retain(|(local, id)| {
            let lane = layout.tracks[*local as usize];
            let queue = self.slabs.queue_mut(*local as usize);
            let Some(vehicle) = queue.iter_mut().find(|v| v.id == *id) else { return false };
            let step = sideways(vehicle.v) * scene.at.dt;
            let left = f64::from(vehicle.shift.abs()) - step;
            vehicle.shift = if left <= 0.0 { 0.0 } else { (left as f32).copysign(vehicle.shift) };
            let changes = vehicle.shift != 0.0;
            if let Some(old) = old_lane(scene.tracks, lane, vehicle)
                && left > out(scene.tracks, lane, old)
            {
                let station = vehicle.s * stretch(scene.tracks, lane, old);
                let old = scene.tracks.layout.local(old) as u32;
                let ghost = Ghost::of(vehicle, old, station);
                self.haunt(ghost);
            }
            changes
        });
        self.shifting = shifting;
        sort(&mut self.work.ghosts);
    }

    /// Lets those change who want to and may; a fifth of the lanes in each step of a tenth of a second.
    pub(in crate::vehicle) fn change_lanes(&mut self, scene: &Scene<'_>) {
        let layout = self.layout(scene.tracks);
        let is_turn_of = scene.at.turn();
        let mut at = Cursor::default();
        while let Some(local) = self.slabs.next_at_hand(&mut at).filter(|local| *local < layout.lanes) {
            let lane = layout.tracks[local];
            if !is_turn_of(lane) || scene.tracks.beside[lane as usize] == [NONE; 2] {
                continue;
            }
            let mut rank = 0;
            while let Some(vehicle) = self.slabs.queue(local).get(rank) {
                rank += 1;
                if may_change(scene.tracks, lane, vehicle) {
                    // Who leaves makes the next take its rank.
                    rank -= usize::from(self.consider(scene, lane, rank - 1));
                }
            }
        }
    }

    /// Lets a vehicle change to the best lane beside, if it wants to and may.
    fn consider(&mut self, scene: &Scene<'_>, lane: Track, rank: usize) -> bool {
        let Some(wish) = self.wish(scene, lane, rank) else { return false };
        let queue = self.slabs.queue(scene.tracks.layout.local(lane));
        let stay = (!wish.must).then(|| Stay::new(scene, queue, rank, lane));
        let most = self.most_better(scene, (lane, rank));
        let mut best: Option<(f64, Track, u32, usize)> = None;
        for target in scene.tracks.beside[lane as usize].into_iter().filter(|target| *target != NONE) {
            let could_gain = |stay: &Stay| stay.could_gain(scene, &queue[rank], target, most);
            if !stay.as_ref().is_none_or(could_gain) || !self.may_take(scene, &wish, (lane, rank), target) {
                continue;
            }
            let Some(offer) = self.offer(scene, (lane, rank), target, stay.as_ref()) else { continue };
            // Where its way leads is far away in memory: one looks there only if that can still decide.
            if !offer.is_worth(most) {
                continue;
            }
            let Some(way) = self.way_from(scene, &wish, (lane, rank), target) else { continue };
            let better = self.leads_better(scene, (lane, rank), way);
            if offer.is_worth(better) && best.is_none_or(|best| offer.gain(better) > best.0) {
                best = Some((offer.gain(better), target, way, offer.place));
            }
        }
        let Some((_, target, way, place)) = best else { return false };
        self.move_over(scene, lane, rank, target, way, place);
        true
    }

    /// Why a vehicle would change; nothing if it stays in any case.
    fn wish(&self, scene: &Scene<'_>, lane: Track, rank: usize) -> Option<Wish> {
        let tracks = scene.tracks;
        let local = tracks.layout.local(lane);
        let vehicle = &self.slabs.queue(local)[rank];
        let asked = scene.controls.lane_wish(vehicle.id);
        let block = self.block_ahead(local, rank);
        if asked == Some(LaneWish::Keep)
            || block.is_some_and(|gap| gap < CHANGE_ROOM - 4.0)
            || stays_at_kerb(tracks, lane, vehicle)
        {
            return None; // told to, too near to get round what blocks it, or where it is to stand
        }
        // Who is before a blocked stretch leaves the lane as well, but where he goes is as it was.
        let lost = vehicle.next == NONE;
        let makes_way = scene.sirens.is_heard(lane, vehicle.s) && !scene.sirens.is_on(vehicle.id);
        // Nobody halts where he would bar a lane for all, if he can help it.
        let to_kerb =
            vehicle.halt.is_finite() && !tracks.outermost[lane as usize] && !lost && block.is_none();
        let must = lost || block.is_some() || makes_way || asked.is_some() || to_kerb;
        let to_end = tracks.length[lane as usize] - vehicle.s;
        (must || to_end >= BEFORE_LINE * vehicle.v + 10.0).then_some(Wish { asked, lost, to_kerb, must })
    }

    /// Whether a vehicle may take a lane beside if that leads on.
    fn may_take(&self, scene: &Scene<'_>, wish: &Wish, (lane, rank): (Track, usize), target: Track) -> bool {
        let tracks = scene.tracks;
        let local = tracks.layout.local(lane);
        let vehicle = &self.slabs.queue(local)[rank];
        let kind = scene.config.vehicle_type(vehicle.row).kind;
        // Where only a lane for others leads on, one takes it rather than stand for good.
        let may_use = tracks.may_use(target, kind) || (wish.lost && vehicle.stood > PATIENCE * 0.5);
        let blocked = first_block(self.ghosts(tracks.layout.local(target)), vehicle.s);
        // Nobody gets before a siren, but for who has to be there.
        let bars_siren =
            !wish.lost && scene.sirens.is_heard(target, vehicle.s) && !scene.sirens.is_on(vehicle.id);
        may_use
            && !wish.is_against(tracks, lane, target)
            && !scene.closures.has(target)
            && blocked.is_none_or(|gap| gap >= BLOCK_SEEN)
            && !bars_siren
    }

    /// The way on from a lane beside, if there is one for a vehicle.
    fn way_from(
        &self,
        scene: &Scene<'_>,
        wish: &Wish,
        (lane, rank): (Track, usize),
        target: Track,
    ) -> Option<u32> {
        let tracks = scene.tracks;
        let local = tracks.layout.local(lane);
        let vehicle = &self.slabs.queue(local)[rank];
        if vehicle.next == EXIT {
            return Some(EXIT);
        }
        let kind = scene.config.vehicle_type(vehicle.row).kind;
        let path = &self.slabs.paths(local)[rank];
        let (wanted, after) = wanted(scene, (lane, vehicle), path);
        // A lane on the way to one that leads on is a step towards it.
        let towards = |leg| {
            (wish.lost && leads_towards(tracks, scene.closures, lane, target, (leg, after), kind))
                .then_some(NONE)
        };
        // Who turns at random does not change from a way on to one that ends somewhere.
        let ends = |way: u32| {
            let leads_on = |way: u32| tracks.leads_on[tracks.lane_after(way as usize) as usize];
            path.route == NONE && !wish.lost && leads_on(vehicle.next) && !leads_on(way)
        };
        let way_to =
            |leg| tracks.way_on(scene.closures, target, (leg, after), kind).filter(|way| !ends(*way));
        let way = wanted.and_then(|leg| way_to(leg).or_else(|| towards(leg)));
        // Who drives it may leave the lane of its route.
        way.or(wish.asked.map(|_| NONE))
    }

    /// How many lanes over the nearest one is that leads one on whose own does not; one if there is none.
    pub(super) fn changes_needed(&self, scene: &Scene<'_>, lane: Track, vehicle: &Vehicle) -> usize {
        let Scene { tracks, closures, .. } = scene;
        // Where no lane lies beyond those beside there is nothing to count.
        if [0, 1].iter().all(|side| tracks.beside_on(lane, *side).nth(1).is_none()) {
            return 1;
        }
        let local = tracks.layout.local(lane);
        let rank = self.slabs.queue(local).iter().position(|other| other.id == vehicle.id);
        let Some(path) = rank.and_then(|rank| self.slabs.paths(local).get(rank)) else { return 1 };
        let (Some(leg), after) = wanted(scene, (lane, vehicle), path) else { return 1 };
        let kind = scene.config.vehicle_type(vehicle.row).kind;
        let leads_on = |lane: &Track| tracks.way_on(closures, *lane, (leg, after), kind).is_some();
        let sides = [0, 1].map(|side| tracks.beside_on(lane, side).position(|lane| leads_on(&lane)));
        sides.into_iter().flatten().min().map_or(1, |between| between + 1)
    }

    /// By how many grades another way than his own may lead a driver on better at most, along whatever route.
    fn most_better(&self, scene: &Scene<'_>, (lane, rank): (Track, usize)) -> f64 {
        let next = self.slabs.queue(scene.tracks.layout.local(lane))[rank].next;
        if next >= EXIT { 0.0 } else { f64::from(scene.tracks.most_better_than(next)) }
    }

    /// By how many grades another way than his own leads a driver on better along his route.
    fn leads_better(&self, scene: &Scene<'_>, (lane, rank): (Track, usize), way: u32) -> f64 {
        let tracks = scene.tracks;
        let local = tracks.layout.local(lane);
        let (next, path) = (self.slabs.queue(local)[rank].next, &self.slabs.paths(local)[rank]);
        let Some(route) = scene.routes.get(path.route as usize) else { return 0.0 };
        if next >= EXIT || way >= EXIT {
            return 0.0;
        }
        let after = route.0.get(path.leg as usize + 2..).unwrap_or_default();
        f64::from(tracks.serves(way, after)) - f64::from(tracks.serves(next, after))
    }

    fn move_over(
        &mut self,
        scene: &Scene<'_>,
        lane: Track,
        rank: usize,
        target: Track,
        way: u32,
        place: usize,
    ) {
        let tracks = scene.tracks;
        let (from, to) = (tracks.layout.local(lane), tracks.layout.local(target));
        let Some((mut vehicle, mut path)) = self.slabs.remove(from, rank) else { return };
        let station = vehicle.s;
        vehicle.s *= stretch(tracks, lane, target);
        vehicle.halt *= stretch(tracks, lane, target) as f32;
        vehicle.next = way;
        let to_left = tracks.beside[lane as usize][0] == target;
        let apart = tracks.apart(lane, target) as f32;
        // It still stands in its old lane: to the right of the new one if it goes left.
        vehicle.shift = if to_left { -apart } else { apart };
        path.before = target;
        scene.storage.take(lane, &vehicle, scene.config);
        scene.storage.add(target, &vehicle, scene.config);
        scene.whereabouts.set(vehicle.id as usize, target);
        self.haunt(Ghost::of(&vehicle, from as u32, station));
        sort(&mut self.work.ghosts);
        self.shifting.push((to as u32, vehicle.id));
        self.slabs.insert(to, place, vehicle, path);
        self.work.counters.lane_changes += 1;
    }
}

/// The leg to which a driver wants to go next, as he was told or by his route, and those after it.
fn wanted<'a>(
    scene: &Scene<'a>,
    (lane, vehicle): (Track, &Vehicle),
    path: &Path,
) -> (Option<Leg>, &'a [Leg]) {
    let own = || VehicleManager::next_leg(scene.tracks, scene.routes, (lane, vehicle), path);
    let route = scene.routes.get(path.route as usize);
    let after = route.and_then(|route| route.0.get(path.leg as usize + 2..)).unwrap_or_default();
    (scene.controls.next_leg(vehicle.id).or_else(own), after)
}

/// How quickly a vehicle moves aside at a speed, m/s.
pub(in crate::vehicle) fn sideways(v: f64) -> f64 {
    SIDEWAYS.min(STEEPNESS * v)
}

/// How much longer one lane is than another beside it: stations along them are in proportion.
pub(in crate::vehicle) fn stretch(tracks: &Tracks, from: Track, to: Track) -> f64 {
    tracks.length[to as usize] / tracks.length[from as usize]
}

/// How far from the junction behind a rear must be for a change, m; less on lanes that would leave no room for it.
pub(in crate::vehicle) fn clear(lane: f64, vehicle: &Vehicle) -> f64 {
    (lane - vehicle.length() - CHANGE_ROOM - 2.5).clamp(1.0, CLEAR)
}

/// Whole in its lane, with no leave to cross, clear of the junction behind and not yet at the line before it.
fn may_change(tracks: &Tracks, lane: Track, vehicle: &Vehicle) -> bool {
    vehicle.shift == 0.0
        && vehicle.holding == NONE
        && vehicle.s - vehicle.length() > clear(tracks.length[lane as usize], vehicle)
        && tracks.length[lane as usize] - vehicle.s > CHANGE_ROOM
}

/// How near to the middle of its new lane a body must be to be out of the old one, m.
pub(in crate::vehicle) fn out(tracks: &Tracks, lane: Track, old: Track) -> f64 {
    (tracks.apart(lane, old) - PASSES).clamp(0.0, OUT)
}

/// The lane that a vehicle has not quite left.
pub(in crate::vehicle) fn old_lane(tracks: &Tracks, lane: Track, vehicle: &Vehicle) -> Option<Track> {
    let [left, right] = tracks.beside[lane as usize];
    let old = if vehicle.shift > 0.0 { left } else { right };
    (old != NONE).then_some(old)
}

/// Whether a lane that leads to a leg lies beyond `target`, seen from `lane`.
fn leads_towards(
    tracks: &Tracks,
    closures: &Closures,
    lane: Track,
    target: Track,
    legs: (Leg, &[Leg]),
    kind: VehicleKind,
) -> bool {
    let side = usize::from(tracks.beside[lane as usize][1] == target);
    let mut next = tracks.beside[target as usize][side];
    while next != NONE {
        if tracks.way_on(closures, next, legs, kind).is_some() {
            return true;
        }
        next = tracks.beside[next as usize][side];
    }
    false
}

/// Whether a vehicle is where it is to halt, or there in a moment.
fn stays_at_kerb(tracks: &Tracks, lane: Track, vehicle: &Vehicle) -> bool {
    let is_near = f64::from(vehicle.halt) - vehicle.s < CHANGE_ROOM;
    vehicle.halt.is_finite() && (tracks.outermost[lane as usize] || is_near)
}

#[cfg(test)]
mod tests {
    use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
    use simworld_core::seed::Seed;

    use super::*;
    use crate::vehicle::clock::Moment;
    use crate::vehicle::scene::Sight;
    use crate::{Route, TrafficConfig};

    #[test]
    fn lanes_are_counted_to_the_nearest_that_leads_on() {
        let mut plan = StreetPlan::crossroads(150.0);
        plan.sections = vec![simworld_core::net::CrossSection::two_way(3, 3)];
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("it is a plan");
        let config = TrafficConfig::default();
        let tracks = Tracks::new(std::sync::Arc::new(network), &config);
        let leads_to = |lane: Track, leg: Leg| tracks.exits(lane).iter().any(|(_, to)| *to == leg);
        // From a lane at the side, a leg to which only that on the other side leads.
        let across = |lane: Track| {
            let beside: Vec<Track> = tracks.all_beside(lane).collect();
            let [middle, far] = beside[..] else { return None };
            let legs = tracks.exits(far).iter().map(|(_, leg)| *leg);
            let mut only_there = legs.filter(|leg| !leads_to(lane, *leg) && !leads_to(middle, *leg));
            let is_aside = tracks.beside[lane as usize].contains(&NONE);
            only_there.next().filter(|_| is_aside).map(|leg| ([lane, middle, far], leg))
        };
        let (lanes, goal) =
            (0..tracks.lanes as Track).find_map(across).expect("one turns left from the left");
        let mut vehicles = VehicleManager::new(&tracks);
        let own = Leg::of(&tracks.network, simworld_core::id::LaneId(lanes[0]));
        let route = vehicles.add_route(Route(vec![own, goal]));
        for (id, lane) in lanes.into_iter().enumerate() {
            let car = Vehicle::new(config.vehicle_type(0), 0, 1.0, id as u32, 60.0);
            vehicles.whereabouts.push(lane);
            vehicles.push(&tracks, lane, car, Path::new(lane, route, 0.0, 0.0));
        }
        let zeros = vec![0; tracks.network.crossings.len()];
        let sight = Sight { aspects: &[], shown: &[], walkers: &zeros, waiting: &zeros, obstacles: &[] };
        let at = Moment { now: 0.0, dt: 0.1, step: 0 };
        let scene = vehicles.scene(&tracks, &config, sight, Seed(1).stream("cars"), at);
        let needed = lanes.map(|lane| {
            let part = &vehicles.parts[tracks.layout.place(lane).part as usize];
            part.changes_needed(&scene, lane, &vehicles.queue(&tracks, lane)[0])
        });
        assert_eq!(needed[..2], [2, 1], "from the right and from the middle");
    }
}
