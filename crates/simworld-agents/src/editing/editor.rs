//! The scene agent: words or typed edits to commands that take effect at once, with undo, redo and reasons.

use std::sync::Arc;

use simworld_core::asset::Catalogue;
use simworld_core::geometry::Point2;
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;
use simworld_core::seed::Seed;

use super::apply::{Applier, Edited, Memory};
use super::astray::Astray;
use super::edit::Edit;
use super::editable::{Editable, change_all};
use super::error::EditError;
use super::history::History;
use super::land::Streets;
use super::placing::Placing;
use super::reader::{Asked, EditReader, ReadBy, Shared, is_open};
use super::row::tell;
use super::stock::Stock;
use super::taken::Taken;
use super::workshop::Workshop;
use crate::generation::AssetGenerator;
use crate::language::AmbiguityPolicy;
use crate::language::edits::{self, Focus, Reading};
use crate::language::streets::StreetNames;
use crate::retrieval::{Embedder, Meaning};

/// Edits a scene by words. What it does follows from its seed, its words and the scene alone.
///
/// ```
/// use simworld_agents::editing::SceneEditor;
/// use simworld_core::geometry::{Point3, pose_facing};
/// use simworld_core::scene::{EntityDesc, EntityKind, Place, Scene, Shape, World};
/// use simworld_core::seed::Seed;
///
/// let mut world = World::new();
/// let house = |x, place| {
///     let pose = pose_facing(Point3::new(x, 0.0, 0.0), 0.0);
///     EntityDesc::new(EntityKind::Building, pose, Shape::cuboid(12.0, 12.0, 9.0)).used_as(place)
/// };
/// for (x, place) in [(0.0, Place::Hospital), (300.0, Place::Hospital), (325.0, Place::Museum)] {
///     world.spawn(house(x, place))?;
/// }
///
/// let mut editor = SceneEditor::new(Seed(7));
/// let done = editor.say("add a red sports car next to the hospital near a museum", &mut world)?;
/// let car = world.entity(done.made[0]).unwrap();
/// assert_eq!(car.kind, EntityKind::Car);
/// assert!((car.position().x - 300.0).abs() < 20.0, "it stands by the hospital that is near a museum");
///
/// editor.undo(&mut world)?;
/// assert_eq!(world.len(), 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct SceneEditor {
    seed: Seed,
    stock: Arc<Stock>,
    workshop: Option<Workshop>,
    focus: Focus,
    history: History,
    streets: Option<Streets>,
    /// How many things were put somewhere: each draws from a stream of its own.
    placed: u64,
    last: Vec<Placing>,
    reader: Option<Shared>,
    /// What is done where several things fit.
    policy: AmbiguityPolicy,
}

impl SceneEditor {
    /// An editor with the library of the crate that looks at the scene from its origin. Where several things fit it asks which is
    /// meant.
    pub fn new(seed: Seed) -> Self {
        Self {
            seed,
            stock: Arc::new(Stock::new(Catalogue::library())),
            workshop: None,
            focus: Focus {
                from: Point2::origin(),
                who: None,
                beside: None,
                made: Vec::new(),
                it: None,
                place: None,
                left: Vec::new(),
                roads: Vec::new(),
                streets: Arc::default(),
                any_of: false,
            },
            history: History::default(),
            streets: None,
            placed: 0,
            last: Vec::new(),
            reader: None,
            policy: AmbiguityPolicy::Ask,
        }
    }

    /// With other things to add.
    #[must_use]
    pub fn with_catalogue(mut self, catalogue: Catalogue) -> Self {
        self.stock = Arc::new(Stock::new(catalogue).with_meaning(self.stock.meaning_anew()));
        self
    }

    /// With an embedder that is asked what words mean by which nothing of the catalogue is surely found: "a vessel" may then be a
    /// boat. The catalogue is embedded when that is needed first.
    #[must_use]
    pub fn with_embedder(mut self, embedder: impl Embedder + Send + 'static) -> Self {
        let stock = Stock::clone(&self.stock);
        self.stock = Arc::new(stock.with_meaning(Some(Meaning::new(embedder))));
        self
    }

