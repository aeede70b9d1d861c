//! Sentences of several parts, some of which ask for nothing: "Ben is lonely; let Anna stand beside him", "the taxi should be
//! pink, the white one too".
//!
//! A part is a wish of its own, or one that leaves out what was said before it, or a remark. A remark says how things are or
//! why somebody wants something. What begins as an order does is none, nor what says how something should be, so that no
//! wish is passed over because its words are not understood.

use super::super::clause::Reference;
use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{longest, longest_phrase};
use super::follow::Said;
use super::parse::{Reader, joint};
use super::wish::Wish;
use super::words::{VERBS, Verb};

/// As many parts are tried in all; whoever says more is not understood.
const MOST_TRIED: usize = 160;
/// What begins a part beside the joints of wishes.
#[rustfmt::skip]
const CUTS: &[&str] = &["because", "since", "as", "so", "so that", "cause", "cos", "coz", "for", "while", "which", "where", "in order to", "due to", "given that",
    "seeing that", "considering", "or else", "otherwise", "have it", "have him", "have her", "have them"];
/// What begins a reason, which asks for nothing.
#[rustfmt::skip]
const REASONS: &[&str] = &["because", "since", "as", "so that", "cause", "cos", "coz", "for", "while", "in order to", "due to", "given that",
    "seeing that", "considering", "or else", "otherwise", "so people", "so everyone", "so they", "so we", "so i", "so nobody", "so the", "so it",
    "which is why", "thats why", "that is why", "in case", "on account of", "thanks to", "with all", "after all", "now that", "to", "which", "where",
    "so folks", "so everybody", "so kids", "so visitors", "so there", "so he", "so she", "even though", "although", "though"];
/// Who or what a remark may be about, at its start.
#[rustfmt::skip]
const SUBJECTS: &[&str] = &["i", "im", "ive", "id", "we", "were", "weve", "they", "theyre", "theyve", "you", "youre", "he", "hes", "she", "shes",
    "it", "its", "it is", "that", "thats", "this", "these", "those", "there", "theres", "nobody", "no one", "noone", "everybody", "everyone", "people",
    "somebody", "someone", "my", "our", "the", "a", "an", "all", "some", "most", "many", "his", "her", "their", "too many", "too much", "many", "much", "what a",
    "how", "such", "nothing", "everything", "something", "not enough", "no", "every", "each", "hardly anybody", "hardly anyone", "few", "both",
    "one", "so many", "so much", "here", "heres", "not a single", "folks", "kids", "children", "visitors", "customers", "students", "tourists",
    "pedestrians", "drivers", "guests", "in", "at", "on", "with", "behind", "near", "around", "outside", "next to", "by", "for", "from"];
/// Verbs of what is so.
#[rustfmt::skip]
const STATES: &[&str] = &["is", "are", "was", "were", "am", "isnt", "arent", "wasnt", "werent",
    "has", "have", "had", "hasnt", "havent", "ive", "weve", "theyve", "looks", "look", "looked", "feels", "feel", "seems", "seem", "keeps", "kept", "uses",
    "use", "used", "likes", "love", "loves", "loved", "hate", "hates", "hated", "cant", "cannot", "couldnt", "dont", "doesnt", "didnt", "wont", "wouldnt", "gives",
    "give", "makes", "made", "blocks", "block", "bothers", "bother", "annoys", "annoy", "said", "says", "say", "told", "asked", "asks", "complained", "complain",
    "complains", "saw", "see", "sees", "seen", "heard", "noticed", "fell", "falls", "fall", "broke", "breaks", "stinks", "stink", "smells", "smell", "trip", "trips",
    "tripping", "sit", "sits", "stands", "stand", "stood", "waits", "wait", "waiting", "came", "went", "got", "knows", "know",
    "thinks", "think", "thought", "spoils", "ruins", "ruined", "clashes", "clash", "matches", "match", "suits", "fits", 
    "wants", "want", "needs", "need",
    "lives", "works", "work", "arrives", "arrived", "starts", "starting", "begins", "hides", "hide", "misses", "miss", "lost", "moved",
    "takes", "took", "means", "costs", "cost", "runs", "ran", "drives", "drove", "parked", "parks", "died", "dead", "cry", "cries", "crying",
    "complaining", "prefer", "prefers", "remember", "forgot", "enough", "loving", "hating", "scares", "scare", "confuses", "confuse", "faces", "hangs", "lies",
    "shines", "glows", "burns", "grows", "attracts", "disturbs", "reminds", "remind", "happens", "happened", "ends", "hurts", "hurt", "eats", "eat", "drink", "play",
    "plays", "ride", "walk", "walks", "read", "rest", "shop", "wonder", "doubt", "guess", "bet", "swear", "promise", "am",
    "lacks", "lack", "stole", "stolen", "stood", "bought", "sold", "dropped", "crashed", "wrecked", "vandalised", "damaged", "ordered", "promised", "planned", "forgotten", "belongs", "stays", "stay", "leans", "leaks", "rusts", "rots", "creaks", "blends", "tend", "tends", "just", "always", "never", "wasn", "there", "aint", "nowhere", "hardly"];
