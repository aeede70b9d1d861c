//! Lanes as a file links them: which one leads to which, along roads, from road to road and over junctions.
//!
//! Source: ASAM OpenDRIVE 1.7.0, chapters 9.3 and 10. A link may stand at either of the two lanes that it joins, or at both.

use std::collections::{BTreeMap, BTreeSet};

use roxmltree::Node;

use super::document::{Link, child, link, number};
use super::error::OpenDriveWarning;
use super::section;

/// A lane of one section of a road.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct LaneKey {
    /// The rank of the road in the file.
    pub(super) road: u32,
    /// The rank of the section along it.
    pub(super) section: u32,
    /// The number of the lane.
    pub(super) lane: i32,
}

/// A lane, and whether its end along the road is meant or its beginning.
type Tip = (LaneKey, bool);

/// What is kept of a lane: whether it is driven on, and the lanes before and after it along its road.
#[derive(Debug, Default)]
struct FileLane {
    is_driven: bool,
    links: [Vec<i32>; 2],
}

/// What is kept of a road.
#[derive(Debug)]
struct FileRoad {
    id: String,
    links: [Option<Link>; 2],
    is_in_junction: bool,
    keeps_left: bool,
    sections: Vec<BTreeMap<i32, FileLane>>,
}

/// The lanes of all roads.
#[derive(Debug, Default)]
pub(super) struct Lanes {
    roads: Vec<FileRoad>,
    numbers: BTreeMap<String, usize>,
    contacts: BTreeSet<(Tip, Tip)>,
}

/// Which lane leads to which others.
pub(super) type Leads = BTreeMap<LaneKey, BTreeSet<LaneKey>>;

/// The sections of lanes along a road, in order.
pub(super) fn sections<'a>(lanes: Node<'a, 'a>) -> Vec<(f64, Node<'a, 'a>)> {
    let sections = lanes.children().filter(|child| child.has_tag_name("laneSection"));
    let mut sections: Vec<_> =
        sections.map(|section| (number(section, "s").unwrap_or(0.0), section)).collect();
    sections.sort_by(|a, b| a.0.total_cmp(&b.0));
    sections
}

fn lanes_of(section: Node<'_, '_>) -> BTreeMap<i32, FileLane> {
    let sides = section.children().filter(|side| ["left", "right"].contains(&side.tag_name().name()));
    let lanes = sides.flat_map(|side| side.children().filter(|lane| lane.has_tag_name("lane")));
    let whole = |node, name| number(node, name).filter(|id| id.abs() < 1e6).map(|id| id as i32);
    let read = lanes.filter_map(|lane| {
        let linked = |name: &'static str| {
            let links = child(lane, "link").into_iter().flat_map(|links| links.children());
            let links = links.filter(|link| link.has_tag_name(name));
            links.filter_map(|link| whole(link, "id")).collect()
        };
        let is_driven = section::kind_of(lane.attribute("type").unwrap_or("none")).is_driven();
        Some((
            whole(lane, "id")?,
            FileLane { is_driven, links: [linked("predecessor"), linked("successor")] },
        ))
    });
    read.collect()
}

impl Lanes {
    /// Takes in a road; gives its rank. Every road has a number of its own.
    pub(super) fn add(&mut self, node: Node<'_, '_>, id: &str, keeps_left: bool) -> u32 {
        let links = child(node, "link");
        let linked = |name| links.and_then(|links| child(links, name)).and_then(link);
        let sections = child(node, "lanes").map(sections).unwrap_or_default();
        self.numbers.insert(id.to_owned(), self.roads.len());
        self.roads.push(FileRoad {
            id: id.to_owned(),
            links: [linked("predecessor"), linked("successor")],
            is_in_junction: node.attribute("junction").is_some_and(|junction| junction != "-1"),
            keeps_left,
            sections: sections.into_iter().map(|(_, section)| lanes_of(section)).collect(),
        });
        self.roads.len() as u32 - 1
    }

    /// Whether traffic keeps left: as most of the roads with lanes both ways do, for on others either rule may be told; or as
    /// most roads, if there are none.
    pub(super) fn keep_left(&self) -> bool {
        let is_two_way = |road: &&FileRoad| {
            let first = road.sections.first().into_iter().flatten();
            let driven = first.filter(|(_, lane)| lane.is_driven).map(|(lane, _)| *lane > 0);
            let [left, right] =
                driven.fold([false; 2], |[left, right], is_left| [left || is_left, right || !is_left]);
            left && right && !road.is_in_junction
        };
        let most =
            |roads: &[&FileRoad]| 2 * roads.iter().filter(|road| road.keeps_left).count() > roads.len();
        let two_way: Vec<&FileRoad> = self.roads.iter().filter(is_two_way).collect();
        if two_way.is_empty() { most(&self.roads.iter().collect::<Vec<_>>()) } else { most(&two_way) }
    }

