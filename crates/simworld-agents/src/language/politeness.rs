//! The words around orders: what joins them, politeness, hesitation and negation.

use std::sync::LazyLock;

use super::lexer::{Lexeme, Token, is_mark, word_of};
use super::phrases::{Index, Phrases};
use super::verbs::longest_verb;

fn index(phrases: &'static [&'static str]) -> Index<()> {
    Index::new(phrases.iter().map(|phrase| (*phrase, ())))
}

/// How many tokens of politeness begin here.
pub(super) fn filler(lexemes: &[Lexeme]) -> Option<usize> {
    static INDEX: LazyLock<Index<()>> = LazyLock::new(|| index(FILLERS));
    INDEX.longest(lexemes).map(|((), words)| words).filter(|words| !proceeds(lexemes, *words))
}

/// Whether so many words are "proceed to" before a place: "proceed to the exit" leads there, and "proceed to sit down" says no more than
/// "sit down".
fn proceeds(lexemes: &[Lexeme], words: usize) -> bool {
    let after = &lexemes[words..];
    let is_point = || {
        after.first().is_some_and(|first| word_of(first) == "point")
            && matches!(after.get(1), Some(Lexeme { token: Token::Open, .. }))
    };
    lexemes.first().is_some_and(|first| word_of(first) == "proceed")
        && (longest_verb(after).is_none() || is_point())
}

/// How many tokens join two orders here.
pub(super) fn joint(lexemes: &[Lexeme]) -> Option<usize> {
    static INDEX: LazyLock<Index<()>> = LazyLock::new(|| index(JOINTS));
    let words = INDEX.longest(lexemes).map(|((), words)| words)?;
    // "Third, go to ...", and "the third person".
    let counts = ["third", "fourth"].contains(&word_of(&lexemes[0]));
    let leads = || lexemes.get(words).is_some_and(is_mark) || longest_verb(&lexemes[words..]).is_some();
    (!counts || leads()).then_some(words)
}

/// Ways to join two orders.
#[rustfmt::skip]
pub(super) const JOINTS: &[&str] = &[
    "and", "then", "next", "after that", "afterwards", "finally", "also", "first", "lastly", "after this",
    "later", "second", "subsequently", "firstly", "secondly", "third", "thirdly", "fourth", "fourthly", "to begin with", "to start with", "at first",
    "in the end", "when you are done", "when youre done", "once youre done", "once you are there",
    "when you get there", "plus", "once you are done", "when youve done that", "once there", "followed by",
    "and than", "at last", "immediately", "first things first", "first of all", "firstly of all",
    "second of all", "from there", "from here", "when youre there", "once youre there", "when you are there",
    "when you arrive", "once you arrive", "once you get there", "when youre done there", "on arrival",
    "last of all", "at the end", "to finish", "to finish with", "in the meantime", "thereafter", "following that",
    "thereupon", "with that done", "that done", "this done", "straight after", "straight after that",
    "right after that", "soon after", "as a first step", "as a next step", "step one", "step two", "step three",
    "as soon as you have it", "as soon as youve got it", "once you have it", "once youve got it",
    "when you have it", "when youve got it", ">", "→", "only then", "and only then", "whereupon", "after which",
    "upon which", "at which point", "next up", "then finally", "and lastly", "once thats done",
    "once that is done", "when thats done", "when that is done", "after you have done that",
    "after youve done that", "having done that", "having done so", "once done", "when done", "on top of that",
    "in addition", "additionally", "as well as", "besides that", "step four", "step five", "number one",
    "number two", "number three", "fourth", "fourthly", "last but not least", "to end with", "to round off",
    "to round things off", "to top it off", "to cap it all", "once you have done that", "once youve done that",
    "in that order", "from now on", "as from now", "from there on", "there and then", "when thats over",
    "afterward", "later on", "a little later", "shortly after", "shortly afterwards", "next thing",
    "the next thing", "straight afterwards", "directly afterwards", "directly after that", "in closing",
    "as a last step", "as the last step", "as a final step", "in conclusion", "after doing so", "upon arrival",
    "on arriving", "once you arrive there", "when you arrive there", "when youve arrived", "once youve arrived",
    "having arrived", "having got there", "when you have arrived", "once youre done there",
    "when youre done with that", "when that happens", "done", "when finished", "once finished",
    "once youre finished", "when youre finished", "and from there", "and also", "and not before", "not before", "and not earlier", "not earlier", "and no sooner", "and not a moment before", "and not sooner", "after it",
    "first thing", "from here on", "from here on in", "from now on in", "and after youve done that",
    "and after you have done that", "and once thats done",
];

