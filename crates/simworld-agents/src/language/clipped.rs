//! Orders cut short, as on a parade ground or on the telephone: "left turn", "forward ten", "parcel up", "a pause of three
//! seconds", "from the shop to the clinic and back", "full speed to the bus stop", "rain: the museum".

use std::f64::consts::{FRAC_PI_2, PI};

use simworld_core::action::StepDirection;

use super::clause::{Clause, Grip, Manner, Pace, Reference, Target, Test};
use super::lexer::Token;
use super::numbers;
use super::parser::Parser;
use super::phrases::Phrases;
use super::verbs::longest_verb;

/// What leads to a place.
const TO: &Phrases = &Phrases::of(&[
    "to",
    "over to",
    "on to",
    "across to",
    "back to",
    "up to",
    "down to",
    "for",
    "towards",
    "straight to",
    "right to",
]);
/// How fast, before where to.
#[rustfmt::skip]
const FAST: &Phrases = &Phrases::of(&[
    "full speed", "max speed", "maximum speed", "top speed", "at full speed", "at top speed", "at max speed",
    "on the double", "at the double", "double time", "double quick", "quickly", "fast", "in a hurry", "flat out",
    "full steam ahead", "full tilt", "at a run", "quick as you can", "as fast as you can", "full speed ahead",
]);
const SLOW: &Phrases = &Phrases::of(&[
    "slowly",
    "slow",
    "nice and slowly",
    "dead slow",
    "gently",
    "slowly now",
    "at a stroll",
    "in slow motion",
    "slow and steady",
]);

