//! How much of the land is made anew when streets change: closed faces whole, and of open ones what the change reaches.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::geometry::{Point2, bounds};

use super::cells::{Bounds, inflated};
use super::moved::{Altered, Moved};
use super::outskirts::{Outskirts, meet};
use crate::block::Border;
use crate::lot::Strip;

/// The land of a road that changed, and what was given near it, may leave other room so far from its course, m.
const REACH: f64 = 100.0;

/// The land that is made anew at one time, before a change or after it.
pub(super) struct Scope {
    pub(super) outskirts: Outskirts,
    /// The sides of streets whose land is made anew, with all that stands along them.
    pub(super) sides: BTreeSet<usize>,
    /// Those, and the sides along which something is in the way of what stands there.
    pub(super) furnished: BTreeSet<usize>,
    /// The fronts of open faces that get lots, by face and edge: those along such sides, and those that decide on them.
    pub(super) fitted: BTreeSet<(usize, usize)>,
    /// All these sides.
    pub(super) all: BTreeSet<usize>,
}

/// A front by what its lots are a function of, but for those of others: where it and its neighbours lie, and at which sides.
type Form = ([[u64; 2]; 4], [Border; 3]);

/// The faces round a change, before and after it.
pub(super) struct Change<'a> {
    pub(super) faces: [Outskirts; 2],
    pub(super) altered: &'a Altered,
    /// Round the courses of the roads that changed, as they were and as they are.
    pub(super) courses: Vec<Bounds>,
}

impl Change<'_> {
    /// What has to be made anew, before and after the change.
    pub(super) fn scopes(self) -> [Scope; 2] {
        let mut sides = self.touched();
        // What stands along sidewalks is set in their order, where there is room.
        loop {
            let spread = [0, 1].map(|time| self.faces[time].spread_walks(&sides[time], true));
            let grown = self.common(&spread);
            if grown == sides {
                break;
            }
            sides = grown;
        }
        let sides =
            self.common(&[0, 1].map(|time| &sides[time] | &parks_beside(&self.faces[time], &sides[time])));
        let mut sides = sides.into_iter();
        self.faces.map(|outskirts| Scope::of(outskirts, sides.next().unwrap_or_default()))
    }

    /// The sides whose lots may be others.
    fn touched(&self) -> [BTreeSet<usize>; 2] {
        let forms = [0, 1].map(|time| self.forms(time));
        let fresh = [0, 1].map(|time| {
            let others = &forms[1 - time];
            let fresh = forms[time].iter().filter(|(form, _)| !others.contains_key(*form));
            fresh.map(|(_, strip)| *strip).collect::<BTreeSet<usize>>()
        });
        let courses = (0..2).flat_map(|time| {
            fresh[time].iter().filter_map(move |strip| bounds(&self.faces[time].strips[*strip].1.course))
        });
        let courses: Vec<Bounds> = courses.collect();
        let reordered = self.reordered(&forms);
        self.common(&[0, 1].map(|time| {
            let faces = &self.faces[time];
            let is_reached = |(_, strip): &(usize, Strip)| {
                self.courses.iter().any(|course| meet(inflated(*course, REACH), strip.lots))
                    || courses.iter().any(|course| meet(*course, strip.view))
            };
            let reached = (0..faces.strips.len()).filter(|number| is_reached(&faces.strips[*number]));
            let first = reached.chain(fresh[time].iter().copied()).chain(reordered[time].iter().copied());
            &faces.sides_at(&faces.spread(first, true)) | &faces.closed
        }))
    }

    /// The strips of one time by their forms, in the numbers after the change.
    fn forms(&self, time: usize) -> BTreeMap<Form, usize> {
        let faces = &self.faces[time];
        let form = |number: usize| {
            let strip = &faces.strips[number];
            let course = strip.1.course.map(|at: Point2| [at.x.to_bits(), at.y.to_bits()]);
            let borders = faces.borders(strip).map(|border| match border.side() {
                Some(side) if time == 0 => Border::of_side(side_at(&self.altered.moved, 1, side)),
                _ => border,
            });
            ((course, borders), number)
        };
        (0..faces.strips.len()).map(form).collect()
    }

    /// Strips near one another that are there before and after the change, but come in another order: as long ones as each other do where
    /// the first corner of the face is another, and those of several faces.
    fn reordered(&self, forms: &[BTreeMap<Form, usize>; 2]) -> [BTreeSet<usize>; 2] {
        let pairs = forms[1].iter().filter_map(|(form, now)| Some((*now, *forms[0].get(form)?)));
        let once: BTreeMap<usize, usize> = pairs.collect();
        let faces = &self.faces[1];
        let has_several = faces.strips.windows(2).any(|pair| pair[0].0 != pair[1].0);
        let is_as_long = |one: usize, other: Option<usize>| {
            let length = |number: usize| faces.strips.get(number).map(|(_, strip)| strip.length);
            other.is_some_and(|other| length(one) == length(other))
        };
        let mut reordered = [BTreeSet::new(), BTreeSet::new()];
        for (now, before) in &once {
            if !has_several && !is_as_long(*now, Some(now + 1)) && !is_as_long(*now, now.checked_sub(1)) {
                continue;
            }
            for other in faces.strips_in(faces.strips[*now].1.lots) {
                let Some(other_before) = once.get(&other) else { continue };
                if (other > *now) != (other_before > before) {
                    reordered[0].insert(*before);
                    reordered[1].insert(*now);
                }
            }
        }
        reordered
    }

    /// What is touched at one time is at the other as well, as long as its road is there.
    fn common(&self, sides: &[BTreeSet<usize>; 2]) -> [BTreeSet<usize>; 2] {
        let moved = &self.altered.moved;
        [0, 1].map(|time| {
            let (here, there) = (&self.altered.roads[time], &self.altered.roads[1 - time]);
            let faces = &self.faces[time];
            let known = |side: &usize| faces.open.contains(side) || faces.closed.contains(side);
            let as_it_was = sides[1 - time].iter().filter(|side| !there.contains(&(**side / 2)));
            let as_it_was = as_it_was.map(|side| side_at(moved, time, *side)).filter(known);
            let own = here.iter().flat_map(|road| [2 * road, 2 * road + 1]).filter(known);
            sides[time].iter().copied().chain(as_it_was).chain(own).collect()
        })
    }
}

