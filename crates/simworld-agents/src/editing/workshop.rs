//! Things that no catalogue has: what an editor has made for a sentence by a generator that its user chose.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use super::stock::Stock;
use crate::generation::{AssetGenerator, AssetPrompt, GenerateError, Made};
use crate::language::edits::Reading;

/// So many things that were made stay on the shelf: a sentence that failed and is said again is not waited for again.
const SHELF: usize = 16;

/// A generator that the clones of an editor share.
#[derive(Clone)]
pub(super) struct Workshop {
    bench: Arc<Mutex<Bench>>,
    seed: u64,
}

struct Bench {
    generator: Box<dyn AssetGenerator>,
    /// What was made last, by its words.
    shelf: BTreeMap<String, Made>,
}

impl fmt::Debug for Workshop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Workshop").field("seed", &self.seed).finish_non_exhaustive()
    }
}

impl Workshop {
    pub(super) fn new(generator: Box<dyn AssetGenerator>, seed: u64) -> Self {
        Self { bench: Arc::new(Mutex::new(Bench { generator, shelf: BTreeMap::new() })), seed }
    }

    /// Makes what a sentence asks for and the stock has not; says of each thing whether it was made, and what was not used of
    /// its words.
    pub(super) fn fill(&self, stock: &mut Arc<Stock>, reading: &Reading) -> Vec<String> {
        let mut notes = Vec::new();
        for (said, words) in reading.lacking(stock) {
            // A generator that broke off is asked again like any other.
            let mut bench = self.bench.lock().unwrap_or_else(PoisonError::into_inner);
            let note = match bench.make(&words, self.seed) {
                Ok(made) => {
                    let unused = match &made.unused[..] {
                        [] => String::new(),
                        unused => format!(", without {}", unused.join(", ")),
                    };
                    let (name, by) = (made.asset.called(), bench.generator.name());
                    let note = format!("generated {name} from {words:?} ({by}){unused}");
                    if Arc::make_mut(stock).keep(said, &words, made).is_err() {
                        continue;
                    }
                    note
                }
                Err(error) => format!("not generated: {error}"),
            };
            notes.push(note);
        }
        notes
    }
}

impl Bench {
    /// What words ask for, from the shelf if it stands there.
    fn make(&mut self, words: &str, seed: u64) -> Result<Made, GenerateError> {
        if let Some(made) = self.shelf.get(words) {
            return Ok(made.clone());
        }
        let made = self.generator.generate(&AssetPrompt::new(words).seeded(seed))?;
        if self.shelf.len() >= SHELF {
            self.shelf.pop_first();
        }
        self.shelf.insert(words.to_owned(), made.clone());
        Ok(made)
    }
}
