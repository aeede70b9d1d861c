//! What somebody who chats says between the parts of a request: sounds and tags ("haha", ", right?"), praise of what is asked for ("oh that
//! would be sweet"), what is not to happen to anybody ("it should not get wet"), what one would like to see ("I want a nice picture"),
//! and the thing that is spoken of first ("you know the tallest lime? ...").
//!
//! A part is left out only by words that can change nothing in the scene, and only where something else is said.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::names::Names;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::{word, word_at};
use super::words::{FACTORS, SKIES, VERBS, Verb, WAYS};

/// Sounds, whatever their number.
#[rustfmt::skip]
const SOUNDS: &[&str] = &["haha", "hahaha", "hehe", "hihi", "lol", "rofl", "hmm", "hm", "hmmm", "um", "umm", "uh", "uhm", "erm", "ehm", "ah", "aah", "oh", "ooh", "aww", "phew", "wow", "yay", "ha", "huh", "mhm", "tja", "ugh", "xd", "please", "pretty", "sorry", "thanks", "well", "okay", "ok"];
/// What stands before what is said by the way.
#[rustfmt::skip]
const LEADS: &Phrases = &Phrases::of(&["oh", "and", "but", "well", "hey", "because", "ah", "yes", "ok", "okay", "just", "cause", "since", "i mean", "honestly", "i think", "haha", "so", "so that", "otherwise", "or", "cos", "i guess", "as", "for"]);
/// What says nothing and stands alone between two marks.
#[rustfmt::skip]
const ALONE: &Phrases = &Phrases::of(&["just in case", "in case", "if youd be so kind", "if you would be so kind", "if youll be so kind", "if you dont mind", "if you wouldnt mind", "if its no bother", "if thats not a problem", "if thats no problem", "yes really", "wouldnt that be something", "would you be so kind", "youre too kind", "you are too kind", "you never know", "one never knows", "why not", "why ever not", "who knows", "who cares", "just for fun", "just for the fun of it", "for the fun of it", "trust me", "believe me", "no offence", "no offense", "so to speak", "fingers crossed", "long story",
    "dont ask", "dont ask me why", "dont ask why", "oh well", "if thats ok", "if thats okay", "if thats alright", "if thats fine", "if that is ok", "if that is okay", "if its ok", "if its okay", "if its alright", "if that suits you", "if thats not too much", "if its not too much", "if thats cool", "if that works for you", "if you feel like it", "if you get what i mean",
    "you know what i mean", "if you know what i mean", "if you ask me", "would you", "could you", "can you", "will you", "wont you", "you know", "i swear", "promise", "my bad", "silly me", "my fault", "what do you think", "what do you say", "thank you my friend", "thanks my friend", "thank you friend", "thank you so much my friend",
    "thanks a lot my friend", "cheers my friend", "dear friend", "if you would", "that is all", "thats all for now", "thats it for now", "nothing fancy", "nothing too fancy", "nothing special", "no big deal", "no biggie", "not a big deal", "easy peasy", "lets see how it looks", "lets see", "lets see what happens", "see what happens", "see how it looks",
    "the usual", "as always", "you decide", "your choice", "you choose", "up to you", "its up to you", "surprise me", "doesnt matter which", "i dont mind", "i dont really mind", "i dont care", "whatever", "whichever", "you get the idea", "you get it", "make it snappy", "be quick", "hurry up", "chop chop", "there", "there we are", "about time", "its about time", "its time", "high time", "finally", "at last", "good riddance", "much better", "problem solved", "sorted", "job done", "done",
    "set that up", "set it up", "set this up", "set them up", "please set that up", "set that up please", "set that up for me", "set that up for us", "can you set that up", "could you set that up", "get that set up", "make that happen", "please make that happen", "make it happen", "can you make that happen", "could you make that happen", "arrange that", "please arrange that", "can you arrange that", "could you arrange that", "can that be arranged", "see to that", "see to it", "please see to that", "do that for me", "do that for us", "can you do that", "could you do that", "get that done", "get it done", "take care of that", "take care of it", "i leave it to you", "i leave that to you"]);
