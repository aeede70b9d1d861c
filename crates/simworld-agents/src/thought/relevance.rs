//! How well texts fit a question: Okapi BM25 (Robertson and Zaragoza, "The Probabilistic Relevance Framework", 2009).

use std::collections::BTreeMap;

use simworld_core::ops::ln;

/// Saturation of repeated words; 1.2 is the usual choice.
const K1: f64 = 1.2;
/// How much long texts are marked down, 0 to 1; 0.75 is the usual choice.
const B: f64 = 0.75;

/// The score of each text for the question, zero where no word is shared.
pub(super) fn bm25(question: &str, texts: &[&str]) -> Vec<f64> {
    let texts: Vec<Vec<String>> = texts.iter().map(|text| words(text)).collect();
    let mut wanted = words(question);
    wanted.sort_unstable();
    wanted.dedup();
    let total: usize = texts.iter().map(Vec::len).sum();
    let average = (total as f64 / texts.len().max(1) as f64).max(1.0);
    let counts: Vec<BTreeMap<&str, f64>> = texts
        .iter()
        .map(|text| {
            let mut count = BTreeMap::new();
            for word in text {
                *count.entry(word.as_str()).or_insert(0.0) += 1.0;
            }
            count
        })
        .collect();
    let rarity = |word: &str| {
        let having = counts.iter().filter(|count| count.contains_key(word)).count() as f64;
        ln(1.0 + (texts.len() as f64 - having + 0.5) / (having + 0.5))
    };
    let rarities: Vec<f64> = wanted.iter().map(|word| rarity(word)).collect();
    let score = |(count, text): (&BTreeMap<&str, f64>, &Vec<String>)| {
        let length = 1.0 - B + B * text.len() as f64 / average;
        wanted.iter().zip(&rarities).fold(0.0, |sum, (word, rarity)| {
            let often = count.get(word.as_str()).copied().unwrap_or(0.0);
            sum + rarity * often * (K1 + 1.0) / (often + K1 * length)
        })
    };
    counts.iter().zip(&texts).map(score).collect()
}

/// The words of a text: letters and digits, in lower case.
fn words(text: &str) -> Vec<String> {
    let parts = text.split(|sign: char| !sign.is_alphanumeric()).filter(|word| !word.is_empty());
    parts.map(str::to_lowercase).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rare_word_counts_more_than_a_common_one() {
        let texts = ["the bench by the river", "the bench by the road", "the old bench and a fountain"];
        let scores = bm25("bench fountain", &texts);
        assert!(scores[2] > scores[0] && scores[0] == scores[1] && scores[0] > 0.0, "{scores:?}");
        assert_eq!(bm25("zebra", &texts), [0.0; 3]);
        assert_eq!(bm25("Fountain!", &texts)[0], 0.0);
        assert!(bm25("", &[]).is_empty());
    }

    #[test]
    fn the_formula_gives_its_number() {
        // One text of two, each of two words: rarity ln(1 + 1.5 / 1.5) = ln 2, often 1, length 1.
        let scores = bm25("cat", &["cat sat", "dog sat"]);
        assert!((scores[0] - std::f64::consts::LN_2).abs() < 1e-12, "{scores:?}");
    }
}
