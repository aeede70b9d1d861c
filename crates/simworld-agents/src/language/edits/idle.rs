//! What is said behind a request and asks for nothing, whatever it says: "..., the inspector insists", "... Safety first!".
//!
//! Remarks are known by what they say. Of these only that is known which they do not say: nothing by which anything in the scene could be
//! otherwise. They are passed over behind a request that was understood, and nowhere else.

use super::super::lexer::is_mark;
use super::super::lexicon::{longest, longest_phrase};
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::words::VERBS;

/// Words by which something may be asked for, or asked for otherwise.
#[rustfmt::skip]
const DEMANDS: &Phrases = &Phrases::of(&["should", "must", "ought", "shall", "please", "let", "lets", "instead", "unless", "until", "except", "only", "if", "when", "whenever", "has to", "have to", "had to", "needs", "need", "wants", "want", "better", "add", "put", "remove", "delete", "rather",
    "supposed", "shouldnt", "mustnt", "not", "dont", "no", "without", "but", "removed", "deleted", "painted", "moved", "placed", "added", "installed", "gone", "bigger", "smaller", "taller", "shorter", "larger", "higher", "twice", "half", "rotated", "turned", "swapped", "copied", "renamed", "called", "named",
    "closed", "shut", "open", "replace", "replaced", "repainted", "relocated", "scaled", "resized", "doubled", "halved", "facing", "face", "apiece", "each", "every", "both", "either", "side", "sides", "one", "ones", "another", "other", "others", "more", "fewer", "less", "same", "again", "also", "too", "as well",
    "would like", "would love a", "could use", "could do", "could we", "could i", "can we", "can i", "can you", "could you", "may i", "may we", "how about", "what about", "why not", "how many", "which", "what", "who", "where", "there", "here", "north", "south", "east", "west", "left", "right", "big", "small", "tall", "tiny",
    "huge", "metre", "metres", "meter", "meters", "m", "apart", "away", "out", "off", "in a row", "rain", "snow", "fog", "night", "evening", "morning", "noon", "dark", "wooden", "made", "with", "called", "swap", "take", "get", "give", "make", "use", "want", "looking", "standing", "sitting", "parked", "locked", "unlocked",
    "colour", "color", "coloured", "colored", "undo", "back", "then", "next", "first one", "last", "second", "third", "four", "two", "three", "five", "ten", "several", "few", "some", "any", "all", "none", "keep"]);
/// Words that go on with what was said, and begin nothing of its own.
#[rustfmt::skip]
const GOES_ON: &Phrases = &Phrases::of(&["and", "or", "of", "in", "on", "at", "by", "to", "near", "behind", "between", "beside", "under", "over", "along", "across", "around", "from", "into", "onto", "towards", "toward", "inside", "outside", "than", "that", "who", "whose", "it", "them", "him", "her", "its"]);
/// "It's Sports Day!" begins like that, and is none.
const IT_IS: &Phrases = &Phrases::of(&[
    "its", "it is", "thats", "that is", "this is", "theyre", "they", "that was", "it was", "it will", "itll",
]);

impl Reader<'_> {
    /// Whether some words between marks, behind a request, say nothing by which the scene could be otherwise.
    pub(super) fn is_idle(&self, from: usize, end: usize) -> bool {
        let is_apart = from > 0
            && is_mark(&self.lexemes[from - 1])
            && self.lexemes.get(end).is_none_or(is_mark)
            && from < end;
        if !is_apart {
            return false;
        }
        let words = &self.lexemes[from..end];
        let goes_on = longest_phrase(words, GOES_ON).is_some() && longest_phrase(words, IT_IS).is_none();
        let demands = |at: usize| {
            let rest = &self.lexemes[at..end];
            longest_phrase(rest, DEMANDS).is_some()
                || longest(rest, PAINTS).is_some()
                || super::super::numbers::number(rest).is_some()
                || super::super::lexicon::category(rest).is_some()
        };
        !goes_on
            && longest(words, &VERBS).is_none()
            && !(from..end).any(demands)
            && !(from..end).any(|at| self.is_place(at))
            && self.spoken_of(from, end).is_empty()
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    [DEMANDS, GOES_ON, IT_IS].into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}