    fn lane(&self, key: LaneKey) -> Option<&FileLane> {
        self.roads.get(key.road as usize)?.sections.get(key.section as usize)?.get(&key.lane)
    }

    /// Whether one leaves a lane at its end along the road.
    fn goes_along(&self, key: LaneKey) -> bool {
        (key.lane < 0) != self.roads[key.road as usize].keeps_left
    }

    /// The lane of a number at the beginning or at the end of a road.
    fn at(&self, road: usize, at_end: bool, lane: i32) -> LaneKey {
        let last = self.roads[road].sections.len().saturating_sub(1);
        LaneKey { road: road as u32, section: if at_end { last as u32 } else { 0 }, lane }
    }

    fn every(&self) -> impl Iterator<Item = (LaneKey, &FileLane)> {
        let numbered = (0..).zip(&self.roads);
        numbered.flat_map(|(road, found)| {
            (0..).zip(&found.sections).flat_map(move |(section, lanes)| {
                lanes.iter().map(move |(lane, found)| (LaneKey { road, section, lane: *lane }, found))
            })
        })
    }

    /// What lies beyond the beginning or the end of a section: the road, and whether its end is met; and the section.
    fn beyond(&self, key: LaneKey, at_end: bool) -> Option<(usize, bool, u32)> {
        let road = &self.roads[key.road as usize];
        let last = road.sections.len() as u32 - 1;
        match (key.section, at_end) {
            (section, true) if section < last => Some((key.road as usize, false, section + 1)),
            (1.., false) => Some((key.road as usize, true, key.section - 1)),
            _ => {
                let Some(Link::Road(id, meets_end)) = &road.links[usize::from(at_end)] else { return None };
                let other = *self.numbers.get(id)?;
                Some((other, *meets_end, self.at(other, *meets_end, 0).section))
            }
        }
    }

    fn touch(&mut self, a: Tip, b: Tip) {
        self.contacts.insert((a.min(b), a.max(b)));
    }

    /// Joins lanes as they are linked along roads and from road to road.
    fn join_along(&mut self, warnings: &mut Vec<OpenDriveWarning>) {
        let mut found = Vec::new();
        let mut astray = BTreeSet::new();
        for (key, lane) in self.every().filter(|(_, lane)| lane.is_driven) {
            for at_end in [false, true] {
                let Some((road, meets_end, section)) = self.beyond(key, at_end) else { continue };
                for other in &lane.links[usize::from(at_end)] {
                    let other = LaneKey { road: road as u32, section, lane: *other };
                    match self.lane(other) {
                        Some(lane) if lane.is_driven => found.push(((key, at_end), (other, meets_end))),
                        Some(_) => {}
                        None => drop(astray.insert(key.road)),
                    }
                }
            }
        }
        for (a, b) in found {
            self.touch(a, b);
        }
        for road in astray {
            let what = "a lane is linked with one that is not there; that link was left out";
            warnings.push(OpenDriveWarning::of(&self.roads[road as usize].id, what));
        }
    }

    /// Joins lanes as a junction links them.
    pub(super) fn join_over(&mut self, junction: Node<'_, '_>, warnings: &mut Vec<OpenDriveWarning>) {
        let id = junction.attribute("id").unwrap_or_default();
        for connection in junction.children().filter(|child| child.has_tag_name("connection")) {
            // A direct junction leads into the road itself, without another one between.
            let onto = connection.attribute("connectingRoad").or(connection.attribute("linkedRoad"));
            let incoming = connection.attribute("incomingRoad");
            let of = |id: Option<&str>| id.and_then(|id| self.numbers.get(id).copied());
            let (Some(from), Some(onto)) = (of(incoming), of(onto)) else {
                let what = format!("a connection of junction {id} has a road that is not there; left out");
                warnings.push(OpenDriveWarning { road: incoming.map(str::to_owned), what });
                continue;
            };
            let at_end = connection.attribute("contactPoint") == Some("end");
            if !self.link_over(connection, (from, onto, at_end)) {
                let what = format!("a connection of junction {id} links lanes that are not there; left out");
                warnings.push(OpenDriveWarning::of(&self.roads[from].id, what));
            }
        }
    }

