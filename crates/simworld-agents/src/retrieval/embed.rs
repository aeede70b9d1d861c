//! Ranking by meaning, where somebody brings vectors.

use thiserror::Error;

use super::AssetIndex;
use super::index::{Choice, Hit};
use simworld_core::asset::{Asset, Catalogue};

/// Why texts have no vectors.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EmbedError {
    /// The embedder failed.
    #[error("the embedder gives no vector for {text:?}: {why}")]
    Failed {
        /// For which text.
        text: String,
        /// Why not.
        why: String,
    },
    /// A vector is none.
    #[error(
        "the vector of {text:?} has {length} numbers, or one that is not finite: give {expected} finite ones"
    )]
    Vector {
        /// Of which text.
        text: String,
        /// How many it has.
        length: usize,
        /// How many the others have.
        expected: usize,
    },
}

/// Gives texts vectors, near each other where they mean the same: a model of one's own, or a server.
pub trait Embedder {
    /// The vector of a text; all have one length, at least one number.
    ///
    /// # Errors
    /// The embedder has none.
    fn embed(&mut self, text: &str) -> Result<Vec<f32>, EmbedError>;

    /// From which cosine on two of its vectors mean the same; models differ in it.
    fn least_likeness(&self) -> f64 {
        0.75
    }
}

impl<E: Embedder + ?Sized> Embedder for Box<E> {
    fn embed(&mut self, text: &str) -> Result<Vec<f32>, EmbedError> {
        (**self).embed(text)
    }

    fn least_likeness(&self) -> f64 {
        (**self).least_likeness()
    }
}

/// The vectors of the assets of one catalogue, made once.
#[derive(Clone, Debug, PartialEq)]
pub struct Embeddings {
    length: usize,
    vectors: Vec<Vec<f32>>,
}

/// How much the rank counts where two rankings are fused (Cormack, Clarke, Buettcher, SIGIR 2009).
const FUSION: f64 = 60.0;
/// As many of a ranking take part.
const DEEP: usize = 50;
/// So much nearer in its cosine than the next is what is surely meant.
const CLEARLY: f64 = 0.03;
/// So many are named where nothing is sure.
const NAMED: usize = 3;

impl Embeddings {
    /// Embeds every asset by its name, tags, kind and use.
    ///
    /// # Errors
    /// The embedder fails, or its vectors are none.
    pub fn of(catalogue: &Catalogue, embedder: &mut dyn Embedder) -> Result<Self, EmbedError> {
        let mut own = Self { length: 0, vectors: Vec::with_capacity(catalogue.len()) };
        for (_, asset) in catalogue.iter() {
            own.add(asset, embedder)?;
        }
        Ok(own)
    }

    /// Embeds one more asset, that which comes next in the catalogue.
    ///
    /// # Errors
    /// As [`Embeddings::of`]; then none was added.
    pub fn add(&mut self, asset: &Asset, embedder: &mut dyn Embedder) -> Result<(), EmbedError> {
        let text = described(asset);
        let vector = embedder.embed(&text)?;
        if self.vectors.is_empty() {
            self.length = vector.len();
        }
        let vector = self.checked(&text, vector)?;
        self.vectors.push(vector);
        Ok(())
    }

    fn checked(&self, text: &str, vector: Vec<f32>) -> Result<Vec<f32>, EmbedError> {
        let is_sound =
            !vector.is_empty() && vector.len() == self.length && vector.iter().all(|x| x.is_finite());
        if is_sound {
            return Ok(vector);
        }
        Err(EmbedError::Vector { text: text.to_owned(), length: vector.len(), expected: self.length.max(1) })
    }

    /// The assets with the cosine between their vectors and one, the nearest first; of equal ones the first.
    fn ranked(&self, vector: &[f32]) -> Vec<(f64, usize)> {
        let dot =
            |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(x, y)| f64::from(*x) * f64::from(*y)).sum::<f64>();
        let norm = |a: &[f32]| dot(a, a).sqrt().max(1e-12);
        let of_query = norm(vector);
        let cosine = |own: &Vec<f32>| dot(own, vector) / (norm(own) * of_query);
        let mut ranked: Vec<(f64, usize)> =
            self.vectors.iter().enumerate().map(|(index, own)| (cosine(own), index)).collect();
        ranked.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        ranked.truncate(DEEP);
        ranked
    }
}

impl AssetIndex {
    /// As [`AssetIndex::retrieve`], with the ranking by meaning fused in by reciprocal ranks; scores are those of the fusion.
    ///
    /// # Errors
    /// The embedder fails, or its vector is none.
    pub fn retrieve_with(
        &self,
        words: &str,
        k: usize,
        embeddings: &Embeddings,
        embedder: &mut dyn Embedder,
    ) -> Result<Vec<Hit>, EmbedError> {
        let vector = embeddings.checked(words, embedder.embed(words)?)?;
        Ok(self.fused(words, k, &embeddings.ranked(&vector)))
    }

    /// What words mean: as [`AssetIndex::choose`] where that is sure, and else the asset that is nearest in meaning, if it is near
    /// ([`Embedder::least_likeness`]) and no other is nearly as near.
    ///
    /// # Errors
    /// As [`AssetIndex::retrieve_with`].
    pub fn choose_with(
        &self,
        words: &str,
        embeddings: &Embeddings,
        embedder: &mut dyn Embedder,
    ) -> Result<Choice, EmbedError> {
        let by_words = self.choose(words);
        if matches!(by_words, Choice::Sure(_)) {
            return Ok(by_words);
        }
        let vector = embeddings.checked(words, embedder.embed(words)?)?;
        let ranked = embeddings.ranked(&vector);
        let is_sure = match ranked[..] {
            [] => false,
            [(only, _)] => only >= embedder.least_likeness(),
            [(first, _), (second, _), ..] => first >= embedder.least_likeness() && first - second >= CLEARLY,
        };
        let meant =
            ranked.first().filter(|_| is_sure).and_then(|(cosine, index)| self.by_meaning(*index, *cosine));
        Ok(meant.map_or_else(|| Choice::Unsure(self.fused(words, NAMED, &ranked)), Choice::Sure))
    }

    /// The ranking by words and one by meaning in one, by reciprocal ranks.
    fn fused(&self, words: &str, k: usize, by_meaning: &[(f64, usize)]) -> Vec<Hit> {
        let by_words = self.retrieve(words, DEEP);
        let share = |rank: usize| 1.0 / (FUSION + rank as f64 + 1.0);
        let mut fused: Vec<Hit> =
            by_words.into_iter().enumerate().map(|(rank, hit)| Hit { score: share(rank), ..hit }).collect();
        for (rank, (_, index)) in by_meaning.iter().enumerate() {
            match fused.iter_mut().find(|hit| hit.asset.index() == *index) {
                Some(hit) => hit.score += share(rank),
                None => fused.extend(self.by_meaning(*index, share(rank))),
            }
        }
        fused.sort_by(|a, b| b.score.total_cmp(&a.score).then(a.asset.cmp(&b.asset)));
        fused.truncate(k);
        fused
    }
}

/// An asset in a few words.
fn described(asset: &Asset) -> String {
    let place = asset.place.map_or("", simworld_core::scene::Place::as_str);
    let words = [asset.name.as_str(), asset.kind.as_str(), place]
        .into_iter()
        .chain(asset.tags.iter().map(String::as_str));
    let words: Vec<String> =
        words.filter(|word| !word.is_empty()).map(|word| word.replace('_', " ")).collect();
    words.join(", ")
}
