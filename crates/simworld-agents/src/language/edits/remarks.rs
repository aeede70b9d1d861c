//! Remarks: parts of a sentence that ask for nothing. A remark says how things are or why somebody wants something. What begins as an
//! order does is none, nor what says how something should be, so that no wish is passed over because its words are not understood.

use super::super::lexer::{Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::wish::Where;
use super::words::{VERBS, Verb};

/// What begins a reason, which asks for nothing.
#[rustfmt::skip]
const REASONS: &Phrases = &Phrases::of(&["because", "since", "as", "so that", "cause", "cos", "coz", "for", "while", "in order to", "due to", "given that",
    "seeing that", "considering", "or else", "otherwise", "so people", "so everyone", "so they", "so we", "so i", "so nobody", "so the", "so it",
    "which is why", "thats why", "that is why", "in case", "on account of", "thanks to", "with all", "after all", "now that", "to", "which", "where",
    "so folks", "so everybody", "so kids", "so visitors", "so there", "so he", "so she", "even though", "although", "though"]);
/// Who or what a remark may be about, at its start.
#[rustfmt::skip]
const SUBJECTS: &Phrases = &Phrases::of(&["i", "im", "ive", "id", "we", "were", "weve", "they", "theyre", "theyve", "you", "youre", "he", "hes", "she", "shes",
    "it", "its", "it is", "that", "thats", "this", "these", "those", "there", "theres", "nobody", "no one", "noone", "everybody", "everyone", "people",
    "somebody", "someone", "my", "our", "the", "a", "an", "all", "some", "most", "many", "his", "her", "their", "too many", "too much", "many", "much", "what a",
    "how", "such", "nothing", "everything", "something", "not enough", "no", "every", "each", "hardly anybody", "hardly anyone", "few", "both",
    "one", "so many", "so much", "here", "heres", "not a single", "folks", "kids", "children", "visitors", "customers", "students", "tourists",
    "pedestrians", "drivers", "guests", "in", "at", "on", "with", "behind", "near", "around", "outside", "next to", "by", "for", "from"]);
/// Verbs of what is so.
#[rustfmt::skip]
const STATES: &Phrases = &Phrases::of(&["is", "are", "was", "were", "am", "isnt", "arent", "wasnt", "werent",
    "has", "have", "had", "hasnt", "havent", "ive", "weve", "theyve", "looks", "look", "looked", "goes without", "go without", "comes later", "keep", "feels", "feel", "seems", "seem", "keeps", "kept", "uses",
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
    "lacks", "lack", "stole", "stolen", "stood", "bought", "sold", "dropped", "crashed", "wrecked", "vandalised", "damaged", "ordered", "promised", "planned", "forgotten", "belongs", "stays", "stay", "leans", "leaks", "rusts", "rots", "creaks", "blends", "tend", "tends", "just", "always", "never", "wasn", "there", "aint", "nowhere", "hardly"]);
/// Words by which a part asks for something, or says how something should be.
#[rustfmt::skip]
const ASKS: &Phrases = &Phrases::of(&["should", "must", "ought", "shall", "please", "let", "lets", "instead", "unless", "until", "except", "only", "if", "whenever", "has to",
    "have to", "needs to", "need to", "better", "add", "put", "remove", "delete", "paint", "would", "could", "rather", "supposed", "shouldnt", "mustnt",
    "each", "every", "to be", "to go", "to stand", "to have", "to get"]);
/// Who does something in a remark, whatever it is.
#[rustfmt::skip]
const PEOPLE: &Phrases = &Phrases::of(&["nobody", "no one", "noone", "everybody", "everyone", "people", "somebody", "someone", "i", "we", "they", "he", "she", "folks", "kids", "students",
    "visitors", "customers", "tourists", "pedestrians", "drivers", "guests", "residents", "locals", "passersby", "children", "hardly anybody",
    "hardly anyone", "not everybody", "half the people"]);
/// A subject and its verb in one word.
#[rustfmt::skip]
const SHORT: &Phrases = &Phrases::of(&["im", "its", "thats", "theres", "theyre", "youre", "hes", "shes", "ive", "weve", "theyve", "too many", "too much", "so many", "so much",
    "not enough", "what a", "such a", "no more room for", "nowhere", "hardly any", "quite some", "thanks to", "many", "much"]);
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
const CALLS: &Phrases = &Phrases::of(&["vroom", "beep", "boom", "wow", "ugh", "argh", "phew", "yay", "yikes", "oops", "hooray", "woof", "meow", "brr", "brrr", "ahoy", "ouch",
    "aha", "haha", "hurray", "yes", "yeah", "yep", "nope", "right", "great", "perfect", "good", "nice", "cool", "fine", "excellent", "lovely", "sorry", "honestly",
    "seriously", "quick", "hurry", "come on", "listen", "look", "attention", "oh dear", "oh no", "oh boy", "oh well", "my god", "good morning", "good evening",
    "good day", "hello there", "hi there", "hey there", "you know", "you know what", "guess what", "tell you what", "thats it", "there we go", "there you go",
    "very well", "much better", "good job", "well done", "nice one", "no", "whoa", "woah", "zoom", "honk", "ding dong", "boo", "bah", "meh", "gosh", "blimey", "damn",
    "dammit", "bonjour", "hola", "ciao", "moin", "servus", "sigh", "lol", "btw", "fyi", "asap", "new idea", "change of plan", "change of plans", "one last thing", "last thing",
    "one thing", "next thing", "first thing", "ok now", "alright then", "that said", "anyway", "anyhow", "still", "next", "no rush", "no hurry", "take your time", "when you have time", "whenever you have time", "thats all", "that is all", "too bad", "what a shame", "shame", "yuck", "eww", "ew", "the horror", "no way", "never mind", "off they go", "off it goes", "so off they go", "so off it goes", "off you go", "hang on"]);

impl Reader<'_> {
    /// Whether some words ask for nothing.
    pub(super) fn is_remark(&self, from: usize, end: usize) -> bool {
        let words = &self.lexemes[from..end];
        if self.orders_within(from, end) || self.goes_on_within(from, end) || self.is_old_place(from, end) {
            return false;
        }
        if self.is_enough(from, end)
            || self.is_call(from, end)
            || self.is_named_alone(from, end)
            || self.dislikes(from, end)
            || self.praises(from, end)
        {
            return true;
        }
        if longest(words, &VERBS)
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
            return self.is_reason(from, from + reason, end);
        }
        if self.tells_time(from, end)
            || self.wants_something_there(from, end)
            || self.is_place(from) && longest_phrase(words, &["to"]).is_some()
        {
            return false;
        }
        self.is_remark_at_a_place(from, end) || self.states(from, end) && !self.asks(from, end)
    }

    /// "They stink to high heaven, and make the postbox yellow": an order behind a mark, which is no part of a remark.
    fn orders_within(&self, from: usize, end: usize) -> bool {
        (from + 1..end).any(|at| {
            is_mark(&self.lexemes[at])
                && longest_phrase(&self.lexemes[at + 1..end], &["and", "then", "and then"]).is_some_and(
                    |words| {
                        longest_phrase(
                            &self.lexemes[at + 1 + words..end],
                            &[
                                "make", "put", "add", "remove", "paint", "move", "turn", "delete", "rotate",
                                "swap", "place", "close",
                            ],
                        )
                        .is_some()
                    },
                )
        })
    }

    /// "Where the white one stood" is a place, and no reason.
    fn is_old_place(&self, from: usize, end: usize) -> bool {
        self.word(from) == Some("where") && self.stood(from).is_some_and(|(_, stop)| stop >= end)
    }

    /// "Oh dear": sounds and greetings.
    fn is_call(&self, from: usize, end: usize) -> bool {
        let is_word = |at: usize| self.word(at).is_some_and(|word| CALLS.contains(word));
        longest_phrase(&self.lexemes[from..end], CALLS) == Some(end - from)
            || end - from <= 3 && (from..end).all(is_word)
    }

    /// "That would look nice": what somebody thinks of what was asked for.
    fn praises(&self, from: usize, end: usize) -> bool {
        #[rustfmt::skip]
        const WOULD: &Phrases = &Phrases::of(&["that would look", "that would be", "it would look", "it would be", "that should look", "that should be", "that will look", "that will be", "this would look", "this would be", "that might be", "that might look", "thatd be", "thatd look",
            "that would make me", "that would make us", "that would make everybody", "that would help", "that should do", "that should help"]);
        #[rustfmt::skip]
        const NICE: &[&str] = &["nice", "great", "good", "lovely", "perfect", "wonderful", "cool", "fine", "cute", "sweet", "pretty", "beautiful", "fun", "funny", "helpful", "useful", "happy", "awesome", "fantastic", "amazing", "ideal", "charming", "brilliant", "best", "enough", "better",
            "us", "me", "everybody", "people", "it", "grand", "splendid", "fab", "kind"];
        longest_phrase(&self.lexemes[from..end], WOULD).is_some_and(|words| {
            let behind = &self.lexemes[from + words..end];
            behind.len() <= 4
                && (behind.is_empty()
                    || behind.iter().any(
                        |lexeme| matches!(&lexeme.token, Token::Word(word) if NICE.contains(&word.as_str())),
                    ))
        })
    }

    /// Things that are spoken of next: "the cone? I don't need it", "about the cars, paint ...".
    fn is_named_alone(&self, from: usize, end: usize) -> bool {
        const ABOUT: &[&str] = &[
            "about",
            "as for",
            "regarding",
            "concerning",
            "as to",
            "speaking of",
            "when it comes to",
            "as regards",
            "on the subject of",
        ];
        let from = from + longest_phrase(&self.lexemes[from..end], ABOUT).unwrap_or(0);
        let is_first = (0..from).all(|at| self.word(at).is_some_and(|word| word != "and"));
        from < end
            && end - from <= 8
            && is_first
            && self.lexemes.get(end).is_some_and(is_mark)
            && self.is_definite(from)
            && self.things(from, end).is_ok_and(|what| !what.iter().any(super::follow::is_open))
    }

    /// "I don't like the truck where it is".
    fn dislikes(&self, from: usize, end: usize) -> bool {
        const LOOKS: &[&str] = &[
            "the colour of",
            "the color of",
            "the look of",
            "the looks of",
            "the size of",
            "the shape of",
            "the paint on",
        ];
        #[rustfmt::skip]
        const DISLIKES: &Phrases = &Phrases::of(&["i dont like", "we dont like", "i do not like", "we do not like", "i hate", "we hate", "i dont want", "we dont want", "nobody likes", "i cant stand", "we cant stand"]);
        longest_phrase(&self.lexemes[from..end], DISLIKES).is_some()
            && (from..end).any(|at| {
                longest_phrase(&self.lexemes[at..end], super::ordered::WHERE_IT_IS) == Some(end - at)
                    || longest_phrase(&self.lexemes[at..end], LOOKS).is_some()
            })
    }

    /// Whether what begins as a reason is one: behind its first words something is so, or is for something.
    fn is_reason(&self, from: usize, behind: usize, end: usize) -> bool {
        let words = &self.lexemes[from..end];
        let is_plain =
            ["for", "due to", "thanks to", "on account of", "in case", "in order to", "because of", "to"]
                .iter()
                .any(|word| super::super::lexicon::fits(words, word).is_some());
        let states = (behind..end).any(|at| self.word(at).is_some_and(|word| STATES.contains(word)));
        let somewhere = || (behind..end).any(|at| self.is_place(at) && self.places_to(at, end).is_some());
        // "For Ada, and one for Bo" is more than what for.
        let goes_on = (behind..end).any(|at| {
            let next = at + super::parse::joint(&self.lexemes[at..end]).unwrap_or(0);
            // "For the crew, and a dog next to Ada".
            let is_new = || {
                let noun = (next + 1).min(end);
                longest_phrase(&self.lexemes[next..end], &["a", "an", "some"]).is_some()
                    && self.names.asset_words(&self.lexemes[noun..end]).is_some()
                    && (noun..end).any(|at| self.is_place(at))
            };
            next > at
                && next < end
                && (longest_phrase(&self.lexemes[next..end], &["one", "two", "three", "another"]).is_some()
                    || is_new())
        });
        // "The bench which is closest to the bin" says which.
        let is_which = self.word(from) == Some("which")
            && (behind..end).any(|at| {
                self.is_place(at)
                    || matches!(self.word(at), Some("closest" | "nearest" | "farthest" | "next"))
            });
        if is_which {
            return false;
        }
        // "So that he faces the lab" says how he is to stand.
        let faces = (behind..end).any(|at| matches!(self.word(at), Some("faces" | "face" | "facing")));
        if goes_on || faces && self.word(from) == Some("so") {
            return false;
        }
        if !states && (!is_plain || somewhere()) {
            return false;
        }
        behind < end && !self.is_place(from) && !self.asks(behind, end) && !self.is_order(behind, end)
    }

    /// "It is half past eight in the morning" sets the clock.
    fn tells_time(&self, from: usize, end: usize) -> bool {
        (from..end).any(|at| {
            super::sky::hour(&self.lexemes[at..end]).is_some_and(|(_, words)| {
                words > 1
                    && longest_phrase(
                        &self.lexemes[at + words - 1..end],
                        &["pm", "am", "evening", "morning", "afternoon", "oclock", "m", "clock"],
                    )
                    .is_some()
            })
        })
    }

    /// "Across from the hospital people are hungry".
    fn is_remark_at_a_place(&self, from: usize, end: usize) -> bool {
        self.is_place(from) && self.place_before_remark(from, end).is_some()
    }

    /// A place and a remark behind it: the words of the place are those that leave a remark.
    pub(super) fn place_before_remark(&self, from: usize, end: usize) -> Option<(Where, usize)> {
        let mut reader = Reader { at: from, ..self.up_to(end) };
        if let Ok(place) = reader.place(end)
            && reader.at > from
            && reader.at < end
            && self.is_remark(reader.at, end)
        {
            return Some((place, reader.at));
        }
        // "In front of Blue Spoon people are queueing" is no place before "Blue Spoon people".
        (from + 2..end.min(from + LONGEST_PLACE)).rev().find_map(|cut| {
            let mut reader = Reader { at: from, ..self.up_to(cut) };
            let place = reader.place(cut).ok().filter(|_| reader.at == cut)?;
            self.is_remark(cut, end).then_some((place, cut))
        })
    }

    /// Whether somebody or something is said to be or to do something.
    pub(super) fn states(&self, from: usize, end: usize) -> bool {
        let words = &self.lexemes[from..end];
        let about = longest_phrase(words, SUBJECTS).is_some() || self.one_begins(from, end);
        about
            && (longest_phrase(words, PEOPLE).is_some_and(|who| who + 1 < words.len())
                || (from..end).any(|at| self.word(at).is_some_and(|word| STATES.contains(word)))
                || longest_phrase(words, SHORT).is_some()
                || self.does_something(from, end))
    }

    /// "Bruno barks at the robot": a certain thing, and behind it a verb that asks for nothing here.
    fn does_something(&self, from: usize, end: usize) -> bool {
        let mut parser = self.parser(from, end);
        if !self.is_certain(from) || parser.reference(0).is_err() || parser.at <= from || parser.at >= end {
            return false;
        }
        self.word(parser.at).is_some_and(|word| {
            let is_known = super::says::is_between(word) || DEMANDS.contains(&word);
            let stem = word.strip_suffix("es").filter(|stem| VERBS.begins(stem)).or(word.strip_suffix('s'));
            stem.is_some_and(|stem| stem.len() > 2 && !stem.ends_with('s') && !VERBS.begins(stem))
                && !is_known
                && longest_phrase(&self.lexemes[parser.at..end], super::says::LACKS).is_none()
                && super::super::lexicon::category(&self.lexemes[parser.at..end]).is_none()
        })
    }

    /// What stands before a mark that ends a sentence, and neither asks for anything nor names a new thing and its place: "craft
    /// fair!", "market day tomorrow, so", "the waterfront lacks seating:".
    pub(super) fn is_heading(&self, from: usize, end: usize) -> bool {
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
            && longest(&self.lexemes[end - 1..end], &super::words::SKIES).is_none_or(|_| end - from > 1);
        let ends = is_time
            || self.lexemes.get(end).is_some_and(|lexeme| lexeme.token == Token::Break)
            || is_so(end)
            || self.lexemes.get(end).is_some_and(is_mark) && is_so(end + 1);
        let is_change = |at: usize| {
            let verb = longest(&self.lexemes[at..end], &VERBS).map(|(verb, _)| verb);
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
        let states = (from..end).any(|at| self.word(at).is_some_and(|word| STATES.contains(word)));
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
                // "The paint there is wet", "they distract each other".
                let is_noun = at > from
                    && matches!(self.word(at - 1), Some("the" | "this" | "that" | "our" | "my" | "its"));
                longest_phrase(&self.lexemes[at..end], ASKS).is_some_and(|words| words > 1 || !is_noun)
                    && longest_phrase(&self.lexemes[at..end], SO).is_none()
                    && longest_phrase(&self.lexemes[at..end], &["each other", "one another"]).is_none()
            })
    }

    /// "Bo would like very much to sit": what somebody would like to do, which is done to nothing.
    fn longs(&self, from: usize, end: usize) -> bool {
        const ACTS: &Phrases = &Phrases::of(&[
            "sit", "rest", "eat", "drink", "read", "play", "relax", "swim", "sleep", "nap", "wait", "lunch",
            "picnic", "party", "break", "meal", "cycle", "ride", "climb", "exercise", "cool", "warm", "chat",
            "camp", "barbecue", "grill", "paint",
        ]);
        let act = (from + 1..end).find(|at| {
            // "To have a picnic".
            let has = self.word(*at - 1) == Some("to")
                || *at > from + 3 && longest_phrase(&self.lexemes[at - 3..*at], &["to have a"]).is_some();
            has && self.word(*at).is_some_and(|word| ACTS.contains(word))
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
        longest(&self.lexemes[from..end], &VERBS).is_some_and(|(verb, _)| {
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

/// A place before a remark has no more words than that.
const LONGEST_PLACE: usize = 10;

/// Whether a word says how something is, or what somebody does.
pub(super) fn is_state(word: &str) -> bool {
    STATES.contains(word)
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let lists = [REASONS, SUBJECTS, STATES, CALLS, ASKS];
    lists.into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}
