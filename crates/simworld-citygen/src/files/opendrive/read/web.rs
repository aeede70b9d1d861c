//! Roads as they hang together: which ends meet, and roads that follow each other as one.

use std::collections::BTreeMap;

use petgraph::unionfind::UnionFind;
use simworld_core::geometry::Point2;
use simworld_core::net::polyline;

use super::document::{Link, Road, Roads};
use super::lanes::Leads;
use super::{heights, section};

/// Ends without a link that lie nearer to each other than this meet, m.
const TOUCHING: f64 = 1.0;
/// A road shorter than this takes the cross-section of the road that it follows, m.
const SHORT: f64 = 30.0;

/// A place where roads end.
#[derive(Clone, Debug, Default)]
pub(super) struct Place {
    /// The roads that end there, and which of their ends do; one that ends there twice stands there twice.
    pub(super) members: Vec<(usize, usize)>,
    pub(super) is_junction: bool,
    pub(super) has_signals: bool,
}

/// Roads between places.
#[derive(Debug, Default)]
pub(super) struct Web {
    /// A road and the places of its ends; roads that were taken away are none.
    pub(super) roads: Vec<Option<(Road, [usize; 2])>>,
    pub(super) places: Vec<Place>,
}

/// Finds out which ends of the roads outside of junctions meet; hands on which lane leads to which.
pub(super) fn web_of(roads: Roads) -> (Web, Leads) {
    let (inner, outer): (Vec<Road>, Vec<Road>) =
        roads.all.into_iter().partition(|road| road.junction.is_some());
    // The first and the last part of each road.
    let mut numbers: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
    for (index, road) in outer.iter().enumerate() {
        numbers.entry(road.id.as_str()).or_insert([index; 2])[1] = index;
    }
    let end_of = |id: &str, at_end: bool| {
        numbers.get(id).map(|parts| 2 * parts[usize::from(at_end)] + usize::from(at_end))
    };
    let within: BTreeMap<&str, &str> =
        inner.iter().filter_map(|road| Some((road.id.as_str(), road.junction.as_deref()?))).collect();
    let linked = outer.iter().flat_map(|road| &road.links).flatten().filter_map(|link| match link {
        Link::Junction(id) => Some(id.as_str()),
        Link::Road(..) | Link::Part => None,
    });
    let mut junctions: Vec<&str> = linked.chain(within.values().copied()).collect();
    junctions.sort_unstable();
    junctions.dedup();
    let junction = |id: &str| junctions.binary_search(&id).ok().map(|index| 2 * outer.len() + index);
    let mut meeting = UnionFind::<usize>::new(2 * outer.len() + junctions.len());
    for (index, road) in outer.iter().enumerate() {
        for end in 0..2 {
            let other = match &road.links[end] {
                Some(Link::Junction(id)) => junction(id),
                Some(Link::Road(id, at_end)) => {
                    end_of(id, *at_end).or_else(|| within.get(id.as_str()).and_then(|id| junction(id)))
                }
                Some(Link::Part) if end == 0 => Some(2 * index - 1),
                Some(Link::Part) | None => None,
            };
            other.map(|other| meeting.union(2 * index + end, other));
        }
    }
    for road in &inner {
        let place = road.junction.as_deref().and_then(junction);
        for link in road.links.iter().flatten() {
            if let (Link::Road(id, at_end), Some(place)) = (link, place)
                && let Some(other) = end_of(id, *at_end)
            {
                meeting.union(other, place);
            }
        }
    }
    join_touching(&outer, &mut meeting);
    let signals: Vec<bool> = junctions.iter().map(|id| roads.signalised.contains(*id)).collect();
    let (places, ends) = places(outer.len(), &signals, &meeting);
    (Web { roads: outer.into_iter().zip(ends).map(Some).collect(), places }, roads.leads)
}

/// The places where the ends of so many roads meet, and those of each road. `signals` says which junctions have them: in
/// `meeting` they come after the ends of roads.
fn places(roads: usize, signals: &[bool], meeting: &UnionFind<usize>) -> (Vec<Place>, Vec<[usize; 2]>) {
    let mut labels: Vec<Option<usize>> = vec![None; 2 * roads + signals.len()];
    let mut places: Vec<Place> = Vec::new();
    let mut label = |key: usize, places: &mut Vec<Place>| {
        *labels[meeting.find(key)].get_or_insert_with(|| {
            places.push(Place::default());
            places.len() - 1
        })
    };
    for (index, has_signals) in signals.iter().enumerate() {
        let place = label(2 * roads + index, &mut places);
        places[place].is_junction = true;
        places[place].has_signals |= has_signals;
    }
    let ends: Vec<[usize; 2]> =
        (0..roads).map(|road| [0, 1].map(|end| label(2 * road + end, &mut places))).collect();
    for (road, ends) in ends.iter().enumerate() {
        for (end, place) in ends.iter().enumerate() {
            places[*place].members.push((road, end));
        }
    }
    (places, ends)
}

