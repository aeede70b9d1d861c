//! Tokens to orders: how the orders of a sentence hang together.
//!
//! ```text
//! sentence  = statement { joint statement }
//! joint     = "," | "." | ";" | "and" | "then" | "next" | "after that" | ...
//! statement = "if" test group ["otherwise" group] | "when" test order | "until" test group | "keep" order
//!           | "repeat" number "times" group | "before" order "," order | order { tail }
//! group     = statement { "and" statement }
//! tail      = number "times" | "until" test | "while" test | "for" time | "if" test | "unless" test | "when" test
//!           | "before" order | "after" order
//! order     = a verb with its objects (see `orders`); without a verb, that of the order before ("then to the museum")
//! ```

use simworld_core::action::StepDirection;
use simworld_core::id::EntityId;
use simworld_core::seam::PlanError;

use super::clause::{Clause, Pace, Test};
use super::lexer::{Lexeme, Token};
use super::lexicon::{Category, fits, longest_phrase};
use super::motion::LENGTHS;
use super::names::Names;
use super::numbers;
use super::politeness::{FILLERS, JOINTS, NEGATIONS};
use super::requests;
use super::resolve::View;
use super::tails::{ON_THE_WAY, over_and_over};
use super::verbs::{Verb, longest_verb};

/// What is understood, in one line, for answers.
pub(super) const UNDERSTOOD: &str = "say go to, follow, look at, pick up, drop off, put down, give, buy, sit down, stand up, \
     stop, wait, ride, drive to, get off, open, step, turn, wave at, point at, talk to, argue with or take a photo, joined by \
     \"and\" or \"then\"";
/// How deep conditions and repetitions may nest.
const DEEPEST: u32 = 4;
/// What begins a condition.
pub(super) const IF: &[&str] = &[
    "if",
    "in case",
    "provided that",
    "provided",
    "in the event that",
    "in the event",
    "assuming",
    "assuming that",
    "supposing",
    "supposing that",
    "on condition that",
    "only if",
    "but only if",
    "if and only if",
];
/// What begins an order that goes on.
const GOES_ON: &[&str] = &[
    "keep",
    "keep on",
    "continue",
    "continue to",
    "go on",
    "carry on",
    "dont stop",
    "do not stop",
    "never stop",
    "dont quit",
];
/// Being somewhere, which one has to go to first: "once you are at the bench, sit down".
const REACHING: &[&str] = &[
    "you reach",
    "you have reached",
    "youve reached",
    "you get to",
    "you have got to",
    "you are at",
    "youre at",
    "you arrive at",
    "you have arrived at",
    "youve arrived at",
    "you come to",
    "you are next to",
    "youre next to",
    "you are beside",
    "youre beside",
    "you are near",
    "youre near",
    "you make it to",
    "reaching",
    "arriving at",
    "getting to",
];

/// Reads a sentence from left to right.
pub(super) struct Parser<'a> {
    pub(super) words: &'a str,
    pub(super) lexemes: &'a [Lexeme],
    pub(super) names: &'a Names<'a>,
    pub(super) view: &'a View<'a>,
    pub(super) at: usize,
    /// The class that was named last: what "the red one" is one of.
    pub(super) class: Option<&'static Category>,
    /// Those who bear the name that was named last, if that was after the class.
    pub(super) bearers: Option<Vec<EntityId>>,
    /// The verb of the order before, for those that leave it out.
    pub(super) verb: Option<Verb>,
    /// Whether a condition is read: then "is" says what holds and not which thing is meant.
    pub(super) in_test: bool,
    depth: u32,
}

/// How the orders of a list hang together.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Extent {
    /// To the end of the words.
    Sentence,
    /// As far as "and" reaches.
    Group,
}

impl<'a> Parser<'a> {
    pub(super) fn new(
        words: &'a str,
        lexemes: &'a [Lexeme],
        names: &'a Names<'a>,
        view: &'a View<'a>,
    ) -> Self {
        Self {
            words,
            lexemes,
            names,
            view,
            at: 0,
            class: None,
            bearers: None,
            verb: None,
            in_test: false,
            depth: 0,
        }
    }

