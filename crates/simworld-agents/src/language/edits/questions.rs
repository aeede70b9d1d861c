//! What is asked in other words than "how many", "list" and "describe": who sells something, where one buys it, where somebody is hanging around,
//! which is the tallest tree, who is in the park. The notation is that of [`super::turns`].
//!
//! They are tried only where a sentence was refused, and change nothing: at worst an answer is given to what was no question.

use super::retold::Turns;

/// Questions and what they mean, of one sentence each.
#[rustfmt::skip]
pub(super) const QUESTIONS: &Turns = &[
    // What one can buy somewhere.
    ("O what|whats|anything can|could|do|does|may|might|is|- i|you|we|one|they|people|there|somebody|someone|- buy|get|purchase|sell|order|eat|drink|have|on|for at|in|from|inside|sale|offer at|in|from|- B", "O describe B"),
    ("O what|whats is|- on the|their|- menu|list|card|counter at|of|in B", "O describe B"),
    ("O what|which goods|things|wares|products|drinks|food|- does|do|has|have|are|is B sell|sells|got|offer|serve|stock|on|for sale|offer|stock|-", "O describe B"),
    // Who sells something, and where one buys it.
    ("O who|whos|what is|are|- here|around|- selling|sells|sell|offers|offering|serves|serving|stocks|bakes a|an|some|any|the|fresh|good|- cup|mug|slice|piece|loaf|bottle|bowl|- of|- B for|on|around|in|- sale|offer|here|town|- here|around|today|now|-", "O list the buildings that sell B"),
    ("O where|wheres can|could|do|does|may|might|would|will|- i|you|we|one|they|people|somebody|someone|anybody|anyone|visitors|guests|customers|kids|children|students|tourists please|- get|buy|find|purchase|have|sell|sells|serve|serves|offer|offers|obtain|order|eat|drink|stock|bake a|an|some|any|the|fresh|good|- cup|mug|slice|piece|loaf|bottle|bowl|- of|- B for|on|around|in|- sale|offer|here|town|- here|around|today|now|nearby|-", "O list the buildings that sell B"),
    ("O where|wheres is|are|can|could|- B be|get|- sold|available|served|offered|stocked|bought|had|purchased here|around|today|now|-", "O list the buildings that sell B"),
    ("O where|wheres is|are|- B for|on|to|in sale|offer|buy|have|stock here|around|today|now|-", "O list the buildings that sell B"),
    ("O is|are there|- somewhere|anywhere|someplace|anybody|anyone|somebody|someone|a|any place|shop|store|building|house|- that|where|which|who|to|- i|you|we|one|they|people|- can|could|- sells|sell|selling|buy|get|find|serves|serve|offers|offer|has|have a|an|some|any|the|- cup|mug|slice|piece|loaf|bottle|bowl|- of|- B here|around|nearby|-", "O list the buildings that sell B"),
    ("O does|do|can|could|will anybody|anyone|somebody|someone|any here|around|- shop|store|place|building|- sell|offer|serve|stock|have a|an|some|any|the|- cup|mug|slice|piece|loaf|bottle|bowl|- of|- B here|around|nearby|-", "O list the buildings that sell B"),
    ("O which|what place|places|building|buildings|house|houses|spot|spots|one|ones that|- sell|sells|offer|offers|serve|serves|stock|stocks|bake|bakes a|an|some|any|the|- B", "O list the buildings that sell B"),
    // Where somebody or something is.
    ("O where|whereabouts on|in|the|- earth|world|heck|hell|- has|have|had|did|could|might B wandered|wander|run|disappeared|disappear|vanished|vanish|slipped|sneaked|strolled|walked|moved|driven|gone|got|went|go|ended|been|buggered|hopped|flown off|away|up|out|hiding|over|round|- to|- now|today|-", "O where is B"),
    ("O where|whereabouts does|do|did|has|have|might|may|could|would|can B hang|stand|live|sit|wait|lie|stay|lurk|hide|be|gone|got|go|park out|around|about|to|now|today|- now|today|-", "O where is B"),
    ("O where|wheres|whereabouts is|are|was|were|- B hanging|standing|sitting|waiting|lying|parked|lurking|hiding|loitering|located|situated|placed|staying|lounging|strolling|wandering|kept|stored|positioned|playing|resting|sleeping|working|living|idling|roaming|walking|at|to|gone|now around|about|out|up|be|found|exactly|now|today|- these|at|right|now|today|- days|the|now|- moment|-", "O where is B"),
    ("O do|does|did|has|have you|anybody|anyone|somebody|someone know|seen|see|spotted|noticed where|- B is|are|has|have|went|- gone|got|hiding|- to|-", "O where is B"),
    // Which is the most so, and which is called so.
    ("O which one|ones|- is|are|stands|lies the B", "O list the B"),
    ("O which|what place|places|building|buildings|house|houses|spot|spots|location|locations|one|ones is|are|goes|go|bears|bear|has|have|carry|carries called|named|labelled|known|by|the as|name|the|- name|of|- of|- B", "O list all the buildings called B"),
    ("O how many place|places|building|buildings|house|houses|spots is|are|go|bear|have called|named|labelled|known|by|the as|name|the|- name|of|- of|- B", "O how many buildings called B are there"),
    ("O which|what A is|are called|named|labelled B", "O list the A called B"),
    ("O who|whos is|- called|named B", "O describe B"),
    ("O how many A is|are called|named B", "O how many A called B are there"),
    // Who is somewhere, and what.
    ("O who|whos all|else|- is|are|stands|sits|waits|lives|hangs|works|stays|- all|currently|now|out|over|still|- W now|today|right|at|- now|the|- moment|-", "O list the people W"),
    ("O what|whats all|else|- grows|hangs|lies|waits|sits W", "O what is W"),
    // Doors, by why one does or does not get through them.
    ("O which|what door|doors|gate|gates cant|cannot|can|could|couldnt|wont|do|does|is|are A because|since|as|for it|its|they|theyre is|are|- locked|bolted", "O list the locked doors"),
    ("O which|what door|doors|gate|gates cant|cannot|can|could|couldnt|wont|do|does|is|are A because|since|as|for it|its|they|theyre is|are|- unlocked", "O list the unlocked doors"),
    ("O which|what door|doors|gate|gates cant|cannot|can|could|couldnt|wont|do|does|is|are A because|since|as|for it|its|they|theyre is|are|- open|opened|ajar", "O list the open doors"),
    ("O which|what door|doors|gate|gates cant|cannot|can|could|couldnt|wont|do|does|is|are A because|since|as|for it|its|they|theyre is|are|- closed|shut", "O list the closed doors"),
    ("O which|what door|doors|gate|gates cant|cannot|couldnt i|you|we|one|people|anybody|anyone|he|she|they open|unlock|enter|use|get|go|walk|pass|come through|by|past|in|into|-", "O list the locked doors"),
    ("O which|what door|doors|gate|gates wont|cant|cannot open|be opened|-", "O list the locked doors"),
];
