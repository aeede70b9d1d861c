//! The pipelines of triangles, each made the first time that something is drawn with it: for every pattern one, specialised by an override constant, so
//! that no pixel pays for another's painting; for the sky, for what falls, for measures, normals and shadows one each.

use std::collections::BTreeMap;

use bitflags::bitflags;

use super::device::Gpu;
use super::programs::Program;
use super::targets::{COLOR, DEPTH, ID, SAMPLES, Z};
use crate::config::AntiAliasing;
use crate::mesh::{Pattern, Vertex};
use crate::resident::Instance;

/// The slot of the tangents of models, behind those of vertices and instances.
pub(crate) const TANGENTS: u32 = 2;

/// What is drawn in one way: the key of a pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Brush {
    /// RGB with the measures, or RGB alone where it is smoothed.
    Picture(Features, Pattern, Matter),
    /// Depth and ids alone, where RGB is smoothed or not asked for.
    Measures(Matter),
    /// Normals alone.
    Normals(Matter),
    /// Depth as the sun sees it.
    Shadow(Matter),
    /// What nothing covers.
    Sky,
    /// Rain and snow over the picture.
    Precipitation,
    /// Which surface of a layer of what is blended is nearest, with depth and ids of what counts.
    Nearest(Features, Layer),
    /// Its colour over what is there; the same code, so that it has the same z.
    Laid(Features, Layer),
}

/// Which triangles of a mesh, by their numbers in sift.wgsl.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u32)]
pub(crate) enum Matter {
    /// Those that are there as a whole.
    Whole = 0,
    /// Those of models of which something is cut out.
    Cut = 1,
    /// Those of models whose colour is laid over what is behind them.
    Film = 2,
}

impl Matter {
    pub(crate) const ALL: [Self; 3] = [Self::Whole, Self::Cut, Self::Film];

    /// What it is to depth, ids, normals and shadows: what is blended is cut out below a half.
    pub(crate) const fn counted(self) -> Self {
        match self {
            Self::Film => Self::Cut,
            other => other,
        }
    }
}

/// A layer of what is blended, the lower first; their numbers are those of LAYER in `forward_models.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u32)]
pub(crate) enum Layer {
    /// What counts for depth and ids: of which a half or more is there.
    Counted = 1,
    /// What does not.
    Thin = 2,
}

/// The pipelines that were made so far.
pub(crate) struct Pipelines {
    made: BTreeMap<Brush, wgpu::RenderPipeline>,
    workshop: Workshop,
}

/// What pipelines are made from.
struct Workshop {
    /// Those that some pipeline was made from.
    modules: BTreeMap<Program, wgpu::ShaderModule>,
    layouts: Layouts,
    /// Whether RGB is smoothed.
    smooth: bool,
}

/// What is bound beside [`Scenery`](super::Scenery).
struct Layouts {
    /// Of the scenery: globals of a view, and its light.
    scenery: wgpu::BindGroupLayout,
    /// Nothing.
    plain: wgpu::PipelineLayout,
    /// A shadow map.
    lit: wgpu::PipelineLayout,
    /// A shadow map, and the pictures of models.
    model: wgpu::PipelineLayout,
    /// The pictures of models.
    cut: wgpu::PipelineLayout,
}

bitflags! {
    /// What a picture needs beyond sun and sky; the bits of FEATURES in shaders/shading.wgsl.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
    pub(crate) struct Features: u32 {
        const LAMPS = 1;
        const WATER = 2;
        const SNOW = 4;
        /// Of rays alone: triangles of models have a pipeline of their own.
        const MODELS = 8;
        /// Of rays alone, too: some of these are cut out.
        const CUTS = 16;
    }
}

/// How a pipeline differs from others.
struct Variant {
    label: &'static str,
    program: Program,
    vertex: &'static str,
    fragment: Option<&'static str>,
    constants: Vec<(&'static str, f64)>,
    targets: Vec<Option<wgpu::ColorTargetState>>,
    depth: wgpu::DepthStencilState,
    samples: u32,
    /// Whether it reads vertices and instances.
    meshes: bool,
}

impl Pipelines {
    /// None yet.
    pub(crate) fn new(
        gpu: &Gpu,
        shadows: &wgpu::BindGroupLayout,
        store: &wgpu::BindGroupLayout,
        smoothing: AntiAliasing,
    ) -> Self {
        let layouts = Layouts::new(&gpu.device, shadows, store);
        let smooth = smoothing == AntiAliasing::Msaa4;
        Self { made: BTreeMap::new(), workshop: Workshop { modules: BTreeMap::new(), layouts, smooth } }
    }