/// Politeness around an order.
#[rustfmt::skip]
pub(super) const FILLERS: &[&str] = &[
    "please", "but", "kindly", "could you", "can you", "would you", "will you", "might you", "may you",
    "i want you to", "i would like you to", "id like you to", "i need you to", "you should", "you must",
    "you have to", "you need to", "you can", "you may", "you could", "you will", "try to", "lets", "let us",
    "just", "now", "hey", "hey there", "hi", "hello", "hello there", "ok", "okay", "thanks", "thank you",
    "for me", "for us", "so", "good morning", "good evening", "good afternoon", "good day", "thanks a lot",
    "thank you very much", "thank you so much", "many thanks", "cheers", "be so kind as to", "be so good as to",
    "be kind enough to", "be a dear and", "would you mind", "do you mind", "i was wondering if you could",
    "i wonder if you could", "i wonder whether you could", "it would be great if you could",
    "it would be nice if you could", "would it be possible to", "would it be possible for you to",
    "is it possible to", "why dont you", "how about you", "do me a favour and", "do me a favor and",
    "feel free to", "your task is to", "your job is to", "your mission is to", "your goal is to",
    "the task is to", "sorry to bother you", "excuse me", "pardon me", "if you like", "if you dont mind",
    "if possible", "if you please", "if its possible", "when you can", "when you have time",
    "when you have a moment", "whenever you are ready", "right away", "right now", "at once", "straight away",
    "as soon as possible", "asap", "a lot", "very much", "pretty please", "pretty", "dear robot", "dear",
    "robot", "alright", "all right", "well", "right then", "go and", "come and", "go ahead and", "yeah", "yes",
    "sure", "buddy", "mate", "friend", "my friend", "sir", "madam", "be sure to", "make sure to",
    "make sure you", "remember to", "dont forget to", "you", "quickly", "carefully", "quietly", "calmly",
    "slowly", "gently", "simply", "maybe", "perhaps", "possibly", "immediately", "again", "we should",
    "i want to see you", "it is time to", "its time to", "time to", "start to", "begin to", "start", "begin",
    "would you kindly", "i would appreciate it if you could", "i would appreciate if you could", "i ask you to",
    "im asking you to", "can i ask you to", "could i ask you to", "may i ask you to", "the next thing is to",
    "after all", "there", "instead", "please to",
    "you alone", "you there", "young man", "young lady", "if any", "if need be", "from the top", "in this shot", "you shall", "you are hereby asked to", "on my mark", "heads up", "in the first place", "kindly do",
    "straight off", "for goodness sake", "for heavens sake", "for crying out loud", "no buts", "once you feel ready",
    "whatever happens", "in any case", "at any rate", "rain or shine", "rain or no rain", "nevertheless", "by the by",
    "as a matter of fact", "in fact", "if you ask me", "i tell you", "i repeat", "this time", "your turn", "your go",
    "would you be so good as to", "would you be so kind as to", "if you would",
    "if you wouldnt mind", "over there", "i think you should", "i suggest you", "im begging you", "somewhere",
    "anywhere", "i want to", "i would like to", "id like to", "i need to", "im going to", "oh", "ah", "ahem",
    "hmm", "erm", "uh", "um", "er", "good boy", "good girl", "good dog", "good lad", "boy", "girl", "lad",
    "pup", "doggy", "here boy", "here girl", "here", "come on", "come on then", "go on", "go on then",
    "theres a good boy", "theres a good girl", "theres a good dog", "thats a good boy", "thats a good dog",
    "attaboy", "driver", "listen", "look here", "only", "ladies and gentlemen", "yo", "okey dokey", "great",
    "perfect", "fine", "nice", "good", "good job", "start by", "begin by", "finish by", "end by",
    "thanks in advance for", "thank you in advance for", "thanks for", "thank you for", "well done", "love",
    "darling", "sweetheart", "pal", "dude", "bro", "man", "my dear", "my good man", "if you wish",
    "if you want", "whenever you like", "when ready", "please and thank you", "straightaway", "instantly",
    "promptly", "without delay", "this instant", "this minute", "too", "as well", "together with me",
    "be a pal and", "be a love and", "be an angel and", "be a darling and", "be a sweetheart and",
    "be a good sport and", "be a friend and", "be nice and", "youre to", "you are to", "what do you say we",
    "lets have you", "lets see you", "when you get a chance", "when you get the chance",
    "when you get a moment", "when you get a minute", "when youve got a moment", "when youve got a minute",
    "when youve got time", "when you have a minute", "when you have a second", "when you have the time",
    "whenever you can", "whenever you have time", "as soon as you can", "when convenient", "like",
    "gimme a hand and", "give me a hand and", "lend me a hand and", "real quick", "real fast", "plz", "pls",
    "thx", "ta", "chop chop", "pronto", "at the double if you please", "be quick", "be quick about it",
    "make it quick", "quick", "quick march", "quick as you can", "double quick", "lively now", "look lively",
    "look sharp", "off you go then", "hop to it", "go go go", "there we go", "there you go", "here we go",
    "come along now", "come on now", "if you would be so kind", "would you please", "will you please",
    "could you please", "can you please", "theres a dear", "theres a love", "theres a pal",
    "theres a good chap", "theres a good fellow", "theres a good sport", "theres a good lad",
    "theres a good lass", "theres a pet", "be a dear", "be a good chap and", "be a good fellow and",
    "be a star and", "be a hero and", "be a treasure and", "be a good egg and", "be a sport and",
    "be a lamb and", "be a good boy and", "be a good girl and", "be a good dog and", "be so nice as to",
    "be so nice and", "be so kind and", "be so good and", "please be so kind and", "friendly robot",
    "little robot", "my robot", "my good robot", "dear friend", "my dear friend", "my dear robot", "old chap",
    "old boy", "old man", "old friend", "old pal", "my lad", "my boy", "my love", "my darling", "folks", "guys",
    "honey", "sweetie", "champ", "chief", "boss", "captain", "comrade", "fella", "fellow", "pardon", "sorry",
    "i beg your pardon", "beg pardon", "ever so kindly", "if i might ask", "if i may ask", "may i ask", "may i",
    "might i", "as quick as a flash", "right then so", "well then", "well now", "now then", "so then", "ok so",
    "okay so", "ok then", "okay then", "anyway", "anyhow", "as i said", "like i said", "as discussed",
    "for a change", "once again", "one more time please", "thank you kindly", "thanks ever so much",
    "thanks so much", "thanks very much", "thanks mate", "thanks a million", "thanks a bunch", "thanks awfully",
    "much obliged", "much appreciated", "if its not too much trouble", "if it isnt too much trouble",
    "if its no trouble", "if its no bother", "if its not too much bother", "if it is not too much bother",
    "if it isnt too much bother", "if its not too much to ask", "if thats ok", "if thats okay",
    "if thats all right", "if thats alright", "if that works for you", "if it suits you", "if its convenient",
    "if youre free", "if you are free", "if you have a moment", "if you have a minute", "if you have a second",
    "if you have time", "if youve got a moment", "if youve got a minute", "if youve got a second",
    "if youve got time", "if you get the chance", "if you get a chance", "if you fancy it", "when youre ready",
    "when you are ready", "whenever youre ready", "when you feel like it", "when its convenient",
    "at your convenience", "at your earliest convenience", "actually", "really", "honestly", "basically",
    "obviously", "of course", "naturally", "certainly", "definitely", "absolutely", "by all means",
    "kindly please", "your next task is to", "your first task is to", "your next job is to", "your order is to",
    "your orders are to", "your assignment is to", "the job is to", "the plan is to", "the idea is to",
    "the goal is to", "the mission is to", "what i want is for you to", "what id like is for you to",
    "all you have to do is", "all you need to do is", "what you have to do is", "what you need to do is",
    "what you should do is", "i order you to", "i command you to", "i beg you to", "i implore you to",
    "i urge you to", "i expect you to", "i request that you", "i request you to", "id prefer you to",
    "id prefer that you", "id rather you", "id rather that you", "ill have you", "i say", "hear me", "hear ye",
    "attention", "attention please", "hello robot", "hey robot", "hi robot", "hi there", "howdy", "greetings",
    "good afternoon robot", "salutations", "see if you can", "see whether you can", "see to it that you",
    "be certain to", "be careful to", "do please", "please do", "do kindly", "be prepared to", "get ready to",
    "prepare to", "proceed to", "feel welcome to", "have the goodness to", "have the kindness to",
    "have the courtesy to", "do me the favour and", "do me the favor and", "do me the kindness and",
    "do us a favour and", "do us a favor and", "do me a solid and", "do me a good turn and", "do me a favour",
    "do me a favor", "do us a favour", "mind you", "you know what", "guess what", "tell you what",
    "i tell you what", "let me see", "let me think", "how about we", "what if you", "what if we", "shall we",
    "why not", "why dont we", "can we", "could we", "may we", "on the double please", "as i was saying",
    "have a go at", "have a crack at", "have a shot at", "have a stab at", "have a try at", "take a crack at",
    "merrily", "happily", "cheerfully", "politely", "nicely", "kindly now", "softly", "silently", "smoothly",
    "properly", "neatly", "safely", "promptly please", "presently", "forthwith", "momentarily", "meanwhile",
    "in the meanwhile", "for a start", "for starters", "there is a dear", "there is a good lad",
    "there is a good chap", "ok robot", "and action", "lights camera action", "ready steady", "ready set",
    "on your marks", "ready", "here goes", "listen up", "oi", "ahoy", "aye", "roger", "would you mind terribly",
    "would you mind awfully", "chop", "right so", "if its not out of your way", "if it isnt out of your way",
    "if its not far out of your way", "if thats not out of your way", "id love to", "i would love to",
    "i wish to", "i have to", "ive got to", "i must", "we need to", "we have to", "we want to", "we must",
    "wed like to", "we would like to", "if it is possible", "if it is not too much trouble",
    "if it is no trouble", "if it is no bother", "if it is not too much to ask", "if that is ok",
    "if that is okay", "if that is all right", "if that is alright", "if it is convenient",
    "as you can", "as possible", "as you can get", "by noon", "by tonight", "by lunchtime", "by midday", "before lunch", "before dinner", "in time", "if it is not a bother", "if it is no bother at all", "if its not a bother", "sorry to bug you", "sorry to trouble you", "sorry to interrupt", "sorry to disturb you", "sorry for bothering you", "be quiet and", "be silent and", "keep quiet and", "stay calm and", "relax and", "calm down and", "be patient and", "be good and", "be careful and", "keep calm and", "dont worry and", "stay quiet and", "be brave and", "on foot", "by foot", "while youre at it", "while you are at it", "while youre there", "while you are there", "while youre about it",
    "while you are about it", "while youre up", "while you are up", "while im at it", "while were at it", "while we are at it", "today", "tonight", "this morning",
    "this afternoon", "this evening", "later today", "when you get round to it", "when you get around to it", "when its your turn", "when it is your turn", "say nothing", "saying nothing", "say not a word", "dont say a word", "without a word", "not a word",
    "and hurry", "and hurry up", "and be quick", "and be quick about it", "by any chance", "would you like to", "would you care to", "would you love to", "quick question",
    "when it suits you", "whenever it suits you", "if it suits you", "can i ask a favour", "could i ask a favour", "may i ask a favour", "can i ask you a favour",
    "could i ask you a favour", "can you do something for me", "could you do something for me", "can you help me", "could you help me", "be a sweetheart",
    "be an angel", "be a star", "be a love", "be a darling", "be a hero", "before anything else", "before you do anything else", "before doing anything else",
    "ahead of anything else", "first and foremost", "sorry to be a bother", "sorry to be a pain", "sorry to bother you again", "sorry to ask", "sorry to be so difficult", "sorry to be difficult", "stretch your legs and", "sorry to be a nuisance", "beg your pardon", "begging your pardon",
    "if it is not out of your way", "if it is not far out of your way", "if that is not out of your way",
];

