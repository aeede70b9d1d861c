//! The words of the grammar: what things are called, what one can be told to do, and the words around them.

use std::borrow::Cow;
use std::sync::LazyLock;

use simworld_core::scene::{EntityKind, EntityRef, Place, Relation};
use simworld_core::seam::Which;
use simworld_core::value::Value;

use super::clause::{Measure, Side};
use super::lexer::{Lexeme, Token};
use super::phrases::{Index, PhraseList, Phrases};

/// The attribute of a piece of ground that says what it is used as: `park`, `square`, `river` and the like.
pub(super) const AREA: &str = "area";

/// A class of things that people have words for.
#[derive(Debug, PartialEq)]
pub(super) struct Category {
    /// What it is called; the first is used in answers. Several words are separated by one blank.
    pub(super) words: &'static [&'static str],
    kinds: &'static [EntityKind],
    place: Option<Place>,
    /// The use of the ground, if it is an area: the value of its attribute [`AREA`].
    area: Option<&'static str>,
}

impl Category {
    /// Anything to sit on: the first class.
    pub(super) fn seat() -> &'static Self {
        &CATEGORIES[0]
    }

    /// Whether it is named after what it is used for.
    pub(super) const fn is_place(&self) -> bool {
        self.place.is_some()
    }

    /// Whether it is a piece of ground, on which things stand.
    pub(super) const fn is_area(&self) -> bool {
        self.area.is_some()
    }

    /// What its things are used as, if they are places.
    pub(super) const fn place(&self) -> Option<Place> {
        self.place
    }

    /// What its things are.
    pub(super) const fn kinds(&self) -> &'static [EntityKind] {
        self.kinds
    }

    /// The class as data.
    pub(super) fn to_which(&self) -> Which {
        let ground = self.area.map(|_| EntityKind::Ground);
        Which::Any { kinds: self.kinds.iter().copied().chain(ground).collect(), place: self.place }
    }

    /// Whether an entity is of this class.
    pub(super) fn holds(&self, entity: &EntityRef<'_>) -> bool {
        let is_area = |area: &str| {
            let used = entity.info.attributes.get(AREA);
            entity.kind == EntityKind::Ground && matches!(used, Some(Value::Text(used)) if used == area)
        };
        self.kinds.contains(&entity.kind)
            || self.place.is_some_and(|place| entity.info.place == Some(place))
            || self.area.is_some_and(is_area)
    }
}

const fn things(words: &'static [&'static str], kinds: &'static [EntityKind]) -> Category {
    Category { words, kinds, place: None, area: None }
}

const fn places(words: &'static [&'static str], place: Place) -> Category {
    Category { words, kinds: &[], place: Some(place), area: None }
}

const fn areas(words: &'static [&'static str], area: &'static str) -> Category {
    Category { words, kinds: &[], place: None, area: Some(area) }
}

/// The class with that word; it is one of the table's own words.
pub(super) fn class(word: &str) -> &'static Category {
    let has = |category: &&Category| category.words.contains(&word);
    CATEGORIES.iter().find(has).unwrap_or(Category::seat())
}

/// Whether it is spoken of as him, her or them.
pub(super) const fn is_animate(kind: EntityKind) -> bool {
    matches!(kind, EntityKind::Person | EntityKind::Dog | EntityKind::Robot)
}

