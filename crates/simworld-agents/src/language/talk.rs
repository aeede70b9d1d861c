//! Whole sentences that are only talk: "My knees aren't what they were, so I'll catch up. Walk halfway to the bookshop."
//!
//! Where nothing is understood of several sentences as they stand, those before the order may be about anything, also about what is here:
//! whoever says "these rides make me dizzy, ha" and then orders something wants nothing of the rides. A sentence is talk if it tells something of
//! somebody or is said out of politeness, and if nothing in it forbids, asks for something or says on what condition. What takes up
//! something of the talk ("go to it") finds nothing it could stand for, and is refused as before.

use super::asides;
use super::lexer::{Lexeme, Token, is_mark, word_of};
use super::lexicon::{DETERMINERS, category, longest_phrase};
use super::names::Names;
use super::phrases::Phrases;
use super::politeness::filler;
use super::verbs::longest_verb;

/// What makes more than talk of a sentence: it forbids, asks for something, or says when or whether.
#[rustfmt::skip]
const GUARDS: &Phrases = &Phrases::of(&[
    "if", "unless", "until", "till", "dont", "do not", "never", "no", "not", "instead", "avoid", "only", "except", "without", "before", "after", "when", "whenever", "please", "rather",
    "you should", "you must", "you have to", "you need to", "you can", "you could", "you may", "you shall", "you are to", "youre to", "could you", "would you", "will you", "can you",
    "want", "wants", "need", "needs", "wanted", "needed", "then", "other than", "another", "ought to go", "mean", "means", "meant", "rule", "rules", "law", "forbidden", "allowed", "supposed", "reserved", "belongs", "belong", "off limits", "stolen", "must stay", "has to stay", "order", "orders", "command", "instruction", "example",
    "word", "opposite", "reverse", "game", "following", "next bit", "comes next", "play", "playing", "pretend", "character", "role", "distances", "numbers", "directions", "left", "right", "north", "south", "east", "west", "always", "every", "each", "whoever", "whatever", "anyone", "anybody",
    "anything", "everything", "ideally", "i wish", "should stay", "careful", "beware", "warning", "watch out", "void", "cancel", "cancelling", "hint", "advice", "locked", "shut", "off limits", "asleep", "scared", "allergic", "allergy", "secret", "code", "instead of", "same", "different",
    "twice", "the one", "the ones", "talking about", "thinking of", "speaking of", "id like", "i would like", "id love", "i would love", "wed like", "we would like", "first", "but",
]);
/// Said by itself, it asks for nothing though a verb or a guard stands in it.
#[rustfmt::skip]
const IDIOMS: &Phrases = &Phrases::of(&[
    "dont ask", "dont ask me", "dont ask me why", "dont worry", "do not worry", "dont mind me", "dont laugh", "never mind", "no worries", "no rush", "no rush at all", "no hurry", "no hurry at all",
    "no offence", "no pressure", "no problem", "no big deal", "no joke", "not bad", "nothing bad", "nothing wild", "nothing serious", "nothing special", "nothing fancy", "long story", "fingers crossed",
    "bear with me", "be patient with me", "go easy on me", "be gentle with me", "forgive me", "excuse my typing", "let me get past you", "let me get past", "let me through", "let me pass", "let me catch my breath",
    "give me a sec", "give me a second", "give me a moment", "give us a sec", "lets be off", "let us be off", "lets get going", "lets get moving", "lets go", "lets get started", "lets do this", "lets begin",
    "lets see", "let us see", "let me see", "let me think", "take your time", "mind you", "sort of", "kind of", "more or less", "roughly", "huh", "ha", "haha", "lol", "eh", "right", "i must say", "i have to say",
    "i have to admit", "i must admit", "if im honest", "if i am honest", "to be honest", "to be fair", "if you ask me", "if you know what i mean", "believe me", "trust me", "me again", "me once more", "its me again",
    "it is me again", "only me", "not to worry", "not that it matters", "not that you care", "not that i mind", "at least my phone says so", "at least i think so", "at least they say so", "so they say", "or so they say",
    "or so im told", "or so i am told", "or something", "or something like that", "or so i think", "i think", "i guess", "i suppose", "i believe", "i hope", "i bet", "you know", "you see", "would you believe it",
    "can you believe it", "can you imagine", "what a day", "fat fingers", "fat fingers today", "busy day", "busy day today", "long day", "big day", "big day today", "lucky me", "poor me", "poor thing", "here we are", "here we are again", "there we are",
    "first time here", "my first time here", "its my first time here", "nothing to worry about", "nothing much", "not much", "just so you know", "just saying", "no idea why", "dont know why", "i dont know why", "who knows", "who knows why", "goodness knows", "god knows",
    "what can i say", "what can you do", "where was i", "where were we", "as usual", "as always", "of all days", "of all things", "for once", "once more", "plan for today", "plan for the day", "nothing personal", "you wouldnt believe it", "it wasnt me", "i couldnt say", "i could not say", "not again", "by the way", "poor lad", "poor lass", "poor chap", "shame on me", "typical", "phew", "me with the camera", "where did i put it", "if you were wondering", "if you must know", "in case you were wondering", "hope im not interrupting", "hope i am not interrupting", "i know youve got plenty to do", "i know you have plenty to do", "i know youre busy", "i know you are busy", "sleepyhead", "let me sit", "you sit", "no you sit", "already", "evening already", "night already", "lets get everyone together", "lets get everybody together", "id like you in the picture", "id like you in it", "if you dont mind", "if you do not mind", "if thats ok", "id love a lift", "id love a lift home", "silly man", "silly woman", "silly me", "isnt it", "is not it", "whatever", "make some friends", "time for tea", "thirsty work", "thirsty work this", "well roughly", "hint hint", "wink wink", "much obliged", "cheers", "ta", "that is all", "thats all", "careful", "careful now", "gently", "gently now", "steady", "steady now", "hurry up a bit", "chop chop", "will you", "would you", "can you", "could you", "my friend", "patience", "this",
]);
/// With what a sentence of politeness begins, whatever follows.
#[rustfmt::skip]
const POLITE: &Phrases = &Phrases::of(&[
    "for my", "for our", "for the", "hope", "shame on", "fine day", "sorry for", "sorry about", "sorry to", "sry for", "sorry im", "sorry i am", "sry im", "cheers for", "thanks for", "thank you for", "ta for", "apologies for", "excuse my", "excuse the", "pardon my", "pardon the", "forgive my", "forgive the",
    "someone has to", "somebody has to", "lovely to see", "nice to see", "good to see", "great to see", "lovely to meet", "nice to meet", "good to meet", "happy to", "glad to", "sry typing", "sorry typing", "typing with", "typing on", "look whos", "look who is", "look what", "look at the time", "lets see if", "lets see whether", "lets see how", "lets see what", "let us see if", "let us see whether", "let us see what",
    "let us see how", "lets find out", "sorry for not", "sorry about not", "hope you dont mind", "hope you do not mind", "hope its not", "hope its no", "hope it is not", "hope it is no", "forgive me for", "excuse me for", "pardon me for", "did you see",
    "did you hear", "did you know", "did you notice", "did you sleep", "did you have a", "did you enjoy", "have you ever", "have you heard", "have you noticed", "isnt it", "isnt this", "isnt that", "arent they", "arent these", "doesnt it",
    "id like to know if", "i would like to know if", "id like to see if", "i want to know if", "i want to see if", "i wonder if", "i wonder whether", "id like to know whether", "how shall i put it", "how do i put it", "how can i put it", "how do you say", "how should i say", "been on my", "been here", "been waiting", "been walking", "been working", "been a long", "been ages", "been up since", "been a while", "just got", "just came", "just had", "just finished", "came here", "got here", "how are you", "how is it going", "hows it going", "how are things", "hows things", "how is your", "hows your", "how was your", "remember when", "guess what", "guess who", "would you believe", "can you believe", "can you imagine",
]);
/// What forbids nothing and sets no order, though a guard stands in it.
#[rustfmt::skip]
const HARMLESS: &Phrases = &Phrases::of(&[
    "i left", "we left", "he left", "she left", "they left", "you left", "who left", "somebody left", "someone left", "was left", "were left", "is left", "are left", "left behind", "left over", "have left", "has left", "first thing", "first things first", "first time",
    "first day", "first week", "first visit", "first aid", "at first", "safety first", "fitness first", "ladies first", "business first", "work first", "health first", "family first", "dont want you to", "do not want you to", "wouldnt want you to", "need the exercise", "needs the exercise", "need some exercise", "need a break", "needs a break", "need a rest", "needs a rest", "need some air", "need the money", "need the practice", "wants it done", "wants this done", "wants that done", "needs it done", "want it done", "no longer",
    "no idea", "no surprise", "no wonder", "no doubt", "no time to lose", "no one told me", "nobody told me", "not sure", "not far", "not long", "not long now", "not often", "not feeling", "not getting any younger", "not my day", "not what it was", "not what they were", "cant complain",
    "before the rain", "before it rains", "before the shops close", "before the shop closes", "before dark", "before dinner", "before lunch", "after work", "after lunch", "after dinner", "after school", "after the rain", "all day", "each other", "every day", "every morning", "every evening",
    "every week", "every year", "every time", "every summer", "every winter",
]);
/// What is said of how things are, without who or what: whoever orders something says "look" and not "looks".
#[rustfmt::skip]
const SEEMS: &[&str] = &["looks", "feels", "seems", "smells", "sounds", "tastes", "appears", "hurts", "works", "gets", "serves", "beats", "makes"];
/// Words of judgement before what is called so, without a verb.
#[rustfmt::skip]
const JUDGED: &[&str] = &[
    "lovely", "nice", "beautiful", "gorgeous", "pretty", "charming", "peaceful", "quiet", "noisy", "busy", "crowded", "empty", "cosy", "cute", "great", "good", "bad", "awful", "terrible", "horrible", "strange", "odd", "weird",
    "funny", "amazing", "brilliant", "fantastic", "wonderful", "splendid", "perfect", "chilly", "cold", "hot", "warm", "wet", "windy", "sunny", "cloudy", "foggy", "long", "big", "such", "what", "so", "quite", "very", "too", "rather", "absolutely", "proper", "fat", "typical", "glorious", "miserable",
];
/// Who is spoken of in the plural, without an article.
#[rustfmt::skip]
const PEOPLE: &[&str] = &[
    "kids", "children", "people", "folks", "tourists", "visitors", "guests", "students", "pupils", "parents", "everyone", "everybody", "somebody", "someone", "nobody", "mum", "mom", "mummy", "mommy", "dad", "daddy", "grandma", "grandpa", "granny", "grandad",
    "nan", "auntie", "uncle", "half", "most", "all", "traffic", "parking", "dinner", "lunch", "breakfast", "school", "work", "summer", "winter", "spring", "autumn", "rain", "coffee", "tea", "today", "tonight", "yesterday", "tomorrow", "this", "these", "those", "theyll", "shell", "hell", "well", "itll", "thatll", "were", "youre", "youve", "your", "you", "mine", "hers", "ours", "theirs",
];

