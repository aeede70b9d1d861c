//! An answer to typed edits. It conforms to the schema already; what is wrong beyond that is said to the model.

use serde_json::Value;
use simworld_core::environment::{Environment, Sun};
use simworld_core::geometry::Point2;
use simworld_core::id::{EntityId, RoadId};
use simworld_core::passage::Passage;
use simworld_core::scene::Relation;

use super::Recalled;
use crate::editing::{Asked, Edit, EditError, Line, Make, Sides, Spacing, Stand};
use crate::language::named_colors;

/// The edits, or the model's word that there are none; a fault is worth another try.
pub(super) fn understood(
    answer: &Value,
    known: &Recalled,
    asked: &Asked<'_>,
) -> Result<Result<Vec<Edit>, EditError>, String> {
    let reading = Answer { known, asked };
    let edits: Vec<Edit> =
        items(answer, "edits").iter().map(|edit| reading.edit(edit)).collect::<Result<_, _>>()?;
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

struct Answer<'a> {
    known: &'a Recalled,
    asked: &'a Asked<'a>,
}

impl Answer<'_> {
    fn edit(&self, edit: &Value) -> Result<Edit, String> {
        let things = || self.things(edit);
        Ok(match edit["do"].as_str().unwrap_or_default() {
            "add" => {
                let make = Make { scale: number(edit, "percent") * 0.01, ..self.make(edit)? };
                Edit::Add { make, count: count(edit), stands: self.places(edit)? }
            }
            "row" => {
                Edit::Row { make: self.make(edit)?, line: self.line(&edit["line"])?, spacing: spacing(edit)? }
            }
            "remove" => Edit::Remove { things: things()? },
            "move" => Edit::Move { things: things()?, stands: self.places(edit)? },
            "rotate" => Edit::Rotate { things: things()?, angle: number(edit, "degrees").to_radians() },
            "face" => Edit::Face { things: things()?, towards: self.thing(edit, "towards")? },
            "swap" => self.swap(edit)?,
            "paint" => Edit::Paint { things: things()?, color: color(edit).ok_or("it names no colour")? },
            "scale" => Edit::Scale { things: things()?, factor: number(edit, "percent") * 0.01 },
            "copy" => Edit::Copy {
                thing: self.thing(edit, "thing")?,
                count: count(edit),
                stands: self.places(edit)?,
            },
            "name" => {
                let name = edit["name"].as_str().unwrap_or_default().trim().to_owned();
                if name.is_empty() {
                    return Err("a name has letters".to_owned());
                }
                Edit::Name { thing: self.thing(edit, "thing")?, name }
            }
            "list" => Edit::List { things: things()? },
            "count" => Edit::Count { what: "such things".to_owned(), things: things()? },
            "describe" => Edit::Describe { thing: self.thing(edit, "thing")? },
            "weather" => Edit::SetEnvironment(sky(*self.asked.scene.environment(), edit)?),
            "close_streets" => Edit::SetPassage { roads: self.streets(edit)?, passage: Passage::Closed },
            "open_streets" => Edit::SetPassage { roads: self.streets(edit)?, passage: Passage::Open },
            other => return Err(format!("{other:?} is no edit")),
        })
    }

    fn swap(&self, edit: &Value) -> Result<Edit, String> {
        let (one, other) = (self.thing(edit, "one")?, self.thing(edit, "other")?);
        if one == other {
            Err("a thing cannot be swapped with itself".to_owned())
        } else {
            Ok(Edit::Swap { one, other })
        }
    }

    fn make(&self, edit: &Value) -> Result<Make, String> {
        let name = edit["asset"].as_str().unwrap_or_default();
        if !self.known.assets.iter().any(|asset| asset == name) {
            return Err(format!("there is no asset {name:?}"));
        }
        Ok(Make { color: color(edit), ..Make::of(name) })
    }

    // ---- things and streets ----

    fn id(&self, written: &Value) -> Result<EntityId, String> {
        let text = written.as_str().unwrap_or_default();
        let known = self.known.things.iter().find(|(known, _)| known == text);
        known.map(|(_, id)| *id).ok_or_else(|| format!("there is no {text:?}"))
    }

    fn thing(&self, edit: &Value, field: &str) -> Result<EntityId, String> {
        self.id(&edit[field])
    }

    fn things(&self, edit: &Value) -> Result<Vec<EntityId>, String> {
        let mut all: Vec<EntityId> = Vec::new();
        for id in items(edit, "things") {
            let id = self.id(id)?;
            if !all.contains(&id) {
                all.push(id);
            }
        }
        Ok(all)
    }

    fn street(&self, name: &Value) -> Result<Vec<RoadId>, String> {
        let name = name.as_str().unwrap_or_default();
        self.known.streets.get(name).cloned().ok_or_else(|| format!("there is no street {name:?}"))
    }

    fn streets(&self, edit: &Value) -> Result<Vec<RoadId>, String> {
        let roads: Vec<Vec<RoadId>> =
            items(edit, "streets").iter().map(|name| self.street(name)).collect::<Result<_, _>>()?;
        Ok(roads.concat())
    }

    // ---- places ----

    fn places(&self, edit: &Value) -> Result<Vec<Stand>, String> {
        items(edit, "places").iter().map(|place| self.place(place)).collect()
    }

    fn place(&self, place: &Value) -> Result<Stand, String> {
        let anchor = || self.thing(place, "of");
        let to = |relation| Ok(Stand::To { relation, anchor: anchor()? });
        Ok(match place["is"].as_str().unwrap_or_default() {
            "here" => Stand::Around { point: self.asked.from },
            "at" => {
                Stand::At { point: Point2::new(number(place, "east") * 0.01, number(place, "north") * 0.01) }
            }
            "between" => {
                let (one, other) = (anchor()?, self.thing(place, "and")?);
                if one == other {
                    return Err("nothing is between a thing and itself".to_owned());
                }
                Stand::Between { one, other }
            }
            "offset" => Stand::Offset {
                anchor: anchor()?,
                heading: number(place, "degrees").to_radians(),
                distance: number(place, "distance") * 0.01,
            },
            "along_street" => Stand::AlongRoad { roads: self.street(&place["street"])? },
            "along" => Stand::Along { anchor: anchor()? },
            "at_corner_of" => Stand::AtCornerOf { anchor: anchor()? },
            "across_from" => Stand::AcrossFrom { anchor: anchor()? },
            "on_block_of" => Stand::OnBlockOf { anchor: anchor()? },
            "in_middle_of" => Stand::InMiddleOf { anchor: anchor()? },
            "at_edge_of" => Stand::AtEdgeOf { anchor: anchor()? },
            "next_to" => return to(Relation::NextTo),
            "near" => return to(Relation::Near),
            "far_from" => return to(Relation::FarFrom),
            "in_front_of" => return to(Relation::InFrontOf),
            "behind" => return to(Relation::Behind),
            "left_of" => return to(Relation::LeftOf),
            "right_of" => return to(Relation::RightOf),
            "on_top_of" => return to(Relation::OnTopOf),
            "inside" => return to(Relation::Inside),
            other => return Err(format!("{other:?} is no place")),
        })
    }

    fn line(&self, line: &Value) -> Result<Line, String> {
        Ok(match line["is"].as_str().unwrap_or_default() {
            "along" => Line::Along { anchor: self.thing(line, "of")? },
            "around" => Line::Around { anchor: self.thing(line, "of")? },
            "between" => Line::Between { one: self.thing(line, "of")?, other: self.thing(line, "and")? },
            "along_street" => Line::Road { roads: self.street(&line["street"])?, sides: Sides::Either },
            "both_sides_of_street" => Line::Road { roads: self.street(&line["street"])?, sides: Sides::Both },
            other => return Err(format!("{other:?} is no line")),
        })
    }
}

