//! Rows: things at even distances along a street, a thing, a line between two, or a circle.

use std::cmp::Reverse;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use simworld_core::geometry::{Point2, Pose, direction, heading, planar};
use simworld_core::id::RoadId;
use simworld_core::net::polyline;
use simworld_core::scene::EntityDesc;

use super::apply::Applier;
use super::astray::Astray;
use super::edit::{Line, Make, Sides, Spacing, Stand};
use super::error::EditError;
use super::floor::Floors;
use super::land::{Land, Streets};
use super::place::Placer;
use super::placing::{Candidate, Outcome, Placing};
use super::relax::Relaxed;
use super::sample::{Item, Sampler, Spot};
use super::solid::Solid;
use super::stand::{ROADSIDE, Subject};

/// How far from its place a thing of a row may stand, as a share of the distance to the next.
const SLIDES: [f64; 5] = [0.0, 0.05, -0.05, 0.1, -0.1];
/// The same where it was said how many they are, all of which have to stand.
const WIDE_SLIDES: [f64; 11] = [0.0, 0.05, -0.05, 0.1, -0.1, 0.15, -0.15, 0.2, -0.2, 0.24, -0.24];
/// Where this share of the places of a row does not do, the row is refused.
const LEAST_SHARE: f64 = 0.5;
/// A ring is as full as another by this share of its places.
const NEARLY: f64 = 0.05;
/// Off a kerb or a wall things of a row are tried so far, m.
const OFFS: [f64; 7] = [0.5, 0.8, 1.2, 1.8, 2.4, 3.2, 4.2];
/// Between things of a row there is a hand's breadth, m.
const HAND: f64 = 0.1;
/// More things in a row are refused.
const MOST: usize = 1000;

/// A way along which a row may stand: where a station along it is, at a distance off it.
struct Track<'a> {
    length: f64,
    /// Whether its end is its beginning.
    is_ring: bool,
    offs: Vec<f64>,
    spot: Box<dyn Fn(f64, f64) -> Option<Spot> + 'a>,
}

/// Adds a sentence to an answer.
pub(super) fn tell(answer: &mut Option<String>, more: &str) {
    *answer = Some(answer.take().map_or_else(|| more.to_owned(), |before| format!("{before}; {more}")));
}

impl Applier<'_> {
    pub(super) fn row(&mut self, make: &Make, line: &Line, spacing: Spacing) -> Result<(), EditError> {
        let desc = self.recipe(make)?;
        let found = self.rows(&desc, line, spacing)?;
        let left_out: usize = found.iter().map(|row| row.left_out).sum();
        for row in found {
            for land in row.astray {
                let told = stands_of(line).first().map(|stand| stand.told(self.scene.world()));
                let what = desc.info.name.clone().unwrap_or_else(|| make_name(&desc));
                let astray = Astray { what, land, place: told.unwrap_or_default(), count: 1 };
                astray.add_to(&mut self.edited.astray);
            }
            self.tried.push(row.tried);
            for pose in row.poses {
                self.spawn(EntityDesc { pose, ..desc.clone() })?;
            }
        }
        if left_out > 0 {
            tell(
                &mut self.edited.answer,
                &format!("{left_out} places were left out: something stands there, or streets meet"),
            );
        }
        Ok(())
    }

    /// The rows that are to stand: one, or one on each side.
    fn rows(&mut self, desc: &EntityDesc, line: &Line, spacing: Spacing) -> Result<Vec<Row>, EditError> {
        let world = self.scene.world();
        let half = desc.info.shape.size().xy() * 0.5;
        let item = Item { kind: desc.kind, half, rank: (0, 1) };
        let sampler = Sampler { scene: world, streets: self.streets, item, from: self.focus.from };
        let wanted = Wanted { desc, stands: stands_of(line), floors: Floors::of(world, line) };
        let placer =
            Placer { scene: world, streets: self.streets, from: self.focus.from, lifted: &[], load: &[] };
        let tracks = tracks(&sampler, line).ok_or_else(|| missing(line))?;
        let mut rows = Vec::new();
        for track in &tracks {
            let stations = stations(track, spacing, half.x.max(half.y) * 2.0)?;
            rows.push(Row::best_on(track, &stations, spacing, &wanted, &placer));
        }
        let enough = |row: &Row| match spacing {
            Spacing::Count(_) => row.left_out == 0,
            Spacing::Every(_) => row.share() >= LEAST_SHARE,
        };
        if matches!(line, Line::Road { sides: Sides::Both, .. }) && rows.iter().any(enough) {
            rows.retain(enough);
            return Ok(rows);
        }
        // Of the sides that are as full that with most on their own ground, and of several rows as good the first.
        let best =
            if matches!(line, Line::Around { .. }) { best_ring(&rows) } else { best_line(&rows, line) };
        if rows.get(best).is_some_and(enough) {
            return Ok(vec![rows.swap_remove(best)]);
        }
        let asked = rows.get(best).map_or(0, |row| row.poses.len() + row.left_out);
        let instead = match fewer(&tracks, asked, &wanted, &placer) {
            Relaxed::Nothing => rows.get(best).map_or(Relaxed::Nothing, Row::free),
            found => found,
        };
        let tried = rows.into_iter().nth(best).map(|row| row.tried).unwrap_or_default();
        let what = format!("a row of {}", desc.info.name.clone().unwrap_or_else(|| make_name(desc)));
        let place = wanted.stands.first().map_or_else(String::new, |stand| stand.told(world));
        let why = tried.reasons(world);
        let relaxed = instead.told(world);
        self.tried.push(tried);
        Err(EditError::NoRoom { what, place, why, relaxed, instead: Box::new(instead) })
    }
}

