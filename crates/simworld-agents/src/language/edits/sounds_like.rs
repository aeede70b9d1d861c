//! Words that are written as they sound: "taksi", "piknik", "skooter", "chare".
//!
//! Two words sound alike if their consonants do, one by one and the first sound with them, and their vowels nearly. This is asked only of words that nobody knows, in
//! sentences that were refused, and of two words that sound as much alike neither is meant.

use std::collections::BTreeMap;

use super::super::spelling::NO_SLIP;

/// Shorter words are near too many others, in letters.
const SHORTEST: usize = 3;
/// From this length on, in sounds, two vowels may be others.
const LONG: usize = 7;

/// Pairs of letters that are one sound.
#[rustfmt::skip]
const PAIRS: &[(&str, &str)] = &[
    ("ph", "f"), ("ck", "k"), ("ch", "C"), ("sh", "S"), ("wh", "w"), ("qu", "kw"), ("gh", ""),
    ("ee", "i"), ("ea", "i"), ("ie", "i"), ("oo", "u"), ("ou", "u"), ("ue", "u"), ("ui", "u"), ("ew", "u"), ("ai", "e"), ("ay", "e"), ("ei", "e"), ("ey", "i"), ("oa", "o"), ("oe", "o"),
];

/// A word as it sounds, roughly.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Sound {
    sounds: String,
    consonants: String,
}

impl Sound {
    pub(super) fn of(word: &str) -> Self {
        let word = plain_ending(&full_ending(word));
        let mut sounds = String::with_capacity(word.len());
        let mut rest = word.as_str();
        while let Some(letter) = rest.chars().next() {
            let (sound, count) = first_sound(rest, letter, sounds.is_empty());
            for one in sound.chars().map(near_vowel) {
                if !sounds.ends_with(one) {
                    sounds.push(one);
                }
            }
            rest = rest.get(count..).unwrap_or_default();
        }
        let consonants = sounds.chars().filter(|sound| !is_vowel(*sound)).collect();
        Self { sounds, consonants }
    }

    /// In how many sounds it is another; none if it sounds otherwise.
    fn distance(&self, other: &Self) -> Option<usize> {
        let (own, its) = (self.sounds.as_bytes(), other.sounds.as_bytes());
        if self.consonants != other.consonants || own.first() != its.first() {
            return None;
        }
        let is_long = own.len().min(its.len()) >= LONG;
        if !is_long && self.syllables() != other.syllables() {
            return None;
        }
        // "A" is near all vowels, and "e" is no "o".
        let is_near = |(one, another): (&u8, &u8)| one == another || [one, another].contains(&&b'a');
        if own.len() == its.len() && !own.iter().zip(its).all(is_near) {
            return None;
        }
        let distance = strsim::osa_distance(&self.sounds, &other.sounds);
        (distance <= if is_long { 2 } else { 1 }).then_some(distance)
    }

    /// How many times vowels begin.
    fn syllables(&self) -> usize {
        self.sounds.split(|sound: char| !is_vowel(sound)).filter(|vowels| !vowels.is_empty()).count()
    }
}

/// One of three vowels: those that are taken for one another are one.
const fn near_vowel(sound: char) -> char {
    match sound {
        'i' => 'e',
        'u' => 'o',
        other => other,
    }
}

const fn is_vowel(sound: char) -> bool {
    matches!(sound, 'a' | 'e' | 'i' | 'o' | 'u')
}

/// "Barbeqe": no word ends so, and who writes it says all the letter's name.
fn full_ending(word: &str) -> String {
    let stem = ["qe", "qeu", "qu", "kyu"].iter().find_map(|end| word.strip_suffix(*end));
    stem.filter(|stem| !stem.is_empty()).map_or_else(|| word.to_owned(), |stem| format!("{stem}cue"))
}

/// The endings that sound the same, written in one way: "tabel" and "table", "theatre" and "theater", "fence" and "fens".
fn plain_ending(word: &str) -> String {
    let is_hard =
        |stem: &str| stem.ends_with(|letter: char| !is_vowel(letter) && letter != 'y') && stem.len() > 1;
    let ends = [("le", "l"), ("el", "l"), ("re", "er"), ("e", "")];
    let plain = ends.iter().find_map(|(end, plain)| {
        let stem = word.strip_suffix(*end).filter(|stem| is_hard(stem))?;
        // Before a silent "e" these letters are soft: "fence" is no "fenc".
        let soft = if end.len() == 1 && stem.ends_with('c') { "s" } else { "" };
        let stem = if soft.is_empty() { stem } else { stem.trim_end_matches('c') };
        Some(format!("{stem}{soft}{plain}"))
    });
    plain.unwrap_or_else(|| word.to_owned())
}