    /// Treats what is ambiguous so: asks which is meant and changes nothing, which is the default, or takes one of those that fit
    /// and says which ([`Edited::taken`]). A sentence that is clear as it stands means the same under every policy.
    ///
    /// ```
    /// use simworld_agents::editing::{EditError, SceneEditor};
    /// use simworld_agents::language::AmbiguityPolicy;
    /// use simworld_core::geometry::{Point3, pose_facing};
    /// use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
    /// use simworld_core::seed::Seed;
    ///
    /// let mut world = World::new();
    /// let mut bench = |x: f64| {
    ///     let pose = pose_facing(Point3::new(x, 0.0, 0.0), 0.0);
    ///     world.spawn(EntityDesc::new(EntityKind::Bench, pose, Shape::cuboid(0.6, 1.8, 0.85)))
    /// };
    /// let (_far, near) = (bench(20.0)?, bench(8.0)?);
    /// let asked = SceneEditor::new(Seed(7)).say("remove the bench", &mut world);
    /// assert!(matches!(asked, Err(EditError::Ambiguous { candidates, .. }) if candidates.len() == 2));
    ///
    /// let mut editor = SceneEditor::new(Seed(7)).with_policy(AmbiguityPolicy::Nearest);
    /// let done = editor.say("remove the bench", &mut world)?;
    /// assert_eq!(done.taken[0].thing, near);
    /// assert_eq!(world.len(), 1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_policy(mut self, policy: AmbiguityPolicy) -> Self {
        self.policy = policy;
        self
    }

    /// With a generator that makes what no asset of the catalogue is; the answer then says so. A recorded run replays without
    /// it, for the command that adds an asset carries it.
    #[must_use]
    pub fn with_generator(mut self, generator: impl AssetGenerator + 'static) -> Self {
        self.workshop = Some(Workshop::new(Box::new(generator), self.seed.0));
        self
    }

    /// Looks at the scene from a point of the plane: "here", and what "the nearest" is the nearest to.
    #[must_use]
    pub fn looking_from(mut self, point: Point2) -> Self {
        self.focus.from = point;
        self
    }

    /// Looks at the scene as somebody in it, who is no part of what is edited.
    #[must_use]
    pub fn looking_as(mut self, who: EntityId, scene: &dyn Scene) -> Self {
        self.focus.from = scene.entity(who).map_or(self.focus.from, |me| me.planar());
        self.focus.who = Some(who);
        self
    }

    /// Asks this reader what the grammar does not understand, or has no thing for: a model
    /// ([`ModelReader`](crate::thought::ModelReader)), or rules of one's own. What the grammar understands and refuses stays refused.
    #[must_use]
    pub fn with_reader(mut self, reader: impl EditReader + 'static) -> Self {
        self.reader = Some(Shared::new(reader));
        self
    }

    /// What can be added.
    pub fn catalogue(&self) -> &Catalogue {
        &self.stock.catalogue
    }

    /// What was tried for the things that were put somewhere last, also where none fitted.
    pub fn last_placings(&self) -> &[Placing] {
        &self.last
    }

    /// Carries out a sentence: all of it, or nothing.
    ///
    /// # Errors
    /// What is not understood, not there, open, or impossible; then the scene is as it was.
    pub fn say(&mut self, words: &str, scene: &mut dyn Editable) -> Result<Edited, EditError> {
        let refused = match (self.say_by_grammar(words, scene), &self.reader) {
            (Err(error), Some(_)) if is_open(&error) => error,
            (settled, _) => return settled,
        };
        let Some(reader) = self.reader.clone() else { return Err(refused) };
        let (from, who, it) = (self.focus.from, self.focus.who, self.focus.it);
        let edits = reader.read(&Asked {
            words,
            scene: scene.world(),
            catalogue: &self.stock.catalogue,
            from,
            who,
            it,
        })?;
        let mut edited = self.carry_out_all(words.to_owned(), &edits, scene)?;
        edited.read_by = ReadBy::Reader;
        Ok(edited)
    }

    fn say_by_grammar(&mut self, words: &str, scene: &mut dyn Editable) -> Result<Edited, EditError> {
        self.learn_streets(scene.world());
        let reading = self.read(words, scene.world())?;
        let (stock, policy) = (Arc::clone(&self.stock), self.policy);
        let notes = self.workshop.as_ref().map_or_else(Vec::new, |shop| shop.fill(&mut self.stock, &reading));
        let mut applier = self.applier(scene);
        let outcome =
            (0..reading.len()).try_for_each(|index| carry_out(&reading, index, policy, &mut applier));
        let (mut edited, back, memory) = applier.finish(outcome.is_ok());
        self.remember(memory);
        if let Err(error) = outcome {
            // What was made for a sentence that came to nothing can be made again, and is no part of the catalogue.
            self.stock = stock;
            return Err(error.noting(&notes));
        }
        let told = edited.taken.iter().map(Taken::told).chain(edited.astray.iter().map(Astray::told));
        let said: Vec<String> = edited.answer.take().into_iter().chain(told).chain(notes).collect();
        edited.answer = (!said.is_empty()).then(|| said.join("; "));
        self.history.push(words.to_owned(), back);
        Ok(edited)
    }

    /// Reads a sentence. Two things that are named with an "or" are asked about only where the policy is to ask.
    fn read(&self, words: &str, scene: &dyn Scene) -> Result<Reading, EditError> {
        let read = edits::read(words, scene, &self.stock, &self.focus);
        if self.policy != AmbiguityPolicy::Ask && matches!(read, Err(EditError::Ambiguous { .. })) {
            let focus = Focus { any_of: true, ..self.focus.clone() };
            return edits::read(words, scene, &self.stock, &focus);
        }
        read
    }

    /// Carries out edits that somebody else worked out: all of them, or none. What one of them makes those after it call
    /// [`Edit::made`].
    ///
    /// # Errors
    /// What is not there, or impossible; then the scene is as it was.
    pub fn edit(&mut self, edits: &[Edit], scene: &mut dyn Editable) -> Result<Edited, EditError> {
        self.carry_out_all(format!("{} edits", edits.len()), edits, scene)
    }

    fn carry_out_all(
        &mut self,
        what: String,
        edits: &[Edit],
        scene: &mut dyn Editable,
    ) -> Result<Edited, EditError> {
        let mut applier = self.applier(scene);
        let outcome = edits.iter().try_for_each(|edit| -> Result<(), EditError> {
            let edit = edit.with_made(&applier.edited.made)?;
            applier.apply(&edit)?;
            applier.edited.edits.push(edit);
            Ok(())
        });
        let (mut edited, back, memory) = applier.finish(outcome.is_ok());
        self.remember(memory);
        outcome?;
        for astray in &edited.astray {
            tell(&mut edited.answer, &astray.told());
        }
        self.history.push(what, back);
        Ok(edited)
    }

    /// Takes the last sentence back; gives what it was, or nothing if there is none.
    ///
    /// # Errors
    /// The world has changed since in a way that forbids it; then nothing changes, and the sentence can no longer be taken
    /// back.
    pub fn undo(&mut self, scene: &mut dyn Editable) -> Result<Option<String>, EditError> {
        let Some(done) = self.history.last_done() else { return Ok(None) };
        let again = change_all(scene, &done.back)?;
        self.history.took_back(done.what.clone(), again);
        Ok(Some(done.what))
    }

    /// Does again what was taken back last; gives what it was, or nothing if there is none.
    ///
    /// # Errors
    /// As [`SceneEditor::undo`].
    pub fn redo(&mut self, scene: &mut dyn Editable) -> Result<Option<String>, EditError> {
        let Some(undone) = self.history.last_undone() else { return Ok(None) };
        let back = change_all(scene, &undone.back)?;
        self.history.did_again(undone.what.clone(), back);
        Ok(Some(undone.what))
    }

    /// Keeps the names of the streets, which are gathered once.
    fn learn_streets(&mut self, scene: &dyn Scene) {
        if !self.focus.streets.is_of(scene.roads()) {
            self.focus.streets = Arc::new(StreetNames::of(scene.roads()));
        }
    }

    fn applier<'a>(&'a mut self, scene: &'a mut dyn Editable) -> Applier<'a> {
        let roads = scene.world().roads();
        if !matches!((&self.streets, roads), (Some(streets), Some(roads)) if streets.is_of(roads)) {
            self.streets = roads.map(Streets::of);
        }
        Applier {
            scene,
            stock: &self.stock,
            streets: self.streets.as_ref(),
            stream: self.seed.stream("agents/editing"),
            placed: self.placed,
            focus: self.focus.clone(),
            edited: Edited::default(),
            back: Vec::new(),
            tried: Vec::new(),
        }
    }

    fn remember(&mut self, memory: Memory) {
        if let Some(focus) = memory.focus {
            self.focus = focus;
        }
        self.placed = memory.placed;
        self.last = memory.tried;
    }
}

/// Works out one wish of a sentence in the scene as it is by now, and carries it out.
fn carry_out(
    reading: &Reading,
    index: usize,
    policy: AmbiguityPolicy,
    applier: &mut Applier<'_>,
) -> Result<(), EditError> {
    let focus = applier.focus.clone();
    let made_before = applier.edited.made.len();
    let (edits, taken) = reading.resolve(index, applier.scene.world(), applier.stock, &focus, policy)?;
    applier.edited.taken.extend(taken);
    for edit in edits {
        applier.apply(&edit)?;
        if matches!(edit, Edit::Move { .. } | Edit::Remove { .. } | Edit::Swap { .. }) {
            applier.focus.made.clear();
        }
        applier.edited.edits.push(edit);
    }
    if applier.edited.made.len() > made_before {
        applier.focus.made = applier.edited.made[made_before..].to_vec();
    }
    Ok(())
}
