//! What each courier did, second by second: a bar a courier, coloured by what it was about, and a sign an event.

use std::fmt::Write as _;

use simworld_core::clock::Tick;
use simworld_core::event::{Event, EventKind};
use simworld_core::value::Value;
use svg::Document;
use svg::node::element::{Group, Line, Path, Rectangle, Text, Title};

use super::palette;
use super::words::{clock, dollars, shortened};
use super::{Shown, maps};
use crate::delivery::Doing;

/// Room for names, for the bars, and for what was earned.
const WIDTHS: (f64, f64, f64) = (168.0, 900.0, 82.0);
const TOP: f64 = 26.0;
const ROW: f64 = 30.0;
/// Height of a bar, and where it begins in its row.
const BAR: (f64, f64) = (9.0, 13.0);
/// Letters of a name.
const LETTERS: usize = 14;

/// The kinds of signs: name, how it is drawn around (0, 0), and what it means.
const SIGNS: [(&str, &str, &str); 8] = [
    ("bid", "M0-4V2", "bid"),
    ("won", "M0-4.5L4 2.5H-4Z", "order won"),
    ("picked", "M-3.5-3.5H3.5V3.5H-3.5Z", "picked up"),
    ("delivered", "M-4.5 0A4.5 4.5 0 1 0 4.5 0A4.5 4.5 0 1 0-4.5 0Z", "delivered in time"),
    ("late", "M-3.8 0A3.8 3.8 0 1 0 3.8 0A3.8 3.8 0 1 0-3.8 0Z", "delivered late"),
    ("shared", "M0-5L5 0L0 5L-5 0Z", "shared, met or handed over"),
    ("bought", "M-1.5-5H1.5V-1.5H5V1.5H1.5V5H-1.5V1.5H-5V-1.5H-1.5Z", "bought a scooter or a drink"),
    ("tired", "M-4-4L4 4M4-4L-4 4", "exhausted, or refused by the rules"),
];

/// The figure.
pub(super) fn figure(shown: &Shown) -> String {
    let rows = maps::in_view(shown);
    let end = shown.track.samples.last().map_or(Tick(1), |last| Tick(last.0.0.max(1)));
    let sheet = Sheet { shown, end, rows };
    let mut text = String::from("<p class=key>");
    // Writing to a string cannot fail.
    for doing in Doing::ALL {
        let _ = write!(
            text,
            "<span><i class=bar style=\"background:{}\"></i>{}</span> ",
            palette::doing(doing),
            doing.words()
        );
    }
    for (name, shape, words) in SIGNS {
        let _ = write!(
            text,
            "<span><svg width=14 height=14 viewBox=\"-7 -7 14 14\" aria-hidden=true><path class=\"sign {name}\" \
             d=\"{shape}\"/></svg>{words}</span> "
        );
    }
    let _ = write!(text, "</p><div class=wide tabindex=0>{}</div>", sheet.drawing(&shown.events));
    if rows < shown.track.couriers.len() {
        let _ =
            write!(text, "<p class=note>The first {rows} of {} couriers.</p>", shown.track.couriers.len());
    }
    text
}

struct Sheet<'a> {
    shown: &'a Shown,
    end: Tick,
    rows: usize,
}