/// Every class. Plurals follow from the singular.
#[rustfmt::skip]
pub(super) static CATEGORIES: &[Category] = &[
    things(&["seat", "thing you can sit on", "thing to sit on", "something to sit on", "place to sit",
        "place to sit down", "spot to sit", "somewhere to sit", "place to rest", "place where i can sit", "place where you can sit", "place where we can sit", "somewhere i can sit"], &[EntityKind::Chair,
        EntityKind::Bench]),
    things(&["chair", "armchair", "stool", "deck chair", "bar stool", "barstool", "garden chair", "folding chair", "camping chair", "lawn chair", "rocking chair", "easy chair"], &[EntityKind::Chair]),
    things(&["bench", "park bench", "public bench", "garden bench", "street bench"], &[EntityKind::Bench]),
    things(&["table", "desk", "picnic table", "dining table", "coffee table", "side table", "garden table"], &[EntityKind::Table]),
    things(&["parcel", "package", "packet", "box", "order", "delivery", "carton", "cardboard box", "shipment", "consignment", "postal parcel"], &[EntityKind::Parcel]),
    things(&["tree"], &[EntityKind::Tree]),
    things(&["shrub", "bush", "hedge", "flower bed", "flowerbed", "hedgerow", "shrubbery"], &[EntityKind::Shrub]),
    things(&["street lamp", "street light", "streetlight", "lamp post", "lamppost", "lamp", "lantern", "streetlamp",
        "light pole", "lamp standard", "lamp pole", "light post", "lightpost", "street lantern", "lampost"], &[EntityKind::StreetLamp]),
    things(&["traffic light", "traffic signal", "stoplight", "stop light", "pedestrian light", "set of lights", "set of traffic lights", "light", "lights", "signal"],
        &[EntityKind::TrafficSignal]),
    things(&["sign", "street sign", "traffic sign", "road sign", "signpost", "sign post", "stop sign", "signboard"], &[EntityKind::Sign]),
    things(&["trash bin", "bin", "trash can", "garbage can", "litter bin", "dustbin", "waste bin", "rubbish bin",
        "trashcan", "garbage bin", "wastebasket", "waste basket", "litter basket", "rubbish can", "wheelie bin",
        "garbage", "trash", "wastepaper basket", "recycling bin", "waste container", "refuse bin", "wastebin", "rubbish"], &[EntityKind::TrashBin]),
    things(&["mailbox", "letterbox", "letter box", "postbox", "post box", "mail box", "pillar box", "letter slot", "mail slot", "mail drop"],
        &[EntityKind::Mailbox]),
    things(&["hydrant", "fire hydrant", "fireplug", "water hydrant"], &[EntityKind::Hydrant]),
    things(&["cone", "traffic cone", "safety cone", "road cone", "pylon"], &[EntityKind::Cone]),
    things(&["bus stop", "bus shelter", "bus station", "bus halt", "coach stop", "busstop"], &[EntityKind::BusStop]),
    things(&["prop", "object"], &[EntityKind::Prop]),
    things(&["vehicle"], &[EntityKind::Car, EntityKind::Truck, EntityKind::Bus, EntityKind::Motorcycle,
        EntityKind::Bicycle, EntityKind::Scooter]),
    things(&["car", "automobile", "taxi", "cab", "motorcar", "motor car", "taxicab", "sedan", "hatchback", "suv", "jeep", "convertible", "sports car"], &[EntityKind::Car]),
    things(&["truck", "lorry", "van", "pickup truck", "delivery van", "delivery truck", "box van", "fire truck", "fire engine"], &[EntityKind::Truck]),
    things(&["bus", "omnibus", "minibus", "double decker", "tour bus", "school bus"], &[EntityKind::Bus]),
    things(&["motorcycle", "motorbike", "moped", "motor bike", "motor cycle"], &[EntityKind::Motorcycle]),
    things(&["bicycle", "bike", "pushbike", "push bike", "mountain bike", "city bike", "road bike", "e bike", "ebike"], &[EntityKind::Bicycle]),
    things(&["scooter", "kick scooter", "e scooter", "electric scooter", "escooter", "push scooter", "kickscooter"], &[EntityKind::Scooter]),
    things(&["person", "people", "human", "pedestrian", "man", "men", "woman", "women", "passer by", "passerby",
        "somebody", "someone", "anybody", "anyone", "everybody", "everyone", "whoever", "fellow", "bloke", "chap",
        "gentlemen", "ladies", "passers by", "individual", "folk", "folks", "citizen", "guy", "lady", "boy", "girl",
        "child", "kid", "gentleman", "stranger", "bystander", "human being", "youngster", "gal", "lass", "adult", "old man", "old woman", "young man", "young woman", "old lady", "little girl", "little boy"], &[EntityKind::Person]),
    things(&["dog", "robot dog", "hound", "puppy", "pup", "pooch", "mutt", "doggie", "doggy", "doggo", "canine", "pet dog", "bow wow"], &[EntityKind::Dog]),
    things(&["robot", "droid", "android", "bot", "automaton", "delivery robot"], &[EntityKind::Robot]),
    things(&["building", "tower block", "skyscraper", "high rise", "highrise", "edifice"], &[EntityKind::Building]),
    things(&["door", "doorway", "gate", "entrance", "front door", "entryway", "gateway"], &[EntityKind::Door]),
    things(&["road", "street"], &[EntityKind::Road]),
    things(&["sidewalk", "pavement", "walkway"], &[EntityKind::Sidewalk]),
    things(&["crosswalk", "crossing", "zebra crossing", "zebra", "pedestrian crossing", "crossing point", "zebra stripes"], &[EntityKind::Crosswalk]),
    places(&["home", "house", "apartment", "flat", "residence", "cottage", "dorm", "dormitory", "villa", "townhouse", "apartment building", "apartment block", "block of flats", "bungalow", "farmhouse", "dwelling", "student home"], Place::Home),
    places(&["restaurant", "diner", "café", "cafe", "bistro", "eatery", "canteen", "cafeteria", "place to eat", "somewhere to eat", "someplace to eat", "place where i can eat", "place where you can eat", "place where we can eat", "somewhere i can eat", "somewhere we can eat", "place that serves food", "place to have lunch", "place to have dinner", "pub", "tavern", "pizzeria", "snack bar", "tea room", "tearoom", "coffeehouse", "coffee house", "brasserie", "trattoria", "dining hall"], Place::Restaurant),
    places(&["store", "shop", "supermarket", "grocery", "grocery store", "market", "convenience store", "corner store", "general store", "department store", "minimarket", "mini market"], Place::Store),
    places(&["hospital", "clinic", "infirmary", "medical centre", "medical center", "health centre", "health center"], Place::Hospital),
    places(&["museum", "gallery", "art gallery", "art museum"], Place::Museum),
    places(&["school", "academy", "college", "university", "primary school", "high school", "elementary school", "kindergarten", "schoolhouse"], Place::School),
    places(&["office", "office building", "workplace", "office block", "office tower", "headquarters"], Place::Office),
    places(&["factory", "warehouse"], Place::Factory),
    places(&["charging station", "charging point", "place to charge", "somewhere to charge", "charger", "charge point", "ev charger", "charging post", "recharging station"], Place::ChargingStation),
    areas(&["park", "gardens", "public garden", "green"], "park"),
    areas(&["square", "plaza", "piazza", "market square", "market place", "marketplace"], "square"),
    areas(&["river", "river side", "riverside", "river bank", "riverbank", "canal", "stream"], "river"),
    areas(&["lake", "pond"], "lake"),
    areas(&["harbour basin", "dock", "quay"], "harbour"),
    areas(&["forest", "wood", "woods"], "forest"),
    areas(&["meadow", "lawn", "grass"], "meadow"),
    places(&["rest area", "rest stop", "resting place", "pavilion", "rest place", "picnic area", "gazebo", "rest house"], Place::RestArea),
];

