//! Words as they are said elsewhere: dialect, slang and short forms, put into the words that the tables know, beyond those that are
//! put so for whatever is heard (`dialects`).

use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::forms::words_at;

/// What is said, and what it means; nothing if it says nothing.
#[rustfmt::skip]
const RESPELT: &[(&[&str], &str)] = &[
    (&["yin"], "one"), (&["yins"], "ones"), (&["ither"], "other"), (&["twa"], "two"), (&["nae"], "no"), (&["hae"], "have"),
    (&["gie", "gies"], "give"), (&["tae"], "to"), (&["frae", "fae"], "from"), (&["ower"], "over"), (&["whaur"], "where"), (&["whit"], "what"),
    (&["whits"], "what is"), (&["aboot"], "about"), (&["roon", "roond"], "round"), (&["doon"], "down"), (&["oot"], "out"), (&["toon"], "town"),
    (&["hoose"], "house"), (&["the noo", "noo"], "now"), (&["awa"], "away"), (&["ahint"], "behind"), (&["aw"], "all"), (&["wi"], "with"),
    (&["dinnae", "didnae", "dinna", "divvent"], "do not"), (&["cannae"], "cannot"), (&["isnae", "isna"], "is not"), (&["willnae"], "will not"),
    (&["youse"], "you"), (&["yer"], "your"), (&["yerself", "yersel"], "yourself"), (&["yon", "thon"], "that"), (&["ken"], "know"),
    (&["aye"], "yes"), (&["och"], "oh"), (&["hoo"], "how"), (&["mony"], "many"), (&["efter"], "after"), (&["tak"], "take"), (&["mak"], "make"),
    (&["ca"], "call"), (&["shiftit"], "moved"), (&["nixt"], "next"), (&["watter"], "water"), (&["auld"], "old"), (&["braw"], "nice"),
    (&["bonny", "bonnie"], "nice"), (&["nearhaun"], "near"), (&["abune"], "above"), (&["stane"], "stone"), (&["fower"], "four"), (&["alang"], "along"),
    (&["atween"], "between"), (&["aroon"], "around"), (&["oan"], "on"), (&["motor"], "car"), (&["motors"], "cars"), (&["dae"], "do"), (&["gonnae"], "will you"),
    (&["dug"], "dog"), (&["dugs"], "dogs"), (&["bairns"], "children"), (&["richt"], "right"), (&["haud"], "hold"), (&["guid"], "good"),
    (&["em"], "them"), (&["sum"], "some"), (&["xcept", "exept"], "except"), (&["til"], "until"), (&["w"], "with"),
    (&["doggo", "doggos", "pupper"], "dog"), (&["outta"], "out of"), 
    (&["gizza"], "give us a"), (&["giz"], "give us"), (&["dyou"], "do you"), (&["couldya"], "could you"), (&["wouldya"], "would you"), (&["canya"], "can you"),
    (&["lil"], "little"), (&["nxt to"], "next to"), (&["dont wanna"], "dont want to"), (&["aint"], "is not"), (&["tryna"], "trying to"),
    (&["astern of"], "behind"),
    (&["mek"], "make"), (&["summat"], "something"), (&["nowt"], "nothing"), (&["owt"], "anything"), (&["them two"], "the two"),
    (&["them there"], "those"), (&["tp"], "teleport"), (&["mv"], "move"), (&["rm", "del"], "remove"), (&["whatevers"], "whatever is"), (&["wheres"], "where is"),
    (&["whos"], "who is"), (&["twould", "itd"], "it would"), (&["therell"], "there will"), (&["thatll"], "that will"), (&["itll"], "it will"),
    (&["cafe"], "café"), (&["cafes"], "cafés"), (&["turn her face to", "turn his face to", "turn its face to"], "face"),
    (&["whatever is within", "anything within", "whatever stands within", "all that is within", "what stands within", "anything closer than", "everything closer than", "everything that is within",
        "everything standing within", "all things within", "anything standing within", "anything that stands within", "anything that is within", "what is within", "whatever was located within",
        "what objects are closer than", "what objects are within", "which objects are within", "what things are within", "all objects within", "what is closer than"], "everything within"),
    (&["whatever lies on", "whatever is on", "whatever stands on", "anything on", "all that stands on", "everything that is on", "everything that stands on"], "everything on"),
    (&["whatever lies in", "whatever is in", "whatever stands in", "everything that is in", "everything that stands in"], "everything in"),
    (&["on its front", "across its front", "at its front", "along its front"], "in front of it"), (&["at its back", "at its rear"], "behind it"),
    (&["a bit closer to", "a little closer to", "a bit nearer to", "a little nearer to", "somewhat closer to", "slightly closer to", "a tad closer to", "a touch closer to", "a bit nearer",
        "a little nearer", "a little bit closer to", "further towards"], "closer to"),
    (&["directly opposite"], "opposite"), (&["please to"], "please"), (&["one has to place", "one must place", "one should place", "it must be placed", "it should be placed", "it has to be placed",
        "it shall be placed", "it needs to be placed", "it must come", "it shall come", "it should come", "there must be placed", "there should be placed", "one has to put", "one must put",
        "you put there also", "you can put there also", "there comes", "it must stand", "there must come"], "place"),
    (&["bear the name", "get the name", "carry the name", "be given the name", "have the name", "go by the name", "answer to", "get a name", "be given a name", "go by the name of", "bear the name of", "carry the name of",
        "be named as"], "be called"),
    (&["shall be known as", "will be known as", "is to be known as", "should be known as", "is known as", "shall henceforth be known as", "shall henceforth be called", "will be called", "shall be called", "is to be called", "is hereby named", "is hereby called",
        "will henceforth be called", "goes by the name", "shall go by the name of", "shall be named", "will be named", "shall answer to"], "should be called"),
    (&["is now called", "is now named", "is from now on called", "is henceforth called"], "should be called"), (&["to be with", "be with", "to join", "join", "be reunited with", "to be reunited with", "keep company with", "to keep company with"], "be next to"),
    (&["who is nearest to", "who is closest to", "who is the nearest to", "who is the closest to"], "who is the person nearest to"),
    (&["you forgot the", "you forgot a", "you have forgotten the", "we forgot the", "we forgot a", "i forgot the", "i forgot a", "you left out the"], "add a"),
    (&["if nobody is", "if no one is", "if nobody stands", "if there is nobody"], "if there is no person"),
    (&["if somebody is", "if someone is", "if anybody is", "if anyone is"], "if there is a person"),
    (&["something to sit on", "a place to sit"], "a bench"),
    (&["who is standing", "who stands", "who is waiting", "who waits", "who sits", "who is sitting"], "list people"),
    (&["is it possible that there is", "would it be possible that there is", "would it be possible to have", "is it possible to have", "is it possible to get", "would it be possible to get", "can there be", "could there be", "might there be", "may there be",
        "can there also be", "could there also be", "is there any way to get", "is there a way to get", "any way to get", "any way we could get", "any way we can get", "any way of getting", "is there any way we could have", "would there be room for",
        "is it possible to add", "would it be possible to add", "wouldnt it be nice to have", "would not it be nice to have", "wouldnt it be great to have", "would it be ok to have", "would it be okay to have", "is it ok to have"], "there should be"),
    (&["close of", "near of", "near from", "close from", "near to of"], "near"), (&["behind of"], "behind"), (&["in front from"], "in front of"), (&["across of"], "across from"), (&["beside of"], "beside"), (&["out front of", "out the front of"], "in front of"), (&["out the front", "out front"], "in front of it"),
    (&["bin it", "chuck it out", "throw it out", "toss it out", "chuck it away", "chuck it", "ditch it", "scrap it", "bin that", "chuck that", "ditch that"], "remove it"), (&["bin them", "chuck them", "ditch them", "scrap them"], "remove them"), (&["if there happens to be", "if there should be", "if there happen to be"], "if there is"),
    (&["is it possible that you", "would it be possible that you"], "could you"),
    (&["it gives"], "there is"), (&["in direction"], "to the"), (&["hold on to"], "keep"),
    (&["half as big again", "half again as big", "half as large again", "half again as large", "half as tall again", "half again as tall"], "half bigger"), (&["remove of"], "remove"), (&["delete of"], "delete"),
    (&["me please"], "me"), (&["us please"], "us"), (&["goes by the name of", "go by the name"], "should be called"),
    (&["likes of"], ""), (&["in the near of", "in the nearness of", "at the near of", "in near of", "in the proximity of", "nearby to", "nearby of", "close by to"], "near"), (&["in the front of"], "in front of"), (&["in the back of"], "behind"),
    (&["is it possible to having", "is it possible having", "would it be possible having", "is possible to have", "it is possible to have", "is it possible we have", "is it possible we get", "could it be possible to have", "is it maybe possible to have"], "there should be"), (&["thus", "therefore", "consequently", "accordingly", "that is why", "which is why", "thats why", "which is exactly why", "thats exactly why", "which is precisely why"], "so"), (&["an all"], ""), (&["fr", "lmfao", "af", "smh", "bruh", "ayo", "fam", "innit"], ""),
];

