//! Turns of phrase that go across sentences, and what they mean, for [`super::across`], in the notation of [`super::turns`]; the mark between two
//! sentences is "." in what is said.

use super::retold::Turns;

/// What would be misread, or refused for another reason, as it stands.
#[rustfmt::skip]
pub(super) const FIRST: &Turns = &[
    // Where another went, and what colour another got.
    ("P W .|, and|- D A goes|go|belongs|belong|comes|come there as|too|also|likewise well|-", "P W , and put D A W"),
    ("P W .|, and|- D A should|must|shall|can|may go|come|stand|be there as|too|also|likewise well|-", "P W , and put D A W"),
    ("P W .|, and|- A goes|go|belongs|belong|comes|come|moves|move there as|too|also|likewise well|-", "P W , and move A W"),
    ("P W .|, and|- A should|must|shall|can|may go|come|move|stand|be there as|too|also|likewise well|-", "P W , and move A W"),
    ("O paint|spray|colour|color|make|turn|dye A K .|,|and and|- B gets|get|receives|takes|take|wants|has|have|is|are to|- get|have|be|- in|- the same colour|color|shade|paint as|too|also|- well|-", "O paint A K , and paint B K"),
    ("O paint|spray|colour|color|make|turn|dye A K .|,|and and|- B should|must|shall|can|may|ought to|- get|have|be|become|take|receive in|- the same colour|color|shade|paint as|too|also|- well|-", "O paint A K , and paint B K"),
    // What is so and is to be otherwise.
    ("A is|are|was|were still|currently|now|- closed|shut|blocked|barred off|- . please|so|- open|reopen|unblock it|them|that up|- again|- please|-", "open A"),
    ("A has|have been closed|shut|blocked|barred off|- . please|so|- open|reopen|unblock it|them|that up|- again|- please|-", "open A"),
    ("A is|are still|currently|now|- open . please|so|- close|shut|block|bar it|them|that off|- again|- please|-", "close A"),
    // Whose something is.
    ("look|looking at N .|, its H B", "the H of N B"),
    ("see|consider|regard|take N .|, its H B", "the H of N B"),
    // What would please.
    ("N , it|he|she|they would|will|could|might please|suit|delight|thrill|cheer me|us|everybody|everyone|- much|far|- more|better|- in K", "paint N K"),
    ("N would|will|could|might please|suit|delight|thrill|cheer me|us|everybody|everyone much|far|- more|better|- in K", "paint N K"),
    // What goes, what comes in its place, and what else.
    ("O take|clear|cart|haul|carry N away|off|out . where it|he|she stood|was i|we want|need D A , and|- E B W as|too|also|- well|-", "O take N away , and put D A where N stood , and put E B W"),
    ("O remove|delete|scrap|fell N . where it|he|she stood|was i|we want|need D A , and|- E B W as|too|also|- well|-", "O remove N , and put D A where N stood , and put E B W"),
    ("O take|clear|cart|haul|carry N away|off|out . where it|he|she stood|was i|we want|need D A", "O take N away , and put D A where N stood"),
    ("O remove|delete|scrap|fell N . where it|he|she stood|was i|we want|need D A", "O remove N , and put D A where N stood"),
    // What something has not.
    ("A has|have no B . give|get|build|buy it|him|her|them|that one ,|- right|directly|just|- R the|that|- building|house|place|shop|it|him|her|them", "put a B R A"),
    ("A has|have no B . give|get|build|buy it|him|her|them|that one", "put a B next to A"),
];

