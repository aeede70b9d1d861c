//! The raster backend: view after view through one set of textures, then into the planes of the batch.

use std::ops::Range;

use crate::RenderError;
use crate::batch::{Channels, Layout, Span};
use crate::config::AntiAliasing;
use crate::draw_list::{Batch, DrawList, Run, ShadowList, ViewBatches};
use crate::falling::Falling;
use crate::gpu::{
    Brush, Features, Gpu, Layer, Matter, Pipelines, Planes, Redraw, Scenery, ShadowMaps, Sifter, Targets,
};
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
    ranges: Vec<Range<u32>>,
    extents: Vec<Extent>,
}

/// What is drawn, and from what.
pub(crate) struct Job<'a> {
    pub scenery: &'a Scenery,
    pub list: &'a DrawList,
    /// What finds on the device what is drawn: of each view, then of the shadow map of each.
    pub sifter: Option<&'a Sifter>,
    pub layout: &'a Layout,
    pub channels: Channels,
    pub gpu: &'a Gpu,
    /// By view, where the sun throws shadows.
    pub shadows: &'a [Option<ShadowView>],
    /// Of the residents.
    pub version: u64,
    /// What the pictures need.
    pub features: Features,
    /// By view, what falls before it.
    pub falling: &'a [Falling],
    /// The pictures of models.
    pub store: &'a wgpu::BindGroup,
    /// Whether anything of them is blended.
    pub films: bool,
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

    /// The corners of what is drawn that are of that matter; `None` where it has none of these.
    pub(crate) fn corners(&self, mesh: Drawn, matter: Matter) -> Option<Range<u32>> {
        corners(&self.meshes, &self.models, mesh, matter)
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

    /// Records every view of a batch.
    pub(crate) fn draw(&mut self, encoder: &mut wgpu::CommandEncoder, planes: &Planes, job: &Job<'_>) {
        let Self { pipelines, meshes, models, shadows, targets, .. } = self;
        let Some(targets) = targets else { return };
        let mut painter = Painter { pipelines, meshes, models, job };
        for (view, (span, batches)) in job.layout.spans.iter().zip(&job.list.views).enumerate() {
            let in_color = job.channels.contains(Channels::RGB);
            let key = job.shadows[view].as_ref().filter(|_| in_color).map(|shadow| shadow.key);
            if let (Some(key), Some(list)) = (&key, &batches.shadows) {
                painter.draw_shadows(encoder, shadows, view, key, list);
            }
            painter.sift(encoder, view);
            let one = View { index: view, span, batches, shadows: shadows.group(key.as_ref()) };
            painter.draw_view(encoder, targets, &one);
            targets.copy(encoder, planes, span, job.channels);
            if job.channels.contains(Channels::NORMALS) {
                // The texture of the ids was copied, and is free.
                let mut pass = begin(encoder, &[attachment(&targets.id_view, None)], &targets.z, span);
                painter.bind(&mut pass, view);
                let normals = |_, matter: Matter| Some(Brush::Normals(matter.counted()));
                painter.draw_batches(&mut pass, &batches.visible, normals);
                drop(pass);
                Targets::copy_one(encoder, &targets.id, &planes.normals, span);
            }
        }
    }
}

/// Records what is drawn, and has pipelines made as they are needed.
struct Painter<'a> {
    pipelines: &'a mut Pipelines,
    meshes: &'a Meshes,
    models: &'a Models,
    job: &'a Job<'a>,
}