/// The rest behind sentences of talk, the longest rest first; none where the first sentence is none.
pub(super) fn without_talk<'a>(
    lexemes: &'a [Lexeme],
    names: &Names<'_>,
) -> impl Iterator<Item = &'a [Lexeme]> {
    let mut rests = Vec::new();
    let mut from = 0;
    while let Some((end, next)) = end_of_talk(lexemes, from)
        && is_talk(&lexemes[from..end], &lexemes[next..], names)
    {
        from = next;
        rests.push(&lexemes[from..]);
    }
    rests.into_iter().filter(|rest| !rest.iter().all(is_mark))
}

/// Where what may be talk ends, and where the order behind it begins: behind a sentence, or behind the "so" of a reason.
fn end_of_talk(lexemes: &[Lexeme], from: usize) -> Option<(usize, usize)> {
    let so = |at: usize| lexemes.get(at + 1).is_some_and(|next| word_of(next) == "so");
    let ends = |at: &usize| match lexemes[*at].token {
        Token::Break => true,
        Token::Comma => so(*at) || order_begins(&lexemes[*at + 1..]),
        _ => false,
    };
    let end = (from..lexemes.len()).find(ends)?;
    let next = if so(end) { end + 2 } else { end + 1 };
    (end > from && next < lexemes.len()).then_some((end, next))
}

