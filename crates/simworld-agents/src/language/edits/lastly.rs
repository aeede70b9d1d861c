//! What is tried last of all, where a sentence is refused in every other way: words that sound like known ones, where something stood ("in the
//! scooter's old place"), sides that are told by whose they are ("at the tree's foot"), and turns of phrase in the notation of [`super::turns`].
//!
//! Each comes to plainer words that are heard anew, and counts only if these are granted. So nothing that is understood is read otherwise.

use simworld_core::geometry::Point2;

use super::super::lexer::{Lexeme, is_mark, word_of};
use super::super::lexicon::{longest, longest_phrase};
use super::super::names::Names;
use super::super::phrases::Phrases;
use super::forms::{is_same, word, word_at, words_at};
use super::retold::{Turns, told_by};
use super::stood::point_at;
use super::words::{VERBS, Verb};
use super::{Focus, busy, misspelt, remarked, said_beside, slips};
use crate::editing::Stock;

/// Turns of phrase and what they mean, of one sentence each.
#[rustfmt::skip]
const LASTLY: &Turns = &[
    ("P give A a|one quarter turn Q", "P turn A a quarter turn Q"),
    ("P give A a|one quarter turn", "P turn A a quarter turn"),
    ("P give A a|one half turn", "P turn A around"),
    ("P the business|establishment|firm|premises|outlet|company|joint|enterprise|venue that|which sells|serves|offers B", "P the building that sells B"),
    ("P get D A to pull|draw|drive|roll|cycle up|over|in|- W", "P put D A W"),
    ("P apart|aside from those|the ones|- W", "P except the ones W"),
    ("P bar|save|excluding|excepting|except those|the ones|- W", "P except the ones W"),
    // What six sets of strangers asked for in other words.
    ("for A , please , D B he|she|it|they should|must|shall have near|beside|next|by to|- him|her|it|them", "put D B near A"),
    ("D A , left all alone right|just|directly|- W", "put D A W"),
    ("A has nobody for|to playing|play with|- , make|let come D B near|next|beside of|to|- him|her|it|them", "put D B near A"),
    ("A is ugly|awful|horrid|hideous|horrible , i|we not|dont want to|- see it|him|her|them any|- more|anymore|again", "remove the A"),
    ("P set of wheels Q", "P car Q"),
    ("on my left hand|side|- is|are missing D A", "put D A to the left of me"),
    ("on my right hand|side|- is|are missing D A", "put D A to the right of me"),
    ("O show me|us|- A on a clear|starry B", "O make it a clear B"),
    ("P over to A , right|just|directly|- next|beside|near|by to|- it|him|her|them", "P next to A"),
    ("P over to A , right|just|directly|- next|beside|near|by to|- the trunk|foot|wall|door", "P next to A"),
    ("which of the A is|are B", "list the A that are B"),
    ("P in a ring|circle , all|right|- the way|- round|around A", "P around A"),
    ("P and of A", "P and A"),
    ("O have|let|make A do|make|take|perform a quarter turn B", "O turn A a quarter turn B"),
    ("O have|let|make A do|make|take|perform a half turn", "O turn A around"),
    ("O remove|delete|erase me|myself from A", "O remove me"),
    ("P , just as|like on|in the X", "P"),
    ("how|what about we|i|you|- have|- A gazing|looking|staring|glancing at|towards B", "make A face B"),
    ("id|wed run|put|lay|plant|set D A every|each M B", "put D A every M B"),
    ("i|we want|need|wish D A hanging|standing|sitting|waiting|lying around|- W", "put D A W"),
    ("list A here besides|beside|except|but me", "list A"),
    ("O replant|transplant|rehome A W", "O move A W"),
    ("P the A that|which is|stands drawn|pushed|pulled up|- to B", "P the A next to B"),
    ("A fancies|wants|loves|likes|wishes having|to|- have|- D B at|by his|her|its|their side", "put D B next to A"),
    ("O give A some|- company , D B at|by his|her|its|their side", "O put D B next to A"),
    ("A shall|should|must|will from|- now|- on|- wear|sport K", "paint A K"),
    ("P double A in size Q", "P double A Q"),
    ("P triple A in size Q", "P triple A Q"),
    ("P halve A in size Q", "P halve A Q"),
    ("me|myself|personally , A", "A"),
    ("i|we|id|wed want|wish|like|would|- like|- that A is|are|be|stands|stand not|no more|longer|anymore there|here|around|-", "remove A"),
    ("O crank|turn|push|wind|bring|jump|skip|fast the time|clock|day|hour to|forward|on|ahead|back|- to|- B", "O set the time to B"),
    ("O make vanish|disappear A", "O remove A"),
    ("it would|could|might be|look|feel|- looking|- X if A was|were|had|is|has|became|- having|in|of|- K colour|color|-", "paint A K"),
    ("D A , left|standing|sitting|lying|parked|forgotten|abandoned X|- W", "put D A W"),
    ("we|i need|want X W , D B is|are what i|we was|were|am|are|had thinking|dreaming|in of|about|mind", "put D B W"),
    ("P , it|they|he|she should|will|would|must look like X", "P"),
    ("how|what about a|some|- bit|touch|little|dash|spot of Y rolling|coming|drifting|moving|setting|blowing|- in|up|over|-", "add some Y"),
    ("how|what about some|- Y rolling|coming|drifting|moving|setting|blowing|- in|up|over|-", "add some Y"),
    ("A could|would do with being K instead|rather of|than B", "paint A K"),
    ("A could|would do with being K", "paint A K"),
    ("bucketing|pouring|raining|chucking|tipping it|- down , B", "make it rain"),
    ("O roll|push|drag|haul|bring|carry|wheel|shove D A to M B", "O put D A M B"),
    ("for A must|should|shall come|be|stand D B , directly|right|just|- next|beside|near|by to|- him|her|it|them", "put D B next to A"),
    ("for A D B must|should|shall come|be|stand , directly|right|just|- next|beside|near|by to|- him|her|it|them", "put D B next to A"),
    ("O give A a|another|- lick|coat|splash|dab|touch|layer of K paint|-", "O paint A K"),
    ("O show|picture|film|depict|see|render A in the rain at B", "O make it rain at B"),
    ("O show|picture|film|depict|see|render A in the snow at B", "O make it snow at B"),
    ("O show|picture|film|depict|see|render A in the fog|mist at B", "O make it foggy at B"),
    ("O show|picture|film|depict|see|render A in the rain", "O make it rain"),
    ("O show|picture|film|depict|see|render A in the snow", "O make it snow"),
    ("O show|picture|film|depict|see|render A in the fog|mist", "O make it foggy"),
    ("wouldnt|would|couldnt A look|be X in K", "paint A K"),
    ("P no|not further|farther than M from|off|of B", "P within M of B"),
    ("O make A becoming|become|turn|turning|going|go K", "O paint A K"),
    ("it|- would|might|could be|- not|- be|- bad|good|nice|great|lovely|fine|better if D A is|was|were|would standing|parked|placed|stand|be|- W", "put D A W"),
    ("it|- would|might|could not|- be|- not|- bad|good|nice|great|lovely|fine|better if D A is|was|were|would standing|parked|placed|stand|be|- W", "put D A W"),
    ("i|we|id|wed want|wish|like|would|- like|- that D A is|be|stands|stand|are standing|placed|parked|put|- W", "put D A W"),
    ("P , and no A any more|anymore|longer", "P , and remove the A"),
    ("P , and no A", "P , and remove the A"),
    ("O let|have D A stretch|gather|rest|play|dance|sing|perform|pose|meet|assemble|queue|wait|sit|stand|linger|relax|jog|walk|exercise|practise|work|sleep|nap|read|picnic|chat|camp|graze|bask|loiter|hang just|right|directly|out|around|- W", "O put D A W"),
    ("O let|have somebody|someone|people A W", "O put a person W"),
    ("please you A", "please A"),
    ("O make that|sure|- N has|gets|have|get|receives|is|are of|- the|a|- colour|color|colored|coloured K", "O paint N K"),
    ("A should|ought|must|has|have|needs|need|is|are to|- be|- staring|stare|looking|look|gazing|gaze|glancing|glance|peering|peer|smiling|smile at|towards|toward B", "make A face B"),
    ("A looks|look|seems|seem|is|feels X without D B on|at|to its|his|her|their|the right|- right hand side|-", "put D B to the right of A"),
    ("A looks|look|seems|seem|is|feels X without D B on|at|to its|his|her|their right|right-hand side|flank", "put D B to the right of A"),
    ("A looks|look|seems|seem|is|feels X without D B on|at|to its|his|her|their left|- left hand side|-", "put D B to the left of A"),
    ("A looks|look|seems|seem|is|feels X without D B on|at|to its|his|her|their left|left-hand side|flank", "put D B to the left of A"),
    ("A looks|look|seems|seem|is|feels X without D B in front of it|him|her|them", "put D B in front of A"),
    ("A looks|look|seems|seem|is|feels X without D B behind it|him|her|them", "put D B behind A"),
    ("A looks|look|seems|seem|is|feels X without D B beside|next|by|near to|- it|him|her|them", "put D B next to A"),
    ("P , one|a|each plant|tree|bush|piece|pot|shrub|flower|lamp|post every|each M", "P every M"),
    ("P to|at|on|by|in the back|rear of B", "P behind B"),
    ("O the|my|our|this|- X|- brochure|photo|photograph|picture|film|movie|scene|shot|video|trailer|poster|thriller|script|story|director|novel|postcard photo|shot|picture|scene|- wants|needs|requires|calls|asks|demands|deserves for|- A", "O i want A"),
    ("O give my|the|our|this X a|an Y", "O make it a Y"),
    ("P , and A looking|staring|gazing|facing|turned|pointing at|towards|toward|- V", "P , and make A face V"),
    ("P the X called|named N Q", "P N Q"),
    ("could|would|can do with a|some|another|- lick|coat|splash|dab|touch|layer|drop of K paint|- , N", "paint N K"),
    ("N could|would|can do with a|some|another|- lick|coat|splash|dab|touch|layer|drop of K paint|-", "paint N K"),
    ("N , i|we wish|want|like it|him|her|them to|- be|- here|- no more|longer|gone|away here|-", "remove N"),
    ("the A is|are|looks|will be X , so|- build|erect|construct it|them B", "build a A B"),
    ("the A is|are|looks X , so|- build|erect|construct it|them B", "build a A B"),
    ("W ,|- D A i|we would|will|shall|am|are|- be|- needing|needed|need|want|wanting|require|like|wish", "put D A W"),
    ("bring|take|fetch|get A over|along|here|down|up and|then leave|put|place|set|drop|park it|him|her|them W", "move A W"),
    ("N would|will|could|might look|be|seem so|much|far|way|- much|- good|great|better|best|nice|nicer|lovely|lovelier|pretty|prettier|sweet|sweeter|smart|smarter|smashing|stunning|fantastic|wonderful|brilliant|gorgeous|beautiful|fine|cool|cooler|fun|cheerful|brighter|fresher|happier|jollier|friendlier|warmer|elegant|amazing|superb|perfect|splendid|inviting off|- in|if|when painted|- K", "paint N K"),
    ("N would|will|could|might look|be|seem good|great|better|best|nice|nicer|lovely|lovelier|pretty|prettier|sweet|sweeter|smart|smarter|smashing|stunning|fantastic|wonderful|brilliant|gorgeous|beautiful|fine|cool|cooler|fun|cheerful|brighter|fresher|happier|jollier|friendlier|warmer|elegant|amazing|superb|perfect|splendid|inviting in|if|when painted|- K", "paint N K"),
    ("the|my|our X shows|show|has|have|includes|include|foresees|specifies|calls for|- D A , evenly spaced|spread B", "put D A evenly spaced B"),
    ("the|my|our X shows|has|includes|foresees|specifies|calls for|- D A W", "put D A W"),
    ("if a|an|any A stands|is|sits|exists|lives|lies anywhere|somewhere in|on|around|- this|the|our|- X , C", "if there is a A , C"),
    ("if a|an|any A stands|is|sits|exists|lives|lies anywhere|somewhere , C", "if there is a A , C"),
    ("N , is it|would possible|ok|okay to have|get|see this|it|that|them|him|her in K", "paint N K"),
    ("N , can|could|may i|we have|get|see this|it|that|them|him|her in K", "paint N K"),
    ("W , i think|guess|suppose|believe|imagine|feel , D A would|could|might|will look|be|do|work|suit X", "put D A W"),
    ("W , D A would|could|might|will look|be|do|work|suit X", "put D A W"),
    ("the|my|our X wishes|wants|longs|hopes|wish|want|hope|would like|- to see|have|get|build|install|put a|an A", "add a A"),
    ("somebody|someone|he|she|they|i|we left|forgot|dropped|parked|lost|abandoned D A W", "put D A W"),
    ("O close|shut|block all of A", "O close A"),
    ("O open|reopen all of A", "O open A"),
    ("W ,|- D A is|are to be installed|placed|built|planted|erected|added|parked|provided|set up|-", "put D A W"),
    // What sells something.
    ("O list|show|name|tell|give me|us|- every|each|all|any|- the|- building|buildings|place|places|house|houses|anywhere|spot|spots|everything that|which|where|- you|they|people|one|i|we|- can|could|- sells|sell|buy|get|find|offers|offer|serves|serve B", "list the buildings that sell B"),
    ("O list|show|name|tell|give me|us|- every|each|all|any|- the|- shop|shops|store|stores that|which|- sells|sell|offers|offer|serves|serve B", "list the shops that sell B"),
    ("how many buildings|places|houses|spots that|which|- sell|sells|offer|offers|serve|serves B", "how many buildings that sell B are there"),
    ("O count the|all|- buildings|places|houses|spots that|which|- sell|sells|offer|offers|serve|serves B", "how many buildings that sell B are there"),
    ("be a|an dear|angel|darling|sweetheart|love|star|sport|pal|saint and P", "P"),
    // New things that somebody would be glad of, or sorry to be without.
    ("it|that would|might be a|such|- a|- shame|pity|crime|sin|waste not to|- to|not have|see|put|get|add|build D A", "add D A"),
    ("A would|might thank us|me|you|everybody|everyone for D B W", "add D B W"),
    ("A would|might surely|certainly|really|- appreciate|welcome D B W", "add D B W"),
    // Where somebody or something is to be.
    ("mister|mr|mrs|miss|ms A , he|she must|should|shall|has|have|needs|wants to|- go|come|walk|move|run|- and|to|- be|stand|go|sit|wait|stay|- over|down|right|- W", "move A W"),
    ("N , it|he|she|they must|should|shall|has|have|needs|wants to|- go|come|walk|move|run|- and|to|- be|stand|go|sit|wait|stay|- over|down|right|- W", "move N W"),
    // Farewells.
    ("K H , bye|goodbye|farewell|adios bye|-", "remove the K H"),
    ("N , bye|goodbye|farewell|adios bye|-", "remove N"),
    ("O he belongs|goes|should|must|shall|wants|has|ought|needs to|- be|stand|go|sit|wait|stay|come|move|belong|live|- over|down|right|- W", "O move him W"),
    ("O she belongs|goes|should|must|shall|wants|has|ought|needs to|- be|stand|go|sit|wait|stay|come|move|belong|live|- over|down|right|- W", "O move her W"),
    ("O it|that|this belongs|goes|should|must|shall|wants|has|ought|needs to|- be|stand|go|sit|stay|come|move|belong|live|- over|down|right|- W", "O move it W"),
    ("O they|those|these belong|go|should|must|shall|have|ought|need to|- be|stand|go|sit|wait|stay|come|move|belong|live|- over|down|right|- W", "O move them W"),
    ("O N wants|likes|prefers|longs|deserves|loves to be|stand|go|sit|live|stay|rest|lie|move|sleep over|up|down|back|- W", "O move N W"),
    ("O D A wants|likes|prefers|deserves|needs to be|stand|go|sit|live|stay|rest W", "O add D A W"),
    ("O set|put|lay|place|stand|drop|park|plonk N down W", "O move N W"),
    ("O set|put|lay|place|stand|drop|park|plonk D A down W", "O put D A W"),
    ("O erect|install|instal|plant|mount|plonk|bung|chuck|whack|stick N down|up|over|- W", "O move N W"),
    ("O could|can|might|may we|i please|- have|get|see N over|- W", "O move N W"),
    ("O id|wed like|love to|- see|have|- N over|- W", "O move N W"),
    ("O i|we would like|love to|- see|have|- N over|- W", "O move N W"),
    ("O put|place|add|set|build|plant|park|install|stick|plonk D A in|at|on place|stead|lieu of N", "O replace N with D A"),
    ("O have|let|make|get N to|- face|view V", "O make N face V"),
    ("O have|let|make|get N to|- look|point|gaze at|to|towards|toward V", "O make N face V"),
    // A little way.
    ("O scoot|scooch|shift|move|budge|shove|nudge|slide over|along|up|across N W", "O move N W"),
    ("O bring|move|push|pull|shift|scoot|nudge|slide closer|nearer N to V", "O move N closer to V"),
    ("O push|move|pull|shift|set|nudge|slide|scoot|shove N back|backwards|backward by|- M", "O move N M back"),
    ("O push|move|pull|shift|set|nudge|slide|scoot|shove back N by|- M", "O move N M back"),
    ("O push|move|pull|shift|bring|nudge|slide|scoot|shove N forward|forwards by|- M", "O move N M forward"),
    ("O push|move|pull|shift|bring|nudge|slide|scoot|shove forward|forwards N by|- M", "O move N M forward"),
    ("O blow|scale|size|bump N up F", "O make N F"),
    ("O blow|scale|size|bump up N F", "O make N F"),
    ("O blow|scale|size|bump N up to twice|double", "O make N twice as big"),
    ("O blow|scale|size|bump up N to twice|double", "O make N twice as big"),
    ("O shrink|scale|cut|reduce|trim N down F", "O make N F"),
    ("O shrink|scale|cut|reduce|trim down N F", "O make N F"),
    ("O enlarge|magnify|grow|inflate|expand|upscale|shrink|reduce N F", "O make N F"),
    // About-turns.
    ("O give N an|a about turn|face", "O turn N around"),
    ("O have|let|make N do|make|take|perform|- an|a about turn|face", "O turn N around"),
    ("O N should|must|has|needs|could|can|to to|- do|make|take an|a about turn|face", "O turn N around"),
    ("O about turn|face N", "O turn N around"),
    ("O an|- about turn|face for|of N", "O turn N around"),
    ("O turn|spin|swing N about face|turn|-", "O turn N around"),
    // What goes, and what comes instead.
    ("O swap|switch|change|trade out N for|with D A", "O replace N with D A"),
    ("O swap|switch|change|trade N out for|with D A", "O replace N with D A"),
    ("O chuck|toss|sling|dump|lose|bin N", "O remove N"),
    ("N needs|has|ought|wants to go|vanish|disappear|leave", "remove N"),
    ("N can|may|must go|vanish|disappear|leave now|-", "remove N"),
    // Proposals.
    ("O knock|rig|throw|cobble|slap|whip D A up|together W", "O put D A W"),
    ("what if there was|were|is|are D A", "add D A"),
    ("what if we|i|you had|got|put|added|placed|built|planted|stuck|parked|installed|erected D A", "add D A"),
    ("what if N was|were|stood|sat|went W", "move N W"),
    ("what if N was|were K", "paint N K"),
    ("what if we|i|you moved|shifted|pushed|put|placed|nudged N W", "move N W"),
    ("what if we|i|you painted|made N K", "paint N K"),
    ("what if we|i|you removed|scrapped|ditched|deleted|binned|dropped|lost N", "remove N"),
    ("what if we|i|you got rid of N", "remove N"),
    ("wouldnt|would|couldnt it|that be X if there was|were|is D A", "add D A"),
    ("wouldnt|would|couldnt it|that be X if we|i|you|they had|got|put|added|placed|built|planted|parked D A", "add D A"),
    ("wouldnt|would|couldnt it|that be X if N was|were|stood|sat|went W", "move N W"),
    ("wouldnt|would|couldnt it|that be X if N was|were K", "paint N K"),
    ("wouldnt|would|couldnt it|that be X to have|see|get|add|put D A", "add D A"),
    ("how|what about moving|shifting|putting|placing|pushing N W", "move N W"),
    ("how|what about painting|making N K", "paint N K"),
    ("how|what about removing|ditching|scrapping|binning|deleting|losing N", "remove N"),
    ("how|what about getting rid of N", "remove N"),
    ("how|what about putting|adding|placing|building|planting|having D A", "add D A"),
    ("how|what about D A W", "add D A W"),
    // A thing that is fine where it is not too far, or not too near.
    ("D A is|are|was|would|will|can be|- fine|ok|okay|welcome|good|alright|acceptable|allowed , but|only|just|- not|no|never more|farther|further than M away|- from|of|off B", "put D A within M of B"),
    ("D A is|are|was|would|will|can be|- fine|ok|okay|welcome|good|alright|acceptable|allowed , but|only|just|- at most|maximum M away|- from|of|off B", "put D A within M of B"),
    ("D A is|are|was|would|will|can be|- fine|ok|okay|welcome|good|alright|acceptable|allowed , but|only|just|- within M of|from B", "put D A within M of B"),
    ("D A is|are|was|would|will|can be|- fine|ok|okay|welcome|good|alright|acceptable|allowed , but|only|just|- at least|minimum M away|- from|of|off B", "put D A at least M from B"),
    ("D A is|are|was|would|will|can be|- fine|ok|okay|welcome|good|alright|acceptable|allowed , but|only|just|- not|no|never less|closer|nearer than M away|- from|of|off|to B", "put D A at least M from B"),
    // What would make people sleep better.
    ("i|we|they|you|people|everybody|everyone would|d|could|might all|both|also|surely|- be|feel|sleep|rest|work|breathe|live|eat|sit|look|walk so|very|much|far|a|- lot|bit|- more|- better|happier|safer|easier|calmer|glad|happy|delighted|grateful|pleased|thrilled|overjoyed|comfortable|comfortably|soundly|peacefully ,|- if D A was|were|stood|sat|went|lay|hung W", "put D A W"),
    ("i|we|they|you|people|everybody|everyone would|d|could|might all|both|also|surely|- be|feel|sleep|rest|work|breathe|live|eat|sit|look|walk so|very|much|far|a|- lot|bit|- more|- better|happier|safer|easier|calmer|glad|happy|delighted|grateful|pleased|thrilled|overjoyed|comfortable|comfortably|soundly|peacefully ,|- if N was|were|stood|sat|went|lay|hung W", "move N W"),
    ("i|we|they|you|people|everybody|everyone would|d|could|might all|both|also|surely|- be|feel|sleep|rest|work|breathe|live|eat|sit|look|walk so|very|much|far|a|- lot|bit|- more|- better|happier|safer|easier|calmer|glad|happy|delighted|grateful|pleased|thrilled|overjoyed|comfortable|comfortably|soundly|peacefully ,|- if N was|were painted|- in|- K", "paint N K"),
    ("id|wed|theyd|youd all|both|also|surely|- be|feel|sleep|rest|work|breathe|live|eat|sit|look|walk so|very|much|far|a|- lot|bit|- more|- better|happier|safer|easier|calmer|glad|happy|delighted|grateful|pleased|thrilled|overjoyed|comfortable|comfortably|soundly|peacefully ,|- if D A was|were|stood|sat|went|lay|hung W", "put D A W"),
    ("id|wed|theyd|youd all|both|also|surely|- be|feel|sleep|rest|work|breathe|live|eat|sit|look|walk so|very|much|far|a|- lot|bit|- more|- better|happier|safer|easier|calmer|glad|happy|delighted|grateful|pleased|thrilled|overjoyed|comfortable|comfortably|soundly|peacefully ,|- if N was|were|stood|sat|went|lay|hung W", "move N W"),
    // What somebody would rather see.
    ("my|our|the|his|her|their|- eyes|heart|soul|mother|mum|father|dad|wife|husband|boss|mayor|daughter|son|granny|grandmother|kids|children|neighbours|customers|guests|visitors|i|we|everybody|everyone|she|he|they|people would|d much|far|really|- rather|sooner|prefer to|- see|have|find|get|- N painted|- in|- K", "paint N K"),
    ("id|wed|theyd|shed|hed much|far|really|- rather|sooner|prefer to|- see|have|find|get|- N painted|- in|- K", "paint N K"),
    ("my|our|the|his|her|their|- eyes|heart|soul|mother|mum|father|dad|wife|husband|boss|mayor|daughter|son|granny|grandmother|kids|children|neighbours|customers|guests|visitors|i|we|everybody|everyone|she|he|they|people would|d much|far|really|- rather|sooner|prefer to|- see|have|find|get|- N W", "move N W"),
    // Who learns the language.
    ("me|i|we|us wanting|want|wants|needing|need|needs|wish|wishing|wishes|liking|like that|- B has|have|having|gets|get|own|owns D A ,|- at|on|to|by the|his|her|its|their|- left|right side|hand|- of|from|by|- him|her|it|them please|-", "put D A to the left of B"),
    ("me|i|we|us wanting|want|wants|needing|need|needs|wish|wishing|wishes|liking|like that|- B has|have|having|gets|get|own|owns D A ,|- behind him|her|it|them please|-", "put D A behind B"),
    ("me|i|we|us wanting|want|wants|needing|need|needs|wish|wishing|wishes|liking|like that|- B has|have|having|gets|get|own|owns D A ,|- beside|near|next|close|by to|- him|her|it|them please|-", "put D A next to B"),
    ("me|i|we|us wanting|want|wants|needing|need|needs|wish|wishing|wishes|liking|like that|- B has|have|having|gets|get|own|owns D A ,|- in front of him|her|it|them please|-", "put D A in front of B"),
    ("B he|she|it|they is|are|was|were|- needing|needs|need|wanting|wants|want|wishing|wishes|requiring|requires|missing|lacking D A ,|- at|on|to|by the|his|her|its|their|- left|right side|hand|- of|from|by|- him|her|it|them please|-", "put D A to the left of B"),
    ("B he|she|it|they is|are|was|were|- needing|needs|need|wanting|wants|want|wishing|wishes|requiring|requires|missing|lacking D A ,|- behind him|her|it|them please|-", "put D A behind B"),
    ("B he|she|it|they is|are|was|were|- needing|needs|need|wanting|wants|want|wishing|wishes|requiring|requires|missing|lacking D A ,|- beside|near|next|close|by to|- him|her|it|them please|-", "put D A next to B"),
    ("B he|she|it|they is|are|was|were|- needing|needs|need|wanting|wants|want|wishing|wishes|requiring|requires|missing|lacking D A ,|- in front of him|her|it|them please|-", "put D A in front of B"),
    // Colours behind what has them.
    ("O remove|delete the X K", "O remove the K X"),
];
/// Before a noun.
const DETERMINERS: &Phrases = &Phrases::of(&["the", "that", "this", "my", "our"]);
/// Before a place that is told by whose it is.
const LEADS: &Phrases = &Phrases::of(&["in", "at", "on", "to", "into", "by", "near", "beside"]);
/// A place that something had.
const OLD: &Phrases = &Phrases::of(&["old", "former", "previous", "last", "original", "earlier"]);
const PLACE: &Phrases = &Phrases::of(&["place", "spot", "position", "location", "corner", "site"]);
/// Behind "where" and a thing, that it is no longer there.
#[rustfmt::skip]
const STOOD: &Phrases = &Phrases::of(&["was", "were", "stood", "used to be", "used to stand", "used to sit", "used to lie", "had been", "had stood", "lay", "sat", "was before", "was standing", "has been", "has stood"]);
/// The parts of a thing at which something may stand, and where that is.
#[rustfmt::skip]
const SIDES: &[(&[&str], &str)] = &[
    (&["foot", "feet", "base", "side", "flank"], "next to"), (&["front", "front side", "face", "entrance"], "in front of"), (&["back", "rear", "back side"], "behind"),
    (&["left", "left side", "left hand", "left hand side"], "to the left of"), (&["right", "right side", "right hand", "right hand side"], "to the right of"),
    (&["top"], "on top of"), (&["corner"], "at the corner of"), (&["edge", "rim"], "at the edge of"), (&["middle", "centre", "center", "heart"], "in the middle of"),
];
/// As many words stand at most between a word of place and whose place it is.
const LONGEST: usize = 4;

