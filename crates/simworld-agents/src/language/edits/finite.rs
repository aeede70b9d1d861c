//! Verbs in the forms in which they tell something: "strays", "they stare", "he told".
//!
//! The table holds base forms of what people, animals and things do in remarks; verbs of edits are no part of it unless they are said of
//! others as well.

/// Base forms, sorted.
#[rustfmt::skip]
const BASES: &[&str] = &[
    "accept", "accuse", "ache", "act", "admire", "admit", "adopt", "adore", "advise", "afford", "agree", "aim", "allow", "amaze", "amuse", "annoy",
    "answer", "apologise", "appeal", "appear", "applaud", "approach", "approve", "argue", "arrive", "ask", "assume", "attack", "attend", "attract",
    "avoid", "awake", "bake", "balance", "ban", "bark", "bathe", "battle", "beam", "bear", "beat", "beg", "begin", "behave", "believe", "belong",
    "bend", "bet", "bicker", "bite", "blame", "blaze", "bleed", "bless", "blind", "blink", "block", "bloom", "blow", "blush", "boast", "boil",
    "bore", "borrow", "bother", "bounce", "bow", "brag", "brake", "break", "breathe", "breed", "brew", "bring", "broadcast", "bruise", "brush",
    "bubble", "bully", "bump", "burn", "burst", "buy", "buzz", "call", "calm", "camp", "care", "carry", "carve", "catch", "cause", "celebrate",
    "challenge", "charge", "charm", "chase", "chat", "cheat", "cheer", "chew", "choke", "choose", "claim", "clap", "clash", "climb", "cling",
    "collapse", "collect", "collide", "come", "comfort", "command", "commute", "compete", "complain", "complement", "concern", "confess", "confuse",
    "connect", "consider", "consist", "contain", "continue", "cook", "cool", "cost", "cough", "count", "crack", "crash", "crave", "crawl", "creak",
    "creep", "cringe", "cross", "crowd", "crumble", "cry", "cuddle", "curse", "cycle", "damage", "dance", "dare", "dazzle", "deafen", "deal",
    "decay", "decide", "declare", "decline", "defend", "delay", "deliver", "demand", "deny", "depend", "deserve", "desire", "destroy", "develop",
    "devour", "dictate", "die", "differ", "dig", "dine", "dip", "disagree", "disappoint", "discover", "discuss", "dislike", "disturb", "dive",
    "divide", "dominate", "donate", "doubt", "drag", "drain", "draw", "dread", "dream", "dress", "drift", "drink", "drip", "drive", "drop", "drown",
    "dry", "dwell", "earn", "eat", "echo", "eclipse", "embarrass", "emerge", "employ", "encourage", "end", "endure", "enjoy", "enter", "entertain",
    "envy", "escape", "exist", "expect", "experience", "expire", "explain", "explode", "explore", "express", "face", "fail", "faint", "fall",
    "fancy", "fascinate", "favour", "fear", "feed", "feel", "fetch", "fidget", "fight", "fill", "film", "finish", "fire", "fit", "flap", "flash",
    "flatter", "flee", "flicker", "float", "flock", "flood", "flourish", "flow", "flower", "fly", "follow", "fool", "forbid", "forget", "forgive",
    "freeze", "frighten", "frolic", "frown", "fry", "function", "gain", "gallop", "gasp", "gather", "gaze", "get", "giggle", "give", "glance",
    "glare", "gleam", "glide", "glitter", "glow", "gnaw", "go", "gobble", "gossip", "govern", "grab", "graduate", "graze", "greet", "grieve", "grin",
    "grow", "growl", "grumble", "guard", "guess", "guide", "hack", "haggle", "handle", "hang", "happen", "harm", "hate", "haunt", "head", "heal",
    "hear", "heat", "help", "hesitate", "hibernate", "hide", "hinder", "hint", "hire", "hit", "hog", "hold", "hoot", "hope", "host", "hover", "howl",
    "huddle", "hug", "hum", "hunt", "hurry", "hurt", "ignore", "imagine", "impress", "inherit", "insist", "inspire", "insult", "intend", "interest",
    "interrupt", "invade", "invite", "itch", "jog", "joke", "jostle", "judge", "juggle", "jump", "keep", "kick", "kill", "kneel", "knit", "know",
    "lack", "last", "laugh", "launch", "lead", "leak", "lean", "leap", "learn", "leave", "lecture", "lend", "lick", "lie", "lift", "light", "like",
    "limp", "linger", "listen", "litter", "live", "loathe", "loiter", "long", "look", "loom", "lose", "lounge", "love", "lunch", "lurk", "make",
    "manage", "march", "marry", "match", "matter", "mean", "measure", "meet", "melt", "mention", "mind", "miss", "mistake", "moan", "mock", "moo",
    "mourn", "mumble", "murmur", "mutter", "nag", "nap", "need", "neglect", "nest", "nestle", "nibble", "nod", "note", "notice", "obey", "object",
    "observe", "obstruct", "occur", "offend", "offer", "open", "operate", "order", "outlive", "overflow", "overheat", "overlook", "overtake", "owe",
    "own", "pace", "pack", "panic", "park", "part", "pass", "pause", "pay", "peck", "peel", "peep", "peer", "perform", "perish", "permit",
    "persuade", "pester", "picnic", "pile", "pinch", "plan", "play", "plead", "please", "plot", "plunge", "point", "poke", "pollute", "ponder",
    "possess", "pour", "practise", "praise", "pray", "preach", "prefer", "prepare", "pretend", "prevail", "prevent", "proceed", "produce", "promise",
    "propose", "protect", "protest", "prove", "provide", "prowl", "publish", "puff", "punish", "push", "puzzle", "quack", "quarrel", "queue", "quit",
    "race", "rage", "rain", "rant", "rattle", "reach", "react", "read", "realise", "recall", "receive", "reckon", "recognise", "recommend",
    "recover", "reek", "refer", "reflect", "refuse", "regret", "rehearse", "reign", "relax", "rely", "remain", "remember", "remind", "rent",
    "reopen", "repair", "repeat", "repel", "reply", "report", "resemble", "respect", "respond", "rest", "retire", "return", "reveal", "revolve",
    "rhyme", "ride", "ring", "rise", "roam", "roar", "rob", "roll", "roost", "rot", "rub", "ruin", "rule", "rumble", "run", "rush", "rust", "rustle",
    "sag", "save", "say", "scamper", "scare", "scatter", "scoff", "scorch", "score", "scowl", "scrape", "scratch", "scream", "scuttle", "search",
    "see", "seem", "sell", "send", "serve", "settle", "shade", "shake", "share", "shed", "shelter", "shimmer", "shine", "shiver", "shock", "shoot",
    "shop", "shout", "show", "shriek", "shrug", "shuffle", "shut", "sigh", "simmer", "sing", "sink", "sit", "sizzle", "skate", "sketch", "skid",
    "sleep", "slip", "slouch", "slow", "slump", "smell", "smile", "smirk", "smoke", "snap", "snarl", "sneak", "sneeze", "sniff", "snooze", "snore",
    "snow", "soak", "sob", "socialise", "sound", "sparkle", "speak", "speed", "spend", "spill", "spin", "spit", "splash", "spoil", "sponsor", "spot",
    "sprawl", "spread", "spring", "sprout", "squabble", "squat", "squeak", "squeal", "squeeze", "squint", "stagger", "stain", "stall", "stand",
    "stare", "start", "starve", "stay", "steal", "step", "stick", "sting", "stink", "stoop", "stop", "strain", "strand", "stray", "stretch",
    "stroll", "struggle", "strut", "study", "stumble", "stutter", "suffer", "suggest", "suit", "supervise", "supply", "support", "suppose", "surf",
    "surprise", "surround", "survive", "suspect", "swagger", "swallow", "swarm", "sway", "swear", "sweat", "swell", "swim", "swing", "swoop",
    "sympathise", "take", "talk", "tan", "tarnish", "taste", "teach", "tear", "tease", "tell", "tempt", "tend", "thank", "think", "thrash",
    "threaten", "thrive", "throb", "throw", "thunder", "tick", "tickle", "tie", "tingle", "tire", "topple", "touch", "tower", "train", "trample",
    "travel", "tread", "treat", "tremble", "trick", "trickle", "trip", "trouble", "trudge", "trust", "try", "tug", "tumble", "turn", "twinkle",
    "twist", "twitch", "understand", "unite", "unload", "upset", "urge", "use", "value", "vanish", "vary", "vibrate", "visit", "volunteer", "vote",
    "vow", "waddle", "wade", "wag", "wail", "wait", "wake", "walk", "wander", "want", "warm", "warn", "wash", "waste", "watch", "wave", "weaken",
    "wear", "weep", "weigh", "welcome", "wheeze", "whine", "whirl", "whisper", "whistle", "wilt", "win", "wince", "wink", "wish", "wither", "wobble",
    "wonder", "work", "worry", "worsen", "worship", "wreck", "wriggle", "write", "yawn", "yearn", "yell", "yelp", "yield", "zoom",
];
/// Forms of the past that follow no rule, sorted.
#[rustfmt::skip]
const PASTS: &[&str] = &[
    "arose", "ate", "awoke", "became", "began", "bent", "bet", "bit", "bled", "blew", "bought", "broke", "brought", "built", "burnt", "came",
    "caught", "chose", "clung", "cost", "crept", "dealt", "did", "died", "drank", "drew", "drove", "dug", "dwelt", "fed", "fell", "felt", "fled",
    "flew", "flung", "forbade", "forgave", "forgot", "fought", "found", "froze", "gave", "got", "grew", "had", "heard", "held", "hid", "hung", "hurt", "kept",
    "knelt", "knew", "laid", "leapt", "learnt", "led", "lent", "lost", "made", "meant", "met", "mistook", "paid", "proved", "quit", "ran", "rang",
    "rode", "rose", "said", "sang", "sank", "sat", "saw", "sent", "shone", "shook", "shot", "shrank", "slept", "slid", "slung", "smelt", "sold",
    "sought", "sowed", "spat", "sped", "spent", "spilt", "spoilt", "spoke", "sprang", "stank", "stole", "stood", "strode", "strove", "struck",
    "stuck", "stung", "swam", "swept", "swore", "swung", "taught", "thought", "threw", "told", "took", "tore", "trod", "understood", "was", "went",
    "wept", "were", "woke", "won", "wore", "wove", "wrote",
];
/// What is finite wherever it stands.
#[rustfmt::skip]
const AUXILIARIES: &[&str] = &[
    "is", "are", "was", "were", "am", "has", "have", "had", "does", "do", "did", "can", "cant", "cannot", "could", "couldnt", "will", "wont", "would",
    "wouldnt", "might", "may", "isnt", "arent", "wasnt", "werent", "hasnt", "havent", "hadnt", "doesnt", "dont", "didnt", "aint",
];

