//! The recorded run as a film: everybody's places, what they were about, the orders and some of the traffic, packed into the
//! page for a slider.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;
use simworld_core::clock::Tick;
use simworld_core::event::{Event, EventKind};
use simworld_core::value::Value;

use super::Shown;
use super::city::CityMap;
use super::palette;
use super::story::{End, Story};
use super::words::{dollars, escaped};
use crate::delivery::{Doing, Mount, Moves, Track, metres};

/// Places of couriers in a page, all samples together: a few bytes each.
const MOST_PLACES: usize = 200_000;
/// Couriers that are drawn.
const MOST_COURIERS: usize = 300;
/// Orders that are drawn, the first ones.
const MOST_ORDERS: usize = 1500;
/// Lines of what happened, the first ones.
const MOST_LINES: usize = 4000;

/// Whether traffic is drawn, to choose.
const TRAFFIC: &str = "<label><input type=checkbox id=show-traffic checked> Traffic</label>";
/// How traffic is drawn.
const PASSERS: &str =
    " <span><i class=\"dot vehicle\"></i>vehicle</span> <span><i class=\"dot walker\"></i>pedestrian</span>";

/// What the script of the page reads. Ways are, for each and each sample, the change of x and of y since the last sample, in
/// units of the map, as zigzag varints in Base64.
#[derive(Serialize)]
struct Film<'a> {
    /// Seconds between two samples.
    every: f64,
    /// Number of samples.
    samples: usize,
    /// What couriers are called.
    names: Vec<&'a str>,
    /// The ways of the couriers.
    ways: String,
    /// For each courier: from which sample on, and the number of the state; again and again.
    doing: Vec<Vec<usize>>,
    /// For each order: number, when it was posted, won, picked up and gone (-1: never), x and y of restaurant and of home.
    orders: Vec<[f64; 9]>,
    /// What happened: when, and in words.
    lines: Vec<(f64, String)>,
    passers: Passing,
}

/// Some of the traffic.
#[derive(Serialize)]
struct Passing {
    /// How many of them are vehicles, the first ones; the others are on foot.
    vehicles: usize,
    /// Their ways; who is gone stays where it was.
    ways: String,
    /// For each: from which sample on, and whether it is there; again and again.
    present: Vec<Vec<usize>>,
}

/// The section: controls, the stage, the key of colours, and the data.
pub(super) fn section(shown: &Shown, map: &CityMap, stories: &[Story]) -> String {
    let track = &shown.track;
    let couriers = track.couriers.len().min(MOST_COURIERS);
    let stride = (couriers * track.samples.len()).div_ceil(MOST_PLACES).max(1);
    let rows: Vec<_> = track.samples.iter().step_by(stride).collect();
    // Ticks are not exact in seconds; a reader wants 1 and not 0.9999999999999999.
    let every = (track.interval as f64 * track.dt * stride as f64 * 1000.0).round() / 1000.0;
    let film = Film {
        every,
        samples: rows.len(),
        names: track.couriers.iter().take(couriers).map(|courier| courier.name.as_str()).collect(),
        ways: ways(
            (0..couriers)
                .map(|courier| rows.iter().map(move |(_, spots)| map.frame.cell(spots[courier].point()))),
        ),
        doing: (0..couriers).map(|courier| states(&rows, courier)).collect(),
        orders: stories.iter().take(MOST_ORDERS).filter_map(|story| order(shown, map, story)).collect(),
        lines: shown.events.iter().filter_map(|event| line(shown, event)).take(MOST_LINES).collect(),
        passers: passing(track, stride, map),
    };
    // Inside a page no name may end the script that holds it.
    let data = serde_json::to_string(&film)
        .expect("a film is plain data without maps")
        .replace('<', "\\u003c")
        .replace('&', "\\u0026");
    let end = (every * rows.len().saturating_sub(1) as f64 * 1000.0).round() / 1000.0;
    let key: String = Doing::ALL
        .map(|doing| {
            format!(
                "<span><i class=dot style=\"background:{}\"></i>{}</span> ",
                palette::doing(doing),
                doing.words()
            )
        })
        .concat();
    let colors = Doing::ALL.map(palette::doing).join(" ");
    format!(
        "<div class=controls data-script hidden><button type=button id=play aria-pressed=false>Play</button><input \
         type=range id=time min=0 max={end} step={every} value=0 aria-label=\"Time of the run\"><output id=clock \
         for=time></output><label>Speed <select id=speed><option value=1>1×<option value=5>5×<option value=15 \
         selected>15×<option value=60>60×</select></label>{traffic}</div><noscript><p class=note>The replay needs the script of \
         this page.</p></noscript><div class=picture><svg id=stage class=map viewBox=\"{view}\" data-colors=\"{colors}\" \
         role=img aria-label=\"The couriers on the map at the chosen time\"><use href=\"#city\"/></svg></div><p \
         class=key>{key}<span><i class=\"dot open\"></i>restaurant with an open order</span> <span><i class=\"dot \
         waiting\"></i>order waits for its courier</span> <span><i class=\"dot door\"></i>home that waits</span> \
         <span><i class=\"dot ring\"></i>on a scooter</span>{passers}</p><ol id=lines class=beats></ol><p class=note>{note}</p>\
         <script type=\"application/json\" id=film>{data}</script>",
        view = map.frame.view_box(),
        traffic = if track.passers.is_empty() { "" } else { TRAFFIC },
        passers = if track.passers.is_empty() { "" } else { PASSERS },
        note = escaped(&note(shown, every, couriers, stories.len(), data.len())),
    )
}

