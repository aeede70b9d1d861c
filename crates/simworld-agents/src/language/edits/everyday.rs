//! Everyday verbs and frames of everyday English, and what they mean, in the notation of [`super::turns`]: how something is fastened, made or carried
//! where it is to stand ("nail together a kennel", "tie up a rowboat", "slide a stool in"), who is sent somewhere and who turns to whom, wishes that begin
//! with "were", what all but one are to be, whom to tell of something, and what was stolen and is wanted anew.
//!
//! Most of them are tried only where a sentence was refused ([`super::anew`]). Verbs that also say that something is to be gone ("pull out", "knock
//! down") stand here only with words behind which nothing goes.

use super::retold::Turns;

/// What is put plainly before a sentence is read, since "me" would be taken for a thing, and all but some for all.
#[rustfmt::skip]
pub(super) const EVERYDAY_FIRST: &Turns = &[
    ("O do|paint|colour|color me|us N in|- K", "O paint N K"),
    ("O make me|us N in K", "O paint N K"),
    // All but some would be all at first, and then some.
    ("O remove|delete|erase|clear|scrap|ditch|bin N , all|every|each|everyone one|of|- them|- but|except|bar|save|excluding|barring for|- V", "O remove all N except V"),
];

/// What is tried where a sentence was refused, one sentence each.
#[rustfmt::skip]
pub(super) const EVERYDAY: &Turns = &[
    // How something new is fastened, made or carried, and where it stands then.
    ("O nail|screw|glue|bolt|weld|solder|stitch|sew|hammer|tie|lash|rope|chain|strap|clip|hook|peg|pin|rivet|staple|tape|wire|plug|click|bind|secure|clamp|cement|concrete|mortar|stake|wedge together|up|in|down|on|- D A together|up|in|down|on|there|- right|just|directly|close|- W", "O put D A W"),
    ("O knock|cobble|patch|bash|hammer|nail|saw|slap|throw|piece|bang|stitch|lash|bolt|tack|whack|botch together D A W", "O put D A W"),
    ("O knock|cobble|patch|bash|hammer|nail|saw|slap|throw|piece|bang|stitch|lash|bolt|tack|whack|botch D A together W", "O put D A W"),
    ("O carve|chisel|sculpt|forge|craft|fashion|weave|knit|cast|mould|engineer|concoct|contrive|devise|improvise|rig up|out|- D A W", "O put D A W"),
    ("O slide|push|pull|wheel|roll|shove|drag|carry|lug|squeeze|trundle|cart|edge|ease|nudge|swing|manoeuvre|maneuver|reverse|back|slip|sneak|smuggle|tuck|winch|crane|airlift|lower|float|row|sail|paddle|steer|fly|land|coax|lure|tempt|invite|usher|beckon|seat|shepherd|herd|plump|plop|stow in|over|along|across|- D A in|over|along|across|- right|just|directly|close|- W", "O put D A W"),
    // What is there.
    ("O nail|screw|glue|bolt|weld|tie|lash|rope|chain|strap|clip|hook|peg|pin|rivet|staple|tape|bind|secure|clamp|stake|wedge up|down|on|in|- N up|down|on|in|- right|just|directly|close|- W", "O move N W"),
    ("O slide|push|wheel|roll|shove|drag|carry|lug|squeeze|trundle|cart|edge|ease|nudge|swing|manoeuvre|maneuver|reverse|slip|sneak|tuck|winch|crane|airlift|float|row|sail|paddle|steer|coax|lure|tempt|usher|beckon|shepherd|herd in|over|along|across|- N in|over|along|across|- right|just|directly|close|- W", "O move N W"),
    // Who is sent somewhere, or told to look at something.
    ("O send|dispatch|order|tell|ask|beg|instruct|command|invite D A to sit|stand|wait|stay|be|go|rest|lie|come|walk|move|play|work|sing|perform|busk over|up|out|down|- W", "O put D A W"),
    ("O send|dispatch|order|tell|ask|beg|instruct|command|invite A to sit|stand|wait|stay|be|go|rest|lie|come|walk|move|play|work|sing|perform|busk over|up|out|down|- W", "O move A W"),
    ("P , and|then tell|ask|order|beg|instruct|command|get A to look|stare|gaze|glance|peer at|to|towards|toward|over|- B", "P , and make A face B"),
    ("P and|then tell|ask|order|beg|instruct|command|get A to look|stare|gaze|glance|peer at|to|towards|toward|over|- B", "P and make A face B"),
    ("O tell|ask|order|beg|instruct|command A to look|stare|gaze|glance|peer at|to|towards|toward|over|- B", "O make A face B"),
    ("O walk|move|bring|take|lead|guide|escort|shift|carry|push|pull|drag|wheel|roll|slide|send|put|place A over|up|along|across|down|here|there|- so|until|till that|- he|she|it|they|hes|shes|its|theyre is|are|stands|stand|sits|sit|ends|end|winds|wind|waits|wait|- up|down|- standing|sitting|waiting|- right|just|directly|- W", "O move A W"),
    // Who goes and who turns, told as it happens.
    ("A goes|moves|walks|steps|comes|strolls|heads|wanders|hops|runs|shuffles|trots over|down|up|across|- W ,|- and|while|then|as B turns|swivels|spins|pivots|rotates round|around|- to|and|- face|faces|towards|toward C", "move A W and make B face C"),
    ("A turns|swivels|spins|pivots|rotates round|around|- to|and|- face|faces|towards|toward B ,|- and|while|then|as C goes|moves|walks|steps|comes|strolls|heads|wanders|hops|runs|shuffles|trots over|down|up|across|- W", "make A face B and move C W"),
    ("A turns|swivels|pivots round|around|- to|and face|faces B", "make A face B"),
    // Who changes places.
    ("O could|can|would|will|might|may|should|must|shall|let|have|make|get A and B please|kindly|to|- trade|swap|change|switch|exchange places|seats|spots|positions|place|spot|position with|- each|one|- other|another|- for|- me|us|-", "O swap A and B"),
    // What would be nice, with the verb first.
    ("it|that|things|everything would|might|could|d be|look|feel|seem|- X were N to|- be|become|turn|go|- painted|coloured|colored|done|- in|- K", "paint N K"),
    ("it|that|things|everything would|might|could|d be|look|feel|seem|- X were N to|- stand|sit|be|go|move|live|wait|- over|- W", "move N W"),
    ("it|that|things|everything would|might|could|d be|look|feel|seem|- X were there to|- be|- D A", "add D A"),
    ("it|that|things|everything would|might|could|d be|look|feel|seem|- X were D A to|- stand|sit|be|go|grow|wait|- W", "put D A W"),
    ("were N to|- be|become|turn|go|- painted|coloured|colored|done|- in|- K , it|that|things|everything|they|he|she would|might|could|d X", "paint N K"),
    ("were N to|- stand|sit|be|go|move|live|wait|- over|- W , it|that|things|everything|they|he|she would|might|could|d X", "move N W"),
    ("were D A to|- stand|sit|be|go|grow|wait|- W , it|that|things|everything would|might|could|d X", "put D A W"),
    // All of them but some.
    ("O paint|repaint|colour|color|dye|spray|make|turn|want|have N K , all|every|each|everyone one|of|- them|- but|except|bar|save|excluding|barring for|- V", "O paint all N except V K"),
    ("O paint|repaint|colour|color|dye|spray|make|turn|want|have N K , except|bar|save|excluding|barring for|- V", "O paint all N except V K"),
    ("O remove|delete|erase|clear|scrap|ditch|bin N , except|bar|save|excluding|barring for|- V", "O remove all N except V"),
    ("O move|shift|bring|push|carry N W , all|every|each|everyone one|of|- them|- but|except|bar|save|excluding|barring for|- V", "O move all N except V W"),
    ("O move|shift|bring|push|carry N W , except|bar|save|excluding|barring for|- V", "O move all N except V W"),
    // Whom to tell of something.
    ("O tell|inform|teach|enlighten my|our|the|these|this|those|his|her|their|your X a|something|anything|more|everything|all|some bit|little|few|lot|- more|thing|things|words|word|facts|- about|on A", "describe A"),
    ("O tell|inform|teach|enlighten my|our|the|these|this|those|his|her|their|your visitors|visitor|guests|guest|kids|children|pupils|students|class|group|wife|husband|mother|father|son|daughter|friend|friends|tourists|customers|team|boss|colleagues|audience|readers|viewers|family|crew about A", "describe A"),
    // What is to be gone.
    ("O make|let vanish|disappear|evaporate for|to me|us N Q", "O remove N Q"),
    ("O A for me|us N Q", "O A N Q"),
    // What was lost is wanted anew.
    ("my|our|your|his|her|their|the A got|was|were|is|has|have|went been|gone|- stolen|nicked|pinched|lost|broken|smashed|wrecked|crushed|missing|ruined|vandalised|damaged|gone|burnt|burned|kaput|bust X|- , so|and|hence|- please|- put|place|set|add|stand|leave|park|get|bring|give|buy|plant me|us|- a|another|one new|second|fresh|- one|replacement|- W", "put a A W"),
    ("somebody|someone|they|thieves|vandals|hooligans|he|she stole|nicked|pinched|took|broke|wrecked|smashed|crushed|ruined my|our|your|his|her|their|the A , so|and|hence|- please|- put|place|set|add|stand|leave|park|get|bring|give|buy|plant me|us|- a|another|one new|second|fresh|- one|replacement|- W", "put a A W"),
    // Slips that make other words.
    ("O pain|pint|point|print|faint|pants N K", "O paint N K"),
    ("O put|add|plant|place|build|install|park to|too H W", "O put two H W"),
    ("O put|add|plant|place|build|install|park ate H W", "O put eight H W"),
];

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::super::retold::told_by;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, |lexemes| *lexemes = told_by(lexemes, &[EVERYDAY]))
    }

    #[test]
    fn verbs_say_how_something_comes_to_stand_there() {
        for (said, meant) in [
            ("nail together a kennel beside the tree", "put a kennel beside the tree"),
            ("tie up a rowboat south of the hospital", "put a rowboat south of the hospital"),
            ("screw a sign in at the corner of the gallery", "put a sign at the corner of the gallery"),
            ("slide a stool in next to the table", "put a stool next to the table"),
            ("tie the dog up next to the oak", "move the dog next to the oak"),
            ("wheel the bin over behind the school", "move the bin behind the school"),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }

    #[test]
    fn people_are_sent_and_turn_and_change_places() {
        for (said, meant) in [
            (
                "send rex to sit beside ben and tell anna to look at the museum",
                "move rex beside ben and make anna face the museum",
            ),
            ("send a waiter to stand by the oak", "put a waiter by the oak"),
            ("walk her over so shes right beside the red bench", "move her beside the red bench"),
            (
                "ada goes beside the statue, and bo turns to face the fountain",
                "move ada beside the statue and make bo face the fountain",
            ),
            ("could the maple and the birch trade places", "swap the maple and the birch"),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }

    #[test]
    fn frames_are_told_plainly() {
        for (said, meant) in [
            ("it would look nicer were the blue car to be orange", "paint the blue car orange"),
            ("it would be nice were there a bench by the oak", "add a bench by the oak"),
            (
                "were the bin to stand behind the school, it would look nicer",
                "move the bin behind the school",
            ),
            ("make the chairs blue, all but the red one", "paint all the chairs except the red one blue"),
            ("tell my visitors something about the bookshop", "describe the bookshop"),
            ("make vanish for me the green scooter", "remove the green scooter"),
            ("my barrow got stolen, so put a new one near the lime", "put a barrow near the lime"),
            ("pain the green bench orange", "paint the green bench orange"),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }

    #[test]
    fn what_goes_or_only_tells_stays() {
        for said in [
            "knock the wall down next to the hospital",
            "pull the tree out next to the hospital",
            "tell my wife that i love her",
            "tell the kids a joke about bakers",
            "my bike got stolen",
            "it would look nicer",
        ] {
            assert_eq!(plain(said), said);
        }
    }
}
