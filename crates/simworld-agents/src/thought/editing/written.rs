//! Edits as a model answers them.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;

use serde_json::{Value, json};
use simworld_core::asset::Season;
use simworld_core::environment::Environment;
use simworld_core::geometry::{Aabb, yaw_of};
use simworld_core::id::{EntityId, IntersectionId, RoadId};
use simworld_core::passage::Passage;
use simworld_core::scene::EntityRef;

use super::super::schema::check;
use super::super::unsayable::Unsayable;
use super::bearings::compass_of;
use super::recall::{NEW, VIEWER};
use super::shape::{AS_IT_IS, MOST_EDITS, schema};
use super::ways::Ways;
use super::{Recalled, answer};
use crate::editing::{Asked, Edit, EditError, Make, Spacing, nth_made};
use crate::language::{named_colors, names_of_sky};

/// Numbers that differ from whole ones by less are whole.
const WHOLE: f64 = 1e-6;
/// As far around as a thing of some colour is looked for, m.
const EVERYWHERE: f64 = 1e6;

/// Edits as a model answers them, by the schema of [`ModelReader`](super::ModelReader) for what these edits speak of: to show one by
/// example, to train it, and the proof that it can say what the grammar says.
///
/// Distances are whole centimetres in an answer, angles whole degrees and sizes whole percentages or heights in centimetres, so that
/// edits come back rounded to these.
///
/// ```
/// use simworld_agents::editing::{Asked, Edit, Make, Stand};
/// use simworld_agents::thought::EditAnswer;
/// use simworld_core::asset::Catalogue;
/// use simworld_core::geometry::Point2;
/// use simworld_core::scene::World;
/// let (world, catalogue) = (World::new(), Catalogue::library());
/// let asked =
///     Asked { words: "", scene: &world, catalogue: &catalogue, from: Point2::origin(), who: None, it: None };
/// let stands = vec![Stand::At { point: Point2::new(2.5, -1.0) }];
/// let edits = vec![Edit::Add { make: Make::of("bench"), count: 1, stands }];
/// let answer = EditAnswer::of(&edits, &[], &asked)?;
/// assert_eq!(answer.value()["edits"][0]["places"][0]["east"], 250);
/// assert_eq!(answer.edits(&asked)?.unwrap(), edits);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct EditAnswer {
    value: Value,
    schema: Value,
    known: Recalled,
}

impl EditAnswer {
    /// The answer that means these edits, asked about the scene as it is before the first of them. `made` are the things that they
    /// made, in order, where they speak of these by their ids instead of [`Edit::made`].
    ///
    /// # Errors
    /// The schema has no words for some of it: it speaks of what is not there, or wears a colour that has no name.
    pub fn of(edits: &[Edit], made: &[EntityId], asked: &Asked<'_>) -> Result<Self, Unsayable> {
        let mut writer = Writer {
            asked,
            made,
            ways: asked.scene.roads().map(|network| Ways::of(network)),
            sky: *asked.scene.environment(),
            used: Used::default(),
        };
        let written = edits.iter().map(|edit| writer.edit(edit)).collect::<Result<Vec<_>, _>>()?;
        let known = writer.used.recalled(asked);
        let schema = schema(&known, written.len().max(MOST_EDITS));
        let value = json!({ "cannot": "", "edits": written });
        check(&value, &schema).map_err(|mismatch| Unsayable::new(format!("that: {mismatch}")))?;
        Ok(Self { value, schema, known })
    }

    /// The answer itself.
    pub fn value(&self) -> &Value {
        &self.value
    }

    /// The schema that it conforms to, over what the edits speak of and nothing else.
    pub fn schema(&self) -> &Value {
        &self.schema
    }

    /// What the answer means, read as the answer of a model is read.
    ///
    /// # Errors
    /// The outer one: what is wrong with the answer, as a model would be told. The inner one: why it means none.
    pub fn edits(&self, asked: &Asked<'_>) -> Result<Result<Vec<Edit>, EditError>, String> {
        check(&self.value, &self.schema).map_err(|mismatch| mismatch.to_string())?;
        answer::understood(&self.value, &self.known, asked)
    }
}

/// What the answer speaks of.
#[derive(Default)]
pub(super) struct Used {
    things: BTreeSet<EntityId>,
    assets: BTreeSet<String>,
    pub(super) streets: BTreeMap<String, Vec<RoadId>>,
    pub(super) junctions: BTreeMap<String, IntersectionId>,
    made: usize,
}

impl Used {
    fn recalled(self, asked: &Asked<'_>) -> Recalled {
        Recalled {
            things: self.things.into_iter().map(|id| (id.to_string(), id)).collect(),
            assets: self.assets.into_iter().collect(),
            streets: self.streets,
            junctions: self.junctions,
            viewer: asked.who,
            made: self.made as u32,
            lines: Vec::new(),
        }
    }
}

