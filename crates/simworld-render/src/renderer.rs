//! The renderer: a scene and a camera in, a frame out.

use bytemuck::{Pod, Zeroable};
use serde::{Deserialize, Serialize};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::environment::Environment;
use simworld_core::geometry::Vector3;
use simworld_core::scene::Scene;

use crate::device::Gpu;
use crate::gather::Gathered;
use crate::mesh::MeshKind;
use crate::pipeline::Pipelines;
use crate::targets::{Targets, depth_view};
use crate::{Frame, RenderError};

/// How scenes are drawn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RenderConfig {
    /// Nothing nearer is drawn, m, in [0.001, 10].
    pub near: f64,
    /// Nothing farther is drawn, m, in [10, 100 000].
    pub far: f64,
    /// Shadows are drawn as far as this round the camera, m, in [5, 2000].
    pub shadow_reach: f64,
    /// Pixels of the shadow map each way, in [64, 8192].
    pub shadow_size: u32,
}

impl Default for RenderConfig {
    fn default() -> Self {
        Self { near: 0.05, far: 1500.0, shadow_reach: 90.0, shadow_size: 2048 }
    }
}

impl RenderConfig {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range; NaN always is.
    pub fn validate(&self) -> Result<(), RenderError> {
        let checks = [
            ("near", self.near, 0.001, 10.0, "0.001 to 10 m"),
            ("far", self.far, 10.0, 100_000.0, "10 to 100 000 m"),
            ("shadow_reach", self.shadow_reach, 5.0, 2000.0, "5 to 2000 m"),
            ("shadow_size", f64::from(self.shadow_size), 64.0, 8192.0, "64 to 8192 pixels"),
        ];
        for (field, value, low, high, allowed) in checks {
            if !(low..=high).contains(&value) {
                return Err(RenderError::Config { field, value, allowed });
            }
        }
        Ok(())
    }
}

/// The shader's view of a camera and its light.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct ViewUniform {
    right: [f32; 4],
    down: [f32; 4],
    forward: [f32; 4],
    projection: [f32; 4],
    sun: [f32; 4],
    sun_color: [f32; 4],
    sky_light: [f32; 4],
    shadow: [[f32; 4]; 3],
}

/// Draws scenes without a window.
pub struct Renderer {
    config: RenderConfig,
    gpu: Gpu,
    pipelines: Pipelines,
    vertices: wgpu::Buffer,
    /// The range of each mesh in the vertices.
    meshes: Vec<std::ops::Range<u32>>,
    instances: wgpu::Buffer,
    uniform: wgpu::Buffer,
    view_group: wgpu::BindGroup,
    shadow_view: wgpu::TextureView,
    shadow_group: wgpu::BindGroup,
    targets: Option<Targets>,
    gathered: Gathered,
}

impl Renderer {
    /// A renderer on the best adapter there is: a GPU, or software.
    ///
    /// # Errors
    /// No adapter (the message says what to install), or a setting out of range.
    pub fn new(config: &RenderConfig) -> Result<Self, RenderError> {
        Self::with_backends(config, wgpu::Backends::all())
    }

    /// A renderer on one of these graphics interfaces.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_backends(config: &RenderConfig, backends: wgpu::Backends) -> Result<Self, RenderError> {
        config.validate()?;
        let gpu = Gpu::open(backends)?;
        let pipelines = Pipelines::new(&gpu);
        let (vertices, meshes) = upload_meshes(&gpu);
        let uniform = buffer(&gpu, size_of::<ViewUniform>() as u64, wgpu::BufferUsages::UNIFORM);
        let view_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("view"),
            layout: &pipelines.view_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }],
        });
        let shadow_view = depth_view(&gpu, config.shadow_size);
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            compare: Some(wgpu::CompareFunction::LessEqual),
            ..wgpu::SamplerDescriptor::default()
        });
        let shadow_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("shadow"),
            layout: &pipelines.shadow_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&shadow_view) },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(&sampler) },
            ],
        });
        let instances = buffer(&gpu, 1 << 16, wgpu::BufferUsages::VERTEX);
        gpu.check()?;
        Ok(Self {
            config: config.clone(),
            gpu,
            pipelines,
            vertices,
            meshes,
            instances,
            uniform,
            view_group,
            shadow_view,
            shadow_group,
            targets: None,
            gathered: Gathered::default(),
        })
    }

    /// What the adapter calls itself.
    pub fn adapter(&self) -> &str {
        &self.gpu.name
    }

    /// Draws what the camera sees over the frame.
    ///
    /// # Errors
    /// An image that is empty or too large for the adapter, or an adapter that fails.
    pub fn render(&mut self, scene: &dyn Scene, camera: &Camera, frame: &mut Frame) -> Result<(), RenderError> {
        let size = self.check_size(&camera.intrinsics)?;
        self.gathered.gather(scene, camera, self.config.far, self.config.shadow_reach);
        self.upload(camera, scene.environment());
        if self.targets.as_ref().is_none_or(|targets| targets.size != size) {
            self.targets = Some(Targets::new(&self.gpu, size));
        }
        let Some(targets) = &self.targets else { return Ok(()) };
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.draw_shadow(&mut encoder);
        self.draw_scene(targets, &mut encoder);
        targets.copy(&mut encoder);
        self.gpu.queue.submit([encoder.finish()]);
        targets.read(&self.gpu, frame)
    }

    fn check_size(&self, intrinsics: &Intrinsics) -> Result<(u32, u32), RenderError> {
        let (width, height) = (intrinsics.width, intrinsics.height);
        if width == 0 || height == 0 {
            return Err(simworld_core::camera::CameraError::Size { width, height }.into());
        }
        let limit = self.gpu.device.limits().max_texture_dimension_2d;
        if width > limit || height > limit {
            return Err(RenderError::TooLarge { width, height, limit });
        }
        Ok((width, height))
    }

    fn upload(&mut self, camera: &Camera, environment: &Environment) {
        let bytes: &[u8] = bytemuck::cast_slice(&self.gathered.instances);
        if bytes.len() as u64 > self.instances.size() {
            let size = (bytes.len() as u64).next_power_of_two();
            self.instances = buffer(&self.gpu, size, wgpu::BufferUsages::VERTEX);
        }
        self.gpu.queue.write_buffer(&self.instances, 0, bytes);
        let view = view_uniform(camera, environment, &self.config);
        self.gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&view));
    }

    fn draw_shadow(&self, encoder: &mut wgpu::CommandEncoder) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow"),
            color_attachments: &[],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.shadow_view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_pipeline(&self.pipelines.shadow);
        pass.set_bind_group(0, &self.view_group, &[]);
        self.draw_meshes(&mut pass);
    }

    fn draw_scene(&self, targets: &Targets, encoder: &mut wgpu::CommandEncoder) {
        let mut pass = targets.pass(encoder);
        pass.set_bind_group(0, &self.view_group, &[]);
        pass.set_bind_group(1, &self.shadow_group, &[]);
        pass.set_pipeline(&self.pipelines.sky);
        pass.draw(0..3, 0..1);
        pass.set_pipeline(&self.pipelines.scene);
        self.draw_meshes(&mut pass);
    }

    fn draw_meshes(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_vertex_buffer(1, self.instances.slice(..));
        for (mesh, instances) in self.meshes.iter().zip(&self.gathered.ranges) {
            if !instances.is_empty() {
                pass.draw(mesh.clone(), instances.clone());
            }
        }
    }
}

