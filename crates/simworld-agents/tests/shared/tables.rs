//! Tables of what people say: a table is a family, and a line is what is said and what it means.

use std::collections::BTreeMap;
use std::path::Path;

/// The lines of a file in `tests`, each with its family and what it means; none where there is no such file.
pub(crate) fn lines_of(file: &str) -> Vec<[String; 3]> {
    let path = format!("{}/tests/{file}", env!("CARGO_MANIFEST_DIR"));
    if Path::new(&path).exists() { lines_at(Path::new(&path)) } else { Vec::new() }
}

/// The lines of a file anywhere, each with its family and what it means.
pub(crate) fn lines_at(path: &Path) -> Vec<[String; 3]> {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let families: BTreeMap<String, BTreeMap<String, String>> =
        toml::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let lines = families.into_iter().flat_map(|(family, lines)| {
        lines.into_iter().map(move |(words, meaning)| [family.clone(), words, meaning])
    });
    lines.collect()
}
