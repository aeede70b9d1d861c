//! What people need: the places that every city has, and their names.

use simworld_core::scene::Place;
use simworld_core::seed::StreamRng;

use super::Building;
use super::names::Names;

/// The places that every city of some size has: one of each for so many buildings, and at least so many.
const NEEDED: [(Place, usize, usize); 9] = [
    (Place::Home, 3, 8),
    (Place::Restaurant, 9, 3),
    (Place::Store, 20, 2),
    (Place::ChargingStation, 60, 1),
    (Place::RestArea, 60, 1),
    (Place::Hospital, 200, 1),
    (Place::Museum, 200, 1),
    (Place::School, 150, 1),
    (Place::Office, 30, 1),
];

/// Gives other uses to some buildings where sampling left a needed place out: people live above shops, and a surgery
/// opens in a villa. Always the use of which there is most to spare gives way.
pub(super) fn ensure(buildings: &mut [Building], rng: &mut StreamRng) {
    let total = buildings.len();
    let needed = |place: Place| {
        let rule = NEEDED.iter().find(|(other, _, _)| *other == place);
        rule.map_or(0, |(_, one_in, least)| (total / one_in).max(*least))
    };
    // The uses by themselves: a hundredth of the memory that would be read each time.
    let mut uses: Vec<Place> = buildings.iter().map(|building| building.place).collect();
    let mut counts = vec![0_usize; Place::ALL.len()];
    for place in &uses {
        counts[rank(*place)] += 1;
    }
    let mut donors: Vec<u32> = Vec::new();
    for (place, _, _) in NEEDED {
        let missing = needed(place).saturating_sub(counts[rank(place)]);
        if missing == 0 {
            continue;
        }
        let spare = |other: Place| counts[rank(other)].saturating_sub(needed(other));
        let Some((most, donor)) = Place::ALL
            .iter()
            .filter(|other| **other != place)
            .map(|other| (spare(*other), *other))
            .reduce(|best, next| if next.0 > best.0 { next } else { best })
        else {
            continue;
        };
        let given = missing.min(most);
        donors.clear();
        donors.reserve(counts[rank(donor)]);
        donors.extend((0..).zip(&uses).filter(|(_, other)| **other == donor).map(|(index, _)| index));
        rng.shuffle(&mut donors);
        for index in donors.iter().take(given).map(|index| *index as usize) {
            (buildings[index].place, uses[index]) = (place, place);
        }
        counts[rank(donor)] -= given;
        counts[rank(place)] += given;
    }
}

/// The place of a use in the list of all uses, which are in the order of declaration.
pub(super) const fn rank(place: Place) -> usize {
    place as usize
}

/// Names every place that bears a name.
pub(super) fn name(buildings: &mut [Building], rng: &mut StreamRng) {
    let mut names = Names::new(rng);
    for building in buildings {
        building.name = names.next(building.place);
    }
}