/// Whether an order stands there, behind words of politeness.
fn order_begins(mut said: &[Lexeme]) -> bool {
    while let Some(count) = filler(said) {
        said = &said[count..];
    }
    is_told(said) && !seems(said)
}

/// The order with the name of whom the talk before it told in the place of the first pronoun: "Ben's my cousin, by the way. Go to him".
pub(super) fn with_the_name(lexemes: &[Lexeme], names: &Names<'_>) -> Option<Vec<Lexeme>> {
    let end = lexemes.iter().position(|lexeme| lexeme.token == Token::Break)?;
    let (talk, order) = (&lexemes[..end], lexemes.get(end + 1..)?);
    let named: Vec<(usize, usize)> =
        (0..talk.len()).filter_map(|at| Some((at, names.exact(&talk[at..])?.1))).collect();
    let [(at, words)] = named[..] else { return None };
    let pronoun = order.iter().position(|lexeme| ["him", "her", "it", "them"].contains(&word_of(lexeme)))?;
    let someone_else = (0..order.len()).any(|at| names.exact(&order[at..]).is_some());
    if someone_else || at > 1 || !is_talk(talk, order, names) {
        return None;
    }
    Some([&order[..pronoun], &talk[at..at + words], &order[pronoun + 1..]].concat())
}

