//! Whole scenes read by a model: the spec's own fields as a schema, bounded and checked like those of the grammar.

mod answer;
mod shape;
mod written;

use std::sync::Arc;

use super::prompts::{Prompt, Prompts, one_line};
use super::reasoner::{ModelReasoner, Question, ReasonError, Reasoner};
use crate::model::ChatModel;
use crate::scenes::{SceneError, SceneReader, SceneReading};

pub use written::scene_answer;

/// Reads what a scene is to be by a language model.
///
/// ```
/// use simworld_agents::model::Scripted;
/// use simworld_agents::scenes::SceneReader;
/// use simworld_agents::thought::ModelSceneReader;
/// let answer = r#"{"cannot": "", "kind": "city", "title": "", "streets": 0, "pattern": "winding", "width": "narrow", "trees": "usual",
///     "parked": "none", "buildings": 40, "height": "low", "places": [], "landmarks": [{"name": "lighthouse", "count": 1}],
///     "squares": ["Fish Market"], "parks": [], "waters": ["harbour"], "sites": [{"what": "lighthouse", "at": "anywhere", "by": "harbour"}],
///     "districts": [{"kind": "industrial", "at": "east", "by": ""}], "sky": ["light rain", "fog"], "minutes": 1140, "unread": []}"#;
/// let mut reader = ModelSceneReader::new(Box::new(Scripted::texts([answer])));
/// let reading = reader.read_scene("somewhere a smuggler would feel at home")?;
/// assert_eq!(reading.spec.buildings.count, Some(40));
/// assert_eq!(reading.spec.environment.weather.rain, 2.0);
/// # Ok::<(), simworld_agents::scenes::SceneError>(())
/// ```
pub struct ModelSceneReader {
    reasoner: Box<dyn Reasoner>,
    prompts: Arc<Prompts>,
}

impl ModelSceneReader {
    /// Asks this model with the prompts that come with the crate.
    pub fn new(model: Box<dyn ChatModel>) -> Self {
        let prompts = Arc::new(Prompts::standard());
        let reasoner = ModelReasoner::new(model).with_prompts(Arc::clone(&prompts));
        Self::with_reasoner(Box::new(reasoner), prompts)
    }

    /// Asks any reasoner.
    pub fn with_reasoner(reasoner: Box<dyn Reasoner>, prompts: Arc<Prompts>) -> Self {
        Self { reasoner, prompts }
    }

    fn question(&self, said: &str) -> Result<Question, ReasonError> {
        let shown: String = said.chars().take(2000).collect();
        Ok(Question {
            system: self.prompts.render(Prompt::Scene, &[])?,
            user: self.prompts.render(Prompt::Wish, &[("request", &one_line(&shown))])?,
            images: Vec::new(),
            name: "scene",
            schema: shape::schema(),
        })
    }
}

impl SceneReader for ModelSceneReader {
    fn read_scene(&mut self, said: &str) -> Result<SceneReading, SceneError> {
        let failed = |fault: String| SceneError::Model { words: said.to_owned(), fault };
        let question = self.question(said).map_err(|error| failed(error.to_string()))?;
        let mut outcome = None;
        let reasoned = self.reasoner.reason(&question, &mut |given| {
            outcome = Some(answer::understood(given, said)?);
            Ok(())
        });
        match (reasoned, outcome) {
            (Ok(_), Some(outcome)) => outcome,
            (Ok(_), None) => Err(failed("the reasoner did not have its answer checked".to_owned())),
            (Err(error), _) => Err(failed(error.to_string())),
        }
    }
}
