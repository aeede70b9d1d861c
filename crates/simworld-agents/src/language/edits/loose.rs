//! Turns of phrase of people who speak loosely, in slang or in a language that is not theirs, and what they mean, in the notation of
//! [`super::turns`]. They are tried behind all others, and so only where a sentence was understood in no other way.

use super::super::lexer::Lexeme;
use super::forms::is_same;
use super::retold::{Turns, told_by};

/// Turns of phrase and what they mean, of one sentence each.
#[rustfmt::skip]
const LOOSE: &Turns = &[
    // Rows without an order.
    ("G along|on|down|up A on|at|along both|either|each side|sides ,|- one|each|- every|each M", "add G every M on both sides of A"),
    ("G on|at|along both|either|each sides|side ,|- one|each|- every|each M along|on|down|of|in A", "add G every M on both sides of A"),
    ("P along|on|down|up A on|at|along both|either|each side|sides ,|- one|each|- every|each M", "P every M on both sides of A"),
    ("P on|at|along both|either|each sides|side ,|- one|each|- every|each M along|on|down|of|in A", "P every M on both sides of A"),
    ("G every|each M between B and C", "add G every M between B and C"),
    ("G every|each M along|down B", "add G every M along B"),
    ("G every|each M around|round B", "add G every M around B"),
    ("along|down B , G every|each M", "add G every M along B"),
    ("around|round B , G every|each M", "add G every M around B"),
    // What somebody or something should have.
    ("O could|can|may|might|should|would|will|shall A please|also|kindly|- have|get|receive|own D B next|close to it|him|her|them", "O add D B next to A"),
    ("O could|can|may|might|should|would|will|shall A please|also|kindly|- have|get|receive|own D B beside|by|near|alongside it|him|her|them", "O add D B next to A"),
    ("O could|can|may|might|should|would|will|shall A please|also|kindly|- have|get|receive|own D B in front of it|him|her|them", "O add D B in front of A"),
    ("O could|can|may|might|should|would|will|shall A please|also|kindly|- have|get|receive|own D B behind it|him|her|them", "O add D B behind A"),
    ("O could|can|may|might|should|would|will|shall N please|also|kindly|- have|get|receive|own D B", "O N needs D B"),
    ("O let|have N have|get|own D B", "O N needs D B"),
    ("N looks|look|seems|feels|is|are so|very|rather|quite|a|too|- bit|little|- naked|bare|empty|lonely|boring|dull|sad|incomplete|nothing without D A", "N needs D A"),
    ("N lacks|misses|lack|miss D A", "N needs D A"),
    ("N is|are lacking|missing|short of|- D A", "N needs D A"),
    // New things, where they stand told behind them.
    ("P D X , and|but|where|- he|she|it|they|that|this must|should|shall|has|have|needs|need|ought|can|could|may|might|will please|- to|- stand|be|go|sit|come|get|hang|live|lie|stay|belong placed|put|set|installed|standing|- W", "P D X W"),
    ("P D X , and|but|- he|she|it|that|this belongs|goes|comes W", "P D X W"),
    ("P D X , place|position|stand W", "P D X W"),
    ("O N he|she|it|they must|should|shall|has|have|needs|can|could to|- go|stand|move|come|be|sit|wait W", "O move N W"),
    ("it|that|this would|will|d|might please|suit|help|delight|satisfy|serve me|us that|if|when N he|she|it|they|- goes|go|stands|comes|moves|is|sits|stand|come|move|be|sit|were|was W", "move N W"),
    ("it|that|this would|will|d|might please|suit|help|delight|satisfy|serve me|us that|if|when D A he|she|it|they|- goes|go|stands|comes|is|sits|stand|come|be|sit|were|was W", "add D A W"),
    ("it|there|that|this must|should|shall|has|have|needs to|- be|stand|come|exist|become D A W", "add D A W"),
    ("it|here|there|this|what|something lacks|misses|fails|lack|miss D A", "add D A"),
    ("it|here|there is|are missing|lacking|needed|wanted|absent|required D A", "add D A"),
    ("W it|there|here|- is|are|- lacking|missing|needed|wanted|required|absent|lacks|misses|fails D A", "add D A W"),
    ("W D A is|are|gets|must|should missing|lacking|absent|needed|wanted|required|come|go|stand|be|have", "add D A W"),
    ("D A is|are|gets missing|lacking|absent|needed|wanted|required W", "add D A W"),
    ("i|we|me wish|desire|crave|covet|request|fancy for|- to|- have|see|get|- D A", "add D A"),
    ("i|we|me long|yearn|hope|dream|pray|beg|ask for|of D A", "add D A"),
    ("D A must|should|shall|has|have|needs|need|ought to|- come|go|be|stand|get|belong|appear put|placed|set|built|- W", "add D A W"),
    ("W must|should|shall|has|have|needs|ought to|- come|go|be|stand|appear|get D A", "add D A W"),
    ("W comes|goes|belongs|come|go|belong D A", "add D A W"),
    ("O to put|place|make|add|set|build|plant|bring|do|have|give D A", "O put D A"),
    ("please|kindly to P", "please P"),
    ("you please|kindly to|- P", "please P"),
    ("O do|give|get|whip|knock|rustle|cook up|out|- me|us|- D A W", "O put D A W"),
    ("O make|see|take|be sure|certain|care|to|- it|- that|- D A is|stands|gets|goes|comes|sits|lands placed|put|built|set|- W", "O put D A W"),
    ("O bang|bung|chuck|whack|pop|plonk|plunk|stick|lob|sling|slap|shove|wang|dump|plop|bash|smack|fling|hurl|toss|jam|ram|lash|wallop|clap|hoy|yeet|slam|whop|thump|bosh|stash|dollop in|up|down|out|over|on|- D A W", "O put D A W"),
    // What is to go elsewhere.
    ("O bang|bung|chuck|whack|pop|plonk|plunk|stick|lob|sling|slap|shove|wang|dump|plop|bash|smack|fling|hurl|toss|jam|hoik|hoick|yank|scooch|scoot|budge|hump|heft|schlep|lug|nudge|wedge|hop|jog|shift|slam|stash N over|up|down|across|along|- W", "O move N W"),
    ("O bung|chuck|whack|pop|plonk|sling|shove|hoik|hoick|yank|scooch|scoot|budge|hump|heft|schlep|lug|nudge|shift N over|across|up|along|out|down|- to|towards|toward V", "O move N to V"),
    ("O bring|get|move|put|take|shift|push|nudge|scooch N nearer|closer|near|close to|- V", "O move N closer to V"),
    // Colours.
    ("O give|put|bring|add the|a|some|- colour|color|paint K to|on|onto|for|in N", "O paint N K"),
    ("O give|put|bring|add|slap|splash|brush|spray|smear|roll|throw|chuck|whack|get|daub the|a|some|- bit|lick|coat|splash|layer|dab|touch|dash|- of|- K colour|color|paint|- to|on|onto|over|across|for N", "O paint N K"),
    ("O make|turn|paint|colour|color|dye|do in|with|- K N", "O paint N K"),
    ("O make|paint|colour|color|dye|change N with|to|into|in|as a|the|- K colour|color|paint|-", "O paint N K"),
    ("N should|must|shall|can|could|needs|has|will to|- get|have|receive|take|be of|in|- a|the|some|- K colour|color|paint|coat|tone|look", "paint N K"),
    ("N wants|needs|requires|gets a|the|some|- K colour|color|paint|coat|tone|look", "paint N K"),
    ("O change|switch N its|his|her|their|the|- colour|color to|into|in K", "O paint N K"),
    ("O change|switch the|- colour|color of|from|at|for N to|into|in K", "O paint N K"),
    ("O change|turn|paint|make N from A to|into K", "O paint N K"),
    ("O brush|coat|daub|smear|spray|wash|dip|swab|roll|splash|slap|drench|finish|varnish|lacquer|stain|cover N in|with|- a|the|some|- K colour|color|paint|-", "O paint N K"),
    ("O let|have|make N go|turn|get|shine|glow|appear in|- K", "O paint N K"),
    // What is to be gone.
    ("O make|let|have|get|cause disappear|vanish|go|leave A", "O remove A"),
    ("O make|let|have|get|cause A to|- disappear|vanish|evaporate|dissolve", "O remove A"),
    ("O make|let|have N be|- gone|history", "O remove N"),
    ("i|we|me want|need|like|wish|would no|not A more|longer|anymore|here|there here|there|around|please|-", "remove the A"),
    ("O bump|boot|turf|whisk|hoof|heave|hoick|hoik|shoo|sling|fling|cart|spirit|drag|whip|hustle|kick|throw|chuck|toss|pack|tidy N off|out|away of|from|- here|there|sight|-", "O remove N"),
    ("N can|should|must|may|could go|- take a hike|walk", "remove N"),
    ("N gets|get|deserves|deserve the heave|chop|boot|axe|sack|shove|elbow|push", "remove N"),
    ("O give N the heave|chop|boot|axe|sack|shove|elbow|push", "O remove N"),
    ("O wave N goodbye|bye|farewell", "O remove N"),
    ("O wave goodbye|bye|farewell to N", "O remove N"),
    ("N is|are history|toast", "remove N"),
    ("O make|be sure|certain that|- N is|are|gets|get gone|removed|cleared|deleted|away", "O remove N"),
    ("O see to it that N is|are|gets|get gone|removed|cleared|deleted|away", "O remove N"),
    // Which way something looks.
    ("O make|let|have|get A to|- be|- look|looking|face|facing|point|pointing|turn in|into|to|- the other|opposite|reverse way|direction", "O turn A around"),
    ("O turn|rotate|spin|swivel|twist A that|so he|she|it|they looks|look|faces|face|sees|see|watches|is|are facing|looking|- at|to|towards|- B", "O make A face B"),
    ("O make|let|have|get A to|- be|- looking|gazing|staring|pointing|look|point|gaze|stare at|to|towards|toward|on|into B", "O make A face B"),
    ("O make|let|have|get A to|- be|- facing|face B", "O make A face B"),
    ("O swing|flip|twist|whip|wheel|spin N round|around|about", "O turn N around"),
    ("O swing|flip|twist|whip|wheel|spin round|around|about N", "O turn N around"),
    ("O point|aim|direct|orient|orientate|angle N at|to|towards|toward B", "O make N face B"),
    ("N must|should|shall|could|can|has|have|needs|need to|- be|- looking|facing|pointing|look|gaze|point|stare at|to|towards|toward|into|on B", "make N face B"),
    // Two that change places.
    ("O let|have|make|get A and B change|swap|exchange|trade|switch|swop their|the|- place|places|seat|seats|spot|spots|position|positions|with|- each|one|- other|another|-", "O swap A and B"),
    ("A and B must|should|shall|can|could|need|have|may to|- change|swap|exchange|trade|switch|swop their|the|- place|places|seat|seats|spot|spots|position|positions|with|- each|one|- other|another|-", "swap A and B"),
    ("O switch|swop|swap|exchange|trade|flip A and|with B round|around|over|about|places|place", "O swap A and B"),
    ("O change|switch|swap|exchange A against|by D B", "O replace A with D B"),
    // Copies.
    ("the same H again|anew|twice W", "copy the H W"),
    ("the same H once|one more|again W", "copy the H W"),
    ("one more of N W", "copy N W"),
    ("another of N W", "copy N W"),
    ("O make|do a second|double of|from N W", "O copy N W"),
    // Sizes.
    ("O make|get|do F N", "O make N F"),
    // Streets.
    ("O lift|end|remove|undo|cancel|stop|drop|scrap|revoke|withdraw the closure|closing|closedown|ban of|on|at|in|for|from A", "O open A"),
    ("O let|allow|permit the|- traffic|cars|vehicles|drivers|motorists|lorries to|- go|drive|pass|run|roll|flow|travel|move|- through|along|down|on|over|into|onto A again|anew|-", "O open A"),
    ("traffic|cars|vehicles|drivers can|may|should|must|shall to|- go|drive|pass|run|flow|use|- through|along|down|on|over|into|onto|- A again", "open A"),
];

/// Each sentence by these turns of phrase, if one of them is one.
pub(super) fn in_plain_words(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let told = told_by(lexemes, &[LOOSE]);
    (!is_same(&told, lexemes)).then_some(told)
}

/// Every word of the table, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    LOOSE.iter().flat_map(|(said, _)| said.split([' ', '|'])).filter(|word| word.len() > 1)
}