pub(super) struct Writer<'a> {
    pub(super) asked: &'a Asked<'a>,
    made: &'a [EntityId],
    pub(super) ways: Option<Ways<'a>>,
    /// Sun and weather as the edits so far leave them.
    sky: Environment,
    pub(super) used: Used,
}

impl Writer<'_> {
    fn edit(&mut self, edit: &Edit) -> Result<Value, Unsayable> {
        Ok(match edit {
            Edit::Add { make, count, stands } => {
                let more = json!({ "do": "add", "count": count, "places": self.places(stands, None)? });
                joined(self.make(make)?, more)
            }
            Edit::Row { make, line, spacing } => {
                let (count, every) = match spacing {
                    Spacing::Count(count) => (*count, 0),
                    Spacing::Every(every) => (0, hundredths(*every)),
                };
                let more = json!({ "do": "row", "line": self.line(line)?, "count": count, "every": every });
                joined(self.make(make)?, more)
            }
            Edit::Remove { things } => json!({ "do": "remove", "things": self.things(things)? }),
            Edit::Move { things, stands } => {
                let moved = if let [only] = things[..] { Some(only) } else { None };
                let places = self.places(stands, moved)?;
                json!({ "do": "move", "things": self.things(things)?, "places": places })
            }
            Edit::Rotate { things, angle } => self.rotate(things, *angle)?,
            Edit::Face { things, towards } => {
                json!({ "do": "face", "things": self.things(things)?, "towards": self.anchor(*towards)? })
            }
            Edit::Swap { one, other } => {
                json!({ "do": "swap", "one": self.thing(*one)?, "other": self.thing(*other)? })
            }
            Edit::Paint { things, color } => self.paint(things, *color)?,
            Edit::Scale { things, factor } => self.scale(things, *factor)?,
            Edit::Copy { thing, count, stands } => {
                let places = self.places(stands, None)?;
                json!({ "do": "copy", "thing": self.thing(*thing)?, "count": count, "places": places })
            }
            Edit::Name { thing, name } => {
                json!({ "do": "name", "thing": self.thing(*thing)?, "name": name })
            }
            Edit::SetEnvironment(sky) => self.weather(sky)?,
            Edit::SetPassage { roads, passage } => {
                let act = if *passage == Passage::Closed { "close_streets" } else { "open_streets" };
                json!({ "do": act, "streets": self.streets(roads)? })
            }
            Edit::Leave { why } => json!({ "do": "tell", "words": why }),
            Edit::Count { what, things } => {
                json!({ "do": "count", "what": what, "things": self.things(things)? })
            }
            Edit::List { things } => json!({ "do": "list", "things": self.things(things)? }),
            Edit::Describe { thing } => json!({ "do": "describe", "thing": self.thing(*thing)? }),
        })
    }

    fn weather(&mut self, sky: &Environment) -> Result<Value, Unsayable> {
        let (names, minutes) =
            names_of_sky(self.sky, sky).ok_or_else(|| Unsayable::new("such a sun or weather"))?;
        self.sky = *sky;
        // A sky that stays as it is has to be told all the same.
        let names = if names.is_empty() && minutes < 0 { vec![unchanged(sky)?] } else { names };
        Ok(json!({ "do": "weather", "sky": names, "minutes": minutes }))
    }

    /// A turn by whole degrees; any other is one to a direction of the compass, or is rounded.
    fn rotate(&mut self, things: &[EntityId], angle: f64) -> Result<Value, Unsayable> {
        let degrees = angle.to_degrees();
        if let [only] = things[..]
            && (degrees - degrees.round()).abs() > WHOLE
            && let Some(entity) = self.asked.scene.entity(only)
            && let Some(side) = compass_of(yaw_of(entity.pose) + angle)
        {
            return Ok(json!({ "do": "face_compass", "things": self.things(things)?, "side": side }));
        }
        Ok(json!({ "do": "rotate", "things": self.things(things)?, "degrees": degrees.round() as i64 }))
    }

    fn paint(&mut self, things: &[EntityId], color: [f32; 3]) -> Result<Value, Unsayable> {
        let things = self.things(things)?;
        if let Some(name) = name_of(color) {
            return Ok(json!({ "do": "paint", "things": things, "color": name }));
        }
        let like = self.wearing(color).ok_or_else(|| Unsayable::new("a colour that nothing has"))?;
        Ok(json!({ "do": "paint_like", "things": things, "like": self.anchor(like)? }))
    }

    /// The first thing of a colour.
    fn wearing(&self, color: [f32; 3]) -> Option<EntityId> {
        let mut found: Option<EntityId> = None;
        let region = Aabb::column_around(self.asked.from, EVERYWHERE);
        let _ = self.asked.scene.visit(&region, &mut |entity: EntityRef<'_>| {
            if entity.info.color == Some(color) && found.is_none_or(|first| entity.id < first) {
                found = Some(entity.id);
            }
            ControlFlow::Continue(())
        });
        found
    }

    fn scale(&mut self, things: &[EntityId], factor: f64) -> Result<Value, Unsayable> {
        let high = match things[..] {
            [only] => self.asked.scene.entity(only).map(|entity| entity.info.shape.size().z),
            _ => None,
        };
        let (percent, height) = size(factor, high);
        let things = self.things(things)?;
        Ok(json!({ "do": "scale", "things": things, "percent": percent, "height": height }))
    }

    /// What is made, without where and how many.
    fn make(&mut self, make: &Make) -> Result<Value, Unsayable> {
        let catalogue = self.asked.catalogue;
        let asset = catalogue.find(&make.asset).and_then(|id| catalogue.get(id));
        let asset = asset.ok_or_else(|| Unsayable::new(format!("the asset {:?}", make.asset)))?;
        self.used.assets.insert(make.asset.clone());
        let in_season = |color| {
            let season = Season::ALL.into_iter().find(|season| asset.color_in(*season) == Some(color));
            season.filter(|_| asset.seasons.is_some()).map(Season::as_str)
        };
        let color = match make.color {
            None => AS_IT_IS,
            Some(color) => name_of(color)
                .or_else(|| in_season(color))
                .ok_or_else(|| Unsayable::new("a colour without a name"))?,
        };
        let (percent, height) = size(make.scale, Some(asset.collider.size().z));
        let name = make.name.as_deref().unwrap_or_default();
        Ok(json!({ "asset": make.asset, "color": color, "name": name, "percent": percent, "height": height }))
    }

    // ---- things and streets ----

    pub(super) fn thing(&mut self, id: EntityId) -> Result<String, Unsayable> {
        let nth = self.made.iter().position(|own| *own == id).or_else(|| nth_made(id));
        if let Some(nth) = nth {
            self.used.made = self.used.made.max(nth + 1);
            return Ok(format!("{NEW}{}", nth + 1));
        }
        if self.asked.scene.entity(id).is_none() {
            return Err(Unsayable::new(format!("{id}, which is not there")));
        }
        self.used.things.insert(id);
        Ok(id.to_string())
    }

    /// What something stands to, or looks at.
    pub(super) fn anchor(&mut self, id: EntityId) -> Result<String, Unsayable> {
        if self.asked.who == Some(id) { Ok(VIEWER.to_owned()) } else { self.thing(id) }
    }

    fn things(&mut self, ids: &[EntityId]) -> Result<Vec<String>, Unsayable> {
        ids.iter().map(|id| self.thing(*id)).collect()
    }

    /// Some roads as a whole street, or piece by piece.
    pub(super) fn streets(&mut self, roads: &[RoadId]) -> Result<Vec<String>, Unsayable> {
        let ways = self.ways.as_ref().ok_or_else(|| Unsayable::new("streets of a scene that has none"))?;
        let whole = ways.streets().find(|(_, all)| *all == roads).map(|(name, _)| name.trim().to_owned());
        if let Some(name) = whole {
            let name = super::super::prompts::one_line(&name);
            self.used.streets.insert(name.clone(), roads.to_vec());
            return Ok(vec![name]);
        }
        let pieces: Vec<String> = roads.iter().map(|road| ways.piece(*road)).collect();
        self.used.streets.extend(pieces.iter().cloned().zip(roads.iter().map(|road| vec![*road])));
        Ok(pieces)
    }
}

