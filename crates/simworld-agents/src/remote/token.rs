//! The secret that a client shows before it may do anything.

use std::fmt;

use subtle::ConstantTimeEq;
use thiserror::Error;

/// Fewer bytes are guessed too easily.
const SHORTEST: usize = 16;
/// More do not fit into the hello of the typed protocol.
const LONGEST: usize = 1024;

/// A secret shared with clients. It is compared in constant time and never printed.
#[derive(Clone)]
pub struct Token(Vec<u8>);

/// Text that is no token.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum TokenError {
    /// Too short or too long, or with white space.
    #[error(
        "a token has 16 to 1024 bytes without white space, this one has {length}: make one with `openssl rand -hex 24`"
    )]
    Shape {
        /// Bytes given.
        length: usize,
    },
    /// The variable of the environment is not text.
    #[error("the environment's {variable} is not UTF-8: give letters and digits")]
    Environment {
        /// Its name.
        variable: String,
    },
}

impl Token {
    /// The token of that text.
    ///
    /// # Errors
    /// Fewer than 16 or more than 1024 bytes, or white space, which the text protocol cannot carry.
    pub fn new(text: &str) -> Result<Self, TokenError> {
        let length = text.len();
        if (SHORTEST..=LONGEST).contains(&length) && !text.contains(char::is_whitespace) {
            Ok(Self(text.as_bytes().to_vec()))
        } else {
            Err(TokenError::Shape { length })
        }
    }

    /// The token that a variable of the environment holds; none where it is not set or empty.
    ///
    /// # Errors
    /// The variable holds no token.
    pub fn from_environment(variable: &str) -> Result<Option<Self>, TokenError> {
        match std::env::var(variable) {
            Ok(text) if text.is_empty() => Ok(None),
            Ok(text) => Self::new(&text).map(Some),
            Err(std::env::VarError::NotPresent) => Ok(None),
            Err(std::env::VarError::NotUnicode(_)) => {
                Err(TokenError::Environment { variable: variable.to_owned() })
            }
        }
    }

    /// Whether what was shown is this token; the time tells nothing but whether the lengths agree.
    pub fn is(&self, shown: &[u8]) -> bool {
        self.0.ct_eq(shown).into()
    }

    pub(super) fn bytes(&self) -> &[u8] {
        &self.0
    }
}

impl fmt::Debug for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Token(..)")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_token_is_itself_and_nothing_else_and_is_never_printed() {
        let token = Token::new("correct-horse-battery").unwrap();
        assert!(token.is(b"correct-horse-battery"));
        for other in ["", "correct-horse-batterz", "correct-horse-battery0", "correct"] {
            assert!(!token.is(other.as_bytes()), "{other}");
        }
        assert!(!format!("{token:?}").contains("horse"));
    }

    #[test]
    fn short_ones_are_refused_without_being_told() {
        let error = Token::new("hunter2").unwrap_err();
        assert!(!error.to_string().contains("hunter2"));
        assert!(Token::new("with white space in it").is_err());
    }
}
