//! The ground: heights on a regular grid, what covers them, and how high the water stands.
//!
//! World frame, metres. One surface for everybody: between grid points it is made of two triangles a cell, cut from the
//! south-west to the north-east corner, and who maps, meets or draws it takes the same triangles. A world without one is
//! flat at height 0 and has no end.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::geometry::{Point2, Point3, Vector2, Vector3};
use crate::hash::{StateHash, StateHasher};

/// The most grid points along a side: a height field of 16 million points is 5 km of a point each metre.
const MOST_POINTS: u32 = 4096;
/// Heights beyond this are no ground, m: a little more than the highest mountain and the deepest sea.
const FARTHEST: f32 = 12_000.0;

/// Why heights are no ground.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum GroundError {
    /// Too few or too many points.
    #[error("a ground of {columns} by {rows} points: give 2 to {MOST_POINTS} each way")]
    Size {
        /// Points from west to east.
        columns: u32,
        /// Points from south to north.
        rows: u32,
    },
    /// A list of another length.
    #[error("{given} {what} for {wanted} points: give one a point, row by row from the south")]
    Count {
        /// Heights or covers.
        what: &'static str,
        /// How many were given.
        given: usize,
        /// How many points there are.
        wanted: usize,
    },
    /// A place, a spacing or a water level out of range.
    #[error("{field} = {value} is out of range: give {allowed}")]
    Range {
        /// The field.
        field: &'static str,
        /// The refused value, m.
        value: f64,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// A height that is none.
    #[error("the height of point {index} is {height}: give a number within ±{FARTHEST} m")]
    Height {
        /// Index of the point.
        index: usize,
        /// What was given, m.
        height: f32,
    },
}

/// What covers the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Cover {
    /// Short grass.
    #[default]
    Grass,
    /// Tall grass and herbs, above the trees too.
    Meadow,
    /// The floor of a wood.
    Wood,
    /// A field with a crop.
    Crop,
    /// A ploughed field.
    Soil,
    /// Sand: beaches, and what lies under shallow water.
    Sand,
    /// Bare rock and scree.
    Rock,
    /// A trodden path.
    Path,
    /// Under a street or a house.
    Built,
}

impl Cover {
    /// Every cover.
    pub const ALL: &'static [Self] = &[
        Self::Grass,
        Self::Meadow,
        Self::Wood,
        Self::Crop,
        Self::Soil,
        Self::Sand,
        Self::Rock,
        Self::Path,
        Self::Built,
    ];

    /// The name in files.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Grass => "grass",
            Self::Meadow => "meadow",
            Self::Wood => "wood",
            Self::Crop => "crop",
            Self::Soil => "soil",
            Self::Sand => "sand",
            Self::Rock => "rock",
            Self::Path => "path",
            Self::Built => "built",
        }
    }
}

/// What a ground is made of, before it is checked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GroundData {
    /// The south-western grid point, m.
    pub origin: Point2,
    /// Between neighbouring points, m, 0.1 to 1000.
    pub spacing: f64,
    /// Points from west to east.
    pub columns: u32,
    /// Points from south to north.
    pub rows: u32,
    /// Heights, row by row from the south, m; in single precision, a tenth of a millimetre at a kilometre.
    pub heights: Vec<f32>,
    /// What covers the ground around each point.
    pub covers: Vec<Cover>,
    /// How high the water stands, m: what lies lower is under it. None on dry land.
    pub water: Option<f64>,
}

/// The surface that everything stands on, where the world is not flat.
///
/// ```
/// use simworld_core::geometry::Point2;
/// use simworld_core::ground::{Cover, Ground, GroundData};
/// // A bank that falls to the east into water.
/// let ground = Ground::new(GroundData {
///     origin: Point2::origin(),
///     spacing: 10.0,
///     columns: 3,
///     rows: 2,
///     heights: vec![4.0, 2.0, -1.0, 4.0, 2.0, -1.0],
///     covers: vec![Cover::Grass; 6],
///     water: Some(0.0),
/// })?;
/// assert_eq!(ground.height(Point2::new(5.0, 5.0)), 3.0);
/// assert!(ground.is_wet(Point2::new(18.0, 5.0)) && !ground.is_wet(Point2::new(12.0, 5.0)));
/// # Ok::<(), simworld_core::ground::GroundError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "GroundData", into = "GroundData")]
pub struct Ground {
    data: GroundData,
    /// Of the data, so that a world need not read all of it at each step.
    digest: u64,
}

