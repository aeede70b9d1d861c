//! What is said of the subject of a statement: a colour, a size, a place, that it is to go, what is to be done to it.

use super::super::clause::Reference;
use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{longest, longest_phrase};
use super::super::paint::{PAINTS, Paint};
use super::super::phrases::Phrases;
use super::forms::as_order;
use super::parse::{Reader, joint};
use super::says::{LACKS, Subject};
use super::sizes::factor_in_numbers;
use super::wish::{Anchor, NewThing, Where, Wish};
use super::words::{ABOUT_IT, FACTORS};

/// That something not yet there would be welcome; whatever stands around them is small.
#[rustfmt::skip]
const WELCOME: &Phrases = &Phrases::of(&["help", "helps", "helpful", "nice", "great", "good", "lovely", "handy", "useful", "perfect", "wonderful",
    "welcome", "appreciated", "overdue", "needed", "wanted", "missing", "required", "due", "idea", "lacking", "need", "want",
    "amazing", "fantastic", "beautiful", "awesome", "cute", "cool", "hurt", "amiss", "fine", "trick", "ticket", "thing", "order",
    "must", "do", "work", "fit", "suit", "requested", "desired", "called", "dream", "ideal", "sensible", "pretty", "neat", "sweet",
    "fun", "swell", "ace", "top", "terrific", "excellent", "superb", "magnificent", "charming", "grand", "super", "fab", "dandy", "brill", "wicked", "nicer", "smart",
    "pleasant", "cosy", "cozy", "sensational", "marvellous", "delightful", "dope", "sick", "rad", "practical", "demand", "liven", "brighten", "please", "delight", "improve", "better", "loved", "splendid", "brilliant"]);
/// What stands around them.
#[rustfmt::skip]
const AROUND: &Phrases = &Phrases::of(&["a", "an", "the", "very", "so", "really", "much", "be", "is", "are", "would", "wouldnt", "could", "not", "go", "goes",
    "what", "we", "i", "here", "there", "in", "long", "badly", "sorely", "us", "me", "everyone", "everybody", "things", "it", "right", "well",
    "might", "up", "place", "to", "have", "for", "also", "look", "looks", "make", "of", "totally", "just", "absolutely", "urgently",
    "quite", "some", "pretty", "should", "must", "too", "now", "most", "more", "that", "this", "thats", "whats", "lot", "bit", "people", "my",
    "day", "all", "greatly", "highly", "still", "certainly", "definitely", "surely", "will", "can", "come", "best", "actually",
    "desperately", "desirable", "sight", "spot", "been", "has", "was", "were", "kind", "day", "wouldn't", "scene", "city", "view", "feel", "add"]);
/// That it should not be there any more.
#[rustfmt::skip]
const GONE: &Phrases = &Phrases::of(&["gone", "removed", "deleted", "away", "taken away", "out", "out of here", "go away", "disappear", "vanish",
    "be gone", "byebye", "bye bye", "history", "out of the picture", "out of the scene", "off the map", "out of sight",
    "out of the way", "go byebye", "go bye bye", "leave", "leave the scene", "cease to exist", "not exist", "dead", "go for good",
    "gone for good", "not be there", "not be here", "out of my sight", "go", "taken out", "taken off", "thrown away", "thrown out",
    "scrapped", "gotten rid of", "got rid of", "done away with", "off", "vanished", "disappeared", "away from here", "go to the scrapyard",
    "no longer there", "no longer here", "come down", "come out", "come off", "down", "be taken down", "pulled down", "come away", "cut down", "chopped down", "felled", "no more", "disposed of", "torn down", "out of there"]);
/// That two should stand where the other does.
#[rustfmt::skip]
pub(super) const TRADES: &Phrases = &Phrases::of(&["have their places exchanged", "change their places", "switch their places", "switch their positions", "swap their positions", "swap their spots", "exchange their positions", "change their positions", "exchange spots", "change spots", "trade their places", "swap their places", "exchange their places", "change places", "swap places", "trade places", "switch places", "swap", "switch", "trade spots", "swap spots",
    "exchange places", "swap positions", "switch positions", "exchange positions", "be swapped", "be switched", "swapped", "trade positions",
    "change positions", "switch spots", "the other way round", "the other way around", "swapped around", "switched around", "change place", "swap place", "exchange place", "switch place", "trade place", "change seats", "swap seats", "switch seats", "exchange seats", "trade seats", "swap round", "switch round", "swapped round", "switched round"]);
