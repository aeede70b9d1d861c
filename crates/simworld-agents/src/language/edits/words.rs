//! The words by which scenes are changed: verbs, relations, weather, sizes.

use std::sync::LazyLock;

use simworld_core::asset::Season;
use simworld_core::scene::Relation;

use super::super::phrases::{Index, Phrases};

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verb {
    Add,
    Move,
    /// To add something or to move something that is there: "put a bench", "put the bench".
    Put,
    Remove,
    Replace,
    Turn,
    Swap,
    Paint,
    Grow,
    Shrink,
    Double,
    Copy,
    Name,
    Count,
    List,
    Describe,
    /// To change somehow: "make it red", "make the tree bigger", "make it rain".
    Make,
    /// Streets, to traffic.
    Close,
    /// Streets, to traffic.
    Open,
    /// To take something up, and then put it somewhere.
    Take,
}

pub(super) static VERBS: LazyLock<Index<Verb>> = LazyLock::new(|| Index::of(VERB_ROWS));

#[rustfmt::skip]
const VERB_ROWS: &[(&[&str], Verb)] = &[
    (&["add", "spawn", "create", "build", "insert", "plant", "install", "instantiate", "generate", "give me",
        "gimme", "decided on", "we decided on", "i decided on", "settled on", "we settled on", "we agreed on", "agreed on", "there should be", "there must be", "there needs to be", "there has to be", "there ought to be",
        "let there be", "i want", "i need", "i would like", "id like", "i would love", "id love", "we need",
        "we want", "we could use", "i could use", "throw in", "erect", "introduce", "include", "have",
        "i would like to have", "id like to have", "i want to have", "i would like to see", "id like to see",
        "i want to see", "bring in", "get me", "make me", "i wish for", "conjure up", "conjure", "materialise", "materialize", "whip up", "rustle up", "knock up", "summon", "magic up",
        "magic in", "sow", "grow me", "hand me", "grant me", "fetch me", "bring me", "give us", "we require", "i require", "i fancy", "we fancy",
        "i demand", "squeeze in", "fit in", "slot in", "provide", "contribute", "append", "top it off with", "there must stand", "there should stand",
        "there has to stand", "there shall be", "id love to see", "i would love to see", "id like", "wed like",
        "we would like", "we should have", "add in", "add on", "put in", "can i have", "can i get", "can we have",
        "can we get", "could i have", "could we have", "may i have", "could i get", "draw", "pop in", "needs",
        "need", "assemble", "construct", "lets have", "let us have", "show me", "could do with", "i could do with", "we could do with", "id want", "wed want", "i will have",
        "we will have", "ill have", "well have", "supply", "rear", "there will be", "there is to be", "there are to be", "there shall stand", "there will stand", "get us", "bring us", "fetch us",
        "sort me out with", "deliver", "bring along", "i would want", "im having", "i am having", "were having", "im after", "i am after", "were after", "we are after", "i picture", "i imagine",
        "we need there", "i need there", "exhibit", "rig up me", "start a new", "open up a", "instal", "i would have", "id have", "wed have", "furnish us with", "treat us to", "start", "light up", "kindle", "let me have", "order me", "i was hoping for", "i am hoping for",
        "find a spot for", "find a place for", "find room for", "find space for", "make room for", "make space for", "make some room for", "somebody ordered", "someone ordered", "we ordered", "i ordered",
        "in desperate need of", "in need of", "in dire need of", "in urgent need of", "i am in need of", "im in need of", "we are in need of", "there is room for", "theres room for", "there is still room for", "theres still room for", "there is space for", "theres space for", "any chance of", "is there any chance of", "any chance of getting", "any chance of having", "any chance of seeing", "is there any chance of getting", "might i have", "might we have", "might i get", "might we get", "i wouldnt mind seeing", "i would not mind seeing", "we wouldnt mind seeing", "we would not mind seeing", "i wouldnt mind having", "i would not mind having", "we would not mind having",
        "any chance for", "chance of", "i am thinking of", "im thinking of", "i am thinking about", "im thinking about", "i was thinking of", "i was thinking about", "im picturing", "i am picturing",
        "lets go for", "lets put up", "how about we add", "how about adding", "what about adding", "what do you say to", "i would go for", "id go for",
        "i could go for", "we could go for", "i could use", "can you do", "could you do", "sort out", "lay on", "roll out", "crack on with", "bang in", "bung in", "whack in", "whack up", "pop up", "stick in",
        "drop in", "plonk down", "plop down", "plunk down", "set out", "throw up", "throw down", "slap down", "slap up", "whip out", "knock together", "chuck in", "fetch out", "bring out", "plant out",
        "i wouldnt mind", "i would not mind", "we wouldnt mind", "we would not mind", "i wouldnt say no to", "i would not say no to", "we wouldnt say no to", "this place needs", "this place could use",
        "this place could do with", "this spot needs", "it needs", "it could use", "it could do with", "the place needs", "the city needs", "the town needs", "the campus needs", "the scene needs",
        "the harbour needs", "this town needs", "this city needs", "this scene needs", "the picture needs", "what this place needs is", "what this town needs is", "what we need is", "what i need is",
        "what is needed is", "whats needed is", "what is missing is", "whats missing is", "what i want is", "what we want is", "what i would like is", "what id like is", "nothing beats", "id kill for", "i would kill for",
        "time for", "its time for", "it is time for", "high time for", "its high time for"], Verb::Add),
    (&["move", "lift", "relocate", "shift", "bring", "drag", "push", "pull", "carry", "transfer", "teleport", "reposition",
        "slide", "send", "nudge", "budge", "shove", "scoot", "haul", "lug", "roll", "wheel", "heave", "cart",
        "usher", "lead", "escort", "guide", "rehome", "resite", "reseat", "migrate", "shuffle", "swing", "hop", "wander", "drive", "tow", "walk", "translate", "return", "ferry", "advance", "convey", "displace", "trundle", "steer",
        "hand over", "yank", "hoik", "hoick", "heft", "schlep", "scooch"], Verb::Move),
    (&["put", "place", "set", "set up", "drop", "park", "stick", "position", "leave", "lay", "put down", "stand",
        "locate", "set down", "plop", "pop", "throw", "chuck", "plonk", "deploy", "arrange", "situate", "dump",
        "slap", "plunk", "mount", "line up", "scatter", "squeeze", "fit", "wedge", "cram", "tuck",
        "squash", "string", "space", "spread", "sprinkle", "hang", "form", "make me a", "lean", "balance", "perch", "bung",
        "sling", "whack", "bang", "toss", "nestle", "slot", "station", "pitch", "set out", "lay out", "put up", "hoist",
        "lob", "attach", "drop off", "rig up", "stash", "post", "stow", "dot about", "stand up", "set up", "affix", "fasten", "moor", "berth", "align", "array",
        "stack", "pile", "pile up", "stack up", "assign", "dot", "dot around", "scatter around", "scatter about", "plonk down", "put out", "line them up", "spread out", "space out", "set about", "strew", "stretch", "arrange around",
        "serve", "dish up", "display", "pour", "exhibit", "showcase", "group", "cluster", "stagger", "distribute", "sling up", "hang up", "stick up"], Verb::Put),
    (&["remove", "delete", "erase", "get rid of", "tow away", "haul away", "take away", "destroy", "clear away", "clear", "take out",
        "demolish", "dispose of", "eliminate", "tear down", "yeet", "kill", "lose", "scrap", "knock down", "bin",
        "ditch", "we dont need", "i dont need", "we do not need", "i do not need", "i dont want", "we dont want",
        "i do not want", "nobody needs", "no more", "wipe out", "wipe", "despawn", "throw away", "throw out",
        "we no longer need", "i no longer need", "i no longer want", "cut down", "chop down", "drop out",
        "strip out", "pull down", "zap", "nuke", "banish", "vanish", "take down", "trash", "discard", "junk", "axe", "kick out", "evict", "oust", "toss out", "toss away",
        "uproot", "fell", "bulldoze", "raze", "obliterate", "annihilate", "vaporise", "vaporize", "purge", "cull", "do away with",
        "dismantle", "withdraw", "haul away", "haul off", "cart off", "cart away", "clean up", "sweep away", "chuck out",
        "chuck away", "excise", "expunge", "rip out", "dig up", "dig out", "pull up", "pull out", "cut out", "cart out", "send away",
        "i cant stand", "we cant stand", "i cannot stand", "i hate", "we hate", "i am sick of", "im sick of", "im tired of", "i am tired of",
        "i want no", "we want no", "enough of", "enough with", "away with", "down with", "out with", "off with", "be rid of", "dont need",
        "do not need", "dont want", "i dont want to see any", "i dont want to see", "i dont want any", "we dont need any", "i dont need any", "i do not want to see", "i dont wanna see", "i never want to see", "we dont want to see",
        "i dont like", "we have no use for", "i have no use for", "lets lose", "make away with", "see the back of", "i cant bear", "spare me",
        "we can do without", "i can do without", "we could do without", "i could do without", "dont let me see", "no need for", "theres no need for",
        "there is no need for", "to hell with", "take off", "unspawn", "burn", "blow away", "remove away", "no longer need", "no longer want",
        "i dont care for", "wed be better off without", "cancel", "cut", "chop", "get shot of", "weed out", "clear out", "rid us of", "rid me of", "ship out", "pull off", "carry off",
        "take out of here", "do away", "let go of", "strip away", "root out", "grub up", "grub out", "put away", "clear off", "say goodbye to", "say bye to", "say farewell to", "wave goodbye to", "kiss goodbye to", "we can live without", "i can live without", "we could live without",
        "i could live without", "bid farewell to", "farewell to", "goodbye to", "bye bye to", "good riddance to", "i have had enough of", "ive had enough of", "we have had enough of", "weve had enough of", "im done with", "i am done with",
        "were done with", "we are done with", "we dont want any", "part with", "strike out", "cross out", "rub out", "write off", "send packing", "wipe away", "clear up",
        "put an end to", "make short work of", "have done with", "call time on", "drop", "im over", "i am over", "we are over", "ive no use for", "weve no use for", "lets be rid of", "relieve me of", "relieve us of", "unload", "decommission", "retire", "im sick of looking at", "i am sick of looking at", "im tired of looking at", "i am tired of looking at", "im sick of seeing", "im tired of seeing", "i am tired of seeing", "were tired of looking at", "were sick of looking at",
        "i cant look at", "i can not look at", "i cannot look at", "i can no longer look at", "im fed up with", "i am fed up with", "were fed up with", "we are fed up with", "were sick of", "we are sick of", "were tired of", "we are tired of",
        "turf out", "boot out", "bin off", "whisk away", "spirit away", "whip away", "snatch away", "spirit off", "magic away", "tidy away", "pack away", "kill off", "shoo away", "expel", "eject"], Verb::Remove),
    (&["replace", "substitute"], Verb::Replace),
    (&["rotate", "turn", "spin", "swivel", "orient", "orientate", "face", "aim", "point", "twist", "flip", "revolve", "pivot", "gyrate", "yaw"], Verb::Turn),
    (CLOSING, Verb::Close),
    (OPENING, Verb::Open),
    (&["swap", "exchange", "switch", "trade", "interchange", "swap over", "swap around", "change places of", "change the places of", "change of place", "change place of", "transpose", "swop"], Verb::Swap),
    (&["paint", "repaint", "recolour", "recolor", "colour", "color", "dye", "change the colour of",
        "change the color of", "tint", "set the colour of", "set the color of", "respray", "spray", "spray paint",
        "change color of", "change colour of", "daub"], Verb::Paint),
    (&["enlarge", "scale up", "grow", "magnify", "blow up", "bump up", "beef up", "size up", "inflate", "make bigger", "increase", "expand", "increase the size of", "upscale",
        "supersize"], Verb::Grow),
    (&["shrink", "scale down", "reduce", "reduce the size of", "downscale", "decrease the size of", "decrease", "downsize", "shrink down"], Verb::Shrink),
    (&["double", "triple", "halve", "double the size of", "triple the size of", "halve the size of",
        "double the number of", "triple the number of", "twice as many", "there should be twice as many",
        "there ought to be twice as many", "there must be twice as many", "i want twice as many",
        "we need twice as many", "double the amount of", "double the height of", "triple the height of", "halve the height of", "double the count of"], Verb::Double),
    (&["copy", "duplicate", "clone", "make a copy of", "replicate", "make another copy of", "make copies of",
        "copy paste", "make a duplicate of", "make a clone of", "make another"], Verb::Copy),
    (&["rename", "call", "name", "label", "christen", "title", "dub", "baptise", "baptize", "entitle", "nickname"], Verb::Name),
    (&["how many", "count", "how much", "state the number of", "report the number of", "return the number of", "tell the number of", "tell us how many", "say me how many", "work out how many",
        "i want to know how many", "id like to know how many", "i would like to know how many", "let me know how many", "what number of", "what is the number of", "whats the number of", "number of",
        "count up", "tell me how many", "tally", "what is the total number of", "whats the total number of",
        "the number of", "the total number of", "do you know how many", "give me the number of",
        "tell me the number of", "say how many", "what is the count of"], Verb::Count),
    (&["list", "list me", "list us", "which", "what are", "state", "report", "identify", "print", "catalogue", "catalog", "point out", "let me know", "let me know which", "give me the names of", "tell me the names of", "display",
        "tell me all", "tell us all", "tell me every", "tell me all the", "tell us all the", "name all the", "name us", "name us all", "tell me about all", "show us", "enumerate for me", "name me", "give a list of", "a list of", "the list of", "list of", "get a list of", "an overview of", "give me an overview of", "a listing of", "produce a list of", "make a list of", "draw up a list of", "read out", "enumerate", "show all", "show me all", "name all", "what is", "whats",
        "what stands", "give me a list of", "what things are", "list all", "tell me what is", "tell me which",
        "show", "what all is", "whats all", "find", "find all", "where is", "where are", "wheres", "where did you leave", "where did you put", "where did i leave", "where did i put",
        "where did we put", "where did we leave", "where have you put", "where can i find", "where do i find", "do you know where", "where did you park",
        "where did i park", "where would i find", "where the heck is", "where on earth is", "where do we have", "can you find", "show me where", "what do we have", "what have we got", "what else is", "what do you see", "what can you see", "what can i see", "what can i find", "what can be found", "what do i find", "what have you got", "what is there", "whats there", "what do you have", "what all stands", "whats standing", "what is standing"], Verb::List),
    (&["describe", "what is the name of", "whats the name of", "give me the name of", "tell me the name of", "get the name of", "get name of", "what is the colour of", "what is the color of", "whats the colour of", "what is the position of", "what is the size of", "describe the position of", "describe the colour of", "describe the position and colour of", "describe the colour and position of", "describe the size of", "tell us about", "say something about", "give me information on", "give me information about", "details on", "let me know about", "report on", "tell me something about", "i want to know about", "id like to know about", "what sort of thing is", "what kind of thing is", "tell me about", "tell me more about", "what do you know about", "what can you tell me about",
        "inspect", "info on", "give me details on", "explain", "details of", "details about",
        "who is"], Verb::Describe),
    (&["make", "let", "change", "turn into", "resize", "scale", "set", "render", "have it", "convert",
        "adjust"], Verb::Make),
    (&["take", "grab", "pick up", "get", "fetch", "pick"], Verb::Take),
];

