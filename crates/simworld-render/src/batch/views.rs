//! The views of a batch on the host.

use std::ops::Range;
use std::sync::Arc;

use simworld_core::id::EntityId;

use super::copies::Copies;
use super::{Channels, Layout, PixelFormat, ViewOptions};
use crate::Frame;

/// What many cameras saw: one buffer a channel, view behind view, each row by row from its top left, without padding. Make one and
/// pass it every time. Buffers of channels that were not asked for are empty.
///
/// ```
/// let views = simworld_render::Views::new();
/// assert!(views.is_empty() && views.rgb.is_empty());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Views {
    /// Colour, sRGB, three bytes a pixel.
    pub rgb: Vec<u8>,
    /// Planar depth, m; infinite where there is nothing. Empty in the compact format.
    pub depth: Vec<f32>,
    /// Planar depth, mm: 0 where there is nothing, 65535 from 65.535 m on. Only in the compact format.
    pub depth_mm: Vec<u16>,
    /// Instance: [`EntityId::index`] plus one; 0 where there is nothing.
    pub ids: Vec<u32>,
    /// Class: a Cityscapes label id; 23 (sky) where there is nothing. Empty in the compact format.
    pub classes: Vec<u8>,
    /// The same in 16 bits. Only in the compact format.
    pub wide_classes: Vec<u16>,
    /// Outward normals, unit length to 1e-4, world frame; zero where there is nothing.
    pub normals: Vec<[f32; 3]>,
    sizes: Vec<(u32, u32, usize)>,
    names: Arc<Vec<EntityId>>,
}

impl Views {
    /// No views yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// The number of views.
    pub fn len(&self) -> usize {
        self.sizes.len()
    }

    /// Whether there are no views.
    pub fn is_empty(&self) -> bool {
        self.sizes.is_empty()
    }

    /// Width and height of a view, pixels; `None` if there is no such view.
    pub fn size(&self, view: usize) -> Option<(u32, u32)> {
        self.sizes.get(view).map(|(width, height, _)| (*width, *height))
    }

    /// The pixels of a view as a range of every channel (times three in `rgb`); empty if there is no such view.
    pub fn pixels(&self, view: usize) -> Range<usize> {
        let (width, height, first) = self.sizes.get(view).copied().unwrap_or_default();
        first..first + width as usize * height as usize
    }

    /// Who is behind an entry of `ids`; `None` for the sky.
    pub fn entity(&self, id: u32) -> Option<EntityId> {
        self.names.get((id as usize).checked_sub(1)?).copied()
    }

    /// Copies a view into a frame: what was not asked for stays as [`Frame::resize`] leaves it. False if there is no such view.
    pub fn copy_frame(&self, view: usize, frame: &mut Frame) -> bool {
        let Some((width, height)) = self.size(view) else { return false };
        frame.resize(width, height);
        let pixels = self.pixels(view);
        copy(&mut frame.rgb, &self.rgb, 3 * pixels.start..3 * pixels.end);
        copy(&mut frame.depth, &self.depth, pixels.clone());
        copy(&mut frame.ids, &self.ids, pixels.clone());
        copy(&mut frame.classes, &self.classes, pixels.clone());
        frame.normals.extend_from_slice(self.normals.get(pixels.clone()).unwrap_or_default());
        for (class, wide) in
            frame.classes.iter_mut().zip(self.wide_classes.get(pixels.clone()).unwrap_or_default())
        {
            *class = *wide as u8;
        }
        for (depth, mm) in frame.depth.iter_mut().zip(self.depth_mm.get(pixels).unwrap_or_default()) {
            *depth = if *mm == 0 { crate::SKY_DEPTH } else { f32::from(*mm) * 1e-3 };
        }
        self.name(frame);
        true
    }

    /// Lists who is on the picture of a frame.
    fn name(&self, frame: &mut Frame) {
        let mut seen: Vec<u32> = Vec::new();
        for id in &frame.ids {
            if *id != 0 && seen.last() != Some(id) {
                seen.push(*id);
            }
        }
        seen.sort_unstable();
        seen.dedup();
        frame.drawn.extend(seen.iter().filter_map(|id| self.entity(*id)));
    }

    /// Moves the only view into a frame.
    pub(crate) fn give(&mut self, frame: &mut Frame) {
        let Some((width, height)) = self.size(0) else { return };
        (frame.width, frame.height) = (width, height);
        std::mem::swap(&mut frame.rgb, &mut self.rgb);
        std::mem::swap(&mut frame.depth, &mut self.depth);
        std::mem::swap(&mut frame.ids, &mut self.ids);
        std::mem::swap(&mut frame.classes, &mut self.classes);
        frame.normals.clear();
        frame.flow.clear();
        frame.drawn.clear();
        self.name(frame);
    }

