//! Conditions: "if there is no bench near the fountain, add one"; and what is left out: "all cars except the red one".

use simworld_core::seam::PlanError;

use super::super::clause::{Count, Reference, Target};
use super::super::lexer::Token;
use super::super::lexicon::{longest, longest_phrase};
use super::super::paint::PAINTS;
use super::super::parser::Parser;
use super::super::phrases::Phrases;
use super::conditions::at_once;
use super::parse::{Reader, joint};
use super::wish::Wish;

/// If there is something.
#[rustfmt::skip]
const IF: &Phrases = &Phrases::of(&["if there is", "if there are", "if you find", "if you see", "in case there is", "if we have",
    "provided there is", "when there is", "should there be", "if there exists", "as long as there is", "in the event that there is", "in case of", "if we find", "if i see", "if we see", "if you come across",
    "should you see", "should you find", "if theres", "provided that there is", "if there should be", "if there happens to be", "in the event of", "if there stands", "assuming there is", "only if there is",
    "only if there are", "only if theres", "in case theres", "provided theres", "as long as theres", "but only if there is", "as long as there are", "provided there are", "in case there are", "assuming theres", "if there exist",
    "when theres", "if we had", "were there", "if weve got", "if we have got", "if you have", "if youve got", "in case weve got", "in case we have", "suppose theres", "suppose there is", "supposing there is"]);
/// If there is nothing of the kind.
#[rustfmt::skip]
const UNLESS: &Phrases = &Phrases::of(&["unless there is", "unless there are", "unless you find", "unless we have", "if there isnt",
    "if there is not", "if there arent", "if there are not", "if we dont have", "unless you see", "if you find no", "unless theres", "unless there already is",
    "unless there are already", "unless theres already", "if there isnt already", "unless we already have", "if nobody has put", "if nobody put", "if no one has put", "if nobody has placed", "if nobody has set up", "if nobody has added", "if we havent got", "if there isnt yet"]);
/// What is not meant.
#[rustfmt::skip]
pub(super) const EXCEPT: &Phrases = &Phrases::of(&["except", "except for", "but", "apart from", "other than", "but not", "besides", "excluding", "save",
    "with the exception of", "not counting", "not", "without", "but leave", "but keep", "but spare", "leaving", "keeping", "sparing",
    "but leave out", "but not for", "leaving out", "only not", "and leave", "and keep"]);

/// What is not so of those that are meant.
#[rustfmt::skip]
const IS_NOT: &[&str] = &["that is not", "that are not", "which is not", "which are not", "that isnt", "that arent", "who is not", "who are not", "not being",
    "that is not painted", "that are not painted", "which isnt", "which arent"];

