//! "The shop that sells bread and cake", "the store that has coffee as well as newspapers": the only one that sells both.

use simworld_core::id::EntityId;

use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::longest_phrase;
use super::super::names::Names;
use super::super::phrases::Phrases;
use super::forms::word;

#[rustfmt::skip]
const PLACES: &[&str] = &["building", "shop", "store", "house", "place", "one", "stand", "stall", "kiosk", "spot", "booth", "counter", "joint", "outlet", "business", "establishment"];
#[rustfmt::skip]
const SELLS: &Phrases = &Phrases::of(&["that sells", "which sells", "that sells both", "which sells both", "selling", "selling both", "that offers", "which offers", "that serves", "which serves",
    "that has", "which has", "that has both", "which has both", "that offers both", "which offers both", "that serves both", "which serves both", "offering", "offering both", "serving", "serving both", "that stocks", "which stocks", "stocking", "that carries", "which carries", "carrying", "that keeps", "which keeps",
    "that does", "which does", "that makes", "which makes", "that bakes", "which bakes", "with", "with both", "that deals in", "which deals in", "dealing in", "where they sell", "where they have", "where they serve", "where they offer", "where they make", "where they bake", "where you get", "where you can get",
    "where you buy", "where you can buy", "where you find", "where you can find", "where one gets", "where one can get", "where one buys", "where one can buy", "where i get", "where i can get", "where i buy", "where i can buy", "where we get", "where we can get", "where we buy", "where we can buy",
    "where people buy", "where people can buy", "where people get", "where people can get", "where there is", "where theres", "where there are"]);
/// Between the two.
const AND: &Phrases = &Phrases::of(&[
    "and",
    "and also",
    "as well as",
    "and even",
    "plus",
    "along with",
    "together with",
    "and some",
]);
/// Before the first of what is sold.
const ARTICLES: &[&str] = &["a", "an", "some", "the", "fresh", "good", "both"];
/// Before the second: "the shop with bread and a cake" may ask for a cake.
const MORE: &[&str] = &["some", "fresh", "good"];

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
    if !is_place {
        return None;
    }
    let (first, and) = goods_at(lexemes, from, ARTICLES, names)?;
    let next = and + longest_phrase(lexemes.get(and..)?, AND)?;
    let (second, end) = goods_at(lexemes, next, MORE, names)?;
    let sellers = names.sellers(&second);
    let both: Vec<EntityId> = names.sellers(&first).into_iter().filter(|id| sellers.contains(id)).collect();
    match both[..] {
        [one] => Some((end, one)),
        _ => None,
    }
}

/// What is sold and named from a word on, with or without an article, and where its name ends.
fn goods_at(lexemes: &[Lexeme], at: usize, articles: &[&str], names: &Names<'_>) -> Option<(String, usize)> {
    let from = at + longest_phrase(lexemes.get(at..)?, articles).unwrap_or(0);
    let (goods, words) = names.goods(lexemes.get(from..)?)?;
    Some((goods, from + words))
}