/// Of lines the fullest; of those that are as full that with most on their own ground, where it has sides, and then the first.
fn best_line(rows: &[Row], line: &Line) -> usize {
    let has_sides = matches!(line, Line::Road { .. } | Line::RoadSide { .. } | Line::Along { .. });
    let best = rows.iter().enumerate().max_by_key(|(rank, row)| {
        let astray = if has_sides { row.astray.len() } else { 0 };
        (row.poses.len(), Reverse(astray), Reverse(*rank))
    });
    best.map(|(rank, _)| rank).unwrap_or_default()
}

/// Of rings the nearest that is nearly as full as any: a wider one has more places, and is no better for it.
fn best_ring(rings: &[Row]) -> usize {
    let most = rings.iter().map(Row::share).fold(0.0, f64::max);
    rings.iter().position(|ring| ring.share() >= most - NEARLY).unwrap_or_default()
}

fn make_name(desc: &EntityDesc) -> String {
    desc.kind.as_str().replace('_', " ")
}

fn missing(line: &Line) -> EditError {
    let wanted = if matches!(line, Line::Road { .. } | Line::RoadSide { .. }) {
        "street"
    } else {
        "thing to line up along"
    };
    EditError::NotFound { wanted: wanted.to_owned(), near: "it is gone".to_owned() }
}

/// What holds of each thing of the row.
fn stands_of(line: &Line) -> Vec<Stand> {
    match line {
        Line::Road { roads, .. } => vec![Stand::AlongRoad { roads: roads.clone() }],
        Line::RoadSide { roads, heading } => vec![
            Stand::AlongRoad { roads: roads.clone() },
            Stand::OnSide { roads: roads.clone(), heading: *heading },
        ],
        Line::Along { anchor } => vec![Stand::Along { anchor: *anchor }],
        Line::Between { one, other } => vec![Stand::Between { one: *one, other: *other }],
        Line::Around { anchor } => vec![Stand::Apart { anchor: *anchor, least: 0.0, most: 30.0 }],
    }
}

/// The largest number below another that do fit evenly, all of them, on one of the tracks. A row of fewer may be refused where one
/// of more fits, so that it is looked for from above; of many not every number is tried at first.
fn fewer(tracks: &[Track<'_>], below: usize, wanted: &Wanted<'_>, placer: &Placer<'_>) -> Relaxed {
    let size = wanted.desc.info.shape.size().xy();
    // More than these stand in each other's way, one behind the other too.
    let most = |track: &Track<'_>| (track.length / (size.min() + HAND) + 1.0) * track.offs.len() as f64;
    let room = tracks.iter().map(most).fold(0.0, f64::max) as u32;
    let fits = |count: u32| {
        tracks.iter().find_map(|track| {
            let spacing = Spacing::Count(count);
            let stations = stations(track, spacing, size.max()).ok()?;
            let row = Row::on(track, &stations, spacing, wanted, placer, Search::ToTheFirstGap);
            let spacing = track.length / f64::from(count);
            (row.left_out == 0).then_some(Relaxed::Fewer { count, spacing })
        })
    };
    let (mut above, mut count) = (below as u32, (below as u32).saturating_sub(1).min(room));
    while count > 0 {
        if let Some(found) = fits(count) {
            return (count + 1..above.min(room.saturating_add(1))).rev().find_map(fits).unwrap_or(found);
        }
        above = count;
        count -= (1 + count / 24).min(count);
    }
    Relaxed::Nothing
}

/// What a row is made of, and how each of it is to stand.
struct Wanted<'a> {
    desc: &'a EntityDesc,
    stands: Vec<Stand>,
    floors: Floors,
}

