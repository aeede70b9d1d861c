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

use simworld_core::id::EntityId;
use simworld_core::seam::PlanError;

use super::blocks::{GOES_ON, IF, UNLESS, UNTIL, WHEN_SO, WHILE};
use super::clause::{Clause, Reference};
use super::lexer::{Lexeme, Token};
use super::lexicon::{Category, fits, longest_phrase};
use super::names::Names;
use super::numbers;
use super::phrases::{PhraseList, Phrases};
use super::politeness::{NEGATIONS, filler, joint};
use super::remarks::Beside;
use super::requests;
use super::resolve::View;
use super::shopping::Goods;
use super::tails::ON_THE_WAY;
use super::verbs::{Verb, longest_verb};

/// What is understood, in one line, for answers.
pub(super) const UNDERSTOOD: &str = "say go to, follow, look at, pick up, drop off, put down, give, buy, sit down, stand up, \
     stop, wait, ride, drive to, get off, open, step, turn, wave at, point at, talk to, argue with or take a photo, joined by \
     \"and\" or \"then\"";
/// How deep conditions and repetitions may nest.
const DEEPEST: u32 = 4;
/// What begins as politeness does, and says something.
#[rustfmt::skip]
const MORE_THAN_FILLERS: &Phrases = &Phrases::of(&[
    "so we can", "so we could", "so i can", "so i could", "so they can", "so they could", "so he can", "so she can", "so long as", "so that you can", "so you can", "so as to", "so that", "there is", "there are", "there sits",
    "there stands", "there lies", "here is", "over there is", "over there are", "there and back", "when you can see", "as soon as you can see", "whenever you can see", "when you can spot",
    "as soon as you can spot", "when you can make out", "as soon as you can make out", "up there is",
    "instead of", "go on to", "go on over to", "go on towards", "come on over", "here are",
]);
/// How often a statement is tried in other words, in one sentence.
const MOST_TRIES: u32 = 24;

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
    /// The verb before that.
    pub(super) previous: Option<Verb>,
    /// Out of which things "the middle one" is chosen.
    pub(super) scope: Option<Reference>,
    /// The goods that "one" stands for.
    pub(super) wanted: Option<Goods>,
    /// Whether they were only wished for so far, and by whom if somebody here is to have them.
    pub(super) wished: bool,
    pub(super) wished_by: Option<Reference>,
    /// What was spoken of that is no thing of the scene.
    pub(super) beside: Beside,
    /// Where one is to go was stated and not ordered: "you are needed at the fountain".
    pub(super) stated: bool,
    /// To which side one turned last: 1 is left.
    pub(super) turned: Option<f64>,
    /// What was asked last: "until it is".
    pub(super) tested: Option<super::clause::Test>,
    /// The words that were said last: "and tell Dmitri the same".
    pub(super) said: Option<String>,
    /// Those whom the orders with one verb are about: "wave at Anna and Ben, then follow them".
    pub(super) group: Vec<Reference>,
    /// Who and what was named in a remark that was passed over.
    pub(super) named: Vec<Clause>,
    /// What is not here of what was understood on trial: a better answer than that nothing was.
    pub(super) missing: Option<PlanError>,
    /// How often a statement may still be tried in other words.
    pub(super) tries: u32,
    /// Whether a condition is read: then "is" says what holds and not which thing is meant.
    pub(super) in_test: bool,
    depth: u32,
}

