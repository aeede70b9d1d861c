//! Turns of phrase that few use: "anything in the way of trees taller than ten metres", "neither is in this scene", "second, and this is the important
//! one, ...", "a gap of three metres to the hydrant", "any old car will do, so long as it's white", "for my opening shot I want ...".
//!
//! They are tried where a sentence was refused in every other way, along with conditions on doors ([`super::door_states`]) and what is said again by a
//! part of it ([`super::restated`]), and count only if what they come to is granted. So nothing that is understood is read otherwise.

use super::super::lexer::{Lexeme, is_mark};
use super::super::names::Names;
use super::forms::is_same;
use super::retold::{Turns, by_turn, last_mark, told_by};
use super::unusual_first::points_back;
use super::{Focus, door_states, restated, slips};
use crate::editing::Stock;

/// Turns that are all that is said, in the notation of [`super::turns`]; "." is the end of a sentence within them.
#[rustfmt::skip]
const WHOLE: &Turns = &[
    // What is said before a list, and beside an order.
    ("one|another|a|the more|last|final|other|next|- thing|request|wish|point|job|task|item for|about|regarding|concerning A . P", "P"),
    ("P second|secondly|next|then|third|thirdly|last|lastly , and this|that|thats is|- the|- most|really|- important|main|crucial|big|best|urgent one|bit|part|thing|point|- , Q", "P Q"),
    ("P .|,|- not the|that A , you follow|see|understand|know me|what|- i|- mean|- , the one W", "P"),
    ("P .|,|- not the|that A , the one W", "P"),
    ("nobody|noone|somebody|someone|people should|must|may|might|will|would|could|can|shall be|- trip|tripping|fall|falling|stumble|stumbling|bump|bumping|run|running|crash|crashing over|into|against it|him|her|them .|,|- P", "P"),
    ("the|my|our A phoned|called|rang|texted|emailed|nagged|pestered|reminded me|us B . P", "P"),
    // What is broken, and what comes in its place.
    ("the old|broken|rusty|- A is|was X , so|- please|- take|throw|rip|pull|tear|cut|dig|chuck|get|bring|knock it out|away|down|off|up and|, then|- put|place|plant|set|build|park|stand D B in its place Q", "remove the A and put D B in its place Q"),
    // Who is told of, and what is to become of them.
    ("A , poor|dear|good|old|sweet|lucky|silly|bless|our|my X , is|was|has|looks|seems|wants B .|,|- so|- please|- turn|rotate|spin him|her|it C", "turn A C"),
    ("A , poor|dear|good|old|sweet|lucky|silly|bless|our|my X , is|was|has|looks|seems|wants B .|,|- so|- please|- move|bring|take|put|send him|her|it C", "move A C"),
    ("A looks|seems|feels X , so|- please|- turn|rotate|spin him|her|it B , maybe|perhaps|hopefully Q", "turn A B"),
    ("the A isnt|is not|- ours|mine|theirs|needed|wanted , so|- please|- remove|delete|erase|scrap it ,|- but|and|while the B one is|stays|belongs , so|- please|- paint|colour|color|repaint it K", "remove the A and paint the B one K"),
    ("i|we pass|see|visit|watch N every|each B , and|- Q why isnt|is not|- there not|- no|- D A R it . so put|add|place|build|set one|it there|in|up|-", "put D A R N"),
    ("the A by|near|beside|at N are|is finished|done|over|complete|completed|gone at|- last|long|- , so|and P in front of it Q", "P in front of N Q"),
    // Any one will do.
    ("im|i|we|were am|are|- not|dont|wont fussy|picky|choosy|particular|mind|care Q any old|- A will|would do ,|- just|only|- so|as long as its|it is|- K and|, it|- ends|stands|is|goes|sits|stays|- up|- W", "put a K A W"),
    ("im|i|we|were am|are|- not|dont|wont fussy|picky|choosy|particular|mind|care Q any old|- A will|would do ,|- just|only|- so|as long as it|its ends|stands|is|goes|sits|stays|- up|- W", "put a A W"),
    // A number of what there is plenty of.
    ("ive|i|weve|we have|- got|- a|- whole|- load|lot|bunch|pile|heap|stack of A left|spare over|- , so Q . line|put|set|place|arrange|stand up|out|- D of them|those ,|- evenly|equally ,|- from B to C", "put D A between B and C , evenly spaced"),
    ("X time|hour|party|concert|show|festival|lesson|class|reading at|by|in|on|near N . D B spread|spaced|placed|arranged|set|distributed|- evenly|equally|- all|right|- around|round it|them", "put D B around N , evenly spaced"),
    // What is asked twice.
    ("whats|what is|- the story|deal|matter|score with|behind|about A ,|- by|- the|- way|- . describe|explain B to|for me|us Q", "describe B"),
];
/// Turns of one sentence each.
#[rustfmt::skip]
const PARTS: &Turns = &[
    // All of a kind.
    ("anything|everything|whatever in the way of A spoils|spoil|blocks|block|ruins|ruin|hides|hide|obstructs|bothers|annoys|disturbs B , so|- please|- cut|take|chop|tear|knock|clear|get|throw it|them down|away|out|off", "remove all A"),
    ("anything|everything|whatever in the way of A should|must|can|may|has|ought|needs|shall to|- go|vanish|disappear|leave now|-", "remove all A"),
    ("O remove|delete|clear|cut|chop|fell anything|everything|whatever down|away|- in the way of A", "O remove all A"),
    ("O strike|cut|delete|remove|cross|scratch N , neither|none of|- them|- is|are|was|were|belongs|belong in|on|of|to this|the|our|my|that scene|shot|picture|plan|take|photo|frame|film|sequence", "O remove N"),
    ("both A , the B , have|has|need|needs|must|should|ought|are to|- be|go|- removed|deleted|gone|scrapped|erased|away|-", "remove the B A"),
    ("P and of A , i|we want|like|need|prefer N tidy|clean|empty|neat|clear|free|uncluttered", "P and A"),
    // Conditions.
    ("if theres|there is|- still|- D A lying|standing|sitting|parked|hanging about|around|here|there|- , B , its|theyve|hes|shes|it|he|she|they been|has|have|is C", "if there is D A , B"),
    ("if theres|there is|- still|- D A lying|standing|sitting|parked|hanging about|around|here|there|- , B", "if there is D A , B"),
    ("if A , B , its|theyve|hes|shes|it|he|she|they is|has|have|- been there|here|around|about|lying|standing|sitting|parked C", "if A , B"),
    ("P , have D A standing|sitting|waiting|parked|stand|sit|wait|lying W", "P , put D A W"),
    // What is said while somebody thinks, and what follows a request.
    ("O stack|pile|heap|put|set|line up|out|down|- ,|- hmm|um|er|well|uh|- ,|- lets|let|- us|- say ,|- D A", "O put D A"),
    ("O scale|size|blow|bump|make|enlarge N up|- to|- twice|double|thrice|triple|half its|the|- size|- ,|- hmm|no|wait|er|um|actually|sorry|well|- ,|- make that|it B", "O make N B"),
    ("P , maybe|perhaps|hopefully it|itll|hell|shell|theyll|he|she|they will|would|might|- find|like|love|enjoy|appreciate|laugh|smile|cheer Q", "P"),
    ("P , he|she|it|they could|can|would|might do|use|go with|for|- some|a|more|- bit|of|- music|company|cheer|cheering|entertainment|fun|help|love|rest|sleep|attention|support|inspiration|courage|variety up|-", "P"),
    ("P ,|- please|- ,|- i mean|meant a|an real|proper|genuine|true|actual A ,|- and|but|- no|not a|an|- B", "P"),
    ("P , not K as|like i|we|you said|told|wrote|asked before|earlier|first|-", "P"),
    ("P , and , because|since|as|seeing A , D B", "P , and D B"),
    ("and|also|oh|- D A W would|could|might|will be|look X ,|- too|also|as|- well|-", "put D A W"),
    ("A looks|seems|feels X , so|- please|- turn|rotate|spin him|her|it B", "turn A B"),
    ("P at last", "P"),
    // What somebody says that is to be done.
    ("lets|let us|- surprise|amaze|impress|shock|delight|scare|amuse|treat everyone|everybody|people|them|him|her|all and P", "P"),
    ("my|the|our|his|her X says|said|orders|ordered|insists|suggests|suggested|tells|told|asks|asked|begs|begged me|us|you|- to P", "P"),
    ("they|he|she|you promised|said|swore|told|assured me|us|- A , so P", "P"),
    ("good|- morning|evening|afternoon|day|- ,|- visitors|people|drivers|tourists|cars|students|customers|folks|they park|parks|stop|drive|stand|walk everywhere|anywhere|constantly|always , so D B", "put D B"),
    ("i|we|they|somebody promised|owe|owed|offered|pledged the|my|our|these|all|- X D A every|each M from B across|over|up|down|all|right|- the|- way|- to C", "add A every M between B and C"),
    ("i|we need|want|lack X W , D B is|are what i|we was|were|am|are|had|have thinking|dreaming|in of|about|mind", "put D B W"),
    ("i|we promised|owe|owed|offered|pledged the|my|our|these|all|- X D A W", "put D A W"),
    ("for my|the|our|this|your X shot|scene|photo|picture|film|movie|video|trailer|poster|story|game|level|brochure ,|- i|we|id|wed want|need|would|like like|- D A", "put D A"),
    ("O give my|the|our|this|that X a|an Y Z", "O make it a Y Z"),
    ("O a|an|- Y january|february|march|april|may|june|july|august|september|october|november|december Z with|and|in A", "O make it a Y Z with A"),
    ("O a|an|- Y january|february|march|april|may|june|july|august|september|october|november|december Z", "O make it a Y Z"),
    // How somebody or something goes somewhere.
    ("P bring|fetch|get|take D A and|then then|- put|set|place|park|seat|sit|stand|leave him|her|it|them W", "P put D A W"),
    ("P bring|fetch|get|take A and|then then|- put|set|place|park|seat|sit|stand|leave him|her|it|them W", "P move A W"),
    ("O hide|conceal|stash D A W", "O put D A W"),
    ("O hide|conceal A W", "O move A W"),
    // How far.
    ("O move|shift|push|put|place|drag|set|slide N so that|- there|theres is|are|- a|- gap|distance|space of M to|from|between|towards B , C", "O put N at a distance of M from B"),
    ("O move|shift|push|put|place|drag|set|slide N so that|- there|theres is|are|- a|- gap|distance|space of M to|from|between|towards B", "O put N at a distance of M from B"),
    ("P place|put|set|park|stick|add|position|leave D A no|not further|farther|more than M away|- from|off|of B", "P put D A within M of B"),
    ("P place|put|set|park|stick|add|position|leave the A no|not further|farther|more than M away|- from|off|of B", "P put the A within M of B"),
];

