//! A model where one can see it: on a lawn beside a person, from all sides, in what it does.

use std::path::{Path, PathBuf};

use simworld_core::asset::{Asset, Rig};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::scene::{CLIP, EntityDesc, EntityKind, Scene, Shape, World};
use simworld_render::{Frame, RenderConfig, RenderError, Renderer};
use thiserror::Error;

use crate::look::Sheet;
use crate::view::{Canvas, Film, FilmError};

/// Pixels of a picture.
const SIZE: [u32; 2] = [480, 360];
/// Pictures a second of the film, and moments on the sheet.
const RATE: f64 = 12.0;
const MOMENTS: usize = 6;
/// How large the model may be where the person beside it is still seen, m.
const LARGE: f64 = 60.0;

/// Why a model cannot be shown.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ShowError {
    /// It has no such clip.
    #[error("it has no clip {name:?}: give one of {clips:?}")]
    Clip {
        /// What was asked for.
        name: String,
        /// What it has.
        clips: Vec<String>,
    },
    /// Nothing can be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// A file cannot be written.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// The world does not take it.
    #[error("the model cannot be put into a world: {0}")]
    World(String),
}

/// What became of it.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The pictures that were written.
    pub files: Vec<PathBuf>,
    /// What is played; none if it stands still.
    pub clip: Option<String>,
    /// How long, s.
    pub seconds: f64,
}

/// Draws an asset into a folder: a sheet of moments and a film. It plays the named clip, or what it plays by itself.
///
/// # Errors
/// It has no such clip, no adapter is there, or a file cannot be written.
pub fn show(asset: &Asset, clip: Option<&str>, out: &Path) -> Result<Shown, ShowError> {
    let rig = asset.model.as_ref().and_then(|model| model.rig.as_ref());
    let names = |rig: &Rig| rig.clips().iter().map(|clip| clip.name.clone()).collect();
    let wanted = clip.map(|name| {
        let found = rig.and_then(|rig| Some(rig.clips()[rig.clip(name)?].clone()));
        found
            .ok_or_else(|| ShowError::Clip { name: name.to_owned(), clips: rig.map_or_else(Vec::new, names) })
    });
    let played = wanted.transpose()?.or_else(|| rig.and_then(|rig| rig.clips().first().cloned()));
    let seconds = played.as_ref().map_or(6.0, |clip| clip.seconds().clamp(1.0, 20.0));
    let mut world = stage(asset, played.as_ref().map(|clip| clip.name.as_str()))?;
    let mut renderer = Renderer::new(&RenderConfig::default())?;
    let [width, height] = SIZE.map(|side| side as usize);
    let (mut sheet, mut canvas, mut frame) = (Sheet::new(3, width, height), Canvas::default(), Frame::new());
    let film_path = out.join("model.gif");
    let mut film = Film::gif(&film_path, 1.0 / RATE);
    let pictures = (seconds * RATE).round().max(1.0) as usize;
    for picture in 0..pictures {
        let share = picture as f64 / pictures as f64;
        while world.clock().seconds() < share * seconds - 1e-9 {
            world.finish_step();
        }
        renderer.render(&world, &camera(asset, share)?, &mut frame)?;
        canvas.load(width, height, &frame.rgb);
        film.take(&canvas)?;
        // The first picture of each sixth of the time.
        let sixth = |picture: usize| picture * MOMENTS / pictures;
        if picture == 0 || sixth(picture) != sixth(picture - 1) {
            sheet.add(&format!("{:.1} s", share * seconds), &frame.rgb);
        }
    }
    film.finish()?;
    let (wide, high, rgb) = sheet.draw();
    let mut whole = Frame::new();
    (whole.width, whole.height, whole.rgb) = (wide as u32, high as u32, rgb);
    let sheet_path = out.join("model.png");
    whole.write_png(&sheet_path)?;
    Ok(Shown { files: vec![sheet_path, film_path], clip: played.map(|clip| clip.name), seconds })
}

fn stage(asset: &Asset, clip: Option<&str>) -> Result<World, ShowError> {
    let failed = |error: &dyn std::fmt::Display| ShowError::World(error.to_string());
    let mut world = World::new();
    let size = asset.collider.size();
    let lawn = Shape::cuboid(400.0, 400.0, 0.1);
    let mut put = |kind, at: [f64; 3], shape| {
        let desc = EntityDesc::new(kind, pose_facing(Point3::from(at), 0.0), shape);
        world.spawn(desc).map_err(|error| failed(&error))
    };
    put(EntityKind::Ground, [0.0, 0.0, -0.1], lawn)?;
    if size.norm() < LARGE {
        let beside = size.y * 0.5 + 0.8;
        put(EntityKind::Person, [0.0, beside, 0.0], Shape::Capsule { radius: 0.25, height: 1.75 })?;
    }
    let id = world.add_asset(asset.clone()).map_err(|error| failed(&error))?;
    let mut desc = asset.at(id, pose_facing(Point3::origin(), 0.0));
    if let Some(clip) = clip {
        desc = desc.with(CLIP, clip);
    }
    world.spawn(desc).map_err(|error| failed(&error))?;
    Ok(world)
}

/// A camera that goes a third of the way around it, all of what it may do in sight.
fn camera(asset: &Asset, share: f64) -> Result<Camera, ShowError> {
    let size = asset.collider.size();
    let rig = asset.model.as_ref().and_then(|model| model.rig.as_ref());
    let reach = rig.map_or(0.0, |rig| {
        let [low, high] = rig.bounds();
        (0..3).map(|axis| f64::from(high[axis] - low[axis])).fold(0.0, f64::max)
    });
    let far = (0.9 * size.norm().max(reach)).max(2.5) + 1.2;
    let (sine, cosine) = simworld_core::ops::sin_cos(-0.9 + 1.2 * share);
    let eye = Point3::new(far * cosine, far * sine, 0.35 * far + 0.3);
    let middle = Point3::new(0.0, 0.0, size.z * 0.5);
    let intrinsics =
        Intrinsics::from_fov(SIZE[0], SIZE[1], 1.0).map_err(|error| ShowError::World(error.to_string()))?;
    Ok(Camera::looking_at(eye, middle, intrinsics))
}
