//! The notation of `tests/edits`, and the judge of what a sentence did.

mod asked;
mod ground;

use simworld_agents::editing::{Difference, Edit, EditError, Edited, SceneEditor, Stand, faults};
use simworld_core::asset::Catalogue;
use simworld_core::geometry::{Point2, heading, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{EntityRef, Relation, Scene, World};
use simworld_core::seed::Seed;
use simworld_core::traffic::RoadLeg;

pub(crate) use asked::{Asked, CITIES, is_whole, sampled_in, taught_in};

use crate::city::City;

/// What came of a sentence.
#[derive(Debug, PartialEq)]
pub(crate) enum Verdict {
    Right,
    /// The scene was changed otherwise than asked.
    WrongEdit(String),
    /// Another answer than was due, and nothing changed.
    WrongAnswer(String),
}

/// Carries a sentence out in a copy of the city, and judges.
pub(crate) fn verdict(city: &City, asked: &Asked) -> Verdict {
    let mut world = city.world.clone();
    let mut editor = SceneEditor::new(Seed(7)).looking_as(city.me, &world);
    let outcome = editor.say(&asked.words, &mut world);
    let changed = Difference::between(&city.world, &world);
    let judge = Judge { city, after: &world, changed: &changed };
    match (judge.check(&asked.meaning, &outcome), changed.is_empty()) {
        (Ok(()), _) => Verdict::Right,
        (Err(why), true) => Verdict::WrongAnswer(format!("{why}; said {}", said(&outcome))),
        (Err(why), false) => Verdict::WrongEdit(format!("{why}; did {}", said(&outcome))),
    }
}

fn said(outcome: &Result<Edited, EditError>) -> String {
    match outcome {
        Ok(edited) => format!("{:?} {}", edited.edits, edited.answer.clone().unwrap_or_default()),
        Err(error) => error.to_string(),
    }
}

struct Judge<'a> {
    city: &'a City,
    after: &'a World,
    changed: &'a Difference,
}

