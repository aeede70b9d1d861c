//! What is told so that neither the whole of a sentence nor its parts are understood, told again in plainer words.
//!
//! A table of patterns turns common turns of phrase into orders ("from A to B, one every 5 m" is "every 5 m between A and B"), and
//! clauses that only say why are left out. This is tried last, and what it makes is read as any sentence: what stays unclear stays
//! refused. No clause is left out that asks for something by itself, denies something, or that a pronoun of the rest may be about.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::{word_at, words_at};
use super::parse::Reader;
use super::words::VERBS;

/// What adds nothing, wherever it stands.
#[rustfmt::skip]
const FILLERS: &Phrases = &Phrases::of(&["you know", "you see", "yeah", "with each other", "with one another", "on guard", "on duty", "on watch", "on standby", "on call", "at the ready", "from today on", "from now on",
    "as of today", "as of now", "starting today", "starting now", "starting from now", "ever again", "of course", "to all vehicles", "to all traffic", "to vehicles", "for all traffic", "for all vehicles", "while youre at it",
    "if possible", "if you can", "if you could", "if thats possible", "if that is possible", "all in all", "altogether", "for the time being", "for the moment", "for a change", "for good measure", "for company",
    "right about now", "right now", "out here", "i think", "i guess", "i suppose", "i reckon", "i believe", "in my opinion", "if you ask me", "as usual", "as always",
    "once and for all", "in the meantime", "as a start", "for a start", "to begin with", "to start with", "on second thoughts", "needless to say", "as you know", "as you can see", "say what you want",
    "first of all", "last of all", "as discussed", "as mentioned", "as requested", "as soon as possible", "at your convenience", "at your earliest convenience", "sort of", "kind of", "if you please", "by noon tomorrow", "by tomorrow", "this time", "on monday", "on tuesday", "on wednesday", "on thursday", "on friday", "on saturday", "on sunday", "these days", "at long last", "in fact", "no doubt", "thanks a bunch", "thanks a million", "thanks ever so much", "bless you", "isnt there", "arent there", "isnt it", "doesnt it", "dont you think", "i know i know", "pretty please", "pretty pleas", "if nobody minds", "to sleep in", "to sleep on", "to hide in", "to climb on", "be a dear", "be an angel", "after all", "for crying out loud"]);

