//! What one can be told to do, in many words, and the words around it.

/// What one can be told to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verb {
    Go,
    Run,
    Stroll,
    Follow,
    Cross,
    Take,
    Deliver,
    Give,
    Drop,
    PutDown,
    Buy,
    Sit,
    StandUp,
    Stop,
    Wait,
    Board,
    Drive,
    Alight,
    Step,
    Reverse,
    Turn,
    Look,
    Face,
    Point,
    Wave,
    Talk,
    Greet,
    Say,
    Tell,
    Argue,
    Open,
    Close,
    Photo,
    Faster,
    Slower,
    SetSpeed,
}

/// Verbs with their words; the longest that fits is taken.
pub(super) const VERBS: &[(&[&str], Verb)] = &[
    (
        &[
            "go", "got to", "walk", "head", "navigate", "move", "come", "travel", "proceed", "get to", "get back to",
            "make your way", "go back", "come back", "return", "find", "approach", "visit", "reach", "inspect", "meet",
            "march", "wander", "locate", "get over to", "get yourself to", "advance", "pay a visit to", "check out", "look for", "search for", "seek", "head for", "make for",
            "stand next to", "stand by", "stand near", "stand beside", "stand at", "stand behind", "stand in front of",
            "find your way", "get close to", "get near", "get nearer to",
        ],
        Verb::Go,
    ),
    (&["run", "hurry", "rush", "sprint", "jog", "dash", "race"], Verb::Run),
    (&["stroll", "amble", "saunter"], Verb::Stroll),
    (&["follow", "pursue", "tail", "chase", "go after", "walk after", "run after", "walk behind", "accompany", "shadow", "trail"], Verb::Follow),
    (&["cross", "cross over", "walk across", "go across"], Verb::Cross),
    (
        &["pick up", "pick", "take", "grab", "fetch", "collect", "get", "lift", "carry", "lift up", "take hold of",
          "get hold of", "retrieve", "grasp", "seize", "bring me"],
        Verb::Take,
    ),
    (&["deliver", "bring", "transport"], Verb::Deliver),
    (&["give", "hand", "hand over", "pass", "offer"], Verb::Give),
    (&["drop off", "drop", "leave", "release", "let go of", "let go"], Verb::Drop),
    (&["put down", "set down", "put", "place", "lay down", "lay"], Verb::PutDown),
    (&["buy", "purchase", "order", "buy yourself", "get yourself", "pay for"], Verb::Buy),
    (&["sit down", "sit", "take a seat", "have a seat", "be seated", "seat yourself", "take a rest", "grab a seat"], Verb::Sit),
    (&["stand up", "stand", "get up", "rise", "get to your feet", "get on your feet"], Verb::StandUp),
    (
        &["stop", "halt", "freeze", "stand still", "stay", "stay here", "stay there", "stop there", "remain",
          "stay put", "stay where you are", "remain where you are", "dont move", "hold still", "remain here", "remain there"],
        Verb::Stop,
    ),
    (&["wait", "pause", "rest", "hang on", "hold on", "stand by for", "wait around"], Verb::Wait),
    (
        &["ride", "get on", "get onto", "get in", "get into", "enter", "board", "mount", "hop on", "hop in",
          "climb into", "climb in", "jump into", "jump in", "jump on", "hop into", "hop onto", "climb on", "step into",
          "get inside", "go into", "go inside", "walk into"],
        Verb::Board,
    ),
    (&["drive"], Verb::Drive),
    (
        &["get off", "get out", "get out of", "exit", "dismount", "alight", "hop off", "hop out", "step out of",
          "climb out", "climb out of", "jump out", "leave the car", "leave the vehicle", "step off", "get down from", "get down", "climb off"],
        Verb::Alight,
    ),
    (&["step"], Verb::Step),
    (&["reverse", "back up"], Verb::Reverse),
    (&["turn", "rotate", "pivot", "spin"], Verb::Turn),
    (
        &["look at", "look towards", "look", "gaze at", "stare at", "watch", "look over at", "glance at", "observe",
          "look toward", "have a look at", "take a look at", "gaze"],
        Verb::Look,
    ),
    (&["face", "turn towards", "turn toward", "turn to face", "turn to", "rotate towards", "turn around to face", "keep an eye on"], Verb::Face),
    (&["point at", "point to", "point towards", "point", "point out", "indicate", "gesture at", "point toward"], Verb::Point),
    (&["wave", "wave at", "wave to", "wave your hand at", "wave your hand to", "wave hello to", "wave goodbye to"], Verb::Wave),
    (
        &["talk to", "talk with", "speak to", "speak with", "chat with", "chat to", "have a chat with", "converse with",
          "have a conversation with", "have a word with", "address", "discuss with", "talk", "speak", "chat",
          "strike up a conversation with"],
        Verb::Talk,
    ),
    (&["greet", "welcome", "say hello to", "say hi to", "salute"], Verb::Greet),
    (&["say", "shout", "whisper"], Verb::Say),
    (&["tell", "ask", "inform"], Verb::Tell),
    (&["argue with", "quarrel with", "disagree with", "have an argument with", "argue", "fight with", "quarrel", "row with"], Verb::Argue),
    (&["open", "open up", "push open", "pull open"], Verb::Open),
    (&["close", "shut"], Verb::Close),
    (
        &["take a photo", "take a picture", "take photo", "photograph", "take a photograph", "snap a photo",
          "snap a picture", "take a snapshot", "shoot a photo", "take photos", "take pictures", "snap", "take a pic",
          "take a selfie", "capture a photo", "take another photo"],
        Verb::Photo,
    ),
    (&["speed up", "go faster", "walk faster", "move faster", "faster", "accelerate", "hurry up", "pick up the pace"], Verb::Faster),
    (&["slow down", "go slower", "walk slower", "move slower", "slower", "decelerate", "walk more slowly", "go more slowly", "move more slowly"], Verb::Slower),
    (
        &["set your speed to", "change your speed to", "set the speed to", "change speed to", "change the speed to",
          "set speed to", "adjust your speed to", "walk at", "move at", "go at", "run at"],
        Verb::SetSpeed,
    ),
];

