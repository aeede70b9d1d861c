//! Ends of streets, and corners and halves of areas by the compass: "at the east end of Oak Street", "in the north-east corner of the
//! park", "in the southern half of the square".

use simworld_core::geometry::Point2;
use simworld_core::id::{EntityId, IntersectionId, RoadId};
use simworld_core::scene::{EntityKind, Relation};
use simworld_core::seam::PlanError;

use super::super::compass::Compass;
use super::super::lexicon::longest_phrase;
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::resolve::Finder;
use super::wish::{Anchor, NewThing, Part, Where};
use crate::editing::{Edit, EditError, Stand};

/// What stands before a part of something.
#[rustfmt::skip]
const BEFORE: &Phrases = &Phrases::of(&["at the", "on the", "in the", "near the", "by the", "to the", "into the", "inside the", "over to the", "over in the", "along the", "right at the", "right in the", "at its", "at", "in", "on",
    "within the", "somewhere in the", "somewhere at the", "down at the", "up at the", "towards the", "next to the", "over the"]);
/// An end of a street.
const ENDS: &[&str] = &["end of", "tip of", "edge of", "end on"];
/// Half of an area, or a part of it that is as good.
#[rustfmt::skip]
const HALVES: &[&str] = &["half of", "part of", "section of", "area of", "portion of", "end of", "third of", "region of", "bit of", "quarter of", "side inside", "side within"];
const CORNERS: &[&str] = &["corner of", "corner in", "corner inside"];

impl Reader<'_> {
    /// Whether a part of a street or of an area begins at a token.
    pub(super) fn begins_part(&self, at: usize) -> bool {
        // Most words begin none, and looking is dear.
        longest_phrase(&self.lexemes[at.min(self.lexemes.len())..], BEFORE).is_some()
            && matches!(Reader { at, ..*self }.part_of(self.lexemes.len()), Ok(Some(_)))
    }

    /// A part of a street or of an area, if one is named here.
    ///
    /// # Errors
    /// What it is of is not there.
    pub(super) fn part_of(&mut self, end: usize) -> Result<Option<Where>, PlanError> {
        let start = self.at;
        let found = self.try_part_of(end);
        if !matches!(found, Ok(Some(_))) {
            self.at = start;
        }
        found
    }

    fn try_part_of(&mut self, end: usize) -> Result<Option<Where>, PlanError> {
        let inside =
            matches!(self.word(self.at), Some("in" | "into" | "inside" | "within" | "over" | "somewhere"));
        if !self.eat_any(BEFORE) {
            return Ok(None);
        }
        let mut parser = self.parser(self.at, end);
        let compass = parser.compass_of_part();
        self.at = parser.at;
        // "On the north side of the park" is outside, and "in" it is not.
        let is_side = inside && self.eat_any(&["side of"]);
        let corner = !is_side && self.eat_any(CORNERS);
        let at = self.at;
        if let Some(compass) = compass.filter(|_| corner) {
            return Ok(Some(Where::Part(compass, Part::Corner, self.anchor(end)?)));
        }
        if !corner && (self.eat_any(ENDS) || compass.is_some() && self.eat_any(&["side of"])) {
            let is_end = self.word(self.at - 2) != Some("side");
            if let Some(Anchor::Street(name, roads)) = self.street(end).filter(|_| is_end) {
                return Ok(Some(Where::End(compass, roads, name)));
            }
            self.at = at;
        }
        let Some(compass) = compass.filter(|_| !corner && (is_side || self.eat_any(HALVES))) else {
            return Ok(None);
        };
        if let Some(Anchor::Street(name, roads)) = self.street(end) {
            let half = self
                .view
                .scene
                .roads()
                .map_or_else(Vec::new, |network| super::ground::half_of(network, &roads, compass));
            let is_some = !half.is_empty();
            return Ok(is_some.then_some(Where::Along(Anchor::Street(name, half))));
        }
        let anchor = self.anchor(end)?;
        let is_area = matches!(&anchor, Anchor::Thing(thing) if self.is_ground_named(thing));
        Ok(is_area.then_some(Where::Part(compass, Part::Half, anchor)))
    }

    /// "Dot five chairs around the park": in it.
    pub(super) fn spread(&self, wish: &mut super::wish::Wish) {
        for place in wish.places_mut() {
            if let Where::Around(Anchor::Thing(thing)) = place
                && self.is_ground_named(thing)
            {
                *place = Where::To(Relation::Inside, Anchor::Thing(thing.clone()));
            }
        }
    }

    /// Whether a phrase means a piece of ground.
    fn is_ground_named(&self, thing: &super::super::clause::Reference) -> bool {
        use super::super::clause::Target;
        let is_ground = |id: &EntityId| {
            self.view.scene.entity(*id).is_some_and(|entity| entity.kind == EntityKind::Ground)
        };
        match &thing.target {
            Target::Any(class) => class.is_area(),
            Target::Named(ids) => ids.iter().all(is_ground),
            _ => false,
        }
    }
}

