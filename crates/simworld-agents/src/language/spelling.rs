//! Misspelt words: each is put right if one known word, and one only, is near enough.

use std::sync::LazyLock;

use super::compass;
use super::lexer::{Lexeme, Token};
use super::lexicon::{CATEGORIES, COPULAS, DETERMINERS, FARTHEST, MOSTS, NEAREST, RELATIONS, SIDES};
use super::names::Names;
use super::paint::PAINTS;
use super::phrases::Index;
use super::politeness::{FILLERS, JOINTS};
use super::requests;
use super::slips;
use super::verbs::{self, base_form};

/// Words that people mean though a known word is near: none of them is a misspelling.
const OTHER_WORDS: &str = include_str!("other_words.txt");

/// Puts the words of a sentence right that are unknown and near one known word, or two known words in one; the words of
/// names and goods are known.
pub(super) fn correct(lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    correct_but(lexemes, names, &|_| false);
}

/// As [`correct`], where other words are known too.
pub(super) fn correct_but(lexemes: &mut Vec<Lexeme>, names: &Names<'_>, known: &dyn Fn(&str) -> bool) {
    slips::sound_words(lexemes);
    let mut at = 0;
    while at < lexemes.len() {
        let here = at;
        at += 1;
        let Token::Word(word) = &lexemes[here].token else { continue };
        // "Pleaes" is near other words too.
        let asks = word.starts_with("pl") && find(word).is_none() && !names.has_word(word) && !known(word);
        if let Some(please) = asks.then(|| slips::asked_politely(word, here, lexemes)).flatten() {
            lexemes[here].lemma = None;
            lexemes[here].token = Token::Word(please);
            continue;
        }
        let is_short = word.len() < 3 || word.chars().count() < 3;
        if is_short
            || lexemes[here].lemma.is_some()
            || is_known(word)
            || names.has_word(word)
            || known(word)
            || names.sort_of_asset(&lexemes[here..=here]).is_some()
        {
            continue;
        }
        let follows_verb =
            here > 0 && matches!(&lexemes[here - 1].token, Token::Word(word) if verbs::is_verb(word));
        if let Some([one, other]) = shifted(word, lexemes.get(here + 1)) {
            for (lexeme, word) in lexemes[here..].iter_mut().zip([one, other]) {
                lexeme.lemma = base_form(&word);
                lexeme.token = Token::Word(word);
            }
        } else if let Some(words) = slips::run_together(word) {
            let lexeme = lexemes[here].clone();
            let both = words.map(|word| Lexeme {
                lemma: base_form(&word),
                token: Token::Word(word),
                ..lexeme.clone()
            });
            lexemes.splice(here..=here, both);
        } else if let Some(right) = nearest(word, names, follows_verb).or_else(|| plural_of_name(word, names))
        {
            lexemes[here].lemma = base_form(&right);
            lexemes[here].token = Token::Word(right);
        } else if let Some(parts) = parts(word, names) {
            let lexeme = lexemes[here].clone();
            let both = parts.map(|part| Lexeme {
                lemma: base_form(&part),
                token: Token::Word(part),
                ..lexeme.clone()
            });
            lexemes.splice(here..=here, both);
        }
    }
}

/// "Pretzles": the plural of a word of names or goods that is written wrong.
fn plural_of_name(word: &str, names: &Names<'_>) -> Option<String> {
    const SHORTEST: usize = 4;
    let one = word.strip_suffix('s').filter(|one| one.len() >= SHORTEST)?;
    nearest(one, names, true).filter(|right| names.has_word(right)).map(|right| format!("{right}s"))
}

/// What is meant rather than a rarer word as near.
const FREQUENT: &[&str] = &[
    "the", "then", "and", "to", "it", "at", "on", "with", "from", "for", "turn", "take", "get", "there",
    "this", "that", "go", "sit", "pick", "walk", "second", "door", "parcel", "wait", "left", "right",
    "first", "bench", "chair", "please", "look", "wave", "buy", "point", "photo",
];