/// Ways to join two orders.
pub(super) const JOINTS: &[&str] = &[
    "and", "then", "next", "after that", "afterwards", "finally", "also", "first", "lastly", "after this", "later",
    "second", "subsequently", "firstly", "secondly", "thirdly", "to begin with", "to start with", "in the end",
    "when you are done", "when youre done", "once youre done", "once you are there", "when you get there", "plus",
    "once you are done", "when youve done that", "once there", "followed by", "at last", "immediately",
];

/// Politeness around an order.
pub(super) const FILLERS: &[&str] = &[
    "please", "kindly", "could you", "can you", "would you", "will you", "might you", "may you", "i want you to",
    "i would like you to", "id like you to", "i need you to", "you should", "you must", "you have to", "you need to",
    "you can", "you may", "you could", "you will", "try to", "lets", "let us", "just", "now", "hey", "hey there", "hi",
    "hello", "hello there", "ok", "okay", "thanks", "thank you", "for me", "so", "good morning", "good evening",
    "good afternoon", "good day", "thanks a lot", "thank you very much", "thank you so much", "many thanks", "cheers",
    "be so kind as to", "be so good as to", "be kind enough to", "be a dear and", "would you mind", "do you mind",
    "i was wondering if you could", "i wonder if you could", "i wonder whether you could", "it would be great if you could",
    "it would be nice if you could", "would it be possible to", "would it be possible for you to", "is it possible to",
    "why dont you", "how about you", "do me a favour and", "do me a favor and", "feel free to", "your task is to",
    "your job is to", "your mission is to", "your goal is to", "the task is to", "sorry to bother you", "excuse me",
    "pardon me", "if you like", "if you dont mind", "if you can", "if possible", "if you please", "if its possible",
    "when you can", "when you have time", "when you have a moment", "whenever you are ready", "right away", "right now",
    "at once", "straight away", "as soon as possible", "asap", "a lot", "very much", "pretty please", "pretty",
    "dear robot", "dear", "robot", "alright", "all right", "well", "right then", "go and", "come and", "go ahead and",
    "yeah", "yes", "sure", "buddy", "mate", "friend", "my friend", "sir", "madam", "be sure to", "make sure to",
    "make sure you", "remember to", "dont forget to", "you", "quickly", "carefully", "quietly", "calmly", "slowly",
    "gently", "simply", "maybe", "perhaps", "possibly", "immediately", "again", "we should", "i want to see you",
    "it is time to", "its time to", "time to", "start to", "begin to", "start", "begin", "would you kindly",
    "i would appreciate it if you could", "i would appreciate if you could", "i ask you to", "im asking you to",
    "can i ask you to", "could i ask you to", "may i ask you to", "the next thing is to", "after all", "there",
    "would you be so good as to", "would you be so kind as to", "if you would", "if you wouldnt mind", "over there",
    "i think you should", "i suggest you", "im begging you", "somewhere", "anywhere", "i want to", "i would like to", "id like to", "i need to", "im going to", "oh", "ah", "ahem", "hmm", "erm", "uh", "um", "er",
];

