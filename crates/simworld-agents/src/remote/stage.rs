//! The engine as the server sees it.

use serde::{Deserialize, Serialize};
use simworld_core::camera::Camera;
use simworld_core::clock::Tick;
use simworld_core::command::{Applied, Command};
use simworld_core::event::Event;
use simworld_core::hash::StateDigest;
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;

use super::StageError;

/// What is served: a world that takes commands, steps, and may be looked at.
///
/// [`SimulationStage`](super::SimulationStage) makes one of any simulation; whoever steps a world in another way, an episode
/// with a task for example, implements this trait.
pub trait Stage {
    /// What is where now. Commands show at once, what they set moving after the next step.
    fn scene(&self) -> &dyn Scene;

    /// A count that changes whenever something came into the scene or left it.
    fn revision(&self) -> u64;

    /// Carries out a command before the next step begins, and records it.
    ///
    /// # Errors
    /// It is impossible; then nothing has changed and nothing is recorded.
    fn apply(&mut self, command: Command) -> Result<Applied, StageError>;

    /// One step.
    ///
    /// # Errors
    /// The world cannot go on; the server ends.
    fn step(&mut self) -> Result<(), StageError>;

    /// What happened in the last step, and what commands did since.
    fn events(&self) -> &[Event];

    /// The last digest that was taken, and after which step; none before the first.
    fn digest(&self) -> Option<(Tick, StateDigest)>;

    /// Draws what a camera sees.
    ///
    /// # Errors
    /// It cannot be drawn; by default, nothing can.
    fn picture(&mut self, _view: &View, _kind: PictureKind) -> Result<Picture, StageError> {
        Err(StageError::Blind)
    }
}

/// From where something is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The camera, world frame.
    pub camera: Camera,
    /// Who wears it and is not seen by it.
    pub hidden: Option<EntityId>,
}

/// What a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PictureKind {
    /// Colour: three bytes a pixel, sRGB red, green, blue.
    Color,
    /// Planar depth, the distance along the optical axis: four bytes a pixel, `f32`, m; infinity where there is nothing.
    Depth,
    /// Instances: four bytes a pixel, `u32`, the entity's index plus one; 0 where there is nothing.
    Instances,
}

impl PictureKind {
    /// Bytes of a pixel.
    pub const fn bytes_per_pixel(self) -> usize {
        match self {
            Self::Color => 3,
            Self::Depth | Self::Instances => 4,
        }
    }
}

/// A picture: rows from the top, pixels from the left, numbers little-endian.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Picture {
    /// What it shows.
    pub kind: PictureKind,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// The pixels.
    #[serde(with = "serde_bytes")]
    pub bytes: Vec<u8>,
}

impl Picture {
    /// Whether there are as many bytes as the size and the kind ask for.
    pub fn is_whole(&self) -> bool {
        let pixels = self.width as usize * self.height as usize;
        pixels > 0 && self.bytes.len() == pixels * self.kind.bytes_per_pixel()
    }

    /// The four-byte words of a picture of depth or instances, in order.
    pub fn words(&self) -> impl Iterator<Item = u32> + '_ {
        // Chunks of four have four bytes.
        self.bytes.chunks_exact(4).map(|chunk| u32::from_le_bytes([chunk[0], chunk[1], chunk[2], chunk[3]]))
    }

    /// The depths of a picture of depth, m.
    pub fn depths(&self) -> impl Iterator<Item = f32> + '_ {
        self.words().map(f32::from_bits)
    }
}
