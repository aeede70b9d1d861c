//! Orders without a verb: "a coffee, please", "two waves for Ben", "next left", "twenty metres straight ahead".

use simworld_core::net::Turn;
use simworld_core::seam::PlanError;

use super::clause::{Clause, Lights, Pace, Target};
use super::lexer::{Lexeme, Token};
use super::lexicon::longest_phrase;
use super::motion::LENGTHS;
use super::numbers;
use super::orders::PHOTOS;
use super::parser::Parser;
use super::phrases::Phrases;
use super::verbs::Verb;

const WAVES: &[&str] =
    &["waves", "wave", "big wave", "friendly wave", "wave of the hand", "waves of the hand"];
/// On which side one turns, without a verb.
#[rustfmt::skip]
const TURNS: &[(&[&str], Turn)] = &[
    (&["left", "a left", "left turn", "turning on the left", "on the left", "street on the left",
    "road on the left", "left turning"], Turn::Left),
    (&["right", "a right", "right turn", "turning on the right", "on the right", "street on the right",
    "road on the right", "right turning"], Turn::Right),
    (&["straight", "straight on", "straight ahead", "straight over", "straight across", "straight through"],
    Turn::Straight),
];

/// How welcome something would be, behind it.
const WELCOME: &Phrases = &Phrases::of(&[
    "would be nice",
    "would be great",
    "would be good",
    "would be lovely",
    "would be wonderful",
    "would be perfect",
    "would be just the thing",
    "would do me good",
    "sounds good",
    "sounds great",
    "sounds nice",
    "would be awesome",
    "would be much appreciated",
    "would be appreciated",
    "would be handy",
    "would help",
    "wouldnt go amiss",
    "would not go amiss",
    "wouldnt hurt",
    "wouldnt be bad",
]);
/// When nobody is told to get it now.
const NOT_NOW: &Phrases = &Phrases::of(&[
    "later",
    "later on",
    "tomorrow",
    "tonight",
    "next week",
    "one day",
    "some day",
    "soon",
    "afterwards",
    "this evening",
    "this afternoon",
    "for later",
]);
/// Before goods that somebody would have.
#[rustfmt::skip]
const WISHES: &Phrases = &Phrases::of(&[
    "i want", "have", "lets have", "let us have", "i would like to have", "id like to have", "i want to have", "id love to have", "i would love",
    "i would love to have", "i would like to get", "id like to get", "i want to get", "we would like", "wed like", "we want", "we could do with",
    "i could use", "we could use", "id like", "i would like", "id love", "i need", "i could do with", "i fancy", "how about", "what about", "we need",
    "any chance of", "is there any chance of", "i could murder", "i could kill for", "i am dying for", "im dying for", "i am gasping for",
    "can i have", "could i have", "may i have", "can i get", "could i get", "can we have", "could we have", "i would rather have", "id rather have",
    "id need", "i would need", "ill have", "i will have", "well have", "we will have", "ill take", "i will take", "id kill for", "i would kill for",
    "id murder", "i feel like", "i could go for", "i could eat", "i could drink", "im in the mood for", "i am in the mood for",
    "were in the mood for", "we are in the mood for", "what i want is", "what i need is", "what id like is", "what we need is", "make it",
    "make that", "might i trouble you for", "may i trouble you for", "could i trouble you for", "can i trouble you for", "trouble you for",
    "could i bother you for", "can i bother you for", "its time for", "it is time for", "time for", "i was hoping for", "im looking for",
    "i am looking for", "were looking for",
]);
/// Reads one kind of such orders; nothing where it is none.
type Rule<'a> = fn(&mut Parser<'a>) -> Result<Option<Vec<Clause>>, PlanError>;