/// At which rate and of whom, so that nobody takes the film for the run; and how much of the page it takes.
fn note(shown: &Shown, every: f64, couriers: usize, orders: usize, bytes: usize) -> String {
    let part = |drawn: usize, all: usize, what: &str| {
        if drawn < all { format!(" The first {drawn} of {all} {what} are drawn.") } else { String::new() }
    };
    let track = &shown.track;
    let tracked = |on: Moves| track.passers.iter().filter(|passer| passer.on == on).count();
    let traffic = match track.traffic {
        (0, 0) => String::new(),
        (vehicles, people) => format!(
            " Of the traffic {} of {vehicles} vehicles and {} of {people} pedestrians are drawn, larger than they are.",
            tracked(Moves::Wheels),
            tracked(Moves::Feet),
        ),
    };
    format!(
        "Places were sampled every {every} s; between samples they are drawn on a straight line.{}{}{traffic} The replay \
         takes {} kB of this page. On the slider space plays and pauses and arrow keys step; an address that ends in #t=120 \
         opens two minutes into the run, and #t=120&play plays from there.",
        part(couriers, track.couriers.len(), "couriers"),
        part(orders.min(MOST_ORDERS), orders, "orders"),
        bytes.div_ceil(1000),
    )
}

type Row = (Tick, Vec<crate::delivery::Spot>);

/// The ways of some, each a cell of the map a sample.
fn ways(all: impl Iterator<Item = impl Iterator<Item = (i64, i64)>>) -> String {
    let mut bytes = Vec::new();
    for way in all {
        let mut at = (0, 0);
        for to in way {
            varint(to.0 - at.0, &mut bytes);
            varint(to.1 - at.1, &mut bytes);
            at = to;
        }
    }
    STANDARD.encode(bytes)
}

/// The traffic that was tracked.
fn passing(track: &Track, stride: usize, map: &CityMap) -> Passing {
    let rows = || track.passages.iter().step_by(stride);
    let way = |passer: usize| {
        let mut at = (0, 0);
        rows().map(move |row| {
            at = row[passer].map_or(at, |place| map.frame.cell(metres(place)));
            at
        })
    };
    let present = |passer: usize| changes(rows().map(move |row| usize::from(row[passer].is_some())));
    let all = 0..track.passers.len();
    Passing {
        vehicles: track.passers.iter().filter(|passer| passer.on == Moves::Wheels).count(),
        ways: ways(all.clone().map(way)),
        present: all.map(present).collect(),
    }
}