impl Parser<'_> {
    /// An order cut short.
    pub(super) fn clipped(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        for rule in [
            Self::drilled,
            Self::forward_so_far,
            Self::bare_wait,
            Self::between_two,
            Self::there_and_back,
            Self::paced_to,
            Self::lifted,
            Self::headed_by_weather,
            Self::on_a_signal,
            Self::shuttle_runs,
        ] {
            if let Some(clauses) = rule(self) {
                return Some(clauses);
            }
            self.at = start;
        }
        None
    }

    pub(super) fn walks(&self) -> bool {
        self.view.scene.entity(self.view.who).is_some_and(|me| !me.kind.is_vehicle())
    }

    /// "Left turn", "about face", "a quarter turn right", "forty degrees left".
    fn drilled(&mut self) -> Option<Vec<Clause>> {
        if !self.walks() {
            return None;
        }
        self.eat_any(&["a", "now", "and", "another", "one more", "hard"]);
        if self.eat_any(&["about turn", "about face", "turn about", "right about face", "right about turn"]) {
            return self.ends_clause().then(|| vec![Clause::Turn { angle: PI }]);
        }
        let mut angle = FRAC_PI_2;
        let start = self.at;
        let said = numbers::angle(self.rest()).filter(|(said, words)| {
            let unit = self.lexemes.get(self.at + words - 1).map(|lexeme| &lexeme.token);
            let turns = matches!(unit, Some(Token::Word(word)) if ["turn", "circle", "degrees", "degree", "deg", "rotation"].contains(&word.as_str()));
            (turns || self.previous_turned()) && *said > 0.0 && *said <= 2.0 * PI
        });
        if let Some((said, words)) = said {
            angle = said;
            self.at += words;
        }
        self.eat_any(&["to", "to the", "to your", "on the"]);
        let left = self.eat_any(&["left", "to the left", "anticlockwise", "counterclockwise"]);
        let right = !left && self.eat_any(&["right", "to the right", "clockwise"]);
        if !left && !right {
            let half = said.is_some_and(|(said, _)| (said - PI).abs() < 1e-9);
            let same = said.is_some() && self.previous_turned() && self.ends_clause();
            if half && self.ends_clause() {
                return Some(vec![Clause::Turn { angle: PI }]);
            }
            // "Turn ninety degrees to the right, now another forty-five".
            let sign = self.turned.filter(|_| same)?;
            return Some(vec![Clause::Turn { angle: angle * sign }]);
        }
        let turned = self.eat_any(&["turn", "face", "wheel", "turn now", "hand turn", "about"]);
        self.eat_any(&["this time", "again"]);
        let means_turn = turned || said.is_some() || start > 0 && self.previous_turned();
        if !means_turn || !self.ends_clause() {
            return None;
        }
        let angle = if left { angle } else { -angle };
        self.turned = Some(angle.signum());
        self.verb = Some(super::verbs::Verb::Turn);
        Some(vec![Clause::Turn { angle }])
    }

    /// Whether the order before was a turn.
    fn previous_turned(&self) -> bool {
        self.verb == Some(super::verbs::Verb::Turn)
    }

    /// "Forward ten", "ahead fifteen metres", "forward march, ten metres", "astern three metres", "onward".
    fn forward_so_far(&mut self) -> Option<Vec<Clause>> {
        if !self.walks() {
            return None;
        }
        let back = self.eat_any(&["astern", "backward", "backwards", "back"]);
        let ahead = !back
            && self.eat_any(&[
                "forward",
                "forwards",
                "ahead",
                "straight ahead",
                "straight on",
                "onward",
                "onwards",
                "straight forward",
            ]);
        if !back && !ahead {
            return None;
        }
        self.eat_any(&["march", "by", "for", "go"]);
        self.at += usize::from(
            matches!(self.mark(), Some(','))
                && numbers::walked(self.rest().get(1..).unwrap_or_default()).is_some(),
        );
        let (distance, words) = numbers::walked(self.rest()).or_else(|| numbers::number(self.rest()))?;
        self.at += words;
        if !(self.ends_clause() && distance > 0.0 && distance <= 10_000.0) {
            return None;
        }
        let direction = if back { StepDirection::Backward } else { StepDirection::Forward };
        Some(vec![if distance > 10.0 {
            Clause::Walk { course: super::clause::Course::Relative(direction), distance, pace: Pace::Usual }
        } else {
            Clause::Step { direction, distance }
        }])
    }

    /// "A pause of three seconds", "half a minute there", "nothing for a minute", "ten seconds' rest".
    fn bare_wait(&mut self) -> Option<Vec<Clause>> {
        self.eat_any(&["then", "now", "and"]);
        let named = self.eat_any(&[
            "a pause of",
            "a break of",
            "a rest of",
            "a wait of",
            "pause of",
            "break of",
            "a little rest of",
            "a short rest of",
            "a little pause of",
            "a short pause of",
            "a short break of",
            "a pause for",
            "a break for",
            "a rest for",
            "rest of",
            "silence for",
            "nothing for",
            "no moving for",
            "another",
            "a halt of",
            "a stop of",
            "a breather of",
            "time out for",
        ]);
        let (seconds, words) = numbers::duration(self.rest())
            .filter(|(seconds, words)| *seconds > 0.0 && (*words > 1 || named))?;
        self.at += words;
        self.eat_any(&[
            "rest",
            "pause",
            "break",
            "wait",
            "of rest",
            "of waiting",
            "of silence",
            "stop",
            "halt",
            "waiting",
            "standing still",
            "of standing still",
            "of doing nothing",
        ]);
        self.eat_any(&["there", "here", "where you are", "on the spot", "at that spot"]);
        let waits = self.ends_clause() && numbers::times(self.rest()).is_none();
        (waits && seconds <= super::staying::LONGEST_WAIT).then(|| vec![Clause::Wait { seconds }])
    }

    /// "From the café to the bakery and back".
    fn between_two(&mut self) -> Option<Vec<Clause>> {
        if !self.eat_any(&["from"]) {
            return None;
        }
        let one = self.reference(0).ok()?;
        if !self.eat_any(&["to", "over to", "on to", "straight to"]) {
            return None;
        }
        let other = self.reference(0).ok()?;
        let mut body = vec![going(one.clone()), going(other)];
        if self.eat_any(&["and back", "and back again", "and back to it", "and then back", "then back"]) {
            body.push(going(one));
        }
        self.ends_clause().then_some(vec![Clause::Repeat { times: 1, body }])
    }

    /// "To the cone and back".
    fn there_and_back(&mut self) -> Option<Vec<Clause>> {
        if !self.eat_any(TO) {
            return None;
        }
        let to = self.reference(0).ok()?;
        let back = self.eat_any(&["and back", "and back again", "and back here", "and return"]);
        (back && self.ends_clause()).then(|| {
            let here = Reference::to(Target::Here, "back".to_owned());
            vec![Clause::Repeat { times: 1, body: vec![going(to), going(here)] }]
        })
    }

    /// "Full speed to the bus stop", "slowly to Anna".
    fn paced_to(&mut self) -> Option<Vec<Clause>> {
        self.eat_any(&["a", "at a"]);
        let pace = if self.eat_any(FAST) {
            Pace::Run
        } else if self.eat_any(SLOW)
            || self.eat_any(&[
                "slow walk",
                "gentle stroll",
                "slow stroll",
                "leisurely walk",
                "stroll",
                "walk",
            ])
        {
            Pace::Slow
        } else {
            Pace::At(self.speed().ok().filter(|_| self.said_unit())?)
        };
        self.at += usize::from(matches!(self.mark(), Some(',')));
        self.eat_any(&["now", "then", "please", "home"]);
        if !self.eat_any(TO) {
            return None;
        }
        let to = self.reference(0).ok()?;
        self.verb = Some(super::verbs::Verb::Go);
        self.ends_clause().then(|| vec![Clause::Go { to, side: None, pace, within: None }])
    }

    /// "Parcel up", "crate off the ground", "parcel down".
    fn lifted(&mut self) -> Option<Vec<Clause>> {
        if longest_verb(self.rest()).is_some() {
            return None;
        }
        let what = self.reference(0).ok()?;
        let up = self.eat_any(&[
            "up",
            "off the ground",
            "off the floor",
            "in hand",
            "into your hands",
            "in your arms",
            "on your shoulder",
        ]);
        let down =
            !up && self.eat_any(&["down", "back down", "on the ground", "on the floor", "out of your hands"]);
        if !(up || down) || !self.ends_clause() {
            return None;
        }
        Some(vec![if up {
            Clause::Take { what, to: None, grip: Grip::Lift }
        } else {
            Clause::Drop { what: Some(what), at: None, manner: Manner::PutDown }
        }])
    }

    /// "Rain: the museum. Dry: the chair by the table."
    fn headed_by_weather(&mut self) -> Option<Vec<Clause>> {
        let test = self.weather_head()?;
        self.skip_joints();
        let then = self.statement().ok()?;
        let start = self.at;
        self.skip_joints();
        let otherwise = match self.weather_head() {
            Some(Test::Not(other)) if *other == test => self.after_head(),
            Some(other) if Test::Not(Box::new(other.clone())) == test => self.after_head(),
            _ => None,
        };
        if otherwise.is_none() {
            self.at = start;
        }
        Some(vec![Clause::If { test, then, otherwise: otherwise.unwrap_or_default() }])
    }

    fn after_head(&mut self) -> Option<Vec<Clause>> {
        self.skip_joints();
        self.statement().ok()
    }

    /// "Rain:", "dry:", "raining?".
    fn weather_head(&mut self) -> Option<Test> {
        let start = self.at;
        let test = if self.eat_any(&[
            "rain",
            "raining",
            "wet",
            "in rain",
            "rainy",
            "if wet",
            "weather wet",
            "weather turning wet",
        ]) {
            Some(Test::Raining)
        } else if self.eat_any(&["dry", "no rain", "not raining", "if dry"]) {
            Some(Test::Not(Box::new(Test::Raining)))
        } else if self.eat_any(&["dark", "night", "by night", "dark already"]) {
            Some(Test::Dark)
        } else if self.eat_any(&["light", "day", "by day", "daylight", "not dark"]) {
            Some(Test::Not(Box::new(Test::Dark)))
        } else if self.eat_any(&["snow", "snowing"]) {
            Some(Test::Snowing)
        } else {
            None
        };
        let marked = matches!(self.mark(), Some(':' | '?'));
        if test.is_none() || !marked {
            self.at = start;
            return None;
        }
        test
    }

    /// "On green, run to the bench", "at nightfall": when that is so.
    fn on_a_signal(&mut self) -> Option<Vec<Clause>> {
        use simworld_core::net::Aspect;
        let test = if self.eat_any(&[
            "on green",
            "at green",
            "on the green light",
            "at the green light",
            "green light",
            "when green",
        ]) {
            Test::Light { light: None, shows: Aspect::Green }
        } else if self.eat_any(&["on red", "at red", "on the red light"]) {
            Test::Light { light: None, shows: Aspect::Red }
        } else {
            let seen = self.eat_any(&[
                "on seeing",
                "on sighting",
                "on spotting",
                "on detecting",
                "upon seeing",
                "upon sighting",
                "upon spotting",
                "upon detecting",
                "at the sight of",
                "on sight of",
            ]);
            let not = !seen && self.eat_any(&["on not seeing", "not seeing", "not finding"]);
            if !seen && !not {
                return None;
            }
            let what = self.reference(0).ok()?;
            if not { Test::Not(Box::new(Test::Sees(what))) } else { Test::Sees(what) }
        };
        if !self.skip_joints() && longest_verb(self.rest()).is_none() {
            return None;
        }
        let mut clauses = vec![Clause::Until { test, body: Vec::new() }];
        clauses.extend(self.statement().ok()?);
        Some(clauses)
    }

    /// "Ten shuttle runs between the sign and the bench", "two rounds between them".
    fn shuttle_runs(&mut self) -> Option<Vec<Clause>> {
        self.eat_any(&["do", "run", "walk", "make", "give me", "go"]);
        let (number, words) = numbers::number(self.rest())?;
        if !(1.0..=100.0).contains(&number) || number.fract() != 0.0 {
            return None;
        }
        self.at += words;
        let run = self.eat_any(&[
            "shuttle runs",
            "shuttle run",
            "shuttles",
            "rounds",
            "round",
            "trips",
            "trip",
            "laps",
            "lap",
            "runs",
            "lengths",
            "walks",
            "journeys",
            "round trips",
            "times",
        ]);
        if run && self.eat_any(&["to"]) {
            let to = self.reference(0).ok()?;
            let times = number as u32;
            return self.ends_clause().then(|| vec![Clause::Repeat { times, body: vec![going(to)] }]);
        }
        if !(run && self.eat_any(&["between", "from", "back and forth between"])) {
            return None;
        }
        let body = self.back_and_forth(Pace::Usual).ok()?;
        Some(match (&body[..], number as u32) {
            ([Clause::Repeat { times: 1, body }], times) if times > 1 => {
                vec![Clause::Repeat { times, body: body.clone() }]
            }
            _ => body,
        })
    }
}

fn going(to: Reference) -> Clause {
    Clause::Go { to, side: None, pace: Pace::Usual, within: None }
}
