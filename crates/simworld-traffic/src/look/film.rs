//! A film of one junction: an SVG that moves by itself.

use std::fmt::Write;

use simworld_core::geometry::{Point2, Vector2, heading};
use simworld_core::id::IntersectionId;
use simworld_core::net::{Aspect, RoadNetwork, SignalGroup, polyline};
use simworld_core::ops::wrap_angle;

use super::sheet::{Anchor, FAINT, Sheet, escaped, path_data};
use crate::Traffic;

/// Side of the picture, mm.
const SIDE: f64 = 200.0;
/// Space for the title.
const HEAD: f64 = 28.0;
/// Frames are taken so often, s.
const EVERY: f64 = 0.5;

/// Where somebody was in each frame; none while out of the picture.
#[derive(Clone, Debug, Default)]
struct Actor {
    fill: &'static str,
    /// Length and width, m; a person has the same for both.
    size: (f64, f64),
    places: Vec<Option<(Point2, f64)>>,
}

/// What was seen of one junction.
#[derive(Clone, Debug)]
pub struct Film {
    junction: IntersectionId,
    middle: Point2,
    reach: f64,
    frames: usize,
    next: f64,
    vehicles: Vec<Actor>,
    people: Vec<Actor>,
    signals: Vec<(Point2, SignalGroup, Vec<Aspect>)>,
}

impl Film {
    /// Nothing yet, of a junction and everything within `reach` m of it.
    pub fn new(network: &RoadNetwork, junction: IntersectionId, reach: f64) -> Self {
        let place = &network.intersections[junction.index()];
        let mut signals: Vec<(Point2, SignalGroup, Vec<Aspect>)> = Vec::new();
        for way in place.connections.iter().map(|id| &network.connections[id.index()]) {
            let Some(group) = way.signal else { continue };
            let lane = &network.lanes[way.from.index()];
            let line = polyline::at(&lane.path, lane.length - 0.5).0;
            if signals.iter().all(|(at, own, _)| *own != group || (at - line).norm() > 0.5) {
                signals.push((line, group, Vec::new()));
            }
        }
        for crossing in place.crossings.iter().map(|id| &network.crossings[id.index()]) {
            if let Some(group) = crossing.signal {
                signals.push((crossing.start, group, Vec::new()));
                signals.push((crossing.end, group, Vec::new()));
            }
        }
        let middle = place.center;
        Self {
            junction,
            middle,
            reach,
            frames: 0,
            next: f64::NAN,
            vehicles: Vec::new(),
            people: Vec::new(),
            signals,
        }
    }

    /// Looks at the traffic after a step.
    pub fn look(&mut self, traffic: &Traffic) {
        if self.next.is_nan() {
            self.next = traffic.seconds();
        }
        if traffic.seconds() + 1e-6 < self.next {
            return;
        }
        self.next += EVERY;
        let (middle, reach, frame) = (self.middle, self.reach * 1.15, self.frames);
        let is_near = |at: &Point2| (at - middle).amax() < reach;
        for body in traffic.vehicles() {
            let position = Point2::new(body.pose.translation.x, body.pose.translation.y);
            if is_near(&position) {
                let ahead = body.pose.rotation * simworld_core::geometry::Vector3::x();
                let yaw = heading(&Vector2::new(ahead.x, ahead.y));
                let size = body.shape.size();
                let fill = paint(body.id, size.x);
                take(&mut self.vehicles, body.id as usize, frame, (position, yaw), (size.x, size.y), fill);
            }
        }
        for (index, walker) in traffic.pedestrians().iter().enumerate() {
            if walker.is_present() && is_near(&walker.position) {
                take(
                    &mut self.people,
                    index,
                    frame,
                    (walker.position, walker.heading()),
                    (0.6, 0.6),
                    "#7b4b94",
                );
            }
        }
        for (_, group, aspects) in &mut self.signals {
            aspects.push(traffic.signals().get(group.index()).copied().unwrap_or_default());
        }
        self.frames += 1;
    }
}