/// The order before a last remark: "..., the first one squeaks"; none where what stands behind the last comma is no talk.
pub(super) fn without_tail<'a>(lexemes: &'a [Lexeme], names: &Names<'_>) -> Option<&'a [Lexeme]> {
    let end = lexemes.iter().rposition(|lexeme| !is_mark(lexeme))? + 1;
    let mark = lexemes[..end].iter().rposition(is_mark).filter(|mark| *mark > 1)?;
    let (order, tail) = (&lexemes[..mark], &lexemes[mark + 1..end]);
    // "Three pretzels, two breads and a rose" is a list, and "in that case take the red one" an order.
    let lists = longest_phrase(tail, POLITE).is_none()
        && (0..tail.len())
            .any(|at| names.goods(&tail[at..]).is_some() || longest_verb(&tail[at..]).is_some());
    let told = tail.len() > 2 && !lists && (is_talk(tail, order, names) || tells_of_it(tail));
    told.then_some(order)
}

/// "It needs a test drive", "the first one squeaks": of what the order is about, behind it.
fn tells_of_it(tail: &[Lexeme]) -> bool {
    let who = longest_phrase(
        tail,
        &[
            "it",
            "he",
            "she",
            "they",
            "the first one",
            "the last one",
            "the other one",
            "the old one",
            "the nearest one",
        ],
    );
    let Some(rest) = who.and_then(|words| tail.get(words..)) else { return false };
    let says = rest.first().map_or("", word_of);
    let present =
        asides::is_finite(says) || ["needs", "need"].contains(&says) || says.len() > 3 && says.ends_with('s');
    present
        && longest_phrase(tail, &["it"]).is_none_or(|_| says != "is")
        && !rest.iter().skip(1).any(|lexeme| {
            longest_phrase(std::slice::from_ref(lexeme), GUARDS).is_some()
                || category(std::slice::from_ref(lexeme)).is_some()
        })
}

/// The sentence without the parts between two marks that say nothing wherever they stand; none if there is no such part.
pub(super) fn without_idioms(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let mut kept: Vec<Lexeme> = Vec::with_capacity(lexemes.len());
    for part in lexemes.split_inclusive(is_mark) {
        let said = part
            .strip_suffix(&part[part.len() - 1..])
            .filter(|_| part.last().is_some_and(is_mark))
            .unwrap_or(part);
        if !says_nothing(said) {
            kept.extend_from_slice(part);
        } else if let (Some(end), Some(last)) =
            (part.last().filter(|end| end.token == Token::Break), kept.last_mut())
        {
            *last = end.clone();
        }
    }
    (kept.len() < lexemes.len() && !kept.iter().all(is_mark)).then_some(kept)
}

/// "..., no hurry, but wave at Mei first": what says nothing may stand before a "but" that tells of what comes first.
pub(super) fn leave_out_before_but(lexemes: &mut Vec<Lexeme>) {
    let mut at = 1;
    while at < lexemes.len() {
        let words = Some(at).filter(|at| lexemes[*at].token == Token::Comma).and_then(|at| {
            longest_phrase(&lexemes[at + 1..], IDIOMS).filter(|words| {
                lexemes.get(at + 1 + words).is_some_and(is_mark)
                    && lexemes.get(at + 2 + words).is_some_and(|next| word_of(next) == "but")
            })
        });
        if let Some(words) = words {
            lexemes.drain(at..=at + words);
        }
        at += 1;
    }
}

