//! Words that are put plainly before they are read: contractions, what is said twice, what makes a wish no other.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{category, is_animate, longest, longest_phrase};
use super::super::names::Names;
use super::super::phrases::Phrases;
use super::forms::word_at;

/// Words that make a wish stronger or weaker, and no other.
#[rustfmt::skip]
const ADVERBS: &[&str] = &["really", "smack", "definitely", "certainly", "absolutely", "totally", "seriously", "honestly", "literally", "basically", "desperately", "badly", "sorely",
    "urgently", "frankly", "truly", "obviously", "clearly", "surely", "undoubtedly", "ideally", "preferably", "presumably", "urgent", "personally", "sincerely", "finally", "hereby", "henceforth", "forthwith", "allegedly", "reportedly", "hereafter", "thereupon", "gladly"];
/// Where a name may follow, which is any word.
const CALLS: &[&str] = &["call", "name", "rename", "christen", "label", "title", "called", "named"];

/// What "more" makes of a word.
#[rustfmt::skip]
const MORE: &[(&str, &str)] = &[("small", "smaller"), ("big", "bigger"), ("large", "larger"), ("tall", "taller"), ("high", "higher"), ("little", "smaller"),
    ("short", "shorter"), ("close", "closer"), ("tiny", "smaller"), ("huge", "bigger")];
/// Words that slip in twice.
const TWICE: &[&str] = &[
    "far", "very", "really", "so", "please", "much", "way", "the", "a", "right", "next", "big", "to", "of",
    "and", "long",
];

/// A word twice in a row says no more than once, and "more small" is "smaller".
pub(super) fn in_plain_words(words: &str, lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    contractions(words, lexemes, names);
    small_slips_of_order(lexemes);
    numbered(lexemes, names);
    judged(words, lexemes, names);
    called_to(lexemes);
    of_colour(lexemes);
    spots(lexemes);
    super::remaining::others_too(lexemes);
    needed_one(lexemes);
    relatives(lexemes);
    super::supposed::in_plain_words(lexemes);
    super::afterthoughts::in_plain_words(lexemes);
    let is_call =
        |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if CALLS.contains(&word.as_str()));
    if !lexemes.iter().any(is_call) && lexemes.len() > 2 {
        lexemes
            .retain(|lexeme| !matches!(&lexeme.token, Token::Word(word) if ADVERBS.contains(&word.as_str())));
    }
    let is = |lexeme: &Lexeme, word: &str| matches!(&lexeme.token, Token::Word(own) if own == word);
    let mut at = 1;
    while at < lexemes.len() {
        let twice =
            lexemes[at].token == lexemes[at - 1].token && TWICE.iter().any(|word| is(&lexemes[at], word));
        let marks = is_mark(&lexemes[at]) && lexemes[at].token == lexemes[at - 1].token;
        // "Stand together beside the statue".
        let is_both = is(&lexemes[at - 1], "together")
            && !is(&lexemes[at], "with")
            && longest(&lexemes[at..], &super::words::WAYS).is_some();
        if is_both {
            lexemes.remove(at - 1);
            continue;
        }
        let than = MORE.iter().find(|(plain, _)| is(&lexemes[at - 1], "more") && is(&lexemes[at], plain));
        if twice || marks {
            lexemes.remove(at);
        } else if let Some((_, comparative)) = than {
            lexemes[at] = word_at(&lexemes[at], comparative);
            lexemes.remove(at - 1);
        } else {
            at += 1;
        }
    }
}

/// The words of who is called, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    CALLED.iter().chain(JUDGED).chain(ADVERBS).flat_map(|phrase| phrase.split(' '))
}

