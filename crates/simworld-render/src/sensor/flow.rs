//! Optical flow: how far the surface on each pixel has come since the picture before, in pixels.
//!
//! It follows from depth, ids and poses: a pixel's point is carried back by the motion of its body and projected by the
//! camera of before. So it holds for every backend, to the precision of the depth.

use simworld_core::camera::Camera;
use simworld_core::geometry::{Point3, Pose, Vector3};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, Scene};

use crate::{Frame, RenderError};

/// Nearer than this to the plane of the camera of before, a point has no pixel there, m.
const LEAST_DEPTH: f64 = 1e-6;

/// Remembers where camera and bodies were, and writes how far every pixel has come since.
///
/// The flow of a pixel is where its point is now minus where it was, in pixels, x to the right and y down: a point seen at
/// pixel `p` was at `p - flow`. The sky moves as what is infinitely far. A point that was in the plane of the camera of before,
/// or behind it, has no flow: both numbers are NaN. Hidden or outside of the picture it may have been.
///
/// A body is carried back to the pose that it had in the picture before, or, if it was not drawn then, along its
/// velocity over the time between. What turns within a body (wheels, limbs) is carried with the body.
///
/// ```no_run
/// # fn pictures(scene: &dyn simworld_core::scene::Scene, camera: simworld_core::camera::Camera) -> Result<(), Box<dyn std::error::Error>> {
/// use simworld_render::{Frame, OpticalFlow, RenderConfig, Renderer};
///
/// let mut renderer = Renderer::new(&RenderConfig::default())?;
/// let (mut frame, mut flow) = (Frame::new(), OpticalFlow::new());
/// for _step in 0..10 {
///     // ... the world moves ...
///     renderer.render(scene, &camera, &mut frame)?;
///     flow.measure(scene, &camera, &mut frame)?;
///     let _across_and_down: [f32; 2] = frame.flow[0];
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, Default)]
pub struct OpticalFlow {
    before: Option<Moment>,
    motions: Vec<Carried>,
}

/// A picture that was taken.
#[derive(Clone, Debug)]
struct Moment {
    camera: Camera,
    seconds: f64,
    /// Ascending by id.
    poses: Vec<(EntityId, Pose)>,
}

/// From the optical frame now to the one of before, for the points of one body.
#[derive(Clone, Copy, Debug)]
struct Carried {
    turn: nalgebra::Matrix3<f64>,
    shift: Vector3,
}

impl Carried {
    fn new(before_from_now: &Pose) -> Self {
        let turn = *before_from_now.rotation.to_rotation_matrix().matrix();
        Self { turn, shift: before_from_now.translation.vector }
    }
}

impl OpticalFlow {
    /// One that has seen nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Forgets the picture before, as after a cut.
    pub fn forget(&mut self) {
        self.before = None;
    }

    /// Writes [`Frame::flow`] of a frame that this camera took of the scene as it stands, and remembers both. In the first
    /// picture nothing has moved.
    ///
    /// # Errors
    /// The frame has no depth or no ids, or is of another size than the camera.
    pub fn measure(
        &mut self,
        scene: &dyn Scene,
        camera: &Camera,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        frame.check("depth", frame.depth.len(), 1)?;
        frame.check("ids", frame.ids.len(), 1)?;
        frame.check_camera(camera)?;
        let seconds = scene.clock().seconds();
        let mut poses = Vec::with_capacity(frame.drawn.len());
        self.motions.clear();
        let before = self.before.take();
        let last = before.as_ref().map_or(*camera, |moment| moment.camera);
        let last_from_world = last.world_from_optical.inverse();
        for id in &frame.drawn {
            let Some(entity) = scene.entity(*id) else {
                self.motions.push(Carried::new(&Pose::identity()));
                continue;
            };
            let now = *entity.pose;
            let then = before.as_ref().map_or(now, |moment| moment.pose_of(&entity, seconds));
            let carried = last_from_world * then * now.inverse() * camera.world_from_optical;
            self.motions.push(Carried::new(&carried));
            poses.push((*id, now));
        }
        let of_sky = last_from_world.rotation * camera.world_from_optical.rotation;
        let sky = Carried { turn: *of_sky.to_rotation_matrix().matrix(), shift: Vector3::zeros() };
        self.write(camera, &last, &sky, frame);
        self.before = Some(Moment { camera: *camera, seconds, poses });
        Ok(())
    }

    fn write(&self, camera: &Camera, last: &Camera, sky: &Carried, frame: &mut Frame) {
        let Frame { width, depth, ids, drawn, flow, .. } = frame;
        let (k, l) = (&camera.intrinsics, &last.intrinsics);
        let mut of = (0_u32, sky);
        flow.clear();
        flow.extend(depth.iter().zip(ids.iter()).enumerate().map(|(index, (depth, id))| {
            if *id != of.0 {
                of = (*id, self.motion(*id, drawn).unwrap_or(sky));
            }
            let u = (index % *width as usize) as f64 + 0.5;
            let v = (index / *width as usize) as f64 + 0.5;
            let ray = Vector3::new((u - k.cx) / k.fx, (v - k.cy) / k.fy, 1.0);
            let depth = f64::from(*depth);
            let point =
                if depth.is_finite() { of.1.turn * (ray * depth) + of.1.shift } else { sky.turn * ray };
            if point.z < LEAST_DEPTH {
                return [f32::NAN; 2];
            }
            let then = (l.fx * point.x / point.z + l.cx, l.fy * point.y / point.z + l.cy);
            [(u - then.0) as f32, (v - then.1) as f32]
        }));
    }

    /// The motion of the entity in a slot, counted from one.
    fn motion(&self, id: u32, drawn: &[EntityId]) -> Option<&Carried> {
        let slot = (id as usize).checked_sub(1)?;
        let position = drawn.binary_search_by_key(&slot, |id| id.index()).ok()?;
        self.motions.get(position)
    }
}

impl Moment {
    /// Where the entity was then.
    fn pose_of(&self, entity: &EntityRef<'_>, seconds: f64) -> Pose {
        if let Ok(position) = self.poses.binary_search_by_key(&entity.id, |(id, _)| *id) {
            return self.poses[position].1;
        }
        let elapsed = seconds - self.seconds;
        let position: Point3 = entity.position() - entity.twist.linear * elapsed;
        let turned = nalgebra::UnitQuaternion::from_scaled_axis(entity.twist.angular * -elapsed);
        Pose::from_parts(position.into(), turned * entity.pose.rotation)
    }
}