/// Words so frequent that a blank slips into them.
const SHIFTED: &[&str] = &[
    "to", "the", "at", "on", "in", "and", "of", "for", "by", "go", "with", "then", "it", "up", "a", "into",
    "from",
];

/// "Tot he" for "to the": a letter on the wrong side of the blank between two words.
fn shifted(word: &str, next: Option<&Lexeme>) -> Option<[String; 2]> {
    let Token::Word(next) = &next?.token else { return None };
    let (last, first) = (word.chars().next_back()?, next.chars().next()?);
    let back = [word[..word.len() - last.len_utf8()].to_owned(), format!("{last}{next}")];
    let forth = [format!("{word}{first}"), next[first.len_utf8()..].to_owned()];
    let are_words = |words: &[String; 2]| words.iter().all(|word| SHIFTED.contains(&word.as_str()));
    [back, forth].into_iter().find(are_words)
}

/// "Icecream", "busstop": two words of names, or two of the grammar, that are written as one.
fn parts(word: &str, names: &Names<'_>) -> Option<[String; 2]> {
    let has_meaning = |part: &str| find(part) == Some(true);
    let long = |part: &str| part.chars().count() >= 3;
    let mut splits =
        word.char_indices().map(|(at, _)| word.split_at(at)).filter(|(one, other)| long(one) && long(other));
    let fitting = splits.find(|(one, other)| {
        let shop = ["shop", "store", "stand", "stall"].contains(other);
        let (known, named) = (has_meaning(other), names.has_word(one));
        has_meaning(one) && known || named && (shop || names.has_word(other))
    });
    fitting.map(|(one, other)| [one.to_owned(), other.to_owned()])
}

/// Words that nobody means by another: a cannon is no slip of "cannot", which would turn an order round.
pub(super) const NO_SLIP: &[&str] = &["cannot"];

/// Words of conditions and quantities, which stand in no table of their own.
const MORE_WORDS: &str = include_str!("more_words.txt");

fn phrases() -> impl Iterator<Item = &'static str> {
    let classes = CATEGORIES.iter().flat_map(|category| category.words);
    let verbs = verbs::phrases().map(|(_, phrase)| phrase);
    let relations = RELATIONS.iter().flat_map(|(words, _)| *words);
    let sides = SIDES.iter().flat_map(|(words, _)| *words);
    let paints = PAINTS.iter().flat_map(|(words, _)| *words);
    let mosts = MOSTS.iter().flat_map(|(words, _)| *words);
    let rest = FILLERS.iter().chain(JOINTS).chain(COPULAS).chain(DETERMINERS).chain(NEAREST).chain(FARTHEST);
    let tables = classes.chain(relations).chain(sides).chain(paints).chain(mosts).chain(rest).copied();
    tables.chain(verbs)
}

/// A word of the grammar.
struct Known {
    word: &'static str,
    /// Whether it means something to the grammar.
    means: bool,
    letters: Letters,
    heard: Heard,
}

/// Every single word that is known, in alphabetical order.
fn vocabulary() -> &'static [Known] {
    static WORDS: std::sync::OnceLock<Vec<Known>> = std::sync::OnceLock::new();
    WORDS.get_or_init(|| {
        let meaning = phrases().flat_map(|phrase| phrase.split(' ')).chain(MORE_WORDS.split_whitespace());
        let small = requests::small_words().chain(compass::words().flat_map(|phrase| phrase.split(' ')));
        let other = OTHER_WORDS.split_whitespace().chain(small).map(|word| (word, false));
        let mut words: Vec<(&str, bool)> = meaning.map(|word| (word, true)).chain(other).collect();
        // Of a word in both lists the meaning counts.
        words.sort_unstable_by(|a, b| a.0.cmp(b.0).then(b.1.cmp(&a.1)));
        words.dedup_by_key(|(word, _)| *word);
        words
            .into_iter()
            .map(|(word, means)| Known { word, means, letters: Letters::of(word), heard: Heard::of(word) })
            .collect()
    })
}

/// Whether a known word means something to the grammar; `None` of a word that nobody knows.
fn find(word: &str) -> Option<bool> {
    static INDEX: LazyLock<Index<bool>> =
        LazyLock::new(|| Index::new(vocabulary().iter().map(|known| (known.word, known.means))));
    INDEX.alone(word)
}

