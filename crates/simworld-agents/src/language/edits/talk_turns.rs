//! More turns of phrase of people who talk, and what they mean, in the notation of [`super::turns`], for [`super::talked`]: states that are wished, what a
//! film scene is like, what should be put right, and questions with the place before what is asked.

use super::retold::Turns;

/// What would be misunderstood, of one sentence each: it is told plainly before it is read.
#[rustfmt::skip]
pub(super) const TALK_FIRST: &Turns = &[
    // What would make somebody happy, told by who learns the language.
    ("i|we|she|he|they|everybody|everyone|people would|will|should be|have|feel|get having|feeling|- so|very|a|the|such|really|- so|very|much|great|big|deep|real|true|- of|- happy|happiness|happier|joy|glad|pleasure|pleased|delight|delighted|thrilled|grateful|thankful|satisfied|satisfaction|content if|when it would|was|were|could|did|should|might|will|is be|start|begin|get|- to|- Y", "make it Y"),
    ("id|wed|shed|hed|theyd be|have|feel|get having|feeling|- so|very|a|the|such|really|- so|very|much|great|big|deep|real|true|- of|- happy|happiness|happier|joy|glad|pleasure|pleased|delight|delighted|thrilled|grateful|thankful|satisfied|satisfaction|content if|when it would|was|were|could|did|should|might|will|is be|start|begin|get|- to|- Y", "make it Y"),
];