/// Turns of phrase and what they mean, of one sentence each. A capital is any words without a mark, `P` and `Q` are any words or
/// none, `O` too where an order may follow, `M` is a measure, `D` an article or a number; `a|b` is either word, and `-` none.
#[rustfmt::skip]
const TURNS: &[(&str, &str)] = &[
    // Rows that are told from both ends.
    ("from A to B , C every|each M", "C every M between A and B"),
    ("from A to B C every|each M", "C every M between A and B"),
    ("every M A from B to C", "A every M between B and C"),
    ("every M , A from B to C", "A every M between B and C"),
    ("every M from A to B , C", "C every M between A and B"),
    ("A every|each M from B all the way to C", "A every M between B and C"),
    ("A every|each M from B to C", "A every M between B and C"),
    ("A from B to C , one|placed|set|spaced every M", "A every M between B and C"),
    ("A from B to C , every|each M", "A every M between B and C"),
    ("A from B to C every|each M", "A every M between B and C"),
    ("A from B to C , M apart", "A every M between B and C"),
    ("A , one every M , from B to C", "A every M between B and C"),
    ("A , one every|each M , P", "A every M P"),
    ("P , one|spaced|placed|set every|each M", "P every M"),
    ("P , one for every M", "P every M"),
    ("P , spacing M", "P every M"),
    ("P with a spacing of M", "P every M"),
    ("P at intervals of M", "P every M"),
    ("P in intervals of M", "P every M"),
    ("P at M intervals", "P every M"),
    ("A all the way from B to C every|each M", "A every M between B and C"),
    ("P with M between them|each|one|two", "P every M"),
    ("P , M between them|each", "P every M"),
    ("P , spaced|placed|set M apart|- , Q", "P every M Q"),
    ("P , spaced|placed|set M apart|-", "P every M"),
    ("P M apart from each|one other|another", "P every M"),
    ("P , one each|every M , Q", "P every M , Q"),
    ("every|each M between A and B , C", "C every M between A and B"),
    ("every|each M along|around|round A , C", "C every M along A"),
    // Distances that are told first.
    ("M A , D B", "add D B M A"),
    ("M A i|we|id|wed want|need|like|love|imagine|have|put|- D B", "add D B M A"),
    ("M A i|we would|could|might like|love|use|imagine|want D B", "add D B M A"),
    ("M A should|must|could go|stand|be D B", "add D B M A"),
    // Two that change places.
    ("P that A and B change|exchange|trade|switch|swap their|the places|positions|spots", "swap A and B"),
    ("A and B change|exchange|trade|switch|swap places|positions|spots", "swap A and B"),
    ("A and B should|must|could|to change|exchange|trade|switch|swap places|positions|spots", "swap A and B"),
    ("P where A is , Q where B is", "swap A and B"),
    // What is not to be there.
    ("P if A werent|wasnt|isnt|arent here|there anymore", "remove A"),
    ("P if A werent|wasnt|isnt|arent here|there any more|longer", "remove A"),
    ("P if A werent|wasnt|isnt|arent here|there", "remove A"),
    ("i|we dont want to see A again|anymore", "remove A"),
    ("i|we dont want to see A any more|longer", "remove A"),
    ("i|we dont want to see A", "remove A"),
    ("i|we never want to see A again", "remove A"),
    ("i|we could|can do without A", "remove A"),
    ("i|we have no use for A anymore", "remove A"),
    ("i|we have no use for A", "remove A"),
    ("theres|there is no place for A here|anymore", "remove A"),
    ("A has|have outlived its|their usefulness", "remove A"),
    ("A has|have served its|their purpose", "remove A"),
    ("P no longer need A here", "remove A"),
    ("cars|vehicles|traffic shouldnt|mustnt|cant|may be driving|allowed on A anymore", "close A"),
    ("cars|vehicles|traffic shouldnt|mustnt be driving|allowed on A", "close A"),
    ("cars|vehicles|traffic shouldnt|mustnt|cant drive|go on|along|through A", "close A"),
    ("no more cars|traffic|vehicles on|in|along A", "close A"),
    ("no cars|traffic|vehicles on|in|along A", "close A"),
    ("keep cars|traffic|vehicles off|out A", "close A"),
    ("keep cars|traffic|vehicles out of A", "close A"),
    ("keep all cars|traffic|vehicles off|from A", "close A"),
    ("block|seal|cordon|shut|fence off A", "close A"),
    ("block|shut A", "close A"),
    ("reopen|unblock|unlock A", "open A"),
    ("let traffic|cars|vehicles back|through|into|onto A", "open A"),
    ("let traffic|cars|vehicles use A again", "open A"),
    // New things, by what is needed.
    ("P is|are necessary|needed|required|wanted|desired D A , standing|placed|put B", "add D A B"),
    ("P is|are necessary|needed|required|wanted|desired D A", "add D A"),
    ("hows about A", "how about A"),
    ("id|wed put|place|have|add|stick D A", "add D A"),
    ("i|we would put|place|have|add|stick D A", "add D A"),
    ("O let D A keep him|her|it|them company Q", "O put D A Q"),
    ("O have|let D A play|stand|sing|perform|work|guard|patrol|sell|live|sleep|lie|walk|rest|watch|wait|sit|greet B", "O put D A B"),
    ("O keep|have|lay|hang|rest|prop|let D A", "O put D A"),
    ("A am|is|are|be|im|were|hes|shes|theyre needing|wanting|requiring D B", "A needs D B"),
    ("A will be needing D B", "A needs D B"),
    ("A should be having D B with|by him|her|it|them", "A needs D B"),
    ("D A should|could|must|has|is to wait|stay|sit|lie|rest|live|sleep|loiter|hang|perch|pose somewhere|out|around B", "add D A B"),
    ("D A should|could|must wait|stay|sit|lie|rest|live|sleep|loiter|hang|perch|pose|greet|keep B", "add D A B"),
    ("the A , and i|we want|need it|them B", "the A should be B"),
    ("A , and i|we want|need|would|like it|them|one|that B", "add A B"),
    ("for A please D B , beside|with him|her|it", "add D B next to A"),
    ("for A D B , beside|with him|her|it", "add D B next to A"),
    ("A says|reckons|thinks|insists|suggests|demands that|- the B belongs|goes C", "the B should go C"),
    ("A says|reckons|thinks|insists|suggests|demands that|- D B belongs|goes C", "add D B C"),
    // New things, told by other verbs.
    ("O dig|sink|open|erect|pitch|run|start|install|moor|dock|light|grow D A", "O put D A"),
    ("O put|place|add|set|build|light|plant|dig|install|park|pitch me|us|them D A", "O put D A"),
    ("i am|was wishing|wanting|desiring|hoping|dreaming|picturing|imagining for|of|- D A to be|stand|go B", "add D A B"),
    ("im wishing|wanting|desiring|hoping|dreaming|picturing|imagining for|of|- D A to be|stand|go B", "add D A B"),
    ("im|we wishing|wanting|desiring|hoping|dreaming|picturing|imagining for|of|- D A", "add D A"),
    ("P it is|are missing|lacking D A , you put please", "P put D A"),
    ("P it is|are missing|lacking D A", "P put D A"),
    ("P , D A wouldnt hurt|harm Q", "P , add D A"),
    ("P , D A wouldnt go amiss Q", "P , add D A"),
    ("D A wouldnt hurt|harm Q", "add D A"),
    ("D A wouldnt go amiss Q", "add D A"),
    ("A would|might|could be|feel|look happier|better|nicer|safer|prettier|livelier|friendlier with D B", "A needs D B"),
    ("A should|could|must get itself|himself|herself|themselves D B", "A needs D B"),
    ("P should|could|must get itself|himself|herself|themselves D B", "P needs D B"),
    ("in memory|honour|honor of A the B", "the B"),
    ("A is|are|looks|look B and ought|should|must|has|have|needs|need to|- C", "A should C"),
    ("A doesnt|dont|no belong|longer here , B it|them", "remove A"),
    ("A doesnt|dont belong here|there", "remove A"),
    ("bye|goodbye|farewell bye|- the A", "remove the A"),
    ("bye|goodbye|farewell bye|- A", "remove the A"),
    ("so long the A", "remove the A"),
    ("im|we picturing|imagining|seeing A in B rather than C", "paint A B"),
    ("i|we am|are|see|picture|imagine A in B rather than C", "paint A B"),
    ("P double A in size|height", "P double A"),
    ("P triple A in size|height", "P triple A"),
    ("P halve A in size|height", "P halve A"),
    ("P turn|rotate|spin|swivel|swing A round|around by B , Q", "P turn A by B"),
    ("P turn|rotate|spin|swivel|swing A round|around by B", "P turn A by B"),
    ("P copy|duplicate|clone A and put|stand|place|set|park|move the|- copy|copies|duplicate|duplicates|clone|it|them down|- B", "P copy A B"),
    ("P make D copies|copy of A and put|stand|place|set|park|move the|- copy|copies|it|them down|- B", "P make D copies of A B"),
    ("P read|tell|list|show|name me|us out|- which|what A there are|is Q", "list A"),
    ("how many A have|do we|you|i got|have Q", "how many A are there Q"),
    ("P , a clump|tuft|bunch|group|patch every|each M", "P every M"),
    ("P , one each M B", "P every M B"),
    ("A from B to C , one|placed|set|spaced every|each M in between", "A every M between B and C"),
    ("O give|get|buy|bring|offer|lend|grant|hand them|people|everybody|everyone|us D A", "O put D A"),
    ("P , but|only not B", "P except B"),
    ("P , but|and|only|just leave|keep|spare B alone|be|standing|there|- Q", "P except B Q"),
    ("P , but|and|only B stays|stay|remains|remain as|where|- it|they|- is|are|-", "P except B"),
    ("O take|get|bring|clear A off|from B and put|place|set|stand it|them C", "O move A C"),
    ("O take|clear A off B", "O remove A on B"),
    ("P , but|and|so|- id|wed sleep|feel|work|rest|live|breathe better|safer|happier|easier|calmer with D B", "P , so add D B"),
    ("P , but|and|so maybe|perhaps|- D A would|will|should|might bring|draw|lift|change|cheer|work|make|save|keep|help|give|stop|solve|fix|prevent|attract|delight B", "P , so add D A"),
    ("id|wed|i|we would|- sleep|feel|work|rest|live|breathe|be|look better|safer|happier|easier|calmer with D B", "add D B"),
    ("maybe|perhaps|possibly|surely|- D A would|will|should|might bring|draw|lift|change|cheer|work B", "add D A"),
    ("D A would be a|an|such|quite B", "add D A"),
    ("if only there were|was D A", "add D A"),
    ("A deserves|deserve|begs|longs to be B", "A should be B"),
    ("A ought|should|must|has to|- have|keep his|her|its|their eyes|eye|gaze on B", "A should face B"),
    ("if only we|i had D A", "add D A"),
    ("P , but the A is called|named B", "P , name the A B"),
    ("the A is called|named B", "name the A B"),
    ("P in|on|over there Q", "P there Q"),
    ("i|we promised|owe A D B", "add D B"),
    ("D A is what i|we need|want|lack|miss|fancy B", "add D A B"),
    ("D A is what i|we need|want|lack|miss|fancy", "add D A"),
    ("D A is what im|were after|missing|lacking", "add D A"),
    ("D A would|will|should|might make|save|keep|help|give|stop|bring|solve|fix|prevent|attract|delight B", "add D A"),
    ("id|wed be so|very|much|more|- than|- happy|content|glad|grateful|obliged|thankful|delighted for|with|about D A", "add D A"),
    ("A could|would|can do with being B", "A should be B"),
    ("nobody|noone would|will miss A", "remove A"),
    ("im|were so|- over A", "remove A"),
    ("tell me|us what A is", "describe A"),
    ("how many A has|have the|this|our B", "how many A are there"),
    ("how many A are there besides|except|without|excluding|apart me|us|myself|from Q", "how many A are there"),
    ("A suits B much|far|so|- better Q", "paint B A"),
    // Where somebody is to be.
    ("P bring|move|send|put|get|take A to her side", "P move A next to her"),
    ("P bring|move|send|put|get|take A to his side", "P move A next to him"),
    ("P turn|rotate|spin|swivel A around|round|- so|- that|- he|she|it|they faces|face B", "P make A face B"),
    ("P have|let|make A turn to|towards B", "P make A face B"),
    ("P shift|move|bring|take|get A over|- so he|she|it|they is|are B", "P move A B"),
    ("P shift|move|bring|take|get A over|- so hes|shes|its|theyre B", "P move A B"),
    ("P shift|move|bring|take|get A over|- so that he|she|it|they is|are|stands|stand B", "P move A B"),
    ("P on|at|to A left|right side|hand", "P to the left of A"),
    ("A has|have|needs to turn his|her|its|their eyes|gaze|head|face to|towards B", "A should face B"),
    ("A should|must turn his|her|its|their eyes|gaze|head|face to|towards B", "A should face B"),
    ("A has|have|needs|ought to look|gaze|stare to|at|towards B", "A should face B"),
    // How something is to be.
    ("a splash|lick|coat|touch|dash of A would|might|could do B good", "paint B A"),
    ("a splash|lick|coat|touch|dash of A would|might|could suit|help|improve B", "paint B A"),
    ("A is|are supposed|meant to be B , not C", "A should be B"),
    ("A is|are supposed|meant to be B", "A should be B"),
    ("A is|are too B , needs|need to be C", "A should be C"),
    ("A is|are too B , should|must be C", "A should be C"),
    ("A is no colour|color for B make it C", "paint B C"),
    ("A is no colour|color for B , make|paint it C", "paint B C"),
    ("let A turn|become|get B", "make A B"),
    ("D A would|might|could do B good Q", "add D A"),
    ("D A would|might|could suit|help|cheer|please B", "add D A"),
    // What is asked.
    ("which|what A have|do we|you|i got|have Q , can|could you list|name|show them P", "list A Q"),
    ("which|what A have we|you got Q", "list A Q"),
    ("P what can|could you tell us|me|them about A", "describe A"),
    ("P what do|can you know|say about A", "describe A"),
    ("P describe A to me|us|them , B", "describe A"),
    ("P describe A to me|us|them", "describe A"),
];