fn buffer(gpu: &Gpu, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn upload_meshes(gpu: &Gpu) -> (wgpu::Buffer, Vec<std::ops::Range<u32>>) {
    let mut vertices = Vec::new();
    let mut ranges = Vec::new();
    for kind in MeshKind::ALL {
        let start = vertices.len() as u32;
        vertices.extend(kind.vertices());
        ranges.push(start..vertices.len() as u32);
    }
    let bytes: &[u8] = bytemuck::cast_slice(&vertices);
    let buffer = buffer(gpu, bytes.len() as u64, wgpu::BufferUsages::VERTEX);
    gpu.queue.write_buffer(&buffer, 0, bytes);
    (buffer, ranges)
}

fn view_uniform(camera: &Camera, environment: &Environment, config: &RenderConfig) -> ViewUniform {
    let k = &camera.intrinsics;
    let axis = |axis: Vector3, w: f64| extended(camera.world_from_optical * axis, w);
    let towards_sun = environment.sun.direction();
    let height = towards_sun.z;
    // Full light at 100 000 lux; the redder the lower the sun.
    let strength = environment.sun.illuminance / 100_000.0 * (height * 8.0).clamp(0.0, 1.0);
    let overcast = environment.weather.cloud_cover;
    let sun = strength * (1.0 - 0.85 * overcast) * 3.0;
    let warmth = (1.0 - height).clamp(0.0, 1.0);
    let sun_color = Vector3::new(1.0, 0.97 - 0.22 * warmth, 0.9 - 0.42 * warmth) * sun;
    let day = (height * 3.0 + 0.35).clamp(0.02, 1.0);
    let sky_light = Vector3::new(0.42, 0.48, 0.58) * (day * (1.0 + 0.35 * overcast));
    // Koschmieder: contrast falls to 5 % at the visibility, so extinction is ln 20 / visibility.
    let extinction = 3.0 / environment.weather.visibility;
    ViewUniform {
        right: axis(Vector3::x(), 0.0),
        down: axis(Vector3::y(), 0.0),
        forward: axis(Vector3::z(), 0.0),
        projection: [
            (2.0 * k.fx / f64::from(k.width)) as f32,
            (2.0 * k.fy / f64::from(k.height)) as f32,
            (2.0 * k.cx / f64::from(k.width) - 1.0) as f32,
            (2.0 * k.cy / f64::from(k.height) - 1.0) as f32,
        ],
        sun: extended(towards_sun, config.near),
        sun_color: extended(sun_color, 0.0),
        sky_light: extended(sky_light, extinction),
        shadow: shadow_map(camera, &towards_sun, config.shadow_reach),
    }
}

/// Rows that map camera-relative points to the shadow map: a box of `reach` m round a place before the camera, seen from the
/// sun.
fn shadow_map(camera: &Camera, towards_sun: &Vector3, reach: f64) -> [[f32; 4]; 3] {
    /// Depth of the box, m: tall buildings between the sun and the street.
    const DEPTH: f64 = 800.0;
    let ahead = camera.world_from_optical * Vector3::z() * (reach * 0.7);
    let side = towards_sun.cross(&Vector3::z()).try_normalize(1e-6).unwrap_or_else(Vector3::x);
    let up = side.cross(towards_sun);
    let row = |axis: Vector3, scale: f64, shift: f64| extended(axis * scale, shift - axis.dot(&ahead) * scale);
    [
        row(side, 1.0 / reach, 0.0),
        row(up, 1.0 / reach, 0.0),
        row(-towards_sun, 1.0 / DEPTH, 0.5),
    ]
}

fn extended(v: Vector3, w: f64) -> [f32; 4] {
    [v.x as f32, v.y as f32, v.z as f32, w as f32]
}
