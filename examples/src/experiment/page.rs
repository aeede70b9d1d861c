//! The report: one page that needs nothing from elsewhere.

use std::fmt::Write as _;

use super::findings::Verdict;
use super::preset::{Arm, Preset};
use super::results::Results;
use super::table::escaped;
use super::trial::Trial;

const STYLE: &str = include_str!("page.css");

/// The report of an experiment as HTML, with pictures inside and no script; it opens offline, prints, and follows the
/// reader's choice of light or dark.
pub fn page(preset: Preset, arms: &[Arm], trials: &[Trial], results: &Results) -> String {
    let mut body = String::new();
    let title = format!("simworld: the {preset} experiment");
    section(&mut body, "What the trials say", &findings(results));
    for table in &results.tables {
        let _ = write!(body, "<section class=wide>{}</section>", table.to_html());
    }
    for chart in &results.charts {
        figure(&mut body, &chart.title, &chart.caption, &chart.svg);
    }
    section(&mut body, "Settings", &settings(arms));
    section(&mut body, "Runs", &runs(trials));
    format!(
        "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8><meta name=viewport \
         content=\"width=device-width\"><title>{title}</title><style>{STYLE}</style></head><body><h1>{title}</h1>\
         <p class=lead>{question}</p>{body}</body></html>\n",
        question = escaped(preset.question()),
    )
}

fn section(body: &mut String, title: &str, inside: &str) {
    // Writing to a string cannot fail.
    let _ = write!(body, "<section><h2>{}</h2>{inside}</section>", escaped(title));
}

fn figure(body: &mut String, title: &str, caption: &str, svg: &str) {
    // The declaration of a file has no place inside a page.
    let svg = svg.find("<svg").map_or(svg, |start| &svg[start..]);
    let (title, caption) = (escaped(title), escaped(caption));
    let _ = write!(
        body,
        "<figure><h2>{title}</h2><div class=picture>{svg}</div><figcaption>{caption}</figcaption></figure>"
    );
}

fn findings(results: &Results) -> String {
    let mut list = String::from("<ul class=findings>");
    for finding in &results.findings {
        let class = match finding.verdict {
            Verdict::Holds => "holds",
            Verdict::Opposite => "opposite",
            Verdict::Undecided => "undecided",
        };
        let _ = write!(
            list,
            "<li><b class={class}>{}</b> {}<br><small>{}</small></li>",
            finding.verdict,
            escaped(&finding.claim),
            escaped(&finding.evidence)
        );
    }
    list + "</ul>"
}

fn settings(arms: &[Arm]) -> String {
    let mut text = String::new();
    for arm in arms {
        let toml = arm.config.to_toml().unwrap_or_default();
        let _ = write!(
            text,
            "<details><summary>{}</summary><pre>{}</pre></details>",
            escaped(&arm.name),
            escaped(&toml)
        );
    }
    text
}

fn runs(trials: &[Trial]) -> String {
    let mut rows = String::new();
    for trial in trials {
        let _ = write!(
            rows,
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td><code>{}</code></td></tr>",
            escaped(&trial.arm),
            trial.seed,
            trial.auctions.len(),
            trial.report.delivered,
            trial.digest
        );
    }
    format!(
        "<table><thead><tr><th>setting</th><th>seed</th><th>orders</th><th>delivered</th><th>digest of the final \
         state</th></tr></thead><tbody>{rows}</tbody></table>"
    )
}