impl Reader<'_> {
    /// A question, an order to do nothing, or a wish on a condition.
    pub(super) fn asked_or_given(&mut self, end: usize) -> Result<Option<Vec<Vec<Wish>>>, PlanError> {
        if let Some(wish) = self.asked(end)? {
            self.at = end;
            return Ok(Some(vec![vec![wish]]));
        }
        if let Some(made) = self.given_room(end)? {
            return Ok(Some(made));
        }
        if let Some(made) = self.given_larger(end) {
            return Ok(Some(made));
        }
        if let Some(made) = self.given_sky(end).or_else(|| self.given_passage(end)) {
            return Ok(Some(made));
        }
        self.given(end)
    }

    /// A wish on a condition, before it or behind it.
    pub(super) fn given(&mut self, end: usize) -> Result<Option<Vec<Vec<Wish>>>, PlanError> {
        let start = self.at;
        let is_condition = |at: usize| {
            let rest = &self.lexemes[at..end];
            let unless = longest_phrase(rest, UNLESS).map(|words| (false, words));
            unless.or(longest_phrase(rest, IF).map(|words| (true, words))).or_else(|| self.is_so(at, end))
        };
        let Some((at, (there, words))) = (start..end).find_map(|at| Some((at, is_condition(at)?))) else {
            return Ok(None);
        };
        let from = at + words;
        let none = longest_phrase(&self.lexemes[from..end], &["no", "not any", "not a single", "none"]);
        let (there, from) = (there && none.is_none(), from + none.unwrap_or(0));
        let (least, there, from) = match self.at_least(from, end) {
            Some((least, so, words)) => (least, there == so, from + words),
            None => (1, there, from),
        };
        if at > start {
            return self.given_behind(at, (from, end), (least, there)).map(Some);
        }
        self.given_before(from, end, (least, there)).map(Some)
    }

    /// "Put a bench there unless there is one": the wish stands before its condition, which begins at `at`.
    fn given_behind(
        &mut self,
        at: usize,
        (from, end): (usize, usize),
        so: (u32, bool),
    ) -> Result<Vec<Vec<Wish>>, PlanError> {
        let start = self.at;
        let stop = self.before_politeness(from, end);
        let coloured = self.coloured(from, end);
        let so = (so.0, so.1 == coloured.as_ref().is_none_or(|(_, is)| *is));
        let is_coloured = coloured.is_some();
        let what = if from >= stop {
            // "If there are more than three": of what the wish is about.
            Ok(Reference::to(Target::It, "it".to_owned()))
        } else {
            coloured.map_or_else(|| self.one_of(from, end), |(what, _)| Ok(what))
        };
        let stop = if joint(&self.lexemes[at - 1..at]).is_some() { at - 1 } else { at };
        let mut wishes = Reader { at: start, ..*self }.wish(stop)?;
        let mut what = match what {
            Err(PlanError::NotFound { wanted, .. }) if so.0 == 1 && is_noun(&wanted) => {
                self.at = end;
                return Ok(if so.1 { nothing(&wanted) } else { wishes });
            }
            read => read?,
        };
        // "Paint every car black unless it is blue": each of them.
        let each = what.target == Target::It
            && wishes
                .iter_mut()
                .flatten()
                .flat_map(Wish::objects_mut)
                .all(|object| object.count == Count::All);
        if is_coloured && (what.target == Target::Them || each) && so.0 == 1 {
            // "Paint the benches green unless they are red": those that are not.
            let all = wishes.iter_mut().flatten().flat_map(Wish::objects_mut);
            all.for_each(|object| restrict(object, &what, so.1));
            self.at = end;
            return Ok(wishes);
        }
        if super::says::is_it(&what) {
            // "Remove the hydrant unless it is red".
            let object = wishes.first().and_then(|readings| readings.first()?.object().cloned());
            let Some(object) = object else {
                return Err(self.not_understood("say what the condition is about"));
            };
            what.traits = super::super::clause::Traits { paint: what.traits.paint, ..object.traits };
            what = Reference { traits: what.traits, ..object };
        }
        self.at = end;
        Ok(on_condition(wishes, &what, so))
    }

    /// "If there is a fountain, put a dog next to it; otherwise ...".
    fn given_before(
        &mut self,
        from: usize,
        end: usize,
        (least, there): (u32, bool),
    ) -> Result<Vec<Vec<Wish>>, PlanError> {
        let ends = |at: &usize| {
            matches!(self.lexemes[*at].token, Token::Comma | Token::Break)
                || longest_phrase(&self.lexemes[*at..end], &["then"]).is_some()
        };
        // "If there is a fountain put a dog next to it": without a comma the verb begins the wish.
        let orders = |at: &usize| {
            longest(&self.lexemes[*at..end], &super::words::VERBS).is_some()
                && !self.is_in_noun(from, *at)
                && !self.words[self.lexemes[*at].start..].starts_with(char::is_uppercase)
                && self.one_of(from, self.without_there(from, *at)).is_ok()
        };
        let marked = (from + 1..self.lexemes.len().min(end)).find(ends);
        let ordered = (from + 1..marked.unwrap_or(end)).find(orders).map(|cut| (cut, cut));
        let Some((cut, next)) = ordered.or_else(|| marked.map(|cut| (cut, cut + 1))) else {
            self.at = end;
            return Err(self.not_understood("put a comma behind the condition"));
        };
        let stop = self.without_there(from, cut);
        // "If there is no market stall": nobody here has one.
        let stop_of_what = stop;
        let noun = from + longest_phrase(&self.lexemes[from..stop], &["a", "an", "any"]).unwrap_or(0);
        let is_none = self.names.is_sort_of_none(&self.lexemes[noun..stop]);
        let coloured = self.coloured(from, stop);
        let there = there == coloured.as_ref().is_none_or(|(_, is)| *is);
        let what = coloured.map_or_else(|| self.one_of(from, stop), |(what, _)| Ok(what));
        self.at = next;
        self.skip_joints_to(end);
        if what.as_ref().is_ok_and(super::says::is_it) {
            return Err(self.not_understood("say what the condition is about"));
        }
        let (stop, other) = self.otherwise(self.at, end);
        let then = self.then(what.as_ref().ok(), self.at, stop)?;
        let other = match other.filter(|from| !self.is_nothing(*from, end)) {
            Some(from) => Some(self.then(what.as_ref().ok(), from, end)?),
            None => None,
        };
        self.at = end;
        match what {
            // What nobody knows here is not there.
            Err(PlanError::NotFound { wanted, .. }) if least == 1 && (is_noun(&wanted) || is_none) => {
                Ok(if there { other.unwrap_or_else(|| nothing(&wanted)) } else { then })
            }
            Err(_) if least == 1 && is_none => Ok(if there {
                other.unwrap_or_else(|| nothing(&self.written(from, stop_of_what)))
            } else {
                then
            }),
            Err(error) => Err(error),
            Ok(what) => {
                let mut all = on_condition(then, &what, (least, there));
                all.extend(other.into_iter().flat_map(|other| on_condition(other, &what, (least, !there))));
                Ok(all)
            }
        }
    }

    /// The wishes that stand on a condition about something.
    fn then(
        &mut self,
        what: Option<&Reference>,
        from: usize,
        stop: usize,
    ) -> Result<Vec<Vec<Wish>>, PlanError> {
        self.at = from;
        match what.and_then(|what| self.one_of_those(what, stop)) {
            Some(wish) => Ok(vec![vec![wish]]),
            None => self.wishes_between(from, stop),
        }
    }

    /// Where the words end without "somewhere", "around" and the like.
    pub(super) fn without_there(&self, from: usize, end: usize) -> usize {
        const THERE: &Phrases = &Phrases::of(&[
            "somewhere",
            "around",
            "anywhere",
            "here",
            "there",
            "about",
            "around here",
            "at all",
            "somewhere around",
            "anywhere around",
            "nearby",
            "left",
            "in sight",
            "yet",
            "anywhere yet",
            "here yet",
            "there yet",
            "in town",
            "in the town",
            "on campus",
            "on the campus",
            "on the grounds",
            "in the harbour",
            "in the quarter",
            "in the city",
            "in the scene",
            "on the map",
            "in this town",
            "in the area",
            "is there",
            "is here",
            "is still there",
            "is still here",
            "is still around",
            "is around",
            "still exists",
            "exists",
            "still stands there",
            "still stands",
            "are still there",
            "are still here",
        ]);
        (from + 1..end)
            .find(|at| longest_phrase(&self.lexemes[*at..end], THERE) == Some(end - at))
            .unwrap_or(end)
    }

    /// Where a wish ends that is followed by another for the other case, and where that begins.
    fn otherwise(&self, from: usize, end: usize) -> (usize, Option<usize>) {
        const OTHERWISE: &[&str] =
            &["otherwise", "else", "or else", "if not", "if there is none", "if there is not", "if none"];
        for at in from + 1..end {
            let Some(words) = longest_phrase(&self.lexemes[at..end], OTHERWISE) else { continue };
            let mut stop = at;
            while stop > from + 1 && joint(&self.lexemes[stop - 1..stop]).is_some() {
                stop -= 1;
            }
            let mut next = at + words;
            while next < end && super::super::lexer::is_mark(&self.lexemes[next]) {
                next += 1;
            }
            return (stop, Some(next));
        }
        (end, None)
    }

    /// "Otherwise nothing shall be done".
    fn is_nothing(&self, from: usize, end: usize) -> bool {
        from >= end
            || longest_phrase(
                &self.lexemes[from..end],
                &[
                    "nothing",
                    "do nothing",
                    "leave it",
                    "leave everything",
                    "never mind",
                    "dont",
                    "dont bother",
                    "forget it",
                    "then nothing",
                    "leave them",
                ],
            )
            .is_some()
    }

    /// "More than two", "at least three", "fewer than four": how many there are at least, or with `false` are not.
    fn at_least(&self, from: usize, end: usize) -> Option<(u32, bool, usize)> {
        let rest = &self.lexemes[from..end];
        let (more, is_so, words) = [
            (1, true, longest_phrase(rest, &["more than", "over"])),
            (0, true, longest_phrase(rest, &["at least", "no fewer than", "no less than", "not less than"])),
            (0, false, longest_phrase(rest, &["fewer than", "less than", "not even"])),
            (1, false, longest_phrase(rest, &["at most", "no more than", "not more than"])),
        ]
        .into_iter()
        .find_map(|(more, is_so, words)| Some((more, is_so, words?)))?;
        let (number, count) = super::super::numbers::number(&rest[words..])?;
        (number.fract() == 0.0 && (0.0..1000.0).contains(&number))
            .then(|| (number as u32 + more, is_so, words + count))
    }

    /// "If Ada is in the park": how a thing that is there stands.
    fn is_so(&self, at: usize, end: usize) -> Option<(bool, usize)> {
        let words = longest_phrase(
            &self.lexemes[at..end],
            &["if", "unless", "only if", "in case", "provided", "provided that", "as long as", "when"],
        )?;
        let is_unless = self.word(at) == Some("unless");
        let cut = (at + words..end).find(|at| joint(&self.lexemes[*at..end]).is_some()).unwrap_or(end);
        if self.coloured(at + words, cut).is_some() {
            return Some((!is_unless, words));
        }
        // "When the van is white" may be now; "when Eve stands by the bus" is later.
        if self.word(at) == Some("when") {
            return None;
        }
        let mut parser = self.parser(at + words, end);
        let what = parser.reference(0).ok()?;
        // "If the hydrant is still there".
        let is_there = longest_phrase(
            &self.lexemes[parser.at.min(end)..end],
            &[
                "is still there",
                "is still here",
                "is there",
                "is here",
                "is still around",
                "still exists",
                "exists",
                "is around",
                "still stands",
            ],
        );
        if let Some(there) = is_there.filter(|_| matches!(what.target, Target::Any(_) | Target::Named(_)))
            && (parser.at + there >= end || joint(&self.lexemes[parser.at + there..end]).is_some())
        {
            return Some((!is_unless, words));
        }
        // "If one of the limes is taller than ten metres".
        let is_told = what.relation.is_some() || what.traits.than.is_some();
        let stands = is_told && matches!(what.target, Target::Any(_) | Target::Named(_));
        let ends = parser.at >= end || joint(&self.lexemes[parser.at..end]).is_some();
        (stands && ends).then_some((!is_unless, words))
    }

    /// "The truck is orange": the truck that is; with `false`, that it is not.
    fn coloured(&self, from: usize, end: usize) -> Option<(Reference, bool)> {
        const IS: &Phrases =
            &Phrases::of(&["is", "are", "is not", "are not", "isnt", "arent", "is already", "are already"]);
        let end = self.before_politeness(from, end);
        let is = |at: usize| longest_phrase(&self.lexemes[at..end], IS);
        let (cut, said) = if self.contracted(from) {
            (from, 1)
        } else {
            (from + 1..end).find_map(|at| Some((at, is(at)?)))?
        };
        let not = (cut..cut + said).any(|at| matches!(self.word(at), Some("not" | "isnt" | "arent")));
        let (paint, words) = longest(&self.lexemes[cut + said..end], PAINTS)?;
        let mut what = if self.contracted(from) {
            let them = if self.word(from) == Some("theyre") { Target::Them } else { Target::It };
            Reference::to(them, "it".to_owned())
        } else {
            self.one_of(from, cut).ok()?
        };
        what.traits.paint = Some(paint);
        let behind = longest_phrase(
            &self.lexemes[cut + said + words..end],
            &["yet", "already", "by now", "still", "now"],
        );
        (cut + said + words + behind.unwrap_or(0) == end).then_some((what, !not))
    }

    /// "Except the red one", behind a thing.
    pub(super) fn except(&self, parser: &mut Parser<'_>, what: &mut Reference) {
        let start = parser.at;
        let plural = what.count == Count::All || matches!(what.target, Target::Any(_));
        if self.view.streets.is_some() && plural && parser.eat_any(IS_NOT) {
            if let Some((paint, words)) = longest(parser.rest(), PAINTS) {
                parser.at += words;
                let mut except = Reference { count: Count::All, ..what.clone() };
                except.traits.paint = Some(paint);
                what.except = Some(Box::new(except));
                return;
            }
            parser.at = start;
        }
        if self.view.streets.is_some() && plural && parser.eat_any(EXCEPT) {
            parser.class = if let Target::Any(class) = &what.target { Some(class) } else { None };
            if let Ok(mut except) = parser.reference(1) {
                // "All oaks except the tallest": of the oaks.
                if except.target == what.target && except.traits.sort.is_none() {
                    except.traits.sort.clone_from(&what.traits.sort);
                }
                what.except = Some(Box::new(except));
                return;
            }
        }
        parser.at = start;
    }
}