/// What a sentence may have been meant to say, in plainer words.
pub(super) fn ways(
    words: &str,
    heard: &[Lexeme],
    names: &Names<'_>,
    stock: &Stock,
    focus: &Focus,
) -> Vec<Vec<Lexeme>> {
    let said = slips::heard_and_spelt(words, heard, names, stock, &focus.streets);
    let mut ways: Vec<Vec<Lexeme>> = Vec::new();
    for way in said.iter().flat_map(|said| told(words, said, names, focus)) {
        if ways.iter().all(|other| !is_same(other, &way)) {
            ways.push(way);
        }
    }
    ways
}

/// The words with the conditions on doors put plainly, and by all of the turns; each if it differs.
fn told(words: &str, lexemes: &[Lexeme], names: &Names<'_>, focus: &Focus) -> Vec<Vec<Lexeme>> {
    let doors = door_states::in_plain_words(words, lexemes);
    let said = restated::in_plain_words(doors.as_deref().unwrap_or(lexemes), names);
    let turned = turned(&said);
    // What "it" stood for may be left out, and what was spoken of before the sentence is not meant.
    let is_open = focus.it.is_some() && !is_same(&turned, &said) && points_back(&turned);
    let turned = if is_open { said.clone() } else { turned };
    let plain = restated::in_plain_words(&turned, names);
    let mut ways: Vec<Vec<Lexeme>> = doors.into_iter().collect();
    for way in [said, plain] {
        let is_new = !is_same(&way, lexemes) && ways.iter().all(|other| !is_same(other, &way));
        if is_new && way.iter().any(|lexeme| !is_mark(lexeme)) {
            ways.push(way);
        }
    }
    ways
}