/// The sentences without what somebody is called at the end of one of them: "Milan forgot the bag again, the dreamer. Take it to him".
pub(super) fn without_epithets(lexemes: &[Lexeme], names: &Names<'_>) -> Option<Vec<Lexeme>> {
    const CALLING: &[&str] =
        &["the", "poor", "bless", "silly", "clever", "dear", "old", "lucky", "good", "my", "our"];
    let known = |rest: &[Lexeme]| {
        category(rest).is_some()
            || names.exact(rest).is_some()
            || names.goods(rest).is_some()
            || is_told(rest)
    };
    let mut kept = lexemes.to_vec();
    let breaks =
        (0..lexemes.len()).rev().filter(|at| lexemes[*at].token == Token::Break && *at + 1 < lexemes.len());
    for end in breaks {
        let Some(mark) =
            lexemes[..end].iter().rposition(is_mark).filter(|at| lexemes[*at].token == Token::Comma)
        else {
            continue;
        };
        let called = &lexemes[mark + 1..end];
        let begin =
            lexemes[..mark].iter().rposition(|lexeme| lexeme.token == Token::Break).map_or(0, |at| at + 1);
        let calls = (2..=3).contains(&called.len()) && CALLING.contains(&word_of(&called[0]));
        if calls
            && !(1..called.len()).any(|at| known(&called[at..]))
            && begin < mark
            && !is_told(&lexemes[begin..mark])
        {
            kept.drain(mark..end);
        }
    }
    (kept.len() < lexemes.len()).then_some(kept)
}

/// Whether words are a turn that says nothing by itself, whatever it holds: "no rush".
pub(super) fn says_nothing(said: &[Lexeme]) -> bool {
    !said.is_empty() && longest_phrase(said, IDIOMS) == Some(said.len())
}

/// Whether a sentence of politeness begins so, whatever follows: "sorry about the mess".
pub(super) fn begins_politely(said: &[Lexeme]) -> bool {
    longest_phrase(said, POLITE).is_some()
}

/// Whether nothing but politeness is said.
pub(super) fn is_filled(mut said: &[Lexeme]) -> bool {
    while let Some(count) = filler(said) {
        said = &said[count..];
    }
    said.is_empty()
}

/// Whether a sentence is talk before an order of these words.
fn is_talk(sentence: &[Lexeme], order: &[Lexeme], names: &Names<'_>) -> bool {
    let parts = sentence.split(|lexeme| lexeme.token == Token::Comma).map(greeted);
    let mut parts = parts.filter(|part| !says_nothing(part) && !is_filled(part)).peekable();
    // Of words without a subject only those that name nothing here are talk.
    let named = |rest: &[Lexeme]| {
        category(rest).is_some() || names.exact(rest).is_some() || names.goods(rest).is_some()
    };
    // "Of the shift": behind an article stands a noun.
    let noun =
        |said: &[Lexeme], at: usize| at > 0 && longest_phrase(&said[at - 1..at], DETERMINERS).is_some();
    let several = sentence.iter().any(is_mark);
    let idle = |said: &[Lexeme]| {
        (said.len() > 1 || several || is_noun(word_of(&said[0])))
            && is_fragment(said)
            && !(0..said.len()).any(|at| named(&said[at..]) || is_told(&said[at..]) && !noun(said, at))
    };
    let tells = parts
        .peek()
        .is_none_or(|first| longest_phrase(first, POLITE).is_some() || tells_something(first) || idle(first));
    tells && parts.all(asks_for_nothing) && !is_about(sentence, order, names)
}

/// The words without greetings and sounds before them.
fn greeted(mut said: &[Lexeme]) -> &[Lexeme] {
    const SOUNDS: &[&str] = &[
        "cor", "soz", "ahoy", "uh", "er", "erm", "um", "oh", "oof", "ah", "hm", "hmm", "well", "okay", "ok",
        "right", "hiya", "hi", "hello", "hey", "helo", "evening", "morning", "again", "anyway", "gosh",
        "wow", "so", "yeah", "yes", "there", "and",
    ];
    while let Some(first) = said.first()
        && SOUNDS.contains(&word_of(first))
        && !starts_a_statement(said)
    {
        said = &said[1..];
    }
    said
}

