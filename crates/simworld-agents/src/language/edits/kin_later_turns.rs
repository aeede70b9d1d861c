//! The tables of [`super::kin_later`], in the notation of [`super::turns`].

use super::retold::Turns;

/// What somebody does who is somewhere, and no noun of what stands there: "a bus stop" is none who stops.
macro_rules! stays {
    () => {
        "pause|gather|assemble|congregate|huddle|cluster|loiter|linger|lounge|laze|mingle|wait|sit|kneel|crouch|squat|lie|stay|remain|sleep|doze|snooze|rest|pose|lean|chat|meet|relax|hover|lurk|graze|bask|chill|hang"
    };
}
/// The same of one, and of what was.
macro_rules! stayed {
    () => {
        "stand|stands|stood|stop|stops|stopped|park|parks|parked|settle|settles|settled|pauses|paused|gathers|gathered|waits|waited|sits|sat|lies|lay|stays|stayed|remains|remained|rests|rested|lingers|lingered|be|is|was|were"
    };
}

/// What would be read as something else, of all that is said: the hour of a film, and what is wanted then; "fog, and a man near the lamp".
#[rustfmt::skip]
pub(super) const FIRST_WHOLE: &Turns = &[
    ("we|i|were|im|well|ill are|am|will|- shoot|film|shooting|filming|start|begin|open|roll|record|meet at|in|during around|about|- the|- Y ,|. so|and|- please|- i|we want|need to|- have|see|- some|a|the|- Z , and|plus D B W", "make it Z Y , and put D B W"),
    ("i|we want|need to|- have|see|- some|a|the|- Z , and|plus D B W", "make it Z , and put D B W"),
    ("we|i|were|im|well|ill are|am|will|- shoot|film|shooting|filming|start|begin|open|roll|record|meet at|in|during around|about|- the|- Y ,|. so|and|- please|- id|wed like|love to|- have|see|- some|a|the|- Z , and|plus D B W", "make it Z Y , and put D B W"),
    ("id|wed like|love to|- have|see|- some|a|the|- Z , and|plus D B W", "make it Z , and put D B W"),
    ("we|i|were|im|well|ill are|am|will|- shoot|film|shooting|filming|start|begin|open|roll|record|meet at|in|during around|about|- the|- Y ,|. so|and|- please|- i|we would like|love to|- have|see|- some|a|the|- Z , and|plus D B W", "make it Z Y , and put D B W"),
    ("i|we would like|love to|- have|see|- some|a|the|- Z , and|plus D B W", "make it Z , and put D B W"),
    ("we|i|were|im|well|ill are|am|will|- shoot|film|shooting|filming|start|begin|open|roll|record|meet at|in|during around|about|- the|- Y ,|. so|and|- please|- lets|let us|- have some|a|the|- Z , and|plus D B W", "make it Z Y , and put D B W"),
    ("lets|let us|- have some|a|the|- Z , and|plus D B W", "make it Z , and put D B W"),
    ("we|i|were|im|well|ill are|am|will|- shoot|film|shooting|filming|start|begin|open|roll|record|meet at|in|during around|about|- the|- Y ,|. so|and|- please|- give me|us some|a|the|- Z , and|plus D B W", "make it Z Y , and put D B W"),
    ("give me|us some|a|the|- Z , and|plus D B W", "make it Z , and put D B W"),
];

/// Turns that are all that is said; "." is the end of a sentence within them.
#[rustfmt::skip]
pub(super) const WHOLE: &Turns = &[
    // What is given, and is meant to be put somewhere instead.
    ("P give|hand|get|bring|lend|offer|pass|buy|fetch A D B ,|- or|no|well|- i|we|- mean|meant|rather|say|- ,|- put|place|set|stand|leave|lay|add|stick one|it|that right|just|directly|- R him|her|it|them", "P put D B R A"),
    // Who learns the language, and what he likes better.
    ("me|us|- ,|- i|we like|prefer|love|find|want it|this|- much|far|- more|better|most|best|nicer|prettier|- when|if N has|had|is|was|were|gets|got|wears|wore|shows painted|- in|- the|a|- colour|color|- K ,|. so|and|- please|- you|- please|- change|make|do|fix|arrange|paint it|that|this to|- so|- ,|- please|-", "paint N K"),
    // Who wants what, and which of the two is let stand somewhere.
    (concat!("a|an X wants|needs|wishes|craves|seeks|fancies|likes|loves D B , so|and|therefore|- please|- let|have|make one ", stays!(), "|stand|be right|just|- W"), "put D B W"),
    (concat!("a|an X wants|needs|wishes|craves|seeks|fancies|likes|loves C , so|and|therefore|- please|- let|have|make one ", stays!(), "|stand|be right|just|- W"), "put a X W"),
];

