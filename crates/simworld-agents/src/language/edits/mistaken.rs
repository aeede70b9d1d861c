//! What is read as a wish and only tells, what seems to tell and holds a wish, and where what is listed stands.

use super::super::lexer::is_mark;
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::follow::Said;
use super::parse::Reader;
use super::wish::{Anchor, Where, Wish};
use super::words::{VERBS, Verb};

/// Before what somebody waits for.
#[rustfmt::skip]
pub(super) const WAITS: &Phrases = &Phrases::of(&["we wait for", "i wait for", "we are waiting for", "were waiting for", "im waiting for", "i am waiting for", "we have been waiting for", "weve been waiting for", "we await", "we are awaiting", "were awaiting", "we expect", "i expect", "we are expecting", "were expecting", "im expecting", "i am expecting"]);

impl Reader<'_> {
    /// "Thirty men are coming, thirty, so ...": bare things without a place from which a request follows are who it is for.
    pub(super) fn is_count_told(&self, wishes: &[Vec<Wish>], from: usize, end: usize) -> bool {
        let nowhere = |wish: &Wish| matches!(wish, Wish::Add { at, .. } if at.is_empty());
        let marks = self.lexemes[end..].iter().take_while(|lexeme| is_mark(lexeme)).count();
        // "Thirty men, so thirty chairs" is no list.
        let early = (from + 1..end.min(from + 4))
            .any(|at| is_mark(&self.lexemes[at]) && self.word(at + 1) == Some("so"));
        if early
            && super::super::numbers::count(&self.lexemes[from..end]).is_some()
            && longest(&self.lexemes[from..end], &VERBS).is_none()
        {
            return true;
        }
        marks > 0
            && longest_phrase(&self.lexemes[end + marks..], &["so"]).is_some()
            && wishes.iter().flatten().all(nowhere)
            && longest(&self.lexemes[from..end], &VERBS).is_none()
    }

    /// Whether an order that is understood stands in what seems to ask for nothing: "for the street party close Elm Street".
    pub(super) fn hides_wish(
        &self,
        said: &Said,
        (from, end): (usize, usize),
        is_known: &dyn Fn(&Wish) -> bool,
    ) -> bool {
        const BECAUSE: &Phrases = &Phrases::of(&["since", "because", "as", "now that", "because of"]);
        const FOR: &Phrases = &Phrases::of(&["for the", "for my", "for our", "for a", "for this", "while"]);
        let is_why = longest_phrase(&self.lexemes[from..end], FOR).is_some();
        // "Since it's the open day I need three flagpoles near the clinic".
        let is_reason = longest_phrase(&self.lexemes[from..end], BECAUSE).is_some();
        let is_there = |wish: &Wish| matches!(wish, Wish::Add { at, .. } if !at.is_empty());
        let wants_there = |at: usize| {
            is_reason
                && at > from + 2
                && matches!(self.word(at), Some("i" | "we" | "id" | "wed"))
                && Reader { at, ..self.up_to(end) }
                    .wish(end)
                    .is_ok_and(|wishes| wishes.iter().flatten().all(|wish| is_there(wish) && is_known(wish)))
        };
        if (from..end).any(wants_there) {
            return true;
        }
        (from..end).any(|at| {
            let may = at == from
                || is_mark(&self.lexemes[at - 1])
                || matches!(self.word(at - 1), Some("and" | "then" | "please" | "just" | "also" | "now"))
                || is_why && at > from + 2;
            may && longest(&self.lexemes[at..end], &VERBS).is_some()
                && !self.is_said_twice(said, at, end)
                && (self.renames(at, end)
                    || Reader { at, ..self.up_to(end) }
                        .wish(end)
                        .is_ok_and(|wishes| wishes.iter().flatten().all(is_known)))
        })
    }

    /// "Remove the van and the yellow car, ...": what is named behind "and" up to a mark is one more of those that were named.
    pub(super) fn is_listed(&self, said: &Said, from: usize, end: usize) -> bool {
        let is_joined = from > 0 && matches!(self.word(from - 1), Some("and" | "or" | "plus"));
        let mut parser = self.parser(from, end);
        let is_new = longest_phrase(&self.lexemes[from..end], &["a", "an", "another", "some"]).is_some()
            || super::super::numbers::count(&self.lexemes[from..end]).is_some()
                && !matches!(self.word(from + 1), Some("of" | "is" | "are" | "was" | "more"));
        let is_bare = |wish: &Wish| matches!(wish, Wish::Add { at, .. } if at.is_empty());
        if is_joined && is_new && said.wish.as_ref().is_some_and(is_bare) {
            return true;
        }
        // "Remove the red car and the white one, we want quiet".
        if is_joined && self.ends_one(from, end) {
            return true;
        }
        is_joined
            && self.is_definite(from)
            && parser.reference(0).is_ok()
            && parser.at > from
            // "Turn the taxi around and the van ninety degrees to the right".
            && (self.lexemes.get(parser.at).is_none_or(is_mark)
                || super::super::numbers::number(&self.lexemes[parser.at..end.max(parser.at)]).is_some()
                || self.says_how(from, parser.at, end))
    }

    /// "The white one" up to a mark or a colour.
    fn ends_one(&self, from: usize, end: usize) -> bool {
        let one = (from + 1..end.min(from + 4)).find(|at| matches!(self.word(*at), Some("one" | "ones")));
        self.word(from) == Some("the")
            && one.is_some_and(|one| {
                let behind = one + 1;
                self.lexemes.get(behind).is_none_or(is_mark)
                    || longest(&self.lexemes[behind..end.max(behind)], super::super::paint::PAINTS).is_some()
            })
    }

    /// "Turn Anna to the museum and Ben towards me, I want ...": a place or a colour behind what is named, and no verb up to the mark.
    fn says_how(&self, from: usize, at: usize, end: usize) -> bool {
        let rest = &self.lexemes[at.min(end)..end];
        let mark = (at..end).find(|at| is_mark(&self.lexemes[*at])).unwrap_or(end);
        let how = longest_phrase(rest, &["towards", "toward", "to", "around"]).is_some()
            || longest(rest, super::super::paint::PAINTS).is_some()
            || self.is_place(at);
        how && !self.states(from, mark)
    }

    /// "..., he'll fetch it later, and the crate behind the shop": a certain thing and its place behind "and", which no remark holds.
    pub(super) fn goes_on_within(&self, from: usize, end: usize) -> bool {
        (from + 1..end.saturating_sub(3)).any(|at| {
            if !is_mark(&self.lexemes[at]) || self.word(at + 1) != Some("and") || !self.is_certain(at + 2) {
                return false;
            }
            let mut parser = self.parser(at + 2, end);
            parser.reference(0).is_ok_and(|what| what.relation.is_some()) && parser.at >= end
                || parser.at > at + 2 && self.is_place(parser.at)
        })
    }

    /// "I hate the cone, so let's get rid of both": what an order follows from is none.
    pub(super) fn is_dislike_told(&self, from: usize, end: usize) -> bool {
        const DISLIKES: &Phrases = &Phrases::of(&[
            "i hate",
            "we hate",
            "i cant stand",
            "we cant stand",
            "i dont like",
            "we dont like",
            "i dont need",
            "we dont need",
            "i cant bear",
        ]);
        longest_phrase(&self.lexemes[from..end], DISLIKES).is_some() && self.leads_to_order(end)
    }

    /// What is read as a wish and only tells: of a crowd, of the weather that is to come, of a street that somebody closed.
    pub(super) fn is_only_told(&self, wishes: &[Vec<Wish>], from: usize, end: usize) -> bool {
        const WHO: &Phrases = &Phrases::of(&[
            "they",
            "theyve",
            "they have",
            "somebody",
            "someone",
            "the council",
            "the city",
            "the town",
            "the police",
            "the mayor",
        ]);
        let is_sky = |wish: &Wish| matches!(wish, Wish::Sky(_));
        let is_passage = |wish: &Wish| matches!(wish, Wish::Passage { .. });
        let has_closed = longest_phrase(&self.lexemes[from..end], WHO).is_some_and(|words| {
            matches!(
                self.word(from + words),
                Some("closed" | "shut" | "blocked" | "barred" | "opened" | "reopened")
            )
        });
        let is_forecast = || {
            (from..end).any(|at| longest_phrase(&self.lexemes[at..end], super::sky::FORECASTS).is_some())
                && self.leads_to_order(end)
        };
        self.is_enough(from, end)
            || self.is_awaited(wishes, from, end)
            || has_closed && wishes.iter().flatten().any(is_passage)
            || wishes.iter().flatten().any(is_sky)
                && (is_forecast()
                    || (from..end)
                        .any(|at| longest_phrase(&self.lexemes[at..end], super::sky::SHIVERS).is_some()))
            || self.is_crowd_told(wishes, from)
    }

    /// "We only need one seat out here, so remove every chair but one".
    pub(super) fn is_enough(&self, from: usize, end: usize) -> bool {
        const ENOUGH: &Phrases = &Phrases::of(&[
            "we only need",
            "i only need",
            "we just need",
            "we need only",
            "they only need",
            "you only need",
        ]);
        longest_phrase(&self.lexemes[from..end], ENOUGH).is_some() && self.leads_to_order(end)
    }

    /// "We wait for a delivery, put a bollard ...": what somebody waits for comes by itself, unless it is spoken of again.
    fn is_awaited(&self, wishes: &[Vec<Wish>], from: usize, end: usize) -> bool {
        const AGAIN: &[&str] = &["one", "ones", "it", "that", "this", "them", "those"];
        let nowhere = |wish: &Wish| matches!(wish, Wish::Add { at, .. } if at.is_empty());
        let is_again = |at: usize| self.word(at).is_some_and(|word| AGAIN.contains(&word));
        // The thing may be read alone, behind what it is waited for by.
        let begin = self.lexemes[..from].iter().rposition(is_mark).map_or(0, |mark| mark + 1);
        (begin..end).any(|at| longest_phrase(&self.lexemes[at..end], WAITS).is_some())
            && wishes.iter().flatten().all(nowhere)
            && self.lexemes[end..].iter().any(|lexeme| !is_mark(lexeme))
            && !(end..self.lexemes.len()).any(is_again)
    }

    /// "Kids are kids", "that's eleven people": nobody puts a crowd nowhere without a verb.
    fn is_crowd_told(&self, wishes: &[Vec<Wish>], from: usize) -> bool {
        const SAID: &Phrases = &Phrases::of(&[
            "thats",
            "that is",
            "were",
            "we are",
            "there are",
            "therell be",
            "there will be",
            "theyre",
            "they are",
            "ill have",
            "well be",
        ]);
        const CROWD: &[&str] = &[
            "people", "kids", "children", "folks", "guests", "visitors", "boys", "girls", "lads", "ladies",
            "men", "women", "friends",
        ];
        let said = &self.lexemes[from.saturating_sub(1)..];
        let is_said = longest_phrase(said, SAID).or(longest_phrase(&self.lexemes[from..], SAID)).is_some();
        let is_crowd = |wish: &Wish| {
            matches!(wish, Wish::Add { things, at } if (at.is_empty() || is_said)
                && things.iter().any(|thing| thing.words.last().is_some_and(|word| CROWD.contains(&word.as_str()))))
        };
        longest(&self.lexemes[from..], &VERBS).is_none() && wishes.iter().flatten().any(is_crowd)
    }

    /// "A slide in Rose Park, and a seesaw": what is listed behind a place without one of its own goes there too.
    pub(super) fn share_place(&self, before: &Wish, from: usize, wishes: &mut [Vec<Wish>]) {
        let is_joined = from > 0 && matches!(self.word(from - 1), Some("and" | "also" | "plus"));
        if !is_joined || longest(&self.lexemes[from..], &VERBS).is_some() {
            return;
        }
        let Wish::Add { at: place, .. } = before else { return };
        for wish in wishes.iter_mut().flatten() {
            if let Wish::Add { at, .. } = wish
                && at.is_empty()
            {
                at.clone_from(place);
            }
        }
    }

    /// "Rename it", whatever is said behind.
    fn renames(&self, at: usize, end: usize) -> bool {
        longest(&self.lexemes[at..end], &VERBS).is_some_and(|(verb, words)| {
            verb == Verb::Name
                && longest_phrase(
                    &self.lexemes[at + words..end],
                    &["it", "him", "her", "the", "that", "this"],
                )
                .is_some()
        })
    }
}

/// "There's a draught at the table, put a campfire next to it": of the table, where nothing else was told of.
pub(super) fn beside_what_was_told(wish: &mut Wish, place: &[super::wish::Where]) {
    let [Where::To(_, anchor @ Anchor::Thing(_)) | Where::By(anchor @ Anchor::Thing(_))] = place else {
        return;
    };
    if let Wish::Add { at, .. } = wish {
        let anchors = at.iter_mut().filter_map(Where::anchor_mut);
        anchors.filter(|own| own.is_it()).for_each(|own| *own = anchor.clone());
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    WAITS.iter().flat_map(|phrase| phrase.split(' '))
}
