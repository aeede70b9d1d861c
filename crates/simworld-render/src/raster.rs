//! The raster backend: view after view through one set of textures, then into the planes of the batch.

use crate::RenderError;
use crate::batch::{Channels, Layout, Span};
use crate::config::AntiAliasing;
use crate::draw_list::{Batch, DrawList, ShadowList, ViewBatches};
use crate::falling::Falling;
use crate::gpu::{Features, Gpu, Pipelines, Planes, Redraw, Scenery, ShadowMaps, Targets};
use crate::mesh::{Drawn, Extent, MeshLibrary, Pattern};
use crate::models::Models;
use crate::shadow::{ShadowKey, ShadowView};

/// Pipelines, meshes and textures of the raster backend.
pub(crate) struct Raster {
    pub pipelines: Pipelines,
    meshes: Meshes,
    pub models: Models,
    pub shadows: ShadowMaps,
    targets: Option<Targets>,
    smoothing: AntiAliasing,
}

/// The meshes on the device.
struct Meshes {
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    ranges: Vec<std::ops::Range<u32>>,
    extents: Vec<Extent>,
}

/// What is drawn, and from what.
pub(crate) struct Job<'a> {
    pub scenery: &'a Scenery,
    pub list: &'a DrawList,
    pub layout: &'a Layout,
    pub channels: Channels,
    pub gpu: &'a Gpu,
    /// By view, where the sun throws shadows.
    pub shadows: &'a [Option<ShadowView>],
    /// Of the residents.
    pub version: u64,
    /// What the pictures need; [prepared](Raster::prepare).
    pub features: Features,
    /// By view, what falls before it.
    pub falling: &'a [Falling],
    /// The pictures of models.
    pub store: &'a wgpu::BindGroup,
}

/// With which pipelines entities are drawn.
#[derive(Clone, Copy)]
enum Painting<'a> {
    /// Those of each pattern.
    Picture(Features),
    /// One for all, for depth and ids alone.
    Measures(&'a wgpu::RenderPipeline),
}

impl Raster {
    pub(crate) fn new(
        gpu: &Gpu,
        shadow_resolution: u32,
        smoothing: AntiAliasing,
        store: &wgpu::BindGroupLayout,
    ) -> Self {
        let shadows = ShadowMaps::new(gpu, shadow_resolution.max(1));
        let pipelines = Pipelines::new(gpu, shadows.layout(), store, smoothing);
        let meshes = Meshes::upload(gpu, MeshLibrary::build());
        Self { pipelines, meshes, models: Models::default(), shadows, targets: None, smoothing }
    }

    /// The boxes of the meshes.
    pub(crate) fn extents(&self) -> &[Extent] {
        &self.meshes.extents
    }

    /// Makes room for the largest view of a batch.
    pub(crate) fn hold(&mut self, gpu: &Gpu, [width, height]: [u32; 2]) -> Result<(), RenderError> {
        let held = self.targets.as_ref().map_or([0; 2], |targets| [targets.width, targets.height]);
        // Small targets are cheaper to clear.
        if held[0] < width || held[1] < height || held[0] > 2 * width || held[1] > 2 * height {
            self.targets = None;
            let targets = Targets::new(gpu, width, height, self.smoothing);
            gpu.check()?;
            self.targets = Some(targets);
        }
        Ok(())
    }

    /// Makes ready what pictures of these features are drawn with, if there are to be pictures.
    pub(crate) fn prepare(&mut self, gpu: &Gpu, features: Option<Features>) {
        if let Some(features) = features {
            self.pipelines.prepare(gpu, features);
        }
        if self.models.are_cut() {
            self.pipelines.prepare_cuts(gpu, features);
        }
    }

