//! The renderer: a scene and a camera in, a frame out.

use simworld_core::camera::Camera;
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;

use crate::draw_list::{Batch, DrawList, Instance};
use crate::gpu::{Globals, Gpu, Pipelines, Targets};
use crate::light::Light;
use crate::mesh::{Drawn, MeshLibrary, Pattern};
use crate::models::Models;
use crate::shadow::ShadowView;
use crate::view::View;
use crate::{Frame, RenderConfig, RenderError};

/// Draws scenes without a window.
///
/// It keeps its buffers from picture to picture; a picture depends on scene, camera and configuration alone.
pub struct Renderer {
    config: RenderConfig,
    gpu: Gpu,
    pipelines: Pipelines,
    meshes: Meshes,
    models: Models,
    instances: wgpu::Buffer,
    targets: Option<Targets>,
    list: DrawList,
}

/// The meshes on the device.
struct Meshes {
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    ranges: Vec<std::ops::Range<u32>>,
}

impl std::fmt::Debug for Renderer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Renderer")
            .field("adapter", &self.gpu.info.name)
            .field("config", &self.config)
            .finish_non_exhaustive()
    }
}

impl Renderer {
    /// A renderer on the adapter that the configuration asks for.
    ///
    /// # Errors
    /// A setting out of range, no adapter (the message says what to install), or an adapter that fails.
    pub fn new(config: &RenderConfig) -> Result<Self, RenderError> {
        config.validate()?;
        let gpu = Gpu::new(config)?;
        let side = config.shadow_resolution.min(gpu.largest_picture());
        let globals_size = size_of::<Globals>() as u64;
        let pipelines = Pipelines::new(&gpu, globals_size, side, config.anti_aliasing);
        let meshes = Meshes::upload(&gpu, MeshLibrary::build());
        let instances = instance_buffer(&gpu, 1024);
        gpu.check()?;
        let config = RenderConfig { shadow_resolution: side, ..config.clone() };
        let (models, list) = (Models::default(), DrawList::default());
        Ok(Self { config, gpu, pipelines, meshes, models, instances, targets: None, list })
    }

    /// Its settings.
    pub fn config(&self) -> &RenderConfig {
        &self.config
    }

    /// The name of the adapter and the interface through which it is used, such as "llvmpipe (Vulkan)".
    pub fn adapter(&self) -> String {
        format!("{} ({:?})", self.gpu.info.name, self.gpu.info.backend)
    }

    /// Draws what the camera sees of the scene into the frame.
    ///
    /// # Errors
    /// A camera that cannot exist or is too large, more entities than the adapter holds, or a failing adapter. The
    /// frame is then unspecified.
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
        let view = View::new(camera, self.config.near, self.config.far, self.gpu.largest_picture())?;
        let light = Light::of(scene.environment(), self.config.exposure_compensation);
        let shadow = ShadowView::new(
            &view,
            &light.sun_direction,
            self.config.shadow_distance,
            self.config.shadow_resolution,
        );
        self.list.gather(scene, &view, shadow.as_ref(), self.config.min_pixels, hidden);
        self.models.hold(&self.gpu, scene, &[&self.list.visible, &self.list.casters])?;
        self.upload(&Globals::new(&view, &light, shadow.as_ref()))?;

