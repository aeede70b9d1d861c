//! Edits read by a model: what the words may mean is looked for first, so that the schema holds few ids and few assets.

mod answer;
mod bearings;
mod places;
mod recall;
mod shape;
mod ways;
mod written;
mod written_places;

use std::sync::Arc;

use super::prompts::{Prompt, Prompts, one_line};
use super::reasoner::{ModelReasoner, Question, ReasonError, Reasoner};
use crate::editing::{Asked, Edit, EditError, EditReader};
use crate::model::ChatModel;

pub(crate) use recall::Recalled;
pub use written::EditAnswer;

/// The tokens that things, assets and streets may take in a prompt, where nothing else is said.
const BUDGET: usize = 2500;
/// The longest sentence that a model is shown, characters.
const LONGEST: usize = 2000;

/// Reads sentences by a language model as the same [`Edit`]s that the grammar yields: over the things that the words may mean,
/// by a schema made for them alone, checked and repaired once.
///
/// ```
/// use simworld_agents::editing::{ReadBy, SceneEditor};
/// use simworld_agents::model::Scripted;
/// use simworld_agents::thought::ModelReader;
/// use simworld_core::geometry::{Point3, pose_facing};
/// use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
/// use simworld_core::seed::Seed;
///
/// let mut world = World::new();
/// let pose = pose_facing(Point3::origin(), 0.0);
/// let bench = world.spawn(EntityDesc::new(EntityKind::Bench, pose, Shape::cuboid(0.6, 1.8, 0.85)))?;
/// let answer = r##"{"cannot": "", "edits": [{"do": "paint", "things": ["#0"], "color": "red"}]}"##;
/// let model = Scripted::texts([answer]);
/// let mut editor = SceneEditor::new(Seed(1)).with_reader(ModelReader::new(Box::new(model)));
/// let done = editor.say("the bench would blush if it could, wouldn't it", &mut world)?;
/// assert_eq!(done.read_by, ReadBy::Reader);
/// assert!(world.entity(bench).unwrap().info.color.is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct ModelReader {
    reasoner: Box<dyn Reasoner>,
    prompts: Arc<Prompts>,
    budget: usize,
}

impl ModelReader {
    /// Asks this model with the prompts that come with the crate.
    pub fn new(model: Box<dyn ChatModel>) -> Self {
        Self::with_prompts(model, Arc::new(Prompts::standard()))
    }

    /// Asks this model with prompts of one's own.
    pub fn with_prompts(model: Box<dyn ChatModel>, prompts: Arc<Prompts>) -> Self {
        let reasoner = ModelReasoner::new(model).with_prompts(Arc::clone(&prompts));
        Self::with_reasoner(Box::new(reasoner), prompts)
    }

    /// Asks any reasoner.
    pub fn with_reasoner(reasoner: Box<dyn Reasoner>, prompts: Arc<Prompts>) -> Self {
        Self { reasoner, prompts, budget: BUDGET }
    }

    /// With so many tokens for things, assets and streets in a prompt, at least 100.
    #[must_use]
    pub fn with_budget(mut self, tokens: usize) -> Self {
        self.budget = tokens.max(100);
        self
    }

    fn question(&self, asked: &Asked<'_>, known: &Recalled) -> Result<Question, ReasonError> {
        let words: String = asked.words.chars().take(LONGEST).collect();
        let [things, assets, streets, junctions] = known.texts();
        let spoken = asked.it.map_or_else(|| "nothing".to_owned(), |it| it.to_string());
        let user = [
            ("things", &*things),
            ("assets", &assets),
            ("streets", &streets),
            ("junctions", &junctions),
            ("spoken", &spoken),
            ("request", &one_line(&words)),
        ];
        Ok(Question {
            system: self.prompts.render(Prompt::Editor, &[])?,
            user: self.prompts.render(Prompt::Edit, &user)?,
            images: Vec::new(),
            name: "edits",
            schema: shape::schema(known, shape::MOST_EDITS),
        })
    }
}

impl EditReader for ModelReader {
    fn read(&mut self, asked: &Asked<'_>) -> Result<Vec<Edit>, EditError> {
        let failed = |fault: String| EditError::Reader { words: asked.words.to_owned(), fault };
        let known = Recalled::of(asked, self.budget);
        let question = self.question(asked, &known).map_err(|error| failed(error.to_string()))?;
        let mut outcome = None;
        let reasoned = self.reasoner.reason(&question, &mut |answer| {
            outcome = Some(answer::understood(answer, &known, asked)?);
            Ok(())
        });
        match (reasoned, outcome) {
            (Ok(_), Some(outcome)) => outcome,
            (Ok(_), None) => Err(failed("the reasoner did not have its answer checked".to_owned())),
            (Err(error), _) => Err(failed(error.to_string())),
        }
    }
}