/// As [`TURNS`], of what would be misunderstood otherwise.
#[rustfmt::skip]
const BEFORE_ALL: &[(&str, &str)] = &[
    // "One" is of what is not there, and not of where it is looked for.
    ("if there is|isnt no|any A on|in|at the|this|our|- town|city|campus|scene|map|village|place , build|add|put|place|make|plant one B", "if there is no A , put a A B"),
    ("if theres|there no|isnt any|- A on|in|at the|this|our|- town|city|campus|scene|map|village|place , build|add|put|place|make|plant one B", "if there is no A , put a A B"),
    ("if nobody|noone has put|placed|set|built|added D A anywhere|there|here|- yet|- , P put|add|place|build one B", "if there is no A , P put a A B"),
    ("in case theres|there no|isnt any|a|- A yet|here|there|- , put|add|place|build one B", "if there is no A , put a A B"),
    ("if theres|there no|isnt any|a|- A yet|here|there , put|add|place|build one B", "if there is no A , put a A B"),
    ("A theres just|still|- enough|plenty|- of|- room|space for D B , so|and put|add|place|stand one|it there", "add D B A"),
    ("A there is just|still|- enough|plenty|- of|- room|space for D B , so|and put|add|place|stand one|it there", "add D B A"),
    ("if A , and i|we think|bet|guess|believe|hope|know|suppose B , C Q", "if A , C Q"),
];
/// What is said by the way, in the words of who asks kindly.
#[rustfmt::skip]
const ASIDES: &Phrases = &Phrases::of(&["while you are at it", "while youre at it", "while were at it", "while im at it", "while we are at it", "by the way", "if i may", "if i might", "if i may ask", "if youd be so good", "if you would be so good", "if youd be so kind", "if you would be so kind", "if its not too much trouble", "if it isnt too much trouble",
    "if its no trouble", "if that isnt too much trouble", "if you dont mind", "when you have a moment", "when you get a moment", "when you have a minute", "if you have a minute", "if you have a moment"]);

