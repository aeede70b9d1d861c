//! What a place has, and where: houses of a use, landmarks, squares, parks, water, districts.

use simworld_core::scene::Place;
use simworld_core::spec::{Amount, DistrictKind, DistrictWish, SiteWish, Water, Whereabouts};

use super::super::lexer::is_mark;
use super::super::lexicon::{longest, longest_phrase};
use super::Scene;
use super::spots::{Beside, Spot, names_thing, spot};
use super::words::{DISTRICTS, Said};
use crate::scenes::SceneRemark;

/// The most squares, parks and landmarks that words ask for, so that a slip of the pen asks for no thousand names.
const MOST: u32 = 40;
/// Between a district and where it is: "factories that lie in the east".
const LINKS: &[&str] = &[
    "that lies",
    "that lie",
    "lying",
    "which lies",
    "which lie",
    "located",
    "is",
    "are",
    "set",
    "that is",
    "that are",
    "lies",
    "lie",
    "down",
    "up",
    "out",
    "over",
    "all",
    "right",
];

impl Scene<'_> {
    /// "In the north", "by the station": where what was named last is, or what is named next.
    pub(super) fn placed(&mut self) -> bool {
        let rest = &self.lexemes[self.at..];
        let Some((spot, words)) = spot(rest) else { return false };
        if !self.last.is_empty() {
            self.put(spot);
            self.at += words;
            return true;
        }
        let begins = self.at.checked_sub(1).is_none_or(|before| is_mark(&self.lexemes[before]));
        if !names_thing(&rest[words..], begins) {
            return false;
        }
        self.ahead = Some(spot);
        self.at += words;
        true
    }

    /// "An old town in the middle", "a business district".
    pub(super) fn district(&mut self) -> bool {
        let rest = &self.lexemes[self.at..];
        let Some(((kind, said), words)) = longest(rest, DISTRICTS) else { return false };
        if self.number.is_some_and(|number| number > 1) || self.amount == Some(Amount::None) {
            return false;
        }
        let link = longest_phrase(&rest[words..], LINKS).unwrap_or(0);
        let (spot, words) = match (spot(&rest[words + link..]), self.ahead) {
            (Some((spot, more)), _) => (spot, words + link + more),
            (None, Some(ahead)) => (ahead, words),
            (None, None) => (Spot::default(), words),
        };
        let is_said = match said {
            Said::Alone => true,
            Said::Somewhere => spot != Spot::default(),
            Said::InPart => spot.at != Whereabouts::Anywhere,
        };
        if !is_said {
            return false;
        }
        self.lay_out(kind, spot);
        (self.number, self.amount, self.ahead) = (None, None, None);
        self.last.clear();
        self.facts += 1;
        self.at += words;
        true
    }

    fn lay_out(&mut self, kind: DistrictKind, spot: Spot) {
        let by = match spot.by {
            Some(Beside::Water(water)) => {
                self.water(water);
                Some(water.as_str().to_owned())
            }
            Some(other) => {
                self.have(other);
                let what = format!("{} district", kind.as_str().replace('_', " "));
                let place = format!("by the {}", other.name().replace('_', " "));
                let why = "a district lies in a part of the place, or along water";
                self.remarks.push(SceneRemark::Unplaced { what, place, why });
                None
            }
            None => None,
        };
        self.spec.features.districts.push(DistrictWish { kind, at: spot.at, by });
    }

    /// Says of what was named last where it is.
    fn put(&mut self, spot: Spot) {
        if let Some(by) = spot.by {
            self.have(by);
        }
        for what in std::mem::take(&mut self.last) {
            let by = spot.by.map(|by| by.name().to_owned()).filter(|by| *by != what);
            self.spec.features.sites.push(SiteWish { what, at: spot.at, by });
        }
    }

    /// What is spoken of is there.
    fn have(&mut self, what: Beside) {
        let features = &mut self.spec.features;
        match what {
            Beside::Water(water) => self.water(water),
            Beside::Landmark(name) => {
                features.landmarks.entry(name.to_owned()).or_insert(1);
            }
            Beside::Square if features.squares.is_empty() => features.squares.push("Town Square".to_owned()),
            Beside::Park if features.parks.is_empty() => features.parks.push("Park".to_owned()),
            // A use that nobody counts is as it comes.
            Beside::Square | Beside::Park | Beside::Use(_) => {}
        }
    }

    /// What was named, once for each, and where, if that was said before.
    fn named(&mut self, whats: Vec<String>) {
        (self.number, self.amount) = (None, None);
        self.last = whats;
        if let Some(spot) = self.ahead.take() {
            self.put(spot);
        }
    }

    /// Houses of a use; as an adjective it says that there is one, whoever counts them.
    pub(super) fn place(&mut self, place: Place, is_adjective: bool) {
        self.facts += 1;
        let known = self.spec.features.places.entry(place).or_insert(0);
        let count = match (self.amount, self.number) {
            (Some(Amount::None), _) => {
                *known = 0;
                0
            }
            (_, Some(number)) if !is_adjective => {
                // "A museum in the north and a museum in the south" are two.
                let before = if self.numbered.contains(&place) { *known } else { 0 };
                *known = before.saturating_add(number);
                self.numbered.push(place);
                number
            }
            _ => {
                *known = (*known).max(1);
                1
            }
        };
        let count = if is_adjective { 0 } else { count.min(MOST) };
        self.named(vec![place.as_str().to_owned(); count as usize]);
    }

    /// A thing of the library.
    pub(super) fn landmark(&mut self, name: &str) {
        let count = match (self.amount, self.number) {
            (Some(Amount::None), _) => 0,
            (_, Some(number)) => number,
            _ => u32::from(!self.spec.features.landmarks.contains_key(name)),
        };
        if count > 0 {
            let known = self.spec.features.landmarks.entry(name.to_owned()).or_insert(0);
            *known = known.saturating_add(count);
        }
        let is_there = self.spec.features.landmarks.contains_key(name);
        self.named(vec![name.to_owned(); if is_there { count.clamp(1, MOST) as usize } else { 0 }]);
    }

    pub(super) fn water(&mut self, water: Water) {
        let waters = &mut self.spec.features.waters;
        if !waters.contains(&water) {
            waters.push(water);
        }
    }

    /// Squares or parks: of two the second is called "Second Town Square".
    pub(super) fn open_ground(&mut self, name: &str, is_park: bool) {
        let count = match self.amount {
            Some(Amount::None) => 0,
            Some(Amount::Few | Amount::Many) if self.number.is_none() => 3,
            _ => self.number.unwrap_or(1),
        };
        let features = &mut self.spec.features;
        let names = if is_park { &mut features.parks } else { &mut features.squares };
        let before = names.len();
        for _ in 0..count.min(MOST) {
            let text = match names.len() {
                0 => name.to_owned(),
                1 => format!("Second {name}"),
                2 => format!("Third {name}"),
                more => format!("{name} {}", more + 1),
            };
            names.push(text);
        }
        let new = names[before..].to_vec();
        self.named(new);
    }
}
