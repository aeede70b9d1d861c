//! The words of whole scenes: each phrase says one thing of the place, in any order.

use simworld_core::scene::Place;
use simworld_core::spec::{Amount, Height, Pattern, SceneKind, SceneSpec, Water, Width};

use super::edits::sky::{changed, hour};
use super::edits::words::{SKIES, SKY_ROWS, Sky};
use super::hearing;
use super::lexer::{Lexeme, Token};
use super::lexicon::{CATEGORIES, category, longest, longest_phrase};
use super::numbers;
use super::spelling::is_known;
use crate::scenes::SceneReading;

/// The longest sentence that is read, characters.
const LONGEST: usize = 2000;
/// The most squares and parks that words ask for, so that a slip of the pen asks for no thousand names.
const MOST: u32 = 40;

/// Houses where words of a settlement say no number: beyond the city alone, where the number says how large it is.
const SETTLED: &[(&[&str], u32)] = &[
    (&["hamlet", "settlement", "farm", "farms"], 8),
    (&["village"], 18),
    (&["town", "old town", "quarter", "district", "neighbourhood", "neighborhood"], 45),
    (&["city", "metropolis"], 120),
];

/// Things that stand alone beyond the city, by the names of the library.
#[rustfmt::skip]
const LANDMARKS: &[(&[&str], &str)] = &[
    (&["lighthouse", "lighthouses"], "lighthouse"), (&["windmill", "windmills", "mill"], "windmill"),
    (&["church", "chapel"], "church"), (&["castle"], "castle"), (&["ruin", "ruins"], "ruin"), (&["monastery", "abbey"], "monastery"),
    (&["observatory"], "observatory"), (&["water tower"], "water_tower"), (&["boathouse", "boat house"], "boathouse"),
    (&["silo", "silos"], "silo"), (&["stable", "stables"], "stable"), (&["radio tower", "radio mast"], "radio_tower"),
];

/// What every place of a kind has, so that nothing is left unread there.
#[rustfmt::skip]
const NATURAL: &[(&[&str], &[SceneKind])] = &[
    (&["forest", "forests", "woods", "woodland", "paths", "path", "trails", "trail", "footpaths", "hiking trails", "hills", "rolling hills",
        "hilly", "meadows", "meadow", "wild"], &[SceneKind::Countryside, SceneKind::Wilderness, SceneKind::Island]),
    (&["mountains", "mountain", "rocks", "boulders", "peaks", "camp site", "campsite", "camp"], &[SceneKind::Wilderness]),
    (&["hedges", "hedgerows", "orchards", "orchard", "farms", "farm", "barns", "barn", "crops"], &[SceneKind::Countryside]),
    (&["beach", "beaches", "sandy", "sandy beaches", "coast", "shore", "rocky"], &[SceneKind::Island]),
];

/// What a phrase says.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fact {
    Kind(SceneKind),
    /// Of a city, so many pieces of street where no houses are counted.
    Size(u32),
    Pattern(Pattern),
    Width(Width),
    PatternAndWidth(Pattern, Width),
    Suburb,
    Houses,
    HousesOf(Height),
    Streets,
    Trees,
    TreesOf(Amount),
    Cars,
    Water(Water),
    Square(&'static str),
    Park,
}