        let (width, height) = (camera.intrinsics.width, camera.intrinsics.height);
        if self.targets.as_ref().is_none_or(|targets| (targets.width, targets.height) != (width, height)) {
            self.targets = None;
            let targets = Targets::new(&self.gpu, width, height, self.config.anti_aliasing);
            self.gpu.check()?;
            self.targets = Some(targets);
        }
        let Some(targets) = &self.targets else {
            return Err(RenderError::OutOfMemory);
        };
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        if shadow.is_some() {
            self.draw_shadows(&mut encoder);
        }
        self.draw_picture(&mut encoder, targets);
        targets.copy_back(&mut encoder);
        self.gpu.queue.submit([encoder.finish()]);
        let outcome = self.gpu.check().and_then(|()| targets.unpack(&self.gpu, &self.list.entities, frame));
        if outcome.is_err() {
            // A buffer may still be mapped; the next picture starts afresh.
            self.targets = None;
        }
        outcome
    }

    /// Sends the uniforms and the instances to the device.
    fn upload(&mut self, globals: &Globals) -> Result<(), RenderError> {
        let count = self.list.instances.len();
        let limit = (self.gpu.device.limits().max_buffer_size / size_of::<Instance>() as u64) as usize;
        if count > limit {
            return Err(RenderError::TooMany { count, limit });
        }
        if (count * size_of::<Instance>()) as u64 > self.instances.size() {
            self.instances = instance_buffer(&self.gpu, count.next_power_of_two().min(limit));
            self.gpu.check()?;
        }
        let queue = &self.gpu.queue;
        queue.write_buffer(&self.pipelines.globals_buffer, 0, bytemuck::bytes_of(globals));
        queue.write_buffer(&self.instances, 0, bytemuck::cast_slice(&self.list.instances));
        Ok(())
    }

    fn draw_shadows(&self, encoder: &mut wgpu::CommandEncoder) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow"),
            depth_stencil_attachment: Some(depth_attachment(&self.pipelines.shadow_map, 1.0)),
            ..Default::default()
        });
        pass.set_pipeline(&self.pipelines.shadow);
        pass.set_bind_group(0, &self.pipelines.globals, &[]);
        self.draw_batches(&mut pass, &self.list.casters, |_, _| {});
    }

    fn draw_picture(&self, encoder: &mut wgpu::CommandEncoder, targets: &Targets) {
        let color = &targets.color_view;
        let measures = [attachment(&targets.depth_view, None), attachment(&targets.id_view, None)];
        if let (Some([color_samples, z_samples]), Some(pipeline)) =
            (&targets.smooth, &self.pipelines.measures)
        {
            let mut pass = begin(encoder, &[attachment(color_samples, Some(color))], z_samples);
            self.draw_entities(&mut pass, None);
            self.draw_sky(&mut pass);
            drop(pass);
            let mut pass = begin(encoder, &measures, &targets.z);
            self.draw_entities(&mut pass, Some(pipeline));
        } else {
            let [depth, id] = measures;
            let mut pass = begin(encoder, &[attachment(color, None), depth, id], &targets.z);
            self.draw_entities(&mut pass, None);
            self.draw_sky(&mut pass);
        }
    }

    /// Draws every batch, with the pipeline of its pattern or with one pipeline for all.
    fn draw_entities(&self, pass: &mut wgpu::RenderPass<'_>, one: Option<&wgpu::RenderPipeline>) {
        pass.set_bind_group(0, &self.pipelines.globals, &[]);
        pass.set_bind_group(1, &self.pipelines.shadow_inputs, &[]);
        self.draw_batches(pass, &self.list.visible, |pass, pattern| {
            pass.set_pipeline(one.unwrap_or(&self.pipelines.picture[pattern as usize]));
        });
    }

    fn draw_sky(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipelines.sky);
        pass.set_bind_group(0, &self.pipelines.globals, &[]);
        pass.draw(0..3, 0..1);
    }

    /// Draws batches in their order; before each pattern, what is to be done for it.
    fn draw_batches(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        batches: &[Batch],
        mut begin: impl FnMut(&mut wgpu::RenderPass<'_>, Pattern),
    ) {
        pass.set_vertex_buffer(1, self.instances.slice(..));
        let (mut is_own, mut pattern) = (false, None);
        for batch in batches {
            if pattern != Some(batch.mesh.pattern()) {
                begin(pass, batch.mesh.pattern());
                pattern = Some(batch.mesh.pattern());
            }
            match batch.mesh {
                Drawn::Model(id) => {
                    self.models.draw(pass, id, batch.instances.clone());
                    is_own = false;
                }
                Drawn::Own(mesh) => {
                    if !is_own {
                        pass.set_vertex_buffer(0, self.meshes.vertices.slice(..));
                        pass.set_index_buffer(self.meshes.indices.slice(..), wgpu::IndexFormat::Uint32);
                        is_own = true;
                    }
                    pass.draw_indexed(self.meshes.ranges[mesh as usize].clone(), 0, batch.instances.clone());
                }
            }
        }
    }
}

impl Meshes {
    fn upload(gpu: &Gpu, library: MeshLibrary) -> Self {
        let buffer = |usage, bytes: &[u8]| gpu.upload("meshes", usage, bytes);
        Self {
            vertices: buffer(wgpu::BufferUsages::VERTEX, bytemuck::cast_slice(&library.vertices)),
            indices: buffer(wgpu::BufferUsages::INDEX, bytemuck::cast_slice(&library.indices)),
            ranges: library.ranges,
        }
    }
}

fn instance_buffer(gpu: &Gpu, count: usize) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("instances"),
        size: (count * size_of::<Instance>()) as u64,
        usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

type Attachment<'a> = Option<wgpu::RenderPassColorAttachment<'a>>;

/// A target that starts at zero: the number of no instance.
#[expect(clippy::unnecessary_wraps, reason = "wgpu takes every attachment as an option")]
fn attachment<'a>(view: &'a wgpu::TextureView, resolve: Option<&'a wgpu::TextureView>) -> Attachment<'a> {
    let store = if resolve.is_some() { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store };
    Some(wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: resolve,
        ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store },
    })
}

fn depth_attachment(view: &wgpu::TextureView, start: f32) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(start), store: wgpu::StoreOp::Store }),
        stencil_ops: None,
    }
}

/// A pass over the entities; z starts at infinity, which is 0 in reverse z.
fn begin<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    colors: &[Attachment<'_>],
    z: &wgpu::TextureView,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("picture"),
        color_attachments: colors,
        depth_stencil_attachment: Some(depth_attachment(z, 0.0)),
        ..Default::default()
    })
}
