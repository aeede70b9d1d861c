//! Orders whose words stand in another order, or whose verb is made of several words that stand apart: "the bench please
//! remove", "throw the red one out", "give the taxi a coat of pink", "a bin instead of the bench".

use super::super::clause::{Count, Reference, Target};
use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{category, longest, longest_phrase};
use super::forms::{as_order, word_at};
use super::parse::Reader;
use super::says::{Mood, is_it};
use super::wish::Wish;
use super::words::{VERBS, Verb};

/// Verbs that mean to remove something with a particle behind it.
#[rustfmt::skip]
const TAKES: &[&str] = &["throw", "take", "chuck", "get", "tear", "knock", "pull", "cut", "chop", "toss", "kick", "haul", "cart", "clear", "sweep",
    "carry", "send", "bring", "drag", "push", "rip", "strip", "wipe", "lift", "put", "clean", "dig", "move", "pluck", "have", "want", "make", "let",
    "see", "strike", "cross", "rub", "drive", "pack", "hack", "saw", "blow", "burn", "wash", "shove", "fling", "sling", "hurl", "bin", "roll", "wheel", "ship", "cast"];
/// The particles.
#[rustfmt::skip]
const AWAY: &[&str] = &["away", "out", "off", "out of here", "out of there", "out of the way", "out of the scene", "from the scene", "from here", "off the map",
    "out of sight", "to the dump", "to the scrapyard", "out of my sight", "from the map", "from my sight", "out of the picture", "off the scene",
    "into the trash", "in the trash", "go away", "go", "disappear", "vanish", "gone", "removed", "deleted", "out of town", "out of existence",
    "off the face of the earth", "away from here", "go byebye", "byebye", "bye bye", "off the street", "away for good", "out for good", "leave",
    "out of the city", "out of the campus", "from the city", "off campus", "off site", "taken away", "taken out", "thrown out", "thrown away", "to the tip"];
/// As [`AWAY`], behind verbs of cutting and pulling.
const DOWN: &[&str] = &["down"];
const CUTS: &[&str] = &[
    "cut", "tear", "knock", "pull", "chop", "take", "bring", "saw", "hack", "burn", "blow", "rip", "strip",
    "strike",
];
/// Before a thing and the paint that it gets.
#[rustfmt::skip]
const COATS: &[&str] = &["give", "do", "have", "get", "dress", "wrap", "dip", "drench", "coat", "cover", "finish", "make", "turn", "change", "switch", "set",
    "redo", "style", "put", "slather", "decorate", "render", "want", "let", "hand", "colour", "color", "brush", "lacquer", "varnish", "spray", "bathe", "id like", "i would like",
    "recoat", "keep", "leave", "see", "show", "convert", "transform", "i want", "we want", "id prefer", "id love", "wed like", "id rather have"];
/// Before paint that something gets.
#[rustfmt::skip]
const SPLASH: &[&str] = &["put", "splash", "slap", "brush", "throw", "spread", "apply", "use", "add", "pour", "spray", "paint", "dab", "smear", "slosh"];
/// What the paint is a coat of.
const COAT: &[&str] = &[
    "a", "some", "fresh", "new", "coat", "coats", "lick", "layer", "of", "splash", "dash", "touch", "bit",
    "little", "nice", "bright", "the", "two", "good", "lovely", "quick", "can", "bucket", "pot", "colour",
    "color", "light", "dark", "deep",
];
/// That one thing is to stand in the place of another, before the other.
#[rustfmt::skip]
const INSTEAD_OF: &[&str] = &["instead of", "in place of", "in the place of", "in lieu of", "rather than", "in exchange for", "as a replacement for",
    "to replace", "replacing", "for replacing", "in the stead of", "in the spot of"];
/// What becomes of a thing that is another from then on.
#[rustfmt::skip]
const BECOMES: &[&str] = &["into", "to", "become", "becomes", "be", "should be", "should become", "for", "with", "in favour of", "in favor of", "by", "turn into",
    "turns into", "should turn into", "could be", "could become", "ought to be", "must be", "must become", "has to become", "has to be", "would be better as",
    "would look better as", "should be replaced by", "should be replaced with", "as", "were", "was", "would be nicer as", "to become", "to be", "should rather be",
    "should make way for", "has to make way for", "makes way for", "make way for", "must make way for", "gives way to", "should give way to"];
