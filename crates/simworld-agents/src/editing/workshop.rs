//! Things that no catalogue has: what an editor has made for a sentence by a generator that its user chose.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use super::stock::Stock;
use crate::generation::{AssetGenerator, AssetPrompt};
use crate::language::edits::Reading;

/// A generator that the clones of an editor share.
#[derive(Clone)]
pub(super) struct Workshop {
    generator: Arc<Mutex<Box<dyn AssetGenerator>>>,
    seed: u64,
}

impl fmt::Debug for Workshop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Workshop").field("seed", &self.seed).finish_non_exhaustive()
    }
}

impl Workshop {
    pub(super) fn new(generator: Box<dyn AssetGenerator>, seed: u64) -> Self {
        Self { generator: Arc::new(Mutex::new(generator)), seed }
    }

    /// Makes what a sentence asks for and the stock has not; says of each thing whether it was made, and what was not used of
    /// its words.
    pub(super) fn fill(&self, stock: &mut Arc<Stock>, reading: &Reading) -> Vec<String> {
        let mut notes = Vec::new();
        for (text, words) in reading.lacking(stock) {
            // A generator that broke off is asked again like any other.
            let mut generator = self.generator.lock().unwrap_or_else(PoisonError::into_inner);
            let prompt = AssetPrompt::new(words.as_str()).seeded(self.seed);
            let note = match generator.generate(&prompt) {
                Ok(made) => {
                    let name = made.asset.name.clone();
                    if Arc::make_mut(stock).keep(text, made.asset).is_err() {
                        continue;
                    }
                    let unused = match &made.unused[..] {
                        [] => String::new(),
                        unused => format!(", without {}", unused.join(", ")),
                    };
                    format!("generated {name} from {words:?} ({}){unused}", generator.name())
                }
                Err(error) => format!("not generated: {error}"),
            };
            notes.push(note);
        }
        notes
    }
}
