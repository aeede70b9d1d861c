//! Rows: things at even distances along a street, a thing, a line between two, or a circle.

use std::cmp::Reverse;

use simworld_core::geometry::{Point2, Pose, planar};
use simworld_core::scene::EntityDesc;

use super::apply::Applier;
use super::astray::Astray;
use super::edit::{Line, Make, Sides, Spacing, Stand};
use super::error::EditError;
use super::floor::Floors;
use super::land::Land;
use super::place::Placer;
use super::placing::{Candidate, Outcome, Placing};
use super::relax::Relaxed;
use super::sample::{Item, Sampler};
use super::solid::Solid;
use super::stand::Subject;
use super::tracks::{HAND, Track, stations, tracks};

/// How far from its place a thing of a row may stand, as a share of the distance to the next.
const SLIDES: [f64; 5] = [0.0, 0.05, -0.05, 0.1, -0.1];
/// The same where it was said how many they are, all of which have to stand.
const WIDE_SLIDES: [f64; 11] = [0.0, 0.05, -0.05, 0.1, -0.1, 0.15, -0.15, 0.2, -0.2, 0.24, -0.24];
/// Where this share of the places of a row does not do, the row is refused.
const LEAST_SHARE: f64 = 0.5;
/// A ring is as full as another by this share of its places.
const NEARLY: f64 = 0.05;

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
