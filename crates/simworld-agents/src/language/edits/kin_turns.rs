//! The tables of [`super::kin`], in the notation of [`super::turns`].

use super::retold::Turns;

/// Turns that are all that is said; "." is the end of a sentence within them.
#[rustfmt::skip]
pub(super) const WHOLE: &Turns = &[
    // What was brought, and is to be shown somewhere.
    ("the|our|a|an|my|some|two|three|this|that|- X have|has|just|had|- unloaded|delivered|brought|dropped|shipped|sent|ordered|donated|bought|carried|baked|built|lent|offered|left|received|produced|unpacked|supplied|imported|hauled|fetched in|off|round|over|by|us|- D B .|, so|and|- please|now|- show|put|place|set|stack|leave|drop|lay|stand|park|have|draw|add|arrange|pile|store them|it|those|these|him|her all|both|- W", "put D B W"),
    ("A , he|she|it is|are|- needing|needs|need|wanting|wants|want|lacking|lacks B . D C , please|- keep|put|place|set|leave|have|stand it|that|them|him|her right|just|directly|- R him|her|it|them", "put D C R A"),
    ("we|i|they need|have|want|plan|do|hold|are|am|will planning|having|doing|holding|hold|have|do|- a|an|some|the|our|- fire|rescue|safety|street|garden|birthday|big|small|summer|winter|- drill|rehearsal|exercise|practice|picnic|party|celebration|festival|ceremony|inspection . P", "P"),
];

