//! The ray-cast backend: every view of a batch in one dispatch.
//!
//! Two levels: a tree of boxes over the triangles of each mesh, and two over the instances, one over what stands still and one over what
//! moves. They are made on the CPU, always the same for the same scene; the device walks them.

mod bodies;
mod bvh;
mod shape;

use std::collections::BTreeMap;

use bodies::Bodies;
use bytemuck::{Pod, Zeroable};
use shape::Shapes;
use simworld_core::scene::Scene;

use crate::RenderError;
use crate::batch::{Layout, Projection, ViewRequest};
use crate::gpu::{Features, Globals, Gpu, Planes, Scenery, raycast_source};
use crate::resident::Residents;
use crate::view::View;

/// Pixels that one workgroup casts, each way, as in raycast.wgsl.
const TILE: u32 = 8;
/// Storage buffers that it binds.
pub(crate) const BUFFERS: u32 = 9;
/// Views that one dispatch takes.
pub(crate) const MOST_VIEWS: usize = 65_535;

/// What one dispatch finds besides depth and ids.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Cast {
    /// Colour, of pictures that need these.
    Color(Features),
    /// Normals.
    Normals,
    /// Nothing.
    Alone,
}

/// The twin of `View` in raycast.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Eye {
    globals: Globals,
    place: [f32; 4],
    limits: [f32; 4],
    span: [u32; 4],
    hidden: [u32; 4],
}

/// Trees and pipelines of the ray-cast backend.
pub(crate) struct Raycast {
    shapes: Shapes,
    bodies: Bodies,
    /// Numbers whose instances changed since the trees last followed.
    noted: Vec<u32>,
    layout: wgpu::BindGroupLayout,
    module: wgpu::ShaderModule,
    pipeline_layout: wgpu::PipelineLayout,
    /// By what is found, and whether the rays are those of a table.
    pipelines: BTreeMap<(Cast, bool), wgpu::ComputePipeline>,
    /// Those of the batch at hand.
    prepared: Vec<(Cast, bool)>,
    /// The table of rays of the batch at hand: directions of length one, optical frame.
    rays: wgpu::Buffer,
    views: wgpu::Buffer,
    nodes: wgpu::Buffer,
    placed: wgpu::Buffer,
    pieces: wgpu::Buffer,
    /// Pieces of four words that are on the device.
    sent: usize,
}

/// What is looked at, and how.
pub(crate) struct Look<'a> {
    pub views: &'a [View],
    pub globals: &'a [Globals],
    pub requests: &'a [ViewRequest],
    pub layout: &'a Layout,
    pub min_pixels: f64,
    /// The rays of the only view, where they are those of a table: directions of length one in the optical frame.
    pub table: Option<&'a [[f32; 4]]>,
}