impl Sheet<'_> {
    fn x(&self, tick: Tick) -> f64 {
        let share = tick.0.min(self.end.0) as f64 / self.end.0 as f64;
        ((WIDTHS.0 + WIDTHS.1 * share) * 10.0).round() / 10.0
    }

    fn drawing(&self, events: &[Event]) -> Document {
        let width = WIDTHS.0 + WIDTHS.1 + WIDTHS.2;
        let height = TOP + ROW * self.rows as f64 + 6.0;
        let mut drawing = Document::new()
            .set("viewBox", (0.0, 0.0, width, height))
            .set("width", width)
            .set("height", height)
            .set("class", "timeline")
            .set("role", "img")
            .set("aria-label", "Timelines of the couriers")
            .set("data-from", WIDTHS.0)
            .set("data-to", WIDTHS.0 + WIDTHS.1);
        drawing = drawing.add(self.scale(height));
        for index in 0..self.rows {
            drawing = drawing.add(self.row(index));
        }
        let mut signs: Vec<Group> = (0..self.rows)
            .map(|index| Group::new().set("class", "signs").set("data-courier", index))
            .collect();
        for event in events {
            if let Some((index, sign)) = self.sign(event).filter(|(index, _)| *index < self.rows) {
                let group = std::mem::take(&mut signs[index]);
                signs[index] = group.add(sign);
            }
        }
        drawing = signs.into_iter().fold(drawing, Document::add);
        drawing.add(
            Line::new()
                .set("class", "now")
                .set("y1", TOP - 6.0)
                .set("y2", height)
                .set("visibility", "hidden"),
        )
    }

    /// Lines at round times.
    fn scale(&self, height: f64) -> Group {
        let seconds = self.shown.track.seconds(self.end);
        let steps = [10.0, 30.0, 60.0, 120.0, 300.0, 600.0, 1800.0, 3600.0, 7200.0, 36000.0];
        let step = steps.into_iter().find(|step| seconds / step <= 11.0).unwrap_or(86_400.0);
        let mut group = Group::new().set("class", "scale");
        for mark in 0..=(seconds / step).floor() as u64 {
            let at = mark as f64 * step;
            let x = self.x(Tick((at / self.shown.track.dt).round() as u64));
            let line = Line::new().set("x1", x).set("x2", x).set("y1", TOP - 6.0).set("y2", height);
            let label = Text::new(clock(at)).set("x", x).set("y", TOP - 11.0).set("text-anchor", "middle");
            group = group.add(line).add(label);
        }
        let right = WIDTHS.0 + WIDTHS.1 + WIDTHS.2 - 4.0;
        group.add(Text::new("profit").set("x", right).set("y", TOP - 11.0).set("text-anchor", "end"))
    }

    /// A courier's name, what it was about, and its profit.
    fn row(&self, index: usize) -> Group {
        let top = TOP + ROW * index as f64;
        let courier = &self.shown.track.couriers[index];
        let policy = self.shown.players.get(index).map_or("", |player| player.policy.as_str());
        let name = Text::new(shortened(&courier.name, LETTERS))
            .set("class", "name")
            .set("x", 2)
            .set("y", top + BAR.1 + 1.0)
            .add(Title::new(courier.name.as_str()));
        let policy = Text::new(policy.replace('_', " "))
            .set("class", "policy")
            .set("x", 2)
            .set("y", top + BAR.1 + 12.0);
        let mut group = Group::new().set("class", "row").set("data-courier", index).add(name).add(policy);
        for (from, to, doing) in self.spans(index) {
            let (left, right) = (self.x(from), self.x(to));
            let words = format!(
                "{}, {} to {}",
                doing.words(),
                clock(self.shown.track.seconds(from)),
                clock(self.shown.track.seconds(to))
            );
            let bar = Rectangle::new()
                .set("x", left)
                .set("y", top + BAR.1)
                .set("width", ((right - left) * 10.0).round() / 10.0)
                .set("height", BAR.0)
                .set("fill", palette::doing(doing))
                .add(Title::new(words));
            group = group.add(if doing == Doing::Idle { bar.set("fill-opacity", 0.4) } else { bar });
        }
        let Some(row) = self.shown.report.couriers.get(index) else { return group };
        let right = WIDTHS.0 + WIDTHS.1 + WIDTHS.2 - 4.0;
        let profit = Text::new(dollars(row.profit.dollars()))
            .set("x", right)
            .set("y", top + BAR.1 + 8.0)
            .set("text-anchor", "end");
        group.add(profit)
    }

    /// Runs of samples in which a courier was about the same.
    fn spans(&self, index: usize) -> Vec<(Tick, Tick, Doing)> {
        let mut spans: Vec<(Tick, Tick, Doing)> = Vec::new();
        for (tick, spots) in &self.shown.track.samples {
            let doing = spots[index].doing;
            match spans.last_mut() {
                Some(last) => {
                    last.1 = *tick;
                    if last.2 != doing {
                        spans.push((*tick, *tick, doing));
                    }
                }
                None => spans.push((*tick, *tick, doing)),
            }
        }
        spans
    }

    /// Whose row, and the sign.
    fn sign(&self, event: &Event) -> Option<(usize, Path)> {
        let (who, kind, height, words) = match &event.kind {
            EventKind::Task { name, who, data } => {
                let number = |key: &str| data.get(key).and_then(Value::as_f64).unwrap_or_default();
                let order = data.get("order").map(|order| format!("order {order}")).unwrap_or_default();
                let (kind, height, words) = told(name, &order, number)?;
                ((*who)?, kind, height, words)
            }
            EventKind::IntentRefused { who, reason } => {
                (*who, "tired", Height::Above, format!("refused: {}", shortened(reason, 160)))
            }
            _ => return None,
        };
        let index = self.shown.track.courier(who)?;
        let shape = SIGNS.iter().find(|sign| sign.0 == kind)?.1;
        let y = TOP + ROW * index as f64 + if height == Height::Above { 7.0 } else { BAR.1 + BAR.0 * 0.5 };
        let when = clock(self.shown.track.seconds(event.tick));
        let path = Path::new()
            .set("class", format!("sign {kind}"))
            .set("transform", format!("translate({} {y})", self.x(event.tick)))
            .set("d", shape)
            .add(Title::new(format!("{when} {words}")));
        Some((index, path))
    }
}

/// Where a sign stands.
#[derive(Clone, Copy, PartialEq)]
enum Height {
    /// Above the bar.
    Above,
    /// On the bar.
    On,
}

/// The sign of a task's event: its kind, where it stands, and what it says.
fn told(name: &str, order: &str, number: impl Fn(&str) -> f64) -> Option<(&'static str, Height, String)> {
    use Height::{Above, On};
    let price = dollars(number("price"));
    Some(match name {
        "bid_placed" => ("bid", Above, format!("bids {price} for {order}")),
        "order_awarded" => ("won", Above, format!("wins {order} at {}", dollars(number("pay")))),
        "order_picked_up" => ("picked", On, format!("picks {order} up")),
        "order_delivered" if number("late") > 0.0 => {
            let (late, paid) = (number("late"), dollars(number("paid")));
            ("late", On, format!("delivers {order}, {late:.0} s late, and {paid} is paid"))
        }
        "order_delivered" => {
            ("delivered", On, format!("delivers {order} in time, and {} is paid", dollars(number("paid"))))
        }
        "order_shared" => ("shared", Above, format!("offers to share {order}")),
        "share_accepted" => ("shared", Above, format!("agrees to take {order} over")),
        "handed_over" => ("shared", On, format!("hands {order} over")),
        "scooter_bought" => ("bought", Above, format!("buys a scooter for {price}")),
        "drink_bought" => ("bought", Above, format!("buys a drink for {price}")),
        "courier_exhausted" => ("tired", On, "is exhausted".to_owned()),
        _ => return None,
    })
}