/// One object of two.
fn joined(mut one: Value, other: Value) -> Value {
    if let (Some(one), Value::Object(other)) = (one.as_object_mut(), other) {
        one.extend(other);
    }
    one
}

/// Metres in whole centimetres.
pub(super) fn hundredths(metres: f64) -> i64 {
    (metres * 100.0).round() as i64
}

/// A factor as a percentage and a height, one of which is zero: whole percentages, heights in whole centimetres, or the nearest
/// percentage.
fn size(factor: f64, high: Option<f64>) -> (i64, i64) {
    let percent = factor * 100.0;
    let height = high.map_or(f64::NAN, |high| factor * high * 100.0);
    let is_whole = |number: f64| number >= 1.0 && (number - number.round()).abs() < WHOLE;
    if !is_whole(percent) && is_whole(height) {
        return (0, height.round() as i64);
    }
    ((percent.round() as i64).max(1), 0)
}

fn name_of(color: [f32; 3]) -> Option<&'static str> {
    named_colors().find(|(_, own)| *own == color).map(|(name, _)| name)
}

/// A word that leaves a sky as it is.
fn unchanged(sky: &Environment) -> Result<String, Unsayable> {
    let names = crate::language::sky_names();
    let stays =
        |name: &String| crate::language::sky_by_names(*sky, std::iter::once(name.as_str()), -1) == *sky;
    names.into_iter().find(stays).ok_or_else(|| Unsayable::new("that nothing changes"))
}