/// "The taxi's in the way" is "the taxi is in the way", and "at its corner" is "at the corner of it".
fn contractions(words: &str, lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    let mut at = 0;
    while at + 1 < lexemes.len() {
        let (Token::Word(word), Token::Word(next)) = (&lexemes[at].token, &lexemes[at + 1].token) else {
            at += 1;
            continue;
        };
        let (word, next) = (word.clone(), next.clone());
        let written = words.get(lexemes[at].start..lexemes[at].end).unwrap_or_default();
        let (place, behind) = (lexemes[at].clone(), lexemes[at + 1].clone());
        let is_said_of = contracted_is(written, &word, &next)
            .or_else(|| named_is(written, &word, (&lexemes[at], &lexemes[at + 1]), names));
        if let Some(stem) = is_said_of {
            lexemes.splice(at..=at, [word_at(&place, stem), word_at(&place, "is")]);
        } else if ["on", "inside", "onto", "behind", "under"].contains(&word.as_str()) && next == "there" {
            lexemes[at + 1] = word_at(&behind, "it");
        } else if is_owner(written) && next == "side" && at > 0 && is_at(&lexemes[at - 1]) {
            // "Over to Anna's side" is next to her.
            let stem = word.strip_suffix('s').unwrap_or(&word);
            lexemes.splice(
                at - 1..=at + 1,
                [word_at(&place, "next"), word_at(&place, "to"), word_at(&place, stem)],
            );
        } else if is_owner(written)
            && let Some((plain, said)) = longest(&lexemes[at + 1..], OF_IT)
        {
            // "The robot's place is behind the school": the robot should be there.
            let stem = word.strip_suffix('s').unwrap_or(&word);
            let plain: Vec<Lexeme> =
                std::iter::once(word_at(&place, stem)).chain(super::forms::words_at(&place, plain)).collect();
            lexemes.splice(at..=at + said, plain);
        } else if word == "what" && category(&lexemes[at + 1..]).is_some() {
            lexemes[at] = word_at(&place, "which");
        } else if let Some(who) = contracted_will(written) {
            lexemes.splice(at..=at, [word_at(&place, who), word_at(&place, "will")]);
            at += 1;
        } else if at > 0 && is_side_of_it(&word, &next) {
            lexemes.splice(
                at..=at + 1,
                [word_at(&place, "the"), behind, word_at(&place, "of"), word_at(&place, "it")],
            );
        }
        at += 1;
    }
}

/// The thing of "the taxi's in the way", where "'s" is "is" and says not whose something is.
fn contracted_is<'a>(written: &str, word: &'a str, next: &str) -> Option<&'a str> {
    #[rustfmt::skip]
    const STATES: &[&str] = &["in", "too", "a", "on", "at", "so", "facing", "looking", "way", "always", "really", "just", "very", "not", "got", "ugly", "nice", "far",
        "missing", "waiting", "sitting", "the", "stuck", "lost", "bored", "cold", "tired", "much", "blocking", "still", "standing", "behind", "next", "near", "an", "been", "kind", "boring", "broken", "old", "empty", "dirty", "lonely", "quite", "rather", "wrong"];
    const SHORT: &[&str] = &[
        "thats", "whats", "theres", "wheres", "heres", "its", "hes", "shes", "lets", "whos", "hows", "whens",
    ];
    let is_thing = word.len() > 2 && !SHORT.contains(&word);
    // The letter may be gone already.
    let stem = word.strip_suffix('s').unwrap_or(word);
    // A word in the place of another has its letters: "put" for "there's ...".
    let is_written = written.get(..2).is_some_and(|begin| stem.starts_with(&begin.to_lowercase()));
    (is_owner(written) && is_thing && is_written && STATES.contains(&next)).then_some(stem)
}

/// "Bo's parched": somebody by name, and no thing of his behind.
fn named_is<'a>(
    written: &str,
    word: &'a str,
    (own, next): (&Lexeme, &Lexeme),
    names: &Names<'_>,
) -> Option<&'a str> {
    const HIS: &[&str] = &[
        "side", "left", "right", "front", "back", "rear", "place", "name", "new", "old", "own", "size",
        "height", "spot", "home",
    ];
    let stem = word.get(..word.len().checked_sub(1)?)?;
    let is_name = written.starts_with(char::is_uppercase)
        && is_owner(written)
        && names.exact(std::slice::from_ref(&word_at(own, stem))).is_some();
    let is_state = matches!(&next.token, Token::Word(next) if !HIS.contains(&next.as_str()))
        && category(std::slice::from_ref(next)).is_none()
        && longest(std::slice::from_ref(next), super::super::paint::PAINTS).is_none()
        && longest(std::slice::from_ref(next), OF_IT).is_none();
    (is_name && is_state).then_some(stem)
}

