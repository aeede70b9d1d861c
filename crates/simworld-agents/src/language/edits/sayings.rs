//! More turns of phrase and what they mean, tried behind those of [`super::turns`] and in their notation (`G` is what begins with no verb of an order): wishes told as what would be nice,
//! what somebody should go and do, places of two things that are told once, weather that covers a place.

/// Turns of phrase and what they mean, of one sentence each.
#[rustfmt::skip]
pub(super) const SAYINGS: &[(&str, &str)] = &[
    // The sky.
    ("O fill|cover|wrap|shroud|blanket|drown|drench|soak|bury|bathe|hide|smother|flood everything|it with|in|under a|some|thick|dense|heavy|deep|- thick|heavy|- Y Q", "make it Y Q"),
    ("O fill|cover|wrap|shroud|blanket|drown|drench|soak|bury|bathe|hide|smother|flood the|this|our|- whole|entire|- old|- scene|harbour|quay|city|town|campus|quarter|place|street|streets|square|area|neighbourhood|world with|in|under a|some|thick|dense|heavy|deep|- thick|heavy|- Y Q", "make it Y Q"),
    // What would be nice.
    ("C would|might|could|d A if it|he|she|they faced|watched B", "make C face B"),
    ("C would|might|could|d A if it|he|she|they stood|sat|waited|was|were|lived W", "move C W"),
    ("C would|might|could|d A if it|he|she|they was|were|became K", "paint C K"),
    ("C would|might|could|d A if it|he|she|they was|were F", "make C F"),
    ("C would|might|could|will|d A if there was|were|is|stood|stands|grew D B", "add D B"),
    ("C , it would|might|could|d A if there was|were|is|stood|stands|grew D B", "C , add D B"),
    ("C would|might|could|d A if N was|were|became K", "paint N K"),
    ("C would|might|could|d A if N was|were|got F", "make N F"),
    ("C would|might|could|d A if N stood|sat|waited|was|were|lived|went|moved over|- W", "move N W"),
    ("id|wed|itd|theyd A if there was|were|is|stood|grew D B", "add D B"),
    ("id|wed|itd|theyd A if N was|were|became K", "paint N K"),
    ("id|wed|itd|theyd A if N was|were|got F", "make N F"),
    ("id|wed|itd|theyd A if N stood|sat|waited|was|were|lived|went|moved over|- W", "move N W"),
    ("it is|was|has|- my|our|his|her|their|the|one|a wish|desire|hope|dream|plan|idea|request that D A exists|exist|stands|stand|be|is|grows|appears|goes|shall|should be|stand|exist|- W", "add D A W"),
    ("this|the|our|my place|spot|town|city|campus|quarter|harbour|square|street|neighbourhood|corner|park deserves|needs|lacks|wants|misses|requires|could|should use|do|get|have|- with|- D A , B", "add D A B"),
    ("this|the|our|my place|spot|town|city|campus|quarter|harbour|square|street|neighbourhood|corner|park deserves|needs|lacks|wants|misses|requires|could|should use|do|get|have|- with|- D A W", "add D A W"),
    ("W i|we am|are|were|im wishing|wanting|hoping|desiring|needing|craving|longing|- for|to|- see|have|get|put|place|- D A", "add D A W"),
    ("W im wishing|wanting|hoping|desiring|needing|craving|longing for|to|- see|have|get|put|place|- D A", "add D A W"),
    ("i|we am|are|was|were wishing|wanting|hoping|desiring|craving|longing for|to|- see|have|get|put|place|- D A", "add D A"),
    ("i|we am|are|im wanting|wishing|hoping|desiring that you are|will|would|- be|- putting|placing|adding|planting|put|place|add|plant D A", "add D A"),
    ("O have|let|make A meet|gather|assemble|queue|line up|- W", "O move A W"),
    ("is it possible|ok|fine|okay that you|we are|- placing|putting|adding|planting|parking D A", "add D A"),
    // What somebody should go and do.
    ("D A should|must|could|can|may|shall|might|will|has|had|have|needs|ought to|better|- go|come|walk|run|step|hop|head|move over|there|out|along|up|down|- and|to|- stand|sit|move|wait|lie|rest|be|stay|play|perform|work|sleep W", "add D A W"),
    ("A should|must|could|can|may|shall|might|will|has|had|have|needs|ought to|better|- please|- go|come|walk|run|step|hop|head|move over|there|out|along|up|down|- and|to|- stand|sit|move|wait|lie|rest|be|stay|play|perform|work|sleep|park W", "move A W"),
    ("A should|must|could|shall|had|has|ought to|better|- go|come|walk|run|head over|- to|up|- W", "move A W"),
    // Rows.
    ("A W , M apart", "A every M W"),
    ("G on both sides of B every M", "add G every M on both sides of B"),
    ("G every M on both sides of B", "add G every M on both sides of B"),
    ("P , M apart", "P every M"),
    ("P , M apart , Q", "P every M Q"),
    ("P , M from each other|another", "P every M"),
    // What is asked.
    ("O|- tell|give|inform me|us a|an|something|anything|more|everything|all little|bit|thing|idea|lot|- more|something|- about|of A", "describe A"),
    ("O tell me|us a|an|something|anything|more|everything|all|some little|bit|thing|lot|- more|- about A", "describe A"),
    ("could|can|would|will you tell me|us a|an|something|anything|more|everything|all|some little|bit|thing|lot|- more|- about A", "describe A"),
    ("which|what of|- the|our|- buildings|houses|places|trees|people|animals|vehicles|plants are H", "list the H"),
    ("which|what building|house|place|tree|person|animal|vehicle|plant is the|a|an H", "list the H"),
    ("how many of|- the|our|- buildings|houses|places|trees|people|animals|vehicles|plants are H", "how many H are there"),
    ("what is|whats the K thing|object|item", "describe the K thing"),
    // Names.
    ("from today|tomorrow|now on|- A should be called|named B", "name A B"),
    ("from today|tomorrow|now on|- A goes|shall|will|is go|to|- go|- by the name of|- B", "name A B"),
    // Streets.
    ("no|stop|ban|forbid|prohibit|end more|any|all|the|- driving|parking|traffic|through|- traffic|- on|along|through|in|down|from A any|- more|longer|please|-", "close A"),
    ("no|stop|ban|forbid|prohibit more|any|all|the|- driving|parking|through|- traffic|driving on|along|through|in|down|from A", "close A"),
];

/// Every word of the table, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    SAYINGS.iter().flat_map(|(said, _)| said.split([' ', '|'])).filter(|word| word.len() > 1)
}