/// Turns of one sentence each.
#[rustfmt::skip]
pub(super) const PARTS: &Turns = &[
    // How far something is to be kept.
    ("O light|start|kindle|build|make|set|lay D A ,|- but|and|- please|do|- keep|leave|hold|have it|him|her|them at|- least M away|clear|- from|of|off B", "O add D A at least M from B"),
    ("P ,|- but|and|- please|do|- keep|leave|hold|have it|him|her|them at|- least M away|clear|- from|of|off B", "P at least M from B"),
    ("P ,|- but|and|- please|do|- keep|leave|hold|have it|him|her|them no|not closer|nearer|less than M away|- to|from|of|off B", "P at least M from B"),
    ("P ,|- but|and|- please|do|- keep|leave|hold|have it|him|her|them within M of|from B", "P within M of B"),
    ("P ,|- but|and|- please|do|- keep|leave|hold|have it|him|her|them no|not further|farther|more than M away|- from|of|off B", "P within M of B"),
    ("O light|start|kindle|build|make|set|lay D A ,|- but|and|- please|do|- keep|leave|hold|have it|him|her|them M away|clear|- from|of|off B", "O add D A M from B"),
    ("P ,|- but|and|- please|do|- keep|leave|hold|have it|him|her|them M away|clear|- from|of|off B", "P M from B"),
    // What goes.
    ("O make|let|have|get to|- disappear|vanish N", "O remove N"),
    ("O make|let|have|get N to disappear|vanish completely|now|please|-", "O remove N"),
    // All but some, by their heights.
    ("O remove|delete|fell|clear|scrap|ditch|erase all|every|- of|- the|- A except|but|save|bar for|- those|the|ones|any|- ones|- that|which|- are|is|- taller|higher|bigger|larger than M", "O remove all A shorter than M"),
    ("O remove|delete|fell|clear|scrap|ditch|erase all|every|- of|- the|- A except|but|save|bar for|- those|the|ones|any|- ones|- that|which|- are|is|- shorter|lower|smaller than M", "O remove all A taller than M"),
    // What looks good in a colour.
    ("i|we reckon|think|bet|say|feel|believe|guess|know|find|swear that|- A would|might|could|will look|be|seem dead|proper|well|right|pure|so|really|very|much|far|rather|quite|just|simply|absolutely|truly|totally|way|- good|great|better|nice|nicer|lovely|lovelier|ace|fab|mint|class|sick|brill|brilliant|wicked|smart|smarter|cool|cooler|gorgeous|stunning|fine|sharp|sweet|superb|fantastic|amazing|wonderful|best|prettier|pretty|neat|grand|dandy in|painted|when|if|were|as it|he|she|its|- is|was|were|- painted|- in|- K", "paint A K"),
    ("N would|might|could|will look|be|seem dead|proper|well|right|pure|so|really|very|much|far|rather|quite|just|simply|absolutely|truly|totally|way|- good|great|better|nice|nicer|lovely|lovelier|ace|fab|mint|class|sick|brill|brilliant|wicked|smart|smarter|cool|cooler|gorgeous|stunning|fine|sharp|sweet|superb|fantastic|amazing|wonderful|best|prettier|pretty|neat|grand|dandy in|painted|when|if|were|as it|he|she|its|- is|was|were|- painted|- in|- K", "paint N K"),
    ("itd|it|that|thatd|would|- would|be|- be|- so|very|really|quite|- nice|lovely|great|cool|better|good|ace|fine|neat|grand|brilliant|wonderful|perfect if|when N became|becomes|turned|turns|went|goes|got|gets|were|was|is painted|- in|- K", "paint N K"),
    ("N , can|could|would|will|please|cant you|- please|- make|arrange|do|get that|so|it that|- it|he|she is|becomes|gets|turns|goes|be|become in|- K", "paint N K"),
    ("O make|arrange|get|do so|to|it|- that N it|he|she|- is|becomes|gets|turns|goes|be|become in|- K", "O paint N K"),
    // Who looks where.
    ("O have|make|let|get A to|- gawp|gape|gawk|goggle|stare|peer|squint|leer|glare|ogle|glower|peek|glance|gaze|scowl|frown|grin|squinny|rubberneck straight|right|up|down|over|- at|towards|toward|into B", "O make A face B"),
    ("O make|arrange|do|have it|so|- that A she|he|it looks|faces|gazes|stares|turns to|at|towards|toward|- B", "O make A face B"),
    // What a film is in need of.
    ("for my|the|our|this|your X shot|scene|photo|picture|film|movie|video|trailer|poster|story|game|level|brochure|play|show ,|- i|we|id|wed want|need|would|like like|- D A", "put D A"),
    // The sky.
    ("Y , thats|that|which|its what|is|- what|exactly|just|- i|we id|wed|would|really|- need|want|fancy|crave out|over|- there|here|now|today|tonight|-", "make it Y"),
    ("from|out the|of sky|heavens it|there|the|- must|should|shall|has|is|can to|- fall|come|pour|drop down|- Y now|today|please|-", "make it Y"),
    ("i|we just|really|simply|so|always|do|- adore|love|like|enjoy it|- when|how|if the|some|- Y rolls|comes|drifts|creeps|falls|sets|moves|settles|descends|gathers in|down|over|up|- , so|- please|- lets|let|give us|me|- have|get it|that|some|one please|now|-", "make it Y"),
    // What a place lacks.
    ("O what A is|are|was really|badly|simply|just|truly|- crying|screaming|begging|dying|longing|calling|yearning|aching out|- for is|are|was D B", "O add D B"),
    ("what A is|are short|lacking|missing|needing|wanting|craving|lacks|needs|after of|- is|are|was D B R it|him|her|them", "put D B R A"),
    ("for the|our|my A i|we am|are|would|- wish|want|need|like|wishing|wanting|needing|have|love for|- D B ,|- right|just|directly|close|very|- R him|her|it|them", "put D B R the A"),
    ("for A i|we am|are|would|- wish|want|need|like|wishing|wanting|needing|have|love for|- D B ,|- right|just|directly|close|very|- R him|her|it|them", "put D B R A"),
    ("it|- is|its very|so|too|really|quite|- hot|cold|warm|wet|windy|late|early|boring|empty|sunny today|now|here|tonight|outside , P", "P"),
    ("G she|he|it|they is|are X , so|- please|- give|put|add|make|bring|place|set|get D B R her|him|it|them", "put D B R G"),
    ("G she|he|it|they is|are X , so|- please|- give|put|add|make|bring|place|set|get B R her|him|it|them", "put a B R G"),
    ("G should|must|would|could|shall be|- having|have|get|getting D B with|- her|him|it|them|- ,|- just|right|directly|only|- at|by|on her|his|its|their side only|please|-", "put D B next to G"),
    ("G is|was|has|are C , hes|shes|its|theyve|he|she|it|they has|have|- earned|deserved|deserves|deserve|needs|need|merits|merited|earns D B by|at|on his|her|its|their side", "put D B next to G"),
    ("G is|was|has|are C , hes|shes|its|theyve|he|she|it|they has|have|- earned|deserved|deserves|deserve|needs|need|merits|merited|earns D B R him|her|it|them|himself|herself|itself", "put D B R G"),
    ("our|my|the|this|that A is|are too|so|very|really|all|- X , you|so|please|- please|- give|put|bring|make|get him|her|it|them please|- D B at|by|on|to the|his|her|its|- side please|-", "put D B next to the A"),
    ("in|at my|our|their|his|her country|village|town|home|homeland|culture|family|hometown|city|place|street|region there|it|- is|are|stands|goes always|usually|often|mostly|- D A W , so|and|- please|- make|do|have|build it|like|- like|this|that|so|the|- this|that|so|same|- here|too|-", "put D A W"),
    ("the A has|have|got got|- no|not B outside|here|there|around|nearby|- ,|- so|and|- please|- to|- put|add|place|make|set|build|stand one in front|outside of|- it|-", "put a B in front of the A"),
    ("G has|have|got got|- no|not B outside|here|there|around|nearby|- ,|- so|and|- please|- to|- put|add|place|make|set|build|stand one in front|outside of|- it|-", "put a B in front of G"),
    ("G has|have|got got|- no|not B outside|here|there|around|nearby|- ,|- so|and|- please|- to|- put|add|place|make|set|build|stand one R it|him|her|them", "put a B R G"),
    ("G , so|and the A should|must|could|ought|needs|has to|- get|have|buy|treat|give itself to|- D B right|just|directly|- alongside|beside|nearby|next to|- it|-", "G , put D B next to the A"),
    ("something|anything for|to A should|must|could|ought|has|might to|- exist|be|stand|go|come W , i|we|- mean|meant|namely|say|ideally|preferably|maybe|like D C", "put D C W"),
    ("itd|it|that|thatd would|- be X if D A were|was|is|- crackling|burning|glowing|standing|sitting|waiting|growing|blooming|parked|lying|playing|singing|sleeping|smoking|blazing|flickering|there W", "put D A W"),
    ("i|we need|want|wish|like|would D A that|which|who it|he|she|they|- lies|stands|sits|is|goes|lie|stand|sit|hangs W", "put D A W"),
    ("the A folks|people|staff|crowd|guys|lot|team|workers|kids|students keep|are|is|have|been begging|asking|screaming|crying|pleading|calling|nagging for D B close|near|nearby|right|just|- by|- , so|- please|- let|give|do them|it|- have|get|- it|one|this|that|so", "put D B near the A"),
    ("please that there|it|- is|are|comes|come|stands|be coming|standing|- D A W", "put D A W"),
    ("please ,|- that D A stands|is|sits|comes|goes|waits|lies|be W", "put D A W"),
    ("please|kindly you make|put|add|place|set|build|bring|plant D A W", "put D A W"),
    ("please|kindly to make|put|add|place|set|build|bring|plant D A W", "put D A W"),
    ("W people|folks|visitors|everybody|everyone|kids|customers|guests|tourists is|are C , D A there would|might|could|will be|do|help X", "put D A W"),
    ("me and A , we would|- like|want|need|wish|love to|- have|get|- D B in|- between us|- two|both|-", "put D B between me and A"),
    ("me and A , we would|- like|want|need|wish|love to|- have|get|- B in|- between us|- two|both|-", "put a B between me and A"),
    ("G and me|i , we would|- like|want|need|wish|love to|- have|get|- D B in|- between us|- two|both|-", "put D B between me and G"),
    ("O sling|stick|bung|lob|bang|pop|plonk|whack|shove|chuck D A in|down|up|over|- W", "O put D A W"),
    ("D A wouldnt|wont go|come|be amiss|astray|wrong ,|- in|- my|- opinion|-", "add D A"),
    ("D A would|will|could not|hardly|never go|come|be amiss|astray|wrong ,|- in|- my|- opinion|-", "add D A"),
    ("O add|put|make|build|place|get|bring|set D A , he|she|it|they must|should|has|have|needs|shall to|- stand|be|go|sit|lie|come|stay W", "O put D A W"),
    ("i|we want|need|wish|like|have D A , he|she|it|they must|should|has|have|needs|shall to|- stand|be|go|sit|lie|come|stay W", "put D A W"),
    ("O D A , he|she|it|they must|should|has|have|needs|shall to|- stand|be|go|sit|lie|come|stay W", "O put D A W"),
    // Who would like to be somewhere, and is put there.
    ("G is|are dying|longing|itching|aching|desperate|keen|eager|wanting to lie|sit|stand|rest|be|sleep|wait|go|relax|stay down|up|over|- right|just|- W , so|and|then|- please|just|- plonk|put|set|place|move|stick|pop|plop|bring|let|take|carry him|her|it|them over|- there", "move G W"),
    // A second one.
    ("N needs|wants|deserves|gets|should|could|must have|get|- a|an identical|exact|perfect|- twin|double|clone|copy|duplicate|replica|lookalike W", "copy N W"),
    // What is not believed beside a condition.
    ("P , which|what|though|although|and i|we can|could|do hardly|scarcely|barely|not believe|imagine|think|credit , Q", "P , Q"),
    // Why a scene is to be so.
    ("P , i|we|it|that need|needs|want|wants|love|like|gives|sets|suits|fits|makes|am|are after|for|- the|a|some|my|our|- right|perfect|proper|spooky|gloomy|romantic|cosy|eerie|certain|special|- mood|atmosphere|ambience|feeling|feel|vibe|tone|drama|suspense|effect|backdrop for|of|in|to|at B", "P"),
    ("P , i|we|it|that need|needs|want|wants|love|like|gives|sets|suits|fits|makes|am|are after|for|- the|a|some|my|our|- right|perfect|proper|spooky|gloomy|romantic|cosy|eerie|certain|special|- mood|atmosphere|ambience|feeling|feel|vibe|tone|drama|suspense|effect|backdrop", "P"),
    // That all is well.
    ("no|oh|well|- no|- ,|- hang|hold|wait on|- ,|- leave|keep everything|all|things exactly|just|precisely|completely|- as|how|the it|they|way|that|everything stands|stand|is|are|it|was stands|is|are|-", "leave all the things as they are"),
    // Questions.
    ("who|what or|and what|who|which is|are|was A", "describe A"),
];