/// Words that slip in where they say nothing: "bring me please the scooter", "if there's still a parcel", "the tallest tree here",
/// "chuck a dog in beside her"; and limes, which are counted as trees are.
fn small_slips_of_order(lexemes: &mut Vec<Lexeme>) {
    let word = |lexemes: &[Lexeme], at: usize| match lexemes.get(at).map(|lexeme| &lexeme.token) {
        Some(Token::Word(word)) => word.clone(),
        _ => String::new(),
    };
    let mut at = 1;
    while at + 1 < lexemes.len() {
        let (before, own, next) = (word(lexemes, at - 1), word(lexemes, at), word(lexemes, at + 1));
        let is = |word: &str, words: &[&str]| words.contains(&word);
        let superlative = || (at.saturating_sub(3)..at - 1).any(|from| word(lexemes, from).ends_with("est"));
        let idle = match own.as_str() {
            "please" => is(&before, &["me", "us"]) && is(&next, &["the", "that", "this", "a", "an"]),
            // "Bring me the scooter here" moves it.
            "me" | "us" => {
                is(&before, &["bring", "fetch", "get"])
                    && is(&next, &["the", "that", "this"])
                    && lexemes.iter().any(|lexeme| lexeme.token == Token::Word("here".to_owned()))
            }
            "still" => is(&before, &["theres", "is", "are"]) && is(&next, &["a", "an", "any", "some"]),
            "here" => {
                at > 2
                    && superlative()
                    && category(&lexemes[at - 1..at]).is_some()
                    && is_mark(&lexemes[at + 1])
            }
            "in" => {
                is(&next, &["beside", "next", "behind", "near", "by"])
                    && category(&lexemes[at - 1..at]).is_some()
                    && is(
                        &word(lexemes, 0),
                        &["chuck", "throw", "pop", "bung", "stick", "put", "drop", "plonk", "squeeze"],
                    )
            }
            _ => false,
        };
        if idle {
            lexemes.remove(at);
        } else {
            at += 1;
        }
    }
    for at in 1..lexemes.len() {
        let counted = super::super::numbers::count(&lexemes[at - 1..at]).is_some();
        let every = matches!(word(lexemes, at + 1).as_str(), "every" | "each");
        if word(lexemes, at) == "limes" && (counted && !(at > 1 && word(lexemes, at - 2) == "the") || every) {
            lexemes[at] = word_at(&lexemes[at], "lime");
        }
    }
}

/// Who is meant by "we'll" and the like.
fn contracted_will(written: &str) -> Option<&'static str> {
    const WILL: [(&str, &str); 5] =
        [("we'll", "we"), ("i'll", "i"), ("they'll", "they"), ("you'll", "you"), ("it'll", "it")];
    let plain = written.replace('’', "'");
    WILL.into_iter().find(|(short, _)| plain.eq_ignore_ascii_case(short)).map(|(_, who)| who)
}

/// "Its corner": a side of what was spoken of.
fn is_side_of_it(word: &str, next: &str) -> bool {
    const SIDES: &[&str] = &["corner", "corners", "edge", "middle", "centre", "center", "side"];
    ["its", "his", "her", "their"].contains(&word) && SIDES.contains(&next)
}

fn is_at(lexeme: &Lexeme) -> bool {
    matches!(&lexeme.token, Token::Word(word) if ["to", "by", "at", "on"].contains(&word.as_str()))
}

/// What is said of something by what it has.
#[rustfmt::skip]
const OF_IT: &[(&[&str], &str)] = &[
    (&["new name is", "name is", "new name should be", "name should be", "name shall be", "new name shall be", "name will be", "name is now", "name from now on is", "new name will be", "name must be"], "should be called"),
    (&["place is", "place should be", "rightful place is", "proper place is", "new place is", "right place is", "spot is", "spot should be", "new home is", "new spot is", "home should be"], "should be"),
    (&["colour should be", "color should be", "new colour is", "new color is", "colour must be", "colour shall be", "colour is to be", "colour ought to be", "colour has to be", "new colour should be"], "should be"),
    (&["height should be", "height must be", "height is to be", "height shall be", "height ought to be", "size should be", "size must be"], "should be a height of"),
];

/// Whether a word says whose something is.
fn is_owner(written: &str) -> bool {
    written.ends_with("'s") || written.ends_with("’s")
}