    /// Joins the lanes of one connection; false if it names lanes that are not there.
    fn link_over(&mut self, connection: Node<'_, '_>, (from, onto, at_end): (usize, usize, bool)) -> bool {
        let whole = |node, name| number(node, name).filter(|id| id.abs() < 1e6).map(|id| id as i32);
        let links = connection.children().filter(|child| child.has_tag_name("laneLink"));
        let mut links: Vec<(i32, i32)> =
            links.filter_map(|link| Some((whole(link, "from")?, whole(link, "to")?))).collect();
        if links.is_empty() {
            // Nothing said is the same number on either side.
            let section = self.at(onto, at_end, 0).section as usize;
            let numbers = self.roads[onto].sections.get(section).into_iter().flat_map(BTreeMap::keys);
            let own = numbers.filter(|lane| self.own_end(from, onto, at_end, **lane).is_some());
            links = own.map(|lane| (*lane, *lane)).collect();
        }
        let mut are_there = true;
        for (lane, other) in links {
            let to = self.at(onto, at_end, other);
            let Some(own) = self.own_end(from, onto, at_end, lane).filter(|_| self.lane(to).is_some()) else {
                are_there = false;
                continue;
            };
            if [own.0, to].iter().all(|key| self.lane(*key).is_some_and(|lane| lane.is_driven)) {
                self.touch(own, (to, at_end));
            }
        }
        are_there
    }

    /// The end of a lane that leads into a junction: where the connecting road says that it begins, or else where one leaves
    /// the lane.
    fn own_end(&self, from: usize, onto: usize, at_end: bool, lane: i32) -> Option<Tip> {
        let told = match &self.roads[onto].links[usize::from(at_end)] {
            Some(Link::Road(id, is_end)) if *id == self.roads[from].id => Some(*is_end),
            _ => None,
        };
        let is_end = told.unwrap_or_else(|| self.goes_along(self.at(from, false, lane)));
        let key = self.at(from, is_end, lane);
        self.lane(key).map(|_| (key, is_end))
    }

    /// Which lane leads to which.
    pub(super) fn leads(mut self, warnings: &mut Vec<OpenDriveWarning>) -> Leads {
        self.join_along(warnings);
        let mut leads = Leads::new();
        let mut wrong = BTreeSet::new();
        for ((a, a_end), (b, b_end)) in &self.contacts {
            let leaves = [self.goes_along(*a) == *a_end, self.goes_along(*b) == *b_end];
            match leaves {
                [true, false] => drop(leads.entry(*a).or_default().insert(*b)),
                [false, true] => drop(leads.entry(*b).or_default().insert(*a)),
                _ => drop(wrong.insert(a.road)),
            }
        }
        for road in wrong {
            let what = "a lane is linked with one of the other direction; that link was left out";
            warnings.push(OpenDriveWarning::of(&self.roads[road as usize].id, what));
        }
        self.join_beside(&mut leads);
        leads
    }

    /// Along a road a lane that begins is entered from the one beside it, and one that ends leads where that one does.
    fn join_beside(&self, leads: &mut Leads) {
        let mut entered: BTreeMap<LaneKey, Vec<LaneKey>> = BTreeMap::new();
        for (from, to) in leads.iter() {
            for to in to {
                entered.entry(*to).or_default().push(*from);
            }
        }
        let mut more: Vec<(LaneKey, LaneKey)> = Vec::new();
        for (key, _) in self.every().filter(|(_, lane)| lane.is_driven) {
            let along = self.goes_along(key);
            if self.is_within(key, !along) && !entered.contains_key(&key) {
                let beside = self.beside(key, |other| entered.contains_key(&other));
                let before = beside.and_then(|beside| entered.get(&beside)).into_iter().flatten();
                more.extend(before.map(|before| (*before, key)));
            }
            if self.is_within(key, along) && !leads.contains_key(&key) {
                let beside = self.beside(key, |other| leads.contains_key(&other));
                let after = beside.and_then(|beside| leads.get(&beside)).into_iter().flatten();
                more.extend(after.map(|after| (key, *after)));
            }
        }
        for (from, to) in more {
            leads.entry(from).or_default().insert(to);
        }
    }

    /// Whether the road goes on there without a junction.
    fn is_within(&self, key: LaneKey, at_end: bool) -> bool {
        let is_outside = |road: usize| !self.roads[road].is_in_junction;
        self.beyond(key, at_end).is_some_and(|(other, ..)| {
            other == key.road as usize || (is_outside(other) && is_outside(key.road as usize))
        })
    }

    /// The nearest lane of the same section and direction of which something is true.
    fn beside(&self, key: LaneKey, is_so: impl Fn(LaneKey) -> bool) -> Option<LaneKey> {
        let lanes = &self.roads[key.road as usize].sections[key.section as usize];
        let others = lanes.keys().map(|lane| LaneKey { lane: *lane, ..key });
        let others = others.filter(|other| (other.lane < 0) == (key.lane < 0) && is_so(*other));
        others.min_by_key(|other| (other.lane - key.lane).abs())
    }
}