impl Ground {
    /// A ground of that data.
    ///
    /// # Errors
    /// The first thing that is out of range.
    pub fn new(data: GroundData) -> Result<Self, GroundError> {
        let GroundData { origin, spacing, columns, rows, ref heights, ref covers, water } = data;
        if !(2..=MOST_POINTS).contains(&columns) || !(2..=MOST_POINTS).contains(&rows) {
            return Err(GroundError::Size { columns, rows });
        }
        let wanted = columns as usize * rows as usize;
        for (what, given) in [("heights", heights.len()), ("covers", covers.len())] {
            if given != wanted {
                return Err(GroundError::Count { what, given, wanted });
            }
        }
        let checks = [
            ("origin.x", origin.x, -1e7..=1e7, "±1e7 m"),
            ("origin.y", origin.y, -1e7..=1e7, "±1e7 m"),
            ("spacing", spacing, 0.1..=1000.0, "0.1 to 1000 m"),
            ("water", water.unwrap_or(0.0), -12_000.0..=12_000.0, "±12 000 m"),
        ];
        for (field, value, range, allowed) in checks {
            if !range.contains(&value) {
                return Err(GroundError::Range { field, value, allowed });
            }
        }
        if let Some(index) = heights.iter().position(|height| !(-FARTHEST..=FARTHEST).contains(height)) {
            return Err(GroundError::Height { index, height: heights[index] });
        }
        let digest = digest_of(&data);
        Ok(Self { data, digest })
    }

    /// What it is made of.
    pub fn data(&self) -> &GroundData {
        &self.data
    }

    /// Its least and its greatest corner, m. Beyond them nothing carries anybody.
    pub fn extent(&self) -> (Point2, Point2) {
        let GroundData { origin, spacing, columns, rows, .. } = self.data;
        (origin, origin + Vector2::new(f64::from(columns - 1), f64::from(rows - 1)) * spacing)
    }

    /// Whether a point lies on it.
    pub fn holds(&self, point: Point2) -> bool {
        let (low, high) = self.extent();
        (low.x..=high.x).contains(&point.x) && (low.y..=high.y).contains(&point.y)
    }

    /// The height at a point, m; beyond its edge that of the nearest place on it.
    pub fn height(&self, point: Point2) -> f64 {
        let Corner { west, south, along, up } = self.corner(point);
        let at = |column: usize, row: usize| self.at(west + column, south + row);
        let (a, c) = (at(0, 0), at(1, 1));
        // The triangle below the diagonal has the south-eastern corner, that above it the north-western.
        if along >= up {
            let b = at(1, 0);
            a + (b - a) * along + (c - b) * up
        } else {
            let b = at(0, 1);
            a + (b - a) * up + (c - b) * along
        }
    }

    /// The point of the surface at a place, m.
    pub fn point(&self, place: Point2) -> Point3 {
        Point3::new(place.x, place.y, self.height(place))
    }

    /// The upward normal at a point, of length 1.
    pub fn normal(&self, point: Point2) -> Vector3 {
        let Corner { west, south, along, up } = self.corner(point);
        let at = |column: usize, row: usize| self.at(west + column, south + row);
        let (east, north) = if along >= up {
            (at(1, 0) - at(0, 0), at(1, 1) - at(1, 0))
        } else {
            (at(1, 1) - at(0, 1), at(0, 1) - at(0, 0))
        };
        Vector3::new(-east, -north, self.data.spacing).normalize()
    }

    /// How steep it is at a point: rise over run.
    pub fn slope(&self, point: Point2) -> f64 {
        let normal = self.normal(point);
        normal.xy().norm() / normal.z
    }

    /// What covers it at a point: what covers the nearest grid point.
    pub fn cover(&self, point: Point2) -> Cover {
        let Corner { west, south, along, up } = self.corner(point);
        let (column, row) = (west + usize::from(along >= 0.5), south + usize::from(up >= 0.5));
        self.data.covers[row * self.data.columns as usize + column]
    }

    /// How high the water stands, m, if there is any.
    pub fn water(&self) -> Option<f64> {
        self.data.water
    }

    /// Whether a point is under water.
    pub fn is_wet(&self, point: Point2) -> bool {
        self.data.water.is_some_and(|water| self.height(point) < water)
    }

    fn at(&self, column: usize, row: usize) -> f64 {
        f64::from(self.data.heights[row * self.data.columns as usize + column])
    }

    /// The cell of a point and where in it the point is.
    fn corner(&self, point: Point2) -> Corner {
        let GroundData { origin, spacing, columns, rows, .. } = self.data;
        let local = (point - origin) / spacing;
        let cell = |x: f64, count: u32| x.clamp(0.0, f64::from(count - 2)).floor();
        let (west, south) = (cell(local.x, columns), cell(local.y, rows));
        let share = |x: f64| x.clamp(0.0, 1.0);
        Corner {
            west: west as usize,
            south: south as usize,
            along: share(local.x - west),
            up: share(local.y - south),
        }
    }
}

/// A cell by its south-western point, and a place in it, each share in [0, 1].
struct Corner {
    west: usize,
    south: usize,
    along: f64,
    up: f64,
}

