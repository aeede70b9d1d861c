//! What things are called by their own names, what places sell, and what to make of a misspelt name.

use std::cell::OnceCell;
use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2};
use simworld_core::id::EntityId;
use simworld_core::scene::{SELLS, Scene};
use simworld_core::value::Value;

use super::lexer::{Lexeme, Token, lex};
use super::lexicon::{CATEGORIES, Category};

/// The names within range, read when the first is looked for.
pub(super) struct Names<'a> {
    scene: &'a dyn Scene,
    around: Point2,
    range: f64,
    index: OnceCell<Index>,
}

#[derive(Default)]
struct Index {
    entries: Vec<Name>,
    /// What is sold somewhere, in alphabetical order.
    goods: Vec<(String, Vec<Token>)>,
}

struct Name {
    id: EntityId,
    label: String,
    tokens: Vec<Token>,
}

/// What a phrase that fits nothing exactly may have meant.
#[derive(Debug, PartialEq)]
pub(super) enum Guess {
    /// One thing only: a name, or part of one, that nothing else bears.
    Named(Vec<EntityId>),
    /// A class.
    Category(&'static Category),
    /// Several things equally well; what they are called.
    Ambiguous(Vec<String>),
    /// Nothing that is safe to assume; what sounds most alike, if anything does.
    Nothing(Option<String>),
}

impl<'a> Names<'a> {
    /// The names of everything within `range` m of a point.
    pub(super) fn new(scene: &'a dyn Scene, around: Point2, range: f64) -> Self {
        Self { scene, around, range, index: OnceCell::new() }
    }

    fn index(&self) -> &Index {
        self.index.get_or_init(|| {
            let mut index = Index::default();
            let _ = self.scene.visit(&Aabb::column_around(self.around, self.range), &mut |entity| {
                if let Some(name) = &entity.info.name {
                    let tokens = name_tokens(name);
                    if !tokens.is_empty() {
                        index.entries.push(Name { id: entity.id, label: name.clone(), tokens });
                    }
                }
                if let Some(Value::Text(sells)) = entity.info.attributes.get(SELLS) {
                    let goods = sells.split(',').map(|goods| (goods.trim().to_owned(), name_tokens(goods)));
                    index.goods.extend(goods.filter(|(_, tokens)| !tokens.is_empty()));
                }
                ControlFlow::Continue(())
            });
            index.goods.sort_by(|a, b| a.0.cmp(&b.0));
            index.goods.dedup_by(|a, b| a.0 == b.0);
            index
        })
    }

    /// Every word of a name or of what is sold.
    pub(super) fn words(&self) -> Vec<String> {
        let index = self.index();
        let tokens = index.entries.iter().flat_map(|name| &name.tokens);
        let tokens = tokens.chain(index.goods.iter().flat_map(|(_, tokens)| tokens));
        let word = |token: &Token| if let Token::Word(word) = token { Some(word.clone()) } else { None };
        let mut words: Vec<String> = tokens.filter_map(word).collect();
        words.sort_unstable();
        words.dedup();
        words
    }

    /// What is sold somewhere and named at the start of the phrase, in the singular or the plural.
    pub(super) fn goods(&self, lexemes: &[Lexeme]) -> Option<(String, usize)> {
        let fits = |tokens: &[Token]| {
            let said = lexemes.get(..tokens.len())?;
            let same = said.iter().zip(tokens).all(|(lexeme, token)| match (&lexeme.token, token) {
                (Token::Word(said), Token::Word(word)) => {
                    said == word
                        || said.strip_prefix(word.as_str()).is_some_and(|end| end == "s" || end == "es")
                }
                (said, token) => said == token,
            });
            same.then_some(tokens.len())
        };
        let hits = self.index().goods.iter().filter_map(|(goods, tokens)| Some((fits(tokens)?, goods)));
        hits.max_by_key(|(count, _)| *count).map(|(count, goods)| (goods.clone(), count))
    }

    /// What is sold here, for answers.
    pub(super) fn sold(&self) -> String {
        let goods: Vec<&str> = self.index().goods.iter().map(|(goods, _)| goods.as_str()).collect();
        if goods.is_empty() {
            "nothing is sold here".to_owned()
        } else {
            format!("sold are {}", goods.join(", "))
        }
    }

    /// The entities whose name begins the phrase; of several names the longest. With the number of tokens it takes.
    pub(super) fn exact(&self, lexemes: &[Lexeme]) -> Option<(Vec<EntityId>, usize)> {
        let hits: Vec<(EntityId, usize)> = self
            .index()
            .entries
            .iter()
            .filter_map(|name| Some((name.id, begins_with(lexemes, &name.tokens)?)))
            .collect();
        let longest = hits.iter().map(|(_, count)| *count).max()?;
        let ids = hits.iter().filter(|(_, count)| *count == longest).map(|(id, _)| *id).collect();
        Some((ids, longest))
    }