/// A relation as edits know it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    To(Relation),
    Between,
    Across,
    Along,
    /// On both sides of a street.
    Both,
    Around,
    Middle,
    Edge,
    Block,
    Corner,
    /// At each of the four.
    Corners,
    /// "At the bench" is beside it, "at (3, 4)" just there.
    At,
    /// "On the table" is on top, "on Oak Street" along it, "on the left of" a side.
    On,
    /// "In the park" is inside, "in front" is not here.
    In,
    Here,
    There,
    InItsPlace,
    Anywhere,
}

pub(super) static WAYS: LazyLock<Index<Way>> = LazyLock::new(|| Index::of(WAY_ROWS));

#[rustfmt::skip]
const WAY_ROWS: &[(&[&str], Way)] = &[
    (&["next to", "beside", "by", "right next to", "right by", "right beside", "just beside", "just next to",
        "just by", "adjacent to", "at the side of", "alongside", "directly next to", "touching", "by the side of",
        "to the side of", "against", "immediately next to", "close beside", "directly beside", "flanking",
        "bordering", "over beside", "over by", "over next to", "at the foot of", "under", "underneath", "beneath", "up against", "hard by", "side by side with", "up next to", "aside of", "besides", "right up against", "on the side of", "right at the side of", "at the flank of", "hard up against", "close up to", "shoulder to shoulder with"], Way::To(Relation::NextTo)),
    (&["around", "round", "all around", "in a circle around", "in a ring around", "all round"], Way::Around),
    (&["near", "near to", "close to", "not far from", "in the vicinity of", "close by", "in proximity of",
        "in proximity to", "nearby", "somewhere near", "somewhere around", "in the neighbourhood of",
        "in the neighborhood of", "not too far from", "somewhere close to", "within reach of",
        "in the area of", "in the proximity of", "a short walk from", "quite near", "pretty close to", "very near",
        "very close to", "near by", "nearer to", "closer to", "in close proximity to", "near of", "nearer", "more near to", "more near", "nigh", "in reach of", "within sight of", "a little way from", "a few steps from", "in the region of"], Way::To(Relation::Near)),
    (&["far from", "far away from", "away from", "well clear of", "clear of", "out of the way of", "well off", "far off", "a long way from", "nowhere near", "at a distance from",
        "not near", "well away from", "remote from", "as far as possible from", "distant from",
        "as far away as possible from", "not close to", "far off from", "miles from",
        "miles away from"], Way::To(Relation::FarFrom)),
    (&["in front of", "outside", "outside of", "before", "just in front of", "right in front of",
        "directly in front of", "at the front of", "to the front of", "infront of", "in the front of", "ahead of",
        "on the front side of", "out front of", "out in front of", "out the front of", "round the front of", "just outside", "right outside", "just outside of", "at the entrance of", "at the entrance to", "by the entrance of", "by the entrance to", "up front of"], Way::To(Relation::InFrontOf)),
    (&["behind", "at the back of", "in back of", "at the rear of", "in the rear of", "to the rear of",
        "just behind", "right behind", "directly behind", "on the back side of", "round the back of",
        "around the back of", "in the back of", "on the far side of", "out back of", "out behind", "round behind", "around behind", "in the backyard of", "in the back yard of", "out the back of", "around back of"], Way::To(Relation::Behind)),
    (&["left of", "to the left of", "on the left of", "on the left side of", "at the left of",
        "on the left hand side of", "to the left side of", "at the left side of", "at the left hand side of",
        "just left of", "on left side of", "on left of"], Way::To(Relation::LeftOf)),
    (&["right of", "to the right of", "on the right of", "on the right side of", "at the right of",
        "on the right hand side of", "to the right side of", "at the right side of", "at the right hand side of",
        "just right of", "on right side of", "on right of"], Way::To(Relation::RightOf)),
    (&["on top of", "onto", "atop", "upon", "on the top of", "over", "above", "on the roof of", "up on",
        "on to"], Way::To(Relation::OnTopOf)),
    (&["in the middle of", "in the centre of", "in the center of", "at the centre of", "at the center of", "in the heart of",
        "right in the middle of", "into the middle of"], Way::Middle),
    (&["at the edge of", "on the edge of", "along the edge of", "at the border of", "on the rim of"], Way::Edge),
    (&["on the same block as", "in the same block as", "on the block of", "in the block of", "in the block around",
        "on the block around", "within the block of", "on the block where"], Way::Block),
    (&["on both sides of", "along both sides of", "on each side of", "on either side of", "at both sides of",
        "to both sides of", "both sides of", "each side of", "either side of", "the two sides of", "at either side of", "at each side of", "to each side of", "to either side of", "left and right of", "to the left and right of", "to the left and to the right of", "on the left and right of", "on the left and on the right of", "to the right and left of", "at both ends of", "at either end of", "at each end of", "either end of"], Way::Both),
    (&["all over", "throughout", "across", "all across", "over the whole of"], Way::In),
    (&["inside", "inside of", "within", "into", "in the inside of",
        "in the interior of"], Way::To(Relation::Inside)),
    (&["between", "in between", "halfway between", "midway between", "in the middle between", "right between",
        "somewhere between", "in the gap between", "half way between", "in the space between", "inbetween",
        "sandwiched between", "squeezed between", "exactly between"], Way::Between),
    (&["across from", "opposite", "opposite to", "opposite of", "across the street from", "across the road from",
        "on the other side of the street from", "on the other side of the road from", "over the road from",
        "over the street from", "directly across from", "right across from",
        "on the opposite side of the street from", "on the opposite side of the road from", "facing", "vis a vis",
        "across of", "just across from", "vis a vis from", "right opposite", "directly opposite", "exactly opposite", "straight opposite", "straight across from", "face to face with", "over the way from", "right across the street from"], Way::Across),
    (&["along", "lining", "along the side of", "all along", "along the length of", "down the length of",
        "in a row along", "in a line along", "lined up along", "down", "up and down", "following", "all the way down", "all the way along", "all down", "the whole length of", "along the whole length of", "along the whole of", "the full length of", "all the way up",
        "all up and down", "along the edge and side of"], Way::Along),
    (&["at each corner of", "at every corner of", "on each corner of", "on every corner of", "at each of the corners of", "at the corners of", "at all corners of", "at all four corners of",
        "at the four corners of", "in every corner of", "in each corner of", "on the corners of", "at each of its corners", "at every one of the corners of", "in all corners of", "in the corners of", "in the four corners of"], Way::Corners),
    (&["at the corner of", "on the corner of", "at a corner of", "at one corner of", "by the corner of",
        "near the corner of", "in the corner of", "next to the corner of", "on a corner of",
        "at one of the corners of", "at corner of", "on one corner of", "right at the corner of", "in a corner of", "in one corner of",
        "to the corner of"], Way::Corner),
    (&["at", "to", "at position", "to position", "at the point", "at point", "at the position", "at coordinates",
        "at the coordinates", "at location", "up to", "over to", "to the point", "at exactly", "right at",
        "exactly at"], Way::At),
    (&["on"], Way::On),
    (&["in"], Way::In),
    (&["here", "right here", "over here", "where i am", "where i stand", "where im standing", "where i am standing", "to where i am", "to where im standing", "to where i am standing", "to where i stand", "over to me", "to my side", "at my side", "by my side", "where im", "to where im", "to my place", "around here", "near here", "at my feet",
        "in my vicinity", "around me"], Way::Here),
    (&["there", "over there", "right there", "in that spot", "at that spot", "at that place",
        "in that place"], Way::There),
    (&["in its place", "in its stead", "instead", "in its spot", "where it was", "where it stood",
        "in that very spot", "there instead", "in the same place", "at the same place", "in the same spot",
        "at its place", "in place of it", "instead of it", "exactly there", "just there", "in the very same spot", "at same spot", "at the same spot", "on the same spot", "on its spot", "in its very place", "in their place", "where it is", "where it is now", "where it stands", "where it lay", "where it had been", "where it used to be", "at the spot where it lay", "at the spot where it was", "at the spot where it stood", "at the place where it was", "at the place where it stood", "on the spot where it was", "on the spot where it stood", "in that same spot", "on the very same spot"], Way::InItsPlace),
    (&["somewhere", "anywhere", "wherever", "wherever you like", "anywhere you like", "somewhere else", "someplace",
        "anywhere at all", "somewhere in the city", "anywhere in the city", "somewhere in town", "in the city",
        "in the scene", "in town", "anywhere in town", "to the scene", "to the city", "to the world",
        "in the world", "somewhere random", "at random", "at a random place", "randomly", "anywhere you want",
        "wherever you want", "somewhere nice", "any place", "to the map", "on the map", "somewhere on the map",
        "to town", "into the scene", "at some place", "where there is room", "where there is space",
        "wherever there is room", "wherever there is space", "wherever it fits", "where it fits", "somewhere free",
        "on the quay", "at the quay", "on the quayside", "around the harbour", "in the quarter", "around the quarter", "on the waterfront", "to the campus", "on the campus", "somewhere on campus", "on campus", "in the harbour", "in the old town",
        "anywhere on campus", "anywhere you please", "wherever you fancy", "anywhere you fancy", "where you fancy", "wherever you feel like", "where you please", "wherever you please", "where you think best", "wherever you think best", "where you see fit", "wherever you see fit", "out of frame", "somewhere around", "wherever theres room", "wherever theres space", "anywhere in it", "anywhere inside it", "anywhere in there", "anywhere there", "somewhere in it", "wherever in it"], Way::Anywhere),
];

