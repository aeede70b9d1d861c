//! Names of places, drawn from word lists.

use simworld_core::scene::Place;
use simworld_core::seed::StreamRng;

use super::uses::rank;

const EPITHETS: &[&str] = &[
    "Harbour",
    "Linden",
    "Old Mill",
    "Northgate",
    "Riverside",
    "Maple",
    "Station",
    "Market",
    "Garden",
    "Castle",
    "Bridge",
    "Cedar",
    "Union",
    "Canal",
    "Meadow",
    "Foundry",
    "Orchard",
    "Lantern",
    "Copper",
    "Willow",
    "Granite",
    "Beacon",
    "Clover",
    "Juniper",
    "Sunset",
    "Chapel",
    "Quarry",
    "Heron",
    "Ivy",
    "Amber",
];

/// What a place is called after its epithet; `None` for places that bear no name.
const fn noun(place: Place) -> Option<&'static [&'static str]> {
    match place {
        Place::Restaurant => Some(&["Kitchen", "Bistro", "Grill", "Noodle House", "Table", "Diner"]),
        Place::Store => Some(&["Market", "Store", "Grocery", "Corner Shop"]),
        Place::Hospital => Some(&["Hospital", "Clinic"]),
        Place::Museum => Some(&["Museum", "Gallery"]),
        Place::School => Some(&["School", "Academy"]),
        Place::Office => Some(&["House", "Chambers", "Exchange"]),
        Place::Factory => Some(&["Works", "Warehouse"]),
        Place::ChargingStation => Some(&["Charging Station"]),
        Place::RestArea => Some(&["Pavilion", "Rest Area"]),
        _ => None,
    }
}

/// Gives out names: every one once, in an order that the seed says.
#[derive(Clone, Debug)]
pub(super) struct Names {
    /// Names given out, and where the order begins, by place.
    places: Vec<(usize, usize)>,
}

impl Names {
    pub(super) fn new(rng: &mut StreamRng) -> Self {
        Self { places: Place::ALL.iter().map(|_| (0, rng.below(EPITHETS.len() * 12))).collect() }
    }

    /// The next name of a place; a number is added when the words run out. `None` for places that bear no name.
    pub(super) fn next(&mut self, place: Place) -> Option<String> {
        let nouns = noun(place)?;
        let (given, start) = &mut self.places[rank(place)];
        let combinations = EPITHETS.len() * nouns.len();
        // Steps of a prime that divides no number of combinations visit every one once a round.
        let index = (*start + *given * STEP) % combinations;
        let round = *given / combinations;
        *given += 1;
        Some(spelled(nouns, index, round))
    }
}

/// A name for a place by itself, which nobody has: the first of some in an order that chance begins, or else the first of
/// them with a number; `None` for places that bear no name.
pub(super) fn free(place: Place, rng: &mut StreamRng, is_taken: impl Fn(&str) -> bool) -> Option<String> {
    let nouns = noun(place)?;
    let combinations = EPITHETS.len() * nouns.len();
    let start = rng.below(combinations);
    let plain = |step: usize| spelled(nouns, (start + step * STEP) % combinations, 0);
    let plain = (0..TRIED.min(combinations)).map(plain).find(|name| !is_taken(name));
    plain.or_else(|| {
        // A large city has given out thousands of numbers: by doubling, and then by halves, a free one is soon found.
        let numbered = |round: usize| spelled(nouns, start, round);
        let (mut taken, mut free) = (0, 1);
        while is_taken(&numbered(free)) {
            (taken, free) = (free, 2 * free);
        }
        while free - taken > 1 {
            let middle = taken.midpoint(free);
            if is_taken(&numbered(middle)) {
                taken = middle;
            } else {
                free = middle;
            }
        }
        Some(numbered(free))
    })
}

/// The name of that number among the combinations of some nouns, in a round after the first with its number. It takes the
/// memory that it needs, and at once: a large city has hundreds of thousands of names.
fn spelled(nouns: &[&str], index: usize, round: usize) -> String {
    let (epithet, noun) = (EPITHETS[index % EPITHETS.len()], nouns[index / EPITHETS.len()]);
    let number = round + 1;
    let digits = if round == 0 { 0 } else { 2 + number.ilog10() as usize };
    let mut name = String::with_capacity(epithet.len() + 1 + noun.len() + digits);
    name.extend([epithet, " ", noun]);
    if round > 0 {
        name.push(' ');
        push_number(&mut name, number);
    }
    name
}

/// Writes a number in digits, without the room that formatting would take for it.
fn push_number(text: &mut String, number: usize) {
    if number >= 10 {
        push_number(text, number / 10);
    }
    text.push(char::from(b'0' + (number % 10) as u8));
}

/// So many names without a number are looked at before one gets a number.
const TRIED: usize = 30;
/// Step from one name to the next; a prime greater than any number of words.
const STEP: usize = 97;

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use simworld_core::seed::Seed;

    use super::*;

    #[test]
    fn no_name_is_given_twice() {
        let mut names = Names::new(&mut Seed(3).stream("names").rng());
        let mut seen = BTreeSet::new();
        for place in Place::ALL {
            for _ in 0..1000 {
                let Some(name) = names.next(*place) else { continue };
                assert!(seen.insert(name.clone()), "{name} is given twice");
            }
        }
        assert!(seen.len() >= 8000);
    }

    #[test]
    fn a_free_name_is_found_soon_however_many_are_taken() {
        let rng = || Seed(3).stream("names").rng();
        let mut names = Names::new(&mut rng());
        let mut taken = BTreeSet::new();
        for count in [0, 1_000, 100_000] {
            while taken.len() < count {
                taken.extend(names.next(Place::Restaurant));
            }
            let looked = std::cell::Cell::new(0);
            let name = free(Place::Restaurant, &mut rng(), |name| {
                looked.set(looked.get() + 1);
                taken.contains(name)
            });
            let name = name.expect("restaurants bear names");
            assert!(!taken.contains(&name), "{name} is taken");
            assert!(looked.get() <= TRIED + 24, "looked at {} of {count}", looked.get());
        }
    }
}
