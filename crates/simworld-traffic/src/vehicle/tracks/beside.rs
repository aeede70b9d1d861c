//! Ways that nobody said to meet, and on which vehicles of some sizes touch all the same.
//!
//! A network says of two ways that they meet if their paths come nearer than a vehicle is wide. Beyond that it depends on who
//! comes: two cars pass where a lorry that turns would touch another, and a bus whoever is beside it.

use simworld_core::id::ConnectionId;
use simworld_core::lists::Lists;
use simworld_core::net::RoadNetwork;

use super::conflicts::Conflict;
use super::swept::{Size, Sweep};
use crate::TrafficConfig;
use crate::vehicle::types::is_long;

/// Up to this length it is a car or a van, m; beyond, up to a long vehicle, a lorry.
const CAR: f64 = 6.0;

/// Which vehicles of two sizes touch on two ways: a bit for each pair of cars and lorries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Pairs(u8);

impl Pairs {
    /// All of them.
    pub(crate) const ALL: Self = Self(0b1111);

    /// Whether one of a length touches one of another length on the other way.
    #[inline]
    pub(crate) fn has(self, own: f64, other: f64) -> bool {
        self.0 >> Self::rank(own > CAR, other > CAR) & 1 == 1
    }

    fn rank(own_is_lorry: bool, other_is_lorry: bool) -> u8 {
        2 * u8::from(own_is_lorry) + u8::from(other_is_lorry)
    }

    /// The same, seen from the other way.
    fn turned(self) -> Self {
        let (one, two) = (self.0 >> 1 & 1, self.0 >> 2 & 1);
        Self(self.0 & 0b1001 | one << 2 | two << 1)
    }
}

/// What there is beside each way.
#[derive(Clone, Debug)]
pub(crate) struct Beside {
    /// The conflicts that short vehicles have there.
    pub(crate) short: Vec<Vec<Conflict>>,
    /// The ways on which nobody may be while a long vehicle is on this one, and the other way round.
    pub(crate) tight: Lists<u32>,
    /// The ways on which no long vehicle may be while another is on this one.
    pub(crate) narrow: Lists<u32>,
}

/// What bodies of each size sweep over on one way.
struct Sweeps {
    car: Option<Sweep>,
    lorry: Option<Sweep>,
    long: Option<Sweep>,
}

impl Beside {
    pub(crate) fn new(network: &RoadNetwork, config: &TrafficConfig) -> Self {
        let sizes = || config.types.iter().map(|row| Size { length: row.length, width: row.width });
        let car = Size::around(sizes().filter(|size| size.length <= CAR));
        let lorry = Size::around(sizes().filter(|size| !is_long(size.length)));
        let long = Size::around(sizes());
        let count = network.connections.len();
        let mut short = vec![Vec::new(); count];
        let (mut tight, mut narrow) = (vec![Vec::new(); count], vec![Vec::new(); count]);
        for place in &network.intersections {
            let of = |id: &ConnectionId| {
                let sweep = |size| Sweep::new(network, &network.connections[id.index()], size);
                Sweeps { car: car.map(sweep), lorry: lorry.map(sweep), long: long.map(sweep) }
            };
            let sweeps: Vec<Sweeps> = place.connections.iter().map(of).collect();
            for (rank, a) in place.connections.iter().enumerate() {
                for (other, b) in place.connections.iter().enumerate().skip(rank + 1) {
                    if !are_beside(network, *a, *b) {
                        continue;
                    }
                    let (own, others) = (&sweeps[rank], &sweeps[other]);
                    if !touch(own.long.as_ref(), others.long.as_ref()) {
                        continue;
                    }
                    let with_any = touch(own.long.as_ref(), others.lorry.as_ref())
                        || touch(own.lorry.as_ref(), others.long.as_ref());
                    let list = if with_any { &mut tight } else { &mut narrow };
                    list[a.index()].push(b.0);
                    list[b.index()].push(a.0);
                    if let Some((mine, theirs)) = own.conflict(others, (*a, *b)) {
                        short[a.index()].push(mine);
                        short[b.index()].push(theirs);
                    }
                }
            }
        }
        Self { short, tight: tight.into_iter().collect(), narrow: narrow.into_iter().collect() }
    }
}

/// Whether vehicles from different lanes go on the two to different lanes, and the network does not say that they meet.
fn are_beside(network: &RoadNetwork, a: ConnectionId, b: ConnectionId) -> bool {
    let (own, other) = (&network.connections[a.index()], &network.connections[b.index()]);
    own.from != other.from && own.to != other.to && !own.conflicts.contains(&b)
}

