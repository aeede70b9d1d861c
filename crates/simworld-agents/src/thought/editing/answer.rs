//! An answer to typed edits. It conforms to the schema already; what is wrong beyond that is said to the model.

use std::cell::Cell;

use serde_json::Value;
use simworld_core::asset::{Asset, Season};
use simworld_core::environment::Environment;
use simworld_core::geometry::yaw_of;
use simworld_core::id::{EntityId, RoadId};
use simworld_core::ops::wrap_angle;
use simworld_core::passage::Passage;
use simworld_core::scene::EntityRef;

use super::Recalled;
use super::bearings::by_compass;
use super::shape::AS_IT_IS;
use crate::editing::{Asked, Edit, EditError, Make, Spacing};
use crate::language::{named_colors, sky_by_names};

/// The edits, or the model's word that there are none; a fault is worth another try.
pub(super) fn understood(
    answer: &Value,
    known: &Recalled,
    asked: &Asked<'_>,
) -> Result<Result<Vec<Edit>, EditError>, String> {
    let reading = Answer { known, asked, sky: Cell::new(*asked.scene.environment()) };
    let mut edits = Vec::new();
    for edit in items(answer, "edits") {
        edits.extend(reading.edit(edit)?);
    }
    let cannot = answer["cannot"].as_str().unwrap_or_default().trim();
    match (edits.is_empty(), cannot.is_empty()) {
        (true, true) => {
            Err("it has no edits: give edits, or say in \"cannot\" why there are none".to_owned())
        }
        (false, false) => Err("it has edits, and says that there can be none: give either".to_owned()),
        (true, false) => Ok(Err(EditError::NotUnderstood {
            words: asked.words.to_owned(),
            fragment: String::new(),
            hint: cannot.to_owned(),
        })),
        (false, true) => Ok(Ok(edits)),
    }
}

pub(super) struct Answer<'a> {
    pub(super) known: &'a Recalled,
    pub(super) asked: &'a Asked<'a>,
    /// Sun and weather as the edits so far leave them.
    sky: Cell<Environment>,
}

/// How large something is to be.
enum Size {
    Times(f64),
    /// m.
    High(f64),
}

impl Answer<'_> {
    /// The edits that one of the answer means: most mean one.
    fn edit(&self, edit: &Value) -> Result<Vec<Edit>, String> {
        let things = || self.things(edit);
        Ok(vec![match edit["do"].as_str().unwrap_or_default() {
            "face_compass" => return self.face_compass(edit),
            "scale" => return self.scale(edit),
            "add" => Edit::Add { make: self.make(edit)?, count: count(edit), stands: self.places(edit)? },
            "row" => {
                Edit::Row { make: self.make(edit)?, line: self.line(&edit["line"])?, spacing: spacing(edit)? }
            }
            "remove" => Edit::Remove { things: things()? },
            "move" => Edit::Move { things: things()?, stands: self.places(edit)? },
            "rotate" => Edit::Rotate { things: things()?, angle: number(edit, "degrees").to_radians() },
            "face" => Edit::Face { things: things()?, towards: self.anchor(edit, "towards")? },
            "swap" => self.swap(edit)?,
            "paint" => Edit::Paint { things: things()?, color: color(edit).ok_or("it names no colour")? },
            "paint_like" => Edit::Paint { things: things()?, color: self.color_of(edit)? },
            "copy" => Edit::Copy {
                thing: self.thing(edit, "thing")?,
                count: count(edit),
                stands: self.places(edit)?,
            },
            "name" => {
                let name = text(edit, "name").ok_or("a name has letters")?;
                Edit::Name { thing: self.thing(edit, "thing")?, name }
            }
            "list" => Edit::List { things: things()? },
            "count" => {
                let what = text(edit, "what").unwrap_or_else(|| "such things".to_owned());
                Edit::Count { what, things: things()? }
            }
            "describe" => Edit::Describe { thing: self.thing(edit, "thing")? },
            "tell" => Edit::Leave { why: text(edit, "words").ok_or("it tells nothing")? },
            "weather" => self.weather(edit)?,
            "close_streets" => Edit::SetPassage { roads: self.streets(edit)?, passage: Passage::Closed },
            "open_streets" => Edit::SetPassage { roads: self.streets(edit)?, passage: Passage::Open },
            other => return Err(format!("{other:?} is no edit")),
        }])
    }

    fn swap(&self, edit: &Value) -> Result<Edit, String> {
        let (one, other) = (self.thing(edit, "one")?, self.thing(edit, "other")?);
        if one == other {
            Err("a thing cannot be swapped with itself".to_owned())
        } else {
            Ok(Edit::Swap { one, other })
        }
    }

    fn face_compass(&self, edit: &Value) -> Result<Vec<Edit>, String> {
        let side = edit["side"].as_str().unwrap_or_default();
        let heading = by_compass(side).ok_or_else(|| format!("{side:?} is no direction"))?;
        let turn = |thing: EntityId| {
            let angle = wrap_angle(heading - yaw_of(self.entity(thing)?.pose));
            Ok(Edit::Rotate { things: vec![thing], angle })
        };
        self.things(edit)?.into_iter().map(turn).collect()
    }

    fn scale(&self, edit: &Value) -> Result<Vec<Edit>, String> {
        let things = self.things(edit)?;
        match size(edit)? {
            Size::Times(factor) => Ok(vec![Edit::Scale { things, factor }]),
            Size::High(metres) => {
                let scaled = |thing: EntityId| {
                    let factor = metres / self.entity(thing)?.info.shape.size().z;
                    Ok(Edit::Scale { things: vec![thing], factor })
                };
                things.into_iter().map(scaled).collect()
            }
        }
    }

    fn weather(&self, edit: &Value) -> Result<Edit, String> {
        let (sky, minutes) = (items(edit, "sky"), number(edit, "minutes") as i64);
        if sky.is_empty() && minutes < 0 {
            return Err("it changes neither the sky nor the time".to_owned());
        }
        let now = sky_by_names(self.sky.get(), sky.iter().filter_map(Value::as_str), minutes);
        self.sky.set(now);
        Ok(Edit::SetEnvironment(now))
    }

    fn make(&self, edit: &Value) -> Result<Make, String> {
        let name = edit["asset"].as_str().unwrap_or_default();
        let found = || self.asked.catalogue.find(name).and_then(|id| self.asked.catalogue.get(id));
        let is_known = self.known.assets.iter().any(|asset| asset == name);
        let asset = found().filter(|_| is_known).ok_or_else(|| format!("there is no asset {name:?}"))?;
        let scale = match size(edit)? {
            Size::Times(factor) => factor,
            Size::High(metres) => metres / asset.collider.size().z,
        };
        Ok(Make { color: paint(edit, asset)?, scale, name: text(edit, "name"), ..Make::of(name) })
    }

    /// The colour of a thing, for others.
    fn color_of(&self, edit: &Value) -> Result<[f32; 3], String> {
        let like = self.anchor(edit, "like")?;
        self.entity(like)?.info.color.ok_or_else(|| format!("{like} has no colour of its own"))
    }

    // ---- things and streets ----

    /// Something that is there before the first edit.
    pub(super) fn entity(&self, id: EntityId) -> Result<EntityRef<'_>, String> {
        let entity = self.asked.scene.entity(id);
        entity.ok_or_else(|| "what an answer makes itself has no place, size and colour yet".to_owned())
    }

    fn subject(&self, written: &Value) -> Result<EntityId, String> {
        let text = written.as_str().unwrap_or_default();
        self.known.subject(text).ok_or_else(|| format!("there is no {text:?}"))
    }

    fn thing(&self, edit: &Value, field: &str) -> Result<EntityId, String> {
        self.subject(&edit[field])
    }

    /// What something stands to, or looks at.
    pub(super) fn anchor(&self, of: &Value, field: &str) -> Result<EntityId, String> {
        let text = of[field].as_str().unwrap_or_default();
        self.known.anchor(text).ok_or_else(|| format!("there is no {text:?}"))
    }

    fn things(&self, edit: &Value) -> Result<Vec<EntityId>, String> {
        let mut all: Vec<EntityId> = Vec::new();
        for id in items(edit, "things") {
            let id = self.subject(id)?;
            if !all.contains(&id) {
                all.push(id);
            }
        }
        Ok(all)
    }

    /// The pieces of some streets.
    pub(super) fn streets(&self, of: &Value) -> Result<Vec<RoadId>, String> {
        let mut roads: Vec<RoadId> = Vec::new();
        for name in items(of, "streets") {
            let name = name.as_str().unwrap_or_default();
            let street = self.known.streets.get(name);
            for road in street.ok_or_else(|| format!("there is no street {name:?}"))? {
                if !roads.contains(road) {
                    roads.push(*road);
                }
            }
        }
        Ok(roads)
    }
}