/// Words by which a part asks for something, or says how something should be.
#[rustfmt::skip]
const ASKS: &[&str] = &["should", "must", "ought", "shall", "please", "let", "lets", "instead", "unless", "until", "except", "only", "if", "whenever", "has to",
    "have to", "needs to", "need to", "better", "add", "put", "remove", "delete", "paint", "would", "could", "rather", "supposed", "shouldnt", "mustnt",
    "each", "every", "to be", "to go", "to stand", "to have", "to get"];
/// Who does something in a remark, whatever it is.
#[rustfmt::skip]
const PEOPLE: &[&str] = &["nobody", "no one", "noone", "everybody", "everyone", "people", "somebody", "someone", "i", "we", "they", "he", "she", "folks", "kids", "students",
    "visitors", "customers", "tourists", "pedestrians", "drivers", "guests", "residents", "locals", "passersby", "children", "hardly anybody",
    "hardly anyone", "not everybody", "half the people"];
/// A subject and its verb in one word.
#[rustfmt::skip]
const SHORT: &[&str] = &["im", "its", "thats", "theres", "theyre", "youre", "hes", "shes", "ive", "weve", "theyve", "too many", "too much", "so many", "so much",
    "not enough", "what a", "such a", "no more room for", "nowhere", "hardly any", "quite some", "thanks to", "many", "much"];
/// Words that say what is to become of something.
#[rustfmt::skip]
const DEMANDS: &[&str] = &["removed", "deleted", "painted", "moved", "placed", "added", "installed", "gone", "away", "bigger", "smaller", "taller", "twice", "rotated", "turned", "swapped",
    "copied", "renamed", "called", "named", "closed", "shut", "off", "out", "replace", "replaced", "repainted", "relocated", "scaled", "resized", "doubled", "halved", "facing", "need", "needs", "want",
    "wants", "instead", "apiece", "each", "every", "except"];
/// As [`DEMANDS`], where nothing says how things are.
#[rustfmt::skip]
const ASKING: &[&str] = &["could", "can", "may", "might", "will", "if", "unless", "no", "not", "how", "which", "what", "who", "where", "wherever", "whichever", "whatever"];
/// Sounds and greetings that stand alone.
#[rustfmt::skip]
const CALLS: &[&str] = &["vroom", "beep", "boom", "wow", "ugh", "argh", "phew", "yay", "yikes", "oops", "hooray", "woof", "meow", "brr", "brrr", "ahoy", "ouch",
    "aha", "haha", "hurray", "yes", "yeah", "yep", "nope", "right", "great", "perfect", "good", "nice", "cool", "fine", "excellent", "lovely", "sorry", "honestly",
    "seriously", "quick", "hurry", "come on", "listen", "look", "attention", "oh dear", "oh no", "oh boy", "oh well", "my god", "good morning", "good evening",
    "good day", "hello there", "hi there", "hey there", "you know", "you know what", "guess what", "tell you what", "thats it", "there we go", "there you go",
    "very well", "much better", "good job", "well done", "nice one", "no", "whoa", "woah", "zoom", "honk", "ding dong", "boo", "bah", "meh", "gosh", "blimey", "damn",
    "dammit", "bonjour", "hola", "ciao", "moin", "servus", "sigh", "lol", "btw", "fyi", "asap", "new idea", "change of plan", "change of plans", "one last thing", "last thing",
    "one thing", "next thing", "first thing", "ok now", "alright then", "that said", "anyway", "anyhow", "still", "next", "too bad", "what a shame", "shame", "yuck", "eww", "ew", "the horror", "no way", "never mind"];