/// "So peaceful here", "there should be shade", "well, ...".
fn starts_a_statement(said: &[Lexeme]) -> bool {
    let next = said.get(1).map_or("", word_of);
    word_of(&said[0]) == "there"
        && ["is", "are", "was", "were", "should", "must", "might", "will", "used", "has"].contains(&next)
        || word_of(&said[0]) == "so" && JUDGED.contains(&next)
        || word_of(&said[0]) == "well" && ["be", "have", "all", "see", "meet", "both", "soon"].contains(&next)
}

/// Whether something is told of somebody, or judged.
fn tells_something(said: &[Lexeme]) -> bool {
    let first = word_of(&said[0]);
    let judged = JUDGED.contains(&first) && longest_verb(said).is_none();
    let plural = longest_phrase(said, DETERMINERS).is_some() || PEOPLE.contains(&first);
    let told = plural && longest_verb(said).is_none() && said.len() > 2;
    let second = said.get(1).map_or("", word_of);
    let may_be = ["there", "it", "they", "he", "she", "we", "i"].contains(&first)
        && ["should", "must", "might", "ought", "shall", "may"].contains(&second);
    judged || told || may_be || seems(said) || asides::states_something(said)
}

/// Whether a word alone is called rather than told to be done: "stocktaking", "madness".
fn is_noun(word: &str) -> bool {
    ["ing", "ence", "ance", "ness", "tion", "day", "ment"].iter().any(|ending| word.ends_with(ending))
}

/// "Looks stormy", "feels like rain".
fn seems(said: &[Lexeme]) -> bool {
    let place = ["at", "for", "after", "to", "behind", "under"];
    let [first, rest @ ..] = said else { return false };
    let of_you = ["you", "they", "we"].contains(&word_of(first))
        && rest.first().is_some_and(|verb| ["look", "seem", "sound", "feel"].contains(&word_of(verb)));
    let rest = if of_you { &rest[1..] } else { rest };
    (of_you || SEEMS.contains(&word_of(first)))
        && rest.first().is_some_and(|next| !place.contains(&word_of(next)))
}

/// Whether words begin with a verb, and not with what is called like one: "start of the shift".
fn is_told(said: &[Lexeme]) -> bool {
    let noun = |words: usize| words == 1 && said.get(1).is_some_and(|next| word_of(next) == "of");
    longest_verb(said).is_some_and(|(_, words)| !noun(words))
}

/// "Lost my glasses again", "fine day for it", "been on my feet since six": words that begin with nothing that one could be told to do.
fn is_fragment(said: &[Lexeme]) -> bool {
    #[rustfmt::skip]
    const ASKS: &[&str] = &["where", "who", "whos", "whom", "whose", "what", "which", "why", "how", "when", "is", "are", "was", "were", "does", "did", "do", "has", "have", "can", "could", "will", "would"];
    let first = word_of(&said[0]);
    !first.is_empty()
        && !ASKS.contains(&first)
        && (said.get(1).is_some_and(|next| word_of(next) == "of")
            || said[0].lemma.is_none() && !is_bidden(first))
}

/// Whether it is what people are told to do that nobody here can, in its plain form.
pub(super) fn is_bidden(word: &str) -> bool {
    BIDDEN.split_whitespace().any(|verb| verb == word)
}

/// What people are told to do that nobody here can, in their plain form: whoever begins so orders something.
const BIDDEN: &str = include_str!("bidden.txt");

/// Whether no part of what is said is an order, forbids or says when. Behind words of politeness a verb orders nothing ("thanks for waiting").
fn asks_for_nothing(said: &[Lexeme]) -> bool {
    let polite = longest_phrase(said, POLITE).unwrap_or(0);
    let mut at = 0;
    while let Some(count) = filler(&said[at..]) {
        at += count;
        if at >= said.len() {
            return true;
        }
    }
    let orders = |at: usize| is_told(&said[at..]) && !seems(&said[at..]);
    !is_guarded(&said[polite..]) && (polite > 0 || seems(said) || !orders(0) && !orders(at))
}

