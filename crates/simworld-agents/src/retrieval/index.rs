//! The index: BM25 over the words of assets, and how sure a hit is.

use std::collections::BTreeMap;

use simworld_core::asset::{Asset, Catalogue};
use simworld_core::id::AssetId;
use simworld_core::ops;
use simworld_core::scene::Place;

use super::query::{Term, readings};
use super::words::stems;

/// How soon a word that comes again counts no more, and how much long descriptions are held against an asset (Robertson and
/// Zaragoza, The Probabilistic Relevance Framework, 2009).
const K1: f64 = 1.2;
const B: f64 = 0.5;
/// What a word counts by where it stands.
const NAME: f64 = 3.0;
const TAG: f64 = 2.0;
const KIND: f64 = 1.0;
/// What the word that names the thing counts, over the others.
const HEAD: f64 = 1.6;
/// What a name counts that is all that is said.
const WHOLE: f64 = 2.0;
/// What a reading with synonyms counts, over one as said.
const RENAMED: f64 = 0.97;
/// As many hits are looked at for one that is sure.
const CONSIDERED: usize = 12;
/// So much better than the next is a hit that is sure.
const CLEAR: f64 = 1.15;

/// Where a word of a query was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Matched {
    /// Among the words of its kind, use or material.
    Kind,
    /// Among its tags.
    Tag,
    /// In its name.
    Name,
    /// In what it means, as an embedder sees it.
    Meaning,
}

/// An asset that words may mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Hit {
    /// Its id in the catalogue.
    pub asset: AssetId,
    /// Its name.
    pub name: String,
    /// How well it fits; greater is better, and only comparable within one answer.
    pub score: f64,
    /// Why: the words that fit, as stems, and where they stand.
    pub because: Vec<(String, Matched)>,
    /// Whether every word that says something fits, and the one that names the thing is one of its name or tags.
    pub is_whole: bool,
}

/// What words mean, if one thing.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Choice {
    /// This, and nothing else nearly as well.
    Sure(Hit),
    /// One of these perhaps, the best first; none if nothing is near.
    Unsure(Vec<Hit>),
}

/// The words of a catalogue, for many questions. It knows the assets that there were when it was built.
#[derive(Clone, Debug, PartialEq)]
pub struct AssetIndex {
    names: Vec<String>,
    /// The weighted number of words of each asset, over the mean.
    lengths: Vec<f64>,
    /// How many words the name of each asset has.
    name_lengths: Vec<usize>,
    /// By the stem: which assets have it, with its weighted count and the best place where it stands.
    postings: BTreeMap<String, Vec<Posting>>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Posting {
    asset: u32,
    count: f64,
    place: Matched,
}

/// What an asset has of a query so far.
#[derive(Clone, Copy, Default)]
struct Tally {
    score: f64,
    words: u32,
    of_name: u32,
    has_head: bool,
}

impl AssetIndex {
    /// The index of a catalogue.
    pub fn of(catalogue: &Catalogue) -> Self {
        let mut index = Self {
            names: Vec::new(),
            lengths: Vec::new(),
            name_lengths: Vec::new(),
            postings: BTreeMap::new(),
        };
        for (id, asset) in catalogue.iter() {
            index.add(id, asset);
        }
        let mean = index.lengths.iter().sum::<f64>() / index.lengths.len().max(1) as f64;
        for length in &mut index.lengths {
            *length /= mean.max(1e-9);
        }
        index
    }

    /// The number of assets.
    pub fn len(&self) -> usize {
        self.names.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.names.is_empty()
    }

    /// The assets that fit words best, at most `k`, the best first; of equally good ones the one that was added first. Nothing, if no
    /// word of them is known.
    pub fn retrieve(&self, words: &str, k: usize) -> Vec<Hit> {
        let readings = readings(words);
        let mut best: BTreeMap<u32, (f64, usize, Tally)> = BTreeMap::new();
        for (rank, terms) in readings.iter().enumerate() {
            for (asset, tally) in self.tallied(terms) {
                let share = if rank == 0 { 1.0 } else { RENAMED };
                let score = tally.score * share;
                let entry = best.entry(asset).or_insert((score, rank, tally));
                if score > entry.0 {
                    *entry = (score, rank, tally);
                }
            }
        }
        let mut ranked: Vec<(u32, (f64, usize, Tally))> = best.into_iter().collect();
        let order = |a: &(u32, (f64, usize, Tally)), b: &(u32, (f64, usize, Tally))| {
            b.1.0.total_cmp(&a.1.0).then(a.0.cmp(&b.0))
        };
        if ranked.len() > k && k > 0 {
            ranked.select_nth_unstable_by(k - 1, order);
        }
        ranked.truncate(k);
        ranked.sort_unstable_by(order);
        ranked
            .into_iter()
            .map(|(asset, (score, rank, tally))| self.hit(asset, score, &readings[rank], tally))
            .collect()
    }

