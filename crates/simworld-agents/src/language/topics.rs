//! What is spoken of before an order: "there is a robot on the square: follow it", "see the blue car? get in", "Dmitri
//! looks lonely, go and talk to him". Nothing is done about it, but later words stand for it.

use simworld_core::seam::PlanError;

use super::clause::{Choice, Clause, Count, Reference, Stands, Target};
use super::lexer::{Lexeme, Token};
use super::lexicon::{category, longest_phrase, longest_side};
use super::numbers;
use super::parser::Parser;
use super::phrases::Phrases;
use super::resolve::is_item;
use super::verbs::longest_verb;

/// What leads to a thing that is only spoken of.
#[rustfmt::skip]
const INTRODUCTIONS: &Phrases = &Phrases::of(&[
    "get lunch at", "have lunch at", "get dinner at", "have dinner at", "eat at", "grab a bite at", "have breakfast at",
    "you can find", "you can get", "you can buy", "they sell", "they have", "there should be", "there must be", "there might be", "there used to be",
    "have you seen", "did you see", "have you noticed", "did you notice", "have you spotted", "do you remember", "did you spot", "is that", "is not that",
    "know", "there goes", "here comes", "there is", "theres", "there are", "you see", "you can see", "do you see", "can you see", "see", "you know",
    "do you know", "as for", "as to", "about", "regarding", "concerning", "what about", "how about", "whats",
    "what is", "wheres", "where is", "which is", "who is", "whos", "id like", "i would like", "id love",
    "i want", "i need", "i fancy", "i could do with", "we need", "we want", "here is", "heres", "that is",
    "thats", "over there is", "over there are", "up there is", "back there is", "there sits", "there stands",
    "there lies", "remember", "you remember", "notice", "show me", "spot", "i see", "i can see", "i have",
    "i would like to have", "id like to have", "i want to have", "id love to have", "i would love", "i would love to have", "i would like to get", "id like to get",
    "i want to get", "we would like", "wed like", "we could do with", "i could use", "we could use", "i really want", "i really need", "we really need",
    "we are out of", "we have run out of", "weve run out of", "i am out of", "im out of", "i have run out of", "ive run out of",
    "we have no", "weve got no", "i have no", "i like", "i love", "i left", "somebody left", "someone left", "now", "look",
]);
/// What somebody or something is or seems to be, in a remark.
#[rustfmt::skip]
const STATIVES: &Phrases = &Phrases::of(&[
    "is", "are", "was", "were", "has", "have", "had", "looks", "look", "seems", "seem", "feels", "stands",
    "sits", "waits", "lies", "needs", "wants", "likes", "loves", "hates", "lives", "works", "sells", "looked",
    "seemed", "must be", "might be", "could be", "should be", "would like", "would love", "got", "keeps",
    "left", "forgot", "lost", "asked", "said", "called", "belongs", "ordered", "just", "hasnt", "isnt", "does", "doesnt",
    "cant", "will", "gives", "offers", "provides", "makes", "throws", "casts", "smells", "skipped", "missed", "overslept", "broke",
]);
/// What makes another thing of a remark: it says when or whether, or that it is an order.
const NO_REMARK: &Phrases =
    &Phrases::of(&["if", "unless", "until", "till", "when", "where i want", "dont", "not", "never"]);

/// Words of headings that say nothing of what is to be done.
#[rustfmt::skip]
const HEADINGS: &[&str] = &[
    "task", "order", "orders", "job", "mission", "run", "delivery", "errand", "errands", "action", "plan",
    "next", "step", "number", "one", "two", "three", "request", "command", "commands", "instruction",
    "instructions", "drop", "off", "pick", "up", "ok", "okay", "listen", "attention", "note", "reminder",
    "quick", "new", "your", "the", "a", "my", "our", "and", "here", "it", "goes", "todo", "to", "do", "list",
    "important", "urgent", "favour", "favor", "small", "little", "thing", "things", "following", "first",
    "second", "third", "last", "item", "assignment", "challenge", "exercise", "game", "for", "you", "today",
];

