//! Rows of things one by one, what each of them stands on, and in what order they can be set down.

use std::collections::BTreeMap;

use super::error::{Fault, Problems, Where};
use super::near::spelt_like;
use super::rows::Thing;
use super::scene::SceneFile;

/// So many names that are not there are compared with those that are.
pub(super) const COMPARED: usize = 50;
/// With so many of these at the most.
const NAMES: usize = 1000;

/// One thing of a row.
pub(super) struct Item<'a> {
    pub(super) thing: &'a Thing,
    /// The row, from 0.
    pub(super) row: usize,
    /// Which of the row, from 0.
    pub(super) rank: u32,
    /// What it is called.
    pub(super) name: Option<String>,
}

/// Every thing, row by row.
pub(super) fn items(scene: &SceneFile) -> Vec<Item<'_>> {
    let rows = scene.things.iter().enumerate();
    let ranks = rows.flat_map(|(row, thing)| (0..thing.many()).map(move |rank| (row, thing, rank)));
    ranks
        .map(|(row, thing, rank)| {
            let name = match (&thing.name, thing.many()) {
                (Some(name), 1) => Some(name.clone()),
                (Some(name), _) => Some(format!("{name} {}", rank + 1)),
                (None, _) => None,
            };
            Item { thing, row, rank, name }
        })
        .collect()
}

impl Item<'_> {
    /// What it is called in messages: its row, its asset, and its name or which of the row it is.
    pub(super) fn label(&self) -> String {
        let (number, asset) = (self.row + 1, shortened(&self.thing.asset));
        match (&self.name, self.thing.many()) {
            (Some(name), _) => format!("[[thing]] {number} ({asset} {:?})", shortened(name)),
            (None, 1) => format!("[[thing]] {number} ({asset})"),
            (None, many) => format!("[[thing]] {number} ({asset}, {} of {many})", self.rank + 1),
        }
    }

    /// The same in the messages of others, with its line.
    pub(super) fn label_for_others(&self) -> String {
        let line = self.thing.line.0.map_or_else(String::new, |line| format!(" on line {line}"));
        format!("{}{line}", self.label())
    }

    /// Where it is written.
    pub(super) fn place(&self, scene: &SceneFile) -> Where {
        scene.place_of(self.thing.line.0, self.label())
    }
}

/// The beginning of what may be long.
pub(super) fn shortened(text: &str) -> String {
    const LONGEST: usize = 40;
    if text.chars().count() <= LONGEST {
        return text.to_owned();
    }
    text.chars().take(LONGEST).chain("...".chars()).collect()
}

/// What things stand on.
pub(super) struct Supports {
    /// Of each thing what it stands on, if that is a thing.
    pub(super) under: Vec<Option<usize>>,
    /// All of them, none before what it stands on.
    pub(super) order: Vec<usize>,
}

impl Supports {
    /// Finds them by their names. What is wrong with these is told; then the order is of no use.
    pub(super) fn find(scene: &SceneFile, items: &[Item<'_>], problems: &mut Problems) -> Self {
        let names = names(scene, items, problems);
        let mut compared = 0;
        let mut under = vec![None; items.len()];
        for (index, item) in items.iter().enumerate() {
            let Some(wanted) = &item.thing.on else { continue };
            under[index] = names.get(wanted.as_str()).copied();
            if under[index].is_some() {
                continue;
            }
            compared += 1;
            let known = names.keys().copied().take(if compared <= COMPARED { NAMES } else { 0 });
            let (name, near) = (shortened(wanted), spelt_like(&shortened(wanted), known));
            problems.push(item.place(scene), Fault::UnknownSupport { name, near });
        }
        let order = in_order(scene, items, &under, problems);
        Self { under, order }
    }
}

/// Things by their names; of those that share one the first, and it is told of the others.
fn names<'a>(scene: &SceneFile, items: &'a [Item<'_>], problems: &mut Problems) -> BTreeMap<&'a str, usize> {
    let mut names: BTreeMap<&str, usize> = BTreeMap::new();
    for (index, item) in items.iter().enumerate() {
        let Some(name) = item.name.as_deref() else { continue };
        if let Some(first) = names.get(name) {
            let other = items[*first].label_for_others();
            problems.push(item.place(scene), Fault::Taken { name: shortened(name), other });
        } else {
            names.insert(name, index);
        }
    }
    names
}

/// How far one has come with a thing.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Mark {
    New,
    /// What it stands on is being looked at.
    Open,
    Done,
}

/// All things, each after what it stands on; circles are told once each.
fn in_order(
    scene: &SceneFile,
    items: &[Item<'_>],
    under: &[Option<usize>],
    problems: &mut Problems,
) -> Vec<usize> {
    let mut marks = vec![Mark::New; items.len()];
    let mut order = Vec::with_capacity(items.len());
    for start in 0..items.len() {
        let mut path: Vec<usize> = Vec::new();
        let mut at = Some(start);
        while let Some(index) = at.filter(|index| marks[*index] == Mark::New) {
            marks[index] = Mark::Open;
            path.push(index);
            at = under[index];
        }
        if let Some(met) = at.filter(|index| marks[*index] == Mark::Open) {
            let circle = path.iter().skip_while(|index| **index != met);
            // Long ones are told by their first things.
            let things: Vec<String> = circle.take(8).map(|index| items[*index].label_for_others()).collect();
            problems.push(items[met].place(scene), Fault::Circle { things });
        }
        for index in path.into_iter().rev() {
            marks[index] = Mark::Done;
            order.push(index);
        }
    }
    order
}
