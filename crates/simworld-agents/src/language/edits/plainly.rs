//! A sentence in plainer words, before it is read: one module after the other says its own turns of phrase plainly, and leaves out what asks for nothing.

use super::super::lexer::Lexeme;
use super::super::names::Names;
use super::super::streets::StreetNames;
use super::{
    beforehand, breaks, but_me, casual, doings, doubted, facing, headings, hesitations, homophones,
    kin_first, margins, meant, narrowed, others, passing, periphrases, phrased, plain, precautions, presence,
    remarked, repairs, respelt, restated, retold, rows, sells_both, sky_come, sky_stated, slips, spared,
    spoken, talk, talked, unusual_first, which, whole, withdrawn, wording,
};
use crate::editing::Stock;

/// Puts the words of a sentence plainly, one thing at a time, before it is read.
pub(super) fn put_plainly(
    words: &str,
    lexemes: &mut Vec<Lexeme>,
    names: &Names<'_>,
    (stock, streets): (&Stock, &StreetNames),
) {
    precautions::leave_out(lexemes);
    kin_first::in_plain_words(words, lexemes, names);
    sky_come::in_plain_words(lexemes);
    sky_stated::in_plain_words(lexemes);
    talked::in_plain_words(lexemes);
    restated::put_plainly(lexemes);
    beforehand::leave_out(words, lexemes, names);
    unusual_first::in_plain_words(words, lexemes);
    headings::in_plain_words(words, lexemes, names);
    presence::in_plain_words(lexemes);
    meant::in_plain_words(lexemes);
    withdrawn::in_plain_words(lexemes);
    but_me::in_plain_words(lexemes);
    facing::in_plain_words(lexemes);
    margins::in_plain_words(lexemes);
    remarked::in_plain_words(lexemes);
    hesitations::in_plain_words(words, lexemes);
    breaks::in_plain_words(words, lexemes);
    wording::in_plain_words(words, lexemes);
    respelt::in_plain_spelling(words, lexemes);
    homophones::in_plain_spelling(words, lexemes);
    periphrases::in_plain_words(lexemes);
    talk::in_plain_words(words, lexemes, names);
    doubted::in_plain_words(lexemes);
    casual::in_plain_words(lexemes);
    retold::in_plain_words(lexemes);
    doings::in_plain_words(lexemes);
    slips::correct(words, lexemes, names, stock, streets);
    spared::in_plain_words(lexemes);
    sells_both::in_plain_words(lexemes, names);
    phrased::in_plain_words(words, lexemes, names);
    narrowed::in_plain_words(lexemes);
    plain::in_plain_words(words, lexemes, names);
    others::in_plain_words(lexemes);
    which::in_plain_words(lexemes);
    whole::in_plain_words(lexemes);
    passing::leave_out(lexemes);
    rows::on_both_sides(lexemes, streets);
    repairs::put_right(lexemes);
    spoken::name_streets(lexemes, streets);
}