/// Before praise of what was asked for.
#[rustfmt::skip]
const WOULD_BE: &Phrases = &Phrases::of(&["that would be", "this would be", "it would be", "that will be", "this will be", "it will be", "thatd be", "itd be", "thatll be", "itll be", "would be", "should be", "that should be", "it should be", "that might be", "it might be", "that could be", "it could be", "thats", "that is", "that looks", "it looks", "looks", "that would look", "it would look", "this would look", "would look", "thatd look", "itd look", "that will look", "it will look",
    "thatll look", "that would feel", "it would feel", "that would make", "it would make", "that makes", "this makes", "how", "that sounds", "sounds", "such", "what", "its", "it is", "itll look", "that must be", "which would be", "which is", "wouldnt that be", "wouldnt it be", "that would make it", "it would make it", "would make it", "wouldnt that look"]);
/// Words of praise, and what stands between them.
#[rustfmt::skip]
const PRAISE: &[&str] = &["a", "an", "the", "so", "really", "very", "quite", "such", "pretty", "just", "much", "too", "and", "absolutely", "totally", "rather", "super", "lovely", "nice", "nicer", "sweet", "beautiful", "great", "perfect", "wonderful", "awesome", "amazing", "fantastic", "brilliant", "cool", "fun", "funny", "good", "better", "best", "ideal", "charming",
    "cute", "cosy", "cozy", "handy", "useful", "helpful", "practical", "marvellous", "splendid", "smashing", "ace", "fab", "neat", "kind", "romantic", "magical", "hilarious", "spot", "touch", "place", "thing", "idea", "surprise", "treat", "sight", "improvement", "addition", "help", "start", "dream", "for", "everyone", "everybody", "all", "of", "you", "me", "us", "them", "him", "her", "people", "happy",
    "there", "day", "my", "our", "their", "way", "bit", "little", "lot", "delightful", "gorgeous", "superb", "terrific", "excellent", "joy", "i", "think", "believe", "guess", "dont", "sure", "right", "one", "pleasant", "interesting", "welcome", "appreciated", "life", "easier", "safer", "world"];
/// Words of [`PRAISE`] one of which has to be among them.
#[rustfmt::skip]
const GOOD: &[&str] = &["lovely", "nice", "nicer", "sweet", "beautiful", "great", "perfect", "wonderful", "awesome", "amazing", "fantastic", "brilliant", "cool", "fun", "funny", "good", "better", "best", "ideal", "charming", "cute", "cosy", "cozy", "handy", "useful", "helpful", "practical", "marvellous", "splendid", "smashing", "ace", "fab", "neat", "kind", "romantic", "magical", "hilarious", "delightful", "gorgeous", "superb", "terrific", "excellent", "pleasant", "interesting", "appreciated", "happy", "improvement", "dream", "treat", "welcome", "easier", "safer"];
/// What is not to be done by who is spoken to, and is nothing in the scene.
#[rustfmt::skip]
const DONT: &Phrases = &Phrases::of(&["dont mix", "dont worry", "dont laugh", "dont judge", "dont overthink", "dont confuse", "dont tell", "dont hesitate", "dont panic", "dont rush", "dont hurry", "dont stress", "dont fuss", "dont be", "dont get me wrong", "dont get them mixed", "dont get it wrong", "dont get confused", "dont mess", "dont ask", "dont blame", "dont let me down", "dont disappoint", "dont make me", "dont keep me", "dont you think", "dont scratch", "dont swap them", "dont mind", "dont look at me", "do not mix", "do not worry", "do not confuse", "please dont mix", "never mind", "dont hate me", "dont argue", "dont overdo", "dont think", "dont bump"]);
/// Who is told of.
#[rustfmt::skip]
const WHO: &Phrases = &Phrases::of(&["it", "he", "she", "they", "that", "we", "you", "i", "people", "everyone", "everybody", "nobody", "somebody", "someone", "the poor thing", "poor thing", "kids", "the kids", "no one", "anyone", "anybody", "visitors", "folks", "the neighbours", "my boss", "my wife", "my husband", "my mother", "my kids", "the mayor", "drivers", "cyclists", "pedestrians", "tourists", "students", "parents", "residents", "shoppers", "patients", "pupils", "workers", "neighbours", "guests", "customers", "all of us", "the drivers", "the visitors", "the children", "children", "the neighbours"]);
/// That something is to be so, or not.
#[rustfmt::skip]
const SHALL: &Phrases = &Phrases::of(&["should not", "shouldnt", "mustnt", "must not", "might", "may", "could", "will", "would", "wont", "cant", "cannot", "can", "doesnt", "dont", "didnt", "does not", "do not", "will not", "might not", "never", "always", "really", "wouldnt", "couldnt", "would not", "should", "keeps", "keep"]);
/// What befalls somebody, and changes nothing in the scene.
#[rustfmt::skip]
const BEFALLS: &[&str] = &["get", "gets", "melt", "melts", "freeze", "catch", "feel", "feels", "fall", "falls", "burn", "starve", "miss", "suffer", "drown", "tip", "rust", "rot", "trip", "bump", "hurt", "cry", "stumble", "crash", "collide", "complain", "notice", "notices", "mind", "care", "know", "like", "love", "loves", "enjoy", "enjoys", "appreciate", "thank", "thanks", "hate", "hates", "laugh", "smile", "sleep", "relax", "remember", "forget", "understand", "realise", "realize", "squint", "sweat", "sneeze", "shiver", "wonder", "panic", "behave", "deserve it", "deserves it", "have fun", "stare", "struggle", "wait", "waits", "thirst", "chat", "learn"];
/// What one would like to have of a scene, and is no thing in it.
#[rustfmt::skip]
pub(super) const ABSTRACT: &[&str] = &["picture", "pictures", "photo", "photos", "view", "shot", "change", "look", "vibe", "mood", "selfie", "atmosphere", "feeling", "chance", "overview", "effect", "contrast", "balance", "symmetry", "order", "peace", "quiet", "privacy", "results", "variety", "colour", "perspective", "angle", "composition", "impression", "feel", "fun", "drama", "attention", "action", "company", "space", "room", "break", "rest", "snapshot", "postcard", "scenery", "love", "care", "life", "clarity", "calm", "silence", "harmony", "mess"];