/// How a row is looked for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Search {
    /// As far as the line goes.
    WholeLine,
    /// The same, on nothing but ground that is for such things, and as nearly even as where nobody said how many there are.
    OwnGround,
    /// Until one of them has no place: then not all fit.
    ToTheFirstGap,
}

/// A row that was looked for.
struct Row {
    poses: Vec<Pose>,
    left_out: usize,
    tried: Placing,
    /// On what ground those of it stand that do not stand on their own.
    astray: Vec<Land>,
}

impl Row {
    /// Which share of its places is taken; of none none.
    fn share(&self) -> f64 {
        self.poses.len() as f64 / (self.poses.len() + self.left_out).max(1) as f64
    }

    /// The places of it that are free, though no row of any number is.
    fn free(&self) -> Relaxed {
        let at: Vec<Point2> = self.poses.iter().map(planar).collect();
        if at.is_empty() { Relaxed::Nothing } else { Relaxed::Free { at } }
    }

    /// The row along a track: on ground that is for such things, if none of those is lost by it that stand there otherwise.
    fn best_on(
        track: &Track<'_>,
        stations: &[f64],
        spacing: Spacing,
        wanted: &Wanted<'_>,
        placer: &Placer<'_>,
    ) -> Self {
        let find = |search| Self::on(track, stations, spacing, wanted, placer, search);
        let row = find(Search::WholeLine);
        if row.astray.is_empty() {
            return row;
        }
        let own = find(Search::OwnGround);
        if own.poses.len() >= row.poses.len() { own } else { row }
    }

    fn on(
        track: &Track<'_>,
        stations: &[f64],
        spacing: Spacing,
        wanted: &Wanted<'_>,
        placer: &Placer<'_>,
        search: Search,
    ) -> Self {
        let Wanted { desc, stands, floors } = wanted;
        let step = match (spacing, stations) {
            (Spacing::Every(step), _) => step,
            (Spacing::Count(_), [first, second, ..]) => second - first,
            (Spacing::Count(_), _) => track.length * 0.5,
        };
        let is_counted = matches!(spacing, Spacing::Count(_)) && search != Search::OwnGround;
        let slides: &[f64] = if is_counted { &WIDE_SLIDES } else { &SLIDES };
        let mut row = Self { poses: Vec::new(), left_out: 0, tried: Placing::default(), astray: Vec::new() };
        let mut solids: Vec<Solid> = Vec::new();
        // What was off the line so far stands best there again: a row is straight.
        let mut offs = track.offs.clone();
        for station in stations {
            let subject = Subject { id: None, kind: desc.kind, info: &desc.info };
            let mut found = None;
            'places: for (rank, off) in offs.iter().enumerate() {
                for slide in slides {
                    let Some(spot) = (track.spot)(station + slide * step, *off) else { continue };
                    let (solid, mut outcome) = floors.judge(placer, subject, stands, &spot);
                    if solids.iter().any(|other| other.overlaps(&solid.inflated(HAND))) {
                        outcome = Outcome::Elsewhere;
                    }
                    let candidate = Candidate { pose: solid.pose, outcome };
                    let fit = candidate.fit().filter(|fit| search != Search::OwnGround || !fit.astray);
                    row.tried.candidates.push(candidate);
                    if let Some(fit) = fit {
                        found = Some((rank, solid));
                        row.astray.extend(fit.astray.then_some(fit.land));
                        break 'places;
                    }
                }
            }
            if let Some((rank, solid)) = found {
                offs[..=rank].rotate_right(1);
                row.tried.taken = Some(row.tried.candidates.len() - 1);
                row.poses.push(solid.pose);
                solids.push(solid);
            } else {
                row.left_out += 1;
                if search == Search::ToTheFirstGap {
                    break;
                }
            }
        }
        row
    }
}

