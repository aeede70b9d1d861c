//! The sheet on which pictures are drawn, in millimetres, and its inks: those of the city's maps.

use std::fmt::Write;

/// The sheet.
const PAPER: &str = "#faf7f0";
/// Lettering and frames.
pub(super) const INK: &str = "#33352f";
/// Lesser lettering.
pub(super) const FAINT: &str = "#7c7a70";
/// Lines behind what is drawn.
pub(super) const RULE: &str = "#ddd8ca";
const FONT: &str = "Roboto, 'Helvetica Neue', Helvetica, Arial, sans-serif";

/// How letters are set.
#[derive(Clone, Copy, Debug)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Anchor {
    const fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

/// A rectangle on paper, y downwards, mm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Frame {
    pub(super) fn right(&self) -> f64 {
        self.x + self.width
    }

    pub(super) fn bottom(&self) -> f64 {
        self.y + self.height
    }
}

/// An SVG text that is being written.
pub(super) struct Sheet {
    text: String,
}

impl Sheet {
    /// A sheet with its title and a line below it.
    pub(super) fn new((width, height): (f64, f64), title: &str, subtitle: &str) -> Self {
        let mut sheet = Self { text: String::new() };
        let title = escaped(title);
        sheet.raw(&format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}" font-family="{FONT}" fill="{INK}">
<title>{title}</title>
<rect width="{width}" height="{height}" fill="{PAPER}"/>"#
        ));
        sheet.letters((14.0, 16.0), 6.4, Anchor::Start, INK, "500", &title);
        sheet.letters((14.0, 22.4), 3.3, Anchor::Start, FAINT, "400", &escaped(subtitle));
        sheet
    }

    /// Adds markup as it is.
    pub(super) fn raw(&mut self, markup: &str) {
        self.text.push_str(markup);
        self.text.push('\n');
    }

    fn letters(
        &mut self,
        (x, y): (f64, f64),
        size: f64,
        anchor: Anchor,
        ink: &str,
        weight: &str,
        escaped: &str,
    ) {
        let anchor = anchor.name();
        self.raw(&format!(
            r#"<text x="{x:.2}" y="{y:.2}" font-size="{size}" font-weight="{weight}" text-anchor="{anchor}" fill="{ink}">{escaped}</text>"#
        ));
    }

    pub(super) fn label(&mut self, place: (f64, f64), size: f64, anchor: Anchor, ink: &str, words: &str) {
        self.letters(place, size, anchor, ink, "400", &escaped(words));
    }

    /// Letters that read upwards.
    pub(super) fn label_upwards(&mut self, (x, y): (f64, f64), size: f64, words: &str) {
        let words = escaped(words);
        self.raw(&format!(
            r#"<text transform="translate({x:.2} {y:.2}) rotate(-90)" font-size="{size}" text-anchor="middle">{words}</text>"#
        ));
    }

    pub(super) fn rect(&mut self, frame: Frame, fill: &str) {
        let Frame { x, y, width, height } = frame;
        self.raw(&format!(
            r#"<rect x="{x:.2}" y="{y:.2}" width="{width:.2}" height="{height:.2}" fill="{fill}"/>"#
        ));
    }

    pub(super) fn line(&mut self, points: impl IntoIterator<Item = (f64, f64)>, ink: &str, width: f64) {
        let data = path_data(points);
        if !data.is_empty() {
            self.raw(&format!(
                r#"<path d="{data}" fill="none" stroke="{ink}" stroke-width="{width}" stroke-linejoin="round" stroke-linecap="round"/>"#
            ));
        }
    }

    /// Opens a group in which only what is in a frame is seen.
    pub(super) fn begin_clip(&mut self, id: &str, frame: Frame) {
        let Frame { x, y, width, height } = frame;
        self.raw(&format!(
            r#"<clipPath id="{id}"><rect x="{x:.2}" y="{y:.2}" width="{width:.2}" height="{height:.2}"/></clipPath><g clip-path="url(#{id})">"#
        ));
    }

    pub(super) fn end_group(&mut self) {
        self.raw("</g>");
    }

    pub(super) fn finish(mut self) -> String {
        self.raw("</svg>");
        self.text
    }
}

/// Path data of a line, mm; empty of fewer than two points.
pub(super) fn path_data(points: impl IntoIterator<Item = (f64, f64)>) -> String {
    let mut data = String::new();
    let mut count = 0;
    for (x, y) in points {
        let letter = if count == 0 { 'M' } else { 'L' };
        count += 1;
        // Writing to a string never fails.
        let _ = write!(data, "{letter}{x:.2} {y:.2}");
    }
    if count < 2 { String::new() } else { data }
}

/// A text in which no letter means anything to XML.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            control if control.is_control() => out.push(' '),
            other => out.push(other),
        }
    }
    out
}