/// Leaves out what is said between, and says plainly what was spoken of first.
pub(super) fn in_plain_words(words: &str, lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    contracted(words, lexemes);
    without_tags(lexemes);
    without_idle_parts(lexemes);
    without_dislike(lexemes);
    without_darkness(lexemes);
    so_that_nothing(lexemes);
    super::spoken_first::in_plain_words(words, lexemes, names);
}

/// "She'd" is who would, and no shed; "he'd" too.
fn contracted(words: &str, lexemes: &mut Vec<Lexeme>) {
    let mut at = 0;
    while at < lexemes.len() {
        let written = words.get(lexemes[at].start..lexemes[at].end).unwrap_or_default().replace('’', "'");
        let who = ["she", "he"]
            .into_iter()
            .find(|who| written.len() == who.len() + 2 && written.to_lowercase() == format!("{who}'d"));
        if let Some(who) = who {
            let place = lexemes[at].clone();
            lexemes.splice(at..=at, [word_at(&place, who), word_at(&place, "would")]);
            at += 1;
        }
        at += 1;
    }
}

/// ", right?" before another sentence asks nothing.
fn without_tags(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const TAGS: &Phrases = &Phrases::of(&["right", "ok", "okay", "yes", "yeah", "correct", "true", "isnt there", "arent there", "isnt it", "arent they", "isnt he", "isnt she", "you see", "you know", "no", "huh", "eh", "agreed", "innit", "dont we", "doesnt it", "dont they", "you know it", "you know the one", "you know the ones", "you see it", "got it", "see it"]);
    let mut at = 1;
    while at + 2 < lexemes.len() {
        let words = longest_phrase(&lexemes[at + 1..], TAGS).unwrap_or(0);
        let behind = at + 1 + words;
        let is_tag = words > 0
            && lexemes[at].token == Token::Comma
            && lexemes.get(behind).is_some_and(|mark| mark.token == Token::Break)
            && behind + 1 < lexemes.len();
        if is_tag {
            lexemes.drain(at..behind);
        }
        at += 1;
    }
}