/// Sides of what was spoken of, or of who speaks.
pub(super) static ABOUT_IT: LazyLock<Index<Relation>> = LazyLock::new(|| Index::of(SIDE_ROWS));

#[rustfmt::skip]
const SIDE_ROWS: &[(&[&str], Relation)] = &[
    (&["out front", "at the front", "in front", "up front", "in the front", "out the front", "out in front", "round the front", "around the front", "outside", "right outside", "just outside", "by the entrance", "at the entrance", "outside the door"], Relation::InFrontOf),
    (&["at the back", "out back", "round the back", "in the back", "at the rear", "out the back",
        "around the back", "out at the back", "out in the back", "round back", "in the backyard", "in the back yard"], Relation::Behind),
    (&["to my left", "on my left", "at my left", "on the left", "to the left", "on the left side", "on its left",
        "to its left", "on its left side", "at its left side", "on its left hand side", "on his left side", "on her left side", "to its left side", "left of me"], Relation::LeftOf),
    (&["to my right", "on my right", "at my right", "on the right", "to the right", "on the right side",
        "on its right", "to its right", "on its right side", "at its right side", "on its right hand side", "on his right side", "on her right side", "to its right side", "right of me"], Relation::RightOf),
    (&["nearby", "close by", "next door", "close at hand"], Relation::Near),
];