impl Finder<'_> {
    /// A part of a street or of an area, as places that all hold.
    pub(super) fn part(&self, place: &Where, moved: &[EntityId]) -> Result<Vec<Stand>, EditError> {
        match place {
            Where::End(compass, roads, name) => {
                let point = self.end_of(*compass, roads, name)?;
                Ok(vec![Stand::AlongRoad { roads: roads.clone() }, Stand::Around { point }])
            }
            Where::Part(compass, part, anchor) => {
                let anchor = self.anchor(anchor, moved)?;
                let towards = Stand::Towards { heading: compass.heading(), anchor };
                Ok(match part {
                    Part::Corner => vec![Stand::AtCornerOf { anchor }, towards],
                    Part::Half => vec![Stand::To { relation: Relation::Inside, anchor }, towards],
                })
            }
            _ => {
                let what = "to stand at both ends".to_owned();
                Err(EditError::Impossible { what, why: "say at which of the two".to_owned() })
            }
        }
    }

    /// One at either end of a street, or half of them.
    pub(super) fn at_two_ends(
        &self,
        thing: &NewThing,
        roads: &[RoadId],
        name: &str,
    ) -> Result<Vec<Edit>, EditError> {
        if thing.count > 2 && thing.count % 2 == 1 {
            let what = format!("{} at two ends", thing.count);
            return Err(EditError::Impossible { what, why: "say how many at each of them".to_owned() });
        }
        let thing = NewThing { count: thing.count.div_ceil(2), many: false, ..thing.clone() };
        let mut edits = Vec::new();
        for point in self.ends_of(roads, name)? {
            let stands = vec![Stand::AlongRoad { roads: roads.to_vec() }, Stand::Around { point }];
            edits.push(Edit::Add { make: self.made(&thing)?, count: thing.count, stands });
        }
        Ok(edits)
    }

    /// Where a street ends in a direction; without one it is asked which end is meant.
    fn end_of(&self, compass: Option<Compass>, roads: &[RoadId], name: &str) -> Result<Point2, EditError> {
        let ends = self.ends_of(roads, name)?;
        let Some(compass) = compass else {
            let what = format!("to tell the ends of {name} apart");
            return Err(EditError::Impossible {
                what,
                why: "say which: the north end, the west end".to_owned(),
            });
        };
        let far = |point: &Point2| point.coords.dot(&compass.step());
        let (one, other) = (far(&ends[0]), far(&ends[1]));
        // A street that runs east has no north end.
        if (one - other).abs() * 2.0 < (ends[0] - ends[1]).norm() {
            let wanted = format!("end of {name} on that side");
            return Err(EditError::NotFound { wanted, near: "it runs the other way".to_owned() });
        }
        Ok(if one > other { ends[0] } else { ends[1] })
    }

    /// The two junctions at which only one piece of a street ends.
    fn ends_of(&self, roads: &[RoadId], name: &str) -> Result<[Point2; 2], EditError> {
        let missing = || EditError::NotFound {
            wanted: format!("end of {name}"),
            near: "it does not run from one place to another".to_owned(),
        };
        let network = self.scene.roads().ok_or_else(missing)?;
        let mut places: Vec<IntersectionId> = roads
            .iter()
            .filter_map(|road| network.roads.get(road.index()))
            .flat_map(|road| [road.from, road.to])
            .collect();
        places.sort_unstable();
        let once = places.chunk_by(|one, other| one == other).filter(|same| same.len() == 1);
        let ends: Vec<Point2> = once
            .filter_map(|place| network.intersections.get(place[0].index()))
            .map(|place| place.center)
            .collect();
        <[Point2; 2]>::try_from(ends).map_err(|_| missing())
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    BEFORE.iter().chain(ENDS).chain(HALVES).chain(CORNERS).flat_map(|phrase| phrase.split(' '))
}
