//! Finds the line of a setting in a TOML text, so that a value out of range is named with its place.

use toml::de::{DeTable, DeValue};

/// The line, counted from 1, on which the value of a dotted key stands; `None` if the text does not set it.
pub(super) fn line_of(text: &str, key: &str) -> Option<usize> {
    let root = DeTable::parse(text).ok()?;
    let mut table = root.get_ref();
    let mut parts = key.split('.').peekable();
    while let Some(part) = parts.next() {
        let value = table.get(part)?;
        if parts.peek().is_none() {
            return Some(1 + text.get(..value.span().start)?.matches('\n').count());
        }
        match value.get_ref() {
            DeValue::Table(inner) => table = inner,
            _ => return None,
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_nested_key_is_found_on_its_line() {
        let text = "steps = 10\n\n[delivery.energy]\ncapacity = 100\nwalking = -1.0\n";
        assert_eq!(line_of(text, "steps"), Some(1));
        assert_eq!(line_of(text, "delivery.energy.walking"), Some(5));
        assert_eq!(line_of(text, "delivery.energy.absent"), None);
        assert_eq!(line_of("not toml [", "steps"), None);
    }
}