/// Leaves out the parts between marks that say nothing of the scene.
fn without_idle_parts(lexemes: &mut Vec<Lexeme>) {
    let asks = lexemes.first().is_some_and(|first| {
        matches!(&first.token, Token::Word(word) if ["which", "what", "how", "where", "who"].contains(&word.as_str()))
    });
    let mut from = 0;
    while from < lexemes.len() {
        let end = lexemes[from..].iter().position(is_mark).map_or(lexemes.len(), |mark| from + mark);
        let part = &lexemes[from..end];
        let is_whole = from == 0 && end + 1 >= lexemes.len();
        let is_idle = !part.is_empty()
            && !is_whole
            && (is_sound(part)
                || from > 0 && (is_idle(part) || asks && lists_them(part))
                || from == 0 && wants_to_see(part) && begins_order(&lexemes[end + 1..]));
        if is_idle && from > 0 {
            // With the mark before it; the one behind it ends what is left.
            lexemes.drain(from - 1..end);
            from -= 1;
        } else if is_idle {
            lexemes.drain(..(end + 1).min(lexemes.len()));
            continue;
        }
        from += lexemes[from..].iter().position(is_mark).map_or(lexemes.len(), |mark| mark + 1);
    }
}

fn is_sound(part: &[Lexeme]) -> bool {
    const NO_SOUNDS: &[&str] = &["please", "pretty", "sorry", "thanks", "well", "okay", "ok", "oh", "ah"];
    let is = |lexeme: &Lexeme, list: &[&str]| matches!(&lexeme.token, Token::Word(word) if list.contains(&word.as_str()));
    part.iter().all(|lexeme| is(lexeme, SOUNDS)) && part.iter().any(|lexeme| !is(lexeme, NO_SOUNDS))
}

/// Whether a part behind another can change nothing.
fn is_idle(part: &[Lexeme]) -> bool {
    let lead = longest_phrase(part, LEADS).filter(|lead| *lead < part.len()).unwrap_or(0);
    [&part[lead..], part].into_iter().any(|part| {
        longest_phrase(part, ALONE) == Some(part.len())
            || praises(part)
            || is_harmless(part) && (longest_phrase(part, DONT).is_some() || befalls(part))
            || wants_to_see(part)
    })
}

/// "Would be a lovely spot".
fn praises(part: &[Lexeme]) -> bool {
    let is = |lexeme: &Lexeme, list: &[&str]| matches!(&lexeme.token, Token::Word(word) if list.contains(&word.as_str()));
    longest_phrase(part, WOULD_BE).is_some_and(|words| {
        let praise = &part[words..];
        praise.iter().all(|lexeme| is(lexeme, PRAISE)) && praise.iter().any(|lexeme| is(lexeme, GOOD))
    })
}

/// "It should not get wet".
fn befalls(part: &[Lexeme]) -> bool {
    let Some(who) = longest_phrase(part, WHO) else { return false };
    let shall = longest_phrase(&part[who..], SHALL).unwrap_or(0);
    let really =
        longest_phrase(&part[who + shall..], &["really", "just", "always", "never", "all", "be able to"]);
    let at = who + shall + really.unwrap_or(0);
    shall > 0 && longest_phrase(&part[at..], BEFALLS).is_some()
}

/// "I want a nice picture".
fn wants_to_see(part: &[Lexeme]) -> bool {
    #[rustfmt::skip]
    const WANT: &Phrases = &Phrases::of(&["i want", "we want", "i need", "we need", "id like", "wed like", "i would like", "we would like", "i just want", "we just want", "i like", "i love", "i fancy", "i really want", "i prefer", "i wanted", "i could use", "we could use", "i want to have", "id love", "id prefer", "im going for", "it needs", "they need", "it could use", "im after", "i want to get", "i was going for"]);
    const LONGEST: usize = 5;
    let Some(want) = longest_phrase(part, WANT) else { return false };
    let what = &part[want..];
    (1..=LONGEST).contains(&what.len())
        && matches!(what.last().map(|last| &last.token), Some(Token::Word(last)) if ABSTRACT.contains(&last.as_str()))
        && what[..what.len() - 1].iter().all(|lexeme| matches!(lexeme.token, Token::Word(_)))
        && (0..what.len() - 1)
            .all(|at| category(&what[at..]).is_none() && longest(&what[at..], PAINTS).is_none())
}

/// Whether some words hold nothing that could be otherwise in the scene.
fn is_harmless(part: &[Lexeme]) -> bool {
    let word_of_scene = |at: usize| {
        let rest = &part[at..];
        category(rest).is_some()
            || longest(rest, PAINTS).is_some()
            || longest(rest, &WAYS).is_some_and(|(_, words)| words > 1)
            || longest(rest, &FACTORS).is_some()
            || longest(rest, &SKIES).is_some() && word(rest, 0) != "wet" && word(rest, 0) != "cold"
            || longest_phrase(
                rest,
                &[
                    "the", "here", "instead", "another", "one", "ones", "if", "but", "rather", "except",
                    "only", "unless",
                ],
            )
            .is_some()
            || super::super::numbers::number(rest).is_some_and(|_| !matches!(word(rest, 0), "a" | "an"))
    };
    let who = longest_phrase(part, WHO).unwrap_or(0);
    !(who..part.len()).any(word_of_scene)
}