impl Judge<'_> {
    fn check(&self, meaning: &str, outcome: &Result<Edited, EditError>) -> Result<(), String> {
        if let Some(refusal) = meaning.strip_prefix("! ") {
            return refused(refusal, outcome);
        }
        if let Some(open) = meaning.strip_prefix("? ") {
            return self.asked_back(open, outcome);
        }
        let edited = outcome.as_ref().map_err(ToString::to_string)?;
        let mut rest = Rest::of(self.changed);
        for clause in meaning.split(" + ").filter(|clause| !clause.is_empty()) {
            self.clause(clause.trim(), edited, &mut rest)?;
        }
        rest.is_empty()?;
        for thing in self.changed.added.iter().chain(&self.changed.moved) {
            let found = faults(self.after, *thing);
            if !found.is_empty() {
                return Err(format!("{thing} stands badly: {found:?}"));
            }
        }
        Ok(())
    }

    fn asked_back(&self, open: &str, outcome: &Result<Edited, EditError>) -> Result<(), String> {
        let wanted: Vec<&str> = open.split('|').map(str::trim).collect();
        let Err(EditError::Ambiguous { candidates, .. }) = outcome else {
            return Err("did not ask".to_owned());
        };
        let mut got: Vec<String> = candidates.iter().map(|(id, _)| self.city.key(*id)).collect();
        got.sort_unstable();
        let mut wanted: Vec<String> = wanted.into_iter().map(str::to_owned).collect();
        wanted.sort_unstable();
        if got == wanted { Ok(()) } else { Err(format!("asked about {got:?}")) }
    }

    fn clause(&self, clause: &str, edited: &Edited, rest: &mut Rest) -> Result<(), String> {
        let (verb, told) = clause.split_once(' ').unwrap_or((clause, ""));
        let words: Vec<&str> = told.split_whitespace().collect();
        match verb {
            "add" => self.added(told, rest),
            "copy" => self.copied(&words, rest),
            "remove" => words.iter().try_for_each(|key| take(&mut rest.removed, self.id(key), "removed")),
            "move" | "rotate" | "face" | "swap" => self.placed(clause, edited, rest),
            "paint" | "scale" | "name" => self.altered(clause, rest),
            "count" => {
                let answer = edited.answer.clone().unwrap_or_default();
                let counted = answer.split_whitespace().next().unwrap_or_default();
                if counted == words[0] { Ok(()) } else { Err(format!("counted {answer:?}")) }
            }
            "list" | "describe" => {
                let answer = edited.answer.clone().unwrap_or_default();
                let names = |key: &&str| answer.contains(&format!("({})", self.id(key)));
                let exact = verb == "describe"
                    || answer.matches("(#").count().max(answer.matches(" at ").count()) == words.len();
                if words.iter().all(names) && exact { Ok(()) } else { Err(format!("told {answer:?}")) }
            }
            "weather" | "hour" => self.sky(clause, rest),
            "row" => self.row(told, rest),
            "close" | "open" => self.passages(&words, verb == "close", rest),
            other => panic!("no notation {other} in {clause}"),
        }
    }

    /// What stands or looks otherwise than before.
    fn placed(&self, clause: &str, edited: &Edited, rest: &mut Rest) -> Result<(), String> {
        let (verb, told) = clause.split_once(' ').unwrap_or((clause, ""));
        let words: Vec<&str> = told.split_whitespace().collect();
        let thing = self.id(words[0]);
        match verb {
            "move" => {
                self.was_moved(thing, rest)?;
                self.stands(thing, told.split_once(' ').map_or("", |(_, place)| place))
            }
            "rotate" => {
                self.was_moved(thing, rest)?;
                let angle: f64 = words[1].parse().map_err(|_| format!("no angle {clause}"))?;
                // What stands elsewhere may have been turned by that, so that the angle is seen in the edits alone.
                let turns = |edit: &Edit| matches!(edit, Edit::Rotate { things, angle: by } if things.contains(&thing) && wrap_angle(by - angle.to_radians()).abs() < 1e-6);
                let stays = (place_of(self.after, thing) - place_of(&self.city.world, thing)).norm() < 1e-6;
                if !stays && edited.edits.iter().any(turns) {
                    return Ok(());
                }
                let turned = yaw_in(self.after, thing) - yaw_in(&self.city.world, thing);
                is_near(wrap_angle(turned - angle.to_radians()), 0.0, 1e-6, "is turned wrongly")
            }
            "face" => {
                let towards = self.id(words[1]);
                rest.moved.retain(|id| *id != thing);
                let way = place_of(self.after, towards) - place_of(self.after, thing);
                is_near(wrap_angle(yaw_in(self.after, thing) - heading(&way)), 0.0, 1e-6, "looks elsewhere")
            }
            _ => {
                let other = self.id(words[1]);
                take(&mut rest.moved, thing, "moved")?;
                take(&mut rest.moved, other, "moved")?;
                let (was, is) = (place_of(&self.city.world, thing), place_of(self.after, other));
                is_near((was - is).norm(), 0.0, 1e-6, "stands elsewhere")
            }
        }
    }

    /// What has another colour, size or name than before.
    fn altered(&self, clause: &str, rest: &mut Rest) -> Result<(), String> {
        let (verb, told) = clause.split_once(' ').unwrap_or((clause, ""));
        let words: Vec<&str> = told.split_whitespace().collect();
        let thing = self.id(words[0]);
        match verb {
            "paint" => {
                // What was of that colour already need not change.
                rest.altered.retain(|id| *id != thing);
                self.wears(thing, words[1])
            }
            "scale" => {
                self.was_altered(thing, "scaled", rest)?;
                let factor: f64 = words[1].parse().map_err(|_| format!("no factor {clause}"))?;
                let height =
                    |world: &World| world.entity(thing).map_or(0.0, |thing| thing.info.shape.size().z);
                is_near(height(self.after) / height(&self.city.world), factor, 0.01, "has another size")
            }
            _ => {
                self.was_altered(thing, "named", rest)?;
                let name = told.split('\'').nth(1).unwrap_or_default();
                let named = self.after.entity(thing).and_then(|thing| thing.info.name.clone());
                if named.as_deref() == Some(name) { Ok(()) } else { Err(format!("is called {named:?}")) }
            }
        }
    }

    /// Whether a thing has another size or name, both of which may be told of it.
    fn was_altered(&self, thing: EntityId, how: &str, rest: &mut Rest) -> Result<(), String> {
        rest.altered.retain(|id| *id != thing);
        if self.changed.altered.contains(&thing) { Ok(()) } else { Err(format!("{thing} was not {how}")) }
    }

    /// Whether a thing was moved or turned, which may be told twice.
    fn was_moved(&self, thing: EntityId, rest: &mut Rest) -> Result<(), String> {
        rest.moved.retain(|id| *id != thing);
        if self.changed.moved.contains(&thing) { Ok(()) } else { Err(format!("{thing} was not moved")) }
    }

    // ---- new things ----

    fn added(&self, told: &str, rest: &mut Rest) -> Result<(), String> {
        let mut words: Vec<&str> = told.split_whitespace().collect();
        let catalogue = Catalogue::library();
        let asset = words.remove(0);
        let is_big = words.contains(&"big");
        let is_made = |entity: &EntityRef<'_>, name: &str| {
            if let Some(kind) = name.strip_prefix("any ") {
                return entity.kind.as_str() == kind;
            }
            let asset = catalogue
                .find(name)
                .and_then(|id| catalogue.get(id))
                .unwrap_or_else(|| panic!("no asset {name}"));
            let size = asset.collider.size() * if is_big { 2.0 } else { 1.0 };
            entity.kind == asset.kind && (entity.info.shape.size() - size).norm() < 1e-9
        };
        let name = if asset == "any" { format!("any {}", words.remove(0)) } else { asset.to_owned() };
        let count = take_count(&mut words);
        let is_colored = words.first().is_some_and(|word| COLORS.contains(word));
        let color = is_colored.then(|| words.remove(0));
        if is_big {
            words.retain(|word| *word != "big");
        }
        let place = words.join(" ");
        for _ in 0..count {
            let fits = |id: &EntityId| {
                let entity = self.after.entity(*id).expect("it was added");
                is_made(&entity, &name)
                    && color.is_none_or(|color| self.wears(*id, color).is_ok())
                    && self.stands(*id, &place).is_ok()
            };
            let Some(index) = rest.added.iter().position(fits) else {
                return Err(format!("no new {name} {place}"));
            };
            rest.added.remove(index);
        }
        Ok(())
    }

    fn copied(&self, words: &[&str], rest: &mut Rest) -> Result<(), String> {
        let original = self.city.world.entity(self.id(words[0])).expect("it is there");
        let mut words = words[1..].to_vec();
        let count = take_count(&mut words);
        let place = words.join(" ");
        for _ in 0..count {
            let same = |id: &EntityId| {
                let copy = self.after.entity(*id).expect("it was added");
                copy.kind == original.kind
                    && copy.info.shape == original.info.shape
                    && self.stands(*id, &place).is_ok()
            };
            let Some(index) = rest.added.iter().position(same) else {
                return Err(format!("no copy {place}"));
            };
            rest.added.remove(index);
        }
        Ok(())
    }

    // ---- relations ----

    fn stands(&self, thing: EntityId, place: &str) -> Result<(), String> {
        let all = place.split('&').map(str::trim).filter(|place| !place.is_empty());
        for one in all {
            if !alternatives(one).iter().any(|place| self.stands_so(thing, place)) {
                return Err(format!("{thing} does not stand {one}"));
            }
        }
        Ok(())
    }

    fn stands_so(&self, thing: EntityId, place: &str) -> bool {
        let (relation, told) = place.split_once(' ').unwrap_or((place, ""));
        let keys: Vec<&str> = told.split_whitespace().collect();
        let to = |relation| Stand::To { relation, anchor: self.id(keys[0]) }.holds(self.after, thing);
        let compass = |degrees: f64| {
            Stand::Towards { heading: degrees.to_radians(), anchor: self.id(keys[0]) }
                .holds(self.after, thing)
        };
        match relation {
            "next_to" => to(Relation::NextTo),
            "near" => to(Relation::Near),
            "far_from" => to(Relation::FarFrom),
            "in_front_of" => to(Relation::InFrontOf),
            "behind" => to(Relation::Behind),
            "left_of" => to(Relation::LeftOf),
            "right_of" => to(Relation::RightOf),
            "on_top_of" => to(Relation::OnTopOf),
            "inside" => to(Relation::Inside),
            "east_of" => compass(0.0),
            "north_of" => compass(90.0),
            "west_of" => compass(180.0),
            "south_of" => compass(-90.0),
            "between" => {
                Stand::Between { one: self.id(keys[0]), other: self.id(keys[1]) }.holds(self.after, thing)
            }
            "across_from" => Stand::AcrossFrom { anchor: self.id(keys[0]) }.holds(self.after, thing),
            "along" => Stand::Along { anchor: self.id(keys[0]) }.holds(self.after, thing),
            "at_corner_of" => Stand::AtCornerOf { anchor: self.id(keys[0]) }.holds(self.after, thing),
            "here" => (place_of(self.after, thing) - place_of(self.after, self.city.me)).norm() <= 27.0,
            "anywhere" => true,
            "at" => {
                let numbers: Vec<f64> =
                    told.split(['(', ')', ',', ' ']).filter_map(|text| text.parse().ok()).collect();
                (place_of(self.after, thing) - Point2::new(numbers[0], numbers[1])).norm() < 0.01
            }
            other => self.stands_on_ground(thing, other, &keys),
        }
    }

    // ---- the rest ----

    fn sky(&self, clause: &str, rest: &mut Rest) -> Result<(), String> {
        rest.environment = false;
        let now = self.after.environment();
        for part in clause.split('&').map(str::trim) {
            let (what, value) = part.split_once(' ').unwrap_or((part, ""));
            let holds = match (what, value) {
                ("weather", "rain") => now.weather.rain > 0.0,
                ("weather", "snow") => now.weather.snow > 0.0,
                ("weather", "fog") => now.weather.visibility <= 1000.0,
                ("weather", "clear") => {
                    now.weather.rain == 0.0 && now.weather.snow == 0.0 && now.weather.visibility > 5000.0
                }
                ("hour", hour) => {
                    let hour = hour.parse().map_err(|_| format!("no hour {clause}"))?;
                    now.sun == simworld_core::environment::Sun::at_hour(hour)
                }
                other => panic!("no sky {other:?}"),
            };
            if !holds {
                return Err(format!("it is not {part}"));
            }
        }
        Ok(())
    }

    fn id(&self, key: &str) -> EntityId {
        *self.city.ids.get(key).unwrap_or_else(|| panic!("no {key} in this city"))
    }

    fn wears(&self, thing: EntityId, color: &str) -> Result<(), String> {
        let worn = self.after.entity(thing).and_then(|thing| thing.info.color);
        let hues = worn.map(hue_name);
        if hues == Some(color) { Ok(()) } else { Err(format!("is {hues:?}")) }
    }
}

