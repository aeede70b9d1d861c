//! The ray-cast backend: every view of a batch at once, in steps: of what rays meet, of the sun's light there, of its colour, and of what falls before it.
//!
//! Two levels: a tree of boxes over the triangles of each mesh, and two over entities, one over what stands still and one over what
//! moves. They are made on the CPU, always the same for the same scene; the device walks them.

mod bodies;
mod bvh;
mod halves;
mod nodes;
mod shape;
mod soup;

use std::collections::BTreeMap;

use bodies::{Bodies, Followed};
use bytemuck::{Pod, Zeroable};
use shape::{MOST_PIECES, Shapes};
use simworld_core::scene::Scene;

use crate::RenderError;
use crate::batch::{Layout, Projection, ViewRequest};
use crate::falling::Falling;
use crate::gpu::{Features, Globals, Gpu, Planes, Program, Scenery, Texels, Timing, runs};
use crate::resident::Residents;
use crate::view::View;

/// Pixels that one workgroup finds or lights, each way, as in cast.wgsl.
const TILE: u32 = 8;
/// Pixels that one workgroup paints, or lets rain fall before, each way.
const PAINTED: u32 = 16;
/// Storage buffers that each step binds.
pub(crate) const BUFFERS: u32 = 9;
/// Views that one dispatch takes.
pub(crate) const MOST_VIEWS: usize = 65_535;

/// What a batch wants besides depth and ids.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Cast {
    /// Colour, of pictures that need these.
    Color(Features),
    /// Normals.
    Normals,
    /// Nothing.
    Alone,
}

/// What of the parts that are blended view rays meet, by the numbers of FILMS in rays.wgsl.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u32)]
enum Films {
    /// What counts, beside everything else.
    Too = 0,
    /// Nothing.
    Not = 1,
    /// What counts, and nothing else.
    Counted = 2,
    /// What is thinner, and nothing else.
    Thin = 3,
}

/// One dispatch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Step {
    Find(Films),
    Light,
    Paint(Cast),
    /// Lays a layer of what is blended over a picture that needs these.
    Glaze(Films, Features),
    Fall,
}

impl Step {
    /// Its entry point, and the buffers that it binds by their numbers in rays.wgsl and cast.wgsl.
    const fn binds(self) -> (&'static str, [u32; BUFFERS as usize]) {
        match self {
            Self::Find(_) => ("find", [0, 1, 2, 3, 4, 5, 6, 7, 10]),
            Self::Light => ("light", [0, 1, 2, 3, 4, 5, 6, 7, 10]),
            Self::Paint(Cast::Color(_)) => ("paint", [0, 1, 4, 5, 6, 7, 8, 9, 10]),
            Self::Paint(_) => ("measure", [0, 1, 4, 5, 6, 7, 8, 9, 10]),
            Self::Glaze(..) => ("glaze", [0, 1, 2, 3, 4, 5, 6, 7, 8]),
            Self::Fall => ("fall", [0, 1, 4, 5, 6, 7, 8, 9, 10]),
        }
    }
}

/// What the rays of a batch are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Rays {
    /// Whether they are those of a table.
    pub by_table: bool,
    /// Whether they may meet what is cut out.
    pub cuts: bool,
    /// Whether they may meet what is blended.
    pub films: bool,
}

/// The twin of `View` in rays.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Eye {
    globals: Globals,
    place: [f32; 4],
    limits: [f32; 4],
    span: [u32; 4],
    hidden: [u32; 4],
    falling: [u32; 4],
}

/// Trees and pipelines of the ray-cast backend.
pub(crate) struct Raycast {
    shapes: Shapes,
    bodies: Bodies,
    /// Numbers whose instances changed since the trees last followed.
    noted: Vec<u32>,
    module: wgpu::ShaderModule,
    pipelines: BTreeMap<(Step, Rays), wgpu::ComputePipeline>,
    /// Those of the batch at hand.
    prepared: Vec<(Step, Rays)>,
    /// The table of rays of the batch at hand: directions of length one, optical frame.
    rays: wgpu::Buffer,
    views: wgpu::Buffer,
    nodes: wgpu::Buffer,
    placed: wgpu::Buffer,
    pieces: wgpu::Buffer,
    /// Pieces of four words that are on the device.
    sent: usize,
    /// The pictures of models, and their layout.
    store: wgpu::BindGroup,
    store_layout: wgpu::BindGroupLayout,
}