/// Words that say how a thing is to look, and change nothing.
#[rustfmt::skip]
pub(super) const HARMLESS: &[&str] = &["new", "nice", "beautiful", "lovely", "fresh", "brand", "pretty", "good",
    "fine", "old", "another", "more", "extra", "additional", "single", "few", "couple", "simple", "regular",
    "normal", "ordinary", "standard", "own", "colored", "coloured", "such", "proper", "real", "further", "cool",
    "shiny", "cute", "fancy", "identical", "pair", "of", "bit", "piece", "kind", "sort", "the"];

/// Words of size, with the factor.
pub(super) static SIZES: LazyLock<Index<f64>> = LazyLock::new(|| Index::of(SIZE_ROWS));

#[rustfmt::skip]
const SIZE_ROWS: &[(&[&str], f64)] = &[
    (&["huge", "giant", "gigantic", "enormous", "massive"], 2.0),
    (&["big", "large", "bigger", "larger", "great"], 1.5),
    (&["small", "little", "smaller", "mini"], 0.7),
    (&["tiny", "miniature"], 0.5),
];

/// To close streets.
#[rustfmt::skip]
pub(super) const CLOSING: &[&str] = &["close", "close down", "close off", "shut", "shut down", "shut off", "block",
    "block off", "bar", "barricade", "cordon off", "seal off", "pedestrianise", "pedestrianize", "ban traffic from",
    "ban cars from", "bar traffic from", "bar cars from", "keep traffic out of", "keep cars out of",
    "keep cars off", "keep traffic off", "stop traffic on", "stop the traffic on", "stop cars on", "ban all traffic from", "ban all cars from", "ban traffic on", "ban cars on", "ban all traffic on", "no traffic on", "get the cars off", "get cars off", "get traffic off", "take the cars off", "take traffic off", "stop all traffic on", "stop traffic from using", "stop cars from using", "lock down", "fence off", "pedestrianise", "make car free", "keep all cars off", "keep all traffic off", "keep all traffic out of", "keep vehicles off", "keep vehicles out of"];

