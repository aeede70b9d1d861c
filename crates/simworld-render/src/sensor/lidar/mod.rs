//! Scanners of ranges.
//!
//! A scan is drawn as up to four views of a quarter turn each, in one submission: depth, ids and normals. Each beam reads the pixel
//! that it goes through, and meets the plane of the surface there; so its range on flat surfaces is exact, on round ones to
//! the square of a pixel's angle, and at an outline it may belong to the other side by half a pixel.

mod beams;
mod cloud;
mod echo;

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use std::sync::{Arc, Mutex, PoisonError};

pub use beams::{Beam, BeamTable};
pub use cloud::{LidarPoint, PointCloud};
use nalgebra::UnitQuaternion;
use serde::{Deserialize, Serialize};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point2, Point3, Pose, Vector3};
use simworld_core::id::EntityId;
use simworld_core::ops;
use simworld_core::scene::Scene;
use simworld_core::seam::{ObserveError, Observer};
use simworld_core::seed::{Seed, Stream};

use super::CameraSensor;
use crate::classes::class_of;
use crate::{Channels, PixelFormat, RenderError, Renderer, ViewOptions, ViewRequest, Views};

/// Whether the weather takes from the beams.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LidarWeather {
    /// It does not: ranges are those of the geometry.
    #[default]
    Ignored,
    /// Fog and rain weaken echoes, and those that are too weak are lost.
    Felt,
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
    /// Whether the weather takes from the beams.
    pub weather: LidarWeather,
    /// Pixels of a quarter turn, from 64 to 8192: the finer, the nearer to an outline a beam is right.
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
    faces: Vec<Face>,
    views: Views,
}

/// A quarter turn, and the beams in it.
#[derive(Clone, Debug)]
struct Face {
    /// Sensor from the frame of the quarter.
    turned: Pose,
    intrinsics: Intrinsics,
    /// Beams with the pixel that each goes through.
    beams: Vec<(u32, u32, u32)>,
}

impl Lidar {
    /// A scanner with these beams; many sensors may share one renderer.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn new(
        renderer: Arc<Mutex<Renderer>>,
        beams: BeamTable,
        config: LidarConfig,
    ) -> Result<Self, RenderError> {
        config.validate()?;
        let faces = (0..4).filter_map(|quarter| Face::new(&beams, quarter, config.resolution)).collect();
        Ok(Self { renderer, beams, config, mount: None, faces, views: Views::new() })
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

    fn scan(
        &mut self,
        scene: &dyn Scene,
        who: EntityId,
        world_from_sensor: &Pose,
    ) -> Result<(), RenderError> {
        let requests: Vec<ViewRequest> = self
            .faces
            .iter()
            .map(|face| ViewRequest {
                hidden: Some(who),
                ..ViewRequest::from(Camera::looking_along(
                    &(world_from_sensor * face.turned),
                    face.intrinsics,
                ))
            })
            .collect();
        let channels = Channels::DEPTH | Channels::IDS | Channels::NORMALS;
        let options = ViewOptions { channels, format: PixelFormat::Full };
        let mut renderer = self.renderer.lock().unwrap_or_else(PoisonError::into_inner);
        renderer.render_views(scene, &requests, &options, &mut self.views)
    }

    /// The range at which a beam meets what is on its pixel, and the cosine of the angle there.
    fn meet(
        &self,
        face: &Face,
        pixel: (u32, u32),
        index: usize,
        rotation: &UnitQuaternion<f64>,
        beam: &Beam,
    ) -> Option<(f64, f64)> {
        let depth = f64::from(*self.views.depth.get(index)?);
        if !depth.is_finite() {
            return None;
        }
        let middle = Point2::new(f64::from(pixel.0) + 0.5, f64::from(pixel.1) + 0.5);
        let in_optical = face.intrinsics.unproject(&middle, depth);
        // The face's frame is the body's of its camera: forward, left, up.
        let in_sensor: Point3 = face.turned * Point3::new(in_optical.z, -in_optical.x, -in_optical.y);
        let normal = Vector3::from(self.views.normals.get(index)?.map(f64::from));
        let normal = rotation.inverse() * normal;
        let direction = beam.direction();
        let slant = direction.dot(&normal);
        let there = in_sensor.coords.norm();
        let range = in_sensor.coords.dot(&normal) / slant;
        // A surface that is seen edgewise has no plane to meet.
        let sound = slant.abs() > 1e-3 && (range - there).abs() < 0.2 * there;
        Some((if sound { range } else { there }, slant.abs().min(1.0)))
    }
}

