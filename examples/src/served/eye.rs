//! The renderer as the eye of a served world.

use simworld_agents::remote::{Eye, Picture, PictureKind, StageError, View};
use simworld_core::scene::Scene;
use simworld_render::{Frame, RenderConfig, RenderError, Renderer};

/// Draws the pictures that clients ask for, one at a time.
pub struct RenderEye {
    renderer: Renderer,
    frame: Frame,
}

impl RenderEye {
    /// A renderer on the best adapter there is.
    ///
    /// # Errors
    /// There is none.
    pub fn new() -> Result<Self, RenderError> {
        Ok(Self { renderer: Renderer::new(&RenderConfig::default())?, frame: Frame::new() })
    }

    /// The name of the adapter.
    pub fn adapter(&self) -> String {
        self.renderer.adapter()
    }
}

impl Eye for RenderEye {
    fn picture(&mut self, scene: &dyn Scene, view: &View, kind: PictureKind) -> Result<Picture, StageError> {
        let frame = &mut self.frame;
        let drawn = self.renderer.render_hiding(scene, &view.camera, view.hidden, frame);
        drawn.map_err(|error| StageError::Picture(error.to_string()))?;
        let bytes = match kind {
            PictureKind::Color => frame.rgb.clone(),
            PictureKind::Depth => frame.depth.iter().flat_map(|depth| depth.to_le_bytes()).collect(),
            PictureKind::Instances => frame.ids.iter().flat_map(|id| id.to_le_bytes()).collect(),
        };
        Ok(Picture { kind, width: frame.width, height: frame.height, bytes })
    }
}