/// What a sentence may have been meant to say, in plainer words, the nearest first.
pub(super) fn ways(
    words: &str,
    heard: &[Lexeme],
    names: &Names<'_>,
    stock: &Stock,
    focus: &Focus,
) -> Vec<Vec<Lexeme>> {
    let spelt = slips::corrected(words, heard, names, stock, &focus.streets);
    let by_sound = |lexemes: &[Lexeme]| slips::by_sound(words, lexemes, names, stock, &focus.streets);
    // A slip that was put right by its letters may have been one of sound.
    let sounded = by_sound(&spelt).or_else(|| by_sound(heard));
    let plain = sounded.clone().unwrap_or(spelt);
    let placed = in_old_places(words, &plain, focus).or_else(|| at_its_side(words, &plain));
    let told = told_by(placed.as_deref().unwrap_or(&plain), &[LASTLY]);
    let is_told = !is_same(&told, placed.as_deref().unwrap_or(&plain));
    // What reads like a wish and asks for nothing, and assets whose words are misspelt.
    let named = misspelt::in_plain_spelling(heard, stock);
    let beside =
        said_beside::without(named.as_deref().unwrap_or(&plain)).or_else(|| said_beside::without(heard));
    // A word of these turns that nobody else says may have been taken for a slip: "wanting".
    let unspelt = told_by(heard, &[LASTLY]);
    let is_unspelt = !is_same(&unspelt, heard);
    let rest = beside.as_deref().or(named.as_deref()).map(|rest| told_by(rest, &[LASTLY]));
    let remarked = remarked::without(&plain, names).or_else(|| remarked::without(heard, names));
    let told_besides = remarked.as_deref().map(|rest| told_by(rest, &[LASTLY]));
    let busy = busy::in_plain_words(heard).or_else(|| busy::in_plain_words(&plain));
    let ways = sounded.into_iter().chain(placed).chain(is_told.then_some(told));
    let ways = ways.chain(is_unspelt.then_some(unspelt)).chain(busy).chain(remarked).chain(told_besides);
    ways.chain(beside).chain(named).chain(rest).collect()
}

