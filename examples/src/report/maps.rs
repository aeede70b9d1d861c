//! The map: heat and trails over the city, each a layer that the reader may show or hide without a script.

use std::fmt::Write as _;

use simworld_core::geometry::Point2;
use svg::node::element::{Group, Path, Text, Title};

use super::Shown;
use super::city::CityMap;
use super::heat::Heat;
use super::palette;
use super::story::Story;
use super::words::escaped;

/// Deviation of the kernel over where couriers were, and over where orders came from and went to, m.
const BLUR: (f64, f64) = (9.0, 22.0);
/// More trails than this hide the city.
const MOST_TRAILS: usize = 60;

/// A layer of heat.
struct Layer {
    /// Its class in the page.
    name: &'static str,
    label: &'static str,
    heat: Heat,
    /// In what its heat is told, and what one of it on a square metre comes to.
    unit: (&'static str, f64),
}

/// The figure, and the legend of its couriers.
pub(super) fn figure(shown: &Shown, map: &CityMap, stories: &[Story]) -> String {
    let track = &shown.track;
    let seconds = track.interval as f64 * track.dt;
    let spots = track.samples.iter().flat_map(|(_, spots)| spots).map(|spot| (spot.point(), seconds));
    let access = |id| map.site(id).map(|site| (site.access, 1.0));
    let origins = stories.iter().filter_map(|story| access(story.restaurant?));
    let homes = stories.iter().filter_map(|story| access(story.home?));
    let layers = [
        Layer {
            name: "presence",
            label: "Where couriers were",
            heat: Heat::of(&map.frame, spots, BLUR.0),
            unit: ("courier-minutes on 100 m²", 100.0 / 60.0),
        },
        Layer {
            name: "origins",
            label: "Where orders came from",
            heat: Heat::of(&map.frame, origins, BLUR.1),
            unit: ("orders on a hectare", 10_000.0),
        },
        Layer {
            name: "homes",
            label: "Where orders went",
            heat: Heat::of(&map.frame, homes, BLUR.1),
            unit: ("orders on a hectare", 10_000.0),
        },
    ];
    let mut text = String::from("<div class=layers>");
    // Writing to a string cannot fail.
    for Layer { name, label, .. } in &layers {
        let on = if *name == "presence" { " checked" } else { "" };
        let _ =
            write!(text, "<input type=checkbox id=show-{name}{on}><label for=show-{name}>{label}</label>");
    }
    text.push_str("<input type=checkbox id=show-trails checked><label for=show-trails>Trails</label>");
    let _ = write!(
        text,
        "<div class=picture><svg class=map viewBox=\"{}\" role=img aria-label=\"Map of the city with heat and \
         trails\"><use href=\"#city\"/>",
        map.frame.view_box()
    );
    for Layer { name, heat, .. } in &layers {
        // Lengths of a filter are in units of the drawing: areas run into each other, and no cell is seen.
        let soft = heat.cell * 3 / 4;
        let _ = write!(text, "<g class=\"heat {name}\" style=\"filter:blur({soft}px)\">{}</g>", heat.areas());
    }
    let _ = write!(text, "{}</svg></div></div>", trails(shown, map));
    text.push_str("<p class=key>");
    for Layer { name, label, heat, unit } in &layers {
        let most = heat.greatest() * unit.1;
        let _ = write!(
            text,
            "<span><i class=\"swatch {name}\"></i>{label}: darkest at {most:.1} {}</span> ",
            unit.0
        );
    }
    text.push_str("</p>");
    text + &legend(shown)
}

/// How many couriers have trails, timelines and a place in legends.
pub(super) fn in_view(shown: &Shown) -> usize {
    shown.track.couriers.len().min(MOST_TRAILS)
}

fn trails(shown: &Shown, map: &CityMap) -> Group {
    let mut group = Group::new().set("class", "trails");
    let mut ends: Vec<(i64, i64)> = Vec::new();
    let size = map.frame.share(1.0 / 55.0);
    let mut labels = Group::new().set("font-size", size).set("stroke-width", size * 0.22);
    for (index, courier) in shown.track.couriers.iter().enumerate().take(MOST_TRAILS) {
        let points: Vec<Point2> = shown.track.samples.iter().map(|(_, spots)| spots[index].point()).collect();
        let Some(last) = points.last() else { continue };
        let (color, dash) = palette::courier(index);
        let path = Path::new()
            .set("d", map.frame.line(&points))
            .set("stroke", color)
            .set("stroke-dasharray", dash)
            .set("data-courier", index)
            .add(Title::new(courier.name.as_str()));
        group = group.add(path);
        // Labels of those who end together stand in a row.
        let (x, mut y) = map.frame.cell(*last);
        let near = |end: &(i64, i64), y: i64| {
            (end.0 - x).abs() < (size * 1.3) as i64 && (end.1 - y).abs() < (size * 0.95) as i64
        };
        while ends.iter().any(|end| near(end, y)) {
            y += size as i64;
        }
        ends.push((x, y));
        let label = Text::new(index.to_string())
            .set("x", x)
            .set("y", y)
            .set("fill", color)
            .set("data-courier", index)
            .add(Title::new(courier.name.as_str()));
        labels = labels.add(label);
    }
    group.add(labels)
}

/// One button a courier, which puts it forward wherever it is drawn.
fn legend(shown: &Shown) -> String {
    let mut text = String::from("<div class=couriers>");
    for (index, courier) in shown.track.couriers.iter().enumerate().take(MOST_TRAILS) {
        let (color, dash) = palette::courier(index);
        let policy = shown.players.get(index).map_or("", |player| player.policy.as_str());
        let _ = write!(
            text,
            "<button type=button data-courier={index} aria-pressed=false><svg width=26 height=8 \
             aria-hidden=true><path d=\"M1 4h24\" stroke=\"{color}\" stroke-width=3 \
             stroke-dasharray=\"{dash}\"/></svg>{} <small>{}</small></button>",
            escaped(&courier.name),
            escaped(&policy.replace('_', " "))
        );
    }
    text.push_str("</div>");
    if shown.track.couriers.len() > MOST_TRAILS {
        let _ = write!(
            text,
            "<p class=note>Trails of the first {MOST_TRAILS} of {} couriers; heat of all.</p>",
            shown.track.couriers.len()
        );
    }
    text
}