/// Whatever stands about and can be moved, but for people and animals: "everything".
pub(super) static ALL_THINGS: Category = things(
    &["thing"],
    &[
        EntityKind::Chair,
        EntityKind::Bench,
        EntityKind::Table,
        EntityKind::Parcel,
        EntityKind::Tree,
        EntityKind::Shrub,
        EntityKind::StreetLamp,
        EntityKind::TrafficSignal,
        EntityKind::Sign,
        EntityKind::TrashBin,
        EntityKind::Mailbox,
        EntityKind::Hydrant,
        EntityKind::Cone,
        EntityKind::BusStop,
        EntityKind::Prop,
        EntityKind::Car,
        EntityKind::Truck,
        EntityKind::Bus,
        EntityKind::Motorcycle,
        EntityKind::Bicycle,
        EntityKind::Scooter,
    ],
);
/// "The furniture".
pub(super) static FURNITURE: Category =
    things(&["piece of furniture"], &[EntityKind::Chair, EntityKind::Bench, EntityKind::Table]);
/// "The plants".
pub(super) static PLANTS: Category = things(&["plant"], &[EntityKind::Tree, EntityKind::Shrub]);

/// Words before a noun that say nothing about which.
#[rustfmt::skip]
pub(super) const DETERMINERS: &Phrases = &Phrases::of(&[
    "the", "a", "an", "that", "this", "these", "those", "some", "any", "my", "your", "our", "one of the",
    "one of", "one", "whichever", "whatever", "whichever of the", "his", "her", "its", "their", "any old",
    "some of the", "just any",
]);