    /// The layout of [`Scenery`](super::Scenery).
    pub(crate) const fn scenery(&self) -> &wgpu::BindGroupLayout {
        &self.workshop.layouts.scenery
    }

    /// The pipeline of a brush, made the first time that it is asked for. What goes wrong there the device [tells](Gpu::check).
    pub(crate) fn of(&mut self, gpu: &Gpu, brush: Brush) -> &wgpu::RenderPipeline {
        let Self { made, workshop } = self;
        made.entry(brush).or_insert_with(|| workshop.make(gpu, brush))
    }

    /// Those that were made so far.
    #[cfg(test)]
    pub(crate) fn made(&self) -> Vec<Brush> {
        self.made.keys().copied().collect()
    }
}

impl Layouts {
    fn new(device: &wgpu::Device, shadows: &wgpu::BindGroupLayout, store: &wgpu::BindGroupLayout) -> Self {
        let scenery = scenery_layout(device);
        let layout = |groups: &[Option<&wgpu::BindGroupLayout>]| {
            device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: None,
                bind_group_layouts: groups,
                immediate_size: 0,
            })
        };
        let (plain, lit) = (layout(&[Some(&scenery)]), layout(&[Some(&scenery), Some(shadows)]));
        let model = layout(&[Some(&scenery), Some(shadows), Some(store)]);
        let cut = layout(&[Some(&scenery), None, Some(store)]);
        Self { scenery, plain, lit, model, cut }
    }

    fn of(&self, brush: Brush) -> &wgpu::PipelineLayout {
        match brush {
            Brush::Picture(_, Pattern::Model, _) | Brush::Nearest(..) | Brush::Laid(..) => &self.model,
            Brush::Picture(..) => &self.lit,
            Brush::Measures(Matter::Whole)
            | Brush::Normals(Matter::Whole)
            | Brush::Shadow(Matter::Whole)
            | Brush::Sky
            | Brush::Precipitation => &self.plain,
            Brush::Measures(_) | Brush::Normals(_) | Brush::Shadow(_) => &self.cut,
        }
    }
}

impl Workshop {
    fn make(&mut self, gpu: &Gpu, brush: Brush) -> wgpu::RenderPipeline {
        let Variant { label, program, vertex, fragment, constants, targets, depth, samples, meshes } =
            Variant::of(brush, self.smooth);
        let module = self.modules.entry(program).or_insert_with(|| program.module(gpu));
        let options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
        let buffers = [Some(vertex_layout()), Some(instance_layout()), Some(tangent_layout())];
        let read = match (meshes, program) {
            (true, Program::Forward(Pattern::Model)) => &buffers[..],
            (true, _) => &buffers[..TANGENTS as usize],
            (false, _) => &buffers[..0],
        };
        gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(label),
            layout: Some(self.layouts.of(brush)),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(vertex),
                compilation_options: options.clone(),
                buffers: read,
            },
            primitive: wgpu::PrimitiveState {
                cull_mode: meshes.then_some(wgpu::Face::Back),
                ..Default::default()
            },
            depth_stencil: Some(depth),
            multisample: wgpu::MultisampleState { count: samples, ..Default::default() },
            fragment: fragment.map(|entry| wgpu::FragmentState {
                module,
                entry_point: Some(entry),
                compilation_options: options,
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

#[expect(clippy::unnecessary_wraps, reason = "wgpu takes every target as an option")]
fn target(format: wgpu::TextureFormat, write_mask: wgpu::ColorWrites) -> Option<wgpu::ColorTargetState> {
    Some(wgpu::ColorTargetState { format, blend: None, write_mask })
}

/// Colour that is laid over what is there by its alpha.
#[expect(clippy::unnecessary_wraps, reason = "wgpu takes every target as an option")]
fn overlay(format: wgpu::TextureFormat) -> Option<wgpu::ColorTargetState> {
    let blend = Some(wgpu::BlendState::ALPHA_BLENDING);
    Some(wgpu::ColorTargetState { format, blend, write_mask: wgpu::ColorWrites::COLOR })
}

fn depth_state(compare: wgpu::CompareFunction, bias: wgpu::DepthBiasState) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: Z,
        depth_write_enabled: Some(true),
        depth_compare: Some(compare),
        stencil: wgpu::StencilState::default(),
        bias,
    }
}

impl Variant {
    fn of(brush: Brush, smooth: bool) -> Self {
        match brush {
            Brush::Picture(features, pattern, matter) => Self::picture(features, pattern, matter, smooth),
            Brush::Measures(matter) => Self::measures(matter),
            Brush::Normals(matter) => Self::normals(matter),
            Brush::Shadow(matter) => Self::shadow(matter),
            Brush::Sky => Self::sky(smooth),
            Brush::Precipitation => Self::precipitation(smooth),
            Brush::Nearest(features, layer) => Self::nearest(features, layer, smooth),
            Brush::Laid(features, layer) => Self::laid(features, layer, smooth),
        }
    }