/// What is looked at, and how.
pub(crate) struct Look<'a> {
    pub views: &'a [View],
    pub globals: &'a [Globals],
    pub requests: &'a [ViewRequest],
    pub layout: &'a Layout,
    pub falling: &'a [Falling],
    pub min_pixels: f64,
    /// The pictures of models.
    pub store: &'a wgpu::BindGroup,
    /// Whether everything is seen at its finest level.
    pub finest: bool,
    /// The rays of the only view, where they are those of a table: directions of length one in the optical frame.
    pub table: Option<&'a [[f32; 4]]>,
}

impl Raycast {
    pub(crate) fn new(gpu: &Gpu, store: &Texels) -> Self {
        let buffer = |size| storage(gpu, size);
        Self {
            shapes: Shapes::new(),
            bodies: Bodies::new(),
            noted: Vec::new(),
            module: Program::Rays.module(gpu),
            pipelines: BTreeMap::new(),
            prepared: Vec::new(),
            rays: buffer(1024),
            views: buffer(1024),
            nodes: buffer(1024),
            placed: buffer(1024),
            pieces: buffer(1024),
            sent: 0,
            store: store.group().clone(),
            store_layout: store.layout().clone(),
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
        let followed = self.bodies.follow(scene, &mut self.shapes, residents, &self.noted);
        self.noted.clear();
        let pieces = self.shapes.pieces.len();
        if pieces > MOST_PIECES {
            return Err(RenderError::TooMany { count: pieces, limit: MOST_PIECES });
        }
        if followed != Followed::Nothing {
            self.send_trees(gpu, followed)?;
        }
        if ensure(gpu, &mut self.pieces, &self.shapes.pieces)? {
            self.sent = 0;
        }
        let (sent, count) = (self.sent, self.shapes.pieces.len());
        let rewritten = self.shapes.rewritten.drain(..).filter(|run| run.end <= sent);
        for run in rewritten.chain((sent < count).then_some(sent..count)) {
            let offset = run.start as u64 * 16;
            gpu.queue.write_buffer(&self.pieces, offset, bytemuck::cast_slice(&self.shapes.pieces[run]));
        }
        self.sent = count;
        if let Some(rays) = look.table {
            ensure(gpu, &mut self.rays, rays)?;
            gpu.queue.write_buffer(&self.rays, 0, bytemuck::cast_slice(rays));
        }
        self.store = look.store.clone();
        let eyes = self.eyes(look);
        ensure(gpu, &mut self.views, &eyes)?;
        gpu.queue.write_buffer(&self.views, 0, bytemuck::cast_slice(&eyes));
        Ok(())
    }

    /// Sends what changed of the trees.
    fn send_trees(&mut self, gpu: &Gpu, followed: Followed) -> Result<(), RenderError> {
        let is_new = ensure(gpu, &mut self.placed, &self.bodies.placed)?;
        let everything = is_new || followed == Followed::All;
        let count = self.bodies.placed.len() as u32;
        for run in runs(&mut self.bodies.changed, everything.then_some(count)) {
            let offset = u64::from(run.start) * size_of::<bodies::Placed>() as u64;
            let placed = &self.bodies.placed[run.start as usize..run.end as usize];
            gpu.queue.write_buffer(&self.placed, offset, bytemuck::cast_slice(placed));
        }
        let is_new = ensure(gpu, &mut self.nodes, &self.bodies.nodes)?;
        let everything = is_new || followed == Followed::All;
        let (first, end) = (self.bodies.second, self.bodies.nodes.len() as u32);
        let patches = runs(&mut self.bodies.patched, everything.then_some(first));
        for run in patches.into_iter().chain(std::iter::once(first..end)) {
            let offset = u64::from(run.start) * size_of::<nodes::Node>() as u64;
            let nodes = &self.bodies.nodes[run.start as usize..run.end as usize];
            gpu.queue.write_buffer(&self.nodes, offset, bytemuck::cast_slice(nodes));
        }
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
                limits: [
                    view.far as f32,
                    look.min_pixels as f32,
                    focal as f32,
                    f32::from(u8::from(look.finest)),
                ],
                span: [span.first as u32, span.pitch, span.width, span.height],
                hidden: [
                    hidden,
                    self.bodies.second,
                    only,
                    u32::from(request.projection == Projection::Parallel),
                ],
                falling: [look.falling[index].count, 0, 0, 0],
            }
        };
        (0..look.views.len()).map(one).collect()
    }

    /// Makes ready what a batch is cast with.
    pub(crate) fn prepare(&mut self, gpu: &Gpu, casts: &[Cast], falling: &[Falling], rays: Rays) {
        let color = casts.iter().copied().find(|cast| matches!(cast, Cast::Color(_)));
        let normals = casts.contains(&Cast::Normals).then_some(Step::Paint(Cast::Normals));
        let falls = color.is_some() && falling.iter().any(|one| one.count > 0);
        let fall = falls.then_some(Step::Fall);
        let steps = match color {
            Some(Cast::Color(features)) if rays.films && !rays.by_table => glazed(features, normals, fall),
            _ => {
                // Colour is painted over what normals are reckoned from.
                let last = Step::Paint(color.unwrap_or(Cast::Alone));
                let light = color.map(|_| Step::Light);
                vec![Some(Step::Find(Films::Too)), light, normals, Some(last), fall]
            }
        };
        self.prepared = steps.into_iter().flatten().map(|step| (step, rays)).collect();
        for key in &self.prepared {
            let (module, store) = (&self.module, &self.store_layout);
            self.pipelines.entry(*key).or_insert_with(|| pipeline(gpu, module, store, *key));
        }
    }

    /// Records the dispatches of a batch; does nothing before they were [prepared](Self::prepare).
    pub(crate) fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        timing: &mut Timing,
        scenery: &Scenery,
        planes: &Planes,
        layout: &Layout,
    ) {
        let [width, height] = layout.largest;
        let [color, depth, who] = &planes.raw;
        let scene = [&self.views, &scenery.instances, &self.nodes, &self.placed, &self.pieces];
        let rest = [color, depth, who, &scenery.lights, &planes.normals, &self.rays];
        let buffers: Vec<&wgpu::Buffer> = scene.into_iter().chain(rest).collect();
        for key in &self.prepared {
            let Some(pipeline) = self.pipelines.get(key) else { return };
            let entries = key.0.binds().1.map(|binding| wgpu::BindGroupEntry {
                binding,
                resource: buffers[binding as usize].as_entire_binding(),
            });
            let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("raycast"),
                layout: &pipeline.get_bind_group_layout(0),
                entries: &entries,
            });
            let mut pass = encoder.begin_compute_pass(&timing.pass(key.0.binds().0));
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.set_bind_group(1, &self.store, &[]);
            let tile = if matches!(key.0, Step::Paint(_) | Step::Fall) { PAINTED } else { TILE };
            pass.dispatch_workgroups(width.div_ceil(tile), height.div_ceil(tile), layout.spans.len() as u32);
        }
    }
}

