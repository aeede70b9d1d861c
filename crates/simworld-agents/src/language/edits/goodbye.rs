//! Ways to have something go, to be another, to change places, or to be together, whose words stand around what they are about: "kiss the
//! scooter goodbye", "the truck has had its day", "postbox out, phone booth in", "let a statue take the place of the postbox".

use simworld_core::scene::Relation;

use super::super::clause::Reference;
use super::super::lexicon::{longest, longest_phrase};
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::parse::{Reader, joint};
use super::wish::{Anchor, Where, Wish};

/// Around what is to go.
#[rustfmt::skip]
const AROUND: &[(&[&str], &[&str])] = &[
    (&["kiss", "wave"], &["goodbye", "good bye", "farewell", "bye bye", "bye"]),
    (&["take", "get", "have"], &["off my hands", "off our hands", "off my back", "out of my face", "out of my life", "out of my hair", "off my plate", "off my lawn", "out of our way", "out of everyones way", "off the premises", "out of commission"]),
    (&["send", "ship", "cart", "haul", "take", "put", "throw", "move", "bring"], &["packing", "to the scrapyard", "to the junkyard", "to the scrap heap", "to the dump", "on the scrap heap", "into retirement", "to landfill", "into the bin", "in the bin", "in the skip", "into the skip", "to storage", "into storage"]),
    (&["have", "get", "see"], &["towed", "towed away", "removed", "taken away", "taken out", "scrapped", "hauled off", "hauled away", "cleared", "binned", "dismantled", "demolished", "pulled down", "torn down", "ripped out", "gone", "out of here", "dug up", "carted off",
        "carted away", "cut down", "chopped down", "thrown out", "thrown away", "deleted", "done away with", "disposed of"]),
    (&["wipe", "erase", "strike", "cross", "scrub", "scratch"], &["off the map", "from the map", "from the scene", "from the picture", "off the list", "off", "out"]),
];
/// Behind what is to go.
#[rustfmt::skip]
const GONE: &Phrases = &Phrases::of(&["has had its day", "have had their day", "is history", "are history", "is toast", "is so last year", "is yesterdays news", "has run its course", "has overstayed its welcome", "has outstayed its welcome", "gets the chop", "gets the boot",
    "gets the axe", "has to get out", "must get out", "needs to get out", "has to leave", "must leave", "is out", "has to be off", "is no more", "will not be missed", "wont be missed", "can be taken away", "may be taken away", "can be removed", "may be removed",
    "can be thrown away", "can be binned", "can be scrapped", "can be cleared away", "can be got rid of", "can leave", "can disappear", "may go", "may leave", "may disappear", "begone", "be gone", "out", "away", "off you go", "go away", "must away",
    "is one thing too many", "is surplus", "is past its best", "is beyond repair", "has seen better days and must go", "has no place in this picture", "has no place in the scene", "is in the wrong city", "is so over", "has got to leave", "has got to disappear",
    "is to be removed", "is for the scrapyard", "is for the dump", "is for the bin", "belongs in the bin", "belongs on the scrapyard", "belongs in a museum and not here", "belongs on the tip", "belongs in the skip", "belongs in the past", "belongs on the scrap heap",
    "is going", "are going", "has to vanish", "should get lost", "can get lost", "needs to vanish", "needs to disappear", "needs to leave", "wants removing", "needs removing", "needs taking away", "needs getting rid of", "could do with removing", "is up for demolition", "are up for demolition",
    "is up for removal", "are up for removal", "is up for scrapping", "is due for demolition", "are due for demolition", "is due for removal", "is due to be removed", "is due to be demolished", "is to be demolished", "are to be demolished", "is earmarked for demolition", "are earmarked for demolition",
    "is earmarked for removal", "is scheduled for demolition", "is scheduled for removal", "is slated for demolition", "is slated for removal", "is marked for demolition", "is marked for removal", "faces demolition", "faces the wrecking ball",
    "is ready for demolition", "is ripe for demolition", "is ready for the scrapyard", "awaits demolition", "is for the chop", "are for the chop", "is for the axe", "are for the axe", "is off to the scrapyard", "is off to the dump", "has reached the end of its life"]);
/// Before what is to go, and a mark.
const FAREWELL: &Phrases = &Phrases::of(&[
    "farewell", "goodbye", "bye bye", "bye", "adieu", "so long", "begone", "out", "away", "shoo",
]);
/// That another takes a place.
#[rustfmt::skip]
const TAKES_PLACE: &Phrases = &Phrases::of(&["take the place of", "takes the place of", "take over from", "replace", "replaces", "stand in for", "take the spot of", "go where", "in place of", "taking the place of", "be put in place of", "succeed"]);

