//! Minds and planners that think with a language or vision model.
//!
//! Everything here asks a [`Reasoner`] a [`Question`] with a schema that is made for this body and what it knows, and checks
//! the answer against that schema, whatever the server made of it. What others wrote or said stands in the prompts as
//! data; the schema is made without it, so no text in the world changes what an agent can do. An answer that cannot be used
//! is shown to the model once more with what is wrong, and is then a typed error: it never becomes "do nothing".

mod checks;
mod courier;
mod editing;
mod eyes;
mod known;
mod memory;
mod menu;
mod mood;
mod persona;
mod planner;
mod prompts;
mod react;
mod reasoner;
mod relevance;
mod scenes;
pub mod schema;
mod unsayable;

pub use courier::{CourierConfig, CourierConfigError, ModelCourier, Thinking, Waking};
pub use editing::{EditAnswer, ModelReader};
pub use eyes::{VisualConfig, VisualConfigError, VisualExecutor};
pub use known::{Sight, ViewConfig, ViewConfigError};
pub use memory::{Memory, MemoryConfig, MemoryConfigError, Record, RecordKind, RingMemory};
pub use mood::{MentalState, Mood};
pub use persona::{Character, Persona};
pub use planner::{Answered, Fallback, ModelPlanner};
pub use prompts::{Prompt, PromptError, Prompts};
pub use react::{Ending, ReactConfig, ReactConfigError, ReactMind, Turn};
pub use reasoner::{ModelReasoner, Question, ReasonError, Reasoner};
pub use scenes::{ModelSceneReader, scene_answer};
pub use unsayable::Unsayable;