/// "We're having a party: ...": an occasion is nothing that is to be put anywhere.
fn without_occasion(lexemes: &mut Vec<Lexeme>) {
    const HAVING: &Phrases = &Phrases::of(&["were having a", "we are having a", "im having a", "i am having a", "theyre having a", "were throwing a", "im throwing a", "weve got a", "were having our", "were planning a", "im planning a", "were celebrating a"]);
    let Some(mark) = lexemes.iter().position(is_mark).filter(|mark| mark + 1 < lexemes.len()) else { return };
    let is_plain = mark <= 9
        && longest_phrase(lexemes, HAVING).is_some()
        && !(0..mark).any(|at| longest(&lexemes[at..], &super::words::WAYS).is_some_and(|(_, words)| words > 1));
    if is_plain {
        lexemes.drain(..=mark);
    }
}

/// Puts what would be misunderstood plainly, and leaves out what is said by the way.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    without_occasion(lexemes);
    let asides = without(lexemes, ASIDES);
    if asides.iter().any(|lexeme| !is_mark(lexeme)) {
        *lexemes = asides;
    }
    if lexemes.iter().any(|lexeme| matches!(&lexeme.token, Token::Word(word) if ["if", "case", "room", "space"].contains(&word.as_str()))) {
        *lexemes = told_by(lexemes, BEFORE_ALL);
    }
}