fn paint(id: u32, length: f64) -> &'static str {
    const CARS: [&str; 5] = ["#2f4858", "#33658a", "#5b7b7a", "#8a5a44", "#6b6e70"];
    if length > 8.0 { "#c8553d" } else { CARS[id as usize % CARS.len()] }
}

fn take(
    actors: &mut Vec<Actor>,
    index: usize,
    frame: usize,
    place: (Point2, f64),
    size: (f64, f64),
    fill: &'static str,
) {
    if actors.len() <= index {
        actors.resize_with(index + 1, Actor::default);
    }
    let actor = &mut actors[index];
    (actor.size, actor.fill) = (size, fill);
    actor.places.resize(frame, None);
    actor.places.push(Some(place));
}

/// The film as an SVG text that plays in any browser, at its own pace, for ever; elsewhere its first frame stands.
pub fn junction_film(film: &Film, network: &RoadNetwork, title: &str) -> String {
    let seconds = (film.frames.max(2) - 1) as f64 * EVERY;
    let subtitle = format!("junction {}, {seconds:.0} s, {:.0} m across", film.junction.0, film.reach * 2.0);
    let mut sheet = Sheet::new((SIDE, SIDE + HEAD + 8.0), title, &subtitle);
    let scale = SIDE / (2.0 * film.reach);
    sheet.begin_clip("film", super::sheet::Frame { x: 0.0, y: HEAD, width: SIDE, height: SIDE });
    sheet.raw(&format!(
        r#"<g transform="translate({:.3} {:.3}) scale({scale:.5} -{scale:.5}) translate({:.3} {:.3})">"#,
        SIDE * 0.5,
        HEAD + SIDE * 0.5,
        -film.middle.x,
        -film.middle.y
    ));
    draw_ground(&mut sheet, film, network);
    for (at, _, aspects) in &film.signals {
        draw_signal(&mut sheet, at, aspects, seconds);
    }
    for actor in film.people.iter().chain(&film.vehicles).filter(|actor| !actor.places.is_empty()) {
        draw_actor(&mut sheet, actor, film.frames, seconds);
    }
    sheet.end_group();
    sheet.end_group();
    sheet.label(
        (SIDE - 6.0, SIDE + HEAD + 5.2),
        3.0,
        Anchor::End,
        FAINT,
        "red-brown: buses and lorries; violet: people",
    );
    sheet.finish()
}

