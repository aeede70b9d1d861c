//! Sentences of several parts, some of which ask for nothing: "Ben is lonely; let Anna stand beside him", "the taxi should be
//! pink, the white one too".
//!
//! A part is a wish of its own, or one that leaves out what was said before it, or a remark. A remark says how things are or
//! why somebody wants something. What begins as an order does is none, nor what says how something should be, so that no
//! wish is passed over because its words are not understood.

use super::super::clause::{Count, Reference, Target};
use super::super::lexer::{Lexeme, is_mark};
use super::super::lexicon::{category, is_animate, longest, longest_phrase};
use super::super::phrases::Phrases;
use super::follow::Said;
use super::parse::{Reader, joint};
use super::wish::Wish;
use super::words::VERBS;

/// As many parts are tried in all; whoever says more is not understood.
const MOST_TRIED: usize = 160;
/// What begins a part beside the joints of wishes.
#[rustfmt::skip]
const CUTS: &Phrases = &Phrases::of(&["because", "since", "as", "so", "so that", "cause", "cos", "coz", "for", "while", "which", "where", "in order to", "due to", "given that",
    "seeing that", "considering", "or else", "otherwise", "have it", "have him", "have her", "have them"]);

/// Behind these stands nothing that "it" could be: "there is too much litter at the statue".
#[rustfmt::skip]
const TOO_MUCH: &Phrases = &Phrases::of(&["there is too much", "theres too much", "there is so much", "theres so much", "there are too many", "there is no", "theres no", "there is nothing", "theres nothing"]);
/// A search for the parts of a sentence.
struct Search<'a> {
    /// Whether somebody has what a wish asks for.
    is_known: &'a dyn Fn(&Wish) -> bool,
    /// Whether what the first wish is about is there.
    is_there: &'a dyn Fn(&[Vec<Wish>]) -> bool,
    /// By what is known what asks for nothing.
    telling: Telling,
    tried: usize,
}

/// By what parts are known that ask for nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Telling {
    /// By the words of remarks.
    Words,
    /// By their shape too, whatever their words are.
    Shape,
    /// As whole sentences too, whatever they speak of.
    Sentence,
}

/// So much was tried that nothing more is.
struct Spent;

