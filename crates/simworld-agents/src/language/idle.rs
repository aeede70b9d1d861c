//! What is said before or behind an order and asks for nothing, whatever it says: "..., dinner takes a while", "your battery is
//! low, ...".
//!
//! Remarks are known by what they say. Of these only that is known which they do not say: nothing that is here, and no word by
//! which something could be asked for otherwise. They are passed over where a sentence is not understood with them.

use super::asides;
use super::lexer::{Lexeme, Token, is_mark, word_of};
use super::lexicon::{DETERMINERS, category, longest, longest_phrase};
use super::names::Names;
use super::numbers::{duration, number};
use super::paint::PAINTS;
use super::phrases::Phrases;
use super::politeness::filler;
use super::requests;
use super::shopping::OTHERS;
use super::verbs::longest_verb;

/// Words by which something may be asked for, or asked for otherwise.
#[rustfmt::skip]
const DEMANDS: &Phrases = &Phrases::of(&[
    "if", "unless", "until", "till", "when", "whenever", "before", "after", "then", "without", "but", "except", "only", "instead", "rather",
    "better", "should", "shall", "please", "let", "lets", "other", "others", "another", "ones", "same", "again", "twice", "want", "wants", "need",
    "needs", "would", "left", "right", "north", "south", "east", "west", "largest", "smallest", "tallest", "nearest", "farthest", "or", "behind",
    "beside", "near", "under", "between", "across", "along", "towards", "inside", "outside", "have to", "dont", "do not",
]);
/// More of them, where the words begin with nobody of whom something is told.
#[rustfmt::skip]
const MAY_DEMAND: &Phrases = &Phrases::of(&[
    "not", "no", "never", "cant", "isnt", "wont", "one", "too", "also", "as well", "him", "her", "them", "big", "small", "tall", "first", "second",
    "third", "last", "next", "back", "must", "which", "where", "who", "what", "how", "and", "so",
]);
/// Of whom something is told, and nobody who is told what to do.
#[rustfmt::skip]
const SOMEBODY: &Phrases = &Phrases::of(&[
    "i", "im", "ive", "ill", "he", "hes", "she", "shes", "it", "its", "they", "theyre", "theyve", "we", "were", "weve", "there is", "there are", "theres",
    "that is", "thats", "this is", "my", "his", "her", "our", "their", "nobody", "everybody", "everyone", "somebody", "someone", "people",
    "one is", "one was", "one will", "one wont", "one would", "one might", "one may", "one must be", "one of them", "one can", "one could", "one has to", "none of them",
    "some of them", "two of them", "most of them", "once is", "you never", "you can never", "your", "you look", "you must be", "you seem", "youre", "you are", "youve", "you have been",
]);
/// Of whom there are many, and none of them is meant.
#[rustfmt::skip]
const CROWDS: &[&str] = &[
    "kids", "children", "visitors", "guests", "customers", "tourists", "passengers", "neighbours", "neighbors", "parents", "students", "fans", "colleagues", "friends",
    "clouds", "birds", "bees", "flies", "folks", "locals", "shoppers", "workers", "players", "spectators", "campers",
];
/// What somebody does now and then, with no thing in particular.
#[rustfmt::skip]
const HABITS: &Phrases = &Phrases::of(&[
    "i collect", "i paint", "i draw", "i sketch", "i study", "i love", "i like", "i adore", "i photograph", "i sell", "i repair", "i write about", "we collect", "we love", "we study",
    "we like", "we sell", "we repair", "she collects", "he collects", "she loves", "he loves", "she paints", "he paints", "they love", "they collect", "my kids love", "my kids like",
]);
/// Before what somebody wants of who hears it, and is then told how.
#[rustfmt::skip]
const PICTURE_FOR: &Phrases = &Phrases::of(&[
    "i want a picture for", "i need a picture for", "i want a photo for", "i need a photo for", "i want pictures for", "i need pictures for", "i need photos for", "we need a picture for",
    "we want a picture for", "we need photos for", "we need pictures for",
]);
/// What nobody is told to do.
const UNWANTED: &Phrases = &Phrases::of(&[
    "i dont want",
    "i do not want",
    "we dont want",
    "we do not want",
    "i dont like",
    "i would not want",
    "i wouldnt want",
]);
/// Before what who speaks is about to do.
#[rustfmt::skip]
const PLANS: &Phrases = &Phrases::of(&[
    "i want to", "i need to", "i have to", "we want to", "we need to", "we have to", "id like to", "i would like to", "wed like to", "we would like to",
    "im going to", "i am going to", "were going to", "we are going to", "im trying to", "i am trying to", "ive got to", "i must", "im about to", "i am about to",
]);
/// Before what is only asked, behind an order.
const ASKED: &Phrases = &Phrases::of(&[
    "is it",
    "isnt it",
    "is not it",
    "are they",
    "arent they",
    "is he",
    "is she",
    "does it",
    "do they",
    "do you like it",
    "can you see it",
    "can you see",
]);
/// What is called out and has no verb: "what a sunset".
const CALLS: &Phrases = &Phrases::of(&[
    "what a",
    "such a",
    "poor",
    "quick question",
    "good news",
    "bad news",
    "my fault",
    "lucky you",
    "silly me",
    "small favour",
    "no offence",
]);
/// What is called out or said by the way, by its whole words.
#[rustfmt::skip]
const CRIES: &Phrases = &Phrases::of(&[
    "so am i", "me too", "same here", "silly man", "silly woman", "silly boy", "silly girl", "my friend", "my friends", "my dear", "my dears", "right in the middle", "i do beg your pardon", "do beg pardon",
    "hi", "hello", "hey", "hiya", "howdy", "morning", "evening", "afternoon", "morning all", "evening all", "hey you", "hello you", "hi there", "okay", "ok", "right", "right then",
    "well", "well now", "ah", "oh", "hm", "hmm", "er", "erm", "um", "now", "forgot mine", "lost mine", "broke mine", "left mine at home", "yuck", "ew", "eww", "yum", "yummy", "ooh", "aww", "bah", "meh", "gee", "jeez", "sheesh", "shh", "thx a lot", "testing", "testing testing", "holidays at last", "thirsty work", "thirsty work this", "hard work this", "miss", "sir", "madam", "mister", "mate", "love", "dear", "pal", "buddy", "what heat", "what weather", "what luck", "what fun", "what rain", "what noise", "what traffic", "oops", "whoops", "ugh", "gosh", "golly", "wow", "phew", "whew", "yikes", "ouch", "whoa", "blimey", "crikey", "hooray", "yay", "brr", "tut tut", "dear me",
    "goodness", "goodness me", "good grief", "good heavens", "heavens", "honestly", "frankly", "me again", "its me again", "only me", "quick one", "just a quick one",
    "one more thing", "one last thing", "one more for you", "typical", "typical of him", "typical of her", "typical of them", "lucky you", "lucky me", "lucky us", "lucky him",
    "lucky her", "poor me", "poor you", "just for fun", "for fun", "just for a laugh", "for a laugh", "just for luck", "team", "okay team", "right team", "kiddo", "kids",
    "folks", "careful", "careful now", "easy", "easy now", "easy does it", "steady", "steady now", "lots of traffic", "busy day", "long day", "lovely day", "nice day", "my turn",
    "my turn to choose", "your turn", "our turn", "change of plan", "change of plans", "new plan", "funny thing", "fun fact", "true story", "no joke", "wrong way",
    "that way lies madness", "long story", "long story short", "where was i", "as it happens", "as luck would have it", "as i was saying", "between you and me", "if i may",
    "no offence", "small world", "there we are", "there you are", "here goes", "here we go again", "so far so good", "all good", "almost there", "nearly there", "break time",
    "time for a break", "time to move", "lets play a game", "lets have some fun", "lets play", "lets have a laugh", "lets try something", "lets see what you can do",
]);
/// What things are called that are no deeds: "inventory time", "night watch".
#[rustfmt::skip]
const OCCASIONS: &[&str] = &[
    "time", "day", "night", "watch", "duty", "shift", "practice", "training", "hunt", "tour", "hour", "season", "round", "rounds", "lesson", "class", "party", "trip",
    "market", "sale", "parade", "drill", "test", "exam", "homework",
];
/// Words of those that ask for a deed, or say where.
#[rustfmt::skip]
const LINKS: &[&str] = &[
    "the", "a", "an", "my", "your", "his", "her", "to", "at", "on", "in", "into", "onto", "with", "for", "from", "of", "by", "over", "up", "down", "it", "him",
    "them", "me", "us", "that", "this", "those", "these", "back", "away", "off", "out", "round", "around",
];
/// What a remark begins with.
#[rustfmt::skip]
const SUBJECTS: &Phrases = &Phrases::of(&[
    "its", "it is", "it was", "it has", "it looks", "theres", "there is", "there are", "there was", "thats", "that is", "this is",
    "i am", "im", "i", "we are", "we", "you are", "youre", "you look", "you must", "your", "my", "our", "his", "everybody", "everyone",
    "people", "somebody", "someone", "he is", "hes", "she is", "shes", "they are", "theyre",
]);
/// Verbs that say how something is.
#[rustfmt::skip]
const STATES: &Phrases = &Phrases::of(&[
    "is", "are", "was", "were", "has", "have", "had", "takes", "looks", "seems", "feels", "goes", "comes", "gets", "keeps", "begins", "starts",
    "ends", "closes", "opens", "says", "hurts", "hurt", "must be", "might be", "could be", "will be",
]);