#[rustfmt::skip]
const FACTS: &[(&[&str], Fact)] = &[
    (&["city", "town", "village", "hamlet", "downtown", "metropolis", "settlement", "neighbourhood", "neighborhood", "quarter",
        "district", "old town", "city centre", "city center", "inner city", "cities", "towns"], Fact::Kind(SceneKind::City)),
    (&["suburb", "suburbs", "suburbia", "suburban", "housing estate", "residential area"], Fact::Suburb),
    (&["countryside", "rural", "farmland", "fields", "rural area"], Fact::Kind(SceneKind::Countryside)),
    (&["wilderness", "wild nature", "national park", "untouched nature"], Fact::Kind(SceneKind::Wilderness)),
    (&["island", "isle", "islet"], Fact::Kind(SceneKind::Island)),
    (&["tiny"], Fact::Size(12)),
    (&["small", "little"], Fact::Size(24)),
    (&["big", "large", "great"], Fact::Size(120)),
    (&["huge", "enormous", "giant", "sprawling", "vast"], Fact::Size(300)),
    (&["grid", "on a grid", "grid pattern", "grid layout", "chequered", "checkerboard", "right angled", "straight streets",
        "straight roads", "gridded", "grid streets", "manhattan style"], Fact::Pattern(Pattern::Grid)),
    (&["winding", "winding streets", "winding roads", "crooked", "crooked streets", "organic", "medieval", "winding lanes",
        "curvy streets", "twisting streets", "meandering streets", "twisty streets", "labyrinthine",
        "organic street pattern", "curved streets", "historic"], Fact::Pattern(Pattern::Winding)),
    (&["narrow streets", "narrow roads", "narrow lanes", "narrow alleys", "alleys", "narrow street", "tight streets", "small streets",
        "little streets", "alleyways"], Fact::Width(Width::Narrow)),
    (&["crooked alleys", "winding alleys", "crooked lanes", "narrow winding streets", "winding narrow streets",
        "narrow and winding streets", "narrow crooked streets"], Fact::PatternAndWidth(Pattern::Winding, Width::Narrow)),
    (&["wide streets", "wide roads", "wide avenues", "broad streets", "broad avenues", "boulevards", "avenues", "wide boulevards",
        "broad roads", "broad boulevards", "spacious streets", "wide lanes", "big streets", "large streets"], Fact::Width(Width::Wide)),
    (&["building", "buildings", "house", "houses", "cottage", "cottages", "homes", "structures", "huts", "hut", "cabin", "cabins", "log cabin", "log cabins", "apartment buildings"], Fact::Houses),
    (&["low houses", "low buildings", "low rise", "low rise buildings", "small houses", "small buildings", "one storey houses",
        "bungalows", "low roofs"], Fact::HousesOf(Height::Low)),
    (&["skyscrapers", "skyscraper", "high rises", "high rise", "high rise buildings", "tall buildings", "towers", "high buildings",
        "tower blocks", "tall houses", "office towers", "highrises"], Fact::HousesOf(Height::High)),
    (&["streets", "roads", "street", "road", "lanes"], Fact::Streets),
    (&["trees", "tree", "greenery", "tall trees"], Fact::Trees),
    (&["tree lined", "trees everywhere", "tall trees everywhere", "leafy", "green streets", "lush", "treelined"], Fact::TreesOf(Amount::Many)),
    (&["wooded", "forested", "densely wooded", "thickly wooded"], Fact::TreesOf(Amount::Many)),
    (&["treeless", "barren"], Fact::TreesOf(Amount::None)),
    (&["parked cars", "cars parked", "parked vehicles", "cars", "parking cars"], Fact::Cars),
    (&["harbour", "harbor", "port", "seaside", "by the sea", "coastal", "sea", "docks", "marina", "on the coast", "at the sea",
        "waterfront", "harbour basin", "fishing port"], Fact::Water(Water::Harbour)),
    (&["river", "riverside", "by a river", "canal", "stream"], Fact::Water(Water::River)),
    (&["lake", "pond", "lakeside"], Fact::Water(Water::Lake)),
    (&["market square", "market squares", "market place", "marketplace"], Fact::Square("Market Square")),
    (&["square", "squares", "town square", "central square", "main square", "piazza", "village square"], Fact::Square("Town Square")),
    (&["plaza", "plazas", "central plaza"], Fact::Square("Plaza")),
    (&["park", "parks", "public park", "green space", "green spaces", "gardens"], Fact::Park),
];

/// How much of the thing that is named next.
#[rustfmt::skip]
const AMOUNTS: &[(&[&str], Amount)] = &[
    (&["no", "without", "without any", "zero", "not any", "free of", "devoid of", "lacking"], Amount::None),
    (&["few", "a few", "hardly any", "some", "a couple of", "not many", "only few", "sparse"], Amount::Few),
    (&["many", "lots of", "a lot of", "plenty of", "full of", "lot of", "loads of", "countless", "numerous", "filled with"], Amount::Many),
];