/// Before a colour.
#[rustfmt::skip]
const IN_COLOUR: &Phrases = &Phrases::of(&["in", "into", "to", "a", "an", "the", "all", "as", "colour", "color", "bright", "light", "deep", "nice", "lovely",
    "shade", "of", "coloured", "colored", "painted", "paint", "proper", "with", "coat", "fresh", "new", "completely", "more", "plain", "totally",
    "dressed", "wearing"]);
/// Behind it.
const COLOUR: &Phrases = &Phrases::of(&[
    "coat of paint",
    "colour",
    "color",
    "paint",
    "one",
    "instead",
    "now",
    "please",
    "in colour",
    "in color",
    "too",
    "again",
    "coat",
    "all over",
    "paint job",
    "from now on",
]);
/// What something that is asked for does where it stands.
#[rustfmt::skip]
const PLACED: &Phrases = &Phrases::of(&["posted", "stationed", "hidden", "stored", "moored", "raised", "hoisted", "pitched", "laid out", "placed", "put", "parked", "planted", "installed", "built", "added", "set up", "wanted", "needed", "required", "missing",
    "located", "positioned", "standing", "sitting", "waiting", "set", "erected", "put up", "put down", "dropped", "lying", "situated",
    "hanging", "spawned", "created", "mounted", "stood", "squeezed in", "fitted", "inserted", "lined up", "overdue", "lacking", "requested",
    "popped", "stuck", "left", "due", "welcome", "in order", "here", "leaning", "resting", "growing", "perched", "tucked", "nestled", "moved in"]);