const COLORS: [&str; 11] =
    ["red", "orange", "yellow", "green", "blue", "purple", "pink", "brown", "white", "grey", "black"];

/// The name of a colour by the nearest of a table of paints, linear-light sRGB; it knows nothing of the grammar's words.
fn hue_name(color: [f32; 3]) -> &'static str {
    const TABLE: [[f32; 3]; 11] = [
        [0.55, 0.03, 0.02],
        [0.8, 0.2, 0.02],
        [0.8, 0.6, 0.03],
        [0.05, 0.35, 0.06],
        [0.03, 0.08, 0.45],
        [0.2, 0.03, 0.35],
        [0.85, 0.3, 0.45],
        [0.2, 0.08, 0.03],
        [0.85, 0.85, 0.85],
        [0.3, 0.3, 0.3],
        [0.01, 0.01, 0.01],
    ];
    let distance = |other: &[f32; 3]| color.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum::<f32>();
    let nearest = (0..TABLE.len()).min_by(|a, b| distance(&TABLE[*a]).total_cmp(&distance(&TABLE[*b])));
    nearest.map_or("", |index| COLORS[index])
}

/// What changed and is not yet accounted for.
struct Rest {
    added: Vec<EntityId>,
    removed: Vec<EntityId>,
    moved: Vec<EntityId>,
    altered: Vec<EntityId>,
    environment: bool,
    passages: Vec<RoadLeg>,
}

