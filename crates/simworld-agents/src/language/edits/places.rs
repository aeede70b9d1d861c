//! New things and places: the noun phrase of what is to be made, and the relations in which it is to stand.

use simworld_core::geometry::Point2;
use simworld_core::scene::Relation;
use simworld_core::seam::PlanError;

use super::super::clause::{Count, Reference, Stands, Target};
use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::memo::said;
use super::parse::{Reader, joint};
use super::things::ARTICLES;
use super::wish::{Anchor, Where, Wish};
use super::words::{ABOUT_IT, VERBS, Verb, WAYS, Way};

/// Sides of a thing, behind a distance from it.
const OWN_SIDES: &[(&[&str], Relation)] = &[
    (&["left"], Relation::LeftOf),
    (&["right"], Relation::RightOf),
    (&["forward", "forwards", "ahead", "front"], Relation::InFrontOf),
    (&["back", "backwards", "behind"], Relation::Behind),
];

impl Reader<'_> {
    /// "In front of the gallery there must stand a postbox": the place comes first.
    pub(super) fn place_first(&mut self, end: usize) -> Option<Vec<Vec<Wish>>> {
        let start = self.at;
        let wishes = self.try_place_first(end);
        if wishes.is_none() {
            self.at = start;
        }
        wishes
    }

    fn try_place_first(&mut self, end: usize) -> Option<Vec<Vec<Wish>>> {
        if self.seen_from(self.at, end).is_none() {
            self.eat_any(&["from", "right", "and"]);
        }
        if !self.is_place(self.at) {
            return None;
        }
        let verb = (self.at + 1..end).find(|at| {
            // "In the park" ends with no order to park.
            self.word(at - 1) != Some("the")
                && longest(&self.lexemes[*at..end], &VERBS)
                    .is_some_and(|(verb, _)| matches!(verb, Verb::Add | Verb::Put))
        })?;
        let (kind, count) = longest(&self.lexemes[verb..end], &VERBS)?;
        let at = self.places(verb).ok()?;
        self.skip_joints_to(verb);
        if self.at != verb {
            return None;
        }
        self.at = verb + count;
        if kind == Verb::Put
            && numbers::count(self.rest(end)).is_none()
            && longest_phrase(self.rest(end), ARTICLES).is_none_or(|_| self.peeks("the"))
            && !self.is_bare_plural(self.at, end)
        {
            let stop = self.before_politeness(self.at, end);
            let what = self.things(self.at, stop).ok().filter(|_| self.is_certain(self.at))?;
            self.at = end;
            return Some(vec![vec![Wish::Move { what, at }]]);
        }
        let made = self.additions(end).ok()?;
        let placed = |wish| match wish {
            // "By the museum, put a bench there".
            Wish::Add { things, at: own } if own.is_empty() || own == [Where::There] => {
                Some(Wish::Add { things, at: at.clone() })
            }
            _ => None,
        };
        made.into_iter().map(|readings| readings.into_iter().map(placed).collect()).collect()
    }

    fn peeks(&self, word: &str) -> bool {
        self.word(self.at) == Some(word)
    }

    /// Whether a place begins at a token.
    pub(super) fn is_place(&self, at: usize) -> bool {
        self.memo.place(said(self.lexemes.get(at..).unwrap_or_default()), || self.begins_place(at))
    }

    fn begins_place(&self, at: usize) -> bool {
        if matches!(self.word(at), Some("down" | "up" | "over" | "back" | "out" | "off"))
            && longest(&self.lexemes[(at + 1).min(self.lexemes.len())..], &WAYS).is_some()
        {
            return true;
        }
        // "A merry-go-round" is a thing.
        if self.word(at) == Some("round") && at > 0 && self.word(at - 1) == Some("go") {
            return false;
        }
        // "Two round tables".
        let is_shape = self.word(at) == Some("round")
            && at > 0
            && (numbers::number(&self.lexemes[at - 1..]).is_some_and(|(_, words)| words == 1)
                || matches!(
                    self.word(at - 1),
                    Some("a" | "the" | "some" | "more" | "big" | "small" | "large" | "new")
                ))
            && super::super::lexicon::category(&self.lexemes[at + 1..]).is_some();
        if is_shape {
            return false;
        }
        let over = Reader { at, ..*self }.over_the_street(self.lexemes.len());
        if self.seen_from(at, self.lexemes.len()).is_some() {
            return true;
        }
        if self.begins_step(at) || self.begins_part(at) {
            return true;
        }
        if self.begins_offset(at) || self.begins_junction(at) || matches!(over, Ok(Some(_))) {
            return true;
        }
        let rest = &self.lexemes[at.min(self.lexemes.len())..];
        longest(rest, &WAYS).is_some()
            || longest(rest, &ABOUT_IT).is_some()
            || matches!(rest.first(), Some(Lexeme { token: Token::Open, .. }))
            || self.shift(at).is_some()
            || self.compass_of(at, self.lexemes.len()).is_some()
    }

    /// Places, joined by "and"; all of them hold.
    pub(super) fn places(&mut self, end: usize) -> Result<Vec<Where>, PlanError> {
        let mut places = vec![self.place(end)?];
        loop {
            if let Some(more) = places.last().cloned().and_then(|last| self.more_anchors(&last, end)) {
                places.push(more);
                continue;
            }
            let start = self.at;
            if let Some(count) = joint(self.rest(end)) {
                self.at += count;
            }
            self.skip_joints_to(end);
            // Behind a place of its own "instead" says no more than that.
            if self.word(self.at) == Some("instead") && self.at + 1 >= self.before_politeness(self.at, end) {
                self.at = end;
                return Ok(places);
            }
            if self.at < end
                && self.is_place(self.at)
                && let Ok(place) = self.place(end)
            {
                places.push(place);
                continue;
            }
            self.at = start;
            // Politeness behind the last place belongs to nobody.
            if self.before_politeness(start.saturating_sub(1), end) <= self.at {
                self.at = end;
            }
            return Ok(places);
        }
    }

    pub(super) fn place(&mut self, end: usize) -> Result<Where, PlanError> {
        // "Set it down between the two".
        let is_particle = matches!(self.word(self.at), Some("down" | "up" | "over" | "back" | "out" | "off"));
        if is_particle
            && longest(self.rest(end), &WAYS).is_none_or(|(_, words)| words == 1)
            && self.is_place(self.at + 1)
        {
            self.at += 1;
        }
        if let Some((place, after)) = self.seen_from(self.at, end) {
            self.at = after;
            return Ok(place);
        }
        if let Some(place) = self.junction(end) {
            return Ok(place);
        }
        if let Some(place) = self.part_of(end)? {
            return Ok(place);
        }
        if let Some(place) = self.step(end)? {
            return Ok(place);
        }
        if let Some(place) = self.offset(end)? {
            return Ok(place);
        }
        if let Some(place) = self.over_the_street(end)? {
            return Ok(place);
        }
        if let Some((east, north, count)) = self.shift(self.at) {
            self.at += count;
            return Ok(Where::Shift(east, north));
        }
        if let Some((compass, from)) = self.compass_of(self.at, end) {
            self.at = from;
            return Ok(Where::Compass(compass, self.anchor(end)?));
        }
        if matches!(self.rest(end).first(), Some(Lexeme { token: Token::Open, .. })) {
            return self.point(end).ok_or_else(|| self.not_understood("write a point as (x, y)"));
        }
        if let Some((relation, count)) = longest(self.rest(end), &ABOUT_IT)
            && (longest(self.rest(end), &WAYS).is_none_or(|(_, words)| words < count)
                || self.at + count >= self.before_politeness(self.at, end))
        {
            self.at += count;
            let mine = self.word(self.at - 2).is_some_and(|word| word == "my");
            let anchor = if mine { Anchor::Viewer } else { Anchor::It };
            return Ok(Where::To(relation, anchor));
        }
        self.by_way(end)
    }

    /// A place that begins with a word of relation.
    fn by_way(&mut self, end: usize) -> Result<Where, PlanError> {
        let Some((way, count)) = longest(self.rest(end), &WAYS) else {
            return Err(self.not_understood("say where: next to, near, behind, between ..."));
        };
        self.at += count;
        let place = match way {
            Way::Here => return Ok(Where::Here),
            Way::There | Way::InItsPlace => return Ok(Where::There),
            Way::Anywhere => return Ok(Where::Anywhere),
            Way::Between => return self.between(end),
            Way::At | Way::In | Way::On if self.begins_point(end) => {
                return self.point(end).ok_or_else(|| self.not_understood("write a point as (x, y)"));
            }
            Way::To(relation) => Where::To(relation, self.anchor(end)?),
            Way::Across => Where::Across(self.anchor(end)?),
            Way::Along => Where::Along(self.anchor(end)?),
            Way::Corner => Where::Corner(self.anchor(end)?),
            Way::Corners => Where::Corners(self.anchor(end)?),
            Way::At => Where::By(self.anchor(end)?),
            Way::Around => Where::Around(self.anchor(end)?),
            Way::Both => {
                let ends = (self.at - count..self.at).any(|at| matches!(self.word(at), Some("ends" | "end")));
                match self.anchor(end)? {
                    Anchor::Street(name, roads) if ends => Where::Ends(roads, name),
                    anchor => Where::BothSides(anchor),
                }
            }
            Way::Middle => Where::Middle(self.anchor(end)?),
            Way::Edge => Where::Edge(self.anchor(end)?),
            Way::Block => Where::Block(self.anchor(end)?),
            Way::In if self.word(self.at - 1) == Some("across") && self.is_water(self.at, end) => {
                return Err(self.not_understood("say on which side of the water"));
            }
            Way::In => Where::To(simworld_core::scene::Relation::Inside, self.anchor(end)?),
            Way::On => match self.anchor(end)? {
                street @ Anchor::Street(..) => Where::Along(street),
                thing => Where::To(simworld_core::scene::Relation::OnTopOf, thing),
            },
        };
        Ok(place)
    }

    /// Whether water is named from here on, over which nothing stands.
    fn is_water(&self, at: usize, end: usize) -> bool {
        const WATER: &[&str] = &["river", "canal", "stream", "lake", "pond", "water", "brook"];
        let is = |at: usize| self.word(at).is_some_and(|word| WATER.contains(&word));
        (at..end.min(at + 3)).any(is)
    }

    /// "From the kiosk on the left side", "from the statue go two metres left".
    fn seen_from(&self, at: usize, end: usize) -> Option<(Where, usize)> {
        if !matches!(self.word(at), Some("from" | "seen")) || at >= end {
            return None;
        }
        let from = at + longest_phrase(&self.lexemes[at..end], &["from", "seen from"])?;
        let mut reader = Reader { at: from, ..*self };
        // The thing is the shortest phrase that is one: what follows is where from there.
        (from + 1..end).find_map(|cut| {
            let thing = self.one_of(from, cut).ok()?;
            reader.at = cut;
            reader.eat_any(&[","]);
            while reader.lexemes.get(reader.at).is_some_and(super::super::lexer::is_mark) {
                reader.at += 1;
            }
            reader.eat_any(&["go", "walk", "take", "count", "measure", "and go", "its"]);
            if let Some((relation, words)) = longest(reader.rest(end), &ABOUT_IT) {
                return Some((Where::To(relation, Anchor::Thing(thing)), reader.at + words));
            }
            let (distance, words) = numbers::length(reader.rest(end))?;
            reader.at += words;
            let mut parser = reader.parser(reader.at, end);
            parser.eat_any(&["to the", "to its", "due"]);
            if let Some(compass) = parser.compass() {
                let bearing = super::wish::Bearing::Compass(compass);
                return Some((Where::Offset(distance, bearing, Anchor::Thing(thing)), parser.at));
            }
            let (relation, words) = longest(&self.lexemes[parser.at..end], OWN_SIDES)?;
            let bearing = super::wish::Bearing::Side(relation);
            Some((Where::Offset(distance, bearing, Anchor::Thing(thing)), parser.at + words))
        })
    }

    /// "On the other side of Oak Street from the museum".
    fn over_the_street(&mut self, end: usize) -> Result<Option<Where>, PlanError> {
        const OVER: &[&str] = &[
            "on the other side of",
            "on the opposite side of",
            "to the other side of",
            "on the far side of",
        ];
        let start = self.at;
        if self.eat_any(OVER) && self.street(end).is_some() && self.eat_any(&["from", "to", "of"]) {
            return Ok(Some(Where::Across(self.anchor(end)?)));
        }
        self.at = start;
        Ok(None)
    }

    /// What something is to stand to: the longest phrase from here that names a thing or a street.
    pub(super) fn anchor(&mut self, end: usize) -> Result<Anchor, PlanError> {
        let start = self.at;
        if self.eat_any(&["itself", "themselves"]) {
            return Ok(Anchor::Itself);
        }
        if self.eat_any(&["me", "myself", "us", "where i am", "where i stand", "my position", "the viewer"]) {
            return Ok(Anchor::Viewer);
        }
        if let Some(street) = self.street(end) {
            return Ok(street);
        }
        if let Some((them, words)) = self.each_of_them(start, self.before_politeness(start, end)) {
            self.at = start + words;
            return Ok(Anchor::Thing(them));
        }
        let mut parser = self.parser(start, self.before_politeness(start, end));
        let any = parser.eat_any(&["any of", "any one of", "either of", "whichever of"]);
        let mut thing = parser.reference(0)?;
        thing.indefinite |= any;
        if thing.count == Count::All {
            self.except(&mut parser, &mut thing);
        }
        self.at = parser.at;
        // "Near the fountain and behind the statue" are two places, and so is "in front of it, behind the tree".
        Ok(Anchor::Thing(thing))
    }

    /// The name of a street, which it passes.
    pub(super) fn street(&mut self, end: usize) -> Option<Anchor> {
        let start = self.at;
        self.eat_any(&["the"]);
        let found = self.view.streets.and_then(|streets| streets.at(self.rest(end)));
        let Some(street) = found else {
            self.at = start;
            return None;
        };
        self.at += street.words;
        Some(Anchor::Street(street.name.to_owned(), street.roads.to_vec()))
    }

    fn between(&mut self, end: usize) -> Result<Where, PlanError> {
        let start = self.at;
        // "Between me and the cone".
        if self.eat_any(&["me", "myself", "us", "where i am", "where i stand"])
            && self.word(self.at) == Some("and")
        {
            self.at += 1;
            return Ok(Where::Between(Anchor::Viewer, self.anchor(end)?));
        }
        self.at = start;
        for cut in start + 1..end {
            if longest_phrase(&self.lexemes[cut..end], &["and"]).is_none() {
                continue;
            }
            let Ok(one) = self.one_of(start, cut) else { continue };
            self.at = cut + 1;
            let mut other = self.anchor(end)?;
            stands_by(&mut other, &one);
            return Ok(Where::Between(Anchor::Thing(one), other));
        }
        // "Between the two trees".
        match self.anchor(end)? {
            Anchor::Thing(both) if both.count != Count::One || matches!(both.target, Target::Any(_)) => {
                let (one, other) = super::super::parser::Parser::pair(&both);
                Ok(Where::Between(Anchor::Thing(one), Anchor::Thing(other)))
            }
            // "Between them", behind a remark about two.
            Anchor::Thing(them) if them.target == Target::Them => {
                Ok(Where::Between(Anchor::Thing(them.clone()), Anchor::Thing(them)))
            }
            _ => Err(self.not_understood("say between what and what")),
        }
    }

    /// "North of", "to the east of": a direction of the compass, and where the anchor begins.
    fn compass_of(&self, at: usize, end: usize) -> Option<(super::super::compass::Compass, usize)> {
        let mut parser = self.parser(at, end.max(at));
        parser.eat_any(&["on the", "at the", "just", "directly", "to the", "right", "somewhere", "in the"]);
        let compass = parser.compass()?;
        parser.eat_any(&["side"]);
        parser.eat_any(&["of", "from"]).then_some((compass, parser.at))
    }

    /// "5 metres east", "to the north by 3 m": m east and north, and how many words it takes.
    fn shift(&self, at: usize) -> Option<(f64, f64, usize)> {
        let rest = &self.lexemes[at.min(self.lexemes.len())..];
        let by = longest_phrase(rest, &["by", "for"]).unwrap_or(0);
        // "Five south" is so many metres.
        let digits = matches!(rest.get(by).map(|lexeme| &lexeme.token), Some(Token::Number(_)));
        let plain = || numbers::number(&rest[by..]).filter(|_| digits);
        let (distance, count) = numbers::length(rest.get(by..)?).or_else(plain)?;
        let from = at + by + count;
        let mut parser = self.parser(from, self.lexemes.len());
        parser.eat_any(&[
            "towards",
            "towards the",
            "toward",
            "toward the",
            "to the",
            "further to the",
            "further",
            "due",
            "more to the",
            "farther",
            "farther to the",
            "straight",
            "over to the",
        ]);
        let compass = parser.compass()?;
        if parser.eat_any(&["of", "from"]) {
            return None;
        }
        let step = compass.step() * distance;
        Some((step.x, step.y, parser.at - at))
    }

    fn begins_point(&self, end: usize) -> bool {
        matches!(self.rest(end), [Lexeme { token: Token::Open | Token::Number(_), .. }, ..])
    }

    /// "(3, 4)", "3, 4", "x 3 y 4".
    fn point(&mut self, end: usize) -> Option<Where> {
        let start = self.at;
        let mut numbers = Vec::new();
        while self.at < end && numbers.len() < 2 {
            match &self.rest(end)[0].token {
                Token::Number(number) if number.is_finite() && number.abs() < 1e7 => numbers.push(*number),
                Token::Open | Token::Comma => {}
                Token::Word(word) if ["x", "y", "and", "=", "east", "north"].contains(&word.as_str()) => {}
                _ => break,
            }
            self.at += 1;
        }
        if matches!(self.rest(end).first(), Some(Lexeme { token: Token::Close, .. })) {
            self.at += 1;
        }
        if let [x, y] = numbers[..] {
            return Some(Where::At(Point2::new(x, y)));
        }
        self.at = start;
        None
    }
}