/// What begins a clause that says why or what for, behind a request.
#[rustfmt::skip]
const WHY: &Phrases = &Phrases::of(&["because", "since", "so that", "otherwise", "or else", "lest", "in case", "given that", "now that", "seeing that", "seeing as", "considering", "even though", "although", "though", "so people", "so everybody", "so everyone", "so nobody",
    "so visitors", "so kids", "so children", "so students", "so customers", "so guests", "so tourists", "so the", "so we", "so i", "so you", "so they", "so he", "so she", "so it", "so my", "so our", "so no one", "so folks", "so passers", "as people", "as we", "as i", "as they", "as the", "as there", "as everybody", "as everyone",
    "as he", "as she", "as it", "as my", "as our", "as nobody", "as some", "as many", "for we", "for they", "for there", "for everybody", "for it", "whereas", "in order to", "in order that", "in preparation for", "in honour of", "in honor of", "cause", "cos", "coz", "the way", "that way", "this way", "or", "before", "to help", "to keep", "to make", "to give", "to let", "to stop", "to welcome", "to remind", "to celebrate", "to brighten", "to see", "to prevent", "to avoid", "to protect", "to ensure", "to show", "to watch", "to mark", "to catch", "to warn", "to cheer", "to attract", "to feed", "to light", "to look", "to block", "to guide", "to allow", "to be able"]);
/// Verbs of what is so, and what may stand before one.
#[rustfmt::skip]
const IS: &Phrases = &Phrases::of(&["is", "are", "was", "were", "am", "has", "have", "had", "will", "wont", "would", "can", "cant", "cannot", "could", "couldnt", "do", "dont", "does", "doesnt", "did", "didnt", "isnt", "arent", "wasnt", "havent", "hasnt", "may", "might",
    "im", "its", "thats", "theyre", "were", "theres", "ive", "weve", "theyve", "shes", "hes", "youre", "well", "mustnt", "shouldnt", "never", "always", "keep", "keeps", "go", "goes", "get", "gets", "come", "comes", "know", "knows", "love", "loves", "like", "likes", "wait", "say", "says", "think", "feel", "look", "leaves", "leave", "need", "needs",
    "want", "wants", "make", "makes", "use", "see", "gives", "distract", "meet", "bring", "help", "helps", "starts", "run", "play", "sit", "walk", "stop", "tend"]);
/// By these a clause may change what the rest asks for.
#[rustfmt::skip]
const CHANGES: &Phrases = &Phrases::of(&["not the", "not a", "not that", "not those", "not these", "except", "only", "unless", "instead", "rather than", "but", "please", "apart from", "other than", "but not", "if", "until", "when", "twice", "half", "double", "as well", "the same", "another", "one more", "remove", "paint", "add", "delete", "i mean",
    "scratch that", "no wait", "wait no", "actually", "correction", "sorry", "undo", "never mind", "forget it", "forget that", "stop it", "leave it", "leave them", "should", "must", "ought", "lets", "instead", "either", "neither", "or the"]);