/// Ends without a link meet where they touch.
fn join_touching(roads: &[Road], meeting: &mut UnionFind<usize>) {
    let cell = |point: &Point2| ((point.x / TOUCHING).floor() as i64, (point.y / TOUCHING).floor() as i64);
    let end_of =
        |road: &Road, end: usize| if end == 0 { road.line[0] } else { road.line[road.line.len() - 1] };
    // The first of each cell stands for all: they touch each other anyway.
    let mut cells: BTreeMap<(i64, i64), (usize, Point2)> = BTreeMap::new();
    for (index, road) in roads.iter().enumerate() {
        for end in (0..2).filter(|end| road.links[*end].is_none()) {
            let (key, at) = (2 * index + end, end_of(road, end));
            let (column, row) = cell(&at);
            for near in (column - 1..=column + 1).flat_map(|x| (row - 1..=row + 1).map(move |y| (x, y))) {
                if let Some((other, there)) = cells.get(&near)
                    && (there - at).norm() < TOUCHING
                {
                    meeting.union(key, *other);
                }
            }
            cells.entry((column, row)).or_insert((key, at));
        }
    }
}

impl Web {
    /// The roads that are there.
    pub(super) fn living(&self) -> impl Iterator<Item = (usize, &Road, [usize; 2])> {
        self.roads
            .iter()
            .enumerate()
            .filter_map(|(index, road)| road.as_ref().map(|(road, ends)| (index, road, *ends)))
    }

    /// Takes a road away.
    pub(super) fn remove(&mut self, road: usize) -> Option<Road> {
        let (road_, ends) = self.roads.get_mut(road)?.take()?;
        for end in ends {
            self.places[end].members.retain(|member| member.0 != road);
        }
        Some(road_)
    }

    /// Makes one place of two.
    pub(super) fn merge(&mut self, from: usize, into: usize) {
        let place = std::mem::take(&mut self.places[from]);
        for (road, end) in &place.members {
            if let Some((_, ends)) = &mut self.roads[*road] {
                ends[*end] = into;
            }
        }
        let kept = &mut self.places[into];
        kept.members.extend(place.members);
        kept.has_signals |= place.has_signals;
        kept.is_junction = true;
    }

    /// Makes one road of two that follow each other alike, where nothing else meets.
    pub(super) fn join_alike(&mut self) {
        for place in 0..self.places.len() {
            let [(first, at_first), (second, at_second)] = self.places[place].members[..] else { continue };
            if first != second && !self.places[place].is_junction {
                self.join(first, at_first, second, at_second);
            }
        }
    }

    fn join(&mut self, first: usize, at_first: usize, second: usize, at_second: usize) {
        let (Some((a, a_ends)), Some((b, b_ends))) = (&self.roads[first], &self.roads[second]) else {
            return;
        };
        // Both run from the far end of the first over the place to the far end of the second.
        let a = if at_first == 1 { a.clone() } else { reversed(a) };
        let b = if at_second == 0 { b.clone() } else { reversed(b) };
        let (start, end) = (a_ends[1 - at_first], b_ends[1 - at_second]);
        let lengths = [polyline::length(&a.line), polyline::length(&b.line)];
        let is_alike = section::is_alike(&a.section, &b.section);
        if !is_alike && lengths[0].min(lengths[1]) >= SHORT {
            return;
        }
        // Both ends may lie a little apart.
        let gap = (b.line[0] - a.line[a.line.len() - 1]).norm();
        let heights = heights::joined(&a.heights, &b.heights, lengths[0] + gap);
        let (mut kept, other) = if lengths[0] >= lengths[1] { (a.clone(), &b) } else { (b.clone(), &a) };
        if kept.name.is_empty() {
            kept.name.clone_from(&other.name);
        }
        kept.line = [&a.line[..], &b.line[..]].concat();
        kept.line.dedup_by(|p, q| (*p - *q).norm() < 0.01);
        kept.heights = heights;
        // Over the lanes of a short one that is unlike those of the longer one lead on.
        if is_alike {
            kept.lanes = [a.lanes[0].clone(), b.lanes[1].clone()];
        }
        self.remove(first);
        self.remove(second);
        self.places[start].members.push((first, 0));
        self.places[end].members.push((first, 1));
        self.roads[first] = Some((kept, [start, end]));
    }
}

/// A road seen from its other end.
fn reversed(road: &Road) -> Road {
    let lanes = |end: usize| road.lanes[end].iter().rev().copied().collect();
    Road {
        line: polyline::reversed(&road.line),
        heights: heights::reversed(&road.heights, polyline::length(&road.line)),
        section: section::mirrored(&road.section),
        lanes: [lanes(1), lanes(0)],
        ..road.clone()
    }
}
