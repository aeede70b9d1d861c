//! The directions of the compass: which way one goes, and where one thing stands from another.

use std::f64::consts::FRAC_PI_4;

use simworld_core::geometry::{Point2, Vector2, direction, heading};
use simworld_core::ops::wrap_angle;
use simworld_core::seam::PlanError;

use super::clause::{Choice, Reference, Stands};
use super::lexicon::{longest, longest_phrase};
use super::parser::Parser;

/// One of eight directions, in eighths of a turn from east, counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Compass(u8);

pub(super) const DIRECTIONS: &[(&[&str], Compass)] = &[
    (&["east", "eastward", "eastwards"], Compass(0)),
    (&["north east", "northeast", "northeastward", "northeastwards", "north eastwards"], Compass(1)),
    (&["north", "northward", "northwards"], Compass(2)),
    (&["north west", "northwest", "northwestward", "northwestwards", "north westwards"], Compass(3)),
    (&["west", "westward", "westwards"], Compass(4)),
    (&["south west", "southwest", "southwestward", "southwestwards", "south westwards"], Compass(5)),
    (&["south", "southward", "southwards"], Compass(6)),
    (&["south east", "southeast", "southeastward", "southeastwards", "south eastwards"], Compass(7)),
];

/// The names of the eight directions, and where each leads, radians from east.
#[cfg(feature = "thought")]
pub(crate) fn winds() -> impl Iterator<Item = (&'static str, f64)> {
    DIRECTIONS.iter().map(|(words, compass)| (words[0], compass.heading()))
}

/// Which of several, by where they stand.
pub(super) const MOST: &[(&[&str], Compass)] = &[
    (&["easternmost", "eastern most", "eastmost", "most easterly", "most eastern", "eastern"], Compass(0)),
    (
        &["northernmost", "northern most", "northmost", "most northerly", "most northern", "northern"],
        Compass(2),
    ),
    (&["westernmost", "western most", "westmost", "most westerly", "most western", "western"], Compass(4)),
    (
        &["southernmost", "southern most", "southmost", "most southerly", "most southern", "southern"],
        Compass(6),
    ),
    (&["northeastern", "north eastern", "northeasternmost", "north easternmost"], Compass(1)),
    (&["northwestern", "north western", "northwesternmost", "north westernmost"], Compass(3)),
    (&["southwestern", "south western", "southwesternmost", "south westernmost"], Compass(5)),
    (&["southeastern", "south eastern", "southeasternmost", "south easternmost"], Compass(7)),
];

/// Every word of this table, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    DIRECTIONS.iter().chain(MOST).flat_map(|(words, _)| *words).copied()
}

impl Compass {
    /// Radians from east.
    pub(super) fn heading(self) -> f64 {
        wrap_angle(f64::from(self.0) * FRAC_PI_4)
    }

    /// A step of one metre.
    pub(super) fn step(self) -> Vector2 {
        direction(self.heading())
    }

    /// Whether a place lies in this direction from another: within 45° of the four winds, and within 22.5° of those
    /// between them, as people say it.
    pub(super) fn holds(self, from: Point2, to: Point2) -> bool {
        let way = to - from;
        let width = if self.0.is_multiple_of(2) { FRAC_PI_4 } else { FRAC_PI_4 * 0.5 };
        way.norm() > 1e-6 && wrap_angle(heading(&way) - self.heading()).abs() <= width
    }
}

impl Parser<'_> {
    /// A direction, if one is said here and it is no part of a name.
    pub(super) fn compass(&mut self) -> Option<Compass> {
        let start = self.at;
        self.eat_any(&[
            "to the",
            "the",
            "towards the",
            "toward the",
            "due",
            "towards",
            "toward",
            "to",
            "in the direction of",
            "straight",
        ]);
        let found = longest(self.rest(), DIRECTIONS);
        if found.is_none() || self.names.exact(self.rest()).is_some() {
            self.at = start;
            return None;
        }
        found.map(|(compass, count)| {
            self.at += count;
            compass
        })
    }

    /// "North of the museum", "to the east": how a thing stands by the compass.
    pub(super) fn by_compass(&mut self, depth: u32) -> Result<Option<Stands>, PlanError> {
        let start = self.at;
        self.eat_any(&["on the", "at the", "just", "directly", "to the", "off to the", "over to the"]);
        let Some(compass) = self.compass() else {
            self.at = start;
            return Ok(None);
        };
        let side = self.eat_any(&["side", "end"]);
        if self.eat_any(&["of you", "of here", "of me", "from here", "from you"]) {
            return Ok(Some(Stands::Compass(compass, None)));
        }
        if self.eat_any(&["of", "from"]) {
            return Ok(Some(Stands::Compass(compass, Some(Box::new(self.reference(depth + 1)?)))));
        }
        let is_said = side || self.at > start + 1;
        if !is_said {
            self.at = start;
            return Ok(None);
        }
        Ok(Some(Stands::Compass(compass, None)))
    }

    /// "In the east", which says which of several.
    pub(super) fn in_the_compass(&mut self) -> Option<Compass> {
        let start = self.at;
        let compass = if self.eat_any(&["in the"]) { longest(self.rest(), DIRECTIONS) } else { None };
        let after = &self.rest()[compass.map_or(0, |(_, count)| count)..];
        let said = compass.filter(|_| longest_phrase(after, &["of", "from", "side", "end"]).is_none());
        self.at = said.map_or(start, |(_, count)| self.at + count);
        said.map(|(compass, _)| compass)
    }

    /// "The third from the west": from which end one counts.
    pub(super) fn end_by_the_compass(&mut self) -> Option<Compass> {
        let start = self.at;
        let begins = self.eat_any(&["from the", "counting from the", "counted from the", "from"]);
        let compass = if begins { longest(self.rest(), DIRECTIONS) } else { None };
        let after = &self.rest()[compass.map_or(0, |(_, count)| count)..];
        let said = compass.filter(|_| longest_phrase(after, &["of"]).is_none());
        self.at = said.map_or(start, |(_, count)| self.at + count);
        if said.is_some() {
            self.eat_any(&["side", "end"]);
        }
        said.map(|(compass, _)| compass)
    }

    /// "North", "northern": a direction as it is said of a part of something.
    pub(super) fn compass_of_part(&mut self) -> Option<Compass> {
        let found = longest(self.rest(), MOST).or_else(|| longest(self.rest(), DIRECTIONS));
        let (compass, count) = found?;
        self.at += count;
        Some(compass)
    }

    /// "The northernmost".
    pub(super) fn compass_choice(&mut self) -> Option<Choice> {
        let (compass, count) = longest(self.rest(), MOST)?;
        self.at += count;
        Some(Choice::Compass(compass))
    }

    /// Turns "north of" into the place on that side of a thing, before a place that one goes to.
    pub(super) fn compass_side(&mut self) -> Result<Option<(Compass, Reference)>, PlanError> {
        let start = self.at;
        if let Some(Stands::Compass(compass, Some(of))) = self.by_compass(0)? {
            return Ok(Some((compass, *of)));
        }
        self.at = start;
        Ok(None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sectors_are_as_wide_as_people_mean_them() {
        let from = Point2::origin();
        let east = Compass(0);
        assert!(east.holds(from, Point2::new(10.0, 9.0)) && !east.holds(from, Point2::new(9.0, 10.0)));
        let north_west = Compass(3);
        assert!(
            north_west.holds(from, Point2::new(-10.0, 9.0))
                && !north_west.holds(from, Point2::new(-10.0, 2.0))
        );
    }
}