    /// All orders of the sentence, at least one.
    pub(super) fn sentence(&mut self) -> Result<Vec<Clause>, PlanError> {
        self.skip_joints();
        if self.skip_remark() {
            self.skip_joints();
        }
        // "To the museum, then to the school" leaves the verb out.
        self.verb = longest_phrase(self.rest(), &["to", "over to", "back to", "on to"]).map(|_| Verb::Go);
        let clauses = self.orders(Extent::Sentence)?;
        if clauses.is_empty() { Err(self.not_understood(UNDERSTOOD)) } else { Ok(clauses) }
    }

    fn orders(&mut self, extent: Extent) -> Result<Vec<Clause>, PlanError> {
        let mut clauses: Vec<Clause> = Vec::new();
        let (mut whole, mut group) = (0, 0);
        while self.at < self.lexemes.len() {
            let statement = self.statement()?;
            clauses.extend(statement);
            self.tails(&mut clauses, whole, group)?;
            if extent == Extent::Group && !self.goes_on_with_and() {
                return Ok(clauses);
            }
            let start = self.at;
            self.skip_fillers();
            self.at += requests::coda(self.rest());
            self.skip_manner();
            self.skip_reason();
            let joint = self.at;
            let mut joined = self.skip_joints();
            joined = self.skip_remark() && self.skip_joints() || joined;
            if self.lexemes[joint..self.at].iter().any(|lexeme| lexeme.token == Token::Break) {
                whole = clauses.len();
            }
            let goes_on = longest_verb(self.rest()).is_some() || self.begins_block();
            if self.at < self.lexemes.len() && !joined && !goes_on {
                return Err(self.not_understood("end here, or go on with \"and\" or \"then\""));
            }
            if !self.is_and(start) {
                group = clauses.len();
            }
        }
        Ok(clauses)
    }

    /// Whether "and", and no comma nor "then", joins what follows.
    fn goes_on_with_and(&mut self) -> bool {
        let start = self.at;
        self.skip_fillers();
        let goes_on = fits(self.rest(), "and").is_some();
        if !goes_on {
            self.at = start;
        }
        goes_on
    }

    /// Whether the words from a place to here are "and" alone.
    fn is_and(&self, start: usize) -> bool {
        let joint = &self.lexemes[start..self.at];
        joint.iter().any(|lexeme| lexeme.token == Token::Word("and".to_owned()))
            && !joint.iter().any(|lexeme| matches!(&lexeme.token, Token::Word(word) if word == "then"))
            && !joint.iter().any(|lexeme| lexeme.token == Token::Break)
    }

    fn begins_block(&self) -> bool {
        const BLOCKS: &[&str] = &[
            "if",
            "unless",
            "when",
            "until",
            "keep",
            "repeat",
            "before",
            "after",
            "while",
            "every",
            "having",
            "should",
            "at the next",
            "dont stop",
        ];
        longest_phrase(self.rest(), BLOCKS).is_some()
    }

    /// One order or block, without what follows it. What is no order as it stands may be a request in other words.
    fn statement(&mut self) -> Result<Vec<Clause>, PlanError> {
        self.skip_fillers();
        let start = self.at;
        let refused = match self.plain_statement() {
            Ok(clauses) => return Ok(clauses),
            Err(refused) => refused,
        };
        for beginning in requests::beginnings(&self.lexemes[start..]) {
            self.at = start + beginning;
            if let Ok(clauses) = self.plain_statement() {
                return Ok(clauses);
            }
        }
        self.at = start;
        Err(refused)
    }

    fn plain_statement(&mut self) -> Result<Vec<Clause>, PlanError> {
        let goes_on = longest_phrase(self.rest(), GOES_ON).is_some();
        if !goes_on && longest_phrase(self.rest(), NEGATIONS).is_some() && longest_verb(self.rest()).is_none()
        {
            return Err(self.not_understood("that says what not to do: say what to do"));
        }
        if self.depth >= DEEPEST {
            return Err(self.not_understood("put at most four conditions and repetitions into one another"));
        }
        self.depth += 1;
        let block = self.block();
        self.depth -= 1;
        match block? {
            Some(clauses) => Ok(clauses),
            None => self.order(),
        }
    }