/// The sentence without what is said at its end, at its beginning, and at both, as far as that asks for nothing.
pub(super) fn without_remarks<'a>(
    lexemes: &'a [Lexeme],
    text: &str,
    names: &Names<'_>,
) -> impl Iterator<Item = &'a [Lexeme]> {
    let end = lexemes.iter().rposition(|lexeme| !is_mark(lexeme)).map_or(0, |last| last + 1);
    let mut last = end;
    while let Some(mark) = lexemes[..last].iter().rposition(is_mark).filter(|mark| *mark > 0)
        && (is_idle(&lexemes[mark + 1..last], names, true)
            || is_cry(&lexemes[mark + 1..last], names, false)
            || is_idle_question(&lexemes[mark + 1..last], names))
    {
        last = mark;
    }
    let mut first = 0;
    while let Some(mark) = lexemes[first..last].iter().position(ends_remark).map(|mark| first + mark)
        && mark + 1 < last
        && (is_idle(&lexemes[first..mark], names, false)
            || is_cry(&lexemes[first..mark], names, calls_out(&lexemes[first..], text)))
    {
        first = mark + 1;
    }
    let parts = [(0, last), (first, end), (first, last)];
    let shorter = move |(from, to): &(usize, usize)| to - from < end && from < to;
    let kept: Vec<_> = parts.into_iter().filter(shorter).collect();
    kept.into_iter().map(|(from, to)| &lexemes[from..to])
}