/// Words of the rest that may be about what is left out.
const OPEN: &[&str] = &[
    "it", "its", "them", "him", "her", "his", "their", "one", "ones", "there", "they", "that", "those",
    "these", "this", "he", "she", "another", "same", "both", "other", "others", "too", "also",
];
/// What begins a request that is no order.
#[rustfmt::skip]
const REQUESTS: &Phrases = &Phrases::of(&["can", "could", "would", "will", "may", "how", "what", "which", "where", "who", "please", "let", "lets", "i want", "i need", "we need", "we want", "id like", "wed like", "i would like", "we would like", "there should", "there must", "why not", "is there", "are there", "if", "unless", "when", "and", "or", "but", "then", "id", "wed", "kindly", "no", "not"]);

impl Reader<'_> {
    /// The words told otherwise, in all ways that differ from how they were said, the nearest first.
    pub(super) fn retold(&self) -> Vec<Vec<Lexeme>> {
        let turned = told_by(&without(self.lexemes, FILLERS), TURNS);
        let without_why = told_by(&self.without_why(&turned), TURNS);
        let requests = told_by(&self.requests(&without_why), TURNS);
        let for_nobody = self.without_whom(&turned);
        let mut ways: Vec<Vec<Lexeme>> = Vec::new();
        for way in [turned, for_nobody, without_why, requests] {
            let said =
                |lexemes: &[Lexeme]| lexemes.iter().map(|lexeme| lexeme.token.clone()).collect::<Vec<_>>();
            let is_new =
                said(&way) != said(self.lexemes) && ways.iter().all(|other| said(other) != said(&way));
            if is_new && way.iter().any(|lexeme| !is_mark(lexeme)) {
                ways.push(way);
            }
        }
        ways
    }

    /// The words without whom or what something is for, where that names nothing: "for the helpers", "for my little ones".
    fn without_whom(&self, lexemes: &[Lexeme]) -> Vec<Lexeme> {
        const FOR: &Phrases =
            &Phrases::of(&["for the", "for my", "for our", "for his", "for her", "for their", "for all the", "for those", "for these"]);
        const LONGEST: usize = 5;
        let reader = Reader { lexemes, at: 0, ..*self };
        let mut kept: Vec<Lexeme> = Vec::with_capacity(lexemes.len());
        let mut at = 0;
        while at < lexemes.len() {
            let end = (at..lexemes.len()).find(|end| is_mark(&lexemes[*end])).unwrap_or(lexemes.len());
            let is_whom = at > 0
                && longest_phrase(&lexemes[at..], FOR).is_some()
                && end <= at + LONGEST
                && reader.names_nothing(at + 1, end);
            if is_whom {
                at = end;
            } else {
                kept.push(lexemes[at].clone());
                at += 1;
            }
        }
        kept
    }

    /// The words without the clauses that only say why, each of which ends where its sentence does or something else is asked for.
    fn without_why(&self, lexemes: &[Lexeme]) -> Vec<Lexeme> {
        let mut kept: Vec<Lexeme> = Vec::with_capacity(lexemes.len());
        for sentence in sentences(lexemes) {
            let mut rest = sentence.to_vec();
            if let Some(cut) = before_so(&rest)
                && self.is_idle_clause(&rest[..cut.0], &rest[cut.1..], true)
            {
                rest.drain(..cut.1);
            }
            let front = longest_phrase(
                &rest,
                &[
                    "because",
                    "since",
                    "as",
                    "now that",
                    "given that",
                    "seeing that",
                    "considering",
                    "while",
                    "although",
                ],
            );
            if front.is_some()
                && let Some(comma) = rest.iter().position(|lexeme| lexeme.token == Token::Comma)
                && self.is_idle_clause(&rest[..comma], &rest[comma + 1..], true)
            {
                rest.drain(..=comma);
            }
            let why = (2..rest.len()).find(|at| longest_phrase(&rest[*at..], WHY).is_some());
            if let Some(at) = why {
                let end =
                    (at + 2..rest.len()).find(|at| goes_on(&rest[*at..])).unwrap_or_else(|| last_mark(&rest));
                if at < end && self.is_idle_clause(&rest[at + 1..end], &rest[..at], false) {
                    let from = if is_mark(&rest[at - 1]) { at - 1 } else { at };
                    rest.drain(from..end);
                }
            }
            kept.extend(rest);
        }
        kept
    }

    /// The sentences and the parts between commas that ask for something, without those that only tell.
    fn requests(&self, lexemes: &[Lexeme]) -> Vec<Lexeme> {
        let mut units: Vec<&[Lexeme]> = lexemes.split_inclusive(is_mark).collect();
        let words_of =
            |unit: &[Lexeme]| unit.iter().filter(|lexeme| !is_mark(lexeme)).cloned().collect::<Vec<_>>();
        let mut at = 0;
        while at < units.len() {
            let unit = words_of(units[at]);
            let others: Vec<Lexeme> = units[at + 1..].concat();
            let is_told = units.len() > 1
                && !unit.is_empty()
                && longest(&unit, &VERBS).is_none()
                && longest_phrase(&unit, REQUESTS).is_none()
                && self.is_idle_clause(&unit, &others, at + 1 < units.len());
            if is_told {
                units.remove(at);
            } else {
                at += 1;
            }
        }
        units.concat()
    }

    /// Whether a clause tells something, asks for nothing that is understood, and leaves the rest of the sentence as it is.
    fn is_idle_clause(&self, clause: &[Lexeme], rest: &[Lexeme], is_before: bool) -> bool {
        let any =
            |phrases: &Phrases| (0..clause.len()).any(|at| longest_phrase(&clause[at..], phrases).is_some());
        let is_open =
            |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if OPEN.contains(&word.as_str()));
        let paints = (0..clause.len()).any(|at| longest(&clause[at..], PAINTS).is_some());
        let may_be_about = is_before && rest.iter().any(is_open);
        let tells = || {
            let reader = Reader { lexemes: clause, at: 0, ..*self };
            reader.names_nothing(0, clause.len()) && reader.tells_with_verb(0, clause.len())
        };
        clause.len() > 1 && (any(IS) || tells()) && !any(CHANGES) && !paints && !may_be_about && !self.is_wish(clause)
    }

    /// Whether words are a request by themselves.
    fn is_wish(&self, words: &[Lexeme]) -> bool {
        let memo = super::memo::Memo::default();
        Reader {
            lexemes: words,
            at: 0,
            memo: &memo,
            depth: self.depth,
            words: self.words,
            names: self.names,
            view: self.view,
        }
        .sentence()
        .is_ok()
    }
}