    /// Records every view of a batch.
    pub(crate) fn draw(&mut self, encoder: &mut wgpu::CommandEncoder, planes: &Planes, job: &Job<'_>) {
        for (view, (span, batches)) in job.layout.spans.iter().zip(&job.list.views).enumerate() {
            let in_color = job.channels.contains(Channels::RGB);
            let key = job.shadows[view].as_ref().filter(|_| in_color).map(|shadow| shadow.key);
            if let (Some(key), Some(list)) = (&key, &batches.shadows) {
                self.draw_shadows(encoder, job, view, key, list);
            }
            let Some(targets) = &self.targets else { return };
            let one = View { job, index: view, span, batches, shadows: self.shadows.group(key.as_ref()) };
            self.draw_view(encoder, targets, &one, job.channels);
            targets.copy(encoder, planes, span, job.channels);
            if job.channels.contains(Channels::NORMALS) {
                // The texture of the ids was copied, and is free.
                let mut pass = begin(encoder, &[attachment(&targets.id_view, None)], &targets.z, span);
                one.job.scenery.bind(&mut pass, view);
                self.draw_batches(&mut pass, &batches.visible, |pass, _| {
                    pass.set_pipeline(&self.pipelines.normals);
                });
                let cuts = self.pipelines.cuts().map(|cuts| &cuts.normals);
                self.draw_cuts(&mut pass, &batches.visible, job.store, cuts);
                drop(pass);
                Targets::copy_one(encoder, &targets.id, &planes.normals, span);
            }
        }
    }

    /// Brings a shadow map up to date: nothing is drawn while nothing changed in it.
    fn draw_shadows(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        job: &Job<'_>,
        view: usize,
        key: &ShadowKey,
        list: &ShadowList,
    ) {
        let [still, moving] = &list.batches;
        let view = job.layout.spans.len() + view;
        let clear = wgpu::LoadOp::Clear(1.0);
        match self.shadows.plan(job.gpu, key, job.version, &list.casters) {
            Redraw::Nothing => {}
            Redraw::Whole => {
                self.draw_layer(encoder, job, view, self.shadows.target(key, false), still, clear);
            }
            Redraw::Layers { stale } => {
                if stale {
                    self.draw_layer(encoder, job, view, self.shadows.target(key, true), still, clear);
                }
                self.shadows.copy(encoder, key);
                let whole = self.shadows.target(key, false);
                self.draw_layer(encoder, job, view, whole, moving, wgpu::LoadOp::Load);
            }
        }
    }

