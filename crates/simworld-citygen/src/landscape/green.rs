//! What covers the land: woods, fields with hedges, orchards, sand and rock, and what grows on each.
//!
//! Fields of 0.8 ha are those of small-scale farmland (the mean of European fields is 1 to 10 ha by region: Clough et al. 2020).

use fastnoise_lite::{FastNoiseLite, FractalType};
use simworld_core::geometry::{Point2, Vector2, direction};
use simworld_core::ground::Cover;
use simworld_core::seed::Stream;
use simworld_core::spec::{Amount, SceneKind};

use super::grid::Grid;
use super::plants::{FOREST, Plant, scattered, species};
use super::relief::{at, noise, smooth};
use crate::terrain::HeightField;

/// Above this share of the highest land no trees stand.
const TREE_LINE: f64 = 0.78;
/// Too steep for trees and for fields, rise over run; steeper still is bare rock.
const STEEP: f64 = 0.75;
const FARMED: f64 = 0.16;
const BARE: f64 = 0.8;
/// Beaches reach so high above the water, m.
const BEACH: f64 = 1.6;
/// Trees stand so far from ways, m, and so high above the water, m.
const CLEAR: f64 = 1.0;
const BANK: f64 = 0.45;
/// Along and across a field, m; between two fields; a piece of hedge.
const FIELD: (f64, f64) = (108.0, 74.0);
const HEDGE: f64 = 6.0;
/// Trees a square metre of an orchard.
const ORCHARD: f64 = 0.009;

/// The green of a place.
pub(super) struct Green {
    kind: SceneKind,
    amount: f64,
    highest: f64,
    woods: FastNoiseLite,
    damp: FastNoiseLite,
    /// How the fields lie, radians.
    along: f64,
}

impl Green {
    pub(super) fn new(kind: SceneKind, trees: Amount, grid: &Grid, stream: Stream) -> Self {
        let amount = match trees {
            Amount::None => 0.0,
            Amount::Few => 0.35,
            Amount::Usual => 1.0,
            Amount::Many => 1.6,
        };
        let highest = grid.heights.iter().copied().fold(1.0, f64::max);
        Self {
            kind,
            amount,
            highest,
            woods: noise(stream.named("woods"), 190.0, 3, FractalType::FBm),
            damp: noise(stream.named("damp"), 140.0, 2, FractalType::FBm),
            along: stream.named("fields").rng().uniform(-0.5, 0.5),
        }
    }

    /// How damp it is, in [0, 1]: near the water and in hollows.
    fn dampness(&self, grid: &Grid, place: Point2) -> f64 {
        (0.5 + 0.3 * at(&self.damp, place) + 0.5 * smooth(6.0, 1.0, grid.height(place))).clamp(0.0, 1.0)
    }

    /// Trees a square metre that the land wants, apart from ways and houses.
    pub(super) fn density(&self, grid: &Grid, place: Point2) -> f64 {
        let height = grid.height(place);
        let slope = grid.slope(place);
        if height < BANK || slope > STEEP || self.amount == 0.0 {
            return 0.0;
        }
        let high = if self.kind == SceneKind::Wilderness { TREE_LINE } else { 1.1 };
        let (cut, open) = match self.kind {
            SceneKind::Wilderness => (-0.55, 0.12),
            SceneKind::Island => (-0.15, 0.05),
            _ => (0.18, 0.02),
        };
        // More trees mean wider woods, and denser ones.
        let cut = cut - 0.35 * (self.amount - 1.0);
        let wood = smooth(cut - 0.06, cut + 0.06, at(&self.woods, place));
        let up = 1.0 - smooth(high - 0.12, high, height / self.highest);
        let shore = if self.kind == SceneKind::Island { smooth(1.5, 3.5, height) } else { 1.0 };
        let damp = 0.75 + 0.25 * self.dampness(grid, place);
        FOREST * 1e-4 * self.amount.min(1.3) * up * shore * damp * (open + (1.0 - open) * wood)
    }

    /// Covers the land, and says what grows and lies there.
    pub(super) fn grown(&self, grid: &mut Grid, stream: Stream) -> Vec<Plant> {
        let farmed = if self.kind == SceneKind::Countryside { self.fields(grid, stream) } else { Vec::new() };
        let mut covers = grid.covers.clone();
        for (index, cover) in covers.iter_mut().enumerate() {
            let (place, height) = (grid.place(index), grid.heights[index]);
            if grid.made[index] || matches!(*cover, Cover::Crop | Cover::Soil | Cover::Meadow) {
                continue;
            }
            *cover = match () {
                () if height < BEACH && (height < 0.3 || self.kind == SceneKind::Island) => Cover::Sand,
                () if grid.slope(place) > BARE => Cover::Rock,
                () if self.kind == SceneKind::Wilderness && height > 0.92 * self.highest => Cover::Rock,
                () if self.density(grid, place) > 0.3 * FOREST * 1e-4 => Cover::Wood,
                () if self.kind == SceneKind::Wilderness => Cover::Meadow,
                () => *cover,
            };
        }
        grid.covers = covers;
        let mut plants = self.trees(grid, stream);
        plants.extend(farmed);
        plants.extend(boulders(grid, stream));
        plants
    }

