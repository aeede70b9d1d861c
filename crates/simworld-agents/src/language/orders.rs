//! One order: a verb with its objects.

use simworld_core::seam::PlanError;

use super::clause::{Clause, Count, Grip, Manner, Pace, Reference, Stands, Target, Vehicle};
use super::lexer::{Lexeme, Token};
use super::lexicon::{RELATIONS, category, longest, longest_phrase};
use super::numbers;
use super::parser::{Parser, UNDERSTOOD};
use super::verbs::{Verb, longest_verb};

/// What people take photos with their words of.
const PHOTOS: &[&str] =
    &["photos", "photo", "pictures", "picture", "photographs", "snapshots", "shots", "selfies", "pics"];

impl Parser<'_> {
    /// An order; several if one verb says several things.
    pub(super) fn order(&mut self) -> Result<Vec<Clause>, PlanError> {
        self.skip_fillers();
        let start = self.at;
        if let Some(laps) = self.laps()? {
            return Ok(laps);
        }
        let Some((verb, count)) = self.verb_here() else {
            return self.order_without_verb();
        };
        if self.goes_to_do(count) {
            self.at += count;
            return self.order();
        }
        self.at += count;
        self.verb = Some(verb);
        // "Wave twice at Carol"; at the end of an order it may be about more than this one.
        let mut times = numbers::times(self.rest());
        self.at += times.map_or(0, |(_, count)| count);
        if times.is_some() && self.ends_clause() {
            self.at -= times.take().map_or(0, |(_, count)| count);
        }
        let mut clauses = self.objects(verb, start)?;
        if let Some((times, _)) = times.filter(|(times, _)| *times > 1) {
            clauses = vec![Clause::Repeat { times, body: clauses }];
        }
        Ok(clauses)
    }

    /// "Go sit down", "come and have a look": going is only the way to it.
    fn goes_to_do(&self, count: usize) -> bool {
        const PLACES: &[&str] = &["back", "past", "round", "around", "point", "report"];
        let is_go = count == 1 && (self.peeks("go") || self.peeks("come"));
        let after = &self.rest()[count.min(self.rest().len())..];
        // Names come last: the index of a large city takes time.
        is_go
            && longest_verb(after).is_some()
            && longest_phrase(after, PLACES).is_none()
            && longest(after, RELATIONS).is_none()
            && category(after).is_none()
            && self.names.exact(after).is_none()
    }

    fn verb_here(&self) -> Option<(Verb, usize)> {
        longest_verb(self.rest())
    }

    /// "... then to the museum": the verb of the order before goes on.
    fn order_without_verb(&mut self) -> Result<Vec<Clause>, PlanError> {
        const BEGINNINGS: &[&str] = &["to", "at", "the", "a", "an", "him", "her", "it", "towards"];
        let refused = self.not_understood(UNDERSTOOD);
        let has_objects = |verb: &Verb| {
            !matches!(
                verb,
                Verb::StandUp
                    | Verb::Stop
                    | Verb::Sit
                    | Verb::Wait
                    | Verb::Faster
                    | Verb::Slower
                    | Verb::Alight
            )
        };
        // "... and then on to the taxi" goes on going, whatever was done in between.
        let moves = longest_phrase(
            self.rest(),
            &["on to", "onto", "over to", "back to", "across to", "back here", "back"],
        )
        .is_some();
        let last = if moves { Some(Verb::Go) } else { self.verb };
        let Some(verb) = last.filter(has_objects) else { return Err(refused) };
        let is_phrase = moves || longest_phrase(self.rest(), BEGINNINGS).is_some();
        let start = self.at;
        self.eat_any(match verb {
            Verb::Look | Verb::Wave | Verb::Point => &["at", "to"][..],
            Verb::Talk | Verb::Greet => &["to", "with"],
            _ => &[],
        });
        match self.objects(verb, start) {
            Ok(clauses) if self.at > start => Ok(clauses),
            Err(error) if is_phrase => Err(error),
            _ => {
                self.at = start;
                Err(refused)
            }
        }
    }

    fn objects(&mut self, verb: Verb, start: usize) -> Result<Vec<Clause>, PlanError> {
        let one = |clause| Ok(vec![clause]);
        let leads =
            [Verb::Go, Verb::Run, Verb::Stroll, Verb::Take, Verb::Follow, Verb::Drive].contains(&verb);
        if leads && self.best_way() {
            let pace = if verb == Verb::Run { Pace::Run } else { Pace::Usual };
            let to = self.reference(0)?;
            return self.after_place(Clause::Go { to, side: None, pace, within: None }, pace);
        }
        match verb {
            Verb::Go => self.go(Pace::Usual, start),
            Verb::Run => self.go(Pace::Run, start),
            Verb::Stroll => self.go(Pace::Slow, start),
            Verb::Cross => {
                self.eat_any(&["the", "this", "over"]);
                self.eat_any(&["road", "street", "crossing", "crosswalk", "zebra crossing", "road here"]);
                self.eat_any(&["to the other side", "over", "at the crossing", "at the crosswalk"]);
                self.eat_any(&["of the street", "of the road", "of the crossing"]);
                one(Clause::Cross)
            }
            Verb::Follow => {
                let whom = self.reference(0)?;
                self.eat_any(&["around", "about", "everywhere", "wherever they go"]);
                one(Clause::Follow { whom, pace: self.pace(Pace::Usual)? })
            }
            Verb::Take => self.take(start),
            Verb::Deliver
                if self.eat_any(&[
                    "me to",
                    "us to",
                    "me over to",
                    "us over to",
                    "me back to",
                    "us back to",
                ]) =>
            {
                self.go(Pace::Usual, start)
            }
            Verb::Deliver => self.drop(Manner::Deliver),
            Verb::Give => self.give(),
            Verb::Drop => self.drop(Manner::DropOff),
            Verb::PutDown => self.drop(Manner::PutDown),
            Verb::Buy => self.buy(),
            Verb::Sit => self.sit(),
            Verb::StandUp if self.is_place() => self.go(Pace::Usual, start),
            Verb::StandUp => {
                self.tail_place(&["from"])?; // from which seat is no choice
                one(Clause::StandUp)
            }
            Verb::Stop => self.stop(),
            Verb::Park => self.park(),
            Verb::Pass => self.past(Pace::Usual),
            Verb::Circle => self.round(Pace::Usual),
            Verb::Wait => self.wait(),
            Verb::Board => self.board(),
            Verb::Drive => self.drive(),
            Verb::Alight => one(self.alight()),
            Verb::Step => self.step().map(|step| vec![step]),
            Verb::Reverse => self.reverse().map(|step| vec![step]),
            Verb::Turn => self.turn().map(|turn| vec![turn]),
            Verb::Look => self.look().map(|look| vec![look]),
            Verb::Face => self.face().map(|face| vec![face]),
            Verb::Point => one(Clause::Point { at: self.reference(0)? }),
            Verb::Wave => {
                self.eat_any(&[
                    "at",
                    "to",
                    "your hand at",
                    "your hand to",
                    "hand to",
                    "hands to",
                    "your hand",
                ]);
                let it = Reference::to(Target::It, "it".to_owned());
                one(Clause::Wave { to: if self.ends_clause() { it } else { self.reference(0)? } })
            }
            Verb::Talk | Verb::Greet | Verb::Say | Verb::Tell | Verb::Argue => self.speak(verb),
            Verb::Open | Verb::Close => {
                let what = if self.ends_clause() { None } else { Some(self.reference(0)?) };
                self.eat_any(&["up", "for me"]);
                one(Clause::Door { what, open: verb == Verb::Open })
            }
            Verb::Photo => {
                let times = self.number_of_photos();
                self.photo(times)
            }
            Verb::Faster | Verb::Slower if self.eat_any(&["to"]) => {
                one(Clause::Speed { speed: self.speed()? })
            }
            Verb::Faster => one(Clause::Speed { speed: 2.0 }),
            Verb::Slower => one(Clause::Speed { speed: super::draft::STROLLING }),
            Verb::SetSpeed => {
                let speed = self.speed()?;
                if longest_phrase(self.rest(), &["to", "towards", "over to"]).is_some() {
                    return self.go(Pace::At(speed), start);
                }
                one(Clause::Speed { speed })
            }
        }
    }

    /// "Stand behind the statue", "stand halfway between": where to stand, and not to get up.
    fn is_place(&self) -> bool {
        const PLACES: &[&str] = &[
            "at",
            "between",
            "in between",
            "halfway",
            "midway",
            "half way",
            "north",
            "south",
            "east",
            "west",
            "to the north",
            "to the south",
            "to the east",
            "to the west",
        ];
        longest(self.rest(), RELATIONS).is_some() || longest_phrase(self.rest(), PLACES).is_some()
    }

    fn take(&mut self, start: usize) -> Result<Vec<Clause>, PlanError> {
        if self.eat_any(&["me to", "us to", "yourself to", "me over to", "us over to", "yourself over to"]) {
            return self.go(Pace::Usual, start);
        }
        let brings_me = self.at > 0 && self.lexemes[self.at - 1].token == Token::Word("me".to_owned());
        if brings_me && self.eat_any(&["to", "over to", "back to"]) {
            return self.go(Pace::Usual, start); // "bring me to the school"
        }
        if let Some(clauses) = self.turn_to_take() {
            return Ok(clauses);
        }
        let taken = self.lexemes[start..self.at].iter().map(|lexeme| &lexeme.token);
        let grip = if taken.eq([&Token::Word("take".to_owned())]) { Grip::LiftOrRide } else { Grip::Lift };
        self.eat_any(&["me", "us", "yourself"]);
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
        let start = self.at;
        let what = match self.reference(0) {
            Ok(what) => what,
            // "Get two bottles of water": what nobody has to hand over is bought.
            Err(error) => {
                self.at = start;
                return self.buy().map_err(|_| error);
            }
        };
        self.eat_any(&["up", "along", "with you"]);
        let to = self.tail_place(&["to", "over to", "back to", "into"])?;
        Ok(vec![Clause::Take { what, to, grip }])
    }

    /// "Snap two photos of": two.
    fn number_of_photos(&mut self) -> u32 {
        let start = self.at;
        let number = numbers::count(self.rest());
        self.at += number.map_or(0, |(_, count)| count);
        let Some((number, _)) = number.filter(|_| self.eat_any(PHOTOS)) else {
            self.at = start;
            return 1;
        };
        number
    }

    fn photo(&mut self, times: u32) -> Result<Vec<Clause>, PlanError> {
        let named = self.eat_any(&["of"]) || !self.ends_clause();
        let of = if named { Some(self.reference(0)?) } else { None };
        Ok(vec![Clause::Photo { of, times }])
    }

    fn give(&mut self) -> Result<Vec<Clause>, PlanError> {
        let first = self.reference(0)?;
        if let Some(clauses) = self.gesture(&first) {
            return Ok(clauses);
        }
        if self.eat_any(&["to", "over to"]) {
            return Ok(vec![Clause::Give { what: Some(first), to: self.reference(0)? }]);
        }
        if self.ends_clause() {
            return Err(self.not_understood("say to whom, as in \"give the parcel to Anna\""));
        }
        Ok(vec![Clause::Give { what: Some(self.reference(0)?), to: first }])
    }

    /// "Give Ben a wave".
    fn gesture(&mut self, to: &Reference) -> Option<Vec<Clause>> {
        let start = self.at;
        let number = numbers::number(self.rest()).filter(|(number, _)| (1.0..=100.0).contains(number));
        self.at += number.map_or(0, |(_, count)| count);
        self.eat_any(&["big", "little", "friendly", "quick", "nice", "small"]);
        if number.is_none() || !self.eat_any(&["wave", "waves", "wave of your hand"]) {
            self.at = start;
            return None;
        }
        let wave = Clause::Wave { to: to.clone() };
        let times = number.map_or(1, |(number, _)| number as u32);
        Some(vec![if times == 1 { wave } else { Clause::Repeat { times, body: vec![wave] } }])
    }

    fn drop(&mut self, manner: Manner) -> Result<Vec<Clause>, PlanError> {
        let places = ["at", "to", "in", "on", "into", "over to", "back to", "onto", "with"];
        self.eat_any(&[
            "what you hold",
            "what youre holding",
            "what you are holding",
            "what you have",
            "what you are carrying",
            "what youre carrying",
            "what you carry",
            "whatever you hold",
            "whatever youre holding",
            "whatever you are holding",
            "everything",
        ]);
        let what = if self.ends_clause() || longest_phrase(self.rest(), &places).is_some() {
            None
        } else {
            Some(self.reference(0)?)
        };
        self.eat_any(&["down", "off", "up"]);
        let mut at = self.tail_place(&places)?;
        let what = what.map(|mut what| {
            // "Put the cone next to the bin" says where to, and not which cone.
            match what.relation.take() {
                Some(Stands::To(_, anchor)) if at.is_none() => at = Some(*anchor),
                relation => what.relation = relation,
            }
            what
        });
        if at.is_none() && self.eat_any(&["here", "back", "back here"]) {
            at = Some(Reference::to(Target::Here, "here".to_owned()));
        }
        if manner == Manner::Deliver && at.is_none() {
            if !self.ends_clause()
                && let Some(to) = what
            {
                return Ok(vec![Clause::Give { what: Some(self.reference(0)?), to }]); // "bring Anna the parcel"
            }
            return Err(self.not_understood("say where to, as in \"bring the parcel to the museum\""));
        }
        Ok(vec![Clause::Drop { what, at, manner }])
    }

    /// A place after one of these words.
    pub(super) fn tail_place(&mut self, words: &[&str]) -> Result<Option<Reference>, PlanError> {
        let side = longest(self.rest(), RELATIONS).map(|(_, count)| count);
        match longest_phrase(self.rest(), words).max(side) {
            Some(count) => {
                self.at += count;
                self.reference(0).map(Some)
            }
            None => Ok(None),
        }
    }

    fn board(&mut self) -> Result<Vec<Clause>, PlanError> {
        let what = if self.ends_clause() {
            Reference::to(Target::It, "it".to_owned())
        } else if self.eat_any(&["to"]) {
            // "Ride to the school": on what one is on.
            return Ok(vec![Clause::Go {
                to: self.reference(0)?,
                side: None,
                pace: Pace::Usual,
                within: None,
            }]);
        } else {
            self.reference(0)?
        };
        Ok(vec![Clause::Board { what, to: self.tail_place(&["to", "over to", "back to"])? }])
    }

    fn alight(&mut self) -> Clause {
        self.eat_any(&["the", "of the", "of"]);
        let cars = ["car", "bus", "truck", "taxi", "van", "vehicle", "cab", "lorry"];
        let from = if self.peeks("scooter") {
            Vehicle::Scooter
        } else if longest_phrase(self.rest(), &cars).is_some() {
            Vehicle::Car
        } else {
            Vehicle::Any
        };
        self.at += usize::from(from != Vehicle::Any);
        self.eat_any(&["it", "again"]);
        Clause::Alight { from }
    }

    /// Whether a number of metres or steps follows: "take two steps".
    pub(super) fn counts_steps(&self) -> bool {
        numbers::number(self.rest())
            .is_some_and(|(_, count)| longest_phrase(&self.rest()[count..], super::motion::LENGTHS).is_some())
    }

    /// Two or more of something.
    pub(super) fn peek_count(&self) -> Option<(Count, usize)> {
        const ALL: &[&str] =
            &["all", "all of the", "all the", "every", "each", "each of the", "every one of the"];
        const BOTH: &[&str] = &["both", "both of the", "both the"];
        if let Some(words) = longest_phrase(self.rest(), BOTH) {
            return Some((Count::Exactly(2), words));
        }
        if let Some(words) = longest_phrase(self.rest(), ALL) {
            let (count, more) = numbers::count(&self.rest()[words..])
                .map_or((Count::All, 0), |(number, more)| (Count::Exactly(number), more));
            return Some((count, words + more));
        }
        let is_noun = |count: usize| {
            let next = self.rest().get(count).map(|lexeme: &Lexeme| &lexeme.token);
            matches!(next, Some(Token::Word(_)))
        };
        let (number, count) = numbers::count(self.rest()).filter(|(_, count)| is_noun(*count))?;
        let of = longest_phrase(&self.rest()[count..], &["of the", "of those", "of"]).unwrap_or(0);
        Some((Count::Exactly(number), count + of))
    }
}