/// Before the thing that becomes another.
#[rustfmt::skip]
const CHANGES: &[&str] = &["turn", "change", "make", "convert", "transform", "exchange", "trade", "swap", "let", "switch", "have", "morph", "trade in", "replace", "upgrade",
    "substitute", "swap out", "switch out", "change out", "i want", "id like", "i would like", "id rather have", "we want", "redo", "rebuild", "remodel", "drop", "ditch", "remove"];
/// That all but something is to go.
#[rustfmt::skip]
const KEEPS: &[&str] = &["only keep", "keep only", "just keep", "keep just", "keep nothing but", "leave only", "only leave", "leave nothing but", "leave just", "just leave",
    "spare only", "only spare", "keep none but", "nothing but", "retain only", "only retain"];

impl Reader<'_> {
    /// A wish that is put together from words that stand apart.
    pub(super) fn composed(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        if self.depth >= super::says::DEEPEST || self.memo.is_spent() {
            return None;
        }
        self.behind_preamble(start, end)
            .or_else(|| self.others_want(start, end))
            .or_else(|| self.cleft(start, self.before_politeness(start, end)))
            .or_else(|| self.fronted(start, end))
            .or_else(|| self.told_in_pieces(start, end))
            .or_else(|| self.reordered(start, end))
            .or_else(|| self.without_reason(start, end))
    }

    /// What should be first, and of what behind it: "twice as big, the chair", "by the museum, please, one bench".
    fn fronted(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let end = self.before_politeness(start, end);
        (start + 1..end).find_map(|cut| {
            let stop = self.without_small(start, cut);
            let mut behind = Reader { at: cut, ..self.up_to(end) };
            behind.skip_joints_to(end);
            let from = behind.at;
            if from >= end {
                return None;
            }
            let one = |wish| Some(vec![vec![wish]]);
            if let Some(places) = self.places_to(start, stop) {
                if let Some(wish) = self.is_where(from, end, &places) {
                    return one(wish);
                }
                return self.beginnings(from, end).into_iter().find_map(|begins| {
                    let verb = longest(&self.lexemes[begins.at..end], VERBS)
                        .filter(|(verb, _)| matches!(verb, Verb::Add | Verb::Put));
                    let at = begins.at + verb.map_or(0, |(_, words)| words);
                    let is_new = at < end
                        && (!self.is_definite(at)
                            || self.is_bare_plural(at, end)
                            || verb.is_none() && self.is_bare_noun(at, end));
                    let mut made = Reader { at, ..self.up_to(end) };
                    let thing = if is_new { made.new_thing(end).ok() } else { None };
                    let thing = thing.filter(|_| made.at >= end)?;
                    Some(vec![vec![Wish::Add { things: vec![thing], at: places.clone() }]])
                });
            }
            let what = self.things(from, end).ok().filter(|_| self.is_certain(from))?;
            if let Some(factor) = super::says::size_of(&self.lexemes[start..stop]) {
                return one(Wish::Scale { what, factor });
            }
            self.colour_to(start, stop).and_then(|paint| one(Wish::Paint { what, paint }))
        })
    }

    /// "Beside the statue bench": a noun of a class without an article, and nothing else.
    fn is_bare_noun(&self, at: usize, end: usize) -> bool {
        category(&self.lexemes[at..end]).is_some_and(|(_, words)| at + words == end)
    }

    /// "What this place is missing is a well by the fountain".
    fn cleft(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        #[rustfmt::skip]
        const LACKING: &[&str] = &["missing", "need", "needs", "want", "wants", "lack", "lacks", "like", "love", "wish", "lacking", "use", "hope", "dream", "prefer", "require",
            "requires", "deserves", "ask", "asking", "needed", "wanted", "suggest", "propose", "recommend", "thinking", "absent"];
        longest_phrase(
            &self.lexemes[start..end],
            &["what", "all", "the only thing", "the one thing", "one thing", "the thing", "something"],
        )?;
        (start + 2..end).find_map(|at| {
            let is =
                longest_phrase(&self.lexemes[at..end], &["is", "are", "would be", "is just", "is that"])?;
            let lacks = (start..at).any(|at| self.word(at).is_some_and(|word| LACKING.contains(&word)));
            let from = at + is;
            if !lacks || from >= end || self.is_definite(from) && !self.is_bare_plural(from, end) {
                return None;
            }
            let mut reader = Reader { at: from, ..self.up_to(end) };
            reader.additions(end).ok().filter(|_| reader.at >= end)
        })
    }

    /// "... is where the statue should be", "... would be a good spot for a bench".
    fn is_where(&self, at: usize, end: usize, places: &[super::wish::Where]) -> Option<Wish> {
        #[rustfmt::skip]
        const IS: &[&str] = &["is where", "is the place where", "is the right place for", "is the place for", "is a good place for", "would be a good place for",
            "would be the right place for", "is the spot for", "is a good spot for", "would be a good spot for", "would be perfect for", "is perfect for",
            "would be ideal for", "is ideal for", "would be the perfect place for", "is the perfect place for", "would be a nice place for", "is a nice place for",
            "would be a nice spot for", "would be the perfect spot for", "is the perfect spot for", "is just right for", "could hold", "could take", "has room for",
            "there is room for", "is room for", "is where i want", "is where we want", "is where we need", "is where i need", "is where id like", "would be great for"];
        const TAILS: &[&str] = &[
            "should be",
            "should go",
            "should stand",
            "belongs",
            "has to be",
            "must be",
            "goes",
            "ought to be",
            "needs to be",
            "has to go",
            "to be",
            "to go",
            "to stand",
            "would look best",
            "would look better",
            "would be best",
            "must go",
            "has to stand",
            "must stand",
            "would look good",
            "should sit",
        ];
        let from = at + longest_phrase(&self.lexemes[at..end], IS)?;
        let stop = (from + 1..end)
            .find(|at| longest_phrase(&self.lexemes[*at..end], TAILS) == Some(end - at))
            .unwrap_or(end);
        if self.is_certain(from) {
            return self.things(from, stop).ok().map(|what| Wish::Move { what, at: places.to_vec() });
        }
        let mut reader = Reader { at: from, ..self.up_to(stop) };
        let thing = reader.new_thing(stop).ok().filter(|_| reader.at >= stop)?;
        Some(Wish::Add { things: vec![thing], at: places.to_vec() })
    }

    /// "Old Bakery, behind it, oak tree, two": a new thing, its place, how many, and what "it" is, in any order.
    fn told_in_pieces(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let end = self.before_politeness(start, end);
        let marks: Vec<usize> = (start..end).filter(|at| super::parts::is_mark(&self.lexemes[*at])).collect();
        if marks.is_empty() || marks.len() > 4 {
            return None;
        }
        let (mut count, mut places, mut topic, mut made) = (None, None, None, None);
        let ends = marks.iter().copied().chain([end]);
        let mut from = start;
        for to in ends {
            let piece = &self.lexemes[from..to];
            let number = super::super::numbers::count(piece).filter(|(_, words)| *words == piece.len());
            let found = if let Some((number, _)) = number {
                count.replace(number).is_none()
            } else if let Some(at) = self.places_to(from, to) {
                places.replace(at).is_none()
            } else if let Some(thing) =
                self.one_of(from, to).ok().filter(|_| from == start && self.is_certain(from))
            {
                topic.replace(thing).is_none()
            } else {
                let mut reader = Reader { at: from, ..self.up_to(to) };
                let thing =
                    reader.new_thing(to).ok().filter(|_| reader.at >= to && !self.is_certain(from))?;
                made.replace(thing).is_none()
            };
            if !found {
                return None;
            }
            from = to + 1;
        }
        let (mut thing, mut at) = (made?, places?);
        thing.count = count.unwrap_or(thing.count);
        let mut anchor = topic.map(super::wish::Anchor::Thing);
        for place in &mut at {
            place.means(&mut anchor);
        }
        at.iter()
            .all(|place| place.anchor().is_none_or(|anchor| !anchor.is_it()))
            .then(|| vec![vec![Wish::Add { things: vec![thing], at }]])
    }

    /// Statements, gerunds and small clauses behind a preamble of any length.
    fn behind_preamble(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        self.beginnings(start, end).into_iter().find_map(|begins| {
            let at = begins.at;
            let one = |wish| vec![vec![wish]];
            if let Some(wish) = self.apart(at, end) {
                return Some(one(wish));
            }
            let doing = self.word(at).is_some_and(|word| word.ends_with("ing"));
            if at > start || doing {
                let order = as_order(&self.lexemes[at..end]).map(|(_, _, verb)| {
                    std::iter::once(verb).chain(self.lexemes[at + 1..end].iter().cloned()).collect::<Vec<_>>()
                });
                let read = order.and_then(|order| self.read_plainly(&order));
                let plain = || if at > start { self.read_plainly(&self.lexemes[at..end]) } else { None };
                if let Some(wishes) = read.or_else(plain) {
                    return Some(wishes);
                }
            }
            let mood = if begins.wished { Mood::Wished } else { Mood::Plain };
            self.says(at, end, mood).or_else(|| {
                if begins.wished { self.small_clause(at, end) } else { self.bare_clause(at, end) }
            })
        })
    }

    /// Verbs of several words that stand apart.
    fn apart(&self, at: usize, end: usize) -> Option<Wish> {
        let end = self.before_politeness(at, end);
        self.kept(at, end)
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

    /// "Give the taxi a fresh coat of pink", "put some pink paint on the taxi", "do the taxi up in pink".
    pub(super) fn coated(&self, at: usize, end: usize) -> Option<Wish> {
        if let Some(words) = longest_phrase(&self.lexemes[at..end], SPLASH) {
            let small = (at + words..end)
                .take_while(|at| self.word(*at).is_some_and(|word| COAT.contains(&word)))
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
                + (from..end)
                    .take_while(|at| self.word(*at).is_some_and(|word| COAT.contains(&word)))
                    .count();
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
            let with =
                reader.new_thing(end).ok().filter(|with| reader.at >= end && self.is_some_thing(with))?;
            Some(Wish::Replace { what, with })
        })
    }

    /// Whether the words name a thing that can be made, as far as nouns tell: "half its size" is none.
    fn is_some_thing(&self, thing: &super::wish::NewThing) -> bool {
        #[rustfmt::skip]
        const NONE: &[&str] = &["size", "bit", "lot", "turn", "degrees", "percent", "side", "times", "place", "spot", "it", "way", "half", "quarter", "third",
            "copy", "little", "metre", "metres", "meter", "meters", "while", "colour", "color", "name", "where", "near", "shade"];
        !thing.words.iter().any(|word| NONE.contains(&word.as_str()))
    }

    /// "A bin instead of the bench", "where the bike is, a motorbike should be instead".
    fn put_in_place(&self, at: usize, end: usize) -> Option<Wish> {
        let (from, to, what) =
            (at..end).find_map(|from| self.stead(from, end).map(|(to, what)| (from, to, what)))?;
        let rest: Vec<Lexeme> =
            self.lexemes[at..from].iter().chain(&self.lexemes[to..end]).cloned().collect();
        let inner = Reader { depth: super::says::DEEPEST, ..self.over(&rest) };
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
                ],
            )?;
            Some((cut + is, self.one_of(at, cut).ok().filter(|what| !is_it(what))?))
        })
    }

    /// One new thing and small words, and nothing else.
    fn only_new(&self, end: usize) -> Option<super::wish::NewThing> {
        #[rustfmt::skip]
        const TAILS: &[&str] = &["should be", "should stand", "instead", "should go", "goes", "must be", "would be better", "would be nicer", "there", "now",
            "has to be", "could be", "comes", "is needed", "would be nice", "would be great", "ought to be", "belongs", "must stand", "please", "should come"];
        let mut stop = self.before_politeness(0, end);
        loop {
            let cut = (1..stop).find(|at| {
                longest_phrase(&self.lexemes[*at..stop], TAILS) == Some(stop - at)
                    || super::parts::is_mark(&self.lexemes[*at]) && at + 1 == stop
            });
            match cut {
                Some(cut) => stop = cut,
                None => break,
            }
        }
        self.beginnings(0, stop).into_iter().find_map(|begins| {
            let mut at = begins.at;
            at += self.lexemes[at..stop].iter().take_while(|lexeme| super::parts::is_mark(lexeme)).count();
            let verb = longest(&self.lexemes[at..stop], VERBS)
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
        let words = longest_phrase(&self.lexemes[at..end], KEEPS)?;
        let kept = self.one_of(at + words, end).ok()?;
        let Target::Any(_) = &kept.target else { return None };
        let all = Reference::to(kept.target.clone(), kept.text.clone());
        Some(Wish::Remove {
            what: vec![Reference { count: Count::All, except: Some(Box::new(kept)), ..all }],
        })
    }

    /// An order whose verb stands behind its object or its place: "the bench please remove", "next to the museum a bench put".
    fn reordered(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let end = self.before_politeness(start, end);
        (start + 1..end).find_map(|at| {
            let (verb, words) = longest(&self.lexemes[at..end], VERBS)
                .map(|(verb, words)| (verb, self.lexemes[at..at + words].to_vec()))
                .or_else(|| {
                    as_order(&self.lexemes[at..end]).map(|(verb, words, base)| {
                        (
                            verb,
                            std::iter::once(base)
                                .chain(self.lexemes[at + 1..at + words].iter().cloned())
                                .collect(),
                        )
                    })
                })?;
            let is_change = matches!(
                verb,
                Verb::Add
                    | Verb::Put
                    | Verb::Move
                    | Verb::Remove
                    | Verb::Turn
                    | Verb::Swap
                    | Verb::Paint
                    | Verb::Grow
                    | Verb::Shrink
                    | Verb::Copy
                    | Verb::Replace
                    | Verb::Take
            );
            if !is_change {
                return None;
            }
            // An order in the next sentence is none of this one.
            if self.lexemes[start..end].iter().any(|lexeme| lexeme.token == Token::Break) {
                return None;
            }
            let stop = self.without_small(start, at);
            let begin = self.beginnings(start, stop + 1).last().map_or(start, |begins| begins.at);
            let behind = &self.lexemes[at + words.len()..end];
            [start, begin].into_iter().filter(|from| *from < stop).find_map(|from| {
                let before = &self.lexemes[from..stop];
                // What is made is not there yet.
                let is_made = matches!(verb, Verb::Add | Verb::Put) && is_it_not(behind);
                if before.iter().any(super::parts::is_mark) || is_made && self.is_certain(from) {
                    return None;
                }
                let is_it = longest_phrase(
                    behind,
                    &["it", "them", "that", "this", "that one", "this one", "those", "these", "him", "her"],
                );
                let orders = [
                    is_it.map(|words| (before, &behind[words..])),
                    Some((before, behind)),
                    Some((behind, before)),
                ];
                // "By the museum a bench put": the thing behind its place.
                let inner = (from + 2..stop)
                    .filter(|_| behind.is_empty() && self.is_place(from))
                    .map(|cut| (&self.lexemes[cut..stop], &self.lexemes[from..cut]));
                orders.into_iter().flatten().chain(inner).find_map(|(one, other)| {
                    let order: Vec<Lexeme> = words.iter().chain(one).chain(other).cloned().collect();
                    self.read_plainly(&order)
                })
            })
        })
    }

    /// Where the words end without small ones and marks before a verb: "a bench by the museum, you must".
    fn without_small(&self, start: usize, mut end: usize) -> usize {
        const SMALL: &[&str] = &[
            "please", "you", "must", "i", "we", "can", "could", "should", "would", "like", "to", "want",
            "kindly", "just", "now", "that", "need", "have", "id", "will", "may", "let", "us", "lets",
            "shall", "do", "also", "then", "gladly",
        ];
        while end > start + 1
            && (super::parts::is_mark(&self.lexemes[end - 1])
                || self.word(end - 1).is_some_and(|word| SMALL.contains(&word)))
        {
            end -= 1;
        }
        end
    }

    /// "..., so that people can rest": the wish before the reason.
    fn without_reason(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let cut = self.before_reason(start, end)?;
        let stop = if super::parts::is_mark(&self.lexemes[cut - 1]) { cut - 1 } else { cut };
        let mut reader = Reader { at: start, depth: self.depth + 1, ..self.up_to(stop) };
        let last = reader.before_politeness(start, stop);
        reader.wish(stop).ok().filter(|_| reader.at >= last)
    }
}

/// Whether the words begin with no pronoun.
fn is_it_not(words: &[Lexeme]) -> bool {
    longest_phrase(words, &["it", "them", "that", "this", "those", "these", "him", "her"]).is_none()
}

/// Words that make a wish stronger or weaker, and no other.
#[rustfmt::skip]
const ADVERBS: &[&str] = &["really", "definitely", "certainly", "absolutely", "totally", "seriously", "honestly", "literally", "basically", "desperately", "badly", "sorely",
    "urgently", "frankly", "truly", "obviously", "clearly", "surely", "undoubtedly", "ideally", "preferably", "presumably", "urgent", "personally", "sincerely", "finally"];
/// Where a name may follow, which is any word.
const CALLS: &[&str] = &["call", "name", "rename", "christen", "label", "title", "called", "named"];

/// "The taxi's in the way" is "the taxi is in the way", and "at its corner" is "at the corner of it".
fn contractions(words: &str, lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const STATES: &[&str] = &["in", "too", "a", "on", "at", "so", "facing", "looking", "way", "always", "really", "just", "very", "not", "got", "ugly", "nice", "far",
        "much", "blocking", "still", "standing", "behind", "next", "near", "an", "been", "kind", "boring", "broken", "old", "empty", "dirty", "lonely", "quite", "rather", "wrong"];
    const SIDES: &[&str] = &["corner", "edge", "middle", "centre", "center", "side"];
    let mut at = 0;
    while at + 1 < lexemes.len() {
        let (Token::Word(word), Token::Word(next)) = (&lexemes[at].token, &lexemes[at + 1].token) else {
            at += 1;
            continue;
        };
        let written = words.get(lexemes[at].start..lexemes[at].end).unwrap_or_default();
        let is_contracted = (written.ends_with("'s") || written.ends_with("’s")) && word.len() > 4;
        if is_contracted
            && STATES.contains(&next.as_str())
            && !["thats", "whats", "theres", "wheres", "heres"].contains(&word.as_str())
        {
            let place = lexemes[at].clone();
            let stem = word[..word.len() - 1].to_owned();
            lexemes.splice(at..=at, [word_at(&place, &stem), word_at(&place, "is")]);
        } else if ["on", "inside", "onto", "behind", "under"].contains(&word.as_str()) && next == "there" {
            let place = lexemes[at + 1].clone();
            lexemes[at + 1] = word_at(&place, "it");
        } else if word == "what" && category(&lexemes[at + 1..]).is_some() {
            let place = lexemes[at].clone();
            lexemes[at] = word_at(&place, "which");
        } else if let Some(who) =
            ["we'll", "i'll", "they'll", "you'll", "it'll", "we’ll", "i’ll", "they’ll", "it’ll"]
                .iter()
                .find(|short| written.eq_ignore_ascii_case(short))
        {
            let (place, who) =
                (lexemes[at].clone(), who.split(['\'', '’']).next().unwrap_or_default().to_owned());
            lexemes.splice(at..=at, [word_at(&place, &who), word_at(&place, "will")]);
        } else if ["its", "his", "her", "their"].contains(&word.as_str())
            && SIDES.contains(&next.as_str())
            && at > 0
        {
            let (place, side) = (lexemes[at].clone(), lexemes[at + 1].clone());
            lexemes.splice(
                at..=at + 1,
                [word_at(&place, "the"), side, word_at(&place, "of"), word_at(&place, "it")],
            );
        }
        at += 1;
    }
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
        let (way, words) = longest(&lexemes[at..], super::words::WAYS)?;
        let near = matches!(way, super::words::Way::To(_));
        (near && it(at + words)).then_some((at, words))
    });
    if let Some((at, words)) = found {
        let place = lexemes[at].clone();
        let noun: Vec<Lexeme> = lexemes[from..at].to_vec();
        let relation: Vec<Lexeme> = match longest(&lexemes[at..], super::words::WAYS) {
            Some((super::words::Way::To(simworld_core::scene::Relation::NextTo), _)) => {
                lexemes[at..at + words].to_vec()
            }
            _ => vec![word_at(&place, "near")],
        };
        lexemes.splice(has..=at + words, relation.into_iter().chain(noun));
    }
}