impl Reader<'_> {
    /// All wishes of a sentence whose parts hang together, or ask for nothing.
    pub(super) fn in_parts(
        &self,
        is_known: &dyn Fn(&Wish) -> bool,
        is_there: &dyn Fn(&[Vec<Wish>]) -> bool,
        telling: Telling,
    ) -> Option<Vec<Vec<Wish>>> {
        let mut search = Search { is_known, is_there, telling, tried: 0 };
        let found = self.parts_from(0, &Said::default(), &[], &mut search)?;
        (!found.is_empty()).then_some(found)
    }

    fn parts_from(
        &self,
        from: usize,
        said: &Said,
        spoken_of: &[Reference],
        search: &mut Search<'_>,
    ) -> Option<Vec<Vec<Wish>>> {
        let mut start = Reader { at: from, ..*self };
        // "Everyone" may be spoken to, or be who a remark is about.
        let remark = from + self.lexemes[from..].iter().take_while(|lexeme| is_mark(lexeme)).count();
        start.skip_joints_to(self.lexemes.len());
        let from = start.at;
        if from >= self.lexemes.len() {
            return Some(Vec::new());
        }
        let cuts = self.cuts(from);
        if let Some(found) = self.wish_and_rest(from, &cuts, (said, spoken_of), search).ok()? {
            return Some(found);
        }
        self.remark_and_rest((remark, from), &cuts, (said, spoken_of), search)
    }

    /// A wish that ends at one of the cuts, the last first, and all that follows it.
    fn wish_and_rest(
        &self,
        from: usize,
        cuts: &[usize],
        (said, spoken_of): (&Said, &[Reference]),
        search: &mut Search<'_>,
    ) -> Result<Option<Vec<Vec<Wish>>>, Spent> {
        for end in cuts.iter().rev().copied() {
            search.tried += 1;
            if search.tried > MOST_TRIED || self.memo.is_spent() {
                return Err(Spent);
            }
            let Some(mut wishes) = self.wishes_of_part((from, end), (said, spoken_of), search) else {
                continue;
            };
            let now = Said {
                wish: wishes.last().and_then(|readings| readings.first().cloned()),
                noun: self.last_noun(from, end).or_else(|| said.noun.clone()),
                place: Vec::new(),
            };
            if let Some(rest) = self.parts_from(end, &now, &[], search) {
                wishes.extend(rest);
                return Ok(Some(wishes));
            }
        }
        Ok(None)
    }

    /// The wishes of one part, with what was told of before in the place of "it", unless they only tell.
    fn wishes_of_part(
        &self,
        (from, end): (usize, usize),
        (said, spoken_of): (&Said, &[Reference]),
        search: &Search<'_>,
    ) -> Option<Vec<Vec<Wish>>> {
        let mut part = Reader { at: from, ..self.up_to(end) };
        let mut wishes = part.part(said, end)?;
        let is_first = said.wish.is_none() && spoken_of.is_empty();
        let both = (from..end).any(|at| self.word(at) == Some("both"));
        // "The bins are ugly" are both of them, and "the cone is" is one.
        let is_one = |one: &Reference| one.count == Count::One && !super::resolve::plural(one);
        let is_open = |wish: &mut Wish| wish.objects_mut().iter().any(|one| super::follow::is_open(one));
        if said.wish.as_ref().is_some_and(|before| self.is_stray(before, from, &wishes))
            || self.is_count_told(&wishes, from, end)
            || self.is_dislike_told(from, end)
            || self.is_only_told(&wishes, from, end)
            || both && matches!(spoken_of, [only] if is_one(only)) && wishes.iter_mut().flatten().any(is_open)
        {
            return None;
        }
        if let Some(before) = &said.wish {
            self.share_place(before, from, &mut wishes);
        }
        if spoken_of.is_empty() {
            wishes
                .iter_mut()
                .flatten()
                .for_each(|wish| super::mistaken::beside_what_was_told(wish, &said.place));
        }
        if !wishes.iter().flatten().all(search.is_known) || is_first && !(search.is_there)(&wishes) {
            return None;
        }
        let with = from > 0 && self.word(from - 1) == Some("with");
        for wish in wishes.iter_mut().flatten() {
            // "The van and the bike are broken, take both of them away".
            if let Wish::Remove { what } | Wish::Paint { what, .. } = wish
                && both
                && spoken_of.len() == 2
                && matches!(&what[..], [only] if super::follow::is_open(only))
            {
                *what = spoken_of.to_vec();
            }
            if let Some(before) = &said.wish {
                super::shared::on_street(before, wish, with);
            }
            let others = self.others_of(wish, spoken_of);
            wish.is_about(&others);
            wish.stands(&said.place);
        }
        let to_itself = |wish: &Wish| {
            matches!(wish, Wish::Face { what, towards }
                if matches!(&what[..], [only] if only.target == towards.target))
        };
        (!wishes.iter().flatten().any(to_itself)).then_some(wishes)
    }

    /// What was spoken of, without what a wish is about itself: "Rex and Ben belong together, put Rex beside him".
    fn others_of(&self, wish: &mut Wish, spoken_of: &[Reference]) -> Vec<Reference> {
        let spoken_of = self.in_order_of(wish, spoken_of);
        let own: Vec<Target> = wish.objects_mut().iter().map(|one| one.target.clone()).collect();
        let others: Vec<Reference> =
            spoken_of.iter().filter(|one| !own.contains(&one.target)).cloned().collect();
        if others.is_empty() { spoken_of } else { others }
    }

    /// A remark that ends at any of the next cuts, and all that follows it: "the crate, I think, is ugly".
    fn remark_and_rest(
        &self,
        (remark, from): (usize, usize),
        cuts: &[usize],
        (said, spoken_of): (&Said, &[Reference]),
        search: &mut Search<'_>,
    ) -> Option<Vec<Vec<Wish>>> {
        let by_sentence = search.telling == Telling::Sentence;
        let whole = by_sentence.then(|| self.sentence_end(from));
        whole.into_iter().chain(cuts.iter().copied().take(4)).find_map(|end| {
            let is_heading = said.wish.is_none() && end < self.lexemes.len() && self.is_heading(from, end);
            let asks_nothing = is_heading
                || self.is_said_twice(said, from, end)
                || self.is_remark(from, end)
                || self.is_remark(remark.min(from), end)
                || said.wish.is_some() && self.is_idle(from, end);
            let is_told = || {
                search.telling != Telling::Words && self.is_told(remark.min(from), end, search.is_known)
                    || by_sentence && self.is_sentence_aside(from, end, search.is_known)
            };
            if !asks_nothing && !is_told()
                || said.wish.is_some() && (self.is_listed(said, from, end) || self.goes_on_within(from, end))
                || self.hides_wish(said, (from, end), search.is_known)
            {
                return None;
            }
            let mut things = self.remarked_on(from, end, spoken_of);
            // "Bo is waiting | for Ada": of both.
            let goes_on = remark > 0 && !is_mark(&self.lexemes[remark - 1]);
            if things.is_empty() || goes_on && !spoken_of.is_empty() {
                let later = std::mem::replace(&mut things, spoken_of.to_vec());
                things.extend(later);
            }
            let lacks = self.noun_lacking(from, end);
            // "My niece wants a unicorn, so put one here": a unicorn, and no niece.
            let of_crowd = |noun: &Vec<Lexeme>| super::follow::is_crowd(noun);
            let last = self.last_noun(from, end);
            let wanted = || self.wanted_noun(from, end);
            let last = if last.as_ref().is_some_and(of_crowd) { wanted().or(last) } else { last };
            let noun = lacks
                .or(last)
                .or_else(|| self.asset_in(from, end))
                .or_else(wanted)
                .or_else(|| said.noun.clone());
            let place = self
                .place_spoken_of(from, end)
                .or_else(|| self.subject_place(from, end))
                .unwrap_or_else(|| said.place.clone());
            let now = Said { noun, place, ..said.clone() };
            self.parts_from(end, &now, &things, search)
        })
    }

    /// Whether a new thing without a verb or a place is named behind what was asked for, and not along with it: "put a stool next to
    /// Anna, the poor woman".
    pub(super) fn is_stray(&self, before: &Wish, from: usize, wishes: &[Vec<Wish>]) -> bool {
        let nowhere = |wish: &Wish| matches!(wish, Wish::Add { at, .. } if at.is_empty());
        let is_joined = from > 0
            && matches!(self.word(from - 1), Some("and" | "also" | "plus" | "then" | "with" | "or" | "well"));
        let is_bare = longest(&self.lexemes[from..], &VERBS).is_none();
        // "People have to stand there for ages" moves nobody.
        let crowd: &[&str] = &[
            "people",
            "folks",
            "kids",
            "children",
            "visitors",
            "guests",
            "everybody",
            "everyone",
            "customers",
            "students",
            "tourists",
        ];
        let is_of_crowd = |wish: &Wish| {
            matches!(wish, Wish::Move { what, .. } | Wish::Face { what, .. } | Wish::Rotate { what, .. }
                if what.iter().any(|one| crowd.contains(&one.text.to_lowercase().as_str())))
        };
        wishes.iter().flatten().any(nowhere) && is_bare && !is_joined && !nowhere(before)
            || is_bare && wishes.iter().flatten().any(is_of_crowd)
    }

    /// What was spoken of, with the things first if the wish does something with "it", and with people first if it does with "him":
    /// "Ben owns the scooter, so move it next to him".
    fn in_order_of(&self, wish: &mut Wish, spoken_of: &[Reference]) -> Vec<Reference> {
        let is_somebody = |one: &&Reference| match &one.target {
            Target::Any(class) => class.kinds().iter().all(|kind| is_animate(*kind)),
            Target::Named(ids) => {
                ids.iter().all(|id| self.view.scene.entity(*id).is_some_and(|entity| is_animate(entity.kind)))
            }
            _ => false,
        };
        let (people, things): (Vec<&Reference>, Vec<&Reference>) = spoken_of.iter().partition(is_somebody);
        let first = wish.objects_mut().first().map(|object| object.text.clone());
        let order: Vec<&Reference> = match first.as_deref() {
            Some("it") => things.into_iter().chain(people).collect(),
            Some("him" | "her" | "he" | "she") => people.into_iter().chain(things).collect(),
            _ => return spoken_of.to_vec(),
        };
        order.into_iter().cloned().collect()
    }

    /// What somebody wants or is fond of, whatever it is: "a roller coaster", "mad about giraffes".
    fn wanted_noun(&self, from: usize, end: usize) -> Option<Vec<Lexeme>> {
        const LONGEST: usize = 3;
        let at = (from + 1..end).rev().find(|at| matches!(self.word(at - 1), Some("a" | "an" | "about")))?;
        let stop = (at..end).find(|at| is_mark(&self.lexemes[*at]) || self.is_place(*at)).unwrap_or(end);
        let noun = self.lexemes.get(at..stop).filter(|noun| (1..=LONGEST).contains(&noun.len()))?;
        (category(noun).is_none() && self.names.exact(noun).is_none()).then(|| noun.to_vec())
    }

    /// What might be made that a remark names last: "Ada forgot her guitar. Put one next to her".
    pub(super) fn asset_in(&self, from: usize, end: usize) -> Option<Vec<Lexeme>> {
        (from + 1..end).rev().find_map(|at| {
            let whose = ["a", "an", "her", "his", "my", "their", "our", "any", "no"];
            self.word(at - 1).filter(|word| whose.contains(word))?;
            let words = self.names.asset_words(&self.lexemes[at..end])?;
            self.names.exact(&self.lexemes[at..end]).is_none().then(|| self.lexemes[at..at + words].to_vec())
        })
    }

    /// "Bruno wants to watch Carol, turn him": what was asked for before, without saying anything new.
    pub(super) fn is_said_twice(&self, said: &Said, from: usize, end: usize) -> bool {
        #[rustfmt::skip]
        const DO_IT: &Phrases = &Phrases::of(&["turn him", "turn her", "turn it", "turn them", "rotate him", "rotate her", "rotate it", "rotate them", "move him", "move her", "move it", "move them",
            "do it", "do that", "so turn him", "so turn her", "so turn it", "so move it", "swap them", "switch them"]);
        matches!(
            said.wish,
            Some(Wish::Face { .. } | Wish::Rotate { .. } | Wish::Move { .. } | Wish::Swap { .. })
        ) && longest_phrase(&self.lexemes[from..end], DO_IT) == Some(self.before_politeness(from, end) - from)
    }

    /// What a remark is about; where there is nothing of the kind ("nowhere to sit near the table"), what that is near.
    fn remarked_on(&self, from: usize, end: usize, spoken_of: &[Reference]) -> Vec<Reference> {
        if (from..end).any(|at| self.word(at) == Some("nowhere"))
            && let Some([super::wish::Where::To(_, super::wish::Anchor::Thing(near))]) =
                self.place_spoken_of(from, end).as_deref()
        {
            return vec![near.clone()];
        }
        // "There is a crane in the park": the crane, and not the park.
        let there = longest_phrase(&self.lexemes[from..end], &["there is", "theres", "there are"]);
        let stop =
            there.and_then(|words| (from + words + 1..end).find(|at| self.is_place(*at))).unwrap_or(end);
        // "There is too much litter at the statue": nothing that "it" could be, but the statue.
        let stop = if longest_phrase(&self.lexemes[from..end], TOO_MUCH).is_some() { end } else { stop };
        // "The blue bench is where the ladies knit": the bench, and not the ladies.
        let stop = (from + 1..stop)
            .find(|at| {
                longest_phrase(
                    &self.lexemes[*at..stop],
                    &["is where", "is the place where", "is the spot where", "is what", "is when"],
                )
                .is_some()
            })
            .unwrap_or(stop);
        // "The statue is so small that people overlook it": the statue, and not the people.
        let so = (from..stop).find(|at| self.word(*at) == Some("so"));
        let stop = so.and_then(|so| (so + 1..stop).find(|at| self.word(*at) == Some("that"))).unwrap_or(stop);
        // "The crate is too big for the kids": the crate, and not the kids.
        let too = (from..stop).find(|at| matches!(self.word(*at), Some("too" | "enough")));
        let whom = too.and_then(|too| (too + 1..stop).find(|at| self.word(*at) == Some("for")));
        let mut things = self.spoken_of(from, whom.unwrap_or(stop));

        // "It is for Anna": what was spoken of before stays the first.
        let again =
            longest_phrase(&self.lexemes[from..end], &["it", "its", "it is", "they", "theyre", "they are"]);
        // "Bo works at the kiosk, but he's always on the square": Bo stays the first.
        let small = longest_phrase(&self.lexemes[from..end], &["but", "and", "so", "because", "since", "as"])
            .unwrap_or(0);
        let of_somebody =
            longest_phrase(&self.lexemes[from + small..end], &["he", "she", "hes", "shes"]).is_some();
        if of_somebody && !spoken_of.is_empty() {
            things.splice(0..0, spoken_of.iter().cloned());
        }
        if again.is_some() && !things.is_empty() {
            let it = Reference::to(super::super::clause::Target::It, "it".to_owned());
            things.insert(0, spoken_of.first().cloned().unwrap_or(it));
        }
        things
    }

    /// One part, all of its words.
    fn part(&mut self, said: &Said, end: usize) -> Option<Vec<Vec<Wish>>> {
        if let Some(wishes) = self.more_of_it(said, end) {
            return Some(wishes);
        }
        let start = self.at;
        let stop = self.before_politeness(start, end);
        if let Some(wish) = self.mended(stop) {
            return Some(vec![vec![wish]]);
        }
        // "The white ones go" behind chairs: the white chairs.
        // What stands before them in the part itself is what they are: "all the scooters except the green one".
        let one = (start..stop).find(|at| matches!(self.word(*at), Some("one" | "ones"))).unwrap_or(start);
        let of_those = (self.names_ones(start, stop) && self.last_noun(start, one).is_none())
            .then(|| self.with_noun(said, start, stop))
            .flatten();
        if let Some(wishes) = of_those.as_ref().and_then(|order| self.read_anew(order)) {
            return Some(wishes);
        }
        // "Paint the white car blue and the black one too".
        let too = of_those.as_ref().and_then(|_| self.with_noun(said, start, end));
        if let Some(wishes) = too.as_ref().and_then(|order| self.over(order).more_of_it(said, order.len())) {
            return Some(wishes);
        }
        if let Ok(wishes) = self.wish(end)
            && self.at >= stop
        {
            return Some(wishes);
        }
        self.at = start;
        if let Some(wishes) = self.follows(said, end).or_else(|| self.same_of(said, start, stop)) {
            return Some(wishes);
        }
        // "Swap the red bench with the blue one".
        let one = (start..end).find(|at| matches!(self.word(*at), Some("one" | "ones"))).unwrap_or(end);
        let own = Said { noun: self.last_noun(start, one), ..Said::default() };
        let found = self.with_noun(&own, start, end).and_then(|order| self.read_anew(&order));
        // "A cone next to the car to the left of the black one": the black car.
        found.or_else(|| {
            let noun = (start + 1..one.min(end)).rev().find_map(|at| self.last_noun(at, one))?;
            let own =
                Said { noun: Some(noun).filter(|noun| own.noun.as_ref() != Some(noun)), ..Said::default() };
            self.with_noun(&own, start, end).and_then(|order| self.read_anew(&order))
        })
    }

    /// "The white one", "the others ones": which of those that were named before.
    fn names_ones(&self, from: usize, end: usize) -> bool {
        (from..end).any(|at| {
            self.word(at) == Some("the")
                && (at + 2..end.min(at + 4)).any(|at| matches!(self.word(at), Some("one" | "ones")))
        })
    }

    /// "Fix that with a bench".
    fn mended(&self, end: usize) -> Option<Wish> {
        #[rustfmt::skip]
        const MENDS: &Phrases = &Phrases::of(&["fix that with", "fix it with", "fix this with", "solve that with", "solve it with", "solve this with", "remedy that with", "change that with",
            "sort that out with", "sort it out with", "help with", "fix that by adding", "fix it by adding", "change that by adding", "so fix that with", "cure that with",
            "mend that with", "deal with that by adding", "fix that by putting", "help them with", "help out with", "make up for it with", "brighten it up with",
            "liven it up with", "cheer it up with", "spruce it up with", "spice it up with", "complete it with", "what about", "how about", "why not"]);
        let words = longest_phrase(&self.lexemes[self.at..end], MENDS)?;
        let mut reader = Reader { at: self.at + words, ..self.up_to(end) };
        if reader.is_definite(reader.at) {
            return None;
        }
        let thing = reader.new_thing(end).ok().filter(|_| reader.at >= end)?;
        Some(Wish::Add { things: vec![thing], at: Vec::new() })
    }

    /// Where a part that begins here may end, the nearest first.
    fn cuts(&self, from: usize) -> Vec<usize> {
        let all = self.lexemes.len();
        let is_cut = |at: &usize| {
            is_mark(&self.lexemes[*at])
                || !self.is_place(*at)
                    && (joint(&self.lexemes[*at..]).is_some()
                        || longest_phrase(&self.lexemes[*at..], CUTS).is_some()
                        || self.runs_on(from, *at)
                        || self.is_purpose(from, *at))
        };
        (from + 1..all).filter(is_cut).chain([all]).collect()
    }

    /// "The bin is full put another one beside it": an order behind a remark with no mark between.
    fn runs_on(&self, from: usize, at: usize) -> bool {
        #[rustfmt::skip]
        const BEFORE: &[&str] = &["to", "and", "should", "could", "can", "must", "will", "you", "not", "dont", "lets", "let", "have", "would", "may", "i", "we", "please", "just", "then", "or", "never", "also", "be", "the", "a", "so", "because", "since", "therefore"];
        #[rustfmt::skip]
        const ORDERS: &Phrases = &Phrases::of(&["put", "move", "get", "get rid of", "take", "remove", "paint", "make", "turn", "add", "give", "shift", "swap", "please", "throw", "bin", "delete", "bring", "send", "replace", "scrap", "lose",
            "say", "colour", "place", "set", "push", "pull", "drag", "tow"]);
        let Some(words) = longest_phrase(&self.lexemes[at..], ORDERS)
            .filter(|_| at > from + 2 && !self.ends_longer_noun(at, self.lexemes.len()))
        else {
            return false;
        };
        let what = longest_phrase(
            &self.lexemes[at + words..],
            &[
                "it", "them", "him", "her", "another", "one", "a", "an", "two", "three", "some", "that",
                "put", "move", "take", "remove", "get", "make", "paint", "turn",
            ],
        );
        what.is_some() && self.word(at - 1).is_some_and(|word| !BEFORE.contains(&word))
    }

    /// Whether "to" says here what for: no place begins with it, and no verb wants it.
    fn is_purpose(&self, from: usize, at: usize) -> bool {
        #[rustfmt::skip]
        const BEFORE: &[&str] = &["next", "close", "left", "right", "over", "up", "has", "have", "had", "need", "needs", "want", "wants", "like", "love",
            "ought", "going", "supposed", "closer", "nearer", "nearest", "closest", "near", "opposite", "adjacent", "on", "used", "wish", "try", "back"];
        self.word(at) == Some("to")
            && at > from + 1
            && self.word(at - 1).is_none_or(|word| !BEFORE.contains(&word))
            && self.word(at + 1).is_some()
            && !self.is_place(at)
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    CUTS.iter().flat_map(|phrase| phrase.split(' '))
}
