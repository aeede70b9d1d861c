//! The map as PNG: the SVG drawn by resvg with the lettering that this crate carries, so that every machine draws the
//! same pixels.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::fontdb::Database;
use resvg::usvg::{Options, Tree};
use thiserror::Error;

/// Roboto, light, regular and medium, under the Apache licence, without the letters of scripts that maps of the
/// Latin, Greek and Cyrillic world do without.
const FONTS: [&[u8]; 3] = [
    include_bytes!("../../assets/Roboto-Light.ttf"),
    include_bytes!("../../assets/Roboto-Regular.ttf"),
    include_bytes!("../../assets/Roboto-Medium.ttf"),
];
/// Widest picture, pixels.
const WIDEST: u32 = 20_000;

/// Why a map cannot be drawn as PNG.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PngError {
    /// A width out of range.
    #[error("a width of {width} pixels is out of range: give 16 to {WIDEST}")]
    Width {
        /// What was asked for.
        width: u32,
    },
    /// The drawing is no SVG that can be rendered.
    #[error("the map cannot be drawn: {0}")]
    Svg(#[from] resvg::usvg::Error),
    /// The picture cannot be encoded.
    #[error("the picture cannot be encoded: {0}")]
    Encode(String),
}

/// Draws an SVG map as a PNG of that width; the height follows from the sheet.
///
/// ```
/// use simworld_citygen::{City, CityConfig, map};
/// use simworld_core::seed::Seed;
/// let city = City::generate(&CityConfig::with_roads(4), Seed(3))?;
/// let png = map::render_png(&city.svg(), 200)?;
/// assert!(png.starts_with(b"\x89PNG"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A width out of range, or text that is no SVG.
pub fn render_png(svg: &str, width: u32) -> Result<Vec<u8>, PngError> {
    if !(16..=WIDEST).contains(&width) {
        return Err(PngError::Width { width });
    }
    let mut fonts = Database::new();
    for font in FONTS {
        fonts.load_font_data(font.to_vec());
    }
    fonts.set_sans_serif_family("Roboto");
    let options = Options { fontdb: fonts.into(), font_family: "Roboto".to_owned(), ..Options::default() };
    let tree = Tree::from_str(svg, &options)?;
    let scale = width as f32 / tree.size().width();
    let height = (tree.size().height() * scale).round().max(1.0) as u32;
    let mut pixels = Pixmap::new(width, height).ok_or(PngError::Width { width })?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| PngError::Encode(error.to_string()))
}