/// A word twice in a row says no more than once, and "more small" is "smaller".
pub(super) fn in_plain_words(words: &str, lexemes: &mut Vec<Lexeme>) {
    contractions(words, lexemes);
    relatives(lexemes);
    let is_call =
        |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if CALLS.contains(&word.as_str()));
    if !lexemes.iter().any(is_call) && lexemes.len() > 2 {
        lexemes
            .retain(|lexeme| !matches!(&lexeme.token, Token::Word(word) if ADVERBS.contains(&word.as_str())));
    }
    #[rustfmt::skip]
    const MORE: &[(&str, &str)] = &[("small", "smaller"), ("big", "bigger"), ("large", "larger"), ("tall", "taller"), ("high", "higher"), ("little", "smaller"),
        ("short", "shorter"), ("close", "closer"), ("tiny", "smaller"), ("huge", "bigger")];
    const TWICE: &[&str] = &[
        "far", "very", "really", "so", "please", "much", "way", "the", "a", "right", "next", "big", "to",
        "of", "and", "long",
    ];
    let is = |lexeme: &Lexeme, word: &str| matches!(&lexeme.token, Token::Word(own) if own == word);
    let mut at = 1;
    while at < lexemes.len() {
        let twice =
            lexemes[at].token == lexemes[at - 1].token && TWICE.iter().any(|word| is(&lexemes[at], word));
        let marks = super::parts::is_mark(&lexemes[at]) && lexemes[at].token == lexemes[at - 1].token;
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

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let lists = [TAKES, AWAY, COATS, SPLASH, COAT, INSTEAD_OF, BECOMES, CHANGES, KEEPS];
    lists.into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}
