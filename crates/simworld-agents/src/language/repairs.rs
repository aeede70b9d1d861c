//! What is said and taken back in the same breath, put right before it is read: "take two photos. No, wait, make that three", "bring
//! it to Luis, no, sorry, to Nora", "the bin, er, the bin by the red bench".
//!
//! Between what was wrong and what is right stand words that say so, one or several. Where what is right begins as a part of what
//! was wrong does (with the same preposition, an article, a number, a direction), it takes the place of that part. Elsewhere the
//! words between become one "no", which the parser reads as the correction of a whole order.

use super::compass::DIRECTIONS;
use super::lexer::{Lexeme, Token, is_mark, word_of};
use super::lexicon::{FARTHEST, MOSTS, NEAREST, longest, longest_phrase};
use super::numbers;
use super::phrases::Phrases;
use super::politeness::{filler, joint};
use super::verbs::longest_verb;

/// What says by itself that something was wrong, with a mark behind it.
#[rustfmt::skip]
const WRONG: &Phrases = &Phrases::of(&[
    "no", "nope", "no wait", "wait no", "no sorry", "sorry no", "oh no", "no no", "no hang on", "hang on no", "hold on no", "no hold on", "actually no",
    "no actually", "or no", "well no", "oh wait no", "no thats wrong", "thats wrong", "that is wrong", "thats not right", "that is not right", "my bad",
    "my mistake", "my fault", "silly me", "what am i saying", "scratch that", "strike that", "oops", "oops no", "whoops", "i got that wrong", "i take that back", "correction",
]);
/// What says so and goes on with what is right.
#[rustfmt::skip]
const MEANT: &Phrases = &Phrases::of(&[
    "i mean", "i meant", "make that", "make it", "or rather", "i meant to say", "i wanted to say", "i should have said", "it should be", "that should be",
    "that should have been", "i was going to say", "better make that", "better make it", "lets make that", "lets make it", "let us make it", "let us make that",
    "actually make that", "actually make it", "no make that", "no make it", "well make it", "no i mean", "no i meant", "sorry i mean", "sorry i meant",
]);
/// What may stand between, and says nothing by itself.
#[rustfmt::skip]
const SORRY: &Phrases = &Phrases::of(&[
    "sorry", "im sorry", "i am sorry", "wait", "oh wait", "hang on", "hold on", "wait a second", "wait a minute", "hang on a second", "hang on a minute",
    "hold on a second", "pardon", "pardon me", "excuse me", "actually", "well", "yes", "ah", "apologies", "my apologies", "forgive me", "so sorry",
]);
/// With what a part of an order begins that has a counterpart in what is right.
#[rustfmt::skip]
const LINKS: &[&str] = &[
    "to", "at", "on", "by", "via", "for", "in", "with", "from", "near", "beside", "behind", "if", "until", "towards", "into", "past", "around", "under",
    "through", "next", "over", "onto",
];
const ARTICLES: &[&str] = &["the", "a", "an"];
/// "If it is cold, make that a tea" takes nothing back.
const CONDITIONS: &[&str] = &["if", "when", "unless", "should", "while", "until", "once", "in"];
/// Verbs behind which words are passed on as they are said.
#[rustfmt::skip]
const SPEAKING: &[&str] = &[
    "say", "says", "saying", "tell", "telling", "ask", "asking", "shout", "whisper", "yell", "call", "answer", "reply", "inform", "announce", "remind", "warn", "know",
];
/// What makes a statement of what is right.
#[rustfmt::skip]
const FINITE: &[&str] = &[
    "is", "are", "was", "were", "has", "have", "had", "can", "cant", "will", "would", "does", "did", "didnt", "dont", "its", "im", "thats", "theres",
];

