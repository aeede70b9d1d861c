//! What the words of whole scenes say, as tables.

use simworld_core::spec::{Amount, DistrictKind, Height, Pattern, SceneKind, Water, Width};

/// Houses where words of a settlement say no number: beyond the city alone, where the number says how large it is.
pub(super) const SETTLED: &[(&[&str], u32)] = &[
    (&["hamlet", "settlement", "farm", "farms"], 8),
    (&["village"], 18),
    (&["town", "old town", "quarter", "district", "neighbourhood", "neighborhood"], 45),
    (&["city", "metropolis"], 120),
];

/// Things that stand alone, by the names of the library.
#[rustfmt::skip]
pub(super) const LANDMARKS: &[(&[&str], &str)] = &[
    (&["lighthouse", "lighthouses"], "lighthouse"), (&["windmill", "windmills", "mill", "mills"], "windmill"),
    (&["church", "chapel", "churches", "chapels"], "church"), (&["cathedral", "cathedrals", "minster", "basilica"], "cathedral"),
    (&["mosque", "mosques"], "mosque"), (&["temple", "temples"], "temple"), (&["synagogue", "synagogues"], "synagogue"),
    (&["castle", "castles"], "castle"), (&["ruin", "ruins"], "ruin"), (&["monastery", "abbey", "monasteries"], "monastery"),
    (&["observatory"], "observatory"), (&["water tower", "water towers"], "water_tower"), (&["boathouse", "boat house", "boathouses"], "boathouse"),
    (&["silo", "silos"], "silo"), (&["stable", "stables"], "stable"), (&["radio tower", "radio mast"], "radio_tower"),
    (&["clock tower", "belfry", "clock towers"], "clock_tower"), (&["town hall", "city hall", "town halls"], "town_hall"),
    (&["station", "train station", "railway station", "main station", "central station", "train stations", "railway stations", "stations"], "train_station"),
    (&["bus station", "bus terminal", "coach station"], "bus_station"), (&["library", "public library", "libraries"], "library"),
    (&["theatre", "theater", "opera", "opera house", "playhouse", "theatres", "theaters"], "theatre"), (&["cinema", "movie theatre", "movie theater", "cinemas"], "cinema"),
    (&["concert hall", "concert halls"], "concert_hall"), (&["market hall", "market halls"], "market_hall"), (&["court house", "courthouse"], "court_house"),
    (&["stadium", "stadiums", "football stadium"], "stadium"), (&["sports hall", "gymnasium", "sports halls"], "sports_hall"),
    (&["swimming hall", "swimming pool", "indoor pool"], "swimming_hall"), (&["hotel", "hotels"], "hotel"), (&["police station", "police stations"], "police_station"),
    (&["fire station", "fire stations"], "fire_station"), (&["post office", "post offices"], "post_office"), (&["shopping mall", "mall", "shopping centre", "shopping center"], "shopping_mall"),
    (&["power station", "power plant"], "power_station"), (&["brewery", "breweries"], "brewery"), (&["parking garage", "car park", "multi storey car park"], "parking_garage"),
];

/// When the words for a part of a city mean one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Said {
    /// By themselves.
    Alone,
    /// Where it is said where it lies: "homes by the river".
    Somewhere,
    /// Where it is said in which part of the place it lies: "an old town by the river" is all of the place.
    InPart,
}

/// Parts of a city.
#[rustfmt::skip]
pub(super) const DISTRICTS: &[(&[&str], (DistrictKind, Said))] = &[
    (&["old town", "old quarter", "old centre", "old center"], (DistrictKind::OldTown, Said::InPart)),
    (&["historic centre", "historic center", "medieval quarter", "medieval centre", "medieval center", "historic quarter", "historic district", "old town district", "historic old town"],
        (DistrictKind::OldTown, Said::Alone)),
    (&["homes", "houses", "housing", "dwellings", "flats", "apartments", "villas", "apartment blocks", "residences"], (DistrictKind::Residential, Said::Somewhere)),
    (&["residential area", "suburb", "suburbs", "housing estate"], (DistrictKind::Residential, Said::InPart)),
    (&["residential district", "residential quarter", "residential neighbourhood", "residential neighborhood", "residential zone", "residential areas", "residential districts"],
        (DistrictKind::Residential, Said::Alone)),
    (&["downtown"], (DistrictKind::Business, Said::InPart)),
    (&["offices", "businesses", "banks", "office buildings", "office blocks", "office towers"], (DistrictKind::Business, Said::Somewhere)),
    (&["business district", "financial district", "central business district", "office district", "business quarter", "office quarter", "business centre", "business center", "office park", "banking district"],
        (DistrictKind::Business, Said::Alone)),
    (&["shops", "stores", "shopping", "restaurants", "cafes", "shops and restaurants", "shops and cafes"], (DistrictKind::Shopping, Said::Somewhere)),
    (&["shopping district", "shopping quarter", "shopping area", "shopping street", "shopping streets", "commercial district", "commercial area", "commercial quarter", "restaurant quarter"],
        (DistrictKind::Shopping, Said::Alone)),
    (&["factories", "industry", "warehouses", "workshops", "works", "factories and warehouses", "warehouses and factories"], (DistrictKind::Industrial, Said::Somewhere)),
    (&["industrial district", "industrial area", "industrial zone", "industrial estate", "industrial quarter", "industrial park", "factory district", "warehouse district", "industrial areas"],
        (DistrictKind::Industrial, Said::Alone)),
    (&["schools", "hospitals", "museums", "schools and museums", "schools and hospitals"], (DistrictKind::Civic, Said::Somewhere)),
    (&["civic district", "civic centre", "civic center", "government district", "museum quarter", "museum district", "university quarter", "university district", "hospital district", "school district",
        "university campus", "government quarter"], (DistrictKind::Civic, Said::Alone)),
    (&["greenery", "green space", "green spaces", "gardens", "parks", "meadows"], (DistrictKind::Green, Said::Somewhere)),
    (&["green belt", "parkland", "green district", "park district", "green quarter"], (DistrictKind::Green, Said::Alone)),
];