/// Words that ask, join and adorn.
#[rustfmt::skip]
const NOISE: &[&str] = &["a", "an", "the", "with", "and", "of", "in", "on", "at", "by", "make", "me", "create", "build", "generate", "please",
    "i", "id", "like", "want", "would", "us", "give", "can", "you", "could", "it", "its", "is", "are", "there", "should", "be", "has",
    "have", "having", "that", "which", "where", "along", "around", "about", "some", "old", "modern", "new", "quiet", "nice", "beautiful",
    "pretty", "scene", "world", "place", "street", "pattern", "layout", "streets", "roads", "style", "central", "main", "public", "to",
    "for", "from", "all", "everywhere", "surrounded", "set", "located", "lies", "near", "one", "also", "plus", "time", "weather", "sky",
    "let", "lets", "now", "then", "very", "quite", "rather", "typical", "european", "picturesque", "charming", "only", "exactly", "roughly",
    "approximately", "least", "them", "those", "tall", "dense", "early", "late", "during", "under", "into", "through", "run", "running",
    "kind", "sort", "as", "or", "so", "but", "not", "two", "lined", "bustling", "busy", "calm", "peaceful", "residential", "i'd", "my",
    "need", "design", "show", "draw", "imagine", "picture", "something", "somewhere", "beside", "next", "middle", "its", "their", "fishing",
    "altogether", "total", "spread", "across", "up", "out", "go", "going", "light", "bit"];

/// Reads a sentence; nothing if no word of it is about a scene.
pub(crate) fn read(words: &str) -> Option<SceneReading> {
    let words: String = words.chars().take(LONGEST).collect();
    let mut lexemes = hearing::hear(&words, None);
    correct(&mut lexemes);
    let mut scene = Scene { words: &words, lexemes: &lexemes, at: 0, ..Scene::default() };
    while scene.at < lexemes.len() {
        scene.step();
    }
    scene.finish()
}

