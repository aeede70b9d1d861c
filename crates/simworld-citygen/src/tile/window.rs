//! Some tiles together, as a source of streets.

use simworld_core::net::StreetPlan;
use simworld_core::seed::Seed;

use super::{TileId, TileSource};
use crate::{CityError, RoadSource};

/// More tiles than this are no window.
const MOST_TILES: u64 = 10_000;

/// A rectangle of tiles: their streets as one plan.
///
/// A city built on it stands on the streets of the tiles, and its lots and buildings inside are divided and raised by the
/// same rules; places and names are drawn for the city as a whole.
///
/// ```
/// use simworld_citygen::tile::{TileConfig, TileId, TileSource};
/// use simworld_citygen::{City, CityConfig, Style};
/// use simworld_core::seed::Seed;
/// let source = TileSource::new(TileConfig::of_style(Style::Grid), Seed(7))?;
/// let window = source.window(TileId::new(0, 0), TileId::new(0, 0))?;
/// let city = City::from_source(&window, &CityConfig::default(), Seed(7))?;
/// assert_eq!(city.report().streets.components, 1);
/// # Ok::<(), simworld_citygen::CityError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Window<'a> {
    source: &'a TileSource,
    low: TileId,
    high: TileId,
}

impl<'a> Window<'a> {
    pub(super) fn new(source: &'a TileSource, low: TileId, high: TileId) -> Result<Self, CityError> {
        let side = |low: i32, high: i32| u64::try_from(i64::from(high) - i64::from(low) + 1).unwrap_or(0);
        let count = side(low.x, high.x).saturating_mul(side(low.y, high.y));
        if count == 0 || count > MOST_TILES {
            return Err(CityError::Config {
                field: "window",
                value: count as f64,
                allowed: "1 to 10 000 tiles, the first corner south-west of the second",
            });
        }
        Ok(Self { source, low: low.checked()?, high: high.checked()? })
    }

    /// Its tiles, row by row from the south-west.
    pub fn tiles(&self) -> impl Iterator<Item = TileId> + use<> {
        let (low, high) = (self.low, self.high);
        (low.y..=high.y).flat_map(move |y| (low.x..=high.x).map(move |x| TileId { x, y }))
    }

    /// The streets of its tiles and the main streets round them, joined.
    pub fn plan(&self) -> StreetPlan {
        let ids: Vec<TileId> = self.tiles().collect();
        self.source.plan_of(&ids)
    }
}

/// The streets are those of the tiles' own seed, whichever seed the city has.
impl RoadSource for Window<'_> {
    fn streets(&self, _: Seed) -> Result<StreetPlan, CityError> {
        Ok(self.plan())
    }
}