/// Seven bits a byte, the lowest first; the sign in the lowest bit.
fn varint(value: i64, bytes: &mut Vec<u8>) {
    let mut rest = ((value << 1) ^ (value >> 63)) as u64;
    while rest >= 0x80 {
        bytes.push(rest as u8 | 0x80);
        rest >>= 7;
    }
    bytes.push(rest as u8);
}

fn states(rows: &[&Row], courier: usize) -> Vec<usize> {
    changes(rows.iter().map(|(_, spots)| {
        let spot = spots[courier];
        let riding = if spot.mount == Mount::Scooter { Doing::ALL.len() } else { 0 };
        riding + Doing::ALL.iter().position(|doing| *doing == spot.doing).unwrap_or(0)
    }))
}

/// From which sample on a state holds, and the state; again and again.
fn changes(states: impl Iterator<Item = usize>) -> Vec<usize> {
    let (mut changes, mut last) = (Vec::new(), usize::MAX);
    for (sample, state) in states.enumerate() {
        if state != last {
            changes.extend([sample, state]);
            last = state;
        }
    }
    changes
}

fn order(shown: &Shown, map: &CityMap, story: &Story) -> Option<[f64; 9]> {
    let cell = |id| map.site(id).map(|site| map.frame.cell(site.access));
    let (from, to) = (cell(story.restaurant?)?, cell(story.home?)?);
    let time =
        |tick: Option<Tick>| tick.map_or(-1.0, |tick| (shown.track.seconds(tick) * 10.0).round() / 10.0);
    let gone = match &story.end {
        End::Expired(tick) => Some(*tick),
        End::Delivered(_, delivery) => Some(delivery.tick),
        End::Open | End::Won(_) => None,
    };
    let won = story.award().map(|award| award.tick);
    Some([
        story.order as f64,
        time(Some(story.posted)),
        time(won),
        time(story.picked_up()),
        time(gone),
        from.0 as f64,
        from.1 as f64,
        to.0 as f64,
        to.1 as f64,
    ])
}

/// What is worth a line below the stage; bids come too thick.
fn line(shown: &Shown, event: &Event) -> Option<(f64, String)> {
    let EventKind::Task { name, who, data } = &event.kind else { return None };
    let order = data.get("order").map(ToString::to_string).unwrap_or_default();
    let number = |key: &str| data.get(key).and_then(Value::as_f64).unwrap_or_default();
    let who =
        who.and_then(|who| shown.track.courier(who)).map(|courier| shown.name(courier)).unwrap_or_default();
    let words = match name.as_str() {
        "order_posted" => format!("order {order} is posted, for at most {}", dollars(number("ceiling"))),
        "order_awarded" => format!("{who} wins order {order} at {}", dollars(number("pay"))),
        "order_picked_up" => format!("{who} picks order {order} up"),
        "order_delivered" if number("late") > 0.0 => {
            format!("{who} delivers order {order}, {:.0} s late", number("late"))
        }
        "order_delivered" => format!("{who} delivers order {order} in time"),
        "order_expired" => format!("nobody took order {order}"),
        "order_shared" => format!("{who} offers to share order {order}"),
        "handed_over" => format!("{who} hands order {order} over"),
        "scooter_bought" => format!("{who} buys a scooter"),
        "drink_bought" => format!("{who} buys a drink"),
        "courier_exhausted" => format!("{who} is exhausted"),
        _ => return None,
    };
    Some(((shown.track.seconds(event.tick) * 10.0).round() / 10.0, words))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_changes_take_a_byte_and_read_back() {
        for value in [0, -1, 1, 63, -64, 64, 12_345, -987_654, i64::MAX, i64::MIN] {
            let mut bytes = Vec::new();
            varint(value, &mut bytes);
            let rest = bytes.iter().rev().fold(0_u64, |rest, byte| (rest << 7) | u64::from(byte & 0x7f));
            assert_eq!((rest >> 1) as i64 ^ -((rest & 1) as i64), value);
            assert!(bytes.len() == 1 || !(-64..64).contains(&value));
        }
    }
}
