//! The words for the directions of the compass: which way one goes, and where one thing stands from another.

pub(super) use simworld_core::geometry::Compass;
use simworld_core::seam::PlanError;

use super::clause::{Choice, Reference, Stands};
use super::lexicon::{longest, longest_phrase};
use super::parser::Parser;

pub(super) const DIRECTIONS: &[(&[&str], Compass)] = &[
    (&["east", "eastward", "eastwards"], Compass::East),
    (&["north east", "northeast", "northeastward", "northeastwards", "north eastwards"], Compass::NorthEast),
    (&["north", "northward", "northwards"], Compass::North),
    (&["north west", "northwest", "northwestward", "northwestwards", "north westwards"], Compass::NorthWest),
    (&["west", "westward", "westwards"], Compass::West),
    (&["south west", "southwest", "southwestward", "southwestwards", "south westwards"], Compass::SouthWest),
    (&["south", "southward", "southwards"], Compass::South),
    (&["south east", "southeast", "southeastward", "southeastwards", "south eastwards"], Compass::SouthEast),
];

/// The names of the eight directions, and where each leads, radians from east.
#[cfg(feature = "thought")]
pub(crate) fn winds() -> impl Iterator<Item = (&'static str, f64)> {
    DIRECTIONS.iter().map(|(words, compass)| (words[0], compass.heading()))
}

/// Which of several, by where they stand.
pub(super) const MOST: &[(&[&str], Compass)] = &[
    (&["easternmost", "eastern most", "eastmost", "most easterly", "most eastern", "eastern"], Compass::East),
    (
        &["northernmost", "northern most", "northmost", "most northerly", "most northern", "northern"],
        Compass::North,
    ),
    (&["westernmost", "western most", "westmost", "most westerly", "most western", "western"], Compass::West),
    (
        &["southernmost", "southern most", "southmost", "most southerly", "most southern", "southern"],
        Compass::South,
    ),
    (&["northeastern", "north eastern", "northeasternmost", "north easternmost"], Compass::NorthEast),
    (&["northwestern", "north western", "northwesternmost", "north westernmost"], Compass::NorthWest),
    (&["southwestern", "south western", "southwesternmost", "south westernmost"], Compass::SouthWest),
    (&["southeastern", "south eastern", "southeasternmost", "south easternmost"], Compass::SouthEast),
];

/// Every word of this table, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    DIRECTIONS.iter().chain(MOST).flat_map(|(words, _)| *words).copied()
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
    fn every_direction_has_words_that_are_its_name() {
        for direction in Compass::ALL {
            let (words, _) =
                DIRECTIONS.iter().find(|(_, compass)| *compass == direction).expect("every direction");
            assert_eq!(Compass::from_name(words[0]), Some(direction));
            assert_eq!(MOST.iter().filter(|(_, compass)| *compass == direction).count(), 1, "{direction:?}");
        }
    }
}