pub(super) fn items<'a>(of: &'a Value, field: &str) -> &'a [Value] {
    of[field].as_array().map(Vec::as_slice).unwrap_or_default()
}

pub(super) fn number(of: &Value, field: &str) -> f64 {
    super::super::schema::whole(&of[field]).unwrap_or_default() as f64
}

/// Centimetres in metres.
pub(super) fn metres(of: &Value, field: &str) -> f64 {
    number(of, field) / 100.0
}

fn count(of: &Value) -> u32 {
    number(of, "count") as u32
}

/// A text, if it says something.
fn text(of: &Value, field: &str) -> Option<String> {
    of[field].as_str().map(|text| text.trim().to_owned()).filter(|text| !text.is_empty())
}

fn spacing(edit: &Value) -> Result<Spacing, String> {
    match (count(edit), metres(edit, "every")) {
        (0, every) if every > 0.0 => Ok(Spacing::Every(every)),
        (count, 0.0) if count > 0 => Ok(Spacing::Count(count)),
        _ => Err("a row has either a count or a distance: one of the two is 0".to_owned()),
    }
}

fn size(edit: &Value) -> Result<Size, String> {
    match (number(edit, "percent"), metres(edit, "height")) {
        (percent, 0.0) if percent > 0.0 => Ok(Size::Times(percent / 100.0)),
        (0.0, height) if height > 0.0 => Ok(Size::High(height)),
        _ => Err("a size is either a percentage or a height: one of the two is 0".to_owned()),
    }
}

/// The colour of a new thing; nothing if it has that of its asset.
fn paint(edit: &Value, asset: &Asset) -> Result<Option<[f32; 3]>, String> {
    let name = edit["color"].as_str().unwrap_or(AS_IT_IS);
    let season = Season::ALL.into_iter().find(|season| season.as_str() == name);
    match season {
        Some(season) if asset.seasons.is_some() => Ok(asset.color_in(season)),
        Some(season) => Err(format!("{} is no other in {season}", asset.name)),
        None => Ok(color(edit)),
    }
}

fn color(of: &Value) -> Option<[f32; 3]> {
    let name = of["color"].as_str()?;
    named_colors().find(|(known, _)| *known == name).map(|(_, color)| color)
}