/// Puts right what is taken back in the same breath. What was said comes back where nothing but "sorry" and the like says that
/// something was wrong, and something else may be meant.
pub(super) fn mend(lexemes: &mut Vec<Lexeme>) -> Option<Vec<Lexeme>> {
    without_stutter(lexemes);
    let mut said = None;
    let mut at = 1;
    while at + 1 < lexemes.len() {
        if is_mark(&lexemes[at]) && !is_mark(&lexemes[at - 1]) {
            if passes_words_on(&lexemes[..at]) {
                return said;
            }
            if let Some(slip) = Slip::at(lexemes, at) {
                let before = if slip.alone { None } else { Some(lexemes.clone()) };
                if slip.mend(lexemes) {
                    said = before;
                }
            } else {
                meant_behind(lexemes, at);
            }
        }
        at += 1;
    }
    said
}

/// Whether somebody is told something, of which "no" may be a part.
fn passes_words_on(before: &[Lexeme]) -> bool {
    before.iter().any(|lexeme| SPEAKING.contains(&word_of(lexeme)))
}

/// "Go to the, the bench", "the bin the bin by the bench": small words, and an article with its noun, that are said twice.
fn without_stutter(lexemes: &mut Vec<Lexeme>) {
    const SMALL: &[&str] = &["the", "a", "an", "to", "at", "on", "and", "in", "by", "with", "of"];
    let mut at = 0;
    while at + 1 < lexemes.len() {
        if SMALL.contains(&word_of(&lexemes[at])) {
            let same = |one: usize, other: usize| {
                lexemes.get(other).is_some_and(|lexeme| lexeme.token == lexemes[one].token)
            };
            let comma =
                |at: usize| usize::from(matches!(lexemes.get(at), Some(Lexeme { token: Token::Comma, .. })));
            let (one, two) = (at + 1 + comma(at + 1), at + 2 + comma(at + 2));
            let article = ARTICLES.contains(&word_of(&lexemes[at]));
            let noun = article && !is_mark(&lexemes[at + 1]) && same(at, two) && same(at + 1, two + 1);
            if same(at, one) {
                lexemes.drain(at..one);
                continue;
            } else if noun {
                lexemes.drain(at..two);
                continue;
            }
        }
        at += 1;
    }
}

/// "..., to the kiosk I mean": what was said last is what is right.
fn meant_behind(lexemes: &mut Vec<Lexeme>, mark: usize) {
    let Some(end) = (mark + 1..lexemes.len()).find(|at| is_mark(&lexemes[*at])).or(Some(lexemes.len()))
    else {
        return;
    };
    // Behind a comma of its own, or without one.
    let comma = end < lexemes.len();
    let own = if comma { longest_phrase(&lexemes[end + 1..], &["i mean", "i meant"]) } else { None };
    let (from, to) = match own {
        Some(words) => (end, end + 1 + words),
        None if end > mark + 3 && longest_phrase(&lexemes[end - 2..], &["i mean", "i meant"]) == Some(2) => {
            (end - 2, end)
        }
        None => return,
    };
    let ends = lexemes.get(to).is_none_or(is_mark);
    if !ends || from < mark + 2 || longest_verb(&lexemes[mark + 1..]).is_some() {
        return;
    }
    lexemes.drain(from..to);
    let slip = Slip { mark, from: mark + 1, alone: true };
    slip.mend(lexemes);
}

/// "I left my scarf there, silly me. Sit on ...": what ends a sentence takes nothing back of the next.
fn blames_oneself(said: &[Lexeme], after: &[Lexeme]) -> bool {
    let blames = longest_phrase(said, &["silly me", "my bad", "my fault", "my mistake"]).is_some();
    blames
        && after.first().is_some_and(|mark| mark.token == Token::Break)
        && after.get(1..).is_some_and(|next| longest_verb(next).is_some())
}

/// Where something is taken back.
struct Slip {
    /// The mark behind what was wrong.
    mark: usize,
    /// Where what is right begins.
    from: usize,
    /// Whether the words between say by themselves that something was wrong.
    alone: bool,
}

