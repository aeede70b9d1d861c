//! Orders about things that are taken, handed over, put down or photographed.

use super::clause::{Clause, Grip, Manner, Pace, Reference, Stands, Target};
use super::lexer::{Lexeme, Token};
use super::lexicon::{category, fits, longest_phrase};
use super::numbers;
use super::orders::{BRINGS, PHOTOS};
use super::parser::Parser;
use super::phrases::Phrases;
use super::resolve::Purpose;
use simworld_core::scene::EntityKind;
use simworld_core::seam::PlanError;

/// Who is to be driven, before where to.
#[rustfmt::skip]
const ME_TO: &Phrases = &Phrases::of(&[
    "me up at", "us up at", "me up from", "us up from", "me up by", "me up in front of",
    "me up outside", "me at", "me to", "us to", "yourself to", "me over to", "us over to",
    "yourself over to",
]);
/// Words for it, where nothing follows that makes it a way of dropping.
const THROWS: &[&str] = &["throw", "toss", "sling", "chuck"];
/// What is in hand, whatever it is.
#[rustfmt::skip]
const WHAT_YOU_HOLD: &Phrases = &Phrases::of(&[
    "what you hold", "what youre holding", "what you are holding", "what you have",
    "what you are carrying", "what youre carrying", "what you carry", "whatever you hold",
    "whatever youre holding", "whatever you are holding", "everything",
]);
/// What leads to where something is put.
#[rustfmt::skip]
const PLACES: &Phrases = &Phrases::of(&[
    "at", "to", "in", "on", "into", "over to", "back to", "onto", "with", "up to", "down to",
    "across to", "over at", "by", "along to", "out to", "round to", "off at", "down at", "down by",
    "down on", "down in", "outside", "straight to",
]);
/// Where everything falls that is put down.
#[rustfmt::skip]
const ON_THE_GROUND: &Phrases = &Phrases::of(&[
    "on the ground", "on the floor", "onto the ground", "onto the floor", "to the ground", "to the floor", "down on the ground",
    "down on the floor",
]);

/// Who may look on.
#[rustfmt::skip]
const ONLOOKERS: &Phrases = &Phrases::of(&[
    "me", "them", "him", "her", "people", "person", "tourists", "visitors", "man", "woman", "lady", "gentleman", "old man", "old lady", "old woman", "girl",
    "boy", "customers", "patients", "nurse", "doctor", "driver", "pupils", "newcomers",
]);