/// The known words that begin so.
fn words_from(beginning: &str) -> &'static [Known] {
    let words = vocabulary();
    let from = words.partition_point(|known| known.word < beginning);
    let count = words[from..].partition_point(|known| known.word.starts_with(beginning));
    &words[from..from + count]
}

pub(super) fn is_known(word: &str) -> bool {
    let listed = |word: &str| find(word).is_some();
    listed(word)
        || word.strip_suffix('s').is_some_and(listed)
        || word.strip_suffix("es").is_some_and(listed)
        || word.strip_suffix("ies").is_some_and(|stem| listed(&format!("{stem}y")))
        || base_form(word).is_some()
}

/// How one spelling comes from another, the likeliest slip first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Slip {
    /// Letters out of order.
    Swapped,
    /// A letter too many or too few.
    Count,
    /// Another letter: it may be another word.
    Letter,
}

/// The known word nearest to one that is not: at most one edit, or two in seven letters, or two vowels. Of several as
/// near the likelier slip is taken, then what the grammar knows, then what is no verb behind a verb; if that leaves two,
/// or a word of no meaning here, none is.
fn nearest(word: &str, names: &Names<'_>, follows_verb: bool) -> Option<String> {
    let said = Said::new(word);
    let mut best: Vec<&str> = Vec::new();
    let mut least = (usize::MAX, true, Slip::Letter);
    let beginnings = beginnings(word);
    for beginning in &beginnings {
        let known = words_from(beginning)
            .iter()
            .map(|known| (known.word, Some(known.means), known.letters, Some(&known.heard)));
        let named = names.words_from(beginning).map(|name| (name, None, Letters::of(name), None));
        for (candidate, means, letters, heard) in known.chain(named) {
            let Some((distance, slip)) = said.slip(candidate, letters, heard) else { continue };
            if means.is_none() && !names.has_word(candidate) {
                continue; // a name of what is out of range
            }
            if NO_SLIP.contains(&candidate) {
                continue;
            }
            // What sounds so is nearer than what is written so, but not if it means nothing here: a "whiet" car is white, and not of wheat.
            let distance = if means == Some(false) { distance.max(1) } else { distance };
            let rank = (distance, means == Some(false), slip);
            if rank < least {
                least = rank;
                best.clear();
            }
            if rank == least && !best.contains(&candidate) {
                best.push(candidate);
            }
        }
    }
    if follows_verb && best.len() > 1 {
        best.retain(|word| !verbs::is_verb(word));
    }
    if best.len() > 1 {
        // Of two that sound the same the one that is written more like it: a "wel" is a well, and no wheel.
        let edits = |candidate: &str| strsim::osa_distance(word, candidate);
        let fewest = best.iter().map(|word| edits(word)).min();
        best.retain(|word| Some(edits(word)) == fewest);
    }
    if best.len() > 1 {
        // A letter is left out rather than added, and frequent words are meant rather than others.
        let longer = |candidate: &&str| candidate.len() > word.len();
        let frequent = |candidate: &&str| FREQUENT.contains(candidate);
        let one_of = |fits: &dyn Fn(&&str) -> bool| best.iter().filter(|word| fits(word)).count() == 1;
        if one_of(&frequent) {
            best.retain(|word| frequent(word));
        } else if one_of(&longer) {
            best.retain(|word| longer(word));
        }
    }
    match best[..] {
        [one] if !least.1 => Some(one.to_owned()),
        _ => None,
    }
}

/// How words may begin of which this is a slip: slips keep the first letter, swap it with the second, or write "ph" and
/// "f" for one another.
fn beginnings(word: &str) -> Vec<String> {
    let mut letters = word.chars();
    let (Some(first), Some(second)) = (letters.next(), letters.next()) else { return Vec::new() };
    let mut all = vec![first.to_string()];
    if second != first {
        all.push([second, first].into_iter().collect());
    }
    match (first, second) {
        ('p', 'h') => all.push("f".to_owned()),
        ('f', _) => all.push("ph".to_owned()),
        _ => {}
    }
    all
}