/// How something is done, at the end of an order, that says no more than the order.
#[rustfmt::skip]
pub(super) const MANNERS: &Phrases = &Phrases::of(&[
    "or so", "or thereabouts", "one after the other", "one after another", "one by one", "one at a time", "each in turn", "in turn",
    "the quickest way", "the shortest way", "the fastest way", "in total", "altogether", "all in all",
    "one at a time please", "each of them", "in that order", "in this order", "in any order",
    "in whichever order", "in order", "one after the next", "back to back", "by turns", "separately",
    "individually", "each one", "both of them", "all of them", "in a row", "on the spot", "with your hand",
    "with your camera", "with your finger", "with your phone", "in your own time", "by hand", "on foot",
    "under your own steam", "in one go", "without any detours", "without detours", "by the way",
    "in the process", "all the way", "there", "over there", "on the way there", "if needed", "if necessary",
    "never stop", "and never stop", "dont stop", "and dont lose it", "and dont lose him", "and dont lose her",
    "dont lose it", "dont lose him", "dont lose her", "and dont let it out of your sight",
    "and dont let him out of your sight", "and dont let her out of your sight", "dont let it out of your sight",
    "starting with the nearest and ending with the farthest", "from the nearest to the farthest", "the closer one first", "closer one first", "first the closer one", "first the nearer one", "first the nearest one", "first the one that is closer to you", "first the one thats closer to you", "first the one closer to you",
    "the closest one first", "closest one first", "starting with the closer one", "starting with the nearer one", "beginning with the nearer one", "beginning with the closer one", "starting with the closest one",
    "nearer one first", "nearest one first", "nearest first", "the nearest first", "the nearer one first",
    "the nearer first", "starting with the closest one", "starting with the nearest one", "beginning with the closest", "beginning with the nearest", "beginning with the closest one",
    "from the closest to the farthest", "from the nearest to the farthest", "from the closest to the furthest", "from the nearest to the furthest", "from near to far", "closest first", "the closest first", "closest one first", "starting with the nearest",
    "starting with the closest", "nearer first", "whichever you like", "whichever you prefer",
    "whichever you want", "any will do", "either will do", "it doesnt matter which", "no matter which",
    "with you", "with it", "with them", "with both hands", "with both arms", "in both arms", "in your arms",
    "as you are", "from me", "off the ground", "off the floor", "from the ground", "from the floor", "in silence",
    "in peace", "of your own", "in your own words", "to be precise", "to be exact", "no further", "no more", "no less",
    "for a better angle", "each", "apiece", "a while", "for now", "for good measure", "for safety", "just in case",
    "just to be safe", "just to be sure", "without stopping", "without a break", "without pausing", "already",
    "with all speed", "with care", "with a smile", "in the first place", "up there", "after me", "behind you", "after you",
    "no longer", "no matter what", "no matter what happens", "for fun", "just for fun", "for the fun of it", "just for the fun of it", "for luck", "just for luck", "for good luck", "for a laugh", "just for a laugh",
    "for the sake of it", "for old times sake", "for no reason", "for no particular reason", "for no good reason", "for practice", "just for practice", "for exercise",
    "for the exercise", "for the record", "for show", "just for show", "out of curiosity", "as a treat", "to be on the safe side", "just to be on the safe side",
    "for your own good", "for my sake", "for my peace of mind", "to celebrate", "for the joy of it", "for the hell of it",
]);

/// Sounds of hesitation; they are dropped wherever they stand.
pub(super) const HESITATIONS: &[&str] =
    &["uh", "um", "er", "erm", "hmm", "hm", "ahem", "eh", "ehm", "uhm", "mm", "uh huh", "ah", "oh"];

/// Words that turn an order into its contrary.
pub(super) const NEGATIONS: &Phrases = &Phrases::of(&[
    "dont",
    "do not",
    "never",
    "not",
    "you must not",
    "you mustnt",
    "you should not",
    "you shouldnt",
    "avoid",
    "refrain from",
]);
