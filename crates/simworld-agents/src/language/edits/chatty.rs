//! Turns of phrase of people who chat, and what they mean, in the notation of [`super::turns`]: those that would be misunderstood as they
//! stand, and those that are tried behind all other turns.

/// What is put plainly before anything is read, one sentence each.
#[rustfmt::skip]
pub(super) const CHATTY_FIRST: &[(&str, &str)] = &[
    // Who asks whether somebody can.
    ("is|- there|- any|some|a|- small|slight|- chance|way|possibility|hope|possible that|- you|we|i can|could|might|would maybe|perhaps|possibly|- P", "P"),
    ("i|we|me|im|were am|is|are|was|were|be|- wanting|wishing|hoping|asking|needing|desiring that you|we please|- P", "P"),
    // What somebody has none of, told of the other way round.
    ("it must|should|has|needs|shall|could|can|ought to|- give|gives D A", "add D A"),
    ("i|we only|just want|need|like|allow|tolerate|accept K H here|there|around|- here|- , so|and|then|- remove|delete|scrap|ditch|clear all|- the others|rest", "remove all the H except the K ones"),
    ("i|we only|just want|need|like|allow|tolerate|accept A here|there|around|- here|- , so|hence|then please|- P", "P"),
    // Who shall do what, several at once.
    ("O have|let|get|make D A and E B wait|stand|sit|play|queue|meet|gather|walk|rest|work|chat|talk|pose|perform|live|sleep|stay C", "O put D A and E B C"),
    ("O have|let|make D A sprout|appear|bloom|flower|flourish|rise|emerge|grow|stand|spring up|out|- W", "O put D A W"),
    ("O have|let|make|get A turn|direct|fix|set|point|cast|lift his|her|its|their eyes|eye|gaze|head|face|attention|look to|towards|toward|on|at|upon B", "O make A face B"),
    ("P get|give|bring|find|buy|fetch him|her|it|them D B to|that|who|which can|could|- sit|sits|stand|stands|lie|lies|play|plays|live|be|rest|rests|wait|waits|sleep|sleeps W", "P put D B W"),
    ("A shouldnt|mustnt|should|must|isnt|oughtnt not|to|- be|- staring|looking|facing|gazing|look|stare|face|supposed to|- look|face|- X , he|she|it|they should|must|ought|needs|has|have to|- be|- look|face|stare|gaze|looking|facing at|to|towards|- B", "A should face B"),
    ("A and B are|should|must|need|have|seem|look|looks|know|like|love|hate|want|belong|were|can|could|havent|dont C , so|- turn|rotate|spin|swivel|move|make them both|- so|- that|- they look|looks|face|faces|watch|see|looking|facing at|- each|one other|another", "make A and B face each other"),
    ("A belongs|belong to B , so|and|then|- please|- put|move|bring|take|place it|them C him|her|them|it", "move A C B"),
    // A thing for another.
    ("O substitute|swap|exchange|put in|- D A for N and E B for V", "O replace N with D A and replace V with E B"),
    ("O substitute D A for N", "O replace N with D A"),
    ("P she|he|they would love|like|enjoy|appreciate|want D A , Q so|and|then please|- put|add|place|build it|one there", "P add D A"),
    ("O swap|exchange|trade N for D A and V for E B", "O replace N with D A and replace V with E B"),
    ("O raise|erect|construct D A W", "O put D A W"),
    ("O please|- you|- make|paint|turn|want|have|get N to|- be|become|get|have|turn|- of|in a|the|- K colour|color please|-", "O paint N K"),
    // Doors that tell a building.
    ("P building|house|shop|store|place whose door is|stands|stays|was open|opened|unlocked|ajar Q", "P building nearest to the open door Q"),
    ("P building|house|shop|store|place whose door is|stands|stays|was locked|closed|shut Q", "P building nearest to the locked door Q"),
    ("P building|house|shop|store|place where|that|which the|has|with|had its|a|the|- door is|stands|stays|was open|unlocked|ajar Q", "P building nearest to the open door Q"),
    ("P building|house|shop|store|place where|that|which the|has|with|had its|a|the|- door is|stands|stays|was locked Q", "P building nearest to the locked door Q"),
    ("P building|house|shop|store|place that|which is|stays|stands locked Q", "P building nearest to the locked door Q"),
    ("P building|house|shop|store|place that|which is|stays|stands unlocked Q", "P building nearest to the open door Q"),
    // Where there is room.
    ("theres|there is|are|- some|a|an|so|loads|plenty|heaps|- much|lot|lots|plenty|bit|of|- of|- nice|empty|free|open|unused|spare|big|perfect|good|lovely|bare|- space|room|spot|gap|corner|area|patch|place W , so|and|- please|- could|can|why|- you|we|dont|- you|- put|add|place|set|stick|plant|build|park|stand|pop|plonk|chuck|throw|have|want|need D A there|in|- there|it|-", "put D A W"),
    // What would be good.
    ("it|that|this|itd|thatd|- would|d|will|might|- be U|really|very|so|- good|nice|great|lovely|better|cool|fine|sweet|wonderful|useful that|if|when C has|had|have|gets|got D B him|her|it|them", "add D B C"),
    ("it|that|this|itd|thatd|- would|d|will|might|- be U|really|very|so|- good|nice|great|lovely|better|cool|fine|sweet|wonderful|useful that|if|when C has|had|have|gets|got D B", "C needs D B"),
    // Two of which each shall look at something.
    ("O turn|rotate|swivel|point|face A towards|to|toward B and C towards|to|toward E", "O make A face B and make C face E"),
];

