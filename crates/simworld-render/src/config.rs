//! Settings of a renderer.

use serde::{Deserialize, Serialize};

use crate::RenderError;
use crate::gpu::{LAYER, MOST_LAYERS};

/// Which graphics interfaces may be used. Only those whose crate feature is on can answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Backends {
    /// Any that this system has; the environment variable `WGPU_BACKEND` may narrow it.
    #[default]
    Any,
    /// Vulkan alone.
    Vulkan,
    /// Metal alone.
    Metal,
    /// Direct3D 12 alone.
    Dx12,
    /// None, as on a machine without graphics.
    None,
}

/// Which adapter is taken where there are several.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum AdapterChoice {
    /// The fastest: a GPU before software.
    #[default]
    Fastest,
    /// Software rendering, which draws the same on machines that have different GPUs.
    Software,
}

/// How a picture is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Backend {
    /// Rays on a discrete GPU, unless edges are smoothed; triangles for everything else.
    #[default]
    Auto,
    /// Triangles, view by view: what CPUs are best at.
    Raster,
    /// Rays, all views at once; shadows by rays too, and edges are never smoothed. Where the adapter binds fewer than nine storage
    /// buffers a stage everything is drawn by triangles all the same.
    Raycast,
}

/// Who finds out what a view of the raster backend may see. Pictures are the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Culling {
    /// The device where it is a GPU, the host where it is software.
    #[default]
    Auto,
    /// The host, which also leaves out what stands behind houses.
    Host,
    /// The device: nothing is left for the host to do that grows with what stands still. The host does it all the same where the adapter
    /// offers no draws from its own lists, and while models play clips, whose poses are made for those that are seen.
    Device,
}

/// How edges in RGB are smoothed. Depth and ids never are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum AntiAliasing {
    /// Not at all: RGB, depth and ids come from one pass and agree at every pixel.
    #[default]
    Off,
    /// Four samples a pixel: RGB is drawn in a pass of its own.
    Msaa4,
}

/// How finely things are drawn that are few pixels wide.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum LevelOfDetail {
    /// With fewer triangles the fewer pixels they are wide, by triangles and by rays. The beams of scanners meet the finest level all the same.
    #[default]
    ByPixels,
    /// As finely as those that fill the picture: both backends draw the same then.
    Finest,
}

/// Settings of a [`Renderer`](crate::Renderer).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RenderConfig {
    /// Which graphics interfaces may be used.
    pub backends: Backends,
    /// Which adapter is taken where there are several.
    pub adapter: AdapterChoice,
    /// How pictures are found; both ways agree on depth and ids but for a few pixels at edges.
    pub backend: Backend,
    /// Who finds out what the raster backend draws.
    pub culling: Culling,
    /// Distance of the nearest plane that is drawn, m, from 1e-3 to 100.
    pub near: f64,
    /// Entities whose bounds lie wholly beyond this distance are not drawn, m, from `near` to 1e6.
    pub far: f64,
    /// Entities whose bounding sphere covers fewer pixels across are not drawn, from 0 to 100.
    pub min_pixels: f64,
    /// How finely things are drawn that are few pixels wide.
    pub level_of_detail: LevelOfDetail,
    /// Smoothing of edges in RGB.
    pub anti_aliasing: AntiAliasing,
    /// Side of the sun's shadow map, texels, from 256 to 8192; 0 turns shadows off.
    pub shadow_resolution: u32,
    /// Shadows are drawn within this distance of the camera, m, from 10 to 2000.
    pub shadow_distance: f64,
    /// Brightness of RGB over the automatic exposure, which follows from sun and clouds alone, in stops from -8 to 8.
    pub exposure_compensation: f64,
    /// Bytes of the device that pictures on models may take, from 4 MiB to 1 GiB, in steps of 4 MiB. Of pictures that are more together
    /// the largest are shown in half their size, and so on until all have room.
    pub texture_memory: u64,
}

impl Default for RenderConfig {
    fn default() -> Self {
        Self {
            backends: Backends::Any,
            adapter: AdapterChoice::Fastest,
            backend: Backend::Auto,
            culling: Culling::Auto,
            near: 0.05,
            far: 1000.0,
            min_pixels: 0.7,
            level_of_detail: LevelOfDetail::ByPixels,
            anti_aliasing: AntiAliasing::Off,
            shadow_resolution: 2048,
            shadow_distance: 120.0,
            exposure_compensation: 0.0,
            texture_memory: 256 << 20,
        }
    }
}

impl RenderConfig {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range, with what is allowed; NaN is always out of range.
    pub fn validate(&self) -> Result<(), RenderError> {
        let side = f64::from(self.shadow_resolution);
        let (least, most) = (LAYER as f64, LAYER as f64 * f64::from(MOST_LAYERS));
        let checks = [
            ("near", self.near, 1e-3, 100.0, "0.001 to 100 m"),
            ("far", self.far, self.near, 1e6, "more than `near`, at most 1e6 m"),
            ("min_pixels", self.min_pixels, 0.0, 100.0, "0 to 100 pixels"),
            (
                "shadow_resolution",
                side,
                if side == 0.0 { 0.0 } else { 256.0 },
                8192.0,
                "0, or 256 to 8192 texels",
            ),
            ("shadow_distance", self.shadow_distance, 10.0, 2000.0, "10 to 2000 m"),
            ("exposure_compensation", self.exposure_compensation, -8.0, 8.0, "-8 to 8 stops"),
            ("texture_memory", self.texture_memory as f64, least, most, "4 MiB to 1 GiB, in bytes"),
        ];
        for (field, value, low, high, allowed) in checks {
            if !(low..=high).contains(&value) {
                return Err(RenderError::Config { field, value, allowed });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_field_is_checked() {
        assert!(RenderConfig::default().validate().is_ok());
        let spoilt = [
            RenderConfig { near: f64::NAN, ..RenderConfig::default() },
            RenderConfig { near: -1.0, ..RenderConfig::default() },
            RenderConfig { far: 0.01, ..RenderConfig::default() },
            RenderConfig { far: f64::INFINITY, ..RenderConfig::default() },
            RenderConfig { min_pixels: -0.1, ..RenderConfig::default() },
            RenderConfig { shadow_resolution: 3, ..RenderConfig::default() },
            RenderConfig { shadow_distance: 0.0, ..RenderConfig::default() },
            RenderConfig { exposure_compensation: 9.0, ..RenderConfig::default() },
            RenderConfig { texture_memory: 0, ..RenderConfig::default() },
            RenderConfig { texture_memory: u64::MAX, ..RenderConfig::default() },
        ];
        for config in spoilt {
            let error = config.validate().unwrap_err().to_string();
            assert!(error.contains("out of range: give"), "{error}");
        }
    }

    #[test]
    fn an_unknown_key_is_named() {
        let error = serde_json::from_str::<RenderConfig>(r#"{ "fare": 3.0 }"#).unwrap_err().to_string();
        assert!(error.contains("fare") && error.contains("shadow_distance"), "{error}");
    }
}
