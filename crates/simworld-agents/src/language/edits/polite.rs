//! What joins wishes, and what is put before and behind them and says nothing.
use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::longest_phrase;
use super::super::phrases::Phrases;

/// What joins two wishes.
#[rustfmt::skip]
pub(super) const JOINTS: &Phrases = &Phrases::of(&["and", "then", "and then", "also", "plus", "but", "and also", "as well as",
    "after that", "next", "finally", "too", "as well", "while you are at it", "now", "along with", "together with",
    "and finally", "afterwards", "first", "so", "or rather", "with"]);
/// What is put before and behind wishes, and says nothing.
#[rustfmt::skip]
pub(super) const POLITE: &Phrases = &Phrases::of(&["please", "thanks", "thanks a lot", "thanks a bunch", "thanks so much", "thank you", "thank you so much", "thank you very much", "kindly", "hey", "hi", "hello", "ok", "okay", "alright",
    "um", "well", "could you", "can you", "would you", "will you", "can u", "could u", "i want you to",
    "i would like you to", "id like you to", "you should", "you must", "lets", "let us", "just", "try to",
    "go ahead and", "would you mind", "do you mind", "if you can", "if you could", "if possible",
    "if you dont mind", "for me", "for us", "quickly", "simply", "maybe", "perhaps", "would you please",
    "could you please", "can you please", "will you please", "yo", "dude", "bro", "mate", "pls", "plz",
    "i think you should", "i want to", "i would like to", "id like to", "i need to", "we need to", "we should",
    "we want to", "help me", "be so kind as to", "be so kind and", "why dont you", "how about you",
    "be so good as to", "i think", "actually", "really", "also", "again", "to", "cheers", "i dont care where",
    "i dont mind where", "thx", "there", "buddy", "guys", "everyone", "do me a favour and", "do me a favor and",
    "i ask you to", "need you to", "i need you to", "oh", "oh and", "hmm", "so", "can we", "could we",
    "may i ask you to", "it would be nice to", "it would be great to", "it would be nice if you could",
    "id be grateful if you could", "would it be possible to", "is it possible to", "might you",
    "i reckon we should", "you need to", "you have to", "you can", "you could", "go and", "go", "instead", "now",
    "kindly please", "sir", "as well", "too", "i wonder if you could", "would you be kind enough to", "could you be kind enough to", "be kind enough to", "would you be so kind as to", "could you be so kind as to", "would you be so good as to", "would you be so kind and", "might i ask you to", "might i trouble you to", "could i trouble you to", "could i ask you to", "i wonder whether you could", "i was wondering if you could", "i was wondering whether you could", "i was wondering if we could", "i was wondering if you might", "i wanted to ask if you could", "i wanted to ask whether you could", "i wanted to ask you to", "it is time to", "its time to", "time to",
    "how about", "what about", "what if we", "shall we", "anymore", "any more", "any longer", "at all",
    "i want that", "i would like that", "i wish that", "like", "kind of", "sort of"]);