/// How the orders of a list hang together.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Extent {
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
            previous: None,
            scope: None,
            wanted: None,
            wished: false,
            wished_by: None,
            beside: Beside::default(),
            stated: false,
            said: None,
            turned: None,
            tested: None,
            group: Vec::new(),
            named: Vec::new(),
            missing: None,
            tries: MOST_TRIES,
            in_test: false,
            depth: 0,
        }
    }

    /// All orders of the sentence, at least one.
    pub(super) fn sentence(&mut self) -> Result<Vec<Clause>, PlanError> {
        self.skip_opening();
        while self.skip_warning() {}
        self.skip_joints();
        if self.peeks("no") && matches!(self.rest().get(1), Some(Lexeme { token: Token::Comma, .. })) {
            self.at += 2;
        }
        let start = self.at;
        if self.skip_remark() {
            self.skip_joints();
            if self.at >= self.lexemes.len() {
                self.at = start; // "I'm in the mood for soup" is all that is said
            }
        }
        self.skip_first_correction();
        // "To the museum, then to the school" leaves the verb out.
        self.verb = longest_phrase(self.rest(), &["to", "over to", "back to", "on to"]).map(|_| Verb::Go);
        let clauses = self.orders(Extent::Sentence)?;
        if clauses.is_empty() { Err(self.not_understood(UNDERSTOOD)) } else { Ok(clauses) }
    }

    pub(super) fn orders(&mut self, extent: Extent) -> Result<Vec<Clause>, PlanError> {
        let mut clauses: Vec<Clause> = Vec::new();
        let (mut whole, mut group) = (0, 0);
        while self.at < self.lexemes.len() {
            let before = clauses.len();
            clauses.append(&mut self.named);
            let stated = std::mem::take(&mut self.stated);
            clauses.extend(self.statement()?);
            super::again::goes_there(&mut clauses, before, stated);
            if let [.., Clause::Sit { on: None }, Clause::Sit { on: Some(_) }] = clauses[..] {
                clauses.remove(clauses.len() - 2); // "sit down and rest on the red chair"
            }
            self.tails(&mut clauses, whole, group)?;
            super::again::stops_then(&mut clauses);
            while let Some(instead) = self.correction()? {
                let slip = clauses.drain(before..).next_back();
                // "Go to the cone. Not that one, the other one".
                let other = instead.iter().any(|clause| clause.about().is_some_and(|what| what.traits.other));
                let spoken_of = slip.as_ref().and_then(Clause::about).filter(|_| other).cloned();
                clauses.extend(spoken_of.map(|what| Clause::Mention { what }));
                clauses.extend(instead);
                self.tails(&mut clauses, whole, group)?;
            }
            while self.skip_instead() {}
            if extent == Extent::Group && !self.goes_on_with_and() {
                return Ok(clauses);
            }
            let start = self.at;
            if self.joint()? {
                whole = clauses.len();
            }
            if !self.is_and(start) {
                group = clauses.len();
            }
        }
        Ok(clauses)
    }

    /// Passes what stands between two orders; whether a sentence ends there.
    fn joint(&mut self) -> Result<bool, PlanError> {
        if self.skip_purpose() {
            return Ok(false);
        }
        let _ = self.skip_need()
            || self.skip_portions()
            || self.skip_outcome()
            || self.skip_use()
            || self.skip_threat();
        self.skip_fillers();
        self.at += requests::coda(self.rest());
        self.skip_manner();
        self.skip_reason();
        let joint = self.at;
        self.skip_statements();
        let mut joined = self.skip_joints();
        if joined {
            self.skip_statements();
        }
        joined = self.skip_remark() && self.skip_joints() || joined;
        while joined && self.at < self.lexemes.len() && self.skip_aside() {
            self.skip_joints();
        }
        let breaks = self.lexemes[joint..self.at].iter().any(|lexeme| lexeme.token == Token::Break);
        joined = self.skip_purpose() || joined;
        let goes_on = longest_verb(self.rest()).is_some() || self.begins_block();
        if self.at < self.lexemes.len() && !joined && !goes_on {
            return Err(self.not_understood("end here, or go on with \"and\" or \"then\""));
        }
        Ok(breaks)
    }

    /// Whether "and" or a purpose, and no comma nor "then", joins what follows.
    fn goes_on_with_and(&mut self) -> bool {
        let start = self.at;
        self.skip_fillers();
        let goes_on = fits(self.rest(), "and").is_some() && !self.denies() || {
            let at = self.at;
            let purpose = self.skip_purpose();
            self.at = at;
            purpose
        };
        if !goes_on {
            self.at = start;
        }
        goes_on
    }

    /// Whether "and if not" follows, which belongs to the condition around.
    fn denies(&self) -> bool {
        #[rustfmt::skip]
        const DENIED: &[&str] = &[
            "and if not", "and otherwise", "and else", "and if it", "and if he", "and if she", "and if they", "and if there",
        ];
        longest_phrase(self.rest(), DENIED).is_some()
    }

    /// Whether the words from a place to here are "and" alone.
    fn is_and(&self, start: usize) -> bool {
        let joint = &self.lexemes[start..self.at];
        joint.iter().any(|lexeme| lexeme.token == Token::Word("and".to_owned()))
            && !joint.iter().any(|lexeme| matches!(&lexeme.token, Token::Word(word) if word == "then"))
            && !joint.iter().any(|lexeme| lexeme.token == Token::Break)
    }

    pub(super) fn begins_block(&self) -> bool {
        #[rustfmt::skip]
        const BLOCKS: &Phrases = &Phrases::of(&[
            "if", "unless", "when", "until", "keep", "repeat", "before", "after", "while", "every", "having",
            "should", "at the next", "dont stop", "as soon as", "as long as", "once", "till",
        ]);
        longest_phrase(self.rest(), BLOCKS).is_some()
    }

    /// One order or block, without what follows it. What is no order as it stands may be a request in other words.
    pub(super) fn statement(&mut self) -> Result<Vec<Clause>, PlanError> {
        let begin = self.at;
        self.skip_fillers();
        self.skip_origin();
        let polite = requests::polite_condition(self.rest());
        if polite > 0 {
            self.at += polite;
            self.skip_fillers();
        }
        if let Some(mut clauses) = self.marked_topic() {
            clauses.extend(self.statement()?);
            return Ok(clauses);
        }
        let start = self.at;
        if longest_phrase(self.rest(), &["see that", "see to it", "make sure", "ensure"]).is_some() {
            if let Some(clauses) = self.somebody_gets() {
                return Ok(clauses);
            }
            self.at = start;
        }
        let refused = match self.plain_statement() {
            Ok(clauses) => return Ok(self.at_pace_before(begin, start, clauses)),
            Err(refused) => refused,
        };
        for beginning in requests::beginnings(&self.lexemes[start..]) {
            self.at = start + beginning;
            if let Ok(clauses) = self.plain_statement() {
                return Ok(clauses);
            }
        }
        self.at = start;
        let remark = |parser: &mut Self| {
            parser.at = begin; // "you look tired, sit down": "you" was passed over as politeness
            (begin < start && parser.may_try()).then(|| parser.aside()).flatten()
        };
        self.in_other_words().or_else(|| remark(self)).ok_or_else(|| {
            self.at = start;
            match refused {
                PlanError::NotUnderstood { .. } => self.missing.take().unwrap_or(refused),
                refused => refused,
            }
        })
    }

    /// What is understood only as a whole: a place or a thing before the order, an order in nouns, what is not to be done
    /// before what is.
    fn in_other_words(&mut self) -> Option<Vec<Clause>> {
        self.tries = self.tries.checked_sub(1)?;
        let start = self.at;
        let kept = (self.class, self.bearers.clone(), self.verb, self.scope.clone());
        let wish = (self.wanted.clone(), self.wished, self.wished_by.clone());
        let mut found = None;
        for rule in [
            Self::instead,
            Self::only_then,
            Self::needed_there,
            Self::place_meant,
            Self::fronted_place,
            Self::numbered_itinerary,
            Self::in_nouns,
            Self::clipped,
            Self::which_one,
            Self::way_asked,
            Self::told_by_another,
            Self::itinerary,
            Self::goes_somewhere,
            Self::wants_one,
            Self::somebody_gets,
            Self::on_topic,
            Self::headed,
            Self::aside,
        ] {
            found = rule(self);
            if found.is_some() {
                break;
            }
            self.at = start;
            (self.class, self.bearers, self.verb, self.scope) = kept.clone();
            (self.wanted, self.wished, self.wished_by) = wish.clone();
        }
        found
    }

    fn in_nouns(&mut self) -> Option<Vec<Clause>> {
        self.nominal().ok().flatten()
    }

    pub(super) fn on_topic(&mut self) -> Option<Vec<Clause>> {
        let mut clauses = self.topic()?;
        if let Some(there) = self.stands_there(&clauses) {
            clauses.push(there);
            return Some(clauses);
        }
        clauses.extend(self.statement_here()?);
        Some(clauses)
    }

    /// A statement on trial; the answer to what is not here is kept.
    pub(super) fn statement_here(&mut self) -> Option<Vec<Clause>> {
        match self.statement() {
            Ok(clauses) => Some(clauses),
            Err(error) => {
                if matches!(error, PlanError::NotFound { .. }) {
                    self.missing.get_or_insert(error);
                }
                None
            }
        }
    }

    fn plain_statement(&mut self) -> Result<Vec<Clause>, PlanError> {
        let goes_on = longest_phrase(self.rest(), GOES_ON).is_some();
        if !goes_on && longest_phrase(self.rest(), NEGATIONS).is_some() && longest_verb(self.rest()).is_none()
        {
            return self.not_until();
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

    // ---- the cursor ----

    pub(super) fn rest(&self) -> &'a [Lexeme] {
        &self.lexemes[self.at..]
    }

    pub(super) fn peeks(&self, word: &str) -> bool {
        fits(self.rest(), word).is_some()
    }

    /// Passes the longest of these phrases, if one is there.
    pub(super) fn eat_any<L: PhraseList + ?Sized>(&mut self, phrases: &L) -> bool {
        let count = longest_phrase(self.rest(), phrases);
        self.at += count.unwrap_or(0);
        count.is_some()
    }

    pub(super) fn ends_clause(&self) -> bool {
        const TAILS: &Phrases = &Phrases::of(&[
            "before",
            "after",
            "for",
            "because",
            "instead of",
            "rather than",
            "in order to",
            "so that",
            "so as to",
            "forever",
            "or if",
        ]);
        matches!(self.rest().first().map(|lexeme| &lexeme.token), None | Some(Token::Comma | Token::Break))
            || joint(self.rest()).is_some()
            || filler(self.rest()).is_some()
            || [TAILS, ON_THE_WAY, UNTIL, WHILE, IF, UNLESS, WHEN_SO]
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
            self.at += self.item_mark();
            let mark =
                matches!(self.rest().first(), Some(l) if matches!(l.token, Token::Comma | Token::Break));
            if mark {
                self.at += 1;
            } else if self.counts_a_thing() || self.counts_a_step() || !self.eat_joint() {
                return self.at > start;
            }
        }
    }

    fn eat_joint(&mut self) -> bool {
        let words = joint(self.rest());
        self.at += words.unwrap_or(0);
        words.is_some()
    }

    /// Passes politeness, unless the words begin an order.
    pub(super) fn skip_fillers(&mut self) {
        while let Some(count) = filler(self.rest()) {
            let is_verb = longest_verb(self.rest()).is_some_and(|(_, words)| words >= count);
            let is_more = longest_phrase(self.rest(), MORE_THAN_FILLERS).is_some_and(|words| words > count);
            // "Buy jam, then honey": nobody is called so there.
            let is_goods = self.verb == Some(Verb::Buy) && self.names.goods(self.rest()).is_some();
            if is_verb || is_more || is_goods {
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