/// "Between the table and the chair closest to it": the second is told by where it stands to the first.
fn stands_by(other: &mut Anchor, one: &Reference) {
    let Anchor::Thing(other) = other else { return };
    let Some(
        Stands::To(_, by)
        | Stands::NearestTo(by, _)
        | Stands::Of(by)
        | Stands::Within(_, by)
        | Stands::Beyond(_, by)
        | Stands::Compass(_, Some(by)),
    ) = &mut other.relation
    else {
        return;
    };
    if is_pronoun(by) && by.relation.is_none() && !is_pronoun(one) {
        **by = one.clone();
    }
}

/// Whether "on top of it" and "around it" are said of what was made last, for what was named is a house or an area.
pub(super) fn is_of_the_new(
    place: &Where,
    named: Option<&Anchor>,
    is_large: impl Fn(&Reference) -> bool,
) -> bool {
    let stands = matches!(
        place,
        Where::To(Relation::OnTopOf, anchor) | Where::Around(anchor) if anchor.is_it()
    );
    stands && matches!(named, Some(Anchor::Thing(thing)) if is_large(thing))
}

/// Whether a reference says nothing but "it" or "there".
pub(super) fn is_pronoun(reference: &Reference) -> bool {
    matches!(reference.target, Target::It | Target::Them)
}