impl Rest {
    fn of(changed: &Difference) -> Self {
        Self {
            added: changed.added.clone(),
            removed: changed.removed.clone(),
            moved: changed.moved.clone(),
            altered: changed.altered.clone(),
            environment: changed.environment,
            passages: changed.passages.clone(),
        }
    }

    fn is_empty(&self) -> Result<(), String> {
        let Self { added, removed, moved, altered, environment, passages } = self;
        let all = [added, removed, moved, altered];
        if all.iter().all(|list| list.is_empty()) && !environment && passages.is_empty() {
            Ok(())
        } else {
            Err(format!(
                "besides added {added:?}, removed {removed:?}, moved {moved:?}, altered {altered:?}, sky {environment}, streets {passages:?}"
            ))
        }
    }
}

/// The number at the start of some words, which it takes; one without it.
fn take_count(words: &mut Vec<&str>) -> usize {
    let count = words.first().and_then(|word| word.parse().ok());
    if count.is_some() {
        words.remove(0);
    }
    count.unwrap_or(1)
}

fn take(list: &mut Vec<EntityId>, thing: EntityId, what: &str) -> Result<(), String> {
    let index = list.iter().position(|id| *id == thing).ok_or_else(|| format!("{thing} was not {what}"))?;
    list.remove(index);
    Ok(())
}