impl Slip {
    /// The slip that ends at a mark, if what follows says that it was one.
    fn at(lexemes: &[Lexeme], mark: usize) -> Option<Self> {
        let (mut at, mut alone) = (mark, false);
        loop {
            let start = at;
            while lexemes.get(at).is_some_and(is_mark) {
                at += 1;
            }
            let rest = &lexemes[at..];
            let marked = |words: usize| rest.get(words).is_some_and(is_mark);
            if let Some(words) =
                longest_phrase(rest, MEANT).filter(|words| filler(rest).is_none_or(|more| more <= *words))
            {
                (at, alone) = (at + words, true);
            } else if let Some(words) = longest_phrase(rest, WRONG)
                .filter(|words| marked(*words) && !blames_oneself(&rest[..*words], &rest[*words..]))
            {
                (at, alone) = (at + words, true);
            } else if let Some(words) = longest_phrase(rest, SORRY)
                .filter(|words| marked(*words) || longest_phrase(&rest[*words..], MEANT).is_some())
            {
                at += words;
            } else if rest.first().is_some_and(|first| word_of(first) == "wrong") && marked(2) {
                (at, alone) = (at + 2, true); // "wrong tree"
            } else {
                let none = start == mark;
                at = start;
                if none {
                    return None;
                }
                break;
            }
        }
        while lexemes.get(at).is_some_and(is_mark)
            || longest_phrase(&lexemes[at.min(lexemes.len())..], &["better", "rather", "just"]).is_some()
        {
            at += 1;
        }
        (at < lexemes.len()).then_some(Self { mark, from: at, alone })
    }

    /// Whether something was put right.
    fn mend(&self, lexemes: &mut Vec<Lexeme>) -> bool {
        let mut end = (self.from..lexemes.len()).find(|at| is_mark(&lexemes[*at])).unwrap_or(lexemes.len());
        if end > self.from + 2 && longest_phrase(&lexemes[end - 2..], &["i mean", "i meant"]) == Some(2) {
            lexemes.drain(end - 2..end); // "no, sorry, to the kiosk I mean"
            end -= 2;
        }
        let begins = |lexeme: &Lexeme| is_mark(lexeme) || ["and", "then"].contains(&word_of(lexeme));
        let begin = lexemes[..self.mark].iter().rposition(begins).map_or(0, |at| at + 1);
        // "The chair that's nearest" says which, and states nothing.
        let which = |at: usize| at > self.from + 1 && word_of(&lexemes[at]) == "thats";
        let which = |at: usize| which(at) && ARTICLES.contains(&word_of(&lexemes[self.from]));
        let stated = (self.from..end).any(|at| FINITE.contains(&word_of(&lexemes[at])) && !which(at));
        if !stated && let Some(mended) = replaced(&lexemes[begin..self.mark], &lexemes[self.from..end]) {
            let place = |lexeme: &Lexeme| ["at", "from", "in"].contains(&word_of(lexeme));
            let goes_on = lexemes.get(end).is_some_and(|mark| mark.token == Token::Comma)
                && lexemes.get(end + 1).is_some_and(place);
            // "Buy milk, I mean bread, at the kiosk".
            lexemes.splice(begin..end + usize::from(goes_on), mended);
        } else if self.alone && !CONDITIONS.contains(&word_of(&lexemes[begin.min(self.mark - 1)])) {
            let lexeme = lexemes[self.mark].clone();
            let no = Lexeme { token: Token::Word("no".to_owned()), lemma: None, ..lexeme.clone() };
            let comma = Lexeme { token: Token::Comma, lemma: None, ..lexeme };
            lexemes.splice(self.mark + 1..self.from, [no, comma]);
        } else {
            return false;
        }
        true
    }
}