    /// Takes in what came back from the device: the bytes of each channel that was asked for.
    pub(crate) fn fill(
        &mut self,
        layout: &Layout,
        options: ViewOptions,
        names: &Arc<Vec<EntityId>>,
        bytes: impl Fn(Channels) -> Range<usize>,
        all: &[u8],
    ) {
        let mut first = 0;
        self.sizes.clear();
        for span in &layout.spans {
            self.sizes.push((span.width, span.height, first));
            first += span.width as usize * span.height as usize;
        }
        self.names = Arc::clone(names);
        let of = |channel, format: Option<PixelFormat>| {
            let wanted =
                options.channels.contains(channel) && format.is_none_or(|format| options.format == format);
            all.get(if wanted { bytes(channel) } else { 0..0 }).unwrap_or_default()
        };
        let (full, compact) = (Some(PixelFormat::Full), Some(PixelFormat::Compact));
        let mut packed: Vec<u32> = Vec::new();
        let mut copies = Copies { layout, runs: Vec::new() };
        copies.gather(&mut self.rgb, of(Channels::RGB, None), 3);
        copies.gather(&mut self.ids, of(Channels::IDS, None), 1);
        copies.gather(&mut self.depth, of(Channels::DEPTH, full), 1);
        copies.gather(&mut self.depth_mm, of(Channels::DEPTH, compact), 1);
        copies.gather(&mut self.classes, of(Channels::CLASSES, full), 1);
        copies.gather(&mut self.wide_classes, of(Channels::CLASSES, compact), 1);
        copies.gather(&mut packed, of(Channels::NORMALS, None), 1);
        copies.make();
        self.normals.clear();
        self.normals.extend(packed.into_iter().map(normal_of));
    }
}

fn copy<T: Copy>(out: &mut [T], from: &[T], range: Range<usize>) {
    if let Some(from) = from.get(range) {
        out.copy_from_slice(from);
    }
}

/// A normal from its octahedral coordinates, as normals.wgsl packs it; zero for the sky.
fn normal_of(packed: u32) -> [f32; 3] {
    match packed {
        0 => return [0.0; 3],
        0x8000_8000 => return [0.0, 0.0, 1.0],
        _ => {}
    }
    let part = |bits: u32| (f32::from(bits as u16 as i16) / 32767.0).max(-1.0);
    let (mut x, mut y) = (part(packed & 0xffff), part(packed >> 16));
    let z = 1.0 - x.abs() - y.abs();
    if z < 0.0 {
        (x, y) = ((1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y));
    }
    let length = (x * x + y * y + z * z).sqrt();
    [x / length, y / length, z / length]
}

#[cfg(test)]
mod tests {
    use simworld_core::camera::Intrinsics;

    use super::*;

    /// Two views of odd widths: padding is taken out, and every view finds its pixels.
    #[test]
    fn rows_come_back_without_their_padding() {
        let sizes = [(3, 2), (70, 1)].map(|(width, height)| Intrinsics {
            width,
            height,
            fx: 1.0,
            fy: 1.0,
            cx: 0.0,
            cy: 0.0,
        });
        let layout = Layout::of(&sizes);
        assert_eq!((layout.pixels, layout.largest), (2 * 64 + 128, [70, 2]));
        let words: Vec<u32> = (0..layout.pixels as u32).collect();
        let options = ViewOptions { channels: Channels::IDS, format: PixelFormat::Full };
        let mut views = Views::new();
        let names = Arc::new(vec![EntityId::new(0, 3), EntityId::new(1, 0)]);
        views.fill(&layout, options, &names, |_| 0..layout.pixels * 4, bytemuck::cast_slice(&words));
        assert_eq!(views.ids[views.pixels(0)], [0, 1, 2, 64, 65, 66]);
        assert_eq!(views.ids[views.pixels(1)][69], 128 + 69);
        assert!(views.pixels(2).is_empty() && views.size(2).is_none() && views.rgb.is_empty());
        assert_eq!(views.entity(1), Some(EntityId::new(0, 3)));
        let mut frame = Frame::new();
        assert!(views.copy_frame(0, &mut frame) && !views.copy_frame(2, &mut frame));
        assert_eq!(frame.drawn, names.as_slice());
    }
}
