//! Sentences to tokens: lower-case words, numbers, entity ids and the little punctuation that has a meaning.

use simworld_core::id::EntityId;

use super::verbs::base_form;

/// The smallest piece of a sentence.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Token {
    /// A word in lower case without its apostrophes; a symbol that means nothing here is a word nobody knows.
    Word(String),
    /// A finite number.
    Number(f64),
    /// An entity, written `#12` or `#12.1`.
    Id(EntityId),
    /// Several entities, put by readers in the place of words that mean them.
    Ids(Vec<EntityId>),
    /// An opening bracket.
    Open,
    /// A closing bracket.
    Close,
    /// A comma.
    Comma,
    /// The end of a sentence or of a part of it.
    Break,
}

/// A token and the bytes it was read from.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lexeme {
    pub(crate) token: Token,
    /// The base form, if the token is an inflected verb: "sit" for "sitting".
    pub(crate) lemma: Option<String>,
    pub(crate) start: usize,
    pub(crate) end: usize,
}

/// The word that stands there; empty if it is something else.
pub(super) fn word_of(lexeme: &Lexeme) -> &str {
    match &lexeme.token {
        Token::Word(word) => word,
        _ => "",
    }
}

/// Whether it is a comma or the end of a sentence.
pub(super) const fn is_mark(lexeme: &Lexeme) -> bool {
    matches!(lexeme.token, Token::Comma | Token::Break)
}

/// Reads the tokens of a text, in order.
pub(crate) fn lex(text: &str) -> Vec<Lexeme> {
    let lexeme = |(token, start, end)| {
        let lemma = if let Token::Word(word) = &token { base_form(word) } else { None };
        Lexeme { token, lemma, start, end }
    };
    tokens(text).map(lexeme).collect()
}

/// The tokens of a text, each with the bytes it was read from.
pub(super) fn tokens(text: &str) -> impl Iterator<Item = (Token, usize, usize)> {
    let mut at = 0;
    std::iter::from_fn(move || {
        loop {
            let rest = &text[at..];
            let first = rest.chars().next()?;
            let (token, length) = if let Some(found) = id(rest) {
                (Some(found.0), found.1)
            } else if let Some(found) = number(rest, follows_word(text, at)) {
                (Some(found.0), found.1)
            } else if let Some(found) = half_of_day(text, at) {
                (Some(found.0), found.1)
            } else if first.is_alphanumeric() {
                let (word, length) = word(rest);
                (Some(Token::Word(word)), length)
            } else {
                (symbol(first), first.len_utf8())
            };
            let start = at;
            at += length;
            if let Some(token) = token {
                return Some((token, start, at));
            }
        }
    })
}

/// What was written from the first of some tokens to the last, in whatever order they are.
pub(crate) fn written<'a>(text: &'a str, lexemes: &[Lexeme]) -> &'a str {
    let start = lexemes.iter().map(|lexeme| lexeme.start).min();
    let end = lexemes.iter().map(|lexeme| lexeme.end).max();
    start.zip(end).and_then(|(start, end)| text.get(start..end)).unwrap_or_default()
}

/// What a rule makes of a sentence, word by word; whatever is no word and no number is a comma.
#[cfg(test)]
pub(crate) fn rewritten(said: &str, rule: impl FnOnce(&mut Vec<Lexeme>)) -> String {
    let mut lexemes = lex(said);
    rule(&mut lexemes);
    let words = lexemes.iter().map(|lexeme| match &lexeme.token {
        Token::Word(word) => word.clone(),
        Token::Number(number) => number.to_string(),
        _ => ",".to_owned(),
    });
    words.collect::<Vec<_>>().join(" ")
}

fn symbol(symbol: char) -> Option<Token> {
    match symbol {
        '(' | '[' => Some(Token::Open),
        ')' | ']' => Some(Token::Close),
        ',' => Some(Token::Comma),
        '.' | ';' | ':' | '!' | '?' | '\n' => Some(Token::Break),
        '&' => Some(Token::Word("and".to_owned())),
        '"' | '\'' | '`' | '“' | '”' | '„' | '‘' | '’' | '«' | '»' | '-' | '–' | '—' | '_' => {
            None
        }
        blank if blank.is_whitespace() => None,
        other => Some(Token::Word(other.to_string())),
    }
}

/// Whether the text just before the byte is part of a word: then a dash is a hyphen and not a sign.
fn follows_word(text: &str, at: usize) -> bool {
    text[..at].chars().next_back().is_some_and(char::is_alphanumeric)
}

fn digits(text: &str) -> usize {
    text.bytes().take_while(u8::is_ascii_digit).count()
}

