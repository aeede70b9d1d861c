//! What the words of a request may mean: things of the scene, assets and streets, ranked, within a budget of tokens.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::ops::ControlFlow;

use simworld_core::geometry::Aabb;
use simworld_core::id::{EntityId, RoadId};
use simworld_core::scene::{EntityKind, EntityRef};
use simworld_core::value::Value;

use super::super::prompts::one_line;
use crate::editing::Asked;
use crate::language::name_of_color;
use crate::retrieval::AssetIndex;

/// Things within this of the viewpoint may be meant without a word of theirs being said, m.
const NEAR: f64 = 60.0;
/// Things farther than this are found by their names alone, m.
const AROUND: f64 = 400.0;
/// The most things, assets and streets that a schema holds.
const MOST: (usize, usize, usize) = (60, 24, 16);
/// Bytes of a token, on the safe side.
const TOKEN: usize = 4;
/// The most characters of a name that are shown.
const LONGEST_NAME: usize = 60;

/// What was found.
pub(crate) struct Recalled {
    /// Things by how they are written, the likeliest first.
    pub(super) things: Vec<(String, EntityId)>,
    pub(super) assets: Vec<String>,
    /// Streets by name.
    pub(super) streets: BTreeMap<String, Vec<RoadId>>,
    lines: Vec<String>,
}

impl Recalled {
    pub(super) fn of(asked: &Asked<'_>, budget: usize) -> Self {
        let words = words_of(asked.words);
        let mut left = budget * TOKEN;
        let mut take = |text: &str| {
            let fits = text.len() < left;
            left = left.saturating_sub(text.len() + 1);
            fits
        };
        let assets = assets(asked).into_iter().take(MOST.1).filter(|name| take(name)).collect();
        let streets = streets(asked, &words).into_iter().filter(|(name, _)| take(name)).collect();
        let (mut things, mut lines) = (Vec::new(), Vec::new());
        for (_, _, id) in ranked(asked, &words).into_iter().take(MOST.0) {
            let Some(line) = asked.scene.entity(id).map(|entity| line(asked, &entity)) else { continue };
            if take(&line) {
                things.push((id.to_string(), id));
                lines.push(line);
            }
        }
        Self { things, assets, streets, lines }
    }

    /// Things, assets and streets as a prompt says them.
    pub(super) fn texts(&self) -> (String, String, String) {
        let or_none = |text: String| if text.is_empty() { "none".to_owned() } else { text };
        let streets: Vec<&str> = self.streets.keys().map(String::as_str).collect();
        (or_none(self.lines.join("\n")), or_none(self.assets.join(", ")), or_none(streets.join(", ")))
    }
}

/// Words in small letters, also without the ending of a plural.
fn words_of(text: &str) -> BTreeSet<String> {
    let mut words = BTreeSet::new();
    for word in text.split(|sign: char| !sign.is_alphanumeric()).filter(|word| word.len() > 2) {
        let word = word.to_lowercase();
        for ending in ["s", "es", "'s"] {
            words.extend(word.strip_suffix(ending).map(str::to_owned));
        }
        words.insert(word);
    }
    words
}