impl Face {
    fn new(table: &BeamTable, quarter: u32, resolution: u32) -> Option<Self> {
        let turn = f64::from(quarter) * FRAC_PI_2;
        let focal = f64::from(resolution) * 0.5;
        let mut found: Vec<(u32, f64, f64)> = Vec::new();
        for (index, beam) in (0..).zip(table.beams()) {
            let aside = ops::atan2(ops::sin(beam.azimuth - turn), ops::cos(beam.azimuth - turn));
            // The end of one quarter is the beginning of the next.
            if (-FRAC_PI_4..FRAC_PI_4).contains(&aside) {
                let across = -ops::tan(aside) * focal;
                found.push((index, across, -ops::tan(beam.elevation) / ops::cos(aside) * focal));
            }
        }
        let (first, last) =
            found.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (.., down)| {
                (low.min(*down), high.max(*down))
            });
        if found.is_empty() {
            return None;
        }
        // A pixel to spare on each side.
        let (top, bottom) = (first.floor() - 1.0, last.floor() + 2.0);
        let intrinsics = Intrinsics {
            width: resolution + 2,
            height: (bottom - top) as u32,
            fx: focal,
            fy: focal,
            cx: focal + 1.0,
            cy: -top,
        };
        let place = |(index, across, down): (u32, f64, f64)| {
            let (x, y) = ((across + intrinsics.cx).floor(), (down + intrinsics.cy).floor());
            (
                index,
                (x.max(0.0) as u32).min(intrinsics.width - 1),
                (y.max(0.0) as u32).min(intrinsics.height - 1),
            )
        };
        let rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn);
        Some(Self {
            turned: Pose::from_parts(nalgebra::Translation3::identity(), rotation),
            intrinsics,
            beams: found.into_iter().map(place).collect(),
        })
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
        self.scan(scene, who, &out.world_from_sensor)
            .map_err(|error| ObserveError::Sensor(error.to_string()))?;
        let noise =
            Seed(self.config.seed).stream("lidar").indexed(scene.clock().tick().0).indexed(who.into());
        let mut echoes: Vec<(u32, LidarPoint)> = Vec::new();
        for (view, face) in self.faces.iter().enumerate() {
            let first = self.views.pixels(view).start;
            for (number, x, y) in &face.beams {
                let index = first + *y as usize * face.intrinsics.width as usize + *x as usize;
                let beam = self.beams.beams()[*number as usize];
                let rotation = out.world_from_sensor.rotation;
                let Some(met) = self.meet(face, (*x, *y), index, &rotation, &beam) else { continue };
                let id = self.views.ids[index];
                let echo = self.echo(scene, id, &beam, met, noise.indexed(u64::from(*number)));
                echoes.extend(echo.map(|echo| (*number, echo)));
            }
        }
        echoes.sort_unstable_by_key(|(number, _)| *number);
        out.points.clear();
        out.points.extend(echoes.into_iter().map(|(_, echo)| echo));
        Ok(())
    }
}

impl Lidar {
    fn echo(
        &self,
        scene: &dyn Scene,
        id: u32,
        beam: &Beam,
        (range, cosine): (f64, f64),
        noise: Stream,
    ) -> Option<LidarPoint> {
        let config = &self.config;
        if !(config.least_range..=config.greatest_range).contains(&range) {
            return None;
        }
        let entity = scene.entity(self.views.entity(id)?)?;
        let extinction = match config.weather {
            LidarWeather::Ignored => 0.0,
            LidarWeather::Felt => echo::extinction(&scene.environment().weather),
        };
        let intensity = echo::intensity(echo::reflectance(scene, &entity), cosine, range, extinction);
        if config.weather == LidarWeather::Felt && !echo::is_heard(intensity, range, config.greatest_range) {
            return None;
        }
        let range = if config.range_noise > 0.0 {
            noise.rng().normal(range, config.range_noise).max(0.0)
        } else {
            range
        };
        let place = beam.direction() * range;
        Some(LidarPoint {
            position: [place.x as f32, place.y as f32, place.z as f32],
            range: range as f32,
            intensity: intensity as f32,
            azimuth: beam.azimuth as f32,
            ring: beam.ring,
            class: class_of(entity.kind),
            id,
        })
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