/// What was wrong with what is right in the place of its counterpart.
fn replaced(wrong: &[Lexeme], right: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let first = word_of(right.first()?);
    let sets_out = first == "to" && longest_verb(&right[1..]).is_some();
    if sets_out || joint(right).is_some() || filler(right).is_some() {
        return None; // "well, to begin with, ..."
    }
    if LINKS.contains(&first) {
        let at = wrong.iter().rposition(|lexeme| word_of(lexeme) == first).filter(|at| *at > 0)?;
        let mut right = right.to_vec();
        // "On the blue bench, no, on the red one".
        let lone =
            wrong.len() > at + 2 && !wrong[at + 1..].iter().any(|lexeme| LINKS.contains(&word_of(lexeme)));
        if let (Some(one), true) = (right.iter_mut().find(|lexeme| word_of(lexeme) == "one"), lone) {
            *one = wrong[wrong.len() - 1].clone();
        }
        return Some([&wrong[..at], &right].concat());
    }
    if longest_verb(right).is_some() {
        // "Left, no, turn right": what was wrong is no order yet.
        return (wrong.len() <= 2 && longest_verb(wrong).is_none()).then(|| right.to_vec());
    }
    if let Some(mended) = nearness_replaced(wrong, right).or_else(|| goods_replaced(wrong, right)) {
        return Some(mended);
    }
    if ARTICLES.contains(&first) {
        return thing_replaced(wrong, right);
    }
    if is_choice(right) {
        return choice_replaced(wrong, right);
    }
    if let Some(mended) = direction_replaced(wrong, right) {
        return Some(mended);
    }
    if let Some(words) = direction(right).filter(|words| *words == right.len()) {
        let at = (0..wrong.len()).rfind(|at| direction(&wrong[*at..]).is_some())?;
        let behind = at + direction(&wrong[at..]).unwrap_or(0);
        return Some([&wrong[..at], &right[..words], &wrong[behind..]].concat());
    }
    if let Some((_, words)) = numbers::times(right).filter(|(_, words)| *words == right.len()) {
        let at = (0..wrong.len()).find(|at| numbers::times(&wrong[*at..]).is_some())?;
        let behind = at + numbers::times(&wrong[at..]).map_or(0, |(_, words)| words);
        return Some([&wrong[..at], &right[..words], &wrong[behind..]].concat());
    }
    number_replaced(wrong, right).or_else(|| name_replaced(wrong, right))
}

/// "The chair west, no, east of the campfire": the thing it is told from stands behind what is right alone.
fn direction_replaced(wrong: &[Lexeme], right: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let words = direction(right)?;
    let is_from = right.get(words).is_some_and(|of| word_of(of) == "of");
    let ends_with = |at: &usize| direction(&wrong[*at..]).is_some_and(|words| at + words == wrong.len());
    let at = (1..wrong.len()).find(ends_with).filter(|_| is_from)?;
    Some([&wrong[..at], right].concat())
}

/// "Left", "north": in how many words.
fn direction(said: &[Lexeme]) -> Option<usize> {
    let side = longest_phrase(said, &["left", "right"]);
    side.or_else(|| longest(said, DIRECTIONS).map(|(_, words)| words))
}

/// "The red chair, no, the yellow one", where one thing alone was named, or one alone by the same noun.
fn thing_replaced(wrong: &[Lexeme], right: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let ends = |said: &[Lexeme], from: usize| {
        let end = |at: &usize| [LINKS, ARTICLES].iter().any(|list| list.contains(&word_of(&said[*at])));
        (from + 1..said.len()).find(end).unwrap_or(said.len())
    };
    let articles: Vec<usize> = (1..wrong.len())
        .filter(|at| ARTICLES.contains(&word_of(&wrong[*at])) && !of_the_verb(wrong, *at))
        .collect();
    let same = |at: &&usize| wrong[ends(wrong, **at) - 1].token == right[ends(right, 0) - 1].token;
    // "The shortest, no, the tallest tree": of which kind is said behind.
    if let Some(at) = articles.last().copied()
        && is_choice(&wrong[at + 1..])
        && right.len() > 2
        && is_choice(&right[1..right.len() - 1])
    {
        return Some([&wrong[..at], right].concat());
    }
    let (at, last) = match articles[..] {
        [] => return None,
        [at] => (at, true),
        _ => {
            let mut named = articles.iter().filter(same);
            let at = *named.next().filter(|_| right.len() > 1)?;
            if named.next().is_some() {
                return None;
            }
            (at, articles.last() == Some(&at))
        }
    };
    let end = ends(wrong, at);
    let noun = (end > at + 1).then(|| wrong[end - 1].clone());
    let mut right = right.to_vec();
    if let Some(one) = right.iter_mut().find(|lexeme| word_of(lexeme) == "one") {
        // "Go to the red, no, the yellow chair" names it behind.
        *one = noun.filter(|_| end > at + 1)?;
    } else if is_choice(&right[1..]) {
        right.push(noun?); // "the second bench, no, the third"
    }
    // "Bring the basket to Luis, no, the parcel": where to stays as it was.
    let brought = wrong.get(end).is_some_and(|link| ["to", "over", "into"].contains(&word_of(link)));
    let links = right.iter().any(|lexeme| LINKS.contains(&word_of(lexeme)));
    let rest = if (brought || !last) && !links { &wrong[end..] } else { &[] };
    Some([&wrong[..at], &right[..], rest].concat())
}