/// What is put behind wishes, and says nothing.
#[rustfmt::skip]
pub(super) const CODA: &Phrases = &Phrases::of(&["please", "thanks", "thank you", "for me", "for us", "if you can", "if you could",
    "if possible", "if you dont mind", "pls", "plz", "now", "instead", "too", "as well", "anymore", "any more",
    "any longer", "at all", "i dont care where", "i dont mind where", "cheers", "thx", "okay", "ok", "mate",
    "buddy", "bro", "dude", "sir", "quickly", "again", "would you", "will you", "could you", "can you",
    "if you would", "if you will", "thanks a lot", "if its not too much trouble", "if it is not too much trouble",
    "right now", "right away", "immediately", "asap", "thank you very much", "thanks in advance", "if its possible",
    "if it is possible", "kindly", "also", "my friend", "when you can", "when you have time",
    "from the scene", "from the map", "from the world", "from the city", "from the campus", "from town", "from the harbour", "from here",
    "if you would be so kind", "for good", "for now", "from now on", "as soon as possible", "whenever you can", "this time",
    "today", "right there", "once and for all", "for once", "would you please", "for heavens sake", "for gods sake", "ya", "no", "eh", "huh",
    "right", "yeah", "man", "thank you so much", "many thanks", "much appreciated", "ta", "at once", "quick", "i guess", "i think", "i suppose", "dear",
    "if thats ok", "if that is ok", "if thats okay", "if thats possible", "if that is possible", "if theres room", "if there is room", "if there is space",
    "no exceptions", "to sit on", "to sit in", "to rest on", "to lean on", "to drink", "to eat", "to read", "to play with", "to sit down on", "to enjoy", "one by one", "do it", "try it", "see to it", "if that can be done", "can do", "will you no", "ta", "the sun you know", "as far as it goes", "and thats that", "and be done with it", "thats all", "that is all",
    "nothing else", "and nothing else", "if you can manage that", "if you can manage it", "if you can manage", "if that works", "if that is all right", "my dear", "love", "lass", "laddie", "my lad", "son", "pal", "chum", "obviously",
    "of course", "naturally", "if it pleases you", "if it please you", "on the double", "chop chop", "pronto", "hurry", "quick quick", "over", "together", "forever", "for everyone", "for everybody", "for all to see", "at least",
    "at any rate", "in any case", "if any", "for the moment", "for the time being", "for a change", "thats it", "that is it", "it would be lovely", "it would be nice", "would be nice", "that would be nice", "that would be lovely",
    "i beg you", "i implore you", "by all means", "if that is fine", "if thats fine", "if its fine", "if you agree", "and that is all", "and thats all", "easy", "simple", "yes", "ok then", "okay then", "alright", "all right", "so be it",
    "if you like", "if you please", "if you want", "somehow", "lol", "already", "first", "next", "or so", "or something", "or whatever", "you know", "not where it is now", "not where it is", "and not where it is now", "and not where it is", "not there", "wouldnt you say", "dont you agree", "if it isnt too much to ask",
    "if it is not too much to ask", "if thats not too much to ask", "whenever you get a chance", "when you get a chance", "when you get a moment", "when you have a moment", "when you have a minute", "when you get a minute", "if you get a chance",
    "if you get the chance", "will ya", "wont you", "cant you", "be a dear", "there is a dear", "theres a dear", "theres a good lad", "there is a good lad", "if you wouldnt mind", "if you would not mind", "if its no bother", "if it is no bother",
    "if its no trouble", "if it is no trouble", "would be lovely", "would be great", "would be fab", "would be perfect", "would be ideal", "would do", "would do nicely", "would do the trick", "will do", "will do nicely", "will do the trick", "that would be great", "that would be perfect",
    "that would be ace", "that would help", "that would do", "thatd be great", "thatd be lovely", "thatd be nice", "that should do it", "that should do", "that will do", "thatll do", "to make it nicer", "to make it prettier", "to brighten things up",
    "to liven things up", "to liven it up", "to cheer things up", "to brighten it up", "to spruce things up", "to spruce it up", "to cheer it up", "to make it cosier", "just because", "for fun", "for good measure", "for starters", "for a laugh",
    "for later", "for tonight", "for tomorrow", "for the weekend", "for the kids", "for the children", "for the visitors", "for visitors", "for the guests", "for the tourists", "for the customers", "for the party", "for the wedding", "for the show",
    "for the photo", "for the parade", "for the market", "for the festival", "for the students", "for people", "for the people", "for passers by", "for everyone to see", "for everyone to use", "for everyone to enjoy", "straight away", "this instant", "sharpish", "okey dokey", "dont you think", "do you not think", "dont you think so", "wouldnt you agree", "not where he is", "not where he is now", "not where she is", "not where she is now", "not where they are", "not where they are now", "not over there", "kthx",
    "thank u", "thankyou", "thanx", "cheers then", "appreciate it", "id appreciate it", "i would appreciate it", "if you could please", "god bless", "bless you", "amen", "there you go", "there we go", "and that is that", "i beg of you", "pretty please", "with a cherry on top", "not on the ground", "and not on the ground", "not on the floor", "not more", "no more than that", "no more no less", "not more than that", "and not more", "and no more", "why not", "just in case", "my friend", "thank you my friend", "thanks my friend", "would you please", "would you mind", "if thats okay with you", "if that is ok with you", "if thats ok with you"]);

/// "Too" before a word of which there is too much.
fn is_too_much(lexemes: &[Lexeme]) -> bool {
    const GOES_ON: &Phrases = &Phrases::of(&[
        "and", "please", "then", "thanks", "but", "plus", "also", "thank", "with", "put", "add", "paint",
        "move", "remove", "make",
    ]);
    longest_phrase(lexemes, &["too"]).is_some()
        && matches!(lexemes.get(1).map(|next| &next.token), Some(Token::Word(word)) if !GOES_ON.contains(word))
}

/// Every word that joins wishes or is polite, so that none is taken for a misspelling.
pub(super) fn small_words() -> impl Iterator<Item = &'static str> {
    JOINTS.iter().chain(POLITE).chain(CODA).flat_map(|phrase| phrase.split(' '))
}

/// How many words at the start join two things or wishes.
pub(super) fn joint(lexemes: &[Lexeme]) -> Option<usize> {
    match lexemes.first().map(|lexeme| &lexeme.token) {
        Some(Token::Comma | Token::Break) => Some(1),
        // "Next to the Campus Clinic" is no joint and something on the campus.
        _ if longest_phrase(lexemes, &["first aid", "next to"]).is_some() => None,
        // "Too bright" is no joint and something bright.
        _ if is_too_much(lexemes) => None,
        _ => longest_phrase(lexemes, JOINTS),
    }
}
