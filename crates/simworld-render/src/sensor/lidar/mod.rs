//! Scanners of ranges.
//!
//! A scan is cast as a table of rays, one for each beam, where the adapter allows that. Otherwise it is drawn as up to four views of a quarter
//! turn each, in one submission: depth, ids and normals. Each beam then reads the pixel that it goes through, and meets the plane of
//! the surface there; so its range on flat surfaces is exact, on round ones to the square of a pixel's angle, and at an
//! outline it may belong to the other side by half a pixel.

mod beams;
mod cloud;
mod echo;
mod face;
mod rays;

use std::sync::{Arc, Mutex, PoisonError};

pub use beams::{Beam, BeamTable};
pub use cloud::{LidarPoint, PointCloud};
pub(super) use echo::DARK;
use face::Face;
use rays::Rays;
use serde::{Deserialize, Serialize};
use simworld_core::geometry::Pose;
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;
use simworld_core::seam::{ObserveError, Observer};
use simworld_core::seed::{Seed, Stream};

use super::CameraSensor;
use super::drops::{Clutter, Struck};
use crate::classes::class_of;
use crate::{Backend, Channels, PixelFormat, RenderError, Renderer, ViewOptions, Views};

/// The class of what is no entity, as Cityscapes has it.
const UNLABELED: u8 = 0;

/// How beams meet what is there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LidarMethod {
    /// As [`Rays`](Self::Rays), unless the renderer is to draw by triangles alone.
    #[default]
    Auto,
    /// They read views.
    Views,
    /// They are cast as they are, where the adapter binds nine storage buffers a stage; otherwise they read views.
    Rays,
}

/// Whether the weather takes from the beams.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LidarWeather {
    /// It does not: ranges are those of the geometry.
    #[default]
    Ignored,
    /// Fog and rain weaken echoes, and those that are too weak are lost.
    Felt,
    /// As felt; and drops and flakes give echoes of their own, without an id, where they are stronger than what is behind them: by the sizes of drops after Marshall and
    /// Palmer and of flakes after Gunn and Marshall, drawn by beam, tick and wearer.
    Seen,
}

/// Settings of a [`Lidar`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LidarConfig {
    /// Nothing nearer gives an echo, m, from 0 to 100.
    pub least_range: f64,
    /// Nothing farther gives an echo, m, from `least_range` to 10000.
    pub greatest_range: f64,
    /// Standard deviation of ranges, m, from 0 to 10.
    pub range_noise: f64,
    /// How beams meet what is there.
    pub method: LidarMethod,
    /// Whether the weather takes from the beams.
    pub weather: LidarWeather,
    /// Pixels of a quarter turn where beams read views, from 64 to 8192: the finer, the nearer to an outline a beam is right.
    pub resolution: u32,
    /// Seed of the noise, which is drawn by beam, tick and wearer.
    pub seed: u64,
}

impl Default for LidarConfig {
    fn default() -> Self {
        Self {
            least_range: 0.5,
            greatest_range: 120.0,
            range_noise: 0.0,
            method: LidarMethod::Auto,
            weather: LidarWeather::Ignored,
            resolution: 1024,
            seed: 0,
        }
    }
}

impl LidarConfig {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range, with what is allowed.
    pub fn validate(&self) -> Result<(), RenderError> {
        let resolution = f64::from(self.resolution);
        let checks = [
            ("least_range", self.least_range, 0.0, 100.0, "0 to 100 m"),
            (
                "greatest_range",
                self.greatest_range,
                self.least_range,
                1e4,
                "more than `least_range`, at most 10000 m",
            ),
            ("range_noise", self.range_noise, 0.0, 10.0, "0 to 10 m"),
            ("resolution", resolution, 64.0, 8192.0, "64 to 8192 pixels"),
        ];
        match checks.into_iter().find(|(_, value, low, high, _)| !(low..=high).contains(&value)) {
            Some((field, value, .., allowed)) => Err(RenderError::Config { field, value, allowed }),
            None => Ok(()),
        }
    }
}