/// To open streets.
#[rustfmt::skip]
pub(super) const OPENING: &[&str] = &["open", "reopen", "re open", "open up", "unblock", "unbar", "unseal", "unclose",
    "let traffic back onto", "let the traffic back onto", "let cars back onto", "let the cars back onto",
    "let traffic onto", "let cars onto", "allow traffic on", "allow cars on", "clear for traffic", "open up again",
    "let traffic through", "let the traffic through", "let cars through", "let the cars through", "let traffic back through", "let the traffic back through",
    "let cars back through", "let the cars back through", "let traffic into", "let the traffic into", "let traffic back into", "let the traffic back into",
    "let traffic use", "let the traffic use", "let cars use", "let the cars use", "let traffic along", "let the traffic along", "let people drive through",
    "let people drive on", "let people drive down", "let vehicles through", "let drivers through", "lift the closure of", "lift the closure on", "lift the ban on",
    "end the closure of", "undo the closure of"];

/// How a thing is to change in size, with the factor.
pub(super) static FACTORS: LazyLock<Index<f64>> = LazyLock::new(|| Index::of(FACTOR_ROWS));

#[rustfmt::skip]
const FACTOR_ROWS: &[(&[&str], f64)] = &[
    (&["twice as big", "twice as large", "double the size", "twice the size", "two times bigger", "double in size",
        "double its size", "twice as tall", "twice as high", "two times as big", "twice its size",
        "to twice its size", "to double its size", "to double the size", "to twice the size", "by two",
        "by a factor of two", "by factor two", "twofold", "2 times bigger", "two times larger",
        "two times as large", "doubled", "to twice the original size", "twice bigger", "twice larger", "doubled in size", "doubled in height", "double its current size", "by 100 percent", "the double size", "double size", "the double of its size", "twice the normal size", "double of what it is", "twice what it is", "twice the size it is now", "double the size it is now", "the double"], 2.0),
    (&["tripled", "tripled in size", "three times as big", "three times as large", "triple the size", "three times the size",
        "three times bigger", "triple its size", "three times its size", "by three", "by a factor of three",
        "threefold", "three times larger", "to three times its size", "to triple its size",
        "to three times the size", "three times as tall"], 3.0),
    (&["four times as big", "four times the size", "four times bigger", "four times as large",
        "four times its size", "to four times its size"], 4.0),
    (&["half as big", "half the size", "half its size", "to half its size", "by half", "half as large",
        "to half the size", "half as tall", "in half", "to half", "by a half", "to a half", "half of its size",
        "to half of its size", "to 50 percent", "50 percent smaller", "twice as small", "two times smaller",
        "half as high", "at half size", "half size", "to half size", "half of now", "half of what it is", "half of what it is now",
        "half what it is", "half what it is now", "half its current size", "half the size it is", "half the size it is now", "halved", "halved in size", "halved in height", "by a factor of a half",
        "to half its current size", "half of that", "half that size", "down to half", "down to half its size"], 0.5),
    (&["to three quarters", "three quarters of its size", "to three quarters of its size", "by a quarter smaller", "a quarter smaller", "three quarters the size", "to three quarters its size"], 0.75),
    (&["half as big again", "half again as big", "half as large again", "half as tall again", "by half again", "half again as tall", "half again as large", "to one and a half times its size",
        "half bigger", "a half bigger", "half as high again"], 1.5),
    (&["a quarter bigger", "a quarter larger", "a quarter taller"], 1.25),
    (&["to two thirds", "two thirds of its size", "to two thirds of its size", "a third smaller"], 2.0 / 3.0),
    (&["a third of its size", "to a third of its size", "by two thirds", "to a third", "to one third"], 1.0 / 3.0),
    (&["bigger", "larger", "taller", "big", "large", "a bit bigger", "a little bigger", "somewhat bigger",
        "a bit larger", "a little larger", "higher", "a bit taller"], 1.5),
    (&["much bigger", "much larger", "huge", "gigantic", "enormous", "a lot bigger", "way bigger", "giant",
        "massive", "much taller", "a lot larger"], 2.0),
    (&["smaller", "small", "a bit smaller", "a little smaller", "shorter", "littler",
        "somewhat smaller"], 1.0 / 1.5),
    (&["much smaller", "tiny", "a lot smaller", "way smaller"], 0.5),
];

