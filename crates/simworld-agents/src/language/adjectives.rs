//! What is said of a thing that nothing in the scene can prove: "the heavy crate", "that big old oak".
//!
//! Sizes, colours and what doors and seats are (`modifiers`) are judged; what a thing is made of is part of what it is called (`sorts`).
//! The words here are an opinion, or tell of what no scene holds: age, dirt, wetness, worth. They are passed over where nothing is found
//! with them and the noun alone is.

use simworld_core::scene::EntityKind;
use simworld_core::seam::PlanError;

use super::clause::{Reference, Target};
use super::lexer::{Lexeme, Token};
use super::lexicon::{category, fits, longest_phrase};
use super::parser::Parser;
use super::phrases::Phrases;

/// Words for what nobody can prove here.
#[rustfmt::skip]
const UNPROVEN: &Phrases = &Phrases::of(&[
    "heavy", "lightweight", "weighty", "hefty", "bulky", "cumbersome", "unwieldy", "fragile", "delicate", "breakable", "flimsy", "sturdy",
    "precious", "valuable", "expensive", "costly", "priceless", "worthless", "useless", "important", "mysterious", "beautiful", "gorgeous",
    "stunning", "splendid", "magnificent", "adorable", "charming", "handsome", "elegant", "fancy", "posh", "impressive", "amazing",
    "fantastic", "wonderful", "famous", "popular", "beloved", "trusty", "favourite", "favorite", "ugly", "hideous", "horrible", "awful",
    "ghastly", "dreadful", "terrible", "silly", "stupid", "ridiculous", "funny", "odd", "weird", "strange", "boring", "dull", "dirty",
    "filthy", "grubby", "dusty", "muddy", "grimy", "messy", "smelly", "stinky", "spotless", "shiny", "sparkling", "gleaming", "wet",
    "damp", "soaked", "soggy", "dripping", "dry", "icy", "frozen", "sticky", "slippery", "full", "overflowing", "old", "ancient",
    "antique", "vintage", "aged", "new", "shabby", "battered", "worn", "scruffy", "rickety", "wobbly", "creaky", "rusty", "squeaky",
    "comfortable", "comfy", "cosy", "cozy", "darned", "damned", "blasted", "wretched", "pesky",
]);

impl Parser<'_> {
    /// A noun, whatever is said of it. What is called so with all its words is meant before what is called so without some of them.
    pub(super) fn noun_however_described(&mut self, reference: &mut Reference) -> Result<Target, PlanError> {
        let start = self.at;
        let refused = match self.sort_or_noun(reference) {
            Ok(target) => return Ok(target),
            Err(refused) => refused,
        };
        let (left, as_said) = (std::mem::replace(&mut self.at, start), reference.clone());
        // "What a lovely old bench" is talk; and where a scene is edited a new thing is none that is there.
        let may_be_passed = !reference.indefinite && self.view.streets.is_none();
        if may_be_passed
            && self.pass_unproven(reference)
            && let Ok(target) = self.sort_or_noun(reference)
        {
            return Ok(target);
        }
        self.at = left;
        *reference = as_said;
        Err(refused)
    }

    /// Passes words that prove nothing, with what is said among them that does; whether there were any and a known noun follows.
    fn pass_unproven(&mut self, reference: &mut Reference) -> bool {
        let start = self.at;
        while let Some(words) = longest_phrase(self.rest(), UNPROVEN) {
            self.at += words;
            // "The heavy, dusty crate", "the old and shabby chair".
            let joins = matches!(self.rest().first(), Some(Lexeme { token: Token::Comma, .. }))
                || fits(self.rest(), "and").is_some();
            if joins && longest_phrase(&self.rest()[1..], UNPROVEN).is_some() {
                self.at += 1;
            }
            self.modifiers(reference);
        }
        let rest = self.rest();
        self.at > start
            && (category(rest).is_some()
                || self.names.exact(rest).is_some()
                || self.names.sort_of_asset(rest).is_some())
    }

    /// "The light suitcase", which is no lamp's and no signal's: nobody has weighed it.
    pub(super) fn weighs_little(&self) -> Option<usize> {
        let words = fits(self.rest(), "light").filter(|_| self.view.streets.is_none())?;
        let is_carried = |kind: &EntityKind| matches!(kind, EntityKind::Parcel | EntityKind::Chair);
        let (class, _) = category(&self.rest()[words..])?;
        (!class.kinds().is_empty() && class.kinds().iter().all(is_carried)).then_some(words)
    }
}