/// A scanner of ranges, as core's `Observer`: worn by an entity, which it does not see. Every point says whose it is and of which class.
///
/// ```no_run
/// use std::sync::{Arc, Mutex};
/// use simworld_core::geometry::{Point3, pose_facing};
/// use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
/// use simworld_core::seam::Observer;
/// use simworld_render::{BeamTable, Lidar, LidarConfig, PointCloud, RenderConfig, Renderer};
///
/// let mut world = World::new();
/// let car = world.spawn(EntityDesc::new(EntityKind::Car, pose_facing(Point3::origin(), 0.0), Shape::cuboid(4.5, 1.8, 1.5)))?;
/// let renderer = Arc::new(Mutex::new(Renderer::new(&RenderConfig::default())?));
/// let mut scanner = Lidar::new(renderer, BeamTable::rows_32(1024)?, LidarConfig::default())?;
/// let mut cloud = PointCloud::new();
/// scanner.observe(&world, car, &mut cloud)?;
/// std::fs::write("scan.npy", cloud.npy())?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Lidar {
    renderer: Arc<Mutex<Renderer>>,
    beams: BeamTable,
    config: LidarConfig,
    mount: Option<Pose>,
    means: Means,
    views: Views,
}

/// What beams are found by.
#[derive(Clone, Debug)]
enum Means {
    Views(Vec<Face>),
    Rays(Rays),
}

/// What a beam met: whose slot, how far off, at which cosine of the angle.
#[derive(Clone, Copy)]
struct Met {
    id: u32,
    range: f64,
    cosine: f64,
}

impl Lidar {
    /// A scanner with these beams; many sensors may share one renderer.
    ///
    /// # Errors
    /// A setting out of range, or a beam steeper than 60° where beams read views.
    pub fn new(
        renderer: Arc<Mutex<Renderer>>,
        beams: BeamTable,
        config: LidarConfig,
    ) -> Result<Self, RenderError> {
        config.validate()?;
        let by_rays = {
            let renderer = renderer.lock().unwrap_or_else(PoisonError::into_inner);
            renderer.casts_tables()
                && match config.method {
                    LidarMethod::Auto => renderer.config().backend != Backend::Raster,
                    LidarMethod::Views => false,
                    LidarMethod::Rays => true,
                }
        };
        let means = if by_rays {
            Means::Rays(Rays::new(&beams))
        } else {
            beams.check_views()?;
            let faces = (0..4).filter_map(|quarter| Face::new(&beams, quarter, config.resolution));
            Means::Views(faces.collect())
        };
        Ok(Self { renderer, beams, config, mount: None, means, views: Views::new() })
    }

    /// Mounted at a pose in the wearer's body frame (x forward, y left, z up), instead of 0.3 m above its top.
    #[must_use]
    pub fn mounted_at(mut self, body_from_sensor: Pose) -> Self {
        self.mount = Some(body_from_sensor);
        self
    }

    /// Its beams.
    pub fn beams(&self) -> &[Beam] {
        self.beams.beams()
    }

    /// What each beam meets.
    fn scan(
        &mut self,
        scene: &dyn Scene,
        who: EntityId,
        world_from_sensor: &Pose,
    ) -> Result<Vec<Option<Met>>, RenderError> {
        let channels = Channels::DEPTH | Channels::IDS | Channels::NORMALS;
        let options = ViewOptions { channels, format: PixelFormat::Full };
        let mut renderer = self.renderer.lock().unwrap_or_else(PoisonError::into_inner);
        let (views, beams) = (&mut self.views, self.beams.beams());
        let mut met = vec![None; beams.len()];
        match &self.means {
            Means::Rays(rays) => {
                let request = rays.request(world_from_sensor, who);
                renderer.cast(scene, &request, &rays.table, options, views)?;
                for (number, (beam, met)) in beams.iter().zip(&mut met).enumerate() {
                    let found = Rays::meet(views, number, world_from_sensor, beam);
                    *met = found.map(|(range, cosine)| Met { id: views.ids[number], range, cosine });
                }
            }
            Means::Views(faces) => {
                let requests: Vec<_> =
                    faces.iter().map(|face| face.request(world_from_sensor, who)).collect();
                renderer.render_views(scene, &requests, &options, views)?;
                let rotation = world_from_sensor.rotation;
                for (view, face) in faces.iter().enumerate() {
                    let first = views.pixels(view).start;
                    for (number, x, y) in &face.beams {
                        let index = first + *y as usize * face.intrinsics.width as usize + *x as usize;
                        let number = *number as usize;
                        let found = face.meet(views, (*x, *y), index, &rotation, &beams[number]);
                        met[number] =
                            found.map(|(range, cosine)| Met { id: views.ids[index], range, cosine });
                    }
                }
            }
        }
        Ok(met)
    }
}

