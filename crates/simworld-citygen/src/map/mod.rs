//! The map: a city drawn as an SVG poster, with room for trails and markers of others.
//!
//! The page is measured in millimetres. Lines keep a least width on paper, so that a town of one kilometre and a city
//! of twenty both read well; detail that would be finer than ink is left out. What belongs together is one group with
//! an id (`water`, `streets`, `buildings`, `labels` ...), so that a drawing program can take the sheet apart.

mod bridges;
mod buildings;
mod footways;
mod furniture;
mod ground;
mod labels;
mod page;
mod path;
#[cfg(feature = "png")]
mod png;
mod streets;
mod strips;
mod style;
mod tunnels;

use std::fmt;

use page::Page;
#[cfg(feature = "png")]
pub use png::{PngError, render_png};
use simworld_core::geometry::Point2;
pub use style::place_color;

use crate::City;

/// A drawing of a city that others may add to.
///
/// ```
/// use simworld_citygen::{City, CityConfig, map::MapDrawing};
/// use simworld_core::{geometry::Point2, seed::Seed};
/// let city = City::generate(&CityConfig::with_roads(8), Seed(3))?;
/// let walk = [Point2::new(0.0, 0.0), Point2::new(40.0, 10.0)];
/// let svg = MapDrawing::of(&city).title("A walk").trail(&walk, "#c0392b", "Ada").to_string();
/// assert!(svg.contains("Ada") && svg.trim_end().ends_with("</svg>"));
/// # Ok::<(), simworld_citygen::CityError>(())
/// ```
#[derive(Clone, Debug)]
pub struct MapDrawing<'a> {
    city: &'a City,
    title: Option<String>,
    subtitle: Option<String>,
    statistics: Vec<(String, String)>,
    trails: Vec<Trail>,
    markers: Vec<Marker>,
}

/// The way of somebody.
#[derive(Clone, Debug)]
struct Trail {
    points: Vec<Point2>,
    color: String,
    label: String,
}

/// A marked place.
#[derive(Clone, Debug)]
struct Marker {
    point: Point2,
    color: String,
    label: String,
}

impl<'a> MapDrawing<'a> {
    /// The city alone, under its own title, with its figures at the foot.
    pub fn of(city: &'a City) -> Self {
        Self {
            city,
            title: None,
            subtitle: None,
            statistics: furniture::statistics(city),
            trails: Vec::new(),
            markers: Vec::new(),
        }
    }

    /// With another title.
    #[must_use]
    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = Some(title.into());
        self
    }

    /// With another line below the title.
    #[must_use]
    pub fn subtitle(mut self, subtitle: impl Into<String>) -> Self {
        self.subtitle = Some(subtitle.into());
        self
    }

    /// With other figures at the foot, each a label and its value; none leaves the box out.
    #[must_use]
    pub fn statistics(mut self, statistics: Vec<(String, String)>) -> Self {
        self.statistics = statistics;
        self
    }

    /// With the trail of somebody: a line, a dot at its end, a label.
    #[must_use]
    pub fn trail(mut self, points: &[Point2], color: &str, label: &str) -> Self {
        self.trails.push(Trail { points: points.to_vec(), color: color.to_owned(), label: label.to_owned() });
        self
    }

    /// With a marked place.
    #[must_use]
    pub fn marker(mut self, point: &Point2, color: &str, label: &str) -> Self {
        self.markers.push(Marker { point: *point, color: color.to_owned(), label: label.to_owned() });
        self
    }
}

impl fmt::Display for MapDrawing<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let page = Page::of(self.city);
        page.begin(f, &furniture::title_of(self))?;
        page.begin_city(f)?;
        let land = self.city.land();
        ground::draw(f, &page, &land)?;
        streets::draw(f, &page, self.city)?;
        buildings::draw(f, &page, self.city)?;
        footways::passages(f, &page, self.city)?;
        // The group of the city.
        writeln!(f, "</g>")?;
        self.draw_trails(f, &page)?;
        labels::draw(f, &page, self.city)?;
        furniture::draw(f, &page, self, &land)?;
        writeln!(f, "</svg>")
    }
}

impl MapDrawing<'_> {
    fn draw_trails(&self, f: &mut fmt::Formatter<'_>, page: &Page) -> fmt::Result {
        if self.trails.is_empty() && self.markers.is_empty() {
            return Ok(());
        }
        writeln!(f, r#"<g id="trails" fill="none" stroke-linejoin="round" stroke-linecap="round">"#)?;
        for Trail { points, color, label } in &self.trails {
            let Some(last) = points.last() else { continue };
            let line = page.line(points);
            let color = page::escaped(color);
            writeln!(f, r#"<path d="{line}" stroke="{color}" stroke-width="0.9" stroke-opacity="0.75"/>"#)?;
            labels::flag(f, page, last, &color, label)?;
        }
        for Marker { point, color, label } in &self.markers {
            labels::flag(f, page, point, &page::escaped(color), label)?;
        }
        writeln!(f, "</g>")
    }
}