/// A sentence by the turns of phrase that are tried last.
pub(super) fn in_other_words(lexemes: &[Lexeme]) -> Vec<Lexeme> {
    told_by(lexemes, &[LASTLY])
}

/// "In the scooter's old place", "where the scooter used to stand": where it stood within the sentence, or before it was moved or taken away by an
/// earlier one.
fn in_old_places(words: &str, lexemes: &[Lexeme], focus: &Focus) -> Option<Vec<Lexeme>> {
    (0..lexemes.len()).find_map(|at| {
        let (noun, end) = whose_old_place(words, lexemes, at).or_else(|| where_it_stood(lexemes, at))?;
        let mut told = lexemes.to_vec();
        let place = &lexemes[at];
        if is_told_before(lexemes, at, &noun) {
            let stood = words_at(place, "where").chain(noun).chain(words_at(place, "stood"));
            told.splice(at..end, stood.collect::<Vec<_>>());
            return (!is_same(&told, lexemes)).then_some(told);
        }
        let point = left_by(focus, word_of(noun.last()?))?;
        told.splice(at..end, point_at(place, point));
        Some(told)
    })
}

/// "In the scooter's old place": the scooter, and where the words end.
fn whose_old_place(words: &str, lexemes: &[Lexeme], at: usize) -> Option<(Vec<Lexeme>, usize)> {
    let (noun, behind) = whose(words, lexemes, at)?;
    let old = longest_phrase(&lexemes[behind..], OLD)?;
    let place = longest_phrase(lexemes.get(behind + old..)?, PLACE)?;
    Some((noun, behind + old + place))
}

