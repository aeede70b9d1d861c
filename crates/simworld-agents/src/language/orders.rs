//! One order: a verb with its objects.

use simworld_core::seam::PlanError;

use super::clause::{Clause, Count, Manner, Pace, Reference, Target};
use super::lexer::{Lexeme, Token};
use super::lexicon::{category, fits, longest_phrase, longest_relation};
use super::numbers;
use super::parser::{Parser, UNDERSTOOD};
use super::phrases::{PhraseList, Phrases};
use super::verbs::{Verb, longest_verb};

/// What people take photos with their words of.
#[rustfmt::skip]
pub(super) const PHOTOS: &Phrases = &Phrases::of(&[
    "snaps", "snap", "photograph", "shot", "selfie", "pic", "snapshot", "photos", "photo", "pictures",
    "picture", "photographs", "snapshots", "shots", "selfies", "pics", "still", "stills", "portrait", "portraits",
    "image", "images", "screenshot", "screenshots", "close up", "close ups", "headshot",
]);

/// What leads to where something is brought.
#[rustfmt::skip]
pub(super) const BRINGS: &Phrases = &Phrases::of(&[
    "to", "over to", "back to", "into", "up to", "down to", "across to", "along to", "out to", "round to",
    "off to", "all the way to", "straight to", "right to", "back over to",
]);

/// Between going and what one goes for.
#[rustfmt::skip]
const TO_DO: &Phrases = &Phrases::of(&[
    "out and", "over and", "along and", "off and", "down and", "up and", "on and", "round and", "out to",
    "off to", "and",
]);