    fn block(&mut self) -> Result<Option<Vec<Clause>>, PlanError> {
        if self.eat_any(IF)
            || self.peeks("should") && longest_verb(&self.rest()[1..]).is_none() && self.eat_any(&["should"])
        {
            return self.either(false).map(Some);
        }
        if let Some((seconds, count)) = self.peek_interval() {
            self.at += count;
            self.skip_joints();
            let body = self.statement()?;
            return Ok(Some(vec![over_and_over(body, seconds)]));
        }
        if let Some(clauses) = self.at_junction()? {
            return Ok(Some(clauses));
        }
        if self.eat_any(ON_THE_WAY) {
            let to = self.reference(0)?;
            self.skip_joints();
            let mut clauses = self.statement()?;
            clauses.push(Clause::Go { to, side: None, pace: Pace::Usual, within: None });
            return Ok(Some(clauses));
        }
        if self.eat_any(&[
            "having",
            "start by",
            "begin by",
            "start off by",
            "begin with",
            "finish by",
            "end by",
            "finish off by",
            "continue by",
        ]) {
            return self.statement().map(Some);
        }
        if self.eat_any(&["unless", "if not"]) {
            return self.either(true).map(Some);
        }
        if self.eat_any(&["until", "till"]) {
            let test = self.test()?;
            self.skip_joints();
            return Ok(Some(vec![Clause::Until { test, body: self.orders(Extent::Group)? }]));
        }
        if self.eat_any(&["while", "as long as"]) {
            let test = Test::Not(Box::new(self.test()?));
            self.skip_joints();
            let start = self.at;
            if self.eat_any(&["wait", "stop", "stand still", "stay", "wait here", "stand"])
                && self.ends_clause()
            {
                return Ok(Some(vec![Clause::Until { test, body: Vec::new() }]));
            }
            self.at = start;
            return Ok(Some(vec![Clause::Until { test, body: self.orders(Extent::Group)? }]));
        }
        if self.eat_any(&[
            "when",
            "whenever",
            "once",
            "as soon as",
            "after",
            "upon",
            "the moment",
            "right after",
            "immediately after",
        ]) {
            return self.afterwards().map(Some);
        }
        if self.eat_any(&["before"]) {
            let later = self.statement()?;
            self.skip_joints();
            let mut clauses = self.statement()?;
            clauses.extend(later);
            return Ok(Some(clauses));
        }
        let start = self.at;
        if self.eat_any(GOES_ON) && !self.ends_clause() && longest_verb(self.rest()).is_some() {
            return self.keep().map(Some);
        }
        self.at = start;
        self.eat_any(&["repeat", "repeat this", "do this", "do the following", "repeat the following"]);
        if let Some((times, count)) = numbers::times(self.rest()) {
            self.at += count;
            // "Repeat three times: ..." is about all that follows.
            let colon = matches!(self.rest(), [Lexeme { token: Token::Break, .. }, ..]);
            self.skip_joints();
            let extent = if colon { Extent::Sentence } else { Extent::Group };
            return Ok(Some(vec![Clause::Repeat { times, body: self.orders(extent)? }]));
        }
        self.at = start;
        Ok(None)
    }

    /// After "if": the test, what to do, and what else.
    fn either(&mut self, negated: bool) -> Result<Vec<Clause>, PlanError> {
        let test = self.test()?;
        let test = if negated { Test::Not(Box::new(test)) } else { test };
        self.skip_joints();
        let then = self.orders(Extent::Group)?;
        let end = self.at;
        self.skip_joints();
        let mut otherwise = Vec::new();
        if self.eat_any(&["otherwise", "else", "or else", "if not", "or"]) {
            self.skip_joints();
            otherwise = self.orders(Extent::Group)?;
        } else {
            self.at = end;
        }
        Ok(vec![Clause::If { test, then, otherwise }])
    }