/// Where along a track things stand, m; refuses distances that no row has.
fn stations(track: &Track<'_>, spacing: Spacing, extent: f64) -> Result<Vec<f64>, EditError> {
    let length = track.length;
    let impossible = |what: String, why: String| Err(EditError::Impossible { what, why });
    match spacing {
        Spacing::Every(step) => {
            let what = format!("a row with one every {step:.2} m");
            if step.is_nan() || step < extent + HAND {
                return impossible(
                    what,
                    format!("each of them is {extent:.1} m long; name a greater distance"),
                );
            }
            if step > length {
                return impossible(what, format!("there are only {length:.0} m; name a smaller distance"));
            }
            let whole = (length / step + 1e-9).floor();
            // A ring is closed, so that it is shared evenly by as many as come closest to the distance and have room.
            let nearest = (length / step).round().max(1.0);
            let has_room = length / nearest >= extent + HAND;
            let count = if track.is_ring && has_room { nearest } else { whole } as usize;
            if count > MOST {
                return impossible(
                    what,
                    format!("that would be {count} things; at most {MOST} stand in a row"),
                );
            }
            if track.is_ring {
                return Ok((0..count).map(|rank| rank as f64 / count as f64 * length).collect());
            }
            let rest = length - count as f64 * step;
            Ok((0..count).map(|rank| rest * 0.5 + (rank as f64 + 0.5) * step).collect())
        }
        Spacing::Count(count) => {
            if count == 0 || count as usize > MOST {
                let what = format!("a row of {count} things");
                return impossible(what, format!("name one to {MOST}"));
            }
            // A ring ends where it begins, and a line half a step before its end.
            let first = if track.is_ring { 0.0 } else { 0.5 };
            let share = |rank: u32| (f64::from(rank) + first) / f64::from(count);
            Ok((0..count).map(|rank| share(rank) * length).collect())
        }
    }
}

/// The ways along which a row may stand, the likeliest first; `None` if what it is along is not there.
fn tracks<'a>(sampler: &'a Sampler<'a>, line: &'a Line) -> Option<Vec<Track<'a>>> {
    let solid = |id| sampler.scene.entity(id).map(|entity| Solid::of(&entity));
    match line {
        Line::Road { roads, .. } | Line::RoadSide { roads, .. } => {
            let streets = sampler.streets?;
            if roads.is_empty() || roads.iter().any(|road| road.index() >= streets.network().roads.len()) {
                return None;
            }
            let chains = chains(streets, roads);
            Some([false, true].map(|left| roadside(sampler, streets, chains.clone(), left)).into())
        }
        Line::Along { anchor } => Some(long_sides(sampler, solid(*anchor)?)),
        Line::Between { one, other } => Some(straight(sampler, solid(*one)?, solid(*other)?)),
        Line::Around { anchor } => Some(rings(sampler, solid(*anchor)?)),
    }
}

/// The pieces of a street in their order, each with whether it is followed backwards.
type Chain = Vec<(RoadId, bool)>;

/// Puts the pieces of a street one behind the other; what hangs on nothing comes behind.
fn chains(streets: &Streets, roads: &[RoadId]) -> Chain {
    let ends = |road: RoadId| (streets.road(road).from, streets.road(road).to);
    let mut left: Vec<RoadId> = roads.to_vec();
    left.sort_unstable();
    left.dedup();
    let mut chain = Chain::new();
    let mut at = None;
    while !left.is_empty() {
        let next = at.and_then(|at| left.iter().position(|road| ends(*road).0 == at || ends(*road).1 == at));
        let index = next.unwrap_or_else(|| {
            // An end of the street: a junction at which only one of the pieces ends.
            let touching =
                |place| left.iter().filter(|road| ends(**road).0 == place || ends(**road).1 == place).count();
            let is_end = |road: &RoadId| touching(ends(*road).0) == 1 || touching(ends(*road).1) == 1;
            left.iter().position(is_end).unwrap_or(0)
        });
        let road = left.remove(index);
        let (from, to) = ends(road);
        let backwards = match at.filter(|at| *at == from || *at == to) {
            Some(at) => at == to,
            None => {
                left.iter().any(|other| ends(*other).0 == from || ends(*other).1 == from)
                    && !left.iter().any(|other| ends(*other).0 == to || ends(*other).1 == to)
            }
        };
        at = Some(if backwards { from } else { to });
        chain.push((road, backwards));
    }
    chain
}

fn roadside<'a>(sampler: &'a Sampler<'a>, streets: &'a Streets, chain: Chain, left: bool) -> Track<'a> {
    let lengths: Vec<f64> =
        chain.iter().map(|(road, _)| polyline::length(&streets.road(*road).centerline)).collect();
    let length = lengths.iter().sum();
    let half = sampler.item.half;
    let parks = sampler.item.kind.is_vehicle();
    let spot = move |station: f64, off: f64| {
        let mut station = station;
        let index = lengths.iter().position(|length| {
            let here = station <= *length;
            station -= if here { 0.0 } else { *length };
            here
        })?;
        let (id, backwards) = chain[index];
        let road = streets.road(id);
        // The left of the street as it is followed is the right of a piece that is followed backwards.
        let (station, left) = if backwards { (lengths[index] - station, !left) } else { (station, left) };
        let kerb = if left { road.left_kerb } else { road.right_kerb };
        let offset = if parks { kerb - half.y - off * 0.3 } else { kerb + off + half.x };
        (station >= 0.0 && offset - kerb <= ROADSIDE)
            .then(|| sampler.on_edge(road, station, left, offset, 0.0))
    };
    Track { length, is_ring: false, offs: OFFS.to_vec(), spot: Box::new(spot) }
}