/// "Take a seat": the article of a verb of several words.
fn of_the_verb(said: &[Lexeme], article: usize) -> bool {
    let covers = |from: usize| longest_verb(&said[from..]).is_some_and(|(_, words)| from + words > article);
    (article.saturating_sub(3)..article).any(covers)
}

/// "The nearest car, oops, second nearest".
fn choice_replaced(wrong: &[Lexeme], right: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let article = wrong.iter().rposition(|lexeme| ARTICLES.contains(&word_of(lexeme)))?;
    let [chosen @ .., noun] = wrong.get(article + 1..)? else { return None };
    is_choice(chosen).then(|| [&wrong[..=article], right, std::slice::from_ref(noun)].concat())
}

/// "Third", "second nearest": which of several, without what they are.
fn is_choice(mut said: &[Lexeme]) -> bool {
    let some = !said.is_empty();
    while !said.is_empty() {
        let words = numbers::ordinal(said).map(|_| 1).or_else(|| longest_phrase(said, NEAREST));
        let words = words.or_else(|| longest_phrase(said, FARTHEST));
        let Some(words) = words.or_else(|| longest(said, MOSTS).map(|(_, words)| words)) else {
            return false;
        };
        said = &said[words..];
    }
    some
}

/// "The bench nearest to Marta, no, nearest to Samira": to what something is near, or far from.
fn nearness_replaced(wrong: &[Lexeme], right: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let near = |said: &[Lexeme]| longest_phrase(said, NEAREST).or_else(|| longest_phrase(said, FARTHEST));
    let words = near(right)?;
    LINKS.contains(&word_of(right.get(words)?)).then_some(())?;
    let at = (1..wrong.len()).rfind(|at| {
        near(&wrong[*at..])
            .is_some_and(|words| wrong.get(at + words).is_some_and(|link| LINKS.contains(&word_of(link))))
    })?;
    Some([&wrong[..at], right].concat())
}

/// "Buy milk, I mean bread": one word for what is bought.
fn goods_replaced(wrong: &[Lexeme], right: &[Lexeme]) -> Option<Vec<Lexeme>> {
    const BUYS: &[&str] = &["buy", "order", "purchase", "get", "fetch"];
    // "Buy popcorn at the hut, no, a balloon".
    let some = right.first().is_some_and(|first| ["a", "an", "some"].contains(&word_of(first)));
    let verb = wrong.iter().position(|lexeme| BUYS.contains(&word_of(lexeme)));
    if let Some(verb) = verb.filter(|_| some && right.len() < 4)
        && let Some(link) = (verb + 2..wrong.len()).find(|at| ["at", "from"].contains(&word_of(&wrong[*at])))
    {
        return Some([&wrong[..=verb], right, &wrong[link..]].concat());
    }
    let [.., buys, goods] = wrong else { return None };
    let plain = |lexeme: &Lexeme| {
        matches!(&lexeme.token, Token::Word(_))
            && !ARTICLES.contains(&word_of(lexeme))
            && lexeme.lemma.is_none()
    };
    let one = right.len() == 1 && plain(&right[0]) && plain(goods) && BUYS.contains(&word_of(buys));
    one.then(|| [&wrong[..wrong.len() - 1], right].concat())
}

