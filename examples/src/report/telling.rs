//! The story of one order as a reader sees it: who bid what, who won, the way taken, the times, and the money.

use std::fmt::Write as _;

use simworld_core::clock::Tick;
use simworld_core::geometry::Point2;
use svg::Document;
use svg::node::element::{Circle, Group, Line, Path, Text, Title, Use};

use super::Shown;
use super::city::CityMap;
use super::palette;
use super::story::{Beat, BeatKind, End, Holder, Story};
use super::words::{clock, count, dollars, escaped, shortened};

/// Stories on a page; the richest come first.
const MOST: usize = 120;
/// Rows of a table of bids.
const MOST_BIDS: usize = 40;

/// The section: the richest story, and the others to choose from.
pub(super) fn section(shown: &Shown, map: &CityMap, stories: &[Story]) -> String {
    let mut told: Vec<&Story> = stories.iter().collect();
    told.sort_by_key(|story| (std::cmp::Reverse(story.richness()), story.order));
    let Some(richest) = told.first().map(|story| story.order) else {
        return "<p>Nobody ordered anything.</p>".to_owned();
    };
    told.truncate(MOST);
    told.sort_by_key(|story| story.order);
    let mut text = String::from("<p class=controls data-script hidden><label>Order <select id=order>");
    // Writing to a string cannot fail.
    for story in &told {
        let chosen = if story.order == richest { " selected" } else { "" };
        let _ = write!(
            text,
            "<option value={}{chosen}>{}: {}</option>",
            story.order,
            story.order,
            escaped(&outcome(shown, story))
        );
    }
    text.push_str("</select></label></p>");
    for story in &told {
        let hidden = if story.order == richest { "" } else { " hidden" };
        let _ = write!(
            text,
            "<article class=story data-order={}{hidden}>{}</article>",
            story.order,
            Telling { shown, map, story }.article()
        );
    }
    if told.len() < stories.len() {
        let _ = write!(text, "<p class=note>The {MOST} richest of {} orders.</p>", stories.len());
    }
    text
}

/// How an order ended, in a few words.
fn outcome(shown: &Shown, story: &Story) -> String {
    let name = |courier: usize| shown.name(courier);
    match &story.end {
        End::Open => "still open at the end".to_owned(),
        End::Expired(_) => "nobody took it".to_owned(),
        End::Won(award) => format!("won by {}, not delivered by the end", name(award.courier)),
        End::Delivered(award, delivery) => {
            let late =
                if delivery.late > 0.0 { format!(", {:.0} s late", delivery.late) } else { String::new() };
            let shared = if award.courier == delivery.courier {
                String::new()
            } else {
                format!(", won by {}", name(award.courier))
            };
            format!("delivered by {}{late}{shared}", name(delivery.courier))
        }
    }
}

struct Telling<'a> {
    shown: &'a Shown,
    map: &'a CityMap,
    story: &'a Story,
}