impl Painter<'_> {
    /// Has the device find what is drawn next, where it does that.
    fn sift(&self, encoder: &mut wgpu::CommandEncoder, sieve: usize) {
        if let Some(sifter) = self.job.sifter {
            sifter.sift(encoder, sieve);
        }
    }

    /// Binds what a view, or its shadow map, is drawn from.
    fn bind(&self, pass: &mut wgpu::RenderPass<'_>, view: usize) {
        self.job.scenery.bind(pass, view);
        if let Some(sifter) = self.job.sifter {
            pass.set_vertex_buffer(1, sifter.drawn.slice(..));
        }
    }

    /// Brings a shadow map up to date: nothing is drawn while nothing changed in it.
    fn draw_shadows(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        shadows: &mut ShadowMaps,
        view: usize,
        key: &ShadowKey,
        list: &ShadowList,
    ) {
        let [still, moving] = &list.batches;
        let view = self.job.layout.spans.len() + view;
        let clear = wgpu::LoadOp::Clear(1.0);
        if self.job.sifter.is_some() {
            if shadows.plan_whole(self.job.gpu, key, self.job.version) {
                self.sift(encoder, view);
                self.draw_layer(encoder, view, shadows.target(key, false), still, clear);
            }
            return;
        }
        match shadows.plan(self.job.gpu, key, self.job.version, &list.casters) {
            Redraw::Nothing => {}
            Redraw::Whole => self.draw_layer(encoder, view, shadows.target(key, false), still, clear),
            Redraw::Layers { stale } => {
                if stale {
                    self.draw_layer(encoder, view, shadows.target(key, true), still, clear);
                }
                shadows.copy(encoder, key);
                self.draw_layer(encoder, view, shadows.target(key, false), moving, wgpu::LoadOp::Load);
            }
        }
    }

    fn draw_layer(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
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
        self.bind(&mut pass, view);
        self.draw_batches(&mut pass, casters, |_, matter| Some(Brush::Shadow(matter.counted())));
    }

    fn draw_view(&mut self, encoder: &mut wgpu::CommandEncoder, targets: &Targets, one: &View<'_>) {
        let channels = self.job.channels;
        let color = &targets.color_view;
        let measures = [attachment(&targets.depth_view, None), attachment(&targets.id_view, None)];
        let wants_rgb = channels.contains(Channels::RGB);
        let (smooth, only_rgb) = (&targets.smooth, (channels - Channels::NORMALS) == Channels::RGB);
        if let (Some([color_samples, z_samples]), true) = (smooth, wants_rgb) {
            let mut pass = begin(encoder, &[attachment(color_samples, Some(color))], z_samples, one.span);
            self.draw_picture(&mut pass, one);
        }
        if smooth.is_some() || !wants_rgb {
            if !only_rgb {
                let mut pass = begin(encoder, &measures, &targets.z, one.span);
                self.draw_entities(&mut pass, one, |_, matter| Some(Brush::Measures(matter.counted())));
            }
        } else {
            let [depth, id] = measures;
            let mut pass = begin(encoder, &[attachment(color, None), depth, id], &targets.z, one.span);
            self.draw_picture(&mut pass, one);
        }
    }

    /// Draws what is there and the sky behind it; over that, in their order, what is blended and counts, what falls, and what is thinner.
    fn draw_picture(&mut self, pass: &mut wgpu::RenderPass<'_>, one: &View<'_>) {
        let features = self.job.features;
        self.draw_entities(pass, one, |pattern, matter| {
            (matter != Matter::Film).then_some(Brush::Picture(features, pattern, matter))
        });
        self.draw_sky(pass, one);
        self.draw_films(pass, one, Layer::Counted);
        self.draw_drops(pass, one);
        self.draw_films(pass, one, Layer::Thin);
    }

    /// Lays the nearest surfaces of a layer of what is blended over what is there: finds them first, so that each pixel has one.
    fn draw_films(&mut self, pass: &mut wgpu::RenderPass<'_>, one: &View<'_>, layer: Layer) {
        if !self.job.films {
            return;
        }
        let features = self.job.features;
        for brush in [Brush::Nearest(features, layer), Brush::Laid(features, layer)] {
            self.draw_entities(pass, one, |_, matter| (matter == Matter::Film).then_some(brush));
        }
    }

    fn draw_entities(
        &mut self,
        pass: &mut wgpu::RenderPass<'_>,
        one: &View<'_>,
        brush: impl Fn(Pattern, Matter) -> Option<Brush>,
    ) {
        self.bind(pass, one.index);
        pass.set_bind_group(1, one.shadows, &[]);
        self.draw_batches(pass, &one.batches.visible, brush);
    }

    /// Draws the sky where nothing is.
    fn draw_sky(&mut self, pass: &mut wgpu::RenderPass<'_>, one: &View<'_>) {
        pass.set_pipeline(self.pipelines.of(self.job.gpu, Brush::Sky));
        self.job.scenery.bind(pass, one.index);
        pass.draw(0..3, 0..1);
    }

    /// Draws what falls before all.
    fn draw_drops(&mut self, pass: &mut wgpu::RenderPass<'_>, one: &View<'_>) {
        let drops = self.job.falling[one.index].count;
        if drops > 0 {
            pass.set_pipeline(self.pipelines.of(self.job.gpu, Brush::Precipitation));
            self.job.scenery.bind(pass, one.index);
            pass.draw(0..6, 0..drops);
        }
    }

    /// Draws batches in their order, first what is whole, then what is cut out of models, then what of them is blended: of each what has a brush.
    fn draw_batches(
        &mut self,
        pass: &mut wgpu::RenderPass<'_>,
        batches: &[Batch],
        brush: impl Fn(Pattern, Matter) -> Option<Brush>,
    ) {
        pass.set_bind_group(2, self.job.store, &[]);
        let (mut is_own, mut in_hand) = (false, None);
        for matter in Matter::ALL {
            for batch in batches {
                let Some(wanted) = brush(batch.mesh.pattern(), matter) else { continue };
                let Some(corners) = corners(self.meshes, self.models, batch.mesh, matter) else { continue };
                if in_hand != Some(wanted) {
                    pass.set_pipeline(self.pipelines.of(self.job.gpu, wanted));
                    in_hand = Some(wanted);
                }
                match batch.mesh {
                    Drawn::Model(id) => self.models.bind(pass, id),
                    Drawn::Own(_) if is_own => {}
                    Drawn::Own(_) => self.meshes.bind(pass),
                }
                is_own = matches!(batch.mesh, Drawn::Own(_));
                match &batch.instances {
                    Run::Listed(run) => pass.draw_indexed(corners, 0, run.clone()),
                    Run::Found(kinds) => {
                        if let Some(sifter) = self.job.sifter {
                            sifter.draw(pass, kinds, matter);
                        }
                    }
                }
            }
        }
    }
}

/// The corners of what is drawn that are of that matter; `None` where it has none of these.
fn corners(meshes: &Meshes, models: &Models, mesh: Drawn, matter: Matter) -> Option<Range<u32>> {
    match (mesh, matter) {
        (Drawn::Model(id), _) => models.corners(id, matter),
        (Drawn::Own(mesh), Matter::Whole) => Some(meshes.ranges[mesh as usize].clone()),
        (Drawn::Own(_), Matter::Cut | Matter::Film) => None,
    }
}

/// One view of a batch.
struct View<'a> {
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

    /// Makes them what the next draws of a pass read.
    fn bind(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
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
