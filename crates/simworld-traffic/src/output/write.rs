//! Numbers and text as SUMO's files have them, and the two syntaxes.

use std::fmt::{self, Display};
use std::io::{self, Write};

/// How an output is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Syntax {
    /// XML as SUMO writes it, which its tools read.
    #[default]
    Xml,
    /// A line of names, then a line a record, between semicolons, as SUMO's `xml2csv.py` makes it.
    Csv,
}

/// A number with two decimals; never `-0.00`.
pub(super) struct Two(pub(super) f64);

impl Display for Two {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Adding zero turns -0 into 0.
        write!(f, "{:.2}", (self.0 * 100.0).round() / 100.0 + 0.0)
    }
}

/// Text that may stand between quotes.
pub(super) struct Safe<'a>(pub(super) &'a str);

impl Display for Safe<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for c in self.0.chars() {
            match c {
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '&' => f.write_str("&amp;")?,
                '"' => f.write_str("&quot;")?,
                c if c.is_control() => f.write_str(" ")?,
                c => write!(f, "{c}")?,
            }
        }
        Ok(())
    }
}

/// Writes records of one kind: an element with attributes, or a line.
pub(super) struct Records<W> {
    pub(super) out: W,
    syntax: Syntax,
    root: &'static str,
    /// Whether the line of names is written.
    named: bool,
    /// The group that is open, in XML.
    group: Option<&'static str>,
}

/// An attribute and its value.
pub(super) type Field<'a> = (&'static str, &'a dyn Display);

impl<W: Write> Records<W> {
    pub(super) fn new(mut out: W, syntax: Syntax, root: &'static str) -> io::Result<Self> {
        if syntax == Syntax::Xml {
            writeln!(out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
            writeln!(out, "<{root}>")?;
        }
        Ok(Self { out, syntax, root, named: false, group: None })
    }

    /// Begins an element that holds records, as that of a time; its fields come first in every line of CSV.
    pub(super) fn begin(&mut self, element: &'static str, fields: &[Field<'_>]) -> io::Result<()> {
        self.end()?;
        if self.syntax == Syntax::Xml {
            write!(self.out, "    <{element}")?;
            self.attributes(fields)?;
            writeln!(self.out, ">")?;
            self.group = Some(element);
        }
        Ok(())
    }

    pub(super) fn end(&mut self) -> io::Result<()> {
        if let Some(element) = self.group.take() {
            writeln!(self.out, "    </{element}>")?;
        }
        Ok(())
    }

    /// Writes a record; `group` are the fields of the element about it, which CSV repeats.
    pub(super) fn record(
        &mut self,
        element: &'static str,
        group: &[Field<'_>],
        fields: &[Field<'_>],
    ) -> io::Result<()> {
        match self.syntax {
            Syntax::Xml => {
                let depth = if self.group.is_some() { "        " } else { "    " };
                write!(self.out, "{depth}<{element}")?;
                self.attributes(fields)?;
                writeln!(self.out, "/>")
            }
            Syntax::Csv => {
                let all = || group.iter().chain(fields);
                if !self.named {
                    self.named = true;
                    self.line(all().map(|(name, _)| name as &dyn Display))?;
                }
                self.line(all().map(|(_, value)| *value))
            }
        }
    }

    fn attributes(&mut self, fields: &[Field<'_>]) -> io::Result<()> {
        fields.iter().try_for_each(|(name, value)| write!(self.out, r#" {name}="{value}""#))
    }

    fn line<'a>(&mut self, values: impl Iterator<Item = &'a dyn Display>) -> io::Result<()> {
        for (index, value) in values.enumerate() {
            let gap = if index == 0 { "" } else { ";" };
            write!(self.out, "{gap}{value}")?;
        }
        writeln!(self.out)
    }

    pub(super) fn finish(&mut self) -> io::Result<()> {
        self.end()?;
        if self.syntax == Syntax::Xml {
            writeln!(self.out, "</{}>", self.root)?;
        }
        self.out.flush()
    }
}
