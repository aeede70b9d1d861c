//! "The shop that sells bread and cake": the only one that sells both.

use simworld_core::id::EntityId;

use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::longest_phrase;
use super::super::names::Names;
use super::super::phrases::Phrases;
use super::forms::word;

const PLACES: &[&str] = &["building", "shop", "store", "house", "place", "one", "stand", "stall", "kiosk"];
#[rustfmt::skip]
const SELLS: &Phrases = &Phrases::of(&["that sells", "which sells", "that sells both", "which sells both", "selling", "selling both", "that offers", "which offers", "that serves", "which serves"]);

/// Puts the thing itself in the place of the words, where only one sells both.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    let found = (2..lexemes.len()).find_map(|at| Some((at, seller_of_both(lexemes, at, names)?)));
    let Some((at, (end, id))) = found else { return };
    let seller = Lexeme { token: Token::Id(id), lemma: None, ..lexemes[at].clone() };
    lexemes.splice(at - 2..end, [seller]);
}

/// Where the words end that begin with "that sells", and who is meant by them.
fn seller_of_both(lexemes: &[Lexeme], at: usize, names: &Names<'_>) -> Option<(usize, EntityId)> {
    let from = at + longest_phrase(&lexemes[at..], SELLS)?;
    let is_place = PLACES.contains(&word(lexemes, at - 1))
        && matches!(word(lexemes, at - 2), "the" | "that" | "this" | "our");
    let (first, words) = names.goods(lexemes.get(from..)?).filter(|_| is_place)?;
    let and = from + words;
    if word(lexemes, and) != "and" {
        return None;
    }
    let (second, words) = names.goods(lexemes.get(and + 1..)?)?;
    let sellers = names.sellers(&second);
    let both: Vec<EntityId> = names.sellers(&first).into_iter().filter(|id| sellers.contains(id)).collect();
    match both[..] {
        [one] => Some((and + 1 + words, one)),
        _ => None,
    }
}
