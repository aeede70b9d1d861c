//! Boxes around bodies: on the picture and in space, with what hides them.

use std::ops::ControlFlow;
use std::sync::PoisonError;

use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Aabb, Obb, Vector3};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Scene};
use simworld_core::seam::{ObserveError, Observer};

use super::CameraSensor;
use super::outline::{Extent, extent_of, extent_of_box, grown};
use crate::{Channels, Frame, PixelFormat, RenderError, Renderer, ViewOptions, ViewRequest, Views};

/// A rectangle of whole pixels; the ends are the first beyond it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelBox {
    /// The first column.
    pub left: u32,
    /// The first row.
    pub top: u32,
    /// The first column to the right of it.
    pub right: u32,
    /// The first row below it.
    pub bottom: u32,
}

impl PixelBox {
    /// Pixels across.
    pub const fn width(&self) -> u32 {
        self.right - self.left
    }

    /// Pixels down.
    pub const fn height(&self) -> u32 {
        self.bottom - self.top
    }

    fn around(found: Option<Self>, x: u32, y: u32) -> Self {
        let pixel = Self { left: x, top: y, right: x + 1, bottom: y + 1 };
        found.map_or(pixel, |found| found.union(&pixel))
    }

    fn union(&self, other: &Self) -> Self {
        Self {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }

    /// The whole pixels around a rectangle, as far as they are on the picture.
    fn clipped(extent: &Extent, intrinsics: &Intrinsics) -> Option<Self> {
        let [left, top, right, bottom] = *extent;
        let (width, height) = (f64::from(intrinsics.width), f64::from(intrinsics.height));
        let clipped = Self {
            left: left.floor().clamp(0.0, width) as u32,
            top: top.floor().clamp(0.0, height) as u32,
            right: right.ceil().clamp(0.0, width) as u32,
            bottom: bottom.ceil().clamp(0.0, height) as u32,
        };
        (clipped.left < clipped.right && clipped.top < clipped.bottom).then_some(clipped)
    }
}

/// The boxes of one entity.
#[derive(Clone, Debug, PartialEq)]
pub struct EntityBox {
    /// Whose.
    pub id: EntityId,
    /// What it is.
    pub kind: EntityKind,
    /// Tightly around its visible pixels; `None` if there are none.
    pub visible: Option<PixelBox>,
    /// Around the projection of its whole solid, hidden or not, clipped to the picture; `None` beside the picture. What is drawn beyond
    /// a solid (the crown of a tree, the arm of a lamp) counts for [`visible`](Self::visible) alone.
    pub amodal: Option<PixelBox>,
    /// The same before it was clipped, pixels: left, top, right, bottom. What lies behind the near plane is cut off there.
    pub projected: Option<[f64; 4]>,
    /// The solid's box in the world frame.
    pub world: Obb,
    /// The same box in the optical frame (x right, y down, z forward).
    pub optical: Obb,
    /// Pixels on which it is seen.
    pub visible_pixels: u32,
    /// Pixels on which it would be seen if it were alone; `None` where that was not asked for.
    pub alone_pixels: Option<u32>,
    /// The share of its projection's rectangle that lies beside the picture, from 0 (whole) to 1.
    pub truncation: f64,
}

impl EntityBox {
    /// The share of its pixels that others hide, from 0 (in full view) to 1 (hidden): one minus visible pixels over pixels if it were
    /// alone; `None` if these were not asked for, or there are none.
    pub fn occlusion(&self) -> Option<f64> {
        let alone = self.alone_pixels.filter(|pixels| *pixels > 0)?;
        Some((1.0 - f64::from(self.visible_pixels) / f64::from(alone)).clamp(0.0, 1.0))
    }
}

/// The boxes of those entities on a frame that this camera took of the scene as it stands, in the order in which they were asked for; ids
/// that nobody has are left out. With a renderer, each that may be on the picture is also drawn alone, cropped to where it is, which
/// says how much of it is hidden.
///
/// `near` is [`RenderConfig::near`](crate::RenderConfig::near).
///
/// # Errors
/// The frame has no ids or is of another size than the camera; and as [`Renderer::render`].
pub fn boxes_of(
    scene: &dyn Scene,
    camera: &Camera,
    frame: &Frame,
    ids: &[EntityId],
    near: f64,
    alone: Option<&mut Renderer>,
) -> Result<Vec<EntityBox>, RenderError> {
    frame.check("ids", frame.ids.len(), 1)?;
    frame.check_camera(camera)?;
    let optical_from_world = camera.world_from_optical.inverse();
    let entities = ids.iter().filter_map(|id| scene.entity(*id));
    let mut boxes: Vec<EntityBox> = entities
        .map(|entity| {
            let (world, projected) = (entity.obb(), extent_of(&entity, camera, near));
            EntityBox {
                id: entity.id,
                kind: entity.kind,
                visible: None,
                amodal: projected.and_then(|extent| PixelBox::clipped(&extent, &camera.intrinsics)),
                projected,
                world,
                optical: Obb { pose: optical_from_world * world.pose, ..world },
                visible_pixels: 0,
                alone_pixels: None,
                truncation: projected.map_or(1.0, |extent| truncation(&extent, &camera.intrinsics)),
            }
        })
        .collect();
    count(frame, &mut boxes);
    if let Some(renderer) = alone {
        count_alone(renderer, scene, camera, &mut boxes, near)?;
    }
    Ok(boxes)
}

/// Counts the visible pixels of all in one pass.
fn count(frame: &Frame, boxes: &mut [EntityBox]) {
    // A slot may belong to somebody else than the one that was asked for.
    let drawn = |id: &EntityId| frame.drawn.binary_search(id).is_ok();
    let mut slots: Vec<(u32, usize)> = boxes
        .iter()
        .enumerate()
        .filter(|(_, found)| drawn(&found.id))
        .map(|(at, found)| (found.id.index() as u32 + 1, at))
        .collect();
    slots.sort_unstable();
    let mut last = (0_u32, None);
    for (index, id) in frame.ids.iter().enumerate() {
        if *id != last.0 {
            last = (*id, slots.binary_search_by_key(id, |(slot, _)| *slot).ok().map(|at| slots[at].1));
        }
        let Some(at) = last.1 else { continue };
        let (x, y) = (index % frame.width as usize, index / frame.width as usize);
        boxes[at].visible = Some(PixelBox::around(boxes[at].visible, x as u32, y as u32));
        boxes[at].visible_pixels += 1;
    }
}

fn truncation(extent: &Extent, intrinsics: &Intrinsics) -> f64 {
    let [left, top, right, bottom] = *extent;
    let within = |low: f64, high: f64, size: u32| (high.min(f64::from(size)) - low.max(0.0)).max(0.0);
    let whole = (right - left) * (bottom - top);
    let shown = within(left, right, intrinsics.width) * within(top, bottom, intrinsics.height);
    if whole > 0.0 { (1.0 - shown / whole).clamp(0.0, 1.0) } else { 0.0 }
}

/// How far a silhouette may reach beyond its solid, m.
fn overhang(kind: EntityKind, height: f64) -> f64 {
    match kind {
        EntityKind::Tree => 0.8 * height,
        EntityKind::StreetLamp | EntityKind::TrafficSignal | EntityKind::Sign => 3.0,
        _ => 0.7,
    }
}

/// Draws each entity without the others, where it can be on the picture, all in one submission.
fn count_alone(
    renderer: &mut Renderer,
    scene: &dyn Scene,
    camera: &Camera,
    boxes: &mut [EntityBox],
    near: f64,
) -> Result<(), RenderError> {
    let (mut requests, mut whose) = (Vec::new(), Vec::new());
    for (index, found) in boxes.iter_mut().enumerate() {
        found.alone_pixels = Some(found.visible_pixels);
        let Some(around) = place_of(found, camera, near) else { continue };
        let k = camera.intrinsics;
        let intrinsics = Intrinsics {
            width: around.width(),
            height: around.height(),
            cx: k.cx - f64::from(around.left),
            cy: k.cy - f64::from(around.top),
            ..k
        };
        let cropped = Camera { intrinsics, ..*camera };
        requests.push(ViewRequest { only: Some(found.id), ..ViewRequest::from(cropped) });
        whose.push(index);
    }
    if requests.is_empty() {
        return Ok(());
    }
    let options = ViewOptions { channels: Channels::IDS, format: PixelFormat::Full };
    let mut views = Views::new();
    renderer.render_views(scene, &requests, &options, &mut views)?;
    for (view, index) in whose.into_iter().enumerate() {
        let pixels = views.ids[views.pixels(view)].iter().filter(|id| **id != 0).count() as u32;
        // Edges of a picture of another size may fall to the other side by a rounding.
        boxes[index].alone_pixels = Some(pixels.max(boxes[index].visible_pixels));
    }
    Ok(())
}

/// Where on the picture an entity can be, with all that reaches beyond its solid.
fn place_of(of: &EntityBox, camera: &Camera, near: f64) -> Option<PixelBox> {
    let reach = overhang(of.kind, of.world.half_extents.z * 2.0);
    let extent = extent_of_box(&grown(&of.world, reach), camera, near);
    let around = extent.and_then(|extent| PixelBox::clipped(&extent, &camera.intrinsics));
    match (around, of.visible) {
        (Some(around), Some(visible)) => Some(around.union(&visible)),
        (around, visible) => around.or(visible),
    }
}

/// The boxes of what a worn camera has before it, as core's `Observer`: of the kinds that are asked for, hidden or not, as far as it
/// reaches.
#[derive(Clone, Debug)]
pub struct BoxSensor {
    camera: CameraSensor,
    kinds: Vec<EntityKind>,
    reach: f64,
    frame: Frame,
}

impl BoxSensor {
    /// Boxes by that camera, of these kinds of entities, within so many metres of it.
    pub fn new(camera: CameraSensor, kinds: &[EntityKind], reach: f64) -> Self {
        Self { camera, kinds: kinds.to_vec(), reach, frame: Frame::new() }
    }

    /// The picture that the last boxes are of.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }
}

impl Observer for BoxSensor {
    type Observation = Vec<EntityBox>;

    fn observe(
        &mut self,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut Vec<EntityBox>,
    ) -> Result<(), ObserveError> {
        self.camera.observe(scene, who, &mut self.frame)?;
        let camera = self.camera.camera(scene, who)?;
        let eye = camera.world_from_optical.translation.vector.into();
        let mut ids = Vec::new();
        let _ = scene.visit(&Aabb::around(eye, Vector3::repeat(self.reach)), &mut |entity| {
            if entity.id != who && entity.is_visible() && self.kinds.contains(&entity.kind) {
                ids.push(entity.id);
            }
            ControlFlow::Continue(())
        });
        ids.sort_unstable();
        let renderer = self.camera.renderer();
        let mut renderer = renderer.lock().unwrap_or_else(PoisonError::into_inner);
        let near = renderer.config().near;
        *out = boxes_of(scene, &camera, &self.frame, &ids, near, Some(&mut renderer))
            .map_err(|error| ObserveError::Sensor(error.to_string()))?;
        out.retain(|found| found.amodal.is_some() || found.visible.is_some());
        Ok(())
    }
}