/// Puts dialect and short forms into the words that are known, and leaves names as they are.
pub(super) fn in_plain_spelling(words: &str, lexemes: &mut Vec<Lexeme>) {
    let mut at = 0;
    while at < lexemes.len() {
        let fits = |(plain, count): &(&str, usize)| {
            // "It must be placed a cone" is an order, and "it must be placed there" is not yet.
            let is_new =
                || longest_phrase(&lexemes[at + count..], &["a", "an", "one", "some", "also"]).is_some();
            !is_name(words, lexemes, at)
                // "The whit car" is white, and "whit is that" asks what.
                && (*plain != "what" || at == 0 || longest_phrase(&lexemes[at - 1..], &["the", "that", "a"]).is_none())
                // "The person who stands closest to it" asks nothing.
                && (!["list people", "who is the person nearest to"].contains(plain) || at == 0)
                // "The sum of them" is no slip, and "put on sum fog" is one.
                && (*plain != "some" || at > 0 && longest_phrase(&lexemes[at - 1..], &["the", "a", "in"]).is_none() && longest_phrase(&lexemes[at + count..], &["of", "up", "total"]).is_none())
                && (*plain != "place" || is_new() || numbers::count(&lexemes[at + count..]).is_some())
        };
        let Some((plain, count)) = longest(&lexemes[at..], RESPELT).filter(fits) else {
            at += 1;
            continue;
        };
        let place = lexemes[at].clone();
        let plain: Vec<Lexeme> =
            if plain.is_empty() { Vec::new() } else { words_at(&place, plain).collect() };
        let told = plain.len();
        lexemes.splice(at..at + count, plain);
        at += told;
    }
}

/// Whether a word is a name, which is written with a capital within a sentence and stands as it is.
pub(super) fn is_name(words: &str, lexemes: &[Lexeme], at: usize) -> bool {
    let begins = at == 0 || matches!(lexemes[at - 1].token, Token::Comma | Token::Break);
    !begins && words[lexemes[at].start..].starts_with(char::is_uppercase)
}

/// Every word of the table, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    RESPELT.iter().flat_map(|(said, _)| *said).flat_map(|phrase| phrase.split(' '))
}