/// Who is spoken to, and what is said before one speaks.
#[rustfmt::skip]
const CALLED: &Phrases = &Phrases::of(&["right lads", "lads", "class", "kids", "children", "folks", "team", "guys", "boys", "girls", "ladies and gentlemen", "mate", "dear", "my dear", "love", "lass", "laddie", "sir", "madam",
    "boss", "chief", "friends", "my friend", "my friends", "citizens", "buddy", "pal", "gents", "arr", "ahoy", "yes", "right", "okay", "ok", "now then", "listen", "look", "oh dear", "dear me", "oh", "sorry",
    "excuse me", "pardon", "pardon me", "hello", "hey", "hi", "good morning", "good day", "good evening", "bro", "dude", "yo", "nah", "sorry my english", "dear all", "colleagues", "crew", "everyone", "everybody",
    "attention", "note", "be a love and", "be a dear and", "all right", "alright", "well then", "so then", "come on", "comrades", "shipmates", "dear sir", "dear madam", "old chap", "my lad", "man", "gosh", "blimey",
    "for the record", "as i said", "as agreed", "as discussed", "as promised", "as per the report", "as ordered", "per the plan", "lastly", "firstly", "secondly", "thirdly", "furthermore", "moreover", "additionally",
    "in addition", "notwithstanding the above", "for clarity", "to be clear", "to be precise", "honest", "in short", "long story short", "if you please", "if i may", "if you would", "with your permission",
    "you know what would be great", "you know what would be nice", "you know what would be lovely", "you know what would be cool", "know what would be great", "know what would be nice", "do you know what would be great",
    "do you know what would be nice", "you know what we need", "know what we need", "guess what we need", "you know what is missing", "you know whats missing", "know whats missing", "what is missing", "whats missing", "what do we need",
    "do you know what we need", "you know what i want", "you know what id like", "you know what i would like", "know what id like", "what else", "one more thing", "here goes", "quick one", "quick question", "next job", "next task", "small request",
    "tiny request", "request", "idea", "suggestion", "proposal", "thought", "new request", "another thing", "another request", "hear me out", "picture this", "imagine this", "check this out", "get this", "question", "morning", "evening", "afternoon",
    "cheers mate", "hiya", "howdy", "greetings", "good afternoon", "dear editor", "dear simulator", "hey you", "hey computer", "computer", "editor", "hi team", "hello team", "update", "change of heart", "good news", "bad news", "be a darling",
    "be an angel", "be a sport", "if you ask me", "in my opinion", "in my view", "personally speaking", "between you and me", "no rush", "no hurry", "when you can", "when you get a sec", "when you get a minute", "urgent", "important", "reminder", "me"]);

/// "Spot seven" is called Spot 7.
fn numbered(lexemes: &mut [Lexeme], names: &Names<'_>) {
    for at in 1..lexemes.len() {
        let Some((number, 1)) = super::super::numbers::number(&lexemes[at..])
            .filter(|_| matches!(lexemes[at].token, Token::Word(_)))
        else {
            continue;
        };
        let in_digits =
            [lexemes[at - 1].clone(), Lexeme { token: Token::Number(number), ..lexemes[at].clone() }];
        if names.exact(&in_digits).is_some_and(|(_, words)| words == 2) {
            lexemes[at].token = Token::Number(number);
        }
    }
}

/// What somebody thinks of a thing, which tells it from nothing else.
#[rustfmt::skip]
const JUDGED: &[&str] = &["naughty", "nasty", "ugly", "dirty", "poor", "silly", "stupid", "shabby", "lonely", "noisy", "pretty", "beautiful", "rusty", "dusty", "broken", "damaged", "unattended", "unlicensed", "famous",
    "historic", "dull", "boring", "awful", "horrible", "hideous", "dreadful", "annoying", "bloody", "damn", "darn", "wretched", "blasted", "stinking", "smelly", "filthy", "dear", "lovely", "nice", "sweet", "kind",
    "young", "clumsy", "crooked", "battered", "tired", "tatty", "scruffy", "worn", "wonky", "wobbly", "useless", "pointless", "superfluous", "unnecessary", "offending", "troublesome", "charming", "gorgeous", "friendly",
    "grumpy", "cheerful", "elegant", "magnificent", "splendid", "proud", "mighty", "humble", "beloved", "cherished", "precious", "aforementioned", "abovementioned", "respective", "neglected", "abandoned", "forlorn",
    "weird", "strange", "odd", "funny", "freaking", "frigging", "flipping", "cursed", "goddamn", "good", "brave", "loyal", "faithful", "venerable", "stately", "obstructing", "said", "existing", "current", "present", "solitary"];