impl Telling<'_> {
    fn article(&self) -> String {
        let story = self.story;
        let site = |id| self.map.site(id).map_or("?", |site| site.name.as_str());
        let (from, to) = (story.restaurant.map_or("?", site), story.home.map_or("?", site));
        format!(
            "<h3>Order {}: {} to {}</h3><p>{}</p><div class=columns><div><h4>What happened</h4>{}{}</div>\
             <div>{}</div></div><div class=columns><div><h4>Who bid what</h4>{}</div><div><h4>Its entries in the \
             ledger</h4>{}</div></div>",
            story.order,
            escaped(from),
            escaped(to),
            escaped(&self.summary()),
            self.beats(),
            self.times(),
            self.way(),
            self.bids(),
            self.entries(),
        )
    }

    fn time(&self, tick: Tick) -> String {
        clock(self.shown.track.seconds(tick))
    }

    fn summary(&self) -> String {
        let story = self.story;
        format!(
            "A way of {:.0} m, for at most {}; {}; {}.",
            story.route,
            dollars(story.ceiling),
            count(story.bids.len(), "bid"),
            outcome(self.shown, story)
        )
    }

    fn beats(&self) -> String {
        let mut text = String::from("<ol class=beats>");
        for beat in &self.story.beats {
            let _ = write!(
                text,
                "<li><time>{}</time> {}</li>",
                self.time(beat.tick),
                escaped(&self.sentence(beat))
            );
        }
        text + "</ol>"
    }

    fn sentence(&self, beat: &Beat) -> String {
        let story = self.story;
        let who = beat.courier.map_or_else(|| "somebody".to_owned(), |courier| self.shown.name(courier));
        match &beat.kind {
            BeatKind::Posted => format!("posted, for at most {}", dollars(story.ceiling)),
            BeatKind::Expired => "the auction closes without a winner".to_owned(),
            BeatKind::Awarded => {
                let pay = story.award().map_or(0.0, |award| award.pay);
                let due = story.award().and_then(|award| award.due);
                let due = due.map_or_else(String::new, |due| format!(", due by {}", clock(due)));
                format!("{who} wins it at {}{due}", dollars(pay))
            }
            BeatKind::PickedUp => format!("{who} picks it up"),
            BeatKind::Shared(bounty) if *bounty > 0.0 => {
                format!("{who} offers to share it, with a bounty of {}", dollars(*bounty))
            }
            BeatKind::Shared(_) => format!("{who} offers to share it"),
            BeatKind::Accepted => format!("{who} agrees to take it over"),
            BeatKind::Declined => format!("{who} no longer wants to take it over"),
            BeatKind::Cancelled(reason) => format!("the offer to share it is gone: {reason}"),
            BeatKind::HandedOver(to) => {
                let to = to.map_or_else(|| "somebody".to_owned(), |to| self.shown.name(to));
                format!("{who} hands it over to {to}")
            }
            BeatKind::Delivered => {
                let Some(delivery) = story.delivery() else { return format!("{who} delivers it") };
                let time = if delivery.late > 0.0 {
                    format!("{:.1} s late", delivery.late)
                } else {
                    "in time".to_owned()
                };
                format!("{who} delivers it {time}, and {} is paid", dollars(delivery.paid))
            }
        }
    }

    /// How long each part took.
    fn times(&self) -> String {
        let Some(award) = self.story.award() else { return String::new() };
        let between =
            |from: Tick, to: Tick| clock(self.shown.track.seconds(Tick(to.0.saturating_sub(from.0))));
        let mut text = format!("<p class=note>Auction {}", between(self.story.posted, award.tick));
        if let Some(picked) = self.story.picked_up() {
            let _ = write!(text, ", to the restaurant {}", between(award.tick, picked));
            if let Some(delivery) = self.story.delivery() {
                let _ = write!(text, ", to the door {}", between(picked, delivery.tick));
            }
        }
        text + ".</p>"
    }

    /// The parts of the way: who went it, from when to when, and which part it is.
    fn legs(&self) -> Vec<(usize, Tick, Tick, &'static str)> {
        let story = self.story;
        let Some(award) = story.award() else { return Vec::new() };
        let last = self.shown.track.samples.last().map_or(award.tick, |last| last.0);
        let end = story.delivery().map_or(last, |delivery| delivery.tick);
        let Some(picked) = story.picked_up() else {
            return vec![(award.courier, award.tick, end, "approach")];
        };
        let mut legs = vec![(award.courier, award.tick, picked, "approach")];
        match story.handed_over() {
            Some((tick, second)) => {
                legs.push((award.courier, picked, tick, "carried"));
                legs.push((second, tick, end, "carried"));
            }
            None => legs.push((award.courier, picked, end, "carried")),
        }
        legs
    }

    /// The way taken, on a map of its own.
    fn way(&self) -> Document {
        let site = |id| self.map.site(id).map(|site| site.access);
        let (from, to) = (self.story.restaurant.and_then(site), self.story.home.and_then(site));
        let legs: Vec<(usize, &str, Vec<Point2>)> = self
            .legs()
            .into_iter()
            .map(|(courier, from, to, part)| (courier, part, self.shown.track.way(courier, from, to)))
            .collect();
        let seen: Vec<Point2> =
            legs.iter().flat_map(|leg| leg.2.iter().copied()).chain(from).chain(to).collect();
        let (view, width) = self.map.frame.detail(&seen, 30.0);
        let mut trails = Group::new().set("class", "trails");
        for (courier, part, points) in &legs {
            let words = match *part {
                "approach" => format!("{} goes to the restaurant", self.shown.name(*courier)),
                _ => format!("{} carries it", self.shown.name(*courier)),
            };
            let path = Path::new()
                .set("class", *part)
                .set("d", self.map.frame.line(points))
                .set("stroke", palette::courier(*courier).0)
                .add(Title::new(words));
            trails = trails.add(path);
        }
        let mut drawing = Document::new()
            .set("viewBox", view)
            .set("class", "map")
            .set("role", "img")
            .set("aria-label", format!("The way of order {}", self.story.order))
            .add(Use::new().set("href", "#city"))
            .add(trails);
        for (point, letter, words) in [(from, "R", "restaurant"), (to, "H", "home")] {
            let Some(point) = point else { continue };
            let ((x, y), size) = (self.map.frame.cell(point), width as f64 / 34.0);
            let disc = Circle::new().set("cx", x).set("cy", y).set("r", size.round());
            let label =
                Text::new(letter).set("x", x).set("y", y + (size * 0.42) as i64).set("font-size", size * 1.2);
            drawing =
                drawing.add(Group::new().set("class", "place").add(disc).add(label).add(Title::new(words)));
        }
        drawing
    }

    /// A line of prices with a dot a bid, and the bids as a table.
    fn bids(&self) -> String {
        let story = self.story;
        if story.bids.is_empty() {
            return "<p>Nobody bid.</p>".to_owned();
        }
        let mut text = self.prices().to_string();
        text.push_str("<div class=wide><table><thead><tr><th>courier<th>time<th>bid<th>of the ceiling<th></tr></thead><tbody>");
        let mut bids: Vec<&(Tick, usize, f64)> = story.bids.iter().collect();
        bids.sort_by(|a, b| a.2.total_cmp(&b.2).then(a.0.cmp(&b.0)));
        for (tick, courier, price) in bids.iter().take(MOST_BIDS) {
            let _ = write!(
                text,
                "<tr><td>{}<td>{}<td>{}<td>{:.0} %<td>{}</tr>",
                escaped(&shortened(&self.shown.name(*courier), 24)),
                self.time(*tick),
                dollars(*price),
                price / story.ceiling.max(f64::MIN_POSITIVE) * 100.0,
                self.verdict(*tick, *courier)
            );
        }
        text.push_str("</tbody></table></div>");
        if bids.len() > MOST_BIDS {
            let _ = write!(text, "<p class=note>The lowest {MOST_BIDS} of {} bids.</p>", bids.len());
        }
        text
    }

    /// Whether a bid won, or another of the same courier took its place.
    fn verdict(&self, tick: Tick, courier: usize) -> &'static str {
        let replaced = self.story.bids.iter().any(|(later, who, _)| *who == courier && *later > tick);
        match self.story.award() {
            _ if replaced => "replaced",
            Some(award) if award.courier == courier => "wins",
            _ => "",
        }
    }

    fn prices(&self) -> Document {
        let x = |price: f64| {
            let share = price / self.story.ceiling.max(f64::MIN_POSITIVE);
            (10.0 + 380.0 * share.clamp(0.0, 1.0)).round()
        };
        let mut drawing = Document::new()
            .set("viewBox", "0 0 400 46")
            .set("class", "prices")
            .set("role", "img")
            .set("aria-label", "Bids between nothing and the ceiling")
            .add(Line::new().set("x1", 10).set("x2", 390).set("y1", 16).set("y2", 16));
        for (tick, courier, price) in &self.story.bids {
            let won = self.verdict(*tick, *courier) == "wins";
            let dot = Circle::new()
                .set("cx", x(*price))
                .set("cy", 16)
                .set("r", if won { 7 } else { 4 })
                .set("class", if won { "won" } else { "bid" })
                .add(Title::new(format!("{} bids {}", self.shown.name(*courier), dollars(*price))));
            drawing = drawing.add(dot);
        }
        drawing
            .add(Text::new("$0").set("x", 4).set("y", 42))
            .add(Text::new(dollars(self.story.ceiling)).set("x", 396).set("y", 42).set("text-anchor", "end"))
    }

    fn entries(&self) -> String {
        if self.story.entries.is_empty() {
            return "<p>No money moved.</p>".to_owned();
        }
        let name = |holder: &Holder| match holder {
            Holder::Courier(courier) => self.shown.name(*courier),
            Holder::Other(words) => words.clone(),
        };
        let mut text = String::from(
            "<div class=wide><table class=ledger><thead><tr><th>from<th>to<th>time<th>amount</tr></thead><tbody>",
        );
        for entry in &self.story.entries {
            let _ = write!(
                text,
                "<tr><td>{}<td>{}<td>{}<td>{}</tr>",
                escaped(&shortened(&name(&entry.from), 24)),
                escaped(&shortened(&name(&entry.to), 24)),
                self.time(entry.tick),
                dollars(entry.amount)
            );
        }
        text + "</tbody></table></div>"
    }
}