/// "Where the scooter used to stand": the scooter, and where the words end.
fn where_it_stood(lexemes: &[Lexeme], at: usize) -> Option<(Vec<Lexeme>, usize)> {
    if word(lexemes, at) != "where" {
        return None;
    }
    longest_phrase(lexemes.get(at + 1..)?, DETERMINERS)?;
    (at + 3..lexemes.len().min(at + 2 + LONGEST)).find_map(|from| {
        let end = from + longest_phrase(&lexemes[from..], STOOD)?;
        let is_end = lexemes.get(end).is_none_or(is_mark) || ["and", "please"].contains(&word(lexemes, end));
        is_end.then(|| (lexemes[at + 1..from].to_vec(), end))
    })
}

/// "At the tree's foot" is next to the tree.
fn at_its_side(words: &str, lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    (0..lexemes.len()).find_map(|at| {
        let (noun, behind) = whose(words, lexemes, at)?;
        let (way, side) = longest(lexemes.get(behind..)?, SIDES)?;
        let end = behind + side;
        let is_end =
            lexemes.get(end).is_none_or(is_mark) || ["and", "please", "then"].contains(&word(lexemes, end));
        let mut told = lexemes.to_vec();
        let way = words_at(&lexemes[at], way).chain(noun);
        is_end.then(|| {
            told.splice(at..end, way.collect::<Vec<_>>());
            told
        })
    })
}