    fn trees(&self, grid: &Grid, stream: Stream) -> Vec<Plant> {
        let density = |place: Point2| {
            let cover = grid.covers[grid.nearest(place)];
            if matches!(cover, Cover::Crop | Cover::Soil | Cover::Meadow)
                && self.kind == SceneKind::Countryside
            {
                return 0.0;
            }
            let density = self.density(grid, place);
            if density > 0.0 && grid.is_made_near(place, CLEAR) { 0.0 } else { density }
        };
        let places = scattered(grid, stream.named("trees"), density);
        let mut rng = stream.named("species").rng();
        let plant = |at: Point2| {
            let share = grid.height(at) / self.highest;
            let share = if self.kind == SceneKind::Wilderness { share } else { share * 0.4 };
            let asset = species(share, self.dampness(grid, at), rng.unit());
            Plant { asset, at, facing: rng.uniform(-3.1, 3.1), scale: rng.uniform(0.6, 1.1) }
        };
        places.into_iter().map(plant).collect()
    }

    /// Divides even dry land that is no wood into fields, each with its crop and a hedge at its edges; some are orchards.
    fn fields(&self, grid: &mut Grid, stream: Stream) -> Vec<Plant> {
        let mut rng = stream.named("crops").rng();
        let (east, north) = (direction(self.along), direction(self.along + std::f64::consts::FRAC_PI_2));
        let reach = (grid.half * 1.5 / FIELD.1) as i32;
        let mut plants = Vec::new();
        for row in -reach..=reach {
            for column in -reach..=reach {
                let corner =
                    Point2::from(east * (f64::from(column) * FIELD.0) + north * (f64::from(row) * FIELD.1));
                let (roll, turn) = (rng.unit(), rng.bits());
                let field = Field { corner, east, north };
                if !self.is_field(grid, &field) {
                    continue;
                }
                let cover = [Cover::Crop, Cover::Soil, Cover::Crop, Cover::Meadow][(roll * 4.0) as usize % 4];
                for index in 0..grid.heights.len() {
                    if !grid.made[index] && field.holds(grid.place(index), 1.5) {
                        grid.covers[index] = cover;
                    }
                }
                plants.extend(field.hedges(grid));
                if cover == Cover::Meadow && turn % 2 == 0 && self.amount > 0.0 {
                    plants.extend(field.orchard(grid));
                }
            }
        }
        plants
    }

    /// Whether most of a field is even, dry and no wood, and all of it is on the land.
    fn is_field(&self, grid: &Grid, field: &Field) -> bool {
        let samples: Vec<Point2> = (0..48)
            .map(|index| field.at((f64::from(index % 8) + 0.5) / 8.0, (f64::from(index / 8) + 0.5) / 6.0))
            .collect();
        let fits = |place: &Point2| {
            grid.height(*place) > 1.0
                && grid.slope(*place) < FARMED
                && self.density(grid, *place) < 0.3 * FOREST * 1e-4
        };
        samples.iter().all(|place| grid.holds(*place, 6.0))
            && samples.iter().filter(|place| fits(place)).count() >= 40
            && samples.iter().all(|place| grid.height(*place) > 0.5)
            && samples.iter().filter(|place| grid.is_made_near(**place, 2.0)).count() <= 6
    }
}

/// A field by its first corner and the directions of its sides.
struct Field {
    corner: Point2,
    east: Vector2,
    north: Vector2,
}

impl Field {
    fn at(&self, along: f64, up: f64) -> Point2 {
        self.corner + self.east * (along * FIELD.0) + self.north * (up * FIELD.1)
    }

    fn holds(&self, place: Point2, margin: f64) -> bool {
        let off = place - self.corner;
        let (x, y) = (off.dot(&self.east), off.dot(&self.north));
        (margin..=FIELD.0 - margin).contains(&x) && (margin..=FIELD.1 - margin).contains(&y)
    }

    /// Hedges along its southern and western edge, with a gate, where no way passes; its neighbours have the others.
    fn hedges(&self, grid: &Grid) -> Vec<Plant> {
        let mut plants = Vec::new();
        let edges = [(self.east, FIELD.0), (self.north, FIELD.1)];
        for (way, length) in edges {
            let pieces = (length / HEDGE) as u32;
            for piece in 1..pieces {
                let at = self.corner + way * (f64::from(piece) * HEDGE);
                let is_gate = piece == pieces / 2;
                if !is_gate && !grid.is_made_near(at, HEDGE * 0.5 + 2.5) && grid.height(at) > BANK {
                    let facing = simworld_core::geometry::heading(&way) + std::f64::consts::FRAC_PI_2;
                    plants.push(Plant { asset: "tall_hedge", at, facing, scale: 1.0 });
                }
            }
        }
        plants
    }

    /// Rows of apple trees.
    fn orchard(&self, grid: &Grid) -> Vec<Plant> {
        let apart = (1.0 / ORCHARD).sqrt();
        let (columns, rows) = ((FIELD.0 / apart) as u32, (FIELD.1 / apart) as u32);
        let places = (1..rows).flat_map(|row| {
            (1..columns).map(move |column| {
                self.at(f64::from(column) / f64::from(columns), f64::from(row) / f64::from(rows))
            })
        });
        let free = places.filter(|place| !grid.is_made_near(*place, 4.0) && grid.height(*place) > BANK);
        free.map(|at| Plant { asset: "apple_tree", at, facing: 0.0, scale: 1.0 }).collect()
    }
}

/// Boulders on rock and under it.
fn boulders(grid: &Grid, stream: Stream) -> Vec<Plant> {
    let density = |place: Point2| {
        let rocky = grid.covers[grid.nearest(place)] == Cover::Rock || grid.slope(place) > 0.6;
        if rocky && grid.height(place) > BANK && !grid.is_made_near(place, 3.0) { 0.004 } else { 0.0 }
    };
    let places = scattered(grid, stream.named("boulders"), density);
    let mut rng = stream.named("sizes").rng();
    let plant =
        |at| Plant { asset: "boulder", at, facing: rng.uniform(-3.1, 3.1), scale: rng.uniform(0.5, 1.5) };
    places.into_iter().map(plant).collect()
}