/// Both long sides; all four of a square.
fn long_sides<'a>(sampler: &'a Sampler<'a>, anchor: Solid) -> Vec<Track<'a>> {
    let half = anchor.half();
    let outwards: &[f64] = if half.x >= half.y { &[FRAC_PI_2, -FRAC_PI_2] } else { &[0.0, PI] };
    let side = |outward: &f64| {
        let out = direction(*outward);
        let along = direction(outward - FRAC_PI_2);
        let (deep, wide) = if half.x >= half.y { (half.y, half.x) } else { (half.x, half.y) };
        let yaw = sampler.yaw(anchor.yaw() + outward, &anchor);
        let own = if sampler.item.kind.is_vehicle() { sampler.item.half.y } else { sampler.item.half.x };
        let spot = move |station: f64, off: f64| {
            let local = out * (deep + off + own) + along * (station - wide);
            let at = anchor.world(Point2::from(local));
            (station.abs() <= wide * 2.0).then_some(Spot { at, base: anchor.base(), yaw, odd: 0.0 })
        };
        let offs = OFFS.iter().copied().filter(|off| off + own * 2.0 <= 4.0 + own).collect();
        Track {
            length: wide * 2.0,
            is_ring: false,
            offs,
            spot: Box::new(spot) as Box<dyn Fn(f64, f64) -> Option<Spot>>,
        }
    };
    outwards.iter().map(side).collect()
}

/// From edge to edge of two things, on the line between them or beside it.
fn straight<'a>(sampler: &'a Sampler<'a>, one: Solid, other: Solid) -> Vec<Track<'a>> {
    let along = other.planar() - one.planar();
    let length = along.norm().max(1e-6);
    let way = along / length;
    let beside = simworld_core::geometry::Vector2::new(-way.y, way.x);
    let yaw = if sampler.item.kind.is_vehicle() { heading(&way) } else { heading(&way) + FRAC_PI_2 };
    let room = (length / 3.0).max(2.0) * 0.95;
    let asides = (0..20).map(|rank| f64::from((rank + 1) / 2) * if rank % 2 == 1 { 0.5 } else { -0.5 });
    let track = |aside: f64| {
        // Beside the line the row begins and ends where the line does.
        let from = edge(&one, way).min(length * 0.45);
        let to = length - edge(&other, -way).min(length * 0.45);
        let spot = move |station: f64, _: f64| {
            let at = one.planar() + way * (from + station) + beside * aside;
            Some(Spot { at, base: one.base(), yaw, odd: 0.0 })
        };
        Track {
            length: to - from,
            is_ring: false,
            offs: vec![0.0],
            spot: Box::new(spot) as Box<dyn Fn(f64, f64) -> Option<Spot>>,
        }
    };
    asides.filter(|aside| aside.abs() <= room).map(track).collect()
}

/// From the middle of a thing to its edge in a direction, m.
fn edge(solid: &Solid, way: simworld_core::geometry::Vector2) -> f64 {
    solid.corners().into_iter().map(|corner| (corner - solid.planar()).dot(&way)).fold(0.0, f64::max)
}

/// Circles around a thing, the narrowest first.
fn rings<'a>(sampler: &'a Sampler<'a>, anchor: Solid) -> Vec<Track<'a>> {
    let least = anchor.half().norm() + sampler.item.half.norm();
    let ring = |(gap, turn): (f64, f64)| {
        let radius = least + gap;
        let spot = move |station: f64, _: f64| {
            let way = anchor.yaw() + turn + station / radius;
            let at = anchor.planar() + direction(way) * radius;
            Some(Spot { at, base: anchor.base(), yaw: sampler.yaw(way, &anchor), odd: 0.0 })
        };
        let spot: Box<dyn Fn(f64, f64) -> Option<Spot>> = Box::new(spot);
        Track { length: TAU * radius, is_ring: true, offs: vec![0.0], spot }
    };
    let gaps = [0.8, 1.2, 1.8, 2.5, 3.5, 5.0, 7.0, 10.0, 12.5, 15.0];
    gaps.into_iter().flat_map(|gap| [0.0, 0.13, 0.26].map(|turn| (gap, turn))).map(ring).collect()
}