/// What a place is called that may have a use before it: "a factory town" has a factory, whoever counts them later.
pub(super) const SETTLEMENTS: &[&str] =
    &["town", "city", "village", "quarter", "district", "neighbourhood", "neighborhood"];

/// What every place of a kind has, so that nothing is left unread there.
#[rustfmt::skip]
pub(super) const NATURAL: &[(&[&str], &[SceneKind])] = &[
    (&["forest", "forests", "woods", "woodland", "paths", "path", "trails", "trail", "footpaths", "hiking trails", "hills", "rolling hills",
        "hilly", "meadows", "meadow", "wild"], &[SceneKind::Countryside, SceneKind::Wilderness, SceneKind::Island]),
    (&["mountains", "mountain", "rocks", "boulders", "peaks", "camp site", "campsite", "camp"], &[SceneKind::Wilderness]),
    (&["hedges", "hedgerows", "orchards", "orchard", "farms", "farm", "barns", "barn", "crops"], &[SceneKind::Countryside]),
    (&["beach", "beaches", "sandy", "sandy beaches", "coast", "shore", "rocky"], &[SceneKind::Island]),
];

/// What a phrase says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fact {
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
pub(super) const FACTS: &[(&[&str], Fact)] = &[
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
pub(super) const AMOUNTS: &[(&[&str], Amount)] = &[
    (&["no", "without", "without any", "zero", "not any", "free of", "devoid of", "lacking"], Amount::None),
    (&["few", "a few", "hardly any", "some", "a couple of", "not many", "only few", "sparse"], Amount::Few),
    (&["many", "lots of", "a lot of", "plenty of", "full of", "lot of", "loads of", "countless", "numerous", "filled with"], Amount::Many),
];

/// Words that ask, join and adorn.
#[rustfmt::skip]
pub(super) const NOISE: &[&str] = &["a", "an", "the", "with", "and", "of", "in", "on", "at", "by", "make", "me", "create", "build", "generate", "please",
    "i", "id", "like", "want", "would", "us", "give", "can", "you", "could", "it", "its", "is", "are", "there", "should", "be", "has",
    "have", "having", "that", "which", "where", "along", "around", "about", "some", "old", "modern", "new", "quiet", "nice", "beautiful",
    "pretty", "scene", "world", "place", "street", "pattern", "layout", "streets", "roads", "style", "central", "main", "public", "to",
    "for", "from", "all", "everywhere", "surrounded", "set", "located", "lies", "near", "one", "also", "plus", "time", "weather", "sky",
    "let", "lets", "now", "then", "very", "quite", "rather", "typical", "european", "picturesque", "charming", "only", "exactly", "roughly",
    "approximately", "least", "them", "those", "tall", "dense", "early", "late", "during", "under", "into", "through", "run", "running",
    "kind", "sort", "as", "or", "so", "but", "not", "two", "lined", "bustling", "busy", "calm", "peaceful", "residential", "i'd", "my",
    "need", "design", "show", "draw", "imagine", "picture", "something", "somewhere", "beside", "next", "middle", "its", "their", "fishing",
    "altogether", "total", "spread", "across", "up", "out", "go", "going", "light", "bit"];

/// Every phrase here, so that none of its words is taken for a misspelling.
pub(super) fn phrases() -> impl Iterator<Item = &'static &'static str> {
    let facts = FACTS.iter().flat_map(|(words, _)| *words);
    let amounts = AMOUNTS.iter().flat_map(|(words, _)| *words);
    let landmarks = LANDMARKS.iter().flat_map(|(words, _)| *words);
    let districts = DISTRICTS.iter().flat_map(|(words, _)| *words);
    facts.chain(amounts).chain(landmarks).chain(districts).chain(NOISE)
}

/// The names of the library that words have.
#[cfg(feature = "thought")]
pub(crate) fn landmark_names() -> impl Iterator<Item = &'static str> {
    LANDMARKS.iter().map(|(_, name)| *name)
}

#[cfg(test)]
mod tests {
    use simworld_core::asset::Catalogue;
    use simworld_core::scene::EntityKind;

    use super::*;

    #[test]
    fn every_landmark_is_a_building_of_the_library() {
        let library = Catalogue::library();
        for (_, name) in LANDMARKS {
            let asset = library.find(name).and_then(|id| library.get(id));
            let asset = asset.unwrap_or_else(|| panic!("the library has no {name}"));
            assert_eq!(asset.kind, EntityKind::Building, "{name}");
        }
    }
}
