//! What is answered or done by how things are just now: what the sky is like, which streets are closed, the colour of a thing.

use simworld_core::environment::Environment;
use simworld_core::geometry::Point2;
use simworld_core::id::{EntityId, RoadId};
use simworld_core::net::LaneDirection;

use super::super::clause::Reference;
use super::resolve::Finder;
use super::wish::{StreetRef, Wish};
use super::words::{Sky, warmth_of};
use super::{Focus, view_of};
use crate::editing::{Edit, EditError};

/// Seen farther than this there is no fog, m.
const FOG: f64 = 1000.0;
/// Under less cloud the sky is clear.
const CLOUDED: f64 = 0.5;

impl Finder<'_> {
    /// Several wishes on one condition, in the scene as it is before the first of them.
    pub(super) fn all_of(&self, wishes: &[Wish]) -> Result<Vec<Edit>, EditError> {
        let mut edits = Vec::new();
        let mut focus = self.focus.clone();
        for wish in wishes {
            let view = view_of(self.scene, &focus);
            let finder = self.looking_with(&focus, view);
            let more = finder.edits(wish)?;
            // "Remove it and put a table there": where it stood, for by then it is gone.
            let gone = more.iter().find_map(|edit| match edit {
                Edit::Remove { things } => things.last().copied(),
                _ => None,
            });
            if let Some(gone) = gone {
                let place = self.scene.entity(gone).map(|entity| entity.planar());
                focus = Focus { it: None, place: place.or(focus.place), ..focus };
            }
            edits.extend(more);
        }
        Ok(edits)
    }

    /// The focus behind a condition: "it" and "there" are what it is about.
    pub(super) fn focus_on(&self, found: Option<EntityId>) -> Focus {
        let place: Option<Point2> = found.and_then(|id| self.scene.entity(id)).map(|entity| entity.planar());
        Focus { it: found.or(self.focus.it), place: place.or(self.focus.place), ..self.focus.clone() }
    }

    /// A wish, if the sky is so.
    pub(super) fn when(&self, sky: &[Sky], so: bool, then: &Wish) -> Result<Vec<Edit>, EditError> {
        let now = self.scene.environment();
        if sky.iter().all(|sky| is_so(now, *sky)) == so {
            return self.edits(then);
        }
        Ok(vec![Edit::Leave { why: format!("nothing was changed: {}", told(now)) }])
    }

    /// A wish, if streets are closed or are not.
    pub(super) fn when_passage(
        &self,
        which: &[StreetRef],
        closed: bool,
        then: &Wish,
    ) -> Result<Vec<Edit>, EditError> {
        let mut roads = Vec::new();
        for street in which {
            roads.extend(self.roads_of(street)?);
        }
        let is_closed = |road: &RoadId| {
            [LaneDirection::Forward, LaneDirection::Backward]
                .iter()
                .any(|way| self.scene.is_closed((*road, *way)))
        };
        if roads.iter().any(is_closed) == closed {
            let focus = Focus { roads, ..self.focus.clone() };
            let view = view_of(self.scene, &focus);
            return self.looking_with(&focus, view).edits(then);
        }
        let why = format!("nothing was changed: it is {}", if closed { "open" } else { "closed" });
        Ok(vec![Edit::Leave { why }])
    }

    /// What the sky is like.
    pub(super) fn sky_told(&self) -> Edit {
        Edit::Leave { why: told(self.scene.environment()) }
    }

    /// Which streets are closed.
    pub(super) fn passages_told(&self, which: &[StreetRef]) -> Result<Edit, EditError> {
        let is_closed = |road: &RoadId| {
            [LaneDirection::Forward, LaneDirection::Backward]
                .iter()
                .any(|way| self.scene.is_closed((*road, *way)))
        };
        if which.is_empty() {
            let closed = match self.roads_of(&StreetRef::Closed) {
                Err(EditError::NotFound { .. }) => Vec::new(),
                roads => roads?,
            };
            let mut names: Vec<&str> =
                closed.iter().filter_map(|road| self.scene.roads()?.road_name(*road)).collect();
            names.sort_unstable();
            names.dedup();
            let why = match (&closed[..], &names[..]) {
                ([], _) => "no street is closed".to_owned(),
                (_, []) => format!("{} pieces of streets are closed", closed.len()),
                (_, names) => format!("closed, in part or whole: {}", names.join(", ")),
            };
            return Ok(Edit::Leave { why });
        }
        let mut roads = Vec::new();
        for street in which {
            roads.extend(self.roads_of(street)?);
        }
        let closed = roads.iter().filter(|road| is_closed(road)).count();
        let why = match closed {
            0 => "it is open".to_owned(),
            all if all == roads.len() => "it is closed".to_owned(),
            part => format!("{part} of its {} pieces are closed", roads.len()),
        };
        Ok(Edit::Leave { why })
    }

    /// The colour of one thing for others.
    pub(super) fn painted_like(&self, what: &[Reference], like: &Reference) -> Result<Edit, EditError> {
        let model = self.one(like)?;
        let color = self.scene.entity(model).and_then(|entity| entity.info.color);
        let color = color.ok_or_else(|| EditError::Impossible {
            what: format!("to paint something like {}", like.text),
            why: "it has no colour of its own; name one".to_owned(),
        })?;
        Ok(Edit::Paint { things: self.all(what)?, color })
    }
}

/// Whether the sky is as words say.
fn is_so(now: &Environment, sky: Sky) -> bool {
    let weather = &now.weather;
    let is_dark = now.sun.elevation < 0.0;
    match sky {
        Sky::Rain(_) => weather.rain > 0.0,
        Sky::Snow(_) => weather.snow > 0.0,
        Sky::Fog(_) => weather.visibility <= FOG,
        Sky::Clear => {
            weather.rain == 0.0
                && weather.snow == 0.0
                && weather.visibility > FOG
                && weather.cloud_cover < CLOUDED
        }
        Sky::Cloudy => weather.cloud_cover >= CLOUDED,
        Sky::DryUp => weather.rain == 0.0,
        Sky::NoSnow => weather.snow == 0.0,
        Sky::NoFog => weather.visibility > FOG,
        Sky::Windy(speed) => weather.wind.norm() >= speed * 0.5,
        Sky::Warmth(degrees) if degrees < 15.0 => weather.temperature <= degrees,
        Sky::Warmth(degrees) => weather.temperature >= degrees,
        // Where nobody said which it is, it is told by the air.
        Sky::Season(season) => {
            now.season.map_or_else(|| is_so(now, Sky::Warmth(warmth_of(season))), |now| now == season)
        }
        Sky::Hour(hour) if (6.0..19.0).contains(&hour) => !is_dark,
        Sky::Hour(_) => is_dark,
    }
}

/// The sky in words.
fn told(now: &Environment) -> String {
    let weather = &now.weather;
    let falls = if weather.snow > 0.0 {
        "it snows"
    } else if weather.rain > 0.0 {
        "it rains"
    } else if weather.visibility <= FOG {
        "it is foggy"
    } else if weather.cloud_cover >= CLOUDED {
        "it is cloudy"
    } else {
        "the sky is clear"
    };
    let sun = now.sun.elevation.to_degrees();
    let light =
        if sun < 0.0 { "the sun is down".to_owned() } else { format!("the sun stands {sun:.0}° high") };
    let season = now.season.map_or_else(String::new, |season| format!(", {season}"));
    format!("{falls}, {:.0} °C, {light}{season}", weather.temperature)
}
