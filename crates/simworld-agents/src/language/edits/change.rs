//! Wishes that change what is there: moving, painting, sizing, copying, naming.

use simworld_core::seam::PlanError;

use super::super::clause::{Count, Reference, Target};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::paint::{PAINTS, Paint};
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::wish::Wish;

/// Between a thing and where it is to go.
#[rustfmt::skip]
const POSED: &Phrases = &Phrases::of(&["to stand", "to sit", "to wait", "to be", "to go", "to stay", "so that it stands", "so it stands", "so that it is", "so it is", "over to stand", "and put it",
    "and place it", "and park it", "and set it down", "and set it", "and leave it", "and stick it", "and drop it", "and stand it", "to be placed", "to rest", "to live", "and put them",
    "and place them", "and park them", "so that they stand", "so they stand", "so that she stands", "so that he stands", "so she stands", "so he stands"]);

/// What may stand behind a colour.
#[rustfmt::skip]
const BEHIND_PAINT: &Phrases =
    &Phrases::of(&["instead", "please", "now", "in colour", "in color", "too", "colour", "color", "paint", "again"]);

impl Reader<'_> {
    // ---- the verbs ----

    /// Things and where they go: a reading for each place where the words can be cut.
    pub(super) fn moves(&mut self, end: usize) -> Result<Vec<Wish>, PlanError> {
        let start = self.at;
        let mut readings = Vec::new();
        let mut refused = None;
        for cut in start + 1..end {
            // "Send Gus to stand beside the door".
            let pose = longest_phrase(&self.lexemes[cut..end], POSED).unwrap_or(0);
            let place = if pose > 0 && self.is_place((cut + pose).min(end)) { cut + pose } else { cut };
            if !self.is_place(place)
                || cut > start + 1 && longest_phrase(&self.lexemes[cut - 1..end], POSED).is_some()
            {
                continue;
            }
            let what = match self.things(start, cut) {
                Ok(what) => what,
                Err(error @ PlanError::NotFound { .. }) => {
                    refused = refused.or(Some(error));
                    continue;
                }
                Err(_) => continue,
            };
            self.at = place;
            match self.places(end) {
                Ok(at) if self.at == end => readings.push(Wish::Move { what, at }),
                Ok(_) => {}
                Err(error) => refused = refused.or(Some(error)),
            }
        }
        if readings.is_empty() {
            self.at = start;
            return Err(refused.unwrap_or_else(|| self.not_understood("say what to move, and where to")));
        }
        self.at = end;
        // "The benches in the square to the park": where they are said to be is no place where they go.
        readings.sort_by_key(|wish| match wish {
            Wish::Move { at, .. } => at.len(),
            _ => 0,
        });
        Ok(readings)
    }

    /// Whether the words from here name something that is there, and no new thing.
    pub(super) fn is_definite(&self, start: usize) -> bool {
        let rest = &self.lexemes[start.min(self.lexemes.len())..];
        // "Two of the chairs" are there.
        let of = ["of the", "of these", "of those", "of my", "of our", "of them", "of your"];
        if numbers::number(rest).is_some_and(|(_, words)| longest_phrase(&rest[words..], &of).is_some()) {
            return true;
        }
        longest_phrase(rest, &["a", "an", "some", "another", "one", "new", "more"]).is_none()
            && numbers::count(rest).is_none()
    }

    /// "Take the bench and put it ...", "take the bench away", "get a bench".
    pub(super) fn take(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        let start = self.at;
        let away =
            (start..end).find(|at| longest_phrase(&self.lexemes[*at..end], &["away", "out"]).is_some());
        let last = self.before_politeness(start, end);
        if let Some(away) = away.filter(|away| away + 1 == last) {
            let what = self.things(start, away)?;
            self.at = end;
            return Ok(vec![vec![Wish::Remove { what }]]);
        }
        // "Get a bench for the kids" moves nobody.
        let is_new = longest_phrase(self.rest(end), &["a", "an", "some"]).is_some()
            || super::super::numbers::count(self.rest(end)).is_some();
        if is_new && start > 0 && matches!(self.word(start - 1), Some("get" | "grab" | "fetch")) {
            return self.additions(end);
        }
        if let Ok(wish) = self.moves(end) {
            return Ok(vec![wish]);
        }
        self.at = start;
        if let Some(wish) = self.made_to(end) {
            return Ok(vec![vec![wish]]);
        }
        if self.is_definite(start) {
            // What is taken up is what "it" stands for in the next wish.
            self.one_to(end)?;
            return Ok(vec![vec![Wish::List { what: Some(self.one_of(start, end)?), at: Vec::new() }]]);
        }
        self.additions(end)
    }

    /// "Get Bo to look at Ada".
    fn made_to(&mut self, end: usize) -> Option<Wish> {
        const LOOK: &Phrases = &Phrases::of(&[
            "to look at",
            "to look towards",
            "to look toward",
            "to look to",
            "to face",
            "to turn to",
            "to turn towards",
            "to watch",
            "to look over to",
            "facing",
            "looking at",
        ]);
        let start = self.at;
        (start + 1..end).find_map(|cut| {
            let words = longest_phrase(&self.lexemes[cut..end], LOOK)?;
            let what = self.things(start, cut).ok()?;
            let mut reader = Reader { at: cut + words, ..*self };
            let wish = reader.towards(what, end).ok()?;
            self.at = end;
            Some(wish)
        })
    }

    pub(super) fn replace(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        let start = self.at;
        for cut in start + 1..end {
            let Some(count) = longest_phrase(&self.lexemes[cut..end], &["with", "by", "for"]) else {
                continue;
            };
            let Ok(what) = self.one_of(start, cut) else { continue };
            self.at = cut + count;
            let with = self.new_thing(end)?;
            return if self.at == end {
                Ok(vec![vec![Wish::Replace { what, with }]])
            } else {
                Err(self.not_understood("end here"))
            };
        }
        Err(self.not_understood("say what to replace with what"))
    }

    pub(super) fn swap(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        if let Some(wish) = self.colours_swapped(end) {
            self.at = end;
            return Ok(vec![vec![wish]]);
        }
        self.eat_any(&[
            "the places of",
            "the positions of",
            "places of",
            "positions of",
            "the place of",
            "the position of",
        ]);
        let start = self.at;
        let tail: &[&str] = &[
            "trade places",
            "swap places",
            "change places",
            "around",
            "switch places",
            "exchange places",
            "places",
            "positions",
        ];
        let stop = (start..end)
            .find(|at| longest_phrase(&self.lexemes[*at..end], tail) == Some(end - at))
            .unwrap_or(end);
        for cut in start + 1..stop {
            let Some(count) = longest_phrase(&self.lexemes[cut..stop], &["and", "with", "for", "against"])
            else {
                continue;
            };
            // "Trade the moped for a bicycle" makes one.
            if !self.is_definite(cut + count)
                && cut + count < stop
                && let Ok(what) = self.one_of(start, cut)
            {
                let mut reader = Reader { at: cut + count, ..*self };
                if let Ok(with) = reader.new_thing(end)
                    && reader.at >= self.before_politeness(reader.at.saturating_sub(1), end)
                {
                    self.at = end;
                    return Ok(vec![vec![Wish::Replace { what, with }]]);
                }
            }
            if let (Ok(one), Ok(other)) = (self.one_of(start, cut), self.one_of(cut + count, stop)) {
                self.at = end;
                return Ok(vec![vec![Wish::Swap { one, other: Some(other) }]]);
            }
        }
        let both = self.one_of(start, stop)?;
        if both.count == Count::One && both.target != Target::Them {
            return Err(self.not_understood("say which two are to change places"));
        }
        self.at = end;
        Ok(vec![vec![Wish::Swap { one: both, other: None }]])
    }

    /// Things and a colour, several times.
    pub(super) fn paints(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        let mut wishes = Vec::new();
        if let Some(wish) = self.painted_in_turn(self.at, end) {
            self.at = end;
            return Ok(vec![vec![wish]]);
        }
        while self.at < end {
            let start = self.at;
            let Some((what, paint, next)) = self.colored(start, end) else {
                return Err(self.not_understood("say what to paint, and in which colour"));
            };
            wishes.push(vec![Wish::Paint { what, paint }]);
            self.at = next;
            self.skip_joints_to(end);
        }
        Ok(wishes)
    }

    /// Things, and behind them a colour, from a place on; and where that ends.
    pub(super) fn colored(&self, start: usize, end: usize) -> Option<(Vec<Reference>, Paint, usize)> {
        for at in start + 1..end {
            let Some((paint, count)) = longest(&self.lexemes[at..end], PAINTS) else { continue };
            let mut cut = at;
            for _ in 0..4 {
                let before = self.word(cut - 1).unwrap_or_default();
                if cut > start + 1
                    && [
                        "to", "in", "into", "be", "bright", "dark", "light", "a", "the", "colour", "color",
                        "as", "turn", "deep", "is", "are", "becomes",
                    ]
                    .contains(&before)
                {
                    cut -= 1;
                }
            }
            // "That have no colour brown" is about what has none.
            if matches!(self.word(cut - 1), Some("no" | "without" | "any")) {
                continue;
            }
            let next = at + count;
            let rest = longest_phrase(&self.lexemes[next..end], BEHIND_PAINT);
            let closes = next >= end || self.is_joint(next) || rest.is_some();
            if let Ok(mut what) = self.things(start, cut)
                && let [only] = &mut what[..]
            {
                // "Paint every car white except the blue one".
                let comma = usize::from(self.lexemes.get(next).is_some_and(super::super::lexer::is_mark));
                let mut parser = self.parser(next + comma, self.before_politeness(start, end));
                self.except(&mut parser, only);
                if parser.at > next + comma && only.except.is_some() {
                    return Some((what, paint, parser.at));
                }
            }
            if let Some(what) = self.things(start, cut).ok().filter(|_| closes) {
                return Some((what, paint, next + rest.unwrap_or(0)));
            }
        }
        None
    }

    pub(super) fn copy(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        let start = self.at;
        let mut readings = Vec::new();
        for cut in start + 1..end {
            let begins = self.is_place(cut) || self.is_joint(cut);
            if !begins {
                continue;
            }
            let (what_end, count) = self.without_times(start, cut);
            let Ok(what) = self.one_of(start, what_end) else { continue };
            self.at = cut;
            self.skip_joints_to(end);
            if self.eat_any(&[
                "put", "place", "set", "leave", "stick", "position", "drop", "park", "move", "plant",
            ]) {
                self.eat_any(&[
                    "it",
                    "them",
                    "the copy",
                    "the copies",
                    "the clone",
                    "the clones",
                    "the duplicate",
                    "the duplicates",
                    "that one",
                    "the new one",
                    "the second one",
                    "the other one",
                    "that copy",
                ]);
            }
            if let Ok(at) = self.places(end)
                && self.at == end
            {
                readings.push(Wish::Copy { what, count, at });
            }
        }
        let (what_end, count) = self.without_times(start, end);
        if let Ok(what) = self.one_of(start, what_end) {
            readings.push(Wish::Copy { what, count, at: Vec::new() });
        }
        self.at = end;
        if readings.is_empty() {
            self.at = start;
            return Err(self.not_understood("say what to copy"));
        }
        Ok(vec![readings])
    }

    /// Without "twice" or "three times" at the end.
    pub(super) fn without_times(&self, start: usize, end: usize) -> (usize, u32) {
        for at in start + 1..end {
            if let Some((times, count)) = numbers::times(&self.lexemes[at..end])
                && at + count == end
            {
                return (at, times);
            }
        }
        (end, 1)
    }

    /// "Make the bench blue", "make the tree bigger", "let the two cars trade places", "make a bench ...".
    pub(super) fn make(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        let start = self.at;
        if let Some(wish) = self.copies(end) {
            return Ok(wish);
        }
        if let Some(wish) = self.painted_in_turn(start, end) {
            self.at = end;
            return Ok(vec![vec![wish]]);
        }
        if let Some((what, paint, next)) = self.colored(start, end) {
            self.at = next;
            let mut wishes = vec![vec![Wish::Paint { what, paint }]];
            self.skip_joints_to(end);
            if self.at < end {
                wishes.extend(self.paints(end)?);
            }
            return Ok(wishes);
        }
        if let Some(wish) = self.scaled(start, end) {
            self.at = end;
            return Ok(vec![vec![wish]]);
        }
        for cut in start + 1..end {
            if let Some(wishes) =
                self.things(start, cut).ok().and_then(|what| self.face_each_other(&what, cut, end))
            {
                self.at = end;
                return Ok(wishes);
            }
            if longest_phrase(&self.lexemes[cut..end], super::predicates::TRADES) == Some(end - cut)
                && let Ok(wish) = self.pair_up(start, cut)
            {
                self.at = end;
                return Ok(vec![vec![wish]]);
            }
            let looks: &[&str] = &[
                "face",
                "look at",
                "look towards",
                "look",
                "point at",
                "point to",
                "point towards",
                "facing",
                "look to",
            ];
            if let Some(count) = longest_phrase(&self.lexemes[cut..end], looks)
                && let Ok(what) = self.things(start, cut)
            {
                self.at = cut + count;
                return self.towards(what, end).map(|wish| vec![vec![wish]]);
            }
        }
        self.at = start;
        if let Some(wish) = self.posed(end) {
            return Ok(vec![vec![wish]]);
        }
        if self.is_definite(start) { self.moves(end).map(|wish| vec![wish]) } else { self.additions(end) }
    }

    /// "Two copies of the crate next to the mailbox".
    pub(super) fn copies(&mut self, end: usize) -> Option<Vec<Vec<Wish>>> {
        #[rustfmt::skip]
    const COPIES: &[&str] = &["copies of", "copy of", "clones of", "clone of", "duplicates of", "duplicate of",
        "more copies of", "more of", "replica of", "replicas of", "twin of", "twins of"];
        let start = self.at;
        if let Some(copies) = self.just_like(end) {
            return Some(copies);
        }
        let (count, words) = numbers::count(self.rest(end)).unwrap_or((1, 0));
        self.at += words;
        self.eat_any(&["a", "an", "another", "one", "one more", "more"]);
        if !self.eat_any(COPIES) {
            self.at = start;
            return None;
        }
        let mut wishes = self.copy(end).ok();
        for wish in wishes.iter_mut().flatten().flatten() {
            if let Wish::Copy { count: times, .. } = wish {
                *times = count;
            }
        }
        if wishes.is_none() {
            self.at = start;
        }
        wishes
    }

    /// "Another postbox just like the red one next to the school".
    fn just_like(&mut self, end: usize) -> Option<Vec<Vec<Wish>>> {
        #[rustfmt::skip]
        const LIKE: &Phrases = &Phrases::of(&["just like", "exactly like", "identical to", "the same as", "like", "similar to", "that looks like", "that looks just like", "the spitting image of", "matching", "of the same kind as", "same as"]);
        #[rustfmt::skip]
        const MORE: &Phrases = &Phrases::of(&["another", "one more", "a second", "a third", "yet another", "an identical", "another one", "a", "an", "one", "a copy"]);
        let start = self.at;
        let more = longest_phrase(self.rest(end), MORE)?;
        let is_more = more > 1 || matches!(self.word(start), Some("another"));
        let noun = start + more;
        let like = (noun..end.min(noun + 4)).find_map(|at| {
            let words = longest_phrase(&self.lexemes[at..end], LIKE)?;
            (is_more || words > 1).then_some((at, at + words))
        });
        let (cut, from) = like.filter(|(_, from)| self.is_certain(*from))?;
        // "The red one" is of the class that was named.
        let said = super::follow::Said { noun: self.last_noun(noun, cut), ..super::follow::Said::default() };
        let words = self.with_noun(&said, from, end).unwrap_or_else(|| self.lexemes[from..end].to_vec());
        let mut inner = Reader { depth: super::says::DEEPEST, ..self.over(&words) };
        let copies = inner.copy(words.len()).ok()?;
        self.at = end;
        Some(copies)
    }

    /// "A copy of the blue car" stands next.
    pub(super) fn is_copies(&self, end: usize) -> bool {
        Reader { ..*self }.copies(end).is_some()
    }

    /// "Have Ben stand beside the mailbox".
    pub(super) fn posed(&mut self, end: usize) -> Option<Wish> {
        #[rustfmt::skip]
    const POSES: &Phrases =
            &Phrases::of(&["stand", "be", "sit", "wait", "go", "walk", "move", "stay", "be standing", "be placed"]);
        let start = self.at;
        for cut in start + 1..end {
            let Some(count) = longest_phrase(&self.lexemes[cut..end], POSES) else { continue };
            let Ok(what) = self.things(start, cut) else { continue };
            self.at = cut + count;
            if self.is_place(self.at)
                && let Ok(at) = self.places(end)
                && self.at == end
            {
                return Some(Wish::Move { what, at });
            }
        }
        self.at = start;
        None
    }

    /// Two things to change places.
    pub(super) fn pair_up(&self, start: usize, end: usize) -> Result<Wish, PlanError> {
        for cut in start + 1..end {
            if longest_phrase(&self.lexemes[cut..end], &["and"]).is_some()
                && let (Ok(one), Ok(other)) = (self.one_of(start, cut), self.one_of(cut + 1, end))
            {
                return Ok(Wish::Swap { one, other: Some(other) });
            }
        }
        Ok(Wish::Swap { one: self.one_of(start, end)?, other: None })
    }

    /// Where something is told to look.
    pub(super) fn towards(&mut self, what: Vec<Reference>, end: usize) -> Result<Wish, PlanError> {
        let mut parser = self.parser(self.at, end);
        if let Some(compass) = parser.compass().filter(|_| parser.at >= self.before_politeness(self.at, end))
        {
            self.at = end;
            return Ok(Wish::FaceCompass { what, compass });
        }
        let towards = self.one_to(end)?;
        Ok(Wish::Face { what, towards })
    }
}
