//! A plan of a part of a world as an SVG picture: streets, footprints, what an edit touched, and the places that the solver
//! tried.

use simworld_agents::editing::Placing;
use simworld_core::geometry::{Aabb, Point2, planar};
use simworld_core::id::EntityId;
use simworld_core::net::RoadNetwork;
use simworld_core::scene::{EntityKind, EntityRef, Scene, World};
use simworld_core::value::Value;
use std::ops::ControlFlow;
use svg::node::element::{Circle, Group, Line, Polygon, Polyline, Rectangle, Text, Title};

const PAPER: &str = "#f4f1e8";
const STREET: &str = "#d9d7d0";
const WALK: &str = "#ebe8de";
const PATH: &str = "#8a4b1f";
const INK: &str = "#33352f";
/// What is new, moved or altered.
const TOUCHED: &str = "#b3261e";
/// Places that fit, those of them whose ground is for something else, and places that do not fit; blue and orange are told apart by
/// everybody.
const FITS: &str = "#2166ac";
const ASTRAY: &str = "#92c5de";
const REFUSED: &str = "#e08214";

/// What is drawn, and how large.
#[derive(Clone, Debug)]
pub struct Plan<'a> {
    /// The middle of the picture, m.
    pub middle: Point2,
    /// From the middle to the edge, m.
    pub reach: f64,
    /// What stands above the plan.
    pub title: &'a str,
    /// Things to set off.
    pub touched: &'a [EntityId],
    /// Places that were tried.
    pub placings: &'a [Placing],
}

