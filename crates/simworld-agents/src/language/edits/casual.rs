//! Turns of phrase of people who talk as it comes to them, and what they mean, in the notation of [`super::turns`]: the place first and
//! what is wanted there behind it ("across from the lab, yes, that's where I'd park a food truck"), sizes and turns as the subject ("three times
//! the size would do the statue good", "half a turn for the truck"), gaps told by themselves ("leave ten metres free, and there put ...").
//!
//! They are put plainly before anything is read, for by their parts they would be misunderstood. A sentence that is no turn as a whole is
//! looked at between its commas with "and" behind them.

use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::longest_phrase;
use super::retold::{Turns, before_kind_words, by_turn, last_mark, sentences};

/// Turns of phrase and what they mean, of one sentence each.
#[rustfmt::skip]
const CASUAL: &Turns = &[
    // Gaps.
    ("W please|- leave|keep|allow|have|make a|- gap|space|distance|margin|clearance of M ,|- and|then right|exactly|just|- there|then|behind|- there|- i|we|- please|- put|place|add|want|park|plant|build|set|need|stand|place D A there|-", "put D A M W"),
    ("W please|- leave|keep|allow|have M of|- free|empty|clear|open|space|room|air|distance|gap ,|- and|then right|exactly|just|- there|then|behind|- there|- i|we|- please|- put|place|add|want|park|plant|build|set|need|stand D A there|-", "put D A M W"),
    ("please|- leave|keep|allow|have|make a|- gap|space|distance|margin|clearance of M W ,|- and|then right|exactly|just|- there|then|behind|- there|- i|we|- please|- put|place|add|want|park|plant|build|set|need|stand D A there|-", "put D A M W"),
    ("please|- leave|keep|allow|have M of|- free|empty|clear|open|space|room|air|distance|gap W ,|- and|then right|exactly|just|- there|then|behind|- there|- i|we|- please|- put|place|add|want|park|plant|build|set|need|stand D A there|-", "put D A M W"),
    ("with|at|leaving|keeping M of|- room|space|distance|gap|clearance|air|free|empty|apart in|- between|- them|- , O put|place|add|set|want|plant|build|park|stand|need D A W", "O put D A M W"),
    ("with|at|leaving|keeping a gap|space|distance|margin|clearance of M in|- between|- them|- , O put|place|add|set|want|plant|build|park|stand|need D A W", "O put D A M W"),
    ("O put|place|add|set|plant|build|park|stand D A W ,|- with|leaving|keeping M of|- room|space|distance|clearance|air|free|empty in|- between|- them|-", "O put D A M W"),
    // The place first.
    ("O somewhere|someplace|right|exactly|- W , yes|yeah|yep|indeed|oh|- ,|- thats|that|thatd|it|its|there is|would|d|be|- be|- exactly|just|precisely|- where id|wed|i|we|you|theyd|one|they would|d|could|can|should|shall|may|will|- picture|imagine|envision|envisage|put|place|park|set|build|plant|add|stand|hide|hang|erect|raise|stick|locate|position|leave|install|want|need|see D A", "O put D A W"),
    ("O somewhere|someplace|right|exactly|- W , yes|yeah|yep|indeed|oh|- ,|- thats|that|thatd|it|its|there is|would|d|be|- be|- exactly|just|precisely|- where id|wed|i|we|you|theyd|one|they would|want|need|- like|love|want|- to|- see|have|put|place|park|set|build|plant|add|stand|hide|erect|raise|stick|install D A", "O put D A W"),
    ("O somewhere|someplace|right|exactly|- W , yes|yeah|yep|indeed|oh|- ,|- thats|that is|- exactly|just|- where D A should|must|could|would|ought|has|is|needs|belongs|goes|fits to|- go|stand|be|belong|fit|-", "O put D A W"),
    ("O somewhere|someplace|right|exactly|- W , yes|yeah|yep|indeed|oh|- ,|- thats|that|thatd|its|it|there is|would|d|be|- be|- exactly|just|- the|a|- perfect|right|ideal|good|best|very|- spot|place|location|position|home|corner for D A", "O put D A W"),
    ("O somewhere|someplace|- W ,|- somebody|someone|anybody|people could|can|should|must|might|may|shall|ought|will|has|have|needs|need to|- please|kindly|- hide|raise|put|place|build|erect|park|plant|install|add|set|stand|stick|hang|locate|position|pop|plonk|tuck|squeeze|fit|construct|drop|lay up|in|down|- D A", "O put D A W"),
    ("O somewhere|someplace|- W ,|- i|we|you|they|one|id|wed|youd|theyd|lets would|could|can|should|might|may|shall|ought|will|d|- to|rather|gladly|love|like|- to|- hide|raise|put|place|build|erect|park|plant|install|add|set|stand|stick|hang|locate|position|pop|plonk|tuck|squeeze|fit|construct|drop|lay|construct up|in|down|- D A", "O put D A W"),
    ("O somewhere|someplace|- W ,|- have|let|get|make D A wait|stand|sit|stay|pose|rest|sleep|play|lie|queue|perform|live|grow|bloom|be|work|relax there|-", "O put D A W"),
    ("O somewhere|someplace|- W ,|- the|our|my|these|those|some|many|all A are|is|were|was|keep|keeps wishing|hoping|asking|longing|dreaming|begging|praying|pleading|waiting|craving for|of|- D B", "O put D B W"),
    ("O somewhere|someplace|- W ,|- D A would be|look|feel|seem|come|do welcome|appreciated|useful|handy|wonderful|lovely|nice|great|perfect|good|brilliant|fantastic|super|sweet|ideal|fitting|fine|well|beautiful|natural|right|wonders indeed|too|there|please|-", "O put D A W"),
    ("W theres|there|we|i|youve|weve is|was|have|got|still|remains|- still|- some|a|an|so|loads|plenty|heaps|enough|- much|lot|lots|plenty|bit|of|- of|- nice|empty|free|open|unused|spare|big|perfect|good|lovely|bare|- space|room|spot|gap|corner|area|patch|place left|there|free|- , so|and|- please|- how|what|lets|we|i|you|could|can|why|id|wed|- about|have|could|can|would|not|dont|like|- you|we|i|- put|add|place|set|stick|plant|build|park|stand|pop|plonk|want|need|have|like|- D A there|-", "put D A W"),
    // A size, a turn or a colour as the subject.
    ("F , thats|that|its|thatd|it is|would|be|- be|- exactly|just|- how|what|the|as size|way|- big|large|tall|- i|we|id|wed|you would|d|- want|need|like|wish|picture|imagine|see|prefer|love to|- see|have|- N to|- be|look|-", "make N F"),
    ("F , thats|that|its|thatd|it is|would|be|- be|- exactly|just|- how|what|the|as size|way|- big|large|tall|- N should|must|ought|has|needs|could|would|is|wants|shall to|- be|become|get|grow|look", "make N F"),
    ("K , thats|that|its|thatd|it is|would|be|- be|- exactly|just|- how|what|the colour|color|way|- i|we|id|wed|you would|d|- want|need|like|wish|picture|imagine|see|prefer|love to|- see|have|- N to|- be|in|look|-", "paint N K"),
    ("K , thats|that|its|thatd|it is|would|be|- be|- exactly|just|- how|what|the colour|color|way|- N should|must|ought|has|needs|could|would|is|wants|shall to|- be|become|get|have|look", "paint N K"),
    ("K , thats|that|thatd|its is|would|- be|- the|a right|perfect|best|- colour|color for N", "paint N K"),
    ("i|we|- think|guess|believe|feel|reckon|- that|- F would|might|could|will|may do|suit|be|look|fit|become N good|well|nicely|better|justice|a|- favour|favor|world|power|- of|- good|-", "make N F"),
    ("i|we|- think|guess|believe|feel|reckon|- that|- F would|might|could|will|may be|look|feel good|great|nice|better|right|perfect|fine for|on N", "make N F"),
    ("a|one|- quarter turn|rotation|spin to|towards the|its|his|her left|right for|on|of|to A", "turn A a quarter turn to the left"),
    ("a|one|- quarter turn|rotation|spin X for|on|of|to A", "turn A a quarter turn X"),
    ("a|one|- quarter turn|rotation|spin for|on A", "turn A a quarter turn"),
    ("a|- half a|- turn|rotation|spin for|on A", "turn A half a turn"),
    ("X degrees to|towards the|its|his|her left|right for|on A", "turn A X degrees to the left"),
    ("X degrees for|on A", "turn A X degrees"),
    // Names.
    ("from|starting|as now|today|tomorrow|of on|now|today|onwards|onward|- ,|- N is|has|needs|ought|shall|will|should|must|can to|- be called|named|known|renamed as|to|- B", "name N as B"),
    ("N is|has|needs to be called|named|renamed|known as|to|- B from now on|-", "name N as B"),
    // Wishes with "that".
    ("O i|we want|wish|demand|insist|ask|need that|- there is|are|be|was|were|exists|exist|stands|stand|comes|come D A", "O put D A"),
    ("O i|we would|should like|love|prefer|wish|want it|- that|if|- there is|are|be|was|were|exists|exist|stands|stand|comes|come D A", "O put D A"),
    ("O id|wed like|love|prefer|wish|want it|- that|if|- there is|are|be|was|were|exists|exist|stands|stand|comes|come D A", "O put D A"),
    ("O i|we|id|wed want|wish|would|like|demand|prefer|ask|insist like|prefer|wish|- that D A is|are|be|stands|stand|sits|sit|grows|goes standing|sitting|placed|parked|put|growing|waiting|- W", "O put D A W"),
    ("O i|we|id|wed want|wish|would|like|demand|prefer|ask|insist like|prefer|wish|- that A is|are|be|stands|stand|sits|sit|goes|go|moves|waits standing|sitting|placed|parked|waiting|moved|put|- W", "O move A W"),
    ("O i|we|id|wed want|wish|would|like|demand|prefer|ask|insist like|prefer|wish|- that A is|are|be|becomes|gets painted|- K", "O paint A K"),
    ("O i|we|id|wed want|wish|would|like|demand|prefer|ask|insist like|prefer|wish|- that A is|are|be|becomes|gets|grows F", "O make A F"),
    ("O i|we am|are wanting|wishing|hoping that|for G is|are|be|should|shall|to be|- looking|facing|turned|staring|gazing at|to|towards|toward|- B , thank|thanks|please you|-", "make G face B"),
    ("O i|we am|are wanting|wishing|hoping that|for G is|are|be|should|shall|to be|- looking|facing|turned|staring|gazing at|to|towards|toward|- B", "make G face B"),
    ("it|that would|will please|suit|delight|gladden|help me|us|- that|if N it|he|she|they|- goes|go|stands|stand|moves|move|comes|come|were|was|is W", "move N W"),
    ("O bring|take|move|push|drag|carry|pull|shift N over|across|up|down|back|- to B , right|just|directly|close|immediately|- next|beside|close|by to|- it|him|her|them|there", "move N next to B"),
    ("it|- is|its high|about|- time that|- N went|goes|disappeared|vanished|left|disappears|leaves", "remove N"),
    ("it|- is|its high|about|- time that|- N was|were|is|got|gets|are removed|gone|deleted|scrapped|cleared away|-", "remove N"),
    ("it|- is|its high|about|- time that|- N was|were|got|became|is|gets painted|- K", "paint N K"),
    ("it|- is|its high|about|- time for N to go|disappear|leave|vanish", "remove N"),
    // What goes.
    ("N is|are no longer|more needed|required|wanted|necessary|useful|used here|- ,|- so|and|- please|you|- can|may|please|- remove|delete|take|get|throw|scrap|clear|bin|rid it|them|him|her|that of|away|out|- please|-", "remove N"),
    ("N isnt|arent needed|required|wanted|necessary|useful|used any|- more|longer|anymore|- here|- , so|and|- please|you|- can|may|please|- remove|delete|take|get|throw|scrap|clear|bin|rid it|them|him|her|that of|away|out|- please|-", "remove N"),
    ("all of|- the|these|those|our|- A can|must|should|may|have|has|could|shall|will|need|are to|- go|leave|disappear|vanish|be|get removed|deleted|cleared|gone|scrapped|away|- , and|but|- only|just|except B stays|stay|remains|remain|is|are|can|may|should|must|shall to|- stay|remain|kept|spared|left|-", "remove all the A except B"),
    ("except for|- B , all the|our|these|those|- A are|should|must|can|may|have|need|ought|could to|- be|go|leave|disappear|get removed|deleted|cleared|scrapped|gone|away|-", "remove all the A except B"),
    ("except for|- B , all the|our|these|those|- A are|should|must|can|may|have|need|ought|could to|- be|become|get painted|- K", "paint all the A K except B"),
    // What is there, or is not.
    ("if|incase we|you|i|they dont|havent have|got|own|see|find|- a|an|any|one A yet|already|here|anywhere|around|now|- , P", "if there is no A , P"),
    ("if|incase we|you|i|they do|have not have|got|own|see|find|- a|an|any|one A yet|already|here|anywhere|around|now|- , P", "if there is no A , P"),
    ("if|incase we|you|i|they have no A yet|already|here|anywhere|around|now|- , P", "if there is no A , P"),
    ("if|incase we|you|i|they lack a|an|any A here|- , P", "if there is no A , P"),
    ("if|incase we|you|i|they happen|chance to have|own|see|find a|an|any|some|- A here|around|anywhere|already|there|- , P", "if there is a A , P"),
    ("if|incase we|you|i|they already have|own|see|find a|an|any|some|- A here|around|anywhere|there|- , P", "if there is a A , P"),
    ("if|incase there happens|chances to be a|an|any|some A here|around|anywhere|already|there|- , P", "if there is a A , P"),
    ("O can|could|would|will|- you|- please|- tell|show me|us which|what A weve|we|theres|there|you|youve|ive|i|they got|have|are|is|see|own|- got|- here|there|around|-", "list the A"),
    ("O what|- is|whats the quantity|number|amount|total|count|tally|figure number|- of A in|at|on|around here|this|the|our place|town|city|harbour|campus|quarter|scene|area|district|picture", "how many A are there"),
    ("O what|- is|whats the quantity|amount|tally|total|count of A here|there|around|right|- now|-", "how many A are there"),
    ("what|which quantity|amount|number of A is|are|do|does there|here|we|you|exist have|got|see|- here|-", "how many A are there"),
    ("how many A can|do|could|would you|we|i|one find|see|count|spot|make|notice|identify out|- here|there|around|- that|which are K", "how many K A are there"),
    ("how many A can|do|could|would you|we|i|one find|see|count|spot|make|notice|identify out|- here|there|around|-", "how many A are there"),
    ("O give|get|show|let me|us have|- a|the|some|another short|brief|full|quick|detailed|proper|little|- description|portrait|summary|account of A", "O describe A"),
    ("how many A are there|here , not|without counting|including B", "how many A are there except B"),
    ("its|it is|- going to be a|an A , so P", "P"),
    ("itll|it will|- be a|an A , so P", "P"),
    // Who goes where, who looks where.
    ("please|- let|have|make|get|- G and B should|must|could|can|shall|ought|need|have|had|will|- to|better|please|- swap|switch|trade|exchange|change|swop their|- spots|seats|positions|locations|places|spot|seat|position|place with|- each|one|- other|another|-", "swap G and B"),
    ("D A comes|goes|walks|heads|moves|runs|strolls|steps|hurries|hops over|up|across|back|along|out|round|down|- to|and|- sit|sits|stand|stands|wait|waits|rest|rests|stay|stays|play|plays|be|join right|just|- W", "add D A W"),
    ("D A should|must|could|can|shall|has|ought|needs|may|might to|- come|go|walk|head|move|run|stroll|step|hurry|hop over|up|across|back|along|out|round|down|- to|and sit|stand|wait|rest|stay|play|be right|just|- W", "add D A W"),
    ("G comes|goes|walks|heads|moves|runs|strolls|steps|hurries|hops over|up|across|back|along|out|round|down|- to|and|- sit|sits|stand|stands|wait|waits|rest|rests|stay|stays|play|plays|be|join right|just|- W", "move G W"),
    ("G should|must|could|can|shall|has|ought|needs|may|might to|- come|go|walk|head|move|run|stroll|step|hurry|hop over|up|across|back|along|out|round|down|- to|and sit|stand|wait|rest|stay|play|be right|just|- W", "move G W"),
    ("G should|must|ought|needs|has|shall to|- be|- looking|look|facing|face|stare|staring|gazing|gaze|turned at|to|towards|toward|- B , not|rather|instead than|of|- at|to|towards|- C", "make G face B"),
    ("G should|must|ought|needs|has|shall to|- be|- looking|look|facing|face|stare|staring|gazing|gaze|turned at|to|towards|toward|- B ,|- and not at|to|towards|- C", "make G face B"),
    ("O lift|pick|take|raise|hoist N up|- and|, and|- then|- set|put|place|drop|lay|stand it|him|her|them down|back|- again|- W", "O move N W"),
    ("P , and|then where it|he|she|they|that stands|is|was|stood|sits|sat|lies|lay right|- now|before|currently|until|- now|- ,|- i|we|id|wed|put|place|add|set|plant|park|build|goes|comes want|need|would|like|love|put|place|- like|to|- see|have|- D A", "P and put D A where it was"),
    ("O the|this|our|my|whole|everything whole|entire|- scene|story|action|film|movie|shot|thing|- should|must|shall|is|has|needs|ought|will|could|can to|- take|play|happen|unfold place|out|- on|in|at|during|under|- P", "make it P"),
    ("O the|this|our|my scene|story|action|film|movie|shot should|must|shall|is|has|needs|ought|will|could|can to|- be set on|in|at|during|under P", "make it P"),
    ("the|this|our|my scene|story|action|film|movie|shot takes|plays|happens|unfolds|is place|set|out|- on|in|at|during|under P", "make it P"),
    // One place for all that are named.
    ("D P are|is|should|must|shall|ought|have|has|need|needs|could to|- be|get parked|put|placed|built|planted|installed|positioned|stationed|erected|set|located up|- W", "put D P W"),
];