    /// What words mean: sure, if one hit fits wholly and no other does nearly as well; else at most three that are near.
    pub fn choose(&self, words: &str) -> Choice {
        let mut hits = self.retrieve(words, CONSIDERED);
        let mut whole = hits.iter().filter(|hit| hit.is_whole);
        let sure = match (whole.next(), whole.next()) {
            (Some(first), Some(second)) if first.score > second.score * CLEAR => Some(first.clone()),
            (Some(only), None) => Some(only.clone()),
            _ => None,
        };
        hits.truncate(3);
        sure.map_or(Choice::Unsure(hits), Choice::Sure)
    }

    pub(super) fn by_meaning(&self, index: usize, score: f64) -> Option<Hit> {
        let name = self.names.get(index)?.clone();
        let because = vec![(name.clone(), Matched::Meaning)];
        Some(Hit { asset: AssetId::from_index(index), name, score, because, is_whole: false })
    }

    fn add(&mut self, id: AssetId, asset: &Asset) {
        let mut counts: BTreeMap<String, (f64, Matched)> = BTreeMap::new();
        let mut put = |text: &str, weight: f64, place: Matched| {
            for stem in stems(&text.replace('_', " ")) {
                let entry = counts.entry(stem).or_insert((0.0, place));
                entry.0 += weight;
                entry.1 = entry.1.max(place);
            }
        };
        put(&asset.name, NAME, Matched::Name);
        asset.tags.iter().for_each(|tag| put(tag, TAG, Matched::Tag));
        put(asset.kind.as_str(), KIND, Matched::Kind);
        put(asset.place.map_or("", Place::as_str), KIND, Matched::Kind);
        let made_of = asset.material.map_or("", simworld_core::asset::Material::as_str);
        put(made_of, KIND, Matched::Kind);
        if made_of == "wood" {
            put("wooden", KIND, Matched::Kind);
        }
        self.name_lengths.push(stems(&asset.name.replace('_', " ")).len());
        self.names.push(asset.name.clone());
        self.lengths.push(counts.values().map(|(count, _)| count).sum());
        for (stem, (count, place)) in counts {
            let posting = Posting { asset: id.index() as u32, count, place };
            self.postings.entry(stem).or_default().push(posting);
        }
    }

    /// What every asset that has one of the words has of them, by ascending asset.
    fn tallied(&self, terms: &[Term]) -> impl Iterator<Item = (u32, Tally)> {
        let mut tallies = vec![Tally::default(); self.names.len()];
        for term in terms {
            let Some(postings) = self.postings.get(&term.stem) else { continue };
            let (all, having) = (self.names.len() as f64, postings.len() as f64);
            let rarity = ops::ln(1.0 + (all - having + 0.5) / (having + 0.5));
            let weight = rarity * term.weight * if term.is_head { HEAD } else { 1.0 };
            for posting in postings {
                let tally = &mut tallies[posting.asset as usize];
                let drag = K1 * (1.0 - B + B * self.lengths[posting.asset as usize]);
                tally.score += weight * posting.count * (K1 + 1.0) / (posting.count + drag);
                tally.words += 1;
                tally.of_name += u32::from(posting.place == Matched::Name);
                tally.has_head |= term.is_head && posting.place != Matched::Kind;
            }
        }
        for (tally, length) in tallies.iter_mut().zip(&self.name_lengths) {
            if tally.of_name as usize == terms.len() && terms.len() == *length {
                tally.score *= WHOLE;
            }
        }
        let touched = |(asset, tally): (usize, Tally)| (tally.words > 0).then_some((asset as u32, tally));
        tallies.into_iter().enumerate().filter_map(touched)
    }

    fn hit(&self, asset: u32, score: f64, terms: &[Term], tally: Tally) -> Hit {
        let found = |term: &Term| {
            let postings = self.postings.get(&term.stem)?;
            let at = postings.binary_search_by_key(&asset, |posting| posting.asset).ok()?;
            Some((term.stem.clone(), postings[at].place))
        };
        Hit {
            asset: AssetId::from_index(asset as usize),
            name: self.names[asset as usize].clone(),
            score,
            because: terms.iter().filter_map(found).collect(),
            is_whole: tally.words as usize == terms.len() && tally.has_head,
        }
    }
}