/// "Just list them for me", behind a question.
fn lists_them(part: &[Lexeme]) -> bool {
    #[rustfmt::skip]
    const LEAD: &Phrases = &Phrases::of(&["just", "please", "so", "and", "can you", "could you", "can you just", "could you just", "could you please", "please just", "just please", "would you", "will you", "i want you to", "id like you to", "go on and", "go on", "come on"]);
    const LIST: &Phrases = &Phrases::of(&[
        "list", "name", "show", "tell", "count", "give", "describe", "list me", "name me", "show me",
        "tell me", "give me", "count up", "read out", "show us", "tell us",
    ]);
    const THEM: &Phrases = &Phrases::of(&[
        "them",
        "it",
        "those",
        "all",
        "all of them",
        "them all",
        "which",
        "them out",
        "them up",
        "a list",
        "the list",
        "a list please",
        "the number",
        "me",
    ]);
    const FOR: &Phrases = &Phrases::of(&[
        "for me",
        "for us",
        "please",
        "all",
        "for me please",
        "one by one",
        "then",
        "will you",
        "would you",
        "out",
        "now",
        "quickly",
    ]);
    let mut at = longest_phrase(part, LEAD).unwrap_or(0);
    let Some(list) = longest_phrase(&part[at..], LIST) else { return false };
    at += list;
    let Some(them) = longest_phrase(&part[at..], THEM) else { return false };
    at += them;
    at += longest_phrase(&part[at..], FOR).unwrap_or(0);
    at == part.len()
}

/// Whether an order or a request begins here, behind small words.
fn begins_order(rest: &[Lexeme]) -> bool {
    #[rustfmt::skip]
    const SMALL: &Phrases = &Phrases::of(&["so", "please", "and", "then", "just", "maybe", "could you", "can you", "would you", "will you", "so please", "could you please", "can you please", "so could you", "so can you", "why dont you", "how about you", "lets", "so lets", "perhaps", "could we", "can we"]);
    let mut at = rest.iter().take_while(|lexeme| is_mark(lexeme)).count();
    for _ in 0..2 {
        at += longest_phrase(&rest[at.min(rest.len())..], SMALL).unwrap_or(0);
    }
    rest.get(at..).is_some_and(|rest| {
        longest(rest, &VERBS).is_some() || longest_phrase(rest, &["make", "get", "take", "give"]).is_some()
    })
}

/// "I don't like small trees. Remove every tree shorter than ...": what is disliked in general, before what is to go.
fn without_dislike(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const DISLIKES: &Phrases = &Phrases::of(&["i dont like", "we dont like", "i hate", "we hate", "i do not like", "i cant stand", "we cant stand", "i really dont like", "i really hate", "i dislike", "nobody likes", "i never liked", "i have never liked", "im not a fan of", "i am not a fan of", "im no fan of", "im not fond of", "i dont want", "we dont want", "i dont need", "we dont need", "i have something against"]);
    const CERTAIN: &Phrases = &Phrases::of(&[
        "the", "that", "this", "these", "those", "it", "them", "him", "her", "my", "our", "your", "any",
        "both", "all", "its", "their", "to", "how", "when", "where", "what", "a", "an",
    ]);
    let Some(words) = longest_phrase(lexemes, DISLIKES) else { return };
    let Some(end) = lexemes.iter().position(is_mark) else { return };
    let what = &lexemes[words..end.max(words)];
    let is_general = (1..=3).contains(&what.len())
        && longest_phrase(what, CERTAIN).is_none()
        && (0..what.len()).any(|at| category(&what[at..]).is_some_and(|(_, words)| at + words == what.len()));
    // "I hate cones, get rid of them" is about them.
    let is_of_them = lexemes[end..].iter().any(|lexeme| matches!(&lexeme.token, Token::Word(word) if ["them", "they", "it", "those", "these", "ones", "one", "both"].contains(&word.as_str())));
    if is_general && !is_of_them && begins_order(&lexemes[end..]) {
        lexemes.drain(..=end);
    }
}

