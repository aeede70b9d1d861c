//! The report as one page that needs nothing from elsewhere: it opens offline, prints, and follows the reader's choice of
//! light or dark.

use std::fmt::Write as _;

use simworld_agents::delivery::CourierRow;
use simworld_core::evaluation::Accumulator;
use simworld_core::hash::StateHasher;

use super::city::CityMap;
use super::story::{Story, stories};
use super::words::{count, escaped};
use super::{Finished, Shown, maps, replay, telling, timeline};
use crate::delivery::{COLUMNS, PAPER};
use crate::experiment::{Arm, Finding, Results, Trial, Verdict};

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");
/// Nothing may be fetched, whatever stands in a name.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

/// The page of what a folder holds, with its city if a run is shown.
pub(super) fn page(finished: &Finished, results: &Results, map: Option<&CityMap>) -> String {
    let mut body = Body::default();
    body.section(
        "findings",
        "What the paper says, and what these trials say of it",
        &findings(&results.findings),
    );
    body.section(
        "metrics",
        "The five metrics, beside the paper's",
        &metrics(&finished.arms, &finished.trials),
    );
    body.section("figures", "Tables and figures", &figures(results));
    match (&finished.shown, map) {
        (Some(shown), Some(map)) => body.run(shown, map),
        _ => body.section("map", "The map", &paragraph(&finished.unseen)),
    }
    body.section("settings", "Settings", &settings(&finished.arms));
    body.section("runs", "Runs", &runs(&finished.trials));
    let Body { contents, sections } = body;
    let (title, lead) = (escaped(&finished.title()), escaped(&finished.lead()));
    let city = map.map_or("", |map| map.drawing.as_str());
    format!(
        "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8><meta http-equiv=Content-Security-Policy \
         content=\"{POLICY}\"><meta name=viewport content=\"width=device-width,initial-scale=1\"><title>{title}</title>\
         <style>{STYLE}</style></head><body><svg width=0 height=0 aria-hidden=true style=\"position:absolute\"><defs><g \
         id=city>{city}</g></defs></svg><header><h1>{title}</h1><p class=lead>{lead}</p><nav>{contents}</nav></header>\
         <main>{sections}</main><script>{SCRIPT}</script></body></html>\n"
    )
}

/// Sections, and the links to them.
#[derive(Default)]
struct Body {
    contents: String,
    sections: String,
}

impl Body {
    fn section(&mut self, id: &str, title: &str, inside: &str) {
        if inside.is_empty() {
            return;
        }
        let title = escaped(title);
        // Writing to a string cannot fail.
        let _ = write!(self.contents, "<a href=\"#{id}\">{title}</a>");
        let _ = write!(self.sections, "<section id={id}><h2>{title}</h2>{inside}</section>");
    }

    /// What is shown of one recorded run.
    fn run(&mut self, shown: &Shown, map: &CityMap) {
        let stories: Vec<Story> = stories(&shown.events, &shown.track);
        let which = format!("<p class=note>{}</p>", escaped(&shown.which()));
        let maps = format!("{which}{}", maps::figure(shown, map, &stories));
        self.section("map", "The map, with heat and trails", &maps);
        let film = format!("{which}{}", replay::section(shown, map, &stories));
        self.section("replay", "The run again", &film);
        let times = format!("{which}{}", timeline::figure(shown));
        self.section("timelines", "What each courier did", &times);
        let told = format!("{which}{}", telling::section(shown, map, &stories));
        self.section("story", "The story of one order", &told);
    }
}

fn paragraph(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!("<p>{}</p>", escaped(text)) }
}

/// First how many claims hold, then those that do, those that do not, and those that stay open.
fn findings(findings: &[Finding]) -> String {
    if findings.is_empty() {
        return String::new();
    }
    let of = |verdict: Verdict| findings.iter().filter(move |finding| finding.verdict == verdict);
    let number = |verdict: Verdict| of(verdict).count();
    let mut text = format!(
        "<p class=tally>Of {} of the paper, <b>{} here</b>, {} and {}.</p><p class=note>A finding holds where the \
         sign is the paper's and chance alone would do as well in fewer than one of twenty tries; it does not hold \
         where the sign is the opposite one and chance is as unlikely a reason; else these trials do not decide, \
         and more seeds may.</p>",
        count(findings.len(), "finding"),
        verb(number(Verdict::Holds), "holds", "hold"),
        verb(number(Verdict::Opposite), "comes out the other way", "come out the other way"),
        verb(number(Verdict::Undecided), "stays undecided", "stay undecided"),
    );
    let groups = [
        (Verdict::Holds, "holds", "Holds"),
        (Verdict::Opposite, "opposite", "Does not hold; the opposite is seen"),
        (Verdict::Undecided, "undecided", "Undecided"),
    ];
    text.push_str("<ul class=findings>");
    for (verdict, class, words) in groups {
        for finding in of(verdict) {
            let (claim, evidence) = (escaped(&finding.claim), escaped(&finding.evidence));
            let _ =
                write!(text, "<li class={class}>{claim}.<br><b>{words}</b>: <small>{evidence}</small></li>");
        }
    }
    text + "</ul>"
}