    /// What all of them share that draw meshes: the nearest is seen, in reverse z.
    fn of_meshes(label: &'static str, program: Program, vertex: &'static str) -> Self {
        Self {
            label,
            program,
            vertex,
            fragment: None,
            constants: Vec::new(),
            targets: Vec::new(),
            depth: depth_state(wgpu::CompareFunction::Greater, wgpu::DepthBiasState::default()),
            samples: 1,
            meshes: true,
        }
    }

    /// With RGB as the first target: alone with several samples a pixel where it is smoothed.
    fn with_color(
        self,
        [color, everything]: [&'static str; 2],
        mut targets: Vec<Option<wgpu::ColorTargetState>>,
        smooth: bool,
    ) -> Self {
        if smooth {
            targets.truncate(1);
        }
        let fragment = Some(if smooth { color } else { everything });
        Self { fragment, targets, samples: if smooth { SAMPLES } else { 1 }, ..self }
    }

    fn picture(features: Features, pattern: Pattern, matter: Matter, smooth: bool) -> Self {
        let all = wgpu::ColorWrites::ALL;
        let (vertex, fragments) = match pattern {
            Pattern::Model => ("vertex_model", ["fragment_model_color", "fragment_model_all"]),
            _ => ("vertex_main", ["fragment_color", "fragment_all"]),
        };
        let mut constants =
            vec![("PATTERN", f64::from(pattern as u32)), ("FEATURES", f64::from(features.bits()))];
        if pattern == Pattern::Model {
            constants.push(("CUT", f64::from(u8::from(matter != Matter::Whole))));
        }
        Self { constants, ..Self::of_meshes("picture", Program::Forward(pattern), vertex) }.with_color(
            fragments,
            vec![target(COLOR, all), target(DEPTH, all), target(ID, all)],
            smooth,
        )
    }

    /// Of what is blended, its triangles as a picture has them, without its colour yet.
    fn nearest(features: Features, layer: Layer, smooth: bool) -> Self {
        let (all, none) = (wgpu::ColorWrites::ALL, wgpu::ColorWrites::empty());
        let measures = if layer == Layer::Counted { all } else { none };
        let mut variant = Self::picture(features, Pattern::Model, Matter::Film, smooth);
        variant.label = "nearest";
        variant.constants.push(("LAYER", f64::from(layer as u32)));
        let targets = [target(COLOR, none), target(DEPTH, measures), target(ID, measures)];
        for (known, wanted) in variant.targets.iter_mut().zip(targets) {
            *known = wanted;
        }
        variant
    }

    /// Its colour, where it is nearest.
    fn laid(features: Features, layer: Layer, smooth: bool) -> Self {
        let none = wgpu::ColorWrites::empty();
        let mut variant = Self::nearest(features, layer, smooth);
        variant.label = "laid";
        variant.depth = depth_state(wgpu::CompareFunction::Equal, wgpu::DepthBiasState::default());
        variant.depth.depth_write_enabled = Some(false);
        for (known, wanted) in
            variant.targets.iter_mut().zip([overlay(COLOR), target(DEPTH, none), target(ID, none)])
        {
            *known = wanted;
        }
        variant
    }

    fn measures(matter: Matter) -> Self {
        let all = wgpu::ColorWrites::ALL;
        let (program, vertex, fragment) = match matter {
            Matter::Whole => (Program::Measures, "vertex_measures", "fragment_measures"),
            Matter::Cut | Matter::Film => (Program::Cutouts, "vertex_cut", "fragment_cut_measures"),
        };
        Self {
            fragment: Some(fragment),
            targets: vec![target(DEPTH, all), target(ID, all)],
            ..Self::of_meshes("measures", program, vertex)
        }
    }

    fn normals(matter: Matter) -> Self {
        let (program, vertex, fragment) = match matter {
            Matter::Whole => (Program::Normals, "vertex_normals", "fragment_normals"),
            Matter::Cut | Matter::Film => (Program::Cutouts, "vertex_cut", "fragment_cut_normals"),
        };
        Self {
            fragment: Some(fragment),
            targets: vec![target(ID, wgpu::ColorWrites::ALL)],
            ..Self::of_meshes("normals", program, vertex)
        }
    }

    fn shadow(matter: Matter) -> Self {
        let bias = wgpu::DepthBiasState { constant: 2, slope_scale: 1.5, clamp: 0.0 };
        let (program, vertex, fragment) = match matter {
            Matter::Whole => (Program::Shadow, "vertex_shadow", None),
            Matter::Cut | Matter::Film => {
                (Program::Cutouts, "vertex_cut_shadow", Some("fragment_cut_shadow"))
            }
        };
        Self {
            fragment,
            depth: depth_state(wgpu::CompareFunction::Less, bias),
            ..Self::of_meshes("shadow", program, vertex)
        }
    }

    fn sky(smooth: bool) -> Self {
        let (all, none) = (wgpu::ColorWrites::ALL, wgpu::ColorWrites::empty());
        // Infinity, where nothing was drawn.
        let depth = depth_state(wgpu::CompareFunction::Equal, wgpu::DepthBiasState::default());
        Self { depth, meshes: false, ..Self::of_meshes("sky", Program::Sky, "vertex_sky") }.with_color(
            ["fragment_sky", "fragment_sky_all"],
            vec![target(COLOR, all), target(DEPTH, none), target(ID, none)],
            smooth,
        )
    }

    fn precipitation(smooth: bool) -> Self {
        let none = wgpu::ColorWrites::empty();
        let mut variant = Self::of_meshes("precipitation", Program::Precipitation, "vertex_drop");
        variant.depth.depth_write_enabled = Some(false);
        variant.meshes = false;
        variant.with_color(
            ["fragment_drop", "fragment_drop_all"],
            vec![overlay(COLOR), target(DEPTH, none), target(ID, none)],
            smooth,
        )
    }
}

fn vertex_layout() -> wgpu::VertexBufferLayout<'static> {
    const ATTRIBUTES: [wgpu::VertexAttribute; 4] =
        wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3, 3 => Uint32];
    wgpu::VertexBufferLayout {
        array_stride: size_of::<Vertex>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &ATTRIBUTES,
    }
}

