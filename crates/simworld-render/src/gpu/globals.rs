//! The uniform block of one picture; the twin of `Globals` in shaders/globals.wgsl.

use bytemuck::{Pod, Zeroable};
use nalgebra::Vector3;

use crate::light::Light;
use crate::resident::split;
use crate::shadow::ShadowView;
use crate::view::{View, columns, vec4};

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct Globals {
    clip_from_relative: [[f32; 4]; 4],
    shadow_from_relative: [[f32; 4]; 4],
    right: [f32; 4],
    down: [f32; 4],
    forward: [f32; 4],
    intrinsics: [f32; 4],
    sun_direction: [f32; 4],
    sun: [f32; 4],
    sky: [f32; 4],
    bounce: [f32; 4],
    zenith: [f32; 4],
    horizon: [f32; 4],
    eye: [f32; 4],
    eye_rest: [f32; 4],
}

impl Globals {
    pub(crate) fn new(view: &View, light: &Light, shadow: Option<&ShadowView>) -> Self {
        let axis = |row: usize| -> Vector3<f64> { view.optical_from_world.row(row).transpose() };
        let k = &view.intrinsics;
        let (eye, eye_rest) = split(&view.eye.coords);
        let with_zero = |[x, y, z]: [f32; 3]| [x, y, z, 0.0];
        let shadow_from_relative =
            shadow.map_or_else(nalgebra::Matrix4::identity, ShadowView::clip_from_relative);
        Self {
            clip_from_relative: columns(&view.clip_from_relative()),
            shadow_from_relative: columns(&shadow_from_relative),
            right: vec4(&axis(0), 0.0),
            down: vec4(&axis(1), 0.0),
            forward: vec4(&axis(2), 0.0),
            intrinsics: [k.fx, k.fy, k.cx, k.cy].map(|entry| entry as f32),
            sun_direction: vec4(&light.sun_direction, light.night),
            sun: vec4(&light.sun, light.extinction),
            sky: vec4(&light.sky, light.clouds),
            bounce: vec4(&light.bounce, shadow.map_or(0.0, |shadow| shadow.texel)),
            zenith: vec4(&light.zenith, 0.0),
            horizon: vec4(&light.horizon, 0.0),
            eye: with_zero(eye),
            eye_rest: with_zero(eye_rest),
        }
    }
}