impl Parser<'_> {
    pub(super) fn take(&mut self, start: usize) -> Result<Vec<Clause>, PlanError> {
        if self.takes_me() {
            return self.go(Pace::Usual, start);
        }
        if let Some(clauses) = self.turn_to_take() {
            return Ok(clauses);
        }
        let taken = self.lexemes[start..self.at].iter().map(|lexeme| &lexeme.token);
        let grip = if taken.eq([&Token::Word("take".to_owned())]) { Grip::LiftOrRide } else { Grip::Lift };
        self.eat_any(&["me", "us", "yourself"]);
        if let Some((number, words)) = numbers::number(self.rest()).filter(|(number, words)| {
            self.length_before()
                && (1.0..=10.0).contains(number)
                && longest_phrase(&self.rest()[*words..], &["more"]).is_some()
        }) {
            self.at += words + 1; // "take ten steps, turn right, take five more"
            return Ok(vec![Clause::Step {
                direction: simworld_core::action::StepDirection::Forward,
                distance: number,
            }]);
        }
        if self.counts_steps() {
            if let Some(clauses) = self.by_the_compass(Pace::Usual)? {
                return Ok(clauses);
            }
            return self.step().map(|step| vec![step]);
        }
        let photos = numbers::number(self.rest()).filter(|(number, _)| *number >= 1.0 && *number <= 100.0);
        if let Some((number, count)) = photos
            && let Some(words) = longest_phrase(&self.rest()[count..], PHOTOS)
        {
            self.at += count + words;
            return self.photo(number as u32);
        }
        self.eat_any(&["up", "over", "back"]);
        if let Some(goods) = self.wished_goods() {
            return self.purchase(goods, None);
        }
        if self.beside.shots
            && self.eat_any(&["it", "them", "those", "one", "some", "these"])
            && self.ends_clause()
        {
            return Ok(Vec::new());
        }
        if let Some(photo) = self.portrait()? {
            return Ok(photo);
        }
        if let Some(clauses) = self.fetched_for()? {
            return Ok(clauses);
        }
        let start = self.at;
        let what = match self.reference(0) {
            Ok(what) => what,
            // "Get two bottles of water": what nobody has to hand over is bought.
            Err(error) => {
                self.at = start;
                return self.buy().map_err(|_| error);
            }
        };
        if let Some(clauses) = self.bought_rather(&what, start)? {
            return Ok(clauses);
        }
        self.eat_any(&[
            "up",
            "along",
            "with you",
            "over",
            "across",
            "back",
            "off",
            "off the ground",
            "off the floor",
        ]);
        let mut what = what;
        if what.relation.is_none() && self.eat_any(&["from"]) {
            what.relation = Some(Stands::Of(Box::new(self.reference(0)?)));
        }
        let mut to = self.tail_place(BRINGS)?;
        if to.is_none() && what.target == Target::It {
            to = self.there_behind();
        }
        if to.is_none()
            && self.peeks("for")
            && let Some(whom) = self.for_whom()
        {
            return Ok(vec![Clause::Give { what: Some(what), to: whom }]);
        }
        Ok(vec![Clause::Take { what, to, grip }])
    }

    /// "Get bread" where a house is called after what it sells: the house is not meant.
    fn bought_rather(&mut self, what: &Reference, start: usize) -> Result<Option<Vec<Clause>>, PlanError> {
        let end = std::mem::replace(&mut self.at, start);
        let house = self.view.find(what, super::resolve::Purpose::Any);
        if house.is_ok_and(|found| found.kind == simworld_core::scene::EntityKind::Building)
            && let Some(goods) = self.goods()
        {
            return self.purchase(goods, None).map(Some);
        }
        self.at = end;
        Ok(None)
    }

    /// "There", behind what is brought there.
    fn there_behind(&mut self) -> Option<Reference> {
        self.eat_any(&["there", "over there", "down there", "up there", "back there", "right there"])
            .then(|| Reference::to(Target::There, "there".to_owned()))
    }

    /// "Take me to the school", "pick me up at the café": who is driven says where to.
    fn takes_me(&mut self) -> bool {
        let brings_me = self.at > 0 && self.lexemes[self.at - 1].token == Token::Word("me".to_owned());
        // "Take me there", "take me somewhere to eat".
        let me = longest_phrase(self.rest(), &["me", "us"]).unwrap_or(0);
        let after = &self.rest()[me..];
        let place = me > 0
            && (longest_phrase(after, &["there", "home", "over there"]).is_some()
                || longest_phrase(after, &["somewhere", "someplace"]).is_some()
                    && category(after).is_some_and(|(class, _)| class.is_place()));
        if place {
            self.at += me;
            return true;
        }
        self.eat_any(ME_TO) || brings_me && self.eat_any(&["to", "over to", "back to"])
    }

    /// "Take its picture", "take Anna's photo".
    pub(super) fn portrait(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        const WHOSE: &[(&[&str], Target)] =
            &[(&["its", "their"], Target::It), (&["his", "her"], Target::Them)];
        let start = self.at;
        for (words, target) in WHOSE {
            if self.eat_any(words) && self.eat_any(PHOTOS) {
                let of = Some(Reference::to(target.clone(), self.text_from(start)));
                return Ok(Some(vec![Clause::Photo { of, times: 1 }]));
            }
            self.at = start;
        }
        let whose = (1..4).find(|at| {
            self.rest().get(*at).is_some_and(|_| longest_phrase(&self.rest()[*at..], PHOTOS).is_some())
        });
        let possessive = whose.filter(|at| {
            let last = &self.rest()[at - 1];
            self.words[last.start..last.end].ends_with("'s")
                || self.words[last.start..last.end].ends_with("’s")
        });
        let Some(words) = possessive else { return Ok(None) };
        let mut owner: Vec<Lexeme> = self.rest()[..words].to_vec();
        if let Some(Lexeme { token: Token::Word(word), .. }) = owner.last_mut() {
            word.pop();
        }
        let mut named = Parser::new(self.words, &owner, self.names, self.view);
        let of = named.reference(0)?;
        self.at += words;
        self.eat_any(PHOTOS);
        Ok(Some(vec![Clause::Photo { of: Some(of), times: 1 }]))
    }

    /// "Snap two photos of": two; none if no photo is spoken of.
    pub(super) fn number_of_photos(&mut self) -> u32 {
        let start = self.at;
        let number = numbers::count(self.rest());
        self.at += number.map_or(0, |(_, count)| count);
        if number.is_none() {
            self.eat_any(&["a", "an", "another", "some"]);
        }
        let said = self.eat_any(PHOTOS);
        if said && number.is_none() {
            return 1;
        }
        let Some((number, _)) = number.filter(|_| said) else {
            self.at = start;
            return 0;
        };
        number
    }

    pub(super) fn photo(&mut self, times: u32) -> Result<Vec<Clause>, PlanError> {
        let named = self.eat_any(&["of", "showing", "with"])
            || longest_phrase(self.rest(), &["from the", "from my"]).is_some() && self.eat_any(&["from"])
            || !self.ends_clause();
        let of = if named { Some(self.reference(0)?) } else { None };
        Ok(vec![Clause::Photo { of, times }])
    }

    pub(super) fn give(&mut self) -> Result<Vec<Clause>, PlanError> {
        let start = self.at;
        if self.eat_any(&["me", "us", "it", "them"])
            && let Some((seconds, words)) =
                numbers::duration(self.rest()).filter(|(seconds, words)| *seconds > 0.0 && *words > 1)
        {
            self.at += words;
            return Ok(vec![Clause::Wait { seconds }]); // "give me a minute"
        }
        self.at = start;
        self.eat_any(&["me", "us"]);
        if let Some(clauses) = self.gesture_to()? {
            return Ok(clauses);
        }
        let somebody = self.somebody_presented();
        let what_at = self.at;
        if let Some(goods) = self.goods() {
            let known =
                self.is_bought(&goods) && longest_phrase(&self.lexemes[what_at..], &["the"]).is_some();
            // "Buy a water, walk to Ben, hand him the water".
            let to = match somebody.clone() {
                None if known && self.eat_any(&["to", "over to"]) => self.somebody_here(),
                to => to,
            };
            if let Some(to) = to.filter(|_| known) {
                let what = Reference::to(Target::It, self.text_from(what_at));
                return Ok(vec![Clause::Give { what: Some(what), to }]);
            }
            return self.purchase(goods, somebody);
        }
        self.at = start;
        // "Pass me the umbrella": nobody else is to have it.
        if self.view.speaker.is_none() && self.eat_any(&["me", "us"]) && !self.ends_clause() {
            return Ok(vec![Clause::Take { what: self.reference(0)?, to: None, grip: Grip::Lift }]);
        }
        let first = self.reference(0)?;
        if let Some((seconds, words)) = numbers::duration(self.rest())
            .filter(|(seconds, words)| first.target == Target::It && *words > 1 && *seconds > 0.0)
        {
            self.at += words;
            return Ok(vec![Clause::Wait { seconds }]); // "give it ten seconds"
        }
        if let Some(clauses) = self.gesture(&first) {
            return Ok(clauses);
        }
        let over = self.eat_any(&["over", "back"]);
        if over && self.ends_clause() {
            let to = Reference::to(Target::Them, "them".to_owned());
            return Ok(vec![Clause::Give { what: Some(first), to }]);
        }
        if self.eat_any(&["to", "over to", "back to", "on to", "up to", "across to"]) {
            return Ok(vec![Clause::Give { what: Some(first), to: self.reference(0)? }]);
        }
        if self.ends_clause() {
            return Err(self.not_understood("say to whom, as in \"give the parcel to Anna\""));
        }
        self.at += usize::from(self.is_somebody(&first) && self.peeks("with")); // "present Anna with the letter"
        Ok(vec![Clause::Give { what: Some(self.reference(0)?), to: first }])
    }

    /// "Throw the ball to Anna", "toss Anna the ball": only at somebody, since what is thrown anywhere else is dropped there.
    pub(super) fn throw(&mut self, start: usize) -> Option<Clause> {
        let behind = self.at;
        let [Lexeme { token: Token::Word(said), lemma, .. }] = self.lexemes.get(start..behind)? else {
            return None;
        };
        let is_throw = THROWS.contains(&lemma.as_deref().unwrap_or(said));
        let clause = if is_throw { self.thrown() } else { None };
        if clause.is_none() {
            self.at = behind;
        }
        clause
    }

    fn thrown(&mut self) -> Option<Clause> {
        let first = if self.eat_any(WHAT_YOU_HOLD) { None } else { Some(self.reference(0).ok()?) };
        if self.eat_any(&["to", "over to", "across to", "back to", "at"]) {
            let to = self.reference(0).ok()?;
            return self.catches(&to).then_some(Clause::Throw { what: first, to });
        }
        let to = first.filter(|first| self.catches(first) && !self.ends_clause())?;
        Some(Clause::Throw { what: Some(self.reference(0).ok()?), to })
    }

    /// Whether a phrase stands for somebody with hands.
    fn catches(&self, who: &Reference) -> bool {
        let found = self.view.find(who, Purpose::Any);
        found.is_ok_and(|found| matches!(found.kind, EntityKind::Person | EntityKind::Robot))
    }

    pub(super) fn drop(&mut self, manner: Manner) -> Result<Vec<Clause>, PlanError> {
        let start = self.at;
        if manner == Manner::Deliver {
            if let Some(goods) = self.wished_goods() {
                return self.purchase(goods, None);
            }
            let whom = self.receiver();
            if let Some(goods) = self.wished_goods().or_else(|| self.goods()) {
                return self.purchase(goods, whom);
            }
            self.at = start;
        }
        self.eat_any(WHAT_YOU_HOLD);
        let what = if self.ends_clause() || longest_phrase(self.rest(), PLACES).is_some() {
            None
        } else {
            Some(self.reference(0)?)
        };
        self.eat_any(&["down", "off", "up", "over", "across", "back", "aside", "away"]);
        if manner != Manner::Deliver {
            self.eat_any(ON_THE_GROUND);
        }
        let mut at = self.tail_place(PLACES)?;
        let what = what.map(|mut what| {
            // "Put the cone next to the bin" says where to, and not which cone.
            match what.relation.take() {
                Some(Stands::To(_, anchor)) if at.is_none() => at = Some(*anchor),
                relation => what.relation = relation,
            }
            what
        });
        if at.is_none() {
            at = self.there_behind();
        }
        if at.is_none() && self.eat_any(&["here", "back", "back here"]) {
            at = Some(Reference::to(Target::Here, "here".to_owned()));
        }
        if manner == Manner::Deliver && at.is_none() {
            return self.delivered_to_somebody(what);
        }
        Ok(vec![Clause::Drop { what, at, manner }])
    }

    /// "Bring Anna the parcel", "bring it over": no place follows.
    fn delivered_to_somebody(&mut self, what: Option<Reference>) -> Result<Vec<Clause>, PlanError> {
        let over = self.lexemes[self.at - 1].token == Token::Word("over".to_owned());
        if over && self.ends_clause() {
            let to = Reference::to(Target::Them, "them".to_owned());
            return Ok(vec![Clause::Give { what, to }]);
        }
        if !self.ends_clause()
            && let Some(to) = what
        {
            return Ok(vec![Clause::Give { what: Some(self.reference(0)?), to }]); // "bring Anna the parcel"
        }
        Err(self.not_understood("say where to, as in \"bring the parcel to the museum\""))
    }

    /// "Move the letter to the clinic" is about the letter.
    pub(super) fn moves_thing(&mut self, start: usize) -> bool {
        let moves = ["move", "shift", "relocate", "run", "rush", "return"]
            .iter()
            .any(|word| fits(&self.lexemes[start..self.at], word).is_some());
        let at = self.at;
        let thing = moves
            && longest_phrase(
                self.rest(),
                &[
                    "the", "that", "this", "it", "my", "a", "both", "all", "these", "those", "two", "his",
                    "her", "them", "your",
                ],
            )
            .is_some()
            && self.reference(0).is_ok();
        let leads = thing && longest_phrase(self.rest(), BRINGS).is_some();
        self.at = at;
        leads
    }

    /// "Point out to me the red car".
    pub(super) fn point_out(&mut self) -> Result<Clause, PlanError> {
        self.eat_any(&[
            "at",
            "to",
            "towards",
            "out",
            "over at",
            "over to",
            "your finger at",
            "up at",
            "in the direction of",
            "out to me",
            "me to",
        ]);
        // "Where's the Registry? Show me".
        let it = || Reference::to(Target::It, "it".to_owned());
        let at = if self.ends_clause() { it() } else { self.reference(0)? };
        self.eat_any(&["out"]); // "the tower, point it out"
        self.skip_onlookers(&["to", "for"]);
        Ok(Clause::Point { at })
    }

    /// "... to these people", "... for the lady": whoever sees it, or is helped by it, changes nothing of what is done.
    pub(super) fn skip_onlookers(&mut self, leads: &[&str]) {
        let start = self.at;
        if self.eat_any(leads) {
            self.eat_any(super::lexicon::DETERMINERS);
            if (self.eat_any(super::shopping::OTHERS) || self.eat_any(ONLOOKERS)) && self.ends_clause() {
                return;
            }
        }
        self.at = start;
    }

    /// "Wave your hand at Ben".
    pub(super) fn wave(&mut self) -> Result<Clause, PlanError> {
        // "Anna waves at you, wave back".
        let start = self.at;
        if self.eat_any(&["back"]) && self.ends_clause() {
            return Ok(Clause::Wave { to: Reference::to(Target::Them, "them".to_owned()) });
        }
        self.at = start;
        self.eat_any(&[
            "at",
            "to",
            "over at",
            "over to",
            "hello to",
            "goodbye to",
            "hi to",
            "across to",
            "back at",
            "hello at",
            "towards",
            "in the direction of",
            "your hand at",
            "your hand to",
            "hand to",
            "hands to",
            "your hand",
        ]);
        let it = Reference::to(Target::It, "it".to_owned());
        Ok(Clause::Wave { to: if self.ends_clause() { it } else { self.reference(0)? } })
    }
}