/// The first sound of some letters, and how many bytes make it.
fn first_sound(rest: &str, letter: char, is_first: bool) -> (String, usize) {
    let next = rest.chars().nth(1).unwrap_or(' ');
    if rest.starts_with("sch") {
        return ("sk".to_owned(), 3);
    }
    if rest.starts_with("tch") {
        return ("C".to_owned(), 3);
    }
    if is_first && (rest.starts_with("kn") || rest.starts_with("wr")) {
        return (next.to_string(), 2);
    }
    // "Kayak" has a consonant where "bay" has none.
    let is_glide = |pair: &str| pair.ends_with('y') && rest.chars().nth(2).is_some_and(is_vowel);
    if let Some((pair, sound)) = PAIRS.iter().find(|(pair, _)| rest.starts_with(pair) && !is_glide(pair)) {
        return ((*sound).to_owned(), pair.len());
    }
    let is_soft = matches!(next, 'e' | 'i' | 'y');
    let sound = match letter {
        'c' if is_soft => "s".to_owned(),
        'c' | 'q' => "k".to_owned(),
        'x' if !is_first => "ks".to_owned(),
        'x' | 'z' => "s".to_owned(),
        // "Yard" begins with a consonant, and "bycicle" has a vowel.
        'y' if !is_vowel(next) => "i".to_owned(),
        other => other.to_string(),
    };
    (sound, letter.len_utf8())
}

/// Whether two words may begin with the same sound, by their first letters.
fn may_begin_alike(one: &str, other: &str) -> bool {
    const ALIKE: &[&[u8]] = &[b"ckqszx", b"fp", b"kn", b"wr", b"aeiy", b"aou"];
    let firsts = one.bytes().next().zip(other.bytes().next());
    firsts.is_some_and(|(one, other)| {
        one == other || ALIKE.iter().any(|letters| letters.contains(&one) && letters.contains(&other))
    })
}

/// The one word of some that sounds most like another. Of two as near in sound the one that is written more like it is meant.
pub(super) fn meant<'a>(said: &str, words: impl Iterator<Item = (&'a str, bool)>) -> Option<String> {
    if said.len() < SHORTEST || !said.is_ascii() {
        return None;
    }
    let sound = Sound::of(said);
    // By how near it is: in sound, in letters, and whether it is a word of everybody.
    let mut near: BTreeMap<(usize, usize, bool), Vec<&str>> = BTreeMap::new();
    for (word, is_rare) in words {
        let may_be = may_begin_alike(said, word)
            && word.is_ascii()
            && word.len() >= SHORTEST
            && word.len().abs_diff(said.len()) <= 3
            && !NO_SLIP.contains(&word);
        if !may_be {
            continue;
        }
        if let Some(distance) = sound.distance(&Sound::of(word)) {
            near.entry((distance, strsim::osa_distance(said, word), is_rare)).or_default().push(word);
        }
    }
    let (_, best) = near.into_iter().next()?;
    match best[..] {
        [only] => Some(only.to_owned()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WORDS: &[&str] = &[
        "taxi",
        "picnic",
        "table",
        "benches",
        "bench",
        "hospital",
        "museum",
        "fountain",
        "bicycle",
        "scooter",
        "restaurant",
        "tree",
        "chair",
        "school",
        "face",
        "fence",
        "cake",
        "kiosk",
        "sack",
        "choir",
        "light",
        "phone",
        "barbecue",
    ];

    fn heard(said: &str) -> Option<String> {
        meant(said, WORDS.iter().map(|word| (*word, false)))
    }

    #[test]
    fn what_is_written_as_it_sounds_is_found() {
        for (said, right) in [
            ("taksi", "taxi"),
            ("piknik", "picnic"),
            ("tabel", "table"),
            ("hospitl", "hospital"),
            ("musuem", "museum"),
            ("fontain", "fountain"),
            ("bycicle", "bicycle"),
            ("skooter", "scooter"),
            ("resturant", "restaurant"),
            ("chare", "chair"),
            ("skool", "school"),
            ("fase", "face"),
            ("fens", "fence"),
            ("fone", "phone"),
            ("barbeqe", "barbecue"),
            ("barbiqu", "barbecue"),
        ] {
            assert_eq!(heard(said).as_deref(), Some(right), "{said}");
        }
    }

    #[test]
    fn what_sounds_otherwise_or_like_two_is_not() {
        for said in ["kayak", "dragon", "tank", "desk", "x", "kaaba"] {
            assert_eq!(heard(said), None, "{said}");
        }
        let others = ["eagle", "canine", "copper"].map(|word| (word, false));
        for said in ["igloo", "cannon", "keeper"] {
            assert_eq!(meant(said, others.into_iter()), None, "{said}");
        }
        let two = ["boot", "boat"].map(|word| (word, false));
        assert_eq!(meant("bout", two.into_iter()), None, "both are as near");
    }
}