/// "The naughty dog" is the dog, and "the young man Bo" is Bo.
fn judged(words: &str, lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    let is_capital = |lexeme: &Lexeme| words[lexeme.start..].starts_with(char::is_uppercase);
    let certain = |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if ["the", "that", "this", "my", "our", "your", "those", "these"].contains(&word.as_str()));
    let mut at = 0;
    while at + 2 < lexemes.len() {
        if !certain(&lexemes[at]) {
            at += 1;
            continue;
        }
        let is_judged = |lexeme: &Lexeme| {
            matches!(&lexeme.token, Token::Word(word) if JUDGED.contains(&word.as_str()))
                && !is_capital(lexeme)
        };
        while at + 2 < lexemes.len()
            && is_judged(&lexemes[at + 1])
            && matches!(lexemes[at + 2].token, Token::Word(_))
        {
            lexemes.remove(at + 1);
        }
        if let Some((class, count)) = category(&lexemes[at + 1..])
            && class.kinds().iter().any(|kind| is_animate(*kind))
        {
            let called = at + 1 + count;
            let named = called
                + longest_phrase(&lexemes[called..], &["named", "called", "by the name of"]).unwrap_or(0);
            if lexemes.get(named).is_some_and(is_capital) && names.exact(&lexemes[named..]).is_some() {
                lexemes.drain(at..named);
            }
        }
        at += 1;
    }
}

/// "Class, we need a chair": who is called is not asked for.
fn called_to(lexemes: &mut Vec<Lexeme>) {
    while let Some(words) = longest_phrase(lexemes, CALLED)
        && lexemes.get(words).is_some_and(is_mark)
        && words + 2 < lexemes.len()
        // "Evening, and let it rain" is about the evening.
        && !matches!(lexemes.get(words + 1).map(|lexeme| &lexeme.token), Some(Token::Word(word)) if word == "and")
    {
        let marks = lexemes[words..].iter().take_while(|lexeme| is_mark(lexeme)).count();
        lexemes.drain(..words + marks);
    }
}

/// "The bench of red colour" is the red bench.
fn of_colour(lexemes: &mut Vec<Lexeme>) {
    const COLOUR: &[&str] = &["colour", "color", "colours", "colors"];
    const BEFORE: &Phrases = &Phrases::of(&[
        "of the colour",
        "of the color",
        "in the colour",
        "in the color",
        "of colour",
        "of color",
        "coloured in",
        "colored in",
    ]);
    let mut at = 1;
    while at < lexemes.len() {
        let rest = &lexemes[at..];
        let paint_at =
            |from: usize| longest(rest.get(from..)?, super::super::paint::PAINTS).map(|(_, words)| words);
        let named = longest_phrase(rest, BEFORE).and_then(|before| Some((before, paint_at(before)?, 0)));
        let told = longest_phrase(rest, &["of a", "of", "in"]).and_then(|before| {
            let paint = paint_at(before)?;
            let behind = longest_phrase(&rest[before + paint..], COLOUR)?;
            Some((before, paint, behind))
        });
        let noun = (at.saturating_sub(3)..at)
            .find(|from| category(&lexemes[*from..at]).is_some_and(|(_, words)| from + words == at));
        if let (Some((before, paint, behind)), Some(noun)) = (named.or(told), noun) {
            let colour: Vec<Lexeme> = lexemes[at + before..at + before + paint].to_vec();
            lexemes.drain(at..at + before + paint + behind);
            lexemes.splice(noun..noun, colour);
            at += paint;
        }
        at += 1;
    }
}

/// "The ladder I need goes by the tree": it is one that is not there yet.
fn needed_one(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const I_NEED: &Phrases = &Phrases::of(&["i need", "we need", "i want", "we want", "i ordered", "we ordered", "i asked for", "we asked for", "that i need", "that we need", "that i want", "that we want", "that i ordered", "that we ordered", "i was promised",
        "we were promised", "were getting", "we are getting", "im getting", "i am getting", "weve ordered", "we have ordered", "ive ordered", "we bought", "weve bought", "i bought", "ive bought", "i have in mind", "we have in mind", "im thinking of", "i am thinking of", "i was thinking of", "we are planning", "we planned"]);
    const GOES: &Phrases = &Phrases::of(&[
        "goes", "go", "should", "must", "belongs", "belong", "has to", "have to", "is to", "comes", "shall",
        "can", "could", "will", "needs to", "ought", "would", "is for", "stands",
    ]);
    let the = |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if word == "the");
    let found = (0..lexemes.len()).filter(|at| the(&lexemes[*at])).find_map(|at| {
        (at + 2..lexemes.len().min(at + 5)).find_map(|need| {
            let plain = lexemes[at + 1..need].iter().all(|lexeme| matches!(lexeme.token, Token::Word(_)));
            let words = longest_phrase(&lexemes[need..], I_NEED).filter(|_| plain)?;
            // "By the kiosk I want a table" is about a kiosk that is there.
            longest_phrase(&lexemes[need + words..], GOES)?;
            Some((at, need, words))
        })
    });
    if let Some((at, need, words)) =
        found.filter(|(at, need, words)| *at + 1 < *need && need + words < lexemes.len())
    {
        lexemes.drain(need..need + words);
        lexemes[at] = word_at(&lexemes[at], "a");
    }
}