/// A mark, or the "so" behind which the order follows.
fn ends_remark(lexeme: &Lexeme) -> bool {
    is_mark(lexeme) || lexeme.token == Token::Word("so".to_owned())
}

/// Whether a clause tells something, and nothing of what is here or of what is to be done; `behind` an order it may also tell what
/// was, since nothing takes that up.
fn is_idle(clause: &[Lexeme], names: &Names<'_>, behind: bool) -> bool {
    let says = |from: usize| longest_phrase(&clause[from..], STATES).is_some();
    let others = longest_phrase(clause, DETERMINERS).unwrap_or(0);
    let of_somebody = longest_phrase(clause, SOMEBODY).or(longest_phrase(clause, CALLS)).is_some()
        || others > 0 && longest_phrase(&clause[others..], OTHERS).is_some();
    let tells = of_somebody
        || longest_phrase(clause, SUBJECTS).is_some()
        || (1..clause.len().min(4)).any(says)
        || asides::says_what_is(clause);
    let unwanted = longest_phrase(clause, UNWANTED).is_some();
    let plans = own_plans(clause) || behind && needs_it(clause);
    let past = behind && tells_what_was(clause);
    let exclaims = longest_phrase(clause, &["what a", "what an", "such a", "such an"]).is_some();
    let has_a_habit = longest_phrase(clause, HABITS).is_some();
    let asks = longest_verb(clause).is_some()
        || filler(clause).is_some() && !of_somebody
        || !unwanted && !plans && !requests::beginnings(clause).is_empty();
    let means_none = |from: usize| {
        past || exclaims
            || CROWDS.contains(&word_of(&clause[from]))
            || has_a_habit && is_general(clause, from)
    };
    let names_something = |from: usize| {
        let rest = &clause[from..];
        !means_none(from) && (category(rest).is_some() || names.exact(rest).is_some())
    };
    let speaks_of_something = |from: usize| {
        let rest = &clause[from..];
        !unwanted && !plans && longest_phrase(rest, DEMANDS).is_some()
            || !of_somebody && longest_phrase(rest, MAY_DEMAND).is_some()
            || of_somebody && from > 0 && word_of(&clause[from - 1]) == "and" && longest_verb(rest).is_some()
            || longest(rest, PAINTS).is_some()
            || number(rest).is_some_and(|(number, _)| (number - 1.0).abs() > f64::EPSILON)
                && !(of_somebody && tells_time(rest))
            || names_something(from)
    };
    clause.len() >= 2
        && clause.iter().all(|lexeme| matches!(lexeme.token, Token::Word(_) | Token::Number(_)))
        && tells
        && !asks
        && !(0..clause.len()).any(speaks_of_something)
}

