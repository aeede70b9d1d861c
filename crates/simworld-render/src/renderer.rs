//! The renderer: a scene and cameras in, frames out.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};

use simworld_core::camera::Camera;
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;

use crate::batch::{Channels, Layout, Span, ViewOptions, ViewRequest};
use crate::works::{Pending, Works};
use crate::{Culling, Frame, RenderConfig, RenderError, Views};

/// Draws scenes without a window.
///
/// It keeps its buffers from picture to picture, and what stands still of a scene on the device; a picture depends on scene, camera
/// and configuration alone.
///
/// Software draws one batch at a time, and has much of it to do on one thread: so a renderer on a software adapter has a second device, made when
/// a batch is handed in while another is under way, and these draw in turn.
///
/// Many cameras of one scene are drawn in one call and one submission:
///
/// ```
/// use simworld_core::camera::{Camera, Intrinsics};
/// use simworld_core::geometry::{Point3, pose_facing};
/// use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
/// use simworld_render::{RenderConfig, Renderer, ViewOptions, ViewRequest, Views};
///
/// let mut world = World::new();
/// let pose = pose_facing(Point3::new(12.0, 0.0, 0.0), 0.0);
/// let car = world.spawn(EntityDesc::new(EntityKind::Car, pose, Shape::cuboid(4.5, 1.8, 1.5)))?;
/// let intrinsics = Intrinsics::from_fov(64, 64, 1.0)?;
/// let eyes = [Point3::new(0.0, 0.0, 1.5), Point3::new(12.0, -9.0, 1.5)];
/// let requests = eyes.map(|eye| ViewRequest::from(Camera::looking_at(eye, Point3::new(12.0, 0.0, 0.7), intrinsics)));
/// if let Ok(mut renderer) = Renderer::new(&RenderConfig::default()) {
///     let mut views = Views::new();
///     renderer.render_views(&world, &requests, &ViewOptions::default(), &mut views)?;
///     for view in 0..views.len() {
///         assert!(views.ids[views.pixels(view)].iter().any(|id| views.entity(*id) == Some(car)));
///     }
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Renderer {
    config: RenderConfig,
    works: Works,
    /// Of a software adapter, for every other batch while one is under way.
    second: Option<Box<Works>>,
    /// What is under way and where, by ticket.
    pending: BTreeMap<u64, (Which, Pending)>,
    /// Of [`render`](Self::render).
    one: Views,
}

/// Which device of a renderer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Which {
    First,
    Second,
}

/// Tickets of all renderers of this process, so that none passes for another's.
static TICKETS: AtomicU64 = AtomicU64::new(0);

/// Stands for a batch that was handed in; see [`Renderer::submit`].
#[derive(Debug, PartialEq, Eq)]
pub struct Ticket(u64);

/// A batch on the device, until the renderer draws again; see [`Renderer::draw_on_device`].
#[derive(Debug)]
pub struct DeviceViews<'a> {
    works: &'a Works,
    layout: Layout,
    options: ViewOptions,
}

impl std::fmt::Debug for Renderer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Renderer")
            .field("works", &self.works)
            .field("config", &self.config)
            .finish_non_exhaustive()
    }
}

impl std::fmt::Debug for Works {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Works").field("adapter", &self.gpu.info.name).finish_non_exhaustive()
    }
}

impl Renderer {
    /// A renderer on the adapter that the configuration asks for.
    ///
    /// # Errors
    /// A setting out of range, no adapter (the message says what to install), or an adapter that fails.
    pub fn new(config: &RenderConfig) -> Result<Self, RenderError> {
        config.validate()?;
        let works = Works::new(config)?;
        let config = RenderConfig { shadow_resolution: works.shadow_resolution, ..config.clone() };
        Ok(Self { config, works, second: None, pending: BTreeMap::new(), one: Views::new() })
    }

    /// Its settings.
    pub fn config(&self) -> &RenderConfig {
        &self.config
    }

    /// The name of the adapter and the interface through which it is used, such as "llvmpipe (Vulkan)".
    pub fn adapter(&self) -> String {
        format!("{} ({:?})", self.works.gpu.info.name, self.works.gpu.info.backend)
    }

    /// Who culls for the raster backend on this adapter, while no model plays a clip.
    pub fn culling(&self) -> Culling {
        if self.works.culls_on_device(self.config.culling) { Culling::Device } else { Culling::Host }
    }

    /// Its device, for those who go on with [`DeviceViews`].
    pub fn device(&self) -> &wgpu::Device {
        &self.works.gpu.device
    }