/// The steps of a picture in which something is blended: what is behind that is painted first, and it is laid over in two layers, between which it rains. Normals are those of what counts,
/// which is found for them beforehand.
fn glazed(features: Features, normals: Option<Step>, fall: Option<Step>) -> Vec<Option<Step>> {
    let glaze = |films| Some(Step::Glaze(films, features));
    vec![
        normals.map(|_| Step::Find(Films::Too)),
        normals,
        Some(Step::Find(Films::Not)),
        Some(Step::Light),
        Some(Step::Paint(Cast::Color(features))),
        glaze(Films::Counted),
        fall,
        glaze(Films::Thin),
    ]
}

fn pipeline(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    store: &wgpu::BindGroupLayout,
    (step, rays): (Step, Rays),
) -> wgpu::ComputePipeline {
    let (entry_point, bindings) = step.binds();
    let entries = bindings.map(|binding| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: !matches!(binding, 5..=7 | 9) },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    });
    let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("raycast"),
        entries: &entries,
    });
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("raycast"),
        bind_group_layouts: &[Some(&layout), Some(store)],
        immediate_size: 0,
    });
    let flag = |is: bool| f64::from(u8::from(is));
    let mut constants = vec![("TABLE", flag(rays.by_table))];
    let features = match step {
        Step::Paint(Cast::Color(features)) => features,
        Step::Glaze(_, features) => features | Features::CUTS,
        Step::Find(_) | Step::Light if rays.cuts => Features::CUTS,
        _ => Features::empty(),
    };
    constants.push(("FEATURES", f64::from(features.bits())));
    constants.push(("FACING", flag(step == Step::Paint(Cast::Normals))));
    let films = match step {
        Step::Find(films) | Step::Glaze(films, _) => films,
        _ => Films::Too,
    };
    constants.push(("FILMS", f64::from(films as u32)));
    gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("raycast"),
        layout: Some(&layout),
        module,
        entry_point: Some(entry_point),
        compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
        cache: None,
    })
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