fn draw_ground(sheet: &mut Sheet, film: &Film, network: &RoadNetwork) {
    let near = |path: &[Point2]| {
        polyline::closest(path, &film.middle).is_some_and(|near| near.distance < film.reach * 1.6)
    };
    let path = |points: &[Point2]| path_data(points.iter().map(|point| (point.x, point.y)));
    let mut stroke = |data: String, ink: &str, width: f64, dashes: &str| {
        sheet.raw(&format!(
            r#"<path d="{data}" fill="none" stroke="{ink}" stroke-width="{width:.2}"{dashes} stroke-linejoin="round"/>"#
        ));
    };
    for walk in network.sidewalks.iter().filter(|walk| near(&walk.path)) {
        stroke(path(&walk.path), "#e2ddd0", walk.width, "");
    }
    for lane in network.lanes.iter().filter(|lane| near(&lane.path)) {
        stroke(path(&lane.path), "#d9d6cf", lane.width, "");
    }
    for place in
        network.intersections.iter().filter(|place| (place.center - film.middle).norm() < film.reach * 1.6)
    {
        let data = path(&place.outline);
        sheet.raw(&format!(r##"<path d="{data}Z" fill="#d9d6cf"/>"##));
    }
    let mut stroke = |data: String, ink: &str, width: f64, dashes: &str| {
        sheet.raw(&format!(
            r#"<path d="{data}" fill="none" stroke="{ink}" stroke-width="{width:.2}"{dashes}/>"#
        ));
    };
    for crossing in network.crossings.iter().filter(|strip| near(&[strip.start, strip.end])) {
        let dashes = r#" stroke-dasharray="0.5 0.5""#;
        stroke(path(&[crossing.start, crossing.end]), "#ffffff", crossing.width, dashes);
    }
    for road in network.roads.iter().filter(|road| near(&road.centerline)) {
        let length = polyline::length(&road.centerline);
        let middle =
            polyline::slice(&road.centerline, 14.0_f64.min(length * 0.3), (length - 14.0).max(length * 0.7));
        stroke(path(&middle), "#ffffff", 0.15, r#" stroke-dasharray="3 3""#);
    }
}

const fn lamp(aspect: Aspect) -> &'static str {
    match aspect {
        Aspect::Red => "#c62828",
        Aspect::Yellow => "#f9a825",
        Aspect::Green => "#2e9d55",
    }
}

fn draw_signal(sheet: &mut Sheet, at: &Point2, aspects: &[Aspect], seconds: f64) {
    let last = (aspects.len().max(2) - 1) as f64;
    let (mut values, mut times) = (String::new(), String::new());
    for (index, aspect) in aspects.iter().enumerate() {
        if index == 0 || aspects[index - 1] != *aspect {
            let separator = if index == 0 { "" } else { ";" };
            // Writing to a string never fails.
            let _ = write!(values, "{separator}{}", lamp(*aspect));
            let _ = write!(times, "{separator}{:.4}", index as f64 / last);
        }
    }
    let first = aspects.first().copied().unwrap_or_default();
    sheet.raw(&format!(
        r#"<circle cx="{:.2}" cy="{:.2}" r="0.8" fill="{}"><animate attributeName="fill" calcMode="discrete" values="{values}" keyTimes="{times}" dur="{seconds}s" repeatCount="indefinite"/></circle>"#,
        at.x,
        at.y,
        lamp(first)
    ));
}

/// One body: its places, its turns and whether it is there, each an animation.
fn draw_actor(sheet: &mut Sheet, actor: &Actor, frames: usize, seconds: f64) {
    let Some(mut last) = actor.places.iter().flatten().next().copied() else { return };
    let (mut moves, mut turns, mut shown, mut times) =
        (String::new(), String::new(), String::new(), String::new());
    let mut degrees = last.1.to_degrees();
    for frame in 0..frames {
        let place = actor.places.get(frame).copied().flatten();
        if let Some(place) = place {
            degrees += wrap_angle(place.1 - degrees.to_radians()).to_degrees();
            last = place;
        }
        let separator = if frame == 0 { "" } else { ";" };
        // Writing to a string never fails.
        let _ = write!(moves, "{separator}{:.2} {:.2}", last.0.x, last.0.y);
        let _ = write!(turns, "{separator}{degrees:.1}");
        let _ = write!(shown, "{separator}{}", u8::from(place.is_some()));
        let _ = write!(times, "{separator}{:.4}", frame as f64 / (frames.max(2) - 1) as f64);
    }
    let (length, width) = actor.size;
    let body = if length == width {
        format!(r#"<circle r="{:.2}" fill="{}"/>"#, length * 0.5, escaped(actor.fill))
    } else {
        let (x, y) = (-length * 0.5, -width * 0.5);
        format!(
            r##"<rect x="{x:.2}" y="{y:.2}" width="{length:.2}" height="{width:.2}" rx="0.5" fill="{0}"/><rect x="{1:.2}" y="{2:.2}" width="0.9" height="{3:.2}" rx="0.2" fill="#dfe7ea"/>"##,
            actor.fill,
            length * 0.5 - 1.9,
            y + 0.2,
            width - 0.4
        )
    };
    let start = actor.places.first().copied().flatten();
    let common = format!(r#"keyTimes="{times}" dur="{seconds}s" repeatCount="indefinite""#);
    sheet.raw(&format!(
        r#"<g opacity="{}" transform="translate({:.2} {:.2})"><animate attributeName="opacity" calcMode="discrete" values="{shown}" {common}/><animateTransform attributeName="transform" type="translate" values="{moves}" {common}/><g transform="rotate({:.1})"><animateTransform attributeName="transform" type="rotate" values="{turns}" {common}/>{body}</g></g>"#,
        u8::from(start.is_some()),
        start.map_or(last.0.x, |place| place.0.x),
        start.map_or(last.0.y, |place| place.0.y),
        start.map_or(0.0, |place| place.1.to_degrees()),
    ));
}