/// Turns of one sentence each that would be read as something else, or about something else.
#[rustfmt::skip]
pub(super) const FIRST: &Turns = &[
    // What a place lacks, and who needs something, with "it" for the place and "him" for who needs it.
    ("the A is|are crying|screaming|begging|dying|gasping|longing|desperate|aching|yearning|calling|pleading out|- for D B , so|and|then|- please|just|- sling|put|set|place|add|stick|plonk|pop|bung|shove|build|stand|park|whack one|it|some|them right|just|directly|- R it|him|her|them|there", "put D B R the A"),
    ("G is|are crying|screaming|begging|dying|gasping|longing|desperate|aching|yearning|calling|pleading out|- for D B , so|and|then|- please|just|- sling|put|set|place|add|stick|plonk|pop|bung|shove|build|stand|park|whack one|it|some|them right|just|directly|- R it|him|her|them|there", "put D B R G"),
    ("G is|are|- needing|needs|need|wanting|wants|want|lacking|lacks|missing|misses|requiring|requires|deserves|craves|craving D B , it|he|she|that|which|they must|should|has|have|needs|need|shall|is|are|ought|can to|- please|- stay|stand|be|go|sit|lie|remain|live|come right|just|directly|close|- R it|him|her|them", "put D B R G"),
    // What somebody is afraid of.
    ("my|our|the|his|her A is|are|was|gets|were so|very|really|too|- scared|afraid|frightened|terrified|sick|tired|jealous|wary of N , so|and|- itll|theyll|it|they|he|she|that|this|hell|shell will|must|has|have|needs|should|ought|- to|have|- to|- go|disappear|vanish|leave away|now|-", "remove N"),
    // Streets.
    ("cars|traffic|vehicles|lorries|drivers|trucks has|have no business|place|right|reason on|in|along A , so|and|- please|- close|shut|block|seal it|that|them off|down|up|-", "close A"),
];

/// As [`FIRST`], of all that is said.
#[rustfmt::skip]
pub(super) const FIRST_WHOLE: &Turns = &[
    // What a place's people lack, and where it is to stand.
    ("customers|visitors|patrons|guests|regulars|people|staff|clients|users of|at|in|from the A B . D C alongside|beside|outside|by|near the shop|place|building|house|store|door would|could|might|will soon|quickly|- sort|solve|fix|help|do|settle that|this|it|them|matters", "put D C next to the A"),
    ("customers|visitors|patrons|guests|regulars|people|staff|clients|users of|at|in|from A B . D C alongside|beside|outside|by|near the shop|place|building|house|store|door would|could|might|will soon|quickly|- sort|solve|fix|help|do|settle that|this|it|them|matters", "put D C next to A"),
];