/// Whether two bodies touch, if vehicles of both sizes exist.
fn touch(own: Option<&Sweep>, other: Option<&Sweep>) -> bool {
    own.zip(other).is_some_and(|(own, other)| own.touches(other))
}

impl Sweeps {
    /// What short vehicles on the two ways mind of each other, as seen from either; `None` if they do not touch. Neither gives
    /// way: who has leave first goes first.
    fn conflict(&self, other: &Self, (a, b): (ConnectionId, ConnectionId)) -> Option<(Conflict, Conflict)> {
        let (mine, theirs) = self.lorry.as_ref()?.meets(other.lorry.as_ref()?)?;
        let mut pairs = Pairs(1 << Pairs::rank(true, true));
        for (own_is_lorry, other_is_lorry) in [(false, false), (false, true), (true, false)] {
            let own = if own_is_lorry { &self.lorry } else { &self.car };
            let others = if other_is_lorry { &other.lorry } else { &other.car };
            pairs.0 |=
                u8::from(touch(own.as_ref(), others.as_ref())) << Pairs::rank(own_is_lorry, other_is_lorry);
        }
        let conflict = |way: ConnectionId, pairs, own, other| Conflict {
            way: way.0,
            yields: false,
            critical: 0.0,
            merges: false,
            pairs,
            own,
            other,
        };
        Some((conflict(b, pairs, mine, theirs), conflict(a, pairs.turned(), theirs, mine)))
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::net::{NetworkConfig, StreetPlan};
    use simworld_core::seed::Seed;

    use super::super::conflicts::conflicts;
    use super::*;

    /// Junctions of three to five arms at any angles that leave room, narrow and wide ones.
    fn junctions() -> Vec<RoadNetwork> {
        let mut rng = Seed(3).stream("beside").rng();
        let mut plans = vec![StreetPlan::crossroads(80.0)];
        for arms in [2, 3, 3, 4, 4, 5] {
            let mut plan = StreetPlan::crossroads(80.0);
            let (turn, share) = (rng.uniform(0.0, 1.0), std::f64::consts::TAU / f64::from(arms));
            plan.nodes.truncate(1);
            plan.streets.truncate(1);
            let street = plan.streets[0].clone();
            plan.streets.clear();
            for arm in 0..arms {
                let heading = turn + share * (f64::from(arm) + rng.uniform(-0.2, 0.2));
                plan.nodes.push(plan.nodes[0] + simworld_core::geometry::direction(heading) * 80.0);
                let to = plan.nodes.len() - 1;
                plan.streets.push(simworld_core::net::Street { from: 0, to, ..street.clone() });
            }
            plans.push(plan);
        }
        let derive = |plan| RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("it is a plan");
        plans.into_iter().map(derive).collect()
    }

    #[test]
    fn who_goes_at_the_same_time_touches_nobody() {
        let config = TrafficConfig::default();
        let size = |length, width| Size { length, width };
        let (car, lorry) = (size(4.5, 1.8), size(7.1, 2.4));
        let mut met = [0; 2];
        for network in junctions() {
            let beside = Beside::new(&network, &config);
            let all = conflicts(&network, &config, beside.short);
            for (index, own) in network.connections.iter().enumerate() {
                for (other_index, other) in network.connections.iter().enumerate() {
                    if own.from == other.from || own.intersection != other.intersection {
                        continue;
                    }
                    let known = all[index].iter().find(|known| known.way as usize == other_index);
                    for (mine, theirs) in [(car, car), (car, lorry), (lorry, car), (lorry, lorry)] {
                        let minds = known.is_some_and(|known| known.pairs.has(mine.length, theirs.length));
                        let [mine, theirs] =
                            [(own, mine), (other, theirs)].map(|(way, size)| Sweep::new(&network, way, size));
                        met[usize::from(minds)] += 1;
                        assert!(minds || !mine.touches(&theirs), "{own:?} and {other:?}");
                    }
                }
            }
        }
        assert!(met[0] > 200 && met[1] > 200, "{met:?}");
    }

    #[test]
    fn of_two_sizes_either_is_asked_for_its_own() {
        let pairs = Pairs(1 << Pairs::rank(true, false) | 1 << Pairs::rank(true, true));
        assert!(pairs.has(7.0, 4.5) && pairs.has(7.0, 7.0) && !pairs.has(4.5, 7.0) && !pairs.has(4.5, 4.5));
        assert!(pairs.turned().has(4.5, 7.0) && !pairs.turned().has(7.0, 4.5));
        assert_eq!(pairs.turned().turned(), pairs);
    }
}
