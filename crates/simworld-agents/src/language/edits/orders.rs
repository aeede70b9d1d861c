//! Orders whose words stand in another order: "the bench please remove", "twice as big, the chair", "what we need is a bench".

use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::phrases::Phrases;
use super::forms::as_order;
use super::parse::Reader;
use super::says::Mood;
use super::wish::Wish;
use super::words::{VERBS, Verb};

impl Reader<'_> {
    /// A wish that is put together from words that stand apart.
    pub(super) fn composed(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        if self.depth >= super::says::DEEPEST || self.memo.is_spent() {
            return None;
        }
        self.with_topic(start, end)
            .or_else(|| self.addressed(start, end))
            .or_else(|| self.shared_out(start, end))
            .or_else(|| self.looking(start, end))
            .or_else(|| self.behind_preamble(start, end))
            .or_else(|| self.others_want(start, end))
            .or_else(|| self.cleft(start, self.before_politeness(start, end)))
            .or_else(|| self.there_lacks(start, end))
            .or_else(|| self.fronted(start, end))
            .or_else(|| self.told_in_pieces(start, end))
            .or_else(|| self.reordered(start, end))
            .or_else(|| self.without_reason(start, end))
            .or_else(|| self.without_aside(start, end))
    }

    /// "Hana, face the statue", "robot, go to the school": somebody is told what to do.
    fn addressed(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        #[rustfmt::skip]
        const DOES: &[&str] = &["face", "look", "look at", "turn to", "go to", "go", "stand", "sit", "wait", "move", "walk", "stay", "come", "turn"];
        let comma = (start + 1..end.min(start + 5)).find(|at| self.lexemes[*at].token == Token::Comma)?;
        longest_phrase(&self.lexemes[comma + 1..end], DOES)?;
        self.one_of(start, comma).ok().filter(|one| self.is_somebody(one))?;
        // "Turn around" is told with its verb first.
        let is_turn = self.word(comma + 1) == Some("turn");
        let verb = super::forms::word_at(&self.lexemes[comma], if is_turn { "turn" } else { "make" });
        let rest = comma + 1 + usize::from(is_turn);
        let order: Vec<Lexeme> = std::iter::once(verb)
            .chain(self.lexemes[start..comma].iter().cloned())
            .chain(self.lexemes[rest..end].iter().cloned())
            .collect();
        self.read_anew(&order)
    }

    /// Whether it is a person, a dog or a robot that is named.
    pub(super) fn is_somebody(&self, one: &super::super::clause::Reference) -> bool {
        use super::super::clause::Target;
        use super::super::lexicon::is_animate;
        match &one.target {
            Target::Any(class) => {
                !class.kinds().is_empty() && class.kinds().iter().all(|kind| is_animate(*kind))
            }
            Target::Named(ids) => {
                ids.iter().all(|id| self.view.scene.entity(*id).is_some_and(|entity| is_animate(entity.kind)))
            }
            _ => false,
        }
    }

    /// "The moped, being unlicensed, is to go": what stands between two commas and says nothing of what is asked.
    fn without_aside(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let commas: Vec<usize> =
            (start + 1..end).filter(|at| self.lexemes[*at].token == Token::Comma).take(MOST).collect();
        commas.windows(2).find_map(|pair| {
            let (from, to) = (pair[0] + 1, pair[1]);
            let says_more = |at: usize| {
                self.is_place(at)
                    || longest(&self.lexemes[at..to], &VERBS).is_some()
                    || longest(&self.lexemes[at..to], super::super::paint::PAINTS).is_some()
                    || super::super::numbers::number(&self.lexemes[at..to]).is_some()
                        && self.word(at) != Some("a")
            };
            if to - from > LONGEST_ASIDE
                || to <= from
                || (from..to).any(says_more)
                || category(&self.lexemes[from..to]).is_some()
            {
                return None;
            }
            let order: Vec<Lexeme> =
                self.lexemes[start..pair[0]].iter().chain(&self.lexemes[to + 1..end]).cloned().collect();
            self.read_anew(&order)
        })
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
                    let verb = longest(&self.lexemes[begins.at..end], &VERBS)
                        .filter(|(verb, _)| matches!(verb, Verb::Add | Verb::Put));
                    let at = begins.at + verb.map_or(0, |(_, words)| words);
                    let is_new = at < end
                        && (!self.is_definite(at)
                            || self.is_bare_plural(at, end)
                            || verb.is_none() && self.is_bare_noun(at, end));
                    let made = if is_new { self.all_added(at, end) } else { None };
                    made?.into_iter().map(|readings| all_at(readings, &places)).collect()
                });
            }
            let what = self.things(from, end).ok().filter(|_| self.is_certain(from))?;
            if let Some(factor) = super::predicates::size_of(&self.lexemes[start..stop]) {
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
            // "What the museum needs is a bench outside": of the museum.
            let whose = start + 1;
            let owner = (whose + 1..at).find_map(|cut| {
                let lacks = self.word(cut).is_some_and(|word| LACKING.contains(&word) || word == "is");
                self.one_of(whose, cut).ok().filter(|_| lacks && self.is_certain(whose))
            });
            if let Some(owner) = owner.filter(|owner| !super::says::is_it(owner)) {
                let anchor = super::wish::Anchor::Thing(owner);
                return self.up_to(end).given_to(&anchor, from, end).map(|wish| vec![vec![wish]]);
            }
            let mut reader = Reader { at: from, ..self.up_to(end) };
            reader.additions(end).ok().filter(|_| reader.at >= end)
        })
    }

    /// "The two cars, they must change places", "of the chairs only the red one stays", "except for the blue one, all cars become
    /// grey": what is spoken of comes first.
    fn with_topic(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        if let Some(words) = longest_phrase(
            &self.lexemes[start..end],
            &["of the", "among the", "of all the", "out of the", "of our", "from the"],
        ) {
            let noun = self.last_noun(start, end)?;
            let (_, count) = category(&self.lexemes[start + words..end])?;
            let mut from = start + words + count;
            from += usize::from(self.lexemes.get(from).is_some_and(super::super::lexer::is_mark));
            let said = super::follow::Said { noun: Some(noun), ..super::follow::Said::default() };
            return self.with_noun(&said, from, end).and_then(|order| self.read_anew(&order));
        }
        let comma = (start + 1..end).find(|at| self.lexemes[*at].token == Token::Comma)?;
        if longest_phrase(&self.lexemes[start..comma], super::given::EXCEPT).is_some() {
            return self.excepted_first(start, comma, end);
        }
        let is_again = matches!(
            self.word(comma + 1),
            Some("they" | "it" | "he" | "she" | "those" | "these" | "that" | "this")
        );
        if !is_again || !self.is_certain(start) || self.things(start, comma).is_err() {
            return None;
        }
        let order: Vec<Lexeme> =
            self.lexemes[start..comma].iter().chain(&self.lexemes[comma + 2..end]).cloned().collect();
        self.read_anew(&order)
    }

    /// "Except for the blue one, all cars become grey".
    fn excepted_first(&self, start: usize, comma: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let words = longest_phrase(&self.lexemes[start..comma], super::given::EXCEPT)?;
        let mut wishes = self.read_anew(&self.lexemes[comma + 1..end])?;
        for object in wishes.iter_mut().flatten().flat_map(Wish::objects_mut) {
            let mut parser = self.parser(start + words, comma);
            parser.class = match &object.target {
                super::super::clause::Target::Any(class) => Some(class),
                _ => None,
            };
            let except = parser.reference(1).ok().filter(|_| parser.at >= comma)?;
            object.except = Some(Box::new(except));
        }
        Some(wishes)
    }

    /// "There's a bench missing in front of the bakery".
    fn there_lacks(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let end = self.before_politeness(start, end);
        let from = start
            + longest_phrase(
                &self.lexemes[start..end],
                &[
                    "theres",
                    "there is",
                    "there are",
                    "there is still",
                    "theres still",
                    "i think theres",
                    "i think there is",
                ],
            )?;
        let cut = (from + 1..end).find(|at| {
            matches!(
                self.word(*at),
                Some("missing" | "lacking" | "needed" | "wanted" | "due" | "required" | "absent")
            )
        })?;
        let mut reader = Reader { at: from, ..self.up_to(cut) };
        let thing = reader.new_thing(cut).ok().filter(|_| reader.at >= cut && !self.is_certain(from))?;
        let at = if cut + 1 < end { self.places_to(cut + 1, end)? } else { Vec::new() };
        Some(vec![vec![Wish::Add { things: vec![thing], at }]])
    }

    /// "... is where the statue should be", "... would be a good spot for a bench".
    fn is_where(&self, at: usize, end: usize, places: &[super::wish::Where]) -> Option<Wish> {
        #[rustfmt::skip]
        const IS: &Phrases = &Phrases::of(&["is where", "is the place where", "is the right place for", "is the place for", "is a good place for", "would be a good place for",
            "would be the right place for", "is the spot for", "is a good spot for", "would be a good spot for", "would be perfect for", "is perfect for",
            "would be ideal for", "is ideal for", "would be the perfect place for", "is the perfect place for", "would be a nice place for", "is a nice place for",
            "would be a nice spot for", "would be the perfect spot for", "is the perfect spot for", "is just right for", "could hold", "could take", "has room for",
            "there is room for", "is room for", "is where i want", "is where we want", "is where we need", "is where i need", "is where id like", "would be great for"]);
        const TAILS: &Phrases = &Phrases::of(&[
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
        ]);
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
        let marks: Vec<usize> =
            (start..end).filter(|at| super::super::lexer::is_mark(&self.lexemes[*at])).collect();
        if marks.is_empty() || marks.len() > 4 {
            return None;
        }
        let (mut count, mut places, mut topic, mut made) = (None, None, None, None);
        let ends = marks.iter().copied().chain([end]);
        let mut from = start;
        for to in ends {
            let piece = &self.lexemes[from..to];
            let number = super::super::numbers::count(piece).filter(|(_, words)| *words == piece.len());
            if self.polite_at(from) >= to - from && to > from {
                from = to + 1;
                continue;
            }
            let found = if let Some((number, _)) = number {
                count.replace(number).is_none()
            } else if let Some(at) = self.places_to(from, to) {
                places.replace(at).is_none()
            } else if let Some(thing) = self.one_of(from, to).ok().filter(|_| self.is_certain(from)) {
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
        let mut at = places?;
        let Some(mut thing) = made else {
            // "Hana, next to Fay".
            let what = vec![topic.filter(|_| count.is_none() && marks.len() == 1)?];
            return Some(vec![vec![Wish::Move { what, at }]]);
        };
        thing.many &= count.is_none();
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

    /// An order whose verb stands behind its object or its place: "the bench please remove", "next to the museum a bench put".
    fn reordered(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let end = self.before_politeness(start, end);
        (start + 1..end).find_map(|at| {
            let (verb, words) = self.verb_at(at, end)?;
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
                if before.iter().any(super::super::lexer::is_mark) || is_made && self.is_certain(from) {
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

    /// The verb at a place, in its base form if it is inflected, and its words.
    fn verb_at(&self, at: usize, end: usize) -> Option<(Verb, Vec<Lexeme>)> {
        if let Some((verb, words)) = longest(&self.lexemes[at..end], &VERBS) {
            return Some((verb, self.lexemes[at..at + words].to_vec()));
        }
        let (verb, words, base) = as_order(&self.lexemes[at..end])?;
        Some((verb, std::iter::once(base).chain(self.lexemes[at + 1..at + words].iter().cloned()).collect()))
    }

    /// Where the words end without small ones and marks before a verb: "a bench by the museum, you must".
    fn without_small(&self, start: usize, mut end: usize) -> usize {
        const SMALL: &[&str] = &[
            "please", "you", "must", "i", "we", "can", "could", "should", "would", "like", "to", "want",
            "kindly", "just", "now", "that", "need", "have", "id", "will", "may", "let", "us", "lets",
            "shall", "do", "also", "then", "gladly",
        ];
        while end > start + 1
            && (super::super::lexer::is_mark(&self.lexemes[end - 1])
                || self.word(end - 1).is_some_and(|word| SMALL.contains(&word)))
        {
            end -= 1;
        }
        end
    }

    /// "..., so that people can rest": the wish before the reason.
    fn without_reason(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let cut = self.before_reason(start, end)?;
        let stop = if super::super::lexer::is_mark(&self.lexemes[cut - 1]) { cut - 1 } else { cut };
        let mut reader = Reader { at: start, depth: self.depth + 1, ..self.up_to(stop) };
        let last = reader.before_politeness(start, stop);
        reader.wish(stop).ok().filter(|_| reader.at >= last)
    }
}

/// New things at places that were told before them, if they have none of their own.
fn all_at(readings: Vec<Wish>, places: &[super::wish::Where]) -> Option<Vec<Wish>> {
    let placed = |wish| match wish {
        Wish::Add { things, at } if at.is_empty() => Some(Wish::Add { things, at: places.to_vec() }),
        Wish::Add { things, at } if places == at => Some(Wish::Add { things, at }),
        _ => None,
    };
    readings.into_iter().map(placed).collect()
}

/// So many commas are looked at, and an aside has no more words.
const MOST: usize = 5;
const LONGEST_ASIDE: usize = 8;

/// Whether the words begin with no pronoun.
fn is_it_not(words: &[Lexeme]) -> bool {
    longest_phrase(words, &["it", "them", "that", "this", "those", "these", "him", "her"]).is_none()
}