impl Scope {
    fn of(outskirts: Outskirts, sides: BTreeSet<usize>) -> Self {
        let on_lots = outskirts.sides_at(&outskirts.strips_along(&sides).collect());
        let furnished = outskirts.spread_walks(&(&sides | &on_lots), false);
        let strips = outskirts.spread(outskirts.strips_at(&furnished), false);
        let fitted = strips.iter().map(|number| &outskirts.strips[*number]);
        let (fitted, along): (BTreeSet<(usize, usize)>, BTreeSet<usize>) =
            fitted.map(|(block, strip)| ((*block, strip.edge), strip.side)).unzip();
        let all = &furnished | &along;
        Self { outskirts, sides, furnished, fitted, all }
    }
}

/// The sides of parks of open land that things along some sides may stand in: there trees have no room then.
fn parks_beside(faces: &Outskirts, sides: &BTreeSet<usize>) -> BTreeSet<usize> {
    let strips = faces.strips_at(sides).into_iter().map(|number| &faces.strips[number].1);
    strips.filter(|strip| !strip.is_built).map(|strip| strip.side).collect()
}

/// The number of a side at one time by that at the other; for one that did not change.
fn side_at(moved: &Moved, time: usize, other: usize) -> usize {
    2 * moved.number_at(time, other / 2) + other % 2
}

#[cfg(test)]
mod tests {
    use simworld_core::seed::Seed;

    use super::super::CityEditor;
    use super::super::streets::with_neighbours;
    use crate::graph::StreetId;
    use crate::{City, CityConfig, Style};

    #[test]
    fn a_street_at_the_edge_has_a_part_of_the_outskirts_made_anew() {
        let config = CityConfig { roads: Style::Mixed.roads(3000), ..CityConfig::default() };
        let city = City::generate(&config, Seed(3)).expect("presets are valid");
        let beyond = |road: &usize| city.network.roads[*road].centerline[0].coords.norm();
        let mut roads: Vec<usize> = (0..city.network.roads.len()).collect();
        roads.sort_by(|a, b| beyond(b).total_cmp(&beyond(a)));
        let mut editor = CityEditor::new(city.clone());
        let (mut tried, mut most) = (0, 0.0_f64);
        for gone in roads.into_iter().take(12) {
            let part = editor.city.plan.part(with_neighbours(&editor.city.network, [gone].into()));
            let local = StreetId(part.street(gone).expect("it is one of its part") as u32);
            let changed = editor.change_streets(part, |graph| graph.remove_street(local), None);
            let Ok(changed) = changed else { continue };
            let altered = editor.altered(&changed.network);
            let plan = changed.plan.put_on(&mut editor.city.plan).expect("it was taken from there");
            let (network, [before, after]) =
                editor.scopes(changed.network, &altered).expect("it was taken from there");
            // As it was, and nothing of it is to be done.
            drop((plan, network));
            assert!(editor.city == city, "{gone}");
            for scope in [before, after] {
                let open = scope.outskirts.open.len();
                if open > 100 {
                    assert!(scope.sides.is_subset(&scope.furnished) && scope.furnished.is_subset(&scope.all));
                    most = most.max(scope.all.len() as f64 / open as f64);
                    tried += 1;
                }
            }
        }
        assert!(tried >= 10 && most < 0.5, "{tried} times, at most {most} of the outskirts");
    }
}
