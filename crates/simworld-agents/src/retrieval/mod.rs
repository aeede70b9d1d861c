//! Assets found by words: "a wooden thing to sit on in a park" among ten thousand.
//!
//! [`AssetIndex`] ranks the assets of a catalogue by BM25 over their names, tags, kinds, uses and materials, with plurals,
//! synonyms and a table of words that say nothing. An [`Embedder`] adds a ranking by meaning where one is at hand; the two are
//! fused by rank. Everything is a function of the catalogue and the words.
//!
//! ```
//! use simworld_agents::retrieval::AssetIndex;
//! use simworld_core::asset::Catalogue;
//! let catalogue = Catalogue::library();
//! let index = AssetIndex::of(&catalogue);
//! let hits = index.retrieve("a sofa", 3);
//! assert_eq!(hits[0].name, "couch");
//! assert!(index.retrieve("dragon", 3).is_empty());
//! ```

mod embed;
mod index;
mod meaning;
mod query;
mod words;

pub use embed::{EmbedError, Embedder, Embeddings};
pub use index::{AssetIndex, Choice, Hit, Matched};
pub(crate) use meaning::Meaning;
pub(crate) use words::{is_synonym, telling};