/// "The coffee here used to be better": one sentence of how something was, and nothing else.
pub(super) fn tells_how_it_was(lexemes: &[Lexeme]) -> bool {
    let used_to = |at: usize| longest_phrase(&lexemes[at..], &["used to be"]).is_some();
    let end = lexemes.iter().rposition(|lexeme| !is_mark(lexeme)).map_or(0, |last| last + 1);
    longest_phrase(lexemes, DETERMINERS).or(longest_phrase(lexemes, SOMEBODY)).is_some()
        && !lexemes[..end].iter().any(is_mark)
        && (1..end).any(used_to)
}

/// Whether the sentence that begins here is called out.
fn calls_out(lexemes: &[Lexeme], text: &str) -> bool {
    let end = lexemes.iter().find(|lexeme| lexeme.token == Token::Break);
    end.is_some_and(|end| text.get(end.start..).is_some_and(|rest| rest.starts_with('!')))
}

/// "Ugh", "lucky you", "feeding time!": what has no verb, and is no order for want of one. Of what is called out two words and more
/// that name nothing here and join nothing are enough.
fn is_cry(clause: &[Lexeme], names: &Names<'_>, called_out: bool) -> bool {
    const MOST: usize = 4;
    let whole = longest_phrase(clause, CRIES).is_some_and(|words| words == clause.len());
    let bare = |at: usize| {
        let rest = &clause[at..];
        matches!(rest[0].token, Token::Word(_))
            && rest[0].lemma.is_none()
            && !LINKS.contains(&word_of(&rest[0]))
            && longest_phrase(rest, DEMANDS).is_none()
            && longest_phrase(rest, MAY_DEMAND).is_none()
            && longest_verb(rest).is_none()
            && category(rest).is_none()
            && names.exact(rest).is_none()
            && number(rest).is_none()
    };
    let occasion = clause.last().is_some_and(|last| OCCASIONS.contains(&word_of(last)));
    let picture = longest_phrase(clause, PICTURE_FOR).is_some()
        && clause.len() < 9
        && !(0..clause.len())
            .any(|at| category(&clause[at..]).is_some() || names.exact(&clause[at..]).is_some());
    let called =
        (called_out || occasion) && (2..=MOST).contains(&clause.len()) && (0..clause.len()).all(bare);
    !clause.is_empty() && (whole || called || picture)
}

/// "I paint trees": all of them, and none that is here.
fn is_general(clause: &[Lexeme], at: usize) -> bool {
    let before = at.checked_sub(1).map_or("", |before| word_of(&clause[before]));
    let of_some = longest_phrase(&clause[at.saturating_sub(1)..], DETERMINERS).is_some();
    word_of(&clause[at]).ends_with('s')
        && !of_some
        && !["red", "blue", "green", "white", "these", "those"].contains(&before)
}

/// "I need to know if they are full": what who speaks is about to do, and nobody else.
fn own_plans(clause: &[Lexeme]) -> bool {
    let Some(words) = longest_phrase(clause, PLANS) else { return false };
    let verb = &clause[words..];
    !verb.is_empty()
        && (longest_verb(verb).is_none()
            || sets_off(verb)
            || longest_phrase(
                verb,
                &["make", "know", "find out", "see if", "see whether", "see how", "see what"],
            )
            .is_some())
}

