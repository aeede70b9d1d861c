//! The pipelines: scene, sky, shadow.

use std::mem::size_of;

use crate::device::Gpu;
use crate::gather::Instance;
use crate::mesh::Vertex;
use crate::targets::{COLOR, DEPTH, IDS, Z};

const VERTEX: [wgpu::VertexAttribute; 3] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Uint32];
const INSTANCE: [wgpu::VertexAttribute; 9] = wgpu::vertex_attr_array![
    3 => Float32x3, 4 => Float32x3, 5 => Float32x3, 6 => Float32x3, 7 => Float32x3, 8 => Float32x3,
    9 => Uint32, 10 => Uint32, 11 => Uint32
];

pub(crate) struct Pipelines {
    pub(crate) scene: wgpu::RenderPipeline,
    pub(crate) sky: wgpu::RenderPipeline,
    pub(crate) shadow: wgpu::RenderPipeline,
    pub(crate) view_layout: wgpu::BindGroupLayout,
    pub(crate) shadow_layout: wgpu::BindGroupLayout,
}

/// What distinguishes one pipeline from another.
struct Recipe<'a> {
    vertex: &'a str,
    fragment: Option<&'a str>,
    buffers: bool,
    depth: Option<wgpu::CompareFunction>,
    layouts: &'a [Option<&'a wgpu::BindGroupLayout>],
}

impl Pipelines {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let module = gpu.device.create_shader_module(wgpu::include_wgsl!("scene.wgsl"));
        let view_layout = view_layout(gpu);
        let shadow_layout = shadow_layout(gpu);
        let both = [Some(&view_layout), Some(&shadow_layout)];
        let scene = pipeline(gpu, &module, &Recipe {
            vertex: "vertex_main",
            fragment: Some("fragment_main"),
            buffers: true,
            depth: Some(wgpu::CompareFunction::Greater),
            layouts: &both,
        });
        let sky = pipeline(gpu, &module, &Recipe {
            vertex: "vertex_sky",
            fragment: Some("fragment_sky"),
            buffers: false,
            depth: Some(wgpu::CompareFunction::Always),
            layouts: &both,
        });
        let shadow = pipeline(gpu, &module, &Recipe {
            vertex: "vertex_shadow",
            fragment: None,
            buffers: true,
            depth: Some(wgpu::CompareFunction::Less),
            layouts: &[Some(&view_layout)],
        });
        Self { scene, sky, shadow, view_layout, shadow_layout }
    }
}

fn view_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("view"),
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        }],
    })
}

fn shadow_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty,
        count: None,
    };
    let map = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Depth,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison);
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("shadow"),
        entries: &[entry(0, map), entry(1, sampler)],
    })
}

fn pipeline(gpu: &Gpu, module: &wgpu::ShaderModule, recipe: &Recipe<'_>) -> wgpu::RenderPipeline {
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(recipe.vertex),
        bind_group_layouts: recipe.layouts,
        ..wgpu::PipelineLayoutDescriptor::default()
    });
    let buffer = |stride: usize, step_mode, attributes| {
        Some(wgpu::VertexBufferLayout { array_stride: stride as u64, step_mode, attributes })
    };
    let buffers = [
        buffer(size_of::<Vertex>(), wgpu::VertexStepMode::Vertex, &VERTEX as &[_]),
        buffer(size_of::<Instance>(), wgpu::VertexStepMode::Instance, &INSTANCE),
    ];
    let targets = [COLOR, DEPTH, IDS].map(|format| Some(wgpu::ColorTargetState::from(format)));
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(recipe.vertex),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(recipe.vertex),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: if recipe.buffers { &buffers } else { &[] },
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: recipe.depth.map(|compare| wgpu::DepthStencilState {
            format: Z,
            depth_write_enabled: Some(recipe.buffers),
            depth_compare: Some(compare),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: recipe.fragment.map(|entry| wgpu::FragmentState {
            module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}