/// Which letters stand in a word, a bit each; all that are not a to z share one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Letters(u32);

impl Letters {
    const VOWELS: u32 =
        Self::bit('a') | Self::bit('e') | Self::bit('i') | Self::bit('o') | Self::bit('u') | Self::bit('y');

    pub(super) fn of(word: &str) -> Self {
        Self(word.chars().fold(0, |letters, letter| letters | Self::bit(letter)))
    }

    const fn bit(letter: char) -> u32 {
        if letter.is_ascii_lowercase() { 1 << (letter as u32 - 'a' as u32) } else { 1 << 26 }
    }

    /// No spelling is fewer edits away than that from one with the other letters.
    pub(super) const fn least_edits(self, other: Self) -> usize {
        let (extra, missing) = ((self.0 & !other.0).count_ones(), (other.0 & !self.0).count_ones());
        if extra > missing { extra as usize } else { missing as usize }
    }

    const fn same_consonants(self, other: Self) -> bool {
        self.0 & !Self::VOWELS == other.0 & !Self::VOWELS
    }
}

/// A word as it was written.
struct Said<'a> {
    word: &'a str,
    length: usize,
    letters: Letters,
    heard: Heard,
}

impl<'a> Said<'a> {
    fn new(word: &'a str) -> Self {
        Self { word, length: word.chars().count(), letters: Letters::of(word), heard: Heard::of(word) }
    }

    /// How far it is from a word that it may begin like, in edits, and what kind of slip that is; `None` if it is too far.
    fn slip(&self, candidate: &str, letters: Letters, heard: Option<&Heard>) -> Option<(usize, Slip)> {
        let Self { word, length, .. } = *self;
        let tolerance = if length < 7 { 1 } else { 2 };
        let least = self.letters.least_edits(letters);
        if least > 2 || candidate.len() < 3 || candidate.len().abs_diff(word.len()) > 2 {
            return None;
        }
        if heard.map_or_else(|| self.heard.is_like(&Heard::of(candidate)), |heard| self.heard.is_like(heard))
        {
            // What sounds the same is likelier than letters out of order: "foto" is no "foot".
            return Some((0, Slip::Count));
        }
        let may_be_vowels = length >= 4 && self.letters.same_consonants(letters);
        if least > tolerance && !may_be_vowels || !alike(word, candidate) {
            return None;
        }
        let distance = strsim::osa_distance(word, candidate);
        let only_vowels = may_be_vowels && distance == 2 && skeleton(word).eq(skeleton(candidate));
        if distance > tolerance {
            return only_vowels.then_some((distance, Slip::Letter));
        }
        let slip = match candidate.chars().count() == length {
            true if is_anagram(word, candidate) => Slip::Swapped,
            true => Slip::Letter,
            false => Slip::Count,
        };
        (!(length == 3 && slip == Slip::Letter)).then_some((distance, slip))
    }
}

/// How a word sounds, once by its letters alone and once more freely.
struct Heard {
    plain: String,
    sounds: String,
}

impl Heard {
    fn of(word: &str) -> Self {
        let mut heard: Vec<char> = sounds(word).collect();
        // A silent "e" at the end aside.
        let silent =
            heard.len() > 2 && heard.last() == Some(&'e') && heard[heard.len() - 3].is_ascii_uppercase();
        heard.truncate(heard.len() - usize::from(silent));
        Self { plain: plain(word).collect(), sounds: heard.into_iter().collect() }
    }

    fn is_like(&self, other: &Self) -> bool {
        self.plain == other.plain || self.sounds == other.sounds
    }
}

/// The letters of a word, each once however often it stands in a row, with "ph" as "f".
fn plain(word: &str) -> impl Iterator<Item = char> {
    let mut letters = word.chars().peekable();
    let mut last = None;
    std::iter::from_fn(move || {
        loop {
            let letter = letters.next()?;
            let sound = match (letter, letters.peek()) {
                ('p', Some('h')) => Some('f'),
                ('c', Some('k')) => Some('k'),
                ('w', Some('h')) => Some('w'),
                _ => None,
            };
            if sound.is_some() {
                letters.next();
            }
            let sound = sound.unwrap_or(letter);
            if last.replace(sound) != Some(sound) {
                return Some(sound);
            }
        }
    })
}