/// "To a spot near the kiosk" is near the kiosk, and "in the hospital's block" on the block of the hospital.
fn spots(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const SPOTS: &Phrases = &Phrases::of(&["to a spot", "at a spot", "in a spot", "on a spot", "to a place", "at a place", "in a place", "to somewhere", "to some place", "to some spot", "at some spot", "in some spot", "to the spot", "to the area", "to a position",
        "to a location", "to the place", "into the spot", "to the ground", "on the ground", "on the floor", "to the space", "into the space", "in the space", "to a point", "somewhere", "someplace", "anywhere", "to the patch", "on a patch", "into position",
        "in position", "into place", "in place"]);
    let mut at = 0;
    while at < lexemes.len() {
        let words = longest_phrase(&lexemes[at..], SPOTS).filter(|words| {
            let behind = &lexemes[at + words..];
            let compass = longest(behind, super::super::compass::DIRECTIONS)
                .is_some_and(|(_, words)| longest_phrase(&behind[words..], &["of"]).is_some());
            compass
                || longest(behind, &super::words::WAYS).is_some_and(|(way, _)| {
                    !matches!(way, super::words::Way::At | super::words::Way::Here | super::words::Way::There)
                })
        });
        if let Some(words) = words {
            lexemes.drain(at..at + words);
        }
        at += 1;
    }
    let word = |lexemes: &[Lexeme], at: usize| match lexemes.get(at).map(|lexeme| &lexeme.token) {
        Some(Token::Word(word)) => word.clone(),
        _ => String::new(),
    };
    let block =
        (2..lexemes.len()).find(|at| word(lexemes, *at) == "block" && word(lexemes, at - 1).ends_with('s'));
    let Some(block) = block else { return };
    let Some(from) = (block.saturating_sub(5)..block)
        .find(|at| ["in", "on", "within", "inside"].contains(&word(lexemes, *at).as_str()))
    else {
        return;
    };
    let place = lexemes[from].clone();
    let mut whose: Vec<Lexeme> = lexemes[from + 1..block].to_vec();
    if let Some(last) = whose.last_mut()
        && let Token::Word(word) = &mut last.token
    {
        word.pop();
    }
    let words: Vec<Lexeme> = super::forms::words_at(&place, "on the block of").chain(whose).collect();
    lexemes.splice(from..=block, words);
}

/// "A motorbike, black, by the kiosk" is a black motorbike, and "the hospital that has the museum near it" is near the museum.
fn relatives(lexemes: &mut Vec<Lexeme>) {
    let is_comma = |lexeme: &Lexeme| lexeme.token == Token::Comma;
    let mut at = 1;
    while at + 2 < lexemes.len() {
        if is_comma(&lexemes[at])
            && let Some((_, words)) = longest(&lexemes[at + 1..], super::super::paint::PAINTS)
            && lexemes.get(at + 1 + words).is_some_and(is_comma)
        {
            lexemes.remove(at + 1 + words);
            lexemes.remove(at);
        }
        at += 1;
    }
    let Some(has) = (0..lexemes.len()).find(|at| {
        longest_phrase(&lexemes[*at..], &["that has", "which has", "that have", "with the", "having"])
            .is_some()
    }) else {
        return;
    };
    let from = has
        + if matches!(&lexemes[has].token, Token::Word(word) if word == "with" || word == "having") {
            1
        } else {
            2
        };
    let it = |at: usize| matches!(lexemes.get(at).map(|lexeme| &lexeme.token), Some(Token::Word(word)) if word == "it" || word == "them");
    let found = (from + 1..lexemes.len().min(from + 8)).find_map(|at| {
        let (way, words) = longest(&lexemes[at..], &super::words::WAYS)?;
        let near = matches!(way, super::words::Way::To(_));
        (near && it(at + words)).then_some((at, words))
    });
    if let Some((at, words)) = found {
        let place = lexemes[at].clone();
        let noun: Vec<Lexeme> = lexemes[from..at].to_vec();
        let relation: Vec<Lexeme> = match longest(&lexemes[at..], &super::words::WAYS) {
            Some((super::words::Way::To(simworld_core::scene::Relation::NextTo), _)) => {
                lexemes[at..at + words].to_vec()
            }
            _ => vec![word_at(&place, "near")],
        };
        lexemes.splice(has..=at + words, relation.into_iter().chain(noun));
    }
}
