//! What the words of a request may mean: things of the scene, assets and streets, ranked, within a budget of tokens.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::ops::ControlFlow;

use simworld_core::geometry::Aabb;
use simworld_core::id::{EntityId, IntersectionId, RoadId};
use simworld_core::scene::{EntityKind, EntityRef, Scene};
use simworld_core::value::Value;

use super::super::prompts::one_line;
use super::ways::Ways;
use crate::editing::{Asked, Edit, called, made_as};
use crate::language::name_of_color;
use crate::retrieval::AssetIndex;

/// Things within this of the viewpoint may be meant without a word of theirs being said, m.
const NEAR: f64 = 60.0;
/// Things farther than this are found by their names alone, m.
const AROUND: f64 = 400.0;
/// The most things, assets and streets that a schema holds.
const MOST: (usize, usize, usize) = (60, 24, 16);
/// The most pieces of streets that are named, and the most junctions.
const PIECES: usize = 24;
/// So many of the things that an answer makes may be spoken of in it.
const MADE: u32 = 5;
/// How an answer calls who looks at the scene, and, with a number from 1 on, what it makes itself.
pub(super) const VIEWER: &str = "me";
pub(super) const NEW: &str = "new";
/// Bytes of a token, on the safe side.
const TOKEN: usize = 4;
/// The most characters of a name that are shown.
const LONGEST_NAME: usize = 60;

/// What was found.
#[derive(Default)]
pub(crate) struct Recalled {
    /// Things by how they are written, the likeliest first.
    pub(super) things: Vec<(String, EntityId)>,
    pub(super) assets: Vec<String>,
    /// Streets and pieces of streets by name.
    pub(super) streets: BTreeMap<String, Vec<RoadId>>,
    /// Where streets meet, by their names.
    pub(super) junctions: BTreeMap<String, IntersectionId>,
    /// Who looks at the scene, if somebody in it does.
    pub(super) viewer: Option<EntityId>,
    /// How many of the things that the answer makes may be spoken of.
    pub(super) made: u32,
    pub(super) lines: Vec<String>,
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
        let ways = asked.scene.roads().map(|network| Ways::of(network));
        let ranked_streets = ways.as_ref().map_or_else(Vec::new, |ways| streets(asked, ways, &words));
        let named = |(_, name, roads): &(usize, String, Vec<RoadId>)| (name.clone(), roads.clone());
        let mut streets: BTreeMap<String, Vec<RoadId>> =
            ranked_streets.iter().map(named).filter(|(name, _)| take(name)).collect();
        let (mut things, mut lines) = (Vec::new(), Vec::new());
        for (_, _, id) in ranked(asked, &words).into_iter().take(MOST.0) {
            let Some(line) = asked.scene.entity(id).map(|entity| line(asked, &entity)) else { continue };
            if take(&line) {
                things.push((id.to_string(), id));
                lines.push(line);
            }
        }
        let mut junctions = BTreeMap::new();
        if let Some(ways) = &ways {
            junctions.extend(corners(ways, &ranked_streets).into_iter().filter(|(name, _)| take(name)));
            streets.extend(pieces(ways, &ranked_streets).into_iter().filter(|(name, _)| take(name)));
        }
        Self { things, assets, streets, junctions, viewer: asked.who, made: MADE, lines }
    }

    /// Things, assets, streets and junctions as a prompt says them.
    pub(super) fn texts(&self) -> [String; 4] {
        let or_none = |text: String| if text.is_empty() { "none".to_owned() } else { text };
        let streets: Vec<&str> = self.streets.keys().map(String::as_str).collect();
        let junctions: Vec<&str> = self.junctions.keys().map(String::as_str).collect();
        [self.lines.join("\n"), self.assets.join(", "), streets.join(", "), junctions.join(", ")].map(or_none)
    }

    /// What may be changed, as it is written.
    pub(super) fn subjects(&self) -> impl Iterator<Item = String> {
        let new = (1..=self.made).map(|number| format!("{NEW}{number}"));
        self.things.iter().map(|(text, _)| text.clone()).chain(new)
    }

    /// What something may stand to, as it is written.
    pub(super) fn anchors(&self) -> impl Iterator<Item = String> {
        self.subjects().chain(self.viewer.map(|_| VIEWER.to_owned()))
    }

    /// What may be changed and is written so.
    pub(super) fn subject(&self, text: &str) -> Option<EntityId> {
        let known = self.things.iter().find(|(known, _)| known == text).map(|(_, id)| *id);
        known.or_else(|| {
            let number: u32 = text.strip_prefix(NEW)?.parse().ok()?;
            (1..=self.made).contains(&number).then(|| Edit::made(number - 1))
        })
    }

    /// What something may stand to and is written so.
    pub(super) fn anchor(&self, text: &str) -> Option<EntityId> {
        self.subject(text).or_else(|| self.viewer.filter(|_| text == VIEWER))
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
        let hits = hits(asked.scene, entity, words);
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
fn hits(scene: &dyn Scene, entity: &EntityRef<'_>, words: &BTreeSet<String>) -> usize {
    let mut text = entity.kind.as_str().to_owned();
    let _ = write!(text, " {}", called(scene, entity));
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
    if let Some(made) = made_as(asked.scene, entity.info) {
        let _ = write!(line, " ({})", one_line(&made));
    }
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

/// The streets whose names are said, or that are nearest: how many words of each were said, what it is called, its pieces.
fn streets(
    asked: &Asked<'_>,
    ways: &Ways<'_>,
    words: &BTreeSet<String>,
) -> Vec<(usize, String, Vec<RoadId>)> {
    let said =
        |name: &str| name.split_whitespace().filter(|word| words.contains(&word.to_lowercase())).count();
    let mut ranked: Vec<_> =
        ways.streets().map(|(name, roads)| (said(name), ways.away(roads, asked.from), name, roads)).collect();
    ranked.sort_by(|a, b| b.0.cmp(&a.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(b.2)));
    let first = ranked.into_iter().take(MOST.2);
    first.map(|(said, _, name, roads)| (said, one_line(name), roads.to_vec())).collect()
}

/// The pieces of streets of which something was said.
fn pieces(ways: &Ways<'_>, ranked: &[(usize, String, Vec<RoadId>)]) -> Vec<(String, Vec<RoadId>)> {
    let said = ranked.iter().filter(|(said, _, roads)| *said > 0 && roads.len() > 1);
    let pieces = said.flat_map(|(_, _, roads)| roads).take(PIECES);
    pieces.map(|road| (ways.piece(*road), vec![*road])).collect()
}

/// Where streets of which something was said meet others.
fn corners(ways: &Ways<'_>, ranked: &[(usize, String, Vec<RoadId>)]) -> BTreeMap<String, IntersectionId> {
    let said = ranked.iter().filter(|(said, ..)| *said > 0);
    let ends: BTreeSet<IntersectionId> = said.flat_map(|(_, _, roads)| ways.junctions_of(roads)).collect();
    let corners = ends.into_iter().filter(|place| ways.meeting(*place).len() > 1).take(PIECES);
    corners.map(|place| (ways.junction(place), place)).collect()
}