impl Raycast {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let entry = |binding: u32| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only: binding < 5 || binding == 8 },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let entries: Vec<_> = (0..BUFFERS).map(entry).collect();
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("raycast"),
            entries: &entries,
        });
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("raycast"),
            source: wgpu::ShaderSource::Wgsl(raycast_source().into()),
        });
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("raycast"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let buffer = |size| storage(gpu, size);
        Self {
            shapes: Shapes::new(),
            bodies: Bodies::new(),
            noted: Vec::new(),
            module,
            pipeline_layout,
            pipelines: BTreeMap::new(),
            prepared: Vec::new(),
            rays: buffer(1024),
            layout,
            views: buffer(1024),
            nodes: buffer(1024),
            placed: buffer(1024),
            pieces: buffer(1024),
            sent: 0,
        }
    }

    /// Notes what the trees have to follow when they are used next.
    pub(crate) fn note(&mut self, changed: &[u32]) {
        self.noted.extend_from_slice(changed);
    }

    /// Brings the trees up to date, and sends what changed of them, with the views.
    pub(crate) fn hold(
        &mut self,
        gpu: &Gpu,
        scene: &dyn Scene,
        residents: &Residents,
        look: &Look<'_>,
    ) -> Result<(), RenderError> {
        self.noted.sort_unstable();
        self.noted.dedup();
        let all = self.bodies.follow(scene, &mut self.shapes, residents, &self.noted);
        let is_new = ensure(gpu, &mut self.placed, &self.bodies.placed)?;
        if all || is_new {
            gpu.queue.write_buffer(&self.placed, 0, bytemuck::cast_slice(&self.bodies.placed));
        } else if let (Some(first), Some(last)) = (self.noted.first(), self.noted.last()) {
            let range = *first as usize..=*last as usize;
            let offset = u64::from(*first) * size_of::<bodies::Placed>() as u64;
            gpu.queue.write_buffer(&self.placed, offset, bytemuck::cast_slice(&self.bodies.placed[range]));
        }
        self.noted.clear();
        let is_new = ensure(gpu, &mut self.nodes, &self.bodies.nodes)?;
        let first = if all || is_new { 0 } else { self.bodies.second as usize };
        let offset = (first * size_of::<bodies::Node>()) as u64;
        gpu.queue.write_buffer(&self.nodes, offset, bytemuck::cast_slice(&self.bodies.nodes[first..]));
        if ensure(gpu, &mut self.pieces, &self.shapes.pieces)? {
            self.sent = 0;
        }
        if self.sent < self.shapes.pieces.len() {
            let offset = self.sent as u64 * 16;
            gpu.queue.write_buffer(
                &self.pieces,
                offset,
                bytemuck::cast_slice(&self.shapes.pieces[self.sent..]),
            );
            self.sent = self.shapes.pieces.len();
        }
        if let Some(rays) = look.table {
            ensure(gpu, &mut self.rays, rays)?;
            gpu.queue.write_buffer(&self.rays, 0, bytemuck::cast_slice(rays));
        }
        let eyes = self.eyes(look);
        ensure(gpu, &mut self.views, &eyes)?;
        gpu.queue.write_buffer(&self.views, 0, bytemuck::cast_slice(&eyes));
        Ok(())
    }

    fn eyes(&self, look: &Look<'_>) -> Vec<Eye> {
        let one = |index: usize| {
            let (view, span) = (&look.views[index], &look.layout.spans[index]);
            let eye = view.eye.coords - self.bodies.origin;
            let focal = view.intrinsics.fx.max(view.intrinsics.fy);
            let request = &look.requests[index];
            let hidden = request.hidden.map_or(u32::MAX, |id| id.index() as u32 + 1);
            let only = request.only.map_or(0, |id| id.index() as u32 + 1);
            Eye {
                globals: look.globals[index],
                place: crate::view::vec4(&eye, view.near),
                limits: [view.far as f32, look.min_pixels as f32, focal as f32, 0.0],
                span: [span.first as u32, span.pitch, span.width, span.height],
                hidden: [
                    hidden,
                    self.bodies.second,
                    only,
                    u32::from(request.projection == Projection::Parallel),
                ],
            }
        };
        (0..look.views.len()).map(one).collect()
    }

    /// Makes ready what a batch is cast with, a dispatch for each of these.
    pub(crate) fn prepare(&mut self, gpu: &Gpu, casts: &[Cast], by_table: bool) {
        self.prepared = casts.iter().map(|cast| (*cast, by_table)).collect();
        for (cast, by_table) in &self.prepared {
            let (module, layout) = (&self.module, &self.pipeline_layout);
            self.pipelines.entry((*cast, *by_table)).or_insert_with(|| {
                let bits = if let Cast::Color(features) = cast { features.bits() } else { 0 };
                let flag = |is: bool| f64::from(u8::from(is));
                let constants = [
                    ("SHADED", flag(matches!(cast, Cast::Color(_)))),
                    ("FACING", flag(*cast == Cast::Normals)),
                    ("TABLE", flag(*by_table)),
                    ("FEATURES", f64::from(bits)),
                ];
                gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some("raycast"),
                    layout: Some(layout),
                    module,
                    entry_point: Some("cast_views"),
                    compilation_options: wgpu::PipelineCompilationOptions {
                        constants: &constants,
                        ..Default::default()
                    },
                    cache: None,
                })
            });
        }
    }

    /// Records the dispatches of a batch; does nothing before they were [prepared](Self::prepare).
    pub(crate) fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        scenery: &Scenery,
        planes: &Planes,
        layout: &Layout,
    ) {
        let [width, height] = layout.largest;
        for (cast, by_table) in &self.prepared {
            let Some(pipeline) = self.pipelines.get(&(*cast, *by_table)) else { return };
            let [color, depth, who] = &planes.raw;
            // Each of them takes the place of what is not needed beside it.
            let first = if *cast == Cast::Normals { &planes.normals } else { color };
            let last = if *by_table { &self.rays } else { &scenery.lights };
            let trees = [&self.nodes, &self.placed, &self.pieces];
            let buffers = [&self.views, &scenery.instances].into_iter().chain(trees);
            let buffers = buffers.chain([first, depth, who, last]);
            let entries: Vec<wgpu::BindGroupEntry<'_>> = (0..)
                .zip(buffers)
                .map(|(binding, buffer)| wgpu::BindGroupEntry {
                    binding,
                    resource: buffer.as_entire_binding(),
                })
                .collect();
            let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("raycast"),
                layout: &self.layout,
                entries: &entries,
            });
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups(width.div_ceil(TILE), height.div_ceil(TILE), layout.spans.len() as u32);
        }
    }
}

fn storage(gpu: &Gpu, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("trees"),
        size,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// Makes room for these; true if the buffer is a new one.
fn ensure<T: Pod>(gpu: &Gpu, buffer: &mut wgpu::Buffer, wanted: &[T]) -> Result<bool, RenderError> {
    let size = size_of_val(wanted) as u64;
    if size <= buffer.size() {
        return Ok(false);
    }
    let limits = gpu.device.limits();
    let limit = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
    if size > limit {
        return Err(RenderError::TooMany {
            count: wanted.len(),
            limit: (limit / size_of::<T>() as u64) as usize,
        });
    }
    *buffer = storage(gpu, size.next_power_of_two().min(limit));
    gpu.check()?;
    Ok(true)
}
