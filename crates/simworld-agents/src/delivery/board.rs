//! Where couriers are told of orders and offers: everywhere, or near them alone.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, Vector2};

use super::money::Cents;
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
    tenders: Vec<Tender>,
    /// Ascending.
    offered: Vec<OrderId>,
}

/// An order that takes bids: all that somebody reads who looks for work. Couriers read thousands a thought, one beside the other,
/// where the orders themselves lie far apart.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Tender {
    pub(super) id: OrderId,
    /// Where the order is picked up, m.
    pub(super) at: Point2,
    /// The most that is paid.
    pub(super) ceiling: Cents,
    /// Length of the route from restaurant to home, m.
    pub(super) route: f64,
    /// The step in which the auction closes.
    pub(super) closes: u64,
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

    fn cell(&self, point: Point2) -> &Cell {
        let (column, row) = self.key(point);
        &self.cells[(row * self.columns + column) as usize]
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

    /// The orders near a point that take bids; some of them may be out of reach. Cell by cell, and in each the oldest first.
    pub(super) fn tenders(&self, point: Point2) -> impl Iterator<Item = &Tender> {
        self.around(point).flat_map(|cell| &cell.tenders)
    }

    /// The offers near a point, as [`tenders`](Self::tenders).
    pub(super) fn offers(&self, point: Point2) -> impl Iterator<Item = OrderId> {
        self.around(point).flat_map(|cell| &cell.offered).copied()
    }

    /// Puts up an order that takes bids, which is news.
    pub(super) fn tender(&mut self, tender: Tender) {
        let cell = self.cell_at(tender.at);
        cell.news += 1;
        if let Err(place) = cell.tenders.binary_search_by_key(&tender.id, |other| other.id) {
            cell.tenders.insert(place, tender);
        }
    }

    /// Takes down an order that was picked up at a point.
    pub(super) fn close(&mut self, point: Point2, id: OrderId) {
        let tenders = &mut self.cell_at(point).tenders;
        if let Ok(place) = tenders.binary_search_by_key(&id, |tender| tender.id) {
            tenders.remove(place);
        }
    }

    /// Puts up an offer to share an order, which is news.
    pub(super) fn offer(&mut self, point: Point2, id: OrderId) {
        let cell = self.cell_at(point);
        cell.news += 1;
        insert(&mut cell.offered, id);
    }

    /// Takes an offer down.
    pub(super) fn withdraw(&mut self, point: Point2, id: OrderId) {
        remove(&mut self.cell_at(point).offered, id);
    }

    /// Whether an order hangs where bids are taken.
    pub(super) fn is_open(&self, point: Point2, id: OrderId) -> bool {
        self.cell(point).tenders.binary_search_by_key(&id, |tender| tender.id).is_ok()
    }

    /// Whether an offer hangs where it belongs.
    pub(super) fn is_offered(&self, point: Point2, id: OrderId) -> bool {
        self.cell(point).offered.binary_search(&id).is_ok()
    }

    /// How much hangs on it.
    pub(super) fn len(&self) -> usize {
        self.cells.iter().map(|cell| cell.tenders.len() + cell.offered.len()).sum()
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

    fn tender(index: u32, at: Point2) -> Tender {
        Tender { id: OrderId(index), at, ceiling: Cents(100), route: 1.0, closes: 10 }
    }

    #[test]
    fn what_is_within_reach_hangs_near_and_is_news_there() {
        let mut rng = Seed(4).stream("board").rng();
        let mut point = |reach: f64| Point2::new(rng.uniform(-reach, reach), rng.uniform(-reach, reach));
        let points: Vec<Point2> = (0..300).map(|_| point(900.0)).collect();
        // Some of them lie outside of what the board was made for.
        let mut board = Board::new(150.0, points[..200].iter().map(|point| *point * 0.7));
        for (index, at) in points.iter().enumerate() {
            board.tender(tender(index as u32, *at));
        }
        assert_eq!(board.len(), 300);
        for _ in 0..200 {
            let here = point(1200.0);
            let mut near: Vec<OrderId> = board.tenders(here).map(|tender| tender.id).collect();
            near.sort_unstable();
            assert_eq!(board.offers(here).count(), 0);
            assert_eq!(board.news(here), near.len() as u64);
            for (index, at) in points.iter().enumerate() {
                let found = near.binary_search(&OrderId(index as u32)).is_ok();
                assert!(found || !board.reaches((at - here).norm()), "order {index} is near and not told");
            }
        }
        assert!(board.tenders(points[0]).count() < 60, "most is far from anywhere");
        board.close(points[0], OrderId(0));
        assert!(!board.is_open(points[0], OrderId(0)) && board.len() == 299);
    }
}