impl Reader<'_> {
    /// What is said of a subject: all the words from here to the end.
    pub(super) fn predicate(
        &self,
        subject: &Subject,
        (from, cut): (usize, usize),
        end: usize,
    ) -> Option<Vec<Vec<Wish>>> {
        let at = self.at;
        let _rest = self.rest(end);
        let one = |wish| Some(vec![vec![wish]]);
        match subject {
            Subject::There => self.all_added(at, end),
            Subject::Doing => {
                let (_, _, verb) = as_order(&self.lexemes[from..cut]).filter(|_| self.is_welcome(at, end))?;
                let order: Vec<Lexeme> =
                    std::iter::once(verb).chain(self.lexemes[from + 1..cut].iter().cloned()).collect();
                self.read_plainly(&order)
            }
            Subject::Place(places) => {
                #[rustfmt::skip]
                const MISSING: &Phrases = &Phrases::of(&["missing", "lacking", "needed", "wanted", "required", "missing still", "due"]);
                let missing = longest_phrase(self.rest(end), MISSING).unwrap_or(0);
                let at = at + missing;
                if self.is_definite(at) && !self.is_bare_plural(at, end) {
                    return None;
                }
                self.all_added(at, end)?
                    .into_iter()
                    .map(|readings| readings.into_iter().map(|wish| placed(wish, places)).collect())
                    .collect()
            }
            Subject::New(thing, places) => self.of_new(thing, places, cut, end).and_then(one),
            Subject::Things(what) => self.of_things(what, (from, cut), end),
        }
    }

    /// What is said of something that is not there yet: that it would be welcome, or where it is to stand.
    fn of_new(&self, thing: &NewThing, places: &[Where], cut: usize, end: usize) -> Option<Wish> {
        #[rustfmt::skip]
        const WITH: &Phrases = &Phrases::of(&["well with", "with", "nicely with", "together with", "good with", "great with", "suit", "match"]);
        let (at, rest) = (self.at, self.rest(end));
        // "Near the cottage that is east of the school" says which cottage.
        if !places.is_empty() && matches!(self.word(cut), Some("that" | "which" | "who")) {
            return None;
        }
        let add = |at| Wish::Add { things: vec![thing.clone()], at };
        if self.is_welcome(at, end) && (at > cut || !rest.is_empty()) {
            return Some(add(places.to_vec()));
        }
        // "A bin would not go amiss next to the museum".
        if places.is_empty()
            && let Some(cut) = (at + 1..end).find(|at| self.is_place(*at))
            && self.is_welcome(at, cut)
            && let Some(places) = self.places_to(cut, end)
        {
            return Some(add(places));
        }
        // "Seats along the school would let people rest".
        let is_would = matches!(self.word(cut), Some("would" | "could" | "will" | "might" | "certainly"));
        let asks_more = (at..end).any(|at| {
            self.is_place(at)
                || longest(&self.lexemes[at..end], PAINTS).is_some()
                || longest(&self.lexemes[at..end], &FACTORS).is_some()
        });
        if is_would && !places.is_empty() && !rest.is_empty() && !asks_more {
            return Some(add(places.to_vec()));
        }
        if let Some(words) = longest_phrase(rest, WITH).filter(|_| at > cut && places.is_empty())
            && let Ok(anchor) = self.one_of(at + words, end)
        {
            return Some(add(vec![Where::By(Anchor::Thing(anchor))]));
        }
        let stood = longest_phrase(rest, PLACED).unwrap_or(0);
        let more = self.places_to(at + stood, end)?;
        Some(add(places.iter().cloned().chain(more).collect()))
    }

    /// What is said of things that are there.
    fn of_things(
        &self,
        what: &[Reference],
        (from, cut): (usize, usize),
        end: usize,
    ) -> Option<Vec<Vec<Wish>>> {
        let (at, rest) = (self.at, self.rest(end));
        let whole = |phrases: &Phrases| !rest.is_empty() && longest_phrase(rest, phrases) == Some(rest.len());
        let own = || what.to_vec();
        // "Ada wants to sit down" asks for no end of her.
        let poses = (cut..at).any(|at| {
            matches!(
                self.word(at),
                Some(
                    "sit"
                        | "sits"
                        | "sitting"
                        | "lie"
                        | "stand"
                        | "stands"
                        | "walk"
                        | "rest"
                        | "look"
                        | "looks"
                        | "hang"
                        | "work"
                )
            )
        });
        let wish = if whole(GONE) && !poses {
            Some(Wish::Remove { what: own() })
        } else if whole(TRADES) {
            self.pair_up(from, cut).ok()
        } else if let Some(paint) = self.colour_to(at, end) {
            Some(Wish::Paint { what: own(), paint })
        } else if let Some((paints, _)) =
            self.colours(at, end).filter(|(_, after)| *after == end && super::painted::are_several(what))
        {
            Some(Wish::PaintEach { what: own(), paints })
        } else if let Some(factor) = size_of(rest) {
            Some(Wish::Scale { what: own(), factor })
        } else if let Some(size) = self.measure(at, end) {
            Some(Wish::Resize { what: own(), size })
        } else if let Some(wish) = self.faces(what, at, end) {
            Some(wish)
        } else if let Some(angle) = self.turned_by(at, end) {
            Some(Wish::Rotate { what: own(), angle })
        } else {
            let places = self.places_to(at, end).filter(|_| !self.is_bare_plural(from, cut));
            places.map(|at| Wish::Move { what: own(), at })
        };
        let one = |wish| vec![vec![wish]];
        wish.map(one)
            .or_else(|| self.face_each_other(what, at, end))
            .or_else(|| self.side_by_side(what, at, end).map(one))
            .or_else(|| self.done_to((from, cut), at, end))
            .or_else(|| self.lacks((from, cut), end).map(one))
    }

    /// "The other way", "90 degrees to the left": an angle that is told as one.
    fn turned_by(&self, at: usize, end: usize) -> Option<f64> {
        #[rustfmt::skip]
        const TURNS: &[&str] = &["way", "around", "round", "degrees", "degree", "turn", "backwards", "clockwise", "counterclockwise"];
        let is_turn = (at..end).any(|at| self.word(at).is_some_and(|word| TURNS.contains(&word)));
        super::turn::angle(self.rest(end)).filter(|_| is_turn)
    }

    /// New things, which take all the words.
    pub(super) fn all_added(&self, at: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        if at >= end {
            return None;
        }
        let mut reader = Reader { at, ..self.up_to(end) };
        reader.additions(end).ok().filter(|_| reader.at >= end)
    }

    /// Places, which take all the words.
    pub(super) fn places_to(&self, at: usize, end: usize) -> Option<Vec<Where>> {
        let mut reader = Reader { at, ..self.up_to(end) };
        if at >= end || !reader.is_place(at) {
            return None;
        }
        reader.places(end).ok().filter(|_| reader.at >= end)
    }

    /// A colour and nothing else but small words.
    pub(super) fn colour_to(&self, at: usize, end: usize) -> Option<Paint> {
        let small = |from: usize, words: &Phrases| {
            (from..end).take_while(|at| self.word(*at).is_some_and(|word| words.contains(word))).count()
        };
        let before = at + small(at, IN_COLOUR);
        let (paint, words) = longest(&self.lexemes[before..end], PAINTS)?;
        let mut after = before + words;
        // "To the white one" names a thing.
        let is_one = (at..before).any(|at| self.word(at) == Some("the"))
            && self.word(after) == Some("one")
            && after < end;
        while after < end {
            after += longest_phrase(&self.lexemes[after..end], COLOUR)?;
        }
        (!is_one).then_some(paint)
    }

    /// "A fresh coat of pink", "some yellow paint": paint is spoken of.
    pub(super) fn paint_to(&self, at: usize, end: usize) -> Option<Paint> {
        const COAT: &[&str] =
            &["coat", "coats", "lick", "layer", "paint", "colour", "color", "job", "repaint"];
        let spoken = (at..end).any(|at| self.word(at).is_some_and(|word| COAT.contains(&word)));
        let small = (at..end).take_while(|at| longest(&self.lexemes[*at..end], PAINTS).is_none()).count();
        let (paint, words) =
            longest(&self.lexemes[(at + small).min(end)..end], PAINTS).filter(|_| spoken && small <= 6)?;
        let after = at + small + words;
        (after == end || longest_phrase(&self.lexemes[after..end], COLOUR) == Some(end - after))
            .then_some(paint)
    }

    /// Whether the words say that something would be welcome.
    pub(super) fn is_welcome(&self, at: usize, end: usize) -> bool {
        let words: Option<Vec<&str>> = (at..end).map(|at| self.word(at)).collect();
        words.is_some_and(|words| {
            words.iter().all(|word| WELCOME.contains(word) || AROUND.contains(word))
                && words.iter().any(|word| WELCOME.contains(word))
        })
    }

    /// "The car should face the museum".
    fn faces(&self, what: &[Reference], at: usize, end: usize) -> Option<Wish> {
        #[rustfmt::skip]
        const FACES: &Phrases = &Phrases::of(&["face", "faces", "looks at", "looks towards", "points at", "facing", "look at", "looking at", "look towards", "looking towards", "point at", "pointing at",
            "turned towards", "turned to", "turned to face", "to face", "look to", "watch", "watching", "point to", "point towards",
            "towards", "rotated towards", "aimed at", "stare at", "gaze at"]);
        let words = longest_phrase(self.rest(end), FACES)?;
        let mut reader = Reader { at: at + words, ..self.up_to(end) };
        reader.towards(what.to_vec(), end).ok()
    }

    /// "Ada and Bo should face each other".
    pub(super) fn face_each_other(
        &self,
        what: &[Reference],
        at: usize,
        end: usize,
    ) -> Option<Vec<Vec<Wish>>> {
        const EACH: &Phrases = &Phrases::of(&[
            "face each other",
            "face one another",
            "look at each other",
            "look at one another",
            "gaze at each other",
            "gaze at one another",
            "be facing each other",
            "facing each other",
            "facing one another",
            "turned towards each other",
            "turned to each other",
            "watch each other",
        ]);
        let [one, other] = what else { return None };
        let whole = longest_phrase(&self.lexemes[at..end], EACH) == Some(end - at);
        let face = |one: &Reference, other: &Reference| {
            vec![Wish::Face { what: vec![one.clone()], towards: other.clone() }]
        };
        whole.then(|| vec![face(one, other), face(other, one)])
    }

    /// "Carol and Dmitri should stand together".
    fn side_by_side(&self, what: &[Reference], at: usize, end: usize) -> Option<Wish> {
        const TOGETHER: &[&str] =
            &["next to each other", "side by side", "beside each other", "together", "next to one another"];
        let [one, other] = what else { return None };
        let whole = longest_phrase(&self.lexemes[at..end], TOGETHER) == Some(end - at);
        let beside = Where::To(simworld_core::scene::Relation::NextTo, Anchor::Thing(other.clone()));
        whole.then(|| Wish::Move { what: vec![one.clone()], at: vec![beside] })
    }

    /// "The bench should be moved behind the museum": the order that does so to the subject.
    fn done_to(&self, (from, cut): (usize, usize), at: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let (_, words, verb) = as_order(self.rest(end))?;
        let mut order = vec![verb];
        order.extend_from_slice(&self.lexemes[at + 1..at + words]);
        order.extend_from_slice(&self.lexemes[from..cut]);
        order.extend_from_slice(&self.lexemes[at + words..end]);
        self.read_plainly(&order)
    }

    /// "The museum would benefit from a bench out front"; the reader stands behind the small words.
    pub(super) fn lacks(&self, (from, cut): (usize, usize), end: usize) -> Option<Wish> {
        let words = longest_phrase(&self.lexemes[cut..end], LACKS)?;
        let me = super::super::clause::Target::Here;
        let thing = self.one_of(from, cut).ok().filter(|thing| thing.target != me)?;
        // "The kids at the school would love a goal": it is for the school.
        let thing = super::spoken::group_at(&thing).unwrap_or(thing);
        if let Some(paint) = self.paint_to(cut + words, end) {
            return Some(Wish::Paint { what: vec![thing], paint });
        }
        let anchor = Anchor::Thing(thing);
        let reader = self.up_to(end);
        reader.given_to(&anchor, cut + words, end).or_else(|| reader.brought_to(&anchor, cut + words, end))
    }

    /// "Carol wants to have the dog beside her": what is there, at an anchor.
    fn brought_to(&self, anchor: &Anchor, at: usize, end: usize) -> Option<Wish> {
        if !self.is_certain(at) {
            return None;
        }
        (at + 1..end).filter(|cut| self.is_place(*cut)).find_map(|cut| {
            let what = self.things(at, cut).ok()?;
            let mut places = self.places_to(cut, end)?;
            let is_hers = places.iter().any(|place| place.anchor().is_some_and(|anchor| anchor.is_it()));
            for place in &mut places {
                place.means(&mut Some(anchor.clone()));
            }
            is_hers.then_some(Wish::Move { what, at: places })
        })
    }

    /// A new thing at an anchor: all the words from here.
    pub(super) fn given_to(&self, anchor: &Anchor, at: usize, end: usize) -> Option<Wish> {
        if self.is_definite(at) && !self.is_bare_plural(at, end) {
            return None;
        }
        let mut reader = Reader { at, ..*self };
        let thing = reader.new_thing(end).ok()?;
        if reader.at >= end {
            let place = match anchor {
                Anchor::Street(..) => Where::Along(anchor.clone()),
                _ => Where::By(anchor.clone()),
            };
            return Some(Wish::Add { things: vec![thing], at: vec![place] });
        }
        if let Some((relation, words)) = longest(reader.rest(end), &ABOUT_IT)
            && reader.at + words >= end
        {
            return Some(Wish::Add { things: vec![thing], at: vec![Where::To(relation, anchor.clone())] });
        }
        let mut at = reader.places_to(reader.at, end)?;
        for place in &mut at {
            if let Some(own) = place.anchor_mut().filter(|own| own.is_the_building()) {
                *own = anchor.clone();
            }
            place.means(&mut Some(anchor.clone()));
        }
        Some(Wish::Add { things: vec![thing], at })
    }
}