/// Words that say which of several.
pub(super) const NEAREST: &Phrases = &Phrases::of(&[
    "nearest",
    "closest",
    "nearby",
    "near by",
    "nearer",
    "closer",
    "most near",
    "nearest by",
    "closest by",
    "handiest",
    "very nearest",
    "very closest",
]);
/// The contrary.
pub(super) const FARTHEST: &Phrases = &Phrases::of(&[
    "farthest",
    "furthest",
    "most distant",
    "last",
    "final",
    "farther",
    "further",
    "remotest",
    "furthermost",
    "farthermost",
    "most remote",
]);
/// Words that compare.
#[rustfmt::skip]
pub(super) const MOSTS: &[(&[&str], (Measure, bool))] = &[
    (&["tallest", "highest", "taller", "higher", "tall"], (Measure::Height, true)),
    (&["shortest", "lowest", "shorter", "lower"], (Measure::Height, false)),
    (&["biggest", "largest", "big", "large", "bigger", "larger", "hugest", "huge", "greatest",
    "biggest and tallest"], (Measure::Volume, true)),
    (&["smallest", "tiniest", "small", "little", "tiny", "smaller"], (Measure::Volume, false)),
    (&["heaviest", "heavier", "weightiest"], (Measure::Mass, true)),
    (&["lightest", "lighter"], (Measure::Mass, false)),
];
/// Sides of the agent.
#[rustfmt::skip]
pub(super) const SIDES: &[(&[&str], Side)] = &[
    (&["on the left", "on your left", "to the left", "to your left", "on the left side", "on your left side",
    "on the left hand side", "on your left hand side", "at the left", "to the left of you",
    "on the left of you", "over on the left", "off to the left", "off to your left", "over to the left",
    "over to your left", "over on your left", "to the left hand side", "on your left hand", "at your left",
    "on the left there", "down on the left", "on our left", "to our left", "on my left", "to my left", "left of you",
    "left of us", "to port", "to port of you", "on the port side", "on the left hand", "from the left", "at our left",
    "to the left of us", "on the left of us", "over to our left"], Side::Left),
    (&["on the right", "on your right", "to the right", "to your right", "on the right side",
    "on your right side", "on the right hand side", "on your right hand side", "at the right",
    "to the right of you", "on the right of you", "over on the right", "off to the right", "off to your right",
    "over to the right", "over to your right", "over on your right", "to the right hand side",
    "on your right hand", "at your right", "on the right there", "down on the right", "on our right", "to our right",
    "on my right", "to my right", "right of you", "right of us", "on the right hand", "from the right", "at our right",
    "to the right of us", "on the right of us", "over to our right"], Side::Right),
    (&["ahead", "ahead of you", "in front of you", "straight ahead", "in front", "up ahead", "up ahead of you",
    "right in front of you", "facing you", "right ahead", "dead ahead", "directly in front of you",
    "directly ahead", "in front of us", "ahead of us", "in front of me", "just ahead",
    "just in front of you", "just in front of us", "right in front of us", "straight in front of you", "further ahead",
    "in front there"], Side::Ahead),
    (&["behind you", "at your back", "in back of you", "right behind you", "to the rear", "behind your back",
    "directly behind you", "just behind you", "back of you", "behind us", "behind me", "at our backs", "at the rear",
    "right behind us", "just behind us", "behind your back there", "from behind you", "from behind us"], Side::Behind),
];

/// How two things may stand to each other; the longest phrase that fits is taken.
#[rustfmt::skip]
pub(super) const RELATIONS: &[(&[&str], Relation)] = &[
    (&["next to", "beside", "by", "right next to", "right by", "just by", "adjacent to", "at the side of",
    "alongside", "under", "underneath", "beneath", "right beside", "just beside", "just next to",
    "directly next to", "close beside", "up against", "against", "in the shade of", "in the shadow of",
    "at the foot of", "right under", "adjoining", "at the edge of"], Relation::NextTo),
    (&["near", "near to", "close to", "not far from", "in the vicinity of", "close by",
    "in the neighbourhood of", "within reach of", "across the road from", "across the street from",
    "over the road from", "over the street from", "on the other side of the road from",
    "on the other side of the street from"], Relation::Near),
    (&["in front of", "outside", "outside of", "opposite", "opposite to", "across from", "right in front of",
    "directly in front of", "just outside", "right outside", "facing", "just in front of", "over from",
    "across the way from"], Relation::InFrontOf),
    (&["behind", "at the back of", "in back of", "right behind", "directly behind", "just behind",
    "at the rear of", "round the back of", "around the back of", "around behind", "round behind", "to the rear of"], Relation::Behind),
    (&["left of", "to the left of", "on the left of"], Relation::LeftOf),
    (&["right of", "to the right of", "on the right of"], Relation::RightOf),
    (&["on top of"], Relation::OnTopOf),
    (&["inside", "inside of"], Relation::Inside),
];