impl Plan<'_> {
    /// The picture, 800 by 800 with a line of title above.
    pub fn draw(&self, world: &World) -> svg::Document {
        let side = self.reach * 2.0;
        let unit = side / 800.0;
        let clip = svg::node::element::ClipPath::new().set("id", "frame").add(
            Rectangle::new()
                .set("x", -self.reach)
                .set("y", -self.reach)
                .set("width", side)
                .set("height", side),
        );
        let ground = self.ground(world, unit);
        let title = Text::new(self.title)
            .set("x", -self.reach + 10.0 * unit)
            .set("y", -self.reach - 9.0 * unit)
            .set("font-size", 17.0 * unit)
            .set("font-family", "Roboto, 'Helvetica Neue', Helvetica, Arial, sans-serif")
            .set("fill", INK);
        let foot = 34.0 * unit;
        svg::Document::new()
            .set("width", 800)
            .set("height", 834)
            .set("viewBox", (-self.reach, -self.reach - foot, side, side + foot))
            .add(Title::new(self.title))
            .add(
                Rectangle::new()
                    .set("x", -self.reach)
                    .set("y", -self.reach - foot)
                    .set("width", side)
                    .set("height", foot)
                    .set("fill", "#ffffff"),
            )
            .add(clip)
            .add(title)
            .add(ground)
    }

    /// The ground and what stands on it, the highest last.
    fn ground(&self, world: &World, unit: f64) -> Group {
        let side = self.reach * 2.0;
        let mut ground = Group::new().set("clip-path", "url(#frame)");
        ground = ground.add(
            Rectangle::new()
                .set("x", -self.reach)
                .set("y", -self.reach)
                .set("width", side)
                .set("height", side)
                .set("fill", PAPER),
        );
        if let Some(land) = world.ground() {
            ground = ground.add(super::relief::drawn(land, self.middle, self.reach));
        }
        if let Some(network) = world.roads() {
            ground = self.streets(ground, network, world);
        }
        let (mut things, mut areas): (Vec<(f64, Group)>, Vec<Group>) = (Vec::new(), Vec::new());
        let region = Aabb::column_around(self.middle, self.reach * 1.5);
        let _ = world.visit(&region, &mut |entity| {
            let is_area = entity.kind == EntityKind::Ground && entity.info.name.is_some();
            // Water on land is drawn with the land, whose shore it has; its name is drawn here.
            let used_as = entity.info.attributes.get("area");
            let is_wet = ["sea", "lake", "river"]
                .iter()
                .any(|water| used_as == Some(&Value::Text((*water).to_owned())));
            let is_water = is_area && is_wet && world.ground().is_some();
            if is_water {
                areas.push(self.water_name(&entity, unit));
            } else if is_area {
                areas.push(self.area(&entity, unit));
            } else if !matches!(entity.kind, EntityKind::Ground | EntityKind::Road | EntityKind::Sidewalk) {
                things.push((entity.bounds.max.z, self.footprint(&entity, unit)));
            }
            ControlFlow::Continue(())
        });
        things.sort_by(|a, b| a.0.total_cmp(&b.0));
        let things = things.into_iter().map(|(_, thing)| thing);
        ground = areas.into_iter().chain(things).fold(ground, Group::add);
        self.placings.iter().fold(ground, |ground, placing| ground.add(self.tried(placing, world, unit)))
    }

    fn at(&self, point: Point2) -> (f64, f64) {
        (point.x - self.middle.x, self.middle.y - point.y)
    }

    fn path(&self, points: &[Point2]) -> String {
        points
            .iter()
            .map(|point| self.at(*point))
            .map(|(x, y)| format!("{x:.2},{y:.2}"))
            .collect::<Vec<_>>()
            .join(" ")
    }

    fn streets(&self, mut group: Group, network: &RoadNetwork, world: &World) -> Group {
        let near =
            |points: &[Point2]| points.iter().any(|point| (point - self.middle).norm() < self.reach * 3.0);
        for walk in network.sidewalks.iter().filter(|walk| near(&walk.path)) {
            group = group.add(self.band(&walk.path, walk.width, WALK));
        }
        for road in network.roads.iter().filter(|road| near(&road.centerline)) {
            let middle = simworld_core::net::polyline::offset(
                &road.centerline,
                (road.left_kerb - road.right_kerb) * 0.5,
            );
            group = group.add(self.band(&middle, road.width, STREET));
        }
        for way in network.footpaths.iter().filter(|way| near(&way.path)) {
            let line = self.band(&way.path, way.width.max(self.reach / 320.0), PATH);
            group = group
                .add(line.set("stroke-dasharray", format!("{0} {1}", self.reach / 70.0, self.reach / 140.0)));
        }
        let closed = network.roads.iter().enumerate().filter(|(index, _)| {
            let road = simworld_core::id::RoadId::from_index(*index);
            world.closed_roads().iter().any(|leg| leg.0 == road)
        });
        for (_, road) in closed {
            // What is closed to traffic is struck through.
            group = group.add(self.band(&road.centerline, 0.9, TOUCHED).set("stroke-dasharray", "3 2"));
        }
        for place in network.intersections.iter().filter(|place| near(&[place.center])) {
            group = group.add(Polygon::new().set("points", self.path(&place.outline)).set("fill", STREET));
        }
        group
    }

    fn band(&self, path: &[Point2], width: f64, color: &str) -> Polyline {
        Polyline::new()
            .set("points", self.path(path))
            .set("fill", "none")
            .set("stroke", color)
            .set("stroke-width", width)
            .set("stroke-linejoin", "round")
    }

    /// A park, a square or water, with its name.
    fn area(&self, entity: &EntityRef<'_>, unit: f64) -> Group {
        let fill = entity.info.color.map_or_else(|| WALK.to_owned(), to_srgb);
        let (x, y) = self.at(entity.planar());
        let outline = Polygon::new().set("points", self.path(&entity.obb().footprint())).set("fill", fill);
        // White on what is wide enough for it, and else readable beyond the edge too.
        let wide = entity.label().chars().count() as f64 * 6.0 * unit;
        let color = if wide < entity.info.shape.size().xy().max() { "#ffffff" } else { INK };
        let name = Text::new(entity.label())
            .set("x", x)
            .set("y", y)
            .set("font-size", 11.0 * unit)
            .set("text-anchor", "middle")
            .set("fill", color)
            .set("font-family", "Roboto, 'Helvetica Neue', Helvetica, Arial, sans-serif");
        Group::new().add(outline.set("opacity", 0.75)).add(name)
    }

    /// The name of water, in its middle as far as that is on the plan.
    fn water_name(&self, entity: &EntityRef<'_>, unit: f64) -> Group {
        let wide = entity.info.shape.size().xy().max() > self.reach * 2.0;
        let (x, y) = if wide { (0.0, self.reach * 0.94) } else { self.at(entity.planar()) };
        let name = Text::new(entity.label())
            .set("x", x)
            .set("y", y)
            .set("font-size", 15.0 * unit)
            .set("font-style", "italic")
            .set("text-anchor", "middle")
            .set("fill", "#1d4f73")
            .set("font-family", "Roboto, 'Helvetica Neue', Helvetica, Arial, sans-serif");
        Group::new().add(name)
    }

    fn footprint(&self, entity: &EntityRef<'_>, unit: f64) -> Group {
        let touched = self.touched.contains(&entity.id);
        let fill = match (entity.kind, entity.info.color) {
            (EntityKind::Building, None) => "#c9c2b2".to_owned(),
            (EntityKind::Crosswalk, _) => "#ffffff".to_owned(),
            (_, Some(color)) => to_srgb(color),
            (EntityKind::Tree | EntityKind::Shrub, None) => "#7f9b6e".to_owned(),
            _ => "#8d8a80".to_owned(),
        };
        let corners = entity.obb().footprint();
        let (middle_x, middle_y) = self.at(entity.planar());
        // Thin things are drawn larger than they are, so that they can be seen.
        let size = entity.info.shape.size();
        let mut group = Group::new().add(Title::new(format!("{} ({})", entity.label(), entity.id)));
        if size.xy().max() < 6.0 * unit {
            group = group.add(
                Circle::new().set("cx", middle_x).set("cy", middle_y).set("r", 3.0 * unit).set("fill", fill),
            );
        } else {
            group = group.add(
                Polygon::new()
                    .set("points", self.path(&corners))
                    .set("fill", fill)
                    .set("stroke", INK)
                    .set("stroke-width", 0.6 * unit),
            );
            let front = (corners[0] + corners[3].coords).coords * 0.5;
            let (x, y) = self.at(Point2::from(front));
            let nose = Line::new().set("x1", middle_x).set("y1", middle_y).set("x2", x).set("y2", y);
            group = group.add(nose.set("stroke", INK).set("stroke-width", 0.5 * unit).set("opacity", 0.5));
        }
        if touched {
            let radius = size.xy().norm() * 0.5 + 5.0 * unit;
            group = group.add(
                Circle::new()
                    .set("cx", middle_x)
                    .set("cy", middle_y)
                    .set("r", radius)
                    .set("fill", "none")
                    .set("stroke", TOUCHED)
                    .set("stroke-width", 2.4 * unit),
            );
        }
        group.add(self.name(entity, unit))
    }

    /// The name of a building, where it has room: from far off names would lie upon each other.
    fn name(&self, entity: &EntityRef<'_>, unit: f64) -> Group {
        let wide = entity.label().chars().count() as f64 * 5.5 * unit;
        let has_name = entity.kind == EntityKind::Building && entity.info.name.is_some();
        if !has_name || wide >= entity.info.shape.size().xy().max() * 1.6 {
            return Group::new();
        }
        let (x, y) = self.at(entity.planar());
        Group::new().add(
            Text::new(entity.label())
                .set("x", x)
                .set("y", y)
                .set("font-size", 10.0 * unit)
                .set("text-anchor", "middle")
                .set("fill", INK)
                .set("font-family", "Roboto, 'Helvetica Neue', Helvetica, Arial, sans-serif"),
        )
    }

    /// The places that were tried, each with what became of it.
    fn tried(&self, placing: &Placing, world: &World, unit: f64) -> Group {
        let mut group = Group::new();
        for candidate in &placing.candidates {
            let (x, y) = self.at(planar(&candidate.pose));
            let fit = candidate.fit();
            let dot = Circle::new().set("cx", x).set("cy", y);
            let dot = dot.set("r", if fit.is_some() { 4.0 } else { 2.6 } * unit);
            let fill = fit.map_or(REFUSED, |fit| if fit.astray { ASTRAY } else { FITS });
            group = group.add(
                dot.set("fill", fill).set("opacity", 0.75).add(Title::new(candidate.outcome.told(world))),
            );
        }
        group
    }
}

/// Linear-light sRGB to a colour of the page.
pub(super) fn to_srgb(linear: [f32; 3]) -> String {
    let [r, g, b] = linear.map(|channel| {
        let channel = f64::from(channel.clamp(0.0, 1.0));
        let encoded = if channel <= 0.003_130_8 {
            channel * 12.92
        } else {
            1.055 * simworld_core::ops::pow(channel, 1.0 / 2.4) - 0.055
        };
        (encoded * 255.0).round() as u8
    });
    format!("#{r:02x}{g:02x}{b:02x}")
}