/// The words by the first turn that they are as a whole, and then each sentence by its own.
fn turned(lexemes: &[Lexeme]) -> Vec<Lexeme> {
    let end = last_mark(lexemes);
    let whole = WHOLE.iter().find_map(|(said, meant)| by_turn(&lexemes[..end], said, meant));
    match whole {
        Some(mut told) => {
            told.extend_from_slice(&lexemes[end..]);
            told_by(&told, &[PARTS])
        }
        None => told_by(lexemes, &[PARTS]),
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, |lexemes| *lexemes = turned(lexemes))
    }

    #[test]
    fn turns_that_few_use_are_told_plainly() {
        for (said, meant) in [
            (
                "anything in the way of trees taller than ten metres spoils the view, cut it down",
                "remove all trees taller than ten metres",
            ),
            ("strike the cone and the crate, neither is in this scene", "remove the cone and the crate"),
            ("both cars, the red and the white, have to be removed", "remove the red and the white cars"),
            (
                "move the scooter so there is a gap of three metres to the hydrant, I tripped over it",
                "put the scooter at a distance of three metres from the hydrant",
            ),
            ("give my thriller a snowy night", "make it a snowy night"),
            ("hide ada inside the statue", "move ada inside the statue"),
            ("and then bring fido and set him next to her", "and then move fido next to her"),
            ("one more thing for the street party: a stage near the museum", "a stage near the museum"),
            (
                "i'm not fussy about the model, any old car will do, just so long as it's white and it ends up near the dorm",
                "put a white car near the dorm",
            ),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }

    #[test]
    fn what_says_something_else_stays() {
        for said in [
            "bring a bench next to the oak",
            "every tree needs one",
            "for my opening shot make it rain",
            "the oak looks old , so paint it red",
        ] {
            assert_eq!(plain(said), said);
        }
    }
}