/// Whether a word is a verb that tells something by itself: "is", "couldn't".
pub(super) fn is_auxiliary(word: &str) -> bool {
    AUXILIARIES.contains(&word)
}

/// Whether a word is a verb as it is said of one ("strays") or of what was ("told", "carved").
pub(super) fn is_told_of_one(word: &str) -> bool {
    let is_past = word.len() > 4 && word.ends_with("ed") && !word.ends_with("eed");
    is_past || PASTS.binary_search(&word).is_ok() || third_person(word)
}

/// Whether a word is a verb as it is said of several: "stray".
pub(super) fn is_base(word: &str) -> bool {
    BASES.binary_search(&word).is_ok()
}

fn third_person(word: &str) -> bool {
    let Some(stem) = word.strip_suffix('s') else { return false };
    let is_one = |base: &str| BASES.binary_search(&base).is_ok();
    let by_es = stem.strip_suffix('e').filter(|base| base.ends_with(['s', 'h', 'x', 'z', 'o']));
    let by_ies = stem.strip_suffix("ie").map(|base| format!("{base}y"));
    is_one(stem) || by_es.is_some_and(is_one) || by_ies.is_some_and(|base| is_one(&base))
}

#[cfg(test)]
mod tests {
    use super::{BASES, PASTS, is_base, is_told_of_one};

    #[test]
    fn tables_are_sorted() {
        assert!(BASES.is_sorted() && PASTS.is_sorted());
    }

    #[test]
    fn forms_are_known() {
        for word in ["strays", "misses", "carries", "told", "carved", "goes"] {
            assert!(is_told_of_one(word), "{word}");
        }
        for word in ["stray", "bench", "benches", "red", "cones", "seed"] {
            assert!(!is_told_of_one(word), "{word}");
        }
        assert!(is_base("stray") && !is_base("bench"));
    }
}