impl Parser<'_> {
    /// An order; several if one verb says several things.
    pub(super) fn order(&mut self) -> Result<Vec<Clause>, PlanError> {
        self.skip_fillers();
        let ours = self.peeks("we") && self.rest().get(1).is_some_and(|next| next.lemma.is_none());
        if ours && longest_verb(&self.rest()[1..]).is_some() {
            self.at += 1; // "then we sit on the bench"
        }
        let start = self.at;
        if let Some(laps) = self.laps()? {
            return Ok(laps);
        }
        if let Some(clauses) = self.on_heels() {
            return Ok(clauses);
        }
        if self.peeks("keep") && self.rest().iter().take(5).any(is_company) {
            self.at += 1;
            let to = self.reference(0)?; // "keep Anna company"
            self.eat_any(&["company"]);
            return Ok(vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }]);
        }
        let Some((verb, count)) = self.verb_here() else {
            let clauses = self.order_without_verb()?;
            self.group_with(&clauses);
            return Ok(clauses);
        };
        if self.goes_to_do(count) {
            self.at += count;
            self.eat_any(TO_DO);
            return self.order();
        }
        self.at += count;
        self.beside.shots &= verb == Verb::Take;
        self.previous = self.verb.replace(verb);
        // "Wave twice at Carol"; at the end of an order it may be about more than this one.
        let mut times = numbers::times(self.rest());
        self.at += times.map_or(0, |(_, count)| count);
        if times.is_some() && self.ends_clause() {
            self.at -= times.take().map_or(0, |(_, count)| count);
        }
        let mut clauses = self.objects(verb, start)?;
        self.group.clear();
        self.group_with(&clauses);
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
        let moves = longest_verb(self.rest()).is_some_and(|(verb, _)| matches!(verb, Verb::Go | Verb::Run));
        let out = longest_phrase(after, TO_DO);
        if moves
            && out.is_some_and(|words| {
                longest_verb(&after[words..]).is_some_and(|(verb, _)| verb != Verb::Shuttle)
            })
        {
            return true;
        }
        // Names come last: the index of a large city takes time.
        is_go
            && longest_verb(after).is_some()
            && (longest_phrase(after, PLACES).is_none()
                || longest_phrase(after, &["point at", "point to", "point out"]).is_some())
            && longest_relation(after).is_none()
            && category(after).is_none()
            && self.names.exact(after).is_none()
    }

    fn verb_here(&self) -> Option<(Verb, usize)> {
        longest_verb(self.rest())
    }

    /// "... then to the museum": the verb of the order before goes on.
    fn order_without_verb(&mut self) -> Result<Vec<Clause>, PlanError> {
        const BEGINNINGS: &Phrases =
            &Phrases::of(&["to", "at", "the", "a", "an", "him", "her", "it", "towards"]);
        const STATES: &[&str] =
            &["its", "it is", "theres", "there is", "thats", "that is", "hes", "shes", "im", "theyre"];
        let refused = self.not_understood(UNDERSTOOD);
        let here = self.at;
        if let Some(clauses) = self.counted_deeds()? {
            return Ok(clauses);
        }
        let counted = std::mem::replace(&mut self.at, here);
        // "Say hello to Zoe, she only came today": who does something is nobody to whom the same is done.
        if longest_phrase(&self.lexemes[here..], &["he", "she", "they", "we"]).is_some() {
            self.at = here;
            return Err(refused);
        }
        let goes = matches!(self.verb, Some(Verb::Go | Verb::Run | Verb::Stroll));
        if goes && let Some(clauses) = self.by_the_compass(Pace::Usual).ok().flatten() {
            return Ok(clauses);
        }
        self.at = counted;
        if let Some(step) = self.bare_step(here) {
            return Ok(vec![step]);
        }
        // "... and then on to the taxi" goes on going, whatever was done in between.
        let moves = longest_phrase(
            self.rest(),
            &["on to", "onto", "over to", "back to", "across to", "back here", "back"],
        )
        .is_some();
        let leads = longest_phrase(self.rest(), &["to", "off to", "over to"]).is_some();
        let last = if moves { Some(Verb::Go) } else { self.verb.or(leads.then_some(Verb::Go)) };
        let Some(verb) = last.filter(|verb| has_objects(*verb)) else { return Err(refused) };
        let is_phrase = moves || longest_phrase(self.rest(), BEGINNINGS).is_some();
        let start = self.at;
        // "..., it's chilly in there, then say thanks" tells, and is nothing to say.
        if matches!(verb, Verb::Say | Verb::Tell) && longest_phrase(self.rest(), STATES).is_some() {
            return Err(refused);
        }
        if verb == Verb::Sit && longest_phrase(self.rest(), &["on", "in", "at"]).is_none() {
            return Err(refused);
        }
        self.eat_any(match verb {
            Verb::Look | Verb::Wave | Verb::Point => &["at", "to"][..],
            Verb::Talk | Verb::Greet => &["to", "with"],
            _ => &[],
        });
        match self.objects(verb, start) {
            Ok(clauses) if self.at > start => Ok(clauses),
            Err(error) if is_phrase && !self.may_be_nominal(start) => Err(error),
            _ => {
                self.at = start;
                Err(refused)
            }
        }
    }

    /// Whether what a phrase means ever moves.
    fn moves_about(&self, what: &Reference) -> bool {
        match &what.target {
            Target::Any(class) => class.kinds().iter().any(|kind| kind.is_mobile()),
            Target::Named(ids) => {
                ids.iter().any(|id| self.view.scene.entity(*id).is_some_and(|entity| entity.kind.is_mobile()))
            }
            _ => true,
        }
    }

    /// "Cross to the red bench" leads there; "cross the road" and "cross to the other side" lead across.
    fn leads_across(&self) -> bool {
        const SIDES: &[&str] = &[
            "to the other side",
            "to the other",
            "over to the other side",
            "to the opposite side",
            "over to the opposite side",
            "to the far side",
        ];
        longest_phrase(self.rest(), &["to", "over to", "towards", "over towards"]).is_some()
            && longest_phrase(self.rest(), SIDES).is_none()
    }

    /// "Count to ten", "count ten seconds": a second for each.
    fn count_up(&mut self) -> Result<Vec<Clause>, PlanError> {
        self.eat_any(&["up to", "to", "slowly to", "from one to", "from 1 to", "off"]);
        let seconds = numbers::duration(self.rest()).or_else(|| numbers::number(self.rest()));
        let Some((seconds, words)) = seconds.filter(|(seconds, _)| (1.0..=1000.0).contains(seconds)) else {
            return Err(self.not_understood("say to how many, as in \"count to ten\""));
        };
        self.at += words;
        Ok(vec![Clause::Wait { seconds }])
    }

    fn objects(&mut self, verb: Verb, start: usize) -> Result<Vec<Clause>, PlanError> {
        let one = |clause| Ok(vec![clause]);
        let leads =
            [Verb::Go, Verb::Run, Verb::Stroll, Verb::Take, Verb::Follow, Verb::Drive].contains(&verb);
        if leads && self.best_way() {
            let pace = if verb == Verb::Run { Pace::Run } else { Pace::Usual };
            self.eat_any(&["back"]);
            let to = self.reference(0)?;
            return self.after_place(Clause::Go { to, side: None, pace, within: None }, pace);
        }
        if leads && let Some(ways) = self.way_by_places() {
            return Ok(ways);
        }
        if leads && matches!(self.previous, Some(Verb::Go | Verb::Run | Verb::Stroll)) && self.way_alone() {
            return Ok(Vec::new());
        }
        if let Some(clauses) = self.passenger(verb) {
            return Ok(clauses);
        }
        match verb {
            Verb::Go if self.word_before() == "yourself" && self.peeks("on") => self.sit(),
            Verb::Go | Verb::Run if self.moves_thing(start) => self.drop(Manner::Deliver),
            Verb::Go => self.go(Pace::Usual, start),
            Verb::Run => self.go(Pace::Run, start),
            Verb::Stroll => self.go(Pace::Slow, start),
            Verb::Cross if self.leads_across() => self.go(Pace::Usual, start),
            Verb::Shuttle => {
                self.eat_any(&["back and forth", "to and fro", "up and down", "backwards and forwards"]);
                self.eat_any(&["between", "in between", "from"]);
                self.back_and_forth(Pace::Usual)
            }
            Verb::Count => self.count_up(),
            Verb::Cross => Ok(vec![self.across_the_street()]),
            Verb::Follow => self.follow(start).map(|clause| vec![clause]),
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
            Verb::Drop => match self.throw(start) {
                Some(clause) => one(clause),
                None => self.drop(Manner::DropOff),
            },
            Verb::PutDown => self.drop(Manner::PutDown),
            Verb::Buy => self.buy(),
            Verb::Sit if self.lies(start) => {
                Err(self.not_understood("people sit and do not lie: say sit down"))
            }
            Verb::Sit => self.sit(),
            Verb::StandUp if self.is_place() => self.go(Pace::Usual, start),
            Verb::StandUp => {
                self.tail_place(&["from"])?; // from which seat is no choice
                one(Clause::StandUp)
            }
            _ => self.deed(verb, start),
        }
    }

    /// The objects of verbs of the body, of vehicles, of speech and of speed.
    fn deed(&mut self, verb: Verb, start: usize) -> Result<Vec<Clause>, PlanError> {
        let one = |clause| Ok(vec![clause]);
        match verb {
            Verb::Crouch => one(Clause::Crouch),
            Verb::Stop => self.stop(),
            Verb::Park => self.park(),
            Verb::Pass => self.past(Pace::Usual),
            Verb::Circle => self.round(Pace::Usual),
            Verb::Wait => self.wait(),
            Verb::Board => self.board(),
            Verb::Drive => self.drive(),
            Verb::Alight => Ok(self.alight_at()),
            Verb::Step => self.step().map(|step| vec![step]),
            Verb::Reverse => self.reverse().map(|step| vec![step]),
            Verb::Turn => self.turn_somewhere(),
            Verb::Look => self.look().map(|look| vec![look]),
            Verb::Face => self.face().map(|face| vec![face]),
            Verb::Point => self.point_out().map(|clause| vec![clause]),
            Verb::Wave => self.wave().map(|clause| vec![clause]),
            Verb::Talk | Verb::Greet | Verb::Say | Verb::Tell | Verb::Argue => self.speak(verb),
            Verb::Open | Verb::Close => self.door(verb == Verb::Open).map(|clause| vec![clause]),
            Verb::Photo => self.photos(start),
            Verb::Faster | Verb::Slower if self.eat_any(&["to"]) => {
                one(Clause::Speed { speed: self.speed()? })
            }
            Verb::Faster => one(Clause::Speed { speed: 2.0 }),
            Verb::Slower => one(Clause::Speed { speed: super::draft::STROLLING }),
            Verb::SetSpeed
                if fits(&self.lexemes[start..], "stay at").is_some()
                    && numbers::number(self.rest()).is_none() =>
            {
                let to = self.reference(0)?;
                one(Clause::Go { to, side: None, pace: Pace::Usual, within: None })
            }
            Verb::SetSpeed => {
                let speed = self.speed()?;
                if longest_phrase(self.rest(), &["to", "towards", "over to"]).is_some() {
                    return self.go(Pace::At(speed), start);
                }
                one(Clause::Speed { speed })
            }
            _ => Err(self.not_understood(UNDERSTOOD)),
        }
    }

    /// "Cross the road to the other side at the crossing".
    fn across_the_street(&mut self) -> Clause {
        self.eat_any(&["the", "this", "over"]);
        self.eat_any(&["road", "street", "crossing", "crosswalk", "zebra crossing", "road here"]);
        self.eat_any(&["to the other side", "over", "at the crossing", "at the crosswalk"]);
        self.eat_any(&["of the street", "of the road", "of the crossing"]);
        Clause::Cross
    }

    /// "Follow me", "stay close to the statue".
    fn follow(&mut self, start: usize) -> Result<Clause, PlanError> {
        if let Some(speaker) = self.view.speaker.filter(|_| self.ends_clause()) {
            let whom = Reference::to(Target::Id(speaker), "me".to_owned());
            return Ok(Clause::Follow { whom, pace: Pace::Usual });
        }
        let whom = self.reference(0)?;
        // "Accompany Nora to the café".
        if self.is_somebody(&whom) && self.eat_any(BRINGS) {
            let test =
                super::clause::Test::Near { what: self.reference(0)?, within: super::tests_of::NEXT_TO_ME };
            return Ok(Clause::Until { test, body: vec![Clause::Follow { whom, pace: Pace::Usual }] });
        }
        // "Stay close to the statue" is about staying.
        let stays = ["stay", "keep", "stick", "remain"]
            .iter()
            .any(|word| fits(&self.lexemes[start..], word).is_some());
        if stays && !self.moves_about(&whom) {
            return Ok(Clause::Go { to: whom, side: None, pace: Pace::Usual, within: None });
        }
        self.eat_any(&[
            "around",
            "about",
            "everywhere",
            "wherever they go",
            "goes",
            "walks",
            "moves",
            "is going",
            "may go",
            "might go",
            "wherever he goes",
            "wherever she goes",
            "wherever it goes",
            "as she walks",
            "as he walks",
            "as it walks",
            "wherever he may go",
            "wherever she may go",
            "on foot",
            "at a distance",
            "from a distance",
            "closely",
            "keeping your distance",
            "as closely as you can",
            "where he goes",
            "where she goes",
        ]);
        Ok(Clause::Follow { whom, pace: self.pace(Pace::Usual)? })
    }

    /// Whether who is no dog is told to lie down.
    fn lies(&self, start: usize) -> bool {
        let dog = self
            .view
            .scene
            .entity(self.view.who)
            .is_some_and(|me| me.kind == simworld_core::scene::EntityKind::Dog);
        !dog && ["lie", "lie down"].iter().any(|words| fits(&self.lexemes[start..self.at], words).is_some())
    }

    /// "Open the door for me", "close it behind you".
    fn door(&mut self, open: bool) -> Result<Clause, PlanError> {
        let what = if self.ends_clause() { None } else { Some(self.reference(0)?) };
        let what = what.map(Reference::but_behind);
        self.eat_any(&["up", "for me", "again", "behind you"]);
        self.skip_onlookers(&["for"]);
        Ok(Clause::Door { what, open })
    }

    /// "Take two photos of the fountain".
    fn photos(&mut self, start: usize) -> Result<Vec<Clause>, PlanError> {
        let times = self.number_of_photos();
        let alone = longest_verb(&self.lexemes[start..]).is_some_and(|(_, words)| words == 1);
        let shoots = alone && fits(&self.lexemes[start..self.at], "shoot").is_some();
        if shoots && times == 0 {
            return Err(self.not_understood("say what to take a photo of"));
        }
        let times = times.max(1);
        self.photo(times)
    }

    /// "Stand behind the statue", "stand halfway between": where to stand, and not to get up.
    fn is_place(&self) -> bool {
        #[rustfmt::skip]
        const PLACES: &Phrases = &Phrases::of(&[
            "at", "on the", "in the", "by", "between", "in between", "halfway", "midway", "half way", "north",
            "south", "east", "west", "to the north", "to the south", "to the east", "to the west",
        ]);
        let exactly =
            longest_phrase(self.rest(), &["exactly", "precisely", "directly", "just", "right"]).unwrap_or(0);
        longest_relation(self.rest()).is_some()
            || longest_phrase(self.rest(), PLACES).is_some()
            || exactly > 0
                && longest_phrase(&self.rest()[exactly..], &["between", "in between", "at", "on", "in"])
                    .is_some()
            || self.peeks_halfway()
            || numbers::walked(self.rest()).is_some()
    }

    /// A place after one of these words.
    pub(super) fn tail_place<L: PhraseList + ?Sized>(
        &mut self,
        words: &L,
    ) -> Result<Option<Reference>, PlanError> {
        let side = longest_relation(self.rest()).map(|(_, count)| count);
        match longest_phrase(self.rest(), words).max(side) {
            // "... to get to the clinic" says what for.
            Some(count)
                if longest_verb(&self.rest()[count..]).is_some()
                    && category(&self.rest()[count..]).is_none() =>
            {
                Ok(None)
            }
            Some(count) => {
                self.at += count;
                self.reference(0).map(Some)
            }
            None => Ok(None),
        }
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

fn is_company(lexeme: &Lexeme) -> bool {
    matches!(&lexeme.token, Token::Word(word) if word == "company")
}

/// Whether a verb is about something.
const fn has_objects(verb: Verb) -> bool {
    !matches!(
        verb,
        Verb::StandUp
            | Verb::Crouch
            | Verb::Stop
            | Verb::Wait
            | Verb::Count
            | Verb::Faster
            | Verb::Slower
            | Verb::Alight
    )
}