#[derive(Default)]
struct Scene<'a> {
    words: &'a str,
    lexemes: &'a [Lexeme],
    at: usize,
    spec: SceneSpec,
    skies: Vec<Sky>,
    unread: Vec<String>,
    /// The number that was said last and belongs to what comes.
    number: Option<u32>,
    amount: Option<Amount>,
    size: Option<u32>,
    /// What is known beyond the city alone: how many houses a settlement has, landmarks with the words for them, what the land
    /// has anyway. Its words count as unread until the kind is known.
    settled: Option<u32>,
    landmarks: Vec<(&'static str, u32, String)>,
    natural: Vec<(&'static [SceneKind], String)>,
    /// How many facts were found.
    facts: u32,
}

impl Scene<'_> {
    /// Reads on by one phrase.
    fn step(&mut self) {
        let rest = &self.lexemes[self.at..];
        if matches!(rest[0].token, Token::Comma | Token::Break) {
            (self.number, self.amount) = (None, None);
            self.at += 1;
            return;
        }
        if self.titled() || self.timed() || self.counted() {
            return;
        }
        let fact = longest(rest, FACTS);
        let sky = longest(rest, &SKIES).filter(|(_, words)| fact.is_none_or(|(_, own)| *words > own));
        let place = category(rest).and_then(|(class, words)| Some((class.place()?, words)));
        let place = place.filter(|(place, words)| {
            *place != Place::Home
                && fact.is_none_or(|(_, own)| *words > own)
                && sky.is_none_or(|(_, own)| *words > own)
        });
        let amount = longest(rest, AMOUNTS).filter(|(_, words)| fact.is_none_or(|(_, own)| *words >= own));
        if let Some((place, words)) = place {
            self.place(place);
            self.at += words;
        } else if let Some((sky, words)) = sky {
            self.skies.push(sky);
            self.facts += 1;
            self.at += words;
        } else if let Some((amount, words)) = amount {
            self.amount = Some(amount);
            self.at += words;
        } else if let Some((fact, words)) = fact {
            self.settled = self.settled.max(longest(rest, SETTLED).map(|(houses, _)| houses));
            self.fact(fact);
            self.at += words;
        } else if let Some(words) = longest_phrase(rest, NOISE) {
            self.at += words;
        } else if !self.beyond() {
            self.unread.push(self.words[rest[0].start..rest[0].end].to_owned());
            self.number = None;
            self.at += 1;
        }
    }

    /// A landmark, or what the land has: known beyond the city alone.
    fn beyond(&mut self) -> bool {
        let rest = &self.lexemes[self.at..];
        let landmark = longest(rest, LANDMARKS);
        let natural = longest(rest, NATURAL);
        let Some(words) = landmark.map(|(_, words)| words).max(natural.map(|(_, words)| words)) else {
            return false;
        };
        let said = self.words[rest[0].start..rest[words - 1].end].to_owned();
        self.settled = self.settled.max(longest(rest, SETTLED).map(|(houses, _)| houses));
        if let Some((name, _)) = landmark {
            self.landmarks.push((name, self.number.take().unwrap_or(1), said.clone()));
        } else if let Some((kinds, _)) = natural {
            self.natural.push((kinds, said.clone()));
        }
        self.unread.push(said);
        (self.number, self.amount) = (None, None);
        self.at += words;
        true
    }

    /// Takes up what is known beyond the city, now that the kind is known.
    fn settle(&mut self) {
        let kind = self.spec.kind;
        let read = |unread: &mut Vec<String>, said: &str| {
            if let Some(index) = unread.iter().position(|word| word == said) {
                unread.remove(index);
            }
        };
        for (name, count, said) in std::mem::take(&mut self.landmarks) {
            *self.spec.features.landmarks.entry(name.to_owned()).or_default() += count;
            read(&mut self.unread, &said);
        }
        for (kinds, said) in std::mem::take(&mut self.natural) {
            if kinds.contains(&kind) {
                read(&mut self.unread, &said);
            }
        }
        if kind != SceneKind::Wilderness && self.spec.buildings.count.is_none() {
            self.spec.buildings.count = self.settled;
        }
    }

    /// "Called Little Haven".
    fn titled(&mut self) -> bool {
        let rest = &self.lexemes[self.at..];
        let Some(words) = longest_phrase(rest, &["called", "named", "by the name of", "with the name"])
        else {
            return false;
        };
        let ends = |lexeme: &Lexeme| match &lexeme.token {
            Token::Word(word) => ["with", "that", "which", "and", "where", "in", "by", "on", "at", "of"]
                .contains(&word.as_str()),
            Token::Number(_) => false,
            _ => true,
        };
        let from = self.at + words;
        let count = self.lexemes[from..].iter().take_while(|lexeme| !ends(lexeme)).count();
        if let Some([first, .., last] | [first @ last]) = self.lexemes.get(from..from + count) {
            self.spec.title = Some(self.words[first.start..last.end].to_owned());
        }
        self.at = from + count;
        true
    }

    /// "At 8 pm".
    fn timed(&mut self) -> bool {
        let rest = &self.lexemes[self.at..];
        let is_number = numbers::number(rest).is_some();
        let Some((sky, words)) = hour(rest).filter(|_| is_number) else { return false };
        let at = self.at.checked_sub(1).map(|before| &self.lexemes[before].token);
        let said = matches!(at, Some(Token::Word(word)) if ["at", "by", "around"].contains(&word.as_str()));
        let bare = numbers::number(rest).is_some_and(|(_, count)| count == words);
        if bare && !(said && self.lexemes.get(self.at + words).is_none()) {
            return false;
        }
        self.skies.push(sky);
        self.facts += 1;
        self.at += words;
        true
    }

    /// A number that counts what is named next, or what was named before: "about 60 of them".
    fn counted(&mut self) -> bool {
        let rest = &self.lexemes[self.at..];
        let is_article =
            matches!(&rest[0].token, Token::Word(word) if ["a", "an", "one"].contains(&word.as_str()));
        let Some((mut number, mut words)) = numbers::number(rest) else { return false };
        if is_article && number <= 1.0 && !matches!(&rest[0].token, Token::Word(word) if word == "one") {
            self.number = Some(1);
            self.at += 1;
            return true;
        }
        // "One hundred and twenty".
        if number >= 100.0
            && longest_phrase(&rest[words..], &["and"]).is_some()
            && let Some((more, count)) =
                numbers::number(&rest[words + 1..]).filter(|(more, _)| *more >= 1.0 && *more < 100.0)
        {
            (number, words) = (number + more, words + 1 + count);
        }
        if !(number >= 0.0 && number.fract() == 0.0) {
            return false;
        }
        let number = number.min(f64::from(u32::MAX)) as u32;
        self.at += words;
        if let Some(words) =
            longest_phrase(&self.lexemes[self.at..], &["of them", "of those", "in total", "altogether"])
        {
            self.spec.buildings.count = Some(number);
            self.facts += 1;
            self.at += words;
        } else {
            self.number = Some(number);
        }
        true
    }

    fn place(&mut self, place: Place) {
        let count = if self.amount.take() == Some(Amount::None) { 0 } else { self.number.unwrap_or(1) };
        self.number = None;
        self.spec.features.places.insert(place, count);
        self.facts += 1;
    }

    fn fact(&mut self, fact: Fact) {
        self.facts += 1;
        let number = self.number;
        let amount = self.amount;
        let mut uses = true;
        match fact {
            Fact::Kind(kind) => {
                // A town on an island is an island.
                if kind != SceneKind::City {
                    self.spec.kind = kind;
                }
            }
            Fact::Size(size) => {
                self.size = Some(size);
                uses = false;
            }
            Fact::Pattern(pattern) => {
                self.spec.streets.pattern = pattern;
                uses = false;
            }
            Fact::Width(width) => self.spec.streets.width = width,
            Fact::PatternAndWidth(pattern, width) => {
                (self.spec.streets.pattern, self.spec.streets.width) = (pattern, width);
            }
            Fact::Suburb => self.spec.streets.pattern = Pattern::Suburb,
            Fact::Houses | Fact::HousesOf(_) => {
                if let Fact::HousesOf(height) = fact {
                    self.spec.buildings.height = height;
                }
                self.spec.buildings.count = number.filter(|count| *count > 1).or(self.spec.buildings.count);
            }
            Fact::Streets => {
                self.spec.streets.count = number.filter(|count| *count > 1).or(self.spec.streets.count);
            }
            Fact::Trees => self.spec.streets.trees = amount.unwrap_or(self.spec.streets.trees),
            Fact::TreesOf(amount) => self.spec.streets.trees = amount,
            Fact::Cars => self.spec.streets.parked = amount.unwrap_or(self.spec.streets.parked),
            Fact::Water(water) => {
                let waters = &mut self.spec.features.waters;
                if amount != Some(Amount::None) && !waters.contains(&water) {
                    waters.push(water);
                }
            }
            Fact::Square(name) => named(&mut self.spec.features.squares, name, number, amount),
            Fact::Park => named(&mut self.spec.features.parks, "Park", number, amount),
        }
        if uses {
            (self.number, self.amount) = (None, None);
        }
    }

    fn finish(mut self) -> Option<SceneReading> {
        let is_sky_alone = self.facts as usize == self.skies.len();
        if self.facts == 0 || is_sky_alone {
            return None;
        }
        if !self.skies.is_empty() {
            self.spec.environment = changed(self.spec.environment, &self.skies);
        }
        if self.spec.kind != SceneKind::City {
            self.settle();
        } else if self.spec.buildings.count.is_none() {
            self.spec.streets.count = self.spec.streets.count.or(self.size);
        }
        Some(SceneReading { spec: self.spec, unread: self.unread })
    }
}