fn digest_of(data: &GroundData) -> u64 {
    let mut hasher = StateHasher::new();
    hasher.f64(data.origin.x).f64(data.origin.y).f64(data.spacing);
    hasher.u64(u64::from(data.columns)).u64(u64::from(data.rows));
    hasher.u64(u64::from(data.water.is_some())).f64(data.water.unwrap_or(0.0));
    for height in &data.heights {
        hasher.bytes(&height.to_bits().to_le_bytes());
    }
    for cover in &data.covers {
        hasher.bytes(&[*cover as u8]);
    }
    hasher.finish().0
}

impl TryFrom<GroundData> for Ground {
    type Error = GroundError;

    fn try_from(data: GroundData) -> Result<Self, GroundError> {
        Self::new(data)
    }
}

impl From<Ground> for GroundData {
    fn from(ground: Ground) -> Self {
        ground.data
    }
}

impl StateHash for Ground {
    fn state_hash(&self, hasher: &mut StateHasher) {
        hasher.u64(self.digest);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hills(columns: u32, rows: u32) -> GroundData {
        let count = (columns * rows) as usize;
        let height = |index: usize| ((index * 37) % 11) as f32 - 4.0;
        GroundData {
            origin: Point2::new(-7.0, 3.0),
            spacing: 2.5,
            columns,
            rows,
            heights: (0..count).map(height).collect(),
            covers: (0..count).map(|index| Cover::ALL[index % Cover::ALL.len()]).collect(),
            water: Some(-1.0),
        }
    }

    #[test]
    fn the_surface_passes_through_its_points_and_along_the_diagonal() {
        let ground = Ground::new(hills(6, 5)).unwrap();
        for row in 0..5 {
            for column in 0..6 {
                let at = Point2::new(-7.0 + f64::from(column) * 2.5, 3.0 + f64::from(row) * 2.5);
                let index = (row * 6 + column) as usize;
                assert_eq!(ground.height(at), f64::from(ground.data().heights[index]), "{at}");
                assert_eq!(ground.cover(at), ground.data().covers[index]);
            }
        }
        // South-west to north-east: the middle of a cell is the mean of those two corners.
        let middle = ground.height(Point2::new(-7.0 + 1.25, 3.0 + 1.25));
        let corners = [0, 7].map(|index: usize| f64::from(ground.data().heights[index]));
        assert!((middle - (corners[0] + corners[1]) * 0.5).abs() < 1e-12);
    }

    #[test]
    fn normals_are_those_of_the_heights() {
        let ground = Ground::new(hills(6, 5)).unwrap();
        for step in 0..200 {
            let at = Point2::new(-6.9 + f64::from(step % 20) * 0.61, 3.07 + f64::from(step / 20) * 0.93);
            let (e, normal) = (1e-4, ground.normal(at));
            let rise = |dx: f64, dy: f64| ground.height(at + Vector2::new(dx, dy)) - ground.height(at);
            let tangents = [Vector3::new(e, 0.0, rise(e, 0.0)), Vector3::new(0.0, e, rise(0.0, e))];
            assert!(tangents.iter().all(|tangent| tangent.dot(&normal).abs() < 1e-9), "{at}");
            assert!((normal.norm() - 1.0).abs() < 1e-12 && normal.z > 0.0);
        }
    }

    #[test]
    fn what_is_no_ground_says_so() {
        let spoilt = |spoil: fn(&mut GroundData)| {
            let mut data = hills(4, 4);
            spoil(&mut data);
            Ground::new(data).unwrap_err()
        };
        assert!(matches!(spoilt(|data| data.rows = 1), GroundError::Size { .. }));
        assert!(matches!(spoilt(|data| data.columns = 5), GroundError::Count { .. }));
        assert!(matches!(spoilt(|data| data.covers.truncate(3)), GroundError::Count { .. }));
        assert!(matches!(spoilt(|data| data.spacing = f64::NAN), GroundError::Range { .. }));
        assert!(matches!(spoilt(|data| data.water = Some(1e9)), GroundError::Range { .. }));
        assert!(matches!(spoilt(|data| data.heights[3] = f32::NAN), GroundError::Height { index: 3, .. }));
    }

    #[test]
    fn saved_and_read_it_is_the_same_and_forged_it_is_refused() {
        let ground = Ground::new(hills(4, 3)).unwrap();
        let bytes = postcard::to_allocvec(&ground).unwrap();
        assert_eq!(postcard::from_bytes::<Ground>(&bytes).unwrap(), ground);
        let forged = postcard::to_allocvec(&GroundData { rows: 9, ..hills(4, 3) }).unwrap();
        assert!(postcard::from_bytes::<Ground>(&forged).is_err());
    }

    #[test]
    fn one_height_more_is_another_digest() {
        let (ground, mut other) = (Ground::new(hills(4, 4)).unwrap(), hills(4, 4));
        other.heights[7] += 0.01;
        assert_ne!(ground.digest(), Ground::new(other).unwrap().digest());
    }
}