/// Turns of phrase that are a request where nothing else is said; before another sentence they may tell why.
#[rustfmt::skip]
const LONE: &Turns = &[
    ("N could|might|should|would|can really|- do|use|like|take|have|love with|- some|a|more|- bit|touch|splash|lick|coat|dash|drop|layer|- of|- K paint|colour|color|-", "paint N K"),
];

/// Two sentences that are one request, with "." for the mark between them.
#[rustfmt::skip]
const PAIRS: &Turns = &[
    ("D A have|has|are|is|just|will|- just|been|- arrived|come|landed|arriving|coming|came|delivered|ordered|visiting|expected|appeared in|to|- town|today|now|soon|- . please|so|now|- put|place|set|scatter|spread|seat|park|leave|station|group|gather|distribute|stand|sit them|it|him|her|those|these out|- W", "put D A W"),
    ("A came|dropped|stopped|turned|showed|arrived by|over|along|up|in|round|- with|bringing D B . please|so|now|- put|place|set|line|stand|spread|scatter|arrange|seat them|these|those|it out|up|down|about|- W , evenly|nicely|equally spread|spaced|distributed|-", "put D B evenly W"),
    ("A came|dropped|stopped|turned|showed|arrived by|over|along|up|in|round|- with|bringing D B . please|so|now|- put|place|set|line|stand|spread|scatter|arrange|seat them|these|those|it out|up|down|about|- W", "put D B W"),
    ("D A W , wouldnt|would|how|isnt|that|thatd|itd|what X . please|so|then|just|yes|- add|put|build|make|place|get|plant|do|give me|us|- one|it|some|them|that there|please|then|-", "put D A W"),
    ("D A W . please|so|then|just|yes|- add|put|build|make|place|get|plant|do|give me|us|- one|it|some|them|that there|please|then|-", "put D A W"),
    ("would|could|might|can|may|shall|will D A be possible|ok|okay|fine|nice|feasible|doable|allowed|alright|good|great|lovely|thinkable|conceivable . please|so|then|just|yes|- add|put|build|make|place|do|plant|set|give me|us|- one|it|that|so there|please|then|-", "add D A"),
    ("the|those|these|all|- H . i|we|id|nobody|noone want|wants|need|needs|like|would|wish|wishes like|- to|- see|have|- none|no of|- them|those|these|more here|around|- in|on|at|around|- the|this|our|my|- harbour|campus|town|city|quarter|place|square|scene|picture|- any|- more|longer|anymore|again|-", "remove all the H"),
    ("the|those|these|all|- H . i|we|nobody|they never|dont|do|- not|longer|ever|- want|need|wants|needs|wish|like to|- see|have|- any|a|- single|more|one|- of|- them|those|these here|around|- in|on|at|around|- the|this|our|my|- harbour|campus|town|city|quarter|place|square|scene|picture|- any|- more|longer|anymore|again|-", "remove all the H"),
    ("A isnt|arent|doesnt|dont looking|look|facing|face|turned|watching|watch|gazing at|to|towards|toward|- B . please|so|- turn|rotate|spin|make|swivel|fix|correct|change|let|have him|her|it|that|them|this so|- that|- round|around|- he|she|it|they|- does|is|do|will|can|look|looks|should|- at|- it|him|her|them|- please|-", "make A face B"),
    ("A is|are|does|do not looking|look|facing|face|turned|watching|watch|gazing at|to|towards|toward|- B . please|so|- turn|rotate|spin|make|swivel|fix|correct|change|let|have him|her|it|that|them|this so|- that|- round|around|- he|she|it|they|- does|is|do|will|can|look|looks|should|- at|- it|him|her|them|- please|-", "make A face B"),
    ("lets|let us|- pretend|imagine|say|suppose|assume|picture that|- A his|her|their|a|an B . please|so|now|- add|put|place|drop|leave|set|lay|have one|it W", "put a B W"),
    ("somebody|someone|a|some X forgot|lost|left|dropped|mislaid his|her|their|a|an B behind|here|there|- . please|so|now|- add|put|place|drop|leave|set|lay|have one W", "put a B W"),
    ("somebody|someone|everybody forgot|lost|left|dropped|mislaid his|her|their|a|an B behind|here|there|- . please|so|now|- add|put|place|drop|leave|set|lay|have one W", "put a B W"),
    ("please|- leave|keep|allow|have|make a|- gap|space|distance|margin|clearance of M W . and|then|- right|exactly|just|- there|then|- please|- put|place|add|want|park|plant|build|set|need|stand D A there|-", "put D A M W"),
    ("please|- leave|keep|allow|have M of|- free|empty|clear|open|space|room|air|distance|gap W . and|then|- right|exactly|just|- there|then|- please|- put|place|add|want|park|plant|build|set|need|stand D A there|-", "put D A M W"),
    ("W please|- leave|keep|allow|have M of|- free|empty|clear|open|space|room|air|distance|gap . and|then|- right|exactly|just|- there|then|- please|- put|place|add|want|park|plant|build|set|need|stand D A there|-", "put D A M W"),
    ("N is|are no longer|more needed|required|wanted|necessary|useful|used here|- . so|and|- please|you|- can|may|please|- remove|delete|take|get|throw|scrap|clear|bin|rid it|them|him|her|that of|away|out|- please|-", "remove N"),
    ("N isnt|arent needed|required|wanted|necessary|useful|used any|- more|longer|anymore|- here|- . so|and|- please|you|- can|may|please|- remove|delete|take|get|throw|scrap|clear|bin|rid it|them|him|her|that of|away|out|- please|-", "remove N"),
];