fn is_near(got: f64, wanted: f64, within: f64, what: &str) -> Result<(), String> {
    if (got - wanted).abs() <= within { Ok(()) } else { Err(format!("{what}: {got} for {wanted}")) }
}

fn refused(refusal: &str, outcome: &Result<Edited, EditError>) -> Result<(), String> {
    let (kind, part) = refusal.split_once(" ~ ").unwrap_or((refusal, ""));
    let Err(error) = outcome else { return Err("it was done".to_owned()) };
    let is = match error {
        EditError::NotUnderstood { .. } => "not understood",
        EditError::NotFound { .. } => "not found",
        EditError::UnknownThing { .. } => "unknown thing",
        EditError::NoRoom { .. } => "no room",
        EditError::Impossible { .. } => "impossible",
        EditError::Ambiguous { .. } => "ambiguous",
        _ => "refused",
    };
    let names = error.to_string().to_lowercase().contains(&part.to_lowercase());
    if is == kind.trim() && names { Ok(()) } else { Err(format!("answered {is}")) }
}

/// `next_to bench_1|bench_2` is next to either.
fn alternatives(place: &str) -> Vec<String> {
    let Some((before, choices)) = place.split_once(' ').filter(|(_, keys)| keys.contains('|')) else {
        return vec![place.to_owned()];
    };
    choices.split('|').map(|key| format!("{before} {}", key.trim())).collect()
}

fn place_of(world: &World, thing: EntityId) -> Point2 {
    world.entity(thing).map_or(Point2::origin(), |thing| thing.planar())
}

fn yaw_in(world: &World, thing: EntityId) -> f64 {
    world.entity(thing).map_or(0.0, |thing| yaw_of(thing.pose))
}
