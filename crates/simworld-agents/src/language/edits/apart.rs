//! Verbs of several words that stand apart: "throw the red one out", "give the taxi a coat of pink", "a bin instead of the
//! bench", "only keep the white car".

use super::super::clause::{Count, Reference, Target};
use super::super::lexer::{Lexeme, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::says::{DEEPEST, is_it};
use super::wish::{NewThing, Wish};
use super::words::{VERBS, Verb};

/// Verbs that mean to remove something with a particle behind it.
#[rustfmt::skip]
const TAKES: &Phrases = &Phrases::of(&["throw", "take", "chuck", "get", "tear", "knock", "pull", "cut", "chop", "toss", "kick", "haul", "cart", "clear", "sweep",
    "carry", "send", "bring", "drag", "push", "rip", "strip", "wipe", "lift", "put", "clean", "dig", "move", "pluck", "have", "want", "make", "let",
    "see", "strike", "cross", "rub", "tow", "drive", "pack", "hack", "saw", "blow", "burn", "wash", "shove", "fling", "sling", "hurl", "bin", "roll", "wheel", "ship", "cast", "turf", "boot", "whisk", "spirit", "heave", "hoof", "shoo", "hoick", "hoik", "yank"]);
/// The particles.
#[rustfmt::skip]
const AWAY: &Phrases = &Phrases::of(&["away", "out", "off", "out of here", "out of there", "out of the way", "out of the scene", "from the scene", "from here", "off the map",
    "out of sight", "to the dump", "to the scrapyard", "out of my sight", "from the map", "from my sight", "out of the picture", "off the scene",
    "into the trash", "in the trash", "go away", "go", "disappear", "vanish", "gone", "removed", "deleted", "out of town", "out of existence",
    "off the face of the earth", "away from here", "go byebye", "byebye", "bye bye", "off the street", "away for good", "out for good", "leave",
    "towed away", "towed", "hauled away", "carted off", "carted away", "collected", "scrapped", "cleared away", "cleared", "taken off", "dug out", "cut down", "felled", "out of the city", "out of the campus", "from the city", "off campus", "off site", "taken away", "taken out", "thrown out", "thrown away", "to the tip"]);
/// As [`AWAY`], behind verbs of cutting and pulling.
const DOWN: &[&str] = &["down"];
const CUTS: &Phrases = &Phrases::of(&[
    "cut", "tear", "knock", "pull", "chop", "take", "bring", "saw", "hack", "burn", "blow", "rip", "strip",
    "strike",
]);
/// Before a thing and the paint that it gets.
#[rustfmt::skip]
const COATS: &Phrases = &Phrases::of(&["give", "do", "have", "get", "dress", "wrap", "dip", "drench", "coat", "cover", "finish", "make", "turn", "change", "switch", "set",
    "redo", "style", "put", "slather", "decorate", "render", "want", "let", "hand", "colour", "color", "brush", "lacquer", "varnish", "spray", "bathe", "id like", "i would like",
    "recoat", "keep", "leave", "see", "show", "convert", "transform", "i want", "we want", "id prefer", "id love", "wed like", "id rather have"]);
/// Before paint that something gets.
#[rustfmt::skip]
const SPLASH: &Phrases = &Phrases::of(&["put", "splash", "slap", "brush", "throw", "spread", "apply", "use", "add", "pour", "spray", "paint", "dab", "smear", "slosh"]);
/// What the paint is a coat of.
const COAT: &Phrases = &Phrases::of(&[
    "a", "some", "fresh", "new", "coat", "coats", "lick", "layer", "of", "splash", "dash", "touch", "bit",
    "little", "nice", "bright", "the", "two", "good", "lovely", "quick", "can", "bucket", "pot", "colour",
    "color", "light", "dark", "deep",
]);
/// That one thing is to stand in the place of another, before the other.
#[rustfmt::skip]
const INSTEAD_OF: &Phrases = &Phrases::of(&["instead of", "in place of", "in the place of", "in lieu of", "rather than", "in exchange for", "as a replacement for",
    "to replace", "replacing", "for replacing", "in the stead of", "in the spot of"]);
/// What becomes of a thing that is another from then on.
#[rustfmt::skip]
const BECOMES: &Phrases = &Phrases::of(&["into", "to", "become", "becomes", "be", "should be", "should become", "for", "with", "in favour of", "in favor of", "by", "turn into",
    "turns into", "should turn into", "could be", "could become", "ought to be", "must be", "must become", "has to become", "has to be", "would be better as",
    "would look better as", "should be replaced by", "should be replaced with", "as", "were", "was", "would be nicer as", "to become", "to be", "should rather be",
    "should make way for", "has to make way for", "makes way for", "make way for", "must make way for", "gives way to", "should give way to"]);
/// Before the thing that becomes another.
#[rustfmt::skip]
const CHANGES: &Phrases = &Phrases::of(&["turn", "change", "make", "convert", "transform", "exchange", "trade", "swap", "let", "switch", "have", "morph", "trade in", "replace", "upgrade",
    "substitute", "swap out", "switch out", "change out", "i want", "id like", "i would like", "id rather have", "we want", "redo", "rebuild", "remodel", "drop", "ditch", "remove"]);
/// That all but something is to go.
#[rustfmt::skip]
const KEEPS: &Phrases = &Phrases::of(&["only keep", "keep only", "just keep", "keep just", "keep nothing but", "leave only", "only leave", "leave nothing but", "leave just", "just leave",
    "spare only", "only spare", "keep none but", "nothing but", "retain only", "only retain"]);

impl Reader<'_> {
    /// Verbs of several words that stand apart.
    pub(super) fn apart(&self, at: usize, end: usize) -> Option<Wish> {
        let end = self.before_politeness(at, end);
        self.kept(at, end)
            .or_else(|| if at > 0 { self.goodbye(at, end) } else { None })
            .or_else(|| self.replaced(at, end))
            .or_else(|| self.put_in_place(at, end))
            .or_else(|| self.taken_away(at, end))
            .or_else(|| self.coated(at, end))
    }

    /// "Throw the red chair out", "make the cone disappear".
    fn taken_away(&self, at: usize, end: usize) -> Option<Wish> {
        let words = longest_phrase(&self.lexemes[at..end], TAKES)?;
        let is_cut = longest_phrase(&self.lexemes[at..end], CUTS).is_some();
        (at + words + 1..end).find_map(|cut| {
            let rest = &self.lexemes[cut..end];
            let away = longest_phrase(rest, AWAY) == Some(rest.len());
            let down = is_cut && longest_phrase(rest, DOWN) == Some(rest.len());
            let what = self.things(at + words, cut).ok().filter(|_| away || down)?;
            self.is_definite(at + words).then_some(Wish::Remove { what })
        })
    }

    /// That what is to be taken away or down is not there: "tear the library down".
    pub(super) fn not_taken(&self, end: usize) -> Option<simworld_core::seam::PlanError> {
        let at = self.polite_at(0);
        let end = self.before_politeness(at, end);
        let words = longest_phrase(self.lexemes.get(at..end)?, TAKES)?;
        let last = end.checked_sub(1).filter(|last| at + words < *last)?;
        let rest = &self.lexemes[last..end];
        if longest_phrase(rest, AWAY).is_none() && longest_phrase(rest, DOWN).is_none() {
            return None;
        }
        match self.things(at + words, last) {
            Err(error @ simworld_core::seam::PlanError::NotFound { .. }) => Some(error),
            _ => None,
        }
    }

    /// "Tow the car": away, if no place to which it is towed is named.
    pub(super) fn towed(&self, at: usize, end: usize) -> Option<Wish> {
        let end = self.before_politeness(at, end);
        let is_tow = at > 0 && matches!(self.word(at - 1), Some("tow" | "towed"));
        let leads = |at: usize| self.is_place(at) && !matches!(self.word(at), Some("on" | "in" | "from"));
        if !is_tow || !self.is_certain(at) || (at..end).any(leads) {
            return None;
        }
        let away = longest_phrase(&self.lexemes[end - 1..end], &["away", "off"]).unwrap_or(0);
        self.things(at, end - away).ok().map(|what| Wish::Remove { what })
    }

    /// "Give the taxi a fresh coat of pink", "put some pink paint on the taxi", "do the taxi up in pink".
    pub(super) fn coated(&self, at: usize, end: usize) -> Option<Wish> {
        if let Some(words) = longest_phrase(&self.lexemes[at..end], SPLASH) {
            let small = (at + words..end)
                .take_while(|at| self.word(*at).is_some_and(|word| COAT.contains(word)))
                .count();
            let from = at + words + small;
            if let Some((paint, words)) = longest(&self.lexemes[from..end], super::super::paint::PAINTS) {
                let mut next = from + words;
                next += longest_phrase(&self.lexemes[next..end], &["paint", "colour", "color"]).unwrap_or(0);
                if let Some(on) = longest_phrase(
                    &self.lexemes[next..end],
                    &["on", "onto", "over", "all over", "for", "on to", "to"],
                ) && let Ok(what) = self.things(next + on, end)
                {
                    return Some(Wish::Paint { what, paint });
                }
            }
        }
        let words = longest_phrase(&self.lexemes[at..end], COATS)?;
        (at + words + 1..end).find_map(|cut| {
            let from = cut
                + longest_phrase(
                    &self.lexemes[cut..end],
                    &["up in", "over in", "up", "over", "painted", "out in", "done in"],
                )
                .unwrap_or(0);
            let from = from
                + (from..end).take_while(|at| self.word(*at).is_some_and(|word| COAT.contains(word))).count();
            let paint = self.colour_to(from, end)?;
            let what = self.things(at + words, cut).ok()?;
            self.is_definite(at + words).then_some(Wish::Paint { what, paint })
        })
    }

    /// "Turn the bench into a table", "the bench should be a table", "swap the bench for a table".
    fn replaced(&self, at: usize, end: usize) -> Option<Wish> {
        let words = longest_phrase(&self.lexemes[at..end], CHANGES).unwrap_or(0);
        let from = at + words;
        (from + 1..end).find_map(|cut| {
            let becomes = longest_phrase(&self.lexemes[cut..end], BECOMES)?;
            let mut with = cut + becomes;
            with += longest_phrase(&self.lexemes[with.min(end)..end], &["rather", "instead", "please"])
                .unwrap_or(0);
            if with >= end || self.is_definite(with) || !self.is_definite(from) {
                return None;
            }
            let what = self.one_of(from, cut).ok()?;
            let mut reader = Reader { at: with, ..self.up_to(end) };
            let with = reader.new_thing(end).ok().filter(|with| reader.at >= end && is_some_thing(with))?;
            Some(Wish::Replace { what, with })
        })
    }

    /// "A bin instead of the bench", "where the bike is, a motorbike should be instead".
    fn put_in_place(&self, at: usize, end: usize) -> Option<Wish> {
        let (from, to, what) =
            (at..end).find_map(|from| self.stead(from, end).map(|(to, what)| (from, to, what)))?;
        let rest: Vec<Lexeme> =
            self.lexemes[at..from].iter().chain(&self.lexemes[to..end]).cloned().collect();
        let inner = Reader { depth: DEEPEST, ..self.over(&rest) };
        inner.only_new(rest.len()).map(|with| Wish::Replace { what, with })
    }

    /// "Instead of the bench" from here on, or "where the bench is"; and where that ends.
    fn stead(&self, from: usize, end: usize) -> Option<(usize, Reference)> {
        let rest = &self.lexemes[from..end];
        let rather = (0..from).any(|at| matches!(self.word(at), Some("rather" | "prefer" | "sooner")));
        let than = if rather { longest_phrase(rest, &["than", "to"]) } else { None };
        if let Some(words) = longest_phrase(rest, INSTEAD_OF).or(than) {
            let at = from + words;
            return (at + 1..=end)
                .rev()
                .find_map(|to| self.one_of(at, to).ok().filter(|what| !is_it(what)).map(|what| (to, what)));
        }
        let words = longest_phrase(
            rest,
            &[
                "where",
                "in the spot where",
                "just where",
                "right where",
                "at the spot where",
                "on the spot where",
                "exactly where",
            ],
        )?;
        let at = from + words;
        (at + 1..end).find_map(|cut| {
            let is = longest_phrase(
                &self.lexemes[cut..end],
                &[
                    "is",
                    "stands",
                    "sits",
                    "is now",
                    "is standing",
                    "stands now",
                    "is right now",
                    "is at the moment",
                    "is parked",
                    "lies",
                    "currently is",
                    "currently stands",
                    "is currently",
                    "sits now",
                    "stood",
                    "was",
                    "used to be",
                    "used to stand",
                    "has been",
                    "was before",
                    "stood before",
                ],
            )?;
            Some((cut + is, self.one_of(at, cut).ok().filter(|what| !is_it(what))?))
        })
    }

    /// One new thing and small words, and nothing else.
    fn only_new(&self, end: usize) -> Option<NewThing> {
        #[rustfmt::skip]
        const TAILS: &Phrases = &Phrases::of(&["should be", "should stand", "instead", "should go", "goes", "must be", "would be better", "would be nicer", "there", "now",
            "has to be", "could be", "comes", "is needed", "would be nice", "would be great", "ought to be", "belongs", "must stand", "please", "should come"]);
        let mut stop = self.before_politeness(0, end);
        loop {
            let cut = (1..stop).find(|at| {
                longest_phrase(&self.lexemes[*at..stop], TAILS) == Some(stop - at)
                    || is_mark(&self.lexemes[*at]) && at + 1 == stop
            });
            match cut {
                Some(cut) => stop = cut,
                None => break,
            }
        }
        self.beginnings(0, stop).into_iter().find_map(|begins| {
            let mut at = begins.at;
            at += self.lexemes[at..stop].iter().take_while(|lexeme| is_mark(lexeme)).count();
            let verb = longest(&self.lexemes[at..stop], &VERBS)
                .filter(|(verb, _)| matches!(verb, Verb::Add | Verb::Put | Verb::Take));
            at += verb.map_or(0, |(_, words)| words);
            if at >= stop || self.is_definite(at) {
                return None;
            }
            let mut reader = Reader { at, ..self.up_to(stop) };
            reader.new_thing(stop).ok().filter(|_| reader.at >= stop)
        })
    }

    /// "Only keep the white car": all others of its class go.
    fn kept(&self, at: usize, end: usize) -> Option<Wish> {
        const STAYS: &Phrases = &Phrases::of(&[
            "may stay",
            "can stay",
            "should stay",
            "stays",
            "stay",
            "may remain",
            "should remain",
            "remains",
            "is to stay",
            "must stay",
            "shall stay",
            "gets to stay",
            "shall remain",
            "is to remain",
        ]);
        // "Only the tallest tree may stay".
        let stays =
            (at + 1..end).find(|cut| longest_phrase(&self.lexemes[*cut..end], STAYS) == Some(end - cut));
        let only = longest_phrase(&self.lexemes[at..end], &["only"]).and_then(|words| Some((words, stays?)));
        let keeps = longest_phrase(&self.lexemes[at..end], KEEPS).map(|words| (words, end));
        let (words, stop) = only.or(keeps)?;
        let kept = self.one_of(at + words, stop).ok()?;
        let Target::Any(_) = &kept.target else { return None };
        let mut all = Reference::to(kept.target.clone(), kept.text.clone());
        let mut kept = kept;
        if let Some((number, _)) = super::super::numbers::number(&self.lexemes[at + words..stop]) {
            // "Only one tree in the park": of those in the park.
            (all.relation, all.traits) = (kept.relation.clone(), kept.traits.clone());
            (kept.count, kept.indefinite) = (Count::Exactly(number as u32), true);
        }
        Some(Wish::Remove {
            what: vec![Reference { count: Count::All, except: Some(Box::new(kept)), ..all }],
        })
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let lists = [TAKES, AWAY, COATS, SPLASH, COAT, INSTEAD_OF, BECOMES, CHANGES, KEEPS];
    lists.into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}

/// Whether the words name a thing that can be made, as far as nouns tell: "half its size" is none.
pub(super) fn is_some_thing(thing: &NewThing) -> bool {
    #[rustfmt::skip]
    const NONE: &[&str] = &["size", "bit", "lot", "turn", "degrees", "percent", "side", "times", "place", "spot", "it", "way", "half", "quarter", "third",
        "copy", "little", "metre", "metres", "meter", "meters", "while", "colour", "color", "name", "where", "near", "shade"];
    !thing.words.iter().any(|word| NONE.contains(&word.as_str()))
}
