//! The key: held where nothing prints it.

/// What stands where a key stood.
const HIDDEN: &str = "[key]";

/// Shorter ones would be found in ordinary words.
const SHORTEST: usize = 8;

/// A key. It is not `Clone`, `Serialize` or `Display`, and its `Debug` prints nothing of it.
pub(crate) struct ApiKey {
    key: String,
    /// As JSON may write it.
    escaped: String,
    stand_in: String,
}

impl ApiKey {
    /// What an environment variable holds; none if that is no key.
    pub(crate) fn from_variable(variable: &str) -> Option<Self> {
        Self::new(std::env::var(variable).ok()?.trim())
    }

    pub(crate) fn new(key: &str) -> Option<Self> {
        (key.len() >= SHORTEST && key.bytes().all(|byte| byte.is_ascii_graphic())).then(|| Self {
            key: key.to_owned(),
            escaped: key.replace('/', "\\/"),
            stand_in: format!("Bearer {}", "*".repeat(key.len())),
        })
    }

    /// The header's value with stars in place of the key; the transport puts the key in, behind every log.
    pub(crate) fn stand_in(&self) -> &str {
        &self.stand_in
    }

    /// The key itself, for the transport alone.
    pub(crate) fn revealed(&self) -> &[u8] {
        self.key.as_bytes()
    }

    /// The text without the key.
    pub(crate) fn scrubbed(&self, text: &str) -> String {
        text.replace(&self.key, HIDDEN).replace(&self.escaped, HIDDEN)
    }

    /// The key itself, and as JSON may write it.
    pub(crate) fn writings(&self) -> [&str; 2] {
        [&self.key, &self.escaped]
    }
}

impl std::fmt::Debug for ApiKey {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("ApiKey")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_one_line_of_visible_ascii_is_a_key() {
        const KEY: &str = "sk-ab/ab-secret";
        for wrong in ["", "short", "with space in it", "two\nlines\nhere", "schlüssel-geheim"] {
            assert!(ApiKey::new(wrong).is_none(), "{wrong:?}");
        }
        let key = ApiKey::new(KEY).unwrap();
        assert_eq!(format!("{key:?}"), "ApiKey");
        assert_eq!(key.stand_in().len(), "Bearer ".len() + KEY.len());
    }
}
