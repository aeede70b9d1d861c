//! Ways split where they meet.

use std::collections::BTreeMap;

use super::kind::{is_wanted, kind_of};
use super::profile::{OneWay, Profile, one_way};
use super::turns::{self, Turns};
use super::web::{Character, UNNAMED, Web};
use super::{Kind, StreetOptions};
use crate::osm::error::{OsmId, Warning};
use crate::osm::place::Place;
use crate::osm::raw::{MISSING, Way};
use crate::osm::tags::{Key, Tags, speed};

/// Speed limits that mean something, m/s.
const LIMITS: (f64, f64) = (1.0, 70.0);

/// The streets of a place as they were drawn, split where they meet.
pub(super) fn web_of(
    place: &Place,
    options: &StreetOptions,
    is_left_hand: bool,
    warnings: &mut Vec<Warning>,
) -> Web {
    let wanted = || {
        place.raw.ways().iter().filter_map(|way| {
            let tags = place.raw.way_tags(way);
            let kind = kind_of(&tags).filter(|_| is_wanted(&tags, options.service))?;
            Some((way, tags, kind))
        })
    };
    let uses = uses(place, wanted().map(|(way, ..)| way));
    let mut splitter = Splitter {
        place,
        uses,
        vertices: BTreeMap::new(),
        names: BTreeMap::new(),
        web: Web::default(),
        is_left_hand,
    };
    for (way, tags, kind) in wanted() {
        splitter.add(way, &tags, kind, warnings);
    }
    turns::put_signs(&mut splitter.web, place, &splitter.vertices, warnings);
    splitter.web
}

/// How often some ways pass each node; their ends count twice, so that two and more is where they are split.
pub(in crate::osm) fn uses<'a>(place: &Place, ways: impl Iterator<Item = &'a Way>) -> Vec<u8> {
    let mut uses = vec![0_u8; place.raw.node_count()];
    let mut count = |node: u32, times: u8| {
        if let Some(uses) = uses.get_mut(node as usize) {
            *uses = uses.saturating_add(times);
        }
    };
    for way in ways {
        let nodes = place.raw.nodes_of(way);
        let mut before = MISSING;
        for node in nodes {
            if *node != before {
                count(*node, 1);
            }
            before = *node;
        }
        for end in [nodes.first(), nodes.last()].into_iter().flatten() {
            count(*end, 1);
        }
    }
    uses
}

struct Splitter<'a> {
    place: &'a Place,
    uses: Vec<u8>,
    /// The node of the web at a node of the place.
    vertices: BTreeMap<u32, u32>,
    names: BTreeMap<&'a str, u32>,
    web: Web,
    is_left_hand: bool,
}

impl<'a> Splitter<'a> {
    fn add(&mut self, way: &Way, tags: &Tags<'a>, kind: Kind, warnings: &mut Vec<Warning>) {
        let direction = one_way(tags);
        let character = self.character(way, tags, kind, direction);
        let mut nodes = self.place.raw.nodes_of(way).to_vec();
        if direction == OneWay::Against {
            nodes.reverse();
        }
        let Profile { forward, backward, .. } = character.profile;
        let [ahead, back] = turns::arrows(tags, way.id, (forward, backward), warnings);
        let first = self.web.edges.len();
        let mut lost = 0;
        let mut run: Vec<u32> = Vec::new();
        for node in nodes {
            if self.place.point(node).is_none() {
                lost += 1;
                self.add_run(&run, character);
                run.clear();
            } else if run.last() != Some(&node) {
                run.push(node);
            }
        }
        self.add_run(&run, character);
        // Arrows stand before the junctions at the ends of a way.
        if let Some(edge) = self.web.edges[first..].last_mut() {
            edge.turns[1] = Turns::of(ahead);
        }
        if let Some(edge) = self.web.edges[first..].first_mut() {
            edge.turns[0] = Turns::of(back);
        }
        if lost > 0 {
            let what = format!("{lost} of its nodes are not in the extract; the street ends there");
            warnings.push(Warning { what, element: Some(OsmId::Way(way.id)), at: None });
        }
    }

    fn character(&mut self, way: &Way, tags: &Tags<'a>, kind: Kind, direction: OneWay) -> Character {
        let name =
            tags.get(Key::Name).filter(|name| !name.is_empty()).map_or(UNNAMED, |name| self.name(name));
        let implied = f64::from(kind.speed) / 3.6;
        let limit = tags.get(Key::MaxSpeed).and_then(speed).unwrap_or(implied);
        let level = level(tags);
        Character {
            way: way.id,
            class: kind.class,
            profile: Profile::of(tags, kind, direction, self.is_left_hand),
            name,
            speed: if limit > 0.0 { limit.clamp(LIMITS.0, LIMITS.1) } else { 0.0 },
            level,
            is_covered: tags.has(Key::Tunnel) || tags.is_any(Key::Covered, &["yes", "arcade"]),
            is_roundabout: tags.is_any(Key::Junction, &["roundabout", "circular"]),
            is_link: kind.is_link,
        }
    }

    fn name(&mut self, name: &'a str) -> u32 {
        let names = &mut self.web.names;
        *self.names.entry(name).or_insert_with(|| {
            names.push(name.to_owned());
            names.len() as u32 - 1
        })
    }

    /// Adds the edges of a row of nodes that are all there.
    fn add_run(&mut self, run: &[u32], character: Character) {
        let mut start = 0;
        for index in 1..run.len() {
            let is_end = index + 1 == run.len();
            if is_end || self.uses[run[index] as usize] >= 2 {
                let ends = [self.vertex(run[start]), self.vertex(run[index])];
                let via = run[start + 1..index].iter().filter_map(|node| self.place.point(*node)).collect();
                self.web.add_edge(ends, via, character);
                start = index;
            }
        }
    }

    fn vertex(&mut self, node: u32) -> u32 {
        let (place, web) = (self.place, &mut self.web);
        *self.vertices.entry(node).or_insert_with(|| {
            let at = place.point(node).unwrap_or_default();
            web.add_node(at)
        })
    }
}

/// Above or below the ground: the tag, or one for bridges and tunnels without.
pub(in crate::osm) fn level(tags: &Tags<'_>) -> i8 {
    let tagged =
        tags.get(Key::Layer).and_then(|layer| layer.parse::<i8>().ok()).filter(|layer| layer.abs() <= 10);
    let is_tunnel =
        tags.has(Key::Tunnel) && !tags.is_any(Key::Tunnel, &["building_passage", "avalanche_protector"]);
    match tagged {
        Some(layer) if layer != 0 => layer,
        _ if tags.has(Key::Bridge) => 1,
        _ if is_tunnel => -1,
        _ => 0,
    }
}