    fn draw_layer(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        job: &Job<'_>,
        view: usize,
        target: Option<&wgpu::TextureView>,
        casters: &[Batch],
        load: wgpu::LoadOp<f32>,
    ) {
        let Some(target) = target else { return };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow"),
            depth_stencil_attachment: Some(depth_attachment(target, load)),
            ..Default::default()
        });
        pass.set_pipeline(&self.pipelines.shadow);
        job.scenery.bind(&mut pass, view);
        self.draw_batches(&mut pass, casters, |_, _| {});
        self.draw_cuts(&mut pass, casters, job.store, self.pipelines.cuts().map(|cuts| &cuts.shadow));
    }

    fn draw_view(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        one: &View<'_>,
        channels: Channels,
    ) {
        let color = &targets.color_view;
        let measures = [attachment(&targets.depth_view, None), attachment(&targets.id_view, None)];
        let wants_rgb = channels.contains(Channels::RGB);
        let (smooth, only_rgb) = (&targets.smooth, (channels - Channels::NORMALS) == Channels::RGB);
        if let (Some([color_samples, z_samples]), true) = (smooth, wants_rgb) {
            let mut pass = begin(encoder, &[attachment(color_samples, Some(color))], z_samples, one.span);
            self.draw_entities(&mut pass, one, Painting::Picture(one.job.features));
            self.draw_sky(&mut pass, one);
        }
        if smooth.is_some() || !wants_rgb {
            if !only_rgb {
                let mut pass = begin(encoder, &measures, &targets.z, one.span);
                self.draw_entities(&mut pass, one, Painting::Measures(&self.pipelines.measures));
            }
        } else {
            let [depth, id] = measures;
            let mut pass = begin(encoder, &[attachment(color, None), depth, id], &targets.z, one.span);
            self.draw_entities(&mut pass, one, Painting::Picture(one.job.features));
            self.draw_sky(&mut pass, one);
        }
    }

    /// Draws every batch.
    fn draw_entities(&self, pass: &mut wgpu::RenderPass<'_>, one: &View<'_>, painting: Painting<'_>) {
        one.job.scenery.bind(pass, one.index);
        pass.set_bind_group(1, one.shadows, &[]);
        pass.set_bind_group(2, one.job.store, &[]);
        self.draw_batches(pass, &one.batches.visible, |pass, pattern| {
            let pipeline = match painting {
                Painting::Picture(features) => self.pipelines.picture(features, pattern),
                Painting::Measures(pipeline) => Some(pipeline),
            };
            if let Some(pipeline) = pipeline {
                pass.set_pipeline(pipeline);
            }
        });
        let cuts = match painting {
            Painting::Picture(features) => self.pipelines.cut_picture(features),
            Painting::Measures(_) => self.pipelines.cuts().map(|cuts| &cuts.measures),
        };
        self.draw_cuts(pass, &one.batches.visible, one.job.store, cuts);
    }

    /// Draws what is cut out of the models among batches, after everything that is whole.
    fn draw_cuts(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        batches: &[Batch],
        store: &wgpu::BindGroup,
        pipeline: Option<&wgpu::RenderPipeline>,
    ) {
        let Some(pipeline) = pipeline.filter(|_| self.models.are_cut()) else { return };
        pass.set_pipeline(pipeline);
        pass.set_bind_group(2, store, &[]);
        for batch in batches {
            if let Drawn::Model(id) = batch.mesh {
                self.models.draw(pass, id, batch.instances.clone(), true);
            }
        }
    }

    /// Draws the sky where nothing is, and what falls before all.
    fn draw_sky(&self, pass: &mut wgpu::RenderPass<'_>, one: &View<'_>) {
        pass.set_pipeline(&self.pipelines.sky);
        one.job.scenery.bind(pass, one.index);
        pass.draw(0..3, 0..1);
        let drops = one.job.falling[one.index].count;
        if drops > 0 {
            pass.set_pipeline(&self.pipelines.precipitation);
            pass.draw(0..6, 0..drops);
        }
    }

    /// Draws batches in their order; before each pattern, what is to be done for it.
    fn draw_batches(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        batches: &[Batch],
        mut begin: impl FnMut(&mut wgpu::RenderPass<'_>, Pattern),
    ) {
        let (mut is_own, mut pattern) = (false, None);
        for batch in batches {
            if pattern != Some(batch.mesh.pattern()) {
                begin(pass, batch.mesh.pattern());
                pattern = Some(batch.mesh.pattern());
            }
            match batch.mesh {
                Drawn::Model(id) => {
                    self.models.draw(pass, id, batch.instances.clone(), false);
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

/// One view of a batch.
struct View<'a> {
    job: &'a Job<'a>,
    index: usize,
    span: &'a Span,
    batches: &'a ViewBatches,
    /// Its shadow map.
    shadows: &'a wgpu::BindGroup,
}

impl Meshes {
    fn upload(gpu: &Gpu, library: MeshLibrary) -> Self {
        let buffer = |usage, bytes: &[u8]| gpu.upload("meshes", usage, bytes);
        Self {
            vertices: buffer(wgpu::BufferUsages::VERTEX, bytemuck::cast_slice(&library.vertices)),
            indices: buffer(wgpu::BufferUsages::INDEX, bytemuck::cast_slice(&library.indices)),
            ranges: library.ranges,
            extents: library.extents,
        }
    }
}

type Attachment<'a> = Option<wgpu::RenderPassColorAttachment<'a>>;

/// A target that starts at zero: nobody.
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

fn depth_attachment(
    view: &wgpu::TextureView,
    load: wgpu::LoadOp<f32>,
) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations { load, store: wgpu::StoreOp::Store }),
        stencil_ops: None,
    }
}

/// A pass over the entities of a view; z starts at infinity, which is 0 in reverse z.
fn begin<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    colors: &[Attachment<'_>],
    z: &wgpu::TextureView,
    span: &Span,
) -> wgpu::RenderPass<'a> {
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("picture"),
        color_attachments: colors,
        depth_stencil_attachment: Some(depth_attachment(z, wgpu::LoadOp::Clear(0.0))),
        ..Default::default()
    });
    pass.set_viewport(0.0, 0.0, span.width as f32, span.height as f32, 0.0, 1.0);
    pass.set_scissor_rect(0, 0, span.width, span.height);
    pass
}
