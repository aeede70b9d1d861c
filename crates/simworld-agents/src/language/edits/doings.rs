//! Verbs that say along with what is to be done how it is done: to beach a boat, to unveil a bust and to release a dog is to put it
//! somewhere, to crush a car, to wheel it away or to have it hauled off is to remove it, to whitewash a house is to paint it white.
//!
//! They are turns of phrase in the notation of [`super::turns`], told before a sentence is read, for most of these words are near some other, as "beach"
//! is to "bench". None of them is taken for a verb but where one stands, before a new thing and a place or before a certain thing.

use super::super::lexer::Lexeme;
use super::everyday::EVERYDAY_FIRST;
use super::retold::{Turns, told_by};

/// Turns of phrase and what they mean, of one sentence each.
#[rustfmt::skip]
const DOINGS: &Turns = &[
    // New things, and where they stand.
    ("O beach|anchor|dock|tether|hitch|unveil|inaugurate|release|unleash|enthrone|settle|unroll|unfurl|unfold|lodge|deposit|seat|sit|embed|implant|ensconce down|out|- D A W", "O put D A W"),
    ("O let|set|turn loose|free D A W", "O put D A W"),
    ("O let|set|turn D A loose|free W", "O put D A W"),
    ("O release|unleash|unveil|inaugurate D A", "O add D A"),
    // What is there, and where it goes.
    ("O stuff|shoehorn|thrust|ram|jam|beach|anchor|dock|tether|hitch|settle|lodge|deposit|ensconce|enthrone N W", "O move N W"),
    ("O release|unleash N W", "O move N W"),
    // What is to be gone. Where a place is named to which something is carried it is not gone.
    ("O take|pull|knock|tear|chop|cut|saw N down|away ,|- except|excluding|excepting for|- V", "O remove N except V"),
    ("O take|pull|knock|tear|chop|cut|saw N down|away ,|- save|apart for|from V", "O remove N except V"),
    ("O crush|smash|wreck|shred|pulverise|pulverize|incinerate|torch|detonate|explode|flatten|exterminate|disintegrate|scuttle|mulch|pulp|compost|recycle|impound|confiscate|jettison|offload|abolish|liquidate|smite|squish N", "O remove N"),
    ("O break|smash|saw|hack|rip|tear up|apart N", "O remove N"),
    ("O take apart N", "O remove N"),
    ("O wheel|roll|push|drag|lug|drive|walk|lead|escort|sail|tow|ride|lift|hoist|march|usher|truck|shove|pull|chase|shepherd away the X", "O remove the X"),
    ("O wheel|roll|push|drag|lug|drive|walk|lead|escort|sail|tow|ride|lift|hoist|march|usher|truck|shove|pull|chase|shepherd away both X", "O remove both X"),
    ("O wheel|roll|push|drag|lug|drive|walk|lead|escort|sail|tow|ride|lift|hoist|march|usher|truck|shove|pull|chase|shepherd away that|this X", "O remove that X"),
    ("O wheel|drag|lug|lift|hoist|truck off the X", "O remove the X"),
    // Turns.
    ("O have|make|let|get A to|- do|perform|execute|make|complete a|an|one about|u turn|face", "O turn A around"),
    ("A should|must|shall|could|can|has|have|needs|is|ought to|- do|perform|execute|make a|an|one about|u turn|face", "turn A around"),
    ("a|an|one|- about|u turn|face , A", "turn A around"),
    ("a|an|one about|u turn|face for|by A", "turn A around"),
    // Copies.
    ("O do|make|give me|us|- one time more|again N ,|- W", "O copy N W"),
    ("O do|make|give me|us|- once more N ,|- W", "O copy N W"),
    // Colours.
    ("O whitewash N", "O paint N white"),
    ("O blacken N", "O paint N black"),
    // Sizes.
    ("F , N", "make N F"),
];

/// Each sentence by the first of these turns that it is.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    *lexemes = told_by(lexemes, &[DOINGS, EVERYDAY_FIRST]);
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, in_plain_words)
    }

    #[test]
    fn what_is_done_is_told_by_how_it_is_done() {
        assert_eq!(plain("beach a boat behind the diner"), "put a boat behind the diner");
        assert_eq!(plain("please unveil a bust"), "please add a bust");
        assert_eq!(plain("stuff the bus inside the hydrant"), "move the bus inside the hydrant");
        assert_eq!(plain("crush the red car near the stop"), "remove the red car near the stop");
        assert_eq!(plain("wheel away the scooter"), "remove the scooter");
        assert_eq!(
            plain("take the lamps down, except for the last one"),
            "remove the lamps except the last one"
        );
        assert_eq!(
            plain("turn Fay to the left, then have Gus do an about-turn"),
            "turn fay to the left , then turn gus around"
        );
        assert_eq!(plain("half as big, the hedge"), "make the hedge half as big");
    }

    #[test]
    fn where_something_goes_it_is_not_gone() {
        for said in [
            "wheel the scooter next to the crate",
            "wheel away the scooter behind the school",
            "the kids crush the flowers",
            "put a beach umbrella next to the table",
            "take up the bench and put it near the oak",
            "put the bench next to the tree once more",
        ] {
            assert_eq!(plain(said), said);
        }
    }
}