    /// After "when": a test to wait for, or an order that comes first.
    fn afterwards(&mut self) -> Result<Vec<Clause>, PlanError> {
        let start = self.at;
        if self.eat_any(REACHING) {
            let to = self.reference(0)?;
            self.skip_joints();
            let mut clauses = vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }];
            clauses.extend(self.statement()?);
            return Ok(clauses);
        }
        if let Ok(test) = self.test() {
            self.skip_joints();
            let mut clauses = vec![Clause::Until { test, body: Vec::new() }];
            if self.at < self.lexemes.len() {
                clauses.extend(self.statement()?);
            }
            return Ok(clauses);
        }
        self.at = start;
        self.eat_any(&["you", "you have", "youve", "you are", "you had", "having"]);
        self.statement()
    }

    /// After "keep": an order that goes on.
    fn keep(&mut self) -> Result<Vec<Clause>, PlanError> {
        let mut body = self.order()?;
        if let [Clause::Step { direction: StepDirection::Forward, .. }] = body[..] {
            body = vec![Clause::Forward];
        }
        Ok(body)
    }

    // ---- the cursor ----

    pub(super) fn rest(&self) -> &'a [Lexeme] {
        &self.lexemes[self.at..]
    }

    pub(super) fn peeks(&self, word: &str) -> bool {
        fits(self.rest(), word).is_some()
    }

    /// Passes the longest of these phrases, if one is there.
    pub(super) fn eat_any(&mut self, phrases: &[&str]) -> bool {
        let count = longest_phrase(self.rest(), phrases);
        self.at += count.unwrap_or(0);
        count.is_some()
    }

    pub(super) fn ends_clause(&self) -> bool {
        const TAILS: &[&str] = &[
            "until",
            "till",
            "if",
            "unless",
            "when",
            "while",
            "before",
            "after",
            "as soon as",
            "for",
            "because",
        ];
        matches!(self.rest().first().map(|lexeme| &lexeme.token), None | Some(Token::Comma | Token::Break))
            || [JOINTS, FILLERS, TAILS, ON_THE_WAY]
                .iter()
                .any(|words| longest_phrase(self.rest(), words).is_some())
            || numbers::times(self.rest()).is_some()
            || self.peek_interval().is_some()
            || requests::coda(self.rest()) > 0
    }

    /// Passes what joins orders, with the politeness around it; whether there was any.
    pub(super) fn skip_joints(&mut self) -> bool {
        let start = self.at;
        loop {
            self.skip_fillers();
            let mark =
                matches!(self.rest().first(), Some(l) if matches!(l.token, Token::Comma | Token::Break));
            if mark {
                self.at += 1;
            } else if self.counts_a_step() || !self.eat_any(JOINTS) {
                return self.at > start;
            }
        }
    }

    /// "Step two metres to the left" is no second step of a list.
    fn counts_a_step(&self) -> bool {
        let number = self.rest().get(1..).filter(|_| self.peeks("step")).and_then(numbers::number);
        number.is_some_and(|(_, count)| {
            let after = &self.rest()[1 + count..];
            longest_phrase(after, LENGTHS).is_some()
                || longest_phrase(after, &["to the", "forward", "back"]).is_some()
        })
    }

    /// Passes politeness, unless the words begin an order.
    pub(super) fn skip_fillers(&mut self) {
        while let Some(count) = longest_phrase(self.rest(), FILLERS) {
            if longest_verb(self.rest()).is_some_and(|(_, words)| words >= count) {
                return;
            }
            self.at += count;
        }
    }

    /// The answer when the words from here on make no sense.
    pub(super) fn not_understood(&self, hint: &str) -> PlanError {
        let start = self.rest().first().map_or(self.words.len(), |lexeme| lexeme.start);
        PlanError::NotUnderstood {
            words: shortened(self.words),
            fragment: shortened(&self.words[start..]),
            hint: hint.to_owned(),
        }
    }
}

/// A text cut to a length that fits into an answer.
pub(super) fn shortened(text: &str) -> String {
    const MOST: usize = 80;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}