/// "Two squares": the second is called "Second Town Square".
fn named(names: &mut Vec<String>, name: &str, number: Option<u32>, amount: Option<Amount>) {
    let count = match amount {
        Some(Amount::None) => 0,
        Some(Amount::Few | Amount::Many) if number.is_none() => 3,
        _ => number.unwrap_or(1),
    };
    for _ in 0..count.min(MOST) {
        let text = match names.len() {
            0 => name.to_owned(),
            1 => format!("Second {name}"),
            2 => format!("Third {name}"),
            more => format!("{name} {}", more + 1),
        };
        names.push(text);
    }
}

/// Puts words right that are one slip away from one word of scenes.
fn correct(lexemes: &mut [Lexeme]) {
    let own = || {
        let facts = FACTS.iter().flat_map(|(words, _)| *words);
        let skies = SKY_ROWS.iter().flat_map(|(words, _)| *words);
        let amounts = AMOUNTS.iter().flat_map(|(words, _)| *words);
        let places = CATEGORIES.iter().filter(|class| class.is_place()).flat_map(|class| class.words);
        facts.chain(skies).chain(amounts).chain(places).chain(NOISE).flat_map(|phrase| phrase.split(' '))
    };
    for lexeme in lexemes {
        let Token::Word(word) = &lexeme.token else { continue };
        if word.chars().count() < 4
            || own().any(|own| own == word)
            || is_known(word)
            || numbers::number(std::slice::from_ref(lexeme)).is_some()
        {
            continue;
        }
        let mut near: Vec<&str> =
            own().filter(|own| own.chars().count() >= 4 && strsim::osa_distance(own, word) == 1).collect();
        near.sort_unstable();
        near.dedup();
        if let [right] = near[..] {
            lexeme.token = Token::Word(right.to_owned());
        }
    }
}