/// "Give it to Emil, no, Boris": one name for another.
fn name_replaced(wrong: &[Lexeme], right: &[Lexeme]) -> Option<Vec<Lexeme>> {
    const NO_NAMES: &[&str] = &[
        "there", "here", "it", "him", "her", "them", "not", "never", "whatever", "that", "this", "dont",
        "yes", "no",
    ];
    let [.., link, name] = wrong else { return None };
    let named =
        |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if !NO_NAMES.contains(&word.as_str()));
    let one = right.len() == 1 && named(&right[0]) && named(name) && LINKS.contains(&word_of(link));
    one.then(|| [&wrong[..wrong.len() - 1], right].concat())
}

/// "Two metres to the left, no, three": the number, with what it counts if that is said again.
fn number_replaced(wrong: &[Lexeme], right: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let (_, words) = numbers::number(right)?;
    let counted =
        |at: &usize| numbers::number(&wrong[*at..]).is_some() && !["a", "an"].contains(&word_of(&wrong[*at]));
    let mut at = (0..wrong.len()).rfind(counted)?;
    while at > 0
        && counted(&(at - 1))
        && numbers::number(&wrong[at - 1..]).is_some_and(|(_, words)| words > 1)
    {
        at -= 1;
    }
    let behind = at + numbers::number(&wrong[at..]).map_or(0, |(_, words)| words);
    let same =
        |count: usize| wrong.get(behind + count).is_some_and(|unit| unit.token == right[words + count].token);
    let units = (0..right.len() - words).take_while(|count| same(*count)).count();
    let rest = if words + units == right.len() { &wrong[behind + units..] } else { &[] };
    Some([&wrong[..at], right, rest].concat())
}

#[cfg(test)]
mod tests {
    use super::super::lexer::rewritten;
    use super::*;

    #[test]
    fn what_is_taken_back_is_put_right() {
        for (said, meant) in [
            ("take two photos. No, wait, make that three photos", "take three photos"),
            ("take two photos, no, three", "take three photos"),
            ("bring it to Luis. No, sorry, to Nora", "bring it to nora"),
            ("walk eight metres north. No, sorry, I meant eight metres east", "walk eight metres east"),
            ("walk eight metres north, no, east", "walk eight metres east"),
            ("step two metres to the left, no, three metres", "step three metres to the left"),
            ("turn right twice. No, three times", "turn right three times"),
            ("sit on the red chair, no, the yellow one", "sit on the yellow chair"),
            ("go to the second bench. Wait, I meant the third", "go to the third bench"),
            (
                "carry the crate to the bread stall, I mean the cheese stall",
                "carry the crate to the cheese stall",
            ),
            ("put the red ball on the table, no, the blue ball", "put the blue ball on the table"),
            ("sit on the blue bench, no, on the red one", "sit on the red bench"),
            ("take a photo of the shortest, no, the tallest tree", "take a photo of the tallest tree"),
            (
                "sit on the bench, sorry, the chair that's closest to the oak",
                "sit on the chair thats closest to the oak",
            ),
            ("give it to Emil, no, Boris", "give it to boris"),
            ("walk to the slide. No, sorry, to the oak I mean.", "walk to the oak ,"),
            ("wave at Nora. Sorry, at Omar", "wave at omar"),
            ("go to the, the bin the bin by the oak", "go to the bin by the oak"),
            ("sit down. No, wait, stand up", "sit down , no , stand up"),
            ("go to the oak. Sorry, I have a cold", "go to the oak , sorry , i have a cold"),
            ("tell Nora yes, no, sorry, at noon", "tell nora yes , no , sorry , at noon"),
        ] {
            let mended = rewritten(said, |lexemes| {
                mend(lexemes);
            });
            assert_eq!(mended, meant, "{said}");
        }
    }
}