/// The instances that are drawn, one behind the other: a vertex finds its own without a look into a buffer.
fn instance_layout() -> wgpu::VertexBufferLayout<'static> {
    const ATTRIBUTES: [wgpu::VertexAttribute; 7] = wgpu::vertex_attr_array![
        4 => Float32x4, 5 => Float32x4, 6 => Float32x3, 7 => Uint32, 8 => Float32x4, 9 => Float32x4, 10 => Float32x4
    ];
    wgpu::VertexBufferLayout {
        array_stride: size_of::<Instance>() as u64,
        step_mode: wgpu::VertexStepMode::Instance,
        attributes: &ATTRIBUTES,
    }
}

/// The tangents of a model, a word each: whoever draws no colour of it reads none.
fn tangent_layout() -> wgpu::VertexBufferLayout<'static> {
    const ATTRIBUTES: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![11 => Uint32];
    wgpu::VertexBufferLayout {
        array_stride: size_of::<u32>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &ATTRIBUTES,
    }
}

fn scenery_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let entry = |binding, visibility, ty, has_dynamic_offset| wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset, min_binding_size: None },
        count: None,
    };
    let stages = wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE;
    let data = wgpu::BufferBindingType::Storage { read_only: true };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("scenery"),
        entries: &[
            entry(0, stages, wgpu::BufferBindingType::Uniform, true),
            // The sky and the lamps, and the sky alone.
            entry(1, stages, data, false),
            entry(2, stages, wgpu::BufferBindingType::Uniform, false),
        ],
    })
}
