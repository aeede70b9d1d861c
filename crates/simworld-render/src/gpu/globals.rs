//! The uniform block of one picture; the twin of `Globals` in shaders/globals.wgsl.

use bytemuck::{Pod, Zeroable};
use nalgebra::Vector3;

use crate::falling::{Falling, Precipitation};
use crate::lamps::LampPlace;
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
    ambient: [[f32; 4]; 9],
    overcast: [f32; 4],
    night_sky: [f32; 4],
    fog: [f32; 4],
    aerosol_low: [f32; 4],
    aerosol_high: [f32; 4],
    bounce: [f32; 4],
    eye: [f32; 4],
    eye_rest: [f32; 4],
    source_flat: [f32; 4],
    cover: [f32; 4],
    drops: [f32; 4],
    fall: [f32; 4],
    lamp_grid: [f32; 4],
}

impl Globals {
    /// What a shadow map is drawn with: from its own middle, not from an eye, so that it is the same for all of them.
    pub(crate) fn of_shadow(shadow: &ShadowView) -> Self {
        let (eye, eye_rest) = split(&shadow.center.coords);
        let with_zero = |[x, y, z]: [f32; 3]| [x, y, z, 0.0];
        Self {
            shadow_from_relative: columns(&shadow.clip_from_relative(&shadow.center)),
            eye: with_zero(eye),
            eye_rest: with_zero(eye_rest),
            ..Self::zeroed()
        }
    }

    pub(crate) fn new(
        view: &View,
        light: &Light,
        air: &Falling,
        shadow: Option<&ShadowView>,
        lamps: Option<&LampPlace>,
    ) -> Self {
        let axis = |row: usize| -> Vector3<f64> { view.optical_from_world.row(row).transpose() };
        let k = &view.intrinsics;
        let (eye, eye_rest) = split(&view.eye.coords);
        let with_zero = |[x, y, z]: [f32; 3]| [x, y, z, 0.0];
        let (cover, flat) = (&light.cover, light.flat());
        let shadow_from_relative =
            shadow.map_or_else(nalgebra::Matrix4::identity, |shadow| shadow.clip_from_relative(&view.eye));
        Self {
            clip_from_relative: columns(&view.clip_from_relative()),
            shadow_from_relative: columns(&shadow_from_relative),
            right: vec4(&axis(0), 0.0),
            down: vec4(&axis(1), 0.0),
            forward: vec4(&axis(2), 0.0),
            intrinsics: [k.fx, k.fy, k.cx, k.cy].map(|entry| entry as f32),
            sun_direction: vec4(&light.source, light.night),
            sun: vec4(&light.sun, light.extinction),
            ambient: light.ambient.map(|coefficient| vec4(&coefficient, 0.0)),
            overcast: vec4(&light.overcast, light.clouds),
            night_sky: vec4(&light.night_sky, light.thinning),
            fog: vec4(&light.fog, light.fog_share),
            aerosol_low: vec4(&light.aerosol[0], light.fog_depth),
            aerosol_high: vec4(&light.aerosol[1], 0.0),
            bounce: vec4(&light.bounce, shadow.map_or(0.0, |shadow| shadow.texel)),
            eye: with_zero(eye),
            eye_rest: with_zero(eye_rest),
            source_flat: [flat.x, flat.y, air.clouds[0], air.clouds[1]].map(|entry| entry as f32),
            cover: [cover.wetness, cover.puddles, cover.snow_depth, (light.rain / 8.0).min(1.0)]
                .map(|share| share as f32),
            drops: vec4(&air.place, air.seconds),
            fall: vec4(&air.velocity, f64::from(u8::from(air.kind == Precipitation::Snow))),
            lamp_grid: lamps.map_or([0.0; 4], |lamps| vec4(&(lamps.corner - view.eye), lamps.entry as f64)),
        }
    }
}