/// "Leave soon", "be off": what whoever speaks is about to do.
fn sets_off(verb: &[Lexeme]) -> bool {
    const LEAVE: &[&str] = &[
        "leave",
        "go",
        "be off",
        "get going",
        "hurry",
        "run",
        "be there",
        "be home",
        "get home",
        "go home",
        "get back",
        "head off",
        "set off",
    ];
    const SOON: &[&str] = &[
        "soon", "now", "early", "shortly", "tomorrow", "tonight", "today", "already", "in", "a", "minute",
        "moment", "right", "away", "quite",
    ];
    longest_phrase(verb, LEAVE).is_some_and(|words| {
        verb.len() > words && verb[words..].iter().all(|lexeme| SOON.contains(&word_of(lexeme)))
    })
}

impl super::parser::Parser<'_> {
    /// Passes "..., I need them for the paper" behind an order, with the mark before it; whether there was any.
    pub(super) fn skip_need(&mut self) -> bool {
        let start = self.at;
        let marked = self.rest().first().is_some_and(is_mark);
        let end = self.mark_from(start + usize::from(marked));
        let said = &self.lexemes[(start + usize::from(marked)).min(end)..end];
        let named = |at: usize| {
            category(&said[at..]).is_some()
                || self.names.exact(&said[at..]).is_some()
                || self.names.goods(&said[at..]).is_some()
        };
        let needs = marked && needs_it(said) && !(0..said.len()).any(named);
        if needs {
            self.at = end;
        }
        needs
    }
}

/// "I need them for the paper": what for.
fn needs_it(clause: &[Lexeme]) -> bool {
    const NEED: &Phrases = &Phrases::of(&[
        "i need",
        "we need",
        "i want",
        "we want",
        "they need",
        "i could use",
        "i use",
        "we use",
        "ill need",
        "well need",
    ]);
    let pronoun = |words: usize| {
        longest_phrase(&clause[words..], &["it", "them", "that", "those", "one", "this"])
            .map(|more| words + more)
    };
    let behind = longest_phrase(clause, NEED).and_then(pronoun);
    behind.is_some_and(|words| {
        longest_phrase(&clause[words..], &["for", "to", "by", "before", "tonight", "today", "tomorrow"])
            .is_some()
    })
}

/// "I booked a table", "she broke her leg": what was, behind which nothing is asked for.
fn tells_what_was(clause: &[Lexeme]) -> bool {
    const ASKED: &[&str] = &[
        "wanted",
        "needed",
        "asked",
        "said",
        "told",
        "meant",
        "called",
        "ordered",
        "preferred",
        "liked",
        "promised",
    ];
    const DID: &[&str] = &[
        "booked", "left", "lost", "bought", "found", "saw", "met", "broke", "forgot", "took", "made",
        "heard", "read", "spent", "hurt", "got", "had", "came", "went", "fell", "slept", "ate", "drank",
        "won", "paid", "grew", "knew",
    ];
    let words = longest_phrase(
        clause,
        &["i", "we", "he", "she", "they", "my wife", "my husband", "my friend", "somebody", "someone"],
    );
    let did = words.and_then(|words| clause.get(words)).map_or("", word_of);
    !ASKED.contains(&did) && (DID.contains(&did) || did.len() > 4 && did.ends_with("ed"))
}

/// "..., is it on?": nobody answers that, and nothing is done by it.
fn is_idle_question(clause: &[Lexeme], names: &Names<'_>) -> bool {
    let asks = longest_phrase(clause, ASKED).unwrap_or(0);
    asks > 0
        && (asks..clause.len()).all(|at| {
            let rest = &clause[at..];
            longest_phrase(rest, DEMANDS).is_none()
                && category(rest).is_none()
                && names.exact(rest).is_none()
                && longest_verb(rest).is_none()
        })
}

/// "Five minutes", "a bit", "two years old": how long something takes, which nobody is told to do.
fn tells_time(rest: &[Lexeme]) -> bool {
    duration(rest).is_some_and(|(_, words)| words > 1)
        || longest_phrase(
            rest.get(1..).unwrap_or_default(),
            &["years", "year", "oclock", "hours", "kids", "days", "weeks"],
        )
        .is_some()
}