fn number(text: &str, follows_word: bool) -> Option<(Token, usize)> {
    let sign = text.chars().next().filter(|sign| matches!(sign, '-' | '+' | '−') && !follows_word);
    let signed = sign.map_or(0, char::len_utf8);
    let mut length = digits(&text[signed..]);
    if length == 0 {
        return None;
    }
    if let Some(fraction) = text[signed + length..].strip_prefix('.') {
        let places = digits(fraction);
        length += if places > 0 { 1 + places } else { 0 };
    }
    if ["st", "nd", "rd", "th"].iter().any(|ending| is_word(&text[signed + length..], ending)) {
        return None; // "2nd" is a word
    }
    // More digits than a number holds make infinity, which no rule takes for a place or a time.
    let value: f64 = text[signed..signed + length].parse().ok()?;
    let value = if matches!(sign, Some('-' | '−')) { -value } else { value };
    Some((Token::Number(value), signed + length))
}

/// "p.m.", "a.m": one word, in which a full stop ends no sentence, unless it is the last and another sentence begins behind it.
fn half_of_day(text: &str, at: usize) -> Option<(Token, usize)> {
    const LETTERS: usize = "p.m".len();
    let [first, b'.', second, ..] = text.as_bytes().get(at..)? else { return None };
    let word = match (first.to_ascii_lowercase(), second.to_ascii_lowercase()) {
        (b'a', b'm') => "am",
        (b'p', b'm') => "pm",
        _ => return None,
    };
    let behind = text.get(at + LETTERS..)?;
    let is_inside_word = text[..at].chars().next_back().is_some_and(char::is_alphabetic)
        || behind.starts_with(char::is_alphanumeric);
    let goes_on = behind
        .strip_prefix('.')
        .is_some_and(|rest| rest.trim_start().starts_with(|next: char| !next.is_uppercase()));
    (!is_inside_word).then(|| (Token::Word(word.to_owned()), LETTERS + usize::from(goes_on)))
}

/// Whether the text begins with just that word.
fn is_word(text: &str, word: &str) -> bool {
    text.strip_prefix(word).is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
}

fn id(text: &str) -> Option<(Token, usize)> {
    let rest = text.strip_prefix('#')?;
    let length = digits(rest);
    let index = rest[..length].parse().ok()?;
    let generation = rest[length..].strip_prefix('.').map(|rest| &rest[..digits(rest)]);
    match generation.filter(|digits| !digits.is_empty()) {
        Some(digits) => {
            let id = EntityId::new(index, digits.parse().ok()?);
            Some((Token::Id(id), 1 + length + 1 + digits.len()))
        }
        None => Some((Token::Id(EntityId::new(index, 0)), 1 + length)),
    }
}

fn word(text: &str) -> (String, usize) {
    let plain = text.bytes().take_while(u8::is_ascii_alphanumeric).count();
    if text.as_bytes().get(plain).is_none_or(|next| next.is_ascii() && *next != b'\'') {
        return (text[..plain].to_ascii_lowercase(), plain);
    }
    let mut word = String::new();
    let mut length = 0;
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        if letter.is_alphanumeric() {
            word.extend(letter.to_lowercase());
        } else if !(matches!(letter, '\'' | '’') && letters.peek().is_some_and(|next| next.is_alphanumeric()))
        {
            break;
        }
        length += letter.len_utf8();
    }
    (word, length)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str) -> Vec<Token> {
        lex(text).into_iter().map(|lexeme| lexeme.token).collect()
    }

    #[test]
    fn words_numbers_and_ids_are_told_apart() {
        let word = |text: &str| Token::Word(text.to_owned());
        assert_eq!(
            tokens("Pick-up St. Mary’s #12.1, then (10, -3.5)"),
            [
                word("pick"),
                word("up"),
                word("st"),
                Token::Break,
                word("marys"),
                Token::Id(EntityId::new(12, 1)),
                Token::Comma,
                word("then"),
                Token::Open,
                Token::Number(10.0),
                Token::Comma,
                Token::Number(-3.5),
                Token::Close,
            ]
        );
    }

    #[test]
    fn a_full_stop_after_an_id_ends_the_sentence() {
        assert_eq!(
            tokens("go to #4."),
            [
                Token::Word("go".into()),
                Token::Word("to".into()),
                Token::Id(EntityId::new(4, 0)),
                Token::Break
            ]
        );
    }

    #[test]
    fn a_full_stop_within_half_of_a_day_ends_nothing() {
        let words = |text: &str| {
            let words = tokens(text).into_iter().map(|token| match token {
                Token::Word(word) => word,
                Token::Number(number) => number.to_string(),
                _ => ".".to_owned(),
            });
            words.collect::<Vec<_>>().join(" ")
        };
        assert_eq!(words("at 6 a.m. sharp"), "at 6 am sharp");
        assert_eq!(words("11P.M, please"), "11 pm . please");
        assert_eq!(words("make it 11 p.m. Go home."), "make it 11 pm . go home .");
        assert_eq!(words("make it 11 p.m."), "make it 11 pm .");
        assert_eq!(words("spa.made a.man"), "spa . made a . man");
    }

    #[test]
    fn an_impossible_id_is_a_word_nobody_knows() {
        assert_eq!(tokens("#99999999999999999999")[0], Token::Word("#".into()));
    }
}