/// Without what adds nothing, and the commas around it.
fn without(lexemes: &[Lexeme], asides: &Phrases) -> Vec<Lexeme> {
    let mut kept: Vec<Lexeme> = Vec::with_capacity(lexemes.len());
    let mut at = 0;
    while at < lexemes.len() {
        if let Some(words) = longest_phrase(&lexemes[at..], asides) {
            at += words;
            let is_aside = kept.last().is_none_or(is_mark);
            while is_aside && lexemes.get(at).is_some_and(|lexeme| lexeme.token == Token::Comma) {
                at += 1;
            }
        } else {
            kept.push(lexemes[at].clone());
            at += 1;
        }
    }
    kept
}

/// The sentences, each with the mark at its end.
fn sentences(lexemes: &[Lexeme]) -> impl Iterator<Item = &[Lexeme]> {
    lexemes.split_inclusive(|lexeme| lexeme.token == Token::Break)
}

/// Where the marks at the end begin.
fn last_mark(lexemes: &[Lexeme]) -> usize {
    lexemes.iter().rposition(|lexeme| !is_mark(lexeme)).map_or(0, |last| last + 1)
}

/// Whether something else is asked for from here on: ", and put ...", "then move ...".
fn goes_on(rest: &[Lexeme]) -> bool {
    let marks = rest.iter().take_while(|lexeme| is_mark(lexeme)).count();
    let joint =
        longest_phrase(&rest[marks..], &["and", "then", "and then", "also", "and also", "plus", "please"]);
    joint.is_some_and(|words| rest.get(marks + words..).is_some_and(|rest| longest(rest, &VERBS).is_some()))
}

/// Where a clause ends before "so", and where what follows from it begins.
fn before_so(lexemes: &[Lexeme]) -> Option<(usize, usize)> {
    let is = |at: usize, said: &str| matches!(lexemes.get(at).map(|lexeme| &lexeme.token), Some(Token::Word(word)) if word == said);
    let so = (2..lexemes.len())
        .find(|at| is(*at, "so") && !is(at + 1, "that") && !is(at + 1, "many") && !is(at + 1, "much"))?;
    let end = if lexemes[so - 1].token == Token::Comma { so - 1 } else { so };
    Some((end, so + 1))
}

