//! Which of several by its place among them: "the second from the left", "the one in the middle", "the bench in the east".

use super::clause::{Choice, Reference, Side};
use super::lexicon::{longest, longest_phrase};
use super::parser::Parser;
use super::phrases::Phrases;

/// From where one counts.
pub(super) const COUNTED: &Phrases = &Phrases::of(&[
    "counting from here",
    "counted from here",
    "counting from you",
    "counting from where you are",
    "as seen from here",
    "seen from here",
    "from where you are",
    "from where you stand",
    "in the row",
    "in that row",
    "in line",
    "in the line",
]);
/// From which end of a row one counts.
const FROM_AN_END: &[(&[&str], Side)] = &[
    (&["from the left", "from the left hand side", "from the left end", "from left"], Side::Left),
    (&["from the right", "from the right hand side", "from the right end", "from right"], Side::Right),
];
/// The middle one of three.
#[rustfmt::skip]
const AMONG: &Phrases = &Phrases::of(&[
    "between the other two", "between the others", "between the two others", "in between the other two",
    "in between the others", "with one on either side", "with one on each side",
]);

impl Parser<'_> {
    /// "... in the east", "... in the middle", "... of all".
    pub(super) fn place_in_row(&mut self, reference: &mut Reference) -> bool {
        if let Choice::Nth(nth) = reference.choice
            && let Some((side, words)) = longest(self.rest(), FROM_AN_END)
        {
            self.at += words;
            (reference.choice, reference.place) = (Choice::Side(side), nth);
            return true;
        }
        if let Choice::Nth(nth) = reference.choice
            && let Some(compass) = self.end_by_the_compass()
        {
            (reference.choice, reference.place) = (Choice::Compass(compass), nth);
            return true;
        }
        if reference.choice == Choice::Open
            && let Some(compass) = self.in_the_compass()
        {
            reference.choice = Choice::Compass(compass);
            return true;
        }
        if self.eat_any(AMONG) {
            reference.choose(Choice::Middle);
            return true;
        }
        let middle = longest_phrase(self.rest(), &["in the middle", "in the centre", "in the center"]);
        if let Some(words) = middle
            && longest_phrase(&self.rest()[words..], &["of", "between"]).is_none()
        {
            self.at += words;
            reference.choose(Choice::Middle);
            return true;
        }
        if reference.choice != Choice::Open
            && self.eat_any(&["of all", "of them all", "of the lot", "of them", "of all of them"])
        {
            return true;
        }
        let here = self.at;
        if reference.choice != Choice::Open && self.eat_any(&["around here", "around", "about", "in sight"]) {
            if self.ends_clause() {
                return true;
            }
            self.at = here;
        }
        let than = self.comparison();
        reference.traits.than = than.or(reference.traits.than);
        than.is_some()
    }
}