/// "It gets so dark over there, could you stick a lamp ...": how it is somewhere, before a new thing and its place.
fn without_darkness(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const IT_IS: &Phrases = &Phrases::of(&["it gets", "it is", "its", "it looks", "it feels", "it was", "it seems", "it can get", "it always gets", "it always is", "its always", "it gets always", "its getting"]);
    #[rustfmt::skip]
    const SO: &Phrases = &Phrases::of(&["so", "too", "really", "very", "quite", "pretty", "a bit", "rather", "so very", "awfully", "terribly", "always", "often", "a bit too", "a little", "always so", "far too", "way too", "much too", "kinda", "kind of", "super"]);
    #[rustfmt::skip]
    const THERE: &Phrases = &Phrases::of(&["over there", "out there", "there", "here", "around here", "over here", "round here", "out here", "at night", "in the evening", "in the evenings", "in winter", "in summer", "down there", "around there", "in there", "back there", "there at night", "here at night", "after dark"]);
    let Some(mut at) = longest_phrase(lexemes, IT_IS) else { return };
    at += longest_phrase(&lexemes[at..], SO).unwrap_or(0);
    let Some(end) = lexemes.iter().position(is_mark) else { return };
    let says_there =
        (at + 1..end).find(|from| longest_phrase(&lexemes[*from..end], THERE) == Some(end - from));
    let is_plain = says_there.is_some_and(|there| there <= at + 2);
    let rest = &lexemes[end..];
    let is_new = rest.iter().any(|lexeme| matches!(&lexeme.token, Token::Word(word) if ["a", "an", "some", "two", "three", "four"].contains(&word.as_str())));
    let is_open = rest.iter().any(|lexeme| matches!(&lexeme.token, Token::Word(word) if ["there", "it", "that"].contains(&word.as_str())));
    let has_place = (0..rest.len()).any(|at| {
        longest(&rest[at..], &WAYS).is_some_and(|(_, words)| {
            words > 1
                || longest_phrase(
                    &rest[at..],
                    &["near", "behind", "beside", "between", "by", "opposite", "along"],
                )
                .is_some()
        })
    });
    if is_plain && is_new && !is_open && has_place && begins_order(rest) {
        lexemes.drain(..=end);
    }
}

/// "Near the hydrant so they notice": why, where nothing of the scene is told.
fn so_that_nothing(lexemes: &mut Vec<Lexeme>) {
    let mut at = 3;
    while at + 2 < lexemes.len() {
        let end = lexemes[at..].iter().position(is_mark).map_or(lexemes.len(), |mark| at + mark);
        let so = longest_phrase(&lexemes[at..end], &["so", "so that", "in order that", "such that"]);
        let clause = so.map(|words| &lexemes[at + words..end]);
        if clause.is_some_and(tells_nothing) {
            let from = if is_mark(&lexemes[at - 1]) { at - 1 } else { at };
            lexemes.drain(from..end);
            at = from;
        }
        at += 1;
    }
}

/// Whether somebody only notices, enjoys or does something that is no order.
fn tells_nothing(clause: &[Lexeme]) -> bool {
    #[rustfmt::skip]
    const OF_SCENE: &[&str] = &["face", "faces", "look", "looks", "see", "sees", "watch", "watches", "stand", "stands", "sit", "sits", "is", "are", "be", "has", "have", "it", "them", "should", "must", "need", "needs", "there", "each", "and", "that"];
    let Some(who) = longest_phrase(clause, WHO) else { return false };
    let orders = |at: usize| {
        longest(&clause[at..], &VERBS)
            .is_some_and(|(verb, _)| !matches!(verb, Verb::Name | Verb::Describe | Verb::List | Verb::Count))
    };
    (who + 1..=who + 5).contains(&clause.len())
        && is_harmless(clause)
        && longest(&clause[who..], &VERBS).is_none()
        && !(who..clause.len()).any(|at| OF_SCENE.contains(&word(clause, at)) || orders(at))
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    [LEADS, ALONE, WOULD_BE, DONT, WHO, SHALL]
        .into_iter()
        .flatten()
        .chain(SOUNDS)
        .chain(PRAISE)
        .chain(BEFALLS)
        .chain(ABSTRACT)
        .flat_map(|phrase| phrase.split(' '))
}
