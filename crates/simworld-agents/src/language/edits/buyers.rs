//! Where somebody buys something, whoever that is: "the place where students buy their soup", "where the locals usually get their bread".

use super::super::lexer::Lexeme;
use super::super::lexicon::longest_phrase;
use super::super::phrases::Phrases;
use super::forms::word;

/// Before who buys.
const OURS: &Phrases =
    &Phrases::of(&["the", "all the", "all", "our", "my", "these", "most", "many", "some", "other"]);
#[rustfmt::skip]
const WHO: &[&str] = &["students", "people", "folks", "folk", "locals", "townspeople", "townsfolk", "residents", "neighbours", "neighbors", "tourists", "visitors", "guests", "customers", "shoppers", "kids", "children", "pupils", "workers", "commuters", "professors", "lecturers", "teachers", "nurses", "doctors", "patients", "sailors", "fishermen", "drivers", "passengers", "parents", "pensioners", "everyone", "everybody", "they", "you", "we", "i", "one", "readers", "colleagues", "staff"];
/// How often, and that they can.
const OFTEN: &Phrases = &Phrases::of(&[
    "can",
    "could",
    "may",
    "usually",
    "always",
    "often",
    "all",
    "like to",
    "love to",
    "go to",
    "come to",
    "queue to",
    "line up to",
    "tend to",
    "go and",
]);
#[rustfmt::skip]
const BUY: &Phrases = &Phrases::of(&["buy", "buys", "get", "gets", "fetch", "fetches", "purchase", "order", "orders", "eat", "eats", "drink", "drinks", "have", "has", "pick up", "picks up", "grab", "grabs", "find", "finds", "queue for", "line up for"]);

/// How many words say so, up to what is bought.
pub(super) fn where_they_buy(lexemes: &[Lexeme]) -> Option<usize> {
    let ours = usize::from(word(lexemes, 0) == "where");
    let who = ours + longest_phrase(lexemes.get(ours..)?, OURS).unwrap_or(0);
    let often = who + 1;
    let buy = often + longest_phrase(lexemes.get(often..)?, OFTEN).unwrap_or(0);
    let bought = buy + longest_phrase(lexemes.get(buy..)?, BUY)?;
    (ours == 1 && WHO.contains(&word(lexemes, who))).then_some(bought)
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::lex;
    use super::where_they_buy;

    #[test]
    fn whoever_buys_there() {
        let words = |said: &str| where_they_buy(&lex(said));
        assert_eq!(words("where students buy their soup"), Some(3));
        assert_eq!(words("where all the locals usually get bread"), Some(6));
        assert_eq!(words("where students sit"), None);
        assert_eq!(words("students buy soup"), None);
    }
}
