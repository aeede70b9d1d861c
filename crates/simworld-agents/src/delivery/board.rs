//! Where couriers are told of orders and offers: everywhere, or near them alone.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, Vector2};

use super::order::OrderId;

/// From this reach on everybody is told of everything, m.
pub(super) const EVERYWHERE: f64 = 1e6;
/// More cells than this in a row or a column are not made; they grow instead.
const MOST: f64 = 512.0;

/// Orders that take bids by their restaurants, and offers by their meet-points, in cells as wide as couriers are told.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Board {
    reach: f64,
    origin: Point2,
    cell: f64,
    columns: u32,
    rows: u32,
    cells: Vec<Cell>,
}

/// What is told in a cell.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Cell {
    /// Counts what was put up here.
    news: u64,
    /// Ascending.
    open: Vec<OrderId>,
    offered: Vec<OrderId>,
}

/// What hangs on the board.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Notice {
    /// An order that takes bids.
    Open,
    /// An order that is offered for sharing.
    Offer,
}

impl Cell {
    fn list(&self, notice: Notice) -> &[OrderId] {
        match notice {
            Notice::Open => &self.open,
            Notice::Offer => &self.offered,
        }
    }

    fn list_mut(&mut self, notice: Notice) -> &mut Vec<OrderId> {
        match notice {
            Notice::Open => &mut self.open,
            Notice::Offer => &mut self.offered,
        }
    }
}

impl Board {
    /// An empty board for couriers who are told within `reach`, m, of what happens at these points.
    pub(super) fn new(reach: f64, points: impl Iterator<Item = Point2>) -> Self {
        let bounds = points.fold(None, |bounds: Option<(Point2, Point2)>, point| match bounds {
            Some((low, high)) => Some((low.inf(&point), high.sup(&point))),
            None => Some((point, point)),
        });
        let (low, high) = bounds.unwrap_or((Point2::origin(), Point2::origin()));
        let size: Vector2 = high - low;
        let cell = reach.max(size.max() / MOST);
        let count = |length: f64| if reach >= EVERYWHERE { 1 } else { (length / cell) as u32 + 1 };
        let (columns, rows) = (count(size.x), count(size.y));
        let cells = vec![Cell::default(); columns as usize * rows as usize];
        Self { reach, origin: low, cell, columns, rows, cells }
    }

    /// Whether a courier is told of what is at this distance, m.
    pub(super) fn reaches(&self, distance: f64) -> bool {
        self.reach >= EVERYWHERE || distance <= self.reach
    }

    /// Column and row of a point; what is outside belongs to the rim, so that neighbours stay neighbours.
    fn key(&self, point: Point2) -> (u32, u32) {
        let offset = (point - self.origin) / self.cell;
        let clamp = |x: f64, count: u32| (x.max(0.0) as u32).min(count - 1);
        (clamp(offset.x, self.columns), clamp(offset.y, self.rows))
    }

    fn cell_at(&mut self, point: Point2) -> &mut Cell {
        let (column, row) = self.key(point);
        &mut self.cells[(row * self.columns + column) as usize]
    }

    /// The cells in which there may be something within reach.
    fn around(&self, point: Point2) -> impl Iterator<Item = &Cell> {
        let (column, row) = self.key(point);
        let rows = row.saturating_sub(1)..=(row + 1).min(self.rows - 1);
        let (left, right) = (column.saturating_sub(1), (column + 1).min(self.columns - 1));
        rows.flat_map(move |row| {
            &self.cells[(row * self.columns + left) as usize..=(row * self.columns + right) as usize]
        })
    }

    /// A count that grows whenever something is put up near a point.
    pub(super) fn news(&self, point: Point2) -> u64 {
        self.around(point).map(|cell| cell.news).sum()
    }

    /// What hangs near a point; some of it may be out of reach. Cell by cell, and in each the oldest order first.
    pub(super) fn near(&self, point: Point2, notice: Notice) -> impl Iterator<Item = OrderId> {
        self.around(point).flat_map(move |cell| cell.list(notice)).copied()
    }

    /// Puts something up, which is news.
    pub(super) fn put_up(&mut self, point: Point2, notice: Notice, id: OrderId) {
        let cell = self.cell_at(point);
        cell.news += 1;
        insert(cell.list_mut(notice), id);
    }

    /// Takes something down.
    pub(super) fn take_down(&mut self, point: Point2, notice: Notice, id: OrderId) {
        remove(self.cell_at(point).list_mut(notice), id);
    }

    /// Whether something hangs where it belongs.
    pub(super) fn shows(&self, point: Point2, notice: Notice, id: OrderId) -> bool {
        let (column, row) = self.key(point);
        let cell = &self.cells[(row * self.columns + column) as usize];
        cell.list(notice).binary_search(&id).is_ok()
    }

    /// How much hangs on it.
    pub(super) fn len(&self) -> usize {
        self.cells.iter().map(|cell| cell.open.len() + cell.offered.len()).sum()
    }
}

/// Adds to an ascending list what is not in it.
pub(super) fn insert(list: &mut Vec<OrderId>, id: OrderId) {
    if let Err(place) = list.binary_search(&id) {
        list.insert(place, id);
    }
}

/// Takes out of an ascending list.
pub(super) fn remove(list: &mut Vec<OrderId>, id: OrderId) {
    if let Ok(place) = list.binary_search(&id) {
        list.remove(place);
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::seed::Seed;

    use super::*;

    #[test]
    fn what_is_within_reach_hangs_near_and_is_news_there() {
        let mut rng = Seed(4).stream("board").rng();
        let mut point = |reach: f64| Point2::new(rng.uniform(-reach, reach), rng.uniform(-reach, reach));
        let points: Vec<Point2> = (0..300).map(|_| point(900.0)).collect();
        // Some of them lie outside of what the board was made for.
        let mut board = Board::new(150.0, points[..200].iter().map(|point| *point * 0.7));
        for (index, at) in points.iter().enumerate() {
            board.put_up(*at, Notice::Open, OrderId(index as u32));
        }
        assert_eq!(board.len(), 300);
        for _ in 0..200 {
            let here = point(1200.0);
            let mut near: Vec<OrderId> = board.near(here, Notice::Open).collect();
            near.sort_unstable();
            assert_eq!(board.near(here, Notice::Offer).count(), 0);
            assert_eq!(board.news(here), near.len() as u64);
            for (index, at) in points.iter().enumerate() {
                let found = near.binary_search(&OrderId(index as u32)).is_ok();
                assert!(found || !board.reaches((at - here).norm()), "order {index} is near and not told");
            }
        }
        assert!(board.near(points[0], Notice::Open).count() < 60, "most is far from anywhere");
        board.take_down(points[0], Notice::Open, OrderId(0));
        assert!(!board.shows(points[0], Notice::Open, OrderId(0)) && board.len() == 299);
    }
}
