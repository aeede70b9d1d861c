//! The words of which names are made.

use simworld_core::seed::StreamRng;

/// What a street is called after its name proper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Highway,
    Avenue,
    Street,
    Lane,
    Close,
}

impl Kind {
    const COUNT: usize = 5;

    const fn words(self) -> &'static [&'static str] {
        match self {
            Self::Highway => &["Highway", "Expressway"],
            Self::Avenue => &["Avenue", "Boulevard", "Parade"],
            Self::Street => &["Street", "Road", "Street", "Row"],
            Self::Lane => &["Lane", "Way", "Walk", "Drive"],
            Self::Close => &["Close", "Court", "Place", "Yard"],
        }
    }
}

const STEMS: [&str; 61] = [
    "Alder", "Almond", "Amber", "Anchor", "Apple", "Arden", "Ash", "Baker", "Barley", "Beacon", "Beech",
    "Bell", "Birch", "Blossom", "Bramble", "Brewer", "Bridge", "Brook", "Canal", "Carter", "Castle", "Cedar",
    "Chapel", "Cherry", "Clay", "Clover", "Cooper", "Copper", "Crane", "Elm", "Falcon", "Fern", "Fisher",
    "Foundry", "Garden", "Granite", "Harbour", "Hawthorn", "Hazel", "Heron", "Holly", "Ivy", "Juniper",
    "Lantern", "Larch", "Laurel", "Linden", "Maple", "Market", "Mason", "Meadow", "Mill", "Orchard",
    "Poplar", "Potter", "Quarry", "Rowan", "Saddler", "Smith", "Tanner", "Willow",
];

const FEATURES: [&str; 17] = [
    "Hill", "Park", "Field", "Gate", "Grove", "Green", "Hollow", "Bank", "Cross", "Ridge", "Ford", "Heath",
    "Spring", "Dale", "Crest", "Moor", "Well",
];

const QUALIFIERS: [&str; 7] = ["Old", "New", "Upper", "Lower", "North", "South", "Little"];

/// Steps through stems and features in turn; primes to their numbers, and so all are visited.
const STEM_STEP: usize = 23;

/// Gives out names, each once.
#[derive(Clone, Debug)]
pub(super) struct Names {
    /// How many names of each kind were given out.
    given: [usize; Kind::COUNT],
    /// Where the stems of each kind begin.
    first: [usize; Kind::COUNT],
}

impl Names {
    pub(super) fn new(rng: &mut StreamRng) -> Self {
        Self { given: [0; Kind::COUNT], first: std::array::from_fn(|_| rng.below(STEMS.len())) }
    }

    /// The next name of a kind: a stem alone as long as there are any, then with a feature of the land, then qualified,
    /// then numbered.
    pub(super) fn next(&mut self, kind: Kind) -> String {
        let number = self.given[kind as usize];
        self.given[kind as usize] += 1;
        let words = kind.words();
        let stem = STEMS[(self.first[kind as usize] + number * STEM_STEP) % STEMS.len()];
        let round = number / STEMS.len();
        // Stems alone take the first word; after that words take turns, the more common ones more often.
        let last = words[round.min(1) * (number % words.len())];
        let features = FEATURES.len();
        match round {
            0 => format!("{stem} {}", words[0]),
            _ if round <= features => format!("{stem} {} {last}", FEATURES[round - 1]),
            _ if round <= features * (1 + QUALIFIERS.len()) => {
                let rest = round - features - 1;
                format!("{} {stem} {} {last}", QUALIFIERS[rest / features], FEATURES[rest % features])
            }
            _ => format!("{stem} {last} {}", round - features * (1 + QUALIFIERS.len())),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use simworld_core::seed::Seed;

    use super::*;

    #[test]
    fn no_name_is_given_twice() {
        let mut names = Names::new(&mut Seed(3).stream("names").rng());
        let mut seen = BTreeSet::new();
        for kind in [Kind::Highway, Kind::Avenue, Kind::Street, Kind::Lane, Kind::Close] {
            for _ in 0..20_000 {
                let name = names.next(kind);
                assert!(!seen.contains(&name), "{name} is given twice");
                seen.insert(name);
            }
        }
    }
}
