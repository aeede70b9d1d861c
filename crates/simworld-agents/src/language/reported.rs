//! Orders that are told as somebody's wish: "Marta says you should go to the office", "Hugo wants to talk to you", "let Ben know
//! that the bus is late".

use super::clause::{Clause, Pace};
use super::lexer::{Lexeme, Token};
use super::lexicon::longest_phrase;
use super::parser::Parser;
use super::phrases::Phrases;
use super::verbs::longest_verb;

/// Between who wants something and what he wants to be done.
#[rustfmt::skip]
const WANTS_YOU_TO: &Phrases = &Phrases::of(&[
    "wants you to", "would like you to", "needs you to", "asked you to", "says you should", "says you have to", "says you need to", "says you must", "says to",
    "said to", "said you should", "told you to", "asks you to", "is asking you to", "expects you to", "said you have to", "says that you should", "said that you should",
    "has asked you to", "asks if you could", "asked if you could", "asks whether you could", "is asking if you could", "wonders if you could", "wants us to",
    "thinks you should", "suggests you", "suggested you", "suggests that you", "recommends you", "want you to", "would love you to", "wishes you to", "begs you to",
    "orders you to", "wants to know if you could", "asks if you can", "asked if you can", "would be happy if you", "would be glad if you", "would appreciate it if you",
]);
/// Wanting somebody to come.
#[rustfmt::skip]
const WANTS_YOU: &Phrases = &Phrases::of(&[
    "wants to see you", "would like to see you", "wants to meet you", "would like to meet you", "is asking for you", "is looking for you", "is calling you",
    "is waiting for you", "needs you", "wants you", "would like you to come over", "wants you to come over", "wants you to come", "would like you to come",
    "wants a word with you", "would like a word with you", "is expecting you", "needs your help", "could use your help", "could use a hand", "needs a hand",
    "needs help", "needs some help", "wants you over there", "needs you over there", "needs you right now", "is calling for you", "asked for you", "called you",
    "wants your help", "would like your help", "could do with a hand", "could do with some help", "wants some company", "needs some company", "could use some company",
]);
/// Wanting to be spoken to.
#[rustfmt::skip]
const WANTS_TO_TALK: &Phrases = &Phrases::of(&[
    "wants to talk to you", "wants to speak to you", "would like to talk to you", "would like to speak to you", "wants to talk with you", "wants to speak with you",
    "would like to talk with you", "would like to speak with you", "wants to have a word with you", "wants to chat with you", "needs to talk to you", "needs to speak to you",
    "has to talk to you", "must talk to you", "wants a chat", "wants to have a chat with you", "wants someone to talk to", "needs somebody to talk to", "needs someone to talk to",
    "wants somebody to talk to", "would like to say hello to you",
]);

/// Whose somebody is.
const OWN: &Phrases =
    &Phrases::of(&["my", "our", "your", "his", "her", "their", "the", "my friend", "our friend"]);
/// Those who are told or told of, before their names.
#[rustfmt::skip]
pub(super) const TITLES: &Phrases = &Phrases::of(&[
    "professor", "doctor", "dr", "mr", "mrs", "ms", "miss", "nurse", "officer", "captain", "uncle", "aunt", "auntie", "grandma", "grandpa", "old", "little",
    "poor", "young", "colleague", "cousin", "sister", "brother",
]);

