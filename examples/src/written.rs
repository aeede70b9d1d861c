//! Scenes that are written by hand, as the examples load them: with what comes with simworld, and the city generator for their places.

use std::path::Path;

use simworld_agents::editing::SceneEditor;
use simworld_agents::scenes::file::{Loaded, SceneFile, SceneFileError};
use simworld_core::clock::Clock;
use simworld_core::seed::Seed;

use crate::places::Generated;

/// A scene file, and the world that it says.
#[derive(Debug)]
pub struct Written {
    /// The file.
    pub scene: SceneFile,
    /// What it was loaded as.
    pub loaded: Loaded,
}

impl Written {
    /// Reads a file and loads it, in a world with that clock.
    ///
    /// # Errors
    /// A file that cannot be read, is no scene, or asks for what cannot be, with the file, the line, the row and how to mend it.
    pub fn read(path: &Path, clock: Clock) -> Result<Self, SceneFileError> {
        Self::of(SceneFile::read(path)?, clock)
    }

    /// Loads a scene that was read, in a world with that clock.
    ///
    /// # Errors
    /// The scene asks for what cannot be.
    pub fn of(scene: SceneFile, clock: Clock) -> Result<Self, SceneFileError> {
        let editor = SceneEditor::new(Seed(scene.seed));
        Self::with(scene, clock, editor)
    }

    /// As [`of`](Self::of), with an editor of one's own: its catalogue, its reader, its generator.
    ///
    /// # Errors
    /// As [`of`](Self::of).
    pub fn with(scene: SceneFile, clock: Clock, editor: SceneEditor) -> Result<Self, SceneFileError> {
        let loaded = scene.load_by(clock, editor, &mut Generated)?;
        Ok(Self { scene, loaded })
    }

    /// Tells what was loaded and what its sentences answered; and on the error stream what is wrong with how its things stand, which stand
    /// so all the same.
    pub fn tell(&self) {
        let Self { scene, loaded } = self;
        if !loaded.problems.is_empty() {
            eprintln!("{}", loaded.problems);
        }
        let title = scene.title.as_deref().unwrap_or("the scene");
        let things = loaded.things.iter().map(Vec::len).sum::<usize>();
        println!("{title}: {things} things, {} sentences", loaded.said.len());
        for answer in loaded.said.iter().filter_map(|edited| edited.answer.as_ref()) {
            println!("  {answer}");
        }
    }
}