/// Words between a noun and how it stands to another.
#[rustfmt::skip]
pub(super) const COPULAS: &Phrases = &Phrases::of(&[
    "that is", "thats", "which is", "that grows", "which grows", "growing", "that stands", "which stands", "standing", "located", "placed", "who is",
    "whos", "who stands", "sitting", "is", "parked", "that are", "which are", "right", "thats standing",
    "that sits", "which sits", "over", "just", "lying", "thats lying", "that lies", "which lies", "waiting",
    "that waits", "who is standing", "who is sitting", "who waits", "is standing", "is sitting", "is lying",
    "is parked", "is waiting", "are standing", "are", "thats parked", "that is parked", "which is parked",
    "leaning", "leaning against", "situated", "found", "positioned", "to be found", "hanging", "who are",
    "who stand", "that stand", "left lying", "thats waiting", "thats sitting", "whos standing", "whos sitting",
    "whos waiting", "seated", "resting", "stands", "sits", "lies", "located", "that happens to be", "that was",
]);

/// How many tokens at the start of `lexemes` are the words of the phrase; `None` if they are others.
pub(super) fn fits(lexemes: &[Lexeme], phrase: &str) -> Option<usize> {
    let mut rest = phrase.as_bytes();
    for (index, lexeme) in lexemes.iter().enumerate() {
        let Token::Word(said) = &lexeme.token else { return None };
        match rest.strip_prefix(said.as_bytes())? {
            [] => return Some(index + 1),
            [b' ', more @ ..] => rest = more,
            _ => return None,
        }
    }
    None
}

/// As [`fits`], with the last word in the singular or the plural.
pub(super) fn fits_noun(lexemes: &[Lexeme], phrase: &str) -> Option<usize> {
    let (head, last) = phrase.rsplit_once(' ').map_or((None, phrase), |(head, last)| (Some(head), last));
    let before = head.map_or(Some(0), |head| fits(lexemes, head))?;
    match lexemes.get(before).map(|lexeme| &lexeme.token) {
        Some(Token::Word(said)) if said == last || is_plural(said, last) => Some(before + 1),
        _ => None,
    }
}

pub(super) fn is_plural(said: &str, noun: &str) -> bool {
    if let Some(ending) = said.strip_prefix(noun) {
        return matches!(ending, "s" | "es");
    }
    let of = |ending: &str, plural: &str| {
        noun.strip_suffix(ending).is_some_and(|stem| said.strip_prefix(stem) == Some(plural))
    };
    of("y", "ies") || of("f", "ves") || of("fe", "ves")
}

/// Phrases with what they stand for, as a table or filed.
pub(super) trait PhraseTable<T> {
    /// The entry whose phrase is the longest at the start of `lexemes`, with the number of its words.
    fn longest_at(&self, lexemes: &[Lexeme]) -> Option<(T, usize)>;
}

impl<T: Copy> PhraseTable<T> for [(&[&str], T)] {
    fn longest_at(&self, lexemes: &[Lexeme]) -> Option<(T, usize)> {
        let first = initial(lexemes)?;
        let hits = self.iter().flat_map(|(phrases, entry)| {
            let begin = phrases.iter().filter(|phrase| begins(phrase, first));
            begin.filter_map(|phrase| fits(lexemes, phrase).map(|count| (*entry, count)))
        });
        longer(hits)
    }
}

impl<T: Copy, const N: usize> PhraseTable<T> for [(&[&str], T); N] {
    fn longest_at(&self, lexemes: &[Lexeme]) -> Option<(T, usize)> {
        self[..].longest_at(lexemes)
    }
}

impl<T: Copy> PhraseTable<T> for LazyLock<Index<T>> {
    fn longest_at(&self, lexemes: &[Lexeme]) -> Option<(T, usize)> {
        self.longest(lexemes)
    }
}

/// The entry whose phrase is the longest at the start of `lexemes`, with the number of its words.
pub(super) fn longest<T: Copy, L: PhraseTable<T> + ?Sized>(
    lexemes: &[Lexeme],
    table: &L,
) -> Option<(T, usize)> {
    table.longest_at(lexemes)
}

/// How something stands to another, by the longest phrase at the start.
pub(super) fn longest_relation(lexemes: &[Lexeme]) -> Option<(Relation, usize)> {
    static INDEX: LazyLock<Index<Relation>> = LazyLock::new(|| Index::of(RELATIONS));
    INDEX.longest(lexemes)
}