/// The letters of a word as it sounds, roughly: "foto" and "photo" are one, and so are "wate" and "wait".
fn sounds(word: &str) -> impl Iterator<Item = char> {
    let letters: Vec<char> = word.chars().collect();
    let mut at = 0;
    let mut last = None;
    std::iter::from_fn(move || {
        while at < letters.len() {
            let (sound, count) = sound(&letters[at..]);
            at += count;
            if let Some(sound) = sound
                && last.replace(sound) != Some(sound)
            {
                return Some(sound);
            }
        }
        None
    })
}

/// The first sound of some letters, and how many of them make it; long vowels are capital letters.
fn sound(letters: &[char]) -> (Option<char>, usize) {
    #[rustfmt::skip]
    const PAIRS: &[(&str, char)] = &[
        ("ph", 'f'), ("ck", 'k'), ("wh", 'w'), ("ai", 'A'), ("ay", 'A'), ("ei", 'A'), ("ee", 'E'), ("ea", 'E'),
        ("ie", 'E'), ("oa", 'O'), ("oe", 'O'), ("oo", 'U'), ("ue", 'U'), ("ui", 'U'), ("ou", 'U'), ("gh", 'h'), ("kn", 'n'),
        ("wr", 'r'), ("sc", 's'), ("qu", 'q'),
    ];
    let is_vowel = |letter: &char| "aeiou".contains(*letter);
    if let [first, second, ..] = letters {
        let pair = PAIRS.iter().find(|(pair, _)| pair.chars().eq([*first, *second]));
        let soft = *second != 'c' || letters.get(2).is_some_and(|next| "eiy".contains(*next));
        if let Some((_, sound)) = pair.filter(|(pair, _)| *pair != "sc" || soft) {
            return (Some(*sound), 2);
        }
        if *first == 'c' && "eiy".contains(*second) {
            return (Some('s'), 1);
        }
    }
    match letters {
        // "Wate": the silent letter at the end makes the vowel long.
        [vowel, between, 'e'] if is_vowel(vowel) && !is_vowel(between) => {
            (Some(vowel.to_ascii_uppercase()), 1)
        }
        ['e'] => (Some('e'), 1),
        [letter, ..] => (Some(*letter), 1),
        [] => (None, 1),
    }
}

/// Its first letter and the consonants behind it.
fn skeleton(word: &str) -> impl Iterator<Item = char> {
    word.chars()
        .enumerate()
        .filter(|(at, letter)| *at == 0 || !"aeiouy".contains(*letter))
        .map(|(_, letter)| letter)
}

/// Whether the first letter is kept, or swapped with the second.
fn alike(word: &str, candidate: &str) -> bool {
    let (mut a, mut b) = (word.chars(), candidate.chars());
    let (a0, b0, a1, b1) = (a.next(), b.next(), a.next(), b.next());
    a0 == b0 || (a0 == b1 && a1 == b0)
}

pub(super) fn is_anagram(a: &str, b: &str) -> bool {
    let sorted = |text: &str| {
        let mut letters: Vec<char> = text.chars().collect();
        letters.sort_unstable();
        letters
    };
    sorted(a) == sorted(b)
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::Point2;
    use simworld_core::scene::World;

    use super::*;

    #[test]
    fn slips_are_put_right_and_other_words_left_alone() {
        let world = World::new();
        let none = Names::new(&world, Point2::origin(), 100.0);
        for (slip, right) in [
            ("musem", "museum"),
            ("chiar", "chair"),
            ("pikc", "pick"),
            ("nearst", "nearest"),
            ("teh", "the"),
            ("wallk", "walk"),
        ] {
            assert_eq!(nearest(slip, &none, false).as_deref(), Some(right), "{slip}");
        }
        for word in ["beach", "peer", "boat", "horse", "floor"] {
            assert!(is_known(word), "{word} is a word of its own");
        }
    }
}