/// "In the scooter's": whose something is, behind a word of place, and where what that is begins.
fn whose(words: &str, lexemes: &[Lexeme], at: usize) -> Option<(Vec<Lexeme>, usize)> {
    let from = at + longest_phrase(&lexemes[at..], LEADS)?;
    let last = (from..lexemes.len().min(from + LONGEST)).find(|last| {
        let lexeme = &lexemes[*last];
        let written = words.get(lexeme.start..lexeme.end).unwrap_or_default();
        word_of(lexeme).ends_with('s') && ["'s", "’s", "s'", "s’"].iter().any(|end| written.ends_with(*end))
    })?;
    let owner = word_of(&lexemes[last]).strip_suffix('s').filter(|owner| !owner.is_empty())?;
    let mut noun = lexemes[from..last].to_vec();
    noun.push(word_at(&lexemes[last], owner));
    (!noun.iter().any(is_mark) && last + 1 < lexemes.len()).then_some((noun, last + 1))
}

/// Whether a thing is named before a word, in an order that moves it or takes it away.
fn is_told_before(lexemes: &[Lexeme], at: usize, noun: &[Lexeme]) -> bool {
    let is_moved = |from: usize| {
        longest(&lexemes[from..at], &VERBS)
            .is_some_and(|(verb, _)| matches!(verb, Verb::Move | Verb::Remove | Verb::Put | Verb::Take))
    };
    let is_named =
        |from: usize| noun.last().is_some_and(|noun| word(lexemes, from) == word_of(noun) && from > 0);
    (0..at).any(is_moved) && (0..at).any(is_named)
}

/// Where the last thing stood that was moved or taken away and is called so.
fn left_by(focus: &Focus, noun: &str) -> Option<Point2> {
    let is_called = |name: &str| name.split([' ', '_']).any(|word| word == noun);
    focus.left.iter().rev().find(|(name, _)| is_called(name)).map(|(_, at)| *at)
}