impl Observer for Lidar {
    type Observation = PointCloud;

    fn observe(
        &mut self,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut PointCloud,
    ) -> Result<(), ObserveError> {
        let wearer = scene.entity(who).ok_or(ObserveError::Missing { id: who })?;
        let above = Pose::translation(0.0, 0.0, wearer.info.shape.size().z + 0.3);
        out.world_from_sensor = wearer.pose * self.mount.unwrap_or(above);
        let met = self
            .scan(scene, who, &out.world_from_sensor)
            .map_err(|error| ObserveError::Sensor(error.to_string()))?;
        let config = &self.config;
        let of = |name| Seed(config.seed).stream(name).indexed(scene.clock().tick().0).indexed(who.into());
        let (noise, falling) = (of("lidar"), of("lidar/drops"));
        let weather = &scene.environment().weather;
        let extinction = match config.weather {
            LidarWeather::Ignored => 0.0,
            LidarWeather::Felt | LidarWeather::Seen => echo::extinction(weather),
        };
        let clutter = (config.weather == LidarWeather::Seen)
            .then(|| Clutter::new(weather, config.least_range, config.greatest_range, extinction))
            .flatten();
        out.points.clear();
        for (number, (beam, met)) in (0_u64..).zip(self.beams.beams().iter().zip(met)) {
            let noise = noise.indexed(number);
            let struck = clutter.as_ref().and_then(|clutter| clutter.strike(falling.indexed(number)));
            let echo = met.and_then(|met| self.echo(scene, met, extinction));
            // Of several echoes the strongest is reported.
            let falls = struck.filter(|struck| echo.is_none_or(|(_, _, met)| struck.power() > met.power()));
            let strongest = falls.map(|struck| (UNLABELED, 0, struck)).or(echo);
            let echo = strongest.map(|(class, id, struck)| self.point(beam, class, id, struck, noise));
            out.points.extend(echo);
        }
        Ok(())
    }
}

impl Lidar {
    /// Class, instance and echo of what a beam met, if it is heard.
    fn echo(
        &self,
        scene: &dyn Scene,
        Met { id, range, cosine }: Met,
        extinction: f64,
    ) -> Option<(u8, u32, Struck)> {
        let config = &self.config;
        if !(config.least_range..=config.greatest_range).contains(&range) {
            return None;
        }
        let entity = scene.entity(self.views.entity(id)?)?;
        let intensity = echo::intensity(echo::reflectance(scene, &entity), cosine, range, extinction);
        let is_heard = config.weather == LidarWeather::Ignored
            || echo::is_heard(intensity, range, config.greatest_range);
        is_heard.then(|| (class_of(entity.kind), id, Struck { range, intensity }))
    }

    fn point(&self, beam: &Beam, class: u8, id: u32, struck: Struck, noise: Stream) -> LidarPoint {
        let Struck { range, intensity } = struck;
        let range = if self.config.range_noise > 0.0 {
            noise.rng().normal(range, self.config.range_noise).max(0.0)
        } else {
            range
        };
        let place = beam.direction() * range;
        LidarPoint {
            position: [place.x as f32, place.y as f32, place.z as f32],
            range: range as f32,
            intensity: intensity as f32,
            azimuth: beam.azimuth as f32,
            ring: beam.ring,
            class,
            id,
        }
    }
}

impl CameraSensor {
    /// A scanner that shares this camera's renderer.
    ///
    /// # Errors
    /// As [`Lidar::new`].
    pub fn lidar(&self, beams: BeamTable, config: LidarConfig) -> Result<Lidar, RenderError> {
        Lidar::new(self.renderer(), beams, config)
    }
}