/// What is told so that it is not understood, of one sentence each.
#[rustfmt::skip]
pub(super) const TALK: &Turns = &[
    // What is there besides who asks.
    ("O which|what|who people|persons|person|else|all is|are in|on|at|around the|this|our|- scene|campus|harbour|town|city|quarter|picture|place|area besides|beside|except|except|but|bar for|- me|myself|us", "O list all the people"),
    ("O which|what people|persons|other|others are|is there|here|about|around|present here|there|- besides|beside|except|but|bar for|- me|myself|us", "O list all the people"),
    ("O who|whos is|are|- here|there|around|about|present|- besides|except|but|bar for|- me|myself|us here|there|around|about|-", "O list all the people"),
    ("O who|whos else is|are|- here|there|around|about|present besides|except|but|bar|- for|- me|myself|us|-", "O list all the people"),
    // Which of the things of a place are of a kind.
    ("O which|what buildings|building|places|place|houses|house|things|ones|of in|on|at|around|of|- this|the|our|these|- campus|harbour|town|city|quarter|scene|place|street|buildings|places|houses|things|- are|is|serve|count|act used|as|- as|- H", "O list all the H"),
    ("O which|what of the|these|those|our buildings|places|houses|things in|on|at|around|- this|the|our|- campus|harbour|town|city|quarter|scene|place|- are|is|serve|count used|as|- as|- H", "O list all the H"),
    ("O which|what A in|on|at|around this|the|our campus|harbour|town|city|quarter|scene|place are|is K", "O list all the K A"),
    // What a film scene is like.
    ("O i|we|they am|are|- going|about|- to|- shooting|shoot|filming|film|recording|staging|stage|rehearsing|rehearse|photographing|painting|taking|doing|playing|drawing A at|- Y in|with|and|under Z , so|and|- please|- set|make|arrange|prepare|get|do|have that|it|this|everything|things|all up|so|ready|accordingly|- ,|- will|would|can|could|- you|-", "i want Z at Y"),
    ("O i|we|they am|are|- going|about|- to|- shooting|shoot|filming|film|recording|staging|stage|rehearsing|rehearse|photographing|painting|taking|doing|playing|drawing A in|with|under Z at|- Y , so|and|- please|- set|make|arrange|prepare|get|do|have that|it|this|everything|things|all up|so|ready|accordingly|- ,|- will|would|can|could|- you|-", "i want Z at Y"),
    ("O i|we|they am|are|- going|about|- to|- shooting|shoot|filming|film|recording|staging|stage|rehearsing|rehearse|photographing|painting|taking|doing|playing|drawing A in|with|under|at Z , so|and|- please|- set|make|arrange|prepare|get|do|have that|it|this|everything|things|all up|so|ready|accordingly|- ,|- will|would|can|could|- you|-", "make it Z"),
    // The clock.
    ("O jump|skip|spin|roll|push|move|advance|wind|fast|turn|set|put|bring|take|run|wheel|crank|forward|knock|shift|nudge forward|- the clock|clocks|time|hour|day|hands|story forward|forwards|ahead|on|back|backward|backwards|along|over|- right|straight|all|- the|- way|- to|till|until|up Y", "set the clock to Y"),
    // How far something goes, told from where it stands.
    ("A should|must|ought|is|has|needs to|- be|get|- moved|shifted|pushed|put|placed|nudged|dragged|pulled|parked|moving M further|farther|more B than where|- it|he|she|they is|are|stands|stand|sits|sit|lies|lie|was|does|stood|hangs now|today|currently|already|right|at|- now|present|-", "move A M B"),
    ("O move|shift|push|nudge|drag|pull|slide|put|park|bring A M further|farther|more B than where|- it|he|she|they is|are|stands|stand|sits|sit|lies|lie|was|does|stood|hangs now|today|currently|already|right|at|- now|present|-", "O move A M B"),
    // Names.
    ("O give A a|an|its|his|her|some|the X name at|for|- last|once|finally|long|- , lets|let|shall|- us|we|- say|call|maybe|perhaps|namely it|him|her|- B", "O name A B"),
    ("O give A a|an|its|his|her|some|the X name at|for|- last|once|finally|long|- , how|what about B", "O name A B"),
    ("O give A a|an|its|his|her|some|the name at|for|- last|once|finally|long|- , lets|let|shall|- us|we|- say|call|maybe|perhaps|namely it|him|her|- B", "O name A B"),
    ("O give A a|an|its|his|her|some|the name at|for|- last|once|finally|long|- , how|what about B", "O name A B"),
    // What is missing, told by who learns the language.
    ("O it|there|here|- is|are missing|lacking|needed|wanted|required|desired D A W", "put D A W"),
    ("O it|there|here|- misses|lacks|miss|lack|needs D A W", "put D A W"),
    ("what i|we|they|you do|really|actually|truly|- need|want|require|lack|miss|wanted is|are|would be|- D A W", "put D A W"),
    // What would be welcome somewhere.
    ("somewhere|anywhere|someplace|right|just|- W D A would|might|could|will be|look|do|feel|seem so|very|most|really|quite|- welcome|nice|lovely|great|good|fine|perfect|handy|useful|appreciated|wonderful|splendid|ideal|well ,|.|- so|and|- please|kindly|- add|put|place|build|make|give|set|install us|me|- one|it there|please|-", "put D A W"),
    ("somewhere|anywhere|someplace|right|just|- W D A would|might|could|will be|look|do|feel|seem so|very|most|really|quite|- welcome|nice|lovely|great|good|fine|perfect|handy|useful|appreciated|wonderful|splendid|ideal|well", "put D A W"),
    // Measures that are told first.
    ("exactly|precisely|just|about|roughly|- M A of B i|we|id|wed need|want|would|require|must|like love|like|have|- D C", "put D C M A of B"),
    // Company.
    ("how|what about D A to keep B company ,|- right|just|- at|by|beside|on his|her|its|their|him|them|it side|elbow|-", "put D A next to B"),
    ("how|what about D A to keep B company", "put D A next to B"),
    ("O put|add|place|give|get|bring|set|make|build|want|need|like us|me|- D A to keep B company ,|- right|just|- at|by|beside|on his|her|its|their|him|them|it side|elbow|-", "put D A next to B"),
    // States that are wished.
    ("N , i|we|she|he|they am|are|is|was|would|will|- preferring|prefer|prefers|preferred|wanting|want|wants|liking|like|likes|loving|love|wishing|wish|needing|need|desiring it|him|her|them in|to|as|- be|become|- in|- the|a|- colour|color|shade|tone|- of|- K", "paint N K"),
    ("N , id|wed|shed|hed|theyd rather|much|- prefer|like|love|want|have|see it|him|her|them in|to|as|- be|become|- in|- the|a|- colour|color|shade|tone|- of|- K", "paint N K"),
    ("i|we am|are|would|- preferring|prefer|wanting|want|liking|like|loving|love|wishing|wish|needing|desiring N in|to|as be|become|- in|- the|a|- colour|color|shade|tone|- of|- K", "paint N K"),
];
