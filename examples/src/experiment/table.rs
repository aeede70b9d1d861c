//! Tables: on the terminal, in the report, and as files.

use comfy_table::presets::UTF8_FULL_CONDENSED;
use comfy_table::{Cell, CellAlignment};
use serde::Serialize;

/// A table of texts; the first column names the rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Table {
    /// What it shows, which is also its name in files.
    pub title: String,
    /// The headings of its columns.
    pub header: Vec<String>,
    /// Its rows, each as long as the header.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    pub(super) fn new(title: &str, header: &[&str]) -> Self {
        let header = header.iter().map(|text| (*text).to_owned()).collect();
        Self { title: title.to_owned(), header, rows: Vec::new() }
    }

    pub(super) fn add(&mut self, name: impl Into<String>, cells: impl IntoIterator<Item = String>) {
        self.rows.push([name.into()].into_iter().chain(cells).collect());
    }

    /// As it stands on a terminal.
    pub fn to_terminal(&self) -> String {
        let mut table = comfy_table::Table::new();
        table.load_style(UTF8_FULL_CONDENSED);
        table.set_header(&self.header);
        for row in &self.rows {
            table.add_row(row.iter().enumerate().map(|(column, text)| {
                let cell = Cell::new(text);
                if column > 0 { cell.set_alignment(CellAlignment::Right) } else { cell }
            }));
        }
        format!("{}\n{table}", self.title)
    }

    /// As comma-separated values, by RFC 4180.
    pub fn to_csv(&self) -> String {
        let quoted = |text: &String| {
            if text.contains([',', '"', '\n']) {
                format!("\"{}\"", text.replace('"', "\"\""))
            } else {
                text.clone()
            }
        };
        let line = |cells: &Vec<String>| cells.iter().map(quoted).collect::<Vec<_>>().join(",") + "\r\n";
        [&self.header].into_iter().chain(&self.rows).map(line).collect()
    }

    /// As a table of HTML.
    pub(crate) fn to_html(&self) -> String {
        // Names of settings and metrics are read here, and not typed.
        let name = |text: &String| escaped(&text.replace('_', " "));
        let row = |cells: &Vec<String>, tag: &str| {
            let names = if tag == "th" { cells.len() } else { 1 };
            let (names, figures) = cells.split_at(names.min(cells.len()));
            let cells = names.iter().map(name).chain(figures.iter().map(|text| escaped(text)));
            let cells: Vec<String> = cells.collect();
            format!("<tr><{tag}>{}</{tag}></tr>", cells.join(&format!("</{tag}><{tag}>")))
        };
        let rows: String = self.rows.iter().map(|cells| row(cells, "td")).collect();
        let (caption, header) = (escaped(&self.title), row(&self.header, "th"));
        format!("<table><caption>{caption}</caption><thead>{header}</thead><tbody>{rows}</tbody></table>")
    }

    /// Its title as the name of a file.
    pub(super) fn file_stem(&self) -> String {
        file_stem(&self.title)
    }
}

/// A title as the name of a file.
pub(super) fn file_stem(title: &str) -> String {
    let plain = |letter: char| if letter.is_ascii_alphanumeric() { letter.to_ascii_lowercase() } else { '-' };
    let words: String = title.chars().map(plain).collect();
    words.split('-').filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-")
}

/// A text in HTML.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_separates_is_quoted() {
        let mut table = Table::new("Bids, by policy", &["policy", "mean"]);
        table.add("low, \"lower\"", ["1.5".to_owned()]);
        assert_eq!(table.to_csv(), "policy,mean\r\n\"low, \"\"lower\"\"\",1.5\r\n");
        assert_eq!(table.file_stem(), "bids-by-policy");
        assert!(table.to_html().contains("<td>low, &quot;lower&quot;</td>"));
        table.add("a_name", ["a_text".to_owned()]);
        assert!(table.to_html().contains("<td>a name</td><td>a_text</td>"));
    }
}