/// A change of sun, weather or season.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::language) enum Sky {
    Rain(f64),
    Snow(f64),
    Fog(f64),
    Clear,
    Cloudy,
    DryUp,
    NoSnow,
    NoFog,
    Hour(f64),
    Windy(f64),
    /// Air temperature, °C.
    Warmth(f64),
    /// What plants show, with the air that goes with it.
    Season(Season),
}

/// Air temperature that goes with a season, °C.
pub(super) const fn warmth_of(season: Season) -> f64 {
    match season {
        Season::Spring => 13.0,
        Season::Summer => 26.0,
        Season::Autumn => 9.0,
        Season::Winter => -2.0,
    }
}

pub(in crate::language) static SKIES: LazyLock<Index<Sky>> = LazyLock::new(|| Index::of(SKY_ROWS));

#[rustfmt::skip]
pub(in crate::language) const SKY_ROWS: &[(&[&str], Sky)] = &[
    (&["rain", "rainy", "raining", "wet", "rains", "rain weather", "shower", "showers", "drizzle", "drizzly",
        "drizzling", "rainfall", "raindrops", "umbrella weather", "rain shower", "rain showers", "wet weather"], Sky::Rain(4.0)),
    (&["light rain", "drizzle", "a little rain", "a bit of rain", "lightly raining", "rain lightly", "some rain",
        "rain a little"], Sky::Rain(2.0)),
    (&["heavy rain", "pour", "pouring", "downpour", "rain heavily", "pour with rain", "heavily raining", "storm",
        "stormy", "rainstorm", "rain hard", "thunderstorm", "a lot of rain", "rain cats and dogs", "raining cats and dogs", "pelt down", "pelting down", "tip it down", "chuck it down", "torrential rain", "deluge", "cloudburst", "heavens open", "bucket down", "soaking", "pissing down", "pouring down", "bucketing down"], Sky::Rain(20.0)),
    (&["snow", "snowy", "snowing", "snowfall", "snows", "snow weather", "snowflakes", "white christmas", "winter wonderland", "flurries"], Sky::Snow(3.0)),
    (&["light snow", "a little snow", "snow lightly", "snow a little", "some snow"], Sky::Snow(1.0)),
    (&["heavy snow", "blizzard", "snow storm", "snowstorm", "snow heavily", "heavily snowing"], Sky::Snow(10.0)),
    (&["fog", "foggy", "mist", "misty", "hazy", "haze", "some fog", "foggy weather", "murky", "pea soup"], Sky::Fog(200.0)),
    (&["thick fog", "dense fog", "heavy fog", "very foggy", "really foggy"], Sky::Fog(60.0)),
    (&["light fog", "slightly foggy", "a little fog", "a bit foggy", "light mist"], Sky::Fog(600.0)),
    (&["clear", "sunny", "sunshine", "fine", "bright", "clear sky", "clear skies", "clear weather", "nice weather",
        "good weather", "sun shine", "sun shines", "the sky clear", "sky is clear", "sky clear", "cloudless",
        "nice and sunny", "blue sky", "blue skies", "sun come out", "sun comes out", "sun to come out", "sun is shining", "cloud free", "without a cloud", "not a cloud in the sky", "fair weather", "clear up the weather", "clear up the sky", "sunlight", "sunny weather", "brilliant sunshine", "glorious sunshine"], Sky::Clear),
    (&["cloudy", "overcast", "clouds", "grey sky", "gray sky", "clouded"], Sky::Cloudy),
    (&["windy", "wind", "breezy"], Sky::Windy(10.0)),
    (&["winter", "wintry", "in winter", "winter time", "in the winter"], Sky::Season(Season::Winter)),
    (&["freezing", "icy", "frosty"], Sky::Warmth(-2.0)),
    (&["cold", "chilly"], Sky::Warmth(2.0)),
    (&["autumn", "autumnal", "in autumn", "in fall", "in the fall"], Sky::Season(Season::Autumn)),
    (&["cool"], Sky::Warmth(9.0)),
    (&["spring", "in spring", "springtime"], Sky::Season(Season::Spring)),
    (&["mild"], Sky::Warmth(13.0)),
    (&["warm"], Sky::Warmth(22.0)),
    (&["summer", "summery", "in summer", "in the summer"], Sky::Season(Season::Summer)),
    (&["hot", "very hot"], Sky::Warmth(32.0)),
    (&["dawn", "sunrise", "daybreak", "first light", "sun rise", "sun rises", "sun come up", "sun comes up", "sun to rise", "sun to come up", "crack of dawn", "rising sun", "sun rising", "sun up", "break of day"], Sky::Hour(6.0)),
    (&["morning", "early morning", "breakfast time"], Sky::Hour(8.0)),
    (&["noon", "midday", "noontime", "lunchtime", "lunch time", "high noon", "day", "daytime", "day time",
        "daylight"], Sky::Hour(12.0)),
    (&["afternoon"], Sky::Hour(15.0)),
    (&["evening", "evening time", "early evening"], Sky::Hour(19.0)),
    (&["dusk", "sunset", "twilight", "sundown", "nightfall", "sun go down", "sun goes down", "sun set", "sun sets", "sun to set", "sun setting", "sun down", "setting sun", "sun sink", "sun to go down", "gloaming"], Sky::Hour(20.0)),
    (&["night", "nighttime", "night time", "dark", "late night", "late at night", "nightly", "darkness", "pitch dark", "pitch black", "lights out", "dead of night", "middle of the night", "starry", "starry sky", "moonlight", "nocturnal"], Sky::Hour(23.0)),
    (&["midnight"], Sky::Hour(0.0)),
];