impl Parser<'_> {
    /// "New task: ...": a heading that says nothing.
    pub(super) fn headed(&mut self) -> Option<Vec<Clause>> {
        let end = self.rest().iter().take(6).position(|lexeme| lexeme.token == Token::Break)?;
        let is_idle = |lexeme: &Lexeme| {
            matches!(&lexeme.token, Token::Word(word) if HEADINGS.contains(&word.as_str()))
                || matches!(lexeme.token, Token::Number(_))
        };
        let colon = self.words[self.rest()[end].start..].starts_with([':', '!', '.']);
        if end == 0 || !colon || !self.rest()[..end].iter().all(is_idle) {
            return None;
        }
        self.at += end;
        self.skip_joints();
        self.statement().ok()
    }

    /// A topic with the mark behind it; an order follows.
    pub(super) fn topic(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        if self.out_of().is_some() && (self.order_follows() || longest_verb(self.rest()).is_some()) {
            return Some(Vec::new());
        }
        self.at = start;
        for rule in [Self::introduced, Self::on_a_side, Self::somebody_is, Self::remarked, Self::named_first]
        {
            if let Some(clauses) = rule(self)
                && self.order_follows()
            {
                self.settle_wish(&clauses);
                return Some(clauses);
            }
            self.at = start;
        }
        None
    }

    /// As [`topic`](Self::topic), of what would be an order without its mark: "see the blue car? get in".
    pub(super) fn marked_topic(&mut self) -> Option<Vec<Clause>> {
        const LONGEST: usize = 14;
        let begins = longest_phrase(
            self.rest(),
            &["see", "spot", "show me", "look", "find", "remember", "notice", "know"],
        )
        .is_some();
        if let Some(clauses) = self.seen_by_you() {
            return Some(clauses);
        }
        let mark = self.rest().iter().take(LONGEST).find(|lexeme| lexeme.token == Token::Break)?;
        let is_topic = begins && self.words[mark.start..].starts_with(['?', ':']);
        let start = self.at;
        let found = if is_topic { self.introduced().filter(|_| self.order_follows()) } else { None };
        if found.is_none() {
            self.at = start;
        }
        found
    }

    /// Whether a mark stands here and something after it; the mark is passed.
    pub(super) fn order_follows(&mut self) -> bool {
        let is_mark =
            matches!(self.rest().first().map(|lexeme| &lexeme.token), Some(Token::Comma | Token::Break));
        let is_and = longest_phrase(self.rest(), &["so", "and"]).is_some();
        let here = self.at > 0
            && matches!(&self.lexemes[self.at - 1].token, Token::Word(word) if word == "there" || word == "here")
            && longest_verb(self.rest()).is_some();
        here || (is_mark || is_and) && self.skip_joints() && self.at < self.lexemes.len()
    }

    /// "There is a letter for Fay lying about": whoever is named in it is spoken of too.
    fn introduced(&mut self) -> Option<Vec<Clause>> {
        let words = longest_phrase(self.rest(), INTRODUCTIONS)?;
        let only_asked =
            longest_phrase(self.rest(), &["see", "spot", "look", "now", "about", "that is", "thats"])
                .is_some();
        let lists = self.peeks("show me");
        self.at += words;
        self.at +=
            longest_phrase(self.rest(), &["that"]).filter(|_| category(self.rest()).is_none()).unwrap_or(0);
        if let Some(goods) = self.goods() {
            let whom = self.for_whom();
            let clauses = self.rest_of_remark()?;
            (self.wished_by, self.wanted, self.wished) = (whom, Some(goods), true);
            return Some(clauses);
        }
        let what = match self.reference(0) {
            Ok(what) => what,
            Err(error) => {
                // "Where is Stefan? Wave to him": that he is not here is the answer.
                let asked = matches!(error, PlanError::NotFound { .. }) && self.is_capital(self.at);
                if asked {
                    self.missing.get_or_insert(error);
                }
                return None;
            }
        };
        let mut clauses = self.mention(what);
        clauses.extend(self.rest_of_remark()?);
        let mark = self.mark();
        let fits = !only_asked && !lists || mark == Some('?') || mark == Some(':');
        fits.then_some(clauses)
    }

    /// "On your left are three doors".
    fn on_a_side(&mut self) -> Option<Vec<Clause>> {
        let (side, words) = longest_side(self.rest())?;
        self.at += words;
        if !self.eat_any(&[
            "is",
            "are",
            "there is",
            "there are",
            "theres",
            "stands",
            "stand",
            "you see",
            "you can see",
        ]) {
            return None;
        }
        let mut what = self.reference(0).ok()?;
        what.relation = Some(Stands::Side(side));
        Some(self.mention(what))
    }

    /// "Of the people here, ...": what is chosen from.
    fn out_of(&mut self) -> Option<()> {
        let start = self.at;
        if self.eat_any(&["of", "out of", "between"])
            && let Some(ids) = self.named_apart()
        {
            (self.class, self.bearers) = (None, Some(ids));
            return Some(());
        }
        self.at = start;
        if self.peeks("of") && self.is_capital(self.at + 1) {
            self.at += 1;
            return self.out_of_named();
        }
        if !self.eat_any(&[
            "of all the",
            "of the",
            "of all",
            "of our",
            "of your",
            "out of the",
            "out of all the",
            "among the",
            "from the",
            "from all the",
            "from among the",
            "of these",
            "of those",
        ]) {
            return None;
        }
        if let Some((_, words)) = numbers::count(self.rest()) {
            self.at += words;
        }
        let Some((class, words)) = category(self.rest()) else {
            // "Out of the three cabins".
            let ids = self.rest().first().and_then(|first| self.names.sort(&first.token))?;
            self.at += 1;
            (self.class, self.bearers) = (None, Some(ids));
            return Some(());
        };
        self.at += words;
        self.class = Some(class);
        self.bearers = None;
        let mut several =
            Reference { count: Count::All, ..Reference::to(Target::Any(class), class.words[0].to_owned()) };
        self.described(&mut several, 0).ok()?;
        self.eat_any(&["here", "there", "around", "about", "around here", "on the square"]);
        if several.relation.is_some() {
            self.scope = Some(several);
        }
        Some(())
    }

    /// "Of Anna and Ben ...": those that are named.
    fn out_of_named(&mut self) -> Option<()> {
        let mut named = Vec::new();
        loop {
            let one = self.somebody_here()?;
            let Target::Named(ids) = one.target else { return None };
            named.extend(ids);
            if !self.eat_any(&["and", "or"])
                && !matches!(self.rest().first().map(|lexeme| &lexeme.token), Some(Token::Comma))
            {
                break;
            }
            if matches!(self.rest().first().map(|lexeme| &lexeme.token), Some(Token::Comma)) {
                let comma = self.at;
                self.at += 1;
                self.eat_any(&["and", "or"]);
                if !self.is_capital(self.at) {
                    self.at = comma;
                    break;
                }
            }
        }
        (self.class, self.bearers) = (None, Some(named));
        Some(())
    }

    /// "Somebody is waiting at the cottage": who says so is nobody, and where is spoken of.
    fn somebody_is(&mut self) -> Option<Vec<Clause>> {
        if !self.eat_any(&[
            "somebody is",
            "someone is",
            "people are",
            "a friend is",
            "they are",
            "my friend is",
            "a friend of mine is",
            "i left something",
            "the party is",
            "the others are",
        ]) {
            return None;
        }
        while self.at < self.lexemes.len() && !self.ends_at_mark() {
            if self.eat_any(&[
                "at",
                "in",
                "by",
                "near",
                "on",
                "outside",
                "beside",
                "behind",
                "in front of",
                "next to",
            ]) && let Ok(what) = self.reference(0)
            {
                return self.ends_at_mark().then(|| self.mention(what));
            }
            self.at += 1;
        }
        None
    }

    /// "Dmitri looks lonely".
    fn remarked(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        if longest_phrase(self.rest(), &["it", "there", "here", "they", "that", "this"]).is_some() {
            return None;
        }
        let what = self.reference(0).ok()?;
        let names_one = matches!(what.target, Target::Named(_) | Target::Any(_) | Target::Id(_))
            && matches!(what.choice, Choice::Open | Choice::Most(..));
        if names_one && let Some(likeness) = self.said_to_be(&what) {
            return Some(self.mention(likeness)); // "my suitcase is the red one, bring it to Eve"
        }
        // "Quentin and Petra are friends of mine, wave to them".
        let mut both = vec![what.clone()];
        while names_one && self.is_somebody(&what) && self.eat_any(&["and"]) {
            both.push(self.somebody_here()?);
        }
        if both.len() > 1 {
            self.group = both;
        }
        if !names_one
            || self.at == start
            || longest_phrase(self.rest(), STATIVES).is_none() && !self.described_by_is()
        {
            return None;
        }
        // Who speaks of what is not here says nothing of it that an order could take up.
        let here = self.view.find(&what, super::resolve::Purpose::Any).is_ok();
        let taken_up = self.rest().iter().any(|lexeme| {
            matches!(&lexeme.token, Token::Word(word) if ["it", "him", "her", "them", "there", "one", "he", "she"].contains(&word.as_str()))
        });
        let mut clauses = if here || taken_up { self.mention(what) } else { Vec::new() };
        clauses.extend(self.where_that_is());
        clauses.extend(self.rest_of_remark()?);
        Some(clauses)
    }

    /// "Tom waits at the hospital, hurry there": where somebody is, if "there" takes it up.
    fn where_that_is(&mut self) -> Option<Clause> {
        let start = self.at;
        let is_mark = |lexeme: &Lexeme| matches!(lexeme.token, Token::Comma | Token::Break);
        let mark = self.rest().iter().position(is_mark)?;
        let there = |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if word == "there");
        if !self.rest()[mark..].iter().any(there) {
            return None;
        }
        self.eat_any(STATIVES);
        self.eat_any(&["waiting", "sitting", "standing", "now", "already", "for you", "for me", "for us"]);
        let leads = self.eat_any(&[
            "at",
            "in",
            "by",
            "near",
            "outside",
            "beside",
            "behind",
            "in front of",
            "next to",
        ]);
        let place = if leads { self.reference(0).ok() } else { None };
        let place = place.filter(|place| self.view.find(place, super::resolve::Purpose::Any).is_ok());
        if place.is_none() {
            self.at = start;
        }
        place.map(|what| Clause::Mention { what })
    }

    /// Whether a noun phrase took the "is" of a remark with it: "Jo is at the kerb".
    fn described_by_is(&self) -> bool {
        let is =
            |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if word == "is" || word == "are");
        self.lexemes[..self.at].iter().rev().take(8).any(is) && self.ends_at_mark()
    }

    /// "The letter: bring it to Hana".
    fn named_first(&mut self) -> Option<Vec<Clause>> {
        if longest_verb(self.rest()).is_some() && category(self.rest()).is_none() {
            return None;
        }
        let what = self.reference(0).ok()?;
        self.skip_fillers();
        let takes_up = {
            let after = self.rest().get(1..).unwrap_or_default();
            let is_pronoun = |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if ["it", "there", "him", "her", "them", "in", "on", "one", "sit", "down"].contains(&word.as_str()));
            self.ends_at_mark() && after.iter().any(is_pronoun)
        };
        takes_up.then(|| self.mention(what))
    }

    /// What is only spoken of; several are what "the middle one" is one of.
    pub(super) fn mention(&mut self, what: Reference) -> Vec<Clause> {
        if what.count == Count::One {
            return vec![Clause::Mention { what }];
        }
        self.scope = Some(what.clone());
        vec![Clause::Mention { what }]
    }

    /// A thing or a place that is named in a remark, where it or "there" is taken up behind it.
    fn thing_here(&mut self) -> Option<Reference> {
        let start = self.at;
        let is_mark = |lexeme: &Lexeme| {
            matches!(lexeme.token, Token::Comma | Token::Break)
                || lexeme.token == Token::Word("so".to_owned())
        };
        let mark = start + self.rest().iter().position(is_mark)?;
        let takes_up = |word: &str| {
            self.lexemes[mark..].iter().any(|lexeme| lexeme.token == Token::Word(word.to_owned()))
        };
        let (it, there) = (takes_up("it"), takes_up("there"));
        let begins = longest_phrase(
            self.rest(),
            &["the", "a", "an", "my", "his", "her", "that", "our", "your", "their"],
        )
        .is_some()
            || self.is_capital(start) && there;
        if !begins || !it && !there {
            return None;
        }
        let whole = self.lexemes;
        let class = (self.class, self.bearers.clone());
        self.lexemes = &whole[..mark];
        // "Her yellow parcel" is no person.
        self.at += longest_phrase(self.rest(), &["her", "his", "their"])
            .filter(|_| self.rest().len() > 1)
            .unwrap_or(0);
        let what = self.reference(0).ok();
        self.lexemes = whole;
        let found = what.as_ref().and_then(|what| self.view.find(what, super::resolve::Purpose::Any).ok());
        let kept = found.is_some_and(|found| {
            let place = found.kind == simworld_core::scene::EntityKind::Building;
            is_item(found.kind) && it || place && there
        });
        if !kept {
            self.at = start;
            (self.class, self.bearers) = class;
        }
        what.filter(|_| kept)
    }

    /// To the end of a remark; names in it are spoken of.
    fn rest_of_remark(&mut self) -> Option<Vec<Clause>> {
        let mut clauses = Vec::new();
        while self.at < self.lexemes.len() && !self.ends_at_mark() {
            if longest_phrase(self.rest(), NO_REMARK).is_some() {
                return None;
            }
            if self.eat_any(&["over there", "right there", "over here", "there", "here"])
                && longest_verb(self.rest()).is_some()
            {
                return Some(clauses);
            }
            let counted = self.peek_count().is_some();
            let article = self.at;
            let goods = if counted || self.eat_any(&["a", "an", "some"]) { self.goods() } else { None };
            if let Some(goods) = goods {
                self.wish_for(goods);
                continue;
            }
            self.at = article;
            if self.ends_at_mark() {
                break;
            }
            let named = if self.is_capital(self.at) { self.somebody_here() } else { None };
            match named.or_else(|| self.thing_here()) {
                Some(named) => clauses.push(Clause::Mention { what: named }),
                None => self.at += 1,
            }
        }
        Some(clauses)
    }

    pub(super) fn ends_at_mark(&self) -> bool {
        self.rest().is_empty()
            || matches!(self.rest().first().map(|lexeme| &lexeme.token), Some(Token::Comma | Token::Break))
            || longest_phrase(self.rest(), &["so"]).is_some()
    }

    /// The mark that stands here, as it is written.
    pub(super) fn mark(&self) -> Option<char> {
        let lexeme = self.rest().first()?;
        let is_mark = matches!(lexeme.token, Token::Comma | Token::Break);
        self.words[lexeme.start..].chars().next().filter(|_| is_mark)
    }
}