impl Parser<'_> {
    /// Whether what stands there is an order in nouns: "a coffee, please".
    pub(super) fn may_be_nominal(&mut self, start: usize) -> bool {
        self.at = start;
        let nominal = matches!(self.nominal(), Ok(Some(_)));
        self.at = start;
        nominal
    }

    /// An order in nouns alone.
    pub(super) fn nominal(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        let start = self.at;
        self.skip_fillers();
        let rules: [Rule<'_>; 7] = [
            Self::counted_deeds,
            |parser| Ok(parser.turning()),
            Self::measured_way,
            |parser| Ok(parser.up_and_down()),
            Self::rounds,
            Self::wanted_goods,
            Self::destination,
        ];
        for rule in rules {
            let at = self.at;
            if let Some(clauses) = rule(self)? {
                return Ok(Some(clauses));
            }
            self.at = at;
        }
        self.at = start;
        Ok(None)
    }

    /// "Two waves for Ben", "a photo of the statue", and "one for Anna" after either.
    pub(super) fn counted_deeds(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        self.eat_any(&[
            "give me",
            "i want",
            "id like",
            "i would like",
            "id love",
            "i need",
            "lets have",
            "how about",
            "what about",
        ]);
        let number = numbers::number(self.rest())
            .filter(|(number, _)| (1.0..=100.0).contains(number) && number.fract() == 0.0);
        let Some((number, words)) = number else { return Ok(None) };
        self.at += words;
        let times = number as u32;
        self.eat_any(&["more", "nice", "quick", "good", "another"]);
        let waves = self.eat_any(WAVES);
        let photos = !waves && self.eat_any(PHOTOS);
        let again = !waves
            && !photos
            && longest_phrase(self.rest(), &["of", "for", "at", "to", "more of", "more for"]).is_some();
        if waves || again && self.verb == Some(Verb::Wave) {
            self.verb = Some(Verb::Wave);
            if !self.eat_any(&["for", "at", "to", "towards", "more for"]) {
                return Ok(None);
            }
            let wave = Clause::Wave { to: self.reference(0)? };
            return Ok(Some(vec![if times == 1 {
                wave
            } else {
                Clause::Repeat { times, body: vec![wave] }
            }]));
        }
        if photos || again && self.verb == Some(Verb::Photo) {
            (self.verb, self.beside.shots) = (Some(Verb::Photo), true);
            let of = if self.eat_any(&["of", "more of"]) { Some(self.reference(0)?) } else { None };
            return Ok(Some(vec![Clause::Photo { of, times }]));
        }
        Ok(None)
    }

    /// "Next left", "left at the lights", "straight over the crossing after it".
    fn turning(&mut self) -> Option<Vec<Clause>> {
        let another = self.eat_any(&["another", "one more"]);
        self.eat_any(&["the", "a", "then"]);
        let nth = if self.eat_any(&["next", "very next"]) { Some(1) } else { numbers::ordinal(self.rest()) };
        self.at += usize::from(numbers::ordinal(self.rest()).is_some());
        self.eat_any(&["turning", "turn", "street", "road"]);
        let (turn, words) = super::lexicon::longest(self.rest(), TURNS)?;
        self.at += words;
        self.eat_any(&["again", "turn"]);
        if let Some((nth, lights)) = self.junction_passed().or_else(|| self.junction()) {
            return Some(vec![Clause::TurnAt { turn, nth, lights }]);
        }
        if !self.ends_clause() || turn == Turn::Straight && nth.is_none() {
            return None;
        }
        let drives = self.view.scene.entity(self.view.who).is_some_and(|me| me.kind.is_vehicle());
        // Who walks and says "left" turns where it stands; who drives takes the next street.
        let nth = nth.or((another || drives && matches!(turn, Turn::Left | Turn::Right)).then_some(1))?;
        Some(vec![Clause::TurnAt { turn, nth, lights: Lights::Any }])
    }

    /// "Over the crossing after it", "across the junction": which junction is passed straight on.
    pub(super) fn junction_passed(&mut self) -> Option<(u32, Lights)> {
        let start = self.at;
        self.eat_any(&["on", "ahead"]);
        let said = self.at > 0
            && matches!(&self.lexemes[self.at - 1].token, Token::Word(word) if ["over", "across", "through"].contains(&word.as_str()));
        let over = self.eat_any(&["over", "across", "through", "past"]) || said;
        let next = &[
            "it",
            "the crossing after it",
            "the junction after it",
            "the next one",
            "the one after it",
            "the crossing after that",
            "the junction after that",
            "the next crossing",
            "the next junction",
            "the crossing",
            "the junction",
            "the crossroads",
            "the intersection",
            "the next intersection",
            "the next crossroads",
            "that",
            "that one",
            "the lights",
            "the light",
            "the traffic lights",
            "the traffic light",
            "the next lights",
            "the green light",
            "the signal",
            "the signals",
        ];
        if over && self.eat_any(next) && self.ends_clause() {
            return Some((1, Lights::Any));
        }
        self.at = start;
        None
    }

    /// "Twenty metres straight ahead", "a quarter turn to the left", "three steps back".
    fn measured_way(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        let is_turn = numbers::angle(self.rest()).is_some_and(|(_, words)| words > 1)
            && numbers::walked(self.rest()).is_none();
        if is_turn && !matches!(self.rest().first(), Some(Lexeme { token: Token::Number(_), .. })) {
            let start = self.at;
            if let Ok(turn) = self.turn() {
                return Ok(Some(vec![turn]));
            }
            self.at = start; // "a dozen balloons" is no angle
            return Ok(None);
        }
        if self.peeks("for") && numbers::walked(&self.rest()[1..]).is_some() {
            self.at += 1; // "turn right and go on for five metres"
        }
        if numbers::walked(self.rest()).is_none() {
            return Ok(None);
        }
        if let Some(clauses) = self.by_the_compass(Pace::Usual)? {
            return Ok(Some(clauses));
        }
        let start = self.at;
        let step = self.step()?;
        let on = start > 0
            && self.word_before_at(start) == "for"
            && matches!(self.verb, Some(Verb::Go | Verb::Turn | Verb::Step | Verb::Run));
        let said = on || self.lexemes[start..self.at].iter().any(|lexeme| {
            matches!(&lexeme.token, Token::Word(word) if ["ahead", "forward", "forwards", "left", "right", "back", "backwards", "straight", "on"].contains(&word.as_str()))
        });
        Ok(said.then(|| vec![step]))
    }

    /// "Twenty metres further east", behind who is needed there.
    pub(super) fn in_so_many_steps(&mut self) -> Option<Vec<Clause>> {
        self.measured_way().ok().flatten().filter(|_| self.ends_clause())
    }

    /// "Once around the block".
    fn rounds(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        let Some((times, words)) = numbers::times(self.rest()) else { return Ok(None) };
        self.at += words;
        if !self.eat_any(&["around", "round", "all around", "all round"]) {
            return Ok(None);
        }
        let body = self.round(Pace::Usual)?;
        Ok(Some(if times == 1 { body } else { vec![Clause::Repeat { times, body }] }))
    }

    /// "Down and up again": to sit and to stand.
    fn up_and_down(&mut self) -> Option<Vec<Clause>> {
        let clause = if self.eat_any(&["down", "down again", "back down"]) {
            Clause::Sit { on: None }
        } else if self.eat_any(&["up", "up again", "back up", "on your feet"]) {
            Clause::StandUp
        } else {
            return None;
        };
        self.ends_clause().then(|| vec![clause])
    }

    /// "A coffee, please", "soup from the Blue Spoon first".
    fn wanted_goods(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        let wished = self.eat_any(WISHES);
        let Some(goods) = self.goods() else { return Ok(None) };
        if self.mark() == Some('?') && self.rest().len() > 1 {
            return Ok(None); // "what about a coffee? go and buy one"
        }
        // "I need some soap later, so walk to the pharmacy".
        if wished && self.eat_any(NOT_NOW) {
            if !self.ends_at_mark() || !self.skip_joints() || self.at >= self.lexemes.len() {
                return Ok(None);
            }
            return Ok(self.statement_here());
        }
        let welcome = self.eat_any(WELCOME);
        if (wished || welcome) && self.orders_what_is_wished() {
            // "We need two pretzels, please buy them".
            let whom = self.for_whom();
            let mark = self.mark_from(self.at);
            (self.wished_by, self.wanted, self.wished, self.at) = (whom, Some(goods), true, mark);
            self.skip_joints();
            return Ok(self.statement_here());
        }
        let clauses = self.purchase(goods, None)?;
        self.eat_any(WELCOME);
        Ok(self.ends_clause().then_some(clauses))
    }

    /// "The hospital, please": a building, or where one was going before.
    fn destination(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        let told = self.eat_any(&[
            "next stop",
            "destination",
            "the destination is",
            "your destination is",
            "the next stop is",
            "our destination is",
            "first stop",
            "last stop",
            "your next stop is",
            "your first stop is",
            "your last stop is",
            "your next destination is",
            "how about",
            "what about",
        ]);
        if matches!(self.mark(), Some(':')) {
            self.at += 1;
        }
        self.eat_any(&[
            "to",
            "over to",
            "off to",
            "on to",
            "into",
            "up to",
            "back to",
            "down to",
            "across to",
            "away to",
        ]);
        let to = self.reference(0)?;
        // "Nearest bench, please": which one is said.
        let chosen = to.choice != super::clause::Choice::Open
            && matches!(to.target, Target::Any(_) | Target::Named(_))
            && (self.at..self.lexemes.len()).all(|at| {
                longest_phrase(&self.lexemes[at..], &["please", "thanks", "pls", "thank", "you", "now"])
                    .is_some()
            });
        let told = told || chosen;
        let is_building = match &to.target {
            Target::Any(class) => class.is_place(),
            Target::Named(ids) => ids.iter().any(|id| {
                self.view
                    .scene
                    .entity(*id)
                    .is_some_and(|entity| entity.kind == simworld_core::scene::EntityKind::Building)
            }),
            _ => false,
        };
        if !is_building && !told || !self.ends_clause() {
            return Ok(None);
        }
        (self.verb, self.stated) = (Some(Verb::Go), true);
        Ok(Some(vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }]))
    }

    /// "1. ... 2. ...": the number of an item of a list.
    pub(super) fn item_mark(&self) -> usize {
        let step = usize::from(longest_phrase(self.rest(), &["step", "number", "task", "item"]).is_some());
        match &self.rest()[step..] {
            [
                Lexeme { token: Token::Number(number), .. },
                Lexeme { token: Token::Break | Token::Close, .. },
                ..,
            ] if number.fract() == 0.0 && (1.0..20.0).contains(number) => step + 2,
            _ => 0,
        }
    }

    /// "Second stall on the right" is no second order.
    pub(super) fn counts_a_thing(&self) -> bool {
        let is_second = ["second", "fourth"].iter().any(|word| self.peeks(word));
        let noun = self.rest().get(1..).unwrap_or_default();
        is_second
            && (super::lexicon::category(noun).is_some()
                || noun.first().is_some_and(|first| self.names.sort(&first.token).is_some()))
    }

    /// "Step two metres to the left" is no second step of a list.
    pub(super) fn counts_a_step(&self) -> bool {
        let measured = self.rest().get(1..).filter(|_| self.peeks("step"));
        if measured.is_some_and(|after| numbers::walked(after).is_some()) {
            return true; // "step one metre and a half"
        }
        let number = measured.and_then(numbers::number);
        number.is_some_and(|(_, count)| {
            let after = &self.rest()[1 + count..];
            longest_phrase(after, LENGTHS).is_some()
                || longest_phrase(after, &["to the", "forward", "back"]).is_some()
        })
    }
}