/// What stops.
#[rustfmt::skip]
pub(in crate::language) const ENDINGS: &[(&[&str], Sky)] = &[
    (&["rain", "raining", "rainfall", "downpour", "drizzle", "drizzling"], Sky::DryUp),
    (&["snow", "snowing", "snowfall", "blizzard"], Sky::NoSnow),
    (&["fog", "mist", "haze"], Sky::NoFog),
    (&["storm", "clouds", "bad weather"], Sky::Clear),
];

/// Words around weather that say nothing themselves.
#[rustfmt::skip]
pub(super) const SKY_NOISE: &Phrases = &Phrases::of(&["it", "its", "it is", "be", "a", "an", "the", "with", "some", "and",
    "weather", "sky", "is", "to", "into", "time", "of", "day", "it to be", "want", "should be", "should",
    "there is", "there be", "in", "at", "let", "make", "set", "change", "turn", "switch", "have", "lets", "please",
    "time of day", "time to", "its to be", "over the whole quarter", "over the quarter", "over the whole city", "over the city", "over the whole campus", "over the campus", "over the harbour", "over the whole harbour", "over the old town", "over the town", "over everything", "all over the place", "show", "show me", "show us", "quarter", "old town", "crisp", "heavy", "lovely", "quiet", "gentle", "thick", "steady", "beautiful", "give us", "give me", "bring", "bring on", "i want", "id like", "i would like", "now",
    "very", "get", "conditions", "become", "there should be", "on", "start", "begin", "starts", "here", "today",
    "scene", "city", "us", "out", "outside", "looks", "look", "like", "bit", "little", "made", "clock", "oclock",
    "o clock", "that", "need", "we", "i", "so", "everything", "put", "weather to", "add", "will", "would", "could",
    "can", "you", "by", "whole", "one", "really", "nice", "after", "would like", "more", "campus", "harbour",
    "town", "just", "mode", "can you", "atmosphere", "mood", "environment", "lighting", "light", "hour", "for",
    "supposed", "let it be", "supposed to be", "season", "months", "late", "early", "atmospheric", "quite", "pitch", "say", "see", "place", "in falling", "could we", "can we", "under", "beneath", "lots of", "plenty of", "maybe", "perhaps", "how about", "what about", "turned", "over everything", "around", "about", "roughly", "sharp", "exactly", "blanket of", "layer of", "hint of", "touch of",
    "then", "fall", "falling", "come", "coming", "down", "shall", "must", "shooting", "filming", "shoot", "thats",
    "show me", "show us", "show", "let me see", "id like to see", "i want to see", "keep", "stay", "stays", "keep it", "this", "wouldnt", "hurt", "love", "wish", "were", "if", "was", "story", "party", "takes place", "set in", "id love", "wed like",
    "could do with", "could use", "wed love", "mood", "picture", "be nice", "i feel like", "feel like", "i am in the mood for", "im in the mood for", "in the mood for", "time for", "fancy", "i fancy", "nothing beats", "go for", "lets go for", "already", "christmas", "sound", "please let", "wanna", "hope for", "switch to", "change to", "get me", "gets", "it gets", "getting", "turning", "going", "go", "goes", "grow", "nicely", "proper", "properly", "good", "old", "any chance of", "chance of", "were having", "we are having", "having", "as if", "everywhere", "here please", "bit more", "dreary", "grey", "spooky", "romantic", "cosy", "cozy", "slowly", "soon", "gradually", "quickly", "shortly", "finally", "for once", "in my story", "in the story", "for the story", "for my film", "for the film", "film", "movie", "scene to", "over the city", "over the town", "over the harbour", "over the campus", "spell of", "dose of", "splash of", "sprinkling of", "bout of", "be great", "lovely", "please make"]);

/// The phrases of place.
pub(super) fn ways() -> impl Iterator<Item = &'static str> {
    WAY_ROWS.iter().flat_map(|(words, _)| *words).copied()
}

/// The phrases of orders.
pub(super) fn verbs() -> impl Iterator<Item = &'static str> {
    VERB_ROWS.iter().flat_map(|(words, _)| *words).copied()
}

/// Every single word here, so that none is taken for a misspelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let verbs = VERB_ROWS.iter().flat_map(|(words, _)| *words);
    let ways = WAY_ROWS.iter().flat_map(|(words, _)| *words);
    let skies = SKY_ROWS.iter().chain(ENDINGS).flat_map(|(words, _)| *words);
    let sizes = SIZE_ROWS.iter().chain(FACTOR_ROWS).flat_map(|(words, _)| *words);
    let sides = SIDE_ROWS.iter().flat_map(|(words, _)| *words);
    let more = super::super::numbers::words_of_length()
        .chain(super::super::whereabouts::words())
        .chain(super::more_words());
    let phrases = verbs.chain(ways).chain(sides).chain(skies).chain(sizes).chain(HARMLESS).chain(SKY_NOISE);
    phrases.flat_map(|phrase| phrase.split(' ')).chain(more)
}