impl Reader<'_> {
    /// What one of these ways says, with all the words up to the end.
    pub(super) fn goodbye(&self, start: usize, end: usize) -> Option<Wish> {
        let end = self.before_politeness(start, end);
        self.said_goodbye(start, end)
            .or_else(|| self.out_and_in(start, end))
            .or_else(|| self.takes_place(start, end))
            .or_else(|| self.vice_versa(start, end))
            .or_else(|| self.together(start, end))
            .or_else(|| self.suits(start, end))
            .or_else(|| self.made_into(start, end))
            .or_else(|| self.scaled_apart(start, end))
    }

    /// Things that are there, and are named by all these words.
    fn certain(&self, from: usize, to: usize) -> Option<Vec<Reference>> {
        let known = self.is_certain(from) || self.one_begins(from, to);
        self.things(from, to).ok().filter(|_| known && self.is_definite(from))
    }

    fn said_goodbye(&self, start: usize, end: usize) -> Option<Wish> {
        let remove = |what| Wish::Remove { what };
        let around = AROUND.iter().find_map(|(before, behind)| {
            let from = start + longest_phrase(&self.lexemes[start..end], *before)?;
            let cut = (from + 1..end)
                .find(|cut| longest_phrase(&self.lexemes[*cut..end], *behind) == Some(end - cut))?;
            self.certain(from, cut)
        });
        if around.is_some() {
            return around.map(remove);
        }
        // "Farewell, green bench".
        if let Some(words) = longest_phrase(&self.lexemes[start..end], FAREWELL) {
            let from = start + words;
            let marks = self.lexemes[from..end]
                .iter()
                .take_while(|lexeme| super::super::lexer::is_mark(lexeme))
                .count();
            if marks > 0 {
                return self.certain(from + marks, end).map(remove);
            }
        }
        // "Chuck it", with no word of where.
        if let Some(words) = longest_phrase(
            &self.lexemes[start..end],
            &["chuck", "toss", "throw", "dump", "bin", "yeet", "sling", "bung"],
        ) {
            return self.certain(start + words, end).map(remove);
        }
        (start + 1..end).find_map(|cut| {
            // "The kids come out" go nowhere.
            let is_particle = matches!(self.word(cut), Some("out" | "away")) && cut + 1 == end;
            let is_of_verb = is_particle
                && matches!(
                    self.word(cut - 1),
                    Some(
                        "come"
                            | "comes"
                            | "came"
                            | "go"
                            | "goes"
                            | "went"
                            | "get"
                            | "run"
                            | "ran"
                            | "walk"
                            | "head"
                            | "find"
                            | "figure"
                            | "turn"
                            | "work"
                            | "hang"
                            | "eat"
                            | "camp"
                            | "blow"
                            | "fly"
                            | "look"
                            | "move"
                            | "are"
                            | "is"
                    )
                );
            let gone = longest_phrase(&self.lexemes[cut..end], GONE) == Some(end - cut) && !is_of_verb;
            let stop = cut - usize::from(super::super::lexer::is_mark(&self.lexemes[cut - 1]));
            if gone && stop > start && self.is_certain(start) {
                self.certain(start, stop).map(remove)
            } else {
                None
            }
        })
    }

    /// "Postbox out, phone booth in".
    fn out_and_in(&self, start: usize, end: usize) -> Option<Wish> {
        let out = (start + 1..end).find(|at| self.word(*at) == Some("out"))?;
        let from = out + 1 + joint(self.lexemes.get(out + 1..end)?)?;
        let from = from + joint(&self.lexemes[from..end]).unwrap_or(0);
        if self.word(end - 1) != Some("in") || from + 1 >= end {
            return None;
        }
        let what = self.one_of(start, out).ok()?;
        let mut reader = Reader { at: from, ..self.up_to(end - 1) };
        let with = reader.new_thing(end - 1).ok().filter(|_| reader.at >= end - 1)?;
        Some(Wish::Replace { what, with })
    }

    /// "Let a statue take the place of the postbox".
    fn takes_place(&self, start: usize, end: usize) -> Option<Wish> {
        let from = start
            + longest_phrase(&self.lexemes[start..end], &["let", "have", "make", "get", "id like", "i want"])
                .unwrap_or(0);
        let should =
            ["should", "could", "must", "shall", "can", "may", "will", "is to", "has to", "ought to", "to"];
        (from + 1..end).find_map(|cut| {
            let ought = longest_phrase(&self.lexemes[cut..end], &should);
            let verb = cut + ought.unwrap_or(0);
            let takes = longest_phrase(&self.lexemes[verb..end], TAKES_PLACE)?;
            if from == start && ought.is_none() || self.is_definite(from) {
                return None;
            }
            let mut reader = Reader { at: from, ..self.up_to(cut) };
            let with = reader.new_thing(cut).ok().filter(|_| reader.at >= cut)?;
            let what = self.one_of(verb + takes, end).ok()?;
            Some(Wish::Replace { what, with })
        })
    }

    /// "Put the taxi where the truck is and vice versa".
    fn vice_versa(&self, start: usize, end: usize) -> Option<Wish> {
        let versa = (start + 2..end).find(|at| {
            longest_phrase(
                &self.lexemes[*at..end],
                &[
                    "and vice versa",
                    "vice versa",
                    "and the other way round",
                    "and the other way around",
                    "and the reverse",
                    "the other way round",
                    "the other way around",
                    "and the truck there",
                ],
            ) == Some(end - at)
        })?;
        let versa = versa - usize::from(super::super::lexer::is_mark(&self.lexemes[versa - 1]));
        let from = start
            + longest_phrase(
                &self.lexemes[start..versa],
                &["put", "move", "place", "set", "park", "bring", "take"],
            )
            .unwrap_or(0);
        (from + 1..versa).find_map(|cut| {
            let to = longest_phrase(
                &self.lexemes[cut..versa],
                &[
                    "where",
                    "to where",
                    "in the place of",
                    "in place of",
                    "to the place of",
                    "to the spot of",
                    "in the spot of",
                    "and",
                    "to",
                ],
            )?;
            let one = self.one_of(from, cut).ok()?;
            let stop = (cut + to + 1..=versa).rev().find(|stop| {
                *stop == versa
                    || longest_phrase(
                        &self.lexemes[*stop..versa],
                        &["is", "stands", "is now", "sits", "is parked", "stands now", "is standing"],
                    ) == Some(versa - stop)
            })?;
            let tail = (cut + to + 1..stop)
                .find(|at| matches!(self.word(*at), Some("is" | "stands" | "sits")))
                .unwrap_or(stop);
            let other = self.one_of(cut + to, tail).ok()?;
            Some(Wish::Swap { one, other: Some(other) })
        })
    }

    /// "Reunite Bruno with Eve", "bring Ada and Bo together".
    fn together(&self, start: usize, end: usize) -> Option<Wish> {
        let next_to = |one: Reference, other: Reference| Wish::Move {
            what: vec![one],
            at: vec![Where::To(Relation::NextTo, Anchor::Thing(other))],
        };
        let pair = |from: usize, stop: usize, joins: &[&str]| {
            (from + 1..stop).find_map(|cut| {
                let words = longest_phrase(&self.lexemes[cut..stop], joins)?;
                let (one, other) = (self.one_of(from, cut).ok()?, self.one_of(cut + words, stop).ok()?);
                (self.is_certain(from) && self.is_certain(cut + words)).then(|| next_to(one, other))
            })
        };
        if let Some(words) = longest_phrase(
            &self.lexemes[start..end],
            &["reunite", "unite", "pair", "pair up", "match up", "team up", "join"],
        ) {
            return pair(start + words, end, &["with", "and", "to"]);
        }
        let words = longest_phrase(
            &self.lexemes[start..end],
            &["bring", "put", "get", "move", "push", "seat", "stand", "place"],
        )?;
        let together = (start + words + 1..end).find(|at| {
            longest_phrase(
                &self.lexemes[*at..end],
                &[
                    "together",
                    "side by side",
                    "next to each other",
                    "beside each other",
                    "close together",
                    "next to one another",
                ],
            ) == Some(end - at)
        })?;
        pair(start + words, together, &["and", "with"])
    }

    /// "Red suits the taxi better", "go purple on the postbox", "a pink taxi would be funnier".
    fn suits(&self, start: usize, end: usize) -> Option<Wish> {
        #[rustfmt::skip]
        const SUITS: &Phrases = &Phrases::of(&["suits", "would suit", "fits", "would fit", "would look better on", "would look good on", "would look great on", "would look nice on", "would look nicer on", "looks better on", "looks good on", "would be better on",
            "would be nicer on", "would be good on", "would be great on", "would be a better colour for", "is the colour for", "is the right colour for", "would work better on", "would work on", "would go well with", "is what i want for", "on",
            "would be a good colour for", "would be a nice colour for", "should be the colour of", "is to be the colour of", "would do wonders for", "would flatter"]);
        #[rustfmt::skip]
        const BETTER: &Phrases = &Phrases::of(&["better", "best", "more", "much better", "well", "a lot better", "way better", "far better", "instead", "nicely", "down to the ground"]);
        #[rustfmt::skip]
        const RATHER: &Phrases = &Phrases::of(&["would be funnier", "would be nicer", "would be prettier", "would be better", "would be cooler", "would look better", "would look nicer", "would look cooler", "would look prettier", "would suit us better",
            "would be more fun", "would be more cheerful", "would be merrier", "would be cuter", "would fit better", "would be less boring", "would be less dull", "would be brighter", "would be more to my taste", "would please me more", "would be lovelier",
            "would be more like it", "would stand out more", "would be safer", "would be easier to see", "would be so much nicer", "would be so much better", "would be much nicer", "would be much better", "would be far nicer", "would be way cooler"]);
        let go = longest_phrase(
            &self.lexemes[start..end],
            &["go", "go for", "use", "try", "how about", "what about", "i say", "maybe"],
        )
        .unwrap_or(0);
        let from = start + go;
        if let Some((paint, words)) = longest(self.lexemes.get(from..end)?, PAINTS) {
            let at = from + words;
            let suits = longest_phrase(self.lexemes.get(at..end)?, SUITS)?;
            if self.word(at) == Some("on") && go == 0 {
                return None;
            }
            let stop = (at + suits + 1..end)
                .find(|stop| longest_phrase(&self.lexemes[*stop..end], BETTER) == Some(end - stop))
                .unwrap_or(end);
            let what = self.things(at + suits, stop).ok().filter(|_| self.is_certain(at + suits))?;
            return Some(Wish::Paint { what, paint });
        }
        // Rather than what is there: of the only one of its kind.
        let article = longest_phrase(&self.lexemes[start..end], &["a", "an"])?;
        let (paint, words) = longest(&self.lexemes[start + article..end], PAINTS)?;
        let noun = start + article + words;
        let cut = (noun + 1..end)
            .find(|cut| longest_phrase(&self.lexemes[*cut..end], RATHER) == Some(end - cut))?;
        let what = self.one_of(noun, cut).ok().filter(|what| self.how_many(what) == 1)?;
        Some(Wish::Paint { what: vec![what], paint })
    }

    /// "Make the taxi a police car".
    fn made_into(&self, start: usize, end: usize) -> Option<Wish> {
        let from = start
            + longest_phrase(
                &self.lexemes[start..end],
                &["make", "turn", "switch", "trade", "swap", "change", "exchange"],
            )?;
        (from + 1..end).find_map(|cut| {
            let for_it = longest_phrase(
                &self.lexemes[cut..end],
                &["out for", "in for", "over for", "up to", "over to", "out with", "around for", "up for"],
            );
            let with = cut + for_it.unwrap_or(0);
            longest_phrase(&self.lexemes[with..end], &["a", "an"])?;
            if for_it.is_none() && self.word(start) != Some("make") || !self.is_definite(from) {
                return None;
            }
            let what = self.one_of(from, cut).ok().filter(|_| self.is_certain(from))?;
            let mut reader = Reader { at: with, ..self.up_to(end) };
            let with = reader
                .new_thing(end)
                .ok()
                .filter(|with| reader.at >= end && super::apart::is_some_thing(with))?;
            Some(Wish::Replace { what, with })
        })
    }

    /// "Blow the table up to three times its size", "scale the fountain down by half".
    fn scaled_apart(&self, start: usize, end: usize) -> Option<Wish> {
        let from = start
            + longest_phrase(
                &self.lexemes[start..end],
                &[
                    "blow", "scale", "size", "bump", "bring", "cut", "take", "beef", "pump", "step",
                    "shrink", "puff",
                ],
            )?;
        (from + 1..end).find_map(|cut| {
            let particle = longest_phrase(&self.lexemes[cut..end], &["up", "down", "back"])?;
            let at = cut + particle;
            let factor = super::predicates::size_of(&self.lexemes[at..end]);
            let what = self.certain(from, cut)?;
            match factor {
                Some(factor) => Some(Wish::Scale { what, factor }),
                None if at < end => self.measure(at, end).map(|size| Wish::Resize { what, size }),
                None => None,
            }
        })
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    const MORE: [&str; 13] = [
        "reunite", "unite", "pair", "team", "vice", "versa", "suits", "flatter", "wonders", "funnier",
        "merrier", "lovelier", "cuter",
    ];
    let around = AROUND.iter().flat_map(|(before, behind)| before.iter().chain(*behind));
    around.chain(GONE).chain(FAREWELL).chain(TAKES_PLACE).chain(&MORE).flat_map(|phrase| phrase.split(' '))
}
