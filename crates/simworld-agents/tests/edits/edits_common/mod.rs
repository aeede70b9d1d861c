//! The notation of `tests/edits`, and the judge of what a sentence did.

mod asked;
mod ground;
mod kin;
mod relations;

use std::sync::LazyLock;

use simworld_agents::editing::{Difference, Edit, EditError, Edited, SceneEditor, faults};
use simworld_core::asset::Catalogue;
use simworld_core::geometry::{Point2, heading, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{Scene, World};
use simworld_core::seed::Seed;
use simworld_core::traffic::RoadLeg;

pub(crate) use asked::{
    Asked, CITIES, asked_elsewhere, is_whole, newest_in, sampled_in, sampled_of_taught_in, taught_in,
};
pub(crate) use kin::come_to;

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
        self.alters_as_asked(&rest.asked)?;
        let placed = self.changed.added.iter().chain(&self.changed.moved);
        placed.chain(&self.changed.altered).try_for_each(|thing| self.stands_well(*thing))
    }

    /// Whether a thing runs into nothing and is held up. What was amiss with it before and is not worse since is no fault of an edit
    /// that left it where it was.
    fn stands_well(&self, thing: EntityId) -> Result<(), String> {
        let mut found = faults(self.after, thing);
        if self.changed.altered.contains(&thing) && !self.changed.moved.contains(&thing) {
            let before = faults(&self.city.world, thing);
            found.retain(|fault| !before.contains(fault));
        }
        if found.is_empty() { Ok(()) } else { Err(format!("{thing} stands badly: {found:?}")) }
    }

    /// Whether of everything that was altered nothing is otherwise but what was asked.
    fn alters_as_asked(&self, asked: &[(EntityId, Trait)]) -> Result<(), String> {
        for thing in &self.changed.altered {
            let was = self.city.world.entity(*thing).expect("what was altered was there");
            let is = self.after.entity(*thing).expect("what was altered is there");
            let mut due = was.info.clone();
            for (_, which) in asked.iter().filter(|(of, _)| of == thing) {
                match which {
                    Trait::Color => due.color = is.info.color,
                    Trait::Name => due.name.clone_from(&is.info.name),
                    // What is larger is heavier, and its door is farther from its middle.
                    Trait::Size => {
                        (due.shape, due.mass, due.access) = (is.info.shape, is.info.mass, is.info.access);
                    }
                }
            }
            if was.kind != is.kind || due != *is.info {
                return Err(format!("{thing} is otherwise than asked: {:?}, not {due:?}", is.info));
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
                [(thing, other), (other, thing)].into_iter().try_for_each(|(one, other)| {
                    let (was, is) = (place_of(&self.city.world, one), place_of(self.after, other));
                    is_near((was - is).norm(), 0.0, 1e-6, "stands elsewhere")
                })
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
                rest.asked.push((thing, Trait::Color));
                self.wears(thing, words[1])
            }
            "scale" => {
                self.was_altered(thing, "scaled", rest)?;
                rest.asked.push((thing, Trait::Size));
                let factor: f64 = words[1].parse().map_err(|_| format!("no factor {clause}"))?;
                let size = |world: &World| world.entity(thing).expect("it is there").info.shape.size();
                let times = size(self.after).component_div(&size(&self.city.world));
                times.iter().try_for_each(|times| is_near(*times, factor, 0.01, "has another size"))
            }
            _ => {
                self.was_altered(thing, "named", rest)?;
                rest.asked.push((thing, Trait::Name));
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
        let asset = words.remove(0);
        let is_big = words.contains(&"big");
        let scale = if is_big { 2.0 } else { 1.0 };
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
                self.is_made(*id, &name, scale)
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

    /// Whether a new thing is of that asset, and so many times as large; `any KIND` leaves the asset open, and of `x|y` any one will do.
    fn is_made(&self, thing: EntityId, name: &str, scale: f64) -> bool {
        name.split('|').any(|name| self.is_one(thing, name, scale))
    }

    fn is_one(&self, thing: EntityId, name: &str, scale: f64) -> bool {
        let entity = self.after.entity(thing).expect("it was added");
        if let Some(kind) = name.strip_prefix("any ") {
            return entity.kind.as_str() == kind;
        }
        let found = LIBRARY.find(name).and_then(|id| LIBRARY.get(id));
        let asset = found.unwrap_or_else(|| panic!("no asset {name}"));
        let size = asset.collider.size() * scale;
        let made_of = entity.info.asset.and_then(|id| self.after.assets()?.get(id));
        made_of.is_some_and(|made_of| made_of.name == asset.name)
            && entity.kind == asset.kind
            && (entity.info.shape.size() - size).norm() < 1e-9
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
                    && copy.info.asset == original.info.asset
                    && self.stands(*id, &place).is_ok()
            };
            let Some(index) = rest.added.iter().position(same) else {
                return Err(format!("no copy {place}"));
            };
            rest.added.remove(index);
        }
        Ok(())
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

static LIBRARY: LazyLock<Catalogue> = LazyLock::new(Catalogue::library);

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
    /// What of which thing was to be otherwise, as far as that was accounted for.
    asked: Vec<(EntityId, Trait)>,
}

/// What of a thing may be altered.
#[derive(Clone, Copy)]
enum Trait {
    Color,
    Size,
    Name,
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
            asked: Vec::new(),
        }
    }

    fn is_empty(&self) -> Result<(), String> {
        let Self { added, removed, moved, altered, environment, passages, .. } = self;
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

fn place_of(world: &World, thing: EntityId) -> Point2 {
    world.entity(thing).map_or(Point2::origin(), |thing| thing.planar())
}

fn yaw_in(world: &World, thing: EntityId) -> f64 {
    world.entity(thing).map_or(0.0, |thing| yaw_of(thing.pose))
}
