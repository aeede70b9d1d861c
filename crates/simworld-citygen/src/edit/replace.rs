//! What stood at streets that changed makes room for what stands there now; what comes out as it was keeps its number.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::patch::{ArrayPatch, Book};

use super::CityEditor;
use super::faces::place_key;
use super::touched::{After, Before};
use crate::building::{self, Building};
use crate::element::Element;

impl CityEditor {
    /// Puts what stands now into the place of what stood there.
    pub(super) fn replace(
        &mut self,
        before: &Before,
        after: After,
    ) -> (ArrayPatch<Building>, ArrayPatch<Element>) {
        let seed = self.city.provenance.seed;
        let names = &mut self.index.names;
        let mut buildings = Book::open(&mut self.city.buildings);
        for (number, building) in after.doors {
            *buildings.edit(number) = building;
        }
        let buildings = replaced(
            buildings,
            &Replacement { old: &before.buildings, gone: &after.buildings_gone },
            after.buildings,
            Rules {
                key: |building: &Building| place_key(building.center),
                keep: |old: &Building, new: &mut Building| {
                    (new.place, new.name) = (old.place, old.name.clone());
                    is_same(old, new)
                },
                begin: |building: &mut Building| {
                    building.place = building.archetype.place;
                    building.name = building::name_for(building, seed, |name| names.contains(name));
                    names.extend(building.name.clone());
                },
            },
        );
        let elements = Book::open(&mut self.city.elements);
        let elements = replaced(
            elements,
            &Replacement { old: &before.elements, gone: &after.elements_gone },
            after.elements,
            Rules {
                key: |element: &Element| (place_key(element.position), element.kind),
                keep: |old: &Element, new: &mut Element| Element { along: new.along, ..*old } == *new,
                begin: |_: &mut Element| {},
            },
        );
        (buildings, elements)
    }
}

/// What is replaced in an array, by number.
struct Replacement<'a> {
    old: &'a [usize],
    /// What has no room any more besides.
    gone: &'a BTreeSet<usize>,
}

/// How the new finds its place among the old.
struct Rules<Key, Keep, Begin> {
    /// Where to look for a thing.
    key: Key,
    /// Whether an old thing stays as the new one, which takes over what it has to.
    keep: Keep,
    /// What a thing gets that was not there.
    begin: Begin,
}

/// Replaces things of an array; what comes out as it was keeps its number.
fn replaced<T: Clone + PartialEq, K: Ord>(
    mut book: Book<'_, T>,
    replacement: &Replacement<'_>,
    new: Vec<T>,
    mut rules: Rules<impl Fn(&T) -> K, impl Fn(&T, &mut T) -> bool, impl FnMut(&mut T)>,
) -> ArrayPatch<T> {
    let mut there: BTreeMap<K, Vec<usize>> = BTreeMap::new();
    for number in replacement.old {
        there.entry((rules.key)(book.get(*number))).or_default().push(*number);
    }
    let mut come = Vec::new();
    for mut thing in new {
        let found = there.get_mut(&(rules.key)(&thing)).and_then(|list| {
            let rank = list.iter().position(|number| (rules.keep)(book.get(*number), &mut thing))?;
            Some(list.swap_remove(rank))
        });
        match found {
            Some(number) if *book.get(number) == thing => {}
            Some(number) => *book.edit(number) = thing,
            None => come.push(thing),
        }
    }
    for number in there.into_values().flatten().chain(replacement.gone.iter().copied()) {
        book.vacate(number);
    }
    for mut thing in come {
        (rules.begin)(&mut thing);
        book.fill(thing);
    }
    while book.close_gap().is_some() {}
    book.close()
}

/// Whether two buildings at the same place differ in nothing but their use, their name and the numbers of their road.
fn is_same(old: &Building, new: &Building) -> bool {
    let Building { place, name, road, side, given, .. } = old.clone();
    Building { place, name, road, side, given, ..new.clone() } == *old
}