/// A number with the verb that fits it.
fn verb(number: usize, one: &str, several: &str) -> String {
    let verb = if number == 1 { one } else { several };
    let number = if number == 0 { "none".to_owned() } else { number.to_string() };
    format!("{number} {verb}")
}

/// A row a setting over its seeds, then the paper's rows.
fn metrics(arms: &[Arm], trials: &[Trial]) -> String {
    let head = COLUMNS.map(|(heading, _)| escaped(heading)).join("<th>");
    let mut text = format!(
        "<div class=wide><table><thead><tr><th>mean ± standard deviation over seeds<th>{head}</tr></thead><tbody>"
    );
    for arm in arms {
        let of: Vec<&Trial> = trials.iter().filter(|trial| trial.arm == arm.name).collect();
        let cells = COLUMNS.iter().map(|(_, name)| {
            let values: Accumulator = of.iter().map(|trial| trial.metric(name)).collect();
            if values.count() > 0 { format!("<td>{values}") } else { "<td>-".to_owned() }
        });
        let cells: String = cells.collect();
        // A setting that is compared with no other needs no name.
        let name = if arms.len() > 1 { format!(": {}", escaped(&arm.name)) } else { String::new() };
        let seeds = count(of.len(), "seed");
        let _ = write!(text, "<tr class=own><td>simworld{name}, {seeds}{cells}</tr>");
    }
    for (model, cells) in PAPER {
        let cells = cells.map(escaped).join("<td>");
        let _ = write!(text, "<tr><td>paper: {}<td>{cells}</tr>", escaped(model));
    }
    text + "</tbody></table></div><p class=note>Profit, successful orders and energy efficiency are means per courier; \
            sharing and investment are counts over all couriers. Energy efficiency is energy consumed per dollar earned, as the \
            paper defines it, so less is better; the paper prints the largest in bold. The paper's rows are of twenty \
            couriers of one model each, 5000 steps, three seeds.</p>"
        + &reading(trials)
}

/// What the figures are made of, where the paper leaves open what its own are made of.
fn reading(trials: &[Trial]) -> String {
    let rows = || trials.iter().flat_map(|trial| &trial.report.couriers);
    let over_all = |figure: fn(&CourierRow) -> f64| rows().map(figure).collect::<Accumulator>();
    let (earned, profit) = (over_all(|row| row.earned.dollars()), over_all(|row| row.profit.dollars()));
    let (energy, paid) = (over_all(|row| row.energy), rows().filter(|row| row.delivered > 0).count());
    let (delivered, late) = (over_all(|row| f64::from(row.delivered)), over_all(|row| f64::from(row.late)));
    if earned.sum() <= 0.0 || energy.sum() <= 0.0 {
        return String::new();
    }
    let (per_dollar, per_unit) = (energy.sum() / earned.sum(), earned.sum() / energy.sum());
    format!(
        "<p class=note>Profit is what a courier owns at the end less what it owned at the start: here it was paid {:.2} $ on \
         average, {:.2} $ of which went into scooters, drinks and batteries, and {paid} of {} couriers brought home \
         anything. Of {:.0} orders {:.0} came late, which costs up to half of the price. A dollar \
         earned took {per_dollar:.2} of energy; a unit of energy earned {per_unit:.2} $. The paper does not say \
         how much energy a metre takes, and its figures are of the size of the second; nothing here is scaled to meet them.</p>",
        earned.mean(),
        earned.mean() - profit.mean(),
        earned.count(),
        delivered.sum(),
        late.sum()
    )
}

fn figures(results: &Results) -> String {
    let mut text = String::new();
    for table in &results.tables {
        let _ = write!(text, "<div class=wide>{}</div>", table.to_html());
    }
    for chart in &results.charts {
        // The declaration of a file has no place inside a page.
        let svg = chart.svg.find("<svg").map_or(chart.svg.as_str(), |start| &chart.svg[start..]);
        let (title, caption) = (escaped(&chart.title), escaped(&chart.caption));
        let _ = write!(
            text,
            "<figure><h3>{title}</h3><div class=picture>{svg}</div><figcaption>{caption}</figcaption></figure>"
        );
    }
    text
}

fn settings(arms: &[Arm]) -> String {
    let mut text = String::new();
    for arm in arms {
        let toml = arm.config.to_toml().unwrap_or_default();
        let hash = StateHasher::new().str(&toml).finish();
        let _ = write!(
            text,
            "<details><summary>{}: hash <code>{hash}</code></summary><pre>{}</pre></details>",
            escaped(&arm.name),
            escaped(&toml)
        );
    }
    text + "<p class=note>The hash is XXH3 of the settings as they stand here; the same settings give the same bits.</p>"
}

fn runs(trials: &[Trial]) -> String {
    let mut rows = String::new();
    for trial in trials {
        let _ = write!(
            rows,
            "<tr><td>{}<td>{}<td>{}<td>{}<td><code>{}</code></tr>",
            escaped(&trial.arm),
            trial.seed,
            trial.auctions.len(),
            trial.report.delivered,
            trial.digest
        );
    }
    format!(
        "<div class=wide><table><thead><tr><th>setting<th>seed<th>orders<th>delivered<th>digest of the final \
         state</tr></thead><tbody>{rows}</tbody></table></div>"
    )
}
