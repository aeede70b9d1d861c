//! An embedder that an editor was given: it is asked what words mean where the words themselves find nothing for sure.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use simworld_core::asset::{Asset, Catalogue};

use super::embed::{EmbedError, Embedder, Embeddings};
use super::index::{AssetIndex, Choice};

/// So many answers are kept: one sentence asks the same several times, as it is read in several ways.
const KEPT: usize = 256;

/// An embedder with the vectors of one catalogue, which are made when they are needed first.
#[derive(Clone)]
pub(crate) struct Meaning {
    embedder: Arc<Mutex<dyn Embedder + Send>>,
    known: Arc<Mutex<Known>>,
}

#[derive(Default)]
struct Known {
    embeddings: Option<Embeddings>,
    /// What words were said to mean.
    chosen: BTreeMap<String, Choice>,
}

impl fmt::Debug for Meaning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an embedder")
    }
}

impl Meaning {
    pub(crate) fn new(embedder: impl Embedder + Send + 'static) -> Self {
        Self { embedder: Arc::new(Mutex::new(embedder)), known: Arc::default() }
    }

    /// The same embedder for another catalogue.
    pub(crate) fn anew(&self) -> Self {
        Self { embedder: Arc::clone(&self.embedder), known: Arc::default() }
    }

    /// The same embedder for the catalogue with one more asset at its end.
    pub(crate) fn grown(&self, asset: &Asset) -> Self {
        let mut embeddings = lock(&self.known).embeddings.clone();
        let fails = |own: &mut Embeddings| own.add(asset, &mut *lock(&self.embedder)).is_err();
        if embeddings.as_mut().is_some_and(fails) {
            // They are made anew when they are needed, or whoever needs them hears why not.
            embeddings = None;
        }
        let known = Known { embeddings, chosen: BTreeMap::new() };
        Self { embedder: Arc::clone(&self.embedder), known: Arc::new(Mutex::new(known)) }
    }

    /// What words mean, by themselves or else by what they are near to.
    pub(crate) fn choose(
        &self,
        words: &str,
        index: &AssetIndex,
        catalogue: &Catalogue,
    ) -> Result<Choice, EmbedError> {
        let mut known = lock(&self.known);
        if let Some(choice) = known.chosen.get(words) {
            return Ok(choice.clone());
        }
        let mut embedder = lock(&self.embedder);
        let embeddings = match known.embeddings.take() {
            Some(embeddings) => embeddings,
            None => Embeddings::of(catalogue, &mut *embedder)?,
        };
        let choice = index.choose_with(words, &embeddings, &mut *embedder);
        known.embeddings = Some(embeddings);
        let choice = choice?;
        if known.chosen.len() >= KEPT {
            known.chosen.clear();
        }
        known.chosen.insert(words.to_owned(), choice.clone());
        Ok(choice)
    }
}

/// An embedder that panicked once may answer the next question.
fn lock<T: ?Sized>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