/// Puts the turns of phrase plainly.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    let end = last_mark(lexemes);
    if let Some(plain) = by_table(&lexemes[..end], LONE) {
        lexemes.splice(..end, plain);
        return;
    }
    let paired = pairs(lexemes);
    let mut told = Vec::with_capacity(paired.len());
    for sentence in sentences(&paired) {
        let end = last_mark(sentence);
        told.extend(by_table(&sentence[..end], CASUAL).unwrap_or_else(|| clause_by_clause(&sentence[..end])));
        told.extend_from_slice(&sentence[end..]);
    }
    *lexemes = told;
}

/// Two sentences at a time, by the first turn that they are.
fn pairs(lexemes: &[Lexeme]) -> Vec<Lexeme> {
    let said: Vec<&[Lexeme]> = sentences(lexemes).collect();
    let mut told = Vec::with_capacity(lexemes.len());
    let mut at = 0;
    while at < said.len() {
        let both = said.get(at + 1).map(|next| [said[at], next].concat());
        let end = both.as_ref().map_or(0, |both| last_mark(both));
        let plain = both.as_ref().and_then(|both| by_table(&both[..end], PAIRS));
        if let (Some(plain), Some(both)) = (plain, both) {
            told.extend(plain);
            told.extend_from_slice(&both[end..]);
            at += 2;
        } else {
            told.extend_from_slice(said[at]);
            at += 1;
        }
    }
    told
}

