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
    "anything", "everything", "ideally", "i wish", "should stay", "careful", "beware", "warning", "watch out", "void", "cancel", "cancelling", "hint", "advice", "locked", "shut", "off limits", "asleep", "deaf", "blind", "scared", "allergic", "allergy", "secret", "code", "instead of", "same", "different",
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
    "what can i say", "what can you do", "where was i", "where were we", "as usual", "as always", "of all days", "of all things", "for once", "once more", "plan for today", "plan for the day", "nothing personal", "you wouldnt believe it", "it wasnt me", "i couldnt say", "i could not say", "not again", "by the way", "poor lad", "poor lass", "poor chap", "shame on me", "typical", "phew", "me with the camera", "where did i put it", "if you were wondering", "if you must know", "in case you were wondering", "hope im not interrupting", "hope i am not interrupting", "i know youve got plenty to do", "i know you have plenty to do", "i know youre busy", "i know you are busy", "sleepyhead", "let me sit", "you sit", "no you sit", "already", "evening already", "night already", "lets get everyone together", "lets get everybody together", "id like you in the picture", "id like you in it", "if you dont mind", "if you do not mind", "if thats ok", "id love a lift", "id love a lift home", "silly man", "silly woman", "silly me", "isnt it", "is not it", "whatever", "make some friends", "time for tea", "thirsty work", "thirsty work this", "well roughly", "hint hint", "wink wink", "much obliged", "cheers", "ta", "that is all", "thats all",
]);
/// With what a sentence of politeness begins, whatever follows.
#[rustfmt::skip]
const POLITE: &Phrases = &Phrases::of(&[
    "for my", "for our", "for the", "hope", "shame on", "fine day", "sorry for", "sorry about", "sorry to", "sry for", "sorry im", "sorry i am", "sry im", "cheers for", "thanks for", "thank you for", "ta for", "apologies for", "excuse my", "excuse the", "pardon my", "pardon the", "forgive my", "forgive the",
    "someone has to", "somebody has to", "lovely to see", "nice to see", "good to see", "great to see", "lovely to meet", "nice to meet", "good to meet", "happy to", "glad to", "sry typing", "sorry typing", "typing with", "typing on", "look whos", "look who is", "look what", "look at the time", "lets see if", "lets see whether", "lets see how", "lets see what", "let us see if", "let us see whether", "let us see what",
    "let us see how", "lets find out",
]);
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
    while let Some(end) =
        lexemes[from..].iter().position(|lexeme| lexeme.token == Token::Break).map(|end| from + end)
        && end + 1 < lexemes.len()
        && is_talk(&lexemes[from..end], &lexemes[end + 1..], names)
    {
        from = end + 1;
        rests.push(&lexemes[from..]);
    }
    rests.into_iter().filter(|rest| !rest.iter().all(is_mark))
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
    let lists =
        (0..tail.len()).any(|at| names.goods(&tail[at..]).is_some() || longest_verb(&tail[at..]).is_some());
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
    let asks = |rest: &[Lexeme]| named(rest) || longest_verb(rest).is_some();
    let idle = |said: &[Lexeme]| is_fragment(said) && !(0..said.len()).any(|at| asks(&said[at..]));
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
    judged || told || may_be || asides::states_something(said)
}

/// "Lost my glasses again", "fine day for it", "been on my feet since six": words that begin with nothing that one could be told to do.
fn is_fragment(said: &[Lexeme]) -> bool {
    #[rustfmt::skip]
    const ASKS: &[&str] = &["where", "who", "whos", "whom", "whose", "what", "which", "why", "how", "when", "is", "are", "was", "were", "does", "did", "do", "has", "have", "can", "could", "will", "would"];
    let first = word_of(&said[0]);
    !first.is_empty()
        && said.len() > 1
        && said[0].lemma.is_none()
        && !ASKS.contains(&first)
        && !is_bidden(first)
}

/// Whether it is what people are told to do that nobody here can, in its plain form.
pub(super) fn is_bidden(word: &str) -> bool {
    BIDDEN.split_whitespace().any(|verb| verb == word)
}

/// What people are told to do that nobody here can, in their plain form: whoever begins so orders something.
const BIDDEN: &str = include_str!("bidden.txt");

/// Whether no part of what is said is an order, forbids or says when.
fn asks_for_nothing(said: &[Lexeme]) -> bool {
    let polite = begins_politely(said);
    let mut at = 0;
    while let Some(count) = filler(&said[at..]) {
        at += count;
        if at >= said.len() {
            return true;
        }
    }
    let guarded = (0..said.len()).any(|at| {
        let contracted = ["not", "no"].contains(&word_of(&said[at]))
            && at > 0
            && asides::is_finite(word_of(&said[at - 1]));
        longest_phrase(&said[at..], GUARDS).is_some() && !contracted
    });
    polite || !guarded && longest_verb(said).is_none() && (at == 0 || longest_verb(&said[at..]).is_none())
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