    /// What a phrase means that is part of a name.
    pub(super) fn part(&self, phrase: &[Lexeme]) -> Option<Guess> {
        let said: Vec<&Token> = phrase.iter().map(|lexeme| &lexeme.token).collect();
        let part_of = |name: &&Name| name.tokens.windows(said.len()).any(|part| part.iter().eq(said.clone()));
        let parts: Vec<&Name> = self.index().entries.iter().filter(part_of).collect();
        (!parts.is_empty()).then(|| one_name(&parts))
    }

    /// What a whole phrase that is no exact name may have meant.
    pub(super) fn guess(&self, phrase: &[Lexeme]) -> Guess {
        if let Some(part) = self.part(phrase) {
            return part;
        }
        let said = join(phrase.iter().map(|lexeme| &lexeme.token));
        let mut best: Option<(usize, Vec<Candidate<'_>>)> = None;
        for candidate in self.candidates() {
            let distance = strsim::osa_distance(&said, &candidate.spelling());
            match &mut best {
                Some((least, _)) if distance > *least => {}
                Some((least, found)) if distance == *least => found.push(candidate),
                _ => best = Some((distance, vec![candidate])),
            }
        }
        let Some((distance, found)) = best else { return Guess::Nothing(None) };
        if distance <= tolerance(&said) {
            return agreed(&found);
        }
        let similar = distance <= (said.chars().count() / 3).max(1);
        Guess::Nothing(similar.then(|| found[0].label()))
    }

    fn candidates(&self) -> impl Iterator<Item = Candidate<'_>> {
        let classes = CATEGORIES
            .iter()
            .flat_map(|category| category.words.iter().map(move |word| Candidate::Class(category, word)));
        self.index().entries.iter().map(Candidate::Name).chain(classes)
    }
}

/// Something a phrase may have meant.
#[derive(Clone, Copy)]
enum Candidate<'a> {
    Name(&'a Name),
    Class(&'static Category, &'static str),
}

impl Candidate<'_> {
    fn spelling(&self) -> String {
        match self {
            Self::Name(name) => join(name.tokens.iter()),
            Self::Class(_, word) => (*word).to_owned(),
        }
    }

    fn label(&self) -> String {
        match self {
            Self::Name(name) => name.label.clone(),
            Self::Class(_, word) => (*word).to_owned(),
        }
    }
}

/// Edits (insertions, deletions, substitutions, swaps of neighbours) that a phrase may be away from what it means.
/// Short words get none: "beach" is no misspelt "bench".
fn tolerance(said: &str) -> usize {
    match said.chars().count() {
        0..=5 => 0,
        6..=9 => 1,
        10..=14 => 2,
        _ => 3,
    }
}

fn agreed(found: &[Candidate<'_>]) -> Guess {
    let names: Vec<&Name> = found
        .iter()
        .filter_map(|found| if let Candidate::Name(name) = found { Some(*name) } else { None })
        .collect();
    match found[0] {
        Candidate::Name(_) if names.len() == found.len() => one_name(&names),
        Candidate::Class(category, _) if found.iter().all(|other| is_class(other, category)) => {
            Guess::Category(category)
        }
        _ => Guess::Ambiguous(found.iter().take(4).map(Candidate::label).collect()),
    }
}

fn is_class(candidate: &Candidate<'_>, category: &Category) -> bool {
    matches!(candidate, Candidate::Class(other, _) if *other == category)
}

/// The bearers, if they all bear the same name.
fn one_name(found: &[&Name]) -> Guess {
    if found.iter().all(|name| name.tokens == found[0].tokens) {
        return Guess::Named(found.iter().map(|name| name.id).collect());
    }
    let mut labels: Vec<String> = found.iter().map(|name| name.label.clone()).collect();
    labels.sort_unstable();
    labels.dedup();
    labels.truncate(4);
    Guess::Ambiguous(labels)
}

/// The tokens of a name without punctuation and without a leading article.
fn name_tokens(name: &str) -> Vec<Token> {
    let mut tokens: Vec<Token> = lex(name)
        .into_iter()
        .map(|lexeme| lexeme.token)
        .filter(|token| matches!(token, Token::Word(_) | Token::Number(_)))
        .collect();
    if tokens.len() > 1 && tokens[0] == Token::Word("the".to_owned()) {
        tokens.remove(0);
    }
    tokens
}

/// How many lexemes at the start say the name; punctuation between its words does not count.
fn begins_with(lexemes: &[Lexeme], name: &[Token]) -> Option<usize> {
    let mut at = 0;
    for (index, wanted) in name.iter().enumerate() {
        while index > 0 && matches!(lexemes.get(at).map(|l| &l.token), Some(Token::Break | Token::Comma)) {
            at += 1;
        }
        if lexemes.get(at).map(|lexeme| &lexeme.token) != Some(wanted) {
            return None;
        }
        at += 1;
    }
    Some(at)
}

fn join<'a>(tokens: impl Iterator<Item = &'a Token>) -> String {
    let words: Vec<String> = tokens
        .filter_map(|token| match token {
            Token::Word(word) => Some(word.clone()),
            Token::Number(number) => Some(number.to_string()),
            _ => None,
        })
        .collect();
    words.join(" ")
}