    /// The queue of its device.
    pub fn queue(&self) -> &wgpu::Queue {
        &self.works.gpu.queue
    }

    /// Draws what the camera sees of the scene into the frame.
    ///
    /// # Errors
    /// A camera that cannot exist or is too large, more entities than the adapter holds, or a failing adapter. The
    /// frame is then unspecified. After the loss of the device the next call has a new one; when its memory ran out, all that
    /// was held for larger pictures is given back.
    pub fn render(
        &mut self,
        scene: &dyn Scene,
        camera: &Camera,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        self.render_hiding(scene, camera, None, frame)
    }

    /// As [`render`](Self::render), without one entity: the one behind whose eyes the camera sits. It still throws
    /// its shadow.
    ///
    /// # Errors
    /// As [`render`](Self::render).
    pub fn render_hiding(
        &mut self,
        scene: &dyn Scene,
        camera: &Camera,
        hidden: Option<EntityId>,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        let mut one = std::mem::take(&mut self.one);
        let request = ViewRequest { hidden, ..ViewRequest::from(*camera) };
        let outcome = self.render_views(scene, &[request], &ViewOptions::default(), &mut one);
        if outcome.is_ok() {
            one.give(frame);
        }
        self.one = one;
        outcome
    }

    /// Draws a batch and waits for it: [`submit`](Self::submit) and [`take`](Self::take).
    ///
    /// # Errors
    /// As both.
    pub fn render_views(
        &mut self,
        scene: &dyn Scene,
        requests: &[ViewRequest],
        options: &ViewOptions,
        views: &mut Views,
    ) -> Result<(), RenderError> {
        let ticket = self.hand_in(Which::First, scene, requests, *options)?;
        self.take(ticket, views)
    }

    /// Hands in a batch, all views in one submission, and goes on without it: the ticket [takes](Self::take) it later. So the
    /// device draws one step while the host simulates the next. Every ticket holds memory until it is taken.
    ///
    /// # Errors
    /// As [`render`](Self::render); no views, no channels, or more pixels than the adapter holds.
    pub fn submit(
        &mut self,
        scene: &dyn Scene,
        requests: &[ViewRequest],
        options: &ViewOptions,
    ) -> Result<Ticket, RenderError> {
        let which = self.free_device();
        self.hand_in(which, scene, requests, *options)
    }

    fn hand_in(
        &mut self,
        which: Which,
        scene: &dyn Scene,
        requests: &[ViewRequest],
        options: ViewOptions,
    ) -> Result<Ticket, RenderError> {
        let (encoder, layout) = self.draw(which, scene, requests, options)?;
        let outcome = self.at(which).submit(encoder, layout, options);
        let pending = self.mended(which, outcome)?;
        let number = TICKETS.fetch_add(1, Ordering::Relaxed);
        self.pending.insert(number, (which, pending));
        Ok(Ticket(number))
    }

    /// The device with least to do, the first of two alike; a second one is made only where the adapter is software.
    fn free_device(&mut self) -> Which {
        let busy = |which| self.pending.values().filter(|(other, _)| *other == which).count();
        let is_software = self.works.gpu.info.device_type == wgpu::DeviceType::Cpu;
        if !is_software || busy(Which::First) <= busy(Which::Second) {
            return Which::First;
        }
        if self.second.is_none() {
            // Without one it goes as it would have gone.
            self.second = Works::new(&self.config).ok().map(Box::new);
        }
        if self.second.is_some() { Which::Second } else { Which::First }
    }

    fn at(&mut self, which: Which) -> &mut Works {
        device_of(&mut self.works, &mut self.second, which)
    }

    /// Waits for a batch that was handed in.
    ///
    /// # Errors
    /// A ticket of another renderer or of a lost device, or a failing adapter. The views are then unspecified.
    #[expect(clippy::needless_pass_by_value, reason = "a ticket is good for one batch")]
    pub fn take(&mut self, ticket: Ticket, views: &mut Views) -> Result<(), RenderError> {
        let (which, pending) = self.pending.remove(&ticket.0).ok_or(RenderError::Ticket)?;
        let outcome = self.at(which).take(pending, views);
        self.mended(which, outcome)
    }