/// Turns of one sentence each.
#[rustfmt::skip]
pub(super) const PARTS: &Turns = &[
    // Who is let do something somewhere, or should.
    (concat!("O let|have|make|get|see D A to|- ", stays!(), " right|just|directly|quietly|idly|briefly|out|around|- W"), "O put D A W"),
    (concat!("D A should|must|shall|ought|has|have|needs|need to|- ", stays!(), "|", stayed!(), " right|just|directly|quietly|idly|briefly|out|- W"), "put D A W"),
    (concat!("it|that|itd would|d|will|- be|is very|so|really|most|extremely|ever|too|- kind|nice|good|great|lovely|sweet|helpful|wonderful|perfect|cool|brilliant|useful|handy|fine|fantastic|super|generous of|- you|- if|when D A come|comes|came|would|could|can|will|- and|to|- ", stays!(), "|", stayed!(), " right|just|directly|- W"), "put D A W"),
    // What somebody would not refuse.
    ("G wouldnt say|mind|refuse|reject|decline|complain|object|sneeze|sniff|frown|quibble|protest no|- to|about|at|against|- having|getting|- D X at|by|on his|her|its|their side", "put D X next to G"),
    ("G wouldnt say|mind|refuse|reject|decline|complain|object|sneeze|sniff|frown|quibble|protest no|- to|about|at|against|- having|getting|- D X right|just|close|- R him|her|it|them", "put D X R G"),
    ("G would|d|will never|not|hardly say|mind|refuse|reject|decline|complain|object|sneeze|sniff|frown|quibble|protest no|- to|about|at|against|- having|getting|- D X at|by|on his|her|its|their side", "put D X next to G"),
    ("G would|d|will never|not|hardly say|mind|refuse|reject|decline|complain|object|sneeze|sniff|frown|quibble|protest no|- to|about|at|against|- having|getting|- D X right|just|close|- R him|her|it|them", "put D X R G"),
    // Who learns the language.
    ("G is|are|- needing|needs|need|wanting|wants|want|wishing|wishes|requiring|requires|missing|misses|deserves D X who|that|which|and|he|she|it must|should|can|will|- sits|sit|stands|stand|lies|lie|stays|stay|waits|wait|sleeps|sleep|lives|live|is|be|rests|rest|walks|runs|sitting|standing|lying|waiting right|just|close|directly|always|- R her|him|it|them", "put D X R G"),
    ("G is|are|- needing|needs|need|wanting|wants|want|wishing|wishes|requiring|requires|missing|misses|deserves D X who|that|which|and|he|she|it must|should|can|will|- sits|sit|stands|stand|lies|lie|stays|stay|waits|wait|sleeps|sleep|lives|live|is|be|rests|rest|walks|runs|sitting|standing|lying|waiting right|just|close|directly|always|- at|by|on his|her|its|their side", "put D X next to G"),
];

/// The sun that is asked for, behind the words that ask for it.
#[rustfmt::skip]
pub(super) const SUN: &Turns = &[
    ("the|a|- sun just|only|barely|about|- to|- coming|come|comes|rising|rise|peeping|peeking|creeping|climbing|popping|appearing|emerging up|out|over|- the|- horizon|- ,|- you|i|- know|mean|see|say|- ,|- Y", "make it Y"),
    ("the|a|- sun just|only|barely|about|- to|- coming|come|rising|rise|peeping|peeking|creeping|climbing up|over the|- horizon|-", "make it dawn"),
    ("the|a|- sun just|only|barely|about|- to|- going|go|setting|sinking|sink|dipping|dropping|slipping|disappearing down|below|under|behind|- the|- horizon|- ,|- you|i|- know|mean|see|say|- ,|- Y", "make it Y"),
    ("the|a|- sun just|only|barely|about|- to|- going|go|sinking|dipping|dropping|slipping|disappearing down|below|under the|- horizon|-", "make it dusk"),
];