impl Parser<'_> {
    /// Passes somebody who is no part of the scene ("the boss", "grandma") before one of these phrases; whether there was one.
    pub(super) fn outsider_before<L: super::phrases::PhraseList + ?Sized>(&mut self, phrases: &L) -> bool {
        const MOST: usize = 4;
        let plain = |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if !["if", "when", "it", "there", "that", "what", "i", "you", "we"].contains(&word.as_str()));
        if longest_verb(self.rest()).is_some() {
            return false;
        }
        let ends = (1..=MOST.min(self.rest().len().saturating_sub(1)))
            .take_while(|words| plain(&self.rest()[words - 1]))
            .find(|words| longest_phrase(&self.rest()[*words..], phrases).is_some());
        let Some(words) = ends else { return false };
        let said = &self.rest()[..words];
        let named = (0..words)
            .any(|at| self.names.exact(&said[at..]).is_some() || self.names.goods(&said[at..]).is_some());
        let own = longest_phrase(said, super::lexicon::DETERMINERS).is_some();
        let somebody = (0..words).any(|at| longest_phrase(&said[at..], super::shopping::OTHERS).is_some());
        let thing = (0..words).any(|at| super::lexicon::category(&said[at..]).is_some());
        if named || !somebody && (thing || !own) {
            return false;
        }
        self.at += words;
        true
    }

    /// Passes what stands before names and says no more than they do: "professor Hana", "both of them, Greta and Jonas".
    pub(super) fn skip_titles(&mut self) {
        // Nothing of that stands before a small letter.
        let near = self.rest().len().min(6);
        if !(0..near).any(|at| self.is_capital(self.at + at)) {
            return;
        }
        // "Both of them, Greta and Jonas" are each named.
        let all = longest_phrase(
            self.rest(),
            &[
                "both of them",
                "all of them",
                "all three of them",
                "the two of them",
                "the three of them",
                "both",
                "all three",
                "all four of them",
            ],
        );
        if let Some(words) = all
            && matches!(self.rest().get(words), Some(Lexeme { token: Token::Comma | Token::Break, .. }))
            && self.is_capital(self.at + words + 1)
        {
            self.at += words + 1;
        }
        // "Professor Hana", "my uncle Ben".
        let own = longest_phrase(self.rest(), OWN).unwrap_or(0);
        let title = own + longest_phrase(&self.rest()[own..], TITLES).unwrap_or(0);
        if title > own && self.is_capital(self.at + title) && self.names.exact(self.rest()).is_none() {
            let named = self.names.exact(&self.rest()[title..]);
            let animate = |id: &simworld_core::id::EntityId| {
                self.view.scene.entity(*id).is_some_and(|entity| super::lexicon::is_animate(entity.kind))
            };
            self.at += named.filter(|(ids, _)| ids.iter().any(animate)).map_or(0, |_| title);
        }
    }

    /// What somebody else wants of who is told.
    pub(super) fn told_by_another(&mut self) -> Option<Vec<Clause>> {
        if let Some(clauses) = self.lets_know().or_else(|| self.kind_words()) {
            return Some(clauses);
        }
        if let Some(clauses) = self.paid_a_visit() {
            return Some(clauses);
        }
        let start = self.at;
        if self.eat_any(&["make", "do"]) && super::numbers::walked(self.rest()).is_some() {
            return self.in_so_many_steps(); // "make three steps to the right"
        }
        self.at = start;
        if self.eat_any(&["let", "set", "help"])
            && let Some(clauses) = self.passenger(super::verbs::Verb::Drop)
        {
            return Some(clauses);
        }
        let start = self.at;
        let who = self.somebody_here();
        if who.is_none() {
            self.at = start;
            // "My boss says ...": who is no part of the scene.
            if !self.eat_any(&["they", "he", "she"]) && !self.outsider_before(WANTS_YOU_TO) {
                return None;
            }
        }
        if let Some(who) = &who {
            if self.eat_any(WANTS_TO_TALK) && self.ends_clause() {
                return Some(vec![Clause::Say { to: who.clone(), words: "hello".to_owned() }]);
            }
            if self.eat_any(WANTS_YOU) && self.ends_clause() {
                let to = who.clone();
                let end = self.at;
                // "Oscar asked for you, go and see him" says one thing twice.
                if self.skip_joints()
                    && matches!(longest_verb(self.rest()), Some((super::verbs::Verb::Go | super::verbs::Verb::Run, _)))
                    && self.rest().iter().any(|lexeme| matches!(&lexeme.token, Token::Word(word) if ["him", "her", "them"].contains(&word.as_str())))
                {
                    let mut clauses = vec![Clause::Mention { what: to }];
                    clauses.extend(self.statement_here()?);
                    return Some(clauses);
                }
                self.at = end;
                return Some(vec![Clause::Go { to, side: None, pace: Pace::Usual, within: None }]);
            }
        }
        if !self.eat_any(WANTS_YOU_TO) || longest_verb(self.rest()).is_none() {
            return None;
        }
        let mut clauses: Vec<Clause> = who.into_iter().map(|what| Clause::Mention { what }).collect();
        clauses.extend(self.statement_here()?);
        Some(clauses)
    }

    /// "Pay the museum a visit", "send Pixel a wave", "put yourself next to the statue", "show Gus where the fountain is".
    fn paid_a_visit(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        let go = |to, side| Clause::Go { to, side, pace: Pace::Usual, within: None };
        if self.eat_any(&["pay", "make"])
            && let Ok(to) = self.reference(0)
            && self.eat_any(&["a visit", "a short visit", "a quick visit", "a call"])
            && self.ends_clause()
        {
            return Some(vec![go(to, None)]);
        }
        self.at = start;
        if self.eat_any(&["send", "throw", "blow"])
            && let Ok(to) = self.reference(0)
            && let Some(clauses) = self.gesture(&to)
        {
            return Some(clauses);
        }
        self.at = start;
        if self.eat_any(&[
            "put yourself",
            "place yourself",
            "position yourself",
            "station yourself",
            "plant yourself",
            "park yourself",
        ]) {
            let at = self.eat_any(&["at", "by", "near", "close to", "next to", "beside"]);
            let side = if at { None } else { Some(super::clause::Spot::Beside(self.side()?, None)) };
            let to = self.reference(0).ok()?;
            return self.ends_clause().then(|| vec![go(to, side)]);
        }
        self.at = start;
        // Whom it is shown to makes no difference.
        if self.eat_any(&["show", "tell"]) {
            let place = (self.at..self.lexemes.len().min(self.at + 5))
                .find(|at| longest_phrase(&self.lexemes[*at..], &["where"]).is_some())?;
            self.at = place + 1;
            self.eat_any(&["they can find", "he can find", "she can find", "to find", "we can find"]);
            let at = self.reference(0).ok()?;
            self.eat_any(&["is", "are", "stands", "can be found"]);
            return self.ends_clause().then(|| vec![Clause::Point { at }]);
        }
        self.at = start;
        None
    }

    /// "Thank Agnes for me", "wish Emil a good day".
    fn kind_words(&mut self) -> Option<Vec<Clause>> {
        const WORDS: &[(&[&str], &str)] = &[
            (&["thank", "say thanks to"], "thank you"),
            (&["congratulate"], "congratulations"),
            (&["apologise to", "apologize to", "say you are sorry to"], "sorry"),
            (&["welcome"], "welcome"),
            (&["praise"], "well done"),
        ];
        let start = self.at;
        if let Some((words, count)) = super::lexicon::longest(self.rest(), WORDS) {
            self.at += count;
            if let Some(to) = self.somebody_here() {
                if longest_phrase(self.rest(), &["for me", "for us"]).is_none()
                    && self.eat_any(&["for", "on", "to"])
                {
                    self.at = self.mark_from(self.at);
                }
                return Some(vec![Clause::Say { to, words: words.to_owned() }]);
            }
        } else if self.eat_any(&["wish"])
            && let Some(to) = self.somebody_here()
        {
            self.eat_any(&["a", "a very"]);
            if let Ok(words) = self.speech(self.lexemes.len()) {
                return Some(vec![Clause::Say { to, words }]);
            }
        }
        self.at = start;
        None
    }

    /// "Let Marta know that the bus is late".
    fn lets_know(&mut self) -> Option<Vec<Clause>> {
        let start = self.at;
        if self.eat_any(&["let"])
            && let Some(to) = self.somebody_here()
            && self.eat_any(&["know that", "know", "hear that", "know about", "in on"])
            && !self.ends_at_mark()
            && let Ok(words) = self.speech(self.lexemes.len())
        {
            return Some(vec![Clause::Say { to, words }]);
        }
        self.at = start;
        None
    }

    /// "Slowly walk over to Anna": how fast, where it was said before the verb.
    pub(super) fn at_pace_before(&self, begin: usize, start: usize, mut clauses: Vec<Clause>) -> Vec<Clause> {
        // "Please, slowly walk": what stands right before the verb was passed over as politeness.
        let begin = begin.min(start.saturating_sub(1));
        let said = |words: &[&str]| {
            self.lexemes[begin..start]
                .iter()
                .any(|lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if words.contains(&word.as_str())))
        };
        let pace = if said(&["slowly"]) {
            Pace::Slow
        } else if said(&["quickly"]) {
            Pace::Run
        } else {
            return clauses;
        };
        if let [Clause::Go { pace: usual @ Pace::Usual, .. }] = &mut clauses[..] {
            *usual = pace;
        }
        clauses
    }

    /// "... or you'll miss the bus": what happens otherwise; whether there was any.
    pub(super) fn skip_threat(&mut self) -> bool {
        let start = self.at;
        self.at += usize::from(matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]));
        let said = longest_phrase(
            self.rest(),
            &[
                "or youll",
                "or you will",
                "or well",
                "or we will",
                "or ill",
                "or i will",
                "or theyll",
                "or they will",
                "or hell be",
                "or shell be",
                "or itll",
                "or it will",
                "or else ill",
                "or else you",
                "or else we",
                "or else it",
                "or else the",
                "or else youll",
                "or else well",
                "otherwise youll",
                "otherwise well",
                "otherwise it",
                "otherwise you",
                "otherwise we",
                "or he will",
                "or she will",
                "or someone will",
                "or somebody will",
                "otherwise ill",
                "otherwise i",
                "otherwise theyll",
            ],
        );
        let end = self.mark_from(self.at);
        let stated = said.is_some_and(|words| {
            longest_verb(&self.lexemes[(self.at + words).min(end)..end]).is_none()
                || self.words[self.lexemes[self.at].start..].contains("ll")
        });
        if !stated {
            self.at = start;
            return false;
        }
        self.at = end;
        true
    }
}