/// By the first turn of a table that they are, words of politeness behind them or not.
fn by_table(words: &[Lexeme], table: &Turns) -> Option<Vec<Lexeme>> {
    let told = |words: &[Lexeme]| table.iter().find_map(|(said, meant)| by_turn(words, said, meant));
    told(words).or_else(|| before_kind_words(words).and_then(|end| told(&words[..end])))
}

/// "Anna and Ben swap seats, and Rex comes over to sit next to me": each clause by itself.
fn clause_by_clause(words: &[Lexeme]) -> Vec<Lexeme> {
    let is_cut = |at: usize| {
        words[at].token == Token::Comma
            && longest_phrase(&words[at + 1..], &["and", "then", "and then"]).is_some()
    };
    let mut told = Vec::with_capacity(words.len());
    let mut from = 0;
    for cut in (1..words.len()).filter(|at| is_cut(*at)).chain([words.len()]) {
        let joint = longest_phrase(&words[from..cut], &["and", "then", "and then"]).filter(|_| from > 0);
        let begin = from + joint.unwrap_or(0);
        told.extend_from_slice(&words[from..begin]);
        let clause = &words[begin..cut];
        let is_part = from > 0 || cut < words.len();
        let plain = is_part.then(|| by_table(clause, CASUAL)).flatten();
        told.extend(plain.unwrap_or_else(|| clause.to_vec()));
        if cut < words.len() {
            told.push(words[cut].clone());
        }
        from = cut + 1;
    }
    told
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let said = CASUAL.iter().chain(LONE).chain(PAIRS).flat_map(|(said, _)| said.split([' ', '|']));
    said.filter(|word| word.len() > 1)
}