/// Things by how many of the words are theirs, then by distance.
fn ranked(asked: &Asked<'_>, words: &BTreeSet<String>) -> Vec<(usize, f64, EntityId)> {
    let mut found: BTreeMap<EntityId, (usize, f64)> = BTreeMap::new();
    let mut consider = |entity: &EntityRef<'_>, least: usize| {
        let is_road = matches!(entity.kind, EntityKind::Road | EntityKind::Sidewalk);
        let hits = hits(entity, words);
        if !is_road && Some(entity.id) != asked.who && hits >= least {
            found.insert(entity.id, (hits, (entity.planar() - asked.from).norm()));
        }
    };
    let _ = asked.scene.visit(&Aabb::column_around(asked.from, AROUND), &mut |entity| {
        let is_near = (entity.planar() - asked.from).norm() <= NEAR;
        consider(&entity, usize::from(!is_near));
        ControlFlow::Continue(())
    });
    let named = asked.scene.names();
    for id in named.into_iter().flat_map(|names| words.iter().flat_map(|word| names.bearers(word))) {
        if let Some(entity) = asked.scene.entity(id) {
            consider(&entity, 1);
        }
    }
    if let Some(entity) = asked.it.and_then(|it| asked.scene.entity(it)) {
        consider(&entity, 0);
    }
    let mut ranked: Vec<_> = found.into_iter().map(|(id, (hits, away))| (hits, away, id)).collect();
    ranked.sort_by(|a, b| b.0.cmp(&a.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
    ranked
}

/// How many of the words are said of a thing.
fn hits(entity: &EntityRef<'_>, words: &BTreeSet<String>) -> usize {
    let mut text = entity.kind.as_str().to_owned();
    let _ = write!(text, " {}", entity.label());
    text.extend(entity.info.place.map(|place| format!(" {place}")));
    text.extend(entity.info.color.map(|color| format!(" {}", name_of_color(color))));
    text.extend(entity.info.attributes.values().filter_map(|value| match value {
        Value::Text(text) => Some(format!(" {text}")),
        _ => None,
    }));
    let own: BTreeSet<String> =
        text.to_lowercase().split(|sign: char| !sign.is_alphanumeric()).map(str::to_owned).collect();
    own.intersection(words).count()
}

/// "#12 bench "Anna's", red, at (123, -40)", in decimetres.
fn line(asked: &Asked<'_>, entity: &EntityRef<'_>) -> String {
    let mut line = format!("{} {}", entity.id, entity.kind);
    if let Some(place) = entity.info.place {
        let _ = write!(line, " ({place})");
    }
    if let Some(name) = &entity.info.name {
        let shown: String = one_line(name).chars().take(LONGEST_NAME).collect();
        let _ = write!(line, " {shown:?}");
    }
    if let Some(color) = entity.info.color {
        let _ = write!(line, ", {}", name_of_color(color));
    }
    let away = (entity.planar() - asked.from).norm();
    let _ = write!(line, ", {away:.0} m away, {:.1} m high", entity.info.shape.size().z);
    line
}

/// The assets that the words may mean, the likeliest first, and then the first of the catalogue.
fn assets(asked: &Asked<'_>) -> Vec<String> {
    let found = AssetIndex::of(asked.catalogue).retrieve(asked.words, MOST.1);
    let mut names: Vec<String> = found.into_iter().map(|hit| hit.name).collect();
    for (_, asset) in asked.catalogue.iter() {
        if names.len() >= MOST.1 {
            break;
        }
        if !names.contains(&asset.name) {
            names.push(asset.name.clone());
        }
    }
    names
}

/// The streets whose names are said, or that are nearest.
fn streets(asked: &Asked<'_>, words: &BTreeSet<String>) -> BTreeMap<String, Vec<RoadId>> {
    let Some(network) = asked.scene.roads() else { return BTreeMap::new() };
    let mut named: BTreeMap<&str, (Vec<RoadId>, f64)> = BTreeMap::new();
    for (index, road) in network.roads.iter().enumerate() {
        let id = RoadId::from_index(index);
        let Some(name) = network.road_name(id) else { continue };
        let entry = named.entry(name).or_insert((Vec::new(), f64::INFINITY));
        entry.0.push(id);
        let away = road.centerline.iter().map(|at| (at - asked.from).norm()).fold(f64::INFINITY, f64::min);
        entry.1 = entry.1.min(away);
    }
    let said =
        |name: &str| name.split_whitespace().filter(|word| words.contains(&word.to_lowercase())).count();
    let mut ranked: Vec<_> =
        named.into_iter().map(|(name, (roads, away))| (said(name), away, name, roads)).collect();
    ranked.sort_by(|a, b| b.0.cmp(&a.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(b.2)));
    ranked.into_iter().take(MOST.2).map(|(_, _, name, roads)| (one_line(name), roads)).collect()
}