/// What is refused as it stands.
#[rustfmt::skip]
pub(super) const LATER: &Turns = &[
    // The place that sells something.
    ("there is|stands|are a|an A here|somewhere|around|- that|which sells|sell|offers|stocks B . P it Q", "P the A that sells B Q"),
    ("theres|know|see|have a|an A here|somewhere|around|- that|which sells|sell|offers|stocks B . P it Q", "P the A that sells B Q"),
    ("i|we know|see|have a|an A here|somewhere|around|- that|which sells|sell|offers|stocks B . P it Q", "P the A that sells B Q"),
    // Colours of another, and those that are not so yet.
    ("O give|lend A the|a|- same colour|color|shade|paint as|like|that B", "O paint A the same colour as B"),
    ("any|every|each A that|which|who is|was not K yet|already|now|so|far|- far|- should|must|shall|ought|has|needs to|- be|become|turn|go|get painted|coloured|- B", "paint every A that is not K B"),
    ("any|every|each A that|which|who isnt|wasnt K yet|already|now|so|far|- far|- should|must|shall|ought|has|needs to|- be|become|turn|go|get painted|coloured|- B", "paint every A that is not K B"),
    ("all|the all|- A that|which|who are|were not K yet|already|now|so|far|- far|- should|must|shall|ought|have|need to|- be|become|turn|go|get painted|coloured|- B", "paint all A that are not K B"),
    // Several wishes under one heading.
    ("D wishes|requests|orders|ideas|tasks|jobs|changes|things for|about|from|concerning the|- A . P", "P"),
    ("D wishes|requests|orders|ideas|tasks|jobs|changes|things . P", "P"),
    // Which of several.
    ("O swap|exchange|switch A with|and|for the B that|which|who is|stands|sits nearer|closer|nearest|closest to C", "O swap A with the B nearest to C"),
    ("O swap|exchange|switch A with|and|for the B nearer|closer to C", "O swap A with the B nearest to C"),
    ("begin|start|beginning|starting with|at|from the A H and|then|, then|- paint|spray|make|colour every other|second one K", "paint every second H K , starting with the A one"),
    ("begin|start|beginning|starting with|at|from the A H and|then|, then|- remove|delete every other|second one", "remove every second H , starting with the A one"),
    // Copies, gaps and steps.
    ("O copy|duplicate|clone A D times and|, then|- put|place|set|leave both|all|the|these|those of|- the|these|those|- copies|them W", "O make D copies of A W"),
    ("O copy|duplicate|clone A twice and|, then|- put|place|set|leave both|all|the|these|those of|- the|these|those|- copies|them W", "O make two copies of A W"),
    ("O leave|keep|have a|some gap|space|distance of M between N and a|an|the new|- A", "O put a A M from N"),
    ("O leave|keep|have a|some gap|space|distance of M between a|an new|- A and N", "O put a A M from N"),
    ("O shoo|move|shift|shove|nudge|push|scoot|send|bring A over|along|across|up|- so that|- he|she|it|they|hes|shes|its|theyre is|are|stands|stand|sits|sit|- right|directly|just|- W", "O move A W"),
    // Of somebody and themselves.
    ("O put|place|set|stand|move|sit|lay A R herself|himself", "O move A R A"),
];

/// What is for each of those who were named before, of whom the last word is one.
#[rustfmt::skip]
pub(super) const EACH_TURNS: &Turns = &[
    ("each|both|every one|- of|- them|- gets|get|receives|receive|needs|need|has|have|wants|want|deserves|deserve D A ,|- right|directly|just|- R them|him|her|it", "put D A R them"),
    ("each|both|every one|- of|- them|- should|must|shall|can get|have|receive D A ,|- right|directly|just|- R them|him|her|it", "put D A R them"),
    ("D A for each|both|every one|- of|- them|- ,|- right|directly|just|- R them|him|her|it", "put D A R them"),
    ("O give|get|bring|hand each|both one|- of|- them|- D A ,|- right|directly|just|- R them|him|her|it", "put D A R them"),
    ("each|both|every one|- of|- them|- gets|get|receives|receive|needs|need|deserves|deserve D X", "put D X next to them"),
    ("D X for each|both|every one|- of|- them|-", "put D X next to them"),
    ("O give|get|bring|hand each|both one|- of|- them|- D X", "put D X next to them"),
];