fn items<'a>(of: &'a Value, field: &str) -> &'a [Value] {
    of[field].as_array().map(Vec::as_slice).unwrap_or_default()
}

fn number(of: &Value, field: &str) -> f64 {
    super::super::schema::whole(&of[field]).unwrap_or_default() as f64
}

fn count(of: &Value) -> u32 {
    number(of, "count") as u32
}

fn spacing(edit: &Value) -> Result<Spacing, String> {
    match (count(edit), number(edit, "every")) {
        (0, every) if every > 0.0 => Ok(Spacing::Every(every * 0.01)),
        (count, 0.0) if count > 0 => Ok(Spacing::Count(count)),
        _ => Err("a row has either a count or a distance: one of the two is 0".to_owned()),
    }
}

fn color(of: &Value) -> Option<[f32; 3]> {
    let name = of["color"].as_str()?;
    named_colors().find(|(known, _)| *known == name).map(|(_, color)| color)
}

fn sky(mut now: Environment, edit: &Value) -> Result<Environment, String> {
    let weather = &mut now.weather;
    let dry = |weather: &mut simworld_core::environment::Weather, clouds: f64| {
        (weather.rain, weather.snow, weather.cloud_cover) = (0.0, 0.0, clouds);
    };
    let sky = edit["sky"].as_str().unwrap_or_default();
    match sky {
        "clear" => {
            dry(weather, 0.1);
            weather.visibility = 20_000.0;
        }
        "cloudy" => dry(weather, 0.95),
        "light_rain" | "rain" | "heavy_rain" => {
            dry(weather, 0.95);
            weather.rain = if sky == "light_rain" {
                2.0
            } else if sky == "rain" {
                4.0
            } else {
                20.0
            };
        }
        "snow" => {
            dry(weather, 0.95);
            (weather.snow, weather.temperature) = (3.0, weather.temperature.min(-1.0));
        }
        "fog" => weather.visibility = 200.0,
        "thick_fog" => weather.visibility = 60.0,
        _ => {}
    }
    let minutes = number(edit, "minutes");
    if sky == "as_it_is" && minutes < 0.0 {
        return Err("it changes neither the sky nor the time".to_owned());
    }
    if minutes >= 0.0 {
        now.sun = Sun::at_hour(minutes / 60.0);
    }
    Ok(now)
}