/// Whether something in it forbids, asks or says when.
fn is_guarded(said: &[Lexeme]) -> bool {
    let mut at = 0;
    while at < said.len() {
        if let Some(words) = longest_phrase(&said[at..], HARMLESS) {
            at += words;
            continue;
        }
        let contracted = ["not", "no"].contains(&word_of(&said[at]))
            && at > 0
            && asides::is_finite(word_of(&said[at - 1]));
        if longest_phrase(&said[at..], GUARDS).is_some() && !contracted {
            return true;
        }
        at += 1;
    }
    false
}

/// Whether the order is about one of those that the talk told of: then it may say which.
fn is_about(talk: &[Lexeme], order: &[Lexeme], names: &Names<'_>) -> bool {
    (0..talk.len()).any(|at| {
        if let Some((ids, _)) = names.exact(&talk[at..]) {
            let named = |at: usize| names.exact(&order[at..]).is_some_and(|(others, _)| others == ids);
            return (0..order.len()).any(named);
        }
        let Some((class, words)) = category(&talk[at..]) else { return false };
        // "She'd adore these", "we'll see".
        let begins = at == 0 || is_mark(&talk[at - 1]);
        if begins && ["shed", "well", "shell"].contains(&word_of(&talk[at])) {
            return false;
        }
        let general = at == 0 || longest_phrase(&talk[at - 1..], DETERMINERS).is_none();
        let plural = word_of(&talk[at + words - 1]).ends_with('s');
        !(general && plural)
            && (0..order.len())
                .any(|at| category(&order[at..]).is_some_and(|(other, _)| std::ptr::eq(class, other)))
    })
}

#[cfg(test)]
mod tests {
    use super::super::lexer::lex;
    use super::*;

    fn order(said: &str) -> String {
        let world = simworld_core::scene::World::new();
        let names = Names::new(&world, simworld_core::geometry::Point2::origin(), 100.0);
        let lexemes = super::super::hearing::lex_speech(said);
        let rest = without_talk(&lexemes, &names).last().unwrap_or(&lexemes);
        rest.iter()
            .map(|lexeme| if is_mark(lexeme) { "," } else { word_of(lexeme) })
            .collect::<Vec<_>>()
            .join(" ")
    }

    #[test]
    fn talk_before_an_order_is_passed_over() {
        for (said, left) in [
            ("My knees aren't what they were, so I'll catch up. Walk to the oak", "walk to the oak"),
            ("These rides make me dizzy, ha. Point at the bike", "point at the bike"),
            ("Lovely little place, this. Go to the cottage", "go to the cottage"),
            ("Right, let's be off. Get into the car", "get into the car"),
            ("Thanks for earlier! Sit in the chair", "sit in the chair"),
            ("Kids leave them everywhere, you know. Point at both scooters", "point at both scooters"),
        ] {
            assert_eq!(order(said), left, "{said}");
        }
    }

    #[test]
    fn what_forbids_asks_or_limits_is_no_talk() {
        for said in [
            "Don't go near the dog. Walk to the oak",
            "Juggle three balls. Walk to the oak",
            "Wait there. Walk to the oak",
            "You should avoid the street. Walk to the oak",
            "The red bench is wet. Sit on the bench",
            "I need a chair. Walk to the oak",
            "We never use the bridge. Walk to the oak",
            "It was the big box that she asked for. Carry the box to the oak",
            "By chair my gran means a bench. Sit on the bench",
        ] {
            let world = simworld_core::scene::World::new();
            let names = Names::new(&world, simworld_core::geometry::Point2::origin(), 100.0);
            let lexemes = lex(said);
            assert_eq!(without_talk(&lexemes, &names).count(), 0, "{said}");
        }
    }

    #[test]
    fn idioms_are_left_out_wherever_they_stand() {
        let kept = |said: &str| {
            without_idioms(&lex(said)).map(|kept| kept.iter().map(word_of).collect::<Vec<_>>().join(" "))
        };
        assert_eq!(kept("sit on the bench, no rush at all, wait").as_deref(), Some("sit on the bench  wait"));
        assert_eq!(kept("go to the oak, take the ball"), None);
    }
}