/// Sounds of hesitation; they are dropped wherever they stand.
pub(super) const HESITATIONS: &[&str] = &["uh", "um", "er", "erm", "hmm", "hm", "ahem", "eh", "ehm", "uhm"];

/// Words that turn an order into its contrary.
pub(super) const NEGATIONS: &[&str] =
    &["dont", "do not", "never", "not", "you must not", "you mustnt", "you should not", "you shouldnt", "avoid", "refrain from"];

/// The base form of an inflected verb, if the word is one: "sitting", "walked", "goes".
pub(super) fn base_form(word: &str) -> Option<String> {
    const IRREGULAR: &[(&str, &str)] = &[
        ("went", "go"), ("gone", "go"), ("goes", "go"), ("sat", "sit"), ("took", "take"), ("taken", "take"),
        ("ran", "run"), ("stood", "stand"), ("bought", "buy"), ("gave", "give"), ("given", "give"), ("got", "get"),
        ("gotten", "get"), ("told", "tell"), ("said", "say"), ("spoken", "speak"), ("ridden", "ride"), ("rode", "ride"),
        ("drove", "drive"), ("driven", "drive"), ("brought", "bring"), ("met", "meet"), ("found", "find"), ("came", "come"), ("made", "make"), ("lying", "lie"),
    ];
    if word == "lets" {
        return None; // "let us"
    }
    let is_verb = |stem: &str| {
        VERBS.iter().any(|(phrases, _)| phrases.iter().any(|phrase| phrase.split(' ').next() == Some(stem)))
    };
    if let Some((_, base)) = IRREGULAR.iter().find(|(form, _)| *form == word) {
        return (*base != word).then(|| (*base).to_owned());
    }
    for ending in ["ing", "ed", "es", "s"] {
        let Some(stem) = word.strip_suffix(ending).filter(|stem| stem.len() >= 2) else { continue };
        let mut forms = vec![stem.to_owned(), format!("{stem}e")];
        let letters: Vec<char> = stem.chars().collect();
        if let [.., a, b] = letters[..]
            && a == b
        {
            forms.push(letters[..letters.len() - 1].iter().collect());
        }
        if let Some(base) = forms.into_iter().find(|form| is_verb(form)) {
            return Some(base);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inflected_verbs_have_their_base() {
        for (word, base) in
            [("sitting", "sit"), ("walking", "walk"), ("waving", "wave"), ("sat", "sit"), ("goes", "go"), ("dropped", "drop")]
        {
            assert_eq!(base_form(word).as_deref(), Some(base));
        }
        assert_eq!(base_form("bench"), None);
        assert_eq!(base_form("thing"), None);
    }
}