/// A search for the parts of a sentence.
struct Search<'a> {
    /// Whether somebody has what a wish asks for.
    is_known: &'a dyn Fn(&Wish) -> bool,
    /// Whether what the first wish is about is there.
    is_there: &'a dyn Fn(&[Vec<Wish>]) -> bool,
    tried: usize,
}

impl Reader<'_> {
    /// All wishes of a sentence whose parts hang together, or ask for nothing.
    pub(super) fn in_parts(
        &self,
        is_known: &dyn Fn(&Wish) -> bool,
        is_there: &dyn Fn(&[Vec<Wish>]) -> bool,
    ) -> Option<Vec<Vec<Wish>>> {
        let mut search = Search { is_known, is_there, tried: 0 };
        let found = self.parts_from(0, &Said::default(), &[], &mut search)?;
        (!found.is_empty()).then_some(found)
    }

    fn parts_from(
        &self,
        from: usize,
        said: &Said,
        spoken_of: &[Reference],
        search: &mut Search<'_>,
    ) -> Option<Vec<Vec<Wish>>> {
        let mut start = Reader { at: from, ..*self };
        // "Everyone" may be spoken to, or be who a remark is about.
        let remark = from + self.lexemes[from..].iter().take_while(|lexeme| is_mark(lexeme)).count();
        start.skip_joints_to(self.lexemes.len());
        let from = start.at;
        if from >= self.lexemes.len() {
            return Some(Vec::new());
        }
        let cuts = self.cuts(from);
        for end in cuts.iter().rev().copied() {
            search.tried += 1;
            if search.tried > MOST_TRIED || self.memo.is_spent() {
                return None;
            }
            let mut part = Reader { at: from, ..self.up_to(end) };
            let Some(mut wishes) = part.part(said, end) else { continue };
            let is_first = said.wish.is_none() && spoken_of.is_empty();
            if !wishes.iter().flatten().all(search.is_known) || is_first && !(search.is_there)(&wishes) {
                continue;
            }
            let with = from > 0 && self.word(from - 1) == Some("with");
            wishes.iter_mut().flatten().for_each(|wish| {
                if let Some(before) = &said.wish {
                    super::shared::on_street(before, wish, with);
                }
                wish.is_about(spoken_of);
                wish.stands(&said.place);
            });
            let now = Said {
                wish: wishes.last().and_then(|readings| readings.first().cloned()),
                noun: self.last_noun(from, end).or_else(|| said.noun.clone()),
                place: Vec::new(),
            };
            if let Some(rest) = self.parts_from(end, &now, &[], search) {
                wishes.extend(rest);
                return Some(wishes);
            }
        }
        // A remark ends at any of the next marks: "the crate, I think, is ugly".
        for end in cuts.iter().copied().take(4) {
            let is_heading = said.wish.is_none() && end < self.lexemes.len() && self.is_heading(from, end);
            // "Bruno wants to watch Carol, turn him".
            let is_said_twice = matches!(
                said.wish,
                Some(Wish::Face { .. } | Wish::Rotate { .. } | Wish::Move { .. } | Wish::Swap { .. })
            ) && longest_phrase(
                &self.lexemes[from..end],
                &[
                    "turn him",
                    "turn her",
                    "turn it",
                    "turn them",
                    "rotate him",
                    "rotate her",
                    "rotate it",
                    "rotate them",
                    "move him",
                    "move her",
                    "move it",
                    "move them",
                    "do it",
                    "do that",
                    "so turn him",
                    "so turn her",
                    "so turn it",
                    "so move it",
                    "swap them",
                    "switch them",
                ],
            ) == Some(self.before_politeness(from, end) - from);
            if !is_said_twice
                && !is_heading
                && !self.is_remark(from, end)
                && !self.is_remark(remark.min(from), end)
            {
                continue;
            }
            let mut things = self.spoken_of(from, end);
            // "There is nowhere to sit near the table": it is the table.
            if (from..end).any(|at| self.word(at) == Some("nowhere"))
                && let Some([super::wish::Where::To(_, super::wish::Anchor::Thing(near))]) =
                    self.place_spoken_of(from, end).as_deref()
            {
                things = vec![near.clone()];
            }
            if things.is_empty() {
                things = spoken_of.to_vec();
            }
            let lacks = self.noun_lacking(from, end);
            let noun = lacks.or_else(|| self.last_noun(from, end)).or_else(|| said.noun.clone());
            let place = self
                .place_spoken_of(from, end)
                .or_else(|| self.subject_place(from, end))
                .unwrap_or_else(|| said.place.clone());
            let now = Said { noun, place, ..said.clone() };
            if let Some(rest) = self.parts_from(end, &now, &things, search) {
                return Some(rest);
            }
        }
        None
    }

    /// One part, all of its words.
    fn part(&mut self, said: &Said, end: usize) -> Option<Vec<Vec<Wish>>> {
        if let Some(wishes) = self.more_of_it(said, end) {
            return Some(wishes);
        }
        let start = self.at;
        let stop = self.before_politeness(start, end);
        if let Some(wish) = self.mended(stop) {
            return Some(vec![vec![wish]]);
        }
        if let Ok(wishes) = self.wish(end)
            && self.at >= stop
        {
            return Some(wishes);
        }
        self.at = start;
        if let Some(wishes) = self.follows(said, end).or_else(|| self.same_of(said, start, stop)) {
            return Some(wishes);
        }
        // "Swap the red bench with the blue one".
        let own = Said { noun: self.last_noun(start, end), ..Said::default() };
        self.with_noun(&own, start, end).and_then(|order| self.read_anew(&order))
    }

    /// "Fix that with a bench".
    fn mended(&self, end: usize) -> Option<Wish> {
        #[rustfmt::skip]
        const MENDS: &[&str] = &["fix that with", "fix it with", "fix this with", "solve that with", "solve it with", "solve this with", "remedy that with", "change that with",
            "sort that out with", "sort it out with", "help with", "fix that by adding", "fix it by adding", "change that by adding", "so fix that with", "cure that with",
            "mend that with", "deal with that by adding", "fix that by putting", "help them with", "help out with", "make up for it with", "brighten it up with",
            "liven it up with", "cheer it up with", "spruce it up with", "spice it up with", "complete it with", "what about", "how about", "why not"];
        let words = longest_phrase(&self.lexemes[self.at..end], MENDS)?;
        let mut reader = Reader { at: self.at + words, ..self.up_to(end) };
        if reader.is_definite(reader.at) {
            return None;
        }
        let thing = reader.new_thing(end).ok().filter(|_| reader.at >= end)?;
        Some(Wish::Add { things: vec![thing], at: Vec::new() })
    }

    /// Where a part that begins here may end, the nearest first.
    fn cuts(&self, from: usize) -> Vec<usize> {
        let all = self.lexemes.len();
        let is_cut = |at: &usize| {
            is_mark(&self.lexemes[*at])
                || !self.is_place(*at)
                    && (joint(&self.lexemes[*at..]).is_some()
                        || longest_phrase(&self.lexemes[*at..], CUTS).is_some()
                        || self.runs_on(from, *at)
                        || self.is_purpose(from, *at))
        };
        (from + 1..all).filter(is_cut).chain([all]).collect()
    }

    /// "The bin is full put another one beside it": an order behind a remark with no mark between.
    fn runs_on(&self, from: usize, at: usize) -> bool {
        #[rustfmt::skip]
        const BEFORE: &[&str] = &["to", "and", "should", "could", "can", "must", "will", "you", "not", "dont", "lets", "let", "have", "would", "may", "i", "we", "please", "just", "then", "or", "never", "also", "be", "the", "a", "so", "because", "since", "therefore"];
        #[rustfmt::skip]
        const ORDERS: &[&str] = &["put", "move", "get", "get rid of", "take", "remove", "paint", "make", "turn", "add", "give", "shift", "swap", "please", "throw", "bin", "delete", "bring", "send", "replace", "scrap", "lose",
            "say", "colour", "place", "set", "push", "pull", "drag", "tow"];
        let Some(words) = longest_phrase(&self.lexemes[at..], ORDERS).filter(|_| at > from + 2) else {
            return false;
        };
        let what = longest_phrase(
            &self.lexemes[at + words..],
            &[
                "it", "them", "him", "her", "another", "one", "a", "an", "two", "three", "some", "that",
                "put", "move", "take", "remove", "get", "make", "paint", "turn",
            ],
        );
        what.is_some() && self.word(at - 1).is_some_and(|word| !BEFORE.contains(&word))
    }

    /// Whether "to" says here what for: no place begins with it, and no verb wants it.
    fn is_purpose(&self, from: usize, at: usize) -> bool {
        #[rustfmt::skip]
        const BEFORE: &[&str] = &["next", "close", "left", "right", "over", "up", "has", "have", "had", "need", "needs", "want", "wants", "like", "love",
            "ought", "going", "supposed", "closer", "nearer", "nearest", "closest", "near", "opposite", "adjacent", "on", "used", "wish", "try", "back"];
        self.word(at) == Some("to")
            && at > from + 1
            && self.word(at - 1).is_none_or(|word| !BEFORE.contains(&word))
            && self.word(at + 1).is_some()
            && !self.is_place(at)
    }

    /// Whether some words ask for nothing.
    pub(super) fn is_remark(&self, from: usize, end: usize) -> bool {
        let words = &self.lexemes[from..end];
        let is_word = |at: usize, list: &[&str]| self.word(at).is_some_and(|word| list.contains(&word));
        let whole = |phrases: &[&str]| longest_phrase(words, phrases) == Some(words.len());
        if whole(CALLS) || words.len() <= 3 && (from..end).all(|at| is_word(at, CALLS)) {
            return true;
        }
        // A thing that is spoken of next: "the cone? I don't need it".
        if words.len() <= 6
            && from == 0
            && self.lexemes.get(end).is_some_and(is_mark)
            && self.is_definite(from)
            && self.one_of(from, end).is_ok_and(|what| !super::follow::is_open(&what))
        {
            return true;
        }
        let dislikes = longest_phrase(
            words,
            &[
                "i dont like",
                "we dont like",
                "i do not like",
                "we do not like",
                "i hate",
                "we hate",
                "i dont want",
                "we dont want",
                "nobody likes",
                "i cant stand",
                "we cant stand",
            ],
        )
        .is_some()
            && (from..end).any(|at| {
                longest_phrase(&self.lexemes[at..end], super::ordered::WHERE_IT_IS) == Some(end - at)
            });
        if dislikes {
            return true;
        }
        if longest(words, VERBS)
            .is_some_and(|(verb, _)| !matches!(verb, Verb::Name | Verb::Describe | Verb::List))
        {
            return false;
        }
        if end < self.lexemes.len()
            && (self.is_lack(from, self.before_politeness(from, end)) || self.lacks_something(from, end))
        {
            return true;
        }
        // "As soon as there is a dragon" is a condition.
        if longest_phrase(words, &["as soon as", "as long as", "as far as", "as if"]).is_some() {
            return false;
        }
        if let Some(reason) = longest_phrase(words, REASONS) {
            let behind = from + reason;
            let is_plain =
                ["for", "due to", "thanks to", "on account of", "in case", "in order to", "because of", "to"]
                    .iter()
                    .any(|word| super::super::lexicon::fits(words, word).is_some());
            let states = (behind..end).any(|at| is_word(at, STATES));
            let somewhere = || (behind..end).any(|at| self.is_place(at) && self.places_to(at, end).is_some());
            if !states && (!is_plain || somewhere()) {
                return false;
            }
            return behind < end
                && !self.is_place(from)
                && !self.asks(behind, end)
                && !self.is_order(behind, end);
        }
        let tells_time = |at: usize| {
            super::sky::hour(&self.lexemes[at..end]).is_some_and(|(_, words)| {
                words > 1
                    && longest_phrase(
                        &self.lexemes[at + words - 1..end],
                        &["pm", "am", "evening", "morning", "afternoon", "oclock", "m", "clock"],
                    )
                    .is_some()
            })
        };
        if (from..end).any(tells_time) {
            return false;
        }
        if self.wants_something_there(from, end)
            || self.is_place(from) && longest_phrase(words, &["to"]).is_some()
        {
            return false;
        }
        // "Across from the hospital people are hungry".
        if self.is_place(from) {
            let mut reader = Reader { at: from, ..self.up_to(end) };
            if reader.place(end).is_ok()
                && reader.at < end
                && reader.at > from
                && self.is_remark(reader.at, end)
            {
                return true;
            }
        }
        let about = longest_phrase(words, SUBJECTS).is_some() || self.one_begins(from, end);
        let states = longest_phrase(words, PEOPLE).is_some_and(|who| who + 1 < words.len())
            || (from..end).any(|at| is_word(at, STATES))
            || longest_phrase(words, SHORT).is_some();
        about && states && !self.asks(from, end)
    }

    /// What stands before a mark that ends a sentence, and neither asks for anything nor names a new thing and its place: "craft
    /// fair!", "market day tomorrow, so", "the waterfront lacks seating:".
    fn is_heading(&self, from: usize, end: usize) -> bool {
        // "The parade forms up outside the school, so four coaches ...".
        let is_so = |at: usize| self.word(at) == Some("so") && self.word(at + 1) != Some("that");
        // "Hot dog time, get a food cart ...".
        let is_time = end > from
            && end - from <= 5
            && self.lexemes.get(end).is_some_and(is_mark)
            && matches!(
                self.word(end - 1),
                Some(
                    "time"
                        | "day"
                        | "night"
                        | "season"
                        | "week"
                        | "party"
                        | "tomorrow"
                        | "tonight"
                        | "today"
                        | "weekend"
                        | "festival"
                        | "fair"
                )
            )
            && super::sky::hour(&self.lexemes[from..end]).is_none()
            && longest(&self.lexemes[end - 1..end], super::words::SKIES).is_none_or(|_| end - from > 1);
        let ends = is_time
            || self.lexemes.get(end).is_some_and(|lexeme| lexeme.token == Token::Break)
            || is_so(end)
            || self.lexemes.get(end).is_some_and(is_mark) && is_so(end + 1);
        let is_change = |at: usize| {
            let verb = longest(&self.lexemes[at..end], VERBS).map(|(verb, _)| verb);
            verb.is_some_and(|verb| !matches!(verb, Verb::Name | Verb::Describe | Verb::List | Verb::Add))
                || self.word(at).is_some_and(|word| DEMANDS.contains(&word))
        };
        // A verb stands first, behind "and" or "to", or behind who is spoken to.
        let may_order = |at: usize| {
            at == from
                || is_mark(&self.lexemes[at - 1])
                || matches!(
                    self.word(at - 1),
                    Some("and" | "to" | "then" | "please" | "you" | "just" | "now" | "so" | "be")
                )
        };
        let places = || (from + 1..end).any(|at| self.is_place(at) && self.places_to(at, end).is_some());
        let is_new = !self.is_definite(from) || self.is_bare_plural(from, end);
        let states = (from..end).any(|at| self.word(at).is_some_and(|word| STATES.contains(&word)));
        let is_asking = |at: usize| self.word(at).is_some_and(|word| ASKING.contains(&word));
        if !states && (from..end).any(is_asking)
            || longest_phrase(&self.lexemes[from..end], &["if", "unless", "when", "should"]).is_some()
        {
            return false;
        }
        let is_plain = states || !(is_new && places()) && self.spoken_of(from, end).is_empty();
        ends && !self.asks(from, end)
            && !(from..end).any(|at| may_order(at) && is_change(at))
            && !(from..end).any(|at| self.word(at).is_some_and(|word| DEMANDS.contains(&word)))
            && is_plain
    }

    /// "Carol wants a bench next to her": more than how somebody feels.
    fn wants_something_there(&self, from: usize, end: usize) -> bool {
        (from + 1..end).any(|at| {
            longest_phrase(&self.lexemes[at..end], super::says::LACKS).is_some_and(|words| {
                // "They want somewhere to eat" names nothing.
                let is_open = matches!(
                    self.word(at + words),
                    Some("somewhere" | "something" | "nowhere" | "anything" | "nothing")
                );
                !is_open
                    && (at + words + 1..end).any(|at| self.is_place(at) && self.places_to(at, end).is_some())
            })
        })
    }

    /// Whether a name or a thing of the scene stands first.
    pub(super) fn one_begins(&self, from: usize, end: usize) -> bool {
        let mut parser = self.parser(from, end);
        parser.reference(0).is_ok() && parser.at > from
    }

    fn asks(&self, from: usize, end: usize) -> bool {
        // "They look better that way".
        const SO: &[&str] = &[
            "better that way",
            "better like that",
            "better this way",
            "better then",
            "better so",
            "better like this",
        ];
        !self.longs(from, end)
            && (from..end).any(|at| {
                longest_phrase(&self.lexemes[at..end], ASKS).is_some()
                    && longest_phrase(&self.lexemes[at..end], SO).is_none()
            })
    }

    /// "Bo would like very much to sit": what somebody would like to do, which is done to nothing.
    fn longs(&self, from: usize, end: usize) -> bool {
        const ACTS: &[&str] = &[
            "sit", "rest", "eat", "drink", "read", "play", "relax", "swim", "sleep", "nap", "wait", "lunch",
            "picnic", "cycle", "ride", "climb", "exercise", "cool", "warm", "chat", "camp", "barbecue",
            "grill", "paint",
        ];
        let act = (from + 1..end).find(|at| {
            self.word(*at - 1) == Some("to") && self.word(*at).is_some_and(|word| ACTS.contains(&word))
        });
        act.is_some_and(|act| {
            (from..act).any(|at| {
                matches!(
                    self.word(at),
                    Some(
                        "would"
                            | "wants"
                            | "want"
                            | "likes"
                            | "like"
                            | "love"
                            | "loves"
                            | "needs"
                            | "need"
                            | "has"
                            | "have"
                    )
                )
            }) && !(act..end).any(|at| self.is_place(at) && self.places_to(at, end).is_some() && at > act + 1)
        })
    }

    /// Whether an order stands here, understood or not.
    fn is_order(&self, from: usize, end: usize) -> bool {
        longest(&self.lexemes[from..end], VERBS).is_some_and(|(verb, _)| {
            !matches!(
                verb,
                Verb::Name | Verb::Describe | Verb::List | Verb::Make | Verb::Take | Verb::Put | Verb::Move
            )
        })
    }

    /// The words without a reason at their end: "..., so that people can rest".
    pub(super) fn before_reason(&self, from: usize, end: usize) -> Option<usize> {
        (from + 2..end)
            .find(|at| longest_phrase(&self.lexemes[*at..end], REASONS).is_some() && self.is_remark(*at, end))
    }
}

/// Whether a token is a mark.
pub(super) const fn is_mark(lexeme: &Lexeme) -> bool {
    matches!(lexeme.token, Token::Comma | Token::Break)
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let lists = [CUTS, REASONS, SUBJECTS, STATES, CALLS, ASKS];
    lists.into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}
