//! Names that are like one that is not there.

use simworld_core::asset::Catalogue;

use crate::retrieval::AssetIndex;

/// Names as like as this, of 1, are told.
const ALIKE: f64 = 0.6;
/// So many are told of each kind of likeness.
const MOST: usize = 3;

/// Names that are spelt like one, the likest first; of equally like ones the first of the alphabet.
pub(super) fn spelt_like<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let plain = name.to_lowercase();
    let likeness = |other: &str| strsim::normalized_damerau_levenshtein(&plain, &other.to_lowercase());
    let mut near: Vec<(f64, &str)> = names.map(|other| (likeness(other), other)).collect();
    near.retain(|(likeness, _)| *likeness >= ALIKE);
    near.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
    near.into_iter().take(MOST).map(|(_, other)| other.to_owned()).collect()
}

/// Assets that are spelt like a name, then those that its words mean.
pub(super) fn assets_like(name: &str, catalogue: &Catalogue, index: &AssetIndex) -> Vec<String> {
    let names = catalogue.iter().map(|(_, asset)| asset.name.as_str());
    let mut near = spelt_like(&name.replace([' ', '-'], "_"), names);
    for hit in index.retrieve(&name.replace('_', " "), MOST) {
        if !near.contains(&hit.name) {
            near.push(hit.name);
        }
    }
    near
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_and_other_words_find_what_is_meant() {
        let catalogue = Catalogue::library();
        let index = AssetIndex::of(&catalogue);
        let near = |name| assets_like(name, &catalogue, &index);
        assert_eq!(near("bnch")[0], "bench");
        assert_eq!(near("street lamp")[0], "street_lamp");
        assert!(near("sofa").contains(&"couch".to_owned()), "{:?}", near("sofa"));
        assert!(near("qqqqqqqq").is_empty());
    }
}