    /// Draws a batch, and leaves it on the device. It goes on without waiting for it, unless three batches before it are still under way.
    ///
    /// # Errors
    /// As [`submit`](Self::submit).
    pub fn draw_on_device(
        &mut self,
        scene: &dyn Scene,
        requests: &[ViewRequest],
        options: &ViewOptions,
    ) -> Result<DeviceViews<'_>, RenderError> {
        let (encoder, layout) = self.draw(Which::First, scene, requests, *options)?;
        let outcome = self.works.leave(encoder);
        self.mended(Which::First, outcome)?;
        Ok(DeviceViews { works: &self.works, layout, options: *options })
    }

    fn draw(
        &mut self,
        which: Which,
        scene: &dyn Scene,
        requests: &[ViewRequest],
        options: ViewOptions,
    ) -> Result<(wgpu::CommandEncoder, Layout), RenderError> {
        if requests.is_empty() {
            return Err(RenderError::NoViews);
        }
        if options.channels.is_empty() {
            return Err(RenderError::NoChannels);
        }
        let works = device_of(&mut self.works, &mut self.second, which);
        let outcome = match works.gpu.lost() {
            Some(reason) => Err(RenderError::Lost { reason }),
            None => works.draw(&self.config, scene, requests, options, None),
        };
        self.mended(which, outcome)
    }

    /// Whether [`cast`](Self::cast) may be asked for.
    pub(crate) fn casts_tables(&self) -> bool {
        self.works.can_cast()
    }

    /// Casts the rays of a table from the eye of a camera: directions of length one in its optical frame, row by row of its picture. Depth
    /// is the range along each, m.
    pub(crate) fn cast(
        &mut self,
        scene: &dyn Scene,
        request: &ViewRequest,
        rays: &[[f32; 4]],
        options: ViewOptions,
        views: &mut Views,
    ) -> Result<(), RenderError> {
        let outcome = match self.works.gpu.lost() {
            Some(reason) => Err(RenderError::Lost { reason }),
            None => self.works.draw(&self.config, scene, &[*request], options, Some(rays)),
        };
        let (encoder, layout) = self.mended(Which::First, outcome)?;
        let outcome = self.works.submit(encoder, layout, options);
        let pending = self.mended(Which::First, outcome)?;
        let outcome = self.works.take(pending, views);
        self.mended(Which::First, outcome)
    }

    /// The outcome; where it is an error of the device that follows from its loss, that, and a new device for the next call. After
    /// other errors of the device, such as a lack of memory, the next call has buffers of its own size.
    fn mended<T>(&mut self, which: Which, outcome: Result<T, RenderError>) -> Result<T, RenderError> {
        if outcome.is_err() {
            self.at(which).distrust();
        }
        if let Err(RenderError::Device(_) | RenderError::OutOfMemory | RenderError::Lost { .. }) = &outcome {
            let works = device_of(&mut self.works, &mut self.second, which);
            // The loss is told when nothing is under way any more; an error of waiting is that of the outcome.
            let _ = works.gpu.wait();
            if let Some(reason) = works.gpu.lost() {
                self.pending.retain(|_, (other, _)| *other != which);
                *works = Works::new(&self.config)?;
                return Err(RenderError::Lost { reason });
            }
            works.relieve(&self.config);
        }
        outcome
    }
}

/// A device of a renderer; the first where there is no second.
fn device_of<'a>(works: &'a mut Works, second: &'a mut Option<Box<Works>>, which: Which) -> &'a mut Works {
    match (which, second) {
        (Which::Second, Some(second)) => second,
        _ => works,
    }
}

impl DeviceViews<'_> {
    /// The buffer of a channel, in the form of the [`PixelFormat`](crate::PixelFormat) that was asked for: colour in three bytes a
    /// pixel, the others in one, two or four, each pixel where [`spans`](Self::spans) says. `None` if it was not asked for. It may be
    /// longer than the batch. What is handed in to the [queue](Renderer::queue) next finds the batch in it.
    pub fn buffer(&self, channel: Channels) -> Option<&wgpu::Buffer> {
        let is_one = channel.bits().is_power_of_two() && self.options.channels.contains(channel);
        is_one.then(|| self.works.planes.packed(channel))
    }

    /// Where each view lies in every buffer.
    pub fn spans(&self) -> &[Span] {
        &self.layout.spans
    }

    /// Waits, and tells how long each step of it took on the device, s, by the device's own clock: `find`, `light` and `paint` of rays, or
    /// `measure` where no colour is wanted, `glaze` where something is blended, `pack` of both backends. Empty on an adapter without such a clock.
    ///
    /// # Errors
    /// A failing adapter.
    pub fn times(&self) -> Result<Vec<(&'static str, f64)>, RenderError> {
        self.works.times()
    }

    /// Waits until the device has drawn it.
    ///
    /// # Errors
    /// A failing adapter.
    pub fn wait(&self) -> Result<(), RenderError> {
        self.works.gpu.wait()
    }
}