/// Each sentence by the first turn of phrase that it is, two of them at most.
fn told_by(lexemes: &[Lexeme], turns: &[(&str, &str)]) -> Vec<Lexeme> {
    let mut told = Vec::with_capacity(lexemes.len());
    for sentence in sentences(lexemes) {
        let end = last_mark(sentence);
        let mut words = sentence[..end].to_vec();
        for _ in 0..2 {
            if let Some(other) = turns.iter().find_map(|(said, meant)| by_turn(&words, said, meant)) {
                words = other;
            }
        }
        told.extend(words);
        told.extend_from_slice(&sentence[end..]);
    }
    told
}

/// What the words mean by a turn of phrase, if they are one.
fn by_turn(words: &[Lexeme], said: &str, meant: &str) -> Option<Vec<Lexeme>> {
    let pattern: Vec<&str> = said.split(' ').collect();
    let mut bound = Vec::new();
    if !fits(words, 0, &pattern, &mut bound) {
        return None;
    }
    let place = words.first()?;
    let mut made = Vec::new();
    for part in meant.split(' ') {
        if let Some((_, from, to)) = bound.iter().find(|(name, ..)| *name == part) {
            made.extend_from_slice(&words[*from..*to]);
        } else if part == "," {
            made.push(Lexeme { token: Token::Comma, ..place.clone() });
        } else {
            made.extend(words_at(place, part));
        }
    }
    // "On Anna's left" keeps its side.
    if let Some(at) =
        made.iter().position(|lexeme| matches!(&lexeme.token, Token::Word(word) if word == "left"))
        && words.iter().any(|lexeme| matches!(&lexeme.token, Token::Word(word) if word == "right"))
        && !words.iter().any(|lexeme| matches!(&lexeme.token, Token::Word(word) if word == "left"))
    {
        made[at] = word_at(&made[at], "right");
    }
    Some(made)
}

type Bound<'p> = Vec<(&'p str, usize, usize)>;

/// Whether all words from one on are what a pattern says; the words of its capitals are kept.
fn fits<'p>(words: &[Lexeme], at: usize, pattern: &[&'p str], bound: &mut Bound<'p>) -> bool {
    let Some((first, rest)) = pattern.split_first() else { return at == words.len() };
    let is_any = first.len() == 1 && first.starts_with(|letter: char| letter.is_ascii_uppercase());
    if !is_any {
        let here = words.get(at).is_some_and(|lexeme| match &lexeme.token {
            Token::Comma => *first == ",",
            Token::Word(word) => first.split('|').any(|said| said == word),
            _ => false,
        });
        let is_left_out = first.split('|').any(|word| word == "-");
        return here && fits(words, at + 1, rest, bound) || is_left_out && fits(words, at, rest, bound);
    }
    let is_open = ["O", "P", "Q"].contains(first);
    let least = usize::from(!is_open);
    let most = if ["M", "D"].contains(first) { 3 } else { words.len() - at };
    for count in least..=most.min(words.len() - at) {
        let part = &words[at..at + count];
        if !is_open && part.iter().any(is_mark) {
            break;
        }
        if *first == "M" && !is_measure(part)
            || *first == "D" && !is_new(part)
            || *first == "O" && !may_order(part)
        {
            continue;
        }
        bound.push((first, at, at + count));
        if fits(words, at + count, rest, bound) {
            return true;
        }
        bound.pop();
    }
    false
}

/// Whether an order may follow: "they have a bench" is none.
fn may_order(words: &[Lexeme]) -> bool {
    words.last().is_none_or(|last| {
        is_mark(last)
            || matches!(&last.token, Token::Word(word) if ["please", "kindly", "you", "and", "then", "so", "now", "just", "also", "lets", "to"].contains(&word.as_str()))
    })
}

/// "A", "one", "a pair of", "two".
fn is_new(words: &[Lexeme]) -> bool {
    let article = longest_phrase(words, &["a", "an", "one", "some", "another"]) == Some(words.len());
    article || super::super::numbers::count(words).is_some_and(|(_, count)| count == words.len())
}

/// "Five metres".
fn is_measure(words: &[Lexeme]) -> bool {
    const UNITS: &[&str] =
        &["m", "metre", "metres", "meter", "meters", "feet", "foot", "ft", "yards", "yard", "steps", "paces"];
    let unit = |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if UNITS.contains(&word.as_str()));
    words.len() > 1
        && words.last().is_some_and(unit)
        && super::super::numbers::number(words).is_some_and(|(_, count)| count + 1 == words.len())
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let phrases = [FILLERS, ASIDES, WHY, IS, CHANGES, REQUESTS]
        .into_iter()
        .flatten()
        .flat_map(|phrase| phrase.split(' '));
    let turns = TURNS.iter().flat_map(|(said, _)| said.split([' ', '|']));
    phrases.chain(turns.filter(|word| word.len() > 1))
}