/// A side of the agent, by the longest phrase at the start.
pub(super) fn longest_side(lexemes: &[Lexeme]) -> Option<(Side, usize)> {
    static INDEX: LazyLock<Index<Side>> = LazyLock::new(|| Index::of(SIDES));
    INDEX.longest(lexemes)
}

/// The number of words of the longest of the phrases at the start of `lexemes`.
pub(super) fn longest_phrase<L: PhraseList + ?Sized>(lexemes: &[Lexeme], phrases: &L) -> Option<usize> {
    match &lexemes.first()?.token {
        Token::Word(word) if phrases.may_begin(word) => longest_of(lexemes, phrases.list()),
        _ => None,
    }
}

fn longest_of(lexemes: &[Lexeme], phrases: &[&str]) -> Option<usize> {
    let first = initial(lexemes)?;
    phrases.iter().filter(|phrase| begins(phrase, first)).filter_map(|phrase| fits(lexemes, phrase)).max()
}

/// The first byte of the first word. Most phrases of a table are told from it by that alone.
fn initial(lexemes: &[Lexeme]) -> Option<u8> {
    match &lexemes.first()?.token {
        Token::Word(word) => word.as_bytes().first().copied(),
        _ => None,
    }
}

fn begins(phrase: &str, first: u8) -> bool {
    phrase.as_bytes().first() == Some(&first)
}

/// The class named at the start of `lexemes` with the most words, with their number.
pub(super) fn category(lexemes: &[Lexeme]) -> Option<(&'static Category, usize)> {
    static INDEX: LazyLock<Index<&Category>> = LazyLock::new(|| {
        let words = CATEGORIES.iter().flat_map(|class| class.words.iter().map(move |word| (*word, class)));
        Index::with_forms(
            words.flat_map(|(word, class)| forms(word).map(move |(first, rest)| (first, rest, class))),
        )
    });
    INDEX.longest_by(lexemes, |after, rest| rest.is_empty() || fits_noun(after, rest).is_some())
}

/// A noun by its first word: one word by each of its plurals too.
fn forms(noun: &'static str) -> impl Iterator<Item = (Cow<'static, str>, &'static str)> {
    let (first, rest) = noun.split_once(' ').unwrap_or((noun, ""));
    let plurals = rest.is_empty().then(|| {
        let stem = noun.strip_suffix('y').map(|stem| format!("{stem}ies"));
        [format!("{noun}s"), format!("{noun}es")].into_iter().chain(stem)
    });
    let plurals = plurals.into_iter().flatten().map(move |plural| (Cow::Owned(plural), rest));
    std::iter::once((Cow::Borrowed(first), rest)).chain(plurals)
}

/// The first of the longest hits.
fn longer<T: Copy>(hits: impl Iterator<Item = (T, usize)>) -> Option<(T, usize)> {
    hits.fold(None, |best, hit| match best {
        Some((_, count)) if count >= hit.1 => best,
        _ => Some(hit),
    })
}

#[cfg(test)]
mod tests {
    use super::super::lexer::lex;
    use super::*;

    #[test]
    fn every_kind_and_place_has_a_word() {
        let is_named = |kind: &EntityKind| CATEGORIES.iter().any(|category| category.kinds.contains(kind));
        let nameless: Vec<_> = EntityKind::ALL.iter().filter(|kind| !is_named(kind)).collect();
        assert_eq!(nameless, [&EntityKind::Ground]); // nobody goes to "the ground"
        for place in Place::ALL {
            assert!(CATEGORIES.iter().any(|category| category.place == Some(*place)), "{place}");
        }
    }

    #[test]
    fn no_word_has_two_meanings() {
        let mut words: Vec<&str> = CATEGORIES.iter().flat_map(|category| category.words).copied().collect();
        words.sort_unstable();
        assert!(words.windows(2).all(|pair| pair[0] != pair[1]), "{words:?}");
    }

    #[test]
    fn the_longest_name_wins() {
        let first = |text: &str| category(&lex(text)).map(|(category, count)| (category.words[0], count));
        assert_eq!(first("bus stop"), Some(("bus stop", 2)));
        assert_eq!(first("buses"), Some(("bus", 1)));
        assert_eq!(first("factories here"), Some(("factory", 1)));
        assert_eq!(first("busy"), None);
    }
}