fn on_condition(wishes: Vec<Vec<Wish>>, what: &Reference, (least, there): (u32, bool)) -> Vec<Vec<Wish>> {
    let given = |wish| Wish::Given { what: what.clone(), least, there, then: Box::new(wish) };
    vec![at_once(wishes).into_iter().map(given).collect()]
}

/// Whether what nobody knows is a thing, as far as small words tell, and no other condition.
fn is_noun(wanted: &str) -> bool {
    const NONE: &[&str] = &[
        "fewer", "less", "exactly", "neither", "nor", "than", "is", "are", "more", "either", "or", "not",
        "any", "anything", "enough", "it", "they", "has", "have",
    ];
    !wanted.is_empty() && !wanted.to_lowercase().split_whitespace().any(|word| NONE.contains(&word))
}

/// What is done if something is there that is not.
fn nothing(wanted: &str) -> Vec<Vec<Wish>> {
    vec![vec![Wish::Nothing { why: format!("nothing was changed: there is no {wanted}") }]]
}

/// Of several things those that are of a colour or, with `false`, are not.
fn restrict(object: &mut Reference, like: &Reference, so: bool) {
    if so {
        object.traits.paint = like.traits.paint;
        return;
    }
    let mut except = Reference { count: Count::All, except: None, ..object.clone() };
    except.traits.paint = like.traits.paint;
    object.except = Some(Box::new(except));
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    const COUNTED: &[&str] =
        &["fewer", "less", "more", "than", "least", "most", "exactly", "over", "neither", "nor"];
    IF.iter().chain(UNLESS).chain(EXCEPT).chain(IS_NOT).chain(COUNTED).flat_map(|phrase| phrase.split(' '))
}