/// What is tried behind all other turns, one sentence each.
#[rustfmt::skip]
pub(super) const CHATTY: &[(&str, &str)] = &[
    ("i|we|me|im am|is|are|was|were|be|- wanting|wishing|needing|desiring|wanting for|- D A", "add D A"),
    ("A has|have|had no business|reason|right|place|cause being|lying|standing|sitting|to|parking|hanging|staying|- be|stand|lie|sit|around|- parked|left|dumped|standing|lying|- here|there Q", "remove A"),
    ("A has|have|had no business|reason|right|cause being|lying|standing|sitting|to|parking|hanging be|stand|lie|sit|around|- W", "remove A"),
    ("A , i|we|me|nobody|noone do|- not|no|dont|doesnt|wants|needs want|need|like|to|- see|- it|them|him|her|that here|there|around|- no|any|- more|longer|-", "remove A"),
    ("i|we|me not|no want|need|like A here|- no|any|- more|longer|here|-", "remove A"),
    ("A could|might|needs|should|would do|use|have|like|love|- with|- D B on|at|to its|his|her|the left|lefthand hand|- side|-", "add D B to the left of A"),
    ("A could|might|needs|should|would do|use|have|like|love|- with|- D B on|at|to its|his|her|the right|righthand hand|- side|-", "add D B to the right of A"),
    ("P copy|duplicate|clone|replicate A and|then|, then|- keep|leave|have|drop|stick|pop|plonk|bring|put|place|set|want|park|stand the|that|this|its|- copy|copies|duplicate|clone|twin|second|new|it one|- W", "P copy A W"),
    ("O inscribe|engrave|mark|sign|tag|title|brand|label A with|by|as|to the|a|- name|title|words|inscription|label B", "O name A B"),
    ("O centre|center|fix|fasten|screw|nail|bolt|embed|insert|wedge|lodge|implant|anchor|root|seat|drive|ram|hammer|knock|stash|introduce in|into|- D A", "O put D A"),
    ("O heave|lug|haul|wheel|roll|drag|push|pull|carry|cart|drive|slide|ferry|trundle|convey|tow|walk|lead|shove|hoist in|over|along|up|out|- D A W", "O put D A W"),
];

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let said = CHATTY_FIRST.iter().chain(CHATTY).flat_map(|(said, _)| said.split([' ', '|']));
    said.filter(|word| word.len() > 1)
}