/// An addition at a place, if it has none of its own.
fn placed(wish: Wish, places: &[Where]) -> Option<Wish> {
    match wish {
        Wish::Add { things, at } if at.is_empty() => Some(Wish::Add { things, at: places.to_vec() }),
        _ => None,
    }
}

/// A size, if all the words are one: "twice as big", "a lot larger, by 50 percent".
pub(super) fn size_of(lexemes: &[Lexeme]) -> Option<f64> {
    const SMALL: &[&str] = &[
        "to", "be", "become", "get", "somewhat", "even", "only", "quite", "just", "made", "scaled", "about",
        "roughly", "of", "its", "size",
    ];
    let words: Vec<Lexeme> = lexemes
        .iter()
        .skip_while(|lexeme| matches!(&lexeme.token, Token::Word(word) if SMALL.contains(&word.as_str())))
        .cloned()
        .collect();
    let whole = |words: &[Lexeme]| {
        let named = longest(words, &FACTORS).or_else(|| factor_in_numbers(words));
        // "Three" alone is no size.
        let is_number = words.len() == 1 && longest(words, &FACTORS).is_none();
        let by_share = || super::ratios::factor(words);
        named
            .filter(|(_, count)| *count == words.len() && !is_number)
            .map(|(factor, _)| factor)
            .or_else(by_share)
    };
    if words.is_empty() {
        return None;
    }
    whole(&words).or_else(|| whole(lexemes)).or_else(|| {
        // "Smaller, half of what it is": the figure counts.
        let cut = (1..words.len()).find(|at| joint(&words[*at..]).is_some())?;
        whole(&words[..cut])?;
        whole(&words[cut + joint(&words[cut..])?..])
    })
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let lists = [WELCOME, AROUND, GONE, TRADES, IN_COLOUR, COLOUR, PLACED];
    lists.into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}
