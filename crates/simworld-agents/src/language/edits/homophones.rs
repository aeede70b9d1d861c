//! Words that are written like others that sound the same, beside a word by which it is plain which were meant: "a hay bail", "a flour pot",
//! "over hear". None of these is ever meant as it stands.

use super::super::lexer::Lexeme;
use super::super::lexicon::longest;
use super::forms::words_at;
use super::respelt::is_name;

/// What is written, and what was meant.
#[rustfmt::skip]
const HOMOPHONES: &[(&[&str], &str)] = &[
    (&["hay bail", "hey bale", "hey bail"], "hay bale"), (&["hay bails", "hey bales", "hey bails"], "hay bales"), (&["straw bail"], "straw bale"), (&["straw bails"], "straw bales"),
    (&["bail of hay", "bail of hey", "bale of hey"], "bale of hay"), (&["bails of hay", "bails of hey", "bales of hey"], "bales of hay"), (&["bail of straw"], "bale of straw"), (&["bails of straw"], "bales of straw"),
    (&["flour pot"], "flower pot"), (&["flour pots"], "flower pots"), (&["flour bed"], "flower bed"), (&["flour beds"], "flower beds"), (&["flour box"], "flower box"), (&["flour boxes"], "flower boxes"),
    (&["flour shop"], "flower shop"),
    (&["postbocks", "post bocks"], "postbox"), (&["mailbocks", "mail bocks", "male box", "male bocks"], "mailbox"), (&["letterbocks", "letter bocks"], "letterbox"), (&["fone box", "phone bocks", "fone bocks"], "phone box"),
    (&["fur tree"], "fir tree"), (&["fur trees"], "fir trees"), (&["pam tree"], "palm tree"), (&["rows bush"], "rose bush"), (&["rows bushes"], "rose bushes"), (&["rode sign"], "road sign"), (&["rode signs"], "road signs"),
    (&["streat lamp"], "street lamp"), (&["rowing bote"], "rowing boat"), (&["son dial", "sun dile"], "sundial"), (&["merry go rownd"], "merry go round"), (&["fire hidrant"], "fire hydrant"), (&["wheel barrel"], "wheelbarrow"),
    (&["wheely bin", "weely bin", "wheelie been"], "wheelie bin"),
    (&["over hear"], "over here"), (&["right hear"], "right here"), (&["their is"], "there is"), (&["their are"], "there are"), (&["their should be"], "there should be"),
    (&["buy the side of"], "by the side of"), (&["write next to", "rite next to"], "right next to"), (&["two the left", "too the left"], "to the left"), (&["two the right", "too the right", "to the write", "to the rite"], "to the right"),
    (&["next two the", "next too the"], "next to the"), (&["close two the", "close too the"], "close to the"), (&["in frunt of", "in front off", "infront off"], "in front of"), (&["on top off"], "on top of"),
    (&["knot far from"], "not far from"), (&["the hole street"], "the whole street"), (&["half the sighs", "half its sighs"], "half its size"), (&["twice the sighs", "twice its sighs"], "twice its size"),
];

/// Puts what was meant in its place. Names stay as they are.
pub(super) fn in_plain_spelling(words: &str, lexemes: &mut Vec<Lexeme>) {
    let mut at = 0;
    while at < lexemes.len() {
        if let Some((plain, count)) =
            longest(&lexemes[at..], HOMOPHONES).filter(|_| !is_name(words, lexemes, at))
        {
            let place = lexemes[at].clone();
            let told: Vec<Lexeme> = words_at(&place, plain).collect();
            lexemes.splice(at..at + count, told);
        }
        at += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::in_plain_spelling;

    fn plain(said: &str) -> String {
        rewritten(said, |lexemes| in_plain_spelling(said, lexemes))
    }

    #[test]
    fn what_sounds_the_same_is_what_stands_beside_it() {
        assert_eq!(plain("a flour pot by the statue"), "a flower pot by the statue");
        assert_eq!(plain("two hay bails over hear"), "two hay bales over here");
        assert_eq!(plain("next to the postbocks"), "next to the postbox");
    }

    #[test]
    fn what_may_be_meant_stays() {
        for said in
            ["a bag of flour", "bail the boat out", "move it to the right", "their bench", "we hear it"]
        {
            assert_eq!(plain(said), said);
        }
    }
}
